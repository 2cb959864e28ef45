"""What is known of the cases of a curve, each number a column, and of friction along the master curve."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.datasets import plain
from viscofric.study.record import Failure
from viscofric.study.study_rubber import band_columns

if TYPE_CHECKING:
    from collections.abc import Iterable

    from viscofric.study.contacts import Contacts, Solved
    from viscofric.study.planning.plan import Outcome
    from viscofric.study.record import Record
    from viscofric.study.study_rubber import StudyRubber

#: Friction counts as unresolved where its error is more than so many times what was asked for.
_UNRESOLVED = 2.0
#: Numbers of a contact that are told besides its friction, where it has them.
_COLUMNS = (
    "indentation",
    "contact_area",
    "front",
    "rear",
    "max_pressure",
    "centre_of_pressure",
    "contact_area_fraction",
    "mean_gap",
)
_DIGITS = 6


def columns(contacts: Contacts, asked: Solved) -> dict[str, Any]:
    """Return what is known of all cases, each number a column."""
    bands = band_columns(contacts.rubbers, asked.of_records, asked.records)
    rows = [number for number, outcome in enumerate(asked.outcomes) if not isinstance(outcome, Failure)]

    def column(values: Iterable[float]) -> Any:
        whole = np.full(len(asked.cases), np.nan)
        whole[rows] = list(values)
        return plain(whole, _DIGITS)

    records = asked.records
    found = {
        "friction": column(one.friction_coefficient for one in records),
        "error": column(one.friction_error for one in records),
        "interpolated": [getattr(outcome, "interpolated", False) for outcome in asked.outcomes],
        "lower": None if bands is None else column(bands.viscoelastic_lower),
        "upper": None if bands is None else column(bands.viscoelastic_upper),
        "material_error": None if bands is None else column(bands.material_error),
        "doubts": [_doubts(contacts, case, outcome) for case, outcome in zip(asked.cases, asked.outcomes, strict=True)],
    }
    has = [name for name in _COLUMNS if hasattr(records[0], name)]
    return found | {name: column(getattr(one, name) for one in records) for name in has}


def _doubts(contacts: Contacts, case: Any, outcome: Outcome) -> list[str]:
    """Name what is doubtful about a point."""
    if isinstance(outcome, Failure):
        return ["failed"]
    rubber: StudyRubber = contacts.rubbers[case.material]
    asked = contacts.study.solver.accuracy * abs(outcome.friction_coefficient)
    found = {
        "extrapolated": not rubber.is_within(case, outcome),
        "shift": bool(np.any(rubber.shift.extrapolates(np.array([case.temperature])))),
        "strain": bool(outcome.warnings),
        "unresolved": outcome.friction_error > _UNRESOLVED * asked,
    }
    return [name for name, doubtful in found.items() if doubtful]


def master_curve(contacts: Contacts, along: Solved) -> dict[str, Any] | None:
    """Return friction along the master curve, at the reference temperature; None where there is more than one."""
    if not along.records:
        return None
    records: list[Record] = along.records
    curves = contacts.rubbers[0].bands.curves(records)
    shown = {
        "reduced_speed": curves.speed,
        "friction": curves.viscoelastic,
        "lower": curves.viscoelastic_lower,
        "upper": curves.viscoelastic_upper,
    }
    return {name: None if values is None else plain(values, _DIGITS) for name, values in shown.items()}
