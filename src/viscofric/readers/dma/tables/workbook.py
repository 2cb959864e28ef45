"""Excel workbooks: parsed in a separate process, then read like a text table."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np

from viscofric.errors import DataFileError
from viscofric.files import insist_on_size
from viscofric.notes import Note
from viscofric.readers.dma.names import tools_in
from viscofric.readers.dma.readings import Readings
from viscofric.readers.dma.tables.delimited import DEEPEST_HEADER, header_row, quantities, table_under
from viscofric.readers.dma.tables.dma_table import read_points
from viscofric.readers.source import decimal_comma
from viscofric.units import shown_celsius

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.readers.dma.tables.delimited import NumberedRow
    from viscofric.readers.source import Source
    from viscofric.readers.table import Table

    #: Rows of cells, each a number or text, empty text where the sheet has nothing.
    Rows = list[list[float | int | str | bool]]

NAME = "Excel workbook"

#: A zip archive (.xlsx) and a compound document (.xls).
MAGIC = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1")
#: Far above the time to parse a workbook of measurements.
LONGEST_PARSE = 30.0  # s

_MODULI = {"storage modulus", "loss modulus", "complex modulus"}
_PARSER = Path(__file__).with_name("parse_workbook.py")


@dataclass(frozen=True, eq=False)
class _Workbook:
    """Rows of each sheet, and the names of those that Excel does not show."""

    sheets: dict[str, Rows]
    hidden: tuple[str, ...]


_parsed: WeakKeyDictionary[Source, _Workbook | DataFileError] = WeakKeyDictionary()


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


def sheets(source: Source) -> dict[str, Rows]:
    """Return the sheets of a workbook, in its order: numbers as float, dates and times as text, ``""`` for nothing.

    The file is parsed once, in a separate process with limited memory and time: a crafted workbook can request
    hundreds of gigabytes.  A damaged, protected or oversized workbook is a `DataFileError`.
    """
    return _workbook(source).sheets


def _workbook(source: Source) -> _Workbook:
    if source not in _parsed:
        try:
            _parsed[source] = _parse(source)
        except DataFileError as error:
            _parsed[source] = error
    found = _parsed[source]
    if isinstance(found, DataFileError):
        raise DataFileError(found.path, found.problem, code=found.code)
    return found


def _parse(source: Source) -> _Workbook:
    insist_on_size(source.data, source.path)
    # -P: modules in the script's folder must not replace those of Python
    command = [sys.executable, "-P", str(_PARSER)]
    window = getattr(subprocess, "CREATE_NO_WINDOW", 0)  # none flashes up under Windows
    try:
        done = subprocess.run(
            command, input=source.data, capture_output=True, timeout=LONGEST_PARSE, check=False, creationflags=window
        )
        answer = json.loads(done.stdout)
    except subprocess.TimeoutExpired:
        problem = f"takes longer than {LONGEST_PARSE:.0f} s to parse; save the sheet of measurements alone, or as CSV."
        raise DataFileError(source.path, problem, code="too-slow") from None
    except ValueError:  # the parser ended, usually for lack of memory
        raise DataFileError(
            source.path, "is a workbook that cannot be parsed; save it again, or as CSV.", code="damaged"
        ) from None
    except OSError as error:
        problem = f"was not read: workbooks are parsed by {sys.executable!r}, which does not start ({error.strerror}); "
        raise DataFileError(source.path, problem + "save the sheet as CSV.", code="no-parser") from None
    if "missing" in answer:
        problem = f"was not read: workbooks need {answer['missing']}, which this Python does not find; install it, or "
        raise DataFileError(source.path, problem + "save the sheet as CSV.", code="package-missing")
    if "problem" in answer:
        raise DataFileError(source.path, answer["problem"], code=answer["code"])
    return _Workbook(dict(answer["sheets"]), tuple(answer["hidden"]))


def recognises(source: Source) -> bool:
    """Return whether the file begins as an Excel workbook does."""
    return is_workbook(source)


def read(source: Source) -> Readings:
    """Return the points of all sheets with a DMA table.

    Several sheets are the temperatures of one specimen.  If their temperatures overlap, they may as well be several
    specimens, or copies, and are refused.
    """
    readings = {
        name: read_points(table, source, NAME, name, where=f"sheet {name!r}, row")
        for name, table in tables(source).items()
    }
    _insist_on_own_temperatures(source, readings)
    hidden = [name for name in _workbook(source).hidden if name in readings]
    notes = [
        Note("hidden-sheet", f"The sheet {name!r} is hidden in the workbook; it was read nevertheless.")
        for name in hidden
    ]
    whole = _joined(source, readings)
    return replace(whole, notes=(*notes, *whole.notes))


def tables(source: Source) -> dict[str, Table]:
    """Return the tables with moduli by the names of their sheets, or raise `DataFileError`."""
    found = {}
    for name, cells in sheets(source).items():
        rows = _numbered(f"{source.path}, sheet {name!r}", cells)
        header = header_row(rows)
        if header is not None:
            found[name] = (rows, header)
    if not found:
        shown = ", ".join(repr(name) for name in sheets(source)) or "none"
        raise DataFileError(
            source.path,
            "no sheet has a row that names temperature, frequency, storage and loss modulus, with their units there or "
            f"in the row below; its sheets are {shown}.",
            code="missing-columns",
        )
    # a sheet of, say, shift factors names two quantities, but no modulus
    whole = {name: one for name, one in found.items() if _MODULI & quantities(one[0][one[1]][1])}
    others = [rows[:DEEPEST_HEADER] for name, rows in sheets(source).items() if name not in found]
    tools = tools_in([str(cell) for cell in row] for rows in others for row in rows)
    tables = {
        name: table_under(f"{source.path}, sheet {name!r}", rows, header)
        for name, (rows, header) in (whole or found).items()
    }
    return {name: replace(table, tools=(*table.tools, *tools)) for name, table in tables.items()}


def _numbered(path: str, cells: Rows) -> list[NumberedRow]:
    """Return the rows that are not blank as text, with their numbers."""
    texts = ((cell, n) for n, row in enumerate(cells, start=1) for cell in row if isinstance(cell, str))
    comma = decimal_comma(path, texts)
    rows: list[NumberedRow] = []
    for number, row in enumerate(cells, start=1):
        shown = [_text(cell, comma=comma) for cell in row]
        if any(cell.strip() for cell in shown) and not shown[0].lstrip().startswith("#"):
            rows.append((number, shown))
    return rows


def _text(cell: float | str, *, comma: bool) -> str:
    """Write a cell as a text table would, with the decimal mark of the sheet's other cells."""
    if isinstance(cell, str):
        return cell
    return repr(float(cell)).removesuffix(".0").replace(".", "," if comma else ".")


def _insist_on_own_temperatures(source: Source, readings: dict[str, Readings]) -> None:
    spans = []
    for name, one in readings.items():
        known = one.temperature[np.isfinite(one.temperature)]
        if known.size:
            spans.append((float(known.min()), float(known.max()), name))
    spans.sort()
    for (low, high, name), (next_low, next_high, next_name) in pairwise(spans):
        if next_low <= high:
            both = f"{name!r} ({shown_celsius(low)} to {shown_celsius(high)} °C) and {next_name!r} "
            both += f"({shown_celsius(next_low)} to {shown_celsius(next_high)} °C)"
            problem = f"the sheets {both} each contain a DMA table and overlap; keep one of them."
            raise DataFileError(source.path, problem, code="several-tables")


def _joined(source: Source, readings: dict[str, Readings]) -> Readings:
    """Put the points of all sheets in one row."""
    names, parts = list(readings), list(readings.values())
    if len(parts) == 1:
        return parts[0]
    stating = next((part for part in parts if part.deformation is not None), parts[0])
    if any(part.deformation not in (None, stating.deformation) for part in parts):
        raise DataFileError(
            source.path,
            f"the sheets {', '.join(map(repr, names))} differ in E and G; separate them.",
            code="deformation-contradicts",
        )

    def all_of(column: str) -> Array:
        return np.concatenate([getattr(part, column) for part in parts])

    nothing = [np.full(len(part), np.nan) for part in parts]
    amplitudes = [
        none if part.strain_amplitude is None else part.strain_amplitude
        for part, none in zip(parts, nothing, strict=True)
    ]
    joined = Note(
        "sheets-as-temperatures",
        f"The sheets {', '.join(map(repr, names))} were read as temperatures of one specimen.",
    )
    return Readings(
        source=source.path,
        format=NAME,
        places=tuple(place for part in parts for place in part.places),
        temperature=all_of("temperature"),
        angular_frequency=all_of("angular_frequency"),
        storage_modulus=all_of("storage_modulus"),
        loss_modulus=all_of("loss_modulus"),
        deformation=stating.deformation,
        said_by=stating.said_by,
        strain_amplitude=np.concatenate(amplitudes) if any(p.strain_amplitude is not None for p in parts) else None,
        lacks_unit=any(part.lacks_unit for part in parts),
        notes=(joined, *dict.fromkeys(note for part in parts for note in part.notes)),
    )
