"""Numbers for readers: a few significant digits, a true minus sign, a dash where there is none."""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import partial

import numpy as np

from viscofric.arrays import Array
from viscofric.notes import codes
from viscofric.rheology.spectra.quality import DOUBTS
from viscofric.showing import ABSENT, prefixed, several, short, significant, with_error
from viscofric.units import shown_celsius, shown_number, shown_speed

__all__ = ["ABSENT", "prefixed", "several", "short", "significant", "with_error"]  # handed on

_SPACE = "\N{NO-BREAK SPACE}"
#: What the numbers after ± are, as name and value.
AFTER_PLUS_MINUS = ("after ±", "errors of the numerical solution, not of the material")


#: The same where values have no errors, but two digits.
TWO_DIGITS = ("two digits", "the material is in doubt, see the warnings")


def in_doubt(notes: Iterable[str]) -> bool:
    """Return whether a note says that a material contradicts what was measured: errors of solutions mean nothing."""
    return any(code.startswith(DOUBTS) for code in codes(notes))


def percent(share: float, digits: int = 2) -> str:
    """Return a share as a percentage."""
    return ABSENT if not math.isfinite(share) else f"{significant(100.0 * share, digits)}{_SPACE}%"


def signed_percent(share: float) -> str:
    """Return a relative difference as a percentage with its sign and one decimal."""
    if not math.isfinite(share):
        return ABSENT
    rounded = round(100.0 * share, 1)
    return f"{shown_number(rounded, '+.1f') if rounded else '0.0'}{_SPACE}%"


def length(metres: float, error: float | None = None) -> str:
    """Return a length in nm, µm, mm or m."""
    return prefixed(metres, error, "m")


def megapascals(pascals: float) -> str:
    """Return a modulus or pressure with its unit: MPa, or GPa from a thousand of them on."""
    if abs(pascals) >= 1e9:
        return f"{significant(pascals / 1e9)}{_SPACE}GPa"
    return f"{significant(pascals / 1e6)}{_SPACE}MPa"


#: Speed (m/s) with its unit: mm/s, or m/s from 1 m/s on.
speed = partial(shown_speed, digits=3)


def speeds(lowest: float, highest: float) -> str:
    """Return a range of speeds (m/s): 20 to 200 mm/s, 0.1 mm/s to 10 m/s."""
    low, high = speed(lowest), speed(highest)
    if low == high:
        return low
    number, _, unit = low.partition(" ")
    return f"{number if high.endswith(f' {unit}') else low} to {high}"


def spanned(numbers: Array, digits: int = 3) -> str:
    """Return the ends of the known ones of some numbers: 20 to 200, or one where both are the same."""
    return " to ".join(dict.fromkeys(short(float(end), digits) for end in (np.nanmin(numbers), np.nanmax(numbers))))


def unbroken(text: str) -> str:
    """Return a number with its unit so that no line breaks between them."""
    return text.replace(" ", _SPACE)


def degrees(kelvin: float) -> str:
    """Return a temperature as figures and report print it: −30 °C, 22.5 °C."""
    return f"{shown_celsius(kelvin).removesuffix('.0')} °C"
