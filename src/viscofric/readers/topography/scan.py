"""The content of a file of heights before any preparation, and points x, y, z put on their grid."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from viscofric.arrays import Array, Integers
from viscofric.errors import DataFileError
from viscofric.notes import Note, setting
from viscofric.readers.source import Source

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


#: Positions belong to the same row of the grid up to this part of the distance of rows.
_SAME = 0.05
#: Positions of a line scan are even up to this part of their distance; others are interpolated.
EVEN = 0.02
#: A grid with fewer of its points than this is no grid.
_LEAST_FILLED = 0.25


def scan_of_points(
    source: Source, points: Array, options: ScanOptions, lines: list[int], notes: tuple[str, ...] = ()
) -> Scan:
    """Return points x, z or x, y, z, m (z is NaN without a reading), on their grid; `lines` are those of the file."""
    if options.spacing is not None:
        raise DataFileError(
            source.path, "contains the positions of its points; leave the spacing out.", code="spacing-not-needed"
        )
    bad = np.flatnonzero(~np.all(np.isfinite(points[:, :-1]), axis=1))
    if bad.size:
        raise DataFileError(
            source.path,
            "a position has no number; only heights may be missing.",
            lines[int(bad[0])],
            code="not-a-number",
        )
    if len(points) < 2:
        raise DataFileError(source.path, "contains one point only; a line or a grid is needed.", code="no-points")
    found = _line(source, points) if points.shape[1] == 2 else _grid(source, points)
    return replace(found, notes=(*found.notes, *notes))


def _line(source: Source, points: Array) -> Scan:
    x, z = points[np.argsort(points[:, 0], kind="stable")].T
    origin = f"read from {name_of(source)} (line scan)"
    steps = np.diff(x)
    if not np.all(steps > 0.0):
        raise DataFileError(
            source.path,
            f"two points have the same position, x = {x[:-1][steps <= 0.0][0]:.6g} m.",
            code="same-position",
        )
    mean = float(np.ptp(x)) / (len(x) - 1)
    if float(np.abs(x - x[0] - mean * np.arange(len(x))).max()) <= EVEN * mean:
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
        raise DataFileError(
            source.path,
            f"its {len(points)} points form no grid: their x and y would need one of {nx} × {ny}; a matrix of heights "
            "needs ",
            code="no-grid",
            remedy=SPACING + ", for instance.",
        )
    heights = np.full((nx, ny), math.nan)
    heights[i, j] = points[:, 2]
    taken = np.zeros((nx, ny), dtype=int)
    np.add.at(taken, (i, j), 1)
    if taken.max() > 1:
        where = np.argwhere(taken > 1)[0]
        raise DataFileError(
            source.path,
            f"two points have the same position, column {where[0]}, row {where[1]}.",
            code="same-position",
        )
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
