"""What contacts of each kind take: processor time and cells, over speeds and temperatures of a fluoroelastomer.

Usage: python benchmarks/study/costs.py [--speeds 6] [--json FILE]

Estimates of what a study takes (`viscofric.study.cases.estimates`) rest on it.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from pathlib import Path
from typing import Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "contact"))
import measuring
import numpy as np

import viscofric as vf
from viscofric.friction.cases.indenter_case import IndenterCase
from viscofric.friction.cases.solving import Task, solve
from viscofric.friction.planning.plan import Plan

COLUMNS = (
    ("accuracy", "accuracy", ".0e"),
    ("mean CPU s", "mean", ".3f"),
    ("median", "median", ".3f"),
    ("most", "most", ".2f"),
    ("most cells", "cells", "d"),
    ("failures", "failures", "d"),
)
RUBBER, TEMPERATURES = vf.synthetic_fluoroelastomer(), (303.15, 363.15)
BALL = vf.Ball("9.525 mm")
KINDS: dict[str, dict[str, Any]] = {
    "ball": {"indenter": BALL, "load": 1.0},
    "cone": {"indenter": vf.Cone(0.1), "load": 1.0},
    "cylinder": {"indenter": vf.Cylinder(0.01), "load": 300.0},
    "layer of 2 mm": {"indenter": BALL, "load": 1.0, "layer": vf.Layer("2 mm")},
    "ball, with sensitivity": {"indenter": BALL, "load": 1.0, "sensitive": True},
}


def measure(name: str, accuracy: float, speeds: int) -> dict[str, Any]:
    """Solve contacts of one kind; a row of the table."""
    kind = dict(KINDS[name])
    sensitive = kind.pop("sensitive", False)
    cases = [
        IndenterCase(0, temperature=temperature, speed=float(speed), **kind)
        for temperature in TEMPERATURES
        for speed in np.geomspace(1e-4, 1.0, speeds)
    ]
    tasks = Plan(cases, [RUBBER], accuracy=accuracy, sensitive=sensitive, each=True).wanted()
    seconds, cells = zip(*(_timed(task) for task in tasks), strict=True)
    return {
        "case": name,
        "accuracy": accuracy,
        "mean": float(np.mean(seconds)),
        "median": float(np.median(seconds)),
        "most": max(seconds),
        "cells": max(cells),
        "failures": sum(not count for count in cells),
    }


def _timed(task: Task) -> tuple[float, int]:
    """CPU seconds and cells; none where it failed."""
    start = time.process_time()
    try:
        cells = solve(task).cells
    except vf.ConvergenceError:
        cells = 0
    return time.process_time() - start, cells


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--speeds", type=int, default=6)
    parser.add_argument("--accuracies", type=float, nargs="+", default=[1e-2, 1e-3, 3e-4])
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    rows = [measure(name, accuracy, options.speeds) for name in KINDS for accuracy in options.accuracies]
    measuring.print_table("contacts on the synthetic fluoroelastomer", rows, COLUMNS)
    measuring.write_json(options.json, {"rows": rows})


if __name__ == "__main__":
    main()
