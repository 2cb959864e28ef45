// The rubber behind measured friction: what fixes its level, the computation, and its result.

import { downloadUrl, uploadFiles } from "../api.js";
import { Form, given } from "../fields.js";
import { Figure } from "../figures.js";
import { announce, page } from "../page.js";
import { html, view } from "../reactive.js";
import { state } from "../state.js";
import * as units from "../units.js";
import { Button, Card, Notes, Table } from "../views.js";
import { master } from "./measurement_master.js";
import { Run, alone, ofMeasured, shownMeasured } from "./measurement_parts.js";

/** Shift factors of friction where they can be found, else of the page's material, until the user chooses. */
const suggested = () => (master.current?.refusal && master.current.by_rubber ? "rubber" : "friction");

/** The temperature of the anchor where none was typed. */
function middle() {
  const isotherms = shownMeasured()?.curves ?? [];
  const kelvin = isotherms[Math.floor(isotherms.length / 2)]?.temperature;
  return kelvin ? units.show(kelvin, "temperature") : "30 °C";
}

/** The fields; the placeholder of the temperature counts where nothing was typed. */
function fields() {
  const own = {
    "@identify.shift": { otherwise: suggested() },
    "@identify.temperature": { placeholder: middle(), otherwise: units.typed(middle(), "temperature") },
  };
  return page.start.forms.identify.map((one) => ({ ...one, ...own[one.path] }));
}

function options() {
  const { shift, anchor: of, ...about } = given(fields());
  return { shift, beside: !alone(), anchor: of === "nothing" ? undefined : { of, ...about } };
}

const identify = ofMeasured("identify", options, { manual: true });

/** Make the identified rubber that of the page. */
async function take({ download }) {
  const response = await fetch(downloadUrl(download));
  const [name] = await uploadFiles([new File([await response.blob()], download)]);
  state.set("material", { file: name });
  announce("The page now uses the identified material.");
}

/** The card of the identification. */
export const Identification = view(() => {
  const of = identify.error ? null : identify.result;
  identify.done = ({ sentences: [first] }) => announce(`The material is identified. ${first}`);
  // which factors to use is not known before
  const known = master.current || master.error || master.ended;
  return html`<${Card} title="Material identified from friction" hidden=${!shownMeasured()?.curves}>
    <${Form} of=${fields()} />
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
