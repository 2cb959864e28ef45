"""Rectangles of cells on a lattice that is fixed to the body, and pressures on them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array


class Box(NamedTuple):
    """Cells i … i + nx − 1 along x and j … j + ny − 1 along y."""

    i: int
    j: int
    nx: int
    ny: int

    @property
    def shape(self) -> tuple[int, int]:
        """Number of cells along x and y."""
        return self.nx, self.ny

    def within(self, other: Box) -> tuple[slice, slice]:
        """Return where this box lies in another one that holds it."""
        i, j = self.i - other.i, self.j - other.j
        return slice(i, i + self.nx), slice(j, j + self.ny)

    def holds(self, other: Box) -> bool:
        """Return whether another box lies in this one."""
        return (
            self.i <= other.i
            and self.j <= other.j
            and self.i + self.nx >= other.i + other.nx
            and self.j + self.ny >= other.j + other.ny
        )

    def meets(self, other: Box) -> bool:
        """Return whether the boxes have cells in common."""
        return max(self.i, other.i) < min(self.i + self.nx, other.i + other.nx) and max(self.j, other.j) < min(
            self.j + self.ny, other.j + other.ny
        )

    def cut(self, axis: int, count: int, *, at_end: bool) -> tuple[Box, Box]:
        """Return the first or the last cells along an axis, and the rest."""
        values, start = list(self), self[axis]
        kept = self[axis + 2] - count
        values[axis], values[axis + 2] = start + kept * at_end, count
        slab = Box(*values)
        values[axis], values[axis + 2] = start + count * (not at_end), kept
        return slab, Box(*values)

    def divided(self, axis: int, longest: int) -> list[Box]:
        """Return boxes side by side along an axis, none longer than so many cells."""
        found, rest = [], self
        while rest[axis + 2] > longest:
            one, rest = rest.cut(axis, longest, at_end=False)
            found.append(one)
        return [*found, rest]

    def joined(self, other: Box) -> Box:
        """Return the smallest box that holds both."""
        i, j = min(self.i, other.i), min(self.j, other.j)
        nx = max(self.i + self.nx, other.i + other.nx) - i
        return Box(i, j, nx, max(self.j + self.ny, other.j + other.ny) - j)

    def grown(self, other: Box, share: float) -> Box:
        """Return a box that holds both, with a share of its size to spare on the sides on which it had to grow."""
        whole = self.joined(other)
        i, nx = _grown(self.i, self.nx, whole.i, whole.nx, share)
        j, ny = _grown(self.j, self.ny, whole.j, whole.ny, share)
        return Box(i, j, nx, ny)

    def carried(self, values: Array, target: Box) -> Array:
        """Return values (…, nx, ny) on another box; zero where this one does not reach."""
        if target == self:
            return values
        found = np.zeros((*values.shape[:-2], *target.shape))
        i0, i1 = max(self.i, target.i), min(self.i + self.nx, target.i + target.nx)
        j0, j1 = max(self.j, target.j), min(self.j + self.ny, target.j + target.ny)
        if i0 < i1 and j0 < j1:
            common = Box(i0, j0, i1 - i0, j1 - j0)
            found[(..., *common.within(target))] = values[(..., *common.within(self))]
        return found


def _grown(start: int, count: int, first: int, needed: int, share: float) -> tuple[int, int]:
    if (start, count) == (first, needed):
        return start, count
    spare = max(1, int(share * needed))
    before, after = (spare if first < start else 0), (spare if first + needed > start + count else 0)
    return first - before, needed + before + after
