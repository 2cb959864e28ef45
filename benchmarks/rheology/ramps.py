"""Coverage of intervals from temperature ramps and amplitude sweeps: planted constants and α(T) in stated 95 % bands.

Usage: .venv/bin/python benchmarks/rheology/ramps.py [--seeds 80] [--first 0] [--only TEXT]
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

import viscofric as vf

sys.path.insert(0, str(Path(__file__).parents[2] / "tests"))
from rheology.planted import synthetic_polymer, synthetic_soft_rubber
from rheology.planted_ramps import planted_ramps

REFERENCE = 298.15
CASES = {
    "polymer, 5 frequencies, 2 K": (synthetic_polymer(), (0.5, 1, 5, 10, 50), np.arange(-20.0, 101.0, 2.0)),
    "polymer, 2 frequencies, 1 K": (synthetic_polymer(), (1, 10), np.arange(-20.0, 101.0, 1.0)),
    "polymer, 3 in a decade, 1 K": (synthetic_polymer(), (1, 3.3, 10), np.arange(-10.0, 81.0, 1.0)),
    "soft rubber, 4 frequencies, 2 K": (synthetic_soft_rubber(), (0.5, 2, 8, 32), np.arange(-45.0, 81.0, 2.0)),
    "soft rubber from -60 °C": (synthetic_soft_rubber(), (0.5, 2, 8, 32), np.arange(-60.0, 81.0, 2.0)),
}
#: Noise of a point, and correlation with that of its neighbour.
NOISE = ((0.01, 0.0), (0.03, 0.0), (0.01, 0.7))
LAW = vf.rheology.KrausLaw(6e6, 1.5e6, 0.02, 0.6, 9e5, 2e5, 2.0 * np.pi * 10.0, 333.15, "shear")


def ramps(case: str, noise: float, alike: float, seeds: range) -> str:
    """Return a row of the table: shares of C1, C2 and α(T) within 1.96 standard errors."""
    material, hertz, celsius = CASES[case]
    truth = material.shift.at_reference(REFERENCE)
    constants, shifts, errors = [], [], []
    for seed in seeds:
        planted = planted_ramps(seed, noise, material=material, hertz=hertz, celsius=celsius, alike=alike)
        law = vf.superpose_ramps(planted, REFERENCE).shift
        constants.append((law.parameters - truth.parameters) / np.array(law.standard_errors))
        kelvin = np.linspace(*planted.temperature_range, 25)
        error = law.standard_error(kelvin)
        shifts.append((law.log10(kelvin) - truth.log10(kelvin)) / error)
        errors.append(np.median(error))
    C1, C2 = np.mean(np.abs(constants) < 1.96, axis=0)
    inside = np.mean(np.abs(shifts) < 1.96)
    return f"| {case} | {noise:.0%} | {alike:g} | {C1:.1%} | {C2:.1%} | {inside:.1%} | {np.median(errors):.3f} |"


def payne(seeds: range) -> str:
    """Return the shares of Kraus's constants within 1.96 standard errors."""
    strain = np.geomspace(1e-4, 0.5, 25)
    modulus = LAW.complex_modulus(strain)
    scores = []
    for seed in seeds:
        scatter = 1.0 + 0.01 * np.random.default_rng(seed).standard_normal((2, len(strain)))
        sweep = vf.readers.AmplitudeSweep(
            strain, scatter[0] * modulus.real, scatter[1] * modulus.imag, "10 Hz", 333.15, "shear"
        )
        law = vf.rheology.fit_kraus(sweep).law
        scores.append((law.constants - LAW.constants) / np.array(law.standard_errors))
    shares = " | ".join(f"{one:.1%}" for one in np.mean(np.abs(scores) < 1.96, axis=0))
    return f"| {shares} |"


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=80)
    parser.add_argument("--first", type=int, default=0, help="first seed: others than those a method was set with")
    parser.add_argument("--only", default="", metavar="TEXT", help="cases of ramps whose name holds a text")
    options = parser.parse_args()
    seeds = range(options.first, options.first + options.seeds)
    print("| ramps | noise | correlation | C1 | C2 | α(T) | median standard error of log10 α |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for case in [one for one in CASES if options.only in one]:
        for noise, alike in NOISE:
            print(ramps(case, noise, alike, seeds), flush=True)
    print("\n| G'0 | G'∞ | γc | m | G''m | G''∞ |\n| --- | --- | --- | --- | --- | --- |")
    print(payne(seeds))


if __name__ == "__main__":
    main()
