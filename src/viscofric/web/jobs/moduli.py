"""Job ``moduli``: the rubber's modulus at one temperature, with its band and the measured points brought there."""

from __future__ import annotations

from typing import Any

import numpy as np

from viscofric.datasets import plain
from viscofric.study.rubber import Rubber
from viscofric.study.run_file.tables import Temperature
from viscofric.web.figures.spectrum import moduli_figures
from viscofric.web.jobs.context import Context, JobError, JobOptions
from viscofric.web.jobs.rubbers import friction_bands, made_rubber
from viscofric.web.jobs.spectrum_numbers import band_numbers, frequencies, measured_curve, moduli

#: The isotherm within this of the temperature counts as measured there, K.
_NEAR = 1.0


class Options(JobOptions):
    """Where the modulus is requested."""

    temperature: Temperature
    bands: bool = True


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Return E'(ω) and E''(ω) of the rubber at a temperature, with band and the measured points brought there."""
    rubber = made_rubber(study, context)
    material, at = rubber.material, options.temperature
    if material.shift is None:
        raise JobError("This rubber has no shift with temperature: valid at one temperature only.", code="no-shift")
    alpha = float(material.shift(at))
    omega = frequencies(rubber) / alpha
    samples = friction_bands(study, context).samples if options.bands else None
    numbers = {
        "temperature": at,
        "log10_shift": float(np.log10(alpha)),
        "extrapolated": bool(material.shift.extrapolates(at)),
        "modulus": moduli(omega, material.complex_modulus(omega, at)),
        "band": None if samples is None else band_numbers(samples, omega, at),
        "moved": _moved(rubber, at, alpha),
        "isotherm": _isotherm(rubber, at),
    }
    found: dict[str, Any] = plain(numbers)
    fitted = getattr(material.spectrum, "fit", None) is not None
    return found | {"figures": moduli_figures(found, at, fitted=fitted, moved="moved" if found["moved"] else "")}


def _moved(rubber: Rubber, at: float, alpha: float) -> dict[str, Any] | None:
    curve = measured_curve(rubber)
    if curve is None:
        return None
    vertical = rubber.material.vertical_shift
    b = 1.0 if vertical is None else float(vertical(at))
    return moduli(curve.angular_frequency / alpha, b * curve.complex_modulus)


def _isotherm(rubber: Rubber, at: float) -> dict[str, Any] | None:
    if rubber.fit is None:
        return None
    nearest = min(rubber.fit.isotherms, key=lambda one: abs(one.temperature - at))
    if abs(nearest.temperature - at) > _NEAR:
        return None
    measured = nearest.storage_modulus + 1j * nearest.loss_modulus
    return moduli(nearest.angular_frequency, measured) | {"temperature": nearest.temperature}
