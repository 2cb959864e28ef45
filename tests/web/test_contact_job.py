"""One contact of the page: coarse and sharp answers, and what a browser is handed of them."""

from __future__ import annotations

import json
from pathlib import Path
from shutil import copyfile
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.errors import ViscofricError
from viscofric.web.jobs import contact, curve
from viscofric.web.start import GLOSSARY
from web.contact_studies import BALL, CYLINDER, ROUGH, Desk
from web.rubber_workspace import EXAMPLE, SWEEPS

LIGHT = 200_000  # bytes of an answer, so that a slider can ask for many
#: Numbers have six digits.
ROUNDING = 1e-5


@pytest.fixture
def desk(tmp_path: Path) -> Desk:
    return Desk(tmp_path)


def value(answer: dict[str, Any], name: str) -> float:
    return float(answer["numbers"][name]["value"])


def rubber() -> vf.Material:
    return vf.catalogue_material("synthetic fluoroelastomer")


def test_sharp_answer_has_the_numbers_of_a_solved_contact(desk: Desk) -> None:
    answer = desk.run(contact, {**BALL, "solver": {"accuracy": 1e-3}}, speed=5.0, temperature=303.15)
    solved = vf.solve_steady(rubber(), vf.Ball("9.525 mm"), speed=5.0, load=25.0, temperature=303.15, accuracy=1e-3)
    assert answer["stage"] == "sharp"
    for name in ("friction_coefficient", "indentation", "contact_area", "front", "rear", "max_pressure"):
        assert value(answer, name) == pytest.approx(getattr(solved, name), rel=ROUNDING)
    assert answer["numbers"]["friction_coefficient"]["error"] == pytest.approx(
        solved.diagnostics.friction_error, rel=ROUNDING
    )
    # The coarse answer came before: of the same contact, to the loosest accuracy.
    (coarse,) = desk.parts
    assert coarse["stage"] == "coarse"
    assert value(coarse, "friction_coefficient") != value(answer, "friction_coefficient")
    assert value(coarse, "friction_coefficient") == pytest.approx(
        value(answer, "friction_coefficient"), rel=contact.COARSE
    )


@pytest.mark.parametrize("study", [BALL, CYLINDER, ROUGH], ids=["ball", "cylinder", "rough"])
def test_the_page_defines_every_number_of_a_contact(desk: Desk, study: dict[str, Any]) -> None:
    answer = desk.run(contact, study, speed=0.1, temperature=333.15, stages="coarse")
    told = [one["label"] for one in (*answer["key_numbers"], *answer["more_numbers"])]
    assert len(told) > 10
    assert {one.replace("{v/a}", "v/a") for one in told} <= set(GLOSSARY)


@pytest.mark.parametrize("study", [BALL, CYLINDER], ids=["ball", "cylinder"])
def test_a_coarse_answer_within_the_accuracy_asked_for_counts_as_sharp(desk: Desk, study: dict[str, Any]) -> None:
    coarse = desk.run(contact, study, speed=0.1, temperature=333.15, stages="coarse")
    assert coarse["stage"] == "sharp"  # the first grids promise 1 %
    sharp = desk.run(contact, study, speed=0.1, temperature=333.15, stages="sharp")
    # on the same grids, of which the first two are solved to a thousandth of the accuracy
    friction = "friction_coefficient"
    assert value(coarse, friction) == pytest.approx(value(sharp, friction), rel=1e-4)
    assert coarse["numbers"][friction]["error"] <= 0.01 * value(coarse, friction)
    assert coarse == desk.run(contact, study, speed=0.1, temperature=333.15)
    assert desk.parts == []  # nothing is told twice


SHAPES: dict[str, dict[str, Any]] = {
    "ball": BALL,
    "elastic ball": {**BALL, "indenter": {"radius": "9.525 mm", "modulus": "20 MPa"}},
    "layer": {**BALL, "layer": {"thickness": "2 mm"}},
    "ellipsoid": {**BALL, "indenter": {"shape": "ellipsoid", "radius_x": "20 mm", "radius_y": "5 mm"}},
    "cone": {**BALL, "indenter": {"shape": "cone", "angle": "10 deg"}},
    "cylinder": CYLINDER,
}


@pytest.mark.parametrize("study", SHAPES.values(), ids=SHAPES)
def test_profile_shows_a_contact_that_leans_forward_and_its_trail(desk: Desk, study: dict[str, Any]) -> None:
    answer = desk.run(contact, study, speed=0.1, temperature=333.15, stages="coarse")
    assert len(json.dumps(answer)) < LIGHT
    front, rear = value(answer, "front"), value(answer, "rear")
    assert front > rear > 0.0  # rubber behind the axis has not sprung back
    x, pressure, surface = (np.array(answer["profile"][name]) for name in ("x", "pressure", "surface"))
    assert np.all(np.diff(x) > 0.0)
    assert x[pressure > 0.0].min() == pytest.approx(-rear, rel=0.1)
    assert x[pressure > 0.0].max() == pytest.approx(front, rel=0.1)
    assert x @ pressure > 0.0
    # Rubber lies on the indenter where there is pressure, and below it elsewhere; 1 %: the trail of elastic indenters
    # is found from the pressure in cells.
    indenter = np.array([np.nan if height is None else height for height in answer["profile"]["indenter"]])
    gap, depth = indenter - surface, value(answer, "indentation")
    assert np.nanmax(np.abs(gap[pressure > 0.0])) < 0.01 * depth
    assert np.nanmin(gap) > -0.01 * depth
    # An elastic ball of 20 MPa yields, too: the rubber's share of the indentation is less.
    if "modulus" in study["indenter"]:
        assert 0.3 < -surface.min() / depth < 0.9
    else:
        # A tip lies between the points of the surface.
        assert -surface.min() == pytest.approx(depth, rel=0.02 if study["indenter"]["shape"] == "cone" else 0.01)
    # As far behind the axis as ahead, the rubber still lies deeper.
    far = 1.5 * front
    assert np.interp(-far, x, surface) < np.interp(far, x, surface)


def test_map_holds_the_load(desk: Desk) -> None:
    answer = desk.run(contact, BALL, speed=0.1, temperature=333.15, stages="coarse")
    x, y, pressure = (np.array(answer["map"][name]) for name in ("x", "y", "pressure"))
    assert pressure.shape == (len(y), len(x))
    assert max(pressure.shape) <= contact.MOST_CELLS
    # Three digits of each pressure.
    assert pressure.sum() * (x[1] - x[0]) * (y[1] - y[0]) == pytest.approx(25.0, rel=1e-3)
    # The outline encloses the contact's area, but for what smoothing takes off at its edge.
    (line,) = answer["outline"]
    along, across = np.array(line["x"]), np.array(line["y"])
    area = 0.5 * abs(float(along @ np.roll(across, 1) - across @ np.roll(along, 1)))
    assert area == pytest.approx(value(answer, "contact_area"), rel=0.03)


def test_thinning_keeps_the_mean_and_cuts_what_is_left_over() -> None:
    field = np.arange(24.0).reshape(6, 4)
    x, y, thin = contact.thinned(np.arange(6.0), np.arange(4.0), field, 3)
    assert (x.tolist(), y.tolist()) == ([0.5, 2.5, 4.5], [0.5, 2.5])
    assert thin.mean() == field.mean()
    _, _, cut = contact.thinned(np.arange(5.0), np.arange(1.0), np.ones((5, 1)), 2)
    assert cut.shape == (1, 1)


def test_rough_surface_is_answered_by_a_coarser_likeness_first(desk: Desk) -> None:
    study = {**ROUGH, "surface": {**ROUGH["surface"], "points": 256}}
    sharp = desk.run(contact, study, speed=0.1, temperature=303.15)
    (coarse,) = desk.parts
    assert (value(coarse, "points"), value(sharp, "points")) == (128, 256)
    assert (coarse["stage"], sharp["stage"]) == ("coarse", "sharp")
    surface = vf.self_affine(
        0.8, shape=(256, 256), spacing=1e-5, seed=1, shortest=8e-5, rolloff=6.4e-4, rms_slope=0.2
    ).to_surface()
    solved = vf.solve_periodic(rubber(), surface, speed=0.1, pressure=5e5, temperature=303.15, tolerance=1e-5)
    assert value(sharp, "friction_coefficient") == pytest.approx(solved.friction_coefficient, rel=ROUNDING)
    # To this tolerance the last bits of the pressure decide on single points.
    assert value(sharp, "contact_area_fraction") == pytest.approx(solved.contact_area_fraction, abs=4.0 / 256**2)
    # Two points in the shortest wave are few, but tell what sort of friction it is.
    assert value(coarse, "friction_coefficient") == pytest.approx(solved.friction_coefficient, rel=0.2)
    for answer in (coarse, sharp):
        assert len(json.dumps(answer)) < LIGHT
        assert np.mean(answer["map"]["pressure"]) == pytest.approx(5e5, rel=2e-2)  # points left over are cut off
        heights = answer["profile"]
        assert min(np.subtract(heights["indenter"], heights["surface"])) > -1e-9


def test_a_profile_of_a_surface_has_no_map(desk: Desk) -> None:
    study = {**ROUGH, "surface": {**ROUGH["surface"], "points": [512, 1]}}
    answer = desk.run(contact, study, speed=0.1, temperature=303.15, stages="coarse")
    assert answer["map"] is None
    assert max(answer["profile"]["pressure"]) > 5e5


def test_one_of_several_loads_is_solved(desk: Desk) -> None:
    study = {**BALL, "conditions": {**BALL["conditions"], "load": ["10 N", "25 N"]}}
    where = {"speed": 0.1, "temperature": 333.15, "stages": "coarse"}
    assert [value(desk.run(contact, study, combination=which, **where), "load") for which in (0, 1)] == [10.0, 25.0]
    with refused("no-such-combination", ViscofricError, naming="combination = 2"):
        desk.run(contact, study, combination=2, **where)


@pytest.mark.parametrize(
    ("surface", "speed", "temperature", "said"),
    [
        (False, 0.1, 333.15, []),
        (False, 0.1, 500.15, ["227 °C the law extrapolates"]),
        (False, 1e5, 333.15, ["Inertia", "rad/s, lies beyond"]),
        (True, 0.1, 333.15, []),
        (True, 1e5, 333.15, ["Inertia", "of the pressure lie beyond"]),
        (True, 1e-9, 333.15, ["of the pressure lie beyond"]),  # slow, but within for its shortest waves
    ],
)
def test_extrapolated_rubber_is_reported_where_the_study_reports_it(
    desk: Desk, surface: bool, speed: float, temperature: float, said: list[str]
) -> None:
    copyfile(EXAMPLE, desk.context.files / "dma.csv")
    study = {**(ROUGH if surface else BALL), "material": {**SWEEPS, "shift": "wlf"}, "uncertainty": {"draws": 0}}
    answer = desk.run(contact, study, speed=speed, temperature=temperature, stages="coarse")
    warnings = [words for words in answer["warnings"] if "small strain" not in words]
    assert [part in words for part, words in zip(said, warnings, strict=True)] == [True] * len(said)
    assert answer["numbers"]["within"]["value"] == float("beyond those" not in " ".join(warnings))
    once = {**study["conditions"], "speed": f"{speed} m/s", "temperature": f"{temperature} K"}
    (doubts,) = desk.run(curve, {**study, "conditions": once})["doubts"]
    assert ("extrapolated" in doubts) == ("beyond those" in " ".join(warnings))
    assert ("shift" in doubts) == ("shift factor" in " ".join(warnings))


def test_what_cannot_be_solved_is_one_sentence(desk: Desk) -> None:
    with refused("beyond-indenter"):
        desk.run(contact, {**BALL, "conditions": {**BALL["conditions"], "load": "1 MN"}}, speed=0.1, temperature=333.15)
    with refused("out-of-range", naming="temperature"):
        desk.run(contact, BALL, speed=0.1, temperature=20.0)


def test_rubber_is_reported_at_the_contacts_frequency(desk: Desk) -> None:
    answer = desk.run(contact, BALL, speed=0.1, temperature=333.15, stages="coarse")
    frequency = 2.0 * 0.1 / (value(answer, "front") + value(answer, "rear"))
    assert value(answer, "frequency") == pytest.approx(frequency, rel=ROUNDING)
    modulus = complex(rubber().complex_modulus(frequency, temperature=333.15))
    assert value(answer, "storage_modulus") == pytest.approx(modulus.real, rel=ROUNDING)
    assert value(answer, "loss_factor") == pytest.approx(modulus.imag / modulus.real, rel=ROUNDING)
    # The load's lean over the ball's radius is the friction; both have errors.
    lean, friction = answer["numbers"]["centre_of_pressure"], answer["numbers"]["friction_coefficient"]
    error = lean["error"] / 9.525e-3 + friction["error"]
    assert error < 0.02 * friction["value"]
    assert lean["value"] / 9.525e-3 == pytest.approx(friction["value"], abs=error)
    assert value(answer, "power") == pytest.approx(value(answer, "friction_force") * 0.1, rel=ROUNDING)
