// The measurement step put together: a change of the measurement, or of what it is laid beside, computes what rests on it.

import { DEPENDS_ON } from "../inputs.js";
import { comparison } from "./measurement_comparison.js";
import { identification } from "./measurement_identify.js";
import { masterCurve } from "./measurement_master.js";
import { source } from "./measurement_source.js";

/** What the prediction and the master curve rest on, besides the measurement. */
const RESTS_ON = DEPENDS_ON.agreement.filter((path) => path !== "measurement");
const WAIT = 400; // ms after the last change

/** What the parts of the step share: whether the measurement is made up, and whether it or the rubber is. */
function origins(app) {
  const { state } = app;
  const data = () => Boolean(state.result("measured")?.synthetic);
  const rubber = () => {
    const name = state.get("material.catalogue");
    if (name === undefined) return state.get("data_origin") === "synthetic";
    return Boolean(app.start?.catalogue?.find((one) => one.name === name)?.synthetic);
  };
  return { data, synthetic: () => data() || rubber() };
}

/** Put the step into its section. */
export function mount(section, app) {
  const { state } = app;
  const { h } = app.fields;
  const step = origins(app);
  const master = masterCurve(app, step, { changed: () => refresh() });
  const compared = comparison(app, step, { changed: () => master.draw() });
  const identify = identification(app, step, { alone: master.alone });
  const measured = source(app, { done: show, gone: clear });
  const after = [compared.rest, master.card, identify.card];
  let stale = false;
  let timer = null;

  section.append(
    h(
      "p",
      {},
      "Traction test: separation of Coulomb and viscoelastic friction, comparison with the prediction, ",
      "friction master curve, and material identified from friction.",
    ),
    h("div", { class: "columns" }, h("div", {}, measured.card), h("div", {}, compared.card)),
    ...after,
  );

  /** What was separated is there; what rests on it follows. */
  function show(result) {
    for (const part of [compared, master, identify]) part.clear();
    compared.showMeasured(result);
    for (const one of after) one.hidden = !result.curves;
    refresh();
  }

  function clear() {
    for (const part of [compared, master, identify]) part.clear();
    compared.showMeasured(null);
    for (const one of after) one.hidden = true;
  }

  /** Predict and shift again; later, if nobody looks at the step. */
  function refresh() {
    if (!state.result("measured")?.curves) return;
    stale = section.parentElement.hidden;
    if (stale) return;
    if (master.alone()) compared.clear();
    else compared.run();
    identify.suggest(master.run());
  }

  const later = (work) => () => {
    clearTimeout(timer);
    timer = setTimeout(work, WAIT);
  };
  state.subscribe("measurement", later(measured.follow));
  state.subscribe(RESTS_ON, later(refresh));
  new MutationObserver(() => stale && refresh()).observe(section.parentElement, { attributeFilter: ["hidden"] });
  clear();
  measured.follow();
}
