"""Many cases of a ball: contacts that are solved for them, time, what the study adds to solving, and true errors.

Usage: python benchmarks/study/sweeps.py [--speeds 50] [--temperatures 20] [--accuracy 1e-3] [--workers 2]
       [--check 12] [--distinct 200] [--json FILE]

`--check N` solves so many of the cases again by themselves to a fifth of the accuracy, outside the time that is
measured.  `--distinct N` solves so many cases each by itself, with one worker and with all.
"""

from __future__ import annotations

import argparse
import os
import resource
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "contact"))
import measuring
import numpy as np
from problems import CURVE_BALL, CURVE_LOAD, CURVE_RUBBER

from viscofric.friction.cases.indenter_case import IndenterCase
from viscofric.friction.cases.record import Record
from viscofric.friction.cases.solving import Task, solve
from viscofric.friction.planning.plan import Plan
from viscofric.study.running.executors import Processes
from viscofric.study.running.running import run_plan
from viscofric.study.running.store import CaseStore

COLUMNS = (
    ("cases", "cases", "d"),
    ("solved", "solved", "d"),
    ("wall s", "wall_seconds", ".2f"),
    ("CPU s", "seconds", ".2f"),
    ("study adds", "added", ".1%"),
    ("failures", "failures", "d"),
    ("worst ±", "worst_estimate", ".1e"),
    ("worst error", "worst_error", ".1e"),
)


def cases_of(speeds: int, temperatures: int) -> list[IndenterCase]:
    """Speeds from 1 mm/s to 1 m/s at temperatures from 20 to 115 °C: 14 decades of αv."""
    return [
        IndenterCase(0, CURVE_BALL, float(temperature), float(speed), CURVE_LOAD)
        for temperature in np.linspace(293.15, 388.15, temperatures)
        for speed in np.geomspace(1e-3, 1.0, speeds)
    ]


class Timed:
    """A plan whose tasks are solved in this process, and add up what that takes."""

    def __init__(self, plan: Plan) -> None:
        self._plan, self.seconds = plan, 0.0

    def __getattr__(self, name: str) -> Any:
        return getattr(self._plan, name)

    def wanted(self) -> list[Task]:
        """Return the tasks of the plan."""
        return [replace(task, verb=partial(self._solve, task.verb)) for task in self._plan.wanted()]

    def _solve(self, verb: Callable[..., Record], **contact: Any) -> Record:
        start = time.process_time()
        try:
            return verb(**contact)
        finally:
            self.seconds += time.process_time() - start


def carried_out(name: str, cases: list[IndenterCase], workers: int, folder: Path, **settings: Any) -> dict[str, Any]:
    """Plan, solve and store cases; a row of the table and, under "found", what was found."""
    store = CaseStore(folder)
    before = len(list(folder.glob("*.json")))
    wall, cpu = time.perf_counter(), _cpu_with_children()
    plan: Plan = Plan(cases, [CURVE_RUBBER], **settings)
    timed = Timed(plan)
    with Processes(workers) as executor:
        run_plan(timed if workers == 1 else plan, store, executor)
    found = plan.found()
    row: dict[str, Any] = {
        "case": f"{name}, {workers} process{'es' * (workers > 1)}",
        "cases": len(cases),
        "wall_seconds": time.perf_counter() - wall,
        "seconds": _cpu_with_children() - cpu,
        "solved": len(list(folder.glob("*.json"))) - before,
        "failures": sum(not isinstance(one, Record) for one in found),
        "found": found,
    }
    known = [one for one in found if isinstance(one, Record)]
    row["worst_estimate"] = max(one.friction_error / one.friction_coefficient for one in known)
    if workers == 1 and timed.seconds:
        row["added"] = row["seconds"] / timed.seconds - 1.0
    return row


def worst_error(cases: list[IndenterCase], found: list[Any], accuracy: float, checks: int) -> float:
    """Return the largest relative difference from cases solved by themselves, five times as accurately."""
    worst = 0.0
    for number in np.random.default_rng(0).choice(len(cases), checks, replace=False):
        (task,) = Plan([cases[number]], [CURVE_RUBBER], accuracy=accuracy / 5.0, each=True).wanted()
        worst = max(worst, abs(found[number].friction_coefficient / solve(task).friction_coefficient - 1.0))
    return worst


def _cpu_with_children() -> float:
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--speeds", type=int, default=50)
    parser.add_argument("--temperatures", type=int, default=20)
    parser.add_argument("--accuracy", type=float, default=1e-3)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--check", type=int, default=12, help="cases that are solved again, more accurately")
    parser.add_argument("--distinct", type=int, default=200, help="cases that are solved each by itself")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    cases = cases_of(options.speeds, options.temperatures)
    rows = []
    with tempfile.TemporaryDirectory() as temporary:
        for workers in sorted({1, options.workers}):
            folder = Path(temporary) / f"curve{workers}"
            rows.append(carried_out("on a curve", cases, workers, folder, accuracy=options.accuracy))
        if options.check:
            rows[0]["worst_error"] = worst_error(cases, rows[0]["found"], options.accuracy, options.check)
        denser = cases_of(4 * options.speeds, 2 * options.temperatures)
        rows.append(carried_out("gained cases", denser, 1, Path(temporary) / "curve1", accuracy=options.accuracy))
        distinct = cases_of(max(1, options.distinct // 10), 10)
        for workers in sorted({1, options.workers}) if options.distinct else ():
            folder = Path(temporary) / f"each{workers}"
            rows.append(carried_out("each", distinct, workers, folder, accuracy=options.accuracy, each=True))
    for row in rows:
        del row["found"]
    measuring.print_table("ball on a rubber of 40 modes", rows, COLUMNS)
    measuring.write_json(options.json, {"rows": rows})


if __name__ == "__main__":
    main()
