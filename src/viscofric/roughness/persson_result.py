"""Results of Persson's theory: friction and contact area over temperatures, speeds and the scales of waves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array
from viscofric.datasets import Dataset, dataset
from viscofric.heat.result import HeatColumns
from viscofric.notes import note_attributes
from viscofric.rheology.interface.friction import total_error, total_friction
from viscofric.showing import Plotted, Rows


@dataclass(frozen=True, eq=False)
class PerssonTheory(Plotted):
    """Results of Persson's theory for a rubber that slides on a rough surface.

    Attributes
    ----------
    temperature : (m,) array
        Of the rubber before it meets the surface, K; NaN where none was given: a material with a shift is then at its
        reference.
    speed : (n,) array
        m/s.
    pressure : float
        Nominal, Pa.
    friction_coefficient : (m, n) array
        For every temperature and speed.
    contact_area_fraction : (m, n) array
        Real contact area over nominal, all waves seen.
    flash_temperature : (m, n) array
        Largest rise of temperature over all scales, K; zero without `thermal` or `heating`.
    wave_number : (k,) array
        q of the scales below, rad/m.
    area_by_scale : (m, n, k) array
        P(q): the contact area as it shows when nothing shorter than 2π/q is seen.
    friction_by_scale : (m, n, k) array
        Friction coefficient of all waves up to q.
    temperature_rise_by_scale : (m, n, k) array
        T_q less `temperature`, K.
    error : float
        Largest estimated error of the integrals: of the area, and of the friction coefficient relative to its largest.
    interface_friction, interface_error : (m, n) array or None
        With an interface, its friction τ_s A/F on the real contact area, and the standard error due to the law.
    notes : tuple of str
        On frequencies that were not measured, the interface, and doubts about Coulomb friction, one sentence each.
    """

    temperature: Array
    speed: Array
    pressure: float
    friction_coefficient: Array
    contact_area_fraction: Array
    flash_temperature: Array
    wave_number: Array
    area_by_scale: Array
    friction_by_scale: Array
    temperature_rise_by_scale: Array
    error: float
    interface_friction: Array | None = None
    interface_error: Array | None = None
    notes: tuple[str, ...] = ()

    def _shown(self) -> Rows:
        return (
            ("temperature", self.temperature, "°C"),
            ("speed", self.speed, "m/s"),
            ("pressure", self.pressure, "Pa"),
            ("friction coefficient", self.friction_coefficient),
            ("interface friction", self.interface_friction),
            ("contact area", self.contact_area_fraction, "%"),
            ("wave numbers", self.wave_number, "rad/m"),
            ("error of the integrals", self.error),
            ("notes", self.notes),
        )

    @property
    def total(self) -> Array:
        """Friction coefficient of hysteresis and interface, (m, n) array; InputError without an interface."""
        return total_friction(self.friction_coefficient, self.interface_friction, "persson_theory")

    @property
    def total_error(self) -> Array | None:
        """Standard error of `total`, (m, n) array, from those of both parts; None without an interface."""
        return total_error(self.friction_error, self.interface_error)

    @property
    def friction_error(self) -> Array:
        """Largest error of the friction coefficient by the integrals, (m, n) array, the same everywhere."""
        return np.full(self.friction_coefficient.shape, self.error * float(np.abs(self.friction_coefficient).max()))

    def to_dataset(self) -> Dataset:
        """Return everything over temperature, speed and wave number, with pressure, error and notes as attributes."""
        meanings = {
            "friction_coefficient": ("1", "friction coefficient"),
            "friction_error": ("1", "largest error of the friction coefficient by the integrals"),
            "contact_area_fraction": ("1", "real over nominal contact area"),
            "flash_temperature": ("K", "largest rise of temperature"),
            "area_by_scale": ("1", "contact area fraction without shorter waves"),
            "friction_by_scale": ("1", "friction coefficient due to all longer waves"),
            "temperature_rise_by_scale": ("K", "rise of temperature that waves of this length meet"),
        }
        if self.interface_friction is not None:
            meanings["interface_friction"] = ("1", "friction coefficient of the interface")
            meanings["interface_error"] = ("1", "standard error of the interface's friction due to its law")
        return dataset(
            ("temperature", "speed", "wave_number"),
            {name: (getattr(self, name), *meaning) for name, meaning in meanings.items()},
            coordinates={
                "temperature": (self.temperature, "K", "temperature of the rubber before it meets the surface"),
                "speed": (self.speed, "m/s", "sliding speed"),
                "wave_number": (self.wave_number, "rad/m", "wave number"),
            },
            attributes={"pressure": self.pressure, "error": self.error} | note_attributes(self.notes),
        )


@dataclass(frozen=True, eq=False)
class HeatedPerssonTheory(HeatColumns, PerssonTheory):
    """Results of Persson's theory with the heat of friction.

    Attributes of `PerssonTheory`, and:

    Attributes
    ----------
    isothermal_friction : (m, n) array
        Friction coefficient without heating.
    temperature_rise, loss_weighted_rise : (m, n) array
        Mean of the rise over all scales, weighted with what each loses, K.
    coulomb_rise, loss_rise : (m, n) array
        Its parts due to Coulomb friction and to the loss, K.
    track_rise : (m, n) array
        Zero.
    face_rise : (m, n) array
        Rise of the surface of the macroasperity contacts, K.
    cold_friction, cold_rise, hot_friction, hot_rise : (m, n) array
        Friction and rise of the states reached from a cold and from a hot start, equal where there is one only.
    """

    def __post_init__(self) -> None:
        self.keep_heat(self.friction_coefficient.shape)

    def to_dataset(self) -> Dataset:
        """Return everything as `PerssonTheory` does, with the columns of the heat."""
        return super().to_dataset().assign(self.heat_variables("temperature", "speed"))
