"""Cases that are the same contact seen in other units: where each lies on the curve of its family.

Friction at the shift factors α and b is that at the reference temperature, at the speed αv, under the load F/b and an
indenter's modulus E_i/b (Eq. 10).  A paraboloid or a cone on a half-space is the same shape at every size, so that its
load and radius are units only: over a unit of slope, friction depends on αv over a length alone, and so do all other
numbers over their units (see `viscofric.contact.free.scale`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from viscofric.contact.counterface import indenter_compliance
from viscofric.contact.free.scale import Scale
from viscofric.contact.indenters.indenter import Ball, Cylinder
from viscofric.contact.indenters.shapes import Cone, Ellipsoid
from viscofric.errors import InputError

if TYPE_CHECKING:
    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.contact.layers import Layer
    from viscofric.rheology.material import Material
    from viscofric.study.planning.conditions import Rubbers
    from viscofric.study.sweep import Case

#: Slope of the shapes that stand for all of their kind: so low that no contact is wider than the indenter.
LOW_SLOPE = 0.01
_BALL, _CYLINDER, _CONE = Ball(1.0), Cylinder(1.0), Cone(LOW_SLOPE)


@dataclass(frozen=True)
class Family:
    """Contacts of one rubber that differ by αv over their length only.

    Attributes
    ----------
    rubber : (int, int or None)
        Number of the material, and of the member of its posterior.
    indenter : Indenter
        What all have; where any size is alike, one that stands for all.
    load : float or None
        F/b, N or N/m; None where any load is alike.
    layer : Layer or None
    indenter_modulus : float or None
        E_i/b, Pa.
    indenter_poisson_ratio : float
    """

    rubber: tuple[int, int | None]
    indenter: Indenter
    load: float | None
    layer: Layer | None
    indenter_modulus: float | None
    indenter_poisson_ratio: float


@dataclass(frozen=True)
class Place:
    """Where a case lies on the curve of its family.

    Attributes
    ----------
    family : Family
    s : float
        ln of αv over the unit of length, 1/s.
    scale : Scale
        Units of the case, but for pressures, which are b times as large.
    b : float
        Vertical shift.
    log_alpha : float
        ln α.
    """

    family: Family
    s: float
    scale: Scale
    b: float
    log_alpha: float


class Placing:
    """Finds the places of cases; what many of them share is found once.

    Parameters
    ----------
    rubbers : Rubbers
    """

    def __init__(self, rubbers: Rubbers) -> None:
        self._rubbers = rubbers
        self._scales: dict[tuple[Indenter, float, float], Scale] = {}

    def place(self, case: Case) -> Place:
        """Return where a case lies.

        Raises
        ------
        InputError
            If it lies on no curve: its speed is not above zero, or its rubber is not known at its temperature.
        """
        if not 0.0 < case.speed < math.inf:
            raise InputError(f"speed = {case.speed:g} m/s: must be above zero and finite to lie on a friction curve.")
        material = self._rubbers.of(case)
        alpha, b = self._rubbers.shifts(case)
        modulus = None if case.indenter_modulus is None else case.indenter_modulus / b
        alike = None if case.layer is not None else representative(case.indenter)
        family = Family(
            (case.material, case.sample),
            case.indenter if alike is None else alike,
            case.load / b if alike is None else None,
            case.layer,
            modulus,
            case.indenter_poisson_ratio,
        )
        scale = self.scale(case.indenter, stiffness_of(material, family), case.load / b)
        return Place(family, math.log(alpha * case.speed / scale.length), scale, b, math.log(alpha))

    def scale(self, indenter: Indenter, stiffness: float, load: float) -> Scale:
        """Return the units of a contact; see `Scale.for_load`."""
        key = indenter, stiffness, load
        if key not in self._scales:
            self._scales[key] = Scale.for_load(*key)
        return self._scales[key]


def representative(indenter: Indenter) -> Indenter | None:
    """Return one that stands for all of its kind on a half-space, whatever their size; None where sizes differ."""
    match indenter:
        case Ball():
            return _BALL
        case Cylinder():
            return _CYLINDER
        case Ellipsoid(radius_x=along, radius_y=across):
            return Ellipsoid(1.0, float(across) / float(along))
        case Cone():
            return _CONE
    return None


def stiffness_of(material: Material, family: Family) -> float:
    """Modulus of the relaxed contact at the reference temperature, Pa."""
    compliance = indenter_compliance(family.indenter_modulus, family.indenter_poisson_ratio)
    return 1.0 / ((1.0 - material.poisson_ratio**2) / material.modes_at(None).E0 + compliance)
