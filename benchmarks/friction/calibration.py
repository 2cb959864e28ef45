"""Whether the errors of identified rubbers are honest, over many measurements and at a hundredth of the cost.

Usage: python benchmarks/friction/calibration.py [--seeds N] [--first SEED] [--material NAME] [--json FILE]

The planted friction is identified once without noise; the scattered measurements of identify.py are then fitted with
the contacts that were solved there and not anew.  What one seed errs by is nearly one number, that of the shift between
the anchor's temperature and the next one, so that a hundred seeds tell their share of held intervals to 2 %.
"""

from __future__ import annotations

import argparse
import json
import os
from dataclasses import replace
from pathlib import Path
from typing import Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
import numpy as np
from identify import BALL, FREQUENCY, KELVIN, MATERIALS, SPEEDS, measured

import viscofric as vf
from viscofric.errors import InputError
from viscofric.friction.identification.anchors import ModulusObservation
from viscofric.friction.identification.drawn_materials import drawn_from
from viscofric.friction.identification.identify import problem_of, shifts_of
from viscofric.friction.identification.iteration import identify, most_evident, weighed
from viscofric.friction.identification.points import Points, usable_points
from viscofric.friction.identification.problem import Problem, Shifts
from viscofric.friction.identification.solving import Contacts, spectrum_of

ACCURACY = 3e-3
MODES = 30
STEP = 1e-4  # of ln C, for derivatives of ln E


class Frozen:
    """A planted rubber with contacts solved for what was identified from its friction without noise."""

    def __init__(self, name: str) -> None:
        self.rubber = MATERIALS[name]()
        self.exact = vf.predict_friction(
            self.rubber, BALL, speeds=SPEEDS, temperatures=KELVIN, load="25 N", accuracy=1e-4
        )
        modulus = float(abs(self.rubber.complex_modulus(FREQUENCY, KELVIN[0])))
        anchor = vf.friction.ModulusAnchor(modulus, FREQUENCY, KELVIN[0], error=1e-3)
        self.moduli = (ModulusObservation.of(anchor),)
        points, shifts = self.observed(None)
        contacts = Contacts(BALL, 0.5, points.load, 1)
        problem = problem_of(points, shifts, self.moduli, contacts, MODES)
        fits, _ = identify(problem, contacts.solved, problem.start, ACCURACY)
        best = most_evident(fits)
        self.problem, self.place = best.problem, best.minimum.place

    def observed(self, seed: int | None) -> tuple[Points, Shifts]:
        """Return a measurement, and what its curves' overlap tells of the shifts."""
        curves = measured(self.exact, seed)
        points = usable_points(curves, BALL, None, 0.25 * ACCURACY)
        return shifts_of(points, curves, None, float(KELVIN[0]), [float(KELVIN[0])])

    def errors(self, seed: int) -> dict[str, np.ndarray]:
        """Return by how many standard errors ln α, and ln |E|, ln E' and ln E'' over the frequencies, are off."""
        points, shifts = self.observed(seed)
        problem: Problem = replace(self.problem, points=points, shifts=shifts)
        fits = weighed(problem, self.place)
        place, (_, covariance) = most_evident(fits).minimum.place, drawn_from(fits, 1, np.random.default_rng(0))
        compliances, log_alpha = problem.split(place)
        variance = np.diag(covariance)[problem.modes :]
        kelvin = shifts.temperatures
        away = log_alpha - np.log(10.0) * self.rubber.shift.log10(kelvin)
        reduced = points.log_speed + log_alpha[points.number]
        ends = np.array([reduced.min(), reduced.max()])
        omega = np.geomspace(*np.exp(ends - problem.friction.first(compliances, ends).log_radius), 13)
        found = self.moduli_of(compliances, omega)
        slope = np.array([self.moduli_of(compliances + STEP * one, omega) - found for one in np.eye(problem.modes)])
        spread = np.einsum("i...,ij,j...->...", slope, covariance[: problem.modes, : problem.modes], slope)
        E = self.rubber.complex_modulus(omega, KELVIN[0])
        off = (found - logarithms(E)) / (np.sqrt(spread) / STEP)
        measured_ones = np.abs(kelvin - KELVIN[0]) > 1.0
        alpha = (away / np.sqrt(np.maximum(variance, 1e-12)))[measured_ones]
        return {"α": alpha, "|E|": off[0], "E'": off[1], "E''": off[2]}

    def moduli_of(self, compliances: np.ndarray, omega: np.ndarray) -> np.ndarray:
        """Return ln of |E|, E' and E'', (3, n)."""
        return logarithms(spectrum_of(compliances, self.problem.smoothness.tau).complex_modulus(omega))


def logarithms(E: np.ndarray) -> np.ndarray:
    return np.log([np.abs(E), E.real, E.imag])


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=100, help="scattered measurements of each material")
    parser.add_argument("--first", type=int, default=0, help="seed of the first of them")
    parser.add_argument("--material", choices=MATERIALS, help="only this one")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    results: dict[str, Any] = {}
    for name in [options.material] if options.material else MATERIALS:
        frozen, rows, refused = Frozen(name), [], {}
        for seed in range(options.first, options.first + options.seeds):
            try:
                rows.append(frozen.errors(seed))
            except InputError as error:
                refused[seed] = str(error)
        table = {key: np.array([row[key] for row in rows]) for key in (rows[0] if rows else ())}
        held = {key: float(np.mean(np.abs(off) < 1.96)) for key, off in table.items()}
        size = {key: float(np.sqrt(np.mean(off**2))) for key, off in table.items()}
        print(f"{name}: {len(rows)} measurements, {len(refused)} refused")
        for key, share in held.items():
            print(f"  {key:4} 95 % intervals hold {100.0 * share:5.1f} %, errors are {size[key]:.2f} of those told")
        results[name] = {"held": held, "rms": size, "refused": refused}
    if options.json:
        options.json.parent.mkdir(parents=True, exist_ok=True)
        options.json.write_text(json.dumps(results, indent=1, ensure_ascii=False), encoding="utf-8")


if __name__ == "__main__":
    main()
