"""Cost of one steady contact of a ball on a given grid, counted in FFT pairs of its padded window.

Usage: python benchmarks/contact/ball.py [--cells 1024] [--tolerance 1e-8] [--memory 1e-4 1 1e4 …] [--json FILE]

A rubber of 37 modes over twelve decades, E_inf/E0 = 1000; `--memory` gives the longest memory v τ_max/a0, that is the
speed.  For each: products with the influence matrix on the finest grid and on all, CPU seconds of the whole solution
(window search, influence coefficients and all nested grids included), and the same in pairs of real FFTs (forward and
inverse, SciPy, one thread) of the finest window, padded, which are timed in the same run.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
sys.path.insert(0, str(Path(__file__).resolve().parent))
import measuring
import problems  # noqa: F401 - finds the tests' gallery

from gallery import broad_spectrum_37

MEMORY = (1e-4, 1e-2, 1.0, 1e2, 1e3, 1e4, 1e6, 1e9)
COLUMNS = (
    ("cells", "cells", "d"),
    ("products, finest", "finest_products", "d"),
    ("products, all", "products", "d"),
    ("CPU s", "seconds", ".2f"),
    ("FFT pairs", "fft_pairs", ".0f"),
    ("residual", "residual", ".0e"),
    ("friction", "friction", ".4e"),
    ("±", "relative_error", ".0e"),
)


def measure(memory_length: float, cells: int, tolerance: float) -> dict[str, Any]:
    """Solve one case and count."""
    problem = broad_spectrum_37(memory_length)
    solution, seconds = measuring.cpu_seconds(lambda: problem.solve(grid=cells, tolerance=tolerance))
    diagnostics = solution.diagnostics
    pair = measuring.seconds_per_pair(measuring.padded_shape(diagnostics.shape))
    return {
        "case": f"vτ/a0 = {memory_length:g}",
        "cells": max(diagnostics.shape),
        "finest_products": diagnostics.levels[-1].products,
        "products": diagnostics.products,
        "seconds": seconds,
        "fft_pairs": seconds / pair,
        "seconds_per_pair": pair,
        "residual": diagnostics.complementarity,
        "friction": solution.friction_coefficient,
        "relative_error": diagnostics.friction_error / solution.friction_coefficient,
    }


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, default=1024, help="along the window's longer edge")
    parser.add_argument("--tolerance", type=float, default=1e-8)
    parser.add_argument("--memory", type=float, nargs="+", default=list(MEMORY), help="longest memory v τ_max/a0")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    broad_spectrum_37(1.0).solve(accuracy=1e-2)  # imports and caches
    rows = [measure(memory, options.cells, options.tolerance) for memory in options.memory]
    measuring.print_table("ball, 37 modes over twelve decades", rows, COLUMNS)
    measuring.write_json(options.json, {"rows": rows})


if __name__ == "__main__":
    main()
