"""Advice on readings without gaps between nominal values: tolerances to set, readings to leave out."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from viscofric.nominal import LONGEST_CHAIN
from viscofric.notes import Note, Remedy, setting

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.arrays import Array
    from viscofric.traction import TractionRuns


#: Field and label of the gap between nominal speeds, see `viscofric.notes.setting`.
SPEED_TOLERANCE = ("measurement.speed_tolerance", "Gap between speeds")
_NAMED = 8  # steps that a sentence names at most


@dataclass(frozen=True, eq=False)
class Gapless:
    """Note on readings without gaps."""

    runs: TractionRuns
    values: Array  # (n,), of each reading, to be grouped
    expression: str  # their name in Python
    shown: Callable[[float, float], str]  # returns a range of them in words
    gap: float  # between nominal values, absolute or relative
    relative: bool = True
    # field and label of the tolerance, see `viscofric.notes.setting`; empty where it is fixed
    option: tuple[str, str] | tuple[()] = ()
    unit: str = ""  # of the tolerance

    def __call__(self, low: float, high: float) -> Note:
        """Return a note on values without a gap from `low` to `high`, with a remedy."""
        words = f"{self.shown(low, high)} has no gaps and cannot be grouped into nominal values"
        if not self.option:
            words += f" (a gap is {100 * self.gap:g} %); "
            return Note("no-gap", words, remedy=self._selection(low, high) + ".")
        wide = (math.log(high / low) if self.relative else high - low) / LONGEST_CHAIN
        # Rounded up to two digits.
        wide = float(f"{1.05 * wide:.1e}")
        one = setting(*self.option, f"{wide:g}{self.unit}")
        several = f"; if there are several, one below {self.gap:g}{self.unit}; or "
        remedy = ": if there is one nominal value, give " + one + several + self._selection(low, high) + "."
        return Note("no-gap", words, remedy=remedy)

    def _selection(self, low: float, high: float) -> Remedy:
        """Return the selection to make: all steps except unsteady ones, or values near the median."""
        inside = (self.values >= low) & (self.values <= high)
        allowed = self.gap * (high if self.relative else 1.0)
        if self.runs.step is not None:
            steps = np.unique(self.runs.step[inside]).tolist()
            spans = [np.ptp(self.values[inside & (self.runs.step == step)]) for step in steps]
            moving = [step for step, span in zip(steps, spans, strict=True) if span > allowed]
            if moving and len(moving) <= _NAMED and len(moving) < np.unique(self.runs.step).size:
                words = f"step {moving[0]} is" if len(moving) == 1 else f"steps {', '.join(map(str, moving))} are"
                listed = ",".join(map(str, moving))
                return f"{words} not steady; leave such steps out, by " + Remedy(
                    f"runs.select(except_steps={moving})",
                    f"--except-steps {listed}",
                    f"except_steps = {moving} under [measurement]",
                    f"“Steps to leave out”: {listed.replace(',', ', ')}",
                    "measurement.except_steps",
                )
        middle = float(np.median(self.values[inside]))
        return "leave out unsteady readings" + Remedy(
            f", such as by runs.select(abs({self.expression} - {middle:.4g}) < {allowed:.2g})",
            " (--except-steps)",
            " (except_steps under [measurement])",
            " by “Steps to leave out”",
            "measurement.except_steps",
        )
