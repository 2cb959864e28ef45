"""A whole friction curve of a ball: wall and CPU time, failures, and how far the friction is off.

Usage: python benchmarks/contact/curve.py [--speeds 60] [--slowest 1e-2] [--decades 15]
       [--workers 2] [--accuracy 1e-3] [--check 6] [--json FILE]

A rubber of 40 modes over thirteen decades, E_inf/E0 = 1000, speeds over fifteen decades, through
`viscofric.predict_friction` as a user calls it.  `--check N` solves so many of the speeds again to a fifth of the
accuracy, outside the time that is measured; the largest difference is the true error.
"""

from __future__ import annotations

import argparse
import os
import resource
import sys
import time
from pathlib import Path
from typing import Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
sys.path.insert(0, str(Path(__file__).resolve().parent))
import measuring
import numpy as np
from problems import CURVE_BALL, CURVE_LOAD, CURVE_RUBBER, curve_speeds

import viscofric as vf

COLUMNS = (
    ("speeds", "speeds", "d"),
    ("wall s", "wall_seconds", ".2f"),
    ("CPU s", "seconds", ".2f"),
    ("failures", "failures", "d"),
    ("worst ±", "worst_estimate", ".1e"),
    ("worst error", "worst_error", ".1e"),
    ("checked", "checked", "d"),
)


def measure(
    count: int, slowest: float, decades: float, workers: int, accuracy: float, checks: int
) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """Predict the curve; a row of the table, and what each speed gave."""
    speeds = curve_speeds(slowest, decades, count)
    row: dict[str, Any] = {"case": f"{workers} process{'es' * (workers > 1)}", "speeds": count}
    wall, cpu = time.perf_counter(), _cpu_with_children()
    try:
        curves = vf.predict_friction(
            CURVE_RUBBER,
            CURVE_BALL,
            speeds=speeds,
            temperatures=CURVE_RUBBER.shift.reference,
            load=CURVE_LOAD,
            accuracy=accuracy,
            workers=workers,
        )
    except vf.ConvergenceError as error:
        return row | {"error": str(error)}, []
    row |= {"wall_seconds": time.perf_counter() - wall, "seconds": _cpu_with_children() - cpu, "failures": 0}
    relative = curves.viscoelastic_error / curves.viscoelastic
    row["worst_estimate"] = float(relative.max())
    points = [
        {"speed": float(speed), "friction": float(friction), "relative_error": float(error)}
        for speed, friction, error in zip(speeds, curves.viscoelastic, relative, strict=True)
    ]
    checked = np.unique(np.linspace(0, count - 1, checks).round().astype(int)) if checks else []
    for one in checked:
        points[one]["true_error"] = abs(points[one]["friction"] / _exact(float(speeds[one]), accuracy / 5.0) - 1.0)
    if len(checked):
        row |= {"worst_error": max(points[one]["true_error"] for one in checked), "checked": len(checked)}
    return row, points


def _cpu_with_children() -> float:
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def _exact(speed: float, accuracy: float) -> float:
    solution = vf.solve_steady(
        CURVE_RUBBER,
        CURVE_BALL,
        speed=speed,
        load=CURVE_LOAD,
        temperature=CURVE_RUBBER.shift.reference,
        accuracy=accuracy,
        finest=4096,
    )
    return solution.friction_coefficient


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--speeds", type=int, default=60)
    parser.add_argument("--slowest", type=float, default=1e-2, help="longest memory v τ_max/a0 at the slowest speed")
    parser.add_argument("--decades", type=float, default=15.0, help="that the speeds cover")
    parser.add_argument("--workers", type=int, default=2, help="processes")
    parser.add_argument("--accuracy", type=float, default=1e-3)
    parser.add_argument("--check", type=int, default=6, help="speeds that are solved again, more accurately")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    row, points = measure(
        options.speeds, options.slowest, options.decades, options.workers, options.accuracy, options.check
    )
    measuring.print_table("friction curve of a ball, 40 modes over thirteen decades", [row], COLUMNS)
    measuring.write_json(options.json, {"rows": [row], "points": points})


if __name__ == "__main__":
    main()
