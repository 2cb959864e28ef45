"""Heat at an interface whose shear stress depends on the temperature of the faces that the heat warms."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.heat.heating import HeatBalance

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.arrays import Array
    from viscofric.heat.heating import ThermalResistances

#: Rises at which states are looked for, dense at small ones; halvings of the interval of one.
_PLACES = np.linspace(0.0, 1.0, 1601) ** 2
_HALVINGS = 45


def interface_heat(
    resistances: ThermalResistances, loss: Array, heat_at: Callable[[Array], Array], reach: float, *, hot: bool
) -> Array:
    """Return the heats (n,) of interfaces at the temperature to which they and the loss (n,) below warm the faces.

    `heat_at` gives heats at rises of the faces (m, 1) or (n,), known from zero to `reach`, K, where a hotter one is
    held; so is one that the loss, released beside it, leaves colder than the body.  The coldest state, or the hottest
    one.
    """
    by_loss = np.asarray(HeatBalance.of(resistances, 0.0, loss).face_rise)  # type: ignore[arg-type]
    per_heat = np.asarray(HeatBalance.of(resistances, 1.0, np.zeros_like(loss)).face_rise)  # type: ignore[arg-type]

    def excess(rise: Array) -> Array:
        return np.asarray(by_loss + per_heat * heat_at(rise) - rise)

    rise = reach * _PLACES
    warmer = excess(rise[:, None]) > 0.0  # (m, n)
    falls = warmer[:-1] & ~warmer[1:]
    first = np.argmax(falls, axis=0)
    chosen = len(falls) - 1 - np.argmax(falls[::-1], axis=0) if hot else first
    low, high = rise[chosen], rise[chosen + 1]
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        above = excess(middle) > 0.0
        low, high = np.where(above, middle, low), np.where(above, high, middle)
    exists = falls.any(axis=0)
    within = np.where(exists, 0.5 * (low + high), 0.0)
    beyond = warmer[-1] & (hot | ~exists)
    return np.asarray(heat_at(np.where(beyond, reach, within)))
