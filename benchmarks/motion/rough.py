"""A rough surface that begins to slide, step by step in time, beside Tamaas' generalised Maxwell solid.

Usage: python benchmarks/motion/rough.py [--points 512] [--steps 100] [--compare 64] [--peers FOLDER] [--limit SECONDS]
       [--json FILE]

The viscoelastic rough contact of benchmarks/contact (E_inf/E0 = 100, a tenth of the area).

1. On `--points`, 40 modes over ten decades: CPU seconds for a step of one point after a start from rest, and the peak
   of all memory in arrays of the surface's size.  The time of 1,000 steps is EXTRAPOLATED from `--steps`.
2. On `--compare` points, 20 modes: both begin untouched and slide half a period, with several steps for each point.
   Errors are those of the friction over the second half of the path, against steps an eighth of the smallest.
3. On `--points`, 20 modes: seconds of one step of each; with 2., the ratio of the times for the same error.  Tamaas'
   error is of first order: its steps for a smaller one are EXTRAPOLATED.
"""

from __future__ import annotations

import argparse
import itertools
import os
import sys
from pathlib import Path
from typing import Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "contact"))
import maxwell
import measuring
import numpy as np
import others
import problems

import viscofric as vf
from viscofric.motion.mover import Problem
from viscofric.motion.periodic import PeriodicMover

ACCURACY = 1e-3
STEPS = 1000
COST = (
    ("points", "points", "d"),
    ("modes", "modes", "d"),
    ("fields", "fields", "d"),
    ("steps", "steps", "d"),
    ("products/step", "products", ".1f"),
    ("s/step", "seconds_per_step", ".4f"),
    ("1,000 steps, s", "seconds", ".1f"),
    ("arrays", "arrays", ".1f"),
)
ERRORS = (("steps/point", "substeps", "g"), ("steps", "steps", "d"), ("friction error", "friction_error", ".2e"))
RATIO = (
    ("s/step", "seconds_per_step", ".4f"),
    ("steps/point", "substeps", ".3g"),
    ("s/point", "seconds_per_point", ".4g"),
    ("ratio", "ratio", ".3g"),
)


def broad_rubber() -> vf.Material:
    """Return 40 modes over ten decades with the plateaus of the other problems."""
    spectrum = problems.VISCOELASTIC.spectrum
    tau = np.geomspace(1e-7, 1e3, 40)
    compliance = np.full(40, (1.0 / spectrum.E0 - 1.0 / spectrum.E_inf) / 40.0)
    return vf.Material(
        vf.RetardationSpectrum(spectrum.E0, spectrum.E_inf, compliance, tau),
        poisson_ratio=problems.VISCOELASTIC.poisson_ratio,
    )


class Run:
    """A surface that slides over some points, by steps of equal length."""

    def __init__(self, material: vf.Material, surface: vf.contact.PeriodicSurface, before: str, path: float) -> None:
        duration = path / maxwell.SPEED
        history = vf.motion.History(
            [0.0, duration], pressure=problems.VISCOELASTIC_PRESSURE, speed=maxwell.SPEED, before=before
        )
        self.schedule = history.schedule(material, "periodic")
        self.mover = PeriodicMover(Problem(material, surface, self.schedule, ACCURACY, None, 0.0))
        self.state = self.mover.begin()
        if before == "untouched":
            first = self.schedule.at(0.0)
            self.state = self.mover.step(self.state, first, first)

    def friction(self, steps: int, taken: int | None = None) -> np.ndarray:
        """Slide to the end by so many steps, or take the first few; return the friction coefficient after each."""
        found = []
        times = np.linspace(0.0, self.schedule.end, steps + 1)[: None if taken is None else taken + 1]
        for start, end in itertools.pairwise(times.tolist()):
            instants = self.schedule.at(start), self.schedule.at(end, after=False)
            self.state = self.mover.step(self.state, *instants, keep=False)
            found.append(self.mover.observe(self.state).friction_force[0] / problems.VISCOELASTIC_PRESSURE)
        return np.array(found)


def cost(material: vf.Material, points: int, steps: int) -> dict[str, Any]:
    """Time steps of one point after a start from rest."""
    surface = problems.rough_surface(points)
    run = Run(material, surface, "at rest", steps * surface.spacing[0])
    before = run.mover.products
    _, seconds = measuring.cpu_seconds(lambda: run.friction(steps))
    products = run.mover.products - before

    def again() -> None:
        Run(material, surface, "at rest", steps * surface.spacing[0]).friction(steps, min(steps, 3))

    _, peak = measuring.peak_bytes(again)
    return {
        "case": "viscofric",
        "points": points,
        "modes": len(material.spectrum),
        "fields": len(run.mover.modes),
        "steps": steps,
        "products": products / steps,
        "seconds_per_step": seconds / steps,
        "seconds": STEPS * seconds / steps,
        "arrays": peak / surface.z.nbytes,
    }


def errors(points: int, python: Path, limit: float) -> list[dict[str, Any]]:
    """Return the errors of friction with several steps for each point."""
    surface = problems.rough_surface(points)
    cells, rows = points // 2, []

    def own(substeps: float) -> np.ndarray:
        every = max(round(substeps), 1)
        run = Run(problems.VISCOELASTIC, surface, "untouched", cells * surface.spacing[0])
        return run.friction(round(cells * substeps))[every - 1 :: every]

    exact = own(8.0)
    half = cells // 2

    def row(case: str, substeps: float, friction: np.ndarray) -> dict[str, Any]:
        reference = exact[round(1.0 / substeps) - 1 :: round(1.0 / substeps)] if substeps < 1.0 else exact
        part = len(reference) * half // cells
        error = float(np.abs(friction - reference)[part:].max() / np.abs(exact[half:]).max())
        return {"case": case, "substeps": substeps, "steps": round(cells * substeps), "friction_error": error}

    rows += [row("viscofric", substeps, own(substeps)) for substeps in (0.25, 0.5, 1.0)]
    for substeps in (1, 4):
        try:
            friction = maxwell.stepped(surface, substeps, cells * substeps, python, limit)["friction"]
        except others.PeerError as error:
            return [*rows, {"case": "Tamaas 2.9, Maxwell", "error": f"{error}"}]
        rows.append(row("Tamaas 2.9, Maxwell", float(substeps), friction[substeps - 1 :: substeps]))
    return rows


def ratios(points: int, found: list[dict[str, Any]], python: Path, limit: float) -> list[dict[str, Any]]:
    """Return the times for the same error: that of one of viscofric's steps for each point."""
    own = next(one for one in found if one["case"] == "viscofric" and one["substeps"] == 1.0)
    peer = found[-1]
    mine = cost(problems.VISCOELASTIC, points, 20)["seconds_per_step"]
    rows = [{"case": "viscofric", "seconds_per_step": mine, "substeps": 1.0, "seconds_per_point": mine, "ratio": 1.0}]
    if "substeps" not in peer:
        return rows
    each = maxwell.stepped(problems.rough_surface(points), 1, 3, python, limit)["seconds"]
    needed = peer["substeps"] * peer["friction_error"] / own["friction_error"]
    seconds = float(np.median(each))
    total = seconds * needed
    return [
        *rows,
        {
            "case": "Tamaas 2.9, Maxwell, extrapolated",
            "seconds_per_step": seconds,
            "substeps": needed,
            "seconds_per_point": total,
            "ratio": total / mine,
        },
    ]


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--points", type=int, default=512, help="along an edge")
    parser.add_argument("--steps", type=int, default=100, help="that are timed")
    parser.add_argument("--compare", type=int, default=64, help="points of the comparison of errors; 0: none")
    parser.add_argument("--peers", type=Path, default=others.DEFAULT_ENVIRONMENT, help="the peers' environment")
    parser.add_argument("--limit", type=float, default=280.0, help="seconds for each answer")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    python = others.python_of(options.peers)
    Run(broad_rubber(), problems.rough_surface(64), "at rest", 0.1).friction(2)  # imports
    results: dict[str, Any] = {"cost": [cost(broad_rubber(), options.points, options.steps)]}
    measuring.print_table("a step of one point, 40 modes", results["cost"], COST)
    if options.compare:
        results["errors"] = errors(options.compare, python, options.limit)
        measuring.print_table(f"errors of friction, {options.compare} points", results["errors"], ERRORS)
        results["ratio"] = ratios(options.points, results["errors"], python, options.limit)
        measuring.print_table("time for the same error", results["ratio"], RATIO)
    measuring.write_json(options.json, results)


if __name__ == "__main__":
    main()
