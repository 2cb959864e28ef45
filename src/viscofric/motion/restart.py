"""Going on from where a run has ended: what must be the same, and the states on the springs of the longer history."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, cast

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.indenters.indenter import Indenter
from viscofric.errors import InputError
from viscofric.motion.chains import Pair, Reached, Track
from viscofric.motion.free.stored import Basis, Level
from viscofric.motion.history import History
from viscofric.motion.memory import Modes
from viscofric.motion.mover import Mover, Problem
from viscofric.motion.normal import NormalMotion, SpringState
from viscofric.motion.springs import both_sides, profile

# Relative difference that is rounding: of values, and of modes that may have been fitted on another machine.
_ROUNDING, _FITTED = 1e-9, 1e-6


class Begun(NamedTuple):
    """A march that may be continued."""

    track: Track[Any]  # all that it has found, with the states that it has reached
    basis: Array | Modes | Basis  # places of the springs, modes of the waves, or units, modes and grid of the cells
    all_steps: bool = True  # whether they have returned all steps, or certain times


@dataclass(frozen=True, eq=False)
class Restart:
    """A run from which another one goes on."""

    method: str  # "springs", "waves" or "grid"
    history: History
    marches: tuple[Begun, ...]  # one; on cells those of the last two grids, the finer one last
    same: Mapping[str, Array]  # numbers of the material and the contact, by name, that must be the same

    @classmethod
    def of(cls, problem: Problem, history: History, method: str, mover: Mover[Any], track: Track[Any]) -> Restart:
        """Return what a march leaves."""
        basis = mover.s if isinstance(mover, NormalMotion) else mover.merged  # type: ignore[attr-defined]
        return cls(method, history, (Begun(track, basis),), _same(problem, basis))

    @classmethod
    def on_cells(cls, problem: Problem, history: History, levels: Sequence[Level], *, all_steps: bool) -> Restart:
        """Return what marches on grids leave, which have returned all steps or certain times."""
        marches = tuple(Begun(one.track, one.basis, all_steps) for one in levels)
        return cls("grid", history, marches, _same(problem, marches[0].basis))

    @property
    def track(self) -> Track[Any]:
        """The only march, or that on the finest grid."""
        return self.marches[-1].track

    @property
    def reached(self) -> Reached[Any]:
        """The farthest state of all marches."""
        return max((one.track.reached for one in self.marches), key=lambda one: (one.time is not None, one.time))

    def insist_on_same(self, problem: Problem) -> None:
        """Raise `InputError` where the contact or the past differs from that of the run."""
        for name, value in _same(problem, self.marches[0].basis).items():
            old = self.same[name]
            near = _FITTED if name == "material" else _ROUNDING
            if old.shape != value.shape or not np.allclose(old, value, rtol=near, atol=0.0):
                raise InputError(
                    f"resume: the {name} differs from that of the run; a run goes on with all but the rest of its "
                    "history as it was.",
                    code="not-the-same",
                )
        now, then = problem.schedule, self.history.schedule(problem.material, problem.kind)
        reached = self.reached
        end = then.start if reached.time is None else reached.time
        if now.control != then.control or now.before != then.before or now.start != then.start or now.end < end:
            raise _other_past(now.start)
        for time in np.union1d(now.kinks, then.kinks):
            for after in (False, True):
                if time < end or (time == end and (reached.jumped or not after)):
                    one, two = (_row(each.at(float(time), after=after)) for each in (now, then))
                    scale = np.array([max(then.largest, now.largest, 1e-300), *2 * [np.abs(two[1:3]).max()], two[3]])
                    if np.any(np.abs(one - two) > _ROUNDING * scale):
                        raise _other_past(float(time))

    def mover(self, problem: Problem) -> tuple[Mover[Any], Reached[Any]]:
        """Return the mover of the longer history, and the states on its springs."""
        reached = self.track.reached
        if self.method == "waves":
            return _seen(self._waves(problem), reached)
        fresh, s = NormalMotion.of(problem), cast("Array", self.marches[0].basis)
        if np.array_equal(fresh.s, s):
            return _seen(fresh, reached)
        states = [link.state for link in reached.pair]
        touched = [np.flatnonzero((one.force > 0.0) | one.memory.any(axis=1)) for one in states]
        kept = 1 + max((int(one[-1]) for one in touched if len(one)), default=0)
        # beyond those that were touched, as many as a larger contact needs
        places = np.concatenate([s[:kept], fresh.s[fresh.s > s[kept - 1] + 0.5 * fresh.spacing]])
        mover = replace(fresh, s=places, g=profile(fresh.indenter, places), weights=both_sides(places))
        links = [link._replace(state=_padded(link.state, kept, mover)) for link in reached.pair]
        return _seen(mover, replace(reached, pair=Pair(*links)))

    def levels(self, problem: Problem, times: Sequence[float] | None) -> tuple[Problem, list[Level]]:
        """Return the problem of the longer history with the kinks of the run, and its marches on grids."""
        from viscofric.motion.free.setting import Setting, with_fewer_kinks
        from viscofric.motion.free.stored import level_of

        self._insist_on_times(times)
        end = float(self.reached.time)  # type: ignore[arg-type]
        now = with_fewer_kinks(problem.schedule, problem.accuracy)
        then = with_fewer_kinks(self.history.schedule(problem.material, problem.kind), problem.accuracy).kinks
        kinks = np.concatenate([then[then < end], now.kinks[now.kinks >= end]])
        problem = replace(problem, schedule=replace(now, kinks=kinks))
        setting = Setting.of(problem, Modes.of(problem.schedule.spectrum))
        levels = []
        for track, basis, _ in self.marches:
            level = level_of(problem, setting, cast("Basis", basis), track)
            mover, held = level.mover, level.mover.setting.modes
            setting = setting.in_units_of(mover.setting)
            here = setting.shortest_time(mover.grid.spacing, times), setting.longest_time
            held = replace(held, error=_merged(held, problem, *here))
            mover.setting = mover.setting.with_modes(held, problem)
            levels.append(replace(level, track=replace(track, reached=_seen(mover, track.reached)[1])))
        return problem, levels

    def _insist_on_times(self, times: Sequence[float] | None) -> None:
        """Refuse other times than those of the run where only its coarser grid has come to."""
        (coarse, _, all_steps), fine = self.marches[0], self.track.reached
        between = [one for one in times or () if fine.told < one <= (coarse.reached.time or 0.0)]
        known = {one.instant.time for one in coarse.moments}
        if coarse is not self.track and not all_steps and (times is None or {*between} - known):
            raise InputError(
                "times: differ from those of the run, whose coarser grid has passed them; ask for the same.",
                code="other-times",
            )

    def _waves(self, problem: Problem) -> Mover[Any]:
        from viscofric.motion.periodic import PeriodicMover
        from viscofric.motion.wave_memory import resolved_times

        held = cast("Modes", self.marches[0].basis)
        return PeriodicMover(problem, replace(held, error=_merged(held, problem, *resolved_times(problem))))


def _merged(held: Modes, problem: Problem, shortest: float, longest: float) -> float:
    """Return the error by merged modes over a longer history; InputError if it is too large."""
    from viscofric.motion.wave_memory import MERGING

    off = held.difference(Modes.of(problem.schedule.spectrum), shortest, longest)
    if off > (1.0 + _FITTED) * MERGING * problem.accuracy:
        raise InputError(
            "resume: the run has merged modes of the material that matter in the longer history, which is slower or "
            "faster; solve the whole history from its start.",
            code="merged-modes",
        )
    return off if off > (1.0 + _FITTED) * held.error else held.error


def _seen(mover: Mover[Any], reached: Reached[Any]) -> tuple[Mover[Any], Reached[Any]]:
    """Return a mover and states with what it sees of them."""
    links = [link._replace(seen=mover.observe(link.state)) for link in reached.pair]
    return mover, replace(reached, pair=Pair(*links))


def _row(instant: Any) -> Array:
    value = next(one for one in instant[3:] if one is not None)
    return np.array([value, *instant.position, instant.clock])


def _other_past(time: float) -> InputError:
    return InputError(
        f"resume: the history differs from that of the run at time {time:g} s; give the whole history, the part that "
        "is known as it was.",
        code="not-the-same",
    )


def _same(problem: Problem, basis: Array | Modes | Basis) -> dict[str, Array]:
    """Return the numbers by which a contact is known."""
    spectrum, layer, indenter = problem.schedule.spectrum, problem.layer, problem.indenter
    found = {
        "accuracy": np.array([problem.accuracy]),
        "material": np.concatenate([[spectrum.E_inf, problem.material.poisson_ratio], spectrum.C, spectrum.tau]),
        "layer": np.array([] if layer is None else [float(layer.thickness), float(layer.bonded)]),
        "modulus of the indenter": np.array([problem.counterface]),
    }
    if isinstance(basis, Modes):
        return found | {"surface": np.append(indenter.z.ravel(), indenter.spacing)}  # type: ignore[union-attr]
    if isinstance(basis, np.ndarray):
        return found | {"indenter": profile(indenter, basis)}  # type: ignore[arg-type]
    return found | {"indenter": _heights(indenter, basis.units[0])}  # type: ignore[arg-type]


def _heights(indenter: Indenter, length: float) -> Array:
    """Return the height of an indenter at places up to a distance from its axis, m."""
    angle = 0.1 + np.pi * np.arange(8) / 4.0
    distance = length * np.array([[0.25], [0.5], [0.75], [1.0]])
    return np.asarray(indenter.height(distance * np.cos(angle), distance * np.sin(angle)), dtype=float).ravel()


def _padded(state: SpringState, kept: int, mover: NormalMotion) -> SpringState:
    """Return a state with springs beyond those that were touched."""
    more = len(mover.s) - kept
    memory = np.concatenate([state.memory[:kept], np.zeros((more, state.memory.shape[1]))])
    threshold = np.concatenate([state.threshold[:kept], mover.g[kept:]])
    return replace(state, force=np.append(state.force[:kept], np.zeros(more)), memory=memory, threshold=threshold)
