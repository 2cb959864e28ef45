"""Quadrature of a fading memory: functions against ε e^(−ε s), exact for polynomials whatever the rate ε.

A product-integration rule interpolates a function at points that all rates share and integrates the exponential
exactly, so that it holds from rates that hardly fade within a panel to those that see its beginning only.  Rates may be
complex, with small imaginary parts: everything is analytic in them.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from scipy.special import eval_legendre

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.arrays import Array, Indices

    Inexact: TypeAlias = NDArray[Any]  # rates and what follows from them: real or complex

# Up to this rate forty Gauss points integrate e^(−ε s) times polynomials of degree 15 to the last digit; from it on the
# recurrence of the moments loses no more than three.
_STEEP = 32.0
_FINE = 40
_ROUNDING = 1e-17


def faded(exponent: Inexact) -> Inexact:
    """Return e^(−x), to first order in an imaginary part, which is several times quicker than the exponential."""
    if not np.iscomplexobj(exponent):
        return np.asarray(np.exp(-exponent))
    left = np.exp(-exponent.real)
    return np.asarray(left - 1j * (left * exponent.imag))


def applied(weights: Inexact, values: Array) -> Inexact:
    """Return the product of matrices (m, g) and (…, g, n), of which the first may be complex."""
    if not np.iscomplexobj(weights):
        return np.asarray(weights @ values)
    result = np.empty((*values.shape[:-2], weights.shape[0], values.shape[-1]), complex)
    result.real, result.imag = weights.real @ values, weights.imag @ values
    return result


@lru_cache(maxsize=16)
def gauss_points(order: int) -> tuple[Array, Array, Array]:
    """Gauss points on [0, 1], the matrix that turns values there into Legendre coefficients, and the weights."""
    t, weight = np.polynomial.legendre.leggauss(order)
    degree = np.arange(order)[:, None]
    to_legendre = (degree + 0.5) * weight * eval_legendre(degree, t)
    return 0.5 * (t + 1.0), to_legendre, 0.5 * weight


@lru_cache(maxsize=16)
def _fine_rule(order: int) -> tuple[Array, Array]:
    """Gauss points on [0, 1], and weights times the Legendre polynomials below a degree there."""
    t, weight = np.polynomial.legendre.leggauss(_FINE)
    return 0.5 * (t + 1.0), 0.5 * weight[:, None] * eval_legendre(np.arange(order), t[:, None])


def product_weights(order: int, rate: Inexact) -> Inexact:
    """Weights w (…, order) with ∫_0^1 ε e^(−ε s) f(s) ds = Σ_g w_g f(s_g) at Gauss points, for rates Re ε > 0, (…).

    Up to 16 points; polynomials of a degree below `order` are integrated exactly.  The Legendre moments M_n of the
    exponential are, except for sign and scale, modified spherical Bessel functions of ε/2 (DLMF 10.47.7), with M_{n+1}
    = M_{n−1} + (4n + 2)/ε M_n.
    """
    fading = rate.reshape(-1, 1)
    size = fading[:, 0].real
    flat, steep = size <= _flat(order), size > _STEEP
    between = ~(flat | steep)
    weights = np.empty((len(fading), order), rate.dtype)
    # So flat an exponential is itself a polynomial that the points' own rule integrates along with the function.
    points, to_legendre, rule = gauss_points(order)
    if flat.any():
        weights[flat] = _exponential(fading[flat], points) * rule
    for which, moments in ((between, _gentle_moments), (steep, _steep_moments)):
        if which.any():
            weights[which] = applied(moments(order, fading[which]), to_legendre)
    return weights.reshape(*rate.shape, order)


def _flat(order: int) -> float:
    """Rate up to which Chebyshev's series of e^(−ε s), with coefficients below (ε/4)^n/n!, ends with the degree n."""
    return float(4.0 * (_ROUNDING * math.factorial(order + 1)) ** (1.0 / (order + 1)))


def _exponential(rate: Inexact, points: Array) -> Inexact:
    """Return ε e^(−ε s), to first order in an imaginary part: (k, 1) rates, (k, points)."""
    exponent = rate.real * points
    fading = np.asarray(rate.real * np.exp(-exponent))
    if not np.iscomplexobj(rate):
        return fading
    result = np.empty(exponent.shape, complex)
    # By the derivative with ln ε.
    result.real, result.imag = fading, rate.imag / rate.real * (fading * (1.0 - exponent))
    return result


def _gentle_moments(order: int, rate: Inexact) -> Inexact:
    """Return ∫_0^1 ε e^(−ε s) P_n(2 s − 1) ds of the Legendre polynomials below a degree: (k, 1) rates, (k, order)."""
    points, polynomials = _fine_rule(order)
    return applied(_exponential(rate, points), polynomials)


def _steep_moments(order: int, rate: Inexact) -> Inexact:
    moments = np.empty((len(rate), order), rate.dtype)
    rest = faded(rate[:, 0])
    moments[:, 0] = 1.0 - rest
    moments[:, 1] = 2.0 / rate[:, 0] * moments[:, 0] - (1.0 + rest)
    for n in range(1, order - 1):
        moments[:, n + 1] = moments[:, n - 1] + (4 * n + 2) / rate[:, 0] * moments[:, n]
    return moments


def panel_points(edges: Array, order: int) -> Array:
    """Gauss points on panels, (n order,), from the panels' n + 1 edges."""
    return np.asarray((edges[:-1, None] + np.diff(edges)[:, None] * gauss_points(order)[0]).ravel())


def panel_rule(edges: Array, order: int, rate: Inexact) -> tuple[Array, Inexact]:
    """Return points (n order,) and weights (m, n order) of a composite rule on panels, for rates (m,), Re ε > 0.

    `edges` (n + 1,) ascend; `order` is the number of points on each panel.
    """
    starts, lengths = edges[:-1], np.diff(edges)
    weights = product_weights(order, rate[:, None] * lengths)
    weights *= faded(rate[:, None] * starts)[..., None]
    return panel_points(edges, order), weights.reshape(len(rate), -1)


@lru_cache(maxsize=4)
def lattice_interpolation(order: int) -> tuple[Indices, Array]:
    """Return interpolation in the cell 0 … 1 from values at integers.

    The integers (order,), centred on the cell, and the matrix (order, order) from values there to values at the cell's
    Gauss points.
    """
    nodes = np.arange(order) - (order // 2 - 1)
    points = gauss_points(order)[0]
    matrix = np.ones((order, order))
    for k, node in enumerate(nodes):
        for other in nodes[nodes != node]:
            matrix[:, k] *= (points - other) / (node - other)
    return nodes, matrix
