// The card of the friction curve: computed after each change, its points drawn as they are known, till then the one before.

import { Select } from "./fields.js";
import { Figure } from "./figures.js";
import { Job, isStale } from "./jobs.js";
import { announce, waits } from "./page.js";
import { computed, html, signal, view } from "./reactive.js";
import { state } from "./state.js";
import * as units from "./units.js";
import { Button, Card, Checks, Folded, Notes, Progress } from "./views.js";

// What is drawn of a curve, {speed, reduced_speed, curves of its cases (jobs/curve.py), friction, …}: points as they become
// known, bands and doubts at the end, other curves in grey.  A look is {view: "speed" | "shifted", quantity, combination}.

const GREY = "grey";
// a curve on its way: what is known to the accuracy filled, what lies between contacts that may be refined open
const DRAFT = [
  { y: "friction", mode: "lines", width: 1, legend: false, dash: "3px,3px" },
  { y: "known", mode: "markers", size: 6 },
  { y: "open", mode: "markers", size: 5, open: true, legend: false },
];
const DASHES = { "6px,4px": "Thin dashes", "2px,3px": "Thin dots" };
const COLUMNS = ["y", "lower", "upper", "error", "text"];

const isThere = (value) => value !== null && value !== undefined;
const along = (curve, view) => (view === "shifted" ? curve.reduced_speed : curve.speed);
const ofCombination = ({ curves }, { combination }) => curves.filter((one) => one.combination === combination);

/** A part of a curve at those of its rows that have a value; its columns are named. */
function placed(curve, view, rows, part) {
  const data = rows.filter((at) => isThere(curve[part.y]?.[at]));
  const read = (values) => (at) => (Array.isArray(values) ? values[at] : values);
  const found = COLUMNS.filter((name) => part[name]).map((name) => [
    name,
    data.map(read(curve[part[name]] ?? part[name])),
  ]);
  return { ...part, data, x: data.map(read(along(curve, view))), ...Object.fromEntries(found) };
}

/** All speeds of the cases, with a little space: a figure that stays where it is while points come. */
function speedsOf(curve, look) {
  const all = ofCombination(curve, look).flatMap(({ rows }) => rows.map((at) => along(curve, look.view)[at]));
  const gap = all.length > 1 ? 1.15 : 3;
  return [Math.min(...all) / gap, Math.max(...all) * gap];
}

/** The traces of a curve: a line for each temperature, and rings around what is doubtful. */
function curveTraces(curve, look) {
  const { view, quantity } = look;
  const parts = curve.parts?.[quantity] ?? (quantity === "friction" ? DRAFT : []);
  const lines = ofCombination(curve, look).flatMap(({ temperature, rows }) =>
    parts.map(({ words, ...part }) => ({
      temperature,
      group: `T${temperature}`,
      ...placed(curve, view, rows, part),
      ...(words && { name: `${units.show(temperature, "temperature")}, ${words}` }),
    })),
  );
  // the legend is there from the start
  const shown = lines.filter((trace) => trace.x.length > 0 || trace.legend !== false);
  return curve.parts ? [...masterLine(curve, look), ...shown, ...ringed(curve, look)] : shown;
}

function ringed(curve, look) {
  const rows = ofCombination(curve, look)
    .flatMap((one) => one.rows)
    .filter((at) => curve.doubts[at].length > 0);
  const ring = { mode: "markers", symbol: "circle", open: true, size: 13, colour: "orange", decoration: true };
  const trace = placed(curve, look.view, rows, { name: "doubtful", y: look.quantity, text: "remarks", ...ring });
  return trace.x.length ? [trace] : [];
}

function masterLine({ master }, { view, quantity }) {
  if (view !== "shifted" || quantity !== "friction" || !master) return [];
  const { reduced_speed: x, friction: y, lower, upper } = master;
  return [{ name: "master curve", x, y, lower, upper, mode: "lines", colour: GREY, width: 1.2 }];
}

/** Another curve in grey; none where something else than friction is shown. */
function ghostTraces(curve, look, name, dash) {
  if (!curve || look.quantity !== "friction") return [];
  const combination = Math.min(look.combination, curve.combinations.length - 1);
  const part = { y: "friction", mode: "lines", colour: GREY, width: 1.6, dash, decoration: true, name, group: name };
  return ofCombination(curve, { combination }).map(({ rows }, index) => ({
    ...placed(curve, look.view, rows, part),
    legend: index === 0,
  }));
}

/** Where the live contact is on the curve. */
function liveTrace(live, { view, quantity }) {
  if (!live || quantity !== "friction") return [];
  const { friction_coefficient: friction, reduced_speed: reduced } = live.numbers;
  const star = { mode: "markers", symbol: "star", size: 13, colour: "purple", decoration: true };
  const x = view === "shifted" ? reduced.value : live.speed;
  return [
    { name: "live contact", x: [x], y: [friction.value], text: [units.show(live.temperature, "temperature")], ...star },
  ];
}

const VIEWS = [
  ["speed", "against speed"],
  ["shifted", "against reduced speed α(T)·v"],
];

const missingOf = (result) => result.friction.filter((value) => value === null).length;
const hasPoints = (curve) => Boolean(curve?.friction.some((value) => value !== null));

/** The curve's points as they come: the first part has the cases, the others values of some. */
function drafted(part, before) {
  if (part.layout) {
    const none = part.layout.speed.map(() => null);
    return { ...part.layout, friction: none, known: none, open: none };
  }
  const [friction, known, open] = ["friction", "known", "open"].map((name) => before[name].slice());
  part.cases.forEach((at, index) => {
    friction[at] = part.friction[index];
    [known[at], open[at]] = part.known[index] ? [friction[at], null] : [null, friction[at]];
  });
  return { ...before, friction, known, open };
}

/** The study; without its measurement, unless that tells the law of an interface. */
function predicted() {
  const { measurement, ...study } = state.study;
  return { study: study.interface ? state.study : study };
}

export const curve = new Job("curve", { wait: 350, remember: 6, part: drafted, inputs: predicted });

/** The newest curve, of whatever inputs; it has `parts` once all is known. */
const drawn = computed(() => curve.result);
const pinned = signal(null); // a curve that is kept for comparison
const asked = { quantity: signal("friction"), combination: signal(0) };
let before = null; // the curve that is shown in grey till there is something to show

/** Which of the combinations of all else that varies is shown. */
export const combination = computed(() =>
  Math.min(asked.combination.value, (drawn.value?.combinations.length ?? Infinity) - 1),
);
const quantity = computed(() => {
  const { quantities = {} } = drawn.value ?? {};
  return quantities[asked.quantity.value] ? asked.quantity.value : "friction";
});
const against = () => state.view("curve.view", "speed");

const pointsOf = ({ friction, speed }) => {
  const missing = missingOf({ friction });
  return `${missing ? `${speed.length - missing} of ` : ""}${speed.length} points`;
};
const endOf = ({ cancelled, seconds }) =>
  cancelled ? "Cancelled." : `${pointsOf(curve.result)} in ${units.plainNumber(seconds, 2)} s`;

function caption(shownCurve, look) {
  if (!hasPoints(shownCurve)) return before ? "Grey: previous curve." : "";
  const { parts: whole, doubts } = shownCurve;
  const [main, ...beside] = whole?.[look.quantity] ?? [];
  const parts = [
    look.view === "shifted" &&
      "Each temperature is shifted by its shift factor: where the curves coincide, time–temperature superposition holds.",
    !whole && "Filled points have the requested accuracy; open ones are interpolated and may still be refined.",
    main?.lower && "Bands: 95 %, from the material's uncertainty.",
    main?.error && "Bars: estimated error.",
    ...beside.map(({ dash, words }) => `${DASHES[dash]}: ${words}.`),
    whole && doubts.some((words) => words.length > 0) && "Ringed points are doubtful.",
  ];
  return parts.filter(Boolean).join(" ");
}

/** What the figure shows of a curve and of the live contact. */
function drawing(shownCurve, live) {
  const look = { view: against(), quantity: quantity.value, combination: combination.value };
  const axis = shownCurve.quantities[look.quantity];
  const shifted = look.view === "shifted";
  const traces = [
    ...ghostTraces(pinned.value, look, "kept", "6px,4px"),
    ...(hasPoints(shownCurve) ? [] : ghostTraces(before, look, "before", "solid")),
    ...curveTraces(shownCurve, look),
    ...liveTrace(isStale(live.result) ? null : live.result, look),
  ];
  const speed = shifted ? `α(T)·v at ${units.show(shownCurve.reference, "temperature")}` : "speed";
  return {
    of: shownCurve,
    title: `${axis.label[0].toUpperCase()}${axis.label.slice(1)} against ${shifted ? "reduced speed" : "speed"}`,
    caption: curve.error ? "Previous curve." : caption(shownCurve, look),
    hint: !curve.error && hasPoints(shownCurve) && "Click a point to see its contact below; hover to see its numbers and doubts.",
    x: { label: speed, kind: "speed", log: true, range: speedsOf(shownCurve, look) },
    y: { ...axis, log: state.view("curve.log", false), zero: 1.06 },
    temperatures: shownCurve.temperature,
    traces,
  };
}

const Curve = view(({ live, onPick }) => {
  const pick = (point) => {
    const at = point?.customdata;
    const { speed, temperature } = drawn.peek() ?? {};
    if (speed && Number.isInteger(at)) onPick({ speed: speed[at], temperature: temperature[at] });
  };
  const x = { label: "speed", kind: "speed", log: true };
  const shownCurve = drawn.value;
  const found = shownCurve && drawing(shownCurve, live);
  if (hasPoints(shownCurve)) before = shownCurve;
  return html`<${Figure} id="friction-curve" title="Friction against speed" x=${x} y=${{ label: "friction coefficient μ" }}
    empty=${curve.error ? "No curve yet: see the message below." : "Computing the first points."} onClick=${pick} ...${found} />`;
});

/** What is shown, of what there is of this kind of contact and this study. */
const Tools = view(() => {
  const { quantities = {}, combinations = [], parts } = drawn.value ?? {};
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
    <${Button} kind="small" disabled=${!pinned.value && !parts} onClick=${pin}>
      ${pinned.value ? "Remove the kept curve" : "Keep for comparison"}
    <//>
  </div>`;
});

const Words = view(() => {
  const of = drawn.value;
  const { checks = [], notes = [] } = of ?? {};
  return html`
    <${Notes} kind="error" list=${[curve.error && waits("the friction curve", curve.error)]} />
    <${Notes} of=${of} kind="error" list=${of?.missing} />
    <${Notes} of=${of} kind="warning" list=${of?.warnings} />
    <${Folded} title="Checks" hidden=${checks.length + notes.length === 0}>
      <${Checks} of=${of} list=${checks} />
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
