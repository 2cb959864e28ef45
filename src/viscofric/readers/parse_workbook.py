"""What parses a workbook, in a process with limits of memory and time; see `workbook`.

A crafted workbook can make any parser request hundreds of gigabytes, which ends its process.  This module imports no
arrays, so that the process starts quickly.
"""

from __future__ import annotations

import html
import io
import json
import re
import zipfile
from collections.abc import Iterable

from viscofric.errors import DataFileError

#: Far above those of a workbook of measurements; a sheet is held in memory with its empty cells.
MOST_CELLS = 5_000_000
#: Longer text is neither a heading nor a number; thousands of cells may share one long text.
LONGEST_TEXT = 1000  # characters
LARGEST_ANSWER = 50_000_000  # bytes

_PLACE = re.compile(r"(?P<column>[A-Z]{1,3})(?P<row>[0-9]{1,7})")
_ATTRIBUTE = re.compile(r"""([\w:]+)\s*=\s*(?:"([^"]*)"|'([^']*)')""")
#: Formats of numbers that Excel shows as per cent, besides those that a workbook defines.
_OF_PER_CENT = (9, 10)
_CELL = re.compile(rb"""\sr\s*=\s*["']([A-Z]{1,3})([0-9]{1,7})["']""")


def parsed(path: str, data: bytes) -> tuple[dict[str, list[list[object]]], list[str]]:
    """Return rows of cells by the name of the sheet, and the names of hidden sheets, or raise `DataFileError`."""
    try:
        import python_calamine
    except ImportError:
        problem = "was not read: workbooks need python-calamine, which this Python does not find; install it, or "
        raise DataFileError(path, problem + "save the sheet as CSV.", code="package-missing") from None
    try:
        if data.startswith(b"PK"):
            _insist_on_sense(path, data)
        workbook = python_calamine.CalamineWorkbook.from_filelike(io.BytesIO(data))
        kinds = python_calamine.SheetTypeEnum
        listed = [one for one in workbook.sheets_metadata if one.typ == kinds.WorkSheet]
        names = [one.name for one in listed]
        hidden = [one.name for one in listed if one.visible != python_calamine.SheetVisibleEnum.Visible]
        sheets, merged, cells = {}, {}, 0
        for name in names:
            sheet = workbook.get_sheet_by_name(name)
            height, width = sheet.end or (0, 0)
            cells += (height + 1) * (width + 1)
            if cells > MOST_CELLS:
                raise _too_many_cells(path, cells)
            rows = sheet.to_python(skip_empty_area=False)
            sheets[name] = [[_plain(cell) for cell in row] for row in rows]
            merged[name] = getattr(sheet, "merged_cell_ranges", None) or []
        if data.startswith(b"PK"):
            _show_per_cent(data, sheets)
        for name, ranges in merged.items():
            _fill_merged(sheets[name], ranges)
        size = len(json.dumps(sheets))
    except DataFileError:
        raise
    except MemoryError:
        problem = "needs more memory than a workbook of measurements would."
        raise DataFileError(path, problem, code="too-large") from None
    except BaseException as error:  # noqa: BLE001 - a panic of the parser is no Exception
        problem = f"is a damaged or protected workbook ({_first_line(error)})."
        raise DataFileError(path, problem, code="damaged") from None
    if size > LARGEST_ANSWER:
        problem = f"holds {size / 1e6:.0f} MB of cells, far more than a workbook of measurements does."
        raise DataFileError(path, problem, code="too-large")
    return sheets, hidden


def _fill_merged(rows: list[list[object]], ranges: Iterable[tuple[tuple[int, int], tuple[int, int]]]) -> None:
    """Write what stands in the first of merged cells into those below it, and a number into those beside it too."""
    # Words beside it are left out: what stands above several headings is read as that of the blank cells behind it.
    for (top, left), (bottom, right) in ranges:
        value = rows[top][left] if top < len(rows) and left < len(rows[top]) else ""
        if value == "":
            continue
        for row in rows[top : bottom + 1]:
            is_number = isinstance(value, (int, float)) or str(value).endswith(" %")
            end = min(right + 1, len(row)) if is_number else left + 1
            row[left:end] = [value] * (end - left)


def _first_line(error: BaseException) -> str:
    return (str(error).splitlines() or [type(error).__name__])[0][:120].rstrip(".")


def _too_many_cells(path: str, cells: int) -> DataFileError:
    problem = f"has sheets of {cells:.3g} cells; a workbook of measurements has at most {MOST_CELLS:.3g}."
    return DataFileError(path, problem, code="too-large")


def _plain(cell: object) -> object:
    """Keep numbers and text; truth values, dates and times become text."""
    if isinstance(cell, (float, int)) and not isinstance(cell, bool):
        return cell
    return str(cell).upper() if isinstance(cell, bool) else str(cell)[:LONGEST_TEXT]


def _insist_on_sense(path: str, data: bytes) -> None:
    """Refuse a sheet of billions of cells; the unpacked size of the archive was checked before."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            for part in archive.infolist():
                if part.filename.lower().endswith(".xml") and "worksheets/" in part.filename.lower():
                    cells = _extent(archive.read(part))
                    if cells > MOST_CELLS:
                        raise _too_many_cells(path, cells)
    except (DataFileError, MemoryError):
        raise
    except Exception as error:  # noqa: BLE001 - zlib.error and what else a torn archive raises
        raise DataFileError(path, f"is a damaged workbook ({_first_line(error)}).", code="damaged") from None


def _extent(sheet: bytes) -> int:
    """Return rows times columns of the smallest block from the first cell on that holds all cells."""
    width = height = 0
    for letters, digits in _CELL.findall(sheet):
        width, height = max(width, _column_number(letters)), max(height, int(digits))
    return width * height


def _column_number(letters: bytes) -> int:
    """Return the number of a column from 1: of AB, 28."""
    column = 0
    for letter in letters:
        column = 26 * column + letter - 64
    return column


def _show_per_cent(data: bytes, sheets: dict[str, list[list[object]]]) -> None:
    """Write numbers that Excel shows as per cent as it does: a cell that shows 3.1 % holds 0.031."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        parts = {part.filename: part for part in archive.infolist()}
        if not {"xl/styles.xml", "xl/workbook.xml", "xl/_rels/workbook.xml.rels"} <= parts.keys():
            return
        styles = _styles_of_per_cent(archive.read("xl/styles.xml"))
        if not styles:
            return
        targets = {
            one.get("Id", ""): one.get("Target", "")
            for one in _elements("Relationship", archive.read("xl/_rels/workbook.xml.rels"))
        }
        for sheet in _elements("sheet", archive.read("xl/workbook.xml")):
            target = targets.get(sheet.get("r:id", ""), "")
            part, rows = (
                target.lstrip("/") if target.startswith("/") else f"xl/{target}",
                sheets.get(sheet.get("name", "")),
            )
            for cell in _elements("c", archive.read(part)) if rows is not None and part in parts else ():
                if cell.get("s") in styles and (place := _PLACE.fullmatch(cell.get("r", ""))):
                    _show_cell(rows or [], int(place["row"]) - 1, _column_number(place["column"].encode()) - 1)


def _elements(name: str, xml: bytes) -> list[dict[str, str]]:
    """Return the attributes of the elements of a name."""
    tags = re.findall(rf"<(?:\w+:)?{name}\s([^<>]*)>", xml.decode("utf-8", "replace"))
    return [{key: html.unescape(one or other) for key, one, other in _ATTRIBUTE.findall(tag)} for tag in tags]


def _styles_of_per_cent(xml: bytes) -> set[str]:
    """Return the numbers of the styles whose format of numbers shows per cent."""
    formats = {str(one) for one in _OF_PER_CENT}
    formats |= {one.get("numFmtId", "") for one in _elements("numFmt", xml) if "%" in one.get("formatCode", "")}
    used = re.search(rb"<(?:\w+:)?cellXfs\b.*?</(?:\w+:)?cellXfs>", xml, re.DOTALL)
    each = _elements("xf", used[0]) if used else []
    return {str(number) for number, one in enumerate(each) if one.get("numFmtId") in formats}


def _show_cell(rows: list[list[object]], row: int, column: int) -> None:
    if row < len(rows) and column < len(rows[row]) and isinstance(value := rows[row][column], (int, float)):
        rows[row][column] = f"{100.0 * value:.15g} %"
