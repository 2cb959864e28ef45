// The amplitude sweep of the material: Kraus's law, the linear range, and the strain that the moduli are scaled to.

import { Job, shows } from "../jobs.js";
import { effect } from "../reactive.js";
import { state } from "../state.js";

const amplitude = new Job("amplitude", {
  wait: 0,
  remember: 2,
  inputs: () => {
    const [material] = [state.get("material") ?? {}].flat();
    // the law is that of the sweep, whatever strain the moduli are scaled to
    return material.amplitude_sweep === undefined ? null : { study: { material: { ...material, strain: undefined } } };
  },
});
const atContact = new Job("amplitude", {
  name: "amplitude-contact",
  inputs: () => amplitude.inputs.value && { study: { ...state.study, ...amplitude.inputs.value.study }, options: { contact: true } },
});

/** The card, hidden without an amplitude sweep. */
export function amplitudeCard(app) {
  const { fields, figures, units } = app;
  const { h, card, button, note } = fields;
  const words = note([]);
  const problem = note([], "error");
  const contact = h("p", { class: "help", "aria-live": "polite" });
  const place = h("div", {});
  const handle = figures.figure(place, { id: "amplitude-sweep", title: "Amplitude sweep", x: {}, y: {}, traces: [] });
  const strain = fields.numberField({
    path: "material.strain",
    label: "Scale the moduli to this tensile strain",
    min: 0,
    max: 10,
    placeholder: "not scaled",
    help: "A fraction: 0.05 is 5 %. An approximation by Kraus’s law, without 95 % bands.",
  });
  const small = fields.numberField({
    path: "material.measured_at",
    label: "Tensile strain of the frequency sweeps",
    min: 0,
    max: 10,
    placeholder: "small",
  });
  const use = button({ label: "Use the strain of the contact", onClick: () => atContact.run() });
  const remove = () =>
    state.change({
      "material.amplitude_sweep": undefined,
      "material.strain": undefined,
      "material.measured_at": undefined,
    });
  const away = button({ label: "Remove the amplitude sweep", kind: "quiet small", onClick: remove });
  const element = card("Amplitude sweep", problem, words, place, strain, small, contact, h("div", { class: "row" }, use, away));

  const ofContact = ({ strain: of, friction, linear, speed, temperature }) =>
    `At ${units.show(speed, "speed")}, ${units.show(temperature, "temperature")} the strain of the contact is ` +
    `${(100 * of).toPrecision(2)} %: friction ${friction.toPrecision(3)} instead of ${linear.toPrecision(3)} (small strain).`;

  atContact.done = ({ contact: { strain: of } }) => state.set("material.strain", Number(of.toPrecision(2)));
  amplitude.start();
  effect(() => {
    const error = amplitude.error ?? atContact.error;
    problem.set(error ? [app.explain(error, "amplitude")] : []);
  });
  effect(() => {
    const found = atContact.current?.contact;
    contact.textContent = atContact.progress ? "Solving the contact" : found ? ofContact(found) : "";
  });
  effect(() => {
    element.hidden = state.get("material.amplitude_sweep") === undefined;
    if (amplitude.result) draw(amplitude.result);
  });

  function draw(found) {
    const letter = found.deformation === "shear" ? "G" : "E";
    const percent = found.strain_amplitude.map((one) => 100 * one);
    const both = [
      ["storage", `${letter}′`, "square", "blue"],
      ["loss", `${letter}″`, "circle", "vermilion"],
    ];
    shows(words, found);
    words.set([found.words, ...found.linear, ...found.notes]);
    handle.update({
      of: found,
      x: { label: "strain amplitude (%)", log: true },
      y: { label: "modulus", kind: "modulus", log: true },
      caption: "Points: as measured; lines: Kraus’s law.",
      synthetic: state.get("data_origin") === "synthetic",
      traces: both.flatMap(([key, name, symbol, colour]) => [
        { name, mode: "markers", symbol, colour, size: 5, x: percent, y: found[`${key}_modulus`] },
        { name: `${name}, Kraus`, colour, legend: false, x: percent, y: found[`${key}_fitted`] },
      ]),
    });
  }

  return element;
}
