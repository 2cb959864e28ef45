"""Memory of every wave of a periodic contact, with the energies that its modes store and dissipate.

Within a step the pressure p0 + Δp θ of a wave is linear in its time θ, from 0 to 1.  The delayed pressure is, with
z = −κ + iq·Δs and s = −κ/z, ::

    q(θ) = (q0 − A) e^{zθ} + A + B θ,      B = s Δp,   A = s (p0 − B/κ),

and a mode dissipates C G |p − q|²/τ, whose integral over the step is a closed form too.  For |z| near zero, where A
and B cancel, power series take its place.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.motion.memory import step_coefficients

if TYPE_CHECKING:
    from viscofric.arrays import Array, ComplexArray
    from viscofric.motion.memory import Modes


# |z| below which series are used: the closed forms lose 1e-16/|z| of their digits there, the series 1e-12.
_SERIES_BELOW = 1e-3
# Waves that are worked on at once; their arrays stay in the processor's cache.
_BLOCK = 4096


@dataclass(frozen=True, eq=False)
class StepResponse:
    """What one step makes of pressures, for all modes together."""

    steps: Array  # (n,) κ of each mode
    turn: Array  # (rows, columns) q·Δs
    phase: ComplexArray | None  # e^{iq·Δs}; None without motion
    start: ComplexArray | Array  # Σ C α: compliance to the pressure at the beginning
    end: ComplexArray | Array  # 1/E_inf + Σ C β: compliance to the pressure at the end

    @classmethod
    def of(cls, modes: Modes, clock_step: float, turn: Array) -> StepResponse:
        """Return the response to a step of so much of the material's time, in which each wave turns so far."""
        steps = clock_step / modes.tau
        moves = bool(turn.any())
        kind = complex if moves else float
        start, end = np.zeros(turn.shape, kind), np.full(turn.shape, modes.instantaneous, kind)
        for compliance, kappa in zip(modes.C, steps, strict=True):
            found = step_coefficients(kappa, turn if moves else 0.0)
            start += compliance * found.start
            end += compliance * found.end
        return cls(steps, turn, np.exp(1j * turn) if moves else None, start, end)

    def known(self, modes: Modes, memory: ComplexArray, pressure: ComplexArray) -> ComplexArray:
        """Waves of the displacement, for a response of one, that the past causes at the end of the step."""
        found = np.tensordot(modes.C * np.exp(-self.steps), memory, 1)
        if self.phase is not None:
            found *= self.phase
        found += self.start * pressure
        return np.asarray(found)


class Advanced(NamedTuple):
    """Memory at the end of a step, and energies for a weight of each wave."""

    memory: ComplexArray  # (n, rows, columns)
    stored: float  # ½ Σ C w |q|² at the end
    dissipated: float  # Σ C w ∫ |p − q|²/τ dt in the step


def advance(
    response: StepResponse,
    modes: Modes,
    memory: ComplexArray,
    before: ComplexArray,
    after: ComplexArray,
    weights: Array,
) -> Advanced:
    """Return the memory (n, rows, columns) after a step from one pressure to another, both (rows, columns)."""
    found = np.empty_like(memory)
    stored = dissipated = 0.0
    turns, befores, afters = response.turn.reshape(-1), before.reshape(-1), after.reshape(-1)
    factors = weights.reshape(-1)
    phase = None if response.phase is None else response.phase.reshape(-1)
    rows_in, rows_out = memory.reshape(len(modes), -1), found.reshape(len(modes), -1)
    for first in range(0, turns.size, _BLOCK):
        part = slice(first, first + _BLOCK)
        turn, p0, weight = turns[part], befores[part], factors[part]
        change = afters[part] - p0
        turned = None if phase is None else phase[part]
        for k, (compliance, kappa) in enumerate(zip(modes.C, response.steps, strict=True)):
            q0 = rows_in[k, part]
            q1, loss = _one(float(kappa), turn, turned, q0, p0, change)
            rows_out[k, part] = q1
            stored += 0.5 * compliance * float(weight @ _square(q1))
            dissipated += compliance * float(weight @ loss)
    return Advanced(found, stored, dissipated)


def _square(values: ComplexArray) -> Array:
    return np.asarray(np.square(values.real) + np.square(values.imag))


def _one(
    kappa: float, turn: Array, phase: ComplexArray | None, q0: ComplexArray, p0: ComplexArray, change: ComplexArray
) -> tuple[ComplexArray, Array]:
    """Return q after a step, and κ ∫ |p − q|² dθ."""
    decay = np.exp(-kappa) if phase is None else np.exp(-kappa) * phase
    if kappa == 0.0:
        return decay * q0, np.zeros(q0.shape)
    small = np.hypot(kappa, turn) < _SERIES_BELOW if kappa < _SERIES_BELOW else None
    share = 1.0 / (1.0 - (1j / kappa) * turn) if phase is not None else np.ones(1)
    slope = share * change
    level = share * (p0 - slope / kappa)
    fading = q0 - level
    q1 = decay * fading + level + slope
    # r = p − q = −fading e^{zθ} + lag + drift θ
    lag, drift = p0 - level, change - slope
    first = share * ((1.0 - decay) / kappa)  # ∫ e^{zθ} dθ = (e^z − 1)/z
    second = share * ((first - decay) / kappa)  # ∫ e^{zθ} θ dθ = (e^z − φ1)/z
    mixed = np.conj(lag) * first + np.conj(drift) * second
    loss = _square(fading) * (-np.expm1(-2.0 * kappa) / (2.0 * kappa)) - 2.0 * (fading * mixed).real
    loss += _square(lag) + (np.conj(lag) * drift).real + _square(drift) / 3.0
    loss *= kappa
    if small is not None and small.any():
        near = step_coefficients(kappa, turn[small])
        at_end = near.decay * q0[small] + (near.start + near.end) * p0[small] + near.end * change[small]
        q1[small] = at_end
        r0, r1 = p0[small] - q0[small], p0[small] + change[small] - at_end
        loss[small] = kappa / 3.0 * (_square(r0) + _square(r1) + (np.conj(r0) * r1).real)
    return q1, loss
