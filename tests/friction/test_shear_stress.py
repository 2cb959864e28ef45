"""Shear stress of an interface from separated friction, and the friction of other contacts that follows from it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import viscofric as vf
from viscofric.contact.coupling import sheared_compliance
from viscofric.friction.coulomb import with_interface
from viscofric.notes import codes, note_of

RUBBER = vf.synthetic_fluoroelastomer()
TRUE = vf.friction.GaussianShearStress("0.4 MPa", "4 mm/s", 1.2, shift=vf.Arrhenius("70 kJ/mol", "60 degC"))
SPEED = np.geomspace(0.01, 0.3, 9)
KELVIN = np.array([323.15, 333.15, 343.15])
N = SPEED.size * KELVIN.size


def curves(**columns):
    """Curves over the speeds and temperatures, without meaning but for what is given."""
    empty = {f"viscoelastic{name}": np.full(N, 0.02) for name in ("", "_error", "_scatter")}
    speed, kelvin = np.tile(SPEED, KELVIN.size), np.repeat(KELVIN, SPEED.size)
    return vf.FrictionCurves(speed, kelvin, np.full(N, 5.0), **empty, replicates=np.full(N, 9), **columns)


#: Contacts whose pressures are made up.
CONTACTS = curves(mean_pressure=3e5 * np.tile(SPEED, KELVIN.size) ** 0.05, mean_pressure_error=np.full(N, 1e3))


def measured(noise=0.02, seed=0, slip=0.1):
    """Synthetic Coulomb friction of the planted law at a part of the speed as slip."""
    speed = slip * CONTACTS.speed
    true = TRUE(speed, CONTACTS.temperature) / CONTACTS.mean_pressure
    scatter = 1.0 + noise * np.random.default_rng(seed).standard_normal(N)
    return curves(coulomb=true * scatter, coulomb_error=noise * true, slip=speed)


@pytest.fixture(scope="module")
def stress():
    return vf.friction.shear_stress(measured(), CONTACTS, reference="60 degC")


def test_stress_is_friction_times_the_mean_pressure_of_the_solved_contact(stress):
    np.testing.assert_allclose(stress.shear_stress, measured().coulomb * CONTACTS.mean_pressure)
    np.testing.assert_allclose(stress.speed, 0.1 * CONTACTS.speed)
    # The error estimate of a solved contact is a limit: of 1.96 standard errors.
    area = 1e3 / 1.95996 / stress.mean_pressure
    relative = np.hypot(0.02 * TRUE(stress.speed, stress.temperature) / stress.shear_stress, area)
    np.testing.assert_allclose(stress.error / stress.shear_stress, relative)
    found = stress.to_dataset()
    assert found["shear_stress"].attrs["units"] == "Pa"
    assert found.attrs["reference_temperature"] == pytest.approx(333.15)


def test_the_interface_has_shift_factors_of_its_own(stress):
    """Within four standard errors of the planted ones, as nothing is selected."""
    assert stress.found
    away = stress.shift.log10_values - TRUE.shift.log10(stress.shift.temperatures)
    assert np.all(np.abs(away) < 4.0 * np.sqrt(np.diag(stress.shift.covariance)) + 1e-9)
    assert stress.overlap.rms < 0.1


def test_the_planted_law_comes_back(stress):
    compared = stress.compare_laws()
    assert compared.chosen.kind == "gaussian"
    law = compared.best
    assert law.peak == pytest.approx(4e5, abs=3.0 * law.standard_errors[0])
    assert law.shift.activation_energy == pytest.approx(7e4, abs=3.0 * law.standard_errors[-1])
    assert law.fitted_pressures == (stress.mean_pressure.min(), stress.mean_pressure.max())
    assert stress.law("gaussian") == law


def test_shared_errors_widen_the_law_by_their_size(stress):
    """An error of all areas is one of the peak alone; that of each temperature is one of the energy."""
    areas = vf.friction.shear_stress(measured(), CONTACTS, shift=TRUE.shift, area_error=0.1).law("gaussian")
    bare = vf.friction.shear_stress(measured(), CONTACTS, shift=TRUE.shift).law("gaussian")
    assert areas.standard_errors[0] / areas.peak == pytest.approx(
        np.hypot(0.1, bare.standard_errors[0] / bare.peak), rel=1e-3
    )
    assert areas.standard_errors[2] == pytest.approx(bare.standard_errors[2], rel=1e-3)
    levels = vf.friction.shear_stress(measured(), CONTACTS, reference="60 degC", level_error=0.1).law("gaussian")
    assert levels.standard_errors[-1] > 1.1 * stress.law("gaussian").standard_errors[-1]


@pytest.mark.apart
def test_levels_of_temperatures_that_nothing_states_are_in_the_errors():
    """With levels of 5 %, 95 % intervals of the constants held 45, 65, 85 and 62 %."""
    kelvin = np.linspace(313.15, 353.15, 5)
    speed, temperature = np.tile(SPEED, 5), np.repeat(kelvin, 9)
    empty = {f"viscoelastic{name}": np.full(45, 0.02) for name in ("", "_error", "_scatter")}

    def made(**columns):
        return vf.FrictionCurves(speed, temperature, np.full(45, 5.0), **empty, replicates=np.full(45, 9), **columns)

    contacts, true = (
        made(mean_pressure=np.full(45, 3e5), mean_pressure_error=np.ones(45)),
        TRUE(0.1 * speed, temperature),
    )
    away, noted = [], 0
    for seed in range(40):
        random = np.random.default_rng(seed)
        scatter = 1.0 + 0.02 * random.standard_normal(45)
        levels = np.repeat(np.exp(0.05 * random.standard_normal(5)), 9)
        rubbed = made(coulomb=true / 3e5 * scatter * levels, coulomb_error=0.02 * true / 3e5, slip=0.1 * speed)
        stress = vf.friction.shear_stress(rubbed, contacts, reference="60 degC")
        law = stress.law("gaussian")
        away.append((np.array(law.parameters) - TRUE.parameters) / law.standard_errors)
        noted += "level-scatter" in codes(law.notes)
    assert noted >= 36
    # Of 40 each: three standard deviations of 0.95.
    assert np.all(np.mean(np.abs(away) < 1.96, axis=0) > 0.84)


def test_a_level_of_one_temperature_is_noted_with_its_size():
    stress = vf.friction.shear_stress(measured(0.01), CONTACTS, reference="60 degC")
    assert "level-scatter" not in codes(stress.compare_laws().notes)
    raised = replace(measured(0.01), coulomb=measured(0.01).coulomb * np.repeat([1.0, 1.15, 1.0], SPEED.size))
    found = vf.friction.shear_stress(raised, CONTACTS, reference="60 degC").compare_laws()
    [note] = [one for one in map(note_of, found.notes) if one.code == "level-scatter"]
    assert note in found.best.notes  # also of the law alone
    # Levels of 0, 15 and 0 % scatter by 8 %, less what the law follows.
    assert note.values["level"] == pytest.approx(np.log10(1.08), rel=0.5)


def test_points_without_slip_are_left_out_and_missing_slip_is_noted():
    rolling = measured()
    slip = np.where(np.arange(N) < 3, 0.0, rolling.slip)
    found = vf.friction.shear_stress(replace(rolling, slip=slip), CONTACTS, shift=TRUE.shift)
    assert len(found) == N - 3
    assert {note.code for note in found.notes} == {"left-out"}
    found = vf.friction.shear_stress(replace(rolling, slip=None), CONTACTS, shift=TRUE.shift)
    assert {note.code for note in found.notes} == {"slip-assumed"}


@pytest.mark.parametrize("part", [0.4, 0.9])
def test_stress_near_zero_is_fitted_as_it_is(part):
    """A constant stress known absolutely, with errors of 40 or 90 %: the weighted mean, and its error."""
    error = part * 3e5 / CONTACTS.mean_pressure
    true = 3e5 / CONTACTS.mean_pressure
    known = replace(measured(), coulomb=true + error * np.random.default_rng(2).standard_normal(N), coulomb_error=error)
    stress = vf.friction.shear_stress(replace(known, coulomb_freedom=None), CONTACTS, shift=TRUE.shift)
    assert len(stress) == N
    assert np.count_nonzero(stress.shear_stress < 4.0 * stress.error) > N // 2
    law = stress.law("constant")
    weight = 1.0 / stress.error**2
    expected, spread = np.average(stress.shear_stress, weights=weight), 1.0 / np.sqrt(np.sum(weight))
    # Points are fitted by their logarithm from ten standard errors on: none is. Errors are those of their temperature.
    assert law.stress == pytest.approx(expected, abs=0.1 * spread)
    assert law.standard_errors[0] == pytest.approx(spread, rel=0.1)


def test_stress_that_no_point_shows_is_refused_unless_all_show_it_together():
    """Points of one standard error each: 27 of them are 5 together, 9 of them 3."""
    rubbed = replace(measured(), coulomb=0.1 * np.ones(N), coulomb_error=0.1 * np.ones(N))
    assert len(vf.friction.shear_stress(rubbed, CONTACTS, shift=TRUE.shift)) == N
    with pytest.raises(vf.InputError) as refused:
        vf.friction.shear_stress(rubbed.select(np.arange(9)), CONTACTS, shift=TRUE.shift)
    assert refused.value.code == "no-points"


def test_stress_of_one_level_has_no_shift_factors_and_is_constant():
    level = 3e5 / CONTACTS.mean_pressure * (1.0 + 0.02 * np.random.default_rng(1).standard_normal(N))
    flat = vf.friction.shear_stress(replace(measured(), coulomb=level, coulomb_error=0.02 * level), CONTACTS)
    assert flat.shift is None
    assert [note.code for note in flat.notes] == ["no-shift-factors"]
    assert flat.compare_laws().chosen.kind == "constant"


@pytest.mark.parametrize(
    ("given", "code"),
    [
        ((CONTACTS, CONTACTS), "no-coulomb"),
        ((measured(), measured()), "no-pressure"),
        ((measured(), CONTACTS.select(np.arange(5))), "no-prediction"),
    ],
)
def test_what_is_missing_is_named(given, code):
    with pytest.raises(vf.InputError) as refused:
        vf.friction.shear_stress(*given)
    assert refused.value.code == code


def test_predicted_friction_has_hysteresis_and_interface():
    """μ = τ_s A/F with the area of the contact; the hysteresis is that of the contact alone."""
    case = {"load": "200 N/m", "accuracy": 0.1}
    law = vf.friction.ConstantShearStress(2e5, covariance=[[1e8]])
    both = vf.predict_friction(RUBBER, vf.Cylinder("10 mm"), speeds=0.1, temperatures=333.15, **case, interface=law)
    alone = vf.solve_steady(RUBBER, vf.Cylinder("10 mm"), speed=0.1, temperature=333.15, **case)
    assert both.viscoelastic[0] == alone.friction_coefficient
    assert both.coulomb[0] == pytest.approx(2e5 * alone.contact_area / 200.0)
    assert both.total[0] == pytest.approx(both.viscoelastic[0] + both.coulomb[0])
    relative = np.hypot(0.05, alone.diagnostics.contact_area_error / alone.contact_area / 1.95996)
    assert both.coulomb_error[0] == pytest.approx(relative * both.coulomb[0])
    assert both.total_error[0] == pytest.approx(np.hypot(both.coulomb_error[0], both.viscoelastic_error[0]))
    assert {note.code for note in both.notes} == {"interface-law", "interface-share", "frequencies-unknown"}


def test_the_interface_slips_at_its_own_speed_and_says_where_it_is_extrapolated():
    power = vf.friction.PowerShearStress(2e5, 0.5, 0.02, fitted_speeds=(1e-3, 1e-2), fitted_pressures=(1e3, 2e3))
    sliding, rolling = with_interface(CONTACTS, power), with_interface(CONTACTS, power, "20 mm/s")
    np.testing.assert_allclose(rolling.coulomb, 2e5 / CONTACTS.mean_pressure)
    np.testing.assert_allclose(sliding.coulomb / rolling.coulomb, (CONTACTS.speed / 0.02) ** 0.5)
    codes = {note.code for note in rolling.notes}
    assert codes >= {"interface-extrapolated", "interface-pressure", "interface-without-error"}


@pytest.mark.parametrize(
    ("poisson_ratio", "layer", "noted"),
    [
        (0.5, None, False),
        (0.3, None, True),
        (0.5, vf.Layer("50 mm"), False),
        (0.5, vf.Layer("1 mm"), True),
        (0.5, vf.Layer("1 mm", bonded=False), True),
    ],
)
def test_shear_that_changes_friction_is_noted_with_its_size(poisson_ratio, layer, noted):
    """The estimate of `viscofric.contact.coupling` at the state of each contact."""
    rubber = replace(RUBBER, poisson_ratio=poisson_ratio)
    case = {"speeds": 0.1, "temperatures": 333.15, "load": 5.0, "accuracy": 2e-2, "layer": layer}
    found = vf.predict_friction(rubber, vf.Ball("10 mm"), interface=vf.friction.ConstantShearStress(2e5), **case)
    notes = [note for note in found.notes if note.code == "tangential-coupling"]
    assert len(notes) == noted
    if noted:
        radius = float(np.sqrt(5.0 / found.mean_pressure[0] / np.pi))
        change = 1.25 * sheared_compliance(rubber.modes_at(333.15), poisson_ratio, layer, radius, 0.1) * 2e5
        assert notes[0].values["change"] == pytest.approx(change)
        assert notes[0].values["share"] == pytest.approx(change / found.viscoelastic[0])


def test_interface_and_slip_belong_together():
    case = {"speeds": 0.1, "temperatures": 333.15, "load": 100.0}
    for more, code in (({"slip": 0.1}, "interface-needed"), ({"interface": 3e5}, "wrong-type")):
        with pytest.raises(vf.InputError) as refused:
            vf.predict_friction(RUBBER, vf.Cylinder("10 mm"), **case, **more)
        assert refused.value.code == code
