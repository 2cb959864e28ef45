"""Sharing of heat between two bodies, and the states in which heat and temperature agree."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

import viscofric as vf
from refusals import refused
from viscofric.errors import ConvergenceError
from viscofric.heat.branches import State, settled, stable_states
from viscofric.heat.heating import HeatBalance, ThermalResistances
from viscofric.heat.interface import SlidingInterface

RUBBER = vf.ThermalProperties(0.3, 1200.0, 1500.0, "rubber")
STEEL = vf.ThermalProperties(46.0, 7810.0, 475.0, "steel")
RESISTANCES = ThermalResistances(surface=20.0, loss=3.0, surface_below=2.0, loss_below=5.0, track=7.0, counterface=1.5)


def test_both_faces_are_equally_warm_and_no_heat_is_lost() -> None:
    found = HeatBalance.of(RESISTANCES, coulomb=0.4, loss=0.25)
    into_rubber = 0.4 - found.counterface_heat
    rubber = 20.0 * into_rubber + 3.0 * 0.25 + 7.0 * (into_rubber + 0.25)
    assert found.face_rise == pytest.approx(rubber)
    assert found.face_rise == pytest.approx(1.5 * found.counterface_heat)
    assert found.track_rise == pytest.approx(7.0 * found.rubber_heat)
    assert found.loss_weighted_rise == pytest.approx(2.0 * into_rubber + 5.0 * 0.25 + found.track_rise)
    assert found.rubber_heat + found.counterface_heat == pytest.approx(0.65, rel=1e-15)


def test_a_counterface_may_take_no_heat_or_more_than_there_is_on_the_face() -> None:
    alone = HeatBalance.of(RESISTANCES._replace(counterface=math.inf), 0.4, 0.25)
    assert (alone.counterface_heat, alone.rubber_heat) == (0.0, 0.65)
    assert alone.face_rise == pytest.approx(27.0 * 0.4 + 10.0 * 0.25)
    cooled = HeatBalance.of(RESISTANCES, 0.0, 0.25)  # the loss alone: the counterface cools the rubber
    assert 0.0 < cooled.counterface_heat < 0.25


def test_a_contact_with_two_states_has_a_cold_and_a_hot_one() -> None:
    """G = 1 + 20/(1 + exp(10 − ΔT)): three crossings, the middle one unstable; dG/dΔT < 1 at the others."""
    rise = np.linspace(0.0, 40.0, 2001)
    states = stable_states(rise, 1.0 + 20.0 / (1.0 + np.exp(10.0 - rise)))
    assert [state.rise for state in states] == pytest.approx([1.0025, 20.9996], abs=1e-3)
    assert all(abs(state.slope) < 0.01 for state in states)
    (single,) = stable_states(rise, 30.0 - 0.5 * rise)
    assert single[:2] == pytest.approx((20.0, -0.5))


def test_a_state_is_settled_in_few_solves() -> None:
    solved = []

    def produced(rise: float) -> float:
        solved.append(rise)
        return 10.0 + 2.0 * math.tanh(rise - 11.0)

    rise, excess = settled(State(11.3, 0.5), produced, lambda _: 1e-8, (0.0, 30.0))
    assert excess == pytest.approx(produced(rise) - rise)
    assert abs(excess) < 1e-8
    assert len(solved) <= 12
    with pytest.raises(ConvergenceError):
        settled(State(1.0, 0.0), lambda rise: 2.0 * rise + 1.0, lambda _: 1e-12)


def test_a_state_at_a_jump_is_between_its_sides() -> None:
    """G falls from 12 to 8 at ΔT = 10, between the solves that come nearest to it."""
    rise, excess = settled(State(3.0, 0.0), lambda rise: 12.0 if rise < 10.0 else 8.0, lambda _: 1e-3)
    assert rise == pytest.approx(10.0, abs=1e-3)
    assert abs(excess) == pytest.approx(2.0, abs=1e-3)


def test_no_contact_is_solved_beyond_the_bounds() -> None:
    solved = []

    def produced(rise: float) -> float:
        solved.append(rise)
        return 10.0 - 20.0 * (rise - 10.0)

    assert settled(State(9.8, 0.89), produced, lambda _: 1e-6, (0.0, 11.0))[0] == pytest.approx(10.0, abs=1e-6)
    assert max(solved) <= 11.0
    with pytest.raises(ConvergenceError):
        settled(State(1.0, 0.0), lambda _: 5.0, lambda _: 1e-6, (0.0, 3.0))


def test_resistance_of_a_track_is_that_of_its_passes() -> None:
    heating = vf.Heating(rubber=RUBBER, counterface=STEEL, track_radius="23 mm", passes=100)
    expected = vf.heat.track_temperature(1.0, RUBBER, radius=1e-3, track_radius=0.023, speed=0.1, passes=[100])
    assert heating.track_resistance(1e-3, 0.1) == expected[0]
    assert vf.Heating(rubber=RUBBER, counterface=STEEL).track_resistance(1e-3, 0.1) == 0.0


@pytest.mark.parametrize(
    ("given", "code"),
    [
        ({"coulomb": -0.1}, "out-of-range"),
        ({"passes": 3}, "give-one"),
        ({"passes": 0.5, "track_radius": 0.02}, "out-of-range"),
        ({"branch": "warm"}, "branch"),
        ({"average": "mean"}, "average"),
        ({"slip": "1 m"}, "wrong-unit"),
    ],
)
def test_wrong_heating_is_refused(given: dict[str, Any], code: str) -> None:
    with refused(code):
        vf.Heating(**{"rubber": RUBBER, "counterface": STEEL, **given})


def test_an_interface_that_shears_harder_when_warm_has_two_states() -> None:
    """Heat 10 + 90/(1 + exp(20 − ΔT/K)) W, 0.5 K/W and 2 K by the loss: its coldest and its hottest face."""
    resistances = ThermalResistances(0.5, 0.1, 0.05, 0.08, 0.0, math.inf)
    loss = np.array([20.0, 0.0])

    def heat_at(rise: np.ndarray) -> np.ndarray:
        return np.asarray(10.0 + 90.0 / (1.0 + np.exp(20.0 - rise)))

    def law(_: float, kelvin: np.ndarray) -> np.ndarray:
        if np.max(kelvin) > 330.0:
            raise vf.InputError("known up to 330 K only")
        return heat_at(kelvin - 300.0)

    endless = SlidingInterface(lambda _, kelvin: heat_at(kelvin - 300.0), 1.0, 300.0)
    ends = SlidingInterface(law, 1.0, 300.0)

    for hot, low, high in ((False, 0.0, 15.0), (True, 25.0, 200.0)):
        found = endless.settled_heat(1.0, resistances, loss, hot=hot)
        for one, by_loss in zip(found, 0.1 * loss, strict=True):
            face = brentq(lambda rise, add=by_loss: add + 0.5 * heat_at(rise) - rise, low, high, xtol=1e-12)
            assert one == pytest.approx(heat_at(face), rel=1e-9)
    # Known up to 30 K only, the hot face is not followed farther, and the cold one is not affected.
    assert ends.known == pytest.approx(30.0, abs=1e-3)  # to which the ends of laws are found
    hottest = ends.settled_heat(1.0, resistances, loss, hot=True)
    assert hottest == pytest.approx(heat_at(np.array([30.0, 30.0])), rel=1e-6)
    assert ends.settled_heat(1.0, resistances, loss, hot=False)[1] == pytest.approx(10.0, rel=1e-3)
