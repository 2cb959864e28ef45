"""Contacts whose Coulomb friction changes the pressure: closed form, Fourier series, two ways to the friction."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.linalg import expm

import viscofric as vf
from contact.strip_reference import SlidingStrip
from refusals import refused
from viscofric.contact.bodies import half_space_coupling

RADIUS, MODULUS = 0.01, 1e6
LOAD = 100.0  # N/m


def rubber(poisson_ratio: float) -> vf.Material:
    return vf.Material.standard_linear_solid(E0=MODULUS, E_inf=10.0 * MODULUS, tau="1 ms", poisson_ratio=poisson_ratio)


def sliding_cylinder(modulus: float, coupling: float) -> tuple[float, float, float]:
    """Friction coefficient, front and rear of a parabolic cylinder that slips on an elastic half-space.

    K. L. Johnson, Contact Mechanics (1985), section 7.2, with E/(1−ν²) and μ β: p ~ (a − x)^γ (a + x)^(1−γ) about a
    middle that lies (2γ − 1) a behind the axis.
    """
    power = 0.5 + math.atan(coupling) / math.pi
    # ∫ (1−s)^γ (1+s)^(1−γ) ds = 2πγ(1−γ)/sin πγ, and its mean s is (1 − 2γ)/3
    a = math.sqrt(LOAD * RADIUS / (math.pi * modulus * power * (1.0 - power)))
    middle = (1.0 - 2.0 * power) * a
    return (middle + (1.0 - 2.0 * power) * a / 3.0) / RADIUS, middle + a, a - middle


@pytest.mark.parametrize(("poisson_ratio", "thickness"), [(0.3, 2e-3), (0.5, 5e-4)])
@pytest.mark.parametrize(("speed", "coulomb"), [(0.0, 0.8), (1.0, 0.8), (1.0, -0.8)])
@pytest.mark.parametrize("bonded", [True, False])
def test_a_cylinder_that_slides_on_a_strip_agrees_with_a_dense_solver(
    poisson_ratio: float, thickness: float, speed: float, coulomb: float, bonded: bool
) -> None:
    """Elastic and viscoelastic, half and twice as thick as the contact is wide; 201 points have errors of 3e-4."""
    layer = vf.Layer(thickness, bonded)
    found = vf.solve_steady(
        rubber(poisson_ratio), vf.Cylinder(RADIUS), speed=speed, load=LOAD, coulomb=coulomb, layer=layer
    )
    half, modulus = 1.25 * max(found.front, found.rear), 10.0 * MODULUS if speed else MODULUS
    strip = SlidingStrip(RADIUS, LOAD, thickness, poisson_ratio, coulomb, MODULUS, modulus, 1e-3 * speed, bonded)
    friction, front, rear = strip.friction(half, 201)
    assert found.friction_coefficient == pytest.approx(friction, rel=5e-4)
    if bonded or speed == 0.0:
        assert found.friction_coefficient * (1.0 if speed else coulomb * (2.0 * poisson_ratio - 0.8)) > 0.0
    step = 2.0 * half / 200  # tractions that are linear between points end up to two steps from an edge
    assert found.front == pytest.approx(front, abs=2.0 * step)
    assert found.rear == pytest.approx(rear, abs=2.0 * step)


@pytest.mark.parametrize("coulomb", [1.0, -0.4])
def test_an_elastic_cylinder_has_the_pressure_of_the_closed_form(coulomb: float) -> None:
    found = vf.solve_steady(rubber(0.3), vf.Cylinder(RADIUS), speed=0.0, load=LOAD, coulomb=coulomb)
    friction, front, rear = sliding_cylinder(MODULUS / (1.0 - 0.3**2), coulomb * half_space_coupling(0.3))
    assert found.friction_coefficient == pytest.approx(friction, rel=1e-3)  # the accuracy asked for
    assert found.friction_coefficient == pytest.approx(friction, abs=found.diagnostics.friction_error)
    assert found.front == pytest.approx(front, abs=found.diagnostics.edge_error)
    assert found.rear == pytest.approx(rear, abs=found.diagnostics.edge_error)


@pytest.mark.parametrize("ratio", [3.0, 5.0])
def test_the_stated_error_holds_where_shear_makes_edges_steeper_or_flatter_than_a_root(ratio: float) -> None:
    """There the energy that cells leave out is not that of a square root, and may change little from grid to grid."""
    short = vf.Material.standard_linear_solid(MODULUS, ratio * MODULUS, 7e-6, poisson_ratio=0.0)
    contact = {"speed": 1.0, "load": 10.0, "coulomb": -0.65}
    found = vf.solve_steady(short, vf.Cylinder(RADIUS), accuracy=1e-2, **contact)
    fine = vf.solve_steady(short, vf.Cylinder(RADIUS), grid=4096, **contact)
    assert fine.diagnostics.friction_error < 0.1 * found.diagnostics.friction_error
    assert found.friction_coefficient == pytest.approx(fine.friction_coefficient, abs=found.diagnostics.friction_error)


def test_an_elastic_indenter_is_sheared_the_other_way() -> None:
    """Two half-spaces act as one with 1/E* = A + B and the coupling (A β − B β_i)/(A + B); alike, they do not tilt."""
    pair = {"speed": 0.0, "load": LOAD, "coulomb": 1.0, "indenter_poisson_ratio": 0.1}
    found = vf.solve_steady(rubber(0.3), vf.Cylinder(RADIUS), indenter_modulus=2.0 * MODULUS, **pair)
    one, other = (1.0 - 0.3**2) / MODULUS, (1.0 - 0.1**2) / (2.0 * MODULUS)
    coupling = (one * half_space_coupling(0.3) - other * half_space_coupling(0.1)) / (one + other)
    assert found.friction_coefficient == pytest.approx(sliding_cylinder(1.0 / (one + other), coupling)[0], rel=1e-3)
    alike = vf.solve_steady(rubber(0.1), vf.Cylinder(RADIUS), indenter_modulus=MODULUS, **pair)
    assert abs(alike.friction_coefficient) < 1e-9


@pytest.mark.parametrize("bonded", [False, True])
def test_both_ways_to_the_friction_of_a_sheared_ball_agree(bonded: bool) -> None:
    layer = vf.Layer("0.5 mm") if bonded else None
    found = vf.solve_steady(rubber(0.3), vf.Ball(RADIUS), speed=0.5, load=0.5, coulomb=0.8, layer=layer, accuracy=5e-3)
    # What cells leave out of the energy is estimated as without shear: 0.6 % is what that costs on these cells.
    assert found.energy_friction_coefficient == pytest.approx(found.pressure_friction_coefficient, rel=1e-2)
    # from a solution with accuracy 2e-4
    assert found.friction_coefficient == pytest.approx(0.02894026 if bonded else 0.01875154, rel=5e-3)


@pytest.mark.slow
def test_a_sheared_ball_on_a_bonded_layer_agrees_with_fourier_series() -> None:
    """Transfer functions of waves against kernels in space; images of the contact are eight thicknesses away."""
    layer, period, points = vf.Layer("0.5 mm"), 8e-3, 128
    x = (np.arange(points) - 0.5 * points) * period / points
    surface = vf.contact.PeriodicSurface(-(x[:, None] ** 2 + x**2) / (2.0 * RADIUS), spacing=period / points)
    for coulomb, speed in ((0.8, 0.5), (-0.8, -0.5)):  # slip with and against the motion, and motion to and fro
        motion = {"speed": speed, "coulomb": coulomb, "layer": layer}
        free = vf.solve_steady(rubber(0.3), vf.Ball(RADIUS), load=0.5, accuracy=5e-3, **motion)
        periodic = vf.solve_periodic(rubber(0.3), surface, pressure=0.5 / period**2, **motion)
        errors = free.diagnostics.friction_error + periodic.diagnostics.friction_error
        assert periodic.friction_coefficient == pytest.approx(free.friction_coefficient, abs=errors)


def test_full_contact_under_shear_has_the_friction_of_each_wave() -> None:
    """A wave of amplitude h needs the pressure h/T: F = q Im T |p̂|²/2 with T of the half-space under shear."""
    points, amplitude, coulomb, pressure = 32, 1e-6, 0.7, 1e6
    wave = vf.contact.PeriodicSurface(
        amplitude * np.cos(2.0 * np.pi * np.arange(points) / points), spacing=1e-3 / points
    )
    found = vf.solve_periodic(rubber(0.3), wave, speed=0.0, pressure=pressure, coulomb=coulomb)
    q = 2.0 * np.pi / 1e-3
    transfer = 2.0 * (1.0 - 0.3**2) / (MODULUS * q) * (1.0 - 1j * coulomb * half_space_coupling(0.3))
    force = 0.5 * q * transfer.imag * (amplitude / abs(transfer)) ** 2
    assert found.friction_coefficient == pytest.approx(force / pressure, rel=1e-9)
    assert found.coulomb == coulomb


def test_shear_does_not_move_an_incompressible_half_space() -> None:
    soft = {"speed": 0.5, "load": 0.5, "accuracy": 0.05}
    plain = vf.solve_steady(rubber(0.5), vf.Ball(RADIUS), **soft)
    sheared = vf.solve_steady(rubber(0.5), vf.Ball(RADIUS), coulomb=1.0, **soft)
    assert sheared.friction_coefficient == plain.friction_coefficient
    assert sheared.to_dataset().attrs["coulomb"] == 1.0
    assert "power" in plain.numbers
    assert "power" not in sheared.numbers


def test_a_sheared_ball_on_a_sliding_layer_agrees_with_fourier_series() -> None:
    """At rest, up to the tilt by the images: shear raises the distant surface by (1−ν²)/(πE) μ F X0 x/r².

    Images, with a mean of zero, add the slope −π/L² of x/r², and the friction coefficient is that of the indenter.
    """
    layer, period, points = vf.Layer("0.5 mm", bonded=False), 8e-3, 64
    x = (np.arange(points) - 0.5 * points) * period / points
    surface = vf.contact.PeriodicSurface(-(x[:, None] ** 2 + x**2) / (2.0 * RADIUS), spacing=period / points)
    sheared = {"speed": 0.0, "coulomb": 0.8, "layer": layer}
    free = vf.solve_steady(rubber(0.3), vf.Ball(RADIUS), load=0.5, accuracy=5e-3, **sheared)
    periodic = vf.solve_periodic(rubber(0.3), surface, pressure=0.5 / period**2, **sheared)
    tilt = (1.0 - 0.3**2) / MODULUS * 0.8 * 0.5 * -layer.long_coupling(0.3) / period**2
    errors = free.diagnostics.friction_error + periodic.diagnostics.friction_error
    assert tilt > 2.0 * errors
    assert periodic.friction_coefficient + tilt == pytest.approx(free.friction_coefficient, abs=errors)


@pytest.mark.parametrize("poisson_ratio", [0.1, 0.3, 0.5 - 1e-9])
@pytest.mark.parametrize("depth", [0.01, 0.3, 1.0, 3.0])
@pytest.mark.parametrize("bonded", [True, False])
def test_coupling_of_a_layer_solves_its_equations(poisson_ratio: float, depth: float, bonded: bool) -> None:
    """The equations of `viscofric.contact.bodies` in Q = qz, integrated by a matrix exponential."""
    nu = poisson_ratio
    rows = [
        [0.0, 1.0, 2.0 * (1.0 + nu), 0.0],
        [-nu / (1.0 - nu), 0.0, 0.0, (1.0 + nu) * (1.0 - 2.0 * nu) / (1.0 - nu)],
        [1.0 / (1.0 - nu**2), 0.0, 0.0, nu / (1.0 - nu)],
        [0.0, 0.0, -1.0, 0.0],
    ]
    through, base = expm(depth * np.array(rows)), [2, 3] if bonded else [0, 3]
    given = np.linalg.solve(through[2:, base], [1.0, 0.0])  # at the base, for T = 1 and Σ = 0 on the top
    raised = through[1, base] @ given / (2.0 * (1.0 - nu**2))
    assert vf.Layer(1.0, bonded).coupling(depth, nu) == pytest.approx(raised, rel=1e-8, abs=1e-8)


def test_what_shear_cannot_be_asked_for() -> None:
    contact = {"speed": 1.0, "load": 1.0, "coulomb": 0.3}
    with refused("no-derivatives"):
        vf.solve_steady(rubber(0.3), vf.Ball(RADIUS), derivatives=True, **contact)
    with refused("out-of-range"):
        vf.solve_steady(rubber(0.3), vf.Ball(RADIUS), **{**contact, "coulomb": 30.0})
