"""Labels: every number of a study as a variable with unit and long name, in one tree.

The tree of a study's results (every variable in SI, with ``units`` and ``long_name``):

===========================  =====================================================================
``/isotherms`` …             the rubber: see `viscofric.study.rubber_labels`
``/prediction``              one entry per case asked for: see `viscofric.study.sweep_labels`
``/prediction_master``       friction at the reference temperature over the reduced speeds α(T)·v
``/measurement``             the separated measurement and the prediction at the same points (if measured)
``/measurement_master``      measured friction over the reduced speed, at the load of the master curve
``/agreement``               prediction against measurement, per temperature (if measured)
``/friction_shift_factors``  α(T) from friction alone, beside the modulus's (if measured, where curves overlap)
``/assumptions``             what the predictions take for granted, as checked
===========================  =====================================================================
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.study.cases.record import NUMBERS, Record

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray

    from viscofric.friction.agreement import Agreement
    from viscofric.friction.curves import FrictionCurves
    from viscofric.friction.shifting.master_curve import FrictionMasterCurve
    from viscofric.study.study_rubber import BandColumns

#: Variable -> unit, long name.
MEANING = {
    "temperature": ("K", "temperature"),
    "log10_shift_factor": ("1", "decadic logarithm of the shift factor"),
    "standard_error": ("1", "standard error of log10 of the shift factor"),
    "speed": ("m/s", "speed at which the rubber is deformed"),
    "reduced_speed": ("m/s", "speed times shift factor"),
    "load": ("N", "normal load"),
    "friction_coefficient": ("1", "viscoelastic friction coefficient"),
    "friction_error": ("1", "numerical error estimate of the friction coefficient"),
    "friction_material_error": ("1", "standard error of the friction coefficient that the rubber's uncertainty leaves"),
    "friction_lower": ("1", "lower end of the 95 % band of the friction coefficient"),
    "friction_upper": ("1", "upper end of the 95 % band of the friction coefficient"),
    "indentation": ("m", "indentation"),
    "indentation_error": ("m", "error estimate of the indentation"),
    "contact_area": ("m**2", "contact area"),
    "contact_area_error": ("m**2", "error estimate of the contact area"),
    "front": ("m", "distance from the axis to the leading edge"),
    "rear": ("m", "distance from the axis to the trailing edge"),
    "half_width": ("m", "half-width of the contact across the motion"),
    "edge_error": ("m", "error estimate of front, rear and half-width"),
    "max_pressure": ("Pa", "largest contact pressure"),
    "max_pressure_error": ("Pa", "error estimate of the largest contact pressure"),
    "pressure": ("Pa", "mean pressure"),
    "contact_area_fraction": ("1", "contact area fraction, real over nominal: points under pressure over all"),
    "mean_gap": ("m", "mean gap between the surfaces"),
    "lateral_friction_coefficient": ("1", "force across the motion over the load"),
    "centre_of_pressure": ("m", "distance of the centre of pressure ahead of the indenter's axis"),
    "interpolation_error": ("1", "what interpolating between solved contacts adds to the error of friction"),
    "energy_balance": ("1", "friction from the pressure less friction from dissipation, relative"),
    "complementarity": ("1", "largest violation of the contact conditions over the indentation"),
    "cells": ("1", "cells along the longer edge of the finest window"),
    "products": ("1", "products with the influence matrix"),
    "within_measured_frequencies": (
        "1",
        "whether v/a, reduced, lies within the measured frequencies (1), not (0); -1: failed",
    ),
    "interpolated": ("1", "whether it lies between solved contacts (1) or was solved itself (0)"),
    "failed": ("1", "whether the case could not be solved (1); its other variables are missing then"),
    "predicted": ("1", "predicted viscoelastic friction coefficient"),
    "predicted_error": ("1", "numerical error estimate of the predicted friction coefficient"),
    "predicted_material_error": ("1", "standard error of predicted friction that the rubber's uncertainty leaves"),
    "predicted_lower": ("1", "lower end of the 95 % band of the predicted friction coefficient"),
    "predicted_upper": ("1", "upper end of the 95 % band of the predicted friction coefficient"),
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
        name: (dimension, np.asarray(values), {"units": MEANING[name][0], "long_name": MEANING[name][1]})
        for name, values in columns.items()
    }
    result = xarray.Dataset(variables, attrs=attributes)
    return result.set_coords(coordinate) if coordinate else result


def prediction_data(records: Sequence[Record], within: Sequence[bool] | None, curves: FrictionCurves) -> xarray.Dataset:
    """Label solved cases, with whether they lie within the measured frequencies, and their bands, where known."""
    columns: dict[str, Any] = {name: [getattr(record, name) for record in records] for name in NUMBERS}
    columns |= band(curves, "friction")
    if within is not None:
        columns["within_measured_frequencies"] = np.array(within, dtype=np.int8)
    return dataset("case", columns)


def band(curves: FrictionCurves | BandColumns, name: str) -> dict[str, Any]:
    """Return the uncertainty that the rubber leaves on friction, where it is known."""
    found = {
        "material_error": curves.material_error,
        "lower": curves.viscoelastic_lower,
        "upper": curves.viscoelastic_upper,
    }
    return {f"{name}_{kind}": column for kind, column in found.items() if column is not None}


def measurement_data(
    measured: FrictionCurves,
    reduced_speed: Any,
    records: Sequence[Record | None],
    within: Sequence[bool] | None,
    predicted: FrictionCurves,
) -> xarray.Dataset:
    """Label the separated measurement with the prediction at the same points, NaN where it failed.

    `predicted` holds the points where it did not.
    """
    columns: dict[str, Any] = {"reduced_speed": reduced_speed}
    solved = np.array([record is not None for record in records])
    values = {"predicted": predicted.viscoelastic, "predicted_error": predicted.viscoelastic_error}
    for name, column in (values | band(predicted, "predicted")).items():
        columns[name] = np.full(len(records), np.nan)
        columns[name][solved] = column
    if within is not None:
        columns["within_measured_frequencies"] = np.array(within, dtype=np.int8)
    known = measured.to_dataset().reset_coords()
    known = known[[name for name in _MEASURED if name in known]].drop_attrs(deep=False)
    return _measured(known).merge(dataset("point", columns))


def measured_master_data(master: FrictionMasterCurve) -> xarray.Dataset:
    """Return measured friction over the reduced speed, all of it at the load of the master curve."""
    return _measured(master.to_dataset())


def _measured(data: xarray.Dataset) -> xarray.Dataset:
    """Say in their long names that friction coefficients were measured."""
    for name in ("viscoelastic", "coulomb"):
        if name in data:
            data[name].attrs["long_name"] = f"measured {data[name].attrs['long_name']}"
    return data


def agreement_data(agreement: Agreement, sentences: Sequence[str], left_out: int) -> xarray.Dataset:
    """Return how well prediction and measurement agree; sentences, also of the master curves, are an attribute."""
    words = json.dumps(list(sentences), ensure_ascii=False)
    return agreement.to_dataset().assign_attrs(sentences=words, left_out=left_out)
