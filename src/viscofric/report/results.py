"""Reading a study's results: groups that may be absent, attributes that a netCDF file stores as text, marked cases."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import wraps
from typing import Any, TypeVar

import numpy as np

from viscofric.arrays import Array, Integers, Mask
from viscofric.contact.steady import SMALL_STRAIN
from viscofric.datasets import Dataset, DataTree
from viscofric.nominal import parted
from viscofric.notes import from_json, notes_in

Found = TypeVar("Found")

#: Temperatures of results closer than this are shown as one, K.
SHOWN_AS_ONE = 0.5


def group(tree: DataTree, name: str) -> Dataset | None:
    """Return a group of the results, or None if it is absent or holds no values."""
    child = tree.children.get(name)
    if child is None:
        return None
    dataset = child.to_dataset()
    empty = not dataset.data_vars or any(size == 0 for size in dataset.sizes.values())
    return None if empty else dataset


def on_group(
    name: str, otherwise: Any = None
) -> Callable[[Callable[[Dataset, DataTree], Found]], Callable[[DataTree], Found]]:
    """Have a function of a tree begin with a group of it; where that is absent, the function gives `otherwise`."""

    def decorated(read: Callable[[Dataset, DataTree], Found]) -> Callable[[DataTree], Found]:
        @wraps(read)
        def of_tree(tree: DataTree) -> Found:
            found = group(tree, name)
            return otherwise if found is None else read(found, tree)

        return of_tree

    return decorated


def rubbers(tree: DataTree) -> list[tuple[str, DataTree]]:
    """Return the results of each of several rubbers, by name, as a tree like the whole; else empty."""
    if "materials" not in tree.children:
        return []
    from viscofric.study.results.file import rubbers_of

    found = []
    for name, branch in rubbers_of(tree).items():
        branch = branch.copy(deep=False)
        branch.attrs = {shared: tree.attrs[shared] for shared in _SHARED if shared in tree.attrs} | branch.attrs
        found.append((name, branch))
    return found


_SHARED = ("data_origin", "accuracy", "load", "poisson_ratio", "indenter_radius")


def number(attributes: Mapping[Any, Any], name: str) -> float:
    """Return an attribute as a float, nan if it is absent or not a number."""
    try:
        return float(attributes.get(name, math.nan))
    except (TypeError, ValueError):
        return math.nan


def numbers(attributes: Mapping[Any, Any], name: str) -> list[float]:
    """Return an attribute that is a list of numbers, written as JSON or as an array; empty if it is absent."""
    try:
        return [float(value) for value in np.ravel(from_json(attributes.get(name, [])))]
    except (TypeError, ValueError):
        return []


def sentences(attributes: Mapping[Any, Any], name: str) -> list[str]:
    """Return an attribute that is a list of sentences, written as JSON or as a list."""
    return [str(note) for note in notes_in(attributes, name)]


def is_synthetic(tree: DataTree) -> bool:
    """Whether the results rest on synthetic data; what does not say that it was measured is not believed."""
    return str(tree.attrs.get("data_origin", "synthetic")) != "measured"


def is_rough(tree: DataTree) -> bool:
    """Whether the contacts are those of a rough surface, which have no axis, no edges and no indentation."""
    prediction = tree.children.get("prediction")
    return prediction is not None and "contact_area_fraction" in prediction.data_vars


def is_from_friction(tree: DataTree) -> bool:
    """Whether the rubber was identified from friction, and not from a modulus that was measured."""
    return int(tree.attrs.get("identified_from_friction", 0)) == 1


def values(dataset: Dataset, name: str) -> Array:
    """Return a variable as floats, nan throughout if it is absent."""
    if name in dataset.variables:
        return np.asarray(dataset[name].values, dtype=float)
    return np.full(tuple(dataset.sizes.values()), np.nan)


def nominal_temperatures(*temperatures: Array) -> Array:
    """Return the different temperatures among columns, K, ascending: means of those that are close."""
    together: Array = np.concatenate([np.ravel(column) for column in temperatures])
    together = together[np.isfinite(together)]
    return np.array([together[rows].mean() for rows in parted(together, SHOWN_AS_ONE)])


def nearest(nominal: Array, temperature: Array) -> Integers:
    """Return, for each temperature, the index of the nominal one nearest to it."""
    return np.asarray(np.abs(np.asarray(temperature)[:, None] - nominal[None, :]).argmin(axis=1))


def reference_temperature(tree: DataTree) -> float | None:
    """Temperature at which the shift factor is one, K, or None if the results do not say."""
    factors = group(tree, "shift_factors")
    found = number(tree.attrs if factors is None else factors.attrs, "reference_temperature")
    return found if math.isfinite(found) else None


# Numerical error, as part of friction, up to which lines and three digits hide it.
_HIDDEN_ERROR = 0.01
WIDE, EXTRAPOLATED = "wide contact", "extrapolated"


def reach(tree: DataTree, cases: Dataset) -> Array:
    """Return how far each contact reaches from the indenter's axis, over its radius; nan if not known."""
    radius = values(cases, "radius") if "radius" in cases.variables else number(tree.attrs, "indenter_radius")
    sides = np.array([values(cases, name) for name in ("front", "rear", "half_width")])
    farthest: Array = np.where(np.isfinite(sides), sides, -np.inf).max(axis=0)
    return np.asarray(np.where(farthest > 0.0, farthest, np.nan) / radius)


def is_wide(tree: DataTree, cases: Dataset) -> Mask:
    """Whether each contact is too wide for small strain; not where its size is not known."""
    return np.asarray(reach(tree, cases) > SMALL_STRAIN)


def is_extrapolated(cases: Dataset) -> Mask:
    """Whether each case rests on frequencies that were not measured; not where it was not solved."""
    names = "predicted", "friction_coefficient", "viscoelastic"
    friction = next((name for name in names if name in cases.variables), names[0])
    return np.asarray((values(cases, "within_measured_frequencies") == 0.0) & np.isfinite(values(cases, friction)))


def remarks(tree: DataTree, cases: Dataset) -> list[tuple[str, ...]]:
    """Return what is doubtful about each case, in a word or two; nothing about sound ones."""
    marks = [(WIDE, is_wide(tree, cases)), (EXTRAPOLATED, is_extrapolated(cases))]
    return [tuple(word for word, mask in marks if mask[row]) for row in range(len(marks[0][1]))]


def shown_error(friction: Array, error: Array) -> Array:
    """Return the numerical error of friction where it is more than figures and short tables hide; NaN elsewhere."""
    return np.where(error > _HIDDEN_ERROR * np.abs(friction), error, np.nan)


def interpolated(cases: Dataset) -> Mask:
    """Whether each case was interpolated on a curve of solved ones, instead of solved itself."""
    return np.asarray(values(cases, "interpolated") == 1.0)
