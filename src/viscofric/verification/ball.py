"""Ball against reference values of an independent solver, and against the laws of low and of high speed."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files

from viscofric.contact.reference import high_speed_friction, high_speed_line_friction, low_speed_friction
from viscofric.rheology.material import Material
from viscofric.verification import model_problems as model
from viscofric.verification.check import Comparison, checks

check = checks("viscoelastic point contact")

ACCURACY = 1e-3
QUANTITIES = ("friction", "indentation", "front", "rear", "half_width", "area", "max_pressure")


@dataclass(frozen=True)
class BallReference:
    """One row of the reference table, in units of Hertz's contact at E0."""

    spectrum: str  # "one time", or a name of SPECTRA
    modulus_ratio: float  # k
    memory_length: float  # vτ/a0 of the longest mode
    values: dict[str, float]  # by the name of QUANTITIES
    errors: dict[str, float]  # by the name of QUANTITIES

    @property
    def case(self) -> str:
        """The problem in words."""
        return f"{self.spectrum}, k = {self.modulus_ratio:g}, vτ/a0 = {self.memory_length:g}"

    @property
    def material(self) -> Material:
        """The rubber."""
        if self.spectrum == "one time":
            return model.one_time(self.modulus_ratio, self.memory_length)
        return model.SPECTRA[self.spectrum](self.memory_length)


@lru_cache(maxsize=1)
def ball_references() -> tuple[BallReference, ...]:
    """Return the table of `ball_reference.csv`, which says where it comes from."""
    text = files("viscofric.verification").joinpath("ball_reference.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    return tuple(
        BallReference(
            spectrum=row["spectrum"],
            modulus_ratio=float(row["modulus_ratio"]),
            memory_length=float(row["memory_length"]),
            values={name: float(row[name]) for name in QUANTITIES},
            errors={name: float(row[f"{name}_error"]) for name in QUANTITIES},
        )
        for row in rows
    )


_FINER = 3e-4
_BOUNDS = {"friction": _FINER, "indentation": 5e-4, "area": 5e-3, "max_pressure": 2e-3}


@check(
    "ball-reference",
    "Ball: one retardation time, 25 and 37 modes over twelve decades",
    "an independent dense solver with its own kernel and algorithm, extrapolated over several grids",
    "Friction: the requested accuracy; the others converge with the same grids, the area to a quarter of a cell "
    "all along its rim. The reference's own error is added.",
)
def _references() -> Iterator[Comparison]:
    for row in ball_references():
        found = model.InHertzUnits.of(model.solve_ball(row.material, accuracy=_FINER))
        for name, bound in _BOUNDS.items():
            known = row.values[name]
            shown = {"friction": "friction μR/a0", "indentation": "indentation δR/a0²", "area": "area/πa0²"}
            yield Comparison(
                row.case,
                shown.get(name, "largest pressure/p0"),
                getattr(found, name),
                known,
                bound + row.errors[name] / known,
            )


_SLOW, _FAST = [1e-4, 5e-5, 1e-5], [1e7, 1e5, 1e6]


@check(
    "low-speed",
    "Friction at very low speed",
    "μ = (v/R) E0 Σ C_k τ_k: work of the lagging curvature on Hertz's pressure",
    "The requested accuracy, and the law's next term, of the order (vτ/a0) ln(vτ/a0) = 1e-3.",
)
def _low_speed() -> Iterator[Comparison]:
    material = model.rubber(10.0, [1.0, 2.0, 3.0], _SLOW)
    spectrum = material.modes_at()
    law = low_speed_friction(model.SPEED, model.RADIUS, spectrum.E0, spectrum.C, spectrum.tau) / model.SLOPE
    case = "three modes, vτ/a0 = 1e-5 to 1e-4, k = 10"
    cylinder = model.solve_cylinder(material, accuracy=ACCURACY).friction_coefficient / model.SLOPE
    yield Comparison(f"cylinder, {case}", "friction μR/a0", cylinder, law, 2e-3)
    ball = model.solve_ball(material, accuracy=5e-3).friction_coefficient / model.SLOPE
    yield Comparison(f"ball, {case}", "friction μR/a0", ball, law, 7e-3)


@check(
    "high-speed",
    "Friction at very high speed",
    "μ = (4/5)(a∞²/R) E∞ Σ C_k/(v τ_k), and Hunter's limit for the cylinder",
    "The requested accuracy, and the law's next term, of the order (k a∞/vτ) ln(vτ/k a∞), below 7e-3.",
)
def _high_speed() -> Iterator[Comparison]:
    material = model.rubber(100.0, [1.0, 2.0, 3.0], _FAST)
    spectrum = material.modes_at()
    modes = (spectrum.E_inf, model.POISSON_RATIO, spectrum.C, spectrum.tau)
    case = "three modes, vτ/a0 = 1e5 to 1e7, k = 100"
    law = high_speed_friction(model.SPEED, model.BALL_LOAD, model.RADIUS, *modes) / model.SLOPE
    ball = model.solve_ball(material, accuracy=ACCURACY).friction_coefficient / model.SLOPE
    yield Comparison(f"ball, {case}", "friction μR/a0", ball, law, 5e-3)
    law = high_speed_line_friction(model.SPEED, model.CYLINDER_LOAD, model.RADIUS, *modes) / model.SLOPE
    cylinder = model.solve_cylinder(material, accuracy=ACCURACY).friction_coefficient / model.SLOPE
    yield Comparison(f"cylinder, {case}", "friction μR/a0", cylinder, law, 1e-2)


@check(
    "energy-balance",
    "The pressure's asymmetry against the dissipated energy, ball and cylinder",
    "F_t v = dissipated power: another way to the same force, through −Im S",
    "Both converge with the grid, the slower one to three times the requested accuracy; a solution in which "
    "they differ by more is refused.",
)
def _energy() -> Iterator[Comparison]:
    for spectrum, ratio, memory in (
        ("one time", 2.0, 1.0),
        ("one time", 10.0, 1.0),
        ("one time", 10.0, 10.0),
        ("one time", 100.0, 100.0),
        ("25 modes", 10.0, 1e6),
        ("37 modes", 1000.0, 1e4),
        ("37 modes", 1000.0, 1e8),
    ):
        material = model.one_time(ratio, memory) if spectrum == "one time" else model.SPECTRA[spectrum](memory)
        case = f"{spectrum}, k = {ratio:g}, vτ/a0 = {memory:g}"
        # Where the two results differ the solver refines without end; these grids are finer than any that is needed.
        for name, solve, finest in (("ball", model.solve_ball, 256), ("cylinder", model.solve_cylinder, 4096)):
            found = solve(material, accuracy=ACCURACY, finest=finest)
            pressure, energy = found.pressure_friction_coefficient, found.energy_friction_coefficient
            yield Comparison(f"{name}, {case}", "dissipated over pressure", energy / pressure, 1.0, 3.0 * ACCURACY)
