"""What a job hands over is plain JSON, rounded to what a page shows; files of studies stay among the page's."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

import numpy as np

from refusals import refused
from viscofric.datasets import plain
from viscofric.errors import DataFileError, StudyError
from viscofric.study.run_file.study import TABLES, Study
from viscofric.web.jobs.context import Context, JobError
from viscofric.web.study_files import check_confined, opened_study

EXAMPLE = Path(__import__("viscofric").__file__).parent / "example"


def digits(value: float) -> int:
    return len(f"{value:e}".split("e")[0].replace(".", "").replace("-", "").rstrip("0"))


def test_numbers_have_the_digits_asked_for() -> None:
    random = np.random.default_rng(7)
    values = random.normal(size=2_000) * 10.0 ** random.uniform(-300.0, 300.0, 2_000)
    ordinary = random.normal(size=2_000) * 10.0 ** random.uniform(-15.0, 15.0, 2_000)
    for given in (values, ordinary, -ordinary, np.array([0.0, 1.0, 123456789.0, 0.1 + 0.2])):
        found = plain(given)
        # as Python itself rounds, but where a value lies halfway between two
        np.testing.assert_allclose(found, given, rtol=5.0000001e-6, atol=0.0)
        assert max(len(f"{value!r}".split("e")[0].strip("-").replace(".", "").strip("0")) for value in found) <= 6
    assert plain(0.1 + 0.2) == 0.3
    assert plain(math.pi, digits=None) == math.pi
    assert plain([math.pi, 1.0], digits=3) == [3.14, 1.0]


def test_what_is_not_finite_is_null() -> None:
    assert plain({"a": (math.nan, 1.0), 2: np.array([[np.inf, 2.0]]), "c": np.float64("nan")}) == {
        "a": [None, 1.0],
        "2": [[None, 2.0]],
        "c": None,
    }


def test_everything_a_result_holds_becomes_json() -> None:
    value: dict[str, Any] = {
        "text": np.array(["a", "b"]),
        "truth": np.array([True, False]),
        "whole": np.arange(3),
        "number": np.float32(0.1),
        "none": None,
        "nested": [{"x": [1.5, "a", None]}],
        "empty": (),
        "path": Path("a.csv"),
        "no dimension": np.array(2.5),
        "set": {3, 1},
    }
    found = plain(value)
    assert json.loads(json.dumps(found, allow_nan=False)) == found
    assert found["whole"] == [0, 1, 2]
    assert found["number"] == 0.1
    assert found["no dimension"] == 2.5
    assert found["set"] == [1, 3]


def test_progress_is_reported_no_more_often_than_a_browser_shows_but_its_end_always() -> None:
    reported: list[Any] = []
    context = Context(Path(), Path(), Path(), lambda event, message: reported.append((event, message)))
    for done in range(1, 10_001):
        context.progress(done, 10_000, "at work")
    assert reported[0][1]["done"] == 1
    assert reported[-1] == ("progress", {"done": 10_000, "total": 10_000, "label": "at work"})
    assert len(reported) < 100
    context.part({"x": 1})
    assert reported[-1] == ("part", {"part": {"x": 1}})


def test_every_key_of_a_run_file_that_names_files_is_known() -> None:
    def paths(annotation: Any) -> Iterator[Any]:
        yield annotation
        for part in get_args(annotation):
            yield from paths(part)

    tables = {name: table for name, table in TABLES.items() if name in Study.model_fields or name == "material"}
    for table in tables.values():
        found = {key for key, field in table.model_fields.items() if Path in paths(field.annotation)}
        assert found == set(getattr(table, "FILES", ()))


def test_only_files_with_plain_names_are_among_the_pages() -> None:
    check_confined({"material": {"dma": ["a.csv", "b*.csv"]}, "measurement": {"mtm": "c.csv"}, "surface": 3})
    for elsewhere in ("../dma.csv", "/etc/hosts", "..\\dma.csv", "C:\\dma.csv", "..", "**"):
        with refused("file-not-here", JobError, naming="material.dma"):
            check_confined({"material": {"dma": ["a.csv", elsewhere]}})


def test_run_file_opens_with_its_files_under_plain_names(tmp_path: Path) -> None:
    for name in ("dma.csv", "sub/dma.csv", "sub/run1.txt", "sub/run2.txt"):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(name)
    study = tmp_path / "study.toml"
    study.write_text(
        '[material]\ndma = ["dma.csv", "sub/dma.csv"]\nreference_temperature = "30 degC"\n'
        '[indenter]\nshape = "ball"\nradius = "9.525 mm"\n'
        '[conditions]\nload = "25 N"\nspeed = "1 m/s"\ntemperature = "30 degC"\n'
        '[measurement]\nmtm = "sub/run*.txt"\n'
    )
    document, files = opened_study(study)
    assert document["material"]["dma"] == ["dma.csv", "dma-2.csv"]
    assert document["measurement"]["mtm"] == ["run1.txt", "run2.txt"]
    assert {name: path.read_text() for name, path in files.items()} == {
        "dma.csv": "dma.csv",
        "dma-2.csv": "sub/dma.csv",
        "run1.txt": "sub/run1.txt",
        "run2.txt": "sub/run2.txt",
    }
    check_confined(document)
    assert document["conditions"]["load"] == "25 N"


def test_run_file_that_cannot_be_opened_says_why(tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    with refused("no-file", StudyError):
        opened_study(study)
    study.write_text((EXAMPLE / "study.toml").read_text("utf-8"), "utf-8")
    with refused("no-file", DataFileError, naming="dma.csv"):
        opened_study(study)
