// Figures in the page's house style: light and dark, in the user's units, each with a table of its numbers and downloads.
//
// const handle = figure(container, {
//   id: "friction-curve", title: "Friction against speed", caption: "what it shows, in a sentence",
//   x: {label: "speed", kind: "speed", log: true}, y: {label: "friction coefficient"},
//   traces: [{name, x, y, mode: "lines" | "markers" | "lines+markers", temperature | colour, dash, symbol, size,
//             lower, upper (a band around y), error (bars, SI), hidden, legend: false, text, width}],
//   marks: [{x | y, label}] (lines across the figure), height, empty: "what is said without data", synthetic: true,
//   layout: {…plotly}, onClick: (point) => … })
// handle.update({traces: …})    changes parts of the spec and draws again
// handle.element, handle.plot (plotly's div), handle.remove()
//
// All numbers are SI.  An axis is {label, kind, log, range: [from, to], equal}.  map(container, {…, x, y, axes: {x, y, z}, z: [[…]],
// lines: [traces on top]}) draws a heat map; z's rows go along y.
// temperatureColour(kelvin, all) and temperatureLook(kelvin, all) are one look per temperature, the same in all figures.

import { button, h, table } from "./fields.js";
import * as units from "./units.js";

const live = new Set();
let theme = null;
let plotly = null;

// Okabe and Ito's colours, cold to warm, as in the reports; [on light, on dark]
const HUES = {
  blue: ["#0072b2", "#56a9e0"], sky: ["#3f9fd8", "#8fd0f7"], green: ["#009e73", "#3cc79d"],
  orange: ["#d38f00", "#f0b73c"], vermilion: ["#d55e00", "#ff8a4a"], purple: ["#b5528c", "#e39ac5"], red: ["#a31f34", "#f2707f"],
};
const BY_COUNT = [
  ["blue"], ["blue", "vermilion"], ["blue", "green", "vermilion"], ["blue", "green", "orange", "vermilion"],
  ["blue", "sky", "green", "orange", "vermilion"], ["blue", "sky", "green", "orange", "vermilion", "red"],
];
const SCALE = [["#16306b", "#5a7fe0"], HUES.blue, HUES.green, HUES.orange, HUES.vermilion, ["#8f1230", "#ff5d77"]];
const SYMBOLS = ["circle", "square", "triangle-up", "diamond", "triangle-down", "pentagon", "x"];
const DASHES = ["solid", "9px,3px", "3px,3px", "9px,3px,3px,3px"];

/** Whether the page is dark now. */
export function isDark() {
  const chosen = document.documentElement.dataset.theme;
  return chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
}

function mixed(one, other, share) {
  const parts = (colour) => [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
  const [from, to] = [parts(one), parts(other)];
  return `#${from.map((value, at) => Math.round(value + share * (to[at] - value)).toString(16).padStart(2, "0")).join("")}`;
}

/** Colour of a named hue on the page's background: hue("blue"). */
export function hue(name, dark = isDark()) {
  return HUES[name]?.[dark ? 1 : 0] ?? name;
}

function distinct(all) {
  return [...new Set(all.map((kelvin) => Math.round(kelvin * 10) / 10))].sort((one, other) => one - other);
}

/** One colour per temperature, blue where cold and red where warm; `all` are those that are shown together. */
export function temperatureColour(kelvin, all = [kelvin], dark = isDark()) {
  const sorted = distinct([...all, kelvin]);
  const rank = sorted.indexOf(Math.round(kelvin * 10) / 10);
  if (sorted.length <= BY_COUNT.length) return hue(BY_COUNT[sorted.length - 1][rank], dark);
  const place = ((kelvin - sorted[0]) / (sorted.at(-1) - sorted[0])) * (SCALE.length - 1);
  const at = Math.min(Math.max(Math.floor(place), 0), SCALE.length - 2);
  return mixed(SCALE[at][dark ? 1 : 0], SCALE[at + 1][dark ? 1 : 0], Math.min(Math.max(place - at, 0), 1));
}

/** Colour, symbol and dashes of a temperature, so that it can be told in grey, too. */
export function temperatureLook(kelvin, all = [kelvin], dark = isDark()) {
  const rank = distinct([...all, kelvin]).indexOf(Math.round(kelvin * 10) / 10);
  return { colour: temperatureColour(kelvin, all, dark), symbol: SYMBOLS[rank % SYMBOLS.length], dash: DASHES[rank % DASHES.length] };
}

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

function colours(dark) {
  const light = { ink: "#1d2329", quiet: "#5b6570", line: "#dfe3e7", paper: "#ffffff", hover: "#ffffff" };
  return dark ? { ink: "#e4e8ec", quiet: "#a0abb5", line: "#343c44", paper: "#1b2025", hover: "#2a3138" } : light;
}

const unitOf = (axis) => (axis?.kind && units.label(axis.kind) ? ` (${units.label(axis.kind)})` : "");
const titled = (axis) => `${axis?.label ?? ""}${unitOf(axis)}`;

/** Numbers that lie along an axis, in the user's unit. */
function along(spec, axis, name) {
  if (axis?.range) return axis.range.map((value) => units.number(value, axis.kind));
  if (spec.z) return units.number(spec[name], axis?.kind);
  return spec.traces.filter((trace) => !trace.hidden).flatMap((trace) => units.number(trace[name] ?? [], axis?.kind));
}

/** Ticks of a log axis: a label at each decade, or at every few; numbers in full where they are short. */
function logTicks(values) {
  const sound = values.filter((value) => value > 0 && Number.isFinite(value));
  const [low, high] = sound.reduce(([least, most], value) => [Math.min(least, value), Math.max(most, value)], [Infinity, 0]);
  const decades = Math.log10(high / low);
  const plain = low >= 9e-4 && high <= 1.1e4;
  if (!(decades > 1.8)) return { exponentformat: plain ? "none" : "power" };
  return { exponentformat: plain ? "none" : "power", dtick: Math.max(1, Math.ceil(decades / 9)) };
}

function plotlyAxis(axis = {}, dark, values = []) {
  const look = colours(dark);
  const range = axis.range?.map((value) => {
    const shown = units.number(value, axis.kind);
    return axis.log ? Math.log10(shown) : shown;
  });
  return {
    title: { text: titled(axis), standoff: 8, font: { size: 13, color: look.ink } },
    type: axis.log ? "log" : "linear",
    ...(axis.log ? logTicks(values) : { exponentformat: "power", minexponent: 4 }),
    showline: true, mirror: true, linecolor: look.quiet, linewidth: 1, ticks: "inside", ticklen: 5, tickcolor: look.quiet,
    minor: axis.log ? { ticks: "inside", ticklen: 3, tickcolor: look.quiet, showgrid: false } : undefined,
    gridcolor: look.line, zeroline: false, automargin: true, tickfont: { size: 12 },
    ...(range ? { range, autorange: false } : {}),
    ...(axis.equal ? { scaleanchor: "x", scaleratio: 1 } : {}),
  };
}

function base(spec, dark, forFile) {
  const look = colours(dark);
  const named = (spec.traces ?? spec.lines ?? []).filter((trace) => trace.name && trace.legend !== false);
  const top = forFile ? 60 : 12;
  const { x, y } = spec.axes ?? spec;
  return {
    paper_bgcolor: look.paper, plot_bgcolor: look.paper, autosize: !forFile,
    font: { family: 'system-ui, "Segoe UI", Roboto, "Noto Sans", "DejaVu Sans", sans-serif', size: 13, color: look.ink },
    margin: { l: 56, r: 14, t: top, b: 48, pad: 0 },
    title: forFile ? { text: `<b>${spec.title}</b>`, font: { size: 16 }, x: 0.02, xanchor: "left", y: 0.97, yanchor: "top" } : undefined,
    hovermode: "closest", hoverlabel: { bgcolor: look.hover, bordercolor: look.quiet, font: { color: look.ink, size: 12 } },
    showlegend: named.length > 1,
    legend: { orientation: "h", x: 0, xanchor: "left", y: 1.01, yanchor: "bottom", font: { size: 12 }, bgcolor: "rgba(0,0,0,0)" },
    dragmode: matchMedia("(pointer: coarse)").matches ? false : "zoom",
    xaxis: plotlyAxis(x, dark, along(spec, x, "x")), yaxis: plotlyAxis(y, dark, along(spec, y, "y")),
    shapes: marks(spec, look).shapes, annotations: [...marks(spec, look).annotations, ...(forFile ? syntheticMark(spec) : [])],
    uirevision: spec.id, separators: ".\u2009",
    ...(spec.layout ?? {}),
  };
}

function marks(spec, look) {
  const shapes = [];
  const annotations = [];
  for (const mark of spec.marks ?? []) {
    const across = mark.x !== undefined;
    const axis = across ? spec.x : spec.y;
    const at = units.number(across ? mark.x : mark.y, axis?.kind);
    const ends = across ? { x0: at, x1: at, y0: 0, y1: 1, yref: "paper" } : { y0: at, y1: at, x0: 0, x1: 1, xref: "paper" };
    shapes.push({ type: "line", layer: "below", line: { color: look.quiet, width: 1, dash: "dot" }, ...ends });
    const place = across ? { x: axis?.log ? Math.log10(at) : at, y: 1, yref: "paper", yanchor: "top", xanchor: "left" }
      : { y: axis?.log ? Math.log10(at) : at, x: 1, xref: "paper", xanchor: "right", yanchor: "bottom" };
    if (mark.label) annotations.push({ text: mark.label, showarrow: false, font: { size: 11, color: look.quiet }, ...place });
  }
  return { shapes, annotations };
}

function syntheticMark(spec) {
  if (!spec.synthetic) return [];
  const font = { size: 11, color: hue("vermilion", false) };
  return [{ text: "synthetic data", xref: "paper", yref: "paper", x: 1, y: 1, xanchor: "right", yanchor: "bottom", showarrow: false, font }];
}

/** The look of a trace: its own, that of its temperature, or the next hue. */
function lookOf(trace, index, spec, dark) {
  const all = spec.traces.map((one) => one.temperature).filter((one) => one !== undefined);
  if (trace.temperature !== undefined) {
    const look = temperatureLook(trace.temperature, spec.temperatures ?? all, dark);
    return { ...look, ...(trace.dash ? { dash: trace.dash } : {}), ...(trace.symbol ? { symbol: trace.symbol } : {}), ...(trace.colour ? { colour: hue(trace.colour, dark) } : {}) };
  }
  const order = ["blue", "vermilion", "green", "purple", "orange", "sky"];
  return { colour: hue(trace.colour ?? order[index % order.length], dark), symbol: trace.symbol ?? "circle", dash: trace.dash ?? "solid" };
}

function faded(colour, share) {
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
  return `rgba(${r},${g},${b},${share})`;
}

function plotlyTraces(spec, dark) {
  const drawn = [];
  spec.traces.forEach((trace, index) => {
    const look = lookOf(trace, index, spec, dark);
    const x = units.number(trace.x, spec.x?.kind);
    const group = trace.group ?? `${index}`;
    if (trace.lower && trace.upper) {
      const edge = { x, mode: "lines", line: { width: 0, color: look.colour }, hoverinfo: "skip", showlegend: false, legendgroup: group };
      drawn.push({ ...edge, y: units.number(trace.lower, spec.y?.kind) });
      drawn.push({ ...edge, y: units.number(trace.upper, spec.y?.kind), fill: "tonexty", fillcolor: faded(look.colour, dark ? 0.25 : 0.16) });
    }
    drawn.push(plotlyTrace(trace, look, x, spec, group, dark));
  });
  return drawn;
}

function plotlyTrace(trace, look, x, spec, group, dark) {
  const y = units.number(trace.y, spec.y?.kind);
  const mode = trace.mode ?? "lines";
  const open = trace.open ? "-open" : "";
  const bars = trace.error && { type: "data", array: spec.y?.kind ? trace.error.map((one) => (one === null ? null : units.number(one, spec.y.kind) - units.number(0, spec.y.kind))) : trace.error, thickness: 1.1, width: 3, color: look.colour };
  return {
    type: "scatter", x, y, mode, name: trace.name ?? "", legendgroup: group, text: trace.text,
    showlegend: Boolean(trace.name) && trace.legend !== false, visible: trace.hidden ? "legendonly" : true,
    line: { color: look.colour, width: trace.width ?? 2, dash: look.dash, shape: trace.shape },
    marker: { color: look.colour, symbol: `${look.symbol}${open}`, size: trace.size ?? 7, line: { width: open ? 1.5 : 0.8, color: open ? look.colour : colours(dark).paper } },
    fill: trace.fill, fillcolor: trace.fill ? faded(look.colour, 0.2) : undefined, connectgaps: false,
    error_y: bars || undefined, customdata: trace.data, hovertemplate: hover(trace, spec), cliponaxis: trace.clip ?? true,
  };
}

function hover(trace, spec) {
  const end = (axis) => (axis?.kind && units.label(axis.kind) ? ` ${units.label(axis.kind)}` : "");
  const text = trace.text ? "<br>%{text}" : "";
  return `${trace.name ? `<b>${trace.name}</b><br>` : ""}${spec.x?.label ?? "x"} %{x:.4g}${end(spec.x)}<br>${spec.y?.label ?? "y"} %{y:.4g}${end(spec.y)}${text}<extra></extra>`;
}

function mapTraces(spec, dark) {
  const { x, y, z } = spec.axes;
  const size = { thickness: 12, outlinewidth: 0, tickfont: { size: 12 }, title: { text: titled(z), side: "right", font: { size: 13 } } };
  const heat = {
    type: "heatmap", x: units.number(spec.x, x.kind), y: units.number(spec.y, y.kind),
    z: spec.z.map((row) => units.number(row, z.kind)), colorscale: spec.scale ?? (dark ? "Viridis" : "Viridis"), zsmooth: spec.smooth ?? false,
    zmin: spec.zero ? 0 : undefined, colorbar: size, hoverongaps: false,
    hovertemplate: `${x.label} %{x:.4g} ${units.label(x.kind)}<br>${y.label} %{y:.4g} ${units.label(y.kind)}<br>${z.label} %{z:.4g} ${units.label(z.kind)}<extra></extra>`,
  };
  const lines = plotlyTraces({ ...spec, x, y, traces: spec.lines ?? [] }, true);
  return [heat, ...lines];
}

const hasData = (spec) => (spec.z ? spec.z.length > 0 : (spec.traces ?? []).some((trace) => trace.x?.length > 0));

/** Rows of a figure's numbers in the user's units: {head, rows}. */
export function numbers(spec) {
  if (spec.z) {
    const { x, y, z } = spec.axes;
    const rows = spec.z.flatMap((row, at) => row.map((value, along) => [units.number(spec.x[along], x.kind), units.number(spec.y[at], y.kind), units.number(value, z.kind)]));
    return { head: [titled(x), titled(y), titled(z)], rows };
  }
  const traces = spec.traces.filter((trace) => trace.x?.length > 0 && !trace.decoration);
  const same = traces.every((trace) => JSON.stringify(Array.from(trace.x)) === JSON.stringify(Array.from(traces[0].x)));
  const columns = (trace) => [["", trace.y], ["lower ", trace.lower], ["upper ", trace.upper], ["error of ", trace.error]].filter(([, values]) => values);
  if (same && traces.length > 0) {
    const parts = traces.flatMap((trace) => columns(trace).map(([word, values]) => ({ head: `${word}${titled(spec.y)}${trace.name ? `, ${trace.name}` : ""}`, values: units.number(values, spec.y?.kind) })));
    const x = units.number(traces[0].x, spec.x?.kind);
    return { head: [titled(spec.x), ...parts.map((part) => part.head)], rows: x.map((value, at) => [value, ...parts.map((part) => part.values[at])]) };
  }
  const words = ["", "lower ", "upper ", "error of "].filter((word) => traces.some((trace) => columns(trace).some(([one]) => one === word)));
  const rows = traces.flatMap((trace) => {
    const found = Object.fromEntries(columns(trace).map(([word, values]) => [word, units.number(values, spec.y?.kind)]));
    return units.number(trace.x, spec.x?.kind).map((value, at) => [trace.name ?? "", value, ...words.map((word) => found[word]?.[at] ?? null)]);
  });
  return { head: ["curve", titled(spec.x), ...words.map((word) => `${word}${titled(spec.y)}`)], rows };
}

/** The numbers as CSV text, units in the headings. */
export function csv(spec) {
  const { head, rows } = numbers(spec);
  const cell = (value) => (value === null || value === undefined ? "" : /[",\n]/.test(String(value)) ? `"${String(value).replaceAll('"', '""')}"` : String(typeof value === "number" ? Number(value.toPrecision(9)) : value));
  const remark = [`# ${spec.title}${spec.synthetic ? " (synthetic rubber)" : ""}`, spec.caption ? `# ${spec.caption.replaceAll("\n", " ")}` : ""].filter(Boolean);
  return [...remark, ...[head, ...rows].map((row) => row.map(cell).join(","))].join("\n") + "\n";
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
  const layout = { ...base(spec, false, true), width, height };
  const data = spec.z ? mapTraces(spec, false) : plotlyTraces(spec, false);
  const url = await Plotly.toImage({ data, layout }, { format, width, height, scale: format === "png" ? 2 : 1 });
  const content = format === "svg" ? decodeURIComponent(url.slice(url.indexOf(",") + 1)) : await (await blobOf(url));
  save(`${spec.id}.${format}`, content, "image/svg+xml");
}

/** Bytes of a data address, without a request. */
function blobOf(url) {
  const bytes = atob(url.slice(url.indexOf(",") + 1));
  return new Blob([Uint8Array.from(bytes, (one) => one.charCodeAt(0))], { type: "image/png" });
}

/** What a screen reader is told of a figure: its curves and their ranges. */
function described(spec) {
  if (!hasData(spec)) return `${spec.title}: ${spec.empty ?? "no data yet"}.`;
  const [x, y] = spec.z ? [spec.axes.x, spec.axes.y] : [spec.x, spec.y];
  const ends = (values, axis) => {
    const sound = Array.from(values).filter((value) => Number.isFinite(value) && value !== null);
    return sound.length ? `${units.show(Math.min(...sound), axis?.kind)} to ${units.show(Math.max(...sound), axis?.kind)}` : "nothing";
  };
  if (spec.z) return `${spec.title}: map of ${spec.axes.z.label}, ${ends(spec.z.flat(), spec.axes.z)}, over ${x.label} and ${y.label}. Its numbers are in the table.`;
  const curves = spec.traces.filter((trace) => trace.x?.length > 0 && trace.legend !== false).slice(0, 12);
  const told = curves.map((trace) => `${trace.name ?? y?.label ?? "curve"}: ${ends(trace.y, y)} for ${x?.label ?? "x"} ${ends(trace.x, x)}`);
  return `${spec.title}: ${y?.label ?? "y"} against ${x?.label ?? "x"}. ${told.join("; ")}. Its numbers are in the table.`;
}

let busy = Promise.resolve();

/** A figure of curves; see the head of this file. */
export function figure(container, first) {
  let spec = { traces: [], ...first };
  let drawnOnce = false;
  let waiting = false;
  const plot = h("div", { class: "plot", role: "img" });
  const empty = h("p", { class: "plot-empty" });
  const stage = h("div", { class: "stage" }, plot, empty);
  const heading = h("span", { class: "figure-title" });
  const badge = h("span", { class: "badge small", hidden: true }, "synthetic");
  const caption = h("span", { class: "figure-caption" });
  const details = h("div", { class: "figure-table", hidden: true });
  const toggle = button({ label: "Table", kind: "quiet small", symbol: "table", onClick: () => showTable(details.hidden) });
  toggle.setAttribute("aria-expanded", "false");
  const downloads = ["PNG", "SVG", "CSV"].map((format) =>
    button({ label: format, kind: "quiet small", symbol: format === "PNG" ? "down" : undefined, onClick: () => download(format.toLowerCase()) }),
  );
  const tools = h("div", { class: "figure-tools" }, toggle, ...downloads);
  const element = h("figure", { class: "figure", id: `figure-${spec.id}` }, h("div", { class: "figure-head" }, heading, badge, tools), stage, h("figcaption", {}, caption), details);
  container.append(element);

  function download(format) {
    if (format === "csv") return save(`${spec.id}.csv`, csv(spec), "text/csv");
    return savePicture(spec, format);
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
    const cut = rows.length > most ? h("p", { class: "help" }, `The first ${most} of ${rows.length} rows; the CSV file has all.`) : "";
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
    if (!stage.isConnected || stage.clientWidth === 0) return; // drawn when it is seen
    const Plotly = await drawing();
    const dark = isDark();
    const data = spec.z ? mapTraces(spec, dark) : plotlyTraces(spec, dark);
    await Plotly.react(plot, there ? data : [], base(spec, dark, false), { displayModeBar: false, displayNotifier: false, responsive: false, doubleClick: "reset+autosize" });
    if (!drawnOnce) {
      drawnOnce = true;
      // a close look needs closer ticks
      plot.on("plotly_relayout", (change) => {
        const loose = ["xaxis", "yaxis"].filter((axis) => `${axis}.range[0]` in change && plot.layout[axis].dtick);
        if (loose.length) Plotly.relayout(plot, Object.fromEntries(loose.flatMap((axis) => [[`${axis}.dtick`, null], [`${axis}.tickmode`, "auto"]])));
      });
      plot.on("plotly_click", (event) => spec.onClick?.(event.points[0], event));
    }
    element.dataset.drawn = String(Number(element.dataset.drawn ?? 0) + 1);
  }

  function ask() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => (busy = busy.then(draw).catch((error) => (empty.textContent = error.message))));
  }

  const size = new ResizeObserver(() => (drawnOnce && stage.clientWidth > 0 ? window.Plotly.Plots.resize(plot) : ask()));
  size.observe(stage);
  const handle = {
    element,
    plot,
    get spec() {
      return spec;
    },
    update(changes) {
      spec = { ...spec, ...changes };
      ask();
      return handle;
    },
    redraw: ask,
    remove() {
      size.disconnect();
      live.delete(handle);
      if (drawnOnce) window.Plotly.purge(plot);
      element.remove();
    },
  };
  live.add(handle);
  ask();
  return handle;
}

/** A heat map, with curves on top if asked; see the head of this file. */
export function map(container, spec) {
  return figure(container, { z: [], ...spec });
}

/** Draw all figures again, as after another choice of units or of light and dark. */
export function redrawAll() {
  for (const handle of live) handle.redraw();
}

units.subscribe(redrawAll);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redrawAll);
document.addEventListener("themechange", redrawAll);
