// The form of a contact: shape, load, layer, speeds and temperatures, all of them keys of the study's document.

import { effect } from "./reactive.js";

const SHAPES = [
  ["ball", "Ball"],
  ["cylinder", "Cylinder (line contact)"],
  ["ellipsoid", "Ellipsoid"],
  ["cone", "Cone"],
  ["made", "Rough surface, generated"],
  ["scan", "Rough surface, measured"],
];

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

/** Its name in a sentence. */
export function nounOf(study) {
  const shape = shapeOf(study);
  return shape === "made" || shape === "scan" ? "rough surface" : shape;
}

/** Build the form; returns its cards. */
export function contactForm({ state, fields, api, announce }) {
  const { h, card, rangeField, choiceField, toggleField } = fields;
  const quantity = (path, label, kind, more = {}) => fields.quantityField({ path, label, kind, ...more });
  const number = (path, label, min, step, more = {}) => fields.numberField({ path, label, min, step, ...more });
  const left = new Map(); // what the study had of other shapes

  const select = h(
    "select",
    { id: "contact-shape" },
    SHAPES.map(([value, text]) => h("option", { value }, text)),
  );
  select.addEventListener("change", () => become(select.value));

  function become(shape) {
    const { study } = state;
    const conditions = { ...study.conditions };
    const { load, pressure } = conditions;
    left.set(shapeOf(study), { indenter: study.indenter, surface: study.surface, load, pressure });
    const next = left.get(shape) ?? FIRST[shape];
    for (const key of ["load", "pressure", "direction"]) delete conditions[key];
    if (next.load !== undefined) conditions.load = sameLoad(next, load, shapeOf(study), shape);
    if (next.pressure !== undefined) conditions.pressure = next.pressure;
    state.change({ indenter: next.indenter, surface: next.surface, conditions });
  }

  /** Point contacts share their load; that of a line is per length. */
  function sameLoad(next, load, before, after) {
    const points = ["ball", "ellipsoid", "cone"];
    return points.includes(before) && points.includes(after) && load !== undefined ? load : next.load;
  }

  // Every group is made once, and shown for its shapes.
  const groups = [];
  const group = (shapes, ...children) => {
    const element = h("div", { class: "form" }, ...children);
    groups.push([shapes, element]);
    return element;
  };
  const indenters = ["ball", "cylinder", "ellipsoid", "cone"];
  const shape = [
    group(["ball", "cylinder"], quantity("indenter.radius", "Radius", "length")),
    group(
      ["ellipsoid"],
      quantity("indenter.radius_x", "Radius along the motion", "length"),
      quantity("indenter.radius_y", "Radius across", "length"),
    ),
    group(["cone"], quantity("indenter.angle", "Angle of the flank", "angle", { help: "to the undeformed surface" })),
    group(
      ["made"],
      number("surface.hurst", "Hurst exponent", 0, 0.05, { max: 1 }),
      number("surface.rms_slope", "Rms slope", 0, 0.01),
      quantity("surface.rolloff", "Roll-off wavelength", "length"),
      quantity("surface.shortest", "Shortest wavelength", "length"),
      number("surface.points", "Points along an edge", 8, 1),
      quantity("surface.spacing", "Spacing of points", "length"),
      number("surface.seed", "Seed", 0, 1, { help: "of the random number generator" }),
    ),
    group(["scan"], ...scan()),
  ];

  function scan() {
    const problem = fields.note([]);
    const take = async (files) => {
      try {
        const [name] = await api.uploadFiles(files.slice(0, 1));
        state.set("surface.file", name);
        announce(`${name} was uploaded.`);
        problem.set([]);
      } catch (error) {
        problem.set([error.message], "error");
      }
    };
    const drop = fields.fileDrop({
      label: "Drop a height map",
      help: "text matrix, x y z points, or a microscope file",
      multiple: false,
      onFiles: take,
    });
    const steps = [
      ["fill", "fill gaps"],
      ["remove tilt", "remove tilt"],
      ["remove curvature", "remove curvature"],
      ["window", "window the edges"],
    ];
    const boxes = steps.map(([step, text]) => {
      const box = h("input", { type: "checkbox" });
      const show = () => (box.checked = [state.get("surface.prepare") ?? []].flat().includes(step));
      box.addEventListener("change", () => {
        const now = [state.get("surface.prepare") ?? []].flat();
        const next = steps.map(([one]) => one).filter((one) => (one === step ? box.checked : now.includes(one)));
        state.set("surface.prepare", [...next, ...now.filter((one) => !steps.some(([known]) => known === one))]);
      });
      effect(show);
      return h("label", { class: "row" }, box, text);
    });
    return [
      drop,
      problem,
      fields.textField({ path: "surface.file", label: "File", placeholder: "none yet" }),
      h("fieldset", {}, h("legend", { class: "field-label" }, "Preparation"), boxes),
      fields.textField({ path: "surface.unit", label: "Unit of heights", placeholder: "from the file" }),
      quantity("surface.spacing", "Spacing of points", "length", { placeholder: "from the file" }),
    ];
  }

  const load = [
    group(["ball", "ellipsoid", "cone"], rangeField({ path: "conditions.load", label: "Load", kind: "load" })),
    group(["cylinder"], rangeField({ path: "conditions.load", label: "Load per length", kind: "line_load" })),
    group(
      ["made", "scan"],
      rangeField({ path: "conditions.pressure", label: "Mean pressure", kind: "pressure" }),
      quantity("conditions.direction", "Direction of motion", "angle", { placeholder: "along x" }),
    ),
  ];

  /** Fields that are there only with their table or key. */
  function optional(path, ...children) {
    const element = h("div", { class: "form" }, ...children);
    const show = () => (element.hidden = state.get(path) === undefined);
    effect(show);
    return element;
  }

  const layer = [
    toggleField({ path: "layer", label: "Layer on a rigid base", value: { thickness: "2 mm" } }),
    optional(
      "layer",
      quantity("layer.thickness", "Thickness", "length"),
      choiceField({
        path: "layer.base",
        label: "Base",
        otherwise: "bonded",
        options: [
          ["bonded", "bonded"],
          ["sliding", "sliding, no friction"],
        ],
      }),
    ),
  ];
  const elastic = ["indenter", "surface"].map((table) =>
    group(
      table === "indenter" ? indenters : ["made", "scan"],
      toggleField({
        path: `${table}.modulus`,
        label: table === "indenter" ? "Elastic indenter" : "Elastic surface",
        value: "200 GPa",
      }),
      optional(
        `${table}.modulus`,
        quantity(`${table}.modulus`, "Young's modulus", "modulus"),
        number(`${table}.poisson_ratio`, "Poisson's ratio", 0, 0.01, { max: 0.5, placeholder: "0.3" }),
      ),
    ),
  );

  const becomeLaw = (law) => state.set("interface", { ...LAWS[law], slip: state.get("interface.slip") });
  const interfaceFields = [
    toggleField({ path: "interface", label: "Friction of a dry interface", value: LAWS.power }),
    optional(
      "interface",
      choiceField({
        path: "interface.law",
        label: "Law of the shear stress",
        options: [
          ["constant", "constant"],
          ["power", "power of the slip speed"],
          ["eyring", "Eyring"],
          ["gaussian", "Gaussian (Persson)"],
          ["best", "fitted to measured Coulomb friction"],
        ],
        otherwise: "best",
        onChange: becomeLaw,
      }),
      optional("interface.stress", quantity("interface.stress", "Shear stress", "pressure")),
      optional("interface.peak", quantity("interface.peak", "Largest shear stress", "pressure")),
      optional("interface.exponent", number("interface.exponent", "Exponent", -1, 0.01)),
      optional("interface.width", number("interface.width", "Width in decades", 0, 0.1)),
      optional(
        "interface.activation_volume",
        fields.textField({ path: "interface.activation_volume", label: "Activation volume" }),
      ),
      optional("interface.speed", quantity("interface.speed", "At the slip speed", "speed")),
      quantity("interface.slip", "Slip speed", "speed", { placeholder: "the speed, as in pure sliding" }),
    ),
  ];
  const heating = [
    toggleField({ path: "heating", label: "Friction heats the contact", value: { counterface: "steel" } }),
    optional(
      "heating",
      fields.textField({
        path: "heating.counterface",
        label: "Thermal properties of the indenter",
        help: "steel, PTFE (typical handbook values), or 46 W/m/K, 7810 kg/m^3, 475 J/kg/K",
      }),
      fields.textField({ path: "heating.rubber", label: "Thermal properties of the rubber", placeholder: "filled rubber" }),
      number("heating.coulomb", "Coulomb friction", 0, 0.01, { placeholder: "0, or that of the interface" }),
      quantity("heating.slip", "Sliding velocity", "speed", { placeholder: "the speed, or that of the interface" }),
      choiceField({
        path: "heating.average",
        label: "Temperature of the rubber",
        otherwise: "contact",
        options: [
          ["contact", "mean of the face"],
          ["loss", "where the loss is released"],
        ],
      }),
    ),
  ];

  const accuracy = choiceField({
    path: "solver.accuracy",
    label: "Accuracy",
    otherwise: 1e-3,
    options: [
      [0.05, "5 %"],
      [0.02, "2 %"],
      [0.01, "1 %"],
      [1e-3, "0.1 %"],
      [1e-4, "0.01 %, slow"],
    ],
    help: "numerical; the band shows the material's uncertainty",
  });

  const show = () => {
    const now = shapeOf(state.study);
    select.value = now;
    for (const [shapes, element] of groups) element.hidden = !shapes.includes(now);
  };
  effect(show);

  return [
    card(
      "Indenter or surface",
      h("div", { class: "field" }, h("label", { for: select.id, class: "field-label" }, "Shape"), select),
      ...shape,
      ...load,
      ...elastic,
      ...layer,
    ),
    card(
      "Speeds and temperatures",
      rangeField({ path: "conditions.speed", label: "Speed", kind: "speed", otherwise: { to: "1 m/s", points: 25 } }),
      rangeField({
        path: "conditions.temperature",
        label: "Temperature",
        kind: "temperature",
        spacing: ["linear"],
        otherwise: { to: "90 degC", points: 3 },
      }),
      accuracy,
    ),
    card("Interface and heat", ...interfaceFields, ...heating),
  ];
}
