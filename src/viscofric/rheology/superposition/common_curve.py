"""One smooth curve through shifted isotherms: a spline whose smoothness follows from the data.

log E' and log E'' over log reduced frequency, or friction over reduced speed, are cubic splines; the square of their
third derivative is penalised.  The penalty's factor follows from restricted maximum likelihood (S. N. Wood, J. R. Stat.
Soc. B 73 (2011) 3), for each quantity: noisy sweeps get a smoother curve.  The errors of the shifts depend on it.  A
curve that follows the noise has noise in its slope, which would be taken for information on the shifts: at 3 % noise,
95 % bands from splines without penalty cover 88 %.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array

#: Points per knot, and the smallest distance of knots in decades: spectra have no sharper features.
POINTS_PER_KNOT = 5
KNOT_SPACING = 0.4
#: Smoothing parameters tried, decades⁵.
SMOOTHING = np.logspace(-8.0, 6.0, 57)
_LOG_SMOOTHING = np.log(SMOOTHING)
#: Order of the derivative whose square is penalised; parabolas are free.
ROUGHNESS = 3
#: Regularises bases that the points do not determine; relative.
RIDGE = 1e-10
SMALLEST_SCATTER = 1e-6  # decades; noise-free data would have none


@dataclass(frozen=True, eq=False)
class Basis:
    """K basis functions of smoothing splines placed for n points, whatever the values and weights of these are."""

    knots: Array  # (k,), log10 of the reduced frequency, ends repeated
    degree: int  # 3, or less where the points are very few
    penalty: Array  # (K, K), integrals of products of third derivatives of the basis functions, 1/decades⁵
    splines: Array  # (3, n, K), the functions at the points, and their first and second derivatives

    @classmethod
    def of(cls, frequency: Array, points: int = POINTS_PER_KNOT) -> Basis:
        """Place knots for points at log10 frequencies (n,), so many of them in every interval."""
        knots, degree = _knots_for(frequency, points)
        return cls(knots, degree, _roughness(knots, degree), _splines(knots, degree, frequency))

    def at(self, frequency: Array, orders: int = 3) -> Array:
        """Return the functions at other places (n,), with their derivatives of the lowest orders: (orders, n, K)."""
        return _splines(self.knots, self.degree, frequency, orders)

    def smoother(self, moduli: Array, weights: Array | None = None) -> Smoother:
        """Choose the smoothing for moduli (n, m), such as log10 of E' and E'', with weights (n,), inverse variances."""
        root = _roots(moduli, weights)
        smoothing, scatter, _ = restricted_likelihood(self.splines[0] * root, self.penalty, moduli * root)
        return Smoother(self, smoothing, scatter)

    def curves(self, moduli: Array, weights: Array | None = None) -> Curves:
        """Choose the smoothing for moduli (n, m) with weights (n,), and draw the curves through them."""
        return self.smoother(moduli, weights).drawn(self.splines, moduli, weights)


@dataclass(frozen=True, eq=False)
class Smoother:
    """Smoothing splines to be drawn through points: K basis functions, m quantities such as log E' and log E''."""

    basis: Basis
    smoothing: Array  # (m,), factor of the penalty
    scatter: Array  # (m,), standard deviation of a point of weight 1 about its curve; decades for logarithms

    def curves(self, frequency: Array, moduli: Array, weights: Array | None = None) -> Curves:
        """Draw the curves through points at log10 frequencies (n,); moduli and weights as for `Basis.smoother`."""
        return self.drawn(self.basis.at(frequency), moduli, weights)

    def drawn(self, at_points: Array, moduli: Array, weights: Array | None) -> Curves:
        """Draw the curves through points where the basis functions and their derivatives are known, (3, n, K)."""
        root = _roots(moduli, weights)
        found = at_points * root
        basis = found[0]
        moduli = moduli * root
        square = _ridged(basis.T @ basis)
        inverse = np.linalg.inv(square + self.smoothing[:, None, None] * self.basis.penalty)
        coefficients = np.einsum("mij,jm->im", inverse, basis.T @ moduli)
        return Curves(self, root, found, np.asarray(inverse), coefficients, moduli - basis @ coefficients)


@dataclass(frozen=True, eq=False)
class Curves:
    """Curves of m quantities, such as log E' and log E'', through n points of weight w."""

    smoother: Smoother  # with K basis functions B
    root: Array  # (n, 1), √w
    splines: Array  # (3, n, K), B at the points, and its first and second derivative, times √w
    inverse: Array  # (m, K, K), (BᵀB + λP)⁻¹ of each quantity
    coefficients: Array  # (K, m)
    residual: Array  # (n, m), points minus curves, times √w

    def cost(self, weights: Array) -> float:
        """Return the objective of the fit: squared residuals and penalised roughness, with weights (m,)."""
        rough = np.sum(self.coefficients * (self.smoother.basis.penalty @ self.coefficients), axis=0)
        return float(weights @ (np.sum(self.residual**2, axis=0) + self.smoother.smoothing * rough))

    @property
    def freedom(self) -> float:
        """Degrees of freedom left in the residuals of all quantities."""
        used = np.sum(self.inverse * (self.basis.T @ self.basis))
        return float(self.residual.size - used)

    @property
    def basis(self) -> Array:
        """Basis functions B at the points, times √w (n, K)."""
        return np.asarray(self.splines[0])

    @property
    def slopes_of_basis(self) -> Array:
        """First derivatives of the basis functions at the points, times √w (n, K)."""
        return np.asarray(self.splines[1])

    @property
    def bends(self) -> Array:
        """Second derivatives of the curves at the points, times √w (n, m)."""
        return np.asarray(self.splines[2] @ self.coefficients)


def _roots(moduli: Array, weights: Array | None) -> Array:
    return np.ones((len(moduli), 1)) if weights is None else np.sqrt(weights)[:, None]


def _knots_for(frequency: Array, points: int) -> tuple[Array, int]:
    """Place knots so that every interval holds so many measured points; return them with the degree of the splines."""
    frequency = np.sort(frequency)
    inner, last = [float(frequency[0])], 0
    for place in range(1, len(frequency) - points):
        if place - last >= points and frequency[place] - inner[-1] >= KNOT_SPACING:
            inner.append(float(0.5 * (frequency[place] + frequency[place - 1])))
            last = place
    degree = min(3, len(frequency) - 1)
    ends = np.ones(degree + 1)
    return np.concatenate([frequency[0] * ends, inner[1:], frequency[-1] * ends]), degree


def _splines(knots: Array, degree: int, at: Array, orders: int = 3) -> Array:
    """Return basis functions at points (n,), with their derivatives of the lowest orders: (orders, n, K)."""
    from scipy.interpolate import BSpline

    # Beyond the ends the outermost polynomials continue.
    every = BSpline.construct_fast(knots, np.eye(len(knots) - degree - 1), degree)
    found = np.zeros((orders, len(at), len(knots) - degree - 1))
    for order in range(min(orders, degree + 1)):  # scipy before 1.17 writes beyond its memory for higher ones
        found[order] = every(at, order)
    return found


def _roughness(knots: Array, degree: int) -> Array:
    """Integrate products of third derivatives, which are step functions for cubics."""
    size = len(knots) - degree - 1
    if degree < ROUGHNESS:
        return np.zeros((size, size))
    rough, inner = np.eye(size), knots
    for order in range(degree, degree - ROUGHNESS, -1):
        inner = inner[1:-1]
        rough = order * np.diff(rough, axis=0) / (inner[order:] - inner[:-order])[:, None]
    return np.asarray((rough * np.diff(inner)[:, None]).T @ rough)


def _ridged(square: Array) -> Array:
    """Return BᵀB with a small multiple of the identity, for bases that the points do not determine."""
    found = square.copy()
    np.fill_diagonal(found, found.diagonal() + RIDGE * np.mean(found.diagonal()))
    return found


def restricted_likelihood(basis: Array, penalty: Array, moduli: Array) -> tuple[Array, Array, Array]:
    """Return the smoothing of each quantity that maximises its restricted likelihood, the scatter, and −2 log of it."""
    # In the basis that makes BᵀB the identity and the penalty diagonal (d), the likelihood of all smoothings λ is −2
    # log L = (n − q) log S + Σ log(1 + λd) − (K − q) log λ, with S the penalised squares and q the number of
    # coefficients without penalty; S/(n − q) is the squared scatter.
    factor = np.linalg.cholesky(_ridged(basis.T @ basis))
    inverse = np.linalg.inv(factor)
    whitened = inverse @ penalty @ inverse.T
    rough, modes = np.linalg.eigh(0.5 * (whitened + whitened.T))
    unpenalised = min(ROUGHNESS, len(rough))
    rough = np.maximum(rough, 0.0)
    rough[:unpenalised] = 0.0
    within = inverse @ (basis.T @ moduli)
    parts = modes.T @ within
    left = np.sum((moduli - basis @ (inverse.T @ within)) ** 2, axis=0)
    freedom = max(len(basis) - unpenalised, 1)
    growth = 1.0 + SMOOTHING[:, None] * rough
    squares = left[:, None] + ((1.0 - 1.0 / growth) @ parts**2).T
    squares = np.maximum(squares, freedom * SMALLEST_SCATTER**2)
    penalised = len(rough) - unpenalised
    criterion = freedom * np.log(squares) + np.sum(np.log(growth), axis=1) - penalised * _LOG_SMOOTHING
    best = np.argmin(criterion, axis=1)
    chosen = np.arange(len(best)), best
    constant = 2.0 * np.sum(np.log(np.diag(factor)))
    return SMOOTHING[best], np.sqrt(squares[chosen] / freedom), criterion[chosen] + constant
