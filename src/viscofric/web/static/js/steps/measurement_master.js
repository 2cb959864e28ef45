// Friction of all temperatures on one curve, by the rubber's shift factors and by those found from friction itself.

import { shows } from "../jobs.js";
import { effect } from "../reactive.js";
import { state } from "../state.js";
import { agreement } from "./measurement_comparison.js";
import { factorsFigure, masterFigure } from "./measurement_inverse.js";
import { alone, definitions, ofMeasured, optionChoice, progressOf } from "./measurement_parts.js";

const LAWS = [
  ["best", "the best law"],
  ["wlf", "WLF"],
  ["arrhenius", "Arrhenius"],
  ["vft", "VFT"],
  ["wlf+arrhenius", "WLF and Arrhenius"],
  ["polynomial", "polynomial"],
  ["none", "none"],
];

const LAW = "friction.law";
export const master = ofMeasured("master", () => ({ beside: !alone(), law: state.view(LAW, LAWS[0][0]) }));

/**
 * The card of the friction master curve.
 *
 * @param {object} app
 * @param {{data: () => boolean, synthetic: () => boolean}} step
 */
export function masterCurve(app, step) {
  const { fields, figures } = app;
  const { h, note } = fields;
  const beside = optionChoice(app, {
    key: "friction.beside",
    label: "Compare with",
    options: [
      ["rubber", "the page's material"],
      ["nothing", "nothing (friction alone)"],
    ],
  });
  const shiftedBy = optionChoice(app, {
    key: "friction.shifted",
    label: "Shifted by",
    options: [
      ["rubber", "the material's shift factors"],
      ["found", "shift factors from friction"],
    ],
  });
  const law = optionChoice(app, { key: LAW, label: "Law fitted to the shift factors from friction", options: LAWS });
  const words = definitions(app);
  const notes = note([]);
  const file = h(
    "a",
    { class: "button small", hidden: true, download: "shift_factors_from_friction.csv" },
    "Shift factors (CSV)",
  );
  const pair = h("div", { class: "grid" });
  const options = h("div", { class: "form" }, beside, shiftedBy, law);
  const row = h("div", { class: "row" }, file);
  const card = fields.card("Friction master curve", options, ...progressOf(app, master, "Shifting"), pair, notes, words, row);
  const curve = figures.figure(pair, {
    id: "friction-master-curve",
    title: "Friction at one temperature",
    x: { label: "reduced speed", kind: "speed", log: true },
    y: { label: "viscoelastic friction coefficient" },
    height: 340,
  });
  const factors = figures.figure(pair, {
    id: "friction-shift-factors",
    title: "Shift factors",
    x: { label: "temperature", kind: "temperature" },
    y: { label: "log₁₀ α" },
    height: 340,
    empty: "Friction at one temperature determines no shift factor.",
  });

  master.start();
  effect(() => {
    const result = master.error ? null : master.result;
    const refused = result?.refusal ? [`Shift factors cannot be determined from friction alone: ${result.refusal}`] : [];
    notes.set([...refused, ...(result?.notes ?? [])]);
    shiftedBy.hidden = !(result?.found && result.by_rubber);
    for (const one of [law, file]) one.hidden = !result?.found;
    if (result?.found) file.href = app.api.downloadUrl(result.found.download);
    const chosen = shiftedBy.value() === "found" ? result?.found : result?.by_rubber;
    const shown = chosen ?? result?.by_rubber ?? result?.found;
    // The prediction is made with the rubber's shift factors.
    const along = shown && shown === result.by_rubber ? agreement.current?.along : null;
    const synthetic = alone() ? step.data() : step.synthetic();
    curve.update({ of: result, ...masterFigure(shown, along, synthetic) });
    factors.update({ of: result, ...factorsFigure(result, synthetic) });
    for (const one of [notes, words]) shows(one, result);
    words.set(result?.found?.words ?? result?.by_rubber?.words ?? []);
  });

  return card;
}
