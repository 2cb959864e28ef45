"""Flash temperatures against closed forms and integrals of moving sources, and what they shift."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

from refusals import refused
from viscofric.friction.warming import (
    bulk_temperature,
    flash_temperature,
    shared_flash_temperature,
)
from viscofric.thermal import FILLED_RUBBER, PTFE, STEEL, ThermalProperties

HEAT, RADIUS = 0.5, 2e-3
MEAN = HEAT / (np.pi * RADIUS**2)
BODY = ThermalProperties(0.3, "1.2 g/cm**3", "1500 J/kg/K", "made up")


def speed_at(peclet: float, body: ThermalProperties = BODY) -> float:
    return 2.0 * body.diffusivity * peclet / RADIUS


def moving_source(peclet: float) -> float:
    """Largest surface temperature under Hertz's heat, over q̄ a/k, by integrating moving point sources.

    A point source Q that moves towards +x over the half-space makes Q/(2πkr) exp(−Pe (r + X)/a), X the distance ahead
    of it (Carslaw and Jaeger, Conduction of Heat in Solids, section 10.7).  In polar coordinates about the place looked
    at, at x on the centre line, 1/r cancels.
    """
    angles = (np.arange(200) + 0.5) * np.pi / 200  # the other half is its mirror image
    nodes, weights = np.polynomial.legendre.leggauss(100)

    def at(x: float) -> float:
        reach = -x * np.cos(angles) + np.sqrt(1.0 - (x * np.sin(angles)) ** 2)
        # Towards the edge like a root: r = reach (1 − s²).  Towards the place like exp(−Pe r): r ~ reach s⁴ there.
        s = 0.5 * (nodes + 1.0)
        share = (s**2 * (3.0 - 2.0 * s)) ** 2
        r = reach[:, None] * share
        jacobian = reach[:, None] * 2.0 * (s**2 * (3.0 - 2.0 * s)) * (6.0 * s * (1.0 - s)) * 0.5 * weights
        there = x + r * np.cos(angles)[:, None]
        square = there**2 + (r * np.sin(angles)[:, None]) ** 2
        heat = 1.5 * np.sqrt(np.maximum(0.0, 1.0 - square))
        ahead = x - there  # how far the place looked at is ahead of the source
        decay = np.exp(-peclet * (r + ahead))
        return float(np.sum(heat * decay * jacobian) * 2.0 * np.pi / 200 / (2.0 * np.pi))

    return max(at(x) for x in np.linspace(-0.95, 0.3, 40))


def test_the_integral_of_sources_is_right_where_it_is_known() -> None:
    """At rest under Hertz's heat: 3π/8 in the middle; the quadrature's own error is 1e-4."""
    assert moving_source(0.0) == pytest.approx(3.0 * np.pi / 8.0, rel=2e-4)


def test_a_source_at_rest_warms_by_its_closed_form() -> None:
    """ΔT = 3π q̄ a/(8k), to the three digits of the constants 2.32 and 1.234."""
    expected = 3.0 * np.pi * MEAN * RADIUS / (8.0 * BODY.conductivity)
    assert flash_temperature(HEAT, RADIUS, 0.0, BODY) == pytest.approx(expected, rel=2e-3)


def test_a_fast_source_warms_as_heat_flows_straight_down() -> None:
    """Largest of ∫ q(s) ds/√(π k ρc V (x − s)) on the centre line, to the three digits of 2.32 and O(1/Pe)."""
    speed = speed_at(1e6)

    def integral(x: float) -> float:
        return quad(
            lambda t: 2.0 * np.sqrt(max(0.0, 1.0 - (x - t * t) ** 2)), np.sqrt(max(0.0, x - 1)), np.sqrt(x + 1)
        )[0]

    largest = max(integral(x) for x in np.linspace(0.5, 0.8, 61))
    inertia = np.pi * BODY.conductivity * BODY.volume_heat * speed / RADIUS
    assert flash_temperature(HEAT, RADIUS, speed, BODY) == pytest.approx(
        1.5 * MEAN * largest / np.sqrt(inertia), rel=2e-3
    )
    line = flash_temperature(HEAT, RADIUS, speed, BODY, line=True)
    peak = 4.0 / np.pi * HEAT / (2.0 * RADIUS)
    assert line == pytest.approx(peak * largest / np.sqrt(inertia), rel=1e-3)


@pytest.mark.parametrize("peclet", [0.3, 1.0, 3.0, 10.0, 30.0])
def test_between_the_limits_the_formula_joins_them(peclet: float) -> None:
    """The formula joins the limits to 1 %."""
    found = flash_temperature(HEAT, RADIUS, speed_at(peclet), BODY)
    assert found == pytest.approx(moving_source(peclet) * MEAN * RADIUS / BODY.conductivity, rel=0.012)


def test_the_better_conductor_takes_the_heat() -> None:
    """Both surfaces are equally warm, and the two shares of the heat make the whole."""
    rubber, steel = (flash_temperature(HEAT, RADIUS, 0.1, body) for body in (FILLED_RUBBER, STEEL))
    shared = shared_flash_temperature(rubber, steel)
    assert shared / rubber + shared / steel == pytest.approx(1.0)
    assert shared < steel < 0.1 * rubber
    assert shared_flash_temperature(rubber, shared_flash_temperature(0.0, steel)) == 0.0
    assert flash_temperature(HEAT, RADIUS, 0.1, PTFE) == pytest.approx(rubber, rel=0.2)


def test_what_is_lost_in_the_bulk_is_kept_by_it() -> None:
    """Work per length of track over the heat capacity of that length: 1 N on 10 mm² of water's 4.18 MJ/(m³ K)."""
    water = ThermalProperties(0.6, 1000.0, 4180.0, "water")
    radius = float(np.sqrt(2.0 * 10e-6 / np.pi))
    assert bulk_temperature(1.0, radius, water) == pytest.approx(1.0 / 41.8)
    assert bulk_temperature(100.0, 1e-3, water, line=True) == pytest.approx(100.0 / 4180.0)


def test_a_line_contact_at_rest_takes_no_heat_away() -> None:
    assert flash_temperature(HEAT, RADIUS, 0.0, BODY, line=True) == np.inf
    assert flash_temperature(0.0, RADIUS, 0.0, BODY, line=True) == 0.0
    alone = flash_temperature(HEAT, RADIUS, 0.1, BODY, line=True)
    assert shared_flash_temperature(alone, np.inf) == alone


def test_impossible_values_are_refused() -> None:
    with refused("not-positive", naming="conductivity"):
        ThermalProperties(-0.3, 1200.0, 1500.0, "made up")
    with refused("wrong-unit", naming="density = '1 g'"):
        ThermalProperties(0.3, "1 g", 1500.0, "made up")
    with refused("out-of-range"):
        flash_temperature(HEAT, RADIUS, -0.1, BODY)
