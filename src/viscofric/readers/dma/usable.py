"""Points that can be used, and notes on those left out: missing values, moduli and frequencies not above zero."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import DataFileError
from viscofric.notes import Note
from viscofric.units import celsius

if TYPE_CHECKING:
    from viscofric.arrays import Array, Indices, Mask
    from viscofric.readers.dma.points import Points


#: A thousand times diamond.
LARGEST_MODULUS = 1e15  # Pa


def usable(points: Points, source: str) -> tuple[Indices, list[Note]]:
    """Return which points can be used, and a note on each sort of those left out.

    Parameters
    ----------
    points : Points
        As read.
    source : str
        Named in errors.

    Raises
    ------
    DataFileError
        If most points lack a value, or most frequencies or storage moduli, or all loss moduli, are not above zero;
        if a temperature is not above absolute zero, or a modulus far above that of any solid.
    """
    if not len(points):
        raise DataFileError(source, "holds no point of a frequency sweep.")
    columns = (points.temperature, points.angular_frequency, points.storage_modulus, points.loss_modulus)
    keep = np.all([np.isfinite(column) for column in columns], axis=0)
    notes: list[Note] = []
    _leave_out(points, source, ~keep, notes, ("a value is missing in it", "a value is missing in each"), None)
    cold = np.flatnonzero(keep & (points.temperature <= 0.0))
    if cold.size:
        problem = f"{points.places[cold[0]]} has a temperature of {points.temperature[cold[0]]:.4g} K; "
        raise DataFileError(source, problem + "it must be above absolute zero.")
    moduli = np.fmax(points.storage_modulus, points.loss_modulus)
    stiff = np.flatnonzero(keep & (moduli > LARGEST_MODULUS))
    if stiff.size:
        problem = f"{points.places[stiff[0]]} has a modulus of {moduli[stiff[0]]:.4g} Pa; nothing is as stiff, "
        raise DataFileError(source, problem + "so the number or its unit is wrong.")
    for name, plural, values, unit in (
        ("frequency", "frequencies", points.angular_frequency / (2 * math.pi), "Hz"),
        ("storage modulus", "storage moduli", points.storage_modulus, "Pa"),
        ("loss modulus", "loss moduli", points.loss_modulus, "Pa"),
    ):
        bad = keep & (values <= 0.0)
        told = (f"its {name} is not above zero", f"their {plural} are not above zero")
        _leave_out(points, source, bad, notes, told, (values, unit), most=name != "loss modulus")
        keep &= ~bad
    if not keep.any():
        raise DataFileError(source, "no row has a loss modulus above zero.")
    return np.flatnonzero(keep), notes


def _leave_out(
    points: Points,
    source: str,
    bad: Mask,
    notes: list[Note],
    told: tuple[str, str],
    values: tuple[Array, str] | None,
    *,
    most: bool = True,
) -> None:
    """Add a note, or raise where most points would be left out."""
    rows = np.flatnonzero(bad)
    if not rows.size:
        return
    named = points.named(rows.tolist())
    if most and 2 * len(rows) > len(points):
        raise DataFileError(source, f"{len(rows)} of {len(points)} points cannot be used: {told[1]} ({named}).")
    first = int(rows[0])
    if len(rows) > 1:
        notes.append(Note("points-left-out", f"{len(rows)} points left out: {told[1]} ({named}{_span(points, rows)})."))
    elif values is None:
        notes.append(Note("points-left-out", f"{_capital(named)} left out: {told[0]}."))
    else:
        hertz = points.angular_frequency[first] / (2 * math.pi)
        where = f"{celsius(points.temperature[first]):z.1f} °C, {hertz:.4g} Hz"
        notes.append(
            Note(
                "points-left-out",
                f"{_capital(named)} left out: {told[0]} ({values[0][first]:.4g} {values[1]} at {where}).",
            )
        )


def _span(points: Points, rows: Indices) -> str:
    kelvin = points.temperature[rows]
    kelvin = kelvin[np.isfinite(kelvin)]
    if not kelvin.size:
        return ""
    low, high = (f"{celsius(float(value)):z.1f}" for value in (kelvin.min(), kelvin.max()))
    return f"; at {low} °C" if low == high else f"; {low} to {high} °C"


def _capital(text: str) -> str:
    """Begin a sentence, but leave the names of files as they are."""
    return text[0].upper() + text[1:] if text.startswith(("line ", "row ", "point ", "sheet ")) else text
