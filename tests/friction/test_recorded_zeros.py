"""Two configurations and a recorded zero tell viscoelastic friction; zeros that are wrong or drift are found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import binom

from friction.made_runs import FOUR, exported_runs, rows_of, runs_from, traction_runs
from refusals import refused
from viscofric.friction.measurement.conditions import Condition
from viscofric.friction.measurement.fit import Entry
from viscofric.friction.measurement.tribometry import separate
from viscofric.friction.measurement.zeros import Zeros, wanders
from viscofric.notes import codes
from viscofric.traction import TractionRuns

# The fit is linear and well conditioned; a thousand roundings of forces of some 10 N over 25 N.
ROUNDING = 1e-12


@given(
    viscoelastic=st.floats(0.0, 0.5),
    coulomb=st.floats(0.0, 0.5),
    offset=st.floats(-3.0, 3.0),
    slip_ratio=st.floats(0.03, 0.5),
    seed=st.integers(0, 1000),
)
@settings(deadline=None, max_examples=15, derandomize=True)
@pytest.mark.slow
def test_half_difference_and_half_sum_above_the_recorded_zero(
    viscoelastic: float, coulomb: float, offset: float, slip_ratio: float, seed: int
) -> None:
    runs = exported_runs(
        viscoelastic=lambda v: viscoelastic,
        coulomb=coulomb,
        offset=lambda t: offset,
        slip_ratio=slip_ratio,
        steps=2,
        seed=seed,
    )
    curves = separate(runs)
    scale = viscoelastic + coulomb + abs(offset) / 25.0 + 1e-3
    assert len(curves) == 2
    # Equal steps of both directions about the mean speed.
    np.testing.assert_allclose(curves.speed, [0.02, 0.1], rtol=1e-12)
    np.testing.assert_allclose(curves.slip, slip_ratio * curves.speed, rtol=1e-12)
    np.testing.assert_allclose(curves.viscoelastic, viscoelastic, rtol=0, atol=ROUNDING * scale)
    np.testing.assert_allclose(curves.coulomb, coulomb, rtol=0, atol=ROUNDING * scale)  # type: ignore[arg-type]
    np.testing.assert_allclose(curves.offset, offset, rtol=0, atol=25.0 * ROUNDING * scale)  # type: ignore[arg-type]
    assert curves.consistency is None


def test_each_reading_counts_above_the_zero_of_its_own_step() -> None:
    """The zero jumps from step to step and every jump is recorded: nothing of it is left."""
    jumps = np.random.default_rng(1).normal(0.0, 0.3, 100)
    runs = exported_runs(offset=lambda t: float(jumps[int(t // 18)]))
    curves = separate(runs)
    np.testing.assert_allclose(curves.viscoelastic, 0.03, rtol=ROUNDING)
    np.testing.assert_allclose(curves.viscoelastic_scatter, 0.0, atol=ROUNDING)


def test_a_given_zero_overrides_what_was_recorded_with_its_own_error() -> None:
    runs = replace(exported_runs(), zero_force=np.full(96, 7.0))
    exact = separate(runs, zero="300 mN")
    np.testing.assert_allclose(exact.viscoelastic, 0.03, rtol=ROUNDING)
    assert not codes(exact.notes) & {"recorded-zero", "another-zero", "recorded-zero-drifts"}
    loose = separate(runs, zero=("300 mN", "50 mN"))
    # The half-sum less the zero: 0.05 N over 25 N.
    np.testing.assert_allclose(loose.viscoelastic_error, 0.05 / 25.0, rtol=0.01)
    # The half-difference does without it, but for half of what friction changes between the disc's speeds, which are
    # 20 % apart, by a slope told by two such errors over the speeds 0.02 and 0.1 m/s …
    slope = np.sqrt(2.0) * (0.05 / 25.0) / 0.03 / np.log(5.0)
    by_slope = 0.5 * np.log(1.1 / 0.9) * 0.03 * slope
    # … and by a curvature that two speeds do not tell, 0.7 of 1.2 at most.
    steps, other = np.log([1.1, 0.9]), np.log([[5.0], [0.2]])
    by_curvature = 0.5 * 0.03 * 0.7 * 1.2 / 2.0 * np.abs(np.diff(steps * (steps - other)))[:, 0]
    np.testing.assert_allclose(loose.coulomb_error, np.hypot(by_slope, by_curvature), rtol=1e-3)  # type: ignore[arg-type]
    np.testing.assert_allclose(np.subtract(*loose.interval()[::-1]), 2 * 1.95996 * 0.05 / 25.0, rtol=0.01)
    with refused("negative"):
        separate(runs, zero=(0.3, -0.1))


@pytest.mark.parametrize(
    "own",
    [
        pytest.param(True, id="one for each replicate", marks=pytest.mark.slow),
        pytest.param(False, id="shared by the replicates"),
    ],
)
def test_errors_of_the_recorded_zeros_are_in_the_standard_errors(own: bool) -> None:
    """Intervals of 95 % hold the truth in 95 % of tests, whether scatter shows the error of the zero or not."""
    held = {"viscoelastic": 0, "coulomb": 0}
    for seed in range(20):
        steps, speeds = 8 if own else 4, (0.02, 0.05, 0.1)
        runs = exported_runs(zero_noise=0.1, noise=0.02, seed=seed, steps=steps, rolling_speeds=speeds, points=6)
        if not own:
            # Half of each step is one replicate, half the next: every recording serves two.
            assert runs.time is not None
            runs = replace(runs, replicate=2 * runs.replicate - (runs.time % 36.0 < 18.0))
        curves = separate(runs)
        for name, truth in (("viscoelastic", 0.03), ("coulomb", 0.05)):
            low, high = curves.interval(of=name)  # type: ignore[arg-type]
            held[name] += int(np.count_nonzero((low <= truth) & (truth <= high)))
    # Limits that chance leaves once in a million times.
    low_count, high_count = binom.interval(1 - 1e-6, 60, 0.95)
    for name, count in held.items():
        assert low_count <= count <= high_count, (name, count)


@pytest.mark.slow
def test_the_error_of_a_zero_that_all_replicates_share_is_reported_by_the_other_recordings() -> None:
    """Each speed in one step: no scatter shows what is wrong with its zero, of which viscoelastic friction is made."""
    held = {"viscoelastic": 0, "coulomb": 0}
    for seed in range(20):
        speeds = tuple(0.02 * 1.2 ** np.arange(12))
        runs = exported_runs(
            zero_noise=0.1, noise=0.02, seed=seed, steps=1, points=8, rolling_speeds=speeds, slip_ratio=0.04
        )
        assert runs.time is not None
        runs = replace(runs, replicate=1 + (runs.time // 6.0).astype(int) % 8)
        curves = separate(runs)
        # Whatever the numbers of its readings, one step is one repetition.
        assert np.all(curves.replicates == 1)
        assert "steps-not-repeated" in codes(curves.notes)
        for name, truth in (("viscoelastic", 0.03), ("coulomb", 0.05)):
            low, high = curves.interval(of=name)  # type: ignore[arg-type]
            held[name] += int(np.count_nonzero((low <= truth) & (truth <= high)))
    # Limits that chance leaves once in a million times.
    low_count, high_count = binom.interval(1 - 1e-6, 240, 0.95)
    for name, count in held.items():
        assert low_count <= count <= high_count, (name, count)


@pytest.mark.parametrize("sharing", [[0, 1, 2, 3], [0, 0, 1, 1], [0, 0, 0, 1], [0, 0, 0, 0]])
def test_replicates_that_share_recordings_do_not_count_their_errors_twice(sharing: list[int]) -> None:
    """What scatter shows of the zeros' errors and what is added make up the variance of the mean."""
    runs = traction_runs(
        viscoelastic=lambda v, T: 0.03, configurations=FOUR[2:], speeds=[0.1], temperatures=[303.15], replicates=4
    )
    recording = np.array(sharing)[runs.replicate - 1]
    rows = np.arange(len(runs))
    group = Condition(rows, 303.15, 0.1, 25.0, 0.02, np.sign(runs.disc_speed), np.sign(runs.disc_speed))
    zeros = Zeros(np.zeros(len(runs)), recording, 0.1, 5.0, False, np.zeros(4))
    # The mean of two readings in each of four replicates.
    operator = np.full((4, len(runs)), 1.0 / len(runs))
    added = zeros.variance(group, operator, runs.replicate - 1)
    drawn = 0.1 * np.random.default_rng(4).standard_normal((20000, 4))[:, sharing]
    shown, true = drawn.var(axis=1, ddof=1).mean() / 4.0, drawn.mean(axis=1).var()
    # Variances of 20000 draws are known to 1 %; five of that.
    np.testing.assert_allclose(shown + added, true, rtol=0.05)
    np.testing.assert_allclose(zeros.variance(group, operator, None), true, rtol=0.05)


@pytest.mark.slow
@pytest.mark.parametrize("whole", [True, False], ids=["whole steps", "a direction of slip missing in one"])
def test_readings_of_one_step_are_no_repetitions(whole: bool) -> None:
    """What goes wrong with a step, here its zero, goes wrong with all its readings: intervals hold nevertheless."""
    held = 0
    for seed in range(40):
        runs = exported_runs(
            zero_noise=0.1,
            noise=0.02,
            seed=seed,
            steps=9,
            points=4,
            rolling_speeds=(0.02, 0.05, 0.1),
            slip_ratio=0.04,
        )
        assert runs.step is not None
        # As a reader numbers them that knows no replicates: every point of a step is one.
        runs = replace(runs, replicate=np.repeat(np.arange(len(runs) // 2), 2))
        if not whole:
            lacking = (runs.step > 3) | (runs.disc_speed > runs.ball_speed)
            columns = {field.name: getattr(runs, field.name) for field in fields(runs)}
            arrays = {name: value[lacking] for name, value in columns.items() if isinstance(value, np.ndarray)}
            runs = replace(runs, **arrays)
        curves = separate(runs)
        # Of 9 steps two coefficients leave 7 degrees of freedom, a mean of 9 leaves 8.
        np.testing.assert_allclose(curves.viscoelastic_freedom, 8.0 if whole else 7.0)  # type: ignore[arg-type]
        low, high = curves.interval()
        held += int(np.count_nonzero((low <= 0.03) & (high >= 0.03)))
    # Limits that chance leaves once in a million times; by single readings it is less than 70.
    low_count, high_count = binom.interval(1 - 1e-6, 120, 0.95)
    assert low_count <= held <= high_count


def test_errors_by_steps_are_those_of_the_sandwich_formula() -> None:
    """Liang and Zeger's, with the number of steps over that less the unknowns, worked out by matrices here."""
    runs = exported_runs(zero_noise=0.1, noise=0.02, steps=7, rolling_speeds=[0.1], points=4, slip_ratio=0.04)
    assert runs.step is not None
    assert runs.zero_force is not None
    there = (runs.step > 1) | (runs.disc_speed > runs.ball_speed)
    columns = {field.name: getattr(runs, field.name) for field in fields(runs)}
    runs = replace(runs, **{name: one[there] for name, one in columns.items() if isinstance(one, np.ndarray)})
    curves = separate(runs)
    slip = np.sign(runs.disc_speed - runs.ball_speed)
    regressors = np.column_stack([runs.load, slip * runs.load])
    force = runs.traction_force - runs.zero_force
    inverse = np.linalg.inv(regressors.T @ regressors)
    left = force - regressors @ (inverse @ regressors.T @ force)
    sums = np.array([(regressors * left[:, None])[runs.step == one].sum(axis=0) for one in range(1, 8)])
    errors = np.sqrt(np.diag(inverse @ sums.T @ sums @ inverse) * 7 / (7 - 2))
    assert curves.viscoelastic_error == pytest.approx(errors[:1], rel=1e-9)
    assert curves.coulomb_error == pytest.approx(errors[1:], rel=1e-9)


def test_degrees_of_freedom_go_together_after_welch_and_satterthwaite() -> None:
    """Equal variances of 4 and 6 degrees of freedom: 2² / (1/4 + 1/6) = 9.6; one of none stays as it is."""
    error, freedom = np.full(4, 0.1), np.full(4, 4.0)
    entry = Entry(None, np.zeros(4), error, error, freedom)  # type: ignore[arg-type]
    wider = entry.widened(np.array([0.01, 0.01, 0.0, 0.03]), 6.0)
    np.testing.assert_allclose(wider.error, [np.sqrt(0.02), np.sqrt(0.02), 0.1, 0.2])
    np.testing.assert_allclose(wider.freedom, [9.6, 9.6, 4.0, 16.0 / (1.0 / 4.0 + 9.0 / 6.0)])
    np.testing.assert_allclose(entry.widened(np.full(4, 0.03), np.inf).freedom, 64.0)


def test_one_recording_is_used_and_said() -> None:
    curves = separate(exported_runs(noise=0.01, slip_ratio=0.04))
    (note,) = [note for note in curves.notes if note.code == "recorded-zero"]
    assert note.code == "recorded-zero"
    np.testing.assert_allclose(curves.viscoelastic_freedom, 7.0)  # type: ignore[arg-type]


def test_the_disc_speeds_that_slip_parts_are_put_together_and_said() -> None:
    """By step and time, or by the mean speed of disc and ball where these are missing."""
    runs = exported_runs(noise=0.01, zero_noise=0.01)
    plain = replace(runs, step=None, time=None)
    for one in (runs, plain):
        curves = separate(one)
        assert len(curves) == 2
        (note,) = [note for note in curves.notes if note.code == "speed-differs"]
        assert note.values["difference"] == pytest.approx(0.2, abs=5e-3)
        np.testing.assert_allclose(curves.speed, [0.02, 0.1], rtol=1e-12)


@pytest.mark.slow
@given(power=st.floats(-0.5, 0.5), slip_ratio=st.floats(0.06, 0.5))
@settings(deadline=None, max_examples=15, derandomize=True)
def test_viscoelastic_friction_that_changes_with_speed_does_not_reach_coulomb_friction(
    power: float, slip_ratio: float
) -> None:
    """The disc's speeds differ by the slip; a power of speed is told exactly by the speeds of the test."""

    def planted(speed: float) -> float:
        return float(0.03 * (speed / 0.05) ** power)

    runs = exported_runs(
        viscoelastic=planted, steps=2, rolling_speeds=(0.02, 0.05, 0.1), slip_ratio=slip_ratio, load_jitter=0.0
    )
    curves = separate(runs)
    # Where slip ratios are equal the mean over both speeds is off by the same factor everywhere: the slope is exact.
    np.testing.assert_allclose(curves.viscoelastic, 0.03 * (curves.speed / 0.05) ** power, rtol=1e-9)
    np.testing.assert_allclose(curves.coulomb, 0.05, rtol=1e-9)  # type: ignore[arg-type]
    alone = exported_runs(viscoelastic=planted, steps=2, rolling_speeds=[0.05], slip_ratio=slip_ratio)
    assert "speed-differs" in codes(separate(alone).notes)
    # Nothing tells the slope of one speed: what it may be is in the error.
    alone_curves = separate(alone)
    assert alone_curves.coulomb_error is not None
    assert abs(alone_curves.coulomb[0] - 0.05) < 1.5 * alone_curves.coulomb_error[0] + 1e-12  # type: ignore[index]


@pytest.mark.parametrize("slip_ratio", [0.2, 0.5])
@pytest.mark.parametrize("speeds", [(0.03, 0.06), (0.02, 0.05, 0.1, 0.2)], ids=["two speeds", "four speeds"])
@pytest.mark.slow
def test_a_sharp_maximum_of_friction_does_not_reach_coulomb_friction_unnoticed(
    speeds: tuple[float, ...], slip_ratio: float
) -> None:
    """What the speeds of a test leave open of friction between them is in both errors."""

    def planted(speed: float) -> float:
        return float(0.01 + 0.03 * np.exp(-((np.log10(speed / 0.06) / 0.5) ** 2)))

    held = {"viscoelastic": 0, "coulomb": 0}
    for seed in range(8):
        runs = exported_runs(
            viscoelastic=planted, rolling_speeds=speeds, slip_ratio=slip_ratio, noise=0.02, points=2, seed=seed
        )
        curves = separate(runs)
        for name, truth in (("viscoelastic", [planted(one) for one in speeds]), ("coulomb", 0.05)):
            low, high = curves.interval(of=name)  # type: ignore[arg-type]
            held[name] += int(np.count_nonzero((low <= truth) & (truth <= high)))
    # Limit that chance falls below once in 10 000 times, with as many independent points; errors are on the safe side.
    for name, count in held.items():
        assert count >= binom.ppf(1e-4, 8 * len(speeds), 0.95), (name, count)


@pytest.mark.slow
def test_swept_slip_is_cut_into_intervals() -> None:
    parts = [rows_of(exported_runs(slip_ratio=ratio, steps=2, points=1)) for ratio in np.linspace(0.001, 0.5, 200)]
    curves = separate(runs_from(np.concatenate(parts)), zero=0.3)
    assert "slip-swept" in codes(curves.notes)
    assert curves.coulomb_error is not None
    slides = np.isfinite(curves.coulomb_error)
    assert np.count_nonzero(slides) >= 6
    np.testing.assert_allclose(curves.viscoelastic[slides], 0.03, rtol=1e-9)
    np.testing.assert_allclose(curves.coulomb[slides], 0.05, rtol=1e-9)  # type: ignore[index]
    # Taken for rolling, both directions cancel but for the jitter of the loads, 1 %, of at least 4 readings.
    np.testing.assert_allclose(curves.viscoelastic[~slides], 0.03, atol=5 * 0.01 * 0.05 / 2.0)


def test_pure_rolling_above_a_recorded_zero_needs_no_assumption() -> None:
    runs = traction_runs(
        viscoelastic=lambda v, T: 0.03, slip_ratio=0.0, coulomb=0.0, configurations=[(1, 1)], replicates=4
    )
    curves = separate(replace(runs, zero_force=np.full(len(runs), 0.3)))
    np.testing.assert_allclose(curves.viscoelastic, 0.03, rtol=ROUNDING)
    assert curves.coulomb is None
    assert curves.assumption == ""


def test_conditions_that_cannot_be_separated_are_left_out_and_said() -> None:
    whole = rows_of(traction_runs(viscoelastic=lambda v, T: 0.03))
    half = rows_of(traction_runs(viscoelastic=lambda v, T: 0.03, temperatures=[363.15], configurations=FOUR[3:]))
    curves = separate(runs_from(np.concatenate([whole, half])))
    assert len(curves) == 6
    (note,) = curves.notes
    assert note.code == "signs-missing"
    assert (note.values["conditions"], note.values["of"]) == (3, 9)


def test_a_wrong_zero_is_named_where_it_alone_can_make_viscoelastic_friction_negative() -> None:
    """Coulomb friction, the half-difference, is positive, so that the sign of the force is right."""
    curves = separate(replace(exported_runs(noise=0.01), zero_force=np.full(96, 2.0)))
    assert np.all(curves.viscoelastic < 0.0)
    assert "negative-friction" in codes(curves.notes)


def test_a_wrong_recorded_zero_does_no_harm_to_four_configurations_and_is_found() -> None:
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, replicates=8, noise=0.02)
    recorded = [np.full(len(runs), 0.3), np.full(len(runs), 0.1)]
    right, wrong = (separate(replace(runs, zero_force=zero)) for zero in recorded)
    np.testing.assert_array_equal(wrong.viscoelastic, right.viscoelastic)
    assert right.notes == ()
    (note,) = wrong.notes
    assert note.code == "another-zero"
    assert (note.values["conditions"], note.values["of"], note.values["recorded"]) == (6, 6, pytest.approx(0.1))
    assert note.values["fitted"] == pytest.approx(0.3, abs=0.05)  # noise of 0.02 N


def test_recorded_zeros_that_drift_are_noted() -> None:
    steady = separate(exported_runs(zero_noise=0.02, noise=0.02, seed=2))
    moving = separate(exported_runs(zero_noise=0.02, noise=0.02, seed=2, offset=lambda t: 0.3 + 0.002 * t))
    assert not codes(steady.notes) & {"zero-drifts", "recorded-zero-drifts"}
    # From 0.3 N to 0.3 N + 15 steps of 18 s at 0.002 N/s, 0.54 N: 0.022 of 25 N.
    (note,) = [note for note in moving.notes if note.code == "recorded-zero-drifts"]
    assert note.values["of_load"] == pytest.approx(0.022, abs=1.5e-3)


def test_four_configurations_follow_recorded_zeros_that_the_forces_follow() -> None:
    """Each configuration in a step of its own whose zero was recorded: the jumps do not reach friction."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, replicates=4, noise=0.001)
    jumps = np.random.default_rng(3).normal(0.0, 0.2, len(runs))
    moved = replace(runs, traction_force=runs.traction_force + jumps)
    recorded = separate(replace(moved, zero_force=0.3 + jumps))
    # 16 readings of 1 mN: 1e-5 of 25 N; five of them.  Unrecorded, 0.2 N / 4 / 25 N = 2e-3.
    np.testing.assert_allclose(recorded.viscoelastic, 0.03, atol=5e-5)
    assert "zero-unsteady" in codes(recorded.notes)
    assert np.sqrt(np.mean((separate(moved).viscoelastic - 0.03) ** 2)) > 5e-4
    # Recordings that scatter by themselves are not followed.
    noisy = separate(replace(runs, zero_force=0.3 + jumps))
    np.testing.assert_array_equal(noisy.viscoelastic, separate(runs).viscoelastic)


@pytest.mark.parametrize("replicates", [1, 3])
@pytest.mark.parametrize("timed", [True, False])
def test_a_drift_that_recorded_zeros_followed_is_no_drift_of_the_conditions(replicates: int, timed: bool) -> None:
    """Zeros of conditions one after the other differ by what was recorded, which is taken out already."""
    speeds = np.geomspace(0.02, 0.2, 6)
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, replicates=replicates, noise=0.005, speeds=speeds)
    time = 10.0 * np.arange(len(runs))
    zero = 0.3 + 2e-3 * time + np.random.default_rng(0).normal(0.0, 0.02, len(runs))
    drifting = replace(runs, traction_force=runs.traction_force + zero - 0.3, zero_force=zero)
    curves = separate(replace(drifting, time=time) if timed else drifting)
    assert "zero-unsteady" in codes(curves.notes)
    assert not codes(curves.notes) & {"zero-drifts", "zero-wanders"}
    # 4 readings of 5 mN: 1e-4 of 25 N, four of them.  Between the directions the drift of 20 s is half of 0.04 N, 8e-4.
    np.testing.assert_allclose(curves.viscoelastic, 0.03, atol=4e-4)


def _one_after_the_other(runs: TractionRuns, seconds: float) -> TractionRuns:
    """Order the readings as series: replicate by replicate, in each all conditions of one configuration first."""
    rows = rows_of(runs)
    order = np.lexsort((np.sign(rows[:, 0]), np.sign(rows[:, 0] - rows[:, 1]), rows[:, 5]))
    return replace(runs_from(rows[order]), time=seconds * np.arange(len(rows)))


def test_a_drift_between_configurations_is_found_from_the_whole_test_where_repetitions_follow_at_once() -> None:
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, replicates=3, noise=0.01)
    time = 10.0 * np.arange(len(runs))
    curves = separate(replace(runs, time=time, traction_force=runs.traction_force + 4e-4 * time))
    (note,) = [note for note in curves.notes if note.code == "zero-drifts"]
    # 18 zeros of 0.01 N over the root of 4 readings, within 210 s of their mean time: 6e-6 N/s; five of them.
    assert note.values["rate"] == pytest.approx(4e-4, abs=3e-5)
    # 72 readings of 0.01 N: 5e-5 of 25 N; five of them.  The drift of 30 s between configurations is 4.8e-4.
    assert np.mean(curves.viscoelastic) == pytest.approx(0.03, abs=2.5e-4)


@pytest.mark.parametrize("of", ["temperature", "load", "speed"])
def test_zeros_that_differ_between_conditions_measured_at_once_are_no_drift(of: str) -> None:
    """As where load or temperature acts on the force cell: nothing changes within a condition."""
    parts = [
        rows_of(traction_runs(viscoelastic=lambda v, T: 0.03, replicates=3, noise=0.01, load=load, seed=int(load)))
        for load in ((10.0, 25.0) if of == "load" else (25.0,))
    ]
    rows = np.concatenate(parts)
    column = {"temperature": 4, "load": 3, "speed": 0}[of]
    rows[:, 2] += 0.1 * np.searchsorted([0.05, 0.15, 15.0, 320.0], np.abs(rows[:, column]))
    curves = separate(replace(runs_from(rows), time=10.0 * np.arange(len(rows))))
    assert not codes(curves.notes)
    # 12 readings of 0.01 N, at 10 N or more: 2.9e-4 of the load, four of them.
    np.testing.assert_allclose(curves.viscoelastic, 0.03, atol=1.2e-3)


def test_coulomb_friction_that_grows_with_wear_does_not_reach_viscoelastic_friction() -> None:
    """Configurations in the order of the paper, whose viscoelastic part has half of what grows from one to the next."""
    rows = rows_of(traction_runs(viscoelastic=lambda v, T: 0.03, replicates=6, noise=0.01))
    order = [FOUR.index(signs) for signs in zip(np.sign(rows[:, 0]), np.sign(rows[:, 0] - rows[:, 1]), strict=True)]
    rows = rows[np.lexsort((order, rows[:, 5]))]
    time = 10.0 * np.arange(len(rows))
    rows[:, 2] += 0.05 * rows[:, 3] * np.sign(rows[:, 0] - rows[:, 1]) * 0.8 * time / time.max()
    curves = separate(replace(runs_from(rows), time=time))
    (note,) = curves.notes
    assert note.code == "coulomb-drifts"
    # From 1 to 1.8 times as much, over 1.4 in the middle; six replicates of 0.01 N of 1.75 N determine it to 1 %.
    assert note.values["rate"] * time.max() == pytest.approx(0.8 / 1.4, rel=0.03)
    # 144 readings of 0.01 N: 3e-5 of the load over all, five of them.  Half of 0.8/24 of 0.05 is 8e-4.
    assert np.mean(curves.viscoelastic) == pytest.approx(0.03, abs=1.7e-4)
    # What Coulomb friction changes by is in its own errors: 0.8/√12 of 0.05, over the root of six.
    assert np.median(curves.coulomb_error) == pytest.approx(0.005, rel=0.2)  # type: ignore[arg-type]


AT_ONCE = ("temperature", "speed", "configuration", "replicate")
REPEATED = ("temperature", "speed", "replicate", "configuration")
WHOLE_SWEEPS = ("temperature", "configuration", "replicate", "speed")
BY_REPLICATE = ("replicate", "temperature", "speed", "configuration")
SLOW_CONFIGURATIONS = ("configuration", "temperature", "speed", "replicate")
SWEEPS_BY_REPLICATE = ("temperature", "replicate", "configuration", "speed")
#: Places in `FOUR`; an even change leaves no residual of the four configurations, and moves viscoelastic friction.
WITHOUT_RESIDUAL = (0, 2, 3, 1)


def _worn(
    change: float,
    seed: int,
    *,
    first: float = 0.0,
    order: Sequence[int] = range(4),
    sequence: Sequence[str] = AT_ONCE,
    **planted: Any,
) -> TractionRuns:
    """Make a test while Coulomb friction grows by `change`, and by `first` in the first replicate of all.

    `order` are the configurations in time, `sequence` is what changes from slow to fast.
    """
    rows = rows_of(traction_runs(viscoelastic=lambda v, T: 0.03, seed=seed, **planted))
    place = [FOUR.index(signs) for signs in zip(np.sign(rows[:, 0]), np.sign(rows[:, 0] - rows[:, 1]), strict=True)]
    keys = {
        "temperature": rows[:, 4],
        "speed": np.abs(rows[:, 0]),
        "configuration": np.argsort(order)[place],
        "replicate": rows[:, 5],
    }
    rows = rows[np.lexsort([keys[name] for name in reversed(sequence)])]
    time = 10.0 * np.arange(len(rows))
    more = change * time / time.max() + first * (rows[:, 5] == 1)
    rows[:, 2] += 0.05 * rows[:, 3] * np.sign(rows[:, 0] - rows[:, 1]) * more
    return replace(runs_from(rows), time=time)


def test_wear_during_repetitions_made_at_once_is_in_the_errors() -> None:
    """The residual of the configurations has twice of it, which no scatter of replicates shows: 2 of 60 were held."""
    within = []
    for seed in range(10):
        curves = separate(_worn(0.6, seed, replicates=2, noise=0.005))
        low, high = curves.interval()
        within += [*((low <= 0.03) & (high >= 0.03))]
        assert codes(curves.notes) & {"residual-in-errors", "coulomb-drifts"}
    assert np.mean(within) > 0.86  # 95 %, less three standard deviations of 60


def test_wear_is_found_from_replicates_made_at_once() -> None:
    """Each condition has a line of its own; one line of their means over speeds left a single degree of freedom."""
    curves = separate(_worn(1.0, 1, replicates=3, noise=0.002, speeds=np.geomspace(0.02, 0.2, 6), temperatures=[303.0]))
    (note,) = [note for note in curves.notes if note.code == "coulomb-drifts"]
    # Over its mean, 1.5 times that at first; 72 readings every 10 s.  Six lines through zeros of 0.001 N over 1.25 N
    # at -10, 0 and 10 s: 2.3e-5 per second; four of them.
    assert note.values["rate"] == pytest.approx(1.0 / 1.5 / 710.0, abs=4 * 2.3e-5)


SIX = {"replicates": 3, "noise": 0.01, "speeds": np.geomspace(0.02, 0.2, 6), "temperatures": [303.0]}


@pytest.mark.parametrize("order", [(0, 1, 2, 3), WITHOUT_RESIDUAL])
def test_higher_friction_in_the_first_replicate_of_each_configuration_is_no_wear(order: tuple[int, ...]) -> None:
    """As by running in: taken for wear between configurations, it moved viscoelastic friction by 0.004 or 0.01.

    The residual of the configurations contradicts it; where there is none, such wear would leave no friction.
    """
    curves = separate(_worn(0.0, 1, first=0.1, order=order, **SIX))
    assert "coulomb-drifts" not in codes(curves.notes)
    # 12 readings of 0.01 N: 1.2e-4 of 25 N, four of them.
    np.testing.assert_allclose(curves.viscoelastic, 0.03, atol=5e-4)


@pytest.mark.parametrize(("change", "first"), [(0.0, 0.1), (-0.5, 0.0)], ids=["running in", "wear"])
def test_wear_and_running_in_are_both_possible_where_configurations_have_no_residual(
    change: float, first: float
) -> None:
    """Half of what wear would change is subtracted, and the errors hold the other half: either truth is within them."""
    curves = separate(_worn(change, 1, first=first, order=WITHOUT_RESIDUAL, sequence=REPEATED, **SIX))
    (note,) = [note for note in curves.notes if note.code == "coulomb-drifts"]
    assert note.values["subtracted"] == 0.5
    # The half alone is one standard error, so that no point is more than two away.
    assert np.all(np.abs(curves.viscoelastic - 0.03) < 2.0 * curves.viscoelastic_error)
    assert curves.viscoelastic_error.max() > 0.45 * note.values["viscoelastic"]


def test_wear_in_whole_sweeps_is_found_or_in_the_errors() -> None:
    """One configuration after the other, without a residual: of 60 points 14 were held."""
    within = []
    for seed in range(10):
        runs = _worn(-0.5, seed, order=WITHOUT_RESIDUAL, sequence=WHOLE_SWEEPS, replicates=3, noise=0.01)
        curves = separate(runs)
        low, high = curves.interval()
        within += [*((low <= 0.03) & (high >= 0.03))]
        assert "coulomb-drifts" in codes(curves.notes)
    assert np.mean(within) > 0.86  # 95 %, less three standard deviations of 60


@pytest.mark.parametrize(
    ("order", "sequence", "replicates", "hides"),
    [
        (WITHOUT_RESIDUAL, WHOLE_SWEEPS, 2, True),
        (WITHOUT_RESIDUAL, REPEATED, 2, False),
        (range(4), REPEATED, 3, False),
        (range(4), AT_ONCE, 3, False),
        (range(4), BY_REPLICATE, 3, False),
    ],
)
def test_an_order_of_readings_that_cannot_show_wear_is_noted(
    order: Sequence[int], sequence: Sequence[str], replicates: int, hides: bool
) -> None:
    """Two sweeps of each configuration, far apart, leave too few degrees of freedom for the course of friction."""
    runs = _worn(0.0, 2, order=order, sequence=sequence, replicates=replicates, noise=0.1, temperatures=[303.0])
    assert ("wear-not-shown" in codes(separate(runs).notes)) == hides


@pytest.mark.parametrize("sequence", [BY_REPLICATE, SWEEPS_BY_REPLICATE])
def test_errors_hold_no_wear_that_a_residual_without_a_trace_of_it_would_leave(sequence: Sequence[str]) -> None:
    """In such an order only loads that differ by 1 % leave a residual: errors of 2e-4 were 0.13."""
    for seed in range(5):
        runs = _worn(0.0, seed, order=(1, 3, 2, 0), sequence=sequence, **SIX)
        curves = separate(runs)
        # 12 readings of 0.01 N: 1.2e-4 of 25 N; their scatter, and that of wear that four runs show, twice as much.
        assert curves.viscoelastic_error.max() < 5e-4


@given(rate=st.floats(-1e-2, 1e-2), replicates=st.integers(3, 5), seed=st.integers(0, 1000))
@settings(deadline=None, max_examples=20, derandomize=True)
def test_an_even_drift_of_the_zero_is_taken_out(rate: float, replicates: int, seed: int) -> None:
    """N/s, with configurations measured one after the other: exactly, whatever the rate."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, replicates=replicates, seed=seed)
    runs = _one_after_the_other(runs, 10.0)
    assert runs.time is not None
    curves = separate(replace(runs, traction_force=runs.traction_force + rate * runs.time))
    # The largest offset is 1e-2 N/s over 1200 s, and roundings are of it.
    np.testing.assert_allclose(curves.viscoelastic, 0.03, atol=1e-9)
    np.testing.assert_allclose(curves.coulomb, 0.05, atol=1e-9)  # type: ignore[arg-type]


def test_a_drift_is_not_taken_out_twice_where_the_recorded_zeros_hold_it() -> None:
    """Four configurations at one temperature tell the drift; two at another are above zeros that drifted as well."""
    four = _one_after_the_other(
        traction_runs(viscoelastic=lambda v, T: 0.03, temperatures=[303.15], replicates=4, noise=0.01), 10.0
    )
    two = traction_runs(
        viscoelastic=lambda v, T: 0.03,
        temperatures=[333.15],
        configurations=FOUR[2:],
        replicates=4,
        offset=0.0,
        noise=0.01,
        seed=2,
    )
    rows = np.concatenate([rows_of(four), rows_of(two)])
    time = 10.0 * np.arange(len(rows))
    # One direction of slip after the other in the two configurations.
    late = np.arange(len(four), len(rows))
    rows[late] = rows[late][np.argsort(rows[late, 0] - rows[late, 1], kind="stable")]
    drift = 2e-3 * time
    zero = np.where(np.arange(len(rows)) < len(four), np.nan, drift)
    rows[:, 2] += drift
    curves = separate(replace(runs_from(rows), time=time, zero_force=zero))
    (note,) = [note for note in curves.notes if note.code == "zero-drifts"]
    assert 3600.0 * note.values["rate"] == pytest.approx(7.2, abs=0.3)  # 2 mN/s in N/h
    # Noise of 0.01 N over 25 N and the root of 8 readings, 1.4e-4; five of them.  Twice taken out, the drift of 120 s
    # between the directions of slip is half of 0.24 N over 25 N, 5e-3.
    np.testing.assert_allclose(curves.viscoelastic, 0.03, atol=7e-4)
    np.testing.assert_allclose(curves.coulomb, 0.05, atol=7e-4)  # type: ignore[arg-type]


@pytest.mark.parametrize("count", [3, 6, 40])
def test_degrees_of_freedom_of_recorded_zeros(count: int) -> None:
    """2(k−1)²/(3k−4) for the mean square of k−1 successive differences: nothing but the zeros scatters here."""
    runs = traction_runs(
        viscoelastic=lambda v, T: 0.03,
        coulomb=0.0,
        slip_ratio=0.0,
        configurations=[(1, 1)],
        speeds=[0.1],
        temperatures=303.15 + 5.0 * np.arange(count),
        load_jitter=0.0,
    )
    recorded = np.repeat(0.3 + 0.1 * np.random.default_rng(1).standard_normal(count), 2)
    curves = separate(replace(runs, zero_force=recorded))
    assert len(curves) == count
    freedom = 2.0 * (count - 1) ** 2 / (3 * count - 4)
    np.testing.assert_allclose(curves.viscoelastic_freedom, freedom, rtol=1e-9)  # type: ignore[arg-type]
    np.testing.assert_allclose(
        curves.viscoelastic_error, np.sqrt(np.mean(np.diff(recorded[::2]) ** 2) / 2.0) / 25.0, rtol=1e-9
    )


def test_drift_is_reported_with_its_size_in_friction() -> None:
    runs = _one_after_the_other(traction_runs(viscoelastic=lambda v, T: 0.03, replicates=6, noise=0.01), 10.0)
    assert runs.time is not None
    drifting = replace(runs, traction_force=runs.traction_force + 0.5 * runs.time / 3600.0)
    curves = separate(drifting)
    (note,) = curves.notes
    assert note.code == "zero-drifts"
    assert 3600.0 * note.values["rate"] == pytest.approx(0.5, abs=0.05)
    # Each configuration of a replicate takes 60 s: the disc reverses after one, slip after two; half of each.
    assert note.values["viscoelastic"] == pytest.approx(0.00017, abs=1e-5)
    assert note.values["coulomb"] == pytest.approx(0.000333, abs=1.5e-5)
    left = separate(replace(drifting, time=None))
    (note,) = left.notes
    # 0.5 N/h over 1430 s, even: their product, 0.2 N, over the square root of 12.
    assert note.code == "zero-wanders"
    assert note.values["standard_deviation"] == pytest.approx(0.059, abs=5e-4)
    assert np.mean(left.coulomb) - 0.05 == pytest.approx(0.5 / 3600 * 120 / 2 / 25, rel=0.3)  # type: ignore[arg-type]
    # 144 readings of 0.01 N: 3e-5 of the load over all; five of them.
    assert np.mean(curves.coulomb) == pytest.approx(0.05, abs=2e-4)  # type: ignore[arg-type]


@pytest.mark.slow
def test_the_error_of_a_drift_is_in_the_standard_errors() -> None:
    """All repetitions of a configuration before the next: the drift between them is small beside what it changes."""
    held = 0
    for seed in range(120):
        runs = traction_runs(
            viscoelastic=lambda v, T: 0.03, replicates=6, noise=0.02, seed=seed, speeds=[0.1], temperatures=[303.15]
        )
        time = 10.0 * np.arange(len(runs))
        curves = separate(replace(runs, time=time, traction_force=runs.traction_force + 0.02 * time))
        assert curves.notes[0].code == "zero-drifts"
        low, high = curves.interval()
        held += int(np.count_nonzero((low <= 0.03) & (high >= 0.03)))
    # Limits that chance leaves once in a million times.
    low_count, high_count = binom.interval(1 - 1e-6, 120, 0.95)
    assert low_count <= held <= high_count


def test_a_drift_that_does_not_show_is_in_the_standard_errors() -> None:
    """Configurations change slowest: of a drift as large as the error of its rate, taken for none, 71 % were held."""
    held = []
    for seed in range(20):
        runs = _worn(0.0, seed, sequence=SLOW_CONFIGURATIONS, noise=0.01, replicates=3, temperatures=[303.15])
        assert runs.time is not None
        drift = 0.03 * runs.time / runs.time.max()
        low, high = separate(replace(runs, traction_force=runs.traction_force + drift)).interval()
        held += [*((low <= 0.03) & (high >= 0.03))]
    # The three points of a test err together: 95 % less two standard deviations of 20.
    assert np.mean(held) > 0.85


@pytest.mark.slow
def test_steady_zeros_are_seldom_said_to_drift() -> None:
    reported = 0
    for seed in range(40):
        runs = traction_runs(viscoelastic=lambda v, T: 0.03, replicates=4, noise=0.05, speeds=[0.1], seed=seed)
        reported += bool(codes(separate(_one_after_the_other(runs, 10.0)).notes) & {"zero-drifts", "zero-wanders"})
    # A rate is told once in 370 tests by chance, uneven motion about as often: 0.2 expected.
    assert reported <= 2


def test_a_zero_that_jumps_between_series_is_reported_but_no_drift_is_made_of_it() -> None:
    runs = _one_after_the_other(traction_runs(viscoelastic=lambda v, T: 0.03, replicates=6, noise=0.01), 10.0)
    jumps = 0.3 * np.array([0, 1, -1, 2, 0, -2, 1])[runs.replicate]
    curves = separate(replace(runs, traction_force=runs.traction_force + jumps))
    np.testing.assert_allclose(curves.viscoelastic, separate(runs).viscoelastic, rtol=1e-9)
    assert codes(curves.notes) == {"zero-wanders"}


def test_a_given_zero_that_the_configurations_contradict_is_reported() -> None:
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, noise=0.02, offset=0.3)
    (reported,) = [note for note in separate(runs, zero="0.5 N").notes if note.code == "given-zero-contradicted"]
    assert (reported.values["given"], reported.values["conditions"]) == (0.5, 6)
    assert reported.values["fitted"] == pytest.approx(0.3, abs=0.01)
    assert "given-zero-contradicted" not in codes(separate(runs, zero=("0.3 N", "0.02 N")).notes)
    # One direction of the disc tells no zero.
    forwards = runs.select(runs.disc_speed > 0.0)
    assert "given-zero-contradicted" not in codes(separate(forwards, zero="0.5 N").notes)


@pytest.mark.parametrize(("signs", "replicates"), [(FOUR[:3], 2), (FOUR, 1), (FOUR, 3)])
def test_rounding_of_exact_forces_is_no_deviation(signs: Sequence[tuple[int, int]], replicates: int) -> None:
    """Neither runs that differ alike at all speeds, nor another zero than the given one."""
    said: set[str] = set()
    for seed in range(6):
        runs = traction_runs(
            viscoelastic=lambda v, T, mu=0.01 + 0.003 * seed: mu * v**0.1, load=0.1 + seed, load_jitter=0.0, offset=0.0,
            speeds=(0.02, 0.05, 0.1, 0.2), configurations=signs, replicates=replicates,
        )  # fmt: skip
        said |= codes((*separate(runs).notes, *separate(runs, zero=0.0).notes))
    assert said == set()


def test_a_constant_zero_does_not_drift() -> None:
    """Though the mean of equal numbers is not equal to them to rounding."""
    assert not any(wanders(np.full(count, 0.3)) for count in range(3, 60))
