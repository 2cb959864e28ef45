// Step 6: measured friction beside the prediction for the page's rubber and ball, and what else follows from the test.

import { Figure } from "../figures.js";
import { announce } from "../page.js";
import { html, view } from "../reactive.js";
import { Card, Folded, Notes, Numbers, Table } from "../views.js";
import { Identification } from "./measurement_identify.js";
import { MasterCurve, master } from "./measurement_master.js";
import { Checks, Run, agreement, measured, shownMeasured } from "./measurement_parts.js";
import { Source } from "./measurement_source.js";

agreement.done = ({ sentences }) => sentences.length && announce(sentences[0]);
for (const job of [measured, agreement, master]) job.start();

const OTHERS = ["coulomb-friction", "four-runs", "force-cell-zero"];

/** Measured friction beside the prediction. */
const Comparison = view(() => {
  const of = agreement.error ? null : agreement.result;
  return html`<${Card} title="Measured against predicted">
    <${Run} job=${agreement} label="Predicting" />
    <${Figure} id="measured-friction" title="Viscoelastic friction" of=${of ?? shownMeasured()}
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
const Others = view(() => {
  const of = shownMeasured();
  const found = OTHERS.filter((id) => of?.figures[id]);
  return html`<div class="grid thirds" hidden=${!of?.curves}>
    ${found.map((id) => html`<section class="card" key=${id}><${Figure} id=${id} height=${300} of=${of} /></section>`)}
  </div>`;
});

export default () => html`
  <p>
    Traction test: separation of Coulomb and viscoelastic friction, comparison with the prediction, friction master
    curve, and material identified from friction.
  </p>
  <div class="columns"><div><${Source} /></div><div><${Comparison} /></div></div>
  <${Others} />
  <${MasterCurve} />
  <${Identification} />
`;
