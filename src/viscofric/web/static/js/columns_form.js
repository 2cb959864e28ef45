// The form of the columns that a file's header does not name, offered with the error that lists the headings found.

const words = (quantity) => quantity.replaceAll(" ", "_");

/** A heading as [material] columns wants it: by its number where it stands twice, with the unit that the user adds. */
function said(headings, index, unit) {
  const heading = headings[index];
  const place = headings.filter((one) => one === heading).length > 1 ? `#${index + 1}` : heading;
  return unit ? `${place} (${unit})` : place;
}

/**
 * The form, hidden until `offer(values)` is called with the values of an error; `choose(columns)` gets the user's headings.
 *
 * @param {object} app
 * @param {{choose: (columns: object | undefined) => void, chosen: () => object | undefined}} table
 */
export function columnsForm(app, { choose, chosen }) {
  const { h, button } = app.fields;
  const rows = h("div", { class: "form columns-form" });
  const read = button({ label: "Read with these columns", kind: "main", onClick: () => choose(chosenColumns()) });
  const forget = button({ label: "Clear the column names", kind: "quiet small", onClick: () => choose(undefined) });
  const kept = h("p", { class: "help" });
  const about = h("p", { class: "help" }, "Which column holds what? Units that the file states need not be repeated.");
  const form = h("div", { class: "panel" }, about, rows, h("div", { class: "row" }, read));
  const element = h("div", { class: "panel questions", hidden: true }, form, h("div", {}, kept, forget));
  let values = null;
  let controls = [];

  function row([quantity, unit]) {
    const before = values.headings.indexOf(values.known[quantity]);
    const select = h(
      "select",
      { "aria-label": `Column of the ${quantity}` },
      h("option", { value: "" }, "– none –"),
      values.headings.map((heading, index) => h("option", { value: String(index) }, heading || `column ${index + 1}`)),
    );
    select.value = before < 0 ? "" : String(before);
    const input = h("input", {
      type: "text",
      placeholder: unit && `e.g. ${unit}`,
      "aria-label": `Unit of the ${quantity}`,
    });
    controls.push({ quantity, select, input, before });
    const name = quantity[0].toUpperCase() + quantity.slice(1);
    const both = h("span", { class: "row" }, select, input);
    return h("div", { class: "field" }, h("span", { class: "field-label" }, name), both);
  }

  function chosenColumns() {
    const columns = {};
    for (const { quantity, select, input, before } of controls) {
      const unit = input.value.trim();
      if (select.value === "" || (Number(select.value) === before && !unit)) continue;
      columns[words(quantity)] = said(values.headings, Number(select.value), unit);
    }
    return Object.keys(columns).length ? columns : undefined;
  }

  function show() {
    const named = Object.entries(chosen() ?? {});
    kept.textContent = named.map(([quantity, heading]) => `${quantity.replaceAll("_", " ")}: ${heading}`).join("; ");
    kept.hidden = forget.hidden = named.length === 0;
    form.hidden = !values;
    element.hidden = form.hidden && kept.hidden;
  }

  /** Offer the headings of an error, or none. */
  element.offer = (found) => {
    values = found?.headings?.length && found.offered ? found : null;
    controls = [];
    rows.replaceChildren(...(values ? values.offered.map(row) : []));
    show();
  };
  return element;
}
