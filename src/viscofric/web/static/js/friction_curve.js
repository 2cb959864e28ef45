// The card of the friction curve: computed after each change, its points drawn as they are known, till then the one before.

import { curveTraces, ghostTraces, liveTrace, speedsOf } from "./curve_traces.js";
import { Select } from "./fields.js";
import { Figure } from "./figures.js";
import { Job, isStale } from "./jobs.js";
import { announce, waits } from "./page.js";
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
const hasPoints = (curve) => Boolean(curve?.columns.friction.some((value) => value !== null));

/** The curve's points as they come: the first part has the cases, the others values of some. */
function drafted(part, before) {
  if (part.layout) {
    const none = part.layout.speed.map(() => null);
    return { layout: part.layout, columns: { friction: none, known: none, open: none } };
  }
  const [friction, known, open] = ["friction", "known", "open"].map((name) => before.columns[name].slice());
  part.cases.forEach((at, index) => {
    friction[at] = part.friction[index];
    [known[at], open[at]] = part.known[index] ? [friction[at], null] : [null, friction[at]];
  });
  return { layout: before.layout, columns: { friction, known, open } };
}

/** The study; without its measurement, unless that tells the law of an interface. */
function predicted() {
  const { measurement, ...study } = state.study;
  return { study: study.interface ? state.study : study };
}

export const curve = new Job("curve", { wait: 350, remember: 6, part: drafted, inputs: predicted });

/** What is drawn of the job's result or of its parts: {source, layout, columns, result}. */
function curveOf(source) {
  if (!source) return null;
  return source.layout
    ? { source, result: null, ...source }
    : { source, layout: source, columns: source, result: source };
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
  const { quantities = {} } = drawn.value?.layout ?? {};
  return quantities[asked.quantity.value] ? asked.quantity.value : "friction";
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
  const axis = shownCurve.layout.quantities[look.quantity];
  const shifted = look.view === "shifted";
  const traces = [
    ...ghostTraces(pinned.value, look, "kept", "6px,4px"),
    ...(hasPoints(shownCurve) ? [] : ghostTraces(before, look, "before", "solid")),
    ...curveTraces(shownCurve, look),
    ...liveTrace(isStale(live.result) ? null : live.result, look),
  ];
  const speed = shifted ? `α(T)·v at ${units.show(shownCurve.layout.reference, "temperature")}` : "speed";
  return {
    of: shownCurve.source,
    title: `${axis.label[0].toUpperCase()}${axis.label.slice(1)} against ${shifted ? "reduced speed" : "speed"}`,
    caption: curve.error ? "Previous curve." : caption(shownCurve, shifted),
    x: { label: speed, kind: "speed", log: true, range: speedsOf(shownCurve, look) },
    y: { ...axis, log: state.view("curve.log", false), zero: 1.06 },
    temperatures: shownCurve.layout.temperature,
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
  return html`<${Figure} id="friction-curve" title="Friction against speed" x=${x} y=${{ label: "friction coefficient μ" }}
    empty=${curve.error ? "No curve yet." : "Computing the first points."} onClick=${pick} ...${found} />`;
});

/** What is shown, of what there is of this kind of contact and this study. */
const Tools = view(() => {
  const { quantities = {}, combinations = [] } = drawn.value?.layout ?? {};
  const { result } = drawn.value ?? {};
  const pin = () => {
    pinned.value = pinned.value ? null : drawn.value;
    announce(pinned.value ? "The curve is kept, in grey." : "The kept curve is removed.");
  };
  return html`<div class="row curve-tools">
    <${Select} aria-label="Against" options=${VIEWS} value=${against()} onChange=${(one) => state.setView("curve.view", one)} />
    <${Select} aria-label="Shown" options=${Object.entries(quantities).map(([name, { label }]) => [name, label])}
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
    <${Notes} of=${of} kind="warning" list=${result?.warnings} />
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
