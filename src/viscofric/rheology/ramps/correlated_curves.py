"""Smooth curves through ramps whose errors are correlated from point to point, by generalised least squares.

A drift of the oven, of the clamping or of the static load gives neighbouring points of a ramp similar errors.
They are described by an autoregression of first order along each ramp, for E' and for E''.  Its coefficient and the
smoothing of the curve follow together from the restricted likelihood: if smoothing is chosen as for independent errors,
the curve follows the correlated ones, and the residuals do not show them (J. D. Opsomer, Y. Wang, Y. Yang, Statist.
Sci. 16 (2001) 134).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from viscofric.rheology.superposition.common_curve import (
    knots_for,
    restricted_likelihood,
    ridged,
    roughness,
    splines,
)

if TYPE_CHECKING:
    from viscofric.arrays import Array, Mask


#: Points per knot.  Near the pole of a law neighbouring points of a ramp are up to a decade apart: with five points per
#: knot, as for isotherms, curves cut the corner of E'' in the glass, and log10 α at the cold end was wrong by 1.6
#: standard errors at 1 % of noise.
POINTS_PER_KNOT = 2
#: Correlations of neighbours that are tried, equally likely before and at equal distances of artanh.
CORRELATIONS = np.tanh(np.linspace(0.0, 2.0, 13))


@dataclass(frozen=True, eq=False)
class CorrelatedSmoother:
    """Splines through ramps: K basis functions, m quantities (log E' and log E'')."""

    knots: Array
    degree: int
    penalty: Array  # (K, K)
    same: Mask  # (n - 1,), whether a point and the next belong to one ramp
    smoothing: Array  # (m,)
    scatter: Array  # (m,), standard deviation of a point about its curve, decades
    alike: Array  # (m,), correlation of the errors of neighbouring points

    @classmethod
    def fitted(cls, frequency: Array, moduli: Array, same: Mask) -> CorrelatedSmoother:
        """Place knots for n points, ramp by ramp, and choose smoothing and correlation of each quantity.

        `frequency` (n,) is log10 of the reduced angular frequency; `moduli` (n, m).
        """
        knots, degree = knots_for(frequency, POINTS_PER_KNOT)
        penalty = roughness(knots, degree)
        basis = splines(knots, degree, frequency)[0]
        criteria = np.array([_likelihood(basis, penalty, moduli, same, alike)[2] for alike in CORRELATIONS])
        alike = np.array([_expected(one) for one in criteria.T])
        chosen = [
            _likelihood(basis, penalty, moduli[:, [number]], same, float(one)) for number, one in enumerate(alike)
        ]
        smoothing, scatter = (np.array([one[place][0] for one in chosen]) for place in (0, 1))
        return cls(knots, degree, penalty, same, smoothing, scatter, alike)

    def curve(self, modulus: int, frequency: Array, values: Array) -> CorrelatedCurve:
        """Draw the curve of one quantity through its values (n,)."""
        basis, slopes, _ = splines(self.knots, self.degree, frequency)
        alike = float(self.alike[modulus])
        lifted = whitened(basis, self.same, alike)
        rough = self.smoothing[modulus] * self.penalty
        inverse = np.linalg.inv(ridged(lifted.T @ lifted) + rough)
        target = whitened(values, self.same, alike)
        coefficients = inverse @ (lifted.T @ target)
        residual = target - lifted @ coefficients
        return CorrelatedCurve(
            lifted,
            slopes @ coefficients,
            inverse,
            residual,
            values - basis @ coefficients,
            float(residual @ residual + coefficients @ rough @ coefficients),
        )


@dataclass(frozen=True, eq=False)
class CorrelatedCurve:
    """The curve of one quantity through n points."""

    basis: Array  # (n, K), whitened
    slope: Array  # (n,), of the curve at the points
    inverse: Array  # (K, K)
    residual: Array  # (n,), whitened
    away: Array  # (n,), points minus curve, decades
    cost: float  # whitened squares and penalised roughness, decades²

    @property
    def freedom(self) -> float:
        """Degrees of freedom left in the residuals."""
        return float(len(self.residual) - np.sum(self.inverse * (self.basis.T @ self.basis)))


def whitened(values: Array, same: Mask, alike: float) -> Array:
    """Return values (n, …) whitened: the autoregression along each ramp is removed, and variances are equal."""
    found = np.array(values, dtype=float)
    after = np.flatnonzero(same) + 1
    found[after] = (values[after] - alike * values[after - 1]) / np.sqrt(1.0 - alike**2)
    return found


def _likelihood(basis: Array, penalty: Array, moduli: Array, same: Mask, alike: float) -> tuple[Array, Array, Array]:
    """Return smoothing, scatter and −2 log of the restricted likelihood of each quantity at a correlation."""
    smoothing, scatter, criterion = restricted_likelihood(
        whitened(basis, same, alike), penalty, whitened(moduli, same, alike)
    )
    return smoothing, scatter, criterion + np.count_nonzero(same) * np.log1p(-(alike**2))


def _expected(criterion: Array) -> float:
    """Return the correlation, given −2 log of the likelihood at `CORRELATIONS`.

    The variance of fitted parameters grows by (1 + ρ)/(1 − ρ), so ρ is chosen by the mean of this factor over the
    likelihood: for 250 points with ρ = 0.7, the most likely ρ is 0.68, which made standard errors 4 % too small.
    """
    weight = np.exp(0.5 * (criterion.min() - criterion))
    weight[[0, -1]] *= 0.5
    growth = float(np.average((1.0 + CORRELATIONS) / (1.0 - CORRELATIONS), weights=weight))
    return (growth - 1.0) / (growth + 1.0)
