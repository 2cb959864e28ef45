// Results that keep up with a slider: coarse ones for the newest position, a sharp one when it rests.
//
// const live = follow({request, show, fail, busy, rest: 250})
//   request(position, "coarse" | "sharp", signal) -> Promise<result>      result.stage is "sharp" where nothing is left to sharpen
//   show(result, position), fail(error, position), busy("" | "coarse" | "sharp")
// live.want(position)     the slider is there now; of those that come while a coarse result is awaited the last one counts
// live.stop()             nothing more is wanted

export function follow({ request, show, fail, busy = () => {}, rest = 250 }) {
  let newest = null; // wanted, and not requested yet
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
    let result = null;
    try {
      result = await request(position, "coarse", signal);
      if (!signal.aborted) show(result, position);
    } catch (error) {
      // The failure of a result that is no longer wanted is not shown.
      if (!signal.aborted && newest === null && error.name !== "AbortError") fail(error, position);
    }
    if (signal.aborted) return;
    coarse = null;
    if (newest !== null) next();
    else if (result && result.stage !== "sharp") timer = setTimeout(() => sharpen(position), rest);
    else busy("");
  }

  async function sharpen(position) {
    const mine = new AbortController();
    sharp = mine;
    busy("sharp");
    try {
      const result = await request(position, "sharp", mine.signal);
      if (sharp === mine) show(result, position);
    } catch (error) {
      if (sharp === mine && error.name !== "AbortError") fail(error, position);
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
