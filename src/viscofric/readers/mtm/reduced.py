"""Speeds and forces from what a reduced table has instead: rolling speed, slip and the coefficient of traction."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.notes import Note

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.readers.table import Table

#: Unit of a slide-to-roll ratio -> factor to a fraction.
_RATIO = {"%": 0.01, "-": 1.0, "1": 1.0, "–": 1.0}


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
    """Return the speeds of disc and ball, m/s, and the quantities that they were read from.

    The slide-to-roll ratio is (u_disc - u_ball)/U, with the rolling speed U, the mean of the two.
    """
    if table.has("disc speed") and table.has("ball speed"):
        return _values(table, "disc speed", "m/s"), _values(table, "ball speed", "m/s"), {"disc speed", "ball speed"}
    rolling = _values(table, "rolling speed", "m/s")
    if table.has("sliding speed"):
        what, sliding = "sliding speed", _values(table, "sliding speed", "m/s")
    else:
        what = "slide to roll ratio"
        place = table.place(what)
        assert place is not None  # see `missing`
        column = table.columns[place]
        factor = _RATIO.get(column.unit.strip())
        if factor is None:
            shown = f"the unit {column.unit!r}" if column.unit else "no unit"
            raise table.refused("wrong-unit", f"column {column.heading!r} has {shown}; it must be '%' or '-'.")
        sliding = factor * table.numbers(place) * rolling
    said = f"The speeds of disc and ball follow from rolling speed and {what}, which is positive where the disc is "
    notes.append(Note("speeds-from-slip", f"{said}faster."))
    return rolling + 0.5 * sliding, rolling - 0.5 * sliding, {"rolling speed", what}


def force(table: Table, load: Array, slip: Array, notes: list[Note]) -> tuple[Array, str]:
    """Return the traction force, N, NaN where it has no sign, and the quantity that it was read from."""
    if table.has("traction force"):
        return _values(table, "traction force", "N"), "traction force"
    place = table.place("traction coefficient")
    assert place is not None  # see `missing`
    coefficient = table.numbers(place)
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


def _values(table: Table, what: str, unit: str) -> Array:
    place = table.place(what)
    assert place is not None  # see `missing`
    return table.values(place, unit)
