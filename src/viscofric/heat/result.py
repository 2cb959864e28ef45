"""Temperature of a contact that its own friction heats, steady or over time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from viscofric.datasets import dataset

if TYPE_CHECKING:
    import xarray

    from viscofric.arrays import Array


@dataclass(frozen=True)
class ContactHeating:
    """Heat and rise of temperature of a contact, and its friction without them.

    Heats are in W, of a line contact in W/m.

    Attributes
    ----------
    temperature_rise : float
        Mean rise that the rubber responds to, of the face or weighted with the loss (`Heating.average`), K; the contact
        was solved so much warmer.
    coulomb_rise, loss_rise : float
        Its parts due to the Coulomb heat and to the viscoelastic loss, K.
    track_rise : float
        What earlier passes contribute to it, K.
    face_rise : float
        Mean rise of the face of the contact, the same in both bodies, K.
    loss_weighted_rise : float
        Mean rise of the rubber where the loss is released, K.
    residual : float
        Rise that the solved contact produces minus that at which it was solved, K.
    coulomb_heat, loss_heat : float
        Heat of Coulomb friction and of the viscoelastic loss.
    rubber_heat, counterface_heat : float
        The parts of their sum that both bodies take up.
    skin : float
        Depth to which heat spreads while the contact passes, √(2κa/v) in the rubber, over the contact radius.
    isothermal_friction : float
        Friction coefficient at the temperature given, without heating.
    other_rise, other_friction : float or None
        The contact's other stable state, where it has a cold and a hot one.
    """

    temperature_rise: float
    coulomb_rise: float
    loss_rise: float
    track_rise: float
    face_rise: float
    loss_weighted_rise: float
    residual: float
    coulomb_heat: float
    loss_heat: float
    rubber_heat: float
    counterface_heat: float
    skin: float
    isothermal_friction: float
    other_rise: float | None = None
    other_friction: float | None = None

    def to_dataset(self) -> xarray.Dataset:
        """Return all numbers with units and long names; those of the other state only where there is one."""
        meanings = {
            "temperature_rise": ("K", "mean rise of temperature that the rubber responds to"),
            "coulomb_rise": ("K", "rise of temperature due to Coulomb friction"),
            "loss_rise": ("K", "rise of temperature due to the viscoelastic loss"),
            "track_rise": ("K", "rise of temperature by earlier passes"),
            "face_rise": ("K", "mean rise of temperature of the face"),
            "loss_weighted_rise": ("K", "mean rise of temperature where the loss is released"),
            "residual": ("K", "rise produced minus rise assumed"),
            "coulomb_heat": ("W", "heat of Coulomb friction (of a line contact per m)"),
            "loss_heat": ("W", "heat of the viscoelastic loss (of a line contact per m)"),
            "rubber_heat": ("W", "heat that the rubber takes up (of a line contact per m)"),
            "counterface_heat": ("W", "heat that the counterface takes up (of a line contact per m)"),
            "skin": ("1", "depth that the heat reaches during the contact over the contact radius"),
            "isothermal_friction": ("1", "friction coefficient without heating"),
            "other_rise": ("K", "rise of temperature in the contact's other state"),
            "other_friction": ("1", "friction coefficient in the contact's other state"),
        }
        values = {name: getattr(self, name) for name in meanings}
        return dataset((), {name: (values[name], *meanings[name]) for name in meanings if values[name] is not None})


@dataclass(frozen=True, eq=False)
class TransientHeating:
    """Heat and rise of temperature of a contact over time, and its friction without them; each (n,) along its times.

    Heats are since the start, J, of a line contact J/m.

    Attributes
    ----------
    temperature_rise : array
        Mean rise of the face, the same in both bodies, K; the contact was solved so much warmer.
    loss_rise : array
        Its part by the viscoelastic loss, before the counterface has taken any of it, K.
    coulomb_heat, loss_heat : array
        Heat of Coulomb friction and of the viscoelastic loss.
    counterface_heat : array
        The part of their sum that the counterface has taken up; the rest is in the rubber.
    isothermal_friction_force : array
        Friction force without heating, N or N/m.
    residual, error : array
        Rise that the solved contact produces less that at which it was solved, in size, and its change with half as
        many times, K.  Neither includes that the loss is released where it is only on average.
    """

    temperature_rise: Array
    loss_rise: Array
    coulomb_heat: Array
    loss_heat: Array
    counterface_heat: Array
    isothermal_friction_force: Array
    residual: Array
    error: Array

    @property
    def rubber_heat(self) -> Array:
        """Heat that the rubber has taken up, J or J/m."""
        return self.coulomb_heat + self.loss_heat - self.counterface_heat

    def columns(self, force: str, energy: str) -> dict[str, tuple[Array, str, str]]:
        """Return all with the units of force and energy, and long names."""
        return {
            "temperature_rise": (self.temperature_rise, "K", "mean rise of temperature of the face"),
            "temperature_rise_error": (self.error + self.residual, "K", "estimated error of the rise of temperature"),
            "loss_rise": (self.loss_rise, "K", "rise of temperature due to the viscoelastic loss"),
            "coulomb_heat": (self.coulomb_heat, energy, "heat of Coulomb friction"),
            "loss_heat": (self.loss_heat, energy, "heat of the viscoelastic loss"),
            "counterface_heat": (self.counterface_heat, energy, "heat that the counterface has taken up"),
            "rubber_heat": (self.rubber_heat, energy, "heat that the rubber has taken up"),
            "isothermal_friction_force": (self.isothermal_friction_force, force, "friction force without heating"),
        }

    def to_dataset(self) -> xarray.Dataset:
        """Return all along ``step``, the number of the time; a solution's data set has them along ``time``."""
        return dataset("step", self.columns("N", "J"))
