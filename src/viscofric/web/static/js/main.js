// The page: its steps, header, check of the document, and what is told to screen readers.

import * as figures from "./figures.js";
import * as fields from "./fields.js";
import { headerTools } from "./header.js";
import { state } from "./state.js";
import * as units from "./units.js";

const { h } = fields;
const STEPS = ["sweeps", "shift", "spectrum", "contact", "measurement", "export"];
const TITLES = {
  sweeps: "Data",
  shift: "Shift",
  spectrum: "Spectrum",
  contact: "Contact and friction",
  measurement: "Measurement",
  export: "Export",
};
const FIRST = "contact";

const app = { state, units, figures, fields, api: null, start: null, goTo, announce };
const steps = new Map();
let current = null;

/** Tell a screen reader, and nobody else. */
function announce(text) {
  const place = document.getElementById("announcements");
  place.textContent = "";
  setTimeout(() => (place.textContent = text), 50);
}

/** Show a step, and put the focus on its heading. */
function goTo(id, { focus = true } = {}) {
  if (!steps.has(id)) return;
  if (location.hash !== `#${id}`) history.pushState(null, "", `#${id}`);
  current = id;
  for (const [one, step] of steps) {
    step.section.hidden = one !== id;
    if (one === id) step.link.setAttribute("aria-current", "step");
    else step.link.removeAttribute("aria-current");
  }
  const step = steps.get(id);
  if (!step.mounted) {
    step.mounted = true;
    mount(step);
  }
  document.title = `${step.title} · viscofric`;
  step.link.scrollIntoView({ block: "nearest", inline: "nearest" });
  if (focus) {
    window.scrollTo(0, 0);
    step.heading.focus({ preventScroll: true });
  }
}

async function mount(step) {
  try {
    await step.module.mount(step.body, app);
  } catch (error) {
    console.error(error);
    step.body.append(fields.note([`This step could not be shown: ${error.message}`], "error"));
  }
}

function summarise() {
  for (const step of steps.values()) {
    let text = "";
    try {
      text = step.module.summary?.(state) ?? "";
    } catch (error) {
      console.error(error);
    }
    step.summary.textContent = text;
  }
}

/** A step whose module is not there says so, and leaves the others alone. */
async function load(id) {
  try {
    return (await import(`./steps/${id}.js`)).default;
  } catch (error) {
    return {
      id,
      title: TITLES[id],
      mount: (section) => section.append(fields.note([`This step could not be loaded: ${error.message}`], "warning")),
    };
  }
}

function addStep(id, number, module) {
  const title = module.title ?? TITLES[id];
  const summary = h("span", { class: "step-summary" });
  const link = h(
    "a",
    { href: `#${id}`, class: "step-link" },
    h("span", { class: "step-number", "aria-hidden": "true" }, String(number)),
    h("span", { class: "step-words" }, h("span", { class: "step-title" }, title), summary),
  );
  link.addEventListener("click", (event) => {
    event.preventDefault();
    goTo(id);
  });
  document.getElementById("steps").append(h("li", {}, link));
  const heading = h("h1", { tabindex: "-1", id: `title-${id}` }, title);
  const body = h("div", { class: "step-body" });
  const section = h(
    "section",
    { class: "step", id: `step-${id}`, hidden: true, "aria-labelledby": `title-${id}` },
    heading,
    body,
  );
  document.getElementById("main").append(section);
  steps.set(id, { id, title, module, link, summary, section, heading, body, mounted: false });
}

function showSynthetic() {
  const name = state.get("material.catalogue");
  const entry = app.start.catalogue?.find((one) => one.name === name);
  document.getElementById("synthetic").hidden = !(entry?.synthetic || state.get("data_origin") === "synthetic");
}

/** Have the document checked after each change, and each sentence shown beside its field. */
function watch() {
  const elsewhere = fields.note([], "error");
  elsewhere.setAttribute("role", "alert");
  document.getElementById("main").prepend(elsewhere);
  let timer = null;
  let running = null;
  const check = async () => {
    running?.abort();
    running = new AbortController();
    try {
      const found = await app.api.runJob(
        "export-run-file",
        { study: state.study, options: {} },
        { signal: running.signal },
      );
      elsewhere.set(fields.showErrors(found.problems).map((problem) => problem.message));
      state.setResult("run_file", found);
    } catch (error) {
      if (error.name !== "AbortError") elsewhere.set([error.message]);
    }
  };
  state.subscribe("", () => {
    clearTimeout(timer);
    timer = setTimeout(check, 200);
  });
  check();
}

async function begin() {
  const main = document.getElementById("main");
  try {
    app.api = await import("./api.js");
    const [start, ...modules] = await Promise.all([app.api.getStart(), ...STEPS.map(load)]);
    app.start = start;
    state.begin(start.study);
    document.getElementById("tools").append(...headerTools(announce));
    STEPS.forEach((id, at) => addStep(id, at + 1, modules[at]));
  } catch (error) {
    main.append(fields.note([`The page could not be started: ${error.message}`], "error"));
    return;
  }
  state.subscribe("", () => {
    summarise();
    showSynthetic();
  });
  for (const key of [
    "run_file",
    "sweeps",
    "rubber",
    "shift",
    "spectrum",
    "curve",
    "contact",
    "measured",
    "agreement",
    "export",
  ])
    state.onResult(key, summarise);
  summarise();
  showSynthetic();
  document.querySelector(".skip").addEventListener("click", (event) => {
    event.preventDefault();
    steps.get(current).heading.focus();
  });
  const fromAddress = () => (steps.has(location.hash.slice(1)) ? location.hash.slice(1) : (current ?? FIRST));
  window.addEventListener("popstate", () => fromAddress() !== current && goTo(fromAddress()));
  goTo(fromAddress(), { focus: false });
  watch();
}

begin();
