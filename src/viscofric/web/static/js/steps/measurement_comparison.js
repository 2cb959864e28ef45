// Measured friction beside the prediction for the page's rubber and ball, and what else follows from the test.

import { shows } from "../jobs.js";
import { effect } from "../reactive.js";
import { checkFigure, coulombFigure, frictionFigure, zeroFigure } from "./measurement_figures.js";
import { alone, checkList, folded, ofMeasured, progressOf, shownMeasured } from "./measurement_parts.js";

export const agreement = ofMeasured("agreement", () => (alone() ? null : {}), { remember: 4 });

const SPEED = { label: "speed", kind: "speed", log: true };
const OTHERS = [
  {
    of: coulombFigure,
    id: "coulomb-friction",
    title: "Coulomb friction",
    caption: "Measured, with the standard deviation of the repetitions.",
    y: { label: "Coulomb friction coefficient" },
  },
  {
    of: checkFigure,
    id: "four-runs",
    title: "Check of the four configurations",
    caption: "(F_I − F_II + F_III − F_IV)/4 over the load, with twice its standard error: zero in a valid test.",
    y: { label: "residual over load" },
  },
  {
    of: zeroFigure,
    id: "force-cell-zero",
    title: "Zero of the force cell",
    caption: "As fitted at each condition; a drift is reported in the notes.",
    y: { label: "zero", kind: "load" },
  },
];

/**
 * The cards of measured friction: `card` beside the prediction, `rest` what else there is.
 *
 * @param {object} app
 * @param {{data: () => boolean, synthetic: () => boolean}} step
 */
export function comparison(app, step) {
  const { fields, figures } = app;
  const { h, note } = fields;
  const key = fields.keyNumbers();
  const verdict = note([]);
  const warnings = note([], "warning");
  const byTemperature = h("div", {});
  const checks = checkList(app);
  const checked = folded(app, "By temperature, and checks", byTemperature, checks);
  const card = fields.card("Measured against predicted", ...progressOf(app, agreement, "Predicting"));
  const figure = figures.figure(card, {
    id: "measured-friction",
    title: "Viscoelastic friction",
    x: SPEED,
    y: { label: "viscoelastic friction coefficient" },
    empty: "Drop the files of a traction test, or use the synthetic example.",
  });
  card.append(key, verdict, warnings, checked);

  const rest = h("div", { class: "grid thirds" });
  const others = OTHERS.map(({ of, ...spec }) => {
    const place = h("section", { class: "card" });
    rest.append(place);
    return { of, place, handle: figures.figure(place, { x: SPEED, height: 300, ...spec }) };
  });

  agreement.done = ({ sentences }) => sentences.length && app.announce(sentences[0]);
  agreement.start();
  effect(() => {
    const result = shownMeasured();
    for (const { of, place, handle } of others) {
      const changes = of(result, step.data());
      place.hidden = changes.traces.length === 0;
      handle.update({ of: result, ...changes });
    }
  });
  effect(() => {
    const measured = shownMeasured();
    const result = agreement.error ? null : agreement.result;
    const synthetic = result ? step.synthetic() : step.data();
    figure.update({ of: result ?? measured, ...frictionFigure(measured, result, synthetic) });
    for (const one of [key, verdict, warnings, byTemperature, checks]) shows(one, result);
    key.set((result?.key ?? []).map(({ name, value, remark }) => ({ label: name, value, remark })));
    key.hidden = !result?.key.length;
    verdict.set(result ? [...result.sentences.slice(0, 1), ...result.notes] : []);
    warnings.set(result ? [...result.failures, ...result.warnings] : []);
    checks.set(result?.checks ?? []);
    checked.hidden = !result;
    const { headings, rows, caption, note: remark } = result?.table ?? {};
    byTemperature.replaceChildren(
      ...(rows ? [fields.table(headings, rows, caption), h("p", { class: "help" }, remark)] : []),
    );
  });

  return { card, rest };
}
