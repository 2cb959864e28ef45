// Step 1: where the rubber comes from, with what its files leave to the user; what they were taken for, hold, and flagged.

import { Columns } from "../columns_form.js";
import { Field, Form } from "../fields.js";
import { Figures } from "../figures.js";
import { Job } from "../jobs.js";
import { announce, explain, goTo, page, sourceKey, sources } from "../page.js";
import { effect, html, view, watch } from "../reactive.js";
import { state } from "../state.js";
import * as units from "../units.js";
import { Button, Card, Drop, Folded, Notes, Numbers, Progress, Radios, Table } from "../views.js";
import { Amplitude, amplitude } from "./amplitude.js";
import { FIRST_REFERENCE, TESTS, emptyOf, named, rubber, worded } from "./source.js";
import * as source from "./source.js";

const READY = ["catalogue", "file"]; // sources that leave nothing to say
/** What the files leave to the user; one question at a time after an error. */
const Questions = view(({ result, error }) => {
  const { questions } = page.start.forms;
  const key = (path) => path.replace("material.", "");
  const open = questions.filter(
    ({ path }) => path === error?.field || state.get(path) !== undefined || result?.left_open?.includes(key(path)),
  );
  const sheets = error?.values?.sheets; // of several specimens, or copies
  const choice = { as: "choice", otherwise: null, options: [[null, "– please select –"], ...(sheets ?? [])] };
  const asking = (one) => (sheets && one.path === "material.sheet" ? { ...one, ...choice } : one);
  const asked = questions.some(({ path }) => path === error?.field);
  return html`
    ${open.length > 0 && html`<div class="panel questions"><${Form} of=${open.map(asking)} /></div>`}
    <${Columns} values=${asked ? null : error?.values} chosen=${state.get("material.columns")}
      choose=${(columns) => state.set("material.columns", columns)} />
  `;
});

/** Files that differ where they should agree, perhaps specimens of one material: which are used, or all of them averaged. */
const Specimens = view(({ of }) => {
  const { files, difference, temperature } = of?.specimens ?? { files: [] };
  if (files.length === 0 || state.view("sweeps.averaged") === String(files)) return null;
  const first = files.slice(0, 1);
  const ticked = files.filter((one) => state.view("sweeps.specimens", first).includes(one));
  const use = () => source.use(source.filesOf("dma").filter((one) => ticked.includes(one) || !files.includes(one)));
  const help = `At ${named(temperature)} the moduli of these files differ by up to ${(100 * difference).toPrecision(2)}\u00a0%, as
    those of different specimens do. Until you choose, they are averaged.`;
  return html`<div class="panel questions" role="group" aria-label="Which files are of the specimen?">
    <${Field} path="@sweeps.specimens" as="ticks" label="Files of the specimen" otherwise=${first} help=${help}
      options=${files.map((name) => [name, name])} />
    <div class="row">
      <${Button} kind="main" disabled=${ticked.length === 0} onClick=${use}>Use the ticked files<//>
      <${Button} kind="small" onClick=${() => state.edit("sweeps.averaged", String(files))}>Average all<//>
    </div>
  </div>`;
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
  return html`
    <${Drop} label="Drop tests here, or choose files" onFiles=${source.takeTests}
      help="Frequency sweeps, temperature ramps, creep or relaxation tests, amplitude sweeps: exports of TA, Netzsch, Mettler-Toledo, Anton Paar and others, workbooks, delimited text; recognised by content." />
    <${Files} of=${TESTS} />
    <details hidden=${!some}>
      <summary>Add files of the same specimen</summary>
      <${Drop} label="Add files" onFiles=${source.addTests} />
    </details>
    <${Button} kind="quiet" onClick=${source.useExample}>Use the synthetic example's sweeps<//>
  `;
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
  return html`<${Radios} name="material-catalogue" aria-label="Materials of the catalogue"
    value=${state.get("material.catalogue")} options=${catalogue.map(told)} onChange=${take} />`;
});

const PANELS = {
  master_curve: () => html`
    <${Drop} label="Drop a master curve" multiple=${false} onFiles=${(files) => source.takeFile("master_curve", files)}
      help="Moduli against reduced frequency: delimited text, a workbook or a .tts file of RepTate." />
    <${Drop} label="Drop its shift factors" multiple=${false} onFiles=${source.takeFactors}
      help="A table of temperature and α; without it the curve is valid at its reference temperature only." />
    <${Files} of=${["master_curve", "shift_factors"]} />
  `,
  file: () => html`
    <${Drop} label="Drop a material file" multiple=${false} onFiles=${(files) => source.takeFile("file", files)}
      help="rubber.json, or a card of Abaqus, ANSYS, LS-DYNA or COMSOL." />
    <${Files} of=${["file"]} />
  `,
  catalogue: Catalogue,
};

/** The form; `result` and `error` are those of reading what the material has. */
const Source = view(({ result, error }) => {
  const rubbers = [state.get("material") ?? {}].flat();
  const name = rubbers[0].name ? `, ${rubbers[0].name}` : "";
  const several =
    rubbers.length > 1 &&
    `This study has ${rubbers.length} materials. Steps 1 to 3 show the first${name}; friction is predicted for all.`;
  const shown = source.shownSource();
  const asks = !READY.includes(shown) && sourceKey(state.get("material")) === shown;
  return html`<${Card} title="Material">
    ${several && html`<${Notes} list=${[several]} />`}
    <${Radios} name="material-source" aria-labelledby="material-source-label" value=${shown} options=${sources()}
      onChange=${(key) => state.setView("sweeps.source", key)}>
      <span class="field-label" id="material-source-label">Source of the material</span>
    <//>
    ${asks && html`<${Questions} result=${result} error=${error} /><${Specimens} of=${result} />`}
    <div class="panel"><${PANELS[shown] ?? Tests} key=${PANELS[shown] ? shown : "tests"} /></div>
    ${asks && html`<${Form} of=${page.start.forms.making} />`}
  <//>`;
});

const MEASURED = ["dma", "ramps"]; // sources whose moduli are shown as measured
const NOTHING = "Nothing is read yet. Drop the files of your tests, or choose a material of the catalogue.";
const MODULI = [
  ["isotherms-storage-modulus", "Storage modulus"],
  ["isotherms-loss-modulus", "Loss modulus"],
];
const FIGURES = ["step-tests", ...MODULI, "isotherms-loss-tangent"];

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
const ReadFiles = view(({ of }) => {
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
  const of = sweeps.shown;
  const said = source.failed.value?.message ?? (sweeps.error && explain(sweeps.error, "sweeps"));
  // a material without measured moduli has those of its spectrum
  const drawn = [of, of && !isMeasured() ? rubber.shown : null];
  return html`
    <div class="columns">
      <div>
        <${Source} result=${of} error=${sweeps.error} />
        <div class="row" hidden=${!of}>
          <${Button} kind="main" onClick=${() => goTo(isMeasured() ? "shift" : "contact")}>
            ${isMeasured() ? "Shift the isotherms" : "Predict friction"}
          <//>
        </div>
      </div>
      <div>
        <${Card} title="Recognised data">
          <div class="waiting"><${Progress} job=${sweeps} label="Reading" cancels=${false} /></div>
          <${Numbers} of=${of} />
          <${Notes} kind="error" aria-live="assertive" list=${[said]} />
          <${Notes} of=${of} list=${of ? [...(of.about ?? []), ...of.notes] : [!said && NOTHING]} />
          ${of && html`<${ReadFiles} of=${of} />`}
        <//>
        <${Amplitude} />
      </div>
    </div>
    <div class="grid thirds">
      <${Figures} ids=${FIGURES} of=${drawn}
        empty=${emptyOf("Drop DMA sweeps above, or choose a material of the catalogue.", sweeps)} />
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
function followRange({ start }, { range, reference }) {
  if (!range) return;
  const inside = (kelvin) => kelvin !== null && range[0] <= kelvin && kelvin <= range[1];
  const nearest = worded(reference);
  const given = state.get("material.reference_temperature");
  const first = start.study.conditions?.temperature;
  const temperatures = state.get("conditions.temperature");
  const changes = {};
  if (given === undefined || (given === FIRST_REFERENCE && !inside(303.15)))
    Object.assign(changes, { "material.reference_temperature": nearest, "material.fixed_shift_factors": undefined });
  if (Array.isArray(first) && JSON.stringify(temperatures) === JSON.stringify(first)) {
    const kept = first.filter((one) => inside(units.parse(one, "temperature")));
    if (kept.length < first.length) changes["conditions.temperature"] = kept.length ? kept : [nearest];
  }
  if (Object.keys(changes).length) state.change(changes);
}
