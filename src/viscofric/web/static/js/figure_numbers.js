// A figure's numbers in the user's units: as a table, as CSV, in words for a screen reader.

import * as units from "./units.js";

const unitOf = (axis) => (axis?.kind && units.label(axis.kind) ? ` (${units.label(axis.kind)})` : "");

export const titled = (axis) => `${axis?.label ?? ""}${unitOf(axis)}`;

export const hasData = (spec) =>
  spec.z ? spec.z.length > 0 : (spec.traces ?? []).some((trace) => trace.x?.length > 0);

/** Rows of a figure's numbers in the user's units: {head, rows}. */
export function numbers(spec) {
  if (spec.z) {
    const { x, y, z } = spec.axes;
    const rows = spec.z.flatMap((row, at) =>
      row.map((value, along) => [
        units.number(spec.x[along], x.kind),
        units.number(spec.y[at], y.kind),
        units.number(value, z.kind),
      ]),
    );
    return { head: [titled(x), titled(y), titled(z)], rows };
  }
  const traces = spec.traces.filter((trace) => trace.x?.length > 0 && !trace.decoration);
  const same = traces.every((trace) => JSON.stringify(Array.from(trace.x)) === JSON.stringify(Array.from(traces[0].x)));
  const columns = (trace) =>
    [
      ["", trace.y],
      ["lower ", trace.lower],
      ["upper ", trace.upper],
      ["error of ", trace.error],
    ].filter(([, values]) => values);
  if (same && traces.length > 0) {
    const parts = traces.flatMap((trace) =>
      columns(trace).map(([word, values]) => ({
        head: `${word}${titled(spec.y)}${trace.name ? `, ${trace.name}` : ""}`,
        values: units.number(values, spec.y?.kind),
      })),
    );
    const x = units.number(traces[0].x, spec.x?.kind);
    return {
      head: [titled(spec.x), ...parts.map((part) => part.head)],
      rows: x.map((value, at) => [value, ...parts.map((part) => part.values[at])]),
    };
  }
  const words = ["", "lower ", "upper ", "error of "].filter((word) =>
    traces.some((trace) => columns(trace).some(([one]) => one === word)),
  );
  const rows = traces.flatMap((trace) => {
    const found = Object.fromEntries(
      columns(trace).map(([word, values]) => [word, units.number(values, spec.y?.kind)]),
    );
    return units
      .number(trace.x, spec.x?.kind)
      .map((value, at) => [trace.name ?? "", value, ...words.map((word) => found[word]?.[at] ?? null)]);
  });
  return { head: ["curve", titled(spec.x), ...words.map((word) => `${word}${titled(spec.y)}`)], rows };
}

/** The numbers as CSV text, units in the headings. */
export function csv(spec) {
  const { head, rows } = numbers(spec);
  const cell = (value) =>
    value === null || value === undefined
      ? ""
      : /[",\n]/.test(String(value))
        ? `"${String(value).replaceAll('"', '""')}"`
        : String(typeof value === "number" ? Number(value.toPrecision(9)) : value);
  const remark = [
    `# ${spec.title}${spec.synthetic ? " (synthetic material)" : ""}`,
    spec.caption ? `# ${spec.caption.replaceAll("\n", " ")}` : "",
  ].filter(Boolean);
  return [...remark, ...[head, ...rows].map((row) => row.map(cell).join(","))].join("\n") + "\n";
}

/** The text of a figure for screen readers: its curves and their ranges. */
export function described(spec) {
  if (!hasData(spec)) return `${spec.title}: ${spec.empty ?? "no data yet"}.`;
  const [x, y] = spec.z ? [spec.axes.x, spec.axes.y] : [spec.x, spec.y];
  const ends = (values, axis) => {
    const sound = Array.from(values).filter((value) => Number.isFinite(value) && value !== null);
    return sound.length
      ? `${units.show(Math.min(...sound), axis?.kind)} to ${units.show(Math.max(...sound), axis?.kind)}`
      : "nothing";
  };
  if (spec.z)
    return `${spec.title}: map of ${spec.axes.z.label}, ${ends(spec.z.flat(), spec.axes.z)}, over ${x.label} and ${y.label}. Its numbers are in the table.`;
  const curves = spec.traces.filter((trace) => trace.x?.length > 0 && trace.legend !== false).slice(0, 12);
  const sentences = curves.map(
    (trace) => `${trace.name ?? y?.label ?? "curve"}: ${ends(trace.y, y)} for ${x?.label ?? "x"} ${ends(trace.x, x)}`,
  );
  return `${spec.title}: ${y?.label ?? "y"} against ${x?.label ?? "x"}. ${sentences.join("; ")}. Its numbers are in the table.`;
}
