"""One direction of slip is separated only on an assumption that the user asks for, and that is named."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viscofric as vf
from friction.made_runs import FOUR, rows_of, runs_from, traction_runs
from refusals import refused
from viscofric.friction.measurement.tribometry import separate
from viscofric.notes import codes
from viscofric.traction import TractionRuns

ROUNDING = 1e-12
SPEEDS = (0.02, 0.1, 0.2)


def one_way(configuration: tuple[int, int] = (1, 1), **settings_of_runs: object) -> TractionRuns:
    wanted = {"viscoelastic": lambda v, T: 0.03 + 0.05 * v, "replicates": 4, **settings_of_runs}
    return traction_runs(configurations=[configuration], speeds=SPEEDS, **wanted)  # type: ignore[arg-type]


def test_nothing_is_assumed_unless_the_user_asks() -> None:
    with refused("signs-missing") as caught:
        separate(one_way(), zero=0.3)
    assert caught.value.field == "measurement.coulomb"
    with refused("signs-missing") as caught:
        separate(one_way(), coulomb=0.05)
    assert caught.value.field == "measurement.zero"


@pytest.mark.slow
@given(st.sampled_from(FOUR), st.just(0.0) | st.floats(1e-99, 0.5), st.floats(1e-6, 0.2))
@settings(deadline=None, max_examples=20, derandomize=True)
def test_a_coulomb_coefficient_from_elsewhere_is_taken_off(
    configuration: tuple[int, int], coulomb: float, error: float
) -> None:
    """Whichever way disc and ball run; what is wrong with it is wrong with viscoelastic friction, in full."""
    runs = one_way(configuration, coulomb=coulomb)
    curves = separate(runs, zero=0.3, coulomb=(coulomb, error))
    np.testing.assert_allclose(curves.viscoelastic, 0.03 + 0.05 * curves.speed, atol=ROUNDING)
    np.testing.assert_array_equal(curves.coulomb, coulomb)  # type: ignore[arg-type]
    np.testing.assert_allclose(curves.viscoelastic_error, error, atol=ROUNDING)
    np.testing.assert_allclose(curves.coulomb_error, error, rtol=1e-12)  # type: ignore[arg-type]
    off = separate(runs, zero=0.3, coulomb=coulomb + 0.01).viscoelastic - curves.viscoelastic
    np.testing.assert_allclose(off, -0.01 * configuration[0] * configuration[1], atol=ROUNDING)
    assert curves.assumption in curves.notes
    assert curves.assumption.code == "coulomb-assumed"
    values = curves.assumption.values
    assert (values["coulomb"], values["error"], values["senses"]) == (
        coulomb,
        error,
        [float(configuration[0] * configuration[1])],
    )


@pytest.mark.parametrize("configuration", FOUR)
def test_constant_coulomb_friction_leaves_what_varies_with_speed(configuration: tuple[int, int]) -> None:
    """At most the lowest friction where the disc is faster, at least the highest resistance where it is slower."""
    curves = separate(one_way(configuration), zero=0.3, coulomb="constant")
    sense = configuration[0] * configuration[1]
    np.testing.assert_allclose(curves.viscoelastic, 0.05 * (curves.speed - 0.02), atol=ROUNDING)
    np.testing.assert_allclose(curves.coulomb, 0.05 + sense * 0.031, atol=ROUNDING)  # type: ignore[arg-type]
    assert curves.assumption.code == "coulomb-constant"
    assert curves.assumption in curves.notes


def test_errors_of_constant_coulomb_friction_are_those_of_both_speeds() -> None:
    noisy = one_way(noise=0.05, replicates=8)
    curves = separate(noisy, zero=0.3, coulomb="constant")
    alone = separate(noisy, zero=0.3, coulomb=0.0)
    for temperature in curves.temperatures:
        here = curves.temperature == temperature
        lowest = alone.viscoelastic_error[here][np.argmin(alone.viscoelastic[here])]
        np.testing.assert_allclose(
            curves.viscoelastic_error[here], np.hypot(alone.viscoelastic_error[here], lowest), rtol=1e-12
        )
        np.testing.assert_allclose(curves.coulomb_error[here], lowest, rtol=1e-12)  # type: ignore[index]


def test_what_the_signs_show_is_not_assumed() -> None:
    """Only the temperature with one direction of slip is; nothing changes where there are four configurations."""
    whole = traction_runs(viscoelastic=lambda v, T: 0.03, coulomb=0.08, temperatures=[363.15])
    runs = runs_from(np.concatenate([rows_of(one_way()), rows_of(whole)]))
    curves = separate(replace(runs, zero_force=np.full(len(runs), 0.3)), coulomb=0.05)
    assert curves.coulomb is not None
    four = curves.temperature > 350.0
    np.testing.assert_allclose(curves.coulomb[four], 0.08, atol=ROUNDING)
    np.testing.assert_allclose(curves.coulomb[~four], 0.05, atol=ROUNDING)
    assert (curves.assumption.values["conditions"], curves.assumption.values["of"]) == (6, 9)
    assert separate(whole, coulomb=0.05).assumption == ""


def test_both_disc_directions_at_one_slip_need_no_zero_with_a_known_coulomb_friction() -> None:
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, configurations=[(1, 1), (-1, 1)])
    curves = separate(runs, coulomb=0.05)
    np.testing.assert_allclose(curves.viscoelastic, 0.03, atol=ROUNDING)
    np.testing.assert_allclose(curves.offset, 0.3, atol=25 * ROUNDING)  # type: ignore[arg-type]
    with refused("signs-missing"):
        separate(runs, coulomb="constant")


def test_one_slip_is_separated_where_a_replicate_is_incomplete() -> None:
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, configurations=[(1, 1), (-1, 1)], speeds=[0.1], replicates=3)
    rows = rows_of(runs)[1:]
    curves = separate(runs_from(rows[rows[:, 4] == rows[0, 4]]), coulomb=(0.05, 0.01))
    np.testing.assert_allclose(curves.viscoelastic, 0.03, atol=ROUNDING)
    np.testing.assert_array_equal(curves.coulomb_freedom, np.inf)  # type: ignore[arg-type]


@pytest.mark.parametrize(("coulomb", "expected"), [(0.05, set()), (0.5, {"negative-friction"})])
def test_an_assumed_coulomb_friction_above_that_measured_is_noted_however_few_readings_there_are(
    coulomb: float, expected: set[str]
) -> None:
    # Neighbouring readings are alike, so that there is hardly a degree of freedom.
    forces = 0.3 + 25.0 * 0.08 + np.array([0.0, 0.03, 0.06])
    one, load, temperature = np.ones(3), np.full(3, 25.0), np.full(3, 303.15)
    runs = vf.readers.TractionRuns(0.1 * one, 0.095 * one, forces, load, temperature, replicate=one, step=one)
    curves = separate(runs, zero=0.3, coulomb=coulomb)
    assert codes(curves.notes) & {"negative-friction"} == expected


def test_one_speed_shows_nothing_of_constant_coulomb_friction() -> None:
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, configurations=[(1, 1)], speeds=[0.1])
    with refused("one-speed"):
        separate(runs, zero=0.3, coulomb="constant")


@pytest.mark.parametrize("coulomb", ["often", -0.1, (0.1, -0.1), (0.1, 0.1, 0.1), "0.1 N"])
def test_senseless_assumptions_are_refused(coulomb: object) -> None:
    with refused("not-a-coefficient"):
        separate(one_way(), zero=0.3, coulomb=coulomb)  # type: ignore[arg-type]


def test_reversed_runs_with_unsigned_speeds_are_refused() -> None:
    """Forces of both directions in one configuration: their mean is nothing, whatever its standard error."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.02, offset=0.1, replicates=3, noise=0.02)
    unsigned = replace(runs, disc_speed=np.abs(runs.disc_speed), ball_speed=np.abs(runs.ball_speed))
    for zero in (None, 0.1):
        with refused("unsigned-speeds"):
            separate(unsigned, zero=zero)


def test_conditions_with_unsigned_speeds_are_left_out_by_name() -> None:
    runs = traction_runs(viscoelastic=lambda v, T: 0.02, offset=0.1, replicates=3, noise=0.02)
    fast = np.abs(runs.disc_speed) > 0.15
    mixed = replace(
        runs,
        disc_speed=np.where(fast, np.abs(runs.disc_speed), runs.disc_speed),
        ball_speed=np.where(fast, np.abs(runs.ball_speed), runs.ball_speed),
    )
    curves = separate(mixed)
    assert "unsigned-speeds" in codes(curves.notes)
    assert np.all(curves.speed < 0.15)
    np.testing.assert_allclose(curves.viscoelastic, 0.02, atol=3e-3)  # noise of .02 N of 25 N: five errors


@pytest.mark.parametrize("replicates", [2, 3, 5])
def test_one_reading_far_off_is_no_run_without_signs(replicates: int) -> None:
    """Of two directions in one configuration, none is a single reading at one condition alone: none is left out."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.02, offset=0.0, replicates=replicates, noise=0.02)
    far = runs.traction_force - 2.0 * runs.traction_force * (np.arange(len(runs)) == 1)
    curves = separate(replace(runs, traction_force=far))
    assert not codes(curves.notes) & {"unsigned-speeds", "two-groups-of-force"}
    assert len(curves) == 6


def test_forces_in_two_groups_of_one_sign_are_noted() -> None:
    """Half of the replicates at three times the Coulomb friction, as on another sample; scatter alone is none."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.02, offset=0.0, replicates=6, noise=0.02, load_jitter=0.0)
    assert "two-groups-of-force" not in codes(separate(runs).notes)
    other = 25.0 * 0.1 * np.sign(runs.disc_speed - runs.ball_speed) * (runs.replicate > 3)
    assert "two-groups-of-force" in codes(separate(replace(runs, traction_force=runs.traction_force + other)).notes)


@pytest.mark.parametrize(("noise", "replicates"), [(0.3, 3), (1.0, 3), (1.0, 10), (3.0, 3), (1.0, 2)])
def test_scatter_of_few_readings_is_not_taken_for_two_groups(noise: float, replicates: int) -> None:
    """Of 25 N; 540 configurations, of which each has two groups by chance with a probability of 1e-4."""
    said = [
        codes(separate(made, zero=0.0).notes) & {"unsigned-speeds", "two-groups-of-force"}
        for made in (
            traction_runs(
                viscoelastic=lambda v, T: 0.03,
                offset=0.0,
                noise=noise,
                replicates=replicates,
                seed=seed,
                speeds=np.geomspace(0.01, 0.3, 5),
                temperatures=(303.15, 313.15, 323.15),
            )
            for seed in range(9)
        )
    ]
    assert sum(map(bool, said)) <= 1
