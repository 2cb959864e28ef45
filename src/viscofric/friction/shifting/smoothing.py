"""Local quadratic regression: interpolate a scattered curve without assuming a form for it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from viscofric.arrays import Array, Mask

#: Half-width of the smoothing kernel, decades of reduced speed.
BANDWIDTH = 0.25
#: Widest stretch without measured points that is bridged, decades of reduced speed.
WIDEST_GAP = 0.5
# Rounding of log10(αv), so that the ends of a stretch belong to it.
_ROUNDING = 1e-9
# Different abscissae that the kernel must reach beyond the three that a parabola needs, so that it smooths.
_NEIGHBOURS = 5
# Abscissae closer than this part of the bandwidth count as one.
_COINCIDENT = 1e-6


@dataclass(frozen=True, eq=False)
class SmoothedPoints:
    """A curve (n,) interpolated between scattered points, stretch by stretch."""

    decades: Array  # log10 of the reduced speed, ascending
    friction: Array
    error: Array
    sharing: Array  # (k, n), relative errors that points share, of k independent ones

    @cached_property
    def stretches(self) -> tuple[tuple[float, float], ...]:
        """Ends of each stretch without a gap wider than `WIDEST_GAP`, in decades."""
        breaks = np.flatnonzero(np.diff(self.decades) > WIDEST_GAP) + 1
        return tuple((float(part[0]), float(part[-1])) for part in np.split(self.decades, breaks))

    def covers(self, decades: Array) -> Mask:
        """Return which places lie in a stretch."""
        inside = [(decades >= low - _ROUNDING) & (decades <= high + _ROUNDING) for low, high in self.stretches]
        return np.asarray(np.any(inside, axis=0))

    def read(self, decades: Array) -> tuple[Array, Array]:
        """Return values and standard errors (m,) at places (m,) that lie in a stretch."""
        value, error = np.empty(decades.shape), np.empty(decades.shape)
        for low, high in self.stretches:
            inside = (decades >= low - _ROUNDING) & (decades <= high + _ROUNDING)
            rows, matrix = self._smoother(low, high, np.clip(decades[inside], low, high))
            value[inside] = matrix @ self.friction[rows]
            variance = np.where(matrix == 0.0, 0.0, self._variance[rows])
            shared = (matrix * self.friction[rows]) @ self.sharing[:, rows].T
            error[inside] = np.sqrt(np.sum(matrix**2 * variance, axis=1) + np.sum(shared**2, axis=1))
        return value, error

    def _smoother(self, low: float, high: float, places: Array) -> tuple[Mask, Array]:
        """Return which points lie in a stretch, and the weights of their friction at places in it."""
        rows = (self.decades >= low) & (self.decades <= high)
        return rows, smoothing_weights(self.decades[rows], _weights(self.error)[rows], places, BANDWIDTH)

    @cached_property
    def _variance(self) -> Array:
        """Variances of the points (n,), larger by one factor where they scatter about the curve by more than these."""
        finite = np.isfinite(self.error)
        known = bool(np.any(self.error[finite] > 0.0))
        variance = np.square(self.error if known else np.where(finite, self.friction, np.inf))
        squares = expected = 0.0
        for low, high in self.stretches:
            rows, matrix = self._smoother(low, high, self.decades[(self.decades >= low) & (self.decades <= high)])
            used, weight = finite[rows], _weights(self.error)[rows]
            away = np.eye(len(weight)) - matrix
            squares += float(np.sum((weight * (away @ self.friction[rows]) ** 2)[used]))
            expected += float(np.sum((weight[:, None] * away**2 * np.where(used, variance[rows], 0.0))[used]))
        factor = max(squares / expected if expected > 0.0 else 0.0, 1.0 if known else 0.0)
        return np.where(finite, np.where(finite, variance, 0.0) * factor, np.inf)


def _weights(error: Array) -> Array:
    """Return statistical weights 1/(s² + median²), relative to their largest; equal if no error is known."""
    finite = error[np.isfinite(error)]
    typical = float(np.median(finite)) if finite.size else 0.0
    if typical == 0.0:
        return np.ones(error.shape)
    # A point of unknown error has a small weight, not zero: it may be the only one nearby.
    squared = np.where(np.isfinite(error), error, 100.0 * typical) ** 2 + typical**2
    return np.asarray(squared.min() / squared)


def smoothing_weights(points: Array, weights: Array, at: Array, bandwidth: float) -> Array:
    """Return the matrix (m, n), its rows of sum one, from ordinates at `points` (n,) to smoothed values at `at` (m,).

    At each place, within the range of the points, a parabola is fitted by weighted least squares; its weights are those
    given (above zero) times the tricube kernel (1 − |d/h|³)³ (W. S. Cleveland, J. Am. Stat. Assoc. 74 (1979) 829), h
    the bandwidth or, where points are sparse, just beyond the fifth nearest one.  With fewer than four different points
    the parabola becomes a line or a constant.
    """
    ascending = np.sort(points)
    different = ascending[np.concatenate([[True], np.diff(ascending) > _COINCIDENT * bandwidth])]
    degree = min(2, max(0, different.size - 2)) if different.size != 2 else 1
    reach = min(_NEIGHBOURS, different.size)
    rows = np.empty((at.size, points.size))
    for row, place in enumerate(at):
        away = np.sort(np.abs(different - place))
        h = max(bandwidth, 1.1 * away[reach - 1])
        kernel = weights * np.maximum(0.0, 1.0 - np.abs((points - place) / h) ** 3) ** 3
        powers = np.vander((points - place) / h, degree + 1, increasing=True)
        root = np.sqrt(kernel)
        rows[row] = np.linalg.pinv(powers * root[:, None])[0] * root
    return rows
