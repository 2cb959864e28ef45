"""Exact interconversion of a relaxation (Prony) series and a retardation series, by interlacing poles.

With the operator s = iω, a solid has

    E(s) = E0 + Σ E_k sτ_k / (1 + sτ_k)            relaxation times τ_k
    S(s) = 1/E(s) = 1/E_inf + Σ C_i / (1 + sλ_i)   retardation times λ_i

The poles of S are the zeros of E and the reverse.  Written with s = −1/λ, the zeros of E solve

    E0 − Σ E_k τ_k / (λ − τ_k) = 0,

and, written with s = −r, the zeros of S solve the same equation in rates,

    1/E_inf − Σ C_i p_i / (r − p_i) = 0,    p_i = 1/λ_i,   r_k = 1/τ_k,

so that one function solves both: level E0, strengths E_k, positions τ_k give strengths C_i, positions λ_i;
level 1/E_inf, strengths C_i, positions 1/λ_i give strengths E_k, positions 1/τ_k.  Between neighbouring poles
lies exactly one zero, and one beyond the last: τ_1 < λ_1 < τ_2 < … < τ_n < λ_n.

Accuracy
--------
Each zero is found as a distance from the pole next to it, so that its distance to every pole, and to every other
zero, is known to relative accuracy even where they agree to all digits.  A strength is the residue of a product,

    C_i λ_i = (1/E0) (λ_i − τ_i) Π_{j≠i} (λ_i − τ_j)/(λ_i − λ_j),

all factors positive: poles, zeros and strengths are consistent whatever the rounding of the zeros, so that E(ω) is
the same from both series.  Single strengths are limited by the rounding of stored times: a mode whose neighbour
differs by a fraction g of its time has a strength known to about 1e-16/g.

References
----------
B. Gross, Mathematical Structure of the Theories of Viscoelasticity, Hermann, Paris 1953, ch. VI.
N. W. Tschoegl, The Phenomenological Theory of Linear Viscoelastic Behavior, Springer 1989, section 8.2.
S. W. Park, R. A. Schapery, Int. J. Solids Struct. 36 (1999) 1653, doi:10.1016/S0020-7683(98)00055-9.
J. R. Bunch, C. P. Nielsen, D. C. Sorensen, Numer. Math. 31 (1978) 31 (the secular equation, by distances).
M. Gu, S. C. Eisenstat, SIAM J. Matrix Anal. Appl. 15 (1994) 1266 (strengths that fit the computed zeros).
"""

from __future__ import annotations

import numpy as np

from viscofric.arrays import Array, Indices

#: A zero lies no closer to its pole than e^−700: so many halvings determine all bits of the logarithm of its distance.
_WIDEST, _HALVINGS = 700.0, 64
#: A mode weaker than this, relative to the strongest, is left out: it would underflow.
_NO_STRENGTH = 1e-200


def merged(strengths: Array, positions: Array) -> tuple[Array, Array]:
    """Return modes in ascending position, those at one position summed, those without strength left out."""
    keep = strengths > _NO_STRENGTH * np.max(strengths, initial=0.0)
    unique, place = np.unique(positions[keep], return_inverse=True)
    return np.bincount(place, weights=strengths[keep], minlength=len(unique)).astype(float), unique


def largest_position(level: float, strengths: Array, positions: Array) -> float:
    """Return the largest of the positions that `reciprocal_modes` returns, a hundred times as fast."""
    weights, largest = strengths * positions / level, float(positions.max())
    behind = largest - positions
    # Newton's method from the left, where the function is convex and falls, does not overshoot.  Each mode by itself
    # would have it at p + w.
    distance = step = float((weights - behind).max())
    while step > 1e-12 * distance:
        terms = weights / (behind + distance)
        step = (float(terms.sum()) - 1.0) / float((terms / (behind + distance)).sum())
        distance += max(step, 0.0)
    return largest + distance


def reciprocal_modes(level: float, strengths: Array, positions: Array) -> tuple[Array, Array]:
    """Return strengths and ascending positions (m,) of the modes of the reciprocal function."""
    # From a relaxation series (level E0 > 0, strengths E_k ≥ 0 and relaxation times, (n,)) to C_k and retardation
    # times; or from a retardation series (1/E_inf, C_k and retardation **rates** 1/τ) to E_k and relaxation rates.
    # Equal positions are joined, and those without strength left out.
    weights, poles = merged(strengths, positions)
    if not len(poles):
        return weights, poles
    # Without dimension, so that no unit over- or underflows.
    scale = float(np.exp(np.mean(np.log(poles))))
    weights, poles = merged(weights / level, poles / scale)  # once more: scaling may round two positions to one
    nearest, distance = _zeros(weights * poles, poles)
    near = poles[nearest]
    zeros = near + distance
    # Differences of a zero from each pole, and from each other zero, with relative accuracy.
    from_pole = np.abs((near[:, None] - poles[None, :]) + distance[:, None])
    from_zero = np.abs((near[:, None] - near[None, :]) + (distance[:, None] - distance[None, :]))
    own = np.diag(from_pole).copy()
    np.fill_diagonal(from_pole, 1.0)
    np.fill_diagonal(from_zero, 1.0)
    product = np.exp(np.sum(np.log(from_pole / from_zero), axis=1))
    return own / zeros * product / level, zeros * scale


def _zeros(residues: Array, poles: Array) -> tuple[Indices, Array]:
    """Solve 1 = Σ residues/(x − poles); return for each zero its nearest pole and its signed distance to it."""
    count = len(poles)
    left = np.arange(count)
    gap = np.append(np.diff(poles), np.inf)
    # At the middle of its interval the sign of the function shows on which side of it the zero lies.
    middle = np.where(np.isfinite(gap), 0.5 * gap, 1.0)
    inside = gap < np.inf
    beyond = _imbalance(residues, poles, left, np.ones(count), middle) > 0.0  # the zero is further right
    right = inside & beyond
    nearest = np.where(right, left + 1, left)
    side = np.where(right, -1.0, 1.0)
    # Next to its pole that pole's term outweighs all the others together.
    high = np.log(np.where(inside, middle, np.sum(residues)))
    low = high - _WIDEST
    for _ in range(_HALVINGS):
        trial = 0.5 * (low + high)
        further = _imbalance(residues, poles, nearest, side, np.exp(trial)) * side > 0.0
        low, high = np.where(further, trial, low), np.where(further, high, trial)
    return nearest, side * np.exp(0.5 * (low + high))


def _imbalance(residues: Array, poles: Array, nearest: Indices, side: Array, distance: Array) -> Array:
    """Return ln of the terms of poles on the left over those of level and poles on the right: falls with x."""
    terms = residues / ((poles[nearest][:, None] - poles) + (side * distance)[:, None])
    below, above = np.sum(np.maximum(terms, 0.0), axis=1), 1.0 - np.sum(np.minimum(terms, 0.0), axis=1)
    return np.asarray(np.log(below) - np.log(above))
