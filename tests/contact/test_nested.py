"""Nested grids: the window finds the contact, numbers settle, and their errors are told."""

from __future__ import annotations

import numpy as np
import pytest

from gallery import standard_linear_solid
from viscofric.contact.indenters import Ball
from viscofric.contact.nested import FRICTION_FLOOR, Estimate, Problem, find_window, refine, settled
from viscofric.contact.operator import SteadyMaterial
from viscofric.errors import ConvergenceError

# A standard linear solid in units of the Hertz contact at E0, and a ball, whose radius is one there.
PROBLEM = Problem(SteadyMaterial(0.1, np.array([0.9]), np.array([1.0])), Ball(radius=1.0), 1e-8)


@pytest.mark.parametrize("modulus", [1e-3, 1.0, 30.0, 1e4])
def test_window_finds_the_contact_from_a_poor_guess(modulus: float) -> None:
    """A first window ten times too large or twenty times too small ends around the same contact."""
    good, found = (find_window(PROBLEM, guess) for guess in (3.0, modulus))
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
    assert settled(np.array([1.0, 1.1, 1.1])).error >= 0.025
    assert settled(np.array([1.0, 1.1, 1.1, 1.1])).error >= 0.1 / 16.0


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
    first = find_window(PROBLEM, 3.0)
    monkeypatch.setattr("viscofric.contact.nested.touches_edge", lambda mask: True)
    with pytest.raises(ConvergenceError, match="no window"):
        refine(first, 1e-3, 512)
