"""Tests whose disc moves faster with one direction of slip than with the other."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from viscofric.arrays import Array
from viscofric.friction.measurement.conditions import Condition, where
from viscofric.friction.measurement.fit import Entry, Growth
from viscofric.notes import Note
from viscofric.traction import TractionRuns


@dataclass(frozen=True, eq=False)
class Uneven:
    """Difference of the disc's speed between the directions of slip, and its effect on each condition.

    Coulomb friction, half the difference of the forces, then includes half the change of viscoelastic friction between
    the two speeds, and their mean is not the friction at the mean speed.  The change is removed where it follows from
    the other speeds of the test; its uncertainty is in the standard errors.
    """

    apart: Array  # (k,), difference of the speeds over the condition's; zero where it is within the tolerance
    growths: list[Growth | None] = field(repr=False)  # None where the speeds are the same

    @classmethod
    def of(cls, runs: TractionRuns, groups: list[Condition], tolerance: float) -> Uneven:
        """Compare the speeds of the disc where it is faster than the ball with those where it is slower."""
        apart = np.array([_apart(runs, group) for group in groups])
        apart = np.where(np.abs(apart) > tolerance, apart, 0.0)
        return cls(apart, [Growth.unknown() if one else None for one in apart.tolist()])

    def __bool__(self) -> bool:
        return bool(np.any(self.apart))

    def with_growths(self, bare: list[Entry], entries: list[Entry]) -> Uneven:
        """Return the change of friction from that at the speeds of each temperature and load."""
        # The standard errors of `entries` include the uncertainty of the change of friction, those of `bare` do not.
        growths = list(self.growths)
        for place in np.flatnonzero(self.apart).tolist():
            own = bare[place]
            growths[place] = _growth(own, [one for one in entries if own.group.alike(one.group)])
        return Uneven(self.apart, growths)

    def widened(self, place: int, entry: Entry) -> Entry:
        """Add the uncertainty of the change of friction to the standard errors of a condition."""
        growth, fit = self.growths[place], entry.fit
        if growth is None:
            return entry
        scatter, rest = growth.deviations(fit.log_speed)
        force = abs(entry.value[1]) * fit.viscoelastic_force
        by_scatter, by_rest = (
            np.sum((fit.operator @ (force * np.atleast_2d(some)).T) ** 2, axis=1) for some in (scatter, rest)
        )
        return entry.widened(by_scatter, entry.freedom[1]).widened(by_rest, np.inf)

    def notes(self, entries: list[Entry]) -> Iterator[Note]:
        """Yield notes on conditions where the speeds differ."""
        largest = 100 * float(np.abs(self.apart).max(initial=0.0))
        for taken in (True, False):
            every = zip(self.growths, entries, strict=True)
            found = [entry for growth, entry in every if growth is not None and growth.known == taken]
            if not found:
                continue
            what = (
                "is removed as far as it follows from friction at the other speeds; the rest is in the standard errors"
                if taken
                else "cannot be removed without other speeds, and half of it is in Coulomb friction; the standard "
                f"errors allow for a change as steep as speed itself{_size(found)}"
            )
            yield Note(
                "speed-differs",
                f"{where([entry.group for entry in found], len(entries))} the disc's speed differs by up to "
                f"{largest:.2g} % between directions of slip; the change of viscoelastic friction between them {what}.",
                values={
                    "conditions": len(found), "of": len(entries), "difference": 0.01 * largest, "removed": taken,
                },
            )  # fmt: skip


def _size(found: list[Entry]) -> str:
    errors = [entry.error[2] for entry in found if np.isfinite(entry.error[2])]
    return f" and are up to ±{max(errors):.2g}" if errors else ""


def _apart(runs: TractionRuns, group: Condition) -> float:
    faster = group.slip_sign == group.disc_sign
    if not np.any(group.slip_sign) or np.all(faster) or not np.any(faster):
        return 0.0
    speed = np.abs(runs.disc_speed[group.rows])
    return float(speed[faster].mean() - speed[~faster].mean()) / group.speed


def _growth(own: Entry, others: list[Entry]) -> Growth:
    """Return the change of friction about a condition's speed, from others at its temperature and load."""
    here = own.group
    # Of several slips at one speed, the nearest.
    at_speed = {here.speed: own}
    for one in others:
        group = one.group
        usable = one.value[1] > 0.0 and (np.isfinite(one.error[1]) or not np.isfinite(own.error[1]))
        if not usable or group.speed == here.speed:
            continue
        slip = abs(group.slip / group.speed - here.slip / here.speed)
        other = at_speed.get(group.speed)
        if other is None or slip < abs(other.group.slip / group.speed - here.slip / here.speed):
            at_speed[group.speed] = one
    if own.value[1] <= 0.0:
        return Growth.unknown()
    friction = np.array([one.value[1] for one in at_speed.values()])
    errors = np.array([one.error[1] for one in at_speed.values()])
    return Growth.best(
        np.log(np.array(list(at_speed)) / here.speed),
        np.log(friction),
        np.where(np.isfinite(errors), errors, 0.0) / friction,
        own.fit.log_speed,
    )
