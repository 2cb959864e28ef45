"""Units in which a contact is solved: those of an elastic contact at E0, whatever the indenter's shape."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from viscofric.contact.geometry import Geometry
    from viscofric.contact.grids import Extent
    from viscofric.contact.indenters import Indenter

    Array: TypeAlias = NDArray[np.float64]

# Directions in which an indenter is felt for its mean height at a distance.
_DIRECTIONS = 16
_BISECTIONS = 200


@dataclass(frozen=True)
class Scale:
    """Units of length, depth and pressure; those of Hertz's contact at E0 for a ball and a cylinder.

    Whatever the shape, pressure = stiffness · depth/length, so that the half-space's relaxed compliance is one.

    Attributes
    ----------
    geometry : Geometry
    length, depth : float
        m: a0 and a0²/R of a ball.
    stiffness : float
        E0/(1−ν²), with the indenter's compliance in series, Pa.
    """

    geometry: Geometry
    length: float
    depth: float
    stiffness: float

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
        """Return the units of the paraboloid that has the indenter's mean height at its edge, under a load.

        Parameters
        ----------
        indenter : Indenter
        stiffness : float
            Pa.
        load : float
            N, or N/m.
        """
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
        """Return the units of the paraboloid that has the indenter's mean height at its edge, at an indentation.

        Parameters
        ----------
        indenter : Indenter
        stiffness, indentation : float
            Pa and m.
        """
        length = _crossing(lambda length: _depth_at(indenter, length), indentation)
        return cls(indenter.geometry, length, indentation, stiffness)

    def extent(self, contact: Extent) -> Extent:
        """Bring the extent of a contact to SI units."""
        return contact._replace(**{name: self.length * value for name, value in contact._asdict().items()})


@dataclass(frozen=True)
class ScaledIndenter:
    """An indenter in such units, seen by one that looks along the motion.

    Attributes
    ----------
    indenter : Indenter
    scale : Scale
    direction : float
        1 for motion towards +x, −1 for motion towards −x.
    """

    indenter: Indenter
    scale: Scale
    direction: float = 1.0

    @property
    def has_walls(self) -> bool:
        """Whether the height jumps to infinity."""
        return self.indenter.has_walls

    def height(self, x: Array, y: Array) -> Array:
        """Height above the lowest point."""
        length = self.scale.length
        return self.indenter.height(self.direction * length * x, length * y) / self.scale.depth

    def slope(self, x: Array, y: Array) -> Array:
        """Slope of the height along the motion."""
        length = self.scale.length
        slope = self.indenter.slope(self.direction * length * x, length * y)
        return self.direction * slope / self.scale.slope


def _depth_at(indenter: Indenter, length: float) -> float:
    """Indentation of the paraboloid with the indenter's mean height at a distance from the axis."""
    count = _DIRECTIONS if indenter.geometry.dimension > 1 else 2
    angle = 2.0 * np.pi * np.arange(count) / count
    across = np.sin(angle) if indenter.geometry.dimension > 1 else np.zeros(count)
    return 2.0 * float(np.mean(indenter.height(length * np.cos(angle), length * across)))


def _crossing(function: Callable[[float], float], target: float) -> float:
    """Distance at which a function that grows from zero crosses a value, by bisection of its logarithm."""
    low = high = 1.0
    for _ in range(_BISECTIONS):
        if function(low) < target:
            break
        low *= 0.125
    for _ in range(_BISECTIONS):
        if function(high) >= target:
            break
        high *= 8.0
    if not function(low) < target <= function(high):
        raise InputError("the indenter's height does not rise from its lowest point; give a surface that does.")
    for _ in range(_BISECTIONS):
        middle = math.sqrt(low * high)
        if not low < middle < high:
            break
        low, high = (middle, high) if function(middle) < target else (low, middle)
    return low
