"""Friction at one temperature for the search for shift factors: logarithms, variances, a smooth curve.

Scatter is taken to have heavy tails: points far from the others count less (`curve_checks.with_tails`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from viscofric.arrays import Array, Indices, Integers, Mask
from viscofric.friction.curve_checks import LEFT_OUT, Decades, error_freedom, friction_unit, scatter_of, with_tails
from viscofric.friction.curves import FrictionCurves
from viscofric.nominal import nominal_rows
from viscofric.rheology.shifts.shift_law import LN10
from viscofric.rheology.superposition.common_curve import Basis, Curves
from viscofric.rheology.superposition.overlap import LogSweep
from viscofric.rheology.uncertainty.material_samples import freedom_of_scatter

#: Points of an isotherm whose speeds differ by less are one point.
SAME_SPEED = 1e-3  # decades
#: Smallest stated error that is used, relative to the typical one.
SMALLEST_ERROR = 0.1
#: Smallest scatter of points without errors, decades of friction: the precision of reading a curve.
UNKNOWN_ERROR = 0.004
#: Degrees of freedom of an error that is not that of replicates.
EXACT = 1e6
#: Points that a curve goes through have at least this part of their variance in their distance from it.
_LEAST_LEFT = 1e-6
#: Curves of fewer points, or as many, have no scatter, and no parabola that most of them are near.
_FEWEST_FOR_SCATTER, _FEWEST_ABOUT_PARABOLA = 3, 5
#: Number of parabolas through three points that are tried, and least distance of outliers from the best, in standard
#: deviations and in decades.
_PARABOLAS, _FAR, _OFF_PARABOLA = 200, 4.0, 0.06
#: Factor by which a variance is far less.
_FAR_LESS = 4.0


@dataclass(frozen=True, eq=False)
class FrictionIsotherm:
    """Friction at one temperature, at the reference load."""

    temperature: float  # mean of the points, K
    speed: Array  # (n,), log10 of the speed; ascending, all different
    friction: Array  # (n,), log10 of the friction coefficient, or this on the scale of all, which is linear about zero
    variance: Array  # (n,), of `friction`, up to a factor common to all isotherms
    range: tuple[float, float]  # smallest and largest friction coefficient
    scale: Decades  # of all temperatures
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
        apart = 1.0 + (LEFT_OUT - 1.0) * np.eye(len(self))[[0, -1]]
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
        return replace(self, friction=self.scale((1.0 + part) * self.scale.value(self.friction)))

    def sweep(self, unit: float) -> LogSweep:
        """Return the points in the form of superposition, weights in units of an inverse variance."""
        return LogSweep(self.speed, self.friction[:, None], 1.0 / (unit * self.larger * self.variance))


def friction_isotherms(curves: FrictionCurves) -> list[FrictionIsotherm]:
    """Sort the points of friction curves at one load into isotherms of ascending temperature."""
    friction, error = curves.viscoelastic, curves.viscoelastic_error
    scale = Decades.of(friction, error)
    ordinate, unit = scale(friction), friction_unit(curves)
    rows = nominal_rows(curves.temperature)
    variance = _variances(error / (LN10 * unit), curves.replicates, error_freedom(curves)[0], rows)
    variance *= (unit / scale.unit(friction)) ** 2
    speed, kelvin = np.log10(curves.speed), curves.temperature
    return _with_tails(
        [
            _merged(float(kelvin[row].mean()), speed[row], ordinate[row], variance[row], friction[row], scale)
            for row in rows
        ]
    )


def _with_tails(isotherms: list[FrictionIsotherm]) -> list[FrictionIsotherm]:
    """Find the points that lie off the curve of their own temperature, with the scatter of all, and count them less."""
    several = [len(isotherm) > _FEWEST_FOR_SCATTER for isotherm in isotherms]
    ends = np.cumsum([len(isotherm) for isotherm in isotherms])[:-1]

    def counted(larger: Array) -> list[FrictionIsotherm]:
        return [replace(one, larger=own) for one, own in zip(isotherms, np.split(larger, ends), strict=True)]

    def fit(larger: Array, _: float) -> tuple[None, Array, float]:
        drawn = counted(larger)
        scale = scatter_scale(drawn) or np.inf
        squares = [
            distances(one.curves, one.larger) / scale if curved else np.zeros(len(one))
            for one, curved in zip(drawn, several, strict=True)
        ]
        return None, np.concatenate(squares), 1.0

    # Curves bend more than parabolas, and more than those of few points: points are left out only where some lie off
    # parabolas and all others then scatter far less.
    found = counted(with_tails(np.ones(sum(map(len, isotherms))), fit, far=False)[1])
    off = np.concatenate(_off_parabolas(isotherms))
    if np.all(off == 1.0):
        return found
    without = counted(with_tails(off, fit)[1])
    scales = scatter_scale(found), scatter_scale(without)
    return without if scales[0] and scales[1] and scales[0] > _FAR_LESS * scales[1] else found


def _off_parabolas(isotherms: list[FrictionIsotherm]) -> list[Array]:
    """Return factors (n,) of variances that leave out points far from the parabola nearest to most of a temperature."""
    # Several outliers draw a curve of few points to themselves. Of the parabolas through three points, the one with the
    # least median of squared distances is near most points (P. J. Rousseeuw, J. Am. Stat. Assoc. 79 (1984) 871, with
    # his factor for few points).
    away, scatter, random = [], [], np.random.default_rng(0)
    for one in isotherms:
        count, left = len(one), np.zeros(len(one))
        if count > _FEWEST_ABOUT_PARABOLA:
            design = np.vander((one.speed - one.speed.mean()) / np.ptp(one.speed), 3)
            three = random.random((_PARABOLAS, count)).argsort(axis=1)[:, :3]
            through = np.linalg.solve(design[three], one.friction[three][..., None])
            squares = (one.friction - (design @ through)[..., 0]) ** 2
            middle = np.partition(squares / one.variance, (count + 3) // 2, axis=1)[:, (count + 3) // 2]
            best = int(np.argmin(middle))
            left = one.friction - design @ through[best, :, 0]
            scatter.append(1.4826 * (1.0 + 5.0 / (count - 3.0)) * math.sqrt(middle[best]))
        away.append(left)
    least = _FAR * float(np.median(scatter)) if scatter else 0.0
    return [
        np.where(_off(left, np.maximum(least * np.sqrt(one.variance), _OFF_PARABOLA)), LEFT_OUT, 1.0)
        for left, one in zip(away, isotherms, strict=True)
    ]


def _off(left: Array, least: Array) -> Mask:
    """Return which points are farther than `least` from a parabola, besides those where the curve bends from it."""
    # Such a bend, as beyond a maximum, has two points or more up to an end to one side, which is 0 of those near.
    side = np.sign(left) * (np.abs(left) > least)
    from_start = np.logical_and.accumulate(side == side[0])
    to_end = np.logical_and.accumulate(side[::-1] == side[-1])[::-1]
    bent = (from_start & from_start[:2].all()) | (to_end & to_end[-2:].all())
    return np.asarray((side != 0.0) & ~bent)


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


def about_one_curve(
    place: Array, value: Array, variance: Array, sharing: Array, least: float, least_distance: Array
) -> tuple[Array, Array, float]:
    """Return factors (n,) of the variances of points about one curve, squared distances, and degrees of freedom.

    `sharing` (k, n) are errors that points share, `least` is the least factor of all variances. Distances up to
    `least_distance` (n,) are zero.
    """
    if len(place) <= _FEWEST_FOR_SCATTER:
        return np.ones(len(place)), np.zeros(len(place)), 0.0
    basis = Basis.of(place)

    def fit(larger: Array, _: float) -> tuple[float, Array, float]:
        weight = 1.0 / (larger * variance)
        curves = basis.curves(value[:, None], weight)
        shared = sharing.T * curves.root
        shared = np.sum((shared - curves.basis @ (curves.inverse[0] @ (curves.basis.T @ shared))) ** 2, axis=1)
        left, freedom = curves.residual[:, 0] ** 2, curves.freedom
        if freedom < 1.0:
            return freedom, np.zeros(len(place)), 1.0
        own = distances(curves, larger)
        scale = max(least, scatter_of(float(np.sum(left - shared)), freedom, larger, own))
        expected = scale * _expected(curves, larger) + larger * shared
        return freedom, np.where(left > weight * least_distance**2, larger * left / expected, 0.0), 1.0

    freedom, larger, squares = with_tails(np.ones(len(place)), fit)
    return larger, squares, freedom


def nominal_temperatures(temperature: Array) -> Array:
    """Return the mean temperature of the isotherm of each point (n,)."""
    kelvin = np.empty(temperature.shape)
    for rows in nominal_rows(temperature):
        kelvin[rows] = temperature[rows].mean()
    return kelvin


def scatter_scale(isotherms: Sequence[FrictionIsotherm]) -> float | None:
    """Return the factor of the variances, from the scatter about own curves; None without a degree of freedom."""
    several = [isotherm for isotherm in isotherms if len(isotherm) > _FEWEST_FOR_SCATTER]
    freedom = sum(isotherm.curves.freedom for isotherm in several)
    if freedom < 1.0:
        return None
    squares = sum(float(np.sum(isotherm.curves.residual**2)) for isotherm in several)
    return scatter_of(squares, freedom, np.concatenate([isotherm.larger for isotherm in several]))


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
    temperature: float, speed: Array, ordinate: Array, variance: Array, friction: Array, scale: Decades
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
        scale,
        np.ones(len(total)),
        Basis.of(speed),
    )
