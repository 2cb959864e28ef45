"""Student's intervals of friction, and whether the sign configurations of a test agree within theirs."""

from __future__ import annotations

import numpy as np

from viscofric.arrays import Array
from viscofric.checks import Check

#: Share of consistent points outside their 95 % interval.
OUTSIDE = 0.05
#: Probability below which that many points outside are not chance.
CHANCE = 0.01
#: Wider intervals, of much less than one degree of freedom, say nothing, however small the standard error.
WIDEST = 1e6  # standard errors


def threshold(freedom: float, chance: float) -> float:
    """Return the number of standard errors that a deviation of either sign exceeds with a probability `chance`."""
    from scipy.special import ndtri, stdtrit

    if freedom <= 0.0:
        return np.inf
    return float(stdtrit(freedom, 1.0 - 0.5 * chance) if np.isfinite(freedom) else -ndtri(0.5 * chance))


def half_widths(error: Array, freedom: Array | None, level: float) -> Array:
    """Return the half-widths (n,) of confidence intervals; normal where `freedom` is unknown."""
    from scipy.special import ndtri, stdtrit

    above = 0.5 + 0.5 * level
    widths = np.full(error.shape, float(ndtri(above)))
    if freedom is not None:
        student = np.isfinite(freedom) & (freedom > 0.0)
        widths[student] = stdtrit(freedom[student], above)
    widths[widths > WIDEST] = np.inf
    return np.asarray(np.multiply(widths, error, out=np.zeros(error.shape), where=error > 0.0))


def consistency_check(left_over: Array, error: Array, freedom: Array | None) -> Check | None:
    """Return whether the four sign configurations of a traction test agree; None where no error is known."""
    # `left_over` (n,) is the combination of them that should vanish, relative to the load; `error` (n,) its standard
    # error with `freedom` (n,) degrees of freedom, normal where unknown. It holds if no more points than by chance lie
    # outside their 95 % interval; its value is the largest residual.
    from scipy.special import bdtrc

    known = np.isfinite(left_over) & np.isfinite(error)
    count = int(known.sum())
    if not count:
        return None
    limit = half_widths(error, freedom, 1.0 - OUTSIDE)
    outside = int(np.sum(np.abs(left_over[known]) > limit[known]))
    largest = float(np.max(np.abs(left_over[known])))
    holds = outside == 0 or float(bdtrc(outside - 1, count, OUTSIDE)) >= CHANCE
    words = f"within its 95 % interval at {count - outside} of {count} points; {largest:.2g} of the load at most"
    return Check.of("consistency", holds, words, largest)
