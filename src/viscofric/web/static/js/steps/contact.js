// Step 4, with which the page opens: what slides, its friction curve, and one contact that follows two sliders.

import { uploadFiles } from "../api.js";
import { Box, Form, Slider } from "../fields.js";
import { Figure } from "../figures.js";
import { FrictionCard, combination, curve } from "../friction_curve.js";
import { Job } from "../jobs.js";
import { attempts, bringSweeps, goTo, page, waits } from "../page.js";
import { computed, html, view } from "../reactive.js";
import { shapeOf, state } from "../state.js";
import * as units from "../units.js";
import { Button, Card, Drop, Notes, Numbers, Table, Term, shown, told } from "../views.js";
import { Published } from "./published.js";

const position = () => state.view("contact.position", {});
const moveTo = (where, keep = state.edit) => keep("contact.position", { ...position(), ...where });
const contact = new Job("contact", {
  drafts: true,
  inputs: () => {
    const { speed, temperature } = position();
    return speed ? { study: state.study, options: { speed, temperature, combination: combination.value } } : null;
  },
});
/** The ends of a quantity of the study, or others where it has none that can be read. */
const endsOf = (name, otherwise) => units.ends(state.get(`conditions.${name}`), name) ?? otherwise;
const rounded = (value, digits) => Number(value.toPrecision(digits));
// they reach a decade, and 15 K, beyond the study
const CONTROLS = {
  speed: {
    label: "Speed",
    ends: () => endsOf("speed", [1e-3, 1]).map((end, at) => end * [0.1, 10][at]),
    rounds: (speed) => rounded(speed, 3),
  },
  temperature: {
    label: "Temperature",
    linear: true,
    ends: () => endsOf("temperature", [303.15, 363.15]).map((end, at) => end + [-15, 15][at]),
    rounds: (kelvin) => rounded(273.15 + Math.round(2 * (kelvin - 273.15)) / 2, 7),
  },
};

let drags = false; // a drag is one step of undo

/** A slider with a number field: both show and change one of the two coordinates. */
const Control = view(({ name }) => {
  const { label, linear, ends, rounds } = CONTROLS[name];
  const value = position()[name];
  const id = `live-${name}`;
  const take = (text = "") => {
    const typed = units.read(text, name);
    if (Number.isFinite(typed) && typed > 0) moveTo({ [name]: typed });
  };
  const move = (to) => {
    moveTo({ [name]: rounds(to) }, drags ? state.setView : state.edit);
    drags = true;
  };
  return html`<div class="field live-control">
    <label for=${id} class="field-label">${label}</label>
    <div class="row">
      <${Slider} id=${id} ends=${ends()} ...${{ linear, value, move }} aria-valuetext=${units.show(value, name)}
        onChange=${() => (drags = false)} />
      <${Box} id="${id}-number" class="live-number" aria-label="${label}, as a number" take=${take}
        value=${() => units.show(position()[name], name)} />
    </div>
  </div>`;
});

const WORDS = { coarse: "solving …", sharp: "refining …" };
const Status = view(() => {
  const ended = contact.current ? (contact.current.stage === "sharp" ? "converged" : "coarse") : "";
  return html`<span class="help live-status" role="status">${WORDS[contact.progress?.label] ?? ended}</span>`;
});

const Failed = view(() => {
  const { error } = contact;
  // a position beyond the rubber is the sliders', no field's
  const beyond = error?.field === "conditions.temperature";
  return html`<${Notes} kind="error" list=${[error && (beyond ? error.message : waits("the contact", error))]} />`;
});

/** The pictures of the contact, or their empty frames, and the numbers that are not the main ones. */
const Pictures = view(({ of }) => {
  const shared = { of, empty: contact.error ? "No contact yet: see the message above." : "Computing the contact." };
  const row = ({ label, value, remark }) => [html`<${Term} label=${label} />`, value, remark];
  return html`<div class="grid contact-figures ${of && !of.map ? "without-map" : ""}">
    ${of?.map !== null && html`<${Figure} id="pressure-map" title="Contact pressure" ...${shared} />`}
    <${Figure} id="pressure-profile" title="Pressure along the motion" ...${shared} />
    <${Figure} id="surface-profile" title="Rubber and indenter" ...${shared} />
    <div class="more-numbers">
      <${Table} of=${of} caption="Results with their numerical errors" head=${["result", "value", "error"]}
        rows=${of?.more_numbers.map(told).map(row) ?? []} />
    </div>
  </div>`;
});

const Found = view(() => {
  const of = contact.result;
  return html`<div ...${shown(of, "live-contact")}>
    <${Numbers} of=${of} />
    <p class="help" hidden=${!of}>± is the numerical error alone. The bands of the curve show the material's uncertainty, where it is known.</p>
    <div class="why-box">
      <h3>Cause of the friction</h3>
      <p ...${shown(of, "why")} aria-live="off">${units.filled(of?.why)}</p>
    </div>
    <${Notes} of=${of} kind="warning" list=${of?.warnings} />
    <${Pictures} of=${of} />
  </div>`;
});

/** What the page is for, what it shows, and where one's own data go; short once they are there. */
const Welcome = view(() => {
  const name = state.get("material.catalogue");
  if (name === undefined || name !== page.start.study.material?.catalogue)
    return html`<div class="intro"><p>Change shape, load, speed or temperature, and the friction is computed again.</p></div>`;
  return html`<div class="intro">
    <section class="welcome" aria-label="What this page does">
      <p>
        <strong>Hysteresis friction (rolling resistance) from DMA data.${" "}</strong>
        Sliding or rolling deforms rubber, and the dissipated energy causes friction. This page computes it from DMA data
        alone. The example is a synthetic material: change shape, load, speed or temperature, and the result updates.
      </p>
      <div class="row">
        <${Button} kind="main" onClick=${bringSweeps}>Use my DMA file<//>
        <${Button} onClick=${() => goTo("measurement")}>Compare with my friction test<//>
        <span class="help">Your files stay on this computer.</span>
      </div>
    </section>
  </div>`;
});

// The form of a contact: shape, load, layer, speeds and temperatures, all of them keys of the study's document.

const POINTS = ["ball", "ellipsoid", "cone"]; // whose loads are forces

const shape = computed(() => shapeOf(state.study));
const left = new Map(); // what the study had of other shapes, as long as the page is open

function become(next) {
  const { indenter, surface, conditions } = state.study;
  const { load, pressure, direction, ...others } = conditions ?? {};
  left.set(shape.value, { indenter, surface, load, pressure });
  const begun = left.get(next) ?? page.start.shapes[next];
  // point contacts share their load; that of a line is per length
  const shares = [shape.value, next].every((one) => POINTS.includes(one));
  const loads = { load: (shares && load) || begun.load, pressure: begun.pressure };
  const kept = Object.fromEntries(Object.entries({ ...others, ...loads }).filter(([, value]) => value !== undefined));
  state.change({ indenter: begun.indenter, surface: begun.surface, conditions: kept });
}

const [attempt, failed] = attempts();
const bring = (files) =>
  attempt(async () => {
    const [name] = await uploadFiles(files.slice(0, 1));
    state.set("surface.file", name);
    return `${name} was uploaded.`;
  });

const ContactForm = view(() => {
  const { shape: shapes, scan, load, conditions, interface: dry, heating } = page.start.forms;
  const [which, ...sizes] = shapes;
  return html`
    <${Card} title="Indenter or surface">
      <${Form} of=${[{ ...which, shown: () => shape.value, onChange: become }, ...sizes]} />
      ${
        shape.value === "scan" &&
        html`<${Drop} label="Drop a height map" help="text matrix, x y z points, or a microscope file" multiple=${false}
            onFiles=${bring} />
          <${Notes} kind="error" list=${[failed.value?.message]} />`
      }
      <${Form} of=${scan} />
      <${Form} of=${load} />
    <//>
    <${Card} title="Speeds and temperatures"><${Form} of=${conditions} /><//>
    <${Card} title="Interface and heat"><${Form} of=${dry} /><${Form} of=${heating} /><//>
  `;
});

// where the sliders begin: what a reload keeps, or the middle of the study
if (!position().speed || !position().temperature) {
  const [[low, high], [cold, warm]] = [CONTROLS.speed.ends(), CONTROLS.temperature.ends()];
  const middle = { speed: rounded(Math.sqrt(low * high), 2), temperature: rounded(0.5 * (cold + warm), 7) };
  moveTo(middle, state.setView);
}
for (const job of [contact, curve]) job.start();

export default () => html`
  <${Welcome} />
  <div class="columns">
    <div><${ContactForm} /></div>
    <div>
      <${FrictionCard} live=${contact} onPick=${moveTo} />
      <${Card} title="One contact, live">
        <div class="live-controls"><${Control} name="speed" /><${Control} name="temperature" /><${Status} /></div>
        <${Failed} />
        <${Found} />
      <//>
    </div>
  </div>
  <${Published} />
`;
