"""Stresses in a solid, and their closed form below a uniformly loaded rectangle or strip of its surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arrays import Array
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError, brief
from viscofric.units import in_si


@dataclass(frozen=True, eq=False)
class Stress:
    """Stress components, Pa, at a set of points, all of one shape; tension is positive, z points into the solid."""

    xx: Array
    yy: Array
    zz: Array
    yz: Array
    xz: Array
    xy: Array

    @property
    def von_mises(self) -> Array:
        """Von Mises' equivalent stress √(3 J2), Pa."""
        normal = (self.xx - self.yy) ** 2 + (self.yy - self.zz) ** 2 + (self.zz - self.xx) ** 2
        return np.asarray(np.sqrt(0.5 * normal + 3.0 * (self.yz**2 + self.xz**2 + self.xy**2)))

    @property
    def principal(self) -> Array:
        """Principal stresses, ascending, along a new last axis, Pa."""
        rows = ((self.xx, self.xy, self.xz), (self.xy, self.yy, self.yz), (self.xz, self.yz, self.zz))
        matrix = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
        return np.asarray(np.linalg.eigvalsh(matrix))

    @property
    def max_shear(self) -> Array:
        """Largest shear stress, half the difference of the extreme principal stresses, Pa."""
        principal = self.principal
        return np.asarray(0.5 * (principal[..., -1] - principal[..., 0]))

    def to_dataset(self, **coordinates: ArrayLike) -> Dataset:
        """Return the components and von Mises' stress over the coordinates of the points.

        One coordinate (m) for each axis of the components, in their order, such as ``x=contact.x, depth=depths``;
        InputError if their number or a length differs.
        """
        places = {name: in_si(values, "m", name) for name, values in coordinates.items()}
        if tuple(values.shape for values in places.values()) != tuple((count,) for count in self.xx.shape):
            raise InputError(
                f"coordinates: must be one row for each axis of the stress, of {self.xx.shape} points, not "
                f"{brief({name: values.shape for name, values in places.items()})}.",
                code="not-on-points",
            )
        components = {
            name: (getattr(self, name), "Pa", f"stress {name}") for name in ("xx", "yy", "zz", "yz", "xz", "xy")
        }
        return dataset(
            tuple(places),
            {**components, "von_mises": (self.von_mises, "Pa", "von Mises' equivalent stress")},
            coordinates={name: (values, "m", name) for name, values in places.items()},
        )


def rectangle_corners(X: Array, Y: Array, z: float | Array, poisson_ratio: float) -> Array:
    """Antiderivatives (6, …), along x and y, of the stresses xx, yy, zz, yz, xz, xy below a unit point load.

    The stress under a unit pressure on a rectangle is their alternating sum over its four corners, seen from the point:
    F(X2, Y2) − F(X1, Y2) − F(X2, Y1) + F(X1, Y1) with X, Y the point's coordinates relative to a corner; z is above
    zero.

    A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377, doi:10.1098/rsta.1929.0009.  With the potentials
    V = ∫∫ p/ρ and χ = ∫∫ p ln(ρ + z): 2π σ_x = 2ν V_z − z V_xx − (1−2ν) χ_xx, 2π σ_z = V_z − z V_zz,
    2π τ_xy = −z V_xy − (1−2ν) χ_xy, 2π τ_xz = −z V_xz.  For a point load these are K. L. Johnson, Contact Mechanics
    (1985), Eqs. 3.19.
    """
    rho = np.sqrt(X**2 + Y**2 + z**2)
    V_z = -np.arctan2(X * Y, z * rho)
    V_xx = -X * Y / ((X**2 + z**2) * rho)
    V_yy = -X * Y / ((Y**2 + z**2) * rho)
    # The differences of two arctangents, one for each derivative, put into one.
    chi_xx = np.arctan2(X * Y * (rho - z), X**2 * rho + z * Y**2)
    chi_yy = np.arctan2(X * Y * (rho - z), Y**2 * rho + z * X**2)
    shear = 1.0 - 2.0 * poisson_ratio
    parts = (
        2.0 * poisson_ratio * V_z - z * V_xx - shear * chi_xx,
        2.0 * poisson_ratio * V_z - z * V_yy - shear * chi_yy,
        V_z + z * (V_xx + V_yy),
        z**2 * X / ((Y**2 + z**2) * rho),
        z**2 * Y / ((X**2 + z**2) * rho),
        -z / rho - shear * np.log(rho + z),
    )
    return np.stack(np.broadcast_arrays(*parts)) / (2.0 * np.pi)


def strip_ends(X: Array, z: float, poisson_ratio: float) -> Array:
    """Antiderivatives (6, …) along x of the stresses xx, yy, zz, yz, xz, xy below a unit line load, in plane strain.

    X (…) is the point's coordinate relative to an end of the strip, z > 0 the depth; the stress under a unit pressure
    on a strip is F(X2) − F(X1).  K. L. Johnson, Contact Mechanics (1985), Sec. 2.5.
    """
    angle, ratio = np.arctan2(X, z), X * z / (X**2 + z**2)
    zero = np.zeros_like(angle)
    normal_x, normal_z = -(angle - ratio), -(angle + ratio)
    parts = (normal_x, poisson_ratio * (normal_x + normal_z), normal_z, zero, z**2 / (X**2 + z**2), zero)
    return np.stack(parts) / np.pi


# Coordinates that a file or a unit conversion has rounded are still equally spaced.
_UNEVEN = 1e-6


def spacing(position: ArrayLike, name: str) -> float:
    """Return the distance of cell centres, m; InputError unless they are two or more, ascending in equal steps."""
    centres = in_si(position, "m", name)
    if centres.ndim != 1 or len(centres) < 2:
        raise InputError(
            f"{name} must be an array of at least two cell centres; its shape is {centres.shape}.",
            code="too-few-points",
        )
    step = (centres[-1] - centres[0]) / (len(centres) - 1)
    if not step > 0.0 or np.any(np.abs(np.diff(centres) - step) > _UNEVEN * step):
        raise InputError(f"{name} must ascend in equal steps.", code="not-ascending")
    return float(step)


def on_cells(values: ArrayLike, shape: tuple[int, ...], name: str, unit: str = "Pa") -> Array:
    """Return values of each cell as floats; InputError if their shape differs or some are not finite."""
    array = in_si(values, unit, name)
    if array.shape != shape:
        raise InputError(
            f"{name} must have one value for each cell, {shape}; its shape is {array.shape}.", code="wrong-length"
        )
    return array


def pressure_on(x: ArrayLike, y: ArrayLike, pressure: ArrayLike) -> Array:
    """Return a pressure that is given for each cell of x and y; errors as in `on_cells`."""
    return on_cells(pressure, (in_si(x, "m", "x").size, in_si(y, "m", "y").size), "pressure")
