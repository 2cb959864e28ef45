"""The periodic state of a contact under a repeated history, found without marching through the transient.

Over a period a mode's delayed pressure becomes q(T) = e^z q(0) + c, with z = −T/τ (+ iq·Δs of a wave that the indenter
passes), and c depends on the pressures of the period only.  If these did not change, the periodic state would be
q* = q(0) + [q(T) − q(0)]/(1 − e^z), for all modes at once, however slow.  They change with the state, so the formula
is iterated with Anderson acceleration [1]_ to convergence.

.. [1] D. G. Anderson, J. ACM 12 (1965) 547, doi:10.1145/321296.321305.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscofric.arguments import insist_on_function, whole_number
from viscofric.arrays import Array
from viscofric.contact.bodies import Layer, checked_coulomb
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.errors import ConvergenceError, InputError
from viscofric.motion.chains import Link, Pair, Reached, Track
from viscofric.motion.cycle_solution import CycleSolution
from viscofric.motion.history import History
from viscofric.motion.march import INSTANT, march
from viscofric.motion.mover import Mover
from viscofric.motion.period import Found, Period, Watch, Watched
from viscofric.motion.schedule import Schedule
from viscofric.motion.shear import with_coulomb
from viscofric.motion.solve import assemble, checked_problem, checked_times, mover_or_grid
from viscofric.notes import Remedy
from viscofric.rheology.material import Material
from viscofric.threads import one_blas_thread
from viscofric.units import Quantities, Quantity, number

# Allowed distance from the periodic state, relative to the accuracy, in the norm of the stored energy.
_CLOSE = 0.3
# Accuracy of a period far from the periodic state: this part of the distance, and at most so many times the accuracy.
_ROUGH, _ROUGHEST = 0.3, 10.0
# Earlier iterations that the acceleration uses.
_KEPT = 10
# Relative difference between the ends of a period that counts as rounding.
_ROUNDING = 1e-9


@one_blas_thread
def solve_cycle(
    material: Material,
    indenter: Indenter | PeriodicSurface,
    one_period: History,
    *,
    times: Quantities | None = None,
    accuracy: Quantity = 1e-3,
    layer: Layer | Quantity | None = None,
    indenter_modulus: Quantity | None = None,
    indenter_poisson_ratio: float = 0.3,
    coulomb: Quantity = 0.0,
    most_periods: int = 60,
    progress: Callable[[int, float], object] | None = None,
) -> CycleSolution:
    """Solve the periodic state of a contact under a repeated history.

    Parameters
    ----------
    material : Material
        A table of moduli is replaced by retardation modes fitted to it.
    indenter : Indenter or PeriodicSurface
    one_period : History
        History of load or depth, path and temperature over one period.  It must end as it begins, except for the
        position of a periodic surface.
    times : (m,) array of float, str or pint.Quantity, optional
        Times to return, ascending, within the period, s, with their pressures.  All steps without pressures if omitted.
    accuracy : float or str
        As for `solve_transient`; also the accuracy of the periodic state, in stored energy.
    layer, indenter_modulus, indenter_poisson_ratio : optional
        As for `solve_transient`.
    coulomb : float or str
        As for `solve_transient`; the mean friction is without it.
    most_periods : int
        Maximum number of periods.
    progress : callable, optional
        Called after each period with the number of periods and the relative distance from the periodic state.

    Returns
    -------
    CycleSolution

    Raises
    ------
    InputError
        If a value cannot be used, or the history does not end as it begins.
    ConvergenceError
        If the periodic state is not reached to the accuracy within `most_periods`, or the accuracy in time is not
        reached.

    Notes
    -----
    In a sliding motion the shear of Coulomb friction changes friction and energy per cycle; for strokes much longer
    than the contact by as much as `solve_steady` with `coulomb`, at the same speed.

    Examples
    --------
    Oscillating indentation, as in a dynamic indentation test:

    >>> import numpy as np
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")
    >>> phase = np.linspace(0.0, 2.0 * np.pi, 49)
    >>> period = vf.motion.History(time=phase / 100.0, indentation=1e-4 + 3e-6 * np.sin(phase))
    >>> cycle = vf.motion.solve_cycle(rubber, vf.Ball("10 mm"), period)
    >>> print(f"{cycle.storage_stiffness:.0f} ± {cycle.storage_stiffness_error:.0f} N/m")
    2903 ± 1 N/m
    >>> print(f"loss tangent {cycle.loss_tangent:.4f} ± {cycle.loss_tangent_error:.4f}")
    loss tangent 0.8153 ± 0.0005
    """
    if progress is not None:
        insist_on_function(progress, "progress")
    whole_number(most_periods, "most_periods", 1)
    coulomb, accuracy = checked_coulomb(coulomb), number(accuracy, "accuracy")
    problem = checked_problem(material, indenter, one_period, accuracy, layer, indenter_modulus, indenter_poisson_ratio)
    _insist_on_period(one_period, problem.kind)
    asked = checked_times(times, problem.schedule)
    search = _Search(_damping(problem.schedule), most_periods, progress)
    mover, method, notes = mover_or_grid(problem, one_period, asked)
    if mover is None:
        from viscofric.motion.free.solve import solve_free

        track, doubts, _ = solve_free(problem, asked, None, search.follow)
        notes = (*notes, *doubts)
    else:
        track = search.follow(mover, problem.schedule, accuracy=accuracy, times=asked)
    assert search.whole is not None
    assert search.found is not None
    # On cells, the track has the errors by the cells, which the whole period of one grid has not.
    run = assemble(track, problem, one_period, method, notes=notes)
    whole = run if asked is None else assemble(search.whole, problem, one_period, method, notes=notes)
    run, whole = (with_coulomb(problem, one, coulomb, whole) for one in (run, whole))
    return replace(CycleSolution.of(whole, search.found, problem.schedule.control, search.periods), run=run)


@dataclass(eq=False)
class _Search:
    """The search for the periodic state."""

    damping: float
    most_periods: int
    progress: Callable[[int, float], object] | None
    periods: int = 0
    change: float = np.inf
    whole: Track[Any] | None = None  # every step of the period in the periodic state
    found: Found | None = None
    coarser: tuple[Any, NDArray[Any]] | None = None  # mover on the grid before, and its memory

    def follow(
        self,
        repeating: Mover[Any],
        schedule: Schedule,
        *,
        accuracy: float,
        extrapolate: bool = False,
        times: Sequence[float] | None = None,
        progress: None = None,
    ) -> Track[Watched]:
        """Return one period in the periodic state."""
        mover: Any = Watch.of(repeating, schedule)
        # Before a jump at the start, which is a part of the period.
        first, last = (schedule.at(time, after=False) for time in (schedule.start, schedule.end))
        state = mover.begin()
        if schedule.before == "untouched":
            state = mover.step(state, first, first)
        if self.coarser is not None:
            state = mover.with_memory(state, repeating.memory_from(*self.coarser))
        mixing, plain = _Anderson(self.damping), 0
        period: Period | None = None
        for _ in range(self.most_periods):
            memory = mover.memory_of(state)
            # The instantaneous pressure that belongs to this memory.
            begun = mover.step(mover.with_memory(state, memory), first, first)
            begun = mover.settle(begun, first, INSTANT * (schedule.end - schedule.start))
            begun = mover.emptied(begun)
            link = Link(begun, mover.observe(begun), 0.0)
            begin = Reached(Pair(link, link))
            # Far from the periodic state a period need not be known better than the distance.
            rough = max(accuracy, min(_ROUGH * self.change, _ROUGHEST * accuracy)) if not plain else accuracy
            track = march(mover, schedule, accuracy=rough, fields=False, begin=begin, extrapolate=extrapolate)
            if track.interrupted:
                raise KeyboardInterrupt
            state, before, period = track.reached.pair.fine.state, period, Period.of(track)
            reached = mover.memory_of(state)
            if reached.shape != memory.shape:  # more cells have been in contact
                memory, mixing = mover.memory_of(begun), _Anderson(self.damping)
            change = mover.recovered(reached - memory, state, first, last)
            size = float(np.linalg.norm(reached))
            changed, self.change = self.change, float(np.linalg.norm(change)) / size if size > 0.0 else 0.0
            self.periods += 1
            if self.progress is not None:
                self.progress(self.periods, self.change)
            if self.change > _CLOSE * accuracy:
                plain, state = 0, mover.with_memory(state, mixing.next(memory, change))
                continue
            coarser = None if self.found is None else self.found.last
            found = before and Found(period, before, coarser, self.change, changed, accuracy)
            if found and (plain > 1 or (plain and found.repeats)):
                self.coarser, self.whole, self.found = (repeating, reached), track, found
                if times is None:
                    return track
                return march(mover, schedule, accuracy=accuracy, times=times, begin=begin, extrapolate=extrapolate)
            # A memory that was extrapolated does not fit the pressure: at a given depth its fast modes begin with a
            # glassy response.  The period that is returned goes on from the end of another one, and is compared with
            # one that does, too, if not with that.
            plain += 1
        raise ConvergenceError(
            f"no periodic state within {self.most_periods} periods: the memory is still {self.change:.2g} of its "
            "size away from it; ",
            code="not-repeating",
            remedy=Remedy(
                "allow more periods (most_periods=).",
                "leave out --cycle, and give a history of several periods.",
                "leave out cycle under [history], and give a history of several periods.",
                "give a history of several periods instead.",
            ),
        )


def _damping(schedule: Schedule) -> float:
    """Return the damping factor for a change of memory."""
    # Sliding at a given depth, pressures fall E_inf/E0 − 1 times as much as slow modes rise; damping prevents
    # overshoot.
    slides_at_depth = schedule.control in ("indentation", "gap") and not schedule.is_held
    return float(schedule.spectrum.E0 / schedule.spectrum.E_inf) if slides_at_depth else 1.0


def _insist_on_period(history: History, kind: str) -> None:
    columns = {history.control: getattr(history, history.control), "temperature": history.temperature}
    if kind != "periodic":
        columns["position"] = history.position
    for name, values in columns.items():
        if values is None:
            continue
        away = float(np.max(np.abs(values[-1] - values[0])))
        if away > _ROUNDING * float(np.ptp(values, axis=0).max()):
            raise InputError(
                f"one_period: {name} ends {away:.3g} (SI) away from where it begins; a period ends as it begins.",
                code="not-a-period",
            )


class _Anderson:
    """Combines the latest iterations so that their changes cancel as well as possible."""

    def __init__(self, damping: float) -> None:
        self._damping = damping
        self._points: list[Array] = []
        self._changes: list[Array] = []

    def next(self, point: NDArray[Any], change: NDArray[Any]) -> NDArray[Any]:
        """Return the next point of an iteration x ← x + λ f(x), with the damping λ."""
        x, f = _flat(point), _flat(change)
        self._points = [*self._points[-_KEPT:], x]
        self._changes = [*self._changes[-_KEPT:], f]
        found = x + self._damping * f
        if len(self._points) > 1:
            moved = np.diff(np.array(self._points), axis=0)
            differences = np.diff(np.array(self._changes), axis=0)
            weights = np.linalg.lstsq(differences.T, f, rcond=1e-8)[0]
            found = found - weights @ (moved + self._damping * differences)
        return found.view(point.dtype).reshape(point.shape)


def _flat(values: NDArray[Any]) -> Array:
    return np.ascontiguousarray(values).reshape(-1).view(np.float64)
