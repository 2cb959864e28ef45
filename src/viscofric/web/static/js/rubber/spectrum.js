// Step 3: the spectrum, E'(ω) and E''(ω) at any temperature with their bands, and what the fit leaves unexplained.

import { Form } from "../fields.js";
import { Figure, Figures } from "../figures.js";
import { Job } from "../jobs.js";
import { explain, page } from "../page.js";
import { html, signal, view } from "../reactive.js";
import * as units from "../units.js";
import { Button, Card, Notes, Numbers, Pick, Progress, Table } from "../views.js";
import { emptyOf, isMade, rubber, worded } from "./source.js";

const chosen = signal(null); // temperature that the modulus is shown at, K; null is the reference
const moduli = new Job("moduli", {
  remember: 6,
  follows: true,
  when: () => Boolean(rubber.current),
  inputs: () => {
    const { shift, spectrum } = rubber.result ?? {};
    const ends = shift?.material.ends;
    if (!shift || chosen.value === null || Math.abs(chosen.value - spectrum.reference) < 0.005) return null;
    if (chosen.value < ends[0] || chosen.value > ends[1]) return null;
    const options = { temperature: worded(chosen.value), bands: rubber.complete };
    return { study: rubber.inputs.value.study, options };
  },
});

const EMPTY = "Modes are fitted to the master curve. Choose a material, or add DMA sweeps, in step 1, Data.";
const KINDS = [
  ["retardation", "Retardation C(τ)"],
  ["relaxation", "Relaxation E(τ)"],
];
const kind = signal("retardation");

/** The figures of a material; the moduli are those at the chosen temperature. */
const Modulus = view(({ of }) => html`<${Card} title="Modulus against frequency">
  ${of?.shift && html`<${Temperature} of=${of} />`}
  <${Figure} id="modulus" title="E′ and E″" height=${430} of=${of && (moduli.result ?? of)} empty=${emptyOf(EMPTY)} />
<//>`);

const Others = view(({ of }) => {
  const { figures = {}, tables = {} } = of ?? {};
  return html`
    <${Figures} of=${[of && moduli.result, of]} ids=${[["loss-tangent", "tan δ"], "spectrum-residuals"]} empty=${emptyOf(EMPTY)} />
    <${Card} title="Spectrum">
      <${Pick} label="Spectrum" options=${KINDS} value=${kind.value} onChange=${(one) => (kind.value = one)} />
      <${Figure} id="modes" title="Modes" of=${of} spec=${figures[`modes-${kind.value}`]} empty=${emptyOf(EMPTY)} />
      ${tables.modes && html`<details><summary>Table of modes</summary><${Table} of=${of} ...${tables.modes} /></details>`}
    <//>
  `;
});

/** Slider and box of the temperature that E(ω) is shown at. */
const Temperature = view(({ of: { shift, spectrum } }) => {
  const ends = shift.material.ends;
  const inside = chosen.value !== null && chosen.value >= ends[0] && chosen.value <= ends[1];
  const kelvin = inside ? chosen.value : spectrum.reference;
  const doubt = moduli.result?.extrapolated ? "The shift factor is extrapolated at this temperature." : "";
  return html`<div class="field">
    <label class="field-label" for="modulus-temperature">Temperature</label>
    <div class="slider-row">
      <input type="range" id="modulus-temperature" step="1" min=${273.15 + Math.ceil(ends[0] - 273.15)}
        max=${273.15 + Math.floor(ends[1] - 273.15)} value=${kelvin}
        onInput=${({ target }) => (chosen.value = Number(target.value))} />
      <output for="modulus-temperature" class="field-label">${units.show(kelvin, "temperature")}</output>
      <${Button} kind="small" onClick=${() => (chosen.value = null)}>At the reference<//>
    </div>
    <p class=${moduli.error ? "help field-error" : "help"} aria-live="polite">${moduli.error?.message ?? doubt}</p>
  </div>`;
});

/** The misfit beside the number of modes. */
function misfit() {
  const { rms_storage: storage, rms_loss: loss } = rubber.shown?.spectrum.fit ?? {};
  return storage ? `Misfit of E′, E″: ${storage.toFixed(3)}, ${loss.toFixed(3)} decades (rms).` : "";
}

const Settings = view(() => {
  const fields = page.start.forms.spectrum.map((one) =>
    one.path === "material.modes" ? { ...one, help: misfit() } : one,
  );
  if (!isMade())
    return html`<${Card} title="Spectrum"><p class="help">A predefined material has its own spectrum.</p><//>`;
  return html`<${Card} title="Spectrum"><${Form} of=${fields} /><//>`;
});

for (const job of [rubber, moduli]) job.start();
const ended = () => (rubber.result?.no_band ? `No 95 % band: ${rubber.result.no_band}.` : "");

export default view(() => {
  const of = rubber.shown;
  const { fit, notes } = of?.spectrum ?? {};
  return html`
    <p>Modes fitted to the master curve, and the resulting E′ and E″ at any temperature within the shift factors.</p>
    <div class="waiting"><${Progress} job=${rubber} label="Fitting the material" cancels=${false} ended=${ended} /></div>
    <${Notes} kind="error" list=${[rubber.error && explain(rubber.error, "spectrum")]} />
    <${Numbers} of=${of} />
    <${Notes} of=${of} kind="warning" list=${of ? [...(fit?.notes ?? []), ...notes, ...(of.band?.notes ?? [])] : []} />
    <div class="columns">
      <div><${Settings} /></div>
      <div><${Modulus} of=${of} /></div>
    </div>
    <div class="grid thirds"><${Others} of=${of} /></div>
  `;
});
