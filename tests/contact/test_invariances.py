"""What no contact may depend on: units, how a spectrum is written down, temperature and speed in exchange."""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING

import numpy as np
import pytest

import viscofric as vf
from contact.made_surfaces import self_affine
from gallery import BALL_RADIUS, CYLINDER_LOAD, HERTZ_RADIUS, LOAD, RUBBER_MODULUS, SPEED
from viscofric.rheology.shifts.vertical_shift import VerticalShiftFactors

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    Solution = vf.contact.ContactSolution | vf.contact.PeriodicSolution

SHARES, TIMES = (0.2, 0.5, 0.3), (0.03, 0.5, 8.0)  # of 1/E0 − 1/E∞, and in units of a0/v
MODULUS_RATIO, ACCURACY = 30.0, 0.02
PERIOD, MEAN_PRESSURE, POINTS = 1e-3, 0.1 * RUBBER_MODULUS, 32


def rubber(
    moduli: float = 1.0, times: float = 1.0, shares: Sequence[float] = SHARES, tau: Sequence[float] = TIMES
) -> vf.RetardationSpectrum:
    creep = (1.0 - 1.0 / MODULUS_RATIO) / RUBBER_MODULUS
    return vf.RetardationSpectrum(
        E0=moduli * RUBBER_MODULUS,
        E_inf=moduli * MODULUS_RATIO * RUBBER_MODULUS,
        C=creep * np.array(shares) / moduli,
        tau=times * np.array(tau) * HERTZ_RADIUS / SPEED,
    )


def point(material: vf.Material, *, lengths: float = 1.0, speed: float = SPEED, force: float = 1.0, **more) -> Solution:
    ball = vf.Ball(radius=lengths * BALL_RADIUS)
    return vf.solve_steady(material, ball, speed=speed, load=force * lengths**2 * LOAD, accuracy=ACCURACY, **more)


def line(material: vf.Material, *, lengths: float = 1.0, speed: float = SPEED, force: float = 1.0, **more) -> Solution:
    cylinder = vf.Cylinder(radius=lengths * BALL_RADIUS)
    load = force * lengths * CYLINDER_LOAD
    return vf.solve_steady(material, cylinder, speed=speed, load=load, accuracy=ACCURACY, **more)


def periodic(
    material: vf.Material, *, lengths: float = 1.0, speed: float = SPEED, force: float = 1.0, **more
) -> Solution:
    z = PERIOD * self_affine(POINTS, points_per_shortest_wave=6.0)
    surface = vf.contact.PeriodicSurface(lengths * z, lengths * PERIOD / POINTS)
    pressure = force * MEAN_PRESSURE
    return vf.solve_periodic(material, surface, speed=speed, pressure=pressure, direction=(2.0, 1.0), **more)


@cache
def usual(solve: Callable[..., Solution], **settings: float) -> Solution:
    """Return the contact that the others are held against, solved once."""
    return solve(vf.Material(rubber()), **settings)


KINDS = pytest.mark.parametrize("solve", [point, line, periodic], ids=lambda one: one.__name__)


def scaled_pressure(solution: Solution, moduli: float) -> NDArray[np.float64]:
    return np.asarray(solution.pressure) / moduli


@KINDS
@pytest.mark.parametrize(("moduli", "lengths", "times"), [(1e-9, 1e9, 1e-9), (1e9, 1e-9, 1e9), (1e9, 1e9, 1e9)])
def test_nine_decades_of_modulus_length_and_time_change_nothing(
    solve: Callable[..., Solution], moduli: float, lengths: float, times: float
) -> None:
    here = usual(solve)
    there = solve(vf.Material(rubber(moduli, times)), lengths=lengths, speed=SPEED * lengths / times, force=moduli)
    # Rounding of the inputs through one and the same sequence of steps, of which single precision is a part for
    # rough surfaces: to the tolerance there.
    rel = 1e-6 if solve is periodic else 1e-9
    assert there.friction_coefficient == pytest.approx(here.friction_coefficient, rel=rel)
    assert there.indentation == pytest.approx(lengths * here.indentation, rel=rel)
    np.testing.assert_allclose(scaled_pressure(there, moduli), here.pressure, atol=1e-5 * here.max_pressure)


@KINDS
@pytest.mark.parametrize(
    ("shares", "tau"),
    [
        ((0.3, 0.2, 0.5), (8.0, 0.03, 0.5)),
        ((0.2, 0.1, 0.4, 0.3), (0.03, 0.5, 0.5, 8.0)),
        ((0.2, 0.0, 0.5, 0.3), (0.03, 1e-7, 0.5, 8.0)),
    ],
    ids=["order", "one mode split in two", "mode without compliance"],
)
def test_how_a_spectrum_is_written_down_does_not_matter(
    solve: Callable[..., Solution], shares: tuple[float, ...], tau: tuple[float, ...]
) -> None:
    one = usual(solve, tolerance=1e-10)
    other = solve(vf.Material(rubber(shares=shares, tau=tau)), tolerance=1e-10)
    # Sums in another order, then a hundred times the tolerance of the solver for its own path.
    assert other.friction_coefficient == pytest.approx(one.friction_coefficient, rel=1e-8)
    assert other.indentation == pytest.approx(one.indentation, rel=1e-8)


@KINDS
def test_temperature_is_speed_and_a_vertical_shift_is_load(solve: Callable[..., Solution]) -> None:
    """μ(v, T, F) = μ(α(T) v, T0, F/b(T)): Eq. 10 with the vertical shift's rule of loads."""
    kelvin, b = np.array([283.15, 293.15, 303.15]), 1.7
    law = vf.WLF(C1=10.0, C2=90.0, reference=293.15)
    vertical = VerticalShiftFactors(kelvin, np.array([-0.1, 0.0, math.log10(b)]), 293.15)
    material = vf.Material(rubber(), shift=law, vertical_shift=vertical)
    alpha = float(law(303.15))
    assert alpha < 0.2
    warm = solve(material, temperature=303.15)
    reference = solve(material, temperature=293.15, speed=alpha * SPEED, force=1.0 / b)
    # One and the same problem in its own units: round-off, and single precision in part for rough surfaces.
    rel = 1e-6 if solve is periodic else 1e-9
    assert warm.friction_coefficient == pytest.approx(reference.friction_coefficient, rel=rel)
    assert warm.indentation == pytest.approx(reference.indentation, rel=rel)
    np.testing.assert_allclose(scaled_pressure(warm, b), reference.pressure, atol=1e-5 * reference.max_pressure)
    # Each of the two matters by itself.
    for other in (solve(material, temperature=293.15), solve(material, temperature=293.15, speed=alpha * SPEED)):
        assert abs(other.friction_coefficient / warm.friction_coefficient - 1.0) > 0.01


@pytest.mark.parametrize(
    "moved",
    [
        lambda z: np.roll(z, (5, 3), (0, 1)),
        lambda z: z + 3.0 * z.std(),
        lambda z: np.tile(z, (2, 2)),
    ],
    ids=["moved along and across", "lifted", "two periods each way"],
)
def test_where_a_period_begins_and_how_many_there_are_changes_no_friction(
    moved: Callable[[NDArray[np.float64]], NDArray[np.float64]],
) -> None:
    z = PERIOD * self_affine(POINTS, points_per_shortest_wave=6.0)
    one, other = (
        vf.solve_periodic(
            vf.Material(rubber()),
            vf.contact.PeriodicSurface(heights, PERIOD / POINTS),
            speed=SPEED,
            pressure=MEAN_PRESSURE,
            direction=(2.0, 1.0),
            tolerance=1e-10,
        )
        for heights in (z, moved(z))
    )
    # A hundred times the tolerance; the gap is a small difference of depths.
    assert other.friction_coefficient == pytest.approx(one.friction_coefficient, rel=1e-8)
    assert other.lateral_friction_coefficient == pytest.approx(
        one.lateral_friction_coefficient, abs=1e-8 * one.friction_coefficient
    )
    assert other.mean_gap == pytest.approx(one.mean_gap, rel=1e-7)
