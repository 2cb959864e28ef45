"""One friction curve of all temperatures: friction against the reduced speed α(T) v, and back to μ(v, T)."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from viscofric.errors import InputError
from viscofric.friction.shifting.smoothing import smoothing_weights
from viscofric.nominal import SAME_LOAD
from viscofric.units import Quantities, Quantity, celsius, positive, to_si_array

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.friction.curves import FrictionCurves
    from viscofric.rheology.shifts.laws import ShiftLaw

    Array: TypeAlias = NDArray[np.float64]

#: Half-width of the smoothing kernel, decades of reduced speed.
BANDWIDTH = 0.25
#: Widest stretch without measured points that is bridged, decades of reduced speed.
WIDEST_GAP = 0.5

# Rounding of log10(αv), so that the ends of the range belong to it.
_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class FrictionMasterCurve:
    """Viscoelastic friction against reduced speed, μ(v, T) = μ(α(T) v, reference).

    Called with a speed and a temperature it gives μ(v, T).  The value is that of a local quadratic regression
    in log10(αv): tricube kernel of half-width 0.25 decades, wider where points are sparse so that it reaches
    the five nearest; every point weighs 1/(s² + m²), s its own standard error, m the median of all.  From 10
    points without noise per decade it is true to 0.5 % around a maximum where the slope of log μ over log v
    changes by 1 per decade, and to 1 % at the sharpest there is, that of one retardation time.  Stretches
    wider than half a decade without points are not bridged.

    Attributes
    ----------
    reduced_speed : (n,) array
        α(T) v, ascending, m/s.
    temperature : (n,) array
        At which the point was measured or predicted, K.
    friction, error, scatter : (n,) array
        Viscoelastic friction coefficient, its standard error, its standard deviation over the replicates.
    reference : float
        Temperature at which the reduced speed is the speed, K.
    shift : ShiftLaw
        With α(reference) = 1.
    curves : FrictionCurves
        What was shifted.
    overlap_rms : float or None
        Root mean square of the relative difference of curves at neighbouring temperatures where their reduced
        speeds overlap: at each point of one, the other one is read by a cubic spline.  None without overlap.
    overlap_error : float or None
        What this would be from the standard errors alone.
    overlap_points : int
        Points behind it.
    """

    reduced_speed: Array
    temperature: Array
    friction: Array
    error: Array
    scatter: Array
    reference: float
    shift: ShiftLaw
    curves: FrictionCurves
    overlap_rms: float | None
    overlap_error: float | None
    overlap_points: int

    def __len__(self) -> int:
        return len(self.reduced_speed)

    @property
    def reduced_range(self) -> tuple[float, float]:
        """Lowest and highest reduced speed, m/s."""
        return float(self.reduced_speed[0]), float(self.reduced_speed[-1])

    @property
    def stretches(self) -> tuple[tuple[float, float], ...]:
        """Lowest and highest reduced speed (m/s) of each stretch without a gap above half a decade."""
        decades = np.log10(self.reduced_speed)
        breaks = np.flatnonzero(np.diff(decades) > WIDEST_GAP) + 1
        return tuple((float(part[0]), float(part[-1])) for part in np.split(self.reduced_speed, breaks))

    @property
    def overlap_sentence(self) -> str:
        """How well the curves coincide, in words."""
        if self.overlap_rms is None or self.overlap_error is None:
            return (
                "Curves of neighbouring temperatures do not overlap in reduced speed, so the master curve "
                "does not test the shift factors."
            )
        alone = f"would make it {100 * self.overlap_error:.2g} %"
        if not np.isfinite(self.overlap_error):
            alone = "are unknown"
        return (
            f"Curves of neighbouring temperatures coincide to {100 * self.overlap_rms:.2g} % (root mean "
            f"square over {self.overlap_points} points) where they overlap in reduced speed; their errors "
            f"alone {alone}."
        )

    def __call__(self, speed: Quantities, temperature: Quantities | None = None) -> Any:
        """Return μ(v, T).

        Parameters
        ----------
        speed : float, str, pint.Quantity, or an array or list of them
            Above zero; m/s if plain numbers.
        temperature : the same, optional
            K if plain numbers; the reference if left out.  Broadcast against `speed`.

        Returns
        -------
        float or array
            In the broadcast shape of both; a float if both are single values.

        Raises
        ------
        InputError
            If the reduced speed lies outside the range that was measured, or in a gap.
        """
        return self._read(speed, temperature)[0]

    def standard_error(self, speed: Quantities, temperature: Quantities | None = None) -> Any:
        """Return the standard error that the points' errors leave on μ(v, T); arguments as in a call."""
        return self._read(speed, temperature)[1]

    def _read(self, speed: Quantities, temperature: Quantities | None) -> tuple[Any, Any]:
        velocity, single_speed = _values(speed, "m/s", "speed")
        kelvin, single_temperature = (
            (np.array(self.reference), True) if temperature is None else _values(temperature, "K", "temperature")
        )
        try:
            velocity, kelvin = np.broadcast_arrays(velocity, kelvin)
        except ValueError:
            raise InputError(
                f"speed and temperature have {np.size(velocity)} and {np.size(kelvin)} values: must be as "
                "many, or one of them single."
            ) from None
        if not np.all(velocity > 0.0):
            raise InputError(f"speed must be above zero everywhere, but one is {velocity.min():g} m/s.")
        decades = np.log10(velocity) + np.asarray(self.shift.log10(np.asarray(kelvin)))
        value, error = self._smooth(decades.ravel())
        if single_speed and single_temperature:
            return float(value[0]), float(error[0])
        return value.reshape(velocity.shape), error.reshape(velocity.shape)

    def _smooth(self, decades: Array) -> tuple[Array, Array]:
        """Smooth at log10 of the reduced speed, stretch by stretch: values and standard errors."""
        value, error = np.full(decades.shape, np.nan), np.full(decades.shape, np.nan)
        points = np.log10(self.reduced_speed)
        weights = _weights(self.error)
        for low, high in np.log10(self.stretches):
            asked = (decades >= low - _ROUNDING) & (decades <= high + _ROUNDING)
            rows = (points >= low) & (points <= high)
            places = np.clip(decades[asked], low, high)
            matrix = smoothing_weights(points[rows], weights[rows], places, BANDWIDTH)
            value[asked] = matrix @ self.friction[rows]
            variance = np.where(matrix == 0.0, 0.0, self.error[rows] ** 2)
            error[asked] = np.sqrt(np.sum(matrix**2 * variance, axis=1))
        if np.any(np.isnan(value)):
            self._refuse(10.0 ** float(decades[np.isnan(value)][0]))
        return value, error

    def _refuse(self, reduced: float) -> None:
        there = " and ".join(f"{low:.3g} to {high:.3g} m/s" for low, high in self.stretches)
        raise InputError(
            f"reduced speed α(T)·v = {reduced:.3g} m/s at {celsius(self.reference):.1f} °C is not covered: "
            f"friction is known for {there}."
        )


def shift_friction(
    curves: FrictionCurves, *, shift: ShiftLaw, reference: Quantity | None = None
) -> FrictionMasterCurve:
    """Shift friction curves of several temperatures onto one by the shift factors of the modulus (Eq. 10).

    Parameters
    ----------
    curves : FrictionCurves
        All at one load, since μ(v, T, F) = μ(α(T) v, T0, F) holds load by load.
    shift : ShiftLaw or ShiftFactors
        α(T), as of the material: ``rubber.shift``.
    reference : float, str or pint.Quantity, optional
        Temperature of the master curve, K; that of `shift` if left out.

    Returns
    -------
    FrictionMasterCurve

    Raises
    ------
    InputError
        If there are no curves, no shift, loads that differ by more than 5 %, or a temperature at which α is
        not known.
    """
    if not len(curves):
        raise InputError("friction curves hold no points; there is nothing to shift.")
    if not hasattr(shift, "log10"):
        raise InputError(
            f"shift of friction curves must be a law (WLF, …) or ShiftFactors, not {type(shift).__name__}."
        )
    if curves.load.max() > (1.0 + SAME_LOAD) * curves.load.min():
        raise InputError(
            f"load of the friction curves runs from {curves.load.min():.3g} to {curves.load.max():.3g} "
            f"{curves.load_unit}, but a master curve holds at one load; choose one with curves.at_load()."
        )
    law = shift if reference is None else shift.at_reference(positive(reference, "K", "reference"))
    reduced = np.asarray(law(curves.temperature)) * curves.speed
    order = np.argsort(reduced, kind="stable")
    overlap_rms, overlap_error, overlap_points = _overlap(curves, np.log10(reduced))
    return FrictionMasterCurve(
        reduced_speed=_frozen(reduced[order]),
        temperature=_frozen(curves.temperature[order]),
        friction=_frozen(curves.viscoelastic[order]),
        error=_frozen(curves.viscoelastic_error[order]),
        scatter=_frozen(curves.viscoelastic_scatter[order]),
        reference=float(law.reference),
        shift=law,
        curves=curves,
        overlap_rms=overlap_rms,
        overlap_error=overlap_error,
        overlap_points=overlap_points,
    )


def _frozen(column: Array) -> Array:
    column.flags.writeable = False
    return column


def _values(values: Quantities, unit: str, name: str) -> tuple[Array, bool]:
    """Convert to SI units in their own shape, and tell whether it is a single value."""
    if isinstance(values, np.ndarray):
        return to_si_array(values.ravel(), unit, name).reshape(values.shape), values.ndim == 0
    single = isinstance(values, str) or np.ndim(getattr(values, "magnitude", values)) == 0
    return to_si_array(values, unit, name), single


def _weights(error: Array) -> Array:
    """Return statistical weights 1/(s² + median²), relative to their largest; equal if no error is known."""
    finite = error[np.isfinite(error)]
    typical = float(np.median(finite)) if finite.size else 0.0
    if typical == 0.0:
        return np.ones(error.shape)
    # An unknown error weighs little, not nothing: its point may be the only one around.
    squared = np.where(np.isfinite(error), error, 100.0 * typical) ** 2 + typical**2
    return np.asarray(squared.min() / squared)


def _overlap(curves: FrictionCurves, decades: Array) -> tuple[float | None, float | None, int]:
    """Compare the curves of each pair of neighbouring temperatures where they overlap."""
    temperatures = curves.temperatures
    parts = [_isotherm(curves, decades, temperature) for temperature in temperatures]
    differences: list[Array] = []
    expected: list[Array] = []
    for cold, warm in pairwise(parts):
        for one, other in ((cold, warm), (warm, cold)):
            inside = (one[0] >= other[0][0] - _ROUNDING) & (one[0] <= other[0][-1] + _ROUNDING)
            if not np.any(inside):
                continue
            place = np.clip(one[0][inside], other[0][0], other[0][-1])
            friction = _spline(other[0], other[1], place)
            mean = np.maximum(0.5 * (np.abs(one[1][inside]) + np.abs(friction)), np.finfo(float).tiny)
            differences.append((one[1][inside] - friction) / mean)
            expected.append(np.hypot(one[2][inside], np.interp(place, other[0], other[2])) / mean)
    if not differences:
        return None, None, 0
    all_differences, all_expected = np.concatenate(differences), np.concatenate(expected)
    return (
        float(np.sqrt(np.mean(all_differences**2))),
        float(np.sqrt(np.mean(all_expected**2))),
        all_differences.size,
    )


def _isotherm(curves: FrictionCurves, decades: Array, temperature: float) -> tuple[Array, Array, Array]:
    """Ascending log10 reduced speeds of one temperature, friction and its error; equal speeds averaged."""
    rows = curves.temperature == temperature
    places, number = np.unique(decades[rows], return_inverse=True)
    count = np.bincount(number)
    friction = np.bincount(number, curves.viscoelastic[rows]) / count
    error = np.sqrt(np.bincount(number, curves.viscoelastic_error[rows] ** 2)) / count
    return places, friction, error


def _spline(x: Array, y: Array, at: Array) -> Array:
    from scipy.interpolate import make_interp_spline

    if x.size == 1:
        return np.full(at.shape, y[0])
    return np.asarray(make_interp_spline(x, y, k=3 if x.size > 3 else 1)(at))
