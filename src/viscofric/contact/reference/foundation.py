"""Cylinder and ball moving over a viscoelastic foundation with one retardation time: the exact thin layer.

Each point of a foundation is deformed by the pressure on itself alone.  With x ahead of the axis, d = a − x behind the
leading edge, l = vτ and λ = l/k the retardation and the relaxation length, and s = M0/(RH)::

    u = δ − x²/2R,   u − l u' = (H/M0) (p − λ p'),   p = u = 0 at the leading edge, so that δ = a²/2R and
    p/s = d (2a − d)/2 + (l − λ) [a (1 − e^(−d/λ)) − λ (e^(−d/λ) − 1 + d/λ)]

up to the trailing edge, where p is zero again.  A ball is a set of such strips side by side, a(y)² = a² − y².

W. D. May, E. L. Morris, D. Atack, J. Appl. Phys. 30 (1959) 1713 (cylinder); D. G. Flom, A. M. Bueche, J. Appl. Phys. 30
(1959) 1725 (ball).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arrays import Array, gauss
from viscofric.contact.reference._checks import load_and_lengths
from viscofric.errors import InputError
from viscofric.units import Quantity, positive

#: Speeds and moduli for which the closed form is computed: vτ over the elastic half-width at M0, and M∞/M0.
MEMORY_RANGE = (1e-9, 1e9)
MODULUS_RANGE = (1.0, 1e6)

# Strips of a ball: Gauss points in the angle φ of y = a sin φ.
_STRIPS = 60
_SERIES_TERMS = 24
_SMALL = 1.0


@dataclass(frozen=True)
class RollingFoundationContact:
    """A cylinder or a ball that moves towards +x over a foundation with one retardation time."""

    front: float  # m, from the axis to the leading edge, on the centre line of a ball
    rear: float  # m, from the axis to the trailing edge, which lies ahead of the axis where `rear` is negative
    indentation: float  # δ = front²/(2R), m
    friction_coefficient: float  # μ = ∫ p x dA/(R F)
    elastic_half_width: float  # a0 of the same contact with M0, m
    _strips: _Strips = field(repr=False)
    _pressure_unit: float = field(repr=False)

    def pressure(self, x: ArrayLike, y: ArrayLike = 0.0) -> Array:
        """Pressure at x ahead of the axis and y beside it (a ball), in m; Pa, zero outside the contact."""
        scale = self.elastic_half_width
        along, across = np.broadcast_arrays(np.asarray(x, dtype=float) / scale, np.asarray(y, dtype=float) / scale)
        a = np.sqrt(np.maximum(0.0, (self.front / scale) ** 2 - across**2))
        d = a - along
        # The formula is concave in d, so behind its second zero it stays negative.
        inside = np.maximum(0.0, self._strips.pressure(a, np.maximum(d, 0.0)))
        return np.asarray(self._pressure_unit * inside)


def rolling_foundation_line(
    load_per_length: Quantity,
    radius: Quantity,
    thickness: Quantity,
    foundation: Quantity,
    glassy_foundation: Quantity,
    tau: Quantity,
    speed: Quantity,
) -> RollingFoundationContact:
    """Cylinder rolling or sliding without friction towards +x over a viscoelastic foundation.

    F' (N/m), R (m), H (m); M0 and M∞ (Pa) of p = M u/H at rest and at infinite speed, see `foundation_modulus`;
    retardation time τ (s) and v (m/s), above zero.  The limit of a thin layer: front + rear ≫ H.  Edges and pressure
    are accurate to about 1e-12, the friction coefficient to about 1e-15 a0/R at low speed, where it is a small
    difference.

    Raises InputError if a value is not above zero, M∞ is less than M0 or more than 1e6 times M0, or vτ is less than
    1e-9 or more than 1e9 times the half-width of the elastic contact.
    """
    force, R, H, M = load_and_lengths(load_per_length, "N/m", radius, thickness, foundation, "foundation")
    a0 = (1.5 * force * R * H / M) ** (1.0 / 3.0)
    strips = _Strips.of(a0, M, glassy_foundation, tau, speed)
    return _assemble(strips, lambda a: strips.sums(np.array([a]))[:, 0], 2.0 / 3.0, a0, M / (R * H), R)


def rolling_foundation_ball(
    load: Quantity,
    radius: Quantity,
    thickness: Quantity,
    foundation: Quantity,
    glassy_foundation: Quantity,
    tau: Quantity,
    speed: Quantity,
) -> RollingFoundationContact:
    """Ball rolling or sliding without friction over a viscoelastic foundation; see `rolling_foundation_line`.

    F (N), R (m), H (m); M0 and M∞ (Pa); τ (s) and v (m/s).  Errors as for the cylinder.
    """
    force, R, H, M = load_and_lengths(load, "N", radius, thickness, foundation, "foundation")
    a0 = (4.0 * force * R * H / (math.pi * M)) ** 0.25
    strips = _Strips.of(a0, M, glassy_foundation, tau, speed)
    angle, weight = gauss(_STRIPS, (0.0, 0.5 * np.pi))
    cosine, weight = np.cos(angle), 2.0 * weight  # both halves of the ball

    def sums(a: float) -> Array:
        return strips.sums(a * cosine) @ (weight * a * cosine)

    return _assemble(strips, sums, 0.25 * math.pi, a0, M / (R * H), R)


def _assemble(
    strips: _Strips, sums: Callable[[float], Array], load: float, a0: float, stiffness: float, R: float
) -> RollingFoundationContact:
    """Find the front from the load (in units of a0 and s), and from it the rest."""
    from scipy.optimize import brentq

    # Nowhere is the foundation softer than M0, nor stiffer than k times that: then the front would be at k^(−1/3)
    # (cylinder) or k^(−1/4) (ball).
    lowest = 0.5 / math.sqrt(strips.ratio)
    front = float(brentq(lambda a: float(sums(a)[0]) / load - 1.0, lowest, 1.0 + 1e-9, xtol=1e-15, rtol=1e-14))
    total, moment = sums(front)
    length = float(strips.lengths(np.array([front]))[0])
    return RollingFoundationContact(
        front=a0 * front,
        rear=a0 * (length - front),
        indentation=(a0 * front) ** 2 / (2.0 * R),
        friction_coefficient=a0 / R * float(moment / total),
        elastic_half_width=a0,
        _strips=strips,
        _pressure_unit=stiffness * a0**2,
    )


@dataclass(frozen=True)
class _Strips:
    """The pressure on strips whose leading edges lie at a, all lengths in a0 and pressures in s a0²."""

    ratio: float
    memory: float

    @classmethod
    def of(cls, a0: float, M: float, glassy: Quantity, tau: Quantity, speed: Quantity) -> _Strips:
        ratio = positive(glassy, "Pa", "glassy_foundation") / M
        memory = positive(speed, "m/s", "speed") * positive(tau, "s", "tau") / a0
        if not MODULUS_RANGE[0] <= ratio <= MODULUS_RANGE[1]:
            raise InputError(
                f"glassy_foundation/foundation = {ratio:g}: must lie between 1 and {MODULUS_RANGE[1]:g}.",
                code="out-of-range",
            )
        if not MEMORY_RANGE[0] <= memory <= MEMORY_RANGE[1]:
            raise InputError(
                f"speed × tau is {memory:g} elastic half-widths: must lie between {MEMORY_RANGE[0]:g} and "
                f"{MEMORY_RANGE[1]:g}.",
                code="out-of-range",
            )
        return cls(ratio, memory)

    def pressure(self, a: Array, d: Array) -> Array:
        """Pressure at d behind the leading edges."""
        relaxation = self.memory / self.ratio
        y = d / relaxation
        memory = a * _remainder(1, y) - relaxation * _remainder(2, y)
        return np.asarray(0.5 * d * (2.0 * a - d) + (self.memory - relaxation) * memory)

    def lengths(self, a: Array) -> Array:
        """Lengths of the strips: where the pressure, divided by d, falls to zero (by bisection)."""
        low, high = np.zeros_like(a), 2.0 * a
        for _ in range(80):
            middle = 0.5 * (low + high)
            positive_there = self.pressure(a, middle) > 0.0
            low, high = np.where(positive_there, middle, low), np.where(positive_there, high, middle)
        return np.asarray(0.5 * (low + high))

    def sums(self, a: Array) -> Array:
        """∫ p dx and ∫ p x dx of each strip, (2, n)."""
        D = self.lengths(a)
        relaxation = self.memory / self.ratio
        y = D / relaxation
        second, third, fourth = (_remainder(order, y) for order in (2, 3, 4))
        slow = self.memory - relaxation
        load = a * D**2 / 2.0 - D**3 / 6.0 + slow * relaxation * (a * second - relaxation * third)
        # ∫_0^D of the same, for the integration of p d by parts
        again = a * D**3 / 6.0 - D**4 / 24.0 + slow * relaxation**2 * (a * third - relaxation * fourth)
        return np.stack([load, (a - D) * load + again])


def _remainder(order: int, y: Array) -> Array:
    """Return what n terms of its series leave of e^(−y), times (−1)^n: 1 − e^(−y), e^(−y) − 1 + y, … to all digits."""
    small = np.minimum(y, _SMALL)
    term = small**order / math.factorial(order)
    series = np.zeros_like(y)
    for k in range(order + 1, order + 1 + _SERIES_TERMS):
        series += term
        term = -term * small / k
    polynomial = sum((-y) ** k / math.factorial(k) for k in range(order))
    return np.where(y <= _SMALL, series, (-1.0) ** order * (np.exp(-y) - polynomial))
