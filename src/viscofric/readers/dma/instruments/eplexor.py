"""Netzsch (Gabo) Eplexor workbooks, .xls or .xlsx: sweeps as measured, and master curves split into isotherms.

Sheet 'Exported Data' holds names, units and rows; 'Data header' the programme; 'Shiftlist', in a master curve,
the shifts that `eplexor_master` undoes.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.errors import DataFileError, InputError
from viscofric.notes import Note
from viscofric.readers.dma.checks import insist_on_agreement
from viscofric.readers.dma.instruments.eplexor_master import (
    AS_IT_IS,
    insist_on_sense,
    isotherm_of_each_row,
    programmed_frequencies,
    shift_list,
)
from viscofric.readers.dma.readings import Readings
from viscofric.readers.source import LARGEST_FACTOR, decimal_comma, unit_conversion
from viscofric.readers.workbook import sheet_names, sheets
from viscofric.units import shown_celsius

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.arrays import Array, Indices, Mask
    from viscofric.data import Deformation
    from viscofric.readers.dma.instruments.eplexor_master import ShiftList
    from viscofric.readers.source import Source

    Rows = Sequence[Sequence[Any]]

NAME = "Netzsch Eplexor workbook"
DATA = "Exported Data"

_MISSING = ("", "---")
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
    sheet = _Sheet(source.path, tables[DATA])
    if {"E'", "G'"} <= set(sheet.names):
        raise DataFileError(
            source.path,
            f"sheet {DATA!r} names E' and G'; keep the columns of one of them.",
            code="deformation-contradicts",
        )
    deformation: Deformation = "tension" if "E'" in sheet.names else "shear"
    letter = "E" if deformation == "tension" else "G"
    needed = {name: sheet.column(name) for name in ("f", "T", f"{letter}'", f"{letter}''")}
    complete = np.all([np.isfinite(column) for column in needed.values()], axis=0)
    notes = _passed_over(sheet, complete)
    if not complete.any():
        raise DataFileError(
            source.path, f"sheet {DATA!r} has no row with all of {', '.join(needed)}.", code="no-points"
        )
    kept = np.flatnonzero(complete)
    frequency = sheet.in_unit("f", "Hz")[kept]
    temperature = sheet.in_unit("T", "K")[kept]
    time = sheet.column("Time")[kept] if "Time" in sheet.names else None
    step = None
    shifts = shift_list(tables, source.path)
    programmed = programmed_frequencies(tables)
    if _is_master(temperature, frequency, shifts, programmed):
        places = [sheet.places[row] for row in kept]
        step = _isotherms(source.path, places, frequency, time, shifts, programmed, temperature)
        assert shifts is not None  # else `_isotherms` refused
        insist_on_sense(shifts, float(temperature[0]), source.path)
        order = np.argsort(shifts.temperatures[step], kind="stable")
        kept, step = kept[order], step[order]
        frequency = frequency[order] / 10.0 ** shifts.log10_shifts[step]
        temperature = shifts.temperatures[step]
        notes += _taken_apart(shifts, step)
    storage, loss = (sheet.in_unit(f"{letter}{prime}", "Pa")[kept] for prime in ("'", "''"))
    tangent = sheet.column("tan delta")[kept] if "tan delta" in sheet.names else None
    absolute = sheet.in_unit(f"|{letter}*|", "Pa")[kept] if f"|{letter}*|" in sheet.names else None
    insist_on_agreement(source.path, storage, loss, tangent, absolute)
    amplitude = None
    if "Strain dyn" in sheet.names and sheet.unit("Strain dyn") == "%":
        amplitude = 0.01 * sheet.column("Strain dyn")[kept]
        notes.append(_AMPLITUDE_NOTE)
    return Readings(
        source.path,
        NAME + (", master curve" if step is not None else ""),
        tuple(sheet.places[row] for row in kept),
        temperature,
        2.0 * math.pi * frequency,
        storage,
        loss,
        deformation,
        f"the heading {letter}' ({sheet.unit(letter + chr(39))})",
        amplitude,
        None if step is None else step.astype(np.int64),
        tuple(notes),
    )


def _names(rows: Rows) -> list[str]:
    return [str(cell).strip() for cell in rows[0]] if len(rows) else []


class _Sheet:
    """Sheet 'Exported Data': a row of names, a row of units, rows of numbers."""

    def __init__(self, path: str, rows: Rows) -> None:
        self.path, self.names = path, _names(rows)
        units = [str(cell).strip() for cell in rows[1]] if len(rows) > 1 else []
        self.units = units + [""] * (len(self.names) - len(units))
        body = [(place, row) for place, row in enumerate(rows[2:], start=3) if any(cell != "" for cell in row)]
        self.places = [f"sheet {DATA!r}, row {place}" for place, _ in body]
        self.rows = [row for _, row in body]
        texts = ((cell, place) for place, row in body for cell in row if isinstance(cell, str))
        decimal_comma(f"{path}, sheet {DATA!r}", texts)

    def _index(self, name: str) -> int:
        if name not in self.names:
            raise DataFileError(self.path, f"sheet {DATA!r} has no column {name!r}.", code="missing-columns")
        return self.names.index(name)

    def unit(self, name: str) -> str:
        return self.units[self._index(name)]

    def column(self, name: str) -> Array:
        """Return the numbers of a column as printed, NaN where they are missing."""
        index = self._index(name)
        return np.array([self._number(row, index, place) for row, place in zip(self.rows, self.places, strict=True)])

    def _number(self, row: Sequence[Any], index: int, place: str) -> float:
        cell = row[index] if index < len(row) else ""
        text = str(cell).strip()
        if text in _MISSING:
            return math.nan
        try:
            value = float(text.replace(",", "."))
        except ValueError:
            value = math.nan
        if isinstance(cell, bool) or "_" in text or not math.isfinite(value * LARGEST_FACTOR):
            raise DataFileError(
                self.path,
                f"{place}: {text!r} in column {self.names[index]!r} is not a finite number.",
                code="not-a-number",
            )
        return value

    def in_unit(self, name: str, unit: str) -> Array:
        try:
            factor, offset = unit_conversion(self.unit(name), unit, name)
        except InputError:
            example = {"K": "°C", "Pa": "MPa"}.get(unit, unit)
            problem = (
                f"column {name!r} of sheet {DATA!r} has the unit {self.unit(name)!r}; it must be like {example!r}."
            )
            raise DataFileError(self.path, problem, code="wrong-unit") from None
        values = factor * self.column(name) + offset
        if unit in ("K", "Hz") and np.any(values <= 0.0):
            row = int(np.argmax(values <= 0.0))
            bound = "absolute zero" if unit == "K" else "zero"
            problem = f"{self.places[row]}: column {name!r} must be above {bound}."
            raise DataFileError(self.path, problem, code="not-positive")
        return np.asarray(values)


def _passed_over(sheet: _Sheet, complete: Mask) -> list[Note]:
    missing = [place.rsplit(", ", 1)[1] for place, kept in zip(sheet.places, complete, strict=True) if not kept]
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
