// The form of the rubber's source: its kind, its files, and what these leave to the user.

import { columnsForm } from "../columns_form.js";
import { effect, watch } from "../reactive.js";
import { FIRST_REFERENCE, SOURCES, TESTS, sourceOf } from "./made.js";

const OF_FILES = ["deformation", "modulus_unit", "columns", "sheet", "temperature", "assumed_shift"];
const OF_SHIFTS = ["fixed_shift_factors", "shift_factors", "shift_factor_columns", "shift_factor_sheet"];

/** [material] of other files: what says how a rubber is made stays, what belonged to the old files goes. */
function materialOf(source, value, before = {}) {
  const kept = Object.entries(before).filter(
    ([key]) => !SOURCES.some(([source_]) => source_ === key) && ![...OF_FILES, ...OF_SHIFTS].includes(key),
  );
  if (source === "catalogue" || source === "file") {
    const stays = ["name", "amplitude_sweep", "strain", "measured_at"];
    return { [source]: value, ...Object.fromEntries(kept.filter(([key]) => stays.includes(key))) };
  }
  const rest = Object.fromEntries(kept);
  if (source === "master_curve") {
    delete rest.vertical_shift;
    delete rest.shift;
  }
  if (source !== "dma") for (const key of ["shift_by", "shift_weights"]) delete rest[key];
  if (source === "ramps") for (const key of ["shift", "vertical_shift"]) delete rest[key];
  return { reference_temperature: FIRST_REFERENCE, ...rest, [source]: value };
}

const one = (names) => (Array.isArray(names) && names.length === 1 ? names[0] : names);
const allOf = (material, key) => [material?.[key] ?? []].flat();

const inOrder = new Intl.Collator("en", { numeric: true }).compare;

/** What a study calls the rubber of some files: the first one's name without its ending. */
const named = (value) => {
  const names = [value].flat();
  return names.length > 1 ? `${names.length} sweep files` : names[0].replace(/\.[A-Za-z0-9]{1,9}$/, "");
};

/** The form of the source: its kind, its files, and what these leave to the user. */
export function sourceForm(app, onError) {
  const { state, fields, api, start, units } = app;
  const { h, card, button } = fields;
  const shown = () => state.view("sweeps.source", sourceOf(state.get("material")) ?? "dma");
  const group = h(
    "div",
    { class: "choices", role: "radiogroup", "aria-labelledby": "material-source-label" },
    h("span", { class: "field-label", id: "material-source-label" }, "Source of the material"),
  );
  const radios = new Map();
  for (const [key, text] of SOURCES) {
    const radio = h("input", { type: "radio", name: "material-source", value: key });
    radio.addEventListener("change", () => state.setView("sweeps.source", key));
    radios.set(key, radio);
    group.append(h("label", { class: "choice" }, radio, h("span", {}, text)));
  }
  const take = (source, many) => async (files) => {
    try {
      onError(null);
      const names = await api.uploadFiles(files);
      choose(source, many ? names.sort(inOrder) : names[0]);
    } catch (error) {
      onError(error);
    }
  };
  /** Sort uploaded files of tests by what they hold; a file that is not recognised belongs to the source that is chosen. */
  const sorted = async (names) => {
    const chosen = TESTS.includes(shown()) ? shown() : "dma";
    try {
      const { kinds } = await api.runJob("recognise", { study: {}, options: { files: names } });
      return kinds;
    } catch {
      return { [chosen]: names }; // reading it says what is wrong
    }
  };
  /** An amplitude sweep is no source: it stays with the material, which may be scaled to a strain by it. */
  const takeAmplitude = (kinds) => {
    if (kinds.amplitude) state.set("material.amplitude_sweep", one(kinds.amplitude));
    delete kinds.amplitude;
  };
  const takeTests = async (files) => {
    try {
      onError(null);
      const kinds = await sorted((await api.uploadFiles(files)).sort(inOrder));
      const [first, ...others] = TESTS.filter((key) => kinds[key]);
      takeAmplitude(kinds);
      if (first) choose(first, kinds[first], undefined, Object.fromEntries(others.map((key) => [key, one(kinds[key])])));
    } catch (error) {
      onError(error);
    }
  };
  const choose = (source, value, origin, beside = {}) => {
    const single = one(value);
    const [before, ...others] = [state.get("material")].flat();
    const material = { ...materialOf(source, single, before), ...beside };
    // The title that the page began with is not that of another rubber.
    const title = state.get("title") === start?.study.title ? `Friction of ${named(single)}` : state.get("title");
    state.change({ material: others.length ? [material, ...others] : material, data_origin: origin, title });
  };
  const present = h("ul", { class: "files" });
  const listFiles = () => {
    const [material] = [state.get("material")].flat();
    const all = TESTS.flatMap((key) => allOf(material, key).map((name) => [key, name]));
    const drop = (key, name) => () => {
      const left = allOf(material, key).filter((other) => other !== name);
      state.change({ [`material.${key}`]: left.length ? one(left) : undefined, "material.temperature": undefined });
    };
    present.replaceChildren(
      ...all.map(([key, name]) =>
        h(
          "li",
          { class: "row" },
          h("span", {}, name),
          all.length > 1
            ? button({
                label: h("span", { class: "unseen" }, `Remove ${name}`),
                kind: "quiet small",
                symbol: "close",
                title: `Remove ${name}`,
                onClick: drop(key, name),
              })
            : null,
        ),
      ),
    );
    more.hidden = all.length === 0;
  };
  const addMore = async (files) => {
    try {
      const kinds = await sorted(await api.uploadFiles(files));
      const [material] = [state.get("material")].flat();
      takeAmplitude(kinds);
      const changes = Object.entries(kinds).map(([key, names]) => [
        `material.${key}`,
        one([...new Set([...allOf(material, key), ...names])].sort(inOrder)),
      ]);
      if (changes.length) state.change(Object.fromEntries(changes));
    } catch (error) {
      onError(error);
    }
  };
  const more = h(
    "details",
    {},
    h("summary", {}, "Add files of the same specimen"),
    fields.fileDrop({ label: "Add files", onFiles: addMore }),
  );
  const required = {
    deformation: fields.choiceField({
      path: "material.deformation",
      label: "Measured in",
      otherwise: null,
      options: [
        [null, "– please select –"],
        ["tension", "tension: E′, E″"],
        ["compression", "compression: E′, E″"],
        ["bending", "bending: E′, E″"],
        ["shear", "shear: G′, G″"],
      ],
      help: "Not stated in the file; the moduli differ by a factor of three.",
    }),
    modulus_unit: fields.textField({
      path: "material.modulus_unit",
      label: "Unit of the moduli",
      placeholder: "MPa",
      help: "Not stated in the file.",
    }),
    temperature: fields.textField({
      path: "material.temperature",
      label: "Temperature of the sweep",
      read: (text) => one(text.split(/\s*[;,]\s+/).map((part) => units.typed(part.trim(), "temperature"))),
      write: (value) => [value ?? []].flat().join(", "),
      help: "Not stated in the file; of several files one temperature each, in their order: 145 °C, 160 °C.",
    }),
    assumed_shift: fields.textField({
      path: "material.assumed_shift",
      label: "Assumed shift law",
      placeholder: "250 kJ/mol",
      help: "One frequency determines no shift factor. An activation energy (250 kJ/mol), WLF 17.44, 51.6 K, -30 degC (C₁, C₂, their reference), or universal.",
    }),
  };
  required.sheet = fields.textField({
    path: "material.sheet",
    label: "Sheet",
    help: "Name of the only sheet of the workbook to read.",
  });
  const columns = columnsForm(app, {
    choose: (named) => state.set("material.columns", named),
    chosen: () => state.get("material.columns"),
  });
  const useExample = async () => {
    try {
      await api.useExample();
      choose("dma", "dma.csv", "synthetic");
    } catch (error) {
      onError(error);
    }
  };
  const tests = h(
    "div",
    { class: "panel" },
    fields.fileDrop({
      label: "Drop tests here, or choose files",
      help: "Frequency sweeps, temperature ramps, creep or relaxation tests, amplitude sweeps: exports of TA, Netzsch, Mettler-Toledo, Anton Paar and others, workbooks, delimited text; recognised by content.",
      onFiles: takeTests,
    }),
    present,
    more,
    button({ label: "Use the synthetic example's sweeps", kind: "quiet", onClick: useExample }),
  );
  const panels = {
    master_curve: h(
      "div",
      { class: "panel" },
      fields.fileDrop({
        label: "Drop a master curve",
        help: "Moduli against reduced frequency: delimited text, a workbook or a .tts file of RepTate.",
        multiple: false,
        onFiles: take("master_curve", false),
      }),
      fields.fileDrop({
        label: "Drop its shift factors",
        help: "A table of temperature and α; without it the curve is valid at its reference temperature only.",
        multiple: false,
        onFiles: async (files) => {
          try {
            state.set("material.shift_factors", (await api.uploadFiles(files))[0]);
          } catch (error) {
            onError(error);
          }
        },
      }),
    ),
    file: h(
      "div",
      { class: "panel" },
      fields.fileDrop({
        label: "Drop a material file",
        help: "rubber.json, or a card of Abaqus, ANSYS, LS-DYNA or COMSOL.",
        multiple: false,
        onFiles: take("file", false),
      }),
    ),
    catalogue: h("div", { class: "panel" }, catalogueList(app, choose)),
  };
  const making = h(
    "div",
    { class: "form" },
    fields.textField({ path: "material.name", label: "Name" }),
    fields.quantityField({
      path: "material.reference_temperature",
      label: "Reference temperature",
      kind: "temperature",
      help: "The shift factor is 1 at this temperature.",
    }),
    fields.numberField({
      path: "material.poisson_ratio",
      label: "Poisson’s ratio",
      min: 0,
      max: 0.5,
      step: 0.01,
      placeholder: "0.5",
    }),
  );
  const showPanel = (key) => {
    radios.get(key).checked = true;
    for (const [name, panel] of Object.entries(panels)) panel.hidden = name !== key;
    tests.hidden = !TESTS.includes(key);
    making.hidden = questions.hidden = key === "catalogue" || key === "file" || sourceOf(state.get("material")) !== key;
  };
  const refresh = () => {
    const rubbers = [state.get("material") ?? {}].flat();
    const first = rubbers[0].name ? `, ${rubbers[0].name}` : "";
    several.set(
      rubbers.length > 1
        ? [`This study has ${rubbers.length} materials. Steps 1 to 3 show the first${first}; friction is predicted for all.`]
        : [],
    );
    listFiles();
    showPanel(shown());
  };
  const questions = h("div", { class: "panel questions" }, ...Object.values(required));
  const several = fields.note([], "several");
  const element = card("Material", several, group, questions, columns, tests, ...Object.values(panels), making);
  element.require = (key, values) => {
    if (required[key]) required[key].hidden = false;
    columns.offer(required[key] ? null : values); // one question at a time
  };
  element.show = (result) => {
    columns.offer(null);
    for (const [key, field] of Object.entries(required))
      field.hidden = !result?.left_open?.includes(key) && state.get(`material.${key}`) === undefined;
  };
  watch(
    () => sourceOf(state.get("material")),
    (source) => source && state.setView("sweeps.source", source),
  );
  effect(refresh);
  return element;
}

function catalogueList({ state, start, fields }, choose) {
  const { h } = fields;
  const list = h("div", { class: "choices", role: "radiogroup", "aria-label": "Materials of the catalogue" });
  const radios = (start?.catalogue ?? []).map((entry) => {
    const radio = h("input", { type: "radio", name: "material-catalogue", value: entry.name });
    radio.addEventListener("change", () => choose("catalogue", entry.name, entry.synthetic ? "synthetic" : undefined));
    list.append(
      h(
        "label",
        { class: "choice" },
        radio,
        h(
          "span",
          {},
          h("strong", {}, entry.name),
          " ",
          entry.synthetic ? h("span", { class: "badge small" }, "synthetic") : null,
          h("span", { class: "help" }, entry.description),
        ),
      ),
    );
    return radio;
  });
  const refresh = () => radios.forEach((radio) => (radio.checked = radio.value === state.get("material.catalogue")));
  effect(refresh);
  return list;
}
