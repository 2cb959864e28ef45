"""One step of modes under a force that is linear in time: their memory, and the energy that they dissipate."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.motion.memory import step_coefficients

if TYPE_CHECKING:
    from viscofric.arrays import Array

#: Where series replace differences that would cancel.
_SERIES = 0.05


class StepParts(NamedTuple):
    """Coefficients of a step Δt = xτ, each (modes,).

    The memory becomes q₁ = decay q₀ + start f₀ + end f₁.  A mode of compliance c dissipates
    c [own (f₀ − q₀)² + 2 mixed (f₀ − q₀)(f₁ − f₀) + new (f₁ − f₀)²], the integral of c τ q̇².
    """

    decay: Array
    start: Array
    end: Array
    own: Array
    mixed: Array
    new: Array


def even_steps(edges: Array) -> Array:
    """Return the edges of an even number of steps: the first one is divided if their number is odd.

    Steps of whole cells stay whole: after half a cell, friction is off for the next two.
    """
    if len(edges) % 2:
        return edges
    return np.insert(edges, 1, 0.5 * (edges[0] + edges[1]))


def step_parts(x: Array) -> StepParts:
    """Return the coefficients of a step of x = Δt/τ, not below zero."""
    small = x < _SERIES
    safe = np.where(small, 1.0, x)
    gone = -np.expm1(-x)  # 1 − e^{−x}
    decay, start, end = step_coefficients(x)
    own = -0.5 * np.expm1(-2.0 * x)
    mixed = 0.5 * gone * (1.0 - end)
    series = x * (1 / 3 - x * (1 / 4 - x * (7 / 60 - x * (1 / 24 - x * (31 / 2520 - x / 320)))))
    new = np.where(small, series, (x - 2.0 * gone + own) / np.square(safe))
    return StepParts(decay, start, end, own, mixed, new)
