// Tools in the page's header: the project saved and opened, undo and redo, the menu of units, light and dark.

import { downloadUrl, keep, runJob, uploadFiles } from "./api.js";
import { Select } from "./fields.js";
import { chooseTheme, isDark } from "./figures.js";
import { announce, attempts } from "./page.js";
import { html, lasting, view } from "./reactive.js";
import { state } from "./state.js";
import * as units from "./units.js";
import { Button, Icon } from "./views.js";

export const [attempt, failed] = attempts();
const saved = lasting("sessionStorage", "viscofric.saved", ""); // the study that was saved or opened last

/** Save the project: download the run file with its data. */
export async function pack() {
  const found = await runJob("export-run-file", { study: state.study, options: { pack: true } });
  const { name } = found.download;
  Object.assign(document.createElement("a"), { href: downloadUrl(name), download: name }).click();
  saved.value = JSON.stringify(state.study);
  return "The zip file is ready.";
}

/** Take in data files, and show the study of a run file among them, or of a zip file with both. */
export async function openFiles(files) {
  const given = files.find((file) => /\.toml$/i.test(file.name));
  const names = await uploadFiles(files.filter((file) => file !== given));
  const archive = names.find((name) => /\.zip$/i.test(name));
  if (!given && !archive) throw new Error("No run file was given; its name ends with .toml, or .zip with its data.");
  const options = given ? { text: await given.text() } : { archive };
  const open = () => runJob("open-run-file", { options });
  const { study, missing, files: unpacked } = await open();
  keep("opened", open);
  state.renew(unpacked);
  state.replace(study);
  saved.value = JSON.stringify(state.study);
  return `${given?.name ?? archive} is opened.${missing.length ? ` Missing data files: ${missing.join(", ")}.` : ""}`;
}

const chooser = Object.assign(document.createElement("input"), { type: "file", multiple: true });
chooser.onclick = () => (chooser.value = ""); // the same file may be opened again
chooser.onchange = () => attempt(() => openFiles([...chooser.files]));
const Project = () => html`
  <${Button} kind="quiet" symbol="down" aria-label="Save project" onClick=${() => attempt(pack)}><span>Save project</span><//>
  <${Button} kind="quiet" symbol="file" aria-label="Open project" onClick=${() => chooser.click()}><span>Open project</span><//>
`;

const Units = view(() => {
  const row = ({ kind, title, units: all, chosen }) => html`
    <label for="unit-${kind}">${title}</label>
    <${Select} id="unit-${kind}" options=${all} value=${chosen} onChange=${(one) => units.choose(kind, one)} />
  `;
  const set = (name) => html`<${Button} kind="small" onClick=${() => units.choose(name)}>${name}<//>`;
  return html`
    <button type="button" class="button quiet" aria-label="Units" popovertarget="units-menu">
      <${Icon} name="units" /><span>Units</span>
    </button>
    <div class="menu" id="units-menu" popover="auto" role="dialog" aria-label="Units">
      <div class="menu-sets" role="group" aria-label="Sets of units">${units.systems.map(set)}</div>
      <div class="menu-grid">${units.choices().map(row)}</div>
    </div>
  `;
});

const Theme = view(() => {
  const [now, other] = isDark() ? ["Dark", "light"] : ["Light", "dark"];
  return html`<${Button} kind="quiet" symbol="theme" aria-label="${now}; change to ${other}"
    title=${isDark() ? "Light" : "Dark"} onClick=${() => chooseTheme(other)} />`;
});

const WAYS = [
  ["undo", "Undo", "Ctrl+Z", "canUndo"],
  ["redo", "Redo", "Ctrl+Shift+Z", "canRedo"],
];
const change = (way) => state[way]() && announce(way === "undo" ? "Undone." : "Redone.");

const History = view(() =>
  WAYS.map(
    ([way, label, keys, can]) =>
      html`<${Button} kind="quiet" symbol=${way} title="${label} (${keys})" aria-label=${label} disabled=${!state[can]}
        onClick=${() => change(way)} />`,
  ),
);

export const Tools = () => html`<${Project} /><${History} /><${Units} /><${Theme} />`;

/** Undo and redo by the keyboard; in a text field they are the field's. */
export function followKeys() {
  document.addEventListener("keydown", (event) => {
    const asked = (event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z";
    if (!asked || /^(text|number)$/.test(event.target.type ?? "")) return;
    event.preventDefault();
    change(event.shiftKey ? "redo" : "undo");
  });
}

/** Closing the tab asks where there is work that no file has. */
export const guardWork = () =>
  window.addEventListener("beforeunload", (event) => {
    if (state.canUndo && JSON.stringify(state.study) !== saved.value) event.preventDefault();
  });
