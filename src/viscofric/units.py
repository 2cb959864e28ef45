"""Units at the interfaces: text, numbers or pint quantities in, SI floats and arrays out.

Plain numbers are SI (temperatures in kelvin).  Text is one plain number and one unit, such as ``"100 mm/s"`` or
``"30 degC"``; it is never evaluated.  pint quantities carry their own unit, as do arrays of xarray
(``attrs["units"]``).  pint itself receives only the text of the unit, and is imported only for units that are not among
the most common ones, since that takes as long as solving many contacts.
"""

from __future__ import annotations

import math
import re
from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeAlias, cast

import numpy as np

from viscofric.arguments import LARGEST, SMALLEST, insist_on, numbers, real
from viscofric.errors import InputError, ViscofricError, not_imported, wrong_argument
from viscofric.notes import Remedy

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pint
    from numpy.typing import ArrayLike

    from viscofric.arrays import Array

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
    "rad": "'5 deg'",
    "rad/s": "'10 rad/s'",
    "delta_degC": "'10 K'",
    "J/mol": "'120 kJ/mol'",
    "byte": "'8 GB'",
    "kg": "'33 g'",
    "m/s**2": "'9.81 m/s**2'",
    "dimensionless": "the plain number 0.5",
}

#: SI unit -> common notations with the factor to it, which are read without pint, and suggested for other capitals.
_COMMON = {
    "m": {"nm": 1e-9, "um": 1e-6, "mm": 1e-3, "cm": 1e-2, "m": 1.0, "km": 1e3},
    "N": {"mN": 1e-3, "N": 1.0, "kN": 1e3},
    "N/m": {"N/m": 1.0, "N/mm": 1e3, "kN/m": 1e3},
    "m/s": {"mm/s": 1e-3, "m/s": 1.0, "um/s": 1e-6},
    "K": {"degC": 1.0, "degF": 5.0 / 9.0, "K": 1.0},
    "Pa": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9},
    "s": {"s": 1.0, "ms": 1e-3, "us": 1e-6},
    "Hz": {"Hz": 1.0, "kHz": 1e3, "MHz": 1e6},
    "rad/s": {"rad/s": 1.0},
    "delta_degC": {"K": 1.0},
    "J/mol": {"J/mol": 1.0, "kJ/mol": 1e3},
}
#: Letters that pint reads as coulomb and farad.
_DEGREES = {"c": "degC", "f": "degF"}

#: In the names of units of angles, for frequencies.
_ANGLES = ("radian", "revolution", "turn", "degree")

CELSIUS_ZERO = 273.15  # K
_ZERO = {"degC": CELSIUS_ZERO, "degF": CELSIUS_ZERO - 160.0 / 9.0}
#: No rubber is measured below this; a plain number there was probably meant in degrees Celsius.
COLDEST_PLAUSIBLE = 150.0  # K

_NUMBER = re.compile(r"(?P<number>[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)\s*(?P<unit>.*)")
_DECIMAL_COMMA = re.compile(
    r"(?P<whole>[+-]?[0-9]*),(?P<part>[0-9]+(?:[eE][+-]?[0-9]+)?)\s*(?P<unit>[^0-9,.+\s][^,]*|)"
)
_PARTED = re.compile(
    r"(?P<number>[+-]?[0-9]{1,3}(?:(?P<mark>[ ,'’\u00a0\u202f])[0-9]{3})+(?:\.[0-9]+)?)\s*(?P<unit>[^0-9,.\s][^,]*|)"
)
#: "mPas", "Ns": products with the second, in which pint would see the plurals of pascal and newton.
_TIMES_SECOND = re.compile(r"(?<![^\W\d_])((?:[cdhkmnuGMT]|da)?(?:Pa|N|Hz|J|K))s(?![^\W_])")
# A unit is names with single-digit exponents, multiplied and divided; pint gets nothing else to evaluate.
_LONGEST_UNIT = 40
_TERM = r"[^\W\d]+(?:\s?(?:\*\*|\^)\s?(?:-?[0-9]|\(-?[0-9]\))|⁻?[¹²³])?(?![0-9⁻¹²³^])"
_JOIN = r"(?:\s?[*/]\s?|\s)"
_GROUP = rf"\({_TERM}(?:{_JOIN}{_TERM})*\)"
_UNIT = re.compile(rf"(?:1\s?/\s?)?(?:{_TERM}|{_GROUP})(?:{_JOIN}(?:{_TERM}|{_GROUP}))*")


@lru_cache(maxsize=1)
def registry() -> pint.UnitRegistry[Any]:
    """Return viscofric's pint registry, made at first use."""
    try:
        import pint

        return pint.UnitRegistry(autoconvert_offset_to_baseunit=True)
    except Exception as error:  # pint imports other packages, and files of the user with such names
        raise ViscofricError(f"units cannot be read: {not_imported('pint', error)}.", code="unreadable") from error


def _wrong(code: str, name: str, value: object, unit: str, reason: str, right: str = "") -> InputError:
    right = right or f"write, for example, {_EXAMPLE.get(unit, f'a quantity in {unit}')}"
    return wrong_argument(name, value, f"{reason}; {right}.", code)


def conversion(text: str, unit: str, name: str = "unit") -> tuple[float, float]:
    """Return ``(factor, offset)`` of ``SI = factor * number + offset`` for a unit as in a file's header."""
    insist_on(text, name, str, right="the text of a unit, such as 'MPa'")
    zero, one = (_of_unit(number, text, text, unit, name) for number in (0.0, 1.0))
    return one - zero, zero


def _of_unit(number: float, text: str, shown: str, unit: str, name: str) -> float:
    """Convert a number of the unit that a text names."""
    plain = _plain(text)
    if plain in (common := _COMMON.get(unit, {})):
        return common[plain] * number + _ZERO.get(plain, 0.0)
    units, right = registry(), _meant(shown, text, unit)
    try:
        if len(plain) > _LONGEST_UNIT or not _UNIT.fullmatch(plain):
            raise ValueError(plain)
        quantity = units.Quantity(number, units.Unit(plain))
    except Exception as error:  # pint raises many kinds
        raise _wrong("unknown-unit", name, shown, unit, f"{text!r} is not a known unit", right) from error
    return _convert(quantity, shown, unit, name, right)


def _plain(text: str) -> str:
    """Replace the degree, micro, product and percent signs of instruments by those that pint reads."""
    text = text.strip().replace("µ", "u").replace("μ", "u").replace("·", "*").replace("℃", "°C").replace("%", "percent")
    text = re.sub(r"(?<=[^\W\d])\.(?=[^\W\d])", "*", text)
    text = _TIMES_SECOND.sub(r"\1*s", text)
    return text.replace("°C", "degC").replace("°F", "degF").replace("°K", "K")


def _meant(shown: str, text: str, unit: str) -> str:
    """Suggest the one common unit that differs only in its capitals."""
    plain = _plain(text).replace("°", "deg").casefold()
    near = [one for one in _COMMON.get(unit, {}) if one.casefold() == plain]
    if unit == "K" and plain in _DEGREES:
        near = [_DEGREES[plain]]
    if len(near) != 1 or not shown.endswith(text):
        return ""
    return f"write {shown[: len(shown) - len(text)] + near[0]!r}"


def _stated_unit(values: object) -> str:
    """Return the unit that an array of xarray or pandas states in its attributes; "" where there is none, or 1."""
    attributes = getattr(values, "attrs", None)
    unit = attributes.get("units", "") if isinstance(attributes, dict) else ""
    return str(unit) if unit not in ("", "1", 1) else ""


def _unlabelled(values: Any, unit: str, name: str) -> Any:
    """Return an array that states its unit as plain numbers in SI, and anything else as it is."""
    stated = _stated_unit(values)
    if not stated or np.asarray(values).dtype.kind not in "fiu":
        return values
    factor, zero = conversion(stated, unit, name)
    return np.asarray(factor * np.asarray(values, dtype=float) + zero)


def to_si(value: Quantity, unit: str, name: str = "value") -> float:
    """Convert one value to a float in an SI unit; plain numbers are in `unit` already.

    A value nearer to zero than `viscofric.arguments.SMALLEST` is zero.
    """
    number = _in_si(value, unit, name)
    return number if abs(number) >= SMALLEST else 0.0


def as_printed(value: Quantity, name: str) -> float:
    """Return a pure number that is compared with those of a file, and so may be of any size."""
    return _in_si(value, "dimensionless", name, largest=np.inf)


def _in_si(value: Quantity, unit: str, name: str, largest: float = LARGEST) -> float:
    """Return a value in an SI unit, finite and not too large for computations."""
    if isinstance(value, float) and abs(value) <= LARGEST:  # as in each step of a fit, where the rest takes most time
        return float(value)
    value = _unlabelled(value, unit, name)
    if isinstance(value, str):
        number = _parse(value, unit, name)
    elif hasattr(value, "to") and hasattr(value, "magnitude"):
        number = _convert(value, value, unit, name)
    else:
        try:
            number = _single(value)
        except ValueError as error:
            kind = "a number" if unit == "dimensionless" else "a number with a unit"
            raise _wrong("not-a-number", name, value, unit, f"is not {kind} but {error}") from None
    if not np.isfinite(number):
        raise _wrong("not-finite", name, value, unit, "is not a finite number")
    if abs(number) > largest:
        raise _wrong("too-large", name, value, unit, f"is beyond {LARGEST:g}, too large for computations")
    return number


def _single(value: object) -> float:
    """Return one real number as a float; `ValueError` names what else it is."""
    found = real(value)
    if found.ndim:
        raise ValueError("several")
    return float(found)


def _parse(text: str, unit: str, name: str) -> float:
    """Read one plain number and one unit."""
    match = _NUMBER.fullmatch(text.strip().replace("−", "-"))
    if match and match["unit"] and _UNIT.fullmatch(_plain(match["unit"])):
        return _of_unit(float(match["number"]), match["unit"], text.strip(), unit, name)
    if match and not match["unit"]:
        if unit == "dimensionless":
            return float(match["number"])
        raise _wrong("no-unit", name, text, unit, "has no unit")
    raise _not_a_quantity(text, unit, name)


def _not_a_quantity(text: str, unit: str, name: str) -> InputError:
    """Return the error of a text that is not one number and one unit."""
    plain = text.strip()
    if not plain:
        return _wrong("empty", name, text, unit, "is empty")
    example = _EXAMPLE.get(unit, "").strip("'").partition(" ")[2]
    usual = "" if unit == "dimensionless" else example  # where no unit is written
    if parted := _PARTED.fullmatch(plain):
        whole = f"{re.sub(r'[^0-9.+-]', '', parted['number'])} {parted['unit'] or usual}".rstrip()
        if parted["mark"] != "," or "." in parted["number"] or parted["number"].count(",") > 1:
            return _wrong("thousands-separators", name, text, unit, "has thousands separators", f"write {whole!r}")
    if comma := _DECIMAL_COMMA.fullmatch(plain):
        decimal = f"{comma['whole'] or '0'}.{comma['part']} {comma['unit'] or usual}".rstrip()
        write = "write" if comma["unit"] or not usual else "write, for example,"
        also = f", or {whole!r} if it separates thousands" if parted else ""
        return _wrong("decimal-comma", name, text, unit, "has a decimal comma", f"{write} {decimal!r}{also}")
    if _UNIT.fullmatch(_plain(plain)) and len(plain) <= _LONGEST_UNIT:
        return _wrong("no-number", name, text, unit, "has no number")
    kind = "one plain number" if unit == "dimensionless" else "one plain number followed by one unit"
    return _wrong("not-a-number", name, text, unit, f"is not {kind}")


def _convert(quantity: Any, shown: object, unit: str, name: str, right: str = "") -> float:
    import pint

    try:
        # pint would convert temperature differences to temperatures and the reverse.
        units = [str(key) for key, _ in quantity.unit_items()]
        if unit == "K" and any(one.startswith("delta_") for one in units):
            raise _wrong(
                "temperature-difference",
                name,
                str(shown),
                unit,
                "is a temperature difference where a temperature is needed",
            )
        if unit == "delta_degC" and units in (["degree_Celsius"], ["degree_Fahrenheit"], ["degree_Reaumur"]):
            raise _wrong(
                "not-a-temperature-difference",
                name,
                str(shown),
                unit,
                "is a temperature where a temperature difference is needed",
            )
        return _single(quantity.to(unit).magnitude) * _turns(units, unit, str(shown), name)
    except pint.DimensionalityError:
        reason = f"has the wrong kind of unit ({quantity.units})"
        if unit == "dimensionless":
            reason = f"has a unit ({quantity.units}), but must be a pure number"
        raise _wrong("wrong-unit", name, str(shown), unit, reason, right) from None
    except InputError:
        raise
    except (TypeError, ValueError, OverflowError, AttributeError, pint.PintError) as error:
        raise _wrong("not-a-number", name, str(shown), unit, "cannot be read as a number with a unit") from error


def _turns(units: list[str], unit: str, shown: str, name: str) -> float:
    """Return the factor of a frequency that pint leaves out, which treats the radian as a pure number."""
    hertz = any(one.endswith("hertz") for one in units)
    angle = any(word in one for one in units for word in _ANGLES)
    if unit == "rad/s" and not hertz and not angle:
        raise _wrong("wrong-unit", name, shown, "Hz", "must be a frequency in Hz or rad/s")
    if unit == "rad/s" and hertz:
        return 2.0 * math.pi
    return 0.5 / math.pi if unit == "Hz" and angle else 1.0


def to_si_array(values: Quantities, unit: str, name: str = "value") -> Array:
    """Convert one or many values to a 1-D float array in an SI unit; see `to_si`."""
    values = _unlabelled(values, unit, name)
    if isinstance(values, str) or np.isscalar(values):
        return np.array([to_si(values, unit, name)])  # type: ignore[arg-type]
    if hasattr(values, "to") and hasattr(values, "magnitude"):
        if np.ndim(values.magnitude) == 0:
            return np.array([to_si(values, unit, name)])  # type: ignore[arg-type]
        return np.array([to_si(value, unit, name) for value in values])  # type: ignore[union-attr, arg-type]
    try:
        if isinstance(values, (bytes, dict, set)):
            raise TypeError
        each = list(values)  # type: ignore[arg-type]
    except TypeError:
        raise _wrong("not-a-number", name, values, unit, "is not a number with a unit, or a list of these") from None
    return np.array([to_si(value, unit, name) for value in each])


def to_si_in_shape(values: Quantities, unit: str, name: str) -> Array:
    """Convert one or many values to floats in an SI unit, in the shape in which they are given; see `to_si`."""
    values = _unlabelled(values, unit, name)
    if isinstance(values, np.ndarray) and values.dtype.kind in "fiu":
        return numbers(values, name)
    if isinstance(values, (list, tuple)) or np.ndim(values) > 0:
        rows = [to_si_in_shape(value, unit, name) for value in values]  # type: ignore[union-attr]
        if len({row.shape for row in rows}) > 1:
            raise _wrong("row-length", name, values, unit, "has rows of different lengths")
        return np.array(rows, dtype=float)
    return np.asarray(to_si(values, unit, name))  # type: ignore[arg-type]


def in_si(values: object, unit: str, name: str, *, infinite: bool = False, missing: bool = False) -> Array:
    """Return one number or many in their shape: plain ones as they are, text and quantities in an SI unit.

    `infinite` and `missing` allow infinite numbers and NaN among plain ones; see `viscofric.arguments.numbers`.
    """
    values = _unlabelled(values, unit, name)
    if _has_units(values):
        return to_si_in_shape(cast("Quantities", values), unit, name)
    return numbers(values, name, infinite=infinite, missing=missing)


def in_either(values: object, units: Sequence[str], name: str) -> tuple[Array, str]:
    """Return one number or many in SI, and the unit that they have, one of some; plain ones as they are, without one.

    Raises InputError where they have none of the units, or not all the same.
    """
    if not _has_units(values):
        return numbers(values, name, infinite=True, missing=True), ""
    for unit in units[:-1]:
        try:
            return to_si_in_shape(cast("Quantities", values), unit, name), unit
        except InputError as error:
            if error.code != "wrong-unit":
                raise
    return to_si_in_shape(cast("Quantities", values), units[-1], name), units[-1]


def _has_units(values: object) -> bool:
    if isinstance(values, np.ndarray):
        return values.dtype.kind == "U" or (values.dtype.kind == "O" and any(map(_has_units, values.flat)))
    if isinstance(values, (list, tuple)):
        return any(map(_has_units, values))
    is_quantity = hasattr(values, "to") and hasattr(values, "magnitude")
    return is_quantity or isinstance(values, str) or bool(_stated_unit(values))


def positive(value: Quantity, unit: str, name: str) -> float:
    """Convert like `to_si` and insist on a value above zero, or above absolute zero."""
    number = _in_si(value, unit, name)
    if number <= 0.0:
        least = "absolute zero" if unit == "K" else "zero"
        raise _wrong("not-positive", name, value, unit, f"must be above {least}")
    if number < SMALLEST:
        raise _wrong("too-small", name, value, unit, f"is below {SMALLEST:g}, too small for computations")
    return number


def number(value: Quantity, name: str) -> float:
    """Convert like `to_si` a pure number, such as 0.05 or "5 %"."""
    return to_si(value, "dimensionless", name)


def share(value: Quantity, name: str, *, example: float) -> float:
    """Convert like `to_si` and insist on a pure number between 0 and 1, such as the example."""
    found = number(value, name)
    if not 0.0 < found < 1.0:
        raise wrong_argument(name, value, f"must lie between 0 and 1, such as {example:g}.", "out-of-range")
    return found


def checked_poisson_ratio(value: Quantity, name: str = "poisson_ratio", *, above: float | None = None) -> float:
    """Convert like `to_si` and insist on a Poisson ratio from 0 to 0.5, or from above another least value."""
    found = number(value, name)
    if not (found >= 0.0 if above is None else found > above) or found > 0.5:
        limits = "lie between 0 and 0.5" if above is None else f"be above {above:g} and at most 0.5"
        raise wrong_argument(name, value, f"must {limits}.", "poisson-ratio")
    return found


def angular_frequency(value: Quantity, name: str) -> float:
    """Return an angular frequency in rad/s; a value in hertz is multiplied by 2π, plain numbers are in rad/s."""
    return positive(value, "rad/s", name)


def two_lengths(value: Quantity | tuple[Quantity, Quantity]) -> tuple[float, float]:
    """Return a spacing along x and y, above zero, m; a single length stands for both."""
    pair = value if isinstance(value, (tuple, list)) else (value, value)
    if len(pair) != 2:
        raise wrong_argument("spacing", value, "must be one length or two, those of x and y.", "wrong-count")
    return positive(pair[0], "m", "spacing"), positive(pair[1], "m", "spacing")


def velocity(value: Quantity) -> float:
    """Convert like `to_si`, but accept infinite speeds, one of the elastic limits."""
    if isinstance(value, float) and math.isinf(value):
        return value
    return to_si(value, "m/s", "speed")


def checked_modes(strengths: object, name: str, unit: str, tau: object) -> tuple[Array, Array]:
    """Return the strengths of modes, called `name`, and their times, s: read-only copies (n,), none below zero."""
    columns = []
    for values, called, of in ((strengths, name, unit), (tau, "tau", "s")):
        column = np.atleast_1d(np.array(in_si(values, of, called)))
        if column.ndim != 1:
            raise InputError(f"{called} must be one row of finite numbers in {of}, one per mode.", code="not-a-number")
        column.flags.writeable = False
        columns.append(column)
    sizes, times = columns
    if sizes.shape != times.shape:
        raise InputError(
            f"{name} and tau must be as many: there are {len(sizes)} and {len(times)}.", code="wrong-length"
        )
    if np.any(sizes < 0.0) or np.any(times <= 0.0):
        raise InputError(
            f"{name} must not be below zero and tau must be above zero in every mode.", code="not-positive"
        )
    return sizes, times


def celsius(kelvin: float) -> float:
    """Convert kelvin to degrees Celsius."""
    return kelvin - CELSIUS_ZERO


def shown_number(number: float, form: str) -> str:
    """Return a number in a format of Python, with a true minus sign."""
    text = f"{number:{form}}"
    return f"−{text[1:]}" if text.startswith("-") else text


def shown_celsius(kelvin: float, form: str = "z.1f") -> str:
    """Return a temperature in degrees Celsius for a sentence, without the unit: −30.0."""
    return shown_number(celsius(kelvin), form)


def kelvin_hint(kelvin: float) -> Remedy:
    """Return the end of a sentence: for Python, a hint where a plain number was probably meant in degrees Celsius."""
    if kelvin >= COLDEST_PLAUSIBLE:
        return Remedy(".")
    # Commands, run files and the page take temperatures with their unit only.
    return Remedy(f"; plain numbers are kelvin: for {kelvin:.4g} °C write '{kelvin:.4g} degC'.", ".", page=".")


def plain(number: float, digits: int = 4) -> str:
    """Return a number in the usual notation: at most so many significant digits, no power of ten up to a million."""
    rounded = float(f"{number:.{digits - 1}e}")
    return shown_number(rounded, ".0f" if 10**digits <= abs(rounded) < 1e6 else f".{digits}g")


def shown_place(kelvin: float, speed: float) -> str:
    """Return temperature and speed (m/s) of a contact with their units."""
    return f"{shown_celsius(kelvin, 'z.4g')} °C, {shown_speed(speed)}"


def shown_speed(speed: float, digits: int = 4) -> str:
    """Return a speed (m/s) with its unit: mm/s, or m/s from 1 m/s on."""
    return f"{plain(speed, digits)} m/s" if speed >= 0.99995 else f"{plain(1e3 * speed, digits)} mm/s"
