"""What jobs keep for later ones has a bound: what is oldest makes room."""

from __future__ import annotations

import contextlib
import os
import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

_MOST_BYTES = 300_000_000  # of a workspace
_YOUNG = 600.0  # s; what is younger may be of a job at work
_BETWEEN_LOOKS = 60.0  # s; jobs follow each other quickly while somebody moves a slider
_KINDS = (".pickle", ".json", ".npz")

_looked: dict[Path, float] = {}


def look_after(cache: Path) -> None:
    """Make room where nobody has looked for a while."""
    now = time.monotonic()
    if now - _looked.get(cache, -_BETWEEN_LOOKS) >= _BETWEEN_LOOKS:
        _looked[cache] = now
        make_room(cache)


def make_room(cache: Path, most: int = _MOST_BYTES, young: float = _YOUNG) -> None:
    """Remove the oldest rubbers and solved contacts where there are too many; later jobs make them anew.

    Parameters
    ----------
    cache : Path
        Of a workspace.
    most : int
        Bytes that may stay.
    young : float
        What was written so many seconds ago or less stays.
    """
    stays, before = 0, time.time() - young
    files = [entry for folder in _folders(cache) for entry in _kept_files(folder)]
    for modified, size, path in sorted(files, reverse=True):
        stays += size
        if stays > most and modified < before:
            with contextlib.suppress(OSError):
                path.unlink()


def _folders(cache: Path) -> list[Path]:
    """Return the folders of rubbers and of contacts, those of whole studies too."""
    return [cache, *(folder for folder in cache.glob("*cases")), *cache.glob("study/*.results/cases")]


def _kept_files(folder: Path) -> list[tuple[float, int, Path]]:
    found = []
    with contextlib.suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            if entry.name.endswith(_KINDS):
                with contextlib.suppress(OSError):
                    status = entry.stat()
                    found.append((status.st_mtime, status.st_size, folder / entry.name))
    return found
