"""Fields of a run file: text with a unit in, SI out; numbers, names of files."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, PlainValidator, Strict, WithJsonSchema

from viscofric.errors import InputError, brief
from viscofric.units import Quantity, positive, to_si

# Stands for the field's name in messages about units; the location says it better.
VALUE = "value"
MOST_POINTS = 10_000
_LONGEST_NAME = 255  # bytes between two slashes, on all common file systems
_SPACE = 32


def as_written(value: object) -> str:
    """Return how a value is written, on one line and cut where it is too long for a sentence."""
    return str(value).lower() if isinstance(value, bool) else brief(value)


def with_unit(value: object) -> Quantity:
    """Refuse bare numbers: in a run file every quantity carries its unit."""
    if not isinstance(value, str):
        raise ValueError(f"{as_written(value)} has no unit; write text such as '25 N', '100 mm/s', '30 degC'")
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
Pressure = Annotated[float, _positive("Pa"), _text("50 kPa")]
Direction = Annotated[float, BeforeValidator(lambda value: to_si(with_unit(value), "rad", VALUE)), _text("30 deg")]
# Plain, for else pydantic makes a bare float of a load per length.
Load = Annotated[float, PlainValidator(_load), _text("25 N", "2 N/mm")]
Temperature = Annotated[float, BeforeValidator(kelvin), _text("30 degC")]
TemperatureStep = Annotated[float, _positive("delta_degC"), _text("1 delta_degC")]
SignedForce = Annotated[float, BeforeValidator(lambda value: to_si(with_unit(value), "N", VALUE)), _text("0.12 N")]

#: Of random numbers.
BIGGEST_SEED = 2**63 - 1
#: Numbers as TOML writes them: no text, no true or false in their place.
Count = Annotated[int, Strict()]
Number = Annotated[float, Strict(), Field(allow_inf_nan=False)]

Seed = Annotated[
    int,
    Strict(),
    Field(ge=0, le=BIGGEST_SEED),
    WithJsonSchema({"type": "integer", "minimum": 0, "maximum": BIGGEST_SEED}),
]


def listed(value: object) -> object:
    """Let one entry stand for a list of one."""
    return [value] if isinstance(value, str | int | float) else value


def one_or_more(entry: dict[str, Any], most: int = MOST_POINTS) -> WithJsonSchema:
    """Return the JSON schema of a field that may be one entry or a list of them; see `listed`."""
    return WithJsonSchema({"anyOf": [entry, {"type": "array", "items": entry, "minItems": 1, "maxItems": most}]})


def _file_name(value: object) -> object:
    if isinstance(value, str):
        if not value.strip():
            raise ValueError("is empty; the name of a file is wanted")
        parts = re.split(r"[/\\]", value)
        if max(len(os.fsencode(part)) for part in parts) > _LONGEST_NAME or any(ord(mark) < _SPACE for mark in value):
            raise ValueError(f"{brief(value)} cannot be the name of a file")
        if "**" in value:
            raise ValueError(f"{brief(value)} looks into all folders; write a pattern such as 'sweeps/*.txt'")
    return value


def schema_of(kind: Any) -> dict[str, Any]:
    """Return the JSON schema of a kind of quantity."""
    (found,) = [mark.json_schema for mark in kind.__metadata__ if isinstance(mark, WithJsonSchema)]
    return dict(found or {})


#: The name of a file, and one or more of them or patterns that stand for them.
FileName = Annotated[Path, BeforeValidator(_file_name), WithJsonSchema({"type": "string", "minLength": 1})]
FileNames = Annotated[
    tuple[FileName, ...],
    BeforeValidator(listed),
    Field(min_length=1, max_length=MOST_POINTS),
    one_or_more({"type": "string", "minLength": 1}),
]
#: A few words on one line.
Words = Annotated[str, Field(max_length=300, pattern=r"^[^\x00-\x1f\x7f]*$")]
