// The form of the rubber's source: its kind, its files, and what these leave to the user.

import { Columns } from "../columns_form.js";
import { Amount, Choose, Quantity, Text } from "../fields.js";
import { page } from "../page.js";
import { html, view } from "../reactive.js";
import { state } from "../state.js";
import * as units from "../units.js";
import { Button, Card, Drop, Notes, Radios } from "../views.js";
import { SOURCES, TESTS, sourceOf } from "./made.js";
import * as source from "./source.js";

const READY = ["catalogue", "file"]; // sources that leave nothing to say
const DEFORMATIONS = [
  [null, "– please select –"],
  ["tension", "tension: E′, E″"],
  ["compression", "compression: E′, E″"],
  ["bending", "bending: E′, E″"],
  ["shear", "shear: G′, G″"],
];

/** Temperatures of several files, as people type them. */
function temperatures(text) {
  const all = text.split(/\s*[;,]\s+/).map((part) => units.typed(part.trim(), "temperature"));
  return all.length === 1 ? all[0] : all;
}

// What a file may leave to the user, by the key of [material].
const QUESTIONS = {
  deformation:
    () => html`<${Choose} path="material.deformation" label="Measured in" otherwise=${null} options=${DEFORMATIONS}
    help="Not stated in the file; the moduli differ by a factor of three." />`,
  modulus_unit: () => html`<${Text} path="material.modulus_unit" label="Unit of the moduli" placeholder="MPa"
    help="Not stated in the file." />`,
  temperature: () => html`<${Text} path="material.temperature" label="Temperature of the sweep" read=${temperatures}
    write=${(value) => [value ?? []].flat().join(", ")}
    help="Not stated in the file; of several files one temperature each, in their order: 145 °C, 160 °C." />`,
  assumed_shift: () => html`<${Text} path="material.assumed_shift" label="Assumed shift law" placeholder="250 kJ/mol"
    help="One frequency determines no shift factor. An activation energy (250 kJ/mol), WLF 17.44, 51.6 K, -30 degC (C₁, C₂, their reference), or universal." />`,
  sheet: () =>
    html`<${Text} path="material.sheet" label="Sheet" help="Name of the only sheet of the workbook to read." />`,
};

/** What the files leave to the user; one question at a time after an error. */
const Questions = view(({ result, error }) => {
  const wanted = error?.field?.replace("material.", "");
  const given = (key) => state.get(`material.${key}`) !== undefined;
  const open = Object.keys(QUESTIONS).filter((key) => key === wanted || given(key) || result?.left_open?.includes(key));
  return html`
    ${open.length > 0 && html`<div class="panel questions">${open.map((key) => html`<div key=${key}>${QUESTIONS[key]()}</div>`)}</div>`}
    <${Columns} values=${QUESTIONS[wanted] ? null : error?.values} chosen=${state.get("material.columns")}
      choose=${(columns) => state.set("material.columns", columns)} />
  `;
});

/** The files of some keys of [material], each of which can be removed. */
const Files = view(({ of }) => {
  const row = ([key, name]) => html`<li class="row" key=${`${key} ${name}`}>
    <span>${name}</span>
    <${Button} kind="quiet small" symbol="close" title="Remove ${name}" onClick=${() => source.remove(key, name)}>
      <span class="unseen">Remove ${name}</span>
    <//>
  </li>`;
  return html`<ul class="files">${of.flatMap((key) => source.filesOf(key).map((name) => [key, name])).map(row)}</ul>`;
});

const Tests = view(() => {
  const some = TESTS.some((key) => source.filesOf(key).length > 0);
  return html`<div class="panel">
    <${Drop} label="Drop tests here, or choose files" onFiles=${(files) => source.takeTests(files)}
      help="Frequency sweeps, temperature ramps, creep or relaxation tests, amplitude sweeps: exports of TA, Netzsch, Mettler-Toledo, Anton Paar and others, workbooks, delimited text; recognised by content." />
    <${Files} of=${TESTS} />
    <details hidden=${!some}>
      <summary>Add files of the same specimen</summary>
      <${Drop} label="Add files" onFiles=${source.addTests} />
    </details>
    <${Button} kind="quiet" onClick=${() => source.useExample()}>Use the synthetic example's sweeps<//>
  </div>`;
});

const Catalogue = view(() => {
  const { catalogue } = page.start;
  const told = ({ name, synthetic, description }) => [
    name,
    html`<strong>${name}</strong>${" "}${synthetic && html`<span class="badge small">synthetic</span>`}
      <span class="help">${description}</span>`,
  ];
  const take = (name) => {
    const { synthetic } = catalogue.find((one) => one.name === name);
    source.choose("catalogue", name, { origin: synthetic ? "synthetic" : undefined });
  };
  return html`<div class="panel">
    <${Radios} name="material-catalogue" aria-label="Materials of the catalogue" value=${state.get("material.catalogue")}
      options=${catalogue.map(told)} onChange=${take} />
  </div>`;
});

const PANELS = {
  master_curve: () => html`<div class="panel">
    <${Drop} label="Drop a master curve" multiple=${false} onFiles=${(files) => source.takeFile("master_curve", files)}
      help="Moduli against reduced frequency: delimited text, a workbook or a .tts file of RepTate." />
    <${Drop} label="Drop its shift factors" multiple=${false} onFiles=${source.takeFactors}
      help="A table of temperature and α; without it the curve is valid at its reference temperature only." />
    <${Files} of=${["master_curve", "shift_factors"]} />
  </div>`,
  file: () => html`<div class="panel">
    <${Drop} label="Drop a material file" multiple=${false} onFiles=${(files) => source.takeFile("file", files)}
      help="rubber.json, or a card of Abaqus, ANSYS, LS-DYNA or COMSOL." />
    <${Files} of=${["file"]} />
  </div>`,
  catalogue: Catalogue,
};

const Making = () => html`<div class="form">
  <${Text} path="material.name" label="Name" />
  <${Quantity} path="material.reference_temperature" label="Reference temperature" kind="temperature"
    help="The shift factor is 1 at this temperature." />
  <${Amount} path="material.poisson_ratio" label="Poisson’s ratio" min=${0} max=${0.5} step=${0.01} placeholder="0.5" />
</div>`;

/** The form; `result` and `error` are those of reading what the material has. */
export const Source = view(({ result, error }) => {
  const rubbers = [state.get("material") ?? {}].flat();
  const name = rubbers[0].name ? `, ${rubbers[0].name}` : "";
  const several =
    rubbers.length > 1 &&
    `This study has ${rubbers.length} materials. Steps 1 to 3 show the first${name}; friction is predicted for all.`;
  const shown = source.shownSource();
  const asks = !READY.includes(shown) && sourceOf(state.get("material")) === shown;
  return html`<${Card} title="Material">
    ${several && html`<${Notes} list=${[several]} />`}
    <${Radios} name="material-source" aria-labelledby="material-source-label" value=${shown} options=${SOURCES}
      onChange=${(key) => state.setView("sweeps.source", key)}>
      <span class="field-label" id="material-source-label">Source of the material</span>
    <//>
    ${asks && html`<${Questions} result=${result} error=${error} />`}
    <${PANELS[shown] ?? Tests} key=${PANELS[shown] ? shown : "tests"} />
    ${asks && html`<${Making} />`}
  <//>`;
});
