"""Friction curves and shift factors named on the command line, whatever file they lie in."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.friction.curves import FrictionCurves
    from viscofric.rheology.shifts.shift_law import ShiftLaw
    from viscofric.rheology.shifts.vertical_shift import VerticalShift

_TABLES = (".csv", ".txt", ".tsv", ".xlsx", ".xls")


#: Settings that tables of friction curves take too.
_OF_TABLES = ("columns", "sheet")


def friction_curves(paths: Sequence[Path], settings: dict[str, Any]) -> FrictionCurves:
    """Return the friction curves of files: tables of curves, or runs that are separated here."""
    from viscofric.cli.separation_options import refuse_settings
    from viscofric.errors import DataFileError, InputError
    from viscofric.friction.curve_files import holds_friction_curves, read_friction_curves

    headings, sheet = settings.get("columns"), settings.get("sheet")
    tables = [path for path in paths if holds_friction_curves(path, headings)]
    if not tables:
        try:
            return separated(paths, settings)
        except DataFileError as error:
            if error.code != "missing-columns":
                raise
            raise InputError(
                f"{error} A table of friction curves has a column 'viscoelastic friction'.", code="missing-columns"
            ) from error
    other = [path for path in paths if path not in tables]
    if other:
        raise InputError(
            f"{tables[0]} is a table of friction curves, {other[0]} is none: give either such tables or the runs of "
            "a tribometer.",
            code="mixed-inputs",
        )
    refuse_settings({name: value for name, value in settings.items() if name not in _OF_TABLES}, tables[0])
    return joined([_plain(read_friction_curves(path, columns=headings, sheet=sheet)) for path in tables])


def separated(paths: Sequence[Path], settings: dict[str, Any]) -> FrictionCurves:
    """Return the friction curves of the runs in files of a tribometer."""
    from viscofric.friction.measurement.tribometry import separate
    from viscofric.readers.mtm.read import read_mtm

    settings = dict(settings)
    runs = read_mtm(*paths, columns=settings.pop("columns", None), sheet=settings.pop("sheet", None))
    steps = settings.pop("except_steps")
    return _plain(separate(runs if steps is None else runs.select(except_steps=steps), **settings))


def _plain(curves: FrictionCurves) -> FrictionCurves:
    """Return friction curves that do not name the file in which standard input was kept."""
    from viscofric.cli.files import plainly
    from viscofric.notes import note_of

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
        notes=tuple(dict.fromkeys(note for part in parts for note in part.notes)),
        load_unit=parts[0].load_unit,
        assumption=" ".join(dict.fromkeys(part.assumption for part in parts if part.assumption)),
    )


def shifts(
    name: str, columns: dict[str, str] | None = None, sheet: str | None = None, *, parameter: str = "shift"
) -> tuple[ShiftLaw, VerticalShift | None]:
    """Return the shift factors of a table, or those of a rubber, and its vertical shift where it has one."""
    from viscofric.errors import InputError
    from viscofric.rheology.shifts.shift_files import read_shift_factors

    if Path(name).suffix.lower() in _TABLES:
        return read_shift_factors(name, columns=columns, sheet=sheet), None
    from viscofric.cli.rubber_options import find_rubber

    rubber = find_rubber(name, parameter)
    if rubber.shift is None:
        raise InputError(f"{name}: this rubber has no shift factors to compare with.", code="no-shift")
    return rubber.shift, rubber.vertical_shift
