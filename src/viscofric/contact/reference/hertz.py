"""Hertz's contacts of rigid curved bodies with an elastic half-space: ball, cylinder and ellipsoid."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arrays import Array
from viscofric.contact.reference._checks import plane_strain_modulus
from viscofric.errors import InputError
from viscofric.units import Quantity, positive


def semi_ellipse(square: Array) -> Array:
    """√(1 − s²) from s², and zero beyond s = 1: the shape of every pressure of Hertz."""
    return np.asarray(np.sqrt(np.maximum(0.0, 1.0 - square)))


@dataclass(frozen=True)
class HertzContact:
    """Hertz's contact of a ball with an elastic half-space."""

    radius: float  # contact radius a, m
    indentation: float  # δ = a²/R, m
    max_pressure: float  # p0 = 3F/(2πa²), Pa

    def pressure(self, x: ArrayLike, y: ArrayLike = 0.0) -> Array:
        """Pressure p0 √(1 − r²/a²) at (x, y) from the axis, in m; Pa, zero outside the contact."""
        r2 = np.asarray(x, dtype=float) ** 2 + np.asarray(y, dtype=float) ** 2
        return self.max_pressure * semi_ellipse(r2 / self.radius**2)


def hertz_ball(load: Quantity, ball_radius: Quantity, modulus: Quantity, poisson_ratio: float) -> HertzContact:
    """Hertz's solution for a rigid ball on an elastic half-space; F in N, R in m, E in Pa.

    K. L. Johnson, Contact Mechanics (1985), Eqs. 4.22-4.24.  Raises InputError if a value is not above zero, or
    Poisson's ratio not between 0 and 0.5.
    """
    force, curvature = positive(load, "N", "load"), positive(ball_radius, "m", "ball_radius")
    radius = (3.0 * force * curvature / (4.0 * plane_strain_modulus(modulus, poisson_ratio))) ** (1.0 / 3.0)
    return HertzContact(radius, radius**2 / curvature, 1.5 * force / (math.pi * radius**2))


@dataclass(frozen=True)
class HertzLineContact:
    """Hertz's contact of a cylinder with an elastic half-space, in plane strain.

    The indentation of a line contact has no value of its own: displacements grow like the logarithm of the distance
    from which they are counted.
    """

    half_width: float  # a, m
    max_pressure: float  # p0 = 2F'/(πa), Pa, with F' the load per length

    def pressure(self, x: ArrayLike) -> Array:
        """Pressure p0 √(1 − x²/a²) at x from the axis, in m; Pa, zero outside the contact."""
        return self.max_pressure * semi_ellipse((np.asarray(x, dtype=float) / self.half_width) ** 2)


def hertz_line(
    load_per_length: Quantity, cylinder_radius: Quantity, modulus: Quantity, poisson_ratio: float
) -> HertzLineContact:
    """Hertz's solution for a rigid cylinder on an elastic half-space; F' in N/m, R in m, E in Pa.

    K. L. Johnson, Contact Mechanics (1985), Eqs. 4.43-4.45.  Raises InputError if a value is not above zero, or
    Poisson's ratio not between 0 and 0.5.
    """
    force = positive(load_per_length, "N/m", "load_per_length")
    radius = positive(cylinder_radius, "m", "cylinder_radius")
    half_width = math.sqrt(4.0 * force * radius / (math.pi * plane_strain_modulus(modulus, poisson_ratio)))
    return HertzLineContact(half_width, 2.0 * force / (math.pi * half_width))


@dataclass(frozen=True)
class HertzEllipticContact:
    """Hertz's contact of a body with two radii of curvature: the contact is an ellipse."""

    semi_axis_x: float  # m, half the contact's size along x; larger along the larger radius of curvature
    semi_axis_y: float  # m, half the contact's size along y
    indentation: float  # δ, m
    max_pressure: float  # p0 = 3F/(2π × the product of the semi-axes), Pa

    def pressure(self, x: ArrayLike, y: ArrayLike) -> Array:
        """Pressure p0 √(1 − x²/a_x² − y²/a_y²) at (x, y) from the axis, in m; Pa, zero outside the contact."""
        along = np.asarray(x, dtype=float) / self.semi_axis_x
        across = np.asarray(y, dtype=float) / self.semi_axis_y
        return self.max_pressure * semi_ellipse(along**2 + across**2)


def hertz_ellipse(
    load: Quantity, radius_x: Quantity, radius_y: Quantity, modulus: Quantity, poisson_ratio: float
) -> HertzEllipticContact:
    """Hertz's solution for a rigid indenter of height x²/(2R_x) + y²/(2R_y) on an elastic half-space.

    F in N, R_x and R_y in m, E in Pa.  With a the larger semi-axis, b the smaller, g = b²/a², and R_F and R_D Carlson's
    symmetric elliptic integrals (which, unlike differences of K and E, lose no digits for g near 1; DLMF 19.25.1)::

        R_large/R_small = R_D(0, 1, g)/R_D(0, g, 1),    δ = p0 b R_F(0, g, 1)/E*,
        1/(2 R_large) = p0 b R_D(0, g, 1)/(3 a² E*),    p0 = 3F/(2π a b)

    K. L. Johnson, Contact Mechanics (1985), Eqs. 4.24-4.27 (with e² = 1 − g).  Raises InputError if a value is not
    above zero, Poisson's ratio not between 0 and 0.5, or the radii are more than a factor of 1e9 apart (then it is a
    line contact).
    """
    from scipy.optimize import brentq
    from scipy.special import elliprd, elliprf

    force = positive(load, "N", "load")
    radii = positive(radius_x, "m", "radius_x"), positive(radius_y, "m", "radius_y")
    modulus_star = plane_strain_modulus(modulus, poisson_ratio)
    large, small = max(radii), min(radii)
    wanted = math.log(large / small)

    if wanted > math.log(1e9):
        raise InputError(
            f"the radii {radii[0]:g} m and {radii[1]:g} m are more than a factor of 1e9 apart: this is a line contact; "
            "use hertz_line.",
            code="out-of-range",
        )

    def mismatch(log_g: float) -> float:
        g = math.exp(log_g)
        return math.log(elliprd(0.0, 1.0, g) / elliprd(0.0, g, 1.0)) - wanted

    g = math.exp(brentq(mismatch, -45.0, 1e-9, xtol=1e-14, rtol=1e-14))
    long_axis = float(force * large * elliprd(0.0, g, 1.0) / (math.pi * modulus_star)) ** (1.0 / 3.0)
    short_axis = long_axis * math.sqrt(g)
    max_pressure = 1.5 * force / (math.pi * long_axis * short_axis)
    indentation = float(max_pressure * short_axis * elliprf(0.0, g, 1.0) / modulus_star)
    along_x, along_y = (long_axis, short_axis) if radii[0] >= radii[1] else (short_axis, long_axis)
    return HertzEllipticContact(along_x, along_y, indentation, max_pressure)
