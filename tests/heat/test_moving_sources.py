"""Moving discs and strips of heat against closed forms, another way to integrate, and the limits of Jaeger."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ellipk, j1, k0

import viscofric as vf
from refusals import refused
from viscofric.heat.means import disc_mean, strip_mean
from viscofric.heat.sources import disc_points, strip_points

UNIT = vf.ThermalProperties(1.0, 1.0, 1.0, "unit")


def disc(peclet: float, distribution: str = "uniform") -> vf.heat.MovingHeatSource:
    """Return a disc of radius 1 and mean flux 1 on a body of conductivity and diffusivity 1."""
    return vf.heat.MovingHeatSource(np.pi, 1.0, 2.0 * peclet, UNIT, "disc", distribution)


def strip(peclet: float, distribution: str = "uniform") -> vf.heat.MovingHeatSource:
    return vf.heat.MovingHeatSource(2.0, 1.0, 2.0 * peclet, UNIT, "strip", distribution)


@pytest.mark.parametrize(
    ("distribution", "peclet", "largest", "position", "mean"),
    [
        ("uniform", 0.1, 0.9544641256683541, -0.09091711599180666, 0.802024128900462),
        ("uniform", 10.0, 0.3383816951767402, -0.91806030285698, 0.21283892474008098),
        ("hertz", 0.1, 1.1314757703305391, -0.04613637241303846, 0.8366160537277458),
        ("hertz", 10.0, 0.3941302094312138, -0.5954397744440241, 0.22262137748958746),
    ],
)
def test_rise_equals_an_independent_integral(
    distribution: str, peclet: float, largest: float, position: float, mean: float
) -> None:
    """Jaeger's integral by an independent program, to its 1e-7, and 1e-4 of the radius for the position."""
    found = disc(peclet, distribution)
    assert found.peclet_number == pytest.approx(peclet)
    assert found.max_temperature == pytest.approx(largest, rel=1e-7)
    assert found.max_position == pytest.approx(position, abs=1e-4)
    assert found.mean_temperature == pytest.approx(mean, rel=1e-7)


def test_a_disc_at_rest_has_its_closed_forms() -> None:
    """Uniform: q a/k in the middle, 8/(3π) on average; like Hertz's pressure: 3π/8 (1 − r²/2) of it."""
    assert disc(0.0).max_temperature == pytest.approx(1.0, rel=1e-12)
    assert disc(0.0).mean_temperature == pytest.approx(8.0 / (3.0 * np.pi), rel=1e-12)
    found = disc(0.0, "hertz").temperature_at([0.0, 0.6, 0.0], [0.0, 0.0, -1.0])
    assert found == pytest.approx(3.0 * np.pi / 8.0 * np.array([1.0, 0.82, 0.5]), rel=1e-10)
    assert disc(0.0, "hertz").mean_temperature == pytest.approx(9.0 * np.pi / 32.0, rel=1e-12)


@pytest.mark.parametrize("peclet", [1e-3, 0.1, 10.0, 300.0])
def test_the_mean_equals_the_sum_over_waves(peclet: float) -> None:
    """T = Q/(k √(q² − iqv/κ)), its mean over directions an elliptic integral; waves beyond q = 3000 give 1e-5 of it."""
    node, weight = np.polynomial.legendre.leggauss(12)
    edges = np.concatenate([np.geomspace(1e-6, 1.0, 20), np.arange(3.0, 3000.0, 2.0)])
    q = (edges[:-1, None] + 0.5 * np.diff(edges)[:, None] * (1.0 + node)).ravel()
    weight = (0.5 * np.diff(edges)[:, None] * weight).ravel()
    fast = np.hypot(q, 2.0 * peclet)
    transfer = 2.0 / np.pi * ellipk(0.5 - 0.5 * q / fast) / np.sqrt(q * fast)
    assert disc_mean(peclet, hertz=False) == pytest.approx(np.sum(weight * 2.0 * j1(q) ** 2 / q * transfer), rel=2e-5)


@pytest.mark.parametrize("hertz", [False, True])
@pytest.mark.parametrize("peclet", [1e-3, 3.0, 1e4])
def test_means_are_those_of_the_fields(peclet: float, hertz: bool) -> None:
    """Mean of the field by Gauss's rule, over the radius as a sine; a fast source has layers at its edge."""
    node, weight = np.polynomial.legendre.leggauss(16)
    angle, radius = 0.5 * np.pi * (1.0 + node), np.sin(0.25 * np.pi * (1.0 + node))
    x, y = radius[:, None] * np.cos(angle), radius[:, None] * np.sin(angle)
    field = disc_points(x.ravel(), y.ravel(), peclet, hertz=hertz).reshape(x.shape)
    over_radius = weight * 0.5 * np.pi * np.cos(0.25 * np.pi * (1.0 + node)) * radius
    tolerance = 1e-3 if peclet > 100.0 else 1e-5
    assert over_radius @ field @ weight / 2.0 == pytest.approx(disc_mean(peclet, hertz=hertz), rel=tolerance)
    along = strip_points(np.sin(0.5 * np.pi * node), peclet, hertz=hertz)
    mean = weight @ (0.25 * np.pi * np.cos(0.5 * np.pi * node) * along)
    assert mean == pytest.approx(strip_mean(peclet, hertz=hertz), rel=tolerance)


def test_under_fast_sources_heat_flows_straight_down() -> None:
    """T = √(2s/(π Pe)), s from the leading edge: heat flows sideways within 1/√Pe of the edges."""
    peclet = 1e6
    y = 0.5
    chord = np.sqrt(1.0 - y**2)
    field = disc(peclet).temperature_at([-0.5, 0.0, 0.5], y)
    assert field == pytest.approx(np.sqrt(2.0 * (chord - np.array([-0.5, 0.0, 0.5])) / (np.pi * peclet)), rel=1e-4)
    largest = np.sqrt(4.0 / (np.pi * peclet))
    assert disc(peclet).max_temperature == pytest.approx(largest, rel=1e-3)
    assert strip(peclet).max_temperature == pytest.approx(largest, rel=1e-3)
    mean = quad(lambda y: (2.0 / 3.0) * (2.0 * np.sqrt(1.0 - y**2)) ** 1.5, -1.0, 1.0)[0] / np.pi
    assert disc(peclet).mean_temperature == pytest.approx(mean * np.sqrt(2.0 / (np.pi * peclet)), rel=1e-3)
    # M. F. Jaeger's band: 2/3 of the largest on average
    assert strip(peclet).mean_temperature == pytest.approx(2.0 / 3.0 * largest, rel=1e-3)


@pytest.mark.parametrize("x", [-3.0, -1.0, -0.4, 0.7, 1.0, 1.5])
def test_a_strip_is_the_integral_of_line_sources(x: float) -> None:
    """exp(−Pe ξ) K0(Pe |ξ|)/π (Carslaw and Jaeger, Sec. 10.7) by adaptive quadrature, whose error is 1e-8."""
    peclet = 0.7

    def source(there: float, hertz: bool) -> float:
        heat = 4.0 / np.pi * np.sqrt(1.0 - there**2) if hertz else 1.0
        return heat * np.exp(-peclet * (x - there)) * k0(peclet * abs(x - there)) / np.pi

    for hertz, distribution in enumerate(("uniform", "hertz")):
        places = [-1.0, x, 1.0] if abs(x) < 1.0 else [-1.0, 1.0]
        expected = sum(quad(source, a, b, args=(hertz,), limit=200)[0] for a, b in pairwise(places))
        assert strip(peclet, distribution).temperature_at(x) == pytest.approx(expected, rel=1e-7)


def test_the_heat_is_found_again_in_the_wake() -> None:
    """Far behind, ∫T dy = (Q/v)/(ρc √(πκ d/v)): all the heat, d/v old; deviations of 1/(Pe d) are 3e-3."""
    peclet, behind = 5.0, 40.0
    y = np.linspace(-15.0, 15.0, 61)
    for distribution in ("uniform", "hertz"):
        field = disc(peclet, distribution).temperature_at(-behind, y)
        assert np.sum(field) * 0.5 == pytest.approx(np.pi / np.sqrt(np.pi * behind * 2.0 * peclet), rel=3e-3)


def test_units_do_not_matter() -> None:
    steel = vf.ThermalProperties("46 W/m/K", "7.81 g/cm**3", "475 J/kg/K", "steel")
    found = vf.heat.MovingHeatSource("300 mW", "0.2 mm", "50 mm/s", steel)
    same = disc(found.peclet_number, "hertz")
    unit = 0.3 / (np.pi * 0.2e-3) / 46.0
    assert found.peclet_number == pytest.approx(0.05 * 0.2e-3 / (2.0 * 46.0 / (7810.0 * 475.0)))
    assert found.max_temperature == pytest.approx(unit * same.max_temperature, rel=1e-12)
    assert found.temperature_at("0.1 mm", "0.05 mm") == pytest.approx(unit * same.temperature_at(0.5, 0.25), rel=1e-12)


def test_what_has_no_answer_is_refused() -> None:
    with refused("out-of-range"):
        strip(0.0)
    with refused("out-of-range"):
        disc(-1.0)
    with refused("wrong-length"):
        disc(1.0).temperature_at([0.0, 1.0], [0.0, 1.0, 2.0])
