"""Friction curves of contacts that their own friction heats."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.notes import codes

RUBBER = vf.ThermalProperties(0.2, 1200.0, 1500.0, "rubber")
PTFE = vf.ThermalProperties(0.25, 2170.0, 1010.0, "PTFE")
SOLID = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
WARM = vf.Material(SOLID.spectrum, shift=vf.WLF(C1=8.0, C2=100.0, reference=300.0))
CYLINDER = vf.Cylinder("10 mm")
SPEEDS = [0.5, 2.0]
HEATING = vf.Heating(rubber=RUBBER, counterface=PTFE, coulomb=0.3, slip="0.5 m/s", average="contact")


@pytest.fixture(scope="module")
def curves() -> vf.friction.HeatedFrictionCurves:
    found = vf.predict_friction(
        WARM, CYLINDER, speeds=SPEEDS, temperatures=300.0, load=100.0, accuracy=1e-2, heating=HEATING
    )
    assert isinstance(found, vf.friction.HeatedFrictionCurves)
    return found


def test_a_curve_has_the_states_of_its_contacts(curves: vf.friction.HeatedFrictionCurves) -> None:
    """The isothermal contact at the temperature reached is the same one, to all digits."""
    assert curves.temperature_rise is not None
    rise = float(curves.temperature_rise[1])
    one, cold = (
        vf.solve_steady(WARM, CYLINDER, speed=2.0, temperature=kelvin, load=100.0, accuracy=1e-2)
        for kelvin in (300.0 + rise, 300.0)
    )
    assert rise > 0.2
    assert curves.viscoelastic[1] == pytest.approx(one.friction_coefficient, rel=1e-12)
    assert curves.isothermal_friction[1] == cold.friction_coefficient
    assert curves.temperature == pytest.approx(300.0)
    assert curves.coulomb_rise + curves.loss_rise == pytest.approx(curves.temperature_rise, rel=1e-2)


def test_a_rise_of_temperature_has_the_error_of_its_contact(curves: vf.friction.HeatedFrictionCurves) -> None:
    """Both are solved to the same residual, by other steps: 1 % of the rise, a third of the error at most."""
    one = vf.solve_steady(WARM, CYLINDER, speed=2.0, temperature=300.0, load=100.0, accuracy=1e-2, heating=HEATING)
    assert one.heating is not None
    assert curves.temperature_rise_error[1] == pytest.approx(one.heating.temperature_rise_error, rel=0.3)
    assert np.all((curves.temperature_rise_error > 0.0) & (curves.temperature_rise_error < curves.temperature_rise))
    data = curves.to_dataset()["temperature_rise_error"]
    assert data.attrs["units"] == "K"
    assert np.array_equal(data.values.ravel(), curves.temperature_rise_error)


def test_one_state_is_cold_and_hot_and_columns_are_kept(curves: vf.friction.HeatedFrictionCurves) -> None:
    assert np.array_equal(curves.cold_friction, curves.hot_friction)
    assert np.array_equal(curves.cold_friction, curves.viscoelastic)
    second = curves.select([1])
    assert isinstance(second, vf.friction.HeatedFrictionCurves)
    assert second.face_rise == curves.face_rise[1]
    data = curves.to_dataset()
    assert data.hot_rise.attrs["units"] == "K"
    assert data.isothermal_friction.dims == data.viscoelastic.dims


@pytest.mark.parametrize("average", ["contact", "loss"])
def test_the_heat_of_an_interface_is_its_stress_on_the_contact(average: Literal["contact", "loss"]) -> None:
    """The same contact under a constant coefficient τ A/F, at the temperature of the face, is as warm."""
    law = vf.friction.PowerShearStress(
        stress="30 kPa", exponent=0.1, speed="0.5 m/s", shift=vf.Arrhenius("80 kJ/mol", 300.0)
    )
    warming = vf.Heating(rubber=RUBBER, counterface=PTFE, slip="0.5 m/s", average=average)
    one = {"speeds": 2.0, "temperatures": 300.0, "load": 100.0, "accuracy": 1e-2}
    found = vf.predict_friction(WARM, CYLINDER, **one, heating=warming, interface=law)
    assert isinstance(found, vf.friction.HeatedFrictionCurves)
    warm = 300.0 + found.face_rise
    assert found.face_rise[0] > 0.2
    assert (found.temperature_rise[0] > 0.2) == (average == "contact")
    assert found.coulomb == pytest.approx(law(0.5, warm) / found.mean_pressure)
    assert found.total == pytest.approx(found.coulomb + found.viscoelastic)
    constant = vf.Heating(
        rubber=RUBBER, counterface=PTFE, coulomb=float(found.coulomb[0]), slip="0.5 m/s", average=average
    )
    given = vf.predict_friction(WARM, CYLINDER, **one, heating=constant)
    # The residual of either may be 1 % of the rise.
    assert found.temperature_rise == pytest.approx(given.temperature_rise, rel=2e-2)
    assert found.face_rise == pytest.approx(given.face_rise, rel=2e-2)
    for refused_one in (constant, "warm"):
        with refused("heating"):
            vf.predict_friction(WARM, CYLINDER, **one, heating=refused_one, interface=law)


@pytest.mark.apart
@pytest.mark.parametrize("average", ["contact", "loss"])
def test_many_speeds_are_interpolated_as_accurately_as_asked(average: Literal["contact", "loss"]) -> None:
    """Beside each contact solved by itself: within both stated errors, and 1 % of the rise, its residual."""
    asked = {"speeds": np.geomspace(0.05, 5.0, 30), "temperatures": 300.0, "load": 400.0, "accuracy": 1e-2}
    heating = replace(HEATING, average=average)
    found, each = (
        vf.predict_friction(WARM, CYLINDER, **asked, heating=heating, exact=exact) for exact in (False, True)
    )
    assert isinstance(found, vf.friction.HeatedFrictionCurves)
    assert isinstance(each, vf.friction.HeatedFrictionCurves)
    assert each.face_rise.max() > 1.0
    assert not np.array_equal(found.viscoelastic, each.viscoelastic)
    assert np.all(np.abs(found.viscoelastic - each.viscoelastic) <= found.viscoelastic_error + each.viscoelastic_error)
    assert np.all(found.viscoelastic_error <= 1.01e-2 * found.viscoelastic)
    assert found.isothermal_friction == pytest.approx(each.isothermal_friction, rel=2e-2)
    assert found.temperature_rise == pytest.approx(each.temperature_rise, rel=1e-2)
    assert found.mean_pressure == pytest.approx(each.mean_pressure, rel=1e-2)
    assert found.temperature == pytest.approx(300.0)


@pytest.mark.slow
def test_an_interface_that_shears_harder_when_warm_has_a_hot_branch() -> None:
    """Far above the speed of its largest stress; a law that ends below the hot face leaves the cold state."""
    asked = {"speeds": [0.5, 1.0], "load": 100.0, "temperatures": 300.0, "accuracy": 0.1}
    ends = vf.Arrhenius("120 kJ/mol", 300.0, covariance=[[1e6]], fitted_range=(298.0, 302.0))
    found = {}
    for shift in (vf.Arrhenius("120 kJ/mol", 300.0), ends):
        law = vf.friction.GaussianShearStress("3 MPa", "1 mm/s", 0.7, shift=shift)
        for branch in ("cold", "hot"):
            heating = vf.Heating(rubber=RUBBER, counterface=PTFE, slip="0.5 m/s", branch=branch)
            if shift is ends and branch == "hot":
                with refused("beyond-interface"):
                    vf.predict_friction(WARM, CYLINDER, **asked, interface=law, heating=heating)
                continue
            one = vf.predict_friction(WARM, CYLINDER, **asked, interface=law, heating=heating)
            assert isinstance(one, vf.friction.HeatedFrictionCurves)
            assert one.coulomb == pytest.approx(law(0.5, 300.0 + one.face_rise) / one.mean_pressure)
            found[shift is ends, branch] = one
    cold, hot, held = found.values()
    assert hot.face_rise[0] > 50.0 > 0.1 > cold.face_rise[0]
    assert hot.face_rise[1] == pytest.approx(cold.face_rise[1])  # one state
    assert held.face_rise == pytest.approx(cold.face_rise)
    assert "two-thermal-states" in codes(cold.notes)
    assert "states-beyond" in codes(held.notes)


def test_heating_is_refused_with_samples_and_columns_are_checked(curves: vf.friction.HeatedFrictionCurves) -> None:
    with refused("not-with-heating"):
        vf.predict_friction(WARM, CYLINDER, speeds=1.0, temperatures=300.0, load=1.0, samples=object(), heating=HEATING)
    for column in (curves.hot_rise[:1], np.array([1.0, np.nan])):
        with refused("wrong-length"):
            replace(curves, hot_rise=column)


@pytest.mark.apart
def test_a_ramp_of_speed_shows_hysteresis() -> None:
    """Cold rubber on the glassy side of its peak: on a track, its loss can keep it warm enough to lose as much."""
    glassy = vf.Material.standard_linear_solid("1 MPa", "1 GPa", "1 s")
    material = vf.Material(glassy.spectrum, shift=vf.WLF(C1=15.0, C2=60.0, reference="0 degC"))
    heating = vf.Heating(rubber=RUBBER, counterface=PTFE, slip=0.0, track_radius="23 mm", passes=1000, average="loss")
    found = vf.predict_friction(
        material, vf.Ball("10 mm"), speeds=[0.5, 4.0, 16.0], temperatures="-5 degC", load="5 N", accuracy=2e-2,
        heating=heating,
    )  # fmt: skip
    assert isinstance(found, vf.friction.HeatedFrictionCurves)
    hotter = found.hot_rise > found.cold_rise + 1.0
    assert hotter.tolist() == [False, True, True]
    assert np.all(found.hot_friction[1:] > 100.0 * found.cold_friction[1:])
    assert np.all(found.track_rise <= found.temperature_rise)
    assert found.cold_friction == pytest.approx(found.isothermal_friction, rel=0.05)
