"""Windows of cells that follow the indenter, and interpolation from a coarse one to a finer one.

A `Window` of rectangular cells holds a point contact, a `Strip`, one row of cells, a line contact.  Both give their
values as (nx, ny) arrays, so that a strip is a window with ny = 1.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from typing import Self

    from viscofric.arrays import Array, Indices, Mask


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
class Grid(ABC):
    """Cells along the motion around the indenter's axis, which lies between two of them.

    With the axis between cells (at every refinement), an elastic contact is symmetric on the grid too, and its friction
    exactly zero.
    """

    spacing: float  # length of a cell along the motion
    behind: int  # cells between the axis and the rear edge of the grid; may be negative
    ahead: int  # cells between the axis and the front edge of the grid; may be negative

    @classmethod
    @abstractmethod
    def around(cls, rear: float, front: float, side: float, cells: int, aspect: float = 1.0) -> Self:
        """Return the grid over −rear … front (and ±side), with `cells` cells along the edge that takes more of them.

        `aspect` is the width of the cells across the motion over their length, where there are sides.
        """

    @property
    @abstractmethod
    def shape(self) -> tuple[int, int]:
        """Number of cells along x and y."""

    @property
    def width(self) -> float:
        """Width of a cell across the motion, the unit of errors of edges."""
        return self.spacing

    @property
    @abstractmethod
    def cell_area(self) -> float:
        """Area of a cell; its length in a line contact."""

    @property
    @abstractmethod
    def y(self) -> Array:
        """Cell centres across the motion."""

    @abstractmethod
    def refined(self) -> Self:
        """Return the same grid with cells half as large."""

    @abstractmethod
    def extent(self, mask: Mask) -> Extent:
        """Smallest such grid that holds a set of cells."""

    @abstractmethod
    def cuts(self, mask: Mask) -> bool:
        """Whether a set of cells reaches the outermost cells."""

    @abstractmethod
    def _rows(self, y: Array) -> Indices:
        """Rows of cells in which coordinates across the motion lie; any number out of range if in none."""

    @cached_property
    def x(self) -> Array:
        """Cell centres along the motion, relative to the indenter's axis."""
        return np.asarray(self.spacing * (np.arange(-self.behind, self.ahead) + 0.5), dtype=np.float64)

    @property
    def whole(self) -> Extent:
        """Extent of all the cells."""
        return self.extent(np.ones(self.shape, dtype=bool))

    def resample(self, values: Array, target: Grid) -> Array:
        """Carry cell values to another grid (nearest cell; zero outside this one)."""
        result = np.zeros(target.shape)
        i = np.floor(target.x / self.spacing).astype(int) + self.behind
        j = self._rows(target.y)
        inside_i, inside_j = (i >= 0) & (i < self.shape[0]), (j >= 0) & (j < self.shape[1])
        result[np.ix_(inside_i, inside_j)] = values[np.ix_(i[inside_i], j[inside_j])]
        return result

    def _along(self, mask: Mask) -> tuple[float, float]:
        loaded = self.x[mask.any(axis=1)]
        half = 0.5 * self.spacing
        return half - float(loaded.min()), float(loaded.max()) + half


@dataclass(frozen=True)
class Window(Grid):
    """Rectangular cells around the indenter's axis, which lies on a corner of cells."""

    beside: int  # cells between the axis and each side
    aspect: float = 1.0  # width of a cell across the motion over its length

    @classmethod
    def around(cls, rear: float, front: float, side: float, cells: int, aspect: float = 1.0) -> Self:
        """Return the window over −rear … front, ±side, with `cells` cells along the edge that takes more of them."""
        spacing = max(rear + front, 2.0 * side / aspect) / cells
        behind, ahead = _whole_cells(rear, spacing), _whole_cells(front, spacing)
        return cls(spacing, behind, ahead, _whole_cells(side, aspect * spacing), aspect)

    @property
    def width(self) -> float:
        """Width of a cell across the motion."""
        return self.spacing * self.aspect

    @property
    def shape(self) -> tuple[int, int]:
        """Number of cells along x and y."""
        return self.behind + self.ahead, 2 * self.beside

    @property
    def cell_area(self) -> float:
        """Area of a cell."""
        return self.spacing * self.width

    @cached_property
    def y(self) -> Array:
        """Cell centres across the motion."""
        return np.asarray(self.width * (np.arange(-self.beside, self.beside) + 0.5), dtype=np.float64)

    def refined(self) -> Self:
        """Return the same window with cells half as large."""
        return replace(
            self, spacing=0.5 * self.spacing, behind=2 * self.behind, ahead=2 * self.ahead, beside=2 * self.beside
        )

    def extent(self, mask: Mask) -> Extent:
        """Smallest such window that holds a set of cells."""
        across = np.abs(self.y[mask.any(axis=0)])
        return Extent(*self._along(mask), float(across.max()) + 0.5 * self.width)

    def cuts(self, mask: Mask) -> bool:
        """Whether a set of cells reaches the outermost cells of the window."""
        return bool(mask[0].any() or mask[-1].any() or mask[:, 0].any() or mask[:, -1].any())

    def _rows(self, y: Array) -> Indices:
        return np.asarray(np.floor(y / self.width).astype(np.intp) + self.beside)


@dataclass(frozen=True)
class Strip(Grid):
    """One row of cells along the motion, for what is the same all along y; loads are per unit of length."""

    @classmethod
    def around(cls, rear: float, front: float, side: float, cells: int, aspect: float = 1.0) -> Self:
        """Return the strip over −rear … front with `cells` cells; there are no sides."""
        spacing = (rear + front) / cells
        return cls(spacing, _whole_cells(rear, spacing), _whole_cells(front, spacing))

    @property
    def shape(self) -> tuple[int, int]:
        """Number of cells along x, and one."""
        return self.behind + self.ahead, 1

    @property
    def cell_area(self) -> float:
        """Area of a cell, per unit of length."""
        return self.spacing

    @property
    def y(self) -> Array:
        """Zero: the one row."""
        return np.zeros(1)

    def refined(self) -> Self:
        """Return the same strip with cells half as large."""
        return replace(self, spacing=0.5 * self.spacing, behind=2 * self.behind, ahead=2 * self.ahead)

    def extent(self, mask: Mask) -> Extent:
        """Smallest such strip that holds a set of cells; its side is zero."""
        return Extent(*self._along(mask), 0.0)

    def cuts(self, mask: Mask) -> bool:
        """Whether a set of cells reaches the first or the last cell."""
        return bool(mask[0].any() or mask[-1].any())

    def _rows(self, y: Array) -> Indices:
        return np.zeros(len(y), dtype=np.intp)


def _whole_cells(distance: float, spacing: float) -> int:
    return math.ceil(distance / spacing - 1e-9)
