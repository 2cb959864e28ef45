"""Friction curves and shift factors named on the command line, and the options with which runs are separated."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli.commands import together
from viscofric.cli.files import plainly
from viscofric.cli.keys import key, table_of
from viscofric.cli.rubber_options import column_options, find_rubber, rubber_of
from viscofric.notes import dumped, note_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.friction.curves import FrictionCurves
    from viscofric.rheology.shifts.shift_law import ShiftLaw
    from viscofric.rheology.shifts.vertical_shift import VerticalShift
    from viscofric.study.run_file.measurement import MeasurementTable


def _number_or_word(ctx: click.Context, param: click.Parameter, value: str | None) -> float | str | None:
    try:
        return None if value is None else float(value)
    except ValueError:
        return value


def _steps(ctx: click.Context, param: click.Parameter, value: str | None) -> list[int] | None:
    try:
        return None if value is None else [int(number) for number in value.split(",")]
    except ValueError:
        raise click.BadParameter(
            f"{value!r}: must be numbers of steps, such as '2' or '1,3'.", param_hint="--except-steps"
        ) from None


separation_options = together(
    column_options("'disc_speed=V1 (mm/s)'", table="measurement."),
    key(
        "measurement.zero",
        metavar="FORCE",
        help="Zero offset of the force cell, e.g. '0.1 N' [default: found from reversed motion, or as recorded].",
    ),
    key("measurement.zero_error", metavar="FORCE", help="Standard error of --zero."),
    key("measurement.coulomb", metavar="NUMBER|constant", type=str, callback=_number_or_word),
    key("measurement.coulomb_error", metavar="NUMBER", help="Standard error of --coulomb."),
    key(
        "measurement.except_steps",
        metavar="NUMBERS",
        type=str,
        callback=_steps,
        help="Steps of the test to leave out, e.g. '1,3', because load or temperature was not steady.",
    ),
    key("measurement.outliers", "--leave-out-outliers", flag_value="leave out", help="Leave out outliers."),
    key("measurement.speed_tolerance"),
    key("measurement.temperature_tolerance", metavar="DT"),
    heading="Separation of runs",
)


def separation_record(parameters: dict[str, Any]) -> dict[str, Any]:
    """Return the options of a separation in plain types, SI."""
    names = {"zero", "coulomb", "outliers", "speed_tolerance", "temperature_tolerance", "except_steps"}
    table = _measurement(parameters, mtm=["runs"])
    return table.model_dump(mode="json", include=names | table.model_fields_set - {"mtm"})


def _measurement(parameters: dict[str, Any], **source: Any) -> MeasurementTable:
    """Return the options of a separation as a run file's [measurement] of some files."""
    from viscofric.errors import StudyError

    try:
        table: MeasurementTable = table_of("measurement", parameters, **source)
    except StudyError as error:
        raise (error.at(source.get("curves", "")) if error.code == "contradiction" else error) from None
    return table


_TABLES = (".csv", ".txt", ".tsv", ".xlsx", ".xls")


def friction_curves(paths: Sequence[Path], parameters: dict[str, Any]) -> FrictionCurves:
    """Return the friction curves of files: tables of curves, or runs that are separated here."""
    from viscofric.errors import DataFileError, InputError
    from viscofric.friction.curve_files import holds_friction_curves
    from viscofric.study.measurement import read_measurement

    tables = [path for path in paths if holds_friction_curves(path, parameters["columns"])]
    if not tables:
        try:
            return separated_runs(paths, parameters)
        except DataFileError as error:
            if error.code != "missing-columns":
                raise
            also = " A table of friction curves has a column 'viscoelastic friction'."
            raise error.with_note(error.note.advising(also)) from None
    other = [path for path in paths if path not in tables]
    if other:
        raise InputError(
            f"{tables[0]} is a table of friction curves, {other[0]} is none: give either such tables or the runs of "
            "a tribometer.",
            code="mixed-inputs",
        )
    return joined([_plain(read_measurement(_measurement(parameters, curves=str(path)))) for path in tables])


def separated_runs(paths: Sequence[Path], parameters: dict[str, Any]) -> FrictionCurves:
    """Return the friction curves of the runs in files of a tribometer."""
    from viscofric.errors import InputError
    from viscofric.friction.curve_files import holds_friction_curves
    from viscofric.readers.mtm.read import read_mtm
    from viscofric.study.measurement import separated

    table = _measurement(parameters, mtm=list(map(str, paths)))
    try:
        runs = read_mtm(*table.mtm, columns=table.columns, sheet=table.sheet)
    except InputError as error:
        curves = [path for path in paths if holds_friction_curves(path, parameters["columns"])]
        no_runs = error.code in ("missing-columns", "unknown-quantity")
        if not (curves and no_runs) or "traction force" in error.note.values.get("known", ()):
            raise
        problem = f"{curves[0]} holds friction curves, not runs to be separated; viscofric master and identify take it."
        raise InputError(problem, code="friction-curves") from None
    return _plain(separated(runs, table))


def _plain(curves: FrictionCurves) -> FrictionCurves:
    """Return friction curves that do not name the file in which standard input was kept."""
    return replace(
        curves, source=plainly(curves.source), notes=tuple(note_of(note).reworded(plainly) for note in curves.notes)
    )


def joined(parts: Sequence[FrictionCurves]) -> FrictionCurves:
    """Put friction curves together, with the columns that all of them have."""
    import numpy as np

    from viscofric.errors import InputError
    from viscofric.friction.curves import FrictionCurves

    if len(parts) == 1:
        return parts[0]
    if len({part.load_unit for part in parts}) > 1:
        raise InputError(
            "friction curves of point and of line contacts, whose loads are per length, make no one set.",
            code="mixed-geometries",
        )
    columns: dict[str, Any] = {}
    for field in fields(FrictionCurves):
        values = [getattr(part, field.name) for part in parts]
        if all(isinstance(value, np.ndarray) for value in values):
            columns[field.name] = np.concatenate(values)
    return FrictionCurves(
        **columns,
        source=", ".join(dict.fromkeys(part.source for part in parts if part.source)),
        # Notes of the same words may have other values.
        notes=tuple({dumped(note_of(note).record()): note for part in parts for note in part.notes}.values()),
        load_unit=parts[0].load_unit,
        assumption=" ".join(dict.fromkeys(part.assumption for part in parts if part.assumption)),
    )


def shifts(
    parameters: dict[str, Any], parameter: str = "shift"
) -> tuple[ShiftLaw, VerticalShift | None] | tuple[None, None]:
    """Return the shift factors of a table, or those of a rubber, and its vertical shift; None if none are given."""
    from viscofric.errors import InputError
    from viscofric.rheology.shifts.shift_files import read_shift_factors

    name, columns, sheet = (parameters[one] for one in (parameter, "shift_factor_columns", "shift_factor_sheet"))
    if name is not None and Path(name).suffix.lower() in _TABLES:
        return read_shift_factors(name, columns=columns, sheet=sheet), None
    if columns or sheet:
        given = "--shift-factor-column" if columns else "--shift-factor-sheet"
        raise click.UsageError(f"{given} is for a table of shift factors, and --shift names none.")
    if name is None:
        return None, None
    rubber = find_rubber(name, parameter)
    if rubber.shift is None or not rubber.has_shift_factors:
        raise InputError(f"{name}: this rubber has no shift factors to compare with.", code="no-shift")
    return rubber.shift, rubber.vertical_shift


def is_of_synthetic(name: str | None) -> bool:
    """Whether an option names a synthetic material; tables of shift factors say themselves that they are."""
    from viscofric.rheology.catalogue import is_synthetic

    return name is not None and Path(name).suffix.lower() not in _TABLES and is_synthetic(rubber_of(name)[0])
