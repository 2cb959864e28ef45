// Step 2: isotherms shifted onto one another; the shift factors, the laws that describe them, and whether superposition holds.

import { Figure } from "../figures.js";
import { Choose, Quantity } from "../fields.js";
import { explain } from "../page.js";
import { html, view } from "../reactive.js";
import { state } from "../state.js";
import { Button, Card, Drop, Notes, Numbers, Progress, shown } from "../views.js";
import { decades, isMade, rubber, shownRubber, synthetic } from "./made.js";
import { Quality } from "./quality.js";
import { Shifted, startShifted } from "./shifted.js";
import { failed, takeFactors } from "./source.js";
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

/** Shift factors, their laws, and whether superposition holds. */
const Factors = view(({ of }) => {
  const { shift, check } = of;
  const made = synthetic(of);
  const temperature = { label: "temperature", kind: "temperature" };
  const laws = shift.laws.length > 0;
  return html`
    <div class="grid">
      ${
        shift.steps &&
        html`<div class="card">
          <${Figure} id="shifted-steps" title="Creep and relaxation tests over reduced time" of=${of}
            ...${stepFigure(shift.steps, made)} />
        </div>`
      }
      <${Card} title="Shift factors">
        <${Figure} id="shift-factors" title="Shift factor against temperature" of=${of} x=${temperature}
          y=${{ label: "log₁₀ α" }} ...${alphaFigure(of)} />
        <p ...${shown(of, "help")}>${limitsInWords(shift)}</p>
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
      html`<${Card} title="Laws"><p class="help">${shift.explanation}</p><div class="words"><${LawTable} of=${of} /></div><//>`
    }
    <div class="grid thirds">
      ${check?.diagrams && html`<${Quality} of=${of} />`}
      ${
        shift.vertical &&
        html`<${Card} title="Vertical shift">
          <${Figure} id="vertical-shift" title="Vertical shift b(T)" of=${of} x=${temperature} y=${{ label: "b" }}
            ...${verticalFigure(shift.vertical, of)} />
        <//>`
      }
    </div>
  `;
});

/** How sweeps are shifted; nothing of it holds for a rubber that is ready. */
const Settings = view(() => {
  if (!isMade())
    return html`<${Card} title="Shift"><p class="help">A predefined material has its own shift factors.</p><//>`;
  const given = state.get("material.shift_factors");
  return html`<${Card} title="Shift">
    <div class="panel">
      <${Quantity} path="material.reference_temperature" label="Reference temperature" kind="temperature"
        help="The shift factor is 1 at this temperature." />
      <${Choose} path="material.shift" label="α(T) used" options=${SHIFTS} otherwise="measured"
        help="Measured factors are valid between the isotherms only; a law extrapolates." />
      <${Choose} path="material.vertical_shift" label="Vertical shift b(T)" options=${VERTICALS} otherwise="none" />
      ${
        given &&
        html`<div class="row">
          <span>Shift factors of ${given}</span>
          <${Button} kind="small" onClick=${() => state.set("material.shift_factors", undefined)}>Fit them to the sweeps<//>
        </div>`
      }
      <details>
        <summary>Use shift factors from a file</summary>
        <${Drop} label="Drop shift factors" multiple=${false} onFiles=${takeFactors}
          help="Temperature and α or log₁₀ α, as written by the instrument's software." />
      </details>
      <${Notes} kind="error" list=${[failed.value?.message]} />
    </div>
  <//>`;
});

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

rubber.start();
startShifted();

export default view(() => {
  const of = shownRubber();
  const none = of && !of.shift && "This material has no shift factors: it is valid at one temperature only.";
  return html`
    <p>All isotherms are shifted along the frequency axis at once, onto one master curve.</p>
    <div class="waiting"><${Progress} job=${rubber} label="Fitting the material" cancels=${false} /></div>
    <${Notes} kind="error" list=${[rubber.error && explain(rubber.error, "shift")]} />
    <${Notes} list=${[none]} />
    <div class="columns">
      <div><${Settings} /></div>
      <div>${of?.check && html`<${Verdict} of=${of} />`}<${Notes} of=${of} kind="warning" list=${of?.notes} /></div>
    </div>
    ${of?.shift?.isotherms?.length > 0 && html`<${Shifted} of=${of} />`}
    ${of?.shift && html`<${Factors} of=${of} />`}
  `;
});
