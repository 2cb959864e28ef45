// Motion over time: a history edited as a table or a sketch, or an impact, and the solved contact.

import { Box, Select } from "../fields.js";
import { Figure, save } from "../figures.js";
import { Job } from "../jobs.js";
import { CONTROLS, PATHS, PRESETS, PointTable, Sketch, contactOf, converted, presetRows } from "../motion_history.js";
import { StudyHistory } from "../motion_study.js";
import { announce, explain } from "../page.js";
import { html, signal, view, watch } from "../reactive.js";
import { state } from "../state.js";
import * as units from "../units.js";
import { Button, Card, Notes, Numbers, Progress } from "../views.js";

const IMPACT = {
  mass: ["Mass (kg)", 0.033],
  speed: ["Speed (m/s)", 1],
  gravity: ["Gravity (m/s²)", 0],
  rebounds: ["Contacts to follow", 1],
};
const UNITS = { load: "N", line_load: "N/m", length: "m", pressure: "Pa", speed: "m/s" };

const history = () => state.view("motion");
const optionsOf = ({ rows, control, path, before }) => {
  return { rows: rows.map(([time, value, along]) => ({ time, value, along })), control, path, before };
};
const motion = new Job("motion", {
  manual: true,
  interrupts: true,
  remember: 4,
  inputs: () => {
    const asked = history();
    if (!asked) return null;
    const given = asked.preset === "impact" ? { impact: asked.impact } : optionsOf(asked);
    return { study: state.study, options: { temperature: asked.temperature, ...given } };
  },
});
const refused = signal(null); // what cannot be read: {sentence, text} with the place, {row, at} or {field}

/** Change the history, as a step of undo unless it follows from the study. */
function change(values, keep = state.edit) {
  refused.value = null;
  keep("motion", { temperature: null, ...history(), ...values });
}

/** Begin with an example of the study's contact. */
function begin(preset, keep) {
  const contact = contactOf(state.study);
  const [control] = Object.keys(CONTROLS[contact]);
  const values = Object.fromEntries(Object.entries(IMPACT).map(([key, [, value]]) => [key, value]));
  const rows = presetRows(preset, state.study);
  const impact = history()?.impact ?? values;
  change({ preset, contact, control, path: "speed", before: "untouched", rows, impact }, keep);
}

const columnsOf = ({ contact, control, path }) => [["Time", "time"], CONTROLS[contact][control], PATHS[path]];

function csv() {
  const { rows, control, path, ...about } = history();
  const [, [, along], [, across]] = columnsOf({ control, path, ...about });
  const head = ["time (s)", `${control} (${UNITS[along]})`, `${path} (${UNITS[across]})`];
  return [head, ...rows].map((row) => row.join(",")).join("\n") + "\n";
}

const labelsOf = (entries) => Object.entries(entries).map(([value, text]) => [value, [text].flat()[0]]);

const Line = ({ id, label, children }) =>
  html`<div class="field"><label for="motion-${id}" class="field-label">${label}</label>${children}</div>`;

/** A choice of the history. */
const Pick = ({ id, label, ...rest }) =>
  html`<${Line} id=${id} label=${label}><${Select} id="motion-${id}" ...${rest} /><//>`;

/** One number of the history; other input is refused. */
const Entry = view(({ id, label, kind, value, placeholder, empty = false, onRead }) => {
  const { field, text } = refused.value ?? {};
  const take = (typed) => {
    const found = typed ? units.read(typed, kind) : null;
    if (typed ? Number.isFinite(found) : empty) onRead(found);
    else refused.value = { field: id, text: typed ?? "", sentence: `${label}: enter a number.` };
  };
  const shown = () => (field === id ? text : value === null ? "" : kind === "plain" ? value : units.show(value, kind));
  return html`<${Line} id=${id} label=${label}>
    <${Box} id="motion-${id}" value=${shown} take=${take} placeholder=${placeholder}
      aria-invalid=${field === id ? "true" : undefined} />
  <//>`;
});

const firstTemperature = () => {
  const given = state.get("conditions.temperature");
  return String([given?.from ?? given ?? ""].flat()[0]).replace("degC", "°C");
};

const History = view(() => {
  const now = history();
  const { preset, contact, control, path, rows } = now;
  const hits = preset === "impact";
  const prescribe = (one) => change({ control: one, path: "speed", rows: presetRows(preset, state.study, one) });
  const hit = (name) => (value) => change({ impact: { ...now.impact, [name]: value } });
  return html`<${Card} title="History">
    <${Pick} id="preset" label="Example" options=${labelsOf(PRESETS)} value=${preset} onChange=${(one) => begin(one)} />
    ${
      hits
        ? html`<div class="form">
            ${Object.entries(IMPACT).map(
              ([name, [label]]) =>
                html`<${Entry} key=${name} id=${name} label=${label} kind="plain" value=${now.impact[name]} onRead=${hit(name)} />`,
            )}
          </div>`
        : html`<div class="stack">
            <${Pick} id="control" label="Prescribed" options=${labelsOf(CONTROLS[contact])} value=${control} onChange=${prescribe} />
            <${Pick} id="path" label="Motion given as" options=${labelsOf(PATHS)} value=${path}
              onChange=${(one) => change({ path: one, rows: converted(rows, one) })} />
            <${Pick} id="before" label="Before the first time" options=${["untouched", "at rest", "sliding"]} value=${now.before}
              onChange=${(one) => change({ before: one })} />
            <div class="scroll">
              <${PointTable} rows=${rows} columns=${columnsOf(now)} wrong=${motion.error?.values?.index} refused=${refused.value}
                onChange=${(changed) => change({ rows: changed })} onRefuse=${(one) => (refused.value = one)} />
            </div>
          </div>`
    }
    <${Entry} id="temperature" label="Temperature" kind="temperature" value=${now.temperature} placeholder=${firstTemperature()}
      empty onRead=${(kelvin) => change({ temperature: kelvin })} />
    <p class="help">Material, indenter, layer and accuracy are the first values given in the study.</p>
    <${Button} kind="main" onClick=${() => motion.run()}>Solve<//>
    ${
      !hits &&
      html`<div class="stack">
        <${Button} kind="small" symbol="down" onClick=${() => save("history.csv", csv(), "text/csv")}>Save the history<//>
        <${StudyHistory} rows=${() => optionsOf(history())} take=${change} />
      </div>`
    }
  <//>`;
});

const Drawing = view(() => {
  const now = history();
  if (now.preset === "impact") return null;
  return html`<${Card} title="Sketch of the history">
    <${Sketch} rows=${now.rows} columns=${columnsOf(now)} onChange=${(rows) => change({ rows })} />
    <p class="help">Drag a point, or change its numbers in the table. Two points at the same time are a jump.</p>
  <//>`;
});

// figures before there is a result
const FRAMES = {
  "motion-load": { title: "Load over time" },
  "motion-indentation": { title: "Indentation over time" },
  "motion-contact": { title: "Contact over time" },
};
const reached = ({ time }) => units.show(time.at(-1) - time[0], "time");
const endOf = ({ cancelled }) => {
  if (cancelled) return "Cancelled.";
  return motion.result.interrupted ? `Stopped; the results end after ${reached(motion.result)}.` : "";
};

const Found = view(() => {
  const of = motion.result;
  const sentence = refused.value?.sentence ?? (motion.error && explain(motion.error, "motion"));
  const about = "± is the estimated numerical error; it does not include the grid error of a rough surface.";
  return html`<${Card} title="Contact over time">
    <${Progress} job=${motion} label="Solving" ended=${endOf} />
    <${Notes} kind="error" list=${[sentence]} />
    <${Notes} of=${of} kind="warning" list=${of?.warnings} />
    <${Numbers} of=${of} />
    ${of && html`<p class="help">${about}</p>`}
    <div class="grid contact-figures">
      ${Object.entries(of?.figures ?? FRAMES).map(
        ([id, { title }]) => html`<${Figure} key=${id} ...${{ of, id, title }} empty="Not solved yet." />`,
      )}
    </div>
    <${Notes} of=${of} list=${of?.notes} />
  <//>`;
});

motion.done = (found) =>
  announce(found.interrupted ? `Stopped after ${reached(found)}.` : "The contact over time is solved.");
if (history()?.contact !== contactOf(state.study)) begin("hold", state.setView);
watch(
  () => contactOf(state.study),
  () => begin(history().preset, state.setView),
);
motion.start();

export default () => html`<div class="columns">
  <div><${History} /></div>
  <div><${Drawing} /><${Found} /></div>
</div>`;
