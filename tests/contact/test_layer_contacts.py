"""Free contacts on a layer: closed forms of thin ones, the half-space, and periodic contacts far apart."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viscofric as vf
from marks import apart, slow
from refusals import refused
from viscofric.contact.fields import surface_displacement
from viscofric.contact.periodic.solve import solve_periodic
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.contact.reference.foundation import rolling_foundation_ball, rolling_foundation_line
from viscofric.contact.reference.layers import (
    foundation_modulus,
    incompressible_ball,
    incompressible_line,
    winkler_ball,
    winkler_line,
)

E0, E_INF, TAU, RADIUS, SIZE = 1e6, 1e7, 1e-3, 1e-2, 1e-3


def rubber(poisson_ratio: float, tau: float = TAU) -> vf.Material:
    return vf.Material.standard_linear_solid(E0=E0, E_inf=E_INF, tau=tau, poisson_ratio=poisson_ratio)


def indenter(line: bool) -> vf.Cylinder | vf.Ball:
    return vf.Cylinder(RADIUS) if line else vf.Ball(RADIUS)


@pytest.mark.parametrize("line", [False, True])
@pytest.mark.parametrize(("poisson_ratio", "bonded"), [(0.3, True), (0.5, False)])
def test_thin_layer_is_a_foundation(poisson_ratio: float, bonded: bool, line: bool) -> None:
    thickness = SIZE / 40.0
    modulus = foundation_modulus(E0, poisson_ratio, "bonded" if bonded else "frictionless")
    load = 2.0 * modulus * SIZE**3 / (3.0 * RADIUS * thickness)
    if not line:
        load = math.pi * modulus * SIZE**4 / (4.0 * RADIUS * thickness)
    exact = (winkler_line if line else winkler_ball)(load, RADIUS, thickness, modulus)
    found = vf.solve_steady(
        rubber(poisson_ratio), indenter(line), speed=0.0, load=load, layer=vf.Layer(thickness, bonded), accuracy=1e-2
    )
    # Of second order in H/a = 1/40, but for the edge, which lies a few tenths of H beside that of a foundation.
    assert found.indentation == pytest.approx(exact.indentation, rel=1e-3)
    assert found.max_pressure == pytest.approx(exact.max_pressure, rel=1e-3)
    assert found.front == pytest.approx(exact.half_width, abs=0.5 * thickness)
    assert any("thickness" in warning for warning in found.warnings)  # a²/2R is twice the thickness


@pytest.mark.parametrize("line", [False, True])
def test_thin_incompressible_layer_flows_sideways(line: bool) -> None:
    errors = []
    for ratio in (10.0, 20.0, 40.0):
        thickness = SIZE / ratio
        load = 2.0 * E0 * SIZE**5 / (45.0 * RADIUS * thickness**3)
        if not line:
            load = math.pi * E0 * SIZE**6 / (96.0 * RADIUS * thickness**3)
        exact = (incompressible_line if line else incompressible_ball)(load, RADIUS, thickness, E0)
        found = vf.solve_steady(
            rubber(0.5), indenter(line), speed=0.0, load=load, layer=vf.Layer(thickness), accuracy=1e-2
        )
        errors.append(max(abs(found.max_pressure / exact.max_pressure - 1.0), abs(found.front / SIZE - 1.0)))
    # The edge lies 1.5 H inside that of the closed form, which is of first order in H/a.
    assert errors[-1] < 0.05
    assert errors[0] / errors[1] == pytest.approx(2.0, abs=0.3)
    assert errors[1] / errors[2] == pytest.approx(2.0, abs=0.3)


@pytest.mark.parametrize("line", [*slow(False), True])
@pytest.mark.parametrize(("poisson_ratio", "bonded"), [(0.3, True), (0.5, False)])
@pytest.mark.parametrize("memory", [1.0, *apart(0.1, 10.0)])
def test_rolling_over_a_thin_layer_is_rolling_over_a_foundation(
    memory: float, poisson_ratio: float, bonded: bool, line: bool
) -> None:
    thickness, speed = SIZE / 20.0, memory * SIZE / TAU
    modulus = foundation_modulus(E0, poisson_ratio, "bonded" if bonded else "frictionless")
    load = 2.0 * modulus * SIZE**3 / (3.0 * RADIUS * thickness)
    if not line:
        load = math.pi * modulus * SIZE**4 / (4.0 * RADIUS * thickness)
    exact = (rolling_foundation_line if line else rolling_foundation_ball)(
        load, RADIUS, thickness, modulus, E_INF / E0 * modulus, TAU, speed
    )
    found = vf.solve_steady(
        rubber(poisson_ratio),
        indenter(line),
        speed=speed,
        load=load,
        layer=vf.Layer(thickness, bonded),
        accuracy=1e-3 if line else 4e-3,
    )
    # Of second order in H/a = 1/20, and what is asked of the grid, 4e-3.
    assert found.friction_coefficient == pytest.approx(exact.friction_coefficient, rel=6e-3)
    assert found.indentation == pytest.approx(exact.indentation, rel=3e-3)
    assert abs(found.diagnostics.energy) < 1e-2


@pytest.mark.parametrize("line", [False, True])
def test_deep_layer_is_a_half_space(line: bool) -> None:
    load = 200.0 if line else 0.5
    given = {"speed": 1.0, "load": load, "tolerance": 1e-10}
    on_half_space = vf.solve_steady(rubber(0.5), indenter(line), **given)
    on_layer = vf.solve_steady(rubber(0.5), indenter(line), **given, layer=vf.Layer(1e4))
    # The base takes away what is the same in the whole contact; what is left is (a/H)² = 1e-14, and the tolerance.
    assert on_layer.friction_coefficient == pytest.approx(on_half_space.friction_coefficient, rel=1e-6)
    np.testing.assert_allclose(on_layer.pressure, on_half_space.pressure, atol=1e-6 * on_half_space.max_pressure)
    if not line:
        assert on_layer.indentation == pytest.approx(on_half_space.indentation, rel=1e-6)


@pytest.mark.parametrize(("poisson_ratio", "bonded"), [*apart((0.3, True)), *slow((0.5, True)), (0.5, False)])
def test_balls_far_apart_on_a_layer_are_single(poisson_ratio: float, bonded: bool) -> None:
    """With a layer what one ball does to the next fades exponentially, with a memory of 0.3 mm too."""
    period, points, load, layer = 6e-3, 192, 0.5, vf.Layer(4e-4, bonded)
    material = rubber(poisson_ratio, tau=3e-4)
    single = vf.solve_steady(material, vf.Ball(RADIUS), speed=1.0, load=load, layer=layer)
    x = (np.arange(points) - 0.5 * points + 0.5) * period / points
    balls = PeriodicSurface(-(x[:, None] ** 2 + x**2) / (2.0 * RADIUS), period / points)
    many = solve_periodic(material, balls, speed=1.0, pressure=load / period**2, layer=layer)
    # The periodic grid's own error, seen by halving it: up to 9e-4 at 64 cells across the contact; 1e-3 asked of the
    # other.
    assert many.friction_coefficient == pytest.approx(single.friction_coefficient, rel=1.5e-3)
    assert many.pressure.max() == pytest.approx(single.max_pressure, rel=3e-3)
    if bonded:  # else the mean pressure lifts the sliding layer's whole surface a little
        assert many.indentation == pytest.approx(single.indentation, rel=2e-3)


def test_given_indentation_of_a_cylinder_is_the_inverse_of_a_given_load_on_a_layer() -> None:
    layer = vf.Layer(5e-4, bonded=False)
    first = vf.solve_steady(rubber(0.45), indenter(True), speed=1.0, load=3.0, layer=layer)
    back = vf.solve_steady(rubber(0.45), indenter(True), speed=1.0, indentation=first.indentation, layer=layer)
    assert back.load == pytest.approx(3.0, rel=1e-3)  # what is asked of the grids, which differ
    assert back.friction_coefficient == pytest.approx(first.friction_coefficient, rel=1e-3)


def test_elastic_cylinder_on_a_layer_has_no_far_field() -> None:
    with refused("no-level"):
        vf.solve_steady(
            rubber(0.5), vf.Cylinder(RADIUS), speed=1.0, indentation=1e-5, layer=vf.Layer(1e-3), indenter_modulus=1e7
        )
    found = vf.solve_steady(
        rubber(0.5), vf.Cylinder(RADIUS), speed=1.0, load=5.0, layer=vf.Layer(1e-3), indenter_modulus=1e7
    )
    assert abs(found.diagnostics.energy) < 0.02


@pytest.mark.parametrize("tau", [1e15, 1e40])
def test_memory_without_end_leaves_a_glassy_layer(tau: float) -> None:
    # A retardation time at low temperature: the way slid in it is longer than any integer of cells.
    glass = vf.Material.standard_linear_solid(E0=E_INF, E_inf=1.001 * E_INF, tau=TAU)
    settings = {"load": 100.0, "layer": vf.Layer(SIZE), "accuracy": 1e-2}
    found = vf.solve_steady(rubber(0.5, tau), indenter(True), speed=1.0, **settings)  # type: ignore[arg-type]
    at_rest = vf.solve_steady(glass, indenter(True), speed=0.0, **settings)  # type: ignore[arg-type]
    assert found.indentation == pytest.approx(at_rest.indentation, rel=1e-3)
    assert found.max_pressure == pytest.approx(at_rest.max_pressure, rel=1e-3)
    assert 0.0 < found.friction_coefficient < 1e-9


def test_units_do_not_matter_on_a_layer() -> None:
    one = vf.solve_steady(rubber(0.4), vf.Ball(RADIUS), speed=1.0, load=1.0, layer=vf.Layer(1e-3), accuracy=1e-2)
    material = vf.Material.standard_linear_solid(E0=1e6 * E0, E_inf=1e6 * E_INF, tau=1e9 * TAU, poisson_ratio=0.4)
    other = vf.solve_steady(
        material, vf.Ball(1e-3 * RADIUS), speed=1e-12, load=1.0, layer=vf.Layer(1e-6), accuracy=1e-2
    )
    assert other.friction_coefficient == pytest.approx(one.friction_coefficient, rel=1e-9)
    assert other.indentation == pytest.approx(1e-3 * one.indentation, rel=1e-9)


@pytest.mark.parametrize("line", [False, True])
def test_surface_of_a_layer_is_that_of_the_solution_and_at_rest_far_away(line: bool) -> None:
    layer = vf.Layer(4e-4)
    solution = vf.solve_steady(rubber(0.4), indenter(line), speed=0.2, load=1.0, layer=layer, accuracy=1e-2)
    surface = surface_displacement(
        solution.x,
        solution.y,
        solution.pressure,
        speed=0.2,
        E_inf=E_INF,
        C=[1.0 / E0 - 1.0 / E_INF],
        tau=[TAU],
        poisson_ratio=0.4,
        layer=layer,
        ahead=1e-2,
    )
    np.testing.assert_allclose(
        surface.displacement[: len(solution.x)], solution.displacement, atol=1e-9 * solution.indentation
    )
    assert np.abs(surface.displacement[-1]).max() < 1e-6 * solution.indentation  # twenty-five thicknesses ahead


def test_surface_of_a_layer_needs_cells_that_resolve_it() -> None:
    x = 1e-4 * np.arange(4.0)
    with refused("layer-too-thin"):
        surface_displacement(
            x,
            x,
            np.ones((4, 4)),
            speed=0.0,
            E_inf=E_INF,
            C=[0.0],
            tau=[TAU],
            poisson_ratio=0.4,
            layer=vf.Layer(1e-5),
        )


def test_layer_must_be_a_layer_or_a_thickness() -> None:
    for wrong, code in ((["1 mm"], "wrong-type"), ("1 N", "wrong-unit"), (0.0, "not-positive")):
        with refused(code):
            vf.solve_steady(rubber(0.3), vf.Ball(RADIUS), speed=1.0, load=1.0, layer=wrong)  # type: ignore[arg-type]
    assert vf.Layer.of("2 mm") == vf.Layer.of(2e-3) == vf.Layer("2 mm", bonded=True)
    assert vf.Layer.of(None) is None
    thin = {"speed": "1 m/s", "load": "10 N/m", "accuracy": 1e-2}
    by_text, by_layer = (
        vf.solve_steady(rubber(0.3), vf.Cylinder(RADIUS), **thin, layer=layer) for layer in ("1 mm", vf.Layer("1 mm"))
    )
    assert by_text.friction_coefficient == by_layer.friction_coefficient
