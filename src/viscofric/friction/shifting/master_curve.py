"""Friction master curve: friction of all temperatures against the reduced speed α(T) v, and μ(v, T) from it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from viscofric.arrays import Array, Indices, Mask
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.friction.curve_checks import (
    LEAST_FREEDOM,
    LEFT_OUT,
    MEAN_SQUARE,
    Decades,
    error_freedom,
    outliers,
    outlying_points,
    standard_errors,
)
from viscofric.friction.curve_words import LABELS
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.shifting.collapse import Collapse
from viscofric.friction.shifting.isotherms import about_one_curve, nominal_temperatures
from viscofric.friction.shifting.load_rule import LoadRule
from viscofric.nominal import SAME_LOAD
from viscofric.notes import Note
from viscofric.rheology.shifts.laws import ShiftLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_law import LN10
from viscofric.rheology.shifts.vertical_shift import VerticalShift
from viscofric.showing import Plotted, Rows
from viscofric.units import Quantities, Quantity, positive, shown_celsius, shown_number, to_si_in_shape

#: Half-width of the smoothing kernel, decades of reduced speed.
BANDWIDTH = 0.25
#: Widest stretch without measured points that is bridged, decades of reduced speed.
WIDEST_GAP = 0.5
# Rounding of log10(αv), so that the ends of a stretch belong to it.
_ROUNDING = 1e-9
# Different abscissae that the kernel must reach beyond the three that a parabola needs, so that it smooths.
_NEIGHBOURS = 5
# Abscissae closer than this part of the bandwidth count as one.
_COINCIDENT = 1e-6
# Largest relative distance of the spline of a point from a smooth curve, also at its ends.
_BIAS = 0.03
# Places smoothed at a time, near each other: few numbers at once stay in the cache.
_TOGETHER = 32


def reduced_decades(points: FrictionCurves, shift: ShiftLaw, *, found: bool) -> Array:
    """Return log10 of the reduced speed of points (n,) at one load, whose shift factors were found or given."""
    kelvin = nominal_temperatures(points.temperature) if found else points.temperature
    return np.asarray(np.log10(points.speed) + shift.log10(kelvin))


@dataclass(frozen=True, eq=False)
class SmoothedPoints:
    """A curve (n,) interpolated between scattered points, stretch by stretch."""

    decades: Array  # log10 of the reduced speed, ascending
    friction: Array
    error: Array
    sharing: Array  # (k, n), relative errors that points share, of k independent ones

    @cached_property
    def stretches(self) -> tuple[tuple[float, float], ...]:
        """Ends of each stretch without a gap wider than `WIDEST_GAP`, in decades."""
        breaks = np.flatnonzero(np.diff(self.decades) > WIDEST_GAP) + 1
        return tuple((float(part[0]), float(part[-1])) for part in np.split(self.decades, breaks))

    def covers(self, decades: Array) -> Mask:
        """Return which places lie in a stretch."""
        inside = [(decades >= low - _ROUNDING) & (decades <= high + _ROUNDING) for low, high in self.stretches]
        return np.asarray(np.any(inside, axis=0))

    def read(self, decades: Array) -> Array:
        """Return values (m,) at places (m,) that lie in a stretch."""
        value = np.empty(decades.shape)
        for places, window, weights in self._smoothers(decades, self._judged.weight):
            value[places] = weights @ self.friction[window]
        return value

    def standard_error(self, decades: Array, moved: Array | None = None, points_moved: Array | None = None) -> Array:
        """Return standard errors (m,) at places (m,) that lie in a stretch.

        `moved` (m, k) and `points_moved` (n, k) are k independent standard errors of the places and of the points.
        """
        square = np.empty(decades.shape)
        slope = np.zeros(decades.shape) if moved is None else self._slope(decades)
        unknown = np.isinf(self._judged.variance)
        variance = np.where(unknown, 0.0, self._judged.variance)
        for places, window, weights in self._smoothers(decades, self._judged.weight):
            square[places] = weights**2 @ variance[window] + self._shared(window, weights)
            if moved is not None and points_moved is not None:
                apart = moved[places] - weights @ points_moved[window]
                square[places] += slope[places] ** 2 * np.sum(apart**2, axis=1)
            square[places[np.any(weights[:, unknown[window]] != 0.0, axis=1)]] = np.inf
        return np.sqrt(square)

    def _slope(self, decades: Array) -> Array:
        """Return the change of the value per decade at places (m,) that lie in a stretch."""
        low, high = np.transpose(self.stretches)
        place = np.searchsorted(high + _ROUNDING, decades)
        low, high = low[place], high[place]
        first, last = np.maximum(decades - 0.5 * BANDWIDTH, low), np.minimum(decades + 0.5 * BANDWIDTH, high)
        rise = self.read(last) - self.read(first)
        return np.asarray(np.divide(rise, last - first, out=np.zeros(decades.shape), where=last > first))

    @property
    def stated(self) -> bool:
        """Whether any error is known."""
        return bool(np.any(self.error[np.isfinite(self.error)] > 0.0))

    @property
    def outlying(self) -> Array:
        """By how much points (n,) lie off the curve that count less for it; zero for the others.

        In standard errors, or relative to the curve if none is stated.
        """
        if self.stated:
            return np.sqrt(self._judged.outlying)
        off = np.where(self._judged.outlying > 0.0, np.abs(self.friction - self._judged.curve), 0.0)
        return np.asarray(off / np.maximum(np.abs(self._judged.curve), np.finfo(float).tiny))

    def _shared(self, window: slice, weights: Array) -> Array:
        """Return the variances (m,) that errors which points share give to weighted sums (m, w) of their friction."""
        if not np.any(self.sharing):
            return np.zeros(len(weights))
        return np.asarray(np.sum((weights @ (self.sharing[:, window] * self.friction[window]).T) ** 2, axis=1))

    def _smoothers(self, decades: Array, statistical: Array) -> Iterator[tuple[Indices, slice, Array]]:
        """Yield of places (m,) that lie in a stretch their numbers, the points around them and the weights of these."""
        for low, high in self.stretches:
            inside = np.flatnonzero((decades >= low - _ROUNDING) & (decades <= high + _ROUNDING))
            if not inside.size:
                continue
            inside = inside[np.argsort(decades[inside], kind="stable")]
            first, last = np.searchsorted(self.decades, low), np.searchsorted(self.decades, high, "right")
            rows, at = slice(int(first), int(last)), np.clip(decades[inside], low, high)
            for places, window, weights in smoothing_weights(self.decades[rows], statistical[rows], at, BANDWIDTH):
                yield inside[places], slice(rows.start + window.start, rows.start + window.stop), weights

    @cached_property
    def _judged(self) -> _Judged:
        """Weights and variances of the points; those far from the others count less."""
        # Variances are larger by one factor where points scatter about the curve by more than these.  The scatter that
        # errors which points share explain is not counted.
        finite = np.isfinite(self.error)
        # Without stated errors, the scatter is taken to be a part of friction.
        stated = self.error if self.stated else np.where(finite, np.abs(self.friction), np.inf)
        plain, trusted, variance = _weights(self.error), _weights(stated), np.where(finite, np.square(stated), 0.0)
        larger, away = self._found_to_lie_off(stated)
        about = self._about(plain / larger, variance * larger)
        # Where the curve goes through the points, what is left is rounding.
        counted = finite & (larger < LEFT_OUT) & (about.freedom > LEAST_FREEDOM) & (about.own > 0.0)
        factor = 1.0 if self.stated else 0.0
        if np.any(counted):
            weight = (trusted / larger)[counted]
            squares = (self.friction - about.curve)[counted] ** 2 - about.shared[counted]
            factor = max(factor, float(weight @ squares) / (MEAN_SQUARE * float(weight @ about.own[counted])))
        return _Judged(plain / larger, np.where(finite, variance * larger * factor, np.inf), away, about.curve)

    def _found_to_lie_off(self, stated: Array) -> tuple[Array, Array]:
        """Return factors (n,) of the variances of points, and squared distances (n,) of outliers; else zero."""
        # They are distances from one smooth curve of each stretch, on the scale of all friction.
        known = np.isfinite(stated) & (stated > 0.0)
        larger, squares, freedom = np.ones(len(stated)), np.zeros(len(stated)), 0.0
        scale = Decades.of(self.friction[known], self.error[known])
        for low, high in self.stretches:
            rows = np.flatnonzero(known & (self.decades >= low) & (self.decades <= high))
            friction = self.friction[rows]
            unit = scale.unit(friction)
            columns = self.decades[rows], LN10 * scale(friction), (stated[rows] / unit) ** 2
            shared, near = self.sharing[:, rows] * friction / unit, _BIAS * np.abs(friction) / unit
            larger[rows], squares[rows], more = about_one_curve(*columns, shared, float(self.stated), near)
            freedom += more
        over, outlying = outliers(squares, larger, freedom, 1.0)
        return larger, np.where(outlying, over, 0.0)

    def _about(self, weight: Array, variance: Array) -> _About:
        """Return how points lie about the curve of points with weights and variances (n,)."""
        about = _About(*np.zeros((4, len(self.decades))))
        for places, window, weights in self._smoothers(self.decades, weight):
            about.curve[places] = weights @ self.friction[window]
            left = np.negative(weights, out=weights)
            left[np.arange(len(places)), places - window.start] += 1.0
            about.shared[places] = self._shared(window, left)
            squares = np.square(left, out=left)
            about.own[places] = squares @ variance[window]
            about.freedom[places] = squares.sum(axis=1)
        return about


class _About(NamedTuple):
    """How points (n,) lie about the curve: its value; variances of their distances, and the part of their own."""

    curve: Array
    own: Array
    shared: Array
    freedom: Array


class _Judged(NamedTuple):
    """Points (n,) of a curve: statistical weights, variances, squared distances of outliers in variances, the curve."""

    weight: Array
    variance: Array
    outlying: Array
    curve: Array


def _weights(error: Array) -> Array:
    """Return statistical weights 1/(s² + median²), relative to their largest; equal if no error is known."""
    finite = error[np.isfinite(error)]
    typical = float(np.median(finite)) if finite.size else 0.0
    if typical == 0.0:
        return np.ones(error.shape)
    # A point of unknown error has a small weight, not zero: it may be the only one nearby.
    squared = np.where(np.isfinite(error), error, 100.0 * typical) ** 2 + typical**2
    return np.asarray(squared.min() / squared)


def smoothing_weights(
    points: Array, weights: Array, at: Array, bandwidth: float
) -> Iterator[tuple[slice, slice, Array]]:
    """Yield of some places in `at` (m,), ascending, the `points` (n,), ascending, they depend on, and their weights.

    The weights (of places, of points) are of sum one at each place, and zero where it does not depend on a point.
    """
    # At each place, within the range of the points, a parabola is fitted by weighted least squares; its weights are
    # those given (above zero) times the tricube kernel (1 − |d/h|³)³ (W. S. Cleveland, J. Am. Stat. Assoc. 74 (1979)
    # 829), h the bandwidth or, where points are sparse, just beyond the fifth nearest one. With fewer than four
    # different points the parabola becomes a line or a constant.
    different = points[np.concatenate([[True], np.diff(points) > _COINCIDENT * bandwidth])]
    degree = min(2, max(0, different.size - 2)) if different.size != 2 else 1
    reach = min(_NEIGHBOURS, different.size)
    beside = np.searchsorted(different, at)[:, None] + np.arange(-reach, reach)
    beyond = (beside < 0) | (beside >= different.size)
    away = np.abs(different[np.clip(beside, 0, different.size - 1)] - at[:, None])
    h = np.maximum(bandwidth, 1.1 * np.sort(np.where(beyond, np.inf, away), axis=1)[:, reach - 1])
    first, last = np.searchsorted(points, at - h), np.searchsorted(points, at + h, "right")
    for start in range(0, len(at), _TOGETHER):
        places = slice(start, min(start + _TOGETHER, len(at)))
        window = slice(int(first[places].min()), int(last[places].max()))
        relative = (points[window] - at[places, None]) / h[places, None]
        yield places, window, _parabolas(relative, weights[window], degree)


def _parabolas(relative: Array, weights: Array, degree: int) -> Array:
    """Return weights (m, n) of points (n,) with which parabolas through them have their values at m places.

    `relative` (m, n) are the positions of the points from the places, in half-widths of the kernel.
    """
    # By polynomials that are orthogonal with these weights, as stable as least squares by orthogonal matrices.
    cube = np.abs(relative)
    cube *= cube * cube
    kernel = np.maximum(0.0, 1.0 - cube)
    kernel *= kernel * kernel * weights
    total = kernel.sum(axis=1)[:, None]
    if degree == 0:
        return np.asarray(kernel / total)
    middle = np.einsum("ij,ij->i", kernel, relative)[:, None] / total
    line = relative - middle
    along = kernel * line
    squares = np.einsum("ij,ij->i", along, line)[:, None]
    found = 1.0 / total + line * _over(-middle, squares, total)
    if degree == 2:
        bent = line * line
        skew = _over(np.einsum("ij,ij->i", along, bent)[:, None], squares, total)
        bent -= skew * line
        bent -= squares / total
        there = (middle + skew) * middle - squares / total
        found += bent * _over(there, np.einsum("ij,ij,ij->i", kernel, bent, bent)[:, None], total)
    return np.asarray(kernel * found)


def _over(value: Array, squares: Array, total: Array) -> Array:
    """Return `value` over sums of squares, and zero where these are the rounding of `total`."""
    sound = squares > np.finfo(float).eps ** 2 * total
    return np.divide(value, squares, out=np.zeros(squares.shape), where=sound)


@dataclass(frozen=True, eq=False)
class FrictionMasterCurve(Plotted):
    """Viscoelastic friction against reduced speed, μ(v, T) = μ(α(T) v, reference).

    Called with a speed and a temperature it gives μ(v, T).  The value is that of a local quadratic regression
    in log10(αv): tricube kernel of half-width 0.25 decades, wider where points are sparse so that it reaches
    the five nearest; every point weighs 1/(s² + m²), s its own standard error, that of few replicates averaged with
    its neighbours', m the median of all.  Points more than two standard errors off the others weigh less by the
    square of their distance; those off by more than chance explains, if they are a tenth at most, have a note.  From 10
    points without noise per decade it is accurate to 0.5 % around a maximum where the slope of log μ over log v
    changes by 1 per decade, and to 1 % at the sharpest there is, that of one retardation time.  Stretches
    wider than half a decade without points are not bridged, and nothing is extrapolated; use `predict_friction`
    beyond the measured range.

    With a load rule, that of an indenter whose contacts are similar at all loads, the curve holds at one load and
    without vertical shift, and gives friction at any load: μ(v, T, F) = f^q μ(α(T) v/f^p, reference, load), with
    f = F/(b(T) load); p = q = 1/3 for a ball or ellipsoid, 1/2 for a cylinder, p = 1/2 and q = 0 for a cone.

    Attributes
    ----------
    reduced_speed : (n,) array
        α(T) v, or α(T) v/f^p with a load rule; ascending, m/s.
    temperature : (n,) array
        At which the point was measured or predicted, K.
    friction_coefficient, friction_error, friction_scatter : (n,) array
        Viscoelastic friction coefficient, its standard error, its standard deviation over the replicates; with a load
        rule divided by f^q.
    reference : float
        Temperature at which the reduced speed is the speed, K.
    shift : ShiftLaw
        With α(reference) = 1: as given, or as found from the curves.
    curves : FrictionCurves
        What was shifted.
    overlap : Collapse
        How well the curves coincide.
    load : float
        At which the curve holds, in the curves' `load_unit`.
    load_rule : LoadRule or None
        Relation to friction at other loads; None without one.
    vertical_shift : VerticalShift or None
        b(T), 1 at the reference; None for b = 1.
    found : bool
        Whether the shift factors were found from the curves.
    notes : tuple of str
        Temperatures left out and doubts, one sentence each.
    level_error : float
        Relative standard error of friction that all points of a temperature share.
    """

    reduced_speed: Array
    temperature: Array
    friction_coefficient: Array
    friction_error: Array
    friction_scatter: Array
    reference: float
    shift: ShiftLaw
    curves: FrictionCurves
    overlap: Collapse
    load: float
    load_rule: LoadRule | None = None
    vertical_shift: VerticalShift | None = None
    found: bool = False
    notes: tuple[str, ...] = ()
    level_error: float = 0.0

    def __len__(self) -> int:
        return len(self.reduced_speed)

    def _shown(self) -> Rows:
        return (
            ("reduced speed", self.reduced_speed, "m/s"),
            ("friction coefficient", self.friction_coefficient),
            ("its error", self.friction_error),
            ("temperature", np.unique(self.temperature), "°C"),
            ("reference", self.reference, "°C"),
            ("load", self.load, self.curves.load_unit),
            ("shift factors", "found" if self.found else "given"),
            ("overlap (rms)", self.overlap.rms, "%"),
            ("notes", self.notes),
        )

    @property
    def curves_at_load(self) -> FrictionCurves:
        """The curves at the load of the master curve and without vertical shift, in the order of `curves`.

        Without a load rule they are `curves`.
        """
        if self.load_rule is None:
            return self.curves
        return self.load_rule.reduced(self.curves, self.load, self.vertical_shift)

    @property
    def shift_factors(self) -> ShiftFactors:
        """The shift factors with their covariance: those found or given, or a given law's at the temperatures.

        Raises
        ------
        InputError
            If a law was given and there is one temperature only, or the reference lies outside them.
        """
        if isinstance(self.shift, ShiftFactors):
            return self.shift
        kelvin = self.curves.temperatures
        return ShiftFactors(kelvin, self.shift.log10(kelvin), self.reference, self.shift.covariance_at(kelvin))

    def to_dataset(self) -> Dataset:
        """Return the points as a labelled data set along ``point``, with units and long names.

        The friction is that at the load of the curve; the attributes are ``reference_temperature`` (K) and ``load`` (in
        the curves' `load_unit`).
        """
        return dataset(
            "point",
            {
                "reduced_speed": (self.reduced_speed, "m/s", "speed times shift factor"),
                "temperature": (self.temperature, *LABELS["temperature"]),
                "viscoelastic": (self.friction_coefficient, *LABELS["viscoelastic"]),
                "viscoelastic_error": (self.friction_error, *LABELS["viscoelastic_error"]),
                "viscoelastic_scatter": (self.friction_scatter, *LABELS["viscoelastic_scatter"]),
            },
            attributes={"reference_temperature": self.reference, "load": self.load},
        )

    @property
    def reduced_range(self) -> tuple[float, float]:
        """Lowest and highest reduced speed, m/s."""
        return float(self.reduced_speed[0]), float(self.reduced_speed[-1])

    @property
    def stretches(self) -> tuple[tuple[float, float], ...]:
        """Lowest and highest reduced speed (m/s) of each stretch without a gap above half a decade."""
        return tuple((float(10.0**low), float(10.0**high)) for low, high in self._smoothed.stretches)

    @cached_property
    def _smoothed(self) -> SmoothedPoints:
        kelvin = nominal_temperatures(self.temperature)
        sharing = self.level_error * (np.unique(kelvin)[:, None] == kelvin)
        error = standard_errors(self.curves_at_load)[self._order]
        return SmoothedPoints(np.log10(self.reduced_speed), self.friction_coefficient, error, sharing)

    @cached_property
    def _order(self) -> Indices:
        return np.argsort(reduced_decades(self.curves_at_load, self.shift, found=self.found), kind="stable")

    def own_notes(self) -> tuple[Note, ...]:
        """Return notes on replicates that were inferred for averaged errors, and on points off the curve, if any."""
        inferred = error_freedom(self.curves_at_load)[1]
        speed, smoothed = self.curves.speed[self._order], self._smoothed
        off = outlying_points(speed, self.temperature, smoothed.outlying, relative=not smoothed.stated)
        return *inferred, *off

    def __call__(
        self, speed: Quantities, temperature: Quantities | None = None, *, load: Quantity | None = None
    ) -> Any:
        """Return μ(v, T), at a load.

        Parameters
        ----------
        speed : float, str, pint.Quantity, or an array or list of them
            Above zero; m/s if plain numbers.
        temperature : the same, optional
            K if plain numbers; the reference if left out.  Broadcast against `speed`.
        load : float, str or pint.Quantity, optional
            In the curves' `load_unit` if a plain number; that of the curve if left out.  Without a load rule it must
            be that of the curve, to 5 %.

        Returns
        -------
        float or array
            In the broadcast shape of both; a float if both are single values.

        Raises
        ------
        InputError
            If the reduced speed lies outside the range that was measured, or in a gap; if α is not known at the
            temperature; or at another load without a load rule.
        """
        return self._read(self._smoothed.read, speed, temperature, load)

    def standard_error(
        self, speed: Quantities, temperature: Quantities | None = None, *, load: Quantity | None = None
    ) -> Any:
        """Return the standard error of μ(v, T), arguments as of a call.

        It is that of the points' errors, enlarged by one factor where the points scatter about the curve by more than
        these and the `level_error` of each temperature explain, with this level error; that of the scatter alone where
        all stated errors are zero.  Errors of the shift factors add to it, as far as they are known: they move the
        points of other temperatures along the curve.  Near points of unknown (infinite) error it is infinite.
        """
        _, kelvin, _ = self._arguments(speed, temperature)
        return self._read(lambda decades: self._error(decades, kelvin.ravel()), speed, temperature, load)

    def _error(self, decades: Array, kelvin: Array) -> Array:
        """Return standard errors (m,) at places (m,), read at temperatures (m,), with those of the shift factors."""
        every, number = np.unique([*nominal_temperatures(self.temperature), *kelvin], return_inverse=True)
        values, axes = np.linalg.eigh(self.shift.covariance_at(every))
        if not np.any(values > 0.0):
            return self._smoothed.standard_error(decades)
        moves = (axes * np.sqrt(np.maximum(values, 0.0)))[number]
        return self._smoothed.standard_error(decades, moves[len(self) :], moves[: len(self)])

    def covers(self, speed: Quantities, temperature: Quantities | None = None, *, load: Quantity | None = None) -> Any:
        """Return whether μ(v, T) is known: the reduced speed lies where there are points, and α is known at T.

        Arguments, shape and errors are those of a call, but nothing is refused for lack of points or of α.
        """
        velocity, kelvin, single = self._arguments(speed, temperature)
        relative = self._relative_load(load)
        inside = np.full(velocity.shape, False)
        for one in np.unique(kelvin):
            rows = kelvin == one
            try:
                decades, _ = self._reduced(velocity[rows], kelvin[rows], relative)
            except InputError:
                continue
            inside[rows] = self._smoothed.covers(decades)
        return bool(inside) if single else inside

    def _arguments(self, speed: Quantities, temperature: Quantities | None) -> tuple[Array, Array, bool]:
        """Return speeds and temperatures of one shape, and whether both are single."""
        velocity = to_si_in_shape(speed, "m/s", "speed")
        kelvin = to_si_in_shape(self.reference if temperature is None else temperature, "K", "temperature")
        try:
            velocity, kelvin = np.broadcast_arrays(velocity, kelvin)
        except ValueError:
            raise InputError(
                f"speed and temperature have {np.size(velocity)} and {np.size(kelvin)} values: must be as "
                "many, or one of them single.",
                code="different-lengths",
            ) from None
        if not np.all(velocity > 0.0):
            raise InputError(
                f"speed must be above zero everywhere, but one is {shown_number(float(velocity.min()), 'g')} m/s.",
                code="not-positive",
            )
        return velocity, kelvin, velocity.ndim == 0

    def _relative_load(self, load: Quantity | None) -> float:
        unit = self.curves.load_unit
        wanted = self.load if load is None else positive(load, unit, "load")
        if self.load_rule is None and not abs(wanted - self.load) <= SAME_LOAD * self.load:
            raise InputError(
                f"load = {wanted:.3g} {unit}: the master curve holds at {self.load:.3g} {unit}; friction at other "
                "loads needs the indenter: shift_friction(…, indenter=…).",
                code="indenter-needed",
            )
        return wanted / self.load

    def _reduced(self, velocity: Array, kelvin: Array, relative: float) -> tuple[Array, Array]:
        """Return log10 of the reduced speed, and the factor of friction on the curve."""
        decades = np.log10(velocity) + np.asarray(self.shift.log10(np.asarray(kelvin)))
        if self.load_rule is None:
            return decades, np.ones(decades.shape)
        vertical = 1.0 if self.vertical_shift is None else np.asarray(self.vertical_shift(kelvin.ravel()))
        speed_factor, friction_factor = self.load_rule.factors(np.asarray(relative / vertical))
        shape = velocity.shape if np.ndim(vertical) else ()
        return decades - np.log10(speed_factor.reshape(shape)), np.ones(decades.shape) * friction_factor.reshape(shape)

    def _read(
        self,
        of: Callable[[Array], Array],
        speed: Quantities,
        temperature: Quantities | None,
        load: Quantity | None,
    ) -> Any:
        velocity, kelvin, single = self._arguments(speed, temperature)
        decades, factor = self._reduced(velocity, kelvin, self._relative_load(load))
        covered = self._smoothed.covers(decades)
        if not np.all(covered):
            self._refuse(10.0 ** float(decades[~covered][0]))
        found = of(decades.ravel()).reshape(velocity.shape) * factor
        return float(found) if single else found

    def _refuse(self, reduced: float) -> None:
        there = " and ".join(f"{low:.3g} to {high:.3g} m/s" for low, high in self.stretches)
        low, high = self.reduced_range
        place = "in the gap between"
        if not low <= reduced <= high:
            decades = np.log10(low / reduced) if reduced < low else np.log10(reduced / high)
            place = f"{decades:.2g} decades {'below' if reduced < low else 'above'}"
        raise InputError(
            f"reduced speed α(T)·v = {reduced:.3g} m/s at {shown_celsius(self.reference)} °C is not covered: "
            f"friction is known for {there}, and this lies {place}; predict it there with predict_friction().",
            code="not-covered",
        )
