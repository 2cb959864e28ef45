// The run file, live; the whole study run, with all that it leaves; the rubber as a card for other programs.

import { Job, newest, shows } from "../jobs.js";
import { effect, signal, watch } from "../reactive.js";
import { state } from "../state.js";
import { cardCard, copyButton, fileLine } from "./export_card.js";

/** Fill the step. */
export function show(section, app) {
  const { h } = app.fields;
  section.append(
    h(
      "p",
      {},
      "One run file reproduces everything on this page. Download it to repeat the study anywhere, or run it here.",
    ),
    h("div", { class: "grid" }, runFileCard(app), h("div", { class: "stack" }, studyCard(app), cardCard(app))),
  );
}

/** Downloads what a job left. */
function fetchFile(app, name) {
  app.fields.h("a", { href: app.api.downloadUrl(name), download: name }).click();
}

/** Take in data files, and show the study of a run file among them. */
async function openFiles(app, files, failed) {
  const isRunFile = (file) => file.name.toLowerCase().endsWith(".toml");
  failed.value = null;
  try {
    await app.api.uploadFiles(files.filter((file) => !isRunFile(file)));
    const runFile = files.find(isRunFile);
    if (!runFile) throw new Error("No run file was given; its name ends with .toml.");
    const options = { text: await runFile.text() };
    const { study, missing } = await app.api.runJob("open-run-file", { options });
    state.replace(study);
    app.announce(
      `${runFile.name} is opened.${missing.length ? ` Missing data files: ${missing.join(", ")}.` : ""}`,
    );
  } catch (error) {
    failed.value = error.message;
    app.announce(`Error: ${error.message}`);
  }
}

function runFileCard(app) {
  const { button, card, fileDrop, h, note, textField } = app.fields;
  const text = h("pre", { tabindex: "0", role: "group", "aria-label": "Run file" });
  const about = h("p", { class: "help" });
  const wrong = note([], "error");
  const failed = signal(null); // what went wrong with files or the archive
  const take = button({
    label: "Run file and data (zip)",
    symbol: "down",
    kind: "small",
    onClick: async () => {
      failed.value = null;
      try {
        const found = await app.api.runJob("export-run-file", { study: state.study, options: { pack: true } });
        fetchFile(app, found.download.name);
        app.announce("The zip file is ready.");
      } catch (error) {
        failed.value = error.message;
      }
    },
  });
  effect(() => {
    const found = newest("export-run-file");
    if (!found) return;
    shows(text, found);
    text.replaceChildren(...coloured(found.text.trimEnd(), h));
    const files = found.files?.length
      ? ` It reads ${found.files.length === 1 ? found.files[0] : `${found.files.length} data files, which the zip contains`}.`
      : "";
    about.textContent = found.cases ? `It has ${found.cases} case${found.cases === 1 ? "" : "s"}.${files}` : "";
    const problems = found.problems.map((one) => (one.field ? `${one.field}: ${one.message}` : one.message));
    wrong.set([...problems, ...(failed.value ? [failed.value] : [])]);
    take.disabled = found.problems.length > 0;
  });
  const bring = fileDrop({
    label: "Open a run file",
    help: "Drop it here with its data files, or choose them.",
    onFiles: (files) => openFiles(app, files, failed),
  });
  const anew = button({
    label: "Start over",
    kind: "small",
    onClick: () => {
      state.replace(app.start.study);
      app.announce("The page shows the example study again; Undo restores yours.");
    },
  });
  return card(
    "Run file",
    textField({ path: "title", label: "Title of the study and report" }),
    h(
      "div",
      { class: "row" },
      take,
      copyButton(app, () => newest("export-run-file")?.text ?? ""),
      anew,
    ),
    about,
    wrong,
    text,
    h("p", { class: "help" }, "Run in its folder: ", h("code", {}, "viscofric run study.toml")),
    bring,
  );
}

/** A run file's lines, with headings, keys and remarks marked as such. */
function coloured(text, h) {
  return text.split("\n").flatMap((line) => {
    const key = /^([\w-]+)( = .*)$/.exec(line);
    if (line.startsWith("#")) return [h("span", { class: "remark" }, line), "\n"];
    if (line.startsWith("[")) return [h("span", { class: "heading" }, line), "\n"];
    return key ? [h("span", { class: "key" }, key[1]), key[2], "\n"] : [line, "\n"];
  });
}

// How many processes it takes is no input.
const study = new Job("export-study", {
  manual: true,
  inputs: () => ({ study: state.study }),
  asked: (_, asked) => ({ study: asked.study }),
});
const inWords = (seconds) => (seconds < 90 ? `${Math.round(seconds)} s` : `${Math.round(seconds / 60)} min`);

function studyCard(app) {
  const { button, card, choiceField, h, keyNumbers, note, numberField, progressBar } = app.fields;
  const bar = progressBar(study, {
    label: "Running the study",
    ended: ({ cancelled, seconds }) =>
      cancelled ? "Cancelled; solved contacts are kept for the next run." : `Done in ${inWords(seconds)}.`,
  });
  const outdated = note([]);
  const numbers = keyNumbers();
  const notes = note([]);
  const warnings = note([], "warning");
  const failures = note([], "error");
  const files = h("ul", { class: "downloads", "aria-label": "Results" });
  const workers = h("input", {
    type: "number",
    min: "1",
    max: String(navigator.hardwareConcurrency || 1),
    value: "1",
    id: "export-workers",
  });
  const go = button({ label: "Run the whole study", kind: "main", onClick: run });
  function run() {
    const options = { workers: Number(workers.value) || 1 };
    study.run({ study: state.study, options });
  }
  study.done = ({ cases, failed, downloads }) =>
    app.announce(
      `The study is finished: ${cases} cases, ${failed} failed. ${downloads.length} files can be downloaded.`,
    );
  effect(() => {
    const found = study.current; // files of another study are none of this one
    go.disabled = Boolean(study.progress);
    outdated.set(study.result && !found && !study.progress ? ["The study has changed; run it again."] : []);
    numbers.set(
      found
        ? [
            { label: "cases", value: String(found.cases), remark: found.failed ? `${found.failed} failed` : "all solved" },
            {
              label: "warnings",
              value: String(found.warnings.length),
              remark: found.warnings.length ? "listed below" : "",
            },
          ]
        : [],
    );
    files.replaceChildren(...(found?.downloads ?? []).map((one) => fileLine(app, one)));
    failures.set(study.error ? [app.explain(study.error, "export")] : (found?.failures ?? []));
    warnings.set(found?.warnings ?? []);
    notes.set(found?.notes ?? []);
  });
  watch(
    () => study.error ?? study.ended,
    (end) => {
      if (end?.cancelled) app.announce("The study is cancelled.");
      else if (end?.message) app.announce(`Error: ${end.message}`);
    },
  );
  return card(
    "Results and report",
    h(
      "p",
      { class: "help" },
      "Solves every case to the requested accuracy, with the material's uncertainty, and writes a report, tables and figures.",
    ),
    h(
      "div",
      { class: "form" },
      numberField({
        path: "solver.accuracy",
        label: "Accuracy of friction",
        min: 1e-4,
        max: 0.1,
        placeholder: "0.001",
      }),
      numberField({ path: "uncertainty.draws", label: "Bootstrap samples", min: 0, step: 1, placeholder: "200" }),
      choiceField({
        path: "outputs.fields",
        label: "Stored pressure maps",
        otherwise: "few",
        options: [
          ["few", "of a few cases"],
          ["all", "of all cases"],
          ["none", "none"],
        ],
      }),
      h("div", { class: "field" }, h("label", { class: "field-label", for: "export-workers" }, "Processes"), workers),
    ),
    h("div", { class: "row" }, go, bar),
    outdated,
    failures,
    numbers,
    files,
    warnings,
    notes,
  );
}
