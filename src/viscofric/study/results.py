"""Results of a study: labelled data with units and provenance, in memory and on disk.

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

import hashlib
import json
import platform
import tempfile
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.errors import DataFileError, InputError
from viscofric.study.store import NUMBERS, CaseRecord

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    import xarray

    from viscofric.data import IsothermalSweeps
    from viscofric.friction.agreement import Agreement
    from viscofric.friction.curves import FrictionCurves
    from viscofric.rheology.shift_laws import WLF
    from viscofric.rheology.spectrum import RetardationSpectrum
    from viscofric.rheology.superposition import Superposition

RESULTS_FILE = "results.nc"

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


@dataclass(frozen=True, eq=False)
class StudyResults:
    """Everything that a study found.

    Attributes
    ----------
    tree : xarray.DataTree
        See the layout above.
    folder : Path
        Where it is stored.
    """

    tree: xarray.DataTree
    folder: Path

    @property
    def failures(self) -> tuple[str, ...]:
        """Cases that could not be solved, one sentence each."""
        return tuple(json.loads(self.tree.attrs["failures"]))

    @property
    def warnings(self) -> tuple[str, ...]:
        """Assumptions that do not hold well, one sentence each."""
        return tuple(json.loads(self.tree.attrs["warnings"]))


def open_results(folder: str | Path) -> StudyResults:
    """Open the results of a study.

    Parameters
    ----------
    folder : str or Path
        The folder that `run_study` wrote, or the ``results.nc`` in it.

    Raises
    ------
    DataFileError
        If there are no results, or they cannot be read.
    """
    import xarray

    path = Path(folder)
    if path.is_dir():
        path = path / RESULTS_FILE
    if not path.is_file():
        raise DataFileError(path, "no such results file; run the study first.")
    try:
        with xarray.open_datatree(path, engine="h5netcdf") as stored:
            tree = stored.load()
    except Exception as error:  # h5py raises many kinds; all mean the same to the user
        raise DataFileError(path, f"cannot be read as results of viscofric ({error}).") from error
    return StudyResults(tree, path.parent)


def save_results(tree: xarray.DataTree, folder: Path) -> Path:
    """Write a tree to a folder's ``results.nc``; the file is there whole or not at all."""
    target = folder / RESULTS_FILE
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder, prefix=".results.") as temporary:
            path = Path(temporary) / RESULTS_FILE
            tree.to_netcdf(path, engine="h5netcdf")
            path.replace(target)
    except OSError as error:
        raise DataFileError(target, f"cannot be written ({error.strerror or error}).") from error
    return target


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


def shift_factor_data(fit: Superposition, law: WLF | None, shift_used: str) -> xarray.Dataset:
    """Label the shift factors with the law fitted to them."""
    factors = fit.shift_factors
    attributes: dict[str, Any] = {
        "reference_temperature": factors.reference,
        "shift_used": shift_used,
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


def prediction_data(records: Sequence[CaseRecord]) -> xarray.Dataset:
    """Label solved cases."""
    return dataset("case", {name: [getattr(record, name) for record in records] for name in NUMBERS})


def measurement_data(measured: FrictionCurves, reduced_speed: Any, records: Sequence[CaseRecord]) -> xarray.Dataset:
    """Label the separated measurement with the prediction at the same points."""
    columns: dict[str, Any] = {
        name: getattr(measured, name)
        for name in (
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
        if getattr(measured, name) is not None
    }
    columns["reduced_speed"] = reduced_speed
    columns["predicted"] = [record.friction_coefficient for record in records]
    columns["predicted_error"] = [record.friction_error for record in records]
    return dataset("point", columns)


def agreement_data(agreement: Agreement) -> xarray.Dataset:
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
    )


def provenance(inputs: Iterable[Path]) -> dict[str, str]:
    """Return what is needed to repeat a study: versions, time, and the hashes of its input files."""
    return {
        "viscofric_version": version("viscofric"),
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "input_hashes": json.dumps(
            {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in inputs}, ensure_ascii=False
        ),
        "software": json.dumps(
            {"Python": platform.python_version(), **{name: version(name) for name in ("numpy", "scipy", "xarray")}}
        ),
    }
