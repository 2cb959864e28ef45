// Where measured friction comes from: files, what was recognised in them, and how they are separated.

import { columnsForm } from "../columns_form.js";
import { shows } from "../jobs.js";
import { effect, signal } from "../reactive.js";
import { state } from "../state.js";
import { checkList, definitions, folded, measured, progressOf, shownMeasured } from "./measurement_parts.js";

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

/** The card of the measurement's files. */
export function source(app) {
  const { fields } = app;
  const { h, button, note } = fields;
  let dropped = null; // names of the files that were brought last
  const unread = signal(null); // why files could not be brought
  const facts = definitions(app);
  const checks = checkList(app);
  const refusal = note([], "error");
  const problem = note([], "error");
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
    ...progressOf(app, measured, "Reading and separating"),
    ...[problem, columns, refusal, badge, facts, checks, doubts, stepsOfTest, more],
  );

  /** Read files that were just brought. */
  async function take(bring) {
    unread.value = null;
    try {
      dropped = await bring();
      await measured.run({ study: state.study, options: { files: dropped } });
    } catch (error) {
      unread.value = error.message;
    }
  }

  measured.done = (result) => {
    dropped = null;
    const origin = result.synthetic ? { data_origin: "synthetic" } : {};
    state.change({ measurement: result.table, ...origin });
    const said = result.curves && `${result.points} points of friction at ${result.curves.length} temperatures.`;
    app.announce(said ?? `The friction cannot be separated: ${result.refusal}`);
    if (result.refusal) more.open = true;
  };
  measured.start();
  effect(() => columns.offer(measured.error?.values));
  effect(() => {
    const result = shownMeasured();
    const table = state.get("measurement");
    problem.set(unread.value ? [unread.value] : []);
    remove.hidden = !table;
    more.hidden = result ? !result.runs : !table?.mtm;
    for (const one of [facts, checks, refusal, notes, steps]) shows(one, result);
    facts.set(result ? [...result.recognised, ...(result.lines ?? [])] : []);
    checks.set(result?.checks ?? []);
    refusal.set(result?.refusal ? [`The friction cannot be separated: ${result.refusal}`] : []);
    notes.set(result?.notes ?? []);
    doubts.hidden = !result?.notes.length;
    doubts.firstChild.textContent = `Notes on the data (${result?.notes.length})`;
    steps.replaceChildren(...(result?.steps ?? []).map((step) => h("li", {}, step.text)));
    stepsOfTest.hidden = !result?.steps.length;
    badge.hidden = !result?.synthetic;
    csv.hidden = !result?.download;
    if (result?.download) csv.href = app.api.downloadUrl(result.download);
  });

  return card;
}
