// Step 3: the spectrum, E'(ω) and E''(ω) at any temperature with their bands, and what the fit leaves unexplained.

import { shows } from "../inputs.js";
import { follow, named, pick, synthetic, worded } from "./made.js";
import { settings, temperatureChoice } from "./spectrum_form.js";
import { caption, keyNumbers, modesFigure, modesTable, modulusTraces, tangentTraces } from "./spectrum_figures.js";

export function mount(section, app) {
  const { state, fields, figures, units } = app;
  const { h, card, note } = fields;
  const wait = fields.progressBar({ label: "Fitting the spectrum" });
  const problem = note([], "error");
  const doubts = note([], "warning");
  const numbers = fields.keyNumbers();
  const first = card("Modulus against frequency");
  const at = temperatureChoice(app, (kelvin) => request(kelvin));
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
  let kind = "retardation";
  fourth.append(
    pick(
      {
        label: "Spectrum",
        options: [
          ["retardation", "Retardation C(τ)"],
          ["relaxation", "Relaxation E(τ)"],
        ],
        value: kind,
        onChange: (value) => ((kind = value), draw()),
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

  let now = null;
  let moved = null; // the result of "moduli" at another temperature
  let running = null;

  /** E(ω) at another temperature, by the server. */
  const request = async (kelvin) => {
    running?.abort();
    const reference = now?.result?.spectrum.reference;
    if (!now?.result || kelvin === null || Math.abs(kelvin - reference) < 0.005) {
      moved = null;
      at.note("");
      return draw();
    }
    running = new AbortController();
    const mine = running;
    try {
      const { material, uncertainty } = state.study;
      const study = uncertainty === undefined ? { material } : { material, uncertainty };
      const found = await app.api.runJob(
        "moduli",
        { study, options: { temperature: worded(kelvin), bands: now.complete } },
        { signal: mine.signal },
      );
      if (running !== mine) return;
      moved = found;
      at.note(found.extrapolated ? "The shift factor is extrapolated at this temperature." : "");
      draw();
    } catch (error) {
      if (running === mine && error.name !== "AbortError") at.note(error.message, true);
    }
  };

  const draw = () => {
    const result = now?.result;
    if (!result) return;
    const { spectrum } = result;
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
      modes.update({ of: result, ...modesFigure(result, kind, madeUp) });
      table.replaceChildren(modesTable(spectrum, app));
    }
  };

  const show = (next) => {
    const before = now?.result?.made_of;
    now = next;
    if (now.running) wait.start(now.words || "Fitting the material");
    else wait.finish(now.result?.no_band ? `No 95 % band: ${now.result.no_band}.` : "");
    problem.set(now.error ? [app.explain(now.error, "spectrum")] : []);
    const { result } = now;
    for (const one of [first, second, third, fourth]) one.hidden = !result;
    numbers.set(result ? keyNumbers(result, app) : []);
    for (const one of [numbers, doubts, table]) shows(one, result);
    doubts.set(
      result ? [...(result.spectrum.fit?.notes ?? []), ...result.spectrum.notes, ...(result.band?.notes ?? [])] : [],
    );
    if (!result) return;
    at.show(result);
    if (result.made_of !== before) moved = null;
    draw();
    if (at.kelvin() !== null && (result.made_of !== before || now.complete)) request(at.kelvin());
  };
  follow(app, show);
  units.subscribe(() => now && show(now));
}
