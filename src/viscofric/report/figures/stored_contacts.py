"""Contacts whose fields the results keep: which of them are shown."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from viscofric.datasets import Dataset, DataTree
from viscofric.report.figures.contacts import Contact
from viscofric.report.results import group, values
from viscofric.report.sweeps import SEED, solved_cases, value_label
from viscofric.study.cases.sweep import COORDINATES

FIELDS = "fields"
_SAME = 1e-9  # relative


class Shown(NamedTuple):
    """A contact with the conditions that it was solved at, and its friction coefficient (SI, by name)."""

    contact: Contact
    conditions: dict[str, Any]


def shown_contacts(tree: DataTree) -> list[Shown]:
    """Return the slowest contact, that of the most friction and the fastest, of those whose fields are kept."""
    cases = solved_cases(tree)
    found = _kept(tree, cases)
    if not found:
        return []
    speed, friction = (
        np.array([conditions[name] for _, conditions in found]) for name in ("speed", "friction_coefficient")
    )
    titles: dict[int, list[str]] = {int(np.argmin(speed)): ["slowest"]}
    if np.isfinite(friction).any():
        most = int(np.nanargmax(friction))
        highest = cases is None or friction[most] >= np.nanmax(values(cases, "friction_coefficient"))
        titles.setdefault(most, []).append("most friction" if highest else "most friction of those shown")
    titles.setdefault(int(np.argmax(speed)), []).append("fastest")
    order = sorted(titles, key=lambda index: speed[index])
    prediction, named = group(tree, "prediction"), _varied(found)
    if prediction is not None and SEED in prediction.dims:  # also where all kept fields are of one seed
        named.add(SEED)
    return [
        Shown(_contact(*found[index], ", ".join(titles[index]) if len(found) > 1 else "", named), found[index][1])
        for index in order
    ]


def _kept(tree: DataTree, cases: Dataset | None) -> list[tuple[Dataset, dict[str, Any]]]:
    """Return the fields that the results keep, each with the conditions of its case and its friction."""
    if FIELDS not in tree.children:
        return []
    kept = []
    for child in tree.children[FIELDS].children.values():
        fields = child.to_dataset()
        if "y" not in fields.dims:  # a line contact
            fields = fields.expand_dims(y=[0.0], axis=1)
        conditions = {name: fields[name].item() for name in COORDINATES if name in fields.coords}
        if "mean_pressure" in fields.coords:  # of a rough surface: `pressure` is the field
            conditions["pressure"] = fields["mean_pressure"].item()
        conditions["friction_coefficient"] = math.nan if cases is None else _friction_of(cases, conditions)
        kept.append((fields, conditions))
    return kept


def _friction_of(cases: Dataset, conditions: dict[str, Any]) -> float:
    """Return the friction coefficient of the case with these conditions, NaN if there is none."""
    same = np.ones(cases.sizes["case"], dtype=bool)
    for name, value in conditions.items():
        if name in cases.variables and cases[name].dims == ("case",):
            column = cases[name].values
            same &= column == value if isinstance(value, str) else np.isclose(column, value, rtol=_SAME, atol=0.0)
    rows = np.flatnonzero(same)
    return float(values(cases, "friction_coefficient")[rows[0]]) if rows.size else math.nan


def _varied(found: list[tuple[Dataset, dict[str, Any]]]) -> set[str]:
    """Return which conditions differ among the contacts, and those that are always listed."""
    differ = {name for name in COORDINATES if len({str(conditions.get(name)) for _, conditions in found}) > 1}
    return differ | {"temperature", "speed"}


def _contact(fields: Dataset, conditions: dict[str, Any], title: str, named: set[str]) -> Contact:
    words = [
        value_label(fields, name, conditions[name]) for name in COORDINATES if name in conditions and name in named
    ]
    x, y = (fields[name].values.astype(float) for name in ("x", "y"))
    pressure = fields["pressure"].transpose("x", "y").values.astype(float)
    return Contact(title, ", ".join(words), conditions["friction_coefficient"], x, y, pressure)
