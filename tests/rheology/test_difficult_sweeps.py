"""Sweeps that do not superpose well, synthetic and real: nothing is claimed of them that was not measured."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from rheology.planted import EXAMPLE_PROGRAMME, planted_sweeps, random_rubber, synthetic_soft_rubber
from viscofric.data import Isotherm, IsothermalSweeps, MasterCurve
from viscofric.notes import codes, note_of
from viscofric.rheology.shifts.law_comparison import course_notes
from viscofric.rheology.shifts.laws import WLF
from viscofric.rheology.spectra.misfit import STIFFEST
from viscofric.rheology.spectra.spectrum_fit import fit_retardation_spectrum
from viscofric.rheology.superposition.overlap import LogSweep, overlap_quality, parted
from viscofric.rheology.uncertainty.material_samples import systematic_misfit
from viscofric.rheology.uncertainty.sampling import sample_materials

#: File, how it was deformed, and a reference in its midst.
REAL = {
    "acrylic": ("dma/acrylic_468mp.csv", "shear", "20 degC"),
    "adhesive": ("dma/adhesive_ems_ca.csv", "tension", "20 degC"),
    "eva": ("dma/eva_shear.csv", "shear", "30 degC"),
    "foam": ("dma/vinyl_nitrile_foam.csv", "tension", "20 degC"),
    "glass": ("instruments/eplexor/freq_Eplexor_raw.xls", "tension", "60 degC"),
    "same glass": ("instruments/two_row_csv/freq_user_raw.csv", "tension", "60 degC"),
}


def superposed(real_data, name, **settings):
    path, deformation, reference = REAL[name]
    return vf.superpose(vf.read_dma(real_data / path, deformation=deformation), reference, **settings)


def sweep(first, last, low, high):
    """Straight lines in log–log from E' of 10^low to 10^high."""
    frequency = np.linspace(first, last, 16)
    storage = np.linspace(low, high, 16)
    return LogSweep(frequency, np.stack([storage, storage - 1.0], axis=1))


def test_neighbours_moved_apart_are_found():
    colder, warmer = sweep(0.0, 3.0, 9.0, 9.2), sweep(0.0, 3.0, 8.9, 9.1)
    assert parted([colder, warmer], np.array([1.5, 0.0])) == []  # where they belong
    assert parted([colder, warmer], np.array([3.1, 0.0])) == [0]
    assert parted([colder, warmer], np.array([2.8, 0.0])) == [0]  # a fifteenth of them overlaps
    assert parted([colder, warmer], np.array([-3.1, 0.0])) == [0]  # a gap between them


@pytest.mark.parametrize("seed", [22, 61])
def test_isotherms_that_overlap_little_are_not_moved_apart(seed):
    """A common curve moved them apart by 1.7 and 3.1 decades, with errors of 0.2, and the check found nothing wrong."""
    places = 1.5 * (np.arange(8) - 3.5)  # log10 α of the WLF law of random rubbers; sweeps of two decades
    planted = planted_sweeps(
        seed,
        0.03,
        material=random_rubber("few modes", np.random.default_rng(seed)),
        celsius=np.sort(20.0 - 130.0 * places / (places + 8.0)),
        frequencies=np.logspace(-1.0, 1.0, 9) / (2.0 * np.pi),
    )
    reference = float(planted.sweeps.temperatures[4])
    fit = vf.superpose(planted.sweeps, reference)
    assert fit.quality.without_overlap == 0
    factors = fit.shift_factors
    away = np.abs(factors.log10_values - planted.log10_alpha(factors.temperatures, reference))
    assert np.all(away < 0.5)  # decades, what the join of a pair is uncertain by
    assert np.all(away <= 3.0 * factors.standard_errors + 1e-9)


def test_neighbours_without_overlap_are_counted():
    sweeps = [sweep(0.0, 1.0, 9.0, 9.1), sweep(0.0, 1.0, 8.9, 9.0), sweep(0.0, 1.0, 8.8, 8.9)]
    quality = overlap_quality(sweeps, np.array([2.5, 1.0, 0.5]))
    assert (quality.neighbours, quality.without_overlap, quality.gaps) == (2, 1, (0,))


def test_gaps_between_neighbours_are_reported():
    # Steps at −30 and −20 °C exceed the two decades of a sweep: what the true law gives does not overlap.
    made = planted_sweeps(0, celsius=EXAMPLE_PROGRAMME)
    fit = vf.superpose(made.sweeps, "30 degC", shift=made.material.shift)
    assert 0 in fit.quality.gaps
    assert fit.notes[-1].code == "no-overlap"
    assert f"{fit.quality.without_overlap} of 25" in fit.notes[-1]
    whole = vf.superpose(planted_sweeps(0).sweeps, "30 degC")
    assert len(fit.check.sentences) > len(whole.check.sentences)
    assert whole.quality.gaps == ()
    assert "no-overlap" not in codes(whole.notes)


def test_frequencies_between_isotherms_far_apart_were_not_measured():
    # 0.1 to 10 Hz at each; from 30 to 90 °C log10 α falls by 3.4.
    def joined(*celsius):
        made = planted_sweeps(0, celsius=celsius)
        fit = vf.superpose(made.sweeps, "30 degC", shift=made.material.shift)
        spectrum = vf.fit_retardation_spectrum(fit.master_curve)
        return fit, spectrum, vf.Material(spectrum, shift=made.material.shift)

    fit, spectrum, material = joined(30.0, 90.0)
    ((first, last),) = spectrum.fit.gaps
    np.testing.assert_array_equal(spectrum.fit.to_dataset()["gaps"], [[first, last]])
    omega = fit.master_curve.angular_frequency
    assert not np.any((omega > first) & (omega < last))
    inside, beside = np.sqrt(first * last), (first, last)
    assert not spectrum.fit.covers(inside)
    assert np.all(spectrum.fit.covers(beside))
    samples = vf.sample_materials(fit, spectrum, samples=20)
    assert samples.to_dataset([inside, *beside]).within_measured_frequencies.values.tolist() == [0.0, 1.0, 1.0]
    (note,) = samples.modulus_band([inside, *beside]).notes
    assert (note.code, note.values["points"]) == ("beyond-measured", 1)
    # A contact of half-length a sees v/a.
    contact = vf.solve_steady(material, vf.Ball("10 mm"), speed=1e-3 * inside, load="1 N", accuracy=0.1)
    assert "beyond-measured" in codes(contact.warnings)
    assert joined(30.0, 60.0, 90.0)[1].fit.gaps == ()


@pytest.mark.slow
@pytest.mark.parametrize("name", ["glass", "same glass"])
def test_a_resonance_in_the_glass_does_not_tear_isotherms_apart(real_data, name):
    fit = superposed(real_data, name)
    assert fit.quality.without_overlap == 0
    # Pair by pair, the steps from −50 to 60 °C add up to 12.6 decades; torn apart they were 26.
    assert 10.0 < fit.shift_factors.log10_values[0] < 15.0
    frequency = np.log10(fit.master_curve.angular_frequency)
    assert np.diff(frequency).max() < 1.0
    assert "joined-by-pairs" in codes(fit.notes)
    # Five steps of half a decade each, which is what the cold end is uncertain by at least.
    assert fit.shift_factors.standard_errors[0] > np.sqrt(5.0) * 0.5


def ending_in_the_transition():
    """Return a curve whose loss still rises at its end, faster than modes within it allow: no glass in sight."""
    omega = np.logspace(-3, 3, 120)
    modulus = 1e6 * (1.0 + (1j * omega) ** 0.95)
    return MasterCurve(omega, modulus.real, modulus.imag, np.full(120, 303.15), 303.15)


@pytest.mark.parametrize("method", ["non-negative", pytest.param("regularised", marks=pytest.mark.slow), "sparse"])
def test_a_glass_that_nothing_shows_is_no_result(method):
    master = ending_in_the_transition()
    settings = {"modes": 8} if method == "sparse" else {}
    spectrum = fit_retardation_spectrum(master, method=method, **settings)
    limit = STIFFEST * master.storage_modulus.max()
    assert spectrum.E_inf == pytest.approx(limit, rel=1e-6)
    assert spectrum.fit.E_inf_at_limit
    assert spectrum.fit.E_inf_extrapolated
    assert "glass-doubtful" in codes(spectrum.fit.notes)


def test_a_glass_that_was_measured_is_a_result():
    fit = vf.superpose(planted_sweeps(0, 0.003).sweeps, "30 degC")
    spectrum = fit_retardation_spectrum(fit)
    assert not spectrum.fit.E_inf_at_limit
    assert (spectrum.fit.E0_missed, spectrum.fit.E0_extrapolated) == (False, False)
    low, high = spectrum.fit.measured_storage
    assert (low, high) == (fit.master_curve.storage_modulus.min(), fit.master_curve.storage_modulus.max())


@pytest.mark.parametrize("name", ["acrylic", "foam", "eva"])
def test_words_about_plateaus_are_true(real_data, name):
    master = superposed(real_data, name).master_curve
    spectrum = fit_retardation_spectrum(master)
    quality = spectrum.fit
    softest, stiffest = master.storage_modulus.min(), master.storage_modulus.max()
    assert spectrum.E_inf <= STIFFEST * stiffest * (1.0 + 1e-9)
    if name == "eva":
        assert softest < spectrum.E0
        assert quality.E0_missed
        assert quality.measured_storage[0] == softest == pytest.approx(2.838e6, rel=1e-3)
        assert quality.E_inf_extrapolated
    else:
        assert spectrum.E_inf < stiffest
        assert quality.E_inf_missed
        assert quality.measured_storage[1] == stiffest
        assert "glass-extrapolated" not in codes(quality.notes)


def test_what_neighbours_miss_alike_is_distinguished_from_noise():
    random = np.random.default_rng(3)
    isotherm = np.repeat(np.arange(10), 20)
    frequency = np.concatenate([np.linspace(0.5 * place, 0.5 * place + 2.0, 20) for place in range(10)])
    noise = 0.01 * random.standard_normal((200, 2))
    assert systematic_misfit(frequency, noise, isotherm).size.max() < 0.005
    bias = np.where(isotherm % 2 == 0, 0.05, -0.05)[:, None] * np.array([1.0, 0.0])
    found = systematic_misfit(frequency, noise + bias, isotherm)
    assert found.size[:, 0] == pytest.approx(0.05, rel=0.2)  # noise in means of five: 0.0045
    assert found.size[:, 1].max() < 0.005
    (note,) = found.notes
    assert note.values["modulus"] == "E'"
    assert note.values["decades"] == found.size[:, 0].max()


@pytest.mark.apart
def test_a_band_holds_the_measurement_where_superposition_fails():
    made = planted_sweeps(0, 0.003)
    # Every other sweep 20 % stiffer, as a sample clamped anew each time may be.
    uneven = IsothermalSweeps(
        tuple(
            Isotherm(one.temperature, one.angular_frequency, one.storage_modulus * by, one.loss_modulus * by)
            for one, by in zip(made.sweeps.isotherms, [1.0, 1.2] * 13, strict=True)
        )
    )
    fit = vf.superpose(uneven, "30 degC", shift=made.material.shift)
    samples = sample_materials(fit, samples=60)
    assert len(samples.notes) == 1
    assert share_inside(fit.master_curve, samples) > 0.9
    sound = sample_materials(vf.superpose(made.sweeps, "30 degC"), samples=20)
    assert sound.notes == ()


def share_inside(master, samples):
    band, measured = samples.modulus_band(master.angular_frequency), master.storage_modulus
    return float(np.mean((measured >= band.lower.real) & (measured <= band.upper.real)))


@pytest.mark.slow
def test_the_band_of_a_melting_eva_holds_what_was_measured(real_data):
    fit = superposed(real_data, "eva")
    samples = sample_materials(fit, samples=40)
    assert share_inside(fit.master_curve, samples) > 0.93  # half of the points without the misfit
    (note,) = samples.notes
    assert (note.code, note.values["cause"]) == ("fit-misses-data", "isotherms do not superpose")


@pytest.mark.slow
def test_superposition_may_hold_roughly(real_data):
    rough, failed = superposed(real_data, "adhesive").check, superposed(real_data, "eva").check
    assert rough.roughly
    assert not rough.holds
    assert rough.sentences[0].code == "superposition-roughly"
    assert not failed.roughly
    assert failed.sentences[0].code == "superposition-fails"


@pytest.mark.slow
def test_a_nominal_temperature_stands_for_a_measured_one(real_data):
    vendor = vf.read_shift_factors(real_data / "dma" / "adhesive_ems_ca__vendor_shift.csv")
    fit = superposed(real_data, "adhesive", shift=vendor)
    assert len(fit.isotherms) == 21
    eva = vf.read_dma(real_data / "dma" / "eva_shear.csv", deformation="shear")
    assert 0.0 < 333.15 - eva.isotherms[-1].temperature < 0.5
    assert vf.superpose(eva, "60 degC").shift_factors.log10("60 degC") == pytest.approx(0.0, abs=1e-9)


def test_a_law_too_close_to_its_pole_moves_no_sweep():
    sweeps = planted_sweeps(0).sweeps
    with refused("out-of-range", naming=("−20.0 °C", "30.0 °C")):
        vf.superpose(sweeps, "30 degC", shift=vf.WLF(20.0, 51.0, "30 degC"))


def test_what_is_no_measurement_is_named():
    with refused("wrong-type", naming="sweeps"):
        vf.superpose("sweeps.csv", "30 degC")
    with refused("wrong-type"):
        fit_retardation_spectrum([1.0, 2.0])
    fit = vf.superpose(planted_sweeps(0).sweeps, "30 degC")
    assert fit_retardation_spectrum(fit).E0 == fit_retardation_spectrum(fit.master_curve).E0


@pytest.mark.slow
def test_every_result_is_shown_in_a_few_lines():
    fit = vf.superpose(planted_sweeps(0).sweeps, "30 degC", vertical="free")
    spectrum = fit_retardation_spectrum(fit)
    samples = sample_materials(fit, spectrum, samples=20)
    table = vf.rheology.ModulusTable.from_master_curve(fit.master_curve)
    shown = [
        repr(one)
        for one in (
            fit,
            fit.check,
            fit.check.kramers_kronig,
            fit.shift_factors,
            fit.vertical_shift,
            spectrum,
            spectrum.to_relaxation(),
            samples,
            samples.misfit,
            table,
        )
    ]
    assert all("array" not in text and len(text) < 400 for text in shown), shown
    assert shown[0].startswith("Superposition\n  isotherms       26\n  temperature     26 from −20 to 200 °C")


@pytest.mark.parametrize("count", [6, 8, 12])
def test_factors_of_wlf_near_its_pole_have_no_note(count: int) -> None:
    """Polynomials in 1/T do not follow it over 90 K: exact factors were said to scatter."""
    kelvin = 273.15 + np.linspace(-10.0, 80.0, count)
    values = np.asarray(WLF(8.86, 101.6, 323.15).at_reference(float(kelvin[0])).log10(kelvin))
    errors = 1e-4 * np.minimum.outer(np.arange(count), np.arange(count))  # 0.01 decades a step
    assert course_notes(kelvin, values, errors) == ()


@pytest.mark.parametrize(("off", "code"), [(0.0, None), (3.0, "temperature-off"), (-5.0, "temperature-off")])
def test_a_wrong_temperature_of_one_isotherm_is_named(off: float, code: str | None) -> None:
    """α at 40 °C had an error of 0.005 decades while 3 K move it by 0.2: nothing said so."""
    celsius = np.arange(-10.0, 81.0, 10.0)
    for seed in range(3):
        true = planted_sweeps(seed, material=synthetic_soft_rubber(), celsius=celsius + off * (celsius == 40.0)).sweeps
        labelled = [replace(one, temperature=at + 273.15) for one, at in zip(true.isotherms, celsius, strict=True)]
        fit = vf.superpose(replace(true, isotherms=tuple(labelled)), "30 degC")
        noted = [one for one in map(note_of, fit.notes) if one.code in ("temperature-off", "factors-scatter")]
        assert [one.code for one in noted] == ([] if code is None else [code])
        for one in noted:
            assert one.values["temperature"] == pytest.approx(313.15)
            # An error of 0.005 decades, at a slope of 0.06 decades per kelvin, and that of the course of the others.
            assert one.values["kelvin"] == pytest.approx(off, abs=0.3)


def test_the_scatter_of_factors_is_that_of_the_well_known_ones() -> None:
    """A factor known to a decade only was counted as the others: one off by 1.6 made 0.46 decades of 0.1."""
    kelvin, found = 273.15 + np.arange(0.0, 130.0, 10.0), []
    for seed in range(8):
        scatter = 0.1 * np.random.default_rng(seed).standard_normal(len(kelvin))
        values = np.asarray(WLF(8.86, 101.6, 323.15).log10(kelvin)) + scatter
        values[-1] += 1.6
        found += course_notes(kelvin, values, np.diag([*np.full(len(kelvin) - 1, 0.01), 1.2]) ** 2)
    assert codes(found) == {"factors-scatter"}
    # A course takes up to half of thirteen values; a scatter of six is known to a third, the median of eight to less.
    assert np.median([note.values["decades"] for note in found]) == pytest.approx(0.1, rel=0.3)


def test_errors_of_all_temperatures_are_noted() -> None:
    """Errors of 0.5 K: 95 % intervals of α held a third, without a word."""
    celsius, found = np.arange(-10.0, 81.0, 10.0), []
    for seed in range(4):
        wrong = 0.5 * np.random.default_rng([seed, 2]).standard_normal(len(celsius))
        true = planted_sweeps(seed, material=synthetic_soft_rubber(), celsius=celsius + wrong).sweeps
        labelled = [replace(one, temperature=at + 273.15) for one, at in zip(true.isotherms, celsius, strict=True)]
        fit = vf.superpose(replace(true, isotherms=tuple(labelled)), "30 degC")
        found += [one for one in map(note_of, fit.notes) if one.code in ("temperature-off", "factors-scatter")]
    assert len(found) >= 3
    kelvin = [one.values["kelvin"] for one in found if one.code == "factors-scatter"]
    # Each from some six degrees of freedom, and slopes change by a factor of two over the temperatures.
    assert np.median(kelvin) == pytest.approx(0.5, rel=0.6)


def test_points_far_off_make_errors_large_and_no_refusal():
    """A fifth of all points is too large or too small by a factor of three, in E' and in E''."""
    planted = planted_sweeps(4, 0.05, celsius=np.arange(0.0, 61.0, 10.0), frequencies=np.logspace(-1.0, 1.0, 9))
    random, isotherms = np.random.default_rng(4), []
    for one in planted.sweeps.isotherms:
        far = random.choice([-1.0, 1.0], (2, len(one))) * (random.uniform(size=len(one)) < 0.2)
        moduli = 3.0 ** far[0] * one.storage_modulus, 3.0 ** far[1] * one.loss_modulus
        isotherms.append(Isotherm(one.temperature, one.angular_frequency, *moduli))
    fit = vf.superpose(IsothermalSweeps(tuple(isotherms)), "20 degC")
    factors = fit.shift_factors
    away = factors.log10_values - planted.log10_alpha(factors.temperatures, "20 degC")
    assert "points-far-off" in codes(fit.notes)
    assert len(factors.temperatures) == 7  # no isotherm is left out
    assert np.all(np.abs(away) <= 1.96 * factors.standard_errors)
    assert factors.standard_errors.max() > 0.5  # decades
