"""The memory of one grid on the cells and modes of another one, by linear interpolation between cells and in ln τ."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array
from viscofric.motion.free.box import Box


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
        """Return fields (m, nx, ny) on another lattice; zero beyond this one.

        A delayed pressure is a smooth function of the retardation time.
        """
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
