"""Friction of the page's run file: the files that were dropped, read and separated once for the jobs that follow."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from viscofric.errors import DataFileError, InputError
from viscofric.files import read_text
from viscofric.notes import Note, note_of
from viscofric.web.jobs.friction_tables import measurement_table
from viscofric.web.jobs.rubbers import kept, named_without_folder, without_folder

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
    from pathlib import Path

    from viscofric.friction.curves import FrictionCurves
    from viscofric.study.measurement_table import MeasurementTable
    from viscofric.traction import TractionRuns
    from viscofric.web.jobs.rubbers import Folders


_NOTHING = Note("", "")


@dataclass(frozen=True, eq=False)
class Measured:
    """What was recognised in the files of [measurement], and the friction in them.

    Attributes
    ----------
    runs : bool
        Whether they are runs of a tribometer, not friction curves that are ready.
    lines : list of (str, str)
        What was recognised, as pairs of name and value.
    steps : list of (int, str)
        Number and description of each step of the test.
    synthetic : bool
        Whether a file says that it was made up.
    curves : FrictionCurves or None
        None where runs cannot be separated.
    refusal : Note
        Why they cannot; empty where they can.
    notes : tuple of Note
        What was doubtful.
    """

    runs: bool
    lines: list[tuple[str, str]]
    steps: list[tuple[int, str]]
    synthetic: bool
    curves: FrictionCurves | None
    refusal: Note
    notes: tuple[Note, ...]


def measured(study: Mapping[str, Any], folders: Folders) -> Measured:
    """Return what the files of [measurement] hold, read here or found where an earlier job left it.

    Parameters
    ----------
    study : mapping
        Tables of a run file.
    folders : Folders

    Raises
    ------
    StudyError
        As `measurement_table` does.
    DataFileError
        If a file cannot be read; it is named without its folder.
    """
    table = measurement_table(study, folders)
    return kept("measured", [table], table.inputs, folders, lambda: _measured(table, folders))


def friction_curves(study: Mapping[str, Any], folders: Folders) -> FrictionCurves:
    """Return the friction curves of [measurement].

    Raises
    ------
    StudyError, DataFileError, InputError
        As `measured` does, or if the runs cannot be separated.
    """
    found = measured(study, folders)
    if found.curves is None:
        raise InputError(found.refusal)
    return found.curves


def _measured(table: MeasurementTable, folders: Folders) -> Measured:
    try:
        return _of_curves(table.curves, folders) if table.curves is not None else _of_runs(table, folders)
    except DataFileError as error:
        raise named_without_folder(error, folders) from None


def _of_curves(path: Path, folders: Folders) -> Measured:
    from viscofric.friction.curve_files import read_friction_curves

    curves = _named(read_friction_curves(path), folders)
    lines = [("file", path.name), ("recognised as", "a table of friction curves, separated already")]
    return Measured(False, lines, [], _is_made_up(path), curves, _NOTHING, tuple(map(note_of, curves.notes)))


def _of_runs(table: MeasurementTable, folders: Folders) -> Measured:
    from viscofric.readers import read_mtm
    from viscofric.report.runs_summary import runs_lines

    runs = read_mtm(*table.mtm)
    lines = [("files" if len(table.mtm) > 1 else "file", ", ".join(path.name for path in table.mtm))]
    lines += [("recognised as", _kinds(table.mtm)), *runs_lines(runs)]
    steps = [(step.number, without_folder(str(step), folders)) for step in runs.steps]
    made_up = any(_is_made_up(path) for path in table.mtm)
    try:
        curves = _named(_separated(runs, table), folders)
    except InputError as error:
        refusal = named_without_folder(error, folders).note
        return Measured(True, lines, steps, made_up, None, refusal, _named_notes(runs.notes, folders))
    return Measured(True, lines, steps, made_up, curves, _NOTHING, tuple(map(note_of, curves.notes)))


def _separated(runs: TractionRuns, table: MeasurementTable) -> FrictionCurves:
    from viscofric.friction.measurement.tribometry import separate

    if table.except_steps:
        runs = runs.select(except_steps=table.except_steps)
    return separate(runs, **table.settings)


def _kinds(paths: Sequence[Path]) -> str:
    from viscofric.files import read_bytes
    from viscofric.readers.mtm import formats
    from viscofric.readers.source import Source

    return "; ".join(dict.fromkeys(formats.name_of(Source(str(path), read_bytes(path))) for path in paths))


def _named(curves: FrictionCurves, folders: Folders) -> FrictionCurves:
    """Return curves that name uploaded files as the user knows them."""
    notes = _named_notes(curves.notes, folders)
    return replace(curves, source=without_folder(curves.source, folders), notes=notes)


def _named_notes(notes: Iterable[str], folders: Folders) -> tuple[Note, ...]:
    return tuple(note_of(note).reworded(lambda text: without_folder(text, folders)) for note in notes)


def _is_made_up(path: Path) -> bool:
    """Whether a file says of itself that it was not measured."""
    try:
        remarks = [line for line in read_text(str(path)).splitlines()[:50] if line.startswith("#")]
    except DataFileError:
        return False
    return any("synthetic" in line.lower() for line in remarks)
