// Whether superposition holds, in figures: diagrams that no shift changes, distances of neighbours, E′ against E″.

import { Figure } from "../figures.js";
import { html, signal, view } from "../reactive.js";
import { Card, Pick } from "../views.js";
import { byTemperature, isothermTraces, synthetic } from "./made.js";

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

const TITLES = Object.entries(DIAGRAMS).map(([key, [title]]) => [key, title]);
const diagram = signal("van_gurp_palmen");

function causalTraces(found) {
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
  return [true, false].flatMap((judged) => [
    part("storage", "E′ computed from E″", "square", "blue", judged),
    part("loss", "E″ computed from E′", "circle", "vermilion", judged),
  ]);
}

/** van Gurp–Palmen and its like, distances of neighbours, and E′ against E″. */
export const Quality = view(({ of }) => {
  const { check } = of;
  const [title, x, y] = DIAGRAMS[diagram.value];
  const curves = check.diagrams[diagram.value];
  const temperatures = curves.map((one) => one.temperature);
  const traces = isothermTraces(curves, ({ x, y }) => ({ x, y, width: 1 }));
  const pairs = {
    name: "distance",
    legend: false,
    mode: "markers",
    x: check.neighbours.map((pair) => (pair.colder + pair.warmer) / 2),
    y: check.neighbours.map((pair) => pair.distance),
    error: check.neighbours.map((pair) => pair.error95),
  };
  const causal = check.kramers_kronig;
  const shared = { of, synthetic: synthetic(of) };
  return html`
    <${Card} title="Validity of superposition">
      <${Pick} label="Diagram" options=${TITLES} value=${diagram.value} onChange=${(key) => (diagram.value = key)} />
      <${Figure} id="superposition-diagram" ...${{ ...shared, title, x, y, temperatures, traces }}
        caption="No shift along the frequency changes these points. ${byTemperature(temperatures)}" />
    <//>
    <${Card} title="Distance of neighbouring isotherms">
      <${Figure} id="neighbour-distances" title="Distance of neighbouring isotherms" ...${shared}
        caption="In tan δ against |E*|, which no shift changes; bars: 95 % range of the noise."
        x=${{ label: "temperature between them", kind: "temperature" }} y=${{ label: "distance (decades)" }}
        marks=${[{ y: 0 }]} traces=${[pairs]} />
    <//>
    ${
      causal &&
      html`<${Card} title="Consistency of E′ and E″">
        <${Figure} id="kramers-kronig" title="Kramers–Kronig" ...${shared} traces=${causalTraces(causal)}
          caption="log₁₀ of each modulus computed from the other, over the measured one; open points at the ends are not evaluated."
          x=${{ label: "reduced frequency α {omega}", kind: "angular_frequency", log: true }} y=${{ label: "log₁₀ demanded/measured" }}
          marks=${[{ y: causal.allowed, label: "allowed rms of E′" }, { y: -causal.allowed }]} />
        <p class="help">${causal.sentence}</p>
      <//>`
    }
  `;
});
