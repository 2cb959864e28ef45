// Fields, notes, progress bars and other parts of a form; each returns an element to put into a step's section.
//
// Every field edits one path of the study's document (state.js) and shows, beside itself, the errors whose `field` is that
// path: of the check of the document, and of the jobs.

import * as jobs from "./jobs.js";
import { h } from "./parts.js";
import { computed, effect, signal } from "./reactive.js";
import { state } from "./state.js";
import * as units from "./units.js";

export * from "./parts.js";

let made = 0;

/** Label, control, help and error of one path. */
function field({ path, label, help, classes = "", beside = null }, control, controls = [control]) {
  const id = `field-${(made += 1)}`;
  const single = controls.length === 1;
  controls[0].id ||= id;
  const labelled = single
    ? h("label", { for: controls[0].id, class: "field-label" }, label)
    : h("span", { class: "field-head" }, h("span", { id: `${id}-label`, class: "field-label" }, label), beside);
  const helped = help ? h("p", { class: "help", id: `${id}-help` }, help) : null;
  const error = h("p", { class: "field-error", id: `${id}-error`, hidden: true });
  const described = [helped && `${id}-help`, `${id}-error`].filter(Boolean).join(" ");
  for (const one of controls) one.setAttribute("aria-describedby", described);
  const element = h("div", { class: `field ${classes}`.trim() }, labelled, control, helped, error);
  if (!single) {
    element.setAttribute("role", "group");
    element.setAttribute("aria-labelledby", `${id}-label`);
  }
  if (!path) return element;
  if (!homes.peek().includes(path)) homes.value = [...homes.peek(), path];
  effect(() => {
    const message = [...(sentencesOf.value.get(path) ?? [])].join(" ");
    error.textContent = message;
    error.hidden = !message;
    for (const one of controls) {
      if (message) one.setAttribute("aria-invalid", "true");
      else one.removeAttribute("aria-invalid");
    }
    element.classList.toggle("wrong", Boolean(message));
  });
  return element;
}

const readable = (words) =>
  String(words ?? "")
    .replace("degC", "°C")
    .replace("degF", "°F")
    .replace(/(?<=\d\s*)u(?=[ms]\b)/, "µ");

const listed = (value) => (Array.isArray(value) ? value : value === undefined ? [] : [value]);

/** Text box whose value follows a path; `read` turns text into a document's value, `write` the reverse. */
function box(path, { read, write, placeholder, type = "text", label, ...rest }) {
  const input = h("input", {
    type,
    placeholder,
    autocomplete: "off",
    spellcheck: "false",
    "aria-label": label,
    ...rest,
  });
  const refresh = () => {
    const words = write(state.get(path));
    if (document.activeElement !== input || !input.dataset.typing) input.value = words;
  };
  input.addEventListener("input", () => (input.dataset.typing = "yes"));
  input.addEventListener("change", () => {
    delete input.dataset.typing;
    state.set(path, input.value.trim() === "" ? undefined : read(input.value));
    refresh();
  });
  effect(refresh);
  return input;
}

/** One quantity with its unit: quantityField({path: "conditions.load", label: "Load", kind: "load"}). */
export function quantityField({ path, label, kind = "plain", help, placeholder }) {
  const input = box(path, { read: (text) => units.typed(text, kind), write: readable, placeholder, inputmode: "text" });
  return field({ path, label, help }, input);
}

/** Free text, such as a title or a name; `read` turns it into a document's value, `write` the reverse. */
export function textField({ path, label, help, placeholder, read, write }) {
  const ways = { read: read ?? ((text) => text.trim()), write: write ?? ((value) => value ?? "") };
  return field({ path, label, help }, box(path, { ...ways, placeholder }));
}

/** A plain number: numberField({path: "solver.accuracy", label: "Accuracy", min, max, step}). */
export function numberField({ path, label, help, min, max, step = "any", placeholder }) {
  const read = (text) => (text === "" || Number.isNaN(Number(text)) ? text : Number(text));
  const input = box(path, { read, write: (value) => value ?? "", type: "number", min, max, step, placeholder });
  return field({ path, label, help }, input);
}

/** A choice: choiceField({path, label, options: [[value, label], …], otherwise, onChange}); an undefined value removes the key. */
export function choiceField({ path, label, options, help, otherwise, onChange }) {
  const select = h(
    "select",
    {},
    options.map(([value, text], index) => h("option", { value: String(index) }, text ?? value)),
  );
  const refresh = () => {
    const value = state.get(path) ?? otherwise;
    const index = options.findIndex(([one]) => JSON.stringify(one) === JSON.stringify(value));
    select.selectedIndex = index;
  };
  select.addEventListener("change", () => {
    const value = options[Number(select.value)][0];
    if (onChange) onChange(value);
    else state.set(path, value);
  });
  effect(refresh);
  return field({ path, label, help }, select);
}

/** A switch that stands for a table or a key: toggleField({path: "layer", label: "Layer", value: {thickness: "2 mm"}}). */
export function toggleField({ path, label, value = true, help }) {
  const input = h("input", { type: "checkbox", role: "switch" });
  const refresh = () => void (input.checked = state.get(path) !== undefined);
  let last = value;
  input.addEventListener("change", () => {
    if (!input.checked) last = structuredClone(state.get(path));
    state.set(path, input.checked ? last : undefined);
  });
  effect(refresh);
  return field({ path: "", label, help, classes: "switch" }, input);
}

/** One value, a list, or a range: rangeField({path: "conditions.speed", label: "Speed", kind: "speed"}). */
export function rangeField({ path, label, kind = "plain", help, spacing = ["log", "linear"], otherwise = {} }) {
  const form = () => {
    const value = state.get(path);
    if (value && typeof value === "object" && !Array.isArray(value)) return "range";
    return Array.isArray(value) && value.length !== 1 ? "list" : "one";
  };
  const mode = h("select", { class: "mode", "aria-label": `${label}: how to give it` });
  for (const [value, text] of [
    ["one", "one value"],
    ["list", "list"],
    ["range", "range"],
  ])
    mode.append(h("option", { value }, text));
  const read = (text) => units.typed(text, kind);
  const one = box(path, { label, read, write: (value) => readable(listed(value)[0]) });
  const list = box(path, {
    label: `${label}: list, separated by commas`,
    read: (text) => withUnits(text, kind),
    write: (value) => listed(value).map(readable).join(", "),
  });
  const end = (key, text) => box(`${path}.${key}`, { label: `${label} ${text}`, read, write: readable });
  const points = box(`${path}.points`, {
    label: `${label}: number of points`,
    type: "number",
    min: 2,
    step: 1,
    read: Number,
    write: (value) => value ?? "",
  });
  const gap = h(
    "select",
    { "aria-label": `${label}: spacing` },
    spacing.map((value) => h("option", { value }, value)),
  );
  gap.addEventListener("change", () => state.set(`${path}.spacing`, gap.value));
  const ends = [end("from", "from"), end("to", "to")];
  const range = h(
    "span",
    { class: "range" },
    h("span", { class: "ends" }, ends[0], h("span", {}, "to"), ends[1]),
    h("span", { class: "steps" }, points, h("span", {}, "points"), spacing.length > 1 ? gap : null),
  );
  const refresh = () => {
    const now = form();
    mode.value = now;
    one.hidden = now !== "one";
    list.hidden = now !== "list";
    range.hidden = now !== "range";
    gap.value = state.get(`${path}.spacing`) ?? spacing[0];
  };
  mode.addEventListener("change", () => state.set(path, inForm(mode.value, state.get(path), { spacing, otherwise })));
  effect(refresh);
  return field({ path, label, help, beside: mode }, h("span", { class: "range-field" }, one, list, range), [
    one,
    list,
    ...ends,
    points,
    mode,
    gap,
  ]);
}

/** A list that people typed; a unit at its end is that of all: "30, 60, 90 °C". */
function withUnits(text, kind) {
  const parts = text.split(/[,;]\s*/).filter((part) => part.trim() !== "");
  const unit = /[\d.]\s*([^\d\s.].*)$/.exec(parts.at(-1) ?? "")?.[1];
  return parts.map((part) => units.typed(unit && /^[\s\d.+−-]+$/.test(part) ? `${part.trim()} ${unit}` : part, kind));
}

/** The same quantity in another form: one value, list or range. */
function inForm(form, value, { spacing, otherwise }) {
  const isRange = value && typeof value === "object" && !Array.isArray(value);
  const all = isRange ? [value.from, value.to] : listed(value);
  if (form === "one") return all[0] ?? otherwise.one;
  if (form === "list") return all.length > 1 ? all : [all[0], otherwise.to ?? all[0]].filter(Boolean);
  return {
    from: all[0],
    to: all.length > 1 ? all.at(-1) : (otherwise.to ?? all[0]),
    points: otherwise.points ?? 10,
    spacing: spacing[0],
  };
}

// What is wrong with the study, each sentence beside the field that it is about.

const homes = signal([]); // paths of the fields on the page
const within = (place, path) =>
  path !== "" && (place === path || place.startsWith(`${path}.`) || place.startsWith(`${path}[`));

/** The field's path that is nearest to the place of an error; undefined where the page has none. */
export const homeOf = (place) =>
  homes.value.filter((path) => within(place ?? "", path)).sort((one, other) => other.length - one.length)[0];

/** All paths that have a field. */
export const paths = () => homes.value;

/** What the check of the document found, or else nothing yet: [{field, message}]. */
const problems = () => jobs.newest("export-run-file")?.problems ?? [];

/** Problems that have no field on the page. */
export const homeless = () => problems().filter(({ field }) => homeOf(field) === undefined);

/** Sentences by path: those of the check, and of jobs where the check has nothing to say. */
const sentencesOf = computed(() => {
  const found = new Map();
  for (const errors of [problems(), jobs.errors()]) {
    const before = new Set(found.keys());
    for (const { field, message } of errors) {
      const home = homeOf(field);
      if (home !== undefined && !before.has(home)) found.set(home, (found.get(home) ?? new Set()).add(message));
    }
  }
  return found;
});
