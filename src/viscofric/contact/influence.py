"""Influence coefficients of the free viscoelastic half-space under steady motion (paper, Eq. 8).

The displacement that a uniform pressure on one square cell causes at the centre of another is Love's closed
form for 1/r over a square, convolved along the direction of motion with the fading memory of each retardation
mode.  Everything here is in units of the cell: one mode of memory length ``λ = v τ / h`` contributes ::

    K(x, y; λ) = ∫_0^∞ e^(−z) L(x + λ z, y) dz,      L(x, y) = ∫∫_cell dx' dy' / |r − r'|

which obeys a backward recursion from one cell to the next,

    K(x) = ∫_0^1 ε e^(−ε s) L(x + s) ds + e^(−ε) K(x + 1),      ε = 1/λ.

The integral over one cell is a product-integration rule: L is interpolated at Gauss points, the exponential is
integrated exactly, so that the rule holds for any ε and its points are shared by all modes.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from scipy.special import eval_legendre, ive

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]

# Beyond this distance (in cells) the multipole series of Love's form is right to 1e-10 and cheaper.
_FAR = 20.0
# Longest exponent that still leaves a trace in double precision.
_FADED = 45.0
# Rate ε from which three terms of the asymptotic series of the exponential's moments are right to 1e-11.
_HUGE_RATE = 1e6


def cell_potential(x: Array, y: Array) -> Array:
    """Integral of 1/r over the unit square around the origin, seen from (x, y) in its plane.

    Closed form: A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377; K. L. Johnson, Contact Mechanics
    (1985), Eq. 3.25.  Far away: its multipole series up to the fourth moments of the square.
    """
    x, y = np.broadcast_arrays(x, y)
    r2 = x * x + y * y
    near = r2 < _FAR**2
    inverse2 = 1.0 / np.where(near, _FAR**2, r2)
    fourth = -7.0 / 1920.0 + (7.0 / 96.0) * (x * y * inverse2) ** 2
    result = np.sqrt(inverse2) * (1.0 + inverse2 * (1.0 / 24.0 + inverse2 * fourth))
    if near.any():
        result[near] = _love(x[near], y[near])
    return result


def _love(x: Array, y: Array) -> Array:
    def corner(a: Array, b: Array) -> Array:
        # a asinh(b/|a|) + b asinh(a/|b|); each term goes to zero with its first factor.
        with np.errstate(divide="ignore", invalid="ignore"):
            first = np.where(a == 0.0, 0.0, a * np.arcsinh(b / np.abs(a)))
            second = np.where(b == 0.0, 0.0, b * np.arcsinh(a / np.abs(b)))
        return first + second

    return _corner_sum(corner, x, y)


def _corner_sum(corner: Callable[[Array, Array], Array], x: Array, y: Array) -> Array:
    """Difference of an antiderivative over the four corners of the unit square."""
    east, west, north, south = x + 0.5, x - 0.5, y + 0.5, y - 0.5
    return corner(east, north) - corner(east, south) - corner(west, north) + corner(west, south)


def cell_potential_xx(x: Array, y: Array) -> Array:
    """Second derivative along x of `cell_potential` (not on the lines x = ±1/2 through the cell's edges)."""
    x, y = np.broadcast_arrays(x, y)

    def corner(a: Array, b: Array) -> Array:
        return np.asarray(-b / (a * np.hypot(a, b)))

    return _corner_sum(corner, x, y)


@lru_cache(maxsize=16)
def _gauss(order: int) -> tuple[Array, Array]:
    """Gauss points on [0, 1] and the matrix that turns values there into Legendre coefficients."""
    t, weight = np.polynomial.legendre.leggauss(order)
    degree = np.arange(order)[:, None]
    to_legendre = (degree + 0.5) * weight * eval_legendre(degree, t)
    return 0.5 * (t + 1.0), to_legendre


def _product_weights(order: int, rate: Array) -> Array:
    """Weights w with ∫_0^1 ε e^(−ε s) f(s) ds = Σ_g w_g f(s_g), exact for polynomials of degree < order.

    The Legendre moments of the exponential are modified spherical Bessel functions (DLMF 10.47.7, 10.54.1);
    for huge rates the first terms of their asymptotic series (DLMF 10.49.8) take over.
    """
    n = np.arange(order)
    rate = rate[:, None]
    huge = rate > _HUGE_RATE
    bounded = np.where(huge, _HUGE_RATE, rate)
    moments = np.where(
        huge,
        1.0 - n * (n + 1) / rate * (1.0 - (n + 2) * (n - 1) / (2.0 * rate)),
        np.sqrt(np.pi * bounded) * ive(n + 0.5, 0.5 * bounded),
    )
    return np.asarray(((-1.0) ** n * moments) @ _gauss(order)[1])


def _panel_rule(edges: Array, order: int, rate: Array) -> tuple[Array, Array]:
    """Composite product-integration rule on panels: points (n,) and weights (modes, n)."""
    points, weights = [], []
    for start, end in pairwise(edges):
        points.append(start + (end - start) * _gauss(order)[0])
        weights.append(np.exp(-rate * start)[:, None] * _product_weights(order, rate * (end - start)))
    return np.concatenate(points), np.concatenate(weights, axis=1)


# Rows of cells (distance across, in cells) that share a rule: the nearer the cell, the finer the rule.
# With Gauss order n on a panel the error falls as ρ^(−n), ρ the Bernstein ellipse through the nearest
# singularity, the edge of the loaded cell; the orders below leave less than 1e-11.
_WHOLE = np.array([0.0, 1.0])
_HALVES = np.array([0.0, 0.5, 1.0])
_ROW_RULES: tuple[tuple[int, Array, int], ...] = (
    (0, _HALVES, 16),
    (3, _WHOLE, 12),
    (16, _WHOLE, 7),
    (64, _WHOLE, 5),
)
# Potentials evaluated in one go: enough to keep the interpreter idle, few enough for the cache.
_BLOCK = 500_000
# Panels that halve towards a point: 1/2 to 1e-12.
_HALVINGS = 0.5 ** np.arange(1.0, 40.0)


def memory_influence(shape: tuple[int, int], mixtures: Array, memory_lengths: Array, shift: float = 0.0) -> Array:
    """Delayed displacements around one loaded cell of the free half-space, for mixtures of modes.

    Parameters
    ----------
    shape : (nx, ny)
        Number of cells of the window; x is the direction of motion.
    mixtures : (k, m) array
        Each row holds the coefficients c_m of one mixture of the m modes.
    memory_lengths : (m,) array
        λ_m = v τ_m / h > 0, in cells, for motion towards +x.
    shift : float
        How far behind the cell centres the displacement is looked at, in cells (0 to 0.5).

    Returns
    -------
    (k, 2 nx − 1, ny) array
        ``Σ c_m K(x, y; λ_m)`` at x + shift = −(nx−1) … nx−1 and y = 0 … ny−1, in cells; K is even in y.  Right to
        about 1e-11 of the largest value for memory lengths from 1e-8 to 1e10 cells.

    Notes
    -----
    The cost hardly depends on the number of modes: the potential of the cell is evaluated once for all of
    them, at 5 to 32 points a cell, the fewer the farther the row lies from the loaded cell.
    """
    nx, ny = shape
    offsets = np.arange(-(nx - 1.0), nx) - shift
    result = np.zeros((len(mixtures), 2 * nx - 1, ny))
    if len(memory_lengths) == 0:
        return result
    rows = np.arange(float(ny))
    rate = 1.0 / memory_lengths
    decay = np.exp(-rate)[:, None]
    starts = [start for start, _, _ in _ROW_RULES] + [ny]
    for (start, edges, order), end in zip(_ROW_RULES, starts[1:], strict=True):
        y = rows[start:end]
        if len(y) == 0:
            break
        points, weights = _panel_rule(edges, order, rate)
        memory = _tail(nx - shift, y, rate)
        block = max(1, _BLOCK // (len(points) * len(y)))
        for last in range(2 * nx - 2, -1, -block):
            first = max(0, last + 1 - block)
            potential = cell_potential(offsets[first : last + 1, None, None] + points[:, None], y)
            for i in range(last, first - 1, -1):
                memory = weights @ potential[i - first] + decay * memory
                if start == 0 and -2.0 <= offsets[i] <= 1.0:
                    memory[:, 0] += _singular_correction(offsets[i], points, weights, rate)
                result[:, i, start : start + len(y)] = mixtures @ memory
    return result


def _singular_correction(x: float, points: Array, weights: Array, rate: Array) -> Array:
    """Return what the plain rule misses from x to x + 1 in the loaded row, near the loaded cell's own edge.

    The edge, x = ±1/2, is a logarithmic singularity of the slope; panels halve towards it from both sides.
    """
    edge = (0.5 - x) % 1.0
    near = np.concatenate([[0.0, 1.0, edge], edge - _HALVINGS, edge + _HALVINGS, edge + 1.0 - _HALVINGS])
    panels, graded = _panel_rule(np.unique(near[(near >= 0.0) & (near <= 1.0)]), 16, rate)
    zero = np.zeros(1)
    return np.asarray(graded @ cell_potential(x + panels, zero) - weights @ cell_potential(x + points, zero))


def _tail(start: float, y: Array, rate: Array) -> Array:
    """K(start, y; 1/rate) by itself, on panels that double in length until every mode has faded."""
    end = _FADED / rate.min()
    edges = [0.0, start]
    while edges[-1] < end:
        edges.append(2.0 * edges[-1] + start)
    points, weights = _panel_rule(np.array(edges), 16, rate)
    return np.asarray(weights @ cell_potential(start + points[:, None], y))
