"""Labelled results as columns: a row for each case, units with the names, and the provenance."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping
from typing import Any, TextIO

import numpy as np

from viscofric.datasets import Dataset, DataTree
from viscofric.notes import notes_in, table_in
from viscofric.study.cases.sweep import COORDINATES
from viscofric.study.results.file import DESCRIBED, rubbers_of
from viscofric.units import CELSIUS_ZERO

#: How a table of results begins, after its ``#``.
TITLE = "viscofric results"
# Of a temperature in degC; further digits are rounding of the sum with 273.15.
_DECIMALS = 9
# Attribute -> its name in the lines above a table.
_NAMED = {
    "data_origin": "data",
    **{name: name for name in DESCRIBED},
    "indenter": "indenter",
    "accuracy": "accuracy",
    "seed": "seed",
    "study_file": "run file",
    "viscofric_version": "viscofric",
    "created": "created",
}


def table_text(cases: Dataset) -> str:
    """Return the cases of results as a table: lines with ``#``, a line of headings, a row for each case."""
    text = io.StringIO()
    for name, said in about(cases.attrs):
        text.write(f"# {name}: {said}\n" if said else f"# {name}\n")
    write_columns(text, cases)
    return text.getvalue()


def write_columns(text: TextIO, dataset: Dataset) -> None:
    """Write a data set as a table: a line of headings with units, and a row for each point."""
    writer = csv.writer(text, lineterminator="\n")
    names, units, columns = columns_of(dataset)
    writer.writerow(name if unit == "1" else f"{name} ({unit})" for name, unit in zip(names, units, strict=True))
    writer.writerows(zip(*(map(written, column) for column in columns), strict=True))


def about(attributes: Mapping[Any, Any]) -> list[tuple[str, str]]:
    """Return the provenance of results, as pairs of name and text on one line."""
    found = [(TITLE, attributes.get("title", ""))]
    found += [(words, attributes[name]) for name, words in _NAMED.items() if name in attributes]
    hashes, software = (table_in(attributes, name).items() for name in ("input_hashes", "software"))
    found += [("input", f"{path} (SHA-256 {digest})") for path, digest in hashes]
    found += [("software", f"{name} {number}") for name, number in software]
    found += [("failed", note) for note in notes_in(attributes, "failures")]
    return [(name, " ".join(str(said).split())) for name, said in found]


def columns_of(dataset: Dataset) -> tuple[list[str], list[str], list[list[Any]]]:
    """Return names, units (degC, or K of differences) and values of columns, the last dimension running fastest."""
    known = [name for name in COORDINATES if name in dataset.coords]
    known += [str(name) for name in dataset.coords if name not in COORDINATES]
    # Coordinates of measured points are among the variables.
    places = [name for name in COORDINATES if name in dataset.data_vars]
    names = [*known, *places, *(str(name) for name in dataset.data_vars if name not in COORDINATES)]
    units, columns = [], []
    for name in names:
        variable = dataset[name]
        values, unit = over_all_dimensions(dataset, name), str(variable.attrs.get("units", "1"))
        if unit == "K" and name.startswith("temperature") and "rise" not in name:  # a difference stays as it is
            unit, values = "degC", np.round(values - CELSIUS_ZERO, _DECIMALS)
        units.append(unit)
        plain = values.ravel().tolist()
        columns.append([None if isinstance(one, float) and not np.isfinite(one) else one for one in plain])
    return names, units, columns


def over_all_dimensions(dataset: Dataset, name: str) -> Any:
    """Return the values of a variable over all dimensions of its data set, in their order."""
    return dataset[name].broadcast_like(dataset).transpose(*dataset.sizes).values


def written(value: Any) -> str:
    """Return a value as in a table: the shortest text that gives the same number, empty if missing."""
    return "" if value is None else repr(value) if isinstance(value, float) else str(value)


def tables(tree: DataTree) -> Iterator[tuple[str, Dataset]]:
    """Yield the tables of results other than the cases, with their names; of several materials, with the material's."""
    for name, group in _tables_of(tree):
        if name != "prediction":
            yield name, group
    if "materials" in tree.children:
        for called, branch in rubbers_of(tree).items():
            for name, group in _tables_of(branch):
                yield f"{called} {name}", group


def _tables_of(tree: DataTree) -> Iterator[tuple[str, Dataset]]:
    for name, node in tree.children.items():
        group = node.to_dataset()
        if not node.children and group.data_vars:
            yield str(name).replace("_", " "), group
