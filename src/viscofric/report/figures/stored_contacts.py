"""Contacts whose fields the results keep: which of them are shown, and the surface behind them."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from viscofric.arrays import Array, centre_line
from viscofric.datasets import Dataset, DataTree
from viscofric.errors import InputError
from viscofric.report.figures.contacts import Contact
from viscofric.report.results import group, number, values
from viscofric.report.sweeps import SEED, VARIED, solved_cases, value_label
from viscofric.rheology.shifts.shift_factors import ShiftFactors

FIELDS = "fields"
#: Coordinates of a case, in the order in which they are listed.
_CONDITIONS = (*VARIED, "temperature", "speed")
#: How far behind and ahead of the contact a trail is looked at, over the contact's length.
_TRAIL = 2.5
_FEWEST_CELLS = 64  # along an edge, of the pressure that a trail is calculated from
_SAME = 1e-9  # relative


class Shown(NamedTuple):
    """A contact with the conditions that it was solved at, and its friction coefficient (SI, by name)."""

    contact: Contact
    conditions: dict[str, Any]


def shown_contacts(tree: DataTree) -> list[Shown]:
    """Return the slowest contact, that of the most friction and the fastest, of those whose fields are kept."""
    found = _kept(tree)
    if not found:
        return []
    speed, friction = (
        np.array([conditions[name] for _, conditions in found]) for name in ("speed", "friction_coefficient")
    )
    titles: dict[int, list[str]] = {int(np.argmin(speed)): ["slowest"]}
    if np.isfinite(friction).any():
        titles.setdefault(int(np.nanargmax(friction)), []).append("most friction")
    titles.setdefault(int(np.argmax(speed)), []).append("fastest")
    order = sorted(titles, key=lambda index: speed[index])
    prediction, named = group(tree, "prediction"), _varied(found)
    if prediction is not None and SEED in prediction.dims:  # also where all kept fields are of one seed
        named.add(SEED)
    return [
        Shown(_contact(*found[index], ", ".join(titles[index]) if len(found) > 1 else "", named), found[index][1])
        for index in order
    ]


def _kept(tree: DataTree) -> list[tuple[Dataset, dict[str, Any]]]:
    """Return the fields that the results keep, each with the conditions of its case and its friction."""
    if FIELDS not in tree.children:
        return []
    kept = []
    cases = solved_cases(tree)
    for child in tree.children[FIELDS].children.values():
        fields = child.to_dataset()
        if "y" not in fields.dims:  # a line contact
            fields = fields.expand_dims(y=[0.0], axis=1)
        conditions = {name: fields[name].item() for name in _CONDITIONS if name in fields.coords}
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
    differ = {name for name in _CONDITIONS if len({str(conditions.get(name)) for _, conditions in found}) > 1}
    return differ | {"temperature", "speed"}


def _contact(fields: Dataset, conditions: dict[str, Any], title: str, named: set[str]) -> Contact:
    words = [
        value_label(fields, name, conditions[name]) for name in _CONDITIONS if name in conditions and name in named
    ]
    x, y = (fields[name].values.astype(float) for name in ("x", "y"))
    pressure, displacement = (
        fields[name].transpose("x", "y").values.astype(float) for name in ("pressure", "displacement")
    )
    return Contact(title, ", ".join(words), conditions["friction_coefficient"], x, y, pressure, displacement)


def trails(tree: DataTree, shown: list[Shown]) -> list[tuple[Array, Array]]:
    """Return the surface on each centre line, from well behind the contact to well ahead: place (m), displacement (m).

    The kept pressure is convolved with the moving half-space; of layers, of several rubbers, and of rubbers that the
    results do not describe, it is that within the kept fields only.
    """
    found = [_calculated_trail(tree, contact, conditions) for contact, conditions in shown]
    if any(trail is None for trail in found):
        found = [(contact.x, centre_line(contact.y, contact.displacement)) for contact, _ in shown]
    return [trail for trail in found if trail is not None]


def _calculated_trail(tree: DataTree, contact: Contact, conditions: dict[str, Any]) -> tuple[Array, Array] | None:
    spectrum, poisson_ratio = group(tree, "spectrum"), number(tree.attrs, "poisson_ratio")
    if spectrum is None or spectrum["retardation_time"].ndim != 1 or not math.isfinite(poisson_ratio):
        return None
    if np.isfinite(conditions.get("thickness", math.nan)) or "material" in conditions:
        return None
    try:
        alpha = _shift_factor(tree, conditions["temperature"])
    except InputError:
        return None
    return None if alpha is None else _trail(contact, alpha * conditions["speed"], spectrum, poisson_ratio)


def _trail(contact: Contact, reduced_speed: float, spectrum: Dataset, poisson_ratio: float) -> tuple[Array, Array]:
    from viscofric.contact.fields.surface import surface_displacement

    x, y, pressure = _merged(contact)
    rear, front = contact.edges
    far = _TRAIL * (front - rear)
    surface = surface_displacement(
        x,
        y,
        pressure,
        speed=reduced_speed,
        E_inf=number(spectrum.attrs, "E_inf"),
        C=values(spectrum, "creep_coefficient"),
        tau=values(spectrum, "retardation_time"),
        poisson_ratio=poisson_ratio,
        behind=far,
        ahead=far,
    )
    middle = np.flatnonzero(np.isclose(np.abs(surface.y), np.abs(surface.y).min(), rtol=1e-6))
    return surface.x, surface.displacement[:, middle].mean(axis=1)


def _merged(contact: Contact) -> tuple[Array, Array, Array]:
    """Return a point contact's pressure in larger cells, of which it keeps the load."""
    x, y, pressure = contact.x, contact.y, contact.pressure
    every = 1 if contact.is_line else max(1, min(pressure.shape) // _FEWEST_CELLS)
    # A cell on the axis, of an odd number of them, stays there where nothing is merged.
    if every == 1 or any(size % every for size in pressure.shape):
        return x, y, pressure
    rows, columns = (size // every for size in pressure.shape)
    merged = pressure.reshape(rows, every, columns, every).mean(axis=(1, 3))
    return x.reshape(rows, every).mean(axis=1), y.reshape(columns, every).mean(axis=1), merged


def _shift_factor(tree: DataTree, kelvin: float) -> float | None:
    """Return α(T) as the study took it, None where the results do not contain it."""
    from viscofric.report.data import law_of

    factors, law = group(tree, "shift_factors"), law_of(group(tree, "shift_law"))
    if factors is not None and "log10_vertical_shift" in factors:
        return None
    if factors is not None and str(factors.attrs.get("shift_used", "measured")) == "measured":
        return float(10.0 ** _measured(factors).log10(kelvin))
    return None if law is None else float(10.0 ** law.log10(kelvin))


def _measured(factors: Dataset) -> ShiftFactors:
    from viscofric.report.data import shift_table

    table = shift_table(factors)
    return ShiftFactors(table.temperature, table.log10, table.reference)
