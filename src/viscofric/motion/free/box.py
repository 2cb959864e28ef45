"""Rectangles of cells on a lattice fixed to the body, pressures on them, and memory carried to other cells."""

from __future__ import annotations

import math
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


class Lattice(NamedTuple):
    """Cells of a box with their sides, and the retardation times of fields on them."""

    box: Box
    spacing: float
    width: float
    times: Array

    def finer(self, spacing: float, width: float, times: Array) -> Lattice:
        """Return the same region with other cells and retardation times."""
        i, nx = _covering(self.box.i, self.box.nx, self.spacing / spacing)
        j, ny = (self.box.j, 1) if self.box.ny == 1 else _covering(self.box.j, self.box.ny, self.width / width)
        return Lattice(Box(i, j, nx, ny), spacing, width, times)

    def carried(self, fields: Array, target: Lattice) -> Array:
        """Return fields (m, nx, ny) on another lattice; zero beyond this one."""
        # A delayed pressure is a smooth function of the retardation time.
        here, there = self.box, target.box
        found = _along(fields, 1, (here.i, self.spacing), (there.i, there.nx, target.spacing))
        if here.ny > 1:
            found = _along(found, 2, (here.j, self.width), (there.j, there.ny, target.width))
        known, wanted = np.log(self.times), np.log(target.times)
        shares = np.stack([np.interp(wanted, known, one) for one in np.eye(len(known))], axis=1)
        return np.tensordot(shares, found, 1)


def _covering(first: int, count: int, ratio: float) -> tuple[int, int]:
    start = math.floor(first * ratio)
    return start, math.ceil((first + count) * ratio) - start


def _along(fields: Array, axis: int, here: tuple[int, float], there: tuple[int, int, float]) -> Array:
    """Interpolate between cell centres along an axis, to zero next to its ends."""
    padded = np.pad(fields, [(1, 1) if one == axis else (0, 0) for one in range(3)])
    (first, spacing), (start, count, finer) = here, there
    place = (start + np.arange(count) + 0.5) * (finer / spacing) + 0.5 - first
    place = np.clip(place, 0.0, padded.shape[axis] - 1.0)
    low = np.minimum(place.astype(np.intp), padded.shape[axis] - 2)
    share = (place - low).reshape([count if one == axis else 1 for one in range(3)])
    return np.asarray((1.0 - share) * np.take(padded, low, axis) + share * np.take(padded, low + 1, axis))
