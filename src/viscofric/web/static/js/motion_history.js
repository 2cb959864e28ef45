// A history of load and motion: presets of the page's contact, a table of its points, and a sketch to drag them in.

import { h } from "./parts.js";
import * as units from "./units.js";

/** What may be prescribed, by kind of contact: its label and the kind of its unit. */
export const CONTROLS = {
  point: { load: ["Load", "load"], indentation: ["Indentation", "length"] },
  line: { load: ["Load per length", "line_load"], indentation: ["Indentation", "length"] },
  rough: { pressure: ["Mean pressure", "pressure"], gap: ["Mean gap", "length"] },
};
export const PATHS = { speed: ["Speed", "speed"], position: ["Position", "length"] };
export const PRESETS = {
  hold: "Press and hold",
  start: "Start from rest",
  stop: "Start and stop",
  back: "Back and forth",
  impact: "Impact of a mass",
};
const BASES = { point: 10, line: 2000, rough: 5e5, indentation: 1e-4, gap: 1e-5 };
const [WIDE, LANE, GAP, EDGE] = [640, 110, 34, 10];

export const contactOf = ({ surface, indenter }) =>
  surface ? "rough" : indenter?.shape === "cylinder" ? "line" : "point";

const rounded = (value, digits = 2) => Number(value.toPrecision(digits));

/** Rows [time, value, speed] of a preset, SI, at the load and a middle speed of the study. */
export function presetRows(preset, study, control) {
  const contact = contactOf(study);
  const { conditions = {}, indenter, surface } = study;
  const [, kind] = Object.values(CONTROLS[contact])[0];
  const F = BASES[control] ?? units.ends(conditions.load ?? conditions.pressure, kind)?.[0] ?? BASES[contact];
  const [slow, fast] = units.ends(conditions.speed, "speed") ?? [0.1, 0.1];
  const V = rounded(Math.sqrt(slow * fast) || 0.1);
  const first = (value) => units.parse([value].flat()[0], "length");
  const size = surface
    ? (first(surface.spacing) ?? 1e-5) * (surface.points ?? 128)
    : 0.5 * (first(indenter?.radius) ?? 4e-3);
  const T = rounded(size / V);
  const speeds = { start: [0, V], stop: [0, V, 0, V], back: [V, -V, V, -V] }[preset];
  if (!speeds)
    return [
      [0, 0, 0],
      [0.1, F, 0],
      [1.1, F, 0],
    ];
  return speeds.flatMap((v, at) => [
    [rounded(at * T, 6), F, v],
    [rounded((at + 1) * T, 6), F, v],
  ]);
}

/** Rows with positions instead of speeds, or the reverse. */
export function converted(rows, path) {
  if (path === "position") {
    let [x, last] = [0, rows[0]];
    return rows.map((row) => {
      x += 0.5 * (row[2] + last[2]) * (row[0] - last[0]);
      last = row;
      return [row[0], row[1], Number(x.toFixed(12))];
    });
  }
  const parts = rows
    .slice(1)
    .map((row, at) => [rows[at], row])
    .filter(([from, to]) => to[0] > from[0]);
  return parts.flatMap(([from, to]) => {
    const speed = rounded((to[2] - from[2]) / (to[0] - from[0]), 6);
    return [
      [from[0], from[1], speed],
      [to[0], to[1], speed],
    ];
  });
}

/** A number in the user's unit, or a quantity with its own; null where it is neither. */
export function read(text, kind) {
  const plain = text.trim().replace("−", "-");
  return /^[+-]?[\d.]+(e[+-]?\d+)?$/i.test(plain) ? units.si(Number(plain), kind) : units.parse(plain, kind);
}

/** The table of points; columns are [label, kind], onChange gets the changed rows, refuse an error message. */
export function pointTable({ onChange, refuse }) {
  const head = h("tr");
  const body = h("tbody");
  const element = h(
    "table",
    { class: "history-table" },
    h("caption", { class: "unseen" }, "Points of the history"),
    h("thead", {}, head),
    body,
  );
  function show(rows, columns, wrong = null) {
    head.replaceChildren(
      ...columns.map(([label, kind]) => h("th", { scope: "col" }, `${label} (${units.label(kind)})`)),
      h("th", {}, h("span", { class: "unseen" }, "Change")),
    );
    const cell = (value, row, at) => {
      const [label, kind] = columns[at];
      const text = String(rounded(units.number(value, kind), 7));
      const input = h("input", {
        type: "text",
        value: text,
        "aria-label": `${label} of point ${row + 1}`,
        autocomplete: "off",
      });
      if (row === wrong) input.setAttribute("aria-invalid", "true");
      input.addEventListener("change", () => {
        const found = read(input.value, kind);
        if (found !== null && Number.isFinite(found))
          return onChange(rows.with(row, rows[row].with(at, found)), [row, at]);
        refuse(
          `Point ${row + 1}: enter a number in ${units.label(kind)}, or a quantity such as ${units.words(value || 1, kind)}.`,
        );
        input.setAttribute("aria-invalid", "true");
      });
      return h("td", {}, input);
    };
    const tool = (label, text, row, disabled, next) => {
      const button = h(
        "button",
        { type: "button", class: "button quiet small", disabled, title: label, "aria-label": `${label} ${row + 1}` },
        text,
      );
      button.addEventListener("click", () => onChange(next(), [row, 0]));
      return button;
    };
    const after = (row) => {
      const [from, to] = row + 1 < rows.length ? [rows[row], rows[row + 1]] : [rows[row - 1], rows[row]];
      const share = row + 1 < rows.length ? 0.5 : 2;
      const added = [from[0] + share * (to[0] - from[0]), rows[row][1], rows[row][2]];
      return rows.toSpliced(row + 1, 0, added);
    };
    body.replaceChildren(
      ...rows.map((values, row) =>
        h(
          "tr",
          {},
          ...values.map((value, at) => cell(value, row, at)),
          h(
            "td",
            {},
            tool("Add a point after point", "+", row, false, () => after(row)),
            tool("Remove point", "×", row, rows.length < 3, () => rows.toSpliced(row, 1)),
          ),
        ),
      ),
    );
  }
  const focus = ([row, at]) => body.rows[Math.min(row, body.rows.length - 1)]?.cells[at]?.firstChild.focus();
  return { element, show, focus };
}

const svg = (tag, properties, ...children) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(properties)) element.setAttribute(name, value);
  element.append(...children);
  return element;
};

/** The sketch of the rows over time, one lane for each column but the first; its points can be dragged. */
export function sketch({ onChange }) {
  const high = 2 * (LANE + GAP) + EDGE;
  const element = svg("svg", { class: "history-sketch", viewBox: `0 0 ${WIDE} ${high}`, role: "img" });
  let [rows, columns, scales, held] = [[], [], null, null];

  function scaled() {
    const times = rows.map((row) => row[0]);
    const lanes = [1, 2].map((at) => {
      const values = rows.map((row) => row[at]);
      const [low, most] = [Math.min(0, ...values), Math.max(0, ...values)];
      const span = most - low || { load: 10, speed: 0.1 }[columns[at][1]] || 1e-3;
      return [low - (low < 0 ? 0.12 * span : 0), low + 1.12 * span];
    });
    return { time: [times[0], times.at(-1) > times[0] ? times.at(-1) : times[0] + 1], lanes };
  }
  const x = (time) => EDGE + ((time - scales.time[0]) / (scales.time[1] - scales.time[0])) * (WIDE - 2 * EDGE);
  const y = (value, lane) => {
    const [low, most] = scales.lanes[lane];
    return GAP + lane * (LANE + GAP) + (1 - (value - low) / (most - low)) * LANE;
  };

  function draw() {
    const parts = [0, 1].flatMap((lane) => {
      const points = rows.map((row) => [x(row[0]), y(row[lane + 1], lane)]);
      const base = y(0, lane);
      const [label, kind] = columns[lane + 1];
      const largest = rows.reduce((most, row) => Math.max(most, Math.abs(row[lane + 1])), 0);
      const words = `${label}, largest ${units.show(largest, kind)}`;
      return [
        svg("text", { x: EDGE, y: lane * (LANE + GAP) + GAP - 12 }, words),
        svg("line", { class: "base", x1: EDGE, x2: WIDE - EDGE, y1: base, y2: base }),
        svg("polyline", { points: points.map((one) => one.join(",")).join(" ") }),
        ...points.map(([cx, cy], row) => svg("circle", { cx, cy, r: 6, "data-row": row, "data-lane": lane })),
      ];
    });
    const end = svg(
      "text",
      { x: WIDE - EDGE, y: GAP - 12, "text-anchor": "end" },
      `to ${units.show(rows.at(-1)[0], "time")}`,
    );
    element.replaceChildren(...parts, end);
    element.setAttribute(
      "aria-label",
      `Sketch of the history: ${columns.map(([label]) => label).join(", ")}. Its points are in the table.`,
    );
  }

  function moved(event) {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(element.getScreenCTM().inverse());
    const { row, lane } = held;
    const [low, most] = scales.lanes[lane];
    const value = low + (1 - (at.y - GAP - lane * (LANE + GAP)) / LANE) * (most - low);
    const snapped = Math.round((100 * value) / (most - low)) * ((most - low) / 100);
    const least = lane === 0 ? 0 : -Infinity; // no negative loads
    const [from, to] = scales.time;
    const time = from + ((at.x - EDGE) / (WIDE - 2 * EDGE)) * (to - from);
    const step = 10 ** Math.floor(Math.log10((to - from) / 100));
    const within = Math.min(
      Math.max(Math.round(time / step) * step, rows[row - 1]?.[0] ?? 0),
      rows[row + 1]?.[0] ?? Infinity,
    );
    rows = rows.with(row, rows[row].with(0, rounded(within, 9)).with(lane + 1, rounded(Math.max(snapped, least), 3)));
    draw();
  }

  element.addEventListener("pointerdown", (event) => {
    const { row, lane } = event.target.dataset;
    if (event.button !== 0 || row === undefined) return;
    held = { row: Number(row), lane: Number(lane) };
    element.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  element.addEventListener("pointermove", (event) => held && moved(event));
  for (const kind of ["pointerup", "pointercancel"])
    element.addEventListener(kind, () => {
      if (held) onChange(rows);
      held = null;
    });
  function show(next, described) {
    [rows, columns] = [next, described];
    scales = scaled();
    draw();
  }
  return { element, show };
}
