"""How often the planted shift law is chosen at few temperatures, and how far log10 α of the chosen one is off.

    python benchmarks/rheology/laws.py --problems 40 --json laws.json

Sweeps of the SYNTHETIC fluoroelastomer in its glass transition are planted with a random WLF or Arrhenius law at 2 to 8
temperatures, 5, 10 or 15 K apart, with 0.5 to 3 % of noise in every modulus, superposed, and the laws compared.  Errors
are the largest of each problem, between the temperatures and 10 K beyond them, median and 95th percentile over the
problems.  `held`: share of the planted log10 α 10 K beyond that lie in the law's 95 % band.  `open`: share of the
comparisons that cannot decide between two laws.  Problems whose superposition fails are drawn anew.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import numpy as np

import viscofric as vf
from viscofric.errors import ViscofricError
from viscofric.notes import codes
from viscofric.rheology.shifts.laws import ParametricLaw

COUNTS = (2, 3, 4, 5, 6, 8)
KINDS = ("wlf", "arrhenius")
FREQUENCIES = 2.0 * np.pi * np.logspace(-1.0, 1.0, 17)  # rad/s
LARGEST_STEP = 1.4  # decades between neighbours, whose sweeps then overlap by 0.6
BEYOND = 10.0  # K


def problem(kind: str, count: int, random: np.random.Generator) -> tuple[ParametricLaw, np.ndarray]:
    """Return a law and temperatures, K, whose sweeps overlap."""
    while True:
        reference = random.uniform(270.0, 420.0)
        kelvin = reference + random.choice([5.0, 10.0, 15.0]) * (np.arange(count) - count // 2)
        if kind == "wlf":  # the pole lies 50 to 150 K below the coldest; C1 C2 does not depend on the reference
            C2 = random.uniform(50.0, 150.0) + reference - kelvin[0]
            law: ParametricLaw = vf.WLF(random.uniform(500.0, 1200.0) / C2, C2, reference)
        else:
            law = vf.Arrhenius(random.uniform(4e4, 2.5e5), reference)
        if np.max(np.abs(np.diff(law.log10(kelvin)))) < LARGEST_STEP:
            return law, kelvin


def factors(law: ParametricLaw, kelvin: np.ndarray, noise: float, random: np.random.Generator) -> vf.ShiftFactors:
    """Return the shift factors of noisy sweeps, found by superposition."""
    material = vf.Material(vf.synthetic_fluoroelastomer().spectrum.shifted(1e4), law)
    isotherms = []
    for one in kelvin:
        modulus = material.complex_modulus(FREQUENCIES, one)
        scatter = 1.0 + noise * random.standard_normal((2, FREQUENCIES.size))
        isotherms.append(vf.Isotherm(one, FREQUENCIES, modulus.real * scatter[0], modulus.imag * scatter[1]))
    return vf.superpose(vf.IsothermalSweeps(tuple(isotherms)), law.reference).shift_factors


def judged(kind: str, count: int, random: np.random.Generator) -> tuple[bool, bool, float, float, float] | None:
    """Return whether the planted law was chosen, whether that is open, errors inside and beyond, and the share held."""
    law, kelvin = problem(kind, count, random)
    try:
        laws = factors(law, kelvin, random.uniform(0.005, 0.03), random).compare_laws()
    except ViscofricError:
        return None
    inside = np.linspace(kelvin[0], kelvin[-1], 41)
    low, high = laws.best.extrapolation_limits
    beyond = np.array([max(kelvin[0] - BEYOND, low), min(kelvin[-1] + BEYOND, high)])
    error = np.abs(laws.best.log10(beyond) - law.log10(beyond))
    return (
        laws.chosen.kind == kind,
        "laws-undecided" in codes(laws.notes),
        float(np.max(np.abs(laws.best.log10(inside) - law.log10(inside)))),
        float(np.max(error)),
        float(np.mean(error < 1.96 * laws.best.standard_error(beyond))),
    )


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--problems", type=int, default=20, help="for each law and number of temperatures (default 20)")
    parser.add_argument("--json", type=Path, help="file for the numbers")
    asked = parser.parse_args(arguments)
    rows = []
    print("planted    temperatures  chosen   open   inside: median, 95 %   beyond: median, 95 %   held")
    for count in COUNTS:
        for kind in KINDS:
            random = np.random.default_rng([count, KINDS.index(kind)])
            found = []
            while len(found) < asked.problems:
                one = judged(kind, count, random)
                found += [] if one is None else [one]
            right, undecided, inside, beyond, held = np.array(found, dtype=float).T
            row = {"planted": kind, "temperatures": count, "chosen": right.mean(), "open": undecided.mean()}
            for name, errors in (("inside", inside), ("beyond", beyond)):
                row |= {f"{name}_median": float(np.median(errors)), f"{name}_95": float(np.quantile(errors, 0.95))}
            rows.append(row | {"held": held.mean()})
            print(
                f"{kind:10} {count:12d} {right.mean():7.0%} {undecided.mean():6.0%} "
                f"{row['inside_median']:15.3f} {row['inside_95']:6.3f} {row['beyond_median']:16.3f} "
                f"{row['beyond_95']:6.3f} {held.mean():7.0%}",
                flush=True,
            )
    if asked.json:
        asked.json.write_text(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main()
