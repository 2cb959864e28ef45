// The rubber as a card for finite-element programs; and how texts are copied and files are fetched.

import { downloadUrl } from "../api.js";
import { Job } from "../jobs.js";
import { announce } from "../page.js";
import { html, signal, view } from "../reactive.js";
import { state } from "../state.js";
import { Box, Button, Card, Choice, Icon, Notes, choice } from "../views.js";

const program = choice("card.program", [
  ["abaqus", "Abaqus"],
  ["ansys", "ANSYS"],
  ["ls-dyna", "LS-DYNA"],
  ["comsol", "COMSOL, parameters"],
  ["comsol-branches", "COMSOL, table of branches"],
  ["json", "viscofric (JSON)"],
  ["csv", "table (CSV)"],
]);
const system = choice("card.system", [
  ["Pa", "Pa, m, s, kg"],
  ["MPa", "MPa, mm, s, t"],
]);
const temperature = choice("card.temperature", [
  ["K", "kelvin"],
  ["degC", "°C"],
]);
const domain = choice("card.domain", [
  ["time", "time (Prony series)"],
  ["frequency", "frequency"],
]);
const law = choice("card.law", [
  ["", "that of the material"],
  ["best", "the best law"],
  ["wlf", "WLF"],
  ["arrhenius", "Arrhenius"],
]);
const WITH_UNITS = ["abaqus", "ansys", "ls-dyna"];
const size = (bytes) => (bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1e3))} kB` : `${(bytes / 1e6).toFixed(1)} MB`);

/** Copies a text, and says so. */
export function Copy({ text }) {
  const copy = async ({ currentTarget: { lastChild: words } }) => {
    try {
      await navigator.clipboard.writeText(text());
      announce("Copied.");
      words.textContent = "Copied";
    } catch {
      words.textContent = "Select and copy it";
    }
    setTimeout(() => (words.textContent = "Copy"), 2000);
  };
  return html`<${Button} kind="small" symbol="copy" onClick=${copy}>Copy<//>`;
}

export const Download = ({ name }) =>
  html`<a class="button small" href=${downloadUrl(name)} download=${name}><${Icon} name="down" />${name}</a>`;

/** A download with what it is and how large. */
export const FileLine = ({ name, title, size: bytes }) =>
  html`<li><${Download} name=${name} /><span class="help">${title}, ${size(bytes)}</span></li>`;

const typed = (name) => state.view(`card.${name}`, "");
const cardJob = new Job("export-card", {
  manual: true,
  inputs: () => ({
    study: state.study,
    options: {
      format: program.value(),
      temperature_unit: temperature.value(),
      unit_system: system.value(),
      domain: domain.value(),
      ...(law.value() ? { law: law.value() } : {}),
      ...(typed("poisson") ? { poisson_ratio: Number(typed("poisson")) } : {}),
      ...(typed("density") ? { density: typed("density") } : {}),
    },
  }),
});
const refused = signal(null); // a Poisson's ratio that is no number

function write() {
  const ratio = typed("poisson");
  refused.value = Number.isFinite(Number(ratio)) ? null : ratio;
  if (refused.value === null) cardJob.run();
}

/** Form and text of a card. */
export const MaterialCard = view(() => {
  const of = cardJob.current;
  const own = ["json", "csv"].includes(program.value());
  const wrong =
    refused.value !== null && refused.value === typed("poisson")
      ? `Poisson's ratio: enter a number, e.g. 0.499; got ${refused.value}.`
      : cardJob.error?.message;
  cardJob.done = ({ download }) => announce(`The card is written: ${download.name}.`);
  return html`<${Card} title="Material card for finite elements">
    <div class="form">
      <${Choice} of=${program} label="Program" />
      <${Choice} of=${system} label="Units of the model" hidden=${!WITH_UNITS.includes(program.value())} />
      <${Choice} of=${temperature} label="Temperatures of the model" hidden=${own} />
      <${Choice} of=${domain} label="Analysis" hidden=${program.value() !== "abaqus"} />
      <${Choice} of=${law} label="Shift law" help="fits a law, since the programs accept no table of factors" hidden=${own} />
      <${Box} name="card.poisson" label="Poisson's ratio" placeholder="that of the material"
        help="ANSYS and LS-DYNA do not accept 0.5" hidden=${own} />
      <${Box} name="card.density" label="Density" placeholder="none" help="e.g. 1800 kg/m^3; required for LS-DYNA" hidden=${own} />
    </div>
    <div class="row">
      <${Button} disabled=${Boolean(cardJob.progress)} onClick=${write}>Write the card<//>
      ${of && html`<div class="row"><${Download} name=${of.download.name} /><${Copy} text=${() => of.text} /></div>`}
    </div>
    <${Notes} kind="error" aria-live="assertive" list=${[wrong]} />
    <${Notes} of=${of} list=${of?.notes} />
    ${of && html`<pre tabindex="0" role="group" aria-label="Card">${of.text}</pre>`}
  <//>`;
});
