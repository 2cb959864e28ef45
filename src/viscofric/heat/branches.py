"""States in which the heat of a contact and its temperature agree: the cold one, and the hot one if there are two."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.errors import ConvergenceError

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.arrays import Array


_MOST_SOLVES = 12
#: Steepest slope dG/dΔT that a step of Newton's counts with: nearer one, a state is about to vanish.
_STEEPEST = 0.9


class State(NamedTuple):
    """A stable state ΔT = G(ΔT), about which the rise changes with the slope dG/dΔT."""

    rise: float  # K
    slope: float


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
    start: State, produced: Callable[[float], float], tolerance: Callable[[float], float]
) -> tuple[float, float]:
    """Return a rise ΔT and G(ΔT) − ΔT, no larger than the tolerance at it, by secants from a state.

    `produced` solves the contact at ΔT.  Raises ConvergenceError if the solves do not settle.
    """
    rise, slope = start
    before: tuple[float, float] | None = None
    for _ in range(_MOST_SOLVES):
        found = produced(rise)
        excess = found - rise
        if abs(excess) <= tolerance(rise):
            return rise, excess
        if before is not None and rise != before[0]:
            slope = (found - before[1]) / (rise - before[0])
        before = rise, found
        rise = max(rise + excess / (1.0 - min(slope, _STEEPEST)), 0.0)
    raise ConvergenceError(
        f"The temperature of the contact did not settle after {_MOST_SOLVES} solves: it still changes by "
        f"{abs(excess):.2g} K.",
        code="not-converged",
    )
