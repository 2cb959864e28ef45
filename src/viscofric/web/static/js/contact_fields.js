// Pictures, numbers and words of one contact: pressure map and profiles, key numbers with errors, and why pressure leans.

const EDGE = "#d55e00";
const MARK = "#8a949e";
// Viridis, out of nothing where there is no pressure.
const VIRIDIS = ["#440154", "#482878", "#3e4989", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6ece58", "#b5de2b", "#fde725"];
const SCALE = [[0, "rgba(68,1,84,0)"], ...VIRIDIS.map((colour, at) => [0.012 + (0.988 * at) / (VIRIDIS.length - 1), colour])];

/** The figures of a contact, in a grid; show(answer, {noun, synthetic}) draws an answer of the job "contact". */
export function contactFigures({ figures, fields }) {
  const length = (label) => ({ label, kind: "length" });
  const grid = fields.h("div", { class: "grid contact-figures" });
  const map = figures.map(grid, {
    id: "pressure-map",
    title: "Contact pressure",
    x: [],
    y: [],
    axes: { x: length("along the motion"), y: { ...length("across"), equal: true }, z: { label: "pressure", kind: "pressure" } },
    empty: "The contact is on its way.",
  });
  const profile = figures.figure(grid, {
    id: "pressure-profile", title: "Pressure along the motion", x: length("along the motion"), y: { label: "pressure", kind: "pressure" },
    empty: "The contact is on its way.",
  });
  const surface = figures.figure(grid, {
    id: "surface-profile", title: "Rubber and indenter", x: length("along the motion"), y: { label: "height", kind: "length" },
    empty: "The contact is on its way.",
  });

  function show(answer, { noun, synthetic }) {
    grid.classList.toggle("without-map", answer.map === null);
    showMap(answer, synthetic);
    showPressure(answer, noun, synthetic);
    showSurface(answer, noun, synthetic);
  }

  function showMap(answer, synthetic) {
    map.element.hidden = answer.map === null;
    if (answer.map === null) return;
    const { x, y, pressure } = answer.map;
    const rough = answer.kind === "rough";
    map.update({
      x, y, z: pressure, synthetic, zero: true, scale: SCALE, smooth: rough ? false : "best",
      axes: { x: length(rough ? "x" : "along the motion"), y: { ...length(rough ? "y" : "across"), equal: true }, z: { label: "pressure", kind: "pressure" } },
      lines: [...outlines(answer), ...axisMarks(answer), ...arrow(answer)],
      caption: rough
        ? "The whole period of the surface; white is out of contact. The arrow is the surface's motion."
        : "Seen from above: outline of the contact, + the indenter's axis, ● where the load acts. It moves to the right, so the leading edge is on the right.",
    });
  }

  const outlines = ({ outline }) => outline.map(({ x, y }) => ({ x, y, mode: "lines", width: 1.5, colour: MARK, legend: false, decoration: true }));

  function axisMarks({ kind, numbers }) {
    if (kind === "rough") return [];
    const point = (x, symbol, colour, size) => ({ x: [x], y: [0], mode: "markers", symbol, colour, size, legend: false, decoration: true });
    return [point(0, "cross-thin", "#ffffff", 12), point(numbers.centre_of_pressure.value, "circle", EDGE, 8)];
  }

  /** An arrow along the motion, in a corner of the map. */
  function arrow({ map: { x, y }, direction }) {
    const [wide, high] = [x.at(-1) - x[0], y.at(-1) - y[0]];
    const size = 0.14 * Math.min(wide, high);
    const [cos, sin] = [Math.cos(direction), Math.sin(direction)];
    const from = [x[0] + 0.05 * wide + (cos < 0 ? size : 0), y.at(-1) - 0.06 * high - (sin > 0 ? size : 0)];
    const tip = [from[0] + size * cos, from[1] + size * sin];
    const barb = (turn) => [tip[0] - 0.35 * size * Math.cos(direction + turn), tip[1] - 0.35 * size * Math.sin(direction + turn)];
    const places = [from, tip, barb(0.5), tip, barb(-0.5)];
    return [{ x: places.map(([one]) => one), y: places.map(([, one]) => one), mode: "lines", width: 2.5, colour: EDGE, legend: false, decoration: true }];
  }

  function showPressure(answer, noun, synthetic) {
    const { x, pressure } = answer.profile;
    const rough = answer.kind === "rough";
    const ends = rough ? [x[0], x.at(-1)] : viewed(answer);
    const inside = x.map((place) => place >= ends[0] && place <= ends[1]);
    const kept = (values) => values.filter((_, at) => inside[at]);
    const traces = [{ name: "pressure", x: kept(x), y: kept(pressure), fill: "tozeroy", colour: "blue" }];
    if (!rough) {
      // Symmetric pressure makes no friction: what differs from the mirror image does.
      const mirrored = kept(x).map((place) => -place).reverse();
      traces.push({ name: "the same, mirrored", x: mirrored, y: kept(pressure).reverse(), dash: "3px,3px", width: 1.3, colour: MARK, decoration: true });
    }
    const marks = rough ? [] : [{ x: 0 }, { x: answer.numbers.centre_of_pressure.value, label: "load acts here" }];
    profile.update({
      traces, marks, synthetic, x: { ...length(rough ? "x" : "along the motion"), range: ends }, y: { label: "pressure", kind: "pressure" },
      title: rough ? "Pressure along x, through the highest peak" : "Pressure along the motion",
      caption: rough ? "" : "On the centre line; motion to the right, the indenter's axis at zero. What differs from the mirror image makes the friction.",
    });
  }

  function showSurface(answer, noun, synthetic) {
    const { x, surface: rubber, indenter } = answer.profile;
    const there = indenter.map((height) => height !== null);
    const kept = (values) => values.filter((_, at) => there[at]);
    const rough = answer.kind === "rough";
    const low = Math.min(...rubber.filter((height) => height !== null));
    const high = Math.max(...rubber.filter((height) => height !== null));
    const top = rough ? undefined : high + 0.6 * (high - low);
    const near = kept(indenter).map((height) => (top === undefined || height <= top ? height : null));
    surface.update({
      traces: [
        { name: noun, x: kept(x), y: near, colour: MARK, width: 2 },
        { name: "rubber", x, y: rubber, colour: "vermilion", width: 2.5 },
      ],
      synthetic, x: length(rough ? "x" : "along the motion"), y: { label: "height", kind: "length" },
      title: rough ? "Rubber and surface along x" : "Rubber and indenter along the motion",
      caption: rough
        ? "Heights are drawn larger than lengths; the cut goes through the highest pressure."
        : "Motion to the right; heights are drawn larger than lengths. Behind the contact the rubber has not recovered yet: its trail.",
    });
  }

  /** From where to where the pressure is shown: the contact and a little more, the same on either side. */
  function viewed({ numbers }) {
    const reach = 1.12 * Math.max(Math.abs(numbers.front.value), Math.abs(numbers.rear.value));
    return [-reach, reach];
  }

  return { grid, show };
}

/** Numbers of an answer, {label, value, remark} each: the few that answer the question, and the others. */
export function numbersOf(answer, units) {
  const of = answer.numbers;
  const one = (name, label, kind, digits = 4) => {
    const { value, error } = of[name];
    return { label, value: units.show(value, kind, digits), remark: error ? `± ${units.show(error, kind, 2)}` : "" };
  };
  const plain = (value, unit, digits = 3) => `${units.plainNumber(value, digits)}${unit ? `\u00a0${unit}` : ""}`;
  const row = (label, value, remark = "") => ({ label, value, remark });
  const friction = one("friction_coefficient", "Friction coefficient μ");
  const rubber = [
    row("Shift factor α(T)", plain(of.shift_factor.value)),
    row("Loss factor tan δ there", plain(of.loss_factor.value)),
    one("storage_modulus", "Storage modulus E′ there", "modulus", 3),
  ];
  const balance = row("Energy balance", plain(100 * Math.abs(of.energy_balance.value), "%", 2), "apart, of two ways to μ");
  if (answer.kind === "rough") {
    const [points, asked] = [of.points.value, of.points_asked.value];
    return {
      key: [
        friction,
        row("Real contact", plain(100 * of.contact_area_fraction.value, "%"), "of the area"),
        one("mean_contact_pressure", "Mean pressure in contact", "pressure", 3),
        one("mean_gap", "Mean gap", "length"),
      ],
      others: [
        { ...one("max_pressure", "Largest pressure", "pressure", 3), remark: "on this grid" },
        one("lateral_friction_coefficient", "Force to the side, over the load"),
        row("Heat", plain(of.power.value, "W/m²")),
        one("slowest_frequency", "Frequency of the longest wave", "angular_frequency", 3),
        one("fastest_frequency", "Frequency of the shortest wave", "angular_frequency", 3),
        ...rubber,
        balance,
        row("Points along an edge", String(points), points < asked ? `of ${asked}: coarse` : ""),
      ],
    };
  }
  const line = answer.kind === "line";
  const peak = one("max_pressure", "Largest pressure", "pressure");
  return {
    key: [
      friction,
      one("indentation", "Indentation", "length"),
      one("contact_area", line ? "Contact width" : "Contact area", line ? "length" : "area"),
      answer.peak_resolved ? peak : { ...peak, value: `≥ ${peak.value}`, remark: "not resolved" },
    ],
    others: [
      one("friction_force", line ? "Friction force per length" : "Friction force", line ? "line_load" : "load"),
      row("Heat", plain(of.power.value, line ? "W/m" : "W"), of.power.error ? `± ${plain(of.power.error, line ? "W/m" : "W", 2)}` : ""),
      one("front", "Leading edge ahead of axis", "length"),
      one("rear", "Trailing edge behind axis", "length"),
      ...(line ? [] : [one("half_width", "Half width", "length")]),
      one("centre_of_pressure", "Load acts ahead of axis", "length", 3),
      one("mean_pressure", "Mean pressure", "pressure", 3),
      one("frequency", "Frequency v/a", "angular_frequency", 3),
      ...rubber,
      balance,
      row("Cells along an edge", String(of.cells.value)),
    ],
  };
}

/** Why the pressure leans forward, in sentences that follow the numbers. */
export function whyItLeans(answer, units, noun, radius) {
  const of = answer.numbers;
  const speed = units.show(answer.speed, "speed");
  const loss = of.loss_factor.value;
  const rubber = `tan δ ${units.plainNumber(loss, 2)} and a stiffness E′ of ${units.show(of.storage_modulus.value, "modulus")}`;
  if (answer.kind === "rough") {
    const ends = [of.slowest_frequency, of.fastest_frequency].map(({ value }) => units.show(value, "angular_frequency", 2));
    return (
      `At ${speed}, the longest wave of the surface deforms the rubber at ${ends[0]}, the shortest at ${ends[1]}, where it has ${rubber}. ` +
      "On the flanks that face the motion the rubber is pressed in and resists; behind the summits it has not sprung back yet and pushes less. " +
      `That difference, over ${units.plainNumber(100 * of.contact_area_fraction.value, 3)} % of the area, is the friction: μ = ${units.plainNumber(of.friction_coefficient.value, 3)}.`
    );
  }
  const [front, rear, lean] = [of.front, of.rear, of.centre_of_pressure].map(({ value }) => units.show(value, "length"));
  const time = units.show((of.front.value + of.rear.value) / answer.speed, "time", 2);
  const start = `The ${noun} passes each point of the rubber in ${time}, which deforms it at v/a = ${units.show(of.frequency.value, "angular_frequency", 2)}. There the rubber has ${rubber}. `;
  const cause =
    loss < 0.03
      ? "It hardly loses energy at that rate, so that it springs back behind the contact almost as it was pressed in ahead, and the pressure hardly leans. "
      : "Ahead of the axis it is being pressed in and resists; behind, it has not sprung back yet and pushes less. ";
  const edges = `So the contact reaches ${front} ahead of the axis and ${rear} behind it, and the load acts ${lean} ahead`;
  const friction = units.plainNumber(of.friction_coefficient.value, 3);
  const lever = radius ? `: that over the radius of ${units.show(radius, "length")} is the friction, μ = ${friction}.` : `, on slopes that push back: μ = ${friction}.`;
  return start + cause + edges + lever;
}
