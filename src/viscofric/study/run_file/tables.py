"""Base class of a run file's tables, and the types of their keys: text with a unit on input, SI inside."""

from __future__ import annotations

import itertools
import os
import re
from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal, Self, TypeAlias

import numpy as np
from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    GetCoreSchemaHandler,
    PlainValidator,
    Strict,
    Tag,
    ValidationError,
    WithJsonSchema,
    create_model,
    model_validator,
)
from pydantic_core import InitErrorDetails, PydanticCustomError, core_schema

from viscofric.errors import InputError, brief
from viscofric.notes import Note, Remedy
from viscofric.units import Quantity, positive, to_si

#: A key within the table, such as "load" or "load.2" ("": the whole table), and a sentence about it.
Problem: TypeAlias = tuple[str, str]


def worded(run_file: str, page: str) -> Note:
    """Return a problem in the words of a run file, and in those of the page, beside its field."""
    return Note("contradiction", "", remedy=Remedy(f"{run_file}.", page=f"{page}."))


def with_options(words: str, keys: Iterable[str]) -> Note:
    """Return a problem of a table in the words of a run file, and with options instead of its keys.

    A key is told from a word by an underscore, by its value, by backticks, which are left out, or by its place at the
    beginning, in a list of keys.
    """
    longest = "|".join(sorted(keys, key=len, reverse=True))
    pattern = re.compile(rf"(?<![\w.-])(`?)({longest})\1(?: = \"([^\"]*)\")?(?![\w.-])")
    first = re.match(rf"(?:(?:{longest})(?: and |(?![\w.-])))*", words)
    listed = first.end() if first else 0

    def option(found: re.Match[str]) -> str:
        tick, key, value = found.groups()
        if "_" not in key and value is None and not tick and found.start() >= listed:
            return found[0]
        return f"--{key.replace('_', '-')}" + ("" if value is None else f" {value}")

    said = words.replace("`", "")
    return Note("contradiction", "", remedy=Remedy(f"{said}.", f"{pattern.sub(option, words)}.", f"{said}."))


class Table(BaseModel):
    """A table of the run file: no unknown keys, no changes afterwards."""

    model_config = ConfigDict(extra="forbid", frozen=True)
    #: Keys that name files, in the order of `inputs`.
    FILES: ClassVar[tuple[str, ...]] = ()

    @property
    def inputs(self) -> tuple[Path, ...]:
        """All files that the table names."""
        given = (getattr(self, key) for key in self.FILES)
        return tuple(path for one in given for path in ((one,) if isinstance(one, Path) else one or ()))

    def relative_to(self, folder: Path) -> Self:
        """Return the table with paths relative to a folder, and patterns such as ``*.txt`` in lists expanded."""
        changes: dict[str, Any] = {}
        for key in self.FILES:
            if isinstance(one := getattr(self, key), Path):
                changes[key] = folder / one
            elif one:
                changes[key] = tuple(path for each in one for path in files_of(folder, each))
        return self.model_copy(update=changes)

    def _problems(self) -> Iterator[Problem | str]:
        """Yield the contradictions within the table, each at its key, or between its keys in words alone."""
        yield from ()

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        found = [("", with_options(one, type(self).model_fields)) if isinstance(one, str) else one
                 for one in self._problems()]  # fmt: skip
        if found:
            raise all_at_once(type(self).__name__, found)
        return self


def files_of(folder: Path, path: Path) -> tuple[Path, ...]:
    """Return the files that match a path with ``*`` or ``?``, by name; the path itself if none does."""
    whole = folder / path
    if not any(mark in str(path) for mark in "*?") or whole.exists():
        return (whole,)
    base = Path(whole.anchor) if path.is_absolute() else folder
    pattern = path.relative_to(path.anchor) if path.is_absolute() else path
    found = list(itertools.islice((one for one in base.glob(str(pattern)) if one.is_file()), MOST_POINTS + 1))
    if len(found) > MOST_POINTS:
        raise InputError(
            f"{path} matches more than {MOST_POINTS:,} files; write a narrower pattern", code="too-many-files"
        )
    return tuple(sorted(found)) or (whole,)


def all_at_once(title: str, problems: list[Problem]) -> ValidationError:
    """Return one validation error for several problems, each at its key."""
    details = [
        InitErrorDetails(
            type=PydanticCustomError("relation", "{words}", {"words": words}),
            loc=tuple(int(part) if part.isdigit() else part for part in key.split(".")) if key else (),
            input=None,
        )
        for key, words in problems
    ]
    return ValidationError.from_exception_data(title, details)


# Name of every field in messages about units; the location of the error names the field.
VALUE = "value"
MOST_POINTS = 10_000
_LONGEST_NAME = 255  # bytes between two slashes, on all common file systems
_SPACE = 32


def as_written(value: object) -> str:
    """Return how a value is written, on one line, shortened for a sentence."""
    return str(value).lower() if isinstance(value, bool) else brief(value)


def with_unit(value: object) -> Quantity:
    """Refuse bare numbers: in a run file every quantity has a unit."""
    if not isinstance(value, str):
        raise ValueError(f"{as_written(value)} has no unit; write text such as '25 N', '100 mm/s', '30 degC'")
    return value


def kelvin(value: object) -> float:
    """Return a temperature, given as text with its unit, in K."""
    found = to_si(with_unit(value), "K", VALUE)
    if found <= 0.0:
        raise ValueError(f"{brief(value)} is below absolute zero")
    return found


class PerLength(float):
    """A load per length, N/m, as for a cylinder; every other load is a plain float in N."""


def _load(value: object) -> float:
    text = with_unit(value)
    try:
        return positive(text, "N", VALUE)
    except InputError as error:
        try:
            return PerLength(positive(text, "N/m", VALUE))
        except InputError as other:
            # A negative load per length is reported as such, everything else as a force.
            raise (other if "above zero" in str(other) else error) from None


def above_zero(unit: str) -> BeforeValidator:
    """Return what reads a quantity above zero in a unit."""
    return BeforeValidator(lambda value: positive(with_unit(value), unit, VALUE))


def _signed(unit: str) -> BeforeValidator:
    return BeforeValidator(lambda value: to_si(with_unit(value), unit, VALUE))


def as_text(*units: str) -> WithJsonSchema:
    """JSON schema of a quantity: a number and a unit."""
    number = r"^\s*[+\-−]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+\-]?[0-9]+)?\s*[^0-9\s.,+\-].*$"
    return WithJsonSchema({"type": "string", "pattern": number, "examples": list(units)})


# A user's value, already turned into SI.
Length = Annotated[float, above_zero("m"), as_text("9.525 mm")]
Force = Annotated[float, above_zero("N"), as_text("25 N")]
Speed = Annotated[float, above_zero("m/s"), as_text("100 mm/s")]
Angle = Annotated[float, above_zero("rad"), as_text("5 deg")]
Modulus = Annotated[float, above_zero("Pa"), as_text("200 GPa")]
Pressure = Annotated[float, above_zero("Pa"), as_text("50 kPa")]
Mass = Annotated[float, above_zero("kg"), as_text("4 g")]
Gravity = Annotated[float, above_zero("m/s**2"), as_text("9.81 m/s^2")]
Direction = Annotated[float, _signed("rad"), as_text("30 deg")]
# Plain, or pydantic would convert a load per length to a plain float.
Load = Annotated[float, PlainValidator(_load), as_text("25 N", "2 N/mm")]
Temperature = Annotated[float, BeforeValidator(kelvin), as_text("30 degC")]
TemperatureStep = Annotated[float, above_zero("delta_degC"), as_text("1 K")]
SignedSpeed = Annotated[float, _signed("m/s"), as_text("-50 mm/s")]
SignedForce = Annotated[float, _signed("N"), as_text("0.12 N")]

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
    """Turn a single entry into a list of one."""
    return [value] if isinstance(value, str | int | float) else value


def one_or_more(entry: dict[str, Any], most: int = MOST_POINTS) -> WithJsonSchema:
    """Return the JSON schema of a key that takes one entry or a list of them; see `listed`."""
    return WithJsonSchema({"anyOf": [entry, {"type": "array", "items": entry, "minItems": 1, "maxItems": most}]})


def _file_name(value: object) -> object:
    if isinstance(value, str):
        if not value.strip():
            raise ValueError("is empty; expected the name of a file")
        parts = re.split(r"[/\\]", value)
        if max(len(os.fsencode(part)) for part in parts) > _LONGEST_NAME or any(ord(mark) < _SPACE for mark in value):
            raise ValueError(f"{brief(value)} is not a valid file name")
        if "**" in value:
            raise ValueError(f"{brief(value)} searches all folders; use a pattern such as 'sweeps/*.txt'")
    return value


def schema_of(kind: Any) -> dict[str, Any]:
    """Return the JSON schema of a type of quantity."""
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
#: Quantity -> heading of its column, where a file's header is not understood.
Headings = Annotated[dict[Words, Words], Field(max_length=50)]


# Branches of a choice between types; they appear in pydantic's locations, and cannot be keys.
RANGE, LIST, SEED_RANGE = "<range>", "<list>", "<seeds>"


class _Span(Table, ABC):
    """A range of values."""

    @abstractmethod
    def values(self) -> tuple[Any, ...]:
        """Return all values."""


class _Range(_Span):
    """A range with two ends, whose types a subclass sets."""

    first: float
    last: float
    points: Count = Field(ge=2, le=MOST_POINTS, description="Number of values, including both ends.")
    spacing: Literal["log", "linear"] = Field(
        "log", description="Equal ratios (log) or equal steps (linear) between the values."
    )

    def _problems(self) -> Iterator[Problem]:
        if self.first == self.last:
            yield "to", "is the same as from; give one value instead of a range"
        if type(self.first) is not type(self.last):
            yield "to", "is not of the same kind as from"
        if self.spacing == "log" and self.first * self.last <= 0.0:
            yield "spacing", "must be 'linear', as equal ratios do not reach or cross zero"

    def values(self) -> tuple[float, ...]:
        """Return all values; the ends are exactly those given."""
        spread = (np.geomspace if self.spacing == "log" else np.linspace)(self.first, self.last, self.points)
        kind = type(self.first)
        return (self.first, *(kind(value) for value in spread[1:-1]), self.last)


class _EvenRange(_Range):
    """A range with equal steps."""

    spacing: Literal["linear"] = Field("linear", description="Equal steps between the values.")


def _ends() -> tuple[Any, Any]:
    """Return the fields of two ends: new ones for each class, since pydantic before 2.12 writes its type into them."""
    return Field(alias="from", description="First value."), Field(alias="to", description="Last value.")


def _range(title: str, end: Any, base: type[_Range] = _Range) -> type[_Range]:
    """Return a range of values of a type; its title ends in "Range"."""
    words = f"A range of {title.removesuffix('Range').lower()}s."
    first, last = _ends()
    return create_model(title, __base__=base, __doc__=words, first=(end, first), last=(end, last))


SpeedRange = _range("SpeedRange", Speed)


class SeedRange(_Span):
    """All whole numbers between two ends."""

    first: Seed = _ends()[0]
    last: Seed = _ends()[1]

    def _problems(self) -> Iterator[Problem]:
        if not 0 < self.last - self.first < MOST_POINTS:
            yield "to", f"must lie above from, by less than {MOST_POINTS:,}"

    def values(self) -> tuple[int, ...]:
        """Return all values."""
        return tuple(range(self.first, self.last + 1))


@dataclass(frozen=True)
class _Many:
    """Marks a key that takes one value, a list or a range; its field is a tuple of all values."""

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
Lengths = Annotated[tuple[float, ...], _Many(Length, _range("LengthRange", Length))]
Angles = Annotated[tuple[float, ...], _Many(Angle, _range("AngleRange", Angle))]
Loads = Annotated[tuple[float, ...], _Many(Load, _range("LoadRange", Load))]
Pressures = Annotated[tuple[float, ...], _Many(Pressure, _range("PressureRange", Pressure))]
Directions = Annotated[tuple[float, ...], _Many(Direction, _range("DirectionRange", Direction, _EvenRange))]
Seeds = Annotated[tuple[int, ...], _Many(Seed, SeedRange, SEED_RANGE)]
Speeds = Annotated[tuple[float, ...], _Many(Speed, SpeedRange)]
Slips = Annotated[tuple[float, ...], _Many(SignedSpeed, _range("SlipRange", SignedSpeed))]
Temperatures = Annotated[tuple[float, ...], _Many(Temperature, _range("TemperatureRange", Temperature, _EvenRange))]
