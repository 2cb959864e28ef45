// Pictures of one contact: the map of its pressure with outline and motion, and cuts along the motion.

const EDGE = "#d55e00";
const MARK = "#8a949e";
// Viridis, out of nothing where there is no pressure.
const VIRIDIS = [
  "#440154",
  "#482878",
  "#3e4989",
  "#31688e",
  "#26828e",
  "#1f9e89",
  "#35b779",
  "#6ece58",
  "#b5de2b",
  "#fde725",
];
const SCALE = [
  [0, "rgba(68,1,84,0)"],
  ...VIRIDIS.map((colour, at) => [0.012 + (0.988 * at) / (VIRIDIS.length - 1), colour]),
];

/** The figures of a contact, in a grid; show(result, {noun, synthetic}) draws a result of the job "contact". */
export function contactFigures({ figures, fields }) {
  const length = (label) => ({ label, kind: "length" });
  const grid = fields.h("div", { class: "grid contact-figures" });
  const map = figures.map(grid, {
    id: "pressure-map",
    title: "Contact pressure",
    x: [],
    y: [],
    axes: {
      x: length("along the motion"),
      y: { ...length("across"), equal: true },
      z: { label: "pressure", kind: "pressure" },
    },
    empty: "Computing the contact.",
  });
  const profile = figures.figure(grid, {
    id: "pressure-profile",
    title: "Pressure along the motion",
    x: length("along the motion"),
    y: { label: "pressure", kind: "pressure" },
    empty: "Computing the contact.",
  });
  const surface = figures.figure(grid, {
    id: "surface-profile",
    title: "Rubber and indenter",
    x: length("along the motion"),
    y: { label: "height", kind: "length" },
    empty: "Computing the contact.",
  });

  function show(result, { noun, synthetic }) {
    grid.classList.toggle("without-map", result.map === null);
    showMap(result, synthetic);
    showPressure(result, noun, synthetic);
    showSurface(result, noun, synthetic);
  }

  function showMap(result, synthetic) {
    map.element.hidden = result.map === null;
    if (result.map === null) return;
    const { x, y, pressure } = result.map;
    const rough = result.kind === "rough";
    map.update({
      of: result,
      x,
      y,
      z: pressure,
      synthetic,
      zero: true,
      scale: SCALE,
      smooth: rough ? false : "best",
      axes: {
        x: length(rough ? "x" : "along the motion"),
        y: { ...length(rough ? "y" : "across"), equal: true },
        z: { label: "pressure", kind: "pressure" },
      },
      lines: [...outlines(result), ...axisMarks(result), ...arrow(result)],
      caption: rough
        ? "One period of the surface; white is not in contact. The arrow is the surface's motion."
        : "Top view: outline of the contact, + the indenter's axis, ● the centre of pressure. The indenter moves to the right; the leading edge is on the right.",
    });
  }

  const outlines = ({ outline }) =>
    outline.map(({ x, y }) => ({ x, y, mode: "lines", width: 1.5, colour: MARK, legend: false, decoration: true }));

  function axisMarks({ kind, numbers }) {
    if (kind === "rough") return [];
    const point = (x, symbol, colour, size) => ({
      x: [x],
      y: [0],
      mode: "markers",
      symbol,
      colour,
      size,
      legend: false,
      decoration: true,
    });
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
    return [
      {
        x: places.map(([one]) => one),
        y: places.map(([, one]) => one),
        mode: "lines",
        width: 2.5,
        colour: EDGE,
        legend: false,
        decoration: true,
      },
    ];
  }

  function showPressure(result, noun, synthetic) {
    const { x, pressure } = result.profile;
    const rough = result.kind === "rough";
    const ends = rough ? [x[0], x.at(-1)] : viewed(result);
    const inside = x.map((place) => place >= ends[0] && place <= ends[1]);
    const kept = (values) => values.filter((_, at) => inside[at]);
    const traces = [{ name: "pressure", x: kept(x), y: kept(pressure), fill: "tozeroy", colour: "blue" }];
    if (!rough) {
      // Symmetric pressure makes no friction: what differs from the mirror image does.
      const mirrored = kept(x)
        .map((place) => -place)
        .reverse();
      traces.push({
        name: "mirror image",
        x: mirrored,
        y: kept(pressure).reverse(),
        dash: "3px,3px",
        width: 1.3,
        colour: MARK,
        decoration: true,
      });
    }
    const marks = rough ? [] : [{ x: 0 }, { x: result.numbers.centre_of_pressure.value, label: "centre of pressure" }];
    profile.update({
      of: result,
      traces,
      marks,
      synthetic,
      x: { ...length(rough ? "x" : "along the motion"), range: ends },
      // with room for the words at the top
      y: { label: "pressure", kind: "pressure", range: [0, 1.15 * Math.max(...kept(pressure), 1e-9)] },
      title: rough ? "Pressure along x, through the highest peak" : "Pressure along the motion",
      caption: rough
        ? ""
        : "On the centre line; motion to the right, the indenter's axis at zero. The difference from the mirror image causes the friction.",
    });
  }

  function showSurface(result, noun, synthetic) {
    const { x, surface: rubber, indenter } = result.profile;
    const there = indenter.map((height) => height !== null);
    const kept = (values) => values.filter((_, at) => there[at]);
    const rough = result.kind === "rough";
    const low = Math.min(...rubber.filter((height) => height !== null));
    const high = Math.max(...rubber.filter((height) => height !== null));
    const top = rough ? undefined : high + 0.6 * (high - low);
    const near = kept(indenter).map((height) => (top === undefined || height <= top ? height : null));
    surface.update({
      of: result,
      traces: [
        { name: noun, x: kept(x), y: near, colour: MARK, width: 2 },
        { name: "rubber", x, y: rubber, colour: "vermilion", width: 2.5 },
      ],
      synthetic,
      x: length(rough ? "x" : "along the motion"),
      y: { label: "height", kind: "length" },
      title: rough ? "Rubber and surface along x" : "Rubber and indenter along the motion",
      caption: rough
        ? "Heights are exaggerated; the section goes through the highest pressure."
        : "Motion to the right; heights are exaggerated. Behind the contact the rubber has not recovered yet (the trail).",
    });
  }

  /** From where to where the pressure is shown: the contact and a little more, the same on either side. */
  function viewed({ numbers }) {
    const reach = 1.12 * Math.max(Math.abs(numbers.front.value), Math.abs(numbers.rear.value));
    return [-reach, reach];
  }

  return { grid, show };
}
