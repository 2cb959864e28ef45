"""The march through a schedule by adaptive steps, the same for all contacts, with its error estimates.

Two chains of states go side by side: one by the steps, one by their halves, each from its own states.  Steps are exact
for pressures that are linear in between, which leaves errors of second order: that of the second chain is about a
third of the difference of the two, at every time and with all that has accumulated.  A step is taken if it changes
this difference by little; if it exceeds the accuracy all the same, the march begins again with smaller steps.

The work of load and friction is added up by the trapezoidal rule on both chains, and extrapolated; that of a jump, in
which nothing is dissipated, is the change of the stored energy.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Generic, NamedTuple

import numpy as np

from viscofric.errors import ConvergenceError
from viscofric.motion.mover import Field, Mover, Observation, Scales, State

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from viscofric.arrays import Array
    from viscofric.motion.schedule import Instant, Schedule

#: First share of the accuracy that one step may add to the difference of the chains.
_SHARE = 0.1
_MOST_MARCHES = 6
#: Changes of the step from one to the next; order 3 of the local error.
_SHRINK, _GROW, _SAFETY = 0.1, 3.0, 0.85
#: First step of an interval, and the least one, as parts of the interval.
_FIRST, _LEAST = 1.0 / 32.0, 1e-10


class Errors(NamedTuple):
    """Estimated errors at one time, absolute."""

    load: float
    depth: float
    friction: float
    energy: float


@dataclass(frozen=True, eq=False)
class Moment(Generic[State]):
    """One returned time: what was seen, the work so far, and the estimated errors."""

    instant: Instant
    seen: Observation
    work: float
    errors: Errors
    field: Field | None


@dataclass(frozen=True, eq=False)
class Track(Generic[State]):
    """What a march has found.

    Attributes
    ----------
    moments : list of Moment
    steps : int
        Steps taken (of the coarse chain, those of the last march), and those rejected.
    interrupted : bool
        Whether the march was interrupted before the end.
    final : _Pair
        States of both chains at the last time, from which another march may continue.
    """

    moments: list[Moment[State]]
    steps: int
    rejected: int
    interrupted: bool
    final: _Pair[State]


class _Link(NamedTuple, Generic[State]):
    """A state of one chain with what is seen of it, and the work so far."""

    state: State
    seen: Observation
    work: float


class _Pair(NamedTuple, Generic[State]):
    """Both chains at one time."""

    coarse: _Link[State]
    fine: _Link[State]


class _TooLargeError(Exception):
    """The difference of the chains has exceeded the accuracy."""

    def __init__(self, ratio: float) -> None:
        self.ratio = ratio


def march(
    mover: Mover[State],
    schedule: Schedule,
    *,
    accuracy: float,
    times: Sequence[float] | None = None,
    fields: bool = True,
    progress: Callable[[float, float], object] | None = None,
    begin: _Pair[State] | None = None,
) -> Track[State]:
    """March through a schedule.

    Parameters
    ----------
    mover : Mover
    schedule : Schedule
    accuracy : float
        Largest error of friction, depth, load and energy, relative to the largest values so far.
    times : sequence of float, optional
        To return, ascending, s; one given twice at a jump: before and after it.  All steps, without.
    fields : bool
        Whether to keep the pressures of the returned times.
    progress : callable, optional
        Called with the time reached and the last time, s.
    begin : optional
        `Track.final` of the march to continue.

    Raises
    ------
    ConvergenceError
        If the accuracy is not reached.
    """
    share = _SHARE
    for _ in range(_MOST_MARCHES):
        one = _March(mover, schedule, accuracy, share, times, fields, progress)
        try:
            return one.run(begin)
        except _TooLargeError as error:
            share *= max(0.05, 0.5 * error.ratio**-1.5)
    raise ConvergenceError(
        f"the accuracy {accuracy:g} was not reached with steps that each add {share:.2g} of it; ask for less.",
        code="steps-not-converged",
    )


@dataclass(eq=False)
class _March(Generic[State]):
    mover: Mover[State]
    schedule: Schedule
    accuracy: float
    share: float
    times: Sequence[float] | None
    fields: bool
    progress: Callable[[float, float], object] | None
    moments: list[Moment[State]] = field(default_factory=list)
    taken: int = 0
    rejected: int = 0

    def run(self, begin: _Pair[State] | None) -> Track[State]:
        mover, schedule = self.mover, self.schedule
        self._scales = mover.scales
        if begin is None:
            state = mover.begin()
            link = _Link(state, mover.observe(state), 0.0)
            pair = _Pair(link, link)
            if schedule.before == "untouched":
                first = schedule.at(schedule.start, after=False)
                pair = self._jump(pair, first, first)
        else:
            pair = begin
        pair = self._stop_at_kink(pair, schedule.start)
        interrupted = False
        try:
            for start, end in itertools.pairwise(schedule.kinks):
                for left, right in self._parts(float(start), float(end)):
                    pair = self._interval(pair, left, right)
                    if right < end:
                        self._record(pair, schedule.at(right), asked=self.times is not None)
                pair = self._stop_at_kink(pair, float(end))
        except KeyboardInterrupt:
            interrupted = True
        return Track(self.moments, self.taken, self.rejected, interrupted, pair)

    def _parts(self, start: float, end: float) -> list[tuple[float, float]]:
        """Return the parts of an interval between the times asked for."""
        stops = sorted({time for time in self.times or () if start < time < end})
        edges = [start, *stops, end]
        return list(itertools.pairwise(edges))

    def _stop_at_kink(self, pair: _Pair[State], time: float) -> _Pair[State]:
        """Record the state at a kink, take its jump if there is one, and record that too."""
        schedule = self.schedule
        wanted = 0 if self.times is None else sum(1 for one in self.times if one == time)
        jumps = schedule.jumps_at(time)
        before = schedule.at(time, after=False)
        if not jumps:
            self._record(pair, before, asked=wanted > 0, times=max(wanted, 1))
            return pair
        if wanted != 1:
            self._record(pair, before, asked=wanted > 1)
        after = schedule.at(time)
        if after[3:] != before[3:]:
            pair = self._jump(pair, before, after)
        self._record(pair, after, asked=wanted > 0)
        return pair

    def _jump(self, pair: _Pair[State], before: Instant, after: Instant) -> _Pair[State]:
        """Take a jump on both chains: the response is elastic, and its work is stored."""
        links = []
        for link in pair:
            state = self.mover.step(link.state, before, after)
            seen = self.mover.observe(state)
            self.mover.accept(state, after)
            links.append(_Link(state, seen, link.work + seen.stored - link.seen.stored))
        return self._seen(_Pair(*links))

    def _interval(self, pair: _Pair[State], start: float, end: float) -> _Pair[State]:
        """March through a part without kinks."""
        ticks = self.mover.ticks(self.schedule.at(start), self.schedule.at(end, after=False))
        if ticks is None:
            return self._freely(pair, start, end)
        return self._by_ticks(pair, start, np.asarray(ticks))

    def _freely(self, pair: _Pair[State], start: float, end: float) -> _Pair[State]:
        time, step = start, _FIRST * (end - start)
        while time < end:
            # no splinter at the end
            left = end - time
            step = left if step >= left else min(step, 0.5 * left)
            reached = end if step == left else time + step
            tried = self._try(pair, [time, 0.5 * (time + reached), reached])
            ratio = self._ratio(pair, tried)
            if ratio > 1.0 and step > _LEAST * (end - start):
                self.rejected += 1
                step *= max(_SHRINK, _SAFETY * ratio ** (-1.0 / 3.0))
                continue
            pair = self._take(tried, reached, end)
            time = reached
            step *= min(_GROW, _SAFETY * max(ratio, 1e-6) ** (-1.0 / 3.0))
        return pair

    def _by_ticks(self, pair: _Pair[State], start: float, ticks: Array) -> _Pair[State]:
        """March by whole ticks: two or more for the coarse chain, half as many for the fine one."""
        edges = np.concatenate([[start], ticks])
        place, count = 0, 2
        while place < len(ticks):
            count = min(count, len(ticks) - place)
            count -= count % 2 if count > 1 else 0
            middle = [float(edges[place + count // 2])] if count > 1 else []
            tried = self._try(pair, [float(edges[place]), *middle, float(edges[place + count])])
            ratio = self._ratio(pair, tried)
            if ratio > 1.0 and count > 2:
                self.rejected += 1
                count = max(2, 2 * int(0.5 * count * max(_SHRINK, _SAFETY * ratio ** (-1.0 / 3.0))))
                continue
            place += count
            pair = self._take(tried, float(edges[place]), float(ticks[-1]))
            grown = count * min(_GROW, _SAFETY * max(ratio, 1e-6) ** (-1.0 / 3.0))
            count = max(2, 2 * int(0.5 * grown))
        return pair

    def _try(self, pair: _Pair[State], times: list[float]) -> _Pair[State]:
        """Step from the first time to the last: the coarse chain at once, the fine one by those in between too."""
        last = self.schedule.end
        instants = [self.schedule.at(time, after=place == 0 and time < last) for place, time in enumerate(times)]
        fine = pair.fine
        for start, end in itertools.pairwise(instants):
            fine = self._step(fine, start, end)
        return _Pair(self._step(pair.coarse, instants[0], instants[-1]), fine)

    def _step(self, link: _Link[State], start: Instant, end: Instant) -> _Link[State]:
        state = self.mover.step(link.state, start, end)
        seen, before = self.mover.observe(state), link.seen
        work = 0.5 * (seen.load + before.load) * (seen.depth - before.depth)
        for axis in (0, 1):
            force = 0.5 * (seen.friction_force[axis] + before.friction_force[axis])
            work += force * float(end.position[axis] - start.position[axis])
        return _Link(state, seen, link.work + work)

    def _ratio(self, pair: _Pair[State], tried: _Pair[State]) -> float:
        """Return by how much a step adds to the difference of the chains, over what it may add."""
        before, after = _difference(pair), _difference(tried)
        scales = self._with(tried)
        added = max(abs(two - one) / scale for one, two, scale in zip(before, after, scales, strict=True))
        return added / (self.share * self.accuracy)

    def _take(self, tried: _Pair[State], reached: float, end: float) -> _Pair[State]:
        self.taken += 1
        self.mover.accept(tried.fine.state, self.schedule.at(reached, after=False))
        pair = self._seen(tried)
        worst = max(abs(one) / scale for one, scale in zip(_difference(pair), self._scales, strict=True)) / 3.0
        if worst > self.accuracy:
            raise _TooLargeError(worst / self.accuracy)
        if self.times is None and reached < end:
            self._record(pair, self.schedule.at(reached), asked=True)
        if self.progress is not None:
            self.progress(reached, self.schedule.end)
        return pair

    def _with(self, pair: _Pair[State]) -> Scales:
        """Return the scales with the values of a state."""
        seen, old = pair.fine.seen, self._scales
        return Scales(
            max(old.load, abs(seen.load)),
            max(old.depth, abs(seen.depth)),
            max(old.friction, math.hypot(*seen.friction_force)),
            max(old.energy, abs(pair.fine.work), seen.stored, seen.dissipated),
        )

    def _seen(self, pair: _Pair[State]) -> _Pair[State]:
        self._scales = self._with(pair)
        return pair

    def _record(self, pair: _Pair[State], instant: Instant, *, asked: bool, times: int = 1) -> None:
        if not asked and self.times is not None:
            return
        coarse, fine = pair
        errors = Errors(*(abs(one) / 3.0 for one in _difference(pair)))
        # What is added up over all steps is smooth enough to be extrapolated.
        stored, dissipated, work = (
            two + (two - one) / 3.0
            for one, two in (
                (coarse.seen.stored, fine.seen.stored),
                (coarse.seen.dissipated, fine.seen.dissipated),
                (coarse.work, fine.work),
            )
        )
        seen = fine.seen._replace(stored=stored, dissipated=dissipated)
        held = self.mover.pressure(fine.state) if self.fields else None
        self.moments += times * [Moment(instant, seen, work, errors, held)]


def _difference(pair: _Pair[State]) -> tuple[float, float, float, float]:
    """Return fine less coarse: load, depth, friction (as long as the vector), and energy (work or dissipation)."""
    coarse, fine = pair.coarse.seen, pair.fine.seen
    along, across = (two - one for one, two in zip(coarse.friction_force, fine.friction_force, strict=True))
    friction = math.copysign(math.hypot(along, across), along if abs(along) >= abs(across) else across)
    energies = (pair.fine.work - pair.coarse.work, fine.dissipated - coarse.dissipated)
    return fine.load - coarse.load, fine.depth - coarse.depth, friction, max(energies, key=abs)
