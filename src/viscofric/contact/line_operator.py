"""The steady viscoelastic half-space in plane strain: pressure to displacement along a strip of cells."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.contact.line_influence import line_memory_influence, strip_potential
from viscofric.contact.operator import ConvolutionOperator

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]


@dataclass
class LineOperator(ConvolutionOperator):
    """Displacement of the free half-space under pressures on a strip of cells, the same all along y.

    In plane strain the displacement has no level: it grows without bound as the load's length grows.  Here its
    zero is put a little below the least influence within the strip, wherever the displacement is looked at, which
    keeps the operator positive definite.  Only differences of displacements mean something.
    """

    def _influence(self) -> tuple[Array, Array]:
        (cells, _), h = self.window.shape, self.window.spacing
        x = np.arange(-(cells - 1.0), cells)
        centred, dissipation = self._delayed(x)
        displacement = centred if self.shift == 0.0 else self._delayed(x - self.shift)[0]
        level = centred.min() - 0.1 * np.ptp(centred)
        return (2.0 * h / np.pi) * (displacement - level)[:, None], (2.0 / np.pi) * dissipation[:, None]

    def _delayed(self, x: Array) -> tuple[Array, Array]:
        """Influence at places x, in cells, and the part of its slope that dissipates."""
        displacement, dissipation = self.material.glassy * strip_potential(x), np.zeros_like(x)
        lengths = self.material.memory_lengths / self.window.spacing
        for compliance, length in zip(self.material.compliances, lengths, strict=True):
            delayed, lost = line_memory_influence(x, length)
            displacement += compliance * delayed
            dissipation += compliance * lost
        return displacement, dissipation
