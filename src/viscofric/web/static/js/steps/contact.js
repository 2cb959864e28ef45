// Step 4, with which the page opens: what slides, its friction curve, and one contact that follows two sliders.

import { contactFigures } from "../contact_fields.js";
import { contactForm, nounOf } from "../contact_form.js";
import { numbersOf, whyItLeans } from "../contact_words.js";
import { frictionCard } from "../friction_curve.js";
import { Job, result, shows, studyOf } from "../jobs.js";
import { follow } from "../live.js";
import { effect, signal, untracked } from "../reactive.js";
import { state } from "../state.js";

const STEPS = 400; // of the speed's slider
const DECADE = 1; // beyond the speeds of the study, on either side
const BEYOND = 15; // K beyond its temperatures
const REST = 200; // ms after a change of the form

/** The ends of the quantities that the document gives as one value, a list or a range; null where they cannot be read. */
export function endsOf(given, kind, units) {
  const range = given && typeof given === "object" && !Array.isArray(given);
  const all = (range ? [given.from, given.to] : [given].flat())
    .map((one) => units.parse(one, kind))
    .filter((one) => one !== null);
  return all.length ? [Math.min(...all), Math.max(...all)] : null;
}

const combination = signal(0); // of all else that varies in the study
const contact = new Job("contact", {
  follows: true,
  inputs: () => {
    const { speed, temperature } = state.view("contact.position", {});
    return speed ? { study: state.study, options: { speed, temperature, combination: combination.value } } : null;
  },
});

function mount(section, app) {
  const { units, fields } = app;
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
  const curve = frictionCard(app, { combination, onPick: (where) => moveTo(where), live: contact });
  const live = follow({
    request: ({ study, options }, stages, signal) =>
      app.api.runJob("contact", { study, options: { ...options, stages } }, { signal }),
    show: (found, asked) => contact.put(asked, found),
    fail: (error, asked) => contact.refuse(asked, error),
    busy: (stage) => (contact.moving.value = stage && { done: 0, total: 0, label: stage }),
  });
  const WORDS = { coarse: "solving …", sharp: "refining …" };
  effect(() => {
    const ended = contact.current ? (contact.current.stage === "sharp" ? "converged" : "coarse") : "";
    status.textContent = WORDS[contact.progress?.label] ?? ended;
  });
  effect(() => {
    const { error } = contact;
    // a position beyond the rubber is the sliders', no field's
    const beyond = error?.field === "conditions.temperature";
    failed.set(error ? [beyond ? error.message : app.waits("the contact", error)] : []);
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
      const value = state.view("contact.position")?.[name];
      if (!value) return;
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
    effect(refresh);
    return element;
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
    state.setView("contact.position", { ...state.view("contact.position", {}), ...where });
  }

  effect(() => {
    const found = contact.result;
    if (!found) return;
    const study = studyOf(found);
    const noun = nounOf(study);
    for (const one of [numbers, rows.parentElement, why.parentElement, number]) shows(one, found);
    number.set(found.warnings);
    pictures.show(found, { noun, synthetic: app.isSynthetic(study) });
    const radius = ["ball", "cylinder"].includes(noun) ? units.parse(study.indenter?.radius, "length") : null;
    const { key, others } = numbersOf(found, units);
    numbers.set(key);
    rows.replaceChildren(
      ...others.map(({ label, value, remark }) =>
        h("tr", {}, h("th", { scope: "row" }, label), h("td", {}, value), h("td", {}, remark)),
      ),
    );
    why.textContent = whyItLeans(found, units, noun, radius);
  });

  const liveCard = card(
    "One contact, live",
    h(
      "div",
      { class: "live-controls" },
      controls,
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
    h("div", { class: "columns" }, h("div", {}, contactForm(app)), h("div", {}, curve, liveCard)),
  );

  // Where the sliders begin: what a reload keeps, or the middle of the study.
  const { speed, temperature } = state.view("contact.position", {});
  const [[low, high], [cold, warm]] = [speeds(), kelvins()];
  if (!speed || !temperature)
    moveTo({ speed: rounded(10 ** (0.5 * (low + high)), 2), temperature: rounded(0.5 * (cold + warm), 7) });

  // A slider is followed at once, a form when it rests.
  let timer = null;
  let about = null;
  effect(() => {
    clearTimeout(timer);
    void contact.mayWork;
    if (!contact.key.value) return;
    const waits = about !== null && about !== contact.about.value;
    about = contact.about.value;
    const want = () => live.want(contact.inputs.peek());
    if (waits) timer = setTimeout(want, REST);
    else untracked(want);
  });
}

/** What the page is for, what it shows, and where one's own data go; short once they are there. */
function welcome({ start, fields, goTo }) {
  const { h, button } = fields;
  const first = h(
    "section",
    { class: "welcome", "aria-label": "What this page does" },
    h(
      "p",
      {},
      h("strong", {}, "Hysteresis friction (rolling resistance) from DMA data. "),
      "Sliding or rolling deforms rubber, and the dissipated energy causes friction. This page computes it from DMA data ",
      "alone. The example is a synthetic material: change shape, load, speed or temperature, and the result updates.",
    ),
    h(
      "div",
      { class: "row" },
      button({
        label: "Use my DMA file",
        kind: "main",
        onClick: () => {
          state.setView("sweeps.source", "dma");
          goTo("sweeps");
        },
      }),
      button({ label: "Compare with my friction test", onClick: () => goTo("measurement") }),
      h("span", { class: "help" }, "Your files stay on this computer."),
    ),
  );
  const later = h("p", {}, "Change shape, load, speed or temperature, and the friction is computed again.");
  effect(() => {
    const name = state.get("material.catalogue");
    first.hidden = name === undefined || name !== start.study.material?.catalogue;
    later.hidden = !first.hidden;
  });
  return h("div", { class: "intro" }, first, later);
}

function summary(state) {
  const { indenter, surface, conditions } = state.study;
  const load = conditions?.load ?? conditions?.pressure;
  const what = surface
    ? "rough surface"
    : [indenter?.shape ?? "ball", [indenter?.radius ?? indenter?.angle].flat()[0]].filter(Boolean).join(" ");
  const found = result("curve")?.friction?.filter((value) => value !== null) ?? [];
  const range = found.length ? `, μ ${Math.min(...found).toPrecision(2)} to ${Math.max(...found).toPrecision(2)}` : "";
  return `${what}, ${[load].flat()[0] ?? "no load"}${range}`;
}

export default { id: "contact", title: "Contact and friction", summary, mount };
