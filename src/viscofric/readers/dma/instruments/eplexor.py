"""Netzsch (Gabo) Eplexor workbooks, .xls or .xlsx: sweeps as measured, and master curves split into isotherms.

Sheet 'Exported Data' holds names, units and rows; 'Data header' the programme; 'Shiftlist', in a master curve,
the shifts that `eplexor_master` undoes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from viscofric.arrays import Array, Indices, Mask
from viscofric.errors import DataFileError
from viscofric.notes import Note
from viscofric.readers.dma.instruments.eplexor_master import (
    AS_IT_IS,
    ShiftList,
    insist_on_sense,
    isotherm_of_each_row,
    programmed_frequencies,
    shift_list,
)
from viscofric.readers.dma.names import DMA, quantity
from viscofric.readers.dma.readings import Readings
from viscofric.readers.dma.tables.dma_table import read_export
from viscofric.readers.source import Source
from viscofric.readers.table import Table, instrument_table
from viscofric.readers.tables import numbered_rows
from viscofric.readers.workbook import sheet_names, sheets
from viscofric.units import shown_celsius

Rows = Sequence[Sequence[Any]]


NAME = "Netzsch Eplexor workbook"
DATA = "Exported Data"

#: All rows of a master curve carry one temperature, digit by digit; measured ones scatter.
_SAME_TEMPERATURE = 1e-9  # K
#: Frequency range beyond that of any instrument; a master curve has it.
_WIDEST_SWEEP = 1e6

_AMPLITUDE_NOTE = Note(
    "amplitude-assumed",
    "Strain dyn was read as the strain amplitude (half of peak to peak); the file does not state it.",
)


def recognises(source: Source) -> bool:
    """Return whether this is a workbook with a sheet 'Exported Data' that names f, T and a modulus."""
    if DATA not in sheet_names(source):
        return False
    names = _names(sheets(source)[DATA])
    return "f" in names and "T" in names and ("E'" in names or "G'" in names)


def read(source: Source) -> Readings:
    """Return the points; rows of a master curve are moved back to their measured temperatures and frequencies."""
    tables = sheets(source)
    table = _table(source.path, tables[DATA])
    whole = read_export([table], source, NAME, "", f"sheet {DATA!r}, row")
    notes = [*_passed_over(table, whole.complete), *whole.notes]
    if not whole.complete.any():
        problem = f"sheet {DATA!r} has no row with all of temperature, frequency and both moduli."
        raise DataFileError(source.path, problem, code="no-points")
    kept = np.flatnonzero(whole.complete)
    points = whole.taken(kept)
    if points.strain_amplitude is not None:
        notes.append(_AMPLITUDE_NOTE)
    frequency = points.angular_frequency / (2.0 * math.pi)
    shifts = shift_list(tables, source.path)
    programmed = programmed_frequencies(tables)
    if _is_master(points.temperature, frequency, shifts, programmed):
        clock = next((place for place, column in enumerate(table.columns) if column.name == "Time"), None)
        time = None if clock is None else table.numbers_or_missing(clock)[kept]
        step = _isotherms(source.path, points.places, frequency, time, shifts, programmed, points.temperature)
        assert shifts is not None  # else `_isotherms` refused
        insist_on_sense(shifts, float(points.temperature[0]), source.path)
        points = replace(
            points,
            format=f"{NAME}, master curve",
            temperature=shifts.temperatures[step],
            angular_frequency=points.angular_frequency / 10.0 ** shifts.log10_shifts[step],
            step=step.astype(np.int64),
        ).taken(np.argsort(shifts.temperatures[step], kind="stable"))
        notes += _taken_apart(shifts, step)
    return replace(points, notes=tuple(notes))


def _names(rows: Rows) -> list[str]:
    return [str(cell).strip() for cell in rows[0]] if len(rows) else []


def _table(path: str, rows: Rows) -> Table:
    """Return sheet 'Exported Data': a row of names, a row of units, rows of numbers."""
    names = _names(rows)
    if {"E'", "G'"} <= set(names):
        raise DataFileError(
            path, f"sheet {DATA!r} names E' and G'; keep the columns of one of them.", code="deformation-contradicts"
        )
    letter = "E" if "E'" in names else "G"
    known = {"f", "T", f"{letter}'", f"{letter}''", f"|{letter}*|", "tan delta", "Strain dyn"}
    units = [str(cell).strip() for cell in rows[1]] if len(rows) > 1 else []
    columns = [
        (name, unit, quantity(name) or "" if name in known and place == names.index(name) else "")
        for place, (name, unit) in enumerate(zip(names, [*units, *[""] * len(names)], strict=False))
    ]
    shown = f"{path}, sheet {DATA!r}"
    body = [(number, cells[: len(names)]) for number, cells in numbered_rows(shown, rows) if number > 2]
    return instrument_table(shown, columns, body, DMA)


def _passed_over(table: Table, complete: Mask) -> list[Note]:
    missing = [f"row {line}" for line, kept in zip(table.lines, complete, strict=True) if not kept]
    if not missing:
        return []
    shown = ", ".join(missing[:3]) + (f" and {len(missing) - 3} more" if len(missing) > 3 else "")
    return [
        Note("points-left-out", f"Left out, without a temperature, frequency or modulus, in sheet {DATA!r}: {shown}.")
    ]


def _is_master(temperature: Array, frequency: Array, shifts: ShiftList | None, programmed: Array | None) -> bool:
    """Return whether all rows have one temperature, and their frequencies exceed a sweep."""
    if np.ptp(temperature) > _SAME_TEMPERATURE:
        return False
    if shifts is not None:
        return True
    if programmed is None:
        return bool(frequency.max() > _WIDEST_SWEEP * frequency.min())
    return bool(frequency.min() < 0.99 * programmed[0] or frequency.max() > 1.01 * programmed[-1])


def _isotherms(
    path: str,
    places: Sequence[str],
    frequency: Array,
    time: Array | None,
    shifts: ShiftList | None,
    programmed: Array | None,
    temperature: Array,
) -> Indices:
    lacking = "sheet 'Shiftlist'" if shifts is None else "range of frequencies in sheet 'Data header'"
    if shifts is None or programmed is None:
        raise DataFileError(
            path,
            f"is a master curve at {shown_celsius(float(temperature[0]))} °C without the {lacking}, which is needed to "
            f"split it into isotherms; {AS_IT_IS}.",
            code="master-curve-inseparable",
        )
    usable = time if time is not None and np.all(np.isfinite(time)) else None
    return isotherm_of_each_row(frequency, usable, shifts.log10_shifts, programmed, path, places)


def _taken_apart(shifts: ShiftList, step: Indices) -> list[Note]:
    found = np.unique(step)
    still = shifts.measured_reference
    at = "" if still is None else f" at {shown_celsius(still)} °C"
    apart = f"they were split into {found.size} isotherms by the sheet 'Shiftlist' (measured f = f / 10^shift)"
    notes = [Note("master-curve-taken-apart", f"The rows are a master curve{at}; {apart}.")]
    absent = np.sort(np.delete(shifts.temperatures, found))
    if absent.size:
        listed = ", ".join(map(shown_celsius, absent))
        said = f"The sheet 'Shiftlist' also names {listed} °C, for which the workbook has no rows."
        notes.append(Note("temperatures-without-rows", said))
    return notes
