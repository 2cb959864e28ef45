"""[heating] of a run file: thermal properties of both bodies, and Coulomb heat."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import fields
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, PlainValidator, WithJsonSchema

from viscofric.errors import brief
from viscofric.heat.heating import Heating
from viscofric.study.run_file import tables
from viscofric.thermal import BODIES, ThermalProperties, body_of

_MOST_VALUES = 100


def _body_named(name: str) -> PlainValidator:
    """Return what reads a body that is called so in sentences."""

    def read(value: object) -> ThermalProperties:
        if not isinstance(value, str):
            raise ValueError(
                f"{tables.as_written(value)} is no text; write a name such as 'steel', or properties with units"
            )
        return body_of(value, name)

    return PlainValidator(read)


# Any: pydantic would look into the fields of the class.
_SCHEMA = WithJsonSchema({"type": "string", "minLength": 1, "examples": [*BODIES, "46 W/m/K, 7810 kg/m^3, 475 J/kg/K"]})
Counterface = Annotated[Any, _body_named("counterface"), _SCHEMA]
Rubber = Annotated[Any, _body_named("rubber"), _SCHEMA]


def _passes(value: object) -> float:
    if value == "inf":  # JSON has no other
        value = math.inf
    whole = isinstance(value, int) and not isinstance(value, bool)
    if not (whole or value == math.inf) or float(value) < 0.0:  # type: ignore[arg-type]
        raise ValueError(f"{brief(value)} is no number of passes; give a whole number, or inf for the final state")
    return float(value)  # type: ignore[arg-type]


Passes = Annotated[
    float, PlainValidator(_passes), WithJsonSchema({"anyOf": [{"type": "number", "minimum": 0}, {"const": "inf"}]})
]
Coefficient = Annotated[tables.Number, Field(ge=0.0)]
Coefficients = Annotated[
    tuple[Coefficient, ...],
    BeforeValidator(tables.listed),
    Field(min_length=1, max_length=_MOST_VALUES),
    tables.one_or_more({"type": "number", "minimum": 0}, _MOST_VALUES),
]


class HeatingTable(tables.Table):
    """[heating]: every case also at the temperature to which its own friction heats it."""

    counterface: Counterface = Field(
        description="Thermal properties of the indenter or surface: a name (typical handbook values), or conductivity "
        "and density and heat capacity, or conductivity and diffusivity."
    )
    rubber: Rubber = Field(
        "filled rubber",
        validate_default=True,
        description="The same of the rubber; default: typical handbook values of a filled rubber.",
    )
    coulomb: Coefficients = Field(
        (0.0,),
        description="Coulomb friction coefficient, whose heat both bodies share; several are an axis. [interface], if "
        "given, makes this heat instead.",
    )
    slip: tables.Slips | None = Field(
        None,
        description="Sliding velocity between both surfaces, below zero where the counterface is the faster one; "
        "several are an axis; default: the speed of the case.",
    )
    track_radius: tables.Length | None = Field(None, description="Radius of the circle on which earlier passes were.")
    passes: Passes = Field(0, description="Earlier passes on that circle; inf: the final state.")
    nominal_radius: tables.Length | None = Field(
        None, description="Of a rough surface: radius of the nominal contact, whose mean heat then counts too."
    )
    average: Literal["contact", "loss"] = Field(
        "loss",
        description="Which mean rise the rubber responds to: that where the loss is released, or that of its face.",
    )
    branch: Literal["cold", "hot"] = Field(
        "cold", description="State of contacts that have two: that of a rising speed, or that of a falling one."
    )

    def _problems(self) -> Iterator[tables.Problem]:
        if self.passes > 0 and self.track_radius is None:
            yield (
                "passes",
                tables.worded("needs track_radius, the radius of the circle", "need the radius of the track"),
            )
        if self.track_radius is not None and self.passes == 0:
            yield "track_radius", tables.worded("has no effect without passes", "has no effect without earlier passes")
        for name in ("coulomb", "slip"):
            values = getattr(self, name) or ()
            if len(set(values)) < len(values):
                yield name, "contains the same value twice"

    def heating(self, coulomb: float, slip: float | None) -> Heating:
        """Return the heating of one value of Coulomb friction and of slip."""
        given = {one.name: getattr(self, one.name) for one in fields(Heating)}
        return Heating(**given | {"coulomb": coulomb, "slip": slip})
