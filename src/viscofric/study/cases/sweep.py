"""The cases of a study: every combination of its axes, each one contact; and a case's position in words."""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from viscofric.contact.bodies import Layer
from viscofric.contact.solution import Meaning
from viscofric.units import plain, shown_celsius, shown_place, shown_speed

if TYPE_CHECKING:
    from viscofric.friction.cases.case import Case  # slow, and the first plot needs this module

Values: TypeAlias = tuple[float | str, ...]


#: Largest number of cases of a study.
MOST_CASES = 1_000_000
#: Axes of [conditions], in their order.
CONDITIONS = ("load", "pressure", "direction", "temperature", "speed")


class Coordinate(NamedTuple):
    """What a study may vary: unit and long name, the usual unit, what SI is divided by for it, and the symbol."""

    si: str
    words: str
    unit: str = ""
    scale: float = 1.0
    symbol: str = ""

    @property
    def meaning(self) -> Meaning:
        """Unit and long name."""
        return self.si, self.words

    @property
    def attributes(self) -> dict[str, str]:
        """Unit and long name as attributes of a data set."""
        return {"units": self.si, "long_name": self.words}


#: All coordinates of cases, in the order in which they are listed.
COORDINATES: dict[str, Coordinate] = {
    "material": Coordinate("1", "name of the material"),
    "sample": Coordinate("1", "number of the bootstrap sample of the material; 0 is the best estimate"),
    "radius": Coordinate("m", "radius of the indenter", "mm", 1e-3, "$R$"),
    "radius_x": Coordinate("m", "radius of curvature of the indenter along the motion", "mm", 1e-3),
    "radius_y": Coordinate("m", "radius of curvature of the indenter across the motion", "mm", 1e-3),
    "angle": Coordinate("rad", "angle between the cone's flank and the surface", "°", math.pi / 180.0),
    "seed": Coordinate("1", "seed of the generated rough surface"),
    "thickness": Coordinate("m", "thickness of the rubber", "mm", 1e-3, "$h$"),
    "load": Coordinate("N", "normal load", "N", 1.0, "$F$"),
    "pressure": Coordinate("Pa", "mean pressure", "kPa", 1e3),
    "direction": Coordinate("rad", "direction of the motion, from x towards y", "°", math.pi / 180.0),
    "temperature": Coordinate("K", "temperature", "°C"),
    "speed": Coordinate("m/s", "speed at which the rubber is deformed", "mm/s", 1e-3, "$v$"),
}
#: Those that only cases with heat, over time, or of impacts have.
OF_OTHERS = {
    "slip": Coordinate("m/s", "sliding velocity between both surfaces", "mm/s", 1e-3),
    "dwell": Coordinate("s", "time at rest under the load before the sliding", "s"),
    "impact_speed": Coordinate("m/s", "speed of the impact", "m/s"),
}
#: Those that vary along no curve of friction.
VARIED = tuple(name for name in COORDINATES if name not in ("temperature", "speed"))


@dataclass(frozen=True, eq=False)
class Axis:
    """One dimension of the results."""

    name: str  # one of `COORDINATES`; of several that vary together, joined: "load_radius"
    #: Coordinate → its values, one for each point of the axis, SI; names of materials, numbers of samples (0: the
    #: best estimate)
    columns: dict[str, Values]

    def __len__(self) -> int:
        return len(next(iter(self.columns.values())))


@dataclass(frozen=True, eq=False)
class Sweep:
    """All cases of a study."""

    axes: tuple[Axis, ...]  # in the order of `COORDINATES`; those with one point included
    cases: tuple[Case, ...]  # one for each combination of the axes' points; the last axis runs fastest

    @property
    def shape(self) -> tuple[int, ...]:
        """Points of each axis."""
        return tuple(map(len, self.axes))

    @property
    def geometry(self) -> str:
        """Geometry of all cases: "point", "line" or "rough"."""
        return self.cases[0].geometry if self.cases else "point"

    @property
    def dimensions(self) -> tuple[str, ...]:
        """Names of the axes."""
        return tuple(axis.name for axis in self.axes)


def body_of(tables: Mapping[str, Any]) -> Any:
    """Return the table [indenter] or [surface]; None if it is unknown."""
    return tables.get("indenter") or tables.get("surface")


def coordinates(tables: Mapping[str, Any]) -> dict[str, Values]:
    """Return all coordinates with their values, in the order of the axes, where the (valid) tables give them."""
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
    """Join the coordinates that vary together; the axis takes the position of its first coordinate."""
    group_of = {name: tuple(group) for group in together for name in group}
    groups = dict.fromkeys(group_of.get(name, (name,)) for name in known)
    return tuple(Axis("_".join(group), {name: known[name] for name in group}) for group in groups)


def count_cases(axes: Sequence[Axis]) -> int:
    """Return the number of combinations of the axes' points."""
    return math.prod(map(len, axes))


def sweep_of(tables: Mapping[str, Any]) -> Sweep:
    """Return all cases of the tables of a run file; see `Study.sweep`."""
    axes = axes_of(coordinates(tables), tables["sweep"].together)
    body, layer = body_of(tables), tables["layer"]
    # Cases with the same body or layer share one object.
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
    """Yield the coordinates of every case, the last axis running fastest; a material is given by its index."""
    columns = [axis.columns | ({"material": range(len(axis))} if "material" in axis.columns else {}) for axis in axes]
    names = [name for axis in columns for name in axis]
    for points in itertools.product(*(zip(*axis.values(), strict=True) for axis in columns)):
        yield dict(zip(names, itertools.chain.from_iterable(points), strict=True))


_RATE = ("temperature", "speed")


def shown(name: str, value: float | str, line: bool = False, digits: int = 4) -> str:
    """Return one value (SI) of a coordinate in its usual unit; `line`: load per length."""
    if isinstance(value, str):
        return value
    if name == "temperature":
        return f"{shown_celsius(value, f'z.{digits + 1}g')} °C"
    if name == "speed":
        return shown_speed(value, digits)
    if name == "load" and line:
        return f"{plain(value / 1e3, digits)} N/mm"
    about = COORDINATES.get(name) or OF_OTHERS.get(name) or Coordinate("1", name)
    if not about.unit:
        return f"{value:.{max(digits, 6)}g}"
    return f"{plain(value / about.scale, digits)}{'' if about.unit == '°' else ' '}{about.unit}"


def place(case: Case) -> str:
    """Return temperature and speed of a case in words."""
    return shown_place(case.temperature, case.speed)


def place_in(sweep: Sweep, number: int) -> str:
    """Return the position of a case of a sweep in words: temperature and speed, then all other axes."""
    return ", ".join([place(sweep.cases[number]), *others_in(sweep, number)])


def others_in(sweep: Sweep, number: int) -> list[str]:
    """Return the position of a case of a sweep in words, without temperature and speed."""
    case = sweep.cases[number]
    points = np.unravel_index(number, sweep.shape)
    return [
        words
        for axis, point in zip(sweep.axes, points, strict=True)
        if len(axis) > 1
        for words in _others(axis, int(point), case.geometry == "line")
    ]


def _others(axis: Axis, point: int, line: bool) -> list[str]:
    parts = []
    for name, values in axis.columns.items():
        if name in _RATE or (name == "sample" and values[point] == 0):
            continue
        words = shown(name, values[point], line)
        parts.append(words if name in ("material", "load") else f"{name.replace('_', ' ')} {words}")
    return parts
