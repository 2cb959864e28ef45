"""The whole job on the built-in synthetic example: what went into the data must come out again."""

from __future__ import annotations

import math
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from viscofric.study import StudyResults, open_results, run_study

EXAMPLE = Path(str(files("viscofric"))) / "example"
REAL_STUDY = """
title = "acrylic elastomer"
[material]
dma = "{dma}"
deformation = "shear"
poisson_ratio = 0.5
reference_temperature = "20 degC"
[indenter]
radius = "9.525 mm"
[conditions]
load = "{load}"
speed = {{ from = "{slowest}", to = "{fastest}", points = {points} }}
temperature = ["0 degC", "30 degC", "60 degC"]
[solver]
master_curve_points = 5
"""


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> StudyResults:
    """Results of the built-in study, with fewer points asked for between the measured ones."""
    text = (EXAMPLE / "study.toml").read_text(encoding="utf-8").replace("points = 10", "points = 3")
    folder = tmp_path_factory.mktemp("study")
    for name in ("dma.csv", "mtm.csv"):
        (folder / name).write_bytes((EXAMPLE / name).read_bytes())
    text = text.replace("accuracy = 1e-3", "accuracy = 1e-3\nmaster_curve_points = 7")
    (folder / "study.toml").write_text(text, encoding="utf-8")
    return run_study(folder / "study.toml")


def test_planted_shift_factors_come_back_within_their_errors(results: StudyResults) -> None:
    found = results.tree["shift_factors"]
    planted = vf.synthetic_fluoroelastomer().shift
    assert planted is not None
    difference = found["log10_shift_factor"].values - planted.log10(found["temperature"].values)
    error = found["standard_error"].values
    measured = error > 0.0  # the reference itself is exact
    # 22 correlated values: five standard errors would be a wrong error or a wrong factor.
    assert np.abs(difference[measured] / error[measured]).max() < 5.0
    assert np.abs(difference).max() < 0.1  # decades; 1 % noise against slopes of 0.1 to 0.5 a decade


def test_planted_modulus_comes_back_within_the_noise(results: StudyResults) -> None:
    curve = results.tree["master_curve"]
    planted = vf.synthetic_fluoroelastomer().complex_modulus(curve["angular_frequency"].values)
    # 17 readings a sweep and 1 % noise leave about 0.3 % in the fit; the shift's own error adds up to 2 %.
    np.testing.assert_allclose(curve["fitted_storage_modulus"].values, planted.real, rtol=0.03)
    np.testing.assert_allclose(curve["fitted_loss_modulus"].values, planted.imag, rtol=0.03)
    assert results.tree["spectrum"].attrs["E0"] == pytest.approx(3e6, rel=0.01)


def test_planted_coulomb_friction_comes_back(results: StudyResults) -> None:
    measured = results.tree["measurement"]
    z = (measured["coulomb"].values - 0.045) / measured["coulomb_error"].values
    # 30 points with seven degrees of freedom each: Student's t goes beyond 6 once in 20,000 tries.
    assert np.abs(z).max() < 6.0
    assert abs(z.mean()) < 4.0 / math.sqrt(len(z))


def test_planted_viscoelastic_friction_is_measured_and_predicted(results: StudyResults) -> None:
    measured = results.tree["measurement"]
    z = (measured["viscoelastic"].values - measured["predicted"].values) / measured["viscoelastic_error"].values
    assert len(z) == 30
    assert np.abs(z).max() < 6.0
    # Prediction goes through shift factors and spectrum fitted to noisy data: 1 to 2 % of systematic error.
    assert abs(results.tree["agreement"].attrs["bias"]) < 0.02
    assert results.tree["agreement"].attrs["rms"] < 0.03


def test_temperatures_fall_on_one_friction_master_curve(results: StudyResults) -> None:
    measured = results.tree["measurement"]
    master = results.tree["prediction_master"]
    line = np.interp(
        np.log(measured["reduced_speed"].values),
        np.log(master["speed"].values),
        master["friction_coefficient"].values,
    )
    # Seven points over four decades, interpolated linearly: good to a few per cent, far less than the
    # factor of six by which the friction changes along the curve.
    assert np.sqrt(np.mean((line / measured["viscoelastic"].values - 1.0) ** 2)) < 0.1


def test_results_are_labelled_with_units_and_provenance(results: StudyResults) -> None:
    stored = open_results(results.folder)
    assert stored.tree.attrs["data_origin"] == "synthetic"
    assert "dma.csv" in stored.tree.attrs["input_hashes"]
    assert stored.tree.attrs["viscofric_version"] == vf.__version__
    for group in stored.tree.subtree:
        for variable in group.variables.values():
            assert variable.attrs["units"]
            assert variable.attrs["long_name"]
            assert np.all(np.isfinite(variable.values.astype(float)))


def test_left_out_isotherms_and_small_strain_are_told(results: StudyResults) -> None:
    assert "left out" in results.tree.attrs["notes"]
    assert any("small strain" in warning for warning in results.warnings)
    assert results.failures == ()


def test_a_second_run_solves_nothing_again(results: StudyResults, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise AssertionError("a stored case was solved again")

    monkeypatch.setattr("viscofric.study.execution.solve_steady", refuse)
    again = run_study(results.folder.parent / "study.toml")
    first, second = (one.tree["prediction"]["friction_coefficient"].values for one in (results, again))
    np.testing.assert_array_equal(first, second)


def _real_study(
    real_data: Path, folder: Path, load: str, points: int, slowest: str = "0.1 mm/s", fastest: str = "10 m/s"
) -> Path:
    path = folder / "study.toml"
    dma = (real_data / "dma" / "acrylic_468mp.csv").resolve().as_posix()
    path.write_text(
        REAL_STUDY.format(dma=dma, load=load, points=points, slowest=slowest, fastest=fastest), encoding="utf-8"
    )
    return path


def test_real_acrylic_isotherms_run_to_friction(real_data: Path, tmp_path: Path) -> None:
    results = run_study(_real_study(real_data, tmp_path, "0.05 N", 6))
    assert results.failures == ()
    assert results.tree["isotherms"].sizes["reading"] == 339  # 340 rows less the negative loss modulus
    notes = results.tree.attrs["notes"]
    assert "loss modulus is not above zero" in notes
    assert "Line 18" in notes
    assert results.tree["spectrum"].attrs["E0_extrapolated"] == 1
    prediction = results.tree["prediction"]
    assert prediction.sizes["case"] == 18
    # tan δ is 0.3 to 1.3 over this range: friction of some per cent, and never beyond what Hertz strains allow.
    assert np.all((prediction["friction_coefficient"] > 0.0) & (prediction["friction_coefficient"] < 0.5))
    # Friction is known to 1e-3; of the two ways to it the slower one may be a few times farther off.
    assert np.all(np.abs(prediction["energy_balance"]) < 5e-3)


def test_contacts_wider_than_the_ball_are_told_and_the_others_kept(real_data: Path, tmp_path: Path) -> None:
    results = run_study(_real_study(real_data, tmp_path, "25 N", 2))
    assert results.tree["prediction"].sizes["case"] + len(results.failures) >= 6
    assert any("0.1 mm/s" in failure and "wider than the ball" in failure for failure in results.failures)


def test_a_study_of_which_no_case_can_be_solved_is_an_error(real_data: Path, tmp_path: Path) -> None:
    path = _real_study(real_data, tmp_path, "25 N", 2, "1 um/s", "2 um/s")
    with pytest.raises(vf.StudyError, match="wider than the ball"):
        run_study(path)
