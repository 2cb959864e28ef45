"""Checks of values as printed: usable points, agreement of tan δ and |E*| with E' and E'', plausible units."""

from __future__ import annotations

import math

import numpy as np

from viscofric.arrays import Array, Indices, Mask
from viscofric.errors import DataFileError
from viscofric.notes import Note
from viscofric.readers.dma.readings import Points
from viscofric.readers.table import Table
from viscofric.units import CELSIUS_ZERO, shown_celsius, shown_number

#: A thousand times diamond.
LARGEST_MODULUS = 1e15  # Pa


def usable(points: Points, source: str) -> tuple[Indices, list[Note]]:
    """Return the usable points, and a note on each kind of those left out."""
    if not len(points):
        raise DataFileError(source, "contains no point of a frequency sweep.", code="no-points")
    notes: list[Note] = []
    keep = np.full(len(points), True)
    for name, plural, column in (
        ("temperature", "temperatures", points.temperature),
        ("frequency", "frequencies", points.angular_frequency),
        ("storage modulus", "storage moduli", points.storage_modulus),
        ("loss modulus", "loss moduli", points.loss_modulus),
    ):
        missing = keep & ~np.isfinite(column)
        _leave_out(points, source, missing, notes, (f"its {name} is missing", f"their {plural} are missing"), None)
        keep &= ~missing
    cold = np.flatnonzero(keep & (points.temperature <= 0.0))
    if cold.size:
        problem = (
            f"{points.places[cold[0]]} has a temperature of {shown_number(float(points.temperature[cold[0]]), '.4g')} "
            "K; "
        )
        raise DataFileError(source, problem + "it must be above absolute zero.", code="not-positive")
    moduli = np.fmax(points.storage_modulus, points.loss_modulus)
    stiff = np.flatnonzero(keep & (moduli > LARGEST_MODULUS))
    if stiff.size:
        problem = f"{points.places[stiff[0]]} has a modulus of {moduli[stiff[0]]:.4g} Pa; no material is as stiff, "
        raise DataFileError(source, problem + "so the number or its unit is wrong.", code="implausible-modulus")
    for name, plural, values, unit in (
        ("frequency", "frequencies", points.angular_frequency / (2 * math.pi), "Hz"),
        ("storage modulus", "storage moduli", points.storage_modulus, "Pa"),
        ("loss modulus", "loss moduli", points.loss_modulus, "Pa"),
    ):
        bad = keep & (values <= 0.0)
        why = (f"its {name} is not above zero", f"their {plural} are not above zero")
        _leave_out(points, source, bad, notes, why, (values, unit), most=name != "loss modulus")
        keep &= ~bad
    if not keep.any():
        raise DataFileError(source, "no row has a loss modulus above zero.", code="points-unusable")
    return np.flatnonzero(keep), notes


def _leave_out(
    points: Points,
    source: str,
    bad: Mask,
    notes: list[Note],
    why: tuple[str, str],
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
        raise DataFileError(
            source, f"{len(rows)} of {len(points)} points cannot be used: {why[1]} ({named}).", code="points-unusable"
        )
    first = int(rows[0])
    if len(rows) > 1:
        notes.append(Note("points-left-out", f"{len(rows)} points left out: {why[1]} ({named}{_span(points, rows)})."))
    elif values is None:
        notes.append(Note("points-left-out", f"{_capital(named)} left out: {why[0]}."))
    else:
        hertz = points.angular_frequency[first] / (2 * math.pi)
        where = f"{shown_celsius(points.temperature[first])} °C, {hertz:.4g} Hz"
        said = f"{_capital(named)} left out: {why[0]} ({shown_number(values[0][first], '.4g')} {values[1]} at {where})."
        notes.append(Note("points-left-out", said))


def _span(points: Points, rows: Indices) -> str:
    kelvin = points.temperature[rows]
    kelvin = kelvin[np.isfinite(kelvin)]
    if not kelvin.size:
        return ""
    low, high = (shown_celsius(float(value)) for value in (kelvin.min(), kelvin.max()))
    return f"; at {low} °C" if low == high else f"; {low} to {high} °C"


def _capital(text: str) -> str:
    """Begin a sentence, but leave the names of files as they are."""
    return text[0].upper() + text[1:] if text.startswith(("line ", "row ", "point ", "sheet ")) else text


#: Relative agreement of numbers printed with about two digits,
PRINTED = 0.05
#: and a small tan δ within the last of its two decimals.
LAST_DECIMAL = 0.01


def insist_on_agreement(
    path: str, storage: Array, loss: Array, tangent: Array | None = None, absolute: Array | None = None
) -> None:
    """Raise `DataFileError` if most of the printed tan δ or |E*| do not follow from E' and E''."""
    # Single points may differ: noise about zero, numbers of few digits. Moduli have one unit, NaN if missing.
    used = (storage > 0.0) & (loss > 0.0)
    for printed, name, formula, slack, follows in (
        (tangent, "tan δ", "loss over storage modulus", LAST_DECIMAL, loss[used] / storage[used]),
        (absolute, "|E*|", "√(E'² + E''²)", 0.0, np.hypot(storage[used], loss[used])),
    ):
        if printed is None:
            continue
        values = printed[used]
        known = values > 0.0
        wrong = np.abs(values[known] - follows[known]) > PRINTED * follows[known] + slack
        if 2 * np.count_nonzero(wrong) > wrong.size:
            first = int(np.argmax(wrong))
            problem = f"the {name} of {np.count_nonzero(wrong)} of {wrong.size} points is not {formula}, first "
            problem += (
                f"{shown_number(float(values[known][first]), '.4g')} instead of "
                f"{shown_number(float(follows[known][first]), '.4g')}; are columns swapped, or "
            )
            raise DataFileError(path, problem + "is a unit wrong?", code="columns-contradict")


#: Range of sweeps of rubber in kelvin.
LIKE_KELVIN = (200.0, 400.0)
#: No rubber is swept below this many kelvin.
COLDEST = 150.0
#: From the thinnest gel to ten times diamond.
PLAUSIBLE_MODULUS = (1.0, 1e13)  # Pa


def doubts(table: Table, places: dict[str, int], temperature: Array, storage_modulus: Array) -> list[str]:
    """Return notes on values, K and Pa, that suggest a wrong unit in a heading; nothing is changed."""
    notes = _of_temperature(table, places["temperature"], temperature) if "temperature" in places else []
    solid = (storage_modulus >= PLAUSIBLE_MODULUS[0]) & (storage_modulus <= PLAUSIBLE_MODULUS[1])
    # values not above zero are noise of the instrument, reported elsewhere
    outside = ~solid & (storage_modulus > 0.0)
    if np.any(outside):
        row = int(np.argmax(outside))
        place = next(places[m] for m in ("storage modulus", "loss modulus", "complex modulus") if m in places)
        notes.append(
            Note(
                "implausible-modulus",
                f"No solid has a storage modulus of {storage_modulus[row]:.3g} Pa (line {table.lines[row]}); "
                f"the unit in column {table.columns[place].heading!r} is probably wrong.",
            )
        )
    return notes


def _of_temperature(table: Table, place: int, temperature: Array) -> list[str]:
    known = np.isfinite(temperature)
    if not known.any():
        return []
    printed, heading = table.numbers_or_missing(place)[known], table.columns[place].heading
    low, high = float(printed.min()), float(printed.max())
    span = f"The temperatures in column {heading!r} run from {low:g} to {high:g}"
    in_celsius = np.allclose(temperature[known] - printed, CELSIUS_ZERO, rtol=0.0, atol=1e-6)
    in_kelvin = np.allclose(temperature[known], printed, rtol=1e-9, atol=0.0)
    if in_celsius and low >= LIKE_KELVIN[0] and high <= LIKE_KELVIN[1]:
        return [
            Note(
                "implausible-temperature",
                f"{span} and look like kelvin; they were read in °C, the unit of the heading.",
            )
        ]
    if in_kelvin and high < COLDEST:
        return [
            Note(
                "implausible-temperature",
                f"{span} and look like °C; they were read in kelvin, the unit of the heading.",
            )
        ]
    return []
