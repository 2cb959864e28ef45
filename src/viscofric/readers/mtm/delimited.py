"""Traction readings from delimited text tables with a header and one reading per row."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import DataFileError
from viscofric.notes import Note, Remedy
from viscofric.readers.mtm.readings import TractionReadings
from viscofric.readers.table import Column, Table, table_of_text

if TYPE_CHECKING:
    from viscofric.arrays import Array, Integers
    from viscofric.readers.source import Source


NAME = "delimited text, one reading per row"

#: Required columns: known names, and the SI unit.
COLUMNS = {
    "disc speed": (frozenset({"disc speed", "disk speed", "u disc", "u disk"}), "m/s"),
    "ball speed": (frozenset({"ball speed", "u ball"}), "m/s"),
    "traction force": (frozenset({"traction force", "traction"}), "N"),
    "load": (frozenset({"load", "ball load", "normal load", "normal force"}), "N"),
    "temperature": (frozenset({"T", "temp", "temp.", "temperature"}), "K"),
}
#: Optional columns; cells may be empty.
OPTIONAL = {
    "zero force": (frozenset({"zero force", "zero traction force"}), "N"),
    "time": (frozenset({"t", "time", "step time"}), "s"),
    "track radius": (frozenset({"track radius", "disc track radius"}), "m"),
}
REPLICATE = frozenset({"replicate", "repetition", "repeat"})
STEP = frozenset({"step", "step number"})

LARGEST_COUNT = 1e9


def read(source: Source) -> TractionReadings:
    """Return the rows of a table, or raise `DataFileError`."""
    table = table_of_text(source.path, source.text or "")
    places = _columns(table)
    values = {name: table.values(places[name], unit) for name, (_, unit) in COLUMNS.items()}
    for name, limit in (("load", "zero"), ("temperature", "absolute zero")):
        _insist_on_positive(table, places[name], values[name], limit)
    notes = _unused(table, places)
    optional = {name: _optional(table, name) for name in OPTIONAL}
    time = optional["time"]
    if time is not None and not np.all(np.isnan(time)):
        time = time - np.nanmin(time)
    return TractionReadings(
        source=source.path,
        disc_speed=values["disc speed"],
        ball_speed=values["ball speed"],
        traction_force=values["traction force"],
        load=values["load"],
        temperature=values["temperature"],
        row=np.arange(len(table.rows)),
        replicate=_whole_numbers(table, REPLICATE, "replicate"),
        zero_force=optional["zero force"],
        time=time,
        track_radius=optional["track radius"],
        step=_whole_numbers(table, STEP, "step"),
        notes=notes,
    )


def _columns(table: Table) -> dict[str, int]:
    places = {name: table.find(names, name) for name, (names, _) in COLUMNS.items()}
    missing = [name for name, place in places.items() if place is None]
    if missing:
        if any("loss" in c.name.lower() or "''" in c.name for c in table.columns):
            raise DataFileError(
                table.path,
                "this is a table of DMA sweeps, not of traction runs",
                code="dma-sweeps",
                remedy=Remedy(
                    "; use read_dma, or name it as dma under [material] of a run file.",
                    "; viscofric material reads it, and as dma under [material] a run file.",
                    "; name it as dma under [material].",
                    "; drop it at the step “Data”.",
                    "measurement.mtm",
                ),
            )
        raise DataFileError(
            table.path,
            f"no column for {' or '.join(missing)}; a table of traction runs has e.g. 'temperature (degC)', "
            f"'disc speed (mm/s)', 'ball speed (mm/s)', 'load (N)', 'traction force (N)', "
            f"this one has {table.headings()}.",
            code="missing-columns",
        )
    return {name: place for name, place in places.items() if place is not None}


def _unused(table: Table, places: dict[str, int]) -> tuple[str, ...]:
    """Return a note on unread columns; refuse numbered forces and speeds, which are separate readings."""
    known = [names for names, _ in OPTIONAL.values()] + [REPLICATE, STEP]
    others = [place for names in known if (place := table.find(names, min(names))) is not None]
    unused = table.unused([*places.values(), *others])
    readings = frozenset().union(*(COLUMNS[name][0] for name in ("traction force", "disc speed", "ball speed")), {"tf"})
    numbered = [column for column in unused if column.unnumbered.lower() in readings]
    if numbered:
        raise DataFileError(
            table.path,
            f"the numbered {_named(numbered)} would be left out, since a row of a table is one reading; write "
            "each force in a row of its own with the signed speeds of disc and ball that go with it, or remove them.",
            code="several-readings-a-row",
        )
    return (Note("unused-columns", f"Not read: the {_named(unused)}."),) if unused else ()


def _named(columns: list[Column]) -> str:
    return f"column{'s' if len(columns) > 1 else ''} {', '.join(repr(column.heading) for column in columns)}"


def _optional(table: Table, name: str) -> Array | None:
    names, unit = OPTIONAL[name]
    place = table.find(names, name)
    if place is None:
        return None
    factor, offset = table.conversion(table.columns[place], unit)
    values = factor * table.numbers_or_missing(place) + offset
    if name == "track radius":
        _insist_on_positive(table, place, values, "zero")
    return values


def _insist_on_positive(table: Table, place: int, values: Array, limit: str) -> None:
    bad = np.flatnonzero(values <= 0.0)
    if bad.size:
        row = int(bad[0])
        cell, heading = table.rows[row][place].strip(), table.columns[place].heading
        raise DataFileError(
            table.path,
            f"{cell} in column {heading!r} must be above {limit}.",
            int(table.lines[row]),
            code="not-positive",
        )


def _whole_numbers(table: Table, names: frozenset[str], what: str) -> Integers | None:
    place = table.find(names, what)
    if place is None:
        return None
    numbers = table.numbers(place)
    bad = np.flatnonzero((numbers != np.round(numbers)) | (np.abs(numbers) > LARGEST_COUNT))
    if bad.size:
        row = int(bad[0])
        cell, heading = table.rows[row][place].strip(), table.columns[place].heading
        problem = f"{cell} in column {heading!r} must be a whole number, at most {LARGEST_COUNT:.0f}."
        raise DataFileError(table.path, problem, int(table.lines[row]), code="not-a-whole-number")
    return numbers.astype(np.int64)
