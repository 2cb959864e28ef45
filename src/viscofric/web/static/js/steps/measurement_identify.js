// The rubber behind measured friction: what fixes its level, the computation, and its result.

import { shows } from "../jobs.js";
import { effect } from "../reactive.js";
import { state } from "../state.js";
import { fitFigure, modulusFigure } from "./measurement_inverse.js";
import { master } from "./measurement_master.js";
import { alone, ofMeasured, optionChoice, optionField, progressOf, shownMeasured } from "./measurement_parts.js";

/** Fields of an anchor of each kind. */
const ANCHOR_FIELDS = {
  nothing: [],
  rubber: ["frequency", "temperature"],
  modulus: ["modulus", "frequency", "temperature", "error"],
  indentation: ["size", "speed", "load", "temperature", "error"],
  contact_area: ["size", "speed", "load", "temperature", "error"],
  half_width: ["size", "speed", "load", "temperature", "error"],
};

/** Shift factors of friction where they can be found, else of the page's material, until the user chooses. */
const suggested = () => (master.current?.refusal && master.current.by_rubber ? "rubber" : "friction");

/**
 * The card of the identification.
 *
 * @param {object} app
 * @param {{data: () => boolean, synthetic: () => boolean}} step
 */
export function identification(app, step) {
  const { fields, figures } = app;
  const { h, button, note } = fields;
  const shift = optionChoice(app, {
    key: "identify.shift",
    label: "Shift factors",
    otherwise: suggested,
    options: [
      ["friction", "found from friction"],
      ["rubber", "of the page's material"],
    ],
  });
  const anchor = optionChoice(app, {
    key: "identify.anchor",
    label: "Anchor (fixes the magnitude of the modulus)",
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
  const identify = ofMeasured("identify", options, {
    manual: true,
    done: ({ sentences: [first] }) => app.announce(`The material is identified. ${first}`),
  });
  const go = button({ label: "Identify the material", kind: "main", onClick: () => identify.run() });
  const sentences = note([]);
  const family = h("div", {});
  const card_ = h("a", { class: "button small", hidden: true, download: "rubber_from_friction.json" }, "Material (JSON)");
  const use = button({ label: "Use this material on the page", kind: "small", onClick: take });
  use.hidden = true;
  const card = fields.card(
    "Material identified from friction",
    h("div", { class: "form" }, shift, anchor, Object.values(boxes)),
    h("div", { class: "row" }, go),
    ...progressOf(app, identify, "Identifying"),
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

  const middle = () => {
    const isotherms = shownMeasured()?.curves ?? [];
    const kelvin = isotherms[Math.floor(isotherms.length / 2)]?.temperature;
    return kelvin ? app.units.show(kelvin, "temperature") : "30 °C";
  };

  /** The options of the job; the placeholders of frequency and temperature count where nothing was typed. */
  function options() {
    const of = anchor.value();
    const chosen = { shift: shift.value(), beside: !alone() };
    if (of === "nothing") return chosen;
    const typed = (name) => boxes[name].value() || undefined;
    const given = Object.fromEntries(ANCHOR_FIELDS[of].map((name) => [name, typed(name)]));
    given.temperature ??= app.units.typed(middle(), "temperature");
    if (of === "rubber") given.frequency ??= "1 Hz";
    if (given.error !== undefined) given.error = Number(given.error);
    return { ...chosen, anchor: { of, ...given } };
  }

  effect(() => {
    for (const [name, box] of Object.entries(boxes)) box.hidden = !ANCHOR_FIELDS[anchor.value()].includes(name);
    boxes.temperature.input.placeholder = middle();
    go.disabled = !(master.current || master.error || master.ended); // which factors to use is not known before
  });
  effect(() => {
    const found = identify.error ? null : identify.result;
    results.hidden = !found;
    if (found) show(found);
  });

  function show(found) {
    const made = alone() ? step.data() : step.synthetic();
    modulus.update({ of: found, ...modulusFigure(found, made) });
    fit.update({ of: found, ...fitFigure(found, shownMeasured(), made) });
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
  }

  /** Make the identified rubber that of the page. */
  async function take() {
    const { download } = identify.result;
    const response = await fetch(app.api.downloadUrl(download));
    const [name] = await app.api.uploadFiles([new File([await response.blob()], download)]);
    state.set("material", { file: name });
    app.announce("The page now uses the identified material.");
  }

  return card;
}
