"""What an indenter is, and the two that are met most: a ball and a cylinder."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from viscofric.contact.free.geometry import LINE, POINT, Geometry
from viscofric.errors import InputError, brief
from viscofric.units import Quantity, positive

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.contact.free.grids import Extent


SMALL_STRAIN = 0.3  # slope of the indenter within the contact beyond which linear contact is doubtful


class Indenter(ABC):
    """A rigid surface that is pressed into the solid; its axis goes through the lowest point, the origin.

    Attributes
    ----------
    geometry : Geometry
        Whether it makes a point or a line contact.
    noun : str
        What it is called in messages.
    has_walls : bool
        Whether its height jumps to infinity somewhere: a sharp edge, with which it cannot slide over a solid with a
        memory.
    has_tip : bool
        Whether its slope jumps at the lowest point.
    reach : float
        Half the largest width that a contact can have, m.
    """

    geometry: ClassVar[Geometry] = POINT
    noun: ClassVar[str]
    has_walls: ClassVar[bool] = False
    has_tip: ClassVar[bool] = False

    @abstractmethod
    def height(self, x: Array, y: Array) -> Array:
        """Height (m) above the lowest point at (x, y), in m."""

    @abstractmethod
    def slope(self, x: Array, y: Array) -> Array:
        """Slope of the height along x at (x, y)."""

    @abstractmethod
    def slope_across(self, x: Array, y: Array) -> Array:
        """Slope of the height along y at (x, y)."""

    @abstractmethod
    def doubt(self, contact: Extent, indentation: float) -> str | None:
        """Return what is doubtful about small strain, if anything.

        Parameters
        ----------
        contact : Extent
            Along x and y of the indenter, in m.
        indentation : float
            m.

        Returns
        -------
        str or None
            One sentence.
        """

    @property
    def reach(self) -> float:
        """Half the largest width that a contact can have, m."""
        return math.inf

    def check(self, contact: Extent, held: str) -> None:
        """Refuse a contact that is wider than the indenter.

        Parameters
        ----------
        contact : Extent
            Along x and y of the indenter, in m.
        held : str
            By what the indenter is held, such as "under 25 N".

        Raises
        ------
        InputError
        """
        if contact.longest > 2.0 * self.reach:
            raise InputError(
                f"{held} the contact would be {1e3 * contact.longest:.3g} mm wide, wider than the {self.noun} "
                f"({2e3 * self.reach:.3g} mm): the material is too soft for this; press less."
            )


def insist_on_indenter(given: object) -> None:
    """Raise `InputError` where something else is given."""
    if not isinstance(given, Indenter):
        raise InputError(f"indenter = {brief(given)}: must be an indenter, such as Ball(radius='10 mm').")


def insist_on_round_edges(indenter: Indenter) -> None:
    """Raise `InputError` where an indenter that is to slide has a sharp edge."""
    if indenter.has_walls:
        raise InputError(
            f"indenter: a {indenter.noun} has a sharp edge, whose friction in motion is decided by how round it really "
            "is, at any speed; give the rounded face as a HeightMap, or a speed of zero or infinity, at which the "
            "solid is elastic.",
            field="indenter",
        )


def _too_wide(ratio: float, noun: str) -> str | None:
    if ratio <= SMALL_STRAIN:
        return None
    return (
        f"The contact reaches {ratio:.2f} {noun} radii from the axis; above {SMALL_STRAIN} the assumption of "
        f"small strain and of a parabolic {noun} is doubtful."
    )


def too_steep(slope: float) -> str | None:
    """Return a sentence about an indenter's steepest slope within the contact, if it is doubtful."""
    if slope <= SMALL_STRAIN:
        return None
    return (
        f"The indenter's surface rises by {slope:.2f} within the contact; above {SMALL_STRAIN} the assumption of small "
        "strain is doubtful."
    )


@dataclass(frozen=True)
class Ball(Indenter):
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

    def __post_init__(self) -> None:
        object.__setattr__(self, "radius", positive(self.radius, "m", "radius"))

    def height(self, x: Array, y: Array) -> Array:
        """Height (m) above the lowest point at (x, y), in m."""
        return (x**2 + y**2) / (2.0 * self.radius)  # type: ignore[operator]

    def slope(self, x: Array, y: Array) -> Array:
        """Slope of the height along x at (x, y)."""
        return x / self.radius + 0.0 * y  # type: ignore[operator]

    def slope_across(self, x: Array, y: Array) -> Array:
        """Slope of the height along y at (x, y)."""
        return 0.0 * x + y / self.radius  # type: ignore[operator]

    @property
    def reach(self) -> float:
        """Half the largest width that a contact can have, m."""
        return float(self.radius)

    def doubt(self, contact: Extent, indentation: float) -> str | None:
        """Return what is doubtful about small strain, if anything."""
        return _too_wide(max(contact) / self.reach, self.noun)


@dataclass(frozen=True)
class Cylinder(Indenter):
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
    radius: Quantity

    def __post_init__(self) -> None:
        object.__setattr__(self, "radius", positive(self.radius, "m", "radius"))

    def height(self, x: Array, y: Array) -> Array:
        """Height (m) above the lowest point at (x, y), in m."""
        return x**2 / (2.0 * self.radius) + 0.0 * y  # type: ignore[operator]

    def slope(self, x: Array, y: Array) -> Array:
        """Slope of the height along x at (x, y)."""
        return x / self.radius + 0.0 * y  # type: ignore[operator]

    def slope_across(self, x: Array, y: Array) -> Array:
        """Slope of the height along y at (x, y): zero."""
        return 0.0 * x + 0.0 * y

    @property
    def reach(self) -> float:
        """Half the largest width that a contact can have, m."""
        return float(self.radius)

    def doubt(self, contact: Extent, indentation: float) -> str | None:
        """Return what is doubtful about small strain, if anything."""
        return _too_wide(max(contact) / self.reach, self.noun)
