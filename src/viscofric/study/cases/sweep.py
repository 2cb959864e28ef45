"""The cases of a study: every combination of its axes, each one contact; and a case's position in words."""

from __future__ import annotations

import functools
import itertools
import math
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from viscofric.contact.bodies import Layer
from viscofric.units import celsius, plain, told_speed

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from viscofric.study.cases.case import Case

    Values: TypeAlias = tuple[float | str, ...]


#: A study asks for as many cases at most.
MOST_CASES = 1_000_000
#: Axes of [conditions], in their order, as far as they are given.
CONDITIONS = ("load", "pressure", "direction", "temperature", "speed")


@dataclass(frozen=True, eq=False)
class Axis:
    """One dimension of the results.

    Parameters
    ----------
    name : str
        "material", "sample", "radius" ("radius_x", "radius_y", "angle"), "seed", "thickness", "load", "pressure",
        "direction", "temperature" or "speed"; of several that are stepped together, joined: "load_radius".
    columns : dict of str to tuple
        Each coordinate's values, one for each point of the axis, SI; names of materials, numbers of samples (0: the
        best estimate).
    """

    name: str
    columns: dict[str, Values]

    def __len__(self) -> int:
        return len(next(iter(self.columns.values())))


@dataclass(frozen=True, eq=False)
class Sweep:
    """All cases of a study.

    Parameters
    ----------
    axes : tuple of Axis
        In the order material, sample, shape of the indenter or seed of the surface, thickness, load or pressure,
        direction, temperature, speed; those of one point included.
    cases : tuple of Case
        One for each combination of the axes' points; the last axis runs fastest.
    """

    axes: tuple[Axis, ...]
    cases: tuple[Case, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Points of each axis."""
        return tuple(map(len, self.axes))

    @property
    def geometry(self) -> str:
        """What touches in all cases: "point", "line" or "rough"."""
        return self.cases[0].geometry if self.cases else "point"

    @property
    def dimensions(self) -> tuple[str, ...]:
        """Names of the axes."""
        return tuple(axis.name for axis in self.axes)


def body_of(tables: Mapping[str, Any]) -> Any:
    """Return the table of what slides over the rubber; None where that is not known."""
    return tables.get("indenter") or tables.get("surface")


def coordinates(tables: Mapping[str, Any]) -> dict[str, Values]:
    """Return all that a study may vary, each with its values, in the order of the axes, as far as the tables give it.

    Parameters
    ----------
    tables : mapping
        Those of a run file by their keys, without those that cannot be read.
    """
    known: dict[str, Values] = {}
    if "material" in tables:
        known["material"] = tuple(material.name for material in tables["material"])
    if "uncertainty" in tables:
        known["sample"] = tuple(range(tables["uncertainty"].members + 1))
    body = body_of(tables)
    if body is not None:
        known |= body.axes
    if tables.get("layer") is not None:
        known["thickness"] = tables["layer"].thickness
    if "conditions" in tables:
        given = {name: getattr(tables["conditions"], name) for name in CONDITIONS}
        known |= {name: values for name, values in given.items() if values}
    return known


def axes_of(known: Mapping[str, Values], together: Sequence[Sequence[str]]) -> tuple[Axis, ...]:
    """Join the coordinates that are stepped together; such an axis stands where its first coordinate would."""
    group_of = {name: tuple(group) for group in together for name in group}
    groups = dict.fromkeys(group_of.get(name, (name,)) for name in known)
    return tuple(Axis("_".join(group), {name: known[name] for name in group}) for group in groups)


def count_cases(axes: Sequence[Axis]) -> int:
    """Return how many cases all combinations of the axes' points make."""
    return math.prod(map(len, axes))


def sweep_of(tables: Mapping[str, Any]) -> Sweep:
    """Return all cases that the tables of a run file ask for; see `Study.sweep`."""
    axes = axes_of(coordinates(tables), tables["sweep"].together)
    body, layer = body_of(tables), tables["layer"]
    # Cases that have a body or a layer in common have the same one.
    made = functools.cache(body.made)
    layered = functools.cache(partial(Layer, bonded=layer is None or layer.base == "bonded"))

    def case(place: dict[str, Any]) -> Case:
        return body.CASE(  # type: ignore[no-any-return]
            place["material"],
            made(*(place[name] for name in body.axes)),
            place["temperature"],
            place["speed"],
            *(float(place.get(name, 0.0)) for name in body.CONDITIONS),
            None if layer is None else layered(place["thickness"]),
            body.modulus,
            body.poisson_ratio,
            place["sample"] or None,
        )

    return Sweep(axes, tuple(map(case, _places(axes))))


def _places(axes: Sequence[Axis]) -> Iterator[dict[str, Any]]:
    """Yield the coordinates of every case, the last axis running fastest; a material's is its number."""
    columns = [axis.columns | ({"material": range(len(axis))} if "material" in axis.columns else {}) for axis in axes]
    names = [name for axis in columns for name in axis]
    for points in itertools.product(*(zip(*axis.values(), strict=True) for axis in columns)):
        yield dict(zip(names, itertools.chain.from_iterable(points), strict=True))


_RATE = ("temperature", "speed")
_COUNTED = ("sample", "seed")


def shown(name: str, value: float | str, line: bool = False) -> str:
    """Return one value of an axis in the unit that people use for it.

    Parameters
    ----------
    name : str
        Of the coordinate.
    value : float or str
        SI.
    line : bool
        Whether the contact is one along a line, and the load per length.
    """
    if isinstance(value, str):
        return value
    if name == "temperature":
        return f"{plain(celsius(value), 5)} °C"
    if name in ("angle", "direction"):
        return f"{plain(math.degrees(value))}°"
    if name == "pressure":
        return f"{plain(value / 1e3)} kPa"
    if name == "load":
        return f"{plain(value / 1e3)} N/mm" if line else f"{plain(value)} N"
    if name == "speed":
        return told_speed(value)
    return f"{value:g}" if name in _COUNTED else f"{plain(1e3 * value)} mm"


def place(case: Case) -> str:
    """Say at which temperature and speed a case lies."""
    return f"{plain(celsius(case.temperature))} °C, {told_speed(case.speed)}"


def place_in(sweep: Sweep, number: int) -> str:
    """Say where a case of a sweep lies: its temperature and speed, and its place on every other axis."""
    return ", ".join([place(sweep.cases[number]), *others_in(sweep, number)])


def others_in(sweep: Sweep, number: int) -> list[str]:
    """Say where a case of a sweep lies on every axis but those of temperature and speed."""
    case = sweep.cases[number]
    points = np.unravel_index(number, sweep.shape)
    return [
        words
        for axis, point in zip(sweep.axes, points, strict=True)
        if len(axis) > 1
        for words in _others(axis, int(point), case.geometry == "line")
    ]


def _others(axis: Axis, point: int, line: bool) -> list[str]:
    told = []
    for name, values in axis.columns.items():
        if name in _RATE or (name == "sample" and values[point] == 0):
            continue
        words = shown(name, values[point], line)
        told.append(words if name in ("material", "load") else f"{name.replace('_', ' ')} {words}")
    return told
