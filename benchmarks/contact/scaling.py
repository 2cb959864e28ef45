"""How time and memory of a contact grow with its grid: the ball, and rough surfaces, elastic and viscoelastic.

Usage: python benchmarks/contact/scaling.py [--sizes 256 512 1024 2048 4096] [--problems ball elastic …]
       [--memory-up-to 1024] [--json FILE]

"refined" is one contact on finer and finer grids, as the ball is.  The other surfaces keep eight points in their
shortest wave, so that each is rougher than the one before, and what slides over it meets waves of other frequencies.

CPU seconds of the whole solution, the least of three, or of five where it is quick, beside those of a pair of SciPy's
FFTs of the same size, timed in between.  Exponents, by least squares over the sizes up to this one: of the time in the
number of points; of the FFT alone; and of their ratio, which is what the method adds to the growth of the FFT.  Memory:
the most that all arrays took at any time, in real arrays of the padded window (ball) or of the grid (periodic, which is
not padded), from another, untimed solution under tracemalloc.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
from pathlib import Path
from typing import Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
sys.path.insert(0, str(Path(__file__).resolve().parent))
from collections.abc import Callable

import measuring
import problems

from gallery import broad_spectrum_37

MEMORY_LENGTH = 1e4  # v τ_max/a0 of the ball
LEAST_REPEATS, MOST_REPEATS, REPEATED = 3, 5, 4.0  # solutions of one size, and CPU s after which no more is added
SURFACES = {"": problems.rough_surface, ", refined": problems.refined_surface}
SOLIDS = {"elastic": problems.elastic_rough, "viscoelastic": problems.viscoelastic_rough}
COLUMNS = (
    ("points", "points", "d"),
    ("CPU s", "seconds", ".3f"),
    ("exponent", "exponent", ".2f"),
    ("of the FFT", "fft_exponent", ".2f"),
    ("FFT pairs", "fft_pairs", ".0f"),
    ("exponent", "ratio_exponent", ".2f"),
    ("peak, arrays", "arrays", ".1f"),
    ("peak, MB", "megabytes", ".0f"),
)


def work(name: str, points: int) -> Callable[[], tuple[int, ...]]:
    """Return what solves a problem with so many points along an edge, and gives the shape of its transforms."""
    if name == "ball":
        ball = broad_spectrum_37(MEMORY_LENGTH)
        return lambda: measuring.padded_shape(ball.solve(grid=points).diagnostics.shape)
    solid = name.partition(",")[0]
    surface, solve = SURFACES[name.removeprefix(solid)](points), SOLIDS[solid]
    return lambda: solve(surface).pressure.shape


def measure(name: str, sizes: list[int], memory_up_to: int) -> list[dict[str, Any]]:
    """Solve one problem in all sizes."""
    rows: list[dict[str, Any]] = []
    work(name, sizes[0])()  # imports and caches
    for points in sizes:
        shape, seconds, pair = timed(name, points)
        row: dict[str, Any] = {"case": name, "points": points, "seconds": seconds, "fft_seconds": pair}
        row["fft_pairs"] = seconds / pair
        rows.append(row)
        if len(rows) > 1:
            cells = [one["points"] ** 2 for one in rows]
            for exponent, times in (
                ("exponent", "seconds"),
                ("fft_exponent", "fft_seconds"),
                ("ratio_exponent", "fft_pairs"),
            ):
                row[exponent] = measuring.growth(cells, [one[times] for one in rows])
        if points <= memory_up_to:
            peak = measuring.peak_bytes(work(name, points))[1]
            row |= {"arrays": peak / (8.0 * math.prod(shape)), "megabytes": peak / 1e6}
        print(f"{name}, {points}: {seconds:.3g} s", file=sys.stderr, flush=True)
    return rows


def timed(name: str, points: int) -> tuple[tuple[int, ...], float, float]:
    """Return the shape of the transforms, and the least CPU seconds of a solution and of a pair of FFTs."""
    seconds, pairs, spent = [], [], 0.0
    while len(seconds) < (MOST_REPEATS if spent < REPEATED else LEAST_REPEATS):
        shape, once = measuring.cpu_seconds(work(name, points))
        seconds.append(once)
        pairs.append(measuring.seconds_per_pair(shape))
        spent += once
    return shape, min(seconds), min(pairs)


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=int, nargs="+", default=[256, 512, 1024, 2048, 4096], help="along an edge")
    names = ["ball", *(solid + kind for kind in SURFACES for solid in SOLIDS)]
    parser.add_argument("--problems", nargs="+", choices=names, default=names)
    parser.add_argument("--memory-up-to", type=int, default=1024, help="points along an edge; 0: not at all")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    rows = []
    for name in options.problems:
        rows += measure(name, sorted(options.sizes), options.memory_up_to)
    measuring.print_table("growth of time and memory", rows, COLUMNS)
    measuring.write_json(options.json, {"rows": rows})


if __name__ == "__main__":
    main()
