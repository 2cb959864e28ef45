// What the user says of the spectrum.

import { Form } from "../fields.js";
import { page } from "../page.js";
import { html, view } from "../reactive.js";
import { Card } from "../views.js";
import { isMade, shownRubber } from "./made.js";

/** The misfit beside the number of modes. */
function misfit() {
  const { rms_storage: storage, rms_loss: loss } = shownRubber()?.spectrum.fit ?? {};
  return storage ? `Misfit of E′, E″: ${storage.toFixed(3)}, ${loss.toFixed(3)} decades (rms).` : "";
}

export const Settings = view(() => {
  const fields = page.start.forms.spectrum.map((one) =>
    one.path === "material.modes" ? { ...one, help: misfit() } : one,
  );
  if (!isMade())
    return html`<${Card} title="Spectrum"><p class="help">A predefined material has its own spectrum.</p><//>`;
  return html`<${Card} title="Spectrum"><${Form} of=${fields} /><//>`;
});
