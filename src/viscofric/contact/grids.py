"""Windows of square cells that follow the indenter, and the passage from a coarse one to a finer one."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]
    Mask: TypeAlias = NDArray[np.bool_]


@dataclass(frozen=True)
class Window:
    """Square cells around the indenter's axis, which lies on a corner of cells.

    With the axis on a corner (at every refinement), an elastic contact is symmetric on the grid too, and its
    friction exactly zero.

    Parameters
    ----------
    spacing : float
        Side of a cell.
    behind, ahead : int
        Cells between the axis and the rear and the front edge of the window; either may be negative.
    beside : int
        Cells between the axis and each side.
    """

    spacing: float
    behind: int
    ahead: int
    beside: int

    @classmethod
    def around(cls, rear: float, front: float, side: float, cells: int) -> Window:
        """Return the window over −rear … front, ±side with `cells` cells along its longer edge."""
        spacing = max(rear + front, 2.0 * side) / cells
        return cls(
            spacing,
            math.ceil(rear / spacing - 1e-9),
            math.ceil(front / spacing - 1e-9),
            math.ceil(side / spacing - 1e-9),
        )

    @property
    def shape(self) -> tuple[int, int]:
        """Number of cells along x and y."""
        return self.behind + self.ahead, 2 * self.beside

    @property
    def cell_area(self) -> float:
        """Area of a cell."""
        return self.spacing**2

    @property
    def x(self) -> Array:
        """Cell centres along the motion, relative to the indenter's axis."""
        return np.asarray(self.spacing * (np.arange(-self.behind, self.ahead) + 0.5), dtype=np.float64)

    @property
    def y(self) -> Array:
        """Cell centres across the motion."""
        return np.asarray(self.spacing * (np.arange(-self.beside, self.beside) + 0.5), dtype=np.float64)

    def refined(self) -> Window:
        """Return the same window with cells half as large."""
        return Window(0.5 * self.spacing, 2 * self.behind, 2 * self.ahead, 2 * self.beside)

    def resample(self, values: Array, target: Window) -> Array:
        """Carry cell values to another window (nearest cell; zero outside this one)."""
        result = np.zeros(target.shape)
        i = np.floor(target.x / self.spacing).astype(int) + self.behind
        j = np.floor(target.y / self.spacing).astype(int) + self.beside
        inside_i, inside_j = (i >= 0) & (i < self.shape[0]), (j >= 0) & (j < self.shape[1])
        result[np.ix_(inside_i, inside_j)] = values[np.ix_(i[inside_i], j[inside_j])]
        return result

    def extent(self, mask: Mask) -> tuple[float, float, float]:
        """Rear, front and side of the smallest such window that holds a set of cells."""
        along = self.x[mask.any(axis=1)]
        across = np.abs(self.y[mask.any(axis=0)])
        half = 0.5 * self.spacing
        return half - float(along.min()), float(along.max()) + half, float(across.max()) + half


def touches_edge(mask: Mask) -> bool:
    """Whether a set of cells reaches the outermost cells of its window."""
    return bool(mask[0].any() or mask[-1].any() or mask[:, 0].any() or mask[:, -1].any())
