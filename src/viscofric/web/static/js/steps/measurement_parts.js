// Parts of the measurement step: one computation after another, and inputs that are no part of the study.

/**
 * A job that is run again and again: the last one counts, the others are cancelled.
 *
 * @param {object} app
 * @param {string} kind of the job
 * @param {{label: string, done: (result: object) => void, failed: (message: string) => void}} about
 */
export function repeated(app, kind, { label, done, failed }) {
  let running = null;
  const bar = app.fields.progressBar({ label, onCancel: () => running?.abort() });
  const errors = app.fields.note([], "error");
  errors.setAttribute("aria-live", "assertive");

  async function run(study, options = {}) {
    running?.abort();
    const own = new AbortController();
    running = own;
    errors.set([]);
    app.fields.clearError(kind);
    bar.start();
    try {
      const onProgress = (progress) => own === running && bar.set(progress.done, progress.total, progress.label);
      const result = await app.api.runJob(kind, { study, options }, { onProgress, signal: own.signal });
      if (own !== running) return;
      bar.finish();
      done(result);
    } catch (error) {
      if (own !== running) return;
      bar.finish(error.name === "AbortError" ? "Cancelled." : "");
      if (error.name === "AbortError") return;
      app.fields.showError(error, kind);
      const message = error.message.charAt(0).toUpperCase() + error.message.slice(1);
      errors.set([app.explain({ ...error, message }, "measurement")]);
      failed?.(error);
    }
  }

  function stop() {
    running?.abort();
    running = null;
    bar.finish();
    errors.set([]);
  }

  return { run, stop, bar, errors };
}

let made = 0;

/** A text box for a choice that is no part of the study; it is kept over reloads. A bare number gets the user's unit. */
export function optionField(app, { key, label, help, kind, placeholder }) {
  const { h } = app.fields;
  const id = `option-${(made += 1)}`;
  const input = h("input", {
    type: "text",
    id,
    placeholder,
    autocomplete: "off",
    spellcheck: "false",
    "aria-describedby": help ? `${id}-help` : undefined,
  });
  input.value = app.state.view(key, "");
  const value = () => app.units.typed(input.value, kind);
  input.addEventListener("change", () => app.state.setView(key, input.value.trim()));
  const element = h(
    "div",
    { class: "field" },
    h("label", { for: id, class: "field-label" }, label),
    input,
    help ? h("p", { class: "help", id: `${id}-help` }, help) : null,
  );
  return Object.assign(element, { value, input });
}

/** A choice that is no part of the study: chosen.value(), kept over reloads. */
export function optionChoice(app, { key, label, help, options, onChange }) {
  const { h } = app.fields;
  const id = `option-${(made += 1)}`;
  const select = h(
    "select",
    { id },
    options.map(([value, text]) => h("option", { value }, text)),
  );
  select.value = app.state.view(key, options[0][0]);
  if (select.selectedIndex < 0) select.selectedIndex = 0;
  select.addEventListener("change", () => {
    app.state.setView(key, select.value);
    onChange?.(select.value);
  });
  const element = h(
    "div",
    { class: "field" },
    h("label", { for: id, class: "field-label" }, label),
    select,
    help ? h("p", { class: "help" }, help) : null,
  );
  return Object.assign(element, {
    value: () => select.value,
    choose: (value) => ((select.value = value), app.state.setView(key, value)),
    select,
  });
}

/** Names and values as a list of definitions. */
export function definitions(app) {
  const { h } = app.fields;
  const element = h("dl", { class: "facts" });
  element.set = (pairs = []) => {
    element.replaceChildren(...pairs.flatMap(({ name, value }) => [h("dt", {}, name), h("dd", {}, value)]));
    element.hidden = pairs.length === 0;
  };
  element.set();
  return element;
}

/** What was checked, each with its verdict. */
export function checkList(app) {
  const { h } = app.fields;
  const element = h("ul", { class: "checks" });
  element.set = (checks = []) => {
    const one = ({ name, verdict, words }) =>
      h("li", { class: verdict.replaceAll(" ", "-") }, h("strong", {}, `${name}: ${verdict}. `), words);
    element.replaceChildren(...checks.map(one));
    element.hidden = checks.length === 0;
  };
  element.set();
  return element;
}

/** Something that is folded until it is opened. */
export function folded(app, title, ...children) {
  const { h } = app.fields;
  return h("details", {}, h("summary", {}, title), h("div", { class: "step-body" }, children));
}
