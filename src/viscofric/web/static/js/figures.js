// Figures as views of results: light and dark, in the user's units, each with a table of its numbers and downloads.
//
// <${Figure} of=${result} id="friction-curve" title="…" caption="…"
//   x=${{label: "speed", kind: "speed", log: true}} y=${{label: "friction coefficient", zero: 1.06}}
//   traces=${[{name, x, y, mode: "lines" | "markers" | "lines+markers", temperature | colour, dash, symbol, size, width, open,
//              lower, upper (a band around y), error (bars), hidden, legend: false, text, group, decoration, fill}, …]}
//   look=${of all traces} temperatures=${all that share colours} marks=${[{x | y, label}, …]} map=${{x, y, z: [[…]], smooth}} z=${axis of the map}
//   height=${400} empty="text without data" hint="what can be done with it here" synthetic onClick=${(point) => …} onPlot=${(plot) => …} />
//
// What is not given is that of the result: of.figures[id], or `spec`.  All numbers are SI; columns may be paths into the result
// ("profile.x"), and words may hold quantities (units.js: filled).  An axis is {label, kind, log, range: [from, to], equal, zero:
// factor above the largest value}.  A figure of other inputs than those of now is grey with a word (views.js: shown).
// A click on a curve of some temperature picks that isotherm, which is then strong in all figures.

import { dataOf, layoutOf, logTicks, titled } from "./figure_drawing.js";
import { isDark } from "./figure_look.js";
import { isStale, studyOf } from "./jobs.js";
import { isSynthetic, originOf } from "./page.js";
import { html, view } from "./reactive.js";
import { state, valueAt } from "./state.js";
import * as units from "./units.js";
import { Button, Table, shown } from "./views.js";

export { chooseTheme, hue, isDark, temperatureColour } from "./figure_look.js";

const MOST_ROWS = 2000;
const COLUMNS = ["x", "y", "lower", "upper", "error"];

/** Plotly, once it has come; index.html has it fetched from the start. */
const drawing = () => import("../vendor/plotly-cartesian.min.js").then(() => window.Plotly);

/** Hand a file to the user. */
export function save(name, content, type = "text/plain") {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** The isotherm that is strong in all figures, K; null for none. */
export const picked = () => state.view("isotherm", null);
export const pick = (kelvin) => state.setView("isotherm", kelvin);

const hasData = ({ map, traces }) => Boolean(map) || traces.some((trace) => trace.x.length > 0);

/** Rows of a figure's numbers in the user's units: {head, rows}. */
export function numbers({ x, y, z, map, traces }) {
  if (map) {
    const [across, up] = [units.number(map.x, x.kind), units.number(map.y, y.kind)];
    const rows = map.z.flatMap((row, at) =>
      row.map((one, place) => [across[place], up[at], units.number(one, z.kind)]),
    );
    return { head: [x, y, z].map(titled), rows };
  }
  const all = traces.filter((trace) => trace.x.length > 0 && !trace.decoration);
  const words = { y: "", lower: "lower ", upper: "upper ", error: "error of " };
  const parts = Object.keys(words).filter((part) => all.some((trace) => trace[part]));
  const across = (trace) => units.number(trace?.x ?? [], x?.kind);
  const column = (trace, part) => units.number(trace[part] ?? [], y?.kind);
  const label = (part) => `${words[part]}${titled(y)}`;
  if (all.every((trace) => JSON.stringify(trace.x) === JSON.stringify(all[0].x))) {
    const columns = all.flatMap((trace) =>
      parts
        .filter((part) => trace[part])
        .map((part) => [`${label(part)}${trace.name ? `, ${trace.name}` : ""}`, column(trace, part)]),
    );
    const rows = across(all[0]).map((one, at) => [one, ...columns.map(([, values]) => values[at])]);
    return { head: [titled(x), ...columns.map(([head]) => head)], rows };
  }
  const rows = all.flatMap((trace) => {
    const columns = parts.map((part) => column(trace, part));
    return across(trace).map((one, at) => [trace.name ?? "", one, ...columns.map((values) => values[at] ?? null)]);
  });
  return { head: ["curve", titled(x), ...parts.map(label)], rows };
}

/** The numbers as CSV text, units in the headings. */
function csv(spec) {
  const { head, rows } = numbers(spec);
  const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const cell = (value) => quoted(String(typeof value === "number" ? Number(value.toPrecision(9)) : (value ?? "")));
  const title = `${spec.title}${spec.synthetic ? " (synthetic material)" : ""}`;
  const remarks = [title, spec.caption, spec.origin].filter(Boolean).map((text) => `# ${text.replaceAll("\n", " ")}`);
  return `${[...remarks, ...[head, ...rows].map((row) => row.map(cell).join(","))].join("\n")}\n`;
}

/** The text of a figure for screen readers: its curves and their ranges. */
function described(spec) {
  const { title, x, y, z, map, traces } = spec;
  if (!hasData(spec)) return `${title}: ${spec.empty ?? "no data yet"}.`;
  const ends = (values, axis) => {
    const sound = values.filter((value) => Number.isFinite(value));
    const [low, high] = [Math.min(...sound), Math.max(...sound)].map((end) => units.show(end, axis?.kind));
    return sound.length ? `${low} to ${high}` : "nothing";
  };
  const table = "Its numbers are in the table.";
  if (map) return `${title}: map of ${z.label}, ${ends(map.z.flat(), z)}, over ${x.label} and ${y.label}. ${table}`;
  const [across, up] = [x?.label ?? "x", y?.label ?? "y"];
  const curves = traces.filter((trace) => trace.x.length > 0 && trace.legend !== false).slice(0, 12);
  const sentences = curves.map((one) => `${one.name || up}: ${ends(one.y, y)} for ${across} ${ends(one.x, x)}`);
  return `${title}: ${up} against ${across}. ${sentences.join("; ")}. ${table}`;
}

async function savePicture(spec, format) {
  const Plotly = await drawing();
  const [width, height] = spec.map ? [900, 720] : [900, 620];
  const layout = { ...layoutOf(spec, isDark(), true), width, height }; // light or dark as on the page
  const picture = { data: dataOf(spec, isDark()), layout };
  const url = await Plotly.toImage(picture, { format, width, height, scale: format === "png" ? 2 : 1 });
  const content = url.slice(url.indexOf(",") + 1);
  if (format === "svg") return save(`${spec.id}.svg`, decodeURIComponent(content), "image/svg+xml");
  const bytes = Uint8Array.from(atob(content), (one) => one.charCodeAt(0));
  return save(`${spec.id}.png`, new Blob([bytes], { type: "image/png" }));
}

function download(spec, format) {
  const earlier = { ...spec, id: `${spec.id}_earlier_inputs`, title: `${spec.title} (earlier inputs)` };
  const kept = isStale(spec.of) ? earlier : spec;
  return format === "CSV" ? save(`${kept.id}.csv`, csv(kept), "text/csv") : savePicture(kept, format.toLowerCase());
}

const REST = 200; // ms
const owed = new Set(); // painters of figures that show something else than they were told

/** Whether the middle of a painter's figure is in sight. */
export function inSight({ plot }) {
  const { top, bottom } = plot.getBoundingClientRect();
  return bottom > -top && top + bottom < 2 * innerHeight;
}

/** Whether all figures that are seen, or some of them (inSight), show what they were told last. */
export const areDrawn = (some = () => true) => ![...owed].some(some);

/** Draw what is owed: figures in sight go first, each other one once those before it are seen and no slider changes it. */
async function paint() {
  for (await null; owed.size; await new Promise(requestAnimationFrame)) {
    const near = [...owed].filter(inSight);
    const resting = [...owed].filter(({ asked }) => performance.now() - asked > REST);
    for (const one of near.length ? near : resting.slice(0, 1)) {
      const { spec } = one;
      await one.draw().catch(console.error);
      if (one.spec === spec) owed.delete(one);
    }
  }
}

/** What draws one figure again, each time that it has another spec or is seen. */
class Painter {
  drawn = null; // the spec that is drawn; another one is owed

  constructor(plot) {
    this.plot = plot;
    this.size = new ResizeObserver(() => {
      if (this.drawn && this.drawn === this.spec) window.Plotly.Plots.resize(plot);
      else this.request();
    });
    this.size.observe(plot);
  }

  request(spec = this.spec) {
    Object.assign(this, { spec, asked: performance.now() });
    if (!spec) return;
    if (owed.size === 0) paint();
    owed.add(this);
  }

  async draw() {
    const { plot, spec } = this;
    if (!plot.isConnected || plot.clientWidth === 0) return; // drawn when it is seen
    const Plotly = await drawing();
    const options = { displayModeBar: false, displayNotifier: false, responsive: false, doubleClick: "reset+autosize" };
    const content = [hasData(spec) ? dataOf(spec, isDark()) : [], layoutOf(spec, isDark(), false)];
    const [first, words] = [!this.drawn, JSON.stringify([content, plot.clientWidth, plot.clientHeight])];
    const same = this.words === words; // to draw it again takes longer than all else
    Object.assign(this, { drawn: spec, words });
    if (same) return;
    await Plotly.react(plot, ...content, options);
    if (!first) return;
    plot.on("plotly_restyle", () => (this.words = null)); // a curve was dragged
    plot.on("plotly_relayout", () => this.ticks(Plotly));
    plot.on("plotly_click", ({ points: [point] }) => {
      if (point.data.meta !== undefined) pick(point.data.meta === picked() ? null : point.data.meta);
      this.spec.onClick?.(point);
    });
    spec.onPlot?.(plot);
  }

  /** A close look needs closer ticks. */
  ticks(Plotly) {
    const { plot } = this;
    const next = ["xaxis", "yaxis"].flatMap((name) => {
      const { type, range, tickmode, tickvals } = plot._fullLayout[name];
      if (type !== "log") return [];
      const ticks = logTicks(range.map((power) => 10 ** power));
      const same = tickmode === ticks.tickmode && String(tickvals) === String(ticks.tickvals);
      return same ? [] : Object.entries(ticks).map(([key, value]) => [`${name}.${key}`, value]);
    });
    if (next.length) Plotly.relayout(plot, Object.fromEntries(next));
  }

  end() {
    owed.delete(this);
    this.size.disconnect();
    if (this.drawn) window.Plotly.purge(this.plot);
  }
}

/** All that a figure shows: its properties and what its result says of it, with columns and words filled in. */
function specOf(given) {
  const { of, id } = given;
  const all = { title: id, traces: [], marks: [], ...given, ...(given.spec ?? of?.figures?.[id]) };
  const each = (from, names, change) =>
    Object.fromEntries(names.filter((name) => from[name]).map((name) => [name, change(from[name])]));
  const column = (values) => (typeof values === "string" ? valueAt(of, values) : Array.from(values));
  return {
    ...all,
    ...each(all, ["x", "y", "z"], (axis) => ({ ...axis, label: units.filled(axis.label) })),
    ...each(all, ["title", "caption"], units.filled),
    map: all.map && { ...all.map, ...each(all.map, ["x", "y", "z"], column) },
    marks: all.marks.map((mark) => ({ ...mark, ...each(mark, ["label"], units.filled) })),
    traces: all.traces.map(({ temperature, ...one }) => ({
      ...all.look,
      ...(temperature === undefined ? {} : { temperature, name: units.show(temperature, "temperature") }),
      ...one,
      ...each(one, ["name"], units.filled),
      ...each(one, COLUMNS, column),
    })),
    synthetic: all.synthetic ?? Boolean(of && (of.synthetic || isSynthetic(studyOf(of)))),
    origin: of ? originOf(studyOf(of)) : "",
    picked: picked(),
  };
}

export const Figure = view((given, self) => {
  const { of, id } = given;
  const spec = specOf(given);
  const there = hasData(spec);
  const open = self.open && there && numbers(spec);
  const toggle = () => {
    self.open = !self.open;
    self.setState({});
  };
  const tool = (name, icon, act, words) => html`<${Button} kind="quiet small" symbol=${icon} disabled=${!there}
    aria-label="${name}: ${spec.title}" aria-expanded=${name === "Table" ? String(Boolean(self.open)) : undefined} onClick=${act}>
    <span class=${words}>${name}</span>
  <//>`;
  const strong = spec.traces.some(({ temperature }) => temperature !== undefined && temperature === spec.picked);
  // what is told to the plot once it is there
  const tell = (plot) => {
    if (plot) (self.painter ??= new Painter(plot)).request(spec);
  };
  self.gone = () => self.painter?.end();
  void [isDark(), units.choices()];
  self.painter?.request(spec);
  return html`<figure ...${shown(of, "figure")} id="figure-${id}">
    <div class="figure-head">
      <span class="figure-title">${spec.title}</span>
      <div class="figure-tools">
        ${tool("Table", "table", toggle, "word")}
        ${["PNG", "SVG", "CSV"].map((name) => tool(name, name === "PNG" && "down", () => download(spec, name), "format"))}
      </div>
    </div>
    <div class="stage" style=${spec.height ? `height: ${spec.height}px` : ""}>
      <div class="plot" role="img" aria-label=${described(spec)} ref=${self.painter ? undefined : tell} />
      <p class="plot-empty" hidden=${there}>${spec.empty ?? "Nothing to draw yet."}</p>
    </div>
    <figcaption>
      <span class="badge small" hidden=${!there || !spec.synthetic}>synthetic</span>
      <span class="figure-caption" hidden=${!spec.caption}>${spec.caption}</span>
      <span class="figure-hint" hidden=${!spec.hint}>${spec.caption ? " " : ""}${spec.hint}</span>
      ${strong && html`<${Button} kind="quiet small" symbol="close" onClick=${() => pick(null)}>${units.show(spec.picked, "temperature")} picked<//>`}
    </figcaption>
    <div class="figure-table" hidden=${!self.open}>
      ${open && html`<${Table} head=${open.head} rows=${open.rows.slice(0, MOST_ROWS)} caption="Numbers of: ${spec.title}" />`}
      ${open?.rows.length > MOST_ROWS && html`<p class="help">The first ${MOST_ROWS} of ${open.rows.length} rows; the CSV file has all.</p>`}
    </div>
  </figure>`;
});

/**
 * Figures of a result, or of the first of several results that has them, each a card.  `ids` are ids or [id, title]: one with a
 * title is there from the start, and is `empty` till there is a result.
 */
export const Figures = ({ of, ids, ...rest }) =>
  ids.map((one) => {
    const [id, title] = [one].flat();
    const found = [of].flat().find((result) => result?.figures[id]);
    if (!found && !title) return null;
    const about = { of: found, id, ...(title && { title }), ...(!found && { height: 160 }), ...rest };
    return html`<section class="card" key=${id}><${Figure} ...${about} /></section>`;
  });
