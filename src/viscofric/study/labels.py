"""Labels: every number of a study as a variable with unit and long name, in one tree.

The tree of a study's results (every variable in SI, with ``units`` and ``long_name``):

======================  ==========================================================================
``/isotherms`` …        the rubber: see `viscofric.study.rubber_labels`
``/prediction``         one entry per speed and temperature asked for
``/prediction_master``  friction at the reference temperature over the reduced speeds α(T)·v
``/measurement``        the separated measurement and the prediction at the same points (if measured)
``/agreement``          prediction against measurement, per temperature (if measured)
======================  ==========================================================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.study.store import NUMBERS, CaseRecord

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray

    from viscofric.friction.agreement import Agreement
    from viscofric.friction.curves import FrictionCurves

# variable -> unit, long name
_MEANING = {
    "temperature": ("K", "temperature"),
    "angular_frequency": ("rad/s", "angular frequency"),
    "storage_modulus": ("Pa", "storage modulus"),
    "loss_modulus": ("Pa", "loss modulus"),
    "fitted_storage_modulus": ("Pa", "storage modulus of the fitted spectrum"),
    "fitted_loss_modulus": ("Pa", "loss modulus of the fitted spectrum"),
    "log10_shift_factor": ("1", "decadic logarithm of the shift factor"),
    "standard_error": ("1", "standard error of log10 of the shift factor"),
    "log10_vertical_shift": ("1", "decadic logarithm of the vertical shift b"),
    "vertical_standard_error": ("1", "standard error of log10 of the vertical shift"),
    "storage_modulus_lower": ("Pa", "lower end of the 95 % band of the storage modulus"),
    "storage_modulus_upper": ("Pa", "upper end of the 95 % band of the storage modulus"),
    "loss_modulus_lower": ("Pa", "lower end of the 95 % band of the loss modulus"),
    "loss_modulus_upper": ("Pa", "upper end of the 95 % band of the loss modulus"),
    "law": ("1", "shift law"),
    "constants": ("1", "constants of the law"),
    "information_criterion": ("1", "corrected Akaike information criterion above that of the best law"),
    "law_scatter": ("1", "scatter of log10 of the shift factors about the law beyond their uncertainties"),
    "retardation_time": ("s", "retardation time"),
    "creep_coefficient": ("1/Pa", "creep coefficient C of the mode"),
    "speed": ("m/s", "speed at which the rubber is deformed"),
    "reduced_speed": ("m/s", "speed times shift factor"),
    "load": ("N", "normal load"),
    "friction_coefficient": ("1", "viscoelastic friction coefficient"),
    "friction_error": ("1", "numerical error estimate of the friction coefficient"),
    "indentation": ("m", "indentation"),
    "contact_area": ("m**2", "contact area"),
    "front": ("m", "distance from the axis to the leading edge"),
    "rear": ("m", "distance from the axis to the trailing edge"),
    "half_width": ("m", "half-width of the contact across the motion"),
    "max_pressure": ("Pa", "largest contact pressure"),
    "energy_balance": ("1", "friction from the pressure less friction from dissipation, relative"),
    "complementarity": ("1", "largest violation of the contact conditions over the indentation"),
    "cells": ("1", "cells along the longer edge of the finest window"),
    "products": ("1", "products with the influence matrix"),
    "within_measured_frequencies": ("1", "whether v/a, reduced, lies within the measured frequencies (1) or not (0)"),
    "replicates": ("1", "repetitions"),
    "viscoelastic": ("1", "measured viscoelastic friction coefficient"),
    "viscoelastic_error": ("1", "standard error of the viscoelastic friction coefficient"),
    "viscoelastic_scatter": ("1", "standard deviation of the viscoelastic friction coefficient"),
    "coulomb": ("1", "measured Coulomb friction coefficient"),
    "coulomb_error": ("1", "standard error of the Coulomb friction coefficient"),
    "coulomb_scatter": ("1", "standard deviation of the Coulomb friction coefficient"),
    "consistency": ("1", "what the sign configurations leave over, relative to the load"),
    "consistency_error": ("1", "standard error of the consistency"),
    "predicted": ("1", "predicted viscoelastic friction coefficient"),
    "predicted_error": ("1", "numerical error estimate of the predicted friction coefficient"),
    "bias": ("1", "mean relative difference of prediction and measurement"),
    "rms": ("1", "root mean square relative difference"),
    "share_within_error": ("1", "share of points within twice the combined standard error"),
    "points": ("1", "points compared"),
}


_MEASURED = (
    "speed",
    "temperature",
    "load",
    "replicates",
    "viscoelastic",
    "viscoelastic_error",
    "viscoelastic_scatter",
    "coulomb",
    "coulomb_error",
    "coulomb_scatter",
    "consistency",
    "consistency_error",
)


def dataset(
    dimension: str, columns: dict[str, Any], coordinate: str | None = None, **attributes: Any
) -> xarray.Dataset:
    """Return columns of equal length as a labelled data set, with units and long names."""
    import xarray

    variables = {
        name: (dimension, np.asarray(values), {"units": _MEANING[name][0], "long_name": _MEANING[name][1]})
        for name, values in columns.items()
    }
    result = xarray.Dataset(variables, attrs=attributes)
    return result.set_coords(coordinate) if coordinate else result


def prediction_data(records: Sequence[CaseRecord], within: Sequence[bool] | None) -> xarray.Dataset:
    """Label solved cases, with whether they lie within the measured frequencies, where those are known."""
    columns: dict[str, Any] = {name: [getattr(record, name) for record in records] for name in NUMBERS}
    if within is not None:
        columns["within_measured_frequencies"] = np.array(within, dtype=np.int8)
    return dataset("case", columns)


def measurement_data(
    measured: FrictionCurves, reduced_speed: Any, records: Sequence[CaseRecord | None], within: Sequence[bool] | None
) -> xarray.Dataset:
    """Label the separated measurement with the prediction at the same points, NaN where it failed."""
    columns: dict[str, Any] = {
        name: getattr(measured, name) for name in _MEASURED if getattr(measured, name) is not None
    }
    columns["reduced_speed"] = reduced_speed
    columns["predicted"] = [np.nan if record is None else record.friction_coefficient for record in records]
    columns["predicted_error"] = [np.nan if record is None else record.friction_error for record in records]
    if within is not None:
        columns["within_measured_frequencies"] = np.array(within, dtype=np.int8)
    return dataset("point", columns)


def agreement_data(agreement: Agreement, left_out: int) -> xarray.Dataset:
    """Label how well prediction and measurement agree."""
    return dataset(
        "temperature",
        {
            "temperature": agreement.temperature,
            "bias": agreement.bias_at,
            "rms": agreement.rms_at,
            "share_within_error": agreement.share_within_error_at,
            "points": agreement.points_at,
        },
        "temperature",
        bias=agreement.bias,
        rms=agreement.rms,
        share_within_error=agreement.share_within_error,
        points=agreement.points,
        left_out=left_out,
    )
