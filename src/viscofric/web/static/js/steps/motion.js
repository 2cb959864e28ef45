// Motion over time: a history edited as a table or a sketch, or an impact, and the solved contact.

import { studyHistory } from "../motion_study.js";
import { Job, shows, studyOf } from "../jobs.js";
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
import { effect, signal, watch } from "../reactive.js";
import { state } from "../state.js";

const BEFORE = ["untouched", "at rest", "sliding"].map((one) => [one, one]);
const IMPACT = {
  mass: ["Mass (kg)", 0.033],
  speed: ["Speed (m/s)", 1],
  gravity: ["Gravity (m/s²)", 0],
  rebounds: ["Contacts to follow", 1],
};

const history = () => state.view("motion");
const optionsOf = ({ rows, control, path, before }) => {
  return { rows: rows.map(([time, value, along]) => ({ time, value, along })), control, path, before };
};
const motion = new Job("motion", {
  manual: true,
  interrupts: true,
  remember: 4,
  inputs: () => {
    const asked = history();
    if (!asked) return null;
    const given = asked.preset === "impact" ? { impact: asked.impact } : optionsOf(asked);
    return { study: state.study, options: { temperature: asked.temperature, ...given } };
  },
});

export function mount(section, app) {
  const { fields, units, figures } = app;
  const { h, card, button } = fields;
  const refused = signal(null); // what is wrong with something that was typed

  const failed = fields.note([], "error");
  const warnings = fields.note([], "warning");
  const notes = fields.note([]);
  const numbers = fields.keyNumbers([]);
  const pictures = motionFigures(app);
  const reached = ({ time }) => units.show(time.at(-1) - time[0], "time");
  const bar = fields.progressBar(motion, {
    label: "Solving",
    ended: ({ cancelled }) => {
      if (cancelled) return "Cancelled.";
      return motion.result.interrupted ? `Stopped; the results end after ${reached(motion.result)}.` : "";
    },
  });
  const solveButton = button({ label: "Solve", kind: "main", onClick: () => motion.run() });
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
    refuse: (sentence) => (refused.value = sentence),
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
    change({ control: value, path: "speed", rows: presetRows(history().preset, state.study, value) }),
  );
  const path = select(
    Object.entries(PATHS).map(([value, [text]]) => [value, text]),
    (value) => change({ path: value, rows: converted(history().rows, value) }),
  );
  const before = select(BEFORE, (value) => change({ before: value }));
  /** A text field for one number; other input gives an error message. */
  const box = (label, kind, onRead) => {
    const element = h("input", { type: "text", autocomplete: "off" });
    element.addEventListener("change", () => {
      const value = element.value.trim() ? read(element.value, kind) : null;
      if (Number.isFinite(value) || !element.value.trim()) onRead(value);
      else refused.value = `${label}: enter a number.`;
    });
    return element;
  };
  const temperature = box("Temperature", "temperature", (kelvin) => change({ temperature: kelvin }));
  const impact = Object.entries(IMPACT).map(([name, [label]]) => [
    name,
    labelled(
      label,
      box(label, "plain", (value) => value !== null && change({ impact: { ...history().impact, [name]: value } })),
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
    studyHistory(app, { rows: () => optionsOf(history()), take: (found) => change(found) }),
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
      impact: history()?.impact ?? values,
    };
    change(begun, keep);
  }

  /** Change the history, as a step of undo unless it follows from the study. */
  function change(values, keep = state.edit) {
    refused.value = null;
    keep("motion", { temperature: null, ...history(), ...values });
  }

  function show(history, wrong) {
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
    const { contact, control, path, rows } = history();
    const kinds = [CONTROLS[contact][control][1], PATHS[path][1]];
    const head = ["time (s)", `${control} (${unit[kinds[0]]})`, `${path} (${unit[kinds[1]]})`];
    return [head, ...rows].map((row) => row.join(",")).join("\n") + "\n";
  }

  motion.done = (found) =>
    app.announce(found.interrupted ? `Stopped after ${reached(found)}.` : "The contact over time is solved.");
  if (history()?.contact !== contactOf(state.study)) begin("hold", state.setView);
  watch(
    () => contactOf(state.study),
    () => begin(history().preset, state.setView),
  );
  motion.start();
  effect(() => show(history(), motion.error?.values?.index ?? null));
  effect(() => {
    const sentence = refused.value ?? (motion.error && app.explain(motion.error, "motion"));
    failed.set(sentence ? [sentence] : []);
  });
  effect(() => {
    const found = motion.result;
    about.hidden = !found;
    if (!found) return;
    for (const one of [numbers, warnings, notes]) shows(one, found);
    warnings.set(found.warnings);
    notes.set(found.notes);
    numbers.set(numbersOf(found, units));
    pictures.show(found, app.isSynthetic(studyOf(found)));
  });
}
