// Parts of the measurement step: its jobs, and inputs that are no part of the study.

import { Job } from "../jobs.js";
import { effect } from "../reactive.js";
import { state } from "../state.js";

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

/** Progress and errors of a job. */
export function progressOf(app, job, label) {
  const bar = app.fields.progressBar(job, { label });
  const errors = app.fields.note([], "error");
  errors.setAttribute("aria-live", "assertive");
  effect(() => {
    const { error } = job;
    const message = error && error.message.charAt(0).toUpperCase() + error.message.slice(1);
    errors.set(error ? [app.explain({ field: error.field, message }, "measurement")] : []);
  });
  return [bar, errors];
}

let made = 0;

/** A text box for a choice that is no part of the study; it is kept over reloads. A bare number gets the user's unit. */
export function optionField(app, { key, label, help, kind, placeholder }) {
  const { h } = app.fields;
  const id = `option-${(made += 1)}`;
  const input = h("input", {
    type: "text",
    id,
    placeholder,
    autocomplete: "off",
    spellcheck: "false",
    "aria-describedby": help ? `${id}-help` : undefined,
  });
  effect(() => void (input.value = state.view(key, "")));
  input.addEventListener("change", () => state.setView(key, input.value.trim()));
  const element = h(
    "div",
    { class: "field" },
    h("label", { for: id, class: "field-label" }, label),
    input,
    help ? h("p", { class: "help", id: `${id}-help` }, help) : null,
  );
  return Object.assign(element, { value: () => app.units.typed(state.view(key, ""), kind), input });
}

/** A choice that is no part of the study: chosen.value(), kept over reloads; `otherwise` is that until the user chooses. */
export function optionChoice(app, { key, label, help, options, otherwise = () => null }) {
  const { h } = app.fields;
  const id = `option-${(made += 1)}`;
  const select = h(
    "select",
    { id },
    options.map(([value, text]) => h("option", { value }, text)),
  );
  const known = options.map(([value]) => value);
  const value = () => [state.view(key), otherwise()].find((one) => known.includes(one)) ?? known[0];
  effect(() => void (select.value = value()));
  select.addEventListener("change", () => state.setView(key, select.value));
  const element = h(
    "div",
    { class: "field" },
    h("label", { for: id, class: "field-label" }, label),
    select,
    help ? h("p", { class: "help" }, help) : null,
  );
  return Object.assign(element, { value });
}

/** Names and values as a list of definitions. */
export function definitions(app) {
  const { h } = app.fields;
  const element = h("dl", { class: "facts" });
  element.set = (pairs = []) => {
    element.replaceChildren(...pairs.flatMap(({ name, value }) => [h("dt", {}, name), h("dd", {}, value)]));
    element.hidden = pairs.length === 0;
  };
  element.set();
  return element;
}

/** What was checked, each with its verdict. */
export function checkList(app) {
  const { h } = app.fields;
  const element = h("ul", { class: "checks" });
  element.set = (checks = []) => {
    const one = ({ name, verdict, words }) =>
      h("li", { class: verdict.replaceAll(" ", "-") }, h("strong", {}, `${name}: ${verdict}. `), words);
    element.replaceChildren(...checks.map(one));
    element.hidden = checks.length === 0;
  };
  element.set();
  return element;
}

/** Something that is folded until it is opened. */
export function folded(app, title, ...children) {
  const { h } = app.fields;
  return h("details", {}, h("summary", {}, title), h("div", { class: "step-body" }, children));
}
