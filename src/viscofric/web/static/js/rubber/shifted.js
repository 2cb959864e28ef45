// The isotherms on one another, and one of them corrected by hand: dragged, or moved by a slider or a number.

import { draggable, moveTrace } from "./drag.js";
import { byTemperature, decades, fewEnough, named, pick, synthetic, worded } from "./made.js";

const QUANTITIES = [
  ["storage_modulus", "E′"],
  ["loss_modulus", "E″"],
  ["loss_tangent", "tan δ"],
];
const REACH = 3; // decades
const STEP = 0.02;
const SETTLE = 400; // ms after the last key

/** The isotherms moved onto each other, and what is needed to move one by hand. */
export function shiftedCard(app) {
  const { state, fields, figures, api } = app;
  const { h, card, button } = fields;
  let quantity = "storage_modulus";
  let result = null;
  let chosen = null; // K
  let table = null; // misfit over decades moved, of the chosen isotherm
  let timer = null;
  const element = card("Shifted isotherms");
  const choice = pick(
    { label: "Quantity", options: QUANTITIES, value: quantity, onChange: (value) => ((quantity = value), draw()) },
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
  const free = button({ label: "Undo this correction", kind: "small", onClick: () => release(chosen) });
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

  const isotherm = () => result?.shift?.isotherms.find((one) => one.temperature === chosen);
  const misfitAt = (by) => {
    if (!table) return null;
    const at = Math.round((by - table.moved[0]) / STEP);
    return table.misfit[at] ?? null;
  };
  const describe = (by) => {
    const one = isotherm();
    if (!one) return;
    const misfit = misfitAt(by);
    const now = misfitAt(0);
    const words = [by ? `Shifted by ${decades(by)}` : one.held ? "Fixed manually" : "Fitted"];
    if (misfit !== null)
      words.push(
        `distance from its neighbours ${decades(misfit, 3)} (rms)${by && now !== null ? `, before ${now.toFixed(3)}` : ""}`,
      );
    else if (table) words.push("no overlap with its neighbours");
    live.textContent = `${words.join("; ")}.`;
  };
  const choose = async (kelvin) => {
    const other = kelvin !== chosen;
    chosen = kelvin;
    const one = isotherm();
    if (!one) return;
    select.value = String(kelvin);
    slider.value = 0;
    exact.value = one.log10_shift.toFixed(3);
    for (const control of [slider, exact]) control.disabled = one.is_reference;
    free.disabled = !one.held;
    if (other) draw();
    table = null;
    live.textContent = one.is_reference
      ? "This is the reference isotherm (α = 1): choose another reference temperature to shift it."
      : "";
    if (one.is_reference) return;
    try {
      const material = state.get("material");
      const found = await api.runJob("isotherm_misfit", {
        study: { material },
        options: { temperature: worded(kelvin), reach: REACH, step: STEP },
      });
      if (chosen === kelvin && result?.made_of === material) {
        table = found;
        describe(Number(slider.value));
      }
    } catch (error) {
      live.textContent = error.message;
    }
  };
  const traceOf = (kelvin) => result.shift.isotherms.findIndex((one) => one.temperature === kelvin);

  select.addEventListener("change", () => choose(Number(select.value)));
  slider.addEventListener("input", () => {
    const one = isotherm();
    if (!one) return;
    moveTrace(
      handle,
      traceOf(chosen),
      app.units.number(one.angular_frequency, "angular_frequency"),
      Number(slider.value),
    );
    exact.value = (one.log10_shift + Number(slider.value)).toFixed(3);
    describe(Number(slider.value));
  });
  slider.addEventListener("change", () => {
    clearTimeout(timer);
    timer = setTimeout(
      () => Number(slider.value) !== 0 && isotherm() && hold(chosen, isotherm().log10_shift + Number(slider.value)),
      SETTLE,
    );
  });
  exact.addEventListener(
    "change",
    () => exact.value !== "" && Number.isFinite(Number(exact.value)) && hold(chosen, Number(exact.value)),
  );

  const canMove = (index) => {
    const one = result?.shift?.isotherms[index];
    return Boolean(one) && !one.is_reference && !parts.hidden;
  };
  draggable(handle, {
    can: canMove,
    onStart: (index) =>
      result.shift.isotherms[index].temperature !== chosen && choose(result.shift.isotherms[index].temperature),
    onMove: (index, by) => {
      slider.value = by;
      exact.value = (result.shift.isotherms[index].log10_shift + by).toFixed(3);
      describe(Math.round(by / STEP) * STEP);
    },
    onEnd: (index, by) =>
      by && hold(result.shift.isotherms[index].temperature, result.shift.isotherms[index].log10_shift + by),
  });

  const draw = () => {
    const isotherms = result?.shift?.isotherms ?? [];
    const temperatures = isotherms.map((one) => one.temperature);
    const [, label] = QUANTITIES.find(([key]) => key === quantity);
    handle.update({
      of: result,
      caption: [byTemperature(temperatures, app), isotherms.some((one) => one.held) ? "Squares are fixed manually." : ""]
        .filter(Boolean)
        .join(" "),
      y: {
        label: result?.shift?.vertical && quantity !== "loss_tangent" ? `${label}/b` : label,
        kind: quantity === "loss_tangent" ? undefined : "modulus",
        log: true,
      },
      synthetic: result && synthetic(result, app),
      temperatures,
      traces: isotherms.map((one) => ({
        name: named(one.temperature, app),
        legend: fewEnough(temperatures),
        temperature: one.temperature,
        x: one.angular_frequency,
        y: one[quantity],
        mode: "lines+markers",
        dash: "solid",
        symbol: one.held ? "square" : "circle",
        size: one.temperature === chosen ? 9 : 5,
        width: one.temperature === chosen ? 3 : 1.2,
      })),
    });
  };

  element.controls = controls;
  element.show = (next, { running }) => {
    const same = next && next.made_of === result?.made_of;
    result = next;
    const isotherms = result?.shift?.isotherms ?? [];
    element.hidden = controls.hidden = isotherms.length === 0;
    element.toggleAttribute("aria-busy", Boolean(running));
    if (isotherms.length === 0) return;
    const given = result.shift.origin === "given";
    const { joint } = result.shift;
    why.textContent = given
      ? "The shift factors are from a file; fit them to the sweeps to correct one."
      : joint
        ? "The shift factors are those of sweeps and step tests together; correct one with the sweeps alone."
        : "";
    parts.hidden = given || joint;
    freeAll.disabled = !isotherms.some((one) => one.held);
    if (!same) {
      select.replaceChildren(
        ...isotherms.map((one) =>
          h(
            "option",
            { value: String(one.temperature) },
            `${named(one.temperature, app)}${one.is_reference ? " (reference)" : one.held ? " (fixed)" : ""}`,
          ),
        ),
      );
      const near = isotherms.reduce(
        (best, one) =>
          chosen !== null && Math.abs(one.temperature - chosen) < Math.abs(best.temperature - chosen) ? one : best,
        isotherms.find((one) => !one.is_reference) ?? isotherms[0],
      );
      chosen = null;
      if (!given && !joint) choose(near.temperature);
    }
    draw();
  };
  return element;
}

// Shift factors fixed manually, in the run file's words: { "60 degC" = -2.1 }.  Factors are about a reference, and would
// mean something else about another one: they are released when it changes.

const HELD = "material.fixed_shift_factors";
const MOST_KNOWN = 50;
const REFERENCE = "material.reference_temperature";

function heldFactors(app) {
  const { state, units } = app;
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
  state.subscribe(REFERENCE, () => {
    const about = state.view("held", {})[JSON.stringify(all())];
    if (!state.get(HELD) || about === undefined || about === state.get(REFERENCE)) return;
    releaseAll();
    app.announce("The fixed isotherms were released: their factors referred to another reference temperature.");
  });
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
