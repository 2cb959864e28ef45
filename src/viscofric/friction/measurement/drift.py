"""Drift of the force cell's zero and of Coulomb friction: estimated from the fits, and removed from the separation."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, Self

import numpy as np

from viscofric.arrays import Array, Integers
from viscofric.friction.intervals import threshold
from viscofric.friction.measurement.doubts import CHANCE
from viscofric.friction.measurement.fit import DRIFT, FORCE, WEAR, ZERO_CHANGES, Entry, Fit
from viscofric.friction.measurement.zeros import ROUNDING, Zeros, wanders
from viscofric.nominal import SAME_LOAD, numbered
from viscofric.notes import Note
from viscofric.showing import with_error
from viscofric.units import plain

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
    """A change that is linear in time."""

    value: float = 0.0
    error: float = 0.0  # its standard error; the root of its expected square where it is not significant
    freedom: float = np.inf
    part: float = 1.0  # what is subtracted of it, the rest is in the errors

    @property
    def left(self) -> float:
        """Standard error of what is left of it."""
        return math.hypot(self.error, (1.0 - self.part) * self.value)

    @property
    def significant(self) -> bool:
        """Whether it is more than chance makes."""
        return abs(self.value) > threshold(self.freedom, CHANCE) * self.error

    def judged(self) -> Rate:
        """Return the rate, or zero where it is not significant."""
        if not math.isfinite(self.error):
            return _NONE
        if self.significant:
            return self
        # Its expected square, of a rate that is normal with any variance: the share of the error in the variance of its
        # estimate is as likely to be one number from zero to one as another (W. E. Strawderman, Ann. Math. Stat. 42
        # (1971) 385).  A rate below its error counts too: it may be as large as the error by chance.
        from scipy.special import hyp1f1

        square = (self.value / self.error) ** 2 if self.error > 0.0 else 0.0
        of_none, once, twice = (float(hyp1f1(n + 1.5, n + 2.5, -0.5 * square)) / (n + 1.5) for n in range(3))
        expected = 1.0 - once / of_none + square * (1.0 - (2.0 * once - twice) / of_none)
        return Rate(0.0, math.sqrt(expected) * self.error, self.freedom)


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

    @classmethod
    def of(cls, fits: list[Fit]) -> Drift:
        """Estimate the drift from the fitted zeros and Coulomb coefficients."""
        drift, zero_error = _of_zeros(fits)
        coulomb, hidden = _of_coulomb(fits, drift.weights, zero_error)
        return replace(drift, coulomb=coulomb, hidden=hidden)

    @property
    def weights(self) -> Array:
        """Of the force and its corrections."""
        weights = np.zeros(4)
        weights[FORCE], weights[DRIFT], weights[ZERO_CHANGES] = 1.0, self.zero.value, float(self.follows)
        weights[WEAR] = self.coulomb.part * self.coulomb.value
        return weights

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
            rate = with_error(*(100.0 * _PER_HOUR * one for one in (self.coulomb.value, self.coulomb.error)))
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
                f"Coulomb friction changes by {rate} % per hour in the course of the test, {words}",
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
                "The zero of the force cell drifts by "
                f"{with_error(_PER_HOUR * self.zero.value, _PER_HOUR * self.zero.error)} N/h, "
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
class _Trend:
    """A rate whose corrections bring values (n,) nearest to zero: least squares of one unknown."""

    value: float
    left: Array  # (n,), values with the corrections
    freedom: int
    corrections: float  # sum of their squares, per unit of the rate

    @classmethod
    def of(cls, values: Array, corrections: Array, fitted: int) -> Self:
        """Fit values (n,) from which `fitted` others are found; `corrections` (n,) are those per unit of the rate."""
        squares = float(corrections @ corrections)
        value = -float(values @ corrections) / squares if squares > 0.0 else 0.0
        freedom = max(values.size - fitted - (squares > 0.0), 0)
        return cls(value, values + value * corrections, freedom, squares)

    @property
    def squares(self) -> float:
        """Sum of squares of what is left."""
        return float(self.left @ self.left)

    def rate(self, squares: float, freedom: int) -> Rate:
        """Return the rate with its error, by the scatter of all values where its own degrees of freedom are few.

        `squares` and `freedom` are those of all; the error is infinite where they are few as well.
        """
        own = self.squares / self.freedom if self.freedom else 0.0
        few = self.freedom < _ENOUGH
        variance, freedom = (max(own, squares / freedom), freedom) if few else (own, self.freedom)
        if self.corrections <= 0.0 or freedom < _FEWEST:
            return Rate(self.value, np.inf, 1.0)
        return Rate(self.value, math.sqrt(variance / self.corrections), freedom)


# --- drift of the zero ---------------------------------------------------------------------------------------


def _of_zeros(fits: list[Fit]) -> tuple[Drift, float]:
    """Return the drift of the zero, and the standard error of its rate, N/s."""
    # Each replicate's zero is fitted at the mean time of its readings. The rate is that of one straight line for
    # each condition, all of one slope, where conditions were repeated; of one line for the whole test where not.
    # Where they were repeated at once, it is known far better from lines for each temperature and load, between
    # which zeros may differ without any drift.
    fitted = [fit for fit in fits if fit.fits_offset]
    follows = _follows(fitted)
    fitted = [fit for fit in fitted if not follows or np.isfinite(fit.recorded)]
    uncorrected = Drift(follows=follows).weights
    timed = [fit for fit in fitted if np.isfinite(fit.time)]
    if not timed:
        return Drift(follows=follows, wandering=_in_order_of_rows(fitted, uncorrected), timed=False), 0.0
    rounding = ROUNDING * max(fit.group.load for fit in timed)
    repeated = [fit for fit in timed if fit.paired]
    lines = _Lines.through(repeated or timed, range(len(repeated)) if repeated else [0] * len(timed), uncorrected)
    if repeated:
        together = _Lines.through(timed, _alike(timed), uncorrected)
        if together.far_better_known(lines) and not together.wander(rounding):
            lines = together
    if lines.wander(rounding):
        return Drift(follows=follows, wandering=float(np.std(lines.zeros, ddof=1))), 0.0
    negligible = abs(lines.rate.value) * lines.length <= rounding
    return Drift(_NONE if negligible else lines.rate.judged(), follows=follows), lines.rate.error


@dataclass(frozen=True, eq=False)
class _Lines:
    """Straight lines of one slope through zeros (n,), in the order of time."""

    zeros: Array
    left: Array  # (n,), deviations from the lines
    rate: Rate
    length: float  # from the first to the last, s

    @classmethod
    def through(cls, fits: list[Fit], line: Sequence[int], weights: Array) -> Self:
        """Fit the zeros of the replicates of conditions (k,); `line` (k,) are the numbers of the lines."""
        # Where readings of a replicate have unequal weights, its zero is that at their weighted mean time.
        time = np.concatenate([fit.time - fit.each[:, 0, DRIFT] for fit in fits])
        order = np.argsort(time, kind="stable")
        time, zeros = time[order], np.concatenate([fit.offset(weights) for fit in fits])[order]
        lines = np.repeat(line, [len(fit.each) for fit in fits])[order]
        trend = _Trend.of(_centred(zeros, lines), -_centred(time, lines), max(line) + 1)
        return cls(zeros, trend.left, trend.rate(trend.squares, max(trend.freedom, 1)), float(np.ptp(time)))

    def wander(self, rounding: float) -> bool:
        """Whether the zeros move otherwise than along the lines."""
        return float(np.sqrt(np.mean(self.left**2))) > rounding and wanders(self.left)

    def far_better_known(self, other: _Lines) -> bool:
        """Whether the error of the slope is far smaller than that of another one, which it does not contradict."""
        apart = abs(self.rate.value - other.rate.value)
        agree = apart <= threshold(other.rate.freedom, CHANCE) * other.rate.error
        return agree and _FAR_BETTER * self.rate.error <= other.rate.error


def _alike(fits: list[Fit]) -> list[int]:
    """Return numbers of the temperature and load of conditions (k,)."""
    temperature, load = np.array([(fit.group.temperature, fit.group.load) for fit in fits]).T
    pairs = np.column_stack([temperature, numbered(load, SAME_LOAD * load)])
    return np.unique(pairs, axis=0, return_inverse=True)[1].reshape(-1).tolist()


def _centred(values: Array, line: Integers) -> Array:
    return np.asarray(values - (np.bincount(line, values) / np.bincount(line))[line])


def _in_order_of_rows(fits: list[Fit], weights: Array) -> float:
    """Return the standard deviation of zeros that vary smoothly with the row, N; zero where they do not."""
    if not fits:
        return 0.0
    row = np.concatenate([fit.first_rows for fit in fits])
    zero = np.concatenate([fit.offset(weights) for fit in fits])[np.argsort(row, kind="stable")]
    deviation = float(np.std(zero, ddof=1)) if zero.size > 1 else 0.0
    return deviation if deviation > ROUNDING * max(fit.group.load for fit in fits) and wanders(zero) else 0.0


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


# --- change of Coulomb friction ------------------------------------------------------------------------------


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
        return _NONE, _hidden_in_one_run(fits, weights)
    times = np.concatenate([fit.times for fit in fits])
    length = float(np.nanmax(times) - np.nanmin(times))
    by_replicates, by_residual, poor = _two_rates(points, checked, zero_error)
    hidden = length * min(
        (threshold(one.freedom, CHANCE) + _SURELY) * one.error for one in (by_replicates, by_residual)
    )
    # Without degrees of freedom of its own, the rate by replicates is used where it matters to viscoelastic friction;
    # that by the residual alone where it would show a change that is noted: of some orders it has hardly any.
    least = _least_change(fits, weights)
    if poor and abs(by_replicates.value) <= least:
        by_replicates = by_replicates._replace(error=np.inf)
        if length * by_residual.error > _WORN:
            by_residual = by_residual._replace(error=np.inf)
    freedom = min(by_replicates.freedom, by_residual.freedom)
    apart = threshold(freedom, CHANCE) * math.hypot(by_replicates.error, by_residual.error)
    if abs(by_replicates.value - by_residual.value) > apart + ROUNDING * abs(by_replicates.value):
        return _NONE, 0.0
    found = by_replicates.judged()
    if not found.value:
        found = _weighted_mean(by_replicates, by_residual).judged()
        found = found._replace(part=_HALF if found.value else 1.0)
    elif not by_residual.significant:
        found = found._replace(part=_HALF)
    if not ROUNDING < abs(found.value) * length <= _ALL:
        found = found._replace(value=0.0)
    noted = not found.value and hidden > _WORN and least * length < _WORN
    return found, min(hidden, _ALL) if noted else 0.0


def _hidden_in_one_run(fits: list[Fit], weights: Array) -> float:
    """Return the change of Coulomb friction that configurations measured once hide, over its mean; zero if small."""
    once = [fit for fit in fits if fit.checks and fit.replicates == 1 and np.isfinite(fit.time)]
    if not once:
        return 0.0
    times = np.concatenate([fit.times for fit in once])
    by_wear = np.array([fit.each[0, :, WEAR] for fit in once]) / max(float(np.ptp(times)), ROUNDING)
    trend = _Trend.of(np.array([fit.mean(weights)[3] for fit in once]), by_wear[:, 3], 0)
    change = trend.rate(trend.squares, trend.freedom)
    hidden = (threshold(change.freedom, CHANCE) + _SURELY) * change.error
    # It is noted where less than what is looked for would move viscoelastic friction out of its interval.
    matters = 2.0 * math.sqrt(trend.squares / len(once)) < _WORN * np.abs(by_wear[:, 1]).max()
    return min(hidden, _ALL) if hidden > _WORN and matters else 0.0


def _two_rates(points: list[Array], checked: list[Array], zero_error: float) -> tuple[Rate, Rate, bool]:
    """Return the rates by replicates and by the residual, and whether the first has few degrees of freedom."""
    viscoelastic, coulomb, _ = np.concatenate([one - one.mean(axis=2, keepdims=True) for one in points], axis=2)
    residual, by_wear, by_drift = np.concatenate([np.zeros((3, 0)), *(one[2] for one in checked)], axis=1)
    course = _Trend.of(coulomb[0], coulomb[1], len(points))
    other = _Trend.of(residual, by_wear, 0)
    rest = viscoelastic[0] + course.value * viscoelastic[1]
    squares = float(rest @ rest) + course.squares + other.squares
    freedom = rest.size - len(points) + course.freedom + other.freedom
    by_replicates, by_residual = (one.rate(squares, freedom) for one in (course, other))
    if drifts := float(by_drift @ by_wear):
        error = math.hypot(by_residual.error, zero_error * drifts / other.corrections)
        by_residual = by_residual._replace(error=error)
    return by_replicates, by_residual, course.freedom < _ENOUGH


def _weighted_mean(first: Rate, second: Rate) -> Rate:
    """Return the mean of two rates by their errors, of which one may be infinite."""
    total = first.error**2 + second.error**2
    if np.isinf(total):
        finite = first if np.isinf(second.error) else second
        return finite._replace(error=min(first.error, second.error))
    weight = second.error**2 / total if total > 0.0 else 0.0
    mean = weight * first.value + (1.0 - weight) * second.value
    return Rate(mean, first.error * math.sqrt(weight), first.freedom if weight > _HALF else second.freedom)


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
