// Step 2: isotherms shifted onto one another. What it shows is loaded when it is first opened.

export default {
  id: "shift",
  title: "Shift",
  summary(state) {
    const answer = state.result("rubber");
    if (!answer) return "";
    if (!answer.shift) return "no shift with temperature";
    return answer.check ? answer.check.headline.replace(/^Superposition /, "") : "as the rubber says";
  },
  async mount(section, app) {
    try {
      (await import("../rubber/shift.js")).mount(section, app);
    } catch (error) {
      console.error(error);
      section.append(app.fields.note([`This step could not be shown: ${error.message}`], "error"));
    }
  },
};
