"""How well predicted friction agrees with measured friction: bias, root mean square, share within error."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.errors import InputError
from viscofric.nominal import SAME_LOAD
from viscofric.units import celsius

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.friction.curves import FrictionCurves

    Array: TypeAlias = NDArray[np.float64]

# Points are the same within rounding of units, not within scatter: predictions are made at the measured
# points.
_SAME_SPEED = 1e-6  # relative
_SAME_TEMPERATURE = 1e-3  # K


@dataclass(frozen=True, eq=False)
class Agreement:
    """Agreement of a prediction with a measurement, over all points and temperature by temperature.

    With d = (predicted − measured) / measured at each measured point:

    Attributes
    ----------
    bias : float
        Mean of d: above zero where the prediction is too high.
    rms : float
        Root mean square of d.
    share_within_error : float
        Share of the points where predicted and measured differ by at most twice the combined standard error
        √(s² + e²), with s the standard error of the measured mean and e the numerical error of the
        prediction.
    points : int
    temperature : (k,) array
        Different temperatures, K, ascending.
    bias_at, rms_at, share_within_error_at : (k,) array
        The same for the points of each temperature.
    points_at : (k,) array of int
    relative_difference : (n,) array
        d in the order of the measured points.
    """

    bias: float
    rms: float
    share_within_error: float
    points: int
    temperature: Array
    bias_at: Array
    rms_at: Array
    share_within_error_at: Array
    points_at: NDArray[np.int64]
    relative_difference: Array

    def __str__(self) -> str:
        return (
            f"Over {self.points} points the predicted friction is {abs(100 * self.bias):.1f} % "
            f"{'above' if self.bias >= 0 else 'below'} the measured one on average, {100 * self.rms:.1f} % "
            "away from it in root mean square, and within twice the standard error at "
            f"{100 * self.share_within_error:.0f} % of them."
        )


def compare(measured: FrictionCurves, predicted: FrictionCurves) -> Agreement:
    """Compare the viscoelastic friction measured with that predicted at the same speeds and temperatures.

    Parameters
    ----------
    measured : FrictionCurves
        With viscoelastic friction above zero.
    predicted : FrictionCurves
        Solved at the measured points, as with ``speeds=measured.speeds, temperatures=measured.temperatures``;
        it may hold more of them.

    Returns
    -------
    Agreement

    Raises
    ------
    InputError
        If a measured point has no prediction at its speed, temperature and load (within 5 %), or its
        friction is not above zero.
    """
    if not len(measured):
        raise InputError("measured friction curves hold no points; there is nothing to compare.")
    if not np.all(measured.viscoelastic > 0.0):
        raise InputError(
            "viscoelastic of measured friction curves must be above zero everywhere to tell a relative "
            f"difference, but one is {measured.viscoelastic.min():.3g}; leave such points out with select()."
        )
    rows = np.array([_partner(measured, row, predicted) for row in range(len(measured))])
    difference = predicted.viscoelastic[rows] - measured.viscoelastic
    relative = difference / measured.viscoelastic
    error = np.hypot(measured.viscoelastic_error, predicted.viscoelastic_error[rows])
    within = np.abs(difference) <= 2.0 * error
    there = measured.temperatures
    groups = [measured.temperature == temperature for temperature in there]
    return Agreement(
        bias=float(relative.mean()),
        rms=_rms(relative),
        share_within_error=float(within.mean()),
        points=len(measured),
        temperature=there,
        bias_at=np.array([relative[group].mean() for group in groups]),
        rms_at=np.array([_rms(relative[group]) for group in groups]),
        share_within_error_at=np.array([within[group].mean() for group in groups]),
        points_at=np.array([np.count_nonzero(group) for group in groups]),
        relative_difference=relative,
    )


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _partner(measured: FrictionCurves, row: int, predicted: FrictionCurves) -> int:
    """Row of the prediction that belongs to a measured point."""
    speed, temperature, load = measured.speed[row], measured.temperature[row], measured.load[row]
    same = np.abs(predicted.speed - speed) <= _SAME_SPEED * speed
    same &= np.abs(predicted.temperature - temperature) <= _SAME_TEMPERATURE
    same &= np.abs(predicted.load - load) <= SAME_LOAD * load
    if not np.any(same):
        raise InputError(
            f"the point measured at {celsius(float(temperature)):.2f} °C, {1e3 * speed:.5g} mm/s and "
            f"{load:.3g} N has no prediction; predict friction at measured.speeds, measured.temperatures "
            "and the measured load."
        )
    candidates = np.flatnonzero(same)
    return int(candidates[np.argmin(np.abs(predicted.load[candidates] - load))])
