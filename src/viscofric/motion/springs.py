"""One-dimensional profile of a body of revolution, for the method of dimensionality reduction.

A body of revolution f(r) in contact over one disc has the same indentation and load as the profile

    g(s) = s ∫₀^{π/2} f'(s sin θ) dθ

on a row of independent springs of stiffness E* per length (V. L. Popov, M. Heß, Method of Dimensionality Reduction in
Contact Mechanics and Friction, Springer 2015, chapter 3): F = 2E* ∫₀ᵃ (δ − g) ds, with g(a) = δ.

Where g grows, the contact is one disc in every history.  The difference z = u₁ − u₂ of two springs with g₁ ≤ g₂ and the
difference of their forces obey the law of the material, f₁ − f₂ = E(0) z(t) + ∫ E'(t − t') z(t') dt', with E' ≤ 0.  So
f₁ ≥ f₂ at every time at which z is as large as ever before.  Were z to exceed g₂ − g₁, the first spring would be free
and f₁ − f₂ ≤ 0 at such a time, which cannot be: z ≤ g₂ − g₁.  It is equal to it whenever the second spring touches, so
that the first one then touches too, with f₁ ≥ f₂.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array, gauss
from viscofric.contact.indenters.indenter import Indenter
from viscofric.errors import InputError

_ANGLES, _ANGLE_WEIGHTS = (0.5 * math.pi * column for column in gauss(40))
#: Of integrals over a row up to the edge of the contact.
PLACES, SHARES = gauss(20)
_DIRECTIONS = np.array([0.3, 0.9, 1.5707963267948966, 2.2, 3.141592653589793, 4.4])
#: Rounding error of heights that should be the same in all directions.
_ROUND = 1e-9
_BISECTIONS = 200
#: Springs near the axis are as many times their own distance apart from it; the first one, in the common distance.
_GRADING, _FIRST = 8, 1e-3
#: Springs beyond the edge, and how far.
_FAR, _FARTHEST = 60, 4.0


class Balance(NamedTuple):
    """Springs that touch one after the other, up to where they are in balance."""

    depth: float  # m
    first: float  # depth at which the first of them touches, m
    touched: int  # number of springs that touch
    weight: float  # sum of their weights, m


@dataclass(frozen=True, eq=False)
class Springs:
    """A row of springs: profile and weights of the integral over both sides, and the modes of each."""

    g: Array  # (n,) m
    s: Array  # (n,) m
    weights: Array  # (n,) m
    instantaneous: float  # plane-strain compliance, 1/Pa
    compliances: Array  # (modes,)
    tau: Array
    walled: bool = False  # whether the last spring is at the edge of a punch

    @property
    def relaxed(self) -> float:
        """Compliance after an infinite time, 1/Pa."""
        return self.instantaneous + float(self.compliances.sum())

    def balance(self, threshold: Array, free: float, share: float = 1.0, held: float = 0.0) -> Balance:
        """Return where held δ + share Σ w (δ − b) = free, the sum over the springs that touch at δ; (n,) thresholds b.

        With the load times the compliance for `free` they carry the load.  Where nothing touches, δ is free over held,
        or without `held` the depth at which the first one is touched.
        """
        order = np.argsort(threshold, kind="stable")
        b, weights = threshold[order], self.weights[order]
        first = float(b[0])
        if free <= held * first:
            return Balance(free / held if held else first, first, 0, 0.0)
        total = np.cumsum(weights)
        depths = (free + share * np.cumsum(weights * b)) / (held + share * total)
        last = int(np.argmax(depths <= np.append(b[1:], np.inf)))
        return Balance(float(depths[last]), first, last + 1, float(total[last]))

    def edge(self, force: Array, threshold: Array, depth: float) -> float:
        """Return the contact radius between the last spring that touches and the next one, by their thresholds, m."""
        touching = np.flatnonzero(force > 0.0)
        if not len(touching):
            return 0.0
        last = int(touching[-1])
        if last + 1 == len(self.s):
            return float(self.s[-1])
        inside, outside = depth - threshold[last], threshold[last + 1] - depth
        return float(self.s[last] + (self.s[last + 1] - self.s[last]) * inside / (inside + outside))


def quadrature_error(values: Array, s: Array) -> float:
    """Return the error of the trapezoidal rule over both sides of a row, of values (n,) with kinks at contact edges."""
    # A kink in the middle of a cell makes a quarter of this error; there are kinks at the edge and where it was before.
    return float(np.max(np.abs(np.diff(values)) * np.diff(s)))


def is_body_of_revolution(indenter: Indenter) -> bool:
    """Return whether heights are the same in all directions, near the axis and far from it, and grow outwards."""
    if indenter.geometry.dimension != 2:
        return False
    reach = indenter.reach if math.isfinite(indenter.reach) else 1e-2
    radii = reach * np.array([1e-4, 1e-2, 0.1, 0.5])[:, None]
    try:
        along = np.asarray(indenter.height(radii, 0.0 * radii))
        around = np.asarray(indenter.height(radii * np.cos(_DIRECTIONS), radii * np.sin(_DIRECTIONS)))
    except InputError:  # beyond the edge of a height map
        return False
    if indenter.has_walls:
        return bool(np.array_equal(around, np.broadcast_to(along, around.shape)))
    return bool(np.all(np.abs(around - along) <= _ROUND * np.abs(along)) and np.all(np.diff(along[:, 0]) > 0.0))


def profile(indenter: Indenter, s: Array) -> Array:
    """Return g(s), m; infinite beyond the edge of a punch."""
    s = np.asarray(s, dtype=float)
    if indenter.has_walls:
        return np.asarray(indenter.height(s, np.zeros_like(s)))
    r = s[..., None] * np.sin(_ANGLES)
    return np.asarray(s * (indenter.slope(r, np.zeros_like(r)) @ _ANGLE_WEIGHTS))


def disc_profile(indenter: Indenter, s: Array, edge: float) -> Array:
    """Return g(s), m, for contacts up to an edge; InputError if it does not grow outwards up to the edge."""
    g = profile(indenter, s)
    lowest = np.minimum.accumulate(g[::-1])[::-1]  # of what lies further out
    inside = s <= edge
    if np.any(g[inside] > lowest[inside] + _ROUND * np.abs(g[inside]).max()):
        raise InputError(
            f"indenter: the profile of the {indenter.noun} does not rise all the way outwards, so that its contact may "
            "be a ring; springs solve contacts that are one disc.",
            code="not-one-disc",
        )
    return g


def elastic_radius(indenter: Indenter, depth: float | None, load: float | None, modulus: float) -> float:
    """Return the contact radius on an elastic half-space of the plane-strain modulus E*, for a depth or a load, m."""
    if indenter.has_walls:
        return float(getattr(indenter, "radius"))  # noqa: B009  only a FlatPunch has vertical walls

    def excess(radius: float) -> float:
        edge = float(profile(indenter, np.array(radius)))
        if depth is not None:
            return edge - depth
        inner = float(SHARES @ profile(indenter, radius * PLACES))
        return 2.0 * modulus * radius * (edge - inner) - float(load or 0.0)

    return _root(excess)


def elastic_work(indenter: Indenter, radius: float, depth: float) -> float:
    """Return ∫₀ᵃ (δ − g)² ds, m³: the elastic energy of a contact of a radius, over E*."""
    return radius * float(SHARES @ np.square(depth - profile(indenter, radius * PLACES)))


def impact_radius(indenter: Indenter, energy: float, weight: float, modulus: float) -> float:
    """Return the largest contact radius on an elastic half-space after an impact of some energy under a weight, m."""
    # The energy of the springs is the kinetic energy plus the work of the weight.
    if indenter.has_walls:
        return elastic_radius(indenter, 0.0, None, modulus)

    def excess(radius: float) -> float:
        depth = float(profile(indenter, np.array(radius)))
        return modulus * elastic_work(indenter, radius, depth) - energy - weight * depth

    return _root(excess)


def row(indenter: Indenter, edge: float, count: int) -> tuple[Array, Array, Array]:
    """Return places, profile (`disc_profile`) and weights (of ∫ over both sides) of springs, evenly up to an edge."""
    s = np.linspace(0.0, edge, count + 1)
    return s, disc_profile(indenter, s, edge), both_sides(s)


def graded_row(indenter: Indenter, edge: float, count: int) -> tuple[Array, Array, Array]:
    """Return places, profile and weights of springs: `count` evenly up to an edge, closer near the axis."""
    # Near the axis the distances are in proportion to the place: a contact that begins there is resolved as well as one
    # that has grown.
    s = np.linspace(0.0, edge, count + 1)
    if not indenter.has_walls:
        more = math.ceil(math.log(_GRADING / _FIRST) / math.log1p(1.0 / _GRADING))
        near = np.geomspace(_FIRST * s[1], s[_GRADING], more + 1)[:-1]
        beyond = edge * np.geomspace(1.0, _FARTHEST, _FAR + 1)[1:]
        s = np.concatenate([[0.0], near, s[_GRADING:], beyond])
    return s, disc_profile(indenter, s, edge), both_sides(s)


def both_sides(s: Array) -> Array:
    """Return the weights of the trapezoidal rule for ∫ over both sides of a row."""
    weights = np.zeros(len(s))
    weights[:-1] += np.diff(s)
    weights[1:] += np.diff(s)
    return weights


def _root(excess: Callable[[float], float]) -> float:
    """Return where a growing function of a length is zero, by bisection of its logarithm."""
    low, high = -60.0, 20.0  # ln m
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(math.exp(middle)) < 0.0 else (low, middle)
        if high - low < 1e-12:
            break
    return math.exp(0.5 * (low + high))
