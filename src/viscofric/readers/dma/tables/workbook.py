"""Excel workbooks with tables of DMA sweeps; several sheets are temperatures of one specimen."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import DataFileError
from viscofric.notes import Note, setting
from viscofric.readers.dma.instruments import rheocompass
from viscofric.readers.dma.names import DMA
from viscofric.readers.dma.readings import Readings, of_one_file
from viscofric.readers.dma.tables.dma_table import read_points
from viscofric.readers.source import Source
from viscofric.readers.tables import find_tables
from viscofric.readers.workbook import is_workbook, opened, sheet_texts
from viscofric.units import shown_celsius

NAME = "Excel workbook"
#: A frequency that is held ranges by less.
SAME_FREQUENCY = 1.05


recognises = is_workbook


def read(source: Source) -> Readings:
    """Return the points of all sheets with a DMA table."""
    # Several sheets are the temperatures of one specimen. If their temperatures overlap, they may as well be several
    # specimens, or copies, and are refused. Sheets at one frequency, such as amplitude sweeps, are skipped beside
    # frequency sweeps.
    readings = _of_exports(source) or {
        name: read_points(table, source, NAME, name, where=f"sheet {name!r}, row")
        for name, table in find_tables(source, DMA).items()
    }
    held = [name for name, one in readings.items() if _is_held(one.angular_frequency)]
    if len(held) == len(readings):
        held = []
    readings = {name: one for name, one in readings.items() if name not in held}
    _insist_on_own_temperatures(source, readings)
    hidden = [name for name in opened(source).hidden if name in readings]
    notes = [
        Note("hidden-sheet", f"The sheet {name!r} is hidden in the workbook; it was read nevertheless.")
        for name in hidden
    ]
    if held:
        sheets = f"sheet {held[0]!r} is" if len(held) == 1 else f"sheets {', '.join(map(repr, held))} are"
        notes.append(Note("no-frequency-sweep", f"The {sheets} at one frequency, no frequency sweep; skipped."))
    if len(readings) == 1:
        return replace(whole := next(iter(readings.values())), notes=(*notes, *whole.notes))
    listed = ", ".join(map(repr, readings))
    said = f"The sheets {listed} were read as temperatures of one specimen."
    whole = of_one_file(list(readings.values()), f"the sheets {listed}")
    return replace(whole, notes=(*notes, Note("sheets-as-temperatures", said), *whole.notes))


def _of_exports(source: Source) -> dict[str, Readings]:
    """Return the points of sheets that hold an instrument's text export, none where the user names columns."""
    if source.columns:
        return {}
    found = {}
    for name, text in sheet_texts(source).items():
        if rheocompass.recognises(text):
            one = rheocompass.read(text)
            places = tuple(place.replace("line", f"sheet {name!r}, row") for place in one.places)
            found[name] = replace(one, source=source.path, format=NAME, places=places)
    return found


def _is_held(angular_frequency: Array) -> bool:
    """Return whether three points or more have one frequency."""
    known = angular_frequency[angular_frequency > 0.0]
    return len(known) > 2 and bool(np.max(known) <= SAME_FREQUENCY * np.min(known))


def _insist_on_own_temperatures(source: Source, readings: dict[str, Readings]) -> None:
    spans = []
    for name, one in readings.items():
        known = one.temperature[np.isfinite(one.temperature)]
        if known.size:
            low, high = float(known.min()), float(known.max())
            kind = f"{one.deformation}, " if one.deformation else ""
            spans.append((low, high, name, f"{name!r} ({kind}{shown_celsius(low)} to {shown_celsius(high)} °C)"))
    spans.sort()
    for (_, high, name, shown), (next_low, _, _, next_shown) in pairwise(spans):
        if next_low <= high:
            both = f"{shown} and {next_shown}"
            problem = (
                f"the sheets {both} each contain a DMA table and overlap; keep one of them (repetitions belong in one "
                "sheet), or choose one with "
            )
            remedy = setting("material.sheet", "Sheet", repr(name)) + "."
            values = {"sheets": list(readings)}
            raise DataFileError(source.path, problem, code="several-tables", remedy=remedy, values=values)
