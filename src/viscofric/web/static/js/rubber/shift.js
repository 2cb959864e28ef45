// Step 2: isotherms shifted onto one another; the shift factors, the laws that describe them, and whether superposition holds.

import { Figure } from "../figures.js";
import { Form } from "../fields.js";
import { explain, page } from "../page.js";
import { html, signal, view } from "../reactive.js";
import { state } from "../state.js";
import * as units from "../units.js";
import { Button, Card, Drop, Notes, Numbers, Pick, Progress, Table, shown } from "../views.js";
import { TESTS, isMade, rubber, shownRubber } from "./made.js";
import { Shifted, startShifted } from "./shifted.js";
import { failed, takeFactors } from "./source.js";

const diagram = signal("diagram-van_gurp_palmen");

/** The laws that were compared, each with a button where shift factors are those of the sweeps. */
const Laws = view(({ of }) => {
  const { explanation, laws } = of.shift;
  const { head, rows, caption } = of.tables.laws;
  const measured = TESTS.some((key) => state.get(`material.${key}`) !== undefined);
  const free = measured || state.get("material.shift_factors") !== undefined;
  const use = ({ title, kind, refusal, used }) =>
    !free || refusal || used
      ? ""
      : html`<${Button} kind="small" onClick=${() => state.set("material.shift", kind)}>Use ${title}<//>`;
  const withButtons = rows.map((row, at) => [...row, use(laws[at])]);
  return html`<${Card} title="Laws">
    <p class="help">${explanation}</p>
    <div class="words"><${Table} of=${of} head=${[...head, ""]} rows=${withButtons} caption=${caption} /></div>
  <//>`;
});

/** Shift factors, their laws, and whether superposition holds. */
const Factors = view(({ of }) => {
  const { figures, tables, check } = of;
  const card = (title, id, more) =>
    figures[id] && html`<${Card} title=${title}><${Figure} id=${id} of=${of} />${more}<//>`;
  const names = Object.keys(figures).filter((name) => name.startsWith("diagram-"));
  const diagrams = names.map((name) => [name, figures[name].title]);
  const causal = check?.kramers_kronig && html`<p class="help">${check.kramers_kronig.sentence}</p>`;
  return html`
    <div class="grid">
      ${figures["shifted-steps"] && html`<div class="card"><${Figure} id="shifted-steps" of=${of} /></div>`}
      ${card("Shift factors", "shift-factors", html`<p ...${shown(of, "help")}>${units.filled(of.limits)}</p>`)}
      ${card("Residuals of each law", "law-residuals")}
    </div>
    ${tables.laws && html`<${Laws} of=${of} />`}
    <div class="grid thirds">
      ${
        diagrams.length > 0 &&
        html`<${Card} title="Validity of superposition">
          <${Pick} label="Diagram" options=${diagrams} value=${diagram.value} onChange=${(key) => (diagram.value = key)} />
          <${Figure} id="superposition-diagram" of=${of} spec=${figures[diagram.value]} />
        <//>`
      }
      ${card("Distance of neighbouring isotherms", "neighbour-distances")}
      ${card("Consistency of E′ and E″", "kramers-kronig", causal)}
      ${card("Vertical shift", "vertical-shift")}
    </div>
  `;
});

/** How sweeps are shifted; nothing of it holds for a rubber that is ready. */
const Settings = view(() => {
  if (!isMade())
    return html`<${Card} title="Shift"><p class="help">A predefined material has its own shift factors.</p><//>`;
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
  const of = shownRubber();
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
    ${of?.shift?.isotherms?.length > 0 && html`<${Shifted} of=${of} />`}
    ${of?.shift && html`<${Factors} of=${of} />`}
  `;
});
