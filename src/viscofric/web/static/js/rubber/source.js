// The material of the study: what becomes of [material] when files are brought, chosen or removed; and the job that makes it when
// it is first needed and again after each change, with what else the steps about it share.

import * as api from "../api.js";
import { Job } from "../jobs.js";
import { attempts, page, sourceKey, sources } from "../page.js";
import { state } from "../state.js";
import * as units from "../units.js";

/** Sources that are tests; files of them are sorted by what they hold, and sweeps and step tests go together. */
export const TESTS = ["dma", "creep", "relaxation", "ramps"];

/** The reference of sweeps until the user, or the sweeps themselves, say another. */
export const FIRST_REFERENCE = "30 degC";

/** Whether the rubber is made of measurements; a predefined one has its own shift factors and spectrum. */
export const isMade = () => ![null, "catalogue", "file"].includes(sourceKey(state.get("material")));

/** The job that makes the material; its part is the material without its bands. */
export const rubber = new Job("rubber", {
  remember: 6,
  inputs: () => {
    const { material, uncertainty, data_origin } = state.study;
    return sourceKey(material) ? { study: { material, uncertainty, data_origin } } : null;
  },
});

/** What stands in an empty figure: these words, or that the error above says why there is none. */
export const emptyOf = (words, job = rubber) => (job.error ? "No figure yet: see the message above." : words);

/** "60 °C", as the user's units have it. */
export const named = (kelvin) => units.show(kelvin, "temperature");

/** A temperature as a run file writes it, near enough to name one isotherm. */
export const worded = (kelvin) => `${Number((kelvin - 273.15).toFixed(2))} degC`;

/** "0.12 decades" */
export const decades = (value, digits = 2) => `${value.toFixed(digits).replace("-", "−")} decades`;

const OF_FILES = ["deformation", "modulus_unit", "columns", "sheet", "temperature", "leave_out_temperatures", "assumed_shift"];
const OF_SHIFTS = ["fixed_shift_factors", "shift_factors", "shift_factor_columns", "shift_factor_sheet"];

/** [material] of other files: what says how a rubber is made stays, what belonged to the old files goes. */
function materialOf(source, value, before = {}) {
  const kept = Object.entries(before).filter(
    ([key]) => !sources().some(([source_]) => source_ === key) && ![...OF_FILES, ...OF_SHIFTS].includes(key),
  );
  if (source === "catalogue" || source === "file") {
    const stays = ["name", "amplitude_sweep", "strain", "measured_at"];
    return { [source]: value, ...Object.fromEntries(kept.filter(([key]) => stays.includes(key))) };
  }
  const rest = Object.fromEntries(kept);
  const gone = [
    ...(source === "master_curve" || source === "ramps" ? ["vertical_shift", "shift"] : []),
    ...(source === "dma" ? [] : ["shift_by", "shift_weights"]),
  ];
  for (const key of gone) delete rest[key];
  return { reference_temperature: FIRST_REFERENCE, ...rest, [source]: value };
}

const one = (names) => (Array.isArray(names) && names.length === 1 ? names[0] : names);
const first = () => [state.get("material") ?? {}].flat()[0];
const inOrder = new Intl.Collator("en", { numeric: true }).compare;

/** What a study calls the rubber of some files: the first one's name without its ending. */
const calledAfter = (value) => {
  const names = [value].flat();
  return names.length > 1 ? `${names.length} sweep files` : names[0].replace(/\.[A-Za-z0-9]{1,9}$/, "");
};

/** The source that is looked at: the one chosen last, or that of the material. */
export const shownSource = () => state.view("sweeps.source", sourceKey(state.get("material")) ?? "dma");

const [attempt, failed] = attempts();
export { failed };

/** Have another source; with it `beside`, other keys. */
export function choose(source, value, { origin, ...beside } = {}) {
  const single = one(value);
  const [before, ...others] = [state.get("material")].flat();
  const material = { ...materialOf(source, single, before), ...beside };
  // The title that the page began with is not that of another rubber.
  const title = state.get("title") === page.start.study.title ? `Friction of ${calledAfter(single)}` : state.get("title");
  state.change({ material: others.length ? [material, ...others] : material, data_origin: origin, title });
}

/** Names of all files of a key of [material]. */
export const filesOf = (key) => [first()[key] ?? []].flat();

/** Upload files of tests; {key of [material]: names}, and the origin of data that say that they were made up.
    A file that is not recognised belongs to the source that is chosen. */
async function sorted(files) {
  const names = (await api.uploadFiles(files)).sort(inOrder);
  let kinds, synthetic;
  try {
    ({ kinds, synthetic } = await api.runJob("recognise", { options: { files: names } }));
  } catch {
    kinds = { [TESTS.includes(shownSource()) ? shownSource() : "dma"]: names }; // reading it says what is wrong
  }
  // an amplitude sweep is no source: it stays with the material, which may be scaled to a strain by it
  const { amplitude, ...others } = kinds;
  if (amplitude) state.set("material.amplitude_sweep", one(amplitude));
  return { kinds: others, origin: synthetic ? "synthetic" : undefined };
}

/** Tests of another rubber. */
export const takeTests = (files) =>
  attempt(async () => {
    const { kinds, origin } = await sorted(files);
    const [source, ...others] = TESTS.filter((key) => kinds[key]);
    const beside = Object.fromEntries(others.map((key) => [key, one(kinds[key])]));
    if (source) choose(source, kinds[source], { origin, ...beside });
    else if (origin) state.set("data_origin", origin);
  });

/** More tests of the same specimen. */
export const addTests = (files) =>
  attempt(async () => {
    const { kinds, origin } = await sorted(files);
    const more = Object.entries(kinds).map(([key, names]) => [
      `material.${key}`,
      one([...new Set([...filesOf(key), ...names])].sort(inOrder)),
    ]);
    if (more.length || origin) state.change({ ...Object.fromEntries(more), ...(origin && { data_origin: origin }) });
  });

/** The one file of a source. */
export const takeFile = (source, files) =>
  attempt(async () => choose(source, (await api.uploadFiles(files.slice(0, 1)))[0]));

/** Shift factors from a file. */
export const takeFactors = (files) =>
  attempt(async () => {
    const [name] = await api.uploadFiles(files.slice(0, 1));
    state.change({ "material.shift_factors": name, "material.fixed_shift_factors": undefined });
  });

export const useExample = () =>
  attempt(async () => {
    await api.useExample();
    choose("dma", "dma.csv", { origin: "synthetic" });
  });

/** Have these files alone; temperatures of files that do not state them were those of all. */
export const use = (names, key = "dma") =>
  state.change({ [`material.${key}`]: names.length ? one(names) : undefined, "material.temperature": undefined });

export const remove = (key, name) =>
  use(
    filesOf(key).filter((other) => other !== name),
    key,
  );
