// The user's units: SI numbers in, text and numbers in the units chosen on the page out, and back.
//
// Kinds: length, speed, temperature, load, line_load, modulus, pressure, frequency (SI value in Hz), angular_frequency
// (SI value in rad/s; shown in the same unit), time, area, angle, and plain (a number without unit).
//
// show(0.02, "speed") -> "20 mm/s"          number(0.02, "speed") -> 20         label("speed") -> "mm/s"
// si(20, "speed") -> 0.02                   words(0.02, "speed") -> "20 mm/s", as run files write it ("30 degC")
// parse("9.525 mm", "length") -> 0.009525   (null if it cannot be read); read("20", "speed") -> 0.02: of what people type
// typed("20", "speed") -> "20 mm/s"         what people type, as run files write it; a bare number has the user's unit

import { lasting } from "./reactive.js";

const HZ = 2 * Math.PI;

// kind: [title, {label: [factor to SI, offset, words in a run file]}, SI, imperial]; the first unit is that of engineering
const KINDS = {
  length: ["Length", { mm: [1e-3], µm: [1e-6, 0, "um"], m: [1], in: [0.0254] }, "m", "in"],
  speed: ["Speed", { "mm/s": [1e-3], "m/s": [1], "µm/s": [1e-6, 0, "um/s"], "in/s": [0.0254] }, "m/s", "in/s"],
  temperature: [
    "Temperature",
    { "°C": [1, 273.15, "degC"], K: [1], "°F": [5 / 9, 459.67 * (5 / 9), "degF"] },
    ...["K", "°F"],
  ],
  load: ["Load", { N: [1], mN: [1e-3], kN: [1e3], lbf: [4.4482216152605] }, "N", "lbf"],
  line_load: ["Load per length", { "N/mm": [1e3], "N/m": [1], "lbf/in": [4.4482216152605 / 0.0254] }, "N/m", "lbf/in"],
  modulus: ["Modulus", { MPa: [1e6], kPa: [1e3], GPa: [1e9], Pa: [1], psi: [6894.757293168361] }, "Pa", "psi"],
  pressure: ["Pressure", { MPa: [1e6], kPa: [1e3], Pa: [1], bar: [1e5], psi: [6894.757293168361] }, "Pa", "psi"],
  frequency: ["Frequency", { Hz: [1], "rad/s": [1 / HZ] }, "rad/s", "Hz"],
  time: ["Time", { s: [1], ms: [1e-3], µs: [1e-6, 0, "us"] }, "s", "s"],
  angle: ["Angle", { "°": [Math.PI / 180, 0, "deg"], rad: [1] }, "rad", "°"],
};
const ofEach = (read) => Object.fromEntries(Object.entries(KINDS).map(([kind, about]) => [kind, read(about)]));
const UNITS = ofEach(([, units]) => units);
const SYSTEMS = {
  engineering: ofEach(([, units]) => Object.keys(units)[0]),
  SI: ofEach(([, , si]) => si),
  imperial: ofEach(([, , , imperial]) => imperial),
};
const chosen = lasting("localStorage", "viscofric.units", SYSTEMS.engineering);
const isKnown = ([kind, unit]) => UNITS[kind]?.[unit];
chosen.value = { ...SYSTEMS.engineering, ...Object.fromEntries(Object.entries(chosen.value).filter(isKnown)) };

/** Factor and offset of a kind in the unit that the user chose: SI = factor * number + offset. */
function scale(kind) {
  if (kind === "area") return [scale("length")[0] ** 2, 0];
  if (kind === "angular_frequency") return [chosen.value.frequency === "Hz" ? HZ : 1, 0];
  const [factor, offset = 0] = UNITS[kind]?.[chosen.value[kind]] ?? [1, 0];
  return [factor, offset];
}

/** The unit's label; "" of a plain number. */
export function label(kind) {
  if (kind === "area") return `${chosen.value.length}²`;
  if (kind === "angular_frequency") return chosen.value.frequency;
  return chosen.value[kind] ?? "";
}

/** A number, or a list of numbers, in the user's unit; null stays null. */
export function number(value, kind) {
  const [factor, offset] = scale(kind);
  const shown = (one) => (factor === 1 && offset === 0 ? one : (one - offset) / factor);
  const each = (one) => (one === null || one === undefined ? null : shown(one));
  return Array.isArray(value) || ArrayBuffer.isView(value) ? Array.from(value, each) : each(value);
}

/** The SI value of a number in the user's unit. */
export function si(value, kind) {
  const [factor, offset] = scale(kind);
  return factor * value + offset;
}

const SUPER = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

/** A number as people read it: 0.0182, 25, 1.2×10⁻⁵. */
export function plainNumber(value, digits = 3) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(Number(value.toPrecision(digits)));
  if (size >= 1e-3 && size < 1e5) {
    const text = size >= 10 ** digits ? String(Math.round(value)) : String(Number(value.toPrecision(digits)));
    return text.replace("-", "−");
  }
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  const power = String(Number(exponent)).replace(/./g, (one) => SUPER[one]);
  return `${String(Number(mantissa)).replace("-", "−")}×10${power}`;
}

/** A value with the user's unit: "20 mm/s"; of a temperature no more than its tenth of a degree. */
export function show(value, kind = "plain", digits = 3) {
  const inUnit = number(value, kind);
  if (inUnit === null || !Number.isFinite(inUnit)) return "–";
  const unit = label(kind);
  const text =
    kind === "temperature" ? String(Math.round(10 * inUnit) / 10).replace("-", "−") : plainNumber(inUnit, digits);
  if (!unit) return text;
  return unit === "°" ? `${text}°` : `${text}\u00a0${unit}`;
}

/** A value and its error as `show` has them, both to the error's second digit; the error is "" where there is none. */
export function showWithError(value, error, kind, digits = 3) {
  if (!error || !Number.isFinite(value)) return [show(value, kind, digits), ""];
  const size = (one) => Math.floor(Math.log10(Math.abs(one)));
  const [inUnit, wide] = [number(value, kind), Math.abs(error / scale(kind)[0])];
  const known = Math.min(Math.max(size(inUnit || wide) - size(wide) + 2, 1), digits);
  const unit = label(kind) && `\u00a0${label(kind)}`;
  return [[inUnit, known], [wide, 2]].map(([one, to]) => `${plainNumber(Number(one.toPrecision(to)), to)}${unit}`);
}

/** Words with the quantities in them as the user reads them: "{0.02|speed}" -> "20 mm/s", "{omega}" is f in Hz. */
export const filled = (text) =>
  String(text ?? "")
    .replace(/\{([^{}|]+)\|(\w+)(?:\|(\d))?\}/g, (_, value, kind, digits) =>
      show(Number(value), kind, Number(digits ?? 3)),
    )
    .replaceAll("{omega}", label("angular_frequency") === "Hz" ? "f" : "ω")
    .replaceAll("{frequency}", label("angular_frequency") === "Hz" ? "frequency" : "angular frequency")
    .replaceAll("{v/a}", label("angular_frequency") === "Hz" ? "v/(2πa)" : "v/a");

/** The user's unit as a run file writes it: "degC" for °C. */
const unitWords = (kind) => UNITS[kind]?.[chosen.value[kind]]?.[2] ?? label(kind);

/** A value as a run file writes it, in the user's unit. */
export function words(value, kind, digits = 6) {
  const rounded = Number(number(value, kind).toPrecision(digits));
  return kind === "plain" ? rounded : `${rounded} ${unitWords(kind)}`;
}

const PLAIN_NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
const QUANTITY = /^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*(.*?)\s*$/i;

/** The SI value of a quantity in a document's words; null where the words are others than the menu's. */
export function parse(text, kind) {
  if (typeof text === "number") return kind === "plain" ? text : null;
  const [, amount, words] = QUANTITY.exec(String(text ?? "").replace("−", "-")) ?? [];
  const unit = words?.replace(/^[uμ](?=m|s)/, "µ").replace(/^deg(?=C$|F$|$)/, "°");
  const [factor, offset = 0] = (kind === "plain" && unit === "" ? [1] : UNITS[kind]?.[unit]) ?? [null];
  return factor === null ? null : Number((factor * Number(amount) + offset).toPrecision(14));
}

/** The SI value of a number in the user's unit, or of a quantity with its own; null where it is neither. */
export function read(text, kind) {
  const plain = text.trim().replace("−", "-");
  return PLAIN_NUMBER.test(plain) ? si(Number(plain), kind) : parse(plain, kind);
}

/** The ends of the quantities that the document gives as one value, a list or a range; null where they cannot be read. */
export function ends(given, kind) {
  const range = given && typeof given === "object" && !Array.isArray(given);
  const all = (range ? [given.from, given.to] : [given].flat())
    .map((one) => parse(one, kind))
    .filter((one) => one !== null);
  return all.length ? [Math.min(...all), Math.max(...all)] : null;
}

/** What people type, as a run file writes it: a bare number gets the user's unit; a plain number is no text. */
export function typed(text, kind) {
  const words = text
    .trim()
    .replaceAll("\u00a0", " ")
    .replace("−", "-")
    .replace(/µ|μ/, "u")
    .replace("°C", "degC")
    .replace("°F", "degF");
  if (!kind || !PLAIN_NUMBER.test(words)) return words;
  return kind === "plain" ? Number(words) : `${words} ${unitWords(kind)}`;
}

/** Kinds that the menu offers: [{kind, title, units, chosen}]. */
export const choices = () =>
  Object.entries(KINDS).map(([kind, [title, units]]) => {
    return { kind, title, units: Object.keys(units), chosen: chosen.value[kind] };
  });

/** Names of whole sets of units. */
export const systems = Object.keys(SYSTEMS);

/** Choose the unit of a kind, or a whole set: choose("speed", "m/s"), choose("SI"). */
export function choose(kindOrSystem, unit) {
  chosen.value = unit === undefined ? SYSTEMS[kindOrSystem] : { ...chosen.value, [kindOrSystem]: unit };
}
