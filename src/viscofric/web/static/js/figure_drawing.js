// From a figure's specification (figures.js) to what plotly draws: traces, axes with sane ticks, layout.

import { colours, faded, hue, temperatureLook } from "./figure_look.js";
import { titled } from "./figure_numbers.js";
import * as units from "./units.js";

/** Numbers that lie along an axis, in the user's unit. */
function along(spec, axis, name) {
  if (axis?.range) return axis.range.map((value) => units.number(value, axis.kind));
  if (spec.z) return units.number(spec[name], axis?.kind);
  return spec.traces.filter((trace) => !trace.hidden).flatMap((trace) => units.number(trace[name] ?? [], axis?.kind));
}

/** Ticks of a log axis: a label at each decade, or at every few; numbers in full where they are short. */
function logTicks(values) {
  const sound = values.filter((value) => value > 0 && Number.isFinite(value));
  const [low, high] = sound.reduce(
    ([least, most], value) => [Math.min(least, value), Math.max(most, value)],
    [Infinity, 0],
  );
  const decades = Math.log10(high / low);
  const plain = low >= 9e-4 && high <= 3e4;
  // plotly draws powers a quarter larger than other ticks
  const look = plain ? { exponentformat: "none" } : { exponentformat: "power", tickfont: { size: 10 } };
  if (decades > 1.8) return { ...look, dtick: Math.max(1, Math.ceil(decades / 9)) };
  return decades > 0.7 ? { ...look, dtick: "D2" } : look; // 1, 2, 5 of each decade
}

function plotlyAxis(axis = {}, dark, values = [], side = "bottom") {
  const look = colours(dark);
  const range = axis.range?.map((value) => {
    const shown = units.number(value, axis.kind);
    return axis.log ? Math.log10(shown) : shown;
  });
  return {
    title: { text: titled(axis), standoff: 8, font: { size: 13, color: look.ink } },
    type: axis.log ? "log" : "linear",
    tickfont: { size: 12 },
    ...(axis.log ? logTicks(values) : { exponentformat: "power", minexponent: 4 }),
    showline: true,
    mirror: true,
    linecolor: look.quiet,
    linewidth: 1,
    ticks: "inside",
    ticklen: 5,
    tickcolor: look.quiet,
    minor: axis.log ? { ticks: "inside", ticklen: 3, tickcolor: look.quiet, showgrid: false } : undefined,
    gridcolor: look.line,
    zeroline: false,
    automargin: side,
    ...(range ? { range, autorange: false } : {}),
    ...(axis.equal ? { scaleanchor: "x", scaleratio: 1 } : {}),
  };
}

export function layoutOf(spec, dark, forFile) {
  const look = colours(dark);
  const named = (spec.traces ?? spec.lines ?? []).filter((trace) => trace.name && trace.legend !== false);
  const top = forFile ? 60 : 12;
  const { x, y } = spec.axes ?? spec;
  return {
    paper_bgcolor: look.paper,
    plot_bgcolor: look.paper,
    autosize: !forFile,
    font: {
      family: 'system-ui, "Segoe UI", Roboto, "Noto Sans", "DejaVu Sans", sans-serif',
      size: 13,
      color: look.ink,
    },
    margin: { l: 56, r: 14, t: top, b: 48, pad: 0 },
    title: forFile
      ? { text: `<b>${spec.title}</b>`, font: { size: 16 }, x: 0.02, xanchor: "left", y: 0.97, yanchor: "top" }
      : undefined,
    hovermode: "closest",
    hoverlabel: { bgcolor: look.hover, bordercolor: look.quiet, font: { color: look.ink, size: 12 } },
    showlegend: named.length > 1,
    legend: {
      orientation: "h",
      x: 0,
      xanchor: "left",
      y: 1.01,
      yanchor: "bottom",
      font: { size: 12 },
      bgcolor: "rgba(0,0,0,0)",
    },
    dragmode: matchMedia("(pointer: coarse)").matches ? false : "zoom",
    xaxis: plotlyAxis(x, dark, along(spec, x, "x")),
    yaxis: plotlyAxis(y, dark, along(spec, y, "y"), "left"),
    shapes: marks(spec, look).shapes,
    annotations: [...marks(spec, look).annotations, ...(forFile ? syntheticMark(spec) : [])],
    uirevision: spec.id,
    separators: ".\u2009",
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
    const ends = across
      ? { x0: at, x1: at, y0: 0, y1: 1, yref: "paper" }
      : { y0: at, y1: at, x0: 0, x1: 1, xref: "paper" };
    shapes.push({ type: "line", layer: "below", line: { color: look.quiet, width: 1, dash: "dot" }, ...ends });
    const place = across
      ? { x: axis?.log ? Math.log10(at) : at, y: 1, yref: "paper", yanchor: "top", xanchor: "left" }
      : { y: axis?.log ? Math.log10(at) : at, x: 1, xref: "paper", xanchor: "right", yanchor: "bottom" };
    if (mark.label)
      annotations.push({ text: mark.label, showarrow: false, font: { size: 11, color: look.quiet }, ...place });
  }
  return { shapes, annotations };
}

function syntheticMark(spec) {
  if (!spec.synthetic) return [];
  const font = { size: 11, color: hue("vermilion", false) };
  return [
    {
      text: "synthetic data",
      xref: "paper",
      yref: "paper",
      x: 1,
      y: 1,
      xanchor: "right",
      yanchor: "bottom",
      showarrow: false,
      font,
    },
  ];
}

/** The look of a trace: its own, that of its temperature, or the next hue. */
function lookOf(trace, index, spec, dark) {
  const all = spec.traces.map((one) => one.temperature).filter((one) => one !== undefined);
  if (trace.temperature !== undefined) {
    const look = temperatureLook(trace.temperature, spec.temperatures ?? all, dark);
    return {
      ...look,
      ...(trace.dash ? { dash: trace.dash } : {}),
      ...(trace.symbol ? { symbol: trace.symbol } : {}),
      ...(trace.colour ? { colour: hue(trace.colour, dark) } : {}),
    };
  }
  const order = ["blue", "vermilion", "green", "purple", "orange", "sky"];
  return {
    colour: hue(trace.colour ?? order[index % order.length], dark),
    symbol: trace.symbol ?? "circle",
    dash: trace.dash ?? "solid",
  };
}

export function plotlyTraces(spec, dark) {
  const drawn = [];
  spec.traces.forEach((trace, index) => {
    const look = lookOf(trace, index, spec, dark);
    const x = units.number(trace.x, spec.x?.kind);
    const group = trace.group ?? `${index}`;
    if (trace.lower && trace.upper) {
      const edge = {
        x,
        mode: "lines",
        line: { width: 0, color: look.colour },
        hoverinfo: "skip",
        showlegend: false,
        legendgroup: group,
        visible: trace.hidden ? "legendonly" : true,
      };
      drawn.push({ ...edge, y: units.number(trace.lower, spec.y?.kind) });
      drawn.push({
        ...edge,
        y: units.number(trace.upper, spec.y?.kind),
        fill: "tonexty",
        fillcolor: faded(look.colour, dark ? 0.25 : 0.16),
      });
    }
    drawn.push(plotlyTrace(trace, look, x, spec, group, dark));
  });
  return drawn;
}

function plotlyTrace(trace, look, x, spec, group, dark) {
  const y = units.number(trace.y, spec.y?.kind);
  const mode = trace.mode ?? "lines";
  const open = trace.open ? "-open" : "";
  const bars = trace.error && {
    type: "data",
    array: spec.y?.kind
      ? trace.error.map((one) => (one === null ? null : units.number(one, spec.y.kind) - units.number(0, spec.y.kind)))
      : trace.error,
    thickness: 1.1,
    width: 3,
    color: look.colour,
  };
  return {
    type: "scatter",
    x,
    y,
    mode,
    name: trace.name ?? "",
    legendgroup: group,
    text: trace.text,
    showlegend: Boolean(trace.name) && trace.legend !== false,
    visible: trace.hidden ? "legendonly" : true,
    line: { color: look.colour, width: trace.width ?? 2, dash: look.dash, shape: trace.shape },
    marker: {
      color: look.colour,
      symbol: `${look.symbol}${open}`,
      size: trace.size ?? 7,
      line: { width: open ? 1.5 : 0.8, color: open ? look.colour : colours(dark).paper },
    },
    fill: trace.fill,
    fillcolor: trace.fill ? faded(look.colour, 0.2) : undefined,
    connectgaps: false,
    error_y: bars || undefined,
    customdata: trace.data,
    hovertemplate: hover(trace, spec),
    cliponaxis: trace.clip ?? true,
  };
}

function hover(trace, spec) {
  const end = (axis) => (axis?.kind && units.label(axis.kind) ? ` ${units.label(axis.kind)}` : "");
  const text = trace.text ? "<br>%{text}" : "";
  return `${trace.name ? `<b>${trace.name}</b><br>` : ""}${spec.x?.label ?? "x"} %{x:.4g}${end(spec.x)}<br>${spec.y?.label ?? "y"} %{y:.4g}${end(spec.y)}${text}<extra></extra>`;
}

// Lines on a map are always bright: the map is dark in either theme.
export function mapTraces(spec) {
  const { x, y, z } = spec.axes;
  const size = {
    thickness: 12,
    outlinewidth: 0,
    tickfont: { size: 12 },
    title: { text: titled(z), side: "right", font: { size: 13 } },
  };
  const heat = {
    type: "heatmap",
    x: units.number(spec.x, x.kind),
    y: units.number(spec.y, y.kind),
    z: spec.z.map((row) => units.number(row, z.kind)),
    colorscale: spec.scale ?? "Viridis",
    zsmooth: spec.smooth ?? false,
    zmin: spec.zero ? 0 : undefined,
    colorbar: size,
    hoverongaps: false,
    hovertemplate: `${x.label} %{x:.4g} ${units.label(x.kind)}<br>${y.label} %{y:.4g} ${units.label(y.kind)}<br>${z.label} %{z:.4g} ${units.label(z.kind)}<extra></extra>`,
  };
  const lines = plotlyTraces({ ...spec, x, y, traces: spec.lines ?? [] }, true);
  return [heat, ...lines];
}
