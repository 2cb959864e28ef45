"""Shift factors measured at the temperatures of the sweeps, with their uncertainty and fitted laws."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np

from viscofric.errors import InputError
from viscofric.rheology import law_fitting
from viscofric.rheology.shift_laws import WLF, Arrhenius, ShiftLaw, WLFArrhenius
from viscofric.units import celsius, kelvin_hint, positive, to_si_array

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.units import Quantities, Quantity

    Array = NDArray[np.float64]

#: Two temperatures closer than this are the same one, to rounding of °C.
_SAME_TEMPERATURE = 1e-9  # relative


@dataclass(frozen=True, eq=False)
class ShiftFactors(ShiftLaw):
    """A table of shift factors, read between its temperatures by monotone interpolation in 1/T.

    Parameters
    ----------
    temperatures : (n,) array or quantities
        Ascending, at least two, K.
    log10_values : (n,) array
        log10 α.  They are moved as a whole so that the interpolated value at the reference is zero.
    reference : float or quantity
        Temperature where α = 1, inside the measured range; K.
    covariance : (n, n) array, optional
        Of the values, given that the one at the reference is exactly zero; zero if not given.
    """

    temperatures: Array
    log10_values: Array
    reference: float
    covariance: Array

    def __init__(
        self, temperatures: Quantities, log10_values: Any, reference: Quantity, covariance: Any = None
    ) -> None:
        kelvin = to_si_array(temperatures, "K", "temperatures")
        values = np.array(log10_values, dtype=float)
        if kelvin.size < 2 or values.shape != kelvin.shape or not np.all(np.isfinite(values)):
            raise InputError("shift factors need at least two temperatures, and one finite value for each.")
        if np.any(np.diff(kelvin) <= 0.0) or kelvin[0] <= 0.0:
            raise InputError("temperatures of shift factors must ascend without repeats, above absolute zero.")
        spread = np.zeros((kelvin.size, kelvin.size)) if covariance is None else np.array(covariance, dtype=float)
        if spread.shape != (kelvin.size, kelvin.size) or not np.all(np.isfinite(spread)):
            raise InputError("covariance of shift factors must be square, one row per temperature, and finite.")
        object.__setattr__(self, "temperatures", kelvin)
        object.__setattr__(self, "reference", positive(reference, "K", "reference"))
        object.__setattr__(self, "log10_values", values)
        self._refuse(np.array([self.reference]))
        values = values - float(self._log10(np.asarray(self.reference)))
        object.__setattr__(self, "log10_values", values)
        object.__setattr__(self, "covariance", spread)
        for column in (kelvin, values, spread):
            column.flags.writeable = False

    @property
    def standard_errors(self) -> Array:
        """Standard error of each log10 α, zero at a reference that was measured."""
        return np.sqrt(np.diag(self.covariance))

    def _refuse(self, kelvin: Array) -> None:
        low, high = self.temperatures[0], self.temperatures[-1]
        outside = (kelvin < low * (1 - _SAME_TEMPERATURE)) | (kelvin > high * (1 + _SAME_TEMPERATURE))
        if np.any(outside):
            wanted = float(kelvin[outside][0])
            raise InputError(
                f"temperature = {celsius(wanted):z.1f} °C lies outside the measured "
                f"{celsius(low):z.1f} to {celsius(high):z.1f} °C; use a law to go beyond, "
                f"[material] shift = \"wlf\" in a run file, shift_factors.law('wlf') in Python{kelvin_hint(wanted)}."
            )

    def _log10(self, kelvin: Array) -> Array:
        from scipy.interpolate import PchipInterpolator

        # An Arrhenius law is straight in 1/T, so little curvature is left to interpolate.
        inverse = np.clip(1.0 / kelvin, 1.0 / self.temperatures[-1], 1.0 / self.temperatures[0])
        curve = PchipInterpolator(1.0 / self.temperatures[::-1], self.log10_values[::-1])
        return np.asarray(curve(inverse))

    def at_reference(self, reference: Quantity) -> ShiftFactors:
        """Return the same factors with α = 1 at another temperature inside the measured range."""
        kelvin = positive(reference, "K", "reference")
        self._refuse(np.array([kelvin]))
        return ShiftFactors(
            self.temperatures,
            self.log10_values,
            kelvin,
            referenced_covariance(self.temperatures, self.covariance, kelvin),
        )

    @overload
    def law(self, kind: Literal["wlf"], *, above: Quantity | None = None) -> WLF: ...
    @overload
    def law(self, kind: Literal["arrhenius"], *, above: Quantity | None = None) -> Arrhenius: ...
    @overload
    def law(self, kind: Literal["wlf+arrhenius"], *, above: Quantity | None = None) -> WLFArrhenius: ...
    def law(self, kind: str, *, above: Quantity | None = None) -> ShiftLaw:
        """Fit a law to the table, with α = 1 at the same reference.

        Every value counts by its uncertainty.  Where the table scatters about the law by more than that, the
        excess is taken for a misfit common to all temperatures and added to it, so that the law's standard
        errors tell of both.

        Parameters
        ----------
        kind : {"wlf", "arrhenius", "wlf+arrhenius"}
            The last is WLF above a glass transition that is found too, Arrhenius below it.
        above : float or quantity, optional
            Leave out measured temperatures below this one, such as those below the glass transition.

        Returns
        -------
        WLF, Arrhenius or WLFArrhenius
            With `covariance` and standard errors.

        Raises
        ------
        InputError
            If the kind is unknown, the temperatures are too few, or the law does not describe them.
        """
        keep = np.full(self.temperatures.shape, True)
        if above is not None:
            keep = self.temperatures >= positive(above, "K", "above")
        return law_fitting.fit(
            kind,
            self.temperatures[keep],
            self.log10_values[keep],
            self.covariance[np.ix_(keep, keep)],
            self.reference,
        )


def referenced_covariance(temperatures: Array, covariance: Array, reference: float) -> Array:
    """Return the covariance of log10 α(T) − log10 α(reference), the latter interpolated linearly in 1/T."""
    inverse = 1.0 / temperatures[::-1]
    weights = np.array([np.interp(1.0 / reference, inverse, unit) for unit in np.eye(len(inverse))])[::-1]
    change = np.eye(len(inverse)) - weights[None, :]
    return np.asarray(change @ covariance @ change.T)
