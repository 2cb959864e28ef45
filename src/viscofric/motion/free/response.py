"""The elastic response of unit compliance on cells that are fixed to the body."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np
import scipy.fft

from viscofric.arrays import Array, ComplexArray
from viscofric.contact.influence.layer_potentials import LayerCell, LayerStrip
from viscofric.contact.influence.line import HalfSpaceStrip
from viscofric.contact.influence.potentials import CellPotential, HalfSpaceCell
from viscofric.contact.operators.convolution import ConvolutionOperator, Influence
from viscofric.contact.operators.layer import ScaledLayer
from viscofric.motion.free.box import Box

# Spectra that are kept: those of the last few sizes of the swept cells.
_KEPT = 3


@dataclass(eq=False)
class Response:
    """Displacement around a loaded cell of a half-space or a layer, and of many loaded cells.

    In plane strain without a layer, which has no far field, the displacement is measured from the point at the distance
    `level` from the load, if that is above zero.
    """

    line: bool
    spacing: float  # length of a cell
    aspect: float  # its width over its length
    layer: ScaledLayer | None = None
    level: float = 0.0
    _quarter: Array = field(init=False, repr=False)
    _spectra: dict[tuple[int, int], tuple[ComplexArray, tuple[int, int]]] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        self._quarter, self._spectra = np.zeros((0, 0)), {}

    @property
    def _cell(self) -> CellPotential:
        if self.layer is None:
            return HalfSpaceStrip() if self.line else HalfSpaceCell(self.aspect)
        longer = max(1.0, self.aspect)
        thickness = self.layer.in_cells(longer * self.spacing) * longer
        if self.line:
            return LayerStrip(thickness, self.layer.bonded, self.layer.poisson_ratio)
        return LayerCell(thickness, self.layer.bonded, self.layer.poisson_ratio, self.aspect)

    def quarter(self, nx: int, ny: int) -> Array:
        """Displacement at 0 … nx − 1 cells along x and 0 … ny − 1 along y from a loaded cell; even in both."""
        if nx > self._quarter.shape[0] or ny > self._quarter.shape[1]:
            x = np.arange(float(max(nx, self._quarter.shape[0])))[:, None]
            y = self.aspect * np.arange(float(max(ny, self._quarter.shape[1])))
            self._quarter = self._scaled(x, y)
        return self._quarter[:nx, :ny]

    def __call__(self, pressure: Array) -> Array:
        """Displacement under pressures, both (nx, ny)."""
        nx, ny = pressure.shape
        spectrum, (px, py) = self._spectrum(nx, ny)
        waves = scipy.fft.fft(scipy.fft.rfft(pressure, py, axis=1), px, axis=0, overwrite_x=True)
        waves *= spectrum
        lines = scipy.fft.ifft(waves, axis=0, overwrite_x=True)[:nx]
        return np.asarray(scipy.fft.irfft(lines, py, axis=1)[:, :ny])

    def far_from(self, cells: Array) -> Array:
        """Displacement at distances along x, in cells, from a loaded cell."""
        return self._scaled(cells, np.zeros(1))

    def _scaled(self, x: Array, y: Array) -> Array:
        found = self._cell(x, y)
        if self.line and self.layer is None and self.level > 0.0:
            found = found - self._cell(np.full((1, 1), self.level / self.spacing), np.zeros(1))
        return np.asarray((2.0 if self.line else 1.0) / np.pi * self.spacing * found)

    def seen_from(self, pressure: Array, box: Box, target: Box) -> Array:
        """Displacement on a box within that of the pressures."""
        return self(pressure)[target.within(box)]

    def _spectrum(self, nx: int, ny: int) -> tuple[ComplexArray, tuple[int, int]]:
        if (nx, ny) not in self._spectra:
            padded = scipy.fft.next_fast_len(2 * nx - 1, real=False), scipy.fft.next_fast_len(2 * ny - 1, real=True)
            circulant = np.zeros(padded)
            circulant[:nx, :ny] = self.quarter(nx, ny)
            circulant[padded[0] - nx + 1 :] = circulant[nx - 1 : 0 : -1]
            circulant[:, padded[1] - ny + 1 :] = circulant[:, ny - 1 : 0 : -1]
            while len(self._spectra) >= _KEPT:
                del self._spectra[next(iter(self._spectra))]
            # The influence is even in both directions, so that its spectrum is real.
            self._spectra[nx, ny] = np.ascontiguousarray(scipy.fft.rfft2(circulant).real), padded
        return self._spectra[nx, ny]


@dataclass
class StepOperator(ConvolutionOperator):
    """Displacement on the cells around the indenter for pressures there, from given influence coefficients."""

    quarter: Array = field(kw_only=True)  # (nx, ny), even along both

    unit: ClassVar[float] = 1.0
    cell = HalfSpaceCell()

    def _influence(self) -> Influence:
        whole = np.concatenate([self.quarter[:0:-1], self.quarter])
        return Influence(whole, np.zeros(1))
