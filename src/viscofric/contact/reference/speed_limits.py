"""Friction of balls and cylinders at very low and at very high speed, for any spectrum of retardation times.

Both laws are first order: the pressure is that of the elastic limit, and the memory dissipates energy under it,

    F_t = −∫ p ∂u/∂x dA,    −Im S(qv) = Σ C_k q v τ_k/(1 + (q v τ_k)²).

At low speed each mode is q v τ_k C_k, an elastic displacement that lags by v τ_k; its work is that of the
surface's curvature 1/R in the contact.  At high speed each is C_k/(q v τ_k), which does the work of the elastic contact
itself, ∫ p u dA = (4/5) F δ for a paraboloid.
"""

from __future__ import annotations

import numpy as np

from viscofric.contact.reference.hertz import hertz_ball, hertz_line
from viscofric.errors import InputError
from viscofric.units import Quantities, Quantity, checked_modes, positive, to_si


def low_speed_friction(speed: Quantity, radius: Quantity, E0: Quantity, C: Quantities, tau: Quantities) -> float:
    """Friction coefficient for v → 0, the same for a ball and for a cylinder: μ = (v/R) E0 Σ C_k τ_k.

    v in m/s, of either sign, which is that of μ; R along the motion, m; relaxed modulus, Pa; C_k in 1/Pa and τ_k in s.
    Independent of the load.  Range: v τ_k ≪ a0 for every mode that matters in the sum, a0 being the Hertz radius at E0.
    The error is about v τ/a0, relative (with one retardation time and a cylinder: −v τ/(2a0) for E∞ ≫ E0).  Raises
    InputError if a value is out of range.
    """
    compliance, time = checked_modes(C, "C", "1/Pa", tau)
    rubber = positive(E0, "Pa", "E0")
    return to_si(speed, "m/s", "speed") / positive(radius, "m", "radius") * rubber * float(compliance @ time)


def high_speed_friction(
    speed: Quantity,
    load: Quantity,
    radius: Quantity,
    E_inf: Quantity,
    poisson_ratio: float,
    C: Quantities,
    tau: Quantities,
) -> float:
    """Friction coefficient of a ball for v → ∞: μ = (4/5) (a∞²/R) E∞ Σ C_k/(v τ_k).

    In units of the Hertz contact at E0, this is μR/a0 = (4/5) k^(1/3) Σ c_k/l_k with c_k = C_k E0, l_k = v τ_k/a0.

    v in m/s, of either sign, which is that of μ, not zero; F in N, R in m, glassy modulus in Pa; C_k in 1/Pa and τ_k in
    s.  a∞ is the Hertz radius at E∞.  Range: relaxation lengths v τ_k E0/E∞ ≫ a∞.  Raises InputError if a value is out
    of range.
    """
    hertz = hertz_ball(load, radius, E_inf, poisson_ratio)
    compliance, time = checked_modes(C, "C", "1/Pa", tau)
    rate = float(np.sum(compliance / time)) / _moving(speed)
    return 0.8 * hertz.indentation * positive(E_inf, "Pa", "E_inf") * rate


def high_speed_line_friction(
    speed: Quantity,
    load_per_length: Quantity,
    radius: Quantity,
    E_inf: Quantity,
    poisson_ratio: float,
    C: Quantities,
    tau: Quantities,
) -> float:
    """Friction coefficient of a cylinder for v → ∞, where a logarithm of the memory's length remains.

    μ = (a∞²/2R) E∞ Σ C_k/(v τ_k) · [ln(2 v τ_k/a∞) + 1/4 − 0.5772…]

    v in m/s, of either sign, which is that of μ, not zero; F' in N/m, R in m, glassy modulus in Pa; C_k in 1/Pa and τ_k
    in s.  a∞ is the half-width of the Hertz contact at E∞.  Range: v τ_k E0/E∞ ≫ a∞.  It is the limit of the exact
    solution for one retardation time (`hunter_line`), summed over modes, since they are independent in first order.
    Raises InputError if a value is out of range.
    """
    hertz = hertz_line(load_per_length, radius, E_inf, poisson_ratio)
    compliance, time = checked_modes(C, "C", "1/Pa", tau)
    speed_si = _moving(speed)
    reach = np.log(2.0 * abs(speed_si) * time / hertz.half_width) + 0.25 - np.euler_gamma
    depth = hertz.half_width**2 / (2.0 * positive(radius, "m", "radius"))
    return depth * positive(E_inf, "Pa", "E_inf") * float(np.sum(compliance / time * reach)) / speed_si


def _moving(speed: Quantity) -> float:
    value = to_si(speed, "m/s", "speed")
    if value == 0.0:
        raise InputError("speed = 0: the law of high speed needs a speed.", code="no-speed")
    return value
