"""Sums of influence coefficients over a correlation, and of their changes with the memory lengths, mode by mode.

A bilinear form of the influence matrix is Σ a(x) K(x − x') b(x') = Σ W(Δ) K(Δ) with the correlation
W(Δ) = Σ a(x) b(x − Δ).  A recursion from cell to cell is walked once for all modes, and what it yields is summed up on
the way, so that no mode's coefficients are ever stored.  With ε = 1/λ and L and K as in `viscofric.contact.influence`,

    K(x) = ∫_0^1 ε e^(−ε s) L(x + s) ds + e^(−ε) K(x + 1),

and the change with the memory length has the kernel z e^(−z) beside e^(−z) ::

    ∂K/∂ln λ = M − K,      M(x, y; λ) = ∫_0^∞ z e^(−z) L(x + λ z, y) dz
    M(x) = ∫_0^1 ε² s e^(−ε s) L(x + s) ds + e^(−ε) [M(x + 1) + ε K(x + 1)]
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import scipy.fft
from scipy.special import ive

from viscofric.contact.memory_rules import gauss_points
from viscofric.contact.potentials import cell_potential

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]

# Rate from which the moments of both kernels are the terminating series (its e^(−ε) is then below rounding).
_LARGE_RATE = 1e3
# Longest exponent that still leaves a trace in double precision.
_FADED = 45.0
# Potentials evaluated in one go: enough to keep the interpreter idle, few enough for the cache.
_BLOCK = 500_000
# Panels that halve towards a point: 1/2 to 1e-12.
_HALVINGS = 0.5 ** np.arange(1.0, 40.0)
# Rows of cells (distance across, in cells) that share a rule: the nearer the cell, the finer the rule.  With Gauss
# order n on a panel the error falls as ρ^(−n), ρ the Bernstein ellipse through the nearest singularity, the edge of the
# loaded cell; the orders below leave less than 1e-11.
_WHOLE = np.array([0.0, 1.0])
_ROW_RULES: tuple[tuple[int, Array, int], ...] = (
    (0, np.array([0.0, 0.5, 1.0]), 16),
    (3, _WHOLE, 12),
    (16, _WHOLE, 7),
    (64, _WHOLE, 5),
)


def correlation(first: Array, second: Array) -> Array:
    """Return W(Δ) = Σ a(x) b(x − Δ) of two fields, folded about the direction of motion.

    Parameters
    ----------
    first, second : (nx, ny) array
        a and b, on the same cells.

    Returns
    -------
    (2 nx − 1, ny) array
        At Δx = −(nx−1) … nx−1 and Δy = 0 … ny−1; those at −Δy are added to those at Δy.
    """
    nx, ny = first.shape
    px, py = scipy.fft.next_fast_len(2 * nx - 1), scipy.fft.next_fast_len(2 * ny - 1, real=True)
    product = scipy.fft.rfft2(first, (px, py)) * scipy.fft.rfft2(second, (px, py)).conj()
    circular = scipy.fft.irfft2(product, (px, py))[np.arange(-(nx - 1), nx) % px]
    folded = circular[:, :ny].copy()
    folded[:, 1:] += circular[:, : py - ny : -1]
    return np.asarray(folded)


def memory_moments(weights: Array, memory_lengths: Array, shift: float = 0.0) -> tuple[Array, Array]:
    """Sum up delayed displacements, and their changes with the memory length, for each mode.

    Parameters
    ----------
    weights : (k, 2 nx − 1, ny) array
        Correlations W as `correlation` returns them.
    memory_lengths : (m,) array
        λ_m > 0, in cells.
    shift : float
        How far behind the cell centres the displacement is looked at, in cells (0 to 0.5).

    Returns
    -------
    moments, sensitivities : (k, m) array
        Σ W K and Σ W ∂K/∂ln λ, K as in `viscofric.contact.influence.memory_influence`.  Right to about 1e-11 of
        Σ |W| max |K|.
    """
    sets, length, ny = weights.shape
    nx, modes = length // 2 + 1, len(memory_lengths)
    if modes == 0:
        return np.zeros((sets, 0)), np.zeros((sets, 0))
    offsets = np.arange(-(nx - 1.0), nx) - shift
    sums = np.zeros((2 * modes, sets))
    rate = 1.0 / memory_lengths
    decay = np.exp(-rate)[:, None]
    delayed_decay = decay * rate[:, None]
    rows = np.arange(float(ny))
    graded = _graded_rule((0.5 + shift) % 1.0, rate)
    starts = [start for start, _, _ in _ROW_RULES] + [ny]
    for (start, edges, order), end in zip(_ROW_RULES, starts[1:], strict=True):
        y = rows[start:end]
        if len(y) == 0:
            break
        points, rule = _panel_rule(edges, order, rate)
        memory = _tail(nx - shift, y, rate)
        block = max(1, _BLOCK // (len(points) * len(y)))
        for last in range(length - 1, -1, -block):
            first = max(0, last + 1 - block)
            potential = cell_potential(offsets[first : last + 1, None, None] + points[:, None], y)
            for i in range(last, first - 1, -1):
                ahead, memory = memory, rule @ potential[i - first]
                memory[:modes] += decay * ahead[:modes]
                memory[modes:] += decay * ahead[modes:] + delayed_decay * ahead[:modes]
                if start == 0 and -2.0 <= offsets[i] <= 1.0:
                    memory[:, 0] += _along(offsets[i], *graded) - _along(offsets[i], points, rule)
                sums += memory @ weights[:, i, start : start + len(y)].T
    return sums[:modes].T, (sums[modes:] - sums[:modes]).T


def _product_weights(order: int, rate: Array) -> Array:
    """Weights of ∫_0^1 ε e^(−ε s) f(s) ds and of ∫_0^1 ε² s e^(−ε s) f(s) ds, exact for polynomials of degree < order.

    The Legendre moments m_n of the first kernel are modified spherical Bessel functions, ε e^(−ε/2) i_n(ε/2) up to
    the sign (−1)^n (DLMF 10.54.1), those of the second are m_n − ε ∂m_n/∂ε = (ε/2)(m_n − m_{n+1}) − n m_n
    (DLMF 10.51.5).  For large rates both are sums of (n+k)!/(k! (n−k)!) (−ε)^(−k) (DLMF 10.49.8), the second with the
    factor k + 1.

    Returns
    -------
    (2 m, order) array
        The first kernel's for each rate, then the second's.
    """
    n = np.arange(order + 1.0)
    rate = rate[:, None]
    bounded = np.minimum(rate, _LARGE_RATE)
    moments = np.sqrt(np.pi * bounded) * ive(n + 0.5, 0.5 * bounded)
    plain, delayed = moments[:, :-1], 0.5 * bounded * (moments[:, :-1] - moments[:, 1:]) - n[:-1] * moments[:, :-1]
    plain_series, delayed_series = np.zeros_like(plain), np.zeros_like(plain)
    term = np.ones_like(plain)
    for k in range(order):
        plain_series += term
        delayed_series += (k + 1.0) * term
        term = term * -(n[:-1] + k + 1.0) * (n[:-1] - k) / ((k + 1.0) * np.maximum(rate, _LARGE_RATE))
    large = rate > _LARGE_RATE
    both = np.concatenate([np.where(large, plain_series, plain), np.where(large, delayed_series, delayed)])
    return np.asarray(((-1.0) ** n[:-1] * both) @ gauss_points(order)[1])


def _panel_rule(edges: Array, order: int, rate: Array) -> tuple[Array, Array]:
    """Composite product-integration rule on panels for both kernels: points (n,) and weights (2 m, n)."""
    points, weights = [], []
    modes = len(rate)
    for start, end in pairwise(edges):
        points.append(start + (end - start) * gauss_points(order)[0])
        both = _product_weights(order, rate * (end - start))
        both[modes:] += (rate * start)[:, None] * both[:modes]
        weights.append(np.tile(np.exp(-rate * start), 2)[:, None] * both)
    return np.concatenate(points), np.concatenate(weights, axis=1)


def _graded_rule(edge: float, rate: Array) -> tuple[Array, Array]:
    """Rule on [0, 1] whose panels halve towards the loaded cell's own edge, where the plain rule is not good enough."""
    near = np.concatenate([[0.0, 1.0, edge], edge - _HALVINGS, edge + _HALVINGS, edge + 1.0 - _HALVINGS])
    return _panel_rule(np.unique(near[(near >= 0.0) & (near <= 1.0)]), 16, rate)


def _along(x: float, points: Array, rule: Array) -> Array:
    """Integrals of both kernels from x to x + 1 in the loaded row."""
    return np.asarray(rule @ cell_potential(x + points, np.zeros(1)))


def _tail(start: float, y: Array, rate: Array) -> Array:
    """K and M at (start, y), on panels that double in length until every mode has faded."""
    end = _FADED / rate.min()
    edges = [0.0, start]
    while edges[-1] < end:
        edges.append(2.0 * edges[-1] + start)
    points, weights = _panel_rule(np.array(edges), 16, rate)
    return np.asarray(weights @ cell_potential(start + points[:, None], y))
