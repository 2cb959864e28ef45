"""Friction on rough surfaces whose contact spots it heats."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.notes import codes

RUBBER = vf.ThermalProperties(0.3, 1200.0, 1500.0, "rubber")
STONE = vf.ThermalProperties(2.0, 2500.0, 800.0, "stone")
SOLID = vf.Material.standard_linear_solid(E0="3 MPa", E_inf="300 MPa", tau="1 ms")
WARM = vf.Material(SOLID.spectrum, shift=vf.WLF(C1=8.0, C2=100.0, reference=300.0))
HEATING = vf.Heating(rubber=RUBBER, counterface=STONE, coulomb=0.5, average="loss", nominal_radius="5 mm")
ASKED = {"speeds": [0.02, 0.5], "pressure": "0.2 MPa", "temperatures": 300.0}


def roads(points: int = 16) -> list[vf.Topography]:
    size, shortest = (points, points), 4e-3 / points
    return [
        vf.self_affine(0.8, shape=size, spacing=1e-3 / points, shortest=shortest, rms_slope=0.2, seed=seed)
        for seed in (1, 2)
    ]


@cache
def friction() -> tuple[vf.roughness.HeatedRoughFriction, list[tuple[int, int]]]:
    seen: list[tuple[int, int]] = []
    found = vf.predict_rough_friction(
        WARM, roads(), **ASKED, heating=HEATING, progress=lambda done, total: seen.append((done, total))
    )
    assert isinstance(found, vf.roughness.HeatedRoughFriction)
    return found, seen


@pytest.mark.slow
def test_every_contact_is_that_at_its_own_temperature() -> None:
    """Temperature, speed and surface belong together: the second surface at the second speed, by itself."""
    found, seen = friction()
    cold = vf.predict_rough_friction(WARM, roads(), **ASKED)
    assert found.isothermal_friction == pytest.approx(cold.friction_coefficient, rel=1e-12)
    rise = found.temperature_rise
    assert rise.shape == found.friction_coefficient.shape == (1, 2, 2)
    assert np.all(rise > 0.1)
    again = vf.predict_rough_friction(
        WARM, roads()[1], **ASKED | {"speeds": 0.5, "temperatures": 300.0 + float(rise[0, 1, 1])}
    )
    assert found.friction_coefficient[0, 1, 1] == pytest.approx(again.friction_coefficient[0, 0, 0], rel=1e-12)
    # What is left may be 1 % of the rise.
    assert found.coulomb_rise + found.loss_rise == pytest.approx(rise, rel=1.1e-2)
    assert np.all(found.face_rise > found.loss_weighted_rise)
    assert seen[0] == (0, 8)
    assert seen[-1] == (8, 8)


@pytest.mark.slow
def test_contact_spots_may_be_colder_than_the_mean_of_the_surface() -> None:
    """At a high speed the loss is released beside and behind them; the state is below zero, to 1 % of its rise."""
    rubber = vf.catalogue_material("synthetic tread rubber")
    track = vf.self_affine(
        0.8, shape=(64, 64), spacing="1 um", rolloff="64 um", shortest="8 um", rms_slope=0.25, seed=0
    )
    heating = vf.Heating(rubber=RUBBER, counterface=STONE, average="contact")
    found = vf.predict_rough_friction(
        rubber, track, speeds=[1.0, 10.0], temperatures="20 degC", pressure="0.4 MPa", heating=heating
    )
    assert isinstance(found, vf.roughness.HeatedRoughFriction)
    assert found.temperature_rise[0, 0, 0] > 0.0 > found.temperature_rise[0, 1, 0]
    assert found.loss_rise == pytest.approx(found.temperature_rise, rel=1.1e-2)
    assert np.array_equal(found.cold_rise, found.hot_rise)


@pytest.mark.slow
def test_one_state_is_cold_and_hot_and_a_data_set_holds_all() -> None:
    found, _ = friction()
    assert np.array_equal(found.cold_friction, found.friction_coefficient)
    assert np.array_equal(found.hot_rise, found.temperature_rise)
    data = found.to_dataset()
    assert data.temperature_rise.dims == data.friction_coefficient.dims
    assert data.isothermal_friction.attrs["units"] == "1"
    assert codes(found.notes) == {"frequencies-unknown", "rise-uncertain"}
    assert found.mean_friction_coefficient == pytest.approx(found.friction_coefficient.mean(-1))


@pytest.mark.slow
def test_the_heat_of_an_interface_is_its_stress_on_the_real_area() -> None:
    law = vf.friction.PowerShearStress(
        stress="3 MPa", exponent=0.1, speed="0.5 m/s", shift=vf.Arrhenius("80 kJ/mol", 300.0)
    )
    one = ASKED | {"speeds": 0.5}
    found = vf.predict_rough_friction(
        WARM, roads()[0], **one, heating=vf.Heating(rubber=RUBBER, counterface=STONE), interface=law
    )
    assert isinstance(found, vf.roughness.HeatedRoughFriction)
    warm = 300.0 + float(found.face_rise[0, 0, 0])
    stress = float(law(0.5, warm))
    assert found.interface_friction == pytest.approx(stress * found.corrected_area_fraction / 2e5)
    constant = vf.Heating(rubber=RUBBER, counterface=STONE, coulomb=float(found.interface_friction[0, 0, 0]))
    given = vf.predict_rough_friction(WARM, roads()[0], **one, heating=constant)
    # The residual of either may be 1 % of the rise.
    assert found.temperature_rise == pytest.approx(given.temperature_rise, rel=2e-2)
    assert "mean-heat-left-out" in codes(found.notes)
    with refused("not-with-heating"):
        vf.predict_rough_friction(WARM, roads()[0], **one, heating=constant, interface=law)


def test_what_cannot_be_heated_is_refused() -> None:
    for given, code in (
        ({"temperatures": None}, "no-shift"),
        ({"speeds": [0.1, 0.0]}, "elastic-limit"),
        ({"layer": vf.Layer("5 mm")}, "not-with-heating"),
    ):
        with refused(code):
            vf.predict_rough_friction(WARM, roads(), **ASKED | {"heating": HEATING} | given)


@pytest.mark.apart
def test_the_loss_warms_about_as_in_the_theory() -> None:
    """Over two decades of speed, in which both vary five-hundredfold, within a factor of three.

    Persson's theory follows one spot, half a wavelength across where P = 0.3, in which all heat is: here, a nominal
    contact of the radius of half that wavelength.  Means are those weighted with the loss.
    """
    road = vf.self_affine(0.8, shape=(128, 128), spacing=1e-3 / 128, shortest=6e-5, rms_slope=0.2, seed=3)
    heating = vf.Heating(rubber=RUBBER, counterface=STONE, average="loss", nominal_radius="0.25 mm")
    asked = {"speeds": [0.001, 0.01, 0.1], "pressure": "0.2 MPa", "temperatures": 300.0, "heating": heating}
    solved = vf.predict_rough_friction(WARM, road, **asked)
    alone = asked | {"heating": replace(heating, nominal_radius=None)}
    theory = vf.persson_theory(WARM, vf.roughness.power_spectrum(road), gamma=1.0, **alone)
    assert isinstance(solved, vf.roughness.HeatedRoughFriction)
    assert isinstance(theory, vf.roughness.HeatedPerssonTheory)
    ratio = solved.temperature_rise[0, :, 0] / theory.temperature_rise[0]
    assert np.all((ratio > 1.0 / 3.0) & (ratio < 3.0))
