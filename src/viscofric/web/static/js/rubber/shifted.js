// The isotherms on one another, and one of them corrected by hand: dragged, or moved by a slider or a number.

import { Select } from "../fields.js";
import { Figure, pick, picked } from "../figures.js";
import { Job, inputsOf } from "../jobs.js";
import { announce } from "../page.js";
import { computed, html, signal, view, watch } from "../reactive.js";
import { state } from "../state.js";
import * as units from "../units.js";
import { Button, Card, Pick } from "../views.js";
import { draggable, moveTrace } from "./drag.js";
import { decades, named, rubber, worded } from "./source.js";

const QUANTITIES = [
  ["storage_modulus", "E′"],
  ["loss_modulus", "E″"],
  ["loss_tangent", "tan δ"],
];
const REACH = 3; // decades
const STEP = 0.02;
const SETTLE = 400; // ms after the last key

const quantity = signal("storage_modulus");
const moved = signal(0); // decades, while the slider or the mouse moves it
const isotherms = () => rubber.shown?.shift?.isotherms ?? [];
/** Whether isotherms can be moved: neither factors of a file nor those of several kinds of tests are. */
const movable = () => !rubber.shown?.shift?.not_correctable;
/** The isotherm that can be moved: the one nearest to the chosen one, or else the first that is not the reference. */
const chosen = computed(() => {
  const all = isotherms();
  const first = all.find((one) => !one.is_reference) ?? all[0] ?? null;
  if (picked() === null || !first) return first;
  const away = (one) => Math.abs(one.temperature - picked());
  return all.reduce((best, one) => (away(one) < away(best) ? one : best), first);
});
const misfits = new Job("isotherm_misfit", {
  wait: 0,
  remember: 6,
  when: () => Boolean(rubber.current),
  inputs: () => {
    if (!chosen.value || chosen.value.is_reference || !movable()) return null;
    const options = { temperature: worded(chosen.value.temperature), reach: REACH, step: STEP };
    return { study: { material: state.study.material }, options };
  },
});

/** Begin to follow the rubber. */
export function startShifted() {
  misfits.start();
  watch(
    () => [inputsOf(rubber.shown), chosen.value?.temperature].join(),
    () => (moved.value = 0),
  );
}

/** The isotherms moved onto each other, and what is needed to move one by hand. */
export const Shifted = view(({ of }, self) => {
  const drawn = (plot) => {
    self.plot = plot;
    draggable(plot, {
      can: (index) => movable() && isotherms()[index]?.is_reference === false,
      onStart: (index) => pick(isotherms()[index].temperature),
      onMove: (index, by) => (moved.value = Math.round(by / STEP) * STEP),
      onEnd: (index, by) => ((moved.value = 0), holdMoved(by)),
    });
  };
  const move = (by) => {
    const one = chosen.value;
    moved.value = by;
    moveTrace(self.plot, isotherms().indexOf(one), units.number(one.angular_frequency, "angular_frequency"), by);
  };
  return html`<div class="columns">
    <div><${Correction} of=${of} move=${move} /></div>
    <div>
      <${Card} title="Shifted isotherms">
        <${Pick} label="Quantity" options=${QUANTITIES} value=${quantity.value} onChange=${(one) => (quantity.value = one)} />
        <${Figure} id="shifted-isotherms" height=${430} onPlot=${drawn} of=${of} spec=${figureOf(of)} />
      <//>
    </div>
  </div>`;
});

/** The chosen quantity of the shifted isotherms; the one that can be moved is strong. */
function figureOf(of) {
  const spec = of.figures[`shifted-${quantity.value}`];
  const at = isotherms().indexOf(chosen.value);
  return { ...spec, traces: spec.traces.map((one, index) => (index === at ? { ...one, size: 9, width: 3 } : one)) };
}

const mark = ({ is_reference: reference, held: fixed }) => (reference ? " (reference)" : fixed ? " (fixed)" : "");
const holdMoved = (by) => by && hold(chosen.value.temperature, chosen.value.log10_shift + by);

/** The fields of the isotherm that can be moved; `move(by)` shows it elsewhere. */
const Correction = view(({ of, move }, self) => {
  const { not_correctable: why, isotherms: all } = of.shift;
  const one = chosen.value;
  const settle = ({ target }) => {
    clearTimeout(self.timer);
    self.timer = setTimeout(() => holdMoved(Number(target.value)), SETTLE);
  };
  const exactly = ({ target }) => {
    const given = Number(target.value);
    if (target.value !== "" && Number.isFinite(given)) hold(one.temperature, given);
  };
  return html`<${Card} title="Correct one isotherm">
    <p class="help">Drag the isotherm in the figure, or use these fields. Its shift is then fixed, and the others are refitted.</p>
    ${why && html`<p class="help">${why}</p>`}
    <div class="panel" hidden=${!movable()}>
      <div class="field">
        <label class="field-label" for="dragged-isotherm">Isotherm</label>
        <${Select} id="dragged-isotherm" value=${one.temperature} onChange=${pick}
          options=${all.map((each) => [each.temperature, `${named(each.temperature)}${mark(each)}`])} />
      </div>
      <div class="field">
        <label class="field-label" for="dragged-by">Shift by (decades)</label>
        <input type="range" id="dragged-by" min=${-REACH} max=${REACH} step=${STEP} value=${moved.value}
          disabled=${one.is_reference} onInput=${({ target }) => move(Number(target.value))} onChange=${settle} />
      </div>
      <div class="field">
        <label class="field-label" for="dragged-to">log₁₀ α of this isotherm</label>
        <input type="number" id="dragged-to" step="0.01" value=${(one.log10_shift + moved.value).toFixed(3)}
          disabled=${one.is_reference} onChange=${exactly} />
      </div>
      <p class="help" aria-live="polite" id="dragged-misfit">${inWords(one, moved.value)}</p>
      <div class="row">
        <${Button} kind="small" disabled=${!one.held} onClick=${() => release(one.temperature)}>Undo this correction<//>
        <${Button} kind="small" disabled=${!all.some((each) => each.held)} onClick=${() => state.set(HELD, undefined)}>
          Undo all corrections
        <//>
      </div>
    </div>
  <//>`;
});

/** Where the isotherm is, and how far from its neighbours. */
function inWords(one, by) {
  if (one.is_reference)
    return "This is the reference isotherm (α = 1): choose another reference temperature to shift it.";
  if (misfits.error) return misfits.error.message;
  const table = misfits.current;
  const misfitAt = (distance) => table?.misfit[Math.round((distance - table.moved[0]) / STEP)] ?? null;
  const [misfit, now] = [misfitAt(by), misfitAt(0)];
  const about = [by ? `Shifted by ${decades(by)}` : one.held ? "Fixed manually" : "Fitted"];
  const before = by && now !== null ? `, before ${now.toFixed(3)}` : "";
  if (misfit !== null) about.push(`distance from its neighbours ${decades(misfit, 3)} (rms)${before}`);
  else if (table) about.push("no overlap with its neighbours");
  return `${about.join("; ")}.`;
}

// Shift factors fixed manually, in the run file's words: { "60 degC" = -2.1 }.  Factors are about a reference, and would
// mean something else about another one: its field removes them (also, in forms/others.py).

const HELD = "material.fixed_shift_factors";

const held = () => state.get(HELD) ?? {};
const keyOf = (kelvin) =>
  Object.keys(held()).find((key) => Math.abs((units.parse(key, "temperature") ?? -1) - kelvin) < 0.5);

const setHeld = (factors) => state.set(HELD, Object.keys(factors).length ? factors : undefined);

function hold(kelvin, log10) {
  setHeld({ ...held(), [keyOf(kelvin) ?? worded(kelvin)]: Number(log10.toFixed(4)) });
  announce(`${named(kelvin)}: log10 α fixed at ${log10.toFixed(2)}.`);
}

function release(kelvin) {
  const { [keyOf(kelvin)]: gone, ...left } = held();
  setHeld(left);
}
