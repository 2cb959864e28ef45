// Step 1: where the rubber comes from. What it shows is loaded when it is first opened.

export default {
  id: "sweeps",
  title: "Data",
  summary(state) {
    const material = state.get("material") ?? {};
    const source = ["dma", "master_curve", "file", "catalogue"].find((key) => material[key] !== undefined);
    const value = material[source];
    if (!source) return "no rubber yet";
    return Array.isArray(value) && value.length > 1 ? `${value.length} files` : String(value);
  },
  async mount(section, app) {
    try {
      (await import("../rubber/sweeps.js")).mount(section, app);
    } catch (error) {
      console.error(error);
      section.append(app.fields.note([`This step could not be shown: ${error.message}`], "error"));
    }
  },
};
