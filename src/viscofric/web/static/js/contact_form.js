// The form of a contact: shape, load, layer, speeds and temperatures, all of them keys of the study's document.

import { uploadFiles } from "./api.js";
import { Amount, Choose, Form, Range, Ticks, Toggle, where, within } from "./fields.js";
import { announce } from "./page.js";
import { computed, html, signal, view } from "./reactive.js";
import { state } from "./state.js";
import { Card, Drop, Notes } from "./views.js";

const quantity = (path, label, kind, more = {}) => ({ path, label, kind, ...more });
const number = (path, label, more = {}) => ({ as: Amount, path, label, ...more });

const SHAPES = [
  ["ball", "Ball"],
  ["cylinder", "Cylinder (line contact)"],
  ["ellipsoid", "Ellipsoid"],
  ["cone", "Cone"],
  ["made", "Rough surface, generated"],
  ["scan", "Rough surface, measured"],
];
const POINTS = ["ball", "ellipsoid", "cone"];
const ROUGH = ["made", "scan"];

// What each shape begins with; a study keeps what it had of another shape as long as the page is open.
const FIRST = {
  ball: { indenter: { shape: "ball", radius: "9.525 mm" }, load: "10 N" },
  cylinder: { indenter: { shape: "cylinder", radius: "9.525 mm" }, load: "2 N/mm" },
  ellipsoid: { indenter: { shape: "ellipsoid", radius_x: "5 mm", radius_y: "10 mm" }, load: "25 N" },
  cone: { indenter: { shape: "cone", angle: "10 deg" }, load: "25 N" },
  made: {
    surface: {
      hurst: 0.8,
      rms_slope: 0.2,
      shortest: "80 um",
      rolloff: "640 um",
      points: 128,
      spacing: "10 um",
      seed: 1,
    },
    pressure: "0.5 MPa",
  },
  scan: { surface: { file: "", prepare: ["fill", "remove tilt", "window"] }, pressure: "0.5 MPa" },
};

// What each law of the interface begins with.
const LAWS = {
  constant: { law: "constant", stress: "0.1 MPa" },
  power: { law: "power", stress: "0.1 MPa", exponent: 0.1, speed: "1 mm/s" },
  eyring: { law: "eyring", activation_volume: "20 nm**3", speed: "1 um/s" },
  gaussian: { law: "gaussian", peak: "0.1 MPa", width: 2, speed: "10 mm/s" },
  best: { law: "best" },
};

/** What is in contact: "ball" … "cone", "made" or "scan". */
export function shapeOf(study) {
  if (study.surface) return study.surface.file === undefined ? "made" : "scan";
  return study.indenter?.shape ?? "ball";
}

const shape = computed(() => shapeOf(state.study));
const of = (shapes, ...fields) => where(() => shapes.includes(shape.value), ...fields);
const left = new Map(); // what the study had of other shapes

function become(next) {
  const { indenter, surface, conditions } = state.study;
  const { load, pressure, direction, ...others } = conditions ?? {};
  left.set(shape.value, { indenter, surface, load, pressure });
  const begun = left.get(next) ?? FIRST[next];
  // point contacts share their load; that of a line is per length
  const shares = [shape.value, next].every((one) => POINTS.includes(one));
  const loads = { load: (shares && load) || begun.load, pressure: begun.pressure };
  const kept = Object.fromEntries(Object.entries({ ...others, ...loads }).filter(([, value]) => value !== undefined));
  state.change({ indenter: begun.indenter, surface: begun.surface, conditions: kept });
}

const load = (label, kind, slider) => ({ path: "conditions.load", label, kind, as: Range, slider });
const elastic = (table, label) => [
  {
    ...{ path: `${table}.modulus`, label, as: Toggle, value: "200 GPa" },
    onChange: (modulus) =>
      state.change({
        [`${table}.modulus`]: modulus,
        ...(modulus === undefined ? { [`${table}.poisson_ratio`]: undefined } : {}),
      }),
  },
  ...within(
    `${table}.modulus`,
    quantity(`${table}.modulus`, "Young's modulus", "modulus"),
    number(`${table}.poisson_ratio`, "Poisson's ratio", { min: 0, max: 0.5, step: 0.01, placeholder: "0.3" }),
  ),
];

const SHAPE = [
  {
    id: "contact-shape",
    path: "indenter.shape",
    label: "Shape",
    as: Choose,
    options: SHAPES,
    shown: () => shape.value,
    onChange: become,
  },
  ...of(["ball", "cylinder"], quantity("indenter.radius", "Radius", "length", { slider: [1e-4, 1] })),
  ...of(
    ["ellipsoid"],
    quantity("indenter.radius_x", "Radius along the motion", "length"),
    quantity("indenter.radius_y", "Radius across", "length"),
  ),
  ...of(["cone"], quantity("indenter.angle", "Angle of the flank", "angle", { help: "to the undeformed surface" })),
  ...of(
    ["made"],
    number("surface.hurst", "Hurst exponent", { min: 0, max: 1, step: 0.05 }),
    number("surface.rms_slope", "Rms slope", { min: 0, step: 0.01 }),
    quantity("surface.rolloff", "Roll-off wavelength", "length"),
    quantity("surface.shortest", "Shortest wavelength", "length"),
    number("surface.points", "Points along an edge", { min: 8, step: 1 }),
    quantity("surface.spacing", "Spacing of points", "length"),
    number("surface.seed", "Seed", { min: 0, step: 1, help: "of the random number generator" }),
  ),
];
const SCAN = of(
  ["scan"],
  { path: "surface.file", label: "File", placeholder: "none yet" },
  {
    path: "surface.prepare",
    label: "Preparation",
    as: Ticks,
    options: [
      ["fill", "fill gaps"],
      ["remove tilt", "remove tilt"],
      ["remove curvature", "remove curvature"],
      ["window", "window the edges"],
    ],
  },
  { path: "surface.unit", label: "Unit of heights", placeholder: "from the file" },
  quantity("surface.spacing", "Spacing of points", "length", { placeholder: "from the file" }),
);
const LOAD = [
  ...of(POINTS, load("Load", "load", [0.01, 1e4])),
  ...of(["cylinder"], load("Load per length", "line_load", [10, 1e6])),
  ...of(
    ROUGH,
    { path: "conditions.pressure", label: "Mean pressure", kind: "pressure", as: Range, slider: [1e3, 1e8] },
    quantity("conditions.direction", "Direction of motion", "angle", { placeholder: "along x" }),
  ),
  ...of([...POINTS, "cylinder"], ...elastic("indenter", "Elastic indenter")),
  ...of(ROUGH, ...elastic("surface", "Elastic surface")),
  { path: "layer", label: "Layer on a rigid base", as: Toggle, value: { thickness: "2 mm" } },
  ...within("layer", quantity("layer.thickness", "Thickness", "length"), {
    path: "layer.base",
    label: "Base",
    as: Choose,
    otherwise: "bonded",
    options: ["bonded", ["sliding", "sliding, no friction"]],
  }),
];

const CONDITIONS = [
  { path: "conditions.speed", label: "Speed", kind: "speed", as: Range, otherwise: { to: "1 m/s", points: 25 } },
  {
    path: "conditions.temperature",
    label: "Temperature",
    kind: "temperature",
    as: Range,
    spacing: ["linear"],
    otherwise: { to: "90 degC", points: 3 },
  },
  {
    path: "solver.accuracy",
    label: "Accuracy",
    as: Choose,
    otherwise: 1e-3,
    options: [
      [0.05, "5 %"],
      [0.02, "2 %"],
      [0.01, "1 %"],
      [1e-3, "0.1 %"],
      [1e-4, "0.01 %, slow"],
    ],
    help: "numerical; the band shows the material's uncertainty",
  },
];

/** A constant of some laws; also shown where it is left of another law, so that it can be emptied. */
const ofLaw = (field) => {
  const key = field.path.split(".")[1];
  const has = ({ law = "best", ...given }) => (law !== "best" && key in LAWS[law]) || given[key] !== undefined;
  return where(() => has(state.get("interface") ?? {}), field)[0];
};
const INTERFACE = [
  { path: "interface", label: "Friction of a dry interface", as: Toggle, value: LAWS.power },
  ...within(
    "interface",
    {
      path: "interface.law",
      label: "Law of the shear stress",
      as: Choose,
      options: [
        "constant",
        ["power", "power of the slip speed"],
        ["eyring", "Eyring"],
        ["gaussian", "Gaussian (Persson)"],
        ["best", "fitted to measured Coulomb friction"],
      ],
      otherwise: "best",
      onChange: (law) => state.set("interface", { ...LAWS[law], slip: state.get("interface.slip") }),
    },
    ofLaw(quantity("interface.stress", "Shear stress", "pressure")),
    ofLaw(quantity("interface.peak", "Largest shear stress", "pressure")),
    ofLaw(number("interface.exponent", "Exponent", { min: -1, step: 0.01 })),
    ofLaw(number("interface.width", "Width in decades", { min: 0, step: 0.1 })),
    ofLaw({ path: "interface.activation_volume", label: "Activation volume" }),
    ofLaw(quantity("interface.speed", "At the slip speed", "speed")),
    quantity("interface.slip", "Slip speed", "speed", { placeholder: "the speed, as in pure sliding" }),
  ),
];

const passed = () => state.get("heating.track_radius") !== undefined || state.get("heating.passes") !== undefined;
/** Where an interface makes the heat, Coulomb friction and its slip are those of the interface. */
const alone = (field) =>
  where(() => state.get("interface") === undefined || state.get(field.path) !== undefined, field)[0];
/** The nominal contact is that of a rough surface; a value left by another shape can be seen and emptied. */
const nominal = () => ROUGH.includes(shape.value) || state.get("heating.nominal_radius") !== undefined;
const HEATING = [
  { path: "heating", label: "Friction heats the contact", as: Toggle, value: { counterface: "steel" } },
  ...within(
    "heating",
    {
      path: "heating.counterface",
      label: "Thermal properties of the indenter",
      help: "steel, PTFE (typical handbook values), or 46 W/m/K, 7810 kg/m^3, 475 J/kg/K",
    },
    { path: "heating.rubber", label: "Thermal properties of the rubber", placeholder: "filled rubber" },
    alone(number("heating.coulomb", "Coulomb friction", { min: 0, step: 0.01, placeholder: "0" })),
    alone(quantity("heating.slip", "Sliding velocity", "speed", { placeholder: "the speed" })),
    ...where(
      nominal,
      quantity("heating.nominal_radius", "Radius of the nominal contact", "length", {
        placeholder: "mean heat left out",
        help: "The mean heat of this round area of the surface counts too.",
      }),
    ),
    ...where(() => POINTS.includes(shape.value) || passed(), {
      path: "heating.track_radius",
      label: "Circular track",
      as: Toggle,
      value: "20 mm",
      help: "The rubber is passed again and again, as on a disc.",
      shown: passed,
      onChange: (radius) =>
        state.change({ "heating.track_radius": radius, "heating.passes": radius === undefined ? undefined : 100 }),
    }),
    ...where(passed, quantity("heating.track_radius", "Radius of the track", "length"), {
      path: "heating.passes",
      label: "Earlier passes",
      read: (text) => (/^\s*\d+\s*$/.test(text) ? Number(text) : text.trim()),
      help: "A whole number, or inf for the final state.",
    }),
    {
      path: "heating.average",
      label: "Temperature of the rubber",
      as: Choose,
      otherwise: "loss",
      options: [
        ["loss", "where the loss is released"],
        ["contact", "mean of the face"],
      ],
    },
    {
      path: "heating.branch",
      label: "Thermal branch",
      as: Choose,
      otherwise: "cold",
      options: [
        ["cold", "cold: the speed rises"],
        ["hot", "hot: the speed falls"],
      ],
      help: "for contacts that have two states",
    },
  ),
];

const failed = signal(null); // why a height map could not be brought

async function bring(files) {
  try {
    const [name] = await uploadFiles(files.slice(0, 1));
    state.set("surface.file", name);
    announce(`${name} was uploaded.`);
    failed.value = null;
  } catch (error) {
    failed.value = error.message;
  }
}

export const ContactForm = view(() => {
  const help = "text matrix, x y z points, or a microscope file";
  const take = (files) => bring(files);
  return html`
    <${Card} title="Indenter or surface">
      <${Form} of=${SHAPE} />
      ${
        shape.value === "scan" &&
        html`<${Drop} label="Drop a height map" help=${help} multiple=${false} onFiles=${take} />
          <${Notes} kind="error" list=${[failed.value]} /><${Form} of=${SCAN} />`
      }
      <${Form} of=${LOAD} />
    <//>
    <${Card} title="Speeds and temperatures"><${Form} of=${CONDITIONS} /><//>
    <${Card} title="Interface and heat"><${Form} of=${INTERFACE} /><${Form} of=${HEATING} /><//>
  `;
});
