"""Columns of one table of a creep or relaxation test in SI units: time, response, temperature; and the kind of test."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import DataFileError
from viscofric.notes import Note, Remedy, setting
from viscofric.readers.dma.names import (
    SET_TEMPERATURE,
    STEP,
    STRAIN_AMPLITUDE,
    TEMPERATURE,
    TIME,
    known_temperatures,
    temperature_in_name,
    unclear_in_name,
)
from viscofric.readers.headings import Vocabulary
from viscofric.readers.source import Source, unit_conversion
from viscofric.readers.table import Table
from viscofric.step_tests import StepKind

#: Since the step, read rather than one that counts from the beginning of a programme.
STEP_TIME = frozenset({"step time", "time in step", "creep time", "relaxation time", "kriechzeit", "segment time"})
CREEP_COMPLIANCE = frozenset(
    {"J", "J(t)", "D", "D(t)", "j(t)", "d(t)", "compliance", "creep compliance", "shear compliance", "compliance j(t)"}
    | {"tensile compliance", "shear creep compliance", "tensile creep compliance", "creep compliance j(t)"}
    | {"nachgiebigkeit", "kriechnachgiebigkeit", "complaisance", "complaisance de fluage", "cedevolezza"}
    | {"complianza", "fluencia", "compliancia", "蠕变柔量", "クリープコンプライアンス"}
)
RELAXATION_MODULUS = frozenset(
    {"E", "G", "E(t)", "G(t)", "e(t)", "g(t)", "modulus", "modulus g(t)", "modulus e(t)", "relaxation modulus"}
    | {"relaxation modulus g(t)", "relaxation modulus e(t)", "shear relaxation modulus", "tensile relaxation modulus"}
    | {"stress relaxation modulus", "relax. modulus", "G rel", "E rel", "G r(t)", "E r(t)", "shear modulus"}
    | {"relaxationsmodul", "module de relaxation", "módulo de relajación"}
    | {"modulo di rilassamento", "松弛模量", "緩和弾性率"}
)
STRESS = frozenset(
    {"σ", "τ", "sigma", "stress", "shear stress", "tensile stress", "spannung", "schubspannung", "contrainte"}
    | {"contrainte de cisaillement", "esfuerzo", "sforzo", "应力", "応力"}
)

#: The words of tables of step tests: name of a quantity in errors -> names of its columns.
STEPS = Vocabulary(
    "a table of creep or relaxation tests",
    {
        "temperature": TEMPERATURE,
        "time": TIME,
        "creep compliance": CREEP_COMPLIANCE,
        "relaxation modulus": RELAXATION_MODULUS,
        "stress": STRESS,
        "strain": STRAIN_AMPLITUDE,
        "step time": STEP_TIME,
        "set temperature": SET_TEMPERATURE,
        "step": STEP,
    },
    needed=(("time", "step time"), ("creep compliance", "relaxation modulus", "strain")),
    example="a creep test has e.g. 'temperature (degC)', 'time (s)', 'creep compliance (1/MPa)', a relaxation test "
    "'relaxation modulus (MPa)'",
    key="material.columns",
    offered=(
        ("temperature", "degC"),
        ("time", "s"),
        ("creep compliance", "1/MPa"),
        ("relaxation modulus", "MPa"),
    ),
    logarithms=True,
    conditions=("temperature",),
    several="titled",
)

_CREEP = re.compile(r"creep|fluage|kriech|retard", re.IGNORECASE)
_RELAXATION = re.compile(r"relax", re.IGNORECASE)
_RECOVERY = re.compile(r"recover|erholung|recouvrance", re.IGNORECASE)


def kind_in_name(name: str) -> str:
    """Return the kind of test that the name of a step or file states: creep, relaxation, recovery, or ""."""
    if _RECOVERY.search(name):
        return "recovery"
    if _RELAXATION.search(name):
        return "relaxation"
    return "creep" if _CREEP.search(name) else ""


#: What is held is constant to this over the second half of a test.
HELD = 0.02  # relative
_SI = {"creep": "1/Pa", "relaxation": "Pa"}
_COLUMN = {"creep": "creep compliance", "relaxation": "relaxation modulus"}


def time_of(table: Table, notes: list[str]) -> Array:
    """Return the times since the step, s, with a note where the column has no unit."""
    place = table.place("step time")
    place = table.place("time") if place is None else place
    if place is None:
        raise table.lacking(["time"])
    column = table.columns[place]
    if not column.unit:
        said = f"The column {column.heading!r} has no unit; it was read in seconds."
        notes.append(Note("time-without-unit", said))
    return table.values(place, "s", or_missing=True, assumed="s")


def kind_of(table: Table, name: str) -> StepKind:
    """Return creep or relaxation by the columns, the name of the step, or what is held."""
    creep, relaxation = table.has("creep compliance"), table.has("relaxation modulus")
    if creep != relaxation:
        return "creep" if creep else "relaxation"
    said = kind_in_name(name)
    if said in ("creep", "relaxation"):
        return "creep" if said == "creep" else "relaxation"
    stress, strain = table.place("stress"), table.place("strain")
    if stress is not None and strain is not None:
        steady = [_is_held(table.numbers_or_missing(place)) for place in (stress, strain)]
        if steady[0] != steady[1]:
            return "creep" if steady[0] else "relaxation"
    remedy = Remedy(
        "; give kind='creep' or 'relaxation'.",
        "; choose --creep or --relaxation of viscofric material fit.",
        "; name it as creep or as relaxation under [material].",
        "; choose “Creep tests” or “Relaxation tests” as the source, and drop it there.",
    )
    raise table.refused("no-kind", "does not state whether it is creep or relaxation", remedy)


def _is_held(values: Array) -> bool:
    late = values[len(values) // 2 :]
    late = late[np.isfinite(late)]
    return bool(late.size) and float(np.ptp(late)) <= HELD * float(np.abs(np.mean(late)))


#: Between the rubber and the glass.
USUAL_MODULUS = 1e7  # Pa


def response_of(table: Table, source: Source, kind: StepKind, notes: list[str]) -> tuple[Array, str, bool]:
    """Return the response in SI units, its heading, and whether its unit is that of the user alone."""
    place = table.place(_COLUMN[kind])
    if place is not None:
        column = table.columns[place]
        lacks_unit = bool(source.modulus_unit) and not column.unit
        if not column.unit and not source.modulus_unit:
            example = _likely_unit(table.numbers_or_missing(place), kind)
            by = setting("material.modulus_unit", "Unit of the moduli", repr(example))
            remedy = replace(by, python=f"response_unit='{example}'") + "."
            raise table.refused(
                "no-unit", f"column {column.heading!r} has no unit; give that of the file, perhaps ", remedy
            )
        if lacks_unit:  # an error names the argument
            unit_conversion(source.modulus_unit, _SI[kind], "response_unit")
        values = table.values(place, _SI[kind], or_missing=True, assumed=source.modulus_unit)
        return values, column.heading, lacks_unit
    stress, strain = table.place("stress"), table.place("strain")
    if stress is None or strain is None:
        beside = ["stress"] if strain is not None else ["strain"] if stress is not None else []
        raise table.lacking([*beside, _COLUMN[kind]])
    stresses = table.values(stress, "Pa", or_missing=True)
    strains = table.ratio(strain, or_missing=True)
    said = f"The {_COLUMN[kind]} was computed from stress and strain."
    notes.append(Note("response-computed", said))
    above, below = (strains, stresses) if kind == "creep" else (stresses, strains)
    return above / np.where(below == 0.0, np.nan, below), table.columns[stress].heading, False


def held_of(table: Table, kind: StepKind) -> Array:
    """Return what a test holds, the stress of creep or the strain of relaxation, as printed; NaN without one column."""
    what = "stress" if kind == "creep" else "strain"
    places = [place for place, column in enumerate(table.columns) if column.quantity == what]
    try:
        return table.numbers_or_missing(*places) if len(places) == 1 else np.full(len(table.rows), np.nan)
    except DataFileError:  # words in a column that is not needed
        return np.full(len(table.rows), np.nan)


def _likely_unit(values: Array, kind: StepKind) -> str:
    """Return the unit in which values without one are nearest to those of a rubber, at their stiffest."""
    known = np.abs(values[np.isfinite(values) & (values != 0.0)])
    creep = kind == "creep"
    stiffest = 1.0 if not known.size else float(1.0 / known.min() if creep else known.max())
    # Midway, it is as far from the usual modulus in Pa as in MPa.
    return ("1/" if creep else "") + ("Pa" if stiffest > 1e-3 * USUAL_MODULUS else "MPa")


def temperature_of(table: Table, source: Source, name: str, notes: list[str]) -> Array:
    """Return K, at last from the name of file or sheet, with a note."""
    place = table.place("temperature")
    known = known_temperatures(table, table.place("set temperature") if place is None else place, source, notes)
    if known is not None:
        return known
    found = temperature_in_name(name) or temperature_in_name(source.stem)
    if found is None:
        unclear = unclear_in_name(source.stem)
        problem = f"no column for temperature{unclear}, this table has {table.headings()}; give it, e.g. "
        by = setting("material.temperature", "Temperature of the sweep", "'25 degC'")
        raise table.refused("no-temperature", problem, replace(by, python="temperature='25 degC'") + ".")
    notes.append(Note("temperature-from-name", "No column holds a temperature; it was taken from the file's name."))
    return np.full(len(table.rows), found)
