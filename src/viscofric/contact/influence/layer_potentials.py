"""Potential of a loaded cell of a layer on a rigid base: that of the half-space, and what the base takes from it.

A point load on an elastic layer of thickness H moves the surface at the distance r by (1−ν²)/(πE) g(r), and a line
load that at the distance x by 2(1−ν²)/(πE) g(x), with Θ from `viscofric.contact.bodies`::

    point    g = ∫_0^∞ Θ(qH) J0(qr) dq          = 1/r + ∫_0^∞ (Θ − 1) J0(qr) dq
    line     g = ∫_0^∞ Θ(qH) cos(qx)/q dq       = −ln(x/H) + ∫_0^∞ [(Θ(Q) − 1) cos(Qx/H) + e^(−Q)]/Q dQ

and a shear stress of μ times the pressure along x adds μ times, with X from the same place and its limit β::

    point    x/r ∫_0^∞ X(qH) J1(qr) dq           = β x/r² + x/r ∫_0^∞ (X − β) J1(qr) dq
    line     ∫_0^∞ X(qH) sin(qx)/q dq            = β (π/2) sgn x + ∫_0^∞ (X − β) sin(qx)/q dq

On a sliding layer X keeps its value X0 of long waves: X0 x/r² and X0 (π/2) sgn x are left at any distance.

The last integrals are smooth functions of r/H, whose nearest singularities lie at ±2i, since Θ − 1 and X − β fade like
e^(−2Q): they are tabulated once, and integrated over a cell by Gauss points, while the half-space's part is known in
closed form.  g fades exponentially over a few H, so that the potential has a finite reach; of a layer even a line
contact has a far field.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import ClassVar

import numpy as np

from viscofric.arrays import Array, Indices, gauss
from viscofric.contact.bodies import Layer, half_space_coupling
from viscofric.contact.influence.line import strip_potential, strip_shear
from viscofric.contact.influence.potentials import (
    cell_potential,
    shear_potential,
    shear_potential_slope,
)

#: Thinnest layer, in cells.  Of a thinner one the cells' own edges would be felt more than the contact.
THINNEST = 0.25
# Waves that are integrated over: panels in Q of 24 Gauss points.  Beyond, 1 − Θ is below 1e-15.
_WAVE_PANELS = np.linspace(0.0, 40.0, 81)
_POINTS = 24
# Tables: pieces in r/H with so many coefficients, right to 1e-12; they end where g r is below _FADED.
_PIECE = 0.5
_COEFFICIENTS = 10
_LONGEST = 50.0
_FADED = 1e-13
# Relative error of the integral over a cell.
_ACCURACY = 1e-11


@dataclass(frozen=True, eq=False)
class _Table:
    """A smooth function of r/H from zero on, piece by piece polynomials."""

    coefficients: Array
    reach: float

    def __call__(self, distance: Array) -> Array:
        """Value at r/H up to the reach; beyond it, the value at the end."""
        piece, t = self._locate(distance)
        result = np.asarray(self.coefficients[-1][piece])
        for row in self.coefficients[-2::-1]:
            result *= t
            result += row[piece]
        return result

    def _locate(self, distance: Array) -> tuple[Indices, Array]:
        count = self.coefficients.shape[1]
        scaled = np.minimum(distance / _PIECE, count)  # before it becomes an index: memories reach beyond all integers
        piece = np.minimum(scaled.astype(np.intp), count - 1)
        return piece, 2.0 * (scaled - piece) - 1.0


@lru_cache(maxsize=32)
def _taken_by_base(poisson_ratio: float, bonded: bool, line: bool) -> _Table:
    """Tabulate g(r/H) in units of H, less 1/r or −ln r."""
    from scipy.special import j0

    q, w = _waves()
    missing = w * (Layer(1.0, bonded).yielding(q, poisson_ratio) - 1.0)

    def taken(waves: Array) -> Array:
        if line:
            return np.asarray(np.cos(waves) @ (missing / q) + (w * np.exp(-q) / q).sum())
        return np.asarray(j0(waves) @ missing)

    return _tabulated(taken, (lambda r, found: found - np.log(r)) if line else lambda r, found: found * r + 1.0)


@lru_cache(maxsize=32)
def _shear_taken_by_base(poisson_ratio: float, bonded: bool, line: bool) -> _Table:
    """Tabulate the part of shear 1 in units of H, less β (π/2), or over r/H and less β/r²."""
    from scipy.special import j1

    q, w = _waves()
    layer, limit = Layer(1.0, bonded), half_space_coupling(poisson_ratio)
    missing = w * (layer.coupling(q, poisson_ratio) - limit)
    fading = limit - layer.long_coupling(poisson_ratio)

    def taken(waves: Array) -> Array:
        if line:
            return np.asarray(np.sin(waves) @ (missing / q))
        return np.asarray((j1(waves) / waves) @ (missing * q))

    left = 0.5 * np.pi * fading
    return _tabulated(taken, (lambda _, found: found + left) if line else lambda r, found: found * r**2 + fading)


def _waves() -> tuple[Array, Array]:
    """Return wave numbers times H, and weights of the integral over them."""
    return gauss(_POINTS, _WAVE_PANELS)


def _tabulated(taken: Callable[[Array], Array], left: Callable[[Array, Array], Array]) -> _Table:
    """Tabulate a function of r/H, given for the waves times r/H, until so little is left of the whole potential."""
    q = _waves()[0]
    nodes = np.polynomial.chebyshev.chebpts1(_COEFFICIENTS)
    to_powers = np.linalg.inv(np.vander(nodes, increasing=True))
    pieces = []
    start = 0.0
    while start < _LONGEST:
        distance = start + 0.5 * _PIECE * (1.0 + nodes)
        values = taken(q * distance[:, None])
        pieces.append(to_powers @ values)
        start += _PIECE
        if np.abs(left(distance, values)).max() < _FADED:
            break
    return _Table(np.array(pieces).T, start)


@lru_cache(maxsize=64)
def _cell_rule(length: float) -> tuple[Array, Array]:
    """Points and weights of a mean over a cell so many layers' thicknesses long, in units of the cell."""
    # Panels no longer than the layer is thick; on each the ellipse through the singularity 2 H beyond.
    panels = max(1, math.ceil(length))
    distance = 4.0 * panels / length
    ellipse = distance + math.hypot(distance, 1.0)
    order = max(2, math.ceil(-0.5 * math.log(_ACCURACY) / math.log(ellipse)))
    return gauss(order, np.arange(panels + 1.0) / panels - 0.5)


class _OnLayer:
    """What potentials of cells of point and of line contacts share: tables, and X of long and of short waves."""

    thickness: float
    bonded: bool
    poisson_ratio: float
    _line: ClassVar[bool] = False

    @cached_property
    def _table(self) -> _Table:
        return _taken_by_base(self.poisson_ratio, self.bonded, self._line)

    @cached_property
    def _shear_table(self) -> _Table:
        return _shear_taken_by_base(self.poisson_ratio, self.bonded, self._line)

    @property
    def _far(self) -> float:
        """X of long waves."""
        return Layer(1.0, self.bonded).long_coupling(self.poisson_ratio)

    @property
    def _limit(self) -> float:
        """X of short waves, less that of long ones."""
        return half_space_coupling(self.poisson_ratio) - self._far


@dataclass(frozen=True)
class LayerCell(_OnLayer):
    """Potential of a rectangular cell of a layer, in units of the cell's length.

    `drag` is the shear stress along x over the pressure.
    """

    thickness: float  # H
    bonded: bool
    poisson_ratio: float
    aspect: float = 1.0  # width of the cell over its length
    drag: float = 0.0

    @property
    def _reach(self) -> float:
        return max(self._table.reach, self._shear_table.reach) if self.drag else self._table.reach

    @cached_property
    def _points(self) -> Array:
        """Places in the cell and weights of the mean over it: (n, 3)."""
        across, weights_across = _cell_rule(self.aspect / self.thickness)
        along, weights_along = _cell_rule(1.0 / self.thickness)
        x, y = np.meshgrid(along, self.aspect * across)
        return np.stack([x.ravel(), y.ravel(), np.outer(weights_across, weights_along).ravel()], axis=1)

    def __call__(self, x: Array, y: Array) -> Array:
        """∫∫_cell g, with its part by shear, seen from (x, y)."""
        found = self._within_reach(x, y, self._near)
        if self.drag:
            found += self.drag * self._within_reach(x, y, self._near_shear)
        if self.drag * self._far:
            found += self.drag * self._far * shear_potential(x, y, self.aspect)
        return found

    def drag_slope(self, x: Array, y: Array) -> Array:
        """Return the derivative along x of the part by shear (not on the lines x = ±1/2 through the cell's edges)."""
        found = self._within_reach(x, y, self._near_shear_slope)
        if self._far:
            found += self._far * shear_potential_slope(x, y, self.aspect)
        return self.drag * found

    def _near(self, x: Array, y: Array) -> Array:
        taken = np.zeros_like(x)
        for dx, dy, weight in self._points:
            taken += weight * self._taken(np.hypot(x - dx, y - dy))
        return cell_potential(x, y, self.aspect) + self.aspect * taken

    def _near_shear(self, x: Array, y: Array) -> Array:
        taken = np.zeros_like(x)
        for dx, dy, weight in self._points:
            taken += weight * self._shear_taken(x - dx, y - dy)
        return self._limit * shear_potential(x, y, self.aspect) + self.aspect * taken

    def _near_shear_slope(self, x: Array, y: Array) -> Array:
        taken = np.zeros_like(x)
        for dy, weight in zip(*_cell_rule(self.aspect / self.thickness), strict=True):
            for end, sign in ((0.5, 1.0), (-0.5, -1.0)):
                taken += sign * weight * self._shear_taken(x + end, y - self.aspect * dy)
        return self._limit * shear_potential_slope(x, y, self.aspect) + self.aspect * taken

    def _shear_taken(self, x: Array, y: Array) -> Array:
        distance = np.hypot(x, y) / self.thickness
        beyond = distance >= self._shear_table.reach
        found = self._shear_table(distance)
        found[beyond] = -self._limit / distance[beyond] ** 2
        return np.asarray(found * (x / self.thickness**2))

    def _taken(self, r: Array) -> Array:
        distance = r / self.thickness
        beyond = distance >= self._table.reach
        found = self._table(distance) / self.thickness
        found[beyond] = -1.0 / r[beyond]
        return found

    def _within_reach(self, x: Array, y: Array, function: Callable[[Array, Array], Array]) -> Array:
        x, y = np.broadcast_arrays(x, y)
        inside = np.hypot(x, y) < self._reach * self.thickness + 1.0 + self.aspect
        result = np.zeros(x.shape)
        result[inside] = function(x[inside], y[inside])
        return result


@dataclass(frozen=True)
class LayerStrip(_OnLayer):
    """Potential of a cell of a line contact on a layer, in units of the cell's length; the same for all y.

    `drag` is the shear stress along x over the pressure.
    """

    _line: ClassVar[bool] = True
    aspect: ClassVar[float] = 1.0  # there is one row
    thickness: float  # H
    bonded: bool
    poisson_ratio: float
    drag: float = 0.0

    def __call__(self, x: Array, y: Array) -> Array:
        """∫_cell g, with its part by shear, seen from x."""
        x, _ = np.broadcast_arrays(x, y)
        return self._pressed(x) + self.drag * self._sheared(x) if self.drag else self._pressed(x)

    def drag_slope(self, x: Array, y: Array) -> Array:
        """Return the derivative along x of the part by shear (not for x = ±1/2)."""
        x, _ = np.broadcast_arrays(x, y)
        slope = np.where(np.abs(x) < 0.5, np.pi * (self._limit + self._far), 0.0)
        return self.drag * np.asarray(slope + self._shear_taken(x + 0.5) - self._shear_taken(x - 0.5))

    def _sheared(self, x: Array) -> Array:
        result = self._limit * strip_shear(x)
        for dx, weight in zip(*_cell_rule(1.0 / self.thickness), strict=True):
            result += weight * self._shear_taken(x - dx)
        result[np.abs(x) >= self._shear_table.reach * self.thickness + 1.0] = 0.0
        return np.asarray(result + self._far * strip_shear(x))

    def _shear_taken(self, x: Array) -> Array:
        distance = np.abs(x) / self.thickness
        beyond = distance >= self._shear_table.reach
        found = self._shear_table(distance)
        found[beyond] = -0.5 * np.pi * self._limit
        return np.asarray(np.sign(x) * found)

    def _pressed(self, x: Array) -> Array:
        result = strip_potential(x) + math.log(self.thickness)
        for dx, weight in zip(*_cell_rule(1.0 / self.thickness), strict=True):
            distance = np.abs(x - dx) / self.thickness
            beyond = distance >= self._table.reach
            taken = self._table(distance)
            taken[beyond] = np.log(distance[beyond])
            result += weight * taken
        result[np.abs(x) >= self._table.reach * self.thickness + 1.0] = 0.0
        return result
