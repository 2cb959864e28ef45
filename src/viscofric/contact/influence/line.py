"""Influence coefficients of a line contact in steady motion: the logarithm convolved with the memory, in closed form.

The displacement under a pressure that is the same all along y is that of the logarithm: with
Λ(x) = −∫_cell ln|x − x'| dx' in units of the cell, a mode of memory length ``λ = v τ / h`` contributes ::

    K(x; λ) = ∫_0^∞ e^(−z) Λ(x + λ z) dz = Λ(x) + λ [G(b₂) − G(b₁)],        b = (x ± 1/2)/λ,
    G(b) = −ln|b| − F(b),      F(b) = e^b E₁(b) for b > 0,  −e^b Ei(−b) for b < 0

(by parts; DLMF 6.2).  G is finite and continuous at b = 0, where the logarithms of its two terms cancel.

Under a shear stress of μ times the pressure along x, −ln|x| has μ β (π/2) sgn x added (see
`viscofric.contact.influence.potentials`), the integral of x/r² across the line.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.polynomial.polynomial import polyval
from scipy.special import exp1, expi

from viscofric.arrays import Array

# From here on twenty terms of the asymptotic series of b F(b) in 1/b (DLMF 6.12.1) are right to the last digit.
_ASYMPTOTIC = 50.0
_ASYMPTOTIC_SERIES = [(-1) ** k * math.factorial(k) for k in range(20)]
# The part of E₁(b) without logarithm and Euler's constant, for |b| < 1 (DLMF 6.6.2).
_POWER_SERIES = [0.0, *((-1) ** k / (k * math.factorial(k)) for k in range(1, 21))]


def strip_potential(x: Array) -> Array:
    """Integral of −ln|x − x'| over the unit cell around the origin."""
    return _antiderivative(x + 0.5) - _antiderivative(x - 0.5)


@dataclass(frozen=True)
class HalfSpaceStrip:
    """Potential of a cell of a line contact on a half-space, in units of the cell's length; the same for all y.

    `drag` is μ β, with μ the shear stress along x over the pressure.
    """

    aspect: ClassVar[float] = 1.0  # there is one row
    drag: float = 0.0

    def __call__(self, x: Array, y: Array) -> Array:
        """Integral of −ln|x − x'|, with its part by shear, over the cell, seen from x."""
        x = np.broadcast_arrays(x, y)[0]
        return strip_potential(x) + self.drag * strip_shear(x)

    def drag_slope(self, x: Array, y: Array) -> Array:
        """Return the derivative along x of the part by shear (not for x = ±1/2)."""
        x = np.broadcast_arrays(x, y)[0]
        return np.where(np.abs(x) < 0.5, np.pi * self.drag, 0.0)


def strip_shear(x: Array) -> Array:
    """Integral of (π/2) sgn(x − x') over the unit cell around the origin."""
    return np.asarray(0.5 * np.pi * np.clip(2.0 * x, -1.0, 1.0))


def shear_memory_influence(x: Array, memory_length: float) -> tuple[Array, Array]:
    """Return ∫_0^∞ e^(−z) S(x + λ z) dz, S of `strip_shear`, and its derivative along x (not for x = ±1/2).

    Arguments as of `line_memory_influence`.
    """
    # e^(−s/λ) of the distance s to the front and the rear end of the cell ahead, one behind them
    front, rear = (np.exp(-np.maximum(end - x, 0.0) / memory_length) for end in (0.5, -0.5))
    slope = np.pi * (np.where(x < -0.5, rear, 1.0) - np.where(x < 0.5, front, 1.0))
    return strip_shear(x) + memory_length * slope, slope


def _antiderivative(a: Array) -> Array:
    """Integrate −ln|a| from zero."""
    logarithm = np.log(np.abs(np.where(a == 0.0, 1.0, a)))
    return np.asarray(a * (1.0 - logarithm))


def scaled_exponential_integral(b: Array) -> Array:
    """F(b) = e^b E₁(b) for b > 0, −e^b Ei(−b) for b < 0: the principal value of ∫_0^∞ e^(−z)/(z + b) dz."""
    ahead, behind = (b > 0.0) & (b <= _ASYMPTOTIC), (b <= 0.0) & (b >= -_ASYMPTOTIC)
    return np.asarray(
        np.piecewise(
            b,
            [ahead, behind],
            [
                lambda b: np.exp(b) * exp1(b),
                lambda b: -np.exp(b) * expi(-b),
                lambda b: polyval(1.0 / b, _ASYMPTOTIC_SERIES) / b,
            ],
        )
    )


def _memory_function(b: Array) -> Array:
    """G(b) − γ, finite at b = 0."""
    return np.asarray(
        np.piecewise(
            b,
            [np.abs(b) < 1.0],
            [_memory_function_near, lambda b: -np.log(np.abs(b)) - scaled_exponential_integral(b) - np.euler_gamma],
        )
    )


def _memory_function_near(b: Array) -> Array:
    """G(b) − γ for |b| < 1 by the power series of E₁, whose logarithm G does not have."""
    logarithm = np.log(np.abs(np.where(b == 0.0, 1.0, b)))
    return np.asarray(np.expm1(b) * (logarithm + np.euler_gamma) + np.exp(b) * polyval(b, _POWER_SERIES))


def line_memory_influence(x: Array, memory_length: float) -> tuple[Array, Array]:
    """Return delayed displacement K(x; λ) and dissipation (n,) around one loaded cell of a line contact, for one mode.

    `x` (n,) is the position relative to the loaded cell, in cells; λ = v τ / h > 0, in cells, for motion towards +x.
    The dissipation is ∂K/∂x up to an odd function of x, which does no work; not for x = ±1/2.  For λ from 1e-8 to 1e10
    cells, rounding is about 1e-15 for every cell of distance.
    """
    ends = np.stack((x - 0.5, x + 0.5))
    if in_row := x.ndim == 1 and bool(np.all(np.diff(x) == 1.0)):  # each cell begins where the one before ends
        ends = np.append(ends[0], ends[1, -1:])
    ends /= memory_length

    def change_of(function: Callable[[Array], Array]) -> Array:
        return np.diff(function(ends), axis=-1 if in_row else 0).reshape(x.shape)

    change = change_of(_memory_function)
    displacement = strip_potential(x) + memory_length * change
    if memory_length > 1.0:
        return displacement, change
    # A short memory: ∂K/∂x is nearly that of the logarithm, −ln|end/start|, which is odd and left out.
    return displacement, -change_of(scaled_exponential_integral)
