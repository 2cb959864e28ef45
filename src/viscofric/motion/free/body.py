"""The viscoelastic body in units of the elastic contact at E0: compliances over the relaxed one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array
from viscofric.motion.memory import Modes, StepCoefficients, quickest_time, step_coefficients


@dataclass(frozen=True, eq=False)
class Body:
    """Modes of the body and the compliance of the indenter."""

    instant: float  # compliance that follows at once
    compliances: Array  # (m,)
    times: Array  # (m,) retardation times, s
    counterface: float  # of an elastic indenter
    at_once: float = 0.0  # part of the first that is of merged modes: in a jump they lag behind
    merged: float = 0.0  # error of the compliance by merged modes, relative to it

    @classmethod
    def of(cls, modes: Modes, plane_strain: float, counterface: float) -> Body:
        """Return modes (1/Pa) in these units; `counterface` (1/Pa) is the indenter's compliance."""
        unit = plane_strain * modes.relaxed + counterface
        scale = plane_strain / unit
        at_once = scale * modes.at_once
        instant, counterface = scale * modes.instantaneous, counterface / unit
        return cls(instant, scale * modes.C, modes.tau.copy(), counterface, at_once, modes.error)

    @property
    def quickest(self) -> float:
        """Time in which the response to a jump changes noticeably, s."""
        return quickest_time(self.instant + self.counterface, self.compliances, self.times)

    def over(self, duration: float) -> StepCoefficients:
        """Return the coefficients of a step of so many seconds of the clock."""
        if duration == 0.0:
            none = np.zeros(len(self.times))
            return StepCoefficients(none + 1.0, none, none)
        return step_coefficients(duration / self.times)

    def compliance(self, coefficients: StepCoefficients) -> float:
        """Return the body's compliance for the pressure at the end of a step."""
        return self.instant + float(self.compliances @ coefficients.end)
