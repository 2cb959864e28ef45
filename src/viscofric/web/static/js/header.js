// Tools in the page's header: undo and redo, the menu of units, light and dark.

import { chooseTheme, isDark } from "./figures.js";
import { button, h, icon } from "./parts.js";
import { effect } from "./reactive.js";
import { state } from "./state.js";
import * as units from "./units.js";

/** All tools; `announce` gives screen readers a sentence on what was done. */
export function headerTools(announce) {
  return [...undoButtons(announce), ...unitsMenu(), themeButton()];
}

function unitsMenu() {
  const panel = h("div", { class: "menu", id: "units-menu", popover: "auto", role: "dialog", "aria-label": "Units" });
  const opener = h(
    "button",
    { type: "button", class: "button quiet", "aria-label": "Units", popovertarget: "units-menu" },
    icon("units"),
    h("span", {}, "Units"),
  );
  const fill = () => {
    const rows = units.choices().map(({ kind, title, units: all, chosen }) => {
      const select = h(
        "select",
        { id: `unit-${kind}` },
        all.map((one) => h("option", { value: one, selected: one === chosen }, one)),
      );
      select.addEventListener("change", () => units.choose(kind, select.value));
      return [h("label", { for: `unit-${kind}` }, title), select];
    });
    const sets = units.systems.map((name) => button({ label: name, kind: "small", onClick: () => units.choose(name) }));
    panel.replaceChildren(
      h("div", { class: "menu-sets", role: "group", "aria-label": "Sets of units" }, sets),
      h("div", { class: "menu-grid" }, rows.flat()),
    );
  };
  effect(() => {
    const focused = document.activeElement?.id;
    fill();
    if (focused) document.getElementById(focused)?.focus();
  });
  return [opener, panel];
}

function themeButton() {
  const toggle = h("button", { type: "button", class: "button quiet" }, icon("theme"));
  toggle.addEventListener("click", () => chooseTheme(isDark() ? "light" : "dark"));
  effect(() => {
    toggle.setAttribute("aria-label", isDark() ? "Dark; change to light" : "Light; change to dark");
    toggle.title = isDark() ? "Light" : "Dark";
  });
  return toggle;
}

function undoButtons(announce) {
  const change = (how, word) => () => state[how]() && announce(`${word}.`);
  const undo = h(
    "button",
    {
      type: "button",
      class: "button quiet",
      title: "Undo (Ctrl+Z)",
      "aria-label": "Undo",
      onclick: change("undo", "Undone"),
    },
    icon("undo"),
  );
  const redo = h(
    "button",
    {
      type: "button",
      class: "button quiet",
      title: "Redo (Ctrl+Shift+Z)",
      "aria-label": "Redo",
      onclick: change("redo", "Redone"),
    },
    icon("redo"),
  );
  effect(() => {
    undo.disabled = !state.canUndo;
    redo.disabled = !state.canRedo;
  });
  document.addEventListener("keydown", (event) => {
    if (
      !(event.ctrlKey || event.metaKey) ||
      event.key.toLowerCase() !== "z" ||
      /^(text|number)$/.test(event.target.type ?? "")
    )
      return;
    event.preventDefault();
    (event.shiftKey ? redo : undo).click();
  });
  return [undo, redo];
}
