// What the figures, numbers and tables of the data show, as they were read.

import { html, view } from "../reactive.js";
import { state } from "../state.js";
import * as units from "../units.js";
import { Folded, Table } from "../views.js";
import { byTemperature, isothermTraces, named } from "./made.js";

const MOST_ROWS = 200;
const OVER_FREQUENCY = { label: "frequency", kind: "angular_frequency", log: true };
const MODULI = [
  ["storage_modulus", "storage modulus", "′"],
  ["loss_modulus", "loss modulus", "″"],
  ["loss_tangent", "loss tangent tan δ", ""],
];
const capital = (words) => words[0].toUpperCase() + words.slice(1);
const madeUp = () => state.get("data_origin") === "synthetic";

/** "20 °C to 90 °C"; one of them where both are the same, and a dash without any. */
function span(values, kind) {
  if (!values?.length) return "–";
  return [...new Set([Math.min(...values), Math.max(...values)])].map((end) => units.show(end, kind)).join(" to ");
}

/** The main numbers of what was read. */
export function numbersOf(result) {
  const { source, isotherms, ramps, steps, left_open: open } = result;
  if (source !== "dma" && !ramps && !steps) {
    const { name, synthetic, reference } = result;
    const none = reference === null;
    return [
      { label: "material", value: name || "unnamed", remark: synthetic ? "synthetic, not measured" : "" },
      {
        label: "reference",
        value: none ? "none" : named(reference),
        remark: none ? "valid at one temperature only" : "",
      },
    ];
  }
  const asked = open.includes("deformation");
  const deformation =
    asked && !state.get("material.deformation")
      ? { value: "?", remark: "please select tension or shear" }
      : { value: result.deformation, remark: asked ? "as given" : "from the file" };
  const curves = source === "dma" ? isotherms : (ramps ?? steps.curves);
  const kelvin = curves.flatMap((one) => one.temperature);
  const over = ramps || source === "dma" ? "angular_frequency" : "time";
  const values = curves.flatMap((one) => one[over]);
  const numbers = [
    { label: "measured in", ...deformation },
    {
      label: { dma: "isotherms", ramps: "frequencies" }[source] ?? "tests",
      value: String(curves.length),
      remark: span(kelvin, "temperature"),
    },
    {
      label: "points",
      value: String(source === "dma" ? values.length : (steps?.points ?? kelvin.length)),
      remark: span(values, over),
    },
  ];
  if (source !== "dma") return numbers;
  const outliers = result.flagged.filter((one) => one.why !== "left out").length;
  const flagged = {
    value: String(result.left_out + outliers),
    remark: `${result.left_out} left out, ${outliers} outliers`,
  };
  return [...numbers, { label: "flagged", ...flagged }];
}

const RESPONSES = {
  creep: { symbol: { shear: "J" }, otherwise: "D", word: "creep compliance", label: " (1/MPa)", scale: 1e6 },
  relaxation: {
    symbol: { shear: "G" },
    otherwise: "E",
    word: "relaxation modulus",
    label: "",
    kind: "modulus",
    scale: 1,
  },
};

/** Creep or relaxation tests: as measured, or with `fit` over reduced time. */
export function stepFigure({ kind, deformation, curves, fit }, synthetic) {
  const { symbol, otherwise, word, label, kind: quantity, scale } = RESPONSES[kind];
  const scaled = (values) => values.map((one) => scale * one);
  const temperatures = curves.map((one) => one.temperature);
  const mode = fit ? "markers" : "lines+markers";
  const line = fit && { name: "fitted", x: fit.time, y: scaled(fit.response), colour: "vermilion", width: 1.5 };
  return {
    caption: byTemperature(temperatures),
    synthetic,
    temperatures,
    x: { label: fit ? "reduced time t/α" : "time", kind: "time", log: true },
    y: { label: `${word} ${symbol[deformation] ?? otherwise}${label}`, kind: quantity, log: true },
    traces: [
      ...isothermTraces(curves, ({ time, response }) => ({ x: time, y: scaled(response), mode, size: 4 })),
      ...(line ? [line] : []),
    ],
  };
}

/** One of the moduli of sweeps or ramps; of another rubber, at its reference. */
function modulusFigure(result, made, [key, label, primes]) {
  const modulus = key !== "loss_tangent";
  const axis = (letter) => ({
    label: modulus ? `${label} ${letter}${primes}` : label,
    kind: modulus ? "modulus" : undefined,
    log: true,
  });
  const shared = {
    title: capital(label),
    of: result,
    synthetic: madeUp(),
    x: OVER_FREQUENCY,
    y: axis(result.deformation === "shear" ? "G" : "E"),
  };
  if (result.source === "ramps") {
    const traces = result.ramps.map((one) => ({
      name: units.show(one.angular_frequency, "angular_frequency"),
      x: one.temperature,
      y: one[key],
      mode: "lines+markers",
      size: 4,
      width: 1.2,
    }));
    return { ...shared, x: { label: "temperature", kind: "temperature" }, traces };
  }
  if (result.source === "dma") {
    const temperatures = result.isotherms.map((one) => one.temperature);
    const curves = isothermTraces(result.isotherms, (one) => ({ x: one.angular_frequency, y: one[key] }));
    const traces = [...curves, ...flags(result, key, true), ...flags(result, key, false)];
    return { ...shared, caption: byTemperature(temperatures), temperatures, traces };
  }
  if (!made) return { ...shared, of: null, traces: [] };
  const { modulus: line, reference } = made.spectrum;
  const traces = [{ name: label, x: line.angular_frequency, y: line[key], legend: false }];
  const title = `${capital(label)}${reference === null ? "" : ` at ${named(reference)}`}`;
  return { ...shared, of: made, synthetic: made.synthetic, title, y: axis("E"), traces };
}

/** Readings that were left out, or are far from their neighbours. */
function flags({ flagged }, key, left) {
  const tangent = key === "loss_tangent";
  const value = (one) =>
    tangent ? (one.storage_modulus > 0 ? one.loss_modulus / one.storage_modulus : null) : one[key];
  const some = flagged.filter(
    (one) => (one.why === "left out") === left && one.angular_frequency > 0 && value(one) > 0,
  );
  const points = {
    name: left ? "left out" : "far from its neighbours",
    mode: "markers",
    symbol: left ? "x" : "circle",
    colour: "red",
    size: 9,
    open: !left,
    x: some.map((one) => one.angular_frequency),
    y: some.map(value),
    text: some.map((one) => `${one.place}: ${one.why}`),
  };
  return some.length ? [points] : [];
}

/** The figures of what was read; `made` is the rubber, for those that have no measurement to show. */
export function figuresOf(result, made) {
  const measured = ["dma", "ramps"].includes(result.source);
  const moduli = MODULI.filter(([key]) => measured || key !== "loss_tangent").map((modulus) => ({
    id: `isotherms-${modulus[0].replace("_", "-")}`,
    ...modulusFigure(result, made, modulus),
  }));
  const steps = { id: "step-tests", title: "Creep and relaxation tests", of: result };
  return result.steps ? [{ ...steps, ...stepFigure(result.steps, madeUp()) }, ...moduli] : moduli;
}

/** What each file was taken for. */
export const FileTable = view(({ of }) => {
  const { files = [] } = of ?? {};
  if (files.length === 0) return null;
  const rows = files
    .slice(0, MOST_ROWS)
    .map((one) => [
      one.name,
      one.format,
      one.deformation ?? "not stated",
      String(one.readings),
      span(one.temperature, "temperature"),
      span(one.angular_frequency, "angular_frequency"),
    ]);
  const head = ["file", "format", "deformation", "readings", "temperatures", "frequencies"];
  return html`<${Folded} title=${files.length === 1 ? "The file" : `${files.length} files`} open=${files.length <= 3}>
    <div class="words"><${Table} of=${of} head=${head} rows=${rows} caption="Files as read" /></div>
  <//>`;
});

export const FlaggedTable = view(({ of }) => {
  const { flagged = [] } = of ?? {};
  if (flagged.length === 0) return null;
  const rows = flagged
    .slice(0, MOST_ROWS)
    .map((one) => [
      one.place,
      one.why,
      units.show(one.temperature, "temperature"),
      units.show(one.angular_frequency, "angular_frequency"),
      units.show(one.storage_modulus, "modulus"),
      units.show(one.loss_modulus, "modulus"),
    ]);
  const head = ["location", "reason", "temperature", "frequency", "storage modulus", "loss modulus"];
  return html`<${Folded} title="Flagged readings"><${Table} of=${of} head=${head} rows=${rows} caption="Flagged readings" /><//>`;
});
