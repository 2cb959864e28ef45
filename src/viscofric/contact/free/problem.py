"""One contact problem in units of the Hertz contact at E0, and its solution on one grid."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Protocol, TypeAlias

import numpy as np

from viscofric.contact.arrays.backend import Backend
from viscofric.contact.free.balance import CUTS, lag, opening
from viscofric.contact.free.control import GivenLoad
from viscofric.contact.free.estimates import Estimate
from viscofric.contact.free.footprint import Footprint
from viscofric.contact.free.given_grid import COARSEST

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.contact.complementarity import ComplementaritySolution
    from viscofric.contact.free.control import Control
    from viscofric.contact.free.geometry import Geometry
    from viscofric.contact.free.grids import Extent, Grid
    from viscofric.contact.operators.convolution import ConvolutionOperator, SteadyMaterial
    from viscofric.contact.operators.layer import ScaledLayer

    Array: TypeAlias = NDArray[np.float64]


class Shape(Protocol):
    """An indenter, in these units."""

    @property
    def has_tip(self) -> bool:
        """Whether the slope jumps at the lowest point."""

    def height(self, x: Array, y: Array) -> Array:
        """Height above the lowest point."""

    def slope(self, x: Array, y: Array) -> Array:
        """Slope of the height along x."""

    def slope_across(self, x: Array, y: Array) -> Array:
        """Slope of the height along y."""


@dataclass(frozen=True, eq=False)
class Problem:
    """What is to be solved on every grid.

    Attributes
    ----------
    geometry : Geometry
        Point or line contact.
    solid : SteadyMaterial
    shape : Shape
    control : Control
        Given load or given indentation.
    tolerance : float
        How exactly the contact conditions hold.
    backend : Backend
        Where it is solved.
    layer : ScaledLayer, optional
        What the geometry's operator is one of; a half-space without.
    coarsest : int
        Cells along the longer edge of the window on the coarsest grid.
    """

    geometry: Geometry
    solid: SteadyMaterial
    shape: Shape
    control: Control
    tolerance: float
    backend: Backend = field(default_factory=Backend)
    layer: ScaledLayer | None = None
    coarsest: int = COARSEST

    @cached_property
    def first_size(self) -> float:
        """First guess of the contact's size.

        Under a given load, the radius a of Hertz's contact with the compliance of waves e^(ix/a); a given indentation
        hardly leaves the size a choice.
        """
        size = 1.0
        if isinstance(self.control, GivenLoad):
            for _ in range(60):
                wave = np.array([1.0 / size])
                yielding = 1.0 if self.layer is None else self.layer.yielding(wave)
                compliance = float(np.abs(self.solid.symbol(wave, yielding))[0])
                # Half way, since of a thin incompressible layer the whole step would lead back and forth.
                size = math.sqrt(size * compliance ** (1.0 / (self.geometry.dimension + 1.0)))
        return size

    def height_on(self, window: Grid, shift: float) -> Array:
        """Height of the indenter where the gap is looked at: so many cells behind the cell centres."""
        return self.shape.height((window.x - shift * window.spacing)[:, None], window.y)


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
    def balanced_friction(self) -> Estimate:
        """Friction coefficient from the dissipated energy, with what cells leave out of it.

        Its error is how far that is uncertain, from the wave that is taken for the first one left out.
        """
        force = self._dissipated[1]
        spacing = self.window.spacing
        left_out = lag(self.operator.material, spacing, CUTS[1]) * self.opening
        return Estimate(force + left_out, self.left_out_range(spacing))

    def left_out_range(self, spacing: float) -> float:
        """How uncertain is what cells leave out of the friction coefficient, were those left out as short as given."""
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
