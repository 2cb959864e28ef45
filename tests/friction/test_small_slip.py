"""Slip that is smaller than its own error is neither separated as reversed nor quietly taken for pure rolling."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from friction.made_runs import exported_runs, rows_of, runs_from, traction_runs
from viscofric.friction.measurement.tribometry import separate
from viscofric.notes import codes
from viscofric.traction import TractionRuns

# The fit is linear and well conditioned; a thousand roundings of forces of some 10 N over 25 N.
ROUNDING = 1e-12


def swept_runs(slip_error: float) -> TractionRuns:
    """Make steps that sweep the slip from 20 % to 0.2 %, recorded too small by a part of the speed (m/s over m/s)."""
    ratios = np.linspace(0.2, 0.002, 40)
    runs = exported_runs(points=ratios.size, rolling_speeds=[0.1], steps=3, noise=0.02)
    random = np.random.default_rng(2)
    sense = np.sign(runs.disc_speed - runs.ball_speed)
    slip = sense * 0.1 * np.tile(np.repeat(ratios, 2), 3) + 2e-4 * random.standard_normal(len(runs))
    # Coulomb friction goes with the slip there is, not with what is recorded of it.
    force = 0.3 + runs.load * (0.03 + 0.05 * np.sign(slip)) + 0.02 * random.standard_normal(len(runs))
    recorded = slip - 0.1 * slip_error
    return replace(runs, disc_speed=0.1 + 0.5 * recorded, ball_speed=0.1 - 0.5 * recorded, traction_force=force)


def test_slip_that_is_not_reversed_in_a_point_of_a_sweep_counts_as_none() -> None:
    """Recorded 1.2 % too small, slips below that are recorded with one sign in both readings of a point."""
    curves = separate(swept_runs(0.012))
    (reported,) = [note for note in curves.notes if note.code == "slip-not-reversed"]
    # 3 steps with 2 or 3 of 40 ratios between 0.2 and 1.2 %, two readings each; noise of 0.2 % moves one or two.
    assert 6 <= int(reported.split()[1]) <= 24
    assert curves.coulomb is not None
    assert curves.slip is not None
    sliding = curves.slip > 0.05 * curves.speed
    # 0.02 N twice over 25 N, of at least 20 readings: 2.5e-4; five of them.
    np.testing.assert_allclose(curves.viscoelastic[sliding], 0.03, atol=1.3e-3)
    np.testing.assert_allclose(curves.coulomb[sliding], 0.05, atol=1.3e-3)


def test_a_slip_that_is_right_is_reversed_everywhere() -> None:
    runs = swept_runs(0.0)
    large = np.abs(runs.disc_speed - runs.ball_speed) > 1e-3
    assert "slip-not-reversed" not in codes(separate(runs.select(large)).notes)


def test_readings_of_one_direction_keep_their_slip_however_coarse_the_clock() -> None:
    """Several readings of one second are no pair: nothing says that slip should be reversed between them."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, replicates=3)
    whole = replace(runs, time=np.arange(len(runs)) // 3 * 1.0, step=np.ones(len(runs), dtype=int))
    assert separate(whole).viscoelastic == pytest.approx(separate(runs).viscoelastic, rel=ROUNDING)


@pytest.mark.parametrize("unnoticed", [0.0, 0.4])
def test_rolling_with_unnoticed_slip_is_left_out_where_sliding_contradicts_it(unnoticed: float) -> None:
    """A part of Coulomb friction goes with the disc where its radius is not quite the one that is reckoned with."""
    sliding = traction_runs(viscoelastic=lambda v, T: 0.03, replicates=4, noise=0.01)
    rolling = traction_runs(
        viscoelastic=lambda v, T: 0.03 + unnoticed * 0.05,
        slip_ratio=0.0,
        configurations=[(-1, 0), (1, 0)],
        replicates=4,
        noise=0.01,
        seed=3,
    )
    curves = separate(runs_from(np.concatenate([rows_of(sliding), rows_of(rolling)])))
    reported = [note for note in curves.notes if note.code == "unnoticed-slip"]
    assert curves.slip is not None
    assert (len(curves), np.count_nonzero(curves.slip == 0.0)) == ((6, 0) if unnoticed else (12, 6))
    # Noise of 0.01 N over 25 N and the root of 8 readings or more; five standard errors.
    np.testing.assert_allclose(curves.viscoelastic, 0.03, atol=5 * 0.01 / 25.0 / np.sqrt(8))
    assert len(reported) == (6 if unnoticed else 0)
    # of noise as above
    assert all(note.values["without_slip"] == pytest.approx(0.05, abs=1e-3) for note in reported)
    assert all(note.values["with_slip"] == pytest.approx(0.03, abs=1e-3) for note in reported)
