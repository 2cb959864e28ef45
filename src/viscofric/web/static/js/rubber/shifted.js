// The isotherms on one another, and one of them corrected by hand: dragged, or moved by a slider or a number.

import { Job, inputsOf } from "../jobs.js";
import { computed, effect, signal, watch } from "../reactive.js";
import { state } from "../state.js";
import { draggable, moveTrace } from "./drag.js";
import { byTemperature, decades, fewEnough, named, pick, rubber, shownRubber, synthetic, worded } from "./made.js";

const QUANTITIES = [
  ["storage_modulus", "E′"],
  ["loss_modulus", "E″"],
  ["loss_tangent", "tan δ"],
];
const REACH = 3; // decades
const STEP = 0.02;
const SETTLE = 400; // ms after the last key

const wanted = signal(null); // the isotherm that the user chose, K
const isotherms = () => shownRubber()?.shift?.isotherms ?? [];
/** Whether isotherms can be moved: neither factors of a file nor those of several kinds of tests are. */
const movable = () => {
  const { origin, joint } = shownRubber()?.shift ?? {};
  return origin !== "given" && !joint;
};
/** The isotherm that can be moved: the one nearest to the chosen one, or else the first that is not the reference. */
const chosen = computed(() => {
  const all = isotherms();
  const first = all.find((one) => !one.is_reference) ?? all[0] ?? null;
  if (wanted.value === null || !first) return first;
  const away = (one) => Math.abs(one.temperature - wanted.value);
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

/** The isotherms moved onto each other, and what is needed to move one by hand. */
export function shiftedCard(app) {
  const { fields, figures, units } = app;
  const { h, card, button } = fields;
  const quantity = signal("storage_modulus");
  const moved = signal(0); // decades, while the slider or the mouse moves it
  let timer = null;
  misfits.start();
  const element = card("Shifted isotherms");
  const choice = pick(
    { label: "Quantity", options: QUANTITIES, value: quantity.value, onChange: (value) => (quantity.value = value) },
    fields,
  );
  element.append(choice);
  const handle = figures.figure(element, {
    id: "shifted-isotherms",
    title: "Isotherms shifted to the reference",
    x: { label: "reduced frequency α ω", kind: "angular_frequency", log: true },
    y: { label: "E′", kind: "modulus", log: true },
    traces: [],
    height: 430,
  });

  const select = h("select", { id: "dragged-isotherm" });
  const slider = h("input", { type: "range", id: "dragged-by", min: -REACH, max: REACH, step: STEP, value: 0 });
  const exact = h("input", { type: "number", id: "dragged-to", step: 0.01 });
  const live = h("p", { class: "help", "aria-live": "polite", id: "dragged-misfit" });
  const { hold, release, releaseAll } = heldFactors(app);
  const free = button({ label: "Undo this correction", kind: "small", onClick: () => release(chosen.value.temperature) });
  const freeAll = button({ label: "Undo all corrections", kind: "small", onClick: releaseAll });
  const why = h("p", { class: "help" });
  const parts = h(
    "div",
    { class: "panel" },
    h("div", { class: "field" }, h("label", { class: "field-label", for: "dragged-isotherm" }, "Isotherm"), select),
    h(
      "div",
      { class: "field" },
      h("label", { class: "field-label", for: "dragged-by" }, "Shift by (decades)"),
      slider,
    ),
    h(
      "div",
      { class: "field" },
      h("label", { class: "field-label", for: "dragged-to" }, "log₁₀ α of this isotherm"),
      exact,
    ),
    live,
    h("div", { class: "row" }, free, freeAll),
  );
  const controls = card(
    "Correct one isotherm",
    h(
      "p",
      { class: "help" },
      "Drag the isotherm in the figure, or use these fields. Its shift is then fixed, and the others are refitted.",
    ),
    why,
    parts,
  );

  const words = () => {
    const one = chosen.value;
    if (one.is_reference)
      return "This is the reference isotherm (α = 1): choose another reference temperature to shift it.";
    if (misfits.error) return misfits.error.message;
    const by = moved.value;
    const table = misfits.current;
    const misfitAt = (distance) => table?.misfit[Math.round((distance - table.moved[0]) / STEP)] ?? null;
    const [misfit, now] = [misfitAt(by), misfitAt(0)];
    const about = [by ? `Shifted by ${decades(by)}` : one.held ? "Fixed manually" : "Fitted"];
    if (misfit !== null)
      about.push(
        `distance from its neighbours ${decades(misfit, 3)} (rms)${by && now !== null ? `, before ${now.toFixed(3)}` : ""}`,
      );
    else if (table) about.push("no overlap with its neighbours");
    return `${about.join("; ")}.`;
  };
  const holdMoved = (by) => by && hold(chosen.value.temperature, chosen.value.log10_shift + by);

  select.addEventListener("change", () => (wanted.value = Number(select.value)));
  slider.addEventListener("input", () => {
    const one = chosen.value;
    moved.value = Number(slider.value);
    const x = units.number(one.angular_frequency, "angular_frequency");
    moveTrace(handle, isotherms().indexOf(one), x, moved.value);
  });
  slider.addEventListener("change", () => {
    clearTimeout(timer);
    timer = setTimeout(() => holdMoved(Number(slider.value)), SETTLE);
  });
  exact.addEventListener("change", () => {
    const given = Number(exact.value);
    if (exact.value !== "" && Number.isFinite(given)) hold(chosen.value.temperature, given);
  });
  draggable(handle, {
    can: (index) => movable() && isotherms()[index]?.is_reference === false,
    onStart: (index) => (wanted.value = isotherms()[index].temperature),
    onMove: (index, by) => (moved.value = Math.round(by / STEP) * STEP),
    onEnd: (index, by) => ((moved.value = 0), holdMoved(by)),
  });

  watch(
    () => [inputsOf(shownRubber()), chosen.value?.temperature].join(),
    () => (moved.value = 0),
  );
  effect(() => {
    const all = isotherms();
    element.hidden = controls.hidden = all.length === 0;
    if (all.length === 0) return;
    const { origin, joint } = shownRubber().shift;
    why.textContent =
      origin === "given"
        ? "The shift factors are from a file; fit them to the sweeps to correct one."
        : joint
          ? "The shift factors are those of sweeps and step tests together; correct one with the sweeps alone."
          : "";
    parts.hidden = !movable();
    freeAll.disabled = !all.some((one) => one.held);
    const mark = ({ is_reference: reference, held }) => (reference ? " (reference)" : held ? " (fixed)" : "");
    select.replaceChildren(
      ...all.map((one) =>
        h("option", { value: String(one.temperature) }, `${named(one.temperature, app)}${mark(one)}`),
      ),
    );
    select.value = String(chosen.value.temperature);
  });
  effect(() => {
    if (!chosen.value) return;
    const { is_reference: reference, held, log10_shift: log10 } = chosen.value;
    for (const control of [slider, exact]) control.disabled = reference;
    free.disabled = !held;
    slider.value = moved.value;
    exact.value = (log10 + moved.value).toFixed(3);
    live.textContent = words();
  });
  effect(() => {
    const result = shownRubber();
    const all = isotherms();
    const temperatures = all.map((one) => one.temperature);
    const [, label] = QUANTITIES.find(([key]) => key === quantity.value);
    const tangent = quantity.value === "loss_tangent";
    handle.update({
      of: result,
      caption: [byTemperature(temperatures, app), all.some((one) => one.held) ? "Squares are fixed manually." : ""]
        .filter(Boolean)
        .join(" "),
      y: {
        label: result?.shift?.vertical && !tangent ? `${label}/b` : label,
        kind: tangent ? undefined : "modulus",
        log: true,
      },
      synthetic: result && synthetic(result, app),
      temperatures,
      traces: all.map((one) => ({
        name: named(one.temperature, app),
        legend: fewEnough(temperatures),
        temperature: one.temperature,
        x: one.angular_frequency,
        y: one[quantity.value],
        mode: "lines+markers",
        dash: "solid",
        symbol: one.held ? "square" : "circle",
        size: one === chosen.value ? 9 : 5,
        width: one === chosen.value ? 3 : 1.2,
      })),
    });
  });
  return Object.assign(element, { controls });
}

// Shift factors fixed manually, in the run file's words: { "60 degC" = -2.1 }.  Factors are about a reference, and would
// mean something else about another one: they are released when it changes.

const HELD = "material.fixed_shift_factors";
const MOST_KNOWN = 50;
const REFERENCE = "material.reference_temperature";

function heldFactors(app) {
  const { units } = app;
  const all = () => state.get(HELD) ?? {};
  const keyOf = (kelvin) =>
    Object.keys(all()).find((key) => Math.abs((units.parse(key, "temperature") ?? -1) - kelvin) < 0.5);
  const set = (factors) => {
    // with undo, any of those before may come back
    const before = Object.entries(state.view("held", {})).slice(1 - MOST_KNOWN);
    state.setView("held", { ...Object.fromEntries(before), [JSON.stringify(factors)]: state.get(REFERENCE) });
    state.set(HELD, Object.keys(factors).length ? factors : undefined);
  };
  const releaseAll = () => state.set(HELD, undefined);
  watch(
    () => state.get(REFERENCE),
    () => {
      const about = state.view("held", {})[JSON.stringify(all())];
      if (!state.get(HELD) || about === undefined || about === state.get(REFERENCE)) return;
      releaseAll();
      app.announce("The fixed isotherms were released: their factors referred to another reference temperature.");
    },
  );
  return {
    hold(kelvin, log10) {
      set({ ...all(), [keyOf(kelvin) ?? worded(kelvin)]: Number(log10.toFixed(4)) });
      app.announce(`${named(kelvin, app)}: log10 α fixed at ${log10.toFixed(2)}.`);
    },
    release(kelvin) {
      const left = { ...all() };
      delete left[keyOf(kelvin)];
      set(left);
    },
    releaseAll,
  };
}
