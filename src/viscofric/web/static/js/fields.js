// Fields of the study's document: each edits one path (state.js), and shows beside itself the errors whose `field` is that path,
// of the check of the document and of the jobs.
//
// <${Form} of=${[field, …]} />   a grid of fields, which are data (web/start.toml):
//   path, label, help, id        the path may be that of a view, "@card.program" (state.js)
//   as         "text" if it is not given; "number", "range" (one value, a list or a range), "choice", "switch", "ticks" (some of
//              a list of words)
//   kind       of the quantity (units.js); `unit` is that of bare numbers instead; `list`: one or several, separated by commas
//   min, max, step, placeholder                 of a box
//   slider     [low, high], SI: a slider below the box, where that has one value
//   options    [[value, text], …] or words; `otherwise` is the value without the key, or what a range begins with
//   sets       {value: {path: value, …}}: other keys that a choice changes; null removes a key
//   also       {path: value, …}: other keys that any change of a box changes
//   keys       {path: value, …}: what a switch turns on
//   spacing    of a range: ["log", "linear"]
//   when       [{path: true | false | [value, …]}, …]: it is shown if all of one entry hold; "shape" is that of the contact
//   shown()                       instead of what a choice has at its path; onChange(value) instead of a change there

import * as jobs from "./jobs.js";
import { computed, html, signal, view } from "./reactive.js";
import { shapeOf, state } from "./state.js";
import * as units from "./units.js";

const listed = (value) => [value ?? []].flat();
// Between values of a list; between two digits, a comma is a decimal one, which is refused, unless whole numbers are listed.
const BETWEEN = /;\s*|,\s+|(?<!\d),|,(?!\d)/;
const readable = (words) =>
  String(words ?? "")
    .replace("delta_degC", "K")
    .replace("degC", "°C")
    .replace("degF", "°F")
    .replace(/(?<=\d\s*)u(?=[ms]\b)/, "µ");

/** A text box: `value()` is what it shows, but not while somebody types; `take` gets what was typed, undefined for nothing. */
export const Box = view(({ value, take, type = "text", ...rest }, self) => {
  const words = String(value());
  const typed = self.input?.dataset.typing && document.activeElement === self.input;
  const change = ({ target }) => {
    delete target.dataset.typing;
    take(target.value.trim() === "" ? undefined : target.value);
    self.setState({});
  };
  return html`<input type=${type} autocomplete="off" spellcheck=${false} value=${typed ? self.input.value : words}
    ref=${(one) => (self.input = one)}
    onInput=${({ target }) => (target.dataset.typing = "yes")} onChange=${change} ...${rest} />`;
});

/** A choice among [[value, text], …], or words; values need not be text. */
export const Select = view(({ options, value, onChange, ...rest }, self) => {
  const entries = options.map((one) => (Array.isArray(one) ? one : [one, one]));
  const take = ({ target }) => {
    onChange(entries[target.selectedIndex][0]);
    self.setState({});
  };
  return html`<select value=${String(value)} onChange=${take} ...${rest}>
    ${entries.map(([one, text]) => html`<option value=${String(one)}>${text ?? one}</option>`)}
  </select>`;
});

/** What a box needs for the value at a path: text of a field's kind turned into it, and the reverse. */
function at(path, { as, kind, unit, list, also, onChange = (value) => state.change({ [path]: value, ...also }) }) {
  const one = (text) => {
    if (as === "number") return Number.isNaN(Number(text)) ? text : Number(text);
    if (unit) return Number.isNaN(Number(text)) ? text.trim() : `${text.trim()} ${unit}`;
    return kind ? units.typed(text, kind) : text.trim();
  };
  const several = (text) => {
    const parts = text.split(kind === "plain" ? /[,;]\s*/ : BETWEEN).filter((part) => part.trim() !== "");
    // a unit at the end is that of all: "30, 60, 90 °C"
    const common = /[\d.]\s*([^\d\s.].*)$/.exec(parts.at(-1) ?? "")?.[1];
    const found = parts.map((part) => one(common && /^[\s\d.+−-]+$/.test(part) ? `${part.trim()} ${common}` : part));
    return list === "always" || found.length > 1 ? found : found[0];
  };
  return {
    value: () => listed(state.get(path)).map(kind || unit ? readable : String).join(", "),
    take: (text) => onChange(text === undefined ? undefined : (list ? several : one)(text)),
  };
}

const STEPS = 400;

/** A slider between two values, even in their logarithm or, if it is `linear`, in themselves; `move` gets the value. */
export function Slider({ ends, linear, value, move, ...rest }) {
  const [to, from] = linear ? [Number, Number] : [Math.log, Math.exp];
  const [low, high] = ends.map(to);
  const at = Math.round((STEPS * (to(value) - low)) / (high - low));
  return html`<input type="range" min="0" max=${STEPS} step="1" value=${Number.isFinite(at) ? at : 0}
    onInput=${({ target }) => move(from(low + (target.value / STEPS) * (high - low)))} ...${rest} />`;
}

/** The slider of a field; a drag is one step of undo. */
function slider({ path, kind = "plain", label, slider: ends, step }) {
  const now = units.parse(listed(state.get(path))[0], kind);
  const move = (value) => state.slide(path, step === 1 ? Math.round(value) : units.words(value, kind, 3));
  return ends && html`<${Slider} ...${{ ends, value: now, move }} aria-label="${label}: slider"
    aria-valuetext=${units.show(now, kind)} onChange=${state.settle} />`;
}

const isRange = (value) => value && typeof value === "object" && !Array.isArray(value);
const formOf = (value) => (isRange(value) ? "range" : Array.isArray(value) && value.length !== 1 ? "list" : "one");
const FORMS = [
  ["one", "one value"],
  ["list", "list"],
  ["range", "range"],
];

/** The same quantity in another form: one value, list or range. */
function inForm(form, value, { spacing: [spacing], otherwise = {} }) {
  const all = isRange(value) ? [value.from, value.to] : listed(value);
  if (form === "one") return all[0] ?? otherwise.one;
  if (form === "list") return all.length > 1 ? all : [all[0], otherwise.to ?? all[0]].filter(Boolean);
  const to = all.length > 1 ? all.at(-1) : (otherwise.to ?? all[0]);
  return { from: all[0], to, points: otherwise.points ?? 10, spacing };
}

function range({ spacing = ["log", "linear"], ...about }, own) {
  const { path, label } = about;
  const box = (words, place, options, rest) =>
    html`<${Box} key=${place} aria-label="${label}${words}" ...${at(place, options)} ...${rest} ...${own} />`;
  const form = formOf(state.get(path));
  if (form === "one") return html`${box("", path, { ...about, list: true })}${slider(about)}`;
  if (form === "list") return box(": list, separated by commas", path, { ...about, list: "always" });
  const points = { type: "number", min: 2, step: 1 };
  return html`<span class="range">
    <span class="ends">${box(" from", `${path}.from`, about)}<span>to</span>${box(" to", `${path}.to`, about)}</span>
    <span class="steps">
      ${box(": number of points", `${path}.points`, { as: "number" }, points)}<span>points</span>
      ${
        spacing.length > 1 &&
        html`<${Select} aria-label="${label}: spacing" options=${spacing} value=${state.get(`${path}.spacing`) ?? spacing[0]}
          onChange=${(one) => state.set(`${path}.spacing`, one)} ...${own} />`
      }
    </span>
  </span>`;
}

/** The choice of a range's form, in the row of its label. */
function formChoice({ path, label, spacing = ["log", "linear"], otherwise }, own) {
  const take = (form) => state.set(path, inForm(form, state.get(path), { spacing, otherwise }));
  return html`<${Select} class="mode" aria-label="${label}: how to give it" options=${FORMS} value=${formOf(state.get(path))}
    onChange=${take} ...${own} />`;
}

function box(about, own) {
  const { as, min, max, step = "any", placeholder } = about;
  const rest = as === "number" ? { type: "number", min, max, step } : { inputmode: "text" };
  return html`<${Box} ...${at(about.path, about)} ...${rest} placeholder=${placeholder} ...${own} />${slider(about)}`;
}

function choice({ path, options, otherwise, sets = {}, shown, onChange }, own) {
  const now = shown ? shown() : (state.get(path) ?? otherwise);
  const known = now === undefined || options.some((one) => [one].flat()[0] === now);
  const take = onChange ?? ((value) => state.change({ [path]: value, ...sets[value] }));
  return html`<${Select} options=${known ? options : [...options, now]} value=${now} onChange=${take} ...${own} />`;
}

function onOff({ keys }, own, self) {
  const given = Object.keys(keys).filter((path) => state.get(path) !== undefined);
  const now = () => Object.fromEntries(Object.keys(keys).map((path) => [path, state.get(path)]));
  const none = Object.fromEntries(Object.keys(keys).map((path) => [path, undefined]));
  if (given.length) self.last = now();
  const take = ({ target }) => state.change(target.checked ? (self.last ?? keys) : none);
  return html`<input type="checkbox" role="switch" checked=${given.length > 0} onChange=${take} ...${own} />`;
}

function ticks({ path, options, otherwise }, own) {
  const now = listed(state.get(path) ?? otherwise);
  const known = options.map(([word]) => word);
  const turn = (word, on) => {
    const chosen = known.filter((one) => (one === word ? on : now.includes(one)));
    state.set(path, [...chosen, ...now.filter((one) => !known.includes(one))]);
  };
  return options.map(
    ([word, text]) => html`<label class="row">
      <input type="checkbox" checked=${now.includes(word)} onChange=${({ target }) => turn(word, target.checked)} ...${own} />${text}
    </label>`,
  );
}

const inSpan = (about, own) => html`<span class="range-field">${range(about, own)}</span>`;
const CONTROLS = { text: box, number: box, choice, switch: onOff, ticks, range: inSpan };
const BESIDE = { ticks: () => null, range: formChoice }; // of fields with several controls, what is in the label's row

/** What holds at a path: the value there, or else what its field has without one. */
const valueOf = (path) => (path === "shape" ? shapeOf(state.study) : (state.get(path) ?? declared.get(path)));
const holds = ([path, wanted]) =>
  Array.isArray(wanted) ? wanted.includes(valueOf(path) ?? null) : (state.get(path) !== undefined) === wanted;

const isSeen = ({ when }) => !when || when.some((one) => Object.entries(one).every(holds));
const declare = ({ path, as, otherwise }) => declared.set(path, as === "choice" ? otherwise : undefined);

/** What the fields of a form that are shown have, by the last parts of their paths; without a value, what they have `otherwise`. */
export function given(fields) {
  fields.forEach(declare);
  const values = fields.filter(isSeen).map(({ path, otherwise }) => [path, state.get(path) ?? otherwise ?? undefined]);
  return Object.fromEntries(values.map(([path, value]) => [path.split(".").at(-1), value]));
}

export const Field = view((about, self) => {
  const { path, label, as = "text", help, id = `field-${self.number}` } = about;
  declare(about);
  const seen = isSeen(about);
  // errors about a key that has its own field while it is there are not at its switch
  const isHome = seen && !(as === "switch" && typeof state.get(path) === "string");
  settle(self, isHome ? path : null);
  if (!seen) return null;
  const message = isHome ? [...(sentencesOf.value.get(path) ?? [])].join(" ") : "";
  const described = {
    "aria-describedby": `${help ? `${id}-help ` : ""}${id}-error`,
    "aria-invalid": message ? "true" : undefined,
  };
  const beside = BESIDE[as]?.(about, described);
  const group = as in BESIDE ? { role: "group", "aria-labelledby": `${id}-label` } : {};
  const classes = ["field", as === "switch" && "switch", message && "wrong"].filter(Boolean).join(" ");
  return html`<div class=${classes} ...${group}>
    ${
      as in BESIDE
        ? html`<span class="field-head"><span id="${id}-label" class="field-label">${label}</span>${beside}</span>`
        : html`<label for=${id} class="field-label">${label}</label>`
    }
    ${CONTROLS[as](about, as in BESIDE ? described : { id, ...described }, self)}
    ${help && html`<p class="help" id="${id}-help">${help}</p>`}
    <p class="field-error" id="${id}-error" hidden=${!message}>${message}</p>
  </div>`;
});

export const Form = ({ of }) =>
  html`<div class="form">${of.map((one) => html`<${Field} key=${`${one.path} ${one.label}`} ...${one} />`)}</div>`;

// What is wrong with the study, each sentence beside the field that it is about.

const homes = signal(new Map()); // number of a field that is shown -> its path
const declared = new Map(); // paths of fields, shown or not, with what a choice is without a value
const isIn = (place, path) => place === path || place.startsWith(`${path}.`) || place.startsWith(`${path}[`);

/** Have a field show the errors about a path, null for none, as long as it is shown. */
function settle(self, path) {
  self.gone ??= () => settle(self, null);
  if ((homes.peek().get(self.number) ?? null) === path) return;
  const next = new Map(homes.peek());
  if (path === null) next.delete(self.number);
  else next.set(self.number, path);
  homes.value = next;
}

/** The field's path that is nearest to the place of an error; undefined where the page shows none. */
export const homeOf = (place) =>
  [...homes.value.values()]
    .filter((path) => isIn(place ?? "", path))
    .sort((one, other) => other.length - one.length)[0];

/** All paths that have a field, shown or not. */
export const paths = () => [...declared.keys()].filter((path) => !path.startsWith("@"));

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
