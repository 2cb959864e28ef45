"""Heat at an interface whose shear stress depends on the temperature of the faces that the heat warms."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import InputError
from viscofric.heat.heating import HeatBalance, ThermalResistances

#: Rises at which states are looked for, dense at small ones; halvings of the interval of one.
_PLACES = np.linspace(0.0, 1.0, 1601) ** 2
_HALVINGS = 45


#: Temperatures at which laws end are found to this, K; faces that the heat of an interface warms are followed so far.
END, _HOTTEST = 1e-3, 1000.0


def last_known(known: Callable[[float], bool], low: float, high: float) -> float:
    """Return the largest rise up to `high` at which all is known, K, as it is at `low`."""
    if known(high):
        return high
    while high - low > END:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if known(middle) else (low, middle)
    return low


@dataclass(frozen=True)
class SlidingInterface:
    """An interface that slides at a speed, m/s, between bodies at a temperature, K; its law gives Pa at both."""

    law: Callable[[float, Any], Any]
    slip: float
    kelvin: float

    def is_known(self, rise: float) -> bool:
        """Whether the law is known at a rise of the face, K."""
        try:
            self.law(self.slip, self.kelvin + rise)
        except InputError:
            return False
        return True

    @cached_property
    def known(self) -> float:
        """The largest rise of the face at which the law is known, or up to which states are looked for, K."""
        return last_known(self.is_known, 0.0, _HOTTEST)

    def heat(self, area: Any, rise: Array) -> Array:
        """Return the heat of areas whose faces are so much warmer, K."""
        return np.asarray(self.slip * np.asarray(area) * self.law(self.slip, self.kelvin + rise))

    def settled_heat(self, area: Any, resistances: ThermalResistances, loss: Array, *, hot: bool) -> Array:
        """Return the heats (n,) at the temperature to which they and the loss (n,) below warm the faces."""
        # A face hotter than the law is known is held there; so is one that the loss, released beside it, leaves colder
        # than the body. The coldest state, or the hottest one.
        by_loss = np.asarray(HeatBalance.of(resistances, 0.0, loss).face_rise)  # type: ignore[arg-type]
        per_heat = np.asarray(HeatBalance.of(resistances, 1.0, np.zeros_like(loss)).face_rise)  # type: ignore[arg-type]
        return self.heat_of(area, by_loss, per_heat, hot=hot)

    def heat_of(self, area: Any, by_loss: Array, per_heat: Array, *, hot: bool) -> Array:
        """Return the same (n,) from the rises of the faces by the loss and per heat of the interface."""

        def excess(rise: Array) -> Array:
            return np.asarray(by_loss + per_heat * self.heat(area, rise) - rise)

        rise = self.known * _PLACES
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
        return self.heat(area, np.where(beyond, self.known, within))
