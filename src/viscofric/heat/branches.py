"""States in which the heat of a contact and its temperature agree: the cold one, and the hot one if there are two."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import ConvergenceError

_MOST_SOLVES = 30
#: Steepest slope dG/dΔT that a step of Newton's counts with: nearer one, a state is about to vanish.
_STEEPEST = 0.9
#: Share of the rise that may be left; its effect on friction may be half of the accuracy.
LEFT = 0.01


class State(NamedTuple):
    """A stable state ΔT = G(ΔT), about which the rise changes with the slope dG/dΔT."""

    rise: float  # K
    slope: float
    hot: bool = False  # the interface in its hottest state, where it has several at this rise


def stable_states(rise: Array, produced: Array) -> list[State]:
    """Return the stable states of a curve G (n,) over rises ΔT (n,), ascending: those at which G falls below ΔT."""
    # A colder contact then produces more than it needs to stay as it is, and a warmer one less.
    excess = produced - rise
    found = []
    for i in np.flatnonzero((excess[:-1] > 0.0) & (excess[1:] <= 0.0)):
        part = excess[i] / (excess[i] - excess[i + 1])
        slope = (produced[i + 1] - produced[i]) / (rise[i + 1] - rise[i])
        found.append(State(float(rise[i] + part * (rise[i + 1] - rise[i])), float(slope)))
    return found


class HeatCurve(NamedTuple):
    """Rises (n,) from zero on, those that contacts at them produce, K, and the logarithms of their friction."""

    rise: Array
    produced: Array
    log_friction: Array

    @classmethod
    def of(cls, rise: Array, produced: Array, friction: Array) -> HeatCurve:
        """Return smooth curves through contacts (n,)."""
        from scipy.interpolate import PchipInterpolator

        columns = produced, np.log(np.maximum(np.abs(friction), 1e-300))
        if len(rise) == 1:
            return cls(rise, *columns)
        fine = np.linspace(0.0, 1.0, 2001) ** 2 * rise[-1]
        return cls(fine, *(np.asarray(PchipInterpolator(rise, column)(fine)) for column in columns))

    def states(self) -> list[State]:
        """Return the stable states, ascending."""
        # Spots of a rough surface may be colder than its mean, where the loss is released beside them.
        cold = [State(float(self.produced[0]), 0.0)] if self.produced[0] <= 0.0 else []
        return [*cold, *stable_states(self.rise, self.produced)]

    @property
    def limits(self) -> tuple[float, float]:
        """Between which rises its states lie, K."""
        return 0.0 if self.produced[0] > 0.0 else -math.inf, float(self.rise[-1])

    def tolerance(self, rise: float, accuracy: float) -> float:
        """Return the residual, K, that neither friction nor the rise itself feels."""
        return min(LEFT * abs(rise) + 1e-9, 0.5 * accuracy / max(self._felt(rise)[0], 1e-300))

    def felt(self, rise: float) -> float:
        """Return the relative change of friction per kelvin that the contact near a rise produces more, or less."""
        per_kelvin, slope = self._felt(rise)
        return per_kelvin / (1.0 - min(slope, _STEEPEST))

    def _felt(self, rise: float) -> tuple[float, float]:
        """Return the relative change of friction per kelvin near a rise, in size, and dG/dΔT."""
        if len(self.rise) == 1:
            return 0.0, 0.0
        row = int(np.clip(np.searchsorted(self.rise, rise), 1, len(self.rise) - 1))
        step, friction, produced = (
            float(one[row] - one[row - 1]) for one in (self.rise, self.log_friction, self.produced)
        )
        return abs(friction / step), produced / step


def outermost(cold: HeatCurve, hot: HeatCurve) -> list[State]:
    """Return the coldest and the hottest state, or both as one, of contacts with their interface cold and hot."""
    first, last = cold.states(), hot.states()
    if not first or not last:
        return first[:1]
    end = last[-1]
    return first[:1] if end == first[0] else [first[0], end._replace(hot=True)]


def settled(
    start: State,
    produced: Callable[[float], float],
    tolerance: Callable[[float], float],
    within: tuple[float, float] = (-math.inf, math.inf),
) -> tuple[float, float]:
    """Return a rise ΔT and G(ΔT) − ΔT, as `settling` does; `produced` solves the contact at ΔT."""
    steps = settling(start, tolerance, within)
    rise = next(steps)
    while True:
        try:
            rise = steps.send(produced(rise))
        except StopIteration as end:
            found: tuple[float, float] = end.value
            return found


def settling(
    start: State, tolerance: Callable[[float], float], within: tuple[float, float] = (-math.inf, math.inf)
) -> Generator[float, float, tuple[float, float]]:
    """Find a rise ΔT and G(ΔT) − ΔT, no larger than the tolerance at it, by secants between two bounds."""
    # Yields rises ΔT, and takes G at each. Once a colder contact that produces too much and a warmer one that produces
    # too little are known, steps stay between them, and halve what two secants do not. A G that jumps past ΔT, as
    # points of a contact come and go, has its state where both are no farther apart than the tolerance.
    rise, slope, _ = start
    before: tuple[float, float] | None = None
    low = high = None
    widths = [math.inf, math.inf]
    for _ in range(_MOST_SOLVES):
        found = yield rise
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
