"""The one table of a text or a workbook under a vocabulary, or under the headings that the user names."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from viscofric.errors import DataFileError
from viscofric.files import file_path
from viscofric.notes import setting
from viscofric.readers.given_files import bytes_of
from viscofric.readers.headings import option_of
from viscofric.readers.source import Source, checked_sheet, insist_on_content
from viscofric.readers.table import Table, table_of_text
from viscofric.readers.tables import find_tables
from viscofric.readers.workbook import is_workbook

if TYPE_CHECKING:
    from collections.abc import Mapping
    from os import PathLike

    from viscofric.readers.headings import Vocabulary


def table_of(
    path: str | PathLike[str], vocabulary: Vocabulary, columns: Mapping[Any, Any] | None, sheet: object
) -> Table:
    """Return the table of a file, whose columns have the quantities that they name or that the user says."""
    source = Source(str(file_path(path)), b"", columns=vocabulary.checked(columns), sheet=checked_sheet(sheet))
    source = replace(source, data=bytes_of(source.path))
    return one_table(source, vocabulary)


def one_table(source: Source, vocabulary: Vocabulary) -> Table:
    """Return the one table of a file, as `table_of` does."""
    insist_on_content(source)
    if not (source.columns or source.sheet or is_workbook(source)):
        if source.text is None:
            raise DataFileError(source.path, "is a binary file; it must be a text table or a workbook.", code="binary")
        table = table_of_text(source.path, source.text)
        columns = vocabulary.columns([column.heading for column in table.columns])
        return replace(table, columns=columns, vocabulary=vocabulary)
    tables = find_tables(source, vocabulary)
    if len(tables) > 1:
        shown = ", ".join(map(repr, tables))
        key = f"{vocabulary.key.rpartition('columns')[0]}sheet"
        first = repr(next(iter(tables)))
        remedy = replace(setting(key, "Sheet", first), shell=f"{option_of(key)} {first}") + "."
        problem = f"the sheets {shown} each contain {vocabulary.kind}; choose one with "
        raise DataFileError(source.path, problem, code="several-tables", remedy=remedy)
    return next(iter(tables.values()))
