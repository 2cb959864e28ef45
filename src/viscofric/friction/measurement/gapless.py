"""What to do about readings without gaps between their nominal values: tolerances to give, readings to leave out."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.nominal import LONGEST_CHAIN

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from viscofric.traction import TractionRuns

    Array: TypeAlias = NDArray[np.float64]

_NAMED = 8  # steps that a sentence names at most


@dataclass(frozen=True, eq=False)
class Gapless:
    """The sentence that refuses readings without gaps.

    Attributes
    ----------
    runs : TractionRuns
    values : (n,) array
        What is grouped, of each of the runs' readings.
    expression : str
        How a user writes them.
    shown : callable
        Puts a range of them into words.
    gap : float
        That parts nominal values, absolute or relative.
    relative : bool
    option : str
        Name of the tolerance; empty where it is fixed.
    unit : str
        Of the tolerance.
    """

    runs: TractionRuns
    values: Array
    expression: str
    shown: Callable[[float, float], str]
    gap: float
    relative: bool = True
    option: str = ""
    unit: str = ""

    def __call__(self, low: float, high: float) -> str:
        """Say what has no gap from `low` to `high`, and what to do."""
        told = f"{self.shown(low, high)} has no gap that would tell nominal values from scatter"
        if not self.option:
            return f"{told} (a gap is {100 * self.gap:g} %); {self._selection(low, high)}."
        wide = (math.log(high / low) if self.relative else high - low) / LONGEST_CHAIN
        # Rounded up to two digits.
        wide = float(f"{1.05 * wide:.1e}")
        one = f"if they are of one nominal value, give {self.option} = {wide:g}{self.unit}"
        return f"{told}: {one}; if of several, one below {self.gap:g}{self.unit}; or {self._selection(low, high)}."

    def _selection(self, low: float, high: float) -> str:
        """Say what to select: all but the steps that are not steady, or what is near the median."""
        inside = (self.values >= low) & (self.values <= high)
        allowed = self.gap * (high if self.relative else 1.0)
        if self.runs.step is not None:
            steps = np.unique(self.runs.step[inside]).tolist()
            spans = [np.ptp(self.values[inside & (self.runs.step == step)]) for step in steps]
            moving = [step for step, span in zip(steps, spans, strict=True) if span > allowed]
            if moving and len(moving) <= _NAMED and len(moving) < np.unique(self.runs.step).size:
                words = f"step {moving[0]} is" if len(moving) == 1 else f"steps {', '.join(map(str, moving))} are"
                shell = f"--except-steps {','.join(map(str, moving))}"
                way = f"runs.select(except_steps={moving}) ({shell} in the shell)"
                return f"{words} not steady; leave out what is not, by {way}"
        middle = float(np.median(self.values[inside]))
        return (
            "leave out what was not steady, such as by "
            f"runs.select(abs({self.expression} - {middle:.4g}) < {allowed:.2g})"
        )
