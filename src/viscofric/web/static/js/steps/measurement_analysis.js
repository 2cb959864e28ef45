// What follows from measured friction: all temperatures on one curve, by the rubber's shift factors and by those found from
// friction itself; and the rubber behind it, with what fixes its level.

import { downloadUrl, uploadFiles } from "../api.js";
import { Form, given } from "../fields.js";
import { Figure } from "../figures.js";
import { announce, page } from "../page.js";
import { html, view } from "../reactive.js";
import { state } from "../state.js";
import * as units from "../units.js";
import { Button, Card, Notes, Table } from "../views.js";
import { Facts, Run, agreement, alone, emptyOf, measured, ofMeasured } from "./measurement_source.js";

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
  const of = master.shown;
  const { found, by_rubber: byRubber, refusal, notes = [] } = of ?? {};
  const drawn = found && (!byRubber || given(fields).shifted === "found") ? "found" : "by_rubber";
  const there = Boolean(measured.shown?.curves);
  const offered = { "@friction.beside": there, "@friction.shifted": found && byRubber, "@friction.law": found };
  const refused = refusal && `Shift factors cannot be determined from friction alone: ${refusal}`;
  return html`<${Card} title="Friction master curve">
    <${Form} of=${fields.filter(({ path }) => offered[path])} />
    <${Run} job=${master} label="Shifting" />
    <div class="grid">
      <${Figure} id="friction-master-curve" title="Friction at one temperature" height=${340} of=${of}
        spec=${specOf(of, drawn)} empty=${emptyOf("Drop a traction test above: its temperatures are shifted onto one curve here.")} />
      <${Figure} id="friction-shift-factors" title="Shift factors" height=${340} of=${of}
        empty=${emptyOf("Friction determines shift factors: drop a traction test at two temperatures or more.")} />
    </div>
    <${Notes} of=${of} list=${[refused, ...notes]} />
    <${Facts} of=${of} list=${found?.words ?? byRubber?.words} />
    <div class="row">
      ${found && html`<a class="button small" download="shift_factors_from_friction.csv" href=${downloadUrl(found.download)}>Shift factors (CSV)</a>`}
    </div>
  <//>`;
});

/** Shift factors of friction where they can be found, else of the page's material, until the user chooses. */
const suggested = () => (master.current?.refusal && master.current.by_rubber ? "rubber" : "friction");

/** The temperature of the anchor where none was typed. */
function middle() {
  const isotherms = measured.shown?.curves ?? [];
  const kelvin = isotherms[Math.floor(isotherms.length / 2)]?.temperature;
  return kelvin ? units.show(kelvin, "temperature") : "30 °C";
}

/** The fields; the placeholder of the temperature counts where nothing was typed. */
function anchorFields() {
  const own = {
    "@identify.shift": { otherwise: suggested() },
    "@identify.temperature": { placeholder: middle(), otherwise: units.typed(middle(), "temperature") },
  };
  return page.start.forms.identify.map((one) => ({ ...one, ...own[one.path] }));
}

function identifyOptions() {
  const { shift, temperature_error, anchor: of, ...about } = given(anchorFields());
  return { shift, temperature_error, beside: !alone(), anchor: of === "nothing" ? undefined : { of, ...about } };
}

const identify = ofMeasured("identify", identifyOptions, { manual: true });

/** Make the identified rubber that of the page. */
async function take({ download, temperature, from_synthetic }) {
  const response = await fetch(downloadUrl(download));
  const [name] = await uploadFiles([new File([await response.blob()], download)]);
  const given = JSON.stringify(state.get("conditions.temperature"));
  const beyond = temperature && given === JSON.stringify(temperature.given);
  const data_origin = from_synthetic ? "synthetic" : undefined;
  state.change({ material: { file: name }, data_origin, ...(beyond && { "conditions.temperature": temperature.kept }) });
  const where = beyond ? ` Temperatures without its shift factors are left out; the study now has ${temperature.kept.join(", ")}.` : "";
  announce(`The page now uses the identified material.${where}`);
}

/** The card of the identification. */
export const Identification = view(() => {
  const of = identify.shown;
  identify.done = ({ sentences: [first] }) => announce(`The material is identified. ${first}`);
  // which factors to use is not known before
  const known = master.current || master.error || master.ended;
  if (!measured.shown?.curves)
    return html`<${Card} title="Material identified from friction">
      <p class="help">${emptyOf("Drop a traction test above: the modulus is inferred from its friction here.")}</p>
    <//>`;
  return html`<${Card} title="Material identified from friction">
    <${Form} of=${anchorFields()} />
    <div class="row"><${Button} kind="main" disabled=${!known} onClick=${() => identify.run()}>Identify the material<//></div>
    <${Run} job=${identify} label="Identifying" />
    ${of && html`<${Identified} of=${of} />`}
  <//>`;
});

const Identified = view(({ of }) => {
  const { family } = of.tables;
  return html`<div class="step-body">
    <div class="grid">
      <${Figure} id="identified-modulus" height=${380} of=${of} />
      <${Figure} id="identified-friction" height=${380} of=${of} />
    </div>
    <${Notes} of=${of} list=${[units.filled(of.anchored_at), ...of.sentences]} />
    ${family && html`<${Table} of=${of} ...${family} />`}
    <div class="row">
      <a class="button small" download="rubber_from_friction.json" href=${downloadUrl(of.download)}>Material (JSON)</a>
      <${Button} kind="small" onClick=${() => take(of)}>Use this material on the page<//>
    </div>
  </div>`;
});
