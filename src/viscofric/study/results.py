"""Results of a study in memory and on disk, with what is needed to repeat it."""

from __future__ import annotations

import hashlib
import json
import math
import os
import platform
import tempfile
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from viscofric.contact.free.estimates import FRICTION_FLOOR
from viscofric.errors import DataFileError, InputError
from viscofric.files import file_path, insist_on_true_size
from viscofric.study.integrity import DIGEST, digest, what_helps, what_is_wrong

if TYPE_CHECKING:
    from collections.abc import Iterable

    import xarray
    from numpy.typing import NDArray

    from viscofric.study.compare import ResultsComparison

RESULTS_FILE = "results.nc"
_PREDICTION = "prediction"
_ROUNDING = 1e-9
#: Attributes of the whole that a data set taken out of it keeps: what it is, and where it comes from.
_ABOUT = (
    "title",
    "data_origin",
    "accuracy",
    "seed",
    "indenter",
    "study_file",
    "study_text",
    "input_hashes",
    "failures",
    "viscofric_version",
    "created",
    "software",
)


@dataclass(frozen=True, eq=False)
class StudyResults:
    """Everything that a study found.

    Attributes
    ----------
    tree : xarray.DataTree
        Laid out as told in `viscofric.study.labels` and `viscofric.study.sweep_labels`.
    folder : Path
        Where it is stored.
    """

    tree: xarray.DataTree
    folder: Path

    @property
    def dataset(self) -> xarray.Dataset:
        """The predicted cases over their axes, with the provenance in the attributes; SI units.

        Every axis of the study with more than one point is a dimension (material, sample, radius, thickness, load,
        temperature, speed …), the others are single coordinates.  Every coordinate and variable has `units` and
        `long_name`.  Where `failed` is 1, the other variables are missing (NaN).

        Raises
        ------
        InputError
            If the results are of a rubber alone.
        """
        if _PREDICTION not in self.tree.children:
            raise InputError(f"{self.folder}: these are results of a rubber alone, without a prediction of friction.")
        found = self.tree[_PREDICTION].to_dataset()
        return found.assign_attrs({name: self.tree.attrs[name] for name in _ABOUT if name in self.tree.attrs})

    @property
    def materials(self) -> dict[str, xarray.DataTree]:
        """What is known of each rubber, by its name: its sweeps, shift factors, master curve and spectrum."""
        branches = self.tree.children.get("materials")
        if branches is None:
            return {str(self.tree.attrs.get("material", "")): self.tree}
        told = self.dataset.coords["material"].values.tolist() if _PREDICTION in self.tree.children else []
        names = dict(enumerate(map(str, told), 1))
        return {names.get(int(number), number): branch for number, branch in branches.children.items()}

    @property
    def fields(self) -> dict[int, xarray.Dataset]:
        """Pressure and displacement of the cases that kept them, by the number of the case (from 1)."""
        kept = self.tree.children.get("fields")
        return {} if kept is None else {int(number): node.to_dataset() for number, node in kept.children.items()}

    def to_csv(self, path: str | Path) -> Path:
        """Write the cases as a table (CSV): a row each, units in the headings, provenance in lines with ``#``.

        Parameters
        ----------
        path : str or Path
            Replaced if it exists.

        Raises
        ------
        DataFileError
            If it cannot be written.
        """
        from viscofric.study.export import export_results

        return export_results(self, "csv", path)

    def to_excel(self, path: str | Path) -> Path:
        """Write everything as a workbook (.xlsx), a sheet for each table; see `to_csv`."""
        from viscofric.study.export import export_results

        return export_results(self, "excel", path)

    def compare(self, other: StudyResults, *, tolerance: float | None = None) -> ResultsComparison:
        """Compare with other results; see `viscofric.compare_results`."""
        from viscofric.study.compare import compare_results

        return compare_results(self, other, tolerance=tolerance)

    @property
    def beyond_accuracy(self) -> int:
        """Number of cases in which the estimated numerical error of friction is above the accuracy asked for."""
        cases = self.dataset
        return int(beyond_accuracy(cases, float(cases.attrs.get("accuracy", math.inf))).sum())

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
        """What to be careful about, one sentence each: assumptions that do not hold well, accuracy that is missed."""
        return tuple(json.loads(self.tree.attrs["warnings"]))


def beyond_accuracy(cases: xarray.Dataset, accuracy: float) -> NDArray[np.bool_]:
    """Return in which cases the estimated numerical error of friction is above the accuracy asked for.

    Parameters
    ----------
    cases : xarray.Dataset
        Predicted cases, in any shape, which the answer has; those that failed are not among them.
    accuracy : float
        Relative; of friction below the solver's floor, a fraction of the contact's slope, relative to that.
    """
    friction, error = (np.abs(cases[name].values) for name in ("friction_coefficient", "friction_error"))
    floor = 0.0
    if {"indentation", "front", "rear"} <= set(cases.variables):
        slopes = np.ravel(2.0 * cases["indentation"].values / (cases["front"].values + cases["rear"].values))
        floor = FRICTION_FLOOR * float(np.max(slopes[np.isfinite(slopes)], initial=0.0))
    beyond: NDArray[np.bool_] = error > accuracy * np.maximum(friction, floor) * (1.0 + _ROUNDING)
    return beyond


def open_results(path: str | Path) -> StudyResults:
    r"""Open the results of a study.

    Parameters
    ----------
    path : str or Path
        The folder that `run_study` wrote, or the ``results.nc`` in it.

    Returns
    -------
    StudyResults

    Raises
    ------
    DataFileError
        If there are no results, they are of something else, or they are damaged.

    Examples
    --------
    >>> from pathlib import Path
    >>> import viscofric as vf
    >>> lines = [
    ...     "[material]",
    ...     'catalogue = "synthetic fluoroelastomer"',
    ...     "[indenter]",
    ...     'radius = "9.525 mm"',
    ...     "[conditions]",
    ...     'load = "5 N"',
    ...     'speed = "0.1 m/s"',
    ...     'temperature = ["60 degC", "90 degC"]',
    ...     "[solver]",
    ...     "accuracy = 1e-2",
    ... ]
    >>> _ = Path("ball.toml").write_text("\n".join(lines))
    >>> _ = vf.run_study("ball.toml")
    >>> results = vf.open_results("ball.results")
    >>> float(results.dataset["indentation"].sel(temperature=333.15)) > 0.0
    True
    """
    import h5netcdf  # noqa: F401 - what is wrong with it is nothing of the file's
    import xarray

    file = file_path(path)
    if file.is_dir():
        file = file / RESULTS_FILE
        solved = 0 if file.is_file() else sum(1 for _ in file.parent.glob("cases/*.json"))
        if solved:
            raise DataFileError(
                file,
                f"no such file: the study has not been finished.  Contacts solved so far: {solved}.  Running it with "
                "--resume completes it; with --finished-only, it puts together what is there.",
            )
    if not file.is_file():
        raise DataFileError(file, f"no such results file; {_where_they_are(file.parent)}")
    try:
        insist_on_true_size(file)
        with xarray.open_datatree(file, engine="h5netcdf", phony_dims="access") as stored:
            tree = stored.load()
            found = digest(tree)
    except Exception as error:  # h5py raises many kinds; the file tells more than they do
        raise DataFileError(file, what_is_wrong(file, error)) from error
    if "viscofric_version" not in tree.attrs:
        raise DataFileError(file, "is a netCDF file, but not one of results of viscofric.")
    if not tree.children:
        raise DataFileError(
            file,
            "holds the cases alone, as exported for other programs (xarray.open_dataset reads it); give the folder of "
            "the study's results.",
        )
    if tree.attrs.get(DIGEST, found) != found:
        raise DataFileError(file, f"is damaged: it does not hold what was written into it.{what_helps(file)}")
    return StudyResults(tree, file.parent)


def _where_they_are(folder: Path) -> str:
    """Say what to do where a folder holds no results."""
    near = sorted(other.parent for other in folder.glob(f"*/{RESULTS_FILE}"))
    return f"there are results in {near[0]}." if near else "run the study first."


def save_results(tree: xarray.DataTree, folder: Path) -> Path:
    """Write a tree to a folder's ``results.nc``; the file is there whole or not at all."""
    target = folder / RESULTS_FILE
    tree.attrs[DIGEST] = digest(tree)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder, prefix=".results.") as temporary:
            path = Path(temporary) / RESULTS_FILE
            tree.to_netcdf(path, engine="h5netcdf")
            with path.open("rb+") as file:
                os.fsync(file.fileno())
            path.replace(target)
    except (OSError, RuntimeError) as error:  # RuntimeError: HDF5, where it closes a file on a full disk
        # h5py buries the reason in a long text of its own, and gives only the number apart.
        number = getattr(error, "errno", None)
        raise DataFileError(target, f"cannot be written ({os.strerror(number) if number else error}).") from error
    return target


def input_hashes(inputs: Iterable[Path], beside: Path | None = None) -> str:
    """Return the SHA-256 of each input file, as JSON keyed by its path.

    Parameters
    ----------
    inputs : iterable of Path
    beside : Path, optional
        Folder of the run file: paths below it are told from there, so that they say the same on another machine.
    """
    hashes = {}
    for path in inputs:
        # What is not a plain file is told by its reader.
        if path.is_file():
            with path.open("rb") as file:
                hashes[_from(beside, path)] = hashlib.file_digest(file, "sha256").hexdigest()
    return json.dumps(hashes, ensure_ascii=False)


def _from(folder: Path | None, path: Path) -> str:
    if folder is not None and path.resolve().is_relative_to(folder.resolve()):
        path = path.resolve().relative_to(folder.resolve())
    return path.as_posix()


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
