"""The solution of a contact problem on one grid."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from viscofric.contact.free.balance import CUTS, lag, opening
from viscofric.contact.free.footprint import Footprint

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.contact.complementarity import ComplementaritySolution
    from viscofric.contact.free.grids import Extent, Grid
    from viscofric.contact.free.problem import Problem
    from viscofric.contact.operators.convolution import ConvolutionOperator


@dataclass(frozen=True, eq=False)
class Stage:
    """A converged solution on one grid."""

    problem: Problem
    window: Grid
    operator: ConvolutionOperator
    result: ComplementaritySolution

    @cached_property
    def load(self) -> float:
        """What the pressures add up to."""
        return self.window.cell_area * float(self.result.pressure.sum())

    @cached_property
    def pressure_friction(self) -> float:
        """Friction coefficient from the lean of the pressure, ∫ p ∂h/∂x dA / F."""
        slope = self.problem.shape.slope(self.window.x[:, None], self.window.y)
        return self.window.cell_area * float(np.vdot(self.result.pressure, slope)) / self.load

    @cached_property
    def lateral_friction(self) -> float:
        """Coefficient of the force across the motion, ∫ p ∂h/∂y dA / F."""
        slope = self.problem.shape.slope_across(self.window.x[:, None], self.window.y)
        return self.window.cell_area * float(np.vdot(self.result.pressure, slope)) / self.load

    @property
    def energy_friction(self) -> float:
        """Friction coefficient from the dissipated energy."""
        return self._dissipated[0]

    @cached_property
    def _dissipated(self) -> tuple[float, float]:
        """Friction coefficient from the dissipated energy, as slopes and as bends tell it."""
        pressure = self.result.pressure
        overlaps = self.operator.overlaps(pressure)
        straight = self.operator.dissipated_force(pressure, overlaps)
        return straight / self.load, self.operator.bent_dissipated_force(pressure, overlaps) / self.load

    @cached_property
    def balanced_friction(self) -> float:
        """Friction coefficient from the dissipated energy, with what cells leave out of it."""
        return self._dissipated[1] + lag(self.operator.material, self.window.spacing, CUTS[1]) * self.opening

    def left_out_range(self, spacing: float) -> float:
        """Uncertainty of what cells of a spacing leave out of the friction coefficient.

        From the wave that is taken for the first one left out.
        """
        longest, shortest = (lag(self.operator.material, spacing, cut) for cut in (CUTS[0], CUTS[2]))
        return (longest - shortest) * self.opening

    @cached_property
    def centre_of_pressure(self) -> float:
        """Distance from the axis to where the resultant load acts, along x."""
        pressure = self.result.pressure
        return float(self.window.x @ pressure.sum(axis=1)) / float(pressure.sum())

    @cached_property
    def opening(self) -> float:
        """What cells leave out of ∫ p ∂²h/∂x² dA, over the load."""
        return opening(self.window, self.result.pressure, self.gap) / self.load

    @property
    def gap(self) -> Array:
        """Between surface and indenter, as the contact conditions see it."""
        gap: Array = self.result.displacement + self.problem.height_on(self.window, self.operator.shift)
        gap -= self.result.indentation
        return gap

    @cached_property
    def extent(self) -> Extent:
        """Of the contact."""
        return self.window.extent(self.result.pressure > 0.0)

    @cached_property
    def footprint(self) -> Footprint:
        """Edges, area and peak of the contact."""
        return Footprint.of(self.window, self.result.pressure)

    @cached_property
    def level(self) -> float:
        """Displacement that counts as zero.

        That of the surface far away; in plane strain, where that is infinite, that of the contact's leading edge.
        """
        if self.problem.geometry.has_far_field:
            return 0.0
        edge = self.problem.shape.height(np.array([self.footprint.front]), np.zeros(1))
        return self.result.indentation - float(edge[0])

    @property
    def level_slope(self) -> float:
        """How the level changes with the place of the leading edge."""
        if self.problem.geometry.has_far_field:
            return 0.0
        return abs(float(self.problem.shape.slope(np.array([self.footprint.front]), np.zeros(1))[0]))

    @property
    def indentation(self) -> float:
        """Depth of the indenter's lowest point below the level."""
        return self.result.indentation - self.level

    @property
    def displacement(self) -> Array:
        """Displacement at the cell centres, wherever the gap was looked at, from the level."""
        displacement: Array = self.result.displacement
        if self.operator.shift > 0.0:
            centred = self.problem.geometry.operator(self.window, self.operator.material)
            displacement = centred(self.result.pressure)
        return displacement - self.level
