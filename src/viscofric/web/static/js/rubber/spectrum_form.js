// What the user says of the spectrum.

import { Amount, Choose } from "../fields.js";
import { html, view } from "../reactive.js";
import { state } from "../state.js";
import { Card } from "../views.js";
import { isMade, shownRubber } from "./made.js";

const KINDS = [
  ["non-negative", "non-negative: smallest misfit"],
  ["regularised", "regularised: smooth"],
  ["sparse", "sparse: few modes"],
];

const choose = (kind) =>
  state.change({
    "material.spectrum": kind === "non-negative" ? undefined : kind,
    [kind === "sparse" ? "material.tau_ratio" : "material.modes"]: undefined,
  });

/** The misfit beside the number of modes. */
function misfit() {
  const { rms_storage: storage, rms_loss: loss } = shownRubber()?.spectrum.fit ?? {};
  return storage ? `Misfit of E′, E″: ${storage.toFixed(3)}, ${loss.toFixed(3)} decades (rms).` : "";
}

export const Settings = view(() => {
  const sparse = state.get("material.spectrum") === "sparse";
  if (!isMade())
    return html`<${Card} title="Spectrum"><p class="help">A predefined material has its own spectrum.</p><//>`;
  return html`<${Card} title="Spectrum">
    <div class="panel">
      <${Choose} path="material.spectrum" label="Fit method" options=${KINDS} otherwise="non-negative" onChange=${choose}
        help="Non-negative modes have the smallest misfit; regularised ones make a smooth spectrum; sparse ones are few, for finite elements." />
      ${
        sparse
          ? html`<${Amount} key="modes" path="material.modes" label="Largest number of modes" min=${1} max=${200} step=${1} slider=${[1, 60]}
              help=${misfit()}
              placeholder="automatic" />`
          : html`<${Amount} key="ratio" path="material.tau_ratio" label="Ratio of neighbouring times" min=${1.1} max=${100}
              placeholder="e = 2.718" />`
      }
      <${Amount} path="uncertainty.draws" label="Bootstrap samples for the 95 % band" min=${0} max=${10000} step=${1}
        placeholder="200" help="Refits to resampled data; 0 for no band." />
    </div>
  <//>`;
});
