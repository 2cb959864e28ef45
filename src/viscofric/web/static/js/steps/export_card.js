// The rubber as a card for finite-element programs; and how texts are copied and files are fetched.

import { downloadUrl } from "../api.js";
import { Form, given } from "../fields.js";
import { Job } from "../jobs.js";
import { announce } from "../page.js";
import { html, view } from "../reactive.js";
import { page, state } from "../state.js";
import { Button, Card, Icon, Notes } from "../views.js";

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

const fields = page.start.forms.card;
const cardJob = new Job("export-card", {
  manual: true,
  inputs: () => ({ study: state.study, options: given(fields) }),
});

/** Form and text of a card. */
export const MaterialCard = view(() => {
  const of = cardJob.current;
  cardJob.done = ({ download }) => announce(`The card is written: ${download.name}.`);
  return html`<${Card} title="Material card for finite elements">
    <${Form} of=${fields} />
    <div class="row">
      <${Button} disabled=${Boolean(cardJob.progress)} onClick=${() => cardJob.run()}>Write the card<//>
      ${of && html`<div class="row"><${Download} name=${of.download.name} /><${Copy} text=${() => of.text} /></div>`}
    </div>
    <${Notes} kind="error" aria-live="assertive" list=${[cardJob.error?.message]} />
    <${Notes} of=${of} list=${of?.notes} />
    ${of && html`<pre tabindex="0" role="group" aria-label="Card">${of.text}</pre>`}
  <//>`;
});
