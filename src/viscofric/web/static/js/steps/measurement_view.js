// The measurement step put together.

import { effect } from "../reactive.js";
import { state } from "../state.js";
import { comparison } from "./measurement_comparison.js";
import { identification } from "./measurement_identify.js";
import { masterCurve } from "./measurement_master.js";
import { shownMeasured } from "./measurement_parts.js";
import { source } from "./measurement_source.js";

/** What the parts of the step share: whether the measurement is made up, and whether it or the rubber is. */
function origins(app) {
  const data = () => Boolean(shownMeasured()?.synthetic);
  const rubber = () => {
    const name = state.get("material.catalogue");
    if (name === undefined) return state.get("data_origin") === "synthetic";
    return Boolean(app.start?.catalogue?.find((one) => one.name === name)?.synthetic);
  };
  return { data, synthetic: () => data() || rubber() };
}

/** Put the step into its section. */
export function mount(section, app) {
  const { h } = app.fields;
  const step = origins(app);
  const measured = source(app);
  const compared = comparison(app, step);
  const after = [compared.rest, masterCurve(app, step), identification(app, step)];
  section.append(
    h(
      "p",
      {},
      "Traction test: separation of Coulomb and viscoelastic friction, comparison with the prediction, ",
      "friction master curve, and material identified from friction.",
    ),
    h("div", { class: "columns" }, h("div", {}, measured), h("div", {}, compared.card)),
    ...after,
  );
  effect(() => {
    for (const one of after) one.hidden = !shownMeasured()?.curves;
  });
}
