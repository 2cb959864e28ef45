"""How soon the page shows something in Chromium: first figure, whole curve, draft behind a slider; and its size.

Run with ``python benchmarks/web/page.py``; it needs what tests of the page need (``pip install -e .[dev]``, Chromium).
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))

from web.browser_tab import chromium_path, launched
from web.browser_tab import tab as opened_tab
from web.served_page import started

#: What is asked of two cores that have nothing else to do.
LIMITS = {"first figure (s)": 2.5, "whole curve (s)": 8.0, "draft behind a slider (s)": 0.15, "page (kB)": 700.0}
_BUSY = """
import os, time
os.nice(5)  # as the page's processes that compute
wall, own = time.perf_counter(), time.process_time()
while time.process_time() - own < 0.5:
    pass
print((time.perf_counter() - wall) / 0.5)
"""
_SEEN = "[...document.querySelectorAll('.figure .plot')].some((one) => one.data?.some(({ x }) => x?.length > 1))"
_WHOLE = "page.jobs.result('curve') !== null && page.figures.areDrawn()"
#: Seconds from each move of the speed's slider to the draft drawn in all figures in sight.
_MOVES = """await (async (places) => {
  const { jobs, figures, reactive } = page;
  const slider = document.getElementById("live-speed");
  const taken = [];
  slider.scrollIntoView({ block: "start" }); // two figures below it are in sight
  for (const place of places) {
    const [before, begun] = [jobs.newest("contact"), performance.now()];
    let end = () => {};
    const came = new Promise((done) => {
      end = reactive.effect(() => void (jobs.newest("contact") !== before && done()));
    });
    slider.value = String(place);
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    await came;
    end();
    await new Promise(requestAnimationFrame);
    while (!figures.areDrawn(figures.inSight)) await new Promise((done) => setTimeout(done));
    taken.push((performance.now() - begun) / 1000);
  }
  return taken;
})(given)"""


def contention() -> float:
    """Return how many times longer than their own work two busy processes take: 1 where nobody else computes."""
    both = [subprocess.Popen([sys.executable, "-c", _BUSY], stdout=subprocess.PIPE, text=True) for _ in range(2)]
    return max(float(one.communicate()[0]) for one in both)


def measure(path: str) -> dict[str, Any]:
    """Open the page of a program that was just started, and measure once.

    Parameters
    ----------
    path : str
        Of Chromium.

    Returns
    -------
    dict
        As `LIMITS`, and ``contention`` before it began.
    """
    busy = contention()
    with (
        tempfile.TemporaryDirectory() as folder,
        started(Path(folder)) as server,
        launched(path) as browser,
        opened_tab(browser, server) as tab,
    ):
        tab.until(_SEEN, 120.0)
        first = tab.value("performance.now() / 1000")  # since the tab was opened
        tab.until(_WHOLE, 180.0)
        whole = tab.value("performance.now() / 1000")
        tab.until("page.jobs.result('contact') !== null", 60.0)
        drafts = tab.value(_MOVES, *range(120, 288, 7))
        for step in ("sweeps", "shift", "spectrum", "motion", "measurement", "export"):
            tab.step(step)
        size = sum(bytes_ for address, bytes_ in tab.requested if not address.startswith("/api/jobs/"))
    found = (first, whole, statistics.median(drafts), size / 1e3)
    return dict(zip(LIMITS, found, strict=True)) | {"contention": busy}


def main() -> None:
    """Measure several times, and print the best of each with its limit."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=3, help="starts of the program; the best of each number counts")
    parser.add_argument("--json", type=Path, help="also write all numbers here")
    options = parser.parse_args()
    path = chromium_path()
    if path is None:
        sys.exit("no Chromium is on the path")
    runs = [measure(path) for _ in range(options.repeats)]
    load = os.getloadavg() if hasattr(os, "getloadavg") else ()
    busiest = ", ".join(f"{one['contention']:.2f}" for one in runs)
    print(f"load {' '.join(f'{one:.1f}' for one in load)}; two busy processes take {busiest} times their own time")
    for name, limit in LIMITS.items():
        all_of = ", ".join(f"{one[name]:.3g}" for one in runs)
        print(f"{name:<28} {min(one[name] for one in runs):8.3g}   limit {limit:g}   all: {all_of}")
    if options.json:
        options.json.write_text(json.dumps({"load": load, "runs": runs}, indent=2))


if __name__ == "__main__":
    main()
