"""Rigid indenters: the height of their surface above its lowest point."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from viscofric.units import Quantity, positive

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]


@dataclass(frozen=True)
class Ball:
    """A ball, as contact mechanics takes it: the paraboloid r²/2R.

    Parameters
    ----------
    radius : float, str or pint.Quantity
        Radius of curvature R at the lowest point, m.

    Raises
    ------
    InputError
        If the radius is not a length above zero.
    """

    radius: Quantity

    def __post_init__(self) -> None:
        object.__setattr__(self, "radius", positive(self.radius, "m", "radius"))

    def height(self, x: Array, y: Array) -> Array:
        """Height (m) above the lowest point at (x, y), in m."""
        return (x**2 + y**2) / (2.0 * self.radius)  # type: ignore[operator]

    def slope(self, x: Array, y: Array) -> Array:
        """Slope of the height along x at (x, y)."""
        return x / self.radius + 0.0 * y  # type: ignore[operator]
