"""Make the example data in src/viscofric/example from the synthetic fluoroelastomer: nothing in them is measured.

The traction runs need 30 contacts solved to 1e-4, some minutes.  What they were made from is kept in
tests/data/planted_friction.csv, where the tests hold it against the energy balance and an independent solution.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

import viscofric as vf

ROOT = Path(__file__).resolve().parent.parent
EXAMPLE = ROOT / "src" / "viscofric" / "example"
PLANTED = ROOT / "tests" / "data" / "planted_friction.csv"
SEED = 20260301
NOISE = 0.01  # relative, on E' and on E'', independent
TEMPERATURES = np.arange(-30.0, 221.0, 10.0)  # °C
FREQUENCIES = np.logspace(-1.0, 1.0, 17)  # Hz


def make_dma(path: Path) -> None:
    """Write frequency sweeps of the synthetic fluoroelastomer with 1 % multiplicative noise."""
    rubber = vf.synthetic_fluoroelastomer()
    random = np.random.default_rng(SEED)
    lines = [
        "# SYNTHETIC data: computed from synthetic_fluoroelastomer, an assumed material; not a measurement.",
        f"# Uniaxial tension, {100 * NOISE:g} % multiplicative noise on each modulus, seed {SEED}.",
        "# Made by scripts/make_synthetic_example.py.",
        "temperature (degC),frequency (Hz),E' (MPa),E'' (MPa)",
    ]
    for temperature in TEMPERATURES:
        modulus = rubber.complex_modulus(2.0 * math.pi * FREQUENCIES, f"{temperature} degC") / 1e6
        noise = 1.0 + NOISE * random.standard_normal((2, len(FREQUENCIES)))
        for frequency, storage, loss in zip(FREQUENCIES, noise[0] * modulus.real, noise[1] * modulus.imag, strict=True):
            lines.append(f"{temperature:.1f},{frequency:.6g},{storage:.6g},{loss:.6g}")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


BALL_RADIUS = 9.525e-3  # m
LOAD = 25.0  # N
SPEEDS = np.geomspace(0.02, 0.2, 10)  # m/s
TEST_TEMPERATURES = (30.0, 60.0, 90.0)  # °C
REPLICATES = 8
SLIP = 0.05  # |disc speed − ball speed| over disc speed
COULOMB = 0.045  # friction coefficient of the interface
OFFSET = 0.12  # N, zero reading of the force cell
ACCURACY = 1e-4
# Standard deviations of what a tribometer adds: relative for loads and speeds, and for each run's viscoelastic
# and Coulomb friction; absolute for temperature (K) and force (N).
JITTER = {
    "load": 2e-3,
    "speed": 1e-3,
    "temperature": 0.05,
    "viscoelastic": 0.02,
    "coulomb": 0.01,
    "force": 0.01,
}


def solve_planted_friction(path: Path) -> None:
    """Solve the contacts of the friction test, once, and keep what they gave."""
    rubber = vf.synthetic_fluoroelastomer()
    lines = [
        f"# SYNTHETIC: friction of synthetic_fluoroelastomer, an assumed material, solved to {ACCURACY:g}.",
        "# Made by scripts/make_synthetic_example.py.",
        "temperature (degC),speed (m/s),friction,friction from dissipation,error estimate",
    ]
    for temperature in TEST_TEMPERATURES:
        for speed in SPEEDS:
            solution = vf.solve_steady(
                rubber,
                vf.Ball(radius=BALL_RADIUS),
                speed=float(speed),
                load=LOAD,
                temperature=f"{temperature} degC",
                accuracy=ACCURACY,
            )
            numbers = (
                solution.friction_coefficient,
                solution.energy_friction_coefficient,
                solution.diagnostics.friction_error,
            )
            lines.append(",".join([f"{temperature:g}", f"{speed:.17g}", *(f"{number:.8g}" for number in numbers)]))
            print(lines[-1], flush=True)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def make_mtm(path: Path, planted: Path) -> None:
    """Write traction runs in four sign configurations, with offset, Coulomb friction and scatter."""
    random = np.random.default_rng(SEED + 1)

    def scattered(value: float, kind: str) -> float:
        return value * (1.0 + JITTER[kind] * random.standard_normal())

    lines = [
        "# SYNTHETIC data: viscoelastic friction computed from viscofric's synthetic_fluoroelastomer, an assumed",
        f"# material, with Coulomb friction {COULOMB:g}, a force-cell offset of {OFFSET:g} N and scatter",
        f"# added (seed {SEED + 1}); not a measurement.  Ball of radius {1e3 * BALL_RADIUS:g} mm.",
        "# Made by scripts/make_synthetic_example.py.",
        "temperature (degC),replicate,disc speed (mm/s),ball speed (mm/s),load (N),traction force (N)",
    ]
    rows = np.loadtxt(planted, delimiter=",", skiprows=3, usecols=(0, 1, 2))
    for temperature, speed, friction in rows:
        for replicate in range(1, REPLICATES + 1):
            for direction in (-1.0, 1.0):
                for slip in (-1.0, 1.0):
                    load = scattered(LOAD, "load")
                    force = (
                        OFFSET
                        + load * direction * scattered(friction, "viscoelastic")
                        + load * slip * scattered(COULOMB, "coulomb")
                        + JITTER["force"] * random.standard_normal()
                    )
                    disc = direction * scattered(speed, "speed")
                    ball = disc - slip * scattered(SLIP * speed, "speed")
                    measured = temperature + JITTER["temperature"] * random.standard_normal()
                    lines.append(f"{measured:.2f},{replicate},{1e3 * disc:.3f},{1e3 * ball:.3f},{load:.3f},{force:.4f}")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    make_dma(EXAMPLE / "dma.csv")
    solve_planted_friction(PLANTED)
    make_mtm(EXAMPLE / "mtm.csv", PLANTED)
