// The card of the friction curve: computed after each change, its points drawn as they are known, till then the one before.

import {
  QUANTITIES,
  curveTraces,
  ghostTraces,
  hasQuantity,
  liveTrace,
  quantityOf,
  speedsOf,
  valuesOf,
} from "./curve_traces.js";
import { Job, isStale, shows, studyOf } from "./jobs.js";
import { effect, signal } from "./reactive.js";
import { state } from "./state.js";
import * as units from "./units.js";

const VIEWS = { speed: "against speed", shifted: "against reduced speed α(T)·v" };
const MOST_FAILURES = 5;

const missingOf = (result) => result.friction.filter((value) => value === null).length;
const hasPoints = (curve) => Boolean(curve?.points.friction.some((value) => value !== null));

/** The curve's points as they come: the first part has the cases, the others values of some. */
function drafted(part, before) {
  if (part.layout) {
    const cases = part.layout.speed;
    return { layout: part.layout, points: { friction: cases.map(() => null), known: cases.map(() => false) } };
  }
  const [friction, known] = [before.points.friction.slice(), before.points.known.slice()];
  part.cases.forEach((at, index) => {
    friction[at] = part.friction[index];
    known[at] = part.known[index];
  });
  return { layout: before.layout, points: { friction, known } };
}

/** The study; without its measurement, unless that tells the law of an interface. */
function predicted() {
  const { measurement, ...study } = state.study;
  return { study: study.interface ? state.study : study };
}

const curveJob = new Job("curve", { wait: 350, remember: 6, part: drafted, inputs: predicted });

/** What is drawn of the job's result or of its parts: {source, layout, points, result}. */
function curveOf(source) {
  if (!source) return null;
  if (source.layout) return { source, ...source, result: null };
  const { friction } = source;
  return { source, layout: source, points: { friction, known: friction.map((value) => value !== null) }, result: source };
}

/**
 * Make the card.  onPick({speed, temperature}) is called for a point that was clicked; `combination` is a signal, the number
 * of the one that is shown; `live` the job of the contact that is marked on the curve.
 */
export function frictionCard({ figures, fields, announce, waits, isSynthetic }, { combination, onPick, live }) {
  const { h, button } = fields;
  const pinned = signal(null); // a curve that is kept for comparison
  const quantity = signal("friction");
  let before = null; // the curve that is shown in grey till there is something to show

  const pointsOf = ({ friction, speed }) => {
    const missing = missingOf({ friction });
    return `${missing ? `${speed.length - missing} of ` : ""}${speed.length} points`;
  };
  const bar = fields.progressBar(curveJob, {
    label: "Solving",
    ended: ({ cancelled, seconds }) =>
      cancelled ? "Cancelled." : `${pointsOf(curveJob.result)} in ${units.plainNumber(seconds, 2)} s`,
  });
  const warnings = fields.note([], "warning");
  const failed = fields.note([], "error");
  const notes = fields.note([]);
  const checks = fields.note([]);
  const checked = h("details", { hidden: true }, h("summary", {}, "Checks"), checks, notes);

  const chooser = (label, entries, chosen, onChange) => {
    const options = entries.map(([value, text]) => h("option", { value }, text));
    const select = h("select", { "aria-label": label }, options);
    select.addEventListener("change", () => onChange(select.value));
    effect(() => void (select.value = chosen()));
    return select;
  };
  const viewed = () => state.view("curve.view", "speed");
  const view = chooser("Against", Object.entries(VIEWS), viewed, (value) => state.setView("curve.view", value));
  const quantities = Object.entries(QUANTITIES).map(([value, { label }]) => [value, label]);
  const shown = chooser(
    "Shown",
    quantities,
    () => quantity.value,
    (value) => (quantity.value = value),
  );
  const which = h("select", { "aria-label": "Combination" });
  which.addEventListener("change", () => (combination.value = Number(which.value)));
  const log = h("input", { type: "checkbox", id: "curve-log", checked: state.view("curve.log", false) });
  log.addEventListener("change", () => state.setView("curve.log", log.checked));
  const scale = h("label", { class: "row tick", for: log.id }, log, "log scale");
  const pin = button({
    label: "Keep for comparison",
    kind: "small",
    onClick: () => {
      pinned.value = pinned.value ? null : curveOf(curveJob.result);
      announce(pinned.value ? "The curve is kept, in grey." : "The kept curve is removed.");
    },
  });
  const card = fields.card("Friction");
  const handle = figures.figure(card, {
    id: "friction-curve",
    title: "Friction against speed",
    x: { label: "speed", kind: "speed", log: true },
    y: { label: QUANTITIES.friction.label },
    empty: "Computing the first points.",
    onClick: pick,
  });
  const tools = h("div", { class: "row curve-tools" }, view, shown, which, scale, pin);
  card.append(bar, tools, failed, warnings, checked);

  function pick(point) {
    const at = point?.customdata;
    const { layout } = curveOf(curveJob.result) ?? {};
    if (layout && Number.isInteger(at)) onPick({ speed: layout.speed[at], temperature: layout.temperature[at] });
  }

  function draw(curve) {
    const look = { view: viewed(), quantity: quantity.value, combination: combination.value };
    const { label, kind } = quantityOf(look.quantity, curve.layout);
    const shifted = look.view === "shifted";
    const traces = [
      ...ghostTraces(pinned.value, look, "kept", "6px,4px"),
      ...(hasPoints(curve) ? [] : ghostTraces(before, look, "before", "solid")),
      ...curveTraces(curve, look, { units, figures }),
      ...liveTrace(isStale(live.result) ? null : live.result, look, units),
    ];
    const speed = shifted ? `α(T)·v at ${units.show(curve.layout.reference, "temperature")}` : "speed";
    handle.update({
      of: curve.source,
      title: `${label[0].toUpperCase()}${label.slice(1)} against ${shifted ? "reduced speed" : "speed"}`,
      caption: curveJob.error ? "Previous curve." : caption(curve, shifted),
      x: { label: speed, kind: "speed", log: true, range: speedsOf(curve, look) },
      y: state.view("curve.log", false) ? { label, kind, log: true } : { label, kind, range: valuesOf(traces) },
      temperatures: curve.layout.temperature,
      synthetic: isSynthetic(studyOf(curve.source)),
      traces,
    });
  }

  function caption(curve, shifted) {
    if (!hasPoints(curve)) return before ? "Grey: previous curve." : "";
    const { result } = curve;
    const parts = [];
    if (shifted)
      parts.push("Each temperature is shifted by its shift factor: where the curves coincide, time–temperature superposition holds.");
    if (!result)
      parts.push("Filled points have the requested accuracy; open ones are interpolated and may still be refined.");
    else if (result.lower?.some((value) => value !== null))
      parts.push("Bands: 95 %, from the material's uncertainty.");
    if (result?.doubts.some((words) => words.length > 0)) parts.push("Ringed points are doubtful; hover to see why.");
    parts.push("Click a point to see its contact below.");
    return parts.join(" ");
  }

  /** Offer what there is: quantities of this kind of contact, and combinations of all else that varies. */
  function offer(layout) {
    combination.value = Math.min(combination.value, layout.combinations.length - 1);
    which.hidden = layout.combinations.length < 2;
    which.replaceChildren(...layout.combinations.map((words, at) => h("option", { value: String(at) }, words)));
    which.value = String(combination.value);
    for (const option of shown.options) {
      option.hidden = option.disabled = !hasQuantity(option.value, layout);
      option.textContent = quantityOf(option.value, layout).label;
    }
    if (!hasQuantity(quantity.value, layout)) quantity.value = "friction";
  }

  function warningsOf({ doubts, speed, warnings: found }) {
    const unresolved = doubts.filter((words) => words.includes("unresolved")).length;
    const said =
      `At ${unresolved} of ${speed.length} points the grid does not resolve friction to the requested accuracy; ` +
      "the error bars show its accuracy.";
    return [...found, ...(unresolved ? [said] : [])];
  }

  function failuresOf(result) {
    const missing = missingOf(result);
    if (!missing) return [];
    const more = missing > MOST_FAILURES ? ` The first ${MOST_FAILURES}:` : "";
    const said = `${missing} of ${result.speed.length} conditions have no solution.${more}`;
    return [said, ...result.failures.slice(0, MOST_FAILURES)];
  }

  curveJob.done = (result) => announce(`The friction curve is complete, ${pointsOf(result)}.`);
  curveJob.start();
  effect(() => {
    const { result } = curveOf(curveJob.result) ?? {};
    const current = curveJob.current;
    failed.set(curveJob.error ? [waits("the friction curve", curveJob.error)] : current && result ? failuresOf(result) : []);
    warnings.set(result ? warningsOf(result) : []);
    notes.set(result?.notes ?? []);
    const marks = { passed: "✓ ", warning: "Warning: ", noted: "Unknown: " };
    checks.set(result?.checks.map((one) => `${marks[one.verdict]}${one.words}`) ?? []);
    checked.hidden = !result || result.checks.length + result.notes.length === 0;
    for (const one of [warnings, checked]) shows(one, curveJob.result);
    pin.disabled = !pinned.value && !result;
    pin.textContent = pinned.value ? "Remove the kept curve" : "Keep for comparison";
  });
  effect(() => {
    const curve = curveOf(curveJob.result);
    if (curve) offer(curve.layout);
  });
  effect(() => {
    const curve = curveOf(curveJob.result);
    handle.update({ empty: curveJob.error ? "No curve yet." : "Computing the first points." });
    if (curve) draw(curve);
    if (hasPoints(curve)) before = curve;
  });

  return card;
}
