"""Tests that move the disc faster with one direction of slip than with the other."""

from __future__ import annotations

import math
from collections import defaultdict
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from viscofric.friction.measurement.conditions import Condition, where
from viscofric.nominal import SAME_LOAD
from viscofric.notes import Note

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.friction.measurement.fit import Entry, Fit
    from viscofric.traction import TractionRuns


#: Largest derivatives of ln μ_v by ln v, first to fourth.  Loss is a sum of x/(1 + x²) over retardation times; 4000
#: sums of up to four such terms, drawn at random, reached 1.0, 1.0, 1.54 and 3.3.  Rounded up, by half the last one:
#: a maximum of friction half a decade wide, sharper than any of those, has 0.9, 1.1, 2.1 and 5.4.
STEEPEST = (1.0, 1.2, 2.0, 5.0)
#: Standard error of a derivative that is not known, over its largest: more than of equal chances up to that, 1/√3,
#: since sharp curves reach it with one sign at many speeds.
_STANDARD = 0.7


@dataclass(frozen=True, eq=False)
class Growth:
    """A polynomial through ln μ_v at up to four speeds, the condition's own first.

    What it leaves over is f⁽ᵏ⁾/k! ∏(L − X_j) of the k speeds X_j, with a derivative f⁽ᵏ⁾ no larger than `STEEPEST`;
    with the own speed alone that is all there is.

    Where a maximum of friction was half a decade wide and the disc's speeds differed by 20 or 50 %, 95 % intervals held
    92 % or more of viscoelastic and all of Coulomb friction, at 2, 3, 4 and 6 speeds; where they differed by 100 %,
    96 % and 99 % at 4 speeds, 73 % and 83 % at 6 with a quarter of the noise.  For a power of speed they are too wide,
    those of Coulomb friction three times at 20 % and seven times at 100 %.

    Attributes
    ----------
    places : (k,) array
        ln of the speeds over the condition's; the first is zero.
    values : (k,) array
        ln μ_v there.
    errors : (k,) array
        Their standard errors.
    """

    places: Array
    values: Array
    errors: Array

    @classmethod
    def unknown(cls) -> Growth:
        """Nothing is known from other speeds."""
        return cls(np.zeros(1), np.zeros(1), np.zeros(1))

    @classmethod
    def best(cls, places: Array, values: Array, errors: Array, log_speed: Array) -> Growth:
        """Take as many of the nearest speeds (k,) as tell best what friction is at `log_speed` (n,)."""
        order = np.argsort(np.abs(places), kind="stable")[: len(STEEPEST)]
        several = [
            cls(places[order[:count]], values[order[:count]], errors[order[:count]])
            for count in range(1, order.size + 1)
        ]

        def uncertain(one: Growth) -> float:
            scatter, rest = one.deviations(log_speed)
            return float(np.sum(scatter**2) + np.sum(rest**2))

        return min(several, key=uncertain)

    @property
    def known(self) -> bool:
        """Whether other speeds tell anything."""
        return self.places.size > 1

    def log_change(self, log_speed: Array) -> Array:
        """Return ln μ_v at log speeds (n,) less that at the condition's speed."""
        return self._weights(log_speed) @ self.values

    def deviations(self, log_speed: Array) -> tuple[Array, Array]:
        """Return what one standard error changes of `log_change`: of each speed's friction (k, n), and of the rest."""
        scatter = self.errors[:, None] * self._weights(log_speed).T
        count = self.places.size
        product = np.prod(log_speed[:, None] - self.places, axis=1)
        return scatter, _STANDARD * STEEPEST[count - 1] / math.factorial(count) * product

    def _weights(self, log_speed: Array) -> Array:
        """Return Lagrange's polynomials (n, k) less what they are at the condition's speed."""
        weights = np.ones((log_speed.size, self.places.size))
        for one, other in np.ndindex(weights.shape[1], weights.shape[1]):
            if one != other:
                weights[:, one] *= (log_speed - self.places[other]) / (self.places[one] - self.places[other])
        weights[:, 0] -= 1.0
        return weights


@dataclass(frozen=True, eq=False)
class Uneven:
    """How much the disc's speed differs between the directions of slip, and what follows for each condition.

    Coulomb friction, half the difference of the forces, then holds half the change of viscoelastic friction between
    the two speeds, and their mean is not the friction at the mean speed.  As far as the other speeds of the test tell
    how friction changes, it is taken out; what they leave open is in the standard errors.

    Attributes
    ----------
    apart : (k,) array
        Difference of the speeds over the condition's; zero where it is within the tolerance.
    growths : list of Growth or None
        None where the speeds are the same.
    """

    apart: Array
    growths: list[Growth | None] = field(repr=False)

    @classmethod
    def of(cls, runs: TractionRuns, groups: list[Condition], tolerance: float) -> Uneven:
        """Compare the speeds of the disc where it is faster than the ball with those where it is slower."""
        apart = np.array([_apart(runs, group) for group in groups])
        apart = np.where(np.abs(apart) > tolerance, apart, 0.0)
        return cls(apart, [Growth.unknown() if one else None for one in apart.tolist()])

    def __bool__(self) -> bool:
        return bool(np.any(self.apart))

    def with_growths(self, fits: list[Fit], bare: list[Entry], entries: list[Entry]) -> Uneven:
        """Find how friction changes from that at the speeds of each temperature and load.

        Parameters
        ----------
        fits : list of Fit
        bare, entries : list of Entry
            Without and with what the change of friction leaves open in the standard errors.
        """
        growths = list(self.growths)
        isotherms = defaultdict(list)
        for place, fit in enumerate(fits):
            isotherms[fit.group.temperature].append(place)
        for place in np.flatnonzero(self.apart).tolist():
            group = fits[place].group
            alike = [
                other
                for other in isotherms[group.temperature]
                if abs(fits[other].group.load - group.load) <= SAME_LOAD * group.load
            ]
            growths[place] = _growth(place, alike, fits, bare, entries)
        return Uneven(self.apart, growths)

    def widened(self, place: int, fit: Fit, entry: Entry) -> Entry:
        """Add what the change of friction leaves open to the standard errors of a condition."""
        growth = self.growths[place]
        if growth is None:
            return entry
        scatter, rest = growth.deviations(fit.log_speed)
        force = abs(entry.value[1]) * fit.viscoelastic_force
        by_scatter, by_rest = (
            np.sum((fit.operator @ (force * np.atleast_2d(some)).T) ** 2, axis=1) for some in (scatter, rest)
        )
        return entry.widened(by_scatter, entry.freedom[1]).widened(by_rest, np.inf)

    def notes(self, groups: list[Condition], entries: list[Entry]) -> list[Note]:
        """Say where the speeds differ and what was made of it."""
        told = []
        largest = 100 * float(np.abs(self.apart).max(initial=0.0))
        for taken in (True, False):
            found = [place for place, one in enumerate(self.growths) if one is not None and one.known == taken]
            if not found:
                continue
            what = (
                "is taken out as far as friction at the other speeds tells it; the rest is in the standard errors"
                if taken
                else "is in Coulomb friction, half of it, for want of other speeds that would tell it; the standard "
                f"errors allow for a change as steep as speed itself{_size(found, entries)}"
            )
            place = where([groups[one] for one in found], len(groups))
            told.append(
                Note(
                    "speed-differs",
                    f"{place} the disc's speed differs by up to {largest:.2g} % between directions of slip; the "
                    "change of "
                    f"viscoelastic friction between them {what}.",
                )
            )
        return told


def _size(found: list[int], entries: list[Entry]) -> str:
    errors = [error for error in (entries[place].error[2] for place in found) if np.isfinite(error)]
    return f" and are up to ±{max(errors):.2g}" if errors else ""


def _apart(runs: TractionRuns, group: Condition) -> float:
    faster = group.slip_sign == group.disc_sign
    if not np.any(group.slip_sign) or np.all(faster) or not np.any(faster):
        return 0.0
    speed = np.abs(runs.disc_speed[group.rows])
    return float(speed[faster].mean() - speed[~faster].mean()) / group.speed


def _growth(place: int, alike: list[int], fits: list[Fit], bare: list[Entry], entries: list[Entry]) -> Growth:
    """Return how friction changes about a condition's speed, from those at its temperature and load."""
    here = fits[place].group
    known = np.isfinite(bare[place].error[1])

    def error(one: int) -> float:
        # A condition's own error is not to grow by what follows from it.
        return float((bare if one == place else entries)[one].error[1])

    # Of several slips at one speed, the nearest.
    at_speed: dict[float, int] = {here.speed: place}
    for one in alike:
        group = fits[one].group
        usable = entries[one].value[1] > 0.0 and (np.isfinite(error(one)) or not known)
        if not usable or group.speed == here.speed:
            continue
        slip = abs(group.slip / group.speed - here.slip / here.speed)
        other = at_speed.get(group.speed)
        if other is None or slip < abs(fits[other].group.slip / group.speed - here.slip / here.speed):
            at_speed[group.speed] = one
    if entries[place].value[1] <= 0.0:
        return Growth.unknown()
    nodes = list(at_speed.values())
    friction = np.array([entries[one].value[1] for one in nodes])
    errors = np.array([error(one) for one in nodes])
    return Growth.best(
        np.log(np.array(list(at_speed)) / here.speed),
        np.log(friction),
        np.where(np.isfinite(errors), errors, 0.0) / friction,
        fits[place].log_speed,
    )
