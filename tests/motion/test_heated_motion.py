"""Contacts over time that their own friction heats."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.motion.heated import _loss_sizes
from viscofric.notes import note_of

RUBBER = vf.ThermalProperties("0.3 W/m/K", "1150 kg/m**3", "1700 J/kg/K", "rubber")
STEEL = vf.ThermalProperties("46 W/m/K", "7810 kg/m**3", "475 J/kg/K", "steel")
HEATING = vf.Heating(rubber=RUBBER, counterface=STEEL, coulomb=0.5)
OF_THE_FACE = replace(HEATING, average="contact")
BALL = vf.Ball("5 mm")


@pytest.mark.apart  # four runs on cells
def test_a_sliding_line_is_solved_at_the_temperature_that_its_heat_makes() -> None:
    spectrum = vf.Material.standard_linear_solid("2 MPa", "20 MPa", "2 ms").spectrum
    material = vf.Material(spectrum, shift=vf.Arrhenius("60 kJ/mol", reference="20 degC"))
    cylinder, asked, time = vf.Cylinder("5 mm"), [0.03, 0.045, 0.06], [0.0, 0.03, 0.06]
    history = vf.motion.History(time, load=2000.0, speed=[0.3, 0.3, 0.3], temperature="20 degC", before="at rest")
    run = vf.motion.solve_transient(material, cylinder, history, times=asked, accuracy=3e-2, heating=OF_THE_FACE)
    heat = run.heating
    assert heat is not None
    assert heat.temperature_rise.min() > 0.9
    assert "thin-skin" in {note_of(note).code for note in run.warnings}
    # The temperature of the last run, and what its heat makes of it.
    assert np.abs(run.temperature - 293.15 - heat.temperature_rise) == pytest.approx(heat.residual)
    assert heat.rubber_heat + heat.counterface_heat == pytest.approx(heat.coulomb_heat + heat.loss_heat)
    assert heat.coulomb_heat == pytest.approx(0.5 * 2000.0 * 0.3 * np.array(asked))
    assert run.total == pytest.approx(run.friction_coefficient + 0.5)
    # The same contact at a given temperature, that of the end: after many contact lengths nothing older counts.
    warm = vf.motion.History(
        time, load=2000.0, speed=[0.3, 0.3, 0.3], temperature=float(run.temperature[-1]), before="at rest"
    )
    given = vf.motion.solve_transient(material, cylinder, warm, times=asked, accuracy=3e-2)
    errors = given.errors.friction_force[-1] + run.errors.friction_force[-1]
    assert run.friction_force[-1] == pytest.approx(given.friction_force[-1], abs=errors)
    assert heat.isothermal_friction_force[-1] > run.friction_force[-1] + 5.0 * errors
    assert set(run.to_dataset()) >= {"temperature_rise", "temperature_rise_error", "isothermal_friction_force"}


@pytest.mark.slow
def test_the_loss_of_a_dent_that_recovers_is_not_released_on_the_last_of_its_contact() -> None:
    """The last thousandth of an unloading, in which 0.2 % of the heat is released, warms by no more than 1 %."""
    spectrum = vf.Material.standard_linear_solid("1 MPa", "10 MPa", "0.1 s").spectrum
    rubber = vf.Material(spectrum, shift=vf.Arrhenius("60 kJ/mol", reference="20 degC"))
    history = vf.motion.History([0.0, 0.5, 1.0], load=[0.0, 2.0, 0.0], temperature="20 degC")
    run = vf.motion.solve_transient(rubber, BALL, history, times=[0.999, 1.0], accuracy=5e-2, heating=HEATING)
    assert run.heating is not None
    assert run.contact_radius is not None
    assert run.contact_radius[-1] == 0.0
    assert run.heating.temperature_rise[1] == pytest.approx(run.heating.temperature_rise[0], rel=1e-2)


def test_loss_is_released_on_what_a_dent_was_pressed_with_until_it_has_recovered() -> None:
    """At 0.1 N, what was pressed with 10 N stays so wide; from no load, the dent has a fiftieth of the next energy."""
    rubber = vf.Material.standard_linear_solid("2 MPa", "4 MPa", "10 ms")
    history = vf.motion.History([0.0, 0.1, 0.2, 1.0, 1.1, 1.2], load=[0.0, 10.0, 0.1, 0.1, 0.0, 0.1])
    run = vf.motion.solve_transient(rubber, BALL, history, times=[0.0, 0.1, 0.2, 0.25, 1.0, 1.1, 1.2], accuracy=3e-2)
    assert run.contact_radius is not None
    found = _loss_sizes(SimpleNamespace(kind="ball"), run)  # type: ignore[arg-type]
    assert found[2:4] == pytest.approx(run.contact_radius[1], rel=1e-3)
    assert found[-1] == pytest.approx(run.contact_radius[-1], rel=2e-2)


@pytest.mark.apart  # four runs
def test_errors_include_what_the_last_rise_changes() -> None:
    """Bodies that hardly conduct, so that the loss of a pressed ball warms it by 0.3 K."""
    poor = vf.ThermalProperties("1 uW/m/K", "200 kg/m**3", "1000 J/kg/K", "poor")
    heating = vf.Heating(rubber=poor, counterface=poor)
    history = vf.motion.History([0.0, 0.5, 1.0], load=[0.0, 5.0, 1.0], temperature="20 degC")
    spectrum = vf.Material.standard_linear_solid("2 MPa", "20 MPa", "0.1 s").spectrum
    rubber = vf.Material(spectrum, shift=vf.Arrhenius("100 kJ/mol", reference="20 degC"))
    run = vf.motion.solve_transient(rubber, BALL, history, times=[0.5, 1.0], accuracy=3e-2, heating=heating)
    assert run.heating is not None
    assert run.heating.temperature_rise.min() > 0.3
    assert rubber.shift is not None
    shift = rubber.shift.log10(293.15 + run.heating.temperature_rise) - rubber.shift.log10(run.temperature)
    # Depth follows E to the power of 2/3, and E at most 1/τ: 1.5 per decade.
    assert np.all(run.errors.indentation > 1.5 * np.abs(shift) * run.indentation)
    assert np.all(run.errors.energy > 1.5 * np.abs(shift) * run.dissipated)


@pytest.mark.apart  # three runs
def test_the_rise_where_the_loss_is_released_holds_that_of_the_steady_contact_within_its_error() -> None:
    """Twice as large after 30 mm of sliding, with an error that was 0.6 % of it."""
    spectrum = vf.Material.standard_linear_solid("2 MPa", "20 MPa", "13 ms").spectrum
    rubber = vf.Material(spectrum, shift=vf.Arrhenius("60 kJ/mol", reference="20 degC"))
    state = {"load": 2.0, "temperature": 293.15}
    history = vf.motion.History([0.0, 0.04], load=2.0, speed=[0.73, 0.73], temperature=293.15, before="at rest")
    heated = vf.motion.solve_transient(rubber, BALL, history, times=[0.04], accuracy=5e-2, heating=HEATING).heating
    steady = vf.solve_steady(rubber, BALL, speed=0.73, **state, accuracy=1e-2, heating=HEATING).heating
    assert heated is not None
    assert steady is not None
    assert heated.temperature_rise[0] > 1.5 * steady.temperature_rise
    assert heated.temperature_rise[0] - steady.temperature_rise < heated.error[0]


def test_a_heated_contact_has_no_state_to_go_on_from_and_one_progress_of_all_its_runs() -> None:
    told: list[float] = []
    history = vf.motion.History([0.1, 0.3, 0.3, 1.0], load=[1.0, 1.0, 5.0, 5.0], temperature="20 degC")
    run = vf.motion.solve_transient(
        vf.synthetic_fluoroelastomer(), BALL, history, times=[0.5, 1.0], accuracy=5e-2, heating=HEATING,
        progress=lambda reached, end: told.append(reached),
    )  # fmt: skip
    assert run.heating is not None
    assert run.heating.loss_heat == pytest.approx(run.dissipated)
    # The rise by the loss is no better known than the place of the loss, and the loss.
    part = run.heating.error / run.heating.temperature_rise - 0.75
    assert np.all((run.errors.energy / run.dissipated <= part) & (part < 0.05))
    assert run.to_dataset()["temperature_rise_error"].values == pytest.approx(run.heating.error)
    assert told[0] < 0.55  # the first run takes half of the history
    assert (np.diff(told).min() >= 0.0, told[-1]) == (True, 1.0)
    with refused("not-available"):
        run.save_state("never.npz")


def test_what_cannot_be_heated_over_time_is_refused() -> None:
    material = vf.synthetic_fluoroelastomer()
    pressed = vf.motion.History([0.0, 1.0], load=1.0, temperature="20 degC")
    with refused("not-with-heating"):
        vf.motion.solve_transient(material, BALL, pressed, heating=HEATING, layer=vf.Layer("1 mm"))
    with refused("not-with-heating"):
        vf.motion.solve_transient(material, BALL, vf.motion.History([0.0, 1.0], load=1.0), heating=HEATING)
