"""Heights of a file before any preparation: a matrix (text, NumPy), or columns of positions put on their grid."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array, Integers, Mask
from viscofric.errors import DataFileError, InputError
from viscofric.files import saved_array
from viscofric.notes import Note, Remedy, setting
from viscofric.readers.headings import Vocabulary, heading
from viscofric.readers.one_table import only_table
from viscofric.readers.source import LIKE_THOUSANDS, Source, decimal_comma
from viscofric.readers.table import MISSING, NUMBER, doubtful_point, on_doubtful_point
from viscofric.readers.tables import holds_table, lines_of
from viscofric.units import conversion

#: What to give where a file does not state it.
SPACING = setting("surface.spacing", "Spacing of points", "'5 um'")
UNIT = replace(setting("surface.unit", "Unit of heights", "'um'"), shell="--height-unit um")


@dataclass(frozen=True)
class ScanOptions:
    """What the user states about a file that does not contain it."""

    unit: str = ""  # of heights and positions; empty: the file's, or m
    spacing: tuple[float, float] | None = None  # along x and y, m
    channel: str | int | None = None  # name, or number from 0
    missing: float | None = None  # number that means no reading
    lines: str = "x"  # "x" or "y": axis along which the lines of a table or rows of an array follow


@dataclass(frozen=True, eq=False)
class Scan:
    """Heights as a file holds them."""

    heights: Array  # (nx, ny), m, NaN without a reading; (nx, 1) for a line scan
    spacing: tuple[float, float]  # along x and y, m
    origin: str  # "read from scan.sur (Digital Surf SUR), channel 'Height'"
    periodic: bool = False  # as the file states
    notes: tuple[str, ...] = ()  # further steps applied to the readings


def name_of(source: Source) -> str:
    """Return the name of a file without its folder, as histories show it."""
    return Path(source.path).name


def insist_on_need(path: str, options: ScanOptions, unit: str = "", spacing: str = "") -> None:
    """Raise `DataFileError` where the user gives a unit or a spacing that the file states, as the words say."""
    if unit and options.unit:
        raise DataFileError(path, f"{unit}; leave unit = {options.unit!r} out.", code="unit-not-needed")
    if spacing and options.spacing is not None:
        raise DataFileError(path, f"{spacing}; leave the spacing out.", code="spacing-not-needed")


#: Positions belong to the same row of the grid up to this part of the distance of rows.
_SAME = 0.05
#: Positions of a line scan are even up to this part of their distance; others are interpolated.
_EVEN = 0.02
_FEW = 6  # of fewer heights some rise evenly by chance
#: A grid with fewer of its points than this is no grid.
_LEAST_FILLED = 0.25


def scan_of_points(
    source: Source, points: Array, options: ScanOptions, lines: list[int], notes: tuple[str, ...] = ()
) -> Scan:
    """Return points x, z or x, y, z, m (z is NaN without a reading), on their grid; `lines` are those of the file."""
    insist_on_need(source.path, options, spacing="contains the positions of its points")
    bad = np.flatnonzero(~np.all(np.isfinite(points[:, :-1]), axis=1))
    if bad.size:
        problem = "a position has no number; only heights may be missing."
        raise DataFileError(source.path, problem, lines[int(bad[0])], code="not-a-number")
    if len(points) < 2:
        raise DataFileError(source.path, "contains one point only; a line or a grid is needed.", code="no-points")
    found = _line(source, points) if points.shape[1] == 2 else _grid(source, points)
    return replace(found, notes=(*found.notes, *notes))


def _line(source: Source, points: Array) -> Scan:
    x, z = points[np.argsort(points[:, 0], kind="stable")].T
    origin = f"read from {name_of(source)} (line scan)"
    steps = np.diff(x)
    if not np.all(steps > 0.0):
        problem = f"two points have the same position, x = {x[:-1][steps <= 0.0][0]:.6g} m."
        raise DataFileError(source.path, problem, code="same-position")
    mean = float(np.ptp(x)) / (len(x) - 1)
    if float(np.abs(x - x[0] - mean * np.arange(len(x))).max()) <= _EVEN * mean:
        return Scan(z[:, None], (mean, mean), origin)
    # The lower quartile of the distances: nearly nothing is lost where points are dense.
    step = float(np.quantile(steps, 0.25))
    count = int(np.ptp(x) / step) + 1
    if count > 100 * len(x):
        raise DataFileError(source.path, "its positions are too uneven for a grid.", code="no-grid")
    even = x[0] + (np.ptp(x) / (count - 1)) * np.arange(count)
    heights = np.interp(even, x, z)
    said = f"{len(x)} uneven positions interpolated linearly onto {count} even ones"
    note = Note("positions-interpolated", said, values={"positions": len(x), "even": count})
    return Scan(heights[:, None], (float(np.ptp(x)) / (count - 1),) * 2, origin, notes=(note,))


def _grid(source: Source, points: Array) -> Scan:
    (i, dx, nx), (j, dy, ny) = (_rows(source, points[:, axis], "xy"[axis]) for axis in (0, 1))
    if nx * ny > len(points) / _LEAST_FILLED:
        problem = (
            f"its {len(points)} points form no grid: their x and y would need one of {nx} × {ny}; a matrix of heights "
            "needs "
        )
        raise DataFileError(source.path, problem, code="no-grid", remedy=SPACING + ", for instance.")
    heights = np.full((nx, ny), math.nan)
    heights[i, j] = points[:, 2]
    taken = np.zeros((nx, ny), dtype=int)
    np.add.at(taken, (i, j), 1)
    if taken.max() > 1:
        where = np.argwhere(taken > 1)[0]
        problem = f"two points have the same position, column {where[0]}, row {where[1]}."
        raise DataFileError(source.path, problem, code="same-position")
    origin = f"read from {name_of(source)} (x, y, z)"
    if nx == 1:
        return Scan(heights.T, (dy, dy), origin, notes=("a line along y, read as one along x",))
    return Scan(heights, (dx, dy if ny > 1 else dx), origin)


def _rows(source: Source, positions: Array, axis: str) -> tuple[Integers, float, int]:
    """Return the row of each position, the distance of rows and how many there are."""
    values = np.sort(positions)
    extent = float(values[-1] - values[0])
    if extent == 0.0:
        return np.zeros(len(positions), dtype=np.int64), 0.0, 1
    gaps = np.diff(values)
    # Jitter within a row is far smaller than the distance of rows: the largest jump in the sizes of gaps parts them.
    step = float(gaps[gaps > 0.3 * gaps.max()].min())
    found = (positions - values[0]) / step
    for _ in range(3):  # the distance of rows from all of them, not from two neighbours
        rows = np.rint(found)
        if rows.max() < 1:
            break
        step = float(np.polyfit(rows, positions - values[0], 1)[0])
        start = float(np.mean(positions - step * rows))
        found = (positions - start) / step
    rows = np.rint(found)
    rows -= rows.min()
    if float(np.abs(found - np.rint(found)).max()) > _SAME:
        raise DataFileError(
            source.path, f"the {axis} of its points are not evenly spaced; a grid of points is needed.", code="no-grid"
        )
    return rows.astype(np.int64), step, int(rows.max()) + 1


NUMPY = b"\x93NUMPY"
_N = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?"
#: Texts of one matrix behind a head: name -> the head without marks of quotation, which states numbers of points,
#: distances or extents, units and the number for no reading.
_GRIDS = {
    "ESRI ASCII grid": rf"ncols\s+(?P<nx>\d+)\s+nrows\s+(?P<ny>\d+)\s+xll\w+\s+{_N}\s+yll\w+\s+{_N}"
    rf"\s+cellsize\s+(?P<dx>{_N})\s+(?:nodata_value\s+(?P<missing>{_N}|nan)\s+)?",
    "Surfer ASCII grid": rf"DSAA\s+(?P<nx>\d+)\s+(?P<ny>\d+)\s+(?P<x>{_N}\s+{_N})\s+(?P<y>{_N}\s+{_N})"
    rf"\s+{_N}\s+{_N}\s+",
    "SDF text": r"a(?:BCR|ISO)-1\.0\s(?>.*?NumPoints\s*=\s*(?P<nx>\d+))\s+NumProfiles\s*=\s*(?P<ny>\d+)"
    rf"\s+Xscale\s*=\s*(?P<dx>{_N})\s+Yscale\s*=\s*(?P<dy>{_N})\s+Zscale\s*=\s*(?P<scale>{_N})(?=\s)(?>.*?\n\s*\*\s*\n)",
    "Keyence CSV": rf"Date & Time(?>.*?\nXY Calibration,(?P<dx>{_N}),(?P<lateral>[^\s,]+))"
    r"(?>.*?\nHorizontal,(?P<nx>\d+))(?>.*?\nVertical,(?P<ny>\d+))(?>.*?\nUnit,(?P<unit>[^\s,]+))(?>.*?\nHeight[,\s]*?\n)",
}
#: Of Surfer, for no reading.
_BLANKED = 1.7e38
_BLANKS = re.compile(r"\s+")
_WHOLE = re.compile(r"[+-]?\d{1,15}")
#: "# Width: 10.0 µm", as Gwyddion and others write above a matrix with lines along y, or above points.
_REMARK = re.compile(r"(Width|Height|Value units|Z units|Lateral units|XY units)\s*:\s*(.+?)\s*$", re.IGNORECASE)
#: Characters of a text that may hold such remarks.
_HEAD = 5000
_SAME_REMARK = {"z units": "value units", "xy units": "lateral units"}

#: The words of tables of positions and heights.
HEIGHTS = Vocabulary(
    "a table of heights",
    {
        "x": frozenset(
            {"x", "X", "position", "position x", "x position", "x-position", "distance", "length", "lateral"}
            | {"scan length"}
            | {"weg", "tastweg", "länge", "abstand", "distance x", "longueur", "距離", "长度"}
        ),
        "y": frozenset({"y", "Y", "position y", "y position", "y-position"}),
        "height": frozenset(
            {"z", "Z", "height", "height z", "z height", "profile", "profile height", "total profile"}
            | {"elevation", "höhe"}
            | {"profil", "p-profil", "hauteur", "altitude", "altura", "altezza", "高さ", "高度"}
        ),
    },
    needed=(("x",), ("height",)),
    example="heights have e.g. 'x (um)', 'y (um)', 'z (um)'",
    key="",
)


class _Text(NamedTuple):
    """A matrix of numbers in text, (rows, columns), the line of each row, the remarks, and a doubtful point."""

    rows: Array
    lines: list[int]
    remarks: dict[str, str]
    pointed: str


def is_table(source: Source) -> bool:
    """Return whether a text is a table of numbers: columns with headings, or a matrix under remarks."""
    if source.text is None:
        return False
    if _grid_in(source.text):
        return True
    cells = _first_cells(source.text)
    is_matrix = any(cells) and all(map(_is_number, cells[1:] or cells))
    return (is_matrix and (_is_number(cells[0]) or _has_corner(source.text))) or holds_table(source, HEIGHTS)


def _first_cells(text: str) -> list[str]:
    """Return the cells of the first line that is no remark."""
    return _cells(next((line.strip() for _, line, _ in lines_of("\n".join(text.splitlines()[:200]))), ""))


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
    if found := _grid_in(source.text):
        return _grid_under(source, *found, options)
    in_remarks = "lateral units" in _remarks(source.text[:_HEAD]) and all(map(_is_number, _first_cells(source.text)))
    if not in_remarks and holds_table(source, HEIGHTS):
        return _points(source, options)
    table = _parsed(source.path, source.text, are_points=options.spacing is None)
    doubts = (on_doubtful_point(table.pointed),) if table.pointed else ()
    are_points = options.spacing is None and "width" not in table.remarks and table.rows.shape[1] in (2, 3)
    if are_points and _without_positions(table.rows)[2] is None:
        stated = [table.remarks.get(name, "") for name in ("lateral units", "value units")]
        said = f"its remarks state the units {' and '.join(map(repr, stated))}"
        insist_on_need(source.path, options, said * all(stated))
        if any(stated) and not all(stated) and not options.unit:
            what, other = ("heights", "positions") if stated[0] else ("positions", "heights")
            problem = f"states the unit of its {other} and not that of its {what}; give it by "
            raise DataFileError(source.path, problem, code="no-unit", remedy=UNIT + ".")
        across, up = (conversion(one or options.unit or "m", "m", "unit")[0] for one in stated)
        rows = np.column_stack([across * table.rows[:, :-1], up * _read(table.rows[:, -1], options)])
        assumed = Note("unit-assumed", "positions and heights assumed to be in m", values={"unit": "m"})
        doubts = doubts if options.unit or all(stated) else (assumed, *doubts)
        return scan_of_points(source, rows, options, table.lines, doubts)
    scan = _matrix(source, table.rows, options, table.remarks, "text matrix")
    return replace(scan, notes=(*scan.notes, *doubts))


def _points(source: Source, options: ScanOptions) -> Scan:
    """Read columns of positions and heights under their headings."""
    table = only_table(source, HEIGHTS)
    places = [place for what in ("x", "y", "height") if (place := table.place(what)) is not None]
    named = [table.columns[place] for place in places]
    insist_on_need(source.path, options, "its headings state their units" * all(column.unit for column in named))
    units = [column if column.unit else replace(column, unit=options.unit) for column in named]
    factors = [table.conversion(column, "m", Remedy(", or give it by ") + UNIT)[0] for column in units]
    columns = [*map(table.numbers, places[:-1]), _read(table.numbers_or_missing(places[-1]), options)]
    doubts = (on_doubtful_point(table.pointed),) if table.pointed else ()
    return scan_of_points(source, np.column_stack(columns) * factors, options, table.lines.tolist(), doubts)


def _read(heights: Array, options: ScanOptions) -> Array:
    """Return heights as printed, NaN for the number that means no reading."""
    return heights if options.missing is None else np.where(heights == options.missing, math.nan, heights)


def _matrix(source: Source, table: Array, options: ScanOptions, remarks: dict[str, str], kind: str) -> Scan:
    stated_unit = remarks.get("value units", "")
    in_unit = f"states that its heights are in {stated_unit!r}" if stated_unit else ""
    insist_on_need(source.path, options, in_unit, "states its width" * ("width" in remarks))
    unit = options.unit or stated_unit or remarks.get("corner", "m")
    factor, _ = conversion(unit, "m", "unit")
    table, notes, step = _without_positions(_read(table, options))
    if step is None:
        _insist_on_no_positions(source.path, table)
    distances = None if step is None else (factor * step[0], factor * step[1])
    heights = np.atleast_2d(table.T).T if min(np.shape(table)) > 1 or table.ndim == 1 else table.reshape(-1, 1)
    # Such remarks precede an image, whose lines follow one another along y.
    if (options.lines == "y" or "width" in remarks) and heights.shape[1] > 1:
        heights = heights.T
        distances = None if distances is None else (distances[1], distances[0])
    spacing = options.spacing or distances
    if "width" in remarks:
        width = _length(source.path, remarks["width"])
        height = _length(source.path, remarks["height"]) if "height" in remarks else width
        spacing = (width / heights.shape[0], height / heights.shape[1])
    if spacing is None:
        problem = "does not state the spacing of its points; give "
        raise DataFileError(source.path, problem, code="no-spacing", remedy=SPACING + ", for instance.")
    if not (options.unit or stated_unit):
        notes.append(Note("unit-assumed", f"heights assumed to be in {unit}", values={"unit": unit}))
    return Scan(factor * heights, spacing, f"read from {name_of(source)} ({kind})", notes=tuple(notes))


def _without_positions(table: Array) -> tuple[Array, list[Note], tuple[float, float] | None]:
    """Return a matrix without a first row and column of even positions about an empty corner, and their distances."""
    if table.ndim != 2 or min(table.shape) < 3 or not math.isnan(table[0, 0]):
        return table, [], None
    both = table[1:, 0], table[0, 1:]
    if not all(map(_rising_evenly, both)):
        return table, [], None
    said = Note("positions-in-matrix", "first row and first column, evenly spaced, taken as positions")
    return table[1:, 1:], [said], (float(np.diff(both[0]).mean()), float(np.diff(both[1]).mean()))


def _insist_on_no_positions(path: str, table: Array) -> None:
    """Refuse a matrix whose first row or column, and no other, rises evenly: numbers or positions of its lines."""
    for which, lines in (("row", table), ("column", table.T)):
        if lines.ndim != 2 or len(lines) < 3 or lines.shape[1] < _FEW:
            continue
        first, *others = _rising_evenly(lines[:, 1:])
        if first and not any(others):
            problem = (
                f"has a first {which} that rises evenly, as numbers or positions of its lines do; delete it, or leave "
                "the corner empty if the first row and column are both positions."
            )
            raise DataFileError(path, problem, code="positions-in-matrix")


def _rising_evenly(lines: Array) -> Mask:
    """Return whether the numbers of each line (last axis) rise in even steps."""
    steps = np.diff(lines)
    return np.asarray(np.all(steps > 0.0, axis=-1) & (np.ptp(steps, axis=-1) < _EVEN * steps.mean(axis=-1)))


def _is_length(unit: str) -> bool:
    try:
        return bool(unit) and bool(conversion(unit, "m", "unit"))
    except InputError:
        return False


def _length(path: str, text: str) -> float:
    match = re.fullmatch(r"([0-9.,eE+-]+)\s*(\S+)", text)
    if match is None or not NUMBER.fullmatch(match[1]) or LIKE_THOUSANDS.fullmatch(match[1]):
        raise DataFileError(path, f"{text!r} in its remarks is not a length such as '10 um'.", code="wrong-unit")
    factor, _ = conversion(match[2], "m", "width")
    return factor * float(match[1].replace(",", "."))


def _cells(line: str) -> list[str]:
    """Split a line at tabs, semicolons or commas, whichever there is first, or at blanks."""
    line = line.replace("−", "-")
    for delimiter in "\t;":
        if delimiter in line:
            return [cell.strip() for cell in line.split(delimiter)]
    words = _BLANKS.split(line.strip())
    # "0,5 1,5" is blanks between decimal commas; "0, 5, 1" and "0,5,1" are commas between numbers
    if "," not in line or (len(words) > 1 and all(map(_is_number, words))):
        return words
    return [cell.strip() for cell in line.split(",")]


def _is_number(cell: str) -> bool:
    return cell.lower() in MISSING or NUMBER.fullmatch(cell) is not None


def _has_corner(text: str) -> bool:
    """Return whether a text is a matrix with positions in its first row and column, and a label in their corner."""
    try:
        return _without_positions(_parsed("", text, are_points=False).rows)[2] is not None
    except DataFileError:
        return False


def _remarks(text: str) -> dict[str, str]:
    """Return what remarks state, such as the width, by name in lower case."""
    lines = (line for _, line, is_remark in lines_of(text, remarks=True) if is_remark)
    found = [match for line in lines if (match := _REMARK.fullmatch(line))]
    return {_SAME_REMARK.get(one[1].lower(), one[1].lower()): one[2] for one in found}


def _grid_in(text: str) -> tuple[str, re.Match[str]] | None:
    """Return the format of a text that is a matrix behind the head of a known one, and the head."""
    start = text[:_HEAD].replace('"', "").lstrip()
    heads = ((name, re.match(head, start, re.DOTALL | re.IGNORECASE)) for name, head in _GRIDS.items())
    return next(((name, head) for name, head in heads if head), None)


def _grid_under(source: Source, name: str, head: re.Match[str], options: ScanOptions) -> Scan:
    """Read the heights behind a head; lines follow one another along y, those of ESRI from its end."""
    said = {key: value for key, value in head.groupdict().items() if value is not None}
    stated = said.get("unit", "m" if "scale" in said else "")
    insist_on_need(
        source.path, options, f"states its unit, {stated}" if stated else "", "states the spacing of its points"
    )
    nx, ny = int(said["nx"]), int(said["ny"])
    text = (source.text or "").replace('"', "").lstrip()[head.end() :].partition("*")[0]
    cells = [cell for cell in re.split(r"[\s,;]+", text) if cell]
    if len(cells) != nx * ny or min(nx, ny) < 1:
        problem = f"holds {len(cells)} heights where its head names {nx} × {ny}; save the file again."
        raise DataFileError(source.path, problem, code="row-length")
    values = np.array([_number(source.path, cell, None) for cell in cells])
    missing = said.get("missing", "-9999" if name.startswith("ESRI") else "nan")
    values[(values == float(missing)) | (values >= _BLANKED)] = math.nan
    unit = stated or options.unit or "m"
    factor, along = (conversion(one, "m", "unit")[0] for one in (unit, said.get("lateral", unit)))
    extents = [np.ptp(np.array(said[axis].split(), float)) for axis in "xy" if axis in said]
    steps = [extent / max(count - 1, 1) for extent, count in zip(extents, (nx, ny), strict=False)]
    steps = steps or [float(said["dx"]), float(said.get("dy", said["dx"]))]
    heights = factor * float(said.get("scale", 1.0)) * _read(values, options).reshape(ny, nx)
    heights = heights[::-1] if name.startswith("ESRI") else heights
    assumed = Note("unit-assumed", f"positions and heights assumed to be in {unit}", values={"unit": unit})
    notes = () if stated or options.unit else (assumed,)
    return Scan(heights.T, (along * steps[0], along * steps[1]), f"read from {name_of(source)} ({name})", notes=notes)


def _parsed(path: str, text: str, *, are_points: bool) -> _Text:
    """Return the numbers of a text; `are_points`: whether two columns are positions and heights."""
    remarks = _remarks(text)
    found = [(number, _cells(line.strip(" \r\n"))) for number, line, _ in lines_of(text)]
    if not found:
        raise DataFileError(path, "contains no heights.", code="no-points")
    if all(len(cells) > 1 and not cells[-1] for _, cells in found):  # delimiters that close each row
        found = [(number, cells[:-1]) for number, cells in found]
    if {len(cells) for _, cells in found} == {1, 2}:  # "0,5" above "nan": one number with a decimal comma
        lone = all(cells[0].lower() in MISSING for _, cells in found if len(cells) == 1)
        found = [(number, [",".join(cells)]) for number, cells in found] if lone else found
    wanted = len(found[0][1])
    for number, cells in found:
        if len(cells) != wanted:
            problem = f"the line holds {len(cells)} numbers where the first holds {wanted}."
            raise DataFileError(path, problem, number, code="row-length")
    _insist_on_delimiters(path, found, are_points=are_points and "width" not in remarks)
    decimal_comma(path, ((cell, number) for number, cells in found for cell in cells if "," in cell))
    corner = found[0][1][0]
    if not _is_number(corner):  # a label in the corner of positions, perhaps with their unit: "µm", "x/y (mm)"
        unit = next(filter(_is_length, (corner, heading(corner).unit)), "")
        remarks |= {"corner": unit} if unit else {}
        found[0][1][0] = ""
    rows = np.array([[_number(path, cell, number) for cell in cells] for number, cells in found])
    lines, cells_of = [number for number, _ in found], [cells for _, cells in found]
    pointed = "" if "," in text else doubtful_point(path, cells_of, lines, range(wanted))
    return _Text(rows, lines, remarks, pointed)


def _insist_on_delimiters(path: str, found: list[tuple[int, list[str]]], *, are_points: bool) -> None:
    """Refuse whole numbers in pairs, which may be one number with a decimal comma, unless they ascend as positions."""
    if all(len(cells) == 2 and _WHOLE.fullmatch(cells[0]) and cells[1].isdecimal() for _, cells in found):
        first = [int(cells[0]) for _, cells in found]
        if not are_points or any(np.diff(first) <= 0):
            number, cells = found[0]
            problem = f"'{','.join(cells)}' may be one number with a decimal comma, or two; separate columns by "
            problem += "semicolons or tabs, or write a decimal point."
            raise DataFileError(path, problem, number, code="ambiguous-decimals")


def _number(path: str, cell: str, line: int | None) -> float:
    if cell.lower() in MISSING:
        return math.nan
    if NUMBER.fullmatch(cell) is None:
        raise DataFileError(path, f"{cell[:40]!r} is not a number.", line, code="not-a-number")
    value = float(cell.replace(",", "."))
    if not math.isfinite(value):
        raise DataFileError(path, f"{cell[:40]!r} is not a finite number.", line, code="not-a-number")
    return value


#: Heights above this, m, were read in another unit, or are damaged.
HIGHEST = 1e3


def checked_heights(heights: Array, path: object) -> Array:
    """Return heights, m, or raise `DataFileError` where they differ by more than any surface's; NaN is passed over."""
    largest = float(np.nanmax(np.abs(heights), initial=0.0))
    if largest > HIGHEST:
        problem = f"holds heights of up to {largest:.3g} m, impossible for a surface; check their unit."
        raise DataFileError(path, problem, code="implausible-height")
    return heights
