"""Sneddon's rigid punches on an elastic half-space: flat cylinder and cone."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arrays import Array
from viscofric.contact.reference._checks import plane_strain_modulus
from viscofric.units import Quantity, positive


@dataclass(frozen=True)
class FlatPunchContact:
    """A flat-ended rigid cylinder pressed into an elastic half-space."""

    radius: float  # a, m
    indentation: float  # δ, m
    load: float  # F = 2aE*δ, N

    def pressure(self, x: ArrayLike, y: ArrayLike = 0.0) -> Array:
        """Pressure F/(2πa √(a² − r²)) at (x, y) from the axis, in m; Pa, infinite at the rim, zero outside."""
        r2 = (np.asarray(x, dtype=float) ** 2 + np.asarray(y, dtype=float) ** 2) / self.radius**2
        mean = self.load / (np.pi * self.radius**2)
        with np.errstate(divide="ignore"):
            inside = 0.5 * mean / np.sqrt(np.maximum(0.0, 1.0 - r2))
        return np.where(r2 <= 1.0, inside, 0.0)


def flat_punch(indentation: Quantity, radius: Quantity, modulus: Quantity, poisson_ratio: float) -> FlatPunchContact:
    """Sneddon's solution for a flat-ended cylinder; δ in m, a in m, E in Pa.

    I. N. Sneddon, Int. J. Eng. Sci. 3 (1965) 47, Sec. 6; K. L. Johnson, Contact Mechanics (1985), Eqs. 3.34-3.36.
    Raises InputError if a value is not above zero, or Poisson's ratio not between 0 and 0.5.
    """
    depth, a = positive(indentation, "m", "indentation"), positive(radius, "m", "radius")
    return FlatPunchContact(a, depth, 2.0 * a * plane_strain_modulus(modulus, poisson_ratio) * depth)


@dataclass(frozen=True)
class ConeContact:
    """A rigid cone pressed into an elastic half-space."""

    radius: float  # contact radius a, m
    indentation: float  # δ = πa s/2, with s the slope of the cone's flank, m
    mean_pressure: float  # p̄ = E* s/2 at any load, Pa; at the tip the pressure is (logarithmically) infinite

    def pressure(self, x: ArrayLike, y: ArrayLike = 0.0) -> Array:
        """Pressure p̄ arcosh(a/r) at (x, y) from the axis, in m; Pa, infinite at the tip, zero outside the contact."""
        r = np.hypot(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
        with np.errstate(divide="ignore"):
            return np.asarray(self.mean_pressure * np.arccosh(np.maximum(1.0, self.radius / r)))


def sneddon_cone(load: Quantity, slope: float, modulus: Quantity, poisson_ratio: float) -> ConeContact:
    """Sneddon's solution for a cone of height s·r; F in N, E in Pa.

    s = ∂h/∂r, the cotangent of the half-angle at the tip, is small, as in all of linear elasticity.  I. N. Sneddon,
    Int. J. Eng. Sci. 3 (1965) 47, Sec. 5; K. L. Johnson, Contact Mechanics (1985), Sec. 5.2.  Raises InputError if a
    value is not above zero, or Poisson's ratio not between 0 and 0.5.
    """
    force, steepness = positive(load, "N", "load"), positive(slope, "dimensionless", "slope")
    mean_pressure = 0.5 * plane_strain_modulus(modulus, poisson_ratio) * steepness
    radius = math.sqrt(force / (math.pi * mean_pressure))
    return ConeContact(radius, 0.5 * math.pi * radius * steepness, mean_pressure)
