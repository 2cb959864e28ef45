"""Normal motion of a ball: seconds of an impact and of indentation histories, and their energy balance.

Usage: python benchmarks/motion/normal.py [--repeats 5] [--json FILE]

A ball of 10 mm on a solid with one mode, and on the synthetic fluoroelastomer (37 modes) at 0 °C.  CPU seconds of this
process, the least of the repeats.
"""

from __future__ import annotations

import argparse
import json
import os
import time
from pathlib import Path
from typing import Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
from collections.abc import Callable

import numpy as np

import viscofric as vf

BALL = vf.Ball("10 mm")


def cases() -> dict[str, Callable[[], Any]]:
    solid = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    rubber = vf.synthetic_fluoroelastomer()
    cold = {"temperature": "0 degC"}
    time_ = np.linspace(0.0, 0.06, 361)
    sine = vf.motion.History(time_, load=1.0 + 0.5 * np.sin(100.0 * np.pi * time_), before="at rest")
    triangle = {"time": [0.0, 0.02, 0.04, 0.1], "load": [0.0, 1.0, 0.0, 0.0]}
    return {
        "impact, one mode": lambda: vf.motion.solve_impact(solid, BALL, mass=0.033, speed=0.1).run,
        "impact, 37 modes": lambda: vf.motion.solve_impact(rubber, BALL, mass=0.033, speed=1.0, **cold).run,
        "load triangle, one mode": lambda: vf.motion.solve_transient(solid, BALL, vf.motion.History(**triangle)),
        "load triangle, 37 modes": lambda: vf.motion.solve_transient(
            rubber, BALL, vf.motion.History(**triangle, **cold)
        ),
        "three cycles of 120 points, one mode": lambda: vf.motion.solve_transient(solid, BALL, sine),
    }


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--json", type=Path)
    asked = parser.parse_args(arguments)
    rows = []
    for name, solve in cases().items():
        spent = []
        for _ in range(asked.repeats + 1):  # the first call imports
            began = time.process_time()
            run = solve()
            spent.append(time.process_time() - began)
        least = min(spent[1:])
        rows.append({"case": name, "cpu_s": least, "steps": run.steps, "imbalance": run.energy_imbalance})
        print(f"{name:38} {1e3 * least:8.1f} ms  {run.steps:5d} steps  energy imbalance {run.energy_imbalance:.1e}")
    if asked.json:
        asked.json.parent.mkdir(parents=True, exist_ok=True)
        asked.json.write_text(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main()
