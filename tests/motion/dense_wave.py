"""A second solver for one periodic profile: the hereditary integral over the whole history, on a dense matrix.

The pressure is kept at points of the solid, and the surface moves by whole points or not at all in each step.  The
displacement is u(t) = G ∫ J(t − t') dp(t') with the creep compliance itself: no modes, no exponentials of steps, no
Fourier transforms in the motion.  Between the steps the pressure on a point of the solid is linear.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np

from viscofric.arrays import Array

_NODES, _WEIGHTS = (
    0.5 * (part + shift) for part, shift in zip(np.polynomial.legendre.leggauss(8), (1, 0), strict=True)
)


def displacement_matrix(points: int, spacing: float, poisson_ratio: float) -> Array:
    """Displacements, of zero mean, at points under unit pressures on points, for E = 1 on a half-space."""
    q = 2.0 * np.pi * np.abs(np.fft.fftfreq(points, spacing))
    symbol = np.divide(2.0 * (1.0 - poisson_ratio**2), q, out=np.zeros(points), where=q > 0.0)
    first = np.fft.ifft(symbol).real
    index = np.arange(points)
    return np.asarray(first[(index[:, None] - index) % points])


def marched(
    height: Array,
    matrix: Array,
    creep: Callable[[Array], Array],
    time: Array,
    shift: Array,
    pressure: Array,
) -> tuple[Array, Array]:
    """Return pressures (steps, points) on points of the surface, and depths, from an untouched solid.

    `height` (points) above the lowest point; `shift` (steps) of the surface in whole points; `pressure` (steps) mean.
    """
    points = len(height)
    past = np.zeros((len(time), points))  # on points of the solid
    seen, depths = [], []
    for n, now in enumerate(time):
        # ∫ J(t − t') dp = J(t − t0) p0 + Σ of the mean J over each step times the change of p
        means = [float(_WEIGHTS @ creep(now - a - (b - a) * _NODES)) for a, b in itertools.pairwise(time[: n + 1])]
        changes = np.diff(past[:n], axis=0)
        known = creep(now - time[0]) * past[0] if n else np.zeros(points)
        for mean, change in zip(means, changes, strict=False):
            known = known + mean * change
        last = means[-1] if n else float(creep(np.zeros(1))[0])
        if n:
            known = known - last * past[n - 1]
        # on points of the solid under those of the surface
        start = np.roll(height, shift[n])
        found, depth = _contact(last * matrix, start + matrix @ known, pressure[n])
        past[n] = found
        seen.append(np.roll(found, -shift[n]))
        depths.append(depth)
    return np.array(seen), np.array(depths)


def _contact(matrix: Array, height: Array, mean: float) -> tuple[Array, float]:
    """Solve K p + h = δ on a contact set that is corrected until it stays."""
    points = len(height)
    inside = height <= np.quantile(height, 0.5)
    for _ in range(200):
        n = int(inside.sum())
        system = np.zeros((n + 1, n + 1))
        system[:n, :n] = matrix[np.ix_(inside, inside)]
        system[:n, n], system[n, :n] = -1.0, 1.0
        found = np.linalg.solve(system, np.append(-height[inside], mean * points))
        pressure = np.zeros(points)
        pressure[inside] = found[:n]
        gap = matrix @ pressure + height - found[n]
        wanted = np.where(inside, pressure > 0.0, gap < -1e-13 * np.abs(height).max())
        if np.array_equal(wanted, inside):
            return pressure, float(found[n])
        inside = wanted
    raise AssertionError("the contact set does not settle")
