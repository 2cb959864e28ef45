"""Memory far from the contact: pieces that only fade, and the far wake of a contact that has slid for ever.

The displacement under the contact by a piece is smooth there, and smooth in the place of its loads too.  So the loads
of a piece are carried to a few of its cells by the transpose of polynomial interpolation, and the displacement is
interpolated from a few cells of the window [1]_.

In the wake, too far behind to be kept on cells, the delayed pressure of each mode falls by the same factor from cell to
cell, and over time by that of the mode.  Its displacement under the contact is an integral over the distance, by
Gauss's rule on parts that double in length, of the response far from a load, on the axis of the path.

.. [1] W. Fong, E. Darve, J. Comput. Phys. 228 (2009) 8712, doi:10.1016/j.jcp.2009.08.031.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, field, replace
from functools import lru_cache

import numpy as np

from viscofric.arrays import Array, Indices, gauss, lagrange
from viscofric.motion.free.box import Box
from viscofric.motion.free.response import Response

# Nodes of a piece and of a window in each direction; left part of a memory that counts as none.
_NODES, _FADED = 8, 1e-12
# Least distance between a piece and the window, and length of a piece, in windows.
_FAR, _PIECE = 1.0, 0.5

# Lengths of its memory after which a wake has faded; nodes of each part; points along the window, for interpolation.
_WAKE_FADED, _PART_NODES, _POINTS = 40.0, 8, 6
# Least distance of a contact from the wake, as a part of the first one.
_NEAREST = 0.1


@dataclass(frozen=True, eq=False)
class Piece:
    """Delayed pressures that were left on a box, and their equivalent loads on a few of its cells."""

    box: Box
    memory: Array  # (m, nx, ny)
    i: Indices = field(init=False)  # (n,) cells that carry the loads
    j: Indices = field(init=False)
    loads: Array = field(init=False)  # (m, n)

    def __post_init__(self) -> None:
        (x, along), (y, across) = (_interpolation(count) for count in self.box.shape)
        i, j = np.meshgrid(self.box.i + x, self.box.j + y, indexing="ij")
        loads = along.T @ self.memory @ across
        for name, value in (("i", i.ravel()), ("j", j.ravel()), ("loads", loads.reshape(len(loads), -1))):
            object.__setattr__(self, name, value)


@dataclass(frozen=True, eq=False)
class Past:
    """Pieces, and the parts of their memory that have not faded."""

    pieces: tuple[Piece, ...]
    left: tuple[Array, ...]  # (m,) of each piece

    def faded(self, decay: Array) -> Past:
        """Return the memory after a time in which each mode has faded by a factor."""
        kept = [
            (piece, left)
            for piece, left in zip(self.pieces, (decay * one for one in self.left), strict=True)
            if left.max(initial=0.0) > _FADED
        ]
        return Past(tuple(piece for piece, _ in kept), tuple(left for _, left in kept))

    def split(self, window: Box) -> tuple[Past, list[tuple[Box, Array]]]:
        """Return the pieces that are far from a window, and the memory on the boxes of the others."""
        around = surroundings(window)
        far = [not piece.box.meets(around) for piece in self.pieces]
        near = [
            (piece.box, left[:, None, None] * piece.memory)
            for piece, left, away in zip(self.pieces, self.left, far, strict=True)
            if not away
        ]
        if not near:
            return self, near
        return Past(tuple(itertools.compress(self.pieces, far)), tuple(itertools.compress(self.left, far))), near

    def joined(self, memories: list[tuple[Box, Array]]) -> Past:
        """Return a past with more pieces."""
        loaded = [Piece(box, memory.copy()) for box, memory in memories if memory.any()]
        more = tuple(np.ones(len(one.memory)) for one in loaded)
        return replace(self, pieces=(*self.pieces, *loaded), left=(*self.left, *more))

    def under(self, response: Response, window: Box) -> Far:
        """Return the displacement by each mode on a window."""
        (x, along), (y, across) = (_interpolation(count) for count in window.shape)
        i, j = (np.concatenate([getattr(one, name) for one in self.pieces]) for name in ("i", "j"))
        loads = np.concatenate(
            [left[:, None] * one.loads for one, left in zip(self.pieces, self.left, strict=True)], axis=1
        )
        di, dj = np.abs(window.i + x[:, None] - i), np.abs(window.j + y[:, None] - j)
        # A power of two, so that the table grows seldom.
        table = response.quarter(*(1 << int(one.max()).bit_length() for one in (di, dj)))
        values = loads @ table[di[:, None, :], dj[None, :, :]].reshape(len(x) * len(y), -1).T
        return Far(values.reshape(len(loads), len(x), len(y)), along, across)


NO_PAST = Past((), ())


@dataclass(frozen=True, eq=False)
class Far:
    """Displacement of unit compliance by each mode, at a few cells of a window."""

    values: Array  # (m, n, n)
    along: Array  # (nx, n) interpolation
    across: Array

    def weighted(self, weights: Array) -> Array:
        """Return the weighted sum over the modes on the window, (nx, ny)."""
        return np.asarray(self.along @ np.tensordot(weights, self.values, 1) @ self.across.T)

    def with_pressure(self, pressure: Array) -> Array:
        """Return the inner product of each mode with a pressure on the window; (m,)."""
        return np.asarray(np.tensordot(self.values, self.along.T @ pressure @ self.across, 2))


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
        farthest = _WAKE_FADED / float(steps.min())
        count = max(1, math.ceil(math.log2(1.0 + farthest / distance)))
        edges = distance * (2.0 ** np.arange(count + 1) - 1.0)
        # The sum over rows 0, 1, … is the integral from −½ on.
        nodes, weights = gauss(_PART_NODES, edges - 0.5)
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


def surroundings(window: Box) -> Box:
    """Return the cells around a window whose memory is not far."""
    more = [int(_FAR * count) if count > 1 else 0 for count in window.shape]
    return Box(window.i - more[0], window.j - more[1], window.nx + 2 * more[0], window.ny + 2 * more[1])


def parted(box: Box, memory: Array, window: Box) -> tuple[Box, Array, list[tuple[Box, Array]]]:
    """Cut off what is far from a window; return the rest of a box with its memory, and the pieces with theirs."""
    around, rest, slabs = surroundings(window), box, []
    lengths = [max(1, int(_PIECE * count)) for count in window.shape]
    for axis, length in enumerate(lengths):
        before = (around[axis] - rest[axis]) // length
        after = (rest[axis] + rest[axis + 2] - around[axis] - around[axis + 2]) // length
        for count, at_end in ((before, False), (after, True)):
            for _ in range(count):
                slab, rest = rest.cut(axis, length, at_end=at_end)
                slabs += slab.divided(1 - axis, window.shape[1 - axis])
    return rest, memory[(..., *rest.within(box))], [(one, memory[(..., *one.within(box))]) for one in slabs]


@lru_cache(maxsize=64)
def _interpolation(count: int) -> tuple[Array, Array]:
    """Return a few of so many cells, and the matrix from values there to those on all cells."""
    nodes = np.unique(np.round(np.linspace(0.0, count - 1.0, min(count, _NODES))).astype(int))
    return nodes, lagrange(nodes, np.arange(float(count)))
