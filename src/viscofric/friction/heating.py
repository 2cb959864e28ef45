"""Friction curves of contacts that their own friction heats."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from viscofric.contact.heated import States, ThermalContact
from viscofric.contact.heated_curve import heat_columns, solve_states
from viscofric.contact.settings import ContactSettings
from viscofric.contact.steady import thermal_contact
from viscofric.datasets import Dataset
from viscofric.files import marked
from viscofric.friction.cases.record import Record, columns_of_contacts, indenter_record
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.planning.shared import SharedContacts
from viscofric.heat.heating import Heating
from viscofric.heat.result import SolvedHeatColumns
from viscofric.processes import Workers, counted_from
from viscofric.rheology.catalogue import is_synthetic
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.showing import Rows


@dataclass(frozen=True, eq=False)
class HeatedFrictionCurves(SolvedHeatColumns, FrictionCurves):
    """Friction curves of contacts that their own friction heats; `temperature` is that of the body.

    Parameters and attributes of `FrictionCurves`, with the Coulomb friction of the `Heating` or of the interface, and:

    Attributes
    ----------
    isothermal_friction : (n,) array
        Viscoelastic friction coefficient without heating.
    temperature_rise, coulomb_rise, loss_rise, track_rise : (n,) array
        Rise of temperature that the rubber responds to, its parts due to Coulomb friction and to the loss, and the part
        left by earlier passes, K.
    temperature_rise_error : (n,) array
        Estimated error of the first of these; see `ContactHeating`.
    face_rise, loss_weighted_rise : (n,) array
        Both mean rises, over the face and where the loss is released, K; see `Heating`.
    skin : array
        Depth to which heat spreads while the contact passes; see `ContactHeating`.
    cold_friction, cold_rise, hot_friction, hot_rise : (n,) array
        Friction and rise of the coldest and of the hottest stable state, equal where there is one only.  A speed that
        rises slowly follows the cold states, one that falls slowly the hot ones: the difference is the hysteresis.

    Raises
    ------
    InputError
        If a column does not fit, or for the reasons of `FrictionCurves`.
    """

    def __post_init__(self) -> None:
        super().__post_init__()
        self.keep_heat(self.speed.shape)

    def _shown(self) -> Rows:
        return [row for row in super()._shown() if row[0] not in ("source", "replicates", "error by the material")]

    def points_dataset(self) -> Dataset:
        """Return the curves as `FrictionCurves` do, with the columns of the heat."""
        return super().points_dataset().assign(self.heat_variables("point"))


def predict_heated(
    parts: list[list[dict[str, Any]]],
    heating: Heating,
    workers: Workers,
    report: Callable[[int], None],
    interface: InterfaceLaw | None = None,
    *,
    exact: bool = False,
) -> HeatedFrictionCurves:
    """Return the friction of contacts, arguments of `solve_steady` each, those of each load in a part of their own."""
    # The heat of an `interface` takes the place of a constant Coulomb friction. Contacts are interpolated between
    # others where that is enough, unless `exact`.
    first, states = parts[0][0], list[States]()
    for contacts in parts:
        every = [_thermal(heating=heating, interface=interface, **one) for one in contacts]
        kelvins = sorted({one.kelvin for one in every})
        curves = [[one for one in every if one.kelvin == kelvin] for kelvin in kelvins]
        # Progress is that of the states.
        shared = None if exact else SharedContacts.of(first["material"], contacts, workers, lambda done: None)
        found = solve_states(curves, first["accuracy"], workers, counted_from(2 * len(states), report), shared)
        of_contact = dict(zip([id(one) for curve in curves for one in curve], found, strict=True))
        states += [of_contact[id(one)] for one in every]
    columns: dict[str, Any] = heat_columns(states)
    if interface is None and heating.coulomb > 0.0:
        slip = [heating.sliding(one.contact.speed) for one in states]
        columns |= {"coulomb": np.full(len(states), heating.coulomb), "slip": np.array(slip)}
    unit, material = first["indenter"].geometry.load_unit, first["material"]
    records = [_record(one) for one in states]
    friction = columns_of_contacts(material, records, unit, columns["temperature_rise"])
    source = marked("predicted", synthetic=is_synthetic(material))
    return HeatedFrictionCurves(**friction, source=source, **columns)


def _record(one: States) -> Record:
    """Return the numbers of a contact at the temperature of the body, with the notes on its heat."""
    found, kelvin = one.wanted.solution, one.contact.kelvin
    record = found if isinstance(found, Record) else indenter_record(found, kelvin)
    error = record.numbers["friction_error"] + one.wanted.friction_left
    numbers = {**record.numbers, "temperature": kelvin, "friction_error": error}
    return replace(record, numbers=numbers, warnings=(*record.warnings, *one.notes))


def _thermal(
    interface: InterfaceLaw | None, heating: Heating, load: float, accuracy: float, **given: Any
) -> ThermalContact:
    names = ("material", "indenter", "speed", "temperature")
    material, indenter, speed, temperature = (given.pop(name) for name in names)
    settings = ContactSettings(accuracy=accuracy, **given)
    contact = thermal_contact(material, indenter, heating, speed, temperature, settings, load=load, indentation=None)
    return replace(contact, interface=interface)
