"""Excel workbooks, parsed in a separate process: sheets as rows of cells."""

from __future__ import annotations

import sys
from dataclasses import dataclass, replace
from weakref import WeakKeyDictionary

from viscofric.errors import DataFileError
from viscofric.files import insist_on_size
from viscofric.processes import LimitedProcess
from viscofric.readers.parse_workbook import parsed
from viscofric.readers.source import Source

#: Rows of cells, each a number or text, empty text where the sheet has nothing.
Rows = list[list[float | int | str | bool]]


#: A zip archive (.xlsx) and a compound document (.xls).
MAGIC = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1")
#: Far above the time to parse a workbook of measurements.
LONGEST_PARSE = 30.0  # s
LARGEST_MEMORY = 3_000_000_000  # bytes
_APART = LimitedProcess(LONGEST_PARSE, LARGEST_MEMORY, needed=parsed.__module__)


@dataclass(frozen=True, eq=False)
class Workbook:
    """Rows of each sheet, and the names of those that Excel does not show."""

    sheets: dict[str, Rows]
    hidden: tuple[str, ...]


_parsed: WeakKeyDictionary[Source, Workbook | DataFileError] = WeakKeyDictionary()


def is_workbook(source: Source) -> bool:
    """Return whether the file begins as an Excel workbook does."""
    return source.data.startswith(MAGIC)


def sheet_names(source: Source) -> tuple[str, ...]:
    """Return the names of the sheets, none if the file is no workbook that can be read; never raises."""
    if not is_workbook(source):
        return ()
    try:
        return tuple(sheets(source))
    except DataFileError:
        return ()


def sheet_texts(source: Source) -> dict[str, Source]:
    """Return the sheets of a workbook as tab-separated text, for formats that a spreadsheet was made from."""
    return {
        name: replace(source, path=f"{source.path}, sheet {name!r}", data=_as_text(rows).encode())
        for name, rows in sheets(source).items()
        if source.sheet in ("", name)
    }


def _as_text(rows: Rows) -> str:
    lines = []
    for row in rows:
        cells = (" ".join(one.split()) if isinstance(one, str) else repr(float(one)).removesuffix(".0") for one in row)
        line = "\t".join(cells)
        bare = line.rstrip("\t")
        lines.append(line if "\t" in bare else bare)  # a row of one cell is a line of text
    return "\n".join(lines) + "\n"


def sheets(source: Source) -> dict[str, Rows]:
    """Return the sheets of a workbook, in its order: numbers as float, dates and times as text, ``""`` for nothing."""
    # The file is parsed once, in a separate process with limited memory and time: a crafted workbook can request
    # hundreds of gigabytes. A damaged, protected or oversized workbook is a `DataFileError`.
    return opened(source).sheets


def opened(source: Source) -> Workbook:
    """Return the whole workbook; see `sheets`."""
    if source not in _parsed:
        try:
            _parsed[source] = _parse(source)
        except DataFileError as error:
            _parsed[source] = error
    found = _parsed[source]
    if isinstance(found, DataFileError):
        raise DataFileError(found.path, found.problem, code=found.code)
    return found


def _parse(source: Source) -> Workbook:
    insist_on_size(source.data, source.path)
    try:
        sheets, hidden = _APART.call(parsed, path=source.path, data=source.data)
    except TimeoutError:
        problem = f"takes longer than {LONGEST_PARSE:.0f} s to parse; save the sheet of measurements alone, or as CSV."
        raise DataFileError(source.path, problem, code="too-slow") from None
    except MemoryError:  # the process ended, usually for lack of memory
        raise DataFileError(
            source.path, "is a workbook that cannot be parsed; save it again, or as CSV.", code="damaged"
        ) from None
    except OSError as error:
        problem = f"was not read: workbooks are parsed by {sys.executable!r}, which does not start ({error.strerror}); "
        raise DataFileError(source.path, problem + "save the sheet as CSV.", code="no-parser") from None
    return Workbook(sheets, tuple(hidden))
