"""A checked contact problem, from which every mover is constructed."""

from __future__ import annotations

from dataclasses import dataclass

from viscofric.contact.bodies import Layer
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.motion.schedule import Schedule
from viscofric.rheology.material import Material


@dataclass(frozen=True, eq=False)
class Problem:
    """A contact in motion."""

    material: Material  # its Poisson ratio; the modes are those of the schedule
    indenter: Indenter | PeriodicSurface
    schedule: Schedule
    accuracy: float  # relative, of friction, depth, load and energy
    layer: Layer | None
    counterface: float  # (1 − ν_i²)/E_i of an elastic indenter, 1/Pa

    @property
    def plane_strain(self) -> float:
        """1 − ν²."""
        return 1.0 - self.material.poisson_ratio**2

    @property
    def kind(self) -> str:
        """Kind of contact: "point", "line" or "periodic"."""
        geometry = getattr(self.indenter, "geometry", None)
        return "periodic" if geometry is None else ("line", "point")[geometry.dimension - 1]
