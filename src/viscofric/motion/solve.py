"""Solve a contact through a history of load or depth, path and temperature."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise
from os import PathLike
from typing import Any

import numpy as np
import scipy.fft

from viscofric.arguments import insist_on, insist_on_function
from viscofric.arrays import Array
from viscofric.contact.bodies import (
    LITTLE_INERTIA,
    Layer,
    checked_coulomb,
    indenter_compliance,
    inertia_notes,
    lag_of_waves,
    shear_wave_speed,
    waves_notes,
)
from viscofric.contact.free.grids import Extent
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.periodic.solve import beyond_measured, too_fast
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.contact.periodic.transfer import SlidingSolid, dissipation, losses
from viscofric.errors import InputError, wrong_argument
from viscofric.heat.heating import Heating
from viscofric.motion.chains import Moment, Track
from viscofric.motion.free.stored import Level
from viscofric.motion.history import History
from viscofric.motion.march import march
from viscofric.motion.mover import Mover, Problem
from viscofric.motion.restart import Restart
from viscofric.motion.schedule import Schedule
from viscofric.motion.shear import with_coulomb
from viscofric.motion.solution import TransientErrors, TransientSolution
from viscofric.notes import Note
from viscofric.rheology.material import Material, insist_on_material
from viscofric.threads import one_blas_thread
from viscofric.units import Quantities, Quantity, number, plain, to_si_array

TIGHTEST, LOOSEST = 1e-8, 0.1  # accuracies
_ROUNDING = 1e-12  # of times, relative to an end of the history
_LITTLE = 0.01  # part of the largest load, below which a rate of loading is of no consequence
_RATE = "rate of loading or 1/t after a jump"
_AGAIN = Note(
    "solved-again",
    "The run that is continued was a normal motion, and its continuation slides: its past is solved again, on cells.",
)
_RING = Note(
    "not-one-disc",
    "The profile of the indenter does not rise all the way outwards, so that its contact may be a ring: it was solved "
    "on cells.",
)


@one_blas_thread
def solve_transient(
    material: Material,
    indenter: Indenter | PeriodicSurface,
    history: History,
    *,
    times: Quantities | None = None,
    accuracy: Quantity = 1e-3,
    layer: Layer | Quantity | None = None,
    indenter_modulus: Quantity | None = None,
    indenter_poisson_ratio: float = 0.3,
    progress: Callable[[float, float], object] | None = None,
    resume: TransientSolution | str | PathLike[str] | None = None,
    heating: Heating | None = None,
    coulomb: Quantity = 0.0,
) -> TransientSolution:
    """Solve a contact through a history of load or depth, path and temperature.

    Parameters
    ----------
    material : Material
        A table of moduli is replaced by retardation modes fitted to it.
    indenter : Indenter or PeriodicSurface
    history : History
    times : (m,) array of float, str or pint.Quantity, optional
        Times to return, ascending, within the history (to 1e-12 of it), s; they are met exactly.  All steps if omitted.
    accuracy : float or str
        Largest error of load, indentation, friction force and energy in time, relative to their largest values so far.
    layer : Layer, float, str or pint.Quantity, optional
        Thickness and base of the material, or the thickness of a bonded layer, such as ``"2 mm"``; a half-space if
        omitted.
    indenter_modulus : float, str or pint.Quantity, optional
        Young's modulus of an elastic indenter, Pa; rigid if omitted.
    indenter_poisson_ratio : float
        Of an elastic indenter.
    progress : callable, optional
        Called with the time reached and the last time, s.  Contacts on cells are solved on several grids; the time is
        then the part of all the work.
    resume : TransientSolution or path, optional
        Run to continue, or the file that its `TransientSolution.save_state` wrote: an interrupted run, or one whose
        history is the beginning of this history.  The results equal those of one uninterrupted run, and include
        those of the earlier one; for a longer history on cells, to the stated errors.
        Where a normal motion goes on by sliding, its past is solved again on cells, and a note says so.
    heating : Heating, optional
        Thermal properties and Coulomb heat: the rubber responds at the temperature of the history plus a mean rise
        (`Heating.average`), which the solution's `heating` holds.  In three or four runs, at some sixty times and those
        asked for.  Not with a layer, a rough surface, `resume` or steady sliding before.
    coulomb : float or str
        Coulomb friction coefficient of a sliding contact, for `TransientSolution.total`; that of `heating`, if given.
        The contact is solved without its shear; the note `tangential-coupling` has the change of friction by it, if
        above 5 %.

    Returns
    -------
    TransientSolution

    Raises
    ------
    InputError
        If a value cannot be used, or the contact would be wider than the indenter.
    DataFileError
        If `resume` is a file that is not the state of a run.
    ConvergenceError
        If the accuracy is not reached.

    Notes
    -----
    The normal motion of a body of revolution is solved by the method of dimensionality reduction [1]_, a row of
    springs with the memory of the material, which is exact in all histories if the profile of the springs rises
    outwards: the contact is then one disc at all times.  If it does not, the contact is solved on cells, and a note
    says so.

    Sliding contacts, contacts on layers and those of other indenters are solved on cells that are fixed to the body, on
    finer and finer grids.  An indenter moves by whole cells wherever it can.  Friction follows the steps of the speed
    along a path given by positions: give a smooth path by many positions, or by speeds.  A line contact on a
    half-space has no absolute indentation.  Of one that has rested or slid, the change since the start is given; of
    any other, the depth below points at a distance that a note names.  Its accuracy is relative to the largest value,
    or to a fiftieth of the indentation a²/R if that is more.  Without `times`, the first steps after a start or
    a reversal, in which the contact moves by less than one cell, may have errors above the accuracy; `errors` holds
    them.

    References
    ----------
    .. [1] V. L. Popov, M. Heß, Method of Dimensionality Reduction in Contact Mechanics and Friction, Springer 2015.

    Examples
    --------
    Creep under a load put on at once, a³ = (3/4)(1 − ν²) R F J(t) (E. H. Lee, J. R. M. Radok, 1960):

    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")
    >>> step = vf.motion.History(time=[0.0, 0.1], load="1 N")
    >>> run = vf.motion.solve_transient(rubber, vf.Ball("10 mm"), step, times=["1 ms", "10 ms", "100 ms"])
    >>> (1e3 * run.contact_radius).round(3).tolist()
    [1.015, 1.555, 1.778]
    """
    insist_on_function(progress, "progress")
    accuracy, coulomb = number(accuracy, "accuracy"), checked_coulomb(coulomb)
    problem = checked_problem(material, indenter, history, accuracy, layer, indenter_modulus, indenter_poisson_ratio)
    asked = checked_times(times, problem.schedule)
    if heating is not None:
        if resume is not None:
            raise InputError("heating: not with resume; solve the whole history at once.", code="not-with-heating")
        if coulomb != 0.0:
            raise InputError("coulomb: not with heating, which has its own; leave it out.", code="not-with-heating")
        from viscofric.motion.heated import solve_heated

        def solve(
            one: History, at: Sequence[float], told: Callable[[float, float], object] | None
        ) -> TransientSolution:
            found: TransientSolution = solve_transient(
                material, indenter, one, times=np.asarray(at), accuracy=accuracy, indenter_modulus=indenter_modulus,
                indenter_poisson_ratio=indenter_poisson_ratio, progress=told,
            )  # fmt: skip
            return found

        return solve_heated(problem, history, heating, asked, solve, progress)
    found = _solved(problem, history, asked, progress, resume)
    return with_coulomb(problem, found, coulomb)


def _solved(
    problem: Problem,
    history: History,
    asked: list[float] | None,
    progress: Callable[[float, float], object] | None,
    resume: TransientSolution | str | PathLike[str] | None,
) -> TransientSolution:
    if resume is not None:
        return _resumed(resume, problem, history, asked, progress)
    mover, method, notes = mover_or_grid(problem, history, asked)
    if mover is None:
        return _on_cells(problem, history, asked, progress, notes)
    track = march(mover, problem.schedule, accuracy=problem.accuracy, times=asked, progress=progress)
    found = assemble(track, problem, history, method)
    return replace(found, _restart=Restart.of(problem, history, method, mover, track))


def _on_cells(
    problem: Problem,
    history: History,
    times: list[float] | None,
    progress: Callable[[float, float], object] | None,
    notes: tuple[Note, ...],
    begun: Sequence[Level] = (),
) -> TransientSolution:
    from viscofric.motion.free.solve import solve_free

    track, doubts, levels = solve_free(problem, times, progress, begun=begun)
    found = assemble(track, problem, history, "grid", notes=(*notes, *doubts))
    return replace(found, _restart=Restart.on_cells(problem, history, levels, all_steps=times is None))


def _resumed(
    resume: TransientSolution | str | PathLike[str],
    problem: Problem,
    history: History,
    times: list[float] | None,
    progress: Callable[[float, float], object] | None,
) -> TransientSolution:
    """Go on with a run."""
    from viscofric.motion.restart_files import reached, read_restart

    if isinstance(resume, TransientSolution):
        restart = reached(resume._restart)
    elif isinstance(resume, (str, PathLike)):
        restart = read_restart(resume)
    else:
        raise wrong_argument("resume", resume, "must be a TransientSolution, or the file of its state.", "wrong-type")
    method, on_cells = restart.method, needs_grid(problem, history)
    if (method == "waves") != (problem.kind == "periodic"):
        raise InputError(
            "resume: this contact is not solved in the way of the run; solve the whole history from its start.",
            code="not-available",
        )
    restart.insist_on_same(problem)
    if method == "springs" and on_cells:
        if times is not None:
            known = Counter(one.instant.time for one in restart.track.moments)
            known |= Counter({time: 2 for time in known if problem.schedule.jumps_at(time)})  # before and after it
            times = sorted((known | Counter(times)).elements())
        return _on_cells(problem, history, times, progress, (_AGAIN,))
    if method == "grid":
        problem, levels = restart.levels(problem, times)
        return _on_cells(problem, history, times, progress, () if on_cells else (_RING,), levels)
    mover, begin = restart.mover(problem)
    track = march(mover, problem.schedule, accuracy=problem.accuracy, times=times, progress=progress, begin=begin)
    track = restart.track.joined(track)
    found = assemble(track, problem, history, method)
    return replace(found, _restart=Restart.of(problem, history, method, mover, track))


def checked_problem(
    material: Material,
    indenter: Indenter | PeriodicSurface,
    history: History,
    accuracy: float,
    layer: Layer | Quantity | None,
    indenter_modulus: Quantity | None,
    indenter_poisson_ratio: float,
) -> Problem:
    """Return the problem that the arguments of `solve_transient` describe; InputError where one cannot be used."""
    insist_on_material(material)
    right = "an indenter, such as Ball(radius='10 mm'), or a PeriodicSurface"
    insist_on(indenter, "indenter", Indenter, PeriodicSurface, right=right)
    insist_on(history, "history", History, right="a History, such as History(time=[0, 1], load='1 N')")
    if not TIGHTEST <= accuracy <= LOOSEST:
        raise wrong_argument(
            "accuracy", accuracy, f"must be a number from {TIGHTEST:g} to {LOOSEST:g}, such as 1e-3.", "out-of-range"
        )
    kind = "periodic" if isinstance(indenter, PeriodicSurface) else ("line", "point")[indenter.geometry.dimension - 1]
    schedule = history.schedule(material, kind)
    counterface = indenter_compliance(indenter_modulus, indenter_poisson_ratio)
    return Problem(material, indenter, schedule, accuracy, Layer.of(layer), counterface)


def mover_or_grid(
    problem: Problem, history: History, times: Sequence[float] | None
) -> tuple[Mover[Any] | None, str, tuple[Note, ...]]:
    """Return the mover for this contact, or None if it is solved on cells; the name of the method, and notes."""
    if isinstance(problem.indenter, PeriodicSurface):
        from viscofric.motion.periodic import PeriodicMover

        return PeriodicMover(problem, times=times or ()), "waves", ()
    if needs_grid(problem, history):
        return None, "grid", ()
    from viscofric.motion.normal import NormalMotion

    try:
        return NormalMotion.of(problem), "springs", ()
    except InputError as error:
        if error.code != "not-one-disc":
            raise
        return None, "grid", (_RING,)


def needs_grid(problem: Problem, history: History) -> bool:
    """Return whether a contact is solved on cells: a free one that slides, on a layer, or not of revolution."""
    from viscofric.motion.springs import is_body_of_revolution

    indenter = problem.indenter
    if not isinstance(indenter, Indenter):
        return False
    return history.moves or problem.layer is not None or not is_body_of_revolution(indenter)


def checked_times(times: Quantities | None, schedule: Schedule) -> list[float] | None:
    """Return the times asked for, s; InputError where they cannot be met."""
    if times is None:
        return None
    seconds = to_si_array(times, "s", "times")
    if not len(seconds) or np.any(np.diff(seconds) < 0.0):
        raise wrong_argument("times", times, "must be one or more times in ascending order.", "not-sorted")
    inside = np.clip(seconds, schedule.start, schedule.end)
    near = _ROUNDING * max(abs(schedule.start), abs(schedule.end))
    seconds = np.where(np.abs(seconds - inside) <= near, inside, seconds)
    for end in (schedule.start, schedule.end):  # such as 0.1 + 0.2 of a history up to 0.3
        seconds = np.where(np.abs(seconds - end) <= _ROUNDING * abs(end), end, seconds)
    if seconds[0] < schedule.start or seconds[-1] > schedule.end:
        outside = seconds[0] if seconds[0] < schedule.start else seconds[-1]
        raise InputError(
            f"times: {outside:g} s lies outside the history, {schedule.start:g} to {schedule.end:g} s.",
            code="out-of-range",
            values={"argument": "times"},
        )
    return [float(one) for one in seconds]


def assemble(
    track: Track[Any], problem: Problem, history: History, method: str, *, notes: tuple[Note, ...] = ()
) -> TransientSolution:
    """Return the solution of a march, with notes on its assumptions."""
    moments, schedule = track.moments, problem.schedule

    def column(value: Callable[[Moment[Any]], float]) -> Array:
        return np.array([value(one) for one in moments], dtype=float)

    def extent(name: str) -> Array | None:
        if not moments or name not in moments[0].seen.extents:
            return None
        return column(lambda one: one.seen.extents[name])

    x, y = history.direction
    stored, dissipated = column(lambda one: one.seen.stored), column(lambda one: one.seen.dissipated)
    work = column(lambda one: one.work)
    balance = work - (stored - track.stored) - dissipated
    errors = TransientErrors(
        load=column(lambda one: one.errors.load),
        indentation=column(lambda one: one.errors.depth),
        friction_force=column(lambda one: one.errors.friction),
        # Errors of an energy accumulate, even where the difference of the chains changes sign.  The balance shows those
        # of the dissipated energy that are not of second order: of springs and cells touched within a step.
        energy=np.maximum.accumulate(column(lambda one: one.errors.energy) + np.abs(balance)),
        balance=balance,
    )
    times = column(lambda one: one.instant.time)
    kelvin = None
    if history.temperature is not None:
        kelvin = np.array([schedule.temperature(time) for time in times], dtype=float)
    forces = np.array([one.seen.friction_force for one in moments], dtype=float).reshape(-1, 2)
    return TransientSolution(
        time=times,
        load=column(lambda one: one.seen.load),
        indentation=column(lambda one: one.seen.depth),
        position=np.array([one.instant.position for one in moments], dtype=float).reshape(-1, 2),
        temperature=kelvin,
        friction_force=forces @ np.array([x, y]),
        lateral_force=forces @ np.array([-y, x]),
        contact_area=column(lambda one: one.seen.area),
        contact_radius=extent("contact_radius"),
        front=extent("front"),
        rear=extent("rear"),
        half_width=extent("half_width"),
        work=work,
        stored=stored,
        dissipated=dissipated,
        errors=errors,
        steps=track.steps,
        rejected_steps=track.rejected,
        interrupted=track.interrupted,
        method=method,
        geometry=problem.kind,
        direction=history.direction,
        warnings=(
            *_doubts(problem, moments),
            *_notes_on_speed(problem, moments),
            *notes,
            *problem.material.notes_on_modes,
            *problem.material.notes_at(kelvin),
        ),
        dent=extent("dent"),
        _fields=tuple(one.field for one in moments),
    )


def _doubts(problem: Problem, moments: list[Moment[Any]]) -> tuple[Note, ...]:
    """Refuse a contact wider than the indenter; return notes on large strain, adhesion and unresolved heights."""
    indenter, material = problem.indenter, problem.material
    if not isinstance(indenter, Indenter) or not moments:
        return ()

    def largest(*names: str) -> float:
        return max((one.seen.extents.get(name, 0.0) for name in names for one in moments), default=0.0)

    radius = largest("contact_radius")
    widest = Extent(max(radius, largest("rear")), max(radius, largest("front")), max(radius, largest("half_width")))
    if math.isinf(widest.side):  # of a line contact
        widest = widest._replace(side=0.0)
    load = max(one.seen.load for one in moments)
    indenter.check(widest, f"under {load:g} {indenter.geometry.load_unit}", problem.schedule.control)
    deepest = max(one.seen.depth for one in moments)
    return tuple(indenter.warnings(widest, deepest, load, problem.schedule.spectrum.E0, material.poisson_ratio))


def _notes_on_speed(problem: Problem, moments: list[Moment[Any]]) -> tuple[Note, ...]:
    """Return notes where a motion is faster than its material was measured, or too fast without inertia."""
    # Also between the moments, and where the material was not known at so low frequencies.
    schedule, times = problem.schedule, [one.instant.time for one in moments]
    known = schedule.spectrum.known_frequencies
    if not moments:
        return ()
    spans = list(pairwise([schedule.start, *times]))
    velocities = [schedule.fastest(*ends) for ends in spans]
    changes = [schedule.quickest_change(*ends) for ends in spans]
    with np.errstate(divide="ignore"):
        rates = np.maximum(changes, 1.0 / np.array([schedule.since_jump(one.instant) for one in moments]))
    load = np.abs([one.seen.load for one in moments])
    rates[load < _LITTLE * load.max()] = 0.0  # the first touch is always too quick, and of no consequence
    waves = _waves_of_loading(problem, moments, changes)
    if not np.any(velocities):
        return waves if known is None else (*known.beyond(rates, _RATE), *waves)
    speed = np.hypot(*np.transpose(velocities))
    real = [schedule.fastest(*ends, by_clock=False) for ends in spans]
    low, high = (0.0, math.inf) if known is None else known.frequency_range
    if isinstance(problem.indenter, PeriodicSurface):
        slow = known.beyond(np.where((rates < low) & (speed == 0.0), rates, 0.0), _RATE) if known else ()
        return (*slow, *_speed_on_waves(problem, problem.indenter, moments, velocities, real))
    extents = [one.seen.extents for one in moments]
    half = np.array(
        [0.5 * (one["front"] + one["rear"]) if "front" in one else one["contact_radius"] for one in extents]
    )
    rate = np.divide(speed, half, out=np.zeros_like(half), where=half > 0.0)
    slowest = np.maximum(rate, rates)
    unknown = np.where(rate > high, rate, np.where(slowest < low, slowest, 0.0))
    beyond = known.beyond(unknown, f"frequency v/a, or {_RATE}") if known else ()
    where = [f"at {time:.3g} s" for time in times]
    real_speed = np.hypot(*np.transpose(real))
    inertia = inertia_notes(real_speed, rate, schedule.spectrum, problem.material.poisson_ratio, where)
    return (*beyond, *inertia, *waves, *_waves_of_starts(problem, moments, half))


def _waves_of_starts(problem: Problem, moments: list[Moment[Any]], half: Array) -> tuple[Note, ...]:
    """Return a note if waves take long through a contact that starts or turns, beside the time to its largest force."""
    schedule, nu = problem.schedule, problem.material.poisson_ratio
    times = np.array([one.instant.time for one in moments])
    friction = np.array([math.hypot(*one.seen.friction_force) for one in moments])
    starts = list(filter(schedule.starts_at, schedule.kinks[:-1].tolist()))
    found = [(0.0, 0.0, 0.0)]
    for start, end in pairwise([*starts, math.inf]):
        rows = np.flatnonzero((times > start) & (times <= end) & (half > 0.0))
        place = int(rows[np.argmax(friction[rows])]) if len(rows) else -1
        if len(rows) and place < rows[-1]:  # else it goes on rising
            taken = times[place] - start
            frequency = 1.0 / (taken * schedule.rates(start, start)[0])
            waves = shear_wave_speed(float(np.abs(schedule.spectrum.complex_modulus(frequency))), nu)
            found.append((float(half[place] / waves / taken), waves, start))
    share, waves, start = max(found)
    if share <= LITTLE_INERTIA:
        return ()
    said = (
        f"Inertia of the rubber is left out. Shear waves in it run at {plain(waves, 2)} m/s through half of the "
        f"contact in {plain(100.0 * share, 2)} % of the time from the start or turn at {start:.3g} s to the "
        f"largest friction after it (good if ≤ {100.0 * LITTLE_INERTIA:.0f} %): that may be lower, and occur later."
    )
    return (Note("waves-after-start", said, values={"wave_speed": waves, "share": share, "time": start}),)


def _waves_of_loading(problem: Problem, moments: list[Moment[Any]], changes: list[float]) -> tuple[Note, ...]:
    """Return a note if the waves of a half-space change load or depth by much where these change fastest."""
    load, depth = (max(getattr(one.seen, name) for one in moments) for name in ("load", "depth"))
    place = int(np.argmax(changes))
    if problem.kind != "point" or problem.layer is not None or not (changes[place] > 0.0 and depth > 0.0):
        return ()
    rate, clock = changes[place], problem.schedule.rates(moments[place].instant.time, moments[place].instant.time)[0]
    modulus, nu = float(np.abs(problem.schedule.spectrum.complex_modulus(rate))), problem.material.poisson_ratio
    change = float(lag_of_waves(np.array(modulus), nu)) * load / depth * rate * clock
    said = f"waves change load or depth by about {plain(100.0 * change, 2)} % at {moments[place].instant.time:.3g} s"
    return waves_notes(change, modulus, nu, math.pi / (rate * clock), said)


def _speed_on_waves(
    problem: Problem, surface: PeriodicSurface, moments: list[Moment[Any]], velocities: list[Array], real: list[Array]
) -> tuple[Note, ...]:
    """Return notes on the pressures of the largest friction and inertia, as if they slid on at the speed of then.

    Velocities are per time of the material's clock, and per time.
    """
    schedule = problem.schedule
    moving = [
        (one, velocity, per_time, schedule.rates(one.instant.time, one.instant.time)[0])
        for one, velocity, per_time in zip(moments, velocities, real, strict=True)
        if one.field is not None and velocity.any() and np.any(one.seen.friction_force)
    ]
    if not moving:
        return ()

    def losses_of(one: Moment[Any], velocity: Array) -> tuple[PeriodicSurface, SlidingSolid, Array, float]:
        assert one.field is not None
        toward = tuple((velocity / math.hypot(*velocity)).tolist())
        material, layer, along = problem.material, problem.layer, tuple(velocity.tolist())
        solid = SlidingSolid(schedule.spectrum, material.poisson_ratio, along, layer, problem.counterface, toward)
        lost = losses(
            solid.transfer(surface.shape, surface.spacing), surface.shape, scipy.fft.rfft2(one.field.pressure)
        )
        return surface, solid, lost, float(dissipation(lost, surface.shape, surface.spacing) @ toward)

    friction = np.array([math.hypot(*one.seen.friction_force) for one, *_ in moving])
    hardest, velocity, *_ = moving[int(np.argmax(friction))]
    # Where temperature changes, the rubber may have more inertia at a lower reduced speed.
    speeds, clocks = np.array([math.hypot(*one[2]) for one in moving]), np.array([one[3] for one in moving])
    softness = np.abs(schedule.spectrum.compliance(2.0 * math.pi / max(surface.period) * speeds / clocks))
    one, _, per_time, clock = moving[int(np.lexsort((friction, speeds**2 * softness))[-1])]
    lost = losses_of(one, per_time / clock)
    notes = too_fast(*lost, clock=clock, where=f"at {one.instant.time:.3g} s")
    same = one is hardest and np.array_equal(velocity, per_time / clock)
    return (*beyond_measured(*(lost if same else losses_of(hardest, velocity))), *notes)
