// What a visitor reads first.

/** What the page is for, what it shows, and where one's own data go; short once they are there. */
export function welcome({ state, start, fields, goTo }) {
  const { h, button } = fields;
  const first = h(
    "section",
    { class: "welcome", "aria-label": "What this page does" },
    h(
      "p",
      {},
      h("strong", {}, "Hysteresis friction (rolling resistance) from DMA data. "),
      "Sliding or rolling deforms rubber, and the dissipated energy causes friction. This page computes it from DMA data ",
      "alone. The example is a synthetic material: change shape, load, speed or temperature, and the result updates.",
    ),
    h(
      "div",
      { class: "row" },
      button({
        label: "Use my DMA file",
        kind: "main",
        onClick: () => {
          state.setResult("wanted-source", "dma");
          goTo("sweeps");
        },
      }),
      button({ label: "Compare with my friction test", onClick: () => goTo("measurement") }),
      h("span", { class: "help" }, "Your files stay on this computer."),
    ),
  );
  const later = h("p", {}, "Change shape, load, speed or temperature, and the friction is computed again.");
  const show = () => {
    const name = state.get("material.catalogue");
    first.hidden = name === undefined || name !== start.study.material?.catalogue;
    later.hidden = !first.hidden;
  };
  state.subscribe("material", show);
  show();
  return h("div", { class: "intro" }, first, later);
}
