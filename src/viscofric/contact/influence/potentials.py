"""Potential of a uniformly loaded cell of a half-space: 1/r integrated over a rectangle.

A shear stress of μ times the pressure along x adds μ β x/r² to 1/r, with β = (1−2ν)/(2(1−ν)): the surface sinks in
front of it and rises behind it (K. L. Johnson, Contact Mechanics (1985), Eqs. 3.19 and 3.75).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from viscofric.arrays import Array, Mask


class CellPotential(Protocol):
    """Displacement around a loaded cell, in units of the cell's length, but for the compliance."""

    def __hash__(self) -> int:
        """Cells are keys of tables that are kept."""

    @property
    def aspect(self) -> float:
        """Width of the cell across the motion over its length."""

    def __call__(self, x: Array, y: Array) -> Array:
        """Value at (x, y) from the cell's centre; even in y, and in x but for `drag`."""

    @property
    def drag(self) -> float:
        """Factor of the part that is odd in x, by shear; zero without."""

    def drag_slope(self, x: Array, y: Array) -> Array:
        """Return the derivative along x of the odd part (not on the lines through the cell's edges)."""


# Beyond this distance (in the cell's longer side) the multipole series of Love's form is right to 1e-10 and cheaper.
_FAR = 20.0


def cell_potential(x: Array, y: Array, aspect: float = 1.0) -> Array:
    """Integral of 1/r over the rectangle |x'| < 1/2, |y'| < aspect/2, seen from (x, y) in its plane.

    Closed form: A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377; K. L. Johnson, Contact Mechanics
    (1985), Eq. 3.25.  Far away: its multipole series up to the fourth moments of the rectangle.
    """
    x, y = np.broadcast_arrays(x, y)
    near, x2, y2, inverse2 = _from_afar(x, y, aspect)
    if aspect == 1.0:
        fourth = -7.0 / 1920.0 + (7.0 / 96.0) * x2 * y2
        result = np.sqrt(inverse2) * (1.0 + inverse2 * (1.0 / 24.0 + inverse2 * fourth))
    else:
        a2 = aspect**2
        second = ((2.0 * x2 - y2) + a2 * (2.0 * y2 - x2)) / 24.0
        # r⁵ ∂⁴(1/r) are 3(8x⁴ − 24x²y² + 3y⁴) and 3(4x⁴ − 27x²y² + 4y⁴), crosswise, for r = 1
        fourth = (8.0 * x2**2 - 24.0 * x2 * y2 + 3.0 * y2**2) + a2**2 * (8.0 * y2**2 - 24.0 * x2 * y2 + 3.0 * x2**2)
        mixed = a2 * (-4.0 * x2**2 + 27.0 * x2 * y2 - 4.0 * y2**2)
        fourth = fourth / 640.0 + mixed / 192.0
        result = aspect * np.sqrt(inverse2) * (1.0 + inverse2 * (second + inverse2 * fourth))
    if near.any():
        result[near] = _love(x[near], y[near], aspect)
    return result


def _from_afar(x: Array, y: Array, aspect: float) -> tuple[Mask, Array, Array, Array]:
    """Return where the multipole series is not to be used; and x²/r², y²/r² and 1/r² for it (anything there)."""
    x2, y2 = x * x, y * y
    r2 = x2 + y2
    least = (_FAR * max(1.0, aspect)) ** 2
    near = r2 < least
    inverse2 = 1.0 / np.where(near, least, r2)
    x2 *= inverse2
    y2 *= inverse2
    return near, x2, y2, inverse2


def _love(x: Array, y: Array, aspect: float) -> Array:
    def corner(a: Array, b: Array) -> Array:
        # a asinh(b/|a|) + b asinh(a/|b|); each term goes to zero with its first factor.
        with np.errstate(divide="ignore", invalid="ignore"):
            first = np.where(a == 0.0, 0.0, a * np.arcsinh(b / np.abs(a)))
            second = np.where(b == 0.0, 0.0, b * np.arcsinh(a / np.abs(b)))
        return first + second

    return _corner_sum(corner, x, y, aspect)


def _corner_sum(corner: Callable[[Array, Array], Array], x: Array, y: Array, aspect: float) -> Array:
    """Difference of an antiderivative over the four corners of the cell."""
    east, west, north, south = x + 0.5, x - 0.5, y + 0.5 * aspect, y - 0.5 * aspect
    return corner(east, north) - corner(east, south) - corner(west, north) + corner(west, south)


def shear_potential(x: Array, y: Array, aspect: float = 1.0) -> Array:
    """Integral of x/r² over the rectangle |x'| < 1/2, |y'| < aspect/2, seen from (x, y) in its plane."""

    def corner(a: Array, b: Array) -> Array:
        square = a * a + b * b
        logarithm = np.log(np.where(square == 0.0, 1.0, square))
        return np.asarray(0.5 * b * logarithm + a * _angle(a, b))

    x, y = np.broadcast_arrays(x, y)
    return _corner_sum(corner, x, y, aspect)


def shear_potential_slope(x: Array, y: Array, aspect: float = 1.0) -> Array:
    """Return the derivative along x of `shear_potential` (not on the lines x = ±1/2 through the cell's edges)."""
    x, y = np.broadcast_arrays(x, y)
    return _corner_sum(_angle, x, y, aspect)


def _angle(a: Array, b: Array) -> Array:
    return np.asarray(np.arctan(b / np.where(a == 0.0, np.inf, a)))


@dataclass(frozen=True)
class HalfSpaceCell:
    """Potential of a rectangular cell of the half-space; `aspect` is its width over its length.

    `drag` is μ β, with μ the shear stress along x over the pressure.
    """

    aspect: float = 1.0
    drag: float = 0.0

    def __call__(self, x: Array, y: Array) -> Array:
        """Integral of 1/r, with its part by shear, over the cell, seen from (x, y)."""
        found = cell_potential(x, y, self.aspect)
        return found + self.drag * shear_potential(x, y, self.aspect) if self.drag else found

    def drag_slope(self, x: Array, y: Array) -> Array:
        """Return the derivative along x of the part by shear."""
        return self.drag * shear_potential_slope(x, y, self.aspect)
