// Colours of figures, light and dark, and one look for each temperature: blue where cold, red where warm.

import { lasting, signal } from "./reactive.js";

// Okabe and Ito's colours, cold to warm, as in the reports; [on light, on dark]
const HUES = {
  blue: ["#0072b2", "#56a9e0"],
  sky: ["#3f9fd8", "#8fd0f7"],
  green: ["#009e73", "#3cc79d"],
  orange: ["#d38f00", "#f0b73c"],
  vermilion: ["#d55e00", "#ff8a4a"],
  red: ["#a31f34", "#f2707f"],
  purple: ["#b5528c", "#e39ac5"],
  grey: ["#8a949e", "#8a949e"],
};
const WARMER = Object.keys(HUES).slice(0, 6);
const BY_COUNT = ["0", "04", "024", "0234", "01234", "012345"]; // places in WARMER of so many temperatures
const SCALE = [["#16306b", "#5a7fe0"], HUES.blue, HUES.green, HUES.orange, HUES.vermilion, ["#8f1230", "#ff5d77"]];
const SYMBOLS = ["circle", "square", "triangle-up", "diamond", "triangle-down", "pentagon", "x"];
const DASHES = ["solid", "9px,3px", "3px,3px", "9px,3px,3px,3px"];
export const ORDER = ["blue", "vermilion", "green", "purple", "orange", "sky"]; // of curves that say nothing

const darkSystem = matchMedia("(prefers-color-scheme: dark)");
const chosenTheme = lasting("localStorage", "viscofric.theme", null); // none: as the system; see theme.js
const systemIsDark = signal(darkSystem.matches);
darkSystem.addEventListener("change", () => (systemIsDark.value = darkSystem.matches));

/** Whether the page is dark now. */
export const isDark = () => (chosenTheme.value ? chosenTheme.value === "dark" : systemIsDark.value);

/** Have the page "light" or "dark", also after a reload. */
export const chooseTheme = (theme) => (chosenTheme.value = document.documentElement.dataset.theme = theme);

const parts = (colour) => [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));

function mixed(one, other, share) {
  const [from, to] = [parts(one), parts(other)];
  const hex = (value) => Math.round(value).toString(16).padStart(2, "0");
  return `#${from.map((value, at) => hex(value + share * (to[at] - value))).join("")}`;
}

export const faded = (colour, share) => `rgba(${parts(colour)},${share})`;

/** Colour of a named hue on the page's background: hue("blue"). */
export const hue = (name, dark = isDark()) => HUES[name]?.[dark ? 1 : 0] ?? name;

const distinct = (all) =>
  [...new Set(all.map((kelvin) => Math.round(kelvin * 10) / 10))].sort((one, other) => one - other);

/** The ends of temperatures that are too many for a legend, and the colours between them; null of a few. */
export function scaleOf(all, dark) {
  const sorted = distinct(all);
  if (sorted.length <= BY_COUNT.length) return null;
  const colours = SCALE.map((both, at) => [at / (SCALE.length - 1), both[dark ? 1 : 0]]);
  return { ends: [sorted[0], sorted.at(-1)], colours };
}

/** One colour per temperature, blue where cold and red where warm; `all` are those that are shown together. */
export function temperatureColour(kelvin, all = [kelvin], dark = isDark()) {
  const sorted = distinct([...all, kelvin]);
  const scale = scaleOf(sorted, dark);
  if (!scale) return hue(WARMER[BY_COUNT[sorted.length - 1][sorted.indexOf(Math.round(kelvin * 10) / 10)]], dark);
  const [low, high] = scale.ends;
  const place = ((kelvin - low) / (high - low)) * (SCALE.length - 1);
  const at = Math.min(Math.max(Math.floor(place), 0), SCALE.length - 2);
  return mixed(scale.colours[at][1], scale.colours[at + 1][1], Math.min(Math.max(place - at, 0), 1));
}

/** Colour, symbol and dashes of a temperature, which differ in grey, too. */
export function temperatureLook(kelvin, all = [kelvin], dark = isDark()) {
  const rank = distinct([...all, kelvin]).indexOf(Math.round(kelvin * 10) / 10);
  const colour = temperatureColour(kelvin, all, dark);
  return { colour, symbol: SYMBOLS[rank % SYMBOLS.length], dash: DASHES[rank % DASHES.length] };
}

export const colours = (dark) =>
  dark
    ? { ink: "#e4e8ec", quiet: "#a0abb5", line: "#343c44", paper: "#1b2025", hover: "#2a3138" }
    : { ink: "#1d2329", quiet: "#5b6570", line: "#dfe3e7", paper: "#ffffff", hover: "#ffffff" };
