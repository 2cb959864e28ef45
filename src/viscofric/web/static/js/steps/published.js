// How the numbers of this page are known: published results beside those that this computer computes when the section is opened.

import { Job } from "../jobs.js";
import { html, signal, view } from "../reactive.js";
import { Folded, Notes, Progress, Table } from "../views.js";

const opened = signal(false);
const published = new Job("published", { inputs: () => (opened.value ? { study: {} } : null) });

const Check = ({ of, title, verdict, origin, table }) => html`<details>
  <summary>${title}: ${verdict}</summary>
  <${Notes} of=${of} list=${origin} />
  <div class="words"><${Table} of=${of} ...${table} /></div>
</details>`;

export const Published = view(() => {
  const of = published.result;
  const look = ({ currentTarget: { open } }) => (opened.value ||= open);
  published.start();
  return html`<section class="card" id="published">
    <${Folded} title="How we know: comparison with published results" onToggle=${look}>
      <p class="help">Numbers of papers, of other programs and of closed forms, each computed again on this computer.</p>
      <${Progress} job=${published} label="Comparing" />
      <${Notes} kind="error" list=${[published.error?.message]} />
      <${Notes} of=${of} list=${[of?.said]} />
      ${of?.checks.map((one) => html`<${Check} key=${one.title} ...${{ of, ...one }} />`)}
    <//>
  </section>`;
});
