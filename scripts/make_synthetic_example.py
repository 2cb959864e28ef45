"""Make the data of the built-in example and of the template "paper"; nothing in them is measured.

Their contacts are solved to 1e-4, some minutes. The solved friction is kept in tests/data, where tests compare it
with the energy balance and an independent solution.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import viscofric as vf

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "src" / "viscofric"
PLANTED = ROOT / "tests" / "data"
NOISE = 0.01  # relative, on E' and on E'', independent
FREQUENCIES = np.logspace(-1.0, 1.0, 17)  # Hz
BALL_RADIUS = 9.525e-3  # m
SLIP = 0.05  # |disc speed − ball speed| over disc speed
OFFSET = 0.12  # N, zero reading of the force cell
ACCURACY = 1e-4


@dataclass(frozen=True)
class Interface:
    """Shear stress of the interface, Gaussian in log10 of slip speed times an Arrhenius factor.

    The form is that of B. Lorenz, Y. R. Oh, S. K. Nam, S. H. Jeon and B. N. J. Persson, J. Chem. Phys. 142 (2015)
    194701, doi 10.1063/1.4919221.
    """

    stress: float = 30e3  # Pa, its maximum
    width: float = 0.1  # of the Gaussian, per squared decade
    speed: float = 6e-3  # m/s, of the maximum at 30 °C
    energy: float = 88e3  # J/mol

    def coefficient(self, slip_speed: float, celsius: float, area: float, load: float) -> float:
        """Return the Coulomb friction coefficient: shear stress (Pa) times contact area (m²) over load (N)."""
        factor = self.energy / (8.314462618 * math.log(10.0)) * (1.0 / (celsius + 273.15) - 1.0 / 303.15)
        decades = math.log10(slip_speed / self.speed) + factor
        return self.stress * math.exp(-self.width * decades**2) * area / load


@dataclass(frozen=True)
class Test:
    """Synthetic sweeps and a synthetic friction test of the same rubber."""

    folder: str
    sweeps: tuple[float, ...]  # °C
    seed: int  # of the noise of the sweeps; one more for the friction
    temperatures: tuple[float, ...]  # °C
    speeds: tuple[float, ...]  # m/s
    load: float  # N
    replicates: int
    coulomb: float | Interface
    jitter: dict[str, float] = field(default_factory=dict)

    @property
    def planted(self) -> Path:
        """Return the file of the solved friction."""
        return PLANTED / f"planted_{Path(self.folder).name}_friction.csv"


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

#: Curves that overlap, small strain, sweeps without gaps over 15 decades.
EXAMPLE = Test(
    folder="example",
    sweeps=(*range(-20, 16, 4), 18, 24, *range(30, 151, 10)),
    seed=20261125,  # all checks pass with it, as with most others
    temperatures=(10.0, 20.0, 30.0, 45.0, 65.0, 90.0),
    speeds=tuple(np.geomspace(1e-3, 3.0, 13)),
    load=10.0,
    replicates=4,
    coulomb=Interface(),
    jitter={**JITTER, "force": 0.004},
)

#: The speeds, temperatures and load of the paper whose method this is.
PAPER = Test(
    folder="templates/paper",
    sweeps=tuple(np.arange(-30.0, 221.0, 10.0)),
    seed=20260301,
    temperatures=(30.0, 60.0, 90.0),
    speeds=tuple(np.geomspace(0.02, 0.2, 10)),
    load=25.0,
    replicates=8,
    coulomb=0.045,
    jitter=JITTER,
)


def make_dma(test: Test, path: Path) -> None:
    """Write frequency sweeps of the synthetic fluoroelastomer with 1 % multiplicative noise."""
    rubber = vf.synthetic_fluoroelastomer()
    random = np.random.default_rng(test.seed)
    lines = [
        "# SYNTHETIC data: computed from synthetic_fluoroelastomer, an assumed material; not a measurement.",
        f"# Uniaxial tension, {100 * NOISE:g} % multiplicative noise on each modulus, seed {test.seed}.",
        "# Made by scripts/make_synthetic_example.py.",
        "temperature (degC),frequency (Hz),E' (MPa),E'' (MPa)",
    ]
    for temperature in test.sweeps:
        modulus = rubber.complex_modulus(2.0 * math.pi * FREQUENCIES, f"{temperature} degC") / 1e6
        noise = 1.0 + NOISE * random.standard_normal((2, len(FREQUENCIES)))
        for frequency, storage, loss in zip(FREQUENCIES, noise[0] * modulus.real, noise[1] * modulus.imag, strict=True):
            lines.append(f"{temperature:.1f},{frequency:.6g},{storage:.6g},{loss:.6g}")
    _write(path, lines)


def solve_friction(test: Test, path: Path) -> None:
    """Solve the contacts of the friction test, once, and keep their results."""
    rubber = vf.synthetic_fluoroelastomer()
    lines = [
        f"# SYNTHETIC: friction of synthetic_fluoroelastomer, an assumed material, solved to {ACCURACY:g}.",
        "# Made by scripts/make_synthetic_example.py.",
        "temperature (degC),speed (m/s),friction,friction from dissipation,error estimate,contact area (m2)",
    ]
    for temperature in test.temperatures:
        for speed in test.speeds:
            solution = vf.solve_steady(
                rubber,
                vf.Ball(radius=BALL_RADIUS),
                speed=float(speed),
                load=test.load,
                temperature=f"{temperature} degC",
                accuracy=ACCURACY,
            )
            numbers = (
                solution.friction_coefficient,
                solution.energy_friction_coefficient,
                solution.diagnostics.friction_error,
                solution.contact_area,
            )
            lines.append(",".join([f"{temperature:g}", f"{speed:.17g}", *(f"{number:.8g}" for number in numbers)]))
            print(lines[-1], flush=True)
    _write(path, lines)


def make_mtm(test: Test, path: Path) -> None:
    """Write traction runs in four sign configurations, with offset, Coulomb friction and scatter."""
    random = np.random.default_rng(test.seed + 1)

    def scattered(value: float, kind: str) -> float:
        return value * (1.0 + test.jitter[kind] * random.standard_normal())

    if isinstance(test.coulomb, Interface):
        coulomb_words = "with Coulomb friction that depends on slip speed and temperature"
    else:
        coulomb_words = f"with Coulomb friction {test.coulomb:g}"
    lines = [
        "# SYNTHETIC data: viscoelastic friction computed from viscofric's synthetic_fluoroelastomer, an assumed",
        f"# material, {coulomb_words}, a force-cell offset of {OFFSET:g} N and scatter",
        f"# added (seed {test.seed + 1}); not a measurement.  Ball of radius {1e3 * BALL_RADIUS:g} mm.",
        "# Made by scripts/make_synthetic_example.py.",
        "temperature (degC),replicate,disc speed (mm/s),ball speed (mm/s),load (N),traction force (N)",
    ]
    rows = np.loadtxt(test.planted, delimiter=",", skiprows=3)
    for temperature, speed, friction, area in rows[:, [0, 1, 2, 5]]:
        coulomb = test.coulomb
        if isinstance(coulomb, Interface):
            coulomb = coulomb.coefficient(SLIP * speed, temperature, area, test.load)
        for replicate in range(1, test.replicates + 1):
            for direction in (-1.0, 1.0):
                for slip in (-1.0, 1.0):
                    load = scattered(test.load, "load")
                    force = (
                        OFFSET
                        + load * direction * scattered(friction, "viscoelastic")
                        + load * slip * scattered(coulomb, "coulomb")
                        + test.jitter["force"] * random.standard_normal()
                    )
                    disc = direction * scattered(speed, "speed")
                    ball = disc - slip * scattered(SLIP * speed, "speed")
                    measured = temperature + test.jitter["temperature"] * random.standard_normal()
                    lines.append(f"{measured:.2f},{replicate},{1e3 * disc:.3f},{1e3 * ball:.3f},{load:.3f},{force:.4f}")
    _write(path, lines)


def _write(path: Path, lines: list[str]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    for test in (EXAMPLE, PAPER):
        make_dma(test, PACKAGE / test.folder / "dma.csv")
        solve_friction(test, test.planted)
        make_mtm(test, PACKAGE / test.folder / "mtm.csv")
