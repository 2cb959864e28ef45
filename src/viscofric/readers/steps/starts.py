"""The first points of a step test, which show the instrument: ringing of its inertia, and the rise of the step.

After a step of stress no linear material has a compliance that falls, or that grows faster than time (J(t) is concave:
J. D. Ferry, Viscoelastic Properties of Polymers, 1980, ch. 3); after a step of strain none has a modulus that rises.
What breaks this at the beginning by more than noise is the instrument: the inertia of its drive oscillates with the
sample's stiffness (creep ringing: C. Baravian, D. Quemada, Rheol. Acta 37 (1998) 223, doi:10.1007/s003970050110), or
stress or strain still rise.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.step_tests import StepKind


#: A response breaks a rule by more than this, which single readings differ by …
LEAST = 0.01  # decades
#: … and by so many times the scatter of its points.
SIGMAS = 8.0
#: Ringing is left out to so many times the last time at which it shows; by then it has fallen to a part of `LEAST`.
AFTER_RINGING = 1.5
#: A rise, to so many times its duration: a ramp of that duration is then off by a twentieth of the slope at most.
AFTER_RISE = 10.0
#: Ringing begins in this part of the test, in log time, and breaks the rule again within this factor of time.
BEGINNING = 0.5
AGAIN = 2.0


@dataclass(frozen=True)
class Start:
    """Where the response of the material begins: the first usable point, why, and when a rule is broken after it."""

    first: int = 0
    reason: str = ""  # "ringing", "rise" or ""
    broken_at: float | None = None  # s


def start_of(time: Array, response: Array, kind: StepKind) -> Start:
    """Return where the response of the material begins; `time` (n,) ascends, in s."""
    log_time, log = np.log10(time), np.log10(response)
    threshold = max(LEAST, SIGMAS * _scatter(log))
    # A step that still rises: what should fall from the first point on, E(t) or J(t)/t, rises to a maximum.
    falling = log if kind == "relaxation" else log - log_time
    peak = int(np.argmax(falling))
    risen = time[peak] if falling[peak] - falling[0] > threshold else 0.0
    turns = _turned(time, -log if kind == "relaxation" else log)
    broken = np.flatnonzero((turns > threshold) & (time > AGAIN * risen))
    ringing = 0.0
    for place in broken if kind == "creep" else []:
        begins = log_time[place] < log_time[0] + BEGINNING * (log_time[-1] - log_time[0])
        if not (begins if ringing == 0.0 else time[place] <= AGAIN * ringing):
            break
        ringing = time[place]
    after = broken[time[broken] > ringing]
    late = float(time[after[0]]) if len(after) else None
    if not max(ringing, risen):
        return Start(broken_at=late)
    reach = AFTER_RINGING * ringing if ringing else AFTER_RISE * risen
    return Start(int(np.searchsorted(time, reach)), "ringing" if ringing else "rise", late)


def _turned(time: Array, log: Array) -> Array:
    """Return how far values lie below the largest one since `AGAIN` times less time."""
    since = np.searchsorted(time, time / AGAIN)
    return np.array([log[first : place + 1].max() - log[place] for place, first in enumerate(since)])


def _scatter(log: Array) -> float:
    """Return the scatter of points about a smooth curve from the median of their second differences."""
    if len(log) < 5:
        return 0.0
    return float(1.4826 * np.median(np.abs(np.diff(log, 2))) / np.sqrt(6.0))
