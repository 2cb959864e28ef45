"""Labels of a rubber: what was measured, and what was made of it, with units and long names.

======================  ==========================================================================
``/isotherms``          the measured moduli (tensile) that were used
``/shift_factors``      log10 α of each isotherm with its standard error (and the vertical shift)
``/shift_law``          the law that is used, or the best one, over the same temperatures
``/laws``               every law that describes the shift factors, compared
``/superposition``      whether superposition holds: what was checked, in numbers and sentences
``/master_curve``       the isotherms shifted to the reference temperature, and the fit at the same points
``/spectrum``           the retardation spectrum at the reference temperature
``/spectrum_curve``     its storage and loss modulus over a wider range (with a band, if samples were drawn)
======================  ==========================================================================

A rubber that was ready has the last two only.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.rheology.cards.native import plain
from viscofric.rheology.shifts.laws import WLF
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.study.labels import dataset

if TYPE_CHECKING:
    import xarray

    from viscofric.data import IsothermalSweeps, MasterCurve
    from viscofric.rheology.material import Material
    from viscofric.rheology.shifts.law_comparison import LawComparison
    from viscofric.rheology.superposition.result import Superposition
    from viscofric.rheology.uncertainty.material_samples import MaterialSamples
    from viscofric.study.rubber import Rubber


def rubber_data(rubber: Rubber, samples: MaterialSamples | None = None) -> dict[str, xarray.Dataset]:
    """Label a rubber.

    Parameters
    ----------
    rubber : Rubber
        Of sweeps, or ready.
    samples : MaterialSamples, optional
        Draws of the rubber, for the bands.
    """
    groups: dict[str, xarray.Dataset] = {}
    if rubber.fit is not None and rubber.sweeps is not None:
        isotherms = _isotherms(rubber.sweeps.in_tension(rubber.material.poisson_ratio))
        groups["/isotherms"] = isotherms
        groups["/shift_factors"] = _shift_factors(rubber, rubber.fit, isotherms)
        groups["/superposition"] = _superposition(rubber.fit)
    curve = rubber.fit.master_curve if rubber.fit is not None else rubber.master_curve
    if curve is not None:
        groups["/master_curve"] = _master_curve(curve, rubber.material)
    if rubber.laws is not None:
        groups["/laws"] = _laws(rubber.laws)
    law = _shift_law(rubber)
    if law is not None:
        groups["/shift_law"] = law
    return groups | _spectrum(rubber.material, samples)


def _isotherms(sweeps: IsothermalSweeps) -> xarray.Dataset:
    return dataset(
        "reading",
        {
            "temperature": np.concatenate([np.full(len(one), one.temperature) for one in sweeps.isotherms]),
            "angular_frequency": np.concatenate([one.angular_frequency for one in sweeps.isotherms]),
            "storage_modulus": np.concatenate([one.storage_modulus for one in sweeps.isotherms]),
            "loss_modulus": np.concatenate([one.loss_modulus for one in sweeps.isotherms]),
        },
    )


def _shift_factors(rubber: Rubber, fit: Superposition, isotherms: xarray.Dataset) -> xarray.Dataset:
    factors = fit.shift_factors
    given = np.unique(isotherms["temperature"].values)
    attributes: dict[str, Any] = {
        "reference_temperature": factors.reference,
        "shift_used": rubber.shift_used,
        "shift_origin": rubber.shift_origin,
        "isotherms_given": len(given),
        "isotherms_used": len(factors.temperatures),
        "temperatures_given": json.dumps(given.tolist()),
        "overlap_rms_log10_storage": fit.quality.storage,
        "overlap_rms_log10_loss": fit.quality.loss,
        "neighbours": fit.quality.neighbours,
        "neighbours_without_overlap": fit.quality.without_overlap,
    }
    columns = {
        "temperature": factors.temperatures,
        "log10_shift_factor": factors.log10_values,
        "standard_error": factors.standard_errors,
    }
    if fit.vertical_shift is not None:
        attributes["vertical_shift"] = json.dumps(plain(fit.vertical_shift))
        columns["log10_vertical_shift"] = fit.vertical_shift.log10(factors.temperatures)
        errors = getattr(fit.vertical_shift, "standard_errors", None)
        if errors is not None:
            columns["vertical_standard_error"] = errors
    return dataset("temperature", columns, "temperature", **attributes)


def _shift_law(rubber: Rubber) -> xarray.Dataset | None:
    """Label α(T) as a law: the one that is used, or else the best one, over the temperatures that it was fitted on."""
    law = rubber.law
    if law is None:
        return None
    fit, ends = rubber.fit, law.fitted_range or (law.reference - 50.0, law.reference + 50.0)
    attributes: dict[str, Any] = {"law": law.title, "constants": json.dumps(plain(law)), "told": str(law)}
    if fit is not None:
        law = law if law.kind == "polynomial" else law.unbounded()
        ends = float(fit.shift_factors.temperatures[0]), float(fit.shift_factors.temperatures[-1])
        residual = fit.shift_factors.log10_values - law.log10(fit.shift_factors.temperatures)
        attributes["rms"] = float(np.sqrt(np.mean(residual**2)))
    if isinstance(law, WLF):
        attributes |= {"wlf_C1": law.C1, "wlf_C2": law.C2}
        if law.standard_errors is not None:
            attributes |= {"wlf_C1_error": law.standard_errors[0], "wlf_C2_error": law.standard_errors[1]}
    kelvin = np.linspace(max(ends[0], law.extrapolation_limits[0] + 1.0), ends[1], 201)
    columns = {"temperature": kelvin, "log10_shift_factor": law.log10(kelvin)}
    if law.standard_errors is not None:
        columns["standard_error"] = law.standard_error(kelvin)
    return dataset("temperature", columns, "temperature", **attributes)


def _laws(laws: LawComparison) -> xarray.Dataset:
    fitted = [row for row in laws.rows if row.law is not None]
    lowest = min(row.aic for row in fitted)
    refused = {row.title: row.refusal for row in laws.rows if row.law is None}
    return dataset(
        "fitted_law",
        {
            "law": [row.title for row in fitted],
            "constants": [str(row.law) for row in fitted],
            "information_criterion": [row.aic - lowest for row in fitted],
            "akaike_weight": [row.weight for row in fitted],
            "law_scatter": [row.scatter for row in fitted],
        },
        chosen=laws.chosen.title,
        explanation=laws.explanation,
        refused=json.dumps(refused, ensure_ascii=False),
    )


def _superposition(fit: Superposition) -> xarray.Dataset:
    """Label whether superposition holds, and whether E' and E'' belong to each other; the verdicts are attributes."""
    check = fit.check
    *holding, causality = check.sentences
    return dataset(
        "isotherm",
        {"temperature": fit.shift_factors.temperatures},
        verdict=check.verdict,
        holds=int(check.holds),
        roughly=int(check.roughly),
        figure_of_merit=check.figure_of_merit,
        sentences=json.dumps(holding, ensure_ascii=False),
        consistent=int(check.consistent),
        causality=causality,
    )


def _master_curve(curve: MasterCurve, material: Material) -> xarray.Dataset:
    columns = {
        "angular_frequency": curve.angular_frequency,
        "storage_modulus": curve.storage_modulus,
        "loss_modulus": curve.loss_modulus,
        "temperature": curve.temperature,
    }
    attributes: dict[str, Any] = {"reference_temperature": curve.reference}
    quality = material.spectrum.fit if isinstance(material.spectrum, RetardationSpectrum) else None
    if quality is not None:  # a liquid has no spectrum
        fitted = material.spectrum.complex_modulus(curve.angular_frequency)
        columns |= {"fitted_storage_modulus": fitted.real, "fitted_loss_modulus": fitted.imag}
        attributes |= {"rms_log10_storage": quality.rms_storage, "rms_log10_loss": quality.rms_loss}
    return dataset("reading", columns, **attributes)


def _spectrum(material: Material, samples: MaterialSamples | None) -> dict[str, xarray.Dataset]:
    spectrum = material.spectrum
    if not isinstance(spectrum, RetardationSpectrum):
        return {}
    quality = spectrum.fit
    attributes: dict[str, Any] = {"E0": spectrum.E0, "E_inf": spectrum.E_inf}
    if quality is not None:
        attributes |= {
            "E0_remark": quality.E0_remark,
            "E_inf_remark": quality.E_inf_remark,
            "E_inf_at_limit": int(quality.E_inf_at_limit),
            "statements": json.dumps(list(quality.notes), ensure_ascii=False),
        }
    wide = _wide(spectrum)
    modulus = spectrum.complex_modulus(wide)
    columns = {"angular_frequency": wide, "storage_modulus": modulus.real, "loss_modulus": modulus.imag}
    if samples is not None:
        band = samples.modulus_band(wide)
        columns |= {
            "storage_modulus_lower": band.lower.real,
            "storage_modulus_upper": band.upper.real,
            "loss_modulus_lower": band.lower.imag,
            "loss_modulus_upper": band.upper.imag,
        }
    return {
        "/spectrum": dataset("mode", {"retardation_time": spectrum.tau, "creep_coefficient": spectrum.C}, **attributes),
        "/spectrum_curve": dataset("angular_frequency", columns, "angular_frequency"),
    }


def _wide(spectrum: RetardationSpectrum) -> Any:
    """Return angular frequencies two decades beyond what was measured, or beyond the modes."""
    low, high = (1.0 / spectrum.tau.max(), 1.0 / spectrum.tau.min()) if len(spectrum) else (1.0, 1.0)
    if spectrum.fit is not None:
        low, high = spectrum.fit.frequency_range
    return np.geomspace(low / 100.0, high * 100.0, 600)
