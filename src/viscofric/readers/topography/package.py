"""Files of profilometers, microscopes and scanners, read by the package SurfaceTopography (an extra)."""

from __future__ import annotations

import contextlib
import io
import math
import sys
import warnings
import zipfile
from dataclasses import replace
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import DataFileError, InputError, not_imported
from viscofric.files import insist_on_size
from viscofric.processes import LimitedProcess
from viscofric.readers.source import Source
from viscofric.readers.topography.tables import (
    SPACING,
    UNIT,
    Scan,
    ScanOptions,
    insist_on_need,
    name_of,
    scan_of_points,
)
from viscofric.readers.workbook import is_workbook, sheets
from viscofric.units import conversion

#: The package trusts the header of a file, so that reading a crafted one may never end or need any memory.
LONGEST_READ = 120.0  # s; 190 MB take 10 s
LARGEST_MEMORY = 6_000_000_000  # bytes
_APART = LimitedProcess(LONGEST_READ, LARGEST_MEMORY, needed=__name__)
_BY_PACKAGE = (
    "is neither a table of numbers nor a NumPy array; formats of instruments are read by the package "
    "SurfaceTopography, but {why}."
)
_UNKNOWN = (
    "has no known format for heights of a surface; save a matrix of numbers, with # before lines of text, or columns "
    "x (um), y (um), z (um)."
)
#: Elevations of the globe without a header: any file of a square's size would be recognised as such.
_BY_SIZE = ("hgt",)
#: Text whose words the package passes over, and with them the units of headings: read if the user states all units.
_OF_TEXT = ("asc", "xyz")
#: Of workbooks that a Mitutoyo SurfTest writes, of one line scan each.
_CONTENTS, _LONGEST_CONTENTS = "xl/workbook.xml", 1_000_000  # bytes
_TESTER_SHEETS = ("DATA", "Certificate")
_MOST_CELLS = 500_000


def read_with_package(source: Source, options: ScanOptions) -> Scan:
    """Read a file in any format that SurfaceTopography recognises by its content, in a process with limits."""
    insist_on_size(source.data, source.path)
    _insist_on_small_workbook(source)
    if find_spec("SurfaceTopography") is None:
        why = "SurfaceTopography is not installed: pip install 'viscofric[surfaces]'"
        raise DataFileError(source.path, _BY_PACKAGE.format(why=why), code="package-missing")
    try:
        _APART.call(load_package)  # on a busy machine that may take longer than reading
        found = _APART.call(read_here, source=Source(source.path, source.data), options=options)
    except TimeoutError:
        why = f"takes longer than {LONGEST_READ:.0f} s to read"
    except MemoryError:
        why = f"takes more than {LARGEST_MEMORY / 1e9:.0f} GB of memory to read"
    except OSError as error:
        why = f"was not read: such files are read by {sys.executable!r}, which does not start ({error.strerror})"
    else:
        assert isinstance(found, Scan)
        return found
    raise DataFileError(
        source.path, f"{why}; save its heights as a matrix of numbers (CSV or .npy).", code="reading-failed"
    )


def load_package() -> None:
    """Import the package if possible; else `read_here` raises."""
    with warnings.catch_warnings(), contextlib.suppress(Exception):
        warnings.simplefilter("ignore")
        import_module("SurfaceTopography")


def read_here(source: Source, options: ScanOptions) -> Scan:
    """Read a file in this process, without limits of time and memory; see `read_with_package`."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of missing MPI at import, and of its own dependencies
        try:
            from SurfaceTopography import open_topography  # type: ignore[import-untyped]
            from SurfaceTopography.Exceptions import CannotDetectFileFormat  # type: ignore[import-untyped]
        except Exception as error:  # noqa: BLE001 - of its own imports
            why = not_imported("SurfaceTopography", error)
            raise DataFileError(source.path, _BY_PACKAGE.format(why=why), code="package-missing") from None
        try:
            with open_topography(io.BytesIO(source.data)) as reader:
                return _scan(source, reader, options)
        except (InputError, MemoryError):
            raise
        except CannotDetectFileFormat:
            raise DataFileError(source.path, _UNKNOWN, code="unknown-format") from None
        except Exception as error:  # noqa: BLE001 - a damaged file makes the package raise anything
            reason = " ".join(str(error).split()).rstrip(".") or type(error).__name__
            raise DataFileError(
                source.path, f"cannot be read as heights of a surface ({reason[:200]}).", code="damaged"
            ) from None


def _insist_on_small_workbook(source: Source) -> None:
    """Refuse workbooks except those of the one tester that the package reads, which holds sheets in memory."""
    if not is_workbook(source) or _CONTENTS.encode() not in source.data:
        return
    try:
        with zipfile.ZipFile(io.BytesIO(source.data)) as archive, archive.open(_CONTENTS) as contents:
            listed = contents.read(_LONGEST_CONTENTS)
    except Exception:  # noqa: BLE001 - a damaged archive raises anything
        raise DataFileError(source.path, "is a damaged workbook.", code="damaged") from None
    if not all(f'name="{name}"'.encode() in listed for name in _TESTER_SHEETS):  # before it takes time to parse
        raise DataFileError(
            source.path, "is a workbook, but not one of heights; save the sheet of heights as CSV.", code="not-heights"
        )
    held = sheets(source)
    cells = sum(len(row) for rows in held.values() for row in rows)
    if cells > _MOST_CELLS:
        raise DataFileError(
            source.path, f"holds {cells} cells, more than a line scan has; save it as CSV.", code="too-large"
        )


def _scan(source: Source, reader: Any, options: ScanOptions) -> Scan:
    if reader.format() in _BY_SIZE:
        raise DataFileError(source.path, _UNKNOWN, code="unknown-format")
    channel = _channel(source, reader, options.channel)
    if channel.unit is None and reader.format() in _OF_TEXT and not (options.unit and options.spacing):
        raise DataFileError(source.path, _UNKNOWN, code="unknown-format")
    given: dict[str, Any] = {}
    if channel.unit is None:
        if not options.unit:
            problem = "does not state the unit of its heights; give "
            raise DataFileError(source.path, problem, code="no-unit", remedy=UNIT + ", for instance.")
        given["unit"] = options.unit
    insist_on_need(
        source.path, options, "" if channel.unit is None else f"states that its heights are in {channel.unit!r}"
    )
    factor, _ = conversion(str(channel.unit or options.unit), "m", "unit")
    if channel.physical_sizes is None:
        if options.spacing is None:
            problem = "does not state the spacing of its points; give "
            raise DataFileError(source.path, problem, code="no-spacing", remedy=SPACING + ".")
        points = channel.nb_grid_pts
        given["physical_sizes"] = tuple(n * d / factor for n, d in zip(points, options.spacing, strict=False))
    else:
        insist_on_need(source.path, options, spacing="states the spacing of its points")
    measured = channel.topography(**given)
    origin = f"read from {name_of(source)} ({reader.name()}), channel {channel.name!r}"
    heights: Array = np.ma.filled(np.ma.asarray(measured.heights(), dtype=float), math.nan)
    if options.missing is not None:
        heights = np.where(np.isclose(heights, options.missing, rtol=1e-12, atol=0.0), math.nan, heights)
    heights = factor * heights
    if measured.dim == 1:
        return _line(source, measured, heights, factor, origin)
    steps = tuple(factor * float(step) for step in measured.pixel_size)
    return Scan(heights, (steps[0], steps[1]), origin, periodic=bool(measured.is_periodic))


def _line(source: Source, measured: Any, heights: Array, factor: float, origin: str) -> Scan:
    if measured.is_uniform:
        step = factor * float(measured.pixel_size[0])
        return Scan(heights[:, None], (step, step), origin, periodic=bool(measured.is_periodic))
    x = factor * np.asarray(measured.positions(), dtype=float)
    found = scan_of_points(source, np.stack([x, heights], axis=1), ScanOptions(), list(range(len(x))))
    return replace(found, origin=origin)


def _channel(source: Source, reader: Any, wanted: str | int | None) -> Any:
    heights = [one for one in reader.channels if one.is_height_channel] or list(reader.channels)
    names = ", ".join(repr(one.name) for one in heights)
    if not heights:
        raise DataFileError(source.path, "contains no heights.", code="not-heights")
    if wanted is None:
        default = reader.default_channel
        return default if any(default is one for one in heights) else heights[0]
    if isinstance(wanted, int) and 0 <= wanted < len(heights):
        return heights[wanted]
    found = [one for one in heights if one.name == wanted]
    if not found:
        raise DataFileError(
            source.path, f"has no channel {wanted!r} of heights; its channels are {names}.", code="no-channel"
        )
    return found[0]
