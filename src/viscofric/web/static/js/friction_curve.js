// The friction curve: asked for after each change, its points drawn as they are known, the one before in grey till then.

const VIEWS = { speed: "speed", shifted: "shifted speed α(T)·v" };
const QUANTITIES = {
  friction: { label: "friction coefficient μ", kind: undefined },
  indentation: { label: "indentation", kind: "length" },
  contact_area: { label: "contact area", kind: "area" },
  contact_area_fraction: { label: "share of area in contact", kind: undefined },
  max_pressure: { label: "largest pressure", kind: "pressure" },
  mean_gap: { label: "mean gap", kind: "length" },
};
// Tables of the study that a curve depends on.
const WATCHED = ["material", "indenter", "surface", "layer", "conditions", "solver", "sweep", "uncertainty"];
const WORDS = {
  extrapolated: "it rests on the spectrum beyond the frequencies at which the rubber was measured",
  shift: "the shift factor is extrapolated beyond the temperatures of the sweeps",
  strain: "the contact is wide or steep, so that small strain is doubtful",
  unresolved: "the grid does not resolve it: its numerical error is more than twice the accuracy asked for",
};
const GREY = "#8a949e";
const RESTS = 350; // ms, after the last change of the form

/** Cases of one curve each, by temperature, in the order of their speeds. */
export function curvesOf(layout, combination) {
  const found = new Map();
  layout.temperature.forEach((kelvin, at) => {
    if (layout.combination[at] !== combination) return;
    if (!found.has(kelvin)) found.set(kelvin, []);
    found.get(kelvin).push(at);
  });
  for (const rows of found.values()) rows.sort((one, other) => layout.speed[one] - layout.speed[other]);
  return [...found].sort(([one], [other]) => one - other);
}

/** The card of the curve. onPick({speed, temperature}) is called for a point that was clicked. */
export function frictionCard({ state, units, figures, fields, api, announce }, { onPick }) {
  const { h, button } = fields;
  let layout = null; // of the curve that is shown: columns of its cases
  let points = null; // friction and whether it is known, of each case
  let result = null; // all that is known at the end
  let before = null; // {layout, points, result} that is shown in grey
  let pinned = null;
  let live = null; // {speed, temperature, reduced_speed, numbers} of the live contact
  let running = null;
  let timer = null;
  let combination = 0;

  const bar = fields.progressBar({ label: "Solving", onCancel: () => running?.abort() });
  const told = fields.note([], "warning");
  const failed = fields.note([], "error");
  const notes = fields.note([]);
  const checks = h("ul", { class: "notes" });
  const checked = h("details", { hidden: true }, h("summary", {}, "What was checked"), checks, notes);

  const chooser = (label, entries, onChange) => {
    const select = h("select", { "aria-label": label }, entries.map(([value, text]) => h("option", { value }, text)));
    select.addEventListener("change", () => onChange(select.value));
    return select;
  };
  const view = chooser("Against", Object.entries(VIEWS).map(([value, text]) => [value, `against ${text}`]), (value) => {
    state.setView("curve.view", value);
    draw();
  });
  view.value = state.view("curve.view", "speed");
  const quantity = chooser("Shown", Object.entries(QUANTITIES).map(([value, { label }]) => [value, label]), draw);
  const which = chooser("Combination", [], (value) => {
    combination = Number(value);
    state.setView("contact.combination", combination);
    draw();
    onPick({});
  });
  const pin = button({ label: "Keep for comparison", kind: "small", onClick: () => {
    pinned = pinned ? null : { layout, points, result };
    announce(pinned ? "The curve is kept in grey." : "The kept curve is gone.");
    draw();
  } });
  const tools = h("div", { class: "row curve-tools" }, view, quantity, which, pin);
  const card = fields.card("Friction", tools);
  const handle = figures.figure(card, {
    id: "friction-curve",
    title: "Friction against speed",
    x: { label: "speed", kind: "speed", log: true },
    y: { label: QUANTITIES.friction.label },
    empty: "The first points are on their way.",
    onClick: pick,
  });
  card.append(bar, failed, told, checked);

  function pick(point) {
    const at = point?.customdata;
    if (at === undefined || at === null || !layout) return;
    onPick({ speed: layout.speed[at], temperature: layout.temperature[at] });
  }

  const name = () => (view.value === "shifted" ? "reduced_speed" : "speed");
  const temperatures = () => [...new Set(layout.temperature)];

  /** Rows of a curve that have something to show, and their values. */
  function shown(rows, values) {
    const there = rows.filter((at) => values[at] !== null && values[at] !== undefined);
    return { rows: there, x: there.map((at) => layout[name()][at]), y: there.map((at) => values[at]) };
  }

  function tracesOfCurve(kelvin, rows) {
    const values = quantity.value === "friction" ? points.friction : (result?.[quantity.value] ?? []);
    const { rows: there, x, y } = shown(rows, values);
    const label = units.show(kelvin, "temperature");
    const all = temperatures();
    const shared = { temperature: kelvin, group: `T${kelvin}`, data: there, name: label };
    if (result) {
      const banded = quantity.value === "friction" && result.lower?.some((value) => value !== null);
      const end = (column) => (banded ? there.map((at) => column[at]) : undefined);
      const error = quantity.value === "friction" && !banded ? there.map((at) => result.error[at]) : undefined;
      return [{ ...shared, x, y, mode: "lines+markers", size: 6, lower: end(result.lower), upper: end(result.upper), error, text: there.map(doubtWords) }];
    }
    const known = shown(rows.filter((at) => points.known[at]), values);
    const drafts = shown(rows.filter((at) => !points.known[at]), values);
    const colour = figures.temperatureColour(kelvin, all);
    return [
      { ...shared, x, y, mode: "lines", width: 1, legend: false, dash: "3px,3px" },
      { ...shared, data: known.rows, x: known.x, y: known.y, mode: "markers", size: 6 },
      { ...shared, data: drafts.rows, x: drafts.x, y: drafts.y, mode: "markers", size: 5, open: true, legend: false, colour },
    ].filter((trace) => trace.x.length > 0);
  }

  const doubtWords = (at) => result.doubts[at].map((word) => WORDS[word] ?? word).join("<br>");

  function ringed() {
    if (!result) return [];
    const values = result[quantity.value] ?? [];
    const all = layout.speed.map((_, at) => at).filter((at) => layout.combination[at] === combination && result.doubts[at].length > 0);
    const { rows, x, y } = shown(all, values);
    return rows.length === 0 ? [] : [{ name: "doubtful", x, y, data: rows, mode: "markers", symbol: "circle", open: true, size: 13, colour: "orange", text: rows.map(doubtWords), decoration: true }];
  }

  /** Another curve in grey. */
  function ghost(other, label, dash) {
    if (!other?.layout || quantity.value !== "friction") return [];
    const number = Math.min(combination, other.layout.combinations.length - 1);
    return curvesOf(other.layout, number).map(([, rows], index) => {
      const there = rows.filter((at) => other.points.friction[at] !== null);
      return {
        x: there.map((at) => other.layout[name()][at]), y: there.map((at) => other.points.friction[at]),
        name: label, legend: index === 0, group: label, mode: "lines", colour: GREY, width: 1.6, dash, decoration: true,
      };
    });
  }

  function masterLine() {
    if (view.value !== "shifted" || quantity.value !== "friction" || !result?.master) return [];
    const { reduced_speed: x, friction: y, lower, upper } = result.master;
    return [{ name: "master curve", x, y, lower: lower ?? undefined, upper: upper ?? undefined, mode: "lines", colour: GREY, width: 1.2 }];
  }

  function liveMark() {
    if (!live || quantity.value !== "friction" || (live.combination ?? 0) !== combination) return [];
    const x = view.value === "shifted" ? live.numbers.reduced_speed.value : live.speed;
    return [{ name: "live contact", x: [x], y: [live.numbers.friction_coefficient.value], mode: "markers", symbol: "star", size: 13, colour: "purple", decoration: true, text: [units.show(live.temperature, "temperature")] }];
  }

  function draw() {
    if (!layout) return;
    const curves = curvesOf(layout, combination);
    const hasPoints = points.friction.some((value) => value !== null);
    const shifted = view.value === "shifted";
    const { label, kind } = QUANTITIES[quantity.value];
    const traces = [
      ...ghost(pinned, "kept", "6px,4px"),
      ...(hasPoints ? [] : ghost(before, "before", "solid")),
      ...masterLine(),
      ...curves.flatMap(([kelvin, rows]) => tracesOfCurve(kelvin, rows)),
      ...ringed(),
      ...liveMark(),
    ];
    handle.update({
      title: `${label[0].toUpperCase()}${label.slice(1)} against ${shifted ? "shifted speed" : "speed"}`,
      caption: caption(shifted, hasPoints),
      x: { label: shifted ? `α(T)·v at ${units.show(layout.reference, "temperature")}` : "speed", kind: "speed", log: true, range: ends() },
      y: { label, kind, range: [0, 1.06 * Math.max(...traces.flatMap((trace) => [...trace.y, ...(trace.upper ?? [])]), 1e-12)] },
      temperatures: temperatures(),
      synthetic: isSynthetic(),
      traces,
    });
    pin.disabled = !pinned && !result;
    pin.textContent = pinned ? "Remove the kept curve" : "Keep for comparison";
  }

  /** All speeds that are asked for, so that the figure stays where it is while points come. */
  function ends() {
    const all = layout[name()].filter((_, at) => layout.combination[at] === combination);
    const gap = all.length > 1 ? 1.15 : 3;
    return [Math.min(...all) / gap, Math.max(...all) * gap];
  }

  function isSynthetic() {
    return !document.getElementById("synthetic").hidden;
  }

  function caption(shifted, hasPoints) {
    if (!hasPoints) return "Grey: the curve before the last change.";
    const parts = ["Click a point to see its contact below."];
    if (!result) parts.unshift("Filled points are to the accuracy; open ones lie between contacts that may still be refined.");
    else if (result.lower?.some((value) => value !== null)) parts.unshift("Bands: 95 %, from the rubber's own uncertainty.");
    if (shifted) parts.unshift("Each temperature is moved by its shift factor: where the curves meet, time and temperature are one.");
    return parts.join(" ");
  }

  /** Offer what there is: quantities of this kind of contact, and combinations of all else that varies. */
  function offer() {
    which.hidden = layout.combinations.length < 2;
    which.replaceChildren(...layout.combinations.map((words, at) => h("option", { value: String(at) }, words)));
    combination = Math.min(combination, layout.combinations.length - 1);
    which.value = String(combination);
    for (const option of quantity.options) {
      const missing = layout.kind === "rough" ? ["indentation", "contact_area"] : ["contact_area_fraction", "mean_gap"];
      option.hidden = option.disabled = missing.includes(option.value);
      if (option.value === "contact_area") option.textContent = layout.kind === "line" ? "contact width" : "contact area";
    }
    QUANTITIES.contact_area = layout.kind === "line" ? { label: "contact width", kind: "length" } : { label: "contact area", kind: "area" };
    if (quantity.selectedOptions[0]?.disabled) quantity.value = "friction";
  }

  function take(part) {
    if (part.layout) {
      if (points?.friction.some((value) => value !== null)) before = { layout, points, result };
      layout = part.layout;
      result = null;
      told.set([]);
      checked.hidden = true;
      points = { friction: layout.speed.map(() => null), known: layout.speed.map(() => false) };
      offer();
    } else {
      part.cases.forEach((at, index) => {
        points.friction[at] = part.friction[index];
        points.known[at] = part.known[index];
      });
    }
    draw();
  }

  function finish(answer) {
    result = answer;
    layout = answer;
    points = { friction: answer.friction, known: answer.friction.map((value) => value !== null) };
    before = null;
    const unresolved = answer.doubts.filter((words) => words.includes("unresolved")).length;
    const also = unresolved ? [`At ${unresolved} of ${answer.speed.length} points the grid does not resolve friction to the accuracy asked for; give a finer one, or read their error bars.`] : [];
    told.set([...answer.warnings, ...also]);
    failed.set(answer.failures.slice(0, 5));
    notes.set(answer.notes);
    const marks = { true: "✓ ", false: "Look at this: ", null: "Not known: " };
    checks.replaceChildren(...answer.checks.map((one) => h("li", {}, `${marks[one.holds]}${one.sentence}`)));
    checked.hidden = answer.checks.length + answer.notes.length === 0;
    checks.hidden = answer.checks.length === 0;
    state.setResult("curve", answer);
    draw();
  }

  async function solve() {
    running?.abort();
    const mine = new AbortController();
    running = mine;
    const begun = performance.now();
    bar.start("Solving");
    failed.set([]);
    try {
      const answer = await api.runJob("curve", { study: state.study, options: {} }, {
        signal: mine.signal,
        onPart: (part) => running === mine && take(part),
        onProgress: ({ done, total, label }) => running === mine && bar.set(Math.round(done), total, label),
      });
      if (running !== mine) return;
      finish(answer);
      const seconds = (performance.now() - begun) / 1000;
      bar.finish(`${answer.speed.length} points in ${units.plainNumber(seconds, 2)} s`);
      announce(`The friction curve is there, ${answer.speed.length} points.`);
    } catch (error) {
      if (running !== mine) return;
      if (error.name === "AbortError") bar.finish("Cancelled.");
      else {
        bar.fail("");
        if (!fields.showError(error)) failed.set([error.message]);
        else failed.set(["The friction curve waits: something in the form is not right."]);
      }
    }
    if (running === mine) running = null;
  }

  state.subscribe(WATCHED, () => {
    clearTimeout(timer);
    timer = setTimeout(solve, RESTS);
  });
  units.subscribe(draw);
  document.addEventListener("themechange", draw);
  solve();

  return {
    card,
    get combination() {
      return combination;
    },
    /** Show where the live contact is on the curve. */
    mark(contact) {
      live = contact;
      draw();
    },
  };
}
