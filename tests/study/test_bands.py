"""Bands of a study's friction: those of the Python interface, stored with the cases, and told where there are none."""

from __future__ import annotations

import json
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from viscofric import run_study
from viscofric.errors import ConvergenceError
from viscofric.friction.cases.record import Record
from viscofric.study import StudyResults
from viscofric.study.make_rubber import make_rubber
from viscofric.study.run_file.study import load_study

DMA = (Path(str(files("viscofric"))) / "example" / "dma.csv").as_posix()
STUDY = """
[material]
{material}
[indenter]
radius = "9.525 mm"
[conditions]
load = "25 N"
speed = ["20 mm/s", "200 mm/s"]
temperature = "60 degC"
[solver]
accuracy = 1e-2
master_curve_points = 2
[uncertainty]
draws = {samples}
"""
SWEEPS = f'dma = "{DMA}"\ndeformation = "tension"\nreference_temperature = "30 degC"\npoisson_ratio = 0.45'


def write(folder: Path, material: str = SWEEPS, samples: int = 20) -> Path:
    path = folder / "study.toml"
    path.write_text(STUDY.format(material=material, samples=samples), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> StudyResults:
    return run_study(write(tmp_path_factory.mktemp("bands")))


@pytest.mark.slow
def test_bands_are_those_of_the_python_interface(results: StudyResults) -> None:
    rubber = make_rubber(load_study(results.folder.parent / "study.toml").material)
    assert rubber.fit is not None
    samples = vf.sample_materials(rubber.fit, rubber.material.spectrum, samples=20, poisson_ratio=0.45)  # type: ignore[arg-type]
    curves = vf.predict_friction(
        rubber.material,
        vf.Ball(radius="9.525 mm"),
        speeds=["20 mm/s", "200 mm/s"],
        temperatures="60 degC",
        load="25 N",
        samples=samples,
        accuracy=1e-2,
    )
    found = results.tree["prediction"]
    # The same seed and the same contacts: the same to rounding.
    for name, expected in (
        ("coefficient", curves.viscoelastic),
        ("lower", curves.viscoelastic_lower),
        ("upper", curves.viscoelastic_upper),
        ("material_error", curves.material_error),
    ):
        np.testing.assert_allclose(found[f"friction_{name}"].values, expected, rtol=1e-9)


@pytest.mark.slow
def test_stored_cases_give_the_same_numbers_again(results: StudyResults, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise AssertionError("a stored case was solved again")

    monkeypatch.setattr("viscofric.friction.cases.solving.solve_with_sensitivity", refuse)
    again = run_study(results.folder.parent / "study.toml", resume=True)
    for name in ("friction_coefficient", "friction_lower", "friction_upper"):
        for part in ("prediction", "prediction_master"):
            np.testing.assert_array_equal(again.tree[part][name].values, results.tree[part][name].values)


@pytest.mark.slow
def test_a_sensitivity_that_is_none_is_refused(results: StudyResults) -> None:
    first = min((results.folder / "cases").glob("*.json"))
    stored = json.loads(first.read_text(encoding="utf-8"))["case"]
    for change in ({"slope": [1.0]}, {"slope": [None] * 60}, {"glass": "high"}, {"more": 1.0}):
        with pytest.raises((ValueError, TypeError)):
            Record.from_values(stored | {"sensitivity": stored["sensitivity"] | change})
    assert Record.from_values(stored).sensitivity is not None


@pytest.mark.slow
def test_modulus_has_its_band_too(results: StudyResults) -> None:
    assert "storage_modulus_lower" in results.tree["spectrum_curve"]


@pytest.mark.slow
def test_a_rubber_that_was_ready_has_no_bands_and_says_so(tmp_path: Path) -> None:
    ready = run_study(write(tmp_path, 'catalogue = "synthetic fluoroelastomer"', samples=20))
    assert "friction_lower" not in ready.tree["prediction"]
    assert "no-bands" in {note.code for note in ready.notes}


@pytest.mark.slow
def test_friction_is_kept_where_only_its_band_fails(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from viscofric.friction.cases import solving

    solve = solving.solve_with_sensitivity

    def fails_when_fast(*arguments: object, speed: float, **options: object) -> object:
        if speed > 0.1:
            raise ConvergenceError("the derivatives did not converge.")
        return solve(*arguments, speed=speed, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(solving, "solve_with_sensitivity", fails_when_fast)
    results = run_study(write(tmp_path))
    assert results.failures == ()
    assert np.all(results.tree["prediction"]["friction_coefficient"].values > 0.0)
    assert "friction_lower" not in results.tree["prediction"]
    assert {"cases": 1, "of": 2} in [note.values for note in results.notes if note.code == "no-bands"]


def test_too_few_samples_are_reported(tmp_path: Path) -> None:
    with pytest.raises(vf.StudyError) as caught:
        load_study(write(tmp_path, samples=5))
    assert (caught.value.field, caught.value.mistakes[0].code) == ("uncertainty.draws", "value")
