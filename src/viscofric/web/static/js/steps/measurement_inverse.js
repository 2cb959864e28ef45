// What the figures draw of what friction says of the rubber: its master curve, its shift factors, its modulus.

import * as units from "../units.js";
import { every, fromZero, known, lineTraces, name, pick, reach } from "./measurement_figures.js";

/** All temperatures on one curve; the predicted line where it is at the same temperature, else the smoothed one. */
export function masterFigure(master, along, synthetic) {
  if (!master) return { traces: [] };
  const points = master.points.map((one) => ({
    name: name(one),
    temperature: one.temperature,
    mode: "markers",
    x: one.speed,
    y: one.friction,
    error: known(one.scatter) ? one.scatter : undefined,
  }));
  const same = along?.speed && Math.abs(along.reference - master.reference) < 0.01;
  const smoothed = master.line && {
    x: master.line.speed,
    y: master.line.friction,
    lower: master.line.lower,
    upper: master.line.upper,
  };
  const lines = same
    ? lineTraces(along, false)
    : smoothed
      ? [{ ...smoothed, name: "smoothed, with its 95 % band", mode: "lines", colour: "purple" }]
      : [];
  const top = [
    ...master.points.flatMap((one) => [one.friction, reach(one.friction, one.scatter)]),
    same ? along.friction : [],
  ];
  return {
    traces: [...lines, ...points],
    temperatures: every(master.points),
    synthetic,
    caption: master.overlap,
    x: { label: `reduced speed α·v at ${units.show(master.reference, "temperature")}`, kind: "speed", log: true },
    y: { label: "viscoelastic friction coefficient", range: fromZero(...top) },
  };
}

/** Shift factors found from friction, beside those of the rubber. */
export function factorsFigure(result, synthetic) {
  const { found, known: other } = result ?? {};
  const traces = [];
  if (other?.points)
    traces.push({
      ...factorPoints(other.points),
      name: "of the material ± standard error",
      colour: "orange",
      symbol: "square",
      open: true,
    });
  else if (other) traces.push({ ...factorLine(other.line), name: "of the material", colour: "orange" });
  if (found?.law)
    traces.push({
      ...factorLine(found.law),
      name: "law fitted to friction, with its 95 % band",
      colour: "sky",
      width: 1.2,
    });
  if (found) traces.push({ ...factorPoints(found.factors), name: "from friction ± standard error", colour: "blue" });
  const at = (found ?? result?.by_rubber)?.reference;
  return {
    traces,
    synthetic,
    caption: found?.agreement ?? "",
    y: { label: `log₁₀ α, 0 at ${at ? units.show(at, "temperature") : "the reference"}` },
  };
}

const factorPoints = ({ temperature: x, log10_shift_factor: y, standard_error: error }) => ({
  mode: "markers",
  x,
  y,
  error,
});
const factorLine = ({ temperature: x, log10_shift_factor: y, error95 }) => ({
  mode: "lines",
  x,
  y,
  ...(known(error95)
    ? { lower: y.map((one, at) => one - error95[at]), upper: y.map((one, at) => one + error95[at]) }
    : {}),
});

/** Modulus that friction identifies, strong where it does, with the page's rubber beside it. */
export function modulusFigure(found, synthetic) {
  if (!found) return { traces: [] };
  const { modulus, identified, known: beside } = found;
  const omega = modulus.angular_frequency;
  const inside = (at) => omega[at] >= identified.low && omega[at] <= identified.high;
  const traces = [
    ["E′", "storage_modulus", "blue"],
    ["E″", "loss_modulus", "vermilion"],
  ].flatMap(([symbol, part, colour]) => {
    const line = { x: omega, mode: "lines", colour, group: part };
    return [
      {
        ...line,
        y: modulus[part],
        lower: modulus[`${part}_lower`],
        upper: modulus[`${part}_upper`],
        width: 0.8,
        name: `${symbol} from friction, 95 % band`,
      },
      {
        ...line,
        y: pick(modulus[part], inside),
        width: 2.6,
        legend: false,
        decoration: true,
        name: `${symbol} from friction`,
      },
      ...(beside
        ? [
            {
              x: omega,
              y: beside[part],
              mode: "lines",
              colour: "green",
              dash: "6px,3px",
              width: 1.4,
              name: `${symbol} of ${beside.name || "the page's material"}`,
            },
          ]
        : []),
    ];
  });
  const share = `${units.plainNumber(100 * identified.limit, 2)} %`;
  const marks =
    identified.high > identified.low
      ? [
          { x: identified.low, label: `identified to ${share} from …` },
          { x: identified.high, label: "… to" },
        ]
      : [];
  const level = identified.relative ? " except for the magnitude, which friction does not determine" : "";
  const caption =
    identified.high > identified.low
      ? `Strong lines: |E| is identified to ${share}${level}. Beyond, it follows from the assumption of a smooth spectrum.`
      : `|E| is not identified to ${share} at any frequency.`;
  return {
    traces,
    marks,
    synthetic,
    caption,
    x: {
      label: `reduced frequency α {omega} at ${units.show(found.reference, "temperature")}`,
      kind: "angular_frequency",
      log: true,
    },
  };
}

/** Measured friction with that of the identified rubber. */
export function fitFigure(found, measured, synthetic) {
  if (!found) return { traces: [] };
  const points = (measured?.curves ?? []).map((one) => ({
    name: name(one),
    temperature: one.temperature,
    mode: "markers",
    x: one.speed,
    y: one.viscoelastic,
    size: 5,
  }));
  const lines = found.fit.map((one) => ({
    name: `${name(one)}, fitted`,
    legend: false,
    temperature: one.temperature,
    mode: "lines",
    x: one.speed,
    y: one.fitted,
    lower: one.lower,
    upper: one.upper,
    group: `${one.temperature}`,
  }));
  return { traces: [...lines, ...points], temperatures: every(found.fit), synthetic, caption: found.sentences[0] };
}
