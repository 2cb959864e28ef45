// Step 2: isotherms shifted onto one another; the shift factors, the laws that describe them, and whether superposition holds.

import { shows } from "../jobs.js";
import { effect } from "../reactive.js";
import { decades, rubber, shownRubber, sourceOf, synthetic } from "./made.js";
import { qualityCards } from "./quality.js";
import { shiftedCard } from "./shifted.js";
import { stepFigure } from "./sweeps_figures.js";
import { alphaFigure, lawTable, limitsInWords, residualTraces, verticalFigure } from "./shift_figures.js";

const SHIFTS = [
  ["measured", "as measured"],
  ["best", "the best law"],
  ["wlf", "WLF"],
  ["arrhenius", "Arrhenius"],
  ["vft", "VFT"],
  ["wlf+arrhenius", "WLF, Arrhenius below Tg"],
  ["polynomial", "polynomial in 1/T"],
];
const VERTICALS = [
  ["none", "none"],
  ["free", "fitted"],
  ["density", "density times temperature"],
];
const KIND = {
  holds: "good",
  "other factors": "warning",
  "not identified": "warning",
  doubtful: "warning",
  roughly: "warning",
  fails: "error",
  untested: "warning",
};

export function mount(section, app) {
  const { fields, figures } = app;
  const { h, card, note } = fields;
  const wait = fields.progressBar(rubber.start(), { label: "Fitting the material", cancels: false });
  const problem = note([], "error");
  const nothing = note([], "note");
  const verdict = verdictCard(app);
  const form = settings(app);
  const shifted = shiftedCard(app);
  const factors = card("Shift factors");
  const alpha = figures.figure(factors, {
    id: "shift-factors",
    title: "Shift factor against temperature",
    x: { label: "temperature", kind: "temperature" },
    y: { label: "log₁₀ α" },
    traces: [],
  });
  const limits = h("p", { class: "help" });
  factors.append(limits);
  const laws = card("Laws");
  const explanation = h("p", { class: "help" });
  const table = h("div", { class: "words" });
  laws.append(explanation, table);
  const over = h("div", { class: "card" });
  const steps = figures.figure(over, { id: "shifted-steps", title: "Creep and relaxation tests over reduced time", x: {}, y: {}, traces: [] });
  const left = card("Residuals of each law");
  const residual = figures.figure(left, {
    id: "law-residuals",
    title: "Measured factors over each law",
    caption: "log₁₀ of the measured over the law’s α; the band is the measurement’s 95 %.",
    x: { label: "temperature", kind: "temperature" },
    y: { label: "log₁₀ measured/law" },
    traces: [],
  });
  const quality = qualityCards(app);
  const vertical = card("Vertical shift");
  const b = figures.figure(vertical, {
    id: "vertical-shift",
    title: "Vertical shift b(T)",
    x: { label: "temperature", kind: "temperature" },
    y: { label: "b" },
    traces: [],
  });
  const notes = note([], "warning");
  section.append(
    h("p", {}, "All isotherms are shifted along the frequency axis at once, onto one master curve."),
    h("div", { class: "waiting" }, wait),
    problem,
    nothing,
    h("div", { class: "columns" }, h("div", {}, form), h("div", {}, verdict, notes)),
    h("div", { class: "columns" }, h("div", {}, shifted.controls), h("div", {}, shifted)),
    h("div", { class: "grid" }, over, factors, left),
    laws,
    h("div", { class: "grid thirds" }, ...quality.cards, vertical),
  );

  effect(() => {
    const result = shownRubber();
    problem.set(rubber.error ? [app.explain(rubber.error, "shift")] : []);
    const shift = result?.shift;
    for (const one of [verdict, laws, notes, limits]) shows(one, result);
    nothing.set(
      result && !shift ? ["This material has no shift factors: it is valid at one temperature only."] : [],
    );
    verdict.show(result);
    factors.hidden = !shift;
    laws.hidden = left.hidden = !shift?.laws.length;
    over.hidden = !shift?.steps;
    vertical.hidden = !shift?.vertical;
    quality.show(result);
    notes.set(result?.notes ?? []);
    if (!shift) return;
    alpha.update({ of: result, ...alphaFigure(result, app) });
    if (shift.steps) steps.update({ of: result, ...stepFigure(shift.steps, synthetic(result, app), app) });
    limits.textContent = limitsInWords(shift, app);
    explanation.textContent = shift.explanation;
    table.replaceChildren(lawTable(shift, app));
    residual.update({ of: result, traces: residualTraces(shift), synthetic: synthetic(result, app) });
    if (shift.vertical) b.update({ of: result, ...verticalFigure(shift.vertical, result, app) });
  });
}

/** How sweeps are shifted; nothing of it holds for a rubber that is ready. */
function settings(app) {
  const { state, fields, api } = app;
  const { h, card, button } = fields;
  const problem = fields.note([], "error");
  const given = h("div", { class: "row" });
  const takeFactors = async (files) => {
    try {
      const [name] = await api.uploadFiles(files);
      state.change({ "material.shift_factors": name, "material.fixed_shift_factors": undefined });
      problem.set([]);
    } catch (error) {
      problem.set([error.message]);
    }
  };
  const ofSweeps = h(
    "div",
    { class: "panel" },
    fields.quantityField({
      path: "material.reference_temperature",
      label: "Reference temperature",
      kind: "temperature",
      help: "The shift factor is 1 at this temperature.",
    }),
    fields.choiceField({
      path: "material.shift",
      label: "α(T) used",
      options: SHIFTS,
      otherwise: "measured",
      help: "Measured factors are valid between the isotherms only; a law extrapolates.",
    }),
    fields.choiceField({
      path: "material.vertical_shift",
      label: "Vertical shift b(T)",
      options: VERTICALS,
      otherwise: "none",
    }),
    given,
    h(
      "details",
      {},
      h("summary", {}, "Use shift factors from a file"),
      fields.fileDrop({
        label: "Drop shift factors",
        help: "Temperature and α or log₁₀ α, as written by the instrument's software.",
        multiple: false,
        onFiles: takeFactors,
      }),
    ),
    problem,
  );
  const ready = h("p", { class: "help" }, "A predefined material has its own shift factors.");
  const element = card("Shift", ofSweeps, ready);
  const refresh = () => {
    const source = sourceOf(state.get("material"));
    ofSweeps.hidden = source === "catalogue" || source === "file" || source === null;
    ready.hidden = !ofSweeps.hidden;
    const name = state.get("material.shift_factors");
    given.replaceChildren(
      ...(name
        ? [
            h("span", {}, `Shift factors of ${name}`),
            button({
              label: "Fit them to the sweeps",
              kind: "small",
              onClick: () => state.set("material.shift_factors", undefined),
            }),
          ]
        : []),
    );
  };
  effect(refresh);
  return element;
}

function verdictCard({ fields }) {
  const { h, note } = fields;
  const headline = h("h3", { class: "verdict" });
  const sentences = note([]);
  const numbers = fields.keyNumbers();
  const element = h("section", { class: "card", "aria-live": "polite" }, headline, numbers, sentences);
  element.show = (result) => {
    const check = result?.check;
    element.hidden = !check;
    if (!check) return;
    headline.textContent = check.headline;
    headline.dataset.kind = KIND[check.verdict];
    sentences.set(check.sentences, { error: "error", warning: "warning" }[KIND[check.verdict]] ?? "note");
    const { misfit, used, origin } = result.shift;
    const held = (result.shift.factors?.held ?? []).filter(Boolean).length;
    numbers.set([
      ...(misfit
        ? [{ label: "overlap", value: decades(misfit.joint, 3), remark: `rms over ${misfit.points} points` }]
        : []),
      ...(check.figure_of_merit !== undefined
        ? [{ label: "figure of merit", value: check.figure_of_merit.toPrecision(2), remark: "good if ≤ 1" }]
        : []),
      ...(check.diagrams
        ? [
            {
              label: "E′ against E″",
              value: check.kramers_kronig ? (check.kramers_kronig.holds ? "agree" : "do not agree") : "not tested",
              remark: "Kramers–Kronig",
            },
          ]
        : []),
      {
        label: "α(T) used",
        value: used === "measured" ? "as measured" : used,
        remark: origin === "given" ? "from a file" : held ? `${held} fixed manually` : "fitted to the measurements",
      },
    ]);
  };
  return element;
}
