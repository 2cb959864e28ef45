"""The page's measured friction: what is recognised in dropped files, what is separated, what is refused and how."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.errors import InputError, StudyError
from viscofric.web.jobs.context import Context
from web.friction_workspace import STUDY, column, curves, done, workspace


@pytest.fixture(scope="module")
def context(tmp_path_factory: pytest.TempPathFactory) -> Context:
    return workspace(tmp_path_factory.mktemp("measured") / "workspace")


@pytest.fixture(scope="module")
def example(context: Context) -> dict[str, Any]:
    return done("measured", context, STUDY, files=["mtm.csv"])


def test_traction_runs_are_recognised_and_called_synthetic(example: dict[str, Any]) -> None:
    assert example["table"] == {"mtm": "mtm.csv"}
    assert example["runs"]
    assert example["synthetic"]
    reported = {one["name"]: one["value"] for one in example["recognised"]}
    assert reported["readings"] == "960"
    assert reported["temperatures"] == "30.0, 60.0 and 90.0 °C"
    assert reported["sign configurations"].startswith("all four (I: 240 readings")


def test_separated_friction_is_that_of_the_library(example: dict[str, Any], context: Context) -> None:
    separated = vf.separate(vf.read_mtm(context.files / "mtm.csv"))
    order = np.lexsort([separated.speed, separated.temperature.round()])
    for name in ("speed", "viscoelastic", "viscoelastic_error", "coulomb", "consistency", "offset"):
        expected = getattr(separated, name)[order]
        np.testing.assert_allclose(column(example["curves"], name), expected, rtol=1e-5)  # six digits are sent


def test_four_configurations_that_agree_pass(example: dict[str, Any]) -> None:
    (check,) = example["checks"]
    assert check["verdict"] == "passed"
    assert re.findall(r"(\d+) of (\d+)", check["words"]) == [("29", "30")]


def test_friction_curves_are_recognised_and_can_be_fetched(context: Context) -> None:
    before = {**STUDY, "data_origin": "synthetic", "measurement": {"mtm": "mtm.csv", "zero": "0.1 N"}}
    found = done("measured", context, before, files=["curves.csv"])
    assert found["table"] == {"curves": "curves.csv"}  # a zero is nothing that curves have
    assert not found["runs"]
    assert not found["synthetic"]  # the file does not say so, whatever the rubber is
    np.testing.assert_allclose(column(found["curves"], "viscoelastic"), curves().viscoelastic, rtol=1e-5)
    fetched = vf.read_friction_curves(context.downloads / found["download"])
    np.testing.assert_array_equal(fetched.viscoelastic, curves().viscoelastic)


def test_bars_of_repetitions_are_explained_where_there_are_any(context: Context) -> None:
    rows = "speed (m/s),temperature (K),load (N),viscoelastic\n0.1,300,5,0.1\n0.2,300,5,0.2\n"
    (context.files / "single.csv").write_text(rows)
    for name, repeated in (("curves.csv", True), ("single.csv", False)):
        figure = done("measured", context, STUDY, files=[name])["figures"]["measured-friction"]
        assert any(one.get("error") for one in figure["traces"]) == repeated
        assert ("standard deviation" in figure["caption"]) == repeated


def test_settings_of_the_separation_stay_and_count(context: Context) -> None:
    before = {"measurement": {"mtm": "other.csv", "zero": "0.5 N"}}
    found = done("measured", context, before, files=["mtm.csv"])
    assert found["table"] == {"mtm": "mtm.csv", "zero": "0.5 N"}
    # The test determines its own zero, 0.12 N; one that contradicts it is reported.
    assert "given-zero-contradicted" in [one["code"] for one in found["note_records"]]


def test_what_is_read_once_is_not_read_again(context: Context, monkeypatch: pytest.MonkeyPatch) -> None:
    study = {"measurement": {"mtm": "mtm.csv"}}
    first = done("measured", context, study)
    monkeypatch.setattr("viscofric.readers.mtm.read.read_mtm", lambda *_: pytest.fail("read again"))
    assert done("measured", context, study) == first


def one_direction(context: Context, name: str) -> None:
    """Write a test in which disc and ball run one way only, and the ball slower: one configuration of four."""
    head = "temperature (degC),replicate,disc speed (mm/s),ball speed (mm/s),load (N),traction force (N)"
    rows = [f"30,{n},{v},{0.9 * v:.4g},25,{1.1 + 0.01 * n}" for v in (20, 50, 100) for n in (1, 2, 3)]
    (context.files / name).write_text("\n".join([head, *rows]), encoding="utf-8")


def test_a_test_that_cannot_be_separated_says_what_to_do_on_the_page(context: Context) -> None:
    one_direction(context, "one.csv")
    found = done("measured", context, STUDY, files=["one.csv"])
    assert found["curves"] is None
    assert "“" in found["refusal"]
    assert "--" not in found["refusal"]
    assert "in the shell" not in found["refusal"]
    assert found["recognised"][1]["name"] == "recognised as"
    given = {"mtm": "one.csv", "coulomb": 0.04, "zero": "0 N"}
    assert done("measured", context, {"measurement": given})["curves"] is not None


@pytest.mark.parametrize(
    ("files", "code"),
    [
        (["curves.csv", "mtm.csv"], "mixed-files"),
        (["dma.csv"], "dma-sweeps"),
        (["none.csv"], "file-not-here"),
        ([__file__], "file-not-here"),
    ],
)
def test_files_that_are_no_measurement_are_refused(context: Context, files: list[str], code: str) -> None:
    with refused(code, naming=files[-1].rpartition("/")[2]):
        done("measured", context, STUDY, files=files)


@pytest.mark.parametrize(
    ("table", "refusal"),
    [
        ({"mtm": "mtm.csv", "zero": "5 mm"}, ("wrong-unit", "measurement.zero", "'5 mm'")),
        ({"mtm": "mtm.csv", "coulomb": "much"}, ("value", "'much'")),
        ({"mtm": "mtm.csv", "curves": "curves.csv"}, ("contradiction",)),
        ({}, ("no-measurement",)),
    ],
)
def test_wrong_tables_are_reported_with_their_field(
    context: Context, table: dict[str, Any], refusal: tuple[str, ...]
) -> None:
    with refused(refusal[0], StudyError, naming=refusal[1:]):
        done("measured", context, {"measurement": table})


def refusal(call: Any) -> str:
    with pytest.raises(InputError) as caught:
        call()
    return caught.value.words("page")


def test_the_librarys_advice_becomes_the_pages(tmp_path: Path) -> None:
    speeds, count = np.full(40, 0.1), 40
    columns: dict[str, Any] = {
        "disc_speed": speeds,
        "ball_speed": 0.5 * speeds,
        "traction_force": np.ones(count),
        "load": np.full(count, 25.0),
        "temperature": np.full(count, 300.0),
        "replicate": np.arange(count),
    }
    runs = vf.readers.TractionRuns(**columns)
    drifting = vf.readers.TractionRuns(**{**columns, "temperature": np.linspace(300.0, 310.0, count)})
    unsteady = vf.readers.TractionRuns(
        **{**columns, "load": np.r_[np.full(20, 10.0), np.geomspace(11.0, 25.0, 20)]}, step=np.repeat([1, 2], 20)
    )
    reported = [
        refusal(lambda: vf.separate(runs)),
        refusal(lambda: vf.separate(drifting)),
        refusal(lambda: vf.separate(unsteady)),
        refusal(lambda: runs.select(except_steps=(1,))),
        refusal(lambda: vf.shift_friction(replace(curves(), load=np.linspace(5.0, 25.0, len(curves()))))),
    ]
    assert all("--" not in one and "shell" not in one and "Python" not in one for one in reported), reported
    assert "“Zero of the force cell”" in reported[0]
    assert "“Gap between temperatures”: " in reported[1]
    assert "“Steps to leave out”: 2" in reported[2]
    assert "“Steps to leave out”: 1" in reported[3]
    assert "give a ball" in reported[4]


def test_exports_of_instruments_are_recognised(real_data: Path, context: Context) -> None:
    for path in sorted((real_data / "mtm").glob("demo*.txt")):
        (context.files / path.name).write_bytes(path.read_bytes())
        found = done("measured", context, STUDY, files=[path.name])
        reported = {one["name"]: one["value"] for one in found["recognised"]}
        assert "PCS Instruments" in reported["recognised as"]
        assert found["steps"]
        # None of them was run in both directions of slip, which the page must say in its own words.
        assert found["refusal"]
        assert "--" not in found["refusal"]
