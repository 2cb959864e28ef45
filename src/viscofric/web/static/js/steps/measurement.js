// Step 5: measured friction beside the prediction, its master curve, and the rubber behind it.

import { identification } from "./measurement_identify.js";
import { checkFigure, coulombFigure, factorsFigure, frictionFigure, masterFigure, zeroFigure } from "./measurement_figures.js";
import { checkList, definitions, folded, optionChoice, repeated } from "./measurement_parts.js";

const SPEED = { label: "speed", kind: "speed", log: true };
/** What the prediction and the master curve rest on, besides the measurement. */
const RESTS_ON = ["material", "indenter", "layer", "surface", "solver", "uncertainty", "conditions.thickness"];
const WAIT = 400; // ms after the last change

/** Whole numbers that people typed, parted by commas. */
const numbers = (text) => {
  const found = text.split(/[\s,;]+/).filter(Boolean);
  return found.every((one) => /^\d+$/.test(one)) ? found.map(Number) : text.trim();
};
/** A difference of temperatures: a bare number counts as kelvins. */
const gap = (text) => (/^\s*[\d.]+\s*(K|°C)?\s*$/.test(text) ? `${parseFloat(text)} delta_degC` : text.trim());

function separationFields({ quantityField, textField, numberField, choiceField, h }) {
  const at = (key) => `measurement.${key}`;
  const list = (value) => [value ?? []].flat().join(", ");
  return h("div", { class: "form" },
    quantityField({ path: at("zero"), label: "Zero of the force cell", kind: "load", placeholder: "found, or as recorded", help: "Its reading without traction, where it is known." }),
    quantityField({ path: at("zero_error"), label: "Standard error of the zero", kind: "load" }),
    quantityField({ path: at("coulomb"), label: "Assumed Coulomb friction", placeholder: "0.05, or constant", help: "Where slip has one direction only: its coefficient, or “constant” over the speed." }),
    numberField({ path: at("coulomb_error"), label: "Standard error of it", min: 0 }),
    textField({ path: at("except_steps"), label: "Steps to leave out", placeholder: "1, 3", read: numbers, write: list, help: "Such as those that were not steady." }),
    choiceField({ path: at("outliers"), label: "Readings far from the others", otherwise: "keep", options: [["keep", "keep"], ["leave out", "leave out"]] }),
    numberField({ path: at("speed_tolerance"), label: "Gap between speeds", placeholder: "0.05", min: 0, max: 1, help: "Relative; a smaller one is scatter about the same nominal speed." }),
    textField({ path: at("temperature_tolerance"), label: "Gap between temperatures", placeholder: "1 K", read: gap, write: (value) => String(value ?? "").replace("delta_degC", "K") }),
  );
}

function mount(section, app) {
  const { state, fields, figures } = app;
  const { h, button, note } = fields;
  const rubberIsSynthetic = () => Boolean(app.start?.catalogue?.find((one) => one.name === state.get("material.catalogue"))?.synthetic);
  const synthetic = () => Boolean(state.result("measured")?.synthetic) || rubberIsSynthetic();
  let current = null; // the table that the shown measurement is of
  let stale = false;
  let timer = null;

  // What was measured
  const facts = definitions(app);
  const badge = h("span", { class: "badge", hidden: true }, "synthetic data");
  const refusal = note([], "error");
  const checks = checkList(app);
  const notes = note([]);
  const steps = h("ul", { class: "help steps-of-test" });
  const stepsOfTest = folded(app, "Steps of the test", steps);
  const doubts = folded(app, "What was noted about the data", notes);
  const more = folded(app, "More: zero, Coulomb friction, steps, outliers", separationFields(fields));
  const remove = button({ label: "Remove the measurement", kind: "quiet small", symbol: "close", onClick: () => state.set("measurement", undefined) });
  const csv = h("a", { class: "button small", hidden: true, download: "friction_curves.csv" }, "Friction curves (CSV)");
  const measuring = repeated(app, "measured", { label: "Reading and separating", done: show, failed: () => clear(false) });
  const drop = fields.fileDrop({
    label: "Drop the files of a traction test", accept: ".txt,.csv,.tsv,.dat",
    help: "Text exports of an MTM or ETM, tables of readings, or a table of friction curves. Files that are dropped together make one test.",
    onFiles: async (files) => {
      try {
        await take(await app.api.uploadFiles(files));
      } catch (error) {
        measuring.errors.set([error.message]);
      }
    },
  });
  const example = button({
    label: "Use the synthetic example", kind: "small",
    onClick: async () => {
      await app.api.useExample();
      await take(["mtm.csv"]);
    },
  });
  const source = fields.card("Measured friction", drop, h("div", { class: "row" }, example, remove, csv), measuring.bar, measuring.errors, refusal, badge, facts, checks, doubts, stepsOfTest, more);

  // Beside the prediction
  const predicting = repeated(app, "agreement", { label: "Predicting", done: showAgreement, failed: () => showAgreement(null) });
  const key = fields.keyNumbers();
  const verdict = note([]);
  const warnings = note([], "warning");
  const byTemperature = h("div", {});
  const assumed = checkList(app);
  const checked = folded(app, "By temperature, and what was checked", byTemperature, assumed);
  const comparison = fields.card("Measured against predicted", predicting.bar, predicting.errors);
  const figure = figures.figure(comparison, { id: "measured-friction", title: "Viscoelastic friction", x: SPEED, y: { label: "viscoelastic friction coefficient" }, empty: "Drop the files of a traction test, or use the synthetic example." });
  comparison.append(key, verdict, warnings, checked);

  // The rest of the test
  const rest = h("div", { class: "grid thirds" });
  const small = (spec) => {
    const card = h("section", { class: "card" });
    rest.append(card);
    return Object.assign(figures.figure(card, { x: SPEED, height: 300, ...spec }), { card });
  };
  const coulomb = small({ id: "coulomb-friction", title: "Coulomb friction", caption: "Measured, with the standard deviation of the repetitions.", y: { label: "Coulomb friction coefficient" } });
  const fourRuns = small({ id: "four-runs", title: "Check of the four configurations", caption: "(F_I − F_II + F_III − F_IV)/4 over the load, with twice its standard error: zero in a sound test.", y: { label: "left over, share of the load" } });
  const zero = small({ id: "force-cell-zero", title: "Zero of the force cell", caption: "As found at each condition; a zero that drifts is told among the notes.", y: { label: "zero", kind: "load" } });

  // The master curve
  const mastering = repeated(app, "master", { label: "Shifting", done: showMaster, failed: () => showMaster(null) });
  const law = optionChoice(app, {
    key: "friction.law", label: "Law fitted to friction's shift factors", onChange: () => refresh(),
    options: [["best", "the best one"], ["wlf", "WLF"], ["arrhenius", "Arrhenius"], ["vft", "VFT"], ["wlf+arrhenius", "WLF and Arrhenius"], ["polynomial", "polynomial"], ["none", "none"]],
  });
  const shiftedBy = optionChoice(app, { key: "friction.shifted", label: "Shifted by", options: [["rubber", "the rubber's shift factors"], ["found", "those that friction tells"]], onChange: () => drawMaster() });
  const beside = optionChoice(app, { key: "friction.beside", label: "Laid beside", options: [["rubber", "the page's rubber"], ["nothing", "nothing: friction alone"]], onChange: () => refresh() });
  const masterWords = definitions(app);
  const masterNotes = note([]);
  const factorsFile = h("a", { class: "button small", hidden: true, download: "shift_factors_from_friction.csv" }, "Shift factors (CSV)");
  const masterCard = fields.card("Friction master curve", h("div", { class: "form" }, beside, shiftedBy, law), mastering.bar, mastering.errors);
  const pair = h("div", { class: "grid" });
  const masterFigures = ["friction-master-curve", "friction-shift-factors"].map((id, at) =>
    figures.figure(pair, { id, title: ["Friction at one temperature", "Shift factors"][at], x: at ? { label: "temperature", kind: "temperature" } : { label: "reduced speed", kind: "speed", log: true }, y: { label: at ? "log₁₀ α" : "viscoelastic friction coefficient" }, height: 340 }));
  masterCard.append(pair, masterNotes, masterWords, h("div", { class: "row" }, factorsFile));

  const identify = identification(app, { synthetic, alone: () => beside.value() === "nothing" });
  const after = [comparison, rest, masterCard, identify.card];
  section.append(
    h("p", {}, "What a traction test says: how much of its friction is viscoelastic, how well the page's rubber predicts it, onto which curve all temperatures fall, and which rubber would have such friction."),
    h("div", { class: "columns" }, h("div", {}, source), h("div", {}, comparison)), rest, masterCard, identify.card,
  );

  async function take(names) {
    await measuring.run(state.study, { files: names });
  }

  /** Show what was separated; what rests on it follows. */
  function show(result) {
    current = JSON.stringify(result.table);
    state.setResult("measured", result);
    const changes = { measurement: result.table };
    if (result.synthetic && state.get("data_origin") !== "synthetic") changes.data_origin = "synthetic";
    state.change(changes);
    facts.set([...result.recognised, ...(result.lines ?? [])]);
    badge.hidden = !result.synthetic;
    refusal.set(result.refusal ? [`The friction cannot be separated: ${result.refusal}`] : []);
    if (result.refusal) more.open = true;
    checks.set(result.checks ?? []);
    notes.set(result.notes);
    doubts.hidden = result.notes.length === 0;
    doubts.firstChild.textContent = `What was noted about the data (${result.notes.length})`;
    steps.replaceChildren(...result.steps.map((step) => h("li", {}, step.text)));
    stepsOfTest.hidden = result.steps.length === 0;
    more.hidden = !result.runs;
    remove.hidden = false;
    csv.hidden = !result.download;
    if (result.download) csv.href = app.api.downloadUrl(result.download);
    showAgreement(null);
    showMaster(null);
    identify.clear();
    for (const [handle, spec] of [[coulomb, coulombFigure], [fourRuns, checkFigure], [zero, zeroFigure]]) {
      const changes = spec(result, result.synthetic);
      handle.card.hidden = changes.traces.length === 0;
      handle.update(changes);
    }
    for (const one of after) one.hidden = !result.curves;
    comparison.hidden = false;
    app.announce(result.refusal ?? `${result.points} points of friction at ${result.curves.length} temperatures.`);
    if (result.curves) refresh();
  }

  function clear(forgets = true) {
    current = null;
    state.setResult("measured", null);
    for (const one of [predicting, mastering]) one.stop();
    facts.set([]);
    checks.set([]);
    refusal.set([]);
    notes.set([]);
    for (const one of [badge, doubts, stepsOfTest, remove, csv, rest, masterCard, identify.card]) one.hidden = true;
    if (forgets) more.hidden = true;
    showAgreement(null);
    showMaster(null);
    identify.clear();
  }

  function showAgreement(result) {
    state.setResult("agreement", result);
    figure.update(frictionFigure(state.result("measured"), result, synthetic()));
    key.set((result?.key ?? []).map(({ name, value, remark }) => ({ label: name, value, remark })));
    key.hidden = !result?.key?.length;
    verdict.set(result ? [...result.sentences.slice(0, 1), ...result.notes] : []);
    warnings.set(result ? [...result.failures, ...result.warnings] : []);
    assumed.set(result?.checks ?? []);
    byTemperature.replaceChildren(...(result?.table ? [fields.table(result.table.headings, result.table.rows, result.table.caption), h("p", { class: "help" }, result.table.note)] : []));
    checked.hidden = !result;
    if (result) drawMaster();
    if (result?.sentences.length) app.announce(result.sentences[0]);
  }

  function showMaster(result) {
    state.setResult("friction_master", result);
    masterNotes.set(result ? [...(result.refusal ? [`Friction alone tells no shift factors: ${result.refusal}`] : []), ...result.notes] : []);
    identify.suggest(result);
    shiftedBy.hidden = !(result?.found && result?.by_rubber);
    law.hidden = !result?.found;
    factorsFile.hidden = !result?.found;
    if (result?.found) factorsFile.href = app.api.downloadUrl(result.found.download);
    drawMaster();
  }

  function drawMaster() {
    const result = state.result("friction_master");
    const master = result && (result[shiftedBy.value() === "found" ? "found" : "by_rubber"] ?? result.found ?? result.by_rubber);
    const made = synthetic();
    const along = master && master === result.by_rubber ? state.result("agreement")?.along : null;
    masterFigures[0].update(masterFigure(master, along, made));
    masterFigures[1].update(factorsFigure(result, made));
    masterWords.set(result?.found?.words ?? master?.words ?? []);
  }

  /** Predict and shift again; later, if nobody looks at the step. */
  function refresh() {
    if (!state.result("measured")?.curves) return;
    if (section.parentElement.hidden) {
      stale = true;
      return;
    }
    stale = false;
    const alone = beside.value() === "nothing";
    if (alone) {
      predicting.stop();
      showAgreement(null);
    } else predicting.run(state.study);
    mastering.run(state.study, { beside: !alone, law: law.value() });
  }

  function changed() {
    const table = state.get("measurement");
    if (!table) {
      measuring.stop();
      clear();
    } else if (JSON.stringify(table) !== current) measuring.run(state.study);
  }

  const later = (work) => {
    clearTimeout(timer);
    timer = setTimeout(work, WAIT);
  };
  state.subscribe("measurement", () => later(changed));
  state.subscribe(RESTS_ON, () => later(refresh));
  new MutationObserver(() => stale && refresh()).observe(section.parentElement, { attributeFilter: ["hidden"] });
  clear();
  changed();
}

export default {
  id: "measurement",
  title: "Measurement",
  summary(state) {
    const result = state.result("measured");
    if (!result?.curves) return result?.refusal ? "not separated" : "";
    const rms = state.result("agreement")?.key?.[0]?.value;
    return `${result.points} points${rms ? `, predicted to ${rms}` : ""}`;
  },
  mount,
};
