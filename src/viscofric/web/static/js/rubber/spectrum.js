// Step 3: the spectrum, E'(ω) and E''(ω) at any temperature with their bands, and what the fit leaves unexplained.

import { Job, shows } from "../jobs.js";
import { effect, signal } from "../reactive.js";
import { named, pick, rubber, shownRubber, synthetic, worded } from "./made.js";
import { settings, temperatureChoice } from "./spectrum_form.js";
import { caption, keyNumbers, modesFigure, modesTable, modulusTraces, tangentTraces } from "./spectrum_figures.js";

const chosen = signal(null); // temperature that the modulus is shown at, K; null is the reference
const moduli = new Job("moduli", {
  remember: 6,
  follows: true,
  when: () => Boolean(rubber.current),
  inputs: () => {
    const { shift, spectrum } = rubber.result ?? {};
    if (!shift || chosen.value === null || Math.abs(chosen.value - spectrum.reference) < 0.005) return null;
    const options = { temperature: worded(chosen.value), bands: rubber.complete };
    return { study: rubber.inputs.value.study, options };
  },
});

export function mount(section, app) {
  const { fields, figures } = app;
  const { h, card, note } = fields;
  moduli.start();
  const wait = fields.progressBar(rubber.start(), {
    label: "Fitting the material",
    cancels: false,
    ended: () => (rubber.result?.no_band ? `No 95 % band: ${rubber.result.no_band}.` : ""),
  });
  const problem = note([], "error");
  const doubts = note([], "warning");
  const numbers = fields.keyNumbers();
  const first = card("Modulus against frequency");
  const at = temperatureChoice(app, chosen);
  const modulus = figures.figure(first, {
    id: "modulus",
    title: "E′ and E″",
    x: { label: "frequency", kind: "angular_frequency", log: true },
    y: { label: "modulus", kind: "modulus", log: true },
    traces: [],
    height: 430,
  });
  first.insertBefore(at, first.children[1]);
  const second = card("Loss tangent");
  const tangent = figures.figure(second, {
    id: "loss-tangent",
    title: "tan δ",
    x: { label: "frequency", kind: "angular_frequency", log: true },
    y: { label: "tan δ", log: true },
    traces: [],
  });
  const third = card("Residuals of the fit");
  const residual = figures.figure(third, {
    id: "spectrum-residuals",
    title: "Measured over fitted modulus",
    caption: "log₁₀, at the points of the master curve.",
    x: { label: "reduced frequency α ω", kind: "angular_frequency", log: true },
    y: { label: "log₁₀ measured/fit" },
    traces: [],
  });
  const fourth = card("Spectrum");
  const kind = signal("retardation");
  fourth.append(
    pick(
      {
        label: "Spectrum",
        options: [
          ["retardation", "Retardation C(τ)"],
          ["relaxation", "Relaxation E(τ)"],
        ],
        value: kind.value,
        onChange: (value) => (kind.value = value),
      },
      fields,
    ),
  );
  const modes = figures.figure(fourth, {
    id: "modes",
    title: "Modes",
    x: { label: "time τ", kind: "time", log: true },
    y: {},
    traces: [],
  });
  const table = h("div", {});
  fourth.append(h("details", {}, h("summary", {}, "Table of modes"), table));
  section.append(
    h("p", {}, "Modes fitted to the master curve, and the resulting E′ and E″ at any temperature within the shift factors."),
    h("div", { class: "waiting" }, wait),
    problem,
    numbers,
    doubts,
    h("div", { class: "columns" }, h("div", {}, settings(app)), h("div", {}, first)),
    h("div", { class: "grid thirds" }, second, third, fourth),
  );

  effect(() => {
    const result = shownRubber();
    problem.set(rubber.error ? [app.explain(rubber.error, "spectrum")] : []);
    for (const one of [first, second, third, fourth]) one.hidden = !result;
    numbers.set(result ? keyNumbers(result, app) : []);
    for (const one of [numbers, doubts, table]) shows(one, result);
    doubts.set(
      result ? [...(result.spectrum.fit?.notes ?? []), ...result.spectrum.notes, ...(result.band?.notes ?? [])] : [],
    );
    if (!result) return;
    at.show(result);
    draw(result);
  });

  function draw(result) {
    const { spectrum } = result;
    const moved = moduli.result;
    const doubt = moved?.extrapolated ? "The shift factor is extrapolated at this temperature." : "";
    at.note(moduli.error?.message ?? doubt, moduli.error);
    const here = moved ?? {
      temperature: spectrum.reference,
      modulus: spectrum.modulus,
      band: result.band ?? null,
      moved: spectrum.measured,
      isotherm: null,
    };
    const madeUp = synthetic(result, app);
    const title = here.temperature === null ? "E′ and E″" : `E′ and E″ at ${named(here.temperature, app)}`;
    const of = moved ?? result;
    modulus.update({ of, title, synthetic: madeUp, caption: caption(result, here, app), traces: modulusTraces(here) });
    tangent.update({
      of,
      title: here.temperature === null ? "tan δ" : `tan δ at ${named(here.temperature, app)}`,
      synthetic: madeUp,
      traces: tangentTraces(here),
    });
    third.hidden = !spectrum.residual;
    if (spectrum.residual) {
      const x = spectrum.measured.angular_frequency;
      residual.update({
        of: result,
        synthetic: madeUp,
        marks: [{ y: 0 }],
        traces: [
          ["storage_modulus", "E′", "square", "blue"],
          ["loss_modulus", "E″", "circle", "vermilion"],
        ].map(([key, name, symbol, colour]) => ({
          name,
          mode: "markers",
          symbol,
          colour,
          open: true,
          size: 5,
          x,
          y: spectrum.residual[key],
        })),
      });
    }
    fourth.hidden = !spectrum.modes;
    if (spectrum.modes) {
      modes.update({ of: result, ...modesFigure(result, kind.value, madeUp) });
      table.replaceChildren(modesTable(spectrum, app));
    }
  }
}
