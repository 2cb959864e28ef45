"""Fields of a run file: text with a unit in, SI out; one value, a list or a range; tables that refuse unknown keys."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Self, TypeAlias

import numpy as np
from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    Strict,
    Tag,
    ValidationError,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import InitErrorDetails, PydanticCustomError, core_schema

from viscofric.errors import InputError, brief
from viscofric.units import Quantity, positive, to_si

if TYPE_CHECKING:
    from collections.abc import Iterator

    from pydantic import GetCoreSchemaHandler

# Stands for the field's name in messages about units; the location says it better.
VALUE = "value"
MOST_POINTS = 10_000
# Branches of a choice between types appear in pydantic's locations, not in the file: no key looks like these.
RANGE, LIST = "<range>", "<list>"

#: A key within the table and a sentence about it; "" for the table as a whole.
Problem: TypeAlias = tuple[str, str]


def with_unit(value: object) -> Quantity:
    """Refuse bare numbers: in a run file every quantity carries its unit."""
    if not isinstance(value, str):
        raise ValueError(f"{brief(value)} has no unit; write text such as '25 N', '100 mm/s', '30 degC'")
    return value


def kelvin(value: object) -> float:
    """Return a temperature, given as text with its unit, in K."""
    found = to_si(with_unit(value), "K", VALUE)
    if found <= 0.0:
        raise ValueError(f"{brief(value)} lies below absolute zero")
    return found


class PerLength(float):
    """A load per length, N/m, as that of a cylinder; any other load is a plain float in N."""


def _load(value: object) -> float:
    text = with_unit(value)
    try:
        return positive(text, "N", VALUE)
    except InputError as error:
        try:
            return PerLength(positive(text, "N/m", VALUE))
        except InputError as other:
            # A load per length below zero is told as such, all else as a force.
            raise (other if "above zero" in str(other) else error) from None


def _positive(unit: str) -> BeforeValidator:
    return BeforeValidator(lambda value: positive(with_unit(value), unit, VALUE))


def _text(*units: str) -> WithJsonSchema:
    """JSON schema of a quantity: a number and a unit, such as those."""
    number = r"^\s*[+\-−]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+\-]?[0-9]+)?\s*[^0-9\s.,+\-].*$"
    return WithJsonSchema({"type": "string", "pattern": number, "examples": list(units)})


# A user's value, already turned into SI.
Length = Annotated[float, _positive("m"), _text("9.525 mm")]
Force = Annotated[float, _positive("N"), _text("25 N")]
Speed = Annotated[float, _positive("m/s"), _text("100 mm/s")]
Angle = Annotated[float, _positive("rad"), _text("5 deg")]
Modulus = Annotated[float, _positive("Pa"), _text("200 GPa")]
Load = Annotated[float, BeforeValidator(_load), _text("25 N", "2 N/mm")]
Temperature = Annotated[float, BeforeValidator(kelvin), _text("30 degC")]
TemperatureStep = Annotated[float, _positive("delta_degC"), _text("1 delta_degC")]
SignedForce = Annotated[float, BeforeValidator(lambda value: to_si(with_unit(value), "N", VALUE)), _text("0.12 N")]

#: Numbers as TOML writes them: no text, no true or false in their place.
Count = Annotated[int, Strict()]
Number = Annotated[float, Strict(), Field(allow_inf_nan=False)]


class Table(BaseModel):
    """A table of the run file: no unknown keys, no changes afterwards."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    def problems(self) -> Iterator[Problem]:
        """Yield what does not fit together within the table."""
        yield from ()

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        found = list(self.problems())
        if found:
            raise all_at_once(type(self).__name__, found)
        return self


def all_at_once(title: str, problems: list[Problem]) -> ValidationError:
    """Return the error that tells several problems, each at its key."""
    details = [
        InitErrorDetails(
            type=PydanticCustomError("relation", "{words}", {"words": words}),
            loc=tuple(int(part) if part.isdigit() else part for part in key.split(".")) if key else (),
            input=None,
        )
        for key, words in problems
    ]
    return ValidationError.from_exception_data(title, details)


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
        listed = Annotated[
            tuple[self.one, ...],  # type: ignore[name-defined]
            Field(min_length=1, max_length=self.most),
            BeforeValidator(_one_is_a_list),
            WithJsonSchema(self._schema_of_list()),
        ]
        either = Annotated[
            Annotated[self.span, Tag(RANGE)] | Annotated[listed, Tag(LIST)],  # type: ignore[name-defined]
            Discriminator(_kind),
        ]
        return core_schema.no_info_after_validator_function(_values, handler.generate_schema(either))

    def _schema_of_list(self) -> dict[str, Any]:
        (one,) = [mark.json_schema for mark in self.one.__metadata__ if isinstance(mark, WithJsonSchema)]
        return {"anyOf": [one, {"type": "array", "items": one, "minItems": 1}]}


def _one_is_a_list(value: object) -> object:
    return [value] if isinstance(value, str | int | float) else value


def _values(found: _Range | tuple[float, ...]) -> tuple[float, ...]:
    return found.values() if isinstance(found, _Range) else found


#: One value, a list of them, or ``{ from, to, points, spacing }``: all of them, SI.
Lengths = Annotated[tuple[float, ...], _Many(Length, LengthRange)]
Angles = Annotated[tuple[float, ...], _Many(Angle, AngleRange)]
Loads = Annotated[tuple[float, ...], _Many(Load, LoadRange)]
Speeds = Annotated[tuple[float, ...], _Many(Speed, SpeedRange)]
Temperatures = Annotated[tuple[float, ...], _Many(Temperature, TemperatureRange)]
