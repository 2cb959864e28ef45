"""Fields of a run file: text with a unit in, SI out; tables that refuse unknown keys."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, BeforeValidator, ConfigDict

from viscofric.units import Quantity, positive, to_si

# Stands for the field's name in messages about units; the location says it better.
VALUE = "value"


def _with_unit(value: object) -> Quantity:
    """Refuse bare numbers: in a run file every quantity carries its unit."""
    if not isinstance(value, str):
        raise ValueError(f"{value!r} has no unit; write text such as '25 N', '100 mm/s', '30 degC'")
    return value


def kelvin(value: object) -> float:
    """Return a temperature, given as text with its unit, in K."""
    found = to_si(_with_unit(value), "K", VALUE)
    if found <= 0.0:
        raise ValueError(f"{value!r} lies below absolute zero")
    return found


# A user's value, already turned into SI.
Length = Annotated[float, BeforeValidator(lambda value: positive(_with_unit(value), "m", VALUE))]
Force = Annotated[float, BeforeValidator(lambda value: positive(_with_unit(value), "N", VALUE))]
Speed = Annotated[float, BeforeValidator(lambda value: positive(_with_unit(value), "m/s", VALUE))]
SignedForce = Annotated[float, BeforeValidator(lambda value: to_si(_with_unit(value), "N", VALUE))]
TemperatureStep = Annotated[float, BeforeValidator(lambda value: positive(_with_unit(value), "delta_degC", VALUE))]
Temperature = Annotated[float, BeforeValidator(kelvin)]


class Table(BaseModel):
    """A table of the run file: no unknown keys, no changes afterwards."""

    model_config = ConfigDict(extra="forbid", frozen=True)
