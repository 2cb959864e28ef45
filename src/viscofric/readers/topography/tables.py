"""Heights as plain numbers: a matrix as text or as NumPy saves it, or columns of positions and heights."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import DataFileError
from viscofric.files import LARGEST_FILE, decoded, insist_on_short_text, read_bytes, saved_array
from viscofric.notes import Note
from viscofric.readers.source import Source
from viscofric.readers.table import MISSING
from viscofric.readers.topography.scan import Scan, ScanOptions, name_of, scan_of_points
from viscofric.units import conversion

NUMPY = b"\x93NUMPY"
_BLANKS = re.compile(r"\s+")
_NUMBER = re.compile(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?")
_UNIT = re.compile(r"[(\[]\s*([^()\[\]]+?)\s*[)\]]|_(nm|um|µm|mm|m)$|/\s*(\S+)$")
#: "# Width: 10.0 µm", as Gwyddion and others write above a matrix with lines along y.
_REMARK = re.compile(r"#\s*(Width|Height|Value units)\s*:\s*(.+?)\s*$", re.IGNORECASE)
_POINT_NAMES = (("x", "z"), ("x", "height"), ("x", "y", "z"), ("x", "y", "height"))


class _Text(NamedTuple):
    """A table of numbers in text: headings (none, if there are none), rows, the line of each, and the remarks."""

    headings: tuple[str, ...]
    rows: Array
    lines: list[int]
    remarks: dict[str, str]


def is_table(text: str | None) -> bool:
    """Return whether a text is a table of numbers, under remarks and at most one row of headings."""
    if text is None:
        return False
    lines = [line.strip() for line in text.splitlines()[:200] if line.strip() and not line.lstrip().startswith("#")]
    if not lines:
        return False
    with_headings = _points_headings(_cells(lines[0])) is not None
    body = lines[1:] if with_headings else lines
    return bool(body) and all(map(_is_number, _cells(body[0])))


def read_array(source: Source, options: ScanOptions) -> Scan:
    """Read a .npy file: a matrix or a row of heights, whose spacing must be given."""
    array = saved_array(source.data, source.path)
    if array.ndim not in (1, 2) or array.dtype.kind not in "fiu" or array.size < 2:
        problem = f"holds an array of shape {array.shape} of {array.dtype}; a row or a matrix of heights is needed."
        raise DataFileError(source.path, problem, code="not-heights")
    return _matrix(source, np.asarray(array, dtype=float), options, {}, "NumPy array")


def read_text_table(source: Source, options: ScanOptions) -> Scan:
    """Read a text table: a matrix of heights, or columns x, z or x, y, z, recognised by headings or by their grid."""
    assert source.text is not None
    table = _parsed(source.path, source.text)
    named = _points_headings(table.headings)
    if named is not None:
        factors = _units(source, table.headings, options)
        return scan_of_points(source, factors * table.rows, options, table.lines)
    if options.spacing is None and "width" not in table.remarks and table.rows.shape[1] in (2, 3):
        factor, _ = conversion(options.unit or "m", "m", "unit")
        found = scan_of_points(source, factor * table.rows, options, table.lines)
        assumed = (
            ()
            if options.unit
            else (Note("unit-assumed", "positions and heights assumed to be in m", values={"unit": "m"}),)
        )
        return replace(found, notes=(*found.notes, *assumed))
    return _matrix(source, table.rows, options, table.remarks, "text matrix")


def _matrix(source: Source, table: Array, options: ScanOptions, remarks: dict[str, str], kind: str) -> Scan:
    stated_unit = remarks.get("value units", "")
    if options.unit and stated_unit:
        raise DataFileError(
            source.path,
            f"states that its heights are in {stated_unit!r}; leave unit = {options.unit!r} out.",
            code="unit-not-needed",
        )
    factor, _ = conversion(options.unit or stated_unit or "m", "m", "unit")
    table = np.where(table == options.missing, math.nan, table) if options.missing is not None else table
    heights = np.atleast_2d(table.T).T if min(np.shape(table)) > 1 or table.ndim == 1 else table.reshape(-1, 1)
    # Such remarks precede an image, whose lines follow one another along y.
    if (options.lines == "y" or "width" in remarks) and heights.shape[1] > 1:
        heights = heights.T
    spacing = options.spacing
    if "width" in remarks:
        if spacing is not None:
            raise DataFileError(source.path, "states its width; leave the spacing out.", code="spacing-not-needed")
        width = _length(source.path, remarks["width"])
        height = _length(source.path, remarks["height"]) if "height" in remarks else width
        spacing = (width / heights.shape[0], height / heights.shape[1])
    if spacing is None:
        raise DataFileError(
            source.path,
            "does not state the spacing of its points; give spacing='5 um', for instance.",
            code="no-spacing",
        )
    notes = (
        ()
        if options.unit or stated_unit
        else (Note("unit-assumed", "heights assumed to be in m", values={"unit": "m"}),)
    )
    return Scan(factor * heights, spacing, f"read from {name_of(source)} ({kind})", notes=notes)


def _length(path: str, text: str) -> float:
    match = re.fullmatch(r"([0-9.eE+-]+)\s*(\S+)", text)
    if match is None or not _NUMBER.fullmatch(match[1]):
        raise DataFileError(path, f"{text!r} in its remarks is not a length such as '10 um'.", code="wrong-unit")
    factor, _ = conversion(match[2], "m", "width")
    return factor * float(match[1])


def _cells(line: str) -> list[str]:
    """Split a line at tabs, semicolons or commas, whichever there is first, or at blanks."""
    for delimiter in "\t;":
        if delimiter in line:
            return [cell.strip() for cell in line.split(delimiter)]
    words = _BLANKS.split(line.strip())
    # "0,5 1,5" is blanks between decimal commas; "0, 5, 1" and "0,5,1" are commas between numbers
    if "," not in line or (len(words) > 1 and all(map(_is_number, words))):
        return words
    return [cell.strip() for cell in line.split(",")]


def _is_number(cell: str) -> bool:
    return cell.lower() in MISSING or _NUMBER.fullmatch(cell) is not None


def _points_headings(cells: list[str] | tuple[str, ...]) -> tuple[str, ...] | None:
    """Return the names of columns of positions and heights, if these are headings of such."""
    names = tuple(_UNIT.sub("", cell.strip().strip('"')).strip().lower() for cell in cells)
    return names if names in _POINT_NAMES else None


def _units(source: Source, headings: tuple[str, ...], options: ScanOptions) -> Array:
    factors = []
    for cell in headings:
        match = _UNIT.search(cell.strip().strip('"'))
        stated = next((part for part in match.groups() if part), "") if match else ""
        if stated and options.unit:
            raise DataFileError(
                source.path,
                f"column {cell!r} states its unit; leave unit = {options.unit!r} out.",
                code="unit-not-needed",
            )
        if not stated and not options.unit:
            raise DataFileError(
                source.path,
                f"column {cell!r} has no unit; write it as '{cell} (um)', or give unit='um'.",
                code="no-unit",
            )
        factors.append(conversion(stated or options.unit, "m", f"unit of column {cell!r}")[0])
    return np.array(factors)


def _parsed(path: str, text: str) -> _Text:
    remarks: dict[str, str] = {}
    headings: tuple[str, ...] = ()
    found: list[tuple[int, list[str]]] = []
    for number, line in enumerate(text.splitlines(), 1):
        words = line.strip(" \r\n")
        if not words.strip():
            continue
        if words.startswith("#"):
            if match := _REMARK.match(words):
                remarks[match[1].lower()] = match[2]
            continue
        cells = _cells(words)
        if not found and not headings and _points_headings(cells) is not None:
            headings = tuple(cells)
        else:
            found.append((number, cells))
    if not found:
        raise DataFileError(path, "contains no heights.", code="no-points")
    if all(len(cells) > 1 and not cells[-1] for _, cells in found):  # delimiters that close each row
        found = [(number, cells[:-1]) for number, cells in found]
    wanted = len(headings) or len(found[0][1])
    first = "the header names" if headings else "the first holds"
    for number, cells in found:
        if len(cells) != wanted:
            raise DataFileError(
                path, f"the line holds {len(cells)} numbers where {first} {wanted}.", number, code="row-length"
            )
    rows = np.array([[_number(path, cell, number) for cell in cells] for number, cells in found])
    return _Text(headings, rows, [number for number, _ in found], remarks)


def _number(path: str, cell: str, line: int) -> float:
    if cell.lower() in MISSING:
        return math.nan
    if _NUMBER.fullmatch(cell) is None:
        raise DataFileError(path, f"{cell[:40]!r} is not a number.", line, code="not-a-number")
    value = float(cell.replace(",", "."))
    if not math.isfinite(value):
        raise DataFileError(path, f"{cell[:40]!r} is not a finite number.", line, code="not-a-number")
    return value


#: Heights above this, m, were read in another unit, or are damaged.
HIGHEST = 1e3
_BETWEEN = re.compile(r"[,;\t ]+")
_NUMPY = b"\x93NUMPY"


def read_heights(path: str | Path, unit: str = "m") -> Array:
    """Return heights (nx, ny), m, of a table in a unit of length: text with a line for each x, or an .npy array."""
    factor, _ = conversion(unit, "m", "height unit")
    data = read_bytes(path, LARGEST_FILE)
    if data.startswith(_NUMPY):
        table = _numpy(data, path)
    else:
        insist_on_short_text(data, path)
        table = _text(decoded(data, path), path)
    if not np.all(np.isfinite(table)):
        raise DataFileError(
            path, "some heights are not finite numbers; fill gaps of a measurement first.", code="not-a-number"
        )
    return checked_heights(factor * table, path)


def checked_heights(heights: Array, path: object) -> Array:
    """Return heights, m, or raise `DataFileError` where they differ by more than any surface's; NaN is passed over."""
    largest = float(np.nanmax(np.abs(heights), initial=0.0))
    if largest > HIGHEST:
        raise DataFileError(
            path,
            f"holds heights of up to {largest:.3g} m, impossible for a surface; check their unit.",
            code="implausible-height",
        )
    return heights


def _numpy(data: bytes, path: str | Path) -> Array:
    array = saved_array(data, path)
    if array.ndim not in (1, 2) or array.dtype.kind not in "fiu" or array.size == 0:
        raise DataFileError(
            path,
            f"holds an array of shape {array.shape} of {array.dtype}; a table of heights is needed.",
            code="not-heights",
        )
    return np.atleast_2d(np.asarray(array, dtype=float).T).T


def _text(text: str, path: str | Path) -> Array:
    rows: list[list[float]] = []
    for number, line in enumerate(text.splitlines(), 1):
        if not (words := line.strip()) or words.startswith("#"):
            continue
        try:
            row = [float(word) for word in _BETWEEN.split(words.strip(",;"))]
        except ValueError:
            raise DataFileError(
                path, f"{words[:40]!r} is not a line of heights, plain numbers only.", number, code="not-a-number"
            ) from None
        if rows and len(row) != len(rows[0]):
            problem = f"holds {len(row)} heights where the first line holds {len(rows[0])}."
            raise DataFileError(path, problem, number, code="row-length")
        rows.append(row)
    if not rows:
        raise DataFileError(path, "contains no heights.", code="no-points")
    return np.array(rows)
