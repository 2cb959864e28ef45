// Step 2: isotherms shifted onto one another; the shift factors, the laws that describe them, and whether superposition holds.

import { effect, html, render, view } from "../reactive.js";
import { Card, Dom, Figure, Notes, Numbers, Progress, shown } from "../views.js";
import { decades, rubber, shownRubber, sourceOf, synthetic } from "./made.js";
import { Quality } from "./quality.js";
import { shiftedCard } from "./shifted.js";
import { stepFigure } from "./sweeps_figures.js";
import { LawTable, alphaFigure, limitsInWords, residualTraces, verticalFigure } from "./shift_figures.js";

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
  const form = settings(app);
  const shifted = shiftedCard(app);
  rubber.start();
  const Shift = view(() => {
    const of = shownRubber();
    const none = of && !of.shift && "This material has no shift factors: it is valid at one temperature only.";
    return html`
      <p>All isotherms are shifted along the frequency axis at once, onto one master curve.</p>
      <div class="waiting"><${Progress} job=${rubber} label="Fitting the material" cancels=${false} /></div>
      <${Notes} kind="error" list=${[rubber.error && app.explain(rubber.error, "shift")]} />
      <${Notes} list=${[none]} />
      <div class="columns">
        <div><${Dom} of=${form} /></div>
        <div>${of?.check && html`<${Verdict} of=${of} />`}<${Notes} of=${of} kind="warning" list=${of?.notes} /></div>
      </div>
      <div class="columns"><div><${Dom} of=${shifted.controls} /></div><div><${Dom} of=${shifted} /></div></div>
      ${of?.shift && html`<${Factors} app=${app} of=${of} />`}
    `;
  });
  render(html`<${Shift} />`, section);
}

/** Shift factors, their laws, and whether superposition holds. */
const Factors = view(({ app, of }) => {
  const { shift, check } = of;
  const made = synthetic(of, app);
  const temperature = { label: "temperature", kind: "temperature" };
  const laws = shift.laws.length > 0;
  return html`
    <div class="grid">
      ${
        shift.steps &&
        html`<div class="card">
          <${Figure} id="shifted-steps" title="Creep and relaxation tests over reduced time" of=${of}
            ...${stepFigure(shift.steps, made, app)} />
        </div>`
      }
      <${Card} title="Shift factors">
        <${Figure} id="shift-factors" title="Shift factor against temperature" of=${of} x=${temperature}
          y=${{ label: "log₁₀ α" }} ...${alphaFigure(of, app)} />
        <p ...${shown(of, "help")}>${limitsInWords(shift, app)}</p>
      <//>
      ${
        laws &&
        html`<${Card} title="Residuals of each law">
          <${Figure} id="law-residuals" title="Measured factors over each law" of=${of} synthetic=${made} x=${temperature}
            y=${{ label: "log₁₀ measured/law" }} traces=${residualTraces(shift)}
            caption="log₁₀ of the measured over the law’s α; the band is the measurement’s 95 %." />
        <//>`
      }
    </div>
    ${
      laws &&
      html`<${Card} title="Laws"><p class="help">${shift.explanation}</p><div class="words"><${LawTable} app=${app} of=${of} /></div><//>`
    }
    <div class="grid thirds">
      ${check?.diagrams && html`<${Quality} app=${app} of=${of} />`}
      ${
        shift.vertical &&
        html`<${Card} title="Vertical shift">
          <${Figure} id="vertical-shift" title="Vertical shift b(T)" of=${of} x=${temperature} y=${{ label: "b" }}
            ...${verticalFigure(shift.vertical, of, app)} />
        <//>`
      }
    </div>
  `;
});

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

const Verdict = view(({ of }) => {
  const { check, shift } = of;
  const { misfit, used, origin } = shift;
  const kind = KIND[check.verdict];
  const held = (shift.factors?.held ?? []).filter(Boolean).length;
  const agree = check.kramers_kronig ? (check.kramers_kronig.holds ? "agree" : "do not agree") : "not tested";
  const numbers = [
    misfit && { label: "overlap", value: decades(misfit.joint, 3), remark: `rms over ${misfit.points} points` },
    check.figure_of_merit !== undefined && {
      label: "figure of merit",
      value: check.figure_of_merit.toPrecision(2),
      remark: "good if ≤ 1",
    },
    check.diagrams && { label: "E′ against E″", value: agree, remark: "Kramers–Kronig" },
    {
      label: "α(T) used",
      value: used === "measured" ? "as measured" : used,
      remark: origin === "given" ? "from a file" : held ? `${held} fixed manually` : "fitted to the measurements",
    },
  ];
  return html`<section ...${shown(of, "card")} aria-live="polite">
    <h3 class="verdict" data-kind=${kind}>${check.headline}</h3>
    <${Numbers} list=${numbers.filter(Boolean)} />
    <${Notes} kind=${kind === "good" ? "note" : kind} list=${check.sentences} />
  </section>`;
});
