"""The axes of a study's results: which vary, what their points are called, and all cases one below the other."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.datasets import Dataset, DataTree
from viscofric.report.results import group
from viscofric.report.texts.numbers import degrees, short
from viscofric.rheology.uncertainty.sampling import FEWEST_SAMPLES
from viscofric.study.cases.sweep import COORDINATES, shown

#: Dimension of results that are listed case by case.
CASE = "case"
#: Dimension of the members of a material's posterior.
SAMPLE = "sample"
#: Dimension of the made surfaces that differ by chance alone.
SEED = "seed"
#: Most lines in one panel, and most panels in one figure: more are not read.
MOST_LINES, MOST_PANELS = 8, 9

_SPEED, _TEMPERATURE = "speed", "temperature"


@dataclass(frozen=True, eq=False)
class SweepAxis:
    """One dimension of the results that has more than one point."""

    name: str  # of the dimension
    columns: tuple[str, ...]  # coordinates along it; several where they are varied together
    title: str  # What it is called: "temperature", "load and radius"
    labels: tuple[str, ...]  # What each point is called: "30 °C", "25 N, 10 mm"
    position: Array  # (n,): places of the points on a figure's axis, in the unit of `axis_label`
    axis_label: str  # label of a figure's axis along it
    is_ordered: bool  # whether its points are numbers

    def __len__(self) -> int:
        return len(self.labels)

    @property
    def is_logarithmic(self) -> bool:
        """Whether a figure's axis along it should be logarithmic: it spans more than a factor of five."""
        if self.name == _TEMPERATURE or not self.is_ordered:
            return False
        return self.name == _SPEED or bool(
            self.position.min() > 0.0 and self.position.max() > 5.0 * self.position.min()
        )


def sweep_axes(dataset: Dataset) -> list[SweepAxis]:
    """Return the dimensions of labelled results that have more than one point, samples of the rubber left out."""
    return [axis_of(dataset, str(name)) for name, size in dataset.sizes.items() if size > 1 and name != SAMPLE]


def axis_of(dataset: Dataset, dimension: str) -> SweepAxis:
    """Return one dimension of labelled results."""
    along = [str(name) for name, part in dataset.coords.items() if part.dims == (dimension,)]
    columns = [name for name in along if not _is_index(dataset, name, dimension, along)] or along
    if not columns:
        count = dataset.sizes[dimension]
        labels = tuple(f"{dimension} {number + 1}" for number in range(count))
        return SweepAxis(dimension, (), dimension, labels, np.arange(count, dtype=float), dimension, False)
    columns_of_labels = [[value_label(dataset, name, value) for value in dataset[name].values] for name in columns]
    numeric = [name for name in columns if np.issubdtype(dataset[name].dtype, np.number)]
    first = numeric[0] if numeric else columns[0]
    position = on_axis(first, dataset[first].values) if numeric else np.arange(dataset.sizes[dimension], dtype=float)
    others = " and ".join(_spoken(name) for name in columns if name != first)
    return SweepAxis(
        dimension,
        tuple(columns),
        " and ".join(_spoken(name) for name in columns),
        tuple(", ".join(row) for row in zip(*columns_of_labels, strict=True)),
        position,
        axis_label(dataset, first) + (f", with {others}" if others else ""),
        bool(numeric),
    )


def _is_index(dataset: Dataset, name: str, dimension: str, along: list[str]) -> bool:
    """Whether a coordinate merely counts the points of a dimension that has others to be named by."""
    return name == dimension and len(along) > 1 and name not in COORDINATES


def _spoken(name: str) -> str:
    return name.replace("_", " ")


def on_axis(name: str, numbers: object) -> Array:
    """Return SI numbers of a coordinate in the unit of a figure's axis."""
    numbers = np.asarray(numbers, dtype=float)
    if name == _TEMPERATURE:
        return numbers - 273.15
    return numbers / COORDINATES[name].scale if name in COORDINATES else numbers


def axis_label(dataset: Dataset, name: str) -> str:
    """Return the label of a figure's axis along a coordinate."""
    about, unit = COORDINATES.get(name), str(dataset[name].attrs.get("units", ""))
    if about is not None and name != "load":  # of a line contact, per length
        unit = about.unit
    named = f"{_spoken(name)} {about.symbol}" if about and about.symbol else _spoken(name)
    return f"{named} ({unit})" if unit and unit != "1" else named


def value_label(dataset: Dataset, name: str, value: object) -> str:
    """Return one value of a coordinate in words: 30 °C, 20 mm/s, 25 N, NBR 70, seed 3."""
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        return str(value)
    if not np.isfinite(number):
        return f"no {_spoken(name)}"
    if name == _TEMPERATURE:
        return degrees(number)
    unit = str(dataset[name].attrs.get("units", ""))
    if name in COORDINATES and COORDINATES[name].unit:
        return shown(name, number, unit == "N/m")
    return f"{_spoken(name)} {short(number)}" if unit in ("", "1") else f"{short(number)} {unit}"


def cases_of(dataset: Dataset) -> Dataset:
    """Return labelled results along `case`, the last dimension (samples too) running fastest."""
    if CASE in dataset.dims:
        return dataset
    if not dataset.dims:
        return dataset.reset_coords().expand_dims(CASE)
    whole = dataset.reset_coords().broadcast_like(dataset)
    return whole.stack({CASE: list(dataset.dims)}, create_index=False).reset_coords().drop_vars(CASE, errors="ignore")


def best_estimate(dataset: Dataset) -> Dataset:
    """Return results of the best estimate of the rubber alone, without those of its samples."""
    if SAMPLE not in dataset.dims:
        return dataset
    return dataset.isel({SAMPLE: int(np.argmin(dataset[SAMPLE].values)) if SAMPLE in dataset.coords else 0})


def band_of_samples(values: Array) -> Array:
    """Return the ends (2, …) of the central 95 % of solved samples along the first axis; of few, of all of them."""
    few = np.isfinite(values).sum(axis=0) <= FEWEST_SAMPLES
    lowest, low, high, highest = np.nanquantile(values, [0.0, 0.025, 0.975, 1.0], axis=0)
    return np.stack([np.where(few, lowest, low), np.where(few, highest, high)])


def words_of_band(data: Dataset, name: str) -> str:
    """Return what `band_of_samples` of a variable holds."""
    solved = np.isfinite(data[name].transpose(SAMPLE, ...).values).sum(axis=0)
    few = solved[solved > 0] <= FEWEST_SAMPLES
    if few.all():
        return "range"
    return f"95 % (range where {FEWEST_SAMPLES} or fewer were solved)" if few.any() else "95 %"


def solved_cases(tree: DataTree, name: str = "prediction") -> Dataset | None:
    """Return the solved cases of a group, in a row, with the best estimate of the rubber; None without any."""
    found = group(tree, name)
    if found is None or "friction_coefficient" not in found:
        return None
    cases = cases_of(best_estimate(found))
    solved = np.isfinite(np.asarray(cases["friction_coefficient"].values, dtype=float))
    return cases.isel({CASE: np.flatnonzero(solved)}) if solved.any() else None


def predicted_axes(tree: DataTree) -> list[SweepAxis]:
    """Return the axes along which friction was predicted at more than one point."""
    friction = group(tree, "prediction")
    return [] if friction is None else sweep_axes(friction)


def has_curves_only(tree: DataTree) -> bool:
    """Whether curves over the speed, one for each temperature, are all that was predicted."""
    names = {axis.name for axis in predicted_axes(tree)}
    return _SPEED in names <= {_SPEED, _TEMPERATURE} and SAMPLE not in tree["prediction"].dims


def over_seeds(cases: Dataset) -> Dataset:
    """Return the means over the seeds of a surface, with the 95 % interval of the mean friction instead of its band.

    Estimated errors are the largest of the seeds; what holds of a case must hold on every seed.  Cases without several
    seeds are returned as they are.
    """
    if SEED not in cases or len(np.unique(cases[SEED].values)) < 2:
        return cases
    from viscofric.roughness.rough_friction import interval_of_mean

    named = [name for name in COORDINATES if name in cases and name != SEED]
    keys = list(zip(*(cases[name].values.tolist() for name in named), strict=True))
    alike: defaultdict[tuple[Any, ...], list[int]] = defaultdict(list)
    for row, key in enumerate(keys):
        alike[key].append(row)
    rows = list(alike.values())
    friction = np.asarray(cases["friction_coefficient"].values, dtype=float)
    each = [friction[one][np.isfinite(friction[one])] for one in rows]
    ends = np.array([interval_of_mean(one) if len(one) > 1 else (np.nan, np.nan) for one in each])
    found = cases.isel({CASE: [one[0] for one in rows]}).drop_vars(SEED)
    for name, variable in cases.data_vars.items():
        if name == SEED or name in named or variable.dtype.kind not in "fiub" or variable.dims != (CASE,):
            continue
        values = np.asarray(variable.values, dtype=float)
        merge = _MERGED.get(str(name), np.mean)
        merged = [merge(known) if (known := values[one][np.isfinite(values[one])]).size else np.nan for one in rows]
        found[name] = (CASE, np.array(merged, dtype=float), variable.attrs)
    limits = {name: (CASE, ends[:, side]) for side, name in enumerate(("friction_lower", "friction_upper"))}
    return found.assign(limits | {"seeds": (CASE, np.array([float(len(one)) for one in each]))})


# Variable -> what is shown of it over several seeds; the mean of others.
_MERGED: dict[str, Any] = {
    "friction_error": np.max,
    "complementarity": np.max,
    "energy_balance": lambda found: found[np.argmax(np.abs(found))],
    "cells": np.max,
    "failed": np.min,
    "interpolated": np.min,
    "within_measured_frequencies": np.min,
}


def seeds_averaged(dataset: Dataset) -> int:
    """Return over how many seeds of a surface figures show the mean: none where nothing else varies."""
    count = dataset.sizes.get(SEED, 1)
    return count if count > 1 and len(sweep_axes(dataset)) > 1 else 0


@dataclass(frozen=True, eq=False)
class Layout:
    """How a sweep is drawn: what runs along the axis, what becomes lines, what becomes panels."""

    along: SweepAxis
    lines: SweepAxis | None
    panels: tuple[SweepAxis, ...]


def layout_of(dataset: Dataset) -> Layout | None:
    """Return how a sweep is drawn, or None where nothing varies.

    Speed runs along the axis, temperature becomes lines, all else panels; without a speed or a temperature that varies
    others take their places, the one with the most points first.  Seeds of a surface have no place where anything else
    varies: the mean over them is drawn.
    """
    left = {axis.name: axis for axis in sweep_axes(dataset)}
    if len(left) > 1:
        left.pop(SEED, None)
    if not left:
        return None
    ordered = sorted((axis for axis in left.values() if axis.is_ordered), key=len, reverse=True)
    along = left.get(_SPEED) or (ordered[0] if ordered else next(iter(left.values())))
    del left[along.name]
    rest = sorted(left.values(), key=len, reverse=True)
    lines = left.get(_TEMPERATURE) or (rest[0] if rest else None)
    if lines is not None:
        del left[lines.name]
    return Layout(along, lines, tuple(left.values()))


def thinned(count: int, most: int) -> list[int]:
    """Return at most so many of a row's places, both ends among them, evenly spread."""
    if count <= most:
        return list(range(count))
    return sorted({round(place) for place in np.linspace(0, count - 1, most).tolist()})
