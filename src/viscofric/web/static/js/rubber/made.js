// The rubber of the study, computed when it is first needed and again after each change of [material]; for several steps.
// And what else the steps about the rubber share.

import { Job } from "../jobs.js";
import { state } from "../state.js";

export const SOURCES = [
  ["dma", "Sweeps of a DMA or rheometer"],
  ["creep", "Creep tests"],
  ["relaxation", "Relaxation tests"],
  ["ramps", "Temperature ramps"],
  ["master_curve", "A master curve"],
  ["file", "A material file or a card"],
  ["catalogue", "The catalogue"],
];

/** Sources that are tests; files of them are sorted by what they hold, and sweeps and step tests go together. */
export const TESTS = ["dma", "creep", "relaxation", "ramps"];

/** The reference of sweeps until the user, or the sweeps themselves, say another. */
export const FIRST_REFERENCE = "30 degC";

/** Where the rubber of [material] comes from. */
export const sourceOf = (material) =>
  SOURCES.map(([key]) => key).find((key) => [material].flat()[0]?.[key] !== undefined) ?? null;

/** The job that makes the material; its part is the material without its bands. */
export const rubber = new Job("rubber", {
  remember: 6,
  inputs: () => {
    const { material, uncertainty } = state.study;
    if (!sourceOf(material)) return null;
    return { study: uncertainty === undefined ? { material } : { material, uncertainty } };
  },
});

/** What is shown of it: also that of earlier inputs, while another one is made. */
export const shownRubber = () => (rubber.error ? null : rubber.result);

/** "60 °C", as the user's units have it. */
export const named = (kelvin, { units }) => units.show(kelvin, "temperature");

/** A temperature as a run file writes it, near enough to name one isotherm. */
export const worded = (kelvin) => `${Number((kelvin - 273.15).toFixed(2))} degC`;

/** What is said below a figure whose curves are coloured by temperature. */
export function byTemperature(temperatures, { units }) {
  if (temperatures.length < 2) return "";
  const [low, high] = [Math.min(...temperatures), Math.max(...temperatures)];
  return `Colours show the temperature: blue is ${units.show(low, "temperature")}, red ${units.show(high, "temperature")}.`;
}

/** Whether so few temperatures are drawn that a legend can name them. */
export const fewEnough = (temperatures) => temperatures.length <= 8;

/** A row of buttons of which one is pressed: pick({label, options: [[value, text]], value, onChange}). */
export function pick({ label, options, value, onChange }, { h }) {
  const buttons = options.map(([one, text]) =>
    h("button", { type: "button", class: "button small", onclick: () => choose(one, true) }, text),
  );
  const choose = (wanted, byUser) => {
    options.forEach(([one], at) => {
      buttons[at].setAttribute("aria-pressed", String(one === wanted));
      buttons[at].classList.toggle("main", one === wanted);
    });
    if (byUser) onChange(wanted);
  };
  const element = h("div", { class: "row", role: "group", "aria-label": label }, buttons);
  element.choose = choose;
  choose(value, false);
  return element;
}

/** Whether figures of a result say that it is made up. */
export const synthetic = (result, { state }) => result.synthetic || state.get("data_origin") === "synthetic";

/** "0.12 decades" */
export const decades = (value, digits = 2) => `${value.toFixed(digits).replace("-", "−")} decades`;
