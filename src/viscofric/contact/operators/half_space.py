"""The viscoelastic half-space: pressure to displacement, for point and line contacts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from viscofric.contact.influence.line import HalfSpaceStrip, line_memory_influence, strip_potential
from viscofric.contact.influence.potentials import HalfSpaceCell
from viscofric.contact.operators.convolution import (
    ConvolutionOperator,
    Influence,
    bent_share,
    cell_influence,
    second_difference,
)

if TYPE_CHECKING:
    from viscofric.arrays import Array


@dataclass
class HalfSpaceOperator(ConvolutionOperator):
    """Displacement of the free half-space under pressures on rectangular cells.

    C. Putignano, T. Reddyhoff, D. Dini, Tribol. Int. 100 (2016) 338, Eqs. 7 and 8.
    """

    unit = 1.0 / np.pi

    @property
    def cell(self) -> HalfSpaceCell:
        """Potential of a cell, in units of the cell's length."""
        return HalfSpaceCell(self.window.width / self.window.spacing)

    def _influence(self) -> Influence:
        instant = self.material.glassy + self.material.counterface
        return cell_influence(self, self.cell, instant).times(self.unit, self.window.spacing)


@dataclass
class LineOperator(ConvolutionOperator):
    """Displacement of the free half-space under pressures on a strip of cells, the same all along y.

    In plane strain the displacement has no level: it grows without bound as the load's length grows.  Here its
    zero is a little below the least influence within the strip, wherever the displacement is evaluated, which keeps
    the operator positive definite.  Only differences of displacements are meaningful.
    """

    unit = 2.0 / np.pi
    cell = HalfSpaceStrip()

    def _influence(self) -> Influence:
        (cells, _), h = self.window.shape, self.window.spacing
        x = np.arange(-(cells - 1.0), cells)
        wider = np.arange(-float(cells), cells + 1.0)
        lengths = self.material.memory_lengths / h
        centred = self._instant(x)
        dissipation, bent_dissipation = np.zeros_like(x), np.zeros_like(x)
        for compliance, length, bent in zip(self.material.compliances, lengths, bent_share(lengths), strict=True):
            delayed, lost = line_memory_influence(wider, length)
            centred += compliance * delayed[1:-1]
            dissipation += compliance * lost[1:-1]
            bent_dissipation += compliance * (bent * length * second_difference(delayed) + (1.0 - bent) * lost[1:-1])
        displacement = centred if self.shift == 0.0 else self._delayed(x - self.shift)
        level = centred.min() - 0.1 * np.ptp(centred)
        found = Influence((displacement - level)[:, None], dissipation[:, None], bent_dissipation[:, None])
        return found.times(self.unit, h)

    def _delayed(self, x: Array) -> Array:
        """Influence at places x, in cells."""
        displacement = self._instant(x)
        lengths = self.material.memory_lengths / self.window.spacing
        for compliance, length in zip(self.material.compliances, lengths, strict=True):
            displacement += compliance * line_memory_influence(x, length)[0]
        return displacement

    def _instant(self, x: Array) -> Array:
        return (self.material.glassy + self.material.counterface) * strip_potential(x)
