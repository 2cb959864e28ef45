"""Pairs of measured and predicted friction, at the same conditions or at the same reduced speed."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.errors import InputError
from viscofric.nominal import SAME_LOAD
from viscofric.units import shown_celsius

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.friction.curves import FrictionCurves
    from viscofric.friction.shifting.master_curve import FrictionMasterCurve


# Points are the same within rounding of units, not within scatter: predictions are made at the measured
# points.
_SAME_SPEED = 1e-6  # relative
_SAME_TEMPERATURE = 1e-3  # K
_ROUNDING = 1e-9


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
    """Interpolate the predicted master curve at the reduced speeds of the measured points, where it is known.

    Raises InputError if references or loads differ, or the curves do not overlap.
    """
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
