// Step 3: the spectrum and the modulus. What it shows is loaded when it is first opened.

export default {
  id: "spectrum",
  title: "Spectrum",
  summary(state) {
    const spectrum = state.result("rubber")?.spectrum;
    if (!spectrum) return "";
    return spectrum.modes ? `${spectrum.modes.tau.length} modes` : "a table of moduli";
  },
  async mount(section, app) {
    try {
      (await import("../rubber/spectrum.js")).mount(section, app);
    } catch (error) {
      console.error(error);
      section.append(app.fields.note([`This step could not be shown: ${error.message}`], "error"));
    }
  },
};
