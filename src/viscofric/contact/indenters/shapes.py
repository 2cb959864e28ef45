"""Smooth shapes of indenters: ball, cylinder, ellipsoid, cone, flat punch."""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.free.geometry import LINE, Geometry
from viscofric.contact.free.grids import Extent
from viscofric.contact.indenters.indenter import SMALL_STRAIN, Indenter, too_steep
from viscofric.errors import InputError
from viscofric.notes import Note
from viscofric.showing import Rows
from viscofric.units import Quantity, positive

#: Slope of representative contacts: so low that none is wider than its indenter.
LOW_SLOPE = 0.01


class _Paraboloid(Indenter):
    """A surface x²/2R_x + y²/2R_y of two radii of curvature, of which the one across may be infinite."""

    load_exponents = (1.0 / 3.0, 1.0 / 3.0)

    @property
    @abstractmethod
    def _radii(self) -> tuple[float, float]:
        """Radii of curvature along x and along y, m."""

    def height(self, x: Array, y: Array) -> Array:
        """Height (m) above the lowest point at (x, y), in m."""
        along, across = self._radii
        return x**2 / (2.0 * along) + y**2 / (2.0 * across)

    def slope(self, x: Array, y: Array) -> Array:
        """Slope of the height along x at (x, y)."""
        return x / self._radii[0] + 0.0 * y

    def slope_across(self, x: Array, y: Array) -> Array:
        """Slope of the height along y at (x, y)."""
        return 0.0 * x + y / self._radii[1]


class _Round(_Paraboloid):
    """A paraboloid of one radius."""

    radius: Quantity

    def __post_init__(self) -> None:
        object.__setattr__(self, "radius", positive(self.radius, "m", "radius"))

    def _shown(self) -> Rows:
        return (("radius", self.radius, "m"),)

    @property
    def _radii(self) -> tuple[float, float]:
        return float(self.radius), float(self.radius) if self.geometry.dimension > 1 else math.inf

    @property
    def reach(self) -> float:
        """Half the largest width that a contact can have, m."""
        return float(self.radius)

    def similar(self) -> Indenter:
        """Return the one of unit radius."""
        return type(self)(1.0)  # type: ignore[call-arg]

    def pull_off(self, work_of_adhesion: float, modulus: float) -> float:
        """Return the force (of a line contact, N/m) that pulls it off a solid of an E* at rest."""
        # K. L. Johnson, K. Kendall, A. D. Roberts, Proc. R. Soc. A 324 (1971) 301; of a cylinder M. Barquins,
        # J. Adhesion 26 (1988) 1.
        if self.geometry.dimension > 1:
            return 1.5 * math.pi * work_of_adhesion * float(self.radius)
        return 3.0 * math.cbrt(math.pi * modulus * work_of_adhesion**2 * float(self.radius) / 16.0)

    def strain_warning(self, contact: Extent, indentation: float) -> Note | None:
        """Return a note where the assumption of small strain is doubtful."""
        ratio = max(contact) / self.reach
        if ratio <= SMALL_STRAIN:
            return None
        return Note(
            "large-strain",
            f"The contact extends to {ratio:.2f} {self.noun} radii from the axis; above {SMALL_STRAIN} the assumptions "
            f"of small strain and of a parabolic {self.noun} are doubtful.",
            values={"radii": float(ratio), "limit": SMALL_STRAIN, "severity": float(ratio)},
        )


@dataclass(frozen=True)
class Ball(_Round):
    """A ball, as contact mechanics takes it: the paraboloid r²/2R.

    Parameters
    ----------
    radius : float, str or pint.Quantity
        Radius of curvature R at the lowest point, m.

    Raises
    ------
    InputError
        If the radius is not a length above zero.

    Examples
    --------
    >>> import viscofric as vf
    >>> ball = vf.Ball("9.525 mm")
    >>> float(ball.height(1e-3, 0.0)) == 1e-6 / (2 * 9.525e-3)
    True
    """

    noun: ClassVar[str] = "ball"
    radius: Quantity


@dataclass(frozen=True)
class Cylinder(_Round):
    """A long cylinder with its axis across the motion, as contact mechanics takes it: x²/2R, in plane strain.

    Its load is per unit of length (N/m).

    Parameters
    ----------
    radius : float, str or pint.Quantity
        Radius of curvature R at the lowest point, m.

    Raises
    ------
    InputError
        If the radius is not a length above zero.

    Examples
    --------
    >>> import viscofric as vf
    >>> vf.Cylinder("10 mm").radius
    0.01
    """

    geometry: ClassVar[Geometry] = LINE
    noun: ClassVar[str] = "cylinder"
    load_exponents = (0.5, 0.5)
    radius: Quantity


@dataclass(frozen=True)
class Ellipsoid(_Paraboloid):
    """A surface with two radii of curvature: the paraboloid x²/2R_x + y²/2R_y.

    Parameters
    ----------
    radius_x, radius_y : float, str or pint.Quantity
        Radii of curvature at the lowest point along x and along y, m.

    Raises
    ------
    InputError
        If a radius is not a length above zero.

    Examples
    --------
    >>> import viscofric as vf
    >>> vf.Ellipsoid("10 mm", "20 mm").radius_y
    0.02
    """

    noun: ClassVar[str] = "ellipsoid"
    radius_x: Quantity
    radius_y: Quantity

    def __post_init__(self) -> None:
        for name in ("radius_x", "radius_y"):
            object.__setattr__(self, name, positive(getattr(self, name), "m", name))

    def _shown(self) -> Rows:
        return (
            ("radius along x", self.radius_x, "m"),
            ("radius along y", self.radius_y, "m"),
        )

    @property
    def _radii(self) -> tuple[float, float]:
        return float(self.radius_x), float(self.radius_y)

    @property
    def reach(self) -> float:
        """Half the largest width that a contact can have, m."""
        return max(self._radii)

    def similar(self) -> Ellipsoid:
        """Return the one of unit radius along x, and the same ratio of radii."""
        return Ellipsoid(1.0, float(self.radius_y) / float(self.radius_x))

    def strain_warning(self, contact: Extent, indentation: float) -> Note | None:
        """Return a note where the assumption of small strain is doubtful."""
        along = max(contact.rear, contact.front) / float(self.radius_x)
        return too_steep(max(along, contact.side / float(self.radius_y)))


@dataclass(frozen=True)
class Cone(Indenter):
    """A blunt cone, its axis upright.

    Parameters
    ----------
    angle : float, str or pint.Quantity
        Between the flank and the undeformed surface, rad; below a right angle, and small for linear contact.

    Raises
    ------
    InputError
        If the angle is not between zero and a right angle.

    Examples
    --------
    >>> import viscofric as vf
    >>> f"{vf.Cone('10 deg').height(1e-3, 0.0):.3e}"
    '1.763e-04'
    """

    noun: ClassVar[str] = "cone"
    has_tip: ClassVar[bool] = True
    load_exponents = (0.5, 0.0)
    angle: Quantity

    def __post_init__(self) -> None:
        angle = positive(self.angle, "rad", "angle")
        if angle >= 0.5 * math.pi:
            raise InputError(
                f"angle = {self.angle!r}: must be less than a right angle, such as '10 deg'.",
                code="out-of-range",
                values={"argument": "angle"},
            )
        object.__setattr__(self, "angle", angle)

    def _shown(self) -> Rows:
        return (("angle", f"{math.degrees(float(self.angle)):.4g}°"),)

    def height(self, x: Array, y: Array) -> Array:
        """Height (m) above the tip at (x, y), in m."""
        return self._steepness * np.hypot(x, y)

    def slope(self, x: Array, y: Array) -> Array:
        """Slope of the height along x at (x, y); zero at the tip."""
        radius = np.hypot(x, y)
        return np.asarray(self._steepness * x / np.where(radius > 0.0, radius, 1.0))

    def slope_across(self, x: Array, y: Array) -> Array:
        """Slope of the height along y at (x, y); zero at the tip."""
        return self.slope(y, x)

    def similar(self) -> Cone:
        """Return a flat one: all are similar, since a linear contact is proportional to their slope."""
        return Cone(LOW_SLOPE)

    @property
    def _steepness(self) -> float:
        return math.tan(float(self.angle))

    def strain_warning(self, contact: Extent, indentation: float) -> Note | None:
        """Return a note where the assumption of small strain is doubtful."""
        return too_steep(self._steepness)


@dataclass(frozen=True)
class FlatPunch(Indenter):
    """A flat circular face with a sharp edge, for the elastic limits: a speed of zero or infinity.

    Its pressure is infinite at the edge, so that results converge slowly with the grid.  Its friction in motion is
    refused: a sharp edge contains waves of all lengths, so that the material is glassy there at any speed, and friction
    does not vanish with the speed.  Friction depends on the radius of the real edge: give the rounded face as a
    `HeightMap`.

    Parameters
    ----------
    radius : float, str or pint.Quantity
        Of the face, m.

    Raises
    ------
    InputError
        If the radius is not a length above zero.

    Examples
    --------
    >>> import viscofric as vf
    >>> float(vf.FlatPunch("1 mm").height(2e-3, 0.0))
    inf
    """

    noun: ClassVar[str] = "punch"
    has_walls: ClassVar[bool] = True
    radius: Quantity

    def __post_init__(self) -> None:
        object.__setattr__(self, "radius", positive(self.radius, "m", "radius"))

    def _shown(self) -> Rows:
        return (("radius", self.radius, "m"),)

    def height(self, x: Array, y: Array) -> Array:
        """Zero on the face, infinite beyond."""
        return np.where(np.hypot(x, y) <= self.radius, 0.0, np.inf)

    def slope(self, x: Array, y: Array) -> Array:
        """Zero: the face is flat."""
        return np.zeros(np.broadcast_shapes(np.shape(x), np.shape(y)))

    def slope_across(self, x: Array, y: Array) -> Array:
        """Zero: the face is flat."""
        return self.slope(x, y)

    def strain_warning(self, contact: Extent, indentation: float) -> Note | None:
        """Return a note where the assumption of small strain is doubtful."""
        return too_steep(indentation / float(self.radius), "punch's indentation over its radius")
