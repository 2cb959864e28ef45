"""Anton Paar RheoCompass text exports: the frequency sweeps among their intervals.

No genuine file of this format was available.  The layout (see `rheocompass_intervals`) and the English, German,
French and Portuguese names are those of published programs for such files; the names in other languages are the usual
words of the field.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import DataFileError
from viscofric.notes import Note
from viscofric.readers.dma.instruments.rheocompass_intervals import (
    Decimals,
    Interval,
    has_intervals,
    head,
    intervals,
)
from viscofric.readers.dma.names import DMA, tools_in
from viscofric.readers.dma.tables.dma_table import read_export
from viscofric.readers.table import Table, instrument_table

if TYPE_CHECKING:
    from viscofric.readers.dma.readings import Readings
    from viscofric.readers.source import Source

    #: Line and cells of points.
    Rows = list[tuple[int, tuple[str, ...]]]

NAME = "Anton Paar RheoCompass text"

#: Relative range of a frequency that is held, as measured.
_SAME_FREQUENCY = 0.05


def recognises(source: Source) -> bool:
    """Return whether the text has an interval of numbered points."""
    return source.text is not None and has_intervals(source.text)


def read(source: Source) -> Readings:
    """Return the points of all frequency sweeps; each interval is a step."""
    found = intervals(source)
    oscillating = [interval for interval in found if interval.oscillates]
    decimals = Decimals.of(source.path, oscillating)
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
        raise DataFileError(
            source.path,
            f"no interval of {len(found)} is a frequency sweep, with frequency, storage and loss modulus; the first "
            f"has the columns {headings}.",
            code="no-frequency-sweep",
        )
    others = len(found) - len(tables)
    if others:
        what = "1 interval that is no frequency sweep was"
        what = what if others == 1 else f"{others} intervals that are no frequency sweeps were"
        notes.insert(0, Note("no-frequency-sweep", f"{what} skipped."))
    whole = read_export(tables, source, NAME, "the intervals", tools=tools_in(head(source)))
    step = np.repeat(np.arange(len(tables)), [len(table.rows) for table in tables])
    return replace(whole, step=step, notes=tuple(dict.fromkeys((*notes, *whole.notes))))


def _needed(interval: Interval) -> list[int]:
    whats = ("storage modulus", "loss modulus", "temperature")
    places = (interval.frequency, *(interval.places.get(what) for what in whats))
    return [place for place in places if place is not None]


def _complete(interval: Interval) -> Rows:
    """Return the complete points; without torque, for instance, the instrument leaves the moduli empty."""
    return [(line, row) for line, row in interval.rows if all(row[place] for place in _needed(interval))]


def _table(path: str, interval: Interval, rows: Rows, decimals: Decimals) -> Table:
    """Return complete points as a table; amplitudes may have any sign."""
    quantities = {place: what for what, place in interval.places.items()}
    strain = interval.places.get("strain amplitude")
    columns = [
        (name, unit, quantities.get(place, ""))
        for place, (name, unit) in enumerate(zip(interval.columns, interval.units, strict=True))
    ]
    body = [
        (line, [decimals.plain(cell.lstrip("-") if place == strain else cell) for place, cell in enumerate(row)])
        for line, row in rows
    ]
    return instrument_table(f"{path}, interval in line {interval.line}", columns, body, DMA, comma=False)


def _doubts(interval: Interval) -> list[Note]:
    complete = {line for line, _ in _complete(interval)}
    empty = [line for line, _ in interval.rows if line not in complete]
    notes = []
    marked = (list(interval.invalid), "marked next to the number as invalid")
    for lines, why in (marked, (empty, "a cell being empty")):
        if lines:
            shown = ", ".join(str(line) for line in lines[:3]) + (" and more" if len(lines) > 3 else "")
            what = "1 point was" if len(lines) == 1 else f"{len(lines)} points were"
            said = f"{what} left out, {why} (line{'s' if len(lines) > 1 else ''} {shown})."
            notes.append(Note("points-left-out", said))
    if interval.missing:
        notes.append(
            Note(
                "points-missing",
                f"The interval in line {interval.line} announces {interval.announced} points, {interval.missing} of "
                "which "
                "are not in the file.",
            )
        )
    return notes
