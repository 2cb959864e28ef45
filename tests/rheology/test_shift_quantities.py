"""Shift factors from E' alone, from E'' or tan δ, and with weights: planted factors, errors, notes, refusals."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from rheology.planted import planted_sweeps, random_sweeps, synthetic_polymer
from viscofric.notes import codes
from viscofric.rheology.shifts.vertical_shift import DensityShift

POLYMER = {
    "material": synthetic_polymer(),
    "celsius": np.arange(-25.0, 101.0, 12.5),
    "frequencies": np.logspace(-2, 2, 17),
}
REFERENCE = "25 degC"


def scores(seed, log10_b=None, **asked):
    """Return errors of log10 α over their standard errors, and the fit."""
    planted = planted_sweeps(seed, 0.01, **POLYMER, **({} if log10_b is None else {"log10_b": log10_b}))
    fit = vf.superpose(planted.sweeps, REFERENCE, **asked)
    factors = fit.shift_factors
    known = factors.standard_errors > 1e-9
    away = factors.log10_values - planted.log10_alpha(factors.temperatures, REFERENCE)
    return (away / np.where(known, factors.standard_errors, 1.0))[known], fit


@pytest.mark.slow
@pytest.mark.parametrize("asked", [{"by": "storage"}, {"by": "loss"}, {"by": "loss-tangent"}, {"weights": (1.0, 0.2)}])
def test_planted_factors_lie_within_their_errors(asked):
    found = np.array([scores(seed, **asked)[0] for seed in range(5)])
    assert np.mean(np.abs(found) < 1.96) > 0.85  # 95 % are expected; errors of one fit move together
    assert np.sqrt(np.mean(found**2)) < 1.5


def test_the_result_says_which_moduli_were_used():
    _, joint = scores(1)
    _, storage = scores(1, by="storage")
    _, weighted = scores(1, weights=[2.0, 1.0])
    assert (joint.shifted_by, storage.shifted_by, weighted.shifted_by) == ("both", "storage", "both")
    assert "shifted-by" not in codes(joint.notes)
    for one in (storage, weighted):
        assert "shifted-by" in codes(one.notes)
    assert storage.to_dataset().attrs["shifted_by"] == "storage"
    assert weighted.weights == pytest.approx((4.0 / 3.0, 2.0 / 3.0))  # their mean is 1
    assert np.max(np.abs(joint.shift_factors.log10_values - storage.shift_factors.log10_values)) > 1e-4


def test_equal_weights_are_the_default():
    plain, equal = scores(2)[1].shift_factors, scores(2, weights=(3.0, 3.0))[1].shift_factors
    np.testing.assert_array_equal(plain.log10_values, equal.log10_values)
    np.testing.assert_array_equal(plain.covariance, equal.covariance)


def test_a_loss_modulus_that_is_wrong_does_not_move_factors_from_storage_alone():
    sweeps = planted_sweeps(3, 0.01, **POLYMER).sweeps
    wrong = tuple(
        replace(one, loss_modulus=one.loss_modulus * (1.0 + 0.3 * np.sin(one.temperature))) for one in sweeps.isotherms
    )
    before = vf.superpose(sweeps, REFERENCE, by="storage").shift_factors
    after = vf.superpose(replace(sweeps, isotherms=wrong), REFERENCE, by="storage").shift_factors
    np.testing.assert_allclose(after.log10_values, before.log10_values, atol=1e-12)


@pytest.mark.parametrize("by", ["storage", "loss", "loss-tangent"])
def test_offsets_that_both_moduli_show_are_in_the_errors_of_one(by):
    planted = planted_sweeps(7, 0.005, **POLYMER, offset=0.02)
    factors = {way: vf.superpose(planted.sweeps, REFERENCE, by=way) for way in (by, "both")}
    found, joint = factors[by], factors["both"]
    assert found.offsets is not None
    assert joint.offsets is not None
    # Eleven isotherms determine a size to a quarter.
    assert found.offsets.standard_deviations * np.log(10.0) == pytest.approx([0.02, 0.02], rel=0.6)
    assert found.offsets.standard_deviations == pytest.approx(joint.offsets.standard_deviations, rel=0.03)
    # One modulus shows a shift less well than both, whose offsets partly cancel.
    errors, of_both = (np.median(one.shift_factors.standard_errors) for one in (found, joint))
    assert errors > 0.9 * of_both


@pytest.mark.parametrize(("family", "seed"), [("few modes", 41), ("power law", 0)])
def test_tan_delta_does_not_move_isotherms_apart_whose_storage_moduli_overlap(family, seed):
    """A common curve of tan δ, which has peaks, moved them apart by 3 and 6 decades."""
    planted = random_sweeps(seed, family)
    reference = float(np.median(planted.sweeps.temperatures))
    fit = vf.superpose(planted.sweeps, reference, by="loss-tangent")
    assert "joined-by-pairs" in codes(fit.notes)
    assert fit.quality.without_overlap == 0
    factors = fit.shift_factors
    away = np.abs(factors.log10_values - planted.log10_alpha(factors.temperatures, reference))
    assert np.all(away < 0.5)  # decades, what the joins of pairs are uncertain by
    assert np.all(away <= 2.5 * factors.standard_errors + 1e-9)  # of 14 factors, which move together


def test_tan_delta_is_free_of_vertical_shifts():
    b = DensityShift(REFERENCE).log10
    plain, shifted = scores(4, by="loss-tangent"), scores(4, b, by="loss-tangent")
    np.testing.assert_allclose(plain[1].shift_factors.log10_values, shifted[1].shift_factors.log10_values, atol=1e-9)


def test_samples_are_drawn_from_a_fit_to_one_modulus():
    _, fit = scores(5, by="loss")
    assert fit.offsets is not None
    samples = vf.sample_materials(fit, samples=20, seed=1)
    band = samples.modulus_band([1.0, 1e3])
    assert np.all(band.lower.real < band.upper.real)


@pytest.mark.parametrize(
    ("asked", "about"),
    [
        ({"by": "E"}, "by"),
        ({"by": "storage", "weights": (1.0, 1.0)}, "useless-weights"),
        ({"weights": (1.0, 0.0)}, "weights"),
        ({"weights": (1.0,)}, "weights"),
        ({"by": "loss-tangent", "vertical": "free"}, "no-vertical-in-tangent"),
        ({"by": "loss", "shift": vf.WLF(9.0, 110.0, "25 degC")}, "shift"),
    ],
)
def test_choices_without_meaning_are_refused(asked, about):
    with refused(about):
        scores(6, **asked)
