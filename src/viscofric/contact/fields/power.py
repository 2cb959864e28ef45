"""Power that flows through the surface of the solid under a moving contact."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.arguments import numbers
from viscofric.contact.fields._cells import on_cells, spacing
from viscofric.units import to_si

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from viscofric.arrays import Array, Mask


def surface_power(x: ArrayLike, pressure: ArrayLike, displacement: ArrayLike, speed: float) -> Array:
    """Power per area that the indenter puts into the solid, p ∂u/∂t = −v p ∂u/∂x.

    At a fixed point of the surface u changes because the contact moves past it: ∂u/∂t = −v ∂u/∂x.  The map is positive
    where the surface is pushed in (the front of the contact) and negative where it springs back and returns
    part of the work; in a steady contact the integral is what the material turns into heat, F_t v.

    Parameters
    ----------
    x : (nx,) array
        Cell centres along the motion, in equal steps, m.
    pressure : (nx, ny) array
        p ≥ 0, Pa.
    displacement : (nx, ny) array
        u, positive into the solid, m; only differences matter.
    speed : float
        v, m/s, positive towards +x.

    Returns
    -------
    (nx, ny) array
        W/m².

    Raises
    ------
    InputError
        If the arrays do not fit each other.

    Notes
    -----
    Slopes are differences over neighbouring cells of the contact; a cell at its edge has a one-sided one, since the
    slope outside is infinite there.  For a paraboloid they are exact elsewhere.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    >>> contact = vf.solve_steady(rubber, vf.Ball("10 mm"), speed="1 m/s", load="1 N", accuracy=1e-2)
    >>> power = vf.surface_power(contact.x, contact.pressure, contact.displacement, speed=1.0)  # W/m²
    >>> cell = (contact.x[1] - contact.x[0]) * (contact.y[1] - contact.y[0])
    >>> bool(abs(power.sum() * cell / (contact.friction_coefficient * 1.0) - 1.0) < 0.02)  # μ F v, 1 N at 1 m/s
    True
    """
    step = spacing(x, "x")
    shape = (numbers(x, "x").size, *numbers(pressure, "pressure").shape[1:])
    load, depth = on_cells(pressure, shape, "pressure"), on_cells(displacement, shape, "displacement")
    return np.asarray(-to_si(speed, "m/s", "speed") * load * _slope_in_contact(depth, load > 0.0) / step)


def _slope_in_contact(depth: Array, loaded: Mask) -> Array:
    """Change from cell to cell along x, over loaded neighbours where there are any."""
    change = np.zeros((depth.shape[0] + 1, *depth.shape[1:]))
    change[1:-1] = np.diff(depth, axis=0)
    joined = np.zeros(change.shape, dtype=bool)
    joined[1:-1] = loaded[1:] & loaded[:-1]
    before, after = joined[:-1], joined[1:]
    neighbours = before.astype(float) + after
    inside = (change[:-1] * before + change[1:] * after) / np.maximum(neighbours, 1.0)
    return np.where(neighbours > 0.0, inside, 0.5 * (change[:-1] + change[1:]))
