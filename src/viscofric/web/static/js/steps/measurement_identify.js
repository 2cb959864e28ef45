// The rubber behind measured friction: what fixes its level, the computation, and its result.

import { shows } from "../inputs.js";
import { fitFigure, modulusFigure } from "./measurement_inverse.js";
import { optionChoice, optionField, repeated } from "./measurement_parts.js";

/** Fields of an anchor of each kind. */
const ANCHOR_FIELDS = {
  nothing: [],
  rubber: ["frequency", "temperature"],
  modulus: ["modulus", "frequency", "temperature", "error"],
  indentation: ["size", "speed", "load", "temperature", "error"],
  contact_area: ["size", "speed", "load", "temperature", "error"],
  half_width: ["size", "speed", "load", "temperature", "error"],
};

/**
 * The card of the identification.
 *
 * @param {object} app
 * @param {{data: () => boolean, synthetic: () => boolean}} step
 * @param {{alone: () => boolean}} about whether no rubber is to be looked at
 */
export function identification(app, step, { alone }) {
  const { state, fields, figures } = app;
  const { h, button, note } = fields;
  let byHand = false; // whether the user chose the shift factors
  let awaited = null; // the newest friction master curve on its way
  const shift = optionChoice(app, {
    key: "identify.shift",
    label: "Shift factors",
    onChange: () => (byHand = true),
    options: [
      ["friction", "found from friction"],
      ["rubber", "of the page's material"],
    ],
  });
  const anchor = optionChoice(app, {
    key: "identify.anchor",
    label: "Anchor (fixes the magnitude of the modulus)",
    onChange: () => choose(),
    help: "Friction determines the shape of E(ω) but hardly its magnitude.",
    options: [
      ["rubber", "|E| of the page's material at one frequency"],
      ["modulus", "a known modulus"],
      ["indentation", "indentation of the ball"],
      ["contact_area", "contact area"],
      ["half_width", "contact half-width"],
      ["nothing", "none: magnitude not identified"],
    ],
  });
  const boxes = {
    modulus: optionField(app, { key: "identify.modulus", label: "Modulus |E|", kind: "modulus", placeholder: "8 MPa" }),
    frequency: optionField(app, {
      key: "identify.frequency",
      label: "Anchor frequency",
      kind: "frequency",
      placeholder: "1 Hz",
    }),
    size: optionField(app, { key: "identify.size", label: "Measured size", placeholder: "0.8 mm, or 12 mm^2" }),
    speed: optionField(app, { key: "identify.speed", label: "Anchor speed", kind: "speed", placeholder: "100 mm/s" }),
    load: optionField(app, { key: "identify.load", label: "Anchor load", kind: "load", placeholder: "25 N" }),
    temperature: optionField(app, { key: "identify.temperature", label: "Anchor temperature", kind: "temperature" }),
    error: optionField(app, { key: "identify.error", label: "Relative standard error", placeholder: "0.01" }),
  };
  const job = repeated(app, "identify", { label: "Identifying", done: show });
  const go = button({ label: "Identify the material", kind: "main", onClick: () => job.run(state.study, options()) });
  const sentences = note([]);
  const family = h("div", {});
  const card_ = h("a", { class: "button small", hidden: true, download: "rubber_from_friction.json" }, "Material (JSON)");
  const use = button({ label: "Use this material on the page", kind: "small", onClick: take });
  use.hidden = true;
  const card = fields.card(
    "Material identified from friction",
    h("div", { class: "form" }, shift, anchor, Object.values(boxes)),
    h("div", { class: "row" }, go),
    job.bar,
    job.errors,
  );
  const results = h("div", { class: "step-body", hidden: true });
  card.append(results);
  const pair = h("div", { class: "grid" });
  results.append(pair, sentences, family, h("div", { class: "row" }, card_, use));
  const modulus = figures.figure(pair, {
    id: "identified-modulus",
    title: "Modulus identified from friction",
    x: { label: "reduced frequency", kind: "angular_frequency", log: true },
    y: { label: "modulus", kind: "modulus", log: true },
    height: 380,
  });
  const fit = figures.figure(pair, {
    id: "identified-friction",
    title: "Friction of the identified material",
    x: { label: "speed", kind: "speed", log: true },
    y: { label: "viscoelastic friction coefficient" },
    height: 380,
  });

  function choose() {
    const shown = ANCHOR_FIELDS[anchor.value()];
    for (const [name, box] of Object.entries(boxes)) box.hidden = !shown.includes(name);
    const isotherms = state.result("measured")?.curves ?? [];
    const middle = isotherms[Math.floor(isotherms.length / 2)]?.temperature;
    boxes.temperature.input.placeholder = middle ? app.units.show(middle, "temperature") : "30 °C";
  }

  /** The options of the job; the placeholders of frequency and temperature count where nothing was typed. */
  function options() {
    const of = anchor.value();
    const chosen = { shift: shift.value(), beside: !alone() };
    if (of === "nothing") return chosen;
    const typed = (name) => boxes[name].value() || undefined;
    const given = Object.fromEntries(ANCHOR_FIELDS[of].map((name) => [name, typed(name)]));
    given.temperature ??= app.units.typed(boxes.temperature.input.placeholder, "temperature");
    if (of === "rubber") given.frequency ??= "1 Hz";
    if (given.error !== undefined) given.error = Number(given.error);
    return { ...chosen, anchor: { of, ...given } };
  }

  function show(found) {
    state.setResult("identified", found);
    results.hidden = false;
    const made = alone() ? step.data() : step.synthetic();
    modulus.update({ of: found, ...modulusFigure(found, made) });
    fit.update({ of: found, ...fitFigure(found, state.result("measured"), made) });
    for (const one of [sentences, family]) shows(one, found);
    const at =
      found.anchor &&
      `Anchored to |E| = ${app.units.show(found.anchor.modulus, "modulus")} at ${app.units.show(found.anchor.angular_frequency, "angular_frequency")} and ${app.units.show(found.anchor.temperature, "temperature")}.`;
    sentences.set([at, ...found.sentences].filter(Boolean));
    const percent = (share) => `${app.units.plainNumber(100 * share, 2)} %`;
    const rows = found.family.map((one) => [
      `× ${one.factor}`,
      app.units.show(one.modulus, "modulus"),
      percent(one.rms),
      app.units.plainNumber(one.penalty, 2),
    ]);
    const head = [
      "level",
      `|E| at ${app.units.show(found.middle, "angular_frequency")}`,
      "rms of friction",
      "χ² above the best",
    ];
    family.replaceChildren(
      ...(rows.length ? [fields.table(head, rows, "Materials that friction alone hardly distinguishes")] : []),
    );
    card_.href = app.api.downloadUrl(found.download);
    card_.hidden = use.hidden = false;
    app.announce(`The material is identified. ${found.sentences[0]}`);
  }

  /** Make the identified rubber that of the page. */
  async function take() {
    const found = state.result("identified");
    const response = await fetch(app.api.downloadUrl(found.download));
    const [name] = await app.api.uploadFiles([new File([await response.blob()], found.download)]);
    state.set("material", { file: name });
    app.announce("The page now uses the identified material.");
  }

  function clear() {
    job.stop();
    state.setResult("identified", null);
    results.hidden = true;
    choose();
  }

  /** Shift factors of friction where they can be found, else of the page's material, unless the user chose. */
  async function suggest(coming) {
    awaited = coming;
    go.disabled = true; // which factors to use is not known before
    const master = await coming;
    if (awaited !== coming) return;
    go.disabled = false;
    if (byHand) return;
    if (master?.refusal && master.by_rubber) shift.choose("rubber");
    else if (master?.found) shift.choose("friction");
  }

  clear();
  return { card, clear, suggest };
}
