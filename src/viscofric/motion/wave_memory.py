"""Memory of every wave of a periodic contact, with the energies that its modes store and dissipate.

Within a step the pressure p0 + Δp θ of a wave is linear in its time θ, from 0 to 1.  The delayed pressure is, with
z = −κ + ib, b = q·Δs and s = −κ/z, ::

    q(θ) = (q0 − A) e^{zθ} + A + B θ,      B = s Δp,   A = s (p0 − B/κ).

A mode dissipates C G |r|²/τ with r = p − q, which obeys dr/dθ = z r + f, f = Δp − ib (p0 + Δp θ).  So ::

    κ ∫|r|² dθ = ½ (|r0|² − |r1|²) + Re ∫ r* f dθ,

and the integrals of r and r θ follow from that equation.  For |z| near zero, where A and B cancel, power series
replace them.

Waves of pressures and memory are multiplied by √(w G), w their weights in a mean over the grid: their squares are
energies.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.motion.memory import step_coefficients

if TYPE_CHECKING:
    from viscofric.arrays import Array, ComplexArray, Mask
    from viscofric.motion.memory import Modes


# |z| below which series are used: the closed forms lose 1e-16/|z| of their digits there, the series 1e-12.
_SERIES_BELOW = 1e-3
# Waves processed at once; their arrays stay in the processor's cache.
_BLOCK = 8192


@dataclass(frozen=True, eq=False)
class StepResponse:
    """Response of all modes together to the pressures of one step."""

    steps: Array  # (n,) κ of each mode
    turn: Array  # (rows, columns) q·Δs
    phase: ComplexArray | None  # e^{iq·Δs}; None without motion
    start: ComplexArray | Array  # Σ C α: compliance to the pressure at the beginning
    end: ComplexArray | Array  # 1/E_inf + Σ C β: compliance to the pressure at the end

    @classmethod
    def of(cls, modes: Modes, clock_step: float, turn: Array) -> StepResponse:
        """Return the response to a step, given its duration on the material's clock and the turn of each wave."""
        steps = clock_step / modes.tau
        moves = bool(turn.any())
        kind = complex if moves else float
        start, end = np.zeros(turn.shape, kind), np.full(turn.shape, modes.instantaneous, kind)
        phase = np.exp(1j * turn) if moves else None
        for compliance, kappa in zip(modes.C, steps, strict=True):
            if phase is None or kappa < _SERIES_BELOW:
                found = step_coefficients(kappa, turn if moves else 0.0)
                start += compliance * found.start
                end += compliance * found.end
                continue
            share = _share(float(kappa), turn)
            both = share * (1.0 - np.exp(-kappa) * phase)  # α + β
            share *= 1.0 - both / kappa  # β
            both -= share
            start += compliance * both
            end += compliance * share
        return cls(steps, turn, phase, start, end)

    def known(self, modes: Modes, memory: ComplexArray, pressure: ComplexArray) -> ComplexArray:
        """Return waves of the displacement at the end of the step that the past causes, for a unit transfer function.

        They carry the same factor as memory (n, rows, columns) and pressure (rows, columns).
        """
        found = np.tensordot(modes.C * np.exp(-self.steps), memory, 1)
        if self.phase is not None:
            found *= self.phase
        found += self.start * pressure
        return np.asarray(found)


class Advanced(NamedTuple):
    """Memory at the end of a step, and energies."""

    memory: ComplexArray  # (n, rows, columns)
    stored: float  # ½ Σ C |q|² at the end
    dissipated: float  # Σ C ∫ |p − q|²/τ dt in the step


class _Pressures(NamedTuple):
    """Quantities common to all modes in a block of waves."""

    turn: Array
    phase: ComplexArray | None
    before: ComplexArray
    change: ComplexArray
    after: ComplexArray
    squares: float  # |p|² at the beginning minus that at the end
    # f = constant + linear θ; its integral and that of θ f, each without the part of p in r0 − r1 and −r1
    constant: ComplexArray
    linear: ComplexArray
    rest: ComplexArray
    moment: ComplexArray


def advance(
    response: StepResponse,
    modes: Modes,
    memory: ComplexArray,
    before: ComplexArray,
    after: ComplexArray,
    *,
    keep: bool = True,
) -> Advanced:
    """Return the memory (n, rows, columns) after a step from one pressure to another, both (rows, columns).

    The given memory is overwritten unless `keep` is set.
    """
    found = np.empty_like(memory) if keep else memory
    stored = dissipated = 0.0
    turns, befores, afters = response.turn.reshape(-1), before.reshape(-1), after.reshape(-1)
    phases = None if response.phase is None else response.phase.reshape(-1)
    old, new = memory.reshape(len(modes), -1), found.reshape(len(modes), -1)
    for start in range(0, turns.size, _BLOCK):
        part = slice(start, start + _BLOCK)
        given = _pressures(turns[part], None if phases is None else phases[part], befores[part], afters[part])
        for k, (compliance, kappa) in enumerate(zip(modes.C, response.steps, strict=True)):
            loss = _one(float(kappa), given, old[k, part], new[k, part])
            dissipated += compliance * loss
            stored += 0.5 * compliance * _square(new[k, part])
    return Advanced(found, float(stored), float(dissipated))


def _pressures(turn: Array, phase: ComplexArray | None, before: ComplexArray, after: ComplexArray) -> _Pressures:
    change, squares = after - before, _square(before) - _square(after)
    if phase is None:
        none = np.zeros_like(change)
        return _Pressures(turn, phase, before, change, after, squares, change, none, none, none)
    rate = -1j * turn
    constant, linear = change + rate * before, rate * change
    rest, moment = constant + 0.5 * linear - change, 0.5 * constant + linear / 3.0 - after
    return _Pressures(turn, phase, before, change, after, squares, constant, linear, rest, moment)


def _square(values: ComplexArray) -> float:
    return float(np.vdot(values, values).real)


def _product(one: ComplexArray, other: ComplexArray) -> float:
    return float(np.vdot(one, other).real)


def _one(kappa: float, given: _Pressures, q0: ComplexArray, q1: ComplexArray) -> float:
    """Write q after a step into q1, which may be q0; return κ ∫ |p − q|² dθ, summed over the waves."""
    turn, phase, p0, change, p1 = given[:5]
    if kappa == 0.0:
        np.multiply(1.0 if phase is None else phase, q0, out=q1)
        return 0.0
    if kappa < _SERIES_BELOW:
        small = np.hypot(kappa, turn) < _SERIES_BELOW
        if small.any():
            return _near(kappa, given, q0, q1, small)
    if phase is None:
        level = p0 - change / kappa
        new = q0 - level
        new *= np.exp(-kappa)
        level += change
        new += level
        np.subtract(new, q0, out=level)
        level += given.rest
        work = _product(level, given.constant) / kappa
    else:
        share = _share(kappa, turn)
        slope = share * change
        level = slope * (-1.0 / kappa)
        level += p0
        level *= share
        new = q0 - level
        new *= phase
        new *= np.exp(-kappa)
        level += slope
        new += level
        share *= 1.0 / kappa
        np.subtract(new, q0, out=level)
        level += given.rest
        level *= share  # ∫ r dθ
        work = _product(level, given.constant)
        level += new
        level += given.moment
        level *= share  # ∫ r θ dθ
        work += _product(level, given.linear)
    # |r|² at the ends, expanded, so that no array of r is needed.
    ends = given.squares + _square(q0) - _square(new)
    loss = 0.5 * ends - _product(p0, q0) + _product(p1, new) + work
    q1[...] = new
    return loss


def _share(kappa: float, turn: Array) -> ComplexArray:
    """Return s = 1/(1 − ib/κ)."""
    found = np.empty(turn.shape, complex)
    slant = turn * (1.0 / kappa)
    size = slant * slant
    size += 1.0
    np.reciprocal(size, out=size)
    found.real = size
    np.multiply(slant, size, out=found.imag)
    return found


def _near(kappa: float, given: _Pressures, q0: ComplexArray, q1: ComplexArray, small: Mask) -> float:
    """Do the same where some |z| are near zero: there r is nearly linear."""
    moves, far = given.phase is not None, ~small
    near = step_coefficients(kappa, given.turn[small] if moves else 0.0)
    p0, p1, old = given.before[small], given.after[small], q0[small]
    new = near.decay * old + near.start * p0 + near.end * p1
    first, last = p0 - old, p1 - new
    loss = kappa / 3.0 * (_square(first) + _square(last) + _product(first, last))
    if far.any():
        rest = _pressures(
            given.turn[far], None if given.phase is None else given.phase[far], given.before[far], given.after[far]
        )
        others = q0[far]
        loss += _one(kappa, rest, others, others)
        q1[far] = others
    q1[small] = new
    return loss
