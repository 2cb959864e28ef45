"""The tables of the page's run file that measured friction rests on, checked without the others."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pydantic import ValidationError

from viscofric.errors import StudyError
from viscofric.friction.curve_files import holds_friction_curves
from viscofric.notes import Note
from viscofric.study.contact_tables import IndenterTable  # noqa: TC001 - pydantic looks at it
from viscofric.study.measurement_table import MeasurementTable  # noqa: TC001 - pydantic looks at it
from viscofric.study.run_file import TABLES
from viscofric.study.run_file_errors import wrong_tables
from viscofric.study.table import Table
from viscofric.web.jobs.rubbers import insist_on_uploads

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.web.jobs.rubbers import Folders

_ABOUT = "drop the files of a tribometer, or a table of friction curves, on the page first"


class _MeasurementTables(Table):
    """The table of a run file that tells of measured friction."""

    measurement: MeasurementTable


class _IndenterTables(Table):
    """The table of a run file that tells what friction was measured with."""

    indenter: IndenterTable


def table_of_files(study: Mapping[str, Any], folders: Folders, names: Sequence[str]) -> dict[str, Any]:
    """Return [measurement] as it stands with other files: runs or friction curves, as they are recognised.

    Parameters
    ----------
    study : mapping
        Tables of a run file; how runs are to be separated is kept.
    folders : Folders
    names : sequence of str
        Of uploaded files.

    Raises
    ------
    StudyError
        If a file is none of the uploaded ones, or the kinds are mixed.
    """
    for name in names:
        _insist_on_upload(folders.files / name, folders.files)
    tables = [name for name in names if holds_friction_curves(folders.files / name)]
    if not tables:
        before = {key: value for key, value in study.get("measurement", {}).items() if key != "curves"}
        return {**before, "mtm": names[0] if len(names) == 1 else list(names)}
    if len(names) > 1:
        other = next((name for name in names if name not in tables), None)
        said = f"{other} is none: drop either" if other else "there are several: drop"
        words = f"{tables[0]} is a table of friction curves, and {said} one such table, or the runs of a tribometer."
        raise StudyError(Note("mixed-files", words, "measurement.curves"))
    return {"curves": tables[0]}


def measurement_table(study: Mapping[str, Any], folders: Folders) -> MeasurementTable:
    """Check [measurement] of a run file, without the other tables.

    Parameters
    ----------
    study : mapping
        Tables of a run file.
    folders : Folders

    Returns
    -------
    MeasurementTable
        With the paths of uploaded files.

    Raises
    ------
    StudyError
        With every wrong key, unit and range, or if a file is none of the uploaded ones.
    """
    if not study.get("measurement"):
        raise StudyError(Note("no-measurement", f"there is none; {_ABOUT}.", "measurement"))
    values = {"measurement": study["measurement"]}
    try:
        table = _MeasurementTables.model_validate(values).measurement
    except ValidationError as error:
        raise wrong_tables(error, values, {**TABLES, "": _MeasurementTables}) from None
    insist_on_uploads("measurement.mtm", table.mtm, folders.files)
    insist_on_uploads("measurement.curves", table.curves, folders.files)
    return table.beside(folders.files)


def indenter_of(study: Mapping[str, Any]) -> Indenter | None:
    """Return what [indenter] says that friction was measured with; None where there is no such table.

    Raises
    ------
    StudyError
        If the table is wrong, or says more than one size.
    """
    if not study.get("indenter"):
        return None
    values = {"indenter": study["indenter"]}
    try:
        table = _IndenterTables.model_validate(values).indenter
    except ValidationError as error:
        raise wrong_tables(error, values, {**TABLES, "": _IndenterTables}) from None
    for name, sizes in table.axes.items():
        if len(sizes) > 1:
            said = f"has {len(sizes)} values; friction was measured with one."
            raise StudyError(Note("several-sizes", said, f"indenter.{name}"))
    return table.made(*(sizes[0] for sizes in table.axes.values()))


def _insist_on_upload(path: Path, folder: Path) -> None:
    """Refuse a name, which may hold what would be a pattern in a run file, that is none of the uploaded files'."""
    if path.parent != folder or not path.is_file():
        said = f"'{path.name}' is not one of the page's files; drop it on the page first."
        raise StudyError(Note("file-not-here", said, "measurement.mtm"))
