// The page's state: the document of a study (the tables of a run file, as the user typed them), with undo, kept over reloads.
// It is held in signals: an effect, a computed value or a view that reads some of it follows that part.
//
// state.study                       the document, frozen; never change it in place
// state.get("conditions.load")      a value, or undefined; paths like "material.dma[1]" reach into lists
//                                   and a key of a list of tables, such as several [[material]], is that of the first
// state.set(path, value)            changes one key (undefined or null removes it, and a table that becomes empty)
// state.change({path: value, …})    changes several keys as one step of undo
// state.slide(path, value)          the same as set, for a slider: until state.settle() it is one step of undo
// state.replace(document)           another document altogether
// state.renew(names)                files of these names have other contents: results of them are outdated
// state.renewals(name)              how often that happened
// state.undo(), state.redo(), state.canUndo, state.canRedo
// state.view(key, otherwise), state.setView(key, value)    what is chosen on the page but is no part of the study
// state.edit(key, value)            the same as one step of undo
// state.step                        the step that is looked at; state.lookAt(step)

import { batch, computed, effect, signal } from "./reactive.js";

const KEY = "viscofric.study";
const VIEW = "viscofric.view";
const MOST_UNDO = 100;

/** Parts of a path: "material.dma[1]" -> ["material", "dma", 1]. */
function partsOf(path) {
  if (!path) return [];
  return path
    .split(/\.|\[|\]\.?/)
    .filter((part) => part !== "")
    .map((part) => (/^\d+$/.test(part) ? Number(part) : part));
}

const isTables = (value) => Array.isArray(value) && typeof value[0] === "object";

export function valueAt(document, path) {
  return partsOf(path).reduce((value, part) => {
    const here = isTables(value) && typeof part === "string" ? value[0] : value;
    return here === undefined || here === null ? undefined : here[part];
  }, document);
}

function withValue(here, parts, value) {
  if (parts.length === 0) return value;
  if (isTables(here) && typeof parts[0] === "string") return [withValue(here[0], parts, value), ...here.slice(1)];
  const [first, ...rest] = parts;
  const copy = Array.isArray(here) ? [...here] : { ...(here ?? (typeof first === "number" ? [] : {})) };
  const below = withValue(copy[first], rest, value);
  const empty = below && typeof below === "object" && !Array.isArray(below) && Object.keys(below).length === 0;
  if (below === undefined || below === null || (empty && rest.length > 0)) {
    if (Array.isArray(copy)) copy.splice(first, 1);
    else delete copy[first];
  } else copy[first] = below;
  return copy;
}

function frozen(value) {
  if (value && typeof value === "object" && !Object.isFrozen(value)) {
    Object.values(value).forEach(frozen);
    Object.freeze(value);
  }
  return value;
}

function stored(key) {
  try {
    return JSON.parse(sessionStorage.getItem(key));
  } catch {
    return null;
  }
}

function store(key, value) {
  try {
    sessionStorage.setItem(key, JSON.stringify(value));
  } catch {
    // A full or forbidden storage costs the reload its memory, nothing else.
  }
}

const before = stored(KEY);
const kept = before?.study && Object.keys(before.study).length > 0 ? before : { study: {} };
const study = signal(frozen(kept.study));
const past = signal(kept.past ?? []); // [{study, edited: [key, value] of a view or null}]
const future = signal(kept.future ?? []);
const views = signal(stored(VIEW) ?? {});
const renewed = signal({}); // name of a file -> how often it got other contents
const step = signal(null);
const values = new Map(); // path -> its computed value
let slid = null; // path of the value that a slider is changing
const viewed = new Map(); // key of a view -> its computed value

effect(() => store(KEY, { study: study.value, past: past.value, future: future.value }));
effect(() => store(VIEW, views.value));

/** What a signal holds in one place, of which others do not notice changes elsewhere. */
function held(all, key, read) {
  if (!all.has(key)) all.set(key, computed(read));
  return all.get(key).value;
}

const setView = (key, value) => (views.value = { ...views.peek(), [key]: value });

/** Put a document and a view in place; returns what was there, an entry of past or future. */
function put(next, edited) {
  const was = { study: study.peek(), edited: edited && [edited[0], views.peek()[edited[0]]] };
  study.value = frozen(next);
  if (edited) setView(...edited);
  return was;
}

function become(next, edited = null) {
  if (!edited && JSON.stringify(next) === JSON.stringify(study.peek())) return;
  batch(() => {
    past.value = [...past.peek().slice(1 - MOST_UNDO), put(next, edited)];
    future.value = [];
  });
}

function move(from, to) {
  const last = from.peek().at(-1);
  if (!last) return false;
  batch(() => {
    from.value = from.peek().slice(0, -1);
    to.value = [...to.peek(), put(last.study, last.edited)];
  });
  return true;
}

const changed = (values) =>
  Object.entries(values).reduce(
    (next, [path, value]) => withValue(next, partsOf(path), structuredClone(value)),
    study.peek(),
  );

export const state = {
  get study() {
    return study.value;
  },
  get canUndo() {
    return past.value.length > 0;
  },
  get canRedo() {
    return future.value.length > 0;
  },
  get step() {
    return step.value;
  },
  lookAt: (id) => (step.value = id),
  /** Begin with the document of a fresh page, unless an earlier load of this tab left one. */
  begin(document) {
    if (Object.keys(study.peek()).length === 0) study.value = frozen(structuredClone(document));
  },
  get: (path) => held(values, path, () => valueAt(study.value, path)),
  set: (path, value) => become(changed({ [path]: value })),
  change: (values) => become(changed(values)),
  slide(path, value) {
    if (slid === path) study.value = frozen(changed({ [path]: value }));
    else become(changed({ [path]: value }));
    slid = path;
  },
  settle: () => (slid = null),
  get slides() {
    return slid !== null;
  },
  replace: (document) => become(structuredClone(document)),
  renew(names) {
    const more = Object.fromEntries(names.map((name) => [name, (renewed.peek()[name] ?? 0) + 1]));
    renewed.value = { ...renewed.peek(), ...more };
  },
  renewals: (name) => renewed.value[name] ?? 0,
  undo: () => move(past, future),
  redo: () => move(future, past),
  view: (key, otherwise) => held(viewed, key, () => views.value[key]) ?? otherwise,
  setView,
  edit: (key, value) => become(study.peek(), [key, value]),
};
