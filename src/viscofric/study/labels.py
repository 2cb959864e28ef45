"""Labels: every number of a study as a variable with unit and long name, in one tree.

The tree of a study's results (every variable in SI, with ``units`` and ``long_name``):

======================  ==========================================================================
``/isotherms``          the measured moduli (tensile) that were used
``/shift_factors``      log10 α of each isotherm with its standard error, and the fitted WLF law
``/master_curve``       the isotherms shifted to the reference temperature, and the fit at the same points
``/spectrum``           the retardation spectrum at the reference temperature
``/spectrum_curve``     its storage and loss modulus over a wider range
``/prediction``         one entry per speed and temperature asked for
``/prediction_master``  friction at the reference temperature over the reduced speeds α(T)·v
``/measurement``        the separated measurement and the prediction at the same points (if measured)
``/agreement``          prediction against measurement, per temperature (if measured)
======================  ==========================================================================
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.errors import InputError
from viscofric.study.store import NUMBERS, CaseRecord

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray

    from viscofric.data import IsothermalSweeps
    from viscofric.friction.agreement import Agreement
    from viscofric.friction.curves import FrictionCurves
    from viscofric.rheology.shift_laws import WLF
    from viscofric.rheology.spectrum import RetardationSpectrum
    from viscofric.rheology.superposition import Superposition

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


def isotherm_data(sweeps: IsothermalSweeps) -> xarray.Dataset:
    """Label the measured moduli."""
    return dataset(
        "reading",
        {
            "temperature": np.concatenate([np.full(len(one), one.temperature) for one in sweeps.isotherms]),
            "angular_frequency": np.concatenate([one.angular_frequency for one in sweeps.isotherms]),
            "storage_modulus": np.concatenate([one.storage_modulus for one in sweeps.isotherms]),
            "loss_modulus": np.concatenate([one.loss_modulus for one in sweeps.isotherms]),
        },
    )


def shift_factor_data(
    fit: Superposition, law: WLF | None, isotherms: xarray.Dataset, shift_used: str
) -> xarray.Dataset:
    """Label the shift factors with the law fitted to them."""
    factors = fit.shift_factors
    given = np.unique(isotherms["temperature"].values)
    attributes: dict[str, Any] = {
        "reference_temperature": factors.reference,
        "shift_used": shift_used,
        "isotherms_given": len(given),
        "isotherms_used": len(factors.temperatures),
        "temperatures_given": json.dumps(given.tolist()),
        "overlap_rms_log10_storage": fit.quality.storage,
        "overlap_rms_log10_loss": fit.quality.loss,
    }
    if law is not None:
        residual = factors.log10_values - law.log10(factors.temperatures)
        attributes |= {"wlf_C1": law.C1, "wlf_C2": law.C2, "wlf_rms": float(np.sqrt(np.mean(residual**2)))}
        if law.standard_errors is not None:
            attributes |= {"wlf_C1_error": law.standard_errors[0], "wlf_C2_error": law.standard_errors[1]}
    return dataset(
        "temperature",
        {
            "temperature": factors.temperatures,
            "log10_shift_factor": factors.log10_values,
            "standard_error": factors.standard_errors,
        },
        "temperature",
        **attributes,
    )


def spectrum_data(fit: Superposition, spectrum: RetardationSpectrum) -> dict[str, xarray.Dataset]:
    """Label the master curve, the spectrum fitted to it and the curve of that spectrum."""
    curve = fit.master_curve
    fitted = spectrum.complex_modulus(curve.angular_frequency)
    quality = spectrum.fit
    if quality is None:
        raise InputError("spectrum: has not been fitted to a master curve.")
    wide = np.geomspace(curve.angular_frequency[0] / 100.0, curve.angular_frequency[-1] * 100.0, 600)
    smooth = spectrum.complex_modulus(wide)
    return {
        "/master_curve": dataset(
            "reading",
            {
                "angular_frequency": curve.angular_frequency,
                "storage_modulus": curve.storage_modulus,
                "loss_modulus": curve.loss_modulus,
                "temperature": curve.temperature,
                "fitted_storage_modulus": fitted.real,
                "fitted_loss_modulus": fitted.imag,
            },
            reference_temperature=curve.reference,
            rms_log10_storage=quality.rms_storage,
            rms_log10_loss=quality.rms_loss,
        ),
        "/spectrum": dataset(
            "mode",
            {"retardation_time": spectrum.tau, "creep_coefficient": spectrum.C},
            E0=spectrum.E0,
            E_inf=spectrum.E_inf,
            E0_extrapolated=int(quality.E0_extrapolated),
            E_inf_extrapolated=int(quality.E_inf_extrapolated),
            statements=json.dumps(list(quality.notes), ensure_ascii=False),
        ),
        "/spectrum_curve": dataset(
            "angular_frequency",
            {"angular_frequency": wide, "storage_modulus": smooth.real, "loss_modulus": smooth.imag},
            "angular_frequency",
        ),
    }


def prediction_data(records: Sequence[CaseRecord], within: Sequence[bool]) -> xarray.Dataset:
    """Label solved cases."""
    columns = {name: [getattr(record, name) for record in records] for name in NUMBERS}
    return dataset("case", {**columns, "within_measured_frequencies": np.array(within, dtype=np.int8)})


def measurement_data(
    measured: FrictionCurves, reduced_speed: Any, records: Sequence[CaseRecord | None], within: Sequence[bool]
) -> xarray.Dataset:
    """Label the separated measurement with the prediction at the same points, NaN where it failed."""
    columns: dict[str, Any] = {
        name: getattr(measured, name) for name in _MEASURED if getattr(measured, name) is not None
    }
    columns["reduced_speed"] = reduced_speed
    columns["predicted"] = [np.nan if record is None else record.friction_coefficient for record in records]
    columns["predicted_error"] = [np.nan if record is None else record.friction_error for record in records]
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
