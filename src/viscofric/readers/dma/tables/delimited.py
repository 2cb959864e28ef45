"""Text tables with columns separated by commas, semicolons, tabs or spaces, under one row of headings or two."""

from __future__ import annotations

import csv
import re
from dataclasses import replace
from typing import TYPE_CHECKING

from viscofric.errors import DataFileError
from viscofric.notes import Remedy
from viscofric.readers.dma.names import quantity, tools_in
from viscofric.readers.dma.tables.dma_table import read_points
from viscofric.readers.table import Column, Table, heading, make_table, split_cells, text_lines

if TYPE_CHECKING:
    from collections.abc import Sequence

    #: Cells of one row, with its number in the file.
    NumberedRow = tuple[int, Sequence[str]]
    from viscofric.readers.dma.readings import Readings
    from viscofric.readers.source import Source
    from viscofric.readers.table import Table


#: Tables by people and instruments begin above this line.
DEEPEST_HEADER = 300
_MODULI = {"storage modulus", "loss modulus", "complex modulus"}
_FREQUENCIES = {"frequency", "angular frequency", "reduced frequency", "reduced angular frequency"}


def header_row(rows: Sequence[NumberedRow]) -> int | None:
    """Return the row that names the columns of a DMA table, or None.

    It is the first that names a frequency and a modulus; else the first that names two quantities of
    `viscofric.readers.dma.names`, or a traction: missing columns are reported later.
    """
    second_best = None
    for place, (_, cells) in enumerate(rows[:DEEPEST_HEADER]):
        found = quantities(cells)
        if found & _MODULI and found & _FREQUENCIES:
            return place
        if second_best is None and (len(found) > 1 or any("traction" in cell.lower() for cell in cells[1:])):
            second_best = place
    return second_best


def insist_on_moduli(path: str, cells: Sequence[str]) -> None:
    """Raise `DataFileError` if a header is that of traction runs."""
    if not quantities(cells) & _MODULI and any("traction" in cell.lower() for cell in cells):
        raise DataFileError(
            path,
            "this is a table of traction runs, not of DMA sweeps",
            code="traction-runs",
            remedy=Remedy(
                "; use read_mtm, or name it as mtm under [measurement] of a run file.",
                "; viscofric measure reads it, and as mtm under [measurement] a run file.",
                "; name it as mtm under [measurement].",
                "; drop it under “Measurement”.",
                "material.dma",
            ),
        )


def quantities(cells: Sequence[str]) -> set[str]:
    """Return what the cells of one row name, in the words of `viscofric.readers.dma.names.QUANTITIES`."""
    found = (quantity(heading(cell).name) for cell in cells if 0 < len(cell) < 100)
    return {what for what in found if what is not None}


def table_under(path: str, rows: Sequence[NumberedRow], header: int, *, comma_is_free: bool = True) -> Table:
    """Return the table under a header, from all rows that are not blank, each with its number in the file.

    Raises
    ------
    DataFileError
        If rows of numbers stand above the header, there is none below it, or a row differs from it in length.
    """
    _insist_on_text(path, rows[:header])
    names = list(rows[header][1])
    while names and not names[-1].strip():
        names.pop()
    columns = tuple(heading(cell) for cell in names)
    body = list(rows[header + 1 :])
    if body and _is_row_of_units(columns, body[0][1]):
        units = body.pop(0)[1]
        columns = tuple(
            column if column.unit else replace(column, unit=_unit(cell))
            for column, cell in zip(columns, [*units, *[""] * len(columns)], strict=False)
        )
    repeated = [list(rows[header][1])]  # stacked tables repeat their header
    table = make_table(
        path, columns, [row for row in body if list(row[1]) not in repeated], comma_is_free=comma_is_free
    )
    return replace(table, tools=tuple(tools_in(cells for _, cells in rows[:header])))


def _insist_on_text(path: str, above: Sequence[NumberedRow]) -> None:
    for number, cells in above:
        if sum(is_number(cell) for cell in cells) > 2:
            raise DataFileError(
                path,
                "a row of numbers precedes the header; put the header first.",
                number,
                code="numbers-above-header",
            )


def _is_row_of_units(columns: Sequence[Column], cells: Sequence[str]) -> bool:
    """Return whether a row under headings without units gives them."""
    known = [place for place, column in enumerate(columns) if quantity(column.name)]
    if any(columns[place].unit for place in known) or any(is_number(cell) for cell in cells):
        return False
    return len(cells) <= len(columns) + 1 and any(_unit(cells[place]) for place in known if place < len(cells))


def _unit(cell: str) -> str:
    plain = cell.strip().strip("[]()").strip()
    return "" if plain in ("-", "–", "1") else plain


def is_number(cell: str) -> bool:
    """Return whether a cell is a number, with a decimal point or comma."""
    try:
        float(cell.strip().replace(",", "."))
    except ValueError:
        return False
    return True


NAME = "delimited text"
_DELIMITERS = "\t;,"
#: Headings may contain single blanks ("f (Hz)"), so two or more separate them; numbers contain none.
_BLANKS = "blanks"


def recognises(source: Source) -> bool:
    """Return whether a line of the text names columns of a DMA table; see `viscofric.readers.dma.tables.delimited`."""
    return source.text is not None and _delimiter(text_lines(source.text)) is not None


def read(source: Source) -> Readings:
    """Return the points; see `viscofric.readers.dma.tables.dma_table.read_points` for what is raised."""
    return read_points(delimited_table(source), source, NAME, source.stem)


def delimited_table(source: Source) -> Table:
    """Return the table of a text file, or raise `DataFileError` without a header or with rows of another length."""
    lines = text_lines(source.text or "")
    delimiter = _delimiter(lines)
    if delimiter is None:
        raise DataFileError(
            source.path, "no line names columns separated by commas, semicolons or tabs.", code="unknown-format"
        )
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
    if best is None and _separated_by_blanks(lines):
        return _BLANKS
    return best[1] if best else None


def _separated_by_blanks(lines: list[tuple[int, str]]) -> bool:
    """Return whether a line of headings precedes lines of as many numbers; prose may name quantities too."""
    rows: list[NumberedRow] = [
        (number, _split_at_blanks(line[:10_000])) for number, line in lines[: DEEPEST_HEADER + 2]
    ]
    header = header_row(rows)
    if header is None:
        return False
    below = rows[header + 1 : header + 3]
    return any(len(cells) == len(rows[header][1]) and all(map(is_number, cells)) for _, cells in below)


def _split_at_blanks(line: str) -> list[str]:
    """Return cells separated by two blanks or more, or by single ones if no heading has several words."""
    wide = re.split(r"\s{2,}", line.strip())
    single = line.split()
    return single if len(wide) == 1 or all(map(is_number, single)) else wide


def _split(line: str, delimiter: str) -> list[str]:
    try:
        return next(csv.reader([line[:10_000]], delimiter=delimiter, skipinitialspace=True))
    except csv.Error:
        return []
