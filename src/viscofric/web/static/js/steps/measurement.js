// The measurement step put together.

import { announce, page } from "../page.js";
import { html } from "../reactive.js";
import { state } from "../state.js";
import { Comparison, Others, agreement } from "./measurement_comparison.js";
import { Identification } from "./measurement_identify.js";
import { MasterCurve, master } from "./measurement_master.js";
import { measured, shownMeasured } from "./measurement_parts.js";
import { source } from "./measurement_source.js";

/** What the parts of the step share: whether the measurement is made up, and whether it or the rubber is. */
function origins() {
  const data = () => Boolean(shownMeasured()?.synthetic);
  const rubber = () => {
    const name = state.get("material.catalogue");
    if (name === undefined) return state.get("data_origin") === "synthetic";
    return Boolean(page.start?.catalogue?.find((one) => one.name === name)?.synthetic);
  };
  return { data, synthetic: () => data() || rubber() };
}

const step = origins();
const Source = source();
agreement.done = ({ sentences }) => sentences.length && announce(sentences[0]);
for (const job of [measured, agreement, master]) job.start();

export default () => html`
  <p>
    Traction test: separation of Coulomb and viscoelastic friction, comparison with the prediction, friction master
    curve, and material identified from friction.
  </p>
  <div class="columns"><div><${Source} /></div><div><${Comparison} step=${step} /></div></div>
  <${Others} step=${step} />
  <${MasterCurve} step=${step} />
  <${Identification} step=${step} />
`;
