"""Frequency sweeps among the steps of a TA Instruments file, in SI units."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import DataFileError, InputError, not_needed
from viscofric.notes import Note, setting
from viscofric.readers.dma.checks import insist_on_agreement
from viscofric.readers.dma.instruments.ta_steps import ROLES, Signal, Step, roles
from viscofric.readers.dma.names import said_by_columns
from viscofric.readers.dma.readings import Readings
from viscofric.readers.source import PRINTED_FREQUENCY, STRAIN_FACTORS, Source, Test, to_rad_per_second, unit_conversion
from viscofric.units import shown_celsius

#: Tests in words.
TESTS = {"frequency": "frequency sweep", "temperature": "temperature ramp", "amplitude": "amplitude sweep"}


@dataclass(frozen=True, eq=False)
class _Points:
    """Points of one sweep: temperature (K), angular frequency (rad/s), storage and loss modulus (Pa), strain (1)."""

    places: list[str]
    left_out: list[str]
    columns: tuple[Array, ...]


def readings_of(
    source: Source, kind: str, steps: Sequence[Step], tools: Iterable[tuple[str, str]], notes: Sequence[str]
) -> Readings:
    """Return the points of all frequency sweeps among the steps of a file."""
    sweeps = [(number, step) for number, step in enumerate(steps, start=1) if step.is_of(source.test)]
    if not sweeps:
        raise DataFileError(
            source.path,
            f"contains no {TESTS[source.test]} of an oscillation; {_contents(steps)}.",
            code=f"no-{TESTS[source.test].replace(' ', '-')}",
        )
    notes = [*notes, *_passed_over(steps, source.test)]
    with np.errstate(all="ignore"):  # what overflows is no modulus and is left out
        parts = [_points(source, step, notes) for _, step in sweeps]
    left_out = [place for part in parts for place in part.left_out]
    if left_out:
        points = "1 point was" if len(left_out) == 1 else f"{len(left_out)} points were"
        want = "without a number for temperature, modulus or frequency (above zero)"
        notes.append(Note("points-left-out", f"{points} left out, {want}: {_listed(left_out)}."))
    places = tuple(place for part in parts for place in part.places)
    if not places:
        raise DataFileError(
            source.path,
            "no point of its frequency sweeps has all of temperature, frequency and moduli.",
            code="no-points",
        )
    temperature, frequency, storage, loss, strain = (
        np.concatenate(columns) for columns in zip(*(part.columns for part in parts), strict=True)
    )
    headings = [step.signals["storage modulus"].heading for _, step in sweeps]
    columns = [step.signals[role].heading for role in ROLES for _, step in sweeps if role in step.signals]
    if not all("oscillation torque" in step.signals for _, step in sweeps):
        columns = [one for one in columns if roles([one]) != {"oscillation torque": 0}]
    deformation, said_by = said_by_columns(headings, columns, tools)
    return Readings(
        source=source.path,
        format=kind,
        places=places,
        temperature=temperature,
        angular_frequency=frequency,
        storage_modulus=storage,
        loss_modulus=loss,
        deformation=deformation,
        said_by=said_by,
        strain_amplitude=strain if np.any(np.isfinite(strain)) else None,
        step=np.repeat([number for number, _ in sweeps], [len(part.places) for part in parts]).astype(np.int64),
        notes=tuple(dict.fromkeys(notes)),
        lacks_unit=bool(source.modulus_unit),  # else `_modulus` refused
    )


def _contents(steps: Sequence[Step]) -> str:
    """Return in words what there is instead of a frequency sweep."""
    if not steps:
        return "it has no steps with data"
    names = [repr(step.name) for step in steps]
    have = [repr(step.name) for step in steps if step.has_moduli]
    listed = f"its step{' is' if len(steps) == 1 else 's are'} {_listed(names)}"
    if not have:
        return f"{listed}, without moduli"
    which = "" if have == names else f" of which {_listed(have)}"
    return f"{listed},{which} with moduli, but not over frequency"


def _passed_over(steps: Sequence[Step], test: Test) -> list[str]:
    others = [repr(step.name) for step in steps if not step.is_of(test)]
    if not others:
        return []
    what = f"1 step that is not {'an' if test == 'amplitude' else 'a'} {TESTS[test]} was"
    if len(others) > 1:
        what = f"{len(others)} steps that are not {TESTS[test]}s were"
    values = {"steps": [step.name for step in steps if not step.is_of(test)]}
    return [Note(f"no-{TESTS[test].replace(' ', '-')}", f"{what} skipped: {_listed(others)}.", values=values)]


def _listed(names: Sequence[str], most: int = 6) -> str:
    """Name the first few."""
    return ", ".join(names[:most]) + (f" and {len(names) - most} more" if len(names) > most else "")


def _points(source: Source, step: Step, notes: list[str]) -> _Points:
    temperature = _temperature(source, step, notes)
    frequency = _angular_frequency(source, step)
    storage = _modulus(source, step, "storage modulus", notes)
    if "loss modulus" in step.signals:
        loss = _modulus(source, step, "loss modulus", notes)
        tangent = step.signals.get("tan delta")
        insist_on_agreement(source.path, storage, loss, None if tangent is None else tangent.values)
    else:
        loss = storage * step.signals["tan delta"].values
        said = "The file has no loss modulus; it was computed as storage modulus times tan δ."
        notes.append(Note("loss-computed", said))
    good = (
        np.isfinite(temperature) & np.isfinite(frequency) & np.isfinite(storage) & np.isfinite(loss) & (frequency > 0)
    )
    columns = (temperature, frequency, storage, loss, _strain(step, notes))
    places = list(zip(step.places, good, strict=True))
    return _Points(
        [place for place, kept in places if kept],
        [place for place, kept in places if not kept],
        tuple(column[good] for column in columns),
    )


def _temperature(source: Source, step: Step, notes: list[str]) -> Array:
    signal = step.signals.get("temperature")
    if signal is not None:
        if source.temperature is not None:
            problem = f"column {signal.heading!r} contains the temperatures"
            raise not_needed(source.path, "temperature", "temperature-not-needed", problem, " for this file")
        factor, offset = _conversion(source, step, signal, "K", "°C")
        return factor * signal.values + offset
    if source.temperature is None:
        problem = f"step {step.name!r} has no column 'Temperature'; give "
        remedy = setting("material.temperature", "Temperature of the sweep", "'25 degC'") + "."
        raise DataFileError(source.path, problem, code="no-temperature", remedy=remedy)
    said = f"No column holds a temperature; {shown_celsius(source.temperature)} °C was given by the user."
    notes.append(Note("temperature-given", said))
    return np.full(len(step.places), source.temperature)


def _modulus(source: Source, step: Step, role: str, notes: list[str]) -> Array:
    signal = step.signals[role]
    if source.modulus_unit and signal.unit:
        problem = f"column {signal.heading!r} has the unit {signal.unit!r}; leave out modulus_unit."
        raise DataFileError(source.path, problem, code="unit-not-needed")
    if source.modulus_unit:
        said = f"The moduli have no unit in the file; they were read in {source.modulus_unit}, as requested."
        notes.append(Note("modulus-unit-given", said))
        return unit_conversion(source.modulus_unit, "Pa", "modulus_unit")[0] * signal.values
    return _conversion(source, step, signal, "Pa", "MPa")[0] * signal.values


def _conversion(source: Source, step: Step, signal: Signal, unit: str, example: str) -> tuple[float, float]:
    try:
        return _factor_and_offset(signal.unit, unit)
    except InputError:
        raise _wrong_unit(source, step, signal, f"one like {example!r}") from None


@lru_cache(maxsize=64)  # a file may have hundreds of steps, all in the same units
def _factor_and_offset(text: str, unit: str) -> tuple[float, float]:
    return unit_conversion(text, unit)


def _wrong_unit(source: Source, step: Step, signal: Signal, right: str) -> DataFileError:
    shown = f"the unit {signal.unit!r}" if signal.unit else "no unit"
    where = f"column {signal.heading!r} of step {step.name!r}"
    return DataFileError(source.path, f"{where} has {shown}; it must be {right}.", code="wrong-unit")


def _angular_frequency(source: Source, step: Step) -> Array:
    """Return rad/s, or raise `DataFileError` where a unit is wrong or two columns contradict each other."""
    found = []
    for role in ("angular frequency", "frequency"):
        signal = step.signals.get(role)
        if signal is None:
            continue
        factor = to_rad_per_second(signal.unit, angular=role == "angular frequency")
        if factor is None:
            raise _wrong_unit(source, step, signal, "'rad/s'" if role == "angular frequency" else "'Hz' or 'rad/s'")
        found.append(factor * signal.values)
    apart = np.abs(found[-1] - found[0]) > PRINTED_FREQUENCY * np.abs(found[0])
    if np.any(apart):
        place = step.places[int(np.argmax(apart))]
        raise DataFileError(
            source.path,
            f"angular frequency and frequency contradict each other in {place} (ω = 2πf).",
            code="columns-contradict",
        )
    return found[0]


def _strain(step: Step, notes: list[str]) -> Array:
    """Return the amplitude of the oscillation as a fraction, NaN where it is not known."""
    signal = step.signals.get("strain")
    nothing = np.full(len(step.places), math.nan)
    if signal is None:
        return nothing
    factor = STRAIN_FACTORS.get(signal.unit)
    if factor is None:
        shown = f"the unit {signal.unit!r}" if signal.unit else "no unit"
        said = f"The strain amplitudes were not read: column {signal.heading!r} has {shown}, not '%'."
        notes.append(Note("strain-amplitude-not-read", said))
        return nothing
    return np.where(signal.values >= 0.0, factor * signal.values, math.nan)
