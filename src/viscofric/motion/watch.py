"""A mover whose states also hold sums over the period: first harmonics of load and depth, and the time in contact."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from viscofric.arrays import Array
from viscofric.motion.mover import Mover, Observation
from viscofric.motion.schedule import Instant, Schedule


class Watched(NamedTuple):
    """A state, what is seen of it, and the sums so far."""

    state: Any
    seen: Observation
    coarser: float  # load
    touching: Array
    touched: Array  # time in contact by the clock, s
    harmonics: Array  # of load, coarser load and depth, complex


@dataclass(frozen=True, eq=False)
class Watch:
    """A mover as another one, whose states are `Watched`: all else is that of the mover."""

    mover: Mover[Any]
    start: float
    omega: float

    @classmethod
    def of(cls, mover: Mover[Any], schedule: Schedule) -> Watch:
        """Return a mover watched over a period."""
        return cls(mover, schedule.start, 2.0 * np.pi / (schedule.end - schedule.start))

    def __getattr__(self, name: str) -> Any:
        """Return an attribute of the mover; a method takes watched states as well."""
        found = getattr(self.mover, name)
        if not callable(found):
            return found
        return lambda *given: found(*(one.state if isinstance(one, Watched) else one for one in given))

    def begin(self) -> Watched:
        """Return the mover's first state, with empty sums."""
        return self._begun(self.mover.begin())

    def step(self, state: Watched, start: Instant, end: Instant) -> Watched:
        """Return the state at the end of a step, with sums over load and depth that are linear within it."""
        return self._next(state, self.mover.step(state.state, start, end), start, end)

    def settle(self, state: Watched, instant: Instant, shortest: float) -> Watched:
        """Return the state after a jump of what is not prescribed."""
        settled = self.mover.settle(state.state, instant, shortest)
        return state if settled is state.state else self._next(state, settled, instant, instant)

    def observe(self, state: Watched) -> Observation:
        """Return what is seen of the state."""
        return state.seen

    def with_memory(self, state: Watched, memory: NDArray[Any]) -> Watched:
        """Return a state with another memory."""
        return self._begun(self.mover.with_memory(state.state, memory))

    def emptied(self, state: Watched) -> Watched:
        """Return the state with empty sums."""
        return self._begun(state.state)

    def recovered(self, change: NDArray[Any], state: Watched, start: Instant, end: Instant) -> NDArray[Any]:
        """Return the change of a memory over the period that ended in a state, as `Mover.recovered`."""
        return self.mover.recovered(change, state.touched / (end.clock - start.clock), start, end)

    def _begun(self, state: Any) -> Watched:
        touching = self.mover.touching(state)
        seen, coarser = self.mover.observe(state), self.mover.coarser_load(state)
        return Watched(state, seen, coarser, touching, np.zeros(touching.shape), np.zeros(3, dtype=complex))

    def _next(self, before: Watched, state: Any, start: Instant, end: Instant) -> Watched:
        """Return a state with its sums: ∫ f e^{−iωt} dt of a periodic f is that of f' e^{−iωt}/(iω)."""
        seen, coarser, touching = self.mover.observe(state), self.mover.coarser_load(state), self.mover.touching(state)
        shares = 0.5 * (before.touching + touching) * (end.clock - start.clock)
        rises = np.array([seen.load - before.seen.load, coarser - before.coarser, seen.depth - before.seen.depth])
        turned, length = np.exp(-1j * self.omega * (start.time - self.start)), end.time - start.time
        if length > 0.0:
            turned *= -np.expm1(-1j * self.omega * length) / (1j * self.omega * length)
        return Watched(
            state,
            seen,
            coarser,
            touching,
            before.touched + shares,
            before.harmonics + rises * turned / (1j * self.omega),
        )
