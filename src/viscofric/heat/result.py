"""Temperature of a contact that its own friction heats, steady or over time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array
from viscofric.data import read_only
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.showing import Rows, Shown

#: Columns of friction with heating that are numbers of each contact's `ContactHeating`, with unit and long name.
OF_CONTACT = {
    "temperature_rise": ("K", "mean rise of temperature that the rubber responds to"),
    "coulomb_rise": ("K", "rise of temperature due to Coulomb friction"),
    "loss_rise": ("K", "rise of temperature due to the viscoelastic loss"),
    "track_rise": ("K", "rise of temperature by earlier passes"),
    "face_rise": ("K", "mean rise of temperature of the face"),
    "loss_weighted_rise": ("K", "mean rise of temperature where the loss is released"),
    "temperature_rise_error": ("K", "estimated error of the rise of temperature"),
    "skin": ("1", "depth that the heat reaches during the contact over half the length of the contact"),
}
#: Columns of friction with heating; the error of the rise and `skin` of solved contacts only.
COLUMNS = {
    "isothermal_friction": ("1", "viscoelastic friction coefficient without heating"),
    **OF_CONTACT,
    "cold_friction": ("1", "viscoelastic friction coefficient as the speed rises"),
    "cold_rise": ("K", "rise of temperature as the speed rises"),
    "hot_friction": ("1", "viscoelastic friction coefficient as the speed falls"),
    "hot_rise": ("K", "rise of temperature as the speed falls"),
}


@dataclass(frozen=True, eq=False, kw_only=True)
class HeatColumns(Shown):
    """Friction without heating, rises of temperature and both thermal states, an array each; see `COLUMNS`."""

    isothermal_friction: Array
    temperature_rise: Array
    coulomb_rise: Array
    loss_rise: Array
    track_rise: Array
    face_rise: Array
    loss_weighted_rise: Array
    cold_friction: Array
    cold_rise: Array
    hot_friction: Array
    hot_rise: Array

    def _shown(self) -> Rows:
        return (*super()._shown(), ("rise of temperature", self.temperature_rise, "K"))

    def keep_heat(self, shape: tuple[int, ...]) -> None:
        """Make all columns read-only; raise InputError if one is not finite or of another shape."""
        for name in self._columns:
            column = read_only(getattr(self, name), f"{name} of heated friction")
            if column.shape != shape or not np.all(np.isfinite(column)):
                raise InputError(
                    f"{name} of heated friction must hold one number for each friction coefficient.",
                    code="wrong-length",
                )
            object.__setattr__(self, name, column)

    def heat_variables(self, *dimensions: str) -> dict[str, tuple[tuple[str, ...], Array, dict[str, str]]]:
        """Return the columns along dimensions of a data set."""
        return {
            name: (dimensions, getattr(self, name), {"units": unit, "long_name": words})
            for name, (unit, words) in self._columns.items()
        }

    @property
    def _columns(self) -> dict[str, tuple[str, str]]:
        return {name: about for name, about in COLUMNS.items() if name in self.__dataclass_fields__}


@dataclass(frozen=True, eq=False, kw_only=True)
class SolvedHeatColumns(HeatColumns):
    """The same of solved contacts, with the error of the rise."""

    temperature_rise_error: Array
    skin: Array


@dataclass(frozen=True)
class ContactHeating(Shown):
    """Heat and rise of temperature of a contact, and its friction without them.

    Heats are in W, of a line contact in W/m, of a rough surface in W/m² of its nominal area.

    Attributes
    ----------
    temperature_rise : float
        Mean rise that the rubber responds to, of the face or weighted with the loss (`Heating.average`), K; the contact
        was solved so much warmer.
    temperature_rise_error : float
        Its error: that of the rises per heat (see the theory page on heat), and `residual`, K.
    coulomb_rise, loss_rise : float
        Its parts due to the Coulomb heat and to the viscoelastic loss, K.
    track_rise : float
        What earlier passes contribute to it, K.
    face_rise : float
        Mean rise of the face of the contact, the same in both bodies, K.
    loss_weighted_rise : float
        Mean rise of the rubber where the loss is released, K.
    residual : float
        Rise that the solved contact produces minus that at which it was solved, K.  What it changes in the friction
        is part of the solution's `friction_error`.
    coulomb_heat, loss_heat : float
        Heat of Coulomb friction and of the viscoelastic loss.
    loss_beyond : float
        The part of the loss that is released so far behind, beside or ahead of the contact that it does not warm it.
    rubber_heat, counterface_heat : float
        The parts of their sum that both bodies take up.
    skin : float
        Depth to which heat spreads while the contact passes, √(2κa/v) in the rubber, over a: half the length of the
        contact along the motion, or the mean one of the contact spots of a rough surface.
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
    loss_beyond: float
    rubber_heat: float
    counterface_heat: float
    skin: float
    isothermal_friction: float
    temperature_rise_error: float
    other_rise: float | None = None
    other_friction: float | None = None

    def _shown(self) -> Rows:
        return (
            ("rise of temperature", self.temperature_rise, "K", self.temperature_rise_error),
            ("by Coulomb friction", self.coulomb_rise, "K"),
            ("by the loss", self.loss_rise, "K"),
            ("by earlier passes", self.track_rise, "K"),
            ("mean rise of the face", self.face_rise, "K"),
            ("isothermal friction", self.isothermal_friction),
            ("rise of the other state", self.other_rise, "K"),
            ("friction of the other state", self.other_friction),
        )

    def to_dataset(self) -> Dataset:
        """Return all numbers with units and long names; those of the other state only where there is one."""
        heat = "(W/m of a line contact, W/m² of a rough surface)"
        meanings = OF_CONTACT | {
            "residual": ("K", "rise produced minus rise assumed"),
            "coulomb_heat": ("W", f"heat of Coulomb friction {heat}"),
            "loss_heat": ("W", f"heat of the viscoelastic loss {heat}"),
            "loss_beyond": ("W", f"part of the loss released too far away to warm the contact {heat}"),
            "rubber_heat": ("W", f"heat that the rubber takes up {heat}"),
            "counterface_heat": ("W", f"heat that the counterface takes up {heat}"),
            "isothermal_friction": ("1", "friction coefficient without heating"),
            "other_rise": ("K", "rise of temperature in the contact's other state"),
            "other_friction": ("1", "friction coefficient in the contact's other state"),
        }
        values = {name: getattr(self, name) for name in meanings}
        return dataset((), {name: (values[name], *meanings[name]) for name in meanings if values[name] is not None})


@dataclass(frozen=True, eq=False)
class TransientHeating(Shown):
    """Heat and rise of temperature of a contact over time, and its friction without them; each (n,) along its times.

    Heats are since the start, J, of a line contact J/m.

    Attributes
    ----------
    temperature_rise : array
        Mean rise that the rubber responds to by the heat of the solved contact, of the face or weighted with the loss
        (`Heating.average`), K.  The contact was solved so much warmer, but for `residual`; what that changes is part
        of the solution's `errors`.
    loss_rise : array
        Its part by the viscoelastic loss, before the counterface has taken any of it, K.
    face_rise : array
        Mean rise of the face of the contact, the same in both bodies, K.
    loss_weighted_rise : array
        Mean rise of the rubber where the loss is released, K.
    coulomb_heat, loss_heat : array
        Heat of Coulomb friction and of the viscoelastic loss.
    counterface_heat : array
        The part of their sum that the counterface has taken up; the rest is in the rubber.
    isothermal_friction_force : array
        Friction force without heating, N or N/m.
    residual : array
        Rise that the solved contact produces less that at which it was solved, in size, K.
    error : array
        Error of the rise, K: its change with half as many times, the errors of the loss, also by `residual`, and that
        the loss is released where it is only on average: three quarters of the rise by it, or of that weighted with it.
    """

    temperature_rise: Array
    loss_rise: Array
    face_rise: Array
    loss_weighted_rise: Array
    coulomb_heat: Array
    loss_heat: Array
    counterface_heat: Array
    isothermal_friction_force: Array
    residual: Array
    error: Array

    def _shown(self) -> Rows:
        return (
            ("rise of temperature", self.temperature_rise, "K"),
            ("by the loss", self.loss_rise, "K"),
            ("mean rise of the face", self.face_rise, "K"),
            ("error of the rise", self.error, "K"),
        )

    @property
    def rubber_heat(self) -> Array:
        """Heat that the rubber has taken up, J or J/m."""
        return self.coulomb_heat + self.loss_heat - self.counterface_heat

    def columns(self, force: str, energy: str) -> dict[str, tuple[Array, str, str]]:
        """Return all with the units of force and energy, and long names."""
        rises = {
            "temperature_rise": self.temperature_rise, "temperature_rise_error": self.error,
            "loss_rise": self.loss_rise, "face_rise": self.face_rise, "loss_weighted_rise": self.loss_weighted_rise,
        }  # fmt: skip
        return {name: (values, *OF_CONTACT[name]) for name, values in rises.items()} | {
            "coulomb_heat": (self.coulomb_heat, energy, "heat of Coulomb friction"),
            "loss_heat": (self.loss_heat, energy, "heat of the viscoelastic loss"),
            "counterface_heat": (self.counterface_heat, energy, "heat that the counterface has taken up"),
            "rubber_heat": (self.rubber_heat, energy, "heat that the rubber has taken up"),
            "isothermal_friction_force": (self.isothermal_friction_force, force, "friction force without heating"),
        }

    def to_dataset(self) -> Dataset:
        """Return all along ``step``, the number of the time; a solution's data set has them along ``time``."""
        return dataset("step", self.columns("N", "J"))
