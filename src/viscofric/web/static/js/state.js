// The page's state: the document of a study (the tables of a run file, as the user typed them), with undo, kept over reloads.
// It is held in signals: an effect, a computed value or a view that reads some of it follows that part.
//
// state.study                       the document, frozen; never change it in place
// state.get("conditions.load")      a value, or undefined; paths like "material.dma[1]" reach into lists, a key of a list of
//                                   tables, such as several [[material]], is that of the first, and "@key" or "@key.part" is a view's
// state.set(path, value)            changes one key (undefined or null removes it, and a table that becomes empty)
// state.change({path: value, …})    changes several keys as one step of undo; state.replace(document): all of them
// state.slide(path, value)          the same as set, for a slider: until state.settle() it is one step of undo
// state.renew(names), renewals(name)   files of these names have other contents: results are outdated; how often that happened
// state.undo(), state.redo(), state.canUndo, state.canRedo; state.step, state.lookAt(step): the step that is looked at
// state.view(key, otherwise), setView(key, value)    what is chosen on the page but is no part of the study; edit: with undo
// shapeOf(study)                    what is in contact: "ball" … "cone", "made" or "scan"

import { batch, computed, lasting, signal } from "./reactive.js";

const MOST_UNDO = 100;

/** Parts of a path: "material.dma[1]" -> ["material", "dma", 1]. */
const partsOf = (path) =>
  path
    .split(/\.|\[|\]\.?/)
    .filter((part) => part !== "")
    .map((part) => (/^\d+$/.test(part) ? Number(part) : part));

const isTables = (value) => Array.isArray(value) && typeof value[0] === "object";

export const valueAt = (document, path) =>
  partsOf(path).reduce(
    (value, part) => (isTables(value) && typeof part === "string" ? value[0] : value)?.[part],
    document,
  );

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

// past and future: [{study, edited: [key, value] of a view or null}]
const all = lasting("sessionStorage", "viscofric.study", { study: {}, past: [], future: [] });
const views = lasting("sessionStorage", "viscofric.view", {});
const study = computed(() => frozen(all.value.study));
const renewed = signal({}); // name of a file -> how often it got other contents
const step = signal(null);
let slid = null; // path of the value that a slider is changing

const known = new Map(); // path -> its computed value, of which others do not notice changes elsewhere
function held(path, read) {
  if (!known.has(path)) known.set(path, computed(read));
  return known.get(path).value;
}
const view = (key) => held(`@${key}`, () => views.value[key] ?? valueAt(views.value, key));
const setView = (key, value) => (views.value = { ...views.peek(), [key]: value });

/** Put a document and a view in place; `steps` gets what was there, and returns the past and the future. */
function put({ study: next, edited }, steps) {
  const was = { study: study.peek(), edited: edited && [edited[0], views.peek()[edited[0]]] };
  batch(() => {
    all.value = { ...all.peek(), study: next, ...steps(was) };
    if (edited) setView(...edited);
  });
}

function become(next, edited = null) {
  if (!edited && JSON.stringify(next) === JSON.stringify(study.peek())) return;
  put({ study: next, edited }, (was) => ({ past: [...all.peek().past.slice(1 - MOST_UNDO), was], future: [] }));
}

function move(from, to) {
  const last = all.peek()[from].at(-1);
  if (last) put(last, (was) => ({ [from]: all.peek()[from].slice(0, -1), [to]: [...all.peek()[to], was] }));
  return Boolean(last);
}

const changed = (values) =>
  Object.entries(values).reduce(
    (next, [path, value]) => withValue(next, partsOf(path), structuredClone(value)),
    study.peek(),
  );
const ofViews = ([path]) => path.startsWith("@");

export const state = {
  get study() {
    return study.value;
  },
  get canUndo() {
    return all.value.past.length > 0;
  },
  get canRedo() {
    return all.value.future.length > 0;
  },
  get step() {
    return step.value;
  },
  lookAt: (id) => (step.value = id),
  /** Begin with the document of a fresh page, unless an earlier load of this tab left one. */
  begin(document) {
    if (Object.keys(study.peek()).length === 0) all.value = { ...all.peek(), study: structuredClone(document) };
  },
  get: (path) => (path[0] === "@" ? view(path.slice(1)) : held(path, () => valueAt(study.value, path))),
  set: (path, value) => state.change({ [path]: value }),
  change(values) {
    const entries = Object.entries(values);
    for (const [path, value] of entries.filter(ofViews)) setView(path.slice(1), value);
    become(changed(Object.fromEntries(entries.filter((one) => !ofViews(one)))));
  },
  slide(path, value) {
    if (slid === path) all.value = { ...all.peek(), study: changed({ [path]: value }) };
    else state.set(path, value);
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
  undo: () => move("past", "future"),
  redo: () => move("future", "past"),
  view: (key, otherwise) => view(key) ?? otherwise,
  setView,
  edit: (key, value) => become(study.peek(), [key, value]),
};

/** `start` is what the server says of a fresh page; `steps` are those of the rail, by their names. */
export const page = { start: null, steps: new Map() };

export function shapeOf({ surface, indenter }) {
  if (surface) return surface.file === undefined ? "made" : "scan";
  return indenter?.shape ?? "ball";
}
