"""Columns of friction curves from solved contacts, with the warnings of many contacts as few notes."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.contact.solution import ContactSolution
from viscofric.errors import InputError
from viscofric.friction.cases.record import indenter_record
from viscofric.notes import Note, counted, note_of
from viscofric.rheology.spectra.quality import BEYOND
from viscofric.units import shown_number

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.arrays import Array
    from viscofric.friction.cases.record import Record
    from viscofric.rheology.material import Material
    from viscofric.rheology.spectra.quality import SpectrumFit


def columns_of(solutions: Iterable[ContactSolution]) -> dict[str, Any]:
    """Return what `FrictionCurves.from_solutions` needs of contacts, one entry each; see there."""
    given: object = solutions
    solved = tuple(given) if isinstance(given, Iterable) and given is not np.ma.masked else (given,)
    for solution in solved:
        if not isinstance(solution, ContactSolution):
            raise InputError(
                f"solutions must be ContactSolutions, as solve_steady() gives them, not {type(solution).__name__}.",
                code="not-solutions",
            )
        if solution.temperature is None:
            raise InputError(
                "temperature of a contact solution is missing; friction curves need one.", code="no-temperature"
            )
        if solution.speed == 0.0 or not math.isfinite(solution.speed):
            raise InputError(
                f"speed = {shown_number(solution.speed, 'g')} m/s of a solution must be finite and not zero.",
                code="no-speed",
            )
    units = {"N/m" if solution.geometry == "line" else "N" for solution in solved}
    if len(units) > 1:
        raise InputError(
            "solutions of point contacts and of line contacts, whose loads are per length, do not form one curve.",
            code="mixed-geometries",
        )
    columns = columns_of_records(
        [indenter_record(solution, float(solution.temperature)) for solution in solved],
        units.pop() if units else "N",
    )
    beyond = [[note for note in map(note_of, solution.warnings) if note.code == BEYOND] for solution in solved]
    return columns | {"notes": (*columns["notes"], *counted(beyond))}


def columns_of_records(records: Sequence[Record], load_unit: str) -> dict[str, Any]:
    """Return what `FrictionCurves` needs of contacts, solved or interpolated, one entry each."""

    def column(name: str) -> Array:
        return np.array([getattr(record, name) for record in records], dtype=float)

    speed, load, area = column("speed"), column("load"), column("contact_area")
    return {
        "speed": np.abs(speed),
        "temperature": column("temperature"),
        "load": load,
        "viscoelastic": np.copysign(1.0, speed) * column("friction_coefficient"),
        "viscoelastic_error": column("friction_error"),
        "viscoelastic_scatter": np.zeros(len(records)),
        "replicates": np.ones(len(records), dtype=np.int64),
        "mean_pressure": load / area,
        "mean_pressure_error": load / area**2 * column("contact_area_error"),
        "notes": counted([record.warnings for record in records], rank=[record.half_width for record in records]),
        "load_unit": load_unit,
    }


def beyond_range(material: Material, records: Sequence[Record], kelvins: Array) -> tuple[Note, ...]:
    """Return a note on contacts, at these temperatures (n,), whose frequencies the material was not measured at."""
    fit: SpectrumFit | None = getattr(material.spectrum, "fit", None)
    if fit is None:  # a table of moduli has notes of its own
        return ()
    alpha = 1.0 if material.shift is None else material.shift(kelvins)
    return fit.beyond(alpha * np.array([record.frequency for record in records]), "reduced frequency αv/a")
