"""Local quadratic regression: read a scattered curve between its points without assuming a form for it."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]

# Different abscissae that the kernel must reach beyond the three that a parabola needs, so that it smooths.
_NEIGHBOURS = 5
# Abscissae closer than this share of the bandwidth count as one.
_COINCIDENT = 1e-6


def smoothing_weights(points: Array, weights: Array, at: Array, bandwidth: float) -> Array:
    """Return the matrix that turns ordinates at the points into smoothed values.

    At each place a parabola is fitted by weighted least squares; its weights are those given times the
    tricube kernel (1 − |d/h|³)³ (W. S. Cleveland, J. Am. Stat. Assoc. 74 (1979) 829), h the bandwidth or,
    where points are
    sparse, just beyond the fifth nearest one.  With fewer than four different points the parabola becomes a
    line or a constant.

    Parameters
    ----------
    points : (n,) array
    weights : (n,) array
        Statistical weights, above zero.
    at : (m,) array
        Within the range of the points.
    bandwidth : float
        In the unit of the points.

    Returns
    -------
    (m, n) array
        Its rows sum to one.
    """
    ascending = np.sort(points)
    different = ascending[np.concatenate([[True], np.diff(ascending) > _COINCIDENT * bandwidth])]
    degree = min(2, max(0, different.size - 2)) if different.size != 2 else 1
    reach = min(_NEIGHBOURS, different.size)
    rows = np.empty((at.size, points.size))
    for row, place in enumerate(at):
        away = np.sort(np.abs(different - place))
        h = max(bandwidth, 1.1 * away[reach - 1])
        kernel = weights * np.maximum(0.0, 1.0 - np.abs((points - place) / h) ** 3) ** 3
        powers = np.vander((points - place) / h, degree + 1, increasing=True)
        root = np.sqrt(kernel)
        rows[row] = np.linalg.pinv(powers * root[:, None])[0] * root
    return rows
