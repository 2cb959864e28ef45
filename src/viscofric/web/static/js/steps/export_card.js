// The rubber as a card for finite-element programs; and how texts are copied and files are fetched.

import { Job } from "../jobs.js";
import { effect, signal, watch } from "../reactive.js";
import { state } from "../state.js";

const PROGRAMS = [
  ["abaqus", "Abaqus"],
  ["ansys", "ANSYS"],
  ["ls-dyna", "LS-DYNA"],
  ["comsol", "COMSOL, parameters"],
  ["comsol-branches", "COMSOL, table of branches"],
  ["json", "viscofric (JSON)"],
  ["csv", "table (CSV)"],
];
const LAWS = [
  ["", "that of the material"],
  ["best", "the best law"],
  ["wlf", "WLF"],
  ["arrhenius", "Arrhenius"],
];
const SYSTEMS = [
  ["Pa", "Pa, m, s, kg"],
  ["MPa", "MPa, mm, s, t"],
];
const TEMPERATURES = [
  ["K", "kelvin"],
  ["degC", "°C"],
];
const DOMAINS = [
  ["time", "time (Prony series)"],
  ["frequency", "frequency"],
];
const FIRST = { program: "abaqus", system: "Pa", temperature: "K", domain: "time", law: "", poisson: "", density: "" };
const WITH_UNITS = ["abaqus", "ansys", "ls-dyna"];
const size = (bytes) => (bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1e3))} kB` : `${(bytes / 1e6).toFixed(1)} MB`);

/** Copies a text, and says so. */
export function copyButton(app, text) {
  const { button } = app.fields;
  const copy = button({
    label: "Copy",
    symbol: "copy",
    kind: "small",
    onClick: async () => {
      try {
        await navigator.clipboard.writeText(text());
        app.announce("Copied.");
        copy.lastChild.textContent = "Copied";
      } catch {
        copy.lastChild.textContent = "Select and copy it";
      }
      setTimeout(() => (copy.lastChild.textContent = "Copy"), 2000);
    },
  });
  return copy;
}

/** A download with what it is and how large. */
export function fileLine(app, { name, title, size: bytes }) {
  const { h, icon } = app.fields;
  const link = h("a", { class: "button small", href: app.api.downloadUrl(name), download: name }, icon("down"), name);
  return h("li", {}, link, h("span", { class: "help" }, `${title}, ${size(bytes)}`));
}

const viewed = (key) => state.view(`card.${key}`, FIRST[key]);
const refusedRatio = () => {
  const ratio = viewed("poisson");
  return ratio && !Number.isFinite(Number(ratio)) ? `Poisson's ratio: enter a number, e.g. 0.499; got ${ratio}.` : null;
};

const cardJob = new Job("export-card", {
  manual: true,
  inputs: () => ({
    study: state.study,
    options: {
      format: viewed("program"),
      temperature_unit: viewed("temperature"),
      unit_system: viewed("system"),
      domain: viewed("domain"),
      ...(viewed("law") ? { law: viewed("law") } : {}),
      ...(viewed("poisson") ? { poisson_ratio: Number(viewed("poisson")) } : {}),
      ...(viewed("density") ? { density: viewed("density") } : {}),
    },
  }),
});

/** A select or box that is no part of the study, kept over reloads. */
function viewField(app, key, label, control, help) {
  const { h } = app.fields;
  control.id = `view-card-${key}`;
  effect(() => void (control.value = viewed(key)));
  control.addEventListener("change", () => state.setView(`card.${key}`, control.value.trim()));
  return h(
    "div",
    { class: "field" },
    h("label", { class: "field-label", for: control.id }, label),
    control,
    help ? h("p", { class: "help" }, help) : null,
  );
}

/** Form and text of a card. */
export function cardCard(app) {
  const { button, card, h, note } = app.fields;
  const select = (options) =>
    h(
      "select",
      {},
      options.map(([value, text]) => h("option", { value }, text)),
    );
  const box = (placeholder) => h("input", { type: "text", placeholder, autocomplete: "off" });
  const wrong = note([], "error");
  const notes = note([]);
  const text = h("pre", { tabindex: "0", role: "group", "aria-label": "Card", hidden: true });
  const after = h("div", { class: "row" });
  const optional = {
    system: viewField(app, "system", "Units of the model", select(SYSTEMS)),
    temperature: viewField(app, "temperature", "Temperatures of the model", select(TEMPERATURES)),
    domain: viewField(app, "domain", "Analysis", select(DOMAINS)),
    law: viewField(app, "law", "Shift law", select(LAWS), "fits a law, since the programs accept no table of factors"),
    poisson: viewField(app, "poisson", "Poisson's ratio", box("that of the material"), "ANSYS and LS-DYNA do not accept 0.5"),
    density: viewField(app, "density", "Density", box("none"), "e.g. 1800 kg/m^3; required for LS-DYNA"),
  };
  const refused = signal(null);
  const go = button({
    label: "Write the card",
    onClick: () => {
      refused.value = refusedRatio();
      if (!refused.value) cardJob.run();
    },
  });
  cardJob.done = ({ download }) => app.announce(`The card is written: ${download.name}.`);
  effect(() => {
    const program = viewed("program");
    const own = ["json", "csv"].includes(program);
    optional.system.hidden = !WITH_UNITS.includes(program);
    optional.domain.hidden = program !== "abaqus";
    for (const key of ["temperature", "law", "poisson", "density"]) optional[key].hidden = own;
  });
  effect(() => {
    const found = cardJob.current;
    const sentence = refusedRatio() ? refused.value : cardJob.error?.message;
    wrong.set(sentence ? [sentence] : []);
    go.disabled = Boolean(cardJob.progress);
    text.hidden = !found;
    text.textContent = found?.text ?? "";
    notes.set(found?.notes ?? []);
    after.replaceChildren(...(found ? [fileLine(app, found.download).firstChild, copyButton(app, () => found.text)] : []));
  });
  watch(
    () => cardJob.error,
    (error) => error && app.announce(`Error: ${error.message}`),
  );
  return card(
    "Material card for finite elements",
    h("div", { class: "form" }, viewField(app, "program", "Program", select(PROGRAMS)), ...Object.values(optional)),
    h("div", { class: "row" }, go, after),
    wrong,
    notes,
    text,
  );
}
