// What a friction figure draws of a curve: points as they become known, bands and doubts at the end, other curves in grey.
//
// A curve is {layout, columns, result}: curves of its cases (figures/curve.py) and what is known of each so far; result is
// null until all is known.  A look is {view: "speed" | "shifted", quantity, combination}.

import * as units from "./units.js";

const GREY = "grey";
// a curve on its way: what is known to the accuracy filled, what lies between contacts that may be refined open
const DRAFT = [
  { y: "friction", mode: "lines", width: 1, legend: false, dash: "3px,3px" },
  { y: "known", mode: "markers", size: 6 },
  { y: "open", mode: "markers", size: 5, open: true, legend: false },
];
const COLUMNS = ["y", "lower", "upper", "error", "text"];

const isThere = (value) => value !== null && value !== undefined;
const along = (layout, view) => (view === "shifted" ? layout.reduced_speed : layout.speed);
const ofCombination = ({ layout }, { combination }) =>
  layout.curves.filter((curve) => curve.combination === combination);

/** A part of a curve at those of its rows that have a value; its columns are named. */
function placed({ layout, columns }, view, rows, part) {
  const data = rows.filter((at) => isThere(columns[part.y]?.[at]));
  const read = (values) => (at) => (Array.isArray(values) ? values[at] : values);
  const found = COLUMNS.filter((name) => part[name]).map((name) => [
    name,
    data.map(read(columns[part[name]] ?? part[name])),
  ]);
  return { ...part, data, x: data.map(read(along(layout, view))), ...Object.fromEntries(found) };
}

/** All speeds of the cases, with a little space: a figure that stays where it is while points come. */
export function speedsOf(curve, look) {
  const all = ofCombination(curve, look).flatMap(({ rows }) => rows.map((at) => along(curve.layout, look.view)[at]));
  const gap = all.length > 1 ? 1.15 : 3;
  return [Math.min(...all) / gap, Math.max(...all) * gap];
}

/** The traces of a curve: a line for each temperature, and rings around what is doubtful. */
export function curveTraces(curve, look) {
  const { view, quantity } = look;
  const { result } = curve;
  const parts = result ? result.parts[quantity] : quantity === "friction" ? DRAFT : [];
  const lines = ofCombination(curve, look).flatMap(({ temperature, rows }) =>
    parts.map((part) => ({ temperature, group: `T${temperature}`, ...placed(curve, view, rows, part) })),
  );
  // the legend is there from the start
  const shown = lines.filter((trace) => trace.x.length > 0 || trace.legend !== false);
  return result ? [...masterLine(result, look), ...shown, ...ringed(curve, look)] : shown;
}

function ringed(curve, look) {
  const rows = ofCombination(curve, look)
    .flatMap((one) => one.rows)
    .filter((at) => curve.result.doubts[at].length > 0);
  const ring = { mode: "markers", symbol: "circle", open: true, size: 13, colour: "orange", decoration: true };
  const trace = placed(curve, look.view, rows, { name: "doubtful", y: look.quantity, text: "remarks", ...ring });
  return trace.x.length ? [trace] : [];
}

function masterLine({ master }, { view, quantity }) {
  if (view !== "shifted" || quantity !== "friction" || !master) return [];
  const { reduced_speed: x, friction: y, lower, upper } = master;
  return [{ name: "master curve", x, y, lower, upper, mode: "lines", colour: GREY, width: 1.2 }];
}

/** Another curve in grey; none where something else than friction is shown. */
export function ghostTraces(curve, look, name, dash) {
  if (!curve?.layout || look.quantity !== "friction") return [];
  const combination = Math.min(look.combination, curve.layout.combinations.length - 1);
  const part = { y: "friction", mode: "lines", colour: GREY, width: 1.6, dash, decoration: true, name, group: name };
  return ofCombination(curve, { combination }).map(({ rows }, index) => ({
    ...placed(curve, look.view, rows, part),
    legend: index === 0,
  }));
}

/** Where the live contact is on the curve. */
export function liveTrace(live, { view, quantity }) {
  if (!live || quantity !== "friction") return [];
  const { friction_coefficient: friction, reduced_speed: reduced } = live.numbers;
  const star = { mode: "markers", symbol: "star", size: 13, colour: "purple", decoration: true };
  const x = view === "shifted" ? reduced.value : live.speed;
  return [
    { name: "live contact", x: [x], y: [friction.value], text: [units.show(live.temperature, "temperature")], ...star },
  ];
}
