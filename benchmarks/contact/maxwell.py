"""Steady rough friction beside a solver that steps in time: Tamaas' generalised Maxwell solid.

Usage: python benchmarks/contact/maxwell.py [--points 1024] [--verify 64] [--steps 3] [--peers FOLDER] [--limit SECONDS]
       [--json FILE]

The viscoelastic rough contact of rough.py (20 modes over five decades, E_inf/E0 = 100, a tenth of the area).

1. On up to `--verify` points Tamaas is stepped by a point until it is steady, and its friction compared.  Backward
   Euler answers to a wave exp(iωt) with iω replaced by (1 − exp(−iωΔt))/Δt, so viscofric tells where each time step
   leads: "viscofric, Δt" is the steady contact of a rubber altered in this way.
2. In the same way it tells how many steps per point `--points` would take for 1 % of the friction.  The distance to
   the steady state is ln 100 of the longest relaxation time.
3. On `--points`, Tamaas is stepped `--steps` times for the seconds of one step.  The time to the steady state is
   EXTRAPOLATED: steps needed times seconds per step.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
sys.path.insert(0, str(Path(__file__).resolve().parent))
import measuring
import numpy as np
import others
import problems
from numpy.typing import ArrayLike, NDArray

import viscofric as vf

SPEED = 1.0
ERROR = 0.01
VERIFIED_GRIDS = (4, 2, 1)  # every so-many-th point of the finest
MOST_SUBSTEPS = 1024
TOLERANCE = 1e-5  # of Tamaas, in its own measure
VERIFICATION = (
    ("points", "points", "d"),
    ("steps", "steps", "d"),
    ("friction", "friction", ".5f"),
    ("viscofric, Δt", "predicted", ".5f"),
    ("steady", "steady", ".5f"),
    ("off by", "off", ".2%"),
)
COST = (
    ("points", "points", "d"),
    ("CPU s", "seconds", ".3g"),
    ("ratio", "ratio", ".3g"),
    ("s/step", "seconds_per_step", ".3f"),
    ("steps/point", "substeps", "d"),
    ("periods", "periods", ".1f"),
    ("steps", "steps", ".3g"),
    ("friction", "friction", ".5f"),
)


@dataclass(frozen=True)
class Stepped:
    """A rubber as backward Euler sees it; for `viscofric.solve_periodic`, which asks no more of a rubber.

    Parameters
    ----------
    rubber : Material
    time_step : float
    """

    rubber: vf.Material
    time_step: float

    @property
    def poisson_ratio(self) -> float:
        """Of the rubber."""
        return self.rubber.poisson_ratio

    @property
    def E_inf(self) -> float:
        """Of the rubber."""
        return self.rubber.spectrum.E_inf

    @property
    def known_frequencies(self) -> None:
        """Of no interest: nothing is noted."""

    def at(self, temperature: float | None) -> Stepped:
        """Return this: there is one temperature."""
        return self

    def notes_at(self, temperature: float | None) -> tuple[()]:
        """Return no note: there is one temperature."""
        return ()

    def compliance(self, angular_frequency: ArrayLike) -> NDArray[np.complex128]:
        """S with iω replaced by (1 − exp(−iωΔt))/Δt."""
        spectrum = self.rubber.spectrum
        rate = -np.expm1(-1j * self.time_step * np.asarray(angular_frequency, dtype=float)) / self.time_step
        found = np.full(rate.shape, 1.0 / spectrum.E_inf, complex)
        for share, tau in zip(spectrum.C, spectrum.tau, strict=True):
            found += share / (1.0 + rate * tau)
        return found


def steady_friction(surface: vf.contact.PeriodicSurface, time_step: float | None = None) -> float:
    """Friction of the steady contact, or of that to which steps in time lead."""
    rubber: Any = problems.VISCOELASTIC if time_step is None else Stepped(problems.VISCOELASTIC, time_step)
    solution = vf.solve_periodic(rubber, surface, speed=SPEED, pressure=problems.VISCOELASTIC_PRESSURE, tolerance=1e-6)
    return solution.pressure_friction_coefficient


def time_step(surface: vf.contact.PeriodicSurface, substeps: int) -> float:
    """Return Δt for so many steps per point."""
    return surface.spacing[0] / (SPEED * substeps)


def substeps_needed(surface: vf.contact.PeriodicSurface) -> int:
    """Return the steps per point, a power of two from eight on, with which the friction is right to 1 %."""
    exact, substeps = steady_friction(surface), 8
    while abs(steady_friction(surface, time_step(surface, substeps)) / exact - 1.0) > ERROR:
        substeps *= 2
        if substeps > MOST_SUBSTEPS:
            raise SystemExit(f"{MOST_SUBSTEPS} steps per point are not enough for {ERROR:.0%}")
    return substeps


def periods_needed() -> float:
    """Return the distance to the steady state: ln 100 of the longest relaxation time."""
    return SPEED * math.log(100.0) * float(np.max(problems.VISCOELASTIC.spectrum.to_relaxation().tau))


def stepped(
    surface: vf.contact.PeriodicSurface, substeps: int, steps: int, python: Path, limit: float
) -> dict[str, np.ndarray]:
    """Have Tamaas take some steps."""
    prony = problems.VISCOELASTIC.spectrum.to_relaxation()
    given = {
        "shear_moduli": (prony.E / prony.E0).tolist(),
        "relaxation_times": prony.tau.tolist(),
        "time_step": time_step(surface, substeps),
        "speed": SPEED,
        "pressure": problems.VISCOELASTIC_PRESSURE,
        "tolerance": TOLERANCE,
        "steps": steps,
    }
    ((_, arrays),) = others.ask("tamaas_maxwell", given, surface.z, python, limit)
    return arrays


def verify(points: int, python: Path, limit: float) -> list[dict[str, Any]]:
    """Step Tamaas to the steady state, one step per point, on nested grids of one surface."""
    heights = problems.self_affine(points, points_per_shortest_wave=16.0)
    rows: list[dict[str, Any]] = []
    for every in VERIFIED_GRIDS:
        surface = vf.contact.PeriodicSurface(heights[::every, ::every], every / points)
        steps = math.ceil(periods_needed() * surface.shape[0])
        row: dict[str, Any] = {"case": "Tamaas 2.9, Maxwell", "points": surface.shape[0], "steps": steps}
        try:
            friction = stepped(surface, 1, steps, python, limit)["friction"]
        except others.PeerError as error:
            return [*rows, row | {"error": f"{surface.shape[0]} points: {error}"}]
        steady = steady_friction(surface)
        row |= {"friction": float(friction[-1]), "predicted": steady_friction(surface, time_step(surface, 1))}
        rows.append(row | {"steady": steady, "off": row["friction"] / steady - 1.0})
    return rows


def cost(points: int, steps: int, python: Path | None, limit: float) -> list[dict[str, Any]]:
    """Time viscofric's solution, and some steps of Tamaas, from which its time is extrapolated."""
    surface = problems.rough_surface(points)
    solution, seconds = measuring.cpu_seconds(lambda: problems.viscoelastic_rough(surface))
    own = {"case": "viscofric", "points": points, "seconds": seconds, "ratio": 1.0}
    rows: list[dict[str, Any]] = [own | {"friction": solution.pressure_friction_coefficient}]
    if python is None:
        return rows
    substeps = substeps_needed(surface)
    row: dict[str, Any] = {"case": "Tamaas 2.9, Maxwell, extrapolated", "points": points, "substeps": substeps}
    try:
        each = stepped(surface, substeps, steps, python, limit)["seconds"]
    except others.PeerError as error:
        return [*rows, row | {"error": f"{points} points: {error}"}]
    row["seconds_per_step"] = float(np.median(each))
    for case, periods in (("", periods_needed()), (", were one period enough", 1.0)):
        needed = periods * points * substeps
        total = needed * row["seconds_per_step"]
        rows.append(
            row
            | {"case": row["case"] + case, "periods": periods, "steps": needed, "seconds": total}
            | {"ratio": total / seconds}
        )
    return rows


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--points", type=int, default=1024, help="along an edge")
    parser.add_argument("--verify", type=int, default=64, help="most points of what is run to the end; 0: none")
    parser.add_argument("--steps", type=int, default=3, help="that are timed")
    parser.add_argument("--peers", type=Path, default=others.DEFAULT_ENVIRONMENT, help="the peers' environment")
    parser.add_argument("--limit", type=float, default=280.0, help="seconds for each answer")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    python = others.python_of(options.peers)
    problems.viscoelastic_rough(problems.rough_surface(64))  # imports
    results = {}
    if options.verify:
        results["verification"] = verify(options.verify, python, options.limit)
        measuring.print_table("steady friction, stepped to the end", results["verification"], VERIFICATION)
    results["cost"] = cost(options.points, options.steps, python, options.limit)
    measuring.print_table("cost of the steady friction to 1 %", results["cost"], COST)
    measuring.write_json(options.json, results)


if __name__ == "__main__":
    main()
