"""Amplitude sweeps from files of a dynamic mechanical analyser or a rheometer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike

import numpy as np

from viscofric.amplitudes import AmplitudeSweep
from viscofric.arrays import Indices
from viscofric.data import Deformation
from viscofric.errors import DataFileError, short_notes
from viscofric.notes import Note
from viscofric.readers.dma.names import DMA
from viscofric.readers.dma.ramps import by_frequency, legs, points_of
from viscofric.readers.dma.read import read_files
from viscofric.readers.dma.readings import AS_SWEEPS, Points
from viscofric.readers.dma.sweep_checks import SWEPT_AMPLITUDE
from viscofric.readers.tables import name_columns
from viscofric.units import Quantity

#: A sweep has so many amplitudes at least.
FEWEST = 5
#: Amplitudes closer than this (relative) are the same, printed or measured twice.
SAME_AMPLITUDE = 1e-3
#: Amplitudes turn where their logarithm (to base e) reverses by more than this.
REVERSAL = 0.1
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
        raise DataFileError(
            found.source,
            f"no frequency was held over {FEWEST} strain amplitudes that differ by more than a factor of "
            f"{SWEPT_AMPLITUDE:g}; this is no amplitude sweep",
            code="no-amplitude-sweep",
            remedy=AS_SWEEPS,
        )
    notes = short_notes([*found.notes, *_on_left_out(points, keep, taken), *_on_temperature(points, taken)])
    strain, (storage, loss, frequency, kelvin) = _averaged(points, taken)
    held = float(frequency.mean()), float(kelvin.mean())
    return AmplitudeSweep(strain, storage, loss, *held, found.deformation, found.source, notes, found.formats)


def _longest(points: Points, keep: Indices) -> Indices:
    """Return the longest way up of the amplitude at one frequency, empty if there is none."""
    found: list[Indices] = []
    for held in by_frequency(points, keep):
        amplitude = points.strain_amplitude[held]
        for leg in legs(np.log(amplitude), REVERSAL):
            rising = amplitude[leg][-1] > SWEPT_AMPLITUDE * amplitude[leg][0]
            if rising and len(amplitude[leg]) >= FEWEST:
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
