// Step 4, with which the page opens: what slides, its friction curve, and one contact that follows two sliders.

import { contactFigures } from "../contact_fields.js";
import { contactForm, nounOf } from "../contact_form.js";
import { numbersOf, whyItLeans } from "../contact_words.js";
import { frictionCard } from "../friction_curve.js";
import { DEPENDS_ON, outdated, shows, studyOf } from "../inputs.js";
import { follow } from "../live.js";
import { welcome } from "../welcome.js";

const STEPS = 400; // of the speed's slider
const DECADE = 1; // beyond the speeds of the study, on either side
const BEYOND = 15; // K beyond its temperatures

/** The ends of the quantities that the document gives as one value, a list or a range; null where they cannot be read. */
export function endsOf(given, kind, units) {
  const range = given && typeof given === "object" && !Array.isArray(given);
  const all = (range ? [given.from, given.to] : [given].flat())
    .map((one) => units.parse(one, kind))
    .filter((one) => one !== null);
  return all.length ? [Math.min(...all), Math.max(...all)] : null;
}

function mount(section, app) {
  const { state, units, fields } = app;
  const { h, card } = fields;
  const number = fields.note([], "warning");
  const failed = fields.note([], "error");
  const numbers = fields.keyNumbers([]);
  const rows = h("tbody");
  const why = h("p", { class: "why", "aria-live": "off" });
  const status = h("span", { class: "help live-status", role: "status" });
  const pictures = contactFigures(app);
  const more = h(
    "div",
    { class: "more-numbers" },
    h("h3", {}, "Results with their numerical errors"),
    h("table", {}, rows),
  );
  pictures.grid.append(more);
  let position = { speed: null, temperature: null };
  let result = null;

  const curve = frictionCard(app, { onPick: (where) => moveTo(where) });
  const live = follow({
    request: (where, stage, signal) =>
      app.api.runJob(
        "contact",
        {
          study: where.study,
          options: {
            speed: where.speed,
            temperature: where.temperature,
            combination: where.combination,
            stages: stage,
          },
        },
        { signal },
      ),
    show,
    fail: (error) => {
      // a position beyond the rubber is the sliders', no field's
      const beyond = error.field === "conditions.temperature";
      failed.set([beyond ? error.message : app.waits("the contact", error, "live")]);
      outdated(result);
    },
    busy: (stage) =>
      (status.textContent = {
        coarse: "solving …",
        sharp: "refining …",
        "": result ? (result.stage === "sharp" ? "converged" : "coarse") : "",
      }[stage]),
  });

  /** A slider with a number field: both show and change one of the two coordinates. */
  function control(name, label, kind, { toSlider, fromSlider, steps }) {
    const id = `live-${name}`;
    const slider = h("input", { type: "range", id, min: 0, max: steps, step: 1 });
    const text = h("input", {
      type: "text",
      class: "live-number",
      "aria-label": `${label}, as a number`,
      autocomplete: "off",
      spellcheck: "false",
    });
    slider.addEventListener("input", () => moveTo({ [name]: fromSlider(Number(slider.value)) }));
    text.addEventListener("change", () => {
      const typed = text.value.trim();
      const value = /^[+−-]?[\d.]+(e[+-]?\d+)?$/i.test(typed)
        ? units.si(Number(typed.replace("−", "-")), kind)
        : units.parse(typed, kind);
      if (value !== null && Number.isFinite(value) && value > 0) moveTo({ [name]: value });
      refresh();
    });
    function refresh() {
      const value = position[name];
      if (value === null) return;
      slider.value = String(Math.round(toSlider(value)));
      slider.setAttribute("aria-valuetext", units.show(value, kind));
      if (document.activeElement !== text) text.value = units.show(value, kind);
    }
    const element = h(
      "div",
      { class: "field live-control" },
      h("label", { for: id, class: "field-label" }, label),
      h("div", { class: "row" }, slider, text),
    );
    return { element, refresh };
  }

  const speeds = () => {
    const ends = endsOf(state.get("conditions.speed"), "speed", units) ?? [1e-3, 1];
    return [Math.log10(ends[0]) - DECADE, Math.log10(ends[1]) + DECADE];
  };
  const kelvins = () => {
    const ends = endsOf(state.get("conditions.temperature"), "temperature", units) ?? [303.15, 363.15];
    return [ends[0] - BEYOND, ends[1] + BEYOND];
  };
  const along = ([low, high], value) => Math.min(Math.max((value - low) / (high - low), 0), 1);
  const rounded = (value, digits) => Number(value.toPrecision(digits));
  const controls = [
    control("speed", "Speed", "speed", {
      steps: STEPS,
      toSlider: (value) => STEPS * along(speeds(), Math.log10(value)),
      fromSlider: (at) => rounded(10 ** (speeds()[0] + (at / STEPS) * (speeds()[1] - speeds()[0])), 3),
    }),
    control("temperature", "Temperature", "temperature", {
      steps: 240,
      toSlider: (value) => 240 * along(kelvins(), value),
      fromSlider: (at) =>
        rounded(273.15 + Math.round(2 * (kelvins()[0] - 273.15 + (at / 240) * (kelvins()[1] - kelvins()[0]))) / 2, 7),
    }),
  ];

  function moveTo(where) {
    position = { ...position, ...where };
    state.setView("contact.position", position);
    for (const one of controls) one.refresh();
    live.want({ ...position, combination: curve.combination, study: state.study });
  }

  function show(found, where) {
    result = Object.assign(found, { combination: where.combination });
    const noun = nounOf(where.study);
    failed.set([]);
    fields.clearError("live");
    for (const one of [numbers, rows.parentElement, why.parentElement, number]) shows(one, result);
    number.set(found.warnings);
    pictures.show(found, { noun, synthetic: app.isSynthetic(studyOf(found)) });
    curve.mark(result);
    words();
    state.setResult("contact", result);
  }

  function words() {
    if (!result) return;
    const radius = ["ball", "cylinder"].includes(nounOf(state.study))
      ? units.parse(state.get("indenter.radius"), "length")
      : null;
    const { key, others } = numbersOf(result, units);
    numbers.set(key);
    rows.replaceChildren(
      ...others.map(({ label, value, remark }) =>
        h("tr", {}, h("th", { scope: "row" }, label), h("td", {}, value), h("td", {}, remark)),
      ),
    );
    why.textContent = whyItLeans(result, units, nounOf(state.study), radius);
  }

  const liveCard = card(
    "One contact, live",
    h(
      "div",
      { class: "live-controls" },
      controls.map((one) => one.element),
      status,
    ),
    failed,
    h(
      "div",
      { class: "live-contact" },
      numbers,
      h("div", { class: "why-box" }, h("h3", {}, "Cause of the friction"), why),
      number,
      pictures.grid,
    ),
  );

  section.append(
    welcome(app),
    h("div", { class: "columns" }, h("div", {}, contactForm(app)), h("div", {}, curve.card, liveCard)),
  );

  /** Where the sliders begin: what a reload keeps, or the middle of the study. */
  function begin() {
    const kept = state.view("contact.position", null);
    const [low, high] = speeds();
    const [cold, warm] = kelvins();
    const middle = { speed: rounded(10 ** (0.5 * (low + high)), 2), temperature: rounded(0.5 * (cold + warm), 7) };
    moveTo(kept?.speed && kept?.temperature ? kept : middle);
  }

  let timer = null;
  state.subscribe(DEPENDS_ON.contact, () => {
    clearTimeout(timer);
    timer = setTimeout(() => moveTo({}), 200);
  });
  state.subscribe(["conditions.speed", "conditions.temperature"], () => controls.forEach((one) => one.refresh()));
  units.subscribe(() => {
    for (const one of controls) one.refresh();
    words();
  });
  begin();
}

function summary(state) {
  const { indenter, surface, conditions } = state.study;
  const load = conditions?.load ?? conditions?.pressure;
  const what = surface
    ? "rough surface"
    : [indenter?.shape ?? "ball", [indenter?.radius ?? indenter?.angle].flat()[0]].filter(Boolean).join(" ");
  const found = state.result("curve")?.friction?.filter((value) => value !== null) ?? [];
  const range = found.length ? `, μ ${Math.min(...found).toPrecision(2)} to ${Math.max(...found).toPrecision(2)}` : "";
  return `${what}, ${[load].flat()[0] ?? "no load"}${range}`;
}

export default { id: "contact", title: "Contact and friction", summary, mount };
