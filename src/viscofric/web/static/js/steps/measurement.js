// The measurement step put together.

import { announce } from "../page.js";
import { html } from "../reactive.js";
import { Comparison, Others, agreement } from "./measurement_comparison.js";
import { Identification } from "./measurement_identify.js";
import { MasterCurve, master } from "./measurement_master.js";
import { measured } from "./measurement_parts.js";
import { Source } from "./measurement_source.js";

agreement.done = ({ sentences }) => sentences.length && announce(sentences[0]);
for (const job of [measured, agreement, master]) job.start();

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
