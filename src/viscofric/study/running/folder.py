"""The folder of a study's results: one run in it at a time, nothing in it replaced unasked, nothing outside touched."""

from __future__ import annotations

import contextlib
import json
import os
import platform
import shutil
import stat
import sys
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import IO, TYPE_CHECKING

from viscofric.errors import DataFileError, StudyError, not_written
from viscofric.study.results.file import DIGEST, RESULTS_FILE, open_tree
from viscofric.study.running.store import CaseStore

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

CASES_FOLDER = "cases"
_LOCK = ".lock"
# What a study writes into its folder, with what begins like its results files.
_PARTS = (_LOCK, CASES_FOLDER, "figures", "report.html")
_OUTPUTS = ("results.", "prediction.")


@contextlib.contextmanager
def study_folder(folder: Path, resume: bool) -> Iterator[CaseStore]:
    """Have a folder for oneself, and its store of finished cases.

    Parameters
    ----------
    folder : Path
        Made if it does not exist.
    resume : bool
        Whether finished cases in it are taken over, and results in it replaced.

    Raises
    ------
    StudyError
        If another run is at work in it, or it holds what another left and is not to be resumed.
    DataFileError
        If it cannot be written, a part of it is a link to somewhere else, or it is removed before the end.
    """
    if folder.exists() and not folder.is_dir():
        raise DataFileError(folder, "is a file; results need a folder.")
    _refuse_links(folder)
    if not resume:
        _insist_on_nothing_there(folder)
    store = CaseStore(folder / CASES_FOLDER, made=True)
    store.prepare()
    with _locked(folder):
        with _writing(folder):
            store.sweep()
        for left in folder.glob(".results.*"):  # a results file that was not finished; of a link nothing is removed
            shutil.rmtree(left, ignore_errors=True)
        yield store


@dataclass(frozen=True)
class CheckedResults:
    """Whether a folder of results holds what was stored in it.

    Attributes
    ----------
    cases : int
        Stored contacts.
    finished : bool
        Whether the results were put together, too.
    damaged : dict of Path to str
        Files that do not hold what was stored, and what is wrong with each.
    unverified : tuple of Path
        Files without a checksum, which older versions of viscofric wrote: nothing is known of them.
    """

    cases: int
    finished: bool
    damaged: dict[Path, str]
    unverified: tuple[Path, ...]


def check_results(folder: Path) -> CheckedResults:
    """Compare every file of a study's results with its checksum.

    Raises
    ------
    DataFileError
        If the folder holds no results.
    """
    store, target = CaseStore(folder / CASES_FOLDER), folder / RESULTS_FILE
    cases, finished = sum(1 for _ in store.stored()), target.exists()
    if not cases and not finished:
        raise DataFileError(folder, f"holds no results of a study (no {RESULTS_FILE}, no {CASES_FOLDER}).")
    damaged, unverified = {}, []
    for key, found in store.damaged().items():
        file = store.folder / f"{key}.json"
        if found.older:
            unverified.append(file)
        else:
            damaged[file] = found.reason
    if finished:
        try:
            if DIGEST not in open_tree(folder)[0].attrs:
                unverified.append(target)
        except DataFileError as error:
            damaged[target] = error.problem
    return CheckedResults(cases, finished, damaged, tuple(unverified))


def _refuse_links(folder: Path) -> None:
    """Raise `DataFileError` if a part of a results folder is a symbolic link, whose target would be written."""
    for part in folder.iterdir() if folder.is_dir() else ():
        if part.is_symlink() and (part.name in _PARTS or part.name.startswith(_OUTPUTS)):
            raise DataFileError(
                part,
                "is a symbolic link; results are written into their folder only. Remove the link, or give the folder "
                "that it points into as the results folder (--output).",
            )


def _insist_on_nothing_there(folder: Path) -> None:
    cases = sum(1 for _ in CaseStore(folder / CASES_FOLDER).stored())
    finished = (folder / RESULTS_FILE).exists()
    if cases or finished:
        what = "the results of a study" if finished else "an unfinished study"
        raise StudyError(
            f"{folder}: holds {what} already ({cases} solved contacts); resume it (--resume) to solve only what is "
            "missing, even if the run file has changed, and to replace its results, or choose another folder."
        )


@contextlib.contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """Hold the lock of a folder, which the system gives back however this process ends."""
    path = folder / _LOCK
    file = _opened(path)
    try:
        if not _is_alone(file):
            raise StudyError(
                f"{folder}: another run is at work in this folder{_holder(path)}; wait for its end, or choose another "
                "folder."
            )
        held = {"process": os.getpid(), "machine": platform.node(), "since": datetime.now(UTC).isoformat()}
        with _writing(path):
            file.truncate(0)
            file.write(json.dumps(held).encode())
        try:
            yield
            _insist_on_the_same(file, path)
        finally:
            with contextlib.suppress(OSError):  # what happened before counts more
                file.truncate(0)
    finally:
        file.close()


def _opened(path: Path) -> IO[bytes]:
    """Open the lock, never what a link of its name points to: it is emptied."""
    flags = os.O_RDWR | os.O_CREAT | os.O_APPEND
    for name in ("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC", "O_BINARY", "O_NOINHERIT"):  # those that the system has
        flags |= getattr(os, name, 0)
    with _writing(path):
        file = os.fdopen(os.open(path, flags, 0o666), "r+b", buffering=0)
    status = os.fstat(file.fileno())
    if not stat.S_ISREG(status.st_mode) or status.st_nlink > 1:
        file.close()
        raise DataFileError(path, "is a link or no plain file, and is not touched; remove it.")
    return file


def _insist_on_the_same(file: IO[bytes], path: Path) -> None:
    """Raise `DataFileError` if the lock that is held lies in the folder no more: the folder was removed or replaced."""
    try:
        same = os.path.samestat(os.fstat(file.fileno()), path.lstat())
    except OSError:
        same = False
    if not same:
        raise DataFileError(
            path.parent,
            "was removed or replaced while the study ran, and what was solved with it; run the study again, and leave "
            "the folder alone until it ends.",
        )


@contextlib.contextmanager
def _writing(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise not_written(path, error) from error


def _is_alone(file: IO[bytes]) -> bool:
    """Lock a file unless another process has."""
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
        # A file system without locks, as some clusters have: what the file says of its holder must do.
        return not _holder_is_alive(file)
    return True


def _told(text: bytes) -> dict[str, object]:
    with contextlib.suppress(ValueError):
        held = json.loads(text)
        if isinstance(held, dict):
            return held
    return {}


def _holder(path: Path) -> str:
    """Tell who holds a lock, as far as that is known."""
    try:
        held = _told(path.read_bytes())
    except OSError:  # Windows lets nobody read it
        held = {}
    return f" (process {held['process']} on {held['machine']})" if {"process", "machine"} <= held.keys() else ""


def _holder_is_alive(file: IO[bytes]) -> bool:
    """Whether the process that a lock tells of may be at work still; of another machine nobody knows."""
    file.seek(0)
    held = _told(file.read())
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


#: Byte that is locked under Windows, which lets nobody read what is locked.
_FAR = 1 << 30
