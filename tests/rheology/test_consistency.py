"""Whether superposition holds: simple materials pass at any noise, complex ones and real failures are told."""

from __future__ import annotations

import time

import numpy as np
import pytest

import viscofric as vf
from rheology.planted import planted_sweeps, synthetic_polymer
from viscofric.data import Isotherm, IsothermalSweeps
from viscofric.notes import READERS, codes, notes_in
from viscofric.rheology.superposition.consistency import NeighbourDistance, drift, neighbour_distances
from viscofric.rheology.superposition.result import check_superposition

RUBBER = vf.synthetic_fluoroelastomer()
POLYMER = synthetic_polymer()
OMEGA = 2 * np.pi * np.logspace(-1, 1, 17)
CELSIUS = np.arange(0.0, 151.0, 10.0)


def sweeps(modulus, noise, seed=0, celsius=CELSIUS):
    """Sweep a material, given as a function of ω and T (K), with noise in E' and in E''."""
    random = np.random.default_rng(seed)
    isotherms = []
    for temperature in celsius + 273.15:
        exact = modulus(OMEGA, temperature)
        scatter = 1 + noise * random.standard_normal((2, len(OMEGA)))
        isotherms.append(Isotherm(temperature, OMEGA, scatter[0] * exact.real, scatter[1] * exact.imag))
    return IsothermalSweeps(tuple(isotherms))


def two_processes(omega, temperature):
    """Two broad relaxations whose times depend on temperature differently: WLF and a weak Arrhenius law."""
    decades = np.arange(-12.0, 12.0, 0.25)
    total = np.full(len(omega), 2e6, dtype=complex)
    for law, centre, strength in (
        (vf.WLF(12.0, 90.0, "30 degC"), -1.0, 3e6),
        (vf.Arrhenius("40 kJ/mol", "30 degC"), -2.0, 3e6),
    ):
        weight = np.exp(-0.5 * ((decades - centre) / 1.2) ** 2)
        tau = 10.0**decades * law(temperature)
        product = 1j * np.outer(omega, tau)
        total += strength * (product / (1.0 + product)) @ (weight / weight.sum())
    return total


@pytest.mark.parametrize("noise", [0.003, 0.01, 0.03])
def test_one_shift_for_all_relaxations_superposes(noise):
    check = check_superposition(vf.superpose(sweeps(RUBBER.complex_modulus, noise), "30 degC"))
    assert check.holds
    # Over seeds these have figures below 0.3; the distances are what the noise within isotherms makes of them.
    assert check.figure_of_merit < 0.4
    assert check.between < 3.0 * check.within + 1e-3
    assert check.kramers_kronig.holds
    assert check.sentences[0].code == "superposition-holds"


def test_distances_of_neighbours_lie_within_their_standard_errors():
    scores = []
    for seed in range(30):
        measured = sweeps(RUBBER.complex_modulus, 0.01, seed, CELSIUS[5:12])
        pairs = neighbour_distances(measured.isotherms, np.zeros(7))
        scores.append([pair.distance / pair.standard_error for pair in pairs])
    # 180 scores, neighbours in them correlated by a half: some 100 independent, whose spread is known to 7 % (one
    # sigma).  50 to 110 °C, where cubics follow the isotherms; near the dip of tan δ they do to 0.006 decades only.
    assert np.std(scores) == pytest.approx(1.0, abs=0.25)
    assert np.mean(np.abs(scores) < 1.96) > 0.88


@pytest.mark.slow
def test_isotherms_of_few_modes_are_compared_where_they_lie_beside_each_other():
    # The glassiest isotherm bends at its soft end so that its normal there points at the plateau, 1.3 decades away.
    moduli, times = (
        [3.3e6, 2.7e7, 8.9e7, 5.3e7, 7.1e5, 3.4e5, 280.0],
        [8.9e-11, 2.3e-9, 1.3e-8, 6.9e-8, 5.9e-6, 2e-5, 7.5e-3],
    )
    prony = vf.RelaxationSpectrum(E0=9.6e5, E=moduli, tau=times).to_retardation()
    material = vf.Material(prony, shift=vf.WLF(C1=6.5, C2=148.0, reference="20 degC"))
    omega = 2.0 * np.pi * np.geomspace(0.1, 10.0, 17)
    planted = [(kelvin, material.complex_modulus(omega, kelvin)) for kelvin in (229.0, 244.0, 260.0)]
    sweeps = IsothermalSweeps(tuple(Isotherm(kelvin, omega, E.real, E.imag) for kelvin, E in planted))
    check = vf.superpose(sweeps, reference=260.0).check
    # The smooth curves through 17 points of the sparse modes are off by 0.02 decades each.
    assert (check.verdict, check.between < 0.05) == ("holds", True)


def test_relaxations_that_shift_apart_do_not_superpose():
    check = check_superposition(vf.superpose(sweeps(two_processes, 0.01), "30 degC"))
    assert not check.holds
    assert check.sentences[0].code == "superposition-fails"
    assert "°C" in check.sentences[0]


def strongly_shifted(omega, temperature):
    """Raise the modulus of the simple rubber by a tenth every ten kelvin."""
    return RUBBER.complex_modulus(omega, temperature) * 1.1 ** ((temperature - 303.15) / 10.0)


@pytest.mark.slow
def test_a_change_of_modulus_alone_is_mended_by_a_vertical_shift():
    measured = sweeps(strongly_shifted, 0.01, celsius=CELSIUS[2:])
    without = check_superposition(vf.superpose(measured, "30 degC"))
    assert not without.holds
    assert not without.sentences[0].values["vertical_shift"]
    mended = check_superposition(vf.superpose(measured, "30 degC", vertical="free"))
    assert mended.holds
    assert mended.between < 0.3 * without.between


def entropic(omega, temperature):
    """Let the modulus of a polymer follow temperature, as an ideal rubber's does."""
    return POLYMER.complex_modulus(omega, temperature) * temperature / 303.15


@pytest.mark.slow
def test_isotherms_that_drift_to_one_side_make_superposition_doubtful():
    """No pair is farther apart than sweeps repeat, but all to one side: a vertical shift was left out."""
    measured = sweeps(entropic, 0.005, celsius=np.arange(-25.0, 101.0, 5.0))
    fit = vf.superpose(measured, "30 degC")
    check = check_superposition(fit)
    assert check.figure_of_merit < 1.0
    assert max(abs(one.distance) for one in check.neighbours) < 0.02
    assert (check.verdict, check.holds, check.roughly) == ("doubtful", False, False)
    assert codes(check.sentences[:-1]) == {"superposition-doubtful"}
    remedy = check.sentences[0].remedy
    assert len({remedy.words(reader) for reader in READERS}) == len(READERS)
    # The data set that results store has the words for every reader, too.
    stored = notes_in(check.to_dataset().attrs, "sentences")
    assert [[one.words(reader) for reader in READERS] for one in stored[:1]] == [
        [check.sentences[0].words(reader) for reader in READERS]
    ]
    assert abs(check.drift.distance) > 6.0 * check.drift.standard_error
    # The errors of α hold what the vertical shift would change: the two models do not contradict each other, …
    mended = vf.superpose(measured, "30 degC", vertical="free")
    assert mended.check.verdict == "holds"
    assert mended.check.drift is None
    assert mended.check.figure_of_merit < 0.5 * check.figure_of_merit
    away = np.abs(mended.shift_factors.log10_values - fit.shift_factors.log10_values)
    known = fit.shift_factors.standard_errors > 1e-9
    assert np.all(away[known] < 1.96 * fit.shift_factors.standard_errors[known])
    # … and the truth contradicts neither.
    truth = POLYMER.shift.at_reference("30 degC").log10(fit.shift_factors.temperatures)
    assert (
        np.mean(np.abs(fit.shift_factors.log10_values - truth) < 1.96 * fit.shift_factors.standard_errors + 1e-9) > 0.9
    )


@pytest.mark.apart
def test_loss_tangents_beside_a_free_vertical_shift_lie_in_the_band_without_it():
    """Bands from the same sweeps, without b and with it, do not exclude each other: friction follows tan δ."""
    measured = planted_sweeps(
        0,
        0.005,
        material=POLYMER,
        celsius=np.arange(-25.0, 101.0, 5.0),
        log10_b=lambda kelvin: np.log10(kelvin / 303.15),
    ).sweeps
    fits = [vf.superpose(measured, "30 degC", vertical=vertical) for vertical in (None, "free")]
    assert [fit.check.verdict for fit in fits] == ["doubtful", "holds"]
    plain, free = (vf.sample_materials(fit, samples=60) for fit in fits)
    # They did where α had no more than the errors of its points: 0.0057 to 0.0060 against 0.0062, for instance.
    # Near the plateau they do: at 90 °C and 10 rad/s 0.0009 to 0.0010 against 0.0008.
    for kelvin, omega in ((303.15, 1.0), (303.15, 100.0), (363.15, 1e4)):
        bands = [
            drawn.band(lambda one, at=(omega, kelvin): tangent(one.complex_modulus(*at))) for drawn in (plain, free)
        ]
        assert max(band.lower for band in bands) < min(band.upper for band in bands)


def tangent(modulus):
    return modulus.imag / modulus.real


@pytest.mark.slow
def test_isotherms_that_are_each_off_do_not_pass_for_a_drift():
    for seed in range(3):
        for shared in (False, True):
            planted = planted_sweeps(seed, 0.005, offset=0.02, shared=shared, celsius=np.arange(0.0, 161.0, 10.0))
            assert vf.superpose(planted.sweeps, "30 degC").check.drift is None


def pair(place, distance):
    return NeighbourDistance(270.0 + 10.0 * place, 280.0 + 10.0 * place, distance, 0.001, 20)


def test_a_drift_is_what_adds_up():
    steady = [pair(place, -0.02) for place in range(5)]
    found = drift(steady)
    assert (found.colder, found.warmer, found.neighbours) == (270.0, 320.0, 5)
    assert found.distance == pytest.approx(-0.1)
    assert found.standard_error == pytest.approx(0.001 * np.sqrt(5.0))
    # One after the other to either side, one bad sweep at an end, or noise as large: none.
    assert drift([pair(place, 0.04 * (-1) ** place) for place in range(6)]) is None
    assert drift([pair(0, 0.1), *(pair(place, 0.001) for place in range(1, 6))]) is None
    assert (
        drift([pair(place, distance) for place, distance in enumerate((0.02, -0.05, 0.01, -0.06, 0.02, -0.05))]) is None
    )
    # A gap between temperatures ends a run.
    assert drift([pair(0, -0.02), pair(1, -0.02), pair(3, -0.02), pair(4, -0.02)]) is None


def test_distance_shows_which_isotherm_is_more_lossy():
    pair = sweeps(RUBBER.complex_modulus, 0.0, celsius=np.array([80.0, 90.0])).isotherms
    same = neighbour_distances(pair, np.zeros(2))[0]
    # Cubics over two decades follow this rubber to about a thousandth of a decade.
    assert same.distance == pytest.approx(0.0, abs=2e-3)
    colder, warmer = pair
    # Away from the peak of tan δ the curve slopes, so that 0.1 decades of tan δ are a little less across it.
    lossier = Isotherm(colder.temperature, OMEGA, colder.storage_modulus, colder.loss_modulus * 10**0.1)
    shifted = neighbour_distances((lossier, warmer), np.zeros(2))[0]
    assert 0.04 < shifted.distance < 0.1
    assert (
        neighbour_distances(
            (colder, Isotherm(warmer.temperature, OMEGA, warmer.storage_modulus, warmer.loss_modulus * 10**0.1)),
            np.zeros(2),
        )[0].distance
        < -0.04
    )


def test_units_of_modulus_and_time_do_not_matter():
    measured = sweeps(RUBBER.complex_modulus, 0.01)
    changed = IsothermalSweeps(
        tuple(
            Isotherm(one.temperature, 1e3 * one.angular_frequency, 1e-6 * one.storage_modulus, 1e-6 * one.loss_modulus)
            for one in measured.isotherms
        )
    )
    here, there = (neighbour_distances(one.isotherms, np.zeros(len(one))) for one in (measured, changed))
    assert [pair.distance for pair in there] == pytest.approx([pair.distance for pair in here], rel=1e-6, abs=1e-12)


def test_every_point_is_held_without_its_vertical_shift():
    fit = vf.superpose(sweeps(RUBBER.complex_modulus, 0.01), "30 degC")
    check = check_superposition(fit)
    storage = np.concatenate([one.storage_modulus for one in fit.isotherms])
    loss = np.concatenate([one.loss_modulus for one in fit.isotherms])
    assert check.storage_modulus == pytest.approx(storage)
    assert check.loss_modulus == pytest.approx(loss)
    assert sorted(set(check.temperature)) == [one.temperature for one in fit.isotherms]


def of_file(real_data, name, reference):
    deformation = "tension" if "adhesive" in name else "shear"
    return vf.superpose(vf.read_dma(real_data / "dma" / name, deformation=deformation), reference)


def test_an_acrylic_superposes(real_data):
    check = check_superposition(of_file(real_data, "acrylic_468mp.csv", "20 degC"))
    assert check.holds
    assert check.kramers_kronig.holds


@pytest.mark.slow
def test_a_foam_drifts_within_the_reproducibility_of_its_sweeps(real_data):
    """From 10 to 40 °C six neighbours in a row lie to one side, by 0.005 to 0.028 decades, which b would mend."""
    fit = of_file(real_data, "vinyl_nitrile_foam.csv", "20 degC")
    assert fit.check.figure_of_merit < 1.0
    assert fit.check.verdict == "doubtful"
    assert fit.check.kramers_kronig.holds
    mended = vf.superpose(
        vf.read_dma(real_data / "dma" / "vinyl_nitrile_foam.csv", deformation="shear"), "20 degC", vertical="free"
    )
    assert mended.check.figure_of_merit < 0.6 * fit.check.figure_of_merit
    # At 30 °C the two differ by 0.56 decades, 18 errors of the points alone.
    assert fit.shift_factors.log10("30 degC") - mended.shift_factors.log10("30 degC") > 0.4
    away = np.abs(fit.shift_factors.log10_values - mended.shift_factors.log10_values)
    assert np.all(away < 2.0 * fit.shift_factors.standard_errors + 1e-3)


@pytest.mark.slow
def test_eva_is_reported_as_a_failure(real_data):
    check = check_superposition(of_file(real_data, "eva_shear.csv", "20 degC"))
    assert not check.holds
    assert check.figure_of_merit > 2.0
    assert check.sentences[0].code == "superposition-fails"


@pytest.mark.slow
def test_the_adhesive_fails_by_a_little(real_data):
    """Its neighbours between −20 and 20 °C lie 0.02 to 0.06 decades apart, always to the same side."""
    check = check_superposition(of_file(real_data, "adhesive_ems_ca.csv", "25 degC"))
    assert not check.holds
    assert check.figure_of_merit < 2.0
    cold = [one.distance for one in check.neighbours if 253.0 < one.colder < 293.0]
    assert max(cold) < -0.015


def test_the_check_takes_no_time():
    fit = vf.superpose(sweeps(RUBBER.complex_modulus, 0.01), "30 degC")
    check_superposition(fit)
    best = np.inf
    for _ in range(3):
        start = time.process_time()
        check_superposition(fit)
        best = min(best, time.process_time() - start)
    assert best < 0.05  # about 0.01 s on one core
