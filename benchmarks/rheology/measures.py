"""The same measures for everybody: overlap of shifted isotherms, error of a spectrum, error of planted shifts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.optimize import least_squares

from viscofric.rheology.superposition.overlap import LogSweep, overlap_quality

if TYPE_CHECKING:
    from cases import Case

    from viscofric.data import MasterCurve


def of_shifts(case: Case, log10: Any) -> dict[str, Any]:
    """Measure how well shift factors join the isotherms and, for planted sweeps, how far they are from the truth."""
    values = np.asarray(log10, dtype=float)
    quality = overlap_quality([LogSweep.of(isotherm) for isotherm in case.sweeps.isotherms], values)
    measured = {"points": quality.points, "storage": quality.storage, "loss": quality.loss, "joint": quality.joint}
    if case.truth is not None:
        true = case.truth.log10_alpha(case.sweeps.temperatures, case.reference)
        measured["error"] = float(np.sqrt(np.mean((values - true) ** 2)))
    return measured


def wlf_constants(case: Case, log10: Any) -> tuple[float, float]:
    """Fit C1 and C2 (K) at 20 °C by plain least squares: for tools that give shift factors and no law."""
    warmer = case.sweeps.temperatures - case.reference
    values = np.asarray(log10, dtype=float)
    found = least_squares(lambda c: -c[0] * warmer / (c[1] + warmer) - values, [10.0, 130.0])
    return float(found.x[0]), float(found.x[1])


def of_modes(curve: MasterCurve, E0: float, E: Any, tau: Any) -> dict[str, float]:
    """Measure a Prony series against the master curve's points."""
    turns = 1j * np.outer(curve.angular_frequency, np.asarray(tau, dtype=float))
    strength = np.asarray(E, dtype=float)
    measured = of_modulus(curve, E0 + (turns / (1.0 + turns)) @ strength)
    return {**measured, "modes": int(np.count_nonzero(strength > 0.0))}


def of_modulus(curve: MasterCurve, modulus: Any) -> dict[str, float]:
    """Return rms differences of log10 E' and log10 E''."""
    storage = np.log10(modulus.real / curve.storage_modulus)
    loss = np.log10(modulus.imag / curve.loss_modulus)
    return {"storage": float(np.sqrt(np.mean(storage**2))), "loss": float(np.sqrt(np.mean(loss**2)))}
