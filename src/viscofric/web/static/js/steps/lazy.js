// What the list of steps says of those that are loaded when they are first opened, and where they are then found.

import { newest, result } from "../jobs.js";

/** A step whose module is fetched when somebody looks at it; one that cannot be had says so, and leaves the others alone. */
const later = (id, title, summary, module, show = "mount") => ({
  id,
  title,
  summary,
  async mount(section, app) {
    try {
      (await import(module))[show](section, app);
    } catch (error) {
      console.error(error);
      section.append(app.fields.note([`This step could not be shown: ${error.message}`], "error"));
    }
  },
});

function source(state) {
  const rubbers = [state.get("material") ?? {}].flat();
  if (rubbers.length > 1) return `${rubbers.length} materials`;
  const value = ["dma", "creep", "relaxation", "ramps", "master_curve", "file", "catalogue"]
    .map((key) => rubbers[0][key])
    .find((one) => one !== undefined);
  if (value === undefined) return "no material yet";
  return Array.isArray(value) && value.length > 1 ? `${value.length} files` : String(value);
}

function superposition() {
  const rubber = result("rubber");
  if (!rubber) return "";
  if (!rubber.shift) return "no shift with temperature";
  return rubber.check?.short ?? (rubber.shift.used === "assumed" ? "assumed law" : "from the material file");
}

function modes() {
  const spectrum = result("rubber")?.spectrum;
  if (!spectrum) return "";
  return spectrum.modes ? `${spectrum.modes.retardation_time.length} modes` : "a table of moduli";
}

function motion() {
  const solved = result("motion");
  if (!solved) return "";
  if (solved.contacts) return `restitution ${solved.contacts[0].restitution.toPrecision(2)}`;
  return `${solved.time.length} times${solved.interrupted ? ", stopped" : ""}`;
}

function agreement() {
  const measured = result("measured");
  if (!measured?.curves) return measured?.refusal ? "not separated" : "";
  const rms = result("agreement")?.key?.[0]?.value;
  return `${measured.points} points${rms ? `, predicted to ${rms}` : ""}`;
}

function results() {
  const done = result("export-study");
  const cases = newest("export-run-file")?.cases;
  if (done) return `${done.cases} cases, results ready`;
  return cases ? `run file: ${cases} case${cases === 1 ? "" : "s"}` : "";
}

export const sweeps = later("sweeps", "Data", source, "../rubber/sweeps.js");
export const shift = later("shift", "Shift", superposition, "../rubber/shift.js");
export const spectrum = later("spectrum", "Spectrum", modes, "../rubber/spectrum.js");
export const moving = later("motion", "Motion in time", motion, "./motion.js");
export const measurement = later("measurement", "Measurement", agreement, "./measurement_view.js");
export const exported = later("export", "Export", results, "./export_view.js", "show");
