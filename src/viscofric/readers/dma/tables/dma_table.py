"""Points of frequency sweeps out of a table with units: temperature, strain amplitude and step beside the moduli."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import DataFileError
from viscofric.notes import Note, Remedy, setting
from viscofric.readers.dma.names import STEP, quantity, temperature_in_name
from viscofric.readers.dma.plausibility import doubts
from viscofric.readers.dma.readings import AS_MASTER_CURVE, Readings
from viscofric.readers.dma.tables.dma_columns import (
    angular_frequency,
    deformation,
    find_columns,
    insist_on_one_frequency,
    is_reduced,
    moduli,
    unit_is_asked,
)
from viscofric.readers.printed import STRAIN_FACTORS

if TYPE_CHECKING:
    from viscofric.arrays import Array, Integers
    from viscofric.readers.source import Source
    from viscofric.readers.table import Column, Table


#: No sweep of an instrument spans as many decades of frequency as master curves do.
WIDEST_SWEEP = 7.0  # decades


def read_points(table: Table, source: Source, format: str, name: str, where: str = "line") -> Readings:  # noqa: A002
    """Return the points of one table.

    Parameters
    ----------
    table : Table
        With temperature, frequency, storage and loss modulus; one modulus or both may be given by tan δ and the
        absolute value |E*|.
    source : Source
        The file, with what the user said of it.
    format : str
        What it was taken for.
    name : str
        Of the file or sheet, without folder and ending: it may tell a temperature that no column holds.
    where : str
        What the numbers of rows count: lines or rows.

    Raises
    ------
    DataFileError
        If a column or unit is missing or wrong, a cell is not a number, frequencies contradict each other, or the
        moduli are called tensile and shear at once.
    """
    places = find_columns(table)
    if is_reduced(table, places):
        problem = f"column {table.columns[places['frequency']].heading!r} holds reduced frequencies: a master curve"
        raise DataFileError(table.path, problem, code="master-curve", remedy=AS_MASTER_CURVE)
    notes: list[str] = []
    frequency = angular_frequency(table, places, notes)
    insist_on_one_frequency(table, places, frequency)
    storage, loss = moduli(table, places, source, notes)
    temperature = _temperature(table, places, source, name, frequency, notes)
    _insist_on_most(table, places, "frequency", frequency)
    _insist_on_most(table, places, "storage modulus", storage)
    kind, said_by = deformation(table, places)
    amplitude = _strain_amplitude(table, notes)
    _note_numbered(table, notes)
    return Readings(
        source=source.path,
        format=format,
        places=tuple(f"{where} {number}" for number in table.lines),
        temperature=temperature,
        angular_frequency=frequency,
        storage_modulus=storage,
        loss_modulus=loss,
        deformation=kind,
        said_by=said_by,
        strain_amplitude=amplitude,
        step=_step(table),
        unit_is_asked=unit_is_asked(table, places, source),
        notes=(*notes, *doubts(table, places, temperature, storage)),
    )


def _temperature(
    table: Table, places: dict[str, int], source: Source, name: str, angular: Array, notes: list[str]
) -> Array:
    """Return K: from the column, else as the user gave it, else as the file's name tells it, with a note."""
    if "temperature" in places:
        if source.temperature is not None:
            heading = table.columns[places["temperature"]].heading
            problem = f"column {heading!r} holds the temperatures; leave out temperature for this file."
            raise DataFileError(table.path, problem)
        factor, offset = table.conversion(table.columns[places["temperature"]], "K")
        kelvin = factor * table.numbers_or_missing(places["temperature"]) + offset
        cold = np.flatnonzero(kelvin <= 0.0)
        if cold.size:
            row, place = int(cold[0]), places["temperature"]
            problem = f"{_cell(table, row, place)} in column {table.columns[place].heading!r} must be above "
            raise DataFileError(table.path, problem + "absolute zero.", int(table.lines[row]))
        return kelvin
    if source.temperature is not None:
        notes.append(Note("temperature-given", "No column holds a temperature; it was given by the user."))
        return np.full(len(angular), source.temperature)
    told, named = temperature_in_name(name), "file's" if name == source.stem else "sheet's"
    swept = angular[angular > 0.0]
    decades = math.log10(np.max(swept) / np.min(swept)) if swept.size else 0.0
    if told is None or decades > WIDEST_SWEEP:
        raise _no_temperature(table, decades)
    notes.append(Note("temperature-from-name", f"No column holds a temperature; it was taken from the {named} name."))
    return np.full(len(angular), told)


def _no_temperature(table: Table, decades: float) -> DataFileError:
    if decades > WIDEST_SWEEP:
        return DataFileError(
            table.path,
            f"no column for temperature, and {decades:.0f} decades of frequency: this looks like a master curve",
            code="master-curve",
            remedy=AS_MASTER_CURVE,
        )
    return DataFileError(
        table.path,
        f"no column for temperature, this table has {table.headings()}; for a sweep at one temperature give ",
        code="no-temperature",
        remedy=setting("material.temperature", "Temperature of the sweep", "'25 degC'")
        + Remedy(
            ", and a master curve is read by read_master_curve.",
            run_file=", and a master curve is named as master_curve.",
            page=".",
        ),
    )


def _cell(table: Table, row: int, place: int) -> str:
    return table.rows[row][place].strip()


def _insist_on_most(table: Table, places: dict[str, int], what: str, values: Array) -> None:
    """Refuse a column of which most is missing or not above zero; single points are left out later, with a note."""
    place = places.get(what)
    bad = np.flatnonzero(~(values > 0.0))
    if place is None or 2 * len(bad) <= len(values):
        return
    table.numbers(place)  # tells the first cell that is empty or no number
    row = int(bad[0])
    problem = f"{_cell(table, row, place)} in column {table.columns[place].heading!r} must be above zero."
    raise DataFileError(table.path, problem, int(table.lines[row]))


def _note_numbered(table: Table, notes: list[str]) -> None:
    """Name the columns that differ from those of a sweep by a number only and are not read."""
    numbered = [repr(column.heading) for column in table.columns if _is_numbered(column)]
    if numbered:
        text = f"Numbered columns that are not read: {', '.join(numbered)}; give each sweep a table of its own."
        notes.append(Note("unused-columns", text))


def _is_numbered(column: Column) -> bool:
    return not quantity(column.name) and bool(column.unnumbered and quantity(column.unnumbered))


def _strain_amplitude(table: Table, notes: list[str]) -> Array | None:
    """Return fractions, None where no one column tells them with a unit that is understood."""
    found = [p for p, column in enumerate(table.columns) if quantity(column.name) == "strain amplitude"]
    if len(found) > 1:
        several = " and ".join(repr(table.columns[place].heading) for place in found)
        notes.append(
            Note(
                "strain-amplitude-not-read",
                Note("strain-amplitude-not-read", f"The strain amplitudes were not read: {several} may hold them."),
            )
        )
    if len(found) != 1:
        return None
    column = table.columns[found[0]]
    factor = STRAIN_FACTORS.get(column.unit.strip() or "1")
    if factor is None:
        notes.append(
            Note(
                "strain-amplitude-not-read",
                f"The strain amplitudes were not read: column {column.heading!r} has no unit such as '%'.",
            )
        )
        return None
    try:
        values = factor * table.numbers_or_missing(found[0])
    except DataFileError:  # words in a column that is not needed
        return None
    if not column.unit.strip():
        notes.append(
            Note(
                "strain-without-unit",
                f"Column {column.heading!r} has no unit; it was read as a fraction (0.01 is 1 %).",
            )
        )
    return np.where(values >= 0.0, values, np.nan)


def _step(table: Table) -> Integers | None:
    """Return the numbers of steps, None where no one column holds whole numbers for them."""
    found = [p for p, column in enumerate(table.columns) if column.name.lower() in STEP]
    if len(found) != 1:
        return None
    try:
        numbers = table.numbers(found[0])
    except DataFileError:
        return None
    if np.any(numbers != np.round(numbers)) or np.any(np.abs(numbers) > 1e9):
        return None
    return numbers.astype(np.int64)
