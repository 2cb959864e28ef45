"""`viscofric verify --test FOLDER`: which folders are friction tests, and what is printed and written for one."""

from __future__ import annotations

import json
import shutil
import sys
from functools import partial
from importlib.resources import as_file, files
from typing import TYPE_CHECKING

import pytest

from cli import calls
from refusals import refused
from viscofric.cli import run
from viscofric.cli.verify import open_friction_test
from viscofric.errors import StudyError
from viscofric.notes import note_of
from viscofric.report import html

if TYPE_CHECKING:
    from pathlib import Path


RUN_FILE = """\
title = "Synthetic test"
data_origin = "synthetic"
citation = "A. Author, Journal 1 (2026) 1"
licence = "MIT"
[material]
dma = "dma.csv"
reference_temperature = "30 degC"
[indenter]
radius = "9.525 mm"
[conditions]
load = "25 N"
speed = "20 mm/s"
temperature = "60 degC"
[measurement]
mtm = "mtm.csv"
[solver]
accuracy = 2e-2
master_curve_points = 5
[uncertainty]
draws = 0
[outputs]
fields = "none"
"""


call = partial(calls.call, "verify")
succeed = partial(calls.succeed, "verify")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    place = tmp_path / "my-test"
    place.mkdir()
    with as_file(files("viscofric") / "templates" / "paper") as example:
        for name in ("dma.csv", "mtm.csv"):
            shutil.copy(example / name, place / name)
    (place / "test.toml").write_text(RUN_FILE, encoding="utf-8")
    return place


@pytest.mark.slow
def test_a_test_is_compared_point_by_point_and_synthetic_data_are_marked(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(html, "figure_images", lambda *arguments: {})  # other tests draw
    done = succeed("--test", str(folder), "--json")
    found = json.loads(done.stdout)
    assert found["synthetic"] is True
    assert found["licence"] == "MIT"
    assert len(found["points"]["predicted"]) == len(found["points"]["viscoelastic_error"]) == 30
    assert abs(found["agreement"]["bias"]) < 0.02
    for name in ("note", "warning"):
        assert [note_of(one).words("python") for one in found[f"{name}_records"]] == found[f"{name}s"]
    page = (folder / "test.results" / "report.html").read_text(encoding="utf-8")
    assert found["report"] == str(folder / "test.results" / "report.html")
    assert "A. Author, Journal 1 (2026) 1" in page

    # The results are there; exit status 3 says that some cases failed, and what there is is printed all the same.
    monkeypatch.setattr(run, "run_and_report", lambda *arguments, **how: sys.exit(run.SOME_CASES_FAILED))
    done = call("--test", str(folder))
    assert done.exit_code == run.SOME_CASES_FAILED, done.output
    lines = done.stdout.splitlines()
    assert "SYNTHETIC" in lines[0]
    assert lines[1] == "A. Author, Journal 1 (2026) 1; licence: MIT"
    assert sum(line.strip().startswith(("30 °C", "60 °C", "90 °C")) for line in lines) == 30
    assert any(line.startswith("Over 30 points") for line in lines)


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ('citation = "A. Author, Journal 1 (2026) 1"', "", "citation"),
        ('licence = "MIT"', "", "licence"),
        ('dma = "dma.csv"\nreference_temperature = "30 degC"', 'catalogue = "synthetic fluoroelastomer"', "dma"),
        ('[measurement]\nmtm = "mtm.csv"\n', "", "measurement"),
    ],
)
def test_a_test_without_one_of_its_parts_is_refused(folder: Path, old: str, new: str, named: str) -> None:
    assert old in RUN_FILE
    (folder / "test.toml").write_text(RUN_FILE.replace(old, new), encoding="utf-8")
    with refused("incomplete-test", StudyError) as caught:
        open_friction_test(folder)
    assert named in str(caught.value)


def test_a_folder_without_one_run_file_is_refused(folder: Path, tmp_path: Path) -> None:
    shutil.copy(folder / "test.toml", folder / "second.toml")
    with refused("no-run-file", StudyError) as caught:
        open_friction_test(folder)
    assert "second.toml, test.toml" in str(caught.value)
    with refused("no-folder", StudyError):
        open_friction_test(tmp_path / "nowhere")
    done = call("--test", str(tmp_path / "nowhere"))
    assert done.exit_code == 1
    assert "nowhere" in done.stderr


def test_the_example_is_a_friction_test() -> None:
    with as_file(files("viscofric") / "example") as example:
        _, study = open_friction_test(example)
    assert study.data_origin == "synthetic"


def test_other_options_do_not_go_with_it(folder: Path) -> None:
    assert call("--test", str(folder), "--published").exit_code == 2
