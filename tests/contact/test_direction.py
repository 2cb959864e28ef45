"""Motion in any direction over the indenter's own axes: symmetries, the force across the motion, maps and lines."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

from refusals import refused
from viscofric.contact.indenters.height_map import HeightMap, Profile
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.indenters.shapes import Ball, Cone, Ellipsoid
from viscofric.contact.reference import hertz_ellipse
from viscofric.contact.solution import ContactSolution
from viscofric.contact.steady import solve_steady
from viscofric.rheology.material import Material

RUBBER = Material.standard_linear_solid(E0=1e6, E_inf=1e7, tau=1e-3)
LONG = Ellipsoid(radius_x=30e-3, radius_y=10e-3)
#: Two solutions of one problem differ by what the solver leaves, 1e-8 of the indentation.
SAME = {"rel": 1e-6}


def at(degrees: float) -> tuple[float, float]:
    return math.cos(math.radians(degrees)), math.sin(math.radians(degrees))


@cache
def solve(
    indenter: Indenter,
    direction: tuple[float, float] = (1.0, 0.0),
    speed: float = 0.5,
    load: float = 0.1,
    accuracy: float = 0.1,
) -> ContactSolution:
    return solve_steady(RUBBER, indenter, speed=speed, load=load, direction=direction, accuracy=accuracy)


def heights(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return a summit that has no symmetry at all; its lowest point is the origin."""
    bump = x**2 / 40e-3 + y**2 / 20e-3 + 0.3 * x * y / 20e-3
    return bump * (1.0 + 60.0 * x - 90.0 * y)


@cache
def lopsided(turned: bool = False) -> HeightMap:
    x, y = np.linspace(-2.6e-3, 2.6e-3, 53), np.linspace(-2.4e-3, 2.4e-3, 49)
    z = heights(x[:, None], y)
    # Turned by a quarter clockwise: what lay along y now lies along x.
    return HeightMap(z.T[:, ::-1] if turned else z, spacing=1e-4)


def test_a_ball_does_not_feel_the_direction() -> None:
    ahead, aside = solve(Ball(radius=10e-3)), solve(Ball(radius=10e-3), (3.0, 4.0))
    assert aside.direction == (0.6, 0.8)
    assert aside.friction_coefficient == pytest.approx(ahead.friction_coefficient, **SAME)
    assert aside.indentation == pytest.approx(ahead.indentation, **SAME)
    assert abs(aside.lateral_friction_coefficient) < 1e-6 * ahead.friction_coefficient


@pytest.mark.slow
def test_ellipsoid_across_is_the_ellipsoid_with_its_radii_exchanged() -> None:
    across, exchanged = solve(LONG, (0.0, 1.0)), solve(Ellipsoid(radius_x=10e-3, radius_y=30e-3))
    for name in ("friction_coefficient", "indentation", "contact_area", "front", "rear", "half_width"):
        assert getattr(across, name) == pytest.approx(getattr(exchanged, name), **SAME)
    assert across.pressure == pytest.approx(exchanged.pressure, rel=0.0, abs=1e-6 * exchanged.max_pressure)


def test_map_turned_by_a_quarter_is_motion_along_its_second_axis() -> None:
    across, turned = solve(lopsided(), (0.0, 1.0)), solve(lopsided(turned=True))
    for name in ("friction_coefficient", "lateral_friction_coefficient", "front", "rear", "half_width"):
        assert getattr(across, name) == pytest.approx(getattr(turned, name), **SAME)


@pytest.mark.slow
def test_motion_backwards_along_a_direction_is_motion_along_the_opposite_one() -> None:
    towards, back = solve(lopsided(), (-2.0, 1.0)), solve(lopsided(), (2.0, -1.0), -0.5)
    assert back.friction_coefficient == pytest.approx(-towards.friction_coefficient, **SAME)
    assert back.lateral_friction_coefficient == pytest.approx(-towards.lateral_friction_coefficient, **SAME)
    assert (back.front, back.rear) == pytest.approx((towards.front, towards.rear), **SAME)
    assert back.x == pytest.approx(-towards.x[::-1])
    assert back.y == pytest.approx(-towards.y[::-1])
    turned = towards.pressure[::-1, ::-1]
    assert back.pressure == pytest.approx(turned, rel=0.0, abs=1e-6 * towards.max_pressure)


@pytest.mark.slow
def test_symmetric_indenter_is_mirrored_with_its_direction() -> None:
    left, right = solve(LONG, at(30.0)), solve(LONG, at(-30.0))
    assert left.friction_coefficient == pytest.approx(right.friction_coefficient, **SAME)
    assert left.lateral_friction_coefficient == pytest.approx(-right.lateral_friction_coefficient, **SAME)
    assert left.half_width == pytest.approx(right.half_width, **SAME)
    assert left.pressure == pytest.approx(right.pressure[:, ::-1], rel=0.0, abs=1e-6 * left.max_pressure)


def test_energy_balances_whatever_the_direction() -> None:
    for indenter, direction in ((LONG, at(30.0)), (Cone(angle=0.1), at(20.0))):
        solution = solve(indenter, direction, accuracy=3e-3)
        # Both friction coefficients settle as the grids do, each to the accuracy.
        assert abs(solution.diagnostics.energy) < 3e-3
        assert solution.friction_coefficient > 0.0


def test_map_of_an_ellipsoid_turns_like_the_ellipsoid() -> None:
    x, y = np.linspace(-4e-3, 4e-3, 81), np.linspace(-2e-3, 2e-3, 81)
    sampled = HeightMap(LONG.height(x[:, None], y), spacing=(1e-4, 5e-5))
    found, expected = solve(sampled, at(30.0)), solve(LONG, at(30.0))
    # A bicubic spline through a paraboloid is that paraboloid; units, hence grids, differ in rounding only.
    for name in ("friction_coefficient", "lateral_friction_coefficient", "indentation"):
        assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=1e-5)


def test_friction_at_low_speed_is_a_symmetric_tensor() -> None:
    # To first order in the speed F_i = Σ_k τ_k C_k E0 v_j ∫ ∂_i p K ∂_j p, of the elastic pressure p.
    slow = {"speed": 5e-3, "accuracy": 1e-2}
    along, across, oblique = (solve(LONG, at(degrees), **slow) for degrees in (0.0, 90.0, 30.0))
    x, y, turned = (one.friction_coefficient for one in (along, across, oblique))
    # The accuracy asked for, and terms of second order in vτ/a, (vτ/a)² = 2e-5 here.
    assert turned == pytest.approx(0.75 * x + 0.25 * y, rel=1e-2)
    lean = 0.5 * math.sin(math.radians(60.0)) * (y - x)
    # The lean of a pressure that hardly leans settles with the first power of the cell.
    assert oblique.lateral_friction_coefficient == pytest.approx(lean, rel=0.06)
    assert lean > 0.1 * x  # not small


def test_elastic_footprint_is_the_turned_ellipse() -> None:
    hertz = hertz_ellipse(0.1, 30e-3, 10e-3, 1e6, 0.5)
    a, b = hertz.semi_axis_x, hertz.semi_axis_y
    c, s = at(40.0)
    solution = solve(LONG, (c, s), 0.0)
    assert solution.contact_area == pytest.approx(math.pi * a * b, rel=0.02)  # edges to a fraction of a cell
    near = {"abs": 0.5 * solution.diagnostics.spacing}
    assert solution.half_width == pytest.approx(math.hypot(a * s, b * c), **near)
    assert solution.front == pytest.approx(1.0 / math.hypot(c / a, s / b), **near)
    assert solution.rear == pytest.approx(solution.front, **near)


def test_contact_is_compared_with_the_map_along_the_maps_own_axes() -> None:
    slim = HeightMap(LONG.height(np.linspace(-3e-3, 3e-3, 61)[:, None], np.linspace(-1.1e-3, 1.1e-3, 23)), spacing=1e-4)
    assert solve(slim, (0.0, 1.0)).half_width > 1.1e-3  # longer than the map is wide
    with refused("beyond-indenter"):
        solve(slim, (0.0, 1.0), load=3.0)


def test_line_contact_moves_both_ways() -> None:
    z = np.linspace(-1e-3, 1e-3, 41) ** 2 * (1.0 + 50.0 * np.linspace(-1e-3, 1e-3, 41)) / 20e-3
    profile = Profile(z, spacing=5e-5)
    towards, back = solve(profile, (-1.0, 0.0), load=50.0), solve(profile, (1.0, 0.0), -0.5, load=50.0)
    assert towards.friction_coefficient == pytest.approx(-back.friction_coefficient, **SAME)
    assert towards.lateral_friction_coefficient == 0.0


@pytest.mark.parametrize("direction", [(0.0, 0.0), (1.0,), "north", (math.nan, 1.0)])
def test_direction_must_be_one(direction: object) -> None:
    with refused("direction"):
        solve_steady(RUBBER, LONG, speed=1.0, load=1.0, direction=direction)  # type: ignore[arg-type]
