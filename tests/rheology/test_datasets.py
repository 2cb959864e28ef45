"""Results as labelled data sets: numbers, units, and what is not known."""

from __future__ import annotations

import json
from importlib.resources import files

import numpy as np
import pytest

import viscofric as vf
from viscofric.errors import InputError
from viscofric.rheology.shifts.parametric_law import law_misfit
from viscofric.rheology.spectra.quality import SpectrumFit
from viscofric.rheology.superposition.kramers_kronig import kramers_kronig
from viscofric.rheology.superposition.overlap import OverlapQuality

WLF = vf.WLF(8.0, 100.0, "30 degC")


@pytest.fixture(scope="module")
def fit() -> vf.rheology.Superposition:
    sweeps = vf.read_dma(files("viscofric") / "example" / "dma.csv", deformation="tension")  # synthetic
    return vf.superpose(sweeps, reference="30 degC", vertical="free")


def test_typed_law_has_values_where_it_is_valid_and_no_errors() -> None:
    kelvin = [200.0, 303.15, 333.15]
    data = WLF.to_dataset(kelvin)
    np.testing.assert_allclose(data.log10_shift_factor, [np.nan, 0.0, -8.0 * 30.0 / 130.0])
    np.testing.assert_array_equal(data.temperature, kelvin)
    assert data.temperature.attrs == {"units": "K", "long_name": "temperature"}
    assert "standard_error" not in data
    assert (data.attrs["wlf_C1"], data.attrs["wlf_C2"]) == (8.0, 100.0)
    assert json.loads(data.attrs["constants"])["reference"] == 303.15


def test_law_with_a_covariance_has_standard_errors() -> None:
    data = vf.WLF(8.0, 100.0, 303.15, covariance=np.diag([0.01, 1.0])).to_dataset(["30 degC", "60 degC"])
    by_C1, by_C2 = 30.0 / 130.0, 8.0 * 30.0 / 130.0**2
    np.testing.assert_allclose(data.standard_error, [0.0, np.hypot(0.1 * by_C1, by_C2)])
    assert data.attrs["wlf_C1_error"] == pytest.approx(0.1)


def test_valid_where_log10_raises_nothing() -> None:
    kelvin = np.array([303.15, 333.15, 363.15])
    factors = vf.ShiftFactors(kelvin, WLF.log10(kelvin), 303.15)
    fitted = factors.law("arrhenius")
    vft = vf.VFT(800.0, 203.15, 303.15)
    polynomial = vf.InversePolynomial([5000.0], 303.15, fitted_range=(273.15, 363.15))
    asked = np.concatenate([np.linspace(190.0, 450.0, 131), kelvin, [203.15, 302.66, 363.64]])
    for law in (WLF, factors, fitted, vft, polynomial, vf.WLFArrhenius(17.4, 51.6, 255.0, 303.15)):
        raised = np.zeros(asked.shape, dtype=bool)
        for place, one in enumerate(asked.tolist()):
            try:
                law.log10(one)
            except InputError:
                raised[place] = True
        np.testing.assert_array_equal(law.valid_at(asked), ~raised, err_msg=type(law).__name__)
    assert WLF.valid_at("60 degC") is True
    assert vft.valid_at(203.65)
    assert not vft.valid_at(203.65, above_pole=1.0)


def test_values_and_covariance_of_a_table_and_of_a_law() -> None:
    kelvin = np.array([303.15, 333.15, 363.15])
    factors = vf.ShiftFactors(kelvin, WLF.log10(kelvin), 303.15, np.diag([0.0, 1e-4, 4e-4]))
    values, errors = factors.values_at([303.15, 333.15, 390.0])
    np.testing.assert_allclose(values, [0.0, WLF.log10(333.15), np.nan], atol=1e-15)
    np.testing.assert_allclose(errors, [0.0, 0.01, np.nan])
    np.testing.assert_allclose(factors.covariance_at(kelvin), factors.covariance, atol=1e-18)
    assert factors.has_standard_error
    assert not WLF.has_standard_error
    np.testing.assert_array_equal(WLF.values_at([333.15])[1], [0.0])
    np.testing.assert_array_equal(WLF.covariance_at([303.15, 333.15]), np.zeros((2, 2)))
    law = factors.law("wlf")
    spread = law.covariance_at(kelvin)
    np.testing.assert_allclose(np.sqrt(np.diag(spread)), law.standard_error(kelvin))
    with pytest.raises(InputError):
        factors.covariance_at([390.0])


def test_superposition_has_both_shifts_and_its_overlap(fit: vf.rheology.Superposition) -> None:
    data = fit.to_dataset()
    np.testing.assert_array_equal(data.log10_shift_factor, fit.shift_factors.log10_values)
    np.testing.assert_array_equal(data.standard_error, fit.shift_factors.standard_errors)
    np.testing.assert_allclose(data.log10_vertical_shift, fit.vertical_shift.log10_values, atol=1e-15)
    np.testing.assert_allclose(data.vertical_standard_error, fit.vertical_shift.standard_errors)
    assert data.attrs["overlap_rms_log10_storage"] == fit.quality.storage
    assert data.attrs["reference_temperature"] == 303.15
    assert json.loads(data.attrs["vertical_shift"])["kind"] == "VerticalShiftFactors"
    xarray_of_factors = fit.shift_factors.to_dataset()
    assert set(xarray_of_factors.data_vars) == {"log10_shift_factor", "standard_error"}


def test_check_and_causality(fit: vf.rheology.Superposition) -> None:
    data = fit.check.to_dataset()
    np.testing.assert_array_equal(data.temperature, fit.shift_factors.temperatures)
    assert (data.attrs["verdict"], data.attrs["holds"], data.attrs["consistent"]) == ("holds", 1, 1)
    causal = kramers_kronig(fit.master_curve)
    found = causal.to_dataset()
    np.testing.assert_array_equal(found.storage_deviation, causal.storage_deviation)
    judged = found.storage_deviation[found.judged.values == 1]
    assert float(np.sqrt((judged**2).mean())) == pytest.approx(found.attrs["rms_log10_storage"])


def test_density_shift_has_no_errors() -> None:
    data = vf.rheology.DensityShift(303.15, 0.0).to_dataset([303.15, 333.15])
    np.testing.assert_allclose(data.log10_vertical_shift, [0.0, np.log10(333.15 / 303.15)])
    assert "vertical_standard_error" not in data


def test_laws_in_the_order_of_their_criterion() -> None:
    kelvin = np.linspace(283.15, 363.15, 9)
    factors = vf.ShiftFactors(kelvin, WLF.log10(kelvin), 303.15, 1e-4 * np.eye(9))
    data = factors.compare_laws().to_dataset()
    assert data.law.values[0] == data.attrs["chosen"] == "WLF"
    assert data.information_criterion.values[0] == 0.0
    assert np.all(np.diff(data.information_criterion) >= 0.0)
    assert float(data.akaike_weight.values[data.law.values != "VFT"].sum()) == pytest.approx(1.0)


def test_spectra_as_modes_and_as_moduli() -> None:
    spectrum = vf.RetardationSpectrum("1 MPa", "10 MPa", [9e-7], [1e-3])
    modes = spectrum.to_dataset()
    assert (modes.retardation_time.values[0], modes.attrs["E0"]) == (1e-3, 1e6)
    assert modes.creep_coefficient.attrs["units"] == "1/Pa"
    prony = spectrum.to_relaxation().to_dataset()
    np.testing.assert_allclose([prony.relaxation_time.values[0], prony.modulus.values[0]], [1e-4, 9e6])
    curve = spectrum.modulus_dataset([1.0, 1e3])
    modulus = spectrum.complex_modulus([1.0, 1e3])
    np.testing.assert_array_equal(curve.storage_modulus + 1j * curve.loss_modulus, modulus)
    table = vf.rheology.ModulusTable([1.0, 1e3], modulus.real, modulus.imag).to_dataset()
    np.testing.assert_allclose(table.loss_modulus, modulus.imag)


def test_bands_over_frequency() -> None:
    materials = tuple(vf.Material.standard_linear_solid(E0, 1e8, 1e-3) for E0 in np.linspace(0.9e6, 1.1e6, 41))
    C = np.array([one.spectrum.C for one in materials])
    samples = vf.rheology.MaterialSamples(materials, C, np.full(C.shape, 1e-3), (1.0, 1e4))
    band, data = samples.modulus_band([1.0, 1e3], level=0.9), samples.to_dataset([1.0, 1e3], level=0.9)
    np.testing.assert_array_equal(data.storage_modulus_lower, band.lower.real)
    np.testing.assert_array_equal(data.loss_modulus_upper, band.upper.imag)
    assert "90 %" in data.storage_modulus_lower.attrs["long_name"]
    ends = samples.to_dataset([0.9, 1.0, 1e4, 1.1e4])
    assert ends.within_measured_frequencies.values.tolist() == [0.0, 1.0, 1.0, 0.0]
    assert samples.to_dataset([-1.0, -1.1e4]).within_measured_frequencies.values.tolist() == [1.0, 0.0]


def test_bands_beyond_the_measured_frequencies_have_a_note() -> None:
    """1 to 10⁴ rad/s were measured at 30 °C; at 60 °C α is 1/100, so that these are 100 to 10⁶ rad/s there."""
    law = vf.Arrhenius(activation_energy=1.2868e5, reference="30 degC")
    solids = [vf.Material.standard_linear_solid(E0, 1e8, 1e-3) for E0 in np.linspace(0.9e6, 1.1e6, 20)]
    materials = tuple(vf.Material(one.spectrum, shift=law) for one in solids)
    C = np.array([one.spectrum.C for one in solids])
    samples = vf.rheology.MaterialSamples(materials, C, np.full(C.shape, 1e-3), (1.0, 1e4))

    def noted(omega: object, temperature: str) -> list[tuple[str, float, float]]:
        band = samples.modulus_band(omega, temperature)
        lower, _, upper = band
        assert np.all(lower.real <= upper.real)
        return [(one.code, one.values["points"], one.values["of"]) for one in band.notes]

    assert noted([1.0, 1e4], "30 degC") == []
    assert noted([0.5, 1.0, 2e4], "30 degC") == [("beyond-measured", 2, 3)]
    assert noted([1.0, 200.0, 1e5], "60 degC") == [("beyond-measured", 1, 3)]
    assert noted(0.0, "30 degC") == [("beyond-measured", 1, 1)]


def test_measurements_and_master_curve(fit: vf.rheology.Superposition) -> None:
    sweeps = vf.IsothermalSweeps(fit.isotherms)
    data = sweeps.to_dataset()
    assert data.sizes["reading"] == sum(len(one) for one in fit.isotherms)
    first = data.storage_modulus[data.temperature.values == fit.isotherms[0].temperature]
    np.testing.assert_array_equal(first, fit.isotherms[0].storage_modulus)
    curve = fit.master_curve
    assert curve.to_dataset().attrs == {"reference_temperature": 303.15}
    spectrum = vf.fit_retardation_spectrum(curve)
    fitted = spectrum.master_curve_dataset(curve)
    np.testing.assert_array_equal(fitted.fitted_loss_modulus, spectrum.loss_modulus(curve.angular_frequency))
    away = np.log10(fitted.fitted_storage_modulus / fitted.storage_modulus)
    assert float(np.sqrt((away**2).mean())) == pytest.approx(fitted.attrs["rms_log10_storage"])


def test_small_misfits_hold() -> None:
    """Overlaps and spectra are good to 0.05 decades (12 %), laws of α to 0.1; neighbours without overlap are not."""
    assert OverlapQuality(0.05, 0.01, 10, 2).holds
    assert not OverlapQuality(0.01, 0.051, 10, 2).holds
    assert not OverlapQuality(0.0, 0.0, 0, 2, gaps=(1,)).holds
    fit = SpectrumFit(0.01, 0.051, False, False, (0.1, 10.0), rms_step=0.05)
    assert fit.modulus_misfit == {
        "rms_log10_storage": 0.01, "rms_log10_loss": 0.051, "misfit_holds": 0, "misfit_limit": 0.05,
    }  # fmt: skip
    assert fit.step_misfit == {"rms_log10_step": 0.05, "misfit_holds": 1, "misfit_limit": 0.05}
    assert SpectrumFit(None, None, False, False, (0.1, 10.0)).modulus_misfit == {}
    kelvin = np.array([293.15, 313.15])
    for away, holds in ((0.09, 1), (0.11, 0)):
        found = law_misfit(WLF, kelvin, WLF.log10(kelvin) + np.array([away, -away]))
        assert found == {"rms": pytest.approx(away), "misfit_holds": holds, "misfit_limit": 0.1}
