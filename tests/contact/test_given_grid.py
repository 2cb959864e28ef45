"""Window and grid given by the user: kept as they are, and refused where the contact does not lie within."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import viscofric as vf
from gallery import HERTZ_RADIUS, cylinder_on_standard_linear_solid, standard_linear_solid
from refusals import refused

PROBLEM = standard_linear_solid(10.0, 1.0)
A0 = HERTZ_RADIUS
WIDE = (0.75 * A0, 1.5 * A0, 1.25 * A0)


def solve(**settings: Any) -> vf.contact.ContactSolution:
    return vf.solve_steady(PROBLEM.material, PROBLEM.ball, speed=PROBLEM.speed, load=PROBLEM.load, **settings)


def test_given_grid_is_that_of_the_solution() -> None:
    solution = solve(grid=256, accuracy=1e-3)
    diagnostics = solution.diagnostics
    assert max(diagnostics.shape) in range(256, 273)  # the coarsest of the nested grids has at most two cells more
    assert [level.cells for level in diagnostics.levels[1:]] == [2 * level.cells for level in diagnostics.levels[:-1]]
    assert diagnostics.products >= sum(level.products for level in diagnostics.levels) > 0
    # the same solution as on grids that the accuracy leads to, within the errors that both tell
    free = solve(accuracy=1e-3)
    error = diagnostics.friction_error + free.diagnostics.friction_error
    assert abs(solution.friction_coefficient - free.friction_coefficient) <= error


def test_grid_need_not_be_a_power_of_two() -> None:
    diagnostics = solve(grid=150).diagnostics
    assert max(diagnostics.shape) in range(150, 161)  # 38 cells or 40, twice halved


def test_given_window_is_kept() -> None:
    solution = solve(window=WIDE, accuracy=1e-2)
    half = 0.5 * solution.diagnostics.spacing
    cell = solution.diagnostics.spacing * max(solution.diagnostics.shape) / 32  # of the coarsest grid
    for edge, wanted in (
        (half - solution.x[0], WIDE[0]), (solution.x[-1] + half, WIDE[1]), (solution.y[-1] + half, WIDE[2])
    ):  # fmt: skip
        assert wanted * (1.0 - 1e-9) <= edge <= wanted + cell
    reference = solve(accuracy=1e-3)
    assert abs(solution.friction_coefficient - reference.friction_coefficient) <= 1e-2 * reference.friction_coefficient


def test_window_and_grid_together_fix_every_cell() -> None:
    one = solve(window=("0.45 mm", "0.75 mm", "0.6 mm"), grid=128)
    other = solve(window=(0.45e-3, 0.75e-3, 0.6e-3), grid=128, accuracy=0.5, tolerance=1e-8)
    assert one.diagnostics.shape == (128, 128)
    assert one.diagnostics.spacing == pytest.approx(1.2e-3 / 128)
    np.testing.assert_array_equal(one.pressure, other.pressure)


def test_window_is_mirrored_with_the_motion() -> None:
    window = {"window": (0.4e-3, 0.8e-3, 0.6e-3), "grid": 128}
    forth = solve(**window)
    back = vf.solve_steady(PROBLEM.material, PROBLEM.ball, speed=-PROBLEM.speed, load=PROBLEM.load, **window)
    np.testing.assert_allclose(back.x, -forth.x[::-1])
    # the same cells; the indenter's heights differ in their last digits, which the tolerance of 1e-8 does not see
    np.testing.assert_allclose(back.pressure, forth.pressure[::-1], atol=1e-6 * forth.max_pressure)


def test_line_contact_takes_rear_and_front() -> None:
    problem = cylinder_on_standard_linear_solid(10.0, 1.0)
    solution = problem.solve(window=(A0, 2.0 * A0), grid=384)  # type: ignore[arg-type]
    assert solution.diagnostics.shape == (384, 1)
    assert solution.x[0] == pytest.approx(-A0 + 0.5 * solution.diagnostics.spacing)


def test_contact_beyond_the_window_is_reported_in_millimetres() -> None:
    with refused("beyond-window", naming=" mm "):
        solve(window=(0.1 * A0, 1.5 * A0, 1.25 * A0))


def test_contact_that_touches_the_window_is_refused() -> None:
    free = solve(accuracy=1e-2)
    with refused("window"):
        solve(window=(1.5 * free.rear, free.front, 1.5 * free.half_width), grid=256)


@pytest.mark.parametrize(
    ("wrong", "about"),
    [
        ({"grid": 64}, "grid"),
        ({"grid": 512.0}, "grid"),
        ({"grid": True}, "grid"),
        ({"window": (1e-3, 1e-3)}, "not-a-window"),
        ({"window": "1 mm"}, "not-a-window"),
        ({"window": (1e-3, -2e-3, 1e-3)}, "not-a-window"),
        ({"window": (1e-3, 1e-3, 0.0)}, "not-a-window"),
        ({"window": (1e-3, "1 N", 1e-3)}, "front"),
    ],
)
def test_senseless_windows_and_grids_are_refused(wrong: dict[str, Any], about: str) -> None:
    with refused(about):
        solve(**wrong)
