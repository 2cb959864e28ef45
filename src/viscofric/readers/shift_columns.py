"""Columns of shift factors in workbooks, and under headings that the user names."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from viscofric.readers.dma.names import TEMPERATURE
from viscofric.readers.headings import Vocabulary
from viscofric.readers.one_table import one_table
from viscofric.readers.tables import name_columns

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.readers.source import Source

_NAMES = ("at", "a", "alpha", "alphat", "alpha t", "shift factor", "shift", "horizontal shift")
#: Quantity -> log10 α for one of its units; None for α itself.
_SCALES: dict[str, float | None] = {
    "log10 shift factor": 1.0,
    "ln shift factor": 1.0 / math.log(10.0),
    "shift factor": None,
}

#: The words of tables of shift factors.
SHIFT_FACTORS = Vocabulary(
    "a table of shift factors",
    {
        "temperature": TEMPERATURE,
        "log10 shift factor": frozenset(f"{log} {name}" for log in ("log10", "log", "lg") for name in _NAMES),
        "ln shift factor": frozenset(f"ln {name}" for name in _NAMES),
        "shift factor": frozenset({"aT", "α", "at", "alpha", "shift factor", "horizontal shift factor"}),
        "standard error": frozenset({"standard error", "std error", "uncertainty"}),
    },
    needed=(("temperature",), ("log10 shift factor", "ln shift factor", "shift factor")),
    example="a table of shift factors has 'temperature (degC)' and 'log10 aT' or 'aT'",
    key="material.shift_factor_columns",
    offered=(("temperature", "degC"), ("log10 shift factor", ""), ("shift factor", ""), ("standard error", "")),
)


class ShiftColumns(NamedTuple):
    """Columns of a table of shift factors, (n,) each."""

    temperatures: Array  # K
    values: Array  # as printed
    scale: float | None  # log10 α for one of them, None where they are α itself
    standard_error: Array | None  # of log10 α
    lines: list[int]


def shift_columns(source: Source) -> ShiftColumns:
    """Return the shift factors of a workbook, or of a text whose headings the user names."""
    table = one_table(source, SHIFT_FACTORS)
    missing = SHIFT_FACTORS.missing(column.quantity for column in table.columns)
    if missing:
        problem = f"there is no column of the {' and the '.join(missing)}; there are {table.headings()}"
        raise table.refused("missing-columns", problem, name_columns(SHIFT_FACTORS.key, missing), missing)
    places = {what: table.place(what) for what in SHIFT_FACTORS.quantities}
    at, error = places["temperature"], places["standard error"]
    name, of = next((name, place) for name in _SCALES if (place := places[name]) is not None)
    assert at is not None  # nothing needed is missing
    errors = None if error is None else table.numbers(error)
    return ShiftColumns(table.values(at, "K"), table.numbers(of), _SCALES[name], errors, table.lines.tolist())
