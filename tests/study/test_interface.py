"""Studies with [interface]: a law given or fitted to the measurement, and its part of every case."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from viscofric.errors import StudyError
from viscofric.notes import codes
from viscofric.report.captions import captions
from viscofric.report.figures.interface import parts_figure, stress_figure
from viscofric.report.texts.study import scope
from viscofric.study.run_file.study import parse_study

BASE = """
data_origin = "synthetic"
[material]
catalogue = "synthetic fluoroelastomer"
[indenter]
radius = "10 mm"
[conditions]
load = "2 N"
speed = "200 mm/s"
temperature = "60 degC"
[solver]
accuracy = 0.1
cases = "each"
master_curve_points = 2
[outputs]
fields = "none"
"""
GIVEN = '[interface]\nlaw = "power"\nstress = "0.2 MPa"\nexponent = 0.5\nspeed = "20 mm/s"\n'


def run(folder: Path, text: str, *, resume: bool = False) -> vf.study.StudyResults:
    path = folder / "study.toml"
    path.write_text(BASE + text, encoding="utf-8")
    return vf.run_study(path, resume=resume)


@pytest.mark.slow
def test_a_given_law_adds_its_friction_to_every_case(tmp_path: Path) -> None:
    results = run(tmp_path, GIVEN)
    data = results.dataset
    stress = 2e5 * 10.0**0.5
    np.testing.assert_allclose(data["interface_friction"], stress * data["contact_area"] / 2.0)
    np.testing.assert_allclose(data["total_friction"], data["friction_coefficient"] + data["interface_friction"])
    assert data["interface_error"].attrs["units"] == "1"
    assert "/interface" not in results.tree.groups
    assert {"interface-law", "interface-share", "interface-without-error"} <= set(codes(results.notes))
    assert stress_figure(results.tree) is None
    assert "given" in scope(results.tree)[-1]
    # Its heat is that of the same Coulomb friction, given.
    coulomb = f'[heating]\ncounterface = "PTFE"\ncoulomb = {float(data["interface_friction"])}\n'
    (tmp_path / "given").mkdir()
    warm, given, cold = (
        one.tree["assumptions"].to_dataset()["value"].values[-1]
        for one in (results, run(tmp_path / "given", coulomb), run(tmp_path / "given", "", resume=True))
    )
    assert warm == pytest.approx(given)
    assert warm > 2.0 * cold


@pytest.mark.slow
@pytest.mark.apart  # a whole study with a measurement
def test_a_law_is_fitted_to_the_measured_coulomb_friction(tmp_path: Path) -> None:
    """Coulomb friction of 10 % is the same at all points; the constant stress is its mean times the mean pressure."""
    n, speed = 4, np.array([0.02, 0.2, 0.02, 0.2])
    measured = vf.FrictionCurves(
        speed,
        np.repeat([323.15, 333.15], 2),
        np.full(n, 2.0),
        np.array([0.02, 0.01, 0.02, 0.015]),
        *(np.full(n, 1e-3), np.full(n, 1e-3)),
        np.full(n, 4),
        coulomb=np.full(n, 0.1),
        coulomb_error=np.full(n, 2e-3),
        slip=0.1 * speed,
    )
    vf.write_friction_curves(measured, tmp_path / "measured.csv")
    text = '[measurement]\ncurves = "measured.csv"\n[interface]\nlaw = "constant"\nslip = "5 mm/s"\n'
    results = run(tmp_path, text)
    points, law = results.tree["interface"].to_dataset(), results.tree["interface_law"].to_dataset()
    np.testing.assert_allclose(points["shear_stress"], 0.1 * points["mean_pressure"])
    np.testing.assert_allclose(points["speed"], 0.1 * speed)
    level = float(law["shear_stress"][0, 0])
    assert points["shear_stress"].min() < level < points["shear_stress"].max()
    np.testing.assert_allclose(results.dataset["interface_friction"], level * results.dataset["contact_area"] / 2.0)
    assert stress_figure(results.tree) is not None
    assert "4 points" in scope(results.tree)[-1]
    assert parts_figure(results.tree) is None  # one speed
    assert captions(results.tree)["shear_stress"]


@pytest.mark.parametrize(
    ("table", "place"),
    [
        ("[interface]\n", "interface"),
        ('[interface]\nstress = "1 MPa"\n', "interface.law"),
        ('[interface]\nlaw = "power"\nstress = "1 MPa"\nspeed = "1 mm/s"\n', "interface.exponent"),
        ('[interface]\nlaw = "constant"\nstress = "1 MPa"\nwidth = 1.0\n', "interface.width"),
        ('[interface]\nlaw = "constant"\nstress = "1 MPa"\nreference = "30 degC"\n', "interface.reference"),
        ('[interface]\nlaw = "constant"\nstress = "1 MPa"\narea_error = 0.1\n', "interface.area_error"),
        ('[interface]\nlaw = "constant"\nstress = "1 kg"\n', "interface.stress"),
    ],
)
def test_contradictions_are_found_before_anything_is_solved(table: str, place: str, tmp_path: Path) -> None:
    with pytest.raises(StudyError) as wrong:
        parse_study(BASE + table, tmp_path / "study.toml")
    assert f"{place}" in str(wrong.value)


def test_a_given_law_has_its_constants_and_shift(tmp_path: Path) -> None:
    text = GIVEN + 'activation_energy = "80 kJ/mol"\nreference = "30 degC"\n'
    study = parse_study(BASE + text, tmp_path / "study.toml")
    assert study.interface is not None
    shift = vf.Arrhenius("80 kJ/mol", "30 degC")
    assert study.interface.given() == vf.friction.PowerShearStress("0.2 MPa", 0.5, "20 mm/s", shift=shift)
