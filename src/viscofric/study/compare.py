"""Two results beside each other: the same cases, the same provenance, the same numbers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.study.cases_in_common import CaseTable, common_cases
from viscofric.study.provenance_differences import provenance_differences

if TYPE_CHECKING:
    from viscofric.arrays import Array


#: Variables that are compared -> the variable with its stated error.
COMPARED = {
    "friction_coefficient": "friction_error",
    "indentation": "indentation_error",
    "contact_area": "contact_area_error",
    "front": "edge_error",
    "rear": "edge_error",
    "half_width": "edge_error",
    "max_pressure": "max_pressure_error",
    "centre_of_pressure": "",
}
#: Variables without an error of their own agree within the accuracy, or within this where none is told.
_USUAL_ACCURACY = 1e-3
#: Differences of as many times the combined stated errors are no differences.
_WITHIN = 2.0
_LAST_DIGITS = 1e-12


@dataclass(frozen=True)
class VariableDifference:
    """How far one variable differs over the cases that two results have in common.

    Attributes
    ----------
    name, unit : str
    points : int
        Cases that both solved.
    largest, rms : float
        Relative to the larger of the two values.
    in_errors : float or None
        The largest difference over the combined stated error; None where no error is stated.
    where : dict of str to float or str
        Coordinates of the largest difference, SI.
    first, second : float
        The values there.
    equal : bool
        Whether all differences are within the tolerance, or without one within twice the combined stated errors.
    """

    name: str
    unit: str
    points: int
    largest: float
    rms: float
    in_errors: float | None
    where: dict[str, float | str]
    first: float
    second: float
    equal: bool


@dataclass(frozen=True)
class ResultsComparison:
    """What `compare_results` found.

    Attributes
    ----------
    cases : int
        In common.
    only_first, only_second : int
        Cases that the other has not.
    solved_once : int
        Cases in common that only one of the two could solve.
    axes : tuple of str
        How the axes differ, one sentence each.
    provenance : tuple of str
        How inputs, versions and accuracy differ, one sentence each.
    differences : tuple of VariableDifference
    tolerance : float or None
        Relative; None: the stated errors.
    """

    cases: int
    only_first: int
    only_second: int
    solved_once: int
    axes: tuple[str, ...]
    provenance: tuple[str, ...]
    differences: tuple[VariableDifference, ...]
    tolerance: float | None

    @property
    def equal(self) -> bool:
        """Whether both have the same cases, and the same values within the tolerance."""
        same_cases = self.only_first == self.only_second == self.solved_once == 0
        return same_cases and all(difference.equal for difference in self.differences)


def compare_tables(one: CaseTable, other: CaseTable, tolerance: float | None) -> ResultsComparison:
    """Compare two tables case by case; see `viscofric.compare_results`."""
    pairs = common_cases(one, other)
    accuracy = max(table.accuracy or 0.0 for table in (one, other)) or _USUAL_ACCURACY
    names = [name for name in COMPARED if name in one.columns and name in other.columns]
    solved = one.solved[pairs.first], other.solved[pairs.second]
    both = solved[0] & solved[1]
    rows = pairs.first[both], pairs.second[both]
    return ResultsComparison(
        cases=len(pairs.first),
        only_first=len(one) - len(pairs.first),
        only_second=len(other) - len(pairs.second),
        solved_once=int(np.count_nonzero(solved[0] != solved[1])),
        axes=pairs.remarks,
        provenance=tuple(provenance_differences(one.attributes, other.attributes)),
        differences=tuple(_difference(name, (one, other), rows, tolerance, accuracy) for name in names)
        if both.any()
        else (),
        tolerance=tolerance,
    )


def _difference(
    name: str,
    tables: tuple[CaseTable, CaseTable],
    rows: tuple[Any, Any],
    tolerance: float | None,
    accuracy: float,
) -> VariableDifference:
    """Compare one variable over the cases that both have solved."""
    a, b = (table.columns[name][row] for table, row in zip(tables, rows, strict=True))
    gap, scale = np.abs(a - b), np.maximum(np.abs(a), np.abs(b))
    relative = np.divide(gap, scale, out=np.zeros_like(gap), where=scale > 0.0)
    errors = _combined_error(name, tables, rows)
    if tolerance is not None:
        within = relative <= tolerance
    elif errors is None:
        within = relative <= _WITHIN * accuracy
    else:
        within = gap <= _WITHIN * errors + _LAST_DIGITS * scale
    # Where the difference is largest beyond what is allowed, if it is anywhere.
    worst = int(np.argmax(relative if within.all() else np.where(within, -1.0, relative)))
    return VariableDifference(
        name=name,
        unit=tables[0].units[name],
        points=len(a),
        largest=float(relative.max()),
        rms=float(np.sqrt(np.mean(relative**2))),
        in_errors=None if errors is None else _largest_ratio(gap, errors),
        where=tables[0].place(int(rows[0][worst])),
        first=float(a[worst]),
        second=float(b[worst]),
        equal=bool(within.all()),
    )


def _combined_error(name: str, tables: tuple[CaseTable, CaseTable], rows: tuple[Any, Any]) -> Array | None:
    """Return the stated errors of both, added in squares; None where neither states any."""
    stated = [
        table.columns[COMPARED[name]][row]
        for table, row in zip(tables, rows, strict=True)
        if COMPARED[name] in table.columns
    ]
    if not stated:
        return None
    known = [np.where(np.isfinite(error), error, 0.0) for error in stated]
    total: Array = np.sqrt(np.sum(np.square(known), axis=0))
    return total


def _largest_ratio(gap: Array, errors: Array) -> float | None:
    """Return the largest difference in units of its error; None where a difference has an error of zero."""
    if np.any((errors == 0.0) & (gap > 0.0)):
        return None
    return float(np.divide(gap, errors, out=np.zeros_like(gap), where=errors > 0.0).max())
