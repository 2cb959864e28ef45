"""Studies that are interrupted: nothing is left behind, and what is solved can be had without solving the rest."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray

from refusals import refused
from study.running.kills import STUDY
from viscofric import open_results, run_study
from viscofric.errors import DataFileError
from viscofric.study.running.folder import check_results
from viscofric.study.running.running import Event

SLOW = pytest.mark.slow


@pytest.mark.apart
@pytest.mark.skipif(sys.platform == "win32", reason="no groups of processes to interrupt")
def test_interrupt_of_all_processes_ends_them_with_one_sentence(tmp_path: Path) -> None:
    study, folder = tmp_path / "study.toml", tmp_path / "results"
    study.write_text(STUDY.format(points=200, cases="each"))
    program = subprocess.Popen(
        [sys.executable, "-m", "viscofric", "run", str(study), "-o", str(folder), "--json", "--workers", "2"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        # where the tests run in the background of a shell, it has them ignore Ctrl-C
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    )
    assert program.stdout is not None
    assert any('"solved"' in line for line in program.stdout)
    os.killpg(program.pid, signal.SIGINT)  # as a terminal does
    _, said = program.communicate(timeout=60.0)  # until the last of them has closed it
    assert program.returncode == 130
    solved = len(list((folder / "cases").iterdir()))
    assert len(said.splitlines()) == 1  # no traceback
    assert str(folder) in said
    assert re.findall(r"\d+", said.split(str(folder))[1]) == [str(solved)]
    assert "--resume" in said


@pytest.mark.slow
def test_finished_cases_of_an_interrupted_study_are_put_together(tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text(STUDY.format(points=2, cases="each"))
    solved: list[str] = []

    def interrupt(event: Event) -> None:
        if event.event == "solved":
            solved.append(str(event.key))
        if len(solved) == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_study(study, progress=interrupt)
    folder = tmp_path / "study.results"
    with refused("unfinished", DataFileError):
        open_results(folder)
    run_study(study, finished_only=True)
    part = open_results(folder)
    failed = part.dataset["failed"].values.ravel()
    assert failed.tolist() == [0, 0, 1, 1]
    assert {one.code for one in part.failures} == {"not-solved"}
    whole = run_study(study, resume=True, progress=lambda event: solved.append(str(event.key)) if event.key else None)
    assert whole.failures == ()
    known = np.isfinite(part.dataset["friction_coefficient"])
    assert int(known.sum()) == 2
    xarray.testing.assert_identical(
        part.dataset["friction_coefficient"].where(known), whole.dataset["friction_coefficient"].where(known)
    )
    with refused("two-executors"):
        run_study(study, finished_only=True, workers=2)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="Windows keeps open files")
@pytest.mark.parametrize(
    "what", [pytest.param("folder", marks=SLOW), pytest.param("cases", marks=pytest.mark.apart), "one case"]
)
def test_what_is_removed_in_mid_run_is_an_error(tmp_path: Path, what: str) -> None:
    study, folder = tmp_path / "study.toml", tmp_path / "study.results"
    study.write_text(STUDY.format(points=3, cases="each"))

    def remove(event: Event) -> None:
        if event.event == "solved" and event.solves == 2:
            if what == "one case":
                (folder / "cases" / f"{event.key}.json").unlink()
            else:
                shutil.rmtree(folder if what == "folder" else folder / "cases")

    with pytest.raises(DataFileError):
        run_study(study, progress=remove)
    assert not (folder / "results.nc").exists()
    assert run_study(study, resume=True).failures == ()


@pytest.mark.apart
def test_a_changed_case_is_solved_again_and_said(tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text(STUDY.format(points=2, cases="each"))
    whole = run_study(study)
    checked = check_results(whole.folder)
    assert (checked.cases, checked.finished, checked.damaged) == (7, True, {})
    path = sorted((whole.folder / "cases").glob("*.json"))[3]
    stored = path.read_text()
    friction = json.loads(stored)["case"]["friction_coefficient"]
    path.write_text(stored.replace(repr(friction), repr(3.0 * friction)))
    assert list(check_results(whole.folder).damaged) == [path]
    events: list[Event] = []
    again = run_study(study, resume=True, progress=events.append)
    assert [event.key for event in events if event.event == "damaged"] == [path.stem]
    assert [event.key for event in events if event.event == "solved"] == [path.stem]
    assert again.dataset.equals(whole.dataset)
    assert len(again.warnings) == len(whole.warnings) + 1
    assert path.read_text() == stored
    # Results that are put together are looked at as well.
    results = whole.folder / "results.nc"
    results.write_bytes(results.read_bytes()[:-100])
    assert list(check_results(whole.folder).damaged) == [results]
