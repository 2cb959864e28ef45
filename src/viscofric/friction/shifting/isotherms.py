"""Friction at one temperature for the search for shift factors: logarithms, variances, a smooth curve.

Scatter is taken to have heavy tails: points far from the others count less (`curve_checks.counted_less`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from viscofric.arrays import Array, Indices, Integers
from viscofric.friction.curve_checks import MEAN_SQUARE, ROUNDS, counted_less, error_freedom, settled
from viscofric.friction.curves import FrictionCurves
from viscofric.nominal import nominal_rows
from viscofric.rheology.superposition.common_curve import Basis, Curves
from viscofric.rheology.superposition.overlap import LogSweep
from viscofric.rheology.uncertainty.material_samples import freedom_of_scatter

#: Points of an isotherm whose speeds differ by less are one point.
SAME_SPEED = 1e-3  # decades
#: Within this many standard errors of zero the logarithm of friction is useless: the coefficient itself is then fitted.
CLEAR_OF_ZERO = 4.0
#: Smallest stated error that is used, relative to the typical one.
SMALLEST_ERROR = 0.1
#: Smallest scatter of points without errors, decades of friction: the precision of reading a curve.
UNKNOWN_ERROR = 0.004
#: Degrees of freedom of an error that is not that of replicates.
EXACT = 1e6
#: Points that a curve goes through have at least this part of their variance in their distance from it.
_LEAST_LEFT = 1e-6
#: Curves of fewer points, or as many, have no scatter.
_FEWEST_FOR_SCATTER = 3
#: Factor of the variance of a point that is left out.
_LEFT_OUT = 1e4


@dataclass(frozen=True, eq=False)
class FrictionIsotherm:
    """Friction at one temperature, at the reference load."""

    temperature: float  # mean of the points, K
    speed: Array  # (n,), log10 of the speed; ascending, all different
    # (n,), log10 of the friction coefficient, or the coefficient on a scale where its largest value has the slope of a
    # logarithm
    friction: Array
    variance: Array  # (n,), of `friction`, up to a factor common to all isotherms
    range: tuple[float, float]  # smallest and largest friction coefficient
    logarithmic: bool  # whether `friction` is the logarithm
    larger: Array  # (n,), factors of the variance of points that lie off the others; 1 for the others
    basis: Basis  # of the curve through them

    def __len__(self) -> int:
        return len(self.speed)

    @cached_property
    def curves(self) -> Curves:
        """The curve through the points of this temperature alone."""
        return self.basis.curves(self.friction[:, None], 1.0 / (self.larger * self.variance))

    @cached_property
    def _with_and_without_an_end(self) -> tuple[Curves, ...]:
        """The curve, and those without the first or the last point, where the others determine a curve."""
        if len(self) <= _FEWEST_FOR_SCATTER:
            return (self.curves,)
        apart = 1.0 + (_LEFT_OUT - 1.0) * np.eye(len(self))[[0, -1]]
        return self.curves, *(replace(self, larger=self.larger * end).curves for end in apart)

    @cached_property
    def _coefficients(self) -> tuple[Array, Array]:
        """Coefficients (c, K, 1) of these c curves, and their covariances (c, K, K)."""
        coefficients, inverse = zip(
            *((curves.coefficients, curves.inverse[0]) for curves in self._with_and_without_an_end), strict=True
        )
        return np.array(coefficients), np.array(inverse)

    def read(self, speed: Array) -> tuple[Array, Array]:
        """Return c curves at log10 speeds (k, m) within the range, and the covariances of each m values (c, k, m, m).

        They are the curve, (c, k, m), and those without the first and without the last point, where determined.
        """
        coefficients, inverse = self._coefficients
        basis = self.basis.at(np.clip(speed, self.speed[0], self.speed[-1]).ravel(), orders=1)[0]
        shape = len(inverse), *speed.shape
        onto = (basis @ inverse).reshape(*shape, -1)
        return (basis @ coefficients).reshape(shape), onto @ np.swapaxes(basis.reshape(*speed.shape, -1), -1, -2)

    def raised(self, part: float) -> FrictionIsotherm:
        """Return the same with all friction larger by a relative amount."""
        friction = self.friction + math.log10(1.0 + part) if self.logarithmic else (1.0 + part) * self.friction
        return replace(self, friction=friction)

    def sweep(self, unit: float) -> LogSweep:
        """Return the points in the form of superposition, weights in units of an inverse variance."""
        return LogSweep(self.speed, self.friction[:, None], 1.0 / (unit * self.larger * self.variance))


def friction_isotherms(curves: FrictionCurves) -> list[FrictionIsotherm]:
    """Sort the points of friction curves at one load into isotherms of ascending temperature."""
    friction, error = curves.viscoelastic, curves.viscoelastic_error
    finite = np.isfinite(error)
    logarithmic = bool(np.all(friction > CLEAR_OF_ZERO * np.where(finite, error, 0.0)))
    largest = float(np.max(np.abs(friction), initial=np.finfo(float).tiny))
    unit = friction if logarithmic else np.full(friction.shape, largest)
    ordinate = np.log10(friction) if logarithmic else friction / (math.log(10.0) * largest)
    decades = error / (math.log(10.0) * unit)
    rows = nominal_rows(curves.temperature)
    variance = _variances(decades, curves.replicates, error_freedom(curves)[0], rows)
    speed, kelvin = np.log10(curves.speed), curves.temperature
    return _with_tails(
        [
            _merged(float(kelvin[row].mean()), speed[row], ordinate[row], variance[row], friction[row], logarithmic)
            for row in rows
        ]
    )


def _with_tails(isotherms: list[FrictionIsotherm]) -> list[FrictionIsotherm]:
    """Find the points that lie off the curve of their own temperature, with the scatter of all, and count them less."""
    for _ in range(ROUNDS):
        scale, before = scatter_scale(isotherms), isotherms
        if scale is None:
            break
        isotherms = [
            replace(one, larger=counted_less(distances(one.curves, one.larger) / scale))
            if len(one) > _FEWEST_FOR_SCATTER
            else one
            for one in isotherms
        ]
        if all(settled(old.larger, new.larger).all() for old, new in zip(before, isotherms, strict=True)):
            break
    return isotherms


def distances(curves: Curves, larger: Array) -> Array:
    """Return squared distances (n,) of points from the curve of the others, over their expectation.

    `larger` (n,) are the factors of the variances with which the curve was drawn; the point itself has its own
    variance, times the scale of all.
    """
    return np.asarray(larger * curves.residual[:, 0] ** 2 / _expected(curves, larger))


def _expected(curves: Curves, larger: Array) -> Array:
    """Return the expected squared residuals (n,) of points in units of their own variances."""
    pull = np.minimum(np.sum((curves.basis @ curves.inverse[0]) * curves.basis, axis=1), 1.0 - _LEAST_LEFT)
    return np.asarray((1.0 - pull) * (1.0 - pull + pull * larger))


def with_tails(
    place: Array, value: Array, variance: Array, sharing: Array, least: float, least_distance: Array
) -> tuple[Array, Array, float]:
    """Return factors (n,) of the variances of points about one curve, squared distances, and degrees of freedom.

    `sharing` (k, n) are errors that points share, `least` is the least factor of all variances. Distances up to
    `least_distance` (n,) are zero.
    """
    larger, squares = np.ones(len(place)), np.zeros(len(place))
    if len(place) <= _FEWEST_FOR_SCATTER:
        return larger, squares, 0.0
    basis = Basis.of(place)
    for _ in range(ROUNDS):
        weight = 1.0 / (larger * variance)
        curves = basis.curves(value[:, None], weight)
        shared = sharing.T * curves.root
        shared = np.sum((shared - curves.basis @ (curves.inverse[0] @ (curves.basis.T @ shared))) ** 2, axis=1)
        left, freedom = curves.residual[:, 0] ** 2, curves.freedom
        if freedom < 1.0:
            break
        scale = max(least, float(np.sum(left - shared)) / (MEAN_SQUARE * freedom))
        expected = scale * _expected(curves, larger) + larger * shared
        squares = np.where(left > weight * least_distance**2, larger * left / expected, 0.0)
        before, larger = larger, counted_less(squares)
        if np.all(settled(before, larger)):
            break
    return larger, squares, freedom


def nominal_temperatures(temperature: Array) -> Array:
    """Return the mean temperature of the isotherm of each point (n,)."""
    kelvin = np.empty(temperature.shape)
    for rows in nominal_rows(temperature):
        kelvin[rows] = temperature[rows].mean()
    return kelvin


def scatter_scale(isotherms: Sequence[FrictionIsotherm]) -> float | None:
    """Return the factor of the variances, from the scatter about own curves; None without a degree of freedom."""
    several = [isotherm.curves for isotherm in isotherms if len(isotherm) > _FEWEST_FOR_SCATTER]
    freedom = sum(curves.freedom for curves in several)
    if freedom < 1.0:
        return None
    return float(sum(np.sum(curves.residual**2) for curves in several) / (MEAN_SQUARE * freedom))


def _variances(error: Array, replicates: Integers, freedom: Array, rows: list[Indices]) -> Array:
    """Pool the squared errors of each temperature; a point without an error gets the typical one."""
    # A standard error of few replicates is itself uncertain, and scattering weights cost precision that the fit does
    # not account for. So squares are pooled with the typical one of their temperature, which counts for as many
    # replicates as their scatter over the points allows (G. K. Smyth, Stat. Appl. Genet. Mol. Biol. 3 (2004) article
    # 3).
    from scipy.special import polygamma

    known = np.isfinite(error)
    if not np.any(error[known] > 0.0):
        return np.full(error.shape, UNKNOWN_ERROR**2)
    floor = SMALLEST_ERROR**2 * float(np.median(error[known & (error > 0.0)] ** 2))
    squared = np.maximum(np.where(known, error, 0.0) ** 2, floor)
    typical = np.empty(error.shape)
    for row in rows:
        among = row[known[row]] if known[row].any() else np.flatnonzero(known)
        typical[row] = np.median(squared[among])
    freedom = np.where(known, np.clip(freedom, 1.0, EXACT), 0.0)
    excess = np.var(np.log(squared / typical)[known]) - np.mean(polygamma(1, 0.5 * freedom[known]))
    prior = min(freedom_of_scatter(float(excess), 1.0, EXACT), EXACT)
    # The weight of one replicate without an error relative to those with one.
    fewer = np.where(known, 1.0, np.maximum(np.median(replicates[known]) / replicates, 1.0))
    return np.asarray(fewer * (freedom * squared + prior * typical) / (freedom + prior))


def _merged(
    temperature: float, speed: Array, ordinate: Array, variance: Array, friction: Array, logarithmic: bool
) -> FrictionIsotherm:
    """Merge points of equal speeds."""
    order = np.argsort(speed, kind="stable")
    number = np.zeros(len(order), dtype=int)
    number[1:] = np.cumsum(np.diff(speed[order]) > SAME_SPEED)
    weight = 1.0 / variance[order]
    total = np.bincount(number, weight)
    speed = np.bincount(number, weight * speed[order]) / total
    return FrictionIsotherm(
        temperature,
        speed,
        np.bincount(number, weight * ordinate[order]) / total,
        1.0 / total,
        (float(friction.min()), float(friction.max())),
        logarithmic,
        np.ones(len(total)),
        Basis.of(speed),
    )
