"""Anton Paar RheoCompass text exports: the frequency sweeps among their intervals.

No genuine file of this format was available.  The layout (see `rheocompass_intervals`) and the English, German,
French and Portuguese names are those of published programs for such files; the names in other languages are the usual
words of the field.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import DataFileError, InputError
from viscofric.notes import Note
from viscofric.readers.dma import names
from viscofric.readers.dma.instruments.rheocompass_intervals import (
    Decimals,
    Interval,
    has_intervals,
    head,
    intervals,
)
from viscofric.readers.dma.names import said_by_columns, tools_in
from viscofric.readers.dma.readings import Readings
from viscofric.readers.source import STRAIN_FACTORS, to_rad_per_second, unit_conversion

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.readers.source import Source

    #: Line and cells of points.
    Rows = list[tuple[int, tuple[str, ...]]]

NAME = "Anton Paar RheoCompass text"

#: Relative range of a frequency that is held, as measured.
_SAME_FREQUENCY = 0.05


def recognises(source: Source) -> bool:
    """Return whether the text has an interval of numbered points."""
    return source.text is not None and has_intervals(source.text)


def read(source: Source) -> Readings:
    """Return the points of all frequency sweeps; each interval is a step."""
    found = intervals(source)
    oscillating = [interval for interval in found if interval.oscillates]
    decimals = Decimals.of(source.path, oscillating)
    notes: list[Note] = []
    tables, lines, steps = [], [], []
    sweeps: list[Interval] = []
    for interval in oscillating:
        rows = _complete(interval)
        frequency = _column(source.path, interval, "angular frequency", rows, decimals)
        held = source.test != "frequency"
        if not held and (frequency.size < 2 or np.ptp(frequency) <= _SAME_FREQUENCY * np.max(np.abs(frequency))):
            continue
        tables.append(_table(source, interval, rows, frequency, decimals))
        lines += [line for line, _ in rows]
        steps += [len(sweeps)] * len(rows)
        sweeps.append(interval)
        notes += _doubts(interval)
    if not tables:
        headings = ", ".join(repr(column) for column in found[0].columns[1:] if column)
        raise DataFileError(
            source.path,
            f"no interval of {len(found)} is a frequency sweep, with frequency, storage and loss modulus; the first "
            f"has the columns {headings}.",
            code="no-frequency-sweep",
        )
    others = len(found) - len(sweeps)
    if others:
        what = "1 interval that is no frequency sweep was"
        what = what if others == 1 else f"{others} intervals that are no frequency sweeps were"
        notes.insert(0, Note("no-frequency-sweep", f"{what} skipped."))
    moduli = [interval.columns[interval.places["storage modulus"]] for interval in sweeps]
    columns = [column for interval in sweeps for column in interval.columns[1:]]
    deformation, said_by = said_by_columns(moduli, columns, tools_in(head(source)))
    temperature, frequency, storage, loss, amplitude = np.concatenate(tables, axis=1)
    return Readings(
        source.path,
        NAME,
        tuple(f"line {line}" for line in lines),
        temperature,
        frequency,
        storage,
        loss,
        deformation,
        said_by,
        amplitude if np.any(np.isfinite(amplitude)) else None,
        np.array(steps, dtype=np.int64),
        tuple(dict.fromkeys(notes)),
    )


def _needed(interval: Interval) -> list[int]:
    whats = ("angular frequency", "storage modulus", "loss modulus", "temperature")
    return [interval.places[what] for what in whats if what in interval.places]


def _complete(interval: Interval) -> Rows:
    """Return the complete points; without torque, for instance, the instrument leaves the moduli empty."""
    return [(line, row) for line, row in interval.rows if all(row[place] for place in _needed(interval))]


def _column(path: str, interval: Interval, what: str, rows: Rows, decimals: Decimals) -> Array:
    """Return the numbers of a column as printed."""
    place = interval.places[what]
    heading = interval.columns[place]
    return np.array([decimals.number(path, row[place], heading, line) for line, row in rows])


def _table(source: Source, interval: Interval, rows: Rows, frequency: Array, decimals: Decimals) -> Array:
    """Return temperature, angular frequency, moduli and strain amplitude in five rows."""
    path = source.path
    frequency = frequency * _to_angular(path, interval)
    storage, loss = (
        _conversion(path, interval, what, "Pa")[0] * _column(path, interval, what, rows, decimals)
        for what in ("storage modulus", "loss modulus")
    )
    if "temperature" in interval.places:
        factor, offset = _conversion(path, interval, "temperature", "K")
        temperature = factor * _column(path, interval, "temperature", rows, decimals) + offset
    elif source.temperature is not None:
        temperature = np.full(frequency.shape, source.temperature)
    else:
        problem = "the interval has no column of temperatures; export it, or give temperature= for all points."
        raise DataFileError(path, problem, interval.line, code="no-temperature")
    for values, what, bound in ((frequency, "frequency", "zero"), (temperature, "temperature", "absolute zero")):
        if np.any(values <= 0.0):
            raise DataFileError(
                path, f"the {what} must be above {bound}.", rows[int(np.argmax(values <= 0.0))][0], code="not-positive"
            )
    amplitude = np.full(frequency.shape, np.nan)
    place = interval.places.get("strain amplitude")
    if place is not None and interval.units[place] in STRAIN_FACTORS:
        known = [index for index, (_, row) in enumerate(rows) if row[place]]
        numbers = _column(path, interval, "strain amplitude", [rows[index] for index in known], decimals)
        amplitude[known] = np.abs(numbers) * STRAIN_FACTORS[interval.units[place]]
    return np.array([temperature, frequency, storage, loss, amplitude])


def _doubts(interval: Interval) -> list[Note]:
    complete = {line for line, _ in _complete(interval)}
    empty = [line for line, _ in interval.rows if line not in complete]
    notes = []
    marked = (list(interval.invalid), "marked next to the number as invalid")
    for lines, why in (marked, (empty, "a cell being empty")):
        if lines:
            shown = ", ".join(str(line) for line in lines[:3]) + (" and more" if len(lines) > 3 else "")
            what = "1 point was" if len(lines) == 1 else f"{len(lines)} points were"
            said = f"{what} left out, {why} (line{'s' if len(lines) > 1 else ''} {shown})."
            notes.append(Note("points-left-out", said))
    strain = interval.places.get("strain amplitude")
    if strain is not None and interval.units[strain] not in STRAIN_FACTORS:
        said = f"The strain amplitudes were not read: column {interval.columns[strain]!r} has no unit such as '%'."
        notes.append(Note("strain-amplitude-not-read", said))
    if interval.missing:
        notes.append(
            Note(
                "points-missing",
                f"The interval in line {interval.line} announces {interval.announced} points, {interval.missing} of "
                "which "
                "are not in the file.",
            )
        )
    return notes


def _to_angular(path: str, interval: Interval) -> float:
    place = interval.places["angular frequency"]
    heading, unit = interval.columns[place], interval.units[place]
    angular = names.quantity(heading) == "angular frequency"
    factor = to_rad_per_second(unit, angular=angular)
    if factor is not None:
        return factor
    raise DataFileError(
        path, f"column {heading!r} has the unit {unit!r}; it must be 'rad/s' or 'Hz'.", interval.line, code="wrong-unit"
    )


def _conversion(path: str, interval: Interval, what: str, unit: str) -> tuple[float, float]:
    place = interval.places[what]
    heading, text = interval.columns[place], interval.units[place]
    try:
        return unit_conversion(text, unit, heading)
    except InputError:
        example = {"K": "°C"}.get(unit, unit)
        problem = f"column {heading!r} has the unit {text!r}; it must be one like {example!r}."
        raise DataFileError(path, problem, interval.line, code="wrong-unit") from None
