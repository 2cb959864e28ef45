"""Mean rise of temperature over a moving disc or strip of heat, for one of all, in units of the source.

In the steady state a point source Q that moves at v along x over the insulated surface of a half-space gives
T = Q/(2πkr) exp(−v (r + ξ)/2κ), at a distance r of which ξ is ahead (H. S. Carslaw, J. C. Jaeger, Conduction of Heat in
Solids (1959), Sec. 10.7).  The mean over a disc takes the share c(d) of heat that is at a distance d from points of the
disc, in all directions alike; the angle's integral is a Bessel function.  With Pe = va/2κ ::

    mean T k/(q̄ a) = 1/π ∫_0^2 c(d) exp(−Pe d) I0(Pe d) dd

c(d) is the heat, over q̄, on the part common to two discs of radius 1 whose centres are d apart.  Under a line source
the kernel is 1/π exp(−Pe ξ) K0(Pe |ξ|), and the mean over a strip takes its even part.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from viscofric.arrays import Array, unit_nodes
from viscofric.thermal import ThermalProperties

#: Nodes with which the means are exact to 1e-13 where Pe < 1e4, and to 1e-9 where Pe < 1e8.
_NODES = 161


def disc_mean(peclet: float, *, hertz: bool) -> float:
    """Return mean T k/(q̄ a) over the disc, of a uniform source or one like Hertz's pressure."""
    from scipy.special import i0e

    distance, common = _disc_overlap(hertz)
    return float(np.sum(common * i0e(peclet * distance))) / np.pi


def strip_mean(peclet: float, *, hertz: bool) -> float:
    """Return mean T k/(q̄ a) over the strip, of half-width a; Pe is above zero."""
    from scipy.special import k0e

    distance, common = _strip_overlap(hertz)
    # exp(−z) cosh(z) is free of overflow, and k0e is exp(z) K0.
    z = peclet * distance
    return float(np.sum(common * 0.5 * (1.0 + np.exp(-2.0 * z)) * k0e(z))) / np.pi


def face_resistance(body: ThermalProperties, speed: float, size: float, line: bool) -> float:
    """Return the mean rise per heat distributed like Hertz's pressure, K/W, or K m/W; infinite of a strip at rest."""
    # Of a disc of a radius `size`, m, or a strip of that half-width, at a speed over the body, m/s.
    peclet = speed * size / (2.0 * body.diffusivity)
    if line:
        return strip_mean(peclet, hertz=True) / (2.0 * float(body.conductivity)) if peclet > 0.0 else math.inf
    return disc_mean(peclet, hertz=True) / (math.pi * size * float(body.conductivity))


def pair_density(distance: Array, shape: str) -> Array:
    """Return the density of the distance d (n,) of a point under Hertz's pressure from one of the face."""
    # In the plane for a "disc", along the line, d of either sign, for a "strip".
    if shape == "disc":
        return _hertz_overlap(distance) / np.pi**2
    x = 1.0 - distance
    return np.asarray((x * np.sqrt(distance * (2.0 - distance)) + np.arcsin(x) + 0.5 * np.pi) / (2.0 * np.pi))


@lru_cache(maxsize=2)
def _disc_overlap(hertz: bool) -> tuple[Array, Array]:
    """Return distances d (n,) and c(d) with the weights of an integral over d."""
    node = unit_nodes(_NODES)
    d = 2.0 * node.place
    if hertz:
        common = _hertz_overlap(d)
    else:
        common = 2.0 * np.arccos(node.place) - 0.5 * d * np.sqrt(2.0 * node.rest * (2.0 + d))
    return d, 2.0 * node.weight * common


def _hertz_overlap(d: Array) -> Array:
    """Return ∫ (3/2) √(1 − r²) over the lens: beyond x = d/2 chords end on the source's circle, before on the other."""
    node, half = unit_nodes(_NODES), 0.5 * d
    beyond = 0.5 * np.pi * (1.0 - half - (1.0 - half**3) / 3.0)
    inside = (1.0 - half) * node.place[:, None]  # from the other circle's edge
    chord = np.sqrt(inside * (2.0 - inside))
    square = np.maximum(1.0 - np.square(d - 1.0 + inside), 1e-300)
    root = np.sqrt(2.0 * d * (1.0 - half) * node.rest[:, None])
    along = chord * root + square * np.arcsin(np.minimum(chord / np.sqrt(square), 1.0))
    return np.asarray(1.5 * (beyond + (1.0 - half) * (node.weight @ along)))


@lru_cache(maxsize=2)
def _strip_overlap(hertz: bool) -> tuple[Array, Array]:
    node = unit_nodes(_NODES)
    d = 2.0 * node.place
    x = 1.0 - d
    common = 2.0 * node.rest
    if hertz:
        common = (2.0 / np.pi) * (x * np.sqrt(d * common) + np.arcsin(x) + 0.5 * np.pi)
    return d, 2.0 * node.weight * common
