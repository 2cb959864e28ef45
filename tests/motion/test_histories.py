"""Histories: what is refused, values between the given times, jumps, and the clock of the material."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

import viscofric as vf
from refusals import refused
from viscofric.motion.history import dense_times

RUBBER = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")
LAW = vf.WLF(C1=8.0, C2=100.0, reference="30 degC")
WARM = vf.Material(RUBBER.spectrum, shift=LAW)
TIME = [0.0, 0.1, 0.3]


@pytest.mark.parametrize(
    ("code", "given"),
    [
        ("repeated-time", {"time": [0.0, 0.1, 0.1, 0.1, 0.2], "load": 1.0}),
        ("too-few-points", {"time": [0.0], "load": 1.0}),
        ("too-few-points", {"time": [0.1, 0.1], "load": 1.0}),
        ("give-one", {"time": TIME, "load": 1.0, "indentation": 1e-4}),
        ("give-one", {"time": TIME, "load": 1.0, "pressure": 1e4}),
        ("negative-load", {"time": TIME, "pressure": [0.0, -1.0, 1.0]}),
        ("wrong-length", {"time": TIME, "load": 1.0, "position": [0.0, 1.0]}),
        ("wrong-length", {"time": TIME, "load": 1.0, "speed": np.zeros((3, 3))}),
        ("wrong-length", {"time": TIME, "load": 1.0, "temperature": [300.0, 310.0]}),
        ("give-one", {"time": TIME, "load": 1.0, "position": TIME, "speed": 1.0}),
        ("not-sliding", {"time": [0.0, 0.1, 0.1, 0.2], "load": 1.0, "speed": [0, 0, 1, 1], "before": "sliding"}),
        ("wrong-choice", {"time": TIME, "load": 1.0, "before": "asleep"}),
        ("not-positive", {"time": TIME, "load": 1.0, "temperature": [300.0, -1.0, 300.0]}),
        ("wrong-unit", {"time": TIME, "load": "1 m"}),
    ],
)  # fmt: skip
def test_what_contradicts_itself_is_refused(code, given):
    with refused(code):
        vf.motion.History(**given)


def test_what_the_material_or_the_contact_cannot_have_is_refused():
    with refused("no-shift"):
        vf.motion.History(TIME, load=1.0, temperature=300.0).schedule(RUBBER, "point")
    with refused("temperature"):  # below the pole of the law
        vf.motion.History(TIME, load=1.0, temperature=[300.0, 300.0, 180.0]).schedule(WARM, "point")
    with refused("wrong-unit"):
        vf.motion.History(TIME, load="1 kN/m").schedule(RUBBER, "point")
    shifted = vf.Material(RUBBER.spectrum, shift=LAW, vertical_shift=vf.rheology.DensityShift("30 degC"))
    with refused("vertical-shift"):
        vf.motion.History(TIME, load=1.0, temperature=[300.0, 300.0, 310.0]).schedule(shifted, "point")


def test_values_are_linear_between_times_and_jump_where_one_is_repeated():
    history = vf.motion.History(
        ["0 s", "100 ms", "100 ms", "300 ms"], load=["0 N", "2 N", "5 N", "1 N"], position=[0, 0, 0, 0.02]
    )
    schedule = history.schedule(RUBBER, "point")
    assert schedule.kinks.tolist() == [0.0, 0.1, 0.3]
    assert schedule.at(0.05).load == pytest.approx(1.0)
    assert (schedule.at(0.1, after=False).load, schedule.at(0.1).load) == (2.0, 5.0)
    assert schedule.at(0.2).load == pytest.approx(3.0)
    assert schedule.at(0.2).position == pytest.approx([0.01, 0.0])
    assert schedule.at(0.3).load == 1.0
    assert schedule.velocity(0.1) == pytest.approx([0.1, 0.0])
    assert schedule.velocity(0.1, after=False) == pytest.approx([0.0, 0.0])


def test_jumps_at_both_ends_keep_both_values():
    schedule = vf.motion.History([0.0, 0.0, 1.0, 1.0], indentation=[-1e-4, 0.0, 1e-4, 2e-4]).schedule(RUBBER, "point")
    ends = [schedule.at(time, after=after).depth for time in (0.0, 1.0) for after in (False, True)]
    assert ends == [-1e-4, 0.0, 1e-4, 2e-4]


def test_a_time_that_misses_an_end_by_rounding_is_that_end():
    rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")
    history = vf.motion.History([0.1, 0.3], load=1.0)
    asked = [0.3 - 0.1 - 0.1, 0.1 + 0.2]
    assert asked[0] < 0.1
    assert asked[1] > 0.3
    run = vf.motion.solve_transient(rubber, vf.Ball("10 mm"), history, times=asked, accuracy=0.1)
    assert run.time.tolist() == [0.1, 0.3]
    for beyond in (0.3 * (1.0 + 3e-12), 0.1 - 1e-12):
        with refused("out-of-range"):
            vf.motion.solve_transient(rubber, vf.Ball("10 mm"), history, times=[beyond], accuracy=0.1)


def test_times_are_dense_after_each_kink():
    history = vf.motion.History([0.0, 1.0, 1.0, 3.0], load=1.0, speed=[0.0, 0.0, 0.1, 0.1])
    times = np.array(dense_times(history, 45))
    assert len(times) == 45
    assert np.flatnonzero(times == 1.0).tolist() == [22, 23]  # before and after the jump
    for start, end, part in ((0.0, 1.0, times[1:22]), (1.0, 3.0, times[24:44])):
        steps = np.diff(np.concatenate([[start], part, [end]]))
        assert steps[0] == pytest.approx(1e-4 * (end - start))
        assert np.all(np.diff(steps[1:10]) > 0.0)
        np.testing.assert_allclose(steps[11:], steps[-1], rtol=1e-9)  # even in the second half
    assert dense_times(history, 4) == history.time.tolist()
    assert dense_times(history, 3) == [0.0, 1.5, 3.0]


def test_a_linear_speed_integrates_to_a_parabola():
    schedule = vf.motion.History([0.0, 1.0, 2.0], load=1.0, speed=[0.0, 1.0, 1.0], direction=(0.0, 2.0)).schedule(
        RUBBER, "point"
    )
    assert schedule.at(0.5).position == pytest.approx([0.0, 0.125])
    assert schedule.at(2.0).position == pytest.approx([0.0, 1.5])
    assert schedule.velocity(0.5) == pytest.approx([0.0, 0.5])


def test_rates_of_the_clock_are_those_of_the_temperatures_within_an_interval_and_after_a_jump():
    law = vf.WLF(8.0, 50.0, "300 K")
    rubber = vf.Material(RUBBER.spectrum, shift=law)
    kelvin = [300.0, 320.0, 290.0, 290.0, 310.0]
    schedule = vf.motion.History([0.0, 1.0, 1.0, 2.0, 3.0], load=1.0, temperature=kelvin).schedule(rubber, "point")

    def rate(warmth: float) -> float:
        return float(10.0 ** -law.log10(warmth))

    for (start, end), expected in {
        (0.0, 1.0): (300.0, 320.0),
        (0.25, 0.5): (305.0, 310.0),
        (1.0, 1.0): (290.0, 290.0),
        (0.5, 3.0): (290.0, 320.0),
        (3.0, 3.0): (310.0, 310.0),
    }.items():
        assert schedule.rates(start, end) == pytest.approx([rate(one) for one in expected], rel=1e-12)


def test_at_a_constant_temperature_the_modes_are_shifted_and_the_clock_is_time():
    schedule = vf.motion.History(TIME, load=1.0, temperature="60 degC").schedule(WARM, "point")
    assert schedule.spectrum.tau == pytest.approx(WARM.at("60 degC").tau)
    assert schedule.at(0.3).clock == pytest.approx(0.3, rel=1e-15)


@pytest.mark.parametrize("law", [LAW, vf.Arrhenius(1e5, "30 degC"), vf.WLFArrhenius(17.44, 51.6, 300.0, 310.0)])
def test_the_clock_is_the_integral_of_the_inverse_shift_factor(law):
    """dξ = α(T₁)/α(T) dt with α(T₀)τ the times at T; to 1e-10, also across the kink of a joined law."""
    rubber = vf.Material(RUBBER.spectrum, shift=law)
    time, kelvin = np.array([0.0, 2.0, 5.0]), np.array([290.0, 330.0, 320.0])
    schedule = vf.motion.History(time, load=1.0, temperature=kelvin).schedule(rubber, "point")
    kinks = [2.0] if not isinstance(law, vf.WLFArrhenius) else [0.5, 2.0]
    for end in (0.3, 2.0, 4.2):
        wanted, _ = quad(
            lambda t: float(law(290.0) / law(float(np.interp(t, time, kelvin)))), 0.0, end,
            points=[one for one in kinks if one < end] or None, epsabs=0.0, epsrel=1e-13, limit=500,
        )  # fmt: skip
        assert schedule.at(end).clock == pytest.approx(wanted, rel=1e-10)
    assert schedule.temperature(1.0) == pytest.approx(310.0)
