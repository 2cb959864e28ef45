"""Points at held frequencies: what temperature ramps and amplitude sweeps have in common."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.readers.dma.sweep_checks import HELD_FREQUENCY

if TYPE_CHECKING:
    from viscofric.arrays import Array, Indices
    from viscofric.readers.dma.readings import Points


def by_frequency(points: Points, rows: Indices) -> list[Indices]:
    """Separate points by their frequency, ascending; each in the order of reading.

    A frequency that is held scatters as it is measured; frequencies of a test differ by more.
    """
    logarithm = np.log(points.angular_frequency[rows])
    order = np.argsort(logarithm, kind="stable")
    cuts = np.flatnonzero(np.diff(logarithm[order]) > HELD_FREQUENCY) + 1
    return [np.sort(rows[part]) for part in np.split(order, cuts)]


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
