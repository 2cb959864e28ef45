// The rubber as a card for finite-element programs; and how texts are copied and files are fetched.

import { isCurrent } from "../inputs.js";

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

/** A select or box that is no part of the study, kept over reloads. */
function viewField(app, key, label, control, help) {
  const { h } = app.fields;
  control.id = `view-${key.replace(".", "-")}`;
  const kept = app.state.view(key);
  if (kept !== undefined) control.value = kept;
  control.addEventListener("change", () => app.state.setView(key, control.value));
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
  const program = select(PROGRAMS);
  const system = select([
    ["Pa", "Pa, m, s, kg"],
    ["MPa", "MPa, mm, s, t"],
  ]);
  const temperature = select([
    ["K", "kelvin"],
    ["degC", "°C"],
  ]);
  const domain = select([
    ["time", "time (Prony series)"],
    ["frequency", "frequency"],
  ]);
  const law = select(LAWS);
  const poisson = box("that of the material");
  const density = box("none");
  const wrong = note([], "error");
  const notes = note([]);
  const text = h("pre", { tabindex: "0", role: "group", "aria-label": "Card", hidden: true });
  const after = h("div", { class: "row" });
  const optional = {
    system: viewField(app, "card.system", "Units of the model", system),
    temperature: viewField(app, "card.temperature", "Temperatures of the model", temperature),
    domain: viewField(app, "card.domain", "Analysis", domain),
    law: viewField(app, "card.law", "Shift law", law, "fits a law, since the programs accept no table of factors"),
    poisson: viewField(app, "card.poisson", "Poisson's ratio", poisson, "ANSYS and LS-DYNA do not accept 0.5"),
    density: viewField(app, "card.density", "Density", density, "e.g. 1800 kg/m^3; required for LS-DYNA"),
  };
  const programField = viewField(app, "card.program", "Program", program);
  const fit = () => {
    const own = ["json", "csv"].includes(program.value);
    optional.system.hidden = !WITH_UNITS.includes(program.value);
    optional.domain.hidden = program.value !== "abaqus";
    for (const one of [optional.temperature, optional.law, optional.poisson, optional.density]) one.hidden = own;
  };
  program.addEventListener("change", fit);
  fit();

  async function write() {
    wrong.set([]);
    const ratio = poisson.value.trim();
    const options = {
      format: program.value,
      temperature_unit: temperature.value,
      unit_system: system.value,
      domain: domain.value,
    };
    if (law.value) options.law = law.value;
    if (ratio) options.poisson_ratio = Number(ratio);
    if (density.value.trim()) options.density = density.value.trim();
    go.disabled = true;
    try {
      if (ratio && !Number.isFinite(options.poisson_ratio))
        throw new Error(`Poisson's ratio: enter a number, e.g. 0.499; got ${ratio}.`);
      const found = await app.api.runJob("export-card", { study: app.state.study, options });
      if (!isCurrent(found)) throw new Error("The material has changed; write the card again.");
      text.textContent = found.text;
      text.hidden = false;
      notes.set(found.notes);
      after.replaceChildren(
        fileLine(app, found.download).firstChild,
        copyButton(app, () => found.text),
      );
      app.announce(`The card is written: ${found.download.name}.`);
    } catch (error) {
      wrong.set([error.message]);
      text.hidden = true;
      after.replaceChildren();
      app.announce(`Error: ${error.message}`);
    } finally {
      go.disabled = false;
    }
  }

  const go = button({ label: "Write the card", onClick: write });
  app.state.subscribe("material", () => {
    text.hidden = true;
    after.replaceChildren();
  });
  return card(
    "Material card for finite elements",
    h("div", { class: "form" }, programField, ...Object.values(optional)),
    h("div", { class: "row" }, go, after),
    wrong,
    notes,
    text,
  );
}
