"""Traction runs of a mini-traction machine from delimited text tables with one reading per row."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from viscofric.data import TractionRuns
from viscofric.errors import DataFileError, InputError
from viscofric.nominal import SAME_LOAD, SAME_SPEED, SAME_TEMPERATURE, numbered
from viscofric.readers.table import Table, read_table

if TYPE_CHECKING:
    from os import PathLike

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

#: What a table must hold: names that are understood, and the SI unit.
COLUMNS = {
    "disc speed": (frozenset({"disc speed", "disk speed", "u disc", "u disk"}), "m/s"),
    "ball speed": (frozenset({"ball speed", "u ball"}), "m/s"),
    "traction force": (frozenset({"traction force", "traction"}), "N"),
    "load": (frozenset({"load", "ball load", "normal load", "normal force"}), "N"),
    "temperature": (frozenset({"T", "temp", "temp.", "temperature"}), "K"),
}
REPLICATE = frozenset({"replicate", "repetition", "repeat"})

LARGEST_REPLICATE = 1e9


def read_mtm(*paths: str | PathLike[str]) -> TractionRuns:
    """Read signed traction measurements from one or several tables.

    Parameters
    ----------
    *paths : str or path
        Text tables with the columns disc speed, ball speed, temperature, load and traction force, each with
        its unit, and optionally replicate (a whole number).  Speeds are signed: see `TractionRuns`.

    Returns
    -------
    TractionRuns
        All rows, file after file, in SI units.  Without a replicate column the readings of equal nominal
        temperature, load, disc and ball speed are numbered 1, 2, … in the order of the rows, with a note.

    Raises
    ------
    DataFileError
        If a file cannot be read or is given twice, a column or unit is missing or wrong, a cell is not a
        finite number, or a load is not above zero.
    InputError
        If no file is given.
    """
    if not paths:
        raise InputError("read_mtm needs at least one file.")
    tables = [read_table(path) for path in paths]
    _insist_on_different(tables)
    values: dict[str, list[Array]] = {name: [] for name in COLUMNS}
    replicates: list[NDArray[np.int64] | None] = []
    for table in tables:
        places = _columns(table)
        for name, (_, unit) in COLUMNS.items():
            values[name].append(table.values(places[name], unit))
        _insist_on_sense(table, places, values["load"][-1], values["temperature"][-1])
        replicates.append(_replicate(table))
    columns = {name: np.concatenate(parts) for name, parts in values.items()}
    replicate, notes = _all_replicates(tables, replicates, columns)
    return TractionRuns(
        disc_speed=columns["disc speed"],
        ball_speed=columns["ball speed"],
        traction_force=columns["traction force"],
        load=columns["load"],
        temperature=columns["temperature"],
        replicate=replicate,
        source=", ".join(table.path for table in tables),
        notes=notes,
    )


def _insist_on_different(tables: list[Table]) -> None:
    """Refuse readings that would count twice and make the scatter look smaller than it is."""
    for place, table in enumerate(tables):
        for other in tables[:place]:
            if Path(table.path).resolve() == Path(other.path).resolve():
                raise DataFileError(table.path, "is given twice; name each file once.")
            if table.columns == other.columns and table.rows == other.rows:
                raise DataFileError(table.path, f"holds the same readings as {other.path}; give one of them only.")


def _columns(table: Table) -> dict[str, int]:
    places = {name: table.find(names, name) for name, (names, _) in COLUMNS.items()}
    missing = [name for name, place in places.items() if place is None]
    if missing:
        if any("loss" in c.name.lower() or "''" in c.name for c in table.columns):
            raise DataFileError(
                table.path,
                "this is a table of DMA sweeps, not of traction runs; use read_dma, or name it as dma under "
                "[material] of a run file.",
            )
        raise DataFileError(
            table.path,
            f"no column for {' or '.join(missing)}; a table of traction runs has e.g. 'temperature (degC)', "
            f"'disc speed (mm/s)', 'ball speed (mm/s)', 'load (N)', 'traction force (N)', "
            f"this one has {table.headings()}.",
        )
    return {name: place for name, place in places.items() if place is not None}


def _insist_on_sense(table: Table, places: dict[str, int], load: Array, temperature: Array) -> None:
    for name, values, limit in (("load", load, "zero"), ("temperature", temperature, "absolute zero")):
        bad = np.flatnonzero(values <= 0.0)
        if bad.size:
            row, place = int(bad[0]), places[name]
            cell, heading = table.rows[row][place].strip(), table.columns[place].heading
            raise DataFileError(
                table.path, f"{cell} in column {heading!r} must be above {limit}.", int(table.lines[row])
            )


def _replicate(table: Table) -> NDArray[np.int64] | None:
    place = table.find(REPLICATE, "replicate")
    if place is None:
        return None
    numbers = table.numbers(place)
    bad = np.flatnonzero((numbers != np.round(numbers)) | (np.abs(numbers) > LARGEST_REPLICATE))
    if bad.size:
        row = int(bad[0])
        cell, heading = table.rows[row][place].strip(), table.columns[place].heading
        problem = f"{cell} in column {heading!r} must be a whole number, at most {LARGEST_REPLICATE:.0f}."
        raise DataFileError(table.path, problem, int(table.lines[row]))
    return numbers.astype(np.int64)


def _all_replicates(
    tables: list[Table], given: list[NDArray[np.int64] | None], columns: dict[str, Array]
) -> tuple[NDArray[np.int64], tuple[str, ...]]:
    """Take the files' replicate numbers, or number equal conditions in the order of the rows."""
    known = [numbers for numbers in given if numbers is not None]
    if len(known) == len(given):
        return np.concatenate(known), ()
    if known:
        without = next(table.path for table, numbers in zip(tables, given, strict=True) if numbers is None)
        raise DataFileError(without, "has no replicate column, but another file of the same call has one.")
    seen: Counter[tuple[int, ...]] = Counter()
    numbers = []
    temperature = columns["temperature"]
    nominal = [numbered(temperature, np.full(temperature.shape, SAME_TEMPERATURE))]
    for name, same in (("load", SAME_LOAD), ("disc speed", SAME_SPEED), ("ball speed", SAME_SPEED)):
        nominal.append(numbered(columns[name], same * np.abs(columns[name])))
    for condition in np.stack(nominal, axis=1):
        key = tuple(int(value) for value in condition)
        seen[key] += 1
        numbers.append(seen[key])
    note = "There is no replicate column; readings of equal speeds, load and temperature are numbered in their order."
    return np.array(numbers, dtype=np.int64), (note,)
