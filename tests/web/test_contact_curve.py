"""Friction curves of the page: the numbers of ``viscofric run``, told while they are solved, with their doubts."""

from __future__ import annotations

import shutil
from importlib.resources import as_file, files
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.errors import ViscofricError
from viscofric.friction.cases.record import MEANING
from viscofric.web.jobs import curve
from viscofric.web.study_text import study_text
from web.contact_studies import BALL, CYLINDER, ROUGH, Desk

#: Numbers have six digits.
ROUNDING = 1e-5


@pytest.fixture
def desk(tmp_path: Path) -> Desk:
    return Desk(tmp_path)


def ran(document: dict[str, Any], folder: Path) -> Any:
    """Return the prediction of what ``viscofric run`` makes of the page's run file."""
    path = folder / "study.toml"
    path.write_text(study_text(document), encoding="utf-8")
    return vf.run_study(path).dataset


@pytest.mark.apart
def test_curve_is_that_of_the_exported_run_file(desk: Desk, tmp_path: Path) -> None:
    study = {**BALL, "solver": {"accuracy": 0.1, "master_curve_points": 5}}
    answer = desk.run(curve, study)
    stored = ran(study, tmp_path)
    for column, name in (
        ("friction", "friction_coefficient"),
        ("indentation", "indentation"),
        ("error", "friction_error"),
    ):
        np.testing.assert_allclose(answer[column], stored[name].values.ravel(), rtol=ROUNDING)
    np.testing.assert_allclose(answer["speed"], np.tile(stored["speed"].values, 2), rtol=ROUNDING)
    np.testing.assert_allclose(answer["temperature"], np.repeat(stored["temperature"].values, 6))
    assert any(answer["interpolated"])
    assert answer["interpolated"] == stored["interpolated"].values.ravel().astype(bool).tolist()
    # Along the master curve α(T)·v counts, at the reference temperature.
    assert answer["reference"] == pytest.approx(303.15)
    assert answer["reduced_speed"][:6] == answer["speed"][:6]
    assert answer["master"]["reduced_speed"][-1] == pytest.approx(max(answer["reduced_speed"]), rel=ROUNDING)


@pytest.mark.apart
def test_a_rubber_made_of_sweeps_has_the_bands_and_doubts_of_the_run_file(desk: Desk, tmp_path: Path) -> None:
    study = {
        **BALL,
        "material": {"dma": "dma.csv", "deformation": "tension", "reference_temperature": "30 degC", "shift": "wlf"},
        "conditions": {**BALL["conditions"], "speed": ["20 mm/s", "1e9 m/s"], "temperature": ["60 degC", "240 degC"]},
        "solver": {"accuracy": 0.1, "master_curve_points": 2},
        "uncertainty": {"draws": 20},
    }
    with as_file(files("viscofric.templates") / "paper" / "dma.csv") as sweeps:
        for folder in (desk.context.files, tmp_path):
            shutil.copy(sweeps, folder / "dma.csv")
    answer = desk.run(curve, study)
    stored = ran(study, tmp_path)
    np.testing.assert_allclose(answer["lower"], stored["friction_lower"].values.ravel(), rtol=ROUNDING)
    np.testing.assert_allclose(answer["upper"], stored["friction_upper"].values.ravel(), rtol=ROUNDING)
    # At 1e9 m/s the rubber is a glass that no sweep reached; 220 °C is the last sweep.
    extrapolated = ["extrapolated" in words for words in answer["doubts"]]
    assert np.all(np.array(answer["lower"]) < answer["friction"])
    assert np.all(np.array(answer["friction"]) < answer["upper"])
    assert extrapolated == [not within for within in stored["within_measured_frequencies"].values.ravel()]
    assert extrapolated[:2] == [False, True]
    assert ["shift" in words for words in answer["doubts"]] == [False, False, True, True]
    assert any("240 °C" in sentence for sentence in answer["warnings"])


def test_points_come_before_the_end_and_are_then_what_was_given(desk: Desk) -> None:
    speeds = {"from": "1 mm/s", "to": "1 m/s", "points": 20}
    study = {**BALL, "conditions": {**BALL["conditions"], "speed": speeds, "temperature": "60 degC"}}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(curve, "_BETWEEN_PARTS", 0.0)
        answer = desk.run(curve, study)
    layout, *parts = desk.parts
    assert layout["layout"] == {name: answer[name] for name in layout["layout"]}
    assert len(parts) > 10
    # A few at a time: the first of them after two contacts.
    assert 0 < len(parts[0]["cases"]) < 10
    reported: dict[int, tuple[float, bool]] = {}
    for part in parts:
        reported |= {at: pair for at, *pair in zip(part["cases"], part["friction"], part["known"], strict=True)}  # type: ignore[misc]
    assert sorted(reported) == list(range(20))
    for at, (friction, known) in reported.items():
        # Within the accuracy where it was said to be; drafts lie between contacts a factor of e² apart.
        assert friction == pytest.approx(answer["friction"][at], rel=0.01 if known else 0.2)
    progress = [message["done"] for event, message in desk.reported if event == "progress"]
    assert progress == sorted(progress)
    assert progress[-1] <= 20


def test_the_same_again_takes_what_was_solved(desk: Desk) -> None:
    solved: list[object] = []
    first = desk.run(curve, BALL)
    denser = {
        **BALL,
        "conditions": {**BALL["conditions"], "speed": {"from": "20 mm/s", "to": "200 mm/s", "points": 11}},
    }
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("viscofric.friction.cases.solving.solve_steady", lambda *given, **more: solved.append(given))
        assert desk.run(curve, BALL) == first
    assert solved == []
    # Points that were there are as they were, to the accuracy; contacts about them serve those between.
    again = desk.run(curve, denser)
    np.testing.assert_allclose(again["friction"][0:11:2], first["friction"][:6], rtol=0.01)


def test_each_combination_is_a_curve_of_its_own(desk: Desk) -> None:
    study = {
        **BALL,
        "indenter": {"radius": ["5 mm", "9.525 mm"]},
        "conditions": {**BALL["conditions"], "load": ["10 N", "25 N"], "speed": ["20 mm/s", "50 mm/s"]},
        "sweep": {"together": [["load", "radius"]]},
        "solver": {"accuracy": 0.1},
    }
    answer = desk.run(curve, study)
    assert answer["combinations"] == ["10 N, radius 5 mm", "25 N, radius 9.525 mm"]
    assert answer["combination"] == [0] * 4 + [1] * 4
    assert answer["master"] is None  # there are two


def test_wide_contacts_and_failed_ones_are_marked(desk: Desk) -> None:
    # The rubber is a glass at the higher speed and the lower temperature only.
    conditions = {"load": "40 kN", "speed": ["20 mm/s", "10 m/s"], "temperature": ["-30 degC", "60 degC"]}
    study = {**BALL, "conditions": conditions, "solver": {"accuracy": 0.1, "cases": "each", "master_curve_points": 2}}
    answer = desk.run(curve, study)
    failed = [words == ["failed"] for words in answer["doubts"]]
    assert any(failed)
    assert [friction is None for friction in answer["friction"]] == failed
    assert len(answer["failures"]) == failed.count(True)
    assert {one["code"] for one in answer["failure_records"]} == {"beyond-indenter"}
    assert answer["doubts"][1] == ["extrapolated", "large-strain"]  # a glass beyond all of its modes
    assert answer["warnings"] != []
    assert [one["verdict"] for one in answer["checks"] if one["name"] == "small contact"] == ["warning"]
    with refused("nothing-solved", ViscofricError):
        desk.run(curve, {**study, "conditions": {**conditions, "load": "1 GN"}})


def test_points_say_which_assumption_is_doubtful(desk: Desk) -> None:
    """Adhesion under a small load, inertia of a rubber as fast as its waves; neither is a large strain."""
    conditions = {"load": ["0.1 mN", "1 N"], "speed": ["20 mm/s", "100 m/s"], "temperature": "60 degC"}
    study = {**BALL, "conditions": conditions, "solver": {"accuracy": 0.1, "cases": "each", "master_curve_points": 2}}
    answer = desk.run(curve, study)
    found = [{word for word in words if word != "extrapolated"} for words in answer["doubts"]]
    assert found == [{"adhesion"}, {"adhesion", "quasi-static"}, set(), {"quasi-static"}]
    assert {"adhesion", "quasi-static"} <= {one["code"] for one in answer["warning_records"]}


def test_surfaces_whose_grid_is_too_coarse_are_marked(desk: Desk) -> None:
    coarse = {**ROUGH["surface"], "points": 32, "spacing": "40 um", "shortest": "100 um"}
    study = {**ROUGH, "surface": coarse, "solver": {"accuracy": 1e-3}}
    answer = desk.run(curve, study)
    assert answer["kind"] == "rough"
    missed = ["inaccurate" in words for words in answer["doubts"]]
    relative = np.array(answer["error"]) / answer["friction"]
    assert missed == (relative > 1e-3).tolist()
    assert any(missed)
    (note,) = [one for one in answer["warning_records"] if one["code"] == "accuracy-missed"]
    assert note["values"]["cases"] == missed.count(True)
    assert note["values"]["error"] == pytest.approx(relative.max(), rel=1e-3)  # of digits that the page has
    assert answer["lower"] is None
    assert "no-bands" in {one["code"] for one in answer["note_records"]}  # why there is no band
    assert len(answer["contact_area_fraction"]) == 12


@pytest.mark.parametrize("study", [BALL, CYLINDER, ROUGH], ids=["ball", "cylinder", "rough"])
def test_every_number_of_the_results_is_offered_with_its_name_unit_and_error(desk: Desk, study: dict[str, Any]) -> None:
    once = {**study["conditions"], "speed": "20 mm/s", "temperature": "60 degC"}
    answer = desk.run(curve, {**study, "conditions": once, "solver": {"accuracy": 0.1}})
    given = ("speed", "temperature")
    meaning = {name: one for name, one in MEANING[answer["kind"]].items() if name in answer and name not in given}
    expected = {name: words for name, (_, words) in meaning.items() if "error" not in name}  # errors are bars of these
    assert expected
    offered = {name: one for name, one in answer["quantities"].items() if name != "friction"}
    assert {name: one["label"] for name, one in offered.items()} == expected
    assert [one["kind"] is None for one in offered.values()] == [meaning[name][0] == "1" for name in offered]
    if answer["kind"] != "rough":
        assert answer["parts"]["front"][0]["error"] == "edge_error"


def test_more_than_a_page_can_show_is_refused(desk: Desk) -> None:
    many = {**BALL["conditions"], "speed": {"from": "1 mm/s", "to": "1 m/s", "points": 1001}}
    with refused("too-many-cases", ViscofricError, naming=("2,002", "2,000")):
        desk.run(curve, {**BALL, "conditions": many})
    assert desk.parts == []


EXTRA = {"interface_friction", "total_friction", "heated_friction", "temperature_rise"}
LAW = {"law": "constant", "stress": "0.2 MPa", "slip": "0.1 m/s"}
LINE = {
    "material": {"catalogue": "synthetic fluoroelastomer"},
    "indenter": {"shape": "cylinder", "radius": "10 mm"},
    "conditions": {"load": "500 N/m", "speed": ["50 mm/s", "200 mm/s"], "temperature": "60 degC"},
    "solver": {"accuracy": 0.1, "cases": "each"},
}


@pytest.mark.slow
def test_heat_and_interface_are_those_of_the_run_file(desk: Desk, tmp_path: Path) -> None:
    study = {**LINE, "interface": LAW, "heating": {"counterface": "PTFE"}}
    answer = desk.run(curve, study)
    path = tmp_path / "study.toml"
    path.write_text(study_text(study), encoding="utf-8")
    stored = vf.run_study(path).tree["heating"].to_dataset()
    of_heat = ("temperature_rise", "temperature_rise_error", "coulomb_rise", "loss_rise")
    for column in (*of_heat, "interface_friction", "total_friction"):
        np.testing.assert_allclose(answer[column], stored[column], rtol=ROUNDING)
    np.testing.assert_allclose(answer["heated_friction"], stored["friction_coefficient"], rtol=ROUNDING)
    assert answer["quantities"].keys() >= EXTRA
    assert answer["parts"]["temperature_rise"][0]["error"] == "temperature_rise_error"
    assert "error" not in answer["parts"]["interface_friction"][0]  # that of the isothermal contact is another one


def test_friction_of_the_interface_is_drawn_with_its_error(desk: Desk) -> None:
    answer = desk.run(curve, {**LINE, "interface": LAW})
    assert answer["parts"]["interface_friction"][0]["error"] == "interface_error"
    assert all(error > 0.0 for error in answer["interface_error"])


def test_a_heated_curve_without_a_solution_is_told(desk: Desk) -> None:
    conditions = {"load": ["10 N", "20000 N"], "speed": "20 mm/s", "temperature": "60 degC"}
    answer = desk.run(
        curve, {**BALL, "conditions": conditions, "solver": {"accuracy": 0.1}, "heating": {"counterface": "PTFE"}}
    )
    assert [one is None for one in answer["heated_friction"]] == [False, True]
    assert [one["code"] for one in answer["failure_records"]] == ["beyond-indenter"] * 2  # isothermal, and heated
    assert any("heated curve" in words for words in answer["missing"])


def test_a_law_that_is_fitted_is_left_to_the_run(desk: Desk) -> None:
    """The page's curve is not compared with the measurement; without the law there is no heat of it either."""
    measured = {
        "measurement": {"curves": "curves.csv"},
        "interface": {"law": "power"},
        "heating": {"counterface": "PTFE"},
    }
    answer = desk.run(curve, {**LINE, "indenter": {"radius": "10 mm"}, "conditions": BALL["conditions"], **measured})
    assert not EXTRA & answer["quantities"].keys()
    assert "heated_friction" not in answer
    assert {note["code"] for note in answer["note_records"]} >= {"fitted-interface", "no-heating"}
