// Which inputs a result was computed from; what shows a result of other inputs than the study's is grey, with a word.
//
// computedFrom(result, kind, study)    remembers from which study a job of this kind was computed (api.js does it for each result)
// studyOf(result)                      that study
// isCurrent(result)                    whether the study's inputs are still the same
// outdated(result)                     its inputs could not be computed again: it counts as one of earlier inputs
// shows(element, result)               the element shows this result (null: none); it is grey while the study's inputs are others
// forget(element)                      ends that
// DEPENDS_ON[kind]                     the inputs of a job, as paths of the study
// keyOf(kind, study)                   names the inputs of a job; equal inputs have equal keys
//
// An element has its key in data-inputs, and the class "stale", which the style sheet greys and words, while the study's
// inputs have another.

import { state, valueAt } from "./state.js";

const MATERIAL = ["material", "uncertainty"];
const CONTACT = ["material", "indenter", "surface", "layer", "solver"];
const PREDICTED = [...CONTACT, "uncertainty", "conditions.thickness", "measurement"];

/** Paths of the study on which the results of a job depend. */
export const DEPENDS_ON = {
  sweeps: ["material"],
  rubber: MATERIAL,
  moduli: MATERIAL,
  curve: [...CONTACT, "conditions", "sweep", "uncertainty", "interface", "heating"],
  contact: [...CONTACT, "conditions.load", "conditions.pressure", "conditions.direction", "sweep"],
  motion: [...CONTACT, "conditions.temperature", "conditions.direction", "sweep"],
  measured: ["measurement"],
  agreement: PREDICTED,
  master: PREDICTED,
  identify: PREDICTED,
  "export-study": [""],
  "export-card": ["material"],
};

const origins = new WeakMap(); // result -> {kind, study, key}
const shown = new Map(); // element -> result

/** A short name of a text (FNV-1a, twice 32 bits). */
function hash(text) {
  let [a, b] = [0x811c9dc5, 0x1b873593];
  for (let at = 0; at < text.length; at += 1) {
    a = Math.imul(a ^ text.charCodeAt(at), 0x01000193);
    b = Math.imul(b ^ text.charCodeAt(at), 0x85ebca6b);
  }
  return [a, b].map((one) => (one >>> 0).toString(16).padStart(8, "0")).join("");
}

export function keyOf(kind, study) {
  const inputs = DEPENDS_ON[kind].map((path) => valueAt(study, path) ?? null);
  // a file may have other contents under the same name; the order of keys means nothing
  const canonical = (_, value) => {
    if (typeof value === "string") return state.renewals(value) ? `${value}#${state.renewals(value)}` : value;
    if (value === null || typeof value !== "object" || Array.isArray(value)) return value;
    return Object.fromEntries(Object.entries(value).sort(([one], [other]) => (one < other ? -1 : 1)));
  };
  return hash(JSON.stringify(inputs, canonical));
}

export function computedFrom(result, kind, study) {
  if (kind in DEPENDS_ON) origins.set(result, { kind, study, key: keyOf(kind, study) });
}

export const studyOf = (result) => origins.get(result)?.study;

/** Whether a result is of the study as it is now. */
export function isCurrent(result) {
  const origin = result && origins.get(result);
  return Boolean(origin) && origin.key === keyOf(origin.kind, state.study);
}

export function outdated(result) {
  if (result) origins.set(result, { ...origins.get(result), key: "outdated" });
  refresh();
}

export function shows(element, result) {
  shown.set(element, result);
  mark(element, result);
}

export const forget = (element) => shown.delete(element);

function mark(element, result) {
  const origin = result && origins.get(result);
  const stale = Boolean(origin) && !isCurrent(result);
  if (origin) element.dataset.inputs = origin.key;
  else delete element.dataset.inputs;
  element.classList.toggle("stale", stale);
}

function refresh() {
  for (const [element, result] of shown) mark(element, result);
}

state.subscribe("", refresh);
