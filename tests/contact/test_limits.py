"""Limits that tie the solvers to closed forms and to each other: speeds, thin layers, wide periods, oblique waves."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viscofric as vf
from gallery import (
    BALL_RADIUS,
    HERTZ_RADIUS,
    LOAD,
    SPEED,
    broad_spectrum_25,
    high_speed_friction,
    in_hertz_units,
    low_speed_friction,
    standard_linear_solid,
)
from viscofric.contact.reference import (
    ThinLayerContact,
    foundation_modulus,
    incompressible_ball,
    incompressible_line,
    winkler_ball,
    winkler_line,
)

# --- low and high speed, twelve decades of times ---------------------------------------------------


def test_friction_at_low_speed_is_better_than_the_accuracy() -> None:
    slow = standard_linear_solid(10.0, 1e-5)
    # 2e-4 was found, on 256 cells; the law's next term is about 1e-5.
    found = slow.solve(accuracy=4e-3).friction_coefficient
    assert found == pytest.approx(low_speed_friction(slow), rel=1e-3)


def test_broad_spectrum_at_high_speed() -> None:
    fast = broad_spectrum_25(1e17)
    # The shortest memory is 1e5 a0: the law's next term is k/l = 1e-4.
    assert fast.solve(accuracy=1e-3).friction_coefficient == pytest.approx(high_speed_friction(fast), rel=1.1e-3)


# --- wide periods ---------------------------------------------------------------------------------


def test_a_free_contact_is_the_limit_of_wide_periods_and_a_far_one() -> None:
    """The waves at q_x = 0 see the relaxed solid at any speed, so that images far away still spoil the friction.

    With periods of 2.4 a0 times 1, 2, 4 and 8, friction was found off by −60, −38, −19 and −6 or −7 % in independent
    calculations (E∞/E0 = 10, vτ/a0 = 10).
    """
    problem = standard_linear_solid(10.0, 10.0)
    free = in_hertz_units(problem, problem.solve(accuracy=3e-3)).friction
    cell, missing = 0.1, []
    for cells in (24, 48, 96, 192):
        x = (np.arange(cells) - cells // 2 + 0.5) * cell * HERTZ_RADIUS
        surface = vf.contact.PeriodicSurface(-(x[:, None] ** 2 + x**2) / (2.0 * BALL_RADIUS), cell * HERTZ_RADIUS)
        mean = LOAD / (cells * cell * HERTZ_RADIUS) ** 2
        # The pressure is held against the parabola's own slope, which has kinks where the periods join.
        found = vf.solve_periodic(problem.material, surface, speed=SPEED, pressure=mean, tolerance=1e-6)
        lean = float((found.pressure.mean(axis=1) @ x) / (BALL_RADIUS * found.pressure.mean(axis=1).sum()))
        missing.append(lean * BALL_RADIUS / HERTZ_RADIUS / free - 1.0)
    # Cells of a tenth of a0 leave 1 or 2 % at the edges.
    np.testing.assert_allclose(missing, [-0.60, -0.38, -0.19, -0.065], atol=0.02)


# --- thin layers ----------------------------------------------------------------------------------


def thin_layer_error(known: ThinLayerContact, load: float, poisson_ratio: float, bonded: bool, plane: bool) -> float:
    """Relative error of the largest pressure of a cylinder (`plane`) or ball whose contact is one unit in radius.

    The radius of curvature is 100; the period of three is wide for layers this thin, which do not feel neighbours.
    The contact's width is checked on the way.
    """
    points, period, radius = (512, 3.0, 100.0) if plane else (96, 3.0, 100.0)
    x = (np.arange(points) - points // 2) * period / points
    z = -(x**2) / (2.0 * radius) if plane else -(x[:, None] ** 2 + x**2) / (2.0 * radius)
    rubber = vf.Material.standard_linear_solid(1.0, 10.0, 1.0, poisson_ratio)
    solution = vf.solve_periodic(
        rubber,
        vf.contact.PeriodicSurface(z, period / points),
        speed=0.0,
        pressure=load / (period if plane else period**2),
        layer=vf.Layer(known.thickness, bonded),
    )
    area = 2.0 if plane else math.pi
    reached = (solution.contact_area_fraction * (period if plane else period**2) / area) ** (1.0 if plane else 0.5)
    # The edge of a layer's contact is off by some layer thicknesses: 1.4 H where it is incompressible, as found; and
    # the width is counted in cells.
    assert reached == pytest.approx(1.0, abs=1.7 * known.thickness + 2.0 * period / points)
    return solution.max_pressure / known.max_pressure - 1.0


@pytest.mark.parametrize("plane", [True, False], ids=["cylinder", "ball"])
@pytest.mark.parametrize(("poisson_ratio", "bonded"), [(0.3, True), (0.45, True), (0.3, False), (0.5, False)], ids=str)
def test_thin_layers_are_foundations(plane: bool, poisson_ratio: float, bonded: bool) -> None:
    errors = []
    for thickness in (0.1, 0.025):
        foundation = foundation_modulus(1.0, poisson_ratio, "bonded" if bonded else "frictionless")
        contact, unit = (winkler_line, 2.0 / 3.0) if plane else (winkler_ball, 0.25 * math.pi)
        load = unit * foundation / (100.0 * thickness)  # that makes a = 1
        known = contact(load, 100.0, thickness, foundation)
        assert known.half_width == pytest.approx(1.0, rel=1e-12)
        errors.append(abs(thin_layer_error(known, load, poisson_ratio, bonded, plane)))
    # Corrections are some (H/a)², six at ν = 0.45, where the layer is nearly incompressible.
    assert errors[1] < 6.0 * 0.025**2
    assert errors[1] < 0.2 * errors[0] or errors[0] < 1e-3  # what 96 points on a parabola leave


@pytest.mark.parametrize("plane", [True, False], ids=["cylinder", "ball"])
def test_thin_bonded_incompressible_layer_must_flow_sideways(plane: bool) -> None:
    errors = []
    for thickness in (0.2, 0.1, 0.05):
        contact, unit = (incompressible_line, 2.0 / 45.0) if plane else (incompressible_ball, math.pi / 96.0)
        load = unit / (100.0 * thickness**3)
        known = contact(load, 100.0, thickness, 1.0)
        assert known.half_width == pytest.approx(1.0, rel=1e-12)
        errors.append(thin_layer_error(known, load, 0.5, True, plane))
    # The edge moves in by 1.4 H, and the pressure rises; 1 to 2 % were seen at H/a = 0.05, falling as (H/a)² or so.
    assert 0.0 < errors[2] < 0.025
    assert errors[2] < 0.4 * errors[1] < 0.4 * 0.75 * errors[0]


# --- full contact at any speed, in any direction ---------------------------------------------------


@pytest.mark.parametrize("speed", [-1e3, 1e-4, 0.3, 1e5])
@pytest.mark.parametrize("waves", [(1, 2), (3, -1)])
def test_oblique_wave_in_full_contact_has_its_closed_form(speed: float, waves: tuple[int, int]) -> None:
    """μ p̄ = A² |q| (q·n) Im E(q·v)/(4(1−ν²)) for a wave A cos q·x and a motion along n."""
    creep = np.array([0.2, 0.4, 0.3])
    rubber = vf.Material(vf.RetardationSpectrum(1.0, 10.0, creep, [1e-3, 0.1, 30.0]), poisson_ratio=0.3)
    points, amplitude, direction = (24, 20), 1e-4, np.array([0.8, 0.6])
    x, y = (np.arange(count)[:, None] / count for count in points)
    z = amplitude * np.cos(2.0 * np.pi * (waves[0] * x + waves[1] * y.T))
    spacing = (2.0 / points[0], 3.0 / points[1])  # a period of 2 by 3
    found = vf.solve_periodic(
        rubber, vf.contact.PeriodicSurface(z, spacing), speed=speed, pressure=1.0, direction=direction
    )
    q = 2.0 * np.pi * np.array([waves[0] / 2.0, waves[1] / 3.0])
    along = float(q @ direction)
    loss = complex(rubber.complex_modulus(np.array([along * speed]))[0]).imag
    expected = amplitude**2 * math.hypot(*q) * along * loss / (4.0 * (1.0 - 0.3**2))
    assert found.diagnostics.full_contact
    # Round-off of pressures of order one in a sum of order qA times smaller ones.
    assert found.friction_coefficient == pytest.approx(expected, rel=1e-9, abs=1e-15)
    assert found.pressure_friction_coefficient == pytest.approx(expected, rel=1e-9, abs=1e-15)


@pytest.mark.parametrize("bonded", [True, False])
def test_elastic_indenter_on_a_layer_is_no_layer_itself(bonded: bool) -> None:
    """Its half-space is in series with the layer: each wave of the pressure is z |q|/2 over the sum of both."""
    ratio, modulus, thickness, amplitude, points = 0.3, 4.0, 0.05, 1e-4, 32
    z = amplitude * np.cos(2.0 * np.pi * np.arange(points) / points)
    rubber, layer = vf.Material.standard_linear_solid(1.0, 10.0, 1.0, ratio), vf.Layer(thickness, bonded)
    found = vf.solve_periodic(
        rubber, vf.contact.PeriodicSurface(z, 1.0 / points), speed=0.0, pressure=1.0, layer=layer,
        indenter_modulus=modulus, indenter_poisson_ratio=0.2,
    )  # fmt: skip
    q = 2.0 * np.pi
    compliance = (1.0 - ratio**2) * float(layer.yielding(q, ratio)) + (1.0 - 0.2**2) / modulus
    assert found.diagnostics.full_contact
    # Linear: round-off of pressures of order one.
    np.testing.assert_allclose(found.pressure[:, 0] - 1.0, z * q / (2.0 * compliance), atol=1e-12)


def test_a_material_without_modes_is_elastic_at_any_speed() -> None:
    elastic = vf.Material(vf.RetardationSpectrum(3e6, 3e6 * (1.0 + 1e-9), [], []))
    found = vf.solve_steady(elastic, vf.Ball("10 mm"), speed=0.1, load=1.0, accuracy=1e-2)
    still = vf.solve_steady(elastic, vf.Ball("10 mm"), speed=0.0, load=1.0, accuracy=1e-2)
    assert found.friction_coefficient == 0.0
    assert found.indentation == pytest.approx(still.indentation, rel=1e-8)  # of E∞, which is 1e-9 stiffer
