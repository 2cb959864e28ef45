"""Model problems of contact mechanics with known answers, shared by tests, benchmarks and docs.

Each problem is a ball or a cylinder sliding over a viscoelastic half-space, stated in ordinary units (1 MPa, 10 mm,
0.1 m/s) but described by two or three pure numbers.  Lengths are counted in the Hertz radius a0, depths in a0²/R,
friction in a0/R and pressures in p0, all of the elastic contact at E0 under the same load.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viscofric.contact.indenters.shapes import Ball, Cylinder
from viscofric.contact.reference import hertz_ball
from viscofric.contact.solution import ContactSolution
from viscofric.contact.steady import solve_steady
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.verification.ball import BallReference as Row
from viscofric.verification.ball import ball_references

RUBBER_MODULUS = 1e6  # Pa
POISSON_RATIO = 0.5
BALL_RADIUS = 10e-3  # m
HERTZ_RADIUS = 0.5e-3  # m: a0/R = 0.05, well within small strain
LOAD = 4.0 * RUBBER_MODULUS * HERTZ_RADIUS**3 / (3.0 * BALL_RADIUS * (1.0 - POISSON_RATIO**2))  # N
SPEED = 0.1  # m/s


@dataclass(frozen=True)
class BallProblem:
    """A ball on a half-space in steady motion; solve it, or look at its ingredients.

    Attributes
    ----------
    name : str
    material : Material
    ball : Ball
    speed, load : float
        m/s and N.
    """

    name: str
    material: Material
    ball: Ball
    speed: float
    load: float

    def solve(self, **settings: float) -> ContactSolution:
        """Solve with `solve_steady`, `settings` being its accuracy, tolerance and finest grid."""
        return solve_steady(self.material, self.ball, speed=self.speed, load=self.load, **settings)  # type: ignore[arg-type]

    @property
    def hertz_radius(self) -> float:
        """a0, the contact radius at E0 under the same load, m."""
        radius = float(self.ball.radius)  # type: ignore[arg-type]
        return hertz_ball(self.load, radius, self.material.spectrum.E0, self.material.poisson_ratio).radius


@dataclass(frozen=True)
class HertzUnits:
    """What a solution says, in pure numbers: units of the Hertz contact at E0.

    `friction` is μR/a0, `pressure_friction`, `energy_friction` and `friction_error` likewise; `indentation` is
    δR/a0²; `front`, `rear`, `side` and `cell` are lengths over a0; `area` is over πa0² and `max_pressure` over p0.
    """

    friction: float
    pressure_friction: float
    energy_friction: float
    friction_error: float
    indentation: float
    front: float
    rear: float
    side: float
    area: float
    max_pressure: float
    cell: float


def in_hertz_units(problem: BallProblem, solution: ContactSolution) -> HertzUnits:
    """Express a solution in the units of the Hertz contact at E0 (a0, a0²/R, a0/R, πa0², p0)."""
    radius = float(problem.ball.radius)  # type: ignore[arg-type]
    a0 = problem.hertz_radius
    return HertzUnits(
        friction=solution.friction_coefficient * radius / a0,
        pressure_friction=solution.pressure_friction_coefficient * radius / a0,
        energy_friction=solution.energy_friction_coefficient * radius / a0,
        friction_error=solution.diagnostics.friction_error * radius / a0,
        indentation=solution.indentation * radius / a0**2,
        front=solution.front / a0,
        rear=solution.rear / a0,
        side=solution.half_width / a0,
        area=solution.contact_area / (np.pi * a0**2),
        max_pressure=solution.max_pressure / (1.5 * problem.load / (np.pi * a0**2)),
        cell=solution.diagnostics.spacing / a0,
    )


def ball_problem(
    name: str, modulus_ratio: float, shares: Sequence[float], memory_lengths: Sequence[float]
) -> BallProblem:
    """Return a ball problem from pure numbers.

    Parameters
    ----------
    name : str
    modulus_ratio : float
        k = E∞/E0.
    shares : (m,) sequence
        C_k in any common unit; scaled so that they add up to 1/E0 − 1/E∞.
    memory_lengths : (m,) sequence
        v τ_k / a0.
    """
    shares_array = np.asarray(shares, dtype=float)
    total = (1.0 - 1.0 / modulus_ratio) / RUBBER_MODULUS
    spectrum = RetardationSpectrum(
        E0=RUBBER_MODULUS,
        E_inf=modulus_ratio * RUBBER_MODULUS,
        C=total * shares_array / shares_array.sum(),
        tau=np.asarray(memory_lengths, dtype=float) * HERTZ_RADIUS / SPEED,
    )
    material = Material(spectrum, poisson_ratio=POISSON_RATIO)
    return BallProblem(name, material, Ball(radius=BALL_RADIUS), SPEED, LOAD)


def standard_linear_solid(modulus_ratio: float, memory_length: float) -> BallProblem:
    """Return a ball on a material with one retardation time: k = E∞/E0 and vτ/a0."""
    return ball_problem(
        f"one retardation time, k = {modulus_ratio:g}, vτ/a0 = {memory_length:g}",
        modulus_ratio,
        [1.0],
        [memory_length],
    )


def broad_spectrum_25(memory_length: float) -> BallProblem:
    """Return a ball on 25 equal modes, two a decade over twelve decades up to vτ/a0, with k = 10."""
    decades = np.arange(25) / 2.0 - 12.0
    return ball_problem(
        f"25 modes, k = 10, vτ_max/a0 = {memory_length:g}", 10.0, np.ones(25), memory_length * 10.0**decades
    )


def broad_spectrum_37(memory_length: float) -> BallProblem:
    """Return a ball on 37 modes, C_k ∝ τ_k^(1/4), three a decade up to vτ/a0, with k = 1000."""
    decades = np.arange(37) / 3.0 - 12.0
    return ball_problem(
        f"37 modes, k = 1000, vτ_max/a0 = {memory_length:g}",
        1000.0,
        10.0 ** (decades / 4.0),
        memory_length * 10.0**decades,
    )


@dataclass(frozen=True)
class Known:
    """A reference value and its error bar."""

    value: float
    error: float


@dataclass(frozen=True)
class BallReference:
    """A ball problem with its answer in Hertz units of E0, from an independent dense solution.

    The values come from a solver with its own kernel and its own complementarity algorithm, extrapolated over
    several grids; the error bars are that solver's own estimates.
    """

    problem: BallProblem
    friction: Known
    indentation: Known
    front: Known
    rear: Known
    side: Known
    area: Known
    max_pressure: Known


def _reference(row: Row) -> BallReference:
    if row.spectrum == "one time":
        problem = standard_linear_solid(row.modulus_ratio, row.memory_length)
    else:
        problem = {"25 modes": broad_spectrum_25, "37 modes": broad_spectrum_37}[row.spectrum](row.memory_length)
    known = {name: Known(value, row.errors[name]) for name, value in row.values.items()}
    return BallReference(problem, side=known.pop("half_width"), **known)


#: The table that `viscofric verify` is held against too.
BALL_REFERENCES = tuple(_reference(row) for row in ball_references())


CYLINDER_LOAD = np.pi * RUBBER_MODULUS * HERTZ_RADIUS**2 / (4.0 * BALL_RADIUS * (1.0 - POISSON_RATIO**2))  # N/m


@dataclass(frozen=True)
class CylinderProblem:
    """A cylinder on a half-space in steady motion, its Hertz half-width at E0 being `HERTZ_RADIUS`.

    Attributes
    ----------
    name : str
    material : Material
    cylinder : Cylinder
    speed, load : float
        m/s and N/m.
    """

    name: str
    material: Material
    cylinder: Cylinder
    speed: float
    load: float

    def solve(self, **settings: float) -> ContactSolution:
        """Solve with `solve_steady`, `settings` being its accuracy, tolerance and finest grid."""
        return solve_steady(self.material, self.cylinder, speed=self.speed, load=self.load, **settings)  # type: ignore[arg-type]


def cylinder_problem(
    name: str, modulus_ratio: float, shares: Sequence[float], memory_lengths: Sequence[float]
) -> CylinderProblem:
    """Return a cylinder problem from pure numbers, as `ball_problem` does."""
    ball = ball_problem(name, modulus_ratio, shares, memory_lengths)
    return CylinderProblem(name, ball.material, Cylinder(radius=BALL_RADIUS), SPEED, CYLINDER_LOAD)


def cylinder_on_standard_linear_solid(modulus_ratio: float, memory_length: float) -> CylinderProblem:
    """Return a cylinder on a material with one retardation time: k = E∞/E0 and vτ/a0."""
    name = f"cylinder, one retardation time, k = {modulus_ratio:g}, vτ/a0 = {memory_length:g}"
    return cylinder_problem(name, modulus_ratio, [1.0], [memory_length])


def low_speed_friction(problem: BallProblem, speed: float | None = None) -> float:
    """μ of the limit v → 0: (v/R) Σ C_k τ_k E0, for a ball as for a cylinder."""
    spectrum = problem.material.spectrum
    creep = spectrum.E0 * float(np.dot(spectrum.C, spectrum.tau))
    return (problem.speed if speed is None else speed) / float(problem.ball.radius) * creep  # type: ignore[arg-type]


def high_speed_friction(problem: BallProblem, speed: float | None = None) -> float:
    """μ of the limit v → ∞: (4/5) k^(1/3) (a0/R) Σ c_k/l_k with c_k = C_k E0 and l_k = v τ_k/a0."""
    spectrum = problem.material.spectrum
    a0, velocity = problem.hertz_radius, problem.speed if speed is None else speed
    rates = float(np.sum(spectrum.E0 * spectrum.C * a0 / (velocity * spectrum.tau)))
    slope = a0 / float(problem.ball.radius)  # type: ignore[arg-type]
    return 0.8 * (spectrum.E_inf / spectrum.E0) ** (1.0 / 3.0) * slope * rates
