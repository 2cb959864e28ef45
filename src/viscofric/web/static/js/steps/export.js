// Step 6: what is taken away; its parts are loaded when it is looked at.

export default {
  id: "export",
  title: "Export",
  summary(state) {
    const done = state.result("export");
    const cases = state.result("run_file")?.cases;
    if (done) return `${done.cases} cases, results ready`;
    return cases ? `run file: ${cases} case${cases === 1 ? "" : "s"}` : "";
  },
  async mount(section, app) {
    (await import("./export_view.js")).show(section, app);
  },
};
