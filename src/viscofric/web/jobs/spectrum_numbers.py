"""A rubber's spectrum and moduli with their bands, as numbers that the page draws."""

from __future__ import annotations

from typing import Any

import numpy as np

from viscofric.arrays import Array, ComplexArray
from viscofric.data import MasterCurve
from viscofric.datasets import record
from viscofric.errors import InputError
from viscofric.notes import listed
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.uncertainty.material_samples import MaterialSamples
from viscofric.study.rubber import Rubber

_DIGITS = 6
#: Lines go so far beyond the measured frequencies, as a factor.
_BEYOND = 10.0
#: Points of a line over each decade, and in all.
_PER_DECADE, _MOST = 16, 400
#: Retardation times and frequencies of a ready rubber reach this far beyond one another, as a factor.
_BEYOND_MODES = 30.0


def spectrum_numbers(rubber: Rubber) -> dict[str, Any]:
    """Return modes, moduli over frequency at the reference, and what the fit leaves unexplained; None where unknown."""
    material = rubber.material
    modes, why = _modes(material)
    fit = None if modes is None else modes.fit
    curve = measured_curve(rubber)
    at = frequencies(rubber)
    return {
        "reference": material.reference,
        "poisson_ratio": material.poisson_ratio,
        "modes": None if modes is None else record(modes.to_dataset(), _DIGITS),
        "relaxation": None if modes is None else record(modes.to_relaxation().to_dataset(), _DIGITS),
        "fit": None
        if fit is None
        else {name: getattr(fit, name) for name in _OF_A_FIT} | listed("notes", fit.notes, "page"),
        **listed("notes", why, "page"),
        "modulus": moduli(at, material.complex_modulus(at)),
        "measured": None if curve is None else moduli(curve.angular_frequency, curve.complex_modulus),
        "residual": None if curve is None else _residual(curve, material),
    }


_OF_A_FIT = (
    "method",
    "rms_storage",
    "rms_loss",
    "rms_step",
    "frequency_range",
    "tau_ratio",
    "regularisation",
    "E0_remark",
    "E_inf_remark",
)


def _modes(material: Material) -> tuple[RetardationSpectrum | None, tuple[str, ...]]:
    """Return the retardation modes, and what is to be said of them."""
    try:
        return material.modes_at(), material.notes_on_modes
    except InputError as error:
        return None, (error.note,)


def measured_curve(rubber: Rubber) -> MasterCurve | None:
    """Return the measured master curve, if there is one."""
    return rubber.master_curve if rubber.fit is None else rubber.fit.master_curve


def frequencies(rubber: Rubber) -> Array:
    """Return the angular frequencies that the rubber's moduli are drawn over, rad/s, at the reference."""
    curve, spectrum = measured_curve(rubber), rubber.material.spectrum
    if not isinstance(spectrum, RetardationSpectrum):
        low, high = float(spectrum.angular_frequency[0]), float(spectrum.angular_frequency[-1])
    elif curve is not None:
        low, high = curve.angular_frequency[0] / _BEYOND, curve.angular_frequency[-1] * _BEYOND
    elif spectrum.fit is not None:
        low, high = (end * by for end, by in zip(spectrum.fit.frequency_range, (1 / _BEYOND, _BEYOND), strict=True))
    elif len(spectrum.tau):
        low, high = 1.0 / (_BEYOND_MODES * spectrum.tau.max()), _BEYOND_MODES / spectrum.tau.min()
    else:
        low, high = 1e-3, 1e3
    count = int(np.clip(_PER_DECADE * np.log10(high / low), 2, _MOST))
    # The ends as they are, to the last digit: tables refuse frequencies beyond them.
    return np.concatenate([[low], np.geomspace(low, high, count)[1:-1], [high]])


def moduli(angular_frequency: Array, complex_modulus: ComplexArray) -> dict[str, Any]:
    """Return moduli and loss tangent over frequency, named as in data sets."""
    return {
        "angular_frequency": angular_frequency,
        "storage_modulus": complex_modulus.real,
        "loss_modulus": complex_modulus.imag,
        "loss_tangent": complex_modulus.imag / complex_modulus.real,
    }


def _residual(curve: MasterCurve, material: Material) -> dict[str, Any] | None:
    """Return log10 of measured over fitted moduli at the points of the master curve."""
    fitted = material.complex_modulus(curve.angular_frequency)
    storage, loss = np.log10(curve.storage_modulus / fitted.real), np.log10(curve.loss_modulus / fitted.imag)
    return {"storage_modulus": storage, "loss_modulus": loss}


def band_numbers(
    samples: MaterialSamples, angular_frequency: Array, temperature: float | None = None
) -> dict[str, Any]:
    """Return the 95 % band of the moduli at frequencies (rad/s) and a temperature (K), and of the modes."""

    def tangent(material: Material) -> Array:
        moduli_there = material.complex_modulus(angular_frequency, temperature)
        return np.asarray(moduli_there.imag / moduli_there.real)

    lossy = samples.band(tangent)
    modes = samples.spectrum_band()
    alike = not np.any(np.ptp(samples.tau, axis=0) > 0.0)
    return record(samples.to_dataset(angular_frequency, temperature), _DIGITS) | {
        "draws": len(samples),
        "loss_tangent_lower": lossy.lower,
        "loss_tangent_upper": lossy.upper,
        "modes": {"retardation_time": samples.tau[0], "lower": modes.lower, "upper": modes.upper} if alike else None,
        **listed("notes", samples.notes, "page"),
    }
