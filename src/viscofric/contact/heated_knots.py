"""Thermal resistances along a curve of speeds, from those of some of its contacts, the knots.

Over those of discs or strips of the same area in closed form, resistances change smoothly with speed:
between a few knots a decade they are interpolated.  So is by how much the rise of a state differs from the one
expected.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.heated import ThermalContact
from viscofric.contact.heated_result import Heat
from viscofric.heat.heating import ThermalResistances

#: By how much log10 α may differ between the states of two knots for others in between.
_SHIFTED = 0.4


def knots_of(contacts: Sequence[ThermalContact]) -> list[int]:
    """Return the rows of contacts whose resistances are found from their fields, ascending in speed.

    The first, the last, and of those between them some that are `knots_apart`.
    """
    speeds, rows = np.unique([abs(one.speed) for one in contacts], return_index=True)
    last, found = -math.inf, []
    for row, place in zip(rows.tolist(), np.log10(speeds).tolist(), strict=True):
        if place - last >= contacts[row].knots_apart or row == rows[-1]:
            found.append(row)
            last = place
    return found


class Knot(NamedTuple):
    """What a solved contact tells others about theirs, at nearby speeds."""

    drop: float  # of log10 α
    relative: ThermalResistances  # over those in closed form
    rise: float  # logarithm of the rise that it produces over the one expected

    @classmethod
    def of(cls, contact: ThermalContact, heat: Heat, drop: float = 0.0, rise: float = 0.0) -> Knot:
        """Return the knot of a contact whose resistances are known."""
        return cls(drop, contact.relative(heat), rise)

    @property
    def columns(self) -> list[float]:
        """What is interpolated; not in logarithms, since spots may be colder than the mean of their surface."""
        return [*self.relative, self.rise]


class Between:
    """Knots at any speed between those of solved contacts on one branch of states."""

    def __init__(self, speeds: Sequence[float], knots: Sequence[Knot | None]) -> None:
        """At speeds that ascend; None has no state on this branch, which is not followed across."""
        from scipy.interpolate import PchipInterpolator

        self._pieces: list[tuple[float, float, Any]] = []
        first = 0
        for end in range(1, len(knots) + 1):
            if end < len(knots) and _close(knots[end - 1], knots[end]):
                continue
            run = [one for one in knots[first:end] if one is not None]
            if len(run) > 1:
                columns: Array = np.array([one.columns for one in run])
                places = np.log(speeds[first:end])
                self._pieces.append((speeds[first], speeds[end - 1], PchipInterpolator(places, columns)))
            first = end

    def __call__(self, speed: float) -> Knot | None:
        """Return the knot at a speed, None if there is none on both sides of it."""
        for slowest, fastest, smooth in self._pieces:
            if slowest <= speed <= fastest:
                *relative, rise = smooth(math.log(speed)).tolist()
                return Knot(0.0, ThermalResistances(*relative), rise)
        return None


def _close(one: Knot | None, other: Knot | None) -> bool:
    return one is not None and other is not None and abs(one.drop - other.drop) <= _SHIFTED
