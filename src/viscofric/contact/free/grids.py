"""Windows of cells that follow the indenter, and interpolation from a coarse one to a finer one."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple, Self

import numpy as np
from scipy.fft import next_fast_len

from viscofric.arrays import Array, Mask


class Extent(NamedTuple):
    """Distances from the indenter's axis to the rear, to the front and to either side; negative beyond the axis."""

    rear: float
    front: float
    side: float

    @property
    def longest(self) -> float:
        """Longer edge of the rectangle."""
        return max(self.rear + self.front, 2.0 * self.side)

    def widened(self, margin: float) -> Extent:
        """Return the rectangle with a margin on all sides."""
        return Extent(self.rear + margin, self.front + margin, self.side + margin)


@dataclass(frozen=True)
class Grid:
    """Rectangular cells around the indenter's axis, which lies on a corner of cells; values on them are (nx, ny).

    Without cells beside the axis it is a strip, one row of cells for what is the same all along y, with ny = 1 and
    loads per unit of length.  With the axis between cells (at every refinement), an elastic contact is symmetric on the
    grid too, and its friction exactly zero.
    """

    spacing: float  # length of a cell along the motion
    behind: int  # cells between the axis and the rear edge of the grid; may be negative
    ahead: int  # cells between the axis and the front edge of the grid; may be negative
    beside: int = 0  # cells between the axis and each side
    aspect: float = 1.0  # width of a cell across the motion over its length

    @classmethod
    def around(cls, rear: float, front: float, side: float, cells: int, aspect: float = 1.0) -> Self:
        """Return the grid over −rear … front, ±side, with `cells` cells along the edge that takes more of them."""
        spacing = max(rear + front, 2.0 * side / aspect) / cells
        behind, ahead = _whole_cells(rear, spacing), _whole_cells(front, spacing)
        return cls(spacing, behind, ahead, _whole_cells(side, aspect * spacing), aspect)

    @property
    def is_strip(self) -> bool:
        """Whether there is one row of cells only."""
        return self.beside == 0

    @property
    def shape(self) -> tuple[int, int]:
        """Number of cells along x and y."""
        return self.behind + self.ahead, 1 if self.is_strip else 2 * self.beside

    @property
    def width(self) -> float:
        """Width of a cell across the motion, the unit of errors of edges."""
        return self.spacing * self.aspect

    @property
    def cell_area(self) -> float:
        """Area of a cell; of a strip, its length."""
        return self.spacing if self.is_strip else self.spacing * self.width

    @cached_property
    def x(self) -> Array:
        """Cell centres along the motion, relative to the indenter's axis."""
        return np.asarray(self.spacing * (np.arange(-self.behind, self.ahead) + 0.5), dtype=np.float64)

    @cached_property
    def y(self) -> Array:
        """Cell centres across the motion; zero for a strip."""
        if self.is_strip:
            return np.zeros(1)
        return np.asarray(self.width * (np.arange(-self.beside, self.beside) + 0.5), dtype=np.float64)

    @property
    def whole(self) -> Extent:
        """Extent of all the cells."""
        return self.extent(np.ones(self.shape, dtype=bool))

    def refined(self) -> Self:
        """Return the same grid with cells half as large."""
        return replace(
            self, spacing=0.5 * self.spacing, behind=2 * self.behind, ahead=2 * self.ahead, beside=2 * self.beside
        )

    def trimmed(self, mask: Mask, free: int) -> Self:
        """Return the part with `free` cells around a set of cells, or a few more where that makes FFTs quicker."""
        along, across = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
        behind = min(self.behind, self.behind - int(along[0]) + free)
        ahead = next_fast_len(behind + int(along[-1]) + 1 - self.behind + free, real=True) - behind
        beside = max(self.beside - int(across[0]), int(across[-1]) + 1 - self.beside) + free
        beside = min(self.beside, next_fast_len(beside, real=True))
        return replace(self, behind=behind, ahead=min(self.ahead, ahead), beside=beside)

    def extent(self, mask: Mask) -> Extent:
        """Smallest such grid that holds a set of cells; the side of a strip is zero."""
        along, half = self.x[mask.any(axis=1)], 0.5 * self.spacing
        side = 0.0 if self.is_strip else float(np.abs(self.y[mask.any(axis=0)]).max()) + 0.5 * self.width
        return Extent(half - float(along.min()), float(along.max()) + half, side)

    def cuts(self, mask: Mask) -> bool:
        """Whether a set of cells reaches the outermost cells, of a strip those at its ends."""
        ends = bool(mask[0].any() or mask[-1].any())
        return ends or (not self.is_strip and bool(mask[:, 0].any() or mask[:, -1].any()))

    def resample(self, values: Array, target: Grid) -> Array:
        """Carry cell values to another grid (nearest cell; zero outside this one)."""
        result = np.zeros(target.shape)
        i = np.floor(target.x / self.spacing).astype(int) + self.behind
        j = np.floor(target.y / self.width).astype(int) + self.beside
        inside_i, inside_j = (i >= 0) & (i < self.shape[0]), (j >= 0) & (j < self.shape[1])
        result[np.ix_(inside_i, inside_j)] = values[np.ix_(i[inside_i], j[inside_j])]
        return result


def _whole_cells(distance: float, spacing: float) -> int:
    return math.ceil(distance / spacing - 1e-9)
