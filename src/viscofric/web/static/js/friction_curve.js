// The card of the friction curve: computed after each change, its points drawn as they are known, till then the one before.

import { Figure, temperatureColour } from "./figures.js";
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
import { Select } from "./fields.js";
import { Job, isStale, studyOf } from "./jobs.js";
import { announce, isSynthetic, waits } from "./page.js";
import { computed, html, signal, view } from "./reactive.js";
import { state } from "./state.js";
import * as units from "./units.js";
import { Button, Card, Folded, Notes, Progress } from "./views.js";

const VIEWS = [
  ["speed", "against speed"],
  ["shifted", "against reduced speed α(T)·v"],
];
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

export const curve = new Job("curve", { wait: 350, remember: 6, part: drafted, inputs: predicted });

/** What is drawn of the job's result or of its parts: {source, layout, points, result}. */
function curveOf(source) {
  if (!source) return null;
  if (source.layout) return { source, ...source, result: null };
  const { friction } = source;
  return {
    source,
    layout: source,
    points: { friction, known: friction.map((value) => value !== null) },
    result: source,
  };
}

/** The newest curve, of whatever inputs. */
const drawn = computed(() => curveOf(curve.result));
const pinned = signal(null); // a curve that is kept for comparison
const asked = { quantity: signal("friction"), combination: signal(0) };
let before = null; // the curve that is shown in grey till there is something to show

/** Which of the combinations of all else that varies is shown. */
export const combination = computed(() =>
  Math.min(asked.combination.value, (drawn.value?.layout.combinations.length ?? Infinity) - 1),
);
const quantity = computed(() => {
  const { layout } = drawn.value ?? {};
  return layout && !hasQuantity(asked.quantity.value, layout) ? "friction" : asked.quantity.value;
});
const against = () => state.view("curve.view", "speed");

const pointsOf = ({ friction, speed }) => {
  const missing = missingOf({ friction });
  return `${missing ? `${speed.length - missing} of ` : ""}${speed.length} points`;
};
const endOf = ({ cancelled, seconds }) =>
  cancelled ? "Cancelled." : `${pointsOf(curve.result)} in ${units.plainNumber(seconds, 2)} s`;

function caption({ result, ...shownCurve }, shifted) {
  if (!hasPoints(shownCurve)) return before ? "Grey: previous curve." : "";
  const known = result
    ? result.lower?.some((value) => value !== null) && "Bands: 95 %, from the material's uncertainty."
    : "Filled points have the requested accuracy; open ones are interpolated and may still be refined.";
  const parts = [
    shifted &&
      "Each temperature is shifted by its shift factor: where the curves coincide, time–temperature superposition holds.",
    known,
    result?.doubts.some((words) => words.length > 0) && "Ringed points are doubtful; hover to see why.",
    "Click a point to see its contact below.",
  ];
  return parts.filter(Boolean).join(" ");
}

/** What the figure shows of a curve and of the live contact. */
function drawing(shownCurve, live) {
  const look = { view: against(), quantity: quantity.value, combination: combination.value };
  const { label, kind } = quantityOf(look.quantity, shownCurve.layout);
  const shifted = look.view === "shifted";
  const traces = [
    ...ghostTraces(pinned.value, look, "kept", "6px,4px"),
    ...(hasPoints(shownCurve) ? [] : ghostTraces(before, look, "before", "solid")),
    ...curveTraces(shownCurve, look, { units, temperatureColour }),
    ...liveTrace(isStale(live.result) ? null : live.result, look, units),
  ];
  const speed = shifted ? `α(T)·v at ${units.show(shownCurve.layout.reference, "temperature")}` : "speed";
  return {
    of: shownCurve.source,
    title: `${label[0].toUpperCase()}${label.slice(1)} against ${shifted ? "reduced speed" : "speed"}`,
    caption: curve.error ? "Previous curve." : caption(shownCurve, shifted),
    x: { label: speed, kind: "speed", log: true, range: speedsOf(shownCurve, look) },
    y: state.view("curve.log", false) ? { label, kind, log: true } : { label, kind, range: valuesOf(traces) },
    temperatures: shownCurve.layout.temperature,
    synthetic: isSynthetic(studyOf(shownCurve.source)),
    traces,
  };
}

const Curve = view(({ live, onPick }) => {
  const pick = (point) => {
    const at = point?.customdata;
    const { layout } = drawn.peek() ?? {};
    if (layout && Number.isInteger(at)) onPick({ speed: layout.speed[at], temperature: layout.temperature[at] });
  };
  const x = { label: "speed", kind: "speed", log: true };
  const shownCurve = drawn.value;
  const found = shownCurve && drawing(shownCurve, live);
  if (hasPoints(shownCurve)) before = shownCurve;
  return html`<${Figure} id="friction-curve" title="Friction against speed" x=${x} y=${{ label: QUANTITIES.friction.label }}
    empty=${curve.error ? "No curve yet." : "Computing the first points."} onClick=${pick} ...${found} />`;
});

/** What is shown, of what there is of this kind of contact and this study. */
const Tools = view(() => {
  const layout = drawn.value?.layout ?? { kind: "point" };
  const of = Object.keys(QUANTITIES).filter((name) => hasQuantity(name, layout));
  const combinations = layout.combinations ?? [];
  const { result } = drawn.value ?? {};
  const pin = () => {
    pinned.value = pinned.value ? null : drawn.value;
    announce(pinned.value ? "The curve is kept, in grey." : "The kept curve is removed.");
  };
  return html`<div class="row curve-tools">
    <${Select} aria-label="Against" options=${VIEWS} value=${against()} onChange=${(one) => state.setView("curve.view", one)} />
    <${Select} aria-label="Shown" options=${of.map((name) => [name, quantityOf(name, layout).label])}
      value=${quantity.value} onChange=${(one) => (asked.quantity.value = one)} />
    ${
      combinations.length > 1 &&
      html`<${Select} aria-label="Combination" options=${combinations.map((words, at) => [at, words])}
        value=${combination.value} onChange=${(one) => (asked.combination.value = one)} />`
    }
    <label class="row tick">
      <input type="checkbox" checked=${state.view("curve.log", false)}
        onChange=${({ target }) => state.setView("curve.log", target.checked)} />log scale
    </label>
    <${Button} kind="small" disabled=${!pinned.value && !result} onClick=${pin}>
      ${pinned.value ? "Remove the kept curve" : "Keep for comparison"}
    <//>
  </div>`;
});

function warningsOf({ doubts, speed, warnings }) {
  const unresolved = doubts.filter((words) => words.includes("unresolved")).length;
  const said =
    `At ${unresolved} of ${speed.length} points the grid does not resolve friction to the requested accuracy; ` +
    "the error bars show its accuracy.";
  return [...warnings, unresolved && said];
}

function failuresOf(result) {
  const missing = missingOf(result);
  if (!missing) return [];
  const more = missing > MOST_FAILURES ? ` The first ${MOST_FAILURES}:` : "";
  const said = `${missing} of ${result.speed.length} conditions have no solution.${more}`;
  return [said, ...result.failures.slice(0, MOST_FAILURES)];
}

const MARKS = { passed: "✓ ", warning: "Warning: ", noted: "Unknown: " };
const Words = view(() => {
  const { source: of, result } = drawn.value ?? {};
  const failures = curve.current && result ? failuresOf(result) : [];
  const { checks = [], notes = [] } = result ?? {};
  return html`
    <${Notes} kind="error" list=${curve.error ? [waits("the friction curve", curve.error)] : failures} />
    <${Notes} of=${of} kind="warning" list=${result ? warningsOf(result) : []} />
    <${Folded} title="Checks" hidden=${checks.length + notes.length === 0}>
      <${Notes} of=${of} list=${checks.map(({ verdict, words }) => `${MARKS[verdict]}${words}`)} />
      <${Notes} of=${of} list=${notes} />
    <//>
  `;
});

/** The card; onPick({speed, temperature}) is called for a point that was clicked, `live` is the job of the marked contact. */
export const FrictionCard = ({ live, onPick }) => {
  curve.done = (result) => announce(`The friction curve is complete, ${pointsOf(result)}.`);
  return html`<${Card} title="Friction">
    <${Curve} live=${live} onPick=${onPick} />
    <${Progress} job=${curve} label="Solving" ended=${endOf} />
    <${Tools} />
    <${Words} />
  <//>`;
};
