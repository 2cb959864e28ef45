"""What the heat of friction does to friction: how much it warms the rubber, and what that shifts."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.errors import InputError
from viscofric.friction.flash_temperature import (
    bulk_temperature,
    flash_temperature,
    shared_flash_temperature,
)
from viscofric.friction.identification.first_order import FirstOrder
from viscofric.rheology.shifts.shift_law import LN10
from viscofric.units import celsius

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.arrays import Array
    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.friction.curves import FrictionCurves
    from viscofric.rheology.material import Material
    from viscofric.rheology.shifts.laws import ShiftLaw
    from viscofric.thermal import ThermalProperties


# Loads whose logarithms differ by less are one, and parts of the way that are looked at: a maximum may lie on it.
_SAME_LOAD, _STEPS = 0.05, np.linspace(0.0, 1.0, 5)


class Warming(NamedTuple):
    """What warming does at every point of friction curves, (n,) each.

    Attributes
    ----------
    surface, bulk : (n,) array
        Rise of temperature by the Coulomb heat and by the viscoelastic loss, K.
    decades : (n,) array
        Shift of log10 of the speed by both.
    change : (n,) array
        Largest relative change of friction on the way, either way.
    """

    surface: Array
    bulk: Array
    decades: Array
    change: Array

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
        """Find it for contacts of given radii, m, on a material with a shift; see `check_assumptions`.

        Raises
        ------
        InputError
            If α is not known about a temperature.
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
        # Of the two senses of slip the one that leaves the indenter slower, and so warmer.
        surface = shared_flash_temperature(
            flash_temperature(heat, radius, speed, rubber, line=line),
            flash_temperature(heat, radius, abs(speed - slip), counterbody, line=line),
        )
    force = abs(float(curves.viscoelastic[row])) * load
    # Slow contacts lose their heat meanwhile: never warmer than with all of it on the surface.
    bulk = min(
        bulk_temperature(force, radius, rubber, line=line),
        flash_temperature(force * speed, radius, speed, rubber, line=line),
    )
    return surface, bulk


def _decades_per_kelvin(shift: ShiftLaw, kelvin: float) -> float:
    """|d log10 α/dT|, from within the temperatures at which α is known."""
    known = {}
    for one in (kelvin - 0.5, kelvin, kelvin + 0.5):
        try:
            known[one] = float(shift.log10(one))
        except InputError:
            if one == kelvin:
                raise
    first, last = min(known), max(known)
    if first == last:
        raise InputError(f"shift is known at {celsius(kelvin):.1f} °C alone; what warming does there cannot be told.")
    return abs(known[last] - known[first]) / (last - first)


def _change(material: Material, indenter: Indenter, curves: FrictionCurves, decades: Array) -> Array:
    """Largest relative change of friction as the speed falls by decades (n,), to first order in the loss.

    It is that of the rubber at each point by itself: a slope through points would depend on which others there are.
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
