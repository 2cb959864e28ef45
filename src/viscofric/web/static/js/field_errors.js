// What is wrong with the study, each sentence beside the field that it is about.

import { state } from "./state.js";

const fields = new Map(); // path -> fields that show its errors
let checked = new Map(); // path -> what the check of the document says of it
const ofJobs = new Map(); // job -> {error, forget}: what a job said

/** Have a field show what is wrong with its path. */
export function enrol(path, element) {
  if (!fields.has(path)) fields.set(path, new Set());
  fields.get(path).add(element);
  showAll();
}

const within = (place, path) =>
  path !== "" && (place === path || place.startsWith(`${path}.`) || place.startsWith(`${path}[`));

/** The field's path that is nearest to the place of an error; undefined where the page has none. */
const homeOf = (place) =>
  [...fields.keys()].filter((path) => within(place ?? "", path)).sort((one, other) => other.length - one.length)[0];

function showAll() {
  const told = new Map([...checked].map(([path, sentences]) => [path, new Set(sentences)]));
  for (const { error } of ofJobs.values()) {
    const home = homeOf(error.field);
    if (home !== undefined) told.set(home, (told.get(home) ?? new Set()).add(error.message));
  }
  for (const [path, elements] of fields)
    for (const element of elements) element.setError([...(told.get(path) ?? [])].join(" "));
}

/** Show each sentence beside its field and none beside the others; returns those that have no field on the page. */
export function showErrors(problems) {
  const homeless = [];
  checked = new Map();
  for (const problem of problems) {
    const home = homeOf(problem.field);
    if (home === undefined) homeless.push(problem);
    else checked.set(home, [...(checked.get(home) ?? []), problem.message]);
  }
  showAll();
  return homeless;
}

/** Show the error of a job beside its field; returns whether there is such a field. */
export function showError(error, job = "job") {
  clearError(job);
  if (!error?.field) return false;
  ofJobs.set(job, { error, forget: state.subscribe(error.field, () => clearError(job)) });
  showAll();
  return homeOf(error.field) !== undefined;
}

/** Forget the error of a job. */
export function clearError(job) {
  if (!ofJobs.has(job)) return;
  ofJobs.get(job).forget();
  ofJobs.delete(job);
  showAll();
}
