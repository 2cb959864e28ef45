"""The direction of a motion in the plane of the surface."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from viscofric.arguments import real
from viscofric.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence


def unit_direction(direction: Sequence[float]) -> tuple[float, float]:
    """Return a direction in the plane at length one.

    Parameters
    ----------
    direction : (float, float)
        Of any length but zero.

    Raises
    ------
    InputError
        If it is not two finite numbers, or both are zero.
    """
    try:
        x, y = real(direction).tolist()
        length = math.hypot(x, y)
    except (TypeError, ValueError):
        length = math.nan
    if not (math.isfinite(length) and length > 0.0):
        raise InputError(f"direction = {direction!r}: must be two numbers, not both zero, such as (1.0, 0.0).")
    return x / length, y / length
