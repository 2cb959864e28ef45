"""Readings far from the others of their configuration."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.friction.measurement.doubts import ROUNDING
from viscofric.notes import Note

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.friction.measurement.conditions import Condition
    from viscofric.friction.measurement.entry import Entry
    from viscofric.traction import TractionRuns


_OUTLIER = 5.0  # robust standard deviations
_FEWEST_FOR_OUTLIERS = 4  # readings of a configuration
_NAMED = 3  # outliers that a note names one by one


def outliers(runs: TractionRuns, groups: list[Condition], entries: list[Entry]) -> list[tuple[Condition, int]]:
    """Find the readings far from the others of their configuration: their conditions and rows."""
    if not groups:
        return []
    deviations = [_deviations(runs, group, entry.value[0]) for group, entry in zip(groups, entries, strict=True)]
    every = np.concatenate(deviations)
    configuration = np.concatenate([group.configurations for group in groups])
    # Few readings tell a scale badly; the whole test, and all readings of equal signs, tell what it may be at least.
    least = {
        one: max(_robust_deviation(every), _robust_deviation(every[configuration == one]))
        for one in np.unique(configuration).tolist()
    }
    found: list[tuple[Condition, int]] = []
    for group, deviation in zip(groups, deviations, strict=True):
        rounding = ROUNDING * float(np.abs(runs.traction_force[group.rows]).max())
        floor = max(_robust_deviation(deviation), rounding)
        for one in set(group.configurations.tolist()):
            same = np.flatnonzero(group.configurations == one)
            if same.size >= _FEWEST_FOR_OUTLIERS:
                scale = max(floor, least[one], _robust_deviation(deviation[same]))
                far = np.abs(deviation[same]) > _OUTLIER * scale * _of_few(same.size)
                found += [(group, int(row)) for row in group.rows[same[far]]]
    return found


def told_of(runs: TractionRuns, found: list[tuple[Condition, int]], *, left_out: bool) -> list[str]:
    """Name outliers, by their rows in the runs."""
    if not found:
        return []
    one = len(found) == 1
    named = [
        f"row {row + 1} (replicate {runs.replicate[row]}, {group}, {runs.traction_force[row]:.4g} N)"
        for group, row in found[:_NAMED]
    ]
    more = f" and {len(found) - _NAMED} more" if len(found) > _NAMED else ""
    told = Note(
        "outliers",
        f"{'One reading deviates' if one else f'{len(found)} readings deviate'} from the others of the same "
        f"configuration by more than {_OUTLIER:g} robust standard deviations and {'was' if one else 'were'} "
        f"{'left out' if left_out else 'kept'}: {', '.join(named)}{more}.",
    )
    return [told]


def _deviations(runs: TractionRuns, group: Condition, zero: float) -> Array:
    """Compare forces, brought to the mean load, with their configuration's median (not a number if few)."""
    force = (runs.traction_force[group.rows] - zero) * group.load / runs.load[group.rows]
    deviation = np.full(force.size, np.nan)
    for configuration in np.unique(group.configurations):
        same = group.configurations == configuration
        if np.count_nonzero(same) >= _FEWEST_FOR_OUTLIERS:
            deviation[same] = force[same] - np.median(force[same])
    return deviation


def _of_few(n: int) -> float:
    """How much further a reading may be off where few stand behind the median.

    An outlying one of n is off a median that has itself a variance of π/2n, and the median absolute deviation of n is
    small by about (n − 0.8)/n (C. Croux, P. J. Rousseeuw, Computational Statistics 1, 411–428, 1992).
    """
    return float(np.sqrt(1.0 + 0.5 * np.pi / n)) * n / (n - 0.8)


def _robust_deviation(deviation: Array) -> float:
    """Return the standard deviation told by the median, or by the mean where more than half are equal."""
    size = np.abs(deviation[np.isfinite(deviation)])
    if not size.size:
        return 0.0
    return 1.4826 * float(np.median(size)) or 1.2533 * float(np.mean(size))
