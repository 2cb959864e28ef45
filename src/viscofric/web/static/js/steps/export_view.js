// The run file, live; the whole study run, with all that it leaves; the rubber as a card for other programs.

import { isCurrent } from "../inputs.js";
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
async function openFiles(app, files, wrong) {
  const isRunFile = (file) => file.name.toLowerCase().endsWith(".toml");
  wrong.set([]);
  try {
    await app.api.uploadFiles(files.filter((file) => !isRunFile(file)));
    const runFile = files.find(isRunFile);
    if (!runFile) throw new Error("No run file was given; its name ends with .toml.");
    const options = { text: await runFile.text() };
    const { study, missing } = await app.api.runJob("open-run-file", { options });
    app.state.replace(study);
    app.announce(
      `${runFile.name} is opened.${missing.length ? ` Missing data files: ${missing.join(", ")}.` : ""}`,
    );
  } catch (error) {
    wrong.set([error.message]);
    app.announce(`Error: ${error.message}`);
  }
}

function runFileCard(app) {
  const { button, card, fileDrop, h, note, textField } = app.fields;
  const text = h("pre", { tabindex: "0", role: "group", "aria-label": "Run file" });
  const about = h("p", { class: "help" });
  const wrong = note([], "error");
  const show = (found) => {
    if (!found) return;
    text.replaceChildren(...coloured(found.text.trimEnd(), h));
    const files = found.files?.length
      ? ` It reads ${found.files.length === 1 ? found.files[0] : `${found.files.length} data files, which the zip contains`}.`
      : "";
    about.textContent = found.cases ? `It has ${found.cases} case${found.cases === 1 ? "" : "s"}.${files}` : "";
    wrong.set(found.problems.map((one) => (one.field ? `${one.field}: ${one.message}` : one.message)));
    take.disabled = found.problems.length > 0;
  };
  const take = button({
    label: "Run file and data (zip)",
    symbol: "down",
    kind: "small",
    onClick: async () => {
      try {
        const found = await app.api.runJob("export-run-file", { study: app.state.study, options: { pack: true } });
        fetchFile(app, found.download.name);
        app.announce("The zip file is ready.");
      } catch (error) {
        wrong.set([error.message]);
      }
    },
  });
  app.state.onResult("run_file", show);
  const bring = fileDrop({
    label: "Open a run file",
    help: "Drop it here with its data files, or choose them.",
    onFiles: (files) => openFiles(app, files, wrong),
  });
  const anew = button({
    label: "Start over",
    kind: "small",
    onClick: () => {
      app.state.replace(app.start.study);
      app.announce("The page shows the example study again; Undo restores yours.");
    },
  });
  const made = card(
    "Run file",
    textField({ path: "title", label: "Title of the study and report" }),
    h(
      "div",
      { class: "row" },
      take,
      copyButton(app, () => app.state.result("run_file")?.text ?? ""),
      anew,
    ),
    about,
    wrong,
    text,
    h("p", { class: "help" }, "Run in its folder: ", h("code", {}, "viscofric run study.toml")),
    bring,
  );
  show(app.state.result("run_file"));
  return made;
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

function studyCard(app) {
  const { button, card, choiceField, h, keyNumbers, note, numberField, progressBar } = app.fields;
  let running = null;
  const bar = progressBar({ label: "Running the study", onCancel: () => running?.abort() });
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
  const clear = () => {
    for (const one of [notes, warnings, failures]) one.set([]);
    numbers.set([]);
    files.replaceChildren();
  };

  async function runStudy() {
    clear();
    app.fields.clearError("study");
    const began = performance.now();
    running = new AbortController();
    go.disabled = true;
    bar.start("Starting");
    try {
      const found = await app.api.runJob(
        "export-study",
        { study: app.state.study, options: { workers: Number(workers.value) || 1 } },
        { signal: running.signal, onProgress: ({ done, total, label }) => bar.set(done, total, label) },
      );
      show(found, (performance.now() - began) / 1e3);
    } catch (error) {
      if (error.name === "AbortError") bar.fail("Cancelled; solved contacts are kept for the next run.");
      else {
        bar.fail("");
        app.fields.showError(error, "study");
        failures.set([app.explain(error, "export")]);
      }
      app.announce(error.name === "AbortError" ? "The study is cancelled." : `Error: ${error.message}`);
    } finally {
      running = null;
      go.disabled = false;
    }
  }

  const changed = () => bar.finish("The study has changed; run it again.");

  function show(found, seconds) {
    if (!isCurrent(found)) return changed();
    const said = `Done in ${seconds < 90 ? `${Math.round(seconds)} s` : `${Math.round(seconds / 60)} min`}.`;
    bar.finish(said);
    numbers.set([
      { label: "cases", value: String(found.cases), remark: found.failed ? `${found.failed} failed` : "all solved" },
      { label: "warnings", value: String(found.warnings.length), remark: found.warnings.length ? "listed below" : "" },
    ]);
    files.replaceChildren(...found.downloads.map((one) => fileLine(app, one)));
    failures.set(found.failures);
    warnings.set(found.warnings);
    notes.set(found.notes);
    app.state.setResult("export", found);
    app.announce(
      `The study is finished: ${found.cases} cases, ${found.failed} failed. ${found.downloads.length} files can be downloaded.`,
    );
  }

  const go = button({ label: "Run the whole study", kind: "main", onClick: runStudy });
  app.state.subscribe("", () => {
    if (files.children.length === 0) return;
    clear();
    changed();
    app.state.setResult("export", undefined);
  });
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
    failures,
    numbers,
    files,
    warnings,
    notes,
  );
}
