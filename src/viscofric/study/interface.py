"""Friction of the dry interface in a study: its law, fitted to the measurement or given, and its part of every case."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from viscofric.contact.bodies import Layer
from viscofric.errors import InputError
from viscofric.friction.interface.prediction import with_interface
from viscofric.friction.interface.shear_stress import shear_stress
from viscofric.notes import Note, note_of
from viscofric.study.cases.record import Record
from viscofric.study.study_rubber import curves_of

if TYPE_CHECKING:
    import xarray

    from viscofric.rheology.interface.law import InterfaceLaw
    from viscofric.study.contacts import Contacts, Solved
    from viscofric.study.measurement import Measurement
    from viscofric.study.run_file.interface import InterfaceTable

#: Speeds at which the law is stored.
_POINTS = 101
_BEYOND = 0.2  # decades that these reach beyond the measured ones


class InterfaceResults(NamedTuple):
    """Groups of the results, columns of the solved cases, and notes."""

    groups: dict[str, xarray.Dataset]
    columns: dict[str, Any]
    notes: list[Note]


def interface_results(contacts: Contacts, requested: Solved, at_points: Solved) -> InterfaceResults:
    """Return the interface's results; a law that cannot be fitted, or is not known at a case, is a note."""
    found, table, layers = InterfaceResults({}, {}, []), contacts.study.interface, contacts.study.layer
    if table is None:
        return found
    thinnest = None if layers is None else Layer(min(layers.thickness), bonded=layers.base == "bonded")
    least = min(one.material.poisson_ratio for one in contacts.rubbers)
    try:
        law = table.given() if table.is_given else _fitted(table, at_points, contacts.measured, found)
        curves = curves_of(requested.records)
        if requested.cases[0].geometry == "line":
            curves = replace(curves, load_unit="N/m")
        curves = with_interface(curves, law, table.slip, poisson_ratio=least, layer=thinnest)
    except InputError as error:
        where = "Friction of the interface was not predicted"
        return found._replace(notes=[*found.notes, error.note.at(where).coded("no-interface")])
    assert curves.coulomb is not None
    found.columns.update(
        interface_friction=curves.coulomb, interface_error=curves.coulomb_error, total_friction=curves.total
    )
    found.notes.extend(map(note_of, curves.notes))
    return found


def _fitted(
    table: InterfaceTable, at_points: Solved, measured: Measurement | None, found: InterfaceResults
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
