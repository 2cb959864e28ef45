"""A viscoelastic layer on a rigid base: pressure to displacement, for point and line contacts."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arrays import Array
from viscofric.contact.bodies import Layer
from viscofric.contact.free.geometry import LINE, Geometry
from viscofric.contact.influence.layer_potentials import THINNEST, LayerCell, LayerStrip
from viscofric.contact.operators.convolution import ConvolutionOperator
from viscofric.errors import ConvergenceError


@dataclass(frozen=True)
class ScaledLayer:
    """A layer in units of the contact."""

    thickness: float
    bonded: bool
    poisson_ratio: float

    @classmethod
    def of(cls, layer: Layer, length: float, poisson_ratio: float) -> ScaledLayer:
        """Return a layer in units of a length, m."""
        return cls(float(layer.thickness) / length, bool(layer.bonded), poisson_ratio)

    def yielding(self, wave_number: ArrayLike) -> Array:
        """Return Θ(qH): displacement under a wave of pressure over that of the half-space."""
        return Layer(self.thickness, self.bonded).yielding(wave_number, self.poisson_ratio)

    def geometry(self, geometry: Geometry, counterface: float) -> Geometry:
        """Return a point or line contact's geometry on this layer instead of a half-space.

        `counterface` is the compliance of the indenter; in plane strain it leaves displacements without a level.
        """
        operator = partial(_OPERATORS[geometry.name], layer=self)
        return replace(geometry, operator=operator, has_far_field=geometry.has_far_field or counterface == 0.0)

    def in_cells(self, spacing: float) -> float:
        """Return the thickness in cells; ConvergenceError if the cells are too large for the layer."""
        thickness = self.thickness / spacing
        if thickness < THINNEST:
            raise ConvergenceError(
                f"the layer is thinner than the grid resolves ({thickness:.2g} of a cell): it acts like a foundation; "
                "for a layer so much thinner than its contact is wide there are closed forms, in contact.reference.",
                code="layer-too-thin",
            )
        return thickness


@dataclass
class LayerOperator(ConvolutionOperator):
    """Displacement of a layer under pressures on rectangular cells."""

    layer: ScaledLayer = field(kw_only=True)

    unit = 1.0 / np.pi

    @property
    def cell(self) -> LayerCell:
        """Potential of a cell, in units of the cell's length."""
        aspect = self.window.width / self.window.spacing
        thickness = self.layer.in_cells(max(self.window.spacing, self.window.width)) * max(1.0, aspect)
        return LayerCell(thickness, self.layer.bonded, self.layer.poisson_ratio, aspect, self.material.drag)


@dataclass
class LineLayerOperator(ConvolutionOperator):
    """Displacement of a layer under pressures on a strip of cells, the same all along y.

    The surface far away does not move, unless the indenter is elastic: of its displacement, as of the half-space's in
    plane strain, only differences are meaningful, and the zero is below the least of them.
    """

    layer: ScaledLayer = field(kw_only=True)

    unit = 2.0 / np.pi

    @property
    def cell(self) -> LayerStrip:
        """Potential of a cell, in units of the cell's length."""
        thickness = self.layer.in_cells(self.window.spacing)
        return LayerStrip(thickness, self.layer.bonded, self.layer.poisson_ratio, self.material.drag)


_OPERATORS = {LINE.name: LineLayerOperator, "point": LayerOperator}
