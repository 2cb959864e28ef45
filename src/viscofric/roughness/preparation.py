"""Steps that prepare a measured surface: trends taken off, edges tapered, pieces cut out, grids changed."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import InputError, brief, check_choice
from viscofric.units import Quantity, to_si

if TYPE_CHECKING:
    from viscofric.arrays import Array


_TOLD = {
    "mean": "mean height removed",
    "tilt": "tilt removed: least-squares plane",
    "curvature": "curvature removed: least-squares paraboloid",
}
_DEGREES = {"mean": 0, "tilt": 1, "curvature": 2}


def without_trend(heights: Array, what: str) -> tuple[Array, str]:
    """Return heights less a least-squares polynomial of degree 0, 1 or 2 in x and y, and what was done."""
    check_choice(what, "what", *_DEGREES)
    known = ~np.isnan(heights)
    # Legendre polynomials on [−1, 1] keep the equations well conditioned.
    s = [np.linspace(-1.0, 1.0, n) if n > 1 else np.zeros(1) for n in heights.shape]
    along = np.polynomial.legendre.legvander(s[0], 2)
    across = np.polynomial.legendre.legvander(s[1], 2)
    pairs = [
        (i, j) for i in range(_DEGREES[what] + 1) for j in range(_DEGREES[what] + 1 - i if heights.shape[1] > 1 else 1)
    ]
    if np.count_nonzero(known) < len(pairs):
        raise InputError(f"the {what} has {len(pairs)} terms, more than there are heights.")
    # Normal equations, term by term, so that a large scan is not copied once per term.
    z = np.where(known, heights, 0.0)
    weight = known.astype(float)
    right = np.array([along[:, i] @ z @ across[:, j] for i, j in pairs])
    matrix = np.array(
        [[(along[:, i] * along[:, k]) @ weight @ (across[:, j] * across[:, m]) for k, m in pairs] for i, j in pairs]
    )
    terms = np.linalg.lstsq(matrix, right, rcond=None)[0]
    trend = sum(term * np.multiply.outer(along[:, i], across[:, j]) for term, (i, j) in zip(terms, pairs, strict=True))
    return np.asarray(heights - trend), _TOLD[what]


def tapered(heights: Array, edge: float) -> Array:
    """Return heights that fall to their mean towards all edges, over a share of each length."""
    share = to_si(edge, "dimensionless", "edge")
    if not 0.0 < share <= 0.5:
        raise InputError(f"edge = {share:g}: must lie above 0 and be 0.5 at most.")
    window = np.ones(heights.shape)
    for axis, points in enumerate(heights.shape):
        if points > 1:
            # Distance from the nearer end; the point after the last is the first, where the window is zero.
            place = np.arange(points)
            distance = np.minimum(place, points - place) / points
            fall = 0.5 - 0.5 * np.cos(np.pi * np.minimum(distance / share, 1.0))
            window *= fall[:, None] if axis == 0 else fall
    mean = float((window * heights).sum() / window.sum())
    return np.asarray(mean + window * (heights - mean))


def cropped(
    heights: Array,
    spacing: tuple[float, float],
    x: tuple[Quantity, Quantity] | None,
    y: tuple[Quantity, Quantity] | None,
) -> tuple[Array, str]:
    """Return the heights between two positions along each axis, and what was done."""
    cut, told = [], []
    for axis, given in (("x", x), ("y", y)):
        points, step = heights.shape["xy".index(axis)], spacing["xy".index(axis)]
        if given is None:
            cut.append(slice(0, points))
            continue
        try:
            first, last = (to_si(one, "m", f"{axis} of the piece") for one in given)
        except (TypeError, ValueError) as error:
            if isinstance(error, InputError):
                raise
            raise InputError(f"{axis} = {brief(given)}: must be two positions, from and to.") from None
        # A position counts as on a point within a millionth of the spacing.
        start, stop = max(math.ceil(first / step - 1e-6), 0), min(math.floor(last / step + 1e-6) + 1, points)
        if stop - start < (2 if axis == "x" else 1):
            raise InputError(
                f"{axis} = {brief(given)}: too few points lie there; it ends at {(points - 1) * step:.4g} m."
            )
        cut.append(slice(start, stop))
        told.append(f"{axis} from {start * step:.4g} to {(stop - 1) * step:.4g} m")
    return heights[cut[0], cut[1]].copy(), f"cropped: {', '.join(told) or 'nothing'}"


def resampled(
    heights: Array, spacing: tuple[float, float], wanted: tuple[float, float]
) -> tuple[Array, tuple[float, float]]:
    """Return heights at another spacing by cubic splines, averaged over new cells first where these are larger."""
    from scipy.interpolate import make_interp_spline
    from scipy.ndimage import uniform_filter1d

    found = [*spacing]
    for axis, (given, step) in enumerate(zip(spacing, wanted, strict=True)):
        points = heights.shape[axis]
        if points == 1:
            found[axis] = wanted[axis]
            continue
        length = (points - 1) * given
        count = math.floor(length / step * (1.0 + 1e-9)) + 1
        if count < 2:
            raise InputError(f"spacing = {step:g} m: fewer than two points would be left of {length:.4g} m.")
        cell = round(step / given)
        if cell > 1:
            heights = uniform_filter1d(heights, cell, axis, mode="nearest")
        spline = make_interp_spline(given * np.arange(points), heights, min(3, points - 1), axis=axis)
        heights = np.asarray(spline(np.minimum(step * np.arange(count), length)))
        found[axis] = step
    return heights, (found[0], found[1])
