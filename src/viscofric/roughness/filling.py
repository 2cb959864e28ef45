"""Heights for the points of a scan that have no reading."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import InputError

if TYPE_CHECKING:
    from viscofric.arrays import Array, Mask


def filled(heights: Array, spacing: tuple[float, float], periodic: bool, method: str) -> Array:
    """Return heights without NaN; see `viscofric.Topography.fill`."""
    holes = np.isnan(heights)
    if holes.all():
        raise InputError("all heights of the topography are missing; there is nothing to fill them from.")
    return (_harmonic if method == "harmonic" else _nearest)(heights, spacing, periodic, holes)


def _nearest(heights: Array, spacing: tuple[float, float], periodic: bool, holes: Mask) -> Array:
    from scipy.ndimage import distance_transform_edt

    count, pad = heights.shape, [(0, 0), (0, 0)]
    if periodic:
        # Half a period on either side holds the nearest point round the edge, too.
        pad = [(n // 2, n // 2) for n in count]
        holes = np.pad(holes, pad, mode="wrap")
    i, j = distance_transform_edt(holes, sampling=spacing, return_distances=False, return_indices=True)
    inner = tuple(slice(before, before + n) for (before, _), n in zip(pad, count, strict=True))
    found: Array = heights[(i[inner] - pad[0][0]) % count[0], (j[inner] - pad[1][0]) % count[1]]
    return found


def _harmonic(heights: Array, spacing: tuple[float, float], periodic: bool, holes: Mask) -> Array:
    """Solve Laplace's equation in the holes; an edge of the scan lets nothing through."""
    from scipy.sparse import coo_array, csr_array
    from scipy.sparse.linalg import spsolve

    places = np.flatnonzero(holes)
    number = np.full(heights.size, -1)
    number[places] = np.arange(len(places))
    ij = np.stack(np.unravel_index(places, heights.shape))
    diagonal, right = np.zeros(len(places)), np.zeros(len(places))
    rows, columns, values = [], [], []
    flat = heights.ravel()
    for axis in (0, 1):
        weight = (spacing[0] / spacing[axis]) ** 2
        points = heights.shape[axis]
        if points == 1:
            continue
        for step in (-1, 1):
            beside = ij.copy()
            beside[axis] += step
            inside = np.full(len(places), True) if periodic else (beside[axis] >= 0) & (beside[axis] < points)
            beside[axis] %= points
            neighbour = np.ravel_multi_index(tuple(beside), heights.shape)
            diagonal += weight * inside
            known = inside & (number[neighbour] < 0)
            right[known] += weight * flat[neighbour[known]]
            unknown = np.flatnonzero(inside & (number[neighbour] >= 0))
            rows.append(unknown)
            columns.append(number[neighbour[unknown]])
            values.append(np.full(len(unknown), -weight))
    own = np.arange(len(places))
    entries = np.concatenate([diagonal, *values])
    matrix = coo_array((entries, (np.concatenate([own, *rows]), np.concatenate([own, *columns]))))
    found = flat.copy()
    found[places] = spsolve(csr_array(matrix).tocsc(), right)
    return found.reshape(heights.shape)
