"""Materials: temperature acts on time alone, and the built-in rubber is the one that was designed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from rheology.planted_ramps import planted_ramps
from viscofric.files import SYNTHETIC
from viscofric.notes import Note, codes
from viscofric.rheology.shifts.vertical_shift import DensityShift
from viscofric.rheology.spectra.modulus_table import ModulusTable

LAW = vf.WLF(C1=9.0, C2=100.0, reference="30 degC")


def test_standard_linear_solid_relaxes_in_tau_times_E0_over_E_inf():
    rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    relaxation = 1e-3 * 1e6 / 1e7
    omega = np.logspace(0, 6, 13)
    maxwell = 1e6 + 9e6 * 1j * omega * relaxation / (1 + 1j * omega * relaxation)
    assert rubber.complex_modulus(omega) == pytest.approx(maxwell, rel=1e-12)
    assert rubber.reference is None
    assert rubber.at() is rubber.spectrum


def test_temperature_shifts_the_frequency():
    solid = vf.Material.standard_linear_solid(E0=1e6, E_inf=1e7, tau=1e-3)
    law = vf.WLF(C1=9.0, C2=100.0, reference="30 degC")
    rubber = vf.Material(solid.spectrum, shift=law)
    omega = np.logspace(-2, 6, 9)
    expected = rubber.complex_modulus(law("60 degC") * omega, "30 degC")
    assert rubber.complex_modulus(omega, "60 degC") == pytest.approx(expected, rel=1e-12)
    assert rubber.at("30 degC") is rubber.spectrum
    assert rubber.reference == pytest.approx(303.15)


@pytest.mark.parametrize("ratio", [-0.1, 0.51, np.nan])
def test_impossible_poisson_ratios_are_refused(ratio):
    with refused("poisson_ratio"):
        vf.Material.standard_linear_solid(E0=1e6, E_inf=1e7, tau=1.0, poisson_ratio=ratio)


def test_vertical_shift_multiplies_the_modulus():
    solid = vf.Material.standard_linear_solid(E0=1e6, E_inf=1e7, tau=1e-3)
    # Given about 100 °C, used about 30 °C, where the spectrum holds.
    rubber = vf.Material(solid.spectrum, shift=LAW, vertical_shift=DensityShift("100 degC", 0.0), citation="made up")
    omega = np.logspace(-2, 6, 9)
    plain = vf.Material(solid.spectrum, shift=LAW).complex_modulus(omega, "60 degC")
    assert rubber.complex_modulus(omega, "60 degC") == pytest.approx(plain * 333.15 / 303.15, rel=1e-12)
    assert rubber.at("30 degC") is rubber.spectrum
    assert pytest.approx(1e6 * 333.15 / 303.15, rel=1e-12) == rubber.at("60 degC").E0
    assert rubber.citation == "made up"


def test_a_material_about_another_reference_is_the_same_material():
    solid = vf.Material.standard_linear_solid(E0=1e6, E_inf=1e7, tau=1e-3)
    rubber = vf.Material(solid.spectrum, shift=LAW, vertical_shift=DensityShift("30 degC"), name="solid")
    other = rubber.at_reference("80 degC")
    assert other.reference == pytest.approx(353.15)
    assert other.name == "solid"
    omega = np.logspace(-2, 6, 9)
    for celsius in (0.0, 30.0, 80.0, 120.0):
        expected = rubber.complex_modulus(omega, celsius + 273.15)
        assert other.complex_modulus(omega, celsius + 273.15) == pytest.approx(expected, rel=1e-10)
    with refused("no-shift"):
        solid.at_reference("80 degC")


def test_a_table_is_a_material_too():
    solid = vf.Material.standard_linear_solid(E0=1e6, E_inf=1e7, tau=1e-3)
    omega = np.logspace(-4, 8, 400)
    modulus = solid.complex_modulus(omega)
    table = vf.Material(ModulusTable(omega, modulus.real, modulus.imag), shift=LAW)
    rubber = vf.Material(solid.spectrum, shift=LAW)
    inside = np.logspace(-1, 4, 11)
    # Interpolated over 0.03 decades: the square of that times the curvature of ln E''.
    assert table.complex_modulus(inside, "60 degC") == pytest.approx(
        rubber.complex_modulus(inside, "60 degC"), rel=1e-3
    )
    assert table.at() is table.spectrum
    assert rubber.modes_at("60 degC").tau == pytest.approx(rubber.at("60 degC").tau)
    assert rubber.notes_on_modes == ()


def test_synthetic_fluoroelastomer_is_as_designed():
    rubber = vf.synthetic_fluoroelastomer()
    spectrum = rubber.at("30 degC")
    assert "synthetic" in rubber.name
    assert pytest.approx(3e6, rel=1e-12) == spectrum.E0
    assert spectrum.E_inf == pytest.approx(1.5e9, rel=1e-12)
    assert len(spectrum) < 60
    assert np.diff(np.log(spectrum.tau)) == pytest.approx(1.0)
    omega = np.logspace(4, 9, 1001)
    tangent = spectrum.loss_tangent(omega)
    assert tangent.max() == pytest.approx(1.33, abs=0.01)  # as printed in the design, two decimals
    assert omega[tangent.argmax()] == pytest.approx(5e6, rel=0.1)  # "near"
    friction_window = spectrum.loss_modulus(np.array([1e-2, 1.0, 10.0, 1e2]))
    assert np.all(np.diff(friction_window) < 0)
    law = rubber.shift.above.at_reference("20 degC")
    assert pytest.approx((10.04, 89.6), abs=0.005) == (law.C1, law.C2)


def test_the_measured_frequencies_move_with_the_temperature():
    known = {"measured_storage": (1e6, 1e9), "gaps": ((1.0, 100.0),)}
    fit = vf.rheology.SpectrumFit(0.01, 0.01, True, True, (1e-3, 1e6), **known)
    spectrum = vf.RetardationSpectrum(1e6, 1e9, [1e-6 - 1e-9], [1e-3], fit)
    material = vf.Material(spectrum, shift=vf.WLF(10.0, 100.0, 293.15))
    moved = material.at_reference(333.15)
    assert moved.spectrum.fit is not None
    # What was measured at ω and the old reference is seen at ω/α and the new one.
    alpha = material.shift(333.15)
    assert moved.spectrum.fit.frequency_range == pytest.approx((1e-3 / alpha, 1e6 / alpha), rel=1e-12)
    assert moved.spectrum.fit.gaps[0] == pytest.approx((1.0 / alpha, 100.0 / alpha), rel=1e-12)
    assert moved.at_reference(293.15).spectrum.fit.frequency_range == pytest.approx((1e-3, 1e6), rel=1e-9)


def test_a_material_of_a_relaxation_spectrum_is_that_of_its_retardation_spectrum() -> None:
    series = vf.RelaxationSpectrum("1 MPa", [9e6, 1e6], [1e-4, 1e-2])
    found, omega = vf.Material(series), np.geomspace(1.0, 1e6, 20)
    assert isinstance(found.spectrum, vf.RetardationSpectrum)
    np.testing.assert_allclose(found.complex_modulus(omega), series.complex_modulus(omega), rtol=1e-9)


@pytest.mark.parametrize("fitted_range", [None, (253.15, 373.15)])
def test_wlf_law_far_above_its_reference_is_noted_whether_or_not_its_range_is_known(fitted_range):
    law = vf.WLF(9.0, 100.0, 293.15, fitted_range=fitted_range)
    material = vf.Material(vf.synthetic_fluoroelastomer().spectrum, shift=law.unbounded())
    assert "extrapolated" not in codes(material.notes_at([263.15, 353.15]))
    assert "extrapolated" in codes(material.notes_at([353.15, 423.15]))


def test_the_law_of_an_assumed_material_is_exact_at_any_temperature():
    rubber = vf.synthetic_fluoroelastomer()
    assert rubber.synthetic
    assert "extrapolated" not in codes(rubber.notes_at("150 degC"))  # 120 K above its reference
    assert "extrapolated" in codes(replace(rubber, synthetic=False).notes_at("150 degC"))


def test_a_material_made_step_by_step_of_files_that_say_so_is_synthetic(tmp_path):
    omega, rows = np.logspace(-1.0, 1.0, 5), ["T (degC),omega (rad/s),E' (Pa),E'' (Pa)"]
    for celsius in (20.0, 25.0, 30.0):
        moduli = vf.synthetic_fluoroelastomer().complex_modulus(omega, celsius + 273.15)
        rows += [f"{celsius},{one},{E.real},{E.imag}" for one, E in zip(omega, moduli, strict=True)]
    for synthetic, remark in ((True, "# SYNTHETIC, not measured."), (False, "# a synthetic rubber, measured")):
        path = tmp_path / f"{synthetic}.csv"
        path.write_text("\n".join([remark, *rows]), encoding="utf-8")
        fit = vf.superpose(vf.read_dma(path), reference="25 degC")
        factors = fit.shift_factors
        assert (codes(factors.at_reference("30 degC").notes) == {SYNTHETIC}) == synthetic
        rubber = vf.Material(vf.fit_retardation_spectrum(fit), shift=factors)
        assert rubber.synthetic == rubber.at_reference("30 degC").synthetic == synthetic
        assert vf.Material(vf.fit_retardation_spectrum(fit.master_curve)).synthetic == synthetic
        vf.write_card(rubber, tmp_path / "rubber.json", format="json")
        assert vf.read_card(tmp_path / "rubber.json").synthetic == synthetic


def test_a_material_of_synthetic_ramps_is_synthetic():
    ramps = replace(planted_ramps(1), notes=(Note(SYNTHETIC, "The data are synthetic."),))
    fit = vf.superpose_ramps(ramps, "25 degC")
    assert codes(fit.shift_factors.notes) == {SYNTHETIC}
    assert vf.Material(vf.fit_retardation_spectrum(fit), shift=fit.shift).synthetic
    assert vf.Material(vf.fit_retardation_spectrum(fit.master_curve), shift=fit.shift).synthetic


@pytest.mark.parametrize(("remark", "synthetic"), [("SYNTHETIC, not measured.", True), ("measured", False)])
def test_a_material_of_a_master_curve_or_a_card_is_synthetic_where_its_file_says_so(tmp_path, remark, synthetic):
    omega = np.logspace(-3.0, 3.0, 13)
    moduli = vf.synthetic_fluoroelastomer().spectrum.complex_modulus(omega)
    rows = [f"{one},{E.real},{E.imag}" for one, E in zip(omega, moduli, strict=True)]
    path = tmp_path / "curve.csv"
    path.write_text("\n".join([f"# {remark}", "omega (rad/s),E' (Pa),E'' (Pa)", *rows]), encoding="utf-8")
    curve = vf.read_master_curve(path, "30 degC", deformation="tension")
    assert vf.Material(vf.fit_retardation_spectrum(curve)).synthetic == synthetic
    path = vf.write_card(vf.Material(vf.synthetic_fluoroelastomer().spectrum), tmp_path / "a.inp", "abaqus")
    bare = "\n".join(line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("**"))
    path.write_text(f"** {remark}\n{bare}", encoding="utf-8")
    assert vf.rheology.open_card(path, modulus_unit="Pa", time_unit="s").material.synthetic == synthetic
