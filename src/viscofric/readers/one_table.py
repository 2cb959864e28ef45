"""The one table of a text or a workbook under a vocabulary; that of histories."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from os import PathLike
from typing import Any, NamedTuple

from viscofric.arrays import Array
from viscofric.errors import DataFileError
from viscofric.files import file_path
from viscofric.notes import setting
from viscofric.readers.dma.names import LOAD, TEMPERATURE, TIME
from viscofric.readers.headings import Vocabulary, option_of
from viscofric.readers.source import Source, bytes_of, checked_sheet, insist_on_content
from viscofric.readers.table import Table
from viscofric.readers.tables import find_tables
from viscofric.readers.workbook import is_workbook


def table_of(
    path: str | PathLike[str], vocabulary: Vocabulary, columns: Mapping[Any, Any] | None, sheet: object
) -> Table:
    """Return the table of a file, whose columns have the quantities that they name or that the user says."""
    source = Source(str(file_path(path)), b"", columns=vocabulary.checked(columns), sheet=checked_sheet(sheet))
    return only_table(replace(source, data=bytes_of(source.path)), vocabulary)


def only_table(source: Source, vocabulary: Vocabulary) -> Table:
    """Return the one table of a text or a workbook that has the columns of a vocabulary."""
    insist_on_content(source)
    if source.text is None and not is_workbook(source):
        problem = f"is a binary file; {vocabulary.kind} is a text or a workbook."
        raise DataFileError(source.path, problem, code="binary")
    tables = find_tables(source, vocabulary)
    if len(tables) > 1:
        shown = ", ".join(map(repr, tables))
        key = f"{vocabulary.key.rpartition('columns')[0]}sheet"
        first = repr(next(iter(tables)))
        remedy = replace(setting(key, "Sheet", first), shell=f"{option_of(key)} {first}") + "."
        problem = f"the sheets {shown} each contain {vocabulary.kind}; choose one with "
        raise DataFileError(source.path, problem, code="several-tables", remedy=remedy)
    return next(iter(tables.values()))


#: Quantity -> its SI unit, and names of its column.
_QUANTITIES: dict[str, tuple[str, frozenset[str]]] = {
    "time": ("s", TIME),
    "load": ("N", LOAD | {"F", "force"}),
    "indentation": ("m", frozenset({"indentation", "depth", "indentation depth", "penetration"})),
    "pressure": ("Pa", frozenset({"p", "pressure", "mean pressure"})),
    "gap": ("m", frozenset({"gap", "mean gap"})),
    "position": ("m", frozenset({"position", "distance", "sliding distance", "path"})),
    "position x": ("m", frozenset({"x", "position x", "x position"})),
    "position y": ("m", frozenset({"y", "position y", "y position"})),
    "speed": ("m/s", frozenset({"v", "speed", "velocity", "sliding speed"})),
    "speed x": ("m/s", frozenset({"vx", "speed x", "velocity x"})),
    "speed y": ("m/s", frozenset({"vy", "speed y", "velocity y"})),
    "temperature": ("K", TEMPERATURE),
}

#: The words of tables of histories.
HISTORY = Vocabulary(
    "a table of a history",
    {name: names for name, (_, names) in _QUANTITIES.items()},
    needed=(("time",), tuple(name for name in _QUANTITIES if name != "time")),
    example="a history has 'time (s)' with 'load (N)' or 'indentation (mm)', and where it moves 'position (mm)' or "
    "'speed (mm/s)'",
    key="history.columns",
    offered=(
        ("time", "s"),
        ("load", "N"),
        ("indentation", "mm"),
        ("position", "mm"),
        ("speed", "mm/s"),
        ("temperature", "degC"),
    ),
)


class HistoryColumns(NamedTuple):
    """Columns of a history in SI units, (n,) each, with the unit of the load and the lines of the file."""

    values: dict[str, Array]
    load_unit: str
    lines: list[int]
    unused: tuple[str, ...]  # headings


def history_columns(
    path: str | PathLike[str],
    columns: Mapping[str, str] | None = None,
    sheet: str | None = None,
    vocabulary: Vocabulary = HISTORY,
) -> HistoryColumns:
    """Return the columns of a history in a text table or a workbook."""
    table = table_of(path, vocabulary, columns, sheet)
    insist_on_columns(table, vocabulary)
    places = {name: place for name in _QUANTITIES if (place := table.place(name)) is not None}
    load_unit = table.load_unit(places["load"]) if "load" in places else "N"
    units = {name: load_unit if name == "load" else unit for name, (unit, _) in _QUANTITIES.items()}
    values = {name: table.values(place, units[name]) for name, place in places.items()}
    unused = tuple(column.heading for column in table.unused(places.values()))
    return HistoryColumns(values, load_unit, table.lines.tolist(), unused)


def insist_on_columns(table: Table, vocabulary: Vocabulary) -> None:
    """Raise `DataFileError` where a table lacks what its vocabulary needs."""
    if missing := vocabulary.missing(column.quantity for column in table.columns):
        raise table.lacking(missing)
