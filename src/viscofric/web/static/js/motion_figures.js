// Figures and numbers of a contact over time: load, indentation, friction, contact, energy, and the friction loop.

import { Figure } from "./figures.js";
import { html, view } from "./reactive.js";
import * as units from "./units.js";

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

/** What the figures show of a result of the job "motion": {id: {title, x, y, traces, caption}}, null for one without sense. */
function figuresOf(result) {
  const force = FORCES[result.geometry];
  const line = (name, words = "", error = result[`${name}_error`]) => ({
    name: words,
    x: result.time,
    y: result[name],
    lower: error?.map((one, at) => result[name][at] - one),
    upper: error?.map((one, at) => result[name][at] + one),
  });
  const path = along(result);
  const steps = stepsOf(path);
  const slides = steps.some((one) => one !== 0);
  const returns = steps.some((one) => one > 0) && steps.some((one) => one < 0);
  const edges = Object.entries(CONTACT).filter(([name]) => known(result[name]));
  const relative = result.friction_force_error.map((one, at) => (result.load[at] > 0 ? one / result.load[at] : 0));
  return {
    load: {
      // a constant load has no range of its own
      y: {
        label: result.geometry === "periodic" ? "mean pressure" : "normal load",
        kind: force,
        range: [0, 1.08 * Math.max(...result.load) || 1],
      },
      traces: [line("load")],
    },
    indentation: { y: { label: "indentation", kind: "length" }, traces: [line("indentation")] },
    friction: slides && {
      title: "Friction coefficient",
      y: { label: "friction coefficient" },
      traces: [line("friction_coefficient", "", relative)],
    },
    contact: {
      y: edges.length ? { label: "size of the contact", kind: "length" } : { label: "contact area fraction" },
      traces: edges.length ? edges.map(([name, words]) => line(name, words)) : [line("contact_area")],
    },
    loop: returns && {
      title: "Friction loop",
      x: { label: "position along the motion", kind: "length" },
      y: { label: "friction force", kind: force },
      traces: [{ x: path, y: result.friction_force }],
      caption: "Its area is the work of friction.",
    },
    energy: {
      y: { label: `energy (${result.units.work.replace("m2", "m²")})` },
      traces: Object.entries(ENERGIES).map(([name, words]) => line(name, words, null)),
    },
  };
}

/** The figures of a result, or empty frames of those that there are always. */
export const Figures = view(({ of, synthetic }) => {
  const shared = { of, synthetic, x: { label: "time", kind: "time" }, y: {}, empty: "Not solved yet." };
  const found = of ? figuresOf(of) : { load: {}, indentation: {}, contact: {} };
  const title = (id) => `${id[0].toUpperCase()}${id.slice(1)}${of ? "" : " over time"}`;
  return html`<div class="grid contact-figures">
    ${Object.entries(found).map(
      ([id, one]) => one && html`<${Figure} key=${id} ...${shared} id="motion-${id}" title=${title(id)} ...${one} />`,
    )}
  </div>`;
});

/** The main numbers of a result, [{label, value, remark}]. */
export function numbersOf(result) {
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
