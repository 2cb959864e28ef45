"""Quantities of a run file that may be one value, a list or a range: an axis of the study."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator, Discriminator, Field, Tag
from pydantic_core import core_schema

from viscofric.study.quantities import (
    MOST_POINTS,
    Angle,
    Count,
    Length,
    Load,
    Speed,
    Temperature,
    listed,
    one_or_more,
    schema_of,
)
from viscofric.study.table import Table

if TYPE_CHECKING:
    from collections.abc import Iterator

    from pydantic import GetCoreSchemaHandler

    from viscofric.study.table import Problem

# Branches of a choice between types appear in pydantic's locations, not in the file: no key looks like these.
RANGE, LIST = "<range>", "<list>"


class _Range(Table):
    """From one value to another; its ends are those of a subclass."""

    first: float
    last: float
    points: Count = Field(ge=2, le=MOST_POINTS, description="How many values, both ends included.")

    def problems(self) -> Iterator[Problem]:
        """Yield what does not fit together within the table."""
        if self.first == self.last:
            yield "to", "is the same as from; give one value instead of a range"
        if type(self.first) is not type(self.last):
            yield "to", "is not of the same kind as from"

    def values(self) -> tuple[float, ...]:
        """Return all values; the ends are exactly those given."""
        logarithmic = getattr(self, "spacing", "linear") == "log"
        spread = (np.geomspace if logarithmic else np.linspace)(self.first, self.last, self.points)
        kind = type(self.first)
        return (self.first, *(kind(value) for value in spread[1:-1]), self.last)


_FROM, _TO = "First value.", "Last value."
_SPACING = "Between the values: equal ratios (log) or equal steps (linear)."


class SpeedRange(_Range):
    """Speeds from one to another."""

    first: Speed = Field(alias="from", description=_FROM)
    last: Speed = Field(alias="to", description=_TO)
    spacing: Literal["log", "linear"] = Field("log", description=_SPACING)


class LengthRange(_Range):
    """Lengths from one to another."""

    first: Length = Field(alias="from", description=_FROM)
    last: Length = Field(alias="to", description=_TO)
    spacing: Literal["log", "linear"] = Field("log", description=_SPACING)


class AngleRange(_Range):
    """Angles from one to another."""

    first: Angle = Field(alias="from", description=_FROM)
    last: Angle = Field(alias="to", description=_TO)
    spacing: Literal["log", "linear"] = Field("log", description=_SPACING)


class LoadRange(_Range):
    """Loads from one to another."""

    first: Load = Field(alias="from", description=_FROM)
    last: Load = Field(alias="to", description=_TO)
    spacing: Literal["log", "linear"] = Field("log", description=_SPACING)


class TemperatureRange(_Range):
    """Temperatures from one to another, in equal steps."""

    first: Temperature = Field(alias="from", description=_FROM)
    last: Temperature = Field(alias="to", description=_TO)
    spacing: Literal["linear"] = Field("linear", description="Between the values: equal steps.")


def _kind(value: object) -> str:
    return RANGE if isinstance(value, dict | _Range) else LIST


@dataclass(frozen=True)
class _Many:
    """Marks a field whose values may be one, a list or a range; it holds all of them as a tuple."""

    one: Any
    span: type[_Range]

    most: ClassVar[int] = MOST_POINTS

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> core_schema.CoreSchema:
        several = Annotated[
            tuple[self.one, ...],  # type: ignore[name-defined]
            Field(min_length=1, max_length=self.most),
            BeforeValidator(listed),
            one_or_more(schema_of(self.one)),
        ]
        either = Annotated[
            Annotated[self.span, Tag(RANGE)] | Annotated[several, Tag(LIST)],  # type: ignore[name-defined]
            Discriminator(_kind),
        ]
        return core_schema.no_info_after_validator_function(_values, handler.generate_schema(either))


def _values(found: _Range | tuple[float, ...]) -> tuple[float, ...]:
    return found.values() if isinstance(found, _Range) else found


#: One value, a list of them, or ``{ from, to, points, spacing }``: all of them, SI.
Lengths = Annotated[tuple[float, ...], _Many(Length, LengthRange)]
Angles = Annotated[tuple[float, ...], _Many(Angle, AngleRange)]
Loads = Annotated[tuple[float, ...], _Many(Load, LoadRange)]
Speeds = Annotated[tuple[float, ...], _Many(Speed, SpeedRange)]
Temperatures = Annotated[tuple[float, ...], _Many(Temperature, TemperatureRange)]
