"""Plateaus at the ends of a measurement: which isotherms tell no shift, and where the trend puts them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.rheology.superposition.gauge import Gauge

    Array = NDArray[np.float64]

#: An isotherm tells a shift if the squared slope of the curves is so many times what noise makes of it.  Noise alone
#: gives 0.3 to 9, sweeps that tell a step to 0.1 decades 20 and more.
CLEAR = 15.0
#: The trend is taken from so many of the last steps that are told.
TREND_STEPS = 2
#: Beyond, the rate of change with 1/T may change by so much from step to step; WLF laws change by less.
BEND = 0.2  # decades per typical step


def told(signal: Array, gauge: Gauge) -> tuple[int, int] | None:
    """Say which isotherms to fit: from the first to before the last.

    Parameters
    ----------
    signal : (n,) array
        Squared slope of the curves at each isotherm, in units of its noise.
    gauge : Gauge
        What is held.

    Returns
    -------
    tuple of int, or None
        None where all are to be fitted: none at the ends is a plateau, hardly any is not, vertical shifts are
        sought, or a factor is fixed whose plateau, or whose reference, would be left out.
    """
    clear = np.flatnonzero(signal > CLEAR)
    if gauge.free_vertical or len(clear) <= TREND_STEPS:
        return None
    first, last = int(clear[0]), int(clear[-1]) + 1
    inside = set(range(first, last))
    needed = {*gauge.held, *(int(place) for place in np.flatnonzero(gauge.weights))} if gauge.held else set()
    if (first, last) == (0, len(signal)) or last - first <= TREND_STEPS or not needed <= inside:
        return None
    return first, last


def continued(values: Array, covariance: Array, gauge: Gauge, first: int, last: int) -> tuple[Array, Array]:
    """Continue shifts over the plateaus at both ends, straight in 1/T, with an uncertainty that grows.

    Parameters
    ----------
    values, covariance : (m,) and (m, m) array
        log10 α from the first to before the last isotherm.
    gauge : Gauge
        Of all isotherms.
    first, last : int
        Which ones were fitted.

    Returns
    -------
    values, covariance
        Of all isotherms, zero at the reference.  From step to step the rate of change with 1/T may change by `BEND`.
    """
    inverse = gauge.inverse_temperatures
    size = len(inverse)
    onto = np.zeros((size, last - first))
    onto[first:last] = np.eye(last - first)
    spread = np.zeros((size, size))
    typical = float(np.median(np.abs(np.diff(inverse))))
    for end, before, places in (
        (last - 1, last - 1 - TREND_STEPS, np.arange(last, size)),
        (first, first + TREND_STEPS, np.arange(first - 1, -1, -1)),
    ):
        if not len(places):
            continue
        further = (inverse[places] - inverse[end]) / (inverse[end] - inverse[before])
        onto[places, end - first] = 1.0 + further
        onto[places, before - first] = -further
        reached = np.abs(inverse[places] - inverse[end]) / typical
        start = np.concatenate([[0.0], reached[:-1]])
        walk = BEND * np.maximum(reached[:, None] - start, 0.0)
        spread[np.ix_(places, places)] = walk @ walk.T
    full, spread = onto @ values, spread + onto @ covariance @ onto.T
    change = np.eye(size) - gauge.weights
    return change @ full, change @ spread @ change.T
