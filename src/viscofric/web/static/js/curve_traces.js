// What a friction figure draws of a curve: points as they become known, bands and doubts at the end, other curves in grey.
//
// A curve is {layout, points, result}: columns of its cases; friction and whether it is known, of each; all that is known
// of them in the end, or null.  A look is {view: "speed" | "shifted", quantity, combination}.

const GREY = "#8a949e";
const WORDS = {
  extrapolated: "it depends on frequencies at which the material was not measured",
  shift: "the shift factor is extrapolated beyond the temperatures of the sweeps",
  strain: "the contact is wide or steep: the small-strain assumption is doubtful",
  unresolved: "the grid does not resolve it: its numerical error is more than twice the requested accuracy",
};

/** What can be shown of cases, with its label. */
export const QUANTITIES = {
  friction: { label: "friction coefficient μ" },
  indentation: { label: "indentation", kind: "length" },
  contact_area: { label: "contact area", kind: "area" },
  contact_area_fraction: { label: "contact area fraction" },
  max_pressure: { label: "maximum pressure", kind: "pressure" },
  mean_gap: { label: "mean gap", kind: "length" },
  heated_friction: { label: "friction coefficient μ with heating" },
  temperature_rise: { label: "rise of temperature (K)" },
  interface_friction: { label: "friction coefficient of the interface" },
  total_friction: { label: "total friction coefficient" },
};
const OF_TABLES = ["heated_friction", "temperature_rise", "interface_friction", "total_friction"];

/** Label and kind of a quantity; the contact area of a line contact is its width. */
export function quantityOf(name, { kind }) {
  return name === "contact_area" && kind === "line" ? { label: "contact width", kind: "length" } : QUANTITIES[name];
}

/** Whether a kind of contact has a quantity. */
export function hasQuantity(name, { kind, extra }) {
  if (OF_TABLES.includes(name)) return (extra ?? []).includes(name);
  return !(kind === "rough" ? ["indentation", "contact_area"] : ["contact_area_fraction", "mean_gap"]).includes(name);
}

/** Rows of one combination by temperature, each in the order of the speeds. */
export function curvesOf(layout, combination) {
  const found = new Map();
  layout.temperature.forEach((kelvin, at) => {
    if (layout.combination[at] !== combination) return;
    if (!found.has(kelvin)) found.set(kelvin, []);
    found.get(kelvin).push(at);
  });
  for (const rows of found.values()) rows.sort((one, other) => layout.speed[one] - layout.speed[other]);
  return [...found].sort(([one], [other]) => one - other);
}

/** All speeds of the cases, with a little space: a figure that stays where it is while points come. */
export function speedsOf({ layout }, { view, combination }) {
  const all = along(layout, view).filter((_, at) => layout.combination[at] === combination);
  const gap = all.length > 1 ? 1.15 : 3;
  return [Math.min(...all) / gap, Math.max(...all) * gap];
}

const along = (layout, view) => (view === "shifted" ? layout.reduced_speed : layout.speed);
const isThere = (value) => value !== null && value !== undefined;

/** Rows that have a value, and where to draw them. */
function placed(layout, view, rows, values) {
  const there = rows.filter((at) => isThere(values[at]));
  return { data: there, x: there.map((at) => along(layout, view)[at]), y: there.map((at) => values[at]) };
}

/** The traces of a curve: a line for each temperature, and rings around what is doubtful. */
export function curveTraces(curve, look, { units, temperatureColour }) {
  const lines = curvesOf(curve.layout, look.combination).flatMap(([kelvin, rows]) => {
    const shared = { temperature: kelvin, group: `T${kelvin}`, name: units.show(kelvin, "temperature") };
    if (curve.result) return [{ ...shared, ...finished(curve, look, rows) }, ...beside(curve, look, rows, shared)];
    return drafted(curve, look, rows, shared, temperatureColour(kelvin, curve.layout.temperature));
  });
  return [...masterLine(curve, look), ...lines, ...ringed(curve, look)];
}

function finished({ layout, result }, { view, quantity }, rows) {
  const trace = { ...placed(layout, view, rows, result[quantity] ?? []), mode: "lines+markers", size: 6 };
  trace.text = trace.data.map((at) => doubtsOf(result, at));
  if (quantity !== "friction") return trace;
  const of = (column) => trace.data.map((at) => column[at]);
  const banded = result.lower?.some(isThere);
  return { ...trace, ...(banded ? { lower: of(result.lower), upper: of(result.upper) } : { error: of(result.error) }) };
}

/** The isothermal friction beside the heated one, and the parts of a rise: Coulomb friction dashed, loss dotted. */
function beside({ layout, result }, { view, quantity }, rows, shared) {
  const parts = {
    heated_friction: [["friction", "6px,4px", "isothermal"]],
    temperature_rise: [
      ["coulomb_rise", "6px,4px", "by Coulomb friction"],
      ["loss_rise", "2px,3px", "by the loss"],
    ],
  };
  return (parts[quantity] ?? []).map(([name, dash, words]) => {
    const trace = placed(layout, view, rows, result[name] ?? []);
    const style = { mode: "lines", width: 1.2, dash, legend: false, text: trace.data.map(() => words) };
    return { ...shared, ...trace, ...style };
  });
}

/** A curve on its way: what is known to the accuracy filled, what lies between contacts that may be refined open. */
function drafted({ layout, points }, { view, quantity }, rows, shared, colour) {
  if (quantity !== "friction") return [];
  const known = rows.filter((at) => points.known[at]);
  const open = rows.filter((at) => !points.known[at]);
  const of = (some) => placed(layout, view, some, points.friction);
  return [
    { ...shared, ...of(rows), mode: "lines", width: 1, legend: false, dash: "3px,3px" },
    { ...shared, ...of(known), mode: "markers", size: 6 },
    { ...shared, ...of(open), mode: "markers", size: 5, open: true, legend: false, colour },
  ].filter((trace) => trace.x.length > 0 || trace.legend !== false); // the legend is there from the start
}

const doubtsOf = (result, at) => result.doubts[at].map((word) => WORDS[word] ?? word).join("<br>");

function ringed({ layout, result }, { view, quantity, combination }) {
  const rows = (result?.doubts ?? []).flatMap((words, at) =>
    words.length > 0 && layout.combination[at] === combination ? [at] : [],
  );
  const trace = placed(layout, view, rows, result?.[quantity] ?? []);
  if (trace.x.length === 0) return [];
  const text = trace.data.map((at) => doubtsOf(result, at));
  const ring = { mode: "markers", symbol: "circle", open: true, size: 13, colour: "orange", decoration: true };
  return [{ name: "doubtful", ...trace, ...ring, text }];
}

function masterLine({ result }, { view, quantity }) {
  if (view !== "shifted" || quantity !== "friction" || !result?.master) return [];
  const { reduced_speed: x, friction: y, lower, upper } = result.master;
  const band = lower ? { lower, upper } : {};
  return [{ name: "master curve", x, y, ...band, mode: "lines", colour: GREY, width: 1.2 }];
}

/** Another curve in grey; none where something else than friction is shown. */
export function ghostTraces(curve, look, name, dash) {
  if (!curve?.layout || look.quantity !== "friction") return [];
  const number = Math.min(look.combination, curve.layout.combinations.length - 1);
  return curvesOf(curve.layout, number).map(([, rows], index) => {
    const { x, y } = placed(curve.layout, look.view, rows, curve.points.friction);
    return {
      name,
      x,
      y,
      legend: index === 0,
      group: name,
      mode: "lines",
      colour: GREY,
      width: 1.6,
      dash,
      decoration: true,
    };
  });
}

/** Where the live contact is on the curve. */
export function liveTrace(live, { view, quantity }, units) {
  if (!live || quantity !== "friction") return [];
  const { friction_coefficient: friction, reduced_speed: reduced } = live.numbers;
  const star = { mode: "markers", symbol: "star", size: 13, colour: "purple", decoration: true };
  const x = view === "shifted" ? reduced.value : live.speed;
  return [
    { name: "live contact", x: [x], y: [friction.value], text: [units.show(live.temperature, "temperature")], ...star },
  ];
}

/** From zero to a little above all that is drawn. */
export function valuesOf(traces) {
  const all = traces.flatMap((trace) => [...trace.y, ...(trace.upper ?? [])]).filter(isThere);
  return [0, 1.06 * Math.max(...all, 1e-12)];
}
