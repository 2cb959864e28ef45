"""Netzsch (Gabo) Eplexor workbooks, .xls or .xlsx: sweeps as measured, and master curves split into isotherms.

Sheet 'Exported Data' holds names, units and rows; 'Data header' the programme; 'Shiftlist', in a master curve, the
shifts.  The software joins isotherms by hand or by fit, multiplies every frequency by ``10**shift``, puts the
temperature of the isotherm without shift into all rows and sorts them by frequency.  Moduli stay as measured.  The sign
is that of α: above zero below the reference temperature.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from viscofric.arrays import Array, Indices, Mask
from viscofric.errors import DataFileError
from viscofric.notes import Note
from viscofric.readers.dma.names import DMA
from viscofric.readers.dma.readings import Readings
from viscofric.readers.dma.tables.dma_table import read_export
from viscofric.readers.headings import heading
from viscofric.readers.source import Source, converted, unit_conversion
from viscofric.readers.table import Table, instrument_table
from viscofric.readers.tables import numbered_rows
from viscofric.readers.workbook import sheet_names, sheets
from viscofric.showing import several
from viscofric.units import CELSIUS_ZERO, shown_celsius

Rows = Sequence[Sequence[Any]]

SHIFT_LIST = "Shiftlist"

#: The rows of a master curve carry the measured temperature of the isotherm without shift, digit by digit.
SAME_TEMPERATURE = 0.5  # K
#: Beyond this α is no number that a computer holds.
LARGEST_SHIFT = 300.0  # decades

#: What to do with a master curve that cannot be split.
AS_IT_IS = "save its columns of f and the moduli as CSV and read that with read_master_curve"

_NUMBER = r"([+-]?\d+(?:[.,]\d+)?(?:[eE][+-]?\d+)?)"
_TEMPERATURE = re.compile(_NUMBER + r"\s*(°\s*C|C|K|°\s*F|F)", re.IGNORECASE)
_C1 = re.compile(r"C1\s*:?\s*" + _NUMBER)
_C2 = re.compile(r"C2\s*:?\s*" + _NUMBER + r"\s*K?")


@dataclass(frozen=True, eq=False)
class ShiftList:
    """The sheet 'Shiftlist': isotherms in its order, and the software's own reference and WLF constants."""

    temperatures: Array  # K
    log10_shifts: Array
    reference: float | None  # as programmed, such as 25.0 °C, K
    wlf: tuple[float, float] | None  # C1 and C2 (K)

    @property
    def measured_reference(self) -> float | None:
        """Measured temperature of the isotherm that was not shifted, K, or None if every one was."""
        still = np.flatnonzero(self.log10_shifts == 0.0)
        return float(self.temperatures[still[0]]) if still.size == 1 else None


def shift_list(tables: Mapping[str, Rows], path: str) -> ShiftList | None:
    """Return the shift list of a workbook, None without one; a sheet without temperatures and shifts is an error."""
    rows = tables.get(SHIFT_LIST)
    if rows is None:
        return None
    reference, wlf, numbers = None, None, []
    factor, offset = 1.0, CELSIUS_ZERO
    in_table = False
    for place, row in enumerate(rows, start=1):
        label = str(row[0]).strip() if row else ""
        words = " ".join(str(cell) for cell in row[1:])
        if label.startswith("Ref"):
            reference = _kelvin(words)
        elif label.startswith("WLF"):
            wlf = _constants(words)
        elif label.startswith("Temp"):
            in_table = True
            factor, offset = unit_conversion(heading(label).unit or "degC", "K")
        elif in_table and label:
            temperature, shift = _pair(row, place, path)
            numbers.append((_above_zero(factor * temperature + offset, place, path), shift))
    if len(numbers) < 2:
        problem = f"sheet {SHIFT_LIST!r} must list a temperature and a shift for each of two isotherms or more."
        raise DataFileError(path, problem, code="shift-list")
    temperatures, shifts = np.array(numbers).T
    return ShiftList(temperatures, shifts, reference, wlf)


def _pair(row: Sequence[Any], place: int, path: str) -> tuple[float, float]:
    cells = [cell for cell in row[:2] if isinstance(cell, (int, float)) and math.isfinite(cell)]
    if len(cells) != 2 or abs(cells[1]) > LARGEST_SHIFT:
        raise DataFileError(
            path, f"sheet {SHIFT_LIST!r}, row {place} must hold a temperature and a shift.", code="shift-list"
        )
    return float(cells[0]), float(cells[1])


def _above_zero(kelvin: float, place: int, path: str) -> float:
    if not kelvin > 0.0:
        raise DataFileError(
            path, f"sheet {SHIFT_LIST!r}, row {place}: the temperature is not above absolute zero.", code="not-positive"
        )
    return kelvin


def insist_on_sense(shifts: ShiftList, reference: float, path: str) -> None:
    """Refuse a shift list that contradicts the temperature of the rows, or whose shifts rise with temperature."""
    # In the former case the list has another unit, in the latter hot and cold isotherms would change places.
    still = shifts.measured_reference
    if still is not None and abs(still - reference) > SAME_TEMPERATURE:
        both = f"{shown_celsius(still)} °C, but the rows are at {shown_celsius(reference)} °C"
        problem = f"the isotherm without shift in sheet {SHIFT_LIST!r} is at {both}; is the list in another unit?"
        raise DataFileError(path, problem, code="shift-list-contradicts")
    about = shifts.temperatures - shifts.temperatures.mean()
    if about @ shifts.log10_shifts > 0.0:
        problem = (
            f"the shifts in sheet {SHIFT_LIST!r} rise with temperature; above the reference they must be negative."
        )
        raise DataFileError(path, problem, code="shift-list-contradicts")


def _kelvin(words: str) -> float | None:
    match = _TEMPERATURE.search(words)
    return converted(match[1], match[2], "K") if match else None


def _constants(words: str) -> tuple[float, float] | None:
    first, second = _C1.search(words), _C2.search(words)
    if first is None or second is None:
        return None
    return float(first[1].replace(",", ".")), float(second[1].replace(",", "."))


HEADER = "Data header"

#: Programmed frequencies are printed to six digits; false ones differ by some thousandths of a decade.
SAME_FREQUENCY = 1e-3  # decades
#: A sweep has tens of frequencies, a list tens of temperatures; a damaged file may have any number.
MOST_FREQUENCIES = 1000
MOST_CANDIDATES = 5_000_000


def programmed_frequencies(tables: Mapping[str, Rows]) -> Array | None:
    """Return the frequencies of the sweep, Hz, from the sheet 'Data header', or None."""
    rows = tables.get(HEADER, ())
    for place, row in enumerate(rows):
        titles = [str(cell).strip() for cell in row]
        if "Frequency range:" not in titles or "Frequency increment:" not in titles:
            continue
        values = next((below for below in rows[place + 1 :] if below and str(below[0]).startswith("Values")), ())
        low, per_decade = titles.index("Frequency range:"), titles.index("Frequency increment:")
        try:
            first, last, density = (float(values[place]) for place in (low, low + 1, per_decade))
            steps = density * math.log10(last / first)
        except (IndexError, TypeError, ValueError, ZeroDivisionError):
            return None
        if not (0.0 < steps < MOST_FREQUENCIES and first > 0.0 and density > 0.0):
            return None
        # Ten to a whole number of steps; the printed bounds carry the rounding of single precision.
        inside = first * 10.0 ** (np.arange(np.floor(steps + SAME_FREQUENCY) + 1) / density)
        ends_short = steps - np.floor(steps + SAME_FREQUENCY) > SAME_FREQUENCY
        return np.append(inside, last) if ends_short else inside
    return None


def isotherm_of_each_row(
    frequency: Array, time: Array | None, shifts: Array, programmed: Array, path: str, places: Sequence[str]
) -> Indices:
    """Return the isotherm, a place in `shifts`, of each row of a master curve."""
    # The shift of that isotherm takes the row's frequency, (n,) Hz, back to one of the programme, (k,) Hz, ascending.
    # If two shifts do so (they differ by a whole number of steps), the row belongs to the isotherm of its neighbours in
    # time, s.
    if frequency.size * shifts.size > MOST_CANDIDATES:
        raise DataFileError(
            path, f"{frequency.size} rows and {shifts.size} shifts are more than any sweep has.", code="too-large"
        )
    measured = np.log10(frequency)[:, None] - shifts[None, :]
    grid = np.log10(programmed)
    after = np.clip(np.searchsorted(grid, measured), 1, max(grid.size - 1, 1))
    below = after - 1
    after = np.minimum(after, grid.size - 1)
    place = np.where(np.abs(measured - grid[below]) <= np.abs(measured - grid[after]), below, after)
    fits = np.abs(measured - grid[place]) < SAME_FREQUENCY
    count = fits.sum(axis=1)
    if np.any(count == 0):
        first = int(np.argmin(count))
        problem = (
            f"{places[first]}: no shift of the list takes {frequency[first]:.6g} Hz back to a frequency of the "
            f"programme, so that the master curve cannot be split; {AS_IT_IS}."
        )
        raise DataFileError(path, problem, code="master-curve-inseparable")
    chosen: Indices = np.argmax(fits, axis=1)
    for row in np.flatnonzero(count > 1):
        chosen[row] = _next_in_time(int(row), time, fits[row], chosen, count == 1, path, places)
    _insist_on_one_row_each(chosen, place[np.arange(chosen.size), chosen], fits, path)
    return chosen


def _insist_on_one_row_each(chosen: Indices, place: Indices, fits: Mask, path: str) -> None:
    """Refuse isotherms that lost all their rows to others, or took rows of others."""
    # Both happen if shifts differ by whole steps of the programme, so that all rows of an isotherm fit another too.
    lost = fits.any(axis=0) & ~np.isin(np.arange(fits.shape[1]), chosen)
    doubtful = fits.sum(axis=1) > 1
    _, which, count = np.unique(np.stack([chosen, place]), axis=1, return_inverse=True, return_counts=True)
    if lost.any() or np.any(doubtful & (count[np.ravel(which)] > 1)):
        problem = f"the shifts in sheet {SHIFT_LIST!r} differ by whole steps of the frequency programme, so that the "
        raise DataFileError(
            path,
            problem + f"rows of the master curve cannot be assigned; {AS_IT_IS}.",
            code="master-curve-inseparable",
        )


def _next_in_time(
    row: int,
    time: Array | None,
    candidates: Mask,
    chosen: Indices,
    settled: Mask,
    path: str,
    places: Sequence[str],
) -> int:
    near = settled & candidates[chosen]
    if time is None or not np.any(near):
        raise DataFileError(
            path,
            f"{places[row]} could belong to several isotherms, and there is no column 'Time' to decide; {AS_IT_IS}.",
            code="master-curve-inseparable",
        )
    distance = np.where(near, np.abs(time - time[row]), np.inf)
    return int(chosen[np.argmin(distance)])


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
        (name, unit, DMA.quantity(name) if name in known and place == names.index(name) else "")
        for place, (name, unit) in enumerate(zip(names, [*units, *[""] * len(names)], strict=False))
    ]
    shown = f"{path}, sheet {DATA!r}"
    body = [(number, cells[: len(names)]) for number, cells in numbered_rows(shown, rows) if number > 2]
    return instrument_table(shown, columns, body, DMA)


def _passed_over(table: Table, complete: Mask) -> list[Note]:
    missing = [f"row {line}" for line, kept in zip(table.lines, complete, strict=True) if not kept]
    if not missing:
        return []
    said = f"Left out, without a temperature, frequency or modulus, in sheet {DATA!r}: {several(missing, 3)}."
    return [Note("points-left-out", said)]


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
        problem = (
            f"is a master curve at {shown_celsius(float(temperature[0]))} °C without the {lacking}, which is needed to "
            f"split it into isotherms; {AS_IT_IS}."
        )
        raise DataFileError(path, problem, code="master-curve-inseparable")
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
