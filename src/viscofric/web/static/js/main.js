// The page: its steps, header, check of the document, and files that are dropped anywhere.

import { getStart, restarted } from "./api.js";
import { homeless } from "./fields.js";
import { Tools, attempt, failed, followKeys, guardWork, openFiles } from "./header.js";
import { Job, newest, result } from "./jobs.js";
import { bringSweeps, contactOf, explain, goTo, isSynthetic, named, page, sourceOf } from "./page.js";
import { effect, html, render, signal, view } from "./reactive.js";
import { state } from "./state.js";
import * as units from "./units.js";
import { Notes } from "./views.js";

/** What a job says in short of the inputs as they are. */
function said(name, part) {
  const { summary } = result(name) ?? {};
  return units.filled(part ? summary?.[part] : summary);
}
const joined = (...parts) => parts.filter(Boolean).join(", ");

const results = () => (result("export-study") ?? newest("export-run-file"))?.summary;

// The module of a step, whose default is its view, is fetched when somebody looks at it.
const STEPS = [
  ["sweeps", "Data", () => sourceOf(state.study), "./rubber/sweeps.js"],
  ["shift", "Shift", () => said("rubber", "shift"), "./rubber/shift.js"],
  ["spectrum", "Spectrum", () => said("rubber", "spectrum"), "./rubber/spectrum.js"],
  ["contact", "Contact and friction", () => joined(contactOf(state.study), said("curve")), "./steps/contact.js"],
  ["motion", "Motion in time", () => said("motion"), "./steps/motion.js"],
  ["measurement", "Measurement", () => joined(said("measured"), said("agreement")), "./steps/measurement.js"],
  ["export", "Export", results, "./steps/export.js"],
].map(([id, title, summary, module]) => ({ id, title, summary, module, content: signal(null) }));
const FIRST = "contact";
const RESTARTED = "The program behind this page was started again; your files were uploaded again.";
const { steps } = page;
for (const step of STEPS) steps.set(step.id, step);
const check = new Job("export-run-file", {
  wait: 200,
  when: () => steps.get(state.step)?.content.value, // what a step computes goes first
  inputs: () => ({ study: state.study }),
});

const Link = view(({ id, title, summary, number }) => {
  const go = (event) => {
    event.preventDefault();
    goTo(id);
  };
  return html`<li>
    <a href="#${id}" class="step-link" aria-current=${state.step === id ? "step" : undefined} onClick=${go}>
      <span class="step-number" aria-hidden="true">${number}</span>
      <span class="step-words"><span class="step-title">${title}</span><span class="step-summary">${summary()}</span></span>
    </a>
  </li>`;
});

/** A step's view, from when it is looked at first; one that cannot be had leaves the others alone. */
async function fetched({ module, content }) {
  try {
    content.value = (await import(module)).default;
  } catch (error) {
    console.error(error);
    content.value = () => html`<${Notes} kind="error" list=${[`This step could not be shown: ${error.message}`]} />`;
  }
}

const Section = view(({ step }, self) => {
  const { id, title, content } = step;
  const seen = state.step === id;
  if (seen && !self.asked) self.asked = fetched(step);
  return html`<section class="step" id="step-${id}" hidden=${!seen} aria-labelledby="title-${id}">
    <h1 tabindex="-1" id="title-${id}">${title}</h1>
    ${self.asked && html`<div class="step-body">${content.value && html`<${content.value} />`}</div>`}
  </section>`;
});

/** Sentences that have no field, and the steps. */
const Main = view(() => {
  const elsewhere = homeless().map((problem) => explain(named(problem), state.step));
  return html`
    <${Notes} aria-live="polite" list=${[restarted.value === state.study && RESTARTED]} />
    <${Notes} kind="error" aria-live="assertive" list=${[...elsewhere, check.error?.message, failed.value?.message]} />
    ${STEPS.map((step) => html`<${Section} key=${step.id} step=${step} />`)}
  `;
});

const isProject = ({ name }) => /\.(toml|zip)$/i.test(name);

/** Projects dropped are opened; other files go to the place for files below them or that the step shows, or to the data. */
function takeFilesAnywhere() {
  const take = async (files) => {
    if (files.some(isProject)) return openFiles(files);
    bringSweeps();
    return (await import("./rubber/source.js")).takeTests(files);
  };
  const drags = (is) => document.body.classList.toggle("dragging", is);
  document.addEventListener("dragleave", ({ relatedTarget }) => relatedTarget || drags(false));
  document.addEventListener("dragover", (event) => {
    event.preventDefault();
    drags(event.dataTransfer.types.includes("Files"));
  });
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    drags(false);
    const files = [...event.dataTransfer.files];
    const seen = [...document.querySelectorAll(".drop-field")].find((one) => one.checkVisibility());
    const place = (event.target.closest(".drop-field") ?? seen)?.querySelector("input");
    if (!place || files.some(isProject)) attempt(() => take(files));
    else {
      place.files = event.dataTransfer.files;
      place.dispatchEvent(new Event("change"));
    }
  });
}

async function begin() {
  const main = document.getElementById("main");
  try {
    page.start = await getStart();
  } catch (error) {
    render(html`<${Notes} kind="error" list=${[`The page could not be started: ${error.message}`]} />`, main);
    return;
  }
  state.begin(page.start.study);
  const fromAddress = () => (steps.has(location.hash.slice(1)) ? location.hash.slice(1) : (state.step ?? FIRST));
  render(html`<${Tools} />`, document.getElementById("tools"));
  render(
    STEPS.map((step, at) => html`<${Link} ...${step} number=${at + 1} />`),
    document.getElementById("steps"),
  );
  render(html`<${Main} />`, main);
  followKeys();
  guardWork();
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
