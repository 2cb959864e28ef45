// Figures and numbers of a contact over time: load, indentation, friction, contact, energy, and the friction loop.

const CONTACT = {
  contact_radius: "radius",
  front: "ahead of the axis",
  rear: "behind the axis",
  half_width: "half-width across",
};
const ENERGIES = { work: "work on the material", stored: "stored", dissipated: "dissipated" };
const FORCES = { point: "load", line: "line_load", periodic: "pressure" };
const known = (values) => values?.some((one) => one !== null) ?? false;

/** Position along the motion. */
const along = ({ position_x, position_y, direction }) =>
  position_x.map((x, at) => x * direction[0] + position_y[at] * direction[1]);

const stepsOf = (values) => values.slice(1).map((value, at) => value - values[at]);

/** The figures in a grid; show(result, synthetic) draws a result of the job "motion". */
export function motionFigures({ figures, fields }) {
  const grid = fields.h("div", { class: "grid contact-figures" });
  const made = ["load", "indentation", "friction", "contact", "loop", "energy"].map((id) => {
    const empty = "Not solved yet.";
    const title = `${id[0].toUpperCase()}${id.slice(1)} over time`;
    return [id, figures.figure(grid, { id: `motion-${id}`, title, x: { label: "time", kind: "time" }, y: {}, empty })];
  });
  const handles = Object.fromEntries(made);
  for (const id of ["friction", "loop", "energy"]) handles[id].element.hidden = true;

  function show(result, synthetic) {
    const force = FORCES[result.geometry];
    const time = { label: "time", kind: "time" };
    const line = (name, words = "", error = result[`${name}_error`]) => ({
      name: words,
      x: result.time,
      y: result[name],
      lower: error?.map((one, at) => result[name][at] - one),
      upper: error?.map((one, at) => result[name][at] + one),
    });
    const put = (id, there, title, x, y, traces, caption = "") => {
      handles[id].element.hidden = !there;
      if (there) handles[id].update({ of: result, synthetic, title, x, y, traces, caption });
    };
    const path = along(result);
    const steps = stepsOf(path);
    const slides = steps.some((one) => one !== 0);
    const returns = steps.some((one) => one > 0) && steps.some((one) => one < 0);
    const edges = Object.entries(CONTACT).filter(([name]) => known(result[name]));
    const mean = result.geometry === "periodic" ? "mean pressure" : "normal load";
    const range = [0, 1.08 * Math.max(...result.load) || 1]; // a constant load has no range of its own
    put("load", true, "Load", time, { label: mean, kind: force, range }, [line("load")]);
    put("indentation", true, "Indentation", time, { label: "indentation", kind: "length" }, [line("indentation")]);
    const relative = result.friction_force_error.map((one, at) => (result.load[at] > 0 ? one / result.load[at] : 0));
    const friction = line("friction_coefficient", "", relative);
    put("friction", slides, "Friction coefficient", time, { label: "friction coefficient" }, [friction]);
    const area = { label: "contact area fraction" };
    const size = { label: "size of the contact", kind: "length" };
    const contact = edges.length ? edges.map(([name, words]) => line(name, words)) : [line("contact_area")];
    put("contact", true, "Contact", time, edges.length ? size : area, contact);
    const loop = [{ x: path, y: result.friction_force }];
    const position = { label: "position along the motion", kind: "length" };
    const work = "Its area is the work of friction.";
    put("loop", returns, "Friction loop", position, { label: "friction force", kind: force }, loop, work);
    const energies = Object.entries(ENERGIES).map(([name, words]) => line(name, words, null));
    put("energy", true, "Energy", time, { label: `energy (${result.units.work.replace("m2", "m²")})` }, energies);
  }

  return { grid, show };
}

/** The main numbers of a result, as keyNumbers takes them. */
export function numbersOf(result, units) {
  const { load, friction_coefficient: friction, contacts } = result;
  const force = FORCES[result.geometry];
  const exact = (value, error, kind) => ({
    value: units.show(value, kind, 4),
    remark: error > 1e-9 * Math.abs(value) ? `± ${units.show(error, kind, 2)}` : "",
  });
  const share = { label: "Energy balance error", value: `${units.plainNumber(100 * result.energy_imbalance, 2)} %` };
  if (contacts) {
    const [first] = contacts;
    const stays = first.contact_time === null;
    return [
      { label: "Restitution", ...exact(first.restitution, first.restitution_error) },
      { label: "Contact time", value: stays ? "stays" : units.show(first.contact_time, "time", 4) },
      { label: "Largest force", value: units.show(first.peak_force, force, 4) },
      { label: "Largest indentation", value: units.show(first.largest_indentation, "length", 4) },
      share,
    ];
  }
  const most = friction.reduce((best, value, at) => (Math.abs(value) > Math.abs(friction[best]) ? at : best), 0);
  const error = (at) => (load[at] > 0 ? result.friction_force_error[at] / load[at] : 0);
  const numbers = [
    { label: "Load at the end", ...exact(load.at(-1), result.load_error.at(-1), force) },
    { label: "Indentation at the end", ...exact(result.indentation.at(-1), result.indentation_error.at(-1), "length") },
  ];
  if (friction[most] !== 0) {
    const { value, remark } = exact(friction[most], error(most));
    const when = `after ${units.show(result.time[most] - result.time[0], "time")}`;
    numbers.push({ label: "Largest friction coefficient", value, remark: [remark, when].filter(Boolean).join(", ") });
    numbers.push({ label: "Friction coefficient at the end", ...exact(friction.at(-1), error(friction.length - 1)) });
  }
  const steps = `${result.steps} steps, ${result.rejected_steps} rejected`;
  return [...numbers, { ...share, remark: steps }];
}
