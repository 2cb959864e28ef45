"""Closed forms of contacts that move over a viscoelastic solid: Hunter's cylinder, foundations, laws of speed."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.fft import dst
from scipy.integrate import quad

from marks import apart, slow
from refusals import refused
from viscofric.contact.reference import (
    HunterContact,
    RollingFoundationContact,
    hertz_ball,
    hertz_line,
    high_speed_friction,
    high_speed_line_friction,
    hunter_line,
    low_speed_friction,
    rolling_foundation_ball,
    rolling_foundation_line,
    winkler_ball,
    winkler_line,
)
from viscofric.errors import InputError

E, NU, R = 2e6, 0.45, 8e-3  # Pa, –, m


# --- Hunter: cylinder, one retardation time --------------------------------------------------------


def hunter(ratio: float, memory: float, load: float = 40.0) -> HunterContact:
    """Return the contact for k = E∞/E0 and l = vτ/a0, in ordinary units."""
    a0 = hertz_line(load, R, E, NU).half_width
    return hunter_line(load, R, E, ratio * E, 2e-3, memory * a0 / 2e-3, NU)


# k, l, μR/a0, front/a0, rear/a0, p_max/p0: independent evaluation of the closed form, all digits right.
KNOWN_LINES = [
    (10.0, 0.1, 0.0850588154, 0.99882086, 0.911300014, 1.00275263),
    (10.0, 1.0, 0.463905753, 0.918344747, 0.283492762, 2.37021987),
    (10.0, 10.0, 0.171390597, 0.480522864, 0.160699936, 3.13913948),
    (100.0, 1.0, 0.548364655, 0.916768872, 0.193778866, 7.22034401),
]


@pytest.mark.parametrize("row", KNOWN_LINES, ids=lambda row: f"k={row[0]:g} l={row[1]:g}")
def test_hunter_contact_has_the_known_numbers(row: tuple[float, ...]) -> None:
    ratio, memory, friction, front, rear, peak = row
    found = hunter(ratio, memory)
    a0, p0 = found.hertz.half_width, found.hertz.max_pressure
    # Half a unit of the last of nine digits.
    assert found.friction_coefficient * R / a0 == pytest.approx(friction, abs=0.6e-9)
    assert found.front / a0 == pytest.approx(front, abs=0.6e-9)
    assert found.rear / a0 == pytest.approx(rear, abs=0.6e-9)
    assert found.max_pressure / p0 == pytest.approx(peak, rel=2e-9)


# k, l, c/a0, m/a0, μR/a0: the two conditions on A0, A1 and A2 solved with 60 digits, differences and all.
SIXTY_DIGITS = [
    (1.01, 1e-06, 0.99999999504950495, 4.9504925865111305e-9, 9.9009802470346127e-9),
    (1.01, 1, 0.99662354727999847, 0.0023636147783717768, 0.0031754194128403367),
    (1.01, 1e06, 0.99503719021002408, 6.8992164549775507e-8, 7.0229788312143087e-8),
    (10, 0.1, 0.95506043684092064, 0.04376042310410267, 0.085058815407916771),
    (10, 10, 0.32061140017067096, 0.1599114639669288, 0.17139059674049361),
    (1000, 0.003, 0.99850150168561006, 0.0014973749992341181, 0.0029925000120786136),
    (10000, 0.001, 0.9995000500624766, 0.00049982499997784371, 0.00099940000009868759),
    (10000, 1, 0.5503175215805763, 0.36643482081117496, 0.55820963907061039),
    (10000, 1000, 0.010006281750432987, 0.0058135323629543138, 0.0059386247481536608),
    (10000, 1e06, 0.010000000006295712, 9.2673792988764964e-6, 9.3923667989817796e-6),
]


@pytest.mark.parametrize("row", SIXTY_DIGITS, ids=lambda row: f"k={row[0]:g} l={row[1]:g}")
def test_hunter_contact_loses_no_digits_at_extreme_speeds_and_moduli(row: tuple[float, ...]) -> None:
    ratio, memory, half_width, middle, friction = row
    found = hunter(ratio, memory)
    a0 = found.hertz.half_width
    # Memory itself is rounded when it is made from a speed; the middle is half a difference of the edges.
    assert found.half_width / a0 == pytest.approx(half_width, rel=1e-14, abs=0.0)
    assert 0.5 * (found.front - found.rear) / a0 == pytest.approx(middle, rel=1e-14, abs=1e-15)
    assert found.friction_coefficient * R / a0 == pytest.approx(friction, rel=1e-14, abs=0.0)


@pytest.mark.parametrize(
    ("ratio", "memory"), [*apart((1.01, 1.0), (10.0, 0.1)), *slow((10.0, 10.0)), *apart((100.0, 1.0), (1000.0, 30.0))]
)
def test_hunter_pressure_makes_the_surface_follow_the_cylinder(ratio: float, memory: float) -> None:
    """The slope of Eq. 8, −2/(πE0*) Σ over the memory of the Hilbert transform of p, by quadrature alone."""
    contact = hunter(ratio, memory)
    a0, c = contact.hertz.half_width / R, contact.half_width / R
    middle = 0.5 * (contact.front - contact.rear) / R
    count = 3000
    angle = np.pi * np.arange(1, count) / count
    profile = contact.pressure(R * (middle + c * np.cos(angle))) / (E / (1.0 - NU**2))
    sines = dst(profile, type=1) / count  # p = Σ b_n sin nφ
    order = np.arange(1, count)

    def hilbert(t: float) -> float:
        """PV ∫ p(s)/(t − s) ds: π Σ b_n T_n(t) on the contact, π Σ b_n (t ∓ √(t²−1))^n outside."""
        if abs(t) <= 1.0:
            return float(np.pi * sines @ np.cos(order * math.acos(t)))
        inner = t - math.copysign(math.sqrt(t * t - 1.0), t)
        return float(np.pi * sines @ inner**order)

    length = memory * a0
    for t in (-0.8, -0.1, 0.6, 0.95):
        x = middle + c * t
        to_front = (middle + c - x) / length
        delayed = 0.0
        for low, high in ((0.0, to_front), (to_front, to_front + 1e-2), (to_front + 1e-2, to_front + 40.0)):
            delayed += quad(lambda z: math.exp(-z) * hilbert(t + length * z / c), low, high, limit=400, epsabs=1e-9)[0]  # noqa: B023
        slope = -2.0 / math.pi * (hilbert(t) / ratio + (1.0 - 1.0 / ratio) * delayed)
        # 3000 sines of a profile with a leading layer, and quadrature through a square-root singularity at the front.
        assert slope == pytest.approx(-x, abs=2e-5 * a0)


@pytest.mark.parametrize("ratio", [*slow(1.01), *apart(2.0), 30.0, *slow(1e4)])
@pytest.mark.parametrize("memory", [1e-6, *apart(1e-3), 0.3, 20.0, *apart(1e3), 1e6])
def test_hunter_pressure_carries_the_load_and_its_moment_is_the_friction(ratio: float, memory: float) -> None:
    contact = hunter(ratio, memory)
    middle = 0.5 * (contact.front - contact.rear)
    # Gauss points in the angle, on panels that crowd at both edges: layers of 1e-10 of the width are resolved.
    ends = (
        np.concatenate([[0.0], np.geomspace(1e-9, 0.5, 60), 1.0 - np.geomspace(1e-9, 0.5, 60)[-2::-1], [1.0]]) * np.pi
    )
    t, w = np.polynomial.legendre.leggauss(8)
    size = np.diff(ends)[:, None]
    angle, weight = (ends[:-1, None] + 0.5 * size * (t + 1.0)).ravel(), (0.5 * size * w).ravel()
    x = middle + contact.half_width * np.cos(angle)
    pressure = contact.pressure(x)
    weight = weight * contact.half_width * np.sin(angle)
    assert weight @ pressure == pytest.approx(40.0, rel=1e-7)
    # The moment is a small difference at both ends of the range of speeds, and positions are rounded.
    moment = float(weight @ (pressure * x)) / (40.0 * R)
    assert moment == pytest.approx(contact.friction_coefficient, rel=1e-6, abs=1e-9 * contact.half_width / R)
    assert np.all(pressure >= 0.0)
    assert pressure.max() <= contact.max_pressure * (1.0 + 1e-9)
    assert contact.pressure(contact.front * (1.0 + 1e-9)) == 0.0


@pytest.mark.parametrize("ratio", [1.01, 10.0, 1e4])
def test_hunter_contact_is_hertz_at_E0_when_slow_and_at_E_inf_when_fast(ratio: float) -> None:
    slow, fast = hunter(ratio, 1e-6), hunter(ratio, 1e6)
    glass = hertz_line(40.0, R, ratio * E, NU)
    # First order in l when slow, in √k/l when fast, where a logarithm, and 1/(1 − x²/a²) = 5 of the pressure, enter.
    near = 10.0 * math.sqrt(ratio) * 1e-6
    assert (slow.half_width, slow.front, slow.rear) == pytest.approx((slow.hertz.half_width,) * 3, rel=1e-6)
    assert (fast.half_width, fast.front, fast.rear) == pytest.approx((glass.half_width,) * 3, rel=2.0 * near)
    assert fast.max_pressure == pytest.approx(glass.max_pressure, rel=near)
    x = np.linspace(-0.9, 0.9, 7)
    assert slow.pressure(x * slow.half_width) == pytest.approx(slow.hertz.pressure(x * slow.half_width), rel=1e-5)
    assert fast.pressure(x * glass.half_width) == pytest.approx(glass.pressure(x * glass.half_width), rel=5.0 * near)


def test_equal_moduli_make_hertz_at_any_speed() -> None:
    for memory in (1e-6, 0.5, 1e6):
        contact = hunter(1.0, memory)
        assert contact.friction_coefficient == 0.0
        assert contact.front == contact.rear == pytest.approx(contact.hertz.half_width, rel=1e-12)
        assert contact.max_pressure == pytest.approx(contact.hertz.max_pressure, rel=1e-12)


@pytest.mark.slow
@settings(deadline=None, max_examples=4)
@given(ratio=st.floats(1.01, 1e4), log_memory=st.floats(-6.0, 6.0))
def test_hunter_contact_leans_forward_between_its_two_elastic_limits(ratio: float, log_memory: float) -> None:
    contact = hunter(ratio, 10.0**log_memory)
    a0 = contact.hertz.half_width
    assert a0 / math.sqrt(ratio) * (1.0 - 1e-12) <= contact.half_width <= a0 * (1.0 + 1e-12)
    assert contact.front > contact.half_width > contact.rear
    assert 0.0 < contact.friction_coefficient * R < contact.front
    assert contact.max_pressure >= contact.hertz.max_pressure * (1.0 - 1e-12)
    # Friction is smooth on both sides: no rounding shows in a change of the speed by a millionth.
    beside = hunter(ratio, 10.0**log_memory * (1.0 + 1e-6)).friction_coefficient
    assert beside == pytest.approx(contact.friction_coefficient, rel=3e-6, abs=0.0)


def test_hunter_contact_does_not_depend_on_units() -> None:
    one = hunter_line(40.0, R, E, 30.0 * E, 2e-3, 0.7, NU)
    length, stress, time = 1e-3, 1e6, 1e9
    two = hunter_line(
        40.0 * stress * length, R * length, E * stress, 30.0 * E * stress, 2e-3 * time, 0.7 * length / time, NU
    )
    assert two.friction_coefficient == pytest.approx(one.friction_coefficient, rel=1e-12)
    assert two.rear == pytest.approx(length * one.rear, rel=1e-12)
    assert two.max_pressure == pytest.approx(stress * one.max_pressure, rel=1e-9)


@pytest.mark.parametrize("change", [{"E_inf": 0.9e6}, {"E_inf": 1e13}, {"speed": 0.0}, {"speed": 1e12}, {"tau": -1.0}])
def test_hunter_contact_refuses_what_it_cannot_do(change: dict[str, float]) -> None:
    arguments = {
        "load_per_length": 40.0,
        "radius": R,
        "E0": 1e6,
        "E_inf": 1e7,
        "tau": 1e-3,
        "speed": 1.0,
        "poisson_ratio": NU,
    }
    hunter_line(**arguments)  # type: ignore[arg-type]
    with pytest.raises(InputError):
        hunter_line(**{**arguments, **change})  # type: ignore[arg-type]


# --- thin layer, one retardation time ------------------------------------------------------------

STIFFNESS = 5e6 / (R * 1e-4)  # M0/(RH)


def rolling(shape: str, ratio: float, memory: float) -> RollingFoundationContact:
    """Return the contact on a foundation for M∞/M0 and vτ/a0."""
    make, load = (rolling_foundation_line, 40.0) if shape == "line" else (rolling_foundation_ball, 3.0)
    a0 = make(load, R, 1e-4, 5e6, 5e6, 1.0, 1.0).elastic_half_width
    return make(load, R, 1e-4, 5e6, ratio * 5e6, 2e-3, memory * a0 / 2e-3)


@pytest.mark.parametrize(("ratio", "memory"), [(10.0, 0.1), *apart((1.01, 1.0), (50.0, 3.0), (1e3, 0.02), (1e3, 1e3))])
def test_rolling_foundation_follows_the_cylinder_and_recovers_behind_it(ratio: float, memory: float) -> None:
    contact = rolling("line", ratio, memory)
    a, b, length = contact.front, contact.rear, memory * contact.elastic_half_width
    unit = STIFFNESS * R

    def displacement(x: float) -> float:
        """Return u M0/H by its memory, p/k + (1 − 1/k) ∫ e^(−z) p(x + lz) dz."""
        layer = length / ratio
        ends = sorted({x, max(x, -b), a, *(min(a, max(x, -b, e)) for e in (a - 30 * layer, a - 5 * layer, a - layer))})
        delayed = 0.0
        for low, high in pairwise(ends):
            delayed += quad(lambda s: math.exp((x - s) / length) * float(contact.pressure(s)), low, high, limit=200)[0]
        return (float(contact.pressure(x)) / ratio + (1.0 - 1.0 / ratio) * delayed / length) / unit

    for x in (-b + 1e-3 * (a + b), 0.3 * a - 0.7 * b, a - 1e-2 * (a + b)):
        assert displacement(x) == pytest.approx(contact.indentation - x**2 / (2.0 * R), abs=1e-9 * contact.indentation)
    behind = -b - 0.05 * (a + b)
    assert displacement(behind) > contact.indentation - behind**2 / (2.0 * R)
    assert contact.pressure(behind) == 0.0


@pytest.mark.parametrize("shape", ["line", "ball"])
@pytest.mark.parametrize(("ratio", "memory"), [(10.0, 0.1), *apart((1.01, 1.0), (50.0, 3.0)), *slow((1e3, 1e3))])
def test_rolling_foundation_carries_the_load_and_its_moment_is_the_friction(
    shape: str, ratio: float, memory: float
) -> None:
    contact = rolling(shape, ratio, memory)
    t, w = np.polynomial.legendre.leggauss(120)
    x = 0.5 * (contact.front - contact.rear) + 0.5 * (contact.front + contact.rear) * t
    weight = 0.5 * (contact.front + contact.rear) * w
    load, y = 40.0, np.zeros(1)
    across = np.ones(1)
    if shape == "ball":
        load = 3.0
        y, across = contact.front * np.sin(0.5 * np.pi * t), contact.front * 0.5 * np.pi * np.cos(0.5 * np.pi * t) * w
    pressure = contact.pressure(x[:, None], y)
    # A plain product rule across the edges of a ball's strips: two digits less.
    error = 1e-9 if shape == "line" else 1e-3
    assert weight @ pressure @ across == pytest.approx(load, rel=error)
    moment = (weight * x) @ pressure @ across / (load * R)
    assert moment == pytest.approx(contact.friction_coefficient, rel=error, abs=0.01 * error * contact.front / R)


@pytest.mark.parametrize("ratio", [*apart(1.5), *slow(1e3)])
def test_rolling_foundation_obeys_the_laws_of_low_and_of_high_speed(ratio: float) -> None:
    for shape, power, share in (("line", -2.0 / 3.0, 0.4), ("ball", -0.5, 1.0 / 3.0)):
        slow, fast = rolling(shape, ratio, 1e-5), rolling(shape, ratio, 1e7)
        a0, k = slow.elastic_half_width, ratio
        assert slow.friction_coefficient * R / a0 == pytest.approx((1.0 - 1.0 / k) * 1e-5, rel=1e-4, abs=0.0)
        # (1/vτ) ∫ p² over the load, of the elastic contact with M∞
        assert fast.friction_coefficient * R / a0 == pytest.approx(
            share * (k - 1.0) * k**power * 1e-7, rel=1e-3, abs=0.0
        )
        elastic = (winkler_line(40.0, R, 1e-4, 5e6), winkler_ball(3.0, R, 1e-4, 5e6))[shape == "ball"]
        assert (slow.front, slow.rear, slow.indentation) == pytest.approx(
            (elastic.half_width, elastic.half_width, elastic.indentation), rel=1e-4
        )
        glassy = (winkler_line(40.0, R, 1e-4, k * 5e6), winkler_ball(3.0, R, 1e-4, k * 5e6))[shape == "ball"]
        assert (fast.front, fast.rear) == pytest.approx((glassy.half_width,) * 2, rel=1e-3)
        x = 0.5 * glassy.half_width
        assert fast.pressure(x, 0.0) == pytest.approx(glassy.pressure(x), rel=1e-3)


def test_rolling_foundation_refuses_what_it_cannot_do() -> None:
    with refused("out-of-range"):
        rolling("line", 0.9, 1.0)
    with refused("out-of-range"):
        rolling("ball", 10.0, 1e10)


# --- limits of speed --------------------------------------------------------------------------------


@pytest.mark.parametrize("ratio", [1.01, 10.0, 1e4])
def test_line_friction_joins_both_laws_of_speed(ratio: float) -> None:
    load, tau = 40.0, 2e-3
    a0 = hertz_line(load, R, E, NU).half_width
    C = (1.0 - 1.0 / ratio) / E
    for memory in (1e-6, 1e-4, 1e6, 1e8):
        contact = hunter(ratio, memory)
        speed = memory * a0 / tau
        if memory < 1.0:
            law, error = low_speed_friction(speed, R, E, [C], [tau]), memory
        else:
            law = high_speed_line_friction(speed, load, R, ratio * E, NU, [C], [tau])
            error = 20.0 * math.sqrt(ratio) / memory  # a∞ over the relaxation length, and a logarithm
        assert contact.friction_coefficient == pytest.approx(law, rel=error, abs=0.0)


def hertz_power(k: float) -> float:
    """|p̂(q)|²/F² of Hertz's pressure at qa = k."""
    return (3.0 * (math.sin(k) - k * math.cos(k)) / k**3) ** 2 if k > 1e-2 else 1.0 - k**2 / 5.0


def dissipation(power: int) -> float:
    """∫_0^∞ k^power |p̂|²/F² dk."""
    ends = [0.0, 1.0, *np.arange(10.0, 4000.0, 40.0)]
    total = sum(quad(lambda k: k**power * hertz_power(k), low, high)[0] for low, high in pairwise(ends))
    # Beyond, |p̂|² is on average 9/(2 k⁴).
    return total + 4.5 / ((3 - power) * ends[-1] ** (3 - power))


def test_low_speed_law_is_the_energy_lost_under_hertz_pressure() -> None:
    """F_t = (1/4π²) ∫ d²q 2(1−ν²) cos²θ q vτ C |p̂|², for a load and a radius of the ball."""
    hertz, C, tau, speed, load = hertz_ball(3.0, R, E, NU), [3e-7, 1e-7], [1e-5, 4e-5], 1e-3, 3.0
    lag = speed * float(np.dot(C, tau))
    force = 2.0 * (1.0 - NU**2) * math.pi * lag * load**2 * dissipation(2) / hertz.radius**3 / (4.0 * math.pi**2)
    # The tail of the integral beyond qa = 4000, of which only the average is known.
    assert low_speed_friction(speed, R, E, C, tau) == pytest.approx(force / load, rel=1e-4, abs=0.0)
    assert low_speed_friction(-speed, R, E, C, tau) == -low_speed_friction(speed, R, E, C, tau)


def test_high_speed_law_is_the_energy_lost_under_hertz_pressure() -> None:
    """F_t = (1/4π²) ∫ d²q 2(1−ν²)/(q vτ) C |p̂|²."""
    hertz, C, tau, speed, load = hertz_ball(3.0, R, E, NU), [3e-7, 1e-7], [1e-2, 4e-2], 1e3, 3.0
    rate = float(np.divide(C, tau).sum()) / speed
    force = 2.0 * (1.0 - NU**2) * 2.0 * math.pi * rate * load**2 * dissipation(0) / hertz.radius / (4.0 * math.pi**2)
    assert high_speed_friction(speed, load, R, E, NU, C, tau) == pytest.approx(force / load, rel=1e-6, abs=0.0)
    assert high_speed_friction(-speed, load, R, E, NU, C, tau) < 0.0


def test_laws_of_speed_add_up_over_modes_and_refuse_nonsense() -> None:
    C, tau = [3e-7, 1e-7], [1e-2, 4e-2]
    for law in (
        lambda c, t: high_speed_friction(1e3, 3.0, R, E, NU, c, t),
        lambda c, t: high_speed_line_friction(1e3, 40.0, R, E, NU, c, t),
        lambda c, t: low_speed_friction(1e-3, R, E, c, t),
    ):
        assert law(C, tau) == pytest.approx(law(C[:1], tau[:1]) + law(C[1:], tau[1:]), rel=1e-12)
        with pytest.raises(InputError):
            law(C, tau[:1])
        with pytest.raises(InputError):
            law(C, [1e-2, 0.0])
    with refused("no-speed"):
        high_speed_friction(0.0, 3.0, R, E, NU, C, tau)
