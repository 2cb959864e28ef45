"""Closed forms, each against quadrature or an elasticity problem solved afresh here, and against known numbers."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import dblquad, quad
from scipy.linalg import expm
from scipy.optimize import brentq

from refusals import refused
from viscofric.contact.reference import (
    HertzContact,
    crossed_waves,
    flat_punch,
    foundation_modulus,
    full_contact_wave,
    hertz_ball,
    hertz_ellipse,
    hertz_line,
    incompressible_ball,
    incompressible_line,
    sneddon_cone,
    westergaard,
    winkler_ball,
    winkler_line,
)

Array = NDArray[np.float64]

E, NU, R = 2e6, 0.45, 8e-3  # Pa, –, m
E_STAR = E / (1.0 - NU**2)


# --- Hertz ----------------------------------------------------------------------------------------


def test_ball_pressure_carries_the_load_and_makes_the_indentation() -> None:
    hertz = hertz_ball(3.0, R, E, NU)
    load = quad(lambda r: 2.0 * math.pi * r * float(hertz.pressure(r)), 0.0, hertz.radius)[0]
    depth = 2.0 / E_STAR * quad(lambda r: float(hertz.pressure(0.0, r)), 0.0, hertz.radius)[0]
    # Adaptive quadrature of a square-root edge: 1e-7 and better.
    assert load == pytest.approx(3.0, rel=1e-7)
    assert depth == pytest.approx(hertz.indentation, rel=1e-7)
    assert hertz.pressure(1.01 * hertz.radius) == 0.0
    assert hertz_ball("3 N", "8 mm", "2 MPa", NU) == HertzContact(hertz.radius, hertz.indentation, hertz.max_pressure)


def test_cylinder_pressure_carries_the_load_and_bends_the_surface_like_the_cylinder() -> None:
    hertz = hertz_line(40.0, R, E, NU)
    a = hertz.half_width
    assert quad(lambda x: float(hertz.pressure(x)), -a, a)[0] == pytest.approx(40.0, rel=1e-7)
    for x in (-0.7 * a, 0.2 * a, 0.9 * a):
        # u' = −2/(πE*) PV ∫ p(s)/(x − s) ds must be −x/R
        principal = -quad(lambda s: float(hertz.pressure(s)), -a, a, weight="cauchy", wvar=x)[0]
        assert -2.0 / (math.pi * E_STAR) * principal == pytest.approx(-x / R, rel=1e-5)


@pytest.mark.parametrize("ratio", [1.0, 1.0 + 1e-9, 1.3, 7.0, 400.0, 1e5])
def test_elliptic_contact_fits_the_ellipsoid_everywhere(ratio: float) -> None:
    """Under Hertz's pressure each chord through a point adds (π/4) × (its length) × (its highest pressure)."""
    hertz = hertz_ellipse(3.0, ratio * R, R, E, NU)
    ax, ay, p0 = hertz.semi_axis_x, hertz.semi_axis_y, hertz.max_pressure
    assert p0 * ax * ay * 2.0 * math.pi / 3.0 == pytest.approx(3.0, rel=1e-12)

    def displacement(x: float, y: float) -> float:
        def chord(angle: float) -> float:
            cx, cy = math.cos(angle) / ax, math.sin(angle) / ay
            square, half, rest = cx**2 + cy**2, cx * x / ax + cy * y / ay, 1.0 - (x / ax) ** 2 - (y / ay) ** 2
            return (half**2 / square + rest) / math.sqrt(square)

        # Most of the integral stems from directions along the ellipse.
        narrow = ay / ax
        ends = [-math.pi / 2.0, -3.0 * narrow, 0.0, 3.0 * narrow, math.pi / 2.0]
        ends = sorted({max(-math.pi / 2.0, min(math.pi / 2.0, end)) for end in ends})
        total = sum(quad(chord, low, high, limit=200)[0] for low, high in pairwise(ends))
        return 0.5 * p0 * total / E_STAR

    for x, y in ((0.0, 0.0), (0.8 * ax, 0.0), (0.0, 0.9 * ay), (0.5 * ax, -0.6 * ay)):
        surface = hertz.indentation - x**2 / (2.0 * ratio * R) - y**2 / (2.0 * R)
        assert displacement(x, y) == pytest.approx(surface, rel=2e-7, abs=0.0)


def test_elliptic_contact_is_the_ball_for_equal_radii_and_turns_with_them() -> None:
    ball, ellipse = hertz_ball(3.0, R, E, NU), hertz_ellipse(3.0, R, R, E, NU)
    found = ellipse.semi_axis_x, ellipse.semi_axis_y, ellipse.indentation, ellipse.max_pressure
    assert found == pytest.approx((ball.radius, ball.radius, ball.indentation, ball.max_pressure), rel=1e-9)
    long_x, long_y = hertz_ellipse(3.0, 5.0 * R, R, E, NU), hertz_ellipse(3.0, R, 5.0 * R, E, NU)
    assert long_x.semi_axis_x == long_y.semi_axis_y > long_x.semi_axis_y
    assert long_x.pressure(1e-4, 2e-4) == long_y.pressure(2e-4, 1e-4) > 0.0


def test_very_long_ellipse_is_a_cylinder_in_its_middle() -> None:
    ellipse = hertz_ellipse(3.0, 1e8 * R, R, E, NU)
    line = hertz_line(math.pi / 2.0 * ellipse.max_pressure * ellipse.semi_axis_y, R, E, NU)
    # (b/a)² ln(a/b) is what the ends still do: about 1e-11.
    assert ellipse.semi_axis_y == pytest.approx(line.half_width, rel=1e-9)


@pytest.mark.parametrize("ratio", [-0.1, 0.51])
def test_poisson_ratio_must_be_one_of_rubber(ratio: float) -> None:
    with refused("poisson-ratio"):
        hertz_ball(3.0, R, E, ratio)


# --- waves ----------------------------------------------------------------------------------------


def periodic_displacement(pressure: Array, wavelength: float) -> Array:
    """û = 2 p̂/(E* |q|) of an elastic half-space, its mean left out; the array is square, or one row."""
    axes = [np.fft.fftfreq(n, wavelength / n) * 2.0 * np.pi for n in pressure.shape]
    q = np.hypot(axes[0][:, None], axes[1]) if pressure.ndim == 2 else np.abs(axes[0])
    spectrum = np.fft.fftn(pressure)
    spectrum[(0,) * pressure.ndim] = 0.0
    return np.real(np.fft.ifftn(2.0 / E_STAR * spectrum / np.where(q == 0.0, 1.0, q)))


@pytest.mark.parametrize("filled", [0.03, 0.4, 0.95, 1.0, 1.7])
def test_westergaard_pressure_presses_the_half_space_onto_the_wave(filled: float) -> None:
    wavelength, amplitude, cells = 2e-3, 3e-5, 2**15
    mean = filled * math.pi * E_STAR * amplitude / wavelength
    contact = westergaard(mean, amplitude, wavelength, E, NU)
    x = wavelength * (np.arange(cells) + 0.5) / cells - 0.5 * wavelength
    pressure = contact.pressure(x)
    # Sums over cells with square-root edges: (cell/λ)^1.5 and better.
    assert pressure.mean() == pytest.approx(mean, rel=1e-5)
    assert pressure.max() == pytest.approx(contact.max_pressure, rel=1e-6)
    gap = periodic_displacement(pressure, wavelength) + amplitude * (1.0 - np.cos(2.0 * np.pi * x / wavelength))
    inside = np.abs(x) < contact.half_width
    assert np.ptp(gap[inside]) < 1e-5 * amplitude
    assert inside.mean() == pytest.approx(contact.area_fraction, abs=2.0 / cells)
    if filled < 0.9:
        assert gap[np.abs(x) > 1.02 * contact.half_width].min() > gap[inside].max()
    assert np.all(pressure[~inside] == 0.0)


def test_westergaard_waves_touch_like_cylinders_when_pressed_lightly() -> None:
    wavelength, amplitude = 2e-3, 3e-5
    contact = westergaard(1.0, amplitude, wavelength, E, NU)
    crest = hertz_line(1.0 * wavelength, 1.0 / (amplitude * (2.0 * math.pi / wavelength) ** 2), E, NU)
    # (πa/λ)² is a few 1e-5 here.
    assert contact.half_width == pytest.approx(crest.half_width, rel=1e-4)
    assert contact.max_pressure == pytest.approx(crest.max_pressure, rel=1e-4)


def test_crossed_waves_in_full_contact_follow_the_surface() -> None:
    wavelength, amplitude = 2e-3, 3e-5
    waves = crossed_waves(amplitude, wavelength, E, NU)
    x = wavelength * np.arange(16) / 16
    surface = amplitude * np.cos(2.0 * np.pi * x / wavelength)[:, None] * np.cos(2.0 * np.pi * x / wavelength)
    pressure = waves.full_contact_pressure * (1.0 + surface / amplitude)  # zero in the troughs
    assert periodic_displacement(pressure, wavelength) == pytest.approx(surface, abs=1e-12 * amplitude)


def test_crossed_waves_touch_like_balls_when_pressed_lightly() -> None:
    wavelength, amplitude, mean = 2e-3, 3e-5, 7.0
    crest = hertz_ball(mean * wavelength**2 / 2.0, 1.0 / (amplitude * (2.0 * math.pi / wavelength) ** 2), E, NU)
    area = 2.0 * math.pi * crest.radius**2 / wavelength**2
    assert crossed_waves(amplitude, wavelength, E, NU).area_fraction_at_low_pressure(mean) == pytest.approx(
        area, rel=1e-12
    )


def test_crossed_waves_nearly_closed_leave_round_cracks_that_do_not_grow() -> None:
    """A penny-shaped crack of radius b under a tension σ(r) is in balance where ∫ r σ/√(b² − r²) dr = 0 (Sneddon)."""
    waves, missing = crossed_waves(3e-5, 2e-3, E, NU), 1e-4
    full, q = waves.full_contact_pressure, 2.0 * math.pi / waves.wavelength

    def opening(b: float) -> float:
        def tension(angle: float) -> float:
            r = b * math.sin(angle)
            return r * (missing - 0.5 * (q * r) ** 2)  # cos qx cos qy is −1 + (qr)²/2 around a trough

        return quad(tension, 0.0, math.pi / 2.0)[0]

    b = brentq(opening, 1e-4 * waves.wavelength, 0.1 * waves.wavelength, xtol=1e-15)
    area = 1.0 - 2.0 * math.pi * b**2 / waves.wavelength**2
    assert waves.area_fraction_at_high_pressure((1.0 - missing) * full) == pytest.approx(area, abs=1e-9)


def test_full_contact_wave_follows_from_the_compliance_of_the_moving_half_space() -> None:
    """Pressure to displacement with S(−qv) must give back the wave; friction is the mean of p ∂h/∂x."""
    wavelength, amplitude, speed = 2e-3, 3e-5, 0.4
    q = 2.0 * math.pi / wavelength
    tau, C = np.array([1e-4, 3e-3]), np.array([2e-7, 1e-7])

    def compliance(omega: float) -> complex:
        return complex(1.0 / 3e7 + np.sum(C / (1.0 + 1j * omega * tau)))

    modulus = 1.0 / compliance(q * speed)
    contact = full_contact_wave(2e6, amplitude, wavelength, modulus, NU)
    x = wavelength * np.arange(64) / 64
    pressure = contact.pressure(x)
    first = np.fft.fft(pressure)[1]
    displacement = 2.0 * (1.0 - NU**2) / q * compliance(-q * speed) * first
    expected = np.fft.fft(amplitude * np.cos(q * x))[1]
    assert displacement == pytest.approx(expected, rel=1e-12)
    friction = np.mean(pressure * amplitude * q * np.sin(q * x)) / np.mean(pressure)
    assert contact.friction_coefficient == pytest.approx(friction, rel=1e-12)
    assert friction > 0.0
    assert contact.full_contact_pressure == pytest.approx(
        np.ptp(contact.pressure(np.linspace(0, wavelength, 9999))) / 2.0
    )
    with refused("partial-contact"):
        full_contact_wave(0.9 * contact.full_contact_pressure, amplitude, wavelength, modulus, NU)
    with refused("not-positive", naming="complex_modulus"):
        full_contact_wave(2e6, amplitude, wavelength, modulus.conjugate(), NU)


def test_full_contact_wave_of_an_elastic_solid_is_westergaards() -> None:
    contact = full_contact_wave(2e6, 3e-5, 2e-3, complex(E), NU)
    elastic = westergaard(2e6, 3e-5, 2e-3, E, NU)
    x = np.linspace(0.0, 4e-3, 11)
    assert contact.friction_coefficient == 0.0
    assert contact.full_contact_pressure == pytest.approx(elastic.full_contact_pressure, rel=1e-12)
    assert contact.pressure(x) == pytest.approx(elastic.pressure(x), rel=1e-12)


# --- punches --------------------------------------------------------------------------------------


def axial_displacement(pressure: object, a: float) -> float:
    """(1/πE*) ∫∫ p/r dA on the axis, with r = a sin t for the sake of singular rims."""
    return 2.0 / E_STAR * quad(lambda t: a * math.cos(t) * float(pressure(a * math.sin(t))), 0.0, math.pi / 2.0)[0]  # type: ignore[operator]


def test_flat_punch_sinks_evenly_under_its_pressure() -> None:
    a, depth = 2e-3, 1e-4
    punch = flat_punch(depth, a, E, NU)
    load = quad(
        lambda t: 2.0 * math.pi * a**2 * math.sin(t) * math.cos(t) * float(punch.pressure(a * math.sin(t))), 0.0, 1.57
    )
    # Up to 1.57 of π/2, beyond which rounding spoils the rim: cos(1.57) = 8e-4 of the load is not there.
    assert load[0] == pytest.approx(punch.load * (1.0 - math.cos(1.57)), rel=1e-6)
    assert 2.0 / E_STAR * quad(lambda t: a * math.cos(t) * float(punch.pressure(a * math.sin(t))), 0.0, 1.57)[
        0
    ] == pytest.approx(depth * 1.57 / (math.pi / 2.0), rel=1e-6)
    assert punch.pressure(1.01 * a) == 0.0
    assert punch.pressure(a) == math.inf


def test_cone_pressure_carries_the_load_and_fits_the_cone_at_tip_and_edge() -> None:
    slope = 0.06
    cone = sneddon_cone(3.0, slope, E, NU)
    a = cone.radius
    load = quad(lambda r: 2.0 * math.pi * r * float(cone.pressure(r)), 0.0, a)[0]
    assert load == pytest.approx(3.0, rel=1e-7)
    assert axial_displacement(cone.pressure, a) == pytest.approx(cone.indentation, rel=1e-7)

    def along_chord(s: float, angle: float) -> float:  # from a point of the edge
        r = math.sqrt(max(0.0, a**2 + s**2 - 2.0 * a * s * math.cos(angle)))
        return float(cone.pressure(r))

    edge = 2.0 * dblquad(along_chord, 1e-9, math.pi / 2.0, 0.0, lambda angle: 2.0 * a * math.cos(angle), epsrel=1e-5)[0]
    # Two-dimensional quadrature past a logarithm.
    assert edge / (math.pi * E_STAR) == pytest.approx(cone.indentation - slope * a, rel=1e-4)
    assert math.isinf(float(cone.pressure(0.0)))


# --- thin layers ----------------------------------------------------------------------------------


def layer_compliance(qH: float, nu: float, base: str) -> float:
    """û/p̂ in units of H/E of an elastic layer, from the equations of elasticity integrated through its thickness.

    With e^{iqx} and E = H = 1 the state u_x = −i U, u_z = W, τ_xz = −i T, σ_z = σ is real; z points up.
    """
    # dU/dz = T/μ + qW, dW/dz = σ (1+ν)(1−2ν)/(1−ν) − q ν/(1−ν) U, dT/dz = q²U/(1−ν²) + q ν/(1−ν) σ, dσ/dz = −qT
    q, mu, side = qH, 0.5 / (1.0 + nu), nu / (1.0 - nu)
    system = np.array(
        [
            [0.0, q, 1.0 / mu, 0.0],
            [-q * side, 0.0, 0.0, (1.0 + nu) * (1.0 - 2.0 * nu) / (1.0 - nu)],
            [q**2 / (1.0 - nu**2), 0.0, 0.0, q * side],
            [0.0, 0.0, -q, 0.0],
        ]
    )
    through = expm(system)
    free = (2, 3) if base == "bonded" else (0, 3)  # what the base does not hold at zero: T or U, and σ
    top = through[np.ix_((2, 3), free)]
    start = np.linalg.solve(top, [0.0, -1.0])  # T = 0, σ = −p
    return -float(through[1, free] @ start)


def test_thick_layer_is_a_half_space() -> None:
    """The check of the check: û = 2(1−ν²) p̂/(E q)."""
    for base in ("bonded", "frictionless"):
        assert layer_compliance(12.0, 0.3, base) == pytest.approx(2.0 * (1.0 - 0.3**2) / 12.0, rel=1e-6)


@pytest.mark.parametrize(
    ("nu", "base"), [(0.0, "bonded"), (0.3, "bonded"), (0.3, "frictionless"), (0.5, "frictionless")]
)
def test_thin_layer_is_a_foundation(nu: float, base: str) -> None:
    modulus = foundation_modulus(E, nu, base)  # type: ignore[arg-type]
    # The next term is (qH)².
    assert layer_compliance(0.01, nu, base) == pytest.approx(E / modulus, rel=1e-3)


def test_bonded_incompressible_layer_answers_with_the_curvature_of_the_pressure() -> None:
    assert layer_compliance(0.01, 0.5, "bonded") == pytest.approx(0.01**2, rel=1e-3)
    with refused("incompressible"):
        foundation_modulus(E, 0.5)
    with refused("wrong-choice", naming="base"):
        foundation_modulus(E, 0.3, "glued")  # type: ignore[arg-type]


def test_foundation_contacts_carry_their_load_and_fit_the_indenter() -> None:
    H, M = 1e-4, 5e6
    ball, line = winkler_ball(3.0, R, H, M), winkler_line(40.0, R, H, M)
    a, b = ball.half_width, line.half_width
    assert quad(lambda r: 2.0 * math.pi * r * float(ball.pressure(r)), 0.0, a)[0] == pytest.approx(3.0, rel=1e-9)
    assert quad(lambda x: float(line.pressure(x)), -b, b)[0] == pytest.approx(40.0, rel=1e-9)
    for contact in (ball, line):
        x = np.linspace(0.0, contact.half_width, 7)
        assert contact.pressure(x) * H / M == pytest.approx(contact.indentation - x**2 / (2.0 * R), abs=1e-12 * R)
        assert contact.pressure(1.01 * contact.half_width) == 0.0


def test_incompressible_layer_contacts_carry_their_load_and_fit_the_indenter() -> None:
    H = 1e-4
    ball, line = incompressible_ball(3.0, R, H, E), incompressible_line(40.0, R, H, E)
    a, b = ball.half_width, line.half_width
    assert quad(lambda r: 2.0 * math.pi * r * float(ball.pressure(r)), 0.0, a)[0] == pytest.approx(3.0, rel=1e-9)
    assert quad(lambda x: float(line.pressure(x)), -b, b)[0] == pytest.approx(40.0, rel=1e-9)
    step = 1e-3
    for x in (0.1, 0.5, 0.9):
        profile = line.pressure(b * np.array([x - step, x, x + step]))
        bent = -(H**3) / E * float(profile @ [1.0, -2.0, 1.0]) / (b * step) ** 2
        assert bent == pytest.approx(line.indentation - (b * x) ** 2 / (2.0 * R), rel=1e-4)
        cross = [(x, 0.0), (x - step, 0.0), (x + step, 0.0), (x, step), (x, -step)]
        around = np.array([float(ball.pressure(a * s, a * t)) for s, t in cross])
        bent = -(H**3) / E * float(around @ [-4.0, 1.0, 1.0, 1.0, 1.0]) / (a * step) ** 2
        # Second differences of a quartic: (step)² over the small part of the sum.
        assert bent == pytest.approx(ball.indentation - (a * x) ** 2 / (2.0 * R), rel=1e-4)
