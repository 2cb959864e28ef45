"""Comparison of two results: the same cases, provenance and numbers."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import PurePath
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.solution import ERRORS
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.files import parse_toml
from viscofric.notes import Note, table_in
from viscofric.showing import Rows, Shown
from viscofric.study.results.case_table import CaseTable, Common, common_cases
from viscofric.study.results.file import OTHER_CASES, PREDICTION

#: Variables that are compared, by the groups of results; those of rough contacts, on their grid, have no stated error.
COMPARED = {
    PREDICTION: (
        *("friction_coefficient", "indentation", "contact_area", "front", "rear", "half_width"),
        *("max_pressure", "centre_of_pressure", "contact_area_fraction", "corrected_area_fraction", "mean_gap"),
        *("interface_friction", "total_friction"),
    ),
    "heating": ("friction_coefficient", "temperature_rise", "interface_friction", "total_friction"),
    "history": ("friction_force", "indentation", "temperature_rise", "time"),
    "impact": ("restitution", "contact_time", "peak_force", "largest_indentation"),
}
#: Variables -> those with their stated errors.
_ERRORS = ERRORS | {
    "interface_friction": "interface_error",
    **{name: f"{name}_error" for name in ("temperature_rise", "restitution")},
}
#: Variables without a stated error agree within the accuracy, or within this if it is unknown.
_USUAL_ACCURACY = 1e-3
#: Differences within this many combined stated errors are not significant.
_WITHIN = 2.0
_LAST_DIGITS = 1e-12


@dataclass(frozen=True)
class VariableDifference:
    """Difference of one variable over the common cases of two results."""

    name: str  # with its group before it, as in "heating/friction_coefficient", if that is not the prediction
    unit: str
    points: int  # cases that both solved
    largest: float  # relative to the larger of the two values
    rms: float  # likewise
    in_errors: float | None  # the largest difference over the combined stated error; None without a stated error
    where: dict[str, float | str]  # coordinates of the largest difference, SI
    first: float  # value there
    second: float  # likewise
    #: Whether all differences are within the tolerance, or without one within twice the combined stated errors
    equal: bool


@dataclass(frozen=True)
class ResultsComparison(Shown):
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
    load_unit : str
        Of loads in `differences`: ``"N"``, or ``"N/m"`` of line contacts.
    same_cases : bool
        Whether both have solved the same cases, also those with heat, over time, and of impacts.
    """

    cases: int
    only_first: int
    only_second: int
    solved_once: int
    axes: tuple[str, ...]
    provenance: tuple[str, ...]
    differences: tuple[VariableDifference, ...]
    tolerance: float | None
    load_unit: str
    same_cases: bool

    def _shown(self) -> Rows:
        return (
            ("equal", self.equal),
            ("cases in common", self.cases),
            ("only in the first", self.only_first),
            ("only in the second", self.only_second),
            ("solved by one only", self.solved_once),
            ("variables", self.differences),
            ("different variables", sum(not one.equal for one in self.differences)),
            ("tolerance", self.tolerance),
        )

    @property
    def equal(self) -> bool:
        """Whether both have the same cases, and the same values within the tolerance."""
        return self.same_cases and all(difference.equal for difference in self.differences)

    def to_dataset(self) -> Dataset:
        """Return the differences along the dimension ``variable``.

        Returns
        -------
        xarray.Dataset
            ``unit``, ``points``, ``largest``, ``rms``, ``in_errors`` (NaN without a stated error), ``first`` and
            ``second`` (in that unit), ``equal``; the attributes are ``cases``, ``only_first``, ``only_second``,
            ``solved_once``, ``tolerance``, ``equal``, and ``axes`` and ``provenance`` (JSON).
        """
        single = {name: getattr(self, name) for name in ("cases", "only_first", "only_second", "solved_once")}
        columns = {name: [getattr(one, name) for one in self.differences] for name in ("name", *_OF_A_DIFFERENCE)}
        columns["in_errors"] = [math.nan if one is None else one for one in columns["in_errors"]]
        return dataset(
            "variable",
            {name: (columns[name], "1", words) for name, words in _OF_A_DIFFERENCE.items()},
            coordinates={"variable": (columns["name"], "1", "variable")},
            attributes={
                **single,
                "tolerance": self.tolerance,
                "equal": int(self.equal),
                "axes": json.dumps(self.axes, ensure_ascii=False),
                "provenance": json.dumps(self.provenance, ensure_ascii=False),
            },
        )


# Columns of the data set of a comparison.
_OF_A_DIFFERENCE = {
    "unit": "unit of the values",
    "points": "cases that both solved",
    "largest": "largest relative difference",
    "rms": "rms of the relative differences",
    "in_errors": "largest difference over the combined stated error",
    "first": "first value at the largest difference, in its unit",
    "second": "second value at the largest difference, in its unit",
    "equal": "whether all differences are within the tolerance",
}


def compare_tables(
    one: Mapping[str, CaseTable], other: Mapping[str, CaseTable], tolerance: float | None
) -> ResultsComparison:
    """Compare two results, of each group a table, case by case; see `viscofric.compare_results`."""
    first, second = (tables[PREDICTION] for tables in (one, other))
    pairs, solved_once, differences = _compared(PREDICTION, first, second, tolerance)
    only_first, only_second = len(first) - len(pairs.first), len(second) - len(pairs.second)
    same, remarks = only_first == only_second == solved_once == 0, list(pairs.remarks)
    known = bool(first.attributes and second.attributes)  # friction curves have no other groups
    for name in [name for name in OTHER_CASES if known and (name in one or name in other)]:
        if name not in one or name not in other:
            same = False
            remarks.append(f"Only {(first if name in one else second).name} has a group '{name}'.")
            continue
        try:
            found, apart, more = _compared(name, one[name], other[name], tolerance)
        except InputError as error:
            same = False
            remarks.append(f"{name}: {error}")
            continue
        alike = len(one[name]) == len(other[name]) == len(found.first) and not apart
        same = same and alike
        remarks += [f"{name}: {said}" for said in found.remarks] if not alike else []
        differences += more
    return ResultsComparison(
        cases=len(pairs.first),
        only_first=only_first,
        only_second=only_second,
        solved_once=solved_once,
        axes=tuple(remarks),
        provenance=tuple(provenance_differences(first.attributes, second.attributes)),
        differences=tuple(differences),
        tolerance=tolerance,
        load_unit="N/m" if first.per_length else "N",
        same_cases=same,
    )


def _compared(
    group: str, one: CaseTable, other: CaseTable, tolerance: float | None
) -> tuple[Common, int, list[VariableDifference]]:
    """Return the common cases of a group, how many of them one only has solved, and the differences of the others."""
    pairs = common_cases(one, other)
    accuracy = max(table.accuracy or 0.0 for table in (one, other)) or _USUAL_ACCURACY
    shared = [name for name in COMPARED[group] if name in one.columns and name in other.columns]
    # A line contact has no end across the motion.
    names = [name for name in shared if any(np.isfinite(table.columns[name]).any() for table in (one, other))]
    solved = one.solved[pairs.first], other.solved[pairs.second]
    both = solved[0] & solved[1]
    rows = pairs.first[both], pairs.second[both]
    differences = [_difference(name, (one, other), rows, tolerance, accuracy) for name in names] if both.any() else []
    if group != PREDICTION:
        differences = [replace(found, name=f"{group}/{found.name}") for found in differences]
    return pairs, int(np.count_nonzero(solved[0] != solved[1])), differences


def _difference(
    name: str, tables: tuple[CaseTable, CaseTable], rows: tuple[Any, Any], tolerance: float | None, accuracy: float
) -> VariableDifference:
    """Compare one variable over the cases that both have solved."""
    a, b = (table.columns[name][row] for table, row in zip(tables, rows, strict=True))
    gap, scale = np.abs(a - b), np.maximum(np.abs(a), np.abs(b))
    # Of a half-width with an end and one without, the difference is the whole.
    relative = np.divide(gap, scale, out=np.minimum(gap, 1.0), where=(scale > 0.0) & np.isfinite(scale))
    errors = _combined_error(name, tables, rows)
    if tolerance is not None:
        within = relative <= tolerance
    elif errors is None:
        within = relative <= _WITHIN * accuracy
    else:
        within = np.isfinite(gap) & (gap <= _WITHIN * errors + _LAST_DIGITS * scale)
    # The largest difference among those beyond the limit, if there are any.
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
    """Return the stated errors of both, added in squares; None if neither states any."""
    column = _ERRORS.get(name, "")
    stated = [table.columns[column][row] for table, row in zip(tables, rows, strict=True) if column in table.columns]
    if not stated:
        return None
    known = [np.where(np.isfinite(error), error, 0.0) for error in stated]
    return np.asarray(np.sqrt(np.sum(np.square(known), axis=0)))


def _largest_ratio(gap: Array, errors: Array) -> float | None:
    """Return the largest difference in units of its error; None if a difference has an error of zero."""
    if np.any((errors == 0.0) & (gap > 0.0)):
        return None
    return float(np.divide(gap, errors, out=np.zeros_like(gap), where=errors > 0.0).max())


_MOST_KEYS = 8
_SINGLE = {"data_origin": "data", "accuracy": "accuracy", "seed": "seed"}


def provenance_differences(one: Mapping[Any, Any], other: Mapping[Any, Any]) -> Iterator[str]:
    """Yield the differences between the attributes of two results, one sentence each; friction curves have none."""
    if not one or not other:
        said = "Friction curves have no provenance: versions, inputs and accuracy are not compared."
        yield Note("no-provenance", said)
        return
    for name, words in _SINGLE.items():
        if str(one.get(name)) != str(other.get(name)):
            first, second = one.get(name, "unknown"), other.get(name, "unknown")
            yield Note(
                f"another-{words}", f"Another {words}: {first} and {second}.", values={"values": [first, second]}
            )
    yield from _versions(one, other)
    yield from _inputs(table_in(one, "input_hashes"), table_in(other, "input_hashes"))
    yield from _run_files(str(one.get("study_text", "")), str(other.get("study_text", "")))


def _versions(one: Mapping[Any, Any], other: Mapping[Any, Any]) -> Iterator[str]:
    here, there = (
        {"viscofric": str(about.get("viscofric_version", "")), **table_in(about, "software")} for about in (one, other)
    )
    changed = [
        f"{name} {here.get(name, 'unknown')} and {there.get(name, 'unknown')}"
        for name in {**here, **there}
        if here.get(name) != there.get(name)
    ]
    if changed:
        yield f"Other versions: {', '.join(changed)}."


def _inputs(here: dict[str, str], there: dict[str, str]) -> Iterator[str]:
    """Yield differences of input files by content: the same file may have another path."""
    if set(here.values()) == set(there.values()):
        return
    names = [{PurePath(path).name: digest for path, digest in of_one.items()} for of_one in (here, there)]
    for name in sorted({**names[0], **names[1]}):
        first, second = (of_one.get(name) for of_one in names)
        if first is not None and second is not None and first != second:
            yield f"The input {name} has other contents."
        elif first is None and second not in here.values():
            yield f"The input {name} belongs to the second only."
        elif second is None and first not in there.values():
            yield f"The input {name} belongs to the first only."


def _run_files(first: str, second: str) -> Iterator[str]:
    if first == second or not (first and second):  # friction curves have no run file
        return
    try:
        here, there = (dict(flat_keys(parse_toml(text))) for text in (first, second))
    except ValueError:
        yield "The run files differ."
        return
    changed = [key for key in {**here, **there} if here.get(key) != there.get(key)]
    for key in changed[:_MOST_KEYS]:
        yield f"The run files differ in {key}: {_shown(here.get(key))} and {_shown(there.get(key))}."
    if len(changed) > _MOST_KEYS:
        yield f"The run files differ in {len(changed) - _MOST_KEYS} more keys."


def flat_keys(table: Any, prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Yield every value of nested tables with its joined keys."""
    tables = table.items() if isinstance(table, dict) else enumerate(table, 1)
    for key, value in tables:
        deeper = isinstance(value, dict) or (isinstance(value, list) and value and isinstance(value[0], dict))
        yield from flat_keys(value, f"{prefix}{key}.") if deeper else [(f"{prefix}{key}", value)]


def _shown(value: Any) -> str:
    return "not given" if value is None else json.dumps(value, ensure_ascii=False, default=str)
