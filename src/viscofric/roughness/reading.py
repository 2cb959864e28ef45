"""The verb: read heights of a surface from a file."""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike
from typing import Any, Literal

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import DataFileError, InputError, check_choice, wrong_argument
from viscofric.files import LARGEST_FILE, file_path, insist_on_short_text, read_bytes
from viscofric.notes import Note, Remedy
from viscofric.readers.source import Source
from viscofric.readers.topography.package import read_with_package
from viscofric.readers.topography.tables import (
    NUMPY,
    Scan,
    ScanOptions,
    checked_heights,
    is_table,
    read_array,
    read_text_table,
)
from viscofric.roughness.topography import Topography
from viscofric.units import Quantity, as_printed, conversion, two_lengths

#: Heights of a scan that lie further apart, m, were probably read in another unit.
_LARGE_EXTENT = 0.1
#: A number for no reading is further from all heights than so many times their range; dust and scratches are not.
_FAR_OFF = 100.0
_AS_MISSING = Remedy(
    "; if they are no readings, give their number in the file by missing=.",
    "; if they are no readings, write nan in their place.",
    "; if they are no readings, give their number in the file as missing under [surface].",
    field="surface.missing",
)


def read_topography(
    path: str | PathLike[str],
    *,
    unit: str = "",
    spacing: Quantity | tuple[Quantity, Quantity] | None = None,
    channel: str | int | None = None,
    missing: float | None = None,
    lines: Literal["x", "y"] = "x",
) -> Topography:
    """Read heights of a surface, or along a line, from a file.

    The format is recognised by content, not by the file's name.  Plain tables are read by viscofric itself: a matrix of
    heights as text (also grids of Surfer and ESRI, SDF as text, Keyence's CSV) or as an .npy file, and columns x, z or
    x, y, z, each with its unit in the heading (as in ``x (um)``) or all of them in `unit`.  Files of instruments (some
    forty formats: SUR, SDF, X3P, OPDX, PLU …) are read by the package SurfaceTopography, which ``pip install
    'viscofric[surfaces]'`` brings along, in a process of their own with limits of time (120 s) and memory (6 GB).  Text
    may have 50 MB, other files 200 MB.

    Parameters
    ----------
    path : str or path
        The file.
    unit : str
        Of the heights, and of the positions where the file holds them; only where the file does not say it.  A matrix
        without unit is in m.
    spacing : float, str, pint.Quantity, or two of them, optional
        Distance of neighbouring points, m, along x and y; only where the file does not say it.
    channel : str or int, optional
        Which of several maps of heights in a file, by its name, or its number counted from 0.
    missing : float, optional
        Number that stands for a point without a reading, as the file writes it, such as -9999.
    lines : {"x", "y"}
        Axis along which the lines of a text matrix, or the rows of an array, follow one another.

    Returns
    -------
    Topography
        With NaN where there is no reading; see its `fill`.

    Raises
    ------
    DataFileError
        If the file cannot be read, a unit or spacing is missing or given twice, a cell is no number, or points lie
        on no grid.
    InputError
        If an argument cannot be used.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> np.savetxt("scan.csv", [[0.0, 1.0, 0.5], [0.2, 0.8, 0.1]], delimiter=",")
    >>> scan = vf.read_topography("scan.csv", unit="um", spacing="2 um")
    >>> scan.heights.shape, f"{np.ptp(scan.heights):.1e} m"
    ((2, 3), '1.0e-06 m')
    """
    steps = None if spacing is None else two_lengths(spacing)
    gap = None if missing is None else as_printed(missing, "missing")
    scan = _read_scan(path, ScanOptions(unit, steps, channel, gap, lines))
    heights = checked_heights(scan.heights, path)
    notes = list(scan.notes)
    if (extent := float(np.nanmax(heights, initial=-np.inf) - np.nanmin(heights, initial=np.inf))) > _LARGE_EXTENT:
        said = f"heights lie up to {extent:.3g} m apart, more than scans of surfaces have: check their unit"
        notes.append(Note("implausible-heights", said))
    notes += [note for extreme in (np.nanmin, np.nanmax) if (note := _far_off(heights, extreme)) is not None]
    try:
        found = Topography(heights, scan.spacing, scan.periodic, file_path(path).stem, (scan.origin, *notes))
    except InputError as error:
        raise DataFileError(path, error.note) from None
    if found.missing == found.heights.size:
        raise DataFileError(path, "contains no heights: no point has a reading.", code="no-points")
    return found


def _read_scan(path: str | PathLike[str], options: ScanOptions) -> Scan:
    """Read a file of heights, whose format is recognised by its content."""
    check_choice(options.lines, "lines", "x", "y")
    if not isinstance(options.unit, str):
        raise wrong_argument("unit", options.unit, "must be text, such as 'um'.", "not-text")
    if options.unit:
        conversion(options.unit, "m", "unit")
    if not (options.channel is None or isinstance(options.channel, (str, int))):
        raise wrong_argument("channel", options.channel, "must be the name of a channel or its number.", "no-channel")
    file = str(file_path(path))
    source = Source(file, read_bytes(file, LARGEST_FILE))
    if not source.data:
        raise DataFileError(file, "is empty.", code="empty")
    try:
        plain = source.data.startswith(NUMPY) or is_table(source)
        if plain and options.channel not in (None, 0):
            raise DataFileError(
                file,
                f"contains one field of heights, without a name; leave channel = {options.channel!r} out.",
                code="no-channel",
            )
        if source.data.startswith(NUMPY):
            return read_array(source, options)
        if plain:
            insist_on_short_text(source.data, file)
        return read_text_table(source, options) if plain else read_with_package(source, options)
    except DataFileError:
        raise
    except InputError as error:  # the file's unit is not one of length
        raise DataFileError(file, error.note) from None


def _far_off(heights: Array, extreme: Callable[[Array], Any]) -> Note | None:
    """Return a note on an extreme height that looks like the number for no reading."""
    if not np.isfinite(heights).any():
        return None
    value = float(extreme(heights))
    others = heights[np.isfinite(heights) & (heights != value)]
    gap = 0.0 if others.size == 0 else float(np.abs(others - value).min())
    if not (others.size and gap > _FAR_OFF * float(np.ptp(others)) > 0.0):
        return None
    count = int(np.count_nonzero(heights == value))
    held = "1 height of" if count == 1 else f"{count} heights of"
    said = f"{held} {value:.6g} m {'lies' if count == 1 else 'lie'} far from all others"
    return Note("missing-suspected", said, remedy=_AS_MISSING, values={"height": value, "count": count})
