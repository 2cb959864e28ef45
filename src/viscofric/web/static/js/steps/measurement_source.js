// Where measured friction comes from: files, what was recognised in them, and how they are separated.

import { columnsForm } from "../columns_form.js";
import { computedFrom, keyOf, shows } from "../inputs.js";
import { checkList, definitions, folded, repeated } from "./measurement_parts.js";

/** Whole numbers that people typed, parted by commas. */
function wholeNumbers(text) {
  const found = text.split(/[\s,;]+/).filter(Boolean);
  return found.every((one) => /^\d+$/.test(one)) ? found.map(Number) : text.trim();
}

/** A difference of temperatures as a run file writes it; a bare number counts as kelvins. */
const difference = (text) => (/^\s*[\d.]+\s*(K|°C)?\s*$/.test(text) ? `${parseFloat(text)} delta_degC` : text.trim());

function separationFields({ quantityField, textField, numberField, choiceField, h }) {
  const at = (key) => `measurement.${key}`;
  return h(
    "div",
    { class: "form" },
    quantityField({
      path: at("zero"),
      label: "Zero of the force cell",
      kind: "load",
      placeholder: "fitted, or as recorded",
      help: "Reading without traction, if known.",
    }),
    quantityField({ path: at("zero_error"), label: "Standard error of the zero", kind: "load" }),
    quantityField({
      path: at("coulomb"),
      label: "Assumed Coulomb friction",
      placeholder: "0.05, or constant",
      help: "If the slip has one direction only: a coefficient, or “constant” over the speed.",
    }),
    numberField({ path: at("coulomb_error"), label: "Standard error of Coulomb friction", min: 0 }),
    textField({
      path: at("except_steps"),
      label: "Steps to leave out",
      placeholder: "1, 3",
      read: wholeNumbers,
      write: (value) => [value ?? []].flat().join(", "),
      help: "For example unsteady steps.",
    }),
    textField({ path: at("sheet"), label: "Sheet", help: "Name of the sheet of a workbook to read." }),
    choiceField({
      path: at("outliers"),
      label: "Outliers",
      otherwise: "keep",
      options: ["keep", "leave out"].map((word) => [word, word]),
    }),
    numberField({
      path: at("speed_tolerance"),
      label: "Gap between speeds",
      placeholder: "0.05",
      min: 0,
      max: 1,
      help: "Relative; a smaller gap is scatter about the same nominal speed.",
    }),
    textField({
      path: at("temperature_tolerance"),
      label: "Gap between temperatures",
      placeholder: "1 K",
      read: difference,
      write: (value) => String(value ?? "").replace("delta_degC", "K"),
    }),
  );
}

/**
 * The card of the measurement's files.
 *
 * @param {object} app
 * @param {{done: (result: object) => void, gone: () => void}} after the files were read, or there are none any more
 */
export function source(app, { done, gone }) {
  const { state, fields } = app;
  const { h, button, note } = fields;
  let current = null; // the table that the shown measurement is of
  let dropped = null; // names of the files that were brought last
  const facts = definitions(app);
  const checks = checkList(app);
  const refusal = note([], "error");
  const notes = note([]);
  const steps = h("ul", { class: "help steps-of-test" });
  const badge = h("span", { class: "badge", hidden: true }, "synthetic data");
  const stepsOfTest = folded(app, "Steps of the test", steps);
  const doubts = folded(app, "Notes on the data", notes);
  const more = folded(app, "More: zero, Coulomb friction, steps, outliers", separationFields(fields));
  const csv = h("a", { class: "button small", hidden: true, download: "friction_curves.csv" }, "Friction curves (CSV)");
  const remove = button({
    label: "Remove the measurement",
    kind: "quiet small",
    symbol: "close",
    onClick: () => state.set("measurement", undefined),
  });
  const job = repeated(app, "measured", { label: "Reading and separating", done: show, failed: forget });
  const columns = columnsForm(app, {
    choose: (named) => {
      const { curves, ...before } = state.get("measurement") ?? {};
      const files = dropped?.length === 1 ? dropped[0] : dropped;
      state.set("measurement", { ...before, mtm: files ?? before.mtm, columns: named });
    },
    chosen: () => state.get("measurement.columns"),
  });
  const drop = fields.fileDrop({
    label: "Drop the files of a traction test",
    accept: ".txt,.csv,.tsv,.dat,.xlsx,.xls,.mtmd,.etmd",
    help: "Exports of an MTM or ETM, tables of readings, or a table of friction curves; together they make one test.",
    onFiles: (files) => take(() => app.api.uploadFiles(files)),
  });
  const example = button({
    label: "Use the synthetic example",
    kind: "small",
    onClick: () => take(() => app.api.useExample().then(() => ["mtm.csv"])),
  });
  const card = fields.card(
    "Measured friction",
    drop,
    h("div", { class: "row" }, example, csv, remove),
    ...[job.bar, job.errors, columns, refusal, badge, facts, checks, doubts, stepsOfTest, more],
  );

  /** Read files that were just brought. */
  async function take(bring) {
    try {
      const files = await bring();
      dropped = files;
      await job.run(state.study, { files });
    } catch (error) {
      job.errors.set([error.message]);
    }
  }

  function show(result) {
    const study = { ...state.study, measurement: result.table };
    current = keyOf("measured", study);
    dropped = null;
    computedFrom(result, "measured", study);
    state.setResult("measured", result);
    const origin = result.synthetic ? { data_origin: "synthetic" } : {};
    state.change({ measurement: result.table, ...origin });
    columns.offer(null);
    badge.hidden = !result.synthetic;
    for (const one of [facts, checks, refusal, notes, steps]) shows(one, result);
    facts.set([...result.recognised, ...(result.lines ?? [])]);
    checks.set(result.checks ?? []);
    refusal.set(result.refusal ? [`The friction cannot be separated: ${result.refusal}`] : []);
    notes.set(result.notes);
    doubts.hidden = result.notes.length === 0;
    doubts.firstChild.textContent = `Notes on the data (${result.notes.length})`;
    steps.replaceChildren(...result.steps.map((step) => h("li", {}, step.text)));
    stepsOfTest.hidden = result.steps.length === 0;
    more.hidden = !result.runs;
    more.open ||= Boolean(result.refusal);
    remove.hidden = false;
    csv.hidden = !result.download;
    if (result.download) csv.href = app.api.downloadUrl(result.download);
    const said = result.curves && `${result.points} points of friction at ${result.curves.length} temperatures.`;
    app.announce(said ?? refusal.textContent);
    done(result);
  }

  /** Nothing is known of the measurement; its settings can still be mended. */
  function forget(error) {
    current = null;
    columns.offer(error?.values);
    state.setResult("measured", null);
    for (const one of [facts, checks, refusal, notes]) one.set([]);
    for (const one of [badge, doubts, stepsOfTest, csv]) one.hidden = true;
    gone();
  }

  /** Follow [measurement] of the study: read again where it is another, forget it where it is gone. */
  function follow() {
    const table = state.get("measurement");
    more.hidden &&= !table?.mtm;
    remove.hidden = !table;
    if (!table) {
      job.stop();
      more.hidden = true;
      forget();
    } else if (keyOf("measured", state.study) !== current) job.run(state.study);
  }

  more.hidden = true;
  return { card, follow };
}
