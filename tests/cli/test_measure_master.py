"""``viscofric measure`` and ``master``: what the commands print and write, and how they fail."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from click.testing import CliRunner, Result

import viscofric as vf
from viscofric.cli import main

if TYPE_CHECKING:
    from pathlib import Path

COULOMB, ZERO_FORCE = 0.05, 0.3
HEADER = "temperature (degC),replicate,disc speed (mm/s),ball speed (mm/s),load (N),traction force (N)"


def call(*words: object) -> Result:
    return CliRunner().invoke(main, [*map(str, words)], standalone_mode=True)


def viscoelastic(celsius: float, speed: float) -> float:
    """Friction of a formula; mm/s."""
    return 0.01 + 2e-4 * celsius - 0.002 * float(np.log10(speed))


def runs(
    path: Path,
    signs: tuple[int, ...] = (-1, 1),
    slips: tuple[int, ...] = (-1, 1),
    replicates: int = 2,
    noise: float = 0.0,
    load: float = 25.0,
) -> Path:
    """Write runs of the formula: both slips for each of the signs of the disc speed."""
    random = np.random.default_rng(3)
    rows = [HEADER]
    for celsius, speed, replicate, sign, slip in product(
        (30.0, 60.0), (20.0, 60.0, 200.0), range(1, replicates + 1), signs, slips
    ):
        force = ZERO_FORCE + load * (COULOMB * slip + viscoelastic(celsius, speed) * sign)
        force += noise * random.standard_normal()
        rows.append(f"{celsius},{replicate},{sign * speed},{sign * speed - 0.1 * slip * speed},{load},{force!r}")
    path.write_text("\n".join(rows), encoding="utf-8")
    return path


def record(*words: object) -> dict[str, Any]:
    done = call(*words, "--json")
    assert done.exit_code == 0, done.output
    found: dict[str, Any] = json.loads(done.stdout, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))
    return found


def test_measure_gives_what_python_gives(tmp_path: Path) -> None:
    path = runs(tmp_path / "runs.csv", noise=0.01)
    found, curves = record("measure", path), vf.separate(vf.read_mtm(path))
    assert found["format"] == "viscofric friction curves 1"
    for name in ("speed", "temperature", "load", "viscoelastic", "viscoelastic_error", "coulomb", "consistency"):
        assert [point[name] for point in found["points"]] == getattr(curves, name).tolist(), name
    assert set(found["units"]) == set(found["points"][0])
    assert found["inputs"]["runs"] == [str(path)]


def test_measure_prints_each_condition_with_its_friction(tmp_path: Path) -> None:
    done = call("measure", runs(tmp_path / "runs.csv", noise=0.01))
    assert done.exit_code == 0, done.output
    heading, *rows = done.stdout.split("\n\n")[0].splitlines()
    assert heading.split()[:4] == ["T", "(°C)", "speed", "(mm/s)"]
    assert len(rows) == 6
    for row, (celsius, speed) in zip(rows, product((30.0, 60.0), (20.0, 60.0, 200.0)), strict=True):
        cells = row.split()
        assert float(cells[0]) == celsius
        assert float(cells[1]) == pytest.approx(speed, rel=1e-3)  # four digits are printed
        # 0.01 N of noise over 25 N; four readings and two replicates leave 1/√8 of it, of which four times.
        assert float(cells[5]) == pytest.approx(viscoelastic(celsius, speed), abs=4 * 0.01 / 25 / np.sqrt(8))
    assert re.search(r"zero of the force cell  0\.(29|30)", done.stdout)
    assert "of 6 points" in done.stdout


def test_what_cannot_be_known_is_null_and_a_question_mark(tmp_path: Path) -> None:
    path = runs(tmp_path / "runs.csv", signs=(1,), replicates=1)
    found = record("measure", path, "--zero", "0.3 N")
    point = found["points"][0]
    assert " ± ?" in call("measure", path, "--zero", "0.3 N").stdout.splitlines()[1]
    assert point["viscoelastic_error"] is None
    assert point["viscoelastic"] == pytest.approx(viscoelastic(30.0, 20.0), rel=1e-9)  # no noise
    assert point["coulomb"] == pytest.approx(COULOMB, rel=1e-9)
    assert "consistency" not in point
    assert found["inputs"]["zero"] == "0.3 N"
    assert call("measure", path, "--zero", "0.3 N").exit_code == 0


def test_several_files_make_one_test(tmp_path: Path) -> None:
    back, forth = runs(tmp_path / "back.csv", signs=(-1,)), runs(tmp_path / "forth.csv", signs=(1,))
    assert "the signs of the velocities do not separate" in call("measure", back).output
    # One test was measured in two files: forwards in one, backwards in the other.
    found = record("measure", back, forth)
    np.testing.assert_allclose([point["offset"] for point in found["points"]], ZERO_FORCE, rtol=1e-9)  # no noise


def test_separated_curves_are_read_back_as_they_are(tmp_path: Path) -> None:
    path = runs(tmp_path / "runs.csv", noise=0.01)
    done = call("measure", path, "--out", tmp_path / "curves.csv")
    assert done.exit_code == 0, done.output
    assert f"curves   {tmp_path / 'curves.csv'}" in done.stdout
    curves, again = vf.separate(vf.read_mtm(path)), vf.read_friction_curves(tmp_path / "curves.csv")
    np.testing.assert_array_equal(again.viscoelastic, curves.viscoelastic)
    np.testing.assert_array_equal(again.viscoelastic_error, curves.viscoelastic_error)


def test_one_direction_of_slip_needs_an_assumption_which_is_reported(tmp_path: Path) -> None:
    path = runs(tmp_path / "runs.csv", slips=(1,))
    assert call("measure", path).exit_code == 1
    found = record("measure", path, "--coulomb", COULOMB, "--coulomb-error", "0.001")
    assert found["assumption"]
    for point in found["points"]:
        celsius, speed = point["temperature"] - 273.15, 1e3 * point["speed"]
        assert point["viscoelastic"] == pytest.approx(viscoelastic(celsius, speed), rel=1e-9)  # no noise
    assert "assumed" in call("measure", path, "--coulomb", COULOMB).stdout


def test_coulomb_friction_that_is_not_needed_is_reported(tmp_path: Path) -> None:
    done = call("measure", runs(tmp_path / "runs.csv"), "--coulomb", "45")
    assert done.exit_code == 0, done.output
    assert "The given Coulomb friction is not used" in done.stderr


def test_steps_that_are_not_steady_are_left_out(tmp_path: Path) -> None:
    heading, *rows = runs(tmp_path / "runs.csv").read_text(encoding="utf-8").splitlines()
    steady = [f"{row},{number}" for number, row in enumerate(rows, 1)]
    # A step in which the load rises evenly, without the gap that parts nominal ones.
    rising = [
        f"30,1,{sign * 20},{sign * 20 - 2 * slip},{load},{0.1 * load},99"
        for load, sign, slip in product(np.linspace(5.0, 25.0, 60).round(3), (-1, 1), (-1, 1))
    ]
    (tmp_path / "steps.csv").write_text("\n".join([f"{heading},step", *steady, *rising]), encoding="utf-8")
    alone = call("measure", tmp_path / "steps.csv")
    assert alone.exit_code == 1
    assert "--except-steps 99" in alone.output
    found = record("measure", tmp_path / "steps.csv", "--except-steps", "99")
    assert found["inputs"]["except_steps"] == [99]
    whole = record("measure", tmp_path / "runs.csv")
    assert [point["viscoelastic"] for point in found["points"]] == [point["viscoelastic"] for point in whole["points"]]


def test_measure_draws_a_picture_and_calls_made_data_synthetic(tmp_path: Path) -> None:
    path = runs(tmp_path / "runs.csv")
    done = call("measure", path, "--picture", tmp_path / "curves.svg", "--synthetic")
    assert done.exit_code == 0, done.output
    assert done.stdout.splitlines()[-1] == f"picture  {tmp_path / 'curves.svg'}"
    assert (tmp_path / "curves.svg").stat().st_size > 0


@pytest.mark.parametrize(
    ("words", "status", "reported"),
    [
        (["measure"], 2, "Missing argument"),
        (["measure", "nothing.csv"], 1, "nothing.csv: no such file"),
        (["measure", "runs.csv", "--zero", "0.1 mm"], 1, "wrong kind of unit"),
        (["measure", "runs.csv", "--speed-tolerance", "2"], 1, "between 0 and 1"),
        (["measure", "runs.csv", "--picture", "a.txt"], 2, "must end in .png, .svg, .pdf"),
        (["measure", "runs.csv", "--coulomb", "much"], 2, "'constant'"),
        (["measure", "runs.csv", "--zero-error", "0.1 N"], 2, "which is not given"),
        (["measure", "runs.csv", "--coulomb", "constant", "--coulomb-error", "0.1"], 2, "goes with a number"),
        (["measure", "runs.csv", "--except-steps", "two"], 2, "numbers of steps"),
        (["measure", "runs.csv", "--except-steps", "2"], 1, "step"),
        (["measure", "runs.csv", "--out", "runs.csv"], 1, "would be overwritten"),
        (["measur"], 2, "Did you mean 'measure'?"),
    ],
)
def test_mistakes_are_one_sentence(
    words: list[object], status: int, reported: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    runs(tmp_path / "runs.csv")
    done = call(*words)
    assert done.exit_code == status, done.output
    assert reported in done.output
    assert "Traceback" not in done.output
    assert len([line for line in done.output.splitlines() if line.startswith("Error: ")]) == 1


LAW = vf.WLF(C1=9.0, C2=100.0, reference="30 degC")
TEMPERATURES = np.array([30.0, 35.0, 40.0, 46.0]) + 273.15


def curves(path: Path, temperatures: Any = TEMPERATURES, noise: float = 0.01, load: float = 25.0) -> Path:
    """Write friction curves of one formula over the reduced speed, with shift factors of the law."""
    kelvin, speed = (grid.ravel() for grid in np.meshgrid(temperatures, np.geomspace(0.02, 0.2, 8), indexing="ij"))
    friction = 0.01 * (1.0 + (LAW(kelvin) * speed / 0.02) ** -0.4)
    error = noise * friction
    moved = friction + error * np.random.default_rng(5).standard_normal(error.size)
    same = np.full(error.size, load)
    vf.write_friction_curves(
        vf.FrictionCurves(speed, kelvin, same, moved, error, 3.0 * error, np.full(error.size, 9)), path
    )
    return path


def test_shift_finds_the_planted_factors_and_writes_them(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv")
    found = record("master", path, "--reference", "30 degC", "--out", tmp_path / "alpha.csv")
    assert found["found"]
    planted = LAW.log10(np.array(found["temperature"]))
    apart = np.abs(found["log10_shift_factor"] - planted)
    # Four standard errors, of three factors; that of the reference is exact but for rounding.
    assert np.all(apart <= 4.0 * np.array(found["standard_error"]) + 1e-12)
    assert max(found["standard_error"]) < 0.1
    written = vf.read_shift_factors(tmp_path / "alpha.csv")
    # The reference's own is zero but for rounding.
    np.testing.assert_allclose(written.log10_values, found["log10_shift_factor"], rtol=0.0, atol=1e-15)
    np.testing.assert_array_equal(written.covariance, found["covariance"])


def test_shift_lays_the_modulus_beside(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv")
    vf.ShiftFactors(TEMPERATURES, LAW.log10(TEMPERATURES), "30 degC").save(tmp_path / "dma.csv")
    words = ("master", path, "--shift", tmp_path / "dma.csv", "--law", "arrhenius")
    found = record(*words)
    assert found["reference"] == pytest.approx(303.15)  # that of the modulus
    assert found["law"]["kind"] == "Arrhenius"
    # Planted in both: noise of 1 % decides, so that neither is to be called wrong at one in a thousand.
    assert found["agreement"]["p_value"] > 1e-3
    assert found["agreement"]["slope"] == pytest.approx(1.0, abs=4.0 * found["agreement"]["slope_error"])
    done = call(*words, "--picture", tmp_path / "alpha.svg")
    assert done.exit_code == 0, done.output
    assert "of the modulus" in done.stdout.splitlines()[0]
    assert (tmp_path / "alpha.svg").stat().st_size > 0


def test_curves_without_errors_say_what_the_errors_of_their_shift_are(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv", noise=0.0)
    done = call("master", path)
    assert done.exit_code == 0, done.output
    assert "from the scatter of the points about one curve" in done.stdout
    assert "± 0.000" not in done.stdout
    assert "from the scatter" not in call("master", curves(tmp_path / "noisy.csv")).stdout


def test_a_law_is_found_among_few_temperatures(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv")  # four of them
    assert record("master", path)["law"] is not None
    assert "No law is fitted" not in call("master", path).stderr


def test_the_best_law_says_why_and_how_well_it_fits(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv", 273.15 + np.arange(30.0, 55.0, 4.0))
    found = record("master", path)
    assert found["law"] is not None
    assert found["law_explanation"]
    assert found["law_explanation"] in call("master", path).stdout
    assert record("master", path, "--law", "wlf")["law_explanation"] is None


def test_friction_below_zero_is_reported(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv")
    measured = vf.read_friction_curves(path)
    vf.write_friction_curves(replace(measured, viscoelastic=-measured.viscoelastic), path)
    done = call("master", path)
    assert "Viscoelastic friction is below zero at 32 of 32 points" in done.output


def test_curves_without_overlap_show_no_factor(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv", [303.15, 363.15])
    alone = call("master", path)
    assert alone.exit_code == 1
    assert "do not overlap" in alone.output
    beside = call("master", path, "--shift", "synthetic fluoroelastomer", "--reference", "30 degC")
    assert beside.exit_code == 0, beside.output
    assert "No shift factors from friction" in beside.output
    reported = record("master", path, "--shift", "synthetic fluoroelastomer", "--reference", "30 degC")
    law = vf.synthetic_fluoroelastomer().shift
    assert law is not None
    assert not reported["found"]
    assert reported["covariance"] is None
    np.testing.assert_allclose(reported["log10_shift_factor"], law.log10(np.array([303.15, 363.15])), atol=1e-12)
    refused = call("master", path, "--shift", "synthetic fluoroelastomer", "--out", tmp_path / "alpha.csv")
    assert refused.exit_code == 1
    assert "alpha.csv is not written" in refused.output
    assert not (tmp_path / "alpha.csv").exists()


def test_curves_of_one_temperature_are_shifted_by_given_factors(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv", [363.15])
    assert "have no shift factor" in call("master", path).output
    assert call("master", path, "--shift", "synthetic fluoroelastomer").exit_code == 0


def test_runs_are_separated_before_they_are_shifted(tmp_path: Path) -> None:
    done = call("master", runs(tmp_path / "runs.csv", noise=0.01), "--shift", "synthetic fluoroelastomer")
    assert done.exit_code == 0, done.output
    assert "60.0" in done.stdout


def test_loads_are_reduced_to_one_with_the_ball(tmp_path: Path) -> None:
    one, other = curves(tmp_path / "one.csv"), curves(tmp_path / "other.csv", load=35.0)
    assert "a master curve holds at one load" in call("master", one, other).output
    assert call("master", one, other, "--ball", "9.525 mm").exit_code == 0


@pytest.mark.parametrize(
    ("words", "status", "reported"),
    [
        (["master", "nothing.csv"], 1, "nothing.csv: no such file"),
        (["master", "curves.csv", "runs.csv"], 1, "runs.csv is none"),
        (["master", "curves.csv", "--shift", "no rubber"], 1, "no rubber"),
        (["master", "curves.csv", "--reference", "90 degC"], 1, "lies outside the friction curves"),
        (["master", "curves.csv", "--zero", "0.1 N"], 2, "--zero: only runs are separated"),
        (["master", "curves.csv", "--leave-out-outliers"], 2, "--leave-out-outliers: only runs"),
        (["identify", "curves.csv", "--ball", "1 mm", "--speed-tolerance", "0.2"], 2, "--speed-tolerance: only runs"),
        (["master", "mu.csv"], 1, "has a column 'viscoelastic friction'"),
        (["master", "curves.csv", "--out", "alpha.json"], 2, "must end in .csv"),
        (["master", "curves.csv", "--out", "curves.csv"], 1, "would be overwritten"),
    ],
)
def test_mistakes_of_shifting_are_one_sentence(
    words: list[object], status: int, reported: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    runs(tmp_path / "runs.csv")
    text = curves(tmp_path / "curves.csv").read_text(encoding="utf-8")
    (tmp_path / "mu.csv").write_text(text.replace("viscoelastic friction", "mu"), encoding="utf-8")
    done = call(*words)
    assert done.exit_code == status, done.output
    assert reported in done.output
    assert len([line for line in done.output.splitlines() if line.startswith("Error: ")]) == 1
