"""Decrease of errors with the cell, on nested grids, and with the window, if a contact is repeated periodically."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.free.geometry import LINE, POINT, Geometry
from viscofric.contact.free.problem import Control, Problem
from viscofric.contact.free.scale import Scale, ScaledIndenter
from viscofric.contact.free.stage import Stage
from viscofric.contact.indenters.shapes import Ball
from viscofric.contact.operators.convolution import SteadyMaterial, collocation_shift
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.errors import ConvergenceError
from viscofric.verification import model_problems as model
from viscofric.verification.ball import ball_references
from viscofric.verification.check import Comparison, checks
from viscofric.verification.engine import backend, solve_periodic
from viscofric.verification.line import hunter

check = checks("refinement")


@dataclass(frozen=True)
class Refinement:
    """Relative errors on nested grids."""

    name: str  # of the problem
    exact: str  # source of its exact numbers
    cells: Array  # (n,), along the window's longer edge
    errors: dict[str, Array]  # (n,), relative, signed, by quantity
    least: dict[str, float]  # least order required, by quantity
    floor: dict[str, float]  # error of the reference, by quantity; errors below twice that are not significant

    def order(self, quantity: str) -> float:
        """Slope of log error against log cell by least squares: single errors jump as cells cross an edge."""
        size = np.abs(self.errors[quantity])
        significant = size > 2.0 * self.floor[quantity]
        return float(-np.polyfit(np.log(self.cells[significant]), np.log(size[significant]), 1)[0])


def stages(geometry: Geometry, solid: SteadyMaterial, extent: tuple[float, float, float], grids: int) -> list[Stage]:
    """Solve on nested grids of 32, 64, … cells over −rear … front and ±side, in units of Hertz's contact at E0."""
    shape = ScaledIndenter(Ball(1.0), Scale(geometry, 1.0, 1.0, 1.0))  # whose section at y = 0 is that of a cylinder
    problem = Problem(geometry, solid, shape, Control(load=geometry.parabolic_load), 1e-9, backend())
    window = geometry.around(*extent, 32)
    pressure = np.ones(window.shape)
    found: list[Stage] = []
    for _ in range(grids):
        shift = collocation_shift(solid, window.spacing)
        operator = geometry.operator(window, solid, shift, problem.backend)
        height = problem.shape.height(window.x[:, None] - shift * window.spacing, window.y)
        result = problem.control.solve(operator, height, pressure, problem.tolerance)
        if not result.converged:
            raise ConvergenceError(
                f"the contact did not converge on {window.shape[0]} x {window.shape[1]} cells.", code="not-converged"
            )
        found.append(Stage(problem, window, operator, result))
        finer = window.refined()
        pressure, window = window.resample(result.pressure, finer), finer
    return found


def _refinement(
    name: str,
    exact: str,
    found: list[Stage],
    known: dict[str, tuple[float, float, float]],
) -> Refinement:
    """Compare nested grids with exact numbers: quantity -> (number, its relative error, least order)."""
    read = {
        "friction μ, pressure": lambda stage: stage.pressure_friction,
        "friction μ, energy": lambda stage: stage.energy_friction,
        "indentation δ": lambda stage: stage.indentation,
        "contact area": lambda stage: stage.footprint.area,
        "contact width": lambda stage: stage.footprint.area,
    }
    return Refinement(
        name,
        exact,
        np.array([max(stage.window.shape) for stage in found]),
        {
            quantity: np.array([read[quantity](stage) for stage in found]) / number - 1.0
            for quantity, (number, _, _) in known.items()
        },
        {quantity: order for quantity, (_, _, order) in known.items()},
        {quantity: error for quantity, (_, error, _) in known.items()},
    )


def _one_time(modulus_ratio: float, memory_length: float) -> SteadyMaterial:
    return SteadyMaterial(1.0 / modulus_ratio, np.array([1.0 - 1.0 / modulus_ratio]), np.array([memory_length]))


def elastic_ball() -> Refinement:
    """Solve Hertz's contact on 32² to 512² cells."""
    found = stages(POINT, SteadyMaterial(1.0, np.empty(0), np.empty(0)), (1.3, 1.3, 1.3), 5)
    known = {"indentation δ": (1.0, 1e-9, 1.4), "contact area": (math.pi, 1e-9, 0.8)}
    return _refinement("ball, elastic", "Hertz", found, known)


def viscoelastic_ball() -> Refinement:
    """Solve the ball on a rubber with one retardation time, k = 10, vτ/a0 = 1, on 32² to 512² cells."""
    (row,) = (
        one
        for one in ball_references()
        if (one.spectrum, one.modulus_ratio, one.memory_length) == ("one time", 10.0, 1.0)
    )
    known = {
        label: (row.values[name], row.errors[name] / row.values[name], order)
        for label, name, order in (
            ("friction μ, pressure", "friction", 1.4),
            ("friction μ, energy", "friction", 1.4),
            ("indentation δ", "indentation", 1.4),
        )
    }
    found = stages(POINT, _one_time(10.0, 1.0), (0.5, 1.1, 1.1), 5)
    return _refinement("ball, k = 10, vτ/a0 = 1", "the reference value", found, known)


def viscoelastic_cylinder() -> Refinement:
    """Solve the cylinder on the same rubber on 32 to 4096 cells."""
    exact = hunter(10.0, 1.0)
    friction, width = exact.friction_coefficient / model.SLOPE, 2.0 * exact.half_width / model.HERTZ_RADIUS
    known = {
        "friction μ, pressure": (friction, 1e-12, 1.4),
        "friction μ, energy": (friction, 1e-12, 1.4),
        "contact width": (width, 1e-12, 0.8),
    }
    found = stages(LINE, _one_time(10.0, 1.0), (0.45, 1.1, 0.0), 8)
    return _refinement("cylinder, k = 10, vτ/a0 = 1", "Hunter's closed form", found, known)


REFINEMENTS = (elastic_ball, viscoelastic_ball, viscoelastic_cylinder)


@check(
    "orders",
    "Errors fall with the cell h: orders of convergence",
    "Hertz, Hunter, and the reference value of the ball",
    "Errors of sums over the contact, where pressures end like a square root, fall at least as h^1.5; areas "
    "depend on the edge itself and are of first order. The scatter of single grids (position of the edge in "
    "its cell) changes the observed order by a tenth or two.",
)
def _orders() -> Iterator[Comparison]:
    for make in REFINEMENTS:
        found = make()
        case = f"{found.name}, {found.cells[0]} to {found.cells[-1]} cells"
        for quantity, least in found.least.items():
            yield Comparison(case, f"order of {quantity}", found.order(quantity), least, 0.0, "at least")
        for quantity, errors in found.errors.items():
            finest = 2e-3 if quantity.startswith("contact") else 1e-5 + 2.0 * found.floor[quantity]
            yield Comparison(case, f"{quantity} on the finest grid", float(errors[-1]) + 1.0, 1.0, finest)


MODULUS_RATIO, MEMORY_LENGTH = 10.0, 10.0
PERIODS = (2.4, 4.8, 9.6, 19.2, 38.4)  # a0
_CELLS = 32  # to the shortest period


@dataclass(frozen=True)
class Windows:
    """Friction of a ball that is repeated along x and y, compared with that of one ball alone."""

    periods: Array  # (n,), over a0
    friction: Array  # (n,), μR/a0
    free: float  # μR/a0 of one ball on the free half-space

    @property
    def deviations(self) -> Array:
        """Relative differences from the free contact."""
        return self.friction / self.free - 1.0

    @property
    def orders(self) -> Array:
        """Order of the approach from each period to the next."""
        size = np.abs(self.deviations)
        return np.asarray(np.log(size[:-1] / size[1:]) / np.log(self.periods[1:] / self.periods[:-1]))


def windows() -> Windows:
    """Solve the periodic contacts and the free one."""
    material = model.one_time(MODULUS_RATIO, MEMORY_LENGTH)
    cell = PERIODS[0] * model.HERTZ_RADIUS / _CELLS
    friction = []
    for period in PERIODS:
        cells = round(period * model.HERTZ_RADIUS / cell)
        x = cell * (np.arange(cells) - 0.5 * cells + 0.5)
        surface = PeriodicSurface(-(x[:, None] ** 2 + x**2) / (2.0 * model.RADIUS), cell)
        pressure = model.BALL_LOAD / (cells * cell) ** 2
        found = solve_periodic(material, surface, speed=model.SPEED, pressure=pressure, tolerance=1e-7)
        friction.append(found.friction_coefficient / model.SLOPE)
    return Windows(np.array(PERIODS), np.array(friction), model.solve_ball(material).friction_coefficient / model.SLOPE)


@check(
    "large-windows",
    "A ball repeated in periods of 2.4 to 38.4 a0",
    "one ball on the free half-space, solved without Fourier space's periodicity",
    "The memory length is 10 a0; for longer periods, the effect of the periodic images falls at least as the inverse "
    "square of the period. In the largest window it is 1 %, and the cells of 0.075 a0 add a few tenths of a per cent.",
)
def _windows() -> Iterator[Comparison]:
    found = windows()
    case = f"k = {MODULUS_RATIO:g}, vτ/a0 = {MEMORY_LENGTH:g}"
    deviations = found.deviations
    for period, before, after in zip(found.periods[1:], deviations, deviations[1:], strict=False):
        left = f"share of the deviation left at {period:.3g} a0"
        yield Comparison(case, left, abs(float(after / before)), 0.8, 0.0, "at most")
    last = f"friction μR/a0 at {found.periods[-1]:.3g} a0"
    yield Comparison(case, last, float(found.friction[-1]), found.free, 0.02)
    yield Comparison(case, "order of the last doubling", float(found.orders[-1]), 2.0, 0.0, "at least")
