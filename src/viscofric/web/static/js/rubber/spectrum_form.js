// What the user says of the spectrum.

import { effect } from "../reactive.js";
import { sourceOf } from "./made.js";

const KINDS = [
  ["non-negative", "non-negative: smallest misfit"],
  ["regularised", "regularised: smooth"],
  ["sparse", "sparse: few modes"],
];

export function settings(app) {
  const { state, fields } = app;
  const { h, card } = fields;
  const few = fields.numberField({
    path: "material.modes",
    label: "Largest number of modes",
    min: 1,
    max: 200,
    step: 1,
    placeholder: "automatic",
  });
  const ratio = fields.numberField({
    path: "material.tau_ratio",
    label: "Ratio of neighbouring times",
    min: 1.1,
    max: 100,
    placeholder: "e = 2.718",
  });
  const kind = fields.choiceField({
    path: "material.spectrum",
    label: "Fit method",
    options: KINDS,
    otherwise: "non-negative",
    onChange: (value) =>
      state.change({
        "material.spectrum": value === "non-negative" ? undefined : value,
        ...(value === "sparse" ? { "material.tau_ratio": undefined } : { "material.modes": undefined }),
      }),
    help: "Non-negative modes have the smallest misfit; regularised ones make a smooth spectrum; sparse ones are few, for finite elements.",
  });
  const draws = fields.numberField({
    path: "uncertainty.draws",
    label: "Bootstrap samples for the 95 % band",
    min: 0,
    max: 10000,
    step: 1,
    placeholder: "200",
    help: "Refits to resampled data; 0 for no band.",
  });
  const fitted = h("div", { class: "panel" }, kind, few, ratio, draws);
  const ready = h("p", { class: "help" }, "A predefined material has its own spectrum.");
  const refresh = () => {
    const source = sourceOf(state.get("material"));
    fitted.hidden = source === "catalogue" || source === "file" || source === null;
    ready.hidden = !fitted.hidden;
    few.hidden = state.get("material.spectrum") !== "sparse";
    ratio.hidden = !few.hidden;
  };
  effect(refresh);
  return card("Spectrum", fitted, ready);
}
