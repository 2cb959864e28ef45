"""Edges, area and peak of a contact to a fraction of a cell.

Near the edge of a smooth contact the pressure rises like the square root of the distance, so that its square crosses
zero at the edge as a straight line.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.contact.free.grids import Grid


@dataclass(frozen=True)
class Footprint:
    """Size of the contact and its largest pressure, in the units of the grid.

    Attributes
    ----------
    front, rear, side : float
        Distances from the axis to the leading and trailing edge on the centre line, and half the width across it.
    area : float
    peak : float
        Largest pressure.
    peak_depth : int
        Cells, its own included, from the largest pressure to the nearer end of the loaded cells along the motion.
    """

    front: float
    rear: float
    side: float
    area: float
    peak: float
    peak_depth: int

    @classmethod
    def of(cls, window: Grid, pressure: Array) -> Footprint:
        """Measure the contact on one grid.

        Parameters
        ----------
        window : Grid
        pressure : (nx, ny) array
        """
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
    """Lower and upper end of the loaded stretch of a pressure profile, to a fraction of a cell.

    The pressure's square is extrapolated linearly to zero from the two outermost loaded cells, and never beyond the
    next cell's centre.

    Parameters
    ----------
    position : (n,) array
        Equally spaced, ascending.
    pressure : (n,) array
        Positive somewhere.
    """
    cell = float(position[1] - position[0])
    loaded = np.flatnonzero(pressure > 0.0)
    first, last = int(loaded[0]), int(loaded[-1])
    padded = np.concatenate([[0.0], pressure, [0.0]])  # place i is i + 1 here
    lower = _overhang(padded[first + 1 : first + 2], padded[first + 2 : first + 3])
    upper = _overhang(padded[last + 1 : last + 2], padded[last : last + 1])
    return float(position[first] - cell * lower[0]), float(position[last] + cell * upper[0])


def contact_area(window: Grid, pressure: Array) -> float:
    """Area of the contact: loaded cells, corrected along their rim by where the pressure's square ends.

    Parameters
    ----------
    window : Grid
    pressure : (nx, ny) array

    Returns
    -------
    float
        Mean of what the rims along x and along y give; for one row of cells, its loaded length.
    """
    axes = [axis for axis in (0, 1) if pressure.shape[axis] > 1]
    corrections = [_rim(np.moveaxis(pressure, axis, 0)) for axis in axes]
    count = float(np.count_nonzero(pressure))
    return window.cell_area * (count + sum(corrections) / len(corrections))


def _rim(pressure: Array) -> float:
    """Sum up what the contact covers beyond its loaded cells' edges along the first axis, in cells."""
    padded = np.pad(pressure, [(2, 2), (0, 0)])
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
