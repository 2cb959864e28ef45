// The page's state: the document of a study (the tables of a run file, as the user typed them), with undo, kept over reloads.
//
// state.study                       the document, frozen; never change it in place
// state.get("conditions.load")      a value, or undefined; paths like "material.dma[1]" reach into lists
//                                   and a key of a list of tables, such as several [[material]], is that of the first
// state.set(path, value)            changes one key (undefined or null removes it, and a table that becomes empty)
// state.change({path: value, …})    changes several keys as one step of undo
// state.replace(document)           another document altogether
// state.renew(names)                files of these names have other contents: what depends on them is notified as of a change
// state.renewals(name)              how often that happened
// state.subscribe(paths, callback)  callback({changed: [paths]}) after a change of one of these paths or below ("" is all);
//                                   returns what ends the subscription
// state.undo(), state.redo(), state.canUndo, state.canRedo
// state.setResult(key, value), state.result(key), state.onResult(key, callback)    what steps hand to each other
// state.view(key, otherwise), state.setView(key, value)    what is chosen on the page but is no part of the study
// state.edit(key, value)            the same as one step of undo; subscribe to "view.key"

const KEY = "viscofric.study";
const VIEW = "viscofric.view";
const MOST_UNDO = 100;

/** Parts of a path: "material.dma[1]" -> ["material", "dma", 1]. */
export function partsOf(path) {
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

/** Whether a change of one path is seen at another: either lies below the other. */
function touches(changed, watched) {
  if (changed === "" || watched === "" || changed === watched) return true;
  const below = (one, other) => one.startsWith(other) && /[.[]/.test(one[other.length]);
  return below(changed, watched) || below(watched, changed);
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

function createState() {
  let study = frozen({});
  let past = [];
  let future = [];
  let views = stored(VIEW) ?? {};
  const listeners = new Set();
  const results = new Map();
  const resultListeners = new Set();
  const renewed = new Map();

  function notify(changed) {
    store(KEY, { study, past, future });
    for (const { paths, callback } of [...listeners]) {
      if (paths.some((watched) => changed.some((path) => touches(path, watched)))) callback({ changed });
    }
  }

  const setView = (key, value) => store(VIEW, (views = { ...views, [key]: value }));

  function become(next, changed, edited = null) {
    if (!edited && JSON.stringify(next) === JSON.stringify(study)) return;
    past = [...past.slice(1 - MOST_UNDO), { study, changed, edited: edited && [edited[0], views[edited[0]]] }];
    future = [];
    study = frozen(next);
    if (edited) setView(...edited);
    notify(changed);
  }

  function move(from, to) {
    const last = from.pop();
    if (!last) return false;
    to.push({ ...last, study, edited: last.edited && [last.edited[0], views[last.edited[0]]] });
    study = frozen(last.study);
    if (last.edited) setView(...last.edited);
    notify(last.changed);
    return true;
  }

  return {
    get study() {
      return study;
    },
    get canUndo() {
      return past.length > 0;
    },
    get canRedo() {
      return future.length > 0;
    },
    /** Take what an earlier load of this tab left, or the document of a fresh page. */
    begin(document) {
      const before = stored(KEY);
      if (before?.study && Object.keys(before.study).length > 0) {
        ({ past = [], future = [] } = before);
        study = frozen(before.study);
      } else study = frozen(structuredClone(document));
      notify([""]);
    },
    get: (path) => valueAt(study, path),
    set: (path, value) => become(withValue(study, partsOf(path), structuredClone(value)), [path]),
    change(values) {
      let next = study;
      for (const [path, value] of Object.entries(values)) next = withValue(next, partsOf(path), structuredClone(value));
      become(next, Object.keys(values));
    },
    replace: (document) => become(structuredClone(document), [""]),
    renew(names) {
      const mentions = (value) =>
        value && typeof value === "object" ? Object.values(value).some(mentions) : names.includes(value);
      for (const name of names) renewed.set(name, (renewed.get(name) ?? 0) + 1);
      const changed = Object.keys(study).filter((table) => mentions(study[table]));
      if (changed.length) notify(changed);
    },
    renewals: (name) => renewed.get(name) ?? 0,
    undo: () => move(past, future),
    redo: () => move(future, past),
    subscribe(paths, callback) {
      const listener = { paths: Array.isArray(paths) ? paths : [paths ?? ""], callback };
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
    result: (key) => results.get(key),
    setResult(key, value) {
      results.set(key, value);
      for (const listener of [...resultListeners]) if (listener.key === key) listener.callback(value);
    },
    onResult(key, callback) {
      const listener = { key, callback };
      resultListeners.add(listener);
      return () => resultListeners.delete(listener);
    },
    view: (key, otherwise) => (key in views ? views[key] : otherwise),
    setView,
    edit: (key, value) => become(study, [`view.${key}`], [key, value]),
  };
}

export const state = createState();
