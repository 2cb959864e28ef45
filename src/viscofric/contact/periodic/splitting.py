"""Operator splitting for the periodic contact: it converges from anywhere, however skew the operator is.

The contact problem asks for a p at which 0 ∈ A p + N(p), with A p = K p + h − δ, the load or δ given, and N the
normal cone of p ≥ 0: a sum of two monotone operators.  Douglas and Rachford's splitting [1]_ alternates their
resolvents, both of which are exact and cheap here: ::

    p = (ρ + K)⁻¹ (ρ y − h + δ)      wave by wave, the mean pressure set to the load
    z = max(2p − y, 0)
    y ← y + z − p

At the fixed point p = z ≥ 0 and ρ(y − p) is the gap.  It converges for every monotone K and every ρ > 0, one
product per step, without any choice of a contact set; linearly, with a rate that ρ between the smallest and the
largest |K̂| makes bearable.  The active set is much faster once its set is nearly right, and leads astray before.

.. [1] P. L. Lions, B. Mercier, SIAM J. Numer. Anal. 16 (1979) 964, doi:10.1137/0716071.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import scipy.fft

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.contact.periodic.operator import PeriodicOperator

    Array: TypeAlias = NDArray[np.float64]


_MEMORY = 8  # earlier steps that the acceleration looks back on
_GROWTH = 2.0  # of the best residual, at which the acceleration goes back to it and starts anew


def split_steps(
    operator: PeriodicOperator,
    height: Array,
    guess: Array,
    *,
    load: float | None,
    indentation: float | None,
    steps: int,
    stiffness: float,
    accelerated: bool = False,
) -> Array:
    """Take some steps of the splitting from a guess, and return pressures that are not negative.

    Parameters
    ----------
    operator : PeriodicOperator
        In whose precision the steps are taken.
    height : (nx, ny) array
        Of the indenter above its lowest point.
    guess : (nx, ny) array
        Pressures, not negative, some above zero.
    load, indentation : float or None
        Sum of the pressures, or δ; one of them.
    steps : int
    stiffness : float
        ρ over the geometric mean of the smallest and the largest compliance of a wave.
    accelerated : bool
        Whether to extrapolate from earlier steps (Anderson), which pays where many are needed.
    """
    rho = operator.precision(stiffness * math.sqrt(math.prod(operator.compliance_range)))
    resolvent = operator.transfer + rho
    np.divide(1.0, resolvent, out=resolvent)
    pressure = guess.astype(operator.precision)
    offset = float(height.mean()) if indentation is None else indentation
    surface = (height - offset).astype(operator.precision)
    gap = operator(pressure) + surface
    loaded = pressure > 0.0
    if indentation is None:
        gap -= gap[loaded].mean()
    state = pressure + np.maximum(gap, 0.0) / rho
    acceleration = Acceleration() if accelerated else None
    result = pressure
    for _ in range(steps):
        waves = scipy.fft.rfft2(rho * state - surface)
        waves *= resolvent
        if load is not None:
            waves[0, 0] = load
        flat = scipy.fft.irfft2(waves, operator.shape, overwrite_x=True)
        result = 2.0 * flat
        result -= state
        np.maximum(result, 0.0, out=result)
        if acceleration is None:
            state += result
            state -= flat
        else:
            state = acceleration.next(state, result - flat)
    operator.ffts += 2 * steps
    operator.products += steps
    found: Array = result.astype(np.float64)
    return found


class Acceleration:
    """Anderson's acceleration of a fixed-point iteration y ← y + f(y), safeguarded.

    D. G. Anderson, J. ACM 12 (1965) 547, doi:10.1145/321296.321305: the next point is the combination of the latest
    ones whose residuals f cancel best.
    """

    def __init__(self) -> None:
        self.states: list[Array] = []
        self.residuals: list[Array] = []
        self.best = math.inf
        self.best_next: Array | None = None

    def next(self, state: Array, residual: Array) -> Array:
        """Return the point after `state`, given its residual."""
        size = float(np.linalg.norm(residual))
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
            return plain.copy()
        changes = [(later - residual).ravel() for later in self.residuals[:-1]]
        gram = np.array([[one @ other for other in changes] for one in changes])
        gram.flat[:: len(gram) + 1] *= 1.0 + 1e-10
        gram.flat[:: len(gram) + 1] += np.finfo(float).tiny
        weights = np.linalg.solve(gram, np.array([-(one @ residual.ravel()) for one in changes]))
        found = plain.copy()
        for weight, earlier in zip(weights, self.states[:-1], strict=True):
            found += weight * (earlier - plain)
        return found
