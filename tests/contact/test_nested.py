"""Nested grids: the window finds the contact, numbers settle, and their errors are told."""

from __future__ import annotations

import logging
import math
from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from gallery import standard_linear_solid
from marks import apart, slow
from refusals import refused
from viscofric.contact.free.estimates import (
    FEWEST_GRIDS,
    FRICTION_FLOOR,
    Estimate,
    friction_estimate,
    least_error,
    measured_fading,
    settled,
)
from viscofric.contact.free.geometry import LINE, POINT
from viscofric.contact.free.grids import Extent, Grid
from viscofric.contact.free.nested import GivenGrid, find_window, refine
from viscofric.contact.free.problem import Control, Problem
from viscofric.contact.free.proximal import proximal_points
from viscofric.contact.indenters.height_map import HeightMap
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.indenters.shapes import Ball, Cylinder
from viscofric.contact.operators.convolution import SteadyMaterial
from viscofric.contact.settings import ContactSettings
from viscofric.errors import ConvergenceError

# A standard linear solid in units of the Hertz contact at E0, and indenters whose radius is one there.
SOLID = SteadyMaterial(0.1, np.array([0.9]), np.array([1.0]))
PROBLEM = Problem(POINT, SOLID, Ball(radius=1.0), Control(load=POINT.parabolic_load), 1e-8)
LINE_PROBLEM = Problem(LINE, SOLID, Cylinder(radius=1.0), Control(load=LINE.parabolic_load), 1e-8)


@pytest.mark.parametrize("problem", [PROBLEM, LINE_PROBLEM], ids=["point", "line"])
@pytest.mark.parametrize("size", [10.0, *apart(1.0, 0.3), 0.05])
def test_window_finds_the_contact_from_a_poor_guess(problem: Problem, size: float) -> None:
    """A first window ten times too large or twenty times too small ends around the same contact."""
    good, found = (find_window(problem, guess) for guess in (0.7, size))
    assert found.window.extent(found.result.pressure > 0.0) == pytest.approx(
        good.window.extent(good.result.pressure > 0.0),
        abs=2.0 * good.window.spacing,  # each counts in its own cells
    )
    friction = [refine(first, 1e-3, 512)[-1].pressure_friction for first in (good, found)]
    assert friction[1] == pytest.approx(friction[0], rel=2e-3)  # the accuracy of each


def test_geometric_sequences_are_settled_with_the_error_that_is_left() -> None:
    for ratio in (2.0, 3.0, 4.0):
        values = 1.0 + ratio ** -np.arange(5.0)
        value, error = settled(values)
        assert value == values[-1]
        assert error >= abs(value - 1.0) * (1.0 - 1e-12)


def test_one_small_change_is_not_trusted() -> None:
    """Earlier changes count, faded by no more than the order 3/2 that square-root edges leave."""
    assert settled(np.array([1.0, 1.1, 1.1])).error >= (1.0 - 1e-12) * 0.1 / 2.0**1.5
    assert settled(np.array([1.0, 1.1, 1.1, 1.1])).error >= (1.0 - 1e-12) * 0.1 / 2.0**3


def test_changes_that_fall_fast_on_many_grids_count_less() -> None:
    slow, fast = (1.0 + ratio ** -np.arange(7.0) for ratio in (2.0, 4.0))
    assert measured_fading(slow) == measured_fading(fast[:5]) == measured_fading(1.0 + 0.0 * slow)
    assert measured_fading(fast) < 0.75 * measured_fading(slow)
    chance = fast.copy()
    chance[-1] = chance[-2] + 1e-9  # the last change is small by chance
    value, error = settled(chance, measured_fading(chance))
    assert abs(value - 1.0) <= error < settled(chance).error
    # a number that jumps about the limit on fine grids
    jumping = 1.0 + np.array([0.1, 0.02, 4e-3, 1e-3, -1e-3, 1e-3, -1e-3])
    assert settled(jumping, measured_fading(jumping)).error >= 1e-3


def stages_with(values: np.ndarray, *, dimension: int) -> list[Any]:
    """Stages whose friction from the pressure has these values, and whose balanced energy is uncertain."""
    material = SimpleNamespace(compliances=np.ones(1), drag=0.0, edge_coupling=0.0)
    return [
        SimpleNamespace(
            pressure_friction=value,
            energy_friction=1.0,
            left_out_range=lambda spacing, doubt=0.0: math.inf,
            opening=1.0,
            window=SimpleNamespace(spacing=1.0),
            operator=SimpleNamespace(shift=0.0, material=material),
            problem=SimpleNamespace(geometry=SimpleNamespace(scatter=1.0, dimension=dimension)),
        )
        for value in values
    ]


def test_least_error_after_no_halving_is_that_of_the_estimate() -> None:
    values = 1.0 + 4.0 ** -np.arange(7.0)
    stages = stages_with(values, dimension=1)
    expected = settled(values, measured_fading(values)).error
    assert expected < settled(values).error
    assert least_error(stages, 0) == pytest.approx(expected, rel=1e-12)


def test_point_contacts_are_extrapolated_from_the_fourth_grid_on() -> None:
    """The limit of an error that falls with the square of the cell is exact; a tenth of that error is stated."""
    values = 1.0 + 0.1 * 4.0 ** -np.arange(4.0)
    assert friction_estimate(stages_with(values[:3], dimension=2)).value != pytest.approx(1.0, abs=1e-6)
    value, error = friction_estimate(stages_with(values, dimension=2))
    assert value == pytest.approx(1.0, abs=1e-15)
    assert error == pytest.approx(0.1 * settled(values).error, rel=1e-12)
    assert friction_estimate(stages_with(values, dimension=1)).error >= 0.9 * settled(values).error  # strips: none


def test_limits_that_fall_more_slowly_or_disagree_are_not_called_certain() -> None:
    slow = 1.0 + 0.1 * 2.0 ** -np.arange(4.0)  # with the first power: the limit is off by a third of the change
    value, error = friction_estimate(stages_with(slow, dimension=2))
    assert abs(value - 1.0) <= error
    apart = 1.01 + 0.1 * 4.0 ** -np.arange(4.0)  # the balanced energy is 1 on all grids
    value, error = friction_estimate(stages_with(apart, dimension=2))
    assert settled(apart).error > 0.01
    assert error == pytest.approx(0.01, rel=1e-9)  # the difference of the limits


def test_relative_error_of_vanishing_friction_is_finite() -> None:
    assert Estimate(0.0, 1e-9).relative_error == pytest.approx(1e-9 / FRICTION_FLOOR)


def test_displacements_are_given_at_the_cell_centres() -> None:
    """Where the gap was looked at behind the centres, the displacement is that of the centres all the same."""
    problem = standard_linear_solid(1000.0, 0.5)
    solution = problem.solve(accuracy=0.02)
    assert solution.diagnostics.collocation_shift > 0.1
    radius = 1e-2
    gap = solution.displacement + (solution.x[:, None] ** 2 + solution.y**2) / (2.0 * radius) - solution.indentation
    inside = solution.pressure > 0.1 * solution.max_pressure
    # In the middle of a cell the gap of piecewise constant pressures is not zero, but a part of what the surface
    # climbs in a cell; displacements left at the shifted places would be off by shift × slope, on average too.
    climb = solution.diagnostics.spacing * np.abs(solution.x).max() / radius
    assert abs(gap[inside].mean()) < 0.02 * climb


def test_contact_that_is_cut_by_every_window_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    first = find_window(PROBLEM, 0.7)
    monkeypatch.setattr(Grid, "cuts", lambda window, mask: True)
    with refused("no-window", ConvergenceError):
        refine(first, 1e-3, 512)


@pytest.mark.parametrize("indenter", [Ball(radius=1.0), Cylinder(radius=1.0)], ids=["point", "line"])
def test_first_size_is_that_of_the_hertz_contact(indenter: Indenter) -> None:
    soft = SteadyMaterial(1.0, np.empty(0), np.empty(0))
    hard = SteadyMaterial(1e-3, np.empty(0), np.empty(0))
    geometry = indenter.geometry
    power = 1.0 / (geometry.dimension + 1.0)
    glass = SteadyMaterial(1e-90, np.array([1.0]), np.array([1e150]))
    for solid, size in ((glass, 1e-90**power), (SteadyMaterial(0.0, np.empty(0), np.empty(0)), 1e-300**power)):
        problem = Problem(geometry, solid, indenter, Control(load=geometry.parabolic_load), 1e-8)
        assert problem.first_size == pytest.approx(size, rel=1e-9)
    for solid, size in ((soft, 1.0), (hard, 1e-3**power)):
        problem = Problem(geometry, solid, indenter, Control(load=geometry.parabolic_load), 1e-8)
        assert problem.first_size == pytest.approx(size, rel=1e-9)  # a fixed point: round-off
        # On 32 cells the contact ends within a cell of its true edge.
        stage = find_window(problem, problem.first_size)
        assert stage.footprint.front == pytest.approx(size, abs=stage.window.spacing)


@pytest.mark.parametrize("given", [GivenGrid(), GivenGrid(window=Extent(2.0, 2.0, 2.0))], ids=["found", "given"])
def test_first_two_grids_are_solved_less_tightly(given: GivenGrid) -> None:
    problem = replace(PROBLEM, coarse_tolerance=1e-3)
    stages = refine(find_window(problem, problem.first_size), 2e-4, 1024, given)
    assert len(stages) > FEWEST_GRIDS
    left = [stage.result.complementarity for stage in stages]
    assert 1e-6 < max(left[:2]) <= 1e-3
    assert max(left[2:]) <= problem.tolerance


def test_given_cells_are_solved_to_the_tolerance_on_every_grid() -> None:
    assert ContactSettings(accuracy=0.5).coarse_residual == 5e-4
    assert ContactSettings(accuracy=0.5, tolerance=1e-9).coarse_residual == 5e-4
    assert ContactSettings(accuracy=0.5, grid=512).coarse_residual == 1e-8


def test_given_indentation_finds_the_load() -> None:
    stage = find_window(PROBLEM, 0.7)
    guess = 3.0 * stage.result.pressure  # a load three times too large
    height = PROBLEM.shape.height(stage.window.x[:, None], stage.window.y)
    found = Control(indentation=stage.indentation).solve(stage.operator, height, guess, 1e-9)
    assert found.converged
    assert found.indentation == stage.indentation
    # Gaps of 1e-8 and 1e-9 of the indentation, over which the load grows with an exponent near 3/2.
    assert found.pressure.sum() == pytest.approx(stage.result.pressure.sum(), rel=1e-6)


def test_strip_is_a_window_of_one_row() -> None:
    strip = LINE.around(1.0, 2.0, 9.0, 30)
    assert strip.shape == (30, 1)
    assert strip.cell_area == strip.spacing == pytest.approx(0.1, rel=1e-12)
    np.testing.assert_allclose(strip.x[[0, -1]], [-0.95, 1.95], rtol=1e-12)
    assert strip.refined().shape == (60, 1)
    loaded = np.zeros(strip.shape, dtype=bool)
    loaded[3:12] = True
    assert not strip.cuts(loaded)
    assert strip.cuts(~loaded)
    assert strip.extent(loaded) == pytest.approx((0.7, 0.2, 0.0), abs=1e-12)


@pytest.mark.parametrize("grid", [Grid.around(1.0, 2.0, 0.0, 30), Grid.around(1.0, 2.0, 1.0, 30)], ids=["1", "2"])
def test_refinement_keeps_the_load(grid: Grid) -> None:
    pressure = np.random.default_rng(5).random(grid.shape)
    finer = grid.refined()
    carried = grid.resample(pressure, finer)
    # The same values on cells that are halved: sums in another order.
    assert carried.sum() * finer.cell_area == pytest.approx(pressure.sum() * grid.cell_area, rel=1e-12)
    assert finer.whole == pytest.approx(grid.whole, rel=1e-12)


def test_rectangular_cells_keep_their_shape_and_their_edges() -> None:
    window = Grid.around(1.0, 2.0, 12.0, 32, 4.0)
    assert window.aspect == 4.0
    assert window.width == pytest.approx(4.0 * window.spacing)
    assert max(window.shape) == 32
    assert window.x[0] - 0.5 * window.spacing <= -1.0
    assert window.y[-1] + 0.5 * window.width >= 12.0
    assert window.cell_area == pytest.approx((window.x[1] - window.x[0]) * (window.y[1] - window.y[0]))
    fine = window.refined()
    assert (fine.aspect, fine.width) == (4.0, 0.5 * window.width)
    assert fine.whole == pytest.approx(window.whole)
    values = np.random.default_rng(0).random(window.shape)
    np.testing.assert_array_equal(window.resample(values, fine), np.kron(values, np.ones((2, 2))))


def test_wide_contact_has_wide_cells_and_a_round_one_square_ones() -> None:
    rubber = vf.Material.standard_linear_solid(E0=1e6, E_inf=1e7, tau=1e-3)
    wide, round_one = (
        vf.solve_steady(rubber, vf.Ellipsoid(*radii), speed=1.0, load=1.0, accuracy=1e-2)
        for radii in ((1e-3, 3e-2), (1e-2, 1e-2))
    )
    step_x, step_y = np.diff(wide.x)[0], np.diff(wide.y)[0]
    slenderness = 2.0 * wide.half_width / (wide.front + wide.rear)
    assert step_y / step_x == pytest.approx(2.0 ** round(np.log2(0.5 * slenderness)))
    assert slenderness > 5.0
    # On squares, at an accuracy of 1e-4: 0.166199.
    assert wide.friction_coefficient == pytest.approx(0.166199, rel=2e-3)
    assert wide.pressure.sum() * step_x * step_y == pytest.approx(1.0, rel=1e-9)
    assert np.diff(round_one.x)[0] == pytest.approx(np.diff(round_one.y)[0])


# --- grids on which the active set cycles, and accuracies out of reach -----------------------------


def test_damping_adds_a_multiple_of_the_pressure() -> None:
    operator = find_window(PROBLEM, 0.7).operator
    pressure = np.random.default_rng(3).random(operator.window.shape)
    damped = operator.damped(0.3)
    np.testing.assert_allclose(damped(pressure), operator(pressure) + 0.3 * pressure, rtol=1e-12)  # round-off
    # A pressure in the middle of the window hardly feels that the preconditioner's world is periodic.
    displacement = damped(damped.precondition(pressure))
    assert np.abs(displacement - pressure).max() < 0.5
    assert (damped.products, operator.products) == (2, operator.products)


@pytest.mark.parametrize("problem", [PROBLEM, LINE_PROBLEM], ids=["point", "line"])
def test_proximal_points_find_the_contact_that_the_active_set_finds(problem: Problem) -> None:
    stage = find_window(problem, 0.7)
    operator, height = stage.operator, problem.height_on(stage.window, stage.operator.shift)
    poor = problem.control.solve(operator, height, np.ones(stage.window.shape), 1e-8, 0)
    assert not poor.converged
    found = proximal_points(problem.control, operator, height, poor, 1e-10)
    assert found.converged
    assert found.products > poor.products
    # Both to gaps of 1e-8 of the indentation, of which cells make pressures that are 1e2 times larger.
    np.testing.assert_allclose(found.pressure, stage.result.pressure, atol=1e-6 * stage.result.pressure.max())


def test_a_contact_narrower_than_a_cell_is_refused() -> None:
    rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    with refused("no-window", ConvergenceError):
        vf.solve_steady(rubber, vf.Ellipsoid(1e-2, 1e3), speed=0.1, indentation=1e-4, accuracy=3e-2)


@pytest.mark.parametrize(("ratio", "modulus_ratio"), [(0.1, 1e4), *slow((10.0, 1e4), (1000.0, 10.0))])
def test_slender_contacts_are_solved_where_the_active_set_cycles(ratio: float, modulus_ratio: float) -> None:
    """The active set alone is lost on one of their grids at least, however long it goes on."""
    rubber = standard_linear_solid(modulus_ratio, 1.0)
    ellipsoid = vf.Ellipsoid(1e-2, 1e-2 * ratio)
    solution = vf.solve_steady(rubber.material, ellipsoid, speed=rubber.speed, load=rubber.load, accuracy=0.01)
    assert solution.diagnostics.complementarity <= 1e-8
    assert solution.diagnostics.products <= 600  # the active set alone would spend 800 in vain


def test_grid_that_is_not_solved_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("viscofric.contact.free.nested.proximal_points", lambda *given: given[3])  # none are taken
    monkeypatch.setattr("viscofric.contact.free.nested._PATIENCE", 0)
    with refused("not-converged", ConvergenceError):
        find_window(PROBLEM, 1.0)


def test_proximal_points_give_up_when_their_products_are_spent(monkeypatch: pytest.MonkeyPatch) -> None:
    stage = find_window(PROBLEM, 0.7)
    operator, height = stage.operator, PROBLEM.height_on(stage.window, stage.operator.shift)
    poor = PROBLEM.control.solve(operator, height, np.ones(stage.window.shape), 1e-8, 0)
    monkeypatch.setattr("viscofric.contact.free.proximal._FEWEST_PRODUCTS", 5)
    monkeypatch.setattr("viscofric.contact.free.proximal._CELL_PRODUCTS", 5.0)
    found = proximal_points(PROBLEM.control, operator, height, poor, 1e-10)
    assert not found.converged
    assert 1e-10 < found.complementarity <= poor.complementarity


@pytest.mark.parametrize("finest", [128, 2048])
def test_accuracy_out_of_reach_is_refused_before_the_finest_grid(finest: int, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.INFO, logger="viscofric.contact.free.nested")
    with refused("accuracy-not-reached", ConvergenceError) as caught:
        refine(find_window(PROBLEM, 0.7), 1e-9, finest)
    assert f"{finest} cells" in str(caught.value)
    # Every grid tells what it gave; no grid of 1024 cells or more is tried.
    grids = [record.args[1] for record in caplog.records if record.levelno == logging.INFO]
    assert grids[0] == 64
    assert grids[-1] <= min(finest, 512)


def test_friction_that_is_not_a_number_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("viscofric.contact.free.nested.friction_estimate", lambda stages: Estimate(math.nan, math.inf))
    with refused("not-finite", ConvergenceError):
        refine(find_window(PROBLEM, 0.7), 1e-3, 512)


def test_contact_starts_at_the_lowest_cells_where_no_guess_is_given() -> None:
    stage = find_window(PROBLEM, 0.7)
    height = PROBLEM.height_on(stage.window, stage.operator.shift)
    found = PROBLEM.control.solve(stage.operator, height, np.zeros(stage.window.shape), 1e-8)
    assert found.converged
    np.testing.assert_allclose(found.pressure, stage.result.pressure, atol=1e-5 * stage.result.pressure.max())


def test_free_space_is_cut_off_only_where_nothing_else_can_touch() -> None:
    stages = refine(find_window(PROBLEM, PROBLEM.first_size), 1e-3, 1024)
    first, last = (stage.window.whole.side - stage.extent.side for stage in (stages[0], stages[-1]))
    assert 0.0 < last < 0.6 * first
    assert not any(stage.window.cuts(stage.result.pressure > 0.0) for stage in stages)
    # The same cells have the same pressure, to the tolerance, as in the whole window.
    whole = refine(stages[0], 1e-3, 1024, GivenGrid(window=stages[0].window.whole))[: len(stages)]
    for one, other in zip(stages, whole, strict=True):
        assert one.window.spacing == pytest.approx(other.window.spacing)
        assert one.pressure_friction == pytest.approx(other.pressure_friction, rel=1e-5)


def test_free_space_around_a_height_map_is_kept() -> None:
    x = np.linspace(-4.0, 4.0, 81)
    bumpy = HeightMap((x[:, None] ** 2 + x**2) / 2.0, spacing=0.1)
    problem = replace(PROBLEM, shape=bumpy)
    stages = refine(find_window(problem, problem.first_size), 0.2, 1024)
    assert all(fine.window == coarse.window.refined() for coarse, fine in pairwise(stages))
