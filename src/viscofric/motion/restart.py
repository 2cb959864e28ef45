"""Going on from where a run has ended: what must be the same, and the states on the springs of the longer history."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.errors import InputError
from viscofric.motion.chains import Pair, Reached, Track
from viscofric.motion.memory import Modes
from viscofric.motion.normal import NormalMotion, SpringState
from viscofric.motion.springs import both_sides, profile

if TYPE_CHECKING:
    from collections.abc import Mapping

    from viscofric.arrays import Array
    from viscofric.motion.history import History
    from viscofric.motion.mover import Mover
    from viscofric.motion.problem import Problem

# Relative difference that is rounding: of values, and of modes that may have been fitted on another machine.
_ROUNDING, _FITTED = 1e-9, 1e-6
# Numbers of modes.
_NUMBERS = ("instantaneous", "at_once", "error")


@dataclass(frozen=True, eq=False)
class Restart:
    """A run from which another one goes on.

    Attributes
    ----------
    method : str
        "springs" or "waves".
    history : History
    track : Track
        All that it has found, with the states that it has reached.
    same : mapping
        Numbers of the material and the contact, by name, that must be the same.
    basis : mapping
        Places of the springs, or modes of the waves.
    """

    method: str
    history: History
    track: Track[Any]
    same: Mapping[str, Array]
    basis: Mapping[str, Array]

    @classmethod
    def of(cls, problem: Problem, history: History, method: str, mover: Mover[Any], track: Track[Any]) -> Restart:
        """Return what a march leaves."""
        if isinstance(mover, NormalMotion):
            basis = {"s": mover.s}
        else:
            modes: Modes = mover.merged  # type: ignore[attr-defined]
            basis = {"C": modes.C, "tau": modes.tau}
            basis |= {one: np.array(getattr(modes, one)) for one in _NUMBERS}
        return cls(method, history, track, _same(problem, basis), basis)

    def insist_on_same(self, problem: Problem) -> None:
        """Raise `InputError` where the contact or the past differs from that of the run."""
        for name, value in _same(problem, self.basis).items():
            old = self.same[name]
            near = _FITTED if name == "material" else _ROUNDING
            if old.shape != value.shape or not np.allclose(old, value, rtol=near, atol=0.0):
                raise InputError(
                    f"resume: the {name} differs from that of the run; a run goes on with all but the rest of its "
                    "history as it was.",
                    code="not-the-same",
                )
        now, then = problem.schedule, self.history.schedule(problem.material, problem.kind)
        reached = self.track.reached
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
        fresh, s = NormalMotion.of(problem), self.basis["s"]
        if np.array_equal(fresh.s, s):
            return _seen(fresh, reached)
        states = [link.state for link in reached.pair]
        touched = [np.flatnonzero((one.force > 0.0) | one.memory.any(axis=1)) for one in states]
        kept = 1 + max((int(one[-1]) for one in touched if len(one)), default=0)
        places = _extended(s[:kept], fresh)
        mover = replace(fresh, s=places, g=profile(fresh.indenter, places), weights=both_sides(places))
        links = [link._replace(state=_padded(link.state, kept, mover)) for link in reached.pair]
        return _seen(mover, replace(reached, pair=Pair(*links)))

    def joined(self, track: Track[Any]) -> Track[Any]:
        """Return all that both runs have found."""
        first = self.track
        return Track(
            [*first.moments, *track.moments],
            first.steps + track.steps,
            first.rejected + track.rejected,
            track.interrupted,
            track.reached,
            first.stored,
        )

    def _waves(self, problem: Problem) -> Mover[Any]:
        from viscofric.motion.periodic import PeriodicMover
        from viscofric.motion.wave_memory import MERGING, resolved_times

        one = self.basis
        # Runs stored by older versions have no error.
        held = Modes(C=one["C"], tau=one["tau"], **{name: float(one.get(name, 0.0)) for name in _NUMBERS})
        off = held.difference(Modes.of(problem.schedule.spectrum), *resolved_times(problem))
        if off > (1.0 + _FITTED) * MERGING * problem.accuracy:
            raise InputError(
                "resume: the run has merged modes of the material that matter in the longer history, which is slower "
                "or faster; solve the whole history from its start.",
                code="merged-modes",
            )
        return PeriodicMover(problem, replace(held, error=max(held.error, off)))


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


def _same(problem: Problem, basis: Mapping[str, Array]) -> dict[str, Array]:
    """Return the numbers by which a contact is known."""
    spectrum, layer, indenter = problem.schedule.spectrum, problem.layer, problem.indenter
    found = {
        "accuracy": np.array([problem.accuracy]),
        "material": np.concatenate([[spectrum.E_inf, problem.material.poisson_ratio], spectrum.C, spectrum.tau]),
        "layer": np.array([] if layer is None else [float(layer.thickness), float(layer.bonded)]),
        "modulus of the indenter": np.array([problem.counterface]),
    }
    if "s" not in basis:
        return found | {"surface": np.append(indenter.z.ravel(), indenter.spacing)}  # type: ignore[union-attr]
    return found | {"indenter": profile(indenter, basis["s"])}  # type: ignore[arg-type]


def _extended(kept: Array, fresh: NormalMotion) -> Array:
    """Return places of springs: those that were touched, and beyond them as many as a larger contact needs."""
    spacing = float(fresh.s[1])
    beyond = fresh.s[fresh.s > kept[-1] + 0.5 * spacing]
    return np.concatenate([kept, beyond])


def _padded(state: SpringState, kept: int, mover: NormalMotion) -> SpringState:
    """Return a state with springs beyond those that were touched."""
    more = len(mover.s) - kept
    memory = np.concatenate([state.memory[:kept], np.zeros((more, state.memory.shape[1]))])
    threshold = np.concatenate([state.threshold[:kept], mover.g[kept:]])
    return replace(state, force=np.append(state.force[:kept], np.zeros(more)), memory=memory, threshold=threshold)
