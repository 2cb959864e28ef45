// Elements of a figure: buttons, icons, tables.

import * as units from "./units.js";

/** An element: h("p", {class: "quiet", onclick}, "text", child). */
export function h(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties ?? {})) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name in element && typeof value !== "string") element[name] = value;
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

/** An icon of the page's own set, hidden from screen readers. */
export function icon(name) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("class", "icon");
  svg.setAttribute("aria-hidden", "true");
  svg.setAttribute("viewBox", "0 0 20 20");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", ICONS[name]);
  svg.append(path);
  return svg;
}

export const ICONS = {
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

/** A button; `kind` is "main", "quiet" or nothing. */
export function button({ label, onClick, kind, symbol, title, disabled }) {
  const classes = ["button", kind].filter(Boolean).join(" ");
  return h(
    "button",
    { type: "button", class: classes, onclick: onClick, title, disabled },
    symbol ? icon(symbol) : null,
    label,
  );
}

/** A table of numbers: table(["speed (mm/s)", "μ"], [[20, 0.0078], …], "caption"). */
export function table(head, rows, caption) {
  const cell = (value) => h("td", {}, typeof value === "number" ? units.plainNumber(value, 5) : (value ?? "–"));
  return h(
    "div",
    { class: "scroll", tabindex: "0", role: "group", "aria-label": caption ?? "Table" },
    h(
      "table",
      {},
      caption ? h("caption", {}, caption) : null,
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          head.map((text) => h("th", { scope: "col" }, text)),
        ),
      ),
      h(
        "tbody",
        {},
        rows.map((row) => h("tr", {}, row.map(cell))),
      ),
    ),
  );
}
