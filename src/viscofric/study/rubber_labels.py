"""Data sets of a material: what was measured, and what was made of it; each result labels itself.

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

from viscofric.rheology.spectra.retardation import RetardationSpectrum

if TYPE_CHECKING:
    import xarray

    from viscofric.data import IsothermalSweeps, MasterCurve
    from viscofric.rheology.material import Material
    from viscofric.rheology.superposition.result import Superposition
    from viscofric.rheology.uncertainty.material_samples import MaterialSamples
    from viscofric.study.rubber import Rubber


def rubber_data(rubber: Rubber, samples: MaterialSamples | None = None) -> dict[str, xarray.Dataset]:
    """Return the data sets of a material.

    Parameters
    ----------
    rubber : Rubber
        Of sweeps, or ready.
    samples : MaterialSamples, optional
        Draws of the rubber, for the bands.
    """
    groups: dict[str, xarray.Dataset] = {}
    if rubber.fit is not None and rubber.sweeps is not None:
        isotherms = rubber.sweeps.in_tension(rubber.material.poisson_ratio).to_dataset()
        groups["/isotherms"] = isotherms.drop_attrs(deep=False).drop_vars("strain_amplitude", errors="ignore")
        groups["/shift_factors"] = _shift_factors(rubber, rubber.fit, rubber.sweeps)
        groups["/superposition"] = rubber.fit.check.to_dataset()
    curve = rubber.fit.master_curve if rubber.fit is not None else rubber.master_curve
    if curve is not None:
        groups["/master_curve"] = _master_curve(curve, rubber.material)
    if rubber.laws is not None:
        groups["/laws"] = rubber.laws.to_dataset()
    law = _shift_law(rubber)
    if law is not None:
        groups["/shift_law"] = law
    return groups | _spectrum(rubber.material, samples)


def _shift_factors(rubber: Rubber, fit: Superposition, sweeps: IsothermalSweeps) -> xarray.Dataset:
    given = np.unique(sweeps.temperatures)
    return fit.to_dataset().assign_attrs(
        shift_used=rubber.shift_used,
        shift_origin=rubber.shift_origin,
        isotherms_given=len(given),
        temperatures_given=json.dumps(given.tolist()),
    )


def _shift_law(rubber: Rubber) -> xarray.Dataset | None:
    """Return the law that is used, or else the best one, over the temperatures that it was fitted on."""
    law = rubber.law
    if law is None:
        return None
    ends = law.fitted_range or (law.reference - 50.0, law.reference + 50.0)
    rms: dict[str, float] = {}
    if rubber.fit is not None:
        factors = rubber.fit.shift_factors
        ends = float(factors.temperatures[0]), float(factors.temperatures[-1])
        residual = factors.log10_values - law.log10(factors.temperatures)
        rms["rms"] = float(np.sqrt(np.mean(residual**2)))
    kelvin = np.linspace(max(ends[0], law.extrapolation_limits[0] + 1.0), ends[1], 201)
    return law.to_dataset(kelvin).assign_attrs(rms)


def _master_curve(curve: MasterCurve, material: Material) -> xarray.Dataset:
    spectrum = material.spectrum
    if not isinstance(spectrum, RetardationSpectrum) or spectrum.fit is None:  # a liquid has no spectrum
        return curve.to_dataset()
    return spectrum.master_curve_dataset(curve)


def _spectrum(material: Material, samples: MaterialSamples | None) -> dict[str, xarray.Dataset]:
    spectrum = material.spectrum
    if not isinstance(spectrum, RetardationSpectrum):
        return {}
    wide = _wide(spectrum)
    curve = spectrum.modulus_dataset(wide)
    if samples is not None:
        curve = curve.assign(samples.to_dataset(wide).data_vars)
    return {"/spectrum": spectrum.to_dataset(), "/spectrum_curve": curve}


def _wide(spectrum: RetardationSpectrum) -> Any:
    """Return angular frequencies two decades beyond what was measured, or beyond the modes."""
    low, high = (1.0 / spectrum.tau.max(), 1.0 / spectrum.tau.min()) if len(spectrum) else (1.0, 1.0)
    if spectrum.fit is not None:
        low, high = spectrum.fit.frequency_range
    return np.geomspace(low / 100.0, high * 100.0, 600)
