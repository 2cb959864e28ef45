// Tools in the page's header: undo and redo, the menu of units, light and dark.

import { Select } from "./fields.js";
import { chooseTheme, isDark } from "./figures.js";
import { announce } from "./page.js";
import { html, view } from "./reactive.js";
import { state } from "./state.js";
import * as units from "./units.js";
import { Button, Icon } from "./views.js";

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

export const Tools = () => html`<${History} /><${Units} /><${Theme} />`;

/** Undo and redo by the keyboard; in a text field they are the field's. */
export function followKeys() {
  document.addEventListener("keydown", (event) => {
    const asked = (event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z";
    if (!asked || /^(text|number)$/.test(event.target.type ?? "")) return;
    event.preventDefault();
    change(event.shiftKey ? "redo" : "undo");
  });
}
