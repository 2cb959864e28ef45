"""Bands of predicted friction: what spectra and shift factors drawn anew make of it, against solving each of them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from rheology.planted import planted_sweeps
from viscofric.friction.bands import DrawnMaterials
from viscofric.friction.sensitivity import solve_with_sensitivity
from viscofric.notes import codes
from viscofric.rheology.spectra.quality import SpectrumFit
from viscofric.rheology.uncertainty.material_samples import MaterialSamples, SystematicMisfit

BALL = vf.Ball(radius="9.525 mm")
LOAD = 25.0
CONDITIONS = ((303.15, 0.02), (363.15, 0.05))


def measured_material(noise: float = 0.01, samples: int = 40, seed: int = 5):
    """Spectrum and shift factors from SYNTHETIC sweeps of the built-in rubber, and materials drawn about them."""
    made = planted_sweeps(seed, noise, celsius=np.arange(0.0, 121.0, 10.0), frequencies=np.logspace(-1.0, 1.0, 9))
    fit = vf.superpose(made.sweeps, reference="30 degC")
    spectrum = vf.fit_retardation_spectrum(fit.master_curve)
    drawn = vf.sample_materials(fit, spectrum, samples=samples, seed=seed)
    return vf.Material(spectrum, fit.shift_factors), drawn


@pytest.fixture(scope="module")
def measured():
    return measured_material()


def drawn_from(*materials: vf.Material, misfit: SystematicMisfit | None = None) -> MaterialSamples:
    """Make samples of given materials; the limits of the band of two are these two."""
    count = max(len(one.spectrum.C) for one in materials)
    C = np.array([np.pad(one.spectrum.C, (0, count - len(one.spectrum.C))) for one in materials])
    tau = np.array([np.pad(one.spectrum.tau, (0, count - len(one.spectrum.C)), mode="edge") for one in materials])
    return MaterialSamples(materials, C, tau, (1e-3, 1e6), misfit)


def predicted(material: vf.Material, samples: MaterialSamples | None, temperature: float, speed: float, **settings):
    asked = {"speeds": speed, "temperatures": temperature, "load": LOAD, "samples": samples}
    return vf.predict_friction(material, BALL, **(asked | settings))


def solved(material: vf.Material, temperature: float, speed: float, load: float = LOAD) -> float:
    return vf.solve_steady(material, BALL, speed=speed, load=load, temperature=temperature).friction_coefficient


@pytest.mark.parametrize("exact", [False, True])
def test_friction_beyond_the_measured_frequencies_has_a_note(exact: bool) -> None:
    """At 30 °C contacts of about 1 mm; at 60 °C α is 1/100."""
    solid = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms").modes_at()
    fit = SpectrumFit(None, None, False, False, (100.0, 2e3))
    law = vf.Arrhenius(activation_energy=1.286e5, reference="30 degC")
    material = vf.Material(replace(solid, fit=fit), shift=law)

    def noted(speeds: list[float], celsius: float, **heated: object) -> list[object]:
        curves = vf.predict_friction(
            material,
            vf.Ball("10 mm"),
            speeds=speeds,
            temperatures=f"{celsius} degC",
            load="1 N",
            exact=exact,
            accuracy=0.1,
            **heated,
        )
        beyond = np.count_nonzero(curves.within_measured_frequencies == 0.0)
        counted = [note.values["points"] for note in curves.notes if note.code == "beyond-measured"]
        assert counted == [beyond] * bool(beyond)
        return counted

    assert noted([0.5, 1.0], 30.0) == []
    assert noted([1.0, 10.0], 30.0) == [1]
    assert noted([1.0, 30.0, 100.0, 1000.0], 60.0) == [2]
    body = vf.ThermalProperties("0.2 W/m/K", "1000 kg/m**3", "2000 J/kg/K", "rubber")
    assert noted([1.0, 10.0], 30.0, heating=vf.Heating(rubber=body, counterface=body)) == [1]


def test_a_contact_and_curves_of_contacts_note_frequencies_that_were_not_measured() -> None:
    solid = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms").modes_at()
    law = vf.Arrhenius(activation_energy=1.286e5, reference="30 degC")
    material = vf.Material(replace(solid, fit=SpectrumFit(None, None, False, False, (100.0, 2e3))), shift=law)
    contacts = [
        vf.solve_steady(material, vf.Ball("10 mm"), speed=speed, load="1 N", accuracy=0.1, temperature="30 degC")
        for speed in (0.5, 1.0, 10.0, 20.0)
    ]
    beyond = ["beyond-measured"]
    assert [[note.code for note in one.warnings] for one in contacts] == [[], [], beyond, ["quasi-static", *beyond]]
    curves = vf.FrictionCurves.from_solutions(contacts)
    assert curves.within_measured_frequencies.tolist() == [1.0, 1.0, 0.0, 0.0]
    found = {note.code: (note.values["contacts"], note.values["of"]) for note in curves.notes}
    assert found == {"quasi-static": (1, 4), "beyond-measured": (2, 4)}
    assert not vf.solve_steady(material, vf.Ball("10 mm"), speed=math.inf, load="1 N", accuracy=0.1).warnings


def test_of_a_prony_series_without_a_measurement_friction_beyond_its_modes_is_marked() -> None:
    prony = vf.RelaxationSpectrum(E0=1e6, E=[1e6, 1e6, 1e6], tau=[1e-4, 1e-3, 1e-2]).to_retardation()
    ends = (1.0 / prony.tau.max(), 1e4)  # rad/s
    ball, contact = vf.Ball("10 mm"), {"load": "1 N", "accuracy": 0.1}
    speeds = (0.02, 1.0, 100.0)  # over 1.4 mm
    contacts = [vf.solve_steady(vf.Material(prony), ball, speed=speed, **contact) for speed in speeds]
    beyond = ["beyond-measured"]
    assert [[note.code for note in one.warnings] for one in contacts] == [beyond, [], ["quasi-static", *beyond]]
    assert (contacts[0].warnings[0].values["low"], contacts[0].warnings[0].values["high"]) == pytest.approx(ends)
    shifted = vf.Material(prony, shift=vf.WLF(C1=10.0, C2=100.0, reference="30 degC"))
    curves = vf.predict_friction(shifted, ball, speeds=speeds, temperatures="30 degC", **contact)
    assert curves.within_measured_frequencies.tolist() == [0.0, 1.0, 0.0]
    assert codes(curves.notes) == {"frequencies-unknown", "beyond-measured", "quasi-static"}
    road = vf.self_affine(0.8, shape=(64, 64), spacing="10 um", shortest="80 um", rms_slope=0.1, seed=1)
    fast = vf.solve_periodic(vf.Material(prony), road.to_surface(), speed="100 m/s", pressure="5 kPa")
    theory = vf.persson_theory(
        vf.Material(prony), vf.roughness.power_spectrum(road), speeds="100 m/s", pressure="5 kPa"
    )
    bounce = vf.motion.solve_impact(vf.Material(prony), vf.Ball("5 mm"), mass="4 kg", speed="1 mm/s", accuracy=1e-2)
    for notes in (fast.warnings, theory.notes, bounce.warnings):
        assert "beyond-measured" in codes(notes)


def test_what_is_not_known_of_a_material_is_noted_in_every_result() -> None:
    law = vf.Arrhenius(activation_energy=1.286e5, reference="30 degC", fitted_range=(293.15, 313.15))
    material = vf.Material(vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms").spectrum, shift=law)
    contact = {"load": "1 N", "accuracy": 0.1}
    within, beyond = (
        vf.solve_steady(material, vf.Ball("10 mm"), speed="1 m/s", temperature=celsius, **contact)
        for celsius in ("30 degC", "60 degC")
    )
    assert (codes(within.warnings), codes(beyond.warnings)) == (set(), {"extrapolated"})
    assert codes(vf.FrictionCurves.from_solutions([within, beyond]).notes) == {"extrapolated"}
    curves = vf.predict_friction(
        material, vf.Ball("10 mm"), speeds="1 m/s", temperatures=["30 degC", "60 degC"], **contact
    )
    assert codes(curves.notes) == {"frequencies-unknown", "extrapolated"}
    (note,) = (note for note in curves.notes if note.code == "extrapolated")
    assert note.values == {"lowest": 333.15, "highest": 333.15}
    road = vf.self_affine(0.8, shape=(64, 64), spacing="10 um", shortest="80 um", rms_slope=0.1, seed=1)
    rough = vf.predict_rough_friction(material, road, speeds="0.1 m/s", pressure="5 kPa", temperatures="60 degC")
    assert codes(rough.notes) == {"frequencies-unknown", "extrapolated"}
    bounce = vf.motion.solve_impact(
        material, vf.Ball("5 mm"), mass="4 g", speed="1 m/s", temperature="60 degC", accuracy=1e-2
    )
    assert "extrapolated" in codes(bounce.warnings)


def test_a_rough_contact_notes_the_part_of_its_friction_at_frequencies_that_were_not_measured() -> None:
    solid = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "1 ms").modes_at()
    road = vf.self_affine(0.8, shape=(64, 64), spacing="10 um", shortest="80 um", rms_slope=0.1, seed=1)

    def shares(low: float, high: float) -> list[float]:
        material = vf.Material(replace(solid, fit=SpectrumFit(None, None, False, False, (low, high))))
        solution = vf.solve_periodic(material, road.to_surface(), speed="0.1 m/s", pressure="5 kPa")
        found = vf.predict_rough_friction(material, road, speeds=["0.1 m/s", "0.1 m/s"], pressure="5 kPa")
        counts = [
            (note.values["contacts"], note.values["of"]) for note in found.notes if note.code == "beyond-measured"
        ]
        noted = [note.values["share"] for note in solution.warnings if note.code == "beyond-measured"]
        assert counts == len(noted) * [(2, 2)]
        return noted

    def by_theory(low: float, high: float) -> list[float]:
        material = vf.Material(replace(solid, fit=SpectrumFit(None, None, False, False, (low, high))))
        theory = vf.persson_theory(material, vf.roughness.power_spectrum(road), speeds="0.1 m/s", pressure="5 kPa")
        return [note.values["share"] for note in theory.notes if note.code == "beyond-measured"]

    for parts in (shares, by_theory):
        assert parts(1e-2, 1e8) == []
        (fast,), (slow,) = parts(1e-2, 3001.0), parts(3001.0, 1e8)
        assert fast + slow == pytest.approx(1.0)  # each wave was measured in one of both
        assert 0.1 < fast < 0.9


def test_predicted_friction_lies_within_its_band_at_any_speed(measured) -> None:
    material, samples = measured
    curves = predicted(material, samples, 303.15, [1e-20, 1e-9, 1e-3, 1.0, 1e3, 1e9, 1e20], accuracy=0.1)
    assert curves.within_measured_frequencies.tolist() == [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0]
    assert np.all(curves.viscoelastic_lower > 0.0)
    assert np.all(curves.viscoelastic_lower <= curves.viscoelastic)
    assert np.all(curves.viscoelastic <= curves.viscoelastic_upper)


def test_at_equal_stiffness_friction_of_a_sample_is_first_order_where_it_differs_by_factors() -> None:
    """A glass 20 times as stiff, which the sample reaches by a mode of 1e-6 of the time of the contact."""
    soft = vf.Material.standard_linear_solid("1 MPa", "5 MPa", "1 ms").modes_at()
    law = vf.Arrhenius(activation_energy=1e5, reference="30 degC")
    C = 0.95 / soft.E_inf
    stiff = vf.RetardationSpectrum(soft.E0, 20.0 * soft.E_inf, [*soft.C, C], [*soft.tau, 1e-8])
    one, other = (vf.Material(spectrum, shift=law) for spectrum in (soft, stiff))
    # At 1e2 m/s both relax alike; then friction is 33 and 2000 times that of the solved material, and the second order
    # of the loss tangent, 0.1 and 1, is left.
    for speed, least, error in ((1e2, 1.0, 1e-4), (1e4, 30.0, 0.05), (1e5, 2000.0, 0.25)):
        contact = {"speed": speed, "load": LOAD, "temperature": 303.15, "accuracy": 1e-2}
        _, sensitivity = solve_with_sensitivity(one, BALL, **contact)
        found = DrawnMaterials(drawn_from(other, other), one).friction(sensitivity, 303.15)[0]
        exact = vf.solve_steady(other, BALL, **contact).friction_coefficient
        assert exact > least * sensitivity.friction
        assert found == pytest.approx(exact, rel=error)


@pytest.mark.slow
@pytest.mark.parametrize(("temperature", "speed"), CONDITIONS)
def test_each_drawn_material_has_the_friction_of_its_own_contact(measured, temperature: float, speed: float) -> None:
    """They lie up to 1 % off, and so does what is left out, ½ (1 %)² = 5e-5 of μ, as a rule.

    As α alone moves μ by up to 2 % before the spectrum makes it good, four times that is allowed for.
    """
    material, samples = measured
    ten = replace(samples, materials=samples.materials[:10])
    _, sensitivity = solve_with_sensitivity(material, BALL, speed=speed, load=LOAD, temperature=temperature)
    found = DrawnMaterials(ten, material).friction(sensitivity, temperature)
    by_themselves = [solved(one, temperature, speed) for one in ten.materials]
    assert np.std(by_themselves) > 5e-4 * sensitivity.friction
    np.testing.assert_allclose(found, by_themselves, rtol=2e-4)


@pytest.mark.slow
def test_the_samples_do_not_move_what_is_predicted(measured) -> None:
    material, samples = measured
    alone, beside = (predicted(material, given, 333.15, [0.02, 0.2]) for given in (None, samples))
    np.testing.assert_allclose(beside.viscoelastic, alone.viscoelastic, rtol=1e-12)
    assert alone.material_error is None
    assert np.all(beside.viscoelastic_lower < beside.viscoelastic)
    assert np.all(beside.viscoelastic < beside.viscoelastic_upper)


def test_what_is_known_exactly_has_no_band(measured) -> None:
    material, _ = measured
    curves = predicted(material, drawn_from(*[material] * 25), 333.15, 0.1)
    # Sums of fifty products of either sign, rounded.
    assert curves.material_error[0] < 1e-10 * curves.viscoelastic[0]
    assert curves.viscoelastic_upper[0] - curves.viscoelastic_lower[0] < 1e-10 * curves.viscoelastic[0]
    assert not curves.notes


@pytest.mark.slow
def test_shift_factors_alone_move_friction_along_its_slope() -> None:
    """Errors of log10 α of 0.01 decades: Δμ = ∂μ/∂ln v · ln 10 · Δlog10 α, to the curvature's 0.5 % of the error."""
    rubber = vf.synthetic_fluoroelastomer()
    kelvin, error = np.array([303.15, 333.15, 363.15]), 0.01
    tables = [
        vf.ShiftFactors(kelvin, rubber.shift.log10(kelvin) + np.array([0.0, one, one]), 303.15)
        for one in error * np.random.default_rng(2).standard_normal(30)
    ]
    samples = drawn_from(*(replace(rubber, shift=one) for one in tables))
    curves = predicted(rubber, samples, 333.15, 0.05)
    contact = vf.solve_steady(rubber, BALL, speed=0.05, load=LOAD, temperature=333.15, derivatives=True)
    slope = contact.derivatives.logarithmic.speed
    spread = np.std([one.log10(333.15) for one in tables], ddof=1)
    assert curves.material_error[0] == pytest.approx(abs(slope) * np.log(10.0) * spread, rel=0.01)
    at_reference = predicted(rubber, samples, 303.15, 0.05)
    assert at_reference.material_error[0] < 1e-10 * at_reference.viscoelastic[0]


@pytest.mark.parametrize(("speed", "power"), [(1e-9, 1.0), (1e9, -1.0)])
def test_friction_of_modes_far_from_the_time_of_the_contact_moves_with_them(speed: float, power: float) -> None:
    """At vτ/a of 1e-9 and 1e9 friction is proportional to τ and to 1/τ."""
    law = vf.Arrhenius(activation_energy=1e5, reference="60 degC")
    one, faster, slower = (
        replace(vf.Material.standard_linear_solid("3 MPa", "6 MPa", tau), shift=law) for tau in (1e-3, 0.8e-3, 1.25e-3)
    )
    curves = predicted(one, drawn_from(faster, slower), 333.15, speed, accuracy=1e-2)
    limits = sorted([0.8**power, 1.25**power])
    found = np.concatenate([curves.viscoelastic_lower, curves.viscoelastic_upper]) / curves.viscoelastic
    np.testing.assert_allclose(found, limits, rtol=1e-2)  # the accuracy of the derivatives


@pytest.mark.slow
def test_a_vertical_shift_moves_friction_by_the_load_rule() -> None:
    """Moduli b times larger at a temperature are a load b times smaller: Δμ = −F ∂μ/∂F Δln b."""
    rubber = vf.synthetic_fluoroelastomer()
    kelvin = np.array([303.15, 333.15])
    raised = [vf.rheology.VerticalShiftFactors(kelvin, np.array([0.0, one]), 303.15) for one in (0.02, 0.03)]
    material = replace(rubber, vertical_shift=vf.rheology.VerticalShiftFactors(kelvin, np.array([0.0, 0.025]), 303.15))
    curves = predicted(material, drawn_from(*(replace(rubber, vertical_shift=one) for one in raised)), 333.15, 0.05)
    expected = [solved(rubber, 333.15, 0.05, LOAD / 10.0**one) for one in (0.03, 0.02)]
    # A factor of 1.012 either way: second order ½ · 1/3 · (1.2 %)², 2.4e-5, beside 1e-5 of either solution.
    found = sorted([curves.viscoelastic_lower[0], curves.viscoelastic_upper[0]])
    np.testing.assert_allclose(found, np.sort(expected), rtol=6e-5)


@pytest.mark.slow
def test_what_the_spectrum_misses_widens_the_band(measured) -> None:
    """Moduli off by one factor throughout move friction by the load rule, losses off by one factor by that factor."""
    material, _ = measured
    grid = np.linspace(-8.0, 8.0, 5)
    contact = vf.solve_steady(material, BALL, speed=0.1, load=LOAD, temperature=333.15, derivatives=True)
    load = contact.derivatives.logarithmic.load / contact.friction_coefficient
    for size, relative in (((0.0, 0.02), 0.02), ((0.02, 0.0), 0.02 * (1.0 + load))):
        misfit = SystematicMisfit(grid, np.tile(size, (5, 1)))
        curves = predicted(material, drawn_from(*[material] * 20, misfit=misfit), 333.15, 0.1)
        expected = np.log(10.0) * relative * curves.viscoelastic[0]
        assert curves.material_error[0] == pytest.approx(expected, rel=1e-6)
        # 1.96 standard errors, either side
        width = curves.viscoelastic_upper[0] - curves.viscoelastic_lower[0]
        assert width == pytest.approx(2.0 * 1.959964 * expected, rel=1e-6)


def test_the_misfit_counts_at_the_frequency_of_the_contact(measured) -> None:
    """Speed over half the contact's length, times α: a misfit that grows evenly over log ω tells where it is read."""
    material, _ = measured
    misfit = SystematicMisfit(np.array([-6.0, 14.0]), np.array([[0.0, 0.01], [0.0, 0.03]]))
    curves = predicted(material, drawn_from(*[material] * 20, misfit=misfit), 333.15, 0.1)
    contact = vf.solve_steady(material, BALL, speed=0.1, load=LOAD, temperature=333.15)
    alpha = material.shift(333.15)
    assert alpha < 0.5
    frequency = alpha * 0.1 / (0.5 * (contact.front + contact.rear))
    expected = np.log(10.0) * (0.01 + 0.001 * (np.log10(frequency) + 6.0))
    # A factor of two in frequency changes the error by 2 %; lengths of contacts are found to far better.
    assert curves.material_error[0] == pytest.approx(expected * curves.viscoelastic[0], rel=1e-4)


@pytest.mark.slow
def test_a_wide_band_and_a_foreign_one_are_reported() -> None:
    rubber = vf.synthetic_fluoroelastomer()
    softer, stiffer = (replace(rubber, spectrum=rubber.spectrum.shifted(1.0, b)) for b in (0.4, 2.0))
    notes = predicted(rubber, drawn_from(softer, stiffer), 333.15, 0.1).notes
    assert "large-change" in codes(notes)
    notes = predicted(rubber, drawn_from(stiffer, stiffer), 333.15, 0.1).notes
    assert "outside-band" in codes(notes)


@pytest.mark.slow
def test_a_line_contact_under_an_elastic_cylinder_has_its_band_too(measured) -> None:
    """Second order as above; a line contact is solved to 1e-5."""
    material, samples = measured
    pair = samples.materials[:2]
    asked = {"speed": 0.1, "load": 1000.0, "temperature": 333.15, "indenter_modulus": 20e6}
    cylinder = vf.Cylinder(radius="10 mm")
    by_themselves = [vf.solve_steady(one, cylinder, **asked).friction_coefficient for one in pair]
    curves = vf.predict_friction(
        material,
        cylinder,
        speeds=0.1,
        temperatures=333.15,
        load=1000.0,
        samples=drawn_from(*pair),
        indenter_modulus=20e6,
    )
    found = [curves.viscoelastic_lower[0], curves.viscoelastic_upper[0]]
    np.testing.assert_allclose(found, np.sort(by_themselves), rtol=2e-4)


def test_samples_that_do_not_fit_are_refused(measured) -> None:
    material, samples = measured
    compressible = replace(material, poisson_ratio=0.4)
    with refused("poisson-ratio", naming=("0.5", "0.4")):
        predicted(compressible, samples, 333.15, 0.1)
    with refused("no-shift"):
        predicted(material, drawn_from(replace(material, shift=None)), 333.15, 0.1)
    omega = np.geomspace(1e-3, 1e6, 40)
    modulus = material.complex_modulus(omega)
    table = vf.rheology.ModulusTable(omega, modulus.real, modulus.imag)
    with refused("no-modes"):
        predicted(replace(material, spectrum=table), samples, 333.15, 0.1)


@pytest.mark.apart
def test_what_is_reported_is_how_far_the_truth_is_off() -> None:
    """True friction of the planted rubber, in standard errors told, over five measurements of it with 1 % noise.

    Ten of them, two of each measurement being alike in part, have a root mean square of 1 ± 0.25; within twice that
    the errors are neither half nor twice what they should be.
    """
    asked = {"speeds": 0.05, "temperatures": [303.15, 363.15], "load": LOAD}
    truth = vf.predict_friction(vf.synthetic_fluoroelastomer(), BALL, **asked).viscoelastic
    away = []
    for seed in range(5):
        material, samples = measured_material(seed=seed)
        curves = vf.predict_friction(material, BALL, samples=samples, **asked)
        away.append((curves.viscoelastic - truth) / curves.material_error)
    assert np.sqrt(np.mean(np.square(away))) == pytest.approx(1.0, abs=0.5)


def test_friction_of_a_sample_without_losses_is_not_negative() -> None:
    """Its only mode relaxes in 1e20 s; to first order that is more than the whole friction."""
    law = vf.Arrhenius(activation_energy=1.286e5, reference="30 degC")
    lossy, elastic = (
        replace(vf.Material.standard_linear_solid("1 MPa", "10 MPa", tau), shift=law) for tau in ("10 ms", 1e20)
    )
    curves = predicted(lossy, drawn_from(lossy, elastic), 303.15, 0.05, load=1.0)
    assert curves.viscoelastic_lower is not None
    assert curves.viscoelastic[0] > 0.0 == curves.viscoelastic_lower[0]


def test_one_sample_far_off_does_not_make_the_standard_error_of_a_narrow_band():
    law = vf.WLF(C1=8.86, C2=101.6, reference="30 degC")
    usual = [vf.Material.standard_linear_solid(1e6 * (1.0 + 1e-3 * n), 1e7, "1 ms") for n in range(-100, 101)]
    *usual, far = (replace(one, shift=law) for one in (*usual, vf.Material.standard_linear_solid(5e3, 1e7, "1 ms")))
    curves = predicted(usual[100], drawn_from(*usual, far), 303.15, 0.1, accuracy=1e-2)
    half = 0.5 * (curves.viscoelastic_upper - curves.viscoelastic_lower)
    # that of a normal distribution of which these limits hold 90 %, at most; the one sample alone would make far more
    np.testing.assert_allclose(curves.material_error, half / 1.645, rtol=1e-3)
    without = predicted(usual[100], drawn_from(*usual), 303.15, 0.1, accuracy=1e-2)
    assert 0.9 * without.material_error[0] < curves.material_error[0] < 1.2 * without.material_error[0]
