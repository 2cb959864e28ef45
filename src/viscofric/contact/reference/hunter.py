"""Hunter's rigid cylinder rolling over a half-space with one retardation time: the exact line contact.

With one retardation time τ, the operator 1 − l d/dx, l = vτ, turns the steady viscoelastic problem into an elastic
one.  The compliance that a wave of wavenumber q meets is S(−qv) = 1/E∞ + C/(1 − iql), so that ::

    U = (1 − l d/dx) u   and   P = (1 − (l/k) d/dx) p,    k = E∞/E0,

are displacement and pressure of an elastic half-space of modulus E0.  On the contact u' = −x/R, hence
U' = (l − x)/R, and the finite Hilbert transform is inverted by Chebyshev polynomials.  In units of the Hertz contact
at E0 (a0 and p0), with x = m + c t, −1 < t < 1 on the contact,

    P √(1 − t²) = A0 + A1 T1(t) + A2 T2(t),    A0 = 1/(2c),  A1 = l − m,  A2 = −c/2.

Two conditions are left: p = 0 at the rear edge, and u itself (not only U) follows the cylinder ahead of which the
surface is still free.  With β = ck/l, γ = c/l and modified Bessel functions they read ::

    A0 I0(β) − A1 I1(β) + A2 I2(β) = 0,      A0 K0(γ) + A1 K1(γ) + A2 K2(γ) = 0.

Written with ρ = I0/I1, r = I2/I1 = ρ − 2/β (at β), κ = K0/K1, K2/K1 = κ + 2/γ (at γ), the half-width c is the root of
one equation, and everything else follows without differences of nearly equal numbers:

    c² = (ρ + κ)/(r + K2/K1),     m = l (1 − 1/k) κ/(ρ + κ),
    μ R/a0 = m (1 − c²) + l (c² − 1/k).

S. C. Hunter, J. Appl. Mech. 28 (1961) 611; compare L. W. Morland, J. Appl. Mech. 29 (1962) 345.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import i0e, i1e, ive, k0e, k1e

from viscofric.arrays import Array, gauss
from viscofric.contact.reference._checks import plane_strain_modulus
from viscofric.contact.reference.hertz import HertzLineContact, hertz_line
from viscofric.errors import InputError
from viscofric.units import Quantity, positive

#: Speeds and moduli for which the closed form is computed: vτ/a0 and E∞/E0.
MEMORY_RANGE = (1e-9, 1e9)
MODULUS_RANGE = (1.0, 1e6)

# The pressure's integral is cut into panels that halve towards the point looked at, Gauss points on each.
_PANELS = 60
_GAUSS_POINTS = 20
_POSITIONS_AT_ONCE = 512


@dataclass(frozen=True)
class HunterContact:
    """A cylinder rolling or sliding without friction towards +x over a material with one retardation time."""

    half_width: float  # half the contact's width, m
    front: float  # m, from the cylinder's axis to the leading edge
    rear: float  # m, from the axis to the trailing edge, which lies ahead of the axis where `rear` is negative
    friction_coefficient: float  # μ = ∫ p x dx/(R F')
    max_pressure: float  # Pa
    modulus_ratio: float  # k = E∞/E0
    memory_length: float  # l = vτ/a0, with a0 the half-width of the Hertz contact at E0
    hertz: HertzLineContact = field(repr=False)

    def pressure(self, x: ArrayLike) -> Array:
        """Pressure at x ahead of the cylinder's axis, in m; Pa, zero outside the contact."""
        edges = _edges(self.modulus_ratio, self.memory_length)
        t = (np.asarray(x, dtype=float) / self.hertz.half_width - edges.middle) / edges.half_width
        inside = np.abs(t) < 1.0
        result = np.zeros(t.shape)
        result[inside] = self.hertz.max_pressure * edges.pressure(np.arccos(t[inside]))
        return result


def hunter_line(
    load_per_length: Quantity,
    radius: Quantity,
    E0: Quantity,
    E_inf: Quantity,
    tau: Quantity,
    speed: Quantity,
    poisson_ratio: float,
) -> HunterContact:
    """Exact steady line contact with a half-space of one retardation time; the cylinder moves towards +x.

    F' (N/m), R (m), relaxed and glassy modulus (Pa), retardation time τ (s; a standard linear solid's relaxation time
    is τ E0/E∞), v above zero (m/s).  Accurate to about 1e-14 (relative, the friction coefficient included), the
    pressures to about 1e-14 of the largest, for E∞/E0 from 1.01 to 1e4 and vτ/a0 from 1e-6 to 1e6.  S. C. Hunter, J.
    Appl. Mech. 28 (1961) 611.

    Raises InputError if a value is not above zero, E∞ is less than E0 or more than 1e6 times E0, or vτ/a0 lies outside
    1e-9 … 1e9.
    """
    hertz = hertz_line(load_per_length, radius, E0, poisson_ratio)
    ratio = plane_strain_modulus(E_inf, poisson_ratio, "E_inf") / plane_strain_modulus(E0, poisson_ratio, "E0")
    if not MODULUS_RANGE[0] <= ratio <= MODULUS_RANGE[1]:
        raise InputError(f"E_inf/E0 = {ratio:g}: must lie between 1 and {MODULUS_RANGE[1]:g}.", code="out-of-range")
    memory = positive(speed, "m/s", "speed") * positive(tau, "s", "tau") / hertz.half_width
    if not MEMORY_RANGE[0] <= memory <= MEMORY_RANGE[1]:
        raise InputError(
            f"speed × tau is {memory:g} Hertz half-widths: must lie between {MEMORY_RANGE[0]:g} and "
            f"{MEMORY_RANGE[1]:g}; beyond, the contact is Hertz's with E0 or E_inf.",
            code="out-of-range",
        )
    edges = _edges(ratio, memory)
    slope = hertz.half_width / positive(radius, "m", "radius")
    return HunterContact(
        half_width=hertz.half_width * edges.half_width,
        front=hertz.half_width * (edges.middle + edges.half_width),
        rear=hertz.half_width * (edges.half_width - edges.middle),
        friction_coefficient=slope * edges.friction,
        max_pressure=hertz.max_pressure * edges.max_pressure(),
        modulus_ratio=ratio,
        memory_length=memory,
        hertz=hertz,
    )


@dataclass(frozen=True)
class _Contact:
    """Hunter's contact in units of the Hertz contact at E0: c, m, μR/a0, and what its pressure is made of.

    `beta` is c k/l, and P sin φ = c sin²φ + `even` + `odd` cos φ with t = cos φ.
    """

    half_width: float
    middle: float
    friction: float
    beta: float
    even: float
    odd: float

    def pressure(self, angle: Array) -> Array:
        """Return p/p0 at t = cos(angle), angles from 0 (front) to π (rear)."""
        parts = [
            self._pressure(angle[start : start + _POSITIONS_AT_ONCE])
            for start in range(0, len(angle), _POSITIONS_AT_ONCE)
        ]
        return np.concatenate([np.zeros(0), *parts])

    def _pressure(self, angle: Array) -> Array:
        # p(t) = β ∫_t^1 e^(−β(s − t)) P(s) ds; with s = cos(φ − d) and t = cos φ, s − t = 2 sin(φ − d/2) sin(d/2).
        fraction, weight = _graded_rule()
        phi = angle[:, None]
        d = phi * fraction
        source = phi - d
        fade = np.exp(-2.0 * self.beta * np.sin(phi - 0.5 * d) * np.sin(0.5 * d))
        load = self.half_width * np.sin(source) ** 2 + self.even + self.odd * np.cos(source)
        return np.asarray(np.maximum(0.0, self.beta * angle * ((fade * load) @ weight)))

    def max_pressure(self) -> float:
        """Return the largest p/p0, between samples that crowd at both edges."""
        from scipy.optimize import minimize_scalar

        steps = np.geomspace(1e-9, 0.5, 200)
        angle = np.pi * np.concatenate([steps, 1.0 - steps[-2::-1]])
        sampled = self.pressure(angle)
        top = min(max(int(np.argmax(sampled)), 1), len(angle) - 2)
        best = minimize_scalar(
            lambda log_angle: -float(self.pressure(np.array([math.exp(log_angle)]))[0]),
            bounds=(math.log(angle[top - 1]), math.log(angle[top + 1])),
            method="bounded",
            options={"xatol": 1e-9},
        )
        return max(float(sampled[top]), -float(best.fun))


@lru_cache(maxsize=1)
def _graded_rule() -> tuple[Array, Array]:
    """Points and weights on [0, 1], on panels that halve towards 0."""
    return gauss(_GAUSS_POINTS, np.append(0.0, 0.5 ** np.arange(_PANELS, -1.0, -1.0)))


@lru_cache(maxsize=64)
def _edges(ratio: float, memory: float) -> _Contact:
    """Solve for the half-width, and from it for everything else."""
    from scipy.optimize import brentq

    k, length = ratio, memory
    relaxing = 1.0 - 1.0 / k

    def parts(c: float) -> tuple[float, float, float, float]:
        """ρ, r, κ and c² as a function of c."""
        beta, gamma = c * k / length, c / length
        rho, r = _first_kind(beta)
        kappa = float(k0e(gamma) / k1e(gamma))
        return rho, r, kappa, (rho + kappa) / (r + kappa + 2.0 / gamma)

    def mismatch(log_c: float) -> float:
        return 2.0 * log_c - math.log(parts(math.exp(log_c))[3])

    lowest = -0.5 * math.log(k)
    c = math.exp(brentq(mismatch, lowest - 1e-3, 1e-3, xtol=1e-15, rtol=1e-15))
    rho, r, kappa, _ = parts(c)
    shorter = 2.0 * length / c * relaxing  # 2/γ − 2/β
    total = r + kappa + 2.0 * length / c
    one_less_square = shorter / total  # 1 − c²
    middle = length * relaxing * kappa / (rho + kappa)
    # c² − 1/k = (1 − 1/k)(κ + r)/total, without the difference
    friction = middle * one_less_square + length * relaxing * (kappa + r) / total
    return _Contact(
        half_width=c,
        middle=middle,
        friction=friction,
        beta=c * k / length,
        even=one_less_square / (2.0 * c),
        odd=length - middle,
    )


def _first_kind(beta: float) -> tuple[float, float]:
    """I0/I1 and I2/I1 at β > 0."""
    rho = float(i0e(beta) / i1e(beta))
    return rho, rho - 2.0 / beta if beta > 5.0 else float(ive(2, beta) / ive(1, beta))
