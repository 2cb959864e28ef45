"""Indentation tests, rebounds and oscillations read from tables."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from os import PathLike
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import DataFileError, InputError, check_choice
from viscofric.friction.identification.indentation.record import RESPONSE, Control, IndentationRecord
from viscofric.friction.identification.indentation.tables import OscillationRecord, ReboundRecord
from viscofric.motion.history import CONTROLS
from viscofric.nominal import SAME_TEMPERATURE, numbered
from viscofric.readers.dma.names import TEMPERATURE
from viscofric.readers.dma.ramps import WIDEST_TEMPERATURE
from viscofric.readers.headings import Vocabulary
from viscofric.readers.one_table import HISTORY, history_columns, insist_on_columns, table_of
from viscofric.readers.table import Table, name_columns
from viscofric.units import Quantity, positive, shown_celsius, to_si

#: Quantity -> unit, and names of its column.
_REBOUND = {
    "speed": ("m/s", frozenset({"v", "speed", "velocity", "impact speed"})),
    "restitution": ("dimensionless", frozenset({"e", "restitution", "coefficient of restitution"})),
    "contact_time": ("s", frozenset({"contact time", "duration"})),
    "peak_force": ("N", frozenset({"peak force", "largest force", "maximum force"})),
    "indentation": ("m", frozenset({"indentation", "depth", "largest indentation", "maximum depth"})),
    "temperature": ("K", TEMPERATURE),
}
_OSCILLATION = {
    "frequency": ("Hz", frozenset({"f", "frequency"})),
    "storage_stiffness": ("N/m", frozenset({"storage stiffness", "K'"})),
    "loss_stiffness": ("N/m", frozenset({"loss stiffness", "K''"})),
    "temperature": ("K", TEMPERATURE),
}


def _vocabulary(kind: str, columns: Mapping[str, tuple[str, frozenset[str]]], *needed: tuple[str, ...]) -> Vocabulary:
    return Vocabulary(
        kind,
        {name.replace("_", " "): names for name, (_, names) in columns.items()},
        needed=needed,
        example=f"{kind} has e.g. "
        + ", ".join(repr(f"{name.replace('_', ' ')} ({unit})") for name, (unit, _) in columns.items()),
        key="indentation.columns",
        offered=tuple((name.replace("_", " "), unit) for name, (unit, _) in columns.items()),
    )


_TESTS = replace(
    HISTORY,
    kind="a table of an indentation test",
    example="an indentation test has 'time (s)', 'load (N)' and 'indentation (mm)'",
    key="indentation.columns",
)
_REBOUNDS = _vocabulary(
    "a table of rebounds", _REBOUND, ("speed",), ("restitution", "contact time", "peak force", "indentation")
)
_OSCILLATIONS = _vocabulary(
    "a table of stiffness over frequency", _OSCILLATION, ("frequency",), ("storage stiffness",), ("loss stiffness",)
)


def read_indentation(
    path: str | PathLike[str],
    *,
    control: Control,
    temperature: Quantity | None = None,
    error: Quantity | None = None,
    start: Quantity | None = None,
    columns: Mapping[str, str] | None = None,
    sheet: str | None = None,
) -> IndentationRecord:
    """Read an indentation test from a table.

    Parameters
    ----------
    path : str or path
        A table, text or workbook, with the columns ``time``, ``load`` and ``indentation``, and optionally
        ``temperature``, whose mean is taken; it may range over 3 K.  Units stand in the headings, such as ``load (N)``.
    control : {"load", "indentation"}
        What was prescribed; the other one is the response.
    temperature : float, str or pint.Quantity, optional
        K if a plain number, for a table without this column.
    error : float, str or pint.Quantity, optional
        Standard error of the response, m or N if a plain number.
    start : float, str or pint.Quantity, optional
        Time of the first contact, s; that of the first row if left out.
    columns : mapping, optional
        Headings that are not recognised, by quantity: ``{"load": "Fz (N)"}``.
    sheet : str, optional
        The only sheet of a workbook to read.

    Returns
    -------
    IndentationRecord

    Raises
    ------
    DataFileError
        If the file cannot be read, a column or its unit is missing or wrong, or a row cannot be part of a record; with
        the line of the file.
    InputError
        If the temperature is given twice or not at all, or an argument cannot be used.

    Examples
    --------
    >>> from pathlib import Path
    >>> import viscofric as vf
    >>> with Path("creep.csv").open("w") as file:
    ...     for row in ("time (s),load (N),indentation (um)", "1,1,100", "2,1,105", "4,1,110", "8,1,114", "16,1,117"):
    ...         print(row, file=file)
    >>> vf.friction.read_indentation("creep.csv", control="load", temperature="23 degC", start=0.0)
    IndentationRecord
      time         5 from 1 to 16 s
      load         5 of 1 N
      indentation  5 from 100 to 117 µm
      prescribed   load
      temperature  23 °C
      source       creep.csv
    """
    check_choice(control, "control", *RESPONSE)
    kelvin = None if temperature is None else positive(temperature, "K", "temperature")
    spread = None if error is None else positive(error, CONTROLS[RESPONSE[control]], "error")
    begin = None if start is None else to_si(start, "s", "start")
    found = history_columns(path, columns, sheet, _TESTS)
    missing = [name for name in ("load", "indentation") if name not in found.values]
    if missing:
        problem = f"there is no column of the {' and the '.join(missing)}; an indentation test has both"
        raise DataFileError(path, problem, code="missing-columns", remedy=name_columns(_TESTS.key, missing))
    if found.load_unit != "N":
        raise DataFileError(path, f"load: is in {found.load_unit}, but must be in N.", code="wrong-unit")
    column = found.values.get("temperature")
    _insist_on_one_temperature(path, kelvin, column)
    if column is not None and np.ptp(column) > WIDEST_TEMPERATURE:
        span = " to ".join(shown_celsius(float(one)) for one in (column.min(), column.max()))
        problem = f"temperature ranges from {span} °C within the test; give the rows of one temperature."
        raise DataFileError(path, problem, code="several-temperatures")
    at = float(kelvin or 0.0) if column is None else float(np.mean(column))
    try:
        return IndentationRecord(
            found.values["time"], found.values["load"], found.values["indentation"], at,
            control=control, error=spread, start=begin, source=str(path),
        )  # fmt: skip
    except InputError as wrong:
        place = wrong.note.values.get("index")
        raise DataFileError(path, wrong.note, None if place is None else found.lines[place]) from None


def read_rebound(
    path: str | PathLike[str],
    *,
    mass: Quantity,
    error: float | Mapping[str, float],
    temperature: Quantity | None = None,
    gravity: Quantity = 0.0,
    columns: Mapping[str, str] | None = None,
    sheet: str | None = None,
) -> list[ReboundRecord]:
    """Read rebounds of an indenter from a table.

    Parameters
    ----------
    path : str or path
        A table, text or workbook, with the column ``speed``, one or more of ``restitution``, ``contact time``, ``peak
        force`` and ``indentation``, and optionally ``temperature``.  Units stand in the headings, such as
        ``speed (m/s)``.
    mass : float, str or pint.Quantity
        Of the indenter, kg if a plain number.
    error : float or mapping
        Relative standard error, as of `ReboundRecord`.
    temperature : float, str or pint.Quantity, optional
        K if a plain number, for a table without this column.
    gravity : float, str or pint.Quantity
        Acceleration towards the material, m/s².
    columns : mapping, optional
        Headings that are not recognised, by quantity: ``{"speed": "v_in (m/s)"}``.
    sheet : str, optional
        The only sheet of a workbook to read.

    Returns
    -------
    list of ReboundRecord
        One for each temperature; temperatures within 1 K are one.

    Raises
    ------
    DataFileError
        If the file cannot be read, or a column or its unit is missing or wrong.
    InputError
        If the temperature is given twice or not at all, or an argument cannot be used.

    Examples
    --------
    >>> from pathlib import Path
    >>> import viscofric as vf
    >>> with Path("rebound.csv").open("w") as file:
    ...     for row in ("speed (m/s),restitution (1),contact time (ms)", "1,0.62,2.1", "2,0.58,1.9"):
    ...         print(row, file=file)
    >>> vf.friction.read_rebound("rebound.csv", mass="33 g", error=0.01, temperature="23 degC")[0]
    ReboundRecord
      speed         2 from 1 to 2 m/s
      restitution   2 from 0.58 to 0.62
      contact time  2 from 1.9 to 2.1 ms
      mass          0.033 kg
      temperature   23 °C
      source        rebound.csv
    """

    def make(kelvin: float, values: dict[str, Array]) -> ReboundRecord:
        return ReboundRecord(**values, temperature=kelvin, mass=mass, gravity=gravity, error=error, source=str(path))

    return _read(path, _REBOUNDS, _REBOUND, columns, sheet, temperature, make)


def read_oscillation(
    path: str | PathLike[str],
    *,
    indentation: Quantity,
    amplitude: Quantity,
    error: float | Mapping[str, float],
    temperature: Quantity | None = None,
    columns: Mapping[str, str] | None = None,
    sheet: str | None = None,
) -> list[OscillationRecord]:
    """Read the stiffness of small oscillations of an indenter from a table.

    Parameters
    ----------
    path : str or path
        A table, text or workbook, with the columns ``frequency``, ``storage stiffness`` and ``loss stiffness``, and
        optionally ``temperature``.  Units stand in the headings, such as ``frequency (Hz)``.
    indentation, amplitude : float, str or pint.Quantity
        Mean depth and amplitude, m if plain numbers.
    error : float or mapping
        Relative standard error, as of `OscillationRecord`.
    temperature : float, str or pint.Quantity, optional
        K if a plain number, for a table without this column.
    columns : mapping, optional
        Headings that are not recognised, by quantity.
    sheet : str, optional
        The only sheet of a workbook to read.

    Returns
    -------
    list of OscillationRecord
        One for each temperature; temperatures within 1 K are one.

    Raises
    ------
    DataFileError
        If the file cannot be read, or a column or its unit is missing or wrong.
    InputError
        If the temperature is given twice or not at all, or an argument cannot be used.

    Examples
    --------
    >>> from pathlib import Path
    >>> import viscofric as vf
    >>> with Path("dma.csv").open("w") as file:
    ...     for row in ("frequency (Hz),storage stiffness (N/m),loss stiffness (N/m)", "1,9e3,1e3", "10,1e4,2e3"):
    ...         print(row, file=file)
    >>> vf.friction.read_oscillation(
    ...     "dma.csv", indentation="100 um", amplitude="3 um", error=0.01, temperature="23 degC"
    ... )[0]
    OscillationRecord
      angular frequency  2 from 6.283 to 62.83 rad/s
      storage stiffness  2 from 9 to 10 kN/m
      loss stiffness     2 from 1 to 2 kN/m
      indentation        100 µm
      amplitude          3 µm
      temperature        23 °C
      source             dma.csv
    """

    def make(kelvin: float, values: dict[str, Array]) -> OscillationRecord:
        omega = 2.0 * np.pi * values.pop("frequency")
        return OscillationRecord(
            omega, **values, temperature=kelvin, indentation=indentation, amplitude=amplitude, error=error,
            source=str(path),
        )  # fmt: skip

    return _read(path, _OSCILLATIONS, _OSCILLATION, columns, sheet, temperature, make)


def _read(
    path: str | PathLike[str],
    vocabulary: Vocabulary,
    quantities: Mapping[str, tuple[str, frozenset[str]]],
    columns: Mapping[str, str] | None,
    sheet: str | None,
    temperature: Quantity | None,
    make: Callable[[float, dict[str, Array]], Any],
) -> list[Any]:
    """Return a record for each temperature of a table."""
    given = None if temperature is None else positive(temperature, "K", "temperature")
    table = table_of(path, vocabulary, columns, sheet)
    insist_on_columns(table, vocabulary)
    places = {name: place for name in quantities if (place := table.place(name.replace("_", " "))) is not None}
    values = {name: _values(table, place, quantities[name][0]) for name, place in places.items()}
    kelvin = values.pop("temperature", None)
    _insist_on_one_temperature(path, given, kelvin)
    try:
        if kelvin is None:
            return [make(float(given or 0.0), dict(values))]
        labels = numbered(kelvin, np.full(len(kelvin), SAME_TEMPERATURE))
        rows = [labels == label for label in range(int(labels.max()) + 1)]
        return [make(float(kelvin[row].mean()), {name: one[row] for name, one in values.items()}) for row in rows]
    except InputError as wrong:
        if wrong.field not in {*values, "angular_frequency"}:  # which is made of the frequency
            raise
        raise DataFileError(path, wrong.note) from None


def _insist_on_one_temperature(path: object, given: float | None, column: Array | None) -> None:
    if (given is None) == (column is None):
        why = "has no column of it" if given is None else "has a column of it"
        raise InputError(f"temperature: {path} {why}; give the value or the column, one of the two.", code="give-one")


def _values(table: Table, place: int, unit: str) -> Array:
    """Return a column in SI units; one without a unit has numbers, or per cent."""
    if unit == "dimensionless":
        return table.numbers(place) * (0.01 if table.columns[place].unit == "%" else 1.0)
    return table.values(place, unit)
