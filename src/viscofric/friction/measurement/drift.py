"""Drift of the force cell's zero: estimated from the fitted zeros, and removed from the separation."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array, Integers
from viscofric.friction.intervals import threshold
from viscofric.friction.measurement.doubts import CHANCE
from viscofric.friction.measurement.fit import DRIFT, FORCE, ZERO_CHANGES, Entry, Fit
from viscofric.friction.measurement.zeros import ROUNDING, Zeros, wanders
from viscofric.notes import Note
from viscofric.units import shown_number

_FEWEST = 3  # degrees of freedom of a rate
#: The zeros of a condition are used alone unless the error of their rate is so many times that of the whole test.
_FAR_BETTER = 3.0
# The recorded zeros are followed where this reduces the sum of squares by more than chance.
_WORTH = 0.8
_PER_HOUR = 3600.0


@dataclass(frozen=True)
class Drift:
    """Drift that is subtracted from the forces besides the zero of each condition."""

    rate: float = 0.0  # of a zero that is linear in time, N/s
    error: float = 0.0  # standard error of the rate, N/s
    freedom: float = np.inf
    follows: bool = False  # whether the zero follows its changes from one recording to the next
    # standard deviation, N, of a zero that drifts otherwise, or without recorded times; zero where it does not
    wandering: float = 0.0
    timed: bool = True  # whether the times were recorded

    @property
    def weights(self) -> Array:
        """Of force, drift and changes of the recorded zero."""
        weights = np.zeros(3)
        weights[FORCE], weights[DRIFT], weights[ZERO_CHANGES] = 1.0, self.rate, float(self.follows)
        return weights

    @classmethod
    def of(cls, fits: list[Fit]) -> Drift:
        """Estimate the drift from the fitted zeros."""
        # Each replicate's zero is fitted at the mean time of its readings. The rate is that of one straight line for
        # each condition, all of one slope, where conditions were repeated; of one line for the whole test where not, or
        # where they were repeated at once, so that the whole test tells it far better.
        fitted = [fit for fit in fits if fit.fits_offset]
        follows = _follows(fitted)
        plain = cls(follows=follows).weights
        timed = [fit for fit in fitted if np.isfinite(fit.time)]
        repeated = [fit for fit in timed if len(fit.each) > 1]
        if not timed:
            return cls(follows=follows, wandering=_in_order_of_rows(fitted, plain), timed=False)
        found = _Line.of(timed, plain, apart=False)
        if repeated and (own := _Line.of(repeated, plain, apart=True)).error < _FAR_BETTER * found.error:
            found = own
        if not np.isfinite(found.error):
            return cls(follows=follows)
        rounding = ROUNDING * max(fit.group.load for fit in timed)
        unexplained = float(np.sqrt(np.mean(found.residual**2)))
        if unexplained > rounding and wanders(found.residual[np.argsort(found.time, kind="stable")]):
            return cls(follows=follows, wandering=float(np.std(found.zero, ddof=1)))
        certain = abs(found.rate) >= threshold(found.freedom, CHANCE) * found.error
        if abs(found.rate) * float(np.ptp(found.time)) <= rounding or not certain:
            return cls(follows=follows)
        return cls(found.rate, found.error, found.freedom, follows)

    def entry(self, fit: Fit, zeros: Zeros, error: Array, freedom: Array) -> Entry:
        """Return the result of a condition, with the error of the drift in its standard errors (4,)."""
        entry = fit.entry(self.weights, zeros, error, freedom)
        return entry.widened((self.error * fit.each[:, :, DRIFT].mean(axis=0)) ** 2, self.freedom)

    def notes(self, fits: list[Fit]) -> Iterator[Note]:
        """Yield notes on the drift and its treatment."""
        load = float(np.mean([fit.group.load for fit in fits]))
        if self.follows:
            yield Note(
                "zero-unsteady",
                "The zero of the force cell changes from one recording to the next and the forces change with it, so "
                "that each reading is taken relative to its own recorded zero.",
            )
        if self.rate:
            moved = np.array([fit.each[:, 1:3, DRIFT].mean(axis=0) for fit in fits if fit.fits_offset])
            size = np.abs(self.rate * moved).max(axis=0)
            yield Note(
                "zero-drifts",
                f"The zero of the force cell drifts by {shown_number(_PER_HOUR * self.rate, '.2g')} ± "
                f"{_PER_HOUR * self.error:.1g} N/h, "
                f"which is taken out; left in, it would change the friction coefficients by up to {size[0]:.2g} "
                f"(viscoelastic) and {size[1]:.2g} (Coulomb).",
                values={  # rate and its error in N/s
                    "rate": self.rate,
                    "error": self.error,
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
    """Straight lines of one slope through zeros (n,), N, at times (n,), s."""

    zero: Array
    time: Array
    residual: Array  # (n,), N
    rate: float  # N/s
    error: float  # its standard error, infinite where it has too few degrees of freedom
    freedom: float

    @classmethod
    def of(cls, fits: list[Fit], weights: Array, *, apart: bool) -> _Line:
        """Fit a line for each condition if `apart`, else one for all."""
        zero = np.concatenate([fit.offset(weights) for fit in fits])
        # Where readings of a replicate have unequal weights, its zero is that at their weighted mean time.
        time = np.concatenate([fit.time - fit.each[:, 0, DRIFT] for fit in fits])
        line = np.repeat(np.arange(len(fits)) * apart, [len(fit.each) for fit in fits])
        early = _centred(time, line)
        sensitivity, freedom = float(np.sum(early**2)), line.size - line.max() - 2
        if freedom < _FEWEST or sensitivity <= 0.0:
            return cls(zero, time, zero, 0.0, np.inf, float(freedom))
        centred = _centred(zero, line)
        rate = float(np.sum(early * centred)) / sensitivity
        residual = centred - rate * early
        error = float(np.sqrt(np.sum(residual**2) / freedom / sensitivity))
        return cls(zero, time, residual, rate, error, float(freedom))


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
        weights = np.array([1.0, 0.0, float(follows)])
        for fit in fits:
            force = max(force, fit.group.load)
            if len(fit.each) > 1:
                each = fit.each[:, 1:] @ weights * fit.group.load
                left[follows] += np.sum((each - each.mean(axis=0)) ** 2) + np.sum(each[:, -1] ** 2)
            else:
                left[follows] += np.sum((fit.residual @ weights) ** 2)
    return bool(left[1] < _WORTH * left[0] and left[0] > (ROUNDING * force) ** 2)
