// Fields of the study's document: each edits one path (state.js), and shows beside itself the errors whose `field` is that path,
// of the check of the document and of the jobs.
//
// <${Quantity} path="conditions.load" label="Load" kind="load" placeholder help />       a quantity with its unit
// <${Text} path label read write />       free text; `read` turns it into a document's value, `write` the reverse
// <${Amount} path label min max step />   a plain number
// <${Choose} path label options=${[[value, text], …]} otherwise onChange />               undefined removes the key
// <${Toggle} path label value onChange /> a switch that stands for a table or a key
// <${Ticks} path label options />         some of a list of words
// <${Range} path label kind spacing otherwise />                                         one value, a list, or a range
// slider=${[low, high]} (SI) gives a quantity, a number, or a range that is one value, a slider; `shown` is what a choice or a switch
// shows in place of the value at its path.
//
// <${Form} of=${[{as: Amount, path, label, when: () => true, …}, …]} />    a form as data: fields in a grid, some of them only
//                                         under a condition; without `as`, one with a `kind` is a quantity, others are text
// where(when, ...fields), within(path, ...fields)    fields that are shown under a condition, or with a table or key

import * as jobs from "./jobs.js";
import { computed, html, signal, view } from "./reactive.js";
import { state } from "./state.js";
import * as units from "./units.js";

const listed = (value) => (Array.isArray(value) ? value : value === undefined ? [] : [value]);
const readable = (words) =>
  String(words ?? "")
    .replace("degC", "°C")
    .replace("degF", "°F")
    .replace(/(?<=\d\s*)u(?=[ms]\b)/, "µ");

/** Label, controls, help and error of one path; `controls` gets what each of them has, `beside` is in the label's row. */
function field(
  self,
  { path, label, help, classes = "", beside, isHome = true, id = `field-${self.number}` },
  controls,
) {
  settle(self, isHome && path ? path : null);
  const message = isHome ? [...(sentencesOf.value.get(path) ?? [])].join(" ") : "";
  const described = {
    "aria-describedby": `${help ? `${id}-help ` : ""}${id}-error`,
    "aria-invalid": message ? "true" : undefined,
  };
  const group = beside ? { role: "group", "aria-labelledby": `${id}-label` } : {};
  return html`<div class=${`field ${classes} ${message ? "wrong" : ""}`.trim()} ...${group}>
    ${
      beside
        ? html`<span class="field-head"><span id="${id}-label" class="field-label">${label}</span>${beside(described)}</span>`
        : html`<label for=${id} class="field-label">${label}</label>`
    }
    ${controls(beside ? described : { id, ...described })}
    ${help && html`<p class="help" id="${id}-help">${help}</p>`}
    <p class="field-error" id="${id}-error" hidden=${!message}>${message}</p>
  </div>`;
}

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

/** What a box needs for the value at a path; `read` turns text into it, `write` the reverse. */
const at = (path, read, write) => ({
  value: () => write(state.get(path)),
  take: (text) => state.set(path, text === undefined ? undefined : read(text)),
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

/** A slider of a quantity, even in its logarithm; a drag is one step of undo. */
const STEPS = 400;
function slider({ path, kind, label, slider: [low, high], step }) {
  const now = units.parse(listed(state.get(path))[0], kind);
  const ratio = Math.log(high / low) / STEPS;
  const move = ({ target }) => {
    const value = low * Math.exp(ratio * Number(target.value));
    state.slide(path, step === 1 ? Math.round(value) : units.words(value, kind, 3));
  };
  return html`<input type="range" min="0" max=${STEPS} step="1" value=${now > 0 ? Math.round(Math.log(now / low) / ratio) : 0}
    aria-label="${label}: slider" aria-valuetext=${units.show(now, kind)} onInput=${move} onChange=${state.settle} />`;
}

export const Quantity = view(({ kind = "plain", placeholder, ...about }, self) =>
  field(
    self,
    about,
    (own) => html`<${Box} ...${at(about.path, (text) => units.typed(text, kind), readable)} placeholder=${placeholder}
      inputmode="text" ...${own} />${about.slider && slider({ kind, ...about })}`,
  ),
);

const trimmed = (text) => text.trim();
const orNothing = (value) => value ?? "";

export const Text = view(({ placeholder, read = trimmed, write = orNothing, ...about }, self) =>
  field(self, about, (own) => html`<${Box} ...${at(about.path, read, write)} placeholder=${placeholder} ...${own} />`),
);

const asNumber = (text) => (Number.isNaN(Number(text)) ? text : Number(text));

export const Amount = view(({ min, max, step = "any", placeholder, ...about }, self) =>
  field(
    self,
    about,
    (own) =>
      html`<${Box} type="number" ...${at(about.path, asNumber, orNothing)} ...${{ min, max, step, placeholder }} ...${own} />
      ${about.slider && slider({ kind: "plain", step, ...about })}`,
  ),
);

export const Choose = view(({ options, otherwise, shown, onChange, ...about }, self) => {
  const { path } = about;
  const now = shown ? shown() : (state.get(path) ?? otherwise);
  const take = onChange ?? ((value) => state.set(path, value));
  return field(self, about, (own) => html`<${Select} options=${options} value=${now} onChange=${take} ...${own} />`);
});

/** Errors about a key that has its own field while it is there are not at its switch. */
export const Toggle = view(({ value = true, shown, onChange, ...about }, self) => {
  const { path } = about;
  const now = state.get(path);
  if (now !== undefined) self.last = now;
  const put = onChange ?? ((next) => state.set(path, next));
  const take = ({ target }) => put(target.checked ? (self.last ?? value) : undefined);
  return field(
    self,
    { ...about, classes: "switch", isHome: typeof now !== "string" },
    (own) =>
      html`<input type="checkbox" role="switch" checked=${shown ? shown() : now !== undefined} onChange=${take} ...${own} />`,
  );
});

export const Ticks = view(({ path, label, options }, self) => {
  const now = listed(state.get(path));
  const known = options.map(([word]) => word);
  const turn = (word, on) => {
    const chosen = known.filter((one) => (one === word ? on : now.includes(one)));
    state.set(path, [...chosen, ...now.filter((one) => !known.includes(one))]);
  };
  const tick = (own, [word, text]) => html`<label class="row">
    <input type="checkbox" checked=${now.includes(word)} onChange=${({ target }) => turn(word, target.checked)} ...${own} />${text}
  </label>`;
  return field(self, { path, label, beside: () => null }, (own) => options.map((one) => tick(own, one)));
});

const FORMS = [
  ["one", "one value"],
  ["list", "list"],
  ["range", "range"],
];
const isRange = (value) => value && typeof value === "object" && !Array.isArray(value);

export const Range = view(({ spacing = ["log", "linear"], otherwise = {}, ...about }, self) => {
  const { path, label, kind = "plain" } = about;
  const value = state.get(path);
  const form = isRange(value) ? "range" : Array.isArray(value) && value.length !== 1 ? "list" : "one";
  const read = (text) => units.typed(text, kind);
  const beside = (
    own,
  ) => html`<${Select} class="mode" aria-label="${label}: how to give it" options=${FORMS} value=${form} ...${own}
    onChange=${(next) => state.set(path, inForm(next, state.get(path), { spacing, otherwise }))} />`;
  const end = (key, own) =>
    html`<${Box} aria-label="${label} ${key}" ...${at(`${path}.${key}`, read, readable)} ...${own} />`;
  const gap = (
    own,
  ) => html`<${Select} aria-label="${label}: spacing" options=${spacing} value=${value.spacing ?? spacing[0]}
    onChange=${(one) => state.set(`${path}.spacing`, one)} ...${own} />`;
  const controls = {
    one: (
      own,
    ) => html`<${Box} key="one" aria-label=${label} ...${at(path, read, (now) => readable(listed(now)[0]))} ...${own} />
      ${about.slider && slider({ kind, ...about })}`,
    list: (own) => html`<${Box} key="list" aria-label="${label}: list, separated by commas"
      ...${at(
        path,
        (text) => withUnits(text, kind),
        (now) => listed(now).map(readable).join(", "),
      )} ...${own} />`,
    range: (own) => html`<span class="range">
      <span class="ends">${end("from", own)}<span>to</span>${end("to", own)}</span>
      <span class="steps">
        <${Box} type="number" min=${2} step=${1} aria-label="${label}: number of points" ...${at(`${path}.points`, Number, orNothing)} ...${own} />
        <span>points</span>${spacing.length > 1 && gap(own)}
      </span>
    </span>`,
  };
  return field(self, { ...about, beside }, (own) => html`<span class="range-field">${controls[form](own)}</span>`);
});

const Field = view(({ as, when, ...about }) => {
  declared.add(about.path);
  if (when && !when()) return null;
  return html`<${as ?? (about.kind ? Quantity : Text)} ...${about} />`;
});
export const Form = ({ of, children }) =>
  html`<div class="form">${of.map((one) => html`<${Field} ...${one} />`)}${children}</div>`;

export const where = (when, ...fields) =>
  fields.map((one) => ({ ...one, when: () => when() && (one.when?.() ?? true) }));
export const within = (path, ...fields) => where(() => state.get(path) !== undefined, ...fields);

/** A list that people typed; a unit at its end is that of all: "30, 60, 90 °C". */
function withUnits(text, kind) {
  const parts = text.split(/[,;]\s*/).filter((part) => part.trim() !== "");
  const unit = /[\d.]\s*([^\d\s.].*)$/.exec(parts.at(-1) ?? "")?.[1];
  return parts.map((part) => units.typed(unit && /^[\s\d.+−-]+$/.test(part) ? `${part.trim()} ${unit}` : part, kind));
}

/** The same quantity in another form: one value, list or range. */
function inForm(form, value, { spacing, otherwise }) {
  const all = isRange(value) ? [value.from, value.to] : listed(value);
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

const homes = signal(new Map()); // number of a field that is shown -> its path
const declared = new Set(); // paths of fields, shown or not
const isIn = (place, path) => place === path || place.startsWith(`${path}.`) || place.startsWith(`${path}[`);

/** Have a field show the errors about a path, null for none, as long as it is shown. */
function settle(self, path) {
  self.gone ??= () => settle(self, null);
  const next = new Map(homes.peek());
  if ((next.get(self.number) ?? null) === path) return;
  if (path === null) next.delete(self.number);
  else next.set(self.number, path);
  declared.add(path);
  homes.value = next;
}

/** The field's path that is nearest to the place of an error; undefined where the page shows none. */
export const homeOf = (place) =>
  [...homes.value.values()]
    .filter((path) => isIn(place ?? "", path))
    .sort((one, other) => other.length - one.length)[0];

/** All paths that have a field, shown or not. */
export const paths = () => [...declared].filter(Boolean);

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
