"""State of a free contact at one time, in the units of `viscofric.contact.free.scale`, and the energies in it.

With ⟨a, b⟩ = ∫ a G b dA, a mode stores C⟨q, q⟩/2 and dissipates at the rate C⟨p − q, p − q⟩/τ.  While p changes
linearly, p − q relaxes exponentially, and both are known exactly from ⟨p, p⟩, ⟨p, q⟩ and ⟨q, q⟩ at the beginning, and
from the displacement under the pressure at the end: one product for all modes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array
from viscofric.motion.free.box import Box
from viscofric.motion.free.past import NO_PAST, Past, Wake
from viscofric.motion.memory import StepCoefficients, step_parts


@dataclass(frozen=True, eq=False)
class Products:
    """Inner products of the pressure and the fields of the modes, ⟨p, p⟩, ⟨p, q_k⟩ and ⟨q_k, q_k⟩."""

    pressure: float
    mixed: Array  # (m,)
    modes: Array  # (m,)

    def after(self, coefficients: StepCoefficients, with_end: float, modes_with_end: Array, end: float) -> Products:
        """Return the products after a step, from ⟨p₀, p₁⟩, ⟨q_k, p₁⟩ with q_k at its beginning, and ⟨p₁, p₁⟩."""
        decay, first, last = coefficients
        mixed = decay * modes_with_end + first * with_end + last * end
        modes = (
            decay**2 * self.modes
            + first**2 * self.pressure
            + last**2 * end
            + 2.0 * (decay * first * self.mixed + decay * last * modes_with_end + first * last * with_end)
        )
        return Products(end, mixed, modes)

    def dissipated(self, steps: Array, with_end: float, modes_with_end: Array, end: float) -> Array:
        """Return what each mode dissipates over a step of so many of its times, per unit of compliance; (m,)."""
        lag = self.pressure - 2.0 * self.mixed + self.modes
        crossed = with_end - modes_with_end - self.pressure + self.mixed
        change = end - 2.0 * with_end + self.pressure
        parts = step_parts(steps)
        return np.asarray(parts.own * lag + 2.0 * parts.mixed * crossed + parts.new * change)


class Place(NamedTuple):
    """Corner of the lattice next to the indenter's axis, and the axis' distance from it."""

    i: int
    j: int
    x: float
    y: float


@dataclass(frozen=True, eq=False)
class FreeState:
    """Pressure, memory and energies of a contact; nothing in it is ever changed."""

    place: Place
    window: Box  # cells around the indenter
    pressure: Array  # (nx, ny) of the window
    trend: Array  # its change over the last step, seen from the indenter
    duration: float  # of that step by the clock, s
    box: Box  # cells around the window
    memory: Array  # (m, nx, ny) of the box: delayed pressures
    products: Products
    faced: float  # ⟨p, p⟩ with the response of the indenter
    depth: float  # of the indenter's lowest point
    dissipated: float
    force: tuple[float, float]  # of friction, along and across the lattice
    past: Past = NO_PAST  # memory on other cells, and on some of the same, where the contact returned
    wake: Wake | None = None  # memory far behind a contact that has slid for ever
    lagging: float = 0.0  # after a jump: energy of the modes without a field minus that after they have followed
    #: After steady sliding: change of friction by the cells as soon as it moves on, which fades from cell to cell
    unsettled: float = 0.0
