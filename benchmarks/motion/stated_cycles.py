"""Whether the errors that periodic states state hold: random periods against solutions ten times as accurate.

Usage: python benchmarks/motion/stated_cycles.py [--count 48] [--first 0] [--accuracy 1e-3 1e-2] [--kinds ball cone ...]
       [--finer 0.1] [--seconds 300]

Materials and bodies of `stated_errors.py`.  A ball and a cone oscillate on springs, ridges slide back and forth or
oscillate on waves, a cylinder does so on cells.  Amplitudes from 0.5 % to 120 % of the mean (where a load would be
negative, it is zero), 12 to 48 points in a period.  An error counts as holding where the difference is no more than it
and the error that the finer solution states for itself; `strict` leaves the latter out.  With `--seconds` (not on
Windows) a problem is given up after this CPU time.
"""

from __future__ import annotations

import argparse
import math
import signal
import time
from typing import Any

import numpy as np
import stated_errors
from stated_errors import DURATION, PERIODIC, measuring

import viscofric as vf

KINDS = ("ball", "cone", "ridges", "cylinder")
NUMBERS = (
    "energy_per_cycle", "storage_stiffness", "loss_stiffness", "loss_tangent", "mean_friction_coefficient",
)  # fmt: skip


class _TooLongError(Exception):
    """A problem has taken more CPU time than allowed."""


def _give_up(*_: object) -> None:
    raise _TooLongError("given up after too much CPU time")


def draw(
    number: int, accuracy: tuple[float, float], kinds: tuple[str, ...]
) -> tuple[str, Any, Any, vf.motion.History, float]:
    """Return name, material, body, period and accuracy of one of the random problems."""
    rng, kind = np.random.default_rng([4, number]), kinds[number % len(kinds)]
    material, rubber = stated_errors._material(rng)
    body, load, length, _ = stated_errors._body(kind, rng)
    points = int(rng.integers(12, 49))
    wave = np.sin(2.0 * np.pi * np.arange(points + 1) / points)
    wave[-1] = 0.0
    time_ = DURATION * np.arange(points + 1) / points
    still = kind in stated_errors.PRESSED or rng.uniform() < 0.5
    relative = math.exp(rng.uniform(math.log(0.005), math.log(1.2))) if still else 0.0
    control = "pressure" if kind in PERIODIC else "load"
    if kind in stated_errors.PRESSED and rng.uniform() < 0.5:
        control, load = "indentation", length**2 / stated_errors.RADIUS
        relative = min(relative, 0.9)
    given = {control: load * rng.uniform(0.3, 1.0) * np.maximum(1.0 + relative * wave, 0.0)}
    path = {} if still else {"speed": length * rng.uniform(0.3, 2.0) * 2.0 * np.pi / DURATION * np.cos(
        2.0 * np.pi * np.arange(points + 1) / points)}  # fmt: skip
    if path:
        path["speed"] -= np.trapezoid(path["speed"]) / points
    asked = math.exp(rng.uniform(*map(math.log, accuracy)))
    history = vf.motion.History(time_, **given, **path, temperature=300.0, before="at rest")
    name = f"{number}: {kind}, {control} by {relative:.2g}, {points} points, {rubber}, {asked:.1e}"
    return name, material, body, history, asked


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=48)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--accuracy", type=float, nargs=2, default=(1e-3, 1e-2), help="least and largest")
    parser.add_argument("--finer", type=float, default=0.1, help="accuracy compared with, over that of the problem")
    parser.add_argument("--kinds", nargs="+", default=KINDS, choices=KINDS)
    parser.add_argument(
        "--seconds", type=float, default=0.0, help="CPU time after which a problem is given up; 0: never"
    )
    options = parser.parse_args(arguments)
    if options.seconds > 0.0:
        signal.signal(signal.SIGVTALRM, _give_up)
    rows: dict[str, list[tuple[float, float, float, float]]] = {name: [] for name in NUMBERS}
    unsolved, periods, spent = [], [], 0.0
    for number in range(options.first, options.first + options.count):
        name, material, body, history, accuracy = draw(number, tuple(options.accuracy), tuple(options.kinds))
        try:
            if options.seconds > 0.0:
                signal.setitimer(signal.ITIMER_VIRTUAL, options.seconds)
            begun = time.process_time()
            found = vf.motion.solve_cycle(material, body, history, accuracy=accuracy)
            spent += time.process_time() - begun
            exact = vf.motion.solve_cycle(material, body, history, accuracy=options.finer * accuracy)
        except (vf.ConvergenceError, _TooLongError) as failure:
            unsolved.append(f"{name}: {failure}")
            continue
        finally:
            if options.seconds > 0.0:
                signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
        periods.append(found.periods)
        for quantity, row in rows.items():
            value, error, true, left = (
                getattr(one, f"{quantity}{end}") for one in (found, exact) for end in ("", "_error")
            )
            if value is None:
                continue
            row.append((abs(value - true), error, left, abs(true)))
            if abs(value - true) > error + left:
                print(f"{name}: {quantity} {value:.4g} off by {abs(value - true):.2g}, stated {error:.2g}", flush=True)
    table = []
    for quantity, row in rows.items():
        if row:
            apart, stated, left, size = np.array(row).T
            table.append(
                {
                    "case": quantity,
                    "values": len(row),
                    "within": float(np.mean(apart <= stated + left)),
                    "strict": float(np.mean(apart <= stated)),
                    "median": float(np.median(apart / stated)),
                    "worst": float(np.max(apart / (stated + left))),
                    "relative": float(np.median(stated / np.maximum(size, 1e-300))),
                }
            )
    columns = (
        ("values", "values", "d"), ("within", "within", ".3f"), ("strict", "strict", ".3f"),
        ("true/stated, median", "median", ".2f"), ("worst", "worst", ".2f"), ("stated/value", "relative", ".1e"),
    )  # fmt: skip
    measuring.print_table("periodic states", table, columns)
    counts = f"solved: {len(periods)}, not solved: {len(unsolved)}; "
    print(f"{counts}periods: {np.median(periods):g}, at most {max(periods)}; {spent:.0f} CPU s", *unsolved, sep="\n")


if __name__ == "__main__":
    main()
