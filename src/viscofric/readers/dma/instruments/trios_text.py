"""DMA and rheometer exports of TA Instruments TRIOS as text: for LIMS (tab separated), short text, and CSV.

A file is a header in sections and then one ``[step]`` after the other.  The export for LIMS prints a label before
each row (``Variables``, ``Units``, ``Data point``); the other two print the step's name, a row of names, a row of
units and rows of numbers, which may have fewer cells than there are names.  One file may hold several techniques.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator
from dataclasses import dataclass

from viscofric.errors import DataFileError
from viscofric.notes import Note
from viscofric.readers.dma.instruments.ta_steps import StepText, readings_of, steps_of
from viscofric.readers.dma.readings import Readings
from viscofric.readers.source import Source

#: Line of the file, counted from 1, and its cells.
Row = tuple[int, list[str]]


NAME = "TA Instruments TRIOS text or CSV"

_LIMS = re.compile(r"\s*\[version\]\s*TA Instruments LIMS", re.IGNORECASE)
_SHORT = re.compile(
    r'\s*"?Filename"?(?P<delimiter>[\t,;]).*?^"?Instrument name', re.IGNORECASE | re.DOTALL | re.MULTILINE
)
_HEAD = 4000  # characters that show the layout
_GEOMETRY_FIELDS = frozenset({"name", "geometry name", "geometry type", "type"})


def recognises(source: Source) -> bool:
    """Return whether the file begins as an export of TRIOS does."""
    head = (source.text or "")[:_HEAD]
    return bool(_LIMS.match(head) or _SHORT.match(head))


def read(source: Source) -> Readings:
    """Return the points of all frequency sweeps, or raise `DataFileError`, which names what the file holds instead."""
    found = tables_of(source)
    return readings_of(source, found.format, steps_of(source.path, found.tables), found.tools, found.notes)


@dataclass(frozen=True, eq=False)
class Tables:
    """The steps of a file as text, label and value of its sample holder, and notes."""

    format: str
    tables: list[StepText]
    tools: list[tuple[str, str]]
    notes: list[str]


def tables_of(source: Source) -> Tables:
    """Return the table of each step of the programme, of any technique."""
    text = source.text or ""
    short = _SHORT.match(text[:_HEAD])
    delimiter = short["delimiter"] if short else "\t"
    header: list[tuple[str, str, str]] = []
    drafts: list[list[Row]] = []
    section = ""
    for line, cells in _rows(source.path, text, delimiter):
        first = cells[0].strip()
        if first.startswith("[") and first.endswith("]"):
            section = first[1:-1].strip().lower()
            if section == "step":
                drafts.append([])
        elif section == "step":
            drafts[-1].append((line, cells))
        elif len(cells) > 1:
            header.append((section, first, cells[1]))
    if drafts and drafts[-1] and not text.endswith(("\n", "\r")):
        _drop_torn_cell(drafts[-1])
    notes: list[str] = []
    lims = short is None
    tables = [_lims_table(draft, notes) if lims else _short_table(draft) for draft in drafts]
    kind = "export for LIMS" if lims else ("CSV" if delimiter != "\t" else "short text")
    tools = [
        (field, value)
        for section, field, value in header
        if field.lower() in _GEOMETRY_FIELDS and (section.startswith("geometry") or field.lower() == "geometry name")
    ]
    return Tables(f"TA Instruments TRIOS text ({kind})", tables, tools, notes)


def _rows(path: str, text: str, delimiter: str) -> Iterator[Row]:
    """Return the cells of each row that is not blank; in CSV a quoted cell may run over several lines."""
    if delimiter == "\t":
        lines = io.StringIO(text, newline=None)
        yield from ((number, line.rstrip("\n").split("\t")) for number, line in enumerate(lines, 1) if line.strip())
        return
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter)
    try:
        for cells in reader:
            if any(cell.strip() for cell in cells):
                yield reader.line_num, cells
    except csv.Error as error:
        raise DataFileError(
            path, f"the row cannot be split into cells ({error}).", reader.line_num, code="row-length"
        ) from None


def _drop_torn_cell(draft: list[Row]) -> None:
    """Empty the last cell of a file without a final end of line: its number may have lost digits."""
    line, cells = draft[-1]
    if len(draft) > 1 and len(cells) < len(draft[-2][1]):
        draft[-1] = (line, [*cells[:-1], ""])


def _lims_table(draft: list[Row], notes: list[str]) -> StepText:
    table, stated = StepText("(without a name)"), ""
    for line, cells in draft:
        label, values = cells[0].strip().lower(), cells[1:]
        if label == "step name" and values:
            table.name = values[0].strip()
        elif label == "number of points" and values:
            stated = values[0].strip()
        elif label == "variables":
            table.names = values
        elif label == "units":
            table.units = values
        elif label == "data point":
            table.rows.append((line, values))
    if re.fullmatch(r"[0-9]{1,9}", stated) and int(stated) != len(table.rows):
        said = f"Step {table.name!r} states {int(stated)} points and holds {len(table.rows)}."
        notes.append(Note("points-missing", said))
    return table


def _short_table(draft: list[Row]) -> StepText:
    table = StepText("(without a name)")
    if draft:
        table.name = draft[0][1][0].strip()
    if len(draft) > 2:
        table.names, table.units, table.rows = draft[1][1], draft[2][1], draft[3:]
    return table
