"""A free contact through a history, on grids that become finer until the accuracy is reached.

The march estimates the error of the steps.  That of the cells follows from the change from one grid to the next, whose
cells are shorter by a factor: it is of about second order, and changes its sign with the place of the contact's edges
in their cells.  The work of friction, in which these signs cancel, is extrapolated.
"""

from __future__ import annotations

import itertools
import logging
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.interpolate import PchipInterpolator

from viscofric.arrays import Array
from viscofric.contact.free.grids import Extent, Grid
from viscofric.errors import ConvergenceError
from viscofric.motion.chains import Moment, Reached, Track
from viscofric.motion.free.mover import FreeMover
from viscofric.motion.free.setting import Setting, with_fewer_kinks
from viscofric.motion.free.stored import Level
from viscofric.motion.march import Progress, march
from viscofric.motion.memory import Modes, step_parts
from viscofric.motion.mover import Problem, Sizes
from viscofric.notes import Note

logger = logging.getLogger(__name__)

# Cells along the longest contact on the first grid, of a point and of a line; factor from grid to grid; most cells.
_POINT_CELLS, _LINE_CELLS, _FINER = 24, 96, 1.5
_MOST_POINT_CELLS, _MOST_LINE_CELLS = 400, 3000
# Factor from grid to grid on the accuracy of the steps.
_FINER_STEPS = 0.7
# Part of the change from grid to grid that is left as the error, which falls with the square of the cells.
_LEFT = 1.0 / (_FINER**2 - 1.0)
# Part of the error of the steps that is left after its extrapolation; margin of the errors by cells, whose signs
# change; least one of the energy, over that of cells of second order (benchmarks/motion).
_STEPS_LEFT, _MARGIN, _LEAST_ENERGY = 0.5, 2.0, 1.5
# The same of steps that are not judged, of first order: all of the difference that was extrapolated.
_FIRST_ORDER = 2.5
# After a start or a turn, friction changes within slides of no length: so many steps, and cells of the coarser grid or
# part of the longest contact, are not judged, of the way to the next turn at most such a part.
_RESOLVED_STEPS, _RESOLVED_CELLS, _RESOLVED_PART, _UNJUDGED = 4, 4, 0.025, 0.1
# A first window is so much wider than the elastic contact; it is tried again where the contact is so much shorter.
_FIRST_WINDOW, _SHORT, _ATTEMPTS = 1.25, 0.6, 5
# Least friction coefficient that errors are compared with, in the slope of the indenter at the contact's edge.
_LEAST_FRICTION = 1e-3
# Least change of the depth of a line contact that errors are compared with, in the unit of depth.
_LEAST_DEPTH = 0.05
# Change of the load that is none.
_STEADY_LOAD = 1e-6
# Of the contact conditions, in the accuracy, for a friction coefficient that is such a part of the slope; least part.
_TOLERANCE, _TYPICAL_FRICTION, _SMALLEST = 0.01, 0.2, 0.02
# Part of what remains of the work that the first grid takes, and each of the next.
_PARTS = 0.25, 0.7
# Error of the creep compliance by merged modes, in the accuracy.
_MERGED = 0.02
# Part of the change of a load by which it may differ from a linear one on the clock of the material.
_BENT = 1e-5


_ONE_GRID = Note(
    "one-grid",
    "Interrupted before a finer grid was solved: the stated errors do not include those of the cells, which it shows.",
)


@dataclass(frozen=True, eq=False)
class _Task:
    """What is marched on every grid."""

    problem: Problem
    times: Sequence[float] | None
    told: Progress | None
    follow: Callable[..., Track[Any]]
    units: Setting | None  # of a shorter history that is continued

    def setting(self, spacing: float, largest: Sizes | None = None) -> Setting:
        """Return the setting with the modes that matter on a grid, the more of them the smaller a known friction is."""
        problem = self.problem
        one = Setting.of(problem, Modes.of(problem.schedule.spectrum), largest)
        times = one.shortest_time(spacing, self.times), one.longest_time
        modes = Modes.for_history(problem.schedule.spectrum, *times, _MERGED * problem.accuracy * _smallness(one))
        found = Setting.of(problem, modes, largest)
        return found if self.units is None else found.in_units_of(self.units)

    def march(self, grid: Grid, largest: Sizes | None, steps: float, size: float | None = None) -> Level:
        """March on a grid, from the start."""
        setting = self.setting(grid.spacing, largest)
        mover = FreeMover(setting, grid, _TOLERANCE * self.problem.accuracy * _smallness(setting))
        return Level(mover, self._followed(mover, steps), steps, size)

    def go_on(self, level: Level) -> Level:
        """Continue the march on a grid."""
        reached = level.track.reached
        return replace(level, track=level.track.joined(self._followed(level.mover, level.steps, begin=reached)))

    def _followed(self, mover: FreeMover, steps: float, **begin: Reached[Any]) -> Track[Any]:
        asked = {"accuracy": steps, "times": self.times, "progress": self.told}
        track = self.follow(mover, self.problem.schedule, extrapolate=True, **asked, **begin)
        if self.told is not None:
            self.told.next()
        return track


def solve_free(
    problem: Problem,
    times: Sequence[float] | None,
    progress: Callable[[float, float], object] | None = None,
    follow: Callable[..., Track[Any]] = march,
    begun: Sequence[Level] = (),
) -> tuple[Track[Any], tuple[Note, ...], list[Level]]:
    """March a free contact through its schedule; return track, notes on assumptions, and the last one or two grids."""
    # `follow` takes the arguments of `march`, and returns the track on one grid; `begun` are the last grids of a run
    # through a part of the schedule, to be continued.
    if not begun:
        problem = replace(problem, schedule=with_fewer_kinks(problem.schedule, problem.accuracy))
    line = problem.indenter.geometry.dimension == 1  # type: ignore[union-attr]
    most = _MOST_LINE_CELLS if line else _MOST_POINT_CELLS
    told = None if progress is None else Progress(progress, problem.schedule.start, problem.schedule.end, *_PARTS)
    task = _Task(problem, times, told, follow, begun[0].mover.setting if begun else None)
    waiting = list(begun)
    level = task.go_on(waiting.pop(0)) if waiting else None
    level = _first(task, _LINE_CELLS if line else _POINT_CELLS, level)
    found, levels = level.track, [level]
    judged = found.moments
    notes: tuple[Note, ...] = (_ONE_GRID,)
    while not found.interrupted or waiting:
        before, largest = level, _largest(level)
        if waiting:
            level = waiting.pop(0)
            stopped = found.interrupted
            level = replace(level, track=replace(level.track, interrupted=True)) if stopped else task.go_on(level)
        elif level.cells * _FINER > most:
            raise ConvergenceError(
                f"the accuracy {problem.accuracy:g} is not reached with {level.cells:.0f} cells along the contact, "
                f"which give {_worst(judged, largest):.2g}; a larger accuracy takes coarser cells.",
                code="accuracy-not-reached",
            )
        else:
            if begun and times is not None:  # also those of the run that is continued
                task = replace(task, times=[one.instant.time for one in level.track.moments])
            spacing = _fitted(before.mover.setting, before.mover.grid.spacing / _FINER)
            level = task.march(_around(before, spacing), largest, before.steps * _FINER_STEPS)
        levels = [before, level]
        if not level.track.moments:
            found = replace(found, interrupted=level.track.interrupted)
            break
        rows = _resolved(level, before) if times is None else list(range(len(level.track.moments)))
        moments = _compared(level, before, rows)
        found, notes = replace(level.track, moments=moments), ()
        judged = [moments[row] for row in rows]
        error = _worst(judged, _largest(level))
        logger.info(
            "%.0f cells along the contact: known to %.1g, %d products", level.cells, error, level.mover.products
        )
        if error <= problem.accuracy:
            break
    if told is not None and not found.interrupted:
        told.end_all()
    whole = Setting.of(problem, Modes.of(problem.schedule.spectrum))
    if begun and not whole.is_levelled:
        found = _measured_from(whole, found, level.mover.setting, problem)
    if not found.interrupted and times is None:
        notes = (*notes, *_after_starts(found.moments, judged, _largest(level), problem.accuracy))
    return found, (*_notes(problem, whole, found), *notes), levels


def _measured_from(whole: Setting, track: Track[Any], part: Setting, problem: Problem) -> Track[Any]:
    """Return what was measured from the level of a part of a history, measured from that of the whole of it."""
    # All points are displaced by 2/π ln(L'/L) times the response of a line to its load, whatever its path.
    farther = 2.0 / math.pi * math.log(whole.level * whole.scale.length / (part.level * part.scale.length))
    schedule, modes = whole.schedule, whole.modes
    body = 0.0 if problem.layer is not None else farther * problem.plane_strain
    C, instant = body * modes.C, body * modes.instantaneous + farther * problem.counterface
    given = [(schedule.at(float(time), after=after), after, -1) for time in schedule.given for after in (False, True)]
    for begin, end in itertools.pairwise(schedule.given.tolist()):
        # Loads are linear in time, and here by the clock, which is not even where temperature changes.
        least, most = schedule.rates(begin, end)
        count = math.ceil(math.sqrt(math.log(most / least) / (8.0 * _BENT)))
        given += [(schedule.at(time), True, -1) for time in np.linspace(begin, end, count + 1)[1:-1].tolist()]
    told = [one.instant for one in track.moments]
    given += [(one, one.load == schedule.at(one.time).load, row) for row, one in enumerate(told)]
    clock, load = given[0][0].clock, 0.0 if schedule.before == "untouched" else float(given[0][0].load or 0.0)
    memory, lost, moments = np.full(len(modes), load), 0.0, list(track.moments)
    first, held = instant * load + float(C @ memory), 0.5 * (instant * load**2 + float(C @ memory**2))
    for now, _, row in sorted(given, key=lambda one: (one[0].time, *one[1:])):
        parts, change, away = step_parts((now.clock - clock) / modes.tau), float(now.load or 0.0) - load, load - memory
        lost += float(C @ (parts.own * away**2 + 2.0 * parts.mixed * away * change + parts.new * change**2))
        memory = parts.decay * memory + parts.start * load + parts.end * (load + change)
        clock, load = now.clock, load + change
        if row >= 0:
            deeper, stored = instant * load + float(C @ memory), 0.5 * (instant * load**2 + float(C @ memory**2))
            one, seen = moments[row], moments[row].seen
            seen = seen._replace(
                depth=seen.depth + deeper - first, stored=seen.stored + stored, dissipated=seen.dissipated + lost
            )
            moments[row] = replace(one, seen=seen, work=one.work + stored - held + lost)
    return replace(track, moments=moments, stored=track.stored + held)


def _first(task: _Task, cells: int, level: Level | None) -> Level:
    """March on the coarsest grid that has so many cells along the longest contact; one may have been tried."""
    size, missed = 1.0, False
    for attempt in range(_ATTEMPTS + 1):
        if level is None:
            setting = task.setting(2.0 * size / cells)
            half = _FIRST_WINDOW * size
            spacing = _fitted(setting, 2.0 * size / cells)
            grid = setting.geometry.around(half, half, half, math.ceil(2.0 * half / spacing))
            level = task.march(replace(grid, spacing=spacing), None, task.problem.accuracy, size)
        longest = level.mover.longest
        fits = level.size is None or missed or _SHORT < 0.5 * longest / level.size < 1.0 / _SHORT
        if (fits and longest > 0.0) or level.track.interrupted or attempt == _ATTEMPTS:
            break
        # At a given depth, a slender indenter may lie between all points.
        missed = missed or longest == 0.0
        size, level = 0.5 * (longest or size), None
    assert level is not None
    if level.mover.longest == 0.0 and not level.track.interrupted:
        raise ConvergenceError(
            f"no point touches with {cells / size:.0f} cells along the contact; the indenter is too slender for a "
            "contact over time.",
            code="no-window",
        )
    return level


def _smallness(setting: Setting) -> float:
    """Return the friction over the load times the slope, if it is small: gaps count in it relative to the depth."""
    if setting.known is None:
        return 1.0
    typical = _TYPICAL_FRICTION * setting.known.load * setting.scale.slope
    return min(1.0, max(_SMALLEST, setting.known.friction / typical)) if typical > 0.0 else 1.0


def _around(level: Level, spacing: float) -> Grid:
    """Return a window around all contacts of a march, with cells of another length."""
    mover = level.mover
    if mover.longest == 0.0:
        return replace(mover.grid, spacing=spacing)
    margin = 4.0 * mover.grid.spacing
    whole: Extent = mover.reach.widened(margin)
    longest = max(whole.rear + whole.front, 2.0 * whole.side)
    return replace(mover.setting.geometry.around(*whole, math.ceil(longest / spacing)), spacing=spacing)


def _fitted(setting: Setting, spacing: float) -> float:
    """Return the length of a cell, a little shorter, so that the first stroke is a whole number of cells."""
    return setting.stroke / math.ceil(setting.stroke / spacing - 1e-9) if setting.stroke > spacing else spacing


def _largest(level: Level) -> Sizes:
    """Return the largest values of a march, as scales of errors; of the friction not below a part of the slope."""
    # A contact that does not move has hardly any friction to be compared with.
    seen = [one.seen for one in level.track.moments]
    load = max((one.load for one in seen), default=0.0)
    setting = level.mover.setting
    # In plane strain only a change of the depth is known, which may be none.
    least_depth = 0.0 if setting.is_levelled else _LEAST_DEPTH * setting.scale.depth
    least_friction = _LEAST_FRICTION if setting.path_length > 0.0 else _TYPICAL_FRICTION
    return Sizes(
        load=load,
        depth=max(least_depth, max((abs(one.depth) for one in seen), default=0.0)),
        friction=max(
            least_friction * load * setting.scale.slope,
            max((math.hypot(*one.friction_force) for one in seen), default=0.0),
        ),
        energy=max((max(abs(one.stored), one.dissipated) for one in seen), default=0.0),
    )


def _compared(level: Level, coarser: Level, judged: Sequence[int]) -> list[Moment[Any]]:
    """Return the moments of the finer grid with the errors of steps and cells, the work of friction extrapolated."""
    # Friction is that of the memory, or of the pressure on the indenter's slopes if that has changed less; they differ
    # by the cells only. The usual change is that of the moments that are judged.
    fine, coarse = level.track.moments, coarser.track.moments
    kinks = level.mover.setting.schedule.kinks
    here, there = np.array([_values(one) for one in fine]), np.array([_values(one) for one in coarse])
    clock, before = _order([one.instant.time for one in fine]), _order([one.instant.time for one in coarse])
    reached = before <= clock[-1]  # a march may have been interrupted
    apart = _interpolated(before[reached], clock, here, kinks) - there[reached]
    left = _LEFT * np.column_stack([np.interp(clock, before[reached], column) for column in apart.T])
    cell = coarser.mover.grid.spacing * coarser.mover.setting.scale.length
    if 0.0 < np.ptp([one.instant.position for one in fine], axis=0).max() < cell:
        left[:, 3:7] *= _FINER + 1.0  # edges that stay within their cells are known to cells, to first order
    forces = left[:, 3:5], left[:, 5:7], here[:, 3:5] - here[:, 5:7]
    off = np.column_stack([np.abs(left[:, :3]), *(np.hypot(*one.T) for one in forces)])
    # One change may be small by chance.
    usual = np.sqrt(np.mean(off[judged or slice(None)] ** 2, axis=0))
    load, depth, energy, memory, slopes, between = _MARGIN * np.maximum(off, usual).T
    on_slopes = bool(usual[4] < usual[3])
    friction = np.maximum(slopes if on_slopes else memory, between)
    # All energies share the change by the first indentation, so that their mean is no measure.
    energy = np.maximum(energy, _MARGIN * _LEAST_ENERGY * here[:, 2] / max(level.cells, 1.0) ** 2)
    found, trusted = [], set(judged)
    for place, one in enumerate(fine):
        of_cells = load[place], depth[place], friction[place], energy[place]
        known = one.on_slopes() if on_slopes else one
        parts = zip(known.errors, one.seen.left_out, of_cells, strict=True)
        steps_left = _STEPS_LEFT if place in trusted else _FIRST_ORDER
        errors = Sizes(*(steps_left * (steps - rest) + rest + float(cells) for steps, rest, cells in parts))
        found.append(replace(known, errors=errors, work=one.work + float(left[place, 7])))
    return found


def _interpolated(clock: Array, given: Array, values: Array, kinks: Array) -> Array:
    """Return values (n, m) at other times, by cubics between kinks that overshoot nowhere."""
    found = np.repeat(values[:1], len(clock), axis=0)  # before a jump at the start
    for start, end in itertools.pairwise(kinks):
        begin = np.nextafter(start, math.inf)  # the second of two points, at a jump
        inside = (given >= (begin if begin in given else start)) & (given <= end)
        wanted = (clock >= (begin if begin in clock else start)) & (clock <= end)
        if np.count_nonzero(inside) > 1:
            found[wanted] = PchipInterpolator(given[inside], values[inside])(clock[wanted])
        else:
            found[wanted] = values[inside]
    return found


def _resolved(level: Level, coarser: Level) -> list[int]:
    """Return rows of moments, without those within few steps or cells of a coarser grid after a start or a turn."""
    times = np.array([one.instant.time for one in coarser.track.moments])
    setting = coarser.mover.setting
    schedule, kinks = setting.schedule, setting.schedule.kinks
    cells, part = _RESOLVED_CELLS * coarser.mover.grid.spacing, _RESOLVED_PART * coarser.mover.longest
    shortest = max(cells, part) * setting.scale.length
    kept = []
    for row, one in enumerate(level.track.moments):
        place = min(int(np.searchsorted(kinks, one.instant.time, side="right")), len(kinks) - 1) - 1
        begun, ends = (schedule.at(float(kinks[k])) for k in (place, place + 1))
        steps = np.count_nonzero((times > begun.time) & (times <= one.instant.time))
        slid, stroke = (math.hypot(*(instant.position - begun.position)) for instant in (one.instant, ends))
        early = 0.0 < slid < min(shortest, _UNJUDGED * stroke) and schedule.starts_at(begun.time)
        if one.instant.time == begun.time or (steps >= _RESOLVED_STEPS and not early):
            kept.append(row)
    return kept


def _after_starts(
    moments: Sequence[Moment[Any]], judged: Sequence[Moment[Any]], largest: Sizes, accuracy: float
) -> tuple[Note, ...]:
    """Return a note where errors soon after a start or a turn are larger than the accuracy."""
    early = {id(one) for one in moments} - {id(one) for one in judged}
    errors = [(_worst([one], largest), one.instant.time) for one in moments if id(one) in early]
    errors = [one for one in errors if one[0] > accuracy]
    if not errors:
        return ()
    worst, time = max(errors)
    steps = "one step" if len(errors) == 1 else f"{len(errors)} steps"
    said = (
        f"In {steps} soon after a start or a turn, within a few cells or a fortieth of the contact, the "
        f"stated error is larger than the accuracy: up to {worst:.2g} of the largest value, at {time:.3g} s."
    )
    return (Note("coarse-start", said, values={"steps": len(errors), "error": worst, "time": time}),)


def _values(moment: Moment[Any]) -> tuple[float, ...]:
    seen = moment.seen
    return seen.load, seen.depth, seen.dissipated, *seen.friction_force, *seen.force_on_slopes, moment.rubbed


def _order(times: list[float]) -> Array:
    """Return times that increase: of those given twice, at a jump, the second ones are a little later."""
    found = np.array(times)
    for i in range(1, len(found)):
        if found[i] <= found[i - 1]:
            found[i] = np.nextafter(found[i - 1], math.inf)
    return found


def _worst(moments: list[Moment[Any]], largest: Sizes) -> float:
    """Return the largest error relative to the largest values."""
    scales = [scale if scale > 0.0 else 1.0 for scale in largest]
    return max(max(error / scale for error, scale in zip(one.errors, scales, strict=True)) for one in moments)


def _notes(problem: Problem, setting: Setting, track: Track[Any]) -> tuple[Note, ...]:
    """Return notes where a layer is compressed by much, and where the indentation has no level."""
    if not track.moments:
        return ()
    notes: list[Note | None] = []
    schedule = problem.schedule
    both = [schedule.at(float(time), after=after).load or 0.0 for time in schedule.kinks for after in (False, True)]
    loads = [*both, 0.0] if schedule.before == "untouched" else both
    if not setting.is_levelled and max(loads) - min(loads) > _STEADY_LOAD * max(loads):
        distance = 1e3 * setting.level * setting.scale.length
        notes.append(
            Note(
                "no-level",
                "The load of a line contact changes: indentation and energies are measured from points at a distance "
                f"of {distance:.3g} mm, since the surface far away moves without bound.",
            )
        )
    if problem.layer is not None and setting.is_levelled:
        notes.append(problem.layer.strain_warning(max(one.seen.depth for one in track.moments)))
    return tuple(filter(None, notes))
