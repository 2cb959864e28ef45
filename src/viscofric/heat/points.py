"""Rise of temperature at points of the surface on which a disc or strip of heat moves, in units of the source.

The sources are summed along rays from the point, on which the kernel of `viscofric.heat.means` loses its pole.  On a
ray at the angle θ to the motion, from r1 to r2 within the disc ::

    T k/(q̄ a) = 1/2π ∫dθ ∫_{r1}^{r2} dr q/q̄ exp(−Pe r (1 − cos θ))

The integral along the ray is known for a uniform source.  Under a uniform strip T is the difference of
F(u) = ∫_0^u exp(−t) K0(|t|) dt at its ends, u (exp(−u)) (K0 − K1) + 1 where u > 0 (NIST DLMF, 10.43.8).
"""

from __future__ import annotations

import numpy as np

from viscofric.arrays import Array
from viscofric.heat.quadrature import unit_nodes

_ANGLES, _ALONG = 121, 81
_AT_ONCE = 128  # points, whose integrands are held at the same time


def disc_points(x: Array, y: Array, peclet: float, *, hertz: bool) -> Array:
    """Return T k/(q̄ a) at points (n,) in radii from the centre, x along the motion."""
    parts = range(0, len(x), _AT_ONCE)
    found = [_some_points(x[one : one + _AT_ONCE], y[one : one + _AT_ONCE], peclet, hertz) for one in parts]
    return np.concatenate(found) if found else np.zeros(0)


def _some_points(x: Array, y: Array, peclet: float, hertz: bool) -> Array:
    from scipy.special import exprel

    node, along = unit_nodes(_ANGLES), unit_nodes(_ALONG)
    starts, widths = _rays(x, y)  # (n, 3)
    angle = starts[..., None] + widths[..., None] * node.place
    weight = widths[..., None] * node.weight
    toward = x[:, None, None] * np.cos(angle) + y[:, None, None] * np.sin(angle)
    outside = (np.square(x) + np.square(y) - 1.0)[:, None, None]
    root = np.sqrt(np.maximum(np.square(toward) - outside, 0.0))
    first, last = -toward - root, -toward + root
    start = np.where(outside > 0.0, np.maximum(first, 0.0), 0.0)
    length = np.maximum(last - start, 0.0)
    decay = 2.0 * peclet * np.square(np.sin(0.5 * angle))
    if not hertz:
        return np.asarray(
            (weight * np.exp(-decay * start) * length * exprel(-decay * length)).sum((1, 2)) / (2 * np.pi)
        )
    total = np.zeros(len(x))
    for place, rest, part in zip(*along, strict=True):
        source = np.sqrt(np.maximum(length * rest * (start - first + length * place), 0.0))
        total += part * (weight * length * source * np.exp(-decay * (start + length * place))).sum((1, 2))
    return 1.5 * total / (2.0 * np.pi)


def _rays(x: Array, y: Array) -> tuple[Array, Array]:
    """Return first angles and widths (n, 3) of the parts in which the integral over the angle is smooth.

    They end where the ray points along the motion, at which the integrand peaks, and where it passes the centre
    closest, at which it has a kink for points at the edge; points outside see the disc between two tangents.
    """
    radius, centre = np.hypot(x, y), np.arctan2(y, x)
    half = np.where(radius > 1.0, np.arcsin(1.0 / np.maximum(radius, 1.0)), np.pi)
    low = np.where(radius > 1.0, centre + np.pi - half, 0.0)
    cuts = np.where(
        radius[:, None] > 1.0, np.stack([0.0 * centre, 0.0 * centre], 1), centre[:, None] + np.array([0.5, 1.5]) * np.pi
    )
    # Counted from the first angle on; those beyond the last one make a part of no width.
    within = np.minimum(np.mod(cuts - low[:, None], 2.0 * np.pi), 2.0 * half[:, None])
    ends = np.concatenate([np.zeros((len(x), 1)), np.sort(within, axis=1), 2.0 * half[:, None]], axis=1)
    return low[:, None] + ends[:, :-1], np.diff(ends, axis=1)


def strip_points(x: Array, peclet: float, *, hertz: bool) -> Array:
    """Return T k/(q̄ a) at distances (n,) from the middle, in half-widths; Pe is above zero."""
    from scipy.special import k0e

    if not hertz:
        return np.asarray(
            (_strip_integral(peclet * (x + 1.0)) - _strip_integral(peclet * (x - 1.0))) / (np.pi * peclet)
        )
    node = unit_nodes(_ANGLES)
    total = np.zeros(len(x))
    start = np.clip(x, -1.0, 1.0)  # the kernel's pole, for points on the strip
    for end in (-1.0, 1.0):
        to_end = np.abs(end - start)[:, None]
        distance = np.sign(end) * to_end * node.place
        source = np.sqrt(np.maximum(1.0 - np.square(start[:, None] + distance), 0.0))
        ahead = distance + (start - x)[:, None]
        z = np.maximum(peclet * np.abs(ahead), 1e-300)  # the pole of a part without length, at an edge
        kernel = k0e(z) * np.where(ahead > 0.0, 1.0, np.exp(-2.0 * z))
        total += (to_end * node.weight * source * kernel).sum(1)
    return (4.0 / np.pi) * total / np.pi


def _strip_integral(u: Array) -> Array:
    from scipy.special import k0e, k1e

    size = np.maximum(np.abs(u), 1e-300)
    ahead = 1.0 + size * np.exp(-2.0 * size) * (k0e(size) - k1e(size))
    behind = 1.0 - size * (k0e(size) + k1e(size))
    return np.where(u > 0.0, ahead, behind)
