"""Histories in files: text tables and workbooks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import DataFileError, InputError, check_choice
from viscofric.motion.history import BEFORE, CONTROLS, History
from viscofric.readers.one_table import HISTORY, HistoryColumns, history_columns
from viscofric.readers.table import name_columns
from viscofric.units import Quantity, registry, to_si


def read_history(
    path: str | PathLike[str],
    *,
    load: Quantity | None = None,
    indentation: Quantity | None = None,
    pressure: Quantity | None = None,
    gap: Quantity | None = None,
    speed: Quantity | None = None,
    temperature: Quantity | None = None,
    before: str = "untouched",
    direction: Sequence[float] = (1.0, 0.0),
    columns: Mapping[str, str] | None = None,
    sheet: str | None = None,
) -> History:
    """Read a history of load or depth, path and temperature.

    Parameters
    ----------
    path : str or path
        A table, text or workbook, with the column ``time`` and one of ``load``, ``indentation``, ``pressure`` and
        ``gap``; optionally ``position`` or ``speed`` along `direction` (or ``position x`` and ``position y``, ``speed
        x`` and ``speed y``), and ``temperature``.  Units stand in the headings, such as ``time (s)``.  The load of a
        line contact is in N/m.  Values are linear between the rows; two rows with one time are a jump.
    load, indentation, pressure, gap, speed, temperature : float, str or pint.Quantity, optional
        One value throughout, for a table without this column.
    before : str
        What happened before the first time: ``"untouched"``, ``"at rest"`` or ``"sliding"``; see `History`.
    direction : (float, float)
        Direction of a position or speed given along one line.
    columns : mapping, optional
        Headings that are not recognised, by quantity: ``{"load": "Fz (N)", "position_x": "stage"}``.  A unit in
        brackets counts instead of that of the file; ``"#3 (N)"`` is the third column, ``"= 20 N"`` a value of all rows.
    sheet : str, optional
        The only sheet of a workbook to read.

    Returns
    -------
    History

    Raises
    ------
    DataFileError
        If the file cannot be read, a column or its unit is missing or wrong, or a row cannot be part of a history;
        with the line of the file.
    InputError
        If a value is given for a column that the table has, or cannot be used.

    Examples
    --------
    >>> from pathlib import Path
    >>> import viscofric as vf
    >>> with Path("start.csv").open("w") as file:
    ...     for row in ("time (s),load (N),position (mm)", "0,25,0", "0.1,25,0", "0.3,25,20"):
    ...         print(row, file=file)
    >>> history = vf.motion.read_history("start.csv", temperature="60 degC")
    >>> history.position[:, 0].tolist()
    [0.0, 0.0, 0.02]
    """
    given: dict[str, Any] = {
        "load": load, "indentation": indentation, "pressure": pressure, "gap": gap, "speed": speed,
        "temperature": temperature,
    }  # fmt: skip
    constants = {name: value for name, value in given.items() if value is not None}
    _check(constants, before, direction)
    found = history_columns(path, columns, sheet)
    _insist_on_control(path, found, constants)
    for name in constants:
        if any(column == name or column.startswith(f"{name} ") for column in found.values):
            raise InputError(
                f"{name}: {path} has a column of it; give the value or the column, not both.",
                code="give-one",
                values={"argument": name},
            )
    try:
        arguments = _arguments(found)
        return History(**arguments, **constants, before=before, direction=direction)
    except InputError as error:
        place = error.note.values.get("index")
        raise DataFileError(path, error.note, None if place is None else found.lines[place]) from None


def _check(constants: Mapping[str, Any], before: str, direction: Sequence[float]) -> None:
    """Refuse values that no history can have; they are not errors of the file."""
    check_choice(before, "before", *BEFORE)
    controlled = constants if set(CONTROLS) & set(constants) else {"load": 0.0, **constants}
    units = CONTROLS | {"speed": "m/s", "temperature": "K"}
    units["load"] = History([0.0, 1.0], **controlled, direction=direction).load_unit or "N"
    for name, value in constants.items():
        to_si(value, units[name], name)


def _insist_on_control(path: str | PathLike[str], found: HistoryColumns, constants: Mapping[str, Any]) -> None:
    """Refuse a table without a column of load, indentation, pressure or gap."""
    if set(CONTROLS) & (set(found.values) | set(constants)):
        return
    raise DataFileError(
        path,
        f"there is no column of the load, indentation, pressure or gap; {HISTORY.example}",
        code="missing-columns",
        remedy=name_columns(HISTORY.key, ["load"]),
    )


def _arguments(found: HistoryColumns) -> dict[str, Any]:
    """Return the columns as arguments of `History`."""
    values: dict[str, Any] = dict(found.values)
    if "load" in values:
        values["load"] = registry().Quantity(values["load"], found.load_unit)
    for name in ("position", "speed"):
        parts = [values.pop(f"{name} {axis}", None) for axis in "xy"]
        if any(part is not None for part in parts):
            if name in values:
                problem = f"has columns of the {name} and of its x or y; give one of the two."
                raise InputError(problem, code="give-one")
            values[name] = _plane(parts, len(found.lines))
    return values


def _plane(parts: Sequence[Array | None], count: int) -> Array:
    """Return x and y in columns; a missing column is zero."""
    return np.stack([np.zeros(count) if part is None else part for part in parts], axis=1)
