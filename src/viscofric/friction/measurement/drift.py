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

#: Fewest degrees of freedom of a rate, and those from which its error needs no scatter of other combinations.
_FEWEST, _ENOUGH = 2, 5
#: Change of Coulomb friction in the course of a test that it should show, and the part of one that is subtracted where
#: it may be running in: it lies between none and all.
_WORN, _HALF = 0.5, 0.5
_SURELY = 1.64  # standard errors that a change must be above the threshold, to be found in 95 % of tests
_ALL = 2.0  # change of Coulomb friction over its mean that leaves nothing of it
#: The zeros of a condition are used alone unless the error of their rate is so many times that of all conditions.
_FAR_BETTER = 3.0
# The recorded zeros are followed where this reduces the sum of squares by more than chance.
_WORTH = 0.8
_PER_HOUR = 3600.0


class Rate(NamedTuple):
    """A change that is linear in time; zero where it is not significant."""

    value: float = 0.0
    error: float = 0.0  # its standard error; the root of its expected square where it is not significant
    freedom: float = np.inf
    part: float = 1.0  # what is subtracted of it, the rest is in the errors

    @classmethod
    def found(cls, value: float, error: float, freedom: float, part: float = 1.0) -> Rate:
        """Return a rate, zero where it is within what chance makes."""
        if not math.isfinite(error):
            return _NONE
        if abs(value) >= threshold(freedom, CHANCE) * error:
            return cls(value, error, freedom, part)
        # Where it exceeds its error, it is expected to be more than that: normal with the variance by which its square
        # does so.
        sure = 1.0 - (error / value) ** 2 if abs(value) > error else 0.0
        return cls(0.0, math.hypot(sure * value, math.sqrt(sure) * error), freedom)

    @property
    def left(self) -> float:
        """Standard error of what is left of it."""
        return math.hypot(self.error, (1.0 - self.part) * self.value)


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
    hidden: float = 0.0  # change of Coulomb friction that could remain unnoticed, over its mean; zero where it is small

    @property
    def weights(self) -> Array:
        """Of the force and its corrections."""
        weights = np.zeros(4)
        weights[FORCE], weights[DRIFT], weights[ZERO_CHANGES] = 1.0, self.zero.value, float(self.follows)
        weights[WEAR] = self.coulomb.part * self.coulomb.value
        return weights

    @classmethod
    def of(cls, fits: list[Fit]) -> Drift:
        """Estimate the drift from the fitted zeros and Coulomb coefficients."""
        drift, error = cls._of_zeros(fits)
        rate, hidden = _of_coulomb(fits, drift.weights, error)
        return replace(drift, coulomb=rate, hidden=hidden)

    @classmethod
    def _of_zeros(cls, fits: list[Fit]) -> tuple[Drift, float]:
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
            return cls(follows=follows, wandering=_in_order_of_rows(fitted, uncorrected), timed=False), 0.0

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
            return cls(follows=follows, wandering=float(np.std(found.value, ddof=1))), 0.0
        return cls(found.rate(rounding), follows=follows), found.error

    def entry(self, fit: Fit, zeros: Zeros, error: Array, freedom: Array) -> Entry:
        """Return the result of a condition, with the error of the drift in its standard errors (4,)."""
        entry = fit.entry(self.weights, zeros, error, freedom)
        for rate, number in ((self.zero, DRIFT), (self.coulomb, WEAR)):
            entry = entry.widened((rate.left * fit.each[:, :, number].mean(axis=0)) ** 2, rate.freedom)
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
            words = (
                "for example by wear. Its errors include this; from viscoelastic friction, which it would change by up "
                f"to {size:.2g}, it is subtracted."
            )
            if self.coulomb.part < 1.0:
                words = (
                    "by wear or by running in, which the order of the readings does not distinguish. Wear would change "
                    f"viscoelastic friction by up to {size:.2g}: half of it is subtracted, and the errors include the "
                    "other half."
                )
            yield Note(
                "coulomb-drifts",
                f"Coulomb friction changes by {rate} ± {error} % per hour in the course of the test, {words}",
                # rate and its error in 1/s
                values={
                    "rate": self.coulomb.value,
                    "error": self.coulomb.error,
                    "viscoelastic": size,
                    "subtracted": self.coulomb.part,
                },
            )
        if self.hidden:
            yield Note(
                "wear-not-shown",
                f"Coulomb friction could change by {plain(100.0 * self.hidden, 2)} % in the course of the test, for "
                "example by wear, without being noticed in this order of the readings, and viscoelastic friction with "
                "it; repeat all runs once more, or measure the configurations of a condition in quick succession.",
                values={"change": self.hidden},
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


class _Slope(NamedTuple):
    """A rate whose corrections bring values (n,) nearest to zero, or to their means."""

    value: float
    left: Array  # (n,), values with the corrections
    freedom: int
    sensitivity: float  # sum of squares of the corrections

    @classmethod
    def of(cls, values: Array, corrections: Array, fitted: int) -> _Slope:
        """Fit values (n,) from which `fitted` others are found; `corrections` (n,) are those per unit of the rate."""
        sensitivity = float(corrections @ corrections)
        rate = -float(values @ corrections) / sensitivity if sensitivity > 0.0 else 0.0
        freedom = max(values.size - fitted - (sensitivity > 0.0), 0)
        return cls(rate, values + rate * corrections, freedom, sensitivity)

    @property
    def squares(self) -> float:
        """Sum of squares of what is left."""
        return float(self.left @ self.left)

    def error(self, squares: float, freedom: int) -> tuple[float, float]:
        """Return the standard error of the rate and its degrees of freedom; those of all values where its own are few.

        `squares` and `freedom` are those of all; the error is infinite where they are few as well.
        """
        own = self.squares / self.freedom if self.freedom else 0.0
        variance, freedom = (max(own, squares / freedom), freedom) if self.freedom < _ENOUGH else (own, self.freedom)
        if self.sensitivity <= 0.0 or freedom < _FEWEST:
            return np.inf, 1.0
        return math.sqrt(variance / self.sensitivity), freedom


class _Line(NamedTuple):
    """Straight lines of one slope through values (n,) at times (n,), s."""

    value: Array
    time: Array
    slope: _Slope
    error: float  # its standard error, infinite where it has too few degrees of freedom

    @classmethod
    def of(cls, points: list[tuple[Array, Array]], line: Integers) -> _Line:
        """Fit values and times of several conditions; `line` (k,) is the number of the line of each."""
        value, time = (np.concatenate(column) for column in zip(*points, strict=True))
        line = np.repeat(line, [len(values) for values, _ in points])
        slope = _Slope.of(_centred(value, line), -_centred(time, line), int(line.max()) + 1)
        return cls(value, time, slope, slope.error(slope.squares, max(slope.freedom, 1))[0])

    def wanders(self, rounding: float) -> bool:
        """Whether the values move otherwise than along the lines."""
        unexplained = float(np.sqrt(np.mean(self.slope.left**2)))
        return unexplained > rounding and wanders(self.slope.left[np.argsort(self.time, kind="stable")])

    def tells_far_better(self, other: _Line) -> bool:
        """Whether the error of the slope is far smaller than that of another one, which it does not contradict."""
        apart = abs(self.slope.value - other.slope.value)
        agree = apart <= threshold(other.slope.freedom, CHANCE) * other.error
        return agree and _FAR_BETTER * self.error <= other.error

    def rate(self, rounding: float) -> Rate:
        """Return the slope, zero where it is within what chance makes."""
        if abs(self.slope.value) * float(np.ptp(self.time)) <= rounding:
            return _NONE
        return Rate.found(self.slope.value, self.error, self.slope.freedom)


def _alike(fits: list[Fit]) -> Integers:
    """Return numbers of the temperature and load of conditions (k,)."""
    temperature, load = np.array([(fit.group.temperature, fit.group.load) for fit in fits]).T
    pairs = np.column_stack([temperature, numbered(load, SAME_LOAD * load)])
    return np.asarray(np.unique(pairs, axis=0, return_inverse=True)[1]).reshape(-1)


def _of_coulomb(fits: list[Fit], weights: Array, zero_error: float) -> tuple[Rate, float]:
    """Return the rate of Coulomb friction over its mean, and the change that could remain unnoticed.

    `zero_error` is the standard error of the rate of the zero, N/s.
    """
    # Wear changes Coulomb friction from one replicate to the next, from which a rate follows, and leaves a residual of
    # configurations that follow each other, from which another one follows. What changes alike at all conditions, such
    # as higher friction in the first replicate of each configuration, is in the first only: where the second
    # contradicts it, there is no wear; where the second may be zero as well, viscoelastic friction may be as it is.
    points, checked = _courses(fits, weights)
    if not points:
        return _NONE, 0.0
    times = np.concatenate([fit.times for fit in fits])
    length = float(np.nanmax(times) - np.nanmin(times))
    moved = np.concatenate([one - one.mean(axis=2, keepdims=True) for one in points], axis=2)
    course = _Slope.of(moved[1, 0], moved[1, 1], len(points))
    values, by_wear, by_drift = np.concatenate([np.zeros((3, 0)), *(one[2] for one in checked)], axis=1)
    residual = _Slope.of(values, by_wear, 0)
    rest = moved[0, 0] + course.value * moved[0, 1]
    squares = float(rest @ rest) + course.squares + residual.squares
    every = rest.size - len(points) + course.freedom + residual.freedom
    error, freedom = course.error(squares, every)
    other_error, other_freedom = residual.error(squares, every)
    if drifts := float(by_drift @ by_wear):
        other_error = math.hypot(other_error, zero_error * drifts / residual.sensitivity)
    hidden = length * min(
        (threshold(some, CHANCE) + _SURELY) * one for some, one in ((freedom, error), (other_freedom, other_error))
    )
    # Without degrees of freedom of its own, the course is used where it matters to viscoelastic friction; the residual
    # alone where it would show a change that is noted: of some orders it has hardly any.
    least = _least_change(fits, weights)
    if course.freedom < _ENOUGH and abs(course.value) <= least:
        error, other_error = np.inf, other_error if length * other_error <= _WORN else np.inf
    apart = threshold(min(freedom, other_freedom), CHANCE) * math.hypot(error, other_error)
    if abs(course.value - residual.value) > apart + ROUNDING * abs(course.value):
        return _NONE, 0.0
    found = Rate.found(course.value, error, freedom)
    if found.value:
        if abs(residual.value) <= threshold(other_freedom, CHANCE) * other_error:
            found = found._replace(part=_HALF)
    else:
        total = error**2 + other_error**2
        weight = other_error**2 / total if 0.0 < total < np.inf else float(np.isinf(other_error))
        mean = weight * course.value + (1.0 - weight) * residual.value
        error = min(error, other_error) if np.isinf(total) else error * math.sqrt(weight)
        freedom = freedom if weight > _HALF else other_freedom
        found = Rate.found(mean, error, freedom, _HALF)
    if not ROUNDING < abs(found.value) * length <= _ALL:
        found = found._replace(value=0.0)
    shown = found.value or hidden <= _WORN or not least * length < _WORN
    return found, 0.0 if shown else min(hidden, _ALL)


def _least_change(fits: list[Fit], weights: Array) -> float:
    """Return the least rate of Coulomb friction that would move viscoelastic friction out of its 95 % interval."""
    each = [fit.each[:, 1] @ weights for fit in fits if fit.paired]
    width = 2.0 * math.sqrt(np.mean([np.var(one, ddof=1) / len(one) for one in each]))
    moved = max(abs(float(fit.each[:, 1, WEAR].mean())) for fit in fits if fit.paired)
    return width / moved if moved > ROUNDING else np.inf


def _courses(fits: list[Fit], weights: Array) -> tuple[list[Array], list[Array]]:
    """Return what the replicates of conditions or runs were, and the same of those with four configurations."""
    # Each is (3, 3, r): viscoelastic and Coulomb coefficient and consistency; themselves, and their corrections by wear
    # and by drift; of each replicate; over mean Coulomb friction. A run over all speeds is one point, since its speeds
    # may differ alike from those of other runs. Where the replicates of a condition follow each other at once, there
    # are no such runs.
    alike: dict[tuple[float, int, bool], list[tuple[Fit, Array]]] = defaultdict(list)
    for fit in fits:
        each, mean = fit.each @ weights, fit.mean(weights)[2]
        if fit.paired and fit.slides and fit.coulomb is None and np.isfinite(fit.time) and np.all(each[:, 2] > 0.0):
            parts = np.stack([each, fit.each[:, :, WEAR], fit.each[:, :, DRIFT]])
            alike[fit.group.temperature, len(each), fit.checks].append((fit, np.moveaxis(parts[:, :, 1:], 2, 0) / mean))
    points, checked = [], []
    for (_, _, checks), several in alike.items():
        ends = np.array(sorted((fit.times.min(), fit.times.max()) for fit, _ in several))
        some = [one for _, one in several]
        some = some if np.all(ends[1:, 0] > ends[:-1, 1]) else [np.mean(some, axis=0)]
        points += some
        checked += some if checks else []
    return points, checked


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
