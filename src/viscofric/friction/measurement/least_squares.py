"""Least squares as what it makes of readings: the linear operator behind every coefficient."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from viscofric.arrays import Array, Indices
    from viscofric.friction.measurement.conditions import Condition


def regressors(group: Condition, *, offset: bool, coulomb: bool) -> Array:
    """Signs that go with zero, viscoelastic and Coulomb friction; zeros for what is not fitted."""
    return np.stack(
        [np.full(group.rows.size, float(offset)), group.disc_sign, group.slip_sign * float(coulomb)], axis=1
    )


def told_apart(group: Condition, *, offset: bool, coulomb: bool) -> bool:
    """Whether the signs alone, whatever the jitter of the loads, tell the unknowns apart."""
    return _full_rank(group.signs, offset, coulomb)


@lru_cache(maxsize=512)
def _full_rank(signs: frozenset[tuple[int, int]], offset: bool, coulomb: bool) -> bool:
    unknowns = 1 + offset + (coulomb and any(slip for _, slip in signs))
    columns = [(float(offset), disc, slip * coulomb) for disc, slip in signs]
    return int(np.linalg.matrix_rank(np.array(columns))) == unknowns


def operators(design: Array, crossed: Array | None, parts: list[Indices]) -> Array:
    """Return what makes the coefficients of readings, in each of several parts by itself.

    Parameters
    ----------
    design : (n, 3) array
        Regressors; those that are zero throughout are not fitted.
    crossed : (n,) array or None
        A fourth one, whose coefficient is fitted beside the others without changing theirs.
    parts : list of array of int
        Rows that are fitted together; each determines all coefficients.

    Returns
    -------
    (4, n) array
        (XᵀX)⁻¹Xᵀ of each part, in its columns, by the QR factors of X: the fit without `crossed` has the leading
        ones of the fit with it.  The sums of squares are the diagonal of (XᵀX)⁻¹.
    """
    used = np.flatnonzero(np.any(design != 0.0, axis=0))
    columns = design[:, used] if crossed is None else np.column_stack([design[:, used], crossed])
    operator = np.zeros((4, len(design)))
    for size in {part.size for part in parts}:
        rows = np.stack([part for part in parts if part.size == size])
        orthogonal, triangle = np.linalg.qr(columns[rows])
        inverse = np.linalg.inv(triangle)
        leading = inverse[:, : used.size, : used.size] @ np.swapaxes(orthogonal[:, :, : used.size], 1, 2)
        operator[used[:, None, None], rows] = np.swapaxes(leading, 0, 1)
        if crossed is not None:
            operator[3, rows] = np.einsum("kmp,kp->km", orthogonal, inverse[:, -1])
    return operator


def residuals(design: Array, crossed: Array | None, operator: Array, target: Array) -> tuple[Array, Array]:
    """Return what fits of all readings leave over of `target` (n, k), without and with the fourth regressor."""

    def left(values: Array) -> Array:
        return np.asarray(values - design @ (operator[:3] @ values))

    plain = left(target)
    if crossed is None:
        return plain, plain
    return plain, plain - left(crossed[:, None]) * (operator[3] @ target)
