// The amplitude sweep of the material: Kraus's law, the linear range, and the strain that the moduli are scaled to.

import { Form } from "../fields.js";
import { Figure } from "../figures.js";
import { Job } from "../jobs.js";
import { explain, page } from "../page.js";
import { html, view } from "../reactive.js";
import { state } from "../state.js";
import * as units from "../units.js";
import { Button, Card, Notes } from "../views.js";

export const amplitude = new Job("amplitude", {
  wait: 0,
  remember: 2,
  inputs: () => {
    const [material] = [state.get("material") ?? {}].flat();
    // the law is that of the sweep, whatever strain the moduli are scaled to
    if (material.amplitude_sweep === undefined) return null;
    return { study: { material: { ...material, strain: undefined }, data_origin: state.get("data_origin") } };
  },
});
const atContact = new Job("amplitude", {
  name: "amplitude-contact",
  inputs: () =>
    amplitude.inputs.value && {
      study: { ...state.study, ...amplitude.inputs.value.study },
      options: { contact: true },
    },
  done: ({ contact: { strain } }) => state.set("material.strain", Number(strain.toPrecision(2))),
});

const KEYS = ["amplitude_sweep", "strain", "measured_at"].map((key) => `material.${key}`);
const remove = () => state.change(Object.fromEntries(KEYS.map((key) => [key, undefined])));

/** The card; nothing without an amplitude sweep. */
export const Amplitude = view(() => {
  if (state.get("material.amplitude_sweep") === undefined) return null;
  const of = amplitude.result;
  const error = amplitude.error ?? atContact.error;
  const found = atContact.current?.contact;
  return html`<${Card} title="Amplitude sweep">
    <${Notes} kind="error" list=${[error && explain(error, "amplitude")]} />
    <${Notes} of=${of} list=${of ? [of.words, ...of.linear, ...of.notes] : []} />
    <${Figure} id="amplitude-sweep" title="Amplitude sweep" of=${of} />
    <${Form} of=${page.start.forms.amplitude} />
    <p class="help" aria-live="polite">${atContact.progress ? "Solving the contact" : units.filled(found?.words)}</p>
    <div class="row">
      <${Button} onClick=${() => atContact.run()}>Use the strain of the contact<//>
      <${Button} kind="quiet small" onClick=${remove}>Remove the amplitude sweep<//>
    </div>
  <//>`;
});
