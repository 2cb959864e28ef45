// The rubber behind measured friction: what fixes its level, the computation, and its result.

import { Figure } from "../figures.js";
import { downloadUrl, uploadFiles } from "../api.js";
import { announce } from "../page.js";
import { html, view } from "../reactive.js";
import { state } from "../state.js";
import * as units from "../units.js";
import { Box, Button, Card, Choice, Notes, Table, choice } from "../views.js";
import { master } from "./measurement_master.js";
import { Run, alone, ofMeasured, shownMeasured } from "./measurement_parts.js";

/** Fields of an anchor of each kind. */
const ANCHOR_FIELDS = {
  nothing: [],
  rubber: ["frequency", "temperature"],
  modulus: ["modulus", "frequency", "temperature", "error"],
  indentation: ["size", "speed", "load", "temperature", "error"],
  contact_area: ["size", "speed", "load", "temperature", "error"],
  half_width: ["size", "speed", "load", "temperature", "error"],
};

/** Shift factors of friction where they can be found, else of the page's material, until the user chooses. */
const suggested = () => (master.current?.refusal && master.current.by_rubber ? "rubber" : "friction");

const shift = choice(
  "identify.shift",
  [
    ["friction", "found from friction"],
    ["rubber", "of the page's material"],
  ],
  suggested,
);
const anchor = choice("identify.anchor", [
  ["rubber", "|E| of the page's material at one frequency"],
  ["modulus", "a known modulus"],
  ["indentation", "indentation of the ball"],
  ["contact_area", "contact area"],
  ["half_width", "contact half-width"],
  ["nothing", "none: magnitude not identified"],
]);
const BOXES = {
  modulus: { label: "Modulus |E|", kind: "modulus", placeholder: "8 MPa" },
  frequency: { label: "Anchor frequency", kind: "frequency", placeholder: "1 Hz" },
  size: { label: "Measured size", placeholder: "0.8 mm, or 12 mm^2" },
  speed: { label: "Anchor speed", kind: "speed", placeholder: "100 mm/s" },
  load: { label: "Anchor load", kind: "load", placeholder: "25 N" },
  temperature: { label: "Anchor temperature", kind: "temperature" },
  error: { label: "Relative standard error", placeholder: "0.01" },
};

/** The temperature of the anchor where none was typed. */
function middle() {
  const isotherms = shownMeasured()?.curves ?? [];
  const kelvin = isotherms[Math.floor(isotherms.length / 2)]?.temperature;
  return kelvin ? units.show(kelvin, "temperature") : "30 °C";
}

/** The options of the job; the placeholders of frequency and temperature count where nothing was typed. */
function options() {
  const of = anchor.value();
  const chosen = { shift: shift.value(), beside: !alone() };
  if (of === "nothing") return chosen;
  const typed = (name) => units.typed(state.view(`identify.${name}`, ""), BOXES[name].kind) || undefined;
  const given = Object.fromEntries(ANCHOR_FIELDS[of].map((name) => [name, typed(name)]));
  given.temperature ??= units.typed(middle(), "temperature");
  if (of === "rubber") given.frequency ??= "1 Hz";
  if (given.error !== undefined) given.error = Number(given.error);
  return { ...chosen, anchor: { of, ...given } };
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
    <div class="form">
      <${Choice} of=${shift} label="Shift factors" />
      <${Choice} of=${anchor} label="Anchor (fixes the magnitude of the modulus)"
        help="Friction determines the shape of E(ω) but hardly its magnitude." />
      ${Object.entries(BOXES).map(
        ([name, { label, placeholder = middle() }]) =>
          html`<${Box} name="identify.${name}" label=${label} placeholder=${placeholder}
            hidden=${!ANCHOR_FIELDS[anchor.value()].includes(name)} />`,
      )}
    </div>
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
