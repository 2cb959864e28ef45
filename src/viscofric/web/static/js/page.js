// What all steps share of the page: what it began with, its steps, and sentences for those who look and those who listen.

import { homeOf, homeless } from "./fields.js";
import { html, signal } from "./reactive.js";
import { page, state } from "./state.js";
import { Button } from "./views.js";

export { page };

// Where the fields of a study's tables are, but for those of a rubber that other steps have.
const PLACES = {
  material: "sweeps",
  history: "motion",
  measurement: "measurement",
  outputs: "export",
  title: "export",
  cluster: "export",
};
const OF_RUBBER = {
  shift: ["leave_out_temperatures", "shift", "vertical_shift", "shift_factors", "fixed_shift_factors"],
  spectrum: ["spectrum", "modes", "tau_ratio"],
};

/** A sentence for screen readers alone. */
export function announce(text) {
  const place = document.getElementById("announcements");
  place.textContent = "";
  setTimeout(() => (place.textContent = text), 50);
}

/** [attempt, failed]: attempt(work) announces what the user's work with files returns; `failed` holds its error. */
export function attempts() {
  const failed = signal(null);
  const attempt = async (work) => {
    failed.value = null;
    try {
      const words = await work();
      if (typeof words === "string") announce(words);
    } catch (error) {
      failed.value = error;
      announce(`Error: ${error.message}`);
    }
  };
  return [attempt, failed];
}

/** The step that has the field of a path of the study. */
function stepOf(path) {
  const [table, key] = (path ?? "").replace(/\[\d+\]/g, "").split(".");
  const own = table === "material" && Object.keys(OF_RUBBER).find((step) => OF_RUBBER[step].includes(key));
  return own || (PLACES[table] ?? "contact");
}

/** An error for a note of a step: its sentence, and a way to the step of its field; options of a job are in this step. */
export function explain(error, here) {
  const step = error.field && !/^(@|options\b)/.test(error.field) ? stepOf(error.field) : here;
  if (step === here || !page.steps.has(step)) return error.message;
  const go = html`<${Button} kind="small" onClick=${() => goTo(step)}>Go to ${page.steps.get(step).title}<//>`;
  return html`${error.message} ${go}`;
}

/** The same for the contact's step, which does not repeat the sentence at the field or at the top. */
export function waits(what, error) {
  if (homeless().some(({ field }) => field === error.field)) return `Follow the message at the top to update ${what}.`;
  const beside = homeOf(error.field) !== undefined && stepOf(error.field) === "contact";
  return beside ? `Fix the marked field to update ${what}.` : explain(error, "contact");
}

/** A problem without a field on the page, with what it is about before its sentence. */
export function named({ field, message }) {
  const about = `${page.steps.get(stepOf(field)).title}: ${message[0].toLowerCase()}${message.slice(1)}`;
  return { field, message: field ? about : message };
}

/** Bring a link into the middle of the rail.  Not by scrollIntoView: the tab key would then pass over the skip link. */
function scrollRailTo(link) {
  const rail = link.closest(".rail");
  const [outer, inner] = [rail.getBoundingClientRect(), link.getBoundingClientRect()];
  rail.scrollBy(inner.x - outer.x - (outer.width - inner.width) / 2, inner.y - outer.y - (outer.height - inner.height) / 2);
}

/** Show a step, and put the focus on its heading. */
export function goTo(id, { focus = true } = {}) {
  if (!page.steps.has(id)) return;
  if (location.hash !== `#${id}`) history.pushState(null, "", `#${id}`);
  state.lookAt(id);
  document.title = `${page.steps.get(id).title} · viscofric`;
  // once the step is seen
  setTimeout(() => {
    scrollRailTo(document.querySelector(`#steps a[href="#${id}"]`));
    if (!focus) return;
    window.scrollTo(0, 0);
    document.getElementById(`title-${id}`).focus({ preventScroll: true });
  });
}

/** The step of the data, ready for files of tests. */
export function bringSweeps() {
  state.setView("sweeps.source", "dma");
  goTo("sweeps");
}

/** Keys of [material] that say where it comes from, each with its words. */
export const sources = () => page.start.forms.source[0].options;

/** Where the rubber of [material] comes from: a key; null without. */
export const sourceKey = (material) =>
  sources().find(([key]) => [material].flat()[0]?.[key] !== undefined)?.[0] ?? null;

/** What the material of a study is made of, in a few words. */
export function sourceOf({ material = {} }) {
  const rubbers = [material].flat();
  if (rubbers.length > 1) return `${rubbers.length} materials`;
  const value = rubbers[0][sourceKey(material)] ?? "no material yet";
  return Array.isArray(value) && value.length > 1 ? `${value.length} files` : String(value);
}

const first = (value) => [value].flat()[0];

/** What is in contact, in a few words: "ball 9.525 mm, 10 N". */
export function contactOf({ indenter = {}, surface, conditions = {} }) {
  const { shape = "ball", radius, angle } = indenter;
  const what = surface ? "rough surface" : [shape, first(radius ?? angle)].filter(Boolean).join(" ");
  return `${what}, ${first(conditions.load ?? conditions.pressure) ?? "no load"}`;
}

/** Where numbers that leave the page come from. */
export const originOf = (study) =>
  `${sourceOf(study)}; ${contactOf(study)}; ${new Date().toISOString().slice(0, 10)}, viscofric ${page.start.version}`;

/** Whether a study rests on synthetic data. */
export function isSynthetic(study) {
  const names = [study.material ?? []].flat().map((material) => material.catalogue);
  return (
    study.data_origin === "synthetic" || page.start.catalogue.some((one) => one.synthetic && names.includes(one.name))
  );
}
