"""The solution of a contact problem on one grid."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.complementarity import ComplementaritySolution
from viscofric.contact.free.balance import LagChanges, lag, lag_changes, openings
from viscofric.contact.free.grids import Extent, Grid
from viscofric.contact.free.problem import Problem
from viscofric.contact.operators.convolution import ConvolutionOperator, loss_angle

# Where displacements are taken behind the cell centres, longer waves are left out: logarithm of the cut per shift.  It
# is in doubt in proportion to the square of the loss angle's sine.  Both from random contacts on finer grids.
_CUT_BY_SHIFT, _DOUBT_BY_LOSS = 3.0, 0.9


@dataclass(frozen=True, eq=False)
class Stage:
    """A converged solution on one grid."""

    problem: Problem
    window: Grid
    operator: ConvolutionOperator
    result: ComplementaritySolution

    @cached_property
    def load(self) -> float:
        """Sum of the pressures, times the area of a cell."""
        return self.window.cell_area * float(self.result.pressure.sum())

    @cached_property
    def pressure_friction(self) -> float:
        """Friction coefficient from the asymmetry of the pressure, ∫ p ∂h/∂x dA / F."""
        slope = self.problem.shape.slope(self.window.x[:, None], self.window.y)
        return self.window.cell_area * float(np.vdot(self.result.pressure, slope)) / self.load

    @cached_property
    def lateral_friction(self) -> float:
        """Coefficient of the force across the motion, ∫ p ∂h/∂y dA / F."""
        slope = self.problem.shape.slope_across(self.window.x[:, None], self.window.y)
        return self.window.cell_area * float(np.vdot(self.result.pressure, slope)) / self.load

    @cached_property
    def energy_friction(self) -> float:
        """Friction coefficient from the dissipated energy, with the part that cells leave out."""
        return self.operator.dissipated_force(self.result.pressure) / self.load + self.lag * self.opening

    @property
    def lag(self) -> float:
        """Λ, the friction coefficient per unit of `opening`."""
        return lag(self.operator.material, self.window.spacing, self.cut, self.rear_share)

    @property
    def lag_changes(self) -> LagChanges:
        """Derivatives of `lag`."""
        return lag_changes(self.operator.material, self.window.spacing, self.cut, self.rear_share)

    @property
    def rear_share(self) -> float:
        """Part of `opening` that is behind."""
        return self.openings[1] / self.opening if self.opening > 0.0 else 0.0

    @property
    def cut(self) -> float:
        """Wavenumber times the cell of the wave that is likely the first one left out."""
        return self.problem.geometry.cut * math.exp(-_CUT_BY_SHIFT * self.operator.shift)

    def left_out_range(self, spacing: float, doubt: float = 0.0) -> float:
        """Uncertainty of the part of the friction coefficient that cells of a spacing leave out.

        From the wave that is taken for the first one left out, whose logarithm may be off by `doubt` at least.
        """
        material, rear = self.operator.material, self.rear_share
        lost = math.sin(loss_angle(material, self.window.spacing))
        factor = math.exp(max(self.problem.geometry.doubt, doubt) + _DOUBT_BY_LOSS * lost**2)
        longest, shortest = (lag(material, spacing, cut, rear) for cut in (self.cut / factor, self.cut * factor))
        return abs(longest - shortest) * self.opening

    @cached_property
    def centre_of_pressure(self) -> float:
        """Distance from the axis to where the resultant load acts, along x."""
        pressure = self.result.pressure
        return float(self.window.x @ pressure.sum(axis=1)) / float(pressure.sum())

    @cached_property
    def openings(self) -> tuple[float, float]:
        """Parts of ∫ p ∂²h/∂x² dA that cells leave out ahead and behind, over the load."""
        ahead, behind = openings(self.window, self.result.pressure, self.gap)
        return ahead / self.load, behind / self.load

    @property
    def opening(self) -> float:
        """Part of ∫ p ∂²h/∂x² dA that cells leave out, over the load."""
        return sum(self.openings)

    @property
    def gap(self) -> Array:
        """Gap between surface and indenter in the contact conditions."""
        gap: Array = self.result.displacement + self.problem.height_on(self.window, self.operator.shift)
        gap -= self.result.indentation
        return gap

    @cached_property
    def extent(self) -> Extent:
        """Extent of the contact."""
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
        """Change of the level with the position of the leading edge."""
        if self.problem.geometry.has_far_field:
            return 0.0
        return abs(float(self.problem.shape.slope(np.array([self.footprint.front]), np.zeros(1))[0]))

    @property
    def indentation(self) -> float:
        """Depth of the indenter's lowest point below the level."""
        return self.result.indentation - self.level

    @property
    def displacement(self) -> Array:
        """Displacement at the cell centres, from the level."""
        displacement: Array = self.result.displacement
        if self.operator.shift > 0.0:
            centred = self.problem.geometry.operator(self.window, self.operator.material)
            displacement = centred(self.result.pressure)
        return displacement - self.level


@dataclass(frozen=True)
class Footprint:
    """Edges, area and largest pressure of a contact to a fraction of a cell, in the units of the grid.

    Near the edge of a smooth contact the pressure rises like the square root of the distance, so that its square
    crosses zero at the edge as a straight line.
    """

    front: float  # distance from the axis to the leading edge on the centre line
    rear: float  # distance from the axis to the trailing edge on the centre line
    side: float  # half the width across the centre line
    area: float
    peak: float  # largest pressure
    # cells, its own included, from the largest pressure to the nearer end of the loaded cells along the motion
    peak_depth: int

    @classmethod
    def of(cls, window: Grid, pressure: Array) -> Footprint:
        """Return the footprint of a pressure (nx, ny) on one grid."""
        middle = pressure.shape[1] // 2
        centre = 0.5 * (pressure[:, middle - 1] + pressure[:, middle])  # the axis lies between the two rows
        rear, front = edges(window.x, centre if centre.any() else pressure.max(axis=1))
        across = pressure.max(axis=0)
        right, left = edges(window.y, across) if len(across) > 1 else (-math.inf, math.inf)
        place, row = np.unravel_index(int(np.argmax(pressure)), pressure.shape)
        empty = np.flatnonzero(pressure[:, row] == 0.0)
        depth = int(np.abs(empty - place).min()) if len(empty) else len(pressure)
        return cls(front, -rear, 0.5 * (left - right), contact_area(window, pressure), float(pressure.max()), depth)


def edges(position: Array, pressure: Array) -> tuple[float, float]:
    """Return lower and upper end of the loaded stretch of a pressure profile (n,), to a fraction of a cell.

    The pressure's square is extrapolated linearly to zero from the two outermost loaded cells, and never beyond the
    next cell's centre.  Positions are equally spaced and ascending.
    """
    cell = float(position[1] - position[0])
    loaded = np.flatnonzero(pressure > 0.0)
    first, last = int(loaded[0]), int(loaded[-1])
    padded = np.concatenate([[0.0], pressure, [0.0]])  # place i is i + 1 here
    lower = _overhang(padded[first + 1 : first + 2], padded[first + 2 : first + 3])
    upper = _overhang(padded[last + 1 : last + 2], padded[last : last + 1])
    return float(position[first] - cell * lower[0]), float(position[last] + cell * upper[0])


def contact_area(window: Grid, pressure: Array) -> float:
    """Return the area of the contact: loaded cells, corrected along their rim to where the pressure's square ends.

    The mean of the corrections along x and along y; for one row of cells, its loaded length.
    """
    axes = [axis for axis in (0, 1) if pressure.shape[axis] > 1]
    corrections = [_rim(np.moveaxis(pressure, axis, 0)) for axis in axes]
    count = float(np.count_nonzero(pressure))
    return window.cell_area * (count + sum(corrections) / len(corrections))


def _rim(pressure: Array) -> float:
    """Return the area of the contact beyond its loaded cells' edges along the first axis, in cells."""
    empty = np.zeros((1, pressure.shape[1]))
    padded = np.concatenate([empty, pressure, empty])
    total = 0.0
    for one in (padded, padded[::-1]):
        outer, inner, beyond = one[1:-1], one[2:], one[:-2]
        rim = (outer > 0.0) & (beyond == 0.0)
        total += float(np.sum(_overhang(outer[rim], inner[rim]) - 0.5))
    return total


def _overhang(outer: Array, inner: Array) -> Array:
    """Distance from the outermost loaded cell's centre to the edge, in cells; half a cell if nothing else is known."""
    rising = inner > outer
    ratio = np.where(rising, (outer / np.where(rising, inner, 1.0)) ** 2, 0.5)
    return np.where(rising, np.minimum(1.0, ratio / (1.0 - ratio)), 0.5)
