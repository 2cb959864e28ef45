// What the figures of the measurement draw, from the results of its jobs: each function returns changes of a figure's spec.
//
// Results hold columns by temperature: [{temperature, speed: [...], viscoelastic: [...], ...}], SI, null where nothing is known.

import * as units from "../units.js";

const name = (isotherm) => units.show(isotherm.temperature, "temperature");
const every = (isotherms) => isotherms.map((one) => one.temperature);
const known = (values) => values?.some((value) => value !== null);
const pick = (values, keep) => values.map((value, at) => (keep(at) ? value : null));

/** The upper end of an axis that begins at zero; none where friction lies below it. */
function fromZero(...columns) {
  const values = columns.flat().filter((value) => value !== null && value !== undefined);
  const top = Math.max(...values);
  return values.length > 0 && Math.min(...values) >= 0 && top > 0 ? [0, 1.08 * top] : undefined;
}

/** What the pointer tells of a measured point. */
function told(isotherm, what) {
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
  const top = [...isotherms.map((one) => one.viscoelastic), ...(agreement?.lines ?? []).map((one) => one.friction)];
  const marked = remarks.some((one) => one.remark.some((word) => word));
  const caption = [
    points.length > 0 ? "Points: measured, with the standard deviation of the repetitions." : "",
    lines.length > 0 ? `Lines: predicted for the page's rubber${agreement.band ? ", with the 95 % band of its uncertainty" : ""}.` : "",
    marked ? "Open points: the prediction there is doubtful; the pointer says why." : "",
  ];
  return { traces: [...lines, ...points], temperatures, synthetic, caption: caption.filter(Boolean).join(" "), y: { label: "viscoelastic friction coefficient", range: fromZero(...top) } };
}

function pointTraces(isotherm, what, doubts = []) {
  const text = told(isotherm, what).map((words, at) => [words, doubts[at]].filter(Boolean).join("; "));
  const scatter = isotherm[`${what}_scatter`];
  const common = { mode: "markers", temperature: isotherm.temperature, x: isotherm.speed, text, group: `${isotherm.temperature}` };
  const values = (keep) => ({ y: pick(isotherm[what], keep), error: known(scatter) ? pick(scatter, keep) : undefined });
  const traces = [{ ...common, name: name(isotherm), ...values((at) => !doubts[at]) }];
  if (doubts.some((word) => word)) traces.push({ ...common, name: `${name(isotherm)}, doubtful`, legend: false, open: true, ...values((at) => doubts[at]) });
  return traces;
}

/** A predicted line, thin where it rests on frequencies that were not measured. */
function lineTraces(line, ofTemperature) {
  const look = ofTemperature ? { temperature: line.temperature, group: `${line.temperature}`, name: `${name(line)}, predicted` } : { colour: "purple", name: "predicted", group: "predicted" };
  const common = { ...look, x: line.speed, mode: "lines", legend: !ofTemperature };
  const band = known(line.lower) ? { lower: line.lower, upper: line.upper } : {};
  if (!line.extrapolated?.some((one) => one)) return [{ ...common, y: line.friction, ...band }];
  const sound = pick(line.friction, (at) => !line.extrapolated[at]);
  return [{ ...common, y: line.friction, ...band, width: 0.8 }, { ...common, y: sound, legend: false, decoration: true }];
}

/** Coulomb friction as points. */
export function coulombFigure(measured, synthetic) {
  const isotherms = (measured?.curves ?? []).filter((one) => known(one.coulomb));
  const range = fromZero(...isotherms.map((one) => one.coulomb));
  return { traces: isotherms.flatMap((one) => pointTraces(one, "coulomb")), temperatures: every(isotherms), synthetic, y: { label: "Coulomb friction coefficient", range } };
}

/** What four sign configurations leave over, which is zero in a sound test. */
export function checkFigure(measured, synthetic) {
  const isotherms = (measured?.curves ?? []).filter((one) => known(one.consistency));
  const traces = isotherms.map((one) => ({
    name: name(one), temperature: one.temperature, mode: "markers", x: one.speed, y: one.consistency,
    error: one.consistency_error.map((error) => (error === null ? null : 2 * error)),
  }));
  return { traces, temperatures: every(isotherms), synthetic, marks: [{ y: 0 }] };
}

/** The force cell's zero at each condition. */
export function zeroFigure(measured, synthetic) {
  const isotherms = (measured?.curves ?? []).filter((one) => known(one.offset));
  const traces = isotherms.map((one) => ({ name: name(one), temperature: one.temperature, mode: "markers", x: one.speed, y: one.offset }));
  return { traces, temperatures: every(isotherms), synthetic };
}

/** All temperatures on one curve; the predicted line where it is at the same temperature, else the smoothed one. */
export function masterFigure(master, along, synthetic) {
  if (!master) return { traces: [] };
  const points = master.points.map((one) => ({
    name: name(one), temperature: one.temperature, mode: "markers", x: one.speed, y: one.friction, error: known(one.scatter) ? one.scatter : undefined,
  }));
  const same = along?.speed && Math.abs(along.reference - master.reference) < 0.01;
  const smoothed = master.line && { x: master.line.speed, y: master.line.friction, lower: master.line.lower, upper: master.line.upper };
  const lines = same ? lineTraces(along, false) : smoothed ? [{ ...smoothed, name: "smoothed, with its 95 % band", mode: "lines", colour: "purple" }] : [];
  const top = [...master.points.map((one) => one.friction), same ? along.friction : []];
  return {
    traces: [...lines, ...points], temperatures: every(master.points), synthetic, caption: master.overlap,
    x: { label: `reduced speed α·v at ${units.show(master.reference, "temperature")}`, kind: "speed", log: true },
    y: { label: "viscoelastic friction coefficient", range: fromZero(...top) },
  };
}

/** Shift factors that friction tells, beside those of the rubber. */
export function factorsFigure(result, synthetic) {
  const { found, known: other } = result ?? {};
  const traces = [];
  if (other?.points) traces.push({ ...factorPoints(other.points), name: "of the rubber ± standard error", colour: "orange", symbol: "square", open: true });
  else if (other) traces.push({ ...factorLine(other.line), name: "of the rubber", colour: "orange" });
  if (found?.law) traces.push({ ...factorLine(found.law), name: "law fitted to friction's, with its 95 % band", colour: "sky", width: 1.2 });
  if (found) traces.push({ ...factorPoints(found.factors), name: "from friction ± standard error", colour: "blue" });
  const at = (found ?? result?.by_rubber)?.reference;
  return { traces, synthetic, caption: found?.agreement ?? "", y: { label: `log₁₀ α, 0 at ${at ? units.show(at, "temperature") : "the reference"}` } };
}

const factorPoints = (factors) => ({ mode: "markers", x: factors.temperature, y: factors.log10, error: factors.error });
const factorLine = (line) => ({ mode: "lines", x: line.temperature, y: line.log10, lower: known(line.lower) ? line.lower : undefined, upper: known(line.lower) ? line.upper : undefined });

/** Modulus that friction identifies, strong where it does, with the page's rubber beside it. */
export function modulusFigure(found, synthetic) {
  if (!found) return { traces: [] };
  const { modulus, identified, known: beside } = found;
  const omega = modulus.angular_frequency;
  const inside = (at) => omega[at] >= identified.low && omega[at] <= identified.high;
  const traces = [["E′", "storage", "blue"], ["E″", "loss", "vermilion"]].flatMap(([symbol, part, colour]) => {
    const line = { x: omega, mode: "lines", colour, group: part };
    return [
      { ...line, y: modulus[part], lower: modulus[`${part}_lower`], upper: modulus[`${part}_upper`], width: 0.8, name: `${symbol} from friction, 95 % band` },
      { ...line, y: pick(modulus[part], inside), width: 2.6, legend: false, decoration: true, name: `${symbol} from friction` },
      ...(beside ? [{ x: omega, y: beside[part], mode: "lines", colour: "green", dash: "6px,3px", width: 1.4, name: `${symbol} of ${beside.name || "the page's rubber"}` }] : []),
    ];
  });
  const share = `${units.plainNumber(100 * identified.limit, 2)} %`;
  const marks = identified.high > identified.low ? [{ x: identified.low, label: `known to ${share} from here …` }, { x: identified.high, label: "… to here" }] : [];
  const level = identified.relative ? " but for the level, which friction does not tell" : "";
  const caption = identified.high > identified.low
    ? `Strong lines: |E| is known to ${share}${level}. Beyond, the rubber is what a smooth spectrum would be.`
    : `Nowhere is |E| known to ${share}.`;
  return { traces, marks, synthetic, caption, x: { label: `reduced angular frequency at ${units.show(found.reference, "temperature")}`, kind: "angular_frequency", log: true } };
}

/** Measured friction with that of the identified rubber. */
export function fitFigure(found, measured, synthetic) {
  if (!found) return { traces: [] };
  const points = (measured?.curves ?? []).map((one) => ({ name: name(one), temperature: one.temperature, mode: "markers", x: one.speed, y: one.viscoelastic, size: 5 }));
  const lines = found.fit.map((one) => ({ name: `${name(one)}, fitted`, legend: false, temperature: one.temperature, mode: "lines", x: one.speed, y: one.fitted, lower: one.lower, upper: one.upper, group: `${one.temperature}` }));
  return { traces: [...lines, ...points], temperatures: every(found.fit), synthetic, caption: found.sentences[0] };
}
