"""Mean rise of temperature of a contact along any path on a half-space, by heat that changes with time.

Heat released a time t ago over a contact that has moved on by d since raises the mean temperature of its face by

    M(d/a, κt/a²) / (ρc √(πκt) aⁿ)  per heat,      n = 2 of a disc, n = 1 of a strip, whose heat is per length,

M the density of the distance between a point of the source, distributed as Hertz's pressure, and one of the face, after
heat has spread by diffusion.  The loss is released below the face: it warms the face, heat on the face warms it, and it
warms itself, by M times means of the same kernel over its depths.  Heat is constant between two times.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.arrays import Array, gauss
from viscofric.heat.heating import Heating
from viscofric.heat.means import pair_density
from viscofric.thermal import ThermalProperties

if TYPE_CHECKING:
    from scipy.interpolate import RectBivariateSpline


#: κt/a² below which nothing has spread, and above which M is a normal distribution; sizes of the table between.
_LEAST, _MOST = 1e-4, 10.0
_TIMES, _PLACES, _RADII = 41, 81, 400
#: The loss is released over the depth z like z exp(−z/b), with b in sizes of the contact (see the theory page on heat).
_DEPTH = {"disc": 0.5, "strip": 0.65}
#: Over it, √(κt)/b is large.
_WIDE = 20.0
#: Standard deviations of diffusion beyond the reach of source and face at which nothing is left.
_REACH = 7.0
#: Of the distance between two points, along one axis: under Hertz's pressure and on the face.
_VARIANCE = {"disc": 1.0 / 5.0 + 1.0 / 4.0, "strip": 1.0 / 4.0 + 1.0 / 3.0}
_POWER = {"disc": 2, "strip": 1}
#: Gauss's rule on each part of an interval, longest part of the path in radii, most parts.
_NODES = 8
_STEP, _PARTS = 0.5, 256
#: Ends of parts in √(κt)/a.
_SPREADING = 0.5 * 2.0 ** np.arange(12)


class Passage(NamedTuple):
    """A contact along its path: times (n,), positions (n, 2), m, and radii or half-widths (n,), m."""

    time: Array
    position: Array
    size: Array
    shape: str  # "disc" or "strip"
    loss_size: Array | None = None  # (n,) of what releases the loss, m, where that is more than the face


class PathRise(NamedTuple):
    """Mean rises, K, of the face, the same in both bodies, and of the rubber where the loss is released; shared heat.

    Each with its part by the loss before the counterface has taken any of it; at each time, (n,).  Heat that the
    counterface takes since the time before, J or J/m.
    """

    face: Array
    face_by_loss: Array
    below: Array
    below_by_loss: Array
    counterface: Array


def path_rise(passage: Passage, coulomb: Array, loss: Array, heating: Heating) -> PathRise:
    """Return the rise along a path by Coulomb heat on the face and loss below it, heats (n,) since the time before."""
    # The loss is released below the face, and stays in the rubber; of the Coulomb heat each body takes so much that
    # both faces are equally warm at all times.
    count = len(passage.time)
    still = passage._replace(position=np.zeros_like(passage.position))
    rubber, across, by_loss_across, within = _responses(passage, heating.rubber)
    other = _responses(still, heating.counterface)[0]
    from_loss = by_loss_across @ loss
    taken, rise = np.zeros(count), np.zeros(count)
    for row in range(1, count):
        both = rubber[row, row] + other[row, row]
        if both > 0.0:
            warmth = from_loss[row] + rubber[row, : row + 1] @ coulomb[: row + 1] - rubber[row, :row] @ taken[:row]
            taken[row] = (warmth - other[row, :row] @ taken[:row]) / both
        rise[row] = other[row, : row + 1] @ taken[: row + 1]
    by_loss = within @ loss
    return PathRise(rise, from_loss, across @ (coulomb - taken) + by_loss, by_loss, taken)


def _responses(passage: Passage, body: ThermalProperties) -> Array:
    """Return rises at each time per heat of each interval before, (4, n, n)."""
    # By heat on the face, of the face and where the loss is released; by the loss, of the same two.
    count = len(passage.time)
    found = np.zeros((4, count, count))
    sizes = passage.size, passage.size if passage.loss_size is None else passage.loss_size
    for last in (np.flatnonzero(np.diff(passage.time) > 0.0) + 1).tolist():
        face, wide = (0.5 * float(size[last - 1] + size[last]) for size in sizes)
        if face > 0.0:
            found[:, last:, last] = _response(passage, body, last, face)[[0, 1, 1, 2]]
        if wide > face:
            found[2:, last:, last] = _response(passage, body, last, wide)[1:]
    return found


def _response(passage: Passage, body: ThermalProperties, last: int, radius: float) -> Array:
    """Return what heat of the interval that ends at the time `last` does at this time and each later one, (3, rows)."""
    time, places = passage.time, passage.position
    start, end = np.sqrt(time[last:] - time[last - 1]), np.sqrt(time[last:] - time[last])
    length = float(time[last] - time[last - 1])
    whole = length / (start + end)  # their difference, of intervals as short as rounding, too
    way = places[last] - places[last - 1]
    parts = min(_PARTS, 1 + math.ceil(math.hypot(*way) / (_STEP * radius)))
    # Parts by the path, and by the time in which heat spreads over the contact, which M changes with.
    spreading = radius / math.sqrt(body.diffusivity) * _SPREADING
    inside = np.clip((spreading - end[:, None]) / whole[:, None], 0.0, 1.0)
    even = np.broadcast_to(np.linspace(0.0, 1.0, parts + 1), (len(end), parts + 1))
    edges = np.sort(np.concatenate([even, inside], axis=1), axis=1)
    row, part = np.nonzero(np.diff(edges) > 0.0)
    node, weight = gauss(_NODES)
    width = (edges[row, part + 1] - edges[row, part])[:, None]
    place = (edges[row, part][:, None] + width * node).ravel()
    at = np.repeat(row, _NODES)
    root = end[at] + whole[at] * place  # √t, in which 1/√t has no pole
    share = (1.0 - place) * whole[at] * (start[at] + root) / length
    away = places[last + at] - places[last - 1] - share[:, None] * way
    spread = body.diffusivity * root**2 / radius**2
    scale = body.volume_heat * math.sqrt(math.pi * body.diffusivity) * radius ** _POWER[passage.shape]
    each = 2.0 * whole[at] * (width * weight).ravel() * density(np.hypot(*away.T) / radius, spread, passage.shape)
    each /= scale * length
    first = np.searchsorted(at, np.arange(len(end)))
    return np.add.reduceat(between_depths(spread, passage.shape) * each, first, axis=1)


def between_depths(spread: Array, shape: str) -> Array:
    """Return what heat does over what heat on the face does to the face, (3, n), as in `_responses`."""
    # At a depth z it is exp(−z²/4κt), between two depths ½ exp(−(z − z')²/4κt) + ½ exp(−(z + z')²/4κt). In the mean
    # over depths of the density z exp(−z/b)/b² their difference has the density (1 + d/b) exp(−d/b)/2b, their sum that
    # of s³ exp(−s/b)/6b⁴: with Iₙ = ∫ uⁿ exp(−u − b²u²/4κt) du these are I₁ and ¼ (I₀ + I₁) + I₃/12.
    zeroth, first, third = _moments(np.sqrt(spread) / _DEPTH[shape])
    return np.array([np.ones_like(spread), first, 0.25 * (zeroth + first) + third / 12.0])


def _moments(x: Array) -> tuple[Array, Array, Array]:
    """Return Iₙ = ∫ uⁿ exp(−u − u²/4x²) du over u > 0 for n = 0, 1, 3."""
    from scipy.special import erfcx

    near = np.minimum(x, _WIDE)
    zeroth = math.sqrt(math.pi) * near * erfcx(near)
    first = 2.0 * near**2 * (1.0 - zeroth)
    second = 2.0 * near**2 * (zeroth - first)
    third = 2.0 * near**2 * (2.0 * first - second)
    # Beyond, differences of nearly equal numbers: by powers of 1/4x².
    power = 0.25 / np.maximum(x, _WIDE) ** 2

    def series(n: int) -> Array:
        return np.asarray(np.polyval([math.factorial(n + 2 * k) / math.factorial(k) for k in range(4, -1, -1)], -power))

    wide = x > _WIDE
    return tuple(np.where(wide, series(n), one) for n, one in ((0, zeroth), (1, first), (3, third)))  # type: ignore[return-value]


def density(distance: Array, spread: Array, shape: str) -> Array:
    """Return M at distances d/a and κt/a², (n,)."""
    power = _POWER[shape]
    variance = _VARIANCE[shape] + 2.0 * spread
    found = np.exp(-0.5 * distance**2 / variance) / np.sqrt(2.0 * math.pi * variance) ** power
    near = spread < _MOST
    held = np.maximum(spread[near], _LEAST)
    reach = 2.0 + _REACH * np.sqrt(2.0 * held)
    place = distance[near] / reach
    values = _table(shape).ev(np.minimum(place, 1.0), np.log(held)) / reach**power
    found[near] = np.where(place < 1.0, np.maximum(values, 0.0), 0.0)
    return np.asarray(found)


@lru_cache(maxsize=2)
def _table(shape: str) -> RectBivariateSpline:
    """Tabulate M times the farthest distance to its power, over the distance in it and ln κt/a²."""
    from scipy.interpolate import RectBivariateSpline
    from scipy.special import i0e

    radius, weight = gauss(_RADII, (0.0, 2.0))
    common = weight * pair_density(radius, shape)
    place, logarithm = np.linspace(0.0, 1.0, _PLACES) ** 2, np.linspace(math.log(_LEAST), math.log(_MOST), _TIMES)

    def spread_out(distance: Array, spread: float) -> Array:
        ahead = np.exp(-np.square(distance[:, None] - radius) / (4.0 * spread))
        if shape == "disc":
            around = i0e(distance[:, None] * radius / (2.0 * spread))
            return np.asarray((ahead * around * radius / (2.0 * spread)) @ common)
        behind = np.exp(-np.square(distance[:, None] + radius) / (4.0 * spread))
        return np.asarray((ahead + behind) @ common) / math.sqrt(4.0 * math.pi * spread)

    columns = []
    for spread in np.exp(logarithm).tolist():
        reach = 2.0 + _REACH * math.sqrt(2.0 * spread)
        columns.append(reach ** _POWER[shape] * spread_out(reach * place, spread))
    return RectBivariateSpline(place, logarithm, np.array(columns).T)
