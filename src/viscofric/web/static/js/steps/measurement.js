// Step 5: measured friction beside the prediction, its master curve, and the rubber behind it.
//
// Its parts are loaded when somebody looks at them: measurement_view.js puts them together.

export default {
  id: "measurement",
  title: "Measurement",
  summary(state) {
    const result = state.result("measured");
    if (!result?.curves) return result?.refusal ? "not separated" : "";
    const rms = state.result("agreement")?.key?.[0]?.value;
    return `${result.points} points${rms ? `, predicted to ${rms}` : ""}`;
  },
  async mount(section, app) {
    try {
      const { mount } = await import("./measurement_view.js");
      mount(section, app);
    } catch (error) {
      console.error(error);
      section.append(app.fields.note([`This step could not be shown: ${error.message}`], "error"));
    }
  },
};
