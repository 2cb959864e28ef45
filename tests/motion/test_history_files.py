"""Histories in files: columns, units and constants, and errors with the file, the line and the field."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from readers.samples import workbook
from refusals import refused
from viscofric.errors import DataFileError

WIPER = """# start of a wiper
time (ms);Fn (mN/mm);sliding distance (mm);T (degC)
0;20;0;25
100;20;0;25
100;30;0;25
300;30;20;35
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "history.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_columns_are_read_with_their_units(tmp_path: Path) -> None:
    history = vf.motion.read_history(written(tmp_path, WIPER), before="at rest", direction=(0.0, 1.0))
    assert (history.control, history.load_unit, history.before) == ("load", "N/m", "at rest")
    # rounding of the conversion
    np.testing.assert_allclose(history.time, [0.0, 0.1, 0.1, 0.3], rtol=1e-14)
    np.testing.assert_allclose(history.load, [20.0, 20.0, 30.0, 30.0], rtol=1e-14)
    np.testing.assert_allclose(history.position, [[0, 0], [0, 0], [0, 0], [0, 0.02]], atol=1e-15)
    np.testing.assert_allclose(history.temperature, [298.15, 298.15, 298.15, 308.15], rtol=1e-14)


@pytest.mark.parametrize("headings", ["Zeit (s);Normalkraft (N);v (mm/s)", "temps (s);force normale (N);v (mm/s)"])
def test_times_and_loads_are_understood_as_in_other_tables(tmp_path: Path, headings: str) -> None:
    history = vf.motion.read_history(written(tmp_path, f"{headings}\n0;20;1\n1;30;1\n"), temperature="25 degC")
    assert history.load.tolist() == [20.0, 30.0]


def test_depths_speeds_and_constants(tmp_path: Path) -> None:
    path = written(tmp_path, "t (s),depth (um),vx (mm/s),vy (mm/s)\n0,0,1,0\n1,5,1,2\n")
    history = vf.motion.read_history(path, temperature="30 degC")
    assert history.control == "indentation"
    np.testing.assert_allclose(history.indentation, [0.0, 5e-6], rtol=1e-14)
    np.testing.assert_allclose(history.position[-1], [1e-3, 1e-3], rtol=1e-14)
    assert history.temperature.tolist() == [303.15, 303.15]
    path = written(tmp_path, "t (s),x (mm)\n0,0\n1,5\n")
    history = vf.motion.read_history(path, load="2 N")
    assert (history.load.tolist(), history.position.tolist()) == ([2.0, 2.0], [[0.0, 0.0], [0.005, 0.0]])
    with refused("give-one"):
        vf.motion.read_history(path, load="2 N", indentation="1 mm")


def test_headings_and_sheets_are_named(tmp_path: Path) -> None:
    path = tmp_path / "rig.xlsx"
    rows = [["clock / s", "Fz", "stage (mm)"], [0.0, 3.0, 0.0], [1.0, 4.0, 5.0]]
    workbook.write(path, {"about": [["Rig 3"]], "run 1": rows, "run 2": rows})
    named = {"time": "clock / s", "load": "Fz (N)", "position": "#3 (mm)"}
    with refused("several-tables", DataFileError) as caught:
        vf.motion.read_history(path, columns=named)
    assert "--history-sheet 'run 1'" in caught.value.words("shell")
    history = vf.motion.read_history(path, columns=named, sheet="run 2")
    assert (history.load.tolist(), history.position[:, 0].tolist()) == ([3.0, 4.0], [0.0, 0.005])
    with refused("missing-columns", DataFileError) as caught:
        vf.motion.read_history(path)
    assert caught.value.field == "history.columns"
    assert "--history-column" in caught.value.words("shell")


@pytest.mark.parametrize(
    ("code", "line", "text"),
    [
        ("time-goes-back", 4, "t (s),F (N)\n0,1\n\n-1,1\n"),
        ("repeated-time", 5, "# rig\nt (s),F (N)\n0,1\n0,1\n0,1\n1,1\n"),
        ("negative-load", 3, "t (s),F (N)\n0,1\n1,-1\n"),
        ("position-jump", 4, "t (s),F (N),x (m)\n0,1,0\n1,1,0\n1,1,1\n2,1,1\n"),
        ("not-positive", 2, "t (s),F (N),T (degC)\n0,1,-300\n1,1,20\n"),
        ("not-a-number", 3, "t (s),F (N)\n0,1\n1,abc\n"),
        ("empty-cell", 3, "t (s),F (N)\n0,1\n1,\n"),
        ("row-length", 3, "t (s),F (N)\n0,1\n1\n"),
        ("too-few-points", None, "t (s),F (N)\n0,1\n"),
        ("wrong-unit", None, "t (s),F (mm)\n0,1\n1,1\n"),
        ("no-unit", None, "t (s),F\n0,1\n1,1\n"),
        ("missing-columns", None, "t (s),x (mm)\n0,1\n1,1\n"),
        ("missing-columns", None, "F (N),x (mm)\n0,1\n1,1\n"),
        ("give-one", None, "t (s),F (N),depth (mm)\n0,1,1\n1,1,1\n"),
        ("give-one", None, "t (s),F (N),position (mm),x (mm)\n0,1,1,1\n1,1,1,1\n"),
        ("give-one", None, "t (s),F (N),position (mm),speed (mm/s)\n0,1,1,1\n1,1,1,1\n"),
        ("ambiguous-columns", None, "t (s),F (N),load (N)\n0,1,1\n1,1,1\n"),
    ],
)
def test_errors_name_the_file_and_the_line(tmp_path: Path, code: str, line: int | None, text: str) -> None:
    path = written(tmp_path, text)
    with refused(code, DataFileError, naming=str(path)) as caught:
        vf.motion.read_history(path)
    assert caught.value.row == line


@pytest.mark.parametrize(
    ("head", "time"), [("t (s),F (N),t (s),x (mm)", "#1"), ("t1 (s),F (N),t2 (s),x (mm)", "t1 (s)")]
)
def test_digitised_histories_with_times_of_their_own_are_refused(tmp_path: Path, head: str, time: str) -> None:
    with refused("ambiguous-columns", DataFileError):
        vf.motion.read_history(written(tmp_path, f"{head}\n0,1,0,0\n1,1,1.5,2\n"), columns={"time": time})


def test_a_value_for_a_column_that_is_there_is_refused(tmp_path: Path) -> None:
    with refused("give-one", naming="load"):
        vf.motion.read_history(written(tmp_path, WIPER), load="3 N/m")
    for code, given in (
        ("wrong-choice", {"before": "asleep"}),
        ("wrong-count", {"direction": (0.0, 0.0)}),
        ("negative-load", {"load": "-1 N"}),
        ("wrong-unit", {"temperature": "1 N"}),
    ):
        with refused(code) as caught:
            vf.motion.read_history(written(tmp_path, WIPER), **given)
        assert not isinstance(caught.value, DataFileError)
