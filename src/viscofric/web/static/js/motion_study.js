// The history of the study ([history] in the run file): set from this step, shown in it, edited or removed.

import { runJob } from "./api.js";
import { Form } from "./fields.js";
import { attempts, explain, page } from "./page.js";
import { html, view } from "./reactive.js";
import { state } from "./state.js";
import { Button, Folded, Notes } from "./views.js";

const [attempt, failed] = attempts();

/** Part of the card; `rows()` returns the history of the step, `take(found)` shows another one in the step. */
export const StudyHistory = view(({ rows, take }) => {
  const has = state.get("history") !== undefined;
  const ask = (options, then) =>
    attempt(async () => then(await runJob("history", { study: state.study, options })));
  const put = ({ history }) => {
    if (history.file) state.renew([history.file]);
    state.set("history", history);
    return "The study has this history.";
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
    <${Notes} kind="error" list=${[failed.value && explain(failed.value, "motion")]} />
    <${Form} of=${page.start.forms.history} />
  <//>`;
});
