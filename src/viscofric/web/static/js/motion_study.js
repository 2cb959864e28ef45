// The history of the study ([history] in the run file): set from this step, shown in it, edited or removed.

import { effect } from "./reactive.js";

/** Part of the card; `rows()` returns the history of the step, `take(found)` shows another one in the step. */
export function studyHistory({ state, fields, units, api, explain, announce }, { rows, take }) {
  const { h, button } = fields;
  const failed = fields.note([], "error");
  const ask = async (options, then) => {
    failed.set([]);
    try {
      then(await api.runJob("history", { study: state.study, options }));
    } catch (error) {
      failed.set([explain(error, "motion")]);
    }
  };
  const use = button({
    label: "Use in the study",
    kind: "small",
    onClick: () =>
      ask(rows(), ({ history }) => {
        if (history.file) state.renew([history.file]);
        state.set("history", history);
        announce("The study has this history.");
      }),
  });
  const show = button({ label: "Show the study’s", kind: "small", onClick: () => ask({}, take) });
  const remove = button({
    label: "Remove from the study",
    kind: "quiet small",
    onClick: () => state.set("history", undefined),
  });
  const time = (path, label, help) => fields.quantityField({ path, label, help, kind: "time", placeholder: "0 s" });
  const dwells = fields.textField({
    path: "history.dwell",
    label: "Dwell, one or several",
    placeholder: "0 s",
    read: (text) => {
      const found = text.split(/[,;]/).map((one) => units.typed(one, "time"));
      return found.length > 1 ? found : found[0];
    },
    write: (value) => [value ?? []].flat().join(", "),
  });
  const form = h(
    "div",
    { class: "form" },
    time("history.load_time", "Time to load"),
    dwells,
    fields.quantityField({
      path: "history.slide",
      label: "Path of a stroke",
      kind: "length",
      placeholder: "no sliding",
    }),
    fields.numberField({ path: "history.strokes", label: "Strokes", min: 1, step: 1, placeholder: "1" }),
    fields.textField({ path: "history.file", label: "Table instead", placeholder: "none" }),
    fields.numberField({ path: "history.points", label: "Stored times", min: 2, step: 1, placeholder: "200" }),
  );
  const words = h("p", { class: "help" });
  const refresh = () => {
    const has = state.get("history") !== undefined;
    form.hidden = show.hidden = remove.hidden = !has;
    words.textContent = has
      ? "Export and viscofric run also solve the study over time; stages use its loads and speeds."
      : "“Use in the study” adds this history to the run file; Export and viscofric run then also solve over time.";
  };
  effect(refresh);
  const head = h("summary", {}, "History of the study");
  return h(
    "details",
    {},
    head,
    h("div", { class: "stack" }, words, h("div", { class: "row" }, use, show, remove), failed, form),
  );
}
