"""How well shifted friction curves of neighbouring temperatures coincide where they overlap."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from viscofric.arrays import Array, Indices
from viscofric.friction.curve_checks import Decades
from viscofric.nominal import nominal_rows
from viscofric.notes import Note

# Rounding of log10(αv), so that the ends of a range belong to it.
_ROUNDING = 1e-9


@dataclass(frozen=True)
class Collapse:
    """Differences of curves at neighbouring temperatures where they overlap; None without overlap.

    The other curve is interpolated by a cubic spline at each point of one.
    """

    rms: float | None  # root mean square of the relative differences
    error: float | None  # the value expected from the standard errors alone
    points: int  # compared

    @property
    def sentence(self) -> Note:
        """The same in words."""
        if self.rms is None or self.error is None:
            return Note(
                "curves-apart",
                "Curves of neighbouring temperatures do not overlap in reduced speed, so the master curve "
                "does not test the shift factors.",
            )
        alone = f"would make it {100 * self.error:.2g} %" if np.isfinite(self.error) else "are unknown"
        errors = f"; their errors alone {alone}" if self.error > 0.0 else ""
        return Note(
            "curves-coincide",
            f"Curves of neighbouring temperatures coincide to {100 * self.rms:.2g} % (root mean square over "
            f"{self.points} points) where they overlap in reduced speed{errors}.",
            values={"rms": self.rms, "points": self.points, "expected": self.error},
        )


def collapse(temperature: Array, decades: Array, friction: Array, error: Array) -> Collapse:
    """Compare friction over log10 of the reduced speed of neighbouring temperatures where they overlap, (n,) each."""
    scale = Decades.of(friction, error)
    parts = [_isotherm(rows, decades, friction, error) for rows in nominal_rows(temperature)]
    differences: list[Array] = []
    expected: list[Array] = []
    for cold, warm in pairwise(parts):
        for one, other in ((cold, warm), (warm, cold)):
            inside = (one[0] >= other[0][0] - _ROUNDING) & (one[0] <= other[0][-1] + _ROUNDING)
            if not np.any(inside):
                continue
            place = np.clip(one[0][inside], other[0][0], other[0][-1])
            read = _spline(other[0], other[1], place)
            mean = np.maximum(scale.unit(0.5 * (np.abs(one[1][inside]) + np.abs(read))), np.finfo(float).tiny)
            differences.append((one[1][inside] - read) / mean)
            expected.append(np.hypot(one[2][inside], np.interp(place, other[0], other[2])) / mean)
    if not differences:
        return Collapse(None, None, 0)
    all_differences, all_expected = np.concatenate(differences), np.concatenate(expected)
    return Collapse(
        float(np.sqrt(np.mean(all_differences**2))), float(np.sqrt(np.mean(all_expected**2))), all_differences.size
    )


def _isotherm(rows: Indices, decades: Array, friction: Array, error: Array) -> tuple[Array, Array, Array]:
    """Ascending log10 reduced speeds of one temperature, friction and its error; equal speeds averaged."""
    places, number = np.unique(decades[rows], return_inverse=True)
    count = np.bincount(number)
    mean = np.bincount(number, friction[rows]) / count
    return places, mean, np.sqrt(np.bincount(number, error[rows] ** 2)) / count


def _spline(x: Array, y: Array, at: Array) -> Array:
    from scipy.interpolate import make_interp_spline

    if x.size == 1:
        return np.full(at.shape, y[0])
    return np.asarray(make_interp_spline(x, y, k=3 if x.size > 3 else 1)(at))
