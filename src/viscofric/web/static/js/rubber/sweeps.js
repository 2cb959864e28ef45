// Step 1: where the rubber comes from; what its files were taken for, what they hold, and what was flagged in them.

import { shows } from "../inputs.js";
import { FIRST_REFERENCE, follow, named, sourceOf } from "./made.js";
import { fileTable, flaggedTable, isothermFigure, keyNumbers } from "./sweeps_figures.js";
import { sourceForm } from "./sweeps_form.js";

const MODULI = [
  ["storage_modulus", "storage modulus", "′"],
  ["loss_modulus", "loss modulus", "″"],
  ["loss_tangent", "loss tangent tan δ", ""],
];

export function mount(section, app) {
  const { state, fields, units } = app;
  const { h, card, note, button } = fields;
  const problem = note([], "error");
  problem.setAttribute("aria-live", "assertive");
  const form = sourceForm(app, (error) => problem.set(error ? [error.message] : []));
  const recognised = card("Recognised data");
  const numbers = fields.keyNumbers();
  const files = h("div", {});
  const notes = note([]);
  const flagged = h("div", {});
  const wait = fields.progressBar({ label: "Reading" });
  recognised.append(h("div", { class: "waiting" }, wait), numbers, problem, notes, files, flagged);
  const pictures = h("div", { class: "grid thirds" });
  const onward = h(
    "div",
    { class: "row" },
    button({ label: "Shift the isotherms", kind: "main", onClick: () => app.goTo("shift") }),
  );
  section.append(h("div", { class: "columns" }, h("div", {}, form, onward), h("div", {}, recognised)), pictures);

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
        x: { label: "frequency", kind: "angular_frequency", log: true },
        y: { label, log: true },
        traces: [],
      }),
    };
  });

  let running = null;
  const read = async () => {
    running?.abort();
    running = new AbortController();
    const mine = running;
    const material = state.get("material");
    if (!sourceOf(material)) return show(null);
    wait.start("Reading");
    try {
      const result = await app.api.runJob("sweeps", { study: { material }, options: {} }, { signal: mine.signal });
      if (running !== mine) return;
      problem.set([]);
      state.setResult("sweeps", result);
      show(result);
      app.announce(result.source === "dma" ? `${result.isotherms.length} isotherms read.` : "Material read.");
      followRange(app, result);
    } catch (error) {
      if (running !== mine || error.name === "AbortError") return;
      show(null);
      form.require(error.field?.replace("material.", ""), error.values);
      problem.set([app.explain(error, "sweeps")]);
    } finally {
      if (running === mine) wait.finish();
    }
  };

  const show = (result) => {
    form.show(result);
    for (const one of [numbers, files, flagged, notes]) shows(one, result);
    numbers.set(result ? keyNumbers(result, app) : []);
    notes.set(result ? [...(result.about ?? []), ...result.notes] : []);
    files.replaceChildren(...fileTable(result, app));
    flagged.replaceChildren(...flaggedTable(result, app));
    onward.hidden = !result;
    const sweeps = result?.source === "dma";
    pictures.hidden = !result;
    for (const { handle, key, label, primes, place } of figures) {
      if (sweeps) handle.update({ of: result, ...isothermFigure(result, { key, label, primes }, app) });
      place.hidden = !sweeps && key === "loss_tangent";
    }
    if (result && !sweeps) showReady();
  };

  // A rubber without sweeps has its moduli at the reference to show.
  let latest = null;
  const showReady = () => {
    const result = latest?.result;
    if (!result || state.result("sweeps")?.source === "dma") return;
    const { modulus, reference } = result.spectrum;
    const at = reference === null ? "" : ` at ${named(reference, app)}`;
    for (const { handle, key, label } of figures) {
      if (key === "loss_tangent") continue;
      handle.update({
        of: result,
        title: `${label[0].toUpperCase()}${label.slice(1)}${at}`,
        caption: "",
        synthetic: result.synthetic,
        y: { label: `${label} E${key === "storage_modulus" ? "′" : "″"}`, kind: "modulus", log: true },
        traces: [{ name: label, x: modulus.angular_frequency, y: modulus[key], legend: false }],
      });
    }
  };
  let following = false;
  const followReady = () => {
    if (following || sourceOf(state.get("material")) === "dma") return;
    following = true;
    follow(app, (now) => {
      latest = now;
      showReady();
    });
  };

  let timer = null;
  state.subscribe("material", () => {
    clearTimeout(timer);
    timer = setTimeout(read, 120);
    followReady();
  });
  units.subscribe(() => state.result("sweeps") && show(state.result("sweeps")));
  followReady();
  read();
}

/** A reference and temperatures outside the isotherms, which the user never chose, give way to those that they have. */
function followRange({ state, start, units }, result) {
  if (result.source !== "dma" || result.isotherms.length === 0) return;
  const all = result.isotherms.map((one) => one.temperature);
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
