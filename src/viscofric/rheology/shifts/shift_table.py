"""Text tables of shift factors, viscofric's own and other programs': temperatures with log10 aT or aT."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from os import PathLike

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import DataFileError
from viscofric.files import file_path, write_atomically
from viscofric.notes import Note
from viscofric.units import CELSIUS_ZERO

#: Heading without blanks and marks -> log10 α per unit of the column; None for α itself.
_SHIFTS: dict[str, float | None] = {
    **{log + name: 1.0 for log in ("log", "log10", "lg") for name in ("at", "alpha", "alphat", "shiftfactor", "shift")},
    **{"ln" + name: 1.0 / math.log(10.0) for name in ("at", "alpha", "alphat", "shiftfactor")},
    **dict.fromkeys(("at", "alpha", "alphat", "α", "shiftfactor"), None),
}
_LOGARITHMS = ("log", "log10", "lg", "ln")
_TEMPERATURES = ("t", "temp", "temperature")
_UNITS = {"c": (1.0, CELSIUS_ZERO), "k": (1.0, 0.0), "f": (5.0 / 9.0, CELSIUS_ZERO - 160.0 / 9.0)}
#: Beyond this, α or 1/α over- or underflows.
_LARGEST_LOGARITHM = 300.0

_TITLE = "viscofric shift factors"
_REFERENCE = re.compile(r"reference\s*\((?P<unit>[^)]*)\)\s*:\s*(?P<number>[-+0-9.eE]+)\s*$")
_NOTE = re.compile(r"#\s*note:\s*(?P<text>.*)")
# "T_C", "temperature (degC)", "T [°C]", "log_aT (-)"
_HEADING = re.compile(r"(?P<name>.*?)\s*(?:[(\[]\s*(?P<unit>[^()\[\]]*)\s*[)\]]|_(?P<letter>[CKF]))?")
_COVARIANCE = re.compile(r"cov\s*(\d+)")


@dataclass(frozen=True, eq=False)
class ShiftTable:
    """Content of a file of shift factors, in the order of its rows."""

    temperatures: Array  # (n,), K
    log10_values: Array  # (n,), log10 α, or log10 of 1/α where the file holds that
    reference: float | None = None  # K, where α is 1, if stated
    covariance: Array | None = None  # (n, n), of log10_values, if stated
    notes: tuple[str, ...] = ()  # saved with the factors


@dataclass
class _Lines:
    """The lines of a text table: headings, an optional row of units, rows of cells, comments."""

    headings: list[str] = field(default_factory=list)
    units: list[str] = field(default_factory=list)
    rows: list[tuple[int, list[str]]] = field(default_factory=list)
    reference: float | None = None
    notes: list[str] = field(default_factory=list)


def read_shift_table(text: str, path: str) -> ShiftTable:
    """Read a text table; DataFileError names `path` if there is no such table, or a cell is not a finite number."""
    lines = _lines(text, path)
    names, units = zip(*(_name_and_unit(heading) for heading in lines.headings), strict=True)
    if lines.units:
        units = tuple(below.strip(" ()[]") or beside for below, beside in zip(lines.units, units, strict=True))
    at = [place for place, name in enumerate(names) if name in _TEMPERATURES]
    of = [place for place, name in enumerate(names) if name in _SHIFTS]
    if len(at) != 1 or len(of) != 1:
        problem = "a table of shift factors has one column of temperatures, such as 'T_C', and one of 'log10 aT' or "
        problem += f"'aT'; this one has {', '.join(repr(heading) for heading in lines.headings)}"
        missing = [what for what, places in (("temperature", at), ("log10 shift factor", of)) if len(places) != 1]
        headings = {"headings": lines.headings, "missing": missing}
        raise DataFileError(path, Note("missing-columns", problem, values=headings))
    cells = _Cells(path, lines)
    factor, offset = _temperature_unit(path, units[at[0]])
    values = logarithms(path, cells.column(of[0]), _SHIFTS[names[of[0]]], [line for line, _ in lines.rows])
    kelvin = factor * cells.column(at[0]) + offset
    return ShiftTable(kelvin, values, lines.reference, _covariance(names, cells), tuple(lines.notes))


def logarithms(path: str, values: Array, scale: float | None, rows: Sequence[int]) -> Array:
    """Return log10 α (n,) of a column: `scale` for one of its units, None where it holds α itself."""
    if scale is None:
        if np.any(values <= 0.0):
            problem = "a shift factor aT must be above zero; name the column 'log10 aT' if it holds logarithms."
            raise DataFileError(path, problem, rows[int(np.argmax(values <= 0.0))], code="not-positive")
        values, scale = np.log10(values), 1.0
    if np.any(np.abs(values) > _LARGEST_LOGARITHM):
        row = rows[int(np.argmax(np.abs(values) > _LARGEST_LOGARITHM))]
        raise DataFileError(
            path, "a logarithm of a shift factor beyond 300 is none of a material.", row, code="out-of-range"
        )
    return np.asarray(scale * values)


def _lines(text: str, path: str) -> _Lines:
    lines, mark = _Lines(), ""
    for number, line in enumerate(text.splitlines(), start=1):
        if line.lstrip().startswith("#"):
            _comment(lines, line, path, number)
            continue
        if not line.strip():
            continue
        mark = mark or max("\t;,", key=line.count)
        cells = [cell.strip() for cell in line.split(mark)]
        if not lines.headings:
            lines.headings = [cell.strip('"') for cell in cells]
            continue
        while len(cells) > len(lines.headings) and not cells[-1]:
            cells.pop()
        if len(cells) != len(lines.headings):
            problem = f"the row has {len(cells)} cells where the header names {len(lines.headings)} columns."
            raise DataFileError(path, problem, number, code="row-length")
        if not lines.rows and not lines.units and not any(any(sign.isdigit() for sign in cell) for cell in cells):
            lines.units = cells
        else:
            lines.rows.append((number, cells))
    if not lines.rows:
        raise DataFileError(path, "contains no table; expected headings and rows of numbers.", code="no-table")
    return lines


def _comment(lines: _Lines, line: str, path: str, number: int) -> None:
    """Read a comment of a saved file; those of other programs are ignored."""
    if (note := _NOTE.fullmatch(line.strip())) is not None:
        lines.notes.append(note["text"])
    elif (stated := _REFERENCE.search(line)) is not None:
        lines.reference = _stated(path, stated, number)


def _stated(path: str, match: re.Match[str], number: int) -> float:
    factor, offset = _temperature_unit(path, match["unit"])
    try:
        value = float(match["number"])
    except ValueError:
        raise DataFileError(path, f"{match['number']!r} is no temperature.", number, code="not-a-number") from None
    return factor * value + offset


def _name_and_unit(heading: str) -> tuple[str, str]:
    match = _HEADING.fullmatch(heading.strip())
    name, unit = (heading, "") if match is None else (match["name"], match["unit"] or match["letter"] or "")
    covariance = _COVARIANCE.fullmatch(name.lower())
    plain = re.sub(r"[\s_().·-]", "", name.lower())
    if unit.lower() == "t" or plain in _LOGARITHMS:  # "log a(T)", "log10(aT)": no unit in brackets
        return plain + re.sub(r"[\s_]", "", unit.lower()), ""
    return (f"cov {int(covariance[1])}" if covariance else plain), unit


def _temperature_unit(path: str, unit: str) -> tuple[float, float]:
    plain = re.sub(r"[°\s]|deg|℃", lambda one: "c" if one.group() == "℃" else "", unit.strip()).lower()
    plain = {"celsius": "c", "kelvin": "k"}.get(plain, plain)
    if plain not in _UNITS:
        shown = f"the unit {unit!r}" if unit else "no unit"
        raise DataFileError(
            path, f"the temperatures have {shown}; write 'T_C' or 'T (K)' above them, or C below T.", code="no-unit"
        )
    return _UNITS[plain]


@dataclass
class _Cells:
    """The numbers of a table."""

    path: str
    lines: _Lines

    def column(self, place: int) -> Array:
        return np.array([self._number(row[place], line, self.lines.headings[place]) for line, row in self.lines.rows])

    def _number(self, cell: str, line: int, heading: str) -> float:
        try:
            value = float(cell.replace(",", "."))
        except ValueError:
            value = math.nan
        if not math.isfinite(value) or "_" in cell:
            raise DataFileError(
                self.path, f"{cell!r} in column {heading!r} is not a finite number.", line, code="not-a-number"
            )
        return value


def _covariance(names: tuple[str, ...], cells: _Cells) -> Array | None:
    """Return the covariance that the table states, in full or by standard errors, or None."""
    size = len(cells.lines.rows)
    numbered = [name for name in names if name.startswith("cov ")]
    if numbered:
        if set(numbered) != {f"cov {place}" for place in range(1, size + 1)} or len(numbered) != size:
            problem = f"the covariance must have the columns cov 1 to cov {size}, one for each row."
            raise DataFileError(cells.path, problem, code="missing-columns")
        return np.column_stack([cells.column(names.index(f"cov {place}")) for place in range(1, size + 1)])
    if "standarderror" in names:
        return np.diag(cells.column(names.index("standarderror")) ** 2)
    return None


def write_shift_table(table: ShiftTable, path: str | PathLike[str]) -> None:
    """Write (or overwrite) a UTF-8 text table that `read_shift_table` reads unchanged; DataFileError if it cannot."""
    assert table.reference is not None
    assert table.covariance is not None
    text = io.StringIO()
    text.write(f"# {_TITLE}\n# reference (degC): {_in_celsius(table.reference)}\n")
    text.writelines(f"# note: {' '.join(note.split())}\n" for note in table.notes)
    rows = csv.writer(text, lineterminator="\n")
    size = table.temperatures.size
    numbered = [f"cov {place}" for place in range(1, size + 1)]
    rows.writerow(["temperature (degC)", "log10 shift factor", "standard error", *numbered])
    errors = np.sqrt(np.diag(table.covariance))
    columns = (table.temperatures, table.log10_values, errors, table.covariance)
    for kelvin, value, error, covariance in zip(*columns, strict=True):
        rows.writerow([_in_celsius(kelvin), *(repr(float(number)) for number in (value, error, *covariance))])
    write_atomically(file_path(path), text.getvalue().encode(), make_folder=False)


def _in_celsius(kelvin: float) -> str:
    # The difference and its inverse are exact between half and double of 273.15 (Sterbenz).
    return repr(float(kelvin) - CELSIUS_ZERO)
