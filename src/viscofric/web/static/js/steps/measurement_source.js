// Measured friction: its files, what was recognised in them and how they are separated; and what follows from it shares.

import { downloadUrl, uploadFiles, useExample } from "../api.js";
import { Columns } from "../columns_form.js";
import { Form } from "../fields.js";
import { Job } from "../jobs.js";
import { announce, attempts, explain, page } from "../page.js";
import { html, view } from "../reactive.js";
import { state } from "../state.js";
import { Button, Card, Checks, Drop, Folded, Notes, Progress, shown } from "../views.js";

/** What was read and separated; its result names the table of the study that it is of. */
export const measured = new Job("measured", {
  wait: 400,
  asked: (result, asked) => ({ study: { ...asked.study, measurement: result.table } }),
  inputs: () => (state.get("measurement") ? { study: state.study } : null),
});

/** What stands in an empty figure: these words, or that the files that were dropped have no friction to draw yet. */
export const emptyOf = (words) =>
  measured.shown?.refusal ? "The friction of these files cannot be separated yet: see Measured friction." : words;

/** Whether friction is looked at alone, without the page's material. */
export const alone = () => state.view("friction.beside", "rubber") === "nothing";

/** A job of measured friction; `options` gives those of the page, or null where nothing is to be computed. */
export const ofMeasured = (kind, options, about) =>
  new Job(kind, {
    wait: 400,
    when: () => state.step === "measurement",
    inputs: () => {
      const given = !measured.error && measured.current?.curves ? options() : null;
      return given && { study: state.study, options: given };
    },
    ...about,
  });

/** The prediction for what was measured. */
export const agreement = ofMeasured("agreement", () => (alone() ? null : {}), { remember: 4 });

/** Progress and errors of a job. */
export const Run = view(({ job, label }) => {
  const list = job.error ? [explain(job.error, "measurement")] : []; // it may begin with the name of a file
  return html`<${Progress} job=${job} label=${label} /><${Notes} kind="error" aria-live="assertive" list=${list} />`;
});

/** Names and values as a list of definitions. */
export const Facts = view(
  ({ of, list = [] }) =>
    list.length > 0 &&
    html`<dl ...${shown(of, "facts")}>${list.map(({ name, value }) => html`<dt>${name}</dt><dd>${value}</dd>`)}</dl>`,
);

const KINDS =
  "Exports of an MTM or ETM, tables of readings, or a table of friction curves; together they make one test.";
let dropped = null; // names of the files that were brought last
const [attempt, unread] = attempts();

/** Read files that are brought. */
const take = (bring) =>
  attempt(async () => {
    dropped = await bring();
    await measured.run({ study: state.study, options: { files: dropped } });
  });

function takeColumns(named) {
  const { curves, ...before } = state.get("measurement") ?? {};
  const files = dropped?.length === 1 ? dropped[0] : dropped;
  // a table of friction curves asks for other columns than one of readings
  const ofCurves = measured.error?.values?.offered?.some(([quantity]) => quantity === "viscoelastic friction");
  const table = ofCurves || (!files && curves) ? { curves: files ?? curves } : { ...before, mtm: files ?? before.mtm };
  state.set("measurement", { ...table, columns: named });
}

const example = () => take(() => useExample().then(() => ["mtm.csv"]));
const refusalOf = (result) => result?.refusal && `The friction cannot be separated: ${result.refusal}`;
measured.done = (result) => {
  dropped = null;
  const origin = result.synthetic ? { data_origin: "synthetic" } : {};
  state.change({ measurement: result.table, ...origin });
  const said = result.curves && `${result.points} points of friction at ${result.curves.length} temperatures.`;
  announce(said ?? refusalOf(result));
};

/** The view of the measurement's files, with its fields. */
export const Source = view(() => {
  const of = measured.shown;
  const table = state.get("measurement");
  const { notes = [], steps = [], download } = of ?? {};
  const about = "More: zero, Coulomb friction, steps, outliers";
  return html`<${Card} title="Measured friction">
    <${Drop} label="Drop the files of a traction test" accept=".txt,.csv,.tsv,.dat,.xlsx,.xls,.mtmd,.etmd" help=${KINDS}
      onFiles=${(files) => take(() => uploadFiles(files))} />
    <div class="row">
      <${Button} kind="small" onClick=${example}>Use the synthetic example<//>
      ${download && html`<a class="button small" download="friction_curves.csv" href=${downloadUrl(download)}>Friction curves (CSV)</a>`}
      ${table && html`<${Button} kind="quiet small" symbol="close" onClick=${() => state.set("measurement", undefined)}>Remove the measurement<//>`}
    </div>
    <${Run} job=${measured} label="Reading and separating" />
    <${Notes} kind="error" list=${[unread.value?.message]} />
    <${Columns} values=${measured.error?.values} chosen=${state.get("measurement.columns")} choose=${takeColumns} />
    <${Notes} of=${of} kind="error" list=${[refusalOf(of)]} />
    ${of?.synthetic && html`<span class="badge">synthetic data</span>`}
    <${Facts} of=${of} list=${of ? [...of.recognised, ...(of.lines ?? [])] : []} />
    <${Checks} of=${of} list=${of?.checks} />
    <${Folded} title="Notes on the data (${notes.length})" hidden=${notes.length === 0}><${Notes} of=${of} list=${notes} /><//>
    <${Folded} title="Steps of the test" hidden=${steps.length === 0}>
      <ul ...${shown(of, "help steps-of-test")}>${steps.map(({ text }) => html`<li>${text}</li>`)}</ul>
    <//>
    <${Folded} title=${about} open=${of?.refusal ? true : undefined} hidden=${of ? !of.runs : !table?.mtm}><${Form} of=${page.start.forms.separation} /><//>
  <//>`;
});
