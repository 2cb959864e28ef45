// Parts of the measurement step: its jobs, and inputs that are no part of the study.

import { Job } from "../jobs.js";
import { explain } from "../page.js";
import { html, view } from "../reactive.js";
import { state } from "../state.js";
import { Notes, Progress, shown } from "../views.js";

/** What was read and separated; its result names the table of the study that it is of. */
export const measured = new Job("measured", {
  wait: 400,
  asked: (result, asked) => ({ study: { ...asked.study, measurement: result.table } }),
  inputs: () => (state.get("measurement") ? { study: state.study } : null),
});

/** What is shown of it: also that of earlier inputs, while it is read again. */
export const shownMeasured = () => (measured.error ? null : measured.result);

/** Whether friction is looked at alone, without the page's material. */
export const alone = () => state.view("friction.beside", "rubber") === "nothing";

/** A job of measured friction; `options` gives those of the page, or null where nothing is to be computed. */
export const ofMeasured = (kind, options, about) =>
  new Job(kind, {
    wait: 400,
    when: () => state.step === "measurement",
    inputs: () => {
      const given = !measured.error && measured.current?.curves ? options() : null;
      return given && { study: state.study, options: given };
    },
    ...about,
  });

/** The prediction for what was measured. */
export const agreement = ofMeasured("agreement", () => (alone() ? null : {}), { remember: 4 });

/** Progress and errors of a job. */
export const Run = view(({ job, label }) => {
  const { error } = job;
  const message = error && error.message.charAt(0).toUpperCase() + error.message.slice(1);
  const list = error ? [explain({ field: error.field, message }, "measurement")] : [];
  return html`<${Progress} job=${job} label=${label} /><${Notes} kind="error" aria-live="assertive" list=${list} />`;
});

/** Names and values as a list of definitions. */
export const Facts = view(
  ({ of, list = [] }) =>
    list.length > 0 &&
    html`<dl ...${shown(of, "facts")}>${list.map(({ name, value }) => html`<dt>${name}</dt><dd>${value}</dd>`)}</dl>`,
);

/** What was checked, each with its verdict. */
export const Checks = view(({ of, list = [] }) => {
  const one = ({ name, verdict, words }) =>
    html`<li class=${verdict.replaceAll(" ", "-")}><strong>${name}: ${verdict}. </strong>${words}</li>`;
  return list.length > 0 && html`<ul ...${shown(of, "checks")}>${list.map(one)}</ul>`;
});
