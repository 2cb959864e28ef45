"""The files of each tab, in a temporary folder that goes with the server."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import sys
import tempfile
import threading
import time
import unicodedata
from collections.abc import AsyncIterator
from contextlib import aclosing
from pathlib import Path
from typing import IO

from viscofric.errors import InputError, brief

#: What a tab may call itself.
KEY = r"^[A-Za-z0-9_-]{8,64}$"
LARGEST_UPLOAD = 20_000_000  # bytes
MOST_FILES = 200
_MOST_BYTES = 200_000_000  # of all files of a workspace
#: What to do about too many files: the page removes none, and a saved project has those that its study names.
_FEWER_FILES = "use “Save project”, and “Open project” in a new tab: it has only the files that the project uses."
_MOST_WORKSPACES = 50
_LONGEST_NAME = 150  # bytes
_PREFIX = "viscofric-web-"
_LOCK = "lock"
_YOUNG = 60.0  # s; a folder without its lock may be one that is being made
# Marks that file systems or patterns of file names give a meaning to, and those that cannot be seen.
_NOT_IN_NAMES = re.compile(
    r'[\x00-\x1f\x7f-\x9f/\\<>:"|?*\u200b-\u200f\u2028-\u202e\u2066-\u2069\ufeff\ufffd\ud800-\udfff]'
)
_DEVICE = re.compile(r"^(con|prn|aux|nul|com\d|lpt\d)(\.|$)", re.IGNORECASE)


def checked_name(name: str) -> str:
    """Return the name of a file in its composed form; raise if it is not a plain name that every system can have."""
    name = unicodedata.normalize("NFC", name)
    if not name or name != name.strip() or name.startswith(".") or name.endswith("."):
        words = "is not the name of a file; it has a letter or more, and no dot or space around it."
        raise InputError(f"{brief(name)} {words}", code="not-a-name")
    if _NOT_IN_NAMES.search(name) or _DEVICE.match(name):
        words = "is not a plain name of a file that every system can have, like 'sweeps.csv'."
        raise InputError(f"{brief(name)} {words}", code="not-a-name")
    if len(name.encode()) > _LONGEST_NAME:
        words = f"is too long for the name of a file; at most {_LONGEST_NAME} bytes."
        raise InputError(f"{brief(name)} {words}", code="too-long")
    return name


class Workspace:
    """The folders of a tab: `files` that the user gave, `downloads` made for them, `cache` of jobs."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.files, self.downloads, self.cache = (folder / name for name in ("files", "downloads", "cache"))
        for one in (self.files, self.downloads, self.cache):
            one.mkdir(parents=True, exist_ok=True)
        self.used = time.monotonic()
        self.jobs = 0  # at work in it

    async def while_at_work(self, lines: AsyncIterator[bytes]) -> AsyncIterator[bytes]:
        """Yield the messages of a job; while it runs, the workspace is kept."""
        self.jobs += 1
        try:
            async with aclosing(lines):  # type: ignore[type-var]
                async for line in lines:
                    yield line
        finally:
            self.jobs -= 1
            self.used = time.monotonic()

    def listing(self) -> list[tuple[str, int]]:
        """Return names and sizes (bytes) of the user's files, by name."""
        with os.scandir(self.files) as entries:
            return sorted((one.name, one.stat().st_size) for one in entries if not one.name.startswith("."))

    def store(self, name: str, content: bytes) -> None:
        """Keep a file; one of the same name is replaced; raise `InputError` if it is one too many, or too large."""
        others = [size for other, size in self.listing() if other != name]
        if len(content) > LARGEST_UPLOAD:
            raise InputError(
                f"{name} has more than {LARGEST_UPLOAD / 1e6:.0f} MB, too much for measurements.", code="too-large"
            )
        if len(others) >= MOST_FILES:
            raise InputError(
                f"This tab has {len(others)} files already, and can keep no more; {_FEWER_FILES}", code="too-many-files"
            )
        if sum(others) + len(content) > _MOST_BYTES:
            raise InputError(
                f"All files of this tab together have more than {_MOST_BYTES / 1e6:.0f} MB; {_FEWER_FILES}",
                code="no-space",
            )
        handle, temporary = tempfile.mkstemp(dir=self.files, prefix=".")
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        Path(temporary).replace(self.files / name)

    def remove(self, name: str) -> bool:
        """Remove a file; return whether there was one."""
        try:
            (self.files / name).unlink()
        except FileNotFoundError:
            return False
        return True


class Workspaces:
    """All workspaces of a server, in a temporary folder that is locked as long as the server lives."""

    def __init__(self, given: dict[str, Path] | None = None) -> None:
        remove_stale()
        self.given = given or {}
        self.root = Path(tempfile.mkdtemp(prefix=_PREFIX))
        self._lock = _locked(self.root)
        self._known: dict[str, Workspace] = {}
        self._one_at_a_time = threading.Lock()  # a fresh tab requests several things at once

    def get(self, key: str) -> Workspace:
        """Return the workspace of a tab, a new one if need be; the one that rested longest makes room for it."""
        with self._one_at_a_time:
            workspace = self._known.get(key) or self._new(key)
            workspace.used = time.monotonic()
            return workspace

    def _new(self, key: str) -> Workspace:
        while len(self._known) >= _MOST_WORKSPACES:
            resting = [one for one, workspace in self._known.items() if not workspace.jobs]
            if not resting:
                raise InputError(
                    f"{len(self._known)} tabs are at work already; close some first.", code="too-many-tabs"
                )
            oldest = min(resting, key=lambda one: self._known[one].used)
            shutil.rmtree(self._known.pop(oldest).folder, ignore_errors=True)
        workspace = Workspace(self.root / f"{len(key)}-{key.encode().hex()}")
        for name, path in self.given.items():
            with contextlib.suppress(OSError):
                shutil.copyfile(path, workspace.files / name)
        self._known[key] = workspace
        return workspace

    def close(self) -> None:
        """Remove everything."""
        self._lock.close()
        shutil.rmtree(self.root, ignore_errors=True)


def _locked(folder: Path) -> IO[bytes]:
    """Make a file in a folder and lock it; the system lets go of the lock when this process ends, however it does."""
    if sys.platform == "win32":  # where an open file cannot be removed, which serves the same purpose
        return (folder / _LOCK).open("wb")
    import fcntl

    file = (folder / f".{_LOCK}").open("wb")
    fcntl.flock(file, fcntl.LOCK_EX)
    Path(file.name).rename(folder / _LOCK)  # locked before anybody sees it
    return file


def remove_stale() -> None:
    """Remove the folders of servers that were killed and could not do it themselves."""
    for folder in Path(tempfile.gettempdir()).glob(f"{_PREFIX}*"):
        with contextlib.suppress(OSError):
            if folder.is_symlink() or not folder.is_dir() or not _is_own(folder) or _is_in_use(folder):
                continue
            shutil.rmtree(folder, ignore_errors=True)


def _is_own(folder: Path) -> bool:
    return sys.platform == "win32" or folder.stat().st_uid == os.getuid()


def _is_in_use(folder: Path) -> bool:
    lock = folder / _LOCK
    if not lock.exists():
        return time.time() - folder.stat().st_mtime < _YOUNG
    if sys.platform == "win32":
        try:
            lock.unlink()
        except PermissionError:
            return True
        return False
    import fcntl

    with lock.open("rb") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
    return False
