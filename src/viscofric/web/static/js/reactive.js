// What follows the state: signals, effects, and views of Preact written as htm templates.
//
// html`<p class="help">${text}</p>`     elements of Preact
// view((properties, self) => html`…`)   a component that is drawn again when a signal that it read has changed; `self` has a
//                                       number of its own; its gone(), if set, is called when it is taken away
// watch(read, act)                      act(value) each time that what `read` gives is another; not at first
// lasting("localStorage", key, first)   a signal whose value the browser keeps, as JSON

import htm from "../vendor/htm.js";
import { Component, h } from "../vendor/preact.js";
import { computed, effect, signal, untracked } from "../vendor/signals-core.js";

export { Component, render } from "../vendor/preact.js";
export { batch, computed, effect, signal, untracked } from "../vendor/signals-core.js";

export const html = htm.bind(h);

let made = 0;

export const view = (draw) =>
  class View extends Component {
    number = (made += 1);

    render(properties) {
      this.stop?.();
      let drawn;
      let first = true;
      this.stop = effect(() => {
        if (first) drawn = draw(properties, this);
        else this.setState({});
        first = false;
      });
      return drawn;
    }

    componentWillUnmount() {
      this.stop?.();
      this.gone?.();
    }
  };

export function watch(read, act) {
  const seen = computed(read);
  let first = true;
  return effect(() => {
    const { value } = seen;
    if (!first) untracked(() => void act(value));
    first = false;
  });
}

export function lasting(storage, key, first) {
  const kept = signal(first);
  try {
    kept.value = JSON.parse(window[storage].getItem(key)) ?? first;
  } catch {
    // what cannot be had or read is as good as none
  }
  effect(() => {
    try {
      window[storage].setItem(key, JSON.stringify(kept.value));
    } catch {
      // A full or forbidden storage costs the reload its memory, nothing else.
    }
  });
  return kept;
}
