"""The folder of a study: one run at a time, nothing replaced unasked, locks of dead processes forgotten."""

from __future__ import annotations

import json
import os
import platform
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from refusals import refused
from viscofric.errors import DataFileError, StudyError
from viscofric.friction.cases.record import Failure
from viscofric.study.running.folder import _holder_is_alive, study_folder

HOLD = """
import sys, pathlib
from viscofric.study.running.folder import study_folder
with study_folder(pathlib.Path(sys.argv[1]), True):
    print("held", flush=True)
    sys.stdin.read()
"""


@pytest.mark.slow
def test_two_runs_do_not_meet_and_a_killed_one_leaves_no_lock(tmp_path: Path) -> None:
    holder = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(tmp_path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    assert holder.stdin is not None
    assert holder.stdout is not None
    try:
        assert holder.stdout.readline() == "held\n"
        with (
            refused("locked", StudyError, naming=str(holder.pid)),
            study_folder(tmp_path, resume=True),
        ):
            pass
    finally:
        holder.kill()
        holder.wait()
        holder.stdin.close()
        holder.stdout.close()
    for _ in range(2):  # nor does one that ended well
        with study_folder(tmp_path, resume=True):
            pass


def test_where_files_cannot_be_locked_dead_processes_hold_nothing(tmp_path: Path) -> None:
    dead = subprocess.Popen([sys.executable, "-c", ""])
    dead.wait()
    here = platform.node()
    for held, alive in (
        ({"process": dead.pid, "machine": here}, False),
        ({"process": os.getpid(), "machine": here}, True),
        ({"process": dead.pid, "machine": "another"}, True),
        ({}, False),
        ([], False),
    ):
        (tmp_path / "lock").write_text(json.dumps(held))
        with (tmp_path / "lock").open("rb", buffering=0) as file:
            assert _holder_is_alive(file) is alive
    (tmp_path / "lock").write_text('{"process": 12')
    with (tmp_path / "lock").open("rb", buffering=0) as file:
        assert not _holder_is_alive(file)


def test_folder_with_results_is_refused_unless_it_is_resumed(tmp_path: Path) -> None:
    with study_folder(tmp_path / "new", resume=False) as store:
        assert store.folder == tmp_path / "new" / "cases"
    with study_folder(tmp_path / "new", resume=False):
        pass  # nothing was solved
    (tmp_path / "new" / "cases" / "abc.json").write_text("{}")
    with refused("not-empty", StudyError), study_folder(tmp_path / "new", False):
        pass
    (tmp_path / "new" / "results.nc").write_text("")
    with refused("not-empty", StudyError), study_folder(tmp_path / "new", False):
        pass
    with study_folder(tmp_path / "new", resume=True):
        pass


def test_folder_that_cannot_be_written_is_one_sentence(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def read_only(*_: object, **__: object) -> None:
        raise OSError(30, "Read-only file system")

    monkeypatch.setattr("viscofric.files.tempfile.mkstemp", read_only)
    with refused("not-written", DataFileError), study_folder(tmp_path / "new", resume=False):
        pass


def test_what_a_killed_run_had_begun_to_write_is_removed(tmp_path: Path) -> None:
    (tmp_path / "cases").mkdir()
    for name in (".abc.json.x1y2", "abc.json"):
        (tmp_path / "cases" / name).write_text("{")
    (tmp_path / ".results.3z4").mkdir()
    (tmp_path / ".results.3z4" / "results.nc").touch()
    with study_folder(tmp_path, resume=True) as store:
        assert [path.name for path in store.folder.iterdir()] == ["abc.json"]
        assert {path.name for path in tmp_path.iterdir()} == {".lock", "cases"}


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege under Windows")
@pytest.mark.parametrize("link", [os.symlink, os.link])
def test_the_lock_is_never_a_link_to_another_file(tmp_path: Path, link: Callable[[Path, Path], None]) -> None:
    precious = tmp_path / "precious.txt"
    precious.write_text("years of work")
    (tmp_path / "results").mkdir()
    link(precious, tmp_path / "results" / ".lock")
    with refused("link", DataFileError), study_folder(tmp_path / "results", resume=True):
        pass
    assert precious.read_text() == "years of work"


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege under Windows")
@pytest.mark.parametrize("part", ["cases", "figures", "results.nc", "report.html"])
def test_parts_that_lie_elsewhere_are_refused_and_left_alone(tmp_path: Path, part: str) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (elsewhere / ".profile").write_text("mine")
    (tmp_path / "results").mkdir()
    (tmp_path / "results" / part).symlink_to(elsewhere)
    with refused("link", DataFileError), study_folder(tmp_path / "results", resume=True):
        pass
    assert [path.name for path in elsewhere.iterdir()] == [".profile"]


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege under Windows")
def test_sweeping_removes_links_and_not_what_they_point_to(tmp_path: Path) -> None:
    elsewhere, folder = tmp_path / "elsewhere", tmp_path / "results"
    (folder / "cases").mkdir(parents=True)
    elsewhere.mkdir()
    (elsewhere / "mine").touch()
    (folder / ".results.3z4").symlink_to(elsewhere)
    (folder / "cases" / ".abc.json.x1y2").symlink_to(elsewhere / "mine")
    with study_folder(folder, resume=True):
        assert list((folder / "cases").iterdir()) == []
    assert (elsewhere / "mine").exists()
    # A folder that is a link itself is where its owner wants the results.
    (tmp_path / "here").symlink_to(folder)
    with study_folder(tmp_path / "here", resume=True):
        pass


@pytest.mark.skipif(os.name == "nt", reason="Windows keeps open files")
@pytest.mark.parametrize("again", [False, True])
def test_a_folder_that_is_removed_meanwhile_is_an_error(tmp_path: Path, again: bool) -> None:
    def work() -> None:
        with study_folder(tmp_path / "new", resume=False) as store:
            shutil.rmtree(tmp_path / "new")
            with refused("not-written", DataFileError):
                store.put("abc", Failure("no.", "30 °C"))
            if again:
                store.folder.mkdir(parents=True)

    with refused("removed", DataFileError):
        work()
