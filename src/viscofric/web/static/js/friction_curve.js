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
import { DEPENDS_ON, isCurrent, outdated, shows, studyOf } from "./inputs.js";

const RESTS = 350; // ms, after the last change of the form
const VIEWS = { speed: "against speed", shifted: "against reduced speed α(T)·v" };
const MOST_FAILURES = 5;

const missingOf = (result) => result.friction.filter((value) => value === null).length;
const hasPoints = (curve) => Boolean(curve?.points?.friction.some((value) => value !== null));

/** Make the card.  onPick({speed, temperature}) is called for a point that was clicked, onPick({}) for another combination. */
export function frictionCard({ state, units, figures, fields, api, announce, waits, isSynthetic }, { onPick }) {
  const { h, button } = fields;
  let curve = null; // that is shown: {source, layout, points, result}; the source is the job's part or result
  let before = null; // that is shown in grey till there is something to show
  let pinned = null; // that is kept for comparison
  let live = null;
  let combination = 0;
  let running = null;
  let timer = null;

  const bar = fields.progressBar({ label: "Solving", onCancel: () => running?.abort() });
  const warnings = fields.note([], "warning");
  const failed = fields.note([], "error");
  const notes = fields.note([]);
  const checks = fields.note([]);
  const checked = h("details", { hidden: true }, h("summary", {}, "Checks"), checks, notes);

  const chooser = (label, entries, onChange) => {
    const options = entries.map(([value, text]) => h("option", { value }, text));
    const select = h("select", { "aria-label": label }, options);
    select.addEventListener("change", () => onChange(select.value));
    return select;
  };
  const view = chooser("Against", Object.entries(VIEWS), (value) => {
    state.setView("curve.view", value);
    draw();
  });
  view.value = state.view("curve.view", "speed");
  const quantities = Object.entries(QUANTITIES).map(([value, { label }]) => [value, label]);
  const quantity = chooser("Shown", quantities, () => draw());
  const which = chooser("Combination", [], (value) => {
    combination = Number(value);
    draw();
    onPick({});
  });
  which.hidden = true;
  const log = h("input", { type: "checkbox", id: "curve-log", checked: state.view("curve.log", false) });
  log.addEventListener("change", () => {
    state.setView("curve.log", log.checked);
    draw();
  });
  const scale = h("label", { class: "row tick", for: log.id }, log, "log scale");
  const pin = button({ label: "Keep for comparison", kind: "small", onClick: () => keep(pinned ? null : curve) });
  const card = fields.card("Friction");
  const handle = figures.figure(card, {
    id: "friction-curve",
    title: "Friction against speed",
    x: { label: "speed", kind: "speed", log: true },
    y: { label: QUANTITIES.friction.label },
    empty: "Computing the first points.",
    onClick: pick,
  });
  const tools = h("div", { class: "row curve-tools" }, view, quantity, which, scale, pin);
  card.append(bar, tools, failed, warnings, checked);

  function keep(some) {
    pinned = some;
    announce(pinned ? "The curve is kept, in grey." : "The kept curve is removed.");
    draw();
  }

  function pick(point) {
    const at = point?.customdata;
    if (curve && Number.isInteger(at))
      onPick({ speed: curve.layout.speed[at], temperature: curve.layout.temperature[at] });
  }

  function draw() {
    if (!curve) return;
    const look = { view: view.value, quantity: quantity.value, combination };
    const { label, kind } = quantityOf(look.quantity, curve.layout);
    const shifted = look.view === "shifted";
    const traces = [
      ...ghostTraces(pinned, look, "kept", "6px,4px"),
      ...(hasPoints(curve) ? [] : ghostTraces(before, look, "before", "solid")),
      ...curveTraces(curve, look, { units, figures }),
      ...liveTrace(isCurrent(live) ? live : null, look, units),
    ];
    const speed = shifted ? `α(T)·v at ${units.show(curve.layout.reference, "temperature")}` : "speed";
    handle.update({
      of: curve.source,
      title: `${label[0].toUpperCase()}${label.slice(1)} against ${shifted ? "reduced speed" : "speed"}`,
      caption: caption(shifted),
      x: { label: speed, kind: "speed", log: true, range: speedsOf(curve, look) },
      y: log.checked ? { label, kind, log: true } : { label, kind, range: valuesOf(traces) },
      temperatures: curve.layout.temperature,
      synthetic: isSynthetic(studyOf(curve.source)),
      traces,
    });
    for (const one of [warnings, checked]) shows(one, curve.source);
    pin.disabled = !pinned && !curve.result;
    pin.textContent = pinned ? "Remove the kept curve" : "Keep for comparison";
  }

  function caption(shifted) {
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
  function offer() {
    const { layout } = curve;
    combination = Math.min(combination, layout.combinations.length - 1);
    which.hidden = layout.combinations.length < 2;
    which.replaceChildren(...layout.combinations.map((words, at) => h("option", { value: String(at) }, words)));
    which.value = String(combination);
    for (const option of quantity.options) {
      option.hidden = option.disabled = !hasQuantity(option.value, layout);
      option.textContent = quantityOf(option.value, layout).label;
    }
    if (!hasQuantity(quantity.value, layout)) quantity.value = "friction";
  }

  function take(part) {
    if (part.layout) {
      if (hasPoints(curve)) before = curve;
      const cases = part.layout.speed;
      const points = { friction: cases.map(() => null), known: cases.map(() => false) };
      curve = { source: part, layout: part.layout, points, result: null };
      warnings.set([]);
      checked.hidden = true;
      offer();
    } else {
      part.cases.forEach((at, index) => {
        curve.points.friction[at] = part.friction[index];
        curve.points.known[at] = part.known[index];
      });
    }
    draw();
  }

  function finish(result) {
    const points = { friction: result.friction, known: result.friction.map((value) => value !== null) };
    curve = { source: result, layout: result, points, result };
    before = null;
    const unresolved = result.doubts.filter((words) => words.includes("unresolved")).length;
    const said =
      `At ${unresolved} of ${result.speed.length} points the grid does not resolve friction to the requested accuracy; ` +
      "the error bars show its accuracy.";
    warnings.set([...result.warnings, ...(unresolved ? [said] : [])]);
    const missing = missingOf(result);
    const more = missing > MOST_FAILURES ? ` The first ${MOST_FAILURES}:` : "";
    failed.set(
      missing
        ? [
            `${missing} of ${result.speed.length} conditions have no solution.${more}`,
            ...result.failures.slice(0, MOST_FAILURES),
          ]
        : [],
    );
    notes.set(result.notes);
    const marks = { passed: "✓ ", warning: "Warning: ", noted: "Unknown: " };
    checks.set(result.checks.map((one) => `${marks[one.verdict]}${one.words}`));
    checked.hidden = result.checks.length + result.notes.length === 0;
    state.setResult("curve", result);
    draw();
  }

  async function solve() {
    running?.abort();
    const mine = new AbortController();
    running = mine;
    const begun = performance.now();
    bar.start("Solving");
    failed.set([]);
    fields.clearError("curve");
    const heard = {
      signal: mine.signal,
      onPart: (part) => running === mine && take(part),
      onProgress: ({ done, total, label }) => running === mine && bar.set(Math.round(done), total, label),
    };
    try {
      const result = await api.runJob("curve", { study: state.study, options: {} }, heard);
      if (running !== mine) return;
      finish(result);
      const missing = missingOf(result);
      const points = `${missing ? `${result.speed.length - missing} of ` : ""}${result.speed.length} points`;
      bar.finish(`${points} in ${units.plainNumber((performance.now() - begun) / 1000, 2)} s`);
      announce(`The friction curve is complete, ${points}.`);
    } catch (error) {
      if (running !== mine) return;
      bar.finish(error.name === "AbortError" ? "Cancelled." : "");
      if (error.name !== "AbortError") fail(error);
    }
    if (running === mine) running = null;
  }

  function fail(error) {
    failed.set([waits("the friction curve", error, "curve")]);
    outdated(curve?.source);
    handle.update({ caption: curve ? "Previous curve." : "", empty: "No curve yet." });
    state.setResult("curve", null);
  }

  state.subscribe(DEPENDS_ON.curve, () => {
    clearTimeout(timer);
    timer = setTimeout(solve, RESTS);
  });
  units.subscribe(draw);
  document.addEventListener("themechange", draw);
  solve();

  return {
    card,
    get combination() {
      return combination;
    },
    /** Show where the live contact is on the curve. */
    mark(contact) {
      live = contact;
      draw();
    },
  };
}
