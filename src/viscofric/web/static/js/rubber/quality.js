// Whether superposition holds, in figures: diagrams that no shift changes, distances of neighbours, E′ against E″.

import { signal } from "../reactive.js";
import { byTemperature, fewEnough, named, pick, synthetic } from "./made.js";

const DIAGRAMS = {
  van_gurp_palmen: [
    "van Gurp–Palmen",
    { label: "|E*|", kind: "modulus", log: true },
    { label: "loss angle δ", kind: "angle" },
  ],
  booij_thoone_palmen: [
    "tan δ against |E*|",
    { label: "|E*|", kind: "modulus", log: true },
    { label: "tan δ", log: true },
  ],
  cole_cole: [
    "E″ against E′",
    { label: "E′", kind: "modulus", log: true },
    { label: "E″", kind: "modulus", log: true },
  ],
  wicket: ["tan δ against E′", { label: "E′", kind: "modulus", log: true }, { label: "tan δ", log: true }],
};

/** van Gurp–Palmen and its like, distances of neighbours, and E′ against E″. */
export function qualityCards(app) {
  const { fields, figures } = app;
  const { h, card } = fields;
  const diagram = signal("van_gurp_palmen");
  const first = card("Validity of superposition");
  first.append(
    pick(
      {
        label: "Diagram",
        options: Object.entries(DIAGRAMS).map(([key, [title]]) => [key, title]),
        value: diagram.value,
        onChange: (value) => (diagram.value = value),
      },
      fields,
    ),
  );
  const points = figures.figure(first, {
    id: "superposition-diagram",
    title: "van Gurp–Palmen",
    x: {},
    y: {},
    traces: [],
  });
  const second = card("Distance of neighbouring isotherms");
  const distances = figures.figure(second, {
    id: "neighbour-distances",
    title: "Distance of neighbouring isotherms",
    caption: "In tan δ against |E*|, which no shift changes; bars: 95 % range of the noise.",
    x: { label: "temperature between them", kind: "temperature" },
    y: { label: "distance (decades)" },
    traces: [],
  });
  const third = card("Consistency of E′ and E″");
  const sentence = h("p", { class: "help" });
  const causal = figures.figure(third, {
    id: "kramers-kronig",
    title: "Kramers–Kronig",
    caption: "log₁₀ of each modulus computed from the other, over the measured one; open points at the ends are not evaluated.",
    x: { label: "reduced frequency α ω", kind: "angular_frequency", log: true },
    y: { label: "log₁₀ demanded/measured" },
    traces: [],
  });
  third.append(sentence);
  const draw = (result) => {
    const { check } = result;
    const [title, x, y] = DIAGRAMS[diagram.value];
    const curves = check.diagrams[diagram.value];
    const temperatures = curves.map((one) => one.temperature);
    points.update({
      of: result,
      title,
      x,
      y,
      temperatures,
      synthetic: synthetic(result, app),
      caption: `No shift along the frequency changes these points. ${byTemperature(temperatures, app)}`,
      traces: curves.map((one) => ({
        name: named(one.temperature, app),
        legend: fewEnough(temperatures),
        temperature: one.temperature,
        x: one.x,
        y: one.y,
        mode: "lines+markers",
        dash: "solid",
        symbol: "circle",
        size: 5,
        width: 1,
      })),
    });
    distances.update({
      of: result,
      synthetic: synthetic(result, app),
      traces: [
        {
          name: "distance",
          legend: false,
          mode: "markers",
          x: check.neighbours.map((pair) => (pair.colder + pair.warmer) / 2),
          y: check.neighbours.map((pair) => pair.distance),
          error: check.neighbours.map((pair) => pair.error95),
        },
      ],
      marks: [{ y: 0 }],
    });
    const found = check.kramers_kronig;
    third.hidden = !found;
    if (!found) return;
    sentence.textContent = found.sentence;
    const part = (key, name, symbol, colour, judged) => {
      const some = found.judged.map((one, at) => (Boolean(one) === judged ? at : -1)).filter((at) => at >= 0);
      return {
        name: judged ? name : `${name}, not evaluated`,
        legend: judged,
        group: name,
        mode: "markers",
        symbol,
        colour,
        open: !judged,
        size: 6,
        x: some.map((at) => found.angular_frequency[at]),
        y: some.map((at) => found[`${key}_deviation`][at]),
      };
    };
    causal.update({
      of: result,
      synthetic: synthetic(result, app),
      marks: [{ y: found.allowed, label: "allowed rms of E′" }, { y: -found.allowed }],
      traces: [true, false].flatMap((judged) => [
        part("storage", "E′ computed from E″", "square", "blue", judged),
        part("loss", "E″ computed from E′", "circle", "vermilion", judged),
      ]),
    });
  };
  return {
    cards: [first, second, third],
    show(result) {
      for (const one of [first, second, third]) one.hidden = !result?.check?.diagrams;
      if (result?.check?.diagrams) draw(result);
    },
  };
}
