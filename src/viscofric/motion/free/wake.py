"""The far wake of a contact that has slid for ever: memory too far behind to be kept on cells.

Behind the cells, the delayed pressure of each mode falls by the same factor from cell to cell, and over time by that of
the mode.  Its displacement under the contact is an integral over the distance, by Gauss's rule on parts that double in
length, of the response far from a load, on the axis of the path.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from viscofric.arrays import Array, gauss
from viscofric.motion.free.box import Box
from viscofric.motion.free.response import Response

# Lengths of its memory after which a wake has faded; nodes of each part; points along the window, for interpolation.
_FADED, _NODES, _POINTS = 40.0, 8, 6
# Least distance of a contact from the wake, as a part of the first one.
_NEAREST = 0.1


@dataclass(frozen=True, eq=False)
class Wake:
    """The far wake, and what is left of it."""

    row: int  # its first row
    distance: int  # rows from there to the contact, at first
    nodes: Array  # (n,) distance from the first row, in cells
    weights: Array  # (m, n) load of each mode at the nodes, at first
    left: Array  # (m,) part that has not faded yet

    @classmethod
    def of(cls, row: int, distance: int, load: Array, steps: Array) -> Wake:
        """Return a wake; `load` (m,) is that of its first row, which falls by e^(−steps) from row to row."""
        farthest = _FADED / float(steps.min())
        count = max(1, math.ceil(math.log2(1.0 + farthest / distance)))
        edges = distance * (2.0 ** np.arange(count + 1) - 1.0)
        # The sum over rows 0, 1, … is the integral from −½ on.
        nodes, weights = gauss(_NODES, edges - 0.5)
        share = np.exp(-steps[:, None] * nodes)
        return cls(row, distance, nodes, load[:, None] * share * weights, np.ones(len(load)))

    def faded(self, decay: Array) -> Wake:
        """Return the wake after a time in which each mode has faded by a factor."""
        return replace(self, left=self.left * decay)

    def holds_near(self, window: Box) -> bool:
        """Return whether cells come so near that the wake is not far from them."""
        return window.i - self.row < _NEAREST * self.distance

    def at(self, response: Response, window: Box) -> Array:
        """Return the displacement of unit compliance by each mode along a window; (m, nx)."""
        points = np.cos(np.pi * (np.arange(_POINTS) + 0.5) / _POINTS)
        places = 0.5 * (window.nx - 1) * (1.0 + points)
        far = response.far_from(window.i + places - self.row + self.nodes[:, None])
        coefficients = np.polynomial.chebyshev.chebfit(points, (self.weights @ far).T, _POINTS - 1)
        x = np.linspace(-1.0, 1.0, window.nx)
        return np.asarray(self.left[:, None] * np.polynomial.chebyshev.chebval(x, coefficients))
