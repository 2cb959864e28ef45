// Answers that keep up with a slider: coarse ones for the newest position, a sharp one when it rests.
//
// const live = follow({ask, show, fail, busy, rest: 250})
//   ask(position, "coarse" | "sharp", signal) -> Promise<answer>      answer.stage is "sharp" where nothing is left to sharpen
//   show(answer, position), fail(error), busy("" | "coarse" | "sharp")
// live.want(position)     the slider is there now; of those that come while a coarse answer is awaited the last one counts
// live.stop()             nothing more is wanted

export function follow({ ask, show, fail, busy = () => {}, rest = 250 }) {
  let newest = null; // wanted, and not asked for yet
  let coarse = null; // what aborts the coarse request on its way
  let sharp = null; // … and the sharp one
  let timer = null;

  function overtake() {
    clearTimeout(timer);
    sharp?.abort();
    sharp = null;
  }

  function want(position) {
    overtake();
    newest = position;
    if (!coarse) next();
  }

  async function next() {
    const position = newest;
    newest = null;
    coarse = new AbortController();
    const { signal } = coarse;
    busy("coarse");
    let answer = null;
    try {
      answer = await ask(position, "coarse", signal);
      if (!signal.aborted) show(answer, position);
    } catch (error) {
      // An answer that nobody waits for any more may fail as it likes.
      if (!signal.aborted && newest === null && error.name !== "AbortError") fail(error);
    }
    if (signal.aborted) return;
    coarse = null;
    if (newest !== null) next();
    else if (answer && answer.stage !== "sharp") timer = setTimeout(() => sharpen(position), rest);
    else busy("");
  }

  async function sharpen(position) {
    const mine = new AbortController();
    sharp = mine;
    busy("sharp");
    try {
      const answer = await ask(position, "sharp", mine.signal);
      if (sharp === mine) show(answer, position);
    } catch (error) {
      if (sharp === mine && error.name !== "AbortError") fail(error);
    }
    if (sharp !== mine) return;
    sharp = null;
    busy("");
  }

  function stop() {
    overtake();
    newest = null;
    coarse?.abort();
    coarse = null;
    busy("");
  }

  return { want, stop };
}
