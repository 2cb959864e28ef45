"""Signed traction runs come apart into zero, viscoelastic and Coulomb friction, with honest errors."""

from __future__ import annotations

from dataclasses import replace
from time import process_time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import stdtrit
from scipy.stats import binom

from friction.made_runs import FOUR, rows_of, runs_from, timed_sweeps, traction_runs
from refusals import refused
from viscofric.friction.measurement.conditions import conditions, of_the_disc
from viscofric.friction.measurement.fit import operators, residuals
from viscofric.friction.measurement.tribometry import separate
from viscofric.notes import Note, codes

# The fit is linear and well conditioned; a thousand roundings of forces of some 10 N over 25 N.
ROUNDING = 1e-12

coefficients = st.floats(0.0, 1.0)


@given(
    viscoelastic=coefficients,
    coulomb=coefficients,
    offset=st.floats(-5.0, 5.0),
    load=st.floats(0.5, 75.0),
    speed=st.floats(1e-4, 4.0),
    slip_ratio=st.floats(0.06, 1.9),
    replicates=st.integers(1, 3),
    seed=st.integers(0, 2**32 - 1),
)
@settings(deadline=None, max_examples=30, derandomize=True)
@pytest.mark.slow
def test_four_runs_give_back_what_was_planted(
    viscoelastic: float,
    coulomb: float,
    offset: float,
    load: float,
    speed: float,
    slip_ratio: float,
    replicates: int,
    seed: int,
) -> None:
    """Exactly, in whatever order the rows come, with each reading's own load, and nothing is left over."""
    runs = traction_runs(
        viscoelastic=lambda v, T: viscoelastic,
        coulomb=coulomb,
        offset=offset,
        load=load,
        speeds=(speed, 2.0 * speed),
        slip_ratio=slip_ratio,
        replicates=replicates,
        seed=seed,
    )
    shuffled = runs_from(np.random.default_rng(seed).permutation(rows_of(runs)))
    curves = separate(shuffled)
    scale = coulomb + viscoelastic + abs(offset) / load + 1e-3
    assert len(curves) == 4
    assert curves.coulomb is not None
    assert curves.consistency is not None
    assert curves.offset is not None
    np.testing.assert_allclose(curves.viscoelastic, viscoelastic, rtol=0, atol=ROUNDING * scale)
    np.testing.assert_allclose(curves.coulomb, coulomb, rtol=0, atol=ROUNDING * scale)
    np.testing.assert_allclose(curves.offset / load, offset / load, rtol=0, atol=ROUNDING * scale)
    np.testing.assert_allclose(curves.consistency, 0.0, rtol=0, atol=ROUNDING * scale)
    np.testing.assert_allclose(curves.speed, [speed, 2 * speed] * 2, rtol=1e-12)
    assert curves.slip is not None
    np.testing.assert_allclose(curves.slip, slip_ratio * curves.speed, rtol=1e-12)
    assert codes(curves.notes) == (set() if np.ptp(runs.traction_force) else {"constant-force"})


@given(st.lists(st.tuples(st.integers(0, 3), st.integers(1, 4)), max_size=12), st.integers(0, 1000))
@settings(deadline=None, max_examples=25, derandomize=True)
def test_unbalanced_and_jittering_data_give_back_what_was_planted(missing: list[tuple[int, int]], seed: int) -> None:
    """Whatever readings are missing, as long as three configurations are there, and however often others come."""
    runs = traction_runs(
        viscoelastic=lambda v, T: 0.2 * v,
        coulomb=0.07,
        replicates=4,
        speeds=[0.1],
        temperatures=[303.15],
        load_jitter=0.01,
        temperature_jitter=0.1,
        seed=seed,
    )
    rows = rows_of(runs)
    random = np.random.default_rng(seed)
    lacking = [4 * configuration + replicate - 1 for configuration, replicate in missing]
    rows = np.delete(rows, lacking, axis=0)
    there = {(np.sign(row[0]), np.sign(row[0] - row[1])) for row in rows}
    rows = np.concatenate([rows, rows[random.integers(0, len(rows), 5)]])
    if len(there) < 3:
        with refused("signs-missing"):
            separate(runs_from(rows))
        return
    curves = separate(runs_from(rows))
    np.testing.assert_allclose(curves.viscoelastic, 0.02, rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(curves.coulomb, 0.07, rtol=0, atol=ROUNDING)  # type: ignore[arg-type]
    np.testing.assert_allclose(curves.offset, 0.3, rtol=0, atol=25 * ROUNDING)  # type: ignore[arg-type]
    assert not codes(curves.notes) & {"inconsistent", "zero-drifts", "negative-friction"}


def test_the_papers_formulae_hold_for_four_forces() -> None:
    """Eqs. 9a–d by their w = |u_disc| − |u_ball|, with forces that do not fit together."""
    one, two, three, four = 0.7, -1.1, -0.5, 1.9
    load = 20.0
    rows = np.array(
        [
            (-0.1, -0.12, one, load, 303.15, 1),  # I: u < 0, w < 0
            (-0.1, -0.08, two, load, 303.15, 1),  # II: u < 0, w > 0
            (0.1, 0.12, three, load, 303.15, 1),  # III: u > 0, w < 0
            (0.1, 0.08, four, load, 303.15, 1),  # IV: u > 0, w > 0
        ]
    )
    curves = separate(runs_from(rows))
    expected = {
        "offset": (one + two + three + four) / 4,
        "viscoelastic": (three + four - one - two) / 4 / load,
        "coulomb": (one - two - three + four) / 4 / load,
        "consistency": (one - two + three - four) / 4 / load,
    }
    for name, value in expected.items():
        assert getattr(curves, name) == pytest.approx([value], abs=ROUNDING), name
    # One replicate of four runs: one degree of freedom, the leftover, is behind the errors.
    assert curves.viscoelastic_error == pytest.approx(abs(curves.consistency), rel=1e-9)
    assert np.isinf(curves.consistency_error).all()  # type: ignore[arg-type]


def test_mirroring_all_velocities_and_forces_changes_nothing() -> None:
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, noise=0.02, offset=0.2, replicates=4)
    rows = rows_of(runs)
    mirrored = rows * [-1, -1, -1, 1, 1, 1]
    here, there = separate(runs), separate(runs_from(mirrored))
    for name in ("viscoelastic", "viscoelastic_error", "coulomb", "coulomb_error", "speed", "slip"):
        np.testing.assert_allclose(getattr(there, name), getattr(here, name), rtol=1e-9)
    np.testing.assert_allclose(there.offset, -here.offset, rtol=1e-9)  # type: ignore[operator,arg-type]
    np.testing.assert_allclose(there.consistency, -here.consistency, rtol=1e-6)  # type: ignore[operator,arg-type]


def test_a_known_zero_makes_two_reversed_slips_enough() -> None:
    runs = traction_runs(viscoelastic=lambda v, T: v, offset=0.1, configurations=FOUR[2:])
    curves = separate(runs, zero="0.1 N")
    np.testing.assert_allclose(curves.viscoelastic, curves.speed, rtol=ROUNDING)
    np.testing.assert_allclose(curves.coulomb, 0.05, rtol=ROUNDING)  # type: ignore[arg-type]
    assert curves.consistency is None
    np.testing.assert_array_equal(curves.offset, 0.1)  # type: ignore[arg-type]


def test_configurations_at_another_disc_speed_are_named_where_they_are() -> None:
    """The ball's speed is the same for both directions of slip, so that the disc's is not."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, temperatures=[303.15], speeds=[0.1], speed_jitter=0.0)
    faster = np.sign(runs.disc_speed) * (runs.disc_speed - runs.ball_speed) > 0.0
    disc = np.sign(runs.disc_speed) * np.where(faster, 0.12, 0.1)
    runs = replace(runs, disc_speed=disc, ball_speed=np.sign(disc) * 0.11)
    with refused("signs-missing") as caught:
        separate(runs)
    # the missing signs were measured at the other of the two speeds
    assert caught.value.note.values["other_speed"] in (pytest.approx(0.1), pytest.approx(0.12))
    np.testing.assert_allclose(separate(runs, speed_tolerance=0.3).viscoelastic, 0.03, rtol=1e-9)  # no noise


@pytest.mark.parametrize("tolerance", [0.3, 0.4])
def test_a_ball_of_constant_speed_is_separated_with_a_wider_tolerance(tolerance: float) -> None:
    """As the refusal advises.  0.4 would chain all speeds together, which are then put together by disc and ball."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.0, speeds=[0.1, 0.2, 0.4, 0.8, 1.6], temperatures=[303.15])
    sign, slip = np.sign(runs.disc_speed), np.sign(runs.disc_speed - runs.ball_speed)
    disc = runs.disc_speed * (1.0 + 0.15 * sign * slip)
    force = runs.traction_force + runs.load * sign * 0.02 * np.abs(disc) ** -0.2
    runs = replace(runs, disc_speed=disc, ball_speed=runs.disc_speed, traction_force=force)
    with refused("signs-missing"):
        separate(runs)
    curves = separate(runs, speed_tolerance=tolerance)
    np.testing.assert_allclose(curves.speed, [0.1, 0.2, 0.4, 0.8, 1.6], rtol=1e-9)
    # Half the curvature over ±15 % of speed: 0.2 · 1.2 / 2 · 0.15² = 0.3 %.
    np.testing.assert_allclose(curves.viscoelastic, 0.02 * curves.speed**-0.2, rtol=4e-3)
    np.testing.assert_allclose(curves.coulomb, 0.05, rtol=0.02)  # type: ignore[arg-type]


def test_two_reversed_slips_without_a_zero_are_refused() -> None:
    """Zero and viscoelastic friction cannot be told apart, though jittering loads make the fit regular."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, configurations=FOUR[2:], temperatures=[303.15], speeds=[0.1])
    with refused("signs-missing") as caught:
        separate(runs)
    assert caught.value.field == "measurement.zero"
    assert {"missing": [[-1, -1], [-1, 1]], "pure_rolling": False}.items() <= caught.value.note.values.items()


def test_three_configurations_suffice_without_a_check() -> None:
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, configurations=FOUR[:3])
    curves = separate(runs)
    np.testing.assert_allclose(curves.viscoelastic, 0.03, rtol=ROUNDING)
    assert curves.consistency is None


def test_pure_rolling_needs_no_coulomb_friction() -> None:
    """Both directions of a rolling ball: slip has no sign, however the speeds jitter."""
    runs = traction_runs(
        viscoelastic=lambda v, T: 0.03,
        slip_ratio=0.0,
        configurations=[(-1, 1), (1, 1)],
        coulomb=0.0,
        replicates=4,
        speed_jitter=0.002,
    )
    curves = separate(runs)
    np.testing.assert_allclose(curves.viscoelastic, 0.03, rtol=ROUNDING)
    assert curves.coulomb is None
    assert "slip-is-rolling" in codes(curves.notes)


def test_rolling_and_sliding_are_conditions_of_their_own() -> None:
    sliding = traction_runs(viscoelastic=lambda v, T: 0.03, replicates=2)
    rolling = traction_runs(
        viscoelastic=lambda v, T: 0.03, slip_ratio=0.0, configurations=[(-1, 0), (1, 0)], replicates=2
    )
    curves = separate(runs_from(np.concatenate([rows_of(sliding), rows_of(rolling)])))
    assert len(curves) == 12
    np.testing.assert_allclose(curves.viscoelastic, 0.03, rtol=ROUNDING)
    rolls = curves.slip == 0.0
    assert np.count_nonzero(rolls) == 6
    assert curves.coulomb_error is not None
    assert np.all(np.isinf(curves.coulomb_error) == rolls)


@pytest.mark.slow
def test_standard_errors_are_honest() -> None:
    """Intervals of 95 % by Student's t, n − 1 degrees of freedom, hold the truth in 95 % of noisy tests."""
    replicates, temperatures = 8, tuple(290.0 + 5.0 * np.arange(60))
    truth = {"viscoelastic": 0.03, "coulomb": 0.05, "consistency": 0.0}
    runs = traction_runs(
        viscoelastic=lambda v, T: 0.03,
        speeds=[0.05, 0.1, 0.2],
        temperatures=temperatures,
        replicates=replicates,
        noise=0.05,
        seed=5,
    )
    curves = separate(runs)
    assert len(curves) == 180
    quantile = stdtrit(replicates - 1, 0.975)
    # Limits that chance leaves once in a million times.
    low, high = binom.interval(1 - 1e-6, 180, 0.95)
    for name, value in truth.items():
        error = getattr(curves, f"{name}_error")
        held = np.count_nonzero(np.abs(getattr(curves, name) - value) <= quantile * error)
        assert low <= held <= high, name
    # 32 readings per entry: 0.05 N / √32 / 25 N; from 1260 degrees of freedom known to 2 %, thrice that.
    assert np.sqrt(np.mean(curves.viscoelastic_error**2)) == pytest.approx(0.05 / np.sqrt(32) / 25, rel=0.06)
    np.testing.assert_allclose(curves.viscoelastic_scatter, np.sqrt(replicates) * curves.viscoelastic_error)


def test_standard_errors_are_honest_where_replicates_are_incomplete() -> None:
    """All readings are fitted together, which is said; intervals use the residuals' degrees of freedom."""
    runs = traction_runs(
        viscoelastic=lambda v, T: 0.03,
        temperatures=tuple(290.0 + 5.0 * np.arange(60)),
        replicates=3,
        noise=0.05,
        seed=6,
    )
    rows = rows_of(runs)
    incomplete = rows[~((rows[:, 5] == 3) & (rows[:, 0] < 0) & (rows[:, 0] > rows[:, 1]))]
    curves = separate(runs_from(incomplete))
    assert len(incomplete) == 180 * 11
    assert "incomplete-replicates" in codes(curves.notes)
    held = np.count_nonzero(np.abs(curves.viscoelastic - 0.03) <= stdtrit(11 - 3, 0.975) * curves.viscoelastic_error)
    low, high = binom.interval(1 - 1e-6, 180, 0.95)
    assert low <= held <= high
    assert np.all(curves.replicates == 3)


def test_readings_without_slip_are_named_as_the_cause() -> None:
    runs = traction_runs(viscoelastic=lambda v, T: 0.03)
    rows = rows_of(runs)
    rolling = (rows[:, 0] > rows[:, 1]) & (rows[:, 5] == 1)
    rows[rolling, 1] = rows[rolling, 0]
    notes = separate(runs_from(rows)).notes
    assert [note.values["readings"] for note in notes if note.code == "pure-rolling"] == [2]
    assert "incomplete-replicates" not in codes(notes)


def test_drift_of_the_zero_between_replicates_does_not_reach_friction() -> None:
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, replicates=5)
    rows = rows_of(runs)
    rows[:, 2] += 0.4 * rows[:, 5]
    curves = separate(runs_from(rows))
    np.testing.assert_allclose(curves.viscoelastic, 0.03, rtol=ROUNDING)
    assert np.all(curves.viscoelastic_error < ROUNDING)


def test_jittering_speeds_loads_and_temperatures_group_properly() -> None:
    """Speeds jitter by 1 %, loads by 1 %, temperatures by 0.2 K; conditions are those that were set."""
    speeds, temperatures = np.geomspace(0.02, 0.2, 10), (303.15, 333.15, 363.15)
    runs = traction_runs(
        viscoelastic=lambda v, T: 0.05 * v**0.2,
        speeds=tuple(speeds),
        temperatures=temperatures,
        replicates=8,
        speed_jitter=0.01,
        temperature_jitter=0.2,
        slip_ratio=0.1,
        seed=7,
    )
    curves = separate(runs)
    assert len(curves) == 30
    assert np.all(curves.replicates == 8)
    assert curves.temperatures.size == 3
    assert curves.speeds.size == 10
    # Means over 96 and 320 readings; five standard errors.
    np.testing.assert_allclose(curves.speeds, speeds, rtol=5 * 0.01 / np.sqrt(96))
    np.testing.assert_allclose(curves.temperatures, temperatures, atol=5 * 0.2 / np.sqrt(320))
    np.testing.assert_allclose(curves.viscoelastic, np.tile(0.05 * speeds**0.2, 3), rtol=ROUNDING)


def test_loads_and_slips_are_kept_apart() -> None:
    parts = [
        rows_of(traction_runs(viscoelastic=lambda v, T, mu=mu: mu, load=load, slip_ratio=slip))  # type: ignore[misc]
        for mu, load, slip in ((0.02, 10.0, 0.1), (0.03, 10.0, 0.5), (0.04, 25.0, 0.1), (0.05, 25.0, 0.5))
    ]
    curves = separate(runs_from(np.concatenate(parts)))
    assert len(curves) == 4 * 6
    np.testing.assert_allclose(np.sort(curves.viscoelastic), np.repeat([0.02, 0.03, 0.04, 0.05], 6), rtol=ROUNDING)
    np.testing.assert_allclose(curves.at_load("10 N").viscoelastic.max(), 0.03, rtol=ROUNDING)


def test_speeds_without_gaps_are_refused_unless_the_tolerance_is_small() -> None:
    speeds = 0.02 * 1.03 ** np.arange(12)
    runs = traction_runs(viscoelastic=lambda v, T: v, speeds=tuple(speeds), temperatures=[303.15])
    with refused("no-gap") as caught:
        separate(runs)
    assert caught.value.field == "measurement.speed_tolerance"
    values = caught.value.note.values
    assert (values["low"], values["high"]) == pytest.approx((speeds[0], speeds[-1]))
    np.testing.assert_allclose(separate(runs, speed_tolerance=0.01).viscoelastic, speeds, rtol=ROUNDING)


def test_a_broken_test_is_noted_by_its_consistency() -> None:
    """The zero moves when the disc reverses its slip: the four configurations no longer fit the model."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, replicates=8, noise=0.01)
    rows = rows_of(runs)
    broken = rows.copy()
    crossed = np.sign(rows[:, 0]) * np.sign(rows[:, 0] - rows[:, 1])
    broken[:, 2] -= 0.25 * crossed
    curves = separate(runs_from(broken))
    # 0.25 N over 25 N; five standard errors of 0.01 N / √32 / 25 N.
    np.testing.assert_allclose(curves.consistency, 0.01, atol=1e-4)  # type: ignore[arg-type]
    (note,) = [note for note in curves.notes if note.code == "inconsistent"]
    assert note.values == {"conditions": 6, "of": 6}
    assert separate(runs).notes == ()


@pytest.mark.parametrize(
    ("signs", "names", "cause"),
    [
        ([1, 1, -1], {"viscoelastic", "Coulomb"}, "signs-reversed"),
        ([-1, -1, 1], {"viscoelastic", "Coulomb"}, "signs-reversed"),
        # The sense of slip alone, as where disc and ball are exchanged at a constant mean speed.
        ([1, 1, 1], {"Coulomb"}, "speeds-exchanged"),
        # And the force reversed.
        ([1, 1, -1], {"viscoelastic"}, "disc-turns-against-sign"),
    ],
)
def test_negative_friction_is_noted_with_what_can_be_its_reason(signs: list[int], names: set[str], cause: str) -> None:
    rows = rows_of(traction_runs(viscoelastic=lambda v, T: 0.03, replicates=3, noise=0.01)) * [*signs, 1, 1, 1]
    if len(names) == 1:
        rows[:, 1] = 2.0 * rows[:, 0] - rows[:, 1]
    notes = [note for note in separate(runs_from(rows)).notes if note.code == "negative-friction"]
    assert {note.values["coefficient"] for note in notes} == names
    assert all(cause in note.values["reasons"] for note in notes)


@pytest.mark.parametrize("field", ["load", "temperature", "disc_speed"])
def test_values_without_gaps_are_refused_with_what_helps(field: str) -> None:
    """The steps that were not steady are named; what the sentence tells to do is done here, and helps."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, speeds=[0.1], temperatures=[303.15], replicates=24)
    step = np.digitize(runs.replicate, [3, 5, 23]) + 1
    ramp = np.where(step == 3, 0.02 * (runs.replicate - 5), 0.0)
    changed = {
        "load": {"load": runs.load * (1.0 - ramp), "traction_force": 0.3 + (runs.traction_force - 0.3) * (1.0 - ramp)},
        "temperature": {"temperature": runs.temperature + 20.0 * ramp},
        "disc_speed": {"disc_speed": runs.disc_speed * (1.0 - ramp), "ball_speed": runs.ball_speed * (1.0 - ramp)},
    }[field]
    runs = replace(runs, step=step, **changed)
    with refused("no-gap") as caught:
        separate(runs)
    assert field in caught.value.note.values["of"]
    curves = separate(runs.select(except_steps=caught.value.note.values["unsteady_steps"]))
    assert curves.viscoelastic == pytest.approx([0.03], rel=ROUNDING)


def test_a_drift_of_the_temperature_is_separated_with_the_tolerance_that_is_reported() -> None:
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, speeds=[0.1], temperatures=[303.15], replicates=30)
    runs = replace(runs, temperature=303.15 + 0.15 * runs.replicate)
    with refused("no-gap") as caught:
        separate(runs)
    found = caught.value.note.values
    assert separate(runs, temperature_tolerance=found["tolerance"]).viscoelastic == pytest.approx([0.03], rel=ROUNDING)
    steady = runs.select(abs(runs.temperature - found["middle"]) < found["within"])
    assert separate(steady).viscoelastic == pytest.approx([0.03], rel=ROUNDING)


def test_an_outlier_is_noted_and_kept() -> None:
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, replicates=8, noise=0.01, speeds=[0.1], temperatures=[303.15])
    rows = rows_of(runs)
    rows[5, 2] += 0.5
    curves = separate(runs_from(rows))
    (note,) = (note for note in curves.notes if note.code == "outliers")
    assert note.values == {"readings": 1, "rows": [6]}
    assert note.remedy is not None
    assert "--leave-out-outliers" in note.words("shell")
    # Kept: it moves the mean by 0.5 N / 32 / 25 N = 6.3e-4; noise has a standard error of 7e-5.
    assert abs(curves.viscoelastic[0] - 0.03) > 3e-4


@pytest.mark.parametrize("places", [(5,), (5, 40, 41, 60)])
def test_outliers_are_left_out_if_wanted_and_named(places: tuple[int, ...]) -> None:
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, replicates=8, noise=0.01, speeds=[0.1])
    rows = rows_of(runs)
    rows[list(places), 2] += 0.5
    curves = separate(runs_from(rows), outliers="leave out")
    without = separate(runs_from(np.delete(rows, places, axis=0)))
    np.testing.assert_array_equal(curves.viscoelastic, without.viscoelastic)
    np.testing.assert_array_equal(curves.coulomb_error, without.coulomb_error)  # type: ignore[arg-type]
    (note,) = (note for note in curves.notes if note.code == "outliers")
    assert note.values == {"readings": len(places), "rows": [place + 1 for place in places[:3]]}
    assert note.remedy is None
    with refused("wrong-choice", naming=("outliers", "'keep'", "'leave out'")):
        separate(runs, outliers="drop")  # type: ignore[arg-type]


def test_outliers_are_left_out_with_all_that_was_recorded_with_them() -> None:
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, replicates=8, noise=0.01, speeds=[0.1])
    force = runs.traction_force.copy()
    force[9] -= 0.5
    recorded = replace(
        runs,
        traction_force=force,
        zero_force=np.full(len(runs), 0.3),
        time=np.arange(len(runs), dtype=float),
        step=np.arange(len(runs)),
    )
    curves = separate(recorded, outliers="leave out")
    # 31 readings of 0.01 N over 25 N: 7e-5; five of them.
    np.testing.assert_allclose(curves.viscoelastic, 0.03, atol=3.6e-4)


@pytest.mark.parametrize("replicates", [1, 2, 4])
def test_few_readings_of_a_rolling_ball_have_no_sense_of_slip(replicates: int) -> None:
    """All of few readings jitter to the same side every other time; 3 standard deviations pass 359 times in 360."""
    temperatures = tuple(290.0 + 5.0 * np.arange(20))
    runs = traction_runs(
        viscoelastic=lambda v, T: 0.03,
        slip_ratio=0.0,
        configurations=[(-1, 1), (1, 1)],
        coulomb=0.0,
        temperatures=temperatures,
        replicates=replicates,
        speed_jitter=0.002,
    )
    curves = separate(runs)
    assert len(curves) >= 58  # of 60
    np.testing.assert_allclose(curves.viscoelastic, 0.03, rtol=ROUNDING)


def test_slip_of_a_rolling_ball_scatters_as_the_difference_of_two_speeds() -> None:
    """Single readings of 300 conditions: 3 standard deviations of it pass 299, three of one speed 290 of them."""
    runs = traction_runs(
        viscoelastic=lambda v, T: 0.03,
        slip_ratio=0.0,
        configurations=[(-1, 1), (1, 1)],
        coulomb=0.0,
        temperatures=tuple(280.0 + 2.0 * np.arange(100)),
        replicates=1,
        speed_jitter=0.004,
    )
    found, _ = conditions(runs, of_the_disc(runs), 0.05, 1.0)
    assert len(found) == 300
    # Of 300 chances of 1 in 360 more than four come true once in 600 times.
    assert sum(bool(np.any(one.slip_sign)) for one in found) <= 4


@pytest.mark.parametrize(
    ("slip_ratio", "replicates", "jitter"),
    [(0.02, 8, 0.001), (0.04, 8, 0.001), (0.05, 4, 0.002), (0.055, 4, 0.002), (0.06, 4, 0.002)],
)
def test_slip_reversed_at_constant_rolling_speed_is_no_jitter(
    slip_ratio: float, replicates: int, jitter: float
) -> None:
    """The disc's two speeds lie within the tolerance, or have a gap at some conditions and none at others.

    What each scatters by tells slip from rolling; disc and ball have one mean speed.
    """
    rows = rows_of(
        traction_runs(viscoelastic=lambda v, T: 0.03, slip_ratio=slip_ratio, replicates=replicates, speed_jitter=jitter)
    )
    rows[:, :2] += 0.5 * (rows[:, :1] - rows[:, 1:2])
    curves = separate(runs_from(rows))
    assert len(curves) == 6
    assert "outliers" not in codes(curves.notes)
    np.testing.assert_allclose(curves.viscoelastic, 0.03, rtol=1e-3)
    np.testing.assert_allclose(curves.coulomb, 0.05, rtol=1e-3)  # type: ignore[arg-type]


@pytest.mark.parametrize("slip_ratio", [0.01, 0.03, 1.5])
def test_small_slips_have_signs_where_speeds_are_steady(slip_ratio: float) -> None:
    """What slip can be told from rolling follows from the measured jitter of the speeds, here 0.1 %."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, speed_jitter=0.001, slip_ratio=slip_ratio, replicates=8)
    curves = separate(runs)
    assert len(curves) == 6
    np.testing.assert_allclose(curves.coulomb, 0.05, rtol=ROUNDING)  # type: ignore[arg-type]


def test_gaussian_noise_is_seldom_called_an_outlier() -> None:
    runs = traction_runs(
        viscoelastic=lambda v, T: 0.03,
        temperatures=tuple(290.0 + 5.0 * np.arange(40)),
        replicates=8,
        noise=0.05,
        seed=8,
    )
    count = sum(note.values["readings"] for note in separate(runs).notes if note.code == "outliers")
    # 3840 readings; their common scale is known to 2 %, and 5 σ is passed once in two million times.
    assert count == 0


def test_readings_at_rest_are_left_out_and_said() -> None:
    runs = traction_runs(viscoelastic=lambda v, T: 0.03)
    rest = np.array([[0.0, 0.0, 0.3, 25.0, 303.15, 1]])
    curves = separate(runs_from(np.concatenate([rows_of(runs), rest])))
    np.testing.assert_allclose(curves.viscoelastic, 0.03, rtol=ROUNDING)
    (note,) = curves.notes
    assert isinstance(note, Note)
    assert (note.code, note.values) == ("disc-at-rest", {"readings": 1, "of": 49})


def test_unknown_errors_are_infinite_and_said() -> None:
    """Three readings for three unknowns leave nothing to tell the scatter from."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, configurations=FOUR[:3], replicates=1)
    curves = separate(runs)
    assert np.all(np.isinf(curves.viscoelastic_error))
    assert "few-readings" in codes(curves.notes)


def test_no_readings_are_an_error() -> None:
    with refused("no-readings"):
        separate(runs_from(np.empty((0, 6))))


@pytest.mark.parametrize("tolerance", [0.0, 1.0, -1.0])
def test_tolerance_must_be_a_fraction(tolerance: float) -> None:
    with refused("out-of-range", naming="speed_tolerance"):
        separate(traction_runs(viscoelastic=lambda v, T: 0.03), speed_tolerance=tolerance)


@pytest.mark.slow
def test_many_readings_take_seconds() -> None:
    """Hundreds of conditions of eight replicates; the limit allows a machine ten times slower than a laptop."""
    runs = traction_runs(
        viscoelastic=lambda v, T: 0.03,
        speeds=tuple(np.geomspace(0.02, 0.2, 30)),
        temperatures=tuple(290.0 + 5.0 * np.arange(13)),
        replicates=8,
        noise=0.05,
    )
    assert len(runs) == 12480
    start = process_time()
    curves = separate(runs)
    assert process_time() - start < 5.0
    assert len(curves) == 390
    assert curves.notes == ()


def test_outliers_are_distinguished_from_the_scatter_of_loads() -> None:
    """Loads that jitter by 2 % move forces by 0.03 N, and an offset of 30 N by none of that: 0.1 N stand out."""
    runs = traction_runs(
        viscoelastic=lambda v, T: 0.03, offset=30.0, load_jitter=0.02, noise=0.002, replicates=8, seed=2
    )
    force = runs.traction_force.copy()
    force[5] += 0.1
    (note,) = [one for one in separate(replace(runs, traction_force=force)).notes if one.code == "outliers"]
    assert note.values == {"readings": 1, "rows": [6]}


def test_residuals_are_those_of_least_squares_with_and_without_the_fourth_coefficient() -> None:
    """Configurations measured unequally often, with loads of their own: the regressors are not orthogonal."""
    random = np.random.default_rng(4)
    disc, slip = np.array(FOUR)[[0, 0, 0, 1, 2, 2, 3, 3, 3]].T
    load = 1.0 + 0.1 * random.standard_normal(9)
    design = np.stack([np.ones(9), load * disc, load * slip], axis=1)
    crossed, target = -load * disc * slip, random.standard_normal((9, 2))
    operator = operators(design, crossed, [np.arange(9)])
    both = np.column_stack([design, crossed])
    expected = [target - one @ np.linalg.lstsq(one, target, rcond=None)[0] for one in (design, both)]
    for found, wanted in zip(residuals(design, crossed, operator, target), expected, strict=True):
        np.testing.assert_allclose(found, wanted, atol=1e-12)


def test_a_force_that_never_changes_is_noted() -> None:
    """As of a force cell that was not recorded: zero friction with zero error, at all speeds."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.03)
    stuck = replace(runs, traction_force=np.full(len(runs), 0.12))
    assert "constant-force" in codes(separate(stuck).notes)
    assert "constant-force" not in codes(separate(runs).notes)


def test_loads_that_differ_between_the_directions_of_the_disc_are_taken_together() -> None:
    """As where friction acts on the load; 12 % apart are no two nominal loads that lack a direction each."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, offset=0.0)
    factor = 1.0 + 0.06 * np.sign(runs.disc_speed)
    apart = replace(runs, load=factor * runs.load, traction_force=factor * runs.traction_force)
    curves = separate(apart)
    assert codes(curves.notes) == {"loads-differ"}
    np.testing.assert_allclose(curves.viscoelastic, 0.03, rtol=ROUNDING)
    np.testing.assert_allclose(curves.load, 25.0, rtol=0.02)
    # Two loads with all directions each are two conditions, however near.
    assert len(separate(runs_from(np.concatenate([rows_of(runs), rows_of(runs) * [1, 1, 1.1, 1.1, 1, 1]])))) == 12


@pytest.mark.parametrize(("order", "hidden"), [((0, 2, 3, 1), True), ((0, 1, 2, 3), False)])
def test_wear_that_the_order_of_one_run_hides_is_noted(order: tuple[int, ...], hidden: bool) -> None:
    """Coulomb friction that falls linearly leaves nothing, or most of its change, in the residual."""
    runs = timed_sweeps(np.geomspace(0.02, 0.2, 5), runs=1, configurations=[FOUR[one] for one in order])
    assert ("wear-not-shown" in codes(separate(runs).notes)) == hidden
