"""Drift of the force cell's zero and of Coulomb friction: estimated from the fits, and removed from the separation."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array, Integers
from viscofric.friction.intervals import threshold
from viscofric.friction.measurement.doubts import CHANCE
from viscofric.friction.measurement.fit import DRIFT, FORCE, WEAR, ZERO_CHANGES, Entry, Fit
from viscofric.friction.measurement.zeros import ROUNDING, Zeros, wanders
from viscofric.nominal import SAME_LOAD, numbered
from viscofric.notes import Note
from viscofric.units import plain, shown_number

_FEWEST = 3  # degrees of freedom of a rate
#: The zeros of a condition are used alone unless the error of their rate is so many times that of all conditions.
_FAR_BETTER = 3.0
# The recorded zeros are followed where this reduces the sum of squares by more than chance.
_WORTH = 0.8
_PER_HOUR = 3600.0


class Rate(NamedTuple):
    """A change that is linear in time; zero where it is not significant."""

    value: float = 0.0
    error: float = 0.0  # its standard error
    freedom: float = np.inf


_NONE = Rate()


@dataclass(frozen=True)
class Drift:
    """Drift that is subtracted from the forces besides the zero of each condition."""

    zero: Rate = _NONE  # N/s
    coulomb: Rate = _NONE  # of Coulomb friction over its mean, 1/s
    follows: bool = False  # whether the zero follows its changes from one recording to the next
    # standard deviation, N, of a zero that drifts otherwise, or without recorded times; zero where it does not
    wandering: float = 0.0
    timed: bool = True  # whether the times were recorded

    @property
    def weights(self) -> Array:
        """Of the force and its corrections."""
        weights = np.zeros(4)
        weights[FORCE], weights[DRIFT], weights[ZERO_CHANGES] = 1.0, self.zero.value, float(self.follows)
        weights[WEAR] = self.coulomb.value
        return weights

    @classmethod
    def of(cls, fits: list[Fit]) -> Drift:
        """Estimate the drift from the fitted zeros and Coulomb coefficients."""
        drift = cls._of_zeros(fits)
        return replace(drift, coulomb=_of_coulomb(fits, drift.weights))

    @classmethod
    def _of_zeros(cls, fits: list[Fit]) -> Drift:
        # Each replicate's zero is fitted at the mean time of its readings. The rate is that of one straight line for
        # each condition, all of one slope, where conditions were repeated; of one line for the whole test where not.
        # Where they were repeated at once, it is known far better from lines for each temperature and load, between
        # which zeros may differ without any drift.
        fitted = [fit for fit in fits if fit.fits_offset]
        follows = _follows(fitted)
        fitted = [fit for fit in fitted if np.isfinite(fit.recorded)] if follows else fitted
        uncorrected = cls(follows=follows).weights
        timed = [fit for fit in fitted if np.isfinite(fit.time)]
        repeated = [fit for fit in timed if len(fit.each) > 1]
        if not timed:
            return cls(follows=follows, wandering=_in_order_of_rows(fitted, uncorrected), timed=False)

        def line(some: list[Fit], of: Integers) -> _Line:
            # Where readings of a replicate have unequal weights, its zero is that at their weighted mean time.
            return _Line.of([(fit.offset(uncorrected), fit.time - fit.each[:, 0, DRIFT]) for fit in some], of)

        rounding = ROUNDING * max(fit.group.load for fit in timed)
        if not repeated:
            found = line(timed, np.zeros(len(timed), dtype=np.intp))
        else:
            found = line(repeated, np.arange(len(repeated)))
            together = line(timed, _alike(timed))
            if together.tells_far_better(found) and not together.wanders(rounding):
                found = together
        if found.wanders(rounding):
            return cls(follows=follows, wandering=float(np.std(found.value, ddof=1)))
        return cls(found.rate(rounding), follows=follows)

    def entry(self, fit: Fit, zeros: Zeros, error: Array, freedom: Array) -> Entry:
        """Return the result of a condition, with the error of the drift in its standard errors (4,)."""
        entry = fit.entry(self.weights, zeros, error, freedom)
        for rate, number in ((self.zero, DRIFT), (self.coulomb, WEAR)):
            entry = entry.widened((rate.error * fit.each[:, :, number].mean(axis=0)) ** 2, rate.freedom)
        return entry

    def notes(self, fits: list[Fit]) -> Iterator[Note]:
        """Yield notes on the drift and its treatment."""
        load = float(np.mean([fit.group.load for fit in fits]))
        if self.follows:
            yield Note(
                "zero-unsteady",
                "The zero of the force cell changes from one recording to the next and the forces change with it, so "
                "that each reading is taken relative to its own recorded zero.",
            )
        if self.coulomb.value:
            moved = np.array([fit.each[:, 1, WEAR].mean() for fit in fits])
            size = float(np.abs(self.coulomb.value * moved).max())
            rate, error = (plain(100.0 * _PER_HOUR * one, 2) for one in (self.coulomb.value, self.coulomb.error))
            yield Note(
                "coulomb-drifts",
                f"Coulomb friction changes by {rate} ± {error} % per hour in the course of the test, for example by "
                "wear. Its errors include this; from viscoelastic friction, which it would change by up to "
                f"{size:.2g}, it is subtracted.",
                # rate and its error in 1/s
                values={"rate": self.coulomb.value, "error": self.coulomb.error, "viscoelastic": size},
            )
        if self.zero.value:
            moved = np.array([fit.each[:, 1:3, DRIFT].mean(axis=0) for fit in fits if fit.fits_offset])
            size = np.abs(self.zero.value * moved).max(axis=0)
            yield Note(
                "zero-drifts",
                f"The zero of the force cell drifts by {shown_number(_PER_HOUR * self.zero.value, '.2g')} ± "
                f"{_PER_HOUR * self.zero.error:.1g} N/h, "
                f"which is taken out; left in, it would change the friction coefficients by up to {size[0]:.2g} "
                f"(viscoelastic) and {size[1]:.2g} (Coulomb).",
                values={  # rate and its error in N/s
                    "rate": self.zero.value,
                    "error": self.zero.error,
                    "viscoelastic": float(size[0]),
                    "coulomb": float(size[1]),
                },
            )
        if self.wandering:
            how, advice = "unevenly ", "measure the configurations of a condition in quick succession"
            if not self.timed:
                how, advice = "", "record the times of the readings (time)"
            yield Note(
                "zero-wanders",
                f"The zero of the force cell moves {how}in the course of the test, with a standard deviation of "
                f"{self.wandering:.2g} N ({self.wandering / load:.2g} of the load), which cannot be taken out; "
                f"{advice}.",
                values={"standard_deviation": self.wandering, "of_load": self.wandering / load},
            )


@dataclass(frozen=True, eq=False)
class _Line:
    """Straight lines of one slope through values (n,) at times (n,), s."""

    value: Array
    time: Array
    residual: Array
    slope: float  # per s
    error: float  # its standard error, infinite where it has too few degrees of freedom
    freedom: float

    @classmethod
    def of(cls, points: list[tuple[Array, Array]], line: Integers) -> _Line:
        """Fit values and times of several conditions; `line` (k,) is the number of the line of each."""
        value, time = (np.concatenate(column) for column in zip(*points, strict=True))
        line = np.repeat(line, [len(values) for values, _ in points])
        early, centred = _centred(time, line), _centred(value, line)
        sensitivity, freedom = float(np.sum(early**2)), int(line.size - line.max() - 2)
        if freedom < _FEWEST or sensitivity <= 0.0:
            return cls(value, time, np.zeros(value.size), 0.0, np.inf, freedom)
        slope = float(np.sum(early * centred)) / sensitivity
        residual = centred - slope * early
        return cls(value, time, residual, slope, float(np.sqrt(np.sum(residual**2) / freedom / sensitivity)), freedom)

    def wanders(self, rounding: float) -> bool:
        """Whether the values move otherwise than along the lines."""
        unexplained = float(np.sqrt(np.mean(self.residual**2)))
        return unexplained > rounding and wanders(self.residual[np.argsort(self.time, kind="stable")])

    def tells_far_better(self, other: _Line) -> bool:
        """Whether the error of the slope is far smaller than that of another one, which it does not contradict."""
        agree = abs(self.slope - other.slope) <= threshold(other.freedom, CHANCE) * other.error
        return agree and _FAR_BETTER * self.error <= other.error

    def rate(self, rounding: float) -> Rate:
        """Return the slope, zero where it is within what chance makes."""
        if abs(self.slope) * float(np.ptp(self.time)) <= rounding:
            return _NONE
        if not np.isfinite(self.error) or abs(self.slope) < threshold(self.freedom, CHANCE) * self.error:
            return _NONE
        return Rate(self.slope, self.error, self.freedom)


def _alike(fits: list[Fit]) -> Integers:
    """Return numbers of the temperature and load of conditions (k,)."""
    temperature, load = np.array([(fit.group.temperature, fit.group.load) for fit in fits]).T
    pairs = np.column_stack([temperature, numbered(load, SAME_LOAD * load)])
    return np.asarray(np.unique(pairs, axis=0, return_inverse=True)[1]).reshape(-1)


def _of_coulomb(fits: list[Fit], weights: Array) -> Rate:
    """Return the rate of Coulomb friction over its mean, by lines of one slope."""
    # A run over all speeds is one point, since its speeds may differ alike from those of other runs. Where the
    # replicates of a condition follow each other at once, there are no such runs, and each condition has its own line.
    # What changes alike at all conditions, such as higher friction in the first replicate of each configuration, is no
    # wear: the residuals of the configurations do not have its changes from one configuration to the next.
    alike: dict[tuple[float, int], list[Array]] = defaultdict(list)
    residuals: list[Array] = []
    for fit in fits:
        each, mean = fit.each[:, 2] @ weights, fit.mean(weights)[2]
        if fit.paired and fit.slides and fit.coulomb is None and np.isfinite(fit.time) and np.all(each > 0.0):
            alike[fit.group.temperature, len(each)].append(
                np.stack([each, fit.time * mean - fit.each[:, 2, WEAR]]) / mean
            )
            if fit.checks:
                residuals.append(np.stack([fit.each[:, 3] @ weights, fit.each[:, 3, WEAR]]))
    points: list[Array] = []
    for several in alike.values():
        ends = np.array([one[1][[0, -1]] for one in sorted(several, key=lambda one: one[1].min())])
        at_once = np.all(ends.min(axis=1)[1:] > ends.max(axis=1)[:-1])
        points += several if at_once else [np.mean(several, axis=0)]
    rate = _Line.of([tuple(one) for one in points], np.arange(len(points))).rate(ROUNDING) if points else _NONE
    return _NONE if rate.value and residuals and _contradict(np.concatenate(residuals, axis=1), rate) else rate


def _contradict(residuals: Array, rate: Rate) -> bool:
    """Whether residuals and their corrections per unit of a rate (2, n) are those of another rate."""
    residual, correction = residuals
    if np.abs(rate.value * correction).max() <= ROUNDING:
        return False
    squares, freedom = float(correction @ correction), residual.size - 1
    other = -float(residual @ correction) / squares
    error = float(np.sqrt(np.sum((residual + other * correction) ** 2) / freedom / squares))
    chance = threshold(min(freedom, rate.freedom), CHANCE) * math.hypot(error, rate.error)
    return abs(rate.value - other) > chance + ROUNDING * abs(rate.value)


def _in_order_of_rows(fits: list[Fit], weights: Array) -> float:
    """Return the standard deviation of zeros that vary smoothly with the row, N; zero where they do not."""
    if not fits:
        return 0.0
    row = np.concatenate([fit.first_rows for fit in fits])
    zero = np.concatenate([fit.offset(weights) for fit in fits])[np.argsort(row, kind="stable")]
    deviation = float(np.std(zero, ddof=1)) if zero.size > 1 else 0.0
    return deviation if deviation > ROUNDING * max(fit.group.load for fit in fits) and wanders(zero) else 0.0


def _centred(values: Array, line: Integers) -> Array:
    return np.asarray(values - (np.bincount(line, values) / np.bincount(line))[line])


def _follows(fits: list[Fit]) -> bool:
    """Whether the forces follow the changes of the recorded zero, by their residuals."""
    left, force = np.zeros(2), 0.0
    for follows in (0, 1):
        weights = np.array([1.0, 0.0, float(follows), 0.0])
        for fit in fits:
            force = max(force, fit.group.load)
            if len(fit.each) > 1:
                each = fit.each[:, 1:] @ weights * fit.group.load
                left[follows] += np.sum((each - each.mean(axis=0)) ** 2) + np.sum(each[:, -1] ** 2)
            else:
                left[follows] += np.sum((fit.residual @ weights) ** 2)
    return bool(left[1] < _WORTH * left[0] and left[0] > (ROUNDING * force) ** 2)
