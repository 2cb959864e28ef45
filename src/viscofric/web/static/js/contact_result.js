// What is shown of one contact: its numbers with their errors, why the pressure leans forward, the map of the pressure with
// outline and motion, and cuts along the motion.

import { Figure } from "./figures.js";
import { html, view } from "./reactive.js";
import * as units from "./units.js";

const EDGE = "#d55e00";
const MARK = "#8a949e";
const PRESSURE = { label: "pressure", kind: "pressure" };
const length = (label) => ({ label, kind: "length" });
const aside = { legend: false, decoration: true };

/** The figures of a result of the job "contact", or their empty frames. */
export const Pictures = view(({ of, noun, synthetic, children }) => {
  const shared = {
    of,
    synthetic,
    empty: "Computing the contact.",
    x: length(of?.kind === "rough" ? "x" : "along the motion"),
  };
  return html`<div class="grid contact-figures ${of && !of.map ? "without-map" : ""}">
    ${of?.map !== null && html`<${Figure} id="pressure-map" title="Contact pressure" ...${shared} ...${mapOf(of)} />`}
    <${Figure} id="pressure-profile" title="Pressure along the motion" y=${PRESSURE} ...${shared} ...${pressureOf(of)} />
    <${Figure} id="surface-profile" title="Rubber and indenter" y=${length("height")} ...${shared} ...${surfaceOf(of, noun)} />
    ${children}
  </div>`;
});

function mapOf(result) {
  const rough = result?.kind === "rough";
  const axes = {
    x: length(rough ? "x" : "along the motion"),
    y: { ...length(rough ? "y" : "across"), equal: true },
    z: PRESSURE,
  };
  if (!result) return axes;
  const { x, y, pressure: z } = result.map;
  return {
    ...axes,
    map: { x, y, z, smooth: rough ? false : "best" },
    traces: [...outlines(result), ...axisMarks(result), ...arrow(result)],
    caption: rough
      ? "One period of the surface; white is not in contact. The arrow is the surface's motion."
      : "Top view: outline of the contact, + the indenter's axis, ● the centre of pressure. The indenter moves to the right; the leading edge is on the right.",
  };
}

const outlines = ({ outline }) =>
  outline.map(({ x, y }) => ({ x, y, mode: "lines", width: 1.5, colour: MARK, ...aside }));

function axisMarks({ kind, numbers }) {
  if (kind === "rough") return [];
  const point = (x, symbol, colour, size) => ({ x: [x], y: [0], mode: "markers", symbol, colour, size, ...aside });
  return [point(0, "cross-thin", "#ffffff", 12), point(numbers.centre_of_pressure.value, "circle", EDGE, 8)];
}

/** An arrow along the motion, in a corner of the map. */
function arrow({ map: { x, y }, direction }) {
  const [wide, high] = [x.at(-1) - x[0], y.at(-1) - y[0]];
  const size = 0.14 * Math.min(wide, high);
  const [cos, sin] = [Math.cos(direction), Math.sin(direction)];
  const from = [x[0] + 0.05 * wide + (cos < 0 ? size : 0), y.at(-1) - 0.06 * high - (sin > 0 ? size : 0)];
  const tip = [from[0] + size * cos, from[1] + size * sin];
  const barb = (turn) => [
    tip[0] - 0.35 * size * Math.cos(direction + turn),
    tip[1] - 0.35 * size * Math.sin(direction + turn),
  ];
  const places = [from, tip, barb(0.5), tip, barb(-0.5)];
  const [along, across] = [0, 1].map((axis) => places.map((place) => place[axis]));
  return [{ x: along, y: across, mode: "lines", width: 2.5, colour: EDGE, ...aside }];
}

/** On the centre line; symmetric pressure makes no friction: what differs from the mirror image does. */
function pressureOf(result) {
  if (!result) return {};
  const { x, pressure } = result.profile;
  const { front, rear, centre_of_pressure: centre } = result.numbers;
  const rough = result.kind === "rough";
  // the contact and a little more, the same on either side
  const reach = rough ? 0 : 1.12 * Math.max(Math.abs(front.value), Math.abs(rear.value));
  const ends = rough ? [x[0], x.at(-1)] : [-reach, reach];
  const kept = (values) => values.filter((_, at) => x[at] >= ends[0] && x[at] <= ends[1]);
  const [places, pressures] = [kept(x), kept(pressure)];
  const trace = { name: "pressure", x: places, y: pressures, fill: "tozeroy", colour: "blue" };
  const y = { ...PRESSURE, range: [0, 1.15 * Math.max(...pressures, 1e-9)] }; // with room for the words at the top
  if (rough)
    return {
      y,
      x: { ...length("x"), range: ends },
      traces: [trace],
      title: "Pressure along x, through the highest peak",
    };
  const mirrored = {
    name: "mirror image",
    x: places.map((place) => -place).reverse(),
    y: pressures.toReversed(),
    ...{ dash: "3px,3px", width: 1.3, colour: MARK, decoration: true },
  };
  return {
    y,
    x: { ...length("along the motion"), range: ends },
    traces: [trace, mirrored],
    marks: [{ x: 0 }, { x: centre.value, label: "centre of pressure" }],
    caption:
      "On the centre line; motion to the right, the indenter's axis at zero. The difference from the mirror image causes the friction.",
  };
}

function surfaceOf(result, noun) {
  if (!result) return {};
  const { x, surface: rubber, indenter } = result.profile;
  const kept = (values) => values.filter((_, at) => indenter[at] !== null);
  const rough = result.kind === "rough";
  const heights = rubber.filter((height) => height !== null);
  const [low, high] = [Math.min(...heights), Math.max(...heights)];
  const top = rough ? Infinity : high + 0.6 * (high - low);
  const near = kept(indenter).map((height) => (height <= top ? height : null));
  return {
    traces: [
      { name: noun, x: kept(x), y: near, colour: MARK, width: 2 },
      { name: "rubber", x, y: rubber, colour: "vermilion", width: 2.5 },
    ],
    title: rough ? "Rubber and surface along x" : "Rubber and indenter along the motion",
    caption: rough
      ? "Heights are exaggerated; the section goes through the highest pressure."
      : "Motion to the right; heights are exaggerated. Behind the contact the rubber has not recovered yet (the trail).",
  };
}

/** Numbers of a result, {label, value, remark} each: the main ones, and the others. */
export function numbersOf(result) {
  const of = result.numbers;
  const one = (name, label, kind, digits = 4) => {
    const { value, error } = of[name];
    return { label, value: units.show(value, kind, digits), remark: error ? `± ${units.show(error, kind, 2)}` : "" };
  };
  const plain = (value, unit, digits = 3) => `${units.plainNumber(value, digits)}${unit ? `\u00a0${unit}` : ""}`;
  const row = (label, value, remark = "") => ({ label, value, remark });
  const friction = one("friction_coefficient", "Friction coefficient μ");
  const rubber = [
    row("Shift factor α(T)", plain(of.shift_factor.value)),
    row("Loss tangent tan δ at v/a", plain(of.loss_factor.value)),
    one("storage_modulus", "Storage modulus E′ at v/a", "modulus", 3),
  ];
  const balance = row("Energy balance error", plain(100 * Math.abs(of.energy_balance.value), "%", 2));
  if (result.kind === "rough") {
    const full = of.contact_area_fraction.value > 1 - 1e-9;
    const gap = one("mean_gap", "Mean gap", "length", 3);
    const aside = one("lateral_friction_coefficient", "Lateral force over load");
    const [points, requested] = [of.points.value, of.points_requested.value];
    return {
      key: [
        friction,
        row("Contact area fraction", plain(100 * of.contact_area_fraction.value, "%")),
        one("mean_contact_pressure", "Mean pressure in contact", "pressure", 3),
        full ? { ...gap, value: "none", remark: "full contact" } : gap,
      ],
      others: [
        { ...one("max_pressure", "Maximum pressure", "pressure", 3), remark: "on this grid" },
        Math.abs(of.lateral_friction_coefficient.value) < 1e-12 ? { ...aside, value: "0" } : aside,
        row("Dissipated power", plain(of.power.value, "W/m²")),
        one("slowest_frequency", "Frequency of the longest wave", "angular_frequency", 3),
        one("fastest_frequency", "Frequency of the shortest wave", "angular_frequency", 3),
        ...rubber,
        balance,
        row("Points along an edge", String(points), points < requested ? `of ${requested}: coarse` : ""),
      ],
    };
  }
  const line = result.kind === "line";
  const peak = one("max_pressure", "Maximum pressure", "pressure");
  return {
    key: [
      friction,
      one("indentation", "Indentation", "length"),
      one("contact_area", line ? "Contact width" : "Contact area", line ? "length" : "area"),
      result.peak_resolved ? peak : { ...peak, value: `≥ ${peak.value}`, remark: "not resolved" },
    ],
    others: [
      one("friction_force", line ? "Friction force per length" : "Friction force", line ? "line_load" : "load"),
      row(
        "Dissipated power",
        plain(of.power.value, line ? "W/m" : "W"),
        of.power.error ? `± ${plain(of.power.error, line ? "W/m" : "W", 2)}` : "",
      ),
      one("front", "Leading edge ahead of axis", "length"),
      one("rear", "Trailing edge behind axis", "length"),
      ...(line ? [] : [one("half_width", "Contact half-width", "length")]),
      one("centre_of_pressure", "Centre of pressure ahead of axis", "length", 3),
      one("mean_pressure", "Mean pressure", "pressure", 3),
      one("frequency", units.filled("Frequency {v/a}"), "angular_frequency", 3),
      ...rubber,
      balance,
      row("Cells along an edge", String(of.cells.value)),
    ],
  };
}

/** The cause of the asymmetric pressure, in sentences that follow the numbers. */
export function whyItLeans(result, noun, radius) {
  const of = result.numbers;
  const speed = units.show(result.speed, "speed");
  const loss = of.loss_factor.value;
  const rubber = `tan δ ${units.plainNumber(loss, 2)} and a storage modulus E′ of ${units.show(of.storage_modulus.value, "modulus")}`;
  if (result.kind === "rough") {
    const ends = [of.slowest_frequency, of.fastest_frequency].map(({ value }) =>
      units.show(value, "angular_frequency", 2),
    );
    return (
      `At ${speed}, the longest wave of the surface deforms the rubber at ${ends[0]}, the shortest at ${ends[1]}, where the rubber has ${rubber}. ` +
      "On the leading flanks the rubber is being compressed and resists; behind the summits it has not recovered yet, and the pressure is lower. " +
      `This difference, over ${units.plainNumber(100 * of.contact_area_fraction.value, 3)} % of the area, causes the friction: μ = ${units.plainNumber(of.friction_coefficient.value, 3)}.`
    );
  }
  const [front, rear, lean] = [of.front, of.rear, of.centre_of_pressure].map(({ value }) =>
    units.show(value, "length"),
  );
  const time = units.show((of.front.value + of.rear.value) / result.speed, "time", 2);
  const start = `The ${noun} passes each point of the rubber in ${time}, which deforms it at ${units.filled("{v/a}")} = ${units.show(of.frequency.value, "angular_frequency", 2)}. At this frequency the rubber has ${rubber}. `;
  const cause =
    loss < 0.03
      ? "It dissipates little energy at this frequency and recovers almost completely behind the contact, so that the pressure is nearly symmetric. "
      : "Ahead of the axis it is being compressed and resists; behind, it has not recovered yet, and the pressure is lower. ";
  const edges = `The contact therefore extends ${front} ahead of the axis and ${rear} behind it, and the resultant lies ${lean} ahead`;
  const friction = units.plainNumber(of.friction_coefficient.value, 3);
  const lever = radius
    ? `; divided by the radius of ${units.show(radius, "length")}, this is the friction coefficient, μ = ${friction}.`
    : `, where the slope opposes the motion: μ = ${friction}.`;
  return start + cause + edges + lever;
}
