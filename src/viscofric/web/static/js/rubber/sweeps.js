// Step 1: where the rubber comes from; what its files were taken for, what they hold, and what was flagged in them.

import { Job, shows } from "../jobs.js";
import { effect, signal } from "../reactive.js";
import { state } from "../state.js";
import { amplitudeCard } from "./amplitude.js";
import { FIRST_REFERENCE, named, rubber, shownRubber, sourceOf } from "./made.js";
import * as shownBy from "./sweeps_figures.js";
import { sourceForm } from "./sweeps_form.js";

const MEASURED = ["dma", "ramps"]; // sources whose moduli are shown as measured
const MODULI = [
  ["storage_modulus", "storage modulus", "′"],
  ["loss_modulus", "loss modulus", "″"],
  ["loss_tangent", "loss tangent tan δ", ""],
];

const sweeps = new Job("sweeps", {
  wait: 120,
  remember: 6,
  inputs: () => (sourceOf(state.get("material")) ? { study: { material: state.get("material") } } : null),
});

export function mount(section, app) {
  const { fields } = app;
  const { h, card, note, button } = fields;
  const problem = note([], "error");
  problem.setAttribute("aria-live", "assertive");
  const failed = signal(null); // an error of files that were brought
  const form = sourceForm(app, (error) => (failed.value = error));
  const recognised = card("Recognised data");
  const numbers = fields.keyNumbers();
  const files = h("div", {});
  const notes = note([]);
  const flagged = h("div", {});
  const wait = fields.progressBar(sweeps, { label: "Reading", cancels: false });
  recognised.append(h("div", { class: "waiting" }, wait), numbers, problem, notes, files, flagged);
  const pictures = h("div", { class: "grid thirds" });
  const onward = h(
    "div",
    { class: "row" },
    button({ label: "Shift the isotherms", kind: "main", onClick: () => app.goTo("shift") }),
  );
  section.append(h("div", { class: "columns" }, h("div", {}, form, onward), h("div", {}, recognised, amplitudeCard(app))), pictures);

  const figures = MODULI.map(([key, label, primes]) => {
    const place = h("div", { class: "card" });
    pictures.append(place);
    return {
      key,
      label,
      primes,
      place,
      handle: app.figures.figure(place, {
        id: `isotherms-${key.replace("_", "-")}`,
        title: label[0].toUpperCase() + label.slice(1),
        x: shownBy.OVER_FREQUENCY,
        y: { label, log: true },
        traces: [],
      }),
    };
  });
  const stepCard = h("div", { class: "card" });
  pictures.prepend(stepCard);
  const steps = app.figures.figure(stepCard, { id: "step-tests", title: "Creep and relaxation tests", x: {}, y: {}, traces: [] });

  sweeps.done = (result) => {
    app.announce(result.source === "dma" ? `${result.isotherms.length} isotherms read.` : "Material read.");
    followRange(app, result);
  };
  sweeps.start();
  effect(() => {
    const error = failed.value ?? sweeps.error;
    problem.set(error ? [error === failed.value ? error.message : app.explain(error, "sweeps")] : []);
  });
  const read = () => (sweeps.error ? null : sweeps.result);
  effect(() => {
    form.show(read());
    if (sweeps.error) form.require(sweeps.error.field?.replace("material.", ""), sweeps.error.values);
  });
  effect(() => {
    const result = read();
    for (const one of [numbers, files, flagged, notes]) shows(one, result);
    numbers.set(result ? shownBy.keyNumbers(result, app) : []);
    notes.set(result ? [...(result.about ?? []), ...result.notes] : []);
    files.replaceChildren(...shownBy.fileTable(result, app));
    flagged.replaceChildren(...shownBy.flaggedTable(result, app));
    onward.hidden = pictures.hidden = !result;
    const draw = { dma: shownBy.isothermFigure, ramps: shownBy.rampFigure }[result?.source];
    for (const { handle, key, label, primes, place } of figures) {
      if (draw) handle.update({ of: result, ...draw(result, { key, label, primes }, app) });
      place.hidden = !draw && key === "loss_tangent";
    }
    stepCard.hidden = !result?.steps;
    const madeUp = state.get("data_origin") === "synthetic";
    if (result?.steps) steps.update({ of: result, ...shownBy.stepFigure(result.steps, madeUp, app) });
  });

  // A rubber without sweeps has its moduli at the reference to show.
  const ready = () => !MEASURED.includes(sweeps.result?.source ?? sourceOf(state.get("material")));
  effect(() => {
    if (ready()) rubber.start();
    const result = ready() ? shownRubber() : null;
    if (!result) return;
    const { modulus, reference } = result.spectrum;
    const at = reference === null ? "" : ` at ${named(reference, app)}`;
    for (const { handle, key, label } of figures) {
      if (key === "loss_tangent") continue;
      handle.update({
        of: result,
        title: `${label[0].toUpperCase()}${label.slice(1)}${at}`,
        caption: "",
        synthetic: result.synthetic,
        temperatures: undefined,
        x: shownBy.OVER_FREQUENCY,
        y: { label: `${label} E${key === "storage_modulus" ? "′" : "″"}`, kind: "modulus", log: true },
        traces: [{ name: label, x: modulus.angular_frequency, y: modulus[key], legend: false }],
      });
    }
  });
}

/** A reference and temperatures outside the isotherms, which the user never chose, give way to those that they have. */
function followRange({ start, units }, result) {
  const curves = result.ramps ?? (result.isotherms.length ? result.isotherms : result.steps?.curves) ?? [];
  if (curves.length === 0) return;
  const all = curves.flatMap((one) => one.temperature);
  const inside = (kelvin) => kelvin !== null && Math.min(...all) <= kelvin && kelvin <= Math.max(...all);
  const nearest = `${Number((result.reference - 273.15).toFixed(2))} degC`;
  const given = state.get("material.reference_temperature");
  const first = start.study.conditions?.temperature;
  const temperatures = state.get("conditions.temperature");
  const changes = {};
  if (given === undefined || (given === FIRST_REFERENCE && !inside(303.15)))
    changes["material.reference_temperature"] = nearest;
  if (Array.isArray(first) && JSON.stringify(temperatures) === JSON.stringify(first)) {
    const kept = first.filter((one) => inside(units.parse(one, "temperature")));
    if (kept.length < first.length) changes["conditions.temperature"] = kept.length ? kept : [nearest];
  }
  if (Object.keys(changes).length) state.change(changes);
}
