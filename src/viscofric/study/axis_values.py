"""Quantities of a run file that may be one value, a list or a range: an axis of the study."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator, Discriminator, Field, Tag
from pydantic_core import core_schema

from viscofric.study.quantities import (
    MOST_POINTS,
    Angle,
    Count,
    Direction,
    Length,
    Load,
    Pressure,
    Seed,
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
RANGE, LIST, SEED_RANGE = "<range>", "<list>", "<seeds>"


class _Span(Table, ABC):
    """What stands for several values."""

    @abstractmethod
    def values(self) -> tuple[Any, ...]:
        """Return all values."""


class _Range(_Span):
    """From one value to another; its ends are those of a subclass."""

    first: float
    last: float
    points: Count = Field(ge=2, le=MOST_POINTS, description="How many values, both ends included.")
    spacing: Literal["log", "linear"] = Field(
        "log", description="Between the values: equal ratios (log) or equal steps (linear)."
    )

    def problems(self) -> Iterator[Problem]:
        """Yield what does not fit together within the table."""
        if self.first == self.last:
            yield "to", "is the same as from; give one value instead of a range"
        if type(self.first) is not type(self.last):
            yield "to", "is not of the same kind as from"

    def values(self) -> tuple[float, ...]:
        """Return all values; the ends are exactly those given."""
        spread = (np.geomspace if self.spacing == "log" else np.linspace)(self.first, self.last, self.points)
        kind = type(self.first)
        return (self.first, *(kind(value) for value in spread[1:-1]), self.last)


class _EvenRange(_Range):
    """From one value to another in equal steps."""

    spacing: Literal["linear"] = Field("linear", description="Between the values: equal steps.")


_FROM, _TO = "First value.", "Last value."


class SpeedRange(_Range):
    """Speeds from one to another."""

    first: Speed = Field(alias="from", description=_FROM)
    last: Speed = Field(alias="to", description=_TO)


class LengthRange(_Range):
    """Lengths from one to another."""

    first: Length = Field(alias="from", description=_FROM)
    last: Length = Field(alias="to", description=_TO)


class AngleRange(_Range):
    """Angles from one to another."""

    first: Angle = Field(alias="from", description=_FROM)
    last: Angle = Field(alias="to", description=_TO)


class LoadRange(_Range):
    """Loads from one to another."""

    first: Load = Field(alias="from", description=_FROM)
    last: Load = Field(alias="to", description=_TO)


class PressureRange(_Range):
    """Pressures from one to another."""

    first: Pressure = Field(alias="from", description=_FROM)
    last: Pressure = Field(alias="to", description=_TO)


class DirectionRange(_EvenRange):
    """Directions from one to another, in equal steps."""

    first: Direction = Field(alias="from", description=_FROM)
    last: Direction = Field(alias="to", description=_TO)


class SeedRange(_Span):
    """All whole numbers from one to another."""

    first: Seed = Field(alias="from", description=_FROM)
    last: Seed = Field(alias="to", description=_TO)

    def problems(self) -> Iterator[Problem]:
        """Yield what does not fit together within the table."""
        if not 0 < self.last - self.first < MOST_POINTS:
            yield "to", f"must lie above from, by less than {MOST_POINTS:,}"

    def values(self) -> tuple[int, ...]:
        """Return all of them."""
        return tuple(range(self.first, self.last + 1))


class TemperatureRange(_EvenRange):
    """Temperatures from one to another, in equal steps."""

    first: Temperature = Field(alias="from", description=_FROM)
    last: Temperature = Field(alias="to", description=_TO)


@dataclass(frozen=True)
class _Many:
    """Marks a field whose values may be one, a list or a range; it holds all of them as a tuple."""

    one: Any
    span: type[_Span]
    tag: str = RANGE

    most: ClassVar[int] = MOST_POINTS

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> core_schema.CoreSchema:
        several = Annotated[
            tuple[self.one, ...],  # type: ignore[name-defined]
            Field(min_length=1, max_length=self.most),
            BeforeValidator(listed),
            one_or_more(schema_of(self.one)),
        ]

        def kind(value: object) -> str:
            return self.tag if isinstance(value, dict | _Span) else LIST

        either = Annotated[
            Annotated[self.span, Tag(self.tag)] | Annotated[several, Tag(LIST)],  # type: ignore[name-defined]
            Discriminator(kind),
        ]
        return core_schema.no_info_after_validator_function(_values, handler.generate_schema(either))


def _values(found: _Span | tuple[float, ...]) -> tuple[float, ...]:
    return found.values() if isinstance(found, _Span) else found


#: One value, a list of them, or ``{ from, to, points, spacing }``: all of them, SI.
Lengths = Annotated[tuple[float, ...], _Many(Length, LengthRange)]
Angles = Annotated[tuple[float, ...], _Many(Angle, AngleRange)]
Loads = Annotated[tuple[float, ...], _Many(Load, LoadRange)]
Pressures = Annotated[tuple[float, ...], _Many(Pressure, PressureRange)]
Directions = Annotated[tuple[float, ...], _Many(Direction, DirectionRange)]
Seeds = Annotated[tuple[int, ...], _Many(Seed, SeedRange, SEED_RANGE)]
Speeds = Annotated[tuple[float, ...], _Many(Speed, SpeedRange)]
Temperatures = Annotated[tuple[float, ...], _Many(Temperature, TemperatureRange)]
