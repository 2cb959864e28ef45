"""[indenter], [layer] and [conditions] of a run file: the bodies in contact, and the conditions."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterator
from functools import reduce
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from pydantic import Discriminator, Field, Tag

from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.indenters.shapes import Ball, Cone, Cylinder, Ellipsoid
from viscofric.friction.cases.case import Case
from viscofric.friction.cases.indenter_case import IndenterCase
from viscofric.study.run_file import tables

_SHAPE = "Shape; each has its own lengths or angle."


class AnyIndenterTable(tables.Table):
    """[indenter]: the indenter that slides or rolls over the rubber."""

    modulus: tables.Modulus | None = Field(
        None, description="Young's modulus of an elastic indenter; rigid without it."
    )
    poisson_ratio: tables.Number = Field(0.3, gt=-1.0, le=0.5, description="Poisson's ratio of an elastic indenter.")

    shape: str
    #: Class of its cases, and the keys of [conditions] that they take.
    CASE: ClassVar[type[Case]] = IndenterCase
    CONDITIONS: ClassVar[tuple[str, ...]] = ("load",)
    #: Keys whose values are axes of the study, and what makes the indenter of one value of each, in their order.
    AXES: ClassVar[tuple[str, ...]]
    KIND: ClassVar[Callable[..., Indenter]]
    #: Whether its load is per length.
    LINE: ClassVar[bool] = False

    def _problems(self) -> Iterator[tables.Problem]:
        if "poisson_ratio" in self.model_fields_set and self.modulus is None:
            said = "is for an elastic indenter, but modulus is not given; a rigid one has none"
            yield "poisson_ratio", tables.worded(said, "is of an elastic indenter; give its Young's modulus")

    @property
    def axes(self) -> dict[str, tuple[float, ...]]:
        """Lengths (m) or angles (rad) of the shape, each with all its values."""
        return {name: getattr(self, name) for name in self.AXES}

    def made(self, *values: float) -> Indenter:
        """Return the indenter for one value of each axis, in their order."""
        return type(self).KIND(*values)


class BallTable(AnyIndenterTable):
    """[indenter]: a ball."""

    shape: Literal["ball"] = Field("ball", description=_SHAPE)
    radius: tables.Lengths = Field(description="Radius of the ball.")
    AXES, KIND = ("radius",), Ball


class CylinderTable(AnyIndenterTable):
    """[indenter]: a long cylinder across the motion; its load is per length."""

    shape: Literal["cylinder"] = Field(description=_SHAPE)
    radius: tables.Lengths = Field(description="Radius of the cylinder.")
    AXES, KIND = ("radius",), Cylinder
    LINE = True


class EllipsoidTable(AnyIndenterTable):
    """[indenter]: a surface with two radii of curvature."""

    shape: Literal["ellipsoid"] = Field(description=_SHAPE)
    radius_x: tables.Lengths = Field(description="Radius of curvature along the motion.")
    radius_y: tables.Lengths = Field(description="Radius of curvature across the motion.")
    AXES, KIND = ("radius_x", "radius_y"), Ellipsoid


class ConeTable(AnyIndenterTable):
    """[indenter]: a blunt cone."""

    shape: Literal["cone"] = Field(description=_SHAPE)
    angle: tables.Angles = Field(description="Angle between flank and undeformed surface; small for linear contact.")
    AXES, KIND = ("angle",), Cone

    def _problems(self) -> Iterator[tables.Problem]:
        yield from super()._problems()
        if max(self.angle) >= 0.5 * math.pi:
            yield "angle", f"{math.degrees(max(self.angle)):.4g}° is not less than a right angle, such as '10 deg'"


#: What a run file calls a shape -> its table.
SHAPES: dict[str, type[AnyIndenterTable]] = {
    "ball": BallTable,
    "cylinder": CylinderTable,
    "ellipsoid": EllipsoidTable,
    "cone": ConeTable,
}


def _shape(value: object) -> object:
    shape = value.get("shape", "ball") if isinstance(value, dict) else getattr(value, "shape", "ball")
    return f"<{shape}>" if isinstance(shape, str) else None


if TYPE_CHECKING:
    IndenterTable = AnyIndenterTable
else:
    tagged = (Annotated[table, Tag(f"<{shape}>")] for shape, table in SHAPES.items())
    IndenterTable = Annotated[reduce(operator.or_, tagged), Discriminator(_shape)]


class LayerTable(tables.Table):
    """[layer]: rubber of finite thickness on a rigid base; a half-space without this table."""

    thickness: tables.Lengths = Field(description="Thickness of the rubber on its rigid base.")
    base: Literal["bonded", "sliding"] = Field(
        "bonded", description="Layer bonded to its base, or sliding on it without friction."
    )


class ConditionsTable(tables.Table):
    """[conditions]: loads or pressures, speeds and temperatures of the prediction."""

    load: tables.Loads = Field(
        default_factory=tuple, description="Normal load of an indenter; per length for a cylinder: '2 N/mm'."
    )
    pressure: tables.Pressures = Field(
        default_factory=tuple, description="Instead, for a rough surface: mean pressure."
    )
    direction: tables.Directions = Field(
        default_factory=tuple, description="Sliding direction of a rough surface, from x towards y; default: along x."
    )
    speed: tables.Speeds = Field(description="Speed at which the rubber is deformed, above zero.")
    temperature: tables.Temperatures = Field(description="Temperature of the rubber.")
    thickness: tables.Length | None = Field(
        None, description="Thickness of the rubber, to check the half-space assumption; for thin rubber use [layer]."
    )
