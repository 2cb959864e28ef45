"""Results of a study in memory and on disk, with what is needed to repeat it."""

from __future__ import annotations

import hashlib
import json
import os
import platform
import tempfile
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

from viscofric.errors import DataFileError

if TYPE_CHECKING:
    from collections.abc import Iterable

    import xarray

RESULTS_FILE = "results.nc"


@dataclass(frozen=True, eq=False)
class StudyResults:
    """Everything that a study found.

    Attributes
    ----------
    tree : xarray.DataTree
        Laid out as told in `viscofric.study.labels`.
    folder : Path
        Where it is stored.
    """

    tree: xarray.DataTree
    folder: Path

    @property
    def notes(self) -> tuple[str, ...]:
        """What was doubtful about the data, changed or left out, one sentence each."""
        return tuple(json.loads(self.tree.attrs["notes"]))

    @property
    def failures(self) -> tuple[str, ...]:
        """Cases that could not be solved, one sentence each."""
        return tuple(json.loads(self.tree.attrs["failures"]))

    @property
    def warnings(self) -> tuple[str, ...]:
        """Assumptions that do not hold well, one sentence each."""
        return tuple(json.loads(self.tree.attrs["warnings"]))


def open_results(folder: str | Path) -> StudyResults:
    """Open the results of a study.

    Parameters
    ----------
    folder : str or Path
        The folder that `run_study` wrote, or the ``results.nc`` in it.

    Raises
    ------
    DataFileError
        If there are no results, or they cannot be read.
    """
    import xarray

    path = Path(folder)
    if path.is_dir():
        path = path / RESULTS_FILE
    if not path.is_file():
        raise DataFileError(path, "no such results file; run the study first.")
    try:
        with xarray.open_datatree(path, engine="h5netcdf") as stored:
            tree = stored.load()
    except Exception as error:  # h5py raises many kinds; all mean the same to the user
        raise DataFileError(path, f"cannot be read as results of viscofric ({error}).") from error
    return StudyResults(tree, path.parent)


def save_results(tree: xarray.DataTree, folder: Path) -> Path:
    """Write a tree to a folder's ``results.nc``; the file is there whole or not at all."""
    target = folder / RESULTS_FILE
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder, prefix=".results.") as temporary:
            path = Path(temporary) / RESULTS_FILE
            tree.to_netcdf(path, engine="h5netcdf")
            path.replace(target)
    except OSError as error:
        # h5py buries the reason in a long text of its own, and gives only the number apart.
        reason = os.strerror(error.errno) if error.errno else str(error)
        raise DataFileError(target, f"cannot be written ({reason}).") from error
    return target


def input_hashes(inputs: Iterable[Path]) -> str:
    """Return the SHA-256 of each input file, as JSON keyed by its path."""
    hashes = {}
    for path in inputs:
        # What is not a plain file is told by its reader.
        if path.is_file():
            with path.open("rb") as file:
                hashes[path.as_posix()] = hashlib.file_digest(file, "sha256").hexdigest()
    return json.dumps(hashes, ensure_ascii=False)


def provenance() -> dict[str, str]:
    """Return what else is needed to repeat a study: versions and time."""
    software = {
        "Python": platform.python_version(),
        **{name: version(name) for name in ("numpy", "scipy", "xarray", "python-calamine", "tadatakit")},
    }
    return {
        "viscofric_version": version("viscofric"),
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "software": json.dumps(software),
    }
