"""Warming of the rubber by friction, and its effect on friction.

Heat on a circle of radius a under Hertz's pressure, q = (3/2) q̄ √(1 − r²/a²), that moves with Péclet number
Pe = V a/(2κ) over a half-space raises its surface temperature at most by [1]_ ::

    ΔT = 2.32 q̄ a / (k √(π (1.234 + Pe)))

which joins the limits of a source at rest, 3π q̄ a/(8 k), and of a fast one, under which heat flows vertically.  This
is the rise of each of two bodies with all of the heat; as their surfaces are equally warm, the heat divides such that
1/ΔT = 1/ΔT₁ + 1/ΔT₂ [1]_.  Under a line contact (half-width a, q = (4/π) q̄ √(1 − x²/a²)) the fast limit is used,
which is an upper limit at any speed while heat flows vertically::

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
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.errors import InputError
from viscofric.friction.identification.forward import FirstOrder
from viscofric.rheology.shifts.shift_law import LN10
from viscofric.units import shown_celsius

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.arrays import Array
    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.friction.curves import FrictionCurves
    from viscofric.rheology.material import Material
    from viscofric.rheology.shifts.laws import ShiftLaw
    from viscofric.thermal import ThermalProperties


# The fast limit's largest ∫ √(1 − s²)/√(x − s) ds from −1 to x, over x.
_FAST_HERTZ = 2.188
# Loads whose logarithms differ by less are equal; parts of the shift that are checked, as a maximum may lie within.
_SAME_LOAD, _STEPS = 0.05, np.linspace(0.0, 1.0, 5)


def flash_temperature(
    heat: float, radius: float, speed: float, body: ThermalProperties, *, line: bool = False
) -> float:
    """Return the largest rise of a surface's temperature, K, if all of the heat goes into this body.

    `heat` is that of the whole contact, W, or W/m of a line contact; `radius` the contact radius or half-width, m;
    `speed` (m/s, not below zero) that of the contact over the body.  A line contact at rest has no steady temperature:
    infinite.  Raises InputError if a value is out of range.
    """
    if not (heat >= 0.0 and radius > 0.0 and speed >= 0.0):
        raise InputError(
            f"heat = {heat:g} W, radius = {radius:g} m, speed = {speed:g} m/s: heat and speed must not be below zero, "
            "and the radius must be above it.",
            code="out-of-range",
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
    """Return the rise of both surfaces, K, from the rise of each with all of the heat."""
    if first == 0.0 or second == 0.0:
        return 0.0
    return 1.0 / (1.0 / first + 1.0 / second)


def bulk_temperature(force: float, radius: float, body: ThermalProperties, *, line: bool = False) -> float:
    """Return the rise of temperature behind the contact, K, by the loss in the bulk.

    `force` is the viscoelastic friction force, work per length of track, N, or N/m of a line contact; `radius` the
    contact radius or half-width, m.
    """
    section = radius if line else 0.5 * math.pi * radius**2
    return force / (body.volume_heat * section)


class Warming(NamedTuple):
    """Warming and its effect at every point of friction curves, (n,) each."""

    surface: Array  # rise of temperature by the Coulomb heat, K
    bulk: Array  # rise of temperature by the viscoelastic loss, K
    decades: Array  # shift of log10 of the speed by both
    change: Array  # largest relative change of friction on the way, either way

    @classmethod
    def of(
        cls,
        material: Material,
        indenter: Indenter,
        curves: FrictionCurves,
        radii: Sequence[float],
        rubber: ThermalProperties,
        counterbody: ThermalProperties,
    ) -> Warming:
        """Return it for contacts of given radii, m, on a material with a shift; see `check_assumptions`.

        Raises InputError if α is not known near a temperature.
        """
        assert material.shift is not None
        surface, bulk = np.array([_rise(curves, row, one, rubber, counterbody) for row, one in enumerate(radii)]).T
        temperatures, place = np.unique(curves.temperature, return_inverse=True)
        per_kelvin = np.array([_decades_per_kelvin(material.shift, float(one)) for one in temperatures])
        decades = (surface + bulk) * per_kelvin[place]
        return cls(surface, bulk, decades, _change(material, indenter, curves, decades))


def _rise(
    curves: FrictionCurves, row: int, radius: float, rubber: ThermalProperties, counterbody: ThermalProperties
) -> tuple[float, float]:
    """Return the rise of temperature by the Coulomb heat and by the viscoelastic loss, K."""
    speed, load, line = float(curves.speed[row]), float(curves.load[row]), curves.load_unit == "N/m"
    surface = 0.0
    if curves.coulomb is not None and curves.slip is not None:
        slip = float(curves.slip[row])
        heat = abs(float(curves.coulomb[row])) * load * slip
        # The sense of slip with the slower, and so warmer, indenter.
        surface = shared_flash_temperature(
            flash_temperature(heat, radius, speed, rubber, line=line),
            flash_temperature(heat, radius, abs(speed - slip), counterbody, line=line),
        )
    force = abs(float(curves.viscoelastic[row])) * load
    # Slow contacts lose heat meanwhile: the rise is limited to that with all heat on the surface.
    bulk = min(
        bulk_temperature(force, radius, rubber, line=line),
        flash_temperature(force * speed, radius, speed, rubber, line=line),
    )
    return surface, bulk


def _decades_per_kelvin(shift: ShiftLaw, kelvin: float) -> float:
    """Return |d log10 α/dT|, from within the temperatures at which α is known."""
    known = {}
    for one in (kelvin - 0.5, kelvin, kelvin + 0.5):
        try:
            known[one] = float(shift.log10(one))
        except InputError:
            if one == kelvin:
                raise
    first, last = min(known), max(known)
    if first == last:
        raise InputError(
            f"shift is known at {shown_celsius(kelvin)} °C alone; the effect of warming is unknown there.",
            code="shift-of-one-temperature",
        )
    return abs(known[last] - known[first]) / (last - first)


def _change(material: Material, indenter: Indenter, curves: FrictionCurves, decades: Array) -> Array:
    """Return the largest relative change of friction as the speed falls by decades (n,), to first order in the loss.

    At each point separately, from the material: a slope through points would depend on the others.
    """
    change = np.zeros(len(curves))
    same_load = np.round(np.log(curves.load) / _SAME_LOAD)
    for kelvin, load in sorted(set(zip(curves.temperature.tolist(), same_load.tolist(), strict=True))):
        rows = np.flatnonzero((curves.temperature == kelvin) & (same_load == load))
        modes = material.modes_at(kelvin)
        if not np.any(modes.C > 0.0):
            continue
        lossy = modes.C > 0.0
        first = FirstOrder(
            indenter, float(np.exp(_SAME_LOAD * load)), 1.0 - material.poisson_ratio**2, modes.tau[lossy]
        )
        compliances = np.log([1.0 / modes.E_inf, *modes.C[lossy]])
        on_the_way = np.log(curves.speed[rows]) - LN10 * np.multiply.outer(_STEPS, decades[rows])
        friction = first(compliances, on_the_way.ravel()).log_friction.reshape(on_the_way.shape)
        change[rows] = np.expm1(np.abs(friction - friction[0]).max(axis=0))
    return change
