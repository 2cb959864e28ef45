"""What the heat of friction does to friction: how much it warms the rubber, and what that shifts."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from viscofric.errors import InputError
from viscofric.friction.flash_temperature import (
    bulk_temperature,
    flash_temperature,
    shared_flash_temperature,
)
from viscofric.units import celsius

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from viscofric.friction.curves import FrictionCurves
    from viscofric.rheology.shifts.laws import ShiftLaw
    from viscofric.thermal import ThermalProperties

    Array: TypeAlias = NDArray[np.float64]


class Warming(NamedTuple):
    """What warming does at every point of friction curves, (n,) each.

    Attributes
    ----------
    surface, bulk : (n,) array
        Rise of temperature by the Coulomb heat and by the viscoelastic loss, K.
    decades : (n,) array
        Shift of log10 of the speed by both.
    change : (n,) array
        Relative change of friction by it.
    """

    surface: Array
    bulk: Array
    decades: Array
    change: Array

    @classmethod
    def of(
        cls,
        curves: FrictionCurves,
        shift: ShiftLaw,
        radii: Sequence[float],
        rubber: ThermalProperties,
        counterbody: ThermalProperties,
    ) -> Warming:
        """Find it for contacts of given radii, m; see `check_assumptions`.

        Raises
        ------
        InputError
            If α is not known about a temperature.
        """
        surface, bulk = np.array([_rise(curves, row, one, rubber, counterbody) for row, one in enumerate(radii)]).T
        temperatures, place = np.unique(curves.temperature, return_inverse=True)
        decades = (surface + bulk) * np.array([_decades_per_kelvin(shift, float(one)) for one in temperatures])[place]
        slopes = np.array([_slope(curves, float(one)) for one in temperatures])[place]
        return cls(surface, bulk, decades, 10.0 ** (decades * slopes) - 1.0)


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


def _slope(curves: FrictionCurves, kelvin: float) -> float:
    """|d ln μ/d ln v| of the curve at a temperature, from a straight line; one where there is none."""
    rows = (curves.temperature == kelvin) & (curves.viscoelastic > 0.0)
    speed, friction = np.log(curves.speed[rows]), np.log(curves.viscoelastic[rows])
    if speed.size < 2 or np.ptp(speed) == 0.0:
        return 1.0
    return abs(float(np.polyfit(speed, friction, 1)[0]))
