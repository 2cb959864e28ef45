"""Rebounds and oscillations read from tables: one record for each temperature."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.errors import DataFileError, InputError
from viscofric.friction.identification.indentation.tables import OscillationRecord, ReboundRecord
from viscofric.nominal import SAME_TEMPERATURE, numbered
from viscofric.readers.dma.names import TEMPERATURE
from viscofric.readers.headings import Vocabulary
from viscofric.readers.one_table import table_of
from viscofric.units import positive

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from os import PathLike

    from viscofric.arrays import Array
    from viscofric.readers.table import Table
    from viscofric.units import Quantity

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


def _vocabulary(kind: str, columns: Mapping[str, tuple[str, frozenset[str]]], *needed: str) -> Vocabulary:
    return Vocabulary(
        kind,
        {name: names for name, (_, names) in columns.items()},
        needed=tuple((name,) for name in needed),
        example=", ".join(repr(f"{name.replace('_', ' ')} ({unit})") for name, (unit, _) in columns.items()),
        key="indentation.columns",
        offered=tuple((name, unit) for name, (unit, _) in columns.items()),
    )


_REBOUNDS = _vocabulary("a table of rebounds", _REBOUND, "speed")
_OSCILLATIONS = _vocabulary(
    "a table of stiffness over frequency", _OSCILLATION, "frequency", "storage_stiffness", "loss_stiffness"
)


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
    places = {name: place for name in quantities if (place := table.place(name)) is not None}
    missing = [name for (name,) in vocabulary.needed if name not in places]
    if missing:
        problem = f"there is no column of the {' and the '.join(missing)}; there are {table.headings()}"
        raise DataFileError(path, problem, code="missing-columns")
    values = {name: _values(table, place, quantities[name][0]) for name, place in places.items()}
    kelvin = values.pop("temperature", None)
    if (given is None) == (kelvin is None):
        why = "has no column of it" if given is None else "has a column of it"
        raise InputError(f"temperature: {path} {why}; give the value or the column, one of the two.", code="give-one")
    if kelvin is None:
        return [make(float(given or 0.0), values)]
    labels = numbered(kelvin, np.full(len(kelvin), SAME_TEMPERATURE))
    rows = [labels == label for label in range(int(labels.max()) + 1)]
    return [make(float(kelvin[row].mean()), {name: one[row] for name, one in values.items()}) for row in rows]


def _values(table: Table, place: int, unit: str) -> Array:
    """Return a column in SI units; one without a unit has numbers, or per cent."""
    if unit == "dimensionless":
        return table.numbers(place) * (0.01 if table.columns[place].unit == "%" else 1.0)
    return table.values(place, unit)
