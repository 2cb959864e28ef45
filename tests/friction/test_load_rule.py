"""Friction at one load and vertical shift follows exactly from that at another, and curves of all loads are one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from friction.synthetic_curves import curves_of
from refusals import refused
from viscofric.arrays import Array
from viscofric.contact.indenters.height_map import HeightMap
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.indenters.shapes import Ball, Cone, Cylinder
from viscofric.contact.steady import solve_steady
from viscofric.errors import InputError
from viscofric.friction.agreement import compare
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.shifting.load_rule import LoadRule
from viscofric.friction.shifting.shift import shift_friction
from viscofric.rheology.catalogue import synthetic_fluoroelastomer
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import WLF
from viscofric.rheology.shifts.vertical_shift import VerticalShiftFactors

LAW = WLF(C1=8.86, C2=101.6, reference="50 degC")
BALL = Ball(radius="9.525 mm")
VERTICAL = VerticalShiftFactors(["20 degC", "50 degC", "90 degC"], [-0.1, 0.0, 0.12], "50 degC")


@pytest.mark.parametrize("modulus", [None, "3 MPa"])
@pytest.mark.parametrize(
    ("indenter", "loads"),
    [(BALL, (5.0, 25.0)), (Cylinder(radius="10 mm"), (500.0, 2000.0)), (Cone(angle=0.1), (1.0, 8.0))],
)
def test_contacts_at_all_loads_are_alike(indenter: Indenter, loads: tuple[float, float], modulus: str | None) -> None:
    """Rigid indenters and soft ones; the grids are alike too, so that numbers are equal to rounding and tolerance."""
    rubber = Material.standard_linear_solid(E0=1e6, E_inf=1e7, tau=1e-3, poisson_ratio=0.5)
    speed, friction = LoadRule.of(indenter).factors(np.asarray(loads[1] / loads[0]))
    settings = {"accuracy": 5e-3, "indenter_modulus": modulus}
    light = solve_steady(rubber, indenter, speed=1.0, load=loads[0], **settings)  # type: ignore[arg-type]
    heavy = solve_steady(rubber, indenter, speed=float(speed), load=loads[1], **settings)  # type: ignore[arg-type]
    assert heavy.friction_coefficient == pytest.approx(float(friction) * light.friction_coefficient, rel=1e-6)


def test_an_elastic_indenter_does_not_follow_the_vertical_shift() -> None:
    """Under b = 1.2 the contact is that at F/b with E_i/b, and no longer that at F/b with E_i."""
    b, speed = 1.2, 1.0
    modes = Material.standard_linear_solid(E0=1e6, E_inf=1e7, tau=1e-3).modes_at()
    stiffer = Material(replace(modes, E0=b * modes.E0, E_inf=b * modes.E_inf, C=modes.C / b), poisson_ratio=0.5)
    reference, settings = Material(modes, poisson_ratio=0.5), {"speed": speed, "accuracy": 5e-3}
    asked = solve_steady(stiffer, BALL, load=5.0, indenter_modulus=3e6, **settings)  # type: ignore[arg-type]
    softer = solve_steady(reference, BALL, load=5.0 / b, indenter_modulus=3e6 / b, **settings)  # type: ignore[arg-type]
    same = solve_steady(reference, BALL, load=5.0 / b, indenter_modulus=3e6, **settings)  # type: ignore[arg-type]
    assert softer.friction_coefficient == pytest.approx(asked.friction_coefficient, rel=1e-6)
    assert abs(same.friction_coefficient / asked.friction_coefficient - 1.0) > 0.02


@pytest.mark.slow
def test_loads_and_vertical_shifts_make_one_curve() -> None:
    """Against direct solutions at two loads and b(T) from 0.85 to 1.1, all solved to 1e-3."""
    rubber = replace(synthetic_fluoroelastomer(), vertical_shift=VERTICAL)
    solutions = [
        solve_steady(rubber, BALL, speed=float(speed), load=load, temperature=f"{celsius} degC", accuracy=1e-3)
        for celsius, load in ((40.0, 12.0), (46.0, 25.0))
        for speed in np.geomspace(0.02, 0.2, 4)
    ]
    curves = FrictionCurves.from_solutions(solutions)
    master = shift_friction(curves, shift=rubber.shift, vertical_shift=rubber.vertical_shift, indenter=BALL, load=25.0)
    # The points of both loads lie on one curve, b(T) or not: a cubic spline through four points a decade misses 0.5 %.
    assert master.overlap.rms is not None
    assert master.overlap.rms < 0.005
    one_load = shift_friction(curves, shift=rubber.shift, indenter=BALL)
    assert one_load.overlap.rms is not None
    assert one_load.overlap.rms > 0.01
    asked = {"speed": 0.07, "temperature": "43 degC", "load": 18.0}
    direct = solve_steady(rubber, BALL, accuracy=1e-3, **asked)  # type: ignore[arg-type]
    # Two per cent of friction is a tenth of a decade of speed: the regression through eight points is true to 1 %.
    found = master(asked["speed"], asked["temperature"], load=asked["load"])  # type: ignore[arg-type]
    assert found == pytest.approx(direct.friction_coefficient, rel=0.01)
    assert master.load == 25.0
    assert master.vertical_shift is not None
    assert master.vertical_shift.reference == master.reference


def friction(reduced_speed: Array) -> Array:
    return np.asarray(0.03 * 10.0 ** (-0.2 * np.log10(reduced_speed / 0.1) - 0.1 * np.log10(reduced_speed / 0.1) ** 2))


def made(loads: Array, *, vertical: bool = False) -> FrictionCurves:
    """Friction of a ball by the rule itself, at 44, 50 and 56 °C, 10 speeds and the loads given for each point."""
    temperature = np.repeat(np.array([317.15, 323.15, 329.15]), 10)
    speed = np.tile(np.geomspace(0.02, 0.2, 10), 3)
    b = np.asarray(VERTICAL(temperature)) if vertical else 1.0
    s = (loads / (b * 25.0)) ** (1.0 / 3.0)
    return curves_of(speed, temperature, s * friction(np.asarray(LAW(temperature)) * speed / s), 0.0, load=loads)


def test_shift_factors_are_found_across_loads() -> None:
    """Loads that jitter by 4 %, or are 10 and 40 N in turn: with the ball known they cost no precision."""
    random = np.random.default_rng(3)
    for loads in (25.0 * (1.0 + 0.04 * random.uniform(-1.0, 1.0, 30)), np.repeat([10.0, 40.0, 10.0], 10)):
        for vertical in (False, True):
            curves = made(loads, vertical=vertical)
            factors = shift_friction(
                curves, indenter=BALL, vertical_shift=VERTICAL if vertical else None, reference="50 degC"
            ).shift_factors
            np.testing.assert_allclose(factors.log10_values, LAW.log10(factors.temperatures), atol=2e-3)
    with pytest.raises(InputError, check=lambda error: error.code == "several-loads"):
        shift_friction(curves)


def test_the_load_of_the_master_curve_is_chosen() -> None:
    curves = made(np.repeat([10.0, 40.0, 10.0], 10))
    for load in (10.0, 25.0):
        master = shift_friction(curves, shift=LAW, indenter=BALL, load=load)
        # The same friction at any load whatever the curve's own; smoothing weights move by rounding only.
        assert master(0.1, "50 degC", load="25 N") == pytest.approx(float(friction(np.array(0.1))), rel=0.005)
        assert master.covers(0.1, load=25.0)
    assert shift_friction(curves, shift=LAW, indenter=BALL).load == 10.0  # the median
    heavy, error = master(0.1, load=50.0), master.standard_error(0.1, load=50.0)
    assert heavy == pytest.approx(2.0 ** (1 / 3) * friction(np.array(0.1 / 2.0 ** (1 / 3))), rel=0.005)
    assert error < 0.005 * heavy  # that of smoothing: without errors, points scatter as much about the curve


def test_master_curves_of_different_tests_are_compared_at_one_load() -> None:
    """Measured at 10 and 40 N, predicted at 25 N: the same friction, to what the regression misses."""
    measured = shift_friction(made(np.repeat([10.0, 40.0, 10.0], 10)), shift=LAW, indenter=BALL, load="25 N")
    predicted = shift_friction(made(np.full(30, 25.0)), shift=LAW)
    np.testing.assert_allclose(measured.curves_at_load.load, 25.0)
    assert predicted.curves_at_load is predicted.curves
    assert compare(measured, predicted).rms < 0.005


def test_other_loads_without_a_rule_are_refused() -> None:
    master = shift_friction(made(np.full(30, 25.0)), shift=LAW)
    assert master(0.1, load="25.5 N") == master(0.1)
    with refused("indenter-needed"):
        master(0.1, load="50 N")


def test_what_lies_outside_is_reported_beforehand() -> None:
    master = shift_friction(made(np.full(30, 25.0)))
    low, high = master.reduced_range
    kelvin = master.reference
    covered = master.covers(np.array([0.99 * low, low, 0.1, high, 1.01 * high]), kelvin)
    np.testing.assert_array_equal(covered, [False, True, True, True, False])
    assert master.covers("100 mm/s", "50 degC") is True
    # No α beyond what was found: not covered, whatever the speed; half a kelvin is that of a nominal temperature.
    np.testing.assert_array_equal(master.covers("30 mm/s", ["43.6 degC", "60 degC"]), [True, False])
    assert master.covers(np.array([[0.1], [0.05]]), np.array([320.0, 325.0])).shape == (2, 2)
    with refused("not-covered", naming="1 decades"):
        master(10.0 * high, kelvin)
    with refused("not-covered", naming="0.3 decades"):
        master(0.5 * low, kelvin)


@pytest.mark.parametrize(
    ("settings", "code"),
    [
        ({"vertical_shift": VERTICAL}, "indenter-needed"),
        ({"load": 25.0}, "indenter-needed"),
        ({"indenter": Cylinder(radius=0.01)}, "load-unit"),
        ({"indenter": HeightMap(np.zeros((4, 4)), spacing=1e-3)}, "no-load-rule"),
        ({"indenter": "ball"}, "no-load-rule"),
        ({"indenter": BALL, "load": "-1 N"}, "not-positive"),
    ],
)
def test_what_has_no_rule_is_refused(settings: dict[str, object], code: str) -> None:
    with refused(code):
        shift_friction(made(np.full(30, 25.0)), shift=LAW, **settings)  # type: ignore[arg-type]
