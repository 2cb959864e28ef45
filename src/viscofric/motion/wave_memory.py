"""Memory of every wave of a periodic contact, with the energies that its modes store and dissipate.

Within a step the pressure of a wave is linear in its time θ, from p0 to p1, and a delayed pressure obeys
dq/dθ = z q + κ p with z = −κ + ib, b = q·Δs.  With φ_j = (φ_{j−1} − 1/(j−1)!)/z and φ_0 = e^z, it ends at ::

    q1 = e^z q0 + α p0 + β p1,      α = κ (φ1 − φ2),   β = κ φ2.

A mode dissipates C G |p − q|²/τ.  Since κ (p − q) is the rate of q at a point of the solid, ::

    κ ∫ |p − q|² dθ = κ Re ∫ p* (p − q) dθ − ½ (|q1|² − |q0|²),

where κ ∫ p* q dθ is (β p0* + α p1*) q0 from what was there before, and the rest, with κ ∫ |p|² dθ, is ::

    Re κ [φ2 − φ3 − ib (φ3 − φ4)] (|p0|² + |p1|²)
        + Re κ [φ3 − ib φ4 + φ1* − 2 φ2* + φ3* + ib (φ2* − 2 φ3* + φ4*)] p0* p1.

Waves of pressures and memory are multiplied by √(w G), w their weights in a mean over the grid: their squares are
energies.  Memory may be in single precision; sums over waves are in double precision.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from viscofric.arrays import Array, ComplexArray
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.motion.memory import Modes, StepCoefficients, phi
from viscofric.motion.mover import Problem

# Error by merging modes, as a part of the accuracy; the shortest time that is resolved, as a part of each interval; and
# that part of it in which a point is passed from which on the passage is the shortest time.
MERGING, _SHORTEST, _QUICK = 0.1, 1e-5, 1e-2
# Duration of histories that may follow, over that of the first one.
_LONGER = 2.0
# Values processed at once: those of all modes stay in the processor's cache.
_BLOCK = 65_536


def resolved_times(problem: Problem, times: Iterable[float] = ()) -> tuple[float, float]:
    """Return the shortest time that matters in a history on a grid, with times asked for, and its duration, s."""
    schedule, surface = problem.schedule, problem.indenter
    assert isinstance(surface, PeriodicSurface)
    cell, shortest = min(surface.spacing), math.inf
    for start, end in itertools.pairwise(schedule.kinks.tolist()):
        slowest, _ = schedule.rates(start, end)
        clock = slowest * (end - start)
        speed = max(float(np.hypot(*schedule.velocity(time, after=time == start))) for time in (start, end))
        passing = clock * cell / (speed * (end - start)) if speed > 0.0 else math.inf
        shortest = min(shortest, passing if passing < _QUICK * clock else _SHORTEST * clock)
    since = [schedule.since_jump(schedule.at(time)) for time in times]
    shortest = min([shortest, *filter(None, since)])
    return shortest, schedule.duration


def merged_modes(problem: Problem, times: Iterable[float] = ()) -> Modes:
    """Return the modes required for a history on a grid, and for one that goes on from it for as long again."""
    shortest, duration = resolved_times(problem, times)
    return Modes.for_history(problem.schedule.spectrum, shortest, _LONGER * duration, MERGING * problem.accuracy)


@dataclass(frozen=True, eq=False)
class StepResponse:
    """Response of all modes together to the pressures of one step.

    Arrays over waves are (rows, columns), or have one row or column where all are equal.
    """

    steps: Array  # (n,) κ of each mode
    turn: Array  # q·Δs
    start: ComplexArray | Array  # Σ C α: compliance to the pressure at the beginning
    end: ComplexArray | Array  # 1/E_inf + Σ C β: compliance to the pressure at the end
    loss: Array  # factor of |p0|² + |p1|² in the dissipated energy, and …
    mixed: ComplexArray | Array  # … of p0* p1
    few: StepCoefficients | None  # of each mode, (n, rows, columns), if these are few

    @classmethod
    def of(cls, modes: Modes, steps: Array, turn: Array) -> StepResponse:
        """Return the response to a step, given its duration in the time of each mode (n,) and the turn of each wave."""
        if not turn.any():
            turn = np.zeros((1, 1))
        narrow = 1 in turn.shape
        sums = np.empty((4, *turn.shape), complex if turn.any() else float)
        few = None
        for rows in [slice(None)] if narrow else _blocks(len(modes), *turn.shape):
            decay, found = _functions(steps, turn[rows], 4)
            few = _coefficients(steps, decay, found) if narrow else None
            for each, total in zip(found, sums, strict=True):
                total[rows] = _weighted(modes.C * steps, each)
        one, two, three, four = sums
        bend = 1j * turn if turn.any() else 0.0
        loss = (two - three - bend * (three - four)).real
        mixed = three - bend * four + np.conj(one - 2.0 * two + three - bend * (two - 2.0 * three + four))
        return cls(steps, turn, one - two, modes.instantaneous + two, loss, mixed, few)

    @classmethod
    def steady(cls, turn: Array, compliance: ComplexArray | Array) -> StepResponse:
        """Return the response to a pressure that has always been there."""
        none = np.zeros((1, 1))
        return cls(np.zeros(0), turn, none, compliance, none, none, None)

    def known(self, modes: Modes, memory: ComplexArray, pressure: ComplexArray) -> ComplexArray:
        """Return waves of the displacement that the past causes at the end of the step, per transfer function."""
        # They carry the same factor as memory (n, rows, columns) and pressure (rows, columns).
        left = _weighted(modes.C * np.exp(-self.steps), memory)
        if self.turn.any():
            left *= np.exp(1j * self.turn)
        found = self.start * pressure
        found += left
        return np.asarray(found)

    def coefficients(self, rows: slice) -> StepCoefficients:
        """Return the coefficients of each mode for some rows of waves: (n, rows, columns), or 1 where all are equal."""
        if self.few is None:
            return _coefficients(self.steps, *_functions(self.steps, self.turn[rows], 2))
        if len(self.turn) == 1:
            return self.few
        return StepCoefficients(*(each[:, rows] for each in self.few))

    def of_pressures(self, rows: slice, before: ComplexArray, after: ComplexArray) -> float:
        """Return the part of the dissipated energy that is of some rows of the pressures alone."""
        loss, mixed = (each if len(each) == 1 else each[rows] for each in (self.loss, self.mixed))
        return float(_overlap(loss, before, before) + _overlap(loss, after, after) + _overlap(mixed, before, after))


class Advanced(NamedTuple):
    """Memory at the end of a step, and energies."""

    memory: ComplexArray  # (n, rows, columns)
    stored: float  # ½ Σ C |q|² at the end
    dissipated: float  # Σ C ∫ |p − q|²/τ dt in the step


def advance(
    response: StepResponse,
    modes: Modes,
    memory: ComplexArray,
    pressures: tuple[ComplexArray, ComplexArray],
    held: float,
) -> Advanced:
    """Return the memory (n, rows, columns), which stored an energy, after a step from one pressure to another."""
    found = np.empty_like(memory)
    # Pressures are rounded as the memory is: where they are equal, nothing is dissipated.
    both = np.stack(pressures, axis=1, dtype=memory.dtype, casting="same_kind")
    stored = dissipated = 0.0
    for rows in _blocks(len(modes), *pressures[0].shape):
        decay, *pair = response.coefficients(rows)
        first, last, old, new = both[rows, 0], both[rows, 1], memory[:, rows], found[:, rows]
        dissipated += response.of_pressures(rows, first.astype(complex), last.astype(complex))
        dissipated -= float(modes.C @ (_overlap(pair[1], first, old) + _overlap(pair[0], last, old)))
        np.multiply(old, decay.astype(memory.dtype), out=new)
        new += _spread(pair, both[rows])
        stored += stored_energy(modes, new)
    return Advanced(found, stored, dissipated - stored + held)


def _blocks(modes: int, rows: int, columns: int) -> Iterator[slice]:
    """Yield some rows at a time."""
    count = max(1, _BLOCK // (max(modes, 1) * columns))
    return (slice(start, start + count) for start in range(0, rows, count))


def _functions(steps: Array, turn: Array, count: int) -> tuple[NDArray[Any], list[NDArray[Any]]]:
    """Return e^z of each mode for some waves, (n, rows, columns), and φ1, φ2, … of it."""
    z = -steps[:, None, None]
    decay = np.exp(z)
    if turn.any():
        decay, z = decay * np.exp(1j * turn), z + 1j * turn
    return decay, phi(z, count, decay)


def _coefficients(steps: Array, decay: NDArray[Any], functions: list[NDArray[Any]]) -> StepCoefficients:
    kappa, (one, two) = steps[:, None, None], functions[:2]
    return StepCoefficients(decay, kappa * (one - two), kappa * two)


def _weighted(weights: Array, fields: NDArray[Any]) -> NDArray[Any]:
    """Return the sum of fields (n, rows, columns) with real weights (n,)."""
    real = fields.real.dtype
    found = np.tensordot(weights.astype(real), np.ascontiguousarray(fields).view(real), 1)
    return np.asarray(found.view(fields.dtype))


def _spread(weights: list[NDArray[Any]], fields: ComplexArray) -> ComplexArray:
    """Return the sum of two fields (rows, 2, columns) with weights of each mode, two of (n, rows, columns)."""
    if weights[0].shape[2] > 1:
        first, second = (one.astype(fields.dtype) * fields[:, place] for place, one in enumerate(weights))
        return np.asarray(first + second)
    matrices = np.stack([one[:, :, 0].T for one in weights], axis=2).astype(fields.dtype)
    return (matrices @ fields).transpose(1, 0, 2)


def _overlap(weights: NDArray[Any], one: ComplexArray, others: ComplexArray) -> Array:
    """Return the real part of Σ w p* q over waves, for one p (rows, columns) and each q (…, rows, columns)."""
    if weights.shape[-1] == 1:
        return np.asarray((weights[..., 0] * np.vecdot(one, others)).real.sum(axis=-1))
    return np.asarray(np.vecdot(one, weights.astype(others.dtype) * others).real.sum(axis=-1, dtype=float))


def stored_energy(modes: Modes, memory: ComplexArray) -> float:
    """Return ½ Σ C |q|² of a memory (n, rows, columns)."""
    return 0.5 * float(modes.C @ np.vecdot(memory, memory).real.sum(axis=1, dtype=float))
