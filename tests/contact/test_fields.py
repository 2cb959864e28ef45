"""Fields around a contact: the surface beside and behind it, power through the surface, stresses below."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from contact.dense_reference import displacement_coefficients, displacement_matrix
from gallery import standard_linear_solid
from marks import slow
from refusals import refused
from viscofric.contact.fields import (
    Stress,
    highest_von_mises,
    line_stress,
    stress_at,
    stress_layer,
    stress_plane,
    surface_displacement,
    surface_power,
)
from viscofric.contact.reference import HertzContact, hertz_ball, hertz_line, hunter_line
from viscofric.errors import InputError

Array = NDArray[np.float64]

COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")


def components(stress: Stress) -> Array:
    return np.stack([getattr(stress, name) for name in COMPONENTS])


def centres(half_width: float, cells: int) -> Array:
    return half_width * (2.0 * np.arange(cells) + 1.0 - cells) / cells


def hertz_on_cells(cells: int, reach: float = 1.0, poisson_ratio: float = 0.3) -> tuple[HertzContact, Array, Array]:
    """Return a Hertz contact, cell centres over ±reach·a, and its pressure averaged over each cell (8 × 8 points)."""
    hertz = hertz_ball(3.0, 8e-3, 2e6, poisson_ratio)
    x = centres(reach * hertz.radius, cells)
    fine = centres(reach * hertz.radius, 8 * cells)
    pressure = hertz.pressure(fine[:, None], fine).reshape(cells, 8, cells, 8).mean(axis=(1, 3))
    return hertz, x, pressure


# --- stresses -------------------------------------------------------------------------------------


def boussinesq(x: Array, y: Array, z: float, nu: float) -> Array:
    """Stresses of a unit point load: Johnson, Contact Mechanics (1985), Eqs. 3.19."""
    r2 = x**2 + y**2
    rho = np.sqrt(r2 + z**2)
    side = (1.0 - 2.0 * nu) / r2
    near = 1.0 - z / rho
    parts = [
        side * (near * (x**2 - y**2) / r2 + z * y**2 / rho**3) - 3.0 * z * x**2 / rho**5,
        side * (near * (y**2 - x**2) / r2 + z * x**2 / rho**3) - 3.0 * z * y**2 / rho**5,
        -3.0 * z**3 / rho**5,
        -3.0 * y * z**2 / rho**5,
        -3.0 * x * z**2 / rho**5,
        # 2xy/r²: what turning the axes by θ makes of the two terms (x² − y²)/r² above
        side * (near * 2.0 * x * y / r2 - x * y * z / rho**3) - 3.0 * x * y * z / rho**5,
    ]
    return np.stack(parts) / (2.0 * np.pi)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_stress_below_one_cell_is_the_sum_of_point_loads(nu: float) -> None:
    x, y = np.array([-0.5, 0.5]), np.array([-1.0, 1.0])  # cells of 1 by 2
    pressure = np.array([[0.0, 0.0], [0.0, 3.0]])
    points = np.array([[1.9, -0.7, 0.4], [-0.8, 2.5, 1.3], [0.3, 0.2, 2.0], [0.5, 1.0, 0.6]])
    t, w = np.polynomial.legendre.leggauss(40)
    source_x, source_y = (0.5 + 0.5 * t)[:, None], 1.0 + t
    weight = 0.5 * w[:, None] * w
    found = components(stress_at(x, y, pressure, points, nu))
    for number, (px, py, pz) in enumerate(points):
        expected = 3.0 * (boussinesq(px - source_x, py - source_y, pz, nu) * weight).sum(axis=(1, 2))
        # The last point lies below the cell, where Gauss points meet the steep middle of the point load.
        assert found[:, number] == pytest.approx(expected, abs=1e-9)


def test_layer_plane_and_points_agree() -> None:
    rng = np.random.default_rng(1)
    x, y = 0.3 + 0.1 * np.arange(7.0), -0.4 + 0.2 * np.arange(5.0)
    pressure, depth = rng.random((7, 5)), 0.17
    layer = components(stress_layer(x, y, pressure, depth, 0.4))
    points = np.array([[a, b, depth] for a in x for b in y])
    assert layer.reshape(6, -1) == pytest.approx(components(stress_at(x, y, pressure, points, 0.4)), abs=1e-12)
    for j in (0, 3):
        plane = components(stress_plane(x, y, pressure, [0.5, depth], 0.4, across=y[j]))
        assert plane[:, :, 1] == pytest.approx(layer[:, :, j], abs=1e-12)
    between = components(stress_plane(x, y, pressure, depth, 0.4, across=-0.05))[:, :, 0]
    points = np.array([[a, -0.05, depth] for a in x])
    assert between == pytest.approx(components(stress_at(x, y, pressure, points, 0.4)), abs=1e-12)


@pytest.mark.parametrize("nu", [0.3, 0.5])
def test_stresses_on_the_axis_of_a_ball_are_those_of_hertz(nu: float) -> None:
    hertz, x, pressure = hertz_on_cells(64, poisson_ratio=nu)
    depth = np.array([0.1, 0.3, 0.48, 1.0, 2.5])
    points = hertz.radius * np.column_stack([0.0 * depth, 0.0 * depth, depth])
    stress = stress_at(x, x, pressure, points, nu)
    # Johnson, Contact Mechanics (1985), Eq. 3.45.
    axial = -1.0 / (1.0 + depth**2)
    radial = -(1.0 + nu) * (1.0 - depth * np.arctan(1.0 / depth)) + 0.5 / (1.0 + depth**2)
    # (cell/depth)², cell = a/32, where it is shallow.
    assert stress.zz / hertz.max_pressure == pytest.approx(axial, abs=1e-3)
    assert stress.xx / hertz.max_pressure == pytest.approx(radial, abs=2e-3)
    assert stress.yy == pytest.approx(stress.xx, abs=1e-9 * hertz.max_pressure)
    assert np.abs([stress.xy, stress.xz, stress.yz]).max() < 1e-9 * hertz.max_pressure
    assert stress.von_mises == pytest.approx(np.abs(stress.zz - stress.xx), rel=1e-9)
    assert stress.max_shear == pytest.approx(0.5 * np.abs(stress.zz - stress.xx), rel=1e-9)


@pytest.mark.parametrize(("nu", "cells", "error"), [(0.3, 65, 1e-3), (0.5, 65, 1e-3), (0.5, 21, 6e-3)])
def test_highest_von_mises_stress_lies_half_a_radius_below_a_ball(nu: float, cells: int, error: float) -> None:
    hertz, x, pressure = hertz_on_cells(cells, 1.1, poisson_ratio=nu)
    found = highest_von_mises(x, x, pressure, nu)

    def on_axis(z: float) -> float:
        return -(1.0 + nu) * (1.0 - z * math.atan(1.0 / z)) + 1.5 / (1.0 + z**2)

    best = minimize_scalar(lambda z: -on_axis(z), bounds=(0.2, 0.8), method="bounded")
    if nu == 0.3:  # Johnson, Sec. 4.2: 0.62 p0 at 0.48 a
        assert (-best.fun, best.x) == pytest.approx((0.62, 0.48), abs=2e-3)
    # (cell/depth)²/5, cells of a/30 and a/10; the maximum is flat, so its depth is known less well.
    assert found.von_mises / hertz.max_pressure == pytest.approx(-best.fun, abs=error)
    assert found.depth / hertz.radius == pytest.approx(best.x, abs=10.0 * error)
    assert (found.x, found.y) == pytest.approx((0.0, 0.0), abs=1e-12)


def test_highest_von_mises_stress_below_a_cylinder() -> None:
    hertz, nu = hertz_line(40.0, 8e-3, 2e6, 0.3), 0.3
    x = centres(1.05 * hertz.half_width, 301)
    found = highest_von_mises(x, [0.0], hertz.pressure(x)[:, None], nu)

    def on_axis(z: float) -> float:  # Johnson, Eqs. 4.46
        along, down = 2.0 * z - (1.0 + 2.0 * z**2) / math.hypot(1.0, z), -1.0 / math.hypot(1.0, z)
        across = nu * (along + down)
        return math.sqrt(0.5 * ((along - down) ** 2 + (down - across) ** 2 + (across - along) ** 2))

    best = minimize_scalar(lambda z: -on_axis(z), bounds=(0.3, 1.2), method="bounded")
    assert found.von_mises / hertz.max_pressure == pytest.approx(-best.fun, abs=1e-3)
    assert found.depth / hertz.half_width == pytest.approx(best.x, abs=1e-2)
    assert (found.x, found.y) == pytest.approx((0.0, 0.0), abs=1e-12)


@pytest.mark.parametrize("depth", [*slow(0.05), 0.5, 1.0])
def test_every_plane_carries_the_load(depth: float) -> None:
    reach = 12.0
    hertz, x, pressure = hertz_on_cells(192, reach)
    depth *= hertz.radius
    stress = stress_layer(x, x, pressure, depth, 0.3)
    cell = (x[1] - x[0]) ** 2
    load = pressure.sum() * cell
    # Beyond a radius L, a point load leaves (z/L)³ of itself; a square window lies beyond its inner circle.
    left = (depth / (reach * hertz.radius)) ** 3
    assert -stress.zz.sum() * cell == pytest.approx(load, rel=left + 1e-6)
    # No force acts sideways on any plane.
    assert abs(stress.xz.sum()) * cell < 1e-9 * load


def test_equilibrium_holds_at_every_point() -> None:
    """∂σ_xx/∂x + ∂τ_xy/∂y + ∂τ_xz/∂z = 0 and its two companions, by differences."""
    rng = np.random.default_rng(2)
    x = y = centres(1.0, 6)
    pressure, step = rng.random((6, 6)), 1e-3
    place = np.array([0.21, -0.43, 0.6])
    shifts = step * np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
    around = stress_at(x, y, pressure, place + shifts, 0.35)
    along = {name: getattr(around, name) for name in COMPONENTS}
    rows = (("xx", "xy", "xz"), ("xy", "yy", "yz"), ("xz", "yz", "zz"))
    for row in rows:
        terms = [(along[name][2 * axis] - along[name][2 * axis + 1]) / (2.0 * step) for axis, name in enumerate(row)]
        # Second-order differences: step², relative to terms of order one.
        assert abs(sum(terms)) < 1e-5
        assert max(map(abs, terms)) > 1e-2


def test_stress_and_displacement_converge_with_the_square_of_the_cell() -> None:
    depth, stresses, surfaces = 0.48, [], []
    for cells in (16, 32, 64, 128):
        hertz, x, pressure = hertz_on_cells(cells)
        stress = stress_at(x, x, pressure, hertz.radius * np.array([[0.0, 0.0, depth]]), 0.3)
        stresses.append(stress.zz[0] / hertz.max_pressure + 1.0 / (1.0 + depth**2))
        surface = surface_displacement(x, x, pressure, speed=0.0, E_inf=2e6, C=[], tau=[], poisson_ratio=0.3)
        r2 = x[:, None] ** 2 + x**2
        error = surface.displacement - hertz.indentation + r2 / 16e-3
        surfaces.append(np.abs(error[r2 < (0.9 * hertz.radius) ** 2]).max())
    for errors in (stresses, surfaces):
        orders = np.log2(np.divide(errors[:-1], errors[1:]))
        assert orders == pytest.approx(2.0, abs=0.1)


def test_equivalent_and_shear_stress_are_those_of_the_principal_stresses() -> None:
    rng = np.random.default_rng(5)
    stress = Stress(*rng.standard_normal((6, 4, 3)))
    low, middle, high = np.moveaxis(stress.principal, -1, 0)
    assert np.all((low <= middle) & (middle <= high))
    assert low + middle + high == pytest.approx(stress.xx + stress.yy + stress.zz)
    assert stress.von_mises == pytest.approx(
        np.sqrt(0.5 * ((low - middle) ** 2 + (middle - high) ** 2 + (high - low) ** 2))
    )
    assert stress.max_shear == pytest.approx(0.5 * (high - low))


def test_stress_near_the_surface_is_the_pressure() -> None:
    hertz, x, pressure = hertz_on_cells(16)
    stress = stress_layer(x, x, pressure, 1e-6 * hertz.radius, 0.3)
    # A depth of 1e-5 cells: the step from cell to cell has not spread.
    assert -stress.zz == pytest.approx(pressure, abs=1e-4 * hertz.max_pressure)


def test_line_stresses_are_those_below_a_cylinder() -> None:
    hertz = hertz_line(40.0, 8e-3, 2e6, 0.3)
    a, p0 = hertz.half_width, hertz.max_pressure
    x = centres(a, 401)
    depth = np.array([0.2, 0.78, 2.0])
    stress = line_stress(x, hertz.pressure(x), a * depth, 0.3)
    middle = 200
    # Johnson, Contact Mechanics (1985), Eqs. 4.46; 400 cells with square-root edges.
    root = np.sqrt(1.0 + depth**2)
    assert stress.xx[middle] / p0 == pytest.approx(-((1.0 + 2.0 * depth**2) / root - 2.0 * depth), abs=1e-3)
    assert stress.zz[middle] / p0 == pytest.approx(-1.0 / root, abs=1e-3)
    assert stress.yy == pytest.approx(0.3 * (stress.xx + stress.zz), abs=1e-9 * p0)
    # Eq. 4.48: the largest shear stress in the plane is 0.30 p0 at 0.78 a.
    assert 0.5 * abs(stress.xx - stress.zz)[middle, 1] / p0 == pytest.approx(0.300, abs=1e-3)
    assert np.all(stress.xz == pytest.approx(-stress.xz[::-1], abs=1e-9 * p0))


def test_line_stresses_are_those_below_a_very_long_rectangle() -> None:
    rng = np.random.default_rng(3)
    x, profile = 0.1 * np.arange(9.0), rng.random(9)
    line = components(line_stress(x, profile[:, None], [0.3, 1.0], 0.4))
    long = components(stress_plane(x, [-500.0, 500.0], np.stack([profile, profile], axis=1), [0.3, 1.0], 0.4))
    # (depth/length)², with the logarithm's and arctangent's slow decay along y in the longitudinal stress: 1e-3.
    assert long == pytest.approx(line, abs=2e-3)


@pytest.mark.parametrize("depth", [0.0, -1.0, math.nan])
def test_depth_must_be_below_the_surface(depth: float) -> None:
    x = np.arange(3.0)
    with refused("depth"):
        stress_layer(x, x, np.ones((3, 3)), depth, 0.3)
    with refused("not-finite" if math.isnan(depth) else "not-positive", naming="depth"):
        line_stress(x, np.ones(3), [1.0, depth], 0.3)


def test_fields_refuse_arrays_that_do_not_fit() -> None:
    x, ones = np.arange(3.0), np.ones((3, 3))
    with refused("pressure"):
        stress_layer(x, x, np.ones((3, 4)), 1.0, 0.3)
    with refused("not-ascending"):
        stress_plane(np.array([0.0, 1.0, 3.0]), x, ones, 1.0, 0.3)
    with refused("not-on-points"):
        stress_at(x, x, ones, [1.0, 2.0, 3.0], 0.3)
    with refused("no-contact"):
        highest_von_mises(x, x, 0.0 * ones, 0.3)
    with refused("not-a-number", naming="displacement"):
        surface_power(x, ones, np.full((3, 3), math.nan), 1.0)


# --- surface displacement ---------------------------------------------------------------------------

E0, E_INF, POISSON = 1e6, 2e7, 0.45
C, TAU = np.array([6e-7, 3.5e-7]), np.array([2e-4, 3e-3])


def test_surface_around_a_ball_is_that_of_hertz() -> None:
    hertz, x, pressure = hertz_on_cells(64, poisson_ratio=0.3)
    a, star = hertz.radius, 2e6 / (1.0 - 0.3**2)
    found = surface_displacement(
        x,
        x,
        pressure,
        speed=0.0,
        E_inf=4e6,
        C=[1.0 / 4e6],
        tau=[1.0],
        poisson_ratio=0.3,
        behind=a,
        ahead=2.0 * a,
        beside=a,
    )
    assert found.displacement.shape == (64 + 96, 128)
    assert found.x[32:96] == pytest.approx(x)
    assert found.y[32:96] == pytest.approx(x)
    r = np.hypot(found.x[:, None], found.y)
    outside = np.maximum(r, a)
    # Johnson, Contact Mechanics (1985), Eqs. 3.42.
    beyond = (2.0 * a**2 - outside**2) * np.arcsin(a / outside) + a * np.sqrt(outside**2 - a**2)
    exact = np.where(r < a, hertz.indentation - r**2 / 16e-3, hertz.max_pressure / (2.0 * a * star) * beyond)
    # Pressures are averages over cells of a/32: (cell/a)² log.
    assert found.displacement == pytest.approx(exact, abs=3e-3 * hertz.indentation)


@pytest.mark.parametrize("speed", [0.7, -0.7])
def test_surface_behind_a_moving_contact_is_the_sum_over_its_memory(speed: float) -> None:
    """Against coefficients and a dense sum that share no code with the room."""
    rng = np.random.default_rng(4)
    h = 1e-3
    x, y = h * np.arange(-1.0, 3.0), h * np.arange(3.0)
    pressure = 1e4 * rng.random((4, 3))
    found = surface_displacement(
        x,
        y,
        pressure,
        speed=speed,
        E_inf=E_INF,
        C=C,
        tau=TAU,
        poisson_ratio=POISSON,
        behind=5.5e-3,
        ahead=2e-3,
        beside=1e-3,
    )
    below, above = (6, 2) if speed > 0.0 else (2, 6)
    assert found.x == pytest.approx(h * np.arange(-1.0 - below, 3.0 + above))
    assert found.y == pytest.approx(h * np.arange(-1.0, 4.0))
    larger = np.pad(pressure, ((below, above), (1, 1)))
    ahead = larger if speed > 0.0 else larger[::-1]
    plane = 1.0 - POISSON**2
    coefficients = displacement_coefficients(12, 5, h, plane / E_INF, plane * C, abs(speed) * TAU)
    dense = (displacement_matrix(coefficients, 12, 5) @ ahead.ravel()).reshape(12, 5)
    expected = dense if speed > 0.0 else dense[::-1]
    assert found.displacement == pytest.approx(expected, rel=1e-9, abs=0.0)


def test_surface_recovers_late_behind_a_contact() -> None:
    _, x, pressure = hertz_on_cells(16)
    reach = 4.0 * (x[-1] - x[0])
    settings = {"E_inf": E_INF, "C": C, "tau": TAU, "poisson_ratio": POISSON, "behind": reach, "ahead": reach}
    moving = surface_displacement(x, x, pressure, speed=0.5, **settings).displacement  # type: ignore[arg-type]
    assert np.all(moving[:40] > moving[::-1][:40])
    # At rest and at infinite speed there is no trail, and the two differ by the moduli alone.
    resting = surface_displacement(x, x, pressure, speed=0.0, **settings).displacement  # type: ignore[arg-type]
    fastest = surface_displacement(x, x, pressure, speed=-math.inf, **settings).displacement  # type: ignore[arg-type]
    assert resting == pytest.approx(resting[::-1], rel=1e-9, abs=0.0)
    assert resting == pytest.approx(fastest * (1.0 + E_INF * C.sum()), rel=1e-9, abs=0.0)


@pytest.mark.parametrize("speed", [0.3, *slow(-0.3)])
def test_surface_of_a_line_contact_follows_hunters_cylinder(speed: float) -> None:
    radius, ratio, tau, cells = 8e-3, 20.0, 2e-3, 4001
    contact = hunter_line(40.0, radius, E0, ratio * E0, tau, abs(speed), POISSON)
    sign = math.copysign(1.0, speed)
    x = np.linspace(-contact.rear, contact.front, cells)
    pressure = contact.pressure(x)
    position, profile = (x, pressure) if speed > 0.0 else (-x[::-1], pressure[::-1])
    found = surface_displacement(
        position,
        [0.0],
        profile[:, None],
        speed=speed,
        E_inf=ratio * E0,
        C=[(1.0 - 1.0 / ratio) / E0],
        tau=[tau],
        poisson_ratio=POISSON,
        behind=contact.half_width,
        ahead=contact.half_width,
    )
    gap = found.displacement[:, 0] + found.x**2 / (2.0 * radius)
    inside = (sign * found.x > -contact.rear) & (sign * found.x < contact.front)
    depth = contact.half_width**2 / radius
    # Values at the middles of 4000 cells, square-root edges.
    assert np.ptp(gap[inside]) < 1e-4 * depth
    assert gap[~inside].min() > gap[inside].mean() - 1e-4 * depth
    assert gap[0] > gap[inside].mean() + 0.1 * depth < gap[-1]
    assert found.displacement[-1 if speed > 0.0 else 0, 0] == 0.0


def test_surface_on_rectangular_cells_is_that_on_the_squares_they_are_made_of() -> None:
    right = {"speed": 1.0, "E_inf": E_INF, "C": C, "tau": TAU, "poisson_ratio": POISSON}
    x, y = 1e-4 * np.arange(8.0), 3e-4 * np.arange(5.0)
    pressure = np.random.default_rng(8).random((8, 5))
    wide = surface_displacement(x, y, pressure, behind=3e-4, beside=6e-4, **right)  # type: ignore[arg-type]
    squares = 1e-4 * (np.arange(15.0) - 1.0)
    fine = surface_displacement(
        x,
        squares,
        np.repeat(pressure, 3, axis=1),
        behind=3e-4,
        beside=6e-4,
        **right,  # type: ignore[arg-type]
    )
    np.testing.assert_allclose(wide.y, fine.y[1::3], atol=1e-18)
    np.testing.assert_allclose(wide.displacement, fine.displacement[:, 1::3], rtol=1e-9)  # as the coefficients


def test_surface_refuses_what_it_cannot_do() -> None:
    x, ones = np.arange(4.0), np.ones((4, 4))
    right = {"speed": 1.0, "E_inf": E_INF, "C": C, "tau": TAU, "poisson_ratio": POISSON}
    surface_displacement(x, x, ones, **right)  # type: ignore[arg-type]
    for wrong in ({"behind": 1e5, "beside": 1e5}, {"ahead": -1.0}, {"tau": TAU[:1]}, {"C": -C}, {"speed": math.nan}):
        with pytest.raises(InputError):
            surface_displacement(x, x, ones, **{**right, **wrong})  # type: ignore[arg-type]


# --- power ------------------------------------------------------------------------------------------


def test_power_goes_in_at_the_front_and_comes_back_at_the_rear_of_an_elastic_contact() -> None:
    hertz, x, pressure = hertz_on_cells(64)
    surface = hertz.indentation - (x[:, None] ** 2 + x**2) / 16e-3
    power = surface_power(x, pressure, surface, 0.4)
    loaded = pressure > 0.0
    ahead = (x > 0.0)[:, None] & loaded
    assert np.all(power[ahead] > 0.0)
    assert power == pytest.approx(-power[::-1], abs=1e-9 * power.max())
    # For a paraboloid, v p x/R wherever both neighbours are in contact.
    inner = (slice(20, 44), slice(20, 44))
    assert power[inner] == pytest.approx((0.4 * pressure * x[:, None] / 8e-3)[inner], rel=1e-9, abs=1e-9)
    # Going backwards, the front is at the other end.
    assert surface_power(x, pressure, surface, -0.4) == pytest.approx(-power)


def test_power_through_the_surface_is_friction_times_speed_for_hunters_cylinder() -> None:
    radius, speed = 8e-3, 0.3
    contact = hunter_line(40.0, radius, E0, 20.0 * E0, 2e-3, speed, POISSON)
    x = np.linspace(-contact.rear, contact.front, 2002)
    pressure = contact.pressure(x)[:, None]
    power = surface_power(x, pressure, -(x[:, None] ** 2) / (2.0 * radius), speed).sum() * (x[1] - x[0])
    # Sums over 2000 cells with square-root edges: (cell/width)^1.5.
    assert power == pytest.approx(contact.friction_coefficient * 40.0 * speed, rel=1e-4, abs=0.0)


def test_power_of_a_cell_that_is_loaded_alone_has_the_slope_of_its_neighbours() -> None:
    pressure = np.array([0.0, 0.0, 3.0, 0.0])[:, None]
    surface = np.array([0.1, 0.4, 0.5, 1.0])[:, None]
    power = surface_power(np.arange(4.0), pressure, surface, 2.0)
    assert power[:, 0] == pytest.approx([0.0, 0.0, -2.0 * 3.0 * 0.3, 0.0])


def test_power_and_surface_of_a_solved_ball() -> None:
    problem = standard_linear_solid(10.0, 1.0)
    solution = problem.solve(accuracy=1e-2)
    spectrum = problem.material.spectrum
    cell = (solution.x[1] - solution.x[0]) ** 2
    power = surface_power(solution.x, solution.pressure, solution.displacement, solution.speed).sum() * cell
    # 128 cells; the slope of a cell at the edge is one-sided, that is half a cell off.
    assert power == pytest.approx(solution.friction_coefficient * solution.load * solution.speed, rel=2e-3, abs=0.0)
    around = surface_displacement(
        solution.x,
        solution.y,
        solution.pressure,
        speed=solution.speed,
        E_inf=spectrum.E_inf,  # type: ignore[union-attr]
        C=spectrum.C,  # type: ignore[union-attr]
        tau=spectrum.tau,  # type: ignore[union-attr]
        poisson_ratio=problem.material.poisson_ratio,
        behind=0.3 * solution.rear,
    )
    cells = len(solution.x)
    assert around.displacement[-cells:] == pytest.approx(solution.displacement, abs=1e-6 * solution.indentation)
    # The trail comes up again, and stays above the indenter's surface.
    r2 = around.x[:, None] ** 2 + around.y**2
    gap = around.displacement - solution.indentation + r2 / (2.0 * float(problem.ball.radius))  # type: ignore[arg-type]
    assert gap.min() > -2e-3 * solution.indentation
