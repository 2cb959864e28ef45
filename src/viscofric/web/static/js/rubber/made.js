// The rubber of the study, computed when it is first needed and again after each change of [material]; for several steps.
//
// follow(app, callback)   callback({running, words, error, result, complete}) now and whenever that changes; `result` is
//                         the job's (jobs/rubber.py), without its bands until `complete`
// and what else the steps about the rubber share

import { DEPENDS_ON } from "../inputs.js";

const WAIT = 150; // ms after the last change

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

let now = { running: false, words: "", error: null, result: null, complete: false };
const followers = new Set();
let started = false;
let timer = null;
let running = null;

export function follow(app, callback) {
  followers.add(callback);
  if (!started) {
    started = true;
    app.state.subscribe(DEPENDS_ON.rubber, () => {
      clearTimeout(timer);
      timer = setTimeout(() => make(app), WAIT);
    });
    make(app);
  }
  callback(now);
  return () => followers.delete(callback);
}

function become(changes) {
  now = { ...now, ...changes };
  for (const callback of [...followers]) callback(now);
}

async function make(app) {
  running?.abort();
  const mine = new AbortController();
  running = mine;
  const { material, uncertainty } = app.state.study;
  if (!sourceOf(material)) return become({ running: false, error: null, result: null, complete: false, words: "" });
  become({ running: true, words: "Fitting the material", complete: false });
  if (app.state.result("rubber")) app.state.setResult("rubber", null); // it was another rubber's
  app.fields.clearError("rubber");
  const take = (result, complete) => {
    if (running === mine)
      become({ result: Object.assign(result, { made_of: material }), complete, error: null, running: !complete });
  };
  try {
    const study = uncertainty === undefined ? { material } : { material, uncertainty };
    const result = await app.api.runJob(
      "rubber",
      { study, options: {} },
      {
        signal: mine.signal,
        onPart: (part) => take(part, false),
        onProgress: ({ label }) => running === mine && become({ words: label }),
      },
    );
    take(result, true);
    if (running === mine) app.state.setResult("rubber", now.result);
  } catch (error) {
    if (running !== mine || error.name === "AbortError") return;
    app.fields.showError(error, "rubber");
    app.state.setResult("rubber", null);
    become({ running: false, error, result: null, complete: false });
  }
}

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
