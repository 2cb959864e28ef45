"""How time and memory of a contact grow with its grid: the ball, and rough surfaces, elastic and viscoelastic.

Usage: python benchmarks/contact/scaling.py [--sizes 256 512 1024 2048] [--problems ball elastic viscoelastic]
       [--without-memory] [--json FILE]

CPU seconds of the whole solution; `exponent` of the time in the number of points, by least squares over the sizes up to
this one.  Memory: the most that all arrays took at any time, in real arrays of the padded window (ball) or of the grid
(periodic, which is not padded), from a second, untimed solution under tracemalloc.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parent))
import measuring
import problems

from gallery import broad_spectrum_37

if TYPE_CHECKING:
    from collections.abc import Callable

MEMORY_LENGTH = 1e4  # v τ_max/a0 of the ball
COLUMNS = (
    ("points", "points", "d"),
    ("CPU s", "seconds", ".3f"),
    ("exponent", "exponent", ".2f"),
    ("FFT pairs", "fft_pairs", ".0f"),
    ("peak, arrays", "arrays", ".1f"),
    ("peak, MB", "megabytes", ".0f"),
)


def work(name: str, points: int) -> Callable[[], tuple[int, ...]]:
    """Return what solves a problem with so many points along an edge, and gives the shape of its transforms."""
    if name == "ball":
        ball = broad_spectrum_37(MEMORY_LENGTH)
        return lambda: measuring.padded_shape(ball.solve(grid=points).diagnostics.shape)
    surface = problems.rough_surface(points)
    solve = problems.elastic_rough if name == "elastic" else problems.viscoelastic_rough
    return lambda: solve(surface).pressure.shape


def measure(name: str, sizes: list[int], *, memory: bool) -> list[dict[str, Any]]:
    """Solve one problem in all sizes."""
    rows: list[dict[str, Any]] = []
    work(name, sizes[0])()  # imports and caches
    for points in sizes:
        shape, seconds = measuring.cpu_seconds(work(name, points))
        row: dict[str, Any] = {"case": name, "points": points, "seconds": seconds}
        row["fft_pairs"] = seconds / measuring.seconds_per_pair(shape)
        rows.append(row)
        if len(rows) > 1:
            row["exponent"] = measuring.growth([one["points"] ** 2 for one in rows], [one["seconds"] for one in rows])
        if memory:
            peak = measuring.peak_bytes(work(name, points))[1]
            row |= {"arrays": peak / (8.0 * math.prod(shape)), "megabytes": peak / 1e6}
    return rows


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=int, nargs="+", default=[256, 512, 1024, 2048], help="points along an edge")
    names = ["ball", "elastic", "viscoelastic"]
    parser.add_argument("--problems", nargs="+", choices=names, default=names)
    parser.add_argument("--without-memory", action="store_true")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    rows = []
    for name in options.problems:
        rows += measure(name, sorted(options.sizes), memory=not options.without_memory)
    measuring.print_table("growth of time and memory", rows, COLUMNS)
    measuring.write_json(options.json, {"rows": rows})


if __name__ == "__main__":
    main()
