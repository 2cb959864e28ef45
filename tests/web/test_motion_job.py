"""The job of the step “Motion in time”: a history or an impact of the study's contact, as the library solves it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from viscofric.errors import ViscofricError
from viscofric.web.jobs import motion
from web.contact_studies import BALL, ROUGH, Desk

#: Numbers have seven digits.
ROUNDING = 1e-6
PRESSED = [{"time": 0.0, "value": 0.0}, {"time": 0.1, "value": 25.0}, {"time": 0.3, "value": 25.0}]


@pytest.fixture
def desk(tmp_path: Path) -> Desk:
    return Desk(tmp_path)


def rubber() -> vf.Material:
    return vf.catalogue_material("synthetic fluoroelastomer")


def test_a_history_has_the_numbers_of_the_library(desk: Desk) -> None:
    found = desk.run(motion, BALL, rows=PRESSED, temperature=333.15)
    history = vf.motion.History([0.0, 0.1, 0.3], load=[0.0, 25.0, 25.0], temperature=333.15)
    solved = vf.motion.solve_transient(rubber(), vf.Ball("9.525 mm"), history, times=[0.1, 0.3], accuracy=1e-2)
    rows = [found["time"].index(time) for time in (0.1, 0.3)]
    for name in ("load", "indentation", "contact_radius", "work", "dissipated"):
        # both are exact to 1 % in time; their steps differ
        assert np.array(found[name])[rows] == pytest.approx(getattr(solved, name), rel=2e-2, abs=1e-12)
    assert (found["geometry"], found["method"], found["interrupted"]) == ("point", "springs", 0)
    assert found["units"]["indentation"] == "m"
    assert found["energy_imbalance"] < 1e-3
    labels = [message for event, message in desk.reported if event == "progress"]
    assert labels[-1]["done"] == labels[-1]["total"] == 1.0
    assert labels[-1]["label"] == "300 ms of 300 ms"
    # the pressure along the motion is that of the load, at each time
    x, pressure = np.array(found["animation"]["x"]), np.array(found["animation"]["pressure"])
    assert pressure.shape == (len(found["animation"]["time"]), len(x))
    load = np.trapezoid(np.pi * np.abs(x) * pressure, x, axis=1)
    at = np.interp(found["animation"]["time"], found["time"], found["load"])
    assert load == pytest.approx(at, rel=0.02, abs=0.05)


def test_a_jump_is_drawn_before_and_after_it(desk: Desk) -> None:
    rows = [*PRESSED[1:], {"time": 0.3, "value": 0.0}, {"time": 0.4, "value": 0.0}]
    found = desk.run(motion, BALL, rows=rows)
    at = [load for time, load in zip(found["time"], found["load"], strict=True) if time == 0.3]
    assert at == pytest.approx([25.0, 0.0], abs=1e-9)
    assert found["dent"][-1] > 0.0


def test_a_history_has_the_coulomb_friction_that_is_given(desk: Desk) -> None:
    rows = [{"time": time, "value": 25.0, "along": 0.01 * time} for time in (0.0, 0.01)]
    found, without = (desk.run(motion, BALL, rows=rows, **more) for more in ({"coulomb": 0.2}, {}))
    assert "total_friction" not in without
    assert found["total_friction"][-1] == pytest.approx(found["friction_coefficient"][-1] + 0.2)
    assert found["friction_coefficient"] == without["friction_coefficient"]


def test_an_impact_has_the_numbers_of_the_library(desk: Desk) -> None:
    found = desk.run(motion, BALL, impact={"mass": 0.033, "speed": 0.5}, temperature=303.15)
    solved = vf.motion.solve_impact(
        rubber(), vf.Ball("9.525 mm"), mass=0.033, speed=0.5, temperature=303.15, accuracy=1e-2
    )
    (contact,) = found["contacts"]
    assert "animation" not in found  # an impact keeps no pressures
    assert contact["restitution"] == pytest.approx(solved.restitution, rel=ROUNDING)
    assert contact["contact_time"] == pytest.approx(solved.contact_time, rel=ROUNDING)


@pytest.mark.parametrize(
    ("study", "options", "code", "index"),
    [
        (BALL, {"rows": [PRESSED[1], PRESSED[0], PRESSED[2]]}, "time-goes-back", 1),
        (BALL, {"rows": PRESSED, "control": "pressure"}, "wrong-control", None),
        ({**BALL, "layer": {"thickness": "2 mm"}}, {"impact": {"mass": 0.1, "speed": 1.0}}, "not-available", None),
        (ROUGH, {"impact": {"mass": 0.1, "speed": 1.0}}, "rough-surface", None),
    ],
)
def test_what_cannot_be_solved_has_a_code_and_its_row(
    desk: Desk, study: dict[str, Any], options: dict[str, Any], code: str, index: int | None
) -> None:
    with pytest.raises(ViscofricError) as error:
        desk.run(motion, study, **options)
    assert error.value.code == code
    assert error.value.note.values.get("index") == index


def test_a_rough_surface_moves_along_its_direction(desk: Desk) -> None:
    small = {**ROUGH["surface"], "points": 16, "spacing": "80 um", "shortest": "320 um"}
    study = {**ROUGH, "surface": small, "conditions": {**ROUGH["conditions"], "direction": "90 deg"}}
    study["solver"] = {"accuracy": 0.1}
    rows = [{"time": 0.0, "value": 5e5, "along": 0.0}, {"time": 1e-3, "value": 5e5, "along": 1e-4}]
    found = desk.run(motion, study, rows=rows, control="pressure", path="position", before="sliding")
    assert (found["geometry"], found["method"]) == ("periodic", "waves")
    assert found["direction"] == pytest.approx([0.0, 1.0], abs=1e-9)
    assert found["position_y"][-1] == pytest.approx(1e-4)
    assert found["friction_coefficient"][-1] > 0.0
    assert found["figures"]["motion-pressure"]["x"]["label"] == "y"
    assert np.shape(found["animation"]["pressure"])[1] == len(found["animation"]["x"]) == 16
