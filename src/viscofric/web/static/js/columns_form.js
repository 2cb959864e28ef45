// The form of the columns that a file's header does not name, offered with the error that lists the headings found.

import { html, view } from "./reactive.js";
import { Button } from "./views.js";

// The choice of a quantity without a column: a value with its unit, of all rows.
const SAME = "same";
const words = (quantity) => quantity.replaceAll(" ", "_");

/** A heading as [material] columns wants it: by its number where it stands twice, with the unit that the user adds. */
function said(headings, index, unit) {
  const heading = headings[index];
  const place = headings.filter((one) => one === heading).length > 1 ? `#${index + 1}` : heading;
  return unit ? `${place} (${unit})` : place;
}

/** The headings that the form has, of the quantities for which they are others than those that were recognised. */
function columnsOf(form, { headings, known, offered }) {
  const columns = {};
  for (const [at, [quantity]] of offered.entries()) {
    const [column, unit] = ["column", "unit"].map((part) => form.elements[`${part}-${at}`].value.trim());
    if (column === SAME) {
      columns[words(quantity)] = `= ${unit.replace(/^=\s*/, "")}`;
      continue;
    }
    if (column === "" || (Number(column) === headings.indexOf(known[quantity]) && !unit)) continue;
    columns[words(quantity)] = said(headings, Number(column), unit);
  }
  return Object.keys(columns).length ? columns : undefined;
}

function Row({ at, quantity, unit, headings, before }) {
  const named = headings.map((heading, index) => [String(index), heading || `column ${index + 1}`]);
  return html`<div class="field">
    <span class="field-label">${quantity[0].toUpperCase() + quantity.slice(1)}</span>
    <span class="row">
      <select name="column-${at}" aria-label="Column of the ${quantity}">
        ${[["", "– none –"], [SAME, "– one value for all rows –"], ...named].map(([value, text]) => html`<option value=${value} selected=${value === before}>${text}</option>`)}
      </select>
      <input type="text" name="unit-${at}" placeholder=${unit && `e.g. ${unit}`} aria-label="Unit of the ${quantity}, or its value for all rows" />
    </span>
  </div>`;
}

/** The form for the `values` of an error; `choose(columns)` gets the user's headings, of which `chosen` are there. */
export const Columns = view(({ values, chosen = {}, choose }) => {
  const offers = values?.headings?.length > 0 && values.offered;
  const named = Object.entries(chosen).map(([quantity, heading]) => `${quantity.replaceAll("_", " ")}: ${heading}`);
  if (!offers && named.length === 0) return null;
  const read = (event) => {
    event.preventDefault();
    choose(columnsOf(event.target, values));
  };
  const row = ([quantity, unit], at) => {
    const index = values.headings.indexOf(values.known[quantity]);
    return html`<${Row} key=${[quantity, ...values.headings].join()} ...${{ at, quantity, unit }} headings=${values.headings} before=${index < 0 ? "" : String(index)} />`;
  };
  return html`<div class="panel questions">
    ${
      offers &&
      html`<form class="panel" onSubmit=${read}>
        <p class="help">
          Which column holds what? Units that the file states need not be repeated; one value for all rows is written with
          its unit, such as 20 N.
        </p>
        <div class="form columns-form">${values.offered.map(row)}</div>
        <div class="row"><button class="button main">Read with these columns</button></div>
      </form>`
    }
    ${
      named.length > 0 &&
      html`<div>
        <p class="help">${named.join("; ")}</p>
        <${Button} kind="quiet small" onClick=${() => choose(undefined)}>Clear the column names<//>
      </div>`
    }
  </div>`;
});
