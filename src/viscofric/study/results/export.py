"""Results for other programs: a table (CSV), a workbook (.xlsx), or the labelled data set alone (netCDF)."""

from __future__ import annotations

import io
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any, Literal, get_args

from viscofric.datasets import Dataset, DataTree, plain
from viscofric.errors import InputError, check_choice
from viscofric.files import file_path, write_atomically
from viscofric.notes import from_json, note_of, notes_in
from viscofric.study.results.columns import about, columns_of, table_text, tables
from viscofric.study.results.file import RESULTS_FILE, cases_of
from viscofric.study.results.netcdf import write_netcdf

Form = Literal["csv", "excel", "netcdf"]
FORMS: tuple[Form, ...] = get_args(Form)
#: Format -> the default name of its file.
NAMES: dict[Form, str] = {"csv": "results.csv", "excel": "results.xlsx", "netcdf": "prediction.nc"}


def export_results(tree: DataTree, folder: Path, form: Form, path: str | Path | None = None) -> Path:
    """Write results for other programs; see `StudyResults.export`."""
    check_choice(form, "form", *FORMS)
    target = folder / NAMES[form] if path is None else file_path(path)
    if target.resolve() == (folder / RESULTS_FILE).resolve():
        raise InputError(f"{target} contains the results themselves; choose another name.", code="results-file")
    cases = cases_of(tree, folder)
    if form == "csv":
        write_atomically(target, table_text(cases).encode())
    elif form == "excel":
        write_atomically(target, workbook(tree, cases))
    else:
        write_netcdf(cases, target)
    return target


#: Rows that a sheet of this format has at most.
MOST_ROWS = 1_048_576
_LONGEST_NAME = 31
_NOT_IN_NAMES = re.compile(r"[\[\]:*?/\\]")
_NARROWEST, _WIDEST = 8, 60
_SENTENCES = ("warnings", "notes")


def workbook(tree: DataTree, cases: Dataset) -> bytes:
    """Return results as the bytes of a workbook: sheets summary, prediction, other tables, values, variables."""
    import xlsxwriter  # type: ignore[import-untyped]

    target = io.BytesIO()
    # Text stays text: text that begins with = or http comes from data files.
    options = {"in_memory": True, "strings_to_formulas": False, "strings_to_urls": False}
    with xlsxwriter.Workbook(target, options) as book:
        made = _Made(book)
        made.summary(tree.attrs)
        others = list(tables(tree))
        for name, dataset in [("prediction", cases), *others]:
            made.table(name, dataset)
        made.listing("values", [("table", "name", "value (numbers in SI units)"), *_values(others)])
        made.listing("variables", [("name", "unit", "meaning"), *made.meaning])
        attributes = tree.attrs
        book.set_properties(
            {
                "title": str(attributes.get("title", "")),
                "keywords": str(attributes.get("data_origin", "")),
                "comments": f"viscofric {attributes.get('viscofric_version', '')}",
                "created": datetime.fromisoformat(str(attributes["created"])),
            }
        )
    return target.getvalue()


class _Made:
    """A workbook under construction."""

    def __init__(self, book: Any) -> None:
        self.book = book
        self.bold = book.add_format({"bold": True, "bottom": 1, "text_wrap": True, "valign": "bottom"})
        self.names: set[str] = set()
        self.meaning: dict[tuple[str, str, str], None] = {}

    def sheet(self, name: str) -> Any:
        """Add a sheet with a valid, unique name."""
        plain = _NOT_IN_NAMES.sub(" ", name).strip("' ") or "sheet"
        called, number = plain[:_LONGEST_NAME], 1
        while called.lower() in self.names:
            number += 1
            ending = f" {number}"
            called = plain[: _LONGEST_NAME - len(ending)] + ending
        self.names.add(called.lower())
        return self.book.add_worksheet(called)

    def summary(self, attributes: Mapping[Any, Any]) -> None:
        """Write provenance, warnings, notes and the run file."""
        rows = about(attributes)
        for name in _SENTENCES:
            rows += [(name[:-1], str(note)) for note in notes_in(attributes, name)]
        lines = str(attributes.get("study_text", "")).splitlines()
        rows += [("run file" if number == 0 else "", line) for number, line in enumerate(lines)]
        page = self.sheet("summary")
        for row, (name, text) in enumerate(rows):
            page.write_string(row, 0, name, self.bold if row == 0 else None)
            page.write_string(row, 1, text, self.bold if row == 0 else None)
        page.set_column(0, 0, 18)
        page.set_column(1, 1, 110)
        page.freeze_panes(1, 0)

    def table(self, name: str, dataset: Dataset) -> None:
        """Write a data set on a sheet: fixed headings with units, a row for each point."""
        names, units, columns = columns_of(dataset)
        count = len(columns[0])
        if count >= MOST_ROWS:
            raise InputError(
                f"{name} has {count:,} rows, and a sheet of a workbook has {MOST_ROWS:,} at most; write CSV or netCDF.",
                code="too-many-rows",
            )
        page = self.sheet(name)
        for column, (variable, unit, values) in enumerate(zip(names, units, columns, strict=True)):
            heading = variable if unit == "1" else f"{variable} ({unit})"
            page.write_string(0, column, heading, self.bold)
            self.meaning[(variable, unit, str(dataset[variable].attrs.get("long_name", "")))] = None
            for row, value in enumerate(values, 1):
                _write(page, row, column, value)
            widest = max((len(value) for value in values if isinstance(value, str)), default=0)
            page.set_column(column, column, min(max(_NARROWEST, len(heading) + 2, widest), _WIDEST))
        page.freeze_panes(1, sum(variable in dataset.coords for variable in names))
        page.autofilter(0, 0, count, len(names) - 1)

    def listing(self, name: str, rows: Iterable[Sequence[Any]]) -> None:
        """Write what belongs to whole tables or columns, under its headings: three columns."""
        page = self.sheet(name)
        for row, cells in enumerate(rows):
            for column, cell in enumerate(cells):
                page.write_string(row, column, cell, self.bold) if row == 0 else _write(page, row, column, cell)
        for column, width in enumerate((28, 28, 90)):
            page.set_column(column, column, width)
        page.freeze_panes(1, 0)


def _values(named: Iterable[tuple[str, Dataset]]) -> Iterator[tuple[str, str, Any]]:
    """Yield the known attributes of tables: numbers, texts and notes, each of a list by itself; no other JSON."""
    for table, dataset in named:
        for name, value in dataset.attrs.items():
            held = plain(from_json(value), None)
            for one in held if isinstance(held, list) else [held]:
                one = str(note_of(one)) if isinstance(one, dict) and "code" in one else one
                if isinstance(one, str | int | float) and str(one):
                    yield table, str(name), one


def _write(page: Any, row: int, column: int, value: Any) -> None:
    if isinstance(value, str):
        page.write_string(row, column, value)
    elif value is not None:
        page.write_number(row, column, value)
