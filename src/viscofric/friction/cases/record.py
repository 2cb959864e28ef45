"""Stored part of a contact of a study: its numbers with their meaning, or the reason for a failure."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, fields
from typing import Any, NamedTuple, Self

import numpy as np

from viscofric.arguments import insist_on
from viscofric.arrays import Array
from viscofric.contact.periodic.solution import NUMBERS as SURFACE
from viscofric.contact.periodic.solution import PeriodicSolution
from viscofric.contact.solution import LINE_NUMBERS as LINE
from viscofric.contact.solution import NUMBERS as INDENTER
from viscofric.contact.solution import ContactSolution, Meaning
from viscofric.datasets import plain
from viscofric.errors import InputError, ViscofricError
from viscofric.friction.sensitivity import ComplianceSensitivity
from viscofric.notes import Note, codes, counted, note_of, records
from viscofric.rheology.material import EXTRAPOLATED, Material, unknown_frequencies
from viscofric.rheology.spectra.quality import BEYOND, DOUBTS
from viscofric.roughness.patches import contact_statistics
from viscofric.units import shown_number


class ContactFields(NamedTuple):
    """Fields of one contact: x (nx,) and y (ny,), m; pressure and displacement (nx, ny), Pa and m into the solid."""

    x: Array
    y: Array
    pressure: Array
    displacement: Array


@dataclass(frozen=True)
class Failure:
    """A case without a result."""

    reason: str  # one sentence, or a note that brings its remedy
    label: str  # the case in words
    code: str = ""  # of the error that caused it

    def __str__(self) -> str:
        return str(self.note)

    @classmethod
    def of(cls, error: ViscofricError, label: str) -> Self:
        """Return the failure of a case that ends with an error."""
        return cls(error.note, label, error.code)

    @property
    def note(self) -> Note:
        """The reason as a note whose place is the case."""
        return note_of(self.reason).coded(self.code).at(self.label)


# What is stored of every contact, in the order in which results list it.
_SHARED = (
    *("speed", "temperature", "friction_coefficient", "friction_error", "max_pressure", "energy_balance"),
    *("complementarity", "cells", "products", "interpolation_error"),
)
# … of an indenter's …
_OF_INDENTER = (
    *("load", "indentation", "indentation_error", "contact_area", "contact_area_error", "front", "rear", "half_width"),
    *("edge_error", "max_pressure_error", "centre_of_pressure"),
)
# … and of one on a rough surface.
_OF_SURFACE = (
    *("pressure", "lateral_friction_coefficient", "lateral_friction_error", "contact_area_fraction"),
    *("corrected_area_fraction", "mean_gap"),
)


def _stored(names: tuple[str, ...], meaning: dict[str, Meaning]) -> dict[str, Meaning]:
    """Return the names with unit and long name: those of a solution, and those that only studies have."""
    more: dict[str, Meaning] = {
        "interpolation_error": ("1", "part of the friction error due to interpolation between solved contacts"),
        "pressure": SURFACE["mean_pressure"],
        "corrected_area_fraction": ("1", "contact area fraction, corrected for the excess of counted points"),
    }
    return {name: (meaning | more)[name] for name in names}


NUMBERS = _stored(_SHARED + _OF_INDENTER, INDENTER)
LINE_NUMBERS = _stored(_SHARED + _OF_INDENTER, LINE)
SURFACE_NUMBERS = _stored(_SHARED + _OF_SURFACE, SURFACE)
#: Those of each geometry of `Case`.
MEANING = {"point": NUMBERS, "line": LINE_NUMBERS, "rough": SURFACE_NUMBERS}
#: Of the fields.
FIELD_MEANING: dict[str, Meaning] = {
    "x": ("m", "position along the motion, ahead of the indenter's axis"),
    "y": ("m", "position across the motion"),
    "pressure": ("Pa", "contact pressure"),
    "displacement": ("m", "displacement of the surface into the rubber"),
}
#: Numbers that may be infinite: those of a line contact.
ENDLESS = ("half_width",)


@dataclass(frozen=True)
class Record:
    """Stored part of one contact, SI; each number is also an attribute.

    Of interpolated contacts, the residuals are the largest of the neighbouring solved ones, there are no cells and
    products, and `interpolation_error` is the part of the error of friction due to interpolation.
    """

    numbers: dict[str, float]  # see `MEANING`
    warnings: tuple[Note, ...] = ()
    interpolated: bool = False  # between solved contacts
    sensitivity: ComplianceSensitivity | None = None  # if bands are requested
    fields: ContactFields | None = field(default=None, repr=False, compare=False)  # if requested; in a file of its own

    @classmethod
    def of(
        cls,
        *,
        warnings: tuple[Note, ...] = (),
        interpolated: bool = False,
        sensitivity: ComplianceSensitivity | None = None,
        fields: ContactFields | None = None,
        **numbers: float,
    ) -> Self:
        """Return a record of numbers by name; raise `TypeError` if one is missing or unknown."""
        names = SURFACE_NUMBERS if "contact_area_fraction" in numbers else NUMBERS
        given = {"interpolation_error": 0.0, **numbers}
        if given.keys() != set(names):
            raise TypeError(f"numbers of a contact are missing or unknown: {sorted(given.keys() ^ set(names))}.")
        return cls({name: given[name] for name in names}, warnings, interpolated, sensitivity, fields)

    def __getattr__(self, name: str) -> float:
        numbers: dict[str, float] = self.__dict__.get("numbers", {})
        if name not in numbers:
            raise AttributeError(f"a record has no {name}.")
        return numbers[name]

    @property
    def frequency(self) -> float:
        """Speed over half the length of an indenter's contact, rad/s."""
        return self.speed / (0.5 * (self.front + self.rear))

    @classmethod
    def from_values(cls, values: dict[str, Any]) -> Self:
        """Return a record from `values`, without fields; raise ValueError, TypeError or KeyError if it is invalid."""
        if "history" in values:
            return HistoryRecord.stored(values)  # type: ignore[return-value]
        given = {**values, "warnings": _stored_notes(values["warnings"])}
        if "contact_area_fraction" not in values and (stored := values["sensitivity"]) is not None:
            columns = {name: np.array(stored[name], dtype=float) for name in _COLUMNS}
            given["sensitivity"] = ComplianceSensitivity(**{**stored, **columns})
        record = cls.of(**given)
        if not isinstance(record.interpolated, bool):
            raise TypeError("interpolated is neither true nor false.")
        sound = (is_number(value) or (name in ENDLESS and value == math.inf) for name, value in record.numbers.items())
        if not all(sound) or not _is_sound(record.sensitivity):
            raise ValueError("a number is invalid.")
        return record

    def values(self) -> dict[str, Any]:
        """Return everything but the fields, in types that JSON stores exactly."""
        values: dict[str, Any] = {**self.numbers, "interpolated": self.interpolated}
        values["warnings"] = plain(records(self.warnings), None)
        if "contact_area_fraction" in self.numbers:
            return values
        values["sensitivity"] = None
        if self.sensitivity is not None:
            stored = {field.name: getattr(self.sensitivity, field.name) for field in fields(self.sensitivity)}
            values["sensitivity"] = stored | {name: stored[name].tolist() for name in _COLUMNS}
        return values


class Column(NamedTuple):
    """Values over time with their unit and long name."""

    values: list[float]
    unit: str
    words: str


@dataclass(frozen=True)
class HistoryRecord(Record):
    """Stored part of one contact over time, of one impact, or of a friction curve with heating."""

    columns: dict[str, Column] = field(default_factory=dict)  # over times or speeds, or one value of the whole, SI

    def values(self) -> dict[str, Any]:
        """Return everything in types that JSON stores exactly."""
        columns = {name: list(one) for name, one in self.columns.items()}
        return {"history": columns, "warnings": plain(records(self.warnings), None)}

    @classmethod
    def stored(cls, values: dict[str, Any]) -> Self:
        """Return a record from `values`; raise ValueError, TypeError or KeyError if it is invalid."""
        columns = {name: Column(*one) for name, one in values["history"].items()}
        lengths = {len(one.values) for one in columns.values()} - {1}
        sound = all(is_number(value) or value == math.inf for one in columns.values() for value in one.values)
        if len(lengths) > 1 or not columns or not sound:
            raise ValueError("a history is invalid.")
        return cls({}, _stored_notes(values["warnings"]), columns=columns)


def _stored_notes(stored: list[dict[str, Any]]) -> tuple[Note, ...]:
    """Return stored notes; raise TypeError if they are none."""
    if not all(isinstance(one, dict) for one in stored):
        raise TypeError("warnings are not notes.")
    return tuple(map(note_of, stored))


def indenter_record(
    solution: ContactSolution,
    temperature: float,
    sensitivity: ComplianceSensitivity | None = None,
    with_fields: bool = False,
) -> Record:
    """Return the record of an indenter's contact."""
    cells = {"cells": max(solution.diagnostics.shape), "temperature": temperature}
    return _record(NUMBERS, solution, sensitivity, with_fields, **cells)


def surface_record(solution: PeriodicSolution, temperature: float, with_fields: bool = False) -> Record:
    """Return the record of a contact on a rough surface."""
    corrected = contact_statistics(solution).corrected_area_fraction
    own = {"pressure": solution.mean_pressure, "corrected_area_fraction": corrected, "temperature": temperature}
    return _record(SURFACE_NUMBERS, solution, None, with_fields, cells=max(solution.pressure.shape), **own)


#: Codes of notes that are counted over all contacts of a curve or a study.
_COUNTED = (BEYOND, EXTRAPOLATED, *DOUBTS)


def _record(
    names: Iterable[str],
    solution: ContactSolution | PeriodicSolution,
    sensitivity: ComplianceSensitivity | None,
    with_fields: bool,
    **own: Any,
) -> Record:
    """Return the record of a contact: its own numbers, and those that solution or diagnostics have by their names."""
    diagnostics = solution.diagnostics
    own |= {"energy_balance": diagnostics.energy, "interpolation_error": 0.0}
    others = [name for name in names if name not in own]
    read = {name: getattr(solution if hasattr(solution, name) else diagnostics, name) for name in others}
    warnings = tuple(note for note in map(note_of, solution.warnings) if not note.code.startswith(_COUNTED))
    fields = ContactFields(solution.x, solution.y, solution.pressure, solution.displacement) if with_fields else None
    return Record.of(**own, **read, warnings=warnings, sensitivity=sensitivity, fields=fields)


# Arrays of a sensitivity.
_COLUMNS = ("log_tau", "slope")


def is_number(value: object) -> bool:
    """Whether it is a finite number."""
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _is_sound(sensitivity: ComplianceSensitivity | None) -> bool:
    """Whether all numbers of a sensitivity are finite, and its columns have equal length."""
    if sensitivity is None:
        return True
    single = [field.name for field in fields(sensitivity) if field.name not in _COLUMNS]
    columns = [getattr(sensitivity, name) for name in _COLUMNS]
    return all(is_number(getattr(sensitivity, name)) for name in single) and all(
        column.ndim == 1 and column.size > 1 and column.size == columns[0].size and np.all(np.isfinite(column))
        for column in columns
    )


def columns_of(solutions: Iterable[ContactSolution]) -> dict[str, Any]:
    """Return what `FrictionCurves.from_solutions` needs of contacts, one entry each; see there."""
    given: object = solutions
    solved = tuple(given) if isinstance(given, Iterable) and given is not np.ma.masked else (given,)
    for solution in solved:
        insist_on(solution, "solutions", ContactSolution, right="ContactSolutions, as solve_steady() gives them")
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
    beyond = [
        [note for note in map(note_of, solution.warnings) if note.code.startswith(_COUNTED)] for solution in solved
    ]
    unmeasured = np.array([BEYOND in codes(notes) for notes in beyond])
    if unmeasured.any():
        columns["within_measured_frequencies"] = 1.0 - unmeasured
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


def columns_of_contacts(
    material: Material, records: Sequence[Record], load_unit: str, warmer: Array | float = 0.0
) -> dict[str, Any]:
    """Return what `columns_of_records` does, and which frequencies were measured, of contacts warmer by (n,), K."""
    columns = columns_of_records(records, load_unit)
    columns["notes"] += (*unknown_frequencies(material), *material.notes_at(columns["temperature"]))
    known = material.spectrum.known_frequencies
    if known is None:  # a table of moduli has notes of its own
        return columns
    alpha = 1.0 if material.shift is None else material.shift(columns["temperature"] + warmer)
    frequency = alpha * np.array([record.frequency for record in records])
    columns["notes"] += known.beyond(frequency, "reduced frequency αv/a")
    covered = known.covers(frequency)
    if unknown_frequencies(material) and covered.all():
        return columns
    return columns | {"within_measured_frequencies": covered.astype(float)}
