"""Rise of temperature of a solved contact of a rough surface by its own friction.

Heats are per nominal area.  Coulomb heat is released on the contact spots like the pressure, the loss where it is
dissipated below.  Temperatures differ from place to place by both; the mean heat of the surface, of which a periodic
contact knows no steady state, adds the rise of a nominal contact of a given size.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from viscofric.arrays import Array, ComplexArray
from viscofric.contact.fields.dissipation import Dissipation, Modes
from viscofric.contact.fields.periodic_dissipation import periodic_dissipation
from viscofric.contact.heated import ThermalContact, insist_on_heatable, solve_heated
from viscofric.contact.heated_result import Heat
from viscofric.contact.heating import Cells
from viscofric.contact.periodic.solution import PeriodicSolution
from viscofric.errors import InputError
from viscofric.heat.heating import Heating, NominalResistances, ThermalResistances
from viscofric.heat.influence import Diffusion
from viscofric.heat.layers import LayeredHeat, MovingHeat, Waves
from viscofric.notes import Note
from viscofric.units import Quantity

if TYPE_CHECKING:
    from viscofric.rheology.material import Material


#: Relative change of friction by the rise of temperature that may be left: points join and leave the spots.
ACCURACY = 1e-2
#: Power of the contact area with which local rises fall: 1 for more spots of the same size, ½ to ¾ for larger ones.
_WITH_AREA = 0.7
MEAN_LEFT_OUT = Note(
    "mean-heat-left-out",
    "The rise of temperature is that above the mean of the surface, and changes with its period: how much the mean "
    "heat warms the surface depends on the radius of the nominal contact, which was not given.",
)


@dataclass(frozen=True)
class PeriodicThermalContact(ThermalContact):
    """Contact of a rough surface at any rise of temperature."""

    knots_apart: ClassVar[float] = 0.3
    of_nominal_area: ClassVar[bool] = True

    def heat(self, solution: PeriodicSolution, kelvin: float, relative: ThermalResistances | None = None) -> Heat:
        """Return the heats of a contact solved at a temperature, per nominal area."""
        area, size = self.area(solution), 0.5 * _length(solution)
        if relative is None:
            modes = self.modes(kelvin)
            resistances = periodic_resistances(solution, modes, self.material.poisson_ratio, self.heating)
        else:
            rubber, other = self.closed(area, size)
            below = [rubber * part for part in relative[:4]]
            # Where a given slip is that of rolling the counterface rests below the contact: a peak that discs miss.
            slips = self.heating.slip is not None
            counterface = _counterface(solution, self.heating) if slips else other * relative.counterface
            parts: Any = (*below, self.heating.nominal(self.speed).track, counterface)
            resistances = ThermalResistances(*parts)
        return Heat(
            resistances,
            self.heating.coulomb_heat(solution.mean_pressure, self.speed),
            abs(solution.friction_coefficient * solution.mean_pressure * solution.speed),
            area,
            size,
        )

    def closed(self, area: float, size: float) -> tuple[float, float]:
        """Return the rise of the rubber's face and of the counterface's per heat, of discs on a nominal one."""
        nominal, per_spot = self.heating.nominal(self.speed), math.pi * size**2 / area
        rubber, other = self.heating.face_resistances(abs(self.speed), size, line=False)
        return nominal.rubber + per_spot * rubber, nominal.counterface + per_spot * other

    def area(self, solution: PeriodicSolution) -> float:
        """Return the contact area over the nominal one."""
        return solution.contact_area_fraction

    def scaled(self, heat: Heat, larger: Array) -> ThermalResistances:
        """Return resistances of larger contacts (n,): there are more and larger spots."""
        nominal = self.heating.nominal(self.speed)
        rubber = [nominal.rubber + (one - nominal.rubber) / larger**_WITH_AREA for one in heat.resistances[:4]]
        other = nominal.counterface + (heat.resistances.counterface - nominal.counterface) / larger**_WITH_AREA
        parts: Any = (*rubber, nominal.track, other)
        return ThermalResistances(*parts)


def insist_on_heated_surface(
    heating: object, material: Material, speed: float, temperature: Quantity | None, layer: object, coulomb: float
) -> None:
    """Raise InputError unless a contact of a rough surface can be heated by its friction."""
    known = insist_on_heatable(heating, material, speed, temperature, layer, coulomb)
    if known.passes > 0 and known.nominal_radius is None:
        raise InputError("passes: of a rough surface, need the nominal_radius.", code="give-one")


def solve_heated_surface(contact: PeriodicThermalContact) -> PeriodicSolution:
    """Return the contact of a rough surface in the state of the branch wanted."""
    found: PeriodicSolution = solve_heated(contact, ACCURACY)
    if contact.heating.nominal_radius is None:
        found = replace(found, warnings=(*found.warnings, MEAN_LEFT_OUT))
    return found


def periodic_resistances(
    solution: PeriodicSolution, modes: Modes, poisson_ratio: float, heating: Heating
) -> ThermalResistances:
    """Return rises of a contact per heat of its nominal area, K m²/W.

    `modes` are those at the temperature at which it was solved.  The mean over the face is over the contact spots.
    """
    speed, toward = solution.speed, solution.direction
    velocity = speed * toward[0], speed * toward[1]
    waves, flux, face = _on_face(solution)
    released = periodic_dissipation(solution.pressure, waves, modes, poisson_ratio, velocity).unit
    spots = MovingHeat(heating.rubber, waves, velocity).rises(flux, face, released)
    nominal = heating.nominal(speed)
    mean = _nominal_rises(heating, nominal, abs(speed), released)
    surface, loss, surface_below, loss_below = (one + another for one, another in zip(spots, mean, strict=True))
    return ThermalResistances(surface, loss, surface_below, loss_below, nominal.track, _counterface(solution, heating))


@lru_cache(maxsize=1)
def _waves(shape: tuple[int, int], period: tuple[float, float]) -> Waves:
    """Return the waves of a grid, which all contacts of a curve share."""
    return Waves(shape, period)


def _on_face(solution: PeriodicSolution) -> tuple[Waves, ComplexArray, ComplexArray]:
    """Return waves of the heat on the face and of the weights of its mean, both of mean 1."""
    shape = solution.pressure.shape[0], solution.pressure.shape[1]
    waves = _waves(shape, (shape[0] * _step(solution.x), shape[1] * _step(solution.y)))
    flux, loaded = waves.of(solution.pressure / solution.pressure.mean()), solution.pressure > 0.0
    # Where all is in contact its mean is that of the surface: the mean of what the heat meets takes its place.
    return waves, flux, flux if loaded.all() else waves.of(loaded / loaded.mean())


def _counterface(solution: PeriodicSolution, heating: Heating) -> float:
    """Return the rise of the counterface's face per heat of the nominal area, K m²/W."""
    waves, flux, face = _on_face(solution)
    speed, toward = solution.speed, solution.direction
    over = heating.over_counterface(speed)
    spots = MovingHeat(heating.counterface, waves, (over * toward[0], over * toward[1])).surface_rise(flux, face)
    return heating.nominal(speed).counterface + spots


def _nominal_rises(
    heating: Heating, nominal: NominalResistances, speed: float, released: LayeredHeat
) -> tuple[float, ...]:
    """Return mean rises of the nominal contact per heat on its face and in layers: of the face, then of the layers.

    Of a disc on cells, relative to the rise of the face by heat on it, which is known exactly.
    """
    if heating.nominal_radius is None:
        return 0.0, 0.0, 0.0, 0.0
    cells = Cells.of_disc(float(heating.nominal_radius))
    edges = np.concatenate([[0.0], np.cumsum(released.thickness)])
    below = Dissipation(0.5 * (edges[1:] + edges[:-1]), released.thickness, released.mean)
    rises = cells.rises_below(Diffusion(heating.rubber, speed), below)
    return tuple(nominal.rubber * one / rises[0] for one in rises)


def _step(places: Array) -> float:
    return float(places[1] - places[0]) if len(places) > 1 else 1.0


def _length(solution: PeriodicSolution) -> float:
    """Return the mean length of the contact spots along the motion's nearer axis, m; of all in contact, the period."""
    axis = 0 if abs(solution.direction[0]) >= abs(solution.direction[1]) else 1
    loaded = solution.pressure > 0.0
    step = _step((solution.x, solution.y)[axis])
    ends = int(np.count_nonzero(loaded != np.roll(loaded, 1, axis)))
    return step * (2.0 * np.count_nonzero(loaded) / ends if ends else loaded.shape[axis])
