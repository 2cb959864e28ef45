"""Cost of one steady contact of a ball on a given grid, counted in FFT pairs of its padded window.

Usage: python benchmarks/contact/ball.py [--cells 1024] [--tolerance 1e-8] [--memory 1e-4 1 1e4 …] [--json FILE]
       python benchmarks/contact/ball.py --accuracy 1e-2 1e-3 1e-4 1e-5 [--speeds 16] [--finest 2048] [--json FILE]

A rubber of 37 modes over twelve decades, E_inf/E0 = 1000; `--memory` gives the longest memory v τ_max/a0, that is the
speed.  For each: products with the influence matrix on the finest grid and on all, CPU seconds of the whole solution
(window search, influence coefficients and all nested grids included), and the same in pairs of real FFTs (forward and
inverse, SciPy, one thread) of the finest window, padded, which are timed in the same run.

With `--accuracy`: CPU seconds against the accuracy of the friction, of a ball on 40 modes over twelve decades,
E_inf/E0 = 1000, at speeds over fifteen decades: the median and the most of those solved, how many accuracies were
refused, and the cells of the finest grid, the median.  Of two rubbers: one whose modes grow with their times, with
tan δ up to 1, and one of equal compliances, with tan δ up to 4.3.  The fastest of three runs where one takes less
than a second.
"""

from __future__ import annotations

import argparse
import os
import sys
from functools import partial
from pathlib import Path
from typing import Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
sys.path.insert(0, str(Path(__file__).resolve().parent))
import measuring
import numpy as np
import problems  # noqa: F401 - finds the tests' gallery

import viscofric as vf
from gallery import BALL_RADIUS, HERTZ_RADIUS, LOAD, POISSON_RATIO, RUBBER_MODULUS, broad_spectrum_37

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


BY_ACCURACY = (
    ("solved", "solved", "d"),
    ("refused", "refused", "d"),
    ("CPU ms, median", "median", ".1f"),
    ("most", "most", ".0f"),
    ("cells, median", "cells", ".0f"),
    ("stated error, most", "stated", ".1e"),
)


def modes(powers: tuple[float, float]) -> vf.RetardationSpectrum:
    """Return 40 modes whose compliances grow with these powers of their times, below and above 1e-4 s."""
    tau = 1e4 * np.logspace(-12.0, 0.0, 40)
    C = (tau / 1e-4) ** np.where(tau < 1e-4, *powers)
    return vf.RetardationSpectrum(
        RUBBER_MODULUS, 1e3 * RUBBER_MODULUS, C * (1.0 - 1e-3) / RUBBER_MODULUS / C.sum(), tau
    )


RUBBERS = {"tan δ up to 1": modes((0.6, 0.08)), "equal modes": modes((0.0, 0.0))}


def by_accuracy(name: str, accuracy: float, speeds: int, finest: int) -> dict[str, Any]:
    """Return what contacts at speeds from the rubbery to the glassy flank take at an accuracy."""
    rubber = vf.Material(RUBBERS[name], poisson_ratio=POISSON_RATIO)
    ball, took, cells, errors = vf.Ball(radius=BALL_RADIUS), [], [], []
    for memory in np.logspace(-2.0, 13.0, speeds):
        speed = memory * HERTZ_RADIUS / rubber.spectrum.tau.max()
        solve = partial(vf.solve_steady, rubber, ball, speed=speed, load=LOAD, accuracy=accuracy, finest=finest)
        runs: list[float] = []
        try:
            while len(runs) < (1 if runs and runs[0] > 1.0 else 3):
                solution, seconds = measuring.cpu_seconds(solve)
                runs.append(seconds)
        except vf.ConvergenceError:
            continue
        took.append(1e3 * min(runs))
        cells.append(max(solution.diagnostics.shape))
        errors.append(solution.diagnostics.friction_error / solution.friction_coefficient)
    return {
        "case": f"{name}, accuracy {accuracy:g}",
        "solved": len(took),
        "refused": speeds - len(took),
        "median": float(np.median(took)),
        "most": max(took),
        "cells": float(np.median(cells)),
        "stated": max(errors),
    }


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, default=1024, help="along the window's longer edge")
    parser.add_argument("--tolerance", type=float, default=1e-8)
    parser.add_argument("--memory", type=float, nargs="+", default=list(MEMORY), help="longest memory v τ_max/a0")
    parser.add_argument("--accuracy", type=float, nargs="+", help="CPU time against these, instead")
    parser.add_argument("--speeds", type=int, default=16, help="with --accuracy")
    parser.add_argument("--finest", type=int, default=2048, help="with --accuracy: most cells along the longer edge")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    broad_spectrum_37(1.0).solve(accuracy=1e-2)  # imports and caches
    if options.accuracy:
        rows = [
            by_accuracy(name, accuracy, options.speeds, options.finest)
            for name in RUBBERS
            for accuracy in options.accuracy
        ]
        measuring.print_table("ball, 40 modes over twelve decades", rows, BY_ACCURACY)
        measuring.write_json(options.json, {"rows": rows})
        return
    rows = [measure(memory, options.cells, options.tolerance) for memory in options.memory]
    measuring.print_table("ball, 37 modes over twelve decades", rows, COLUMNS)
    measuring.write_json(options.json, {"rows": rows})


if __name__ == "__main__":
    main()
