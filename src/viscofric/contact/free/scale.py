"""Units of the solver: those of an elastic contact at E0, whatever the indenter's shape."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array, Mask
from viscofric.contact.free.geometry import Geometry
from viscofric.contact.free.grids import Extent, Grid
from viscofric.contact.indenters.indenter import Indenter
from viscofric.errors import InputError

# Directions over which an indenter's height at a distance is averaged.
_DIRECTIONS = 16
_BRACKETS = 200


@dataclass(frozen=True)
class Scale:
    """Units of length, depth and pressure; those of Hertz's contact at E0 for a ball and a cylinder.

    Whatever the shape, pressure = stiffness · depth/length, so that the half-space's relaxed compliance is one.
    """

    geometry: Geometry
    length: float  # m, a0 of a ball
    depth: float  # m, a0²/R of a ball
    stiffness: float  # E0/(1−ν²), with the indenter's compliance in series, Pa

    @property
    def pressure(self) -> float:
        """Unit of pressure, Pa."""
        return self.stiffness * self.slope

    @property
    def force(self) -> float:
        """Unit of load, N; N/m for a line contact."""
        return self.pressure * self.area

    @property
    def area(self) -> float:
        """Unit of area, m²; of width, m, for a line contact."""
        return float(self.length**self.geometry.dimension)

    @property
    def slope(self) -> float:
        """Unit of friction coefficients: a0/R of a ball."""
        return self.depth / self.length

    @classmethod
    def for_load(cls, indenter: Indenter, stiffness: float, load: float) -> Scale:
        """Return the units of the paraboloid with the indenter's mean height at its edge, at a load in N, or N/m."""
        geometry = indenter.geometry

        def load_at(length: float) -> float:
            return (
                geometry.parabolic_load * stiffness * length ** (geometry.dimension - 1) * _depth_at(indenter, length)
            )

        length = _crossing(load_at, load)
        return cls(
            geometry,
            length,
            load / (geometry.parabolic_load * stiffness * length ** (geometry.dimension - 1)),
            stiffness,
        )

    @classmethod
    def for_indentation(cls, indenter: Indenter, stiffness: float, indentation: float) -> Scale:
        """Return the units of the paraboloid with the indenter's mean height at its edge, at an indentation in m."""
        length = _crossing(lambda length: _depth_at(indenter, length), indentation)
        return cls(indenter.geometry, length, indentation, stiffness)


@dataclass(frozen=True)
class ScaledIndenter:
    """An indenter in such units, on axes along and across the motion."""

    indenter: Indenter
    scale: Scale
    toward: tuple[float, float] = (1.0, 0.0)  # unit vector of the motion over the indenter's own axes

    @property
    def has_tip(self) -> bool:
        """Whether the slope jumps at the lowest point."""
        return self.indenter.has_tip

    def similar(self) -> Indenter | None:
        """Return the indenter whose contacts are similar at all sizes; None if none is."""
        return self.indenter.similar()

    def height(self, x: Array, y: Array) -> Array:
        """Height above the lowest point."""
        return self.indenter.height(*self._turned(x, y)) / self.scale.depth

    def slope(self, x: Array, y: Array) -> Array:
        """Slope of the height along the motion."""
        return self._slope_along(self.toward, x, y)

    def slope_across(self, x: Array, y: Array) -> Array:
        """Slope of the height across the motion, to its left."""
        return self._slope_along((-self.toward[1], self.toward[0]), x, y)

    def extent(self, window: Grid, mask: Mask) -> Extent:
        """Extent of a set of cells along the indenter's own axes, m."""
        i, j = np.nonzero(mask)
        x, y = self._turned(window.x[i], window.y[j])
        along, across = (0.5 * self.scale.length * abs(one) for one in self.toward)
        half = along * window.spacing + across * window.width
        beside = across * window.spacing + along * window.width
        side = float(np.abs(y).max()) + beside if self.scale.geometry.dimension > 1 else 0.0
        return Extent(half - float(x.min()), float(x.max()) + half, side)

    def _turned(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Return places on the indenter's own axes, m."""
        along, across = (self.scale.length * one for one in self.toward)
        if across == 0.0:
            return along * x, along * y
        return along * x - across * y, across * x + along * y

    def _slope_along(self, direction: tuple[float, float], x: Array, y: Array) -> Array:
        place = self._turned(x, y)
        result = np.zeros(np.broadcast_shapes(np.shape(x), np.shape(y)))
        for part, slope in zip(direction, (self.indenter.slope, self.indenter.slope_across), strict=True):
            if part != 0.0:
                result += part * slope(*place)
        return result / self.scale.slope


def _depth_at(indenter: Indenter, length: float) -> float:
    """Indentation of the paraboloid with the indenter's mean height at a distance from the axis."""
    count = _DIRECTIONS if indenter.geometry.dimension > 1 else 2
    angle = 2.0 * np.pi * np.arange(count) / count
    across = np.sin(angle) if indenter.geometry.dimension > 1 else np.zeros(count)
    return 2.0 * float(np.mean(indenter.height(length * np.cos(angle), length * across)))


def _crossing(function: Callable[[float], float], target: float) -> float:
    """Distance at which a function that grows from zero crosses a value; it is nearly a power of the distance."""
    low = high = 1.0
    for _ in range(_BRACKETS):
        if function(low) < target:
            break
        low *= 0.125
    for _ in range(_BRACKETS):
        if function(high) >= target:
            break
        high *= 8.0
    if not function(low) < target <= function(high):
        raise InputError(
            "the indenter's height does not rise from its lowest point; give a surface that does.", code="flat"
        )

    def beyond(log_distance: float) -> float:
        return math.log(max(function(math.exp(log_distance)), sys.float_info.min)) - math.log(target)

    return math.exp(root(beyond, math.log(low), math.log(high)))


def root(function: Callable[[float], float], below: float, above: float) -> float:
    """Return where a difference of logarithms is zero, from places where it is below and above zero; to rounding.

    By the rule of false position (Illinois: M. Dowell, P. Jarratt, BIT 11 (1971) 168), by halves where that stands
    still.  SciPy's methods take longer to import than the contact of a ball to solve.
    """
    low, high, before = function(below), function(above), 0.0
    while below < (middle := 0.5 * (below + above)) < above:
        place = below - low * (above - below) / (high - low)
        place = place if below < place < above else middle
        now = function(place)
        if abs(now) <= 4.0 * sys.float_info.epsilon * max(1.0, abs(place)):
            return place
        # An end that stays twice counts half, so that the other one soon passes the root.
        if now < 0.0:
            below, low, high = place, now, high * (0.5 if before < 0.0 else 1.0)
        else:
            above, high, low = place, now, low * (0.5 if before > 0.0 else 1.0)
        before = now
    return middle
