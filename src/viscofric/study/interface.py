"""Friction of the dry interface in a study: its law, fitted to the measurement or given, and its part of every case."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from viscofric.contact.coupling import SurfaceCoupling, coupling_notes
from viscofric.datasets import Dataset
from viscofric.errors import InputError
from viscofric.friction.cases.record import Record
from viscofric.friction.cases.surfaces import surface_of
from viscofric.friction.coulomb import with_interface
from viscofric.friction.interface_stress import shear_stress
from viscofric.notes import Note, note_of
from viscofric.rheology.interface.friction import interface_friction, interface_notes
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.study.contacts import Contacts, Solved
from viscofric.study.measurement import Measurement
from viscofric.study.run_file.interface import InterfaceTable
from viscofric.study.study_rubber import curves_of

_CUT_OFF = Note(
    "interface-on-roughness",
    "The real contact area of a rough surface, and with it the interface's part of friction, grows with shorter "
    "wavelengths of the surface; the law, found on smooth contacts, is used on that area as it is.",
)
#: Speeds at which the law is stored.
_POINTS = 101
_BEYOND = 0.2  # decades that these reach beyond the measured ones


class StudyInterface(NamedTuple):
    """Law of the interface, None without [interface] or if it cannot be fitted; groups of the results, and notes."""

    law: InterfaceLaw | None
    groups: dict[str, Dataset]
    notes: list[Note]


def study_interface(contacts: Contacts) -> StudyInterface:
    """Return the interface of a study whose contacts are solved: its law, given or fitted; a failed fit is a note."""
    found, table = StudyInterface(None, {}, []), contacts.study.interface
    if table is None:
        return found
    try:
        law = table.given() if table.is_given else _fitted(table, contacts.results()[1], contacts.measured, found)
    except InputError as error:
        return found._replace(notes=[*found.notes, _not_predicted(error)])
    return found._replace(law=law)


def _not_predicted(error: InputError) -> Note:
    return error.note.at("Friction of the interface was not predicted").coded("no-interface")


class InterfaceColumns(NamedTuple):
    """Columns of the solved cases, and notes."""

    columns: dict[str, Any]
    notes: list[Note]


def interface_columns(contacts: Contacts, interface: StudyInterface, requested: Solved) -> InterfaceColumns:
    """Return the interface's part of the cases; a law that is not known at one of them is a note."""
    table, law = contacts.study.interface, interface.law
    if table is None or law is None:
        return InterfaceColumns({}, [])
    if contacts.study.surface is not None:
        return _on_surface(table, law, requested, contacts)
    try:
        unit = "N/m" if requested.cases[0].geometry == "line" else "N"
        curves = with_interface(curves_of(requested.records, unit), law, table.slip)
    except InputError as error:
        return InterfaceColumns({}, [_not_predicted(error)])
    columns = {
        "interface_friction": curves.coulomb,
        "interface_error": curves.coulomb_error,
        "total_friction": curves.total,
    }
    return InterfaceColumns(columns, list(map(note_of, curves.notes)))


def _on_surface(table: InterfaceTable, law: InterfaceLaw, requested: Solved, contacts: Contacts) -> InterfaceColumns:
    """Return the part of the interface on the corrected contact area of rough surfaces, with the error of the law."""
    records = requested.records
    names = ("pressure", "corrected_area_fraction", "speed", "temperature", "friction_coefficient")
    nominal, area, speed, kelvin, hysteresis = (np.array([getattr(one, name) for one in records]) for name in names)
    slip = speed if table.slip is None else np.full(speed.shape, table.slip)
    local = nominal / area
    try:
        friction, error = interface_friction(law, slip, kelvin, local, np.zeros(local.shape))
        notes = list(interface_notes(law, slip, kelvin, local))
    except InputError as failed:
        return InterfaceColumns({}, [_not_predicted(failed)])
    columns = {"interface_friction": friction, "interface_error": error, "total_friction": hysteresis + friction}
    coupled: dict[Any, SurfaceCoupling] = {}
    sheared = []
    for row, case in enumerate(requested.of_records):
        key, ratio = (case.material, case.surface, case.layer), contacts.rubbers[case.material].material.poisson_ratio
        if key not in coupled:
            coupled[key] = SurfaceCoupling.of(surface_of(case.surface), ratio, case.layer)
        coulomb, rest, part, pressure = (float(one[row]) for one in (friction, hysteresis, area, nominal))
        sheared.append(coupled[key].contact(coulomb, rest, part, pressure, case.label))
    return InterfaceColumns(columns, [*notes, *coupling_notes(sheared), _CUT_OFF])


def _fitted(
    table: InterfaceTable, at_points: Solved, measured: Measurement | None, found: StudyInterface
) -> InterfaceLaw:
    """Fit the law to measured friction on the contacts solved at its points, and put both into the results."""
    assert measured is not None  # the run file needs it
    solved = np.array([isinstance(one, Record) for one in at_points.outcomes], dtype=bool)
    stress = shear_stress(
        measured.curves.select(solved),
        curves_of(at_points.records),
        level_error=table.level_error,
        area_error=table.area_error,
    )
    found.notes.extend(map(note_of, stress.notes))
    if table.law == "best":
        compared = stress.compare_laws()
        found.notes.extend(compared.notes)
        law = compared.best
    else:
        law = stress.law(table.law)
    points = stress.to_dataset(law)
    found.groups["/interface"] = points
    decades = np.log10(points["reduced_speed"].values)
    speeds = np.logspace(np.nanmin(decades) - _BEYOND, np.nanmax(decades) + _BEYOND, _POINTS)
    found.groups["/interface_law"] = law.to_dataset(speeds, points.attrs["reference_temperature"])
    return law
