"""The march through a schedule by adaptive steps, the same for all contacts, with its error estimates.

Two chains of states are computed in parallel: one with the steps, one with half steps, each from its own states.
Steps are exact for pressures that are linear within a step, so errors are of second order.  The accumulated error of
the second chain is about a third of the difference between the two, at every time.  A step is accepted if it changes
this difference by little.  If the difference still exceeds the accuracy, the march restarts with smaller steps.

The work of load and friction is summed by the trapezoidal rule on both chains, and extrapolated.  The work of a jump,
which dissipates nothing, is the change of the stored energy.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Generic

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import ConvergenceError
from viscofric.motion.chains import (
    SAME,
    Difference,
    Link,
    Moment,
    Pair,
    Reached,
    Track,
    difference,
    errors_of_steps,
    faded,
    field_of,
    moment_of,
    over_scales,
)
from viscofric.motion.mover import QUICK, SHARE, Mover, Sizes, State
from viscofric.motion.schedule import Instant, Schedule

_MOST_MARCHES = 6
#: Changes of the step from one to the next; order 3 of the local error.
_SHRINK, _GROW, _SAFETY = 0.1, 3.0, 0.85
#: First step of an interval, as a part of it; after a jump, in the time in which the response changes.
_FIRST, _FIRST_AFTER_JUMP = 1.0 / 32.0, 0.2
#: Least step, as a part of an interval, and of the time, of which rounding is a hundredth.  Most least steps in an
#: interval with too large a difference: contact conditions are met to a tolerance, so that a few may be by chance;
#: where they can be met more closely, they are after fewer.
_LEAST, INSTANT, _MOST_LEAST, _FEW_LEAST = 1e-10, 1e-14, 100, 4
#: Relative difference of times that are the same.
_SAME_TIME = 1e-12
#: Times of a mode after which it has followed a jump.
_FOLLOWED = 40.0


class _NoisyError(Exception):
    """The tolerance of the contact conditions causes differences that do not fall with shorter steps."""


class _TooLargeError(Exception):
    """The difference of the chains has exceeded the accuracy by a factor."""


def march(
    mover: Mover[State],
    schedule: Schedule,
    *,
    accuracy: float,
    times: Sequence[float] | None = None,
    fields: bool = True,
    progress: Callable[[float, float], object] | None = None,
    begin: Reached[State] | None = None,
    extrapolate: bool = False,
) -> Track[State]:
    """March through a schedule; ConvergenceError if the accuracy is not reached."""
    # `accuracy` is the largest error of friction, depth, load and energy, relative to the largest values so far.
    # `times` to return ascend, s, one given twice at a jump: before and after it; all steps if None. `begin` is
    # `Track.reached` of the march to continue, within the schedule or before its start. No error is raised if the ticks
    # of the mover are too far apart for the accuracy; the error estimates then show it.
    # Where all steps are returned, integrals over these, such as means of cycles, need short ones.
    share = SHARE if times is None else mover.share
    if begin is not None and begin.share is not None:
        share = begin.share
    for _ in range(_MOST_MARCHES):
        try:
            return _March(mover, schedule, accuracy, share, times, fields, progress, extrapolate).run(begin)
        except _TooLargeError as error:
            share *= max(0.05, 0.5 * error.args[0] ** -1.5)
        except _NoisyError:
            mover.tighten()
    raise ConvergenceError(
        f"the accuracy {accuracy:g} was not reached with steps that each add {share:.2g} of it; ask for less.",
        code="steps-not-converged",
    )


@dataclass(eq=False)
class Progress:
    """Progress of several marches whose number is not known before, told as a time of their history.

    Each march takes a part of what remains.
    """

    whole: Callable[[float, float], object]
    start: float
    end: float
    part: float  # of what remains, that the present march takes
    next_part: float  # and each of the next
    begun: float = 0.0
    furthest: float = 0.0

    def __call__(self, reached: float, end: float) -> None:
        """State the time that the present march has reached."""
        share = (reached - self.start) / (end - self.start)
        self.furthest = max(self.furthest, self.begun + self.part * (1.0 - self.begun) * share)
        self.whole(self.start + self.furthest * (self.end - self.start), self.end)

    def next(self) -> None:
        """Begin with another march."""
        self.begun += self.part * (1.0 - self.begun)
        self.part = self.next_part

    def end_all(self) -> None:
        """State that all marches are done."""
        self.whole(self.end, self.end)


@dataclass(eq=False)
class _March(Generic[State]):
    mover: Mover[State]
    schedule: Schedule
    accuracy: float
    share: float
    times: Sequence[float] | None
    fields: bool
    progress: Callable[[float, float], object] | None
    extrapolate: bool
    moments: list[Moment[State]] = field(default_factory=list)
    _apart: float | None = None  # time from which on the chains touch different points, since the kink, s
    taken: int = 0
    rejected: int = 0
    _stored: float = 0.0  # before the start
    _pace: float = 0.0  # of the interval before, if no jump ended it
    _kink: float = 0.0  # time that steps are counted from, s
    _end: float = 0.0  # of the part, s; and since the kink
    _last: float = 0.0
    _shown_from: float = -math.inf  # since the kink, the first step that may be returned, s
    _spread: Difference = SAME
    _limited: bool = False  # whether a step from tick to tick was longer than the accuracy asks for

    def run(self, begin: Reached[State] | None) -> Track[State]:
        self._at = self._begun() if begin is None else self._taken_up(begin)
        interrupted = False
        try:
            self._go_on()
        except KeyboardInterrupt:
            interrupted = True
        told = self.moments[-1].instant.time if self.moments else self._at.told
        found = {"scales": self._scales, "spread": self._spread, "pace": self._pace, "limited": self._limited}
        reached = replace(self._at, told=told, **found)  # type: ignore[arg-type]
        return Track(self.moments, self.taken, self.rejected, interrupted, reached, self._stored)

    def _begun(self) -> Reached[State]:
        mover, schedule = self.mover, self.schedule
        self._scales = mover.scales
        state = mover.begin()
        link = Link(state, mover.observe(state), 0.0)
        pair = Pair(link, link)
        self._stored = link.seen.stored
        if schedule.before == "untouched":
            first = schedule.at(schedule.start, after=False)
            pair = self._jump(pair, first, first)
        return Reached(pair, schedule.start, share=self.share, stored=self._stored)

    def _taken_up(self, begin: Reached[State]) -> Reached[State]:
        self._scales = self.mover.scales
        if begin.scales is not None:
            self._scales = Sizes(*map(max, zip(begin.scales, self._scales, strict=True)))
        self._pace, self._spread, self._limited = begin.pace, begin.spread, begin.limited
        self._stored = begin.pair.fine.seen.stored if begin.stored is None else begin.stored
        time = self.schedule.start if begin.time is None else begin.time
        return replace(begin, time=time, share=self.share, stored=self._stored)

    def _go_on(self) -> None:
        """March from where it is to the end."""
        schedule, first = self.schedule, float(self._at.time)  # type: ignore[arg-type]
        if first in schedule.kinks:
            self._stop_at_kink(first)
        elif first > self._at.told:
            self._record(self._at.pair, schedule.at(first), asked=first in (self.times or ()))
        for start, end in itertools.pairwise(schedule.kinks.tolist()):
            if end <= first:
                continue
            for left, right in self._parts(start, end):
                if right > first:
                    self._interval(self._at.pair, left, right)
                if first < right < end:
                    self._record(self._at.pair, schedule.at(right), asked=self.times is not None)
            self._stop_at_kink(end)

    def _parts(self, start: float, end: float) -> list[tuple[float, float]]:
        """Return the parts of an interval between the times asked for."""
        stops = sorted({time for time in self.times or () if start < time < end})
        return list(itertools.pairwise([start, *stops, end]))

    def _stop_at_kink(self, time: float) -> None:
        """Record the state at a kink, take its jump if there is one, and record that too, unless it has been done."""
        schedule, pair = self.schedule, self._at.pair
        if schedule.starts_at(time):
            self._pace = 0.0
        known = self._at.told >= time
        wanted = 0 if self.times is None else sum(1 for one in self.times if one == time)
        before = schedule.at(time, after=False)
        if not schedule.jumps_at(time):
            if not known:
                self._record(pair, before, asked=wanted > 0, times=max(wanted, 1))
            return
        if self._at.jumped and known:
            return
        if not (self._at.jumped or known) and wanted != 1:
            self._record(pair, before, asked=wanted > 1)
        after = schedule.at(time)
        if not self._at.jumped and after[3:] != before[3:]:
            pair = self._jump(pair, before, after)
        self._at = replace(self._at, pair=pair, jumped=True)
        self._record(pair, after, asked=wanted > 0)

    def _jump(self, pair: Pair[State], before: Instant, after: Instant) -> Pair[State]:
        """Take a jump on both chains: the response is elastic, and its work is stored."""
        links = []
        self._pace = 0.0
        for link in pair:
            state = self.mover.step(link.state, before, after)
            seen = self.mover.observe(state)
            self.mover.accept(state, after)
            links.append(Link(state, seen, link.work + seen.stored - link.seen.stored, link.rubbed))
        return self._seen(Pair(*links))

    def _settled(self, pair: Pair[State], instant: Instant, shortest: float) -> Pair[State]:
        """Let the modes follow a jump that are too quick for steps; the load or the depth does not change."""
        links = []
        for link in pair:
            state = self.mover.settle(link.state, instant, shortest)
            if state is link.state:
                return pair
            seen, before = self.mover.observe(state), link.seen
            self.mover.accept(state, instant)
            links.append(Link(state, seen, link.work + seen.load * (seen.depth - before.depth), link.rubbed))
        return self._seen(Pair(*links))

    def _interval(self, pair: Pair[State], start: float, end: float) -> None:
        """March through a part without kinks, from its start or from where an earlier march has come to."""
        # Times are counted from the last kink: soon after it, absolute ones would be rounded.
        kinks = self.schedule.kinks
        self._kink = float(kinks[np.searchsorted(kinks, start, side="right") - 1])
        time, begun, last = float(self._at.time), self._at.since, end - self._kink  # type: ignore[arg-type]
        if self._kink + begun != time:
            begun = max(start, time) - self._kink
        self._end, self._last, least = end, last, INSTANT * last
        settled = self._settled(pair, self.schedule.at(self._kink, since=begun), least)
        # Before it, modes that have followed at once would be shown too soft; others, at times that are the same.
        followed = begun if settled is pair else begun + _FOLLOWED * QUICK * least
        self._shown_from = max(followed, INSTANT * max(abs(start), abs(end)))
        pair = settled
        ticks = self.mover.ticks(self.schedule.at(start), self.schedule.at(end, after=False))
        if ticks is None:
            self._freely(pair, begun, last, least)
        else:
            edges = start - self._kink + np.append(0.0, ticks)
            edges[-1] = last  # where rounding would be beyond it
            edges = _even_steps(edges)
            self._by_ticks(pair, _even_steps(np.append(begun, edges[edges > begun * (1.0 + _SAME_TIME)])))

    def _freely(self, pair: Pair[State], start: float, end: float, least: float) -> None:
        time, step, failed = start, self._pace or max(least, self._first_step(start, end)), 0
        while time < end:
            left, proposed = end - time, step
            step = left if step >= left else min(step, 0.5 * left)  # no tiny last step
            reached = end if step == left else time + step
            tried, fine = self._try(pair, [time, 0.5 * (time + reached), reached])
            ratio, change = self._ratio(pair, tried), 0.0
            too_quick = ratio * self.share > 1.0  # the step alone adds more than the accuracy
            if not too_quick:
                change = self.mover.rate_change(*fine)
                ratio = max(ratio, change / (self._with(tried).friction * self.accuracy))
            if ratio > 1.0 and step > (least if too_quick else max(least, _LEAST * (end - start))):
                self.rejected += 1
                step *= _growth(ratio)
                continue
            failed += ratio > 1.0
            if (failed > _FEW_LEAST or too_quick) and self.mover.can_tighten:
                raise _NoisyError
            if too_quick:
                now = self._kink + time
                raise ConvergenceError(
                    f"at time {now:.6g} s the contact changes within {step:.2g} s, the shortest step up to the next "
                    "time of the history, or asked for: give a time soon after it, or a slower change.",
                    code="steps-not-converged",
                    values={"time": now, "step": step},
                )
            if failed > _MOST_LEAST:
                raise ConvergenceError(
                    f"at time {self._kink + time:.6g} s the error does not fall with shorter steps; ask for less "
                    "accuracy.",
                    code="steps-not-converged",
                )
            # A step shortened by the end of a part is no guide to the length of the next one.
            step = max(proposed if step < proposed and ratio < 1.0 else least, step * _growth(ratio))
            pair = self._take(tried, reached, end, step, change)
            time = reached

    def _first_step(self, start: float, end: float) -> float:
        """Return the first step after a jump, before the end of which not even quick modes have followed it."""
        # The two chains could not show an error of both of them.
        step = _FIRST * (end - start)
        begun = self._kink + start
        _, fastest = self.schedule.rates(begun, begun + step)
        return min(step, _FIRST_AFTER_JUMP * self.mover.quickest / fastest)

    def _by_ticks(self, pair: Pair[State], edges: Array) -> None:
        """March by whole ticks, an even number of them for the coarse chain, half as many for the fine one."""
        place, last, count = 0, len(edges) - 1, int(self._pace) or 2
        while place < last:
            count = min(count, last - place)
            tried, _ = self._try(pair, edges[[place, place + count // 2, place + count]].tolist())
            ratio = self._ratio(pair, tried)
            taken, count = count, max(2, 2 * int(0.5 * count * _growth(ratio)))
            if ratio > 1.0 and taken > 2:
                self.rejected += 1
            else:
                self._limited |= ratio > 1.0
                place += taken
                pair = self._take(tried, float(edges[place]), float(edges[-1]), count if place < last else 0.0)

    def _try(
        self, pair: Pair[State], times: Sequence[float]
    ) -> tuple[Pair[State], tuple[State, State, State, Instant, Instant]]:
        """Step from the first time to the last: the coarse chain in one step, the fine one in two."""
        # Also returns the states of the fine chain, and the instants of its last step; see `Mover.rate_change`.
        first, middle, last = (self._instant(time) for time in times)
        halfway = self._step(pair.fine, first, middle)
        tried = Pair(self._step(pair.coarse, first, last), self._step(halfway, middle, last))
        return tried, (pair.fine.state, halfway.state, tried.fine.state, middle, last)

    def _step(self, link: Link[State], start: Instant, end: Instant) -> Link[State]:
        state = self.mover.step(link.state, start, end)
        seen, before = self.mover.observe(state), link.seen
        pressed = 0.5 * (seen.load + before.load) * (seen.depth - before.depth)
        forces = 0.5 * np.add(seen.friction_force, before.friction_force)
        rubbed = float(forces @ (end.position - start.position))
        return Link(state, seen, link.work + pressed + rubbed, link.rubbed + rubbed)

    def _instant(self, since: float) -> Instant:
        """Return what is prescribed so long after the kink."""
        if since == self._last:
            return self.schedule.at(self._end, after=False)
        return self.schedule.at(self._kink, since=since)

    def _ratio(self, pair: Pair[State], tried: Pair[State]) -> float:
        """Return the growth of the difference of the chains in a step, relative to the allowed growth."""
        scales = self._with(tried)
        before, after = (over_scales(difference(one), scales) for one in (pair, tried))
        return max(abs(two - one) for one, two in zip(before, after, strict=True)) / (self.share * self.accuracy)

    def _take(
        self, tried: Pair[State], reached: float, end: float, pace: float, rate_change: float = 0.0
    ) -> Pair[State]:
        self.taken += 1
        instant = self._instant(reached)
        self.mover.accept(tried.fine.state, instant)
        pair = self._seen(tried, rate_change)
        self._hold_before(pair, instant, reached)
        worst = max(map(abs, over_scales(difference(pair), self._scales))) / 3.0
        if worst > self.accuracy and not self._limited:
            raise _TooLargeError(worst / self.accuracy)
        jumped = instant.time == self._kink  # soon after a jump, by rounding
        self._pace, self._at = pace, replace(self._at, pair=pair, time=instant.time, since=reached, jumped=jumped)
        if self.times is None and self._shown_from <= reached < end:
            self._record(pair, instant, asked=True)
        if self.progress is not None:
            self.progress(instant.time, self.schedule.end)
        return pair

    def _with(self, pair: Pair[State]) -> Sizes:
        """Return the scales with the values of a state."""
        seen, old = pair.fine.seen, self._scales
        return Sizes(
            max(old.load, abs(seen.load)),
            max(old.depth, abs(seen.depth)),
            max(old.friction, math.hypot(*seen.friction_force)),
            max(old.energy, abs(pair.fine.work), seen.stored, seen.dissipated),
        )

    def _seen(self, pair: Pair[State], rate_change: float = 0.0) -> Pair[State]:
        points = max(self.mover.pointwise_difference(pair.coarse.state, pair.fine.state), rate_change)
        self._scales, self._spread = self._with(pair), faded(self._spread, pair, points)
        return pair

    def _hold_before(self, pair: Pair[State], instant: Instant, reached: float) -> None:
        """Let the error of friction at rest hold earlier, if one chain touches a point that the other does not."""
        # The contact itself may have touched it before both chains, by about the time between them: until one of them
        # touches, no difference shows that.
        coarse, fine = (link.seen.area for link in pair)
        if coarse == fine or self._spread.points == 0.0:
            self._apart = None
            return
        if self._apart is None:
            self._apart = self._at.since if self._at.since < reached else 0.0
        if not np.array_equal(instant.position, self.schedule.at(self._kink).position):
            return
        first = self._kink + max(0.0, 2.0 * self._apart - reached)
        now = errors_of_steps(self._spread).friction
        for place in range(len(self.moments) - 1, -1, -1):
            one = self.moments[place]
            if one.instant.time < first or one.instant.time <= self._kink:
                return
            errors = one.errors._replace(friction=max(one.errors.friction, now))
            self.moments[place] = replace(one, errors=errors)

    def _record(self, pair: Pair[State], instant: Instant, *, asked: bool, times: int = 1) -> None:
        if not asked and self.times is not None:
            return
        held = field_of(self.mover, pair) if self.fields else None
        floor = self.mover.floor(self._scales)
        since, part = self.schedule.since_control_jump(instant)
        friction = self.mover.early(self.schedule.since_jump(instant))
        rest = 1.0 + part * (self.mover.early(since) - 1.0)
        early = Sizes(rest, rest, friction, rest)
        self.moments += times * [
            moment_of(pair, instant, held, self._spread, floor, early=early, extrapolate=self.extrapolate)
        ]


def _growth(ratio: float) -> float:
    return max(_SHRINK, min(_GROW, float(_SAFETY * max(ratio, 1e-6) ** (-1.0 / 3.0))))


def _even_steps(edges: Array) -> Array:
    """Return the edges of an even number of steps: the first one is divided if their number is odd."""
    # Steps of whole cells stay whole: after half a cell, friction is off for the next two.
    if len(edges) % 2:
        return edges
    return np.insert(edges, 1, 0.5 * (edges[0] + edges[1]))
