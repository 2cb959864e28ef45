"""Friction of the page's run file: the files that were dropped, read and separated once for the jobs that follow."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from viscofric.contact.indenters.indenter import Indenter
from viscofric.errors import InputError, StudyError
from viscofric.files import read_bytes, says_synthetic
from viscofric.friction.curve_files import holds_friction_curves
from viscofric.friction.curves import FrictionCurves
from viscofric.notes import Note, note_of
from viscofric.readers.mtm.read import format_name, read_mtm
from viscofric.readers.source import Source
from viscofric.report.texts.friction import runs_lines
from viscofric.study.measurement import read_measurement, separated
from viscofric.study.run_file.contact import AnyIndenterTable, IndenterTable
from viscofric.study.run_file.measurement import MeasurementTable
from viscofric.web.jobs.context import Context
from viscofric.web.jobs.rubbers import checked_part, insist_on_uploads, kept

_NOTHING = Note("", "")


@dataclass(frozen=True, eq=False)
class Measured:
    """What was recognised in the files of [measurement], and the friction in them."""

    runs: bool  # whether they are runs of a tribometer, not friction curves that are ready
    lines: list[tuple[str, str]]  # what was recognised, as pairs of name and value
    steps: list[tuple[int, str]]  # number and description of each step of the test
    synthetic: bool  # whether a file says that it was made up
    curves: FrictionCurves | None  # None where runs cannot be separated
    refusal: Note  # why they cannot; empty where they can
    notes: tuple[Note, ...]  # what was doubtful


def measured(study: Mapping[str, Any], context: Context) -> Measured:
    """Return what the files of [measurement] hold, read here or found where an earlier job left it."""
    table = measurement_table(study, context)
    make = _of_runs if table.curves is None else _of_curves
    return kept("measured", [table], table.inputs, context, lambda: make(table, context))


def friction_curves(study: Mapping[str, Any], context: Context) -> FrictionCurves:
    """Return the friction curves of [measurement]; raise the `InputError` of runs that cannot be separated."""
    found = measured(study, context)
    if found.curves is None:
        raise InputError(found.refusal)
    return found.curves


def _of_curves(table: MeasurementTable, context: Context) -> Measured:
    curves, (path,) = _named(read_measurement(table), context), table.inputs
    lines = [("file", path.name), ("recognised as", "a table of friction curves, separated already")]
    return Measured(False, lines, [], says_synthetic(path), curves, _NOTHING, tuple(map(note_of, curves.notes)))


def _of_runs(table: MeasurementTable, context: Context) -> Measured:
    runs = read_mtm(*table.mtm, columns=table.columns, sheet=table.sheet)
    lines = [("files" if len(table.mtm) > 1 else "file", ", ".join(path.name for path in table.mtm))]
    kinds = dict.fromkeys(format_name(Source(str(path), read_bytes(path))) for path in table.mtm)
    lines += [("recognised as", "; ".join(kinds)), *runs_lines(runs)]
    steps = [(step.number, str(step)) for step in runs.steps]
    made_up = any(says_synthetic(path) for path in table.mtm)
    try:
        curves = _named(separated(runs, table), context)
    except InputError as error:
        return Measured(True, lines, steps, made_up, None, error.note, tuple(map(note_of, runs.notes)))
    return Measured(True, lines, steps, made_up, curves, _NOTHING, tuple(map(note_of, curves.notes)))


def _named(curves: FrictionCurves, context: Context) -> FrictionCurves:
    """Return curves that name uploaded files without their folder, as downloads of them do."""

    def plain(text: str) -> str:
        return text.replace(f"{context.files}{os.sep}", "")

    notes = tuple(note_of(note).reworded(plain) for note in curves.notes)
    return replace(curves, source=plain(curves.source), notes=notes)


_ABOUT = "drop the files of a tribometer, or a table of friction curves, on the page first"


def table_of_files(study: Mapping[str, Any], context: Context, names: Sequence[str]) -> dict[str, Any]:
    """Return [measurement] with other uploaded files, recognised as runs or friction curves, not both."""
    for name in names:
        _insist_on_upload(context.files / name, context.files)
    tables = [name for name in names if holds_friction_curves(context.files / name)]
    if not tables:
        of_curves = ("curves", "columns", "sheet")
        before = {key: value for key, value in study.get("measurement", {}).items() if key not in of_curves}
        return {**before, "mtm": names[0] if len(names) == 1 else list(names)}
    if len(names) > 1:
        other = next((name for name in names if name not in tables), None)
        said = f"{other} is none: drop either" if other else "there are several: drop"
        words = f"{tables[0]} is a table of friction curves, and {said} one such table, or the runs of a tribometer."
        raise StudyError(Note("mixed-files", words, "measurement.curves"))
    return {"curves": tables[0]}


def measurement_table(study: Mapping[str, Any], context: Context) -> MeasurementTable:
    """Check [measurement] of a run file alone; paths are those of uploaded files."""
    if not study.get("measurement"):
        raise StudyError(Note("no-measurement", f"there is none; {_ABOUT}.", "measurement"))
    table: MeasurementTable = checked_part(measurement=(MeasurementTable, study["measurement"])).measurement
    insist_on_uploads("measurement.mtm", table.mtm, context.files)
    insist_on_uploads("measurement.curves", table.curves, context.files)
    return table.relative_to(context.files)


def indenter_of(study: Mapping[str, Any]) -> Indenter | None:
    """Return the one indenter of [indenter]; None without such a table."""
    if not study.get("indenter"):
        return None
    table: AnyIndenterTable = checked_part(indenter=(IndenterTable, study["indenter"])).indenter
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
