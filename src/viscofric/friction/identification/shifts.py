"""Shift factors as unknowns of an identification: found from the friction, or known with their errors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import InputError
from viscofric.rheology.shifts.parametric_law import ParametricLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_law import LN10
from viscofric.units import celsius

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.rheology.shifts.laws import ShiftLaw


#: Found shifts stay where the curves overlap: within so many of the standard errors with which overlap alone tells
#: them, and so much in ln α.  A free spectrum fits curves that have been moved apart as well.  What this expectation
#: adds to the data's own information is one part in the square of that number.
OVERLAPPING, OVERLAPPING_LEAST = 5.0, 0.05
#: Known without an error, ln α may still move by rounding.
EXACT = 1e-7
_SAME = 1e-6  # K


@dataclass(frozen=True, eq=False)
class Shifts:
    """ln α at every temperature that matters, with a normal prior.

    Attributes
    ----------
    temperatures : (t,) array
        Ascending, K.
    reference : float
        One of them, where α = 1, unless `found` is false; K.
    middle : (t,) array
        ln α as expected.
    whitening : (r, t) array
        Its product with (ln α − middle) has standard deviation one.
    found : bool
        Whether the friction is to find them.
    exact : bool
        Whether they were given without an error.
    """

    temperatures: Array
    reference: float
    middle: Array
    whitening: Array
    found: bool
    exact: bool = False

    @classmethod
    def unknown(cls, temperatures: Array, reference: float, overlap: ShiftFactors | None = None) -> Shifts:
        """Return unknown shifts at temperatures (t,), one of which is the reference.

        `overlap` is what overlap of the curves tells of them; None for one temperature.
        """
        if overlap is None:
            return cls(temperatures, reference, np.zeros(1), np.eye(1) / EXACT, True)
        about = overlap.at_reference(reference)
        away = np.abs(temperatures - reference) >= _SAME
        covariance = (OVERLAPPING * LN10) ** 2 * _covariance(about, temperatures) * np.outer(away, away)
        covariance += np.diag(np.where(away, OVERLAPPING_LEAST**2, 0.0))
        return cls(temperatures, reference, LN10 * np.asarray(about.log10(temperatures)), _whitening(covariance), True)

    @classmethod
    def known(cls, temperatures: Array, shift: ShiftLaw) -> Shifts:
        """Return those of a law or table at temperatures (t,), with its covariance where it has one."""
        middle = LN10 * np.asarray(shift.log10(temperatures))
        covariance = LN10**2 * _covariance(shift, temperatures)
        return cls(temperatures, float(shift.reference), middle, _whitening(covariance), False, not covariance.any())

    def row(self, temperature: float) -> Array:
        """Return the weights (t,) of the temperatures in ln α at one of them, or between them, linear in 1/T.

        Raises
        ------
        InputError
            If it lies outside.
        """
        low, high = self.temperatures[0], self.temperatures[-1]
        if not low - _SAME <= temperature <= high + _SAME:
            raise InputError(
                f"temperature = {celsius(temperature):.1f} °C of an anchor or prior lies outside those of the friction "
                f"curves, {celsius(float(low)):.1f} to {celsius(float(high)):.1f} °C, so that its shift factor is not "
                "found; give shift=, or one measured among them."
            )
        inverse = 1.0 / self.temperatures[::-1]
        return np.array([np.interp(1.0 / temperature, inverse, unit) for unit in np.eye(len(inverse))])[::-1]

    def table(self, log_alpha: Array, covariance: Array) -> ShiftFactors:
        """Return the factors found, of ln α (t,) with its covariance (t, t), about the reference."""
        return ShiftFactors(self.temperatures, log_alpha / LN10, self.reference, covariance / LN10**2)


def _whitening(covariance: Array) -> Array:
    values, vectors = np.linalg.eigh(covariance)
    return np.asarray(vectors.T / np.sqrt(np.maximum(values, 0.0) + EXACT**2)[:, None])


def _covariance(shift: ShiftLaw, temperatures: Array) -> Array:
    """Return the covariance of log10 α at temperatures (t,), zero where the law has none."""
    if isinstance(shift, ShiftFactors):
        inverse = 1.0 / shift.temperatures[::-1]
        rows = np.array([np.interp(1.0 / temperatures, inverse, unit) for unit in np.eye(len(inverse))[::-1]]).T
        return np.asarray(rows @ shift.covariance @ rows.T)
    if isinstance(shift, ParametricLaw) and shift.covariance is not None:
        gradient = shift.gradient(temperatures)
        return np.asarray(gradient @ np.asarray(shift.covariance) @ gradient.T)
    return np.zeros((len(temperatures), len(temperatures)))
