"""The highest stress below a contact."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arrays import Array
from viscofric.contact.fields.stress import pressure_on, spacing
from viscofric.contact.fields.subsurface import line_stress, stress_layer
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.units import in_si

# Depths at which the highest stress is first looked for, in radii of a circle of the contact's area.
_DEPTHS = np.geomspace(0.02, 2.5, 22)


@dataclass(frozen=True)
class HighestStress:
    """The highest von Mises stress and its position.

    Attributes
    ----------
    von_mises : float
        Pa.
    x, y, depth : float
        Cell centre and depth at which it is found, m.
    """

    von_mises: float
    x: float
    y: float
    depth: float

    def to_dataset(self) -> Dataset:
        """Return the stress and its place as single numbers."""
        return dataset(
            (),
            {
                "von_mises": (self.von_mises, "Pa", "highest von Mises stress"),
                "x": (self.x, "m", "position along the motion"),
                "y": (self.y, "m", "position across the motion"),
                "depth": (self.depth, "m", "depth below the surface"),
            },
        )


def highest_von_mises(x: ArrayLike, y: ArrayLike, pressure: ArrayLike, poisson_ratio: float) -> HighestStress:
    """Find the highest von Mises stress below the cells of a contact.

    Parameters
    ----------
    x, y : (nx,) and (ny,) array
        Centres of rectangular cells, each in equal steps, m; one y means a line contact in plane strain.
    pressure : (nx, ny) array
        Pa, positive somewhere.
    poisson_ratio : float

    Returns
    -------
    HighestStress

    Raises
    ------
    InputError
        If the arrays do not fit each other, or there is no pressure.

    Notes
    -----
    Looked for below cell centres, at depths from 0.02 to 2.5 radii of a circle of the contact's area (half-widths of a
    line contact), but not less than one cell, where the steps from cell to cell would be felt.  The depth is then
    refined.  Error where the pressure is resolved: about (cell/depth)², from the position sideways.

    The stress is that of the pressure alone.  With Coulomb friction μ_c the shear on the face makes √3 μ_c times the
    largest pressure there at least; below an incompressible line contact, up to 15 % are added for μ_c up to 0.3, and
    the face is the place of the highest stress from 0.37 on (K. L. Johnson, Contact Mechanics, 1985, Sec. 7.1).

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    >>> contact = vf.solve_steady(rubber, vf.Ball("10 mm"), speed="10 mm/s", load="1 N", accuracy=1e-2)
    >>> highest = vf.contact.highest_von_mises(contact.x, contact.y, contact.pressure, poisson_ratio=0.5)
    >>> 0.5 < highest.von_mises / contact.max_pressure < 0.7
    True
    """
    from scipy.optimize import minimize_scalar

    x, y = in_si(x, "m", "x"), in_si(y, "m", "y")
    load = pressure_on(x, y, pressure)
    loaded = np.count_nonzero(load > 0.0)
    if loaded == 0:
        raise InputError("pressure must be positive somewhere.", code="no-contact")
    is_line = load.shape[1] == 1
    step_x = spacing(x, "x")
    step_y = step_x if is_line else spacing(y, "y")
    size = 0.5 * loaded * step_x if is_line else np.sqrt(loaded * step_x * step_y / np.pi)
    depths = np.unique(np.maximum(size * _DEPTHS, max(step_x, step_y)))

    def on_layer(depth: float) -> Array:
        if is_line:
            return line_stress(x, load, depth, poisson_ratio).von_mises
        return stress_layer(x, y, load, depth, poisson_ratio).von_mises

    top = int(np.argmax([on_layer(depth).max() for depth in depths]))
    bounds = depths[max(top - 1, 0)], depths[min(top + 1, len(depths) - 1)]
    best = minimize_scalar(
        lambda depth: -float(on_layer(depth).max()),
        bounds=bounds,
        method="bounded",
        options={"xatol": 1e-4 * bounds[1]},
    )
    layer = on_layer(float(best.x))
    i, j = np.unravel_index(int(np.argmax(layer)), layer.shape)
    return HighestStress(float(layer[i, j]), float(np.asarray(x)[i]), float(np.asarray(y)[j]), float(best.x))
