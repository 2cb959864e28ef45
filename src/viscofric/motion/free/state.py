"""State of a free contact at one time, in the units of `viscofric.contact.free.scale`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from viscofric.arrays import Array
from viscofric.motion.free.box import Box
from viscofric.motion.free.energy import Products
from viscofric.motion.free.past import NO_PAST, Past
from viscofric.motion.free.wake import Wake


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
