"""Contacts of rough surfaces that their own friction heats: closed forms of one wave, energy, and states."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.contact.fields import periodic_dissipation as dissipation
from viscofric.contact.fields.dissipation import Modes
from viscofric.contact.fields.periodic_dissipation import periodic_dissipation
from viscofric.contact.heating import thermal_resistances
from viscofric.contact.periodic.heating import periodic_resistances
from viscofric.heat.layers import MovingHeat, Waves
from viscofric.notes import codes

RUBBER = vf.ThermalProperties(0.3, 1200.0, 1500.0, "rubber")
STONE = vf.ThermalProperties(2.0, 2500.0, 800.0, "stone")
SOLID = vf.Material.standard_linear_solid(E0="3 MPa", E_inf="300 MPa", tau="1 ms")
WARM = vf.Material(SOLID.spectrum, shift=vf.WLF(C1=8.0, C2=100.0, reference=300.0))
HEATING = vf.Heating(rubber=RUBBER, counterface=STONE, coulomb=0.5)
PERIOD, POINTS, NU = 1e-3, 32, 0.3
Q, K, DIFFUSIVITY = 4.0 * np.pi / PERIOD, 0.3, RUBBER.diffusivity
ONE_MODE = Modes(np.array([9e-7]), np.array([1e-3]))
WAVES = Waves((POINTS, 1), (PERIOD, 1.0))


def road(points: int, shortest: float = 1.6e-4) -> vf.contact.PeriodicSurface:
    made = vf.self_affine(0.8, shape=(points, points), spacing=1e-3 / points, shortest=shortest, rms_slope=0.2, seed=1)
    return made.to_surface()


@cache
def heated(**heating: Any) -> vf.contact.PeriodicSolution:
    given = vf.Heating(**({"rubber": RUBBER, "counterface": STONE, "coulomb": 0.5, "average": "contact"} | heating))
    return vf.solve_periodic(WARM, road(16, 2.5e-4), speed=0.1, pressure="0.2 MPa", temperature=300.0, heating=given)


def one_wave(speed: float, step: float = 0.6) -> tuple[Any, complex]:
    """Return the layers of 1 + ½ cos(qx) of pressure, and the phase that the dashpot's stress has."""
    x = PERIOD * np.arange(POINTS) / POINTS
    found = periodic_dissipation((1e5 + 5e4 * np.cos(Q * x))[:, None], WAVES, ONE_MODE, NU, (speed, 0.0), step)
    phase = 1j * Q * speed * 1e-3
    return found, phase / (phase - 1.0)


@pytest.mark.parametrize("speed", [1e-3, 3e-2, 1.0])
def test_few_waves_and_modes_place_the_loss_as_all_of_them(speed: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Rises to 1/200 of that of the face by heat on it: waves are cut off where they lose 1/100 of their part."""
    material = vf.synthetic_fluoroelastomer()
    solution = vf.solve_periodic(material, road(64), speed=speed, pressure="0.2 MPa", temperature=303.15)
    spectrum = material.modes_at(303.15)
    modes = Modes(np.asarray(spectrum.C), np.asarray(spectrum.tau))
    few = periodic_resistances(solution, modes, 0.5, HEATING)
    for name, value in (("_FADED", 8.0), ("_TOP", 0.0), ("_TOGETHER", 2.5), ("_MARGIN", 20.0)):
        monkeypatch.setattr(dissipation, name, value)
    every = periodic_resistances(solution, modes, 0.5, HEATING)
    assert np.abs(np.subtract(few, every)).max() < 5e-3 * every.surface


@pytest.mark.parametrize("speed", [1e-3, 0.1, 10.0])
def test_one_wave_loses_what_its_friction_works(speed: float) -> None:
    """(q·v) Im S 2(1−ν²)/q |p|² of the wave: depths to 1e-4, cut off where 2e-4 is left."""
    found, response = one_wave(speed)
    expected = 9e-7 / 1e-3 * 5e4**2 * abs(response) ** 2 * (1.0 - NU**2) / Q
    assert found.mean.sum() == pytest.approx(expected, rel=5e-4)


@pytest.mark.parametrize("speed", [1e-3, 0.1])
def test_the_loss_of_one_wave_warms_as_in_its_closed_form(speed: float) -> None:
    """The varying part is A cos(2qx) exp(−2qz), A = C/τ p²|H|² (1+ν)(1−2ν): T = A/(k s (s + 2q)) on the face.

    Layers have an error of the second order in their step, 2 % at that used, but for the uppermost: 0.6 %.
    """
    root = np.sqrt(4.0 * Q**2 - 2j * Q * speed / DIFFUSIVITY)
    errors = []
    for step in (0.6, 0.3):
        layers, response = one_wave(speed, step)
        amplitude = 9e-7 / 1e-3 * 5e4**2 * response**2 * (1.0 + NU) * (1.0 - 2.0 * NU)
        expected = float((0.5 * amplitude / (K * root * (root + 2.0 * Q))).real)
        face = np.zeros(len(WAVES.magnitude), complex)
        face[np.isclose(WAVES.magnitude, 2.0 * Q)] = 0.5  # cos(2qx): its product with the rise has half the amplitude
        # Twice the wave number of the pressure, the fourth wave of the period is beyond those averaged.
        alone = MovingHeat(RUBBER, WAVES, (speed, 0.0)).rises(0.0 * face, face, layers)
        errors.append(abs(alone.loss / expected - 1.0))
    assert errors[0] < 0.025
    assert errors[1] < 0.4 * errors[0] + 7e-3


def test_heat_on_the_face_has_both_limits_of_the_peclet_number() -> None:
    """A wave of 1 W/m²: 1/(kq) at rest, Re 1/s = cos(45°)/(k √(qv/κ)) where it is fast."""
    wave = np.where(np.arange(len(WAVES.magnitude)) == 7, 0.5, 0.0).astype(complex)  # beyond those averaged
    q = float(WAVES.magnitude[7])
    slow, fast = (MovingHeat(RUBBER, WAVES, (v, 0.0)).surface_rise(wave, wave) for v in (1e-9, 1e3))
    assert slow == pytest.approx(0.5 / (K * q), rel=1e-4)
    assert fast == pytest.approx(0.5 * np.sqrt(0.5) / (K * np.sqrt(q * 1e3 / DIFFUSIVITY)), rel=1e-4)


@pytest.mark.slow
def test_a_lone_contact_is_as_warm_as_a_free_one() -> None:
    """A ball's pressure in a period of 16 radii, against cells of a free contact: 5 % of the face's, 15 % of the loss.

    They share neither sums, depths nor the window, in which the free one keeps 90 % of the loss.
    """
    solid = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="20 ms")
    contact = vf.solve_steady(solid, vf.Ball("10 mm"), speed=0.02, load=1.0, accuracy=1e-2)
    spectrum = solid.spectrum
    modes = Modes(np.asarray(spectrum.C), np.asarray(spectrum.tau))
    free = thermal_resistances(contact, modes, 0.5, vf.Heating(rubber=RUBBER, counterface=RUBBER))
    cells = contact.pressure[: len(contact.x) // 2 * 2, : len(contact.y) // 2 * 2]
    blocks = np.stack([cells, cells > 0.0]).reshape(2, len(cells) // 2, 2, -1, 2).mean((2, 4))
    step = 2.0 * float(contact.x[1] - contact.x[0])
    points = round(16.0 * np.sqrt(contact.contact_area / np.pi) / step)
    pressure, loaded = np.zeros((2, points, points))
    for one, coarse in zip((pressure, loaded), blocks, strict=True):
        one[: coarse.shape[0], : coarse.shape[1]] = coarse
    waves = Waves((points, points), (points * step, points * step))
    layers = periodic_dissipation(pressure, waves, modes, 0.5, (0.02, 0.0)).unit
    found = MovingHeat(RUBBER, waves, (0.02, 0.0)).rises(
        waves.of(pressure / pressure.mean()), waves.of(loaded / loaded.mean()), layers
    )
    area = (points * step) ** 2
    assert found.surface / area == pytest.approx(free.surface, rel=0.05)
    # The free mean is over the loss within its cells alone; that beyond is hardly warmer than the body.
    assert found.loss_below / area == pytest.approx((1.0 - free.beyond) * free.loss_below, rel=0.15)


@pytest.mark.slow
@pytest.mark.parametrize("direction", [(1.0, 0.0), (2.0, 1.0)])
def test_all_loss_of_a_rough_contact_is_released_below_it(direction: tuple[float, float]) -> None:
    """To 1e-3, of which waves at the Nyquist frequency, obliquely to the motion, are a part."""
    surface = road(64)
    solution = vf.solve_periodic(SOLID, surface, speed=0.1, pressure="0.2 MPa", direction=direction)
    velocity = 0.1 * solution.direction[0], 0.1 * solution.direction[1]
    spectrum = SOLID.spectrum
    modes = Modes(np.asarray(spectrum.C), np.asarray(spectrum.tau))
    found = periodic_dissipation(solution.pressure, Waves(surface.shape, surface.period), modes, 0.5, velocity)
    work = solution.friction_coefficient * solution.mean_pressure * 0.1
    assert found.mean.sum() == pytest.approx(work, rel=1e-3)


@pytest.mark.slow
def test_rises_of_a_rough_contact_converge_with_its_grid() -> None:
    """Spots of a smooth surface: differences, over the largest rise, fall to 1 % from 64 to 128 points."""
    modes = Modes(np.asarray(SOLID.spectrum.C), np.asarray(SOLID.spectrum.tau))
    coarse, fine, finest = (
        np.array(
            periodic_resistances(
                vf.solve_periodic(SOLID, road(points, 2.5e-4), speed=0.1, pressure="0.2 MPa"), modes, 0.5, HEATING
            )
        )
        for points in (32, 64, 128)
    )
    first, second = np.abs(coarse - finest).max() / finest.max(), np.abs(fine - finest).max() / finest.max()
    assert second < 0.012
    assert second < 0.5 * first
    assert fine[3] == pytest.approx(finest[3], rel=0.03)  # of the loss where it is released


@pytest.mark.slow
def test_the_contact_is_that_at_its_own_temperature() -> None:
    solution = heated()
    heat = solution.heating
    assert heat is not None
    again = vf.solve_periodic(
        WARM, road(16, 2.5e-4), speed=0.1, pressure="0.2 MPa", temperature=300.0 + solution.temperature_rise
    )
    assert solution.friction_coefficient == pytest.approx(again.friction_coefficient, rel=1e-12)
    assert solution.temperature == 300.0
    assert heat.temperature_rise > 0.3
    assert abs(heat.residual) <= 0.01 * heat.temperature_rise
    assert heat.coulomb_rise + heat.loss_rise == pytest.approx(heat.temperature_rise + heat.residual)
    assert heat.rubber_heat + heat.counterface_heat == pytest.approx(heat.coulomb_heat + heat.loss_heat, rel=1e-14)
    assert heat.coulomb_heat == pytest.approx(0.5 * 2e5 * 0.1)
    assert heat.loss_heat == pytest.approx(solution.friction_coefficient * 2e5 * 0.1)
    assert float(solution.to_dataset().face_rise) == heat.face_rise
    assert "mean-heat-left-out" in codes(solution.warnings)


def test_a_surface_that_is_repeated_across_the_motion_is_as_warm() -> None:
    """Deep down only waves that it does not have are left; rises to the step of the depths, which begin elsewhere."""
    x = 2.0 * np.pi * np.arange(16) / 16
    z = 1e-5 * (np.cos(x)[:, None] + np.cos(x))
    once, thrice = (
        vf.solve_periodic(
            WARM,
            vf.contact.PeriodicSurface(np.tile(z, (1, count)), 1e-5),
            speed=0.1,
            pressure="20 kPa",
            temperature=300.0,
            heating=HEATING,
        ).heating
        for count in (1, 3)
    )
    assert once is not None
    assert thrice is not None
    for name in ("temperature_rise", "face_rise", "loss_rise"):
        assert getattr(thrice, name) == pytest.approx(getattr(once, name), rel=0.01)


def test_ridges_along_the_motion_warm_the_face_alone() -> None:
    z = 1e-5 * np.cos(2.0 * np.pi * np.arange(32) / 32) * np.ones((8, 1))
    surface, given = vf.contact.PeriodicSurface(z, 1e-5), {"pressure": "20 kPa", "temperature": 300.0}
    found = vf.solve_periodic(WARM, surface, speed=0.1, heating=HEATING, **given).heating
    assert found is not None
    assert found.loss_heat < 1e-9 * found.coulomb_heat
    assert found.loss_weighted_rise == 0.0 < found.face_rise


@pytest.mark.slow
def test_the_nominal_contact_adds_the_rise_of_its_disc() -> None:
    """Of all Coulomb heat in the rubber, that of the face; its loss, released below, warms the face less."""
    whole = heated(nominal_radius="5 mm", average="loss").heating
    spots = heated(average="loss").heating
    assert whole is not None
    assert spots is not None
    disc = vf.heat.MovingHeatSource(
        whole.rubber_heat * np.pi * 0.005**2, "5 mm", speed=0.1, body=RUBBER, distribution="uniform"
    )
    added = whole.face_rise - spots.face_rise
    assert 0.5 * disc.mean_temperature < added < 1.1 * disc.mean_temperature
    assert "mean-heat-left-out" not in codes(heated(nominal_radius="5 mm", average="loss").warnings)


@pytest.mark.parametrize(
    ("given", "code"),
    [
        ({"speed": 0.0}, "elastic-limit"),
        ({"temperature": None, "material": SOLID}, "no-shift"),
        ({"layer": vf.Layer("5 mm")}, "not-with-heating"),
        ({"coulomb": 0.1}, "not-with-heating"),
        ({"heating": "warm"}, "wrong-type"),
        ({"heating": vf.Heating(rubber=RUBBER, counterface=STONE, track_radius=0.02, passes=3)}, "give-one"),
    ],
)
def test_what_has_no_heated_state_is_refused(given: dict[str, Any], code: str) -> None:
    asked = {"material": WARM, "speed": 0.1, "pressure": 1e5, "temperature": 300.0, "heating": HEATING, **given}
    with refused(code):
        vf.solve_periodic(asked.pop("material"), road(16, 5e-4), **asked)
