// A history of load and motion: presets of the page's contact, a table of its points, and a sketch to drag them in.

import { Box } from "./fields.js";
import { html, signal, view } from "./reactive.js";
import * as units from "./units.js";
import { Button } from "./views.js";

/** What may be prescribed, by kind of contact: its label and the kind of its unit. */
export const CONTROLS = {
  point: { load: ["Load", "load"], indentation: ["Indentation", "length"] },
  line: { load: ["Load per length", "line_load"], indentation: ["Indentation", "length"] },
  rough: { pressure: ["Mean pressure", "pressure"], gap: ["Mean gap", "length"] },
};
export const PATHS = { speed: ["Speed", "speed"], position: ["Position", "length"] };
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

/** Rows with another one after a row: half-way to the next, or beyond the last. */
function added(rows, row) {
  const inside = row + 1 < rows.length;
  const [from, to] = inside ? [rows[row], rows[row + 1]] : [rows[row - 1], rows[row]];
  return rows.toSpliced(row + 1, 0, [from[0] + (inside ? 0.5 : 2) * (to[0] - from[0]), rows[row][1], rows[row][2]]);
}

/**
 * The table of points; columns are [label, kind], onChange gets the changed rows.  What cannot be read is `refused`,
 * {row, at, text, sentence}; `wrong` is the number of a row that was refused when it was solved.
 */
export const PointTable = view(({ rows, columns, wrong, refused, onChange, onRefuse }) => {
  const cell = (value, row, at) => {
    const [label, kind] = columns[at];
    const here = refused?.row === row && refused.at === at;
    const take = (text = "") => {
      const found = units.read(text, kind);
      if (found !== null && Number.isFinite(found)) return onChange(rows.with(row, rows[row].with(at, found)));
      const example = `enter a number in ${units.label(kind)}, or a quantity such as ${units.words(value || 1, kind)}.`;
      onRefuse({ row, at, text, sentence: `Point ${row + 1}: ${example}` });
    };
    return html`<td>
      <${Box} aria-label="${label} of point ${row + 1}" aria-invalid=${here || row === wrong ? "true" : undefined} take=${take}
        value=${() => (here ? refused.text : rounded(units.number(value, kind), 7))} />
    </td>`;
  };
  const tool = (label, text, row, next, disabled = false) => {
    const act = ({ currentTarget }) => {
      const changed = next();
      currentTarget.closest("tbody").rows[Math.min(row, changed.length - 1)].querySelector("input").focus();
      onChange(changed);
    };
    return html`<${Button} kind="quiet small" disabled=${disabled} title=${label} aria-label="${label} ${row + 1}" onClick=${act}>${text}<//>`;
  };
  return html`<table class="history-table">
    <caption class="unseen">Points of the history</caption>
    <thead>
      <tr>
        ${columns.map(([label, kind]) => html`<th scope="col">${label} (${units.label(kind)})</th>`)}
        <th><span class="unseen">Change</span></th>
      </tr>
    </thead>
    <tbody>
      ${rows.map(
        (values, row) => html`<tr>
          ${values.map((value, at) => cell(value, row, at))}
          <td>
            ${tool("Add a point after point", "+", row, () => added(rows, row))}
            ${tool("Remove point", "×", row, () => rows.toSpliced(row, 1), rows.length < 3)}
          </td>
        </tr>`,
      )}
    </tbody>
  </table>`;
});

/** The scales of the sketch, of the time and of each lane: {low, high} of the values, and {from, to} where they are drawn. */
function scalesOf(rows, columns) {
  const times = rows.map((row) => row[0]);
  const end = times.at(-1) > times[0] ? times.at(-1) : times[0] + 1;
  const lanes = [1, 2].map((at) => {
    const values = rows.map((row) => row[at]);
    const [low, most] = [Math.min(0, ...values), Math.max(0, ...values)];
    const span = most - low || { load: 10, speed: 0.1 }[columns[at][1]] || 1e-3;
    const top = GAP + (at - 1) * (LANE + GAP);
    return { low: low - (low < 0 ? 0.12 * span : 0), high: low + 1.12 * span, from: top + LANE, to: top };
  });
  return [{ low: times[0], high: end, from: EDGE, to: WIDE - EDGE }, ...lanes];
}
const drawnAt = ({ low, high, from, to }, value) => from + ((value - low) / (high - low)) * (to - from);
const valueAt = ({ low, high, from, to }, place) => low + ((place - from) / (to - from)) * (high - low);

/** The rows with a point moved to where a pointer is, in coordinates of the sketch. */
function moved({ row, lane, rows, scales: [times, ...lanes] }, at) {
  const step = (lanes[lane].high - lanes[lane].low) / 100;
  const value = Math.round(valueAt(lanes[lane], at.y) / step) * step;
  const least = lane === 0 ? 0 : -Infinity; // no negative loads
  const beat = 10 ** Math.floor(Math.log10((times.high - times.low) / 100));
  const [earliest, latest] = [rows[row - 1]?.[0] ?? 0, rows[row + 1]?.[0] ?? Infinity];
  const time = Math.min(Math.max(Math.round(valueAt(times, at.x) / beat) * beat, earliest), latest);
  return rows.with(row, rows[row].with(0, rounded(time, 9)).with(lane + 1, rounded(Math.max(value, least), 3)));
}

const held = signal(null); // {row, lane, rows, scales} of the point that is dragged

/** The sketch of the rows over time, one lane for each column but the first; its points can be dragged. */
export const Sketch = view(({ rows: given, columns, onChange }) => {
  const { rows, scales } = held.value ?? { rows: given, scales: scalesOf(given, columns) };
  const x = (time) => drawnAt(scales[0], time);
  const y = (value, lane) => drawnAt(scales[lane + 1], value);
  const hold = (event) => {
    const { row, lane } = event.target.dataset;
    if (event.button !== 0 || row === undefined) return;
    event.currentTarget.setPointerCapture(event.pointerId);
    event.preventDefault();
    held.value = { row: Number(row), lane: Number(lane), rows, scales };
  };
  const move = ({ clientX, clientY, currentTarget }) => {
    if (!held.peek()) return;
    const at = new DOMPoint(clientX, clientY).matrixTransform(currentTarget.getScreenCTM().inverse());
    held.value = { ...held.peek(), rows: moved(held.peek(), at) };
  };
  const leave = () => {
    if (held.peek()) onChange(held.peek().rows);
    held.value = null;
  };
  const lanes = [0, 1].map((lane) => {
    const points = rows.map((row) => [x(row[0]), y(row[lane + 1], lane)]);
    const [label, kind] = columns[lane + 1];
    const largest = rows.reduce((most, row) => Math.max(most, Math.abs(row[lane + 1])), 0);
    return html`
      <text x=${EDGE} y=${lane * (LANE + GAP) + GAP - 12}>${label}, largest ${units.show(largest, kind)}</text>
      <line class="base" x1=${EDGE} x2=${WIDE - EDGE} y1=${y(0, lane)} y2=${y(0, lane)} />
      <polyline points=${points.map((one) => one.join(",")).join(" ")} />
      ${points.map(([cx, cy], row) => html`<circle cx=${cx} cy=${cy} r="6" data-row=${row} data-lane=${lane} />`)}
    `;
  });
  const words = columns.map(([label]) => label).join(", ");
  return html`<svg class="history-sketch" viewBox="0 0 ${WIDE} ${2 * (LANE + GAP) + EDGE}" role="img"
    aria-label="Sketch of the history: ${words}. Its points are in the table."
    onPointerDown=${hold} onPointerMove=${move} onPointerUp=${leave} onPointerCancel=${leave}>
    ${lanes}
    <text x=${WIDE - EDGE} y=${GAP - 12} text-anchor="end">to ${units.show(rows.at(-1)[0], "time")}</text>
  </svg>`;
});
