// Step 2: isotherms shifted onto one another; the shift factors, the laws that describe them, and whether superposition holds.

import { Figure, Figures } from "../figures.js";
import { Form } from "../fields.js";
import { bringSweeps, explain, page } from "../page.js";
import { html, signal, view } from "../reactive.js";
import { state } from "../state.js";
import { Button, Card, Drop, Notes, Numbers, Pick, Progress, Table, shown } from "../views.js";
import { Shifted, startShifted } from "./shifted.js";
import { TESTS, emptyOf, failed, isMade, rubber, takeFactors } from "./source.js";

const FACTORS = ["shift-factors", "Shift factor against temperature"];
const EMPTY = "DMA sweeps at several temperatures are shifted here. Add them in step 1, Data.";
const diagram = signal("diagram-van_gurp_palmen");

/** The laws that were compared, each with a button where shift factors are those of the sweeps. */
const Laws = view(({ of }) => {
  const { head, rows, caption, note } = of.tables.laws;
  const fitted = of.shift.laws.filter(({ refusal }) => !refusal);
  const measured = TESTS.some((key) => state.get(`material.${key}`) !== undefined);
  const free = measured || state.get("material.shift_factors") !== undefined;
  const use = ({ title, kind, used }) =>
    !free || used
      ? ""
      : html`<${Button} kind="small" onClick=${() => state.set("material.shift", kind)}>Use ${title}<//>`;
  const withButtons = rows.map((row, at) => [...row, use(fitted[at])]);
  return html`<${Card} title="Laws">
    <p class="help">${note}</p>
    <div class="words"><${Table} of=${of} head=${[...head, ""]} rows=${withButtons} caption=${caption} /></div>
  <//>`;
});

/** Shift factors, their laws, and whether superposition holds. */
const Factors = view(({ of }) => {
  const { figures = {}, tables = {} } = of ?? {};
  const diagrams = Object.entries(figures).filter(([name]) => name.startsWith("diagram-"));
  return html`
    <div class="grid">
      <${Figures} of=${of} ids=${["shifted-steps", FACTORS, "law-residuals"]} empty=${emptyOf(EMPTY)} />
    </div>
    ${tables.laws && html`<${Laws} of=${of} />`}
    <div class="grid thirds">
      <${Card} title="Validity of superposition">
        <${Pick} label="Diagram" options=${diagrams.map(([name, { title }]) => [name, title])} value=${diagram.value}
          onChange=${(key) => (diagram.value = key)} />
        <${Figure} id="superposition-diagram" title="Loss angle against modulus" of=${of} spec=${figures[diagram.value]}
          height=${diagrams.length ? undefined : 160} empty=${emptyOf(EMPTY)} />
      <//>
      <${Figures} of=${of} ids=${["neighbour-distances", "kramers-kronig", "vertical-shift"]} />
    </div>
  `;
});

/** How sweeps are shifted; nothing of it holds for a rubber that is ready. */
const Settings = view(() => {
  if (!isMade())
    return html`<${Card} title="Shift">
      <p class="help">This material brings its own shift factors. DMA sweeps of yours are shifted here.</p>
      <${Button} kind="small" onClick=${bringSweeps}>Add DMA sweeps<//>
    <//>`;
  const given = state.get("material.shift_factors");
  return html`<${Card} title="Shift">
    <div class="panel">
      <${Form} of=${page.start.forms.shift} />
      ${
        given &&
        html`<div class="row">
          <span>Shift factors of ${given}</span>
          <${Button} kind="small" onClick=${() => state.set("material.shift_factors", undefined)}>Fit them to the sweeps<//>
        </div>`
      }
      <details>
        <summary>Use shift factors from a file</summary>
        <${Drop} label="Drop shift factors" multiple=${false} onFiles=${takeFactors}
          help="Temperature and α or log₁₀ α, as written by the instrument's software." />
      </details>
      <${Notes} kind="error" list=${[failed.value?.message]} />
    </div>
  <//>`;
});

const Verdict = view(({ of }) => {
  const { check } = of;
  return html`<section ...${shown(of, "card")} aria-live="polite">
    <h3 class="verdict" data-kind=${check.kind}>${check.headline}</h3>
    <${Numbers} list=${of.verdict_numbers} />
    <${Notes} kind=${check.kind === "good" ? "note" : check.kind} list=${check.sentences} />
  </section>`;
});

rubber.start();
startShifted();

export default view(() => {
  const of = rubber.shown;
  const none = of && !of.shift && "This material has no shift factors: it is valid at one temperature only.";
  return html`
    <p>All isotherms are shifted along the frequency axis at once, onto one master curve.</p>
    <div class="waiting"><${Progress} job=${rubber} label="Fitting the material" cancels=${false} /></div>
    <${Notes} kind="error" list=${[rubber.error && explain(rubber.error, "shift")]} />
    <${Notes} list=${[none]} />
    <div class="columns">
      <div><${Settings} /></div>
      <div>${of?.check && html`<${Verdict} of=${of} />`}<${Notes} of=${of} kind="warning" list=${of?.notes} /></div>
    </div>
    ${
      of?.shift?.isotherms?.length > 0
        ? html`<${Shifted} of=${of} />`
        : html`<${Figures} ids=${[["shifted-isotherms", "Shifted isotherms"]]} empty=${emptyOf(EMPTY)} />`
    }
    <${Factors} of=${of} />
  `;
});
