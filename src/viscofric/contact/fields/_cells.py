"""The cells on which a field is given: their sizes, checked."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.arguments import numbers
from viscofric.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from viscofric.arrays import Array


# Coordinates that a file or a unit conversion has rounded are still equally spaced.
_UNEVEN = 1e-6


def spacing(position: ArrayLike, name: str) -> float:
    """Return the distance of cell centres, m.

    Raises
    ------
    InputError
        If they are fewer than two, or not ascending in equal steps.
    """
    centres = numbers(position, name)
    if centres.ndim != 1 or len(centres) < 2:
        raise InputError(f"{name} must be an array of at least two cell centres; its shape is {centres.shape}.")
    step = (centres[-1] - centres[0]) / (len(centres) - 1)
    if not step > 0.0 or np.any(np.abs(np.diff(centres) - step) > _UNEVEN * step):
        raise InputError(f"{name} must ascend in equal steps.")
    return float(step)


def on_cells(values: ArrayLike, shape: tuple[int, ...], name: str) -> Array:
    """Return values that are given for each cell, as floats.

    Raises
    ------
    InputError
        If their shape is another one or some are not finite.
    """
    array = numbers(values, name)
    if array.shape != shape:
        raise InputError(f"{name} must have one value for each cell, {shape}; its shape is {array.shape}.")
    return array


def pressure_on(x: ArrayLike, y: ArrayLike, pressure: ArrayLike) -> Array:
    """Return a pressure that is given for each cell of x and y; errors as in `on_cells`."""
    return on_cells(pressure, (numbers(x, "x").size, numbers(y, "y").size), "pressure")
