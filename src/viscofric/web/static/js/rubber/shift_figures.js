// What the figures and the table of shift factors and their laws show.

import { html, view } from "../reactive.js";
import { state } from "../state.js";
import { Button, Table } from "../views.js";
import { TESTS, named, synthetic } from "./made.js";

export function alphaFigure(result) {
  const { shift } = result;
  const { factors, material } = shift;
  const traces = [];
  if (factors) {
    for (const [held, name, symbol] of [
      [false, "isotherms, 95 %", "circle"],
      [true, "fixed manually", "square"],
    ]) {
      const some = factors.temperature.map((_, at) => at).filter((at) => factors.held[at] === held);
      if (some.length)
        traces.push({
          name,
          mode: "markers",
          symbol,
          colour: held ? "orange" : "blue",
          x: some.map((at) => factors.temperature[at]),
          y: some.map((at) => factors.log10_shift_factor[at]),
          error: some.map((at) => factors.error95[at]),
        });
    }
  }
  const drawn = shift.laws.filter((row) => row.line && row.same_as === "");
  const shown = drawn.find((row) => row.used) ?? drawn.find((row) => row.chosen);
  drawn.forEach((row, at) =>
    traces.push(
      ...lineTraces(row, {
        hidden: row !== shown,
        colour: row === shown ? "vermilion" : ["green", "purple", "orange", "sky"][at % 4],
        name: `${row.title}${row.used ? ", used" : row.chosen ? ", best" : ""}`,
      }),
    ),
  );
  if (!factors)
    traces.push(
      ...lineTraces(
        { line: material.line, limits: material.limits },
        { name: "α(T) of the material", colour: "vermilion" },
      ),
    );
  return {
    caption: "Bars and bands are 95 %. Dotted lines are extrapolated; they end at the limits of validity.",
    marks: [{ x: shift.reference, label: "reference" }],
    synthetic: synthetic(result),
    traces,
  };
}

/** A law as a solid line where it was fitted, dotted on either side. */
function lineTraces({ line, limits }, look) {
  const [low, high] = limits?.fitted ?? [-Infinity, Infinity];
  const { temperature, log10_shift_factor: log10, error95 } = line;
  const last = temperature.length - 1;
  const first = temperature.findIndex((kelvin) => kelvin >= low);
  const end = temperature.findLastIndex((kelvin) => kelvin <= high);
  const part = (from, to, more) => {
    const cut = (values) => values.slice(from, to + 1);
    const band =
      error95 && !look.hidden
        ? {
            lower: cut(log10.map((one, at) => one - error95[at])),
            upper: cut(log10.map((one, at) => one + error95[at])),
          }
        : {};
    return { ...look, group: look.name, x: cut(temperature), y: cut(log10), ...band, ...more };
  };
  const beyond = { legend: false, dash: "dot", name: `${look.name}, extrapolated` };
  return [
    part(first, end, {}),
    ...(first > 0 ? [part(0, first, beyond)] : []),
    ...(end < last ? [part(end, last, beyond)] : []),
  ];
}

export function limitsInWords({ material }) {
  const { limits, words } = material;
  if (!limits) return words;
  const [low, high] = limits.valid;
  const span =
    low === null || high === null
      ? high === null && low > 0
        ? `above ${named(low)}`
        : "at every temperature"
      : `from ${named(low)} to ${named(high)}`;
  return `Used: ${words}. Valid ${span}.`;
}

export const LawTable = view(({ of }) => {
  const rows = of.shift.laws.map((row) => {
    const words = row.refusal || row.words;
    const mark = row.used
      ? "used"
      : row.chosen
        ? "best"
        : row.same_as
          ? `same curve as ${row.same_as.toUpperCase()}`
          : "";
    const use =
      row.refusal ||
      row.used ||
      (state.get("material.shift_factors") === undefined &&
        !TESTS.some((key) => state.get(`material.${key}`) !== undefined))
        ? null
        : html`<${Button} kind="small" onClick=${() => state.set("material.shift", row.kind)}>Use ${row.title}<//>`;
    const valid = row.limits
      ? row.limits.valid.map((kelvin) => (kelvin === null ? "∞" : named(kelvin))).join(" to ")
      : "–";
    return [
      row.title,
      words,
      row.aic === null ? "–" : row.aic.toFixed(1).replace("-", "−"),
      row.refusal || row.kind === "polynomial" ? "–" : row.weight.toFixed(2),
      row.refusal ? "–" : row.exact ? "exact" : row.scatter.toFixed(3),
      valid,
      mark,
      use ?? "",
    ];
  });
  const head = ["law", "constants", "AIC", "weight", "scatter (decades)", "valid", "", ""];
  return html`<${Table} of=${of} head=${head} rows=${rows} caption="Comparison of laws: a lower AIC is better" />`;
});

export function residualTraces({ laws, factors }) {
  const band = factors
    ? [
        {
          name: "95 % of the factors",
          colour: "sky",
          width: 0,
          x: factors.temperature,
          y: factors.temperature.map(() => 0),
          lower: factors.error95.map((one) => -one),
          upper: factors.error95,
        },
      ]
    : [];
  const rows = laws.filter((row) => row.residual && row.same_as === "");
  const best = Math.min(...rows.map((row) => Math.max(...row.residual.log10_residual.map(Math.abs))));
  return [
    ...band,
    ...rows.map((row) => ({
      name: row.title,
      mode: "lines+markers",
      size: 5,
      width: 1.2,
      x: row.residual.temperature,
      y: row.residual.log10_residual,
      hidden: Math.max(...row.residual.log10_residual.map(Math.abs)) > 20 * Math.max(best, 0.005),
    })),
  ];
}

export function verticalFigure({ temperature, b, upper }, result) {
  const trace = upper
    ? { mode: "markers", x: temperature, y: b, error: upper.map((one, at) => one - b[at]) }
    : { mode: "lines+markers", x: temperature, y: b };
  return {
    traces: [{ name: "b", legend: false, ...trace }],
    marks: [{ y: 1 }],
    synthetic: synthetic(result),
    caption: upper ? "Fitted with the shift factors; bars are 95 %." : "ρT/(ρ₀T₀), from rubber elasticity.",
  };
}
