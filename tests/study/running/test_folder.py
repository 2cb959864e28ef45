"""The folder of a study: one run at a time, nothing replaced unasked, locks of dead processes forgotten."""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from viscofric.errors import DataFileError, StudyError
from viscofric.study.running import study_folder
from viscofric.study.running.folder import _holder_is_alive

if TYPE_CHECKING:
    from pathlib import Path

HOLD = """
import sys, pathlib
from viscofric.study.running import study_folder
with study_folder(pathlib.Path(sys.argv[1]), True):
    print("held", flush=True)
    sys.stdin.read()
"""


def test_two_runs_do_not_meet_and_a_killed_one_leaves_no_lock(tmp_path: Path) -> None:
    holder = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(tmp_path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    assert holder.stdin is not None
    assert holder.stdout is not None
    try:
        assert holder.stdout.readline() == "held\n"
        with (
            pytest.raises(StudyError, match=rf"another run is at work .*\(process {holder.pid} on "),
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
    with pytest.raises(StudyError, match=r"unfinished study already \(1 solved"), study_folder(tmp_path / "new", False):
        pass
    (tmp_path / "new" / "results.nc").write_text("")
    with pytest.raises(StudyError, match="the results of a study already"), study_folder(tmp_path / "new", False):
        pass
    with study_folder(tmp_path / "new", resume=True):
        pass


def test_folder_that_cannot_be_written_is_one_sentence(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def read_only(*_: object, **__: object) -> None:
        raise OSError(30, "Read-only file system")

    monkeypatch.setattr("viscofric.files.tempfile.mkstemp", read_only)
    refused = pytest.raises(DataFileError, match=r"cannot be written \(Read-only file system\)")
    with refused, study_folder(tmp_path / "new", resume=False):
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
