"""Superposition: planted shifts come back within their stated errors; what cannot be joined is refused."""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viscofric as vf
from viscofric.data import Isotherm, IsothermalSweeps
from viscofric.errors import InputError, SuperpositionError

RUBBER = vf.synthetic_fluoroelastomer()
EXAMPLE = Path(vf.__file__).parent / "example" / "dma.csv"


def measured(celsius, noise=0.0, seed=0, points=17, deformation="tension", factor=1.0, rate=1.0):
    """Sweep the synthetic rubber over 0.1 to 10 Hz at some temperatures."""
    random = np.random.default_rng(seed)
    omega = 2 * np.pi * np.logspace(-1, 1, points)
    isotherms = []
    for temperature in celsius:
        modulus = factor * RUBBER.complex_modulus(omega, temperature + 273.15)
        scatter = 1 + noise * random.standard_normal((2, points))
        isotherms.append(
            Isotherm(temperature + 273.15, rate * omega, scatter[0] * modulus.real, scatter[1] * modulus.imag)
        )
    return IsothermalSweeps(tuple(isotherms), deformation)


WARM = np.arange(0.0, 221.0, 10.0)


def planted(fit):
    return RUBBER.shift.at_reference(fit.shift_factors.reference).log10(fit.shift_factors.temperatures)


def test_noise_free_sweeps_give_the_planted_shift_factors_and_modulus():
    fit = vf.superpose(measured(WARM), "30 degC")
    # Cubic splines with 0.4 decade between knots follow these spectra to about 1e-4 decades in the modulus.
    assert fit.shift_factors.log10_values == pytest.approx(planted(fit), abs=2e-3)
    truth = RUBBER.complex_modulus(fit.master_curve.angular_frequency, "30 degC")
    assert fit.master_curve.complex_modulus == pytest.approx(truth, rel=2e-3)
    law = fit.shift_factors.law("wlf")
    assert pytest.approx((9.03534, 99.6), rel=1e-3) == (law.C1, law.C2)


def test_planted_shift_factors_lie_within_their_standard_errors():
    scores = []
    for seed in range(25):
        fit = vf.superpose(measured(WARM, noise=0.01, seed=seed), "30 degC")
        away = fit.shift_factors.log10_values - planted(fit)
        free = fit.shift_factors.standard_errors > 1e-6
        assert np.sum(~free) == 1  # the reference itself
        scores.append(away[free] / fit.shift_factors.standard_errors[free])
    inside = np.mean(np.abs(scores) < 1.96)
    # 95 % is promised.  Errors within one fit are strongly correlated, so 25 fits are some 75 independent
    # values, of which 95 ± 2.5 % (one sigma) fall inside; three sigma allowed.
    assert 0.87 < inside <= 1.0
    assert np.std(scores) == pytest.approx(1.0, abs=0.25)


def test_the_example_file_gives_back_the_rubber_it_was_made_of():
    fit = vf.superpose(vf.read_dma(EXAMPLE), "30 degC")
    away = fit.shift_factors.log10_values - planted(fit)
    # 23 values at one seed: four standard errors are not exceeded by chance.
    assert np.all(np.abs(away) <= 4 * fit.shift_factors.standard_errors + 1e-9)
    law = fit.shift_factors.law("wlf")
    first, second = law.standard_errors
    assert abs(law.C1 - 9.03534) < 3 * first
    assert abs(law.C2 - 99.6) < 3 * second
    spectrum = vf.fit_retardation_spectrum(fit.master_curve)
    inside = np.logspace(-5, 5, 60)
    error = spectrum.complex_modulus(inside) / RUBBER.complex_modulus(inside, "30 degC") - 1
    assert np.abs(error).max() < 0.02  # 1 % noise, and shifts uncertain by 0.01 decades
    assert not spectrum.fit.E0_extrapolated
    assert spectrum.fit.E_inf_extrapolated  # the glassy isotherms do not overlap


@pytest.mark.parametrize("reference", [283.15, 300.0, 351.234, 493.15])
def test_the_reference_may_lie_between_isotherms(reference):
    fit = vf.superpose(measured(WARM), reference)
    assert fit.shift_factors(reference) == pytest.approx(1.0, abs=1e-12)
    assert fit.master_curve.reference == reference
    # Interpolated over 10 K steps in 1/T: the curvature of this law leaves 0.01 decades at the cold end.
    assert fit.shift_factors.log10_values == pytest.approx(planted(fit), abs=0.02)


@settings(max_examples=8, deadline=None)
@given(rate=st.floats(-6, 6), factor=st.floats(-9, 9), order=st.permutations(range(8)))
def test_units_and_order_do_not_matter(rate, factor, order):
    celsius = WARM[:8]
    plain = vf.superpose(measured(celsius, noise=0.01), "30 degC")
    changed = measured(celsius, noise=0.01, factor=10.0**factor, rate=10.0**rate)
    shuffled = IsothermalSweeps(tuple(changed.isotherms[place] for place in order))
    other = vf.superpose(shuffled, "30 degC")
    # Both stop when steps fall below 1e-4 decades; standard errors are about 0.01.
    assert other.shift_factors.log10_values == pytest.approx(plain.shift_factors.log10_values, abs=1e-3)
    assert other.shift_factors.standard_errors == pytest.approx(plain.shift_factors.standard_errors, rel=0.05, abs=1e-6)
    assert other.quality.joint == pytest.approx(plain.quality.joint, rel=0.05)


def test_shear_moduli_become_tensile():
    tension = vf.superpose(measured(WARM[:6]), "30 degC")
    shear = vf.superpose(measured(WARM[:6], deformation="shear", factor=1 / 3), "30 degC")
    assert shear.master_curve.storage_modulus == pytest.approx(tension.master_curve.storage_modulus, rel=1e-9)
    assert any("E = 2(1+ν)G" in note for note in shear.notes)
    softer = vf.superpose(measured(WARM[:6], deformation="shear"), "30 degC", poisson_ratio=0.0)
    ratio = softer.master_curve.storage_modulus / tension.master_curve.storage_modulus
    assert ratio == pytest.approx(2.0, rel=1e-9)


def test_a_plateau_is_given_a_large_standard_error_and_does_not_run_away():
    omega = 2 * np.pi * np.logspace(-1, 1, 17)
    random = np.random.default_rng(3)
    flat = [
        Isotherm(
            celsius + 273.15,
            omega,
            3e6 * (1 + 0.003 * random.standard_normal(17)),
            3e4 * (1 + 0.1 * random.standard_normal(17)),
        )
        for celsius in (230.0, 240.0, 250.0)
    ]
    steep = measured(WARM, noise=0.003).isotherms
    fit = vf.superpose(IsothermalSweeps(steep[:8]), "30 degC")
    plateau = vf.superpose(IsothermalSweeps(tuple(flat)), "240 degC")
    assert np.all(np.abs(plateau.shift_factors.log10_values) < 3.0)  # the width of the prior
    assert plateau.shift_factors.standard_errors.max() > 0.1
    assert plateau.shift_factors.standard_errors.max() > 10 * np.median(fit.shift_factors.standard_errors)


def test_sweeps_that_do_not_overlap_are_refused_with_both_temperatures():
    for celsius in ([0.0, 60.0], [0.0, 10.0, 20.0, 80.0, 90.0, 100.0]):
        sweeps = measured(celsius)
        with pytest.raises(SuperpositionError, match="do not overlap") as caught:
            vf.superpose(sweeps, celsius[0] + 273.15)
        below, above = (0.0, 60.0) if len(celsius) == 2 else (20.0, 80.0)
        assert f"{below:.1f} °C" in str(caught.value)
        assert f"{above:.1f} °C" in str(caught.value)


def test_single_isotherms_beyond_the_ends_are_left_out_with_a_note():
    fit = vf.superpose(measured([-20.0, -10.0, *WARM]), "30 degC")
    assert fit.shift_factors.temperatures[0] == pytest.approx(273.15)
    assert sum("left out" in note for note in fit.notes) == 2
    with pytest.raises(InputError, match="outside the joined isotherms"):
        vf.superpose(measured([-20.0, -10.0, *WARM]), "-15 degC")


def test_too_little_to_superpose_is_refused():
    with pytest.raises(SuperpositionError, match="1 isotherm cannot"):
        vf.superpose(measured([20.0]), "20 degC")
    with pytest.raises(SuperpositionError, match="only one usable frequency"):
        vf.superpose(measured([20.0, 30.0], points=1), "20 degC")
    with pytest.raises(InputError, match="poisson_ratio"):
        vf.superpose(measured(WARM[:3]), "10 degC", poisson_ratio=0.6)


def test_acrylic_overlaps_as_well_as_with_the_best_peer(real_data):
    sweeps = vf.read_dma(real_data / "dma" / "acrylic_468mp.csv", deformation="shear")
    vf.superpose(sweeps, "20 degC")
    start = time.perf_counter()
    fit = vf.superpose(sweeps, "20 degC")
    elapsed = time.perf_counter() - start
    assert fit.quality.joint <= 0.0080  # best peer .0079, measured the same way
    law = fit.shift_factors.law("wlf")
    assert pytest.approx((9.05, 128.5), rel=0.03) == (
        law.C1,
        law.C2,
    )  # peers differ by 1 %; weighting by as much
    assert any("-40.0 °C and -30.0 °C disagree" in note for note in fit.notes)
    assert elapsed < 1.0  # about 0.03 s; a loaded machine may be slow


@pytest.mark.parametrize("name", ["adhesive_ems_ca", "eva_shear", "vinyl_nitrile_foam"])
def test_real_rubbers_are_joined_over_all_their_temperatures(real_data, name):
    sweeps = vf.read_dma(real_data / "dma" / f"{name}.csv", deformation="tension")
    fit = vf.superpose(sweeps, "20 degC")
    assert len(fit.shift_factors.temperatures) == len(sweeps)
    assert np.all(np.isfinite(fit.shift_factors.standard_errors))
    # α falls as temperature rises, within the errors (the adhesive's plateau tells nothing).
    rise = np.diff(fit.shift_factors.log10_values)
    errors = np.hypot(fit.shift_factors.standard_errors[1:], fit.shift_factors.standard_errors[:-1])
    assert np.all(rise < 3 * errors)
    assert vf.fit_retardation_spectrum(fit.master_curve).fit.rms_loss < 0.06
