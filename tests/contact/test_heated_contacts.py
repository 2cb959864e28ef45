"""Contacts that their own friction heats: where heat is released, what it warms, and states that agree with it."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.contact.fields.dissipation import Modes, dissipation
from viscofric.contact.fields.periodic_dissipation import periodic_dissipation
from viscofric.contact.heating import thermal_resistances
from viscofric.heat.layers import LayeredHeat, Waves
from viscofric.notes import codes

RUBBER = vf.ThermalProperties(0.3, 1200.0, 1500.0, "rubber")
PTFE = vf.ThermalProperties(0.25, 2170.0, 1010.0, "PTFE")
SOLID = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
WARM = vf.Material(SOLID.spectrum, shift=vf.WLF(C1=8.0, C2=100.0, reference=300.0))
BALL, CYLINDER = vf.Ball("10 mm"), vf.Cylinder("10 mm")
HEATING = vf.Heating(rubber=RUBBER, counterface=PTFE, coulomb=0.5, slip="0.5 m/s", average="contact")
STATE: dict[str, Any] = {"speed": 1.0, "load": 100.0, "temperature": 300.0, "accuracy": 1e-2}


@cache
def line(**heating: Any) -> vf.contact.ContactSolution:
    given = {"rubber": RUBBER, "counterface": PTFE, "coulomb": 0.5, "slip": "0.5 m/s", "average": "contact", **heating}
    return vf.solve_steady(WARM, CYLINDER, **STATE, heating=vf.Heating(**given))


def released(contact: vf.contact.ContactSolution, tau: float, room: float) -> tuple[LayeredHeat, float]:
    """Return the layers of loss below a contact repeated after so many half-widths, and their sum over μFv."""
    half, step = float(np.sqrt(contact.contact_area / np.pi)), float(contact.x[1] - contact.x[0])
    if contact.geometry == "line":
        half = 0.5 * contact.contact_area
    points, width = round(room * half / step), contact.pressure.shape[1]
    pressure = np.zeros((points, 1 if width == 1 else points))
    pressure[: len(contact.x), :width] = contact.pressure
    waves = Waves(pressure.shape, (points * step, 1.0 if width == 1 else points * step))
    modes = Modes(np.array([9e-7]), np.array([tau]))
    found = periodic_dissipation(pressure, waves, modes, 0.5, (contact.speed, 0.0))
    nominal = waves.period[0] * waves.period[1]
    return found, float(found.mean.sum()) * nominal / (contact.friction_force * contact.speed)


@pytest.mark.parametrize(("tau", "room"), [(1e-4, 80.0), (1e-3, 320.0)])
def test_the_loss_released_below_is_the_work_of_friction(tau: float, room: float) -> None:
    """To 1e-3; of contacts that repeat themselves less is released, by 1/room², 1.4e-3 of the second one at 80."""
    solid = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau=tau)
    contact = vf.solve_steady(solid, CYLINDER, speed=1.0, load=100.0)
    assert released(contact, tau, room)[1] == pytest.approx(1.0, abs=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(("indenter", "load", "tau"), [(CYLINDER, 100.0, 4e-4), (BALL, 1.0, 2e-3)])
def test_the_depth_of_the_loss_is_that_taken_over_time(indenter: vf.Indenter, load: float, tau: float) -> None:
    """Density z exp(−z/b), of which 1 − (1 + z/b) exp(−z/b) lies above z, within 0.1, for a memory near a."""
    solid = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau=tau)
    contact = vf.solve_steady(solid, indenter, speed=1.0, load=load, accuracy=1e-2)
    line = contact.geometry == "line"
    half = 0.5 * contact.contact_area if line else float(np.sqrt(contact.contact_area / np.pi))
    assert 0.4 < tau / half < 2.0
    shape = 0.65 if line else 0.5
    layers, _ = released(contact, tau, 160.0 if line else 12.0)
    depth, above = np.cumsum(layers.thickness) / half, np.cumsum(layers.mean) / layers.mean.sum()
    for place in (0.25, 0.5, 1.0):
        taken = 1.0 - (1.0 + place / shape) * np.exp(-place / shape)
        assert np.interp(place, depth, above) == pytest.approx(taken, abs=0.1)


def test_few_modes_lose_what_many_do() -> None:
    """Twenty modes a decade replaced by those at a ratio of 2.5: the loss within 0.5 %, a sum of the fitted ones."""
    many = Modes(np.full(161, 1e-8), np.geomspace(1e-7, 10.0, 161))
    few = many.merged(1e-5, 1e-1)  # as for frequencies from 50/0.1 s to 0.05/10 µs
    assert len(few.C) < 14
    for omega in (5e2, 1e3, 5e3):
        loss = [np.sum(C * tau * omega**2 / (1.0 + (omega * tau) ** 2)) for C, tau in (many, few)]
        assert loss[1] == pytest.approx(loss[0], rel=5e-3)
    assert np.sum(few.C) < np.sum(many.C)
    two = Modes(np.array([1e-8, 2e-8, 0.0]), np.array([1e-3, 3e-3, 4e-3])).merged(1e-4, 1e-2)
    assert two.tau.tolist() == [1e-3, 3e-3]


def test_cells_below_a_line_contact_lose_the_work_of_friction() -> None:
    """In a window of 120 half-widths, beyond which lies 1/120; the pressure is accurate to 1e-3."""
    contact = vf.solve_steady(SOLID, CYLINDER, speed=1.0, load=100.0)
    half, step = 0.5 * contact.contact_area, float(contact.x[1] - contact.x[0])
    beside = round(60.0 * half / step)
    x = contact.x[0] + step * (np.arange(len(contact.x) + 2 * beside) - beside)
    pressure = np.pad(contact.pressure, ((beside, beside), (0, 0)))
    modes = Modes(np.array([9e-7]), np.array([1e-3]))
    found = dissipation(x, contact.y, pressure, modes, 0.5, contact.speed, half)
    assert float(found.power.sum()) / (contact.friction_force * contact.speed) == pytest.approx(1.0, abs=1e-2)


@pytest.mark.parametrize(("tau", "near"), [(1e-4, 0.92), (1e-3, 0.81), (1e-2, 0.50), (1e-1, 0.34)])
def test_the_cells_hold_their_part_of_a_long_memory(tau: float, near: float) -> None:
    """Of 64 cells along the contact with the stress to 3 half-widths ahead, the loss within the window; to 0.05."""
    solid = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau=tau)
    contact = vf.solve_steady(solid, CYLINDER, speed=1.0, load=100.0)
    found = thermal_resistances(contact, Modes(np.array([9e-7]), np.array([tau])), 0.5, HEATING)
    assert 1.0 - found.beyond == pytest.approx(near, abs=0.05)


def released_below(contact: vf.contact.ContactSolution, modes: Modes) -> float:
    """Return the loss in the whole half-space below a line contact, W/m, summed over waves without end."""
    step, pressure = float(contact.x[1] - contact.x[0]), contact.pressure[:, 0]
    wave = np.geomspace(1e-5 / (len(pressure) * step + contact.speed * modes.tau.max()), 40.0 / step, 2000)
    load = np.exp(-1j * np.multiply.outer(wave, contact.x)) @ pressure * step * np.sinc(0.5 * step / np.pi * wave)
    lag = np.multiply.outer(wave * contact.speed, modes.tau)
    loss = (modes.C * lag / (1.0 + lag**2)).sum(1)
    return float(1.5 * contact.speed / np.pi * np.trapezoid(np.abs(load) ** 2 * loss * wave, np.log(wave)))


@pytest.mark.parametrize("seed", [1, pytest.param(60, marks=pytest.mark.apart)])
def test_all_of_the_loss_is_released_over_the_whole_memory(seed: int) -> None:
    """The loss below random contacts without end is friction times speed, to 1e-3: twice the accuracy of the contact.

    The sum over waves leaves out more beyond the cells than the friction does.
    """
    generator = np.random.default_rng(seed)
    for _ in range(seed):
        count = int(generator.integers(1, 5))
        tau, C = 10.0 ** generator.uniform(-5.0, -1.0, count), 10.0 ** generator.uniform(-7.0, -6.0, count)
        solid = vf.Material(vf.RetardationSpectrum(1.0 / (1e-7 + C.sum()), 1e7, C, tau))
        load = float(10.0 ** generator.uniform(1.0, 3.0))
        contact = vf.solve_steady(solid, CYLINDER, speed=1.0, load=load, accuracy=5e-4)
        loss = released_below(contact, Modes(C, tau))
        assert loss == pytest.approx(contact.friction_force * contact.speed, rel=1e-3)


def released_below_ball(contact: vf.contact.ContactSolution, modes: Modes) -> float:
    """Return the same below a ball, W, of waves in all directions."""
    steps = np.array([contact.x[1] - contact.x[0], contact.y[1] - contact.y[0]])
    wave = np.geomspace(1e-4 / (len(contact.x) * steps[0] + contact.speed * modes.tau.max()), 40.0 / steps[0], 1200)
    node, weight = np.polynomial.legendre.leggauss(40)
    found = 0.0
    for sine, part in zip(0.5 * (1.0 + node), 0.5 * weight, strict=True):
        along, across = wave * np.sqrt(1.0 - sine**2), wave * sine
        load = np.exp(-1j * np.multiply.outer(along, contact.x)) @ contact.pressure
        load = np.sum(load * np.exp(-1j * np.multiply.outer(across, contact.y)), axis=1) * steps.prod()
        load *= np.sinc(0.5 * steps[0] / np.pi * along) * np.sinc(0.5 * steps[1] / np.pi * across)
        lag = np.multiply.outer(along * contact.speed, modes.tau)
        loss = (modes.C * lag / (1.0 + lag**2)).sum(1)
        found += part * float(np.trapezoid(np.abs(load) ** 2 * loss * wave**2, np.log(wave)))
    return 1.5 * contact.speed / np.pi**2 * found


@pytest.mark.apart
def test_all_of_the_loss_below_random_balls_is_released() -> None:
    """Friction times speed, to 1e-3: the accuracy of the contact; memories from 1/20 of the radius to 100 of it."""
    generator = np.random.default_rng(1)
    for _ in range(4):
        count = int(generator.integers(1, 5))
        tau, C = 10.0 ** generator.uniform(-4.0, -1.0, count), 10.0 ** generator.uniform(-7.0, -6.0, count)
        solid = vf.Material(vf.RetardationSpectrum(1.0 / (1e-7 + C.sum()), 1e7, C, tau))
        contact = vf.solve_steady(solid, BALL, speed=1.0, load=float(10.0 ** generator.uniform(-1.0, 1.0)))
        loss = released_below_ball(contact, Modes(C, tau))
        assert loss == pytest.approx(contact.friction_force * contact.speed, rel=1e-3)


def test_a_ball_warms_like_a_disc_of_its_area() -> None:
    """Hertz's pressure nearly, on 18 cells along the contact: 1 % of the rise of discs on both bodies."""
    contact = vf.solve_steady(SOLID, BALL, speed=0.02, load=1.0, accuracy=1e-2)
    modes = Modes(np.array([9e-7]), np.array([1e-3]))
    found = thermal_resistances(contact, modes, 0.5, vf.Heating(rubber=RUBBER, counterface=PTFE, slip=0.015))
    radius = np.sqrt(contact.contact_area / np.pi)
    rubber, other = (vf.heat.MovingHeatSource(1.0, radius, v, body) for v, body in ((0.02, RUBBER), (0.005, PTFE)))
    assert found.surface == pytest.approx(rubber.mean_temperature, rel=0.01)
    assert found.counterface == pytest.approx(other.mean_temperature, rel=0.01)
    # A counterface that is the faster one passes at |v − slip| too.
    overtaken = thermal_resistances(contact, modes, 0.5, vf.Heating(rubber=RUBBER, counterface=PTFE, slip=-0.015))
    passed = vf.heat.MovingHeatSource(1.0, radius, 0.035, PTFE)
    assert overtaken.counterface == pytest.approx(passed.mean_temperature, rel=0.01)
    assert 0.0 < found.loss < found.loss_below < found.surface
    # Nearly the same both ways per heat near the contact: the loss of a short memory is about as much ahead as behind.
    assert found.loss / (1.0 - found.beyond) == pytest.approx(found.surface_below, rel=0.2)


def test_the_contact_is_that_at_its_own_temperature() -> None:
    """The isothermal contact at the temperature reached is the same one, to all digits."""
    contact = line()
    heat = contact.heating
    assert heat is not None
    again = vf.solve_steady(WARM, CYLINDER, **STATE | {"temperature": 300.0 + contact.temperature_rise})
    assert contact.friction_coefficient == pytest.approx(again.friction_coefficient, rel=1e-12)
    assert contact.temperature == pytest.approx(300.0)
    assert contact.temperature_rise == heat.temperature_rise > 0.2
    assert 0.0 < abs(heat.residual) <= 0.01 * heat.temperature_rise < heat.temperature_rise_error
    # What the residual leaves in the friction is part of its error, by the slope among contacts accurate to 2 %.
    off = vf.solve_steady(WARM, CYLINDER, **STATE | {"temperature": 300.0 + contact.temperature_rise + heat.residual})
    left = abs(off.friction_coefficient - contact.friction_coefficient)
    assert contact.friction_error - again.friction_error == pytest.approx(left, rel=0.5)
    assert heat.coulomb_rise + heat.loss_rise == pytest.approx(heat.temperature_rise + heat.residual)
    assert heat.isothermal_friction == vf.solve_steady(WARM, CYLINDER, **STATE).friction_coefficient


def test_what_the_error_of_the_rise_does_to_friction_is_noted() -> None:
    """1.2 %: warmer by 0.14 K at once, friction changes by 1.6 %, and heats less; its stated error is 0.14 %."""
    contact = line(coulomb=5.0)
    assert contact.heating is not None
    (note,) = [one for one in contact.warnings if one.code == "rise-uncertain"]
    assert note.values["rise_error"] == contact.heating.temperature_rise_error
    kelvin = 300.0 + contact.temperature_rise + contact.heating.temperature_rise_error
    warmer = vf.solve_steady(WARM, CYLINDER, **STATE | {"temperature": kelvin})
    felt = 1.0 - warmer.friction_coefficient / contact.friction_coefficient
    assert 0.7 * felt < note.values["severity"] < felt
    assert "rise-uncertain" not in codes(line().warnings)


def test_all_heat_is_accounted_for() -> None:
    heat = line().heating
    assert heat is not None
    assert heat.coulomb_heat == pytest.approx(0.5 * 100.0 * 0.5)
    assert heat.loss_heat == pytest.approx(line().friction_force * 1.0)
    assert heat.rubber_heat + heat.counterface_heat == pytest.approx(heat.coulomb_heat + heat.loss_heat, rel=1e-14)
    assert 0.0 < heat.loss_beyond < heat.loss_heat
    assert heat.other_rise is None


@pytest.mark.parametrize(
    ("speed", "average", "noted"), [(30.0, "loss", True), (30.0, "contact", True), (1.0, "loss", False)]
)
def test_loss_that_does_not_warm_the_contact_is_noted_where_it_matters(speed: float, average: Any, noted: bool) -> None:
    """Memory of 0.4 and 12 half-widths; half of the loss is left behind, the other half changes friction by 2 %."""
    stiff = replace(
        vf.Material.standard_linear_solid(E0="10 MPa", E_inf="1 GPa", tau="1 ms"), shift=vf.WLF(15.0, 50.0, 303.15)
    )
    heating = vf.Heating(rubber=RUBBER, counterface=RUBBER, average=average)
    contact = vf.solve_steady(
        stiff, CYLINDER, speed=speed, load=4e4, temperature=303.15, heating=heating, accuracy=1e-2
    )
    heat = contact.heating
    assert heat is not None
    share = heat.loss_beyond / heat.loss_heat
    assert (share > 0.2) is noted
    notes = [note for note in contact.warnings if note.code == "loss-beyond"]
    assert len(notes) == noted
    for note in notes:
        assert note.values["share"] == pytest.approx(share)
        assert note.values["rise"] == pytest.approx(heat.temperature_rise)
        bound = 1.0 - share if average == "loss" else 1.0 / (1.0 - share)
        # All heat is that of the loss; the rise differs from that produced by the residual.
        assert note.values["bound"] == pytest.approx(bound * heat.temperature_rise, rel=2e-2)


@pytest.mark.slow
def test_the_skin_is_warmer_than_the_rubber_that_dissipates() -> None:
    """At a Péclet number of some thousands: said in a note where the mean of the face was chosen."""
    face, inner = line(), line(average="loss")
    assert face.heating is not None
    assert inner.heating is not None
    assert face.heating.face_rise > 20.0 * face.heating.loss_weighted_rise > 0.0
    assert inner.temperature_rise == pytest.approx(inner.heating.loss_weighted_rise, rel=1e-2)
    assert "thin-skin" in codes(face.warnings)
    assert "thin-skin" not in codes(inner.warnings)
    isothermal = face.heating.isothermal_friction
    assert abs(inner.friction_coefficient / isothermal - 1.0) < 0.1 * abs(face.friction_coefficient / isothermal - 1.0)


def test_a_data_set_holds_the_heat() -> None:
    data = line().to_dataset()
    assert float(data.temperature_rise) == line().temperature_rise
    assert data.counterface_heat.attrs["units"] == "W"
    assert "other_rise" not in data


@pytest.mark.parametrize(
    ("given", "code"),
    [
        ({"speed": 0.0}, "elastic-limit"),
        ({"temperature": None}, "no-shift"),
        ({"layer": vf.Layer("5 mm")}, "not-with-heating"),
        ({"derivatives": True}, "not-with-heating"),
        ({"heating": vf.Heating(rubber=RUBBER, counterface=PTFE, track_radius=0.02, passes=3)}, "line-track"),
    ],
)
def test_what_has_no_heated_state_is_refused(given: dict[str, Any], code: str) -> None:
    with refused(code):
        vf.solve_steady(WARM, CYLINDER, **{**STATE, "heating": HEATING, **given})


def test_a_search_for_states_ends_where_the_law_of_the_interface_does() -> None:
    """Fitted up to 302 K, it holds some 20 K farther: a state below is found, with a note; one above is refused."""
    ends = (298.0, 302.0)
    shift = vf.Arrhenius("90 kJ/mol", 300.0, covariance=[[1e6]], fitted_range=ends)
    heating = vf.Heating(rubber=RUBBER, counterface=PTFE, slip="0.5 m/s")
    asked = {"speeds": [0.5, 1.0], "load": 100.0, "temperatures": 300.0, "accuracy": 0.1, "heating": heating}

    def friction(stress: str) -> vf.FrictionCurves:
        law = vf.friction.PowerShearStress(stress=stress, exponent=0.1, speed="0.5 m/s", shift=shift)
        return vf.predict_friction(WARM, CYLINDER, interface=law, **asked)

    mild, unbounded = friction("20 kPa"), shift.unbounded()
    law = vf.friction.PowerShearStress(stress="20 kPa", exponent=0.1, speed="0.5 m/s", shift=unbounded)
    free = vf.predict_friction(WARM, CYLINDER, interface=law, **asked)
    assert isinstance(mild, vf.friction.HeatedFrictionCurves)
    assert isinstance(free, vf.friction.HeatedFrictionCurves)
    np.testing.assert_allclose(mild.temperature_rise, free.temperature_rise, rtol=1e-2)
    assert "states-beyond" not in codes(mild.notes)
    with refused("beyond-interface"):
        friction("5 MPa")


def test_a_contact_hotter_than_the_shift_is_known_is_refused() -> None:
    known = vf.ShiftFactors([295.0, 300.0, 301.0], [0.3, 0.0, -0.06], 300.0)
    rubber = vf.Material(SOLID.spectrum, shift=known)
    mild = vf.solve_steady(rubber, CYLINDER, **STATE, heating=HEATING)
    assert mild.heating is not None
    assert mild.heating.temperature_rise == pytest.approx(0.49, abs=0.01)  # below the end
    with refused("beyond-shift"):
        vf.solve_steady(rubber, CYLINDER, **STATE, heating=replace(HEATING, coulomb=3.0))
