"""Units at the edges: text, numbers or pint quantities in, SI floats and arrays out.

Plain numbers are SI (temperatures in kelvin).  Text such as ``"100 mm/s"`` or ``"30 degC"`` and pint
quantities carry their own unit.  pint itself is imported only when a unit has to be understood.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from viscofric.errors import InputError

if TYPE_CHECKING:
    import pint
    from numpy.typing import ArrayLike, NDArray

#: A scalar as users write it: a plain SI number, text with a unit, or a pint quantity.
Quantity: TypeAlias = "float | str | pint.Quantity[Any]"
#: One or many of them.
Quantities: TypeAlias = "ArrayLike | Quantity | list[Quantity] | tuple[Quantity, ...]"

#: SI unit -> an example of what a user may write, for error messages.
_EXAMPLE = {
    "m": "'9.525 mm'",
    "N": "'25 N'",
    "N/m": "'1 kN/m'",
    "m/s": "'100 mm/s'",
    "K": "'30 degC'",
    "Pa": "'3 MPa'",
    "s": "'1 ms'",
    "Hz": "'10 Hz'",
    "rad/s": "'10 rad/s'",
    "delta_degC": "'10 K'",
}

CELSIUS_ZERO = 273.15  # K


@lru_cache(maxsize=1)
def registry() -> pint.UnitRegistry[Any]:
    """Return the one pint registry that viscofric uses (made at first need)."""
    import pint

    return pint.UnitRegistry(autoconvert_offset_to_baseunit=True)


def _wrong(name: str, value: object, unit: str, reason: str) -> InputError:
    example = _EXAMPLE.get(unit, f"a quantity in {unit}")
    return InputError(f"{name} = {value!r}: {reason}; right would be, for instance, {example}.")


def conversion(text: str, unit: str, name: str = "unit") -> tuple[float, float]:
    """Return ``(factor, offset)`` so that ``SI = factor * number + offset`` for a unit's text.

    Parameters
    ----------
    text : str
        A unit as written in a file's header: ``"MPa"``, ``"°C"``, ``"Hz"``.
    unit : str
        The SI unit wanted.
    name : str
        What it is the unit of, for the error message.

    Raises
    ------
    InputError
        If the text is not a unit, or not one of the right dimension.
    """
    zero, one = (to_si(_quantity(number, text, unit, name), unit, name) for number in (0.0, 1.0))
    return one - zero, zero


def _quantity(number: float, text: str, unit: str, name: str) -> pint.Quantity[Any]:
    try:
        return registry().Quantity(number, registry().Unit(_plain(text)))
    except Exception as error:  # pint raises many kinds; all mean the same to the user
        raise _wrong(name, text, unit, f"{text!r} is not a unit that is known") from error


def _plain(text: str) -> str:
    """Write the degree and micro signs that instruments print in the way pint reads them."""
    text = text.strip().replace("µ", "u").replace("μ", "u").replace("²", "**2").replace("·", "*")
    return text.replace("°C", "degC").replace("°F", "degF").replace("°K", "K")


def to_si(value: Quantity, unit: str, name: str = "value") -> float:
    """Convert one value to a float in an SI unit.

    Parameters
    ----------
    value : float, str or pint.Quantity
        Plain numbers are taken to be in `unit` already.
    unit : str
        The SI unit: ``"m"``, ``"m/s"``, ``"N"``, ``"Pa"``, ``"K"`` (absolute temperature), ``"s"`` …
    name : str
        What the value is, for the error message.

    Returns
    -------
    float

    Raises
    ------
    InputError
        If the text cannot be understood, has no unit or the wrong one, or is not finite.
    """
    if isinstance(value, str):
        number = _parse(value, unit, name)
    elif hasattr(value, "to") and hasattr(value, "magnitude"):
        number = _convert(value, value, unit, name)
    else:
        try:
            number = float(value)
        except (TypeError, ValueError):
            raise _wrong(name, value, unit, "is not a number with a unit") from None
    if not np.isfinite(number):
        raise _wrong(name, value, unit, "is not a finite number")
    return number


def _parse(text: str, unit: str, name: str) -> float:
    try:
        parsed = registry().parse_expression(_plain(text))
    except Exception as error:  # pint raises many kinds; all mean the same to the user
        raise _wrong(name, text, unit, "cannot be read as a number with a unit") from error
    if not hasattr(parsed, "to"):
        raise _wrong(name, text, unit, "has no unit")
    return _convert(parsed, text, unit, name)


def _convert(quantity: Any, shown: object, unit: str, name: str) -> float:
    import pint

    try:
        return float(quantity.to(unit).magnitude)
    except pint.DimensionalityError:
        raise _wrong(name, str(shown), unit, f"has the wrong kind of unit ({quantity.units})") from None
    except (TypeError, ValueError, pint.PintError) as error:
        raise _wrong(name, str(shown), unit, "cannot be read as a number with a unit") from error


def to_si_array(values: Quantities, unit: str, name: str = "value") -> NDArray[np.float64]:
    """Convert one or many values to a 1-D float array in an SI unit; see `to_si`."""
    if isinstance(values, str) or np.isscalar(values):
        return np.array([to_si(values, unit, name)])  # type: ignore[arg-type]
    if hasattr(values, "to") and hasattr(values, "magnitude"):
        values = np.atleast_1d(values.to(unit).magnitude)
    return np.array([to_si(value, unit, name) for value in values])  # type: ignore[union-attr, arg-type]


def positive(value: Quantity, unit: str, name: str) -> float:
    """Convert like `to_si` and insist on a value above zero."""
    number = to_si(value, unit, name)
    if number <= 0.0:
        raise _wrong(name, value, unit, "must be above zero")
    return number


def celsius(kelvin: float) -> float:
    """Turn kelvin into degrees Celsius."""
    return kelvin - CELSIUS_ZERO
