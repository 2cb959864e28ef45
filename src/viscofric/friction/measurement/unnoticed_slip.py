"""Pure rolling that was none: Coulomb friction in what was taken for viscoelastic friction alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.friction.measurement.doubts import CHANCE, ROUNDING, threshold
from viscofric.nominal import SAME_LOAD
from viscofric.notes import Note

if TYPE_CHECKING:
    from viscofric.friction.measurement.entry import Entry
    from viscofric.friction.measurement.separation import Fit

# What unnoticed slip adds to viscoelastic friction, over Coulomb friction, for it to matter.
_MATTERS = 0.1


def unnoticed_slip(fits: list[Fit], entries: list[Entry]) -> tuple[list[int], list[Note]]:
    """Compare viscoelastic friction in pure rolling with that of the largest slip at the same speed.

    Slip that is too small to be measured can still hold much of Coulomb friction, with one sign.

    Returns
    -------
    list of int
        Places of the conditions where it does.
    list of str
        Notes that say so.
    """
    sliding: dict[tuple[float, float], list[int]] = {}
    for place, (fit, entry) in enumerate(zip(fits, entries, strict=True)):
        if entry.slides and fit.coulomb is None:
            sliding.setdefault((fit.group.temperature, fit.group.speed), []).append(place)
    found, told = [], []
    for place, (fit, entry) in enumerate(zip(fits, entries, strict=True)):
        group = fit.group
        alike = [
            other
            for other in sliding.get((group.temperature, group.speed), [])
            if abs(fits[other].group.load - group.load) <= SAME_LOAD * group.load
        ]
        if entry.slides or not alike:
            continue
        other = entries[max(alike, key=lambda one: fits[one].group.slip)]
        apart = abs(entry.value[1] - other.value[1])
        error = float(np.hypot(entry.error[1], other.error[1]))
        chance = threshold(min(entry.freedom[1], other.freedom[1]), CHANCE / len(fits))
        # Compared in this way, an infinite error tells nothing.
        if apart > chance * error and apart > max(_MATTERS * abs(other.value[2]), ROUNDING):
            found.append(place)
            told.append(
                Note(
                    "unnoticed-slip",
                    f"At {group} viscoelastic friction without slip, {entry.value[1]:.2g} ± {entry.error[1]:.2g}, is "
                    "not "
                    f"that with slip, {other.value[1]:.2g} ± {other.error[1]:.2g}: ball and disc probably slip there "
                    "by "
                    "less than can be measured, and Coulomb friction is in it; it is left out.",
                )
            )
    return found, told
