"""Whether errors by the contact conditions of periodic surfaces are within the tolerance that is stated for them.

Usage: python benchmarks/motion/contact_tolerance.py [--count 48] [--first 0] [--accuracy 1e-3 3e-2] [--double]

Materials, ridges and small rough surfaces of `stated_errors.py`, under a pressure or a gap that changes linearly, or
does not, along straight and turning paths, from an untouched body, from rest or from steady sliding.  Each history is
taken in 48 even steps, and again in the same steps with a twentieth of the tolerance; `--double` also keeps the memory
of these in double precision, so that errors by rounding count.  Errors are relative to the largest value so far, as
those that are stated; the friction is that along x or y with the larger error.
"""

from __future__ import annotations

import argparse
import itertools
import math
import time
from typing import Any

import numpy as np
import stated_errors
from stated_errors import DURATION, PERIODIC, measuring

import viscofric as vf
from viscofric.motion.mover import Problem
from viscofric.motion.periodic import PeriodicMover

STEPS, TURNS = 48, 8
FINER = 0.05
QUANTITIES = ("load", "indentation", "friction", "stored", "dissipated")
COLUMNS = (
    ("states", "states", "d"),
    ("within", "within", ".4f"),
    ("histories within", "histories", ".3f"),
    ("error/tolerance, median", "median", ".3f"),
    ("99 %", "most", ".2f"),
    ("worst", "worst", ".2f"),
)


def draw(number: int, accuracy: tuple[float, float]) -> tuple[str, vf.Material, Any, vf.motion.History, float]:
    """Return name, material, surface, history and accuracy of one of the random problems."""
    rng, kind = np.random.default_rng([6, number]), PERIODIC[number % len(PERIODIC)]
    material, rubber = stated_errors._material(rng)
    surface, pressure, length, _ = stated_errors._body(kind, rng)
    times = np.linspace(0.0, DURATION, TURNS + 1)
    control, size = ("pressure", pressure) if rng.uniform() < 0.6 else ("gap", float(surface.z.std()))
    values = size * np.interp(times, [0.0, 0.5 * DURATION, DURATION], rng.uniform(0.3, 1.0, 3))
    if rng.uniform() < 0.5:
        values[:] = values[0]
    speed = length * rng.uniform(0.3, 2.0) / DURATION
    path, start = "straight", 2.0 * np.pi * rng.uniform()
    angles = np.full(TURNS + 1, start if rng.uniform() < 0.5 else 0.0)
    if rng.uniform() < 0.5:
        path, angles = "turning", start + rng.uniform(1.0, 6.0) * times / DURATION
    before = str(rng.choice(vf.motion.history.BEFORE))
    speeds = speed * np.stack([np.cos(angles), np.sin(angles)], 1)
    history = vf.motion.History(times, **{control: values}, speed=speeds, temperature=300.0, before=before)
    asked = math.exp(rng.uniform(*map(math.log, accuracy)))
    return f"{number}: {kind}, {path}, {control}, {before}, {rubber}, {asked:.1e}", material, surface, history, asked


def marched(mover: PeriodicMover) -> np.ndarray:
    """Return load, depth, friction along x and y, and energies after each step, (STEPS, 6)."""
    schedule, state, found = mover.schedule, mover.begin(), []
    if schedule.before == "untouched":
        state = mover.step(state, schedule.at(0.0), schedule.at(0.0))
    for start, end in itertools.pairwise((DURATION * np.arange(STEPS + 1) / STEPS).tolist()):
        state = mover.step(state, schedule.at(start), schedule.at(end, after=False), keep=False)
        seen = mover.observe(state)
        found.append([seen.load, seen.depth, *seen.friction_force, seen.stored, seen.dissipated])
    return np.array(found)


def ratios(problem: Problem, double: bool) -> dict[str, np.ndarray]:
    """Return the errors of each quantity over the tolerance, after each step; none of what is prescribed."""
    mover, finer = PeriodicMover(problem), PeriodicMover(problem)
    finer._tightness *= FINER
    if double:
        finer.precision = np.complex128
    found, true = marched(mover), marched(finer)
    scales = mover.scales
    so_far = np.maximum.accumulate(np.abs(true), axis=0)
    friction = np.maximum.accumulate(np.hypot(true[:, 2], true[:, 3]))
    energy = np.maximum(so_far[:, 4:].max(1), scales.energy)
    sizes = {
        "load": np.maximum(so_far[:, 0], scales.load),
        "indentation": np.maximum(so_far[:, 1], scales.depth),
        "friction": np.maximum(friction, scales.friction),
        "stored": energy,
        "dissipated": energy,
    }
    apart = np.abs(found - true)
    errors = dict(zip(QUANTITIES, [apart[:, 0], apart[:, 1], apart[:, 2:4].max(1), *apart[:, 4:].T], strict=True))
    given = "load" if problem.schedule.control == "pressure" else "indentation"
    return {name: error / sizes[name] / mover.tolerance for name, error in errors.items() if name != given}


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=48)
    parser.add_argument("--first", type=int, default=0, help="number of the first random history")
    parser.add_argument("--accuracy", type=float, nargs=2, default=(1e-3, 3e-2), help="least and largest")
    parser.add_argument("--double", action="store_true", help="memory of the finer solution in double precision")
    options = parser.parse_args(arguments)
    found: dict[str, list[np.ndarray]] = {name: [] for name in QUANTITIES}
    begun = time.process_time()
    for number in range(options.first, options.first + options.count):
        name, material, surface, history, accuracy = draw(number, tuple(options.accuracy))
        problem = Problem(material, surface, history.schedule(material, "periodic"), accuracy, None, 0.0)
        for quantity, each in ratios(problem, options.double).items():
            found[quantity].append(each)
            if each.max() > 1.0:
                count = int(np.sum(each > 1.0))
                print(f"{name}: {quantity} {each.max():.2f} times the tolerance, {count} states above it", flush=True)
    table = []
    for quantity, those in found.items():
        if those:
            every = np.concatenate(those)
            table.append(
                {
                    "case": quantity,
                    "states": len(every),
                    "within": float(np.mean(every <= 1.0)),
                    "histories": float(np.mean([each.max() <= 1.0 for each in those])),
                    "median": float(np.median(every)),
                    "most": float(np.quantile(every, 0.99)),
                    "worst": float(every.max()),
                }
            )
    measuring.print_table(f"errors by contact conditions, {options.count} histories", table, COLUMNS)
    print(f"CPU s: {time.process_time() - begun:.0f}")


if __name__ == "__main__":
    main()
