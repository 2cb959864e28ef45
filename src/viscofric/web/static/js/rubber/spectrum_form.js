// What the user says of the spectrum, and the temperature that the modulus is shown at.

import { sourceOf } from "./made.js";

const KINDS = [
  ["non-negative", "non-negative: smallest misfit"],
  ["regularised", "regularised: smooth"],
  ["sparse", "sparse: few modes"],
];
const WAIT = 150; // ms after the slider moved

export function settings(app) {
  const { state, fields } = app;
  const { h, card } = fields;
  const few = fields.numberField({
    path: "material.modes",
    label: "Largest number of modes",
    min: 1,
    max: 200,
    step: 1,
    placeholder: "automatic",
  });
  const ratio = fields.numberField({
    path: "material.tau_ratio",
    label: "Ratio of neighbouring times",
    min: 1.1,
    max: 100,
    placeholder: "e = 2.718",
  });
  const kind = fields.choiceField({
    path: "material.spectrum",
    label: "Fit method",
    options: KINDS,
    otherwise: "non-negative",
    onChange: (value) =>
      state.change({
        "material.spectrum": value === "non-negative" ? undefined : value,
        ...(value === "sparse" ? { "material.tau_ratio": undefined } : { "material.modes": undefined }),
      }),
    help: "Non-negative modes have the smallest misfit; regularised ones make a smooth spectrum; sparse ones are few, for finite elements.",
  });
  const draws = fields.numberField({
    path: "uncertainty.draws",
    label: "Bootstrap samples for the 95 % band",
    min: 0,
    max: 10000,
    step: 1,
    placeholder: "200",
    help: "Refits to resampled data; 0 for no band.",
  });
  const fitted = h("div", { class: "panel" }, kind, few, ratio, draws);
  const ready = h("p", { class: "help" }, "A predefined material has its own spectrum.");
  const refresh = () => {
    const source = sourceOf(state.get("material"));
    fitted.hidden = source === "catalogue" || source === "file" || source === null;
    ready.hidden = !fitted.hidden;
    few.hidden = state.get("material.spectrum") !== "sparse";
    ratio.hidden = !few.hidden;
  };
  state.subscribe("material", refresh);
  refresh();
  return card("Spectrum", fitted, ready);
}

/** Slider and box of the temperature that E(ω) is shown at. */
export function temperatureChoice({ fields, units }, onChange) {
  const { h } = fields;
  const slider = h("input", { type: "range", id: "modulus-temperature", step: 1 });
  const shown = h("output", { for: "modulus-temperature", class: "field-label" });
  const said = h("p", { class: "help", "aria-live": "polite" });
  let chosen = null; // K; null is the reference
  let reference = null;
  let timer = null;
  const showTemperature = () => (shown.textContent = units.show(chosen ?? reference, "temperature"));
  slider.addEventListener("input", () => {
    chosen = Number(slider.value);
    showTemperature();
    clearTimeout(timer);
    timer = setTimeout(() => onChange(chosen), WAIT);
  });
  const back = fields.button({ label: "At the reference", kind: "small", onClick: () => reset() });
  const reset = () => {
    chosen = null;
    slider.value = reference;
    showTemperature();
    onChange(null);
  };
  const element = h(
    "div",
    { class: "field" },
    h("label", { class: "field-label", for: "modulus-temperature" }, "Temperature"),
    h("div", { class: "slider-row" }, slider, shown, back),
    said,
  );
  element.kelvin = () => chosen;
  element.note = (words, wrong) => {
    said.textContent = words;
    said.classList.toggle("field-error", Boolean(wrong));
  };
  element.show = (result) => {
    element.hidden = !result.shift;
    if (!result.shift) return (chosen = null);
    reference = result.spectrum.reference;
    const line = result.shift.material.line.temperature;
    slider.min = 273.15 + Math.ceil(line[0] - 273.15);
    slider.max = 273.15 + Math.floor(line.at(-1) - 273.15);
    slider.step = 1;
    if (chosen !== null && (chosen < line[0] || chosen > line.at(-1))) chosen = null;
    slider.value = chosen ?? reference;
    showTemperature();
  };
  return element;
}
