"""Heights of a surface as plain numbers: a text table, or an array that NumPy saved."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import DataFileError
from viscofric.files import LARGEST_FILE, decoded, insist_on_short_text, read_bytes, saved_array
from viscofric.units import conversion

if TYPE_CHECKING:
    from pathlib import Path

    from viscofric.arrays import Array


#: Heights above this, m, were read in another unit, or are damaged.
HIGHEST = 1e3
_BETWEEN = re.compile(r"[,;\t ]+")
_NUMPY = b"\x93NUMPY"


def read_heights(path: str | Path, unit: str = "m") -> Array:
    """Read a table of heights.

    Parameters
    ----------
    path : str or Path
        Text with one line for each position along x and numbers parted by commas, semicolons, tabs or blanks (lines
        that begin with # are comments), or an .npy file with a one- or two-dimensional array.
    unit : str
        Of the heights.

    Returns
    -------
    (nx, ny) array
        Heights, m.

    Raises
    ------
    DataFileError
        If the file cannot be read, a line holds something else than numbers, or lines are not equally long.
    InputError
        If the unit is not one of length.
    """
    factor, _ = conversion(unit, "m", "height unit")
    data = read_bytes(path, LARGEST_FILE)
    if data.startswith(_NUMPY):
        table = _numpy(data, path)
    else:
        insist_on_short_text(data, path)
        table = _text(decoded(data, path), path)
    if not np.all(np.isfinite(table)):
        raise DataFileError(path, "some heights are not finite numbers; fill gaps of a measurement first.")
    return checked_heights(factor * table, path)


def checked_heights(heights: Array, path: object) -> Array:
    """Return heights, m, or raise `DataFileError` where they differ by more than any surface's; NaN is passed over."""
    largest = float(np.nanmax(np.abs(heights), initial=0.0))
    if largest > HIGHEST:
        raise DataFileError(path, f"holds heights of up to {largest:.3g} m, which no surface has; check their unit.")
    return heights


def _numpy(data: bytes, path: str | Path) -> Array:
    array = saved_array(data, path)
    if array.ndim not in (1, 2) or array.dtype.kind not in "fiu" or array.size == 0:
        raise DataFileError(
            path, f"holds an array of shape {array.shape} of {array.dtype}; a table of heights is wanted."
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
            raise DataFileError(path, f"{words[:40]!r} is not a line of heights, plain numbers only.", number) from None
        if rows and len(row) != len(rows[0]):
            problem = f"holds {len(row)} heights where the first line holds {len(rows[0])}."
            raise DataFileError(path, problem, number)
        rows.append(row)
    if not rows:
        raise DataFileError(path, "holds no heights.")
    return np.array(rows)
