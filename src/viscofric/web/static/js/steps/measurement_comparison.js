// Measured friction beside the prediction for the page's rubber and ball, and what else follows from the test.

import { Figure } from "../figures.js";
import { html, view } from "../reactive.js";
import { Card, Folded, Notes, Numbers, Table } from "../views.js";
import { checkFigure, coulombFigure, frictionFigure, zeroFigure } from "./measurement_figures.js";
import { Checks, Run, alone, ofMeasured, shownMeasured } from "./measurement_parts.js";

export const agreement = ofMeasured("agreement", () => (alone() ? null : {}), { remember: 4 });

const SPEED = { label: "speed", kind: "speed", log: true };
const OTHERS = [
  {
    draw: coulombFigure,
    id: "coulomb-friction",
    title: "Coulomb friction",
    caption: "Measured, with the standard deviation of the repetitions.",
    y: { label: "Coulomb friction coefficient" },
  },
  {
    draw: checkFigure,
    id: "four-runs",
    title: "Check of the four configurations",
    caption: "(F_I − F_II + F_III − F_IV)/4 over the load, with twice its standard error: zero in a valid test.",
    y: { label: "residual over load" },
  },
  {
    draw: zeroFigure,
    id: "force-cell-zero",
    title: "Zero of the force cell",
    caption: "As fitted at each condition; a drift is reported in the notes.",
    y: { label: "zero", kind: "load" },
  },
];

/** Measured friction beside the prediction. */
export const Comparison = view(({ step }) => {
  const measured = shownMeasured();
  const of = agreement.error ? null : agreement.result;
  const { headings, rows, caption, note } = of?.table ?? {};
  return html`<${Card} title="Measured against predicted">
    <${Run} job=${agreement} label="Predicting" />
    <${Figure} id="measured-friction" title="Viscoelastic friction" x=${SPEED}
      empty="Drop the files of a traction test, or use the synthetic example."
      of=${of ?? measured} ...${frictionFigure(measured, of, of ? step.synthetic() : step.data())} />
    <${Numbers} of=${of} list=${(of?.key ?? []).map(({ name, value, remark }) => ({ label: name, value, remark }))} />
    <${Notes} of=${of} list=${of ? [of.sentences[0], ...of.notes] : []} />
    <${Notes} of=${of} kind="warning" list=${of ? [...of.failures, ...of.warnings] : []} />
    <${Folded} title="By temperature, and checks" hidden=${!of}>
      ${rows && html`<${Table} of=${of} head=${headings} rows=${rows} caption=${caption} /><p class="help">${note}</p>`}
      <${Checks} of=${of} list=${of?.checks} />
    <//>
  <//>`;
});

/** What else follows from the test. */
export const Others = view(({ step }) => {
  const of = shownMeasured();
  return html`<div class="grid thirds" hidden=${!of?.curves}>
    ${OTHERS.map(({ draw, ...spec }) => {
      const changes = draw(of, step.data());
      return html`<section class="card" hidden=${changes.traces.length === 0}>
        <${Figure} x=${SPEED} height=${300} ...${spec} of=${of} ...${changes} />
      </section>`;
    })}
  </div>`;
});
