"""The cases of a study: every combination of its axes, each one contact."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from viscofric.contact.layers import Layer

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.study.surface_source import SurfaceSource

    Values: TypeAlias = tuple[float | str, ...]

#: A study asks for as many cases at most.
MOST_CASES = 1_000_000
#: Axes of [conditions], in their order, as far as they are given.
CONDITIONS = ("load", "pressure", "direction", "temperature", "speed")


@dataclass(frozen=True, slots=True)
class Case:
    """One contact, SI.

    Parameters
    ----------
    material : int
        Its number in `Study.materials`, from 0.
    indenter : Indenter
        Ball, Cylinder, Ellipsoid or Cone.
    temperature : float
        K.
    speed : float
        m/s.
    load : float
        N; N/m for a cylinder.
    layer : Layer, optional
        A half-space without.
    indenter_modulus : float, optional
        Young's modulus of an elastic indenter, Pa; rigid without.
    indenter_poisson_ratio : float
        Of an elastic indenter.
    sample : int, optional
        Member of the material's posterior that it is solved with, from 1; the best estimate if None.
    """

    material: int
    indenter: Indenter
    temperature: float
    speed: float
    load: float
    layer: Layer | None = None
    indenter_modulus: float | None = None
    indenter_poisson_ratio: float = 0.3
    sample: int | None = None

    @property
    def alike(self) -> tuple[object, ...]:
        """What cases have in common that differ by temperature and speed at most."""
        return (self.material, self.sample, self.indenter, self.load, self.layer)


@dataclass(frozen=True, slots=True)
class SurfaceCase:
    """One contact of a rough surface, SI.

    Parameters
    ----------
    material : int
        Its number in `Study.materials`, from 0.
    surface : MadeSurface or ScannedSurface
    temperature : float
        K.
    speed : float
        m/s.
    pressure : float
        Mean pressure, Pa.
    direction : float
        Of the motion, from x towards y, rad.
    layer : Layer, optional
        A half-space without.
    surface_modulus : float, optional
        Young's modulus of an elastic surface, Pa; rigid without.
    surface_poisson_ratio : float
        Of an elastic surface.
    sample : int, optional
        Member of the material's posterior that it is solved with, from 1; the best estimate if None.
    """

    material: int
    surface: SurfaceSource
    temperature: float
    speed: float
    pressure: float
    direction: float = 0.0
    layer: Layer | None = None
    surface_modulus: float | None = None
    surface_poisson_ratio: float = 0.3
    sample: int | None = None

    @property
    def alike(self) -> tuple[object, ...]:
        """What cases have in common that differ by temperature and speed at most."""
        return (self.material, self.sample, self.surface, self.pressure, self.direction, self.layer)


AnyCase: TypeAlias = Case | SurfaceCase


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
    cases : tuple of Case or SurfaceCase
        One for each combination of the axes' points; the last axis runs fastest.
    """

    axes: tuple[Axis, ...]
    cases: tuple[AnyCase, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Points of each axis."""
        return tuple(map(len, self.axes))

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
    indenter, base = tables["indenter"], tables["layer"]
    column = _columns(axes)
    layers: dict[float, Layer] = {}

    def layer(thickness: float) -> Layer:
        if thickness not in layers:
            layers[thickness] = Layer(thickness, bonded=base.base == "bonded")
        return layers[thickness]

    body = body_of(tables)
    make = body.source if indenter is None else indenter.indenter
    made: dict[tuple[Any, ...], Any] = {}

    def one(*values: Any) -> Any:
        if values not in made:
            made[values] = make(*values)
        return made[values]

    count = count_cases(axes)
    bodies = map(one, *(column[name] for name in body.axes)) if body.axes else itertools.repeat(one(), count)
    first, then = ((column["material"], bodies), (column["temperature"], column["speed"]))
    last = (
        itertools.repeat(None) if base is None else map(layer, column["thickness"]),
        itertools.repeat(body.modulus),
        itertools.repeat(body.poisson_ratio),
        (number or None for number in column["sample"]),
    )
    if indenter is not None:
        return Sweep(axes, tuple(map(Case, *first, *then, map(float, column["load"]), *last)))
    toward = column.get("direction", itertools.repeat(0.0))
    return Sweep(axes, tuple(map(SurfaceCase, *first, *then, column["pressure"], toward, *last)))


def _columns(axes: Sequence[Axis]) -> dict[str, list[Any]]:
    """Return each coordinate of all cases; a material's is its number."""
    shape = [len(axis) for axis in axes]
    columns = {}
    for place, axis in enumerate(axes):
        point = np.arange(len(axis)).reshape([-1 if place == other else 1 for other in range(len(axes))])
        points = np.broadcast_to(point, shape).ravel().tolist()
        for name, values in axis.columns.items():
            of_point = range(len(axis)) if name == "material" else values
            columns[name] = [of_point[number] for number in points]
    return columns
