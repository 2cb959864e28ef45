"""Pressures on one and the same grid: the solver against dense block pivoting with its own kernel."""

from __future__ import annotations

import math

import numpy as np
import pytest

from contact.dense_reference import (
    dense_friction,
    displacement_coefficients,
    displacement_matrix,
    solve_dense_contact,
)
from contact.made_surfaces import self_affine
from gallery import BALL_RADIUS, BALL_REFERENCES, HERTZ_RADIUS, POISSON_RATIO, BallReference, standard_linear_solid
from marks import apart, slow
from viscofric.arrays import Array
from viscofric.contact.complementarity import (
    ComplementaritySolution,
    KnownChanges,
    solve_complementarity,
    solve_many_spots,
    solve_on_contact,
)
from viscofric.contact.extension import Extension
from viscofric.contact.free.grids import Grid
from viscofric.contact.operators.convolution import SteadyMaterial
from viscofric.contact.operators.half_space import HalfSpaceOperator
from viscofric.contact.periodic.operator import PeriodicOperator

MATERIALS = {
    "elastic": SteadyMaterial(1.0, np.empty(0), np.empty(0)),
    "one mode": SteadyMaterial(0.1, np.array([0.9]), np.array([1.0])),
    "one mode, slow": SteadyMaterial(0.1, np.array([0.9]), np.array([0.02])),
    "one mode, k = 1000": SteadyMaterial(0.001, np.array([0.999]), np.array([20.0])),
    "six modes": SteadyMaterial(
        0.01, np.array([0.29, 0.2, 0.2, 0.1, 0.1, 0.1]), np.array([1e-5, 1e-3, 0.1, 1.0, 30.0, 1e4])
    ),
}
#: A paraboloid of unit curvature over 26 cells of a tenth each way.
WINDOW = Grid(spacing=0.1, behind=13, ahead=13, beside=13)
PARABOLOID = 0.5 * (WINDOW.x[:, None] ** 2 + WINDOW.y**2)
#: Depths below the summit of a rough surface, over its rms height.
ROUGH = (lambda z: (z.max() - z) / z.std())(self_affine(128))


@pytest.mark.parametrize("name", ["elastic", "one mode", *apart("one mode, slow", "one mode, k = 1000", "six modes")])
@pytest.mark.slow
def test_pressure_is_that_of_dense_pivoting(name: str) -> None:
    material = MATERIALS[name]
    window = Grid(spacing=2.4 / 20, behind=10, ahead=10, beside=9)
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
    load = 4.0 / 3.0 / WINDOW.cell_area
    operator = HalfSpaceOperator(WINDOW, MATERIALS["one mode"])
    solution = solve_complementarity(operator, PARABOLOID, load, np.ones(WINDOW.shape), tolerance=1e-8)
    gap = operator(solution.pressure) + PARABOLOID - solution.indentation
    assert solution.pressure.min() >= 0.0
    assert solution.pressure.sum() == pytest.approx(load, rel=1e-12)  # scaled to the load: round-off
    assert gap.min() >= -1.1e-8 * solution.indentation  # the tolerance asked for
    assert np.abs(gap[solution.pressure > 0.0]).max() <= 1.1e-8 * solution.indentation


def test_answer_does_not_depend_on_the_guess() -> None:
    load = 4.0 / 3.0 / WINDOW.cell_area
    operator = HalfSpaceOperator(WINDOW, MATERIALS["six modes"])
    spike = np.zeros(WINDOW.shape)
    spike[20, 4] = 1.0
    one, other = (
        solve_complementarity(operator, PARABOLOID, load, guess, tolerance=1e-10).pressure
        for guess in (np.ones(WINDOW.shape), spike)
    )
    # Two solutions of the same unique problem, each with its residual (see above).
    np.testing.assert_allclose(one, other, rtol=0.0, atol=1e-6 * one.max())


@pytest.mark.parametrize("name", ["elastic", "one mode", "six modes"])
def test_given_indentation_and_given_load_meet(name: str) -> None:
    operator = HalfSpaceOperator(WINDOW, MATERIALS[name])
    loaded = solve_complementarity(operator, PARABOLOID, 100.0, np.ones(WINDOW.shape), tolerance=1e-11)
    indented = solve_complementarity(
        operator, PARABOLOID, None, np.zeros(WINDOW.shape), indentation=loaded.indentation, tolerance=1e-11
    )
    assert indented.converged
    assert indented.load == 0.0
    # Both residuals, times the condition of the finest grid wave (see above).
    np.testing.assert_allclose(indented.pressure, loaded.pressure, rtol=0.0, atol=1e-8 * loaded.pressure.max())
    assert indented.pressure.sum() == pytest.approx(100.0, rel=1e-8)


def test_too_little_indentation_leaves_no_contact() -> None:
    window = Grid(spacing=0.1, behind=13, ahead=13, beside=13)
    height = 1.0 + 0.5 * (window.x[:, None] ** 2 + window.y**2)
    operator = HalfSpaceOperator(window, MATERIALS["one mode"])
    solution = solve_complementarity(operator, height, None, np.zeros(window.shape), indentation=0.9)
    assert solution.converged
    assert not solution.pressure.any()


def test_way_of_tightening_leaves_the_answer() -> None:
    operator = HalfSpaceOperator(WINDOW, MATERIALS["six modes"])
    one = solve_complementarity(operator, PARABOLOID, 100.0, np.ones(WINDOW.shape), tolerance=1e-10)
    other = solve_complementarity(
        operator, PARABOLOID, 100.0, np.ones(WINDOW.shape), tolerance=1e-10, tighten="near the end"
    )
    assert one.converged
    assert other.converged
    assert 0.0 < other.linear < 1.0
    np.testing.assert_allclose(one.pressure, other.pressure, rtol=0.0, atol=1e-6 * one.pressure.max())


@pytest.mark.parametrize("given", ["load", "indentation"])
def test_set_chosen_at_every_step_leaves_the_answer(given: str) -> None:
    operator = HalfSpaceOperator(WINDOW, MATERIALS["six modes"])
    one = solve_complementarity(operator, PARABOLOID, 100.0, np.ones(WINDOW.shape), tolerance=1e-12)
    other = solve_many_spots(
        operator, PARABOLOID, 100.0 if given == "load" else None, np.ones(WINDOW.shape),
        indentation=None if given == "load" else one.indentation, tolerance=1e-10, most_products=200, inner=operator,
        patience=10, directions=6, extension=Extension(operator.backend, WINDOW.shape, np.float64), doubt=0.0,
    )  # fmt: skip
    assert other.converged
    gap = operator(other.pressure) + PARABOLOID - other.indentation
    assert max(np.abs(gap[other.pressure > 0.0]).max(), -gap.min()) <= 1e-10
    np.testing.assert_allclose(other.displacement, operator(other.pressure), rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(one.pressure, other.pressure, rtol=0.0, atol=1e-6 * one.pressure.max())


def elastic_spots(load: float, guess: Array, most_products: int = 200) -> ComplementaritySolution:
    """Contact of an elastic solid with `ROUGH`, under a mean pressure, from a guess, in steps of one product each."""
    points = len(ROUGH)
    q = np.hypot(np.fft.fftfreq(points)[:, None], np.fft.rfftfreq(points)) * points
    operator = PeriodicOperator(np.divide(1.0, q, out=np.zeros_like(q), where=q > 0.0), ROUGH.shape)
    return solve_many_spots(
        operator, ROUGH, load * points**2, guess, indentation=None, tolerance=1e-8, most_products=most_products,
        inner=operator, patience=20, directions=12, doubt=2.0,
        extension=Extension(operator.backend, ROUGH.shape, np.float64, inverse=operator.inverse),
    )  # fmt: skip


def test_edges_of_spots_are_found_before_their_level_is_right() -> None:
    """Cells join by the overlap that the step will leave, not by what spots have too much as a whole."""
    right = elastic_spots(0.1, np.maximum(ROUGH.mean() - ROUGH, 0.0))
    less = elastic_spots(0.08, right.pressure)
    found = elastic_spots(0.1, less.pressure, most_products=3)
    wrong = [int(np.sum((each.pressure > 0.0) != (right.pressure > 0.0))) for each in (less, found)]
    # 7 of 117 were seen, and 117 where cells joined by their overlap alone.
    assert wrong[1] < 0.2 * wrong[0]


def test_cells_do_not_come_and_go_forever_from_a_poor_start() -> None:
    """From 60 times the cells: many that have left seem to come back in the next step, and do not overlap."""
    found = elastic_spots(0.02, np.maximum(ROUGH.mean() - ROUGH, 0.0))
    assert found.converged


@pytest.mark.parametrize("fixed_load", [True, False])
def test_known_displacements_belong_to_their_changes_when_cells_enter_and_leave(fixed_load: bool) -> None:
    """Those that enter were beside the contact, and those that leave stay beside it for as long as they are known."""
    points, random = 16, np.random.default_rng(0)
    q = np.hypot(np.fft.fftfreq(points)[:, None], np.fft.rfftfreq(points))
    q[0, 0] = 1.0
    operator = PeriodicOperator((0.01 + 1j) / q, (points, points))
    chosen = np.zeros((points, points), dtype=bool)
    chosen[4:10, 5:11] = True
    contact = operator.backend.cells(chosen)
    known = KnownChanges(contact, 4, np.float64, fixed_load=fixed_load)
    for _ in range(5):  # the first is left out again
        change = contact.scattered(random.standard_normal(len(contact)))
        assert known.add(change, operator(change)) > 0.0
    moved = chosen.copy()
    moved[4, 6] = moved[9, 7] = False
    moved[10, 5:9] = moved[7, 11] = True
    known.move(operator.backend.cells(moved))
    images = known.images[:, : moved.sum()]
    np.testing.assert_allclose(images @ images.T, np.eye(4), rtol=0.0, atol=1e-12)
    for change, image in zip(known.changes, images, strict=True):
        pressure = np.zeros((points, points))
        pressure[moved] = change[: moved.sum()]
        pressure[known.beside.chosen] = change[moved.sum() :]
        displacement = operator(pressure)[moved]
        displacement -= displacement.mean() if fixed_load else 0.0
        np.testing.assert_allclose(image, displacement, rtol=0.0, atol=1e-12)


def test_complementarity_is_measured_in_the_given_depth() -> None:
    operator = HalfSpaceOperator(WINDOW, MATERIALS["one mode"])
    solution = solve_complementarity(operator, PARABOLOID, 100.0, np.ones(WINDOW.shape), tolerance=1e-6, depth=50.0)
    gap = operator(solution.pressure) + PARABOLOID - solution.indentation
    worst = max(np.abs(gap[solution.pressure > 0.0]).max(), -gap.min())
    assert solution.complementarity == pytest.approx(worst / 50.0, rel=1e-6)  # round-off in a small gap


def test_too_few_products_do_not_converge() -> None:
    operator = HalfSpaceOperator(WINDOW, MATERIALS["one mode"])
    assert not solve_complementarity(operator, PARABOLOID, 100.0, np.ones(WINDOW.shape), most_products=3).converged


def test_patience_ends_with_the_best_that_was_met() -> None:
    operator = HalfSpaceOperator(WINDOW, MATERIALS["one mode"])
    solution = solve_complementarity(
        operator, PARABOLOID, 100.0, np.ones(WINDOW.shape), tolerance=0.0, patience=3, most_products=10_000
    )
    assert not solution.converged
    # Nothing is below round-off: the solver stops there by itself, with nothing worse than it has seen.
    assert solution.complementarity < 1e-12
    assert solution.products < 5000


def test_single_precision_takes_the_steps_of_double_where_long_waves_yield_a_million_times_more() -> None:
    """Images of search directions are all long waves then, and rounding puts them back once they are taken out."""
    points, random = 256, np.random.default_rng(0)
    q = np.hypot(np.fft.fftfreq(points)[:, None], np.fft.rfftfreq(points))
    q[0, 0] = np.inf
    transfer = (1.0 / points / q) ** 3
    x = np.arange(points) - points / 2
    chosen = np.hypot(x[:, None], x) < points / 3
    defects = np.zeros((points, points))
    defects[tuple(np.argwhere(chosen)[random.integers(chosen.sum(), size=5)].T)] = 1.0
    steps = []
    for precision in (np.float64, np.float32):
        operator = PeriodicOperator(transfer, (points, points), precision)
        contact = operator.backend.cells(chosen)
        gap = contact.gathered(defects)
        correction, taken, residual = solve_on_contact(
            operator, gap, contact, reduction=0.1, floor=0.0, directions=40, fixed_load=True
        )
        left = gap + contact.gathered(PeriodicOperator(transfer, (points, points))(contact.scattered(correction)))
        true = np.std(left) / np.std(gap)
        assert residual == pytest.approx(true, rel=0.05)
        assert true < 0.105
        steps.append(taken)
    # Without freeing images of those before them twice, it did not come below 0.2 in a hundred steps.
    assert steps[1] <= 1.5 * steps[0]


def test_pressures_that_are_not_numbers_do_not_converge() -> None:
    window = Grid(spacing=0.1, behind=13, ahead=13, beside=13)
    operator = HalfSpaceOperator(window, MATERIALS["one mode"])
    solution = solve_complementarity(operator, np.zeros(window.shape), 100.0, np.full(window.shape, math.nan))
    assert not solution.converged
    assert math.isnan(solution.indentation)
    assert solution.set_changes == 1


@pytest.mark.parametrize(
    "reference",
    [*apart(BALL_REFERENCES[0], BALL_REFERENCES[2]), *slow(BALL_REFERENCES[3])],
    ids=lambda r: r.problem.name,
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


@pytest.mark.slow
@pytest.mark.parametrize(("modulus_ratio", "memory_length"), [*apart((1000.0, 1.0)), (1e4, 0.3)])
def test_hard_corner_agrees_with_dense_pivoting(modulus_ratio: float, memory_length: float) -> None:
    """One mode, a very stiff glass and memory of the contact's size: the operator is nearly skew on any usable grid."""
    problem = standard_linear_solid(modulus_ratio, memory_length)
    spectrum = problem.material.spectrum
    friction, indentation = dense_friction(
        spectrum.E0, spectrum.E_inf, spectrum.C, spectrum.tau, POISSON_RATIO, BALL_RADIUS,
        problem.load, problem.speed, cells=28,
    )  # fmt: skip
    solution = problem.solve(accuracy=2e-3)
    assert solution.diagnostics.complementarity <= 1e-8
    # Some 24 cells across the contact leave a few thousandths, as for the easier contacts above.
    assert solution.friction_coefficient == pytest.approx(friction, rel=0.01)
    assert solution.indentation == pytest.approx(indentation, rel=0.003)
