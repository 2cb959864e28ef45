"""Temperature ramps, and amplitude sweeps, from files of a dynamic mechanical analyser or a rheometer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Literal, NamedTuple

import numpy as np

from viscofric.amplitudes import AmplitudeSweep
from viscofric.arrays import Array, Indices
from viscofric.data import Deformation
from viscofric.errors import DataFileError, check_choice, short_notes
from viscofric.nominal import parted
from viscofric.notes import Note
from viscofric.ramps import TemperatureRamp, TemperatureRamps
from viscofric.readers.dma.checks import HELD_FREQUENCY, SWEPT_AMPLITUDE, usable
from viscofric.readers.dma.instruments.ta_steps import RAMP
from viscofric.readers.dma.isotherms import opening
from viscofric.readers.dma.names import DMA, NOT_SAID
from viscofric.readers.dma.read import read_files
from viscofric.readers.dma.readings import AS_SWEEPS, Points, Readings, joined
from viscofric.readers.table import name_columns
from viscofric.units import Quantity, celsius, to_si


def by_frequency(points: Points, rows: Indices) -> list[Indices]:
    """Separate points by their frequency, ascending; each in the order of reading."""
    # A frequency that is held scatters as it is measured; frequencies of a test differ by more.
    return [np.sort(rows[part]) for part in parted(np.log(points.angular_frequency[rows]), HELD_FREQUENCY)]


def legs(values: Array, reversal: float) -> list[slice]:
    """Separate a course of values into rising and falling parts; smaller reversals are scatter."""
    found, first, extreme, rising = [], 0, 0, True
    for place, value in enumerate(values):
        away = value - values[extreme]
        if (away > 0.0) == rising:
            extreme = place
        elif abs(away) > reversal:
            if extreme > first:
                found.append(slice(first, extreme + 1))
                first = extreme + 1
            rising, extreme = not rising, place
    return [*found, slice(first, len(values))]


class Stated(NamedTuple):
    """What files state of a test: their names, the kind of deformation, the formats, and notes."""

    source: str
    deformation: Deformation
    formats: str
    notes: list[Note]


def points_of(readings: Sequence[Readings], deformation: Deformation | None) -> tuple[Points, Indices, Stated]:
    """Return all points, those that are usable, and what the files state; raise `DataFileError` without deformation."""
    source, kind, notes = opening(readings, deformation)
    if deformation is None and all(one.deformation is None for one in readings):
        raise DataFileError(source, NOT_SAID)
    points = joined(readings)
    keep, on_left_out = usable(points, source)
    formats = ", ".join(dict.fromkeys(one.format for one in readings))
    return points, keep, Stated(source, kind, formats, [*notes, *on_left_out])


#: A ramp has so many points at least.
FEWEST = 5
#: A course of temperatures turns where it reverses by more than this, K.
REVERSAL = 3.0


def read_ramps(
    *paths: str | PathLike[str] | Sequence[str | PathLike[str]],
    deformation: Deformation | None = None,
    direction: Literal["heating", "cooling"] | None = None,
    heating_rate: Quantity | None = None,
    modulus_unit: str | None = None,
    columns: Mapping[str, str] | None = None,
    sheet: str | None = None,
) -> TemperatureRamps:
    """Read temperature ramps at one or several frequencies from files of an analyser or a rheometer.

    Files are those that `read_dma` reads; the points are sorted by frequency instead of temperature.

    Parameters
    ----------
    *paths : str or path, or a list of them
        One or many files of one specimen, such as one for each frequency.
    deformation : {"tension", "compression", "bending", "shear"}, optional
        Kind of the moduli, if the files do not state it.
    direction : {"heating", "cooling"}, optional
        Which part of a file is read that holds both; by default heating, unless cooling covers clearly more.
    heating_rate : float or quantity, optional
        Such as ``"3 K/min"``, K/s if a plain number; files do not state it in a way that is read.
    modulus_unit, columns, sheet : optional
        As for `read_dma`.

    Returns
    -------
    TemperatureRamps
        In SI units; the notes name every point left out, and everything doubtful.

    Raises
    ------
    DataFileError
        If a file cannot be read or is not recognised, or no frequency was held over a range of temperatures.
    InputError
        If no file is given, or an argument is wrong.

    Examples
    --------
    >>> from importlib.resources import files
    >>> import viscofric as vf
    >>> path = files("viscofric") / "example" / "dma.csv"  # synthetic: frequency sweeps, read as ramps
    >>> ramps = vf.read_ramps(path, deformation="tension")
    >>> len(ramps) > 10, len(ramps.ramps[0]) > 20
    (True, True)
    """
    if direction is not None:
        check_choice(direction, "direction", "heating", "cooling")
    rate = None if heating_rate is None else to_si(heating_rate, "K/s", "heating_rate")
    readings = read_files(paths, "read_ramps", "temperature", deformation, None, modulus_unit, columns, sheet)
    points, keep, found = points_of(readings, deformation)
    rows, on_direction = _one_direction(points, keep, direction, found.source)
    ramps, short = [], []
    for held in by_frequency(points, rows):
        if len(held) < FEWEST or np.ptp(points.temperature[held]) <= RAMP:
            short += held.tolist()
            continue
        order = held[np.argsort(points.temperature[held], kind="stable")]
        frequency = float(np.exp(np.mean(np.log(points.angular_frequency[order]))))
        columns_of = (points.temperature, points.storage_modulus, points.loss_modulus)
        ramps.append(TemperatureRamp(frequency, *(column[order] for column in columns_of)))
    if not ramps:
        problem = (
            f"no frequency was held over more than {RAMP:g} K at {FEWEST} temperatures or more; this is no temperature "
            "ramp"
        )
        raise DataFileError(found.source, problem, code="no-ramp", remedy=AS_SWEEPS)
    notes = [*found.notes, *on_direction]
    if short:
        said = (
            f"{len(short)} points left out: their frequency was not held over a ramp ({points.named(sorted(short))})."
        )
        notes.append(Note("points-left-out", said))
    return TemperatureRamps(tuple(ramps), found.deformation, rate, found.source, short_notes(notes), found.formats)


def _one_direction(points: Points, keep: Indices, direction: str | None, source: str) -> tuple[Indices, list[Note]]:
    """Keep heating or cooling where a file holds both."""
    rows, left = [], []
    for number in np.unique(points.file[keep]):
        own = keep[points.file[keep] == number]
        kelvin = points.temperature[own]
        parts = [own[part] for part in legs(kelvin, REVERSAL)]
        wanted = [part for part in parts if direction is None or _heats(points, part) == (direction == "heating")]
        if not wanted:
            raise DataFileError(source, f"it holds no {direction}; leave out direction.", code="no-such-direction")
        # Of both directions over about the same temperatures, heating is taken.
        longest = max(
            wanted, key=lambda part: float(np.ptp(points.temperature[part])) * (1.2 if _heats(points, part) else 1.0)
        )
        # Parts of a frequency table in blocks repeat the same course: all that go the same way as the longest.
        same = [part for part in wanted if _heats(points, part) == _heats(points, longest)]
        rows += same
        left += [part for part in parts if not any(part is one for one in same)]
    notes = []
    others = np.concatenate(left) if left else np.empty(0, dtype=np.intp)
    if others.size:
        low, high = (celsius(float(f(points.temperature[others]))) for f in (np.min, np.max))
        taken = "heating" if _heats(points, rows[0]) else "cooling"
        said = (
            f"{len(others)} points left out: only the part with {taken} was read, not the other direction "
            f"({low:z.1f} to {high:z.1f} °C)."
        )
        notes.append(Note("direction", said))
    return np.sort(np.concatenate(rows)), notes


def _heats(points: Points, rows: Indices) -> bool:
    kelvin = points.temperature[rows]
    return bool(kelvin[-1] >= kelvin[0])


#: A sweep has so many amplitudes at least.
FEWEST_AMPLITUDES = 5
#: Amplitudes closer than this (relative) are the same, printed or measured twice.
SAME_AMPLITUDE = 1e-3
#: Amplitudes turn where their logarithm (to base e) reverses by more than this.
AMPLITUDE_REVERSAL = 0.1
#: A temperature that ranges further than this while the amplitude is swept changes the moduli too, K.
WIDEST_TEMPERATURE = 3.0


def read_amplitude_sweep(
    *paths: str | PathLike[str] | Sequence[str | PathLike[str]],
    deformation: Deformation | None = None,
    temperature: Quantity | None = None,
    modulus_unit: str | None = None,
    columns: Mapping[str, str] | None = None,
    sheet: str | None = None,
) -> AmplitudeSweep:
    """Read an amplitude sweep (Payne effect) from a file of an analyser or a rheometer.

    Files are those that `read_dma` reads, with a column of the strain amplitude.

    Parameters
    ----------
    *paths : str or path, or a list of them
        One file, or several of one sweep.
    deformation, temperature, modulus_unit, columns, sheet : optional
        As for `read_dma`.

    Returns
    -------
    AmplitudeSweep
        Of growing amplitudes; where a file holds the way back too, only the way up is read.  Of several frequencies
        that with most amplitudes is taken.  Notes name what was left out.

    Raises
    ------
    DataFileError
        If a file cannot be read or is not recognised, or no frequency was held over amplitudes that differ twofold.
    InputError
        If no file is given, or an argument is wrong.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import viscofric as vf
    >>> rows = ["temperature (degC),frequency (Hz),strain amplitude (%),G' (MPa),G'' (MPa)"]
    >>> rows += [f"60,10,{0.1 * 2**n},{5 - 0.3 * n},0.5" for n in range(10)]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = (Path(folder) / "payne.csv").write_text(chr(10).join(rows))
    ...     vf.read_amplitude_sweep(Path(folder) / "payne.csv")
    AmplitudeSweep
      strain amplitude  10 from 0.1 to 51.2 %
      storage modulus   10 from 2.3 to 5 MPa
      frequency         10 Hz
      temperature       60 °C
      deformation       shear
      notes             2
    """
    readings = read_files(
        paths, "read_amplitude_sweep", "amplitude", deformation, temperature, modulus_unit, columns, sheet
    )
    points, keep, found = points_of(readings, deformation)
    if np.all(np.isnan(points.strain_amplitude)):
        remedy = name_columns(DMA.key, ("strain amplitude",))
        problem = "has no column of strain amplitudes with a unit such as '%'"
        raise DataFileError(found.source, problem, code="missing-columns", remedy=remedy)
    keep = keep[points.strain_amplitude[keep] > 0.0]
    taken = _longest(points, keep) if len(keep) else keep
    if not len(taken):
        problem = (
            f"no frequency was held over {FEWEST_AMPLITUDES} strain amplitudes that differ by more than a factor of "
            f"{SWEPT_AMPLITUDE:g}; this is no amplitude sweep"
        )
        raise DataFileError(found.source, problem, code="no-amplitude-sweep", remedy=AS_SWEEPS)
    notes = short_notes([*found.notes, *_on_left_out(points, keep, taken), *_on_temperature(points, taken)])
    strain, (storage, loss, frequency, kelvin) = _averaged(points, taken)
    held = float(frequency.mean()), float(kelvin.mean())
    return AmplitudeSweep(strain, storage, loss, *held, found.deformation, found.source, notes, found.formats)


def _longest(points: Points, keep: Indices) -> Indices:
    """Return the longest way up of the amplitude at one frequency, empty if there is none."""
    found: list[Indices] = []
    for held in by_frequency(points, keep):
        amplitude = points.strain_amplitude[held]
        for leg in legs(np.log(amplitude), AMPLITUDE_REVERSAL):
            rising = amplitude[leg][-1] > SWEPT_AMPLITUDE * amplitude[leg][0]
            if rising and len(amplitude[leg]) >= FEWEST_AMPLITUDES:
                found.append(held[leg])
    return max(found, key=len, default=keep[:0])


def _averaged(points: Points, rows: Indices) -> tuple[np.ndarray, list[np.ndarray]]:
    """Return ascending amplitudes without repeats, and the other columns averaged at each."""
    order = rows[np.argsort(points.strain_amplitude[rows], kind="stable")]
    amplitude = points.strain_amplitude[order]
    group = np.concatenate([[0], np.cumsum(np.diff(amplitude) > SAME_AMPLITUDE * amplitude[1:])])
    count = np.bincount(group)
    columns = (points.storage_modulus, points.loss_modulus, points.angular_frequency, points.temperature)
    return np.bincount(group, amplitude) / count, [np.bincount(group, one[order]) / count for one in columns]


def _on_left_out(points: Points, keep: Indices, taken: Indices) -> list[Note]:
    others = np.setdiff1d(keep, taken)
    if not others.size:
        return []
    said = f"{len(others)} points left out: of another frequency, or of the way back ({points.named(others.tolist())})."
    return [Note("points-left-out", said)]


def _on_temperature(points: Points, taken: Indices) -> list[Note]:
    wander = float(np.ptp(points.temperature[taken]))
    if wander <= WIDEST_TEMPERATURE:
        return []
    said = f"The temperature ranged over {wander:.2g} K while the amplitude was swept, which changes the moduli too."
    return [Note("temperature-drifts", said)]
