"""Pressures on one and the same grid: the solver against dense block pivoting with its own kernel."""

from __future__ import annotations

import numpy as np
import pytest

from contact.dense_reference import (
    dense_friction,
    displacement_coefficients,
    displacement_matrix,
    solve_dense_contact,
)
from gallery import BALL_RADIUS, BALL_REFERENCES, HERTZ_RADIUS, POISSON_RATIO, BallReference, standard_linear_solid
from viscofric.contact.complementarity import solve_complementarity
from viscofric.contact.grids import Window
from viscofric.contact.operator import HalfSpaceOperator, SteadyMaterial

MATERIALS = {
    "elastic": SteadyMaterial(1.0, np.empty(0), np.empty(0)),
    "one mode": SteadyMaterial(0.1, np.array([0.9]), np.array([1.0])),
    "one mode, slow": SteadyMaterial(0.1, np.array([0.9]), np.array([0.02])),
    "one mode, k = 1000": SteadyMaterial(0.001, np.array([0.999]), np.array([20.0])),
    "six modes": SteadyMaterial(
        0.01, np.array([0.29, 0.2, 0.2, 0.1, 0.1, 0.1]), np.array([1e-5, 1e-3, 0.1, 1.0, 30.0, 1e4])
    ),
}


@pytest.mark.parametrize("name", MATERIALS)
def test_pressure_is_that_of_dense_pivoting(name: str) -> None:
    material = MATERIALS[name]
    window = Window(spacing=2.4 / 28, behind=14, ahead=14, beside=12)
    nx, ny = window.shape
    height = 0.5 * (window.x[:, None] ** 2 + window.y**2)
    load = 4.0 / 3.0 / window.cell_area
    coefficients = displacement_coefficients(
        nx, ny, window.spacing, material.glassy, material.compliances, material.memory_lengths
    )
    matrix = displacement_matrix(coefficients, nx, ny)
    dense = solve_dense_contact(matrix, height.ravel(), load)
    guess = np.maximum(0.0, 1.0 - window.x[:, None] ** 2 - window.y**2)
    operator = HalfSpaceOperator(window, material)
    solution = solve_complementarity(operator, height, load, guess, tolerance=1e-11)
    assert solution.converged
    scale = dense.pressure.max()
    # A gap of 1e-11 of the indentation takes a pressure error of about 1e-11 k times the condition of the
    # finest grid wave (under 1e3) in the worst case; 1e-7 keeps clear of it for k = 1000 as well.
    np.testing.assert_allclose(solution.pressure.ravel(), dense.pressure, rtol=0.0, atol=1e-7 * scale)
    assert solution.indentation == pytest.approx(dense.indentation, rel=1e-9)  # tolerance and kernel errors


def test_solution_keeps_its_conditions() -> None:
    window = Window(spacing=0.1, behind=13, ahead=13, beside=13)
    height = 0.5 * (window.x[:, None] ** 2 + window.y**2)
    load = 4.0 / 3.0 / window.cell_area
    operator = HalfSpaceOperator(window, MATERIALS["one mode"])
    solution = solve_complementarity(operator, height, load, np.ones(window.shape), tolerance=1e-8)
    gap = operator(solution.pressure) + height - solution.indentation
    assert solution.pressure.min() >= 0.0
    assert solution.pressure.sum() == pytest.approx(load, rel=1e-12)  # scaled to the load: round-off
    assert gap.min() >= -1.1e-8 * solution.indentation  # the tolerance asked for
    assert np.abs(gap[solution.pressure > 0.0]).max() <= 1.1e-8 * solution.indentation


def test_answer_does_not_depend_on_the_guess() -> None:
    window = Window(spacing=0.1, behind=13, ahead=13, beside=13)
    height = 0.5 * (window.x[:, None] ** 2 + window.y**2)
    load = 4.0 / 3.0 / window.cell_area
    operator = HalfSpaceOperator(window, MATERIALS["six modes"])
    spike = np.zeros(window.shape)
    spike[20, 4] = 1.0
    one, other = (
        solve_complementarity(operator, height, load, guess, tolerance=1e-10).pressure
        for guess in (np.ones(window.shape), spike)
    )
    # Two solutions of the same unique problem, each with its residual (see above).
    np.testing.assert_allclose(one, other, rtol=0.0, atol=1e-6 * one.max())


def test_failure_is_told() -> None:
    window = Window(spacing=0.1, behind=13, ahead=13, beside=13)
    height = 0.5 * (window.x[:, None] ** 2 + window.y**2)
    operator = HalfSpaceOperator(window, MATERIALS["one mode"])
    solution = solve_complementarity(operator, height, 100.0, np.ones(window.shape), most_products=3)
    assert not solution.converged


@pytest.mark.parametrize(
    "reference", [BALL_REFERENCES[0], BALL_REFERENCES[2], BALL_REFERENCES[3]], ids=lambda r: r.problem.name
)
def test_dense_friction_is_good_to_a_percent(reference: BallReference) -> None:
    """The second opinion itself, on one coarse grid, against values extrapolated from much finer ones."""
    spectrum, problem = reference.problem.material.spectrum, reference.problem
    friction, indentation = dense_friction(
        spectrum.E0, spectrum.E_inf, spectrum.C, spectrum.tau, POISSON_RATIO, BALL_RADIUS,
        problem.load, problem.speed, cells=28,
    )  # fmt: skip
    # Discretisation with about 24 cells across the contact: a few thousandths were seen.
    assert friction * BALL_RADIUS / HERTZ_RADIUS == pytest.approx(reference.friction.value, rel=0.01)
    assert indentation * BALL_RADIUS / HERTZ_RADIUS**2 == pytest.approx(reference.indentation.value, rel=0.003)


@pytest.mark.parametrize(("modulus_ratio", "memory_length"), [(1000.0, 1.0), (1e4, 0.3)])
def test_hard_corner_agrees_with_dense_pivoting(modulus_ratio: float, memory_length: float) -> None:
    """One mode, a very stiff glass and memory of the contact's size: the operator is nearly skew on any usable grid."""
    problem = standard_linear_solid(modulus_ratio, memory_length)
    spectrum = problem.material.spectrum
    friction, indentation = dense_friction(
        spectrum.E0, spectrum.E_inf, spectrum.C, spectrum.tau, POISSON_RATIO, BALL_RADIUS,
        problem.load, problem.speed, cells=36,
    )  # fmt: skip
    solution = problem.solve(accuracy=2e-3)
    assert solution.diagnostics.complementarity <= 1e-8
    # Some 30 cells across the contact leave a few thousandths, as for the easier contacts above.
    assert solution.friction_coefficient == pytest.approx(friction, rel=0.01)
    assert solution.indentation == pytest.approx(indentation, rel=0.003)
