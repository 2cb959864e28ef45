"""Strain amplitudes of sweeps: an amplitude sweep is none of frequency, and amplitudes that differ are told."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import DataFileError
from viscofric.notes import Note
from viscofric.readers.dma.points import at

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.arrays import Indices
    from viscofric.readers.dma.points import Points, Sorted


#: Strain amplitudes of isotherms that differ by more than this factor are told.
AMPLITUDES_DIFFER = 1.2
#: A frequency that is held scatters by less than this as it is measured; no sweep has as many points,
HELD_FREQUENCY = 0.05
#: and so many of them with amplitudes that differ by more than this factor are those of an amplitude sweep.
AMPLITUDE_SWEEP, SWEPT_AMPLITUDE = 3, 2.0


def insist_on_one_amplitude(points: Points, rows: Indices, source: str) -> None:
    """Raise `DataFileError` where the amplitude of the strain, not the frequency, was swept at one temperature.

    Parameters
    ----------
    points : Points
        As read.
    rows : (m,) array of int
        Points of one isotherm.
    source : str
        Named in errors.
    """
    rows = rows[points.strain_amplitude[rows] > 0.0]
    held = np.round(np.log(points.angular_frequency[rows]) / HELD_FREQUENCY)
    swept: list[int] = []
    for one in np.unique(held):
        same = rows[held == one]
        amplitude = points.strain_amplitude[same]
        if amplitude.max() > SWEPT_AMPLITUDE * amplitude.min():
            swept += same.tolist()
    if len(swept) < AMPLITUDE_SWEEP:
        return
    amplitude, kelvin = points.strain_amplitude[swept], float(np.mean(points.temperature[rows]))
    span = f"{100 * amplitude.min():.3g} to {100 * amplitude.max():.3g} %"
    problem = (
        f"{at([kelvin])} the strain amplitude runs from {span} at one frequency ({points.named(swept)}); frequency "
    )
    raise DataFileError(source, problem + "sweeps at one amplitude are wanted, not an amplitude sweep.")


def on_amplitudes(sweeps: Sequence[Sorted]) -> list[Note]:
    """Tell strain amplitudes that differ: the modulus of a filled rubber falls with amplitude.

    A. R. Payne, J. Appl. Polym. Sci. 6 (1962) 57, doi:10.1002/app.1962.070061906.
    """
    known = []
    for one in sweeps:
        amplitude = one.isotherm.strain_amplitude
        if amplitude is not None and np.any(amplitude > 0.0):
            known.append((amplitude[amplitude > 0.0], one.isotherm.temperature))
    if not known:
        return []
    falls = "the modulus of a filled rubber falls with amplitude (Payne effect), which superposition would take for "
    notes = []
    (least, at_least), (most, at_most) = (f((float(np.median(one)), T) for one, T in known) for f in (min, max))
    if most > AMPLITUDES_DIFFER * least:
        told = f"The strain amplitudes of the isotherms differ, from {100 * least:.3g} % {at([at_least])} to "
        notes.append(Note("amplitudes-differ", f"{told}{100 * most:.3g} % {at([at_most])}; {falls}temperature."))
    within = [(one, T) for one, T in known if one.max() > AMPLITUDES_DIFFER * one.min()]
    if within:
        widest, where = max(within, key=lambda each: float(each[0].max() / each[0].min()))
        isotherms = "an isotherm" if len(within) == 1 else f"{len(within)} isotherms"
        told = f"The strain amplitude is not one within {isotherms}"
        span = f"{100 * widest.min():.3g} to {100 * widest.max():.3g} % {at([where])}"
        notes.append(Note("amplitudes-differ", f"{told}, at most from {span}; {falls}frequency."))
    return notes
