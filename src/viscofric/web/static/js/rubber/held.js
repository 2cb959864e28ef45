// Shift factors that are fixed manually, in the run file's words: { "60 degC" = -2.1 }.
//
// heldFactors(app) -> {hold(kelvin, log10), release(kelvin), releaseAll()}.  Factors are about a reference, and would mean
// something else about another one: they are let go when it changes.

import { named, worded } from "./made.js";

const PATH = "material.fixed_shift_factors";
const MOST_KNOWN = 50;
const REFERENCE = "material.reference_temperature";

export function heldFactors(app) {
  const { state, units } = app;
  const all = () => state.get(PATH) ?? {};
  const keyOf = (kelvin) =>
    Object.keys(all()).find((key) => Math.abs((units.parse(key, "temperature") ?? -1) - kelvin) < 0.5);
  const set = (factors) => {
    // with undo, any of those before may come back
    const before = Object.entries(state.view("held", {})).slice(1 - MOST_KNOWN);
    state.setView("held", { ...Object.fromEntries(before), [JSON.stringify(factors)]: state.get(REFERENCE) });
    state.set(PATH, Object.keys(factors).length ? factors : undefined);
  };
  const releaseAll = () => state.set(PATH, undefined);
  state.subscribe(REFERENCE, () => {
    const about = state.view("held", {})[JSON.stringify(all())];
    if (!state.get(PATH) || about === undefined || about === state.get(REFERENCE)) return;
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
