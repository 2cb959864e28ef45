"""The folder of a study's results: one run at a time, no replacement without consent, no writing outside it."""

from __future__ import annotations

import contextlib
import json
import os
import platform
import shutil
import stat
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import IO

from viscofric.errors import DataFileError, StudyError, not_written
from viscofric.study.results.file import RESULTS_FILE, open_tree
from viscofric.study.running.store import CaseStore

CASES_FOLDER = "cases"
_LOCK = ".lock"
# What a study writes into its folder, and how names of its results files begin.
_PARTS = (_LOCK, CASES_FOLDER, "figures", "report.html")
_OUTPUTS = ("results.", "prediction.")


@contextlib.contextmanager
def study_folder(folder: Path, resume: bool) -> Iterator[CaseStore]:
    """Lock a results folder (made if missing) and yield its store of solved contacts, old ones only with `resume`."""
    if folder.exists() and not folder.is_dir():
        raise DataFileError(folder, "is a file; results need a folder.", code="is-file")
    _refuse_links(folder)
    if not resume:
        _insist_on_nothing_there(folder)
    store = CaseStore(folder / CASES_FOLDER, made=True)
    store.prepare()
    with _locked(folder):
        with _writing(folder):
            store.sweep()
        for left in folder.glob(".results.*"):  # incomplete results files; the target of a link stays
            shutil.rmtree(left, ignore_errors=True)
        yield store


@dataclass(frozen=True)
class CheckedResults:
    """Integrity of a folder of results."""

    cases: int  # stored contacts
    finished: bool  # whether the results file exists, too
    damaged: dict[Path, str]  # files that differ from what was stored, with the reason


def check_results(folder: Path) -> CheckedResults:
    """Compare every file of a study's results with its checksum; raise `DataFileError` if there are none."""
    store, target = CaseStore(folder / CASES_FOLDER), folder / RESULTS_FILE
    cases, finished = sum(1 for _ in store.stored()), target.exists()
    if not cases and not finished:
        raise DataFileError(
            folder, f"contains no results of a study (no {RESULTS_FILE}, no {CASES_FOLDER}).", code="no-results"
        )
    damaged = {store.folder / f"{key}.json": found.reason for key, found in store.damaged().items()}
    if finished:
        try:
            open_tree(folder)
        except DataFileError as error:
            damaged[target] = error.problem
    return CheckedResults(cases, finished, damaged)


def _refuse_links(folder: Path) -> None:
    """Raise `DataFileError` if a part of a results folder is a symbolic link: its target would be written."""
    for part in folder.iterdir() if folder.is_dir() else ():
        if part.is_symlink() and (part.name in _PARTS or part.name.startswith(_OUTPUTS)):
            raise DataFileError(
                part,
                "is a symbolic link; results are written into their folder only. Remove the link, or give its "
                "target as the results folder (--out).",
                code="link",
            )


def _insist_on_nothing_there(folder: Path) -> None:
    cases = sum(1 for _ in CaseStore(folder / CASES_FOLDER).stored())
    finished = (folder / RESULTS_FILE).exists()
    if cases or finished:
        what = "the results of a study" if finished else "an unfinished study"
        raise StudyError(
            f"{folder}: contains {what} ({cases} solved contacts); resume it (--resume) to solve only what is missing, "
            "even if the run file has changed, and to replace its results, or choose another folder.",
            code="not-empty",
        )


@contextlib.contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """Hold the lock of a folder, which the system releases however this process ends."""
    path = folder / _LOCK
    file = _opened(path)
    try:
        if not _is_alone(file):
            raise StudyError(
                f"{folder}: another run uses this folder{_holder(path)}; wait for its end, or choose another folder.",
                code="locked",
            )
        held = {"process": os.getpid(), "machine": platform.node(), "since": datetime.now(UTC).isoformat()}
        with _writing(path):
            file.truncate(0)
            file.write(json.dumps(held).encode())
        try:
            yield
            _insist_on_the_same(file, path)
        finally:
            with contextlib.suppress(OSError):  # an earlier error matters more
                file.truncate(0)
    finally:
        file.close()


def _opened(path: Path) -> IO[bytes]:
    """Open the lock, but never the target of a link of its name: it is emptied."""
    flags = os.O_RDWR | os.O_CREAT | os.O_APPEND
    for name in ("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC", "O_BINARY", "O_NOINHERIT"):  # where the system has them
        flags |= getattr(os, name, 0)
    with _writing(path):
        file = os.fdopen(os.open(path, flags, 0o666), "r+b", buffering=0)
    status = os.fstat(file.fileno())
    if not stat.S_ISREG(status.st_mode) or status.st_nlink > 1:
        file.close()
        raise DataFileError(path, "is a link or not a plain file, and is not touched; remove it.", code="link")
    return file


def _insist_on_the_same(file: IO[bytes], path: Path) -> None:
    """Raise `DataFileError` if the held lock is no longer in the folder: it was removed or replaced."""
    try:
        same = os.path.samestat(os.fstat(file.fileno()), path.lstat())
    except OSError:
        same = False
    if not same:
        raise DataFileError(
            path.parent,
            "was removed or replaced with all solved contacts while the study ran; run the study again, and do not "
            "change the folder meanwhile.",
            code="removed",
        )


@contextlib.contextmanager
def _writing(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise not_written(path, error) from error


def _is_alone(file: IO[bytes]) -> bool:
    """Lock a file unless another process has locked it."""
    try:
        if sys.platform == "win32":
            import msvcrt

            file.seek(_FAR)
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    except OSError:
        # A file system without locks, as on some clusters: rely on the holder named in the file.
        return not _holder_is_alive(file)
    return True


def _parsed(text: bytes) -> dict[str, object]:
    with contextlib.suppress(ValueError):
        held = json.loads(text)
        if isinstance(held, dict):
            return held
    return {}


def _holder(path: Path) -> str:
    """Return the holder of a lock in words, where it is known."""
    try:
        held = _parsed(path.read_bytes())
    except OSError:  # not readable on Windows
        held = {}
    return f" (process {held['process']} on {held['machine']})" if {"process", "machine"} <= held.keys() else ""


def _holder_is_alive(file: IO[bytes]) -> bool:
    """Whether the process named in a lock may still run; unknown for another machine."""
    file.seek(0)
    held = _parsed(file.read())
    process = held.get("process")
    if not isinstance(process, int):
        return False
    if held.get("machine") != platform.node():
        return True
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:
        return True
    return True


#: Byte that is locked on Windows, where locked bytes are not readable.
_FAR = 1 << 30
