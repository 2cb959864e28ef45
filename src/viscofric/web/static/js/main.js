// The page: its steps, header, check of the document, and sentences for screen readers.

import * as api from "./api.js";
import * as figures from "./figures.js";
import * as fields from "./fields.js";
import { Tools, followKeys } from "./header.js";
import { Job, newest, result } from "./jobs.js";
import { Component, effect, html, render, view } from "./reactive.js";
import { state } from "./state.js";
import contact from "./steps/contact.js";
import * as units from "./units.js";
import { Button, Notes } from "./views.js";

/** A step whose module is fetched when somebody looks at it. */
const later = (id, title, summary, module, show = "mount") => ({
  id,
  title,
  summary,
  mount: async (section, app) => (await import(module))[show](section, app),
});

function source(state) {
  const rubbers = [state.get("material") ?? {}].flat();
  if (rubbers.length > 1) return `${rubbers.length} materials`;
  const value = ["dma", "creep", "relaxation", "ramps", "master_curve", "file", "catalogue"]
    .map((key) => rubbers[0][key])
    .find((one) => one !== undefined);
  if (value === undefined) return "no material yet";
  return Array.isArray(value) && value.length > 1 ? `${value.length} files` : String(value);
}

function superposition() {
  const rubber = result("rubber");
  if (!rubber) return "";
  if (!rubber.shift) return "no shift with temperature";
  return rubber.check?.short ?? (rubber.shift.used === "assumed" ? "assumed law" : "from the material file");
}

function modes() {
  const spectrum = result("rubber")?.spectrum;
  if (!spectrum) return "";
  return spectrum.modes ? `${spectrum.modes.retardation_time.length} modes` : "a table of moduli";
}

function motion() {
  const solved = result("motion");
  if (!solved) return "";
  if (solved.contacts) return `restitution ${solved.contacts[0].restitution.toPrecision(2)}`;
  return `${solved.time.length} times${solved.interrupted ? ", stopped" : ""}`;
}

function agreement() {
  const measured = result("measured");
  if (!measured?.curves) return measured?.refusal ? "not separated" : "";
  const rms = result("agreement")?.key?.[0]?.value;
  return `${measured.points} points${rms ? `, predicted to ${rms}` : ""}`;
}

function results() {
  const done = result("export-study");
  const cases = newest("export-run-file")?.cases;
  if (done) return `${done.cases} cases, results ready`;
  return cases ? `run file: ${cases} case${cases === 1 ? "" : "s"}` : "";
}

const STEPS = [
  later("sweeps", "Data", source, "./rubber/sweeps.js"),
  later("shift", "Shift", superposition, "./rubber/shift.js"),
  later("spectrum", "Spectrum", modes, "./rubber/spectrum.js"),
  contact,
  later("motion", "Motion in time", motion, "./steps/motion.js"),
  later("measurement", "Measurement", agreement, "./steps/measurement_view.js"),
  later("export", "Export", results, "./steps/export_view.js", "show"),
];
// Where the fields of a study's tables are, but for those of a rubber that other steps have.
const PLACES = {
  material: "sweeps",
  history: "motion",
  measurement: "measurement",
  outputs: "export",
  title: "export",
  cluster: "export",
};
const OF_RUBBER = {
  shift: ["shift", "vertical_shift", "shift_factors", "fixed_shift_factors"],
  spectrum: ["spectrum", "modes", "tau_ratio"],
};
const FIRST = "contact";

const app = { state, units, figures, fields, api, start: null, goTo, announce, explain, waits, isSynthetic };
const steps = new Map(STEPS.map((step) => [step.id, step]));
const check = new Job("export-run-file", { wait: 200, inputs: () => ({ study: state.study }) });

/** A sentence for screen readers alone. */
function announce(text) {
  const place = document.getElementById("announcements");
  place.textContent = "";
  setTimeout(() => (place.textContent = text), 50);
}

/** The step that has the field of a path of the study. */
function stepOf(path) {
  const [table, key] = (path ?? "").replace(/\[\d+\]/g, "").split(".");
  if (table === "material")
    return Object.keys(OF_RUBBER).find((step) => OF_RUBBER[step].includes(key)) ?? PLACES.material;
  return PLACES[table] ?? "contact";
}

/** An error for a note of a step: its sentence, and a way to the step where it can be mended. */
function explain(error, here) {
  const step = error.field ? stepOf(error.field) : here;
  if (step === here || !steps.has(step)) return error.message;
  const go = html`<${Button} kind="small" onClick=${() => goTo(step)}>Go to ${steps.get(step).title}<//>`;
  return html`${error.message} ${go}`;
}

/** The same for the contact's step, which does not repeat the sentence at the field. */
function waits(what, error) {
  const beside = fields.homeOf(error.field) !== undefined && stepOf(error.field) === "contact";
  return beside ? `Fix the marked field to update ${what}.` : explain(error, "contact");
}

/** Bring a link of the rail into sight.  Not by scrollIntoView: from there on, the tab key would pass over the skip link. */
function scrollRailTo(link) {
  const rail = link.closest(".rail");
  const [outer, inner] = [rail.getBoundingClientRect(), link.getBoundingClientRect()];
  rail.scrollBy(
    Math.min(inner.left - outer.left, 0) || Math.max(inner.right - outer.right, 0),
    Math.min(inner.top - outer.top, 0) || Math.max(inner.bottom - outer.bottom, 0),
  );
}

/** Show a step, and put the focus on its heading. */
function goTo(id, { focus = true } = {}) {
  if (!steps.has(id)) return;
  if (location.hash !== `#${id}`) history.pushState(null, "", `#${id}`);
  state.lookAt(id);
  document.title = `${steps.get(id).title} · viscofric`;
  // once the step is seen
  setTimeout(() => {
    scrollRailTo(document.querySelector(`#steps a[href="#${id}"]`));
    if (!focus) return;
    window.scrollTo(0, 0);
    document.getElementById(`title-${id}`).focus({ preventScroll: true });
  });
}

const Link = view(({ id, title, summary, number }) => {
  const go = (event) => {
    event.preventDefault();
    goTo(id);
  };
  return html`<li>
    <a href="#${id}" class="step-link" aria-current=${state.step === id ? "step" : undefined} onClick=${go}>
      <span class="step-number" aria-hidden="true">${number}</span>
      <span class="step-words"><span class="step-title">${title}</span><span class="step-summary">${summary(state)}</span></span>
    </a>
  </li>`;
});

/** What a step has made of an element, from when it is looked at first; one that cannot be had leaves the others alone. */
class Body extends Component {
  shouldComponentUpdate() {
    return false;
  }
  async componentDidMount() {
    try {
      await this.props.step.mount(this.place, app);
    } catch (error) {
      console.error(error);
      render(html`<${Notes} kind="error" list=${[`This step could not be shown: ${error.message}`]} />`, this.place);
    }
  }
  render() {
    return html`<div class="step-body" ref=${(place) => (this.place = place)} />`;
  }
}

const Section = view(({ step }, self) => {
  const { id, title } = step;
  const seen = state.step === id;
  self.wasSeen ||= seen;
  return html`<section class="step" id="step-${id}" hidden=${!seen} aria-labelledby="title-${id}">
    <h1 tabindex="-1" id="title-${id}">${title}</h1>
    ${self.wasSeen && html`<${Body} step=${step} />`}
  </section>`;
});

/** Sentences that have no field, and the steps. */
const Main = view(() => {
  const failed = check.error ? [check.error.message] : [];
  const elsewhere = fields.homeless().map((problem) => explain(named(problem), state.step));
  return html`
    <${Notes} kind="error" aria-live="assertive" list=${[...elsewhere, ...failed]} />
    ${STEPS.map((step) => html`<${Section} key=${step.id} step=${step} />`)}
  `;
});

/** Files dropped beside a place for files go to the first place of the step, or else to that of the data. */
function takeFilesAnywhere() {
  const place = () =>
    [...document.querySelectorAll(".step:not([hidden]) .drop-field")]
      .find((one) => one.checkVisibility())
      ?.querySelector("input");
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", (event) => {
    if (event.defaultPrevented) return;
    event.preventDefault();
    const { files } = event.dataTransfer;
    if (files.length === 0) return;
    const given = new DataTransfer();
    for (const file of files) given.items.add(file);
    const hand = (left) => {
      const input = place();
      if (!input) return left > 0 && setTimeout(() => hand(left - 1), 50);
      input.files = given.files;
      input.dispatchEvent(new Event("change"));
      return true;
    };
    if ([...files].some(({ name }) => name.toLowerCase().endsWith(".toml"))) goTo("export");
    else if (!place()) {
      state.setView("sweeps.source", "dma");
      goTo("sweeps");
    }
    setTimeout(() => hand(40));
  });
}

/** Whether a study rests on synthetic data. */
function isSynthetic(study) {
  const names = [study.material ?? []].flat().map((material) => material.catalogue);
  return (
    study.data_origin === "synthetic" || app.start.catalogue.some((one) => one.synthetic && names.includes(one.name))
  );
}

/** A problem without a field on the page, with what it is about before its sentence. */
function named({ field, message }) {
  const about = field ? `${steps.get(stepOf(field)).title}: ${message[0].toLowerCase()}${message.slice(1)}` : message;
  return { field, message: about };
}

async function begin() {
  const main = document.getElementById("main");
  try {
    app.start = await api.getStart();
  } catch (error) {
    render(html`<${Notes} kind="error" list=${[`The page could not be started: ${error.message}`]} />`, main);
    return;
  }
  state.begin(app.start.study);
  const fromAddress = () => (steps.has(location.hash.slice(1)) ? location.hash.slice(1) : (state.step ?? FIRST));
  render(html`<${Tools} announce=${announce} />`, document.getElementById("tools"));
  render(STEPS.map((step, at) => html`<${Link} ...${step} number=${at + 1} />`), document.getElementById("steps"));
  render(html`<${Main} />`, main);
  followKeys(announce);
  takeFilesAnywhere();
  effect(() => void (document.getElementById("synthetic").hidden = !isSynthetic(state.study)));
  document.querySelector(".skip").addEventListener("click", (event) => {
    event.preventDefault();
    document.getElementById(`title-${state.step}`).focus();
  });
  window.addEventListener("popstate", () => fromAddress() !== state.step && goTo(fromAddress()));
  goTo(fromAddress(), { focus: false });
  check.start();
}

begin();
