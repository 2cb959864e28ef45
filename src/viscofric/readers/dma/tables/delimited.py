"""Text tables with columns separated by commas, semicolons, tabs or blanks, as people and most programs write them."""

from __future__ import annotations

import csv
import re
from dataclasses import replace
from typing import TYPE_CHECKING

from viscofric.errors import DataFileError
from viscofric.readers.dma.deformation import tools_in
from viscofric.readers.dma.tables.dma_table import read_points
from viscofric.readers.dma.tables.layout import (
    DEEPEST_HEADER,
    header_row,
    insist_on_moduli,
    is_number,
    quantities,
    table_under,
)
from viscofric.readers.table import split_cells, text_lines

if TYPE_CHECKING:
    from viscofric.readers.dma.readings import Readings
    from viscofric.readers.dma.tables.layout import NumberedRow
    from viscofric.readers.source import Source
    from viscofric.readers.table import Table

NAME = "text table (columns separated by commas, semicolons, tabs or blanks)"
_DELIMITERS = "\t;,"
#: Headings may hold single blanks ("f (Hz)"), so that two or more part them; numbers hold none.
_BLANKS = "blanks"


def recognises(source: Source) -> bool:
    """Return whether a line of the text names columns of a DMA table; see `viscofric.readers.dma.tables.layout`."""
    return source.text is not None and _delimiter(text_lines(source.text)) is not None


def read(source: Source) -> Readings:
    """Return the points; see `viscofric.readers.dma.tables.dma_table.read_points` for what is raised."""
    return read_points(delimited_table(source), source, NAME, source.stem)


def delimited_table(source: Source) -> Table:
    """Return the table of a text file.

    Raises
    ------
    DataFileError
        If no line names columns, or a row is not as long as its header.
    """
    lines = text_lines(source.text or "")
    delimiter = _delimiter(lines)
    if delimiter is None:
        raise DataFileError(source.path, "no line names columns separated by commas, semicolons or tabs.")
    rows: list[NumberedRow]
    if delimiter == _BLANKS:
        rows = [(number, _split_at_blanks(line)) for number, line in lines]
    else:
        rows = [(number, split_cells(source.path, number, line, delimiter)) for number, line in lines]
    header = header_row(rows) or 0
    insist_on_moduli(source.path, rows[header][1])
    table = table_under(source.path, rows, header, comma_is_free=delimiter != ",")
    remarks = [line for line in (source.text or "").splitlines()[:DEEPEST_HEADER] if line.lstrip().startswith("#")]
    return replace(table, tools=(*table.tools, *tools_in(re.split(r"[\t;,]", line) for line in remarks)))


def _delimiter(lines: list[tuple[int, str]]) -> str | None:
    """Return the delimiter that makes most of a header, None if there is none with any."""
    best: tuple[int, str] | None = None
    for delimiter in _DELIMITERS:
        rows = [
            (number, _split(line, delimiter)) for number, line in lines[:DEEPEST_HEADER] if delimiter in line[:10_000]
        ]
        header = header_row(rows)
        if header is not None:
            named = len(quantities(rows[header][1]))
            best = max(best or (-1, ""), (named, delimiter), key=lambda one: one[0])
    if best is None and _parted_by_blanks(lines):
        return _BLANKS
    return best[1] if best else None


def _parted_by_blanks(lines: list[tuple[int, str]]) -> bool:
    """Return whether a line of headings stands above lines of as many numbers; prose may name quantities too."""
    rows: list[NumberedRow] = [
        (number, _split_at_blanks(line[:10_000])) for number, line in lines[: DEEPEST_HEADER + 2]
    ]
    header = header_row(rows)
    if header is None:
        return False
    below = rows[header + 1 : header + 3]
    return any(len(cells) == len(rows[header][1]) and all(map(is_number, cells)) for _, cells in below)


def _split_at_blanks(line: str) -> list[str]:
    """Return cells parted by blanks, single ones too if no cell is a heading of several words."""
    parted = re.split(r"\s{2,}", line.strip())
    single = line.split()
    return single if len(parted) == 1 or all(map(is_number, single)) else parted


def _split(line: str, delimiter: str) -> list[str]:
    try:
        return next(csv.reader([line[:10_000]], delimiter=delimiter, skipinitialspace=True))
    except csv.Error:
        return []
