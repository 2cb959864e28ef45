"""The Payne effect: Kraus's law and linear range come back; a material at a strain meets the law."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.notes import codes
from viscofric.rheology.payne.kraus import on_strain
from viscofric.rheology.payne.kraus_fit import linear_range
from viscofric.rheology.ramps.common_law import EQUALLY_LIKELY, correlation

LAW = vf.rheology.KrausLaw(6e6, 2.5e6, 0.02, 0.6, 6e5, 4e5, 2.0 * np.pi * 10.0, 333.15, "shear")
STRAIN = np.geomspace(1e-4, 0.5, 25)


def planted(seed, noise=0.01):
    random = np.random.default_rng(seed)
    modulus = LAW.complex_modulus(STRAIN)
    scatter = 1.0 + noise * random.standard_normal((2, len(STRAIN)))
    return vf.readers.AmplitudeSweep(
        STRAIN, scatter[0] * modulus.real, scatter[1] * modulus.imag, "10 Hz", "60 degC", "shear"
    )


@pytest.mark.apart
def test_planted_constants_lie_within_their_errors():
    scores, ranges = [], []
    for seed in range(60):
        fit = vf.rheology.fit_kraus(planted(seed))
        scores.append((fit.law.constants - LAW.constants) / np.array(fit.law.standard_errors))
        ranges.append(fit.linear_ranges[1])
    # 60 seeds of six constants, of which some three are independent: known to 0.05.
    assert np.std(scores) == pytest.approx(1.0, abs=3 * 0.05)
    assert np.mean(np.abs(scores) < 1.96) == pytest.approx(0.95, abs=0.05)
    truth = 0.02 * (0.1 * 6.0 / (0.9 * 6.0 - 2.5)) ** (1.0 / 1.2)  # G' = 0.9 G'0
    inside = [abs(one.strain - truth) < 1.96 * one.standard_error for one in ranges]
    assert np.mean(inside) > 0.9


@pytest.mark.apart
def test_errors_of_few_amplitudes_hold():
    """Six amplitudes are twelve numbers for six constants and two scatters: intervals held 0.65 of γc, 0.72 of m."""
    strain, random = np.geomspace(1e-4, 0.5, 6), np.random.default_rng(1)
    moduli = LAW.complex_modulus(strain)
    within = []
    for _ in range(60):
        storage, loss = (part * (1.0 + 0.01 * random.standard_normal(6)) for part in (moduli.real, moduli.imag))
        law = vf.rheology.fit_kraus(vf.readers.AmplitudeSweep(strain, storage, loss, "10 Hz", "60 degC", "shear")).law
        errors = np.sqrt(np.diag(law.covariance)[2:4])
        within.append(np.abs(np.array([law.critical_strain - 0.02, law.exponent - 0.6])) < 1.96 * errors)
    assert np.all(np.mean(within, axis=0) > 0.84)  # 95 % of 60, less three standard deviations and some of the skewness


def test_errors_of_constants_include_the_correlation_of_neighbours():
    """As of a load that drifts along the sweep, four fifths from one amplitude to the next: intervals held 74 %."""
    random, within = np.random.default_rng(3), []
    for _ in range(12):
        errors = random.standard_normal((2, len(STRAIN)))
        for place in range(1, len(STRAIN)):
            errors[:, place] = 0.8 * errors[:, place - 1] + 0.6 * errors[:, place]
        moduli = LAW.complex_modulus(STRAIN)
        storage, loss = (
            part * (1.0 + 0.01 * one) for part, one in zip((moduli.real, moduli.imag), errors, strict=True)
        )
        law = vf.rheology.fit_kraus(vf.readers.AmplitudeSweep(STRAIN, storage, loss, "10 Hz", "60 degC", "shear")).law
        within.append(np.abs(law.constants - LAW.constants) < 1.96 * np.array(law.standard_errors))
    # 95 %, less two standard deviations of 12 sweeps of three independent constants each.
    assert np.mean(within) > 0.88


def test_the_correlation_of_neighbours_is_found_beside_a_fit():
    random = np.random.default_rng(4)
    errors = random.standard_normal((2, 300))
    for place in range(1, 300):
        errors[:, place] = 0.6 * errors[:, place - 1] + 0.8 * errors[:, place]
    design = np.broadcast_to(np.vander(np.linspace(-1.0, 1.0, 300), 4), (2, 300, 4))
    fitted = design[0] @ np.linalg.lstsq(design[0], errors.T, rcond=None)[0]
    # Known from 600 points to √((1 − ρ²)/n), 0.033; three of them.
    assert correlation(design, errors - fitted.T, EQUALLY_LIKELY) == pytest.approx(0.6, abs=0.1)


def test_errors_of_linear_ranges_hold_where_noise_is_as_large_as_the_fall():
    """Curves waver about 5 % before they fall: by the slope at the first crossing, intervals held 65 %."""
    strain = np.geomspace(1e-4, 0.5, 12)
    law = replace(LAW, storage_large=1.5e6)
    storage = law.complex_modulus(strain).real
    fine = np.geomspace(1e-4, 0.5, 20_001)
    truth = fine[np.argmax(law.complex_modulus(fine).real < 0.95 * storage[0])]
    random = np.random.default_rng(3)
    held = []
    for _ in range(60):
        noisy = storage * (1.0 + 0.05 * random.standard_normal(12))
        sweep = vf.readers.AmplitudeSweep(strain, noisy, 0.1 * storage, "10 Hz", "60 degC", "shear")
        found = linear_range(sweep, 0.05)
        held.append(abs(found.strain - truth) < 1.96 * found.standard_error)
    assert np.mean(held) > 0.86  # 0.95 less three standard deviations of 60


@pytest.mark.parametrize(("points", "noise", "drop", "largest"), [(25, 0.002, 0.05, 0.06), (12, 0.01, 0.1, 0.2)])
def test_linear_ranges_of_clean_sweeps_are_as_sharp_as_their_points(points, noise, drop, largest):
    """A curve of too few knots was off by a quarter of the strain, and its errors were up to nine times these."""
    strain, fine = np.geomspace(1e-4, 0.5, points), np.geomspace(1e-4, 0.5, 20_001)
    modulus, course = LAW.complex_modulus(strain), LAW.complex_modulus(fine).real
    truth = fine[np.argmax(course < (1.0 - drop) * course[0])]
    off, errors = [], []
    for seed in range(60):
        noisy = modulus.real * (1.0 + noise * np.random.default_rng(seed).standard_normal(points))
        sweep = vf.readers.AmplitudeSweep(strain, noisy, modulus.imag, "10 Hz", "60 degC", "shear")
        found = linear_range(sweep, drop)
        off.append(found.strain - truth)
        errors.append(found.standard_error)
    assert np.median(errors) < largest * truth
    assert np.mean(np.abs(off) < 1.96 * np.array(errors)) > 0.86  # 0.95 less three standard deviations of 60


def test_a_sweep_that_stays_linear_has_no_end_of_its_range():
    flat = vf.readers.AmplitudeSweep(STRAIN, np.full(25, 1e6), np.full(25, 1e5), "1 Hz", "25 degC")
    assert np.isinf(linear_range(flat, 0.05).strain)
    (note,) = [one for one in vf.rheology.fit_kraus(flat).notes if one.code == "hardly-nonlinear"]
    assert note.values == {"fall": 0.0}


def test_a_sweep_that_starts_beyond_the_linear_range_is_noted():
    """From 0.3 % on, G' of a law that has fallen by 4 % there reaches its next 5 % at twice the strain of the first."""
    sweep = planted(0)
    late = vf.readers.AmplitudeSweep(
        STRAIN[10:], sweep.storage_modulus[10:], sweep.loss_modulus[10:], "10 Hz", "60 degC", "shear"
    )
    truth = 0.02 * (0.05 * 6.0 / (0.95 * 6.0 - 2.5)) ** (1.0 / 1.2)  # G' = 0.95 G'0
    fit = vf.rheology.fit_kraus(late)
    one = fit.linear_ranges[0]
    assert one.strain - truth > 5.0 * one.standard_error  # which no error holds
    (note,) = fit.notes
    assert note.code == "starts-nonlinear"
    fallen = 1.0 - LAW.complex_modulus(STRAIN[10]).real / LAW.storage_linear
    assert note.values["fall"] == pytest.approx(fallen, abs=0.01)  # noise of 1 %
    assert vf.rheology.fit_kraus(sweep).notes == ()


@pytest.mark.parametrize("seed", [4, 7])
def test_a_sweep_that_ends_before_the_second_plateau_does_not_determine_it(seed):
    """Where the best G'∞ is near zero, it had an error of 0.006 Pa, and γc was off by up to four of its errors."""
    law, strain = replace(LAW, storage_large=1e6), np.geomspace(1e-4, 0.01, 25)
    scatter, moduli = 1.0 + 0.01 * np.random.default_rng(seed).standard_normal((2, 25)), law.complex_modulus(strain)
    sweep = vf.readers.AmplitudeSweep(
        strain, scatter[0] * moduli.real, scatter[1] * moduli.imag, "10 Hz", "60 degC", "shear"
    )
    fit = vf.rheology.fit_kraus(sweep)
    assert fit.law.storage_large < 1e3
    assert fit.law.standard_errors[1] > 1e6
    assert np.all(np.abs(fit.law.constants - law.constants) < 2.0 * np.array(fit.law.standard_errors))
    assert "constants-undetermined" in codes(fit.notes)


def test_a_law_that_misses_the_sweep_is_named():
    sweep = planted(1)
    bent = replace(sweep, loss_modulus=sweep.loss_modulus * (1.0 + 0.5 * np.sin(np.arange(25.0))))
    notes = [one for one in vf.rheology.fit_kraus(bent).notes if one.code == "kraus-misfit"]
    (note,) = [one for one in notes if one.values["modulus"] == "G''"]
    assert note.values["scatter"] > 0.05  # decades, of a wave of 50 %


def test_a_loss_modulus_that_is_larger_at_small_amplitudes_is_named():
    """By a third, as of many compounds: the law misses it by a hundredth of a decade, five times the noise."""
    sweep = planted(2, noise=0.003)
    more = replace(sweep, loss_modulus=sweep.loss_modulus + 1.5e5 * np.exp(-STRAIN / 0.005))
    notes = [one for one in vf.rheology.fit_kraus(more).notes if one.code == "kraus-misfit"]
    (note,) = [one for one in notes if one.values["modulus"] == "G''"]
    assert note.values["scatter"] < 0.03
    assert note.values["smooth"] < note.values["scatter"] / 5.0
    assert vf.rheology.fit_kraus(sweep).notes == ()


@pytest.mark.parametrize("strain", [0.005, 0.05, 0.2])
def test_a_material_at_a_strain_meets_the_law_where_it_was_measured(strain):
    rubber = vf.synthetic_fluoroelastomer()
    scaled = vf.rheology.material_at_strain(rubber, LAW, strain, measured_at=0.001)
    before, after = (one.complex_modulus(LAW.angular_frequency, LAW.temperature) for one in (rubber, scaled))
    first, last = LAW.complex_modulus(np.sqrt(3.0) * np.array([0.001, strain]))
    assert after.real / before.real == pytest.approx(last.real / first.real, rel=1e-9)
    assert after.imag / before.imag == pytest.approx(last.imag / first.imag, rel=1e-9)
    assert "strain" in scaled.name
    assert codes(on_strain(LAW, strain)) == {"scaled-to-strain"}


def test_the_glass_keeps_its_modulus_at_any_strain():
    # at 2 % E' falls to half and E'' rises fourfold; the glass is a thousand times stiffer than the filler network
    loud = vf.rheology.KrausLaw(6e6, 1.5e6, 0.02, 0.6, 9e5, 2e5, 2.0 * np.pi * 10.0, 333.15, "shear")
    rubber = vf.synthetic_fluoroelastomer()
    scaled = vf.rheology.material_at_strain(rubber, loud, 0.02)
    assert scaled.spectrum.E_inf == pytest.approx(rubber.spectrum.E_inf, rel=0.02)


def test_at_the_strain_of_the_sweeps_nothing_changes():
    rubber = vf.synthetic_fluoroelastomer()
    same = vf.rheology.material_at_strain(rubber, LAW, 0.001, measured_at=0.001)
    omega = np.geomspace(1e-2, 1e8, 20)
    np.testing.assert_allclose(same.spectrum.complex_modulus(omega), rubber.spectrum.complex_modulus(omega), rtol=1e-6)


def test_the_strain_of_a_ball_is_a_fifth_of_its_slope():
    assert vf.rheology.contact_strain(1.5e-3 / 9.525e-3) == pytest.approx(0.2 * 1.5 / 9.525)


@pytest.mark.slow
def test_a_contact_at_its_own_strain_is_softer():
    ball, rubber = vf.Ball("9.525 mm"), vf.synthetic_fluoroelastomer()
    found = vf.friction.solve_at_contact_strain(
        rubber, LAW, ball, speed="20 mm/s", load="5 N", temperature="60 degC", accuracy=0.03
    )
    assert found.scaled.contact_area > found.linear.contact_area
    edge = 0.5 * (found.scaled.front + found.scaled.rear) / 9.525e-3
    assert found.strain == pytest.approx(0.2 * edge, rel=0.03)
    assert found.scaled.friction_coefficient > found.linear.friction_coefficient  # tan δ rises with the amplitude
    assert "scaled-to-strain" in codes(found.notes)


def test_wrong_arguments_are_refused():
    rubber = vf.synthetic_fluoroelastomer()
    with refused("too-few-points"):
        vf.rheology.fit_kraus(vf.readers.AmplitudeSweep(STRAIN[:4], STRAIN[:4], STRAIN[:4], "1 Hz", "25 degC"))
    with refused("strain"):
        vf.rheology.material_at_strain(rubber, LAW, 50.0)
    with refused("no-relaxed-modulus"):
        vf.rheology.material_at_strain(rubber, replace(LAW, loss_peak=6e8), 0.02)
    with refused("slope"):
        vf.rheology.contact_strain(-1.0)
