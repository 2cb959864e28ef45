/**
 * Requests of the page to its server: jobs, files, the first study.
 *
 * runJob(kind, {study, options}, {onProgress, onPart, onStart, signal, brief}) -> Promise<result>
 *   At most four jobs are streamed at once over all tabs; others wait, but not `brief` ones.  `signal` cancels: an AbortError.
 *   What is wrong is a JobError, {message, field, problems, values}: a sentence, the path in the study that it is about, or null,
 *   a list of such {message, field} of all that is wrong, and what a form can offer, such as the headings of a file.
 *   onStart(number): stopJob(number) interrupts the job, which then resolves with what it has found, if it can.
 * uploadFiles(files) -> Promise<names>, useExample(), getStart(), downloadUrl(name)
 * keep(name, give): give() is done once more for a program that was started again; `restarted` is then the study of that moment
 */

import { lasting, signal } from "./reactive.js";
import { state } from "./state.js";

const PLACES = [0, 1, 2, 3].map((number) => `viscofric-stream-${number}`); // a browser has six connections to a server
const LARGEST_UPLOAD = 20e6; // bytes
const START = "start it again with: viscofric web. This page then continues by itself";
const ENDED = `The program behind this page ended before it answered; ${START}.`;
const LOOK = 2000; // ms

export class JobError extends Error {
  name = "JobError";

  constructor({ message, field = null, problems = [{ message, field }], values = {} }) {
    super(problems.length === 1 ? problems[0].message : message);
    Object.assign(this, { field, problems, values });
  }
}

const random = () => [...crypto.getRandomValues(new Uint8Array(16))].map((byte) => byte.toString(16).padStart(2, "0"));
/** The tab's name at the server, which a reload keeps and a copied tab does not share for long. */
const workspace = lasting("sessionStorage", "viscofric.workspace", random().join("")).value;

const kept = new Map(); // name -> what the program has to be given again
export const restarted = signal(null);
let program = null; // the run of the server that answered last
let given = null; // a promise: it has been given all again
let looking = null;

export const keep = (name, give) => kept.set(name, give);

async function giveAgain() {
  for (const give of kept.values()) await give();
  restarted.value = state.study;
  state.renew(["", ...kept.keys()]);
}

/** An error by a program that is gone; from now on the page looks whether it is back. */
function gone(message) {
  const look = async () => {
    await request("/api/status");
    clearInterval(looking);
    looking = null;
    state.renew([""]); // what failed is computed again
  };
  looking ??= setInterval(() => look().catch(() => {}), LOOK);
  return new JobError({ message });
}

/** A request of this tab; rejects with a JobError that says what is wrong. */
async function request(address, options = {}) {
  const asked = program;
  let response;
  try {
    response = await fetch(address, { ...options, headers: { "X-Workspace": workspace, ...options.headers } });
  } catch (error) {
    if (error.name === "AbortError") throw error;
    throw gone(`The program behind this page does not respond; ${START}.`);
  }
  const answers = response.headers.get("X-Program");
  if (asked && answers && answers !== asked) {
    if (answers !== program) [program, given] = [answers, null];
    await (given ??= giveAgain());
    return request(address, options);
  }
  program = answers ?? program;
  if (response.ok) return response;
  const { message = `The server answered ${response.status}.`, field } = await response.json().catch(() => ({}));
  throw new JobError({ message, field });
}

const answered = async (...asked) => (await request(...asked)).json();

export const runJob = (kind, { study = {}, options = {} } = {}, { onProgress, onPart, onStart, signal, brief } = {}) =>
  inTurn(!brief && navigator.locks, signal, async () => {
    const response = await request(`/api/jobs/${encodeURIComponent(kind)}`, {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify({ study, options }),
      signal,
    });
    for await (const message of messages(response.body)) {
      if (message.event === "progress") onProgress?.(message);
      else if (message.event === "part") onPart?.(message.part);
      else if (message.event === "started") onStart?.(message.job);
      else if (message.event === "cancelled") throw new DOMException("The job was cancelled.", "AbortError");
      else if (message.event === "result") return message.result;
      else if (message.event === "error") throw new JobError(message);
    }
    throw gone(ENDED);
  });

export const stopJob = (number) => request(`/api/jobs/${number}/stop`, { method: "POST" });

/** The JSON objects of a stream, one a line. */
async function* messages(stream) {
  const reader = stream.pipeThrough(new TextDecoderStream()).getReader();
  let pieces = [];
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) return;
      const [first, ...lines] = value.split("\n");
      pieces.push(first);
      for (const line of lines) {
        const whole = pieces.join("");
        pieces = [line];
        if (whole) yield JSON.parse(whole);
      }
    }
  } catch (error) {
    if (error.name === "AbortError" || error instanceof SyntaxError) throw error;
    throw gone(ENDED);
  } finally {
    reader.cancel().catch(() => {});
  }
}

/** Have something done in the first place that is free, of four that all tabs share; at once without locks. */
function inTurn(locks, signal, work) {
  if (!locks) return work();
  const found = new AbortController();
  const waits = AbortSignal.any([found.signal, ...(signal ? [signal] : [])]);
  return new Promise((resolve, reject) => {
    const take = () => {
      if (found.signal.aborted) return undefined;
      found.abort();
      const done = work();
      resolve(done);
      return done.catch(() => {});
    };
    for (const place of PLACES)
      locks.request(place, { signal: waits }, take).catch((error) => found.signal.aborted || reject(error));
  });
}

/** Upload files, one after the other; returns their names at the server, by which a study names them. */
export async function uploadFiles(files) {
  const names = [];
  for (const file of files) {
    if (file.size > LARGEST_UPLOAD)
      throw new JobError({ message: `${file.name} has ${(file.size / 1e6).toFixed(0)} MB; the limit is 20 MB.` });
    const put = () => answered(`/api/files/${encodeURIComponent(file.name)}`, { method: "PUT", body: file });
    const { name } = await put();
    keep(name, put);
    names.push(name);
  }
  state.renew(names);
  return names;
}

/** Put the synthetic example's measurements there. */
export function useExample() {
  const put = () => answered("/api/files/example", { method: "POST" });
  keep("example", put);
  return put();
}

export const getStart = () => answered("/api/start");

export const downloadUrl = (name) => `/api/downloads/${encodeURIComponent(name)}?workspace=${workspace}`;
