// Motion over time: a history edited as a table or a sketch, or an impact, and the solved contact.

import { studyHistory } from "../motion_study.js";
import { DEPENDS_ON, outdated, shows, studyOf } from "../inputs.js";
import { motionFigures, numbersOf } from "../motion_figures.js";
import {
  CONTROLS,
  PATHS,
  PRESETS,
  contactOf,
  converted,
  pointTable,
  presetRows,
  read,
  sketch,
} from "../motion_history.js";

const BEFORE = ["untouched", "at rest", "sliding"].map((one) => [one, one]);
const IMPACT = {
  mass: ["Mass (kg)", 0.033],
  speed: ["Speed (m/s)", 1],
  gravity: ["Gravity (m/s²)", 0],
  rebounds: ["Contacts to follow", 1],
};

export function mount(section, app) {
  const { state, fields, units, figures, api } = app;
  const { h, card, button } = fields;
  let [result, running] = [null, null];
  let history = state.view("motion", null);

  const failed = fields.note([], "error");
  const warnings = fields.note([], "warning");
  const notes = fields.note([]);
  const numbers = fields.keyNumbers([]);
  const pictures = motionFigures(app);
  const bar = fields.progressBar({ label: "Solving", onCancel: stop });
  const solveButton = button({ label: "Solve", kind: "main", onClick: solve });
  const save = button({
    label: "Save the history",
    kind: "small",
    symbol: "down",
    onClick: () => figures.save("history.csv", csv(), "text/csv"),
  });
  const table = pointTable({
    onChange: (rows, place) => {
      change({ rows });
      table.focus(place);
    },
    refuse: (sentence) => failed.set([sentence]),
  });
  const picture = sketch({ onChange: (rows) => change({ rows }) });

  let made = 0;
  const labelled = (label, control) => {
    control.id = `motion-${(made += 1)}`;
    return h("div", { class: "field" }, h("label", { for: control.id, class: "field-label" }, label), control);
  };
  const select = (entries, onChange) => {
    const element = h(
      "select",
      {},
      entries.map(([value, text]) => h("option", { value }, text)),
    );
    element.addEventListener("change", () => onChange(element.value));
    return element;
  };
  const preset = select(Object.entries(PRESETS), (value) => begin(value));
  const control = select([], (value) =>
    change({ control: value, path: "speed", rows: presetRows(history.preset, state.study, value) }),
  );
  const path = select(
    Object.entries(PATHS).map(([value, [text]]) => [value, text]),
    (value) => change({ path: value, rows: converted(history.rows, value) }),
  );
  const before = select(BEFORE, (value) => change({ before: value }));
  /** A text field for one number; other input gives an error message. */
  const box = (label, kind, onRead) => {
    const element = h("input", { type: "text", autocomplete: "off" });
    element.addEventListener("change", () => {
      const value = element.value.trim() ? read(element.value, kind) : null;
      if (Number.isFinite(value) || !element.value.trim()) onRead(value);
      else failed.set([`${label}: enter a number.`]);
    });
    return element;
  };
  const temperature = box("Temperature", "temperature", (kelvin) => change({ temperature: kelvin }));
  const impact = Object.entries(IMPACT).map(([name, [label]]) => [
    name,
    labelled(
      label,
      box(label, "plain", (value) => value !== null && change({ impact: { ...history.impact, [name]: value } })),
    ),
  ]);
  const forms = h(
    "div",
    { class: "stack" },
    labelled("Prescribed", control),
    labelled("Motion given as", path),
    labelled("Before the first time", before),
    h("div", { class: "scroll" }, table.element),
  );
  const hit = h("div", { class: "form" }, ...impact.map(([, field]) => field));
  const kept = h(
    "div",
    { class: "stack" },
    save,
    studyHistory(app, { rows: () => optionsOf(history), take: (found) => change(found) }),
  );
  const help = (words) => h("p", { class: "help" }, words);
  const jumps = help("Drag a point, or change its numbers in the table. Two points at the same time are a jump.");
  const drawing = card("Sketch of the history", picture.element, jumps);
  const rest = help("Material, indenter, layer and accuracy are the first values given in the study.");
  const form = card(
    "History",
    labelled("Example", preset),
    forms,
    hit,
    labelled("Temperature", temperature),
    rest,
    solveButton,
    kept,
  );
  const about = help("± is the estimated numerical error; it does not include the grid error of a rough surface.");
  about.hidden = true;
  const found = card("Contact over time", bar, failed, warnings, numbers, about, pictures.grid, notes);
  section.append(h("div", { class: "columns" }, h("div", {}, form), h("div", {}, drawing, found)));

  /** Begin with an example of the study's contact. */
  function begin(name, keep) {
    const contact = contactOf(state.study);
    const values = Object.fromEntries(Object.entries(IMPACT).map(([key, [, value]]) => [key, value]));
    const begun = {
      preset: name,
      contact,
      control: Object.keys(CONTROLS[contact])[0],
      path: "speed",
      before: "untouched",
      rows: presetRows(name, state.study),
      impact: history?.impact ?? values,
    };
    change(begun, keep);
  }

  /** Change the history, as a step of undo unless it follows from the study. */
  function change(values, keep = state.edit) {
    keep("motion", { temperature: null, ...history, ...values });
    if (keep !== state.edit) changed();
  }

  function changed() {
    history = state.view("motion");
    outdated(result);
    failed.set([]);
    show();
  }

  function show(wrong = null) {
    const columns = [["Time", "time"], CONTROLS[history.contact][history.control], PATHS[history.path]];
    control.replaceChildren(
      ...Object.entries(CONTROLS[history.contact]).map(([value, [text]]) => h("option", { value }, text)),
    );
    for (const [key, element] of Object.entries({ preset, control, path, before })) element.value = history[key];
    const hits = history.preset === "impact";
    forms.hidden = kept.hidden = drawing.hidden = hits;
    hit.hidden = !hits;
    for (const [name, field] of impact) field.querySelector("input").value = history.impact[name];
    temperature.value = history.temperature === null ? "" : units.show(history.temperature, "temperature");
    temperature.placeholder = String(
      [state.get("conditions.temperature.from") ?? state.get("conditions.temperature") ?? ""].flat()[0],
    ).replace("degC", "°C");
    table.show(history.rows, columns, wrong);
    picture.show(history.rows, columns);
  }

  function csv() {
    const unit = { load: "N", line_load: "N/m", length: "m", pressure: "Pa", speed: "m/s" };
    const kinds = [CONTROLS[history.contact][history.control][1], PATHS[history.path][1]];
    const head = ["time (s)", `${history.control} (${unit[kinds[0]]})`, `${history.path} (${unit[kinds[1]]})`];
    return [head, ...history.rows].map((row) => row.join(",")).join("\n") + "\n";
  }

  const optionsOf = ({ rows, control, path, before }) => {
    return { rows: rows.map(([time, value, along]) => ({ time, value, along })), control, path, before };
  };

  /** Interrupt the job, which then sends its results so far; cancel it if it does not start or stop. */
  function stop() {
    const { abort, number } = running ?? {};
    if (number) {
      running.number = null;
      api.stopJob(number).catch(() => abort.abort());
    } else abort?.abort();
  }

  async function solve() {
    running?.abort.abort();
    const mine = { abort: new AbortController(), number: null };
    running = mine;
    const asked = history;
    const { temperature } = asked;
    const options = { temperature, ...(asked.preset === "impact" ? { impact: asked.impact } : optionsOf(asked)) };
    bar.start("Solving");
    failed.set([]);
    fields.clearError("motion");
    const heard = {
      signal: mine.abort.signal,
      onStart: (number) => (mine.number = number),
      onProgress: ({ done, total, label }) => running === mine && bar.set(done, total, label),
    };
    try {
      const found = await api.runJob("motion", { study: state.study, options }, heard);
      if (running !== mine) return;
      result = found;
      if (history !== asked) outdated(result);
      const reached = units.show(found.time.at(-1) - found.time[0], "time");
      bar.finish(found.interrupted ? `Stopped; the results end after ${reached}.` : "");
      app.announce(found.interrupted ? `Stopped after ${reached}.` : "The contact over time is solved.");
      draw();
      state.setResult("motion", result);
    } catch (error) {
      if (running !== mine) return;
      bar.finish(error.name === "AbortError" ? "Cancelled." : "");
      if (error.name !== "AbortError") {
        fields.showError(error, "motion");
        failed.set([app.explain(error, "motion")]);
        if (error.values?.index !== undefined) show(error.values.index);
      }
    }
    running = null;
  }

  function draw() {
    if (!result) return;
    about.hidden = false;
    for (const one of [numbers, warnings, notes]) shows(one, result);
    warnings.set(result.warnings);
    notes.set(result.notes);
    numbers.set(numbersOf(result, units));
    pictures.show(result, app.isSynthetic(studyOf(result)));
  }

  if (!history || history.contact !== contactOf(state.study)) begin("hold", state.setView);
  else show();
  state.subscribe("view.motion", changed);
  state.subscribe(DEPENDS_ON.motion, () =>
    history.contact === contactOf(state.study) ? show() : begin(history.preset, state.setView),
  );
  units.subscribe(() => {
    show();
    draw();
  });
}
