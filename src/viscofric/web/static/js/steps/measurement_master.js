// Friction of all temperatures on one curve, by the rubber's shift factors and by those found from friction itself.

import { downloadUrl } from "../api.js";
import { Form, given } from "../fields.js";
import { Figure } from "../figures.js";
import { page } from "../page.js";
import { html, view } from "../reactive.js";
import { Card, Notes } from "../views.js";
import { Facts, Run, agreement, alone, ofMeasured, shownMeasured } from "./measurement_parts.js";

const fields = page.start.forms.master;
export const master = ofMeasured("master", () => ({ beside: !alone(), law: given(fields).law }));

/** The figure of a master curve; by the material's shift factors with the prediction, which is made with them, if it is known. */
function specOf(of, name) {
  const spec = of?.figures[`master-${name}`];
  const { figures, along } = (name === "by_rubber" && agreement.current) || {};
  if (!spec || !figures?.along || Math.abs(along.reference - of.by_rubber.reference) > 0.01) return spec;
  const points = spec.traces.filter(({ temperature }) => temperature !== undefined);
  return { ...spec, traces: [...figures.along.traces, ...points] };
}

/** The card of the friction master curve. */
export const MasterCurve = view(() => {
  const of = master.error ? null : master.result;
  const { found, by_rubber: byRubber, refusal, notes = [] } = of ?? {};
  const drawn = found && (!byRubber || given(fields).shifted === "found") ? "found" : "by_rubber";
  const offered = { "@friction.beside": true, "@friction.shifted": found && byRubber, "@friction.law": found };
  const refused = refusal && `Shift factors cannot be determined from friction alone: ${refusal}`;
  return html`<${Card} title="Friction master curve" hidden=${!shownMeasured()?.curves}>
    <${Form} of=${fields.filter(({ path }) => offered[path])} />
    <${Run} job=${master} label="Shifting" />
    <div class="grid">
      <${Figure} id="friction-master-curve" title="Friction at one temperature" height=${340} of=${of}
        spec=${specOf(of, drawn)} />
      <${Figure} id="friction-shift-factors" title="Shift factors" height=${340} of=${of}
        empty="Friction at one temperature determines no shift factor." />
    </div>
    <${Notes} of=${of} list=${[refused, ...notes]} />
    <${Facts} of=${of} list=${found?.words ?? byRubber?.words} />
    <div class="row">
      ${found && html`<a class="button small" download="shift_factors_from_friction.csv" href=${downloadUrl(found.download)}>Shift factors (CSV)</a>`}
    </div>
  <//>`;
});
