// The form of the rubber's source: its kind, its files, and what these leave to the user.

import { Columns } from "../columns_form.js";
import { Form } from "../fields.js";
import { page, sourceKey, sources } from "../page.js";
import { html, view } from "../reactive.js";
import { state } from "../state.js";
import { Button, Card, Drop, Notes, Radios } from "../views.js";
import { TESTS, named } from "./made.js";
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
  const use = (event) => {
    event.preventDefault();
    const ticked = new FormData(event.target).getAll("specimen");
    if (ticked.length) source.use(source.filesOf("dma").filter((one) => ticked.includes(one) || !files.includes(one)));
  };
  return html`<form class="panel questions" onSubmit=${use} role="group" aria-labelledby="specimens-label">
    <span class="field-label" id="specimens-label">Which files are of the specimen?</span>
    <p class="help">
      At ${named(temperature)} the moduli of these files differ by up to ${(100 * difference).toPrecision(2)}\u00a0%, as those of
      different specimens do. Until you choose, they are averaged.
    </p>
    ${files.map(
      (name, at) => html`<label class="row" key=${name}>
        <input type="checkbox" name="specimen" value=${name} defaultChecked=${at === 0} />${name}
      </label>`,
    )}
    <div class="row">
      <button class="button main">Use the ticked files</button>
      <${Button} kind="small" onClick=${() => state.edit("sweeps.averaged", String(files))}>Average all<//>
    </div>
  </form>`;
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

/** The form; `result` and `error` are those of reading what the material has. */
export const Source = view(({ result, error }) => {
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
    <${PANELS[shown] ?? Tests} key=${PANELS[shown] ? shown : "tests"} />
    ${asks && html`<${Form} of=${page.start.forms.making} />`}
  <//>`;
});
