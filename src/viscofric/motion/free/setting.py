"""What a free contact is and does, in the units of `viscofric.contact.free.scale`: the same on every grid."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.free.geometry import Geometry
from viscofric.contact.free.grids import Grid
from viscofric.contact.free.scale import Scale, ScaledIndenter
from viscofric.contact.indenters.indenter import Indenter, insist_on_round_edges
from viscofric.contact.operators.layer import ScaledLayer
from viscofric.errors import ConvergenceError, InputError
from viscofric.motion.free.response import Response
from viscofric.motion.memory import Modes, StepCoefficients, quickest_time, step_coefficients
from viscofric.motion.mover import Problem, Sizes
from viscofric.motion.schedule import Instant, Schedule


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
    def of(cls, modes: Modes, problem: Problem) -> Body:
        """Return modes (1/Pa) and the compliance of the indenter in these units."""
        unit = problem.plane_strain * modes.relaxed + problem.counterface
        scale = problem.plane_strain / unit
        instant, counterface, at_once = scale * modes.instantaneous, problem.counterface / unit, scale * modes.at_once
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


# Distance from the load, in path lengths and units of length, from which displacements in plane strain are measured.
_LEVEL = 20.0
# Most steps along a path between two times.
_MOST_STEPS = 1e6
# Part of a cell, and of the largest load or depth, below which nothing is moved.
_STILL = 1e-9
# Path before the start, in units of length, over which modes of a steady contact differ.
_SLID = 1000.0
# Ticks of a change of the load or depth by its largest value, and those in each e-fold of the time after a jump.
_OF_LOAD, _OF_TIME = 48, 6
# Shortest time that matters in an interval without motion, as a part of it.
_OF_INTERVAL = 0.01
# Change of a rate, as a part of the largest, at which steps end: in the accuracy, and at most.  Friction bends there
# too, which interpolation between steps would round off.
_BEND, _MOST_BEND = 4.0, 0.25
# Ticks in a step over which the speed changes by its largest value.
_OF_SPEED = 5
# Graded ticks of a rest, at cells of this length or longer, and the first of them, as a part of the rest.
_AT_REST, _REST_CELL, _FIRST_AT_REST = 48, 0.04, 1e-3
# Least number of ticks of a stroke of few cells, at cells of that length or longer.
_OF_STROKE = 2
# Second tick after a jump, in the time in which the response to it changes.
_FIRST_TICK = 0.2
# First tick after a start, in the time in which a cell is passed: least and largest; ratio of the times of the next.
_LEAST_OF_START, _MOST_OF_START, _NEXT_OF_START = 0.005, 0.05, 1.5


@dataclass(frozen=True, eq=False)
class Setting:
    """A contact and its history."""

    schedule: Schedule
    modes: Modes
    body: Body
    indenter: Indenter
    scale: Scale
    shape: ScaledIndenter
    toward: tuple[float, float]  # of the lattice's x over the indenter's axes
    layer: ScaledLayer | None
    known: Sizes | None = None  # sizes that errors are compared with, where a march has found them
    distance: float | None = None  # `level`, where it is that of a shorter history

    @classmethod
    def of(cls, problem: Problem, modes: Modes, known: Sizes | None = None) -> Setting:
        """Return the setting of an indenter with a history."""
        schedule, indenter, layer = problem.schedule, problem.indenter, problem.layer
        assert isinstance(indenter, Indenter)
        body, counterface = Body.of(modes, problem), problem.counterface
        compliance = problem.plane_strain * modes.relaxed + counterface
        largest = schedule.insist_on_contact()
        levelled = indenter.geometry.has_far_field or (layer is not None and counterface == 0.0)
        if schedule.control == "load":
            scale = Scale.for_load(indenter, 1.0 / compliance, largest)
        elif levelled:
            scale = Scale.for_indentation(indenter, 1.0 / compliance, largest)
        else:
            raise InputError(
                "indentation: has no meaning in plane strain, where the surface far away is infinitely high above the "
                f"contact; give the load ({indenter.geometry.load_unit}).",
                code="no-level",
            )
        toward = _direction(schedule)
        if indenter.geometry.dimension == 1 and toward[1] != 0.0:
            raise InputError(
                f"position: a {indenter.noun} makes a line contact, which moves along x only.", code="line-direction"
            )
        if toward != (0.0, 0.0):
            insist_on_round_edges(indenter)
        toward = toward if toward != (0.0, 0.0) else (1.0, 0.0)
        scaled = None if layer is None else ScaledLayer.of(layer, scale.length, problem.material.poisson_ratio)
        shape = ScaledIndenter(indenter, scale, toward)
        return cls(schedule, modes, body, indenter, scale, shape, toward, scaled, known)

    def with_modes(self, modes: Modes, problem: Problem) -> Setting:
        """Return this setting with other modes of the same material."""
        return replace(self, modes=modes, body=Body.of(modes, problem))

    @property
    def geometry(self) -> Geometry:
        """Whether it is a point or a line contact."""
        return self.scale.geometry

    @property
    def is_line(self) -> bool:
        """Whether it is a line contact."""
        return self.geometry.dimension == 1

    @property
    def is_levelled(self) -> bool:
        """Whether there is a surface far away that does not move."""
        return not self.is_line or (self.layer is not None and self.body.counterface == 0.0)

    @cached_property
    def level(self) -> float:
        """Distance from which displacements are measured where there is no far field."""
        if self.distance is not None:
            return self.distance
        return _LEVEL * (1.0 + self.path_length)

    @cached_property
    def path_length(self) -> float:
        """Largest distance between two places of the indenter along either axis."""
        places = np.array([self.turned(one) for one in _places(self.schedule)])
        return float(np.ptp(places, axis=0).max())

    def in_units_of(self, other: Setting) -> Setting:
        """Return this setting in the units and on the axes of another one of the same contact."""
        return replace(
            self, scale=other.scale, shape=other.shape, toward=other.toward, layer=other.layer, distance=other.level
        )

    @property
    def scales(self) -> Sizes:
        """Sizes that errors are compared with, SI."""
        if self.known is not None:
            return self.known
        force, work = self.scale.force, self.scale.force * self.scale.depth
        load = self.geometry.parabolic_load
        return Sizes(force * load, self.scale.depth, 0.2 * force * load * self.scale.slope, 0.2 * work)

    def responses(self, grid: Grid) -> tuple[Response, Response | None]:
        """Return the response of the body, and that of an elastic indenter on a layer; None where they are the same."""
        spacing, aspect = grid.spacing, grid.width / grid.spacing
        body = Response(self.is_line, spacing, aspect, self.layer, self.level)
        if self.layer is None or self.body.counterface == 0.0:
            return body, None
        return body, Response(self.is_line, spacing, aspect, None, self.level)

    def control(self, instant: Instant) -> tuple[float | None, float | None]:
        """Return load and depth that are prescribed, one of them None."""
        if instant.load is not None:
            return instant.load / self.scale.force, None
        return None, float(instant.depth) / self.scale.depth  # type: ignore[arg-type]

    def turned(self, position: Array) -> tuple[float, float]:
        """Return a position (m) along and across the lattice."""
        (x, y), (c, s) = position / self.scale.length, self.toward
        return float(c * x + s * y), float(c * y - s * x)

    def unturned(self, along: float, across: float) -> tuple[float, float]:
        """Return a vector given along and across the lattice over the indenter's axes."""
        c, s = self.toward
        return c * along - s * across, s * along + c * across

    @cached_property
    def stroke(self) -> float:
        """Distance to the first stop or turn of the indenter, or to its end; zero where it moves on a curve."""
        kinks = self.schedule.kinks
        places = np.array([self.turned(self.schedule.at(float(time)).position) for time in kinks])
        moves = np.diff(places, axis=0)
        if len(moves) == 0 or np.abs(moves[:, 1]).max() > _STILL * np.abs(moves).max():
            return 0.0
        forward = moves[:, 0] > 0.0
        first = int(np.argmax(forward))
        ends = np.flatnonzero(~forward[first:])
        return float(moves[first : first + ends[0] if len(ends) else None, 0].sum()) if forward.any() else 0.0

    def shortest_time(self, spacing: float, times: Sequence[float] | None) -> float:
        """Return the least time, s of the clock, in which the pressure at a point changes noticeably on a grid."""
        least = self.schedule.duration
        if times is None:  # all steps, the first ones after a jump too
            for time in self.schedule.kinks[:-1]:
                now = self.schedule.at(float(time))
                if self._begins_with_jump(now):
                    least = min(least, _FIRST_TICK * self.body.quickest)
        stops = np.unique(np.concatenate([self.schedule.kinks, np.asarray(times or [], dtype=float)]))
        for start, end in itertools.pairwise(stops):
            slowest, _ = self.schedule.rates(float(start), float(end))
            least = min(least, _OF_INTERVAL * slowest * float(end - start))
        for start, end in itertools.pairwise(self.schedule.given):
            speed = max(
                math.hypot(*self.turned(self.schedule.velocity(float(time), after=side)))
                for time, side in ((start, True), (end, False))
            )
            slowest, _ = self.schedule.rates(float(start), float(end))
            least = min(least, slowest * spacing / speed if speed > 0.0 else math.inf)
        return least

    @property
    def longest_time(self) -> float:
        """Return the time, s of the clock, over which modes differ: longer than the history after sliding for ever."""
        duration = self.schedule.duration
        return max(duration, _SLID / self.first_speed) if self.schedule.before == "sliding" else duration

    @property
    def first_speed(self) -> float:
        """Return the speed before the start, lengths per second of the clock, which runs with the first temperature."""
        return math.hypot(*self.turned(self.schedule.velocity(self.schedule.start, after=False)))

    def ticks(self, start: Instant, end: Instant, cell: float) -> Array:
        """Return times since a start at which the indenter is a whole number of cells away, or graded ones at rest."""
        places = np.array([self.turned(start.position), self.turned(end.position)])
        straight = float(np.abs(places[1] - places[0]).max())
        if straight > _MOST_STEPS * cell:
            raise ConvergenceError(
                f"the path from {start.time:.4g} to {end.time:.4g} s takes {straight / cell:.2g} steps; shorten it, "
                "or ask for less accuracy.",
                code="too-long-path",
            )
        count, duration = 16 * (2 + math.ceil(straight / cell)), end.time - start.time
        times = np.linspace(0.0, duration, count + 1)
        every = (start.time + times[:-1]).tolist()
        path = np.array([self.turned(self.schedule.at(time).position) for time in every] + [places[1]])
        steps = np.hypot(*np.diff(path, axis=0).T)
        length = np.concatenate([[0.0], np.cumsum(steps)])
        if length[-1] < _STILL * cell:
            return self._at_rest(start, end, cell)
        along = path[:, 0]
        if float(np.ptp(path[:, 1])) < _STILL * cell and (
            np.all(np.diff(along) >= 0.0) or np.all(np.diff(along) <= 0.0)
        ):
            low, high = sorted((along[0], along[-1]))
            whole = cell * np.arange(math.ceil(low / cell + 1e-6), math.ceil(high / cell - 1e-6))
            if along[-1] < along[0]:
                whole = whole[::-1]
            wanted = np.abs(whole - along[0])
        else:
            wanted = cell * np.arange(1.0, math.ceil(length[-1] / cell - 1e-6))
        found = [np.interp(wanted, length, times)]
        if len(wanted) < (count := math.ceil(_OF_STROKE * max(1.0, _REST_CELL / cell))):
            found.append(np.linspace(0.0, duration, count + 1))
        found.append(self._of_control(start, end))
        if self._begins_with_jump(start):
            found.append(self._after_jump(start, end))
        found.append(self._after_start(start, end, float(np.interp(cell, length, times, right=duration))))
        return self._apart(start.time, duration, found, duration * cell / length[-1])

    def _apart(self, begun: float, duration: float, found: list[Array], longest: float = math.inf) -> Array:
        """Return all times found, less those closer than a thousandth of the longest step, or of the time so far.

        Intervals in which the speed changes by much are divided.
        """
        every = np.unique(np.concatenate([*found, [duration]]))
        kept = every[(every > 0.0) & (every <= duration)]
        far = np.concatenate([np.diff(kept) > 1e-3 * np.minimum(longest, kept[:-1]), [True]])
        schedule, edges = self.schedule, np.concatenate([[0.0], kept[far]])
        pieces = []
        for start, end in itertools.pairwise(edges.tolist()):
            first, last = schedule.velocity(begun + start), schedule.velocity(begun + end, after=False)
            fastest = max(math.hypot(*first), math.hypot(*last))
            change = math.hypot(*(last - first)) / fastest if fastest > 0.0 else 0.0
            pieces.append(np.linspace(start, end, 2 + int(_OF_SPEED * change))[1:])
        return np.concatenate(pieces)

    def _of_control(self, start: Instant, end: Instant) -> Array:
        """Return times between which the load or the depth changes by a part of the largest."""
        first, last = (one.load if one.load is not None else one.depth for one in (start, end))
        share = abs(last - first) / self.schedule.largest  # type: ignore[operator]
        return np.linspace(0.0, end.time - start.time, 1 + math.ceil(_OF_LOAD * share))[1:-1]

    def _at_rest(self, start: Instant, end: Instant, cell: float) -> Array:
        """Return times that are graded from the start on, more of them on finer cells."""
        duration = end.time - start.time
        count = math.ceil(_AT_REST * max(1.0, _REST_CELL / cell))
        found = [np.geomspace(_FIRST_AT_REST * duration, duration, count), self._of_control(start, end)]
        if self._begins_with_jump(start) or self.schedule.starts_at(start.time):  # or a motion stops
            found.append(self._after_jump(start, end))
        return self._apart(start.time, duration, found)

    def _after_start(self, start: Instant, end: Instant, passing: float) -> Array:
        """Return times before the first cell is passed: friction changes over paths much shorter than a cell."""
        # `passing` is the time in which the part begins to pass a cell.
        schedule, kinks = self.schedule, self.schedule.kinks
        begun = float(kinks[np.searchsorted(kinks, start.time, side="right") - 1])
        if begun > schedule.start and not schedule.starts_at(begun):
            return np.zeros(0)
        longest = min(passing, end.time - begun)
        _, fastest = schedule.rates(begun, begun + longest)
        response = _FIRST_TICK * self.body.quickest / fastest
        first = min(max(response / longest, _LEAST_OF_START), _MOST_OF_START)
        count = math.ceil(-math.log(first) / math.log(_NEXT_OF_START))
        return np.asarray(begun - start.time + longest * _NEXT_OF_START ** -np.arange(float(count)))

    def _begins_with_jump(self, start: Instant) -> bool:
        if start.time == self.schedule.start and self.schedule.before == "untouched":
            return True
        before = self.schedule.at(start.time, after=False)
        return self.schedule.jumps_at(start.time) and (before.load, before.depth) != (start.load, start.depth)

    def _after_jump(self, start: Instant, end: Instant) -> Array:
        duration = end.time - start.time
        _, fastest = self.schedule.rates(start.time, end.time)
        first = min(_FIRST_TICK * self.body.quickest / fastest, 0.1 * duration)
        count = 1 + math.ceil(_OF_TIME * math.log(duration / first))
        return np.concatenate([[0.5 * first], np.geomspace(first, duration, count)])


def _direction(schedule: Schedule) -> tuple[float, float]:
    """Return the direction of the first motion; zeros where there is none."""
    moves = np.diff(_places(schedule), axis=0)
    if schedule.before == "sliding":
        moves = schedule.velocity(schedule.start, after=False)[None]
    lengths = np.hypot(*moves.T)
    if not np.any(lengths > 0.0):
        return 0.0, 0.0
    x, y = moves[int(np.argmax(lengths > 0.0))] / lengths[int(np.argmax(lengths > 0.0))]
    return float(x), float(y)


def _places(schedule: Schedule) -> Array:
    """Return the places at the given times and halfway between them, m; (n, 2)."""
    given = schedule.given
    times = np.sort(np.concatenate([given, 0.5 * (given[1:] + given[:-1])]))
    return np.array([schedule.at(float(time)).position for time in times])


def with_fewer_kinks(schedule: Schedule, accuracy: float) -> Schedule:
    """Return a schedule without the kinks of a smooth curve given by many points: steps may cross them."""
    # Those at jumps, stops and turns remain, and those at which a rate changes by much.
    kinks, least = schedule.kinks, min(_BEND * accuracy, _MOST_BEND)
    kept = [float(kinks[0])]
    velocity = [[schedule.velocity(float(time), after=after) for after in (False, True)] for time in kinks]
    fastest = max(math.hypot(*one) for one in [velocity[0][1], *itertools.chain(*velocity[1:])])
    rates = _rates(schedule)
    steepest = float(np.abs(rates).max())
    for place in range(1, len(kinks) - 1):
        (before, after), change = velocity[place], abs(rates[place] - rates[place - 1])
        turns = float(before @ after) <= 0.0 and (before.any() or after.any())
        bent = math.hypot(*(after - before)) > least * fastest
        if schedule.jumps_at(float(kinks[place])) or turns or bent or change > least * steepest:
            kept.append(float(kinks[place]))
    return replace(schedule, kinks=np.array([*kept, float(kinks[-1])]))


def _rates(schedule: Schedule) -> Array:
    """Return the rate of the load or depth in each interval."""
    rates = []
    for start, end in itertools.pairwise(schedule.kinks):
        first, last = schedule.at(float(start)), schedule.at(float(end), after=False)
        values = [one.load if one.load is not None else one.depth for one in (first, last)]
        rates.append((values[1] - values[0]) / (end - start))  # type: ignore[operator]
    return np.array(rates)
