"""Anton Paar RheoCompass text exports: the frequency sweeps among their intervals, in any language.

An interval begins with its number and count of points; then come the names of the columns, a row of qualifiers,
units in brackets, and one row for each point, its first cell empty::

    Interval and data points:   1           31
    Interval data:              Point No.   Angular Frequency   Storage Modulus   ...   Status
                                            [rad/s]             [Pa]
                                1           100                 12345

No genuine file of this format was available.  The layout and the English, German, French and Portuguese names are those
of published programs for such files; the names in other languages are the usual words of the field.
"""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from viscofric.errors import DataFileError
from viscofric.notes import Note
from viscofric.readers.dma.names import DMA, tools_in
from viscofric.readers.dma.readings import Readings
from viscofric.readers.dma.tables.dma_table import read_export
from viscofric.readers.source import Decimals, Source
from viscofric.readers.table import Table, instrument_table
from viscofric.showing import several

#: Line and cells of points.
Rows = list[tuple[int, tuple[str, ...]]]


_INTERVAL = re.compile(
    r'^"?[^\t;,:"\r\n]{3,60}:"?(?P<mark>[\t;,])"?\d{1,6}"?(?P=mark)"?\d{1,6}"?[\t;, ]*\r?\n(?:[\t;, ]*\r?\n)?'
    r'"?[^\t;,:"\r\n]{3,60}:"?(?P=mark)',
    re.MULTILINE,
)
_SWEEP = ("storage modulus", "loss modulus")
#: Rows of qualifiers and units between the names of the columns and the first point.
_ROWS_BEFORE_POINTS = 3
#: Of the number of an interval, and of its points.
_MOST_DIGITS = 6


@dataclass(frozen=True, eq=False)
class Interval:
    """One interval, its numbers still as text; the first column is the empty cell at the beginning of each row."""

    line: int  # of the file
    announced: int  # number of points
    columns: tuple[str, ...]
    units: tuple[str, ...]
    rows: tuple[tuple[int, tuple[str, ...]], ...]  # line and cells of each numbered point
    invalid: tuple[int, ...]  # lines of points marked by the instrument

    @cached_property
    def places(self) -> dict[str, int]:
        """Columns by what they hold, in the words of `DMA`; the first of several."""
        found: dict[str, int] = {}
        for place, column in enumerate(self.columns[1:], start=1):
            if what := DMA.quantity(column):
                found.setdefault(what, place)
        return found

    @property
    def oscillates(self) -> bool:
        """Whether there are a frequency and both moduli."""
        return self.frequency is not None and all(what in self.places for what in _SWEEP)

    @property
    def frequency(self) -> int | None:
        """The column of the angular frequency, or where there is none of the frequency."""
        return self.places.get("angular frequency", self.places.get("frequency"))

    @property
    def missing(self) -> int:
        """How many points fewer than announced the file holds."""
        return max(self.announced - len(self.rows) - len(self.invalid), 0)


def head(source: Source) -> list[list[str]]:
    """Return the cells of the lines above the first interval, where the export names the measuring system."""
    text = source.text or ""
    first = _INTERVAL.search(text)
    return [] if first is None else [_cells(line, first["mark"]) for line in text[: first.start()].splitlines()]


def intervals(source: Source) -> list[Interval]:
    """Return the intervals of an export."""
    text = source.text or ""
    first = _INTERVAL.search(text)
    if first is None:
        raise DataFileError(source.path, "contains no interval of numbered points.", code="no-points")
    lines = text.splitlines()
    cells = [_cells(line, first["mark"]) for line in lines]
    found = []
    for start in (place for place, row in enumerate(cells) if _begins(row)):
        named = next((place for place in range(start + 1, min(start + 3, len(cells))) if cells[place][0]), None)
        if named is None or not cells[named][0].endswith(":") or _begins(cells[named]):
            problem = "the names of the columns must follow the number of points."
            raise DataFileError(source.path, problem, start + 1, code="missing-columns")
        found.append(_interval(source.path, cells, start, named))
    broken = found[-1].missing > 0 or len(cells[-1]) < len(found[-1].columns)
    if broken and not text.endswith(("\n", "\r")):
        problem = (
            f"the last interval announces {found[-1].announced} points, but the file is truncated; export it again."
        )
        raise DataFileError(source.path, problem, len(lines), code="cut-short")
    return found


def _begins(row: list[str]) -> bool:
    counts = [cell.isdecimal() and len(cell) <= _MOST_DIGITS for cell in row[1:3]]
    return row[0].endswith(":") and counts == [True, True] and not any(row[3:])


def _cells(line: str, mark: str) -> list[str]:
    try:
        row = next(csv.reader([line], delimiter=mark), [])
    except csv.Error:
        row = line.split(mark)
    return [cell.strip() for cell in row] or [""]


def _interval(path: str, cells: list[list[str]], start: int, named: int) -> Interval:
    columns = tuple(" ".join(cell.split()) for cell in cells[named])
    units_at = next(
        (place for place in range(named + 1, min(named + 1 + _ROWS_BEFORE_POINTS, len(cells))) if _units(cells[place])),
        None,
    )
    if units_at is None:
        raise DataFileError(
            path, "a row of units in brackets must follow the names of the columns.", named + 1, code="no-unit"
        )
    rows, invalid = [], []
    for place in range(units_at + 1, len(cells)):
        row = cells[place]
        if row[0]:
            break  # the next interval, result or test
        number = row[1] if len(row) > 1 else ""
        if number.isdecimal():
            rows.append((place + 1, tuple(_padded(row, len(columns)))))
        elif re.match(r"\d+\D", number):
            invalid.append(place + 1)  # "3 (invalid)", in the user's language
        # A row without a number is empty, or one of the wave form of the point above.
    units = tuple(cell.strip("[] ") for cell in _padded(cells[units_at], len(columns)))
    return Interval(start + 1, int(cells[start][2]), columns, units, tuple(rows), tuple(invalid))


def _units(row: list[str]) -> bool:
    return not row[0] and any(cell.startswith("[") and cell.endswith("]") for cell in row)


def _padded(row: list[str], size: int) -> list[str]:
    return (row + [""] * size)[:size]


NAME = "Anton Paar RheoCompass text"

#: Relative range of a frequency that is held, as measured.
_SAME_FREQUENCY = 0.05


def recognises(source: Source) -> bool:
    """Return whether the text has an interval of numbered points: two labels that end in a colon, one with counts."""
    return source.text is not None and _INTERVAL.search(source.text) is not None


def read(source: Source) -> Readings:
    """Return the points of all frequency sweeps; each interval is a step."""
    found = intervals(source)
    oscillating = [interval for interval in found if interval.oscillates]
    numbers = [
        (row[place], line)
        for interval in oscillating
        for place in set(interval.places.values())
        for line, row in interval.rows
    ]
    decimals = Decimals.of(source.path, numbers)
    notes: list[Note] = []
    tables: list[Table] = []
    for interval in oscillating:
        rows = _complete(interval)
        if not rows:
            continue
        table = _table(source.path, interval, rows, decimals)
        assert interval.frequency is not None  # it oscillates
        frequency = table.numbers(interval.frequency)
        held = frequency.size < 2 or np.ptp(frequency) <= _SAME_FREQUENCY * np.max(np.abs(frequency))
        if held and source.test == "frequency":
            continue
        tables.append(table)
        notes += _doubts(interval)
    if not tables:
        headings = ", ".join(repr(column) for column in found[0].columns[1:] if column)
        problem = (
            f"no interval of {len(found)} is a frequency sweep, with frequency, storage and loss modulus; the first "
            f"has the columns {headings}."
        )
        raise DataFileError(source.path, problem, code="no-frequency-sweep")
    others = len(found) - len(tables)
    if others:
        what = "1 interval that is no frequency sweep was"
        what = what if others == 1 else f"{others} intervals that are no frequency sweeps were"
        notes.insert(0, Note("no-frequency-sweep", f"{what} skipped."))
    whole = read_export(tables, source, NAME, "the intervals", tools=tools_in(head(source)))
    step = np.repeat(np.arange(len(tables)), [len(table.rows) for table in tables])
    return replace(whole, step=step, notes=tuple(dict.fromkeys((*notes, *whole.notes))))


def _complete(interval: Interval) -> Rows:
    """Return the complete points; without torque, for instance, the instrument leaves the moduli empty."""
    places = (interval.frequency, *(interval.places.get(what) for what in (*_SWEEP, "temperature")))
    needed = [place for place in places if place is not None]
    return [(line, row) for line, row in interval.rows if all(row[place] for place in needed)]


def _table(path: str, interval: Interval, rows: Rows, decimals: Decimals) -> Table:
    """Return complete points as a table; amplitudes may have any sign."""
    quantities = {place: what for what, place in interval.places.items()}
    strain = interval.places.get("strain amplitude")
    columns = [
        (name, unit, quantities.get(place, ""))
        for place, (name, unit) in enumerate(zip(interval.columns, interval.units, strict=True))
    ]
    body = [
        (line, [cell.lstrip("-") if place == strain else cell for place, cell in enumerate(row)]) for line, row in rows
    ]
    return instrument_table(f"{path}, interval in line {interval.line}", columns, body, DMA, decimals)


def _doubts(interval: Interval) -> list[Note]:
    complete = {line for line, _ in _complete(interval)}
    empty = [line for line, _ in interval.rows if line not in complete]
    notes = []
    marked = (list(interval.invalid), "marked next to the number as invalid")
    for lines, why in (marked, (empty, "a cell being empty")):
        if lines:
            shown = several([*map(str, lines)], 3)
            what = "1 point was" if len(lines) == 1 else f"{len(lines)} points were"
            said = f"{what} left out, {why} (line{'s' if len(lines) > 1 else ''} {shown})."
            notes.append(Note("points-left-out", said))
    if interval.missing:
        said = f"The interval in line {interval.line} announces {interval.announced} points"
        notes.append(Note("points-missing", f"{said}, {interval.missing} of which are not in the file."))
    return notes
