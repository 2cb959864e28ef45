// Curves of a figure dragged sideways with mouse, pen or finger.
//
// draggable(plot, {can, onStart, onMove, onEnd})   on a figure with a logarithmic x axis: `can(index)` says whether that
// trace may be dragged; onMove(index, decades) and onEnd(index, decades) give its distance from where it was.  The
// drawn points follow; what comes of it is the caller's to compute.

const NEAR = { mouse: 12, pen: 14, touch: 26 }; // px from a point

export function draggable(plot, { can, onStart, onMove, onEnd }) {
  let held = null;

  const axes = () => [plot._fullLayout?.xaxis, plot._fullLayout?.yaxis];

  /** The trace whose point is nearest to a place on the screen, if one is near. */
  const nearest = (event) => {
    const [x, y] = axes();
    if (!x || !plot.data) return null;
    const box = plot.getBoundingClientRect();
    const at = [event.clientX - box.left - x._offset, event.clientY - box.top - y._offset];
    if (at[0] < 0 || at[1] < 0 || at[0] > x._length || at[1] > y._length) return null;
    let found = { index: null, distance: NEAR[event.pointerType] ?? NEAR.mouse };
    plot.data.forEach((trace, index) => {
      if (!can(index) || trace.visible === "legendonly") return;
      trace.x.forEach((value, place) => {
        const distance = Math.hypot(x.d2p(value) - at[0], y.d2p(trace.y[place]) - at[1]);
        if (distance < found.distance) found = { index, distance };
      });
    });
    return found.index;
  };

  const decades = (event) => {
    const [x] = axes();
    return ((event.clientX - held.from) / x._length) * (x.range[1] - x.range[0]);
  };

  plot.addEventListener(
    "pointerdown",
    (event) => {
      if (event.button !== 0) return;
      const index = nearest(event);
      if (index === null) return;
      held = { index, from: event.clientX, x: Array.from(plot.data[index].x), pointer: event.pointerId, moved: false };
      plot.setPointerCapture(event.pointerId);
      onStart?.(index);
    },
    { capture: true },
  );
  plot.addEventListener("pointermove", (event) => {
    if (!held) {
      plot.classList.toggle("can-drag", event.pointerType === "mouse" && nearest(event) !== null);
      return;
    }
    if (event.pointerId !== held.pointer) return;
    const by = decades(event);
    held.moved ||= Math.abs(event.clientX - held.from) > 3;
    if (!held.moved) return;
    moveTrace(plot, held.index, held.x, by);
    onMove?.(held.index, by);
  });
  const release = (event, keep) => {
    if (!held || event.pointerId !== held.pointer) return;
    const { index, moved } = held;
    const by = decades(event);
    if (moved && !keep) moveTrace(plot, index, held.x, 0);
    held = null;
    if (moved) onEnd?.(index, keep ? by : 0);
  };
  plot.addEventListener("pointerup", (event) => release(event, true));
  plot.addEventListener("pointercancel", (event) => release(event, false));
  // The drawing library would zoom with the same drag.
  for (const kind of ["mousedown", "touchstart"]) {
    plot.addEventListener(
      kind,
      (event) => {
        if (!held) return;
        event.stopPropagation();
        if (event.cancelable) event.preventDefault(); // nor is text to be selected
      },
      { capture: true },
    );
  }
  plot.classList.add("draggable");
}

/** Move a drawn trace by so many decades from where its numbers are. */
export function moveTrace(plot, index, x, by) {
  if (plot?.data?.[index]) window.Plotly.restyle(plot, { x: [x.map((value) => value * 10 ** by)] }, [index]);
}
