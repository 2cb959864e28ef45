"""Whether shift factors bring neighbouring isotherms as close as they can come, each pair shifted for itself.

Shift factors that are given may all be wrong alike.  Then no pair of neighbours stands out, and no plot without the
frequency shows it (`van_gurp_palmen`): only what other shifts would leave tells.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from viscofric.rheology.superposition.overlap import SMALLEST_FAILURE, join, join_at

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.arrays import Array
    from viscofric.rheology.superposition.overlap import LogSweep


#: Neighbours that miss each other by so many times what shifts of their own leave were not shifted by right factors.
#: Factors fitted to real sweeps (an acrylic, an adhesive, a foam, an EVA that melts) come to 1.0 to 1.2, WLF laws
#: fitted to such factors to 1.2 to 1.9 (of the foam, which follows none, to 3.6); the factors themselves, with log10 α
#: too large by 40 %, to 2.1 to 7.8.
BADLY = 2.0


@dataclass(frozen=True)
class OwnShifts:
    """How far neighbours lie apart as they are shifted, and how close they come when each pair has its own shift.

    Parameters
    ----------
    misfit : float
        Joint rms misfit of log10 E' and log10 E'', root mean square over the pairs that overlap as they are shifted;
        decades.  Zero where none does.
    attainable : float
        The same with each of these pairs slid to where it overlaps best.
    """

    misfit: float
    attainable: float

    @property
    def wrong(self) -> bool:
        """Whether other shift factors would join the isotherms clearly better."""
        return self.misfit > max(BADLY * self.attainable, SMALLEST_FAILURE)

    @property
    def clause(self) -> str:
        """What is found, as part of a sentence."""
        return (
            f"shifted by them neighbouring sweeps miss each other by {self.misfit:.2g} decades (rms) where they "
            f"overlap, and each pair shifted for itself by {self.attainable:.2g}"
        )


def own_shifts(sweeps: Sequence[LogSweep], log10_shifts: Array) -> OwnShifts:
    """Compare the overlap of shifted isotherms with that which pairs reach for themselves.

    Parameters
    ----------
    sweeps : sequence of LogSweep
        Neighbours in temperature next to each other, without vertical shifts.
    log10_shifts : (n,) array
        log10 α.
    """
    shifted, best = [], []
    for place, (colder, warmer) in enumerate(pairwise(sweeps)):
        there = join_at(colder, warmer, float(log10_shifts[place] - log10_shifts[place + 1]))
        own = join(colder, warmer)
        if np.isfinite(there.uncertainty) and np.isfinite(own.misfit):
            shifted.append(there.misfit)
            best.append(min(own.misfit, there.misfit))  # the steps that `join` tries are coarse
    if not shifted:
        return OwnShifts(0.0, 0.0)
    return OwnShifts(*(float(np.sqrt(np.mean(np.square(one)))) for one in (shifted, best)))
