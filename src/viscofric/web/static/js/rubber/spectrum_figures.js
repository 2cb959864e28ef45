// What the figures and the table of the spectrum and the modulus show.

import { html, view } from "../reactive.js";
import * as units from "../units.js";
import { Table } from "../views.js";
import { named } from "./made.js";

const SHOWN = 1e-10; // modes weaker than the strongest by more change nothing that can be seen

export function keyNumbers({ spectrum, band }) {
  if (!spectrum.modes) return [{ label: "material", value: "a table of moduli", remark: "without modes" }];
  const error = (value) => (band && value ? `± ${units.show(value, "modulus", 2)} (95 %)` : "");
  const { fit } = spectrum;
  const all = [
    {
      label: "E₀, relaxed",
      value: units.show(spectrum.modes.E0, "modulus"),
      remark: [error(band?.E0_error95), fit?.E0_remark].filter(Boolean).join("; "),
    },
    {
      label: "E∞, glassy",
      value: units.show(spectrum.modes.E_inf, "modulus"),
      remark: [error(band?.E_inf_error95), fit?.E_inf_remark].filter(Boolean).join("; "),
    },
    {
      label: "modes",
      value: String(spectrum.modes.retardation_time.length),
      remark: fit?.method ?? "from the material file",
    },
    { label: "Poisson’s ratio", value: String(spectrum.poisson_ratio), remark: "" },
  ];
  if (fit && fit.rms_storage !== null)
    all.splice(3, 0, {
      label: "misfit of E′, E″",
      value: `${fit.rms_storage.toFixed(3)}, ${fit.rms_loss.toFixed(3)}`,
      remark: "decades, rms",
    });
  if (fit && fit.rms_step !== null && fit.rms_step !== undefined)
    all.splice(3, 0, { label: "misfit of the step tests", value: fit.rms_step.toFixed(3), remark: "decades, rms" });
  return all;
}

export function caption(result, here) {
  const parts = [];
  if (here.band) parts.push(`95 % bands of each modulus (${here.band.draws} bootstrap samples).`);
  if (here.moved) parts.push("Points: all measurements, shifted to this temperature.");
  if (here.isotherm) parts.push(`Filled points: the sweep measured at ${named(here.isotherm.temperature)}.`);
  const range = result.spectrum.fit?.frequency_range;
  if (range) parts.push("Beyond the points the spectrum is extrapolated.");
  return parts.join(" ");
}

const MODULI = [
  ["storage_modulus", "E′", "square", "blue"],
  ["loss_modulus", "E″", "circle", "vermilion"],
];

export function modulusTraces({ modulus, band, moved, isotherm }) {
  const lines = MODULI.map(([key, name, , colour]) => ({
    name,
    colour,
    x: modulus.angular_frequency,
    y: modulus[key],
    ...(band ? { lower: band[`${key}_lower`], upper: band[`${key}_upper`] } : {}),
  }));
  const points = moved
    ? MODULI.map(([key, name, symbol, colour]) => ({
        name: `${name} measured`,
        mode: "markers",
        open: true,
        symbol,
        colour,
        size: 4,
        x: moved.angular_frequency,
        y: moved[key],
      }))
    : [];
  const sweep = isotherm
    ? MODULI.map(([key, name, symbol, colour]) => ({
        name: `${name} of this sweep`,
        legend: false,
        mode: "markers",
        symbol,
        colour,
        size: 7,
        x: isotherm.angular_frequency,
        y: isotherm[key],
      }))
    : [];
  return [...points, ...lines, ...sweep];
}

export function tangentTraces({ modulus, band, moved, isotherm }) {
  const line = {
    name: "tan δ",
    colour: "green",
    x: modulus.angular_frequency,
    y: modulus.loss_tangent,
    ...(band ? { lower: band.loss_tangent_lower, upper: band.loss_tangent_upper } : {}),
  };
  const points = moved
    ? [
        {
          name: "measured",
          mode: "markers",
          open: true,
          symbol: "diamond",
          colour: "green",
          size: 4,
          x: moved.angular_frequency,
          y: moved.loss_tangent,
        },
      ]
    : [];
  const sweep = isotherm
    ? [
        {
          name: "this sweep",
          legend: false,
          mode: "markers",
          symbol: "diamond",
          colour: "green",
          size: 7,
          x: isotherm.angular_frequency,
          y: isotherm.loss_tangent,
        },
      ]
    : [];
  return [...points, line, ...sweep];
}

export const residualTraces = ({ measured, residual }) =>
  MODULI.map(([key, name, symbol, colour]) => ({
    name,
    mode: "markers",
    symbol,
    colour,
    open: true,
    size: 5,
    x: measured.angular_frequency,
    y: residual[key],
  }));

/** A stem for each mode, with its band and the times that no measured frequency reaches. */
export function modesFigure(result, kind, synthetic) {
  const { spectrum, band } = result;
  const retardation = kind === "retardation";
  const { modes, relaxation } = spectrum;
  const [tau, strength] = retardation
    ? [modes.retardation_time, modes.creep_coefficient]
    : [relaxation.relaxation_time, relaxation.modulus];
  const strongest = Math.max(...strength);
  const seen = strength.map((value, at) => at).filter((at) => strength[at] > SHOWN * strongest);
  const floor = Math.min(...seen.map((at) => strength[at])) / 2;
  const stems = { x: [], y: [] };
  for (const at of seen) {
    stems.x.push(tau[at], tau[at], null);
    stems.y.push(floor, strength[at], null);
  }
  const colour = retardation ? "blue" : "vermilion";
  const traces = [
    { name: "stems", legend: false, decoration: true, colour, width: 1.2, ...stems },
    {
      name: retardation ? "C_k" : "E_k",
      mode: "markers",
      symbol: retardation ? "circle" : "square",
      colour,
      size: 7,
      x: seen.map((at) => tau[at]),
      y: seen.map((at) => strength[at]),
    },
  ];
  if (retardation && band?.modes) {
    const inside = band.modes.retardation_time.map((_, at) => at).filter((at) => band.modes.upper[at] > floor);
    traces.unshift({
      name: "95 % band",
      colour: "sky",
      width: 0,
      x: inside.map((at) => band.modes.retardation_time[at]),
      y: inside.map((at) => band.modes.upper[at]),
      lower: inside.map((at) => Math.max(band.modes.lower[at], floor)),
      upper: inside.map((at) => band.modes.upper[at]),
    });
  }
  const range = spectrum.fit?.frequency_range;
  return {
    title: retardation ? "Retardation modes" : "Relaxation modes (Prony series)",
    caption: `${retardation ? "Compliance C of each mode over its retardation time." : "Modulus E of each mode over its relaxation time; the same material, converted exactly."} ${range ? "The measured frequencies cover the times between the dotted lines." : ""} ${retardation && band?.modes ? "A single mode is poorly determined, since its neighbours can replace it." : ""}`,
    y: retardation ? { label: "compliance C (1/Pa)", log: true } : { label: "modulus E", kind: "modulus", log: true },
    marks: range
      ? [
          { x: 1 / range[1], label: "measured from" },
          { x: 1 / range[0], label: "to" },
        ]
      : [],
    synthetic,
    traces,
  };
}

export const ModesTable = view(({ of }) => {
  const { modes, relaxation } = of.spectrum;
  const count = Math.max(modes.retardation_time.length, relaxation.relaxation_time.length);
  const cell = (values, at) => (at < values.length ? values[at].toExponential(4).replace("-", "−") : "");
  const rows = Array.from({ length: count }, (_, at) => [
    String(at + 1),
    cell(modes.retardation_time, at),
    cell(modes.creep_coefficient, at),
    cell(relaxation.relaxation_time, at),
    cell(relaxation.modulus, at),
  ]);
  const head = ["k", "retardation time τ (s)", "compliance C (1/Pa)", "relaxation time (s)", "modulus E (Pa)"];
  return html`<${Table} of=${of} head=${head} rows=${rows} caption="Retardation modes, and the same material as a Prony series" />`;
});
