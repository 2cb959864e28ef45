"""How much friction warms a contact: the flash temperature of the heat on its surface, and the heat in the bulk.

Heat on a circle of radius a under Hertz's pressure, q = (3/2) q̄ √(1 − r²/a²), that moves with Péclet number
Pe = V a/(2κ) over a half-space raises its surface temperature at most by [1]_ ::

    ΔT = 2.32 q̄ a / (k √(π (1.234 + Pe)))

which joins the limits of a source at rest, 3π q̄ a/(8 k), and of a fast one, under which heat flows straight down.
Of two bodies, each would be so warm with all of the heat; as their surfaces are equally warm, the heat divides such
that 1/ΔT = 1/ΔT₁ + 1/ΔT₂ [1]_.  Under a line contact (half-width a, q = (4/π) q̄ √(1 − x²/a²)) the fast limit is
taken, which no speed exceeds while heat flows straight down::

    ΔT = 2.188 (4/π) q̄ √(a κ/(π V)) / k

Viscoelastic friction μ_v F is work per length of track, lost in the bulk to a depth of about a: spread over the half
circle of radius a below the contact, it warms each length that has passed by μ_v F/(ρc π a²/2), and on a line contact
by μ_v F/(ρc a).

References
----------
.. [1] X. Tian, F. E. Kennedy, J. Tribol. 116 (1994) 167, doi:10.1115/1.2927035
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from viscofric.errors import InputError

if TYPE_CHECKING:
    from viscofric.thermal import ThermalProperties

# The fast limit's largest ∫ √(1 − s²)/√(x − s) ds from −1 to x, over x.
_FAST_HERTZ = 2.188


def flash_temperature(
    heat: float, radius: float, speed: float, body: ThermalProperties, *, line: bool = False
) -> float:
    """Return the largest rise of a surface's temperature, K, if all of the heat goes into this body.

    Parameters
    ----------
    heat : float
        On the whole contact, W; per length of a line contact, W/m.
    radius : float
        Contact radius, or half-width of a line contact, m.
    speed : float
        At which the contact moves over the body, not below zero, m/s.
    body : ThermalProperties
    line : bool
        Whether it is a line contact; one at rest has no steady temperature.

    Returns
    -------
    float
        K; infinite under a line contact at rest.

    Raises
    ------
    InputError
        If a value is out of range.
    """
    if not (heat >= 0.0 and radius > 0.0 and speed >= 0.0):
        raise InputError(
            f"heat = {heat:g} W, radius = {radius:g} m, speed = {speed:g} m/s: heat and speed must not be below zero, "
            "and the radius must be above it."
        )
    conductivity = float(body.conductivity)
    if line:
        mean = heat / (2.0 * radius)
        if speed == 0.0:
            return math.inf if heat > 0.0 else 0.0
        depth = math.sqrt(radius * body.diffusivity / (math.pi * speed))
        return _FAST_HERTZ * (4.0 / math.pi) * mean * depth / conductivity
    mean = heat / (math.pi * radius**2)
    peclet = speed * radius / (2.0 * body.diffusivity)
    return 2.32 * mean * radius / (conductivity * math.sqrt(math.pi * (1.234 + peclet)))


def shared_flash_temperature(first: float, second: float) -> float:
    """Return the rise of both surfaces, K, from what each would have with all of the heat."""
    if first == 0.0 or second == 0.0:
        return 0.0
    return 1.0 / (1.0 / first + 1.0 / second)


def bulk_temperature(force: float, radius: float, body: ThermalProperties, *, line: bool = False) -> float:
    """Return the rise of temperature behind the contact, K, by work that is lost in the bulk.

    Parameters
    ----------
    force : float
        Viscoelastic friction force, work per length of track, N; per length of a line contact, N/m.
    radius : float
        Contact radius or half-width, m.
    body : ThermalProperties
    line : bool
    """
    section = radius if line else 0.5 * math.pi * radius**2
    return force / (body.volume_heat * section)
