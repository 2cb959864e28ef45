"""Periods marched to the periodic state, and periods waited for it.

Usage: python benchmarks/motion/cycles.py [--cases NAME ...]

Each case is solved by `solve_cycle`, and by `solve_transient` through many periods.  Waiting ends with the first period
from which on the dissipated energy and the depth (where that is given: the load) at its end are those of the periodic
state to the accuracy.
CPU seconds of this process; those of waiting are the part of the periods that were needed.
"""

from __future__ import annotations

import argparse
import os
import time
from typing import Any, NamedTuple

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
import numpy as np

import viscofric as vf

BALL = vf.Ball("10 mm")


class Case(NamedTuple):
    """A repeated history, and the most periods to wait."""

    material: vf.Material
    body: Any
    given: dict[str, Any]
    accuracy: float
    most: int


def sine(points: int) -> np.ndarray:
    wave = np.sin(2.0 * np.pi * np.arange(points + 1) / points)
    wave[-1] = 0.0
    return wave


def cases() -> dict[str, Case]:
    solid = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")
    slow = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="0.1 s")
    rubber, x = vf.synthetic_fluoroelastomer(), 2.0 * np.pi * np.arange(64) / 64
    ridges = vf.contact.PeriodicSurface(1e-6 * (np.cos(x) + 0.3 * np.cos(2.0 * x + 1.0)), 1e-3 / 64)
    short, long, quick = 2.0 * np.pi * np.arange(25) / 2400, 2.0 * np.pi * np.arange(49) / 4800, np.arange(25) / 2400
    fine = 2.0 * np.pi * np.arange(97) / 9600
    warm, cold = {"temperature": "30 degC"}, {"temperature": "0 degC"}
    return {
        "ball, depth by 3 %, one mode": Case(
            solid, BALL, {"time": short, "indentation": 1e-4 + 3e-6 * sine(24)}, 1e-3, 20
        ),
        "ball, depth by 2 %, fluoroelastomer at 0 °C, 100 Hz": Case(
            rubber, BALL, {"time": quick, "indentation": 1e-4 + 2e-6 * sine(24), **cold}, 1e-3, 60
        ),
        "ball, load by 30 %, fluoroelastomer at 30 °C, 16 Hz": Case(
            rubber, BALL, {"time": short, "load": 1.0 + 0.3 * sine(24), **warm}, 1e-3, 60
        ),
        "ball, load by 30 %, fluoroelastomer at 0 °C, 100 Hz": Case(
            rubber, BALL, {"time": quick, "load": 1.0 + 0.3 * sine(24), **cold}, 1e-3, 60
        ),
        "ridges there and back, one mode, ωτ = 10": Case(
            slow, ridges, {"time": long, "pressure": 3e3, "position": 4e-4 * sine(48)}, 5e-3, 25
        ),
        "ball there and back on cells, one mode": Case(
            solid, BALL, {"time": fine, "load": 1.0, "position": 1.8e-3 * sine(96)}, 1e-1, 4
        ),
        "ball there and back on cells, fluoroelastomer": Case(
            rubber, BALL, {"time": fine, "load": 0.1, "position": 1e-3 * sine(96), "temperature": "20 degC"}, 1e-1, 4
        ),
    }  # fmt: skip


def waited(case: Case, cycle: vf.motion.CycleSolution) -> tuple[int | None, float]:
    """Return the periods after which the periodic state is reached, and CPU seconds for all of them."""
    given, count = dict(case.given), case.most
    one = np.asarray(given.pop("time"))
    repeated = {"time": np.append(np.add.outer(one[-1] * np.arange(count), one[:-1]).ravel(), count * one[-1])}
    for name, values in given.items():
        whole = np.ndim(values) == 0
        repeated[name] = values if whole else np.append(np.tile(values[:-1], count), values[-1])
    begun = time.process_time()
    history = vf.motion.History(**repeated, before="at rest")
    run = vf.motion.solve_transient(
        case.material, case.body, history, times=one[-1] * np.arange(count + 1), accuracy=case.accuracy
    )
    spent = time.process_time() - begun
    name = "load" if "indentation" in given else "indentation"
    energies, ends = np.diff(run.dissipated), getattr(run, name)[1:]
    size = float(np.abs(getattr(cycle.run, name)).max())
    off = np.abs(energies - cycle.energy_per_cycle) > case.accuracy * cycle.energy_per_cycle
    off |= np.abs(ends - getattr(cycle.run, name)[-1]) > case.accuracy * size
    last = int(np.flatnonzero(off)[-1]) + 2 if off.any() else 1
    return (None if last > count else last), spent


def main(arguments: list[str] | None = None) -> None:
    every = cases()
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cases", nargs="+", default=list(every), help="beginnings of names")
    options = parser.parse_args(arguments)
    print("| case | marched | CPU s | waited | CPU s |\n| --- | --- | --- | --- | --- |")
    for name, case in every.items():
        if not name.startswith(tuple(options.cases)):
            continue
        begun = time.process_time()
        cycle = vf.motion.solve_cycle(
            case.material, case.body, vf.motion.History(**case.given, before="at rest"), accuracy=case.accuracy
        )
        spent = time.process_time() - begun
        count, whole = waited(case, cycle)
        found = f"more than {case.most}" if count is None else str(count)
        part = 1.0 if count is None else count / case.most
        print(f"| {name} | {cycle.periods} | {spent:.2f} | {found} | {part * whole:.2f} |", flush=True)


if __name__ == "__main__":
    main()
