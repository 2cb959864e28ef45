"""Contacts much wider than an elastic layer is thick: Winkler's foundation, and the bonded incompressible layer."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arrays import Array
from viscofric.contact.reference._checks import load_and_lengths
from viscofric.errors import InputError
from viscofric.units import Quantity, checked_poisson_ratio, positive


@dataclass(frozen=True)
class ThinLayerContact:
    """A ball or a cylinder on a thin elastic layer: the limit a ≫ H."""

    half_width: float  # a, half the contact's width, m
    indentation: float  # m: a²/(2R) on a foundation; a²/(6R) (cylinder) or a²/(4R) (ball) on an incompressible layer
    max_pressure: float  # Pa
    exponent: int  # n of p = p_max (1 − r²/a²)^n: 1 on a foundation, 2 on an incompressible layer
    thickness: float  # H, m

    def pressure(self, x: ArrayLike, y: ArrayLike = 0.0) -> Array:
        """Pressure at (x, y) from the axis, in m; Pa, zero outside the contact."""
        r2 = (np.asarray(x, dtype=float) ** 2 + np.asarray(y, dtype=float) ** 2) / self.half_width**2
        return np.asarray(self.max_pressure * np.maximum(0.0, 1.0 - r2) ** self.exponent)


def foundation_modulus(
    modulus: Quantity, poisson_ratio: float, base: Literal["bonded", "frictionless"] = "bonded"
) -> float:
    """Return M (Pa) of a thin layer's foundation, p = M u/H, from E (Pa).

    A layer bonded to its base cannot move sideways: M = E(1−ν)/((1+ν)(1−2ν)).  One that slides on its base without
    friction expands along a wave but not across it: M = E/(1−ν²).  K. L. Johnson, Contact Mechanics (1985), Sec. 5.8.

    Raises InputError if a value is out of range, or the layer is bonded and incompressible: then it is no foundation.
    """
    if base not in ("bonded", "frictionless"):
        raise InputError(f"base = {base!r}: must be 'bonded' or 'frictionless'.", code="wrong-choice")
    E, nu = positive(modulus, "Pa", "modulus"), checked_poisson_ratio(poisson_ratio)
    if base == "frictionless":
        return E / (1.0 - nu**2)
    if nu == 0.5:
        raise InputError(
            "poisson_ratio = 0.5: a bonded incompressible layer is no foundation; see incompressible_ball.",
            code="incompressible",
        )
    return E * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu))


def winkler_ball(load: Quantity, radius: Quantity, thickness: Quantity, foundation: Quantity) -> ThinLayerContact:
    """Ball on a foundation: F = πM a⁴/(4RH); F in N, R in m, H in m, M in Pa, see `foundation_modulus`.

    The limit a ≫ H of an elastic layer; for a bonded layer also 1 − 2ν ≫ H²/a².  Raises InputError if a value is not
    above zero.
    """
    force, R, H, M = load_and_lengths(load, "N", radius, thickness, foundation)
    return _foundation((4.0 * force * R * H / (math.pi * M)) ** 0.25, R, H, M)


def winkler_line(
    load_per_length: Quantity, radius: Quantity, thickness: Quantity, foundation: Quantity
) -> ThinLayerContact:
    """Cylinder on a foundation: F' = 2M a³/(3RH), F' in N/m; see `winkler_ball`."""
    force, R, H, M = load_and_lengths(load_per_length, "N/m", radius, thickness, foundation)
    return _foundation((1.5 * force * R * H / M) ** (1.0 / 3.0), R, H, M)


def _foundation(a: float, R: float, H: float, M: float) -> ThinLayerContact:
    indentation = a**2 / (2.0 * R)
    return ThinLayerContact(a, indentation, M * indentation / H, 1, H)


def incompressible_ball(load: Quantity, radius: Quantity, thickness: Quantity, modulus: Quantity) -> ThinLayerContact:
    """Ball on a thin bonded layer with ν = 0.5: F = πE a⁶/(96RH³), δ = a²/(4R); F in N, R in m, H in m, E in Pa.

    The limit a ≫ H.  Squeezed sideways like a viscous film, the layer's displacement is u = −(H³/E) ∇²p (in Fourier
    space û = q²H³ p̂/E); p and its slope vanish at the edge, since the layer's volume is constant.  K. L. Johnson,
    Contact Mechanics (1985), Sec. 5.8; M. J. Jaffar, Int. J. Mech. Sci. 31 (1989) 229.  Raises InputError if a value is
    not above zero.
    """
    force, R, H, E = load_and_lengths(load, "N", radius, thickness, modulus)
    a = (96.0 * force * R * H**3 / (math.pi * E)) ** (1.0 / 6.0)
    return ThinLayerContact(a, a**2 / (4.0 * R), E * a**4 / (32.0 * R * H**3), 2, H)


def incompressible_line(
    load_per_length: Quantity, radius: Quantity, thickness: Quantity, modulus: Quantity
) -> ThinLayerContact:
    """Cylinder on a thin bonded layer: F' = 2E a⁵/(45RH³), δ = a²/(6R), F' in N/m, as `incompressible_ball`."""
    force, R, H, E = load_and_lengths(load_per_length, "N/m", radius, thickness, modulus)
    a = (22.5 * force * R * H**3 / E) ** 0.2
    return ThinLayerContact(a, a**2 / (6.0 * R), E * a**4 / (24.0 * R * H**3), 2, H)
