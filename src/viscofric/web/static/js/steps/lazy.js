// What the list of steps says of those that are loaded when they are first opened, and where they are then found.

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

function superposition(state) {
  const result = state.result("rubber");
  if (!result) return "";
  if (!result.shift) return "no shift with temperature";
  return result.check?.short ?? (result.shift.used === "assumed" ? "assumed law" : "from the material file");
}

function modes(state) {
  const spectrum = state.result("rubber")?.spectrum;
  if (!spectrum) return "";
  return spectrum.modes ? `${spectrum.modes.retardation_time.length} modes` : "a table of moduli";
}

function motion(state) {
  const result = state.result("motion");
  if (!result) return "";
  if (result.contacts) return `restitution ${result.contacts[0].restitution.toPrecision(2)}`;
  return `${result.time.length} times${result.interrupted ? ", stopped" : ""}`;
}

function agreement(state) {
  const result = state.result("measured");
  if (!result?.curves) return result?.refusal ? "not separated" : "";
  const rms = state.result("agreement")?.key?.[0]?.value;
  return `${result.points} points${rms ? `, predicted to ${rms}` : ""}`;
}

function results(state) {
  const done = state.result("export");
  const cases = state.result("run_file")?.cases;
  if (done) return `${done.cases} cases, results ready`;
  return cases ? `run file: ${cases} case${cases === 1 ? "" : "s"}` : "";
}

export const sweeps = later("sweeps", "Data", source, "../rubber/sweeps.js");
export const shift = later("shift", "Shift", superposition, "../rubber/shift.js");
export const spectrum = later("spectrum", "Spectrum", modes, "../rubber/spectrum.js");
export const moving = later("motion", "Motion in time", motion, "./motion.js");
export const measurement = later("measurement", "Measurement", agreement, "./measurement_view.js");
export const exported = later("export", "Export", results, "./export_view.js", "show");
