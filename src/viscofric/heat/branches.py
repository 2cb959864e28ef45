"""States in which the heat of a contact and its temperature agree: the cold one, and the hot one if there are two."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.errors import ConvergenceError

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.arrays import Array


_MOST_SOLVES = 30
#: Steepest slope dG/dΔT that a step of Newton's counts with: nearer one, a state is about to vanish.
_STEEPEST = 0.9


class State(NamedTuple):
    """A stable state ΔT = G(ΔT), about which the rise changes with the slope dG/dΔT."""

    rise: float  # K
    slope: float
    hot: bool = False  # the interface in its hottest state, where it has several at this rise


def stable_states(rise: Array, produced: Array) -> list[State]:
    """Return the stable states of a curve G (n,) over rises ΔT (n,), ascending: those at which G falls below ΔT.

    A colder contact then produces more than it needs to stay as it is, and a warmer one less.
    """
    excess = produced - rise
    found = []
    for i in np.flatnonzero((excess[:-1] > 0.0) & (excess[1:] <= 0.0)):
        part = excess[i] / (excess[i] - excess[i + 1])
        slope = (produced[i + 1] - produced[i]) / (rise[i + 1] - rise[i])
        found.append(State(float(rise[i] + part * (rise[i + 1] - rise[i])), float(slope)))
    return found


def settled(
    start: State,
    produced: Callable[[float], float],
    tolerance: Callable[[float], float],
    within: tuple[float, float] = (-math.inf, math.inf),
) -> tuple[float, float]:
    """Return a rise ΔT and G(ΔT) − ΔT, no larger than the tolerance at it, from a state, by secants between two bounds.

    `produced` solves the contact at ΔT.  Once a colder contact that produces too much and a warmer one that produces
    too little are known, steps stay between them, and halve what two secants do not.  A G that jumps past ΔT, as points
    of a contact come and go, has its state where both are no farther apart than the tolerance.  Raises ConvergenceError
    if the solves do not settle.
    """
    rise, slope, _ = start
    before: tuple[float, float] | None = None
    low = high = None
    widths = [math.inf, math.inf]
    for _ in range(_MOST_SOLVES):
        found = produced(rise)
        excess, allowed = found - rise, tolerance(rise)
        if abs(excess) <= allowed:
            return rise, excess
        if excess > 0.0:
            low, high = rise, high if high is not None and high > rise else None
        else:
            low, high = low if low is not None and low < rise else None, rise
        if before is not None and rise != before[0]:
            slope = (found - before[1]) / (rise - before[0])
        before = rise, found
        step = min(max(rise + excess / (1.0 - min(slope, _STEEPEST)), within[0]), within[1])
        if low is not None and high is not None:
            if high - low <= allowed:
                return rise, excess
            if not low < step < high or high - low > 0.5 * widths[-2]:
                step = 0.5 * (low + high)
            widths.append(high - low)
        elif step == rise:
            break  # at a bound, beyond which nothing is known
        rise = step
    raise ConvergenceError(
        f"The temperature of the contact did not settle: at a rise of {rise:.3g} K, it still changes by "
        f"{abs(excess):.2g} K.",
        code="not-converged",
    )
