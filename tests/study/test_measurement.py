"""A study's measurement: its own shift factors beside the modulus's, assumptions, friction curves that are ready."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from viscofric import run_study
from viscofric.study import StudyResults
from viscofric.study.contacts import Contacts
from viscofric.study.measurement import Measurement
from viscofric.study.run_file.study import parse_study
from viscofric.study.study_rubber import StudyRubber

ROOT = Path(__file__).resolve().parents[2]
STUDY = """
[material]
catalogue = "synthetic fluoroelastomer"
[indenter]
radius = "9.525 mm"
[conditions]
load = ["25 N", "10 N"]
speed = "100 mm/s"
temperature = "35 degC"
thickness = "5 mm"
[measurement]
curves = "curves.csv"
[solver]
accuracy = 1e-2
master_curve_points = 9
"""


def curves() -> vf.FrictionCurves:
    """Return friction of the synthetic rubber, solved beforehand, at three temperatures whose curves overlap."""
    kelvin, speed, friction, _ = np.loadtxt(
        ROOT / "tests" / "data" / "synthetic_friction_curves.csv", delimiter=",", skiprows=3, unpack=True
    )
    keep = kelvin < 313.5
    kelvin, speed, friction = kelvin[keep], speed[keep], friction[keep]
    error = 0.01 * friction
    moved = friction + error * np.random.default_rng(4).standard_normal(friction.size)
    load, count = np.full(friction.size, 25.0), np.full(friction.size, 4)
    rubbing = {"coulomb": np.full(friction.size, 0.6), "slip": 0.01 * speed}
    found = vf.FrictionCurves(speed, kelvin, load, moved, error, 2.0 * error, count, **rubbing)
    return found.select(np.arange(0, len(found), 2))


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> StudyResults:
    folder = tmp_path_factory.mktemp("measured")
    vf.write_friction_curves(curves(), folder / "curves.csv")
    written = (folder / "curves.csv").read_text(encoding="utf-8")
    (folder / "curves.csv").write_text(f"# SYNTHETIC data\n{written}", encoding="utf-8")
    vf.write_card(replace(vf.synthetic_fluoroelastomer(), name="a rubber"), folder / "rubber.json", format="json")
    of_file = STUDY.replace('catalogue = "synthetic fluoroelastomer"', 'file = "rubber.json"')
    (folder / "study.toml").write_text(of_file, encoding="utf-8")
    return run_study(folder / "study.toml")


@pytest.mark.slow
def test_friction_that_its_file_calls_synthetic_is_not_called_measured(results: StudyResults) -> None:
    assert results.tree.attrs["data_origin"] == "synthetic"


@pytest.mark.slow
def test_friction_curves_that_are_ready_are_the_measurement(results: StudyResults) -> None:
    measured, given = results.tree["measurement"], curves()
    np.testing.assert_array_equal(measured["viscoelastic"].values, given.viscoelastic)
    assert set(given.points_dataset().variables) <= set(measured.variables)  # and no column is left out
    # Noise of 1 % in the mean; the contacts are solved to 1 %.
    assert np.abs(measured["predicted"].values / given.viscoelastic - 1.0).max() < 0.05


@pytest.mark.slow
def test_shift_factors_of_friction_stand_beside_those_of_the_modulus(results: StudyResults) -> None:
    found, law = results.tree["friction_shift_factors"], vf.synthetic_fluoroelastomer().shift
    assert law is not None
    np.testing.assert_allclose(
        found["known_log10_shift_factor"].values, law.log10(found["temperature"].values), atol=1e-12
    )
    apart = found["log10_shift_factor"].values - found["known_log10_shift_factor"].values
    # Of two factors, four standard errors; the reference's own is zero but for rounding.
    assert np.all(np.abs(apart) <= 4.0 * found["standard_error"].values + 1e-12)
    assert found.attrs["slope"] == pytest.approx(1.0, abs=4.0 * found.attrs["slope_error"])


@pytest.mark.slow
def test_agreement_is_reported_point_by_point_and_on_the_master_curve(results: StudyResults) -> None:
    over, along = json.loads(results.tree["agreement"].attrs["sentences"])
    assert all("15 points" in sentence for sentence in (over, along))  # none lies outside
    assert results.tree["agreement"].attrs["material_counted"] == 0  # a ready rubber has no bands


@pytest.mark.slow
def test_points_of_the_master_curve_are_at_its_load(results: StudyResults) -> None:
    master, law = results.tree["measurement_master"], vf.synthetic_fluoroelastomer().shift
    assert law is not None
    given = curves()
    reduced = np.sort(law(given.temperature) * given.speed)
    np.testing.assert_allclose(master["reduced_speed"].values, reduced, rtol=1e-12)
    assert master.attrs["load"] == 25.0  # the first of those that are asked for
    assert results.dataset["load"].values.tolist() == [25.0, 10.0]


@pytest.mark.slow
def test_thin_rubber_is_no_half_space(results: StudyResults) -> None:
    checked = results.tree["assumptions"].to_dataset()
    verdict = dict(zip(checked["assumption_name"].values.tolist(), checked["holds"].values.tolist(), strict=True))
    assert verdict["half-space"] == 0  # contacts of 4 mm across on 5 mm of rubber
    assert verdict["one temperature"] == 1
    (sentence,) = checked["sentence"].values[checked["assumption_name"].values == "half-space"]
    assert "5 mm" in sentence
    (warning,) = (one for one in results.warnings if one.code == "half-space")
    assert sentence == warning.words("run_file")


@pytest.mark.slow
def test_coulomb_friction_on_thin_rubber_is_warned_of(results: StudyResults) -> None:
    """With ν = ½ a half-space would not feel it; a layer of two contact radii does.

    Where friction is lowest, a contact solved with the shear of 0.6 has 1.29 times more of it.
    """
    checked = results.tree["assumptions"].to_dataset()
    (row,) = np.flatnonzero(checked["assumption_name"].values == "uncoupled")
    assert checked["holds"].values[row] == 0
    assert checked["value"].values[row] == pytest.approx(1.29, rel=0.25)  # an estimate
    (warning,) = (one for one in results.warnings if one.code == "uncoupled")
    assert checked["sentence"].values[row] == warning.words("run_file")


@pytest.mark.slow
def test_the_report_says_so(results: StudyResults) -> None:
    from viscofric.report.texts.checks import all_checks

    reported = {check.name: check.verdict for check in all_checks(results.tree)}
    assert reported["Half-space"] == "warning"
    assert reported["Pressure independent of shear"] == "warning"
    assert reported["Shift factors from friction"] == "passed"


def test_a_study_notes_measured_friction_below_zero() -> None:
    material, measured = vf.synthetic_fluoroelastomer(), curves()
    negative = replace(measured, viscoelastic=-measured.viscoelastic)
    codes = [note.code for note in Measurement(negative, material, vf.Ball(9.525e-3), 25.0).notes]
    assert codes.count("friction-below-zero") == 1


def test_an_assumed_coulomb_friction_is_noted_once() -> None:
    assumption = "Coulomb friction of 0.05 is assumed."
    measured = replace(curves(), assumption=assumption, notes=(assumption,))
    assert Measurement(measured, vf.synthetic_fluoroelastomer(), vf.Ball(9.525e-3), 25.0).notes.count(assumption) == 1


def test_measured_points_are_solved_with_the_elastic_ball_of_the_study(tmp_path: Path) -> None:
    """As soft as the rubber, the ball changes friction: cases, measured points and master curve are of the same one."""
    text = STUDY.replace('"9.525 mm"', '"9.525 mm"\nmodulus = "5 MPa"')
    vf.write_friction_curves(curves(), tmp_path / "curves.csv")
    study = parse_study(text, tmp_path / "study.toml")
    rubber = StudyRubber.of(study.material, study.uncertainty, study.conditions.temperature)
    contacts = Contacts(study, [rubber], Measurement(curves(), rubber.material, vf.Ball(9.525e-3), 25.0))
    assert len(contacts.at_points) == len(curves())
    assert len(contacts.along) == 9
    solved: list[Any] = [*contacts.sweep.cases, *contacts.at_points, *contacts.along]
    assert {case.modulus for case in solved} == {5e6}


@pytest.mark.parametrize(("speeds", "cases", "solved"), [(1, "curves", 1), (1, "each", 1), (4, "each", 4)])
def test_a_case_by_itself_is_one_contact(tmp_path: Path, speeds: int, cases: str, solved: int) -> None:
    text = STUDY.partition("[measurement]")[0].replace('["25 N", "10 N"]', '"25 N"')
    text = text.replace('"100 mm/s"', str([f"{10 * 2**n} mm/s" for n in range(speeds)]))
    study = parse_study(f'{text}[solver]\ncases = "{cases}"\n', tmp_path / "study.toml")
    rubber = StudyRubber.of(study.material, study.uncertainty, study.conditions.temperature)
    plan = Contacts(study, [rubber], None).plan
    assert (plan.total, len(plan.wanted())) == (speeds, solved)
