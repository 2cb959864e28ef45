"""Shifts of step tests with offsets: the maximum of the likelihood, with the curve and the offsets integrated over.

Least squares attributes a part of each offset to the shift.  An offset changes all points of a test equally, so
differences between points of one test determine its shift better than their level does.  The likelihood weights both
(generalised least squares).  With offsets, errors of the shifts are typically three to seven times smaller.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.arrays import Array


#: Step of the finite differences, in standard errors.
DIFFERENCE = 0.5
#: Second derivatives are at least this fraction of the Gauss–Newton ones.
SMALLEST_PART = 0.2
PASSES = 4  # each computes the second derivatives again
STEPS = 6  # of each pass
LARGEST_STEP = 0.3  # decades, in one step
SHORTENED = 0.5 ** np.arange(7)
#: The search ends with a step below this many standard errors, and the passes with a move below the second number.
CONVERGED = 1e-3
MOVED = 0.1


def most_likely(likelihood: Callable[[Array], Array], start: Array, scale: Array) -> tuple[Array, Array]:
    """Return the parameters (p,) that minimise −2 log of a likelihood, and their covariance (p, p).

    `likelihood` returns −2 log of it (k,) at several parameters (k, p).  The columns of `scale` (p, q) are the q
    directions in which parameters may change, each by one Gauss–Newton standard error.
    """
    found = start
    for _ in range(PASSES):
        parts, modes = np.linalg.eigh(_second_derivatives(likelihood, found, scale))
        ways = scale @ (modes / np.sqrt(np.maximum(parts, SMALLEST_PART)))
        moved = _descended(likelihood, found, ways)
        far = float(np.linalg.norm(np.linalg.lstsq(ways, moved - found, rcond=None)[0]))
        found = moved
        if far < MOVED:
            break
    return found, np.asarray(ways @ ways.T)


def _descended(likelihood: Callable[[Array], Array], start: Array, ways: Array) -> Array:
    """Take Newton steps along directions `ways` (p, q) that are scaled so that the second derivatives are one."""
    found, q = start, ways.shape[1]
    for _ in range(STEPS):
        moves = DIFFERENCE * ways.T
        values = likelihood(np.concatenate([[found], found + moves, found - moves]))
        gradient = (values[1 : q + 1] - values[q + 1 :]) / (4.0 * DIFFERENCE)
        step = -ways @ gradient
        step *= min(1.0, LARGEST_STEP / max(float(np.max(np.abs(step))), 1e-300))
        trials = likelihood(found + SHORTENED[:, None] * step)
        best = int(np.argmin(trials))
        if trials[best] >= values[0]:
            break
        found = found + SHORTENED[best] * step
        if np.linalg.norm(gradient) < CONVERGED:
            break
    return np.asarray(found)


def _second_derivatives(likelihood: Callable[[Array], Array], at: Array, ways: Array) -> Array:
    """Return half of the second derivatives (q, q) along directions `ways` (p, q), by finite differences."""
    q = ways.shape[1]
    moves = DIFFERENCE * ways.T
    first, second = np.tril_indices(q, -1)
    pairs = moves[first] + moves[second]
    values = likelihood(np.concatenate([[at], at + moves, at - moves, at + pairs, at - pairs])) / (2.0 * DIFFERENCE**2)
    values = values[1:] - values[0]
    own = values[:q] + values[q : 2 * q]
    both = values[2 * q : 2 * q + len(pairs)] + values[2 * q + len(pairs) :]
    found = np.diag(own)
    found[first, second] = found[second, first] = 0.5 * (both - own[first] - own[second])
    return found
