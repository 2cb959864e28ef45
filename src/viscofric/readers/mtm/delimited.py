"""Traction readings from delimited text tables with a header and one reading per row.

Reduced tables have rolling speed, slip and the coefficient of traction instead of speeds and forces.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from viscofric.arrays import Array, Integers
from viscofric.errors import DataFileError
from viscofric.notes import Note, Remedy
from viscofric.readers.dma.names import (
    COEFFICIENT,
    DMA,
    FRICTION_FORCE,
    LOAD,
    LUBRICANT,
    TEMPERATURE,
    TIME,
    insist_on_one_specimen,
)
from viscofric.readers.headings import Column, Vocabulary
from viscofric.readers.mtm.readings import TractionReadings
from viscofric.readers.one_table import only_table
from viscofric.readers.source import Source
from viscofric.readers.table import Table
from viscofric.readers.tables import holds_table

NAME = "delimited text, one reading per row"

#: What to do with traction runs in place of friction curves or sweeps.
AS_RUNS = Remedy(
    "; use read_mtm, or name it as mtm under [measurement] of a run file.",
    "; viscofric measure reads it, and as mtm under [measurement] a run file.",
    "; name it as mtm under [measurement].",
    "; drop it under “Measurement”.",
    "measurement.mtm",
)

#: The words of tables of traction runs: quantity -> names of its columns.
TRACTION = Vocabulary(
    "a table of traction runs",
    {
        "temperature": TEMPERATURE,
        "disc speed": frozenset(
            {f"{one} {speed}" for one in ("disc", "disk") for speed in ("speed", "velocity")}
            | {"u disc", "u disk", "v disc", "v disk", "scheibengeschwindigkeit", "vitesse du disque", "ディスク速度"}
        ),
        "ball speed": frozenset(
            {"ball speed", "ball velocity", "u ball", "v ball"}
            | {"kugelgeschwindigkeit", "vitesse de la bille", "ボール速度"}
        ),
        "load": LOAD | {"ball load"},
        "traction force": FRICTION_FORCE | {"traction force", "traction", "traktionskraft"},
        "rolling speed": frozenset(
            {"rolling speed", "entrainment speed", "entrainment velocity", "mean speed"}
            | {"rollgeschwindigkeit", "vitesse de roulement"}
        ),
        "sliding speed": frozenset(
            {"sliding speed", "slip speed", "sliding velocity"} | {"gleitgeschwindigkeit", "vitesse de glissement"}
        ),
        "slide to roll ratio": frozenset(
            {"srr", "slide-to-roll ratio", "slide-roll ratio", "slide roll ratio", "slide to roll ratio"}
            | {"slide/roll ratio"}
        ),
        "traction coefficient": COEFFICIENT,
        "zero force": frozenset({"zero force", "zero traction force"}),
        "time": TIME | {"step time"},
        "track radius": frozenset({"track radius", "disc track radius"}),
        "replicate": frozenset({"replicate", "repetition", "repeat", "wiederholung", "répétition"}),
        "step": frozenset({"step", "step number"}),
        "lubricant": LUBRICANT,
    },
    needed=(("disc speed", "ball speed", "rolling speed"), ("traction force", "traction coefficient")),
    example="a table of traction runs has e.g. 'temperature (degC)', 'disc speed (mm/s)', 'ball speed (mm/s)', "
    "'load (N)', 'traction force (N)'",
    key="measurement.columns",
    offered=(
        ("temperature", "degC"),
        ("disc speed", "mm/s"),
        ("ball speed", "mm/s"),
        ("load", "N"),
        ("traction force", "N"),
        ("rolling speed", "mm/s"),
        ("slide to roll ratio", "%"),
        ("traction coefficient", ""),
        ("replicate", ""),
    ),
    conditions=("temperature", "load"),
    from_above=("temperature", "load"),
    several="rows",
)
#: Quantity -> SI unit; cells may be empty.
OPTIONAL = {"zero force": "N", "time": "s", "track radius": "m"}

LARGEST_COUNT = 1e9
_COLDEST = "absolute zero"


def read(source: Source) -> TractionReadings:
    """Return the rows of a table, or raise `DataFileError`."""
    _refuse_sweeps(source)
    table = only_table(source, TRACTION)
    lacking = missing(table)
    if lacking:
        raise table.lacking(lacking, "; a pin or ball at rest has the speed 0" * ("ball speed" in lacking))
    load, temperature = (_values(table, *what) for what in (("load", "N", "zero"), ("temperature", "K", _COLDEST)))
    notes: list[Note] = [*table.heading_notes]
    disc, ball, of_speeds = speeds(table, notes)
    at: Array = np.stack([disc, ball, load, temperature], axis=1)
    insist_on_one_specimen(table, at, "pair of speeds, load and temperature")
    traction, of_force = force(table, load, disc - ball, notes)
    notes += _unused(table, {"load", "temperature", of_force, *of_speeds, *OPTIONAL, "replicate", "step"})
    optional = {name: _optional(table, name) for name in OPTIONAL}
    time = optional["time"]
    if time is not None and not np.all(np.isnan(time)):
        time = time - np.nanmin(time)
    kept = np.flatnonzero(~np.isnan(traction))
    if not kept.size:
        problem = "no row has a slip, which gives a coefficient of traction its sign."
        raise DataFileError(table.path, problem, code="no-points")

    def rows(column: Any) -> Any:
        return None if column is None else column[kept]

    return TractionReadings(
        source=source.path,
        disc_speed=disc[kept],
        ball_speed=ball[kept],
        traction_force=traction[kept],
        load=load[kept],
        temperature=temperature[kept],
        row=np.arange(kept.size),
        replicate=rows(_whole_numbers(table, "replicate")),
        zero_force=rows(optional["zero force"]),
        time=rows(time),
        track_radius=rows(optional["track radius"]),
        step=rows(_whole_numbers(table, "step")),
        notes=tuple(notes),
    )


def _refuse_sweeps(source: Source) -> None:
    """Raise `DataFileError` if a file is a table of DMA sweeps."""
    if not source.columns and holds_table(source, DMA) and not holds_table(source, TRACTION):
        raise DataFileError(
            source.path,
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


def _unused(table: Table, used: set[str]) -> tuple[Note, ...]:
    """Return a note on unread columns; refuse numbered forces and speeds, which are separate readings."""
    unused = [column for column in table.columns if column.name and column.quantity not in used]
    readings = frozenset[str]().union(
        *(TRACTION.quantities[name] for name in ("traction force", "disc speed", "ball speed")), {"tf"}
    )
    numbered = [column for column in unused if column.unnumbered.lower() in readings]
    if numbered:
        problem = (
            f"the numbered {_named(numbered)} would be left out, since a row of a table is one reading; write "
            "each force in a row of its own with the signed speeds of disc and ball that go with it, or remove them."
        )
        raise DataFileError(table.path, problem, code="several-readings-a-row")
    return (Note("unused-columns", f"Not read: the {_named(unused)}."),) if unused else ()


def _named(columns: list[Column]) -> str:
    return f"column{'s' if len(columns) > 1 else ''} {', '.join(repr(column.heading) for column in columns)}"


def _optional(table: Table, name: str) -> Array | None:
    place = table.place(name)
    if place is None:
        return None
    values = table.values(place, OPTIONAL[name], or_missing=True)
    if name == "track radius":
        table.insist(~(values <= 0.0), place, "above zero")
    return values


def _values(table: Table, what: str, unit: str, above: str = "") -> Array:
    """Return a column, of which all values must be above zero where the limit has a name."""
    place = table.place(what)
    assert place is not None  # see `missing`
    values = table.values(place, unit)
    if above:
        table.insist(values > 0.0, place, f"above {above}")
    return values


def _whole_numbers(table: Table, what: str) -> Integers | None:
    place = table.place(what)
    if place is None:
        return None
    numbers = table.numbers(place)
    whole = (numbers == np.round(numbers)) & (np.abs(numbers) <= LARGEST_COUNT)
    table.insist(whole, place, f"a whole number, at most {LARGEST_COUNT:.0f}", "not-a-whole-number")
    return numbers.astype(np.int64)


#: Printed slip agrees with the printed speeds to this part of it: a difference of nearly equal speeds.
SLIP_AGREES = 0.2
#: Slide-to-roll ratio above which the two surfaces move in opposite directions.
_OPPOSITE = 2.0


def missing(table: Table) -> list[str]:
    """Return the quantities that a table of traction runs lacks."""
    lacking = [what for what in ("temperature", "load") if not table.has(what)]
    if table.has("rolling speed") and not (table.has("disc speed") and table.has("ball speed")):
        if not (table.has("slide to roll ratio") or table.has("sliding speed")):
            lacking.append("slide to roll ratio")
    else:
        lacking += [what for what in ("disc speed", "ball speed") if not table.has(what)]
    if not (table.has("traction force") or table.has("traction coefficient")):
        lacking.append("traction force")
    return lacking


def speeds(table: Table, notes: list[Note]) -> tuple[Array, Array, set[str]]:
    """Return the speeds of disc and ball, m/s, and the quantities that they were read from."""
    # The slide-to-roll ratio is (u_disc - u_ball)/U, with the rolling speed U, the mean of the two.
    if table.has("disc speed") and table.has("ball speed"):
        disc, ball = _values(table, "disc speed", "m/s"), _values(table, "ball speed", "m/s")
        return disc, ball, {"disc speed", "ball speed", *_agreeing_slip(table, disc, ball, notes)}
    rolling = _values(table, "rolling speed", "m/s")
    what = "sliding speed" if table.has("sliding speed") else "slide to roll ratio"
    slip = _slip(table, what)
    sliding = slip * (1.0 if what == "sliding speed" else rolling)
    if what != "sliding speed" and np.any(np.abs(slip) > _OPPOSITE):
        said = f"The slide-to-roll ratios reach {100.0 * np.max(np.abs(slip)):.4g} %. Above 200 %, disc and ball move "
        notes.append(Note("opposite-speeds", f"{said}in opposite directions; is the unit right?"))
    said = f"The speeds of disc and ball follow from rolling speed and {what}, which is positive where the disc is "
    notes.append(Note("speeds-from-slip", f"{said}faster."))
    return rolling + 0.5 * sliding, rolling - 0.5 * sliding, {"rolling speed", what}


def _agreeing_slip(table: Table, disc: Array, ball: Array, notes: list[Note]) -> set[str]:
    """Return the quantities of slip that are printed beside both speeds and agree; add a note where one does not."""
    # A sign may be left out.
    slip, rolling = np.abs(disc - ball), np.abs(0.5 * (disc + ball))
    ratio = slip / np.where(rolling > 0.0, rolling, np.nan)
    agreeing = set()
    for what, expected in (("sliding speed", slip), ("slide to roll ratio", ratio)):
        try:
            printed = np.abs(_slip(table, what))
        except DataFileError:  # not needed
            continue
        slack = SLIP_AGREES * (expected + 0.5 * np.nanmax(expected, initial=0.0))
        if 2 * np.count_nonzero(np.abs(printed - expected) > slack) <= len(slip):
            agreeing.add(what)
        elif (place := table.place(what)) is not None:
            said = f"Column {table.columns[place].heading!r} contradicts the two speeds in most rows; these were used."
            notes.append(Note("slip-contradicts", said))
    return agreeing


def _slip(table: Table, what: str) -> Array:
    """Return a column of slip: a speed, m/s, or a ratio; NaN without it."""
    place = table.place(what)
    if place is None:
        return np.full(len(table.rows), np.nan)
    return table.values(place, "m/s") if what == "sliding speed" else table.ratio(place)


def force(table: Table, load: Array, slip: Array, notes: list[Note]) -> tuple[Array, str]:
    """Return the traction force, N, NaN where it has no sign, and the quantity that it was read from."""
    if table.has("traction force"):
        return _values(table, "traction force", "N"), "traction force"
    place = table.place("traction coefficient")
    assert place is not None  # see `missing`
    coefficient = table.values(place, "")
    if np.any(coefficient < 0.0):
        return coefficient * load, "traction coefficient"
    alone = slip == 0.0
    said = "Coefficients of traction have no sign; forces were given that of the slip of the disc on the ball."
    if alone.any():
        rows = "1 row" if np.count_nonzero(alone) == 1 else f"{np.count_nonzero(alone)} rows"
        said = f"{said[:-1]}, and {rows} without slip left out."
    averaged = " A coefficient averaged over both directions of slip, as an MTM's, holds no rolling resistance."
    notes.append(Note("traction-unsigned", said + averaged))
    return np.where(alone, np.nan, coefficient * load * np.sign(slip)), "traction coefficient"
