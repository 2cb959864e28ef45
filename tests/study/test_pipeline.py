"""The whole job on the built-in synthetic example: what went into the data must come out again."""

from __future__ import annotations

import math
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import viscofric as vf
from contact.dense_reference import dense_friction
from refusals import refused
from viscofric import load_study, open_results, run_study
from viscofric.notes import codes
from viscofric.study import StudyResults
from viscofric.study.checking import check_study
from viscofric.study.make_rubber import make_rubber

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = Path(str(files("viscofric"))) / "templates" / "paper"
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
[uncertainty]
draws = 0
"""


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> StudyResults:
    """Results of the built-in study, with fewer points between the measured ones, and fewer samples of the rubber."""
    text = (EXAMPLE / "study.toml").read_text(encoding="utf-8").replace("points = 10", "points = 3")
    folder = tmp_path_factory.mktemp("study")
    for name in ("dma.csv", "mtm.csv"):
        (folder / name).write_bytes((EXAMPLE / name).read_bytes())
    text = text.replace("accuracy = 1e-3", "accuracy = 1e-3\nmaster_curve_points = 21")
    text = text.replace("draws = 200", "draws = 60")  # bands are known to 9 %
    (folder / "study.toml").write_text(text, encoding="utf-8")
    return run_study(folder / "study.toml")


@pytest.mark.slow
def test_planted_shift_factors_come_back_within_their_errors(results: StudyResults) -> None:
    found = results.tree["shift_factors"]
    planted = vf.synthetic_fluoroelastomer().shift
    assert planted is not None
    difference = found["log10_shift_factor"].values - planted.log10(found["temperature"].values)
    error = found["standard_error"].values
    measured = error > 0.0  # the reference itself is exact
    # 22 correlated values, the errors of which were found 2 to 4 % small: three of them, and 0.05 decade (12 %).
    assert np.abs(difference[measured] / error[measured]).max() < 3.0
    assert np.abs(difference).max() < 0.05
    law = results.tree["shift_law"].attrs
    # About 30 °C the planted WLF (17.44, 51.6 K about -18 °C) has C2 = 51.6 + 48 and C1 = 17.44 · 51.6/C2.
    assert law["wlf_C2"] == pytest.approx(99.6, abs=3.0 * law["wlf_C2_error"])
    assert law["wlf_C1"] == pytest.approx(17.44 * 51.6 / 99.6, abs=3.0 * law["wlf_C1_error"])


@pytest.mark.slow
def test_planted_modulus_comes_back_within_the_noise(results: StudyResults) -> None:
    curve = results.tree["master_curve"]
    planted = vf.synthetic_fluoroelastomer().complex_modulus(curve["angular_frequency"].values)
    for fitted, true in (("fitted_storage_modulus", planted.real), ("fitted_loss_modulus", planted.imag)):
        error = curve[fitted].values / true - 1.0
        # The noise is 1 %; the fit averages over some ten readings a mode, and the shifts add as much again.
        assert np.sqrt(np.mean(error**2)) < 0.01
        assert abs(error.mean()) < 0.005
    assert results.tree["spectrum"].attrs["E0"] == pytest.approx(3e6, rel=0.005)


@pytest.mark.slow
def test_planted_coulomb_friction_comes_back(results: StudyResults) -> None:
    measured = results.tree["measurement"]
    z = (measured["coulomb"].values - 0.045) / measured["coulomb_error"].values
    # 30 points with seven degrees of freedom each: Student's t goes beyond 6 once in 2,000 such tests.
    assert np.abs(z).max() < 6.0
    assert abs(z.mean()) < 3.0 * math.sqrt(1.4 / len(z))  # variance of t with seven degrees of freedom


@pytest.mark.slow
def test_planted_viscoelastic_friction_is_measured(results: StudyResults) -> None:
    measured = results.tree["measurement"]
    planted = np.loadtxt(ROOT / "tests" / "data" / "planted_paper_friction.csv", delimiter=",", skiprows=3)[:, 2]
    z = (measured["viscoelastic"].values - planted) / measured["viscoelastic_error"].values
    assert len(z) == 30
    assert np.abs(z).max() < 6.0  # as above
    assert abs(z.mean()) < 3.0 * math.sqrt(1.4 / len(z))


@pytest.mark.slow
def test_planted_viscoelastic_friction_is_predicted_from_the_sweeps(results: StudyResults) -> None:
    """From noisy sweeps alone: through shift factors, master curve, spectrum and contact."""
    predicted = results.tree["measurement"]["predicted"].values
    planted = np.loadtxt(ROOT / "tests" / "data" / "planted_paper_friction.csv", delimiter=",", skiprows=3)[:, 2]
    error = predicted / planted - 1.0
    # Accuracy 1e-3 of the contact; the rest is 1 % noise of the sweeps, averaged, and shifts good to 2 to 4 %,
    # each of which moves friction by at most a third as much.
    assert np.sqrt(np.mean(error**2)) < 0.01
    assert abs(error.mean()) < 0.007
    assert abs(results.tree["agreement"].attrs["bias"]) < 0.01


@pytest.mark.slow
def test_bands_hold_the_planted_friction(results: StudyResults) -> None:
    measured = results.tree["measurement"]
    planted = np.loadtxt(ROOT / "tests" / "data" / "planted_paper_friction.csv", delimiter=",", skiprows=3)[:, 2]
    z = (measured["predicted"].values - planted) / measured["predicted_material_error"].values
    # Errors of the rubber are shared by neighbouring points, so that few of the 30 are independent.
    assert np.abs(z).max() < 3.0
    lower, upper = (measured[f"predicted_{side}"].values for side in ("lower", "upper"))
    assert np.all((lower < measured["predicted"].values) & (measured["predicted"].values < upper))
    # 1 % noise of the sweeps, averaged over many readings: the bands are a few per cent wide, and not wider.
    assert np.all((upper - lower) / planted < 0.1)


@pytest.mark.slow
def test_temperatures_fall_on_one_friction_master_curve(results: StudyResults) -> None:
    measured = results.tree["measurement"]
    master = results.tree["prediction_master"]
    line = CubicSpline(np.log(master["speed"].values), master["friction_coefficient"].values)
    error = line(np.log(measured["reduced_speed"].values)) / measured["viscoelastic"].values - 1.0
    # Scatter of the means is 1 %, that of the prediction as above; 21 points over four decades are smooth to less.
    assert np.sqrt(np.mean(error**2)) < 0.02


@pytest.mark.slow
def test_one_load_is_one_load_in_every_table(results: StudyResults) -> None:
    for name in ("prediction", "prediction_master"):
        assert set(results.tree[name]["load"].values.ravel().tolist()) == {25.0}


@pytest.mark.slow
def test_results_are_labelled_with_units_and_provenance(results: StudyResults) -> None:
    stored = open_results(results.folder)
    assert stored.tree.attrs["data_origin"] == "synthetic"
    assert "dma.csv" in stored.tree.attrs["input_hashes"]
    assert stored.tree.attrs["viscofric_version"] == vf.__version__
    for group in stored.tree.subtree:
        for name, variable in group.variables.items():
            assert variable.attrs["units"]
            assert variable.attrs["long_name"]
            if variable.dtype.kind in "OU":  # names of laws, and their constants
                assert all(variable.values.astype(str))
            elif group.name == "assumptions" and name == "value":
                # How thick the rubber is was not said, so that its half-space cannot be judged.
                judged = group["holds"].values >= 0
                np.testing.assert_array_equal(np.isfinite(variable.values), judged)
            else:
                assert np.all(np.isfinite(variable.values.astype(float)))


@pytest.mark.slow
def test_left_out_isotherms_and_small_strain_are_reported(results: StudyResults) -> None:
    assert "left-out" in codes(results.notes)
    assert codes(results.warnings) == {"large-strain"}
    assert results.failures == ()


def _real_study(
    real_data: Path, folder: Path, load: str, points: int, slowest: str = "0.1 mm/s", fastest: str = "10 m/s"
) -> Path:
    path = folder / "study.toml"
    dma = (real_data / "dma" / "acrylic_468mp.csv").resolve().as_posix()
    text = REAL_STUDY.format(dma=dma, load=load, points=points, slowest=slowest, fastest=fastest)
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.slow
def test_real_acrylic_isotherms_run_to_friction(real_data: Path, tmp_path: Path) -> None:
    results = run_study(_real_study(real_data, tmp_path, "0.05 N", 3))
    assert results.failures == ()
    isotherms = results.tree["isotherms"]
    assert isotherms.sizes["reading"] == 339  # 340 rows less the negative loss modulus
    # Measured in shear: the first row's 260.04053 MPa is G', so that E' = 2 (1 + 0.5) G'.
    assert isotherms["storage_modulus"].values[0] == pytest.approx(3.0 * 260.04053e6, rel=1e-9)
    (left_out,) = [note for note in results.notes if note.code == "points-left-out"]
    assert "ine 18" in left_out
    assert "extrapolated" in results.tree["spectrum"].attrs["E0_remark"]
    prediction = results.tree["prediction"]
    assert prediction.sizes == {"temperature": 3, "speed": 3}
    # Friction is known to 1e-3; of the two ways to it the slower one may be a few times farther off.
    assert np.all(np.abs(prediction["energy_balance"]) < 5e-3)


@pytest.mark.slow
def test_real_acrylic_friction_is_that_of_an_independent_solution(real_data: Path) -> None:
    sweeps = vf.read_dma(real_data / "dma" / "acrylic_468mp.csv", deformation="shear")
    fit = vf.superpose(sweeps, reference="20 degC")
    rubber = vf.Material(vf.fit_retardation_spectrum(fit.master_curve), shift=fit.shift_factors)
    spectrum = rubber.at("30 degC")
    solution = vf.solve_steady(
        rubber, vf.Ball(radius="9.525 mm"), speed="10 mm/s", load="0.05 N", temperature="30 degC"
    )
    friction, indentation = dense_friction(
        spectrum.E0, spectrum.E_inf, spectrum.C, spectrum.tau, 0.5, 9.525e-3, 0.05, 0.01, cells=20
    )
    # 20 cells across the contact: up to 1 % in friction and a few thousandths in the indentation.
    assert solution.friction_coefficient == pytest.approx(friction, rel=0.015)
    assert solution.indentation == pytest.approx(indentation, rel=0.005)


@pytest.mark.slow
def test_contacts_wider_than_the_ball_are_reported_and_the_others_kept(real_data: Path, tmp_path: Path) -> None:
    results = run_study(_real_study(real_data, tmp_path, "25 N", 2))
    # At 0.1 mm/s the rubber is too soft at 30 and 60 °C, but not at 0 °C, nor at 10 m/s.
    assert results.tree["prediction"]["failed"].values.tolist() == [[0, 0], [1, 0], [1, 0]]
    asked = [failure for failure in results.failures if ", 0.1 mm/s: " in failure]
    assert [failure.split(",")[0] for failure in asked] == ["30 °C", "60 °C"]
    assert codes(results.failures) == {"beyond-indenter"}


@pytest.mark.slow
def test_a_study_of_which_no_case_can_be_solved_is_an_error(real_data: Path, tmp_path: Path) -> None:
    path = _real_study(real_data, tmp_path, "25 N", 2, "1 um/s", "2 um/s")
    with refused("nothing-solved", vf.StudyError):
        run_study(path)


def _small_study(folder: Path, **changes: str) -> Path:
    """Write a quick study of the synthetic sweeps, with some of its lines replaced."""
    (folder / "dma.csv").write_bytes((EXAMPLE / "dma.csv").read_bytes())
    lines = {
        "dma": 'dma = "dma.csv"',
        "deformation": 'deformation = "tension"',
        "poisson_ratio": "poisson_ratio = 0.5",
        "reference_temperature": 'reference_temperature = "30 degC"',
        "shift": 'shift = "measured"',
        "tau_ratio": "tau_ratio = 2.718281828459045",
        "indenter": '[indenter]\nradius = "9.525 mm"',
        "load": '[conditions]\nload = "25 N"',
        "speed": 'speed = "100 mm/s"',
        "temperature": 'temperature = "90 degC"',
        "accuracy": "[solver]\naccuracy = 1e-2",
        "master_curve_points": "master_curve_points = 2",
        "draws": "[uncertainty]\ndraws = 0",
    }
    path = folder / "study.toml"
    path.write_text("\n".join(["[material]", *{**lines, **changes}.values()]), encoding="utf-8")
    return path


@pytest.mark.apart
def test_every_line_of_a_study_reaches_the_answer(tmp_path: Path) -> None:
    """In one folder, so that a stored case of another study taken for this one's shows as well."""

    def friction(**changes: str) -> float:
        results = run_study(_small_study(tmp_path, **changes), output=tmp_path / "results", resume=True)
        return float(results.tree["prediction"]["friction_coefficient"])

    first = friction()
    # At 90 °C friction depends on each of these by more than the accuracy or by what is exactly known.
    changed = {
        name: friction(**{name: line})
        for name, line in {
            "load": '[conditions]\nload = "12 N"',
            "speed": 'speed = "50 mm/s"',
            "temperature": 'temperature = "80 degC"',
            "indenter": '[indenter]\nradius = "7 mm"',
            "accuracy": "[solver]\naccuracy = 1e-4",
            "tau_ratio": "tau_ratio = 10.0",
            "shift": 'shift = "wlf"',
            "poisson_ratio": "poisson_ratio = 0.4",
        }.items()
    }
    assert all(value != first for value in changed.values())
    # A ball's friction is a0/R Φ(v/a0): with ν a0³ grows as 1 − ν², as it does with the load.
    stiffer = friction(poisson_ratio="poisson_ratio = 0.4", load=f'[conditions]\nload = "{25.0 * 0.75 / 0.84:.12f} N"')
    assert stiffer == pytest.approx(first, rel=1e-6)
    assert friction() == first


@pytest.mark.slow
def test_moduli_measured_in_shear_become_tensile_with_the_given_poisson_ratio(tmp_path: Path) -> None:
    text = (EXAMPLE / "dma.csv").read_text(encoding="utf-8").replace("E' (MPa),E'' (MPa)", "G' (MPa),G'' (MPa)")
    in_tension = make_rubber(load_study(_small_study(tmp_path)).material).material.modes_at().E0
    path = _small_study(tmp_path, deformation='deformation = "shear"', poisson_ratio="poisson_ratio = 0.3")
    (tmp_path / "dma.csv").write_text(text, encoding="utf-8")
    results = run_study(path)
    assert results.tree.attrs["deformation"] == "shear"
    assert results.tree["spectrum"].attrs["E0"] == pytest.approx(2.6 * in_tension, rel=1e-9)


@pytest.mark.slow
def test_a_file_that_states_neither_tension_nor_shear_needs_it_stated(tmp_path: Path) -> None:
    path = _small_study(tmp_path, deformation="")
    check_study(load_study(path), path)  # its header says E'
    text = (EXAMPLE / "dma.csv").read_text(encoding="utf-8")
    untold = text.replace("E' (MPa),E'' (MPa)", "storage modulus (MPa),loss modulus (MPa)")
    (tmp_path / "dma.csv").write_text(untold, encoding="utf-8")
    with refused("no-deformation"):
        check_study(load_study(path), path)


@pytest.mark.slow
def test_contacts_beyond_the_measured_frequencies_are_reported(tmp_path: Path) -> None:
    results = run_study(_small_study(tmp_path, speed='speed = ["100 mm/s", "1e8 m/s"]'))
    assert results.tree["prediction"]["within_measured_frequencies"].values.tolist() == [1, 0]
    assert "friction_lower" not in results.tree["prediction"]  # no samples were asked for
    assert "no-bands" not in {note.code for note in results.notes}
    assert "beyond-measured" in {warning.code for warning in results.warnings}


@pytest.mark.slow
def test_contacts_beyond_the_modes_of_an_unknown_measurement_are_reported(tmp_path: Path) -> None:
    unset = dict.fromkeys(["deformation", "poisson_ratio", "reference_temperature", "shift", "tau_ratio"], "")
    changes = {"dma": 'catalogue = "PVB interlayer"', "temperature": 'temperature = "40 degC"'} | unset
    beyond, within = (
        run_study(_small_study(tmp_path, **changes, speed=f"speed = [{speeds}]"), output=tmp_path / f"{number}.results")
        for number, speeds in enumerate(['"1 mm/s", "1e12 m/s"', '"1 mm/s"'])
    )
    assert beyond.tree["prediction"]["within_measured_frequencies"].values.tolist() == [1, 0]
    assert "beyond-measured" in {warning.code for warning in beyond.warnings}
    # What is unknown is not said to be measured.
    assert "within_measured_frequencies" not in within.tree["prediction"]
    assert "beyond-measured" not in {warning.code for warning in within.warnings}
    assert "frequencies-unknown" in {note.code for note in within.notes}


@pytest.mark.slow
def test_temperatures_without_shift_factor_are_reported_before_anything_is_solved(tmp_path: Path) -> None:
    with refused("outside-measured"):
        run_study(_small_study(tmp_path, temperature='temperature = ["90 degC", "400 degC"]'))
    assert not list(tmp_path.glob("study.results/cases/*.json"))


def test_unwritable_output_is_reported_before_anything_is_solved(tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("a file")
    with refused("is-file", vf.DataFileError):
        run_study(_small_study(tmp_path), output=tmp_path / "taken")


def test_inertia_is_that_of_the_speeds_of_cases_not_of_the_master_curve(tmp_path: Path) -> None:
    """At 0 °C this rubber is so hard that 15 m/s are slow; the reduced speed at its reference is hundreds of m/s."""
    lines = [
        '[material]\ncatalogue = "synthetic tread rubber"\n[indenter]\nshape = "cylinder"\nradius = "5 mm"',
        '[conditions]\nload = "2 N/mm"\ntemperature = "0 degC"\nspeed = ["1 m/s", "15 m/s"]',
        "[solver]\naccuracy = 0.1\nmaster_curve_points = 2\n[uncertainty]\ndraws = 0",
    ]
    path = tmp_path / "study.toml"
    path.write_text("\n".join(lines), encoding="utf-8")
    assert "quasi-static" not in codes(run_study(path).warnings)
    path.write_text("\n".join(lines).replace("0 degC", "60 degC").replace("15 m/s", "60 m/s"), encoding="utf-8")
    (note,) = (one for one in run_study(path, output=tmp_path / "warm").warnings if one.code == "quasi-static")
    assert "60" in note.where
    assert note.values["contacts"] <= 2
