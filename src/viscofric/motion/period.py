"""One marched period: a mover that sums load, depth and contact over it, and its numbers with their errors.

Errors are known by both chains, fewer points, and one period less.

Load and depth are taken as linear within steps, so that harmonics of both chains have errors of second order and are
extrapolated as energies are.  Of a small oscillation, the stiffness by every other spring differs by half the distance
of the springs over the radius, which the error by all springs does not exceed.  Cells are compared with the coarser
grid.  Numbers of the period before had an error that is to that of the last one as their distances from the periodic
state.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from viscofric.arrays import Array
from viscofric.motion.chains import Link, Track
from viscofric.motion.mover import Mover, Observation
from viscofric.motion.schedule import Instant, Schedule
from viscofric.motion.solution import TransientSolution

# Error of the steps over the difference of the chains; of the cells over that of the grids, whose cells are shorter by
# 1.5, with a margin; of merged modes and the contact conditions over the accuracy.
_OF_STEPS, _OF_CELLS, _OF_REST = 0.4, 1.2, 0.05


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


class Estimate(NamedTuple):
    """A number and its estimated error."""

    value: float
    error: float


@dataclass(frozen=True)
class Period:
    """One marched period: its numbers, extrapolated, and what they lose by steps and points."""

    stiffness: complex  # ratio of the first harmonics of load and depth; nan without an oscillation
    stiffness_steps: float
    stiffness_points: complex  # by half of the springs less that by all
    rubbed: float  # work of friction
    rubbed_steps: float  # what it loses by steps
    dissipated: float

    @classmethod
    def of(cls, track: Track[Watched]) -> Period:
        """Return the numbers of a marched period."""
        coarse, fine = track.reached.pair
        one, two = _stiffness(coarse), _stiffness(fine)
        lost = [link.seen.dissipated for link in (coarse, fine)]
        return cls(
            stiffness=two[0] + (two[0] - one[0]) / 3.0,
            stiffness_steps=_OF_STEPS * abs(two[0] - one[0]),
            stiffness_points=two[1] - two[0],
            rubbed=fine.rubbed + (fine.rubbed - coarse.rubbed) / 3.0,
            rubbed_steps=_OF_STEPS * abs(fine.rubbed - coarse.rubbed),
            dissipated=lost[1] + (lost[1] - lost[0]) / 3.0,
        )


def _stiffness(link: Link[Any]) -> tuple[complex, complex]:
    """Return the stiffness, and that by half of the points."""
    load, coarser, depth = link.state.harmonics
    if depth == 0.0:
        return complex(np.nan), complex(np.nan)
    return complex(load / depth), complex(coarser / depth)


@dataclass(frozen=True)
class Found:
    """The last two periods on the finest grid, the last one on the grid before, and the distances that are left."""

    last: Period
    before: Period
    coarser: Period | None
    change: float
    change_before: float
    accuracy: float

    @property
    def _relative(self) -> float:
        return self.change + _OF_REST * self.accuracy

    @property
    def _repeated(self) -> float:
        """Error by the distance that is left, over the change from the period before to the last one."""
        return min(1.0, 2.0 * self.change / self.change_before) if self.change_before > 0.0 else 1.0

    @property
    def repeats(self) -> bool:
        """Whether the last period has the numbers of the one before to the accuracy."""
        one, two = self.last, self.before
        pairs = (one.stiffness, two.stiffness), (one.rubbed, two.rubbed), (one.dissipated, two.dissipated)
        return not any(abs(now - then) > self.accuracy * abs(now) for now, then in pairs)  # nan without a stiffness

    def energy(self, run: TransientSolution) -> Estimate:
        """Return the energy dissipated in the period."""
        energy = float(run.dissipated[-1] - run.dissipated[0])
        repeated = self._repeated * abs(self.last.dissipated - self.before.dissipated)
        return Estimate(energy, float(run.errors.energy[-1]) + repeated + self._relative * energy)

    def stiffness(self) -> tuple[Estimate, Estimate, Estimate]:
        """Return storage and loss stiffness and the loss tangent."""
        found, points = self.last.stiffness, self.last.stiffness_points
        off = self.last.stiffness_steps + self._repeated * abs(found - self.before.stiffness)
        if self.coarser is not None:
            off += _OF_CELLS * abs(found - self.coarser.stiffness)
        tangent, fewer = (one.imag / one.real if one.real else math.inf for one in (found, found + points))
        return (
            Estimate(found.real, off + abs(points.real) + self._relative * abs(found.real)),
            Estimate(found.imag, off + abs(points.imag) + self._relative * abs(found.imag)),
            Estimate(tangent, off * abs(found) / found.real**2 + abs(fewer - tangent) + self._relative * abs(tangent)),
        )

    def friction(self, run: TransientSolution) -> Estimate:
        """Return ∮ F_t·ds over ∮ F_N |ds|."""
        path = np.hypot(*np.diff(run.position, axis=0).T)
        largest = float((0.5 * (run.load[1:] + run.load[:-1])) @ path)
        if largest == 0.0:
            return Estimate(0.0, 0.0)
        off = self.last.rubbed_steps + self._repeated * abs(self.last.rubbed - self.before.rubbed)
        if self.coarser is not None:
            off += _OF_CELLS * abs(self.last.rubbed - self.coarser.rubbed)
        off = max(off, float(run.errors.energy[-1])) + self._relative * abs(self.last.rubbed)
        return Estimate(self.last.rubbed / largest, off / largest)
