"""How large the contacts of friction curves are: as they were solved, or between two of Hertz's."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from viscofric.contact.free.scale import Scale
from viscofric.units import celsius, plain, told_speed

if TYPE_CHECKING:
    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.friction.curves import FrictionCurves
    from viscofric.rheology.material import Material


@dataclass(frozen=True)
class ContactSize:
    """Size of one contact, in m and 1/m.

    Attributes
    ----------
    smallest, largest : float
        Between what radii it lies; the same where it was solved.
    relaxed : float
        Hertz's at the rubber modulus E0, of a round contact: none is larger.
    curvature : float
        Of the paraboloid in the indenter's place.
    where : str
        At what temperature, speed and load, in words.
    """

    smallest: float
    largest: float
    relaxed: float
    curvature: float
    where: str

    @classmethod
    def of(
        cls, material: Material, indenter: Indenter, curves: FrictionCurves, row: int, solved: float | None
    ) -> ContactSize:
        """Tell it for a point of friction curves, given the solved radius, if there is one."""
        spectrum = material.modes_at(float(curves.temperature[row]))
        plane_strain = 1.0 - material.poisson_ratio**2
        scale = Scale.for_load(indenter, spectrum.E0 / plane_strain, float(curves.load[row]))
        curvature, where = scale.slope / scale.length, place_of(curves, row)
        if solved is not None:
            return cls(solved, solved, scale.length, curvature, where)
        # Hertz: a³ ~ F R/E of a ball, a² ~ F R/E of a cylinder.
        power = 1.0 / (1.0 + scale.geometry.dimension)
        radius = scale.length
        for _ in range(50):
            modulus = abs(complex(spectrum.complex_modulus(curves.speed[row] / radius)))
            before, radius = radius, scale.length * (spectrum.E0 / modulus) ** power
            if abs(radius - before) <= 1e-3 * radius:
                break
        return cls(radius, scale.length, scale.length, curvature, where)

    def __str__(self) -> str:
        if self.smallest == self.largest:
            return f"The contact's radius is {1e3 * self.largest:.2g} mm ({self.where})"
        return (
            f"The contact's radius is about {1e3 * self.smallest:.2g} and at most {1e3 * self.largest:.2g} mm "
            f"(Hertz's at |E(v/a)| and at the rubber modulus, {self.where})"
        )


def place_of(curves: FrictionCurves, row: int) -> str:
    """Return temperature, speed and load of a point of friction curves, in words."""
    load = f"{plain(float(curves.load[row]), 3)} {curves.load_unit}"
    return f"at {celsius(float(curves.temperature[row])):.0f} °C, {told_speed(float(curves.speed[row]), 3)} and {load}"
