// Step 1: where the rubber comes from; what its files were taken for, what they hold, and what was flagged in them.

import { Figure } from "../figures.js";
import { Job } from "../jobs.js";
import { announce, explain, goTo, page, sourceKey } from "../page.js";
import { effect, html, view, watch } from "../reactive.js";
import { state } from "../state.js";
import * as units from "../units.js";
import { Button, Card, Folded, Notes, Numbers, Progress, Table } from "../views.js";
import { Amplitude, amplitude } from "./amplitude.js";
import { FIRST_REFERENCE, rubber, shownRubber, worded } from "./made.js";
import { failed } from "./source.js";
import { Source } from "./sweeps_form.js";

const MEASURED = ["dma", "ramps"]; // sources whose moduli are shown as measured
const FIGURES = ["step-tests", ...["storage-modulus", "loss-modulus", "loss-tangent"].map((one) => `isotherms-${one}`)];

const sweeps = new Job("sweeps", {
  wait: 120,
  remember: 6,
  inputs: () => {
    const { material, data_origin } = state.study;
    return sourceKey(material) ? { study: { material, data_origin } } : null;
  },
});
const isMeasured = () => MEASURED.includes(sweeps.result?.source ?? sourceKey(state.get("material")));

/** Each file as it was read. */
const Files = view(({ of }) => {
  const { files, tables } = of;
  const title = files?.length === 1 ? "The file" : `${files?.length} files`;
  return html`
    ${
      tables.files &&
      html`<${Folded} title=${title} open=${files.length <= 3}>
        <div class="words"><${Table} of=${of} ...${tables.files} /></div>
      <//>`
    }
    ${tables.flagged && html`<${Folded} title="Flagged readings"><${Table} of=${of} ...${tables.flagged} /><//>`}
  `;
});

export default view(() => {
  const of = sweeps.error ? null : sweeps.result;
  const said = failed.value?.message ?? (sweeps.error && explain(sweeps.error, "sweeps"));
  // a material without measured moduli has those of its spectrum
  const drawn = [of, of && !isMeasured() ? shownRubber() : null];
  return html`
    <div class="columns">
      <div>
        <${Source} result=${of} error=${sweeps.error} />
        <div class="row" hidden=${!of}>
          <${Button} kind="main" onClick=${() => goTo("shift")}>Shift the isotherms<//>
        </div>
      </div>
      <div>
        <${Card} title="Recognised data">
          <div class="waiting"><${Progress} job=${sweeps} label="Reading" cancels=${false} /></div>
          <${Numbers} of=${of} />
          <${Notes} kind="error" aria-live="assertive" list=${[said]} />
          <${Notes} of=${of} list=${of ? [...(of.about ?? []), ...of.notes] : []} />
          ${of && html`<${Files} of=${of} />`}
        <//>
        <${Amplitude} />
      </div>
    </div>
    <div class="grid thirds">
      ${FIGURES.map((id) => {
        const one = drawn.find((result) => result?.figures[id]);
        return one && html`<div class="card" key=${id}><${Figure} id=${id} of=${one} /></div>`;
      })}
    </div>
  `;
});

sweeps.done = (result) => {
  announce(result.source === "dma" ? `${result.isotherms.length} isotherms read.` : "Material read.");
  followRange(page, result);
};
for (const job of [sweeps, amplitude]) job.start();
watch(
  () => sourceKey(state.get("material")),
  (source) => source && state.setView("sweeps.source", source),
);
// a rubber without sweeps has its moduli at the reference to show
effect(() => void (isMeasured() || rubber.start()));

/** A reference and temperatures outside the isotherms, which the user never chose, give way to those that they have. */
function followRange({ start }, result) {
  const curves = result.ramps ?? (result.isotherms.length ? result.isotherms : result.steps?.curves) ?? [];
  if (curves.length === 0) return;
  const all = curves.flatMap((one) => one.temperature);
  const inside = (kelvin) => kelvin !== null && Math.min(...all) <= kelvin && kelvin <= Math.max(...all);
  const nearest = worded(result.reference);
  const given = state.get("material.reference_temperature");
  const first = start.study.conditions?.temperature;
  const temperatures = state.get("conditions.temperature");
  const changes = {};
  if (given === undefined || (given === FIRST_REFERENCE && !inside(303.15)))
    changes["material.reference_temperature"] = nearest;
  if (Array.isArray(first) && JSON.stringify(temperatures) === JSON.stringify(first)) {
    const kept = first.filter((one) => inside(units.parse(one, "temperature")));
    if (kept.length < first.length) changes["conditions.temperature"] = kept.length ? kept : [nearest];
  }
  if (Object.keys(changes).length) state.change(changes);
}
