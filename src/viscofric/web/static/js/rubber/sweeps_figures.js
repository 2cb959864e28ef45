// What the figures and tables of sweeps show, as they were read.

import { byTemperature, fewEnough, named } from "./made.js";

const MOST_ROWS = 200;
export const OVER_FREQUENCY = { label: "frequency", kind: "angular_frequency", log: true };

export function keyNumbers(result, app) {
  const { units } = app;
  const curves = result.ramps ?? result.steps?.curves;
  if (result.source !== "dma" && curves) return numbersOfOther(result, curves, app);
  if (result.source !== "dma") {
    return [
      {
        label: "material",
        value: result.name || "unnamed",
        remark: result.synthetic ? "synthetic, not measured" : "",
      },
      {
        label: "reference",
        value: result.reference === null ? "none" : named(result.reference, app),
        remark: result.reference === null ? "valid at one temperature only" : "",
      },
    ];
  }
  const kelvin = result.isotherms.map((one) => one.temperature);
  const omega = result.isotherms.flatMap((one) => one.angular_frequency);
  const points = result.isotherms.reduce((sum, one) => sum + one.angular_frequency.length, 0);
  const outliers = result.flagged.filter((one) => one.why !== "left out").length;
  const span = (values, kind) => `${units.show(Math.min(...values), kind)} to ${units.show(Math.max(...values), kind)}`;
  return [
    {
      label: "measured in",
      ...(result.left_open.includes("deformation") && !app.state.get("material.deformation")
        ? { value: "?", remark: "please select tension or shear" }
        : { value: result.deformation, remark: result.left_open.includes("deformation") ? "as given" : "from the file" }),
    },
    { label: "isotherms", value: String(result.isotherms.length), remark: span(kelvin, "temperature") },
    { label: "points", value: String(points), remark: span(omega, "angular_frequency") },
    {
      label: "flagged",
      value: String(result.left_out + outliers),
      remark: `${result.left_out} left out, ${outliers} outliers`,
    },
  ];
}

/** Of temperature ramps, creep or relaxation tests alone. */
function numbersOfOther({ source, ramps, steps, deformation, left_open }, curves, { units }) {
  const span = (values, kind) => [...new Set([Math.min(...values), Math.max(...values)])].map((end) => units.show(end, kind)).join(" to ");
  const kelvin = curves.flatMap((one) => one.temperature);
  const remark = left_open.includes("deformation") ? "as given" : "from the file";
  return [
    { label: "measured in", value: deformation, remark },
    { label: source === "ramps" ? "frequencies" : "tests", value: String(curves.length), remark: span(kelvin, "temperature") },
    {
      label: "points",
      value: String(steps?.points ?? kelvin.length),
      remark: ramps
        ? span(ramps.map((one) => one.angular_frequency), "angular_frequency")
        : span(curves.flatMap((one) => one.time), "time"),
    },
  ];
}

const COMPLIANCE = 1e6; // shown in 1/MPa
const RESPONSES = {
  creep: { symbol: { shear: "J" }, otherwise: "D", word: "creep compliance", label: " (1/MPa)" },
  relaxation: { symbol: { shear: "G" }, otherwise: "E", word: "relaxation modulus", label: "", kind: "modulus" },
};

/** Creep or relaxation tests: as measured, or with `fit` over reduced time. */
export function stepFigure({ kind, deformation, curves, fit }, madeUp, app) {
  const { symbol, otherwise, word, label, kind: quantity } = RESPONSES[kind];
  const scaled = (values) => (kind === "creep" ? values.map((one) => COMPLIANCE * one) : values);
  const temperatures = curves.map((one) => one.temperature);
  const line = fit
    ? [{ name: "fitted", x: fit.time, y: scaled(fit.response), colour: "vermilion", width: 1.5 }]
    : [];
  return {
    caption: byTemperature(temperatures, app),
    synthetic: madeUp,
    temperatures,
    x: { label: fit ? "reduced time t/α" : "time", kind: "time", log: true },
    y: { label: `${word} ${symbol[deformation] ?? otherwise}${label}`, kind: quantity, log: true },
    traces: [
      ...curves.map((one) => ({
        name: named(one.temperature, app),
        legend: fewEnough(temperatures),
        temperature: one.temperature,
        x: one.time,
        y: scaled(one.response),
        mode: fit ? "markers" : "lines+markers",
        symbol: "circle",
        dash: "solid",
        size: 4,
        width: 1.2,
      })),
      ...line,
    ],
  };
}

/** One modulus of temperature ramps. */
export function rampFigure(result, { key, label, primes }, app) {
  const symbol = result.deformation === "shear" ? "G" : "E";
  const modulus = key !== "loss_tangent";
  return {
    title: label[0].toUpperCase() + label.slice(1),
    caption: "",
    synthetic: app.state.get("data_origin") === "synthetic",
    x: { label: "temperature", kind: "temperature" },
    y: { label: modulus ? `${label} ${symbol}${primes}` : label, kind: modulus ? "modulus" : undefined, log: true },
    temperatures: undefined,
    traces: result.ramps.map((one) => ({
      name: app.units.show(one.angular_frequency, "angular_frequency"),
      x: one.temperature,
      y: one[key],
      mode: "lines+markers",
      size: 4,
      width: 1.2,
    })),
  };
}

export function fileTable(result, app) {
  if (!result?.files?.length) return [];
  const { units, fields } = app;
  const span = (range, kind) =>
    range
      ? range[0] === range[1]
        ? units.show(range[0], kind)
        : `${units.show(range[0], kind)} to ${units.show(range[1], kind)}`
      : "–";
  const rows = result.files
    .slice(0, MOST_ROWS)
    .map((one) => [
      one.name,
      one.format,
      one.deformation ?? "not stated",
      String(one.readings),
      span(one.temperature, "temperature"),
      span(one.angular_frequency, "angular_frequency"),
    ]);
  const table = fields.table(
    ["file", "format", "deformation", "readings", "temperatures", "frequencies"],
    rows,
    "Files as read",
  );
  return [
    app.fields.h(
      "details",
      { open: result.files.length <= 3 },
      app.fields.h("summary", {}, result.files.length === 1 ? "The file" : `${result.files.length} files`),
      app.fields.h("div", { class: "words" }, table),
    ),
  ];
}

export function flaggedTable(result, app) {
  if (!result?.flagged?.length) return [];
  const { units, fields } = app;
  const rows = result.flagged
    .slice(0, MOST_ROWS)
    .map((one) => [
      one.place,
      one.why,
      units.show(one.temperature, "temperature"),
      units.show(one.angular_frequency, "angular_frequency"),
      units.show(one.storage_modulus, "modulus"),
      units.show(one.loss_modulus, "modulus"),
    ]);
  const table = fields.table(
    ["location", "reason", "temperature", "frequency", "storage modulus", "loss modulus"],
    rows,
    "Flagged readings",
  );
  return [fields.h("details", {}, fields.h("summary", {}, "Flagged readings"), table)];
}

export function isothermFigure(result, { key, label, primes }, app) {
  const temperatures = result.isotherms.map((one) => one.temperature);
  const symbol = result.deformation === "shear" ? "G" : "E";
  const modulus = key !== "loss_tangent";
  const traces = result.isotherms.map((one) => ({
    name: named(one.temperature, app),
    legend: fewEnough(temperatures),
    temperature: one.temperature,
    x: one.angular_frequency,
    y: one[key],
    mode: "lines+markers",
    size: 5,
    width: 1.3,
    dash: "solid",
    symbol: "circle",
  }));
  const flags = (left, name, symbol_) => {
    const value = (one) => (modulus ? one[key] : one.storage_modulus > 0 ? one.loss_modulus / one.storage_modulus : null);
    const some = result.flagged.filter(
      (one) => (one.why === "left out") === left && one.angular_frequency > 0 && value(one) > 0,
    );
    return some.length
      ? [
          {
            name,
            mode: "markers",
            symbol: symbol_,
            colour: "red",
            size: 9,
            open: !left,
            x: some.map((one) => one.angular_frequency),
            y: some.map(value),
            text: some.map((one) => `${one.place}: ${one.why}`),
          },
        ]
      : [];
  };
  return {
    title: label[0].toUpperCase() + label.slice(1),
    caption: byTemperature(temperatures, app),
    synthetic: app.state.get("data_origin") === "synthetic",
    x: OVER_FREQUENCY,
    y: { label: modulus ? `${label} ${symbol}${primes}` : label, kind: modulus ? "modulus" : undefined, log: true },
    temperatures,
    traces: [...traces, ...flags(true, "left out", "x"), ...flags(false, "far from its neighbours", "circle")],
  };
}
