// Parts of the page as views of Preact: what shows a result is grey with a word while its inputs are others than those of now.
// Every part that shows something takes `of`, the result of a job that it is of.

import { inputsOf, isStale } from "./jobs.js";
import { html, view } from "./reactive.js";
import { page } from "./state.js";
import * as units from "./units.js";

/** Properties of an element that shows a result: its classes and the key of the result's inputs. */
export const shown = (result, classes = "") => ({
  class: `${classes} ${isStale(result) ? "stale" : ""}`.trim(),
  "data-inputs": inputsOf(result),
});

const ICONS = {
  undo: "M7.5 4 3.5 8l4 4M4 8h8a4.5 4.5 0 0 1 0 9H9",
  redo: "m12.5 4 4 4-4 4M16 8H8a4.5 4.5 0 0 0 0 9h3",
  theme: "M10 2.5a7.5 7.5 0 1 0 0 15zM10 2.5a7.5 7.5 0 0 1 0 15",
  down: "M10 3v9m-4-3.5 4 4 4-4M4 16.5h12",
  table: "M3 4.5h14v11H3zM3 8.5h14M8 8.5v7",
  copy: "M7 7h9v9H7zM4 13V4h9",
  file: "M5 2.5h6.5L15 6v11.5H5zM11.5 2.5V6H15",
  units: "M3 13 13 3l4 4L7 17zM6 10l2 2M8.5 7.5l2 2M11 5l2 2",
  close: "m5 5 10 10M15 5 5 15",
};

export const Icon = ({ name }) =>
  html`<svg class="icon" aria-hidden="true" viewBox="0 0 20 20"><path d=${ICONS[name]} /></svg>`;

/** A button; `kind` is "main", "quiet", "small" or nothing. */
export const Button = ({ kind = "", symbol, children, ...rest }) =>
  html`<button type="button" class="button ${kind}" ...${rest}>${symbol && html`<${Icon} name=${symbol} />`}${children}</button>`;

/** A row of buttons of which one is pressed. */
export const Pick = ({ label, options, value, onChange }) =>
  html`<div class="row" role="group" aria-label=${label}>
    ${options.map(([one, text]) => {
      const kind = one === value ? "small main" : "small";
      return html`<${Button} kind=${kind} aria-pressed=${one === value} onClick=${() => onChange(one)}>${text}<//>`;
    })}
  </div>`;

/** A choice among a few by radio buttons: options are [[value, what stands beside it], …]. */
export const Radios = ({ name, value, options, onChange, children, ...rest }) =>
  html`<div class="choices" role="radiogroup" ...${rest}>
    ${children}
    ${options.map(
      ([one, text]) => html`<label class="choice">
        <input type="radio" name=${name} value=${one} checked=${one === value} onChange=${() => onChange(one)} /><span>${text}</span>
      </label>`,
    )}
  </div>`;

/** A place to drop files (main.js hands them to it), which opens the file chooser when it is clicked: onFiles([File, …]). */
export const Drop = view(({ label, help, accept, multiple = true, onFiles }, self) => {
  const id = `files-${self.number}`;
  const chosen = ({ target }) => {
    if (target.files.length > 0) onFiles([...target.files]);
    target.value = "";
  };
  return html`<div class="drop-field">
    <input type="file" class="hidden-input" id=${id} accept=${accept} multiple=${multiple} onChange=${chosen} />
    <label class="drop" for=${id}>
      <${Icon} name="file" /><strong>${label}</strong>${help && html`<span class="help">${help}</span>`}
    </label>
  </div>`;
});

/** A card with a heading, for figures and forms that belong together. */
export const Card = ({ title, children, ...rest }) =>
  html`<section class="card" ...${rest}><h2>${title}</h2>${children}</section>`;

/** Something that is folded until it is opened. */
export const Folded = ({ title, children, ...rest }) =>
  html`<details ...${rest}><summary>${title}</summary><div class="step-body">${children}</div></details>`;

/** Sentences about the data; kinds are "note", "warning", "error". */
export const Notes = view(({ of, list = [], kind = "note", ...rest }) => {
  const sentences = list.filter(Boolean).map((sentence) => html`<li>${sentence}</li>`);
  return html`<ul ...${shown(of, `notes ${kind}`)} hidden=${sentences.length === 0} ...${rest}>${sentences}</ul>`;
});

/** What was checked, each with its verdict. */
export const Checks = view(({ of, list = [] }) => {
  const one = ({ name, verdict, words }) => html`<li class=${verdict.replaceAll(" ", "-")}>
    <strong>${[name, verdict === "noted" ? "unknown" : verdict].filter(Boolean).join(": ")}.${" "}</strong>${words}
  </li>`;
  return list.length > 0 && html`<ul ...${shown(of, "checks")}>${list.map(one)}</ul>`;
});

/** A number of a result (figures/spec.py) in the user's units: its label, its value, and its error with what is remarked. */
export function told({ label, value, kind, unit, digits, error, remark }) {
  const [shown, uncertain] = units
    .showWithError(value, error, kind, digits)
    .map((one) => `${one}${one && unit ? `\u00a0${unit}` : ""}`);
  const words = [uncertain && `± ${uncertain}`, units.filled(remark)].filter(Boolean).join(", ");
  return {
    label: units.filled(label),
    value: typeof value === "string" ? units.filled(value) : shown,
    remark: words,
  };
}

/** The name of a number, which shows its definition when it is clicked. */
export const Term = view(({ label }, self) => {
  const definition = page.start.glossary[label];
  if (!definition) return label;
  const id = `term-${self.number}`;
  return html`<button type="button" class="term" popovertarget=${id}>${label}</button>
    <span class="menu definition" id=${id} popover="auto" role="note"><strong>${label}.${" "}</strong>${definition}</span>`;
});

/** The main numbers of a result. */
export const Numbers = view(({ of, list = of?.key_numbers ?? [] }) => {
  const one = ({ label, value, remark }) =>
    html`<div><dt><${Term} label=${label} /></dt><dd class="value">${value}</dd>${remark && html`<dd class="remark">${remark}</dd>`}</div>`;
  return list.length > 0 && html`<dl ...${shown(of, "key-numbers")}>${list.map(told).map(one)}</dl>`;
});

/** A table of numbers, and of texts and views. */
export const Table = view(({ of, head, rows, caption }) => {
  const said = (value) => (typeof value === "string" ? units.filled(value) : (value ?? "–"));
  const cell = (value) => html`<td>${typeof value === "number" ? units.plainNumber(value, 5) : said(value)}</td>`;
  return html`<div ...${shown(of, "scroll")} tabindex="0" role="group" aria-label=${caption}>
    <table>
      <caption>${caption}</caption>
      <thead><tr>${head.map((text) => html`<th scope="col">${units.filled(text)}</th>`)}</tr></thead>
      <tbody>${rows.map((row) => html`<tr>${row.map(cell)}</tr>`)}</tbody>
    </table>
  </div>`;
});

const cancelledOnly = ({ cancelled }) => (cancelled ? "Cancelled." : "");

/** Progress of a job with a button that cancels it; `ended({seconds, cancelled})` words its end. */
export const Progress = view(({ job, label, cancels = true, ended = cancelledOnly }) => {
  const { done, total, label: words } = job.progress ?? {};
  const counted = total > 1 ? `${Math.round(done)} of ${total}` : "";
  const ending = job.ended ? ended(job.ended) : "";
  const text = job.progress ? [counted, words].filter(Boolean).join(" · ") || `${label} …` : ending;
  return html`<div class="progress ${job.progress ? "" : "done"}" hidden=${text === ""}>
    ${job.progress && html`<progress max="1" ...${total > 0 ? { value: done / total } : {}} aria-label=${label} />`}
    <span class="progress-text">${text}</span>
    ${job.progress && cancels && html`<${Button} kind="quiet small" onClick=${() => job.cancel()}>Cancel<//>`}
    ${!job.progress && job.ended?.cancelled && html`<${Button} kind="quiet small" onClick=${() => job.resume()}>Resume<//>`}
  </div>`;
});
