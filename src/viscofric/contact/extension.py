"""Extension of residuals on the contact beyond it, for preconditioners that act on the whole grid.

The inverse of a periodic operator K, restricted to the contact, is nearly the inverse of K restricted to it, if it is
applied to the whole displacement that a pressure on the contact causes: inside, where that is known, and outside, where
it is not.  Zeros outside would be a displacement with a jump at every edge, which needs large pressures along all the
edges, larger ones the more the solid's response lags.  The true displacement is continuous and decays: a mean over
nearby cells in contact, decreasing with distance, is much closer to it.  That halves the number of steps of
generalised conjugate residuals on rough contacts, and saves a sixth to a third of them on one spot in a window, whose
periodic operator approximates another one.

The mean is weighted by the kernel s/(d² + s²)^(3/2) of the distance d (Poisson's, whose transform is e^(−s|q|)): at
the edge over the few nearest cells, far away over all cells.  Where few cells nearby are in contact it passes into a
mean over a hundred cells.  Both are computed for blocks of cells, and interpolated between them.

The inverse then also gives pressures beyond the contact.  Those on neighbours of the contact's cells are not discarded
but moved to these (`Extension.collecting`), each by the part that would undo the displacement it causes there, as in
Jacobi's method.  That saves another step in ten.

Behind a moving contact a viscoelastic solid differs from the solid ahead of it: ahead, the displacement decays at
once; behind, it recovers with a lag, and at first keeps its value at the edge.  So the few cells behind each edge take
the value of the edge, with a weight that decreases with their distance and increases with the lag of short waves.  That
saves steps on surfaces that slide fast, two fifths of them on heights with kinks, such as those interpolated between
measured points, where the shortest memory is some cells long.
"""

from __future__ import annotations

import functools
import math
import operator
from collections.abc import Callable
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.arrays.backend import AnyArray, Backend, Cells, MaskedCells

#: Cells along an edge of a block at most.
BLOCK = 8
_REACH, _FAR = 2.5, 100.0  # s of the means over near and far cells, in cells
# Part of the contact in the weights of near cells below which their mean passes into that of far cells, and how fast.
_ENOUGH, _POWER = 0.2, 0.7
_LEAST = 1e-3  # part of the contact below which a mean decays
_NEIGHBOURS = ((-1, 0), (1, 0), (0, -1), (0, 1))
# Weight of a free cell's pressure on its neighbours in contact, relative to that of Jacobi's method, and the largest.
_MOVED, _MOST_MOVED = 1.5, 0.3
_TRAIL = 5  # cells behind an edge over which its value decays
_LEAST_WEIGHT = 1e-6  # of a corner that is used
_LATE = np.pi / 6.0  # loss angle from which on the cell behind an edge takes its value in full
_SHORT_WAVES = (4, 8, 16)  # cells; the largest of their loss angles is used


class Extension:
    """Extends values on the contact of a periodic grid over the whole of it.

    `shape` has the points along x and y; `toward` is the direction of the motion, in cells along x and y; `lag` is the
    delay of the response to short waves: 0 for an elastic solid, at most 1, below zero for the opposite motion; see
    `lag`.  `inverse` (nx, ny//2 + 1) is the symbol of the preconditioner, for `collecting`.  `even`: values are even in
    y, and `shape` has the points at y > 0; the motion is along x then, and there is no `inverse`.
    """

    def __init__(
        self,
        backend: Backend,
        shape: tuple[int, int],
        dtype: Any,
        toward: tuple[float, float] = (1.0, 0.0),
        lag: float = 0.0,
        *,
        inverse: AnyArray | None = None,
        block: int = BLOCK,
        reach: float = _REACH,
        even: bool = False,
    ) -> None:
        self.backend, self.dtype, self._lag, self._even = backend, dtype, abs(lag), even
        self._ahead = _corners_ahead(toward, lag) if lag else []
        blocks = [next(size for size in range(block, 0, -1) if points % size == 0) for points in shape]
        self.shape = shape[0] // blocks[0], shape[1] // blocks[1]
        # Cosines over a half have the wavelengths of waves over both halves, less the shortest.
        along = np.fft.rfftfreq(self.shape[0], blocks[0]) if even else np.fft.fftfreq(self.shape[0], blocks[0])
        across = np.fft.rfftfreq((1 + even) * self.shape[1], blocks[1])
        wave_number = 2.0 * np.pi * np.hypot(along[:, None], across[: self.shape[1]] if even else across)
        self._weights = [self._array(np.exp(-each * wave_number)) for each in (reach, _FAR)]
        self._means = [self._array(np.full((1, size), 1.0 / size)) for size in blocks]
        self._lines = [self._array(_interpolation(size)) for size in blocks]
        self._moved: list[tuple[tuple[int, int], float]] = []
        if inverse is not None and min(self.shape) > 1:
            # One wave of a block's number gives the same values next to the origin, since the inverse decays fast.
            kernel = np.fft.irfft2(backend.to_numpy(inverse[:: blocks[0], :: blocks[1]]), self.shape)
            for x, y in _NEIGHBOURS:
                weight = -_MOVED * float(kernel[-x, -y] / kernel[0, 0])
                if weight > 0.0:
                    self._moved.append(((x, y), min(weight, _MOST_MOVED)))

    def on(self, contact: Cells) -> Callable[[AnyArray], AnyArray]:
        """Return the extension of values on a contact: from (n,) at its cells to (nx, ny); the next overwrites it."""
        trail, beyond = self._trail(contact), self.beyond(contact)
        (nx, ny), bx, by = self.shape, *(lines.shape[0] for lines in self._lines)
        found = self.backend.empty((nx, bx, ny * by), self.dtype)

        def extended(values: AnyArray) -> AnyArray:
            field = self._spread(beyond(values), found)
            for cells, rest, sources in trail:
                behind = rest * cells.gathered(field)
                for source, weight in sources:
                    behind += weight * self.backend.xp.take(values, source)
                field = cells.inserted(field, behind)
            return contact.inserted(field, values)

        return extended

    def beyond(self, contact: Cells) -> Callable[[AnyArray], AnyArray]:
        """Return what gives each block (mx, my) its value beyond a contact, from the values (n,) on its cells."""
        xp = self.backend.xp
        shares = self._smoothed(self.means(contact.scattered(xp.ones_like(contact.indices, dtype=self.dtype))))
        near, far = (xp.clip(share, min=_LEAST) for share in shares)
        part = xp.clip((near / _ENOUGH) ** _POWER, max=1.0)
        near, far = part / near, (1.0 - part) / far

        def mixed(values: AnyArray) -> AnyArray:
            close, wide = self._smoothed(self.means(contact.scattered(values)))
            return close * near + wide * far

        return mixed

    def collecting(self, contact: Cells) -> Callable[[AnyArray], AnyArray]:
        """Return what brings pressures on the whole grid onto a contact: from (nx, ny) to (n,) at its cells."""
        xp, (nx, ny) = self.backend.xp, contact.chosen.shape
        inside, indices = xp.reshape(contact.chosen, (-1,)), contact.indices
        column = indices % ny
        moved = []
        for (x, y), weight in self._moved:
            # Several times quicker than remainders.
            neighbour = indices + (x * ny + y)
            if x:
                beyond, period = (neighbour >= nx * ny if x > 0 else neighbour < 0), x * nx * ny
            else:
                beyond, period = column == (ny - 1 if y > 0 else 0), y * ny
            neighbour = neighbour - period * xp.astype(beyond, indices.dtype)
            at = self.backend.cells(~xp.take(inside, neighbour))
            moved.append((at, at.gathered(neighbour), weight))

        def collected(field: AnyArray) -> AnyArray:
            found, flat = contact.gathered(field), xp.reshape(field, (-1,))
            for at, neighbour, weight in moved:
                found = at.inserted(found, at.gathered(found) + weight * xp.take(flat, neighbour))
            return found

        return collected

    def _trail(self, contact: Cells) -> list[tuple[Cells, float, list[tuple[AnyArray, AnyArray]]]]:
        """Return the cells behind the contact's edges, by distance.

        With the cells, the part of the mean that they keep, and the indices of their edge's values among the contact's
        cells, with weights.
        """
        xp, found, taken = self.backend.xp, [], contact.chosen
        nx, ny = contact.chosen.shape
        inside = xp.reshape(contact.chosen, (-1,))
        if not self._ahead:
            return []
        if all(len(corners) == 1 for corners in self._ahead) and not isinstance(contact, MaskedCells):
            return self._trail_along_axis(contact)
        for distance, corners in enumerate(self._ahead):
            reached = functools.reduce(
                operator.or_, (xp.roll(contact.chosen, (-x, -y), axis=(0, 1)) for (x, y), _ in corners)
            )
            cells = self.backend.cells(reached & ~taken)
            taken = taken | reached
            if len(cells) == 0:
                continue
            row, column = cells.indices // ny, cells.indices % ny
            places = [((row + x) % nx) * ny + (column + y) % ny for (x, y), _ in corners]
            fading = self._lag * (1.0 - distance / _TRAIL)
            if len(places) == 1:
                sources = [(xp.searchsorted(contact.indices, places[0]), fading)]
            else:
                weights = [
                    weight * xp.astype(xp.take(inside, place), self.dtype)
                    for place, (_, weight) in zip(places, corners, strict=True)
                ]
                scale = fading / sum(weights)
                # Outside the contact any index among its cells is correct, since the weight is zero.
                last = len(contact) - 1
                sources = [
                    (xp.clip(xp.searchsorted(contact.indices, place), max=last), weight * scale)
                    for place, weight in zip(places, weights, strict=True)
                ]
            found.append((cells, 1.0 - fading, sources))
        return found

    def _trail_along_axis(self, contact: Cells) -> list[tuple[Cells, float, list[tuple[AnyArray, AnyArray]]]]:
        """Return the same for a motion along an axis: from edge to edge, which is quicker."""
        xp, found = self.backend.xp, []
        nx, ny = contact.chosen.shape
        inside = xp.reshape(contact.chosen, (-1,))
        sources, row, column = xp.arange(len(contact)), contact.indices // ny, contact.indices % ny
        for distance, (((x, y), _),) in enumerate(self._ahead):
            cells = (row - x) % nx * ny + (column - y) % ny
            (free,) = xp.nonzero(~xp.take(inside, cells))
            if free.shape[0] == 0:
                break
            sources, row, column = (xp.take(one, free) for one in (sources, row, column))
            fading = self._lag * (1.0 - distance / _TRAIL)
            found.append((Cells(self.backend, contact.chosen, xp.take(cells, free)), 1.0 - fading, [(sources, fading)]))
        return found

    def means(self, field: AnyArray) -> AnyArray:
        """Means of a field (nx, ny) over blocks (mx, my)."""
        xp, (over_x, over_y) = self.backend.xp, self._means
        (nx, ny), bx, by = self.shape, over_x.shape[1], over_y.shape[1]

        def average(field: AnyArray, means: AnyArray) -> None:
            means[...] = xp.reshape(xp.matmul(xp.reshape(xp.matmul(over_x, field), (-1, by)), over_y[0, :]), (-1, ny))

        means = self.backend.empty(self.shape, self.dtype)
        self.backend.in_parts(average, xp.reshape(field, (nx, bx, ny * by)), means)
        return means

    def _smoothed(self, means: AnyArray) -> list[AnyArray]:
        """Weighted means around each block, those over near cells and those over far ones, of means over blocks."""
        transforms = self.backend.transforms
        if self._even:
            return [transforms.convolved_even(means, weights, self.shape) for weights in self._weights]
        waves = transforms.forward(means)
        return [transforms.inverse(waves * weights, self.shape) for weights in self._weights]

    def _spread(self, values: AnyArray, field: AnyArray) -> AnyArray:
        """Interpolate linearly between the centres of blocks, into a field by blocks along x (nx, bx, ny by)."""
        xp = self.backend.xp
        along_x, along_y = self._lines
        nx, bx, across = field.shape

        def interpolate(field: AnyArray, values: AnyArray) -> None:
            field[...] = xp.matmul(along_x, values)

        # Beyond either end of a half there is the same again, mirrored.
        beside = _with_neighbours(xp, values, 1, periodic=not self._even)
        values = xp.reshape(xp.matmul(beside, along_y.T), (nx, across))
        self.backend.in_parts(interpolate, field, _with_neighbours(xp, values, 0))
        return xp.reshape(field, (nx * bx, across))

    def _array(self, values: Array) -> AnyArray:
        return self.backend.xp.astype(self.backend.asarray(values), self.dtype)


def lag(symbol: AnyArray, points: int, toward: tuple[float, float]) -> float:
    """Return the lag of short waves along a direction (x and y, in cells): their loss angle over `_LATE`, one at most.

    Below zero if they lag behind the opposite motion.  `symbol` (nx, ny//2 + 1) is the operator's, `points` is ny.
    """
    length, sign = math.hypot(*toward), 1.0
    x, y = toward[0] / length, toward[1] / length
    if y < 0.0:
        x, y, sign = -x, -y, -1.0
    waves = [complex(symbol[round(symbol.shape[0] * x / cells), round(points * y / cells)]) for cells in _SHORT_WAVES]
    angle = max((math.atan2(wave.imag, wave.real) for wave in waves), key=abs)
    return sign * max(-1.0, min(1.0, angle / _LATE))


def _corners_ahead(toward: tuple[float, float], sign: float) -> list[list[tuple[tuple[int, int], float]]]:
    """Return the corners of the cell ahead in which each distance along the motion ends, with weights that interpolate.

    Weights that are zero are left out: along an axis one cell is left.
    """
    length = math.copysign(math.hypot(*toward), sign)
    found = []
    for distance in range(1, _TRAIL + 1):
        x, y = distance * toward[0] / length, distance * toward[1] / length
        left, low = math.floor(x), math.floor(y)
        right, high = x - left, y - low
        corners = {
            (left, low): (1.0 - right) * (1.0 - high),
            (left + 1, low): right * (1.0 - high),
            (left, low + 1): (1.0 - right) * high,
            (left + 1, low + 1): right * high,
        }
        found.append([(corner, weight) for corner, weight in corners.items() if weight > _LEAST_WEIGHT])
    return found


def _with_neighbours(xp: Any, values: AnyArray, axis: int, *, periodic: bool = True) -> AnyArray:
    """Return the values before, at and behind each place along an axis, along a new axis after it."""
    before, behind = (xp.roll(values, step, axis=axis) for step in (1, -1))
    if not periodic:
        before[:, 0], behind[:, -1] = values[:, 0], values[:, -1]
    return xp.stack([before, values, behind], axis=axis + 1)


def _interpolation(size: int) -> Array:
    """Weights (size, 3) that a block's cells give to the values before, at and behind its centre."""
    place = (np.arange(size) + 0.5) / size - 0.5
    return np.stack([np.maximum(-place, 0.0), 1.0 - np.abs(place), np.maximum(place, 0.0)], axis=1)
