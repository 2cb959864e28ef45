"""Validation of tables of horizontal and vertical shifts; shifts as plain records."""

from __future__ import annotations

import inspect
from dataclasses import fields
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.arguments import numbers
from viscofric.errors import InputError
from viscofric.units import to_si_array

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.units import Quantities


def checked_columns(
    what: str, temperatures: Quantities, log10_values: Any, covariance: Any
) -> tuple[Array, Array, Array]:
    """Return temperatures (n,) in K, values (n,) and their covariance (n, n), zero if none is given.

    Raises InputError if shapes differ, a number is not finite, or the (at least two) temperatures do not ascend;
    `what` names the values there, in the plural.
    """
    kelvin = to_si_array(temperatures, "K", "temperatures")
    values = np.array(numbers(log10_values, what))
    if kelvin.size < 2 or values.shape != kelvin.shape:
        raise InputError(f"{what} need at least two temperatures, and one finite value for each.", code="wrong-length")
    if np.any(np.diff(kelvin) <= 0.0) or kelvin[0] <= 0.0:
        raise InputError(
            f"temperatures of {what} must ascend without repeats, above absolute zero.", code="not-ascending"
        )
    if covariance is None:
        return kelvin, values, np.zeros((kelvin.size, kelvin.size))
    return kelvin, values, checked_covariance(covariance, kelvin.size, what)


def checked_covariance(values: Any, size: int, what: str) -> Array:
    """Return a validated copy of the covariance (size, size); `what` names the values in errors."""
    covariance = np.array(numbers(values, f"covariance of {what}"))
    if covariance.shape != (size, size) or np.any(np.diag(covariance) < 0.0):
        raise InputError(
            f"covariance of {what} must be {size} × {size} numbers, no variance below zero.", code="not-positive"
        )
    return covariance


def as_record(value: Any) -> dict[str, Any]:
    """Return a frozen dataclass as its class's name (``kind``) and the constructor's arguments that it keeps."""
    return {"kind": type(value).__name__} | {name: getattr(value, name) for name in kept_arguments(type(value))}


def kept_arguments(one: type) -> tuple[str, ...]:
    """Names that the constructor of a dataclass takes and the object keeps."""
    kept = {field.name for field in fields(one)}
    return tuple(name for name in inspect.signature(one).parameters if name in kept)
