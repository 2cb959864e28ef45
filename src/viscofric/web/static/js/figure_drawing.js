// What plotly draws of a figure's specification (figures.js): traces, axes with ticks that are read at once, marks.

import { ORDER, colours, faded, hue, scaleOf, temperatureLook } from "./figure_look.js";
import * as units from "./units.js";

const MOST_TICKS = 9;
const NEAR = 0.05; // K: the same isotherm
const isThere = (value) => value !== null && value !== undefined && Number.isFinite(value);
const unitOf = (axis) => units.label(axis?.kind);

/** An axis's quantity and its unit. */
export const titled = (axis) => `${axis?.label ?? ""}${unitOf(axis) ? ` (${unitOf(axis)})` : ""}`;

/** A text of several lines, of at most 36 letters each, as fit beside the lowest figure. */
const wrapped = (text) => text.replace(/(.{1,36})(?: |$)/g, "$1<br>").replace(/<br>$/, "");

/** The least and the largest value drawn along an axis, SI; bars and bands count of those that are shown. */
function endsOf(spec, name) {
  if (spec[name]?.range) return spec[name].range;
  const spread = (trace) => [
    trace[name] ?? [],
    ...(name === "y" ? [trace.lower ?? [], trace.upper ?? []] : []),
    ...(name === "y" && trace.error ? [trace.y.map((value, at) => isThere(value) && value + trace.error[at])] : []),
  ];
  const columns = spec.map ? [spec.map[name]] : spec.traces.filter((trace) => !trace.hidden).flatMap(spread);
  return columns
    .flat()
    .reduce(
      ([low, high], value) => (isThere(value) ? [Math.min(low, value), Math.max(high, value)] : [low, high]),
      [Infinity, -Infinity],
    );
}

/** Ticks of a log axis from its ends: of few decades 1, 2 and 5 of each, of many each one or every few, in full words. */
export function logTicks([low, high]) {
  const decades = Math.log10(high / low);
  const plain = low >= 9e-4 && high <= 3e4;
  const look = plain ? { exponentformat: "none" } : { exponentformat: "power" };
  if (!(low > 0) || !(decades > 0.7)) return { tickmode: "auto", ...look };
  const every = Math.max(1, Math.ceil(decades / MOST_TICKS));
  const digits = decades > 1.8 ? [1] : [1, 2, 5];
  const first = every * Math.floor(Math.log10(low) / every);
  const powers = Array.from({ length: Math.ceil(decades / every) + 2 }, (_, at) => first + every * at);
  const words = (digit, power) => {
    if (plain) return String(Number((digit * 10 ** power).toPrecision(1)));
    return `${digit === 1 ? "" : `${digit}×`}10<sup>${String(power).replace("-", "−")}</sup>`;
  };
  const all = powers.flatMap((power) => digits.map((digit) => [digit * 10 ** power, words(digit, power)]));
  const between = every > 1 ? [] : powers.flatMap((power) => [2, 3, 4, 5, 6, 7, 8, 9].map((one) => one * 10 ** power));
  return {
    tickmode: "array",
    tickvals: all.map(([value]) => value),
    ticktext: all.map(([, text]) => text),
    minor: { tickmode: "array", tickvals: between, ticks: "inside", ticklen: 3 },
  };
}

function plotlyAxis(spec, name, look) {
  const axis = spec[name] ?? {};
  const drawn = endsOf(spec, name);
  const fromZero = axis.zero && !axis.log && drawn[0] >= 0 && drawn[1] > 0; // with some room above
  const ends = fromZero ? [0, axis.zero * drawn[1]] : drawn;
  const shown = ends.map((end) => units.number(end, axis.kind));
  return {
    title: { text: name === "y" ? wrapped(titled(axis)) : titled(axis), standoff: 8, font: { size: 13, color: look.ink } },
    type: axis.log ? "log" : "linear",
    tickfont: { size: 12 },
    ...(axis.log ? logTicks(shown) : { exponentformat: "power", minexponent: 4 }),
    ...{ showline: true, mirror: true, linecolor: look.quiet, linewidth: 1 },
    ...{ ticks: "inside", ticklen: 5, tickcolor: look.quiet, gridcolor: look.line, zeroline: false },
    automargin: name === "x" ? "bottom" : "left",
    ticklabeloverflow: "allow", // there is room, and to measure every label takes a fifth of the time
    ...(axis.range || fromZero ? { range: axis.log ? shown.map(Math.log10) : shown, autorange: false } : {}),
    ...(axis.equal ? { scaleanchor: "x", scaleratio: 1 } : {}),
  };
}

export function layoutOf(spec, dark, forFile) {
  const look = colours(dark);
  const named = spec.traces.filter((trace) => trace.name && trace.legend !== false);
  const { shapes, annotations } = marks(spec, look);
  const note = (text, size, color, place) =>
    text && { showarrow: false, xref: "paper", yref: "paper", text, font: { size, color }, ...place };
  const above = { x: 0, xanchor: "left", y: 1.01, yanchor: "bottom" };
  const said = { x: 1, y: 1, xanchor: "right", yanchor: "bottom" };
  const foot = { x: 0, y: 0, yshift: -62, xanchor: "left", yanchor: "top" };
  const ofFile = [
    note(spec.synthetic && "synthetic data", 11, hue("vermilion", dark), said),
    note(spec.origin, 10, look.quiet, foot),
  ];
  const title = { text: `<b>${spec.title}</b>`, font: { size: 16 } };
  const showlegend = named.length > 1 && !barOf(spec, dark);
  return {
    ...{ paper_bgcolor: look.paper, plot_bgcolor: look.paper, autosize: !forFile },
    font: {
      family: 'system-ui, "Segoe UI", Roboto, "Noto Sans", "DejaVu Sans", sans-serif',
      size: 13,
      color: look.ink,
    },
    margin: { l: 56, r: 20, t: forFile ? 60 : 12, b: forFile ? 84 : 48, pad: 0 },
    title: forFile && !showlegend ? { ...title, x: 0.02, xanchor: "left", y: 0.97, yanchor: "top" } : undefined,
    hovermode: "closest",
    hoverlabel: { bgcolor: look.hover, bordercolor: look.quiet, font: { color: look.ink, size: 12 } },
    showlegend,
    legend: {
      ...{ ...above, orientation: "h", font: { size: 12 }, bgcolor: "rgba(0,0,0,0)" },
      title: forFile ? { ...title, side: "top" } : undefined, // above the rows, however many there are
    },
    dragmode: matchMedia("(pointer: coarse)").matches ? false : "zoom",
    xaxis: plotlyAxis(spec, "x", look),
    yaxis: plotlyAxis(spec, "y", look),
    shapes,
    annotations: [...annotations, ...(forFile ? ofFile.filter(Boolean) : [])],
    uirevision: spec.id,
    separators: ".\u2009",
  };
}

/** Lines across the figure. */
function marks(spec, look) {
  const all = spec.marks.map((mark) => {
    const across = mark.x !== undefined;
    const axis = across ? spec.x : spec.y;
    const at = units.number(across ? mark.x : mark.y, axis?.kind);
    const ends = across
      ? { x0: at, x1: at, y0: 0, y1: 1, yref: "paper" }
      : { y0: at, y1: at, x0: 0, x1: 1, xref: "paper" };
    const where = axis?.log ? Math.log10(at) : at;
    const place = across
      ? { x: where, y: 1, yref: "paper", yanchor: "top", xanchor: "left" }
      : { y: where, x: 1, xref: "paper", xanchor: "right", yanchor: "bottom" };
    return {
      shape: { type: "line", layer: "below", line: { color: look.quiet, width: 1, dash: "dot" }, ...ends },
      note: mark.label && { text: mark.label, showarrow: false, font: { size: 11, color: look.quiet }, ...place },
    };
  });
  return { shapes: all.map(({ shape }) => shape), annotations: all.map(({ note }) => note).filter(Boolean) };
}

const temperaturesOf = ({ temperatures, traces }) =>
  temperatures ?? traces.map((one) => one.temperature).filter((one) => one !== undefined);

/** The look of a trace: its own, that of its temperature, or the next hue. */
function lookOf(trace, index, spec, dark) {
  const own = trace.colour ? { colour: hue(trace.colour, dark) } : {};
  const { dash = "solid", symbol = "circle", temperature } = trace;
  if (temperature === undefined) return { colour: hue(ORDER[index % ORDER.length], dark), symbol, dash, ...own };
  const look = temperatureLook(temperature, temperaturesOf(spec), dark);
  return { ...look, ...(trace.dash ? { dash } : {}), ...(trace.symbol ? { symbol } : {}), ...own };
}

/** All that plotly draws; lines on a map are always bright, since the map is dark in either theme. */
export function dataOf(spec, dark) {
  const { map, picked } = spec;
  const isPicked = ({ temperature }) => Math.abs(temperature - picked) < NEAR;
  const some = spec.traces.some(isPicked);
  const drawn = spec.traces.flatMap((trace, index) => {
    const look = lookOf(trace, index, spec, dark || Boolean(map));
    const x = trace.x.length ? units.number(trace.x, spec.x?.kind) : [null]; // in the legend from the start
    const legendgroup = trace.group ?? `${index}`;
    const beside = some && trace.temperature !== undefined && !isPicked(trace);
    const shared = { x, legendgroup, visible: trace.hidden ? "legendonly" : true, opacity: beside ? 0.3 : 1 };
    const line = plotlyTrace(trace, look, spec, dark, some && isPicked(trace) ? 1.6 : 1);
    if (!trace.lower || !trace.upper) return [{ ...line, ...shared }];
    const edgeLine = { width: 0, color: look.colour };
    const edge = { ...shared, mode: "lines", line: edgeLine, hoverinfo: "skip", showlegend: false };
    const fill = { fill: "tonexty", fillcolor: faded(look.colour, beside ? 0.04 : dark ? 0.25 : 0.16) };
    const [lower, upper] = [trace.lower, trace.upper].map((values) => units.number(values, spec.y?.kind));
    // a band without a line of its own is in the legend as the band
    return [
      { ...edge, y: lower },
      { ...edge, y: upper, ...fill, ...(trace.width === 0 && { showlegend: line.showlegend, name: line.name }) },
      { ...line, ...shared, ...(trace.width === 0 && { showlegend: false }) },
    ];
  });
  return [...(map ? [heatOf(spec)] : []), ...drawn, ...(barOf(spec, dark) ?? [])];
}

function plotlyTrace(trace, look, spec, dark, strong) {
  const kind = spec.y?.kind;
  const open = trace.open ? "-open" : "";
  const end = (axis) => (unitOf(axis) ? ` ${unitOf(axis)}` : "");
  const text = `${trace.name ? `<b>${trace.name}</b><br>` : ""}${spec.x?.label ?? "x"} %{x:.4g}${end(spec.x)}<br>`;
  const bars = trace.error?.map((one) => (isThere(one) ? units.number(one, kind) - units.number(0, kind) : null));
  return {
    type: "scatter",
    y: units.number(trace.y, kind),
    mode: trace.mode ?? "lines",
    name: trace.name ?? "",
    text: trace.text,
    showlegend: Boolean(trace.name) && trace.legend !== false,
    line: { color: look.colour, width: strong * (trace.width ?? 2), dash: look.dash },
    marker: {
      color: look.colour,
      symbol: `${look.symbol}${open}`,
      size: strong * (trace.size ?? 7),
      line: { width: open ? 1.5 : 0.8, color: open ? look.colour : colours(dark).paper },
    },
    fill: trace.fill,
    fillcolor: trace.fill ? faded(look.colour, 0.2) : undefined,
    connectgaps: false,
    error_y: bars && { type: "data", array: bars, thickness: 1.1, width: 3, color: look.colour },
    customdata: trace.data,
    meta: trace.temperature,
    hovertemplate: `${text}${spec.y?.label ?? "y"} %{y:.4g}${end(spec.y)}${trace.text ? "<br>%{text}" : ""}<extra></extra>`,
  };
}

/** A colour bar of temperatures that are too many for a legend, as a trace without points. */
function barOf(spec, dark) {
  const scale = scaleOf(temperaturesOf(spec), dark);
  if (!scale) return null;
  const [cmin, cmax] = scale.ends.map((end) => units.number(end, "temperature"));
  const title = { text: `temperature (${units.label("temperature")})`, side: "right", font: { size: 12 } };
  const colorbar = { title, thickness: 10, outlinewidth: 0, tickfont: { size: 11 } };
  const marker = { color: [cmin], cmin, cmax, colorscale: scale.colours, showscale: true, colorbar };
  return [
    { type: "scatter", x: [null], y: [null], mode: "markers", marker, hoverinfo: "skip", showlegend: false, name: "" },
  ];
}

// Viridis, out of nothing where there is no pressure.
const VIRIDIS = "#440154 #482878 #3e4989 #31688e #26828e #1f9e89 #35b779 #6ece58 #b5de2b #fde725".split(" ");
const OUT_OF_NOTHING = [[0, "rgba(68,1,84,0)"], ...VIRIDIS.map((colour, at) => [0.012 + (0.988 * at) / 9, colour])];

function heatOf({ x, y, z, map }) {
  const [across, up] = [units.number(map.x, x.kind), units.number(map.y, y.kind)];
  const words = Object.entries({ x, y, z }).map(([key, axis]) => `${axis.label} %{${key}:.4g} ${unitOf(axis)}`);
  return {
    type: "heatmap",
    ...{ x: across, y: up, z: map.z.map((row) => units.number(row, z.kind)) },
    ...{ colorscale: OUT_OF_NOTHING, zsmooth: map.smooth ?? false, zmin: 0, hoverongaps: false },
    colorbar: {
      thickness: 12,
      outlinewidth: 0,
      tickfont: { size: 12 },
      title: { text: titled(z), side: "right", font: { size: 13 } },
    },
    hovertemplate: `${words.join("<br>")}<extra></extra>`,
  };
}
