"""Tests that move the disc faster with one direction of slip than with the other."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.friction.measurement.conditions import Condition, where
from viscofric.nominal import SAME_LOAD

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.friction.measurement.entry import Entry
    from viscofric.traction import TractionRuns

    Array: TypeAlias = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Uneven:
    """How much the disc's speed differs between the directions of slip, and what follows for each condition.

    Coulomb friction, half the difference of the forces, then holds half the change of viscoelastic friction between
    the two speeds.  With μ_v ~ vⁿ about the condition's speed, n being the slope of log μ_v over log v among the
    speeds of the test, the change is taken out.

    Attributes
    ----------
    apart : (k,) array
        Difference of the speeds over the condition's; zero where it is within the tolerance.
    slope, error : (k,) array
        n and its standard error; zero where it is not known or not needed.
    """

    apart: Array
    slope: Array
    error: Array

    @classmethod
    def of(cls, runs: TractionRuns, groups: list[Condition], tolerance: float) -> Uneven:
        """Compare the speeds of the disc where it is faster than the ball with those where it is slower."""
        apart = np.array([_apart(runs, group) for group in groups])
        return cls(np.where(np.abs(apart) > tolerance, apart, 0.0), np.zeros(apart.size), np.zeros(apart.size))

    def __bool__(self) -> bool:
        return bool(np.any(self.apart))

    def with_slopes(self, groups: list[Condition], entries: list[Entry]) -> Uneven:
        """Find the slopes from viscoelastic friction at the speeds of each temperature and load."""
        slope, error = np.zeros(len(groups)), np.zeros(len(groups))
        isotherms = defaultdict(list)
        for place, group in enumerate(groups):
            isotherms[group.temperature].append(place)
        for place in np.flatnonzero(self.apart).tolist():
            group = groups[place]
            alike = [
                other
                for other in isotherms[group.temperature]
                if abs(groups[other].load - group.load) <= SAME_LOAD * group.load
            ]
            slope[place], error[place] = _slope(place, alike, groups, entries)
        return Uneven(self.apart, slope, error)

    def coulomb_variance(self, place: int, entry: Entry) -> Array:
        """Return what the slope's error adds to the squared errors (4,), that of Coulomb friction."""
        deviation = 0.5 * self.apart[place] * entry.value[1] * self.error[place]
        return np.array([0.0, 0.0, float(deviation) ** 2, 0.0])

    def notes(self, groups: list[Condition]) -> list[str]:
        """Say where the speeds differ and what was made of it."""
        told = []
        largest = 100 * float(np.abs(self.apart).max(initial=0.0))
        for taken in (True, False):
            found = np.flatnonzero((self.apart != 0.0) & ((self.slope != 0.0) == taken))
            if not found.size:
                continue
            what = (
                "is taken out by the slope of viscoelastic friction over speed"
                if taken
                else "is in Coulomb friction, half of it, for want of other speeds that would tell it"
            )
            place = where([groups[one] for one in found], len(groups))
            told.append(
                f"{place} the disc's speed differs by up to {largest:.2g} % between directions of slip; the change of "
                f"viscoelastic friction between them {what}."
            )
        return told


def _apart(runs: TractionRuns, group: Condition) -> float:
    faster = group.slip_sign == group.disc_sign
    if not np.any(group.slip_sign) or np.all(faster) or not np.any(faster):
        return 0.0
    speed = np.abs(runs.disc_speed[group.rows])
    return float(speed[faster].mean() - speed[~faster].mean()) / group.speed


def _slope(place: int, alike: list[int], groups: list[Condition], entries: list[Entry]) -> tuple[float, float]:
    """Return d log μ_v / d log v between the nearest speeds on both sides, as far as there are such."""
    here = groups[place].speed
    slower = [one for one in alike if groups[one].speed < here]
    faster = [one for one in alike if groups[one].speed > here]
    # Of several slips at one speed, the nearest.
    slip = groups[place].slip / here

    def nearest(some: list[int]) -> int:
        if not some:
            return place
        return min(
            some,
            key=lambda one: (abs(np.log(groups[one].speed / here)), abs(groups[one].slip / groups[one].speed - slip)),
        )

    ends = nearest(slower), nearest(faster)
    value, error = (np.array([getattr(entries[one], kind)[1] for one in ends]) for kind in ("value", "error"))
    if ends[0] == ends[1] or np.any(value <= 0.0):
        return 0.0, 0.0
    span = float(np.log(groups[ends[1]].speed / groups[ends[0]].speed))
    relative = np.where(np.isfinite(error), error, 0.0) / value
    return float(np.log(value[1] / value[0])) / span, float(np.hypot(*relative)) / span
