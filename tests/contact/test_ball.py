"""A ball in steady motion: known answers, energy balance, limits, similarities, refusals."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gallery import (
    BALL_RADIUS,
    BALL_REFERENCES,
    HERTZ_RADIUS,
    LOAD,
    POISSON_RATIO,
    RUBBER_MODULUS,
    SPEED,
    BallProblem,
    BallReference,
    ball_problem,
    broad_spectrum_37,
    high_speed_friction,
    in_hertz_units,
    low_speed_friction,
    standard_linear_solid,
)
from marks import apart, slow
from refusals import refused
from viscofric.contact.complementarity import ComplementaritySolution, solve_complementarity
from viscofric.contact.free.grids import Grid
from viscofric.contact.indenters.shapes import Ball
from viscofric.contact.operators import convolution
from viscofric.contact.operators.convolution import SteadyMaterial
from viscofric.contact.operators.half_space import HalfSpaceOperator
from viscofric.contact.reference import hertz_ball
from viscofric.contact.solution import ContactSolution
from viscofric.contact.steady import solve_steady
from viscofric.notes import codes
from viscofric.rheology.catalogue import synthetic_fluoroelastomer
from viscofric.rheology.material import Material

SLS = standard_linear_solid(10.0, 1.0)


# --- elastic limits -------------------------------------------------------------------------------


@pytest.mark.parametrize(("speed", "modulus_ratio"), [(0.0, 1.0), (math.inf, 10.0)], ids=["v = 0", "v = ∞"])
def test_limits_of_speed_are_hertz_contacts(speed: float, modulus_ratio: float) -> None:
    hertz = hertz_ball(LOAD, BALL_RADIUS, modulus_ratio * RUBBER_MODULUS, POISSON_RATIO)
    solution = solve_steady(SLS.material, SLS.ball, speed=speed, load=LOAD)
    # The friction of an elastic contact is zero on every grid, so the solver stops at the third, where half a percent
    # is a quarter of a cell at the edge.
    assert len(solution.diagnostics.levels) == 3
    assert solution.indentation == pytest.approx(hertz.indentation, rel=0.0005)
    assert solution.max_pressure == pytest.approx(hertz.max_pressure, rel=0.005)
    for edge in (solution.front, solution.rear, solution.half_width):
        assert edge == pytest.approx(hertz.radius, rel=0.005)
    # Over the whole rim the errors of the edge cancel out: a tenth of a cell in the radius, twice.
    assert solution.contact_area == pytest.approx(math.pi * hertz.radius**2, rel=0.004)
    assert solution.diagnostics.peak_resolved
    # Symmetric about a corner of cells: round-off only.
    assert abs(solution.friction_coefficient) < 1e-12
    assert solution.energy_friction_coefficient == 0.0


@pytest.mark.parametrize(("memory_length", "modulus_ratio"), [(1e-7, 1.0), (1e9, 10.0)], ids=["slow", "fast"])
def test_extreme_speeds_approach_hertz(memory_length: float, modulus_ratio: float) -> None:
    problem = standard_linear_solid(10.0, memory_length)
    hertz = hertz_ball(LOAD, BALL_RADIUS, modulus_ratio * RUBBER_MODULUS, POISSON_RATIO)
    solution = problem.solve(grid=128)
    # On a grid of 128 cells, as above; memory adds about 1e-7, or ln(l)/l = 2e-8.
    assert solution.indentation == pytest.approx(hertz.indentation, rel=0.0005)
    assert solution.max_pressure == pytest.approx(hertz.max_pressure, rel=0.005)
    assert solution.front == pytest.approx(hertz.radius, rel=0.005)
    assert abs(solution.friction_coefficient) < 1e-6


def hertz_on_grid(cells: int, compliance: float) -> tuple[float, float, float]:
    """Relative errors of indentation, contact radius and largest pressure of Hertz's contact on one grid."""
    a0 = compliance ** (1.0 / 3.0)
    window = Grid.around(1.3 * a0, 1.3 * a0, 1.3 * a0, cells)
    x, y = window.x[:, None], window.y
    operator = HalfSpaceOperator(window, SteadyMaterial(compliance, np.empty(0), np.empty(0)))
    load = 4.0 / 3.0 / window.cell_area
    guess = np.sqrt(np.maximum(0.0, a0**2 - x**2 - y**2))
    solution = solve_complementarity(operator, 0.5 * (x**2 + y**2), load, guess)
    radius = math.sqrt(np.count_nonzero(solution.pressure) * window.cell_area / math.pi)
    return (
        abs(solution.indentation / a0**2 - 1.0),
        abs(radius / a0 - 1.0),
        abs(solution.pressure.max() * math.pi / 2.0 * a0**2 - 1.0),
    )


@pytest.mark.parametrize("compliance", [1.0, *slow(0.1)], ids=["E0", "E_inf"])
@pytest.mark.slow
def test_hertz_contact_converges_with_the_grid(compliance: float) -> None:
    errors = np.array([hertz_on_grid(cells, compliance) for cells in (32, 128, 512)])
    assert np.all(errors[1] < 0.005)  # half a percent on 128 × 128 cells
    # First order at least over the two refinements by four: the edge is a square root.  The radius counts cells
    # and jumps with them, by half an order here.
    orders = 0.25 * np.log2(errors[0] / errors[2])
    assert np.all(orders > np.array([0.9, 0.5, 0.9]))


# --- viscoelastic reference values ----------------------------------------------------------------


SLOW_REFERENCES = ("k = 10, vτ/a0 = 0.1", "25 modes, k = 10, vτ_max/a0 = 1", "25 modes", "37 modes")


@pytest.mark.parametrize(
    "reference",
    [
        pytest.param(
            one,
            id=one.problem.name,
            marks=[pytest.mark.slow] if any(slow in one.problem.name for slow in SLOW_REFERENCES) else [],
        )
        for one in BALL_REFERENCES
    ],
)
def test_reference_values(reference: BallReference) -> None:
    accuracy = 1e-4
    solution = reference.problem.solve(accuracy=accuracy)
    result = in_hertz_units(reference.problem, solution)
    # The reference's own error bar, and three times the accuracy asked for.
    for found, known in (
        (result.friction, reference.friction),
        (result.indentation, reference.indentation),
        (result.max_pressure, reference.max_pressure),
    ):
        assert found == pytest.approx(known.value, abs=known.error + 3.0 * accuracy * known.value)
    assert abs(result.friction - reference.friction.value) <= result.friction_error + reference.friction.error
    assert result.energy_friction == pytest.approx(result.friction, rel=accuracy)
    # Edges are known to a fraction of a cell, and the solution's own estimates say how well; they leave out no more
    # than the reference's error.
    diagnostics, a0 = solution.diagnostics, reference.problem.hertz_radius
    for found, known in (
        (result.front, reference.front),
        (result.rear, reference.rear),
        (result.side, reference.side),
    ):
        assert found == pytest.approx(known.value, abs=0.3 * result.cell + known.error)
        assert found == pytest.approx(known.value, abs=diagnostics.edge_error / a0 + known.error)
    area_error = diagnostics.contact_area_error / (np.pi * a0**2) + reference.area.error
    assert result.area == pytest.approx(reference.area.value, abs=area_error)
    assert result.area == pytest.approx(reference.area.value, rel=4e-3)  # a fifth of a cell all along the rim
    assert diagnostics.peak_resolved
    peak_error = diagnostics.max_pressure_error / (1.5 * LOAD / (np.pi * a0**2))
    assert abs(result.max_pressure - reference.max_pressure.value) <= peak_error + reference.max_pressure.error


# --- errors and their estimates -------------------------------------------------------------------


@pytest.mark.parametrize("problem", [*apart(SLS), standard_linear_solid(1000.0, 100.0)], ids=lambda p: p.name)
def test_friction_converges_with_the_grid(problem: BallProblem) -> None:
    solution = problem.solve(accuracy=1e-5)
    cells, lean, energy, indentation, _ = (np.array(level) for level in zip(*solution.diagnostics.levels, strict=True))
    # Cells are half as large, and around the contact there is less and less free space.
    assert np.all(cells[1:] > 1.5 * cells[:-1])
    assert np.all(cells[1:] <= 2 * cells[:-1])
    for values in (lean, energy, indentation):
        changes = np.abs(np.diff(values))
        # First order at least, from the first steps to the last (single steps jump as cells cross the edge, or are
        # small by luck).
        assert changes[-1] < max(changes[:2]) * 0.5 ** (len(changes) - 1)
    # The two ways to friction: as many refinements give 2^-n; a half allows for the luck of single grids.
    assert abs(lean[-1] - energy[-1]) < 0.5 * abs(lean[0] - energy[0])


@pytest.mark.parametrize("accuracy", [1e-2, 1e-3])
def test_true_error_is_within_the_estimate(accuracy: float) -> None:
    for reference in (BALL_REFERENCES[0], BALL_REFERENCES[2], BALL_REFERENCES[3]):
        solution = reference.problem.solve(accuracy=accuracy)
        result = in_hertz_units(reference.problem, solution)
        assert result.friction_error <= accuracy * result.friction
        error = abs(result.friction - reference.friction.value)
        assert error <= result.friction_error + reference.friction.error


@pytest.mark.slow
def test_estimates_cover_the_planted_friction() -> None:
    """Ten contacts of a broad spectrum, known to 1e-4 from finer grids."""
    planted = np.loadtxt(Path(__file__).parents[1] / "data" / "planted_paper_friction.csv", delimiter=",", skiprows=3)
    for temperature, speed, friction in planted[::3, :3]:
        solution = solve_steady(
            synthetic_fluoroelastomer(),
            Ball(radius="9.525 mm"),
            speed=speed,
            load="25 N",
            temperature=f"{temperature} degC",
        )
        assert solution.diagnostics.friction_error <= 1e-3 * solution.friction_coefficient
        assert abs(solution.friction_coefficient - friction) <= solution.diagnostics.friction_error + 1e-4 * friction


def test_diagnostics_show_the_work_and_the_residuals() -> None:
    diagnostics = SLS.solve(tolerance=1e-9).diagnostics
    assert diagnostics.complementarity <= 1e-9
    assert diagnostics.load < 1e-12  # scaled to the load: round-off
    assert diagnostics.products >= diagnostics.linear_iterations > 0
    assert diagnostics.ffts > 2 * diagnostics.products - 1
    assert diagnostics.levels[-1].pressure_friction == SLS.solve(tolerance=1e-9).pressure_friction_coefficient


# --- limits of speed, direction -------------------------------------------------------------------


@pytest.mark.parametrize(
    "problem",
    [
        standard_linear_solid(10.0, 1e-5),
        standard_linear_solid(1000.0, 1e-5),
        ball_problem("three short memories", 10.0, [1.0, 2.0, 3.0], [1e-4, 5e-5, 1e-5]),
    ],
    ids=lambda p: p.name,
)
def test_friction_at_low_speed(problem: BallProblem) -> None:
    solution = problem.solve(accuracy=3e-3)
    # The accuracy asked for, and 1e-3 for the law, whose next term is about l log l.
    assert solution.friction_coefficient == pytest.approx(low_speed_friction(problem), rel=4e-3)


@pytest.mark.parametrize(
    "problem",
    [
        standard_linear_solid(10.0, 1e4),
        standard_linear_solid(1000.0, 1e6),
        ball_problem("three long memories", 100.0, [1.0, 2.0, 3.0], [1e7, 1e5, 1e6]),
    ],
    ids=lambda p: p.name,
)
def test_friction_at_high_speed(problem: BallProblem) -> None:
    solution = problem.solve(accuracy=1e-4)
    # The accuracy asked for, and 1e-3 for the law, whose next term is k/l = 1e-3 at most.
    assert solution.friction_coefficient == pytest.approx(high_speed_friction(problem), rel=1e-3)


def test_pressure_leans_to_the_leading_edge() -> None:
    solution = SLS.solve()
    assert solution.friction_coefficient > 0.0
    assert solution.front > solution.rear
    peak = solution.x[np.argmax(solution.pressure.max(axis=1))]
    assert peak > 0.0
    np.testing.assert_allclose(solution.pressure, solution.pressure[:, ::-1], atol=1e-6 * solution.max_pressure)


def test_gap_opens_behind_the_ball() -> None:
    solution = SLS.solve()
    height = SLS.ball.height(solution.x[:, None], solution.y)
    gap = solution.displacement - (solution.indentation - height)
    assert gap.min() > -1.1e-8 * solution.indentation  # the tolerance of the complementarity
    assert np.all(np.abs(gap[solution.pressure > 0.0]) < 1.1e-8 * solution.indentation)
    centre = len(solution.y) // 2
    just_behind = np.searchsorted(solution.x, -solution.rear) - 2
    just_ahead = np.searchsorted(solution.x, solution.front) + 1
    assert gap[just_behind, centre] > 0.0
    assert gap[just_ahead, centre] > 0.0


def test_reversing_the_motion_mirrors_the_contact() -> None:
    forward = SLS.solve()
    backward = solve_steady(SLS.material, SLS.ball, speed=-SPEED, load=LOAD)
    # The same numbers in another order: nothing is rounded anew.
    assert backward.friction_coefficient == -forward.friction_coefficient
    assert backward.energy_friction_coefficient == -forward.energy_friction_coefficient
    assert (backward.front, backward.rear) == (forward.front, forward.rear)
    np.testing.assert_array_equal(backward.x, -forward.x[::-1])
    np.testing.assert_array_equal(backward.pressure, forward.pressure[::-1, ::-1])
    np.testing.assert_array_equal(backward.displacement, forward.displacement[::-1, ::-1])
    loads = backward.pressure.sum() * backward.diagnostics.spacing**2
    lean = backward.x @ backward.pressure.sum(axis=1) * backward.diagnostics.spacing**2
    assert loads == pytest.approx(LOAD, rel=1e-12)
    assert lean / (BALL_RADIUS * LOAD) == pytest.approx(backward.pressure_friction_coefficient, rel=1e-10)  # round-off


# --- similarities ---------------------------------------------------------------------------------


def pure_numbers(solution: ContactSolution, length: float, ball_radius: float) -> np.ndarray:
    return np.array(
        [
            solution.friction_coefficient * ball_radius / length,
            solution.energy_friction_coefficient * ball_radius / length,
            solution.indentation * ball_radius / length**2,
            solution.front / length,
            solution.rear / length,
            solution.half_width / length,
            solution.contact_area / length**2,
        ]
    )


def test_load_and_radius_only_rescale_the_contact() -> None:
    """μ = (a0/R) Φ(v/a0)."""
    load, radius = 20.0 * LOAD, 0.3 * BALL_RADIUS
    length = hertz_ball(load, radius, RUBBER_MODULUS, POISSON_RATIO).radius
    other = solve_steady(SLS.material, Ball(radius=radius), speed=SPEED * length / HERTZ_RADIUS, load=load)
    here = SLS.solve()
    # The same problem in its own units, so round-off as above.
    np.testing.assert_allclose(
        pure_numbers(other, length, radius), pure_numbers(here, HERTZ_RADIUS, BALL_RADIUS), rtol=1e-9
    )


def test_poisson_ratio_only_rescales_the_load() -> None:
    compressible = Material(SLS.material.spectrum, poisson_ratio=0.3)
    load = LOAD * (1.0 - POISSON_RATIO**2) / (1.0 - 0.3**2)
    other = solve_steady(compressible, SLS.ball, speed=SPEED, load=load)
    # The same F (1 − ν²): the same problem, round-off as above.
    np.testing.assert_allclose(pure_numbers(other, 1.0, 1.0), pure_numbers(SLS.solve(), 1.0, 1.0), rtol=1e-9)
    pressures = other.max_pressure / load, SLS.solve().max_pressure / LOAD
    assert pressures[0] == pytest.approx(pressures[1], rel=1e-9)  # the same area carries the load


# --- any spectrum ---------------------------------------------------------------------------------


@pytest.mark.slow
@given(
    modulus_ratio=st.floats(0.05, 2.0).map(lambda decades: 10.0**decades),
    modes=st.lists(st.tuples(st.floats(0.1, 1.0), st.floats(-3.0, 0.0)), min_size=3, max_size=6),
    speed_decade=st.floats(-2.0, 6.0),
)
@settings(max_examples=12, deadline=None, derandomize=True)
def test_any_broad_spectrum_gives_a_sound_contact(
    modulus_ratio: float, modes: list[tuple[float, float]], speed_decade: float
) -> None:
    shares = [share for share, _ in modes]
    lengths = [10.0 ** (speed_decade + decade) for _, decade in modes]
    problem = ball_problem("random", modulus_ratio, shares, lengths)
    accuracy, tolerance = 0.03, 1e-8
    solution = problem.solve(accuracy=accuracy, tolerance=tolerance)
    assert solution.diagnostics.complementarity <= tolerance
    assert solution.pressure.min() >= 0.0
    load = solution.pressure.sum() * solution.diagnostics.spacing**2
    assert load == pytest.approx(problem.load, rel=1e-12)  # scaled to the load: round-off
    assert 0.0 < solution.friction_coefficient < 0.6 * HERTZ_RADIUS / BALL_RADIUS
    # The better settled of the two is known to the accuracy, the other one may lag behind.
    assert abs(solution.diagnostics.energy) <= 3.0 * accuracy
    assert solution.indentation <= HERTZ_RADIUS**2 / BALL_RADIUS * 1.001  # never deeper than fully relaxed


# --- what is refused ------------------------------------------------------------------------------


@pytest.mark.parametrize("modulus_ratio", [2.0, *slow(100.0)])
def test_second_attempt_solves_for_the_same_material(monkeypatch: pytest.MonkeyPatch, modulus_ratio: float) -> None:
    """Where the first attempt on a grid fails, proximal points must end at the material that was asked for."""
    problem = standard_linear_solid(modulus_ratio, 1.0)
    expected = problem.solve(accuracy=0.02)
    attempts = 0

    def first_one_fails(*arguments: Any, **settings: Any) -> ComplementaritySolution:
        nonlocal attempts
        attempts += 1
        result = solve_complementarity(*arguments, **settings)
        return replace(result, converged=result.converged and attempts > 1)

    monkeypatch.setattr(convolution, "solve_complementarity", first_one_fails)
    solution = problem.solve(accuracy=0.02)
    assert attempts > 1
    # Another path to the same discrete problem, solved to 1e-8.
    assert solution.indentation == pytest.approx(expected.indentation, rel=1e-6)
    assert solution.friction_coefficient == pytest.approx(expected.friction_coefficient, rel=1e-6)


@pytest.mark.parametrize(
    ("change", "about"),
    [
        ({"load": 0.0}, "load"),
        ({"load": -1.0}, "load"),
        ({"accuracy": 0.0}, "accuracy"),
        ({"accuracy": 1.0}, "accuracy"),
        ({"accuracy": -1e-3}, "accuracy"),
        ({"accuracy": 1e-11}, "accuracy"),
        ({"accuracy": 1e-9, "tolerance": 1e-8}, "tolerance"),
        ({"finest": 64}, "finest"),
        ({"finest": 256.5}, "finest"),
        ({"speed": 1e160}, "speed"),
        ({"temperature": "30 degC"}, "temperature"),
    ],
    ids=str,
)
def test_unusable_input_is_refused_in_one_sentence(change: dict[str, float | str], about: str) -> None:
    arguments: dict[str, Any] = {"material": SLS.material, "speed": SPEED, "load": LOAD, **change}
    with refused(about):
        solve_steady(indenter=SLS.ball, **arguments)


@pytest.mark.parametrize("radius", [0.0, -1.0, "3 s", "9.525", math.inf])
def test_ball_without_a_size_is_refused(radius: float | str) -> None:
    with refused("radius"):
        Ball(radius=radius)


def test_large_strain_is_a_warning() -> None:
    load = LOAD * (0.4 * BALL_RADIUS / HERTZ_RADIUS) ** 3  # a0/R = 0.4
    deep = solve_steady(SLS.material, SLS.ball, speed=0.0, load=load)
    assert len(deep.warnings) == 1
    assert "0.4" in deep.warnings[0]
    assert codes(SLS.solve().warnings) == {"adhesion"}


@pytest.mark.slow
def test_edges_are_claimed_to_be_known_to_a_cell_and_are() -> None:
    """On one of the coarser grids here an edge is taken for half a cell further out than it can be told to be."""
    coarse = broad_spectrum_37(10.0).solve(accuracy=1e-3)
    fine = broad_spectrum_37(10.0).solve(grid=512)
    error = coarse.diagnostics.edge_error
    assert coarse.diagnostics.peak_resolved
    assert error <= coarse.diagnostics.spacing
    for edge in ("front", "rear", "half_width"):
        assert abs(getattr(coarse, edge) - getattr(fine, edge)) < error
