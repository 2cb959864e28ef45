"""Laws of the shear stress of a dry interface: values, derivatives, units, limits, and their fit."""

from __future__ import annotations

import numpy as np
import pytest

import viscofric as vf
from viscofric.rheology.interface.fitting import StressTable, compare_stress_laws, fit_stress

SHIFT = vf.Arrhenius("80 kJ/mol", "30 degC")
LAWS = (
    vf.friction.ConstantShearStress("0.3 MPa"),
    vf.friction.PowerShearStress("0.3 MPa", 0.2, "10 mm/s", shift=SHIFT),
    vf.friction.EyringShearStress("20 nm**3", "1 mm/s", shift=SHIFT),
    vf.friction.GaussianShearStress("0.5 MPa", "20 mm/s", 1.5, shift=SHIFT),
)
SPEED = np.logspace(-3.0, -0.5, 12)
KELVIN = np.array([293.15, 303.15, 323.15, 343.15])


def table(law, noise=0.0, seed=0):
    """Shear stress by a law with relative noise, as a table to fit."""
    v, T = np.tile(SPEED, KELVIN.size), np.repeat(KELVIN, SPEED.size)
    scatter = noise * np.random.default_rng(seed).standard_normal(v.size) / np.log(10.0)
    values = np.log10(law(v, T)) + scatter
    return StressTable.of(np.log10(v), T, values, np.eye(v.size) * max(noise / np.log(10.0), 1e-6) ** 2)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.kind)
def test_derivatives_are_those_of_the_stress(law):
    """Central differences of step 1e-5, whose error is 1e-9 of the third derivative."""
    x, step = np.log10(SPEED), 1e-5
    T = np.full(x.shape, 303.15)
    slope = (law._log10(x + step, T) - law._log10(x - step, T)) / (2.0 * step)
    np.testing.assert_allclose(law._slope(x), slope, atol=1e-8)
    for place, name in enumerate(law._adjusted):
        value = float(getattr(law, name))
        up, down = (type(law)(**{**constants(law), name: value * (1.0 + sign * step)}) for sign in (1.0, -1.0))
        change = (up._log10(x, T) - down._log10(x, T)) / (2.0 * step * value)
        np.testing.assert_allclose(law._gradient(x)[:, place] * value, change * value, atol=1e-8)


def constants(law):
    return {name: float(getattr(law, name)) for name in law._constants}


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.kind)
def test_exact_stress_gives_the_law_back(law):
    """To the square root of the fit's relative convergence of 1e-7 at least."""
    found = fit_stress(law.kind, table(law), None, 303.15, energy=True)
    np.testing.assert_allclose(np.log10(found.law(0.03, KELVIN)), np.log10(law(0.03, KELVIN)), atol=1e-4)
    if law.shift is not None:
        assert found.law.shift.activation_energy == pytest.approx(8e4, rel=1e-3)
        assert found.law.fitted_temperatures == (293.15, 343.15)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.kind)
def test_the_planted_law_is_chosen_and_lies_in_its_band(law):
    """Bands of three standard errors, of one fit each with fixed noise of 3 %."""
    compared = compare_stress_laws(table(law, 0.03, seed=2), None, 303.15, energy=True)
    assert compared.chosen.kind == law.kind
    assert compared.notes[0].code == "law-chosen"
    away = np.abs(np.log10(compared.best(SPEED, 313.15) / law(SPEED, 313.15)))
    assert np.all(away < 3.0 * compared.best.standard_error(SPEED, 313.15))
    lower, upper = compared.best.interval(0.01, 313.15)
    assert lower < compared.best(0.01, 313.15) < upper


def test_gaussian_is_that_of_persson():
    """τ = τ_p exp(−c log10(v/v_p)²) with c = 1/(2w²)."""
    law = vf.friction.GaussianShearStress(5e5, 0.02, 1.5)
    assert law(2.0) == pytest.approx(5e5 * np.exp(-(2.0**2) / (2.0 * 1.5**2)))


def test_eyring_is_linear_in_slow_and_logarithmic_in_fast_slip():
    law = vf.friction.EyringShearStress(2e-26, 1e-3, shift=SHIFT)
    stress = 1.380649e-23 * 303.15 / 2e-26
    assert law(1e-6, 303.15) == pytest.approx(1e-3 * stress, rel=1e-6)
    assert law(10.0, 303.15) == pytest.approx(stress * np.log(2e4), rel=1e-6)


@pytest.mark.parametrize("celsius", [-85.0, -83.0, -70.0, -52.0])  # 2500 to 200 decades of reduced speed
def test_eyring_is_logarithmic_where_the_shift_exceeds_all_floats(celsius):
    law = vf.friction.EyringShearStress(2e-26, 1e-3, shift=vf.VFT("2500 K", "187 K", "20 degC"))
    kelvin = celsius + 273.15
    decades = law.shift.log10(kelvin) + 1.0
    stress = 1.380649e-23 * kelvin / 2e-26
    assert law(1e-2, kelvin) == pytest.approx(stress * np.log(10.0) * (decades + np.log10(2.0)))
    rise = law(1e-1, kelvin) / law(1e-2, kelvin)
    assert rise == pytest.approx(1.0 + 1.0 / (decades + np.log10(2.0)))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("speed", [-2.0, np.log10(0.0137), 0.0])
def test_one_speed_at_several_temperatures_fixes_no_exponent(speed):
    kelvin = np.array([293.15, 313.15, 333.15])
    rows = StressTable.of(np.full(3, speed), kelvin, np.array([5.6, 5.4, 5.2]), 1e-4 * np.eye(3))
    with pytest.raises(vf.InputError) as refused:
        fit_stress("power", rows, None, 303.15, energy=True)
    assert refused.value.code == "no-law"
    compared = compare_stress_laws(rows, None, 303.15, energy=True)
    assert {row.kind for row in compared.rows if row.law is not None} <= {"constant", "eyring"}


def test_a_law_of_one_temperature_is_refused_at_another():
    rows = table(LAWS[1])
    here = rows.kelvin == 303.15
    one = StressTable.of(rows.speed[here], rows.kelvin[here], rows.values[here], 1e-6 * np.eye(here.sum()))
    law = fit_stress("power", one, None, 303.15, energy=False).law
    assert law.shift is None
    with pytest.raises(vf.InputError) as refused:
        law(0.01, 323.15)
    assert refused.value.code == "outside-fitted"
    assert fit_stress("constant", one, None, 303.15, energy=False).law(0.01, 323.15) > 0.0


def test_stress_beyond_all_numbers_is_refused_with_its_limits():
    law = vf.friction.PowerShearStress(
        3e5, 1.0, 0.01, shift=vf.VFT("1500 K", "200 K", "20 degC"), covariance=np.diag([1e8, 1e4])
    )
    for ask in (law, law.interval):
        with pytest.raises(vf.InputError) as refused:
            ask(0.01, 201.0)  # shifted by 644 decades
        assert refused.value.code == "too-large"
    assert law(10.0, 293.15) == pytest.approx(3e8)
    with pytest.raises(vf.InputError) as refused:
        law.interval(10.0, 293.15)  # ± 600 decades
    assert refused.value.code == "too-large"


def test_stress_without_a_maximum_has_no_gaussian_and_too_few_points_no_law():
    with pytest.raises(vf.InputError) as refused:
        fit_stress("gaussian", table(vf.friction.PowerShearStress(3e5, 0.2, 0.01)), None, 303.15, energy=False)
    assert refused.value.code == "no-law"
    few = StressTable.of(np.array([-2.0, -1.0]), np.full(2, 300.0), np.array([5.0, 5.1]), 1e-4 * np.eye(2))
    with pytest.raises(vf.InputError) as refused:
        fit_stress("gaussian", few, None, 300.0, energy=False)
    assert refused.value.code == "too-few-points"


def test_extrapolation_and_unknown_errors_are_known():
    law = vf.friction.PowerShearStress(
        3e5, 0.2, 0.01, shift=SHIFT, fitted_speeds=(1e-3, 0.1), fitted_temperatures=(290.0, 340.0)
    )
    assert law.extrapolates([0.01, 1.0], "30 degC").tolist() == [False, True]
    assert law.extrapolates(0.01, 350.0)
    with pytest.raises(vf.InputError) as refused:
        law.standard_error(0.01, 303.15)
    assert refused.value.code == "no-covariance"
    found = law.to_dataset(temperatures=[300.0, 310.0])["shear_stress"]
    assert found.dims == ("temperature", "speed")
    assert found.attrs["units"] == "Pa"


def test_levels_of_temperatures_whiten_with_the_covariance_factored_once(monkeypatch):
    """W C Wᵀ = 1 and ln det C, of the whole covariance."""
    random = np.random.default_rng(0)
    speed, kelvin = np.tile(np.linspace(-4.0, -1.0, 6), 4), np.repeat([303.15, 313.15, 323.15, 333.15], 6)
    mixed = 0.01 * random.standard_normal((24, 24))
    covariance = mixed @ mixed.T + 1e-4 * np.eye(24)
    table = StressTable.of(speed, kelvin, 5.5 + 0.1 * random.standard_normal(24), covariance)
    monkeypatch.setattr(np.linalg, "eigh", None)
    for level, scatter in ((0.0, 0.02), (0.1, 0.0), (0.3, 0.05)):
        whiten = table.levelled(level).whitening(scatter**2)
        whole = covariance + scatter**2 * np.eye(24) + level**2 * (kelvin[:, None] == kelvin)
        np.testing.assert_allclose(whiten(whiten(whole).T), np.eye(24), atol=1e-9)
        assert whiten.log_det == pytest.approx(np.linalg.slogdet(whole)[1], abs=1e-6)
    compare_stress_laws(table, None, 313.15, True)
