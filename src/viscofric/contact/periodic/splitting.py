"""Operator splitting for the periodic contact: it converges from any start, however skew the operator is.

The contact problem asks for a p at which 0 ∈ A p + N(p), with A p = K p + h − δ, the load or δ given, and N the
normal cone of p ≥ 0: a sum of two monotone operators.  Douglas and Rachford's splitting [1]_ alternates their
resolvents, both of which are exact and cheap here: ::

    p = (ρ + K)⁻¹ (ρ y − h + δ)      wave by wave, the mean pressure set to the load
    z = max(2p − y, 0)
    y ← y + z − p

At the fixed point p = z ≥ 0 and ρ(y − p) is the gap.  It converges for every monotone K and every ρ > 0, one
product per step, without any choice of a contact set; linearly, with an acceptable rate for ρ between the smallest
and the largest |K̂|.  The active set is much faster once its set is nearly right, and diverges before.

.. [1] P. L. Lions, B. Mercier, SIAM J. Numer. Anal. 16 (1979) 964, doi:10.1137/0716071.
"""

from __future__ import annotations

import math
from operator import imul

import numpy as np

from viscofric.contact.arrays.backend import AnyArray, Backend
from viscofric.contact.periodic.operator import PeriodicOperator

_MEMORY = 12  # earlier steps that the acceleration uses
_GROWTH = 2.0  # of the best residual, at which the acceleration restarts from it


def split_steps(
    operator: PeriodicOperator,
    height: AnyArray,
    guess: AnyArray,
    *,
    load: float | None,
    indentation: float | None,
    steps: int,
    rho: float,
    accelerated: bool = False,
    less_gap: bool = False,
) -> AnyArray:
    """Take steps of the splitting from a guess, and return pressures that are not negative, in double precision.

    Steps are in the operator's precision.  `height` (nx, ny) is above the indenter's lowest point; `guess` (nx, ny) are
    pressures, not negative, some above zero; the load, the sum of the pressures, or the indentation δ is given.  `rho`
    is ρ, a compliance: much more compliant waves converge at once, those of about ρ in a few steps.  `accelerated`
    extrapolates from earlier steps (Anderson), which pays where many are needed.  `less_gap`: the guess is that of
    pressures less gaps over ρ, of which either is zero.
    """
    backend, xp = operator.backend, operator.backend.xp
    height, guess = backend.asarray(height), backend.asarray(guess)
    offset, level = float(xp.mean(height)) if indentation is None else indentation, 0.0
    # y and p are multiplied by ρ throughout, so that most of a step is done in place.
    resolvent, surface = xp.empty_like(operator.transfer), xp.empty_like(height, dtype=operator.dtype)
    state, shifted = xp.empty_like(surface), xp.empty_like(surface)

    def resolve(resolvent: AnyArray, transfer: AnyArray) -> None:
        resolvent[...] = 1.0 / (transfer / rho + 1.0)

    def begin(
        state: AnyArray, shifted: AnyArray, surface: AnyArray, height: AnyArray, guess: AnyArray, *moved: AnyArray
    ) -> None:
        surface[...] = xp.astype(height - offset, operator.dtype)
        state[...] = rho * xp.abs(xp.astype(guess, operator.dtype))
        for displacement in moved:
            state += backend.positive_part(displacement + surface - level)
        shifted[...] = state - surface

    def step(state: AnyArray, flat: AnyArray, shifted: AnyArray, surface: AnyArray) -> None:
        state -= flat
        flat -= state
        backend.positive_part(flat)
        state += flat
        shifted[...] = state - surface

    def finish(result: AnyArray, flat: AnyArray) -> None:
        result[...] = xp.astype(flat / rho, xp.float64)

    backend.in_parts(resolve, resolvent, operator.transfer)
    moved = [] if less_gap else [operator(xp.astype(guess, operator.dtype))]
    if moved and indentation is None:
        loaded = guess > 0.0
        level = float(xp.mean(moved[0][loaded] + height[loaded])) - offset
    backend.in_parts(begin, state, shifted, surface, height, guess, *moved)
    del moved
    flat = state
    acceleration = Acceleration(backend) if accelerated else None
    for _ in range(steps):
        waves = backend.transforms.forward(shifted)
        backend.in_parts(imul, waves, resolvent)
        if load is not None:
            waves[0, 0] = rho * load
        flat = backend.transforms.inverse(waves, operator.shape)
        if acceleration is None:
            backend.in_parts(step, state, flat, shifted, surface)
        else:
            positive = backend.positive_part(2.0 * flat - state)
            state = acceleration.next(state, positive - flat)
            flat, shifted = positive, state - surface
    operator.ffts += 2 * steps
    operator.products += steps
    result = xp.empty_like(height)
    backend.in_parts(finish, result, flat)
    return result


class Acceleration:
    """Anderson's acceleration of a fixed-point iteration y ← y + f(y), safeguarded.

    D. G. Anderson, J. ACM 12 (1965) 547, doi:10.1145/321296.321305: the next point is the combination of the latest
    ones whose residuals f cancel best.
    """

    def __init__(self, backend: Backend) -> None:
        self.backend = backend
        self.states: list[AnyArray] = []
        self.residuals: list[AnyArray] = []
        self.best = math.inf
        self.best_next: AnyArray | None = None

    def next(self, state: AnyArray, residual: AnyArray) -> AnyArray:
        """Return the point after `state`, given its residual."""
        xp = self.backend.xp
        flat = xp.reshape(residual, (-1,))
        size = math.sqrt(float(flat @ flat))
        if size > _GROWTH * self.best and self.best_next is not None:
            self.states, self.residuals = [], []
            found, self.best_next, self.best = self.best_next, None, math.inf
            return found
        plain = state + residual
        if size < self.best:
            self.best, self.best_next = size, plain
        self.states = [*self.states[-_MEMORY:], plain]
        self.residuals = [*self.residuals[-_MEMORY:], residual]
        if len(self.residuals) == 1:
            return xp.asarray(plain, copy=True)
        changes = [xp.reshape(later - residual, (-1,)) for later in self.residuals[:-1]]
        products = self.backend.floats(*(one @ other for one in changes for other in [*changes, flat]))
        table = np.array(products).reshape(len(changes), -1)
        gram = table[:, :-1].copy()
        gram.flat[:: len(gram) + 1] *= 1.0 + 1e-10
        gram.flat[:: len(gram) + 1] += np.finfo(float).tiny
        weights = np.linalg.solve(gram, -table[:, -1])
        found = xp.asarray(plain, copy=True)
        for weight, earlier in zip(weights.tolist(), self.states[:-1], strict=True):
            found += weight * (earlier - plain)
        return found
