"""Agreement of predicted with measured friction: bias, root mean square difference, fraction within error."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from typing import Any, NamedTuple, overload

import numpy as np

from viscofric.arrays import Array, Integers, Mask
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.friction.curve_checks import error_freedom, shared_level
from viscofric.friction.curves import FrictionCurves, insist_on_curves
from viscofric.friction.intervals import half_widths
from viscofric.friction.shifting.master_curve import FrictionMasterCurve
from viscofric.nominal import SAME_LOAD, nominal_rows
from viscofric.notes import Remedy
from viscofric.showing import Plotted, Rows
from viscofric.units import shown_celsius, shown_number

#: Probability of a normal error below twice its standard deviation.
WITHIN = 0.9545
# Points are the same within rounding of units, not within scatter: predictions are made at the measured
# points.
_SAME_SPEED = 1e-6  # relative
_SAME_TEMPERATURE = 1e-3  # K
_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class Agreement(Plotted):
    """Agreement of a prediction with a measurement, over all points and temperature by temperature.

    With d = (predicted − measured) / measured at each measured point:

    Attributes
    ----------
    bias : float
        Mean of d: above zero where the prediction is too high.
    rms : float
        Root mean square of d.
    share_within_error : float or None
        Share of the points where predicted and measured differ by at most twice the combined standard error
        √(s² + e² + m²), with s the standard error of the measured mean, e the numerical error of the prediction and m
        its standard error due to the material, where the prediction has one; of few degrees of freedom, s is enlarged
        as Student's interval is, so that 95 % of sound points are within.  Points whose s is not known (infinite) are
        left out; None if there are no others.
    points : int
    temperature : (k,) array
        Different temperatures, K, ascending: means of those that scatter about one.
    bias_at, rms_at, share_within_error_at : (k,) array
        The same for the points of each temperature; a share is NaN where there is no such point.
    points_at : (k,) array of int
    relative_difference : (n,) array
        d in the order of the measured points.
    bias_error : float
        Standard error of `bias`; s and e are taken as independent from point to point, m as one error of all points,
        the least favourable case, and so is s where Coulomb friction is assumed.  Infinite if any s is.  The part of s
        that the speeds of a temperature share, as `separate` notes it, is one error of each temperature, and so is the
        ``level_error`` of a measured master curve, of which s may hold only a part.
    bias_error_at : (k,) array
    share_within_scatter : float or None
        Share of the points where predicted and measured differ by at most the standard deviation over the measured
        replicates, of those that were repeated; None if there are none.
    share_within_scatter_at : (k,) array
        NaN where no point of that temperature was repeated.
    repeated : int
        Points that were measured more than once.
    material_counted : bool
        Whether the prediction includes the material's errors, m.
    along_reduced_speed : bool
        Whether master curves were compared, at equal reduced speeds.
    not_covered : int
        Measured points of a master curve outside the predicted one; they are left out.
    with_error : int
        Points whose s is known.
    """

    bias: float
    rms: float
    share_within_error: float | None
    points: int
    temperature: Array
    bias_at: Array
    rms_at: Array
    share_within_error_at: Array
    points_at: Integers
    relative_difference: Array
    bias_error: float
    bias_error_at: Array
    share_within_scatter: float | None
    share_within_scatter_at: Array
    repeated: int
    material_counted: bool
    along_reduced_speed: bool = False
    not_covered: int = 0
    with_error: int = 0

    def _shown(self) -> Rows:
        return (
            ("points", self.points),
            ("bias", self.bias, "%", self.bias_error),
            ("rms difference", self.rms, "%"),
            ("share within twice the error", self.share_within_error, "%"),
            ("share within the scatter", self.share_within_scatter, "%"),
            ("temperature", self.temperature, "°C"),
        )

    def to_dataset(self) -> Dataset:
        """Return the numbers of each temperature as a labelled data set along ``temperature``.

        Those over all points are attributes of the same names; ``sentences`` is a JSON list with the agreement in
        words.
        """
        words = {
            "bias": "mean relative difference of prediction and measurement",
            "rms": "root mean square relative difference",
            "share_within_error": "share of points within twice the combined standard error",
            "points": "points compared",
            "bias_error": "standard error of the mean relative difference",
            "share_within_scatter": "share of repeated points within the scatter of the repetitions",
        }
        return dataset(
            "temperature",
            {name: (getattr(self, f"{name}_at"), "1", long_name) for name, long_name in words.items()},
            coordinates={"temperature": (self.temperature, "K", "temperature")},
            attributes={name: getattr(self, name) for name in words}
            | {
                "material_counted": int(self.material_counted),
                "sentences": json.dumps([str(self)], ensure_ascii=False),
            },
        )

    def __str__(self) -> str:
        where = "On the master curve, over" if self.along_reduced_speed else "Over"
        known = math.isfinite(self.bias_error)
        error = f"standard error ±{100 * self.bias_error:.1f} %" if known else "standard error unknown"
        counted = " (including the material's)" if self.material_counted else ""
        words = (
            f"{where} {self.points} points the predicted friction is on average {abs(100 * self.bias):.1f} % "
            f"{'above' if self.bias >= 0 else 'below'} the measured one ({error}); the rms difference is "
            f"{100 * self.rms:.1f} %."
        )
        shares = []
        if self.share_within_error is not None:
            of = "points" if self.with_error == self.points else f"{self.with_error} points with a known error"
            shares.append(f"twice the standard error{counted} at {100 * self.share_within_error:.0f} % of the {of}")
        if self.share_within_scatter is not None:
            of = "points" if self.repeated == self.points else f"{self.repeated} repeated points"
            shares.append(f"the scatter of the replicates at {100 * self.share_within_scatter:.0f} % of the {of}")
        if shares:
            words += f" The difference is within {', and within '.join(shares)}."
        if self.share_within_error is None:
            words += " No standard error of the measured friction is known."
        if self.not_covered:
            words += f" {self.not_covered} more points lie outside the predicted master curve."
        return words


@overload
def compare(measured: FrictionCurves, predicted: FrictionCurves) -> Agreement: ...
@overload
def compare(measured: FrictionMasterCurve, predicted: FrictionMasterCurve) -> Agreement: ...
def compare(
    measured: FrictionCurves | FrictionMasterCurve, predicted: FrictionCurves | FrictionMasterCurve
) -> Agreement:
    """Compare the viscoelastic friction measured with that predicted, at equal speeds and temperatures.

    Or that of two master curves, at equal reduced speeds.

    Curves are compared at each point with the prediction for its speed and temperature; errors of α(T) and of the
    spectrum both show.  Master curves are compared at equal reduced speeds, each with its own shift factors: measured
    friction shifted by factors found from itself tests the spectrum alone, and a deviation between the curves, but not
    between the master curves, is due to α(T).

    Parameters
    ----------
    measured : FrictionCurves or FrictionMasterCurve
        With viscoelastic friction above zero.
    predicted : FrictionCurves or FrictionMasterCurve
        Curves solved at the measured points, as with ``speeds=measured.speeds, temperatures=measured.temperatures``
        (and perhaps at others), or the master curve of predicted ones at the same reference, which is interpolated by
        its own smoothing.

    Returns
    -------
    Agreement

    Raises
    ------
    InputError
        If a measured point has no prediction at its speed, temperature and load (within 5 %), or its
        friction is not above zero; if master curves have different references or loads, or do not overlap; or if one is
        a master curve and the other is not.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> n = 3
    >>> curves = vf.FrictionCurves(
    ...     speed=np.array([0.02, 0.06, 0.2]),
    ...     temperature=np.full(n, 333.15),
    ...     load=np.full(n, 25.0),
    ...     viscoelastic=np.array([0.025, 0.020, 0.016]),
    ...     viscoelastic_error=np.full(n, 2e-4),
    ...     viscoelastic_scatter=np.full(n, 6e-4),
    ...     replicates=np.full(n, 9),
    ... )
    >>> predicted = vf.predict_friction(
    ...     vf.synthetic_fluoroelastomer(),
    ...     vf.Ball("9.525 mm"),
    ...     speeds=[0.02, 0.06, 0.2],
    ...     temperatures=333.15,
    ...     load=25.0,
    ...     accuracy=1e-2,
    ... )
    >>> agreement = vf.compare(curves, predicted)
    >>> agreement.points, agreement.rms < 0.05
    (3, True)
    """
    shifted = isinstance(measured, FrictionMasterCurve)
    if shifted != isinstance(predicted, FrictionMasterCurve):
        raise InputError(
            "measured and predicted: one is a master curve and the other is not; compare curves with curves, or shift "
            "both with shift_friction.",
            code="one-master-curve",
        )
    if isinstance(measured, FrictionMasterCurve) and isinstance(predicted, FrictionMasterCurve):
        points, level = measured.curves, measured.level_error
        _insist_on_friction(points)
        pairs = along_reduced_speed(measured, predicted)
    else:
        points, level = insist_on_curves(measured, "measured"), 0.0
        _insist_on_friction(points)
        pairs = point_by_point(points, insist_on_curves(predicted, "predicted"))
    return _agreement(pairs, level, shifted, len(points) - len(pairs.measured))


def _insist_on_friction(measured: FrictionCurves) -> None:
    if not len(measured):
        raise InputError("measured friction curves contain no points; there is nothing to compare.", code="no-points")
    if not np.all(measured.viscoelastic > 0.0):
        raise InputError(
            "viscoelastic of measured friction curves must be above zero everywhere for a relative difference, but one "
            f"is {shown_number(float(measured.viscoelastic.min()), '.3g')}; leave out its whole speed or temperature",
            code="friction-not-positive",
            remedy=Remedy(" with select()", "", page="") + " (points below zero alone would be a biased choice).",
        )


def _agreement(pairs: Pairs, level: float, shifted: bool, not_covered: int) -> Agreement:
    measured = pairs.measured
    difference = pairs.predicted - measured.viscoelastic
    relative = difference / measured.viscoelastic
    size, error = np.abs(measured.viscoelastic), measured.viscoelastic_error
    shared = np.maximum(level * size, np.minimum(shared_level(measured) * size, error))
    own = np.sqrt(np.maximum(error**2 - shared**2, 0.0) + pairs.numerical_error**2)
    material = np.zeros(len(measured)) if pairs.material_error is None else pairs.material_error
    likely = half_widths(measured.viscoelastic_error, error_freedom(measured)[0], WITHIN)
    rest = 2.0 * np.hypot(pairs.numerical_error, material)
    within = np.abs(difference) <= np.hypot(likely, rest)
    known = np.isfinite(measured.viscoelastic_error)
    repeated = (measured.replicates > 1) & np.isfinite(measured.viscoelastic_scatter)
    in_scatter = np.abs(difference) <= measured.viscoelastic_scatter
    own, shared, material = (one / measured.viscoelastic for one in (own, shared, material))
    if measured.assumption:  # an error of the assumed Coulomb friction is one of all points
        material = np.sqrt(own**2 + shared**2 + material**2)
        own = shared = np.zeros(len(measured))
    groups = [np.isin(np.arange(len(measured)), rows) for rows in nominal_rows(measured.temperature)]

    def numbers(rows: Mask) -> tuple[float, float, float, float, float]:
        """Return bias, rms, shares within error and within scatter, NaN without such points, and error of the bias."""
        # Of terms with independent errors, errors of groups and a common one.
        squares = np.sum(own[rows] ** 2) + sum(shared[rows & group].sum() ** 2 for group in groups)
        return (
            float(relative[rows].mean()),
            float(np.sqrt(np.mean(relative[rows] ** 2))),
            _share(within[rows & known]),
            _share(in_scatter[rows & repeated]),
            float(np.hypot(np.sqrt(squares) / np.count_nonzero(rows), material[rows].mean())),
        )

    names = ("bias", "rms", "share_within_error", "share_within_scatter", "bias_error")
    whole = [None if math.isnan(one) else one for one in numbers(np.full(len(measured), True))]
    each = np.array([numbers(group) for group in groups]).T
    of_all: dict[str, Any] = dict(zip(names, whole, strict=True))
    at: dict[str, Any] = {f"{name}_at": column for name, column in zip(names, each, strict=True)}
    return Agreement(
        **of_all,
        **at,
        points=len(measured),
        temperature=np.array([measured.temperature[group].mean() for group in groups]),
        points_at=np.array([np.count_nonzero(group) for group in groups]),
        relative_difference=relative,
        repeated=int(np.count_nonzero(repeated)),
        material_counted=pairs.material_error is not None,
        along_reduced_speed=shifted,
        not_covered=not_covered,
        with_error=int(np.count_nonzero(known)),
    )


def _share(within: Mask) -> float:
    return float(within.mean()) if within.size else math.nan


class Pairs(NamedTuple):
    """Measured points, (n,) each, and the prediction for each of them."""

    measured: FrictionCurves
    predicted: Array
    numerical_error: Array
    material_error: Array | None


def point_by_point(measured: FrictionCurves, predicted: FrictionCurves) -> Pairs:
    """Return the prediction for the speed, temperature and load of each measured point, or raise `InputError`."""
    rows = np.array([partner(measured, row, predicted) for row in range(len(measured))])
    material = predicted.material_error
    return Pairs(
        measured,
        predicted.viscoelastic[rows],
        predicted.viscoelastic_error[rows],
        None if material is None else material[rows],
    )


def along_reduced_speed(measured: FrictionMasterCurve, predicted: FrictionMasterCurve) -> Pairs:
    """Interpolate the predicted master curve at the reduced speeds of the measured points, where it is known."""
    if abs(measured.reference - predicted.reference) > _SAME_TEMPERATURE:
        raise InputError(
            f"master curves have different references, {shown_celsius(measured.reference, 'z.2f')} and "
            f"{shown_celsius(predicted.reference, 'z.2f')} °C; give shift_friction the same reference for both.",
            code="different-references",
        )
    loads = measured.load, predicted.load
    if abs(loads[0] - loads[1]) > SAME_LOAD * loads[0]:
        unit = measured.curves.load_unit
        raise InputError(
            f"master curves are of different loads, {loads[0]:.3g} and {loads[1]:.3g} {unit}; predict friction at the "
            "measured load.",
            code="different-loads",
        )
    points = measured.curves_at_load
    reduced = points.speed * np.asarray(measured.shift(points.temperature))
    covered = np.zeros(len(points), dtype=bool)
    for low, high in predicted.stretches:
        covered |= (reduced >= low * (1.0 - _ROUNDING)) & (reduced <= high * (1.0 + _ROUNDING))
    if not np.any(covered):
        low, high = predicted.reduced_range
        if low <= reduced.max() and reduced.min() <= high:
            raise InputError(
                "the predicted master curve cannot be interpolated at any of the measured reduced speeds: its points "
                "there lie more than half a decade apart; predict friction at more speeds.",
                code="sparse-prediction",
            )
        raise InputError(
            f"master curves do not overlap: friction was measured at reduced speeds from {reduced.min():.3g} to "
            f"{reduced.max():.3g} m/s and predicted from {low:.3g} to {high:.3g} m/s, both at "
            f"{shown_celsius(measured.reference)} °C.",
            code="no-overlap",
        )
    reduced = reduced[covered]
    friction = np.asarray(predicted(reduced))
    return Pairs(
        points.select(covered),
        friction,
        np.asarray(predicted.standard_error(reduced)),
        _material_error(predicted, reduced, friction),
    )


def _material_error(predicted: FrictionMasterCurve, reduced: Array, friction: Array) -> Array | None:
    """Return the standard error from the material, relative to friction interpolated along the reduced speed."""
    curves = predicted.curves_at_load
    if curves.material_error is None:
        return None
    place = np.log(curves.speed * np.asarray(predicted.shift(curves.temperature)))
    order = np.argsort(place, kind="stable")
    relative = (curves.material_error / curves.viscoelastic)[order]
    return np.asarray(friction * np.interp(np.log(reduced), place[order], relative))


def partner(measured: FrictionCurves, row: int, predicted: FrictionCurves) -> int:
    """Return the row of the prediction for a measured point."""
    speed, temperature, load = measured.speed[row], measured.temperature[row], measured.load[row]
    same = np.abs(predicted.speed - speed) <= _SAME_SPEED * speed
    same &= np.abs(predicted.temperature - temperature) <= _SAME_TEMPERATURE
    same &= np.abs(predicted.load - load) <= SAME_LOAD * load
    if not np.any(same):
        raise InputError(
            f"the point measured at {shown_celsius(float(temperature), 'z.2f')} °C, {1e3 * speed:.5g} mm/s and "
            f"{load:.3g} N has no prediction; predict friction at measured.speeds, measured.temperatures "
            "and the measured load.",
            code="no-prediction",
        )
    candidates = np.flatnonzero(same)
    return int(candidates[np.argmin(np.abs(predicted.load[candidates] - load))])
