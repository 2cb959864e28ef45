// Measured friction beside the prediction for the page's rubber and ball, and what else follows from the test.

import { Figure } from "../figures.js";
import { html, view } from "../reactive.js";
import { Card, Folded, Notes, Numbers, Table } from "../views.js";
import { Checks, Run, alone, ofMeasured, shownMeasured } from "./measurement_parts.js";

export const agreement = ofMeasured("agreement", () => (alone() ? null : {}), { remember: 4 });

const OTHERS = ["coulomb-friction", "four-runs", "force-cell-zero"];

/** Measured friction beside the prediction. */
export const Comparison = view(() => {
  const measured = shownMeasured();
  const of = agreement.error ? null : agreement.result;
  return html`<${Card} title="Measured against predicted">
    <${Run} job=${agreement} label="Predicting" />
    <${Figure} id="measured-friction" title="Viscoelastic friction" of=${of ?? measured}
      empty="Drop the files of a traction test, or use the synthetic example." />
    <${Numbers} of=${of} />
    <${Notes} of=${of} list=${of ? [of.sentences[0], ...of.notes] : []} />
    <${Notes} of=${of} kind="warning" list=${of ? [...of.failures, ...of.warnings] : []} />
    <${Folded} title="By temperature, and checks" hidden=${!of}>
      ${of?.table && html`<${Table} of=${of} ...${of.table} /><p class="help">${of.table.note}</p>`}
      <${Checks} of=${of} list=${of?.checks} />
    <//>
  <//>`;
});

/** What else follows from the test. */
export const Others = view(() => {
  const of = shownMeasured();
  const found = OTHERS.filter((id) => of?.figures[id]);
  return html`<div class="grid thirds" hidden=${!of?.curves}>
    ${found.map((id) => html`<section class="card" key=${id}><${Figure} id=${id} height=${300} of=${of} /></section>`)}
  </div>`;
});
