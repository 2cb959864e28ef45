// What the figures of measured friction draw, from the results of its jobs: each function returns changes of a spec.
//
// Results hold columns by temperature: [{temperature, speed: [...], viscoelastic: [...], ...}], SI, null where nothing is known.

import * as units from "../units.js";

export const name = (isotherm) => units.show(isotherm.temperature, "temperature");
export const every = (isotherms) => isotherms.map((one) => one.temperature);
export const known = (values) => values?.some((value) => value !== null);
export const pick = (values, keep) => values.map((value, at) => (keep(at) ? value : null));

/** The upper end of an axis that begins at zero; none where friction lies below it. */
export function fromZero(...columns) {
  const values = columns.flat().filter((value) => value !== null && value !== undefined);
  const top = Math.max(...values);
  return values.length > 0 && Math.min(...values) >= 0 && top > 0 ? [0, 1.08 * top] : undefined;
}

/** The upper ends of error bars. */
export const reach = (values, bars) => values.map((value, at) => (value === null ? null : value + (bars?.[at] ?? 0)));

/** The text at the pointer on a measured point. */
function described(isotherm, what) {
  return isotherm.speed.map((_, at) => {
    const error = isotherm[`${what}_error`]?.[at];
    const n = isotherm.replicates?.[at];
    const words = [];
    if (error !== null && error !== undefined) words.push(`standard error ${units.plainNumber(error, 2)}`);
    if (n > 1) words.push(`${n} repetitions`);
    return words.join("; ");
  });
}

/** Viscoelastic friction as points, with the prediction's lines and bands behind them. */
export function frictionFigure(measured, agreement, synthetic) {
  const isotherms = measured?.curves ?? [];
  const temperatures = every(isotherms);
  const remarks = agreement?.points ?? [];
  const lines = (agreement?.lines ?? []).flatMap((line) => lineTraces(line, true));
  const points = isotherms.flatMap((isotherm) => {
    const doubtful = remarks.find((one) => Math.abs(one.temperature - isotherm.temperature) < 0.5)?.remark ?? [];
    return pointTraces(isotherm, "viscoelastic", doubtful);
  });
  const top = [
    ...isotherms.flatMap((one) => [one.viscoelastic, reach(one.viscoelastic, one.viscoelastic_scatter)]),
    ...(agreement?.lines ?? []).map((one) => one.friction),
  ];
  const marked = remarks.some((one) => one.remark.some((word) => word));
  const caption = [
    points.length > 0 ? "Points: measured, with the standard deviation of the repetitions." : "",
    lines.length > 0
      ? `Lines: predicted for the page's material${agreement.band ? ", with the 95 % band of its uncertainty" : ""}.`
      : "",
    marked ? "Open points: the prediction there is doubtful; hover to see why." : "",
  ];
  return {
    traces: [...lines, ...points],
    temperatures,
    synthetic,
    caption: caption.filter(Boolean).join(" "),
    y: { label: "viscoelastic friction coefficient", range: fromZero(...top) },
  };
}

function pointTraces(isotherm, what, doubts = []) {
  const text = described(isotherm, what).map((words, at) => [words, doubts[at]].filter(Boolean).join("; "));
  const scatter = isotherm[`${what}_scatter`];
  const common = {
    mode: "markers",
    temperature: isotherm.temperature,
    x: isotherm.speed,
    text,
    group: `${isotherm.temperature}`,
  };
  const values = (keep) => ({ y: pick(isotherm[what], keep), error: known(scatter) ? pick(scatter, keep) : undefined });
  const traces = [{ ...common, name: name(isotherm), ...values((at) => !doubts[at]) }];
  if (doubts.some((word) => word))
    traces.push({
      ...common,
      name: `${name(isotherm)}, doubtful`,
      legend: false,
      open: true,
      ...values((at) => doubts[at]),
    });
  return traces;
}

/** A predicted line, thin where it rests on frequencies that were not measured. */
export function lineTraces(line, ofTemperature) {
  const look = ofTemperature
    ? { temperature: line.temperature, group: `${line.temperature}`, name: `${name(line)}, predicted` }
    : { colour: "purple", name: "predicted", group: "predicted" };
  const common = { ...look, x: line.speed, mode: "lines", legend: !ofTemperature };
  const band = known(line.lower) ? { lower: line.lower, upper: line.upper } : {};
  if (!line.extrapolated?.some((one) => one)) return [{ ...common, y: line.friction, ...band }];
  const sound = pick(line.friction, (at) => !line.extrapolated[at]);
  return [
    { ...common, y: line.friction, ...band, width: 0.8 },
    { ...common, y: sound, legend: false, decoration: true },
  ];
}

/** Coulomb friction as points. */
export function coulombFigure(measured, synthetic) {
  const isotherms = (measured?.curves ?? []).filter((one) => known(one.coulomb));
  const range = fromZero(...isotherms.flatMap((one) => [one.coulomb, reach(one.coulomb, one.coulomb_scatter)]));
  return {
    traces: isotherms.flatMap((one) => pointTraces(one, "coulomb")),
    temperatures: every(isotherms),
    synthetic,
    y: { label: "Coulomb friction coefficient", range },
  };
}

/** What four sign configurations leave over, which is zero in a sound test. */
export function checkFigure(measured, synthetic) {
  const isotherms = (measured?.curves ?? []).filter((one) => known(one.consistency));
  const traces = isotherms.map((one) => ({
    name: name(one),
    temperature: one.temperature,
    mode: "markers",
    x: one.speed,
    y: one.consistency,
    error: one.consistency_error.map((error) => (error === null ? null : 2 * error)),
  }));
  return { traces, temperatures: every(isotherms), synthetic, marks: [{ y: 0 }] };
}

/** The force cell's zero at each condition. */
export function zeroFigure(measured, synthetic) {
  const isotherms = (measured?.curves ?? []).filter((one) => known(one.offset));
  const traces = isotherms.map((one) => ({
    name: name(one),
    temperature: one.temperature,
    mode: "markers",
    x: one.speed,
    y: one.offset,
  }));
  return { traces, temperatures: every(isotherms), synthetic };
}
