"""Cases as a table, and the common cases of two tables, found by coordinates in any order."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from viscofric.arrays import Integers, Mask
from viscofric.datasets import Dataset, DataTree
from viscofric.errors import InputError
from viscofric.files import file_path
from viscofric.friction.curves import FrictionCurves
from viscofric.study.cases.sweep import shown
from viscofric.study.results.columns import over_all_dimensions
from viscofric.study.results.file import OTHER_CASES, PREDICTION, cases_of, open_tree

#: Coordinates that agree to as many digits are the same.
_DIGITS = 9
# Friction of curves -> the same variables of results.
_OF_CURVES = {"viscoelastic": "friction_coefficient", "viscoelastic_error": "friction_error"}
_COORDINATES = ("speed", "temperature", "load")
# Coordinates whose value needs no name.
_SPEAKING = ("material", "load", "temperature", "speed")
_TABLES = (".csv", ".txt", ".tsv")


@dataclass(frozen=True, eq=False)
class CaseTable:
    """Cases as rows."""

    name: str
    coordinates: tuple[str, ...]
    columns: dict[str, NDArray[Any]]  # coordinates and variables, SI
    units: dict[str, str]
    solved: Mask  # (n,)
    attributes: dict[Any, Any] = field(default_factory=dict)  # provenance

    @classmethod
    def of_group(cls, name: str, data: Dataset) -> CaseTable:
        """Return the cases of a group of results, of contacts over time their instants too."""
        if "instant" in data.dims:
            data = data.assign_coords(instant=np.arange(data.sizes["instant"]))
        columns = {str(one): over_all_dimensions(data, str(one)).ravel() for one in data.variables}
        places = [str(one) for one in data.coords] or [one for one in _COORDINATES if one in columns]
        units = {one: str(data[one].attrs.get("units", "1")) for one in columns}
        first = next(str(one) for one in data.data_vars if one not in places)
        return cls(name, tuple(places), columns, units, np.isfinite(columns[first]), dict(data.attrs))

    @classmethod
    def of_curves(cls, curves: FrictionCurves, name: str = "friction curves") -> CaseTable:
        """Return the points of friction curves, which have no provenance."""
        points = curves.points_dataset().reset_coords()[[*_COORDINATES, *_OF_CURVES]]
        return cls.of_group(name, points.rename(_OF_CURVES).drop_attrs(deep=False))

    def __len__(self) -> int:
        return len(self.solved)

    @property
    def accuracy(self) -> float | None:
        """Relative numerical accuracy, if stated."""
        accuracy = self.attributes.get("accuracy")
        return None if accuracy is None else float(accuracy)

    @property
    def per_length(self) -> bool:
        """Whether loads are per length."""
        return self.units.get("load") == "N/m"

    def varies(self, coordinate: str) -> bool:
        """Whether the cases differ in a coordinate."""
        return len(set(_keys(self.columns[coordinate]))) > 1

    def place(self, row: int) -> dict[str, float | str]:
        """Return the coordinates of a case."""
        return {name: self.columns[name][row].item() for name in self.coordinates}


def tables_of_file(path: str | Path) -> dict[str, CaseTable]:
    """Read results, each group a table, or a table of friction curves as their prediction."""
    if file_path(path).suffix.lower() not in _TABLES:
        return tables_of_tree(*open_tree(path))
    from viscofric.friction.curve_files import read_friction_curves

    return {PREDICTION: CaseTable.of_curves(read_friction_curves(path), str(path))}


def tables_of_tree(tree: DataTree, folder: Path) -> dict[str, CaseTable]:
    """Return the cases of results in a folder, by their group."""
    cases = cases_of(tree, folder)
    others = {name: child.to_dataset() for name, child in tree.children.items() if name in OTHER_CASES}
    others = {name: data.assign_attrs(accuracy=cases.attrs.get("accuracy")) for name, data in others.items()}
    return {name: CaseTable.of_group(str(folder), data) for name, data in ({PREDICTION: cases} | others).items()}


class Common(NamedTuple):
    """Common cases: their rows in both tables, and remarks about the axes."""

    first: Integers
    second: Integers
    remarks: tuple[str, ...]


def common_cases(one: CaseTable, other: CaseTable) -> Common:
    """Find the common cases of two tables; raise where there are none, or their coordinates do not match."""
    shared = [name for name in one.coordinates if name in other.coordinates]
    for name in shared:
        units = one.units.get(name, "1"), other.units.get(name, "1")
        if units[0] != units[1]:
            what = "contacts of different geometry cannot be compared." if name == "load" else "convert one of them."
            raise InputError(
                f"The {name} of {one.name} is in {units[0]}, that of {other.name} in {units[1]}: {what}",
                code="other-geometry" if name == "load" else "other-unit",
            )
    remarks = []
    for table, other_table in ((one, other), (other, one)):
        for name in table.coordinates:
            if name in shared:
                continue
            if table.varies(name):
                raise InputError(
                    f"{table.name} varies the {name}, which is not known of {other_table.name}: no case can be paired; "
                    "in place of an exported table, compare results.nc.",
                    code="no-common-cases",
                )
            value = shown(name, table.columns[name][0], table.per_length)
            remarks.append(f"{table.name} has a {name} ({value}), the other states none.")
    rows = []
    for table in (one, other):
        keys = list(zip(*(_keys(table.columns[name]) for name in shared), strict=True))
        found = {key: row for row, key in enumerate(keys)}
        if len(found) < len(keys):
            raise InputError(
                f"{table.name} contains cases with the same {', '.join(shared)} more than once.", code="repeated-cases"
            )
        rows.append(found)
    keys_of_both = [key for key in rows[0] if key in rows[1]]
    for number, name in enumerate(shared):
        here, there = ({key[number] for key in found} for found in rows)
        if here != there:
            more, less = sorted(here - there, key=str), sorted(there - here, key=str)
            examples = iter(_told_apart(name, [side[0] for side in (more, less) if side], one.per_length))
            parts = [
                f"{len(side)} only in {table.name} (such as {next(examples)})"
                for side, table in ((more, one), (less, other))
                if side
            ]
            remarks.append(f"The {name} has other values: {', '.join(parts)}; {len(here & there)} in common.")
    if not keys_of_both:
        raise InputError(
            f"{one.name} and {other.name} have no case in common. {' '.join(remarks)}", code="no-common-cases"
        )
    first, second = (np.array([found[key] for key in keys_of_both], dtype=np.int64) for found in rows)
    return Common(first, second, tuple(remarks))


def _told_apart(name: str, values: list[Any], line: bool) -> list[str]:
    """Return different values of a coordinate in words, with as many digits as tell them apart."""
    digits = 4
    while True:
        words = [shown(name, value, line, digits) for value in values]
        if len(set(words)) == len(words) or digits == _DIGITS:
            return words
        digits += 1


def _keys(column: NDArray[Any]) -> list[Any]:
    """Return values that are equal if coordinates agree apart from rounding."""
    if column.dtype.kind in "OUST":
        return [str(value) for value in column.tolist()]
    return [float(f"{value:.{_DIGITS - 1}e}") for value in column.tolist()]


def shown_place(place: dict[str, float | str], line: bool = False) -> str:
    """Return the coordinates of a case in words: "NBR, radius 10 mm, 25 N, 30 °C, 100 mm/s"; `line` as for `shown`."""
    return ", ".join(
        f"{'' if name in _SPEAKING else f'{name} '}{shown(name, value, line)}" for name, value in place.items()
    )
