"""Contacts over time at the temperature to which their own friction heats them.

The rubber responds at the temperature of its history plus a mean rise, one number at each time, through its clock.  The
rise follows from the heat of a solved run along its path; runs are repeated with it until it no longer changes.  Heat
acts on the future only, so that this converges quickly.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from viscofric.arguments import insist_on
from viscofric.arrays import Array, Indices
from viscofric.contact.heated_result import THIN, thin_skin
from viscofric.data import with_rows
from viscofric.errors import ConvergenceError, InputError
from viscofric.heat.heating import Heating
from viscofric.heat.path import Passage, PathRise, path_rise
from viscofric.heat.result import TransientHeating
from viscofric.motion.history import History, dense_times
from viscofric.motion.march import Progress
from viscofric.motion.mover import Problem
from viscofric.motion.shear import contact_sizes, with_coulomb
from viscofric.motion.solution import TransientErrors, TransientSolution
from viscofric.notes import Note

#: Times at which the rise is found, besides those asked for, and most runs.
_POINTS, _MOST_RUNS = 60, 12
#: Part of what remains of the work that the first run takes, and each of the next.
_PARTS = 0.5, 0.5
#: Friction, load, depth and energy change by less than so many times themselves with a decade of α.
_STEEPEST = 2.5
#: Part of the accuracy by which the rise that is left may change them; a change of them by more is noted.
_LEFT, _FELT = 0.5, 1e-2
#: Errors of rises, as parts of them: of the face by heat on it; and of all by the loss, or where it is released, since
#: it is released where it is only on average (see the theory page on heat).
_OF_FACE, _OF_LOSS = 0.03, 0.75


def solve_heated(
    problem: Problem,
    history: History,
    heating: Heating,
    times: Sequence[float] | None,
    solve: Callable[[History, Sequence[float], Callable[[float, float], object] | None], TransientSolution],
    progress: Callable[[float, float], object] | None,
) -> TransientSolution:
    """Return the solution of a contact that its own friction heats; `solve` runs through a history at times given."""
    _insist_on_heatable(problem, history, heating)
    law = problem.material.shift
    assert law is not None
    assert history.temperature is not None
    own = dense_times(history, max(_POINTS, 2 * len(history.time)))
    grid = sorted([*own, *(set(times or ()) - set(own))])
    told = None if progress is None else Progress(progress, grid[0], grid[-1], *_PARTS)
    isothermal = run = solve(history, grid, told)
    schedule = problem.schedule
    around = np.array([schedule.temperature(time, after=after) for time, after in _sided(grid)])
    rise = np.zeros(len(grid))
    for _ in range(_MOST_RUNS):
        if run.interrupted:
            said = "Interrupted before the rise of temperature was known: the friction is not that of a heated contact."
            return replace(run, warnings=(*run.warnings, Note("not-heated", said)), _restart=None)
        heats = _heats(run, heating)
        found = _rise(problem, run, heating, heats)
        warmer, by_loss = _answered(found, heating)
        change = np.abs(np.asarray(law.log10(around + warmer)) - np.asarray(law.log10(around + rise)))
        residual = np.abs(warmer - rise)
        if float(change.max()) * _STEEPEST <= _LEFT * problem.accuracy:
            break
        rise = warmer
        if told is not None:
            told.next()
        run = solve(_warmer(problem, history, grid, around + rise), grid, told)
    else:
        raise ConvergenceError(
            f"the temperature of the contact did not settle in {_MOST_RUNS} runs: it still changes by "
            f"{residual.max():.2g} K.",
            code="temperature-not-settled",
        )
    if told is not None:
        told.end_all()
    # The rise by the heat of the last run, even where that run could do without it.
    heated = TransientHeating(
        warmer, by_loss, found.face, found.below, *heats, np.cumsum(found.counterface), isothermal.friction_force,
        residual, _error(problem, run, heating, heats, (warmer, by_loss), change),
    )  # fmt: skip
    keep = list(range(len(grid))) if times is None else _rows(grid, times)
    doubts = *_thin_skin(problem, run, heating, found), *_uncertain(law.log10, around, heated)
    run = replace(run, warnings=(*run.warnings, *doubts), errors=_with_what_is_left(run, history.control, change))
    run = with_coulomb(problem, run, heating.coulomb)
    # A state of the last run is no state of the heated contact.
    return replace(
        with_rows(run, keep),
        errors=with_rows(run.errors, keep),
        heating=with_rows(heated, keep),
        _fields=tuple(run._fields[row] for row in keep) if run._fields else (),
        _restart=None,
    )


def _with_what_is_left(run: TransientSolution, control: str, change: Array) -> TransientErrors:
    """Return the errors of a run with what it changes if α does, (n,) decades, up to each time."""
    part = _STEEPEST * np.maximum.accumulate(change)

    def more(error: Array, value: Array) -> Array:
        return np.asarray(error + part * np.maximum.accumulate(np.abs(value)))

    errors = run.errors
    force = np.hypot(run.friction_force, run.lateral_force)
    return replace(
        errors,
        load=more(errors.load, run.load) if control == "indentation" else errors.load,
        indentation=errors.indentation if control == "indentation" else more(errors.indentation, run.indentation),
        friction_force=more(errors.friction_force, force),
        energy=more(errors.energy, run.dissipated),
    )


def _answered(found: PathRise, heating: Heating) -> tuple[Array, Array]:
    """Return the rise that the rubber responds to and its part by the loss, (n,) each, K."""
    face = heating.average == "contact"
    return (found.face, found.face_by_loss) if face else (found.below, found.below_by_loss)


def _thin_skin(problem: Problem, run: TransientSolution, heating: Heating, found: PathRise) -> tuple[Note, ...]:
    """Return a note where only a skin of the rubber is as warm as the face, which it is to respond to."""
    if heating.average == "loss":
        return ()
    lasting = np.diff(run.time) > 0.0
    speed = np.hypot(*np.diff(run.position, axis=0).T)[lasting] / np.diff(run.time)[lasting]
    size = contact_sizes(problem, run)
    if not len(speed) or speed.max() * size.max() == 0.0 or not found.face.any():
        return ()
    skin = float(np.sqrt(2.0 * heating.rubber.diffusivity / (speed.max() * size.max())))
    return (thin_skin(skin, float(found.face.max()), float(found.below.max()), "up to "),) if skin < THIN else ()


def _insist_on_heatable(problem: Problem, history: History, heating: Heating) -> None:
    insist_on(heating, "heating", Heating)
    reasons = {
        "a rough surface": problem.kind == "periodic",
        "a layer": problem.layer is not None,
        "before = 'sliding', whose heat has no beginning": history.before == "sliding",
        "slip or passes, which follow from the history": heating.slip is not None or heating.passes > 0,
        "the hot branch, which a history reaches by itself": heating.branch != "cold",
        "a material without shift factors, or a history without temperature": not problem.material.has_shift_factors
        or history.temperature is None,
    }
    for reason, holds in reasons.items():
        if holds:
            raise InputError(f"heating: a contact over time is not solved with {reason}.", code="not-with-heating")


def _sided(grid: Sequence[float]) -> list[tuple[float, bool]]:
    """Return each time, and whether the values after its jump are meant: those of the second of two."""
    return [(time, place > 0 and grid[place - 1] == time) for place, time in enumerate(grid)]


def _warmer(problem: Problem, history: History, grid: Sequence[float], temperature: Array) -> History:
    """Return the same history with other temperatures at more times."""
    schedule = problem.schedule
    last = len(grid) - 1
    # Before a jump the values on its left; at the end of the history there are no others.
    both = [
        (time, after or (grid.count(time) == 1 and place < last)) for place, (time, after) in enumerate(_sided(grid))
    ]
    instants = [schedule.at(time, after=after) for time, after in both]
    control = history.control
    values = [getattr(one, "depth" if control == "indentation" else control) for one in instants]
    given: dict[str, Any] = {control: values}
    if history.speed is None:
        given["position"] = np.array([one.position for one in instants])
    else:
        given["speed"] = np.array([schedule.velocity(time, after=after) for time, after in both])
    return History(list(grid), **given, temperature=temperature, before=history.before, direction=history.direction)


def _rise(
    problem: Problem,
    run: TransientSolution,
    heating: Heating,
    heats: tuple[Array, Array],
    rows: Indices | None = None,
) -> PathRise:
    coulomb, loss = heats
    rows = np.arange(len(run.time), dtype=np.intp) if rows is None else rows
    shape = "strip" if problem.kind == "line" else "disc"
    size, wide = contact_sizes(problem, run), _loss_sizes(problem, run)
    passage = Passage(run.time[rows], run.position[rows], size[rows], shape, wide[rows])
    return path_rise(passage, np.diff(coulomb[rows], prepend=0.0), np.diff(loss[rows], prepend=0.0), heating)


def _loss_sizes(problem: Problem, run: TransientSolution) -> Array:
    """Return the radii or half-widths of the faces below which energy was stored that is lost now, (n,), m."""
    # What a dent releases that recovers below a shrinking contact, or after it, is not released on less and less.
    found = contact_sizes(problem, run)
    stored = np.maximum(run.stored, 0.0)
    entered = np.maximum(np.diff(run.work), 0.0)
    way = np.hypot(*np.diff(run.position, axis=0).T)
    for row, (old, new, moved) in enumerate(zip(stored[:-1], entered, way, strict=True), start=1):
        wider = max(found[row - 1] - moved - found[row], 0.0)
        if old > 0.0:
            found[row] += wider * old / (old + new)
    return found


def _heats(run: TransientSolution, heating: Heating) -> tuple[Array, Array]:
    """Return Coulomb heat and loss since the start; what a jump releases counts after it."""
    way = np.hypot(*np.diff(run.position, axis=0).T)
    load = 0.5 * (run.load[1:] + run.load[:-1])
    coulomb = np.concatenate([[0.0], heating.coulomb * load * way])
    loss = np.concatenate([[0.0], np.maximum(np.diff(run.dissipated), 0.0)])
    for row in np.flatnonzero(np.diff(run.time) == 0.0) + 1:
        if row + 1 < len(loss):
            loss[row + 1] += loss[row]
            loss[row] = 0.0
    return np.cumsum(coulomb), np.cumsum(loss)


def _error(
    problem: Problem,
    run: TransientSolution,
    heating: Heating,
    heats: tuple[Array, Array],
    rises: tuple[Array, Array],
    change: Array,
) -> Array:
    """Return the error of the rise, given also its part by the loss, and by how many decades α is off; (n,)."""
    # By how much it changes with every other time left out, interpolated, by the errors of the heat, and of its place.
    rise, by_loss = rises
    unsure = np.divide(run.errors.energy, run.dissipated, out=np.zeros_like(rise), where=run.dissipated > 0.0)
    rows = np.unique(np.append(np.arange(0, len(run.time), 2), len(run.time) - 1))
    halves = np.abs(_answered(_rise(problem, run, heating, heats, rows), heating)[0] - rise[rows])
    halved = np.interp(np.arange(len(run.time)), rows, halves)
    # The loss raises the temperature by no more than both: of `by_loss` the counterface takes a part.
    lossy = np.minimum(np.abs(by_loss), np.abs(rise))
    placed = _OF_LOSS * lossy + (_OF_FACE if heating.average == "contact" else _OF_LOSS) * (np.abs(rise) - lossy)
    return np.asarray(halved + _STEEPEST * np.maximum.accumulate(change) * np.abs(rise) + unsure * lossy + placed)


def _uncertain(log10_shift: Callable[[Array], Any], around: Array, heated: TransientHeating) -> tuple[Note, ...]:
    """Return a note where the error of the rise may change friction more than its own error says."""
    rise, error = heated.temperature_rise, heated.error
    decades = np.asarray(log10_shift(around + rise)) - np.asarray(log10_shift(around + np.maximum(rise - error, 0.0)))
    row = int(np.argmax(np.abs(decades)))
    part = _STEEPEST * abs(float(decades[row]))
    if part <= _FELT:
        return ()
    said = (
        f"The rise of temperature is up to {rise[row]:.2g} ± {error[row]:.2g} K, whose error may change friction by "
        f"up to {100.0 * part:.2g} %; the error stated for friction does not include it."
    )
    return (Note("rise-uncertain", said, values={"severity": part, "rise_error": float(error[row])}),)


def _rows(grid: Sequence[float], times: Sequence[float]) -> list[int]:
    """Return the rows of times; of one at a jump, given once, the row after it."""
    wanted: list[int] = []
    for place, time in enumerate(times):
        twice = place + 1 < len(times) and times[place + 1] == time
        first = grid.index(time)
        wanted.append(first if twice else first + grid.count(time) - 1)
    return wanted
