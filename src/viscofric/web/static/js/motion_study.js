// The history of the study ([history] in the run file): set from this step, shown in it, edited or removed.

import { runJob } from "./api.js";
import { Amount, Form, within } from "./fields.js";
import { announce, explain } from "./page.js";
import { html, signal, view } from "./reactive.js";
import { state } from "./state.js";
import * as units from "./units.js";
import { Button, Folded, Notes } from "./views.js";

const DWELLS = {
  path: "history.dwell",
  label: "Dwell, one or several",
  placeholder: "0 s",
  read: (text) => {
    const found = text.split(/[,;]/).map((one) => units.typed(one, "time"));
    return found.length > 1 ? found : found[0];
  },
  write: (value) => [value ?? []].flat().join(", "),
};
const FIELDS = within(
  "history",
  { path: "history.load_time", label: "Time to load", kind: "time", placeholder: "0 s" },
  DWELLS,
  { path: "history.slide", label: "Path of a stroke", kind: "length", placeholder: "no sliding" },
  { as: Amount, path: "history.strokes", label: "Strokes", min: 1, step: 1, placeholder: "1" },
  { path: "history.file", label: "Table instead", placeholder: "none" },
  { as: Amount, path: "history.points", label: "Stored times", min: 2, step: 1, placeholder: "200" },
);
const error = signal(null);

/** Part of the card; `rows()` returns the history of the step, `take(found)` shows another one in the step. */
export const StudyHistory = view(({ rows, take }) => {
  const has = state.get("history") !== undefined;
  const ask = async (options, then) => {
    error.value = null;
    try {
      then(await runJob("history", { study: state.study, options }));
    } catch (found) {
      error.value = found;
    }
  };
  const put = ({ history }) => {
    if (history.file) state.renew([history.file]);
    state.set("history", history);
    announce("The study has this history.");
  };
  const words = has
    ? "Export and viscofric run also solve the study over time; stages use its loads and speeds."
    : "“Use in the study” adds this history to the run file; Export and viscofric run then also solve over time.";
  const remove = () => state.set("history", undefined);
  return html`<${Folded} title="History of the study">
    <p class="help">${words}</p>
    <div class="row">
      <${Button} kind="small" onClick=${() => ask(rows(), put)}>Use in the study<//>
      ${has && html`<${Button} kind="small" onClick=${() => ask({}, take)}>Show the study’s<//>`}
      ${has && html`<${Button} kind="quiet small" onClick=${remove}>Remove from the study<//>`}
    </div>
    <${Notes} kind="error" list=${[error.value && explain(error.value, "motion")]} />
    <${Form} of=${FIELDS} />
  <//>`;
});
