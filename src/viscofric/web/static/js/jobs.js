// What the page computes: each job with its newest result, which is known by the hash of the inputs that it was computed from.
//
// const curve = new Job("curve", {inputs: () => ({study, options}), …})      null: there is nothing to compute
//   name       by which `result` finds it, and its inputs are known; the kind where nothing is said
//   wait       ms after the last change of the inputs; `when` tells whether somebody looks; both of jobs that were start()ed
//   part       (part, before) what the parts of a result, which come before it, make of what is shown
//   done, asked   (result, asked) after a result was computed; the inputs that it stands for, where they are not those asked
//   manual     it is computed by run() alone; start() has results that are known shown again
//   interrupts, remember   cancel() asks for what was found so far; how many results are kept, for undo
//   follows    a slider: the result before is current as long as its study is the same and another one is on its way
//   drafts     it follows, too: at once a draft, and a result of stage "sharp" when the slider rests
// curve.start()              from now on it is computed whenever its inputs have changed; curve.run(asked): now
// curve.cancel(), resume()   keeps what is there, computes the rest; curve.put(asked, result); curve.progress; curve.ended
// curve.result, current, error   the newest one, of whatever inputs; that of the inputs as they are, or null; why there is none
// curve.shown                the newest one, null where the inputs as they are have an error
//
// isStale(result)            whether its inputs are others than those of the study and the page
// result(name), newest(name)  what a job has of the inputs as they are, to its end, or null; what it has of whatever inputs

import { JobError, runJob, stopJob } from "./api.js";
import { batch, computed, effect, signal, untracked } from "./reactive.js";
import { state, valueAt } from "./state.js";

const MATERIAL = ["material", "uncertainty"];
const CONTACT = ["material", "indenter", "surface", "layer", "solver"];
const PREDICTED = [...CONTACT, "uncertainty", "conditions.thickness", "measurement"];

/** Paths of the study on which the results of a job depend; all of it where nothing is said. */
const DEPENDS_ON = {
  sweeps: ["material"],
  rubber: MATERIAL,
  moduli: MATERIAL,
  isotherm_misfit: ["material"],
  amplitude: ["material"],
  "amplitude-contact": [...CONTACT, "conditions", "sweep"],
  curve: [...CONTACT, "conditions", "sweep", "uncertainty", "interface", "heating", "measurement"],
  contact: [...CONTACT, "conditions.load", "conditions.pressure", "conditions.direction", "sweep"],
  motion: [...CONTACT, "conditions.temperature", "conditions.direction", "sweep"],
  measured: ["measurement"],
  agreement: PREDICTED,
  master: PREDICTED,
  identify: PREDICTED,
  "export-card": ["material"],
};

/** A short name of a text (FNV-1a, twice 32 bits). */
function hash(text) {
  let [a, b] = [0x811c9dc5, 0x1b873593];
  for (let at = 0; at < text.length; at += 1) {
    a = Math.imul(a ^ text.charCodeAt(at), 0x01000193);
    b = Math.imul(b ^ text.charCodeAt(at), 0x85ebca6b);
  }
  return [a, b].map((one) => (one >>> 0).toString(16).padStart(8, "0")).join("");
}

/** Names the inputs of a job; equal inputs have equal keys. */
export function keyOf(name, { study, options = {} }) {
  const inputs = (DEPENDS_ON[name] ?? [""]).map((path) => valueAt(study, path) ?? null);
  // a file may have other contents under the same name; the order of keys means nothing
  const canonical = (_, value) => {
    if (typeof value === "string") return state.renewals(value) ? `${value}#${state.renewals(value)}` : value;
    if (value === null || typeof value !== "object" || Array.isArray(value)) return value;
    return Object.fromEntries(Object.entries(value).sort(([one], [other]) => (one < other ? -1 : 1)));
  };
  return hash(JSON.stringify([name, inputs, options], canonical));
}

const jobs = signal(new Map());
const whole = computed(() => keyOf("the whole study", { study: state.study, options: state.renewals("") }));
const origins = new WeakMap(); // result -> {job, key, about, study}
const REST = 250; // ms without a change, after which a draft is refined
const BEGUN = { done: 0, total: 0, label: "" };

export class Job {
  #known = new Map(); // key -> result
  #found = signal(null); // {key, about, result, complete}
  #failure = signal(null); // {key, error, whole}
  #ended = signal(null); // {key, seconds | cancelled}
  #running = null; // {key, asked, abort, number, draft}
  #last = null; // what was asked last
  #timer = null;
  #started = false;
  moving = signal(null); // {done, total, label} of what is on its way

  constructor(kind, { name = kind, inputs, ...about }) {
    Object.assign(this, { wait: 150, when: () => true, part: (part) => part, remember: 0, drafts: false }, about);
    Object.assign(this, { kind, name, follows: this.follows || this.drafts });
    this.inputs = computed(inputs);
    this.key = computed(() => this.inputs.value && keyOf(name, this.inputs.value));
    this.about = computed(() => this.inputs.value && keyOf(name, { study: this.inputs.value.study }));
    jobs.value = new Map([...jobs.peek(), [name, this]]);
  }

  #ofNow(of) {
    return of.value?.key === this.key.value ? of.value : null;
  }

  get result() {
    return this.inputs.value ? (this.#found.value?.result ?? null) : null;
  }
  get shown() {
    return this.error ? null : this.result;
  }
  get current() {
    return this.#ofNow(this.#found)?.result ?? null;
  }
  get complete() {
    return Boolean(this.#ofNow(this.#found)?.complete);
  }
  get error() {
    const { error = null, whole: of } = this.#ofNow(this.#failure) ?? {};
    return of === whole.value ? error : null; // with another study, what was wrong may be mended
  }
  get ended() {
    return this.#ofNow(this.#ended);
  }
  get progress() {
    return this.moving.value;
  }

  start() {
    if (this.#started) return this;
    this.#started = true;
    effect(() => {
      const key = this.key.value;
      const seen = this.when();
      void this.error;
      untracked(() => this.#follow(key, seen));
    });
    return this;
  }

  /** Take the result of the inputs if it is known; compute it otherwise, if somebody looks. */
  #follow(key, seen) {
    if (this.#running?.key !== key && !this.manual && !this.#running?.draft) this.#leave();
    if (this.#known.has(key)) this.#find(key, this.#known.get(key), true);
    if (this.#running || this.manual) return;
    if (key === null || !seen || this.complete || this.error || this.ended?.cancelled) return;
    const found = this.#found.value;
    const begins = !found && !this.#failure.value;
    const slides = this.drafts && (state.slides || found?.about === this.about.value);
    const refines = this.drafts && found?.key === key;
    this.moving.value = { ...BEGUN, label: refines ? "sharp" : "" };
    clearTimeout(this.#timer);
    if (slides && !refines) this.run();
    else this.#timer = setTimeout(() => this.run(), refines ? REST : begins ? 0 : this.wait);
  }

  /** Give up what is on its way. */
  #leave() {
    clearTimeout(this.#timer);
    this.#running?.abort.abort();
    this.#running = null;
    this.moving.value = null;
  }

  async run(asked = this.inputs.peek()) {
    this.#leave();
    if (!asked) return;
    const key = this.key.peek();
    const stages = this.drafts && (this.#found.peek()?.key === key ? "sharp" : "coarse");
    const mine = { key, abort: new AbortController(), number: null, draft: stages === "coarse" };
    const begun = performance.now();
    this.#running = mine;
    this.#last = asked;
    batch(() => {
      this.moving.value = { ...BEGUN, label: stages || "" };
      this.#failure.value = this.#ended.value = null;
    });
    let [before, end] = [null, () => {}];
    try {
      const options = stages ? { ...asked.options, stages } : asked.options;
      const result = await runJob(this.kind, { ...asked, options }, {
        signal: mine.abort.signal,
        brief: mine.draft,
        onStart: (number) => (mine.number = number),
        onPart: (part) => this.#running === mine && this.put(asked, (before = this.part(part, before)), false),
        onProgress: (progress) => this.#running === mine && (this.moving.value = progress),
      });
      end = () => {
        this.put(asked, result, !stages || result.stage === "sharp");
        this.#ended.value = { key: this.#found.value.key, seconds: (performance.now() - begun) / 1000 };
        this.done?.(result, asked);
      };
    } catch (error) {
      end = () => {
        if (error.name === "AbortError") this.#ended.value = { key, cancelled: true };
        else this.#failure.value = { key, error, whole: whole.peek() };
      };
      if (!(error instanceof JobError) && error.name !== "AbortError") console.error(error);
    }
    if (this.#running !== mine) return;
    this.#running = null;
    batch(() => {
      this.moving.value = null;
      end();
    });
    if (stages) this.#follow(this.key.peek(), this.when());
  }

  put(asked, result, complete = true) {
    const of = complete && this.asked ? this.asked(result, asked) : asked;
    const [key, about] = untracked(() => [keyOf(this.name, of), keyOf(this.name, { study: of.study })]);
    origins.set(result, { job: this, key, about, study: of.study });
    if (this.#failure.peek()?.key === key) this.#failure.value = null;
    this.#find(key, result, complete, about);
  }

  #find(key, result, complete, about = origins.get(result).about) {
    this.#found.value = { key, about, result, complete };
    if (!complete || !this.remember) return;
    this.#known.delete(key);
    this.#known.set(key, result);
    if (this.#known.size > this.remember) this.#known.delete(this.#known.keys().next().value);
  }

  resume() {
    return this.run(this.#last ?? undefined);
  }

  /** Stop on the user's wish; a job that `interrupt`s sends what it has found so far, if it has begun and answers. */
  cancel() {
    clearTimeout(this.#timer);
    const { abort, number } = this.#running ?? {};
    if (!abort) this.moving.value = null;
    else if (this.interrupts && number) {
      this.#running.number = null;
      stopJob(number).catch(() => abort.abort());
    } else abort.abort();
  }
}

export const studyOf = (result) => origins.get(result)?.study;
export const inputsOf = (result) => origins.get(result)?.key;

export function isStale(result) {
  const origin = result && origins.get(result);
  if (!origin) return false;
  const { job, key, about } = origin;
  return job.follows && job.progress ? about !== job.about.value : key !== job.key.value;
}

/** What a job of this name has of the inputs as they are, to its end; null without. */
export function result(name) {
  const job = jobs.value.get(name);
  return job?.complete ? job.current : null;
}

/** What a job of this name has, of whatever inputs. */
export const newest = (name) => jobs.value.get(name)?.result ?? null;

/** The key of the inputs as they are, of each job by its name. */
export const keys = () => Object.fromEntries([...jobs.value].map(([name, { key }]) => [name, key.value]));

/** Whether any job is on its way. */
export const busy = () => [...jobs.value.values()].some((job) => job.progress);

/** Errors of all jobs for the inputs as they are. */
export const errors = () => [...jobs.value.values()].map((job) => job.error).filter(Boolean);
