"""What it does to shift factors that overlaps which chance makes too small are not found at all.

An overlap counts only if curves contradict each other by `CONTRADICTION` at either end of the steps that are possible.
So of curves that overlap marginally those are found which chance moved together, and their shift is as far off as that
takes, always to the same side.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from viscofric.friction.shifting.pairs import CONTRADICTION

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.arrays import Array
    from viscofric.friction.shifting.placement import Pairs


#: Steps that the fit moves further from where a pair coincides are not that pair's, decades.
_NEAR = 0.2
#: From here on marginal overlap is told, variances.
WORTH_TELLING = 1.5


def widening(margin: float) -> float:
    """Return what the variance of a shift grows by as its overlap is known only from having been found.

    With D standard errors between the shift and the end where curves no longer overlap, found if D > 3, the true
    distance δ has the likelihood φ(D − δ)/Φ(δ − 3); with any δ ≥ 0 as likely as another, this is the mean of (D − δ)².
    """
    from scipy.special import log_ndtr

    threshold = math.sqrt(CONTRADICTION)
    true = np.linspace(0.0, margin + 6.0, 400)
    logarithm = -0.5 * (margin - true) ** 2 - log_ndtr(true - threshold)
    weight = np.exp(logarithm - logarithm.max())
    return max(1.0, float(np.sum(weight * (margin - true) ** 2) / np.sum(weight)))


def widenings(members: Sequence[int], values: Array, pairs: Pairs) -> Array:
    """Return the factor of the variance of each step between neighbouring members, (members − 1,).

    The clearest overlap of two members on either side of a step decides.
    """
    clearest = np.full(len(members) - 1, math.sqrt(CONTRADICTION))
    for one, colder in enumerate(members):
        for other in range(one + 1, len(members)):
            pair, step = pairs[colder, members[other]], float(values[one] - values[other])
            near = [
                margin
                for candidate, margin in zip(pair.candidates, pair.margins, strict=True)
                if abs(candidate - step) <= _NEAR
            ]
            if near:
                clearest[one:other] = np.maximum(clearest[one:other], max(near))
    return np.array([widening(margin) for margin in clearest.tolist()])


def widened(covariance: Array, factors: Array, at_reference: Array) -> Array:
    """Return the covariance (n, n) of shifts whose steps between neighbours have variances larger by factors (n − 1,).

    `at_reference` (n,) are the weights with which the shifts are zero together.
    """
    wider = covariance.copy()
    for step, factor in enumerate(factors.tolist()):
        pair = np.array([step, step + 1])
        variance = float(np.array([-1.0, 1.0]) @ covariance[np.ix_(pair, pair)] @ np.array([-1.0, 1.0]))
        moved = (np.arange(len(covariance)) > step).astype(float)
        moved -= at_reference @ moved
        wider += (factor - 1.0) * variance * np.outer(moved, moved)
    return wider
