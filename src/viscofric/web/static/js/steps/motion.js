// Motion over time: a history edited as a table or a sketch, or an impact, and the solved contact.

import { runJob } from "../api.js";
import { Form } from "../fields.js";
import { Figure, save } from "../figures.js";
import { Job } from "../jobs.js";
import { CONTROLS, PATHS, PointTable, Sketch, contactOf, converted, presetRows } from "../motion_history.js";
import { announce, attempts, explain, page } from "../page.js";
import { html, signal, view, watch } from "../reactive.js";
import { state } from "../state.js";
import * as units from "../units.js";
import { Button, Card, Folded, Notes, Numbers, Progress } from "../views.js";

const form = page.start.forms.motion;
const PART = "@motion.impact.";
const IMPACT = form
  .filter(({ path }) => path.startsWith(PART))
  .map(({ path, otherwise }) => [path.slice(PART.length), otherwise]);
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
    const { coulomb } = asked;
    const given = asked.preset === "impact" ? { impact: asked.impact } : { ...optionsOf(asked), coulomb };
    return { study: state.study, options: { temperature: asked.temperature, ...given } };
  },
});
const refused = signal(null); // what cannot be read in the table: {sentence, text, row, at}

/** Change the history, as a step of undo unless it follows from the study. */
function change(values, keep = state.edit) {
  refused.value = null;
  keep("motion", { ...history(), ...values });
}

/** Begin with an example of the study's contact. */
function begin(preset, keep) {
  const contact = contactOf(state.study);
  const [control] = Object.keys(CONTROLS[contact]);
  const rows = presetRows(preset, state.study);
  const impact = history()?.impact ?? Object.fromEntries(IMPACT);
  change({ preset, contact, control, path: "speed", before: "untouched", rows, impact }, keep);
}

const columnsOf = ({ contact, control, path }) => [["Time", "time"], CONTROLS[contact][control], PATHS[path]];

function csv() {
  const { rows, control, path, ...about } = history();
  const [, [, along], [, across]] = columnsOf({ control, path, ...about });
  const head = ["time (s)", `${control} (${UNITS[along]})`, `${path} (${UNITS[across]})`];
  return [head, ...rows].map((row) => row.join(",")).join("\n") + "\n";
}

const firstTemperature = () => {
  const given = state.get("conditions.temperature");
  return String([given?.from ?? given ?? ""].flat()[0]).replace("degC", "°C");
};

const [attempt, failed] = attempts();

/** The history of the study ([history] in the run file): set from this step, shown in it, edited or removed. */
const StudyHistory = view(() => {
  const has = state.get("history") !== undefined;
  const ask = (options, then) =>
    attempt(async () => then(await runJob("history", { study: state.study, options })));
  const put = ({ history: table }) => {
    if (table.file) state.renew([table.file]);
    state.set("history", table);
    return "The study has this history.";
  };
  const words = has
    ? "Export and viscofric run also solve the study over time; stages use its loads and speeds."
    : "“Use in the study” adds this history to the run file; Export and viscofric run then also solve over time.";
  const remove = () => state.set("history", undefined);
  return html`<${Folded} title="History of the study">
    <p class="help">${words}</p>
    <div class="row">
      <${Button} kind="small" onClick=${() => ask(optionsOf(history()), put)}>Use in the study<//>
      ${has && html`<${Button} kind="small" onClick=${() => ask({}, change)}>Show the study’s<//>`}
      ${has && html`<${Button} kind="quiet small" onClick=${remove}>Remove from the study<//>`}
    </div>
    <${Notes} kind="error" list=${[failed.value && explain(failed.value, "motion")]} />
    <${Form} of=${page.start.forms.history} />
  <//>`;
});

/** The fields, each with what it changes. */
function fields({ preset, contact, rows, impact }) {
  const own = {
    "@motion.preset": { onChange: (one) => begin(one) },
    "@motion.control": {
      options: Object.entries(CONTROLS[contact]).map(([one, [label]]) => [one, label]),
      onChange: (one) => change({ control: one, path: "speed", rows: presetRows(preset, state.study, one) }),
    },
    "@motion.path": { onChange: (path) => change({ path, rows: converted(rows, path) }) },
    "@motion.temperature": { placeholder: firstTemperature() },
  };
  return form.map((one) => {
    const [, name, part] = one.path.split(".");
    const keep = (value = one.otherwise) => change({ [name]: part ? { ...impact, [part]: value } : value });
    return { onChange: keep, ...one, ...own[one.path] };
  });
}

const History = view(() => {
  const now = history();
  const hits = now.preset === "impact";
  return html`<${Card} title="History">
    <${Form} of=${fields(now)} />
    ${
      !hits &&
      html`<div class="scroll">
        <${PointTable} rows=${now.rows} columns=${columnsOf(now)} wrong=${motion.error?.values?.index} refused=${refused.value}
          onChange=${(rows) => change({ rows })} onRefuse=${(one) => (refused.value = one)} />
      </div>`
    }
    <p class="help">Material, indenter, layer and accuracy are the first values given in the study.</p>
    <${Button} kind="main" onClick=${() => motion.run()}>Solve<//>
    ${
      !hits &&
      html`<div class="stack">
        <${Button} kind="small" symbol="down" onClick=${() => save("history.csv", csv(), "text/csv")}>Save the history<//>
        <${StudyHistory} />
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

const LASTS = 5000; // ms that the pressure is played
const REDUCED = matchMedia("(prefers-reduced-motion: reduce)");
const frame = signal(0); // of the pressure over time
const plays = signal(false);

/** Play the pressure from the shown time, or from the start, until it is paused, or something else is looked at. */
function play(of) {
  const { time } = of.animation;
  const from = time[frame.value + 1] === undefined ? 0 : frame.value;
  const [rate, end] = [(time.at(-1) - time[0]) / LASTS, time.at(-1)];
  const begun = performance.now() - (time[from] - time[0]) / rate;
  const tick = () => {
    if (!plays.value) return; // paused
    const now = time[0] + rate * (performance.now() - begun);
    plays.value &&= now < end && motion.result === of && state.step === "motion";
    frame.value = Math.max(time.findLastIndex((one) => one <= now), from);
    if (plays.value) requestAnimationFrame(tick);
  };
  plays.value = true;
  tick();
}

/** The pressure along the motion at one time; in steps if reduced motion is requested. */
const Pressure = view(({ of, id, title, empty }) => {
  const { time = [0] } = of?.animation ?? {};
  const last = time.length - 1;
  const at = Math.min(frame.value, last);
  const to = (next) => {
    plays.value = false;
    frame.value = next;
  };
  const [label, act] = plays.value
    ? ["Pause", () => to(at)]
    : REDUCED.matches
      ? ["Next", () => to(at < last ? Math.min(at + Math.ceil(last / 10), last) : 0)]
      : ["Play", () => play(of)];
  const words = units.show(time[at], "time");
  const traces = of?.figures[id].traces.map((one) => ({ ...one, y: `animation.pressure[${at}]` }));
  return html`<div>
    <${Figure} ...${{ of, id, title, empty }} spec=${of && { ...of.figures[id], title: `${title} at ${words}`, traces }} />
    <div class="slider-row">
      <${Button} kind="small" disabled=${last < 1} onClick=${act}>${label}<//>
      <input type="range" aria-label="Time of the pressure" min="0" max=${last} value=${at} disabled=${last < 1}
        aria-valuetext=${words} onInput=${({ target }) => to(Number(target.value))} />
    </div>
  </div>`;
});

// figures before there is a result
const FRAMES = {
  "motion-pressure": { title: "Pressure along the motion" },
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
      ${Object.entries(of?.figures ?? FRAMES).map(([id, { title }]) => {
        const Shown = id === "motion-pressure" ? Pressure : Figure;
        return html`<${Shown} key=${id} ...${{ of, id, title }} empty="Set the history, then press Solve." />`;
      })}
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
