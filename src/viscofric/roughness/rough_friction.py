"""Friction and contact area on rough surfaces, with confidence intervals."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import NormalDist
from typing import Literal

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.coupling import SurfaceCoupling, coupling_notes
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError, check_choice
from viscofric.heat.result import SolvedHeatColumns
from viscofric.notes import Note, note_attributes
from viscofric.rheology.interface.friction import total_error, total_friction
from viscofric.showing import Plotted, Rows
from viscofric.units import Quantities, positive, share, shown_speed, to_si_array


@dataclass(frozen=True, eq=False)
class RoughFriction(Plotted):
    """Friction and contact area on several rough surfaces, over temperatures and speeds.

    Attributes
    ----------
    temperature : (m,) array
        K; NaN where none was given: a material with a shift is then at its reference.
    speed : (n,) array
        m/s.
    pressure : float
        Nominal, Pa.
    surfaces : tuple of str
        Names of the k surfaces.
    friction_coefficient : (m, n, k) array
        For every temperature, speed and surface.
    friction_error : (m, n, k) array
        Estimated error that the grid makes in each; see `PeriodicDiagnostics.friction_error`.
    contact_area_fraction : (m, n, k) array
        Points under pressure over all.
    corrected_area_fraction : (m, n, k) array
        The same, corrected for the excess of counted points; see `ContactStatistics`.
    stretch : (m, n, k) array
        How many times longer the contact patches are along the motion than across; see `ContactStatistics`.
    interface_friction, interface_error : (m, n, k) array or None
        With an interface, its friction τ_s A/F on the corrected area, and the standard error due to the law.
    notes : tuple of str
        Warnings of the contacts, and on the interface, one sentence each.
    """

    temperature: Array
    speed: Array
    pressure: float
    surfaces: tuple[str, ...]
    friction_coefficient: Array
    friction_error: Array
    contact_area_fraction: Array
    corrected_area_fraction: Array
    stretch: Array
    interface_friction: Array | None = None
    interface_error: Array | None = None
    notes: tuple[str, ...] = ()

    def _shown(self) -> Rows:
        return (
            ("surfaces", self.surfaces),
            ("temperature", self.temperature, "°C"),
            ("speed", self.speed, "m/s"),
            ("pressure", self.pressure, "Pa"),
            ("friction coefficient", self.friction_coefficient),
            ("its error", self.friction_error),
            ("interface friction", self.interface_friction),
            ("contact area", self.corrected_area_fraction, "%"),
            ("notes", self.notes),
        )

    @property
    def total(self) -> Array:
        """Friction coefficient of hysteresis and interface, (m, n, k) array; InputError without an interface."""
        return total_friction(
            self.friction_coefficient, self.interface_friction, "predict_rough_friction() an interface"
        )

    @property
    def total_error(self) -> Array | None:
        """Standard error of `total`, (m, n, k) array, from those of both parts; None without an interface."""
        return total_error(self.friction_error, self.interface_error)

    @property
    def mean_friction_coefficient(self) -> Array:
        """Mean friction coefficient over the surfaces, (m, n) array."""
        return np.asarray(self.friction_coefficient.mean(axis=-1))

    @property
    def mean_area(self) -> Array:
        """Mean corrected contact area fraction over the surfaces, (m, n) array."""
        return np.asarray(self.corrected_area_fraction.mean(axis=-1))

    def interval(
        self, level: float = 0.95, *, of: Literal["viscoelastic", "total"] = "viscoelastic"
    ) -> tuple[Array, Array]:
        """Return the confidence interval of the mean friction of all such surfaces.

        By Student's t, for friction that scatters normally from surface to surface.  That of the total also has the
        error of the law of the interface, which all surfaces share.  The error of the grid is not included.

        Parameters
        ----------
        level : float
            Probability between the limits, between 0 and 1.
        of : {"viscoelastic", "total"}

        Returns
        -------
        lower, upper : (m, n) array

        Raises
        ------
        InputError
            If there is one surface only, the level is out of range, or there is no interface.
        """
        check_choice(of, "of", "viscoelastic", "total")
        if of == "viscoelastic":
            return interval_of_mean(self.friction_coefficient, level)
        mean, (lower, _) = self.total.mean(axis=-1), interval_of_mean(self.total, level)
        assert self.interface_error is not None
        shared = NormalDist().inv_cdf(0.5 + 0.5 * share(level, "level", example=0.95))
        half = np.hypot(mean - lower, shared * self.interface_error.mean(axis=-1))
        return mean - half, mean + half

    def to_dataset(self) -> Dataset:
        """Return everything over temperature, speed and surface, with the nominal pressure as an attribute."""
        names = {
            "friction_coefficient": "friction coefficient",
            "friction_error": "estimated error of the friction coefficient",
            "contact_area_fraction": "points under pressure over all",
            "corrected_area_fraction": "real over nominal contact area",
            "stretch": "length of contact patches along over across the motion",
            "interface_friction": "friction coefficient of the interface",
            "interface_error": "standard error of the friction coefficient of the interface",
        }
        return dataset(
            ("temperature", "speed", "surface"),
            {
                name: (getattr(self, name), "1", long_name)
                for name, long_name in names.items()
                if getattr(self, name) is not None
            },
            coordinates={
                "temperature": (self.temperature, "K", "temperature"),
                "speed": (self.speed, "m/s", "sliding speed"),
                "surface": (list(self.surfaces), "1", "name of the surface"),
            },
            attributes={"pressure": self.pressure} | note_attributes(self.notes),
        )


@dataclass(frozen=True, eq=False)
class HeatedRoughFriction(SolvedHeatColumns, RoughFriction):
    """Friction on rough surfaces at the temperatures to which it heats the contact spots.

    Attributes of `RoughFriction`, whose `temperature` is that of the body, and:

    Attributes
    ----------
    isothermal_friction : (m, n, k) array
        Viscoelastic friction coefficient without heating.
    temperature_rise, coulomb_rise, loss_rise, track_rise : (m, n, k) array
        Rise of temperature that the rubber responds to, its parts due to Coulomb friction and to the loss, and the part
        left by earlier passes, K.  Above the mean of the surface, unless the size of the nominal contact is given.
    temperature_rise_error : (m, n, k) array
        Estimated error of the first of these; see `ContactHeating`.
    face_rise, loss_weighted_rise : (m, n, k) array
        Both mean rises, over the contact spots and where the loss is released, K; see `Heating`.
    skin : array
        Depth to which heat spreads while the contact passes; see `ContactHeating`.
    cold_friction, cold_rise, hot_friction, hot_rise : (m, n, k) array
        Friction and rise of the coldest and of the hottest stable state, equal where there is one only.
    """

    def __post_init__(self) -> None:
        self.keep_heat(self.friction_coefficient.shape)
        super().__post_init__()

    def to_dataset(self) -> Dataset:
        """Return everything as `RoughFriction` does, with the columns of the heat."""
        return super().to_dataset().assign(self.heat_variables("temperature", "speed", "surface"))


def states(speeds: Quantities, temperatures: Quantities | None) -> tuple[Array, list[float | None]]:
    """Return speeds, m/s, and temperatures, K, at least one of each; None where no temperature was given."""
    velocities = to_si_array(speeds, "m/s", "speeds")
    if not velocities.size:
        raise InputError("speeds must hold at least one value.", code="empty-list")
    kelvins: list[float | None] = [None]
    if temperatures is not None:
        kelvins = [positive(float(one), "K", "temperatures") for one in to_si_array(temperatures, "K", "temperatures")]
        if not kelvins:
            raise InputError("temperatures must hold at least one value.", code="empty-list")
    return velocities, kelvins


def shear_notes(
    coulomb: Array,
    friction: Array,
    area: Array,
    speeds: Array,
    pressure: float,
    surfaces: Sequence[SurfaceCoupling],
    solved: float = 0.0,
) -> tuple[Note, ...]:
    """Return a note where Coulomb friction (m, n, k) changes that of contacts, solved with another one, by too much."""
    # The contacts are those at n speeds on k surfaces, of which `area` (m, n, k) is the part in contact.
    return coupling_notes(
        surfaces[place[2]].contact(
            float(coulomb[place]),
            float(friction[place]),
            float(area[place]),
            pressure,
            f"at {shown_speed(float(speeds[place[1]]), 3)}",
            solved,
        )
        for place in np.ndindex(coulomb.shape)
    )


def interval_of_mean(found: Array, level: float = 0.95) -> tuple[Array, Array]:
    """Return lower and upper limit (...) of the confidence interval of the mean over all surfaces of a kind."""
    # By Student's t, for values `found` (..., k) on k surfaces that scatter normally.
    from scipy.special import stdtrit

    wanted, count = share(level, "level", example=0.95), found.shape[-1]
    if count < 2:
        raise InputError(
            "interval: needs two surfaces at least, since it rests on the scatter from surface to surface.",
            code="one-surface",
        )
    mean = found.mean(axis=-1)
    reach = float(stdtrit(count - 1, 0.5 + 0.5 * wanted)) * found.std(axis=-1, ddof=1) / math.sqrt(count)
    return mean - reach, mean + reach
