"""The base of all shifts with temperature, 1 at a reference: units, checks, tables; shifts as plain records."""

from __future__ import annotations

import inspect
import math
from abc import ABC, abstractmethod
from dataclasses import fields, replace
from typing import Any, ClassVar, Self, TypeAlias, overload

import numpy as np

from viscofric.arguments import LARGEST, numbers
from viscofric.arrays import Array, Mask
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.notes import Remedy
from viscofric.showing import Plotted
from viscofric.units import (
    Quantities,
    Quantity,
    kelvin_hint,
    positive,
    shown_celsius,
    to_si,
    to_si_array,
    to_si_in_shape,
)

Temperatures: TypeAlias = Array | list[float] | list[str] | tuple[float, ...] | tuple[str, ...]


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
    kept = {field.name for field in fields(value)}
    arguments = (name for name in inspect.signature(type(value)).parameters if name in kept)
    return {"kind": type(value).__name__} | {name: getattr(value, name) for name in arguments}


GAS_CONSTANT = 8.31446261815324  # J/(mol K)
LN10 = math.log(10.0)
_MOST_DECADES = round(math.log10(LARGEST))  # beyond, no time of a spectrum can be shifted
#: Temperatures are nominal, and measured to a few tenths of a kelvin: factors measured at 59.98 °C are valid at 60 °C
#: too.
NOMINAL = 0.5  # K


class Shift(Plotted, ABC):
    """A function of temperature, 1 at the reference: units, shapes and checks; subclasses define its logarithm."""

    reference: float  # K

    @abstractmethod
    def _log10(self, kelvin: Array) -> Array:
        """Return log10 of the shift at temperatures that `_refuse` accepts."""

    def _refuse(self, kelvin: Array) -> None:
        """Raise `InputError` where the shift has no meaning, is not known, or must not be extrapolated."""

    def at_reference(self, reference: Quantity) -> Self:
        """Return the same shift, 1 at another temperature.

        Parameters
        ----------
        reference : float, str or pint.Quantity
            K if a plain number.

        Raises
        ------
        InputError
            If the shift is not valid there; see `log10`.
        """
        kelvin = positive(reference, "K", "reference")
        self._refuse(np.array([kelvin]))
        return self._about(kelvin)

    def _about(self, kelvin: float) -> Self:
        """Return the same shift about a temperature that `_refuse` accepts."""
        return replace(self, reference=kelvin)  # type: ignore[type-var]

    @overload
    def log10(self, temperature: Quantity) -> float: ...
    @overload
    def log10(self, temperature: Temperatures) -> Array: ...
    def log10(self, temperature: Any) -> Any:
        """Return log10 of the shift.

        Parameters
        ----------
        temperature : float, str, quantity, or an array or list of them
            Plain numbers are in K.

        Returns
        -------
        float or array
            In the shape of `temperature`.

        Raises
        ------
        InputError
            If a temperature is not above absolute zero, one where the shift has no meaning or is not known, or one too
            far from those that it was fitted on.
        """
        return in_shape(self._log10(self._accepted(temperature)))

    def _accepted(self, temperature: Any) -> Array:
        """Return temperatures, K, in their shape; InputError where the shift is not known."""
        kelvin = in_kelvin(temperature)
        self._refuse(np.atleast_1d(kelvin))
        return kelvin

    @overload
    def __call__(self, temperature: Quantity) -> float: ...
    @overload
    def __call__(self, temperature: Temperatures) -> Array: ...
    def __call__(self, temperature: Any) -> Any:
        """Return the shift, as `log10`; InputError also if it is beyond the range of floating-point numbers."""
        decades = self.log10(temperature)
        if np.any(np.abs(decades) > _MOST_DECADES):
            kelvin = float(np.ravel(in_kelvin(temperature))[np.argmax(np.abs(decades))])
            raise InputError(
                f"temperature = {shown_celsius(kelvin)} °C: the shift there is beyond {_MOST_DECADES} decades",
                code="out-of-range",
                remedy=kelvin_hint(kelvin),
            )
        return 10.0**decades


class ShiftTable(Shift):
    """A table of shifts with a covariance, interpolated by subclasses; valid up to half a kelvin beyond its ends."""

    temperatures: Array
    log10_values: Array
    covariance: Array
    #: How its ends are called in a sentence, and how to go beyond them.
    _beyond: ClassVar[tuple[str, Remedy]]

    def _set_table(
        self, what: str, temperatures: Quantities, log10_values: Any, reference: Quantity, covariance: Any
    ) -> None:
        """Set temperatures and values (n,), zero at the reference, and their covariance; `what` names the values."""
        kelvin, values = to_si_array(temperatures, "K", "temperatures"), np.array(numbers(log10_values, what))
        if kelvin.size < 2 or values.shape != kelvin.shape:
            raise InputError(
                f"{what} need at least two temperatures, and one finite value for each.", code="wrong-length"
            )
        if np.any(np.diff(kelvin) <= 0.0) or kelvin[0] <= 0.0:
            raise InputError(
                f"temperatures of {what} must ascend without repeats, above absolute zero.", code="not-ascending"
            )
        spread = np.zeros((kelvin.size, kelvin.size))
        if covariance is not None:
            spread = checked_covariance(covariance, kelvin.size, what)
        columns = {"temperatures": kelvin, "log10_values": values, "covariance": spread}
        for name, column in {**columns, "reference": positive(reference, "K", "reference")}.items():
            object.__setattr__(self, name, column)
        self._refuse(np.array([self.reference]))
        values -= float(self._log10(np.asarray(self.reference)))
        for column in columns.values():
            column.flags.writeable = False

    @property
    def standard_errors(self) -> Array:
        """Standard error of each log10 value, zero at a reference that was measured."""
        return np.sqrt(np.maximum(np.diag(self.covariance), 0.0))

    @abstractmethod
    def _weights(self, kelvin: Array) -> Array:
        """Return the weights (m, n) of the table's values in values at (m,) temperatures."""

    def _valid(self, kelvin: Array) -> Mask:
        low, high = self.temperatures[0] - NOMINAL, self.temperatures[-1] + NOMINAL
        return np.asarray((kelvin >= low) & (kelvin <= high))

    def _refuse(self, kelvin: Array) -> None:
        outside = kelvin[~self._valid(kelvin)]
        if not outside.size:
            return
        measured, further = self._beyond
        ends = map(shown_celsius, self.temperatures[[0, -1]])
        raise InputError(
            f"temperature = {shown_celsius(outside[0])} °C lies outside {measured.format(*ends)}",
            code="outside-measured",
            remedy=further + kelvin_hint(float(outside[0])),
        )

    def _standard_error(self, kelvin: Array) -> Array:
        """Return the standard error of linear interpolation, without the error of the interpolation itself."""
        weights = self._weights(np.ravel(kelvin))
        variance = np.einsum("ij,jk,ik->i", weights, self.covariance, weights)
        return np.asarray(np.sqrt(np.maximum(variance, 0.0)).reshape(np.shape(kelvin)))

    def _referenced(self, covariance: Array, kelvin: float) -> Array:
        """Return the covariance of values less that at a temperature, from that of the values."""
        change = np.eye(self.temperatures.size) - self._weights(np.array([kelvin]))
        return np.asarray(change @ covariance @ change.T)

    def _about(self, kelvin: float) -> Self:
        return replace(self, reference=kelvin, covariance=self._referenced(self.covariance, kelvin))  # type: ignore[type-var]


class ShiftLaw(Shift):
    """Shift factor α(T), 1 at the reference, such that E(ω, T) = E(α(T) ω, reference); it falls as T rises.

    Subclasses define log10 α, and `has_standard_error` where its uncertainty is known.
    """

    @abstractmethod
    def _standard_error(self, kelvin: Array) -> Array:
        """Return the standard error of log10 α at temperatures that `_refuse` accepts."""

    @property
    def has_standard_error(self) -> bool:
        """Whether the uncertainty of α(T) is known; False for constants that were typed in without a covariance."""
        return False

    @property
    def _divergence(self) -> float:
        """Temperature at which the law diverges, and below which it has no meaning, K; zero for laws without a pole."""
        return 0.0

    @overload
    def standard_error(self, temperature: Quantity) -> float: ...
    @overload
    def standard_error(self, temperature: Temperatures) -> Array: ...
    def standard_error(self, temperature: Any) -> Any:
        """Return the standard error of log10 α(T), decades; zero at the reference.

        Parameters
        ----------
        temperature : float, str, quantity, or an array or list of them
            Plain numbers are in K.

        Returns
        -------
        float or array
            In the shape of `temperature`.

        Raises
        ------
        InputError
            Where `log10` raises it, or if the law's constants were given without a covariance.
        """
        return in_shape(self._standard_error(self._accepted(temperature)))

    @overload
    def extrapolates(self, temperature: Quantity) -> bool: ...
    @overload
    def extrapolates(self, temperature: Temperatures) -> Mask: ...
    def extrapolates(self, temperature: Any) -> Any:
        """Say whether the law rests on extrapolation at a temperature.

        Parameters
        ----------
        temperature : float, str, quantity, or an array or list of them
            Plain numbers are in K.

        Returns
        -------
        bool or array of bool
            In the shape of `temperature`; True outside the temperatures that the law was fitted on.  A law that
            was not fitted, or one that is valid at measured temperatures only, extrapolates nowhere.
        """
        outside = self._outside(in_kelvin(temperature))
        return bool(outside) if np.ndim(outside) == 0 else outside

    def _outside(self, kelvin: Array) -> Mask:
        return np.zeros(np.shape(kelvin), dtype=bool)

    @overload
    def valid_at(self, temperature: Quantity, *, above_pole: float = 0.0) -> bool: ...
    @overload
    def valid_at(self, temperature: Temperatures, *, above_pole: float = 0.0) -> Mask: ...
    def valid_at(self, temperature: Any, *, above_pole: float = 0.0) -> Any:
        """Return whether the law has a value at a temperature, where `log10` raises no error.

        Parameters
        ----------
        temperature : float, str, quantity, or an array or list of them
            Plain numbers are in K.
        above_pole : float
            Distance to keep from a pole of the law, K; for figures, as α has no bound there.

        Returns
        -------
        bool or array of bool
            In the shape of `temperature`.

        Raises
        ------
        InputError
            If a temperature is not above absolute zero.
        """
        kelvin, margin = in_kelvin(temperature), to_si(above_pole, "delta_degC", "above_pole")
        valid = self._valid(np.ravel(kelvin)).reshape(np.shape(kelvin))
        if self._divergence > 0.0:
            valid = valid & (kelvin >= self._divergence + margin)
        return bool(valid) if np.ndim(valid) == 0 else valid

    def _valid(self, kelvin: Array) -> Mask:
        """Return which temperatures (n,) `_refuse` accepts; laws with known limits override the trial."""
        return np.array([self._accepts(kelvin[place : place + 1]) for place in range(kelvin.size)], dtype=bool)

    def _accepts(self, kelvin: Array) -> bool:
        try:
            self._refuse(kelvin)
        except InputError:
            return False
        return True

    def values_at(self, temperatures: Any) -> tuple[Array, Array]:
        """Return log10 α and its standard error, also where the law has no value.

        Parameters
        ----------
        temperatures : array or list of float, str or quantity
            Plain numbers are in K.

        Returns
        -------
        log10, standard_error : array
            In the shape of `temperatures`, NaN where the law is not valid (`valid_at`).  Standard errors that are not
            known (`has_standard_error`) are zero.
        """
        kelvin = in_kelvin(temperatures)
        valid = self.valid_at(kelvin)
        values, errors = np.full(np.shape(kelvin), np.nan), np.full(np.shape(kelvin), np.nan)
        if np.any(valid):
            values[valid] = self._log10(kelvin[valid])
            errors[valid] = self._standard_error(kelvin[valid]) if self.has_standard_error else 0.0
        return values, errors

    def covariance_at(self, temperatures: Temperatures) -> Array:
        """Return the covariance of log10 α at several temperatures.

        Parameters
        ----------
        temperatures : (n,) array or list of float, str or quantity
            Plain numbers are in K.

        Returns
        -------
        (n, n) array
            Zero where it is not known.

        Raises
        ------
        InputError
            Where `log10` raises it.
        """
        kelvin = np.ravel(in_kelvin(temperatures))
        self._refuse(kelvin)
        return self._covariance(kelvin)

    def _covariance(self, kelvin: Array) -> Array:
        return np.zeros((kelvin.size, kelvin.size))

    def to_dataset(self, temperatures: Any) -> Dataset:
        """Return log10 α over temperature as a labelled data set.

        Parameters
        ----------
        temperatures : (n,) array or list of float, str or quantity
            Plain numbers are in K.

        Returns
        -------
        xarray.Dataset
            ``log10_shift_factor`` and, where it is known, its ``standard_error``, along ``temperature`` (K); NaN where
            the law is not valid.  Attributes: ``reference_temperature`` (K), or those of the law with its constants.
        """
        kelvin = np.ravel(in_kelvin(temperatures))
        values, errors = self.values_at(kelvin)
        return self._dataset(kelvin, values, errors if self.has_standard_error else None)

    def _dataset(self, kelvin: Array, values: Array, errors: Array | None) -> Dataset:
        return dataset(
            "temperature",
            {
                "log10_shift_factor": (values, "1", "decadic logarithm of the shift factor"),
                "standard_error": None
                if errors is None
                else (errors, "1", "standard error of log10 of the shift factor"),
            },
            coordinates={"temperature": (kelvin, "K", "temperature")},
            attributes=self._attributes(),
        )

    def _attributes(self) -> dict[str, Any]:
        """Attributes of `to_dataset`."""
        return {"reference_temperature": self.reference}


def in_shape(values: Array) -> Any:
    """Return a single value as a float."""
    return float(values) if np.ndim(values) == 0 else values


def in_kelvin(temperature: Any) -> Array:
    """Return one temperature, or many in their shape, as an array in K; refuse those not above absolute zero."""
    kelvin = to_si_in_shape(temperature, "K", "temperature")
    if np.any(kelvin <= 0.0):
        raise InputError(f"temperature = {float(kelvin.min()):g} K: must be above absolute zero.", code="not-positive")
    return kelvin
