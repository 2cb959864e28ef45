// Step 6: measured friction beside the prediction for the page's rubber and ball, and what else follows from the test.

import { Figure, Figures } from "../figures.js";
import { announce } from "../page.js";
import { html, view } from "../reactive.js";
import { Card, Checks, Folded, Notes, Numbers, Table } from "../views.js";
import { Identification, MasterCurve, master } from "./measurement_analysis.js";
import { Run, Source, agreement, emptyOf, measured } from "./measurement_source.js";

agreement.done = ({ sentences }) => sentences.length && announce(sentences[0]);
for (const job of [measured, agreement, master]) job.start();

const OTHERS = ["coulomb-friction", "four-runs", "force-cell-zero"];

/** Measured friction beside the prediction. */
const Comparison = view(() => {
  const of = agreement.shown;
  return html`<${Card} title="Measured against predicted">
    <${Run} job=${agreement} label="Predicting" />
    <${Figure} id="measured-friction" title="Viscoelastic friction" of=${of ?? measured.shown}
      empty=${emptyOf("Drop the files of a traction test, or use the synthetic example.")} />
    <${Numbers} of=${of} />
    <${Notes} of=${of} list=${of ? [of.sentences[0], ...of.notes] : []} />
    <${Notes} of=${of} kind="warning" list=${of ? [...of.failures, ...of.warnings] : []} />
    <${Folded} title="By temperature, and checks" hidden=${!of}>
      ${of?.table && html`<${Table} of=${of} ...${of.table} /><p class="help">${of.table.note}</p>`}
      <${Checks} of=${of} list=${of?.checks} />
    <//>
  <//>`;
});

export default view(() => html`
  <p>
    Traction test: separation of Coulomb and viscoelastic friction, comparison with the prediction, friction master
    curve, and material identified from friction.
  </p>
  <div class="columns"><div><${Source} /></div><div><${Comparison} /></div></div>
  <div class="grid thirds"><${Figures} of=${measured.shown} ids=${OTHERS} height=${300} /></div>
  <${MasterCurve} />
  <${Identification} />
`);
