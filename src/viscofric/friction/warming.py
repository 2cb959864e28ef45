"""Warming of the rubber by friction, and its effect on friction, at every point of friction curves.

The heat of Coulomb friction is on the face, shared with the indenter; the viscoelastic loss is released below, where
the stress of Hertz's pressure dissipates it.  Both rises, of the face and of the rubber where the loss is released,
are those of `viscofric.contact.heating`.  They are found at the few points where the heat alone suggests the largest
change of friction.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.fields.dissipation import Modes
from viscofric.contact.heating import thermal_resistances
from viscofric.contact.indenters.indenter import Indenter
from viscofric.errors import InputError
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.identification.forward import FirstOrder
from viscofric.heat.heating import HeatBalance, Heating, ThermalResistances
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import ShiftLaw
from viscofric.rheology.shifts.shift_law import LN10, NOMINAL
from viscofric.thermal import ThermalProperties
from viscofric.units import shown_celsius

# Loads whose logarithms differ by less are equal; parts of the shift that are checked, as a maximum may lie within.
_SAME_LOAD, _STEPS = 0.05, np.linspace(0.0, 1.0, 5)
_MOST = 3  # points whose rises are found
_FARTHEST = 20.0  # decades: such a rise is beyond any law of the shift
_CELLS = 36  # along the pressure of a contact


class Warming(NamedTuple):
    """Warming at the point of friction curves where it matters most, and its effect there."""

    row: int
    face: float  # mean rise of temperature of the face, K
    below: float  # of the rubber where the loss is released, K
    decades: float  # shift of log10 of the speed by the warmer of both
    change: float  # largest relative change of friction on the way, either way, by the warmer
    least: float  # and by the colder

    @classmethod
    def worst(
        cls,
        material: Material,
        indenter: Indenter,
        curves: FrictionCurves,
        radii: Sequence[float],
        rubber: ThermalProperties,
        counterbody: ThermalProperties,
    ) -> Warming:
        """Return the worst of contacts of given radii, m, on a material with a shift; see `check_assumptions`."""
        # Of the few where the heat alone suggests the largest change.
        assert material.shift is not None
        contacts = [_Contact.of(curves, row, radius, rubber, counterbody) for row, radius in enumerate(radii)]
        temperatures, place = np.unique(curves.temperature, return_inverse=True)
        per_kelvin = np.array([_decades_per_kelvin(material.shift, float(one)) for one in temperatures])[place]
        under_load: dict[float, FirstOrder] = {}
        rises = np.array([one.rough_rise() for one in contacts])
        rough = _change(material, indenter, curves, rises * per_kelvin, under_load)
        found: Warming | None = None
        for row in np.argsort(-rough, kind="stable")[:_MOST].tolist():
            spectrum = material.modes_at(float(curves.temperature[row]))
            modes = Modes(np.asarray(spectrum.C), np.asarray(spectrum.tau))
            face, below = contacts[row].rises(modes, material.poisson_ratio)
            decades = np.array([max(face, below), min(face, below)]) * per_kelvin[row]
            twice = curves.select(np.array([row, row]))
            high, low = _change(material, indenter, twice, decades, under_load).tolist()
            if found is None or high > found.change:
                found = cls(row, face, below, float(decades[0]), high, low)
        assert found is not None
        return found


class _Contact(NamedTuple):
    """One contact under Hertz's pressure; see `viscofric.contact.heating.LoadedContact`."""

    speed: float
    load: float
    radius: float
    coulomb_heat: float
    loss_heat: float
    heating: Heating
    is_line: bool
    friction_force: float = 0.0  # so that all of the loss is released near the contact

    @classmethod
    def of(
        cls, curves: FrictionCurves, row: int, radius: float, rubber: ThermalProperties, counterbody: ThermalProperties
    ) -> _Contact:
        speed, load, line = float(curves.speed[row]), float(curves.load[row]), curves.load_unit == "N/m"
        known = curves.coulomb is not None and curves.slip is not None
        slip = float(curves.slip[row]) if curves.slip is not None else None
        coulomb = abs(float(curves.coulomb[row])) if known and curves.coulomb is not None else 0.0
        heating = Heating(rubber=rubber, counterface=counterbody, coulomb=coulomb, slip=slip)
        heat = coulomb * load * heating.sliding(speed)
        return cls(speed, load, radius, heat, abs(float(curves.viscoelastic[row])) * load * speed, heating, line)

    @property
    def x(self) -> Array:
        """Cell centres along the motion, m."""
        return self.radius * (2.0 * (np.arange(_CELLS) + 0.5) / _CELLS - 1.0)

    @property
    def y(self) -> Array:
        """Cell centres across, m."""
        return np.zeros(1) if self.is_line else self.x

    @property
    def contact_area(self) -> float:
        """Area, m², or width of a line contact, m."""
        return 2.0 * self.radius if self.is_line else math.pi * self.radius**2

    @property
    def pressure(self) -> Array:
        """Hertz's pressure (nx, ny), Pa."""
        square = 1.0 - np.add.outer(np.square(self.x), np.square(self.y)) / self.radius**2
        peak = (4.0 / math.pi if self.is_line else 1.5) * self.load / self.contact_area
        return np.asarray(peak * np.sqrt(np.maximum(square, 0.0)))

    def rough_rise(self) -> float:
        """Return a rise of the right order, K, to find the points that matter."""
        # The loss is on the face or, where that is less, spread over the half circle of the contact's radius below it.
        rubber, other = self.heating.face_resistances(self.speed, self.radius, self.is_line)
        resistances = ThermalResistances(rubber, rubber, rubber, rubber, 0.0, other)
        section = self.radius if self.is_line else 0.5 * math.pi * self.radius**2
        spread = self.loss_heat / (self.speed * self.heating.rubber.volume_heat * section)
        face = HeatBalance.of(resistances, self.coulomb_heat, 0.0).face_rise
        return face + min(rubber * self.loss_heat, spread)

    def rises(self, modes: Modes, poisson_ratio: float) -> tuple[float, float]:
        """Return the mean rise of the face, and of the rubber where the loss is released, K."""
        resistances = thermal_resistances(self, modes, poisson_ratio, self.heating)
        balance = HeatBalance.of(resistances, self.coulomb_heat, self.loss_heat)
        return balance.face_rise, balance.loss_weighted_rise


def _decades_per_kelvin(shift: ShiftLaw, kelvin: float) -> float:
    """Return |d log10 α/dT|, from within the temperatures at which α is known."""
    step = 2.0 * NOMINAL  # beyond what is taken for one temperature
    known = [one for one in (kelvin - step, kelvin, kelvin + step) if one == kelvin or shift.valid_at(one)]
    values = [float(shift.log10(one)) for one in known]
    if len(known) == 1:
        raise InputError(
            f"shift is known at {shown_celsius(kelvin)} °C alone; the effect of warming is unknown there.",
            code="shift-of-one-temperature",
        )
    return abs(values[-1] - values[0]) / (known[-1] - known[0])


def _change(
    material: Material,
    indenter: Indenter,
    curves: FrictionCurves,
    decades: Array,
    under_load: dict[float, FirstOrder],
) -> Array:
    """Return the largest relative change of friction of a point as speed falls by decades (n,), to first order."""
    # What takes longest is kept in `under_load`, for further points.
    change = np.zeros(len(curves))
    same_load = np.round(np.log(curves.load) / _SAME_LOAD)
    plane_strain = 1.0 - material.poisson_ratio**2
    for kelvin, load in sorted(set(zip(curves.temperature.tolist(), same_load.tolist(), strict=True))):
        rows = np.flatnonzero((curves.temperature == kelvin) & (same_load == load))
        modes = material.modes_at(kelvin)
        if not np.any(modes.C > 0.0):
            continue
        lossy = modes.C > 0.0
        if load not in under_load:
            under_load[load] = FirstOrder(indenter, float(np.exp(_SAME_LOAD * load)), plane_strain, modes.tau[lossy])
        first = under_load[load].at_times(modes.tau[lossy])
        compliances = np.log([1.0 / modes.E_inf, *modes.C[lossy]])
        on_the_way = np.log(curves.speed[rows]) - LN10 * np.multiply.outer(_STEPS, np.minimum(decades[rows], _FARTHEST))
        friction = first(compliances, on_the_way.ravel()).log_friction.reshape(on_the_way.shape)
        change[rows] = np.expm1(np.abs(friction - friction[0]).max(axis=0))
    return change
