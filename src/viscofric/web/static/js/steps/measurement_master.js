// Friction of all temperatures on one curve, by the rubber's shift factors and by those found from friction itself.

import { shows } from "../inputs.js";
import { factorsFigure, masterFigure } from "./measurement_inverse.js";
import { definitions, optionChoice, repeated } from "./measurement_parts.js";

const LAWS = [
  ["best", "the best law"],
  ["wlf", "WLF"],
  ["arrhenius", "Arrhenius"],
  ["vft", "VFT"],
  ["wlf+arrhenius", "WLF and Arrhenius"],
  ["polynomial", "polynomial"],
  ["none", "none"],
];

/**
 * The card of the friction master curve.
 *
 * @param {object} app
 * @param {{data: () => boolean, synthetic: () => boolean}} step
 * @param {{changed: () => void}} after another choice of what friction is laid beside
 */
export function masterCurve(app, step, { changed }) {
  const { state, fields, figures } = app;
  const { h, note } = fields;
  const beside = optionChoice(app, {
    key: "friction.beside",
    label: "Compare with",
    options: [
      ["rubber", "the page's material"],
      ["nothing", "nothing (friction alone)"],
    ],
    onChange: changed,
  });
  const shiftedBy = optionChoice(app, {
    key: "friction.shifted",
    label: "Shifted by",
    options: [
      ["rubber", "the material's shift factors"],
      ["found", "shift factors from friction"],
    ],
    onChange: () => draw(),
  });
  const law = optionChoice(app, {
    key: "friction.law",
    label: "Law fitted to the shift factors from friction",
    options: LAWS,
    onChange: () => run(),
  });
  const job = repeated(app, "master", { label: "Shifting", done: show, failed: () => show(null) });
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
  const card = fields.card("Friction master curve", options, job.bar, job.errors, pair, notes, words, row);
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

  function show(result) {
    state.setResult("friction_master", result);
    const refused = result?.refusal ? [`Shift factors cannot be determined from friction alone: ${result.refusal}`] : [];
    notes.set([...refused, ...(result?.notes ?? [])]);
    shiftedBy.hidden = !(result?.found && result.by_rubber);
    for (const one of [law, file]) one.hidden = !result?.found;
    if (result?.found) file.href = app.api.downloadUrl(result.found.download);
    draw();
  }

  function draw() {
    const result = state.result("friction_master");
    const chosen = shiftedBy.value() === "found" ? result?.found : result?.by_rubber;
    const shown = chosen ?? result?.by_rubber ?? result?.found;
    // The prediction is made with the rubber's shift factors.
    const along = shown && shown === result.by_rubber ? state.result("agreement")?.along : null;
    const synthetic = alone() ? step.data() : step.synthetic();
    curve.update({ of: result, ...masterFigure(shown, along, synthetic) });
    factors.update({ of: result, ...factorsFigure(result, synthetic) });
    for (const one of [notes, words]) shows(one, result);
    words.set(result?.found?.words ?? result?.by_rubber?.words ?? []);
  }

  const alone = () => beside.value() === "nothing";

  /** Shift again; resolves with what came out. */
  async function run() {
    await job.run(state.study, { beside: !alone(), law: law.value() });
    return state.result("friction_master");
  }

  function clear() {
    job.stop();
    show(null);
  }

  return { card, alone, draw, run, clear };
}
