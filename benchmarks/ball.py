"""Cost of one steady contact of a ball, counted in FFT pairs of the finest padded grid timed in the same run.

Usage: python benchmarks/ball.py [--accuracy 1e-3] [--json FILE]

For each case: cells of the finest grid, products with the influence matrix on all grids, CPU seconds, and the same
in pairs of real FFTs (forward and inverse, SciPy, one thread) of the finest padded window.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path

import numpy as np
import scipy.fft

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))
from gallery import BallProblem, broad_spectrum_25, broad_spectrum_37, standard_linear_solid

CASES = (
    standard_linear_solid(10.0, 0.1),
    standard_linear_solid(10.0, 1.0),
    standard_linear_solid(1000.0, 1.0),
    standard_linear_solid(1000.0, 100.0),
    broad_spectrum_25(1.0),
    broad_spectrum_25(1e6),
    broad_spectrum_37(1e4),
)


def seconds_per_pair(shape: tuple[int, int]) -> float:
    """CPU seconds for a forward and an inverse FFT of the padded window, the least of several."""
    padded = np.random.default_rng(0).random([scipy.fft.next_fast_len(2 * cells - 1, real=True) for cells in shape])
    times = []
    for _ in range(5):
        start = time.process_time()
        scipy.fft.irfft2(scipy.fft.rfft2(padded), padded.shape)
        times.append(time.process_time() - start)
    return min(times)


def measure(problem: BallProblem, accuracy: float) -> dict[str, float | str]:
    """Solve one case and count."""
    start = time.process_time()
    solution = problem.solve(accuracy=accuracy)
    seconds = time.process_time() - start
    diagnostics = solution.diagnostics
    return {
        "case": problem.name,
        "cells": max(diagnostics.shape),
        "products": diagnostics.products,
        "cpu_seconds": seconds,
        "fft_pairs": seconds / seconds_per_pair(diagnostics.shape),
        "friction": solution.friction_coefficient,
        "relative_error": diagnostics.friction_error / solution.friction_coefficient,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--accuracy", type=float, default=1e-3)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    standard_linear_solid(10.0, 1.0).solve(accuracy=1e-2)  # imports and caches
    rows = [measure(problem, options.accuracy) for problem in CASES]
    print(f"{'case':50} {'cells':>6} {'products':>9} {'CPU s':>7} {'FFT pairs':>10} {'error':>8}")
    for row in rows:
        print(
            f"{row['case']:50} {row['cells']:6} {row['products']:9} {row['cpu_seconds']:7.2f} "
            f"{row['fft_pairs']:10.0f} {row['relative_error']:8.0e}"
        )
    if options.json:
        options.json.parent.mkdir(parents=True, exist_ok=True)
        options.json.write_text(json.dumps(rows, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
