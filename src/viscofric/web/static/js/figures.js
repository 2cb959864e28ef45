// Figures in the page's house style: light and dark, in the user's units, each with a table of its numbers and downloads.
//
// const handle = figure(container, {
//   id: "friction-curve", title: "Friction against speed", caption: "what it shows, in a sentence",
//   x: {label: "speed", kind: "speed", log: true}, y: {label: "friction coefficient"},
//   traces: [{name, x, y, mode: "lines" | "markers" | "lines+markers", temperature | colour, dash, symbol, size,
//             lower, upper (a band around y), error (bars, SI), hidden, legend: false, text, width}],
//   of: the result of a job that is drawn: the figure is grey while the inputs are others (jobs.js),
//   marks: [{x | y, label}] (lines across the figure), height, empty: "text without data", synthetic: true,
//   layout: {…plotly}, onClick: (point) => … })
// handle.update({traces: …})    changes parts of the spec, or all of it with {} as second argument, and draws again
// handle.element, handle.plot (plotly's div), handle.remove()
//
// All numbers are SI.  An axis is {label, kind, log, range: [from, to], equal}.  map(container, {…, x, y, axes: {x, y, z}, z: [[…]],
// lines: [traces on top]}) draws a heat map; z's rows go along y.
// temperatureColour(kelvin, all) and temperatureLook(kelvin, all) are one look per temperature, the same in all figures.

import { layoutOf, mapTraces, plotlyTraces } from "./figure_drawing.js";
import { isDark } from "./figure_look.js";
import { csv, described, hasData, numbers } from "./figure_numbers.js";
import { forget, shows } from "./jobs.js";
import { button, h, table } from "./parts.js";
import { effect } from "./reactive.js";
import * as units from "./units.js";

export { chooseTheme, hue, isDark, temperatureColour, temperatureLook } from "./figure_look.js";
export { csv, numbers } from "./figure_numbers.js";

let plotly = null;

/** Plotly, once it has come. */
function drawing() {
  plotly ??= new Promise((resolve, reject) => {
    if (window.Plotly) return resolve(window.Plotly);
    const script = document.getElementById("plotly");
    script.addEventListener("load", () => resolve(window.Plotly));
    script.addEventListener("error", () => reject(new Error("The drawing library could not be loaded.")));
  });
  return plotly;
}

/** Hand a file to the user. */
export function save(name, content, type = "text/plain") {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const link = h("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

async function savePicture(spec, format) {
  const Plotly = await drawing();
  const [width, height] = spec.z ? [900, 700] : [900, 600];
  const layout = { ...layoutOf(spec, false, true), width, height };
  const data = spec.z ? mapTraces(spec) : plotlyTraces(spec, false);
  const url = await Plotly.toImage({ data, layout }, { format, width, height, scale: format === "png" ? 2 : 1 });
  const content = format === "svg" ? decodeURIComponent(url.slice(url.indexOf(",") + 1)) : await await blobOf(url);
  save(`${spec.id}.${format}`, content, "image/svg+xml");
}

/** Bytes of a data address, without a request. */
function blobOf(url) {
  const bytes = atob(url.slice(url.indexOf(",") + 1));
  return new Blob([Uint8Array.from(bytes, (one) => one.charCodeAt(0))], { type: "image/png" });
}

let busy = Promise.resolve();
let owed = 0;

/** Whether all figures that are seen show what they were told last. */
export const areDrawn = () => owed === 0;

/** A figure of curves; see the head of this file. */
export function figure(container, first) {
  let spec = { traces: [], ...first };
  let drawnOnce = false;
  let waiting = false;
  let drawn = null; // the spec that was drawn; another one is owed
  const plot = h("div", { class: "plot", role: "img" });
  const empty = h("p", { class: "plot-empty" });
  const stage = h("div", { class: "stage" }, plot, empty);
  const heading = h("span", { class: "figure-title" });
  const badge = h("span", { class: "badge small", hidden: true }, "synthetic");
  const caption = h("span", { class: "figure-caption" });
  const details = h("div", { class: "figure-table", hidden: true });
  const toggle = button({
    label: h("span", { class: "word" }, "Table"),
    kind: "quiet small",
    symbol: "table",
    onClick: () => showTable(details.hidden),
  });
  toggle.setAttribute("aria-expanded", "false");
  const downloads = ["PNG", "SVG", "CSV"].map((format) =>
    button({
      label: h("span", { class: "format" }, format),
      kind: "quiet small",
      symbol: format === "PNG" ? "down" : undefined,
      onClick: () => download(format.toLowerCase()),
    }),
  );
  const tools = h("div", { class: "figure-tools" }, toggle, ...downloads);
  const element = h(
    "figure",
    { class: "figure", id: `figure-${spec.id}` },
    h("div", { class: "figure-head" }, heading, tools),
    stage,
    h("figcaption", {}, badge, caption),
    details,
  );
  container.append(element);

  function download(format) {
    const stale = element.classList.contains("stale");
    const kept = stale ? { ...spec, id: `${spec.id}_earlier_inputs`, title: `${spec.title} (earlier inputs)` } : spec;
    if (format === "csv") return save(`${kept.id}.csv`, csv(kept), "text/csv");
    return savePicture(kept, format);
  }

  function showTable(open) {
    details.hidden = !open;
    toggle.setAttribute("aria-expanded", String(open));
    fillTable();
  }

  function fillTable() {
    if (details.hidden) return;
    const { head, rows } = numbers(spec);
    const most = 2000;
    const cut =
      rows.length > most
        ? h("p", { class: "help" }, `The first ${most} of ${rows.length} rows; the CSV file has all.`)
        : "";
    details.replaceChildren(table(head, rows.slice(0, most), `Numbers of: ${spec.title}`), cut);
  }

  async function draw() {
    waiting = false;
    heading.textContent = spec.title ?? "";
    caption.textContent = spec.caption ?? "";
    caption.hidden = !spec.caption;
    badge.hidden = !spec.synthetic;
    const there = hasData(spec);
    empty.textContent = spec.empty ?? "Nothing to draw yet.";
    empty.hidden = there;
    for (const one of [toggle, ...downloads]) {
      one.disabled = !there;
      one.setAttribute("aria-label", `${one.textContent}: ${spec.title}`);
    }
    plot.setAttribute("aria-label", described(spec));
    if (spec.height) stage.style.height = `${spec.height}px`;
    fillTable();
    if (!stage.isConnected || stage.clientWidth === 0) {
      drawn = null;
      return; // drawn when it is seen
    }
    const Plotly = await drawing();
    drawn = spec;
    const dark = isDark();
    const data = spec.z ? mapTraces(spec) : plotlyTraces(spec, dark);
    await Plotly.react(plot, there ? data : [], layoutOf(spec, dark, false), {
      displayModeBar: false,
      displayNotifier: false,
      responsive: false,
      doubleClick: "reset+autosize",
    });
    if (!drawnOnce) {
      drawnOnce = true;
      // a close look needs closer ticks
      plot.on("plotly_relayout", (change) => {
        const loose = ["xaxis", "yaxis"].filter((axis) => `${axis}.range[0]` in change && plot.layout[axis].dtick);
        if (loose.length)
          Plotly.relayout(
            plot,
            Object.fromEntries(
              loose.flatMap((axis) => [
                [`${axis}.dtick`, null],
                [`${axis}.tickmode`, "auto"],
              ]),
            ),
          );
      });
      plot.on("plotly_click", (event) => spec.onClick?.(event.points[0], event));
    }
    element.dataset.drawn = String(Number(element.dataset.drawn ?? 0) + 1);
  }

  function request() {
    if (waiting) return;
    waiting = true;
    owed += 1;
    requestAnimationFrame(() => {
      busy = busy
        .then(draw)
        .catch((error) => (empty.textContent = error.message))
        .finally(() => (owed -= 1));
    });
  }

  const size = new ResizeObserver(() => {
    if (stage.clientWidth === 0) return;
    if (drawnOnce && drawn === spec) window.Plotly.Plots.resize(plot);
    else request();
  });
  size.observe(stage);
  const handle = {
    element,
    plot,
    get spec() {
      return spec;
    },
    update(changes, before = spec) {
      spec = { ...before, ...changes };
      shows(element, spec.of);
      request();
      return handle;
    },
    remove() {
      size.disconnect();
      follow();
      forget(element);
      if (drawnOnce) window.Plotly.purge(plot);
      element.remove();
    },
  };
  // another choice of units, or of light and dark
  const follow = effect(() => {
    isDark();
    units.choices();
    request();
  });
  return handle;
}

/** A heat map, with curves on top if given; see the head of this file. */
export function map(container, spec) {
  return figure(container, { z: [], ...spec });
}
