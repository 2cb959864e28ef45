// The run file, live; the whole study run, with all that it leaves; the rubber as a card for other programs.

import { downloadUrl } from "../api.js";
import { Field, Form, given } from "../fields.js";
import { Job, newest } from "../jobs.js";
import { announce, explain, page } from "../page.js";
import { html, view } from "../reactive.js";
import { state } from "../state.js";
import { Button, Card, Icon, Notes, Numbers, Progress, shown } from "../views.js";

const size = (bytes) => (bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1e3))} kB` : `${(bytes / 1e6).toFixed(1)} MB`);

/** Copies a text, and says so. */
const Copy = view(({ text }, self) => {
  const say = (words) => {
    self.words = words;
    self.setState({});
  };
  const copy = async () => {
    const done = navigator.clipboard.writeText(text());
    say(await done.then(() => "Copied", () => "Select and copy it"));
    announce(self.words);
    setTimeout(say, 2000);
  };
  return html`<${Button} kind="small" symbol="copy" onClick=${copy}>${self.words ?? "Copy"}<//>`;
});

const Download = ({ name }) =>
  html`<a class="button small" href=${downloadUrl(name)} download=${name}><${Icon} name="down" />${name}</a>`;

/** A download with what it is and how large. */
const FileLine = ({ name, title, size: bytes }) =>
  html`<li><${Download} name=${name} /><span class="help">${title}, ${size(bytes)}</span></li>`;

function startOver() {
  state.replace(page.start.study);
  announce("The page shows the example study again; Undo restores yours.");
}

/** A run file's lines, with headings, keys and remarks marked as such. */
function coloured(text) {
  return text.split("\n").map((line) => {
    const key = /^([\w-]+)( = .*)$/.exec(line);
    if (line.startsWith("#")) return html`<span class="remark">${line}</span>${"\n"}`;
    if (line.startsWith("[")) return html`<span class="heading">${line}</span>${"\n"}`;
    return key ? html`<span class="key">${key[1]}</span>${key[2]}${"\n"}` : `${line}\n`;
  });
}

const RunFile = view(() => {
  const of = newest("export-run-file");
  const { text = "", about, problems = [] } = of ?? {};
  const wrong = problems.map(({ field, message }) => (field ? `${field}: ${message}` : message));
  return html`<${Card} title="Run file">
    <${Field} path="title" label="Title of the study and report" />
    <div class="row">
      <${Copy} text=${() => text} />
      <${Button} kind="small" onClick=${() => startOver()}>Start over<//>
    </div>
    ${about && html`<p class="help">${about}</p>`}
    <${Notes} kind="error" list=${wrong} />
    <pre ...${shown(of)} tabindex="0" role="group" aria-label="Run file">${coloured(text.trimEnd())}</pre>
    <p class="help">“Save project” downloads it with its data; run it in its folder: <code>viscofric run study.toml</code></p>
  <//>`;
});

// How many processes it takes is no input.
const study = new Job("export-study", {
  manual: true,
  inputs: () => ({ study: state.study }),
  asked: (_, asked) => ({ study: asked.study }),
});
const inWords = (seconds) => (seconds < 90 ? `${Math.round(seconds)} s` : `${Math.round(seconds / 60)} min`);
const endOf = ({ cancelled, seconds }) =>
  cancelled ? "Cancelled; solved contacts are kept for the next run." : `Done in ${inWords(seconds)}.`;

study.done = ({ cases, failed: missing, downloads }) =>
  announce(`The study is finished: ${cases} cases, ${missing} failed. ${downloads.length} files can be downloaded.`);
const run = async () => {
  await study.run({ study: state.study, options: { workers: state.get("@export.workers") ?? 1 } });
  if (study.ended?.cancelled) announce("The study is cancelled.");
  else if (study.error) announce(`Error: ${study.error.message}`);
};

const Study = view(() => {
  const of = study.current; // files of another study are none of this one
  const changed = study.result && !of && !study.progress && "The study has changed; run it again.";
  const { warnings = [], downloads = [], failures = [], notes = [] } = of ?? {};
  return html`<${Card} title="Results and report">
    <p class="help">
      Solves every case to the requested accuracy, with the material's uncertainty, and writes a report, tables and
      figures.
    </p>
    <${Form} of=${page.start.forms.solving} />
    <div class="row">
      <${Button} kind="main" disabled=${Boolean(study.progress)} onClick=${run}>Run the whole study<//>
      <${Progress} job=${study} label="Running the study" ended=${endOf} />
    </div>
    <${Notes} list=${[changed]} />
    <${Notes} kind="error" list=${study.error ? [explain(study.error, "export")] : failures} />
    <${Numbers} of=${of} />
    ${of && html`<ul class="downloads" aria-label="Results">${downloads.map((one) => html`<${FileLine} ...${one} />`)}</ul>`}
    <${Notes} of=${of} kind="warning" list=${warnings} />
    <${Notes} of=${of} list=${notes} />
  <//>`;
});

const cardFields = page.start.forms.card;
const cardJob = new Job("export-card", {
  manual: true,
  inputs: () => ({ study: state.study, options: given(cardFields) }),
});

/** Form and text of a card. */
const MaterialCard = view(() => {
  const of = cardJob.current;
  cardJob.done = ({ download }) => announce(`The card is written: ${download.name}.`);
  return html`<${Card} title="Material card for finite elements">
    <${Form} of=${cardFields} />
    <div class="row">
      <${Button} disabled=${Boolean(cardJob.progress)} onClick=${() => cardJob.run()}>Write the card<//>
      ${of && html`<div class="row"><${Download} name=${of.download.name} /><${Copy} text=${() => of.text} /></div>`}
    </div>
    <${Notes} kind="error" aria-live="assertive" list=${[cardJob.error?.message]} />
    <${Notes} of=${of} list=${of?.notes} />
    ${of && html`<pre tabindex="0" role="group" aria-label="Card">${of.text}</pre>`}
  <//>`;
});

export default () => html`
  <p>One run file reproduces everything on this page. Download it to repeat the study anywhere, or run it here.</p>
  <div class="grid"><${RunFile} /><div class="stack"><${Study} /><${MaterialCard} /></div></div>
`;
