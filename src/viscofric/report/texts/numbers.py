"""Numbers for readers: a few significant digits, a true minus sign, a dash where there is none."""

from __future__ import annotations

import math

from viscofric.units import shown_celsius, shown_number

ABSENT = "–"
_PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))
#: A relative error below it is rounding.
_ROUND_OFF = 1e-12
_SPACE = "\N{NO-BREAK SPACE}"
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def significant(value: float, digits: int = 3) -> str:
    """Return a number with so many significant digits; very large and very small ones as 1.23 × 10⁻⁵."""
    if not math.isfinite(value):
        return ABSENT
    if value == 0.0:
        return "0"
    mantissa, power = f"{value:.{digits - 1}e}".split("e")
    exponent = int(power)
    if -4 <= exponent < 6:
        return shown_number(float(f"{value:.{digits - 1}e}"), f".{max(0, digits - 1 - exponent)}f")
    mantissa = shown_number(float(mantissa), f".{digits - 1}f")
    return f"{mantissa}{_SPACE}×{_SPACE}10{str(exponent).translate(_RAISED)}"


def short(value: float, digits: int = 4) -> str:
    """Return a number for running text: at most so many digits, no zeros at the end."""
    text = significant(value, digits)
    return text.rstrip("0").rstrip(".") if "." in text and "×" not in text else text


def percent(share: float, digits: int = 2) -> str:
    """Return a share as a percentage."""
    return ABSENT if not math.isfinite(share) else f"{significant(100.0 * share, digits)}{_SPACE}%"


def signed_percent(share: float) -> str:
    """Return a relative difference as a percentage with its sign and one decimal."""
    if not math.isfinite(share):
        return ABSENT
    rounded = round(100.0 * share, 1)
    return f"{shown_number(rounded, '+.1f') if rounded else '0.0'}{_SPACE}%"


def with_error(value: float, error: float) -> str:
    """Return a value to the digits that its error leaves: 10.04 ± 0.05."""
    if not math.isfinite(value):
        return ABSENT
    if not math.isfinite(error) or error <= 0.0:
        return significant(value, 4)
    decimals = max(0, 1 - math.floor(math.log10(error)))
    if decimals > 9:
        return f"{significant(value, 6)} ± {significant(error, 2)}"
    return f"{shown_number(value, f'.{decimals}f')} ± {error:.{decimals}f}"


def prefixed(value: float, error: float | None, unit: str, power: int = 1) -> str:
    """Return a number with its error and its unit, in the prefix that suits its size."""
    size = abs(value)
    # An area is written with decimals rather than in hundred thousands of a smaller unit.
    least = 1.0 if power == 1 else 0.1
    fits = ((factor, prefix) for factor, prefix in _PREFIXES if size >= least * factor**power)
    factor, prefix = next(fits, (1.0, "") if size == 0.0 else _PREFIXES[-1])
    scale = factor**power
    raised = {1: "", 2: "²"}[power]
    if error is None or not error > _ROUND_OFF * size:
        return f"{short(value / scale)} {prefix}{unit}{raised}"
    return f"{with_error(value / scale, error / scale)} {prefix}{unit}{raised}"


def length(metres: float, error: float | None = None) -> str:
    """Return a length in nm, µm, mm or m."""
    return prefixed(metres, error, "m")


def megapascals(pascals: float, digits: int = 3) -> str:
    """Return a modulus or pressure with its unit: MPa, or GPa from a thousand of them on."""
    if abs(pascals) >= 1e9:
        return f"{significant(pascals / 1e9, digits)}{_SPACE}GPa"
    return f"{significant(pascals / 1e6, digits)}{_SPACE}MPa"


def speed(metres_per_second: float, digits: int = 3) -> str:
    """Return a speed with its unit: mm/s, or m/s from 1 m/s on."""
    return " ".join(_speed(metres_per_second, digits))


def speeds(lowest: float, highest: float) -> str:
    """Return a range of speeds (m/s): 20 to 200 mm/s, 0.1 mm/s to 10 m/s."""
    (low, unit), (high, last) = _speed(lowest), _speed(highest)
    if (low, unit) == (high, last):
        return f"{low} {unit}"
    return f"{low} to {high} {unit}" if unit == last else f"{low} {unit} to {high} {last}"


def _speed(metres_per_second: float, digits: int = 3) -> tuple[str, str]:
    if metres_per_second >= 0.99995:
        return short(metres_per_second, digits), "m/s"
    return short(1e3 * metres_per_second, digits), "mm/s"


def unbroken(text: str) -> str:
    """Return a number with its unit so that no line breaks between them."""
    return text.replace(" ", _SPACE)


def several(texts: list[str]) -> str:
    """Join texts in words: a, b and c."""
    return " and ".join([", ".join(texts[:-1]), texts[-1]]) if len(texts) > 1 else "".join(texts)


def degrees(kelvin: float) -> str:
    """Return a temperature as figures and report print it: −30 °C, 22.5 °C."""
    return f"{shown_celsius(kelvin).removesuffix('.0')} °C"
