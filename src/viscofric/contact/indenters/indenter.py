"""The interface of all indenters, and its checks."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import ClassVar

from viscofric.arrays import Array
from viscofric.contact.free.geometry import POINT, Geometry
from viscofric.contact.free.grids import Extent
from viscofric.errors import InputError, wrong_argument
from viscofric.notes import Note, Remedy
from viscofric.showing import Shown

#: Work of adhesion of clean rubber on hard, smooth bodies where it is not known, J/m²; dry rubber on itself has 0.07
#: (K. L. Johnson, K. Kendall, A. D. Roberts, Proc. R. Soc. A 324 (1971) 301).
TYPICAL_ADHESION = 0.05
LITTLE_ADHESION = 0.1  # pull-off force over the load up to which adhesion has no note
SMALL_STRAIN = 0.3  # slope of the indenter within the contact beyond which linear contact is doubtful


class Indenter(Shown, ABC):
    """A rigid surface that is pressed into the solid; its axis goes through the lowest point, the origin.

    Attributes
    ----------
    geometry : Geometry
        Whether it makes a point or a line contact.
    noun : str
        Name in messages.
    has_walls : bool
        Whether its height jumps to infinity somewhere: a sharp edge, with which it cannot slide over a solid with a
        memory.
    has_tip : bool
        Whether its slope jumps at the lowest point.
    reach : float
        Half the largest width that a contact can have, m.
    load_exponents : (float, float) or None
        Of the load in the size of the contact and in its strain, where contacts of all loads on a half-space are
        similar.
    """

    geometry: ClassVar[Geometry] = POINT
    noun: ClassVar[str]
    has_walls: ClassVar[bool] = False
    has_tip: ClassVar[bool] = False
    load_exponents: ClassVar[tuple[float, float] | None] = None

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
    def strain_warning(self, contact: Extent, indentation: float) -> Note | None:
        """Return a note where the assumption of small strain is doubtful.

        `contact` is along x and y of the indenter, m; `indentation` in m.
        """

    def pull_off(self, work_of_adhesion: float, modulus: float) -> float | None:
        """Return the force (of a line contact, N/m) that pulls it off a solid of an E* at rest; None if not known."""
        return None

    def adhesion_warning(self, load: float, E0: float, poisson_ratio: float) -> Note | None:
        """Return a note where adhesion, which is left out, may matter: load in N (N/m), relaxed modulus in Pa."""
        force = self.pull_off(TYPICAL_ADHESION, E0 / (1.0 - poisson_ratio**2))
        if force is None or not 0.0 < load < force / LITTLE_ADHESION:
            return None
        return Note(
            "adhesion",
            f"Adhesion is left out: with {1e3 * TYPICAL_ADHESION:g} mJ/m², typical of clean rubber on hard, smooth "
            f"bodies, the pull-off force at rest (JKR) is {force / load:.2g} times the load, and contact and friction "
            "are larger.",
            values={
                "pull_off": force,
                "load": float(load),
                "work_of_adhesion": TYPICAL_ADHESION,
                "severity": force / load,
            },
        )

    def resolution_warning(self, contact: Extent) -> Note | None:
        """Return a note where the points that the surface is given by do not resolve it."""
        return None

    def warnings(self, contact: Extent, indentation: float, load: float, E0: float, poisson_ratio: float) -> list[Note]:
        """Return all notes on a contact, as for `strain_warning` and `adhesion_warning`."""
        found = (
            self.strain_warning(contact, indentation),
            self.resolution_warning(contact),
            self.adhesion_warning(load, E0, poisson_ratio),
        )
        return [one for one in found if one is not None]

    def similar(self) -> Indenter | None:
        """Return the indenter of unit size whose contacts on a half-space are similar to its own; None if none is."""
        return None

    @property
    def reach(self) -> float:
        """Half the largest width that a contact can have, m."""
        return math.inf

    def check(self, contact: Extent, held: str, reduce: str = "load") -> None:
        """Refuse a contact that is wider than the indenter.

        Parameters
        ----------
        contact : Extent
            Along x and y of the indenter, in m.
        held : str
            The load or indentation in words, such as "under 25 N".
        reduce : str
            What makes the contact smaller, such as "mass or the speed".

        Raises
        ------
        InputError
        """
        if contact.longest > 2.0 * self.reach:
            raise InputError(
                f"{held} the contact would be about {1e3 * contact.longest:.3g} mm wide, wider than the {self.noun} "
                f"({2e3 * self.reach:.3g} mm); ",
                code="beyond-indenter",
                remedy=Remedy(f"reduce the {reduce}."),
            )


def insist_on_indenter(given: object) -> None:
    """Raise `InputError` where something else is given."""
    if not isinstance(given, Indenter):
        raise wrong_argument("indenter", given, "must be an indenter, such as Ball(radius='10 mm').", "wrong-type")


def insist_on_round_edges(indenter: Indenter) -> None:
    """Raise `InputError` where an indenter that is to slide has a sharp edge."""
    if indenter.has_walls:
        raise InputError(
            f"indenter: a {indenter.noun} has a sharp edge; in motion its friction depends on the actual edge radius, "
            "at any speed; ",
            field="indenter",
            code="sharp-edge",
            remedy=Remedy(
                "give the rounded face as a HeightMap, or a speed of zero or infinity, at which the solid is elastic.",
                "give the rounded face by --height-map, or a speed of zero or infinity, at which the solid is elastic.",
                "give the rounded face as heights, or a speed of zero or infinity, at which the solid is elastic.",
            ),
        )


def too_steep(slope: float, what: str = "indenter's steepest slope within the contact") -> Note | None:
    """Return a note where a slope makes small strain doubtful."""
    if slope <= SMALL_STRAIN:
        return None
    return Note(
        "large-strain",
        f"The {what} is {slope:.2f}; above {SMALL_STRAIN} the assumption of small strain is doubtful.",
        values={"slope": float(slope), "limit": SMALL_STRAIN, "severity": float(slope)},
    )
