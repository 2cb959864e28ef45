"""``viscofric measure`` and ``master``: what the commands print and write, and how they fail."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from cli.calls import call, record, refusal, succeed
from cli.friction_files import COULOMB, LAW, TEMPERATURES, ZERO_FORCE, curves, runs, viscoelastic
from viscofric.report.figures import saving


def test_measure_gives_what_python_gives(tmp_path: Path) -> None:
    path = runs(tmp_path / "runs.csv", noise=0.01)
    found, curves = record("measure", path), vf.separate(vf.read_mtm(path))
    assert found["format"] == "viscofric friction curves 2"
    for name in ("speed", "temperature", "load", "viscoelastic", "viscoelastic_error", "coulomb", "consistency"):
        assert found["results"][name] == getattr(curves, name).tolist(), name
    assert found["results"]["units"]["load"] == "N"
    assert found["inputs"]["runs"] == [str(path)]


def test_measure_prints_each_condition_with_its_friction(tmp_path: Path) -> None:
    done = succeed("measure", runs(tmp_path / "runs.csv", noise=0.01))
    heading, *rows = done.stdout.split("\n\n")[0].splitlines()
    assert heading.split()[:4] == ["T", "(°C)", "speed", "(mm/s)"]
    assert len(rows) == 6
    for row, (celsius, speed) in zip(rows, product((30.0, 60.0), (20.0, 60.0, 200.0)), strict=True):
        cells = row.split()
        assert float(cells[0]) == celsius
        assert float(cells[1]) == pytest.approx(speed, rel=1e-3)  # four digits are printed
        # 0.01 N of noise over 25 N; four readings and two replicates leave 1/√8 of it, of which four times.
        assert float(cells[5]) == pytest.approx(viscoelastic(celsius, speed), abs=4 * 0.01 / 25 / np.sqrt(8))
    zero = re.search(r"zero\D+([0-9.]+)", done.stdout)
    assert zero
    assert float(zero[1]) == pytest.approx(ZERO_FORCE, abs=0.01)


def test_columns_that_are_not_understood_are_named(tmp_path: Path) -> None:
    path = runs(tmp_path / "runs.csv")
    strange = tmp_path / "strange.csv"
    strange.write_text(path.read_text(encoding="utf-8").replace("disc speed", "V1"), encoding="utf-8")
    assert call("measure", strange).exit_code == 1
    known = record("measure", path)
    found = record("measure", strange, "--column", "disc_speed=V1 (mm/s)")
    assert found["results"]["viscoelastic"] == known["results"]["viscoelastic"]
    assert found["inputs"]["columns"] == {"disc_speed": "V1 (mm/s)"}
    assert "columns" not in known["inputs"]


def test_what_cannot_be_known_is_null_and_a_question_mark(tmp_path: Path) -> None:
    path = runs(tmp_path / "runs.csv", signs=(1,), replicates=1)
    found = record("measure", path, "--zero", "0.3 N")
    point = {name: values[0] for name, values in found["results"].items() if isinstance(values, list)}
    assert " ± ?" in call("measure", path, "--zero", "0.3 N").stdout.splitlines()[1]
    assert point["viscoelastic_error"] is None
    assert point["viscoelastic"] == pytest.approx(viscoelastic(30.0, 20.0), rel=1e-9)  # no noise
    assert point["coulomb"] == pytest.approx(COULOMB, rel=1e-9)
    assert "consistency" not in point
    assert found["inputs"]["zero"] == 0.3
    succeed("measure", path, "--zero", "0.3 N")


def test_several_files_make_one_test(tmp_path: Path) -> None:
    back, forth = runs(tmp_path / "back.csv", signs=(-1,)), runs(tmp_path / "forth.csv", signs=(1,))
    assert refusal("measure", back)[:2] == (1, "signs-missing")
    # One test was measured in two files: forwards in one, backwards in the other.
    found = record("measure", back, forth)
    np.testing.assert_allclose(found["results"]["offset"], ZERO_FORCE, rtol=1e-9)  # no noise


def test_separated_curves_are_read_back_as_they_are(tmp_path: Path) -> None:
    path = runs(tmp_path / "runs.csv", noise=0.01)
    done = succeed("measure", path, "--out", tmp_path / "curves.csv")
    assert f"curves   {tmp_path / 'curves.csv'}" in done.stdout
    curves, again = vf.separate(vf.read_mtm(path)), vf.read_friction_curves(tmp_path / "curves.csv")
    np.testing.assert_array_equal(again.viscoelastic, curves.viscoelastic)
    np.testing.assert_array_equal(again.viscoelastic_error, curves.viscoelastic_error)


def test_one_direction_of_slip_needs_an_assumption_which_is_reported(tmp_path: Path) -> None:
    path = runs(tmp_path / "runs.csv", slips=(1,))
    assert call("measure", path).exit_code == 1
    found = record("measure", path, "--coulomb", COULOMB, "--coulomb-error", "0.001")
    points = found["results"]
    for kelvin, speed, friction in zip(points["temperature"], points["speed"], points["viscoelastic"], strict=True):
        assert friction == pytest.approx(viscoelastic(kelvin - 273.15, 1e3 * speed), rel=1e-9)  # no noise
    assert points["assumption"] in call("measure", path, "--coulomb", COULOMB, "--coulomb-error", "0.001").stdout


def test_coulomb_friction_that_is_not_needed_is_reported(tmp_path: Path) -> None:
    path = runs(tmp_path / "runs.csv")
    alone = record("measure", path)
    given = record("measure", path, "--coulomb", "45")
    assert given["results"]["viscoelastic"] == alone["results"]["viscoelastic"]
    (more,) = (one for one in given["note_records"] if one not in alone["note_records"])
    assert (more["code"], len(given["notes"])) == ("coulomb-not-used", len(alone["notes"]) + 1)
    assert "Note: " in call("measure", path, "--coulomb", "45").stderr


def test_steps_that_are_not_steady_are_left_out(tmp_path: Path) -> None:
    heading, *rows = runs(tmp_path / "runs.csv").read_text(encoding="utf-8").splitlines()
    steady = [f"{row},{number}" for number, row in enumerate(rows, 1)]
    # A step in which the load rises evenly, without the gap that parts nominal ones.
    rising = [
        f"30,1,{sign * 20},{sign * 20 - 2 * slip},{load},{0.1 * load},99"
        for load, sign, slip in product(np.linspace(5.0, 25.0, 60).round(3), (-1, 1), (-1, 1))
    ]
    (tmp_path / "steps.csv").write_text("\n".join([f"{heading},step", *steady, *rising]), encoding="utf-8")
    alone = refusal("measure", tmp_path / "steps.csv")
    assert (alone.status, alone.code) == (1, "no-gap")
    assert "--except-steps 99" in alone.sentence
    found = record("measure", tmp_path / "steps.csv", "--except-steps", "99")
    assert found["inputs"]["except_steps"] == [99]
    whole = record("measure", tmp_path / "runs.csv")
    assert found["results"]["viscoelastic"] == whole["results"]["viscoelastic"]


@pytest.mark.parametrize(
    ("remark", "option", "made_up"),
    [("", False, False), ("", True, True), ("# SYNTHETIC data\n", False, True)],
    ids=["measured", "by the option", "by the file"],
)
def test_a_picture_calls_made_data_synthetic(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, remark: str, option: bool, made_up: bool
) -> None:
    marked: list[object] = []
    monkeypatch.setattr(saving, "mark_synthetic", marked.append)
    path = runs(tmp_path / "runs.csv")
    path.write_text(remark + path.read_text(encoding="utf-8").replace("SYNTHETIC", ""), encoding="utf-8")
    done = succeed("measure", path, "--picture", tmp_path / "curves.svg", *(["--synthetic"] if option else []))
    assert done.stdout.splitlines()[-1] == f"picture  {tmp_path / 'curves.svg'}"
    assert (tmp_path / "curves.svg").stat().st_size > 0
    assert bool(marked) is made_up


def test_shift_finds_the_planted_factors_and_writes_them(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv")
    found = record("master", path, "--reference", "30 degC", "--out", tmp_path / "alpha.csv")
    assert found["found"]
    planted = LAW.log10(np.array(found["results"]["temperature"]))
    apart = np.abs(found["results"]["log10_shift_factor"] - planted)
    # Four standard errors, of three factors; that of the reference is exact but for rounding.
    assert np.all(apart <= 4.0 * np.array(found["results"]["standard_error"]) + 1e-12)
    assert max(found["results"]["standard_error"]) < 0.1
    written = vf.read_shift_factors(tmp_path / "alpha.csv")
    # The reference's own is zero but for rounding.
    np.testing.assert_allclose(written.log10_values, found["results"]["log10_shift_factor"], rtol=0.0, atol=1e-15)
    np.testing.assert_array_equal(written.covariance, found["covariance"])


def test_shift_lays_the_modulus_beside(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv")
    vf.ShiftFactors(TEMPERATURES, LAW.log10(TEMPERATURES), "30 degC").save(tmp_path / "dma.csv")
    words = ("master", path, "--shift", tmp_path / "dma.csv", "--law", "arrhenius")
    found = record(*words)
    assert found["results"]["reference_temperature"] == pytest.approx(303.15)  # that of the modulus
    assert found["law"]["kind"] == "Arrhenius"
    # Planted in both: noise of 1 % decides, so that neither is to be called wrong at one in a thousand.
    assert found["agreement"]["p_value"] > 1e-3
    assert found["agreement"]["slope"] == pytest.approx(1.0, abs=4.0 * found["agreement"]["slope_error"])
    succeed(*words, "--picture", tmp_path / "alpha.svg")
    assert (tmp_path / "alpha.svg").stat().st_size > 0


def test_curves_without_errors_say_what_the_errors_of_their_shift_are(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv", noise=0.0)
    exact = record("master", path)
    assert exact["overlap"]["error"] == 0.0
    assert max(exact["results"]["standard_error"]) > 0.0
    words = call("master", path).stdout
    assert re.search(r"± 0\.0+(?![0-9])", words) is None
    noisy = call("master", curves(tmp_path / "noisy.csv")).stdout
    assert len(words.splitlines()) == len(noisy.splitlines()) + 1  # where the errors come from


def test_a_law_is_found_among_few_temperatures(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv")  # four of them
    assert record("master", path)["law"] is not None
    assert call("master", path).stderr == ""


def test_the_best_law_says_why_and_how_well_it_fits(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv", 273.15 + np.arange(30.0, 55.0, 4.0))
    found = record("master", path)
    assert found["law"] is not None
    assert found["law_explanation"]
    assert found["law_explanation"] in call("master", path).stdout
    assert record("master", path, "--law", "wlf")["law_explanation"] is None


def test_files_of_the_other_kind_are_refused_in_the_words_of_the_command_line(tmp_path: Path) -> None:
    found = refusal("measure", curves(tmp_path / "curves.csv"))
    assert (found.code, "viscofric master" in found.sentence) == ("friction-curves", True)
    (tmp_path / "pin.csv").write_text("v (mm/s);T (°C);F_N (N);value\n1;20;5;0,3\n", encoding="utf-8")
    for command in ("measure", "master"):
        found = refusal(command, tmp_path / "pin.csv")
        assert found.code == "missing-columns"
        assert "--column" in found.sentence
        assert "columns=" not in found.sentence


def test_friction_below_zero_is_reported(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv")
    measured = vf.read_friction_curves(path)
    vf.write_friction_curves(replace(measured, viscoelastic=-measured.viscoelastic), path)
    assert [one["code"] for one in record("master", path)["note_records"]] == ["friction-below-zero"]
    assert "Note: " in call("master", path).stderr


def test_curves_without_overlap_show_no_factor(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv", [303.15, 363.15])
    assert refusal("master", path)[:2] == (1, "no-overlap")
    beside = call("master", path, "--shift", "synthetic fluoroelastomer", "--reference", "30 degC")
    assert beside.exit_code == 0, beside.output
    reported = record("master", path, "--shift", "synthetic fluoroelastomer", "--reference", "30 degC")
    assert "no-shift-factors" in {one["code"] for one in reported["note_records"]}
    law = vf.synthetic_fluoroelastomer().shift
    assert law is not None
    assert not reported["found"]
    assert reported["covariance"] is None
    np.testing.assert_allclose(
        reported["results"]["log10_shift_factor"], law.log10(np.array([303.15, 363.15])), atol=1e-12
    )
    words = ("master", path, "--shift", "synthetic fluoroelastomer", "--out", tmp_path / "alpha.csv")
    assert refusal(*words).status == 1
    assert not (tmp_path / "alpha.csv").exists()


def test_curves_of_one_temperature_are_shifted_by_given_factors(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv", [363.15])
    assert refusal("master", path)[:2] == (1, "one-temperature")
    succeed("master", path, "--shift", "synthetic fluoroelastomer")


def test_runs_are_separated_before_they_are_shifted(tmp_path: Path) -> None:
    found = record("master", runs(tmp_path / "runs.csv", noise=0.01), "--shift", "synthetic fluoroelastomer")
    assert found["results"]["temperature"] == pytest.approx([303.15, 333.15])


def test_given_factors_are_shown_in_decimals(tmp_path: Path) -> None:
    path = runs(tmp_path / "runs.csv", noise=0.01)
    printed = succeed("master", path, "--shift", "synthetic fluoroelastomer").stdout.split("\n\n")[0].splitlines()[1:]
    assert [line.split() for line in printed] == [["30.0", "0.000"], ["60.0", "−2.091"]]


def test_loads_are_reduced_to_one_with_the_ball(tmp_path: Path) -> None:
    one, other = curves(tmp_path / "one.csv"), curves(tmp_path / "other.csv", load=35.0)
    assert refusal("master", one, other)[:2] == (1, "several-loads")
    succeed("master", one, other, "--ball", "9.525 mm")


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["master", "curves.csv", "runs.csv"], "mixed-inputs"),
        (["master", "mu.csv"], "missing-columns"),
    ],
    ids=lambda value: str(value)[:40],
)
def test_mistakes_of_shifting_are_refused(
    words: list[object], code: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    runs(tmp_path / "runs.csv")
    text = curves(tmp_path / "curves.csv").read_text(encoding="utf-8")
    (tmp_path / "mu.csv").write_text(text.replace("viscoelastic friction", "value"), encoding="utf-8")
    found = refusal(*words)
    assert (found.status, found.code) == (1, code), found


def test_the_reference_of_known_factors_counts_where_friction_reaches_it(tmp_path: Path) -> None:
    path = curves(tmp_path / "curves.csv", temperatures=TEMPERATURES[1:])
    alone = record("master", path)
    beside = record("master", path, "--shift", "synthetic fluoroelastomer")  # about 30 °C, below all of them
    assert beside["found"]
    assert beside["results"]["reference_temperature"] == alone["results"]["reference_temperature"]
