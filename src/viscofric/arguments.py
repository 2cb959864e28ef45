"""Validation of numbers, flags and text given to public names, in one place, so that nothing is lost silently.

Quantities with units are converted in `viscofric.units`, which uses this module for their numbers.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from decimal import Decimal
from numbers import Integral, Real
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import InputError, brief, wrong_argument
from viscofric.notes import Note, note_of

#: Letter of a NumPy kind other than real numbers -> its name.
_KINDS = {
    "c": "complex numbers, whose imaginary part would be lost",
    "b": "True or False",
    "U": "text",
    "S": "bytes",
    "M": "dates",
    "m": "durations",
    "V": "records",
    "T": "text",
}
#: Largest number of points per decade of a spectrum, far above any measurement's resolution.
MOST_PER_DECADE = 10_000
#: Largest count or seed.
LARGEST_WHOLE = 2**63 - 1
#: Largest number, and smallest above zero: the cubes of others overflow, or are zero.
LARGEST, SMALLEST = 1e100, 1e-100
#: Larger arrays are refused before allocation: 16384² values take 2 GiB, and a computation a dozen such arrays.
MOST_VALUES = 2**28


def numbers(values: object, name: str, *, infinite: bool = False, missing: bool = False) -> Array:
    """Return one number or many as floats, in their shape; an array of floats that are all usable is not copied.

    Numbers nearer to zero than `SMALLEST` are zero.  `infinite` and `missing` allow infinite numbers and NaN.  Complex,
    masked or other values are an `InputError`.
    """
    try:
        found = real(values)
    except ValueError as error:
        raise wrong_argument(
            name, values, f"must be an array of numbers, but contains {error}.", "not-a-number"
        ) from None
    finite = np.isfinite(found)
    if not finite.all():
        allowed = finite | (np.isinf(found) & infinite) | (np.isnan(found) & missing)
        if not allowed.all():
            wrong = float(found[~allowed].flat[0])
            raise wrong_argument(name, values, f"must hold finite numbers; {wrong} cannot be used.", "not-a-number")
    size = np.abs(found)
    beyond = finite & (size > LARGEST)
    if beyond.any():
        wrong = float(found[beyond].flat[0])
        raise wrong_argument(name, values, f"holds {wrong:g}, too large for computations ({LARGEST:g}).", "too-large")
    vanishing = (size < SMALLEST) & (size > 0.0)
    return np.where(vanishing, 0.0, found) if vanishing.any() else found


def real(values: object) -> Array:
    """Return numbers as floats in their shape, NaN and infinite ones too; `ValueError` names other values."""
    if type(values) is np.ndarray and values.dtype == np.float64:
        return values
    if type(values) is float:
        return np.asarray(values)
    several = values if isinstance(values, (list, tuple)) else (values,)
    if any(isinstance(one, np.ma.MaskedArray) and np.ma.is_masked(one) for one in several):
        raise ValueError("a masked value")
    if any(hasattr(one, "magnitude") and hasattr(one, "to") for one in several):
        raise ValueError("a unit where plain numbers are needed")
    try:
        array = np.asarray(values)
    except (TypeError, ValueError, OverflowError):
        raise ValueError("not one number in each place") from None
    if array.dtype.kind == "O":
        return np.array([_float(one) for one in array.flat], dtype=float).reshape(array.shape)
    if array.dtype.kind not in "fiu":
        raise ValueError(_KINDS.get(array.dtype.kind, f"{array.dtype}"))
    return array.astype(np.float64)


def _float(value: object) -> float:
    """Convert a number of a type without a NumPy kind to a float."""
    if not isinstance(value, (Real, Decimal)) or isinstance(value, bool):
        raise ValueError(_KINDS["c"] if isinstance(value, complex) else f"{brief(value)}, which is not a number")
    try:
        return float(value)
    except OverflowError:
        raise ValueError("a number too large for a float") from None


def whole_number(value: object, name: str, least: int, most: int | None = None, right: str = "") -> int:
    """Return a whole number that is neither too small nor too large; `right` says in words what it must be."""
    whole = isinstance(value, Integral) and not isinstance(value, (bool, np.bool_, np.timedelta64))
    if not whole or not least <= value <= (LARGEST_WHOLE if most is None else most):  # type: ignore[operator]
        limits = f", {least} or more" if most is None else f" from {least} to {most}"
        raise wrong_argument(name, value, f"must be {right or f'a whole number{limits}'}.", "not-a-whole-number")
    return int(value)  # type: ignore[call-overload, no-any-return]


def flag(value: object, name: str) -> bool:
    """Return True or False, and refuse other values that Python accepts as truth values."""
    if not isinstance(value, (bool, np.bool_)):
        raise wrong_argument(name, value, "must be True or False.", "wrong-type")
    return bool(value)


def text(value: object, name: str) -> str:
    """Return a text, and refuse anything else."""
    if not isinstance(value, str):
        raise wrong_argument(name, value, "must be text.", "wrong-type")
    return value


def sentences(values: Iterable[str], name: str) -> tuple[Note, ...]:
    """Return several texts as notes; a single text is refused, rather than split into letters."""
    if not isinstance(values, (tuple, list)) or not all(isinstance(one, str) for one in values):
        raise wrong_argument(name, values, "must be a tuple of texts.", "wrong-type")
    return tuple(map(note_of, values))


def insist_on(value: object, name: str, *kinds: type, right: str = "") -> None:
    """Refuse a value of none of the kinds; `right` describes the right one in words."""
    if not isinstance(value, kinds):
        wanted = right or " or ".join(kind.__name__ for kind in kinds)
        raise wrong_argument(name, value, f"must be {wanted}.", "wrong-type")


def exactly_one(**given: object) -> str:
    """Return the name of the one argument that is given, which is not None; `InputError` unless it is one."""
    names = [name for name, value in given.items() if value is not None]
    if len(names) == 1:
        return names[0]
    if len(given) == 2:
        said = f"{' and '.join(given)}: {'both' if names else 'neither'} given"
    else:
        said = f"{', '.join(given)}: {' and '.join(names) or 'none of them'} given"
    raise InputError(f"{said}; give exactly one of them.", code="give-one")


def insist_on_function(value: object, name: str, *, needed: bool = False) -> None:
    """Refuse what cannot be called, except None if no function is needed."""
    if not (callable(value) or (value is None and not needed)):
        raise wrong_argument(name, value, "must be a function.", "wrong-type")


def check_cost(sizes: Iterable[Any], name: str) -> None:
    """Refuse an array of these sizes before allocation if no memory holds it."""
    count = math.prod(sizes)
    if not count <= MOST_VALUES:
        shown = f"{count:.2g}" if count < 1e300 else "more than 1e300"
        raise InputError(f"{name} would have {shown} points; the limit is {MOST_VALUES:.2g}.", code="too-many-points")
