/**
 * Requests of the page to its server: jobs, files, the first study.
 *
 * runJob(kind, {study, options}, {onProgress, onPart, onStart, signal}) -> Promise<result>
 *   At most four jobs are streamed at once over all tabs; others wait.  `signal` (of an AbortController) cancels: the
 *   promise rejects with an AbortError, and the process that computed is free again.  What is wrong rejects with a
 *   JobError, {message, field, problems, values}: a sentence, the path in the study that it is about, or null, a list of
 *   such {message, field} of all that is wrong, and what a form can offer, such as the headings of a file.
 *   onStart(number): stopJob(number) interrupts the job, which then resolves with what it has found, if it can.
 * uploadFiles(files) -> Promise<names>, listFiles(), removeFile(name), useExample(), getStart(), getStatus(),
 * downloadUrl(name), workspace
 */

import { state } from "./state.js";

const MOST_STREAMS = 4;
const LARGEST_UPLOAD = 20e6; // bytes

export class JobError extends Error {
  /**
   * @param {string} message
   * @param {string | null} field
   * @param {{message: string, field: string | null}[]} [problems]
   * @param {object} [values]
   */
  constructor(message, field = null, problems = [{ message, field }], values = {}) {
    super(message);
    this.name = "JobError";
    this.field = field;
    this.problems = problems;
    this.values = values;
  }
}

export const workspace = ownWorkspace();

/** The tab's name at the server, which a reload keeps and a copied tab does not share for long. */
function ownWorkspace() {
  try {
    const known = sessionStorage.getItem("viscofric-workspace");
    if (known) return known;
    const fresh = randomName();
    sessionStorage.setItem("viscofric-workspace", fresh);
    return fresh;
  } catch {
    return randomName();
  }
}

function randomName() {
  return Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** A request of this tab; rejects with a JobError that says what is wrong. */
async function request(address, options = {}) {
  let response;
  try {
    response = await fetch(address, { ...options, headers: { "X-Workspace": workspace, ...options.headers } });
  } catch (error) {
    if (error.name === "AbortError") throw error;
    throw new JobError("The program behind this page does not respond; restart it with: viscofric web");
  }
  if (response.ok) return response;
  let reply = {};
  try {
    reply = await response.json();
  } catch {
    // not JSON: the status has to do
  }
  throw new JobError(reply.message ?? `The server answered ${response.status}.`, reply.field ?? null);
}

export async function runJob(kind, { study = {}, options = {} } = {}, { onProgress, onPart, onStart, signal } = {}) {
  return inTurn(signal, async () => {
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
      else if (message.event === "error") throw jobError(message);
    }
    throw new JobError("The program behind this page ended before it answered; restart it with: viscofric web");
  });
}

export const stopJob = (number) => request(`/api/jobs/${number}/stop`, { method: "POST" });

const jobError = ({ message, field, problems, values }) => new JobError(message, field, problems, values);

/** The JSON objects of a stream, one a line. */
async function* messages(stream) {
  const reader = stream.pipeThrough(new TextDecoderStream()).getReader();
  const pieces = [];
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) return;
      const lines = value.split("\n");
      while (lines.length > 1) {
        pieces.push(lines.shift());
        const line = pieces.join("");
        pieces.length = 0;
        if (line) yield JSON.parse(line);
      }
      pieces.push(lines[0]);
    }
  } catch (error) {
    if (error.name === "AbortError" || error instanceof SyntaxError) throw error;
    throw new JobError("The program behind this page ended before it answered; restart it with: viscofric web");
  } finally {
    reader.cancel().catch(() => {});
  }
}

let streams = 0;
const waiting = [];

/** Have something done when one of the four places is free: a browser has six connections to a server, for all tabs. */
async function inTurn(signal, work) {
  signal?.throwIfAborted();
  const place = await freePlace(signal);
  try {
    return await work();
  } finally {
    place.leave();
  }
}

async function freePlace(signal) {
  if (streams >= MOST_STREAMS) await inLine(signal);
  else streams += 1;
  const leave = () => {
    const next = waiting.shift();
    if (next) next();
    else streams -= 1;
  };
  if (!navigator.locks) return { leave };
  try {
    const unlock = await sharedPlace(signal);
    return {
      leave: () => {
        unlock();
        leave();
      },
    };
  } catch (error) {
    leave();
    throw error;
  }
}

function inLine(signal) {
  return new Promise((resolve, reject) => {
    const go = () => {
      signal?.removeEventListener("abort", giveUp);
      resolve();
    };
    const giveUp = () => {
      waiting.splice(waiting.indexOf(go), 1);
      reject(signal.reason);
    };
    waiting.push(go);
    signal?.addEventListener("abort", giveUp, { once: true });
  });
}

/** One of the places that all tabs share: the first that is free, or else one by chance to wait for. */
async function sharedPlace(signal) {
  for (let number = 0; number < MOST_STREAMS; number += 1) {
    const unlock = await lock(number, { ifAvailable: true });
    if (unlock) return unlock;
  }
  return lock(Math.floor(Math.random() * MOST_STREAMS), signal ? { signal } : {});
}

/** Resolves with what gives the lock back; with null where it is taken and only wanted if it is not. */
function lock(number, options) {
  return new Promise((resolve, reject) => {
    navigator.locks
      .request(`viscofric-stream-${number}`, options, (held) => {
        if (!held) {
          resolve(null);
          return undefined;
        }
        return new Promise((release) => resolve(release));
      })
      .catch(reject);
  });
}

/** Upload files, one after the other; returns their names at the server, by which a study names them. */
export async function uploadFiles(files) {
  const names = [];
  for (const file of files) {
    if (file.size > LARGEST_UPLOAD) {
      throw new JobError(`${file.name} has ${(file.size / 1e6).toFixed(0)} MB; the limit is 20 MB.`);
    }
    const response = await request(`/api/files/${encodeURIComponent(file.name)}`, { method: "PUT", body: file });
    names.push((await response.json()).name);
  }
  state.renew(names);
  return names;
}

export const listFiles = async () => (await request("/api/files")).json();

export const removeFile = (name) => request(`/api/files/${encodeURIComponent(name)}`, { method: "DELETE" });

/** Put the synthetic example's measurements there; returns all files. */
export const useExample = async () => (await request("/api/files/example", { method: "POST" })).json();

export const getStart = async () => (await request("/api/start")).json();

export const getStatus = async () => (await request("/api/status")).json();

export const downloadUrl = (name) => `/api/downloads/${encodeURIComponent(name)}?workspace=${workspace}`;
