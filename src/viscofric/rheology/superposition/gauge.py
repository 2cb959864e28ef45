"""The gauge of a superposition: where shifts are zero, which are fixed, and which follow from the trend (plateaus)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array, Indices


@dataclass(frozen=True, eq=False)
class Gauge:
    """Which shifts are fixed."""

    inverse_temperatures: Array  # (n,), 1/T of the isotherms, ascending in temperature
    weights: Array  # (n,), interpolation at the reference, where log10 α is zero
    vertical_weights: Array  # (n,), the same for log10 b
    held: Mapping[int, float]  # log10 α of isotherms by index
    free_vertical: bool = False  # whether vertical shifts are fitted

    def free(self) -> tuple[Array, Array]:
        """Return shifts that meet the fixed ones, and an orthonormal basis of their possible changes."""
        size = len(self.weights)
        full = 2 * size if self.free_vertical else size
        rows = [np.eye(full)[place] for place in self.held]
        values = list(self.held.values())
        if not all(place in self.held for place in np.flatnonzero(self.weights)):
            rows.append(np.concatenate([self.weights, np.zeros(full - size)]))
            values.append(0.0)
        if self.free_vertical:
            rows.append(np.concatenate([np.zeros(size), self.vertical_weights]))
            values.append(0.0)
        matrix = np.array(rows)
        _, _, right = np.linalg.svd(matrix, full_matrices=True)
        return np.linalg.lstsq(matrix, np.array(values), rcond=None)[0], right[len(rows) :].T

    def within(self, first: int, last: int) -> Gauge:
        """Return the gauge of some of the isotherms; about the nearest of them if the reference is not among them."""
        inside = slice(first, last)
        weights = self.weights[inside]
        if weights.sum() < 1.0 - 1e-9:
            weights = np.eye(last - first)[0 if np.argmax(self.weights) < first else -1]
        held = {place - first: value for place, value in self.held.items()}
        return Gauge(self.inverse_temperatures[inside], weights, self.vertical_weights[inside], held)

    def brought_to(self, shifts: Array) -> Array:
        """Return shifts corrected to meet the fixed ones, by a correction that is linear in 1/T between them."""
        shifts = shifts - self.weights @ shifts
        changes = {float(self.weights @ self.inverse_temperatures): 0.0}
        changes |= {float(self.inverse_temperatures[place]): v - shifts[place] for place, v in self.held.items()}
        points = np.array(sorted(changes.items()))
        shifts = shifts + np.interp(self.inverse_temperatures, points[:, 0], points[:, 1])
        start, ways = self.free()  # the remaining condition at a reference between isotherms
        parameters = np.concatenate([shifts, np.zeros(len(start) - len(shifts))])
        return np.asarray((start + ways @ (ways.T @ (parameters - start)))[: len(shifts)])


#: An isotherm determines its shift if the squared slope of the curves is this many times its noise.  Noise alone gives
#: 0.3 to 9, sweeps that determine a step to 0.1 decades 20 and more.
CLEAR = 15.0
#: Number of the last determined steps that the trend is taken from.
TREND_STEPS = 2
#: Uncertainty of the change of the rate with 1/T from step to step beyond them; WLF laws change by less.
BEND = 0.2  # decades per typical step


def identified(signal: Array, gauge: Gauge) -> tuple[int, int] | None:
    """Return the index of the first isotherm to fit, and that after the last; None to fit all."""
    # `signal` (n,) is the squared slope of the curves at each isotherm, in units of its noise. All are fitted where
    # none at the ends is a plateau, nearly all are plateaus, vertical shifts are fitted, or a factor is fixed whose
    # plateau, or whose reference, would be left out.
    clear = np.flatnonzero(signal > CLEAR)
    if gauge.free_vertical or len(clear) <= TREND_STEPS:
        return None
    first, last = int(clear[0]), int(clear[-1]) + 1
    inside = set(range(first, last))
    needed = {*gauge.held, *(int(place) for place in np.flatnonzero(gauge.weights))} if gauge.held else set()
    if (first, last) == (0, len(signal)) or last - first <= TREND_STEPS or not needed <= inside:
        return None
    return first, last


def continued(values: Array, gauge: Gauge, first: int, last: int) -> Array:
    """Continue shifts (or what is linear in them) over the plateaus at both ends, linearly in 1/T."""
    # `values` (m, …) are those of the isotherms `first` to before `last`; returns (n, …) of all isotherms, zero at the
    # reference.
    inverse = gauge.inverse_temperatures
    size = len(inverse)
    onto = np.zeros((size, last - first))
    onto[first:last] = np.eye(last - first)
    for end, before, places in _ends(size, first, last):
        further = (inverse[places] - inverse[end]) / (inverse[end] - inverse[before])
        onto[places, end - first] = 1.0 + further
        onto[places, before - first] = -further
    return np.asarray(np.tensordot(_change(gauge) @ onto, values, axes=1))


def continued_covariance(covariance: Array, gauge: Gauge, first: int, last: int) -> Array:
    """Return the covariance (n, n) of continued shifts from that of the fitted ones (m, m)."""
    # It grows: from step to step the rate of change with 1/T may change by `BEND`.
    inverse = gauge.inverse_temperatures
    size = len(inverse)
    spread = np.zeros((size, size))
    typical = float(np.median(np.abs(np.diff(inverse))))
    for end, _, places in _ends(size, first, last):
        reached = np.abs(inverse[places] - inverse[end]) / typical
        start = np.concatenate([[0.0], reached[:-1]])
        walk = BEND * np.maximum(reached[:, None] - start, 0.0)
        spread[np.ix_(places, places)] = walk @ walk.T
    change = _change(gauge)
    fitted = continued(continued(covariance, gauge, first, last).T, gauge, first, last)
    return np.asarray(fitted + change @ spread @ change.T)


def _ends(size: int, first: int, last: int) -> list[tuple[int, int, Indices]]:
    """Return for each end with a plateau its last fitted isotherm, the start of the trend, and the plateau."""
    hot = last - 1, last - 1 - TREND_STEPS, np.arange(last, size)
    cold = first, first + TREND_STEPS, np.arange(first - 1, -1, -1)
    return [end for end in (hot, cold) if len(end[2])]


def _change(gauge: Gauge) -> Array:
    """Return the matrix that makes shifts zero at the reference."""
    return np.asarray(np.eye(len(gauge.weights)) - gauge.weights)
