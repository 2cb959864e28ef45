"""The spectrum of an isotropic surface from that of lines across it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import nnls

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.arrays import Array


#: Weight of the second differences of the answer, which decide only what the lines leave open.
_SMOOTHNESS = 0.03
#: The density is not let fall below this share of what its neighbours are.
_FLOOR = 1e-2
_NODES = 12


def isotropic_density(q: Array, line: Callable[[Array], Array]) -> Array:
    """Solve C₁(q) = ∫ dp C(√(q² + p²)) for the density C of a surface at the points of that of its lines, C₁.

    C is sought as C₁(k)/k times a factor that is linear in ln k between the points, not below zero, by least squares of
    the relative misfit.  For C ∝ k^(−s) the factor is constant, Γ(s/2)/(√π Γ((s−1)/2)).
    """
    logs, count = np.log(q), len(q)
    place, weight = np.polynomial.legendre.leggauss(_NODES)
    rows = np.zeros((count - 1, count))
    for row in range(count - 1):
        # Ends of the segments of ln k, as distances p along the other axis, in which the integrand is smooth.
        ends = np.sqrt(np.maximum(np.square(q[row:]) - q[row] ** 2, 0.0))
        half = 0.5 * np.diff(ends)
        p = (0.5 * (ends[:-1] + ends[1:]))[:, None] + half[:, None] * place
        k = np.sqrt(q[row] ** 2 + np.square(p))
        values = 2.0 * half[:, None] * weight * line(k) / k
        segment = row + np.arange(len(half))[:, None]
        part = (np.log(k) - logs[segment]) / (logs[segment + 1] - logs[segment])
        np.add.at(rows[row], segment + np.zeros(k.shape, int), (1.0 - part) * values)
        np.add.at(rows[row], segment + 1 + np.zeros(k.shape, int), part * values)
    rows /= line(q[:-1])[:, None]
    bends = _SMOOTHNESS * np.diff(np.eye(count), 2, axis=0)
    right = np.concatenate([np.ones(count - 1), np.zeros(len(bends))])
    factor, _ = nnls(np.concatenate([rows, bends]), right)
    factor = np.maximum(factor, _FLOOR * float(np.median(factor)))
    return np.asarray(factor * line(q) / q)
