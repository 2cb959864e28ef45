"""The viscoelastic half-space: pressure to displacement, for point and line contacts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.influence.line import HalfSpaceStrip, line_memory_influence, shear_memory_influence
from viscofric.contact.influence.potentials import HalfSpaceCell
from viscofric.contact.operators.convolution import (
    ConvolutionOperator,
    Influence,
    below,
    bent_share,
    second_difference,
)


@dataclass
class HalfSpaceOperator(ConvolutionOperator):
    """Displacement of the free half-space under pressures on rectangular cells.

    C. Putignano, T. Reddyhoff, D. Dini, Tribol. Int. 100 (2016) 338, Eqs. 7 and 8.
    """

    unit = 1.0 / np.pi

    @property
    def cell(self) -> HalfSpaceCell:
        """Potential of a cell, in units of the cell's length."""
        return HalfSpaceCell(self.window.width / self.window.spacing, self.material.drag * self.material.coupling)


@dataclass
class LineOperator(ConvolutionOperator):
    """Displacement of the free half-space under pressures on a strip of cells, the same all along y.

    In plane strain the displacement has no level: it grows without bound as the load's length grows.  Here its
    zero is a little below the least influence within the strip, wherever the displacement is evaluated, which keeps
    the operator positive definite.  Only differences of displacements are meaningful.
    """

    unit = 2.0 / np.pi

    @property
    def cell(self) -> HalfSpaceStrip:
        """Potential of a cell, in units of the cell's length."""
        return HalfSpaceStrip(self.material.drag * self.material.coupling)

    def _influence(self) -> Influence:
        (cells, _), h = self.window.shape, self.window.spacing
        x = np.arange(-(cells - 1.0), cells)
        wider = np.arange(-float(cells), cells + 1.0)
        material, cell = self.material, self.cell
        lengths, none = material.memory_lengths / h, np.zeros(1)
        centred = material.glassy * cell(x, none)
        dissipation = material.glassy * cell.drag_slope(x, none)
        for compliance, length, bent in zip(material.compliances, lengths, bent_share(lengths), strict=True):
            delayed, lost = line_memory_influence(wider, length)
            straight = lost[1:-1]
            if cell.drag:
                sheared, slope = shear_memory_influence(wider, length)
                delayed, straight = delayed + cell.drag * sheared, straight + cell.drag * slope[1:-1]
                dissipation += compliance * bent * cell.drag_slope(x, none)
            centred += compliance * delayed[1:-1]
            dissipation += compliance * (bent * length * second_difference(delayed) + (1.0 - bent) * straight)
        displacement = (centred if self.shift == 0.0 else self._delayed(x - self.shift)) - below(centred)
        found = Influence(displacement[:, None], dissipation[:, None])
        self._add_counterface(found)
        return found.times(self.unit, h)

    def _delayed(self, x: Array) -> Array:
        """Influence at places x, in cells."""
        cell, lengths = self.cell, self.material.memory_lengths / self.window.spacing
        displacement = self.material.glassy * cell(x, np.zeros(1))
        for compliance, length in zip(self.material.compliances, lengths, strict=True):
            displacement += compliance * line_memory_influence(x, length)[0]
            if cell.drag:
                displacement += compliance * cell.drag * shear_memory_influence(x, length)[0]
        return displacement
