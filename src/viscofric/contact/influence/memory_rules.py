"""Quadrature of a fading memory: functions against ε e^(−ε s), exact for polynomials whatever the rate ε.

A product-integration rule interpolates a function at points that all rates share and integrates the exponential
exactly, so that it holds from rates that hardly fade within a panel to those that see its beginning only.  Rates may be
complex, with small imaginary parts: everything is analytic in them.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.special import eval_legendre

from viscofric.arrays import Array, Indices, gauss, lagrange

Inexact: TypeAlias = NDArray[Any]  # rates and what follows from them: real or complex


#: Points of the rule on each panel.
ORDER = 16
#: Longest exponent that still leaves a trace in double precision.
FADED = 45.0
# Up to the rate `FADED` so many Gauss points integrate e^(−ε s) times polynomials of degree 15 to the last digit.
_FINE = 40
_ROUNDING = 1e-17
# Rate up to which Chebyshev's series of e^(−ε s), with coefficients below (ε/4)^n/n!, ends with the degree of the rule.
_FLAT = 4.0 * (_ROUNDING * math.factorial(ORDER + 1)) ** (1.0 / (ORDER + 1))


def faded(exponent: Inexact) -> Inexact:
    """Return e^(−x), to first order in an imaginary part, which is several times quicker than the exponential."""
    if not np.iscomplexobj(exponent):
        return np.asarray(np.exp(-exponent))
    left = np.exp(-exponent.real)
    return np.asarray(left - 1j * (left * exponent.imag))


def applied(weights: Inexact, values: Array) -> Inexact:
    """Return the product of two matrices, of which the first may be complex."""
    if not np.iscomplexobj(weights):
        return np.asarray(weights @ values)
    result = np.empty((len(weights), values.shape[-1]), complex)
    result.real, result.imag = weights.real @ values, weights.imag @ values
    return result


@lru_cache(maxsize=1)
def gauss_points() -> tuple[Array, Array]:
    """Gauss points on [0, 1], and the weights."""
    return gauss(ORDER)


@lru_cache(maxsize=1)
def _of_polynomials() -> tuple[Array, Array, Array]:
    """Finer Gauss points on [0, 1], and from values there to weights, (fine, order); from powers of 1/ε to weights.

    The last for integrals without an end, ∫_0^∞ ε e^(−ε s) s^k ds = k!/ε^k.
    """
    (t, weight), (fine, fine_weight) = gauss_points(), gauss(_FINE)
    degree = np.arange(ORDER)
    to_legendre = (2.0 * degree[:, None] + 1.0) * weight * eval_legendre(degree[:, None], 2.0 * t - 1.0)
    integrals = fine_weight[:, None] * eval_legendre(degree, 2.0 * fine[:, None] - 1.0)
    powers = [[(-1.0) ** (n + k) * math.comb(n, k) * math.perm(n + k, k) for n in degree] for k in degree]
    return fine, integrals @ to_legendre, np.array(powers) @ to_legendre


def product_weights(rate: Inexact) -> Inexact:
    """Weights w (…, order) with ∫_0^1 ε e^(−ε s) f(s) ds = Σ_g w_g f(s_g) at Gauss points, for rates Re ε > 0, (…).

    Polynomials of a degree below the order are integrated exactly.
    """
    fading = rate.reshape(-1, 1)
    size = fading[:, 0].real
    flat, steep = size <= _FLAT, size > FADED
    between = ~(flat | steep)
    weights = np.empty((len(fading), ORDER), rate.dtype)
    points, rule = gauss_points()
    fine, to_weights, by_powers = _of_polynomials()
    # So flat an exponential is itself a polynomial that the points' own rule integrates along with the function.
    weights[flat] = _exponential(fading[flat], points) * rule
    weights[between] = applied(_exponential(fading[between], fine), to_weights)
    weights[steep] = applied(np.vander(1.0 / fading[steep, 0], ORDER, increasing=True), by_powers)
    return weights.reshape(*rate.shape, ORDER)


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


def panel_points(edges: Array) -> Array:
    """Gauss points on panels, (n order,), from the panels' n + 1 edges."""
    return gauss(ORDER, edges)[0]


def panel_weights(edges: Array, rate: Inexact) -> Inexact:
    """Return weights (m, n order) of a composite rule on panels, for rates (m,), Re ε > 0; `edges` (n + 1,) ascend."""
    start = rate[:, None] * edges[:-1]
    left = start.real < FADED
    weights = np.zeros((*left.shape, ORDER), rate.dtype)
    weights[left] = product_weights((rate[:, None] * np.diff(edges))[left]) * faded(start[left])[:, None]
    return weights.reshape(len(rate), -1)


@lru_cache(maxsize=1)
def lattice_interpolation() -> tuple[Indices, Array]:
    """Return interpolation in the cell 0 … 1 from values at integers.

    The integers (order,), centred on the cell, and the matrix (order, order) from values there to values at the cell's
    Gauss points.
    """
    nodes = np.arange(ORDER) - (ORDER // 2 - 1)
    return nodes, lagrange(nodes.astype(float), gauss_points()[0])
