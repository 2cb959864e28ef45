"""Decrease of errors with the cell: elastic and viscoelastic contacts on nested grids, and the observed order."""

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
from viscofric.errors import ConvergenceError
from viscofric.verification.ball import ball_references
from viscofric.verification.check import Check, Comparison
from viscofric.verification.engine import backend
from viscofric.verification.line import hunter
from viscofric.verification.model_problems import HERTZ_RADIUS, SLOPE


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
    friction, width = exact.friction_coefficient / SLOPE, 2.0 * exact.half_width / HERTZ_RADIUS
    known = {
        "friction μ, pressure": (friction, 1e-12, 1.4),
        "friction μ, energy": (friction, 1e-12, 1.4),
        "contact width": (width, 1e-12, 0.8),
    }
    found = stages(LINE, _one_time(10.0, 1.0), (0.45, 1.1, 0.0), 8)
    return _refinement("cylinder, k = 10, vτ/a0 = 1", "Hunter's closed form", found, known)


REFINEMENTS = (elastic_ball, viscoelastic_ball, viscoelastic_cylinder)


def _orders() -> Iterator[Comparison]:
    for make in REFINEMENTS:
        found = make()
        case = f"{found.name}, {found.cells[0]} to {found.cells[-1]} cells"
        for quantity, least in found.least.items():
            yield Comparison(case, f"order of {quantity}", found.order(quantity), least, 0.0, "at least")
        for quantity, errors in found.errors.items():
            finest = 2e-3 if quantity.startswith("contact") else 1e-5 + 2.0 * found.floor[quantity]
            yield Comparison(case, f"{quantity} on the finest grid", float(errors[-1]) + 1.0, 1.0, finest)


CHECKS = (
    Check(
        "orders",
        "Errors fall with the cell h: orders of convergence",
        "refinement",
        "Hertz, Hunter, and the reference value of the ball",
        "Errors of sums over the contact, where pressures end like a square root, fall at least as h^1.5; areas "
        "depend on the edge itself and are of first order. The scatter of single grids (position of the edge in "
        "its cell) changes the observed order by a tenth or two.",
        _orders,
    ),
)
