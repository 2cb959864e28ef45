// Fields of the study's document: each edits one path (state.js), and shows beside itself the errors whose `field` is that path,
// of the check of the document and of the jobs.
//
// <${Quantity} path="conditions.load" label="Load" kind="load" placeholder help />       a quantity with its unit
// <${Text} path label read write />       free text; `read` turns it into a document's value, `write` the reverse
// <${Amount} path label min max step />   a plain number
// <${Choose} path label options=${[[value, text], …]} otherwise onChange />               undefined removes the key
// <${Toggle} path label value />          a switch that stands for a table or a key
// <${Range} path label kind spacing otherwise />                                         one value, a list, or a range
//
// quantityField({…}) and its like return the same as an element.

import * as jobs from "./jobs.js";
import { h } from "./parts.js";
import { computed, html, render, signal, view } from "./reactive.js";
import { state } from "./state.js";
import * as units from "./units.js";

export * from "./parts.js";

const listed = (value) => (Array.isArray(value) ? value : value === undefined ? [] : [value]);
const readable = (words) =>
  String(words ?? "")
    .replace("degC", "°C")
    .replace("degF", "°F")
    .replace(/(?<=\d\s*)u(?=[ms]\b)/, "µ");

/** Label, controls, help and error of one path; `controls` gets what each of them has, `beside` is in the label's row. */
function field({ number }, { path, label, help, classes = "", beside }, controls) {
  const id = `field-${number}`;
  if (path && !homes.peek().includes(path)) homes.value = [...homes.peek(), path];
  const message = [...(sentencesOf.value.get(path) ?? [])].join(" ");
  const described = { "aria-describedby": `${help ? `${id}-help ` : ""}${id}-error`, "aria-invalid": message ? "true" : undefined };
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

/** Text box whose value follows a path, but not while somebody types. */
const Box = view(({ path, read, write, type = "text", ...rest }, self) => {
  const words = String(write(state.get(path)));
  const typed = self.base?.dataset.typing && document.activeElement === self.base;
  const take = ({ target }) => {
    delete target.dataset.typing;
    state.set(path, target.value.trim() === "" ? undefined : read(target.value));
    self.setState({});
  };
  return html`<input type=${type} autocomplete="off" spellcheck=${false} value=${typed ? self.base.value : words}
    onInput=${({ target }) => (target.dataset.typing = "yes")} onChange=${take} ...${rest} />`;
});

export const Quantity = view(({ path, kind = "plain", placeholder, ...about }, self) =>
  field(
    self,
    { path, ...about },
    (own) => html`<${Box} path=${path} read=${(text) => units.typed(text, kind)} write=${readable} placeholder=${placeholder}
      inputmode="text" ...${own} />`,
  ),
);

const trimmed = (text) => text.trim();
const orNothing = (value) => value ?? "";

export const Text = view(({ path, placeholder, read = trimmed, write = orNothing, ...about }, self) =>
  field(
    self,
    { path, ...about },
    (own) => html`<${Box} path=${path} read=${read} write=${write} placeholder=${placeholder} ...${own} />`,
  ),
);

const asNumber = (text) => (text === "" || Number.isNaN(Number(text)) ? text : Number(text));

export const Amount = view(({ path, min, max, step = "any", placeholder, ...about }, self) =>
  field(
    self,
    { path, ...about },
    (own) => html`<${Box} path=${path} type="number" read=${asNumber} write=${orNothing} min=${min} max=${max} step=${step}
      placeholder=${placeholder} ...${own} />`,
  ),
);

export const Choose = view(({ path, options, otherwise, onChange = (value) => state.set(path, value), ...about }, self) => {
  const now = JSON.stringify(state.get(path) ?? otherwise);
  const take = ({ target }) => {
    onChange(options[Number(target.value)][0]);
    self.setState({});
  };
  const index = options.findIndex(([one]) => JSON.stringify(one) === now);
  return field(
    self,
    { path, ...about },
    (own) => html`<select value=${index < 0 ? "" : String(index)} onChange=${take} ...${own}>
      ${options.map(([value, text], at) => html`<option value=${String(at)}>${text ?? value}</option>`)}
    </select>`,
  );
});

export const Toggle = view(({ path, value = true, ...about }, self) => {
  const now = state.get(path);
  if (now !== undefined) self.last = now;
  const take = ({ target }) => state.set(path, target.checked ? (self.last ?? value) : undefined);
  return field(
    self,
    { ...about, classes: "switch" },
    (own) => html`<input type="checkbox" role="switch" checked=${now !== undefined} onChange=${take} ...${own} />`,
  );
});

const FORMS = [
  ["one", "one value"],
  ["list", "list"],
  ["range", "range"],
];
const isRange = (value) => value && typeof value === "object" && !Array.isArray(value);

export const Range = view(({ path, label, kind = "plain", help, spacing = ["log", "linear"], otherwise = {} }, self) => {
  const value = state.get(path);
  const form = isRange(value) ? "range" : Array.isArray(value) && value.length !== 1 ? "list" : "one";
  const read = (text) => units.typed(text, kind);
  const mode = (own) => html`<select class="mode" aria-label="${label}: how to give it" value=${form} ...${own}
    onChange=${({ target }) => state.set(path, inForm(target.value, state.get(path), { spacing, otherwise }))}>
    ${FORMS.map(([one, text]) => html`<option value=${one}>${text}</option>`)}
  </select>`;
  const end = (key, own) =>
    html`<${Box} path="${path}.${key}" aria-label="${label} ${key}" read=${read} write=${readable} ...${own} />`;
  const gap = (own) => html`<select aria-label="${label}: spacing" value=${state.get(`${path}.spacing`) ?? spacing[0]} ...${own}
    onChange=${({ target }) => state.set(`${path}.spacing`, target.value)}>
    ${spacing.map((one) => html`<option value=${one}>${one}</option>`)}
  </select>`;
  const controls = {
    one: (own) => html`<${Box} key="one" path=${path} aria-label=${label} read=${read} write=${(now) => readable(listed(now)[0])} ...${own} />`,
    list: (own) => html`<${Box} key="list" path=${path} aria-label="${label}: list, separated by commas"
      read=${(text) => withUnits(text, kind)} write=${(now) => listed(now).map(readable).join(", ")} ...${own} />`,
    range: (own) => html`<span class="range">
      <span class="ends">${end("from", own)}<span>to</span>${end("to", own)}</span>
      <span class="steps">
        <${Box} path="${path}.points" aria-label="${label}: number of points" type="number" min=${2} step=${1} read=${Number}
          write=${orNothing} ...${own} />
        <span>points</span>${spacing.length > 1 && gap(own)}
      </span>
    </span>`,
  };
  return field(self, { path, label, help, beside: mode }, (own) => html`<span class="range-field">${controls[form](own)}</span>`);
});

/** A view as a function that returns an element. */
const placed = (View) => (properties) => {
  const element = h("div", { class: "placed" });
  render(html`<${View} ...${properties} />`, element);
  return element;
};
export const quantityField = placed(Quantity);
export const textField = placed(Text);
export const numberField = placed(Amount);
export const choiceField = placed(Choose);
export const toggleField = placed(Toggle);
export const rangeField = placed(Range);

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
