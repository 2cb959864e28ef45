"""Results of a study in memory and on disk, with what is needed to repeat it."""

from __future__ import annotations

import hashlib
import json
import math
import platform
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path

import numpy as np

from viscofric.arrays import Mask
from viscofric.contact.free.estimates import beyond_accuracy as is_beyond
from viscofric.datasets import Dataset, DataTree
from viscofric.errors import InputError, brief
from viscofric.friction.curves import FrictionCurves
from viscofric.notes import Note, notes_in
from viscofric.showing import Plotted, Rows
from viscofric.study.results.case_table import CaseTable, tables_of_file, tables_of_tree
from viscofric.study.results.compare import ResultsComparison, compare_tables
from viscofric.study.results.export import Form, export_results
from viscofric.study.results.file import PREDICTION, cases_of, open_tree, rubbers_of
from viscofric.units import number


@dataclass(frozen=True, eq=False)
class StudyResults(Plotted):
    """The results of a study.

    Attributes
    ----------
    tree : xarray.DataTree
        Groups as in `viscofric.study.results.tree`.
    folder : Path
        Where it is stored.
    """

    tree: DataTree
    folder: Path

    def _shown(self) -> Rows:
        return (
            ("title", self.tree.attrs.get("title")),
            *self._shown_cases(),
            ("materials", len(self.materials)),
            ("failures", self.failures),
            ("warnings", self.warnings),
            ("folder", self.folder.name),
        )

    def _shown_cases(self) -> Rows:
        if "prediction" not in self.tree.children:
            return ()
        sizes, found = self.dataset.sizes, self.dataset["friction_coefficient"].values
        return ("cases", ", ".join(f"{size} {name}" for name, size in sizes.items())), ("friction coefficient", found)

    @property
    def dataset(self) -> Dataset:
        """The predicted cases over their axes, with the provenance in the attributes; SI units.

        Every axis of the study with more than one point is a dimension (material, sample, radius, thickness, load,
        temperature, speed …), the others are single coordinates.  Every coordinate and variable has `units` and
        `long_name`.  Where `failed` is 1, the other variables are missing (NaN).

        Raises
        ------
        InputError
            If the results are of a rubber alone.
        """
        return cases_of(self.tree, self.folder)

    def to_dataset(self) -> Dataset:
        """Return `dataset`."""
        return self.dataset

    @property
    def materials(self) -> dict[str, DataTree]:
        """Sweeps, shift factors, master curve and spectrum of each material, by its name."""
        return rubbers_of(self.tree)

    @property
    def fields(self) -> dict[int, Dataset]:
        """Pressure and displacement of the cases that kept them, by the number of the case (from 1)."""
        kept = self.tree.children.get("fields")
        return {} if kept is None else {int(number): node.to_dataset() for number, node in kept.children.items()}

    def export(self, form: Form, path: str | Path | None = None) -> Path:
        """Write for other programs; see `viscofric.study.results.export.FORMS`.

        Parameters
        ----------
        form : {"csv", "excel", "netcdf"}
            A table with a row for each case; a workbook with all tables; the labelled cases alone, as netCDF.
        path : str or Path, optional
            File, replaced if it exists; in the folder of the results if not given.

        Returns
        -------
        Path
            What was written.

        Raises
        ------
        InputError
            If there is no prediction, or the format is unknown.
        DataFileError
            If it cannot be written.
        """
        return export_results(self.tree, self.folder, form, path)

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
        return self.export("csv", path)

    def to_excel(self, path: str | Path) -> Path:
        """Write everything as a workbook (.xlsx), a sheet for each table; see `to_csv`."""
        return self.export("excel", path)

    def compare(self, other: StudyResults, *, tolerance: float | None = None) -> ResultsComparison:
        """Compare with other results; see `viscofric.compare_results`."""
        return compare_results(self, other, tolerance=tolerance)

    @property
    def beyond_accuracy(self) -> int:
        """Number of cases in which the estimated numerical error of friction exceeds the requested accuracy."""
        cases = self.dataset
        return int(beyond_accuracy(cases, float(cases.attrs.get("accuracy", math.inf))).sum())

    @property
    def notes(self) -> tuple[Note, ...]:
        """What was doubtful about the data, changed or left out, one note each."""
        return notes_in(self.tree.attrs, "notes")

    @property
    def failures(self) -> tuple[Note, ...]:
        """Cases that could not be solved, one note each."""
        return notes_in(self.tree.attrs, "failures")

    @property
    def warnings(self) -> tuple[Note, ...]:
        """What to be careful about, one note each: assumptions that do not hold well, accuracy that is missed."""
        return notes_in(self.tree.attrs, "warnings")


def beyond_accuracy(cases: Dataset, accuracy: float) -> Mask:
    """Return in which cases the estimated numerical error of friction exceeds the (relative) accuracy.

    `cases` have any shape; failed ones count as within.  Friction below the solver's floor, a fraction of the contact's
    slope, is compared with the floor.
    """
    slope = 0.0
    if {"indentation", "front", "rear"} <= set(cases.variables):
        slopes = np.ravel(2.0 * cases["indentation"].values / (cases["front"].values + cases["rear"].values))
        slope = float(np.max(slopes[np.isfinite(slopes)], initial=0.0))
    return is_beyond(cases["friction_coefficient"].values, cases["friction_error"].values, accuracy, slope)


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
    return StudyResults(*open_tree(path))


def compare_results(
    first: StudyResults | FrictionCurves | str | Path,
    second: StudyResults | FrictionCurves | str | Path,
    *,
    tolerance: float | None = None,
) -> ResultsComparison:
    """Compare two results case by case.

    Parameters
    ----------
    first, second : StudyResults, FrictionCurves, str or Path
        Results, their folder or file, or friction curves, or a table of these (CSV).
    tolerance : float, optional
        Largest relative difference that counts as none: 0 requires the same digits.  Without it, differences within
        twice the combined stated errors count as none (within the accuracy, of variables without a stated error).

    Returns
    -------
    ResultsComparison

    Raises
    ------
    DataFileError
        If results cannot be read.
    InputError
        If they have no case or no variable in common, or the tolerance is none.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber, ball = vf.synthetic_fluoroelastomer(), vf.Ball("9.525 mm")
    >>> case = dict(speeds=[0.02, 0.2], temperatures="60 degC", load="5 N")
    >>> rough, fine = (vf.predict_friction(rubber, ball, accuracy=one, **case) for one in (1e-2, 1e-3))
    >>> vf.compare_results(rough, fine, tolerance=1e-2).equal
    True
    """
    if tolerance is not None and (tolerance := number(tolerance, "tolerance")) < 0.0:
        raise InputError(f"tolerance = {brief(tolerance)}: must be a number from 0 on, such as 1e-3.", code="tolerance")
    return compare_tables(_tables_of(first), _tables_of(second), tolerance)


def _tables_of(given: StudyResults | FrictionCurves | str | Path) -> dict[str, CaseTable]:
    """Return the cases of results or friction curves, or of their file, by their group."""
    if isinstance(given, StudyResults):
        return tables_of_tree(given.tree, given.folder)
    from viscofric.friction.curves import FrictionCurves

    return {PREDICTION: CaseTable.of_curves(given)} if isinstance(given, FrictionCurves) else tables_of_file(given)


def input_hashes(inputs: Iterable[Path], folder: Path | None = None) -> str:
    """Return the SHA-256 of each input file, as JSON by path, relative to `folder` for files below that folder."""
    hashes = {}
    for path in inputs:
        # The reader reports what is not a plain file.
        if path.is_file():
            with path.open("rb") as file:
                hashes[_from(folder, path)] = hashlib.file_digest(file, "sha256").hexdigest()
    return json.dumps(hashes, ensure_ascii=False)


def _from(folder: Path | None, path: Path) -> str:
    if folder is not None and path.resolve().is_relative_to(folder.resolve()):
        path = path.resolve().relative_to(folder.resolve())
    return path.as_posix()


def provenance() -> dict[str, str]:
    """Return versions and time."""
    software = {
        "Python": platform.python_version(),
        **{name: version(name) for name in ("numpy", "scipy", "xarray", "python-calamine")},
    }
    return {
        "viscofric_version": version("viscofric"),
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "software": json.dumps(software),
    }
