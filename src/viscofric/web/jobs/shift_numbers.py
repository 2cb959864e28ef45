"""Shift factors, laws and shifted isotherms of a rubber, as the page draws them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.datasets import Dataset, plain, record
from viscofric.report.data import law_line, law_residuals, shift_table
from viscofric.rheology.shifts.law_comparison import LawRow
from viscofric.rheology.shifts.parametric_law import LEVEL_95, ParametricLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_law import ShiftLaw
from viscofric.rheology.shifts.vertical_shift import VerticalShift, VerticalShiftFactors
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.superposition.result import Superposition
from viscofric.study.rubber import Rubber

_DIGITS = 6
#: Points of a line that a law is drawn with.
_LINE = 101
#: Laws that were not fitted are drawn so far to either side of their reference, K.
_ABOUT = 80.0
#: A factor is held for an isotherm that lies within this of the temperature named, K; the nearest one counts.
_NEAR = 5.0


def _not_correctable(rubber: Rubber) -> str:
    """Return why no single factor can be corrected, or an empty text."""
    if rubber.shift_origin == "given":
        return "The shift factors are from a file; fit them to the sweeps to correct one."
    if rubber.joint is not None:
        return "The shift factors are those of sweeps and step tests together; correct one with the sweeps alone."
    return ""


def shift_numbers(rubber: Rubber, held: Mapping[float, float]) -> dict[str, Any] | None:
    """Return α(T) of a rubber, its laws and shifted isotherms, None without; `held`: K whose log10 α was held."""
    law = rubber.material.shift
    if law is None or not rubber.material.has_shift_factors:
        return None
    fit, factors = rubber.fit, _factors(rubber)
    quality = getattr(rubber.fit or rubber.step_fit, "quality", None)
    measured = None if factors is None else factors.temperatures
    laws = () if rubber.laws is None else rubber.laws.rows
    return {
        "reference": float(law.reference),
        "used": rubber.shift_used,
        "origin": rubber.shift_origin,
        "factors": None
        if factors is None
        else with_bars(factors.to_dataset()) | {"held": places_held(factors.temperatures, held)},
        "laws": [] if factors is None else [_law(row, rubber, factors) for row in laws],
        "material": {
            "words": str(law) if isinstance(law, ParametricLaw) else "as measured, interpolated between the isotherms",
            **_drawn(law, measured),
        },
        "vertical": _vertical(rubber.material.vertical_shift, measured),
        "isotherms": [] if fit is None else _shifted(fit, held),
        "joint": rubber.joint is not None,
        "not_correctable": _not_correctable(rubber),
        "steps": _steps(rubber),
        "misfit": None if quality is None else {"joint": quality.joint, "points": quality.points},
    }


def _steps(rubber: Rubber) -> dict[str, Any] | None:
    """Return creep or relaxation tests over reduced time with the fitted response, by temperature."""
    curve, spectrum = rubber.step_curve, rubber.material.spectrum
    if curve is None or not isinstance(spectrum, RetardationSpectrum):
        return None
    fitted = spectrum.creep_compliance(curve.time) if curve.kind == "creep" else spectrum.relaxation_modulus(curve.time)
    curves = [
        {"temperature": kelvin, "time": curve.time[rows], "response": curve.response[rows]}
        for kelvin in np.unique(curve.temperature).tolist()
        for rows in [curve.temperature == kelvin]
    ]
    return {"kind": curve.kind, "curves": curves, "fit": {"time": curve.time, "response": fitted}}


def with_bars(factors: Dataset) -> dict[str, Any]:
    """Return a data set of shift factors as JSON, with ``error95``, half of each 95 % interval, where it is known."""
    found = record(factors, _DIGITS)
    if "standard_error" in found:
        found["error95"] = LEVEL_95 * factors["standard_error"].values
    return found


def _factors(rubber: Rubber) -> ShiftFactors | None:
    if rubber.superposed is not None:
        return rubber.superposed.shift_factors
    return rubber.material.shift if isinstance(rubber.material.shift, ShiftFactors) else None


def places_held(temperatures: Array, held: Mapping[float, float]) -> list[bool]:
    """Say of each isotherm whether its factor is held."""
    nearest = {
        int(np.argmin(np.abs(temperatures - kelvin)))
        for kelvin in held
        if np.min(np.abs(temperatures - kelvin)) < _NEAR
    }
    return [place in nearest for place in range(len(temperatures))]


_OF_A_LAW = ("kind", "title", "aic", "refusal", "same_as")


def _law(row: LawRow[ParametricLaw], rubber: Rubber, factors: ShiftFactors) -> dict[str, Any]:
    chosen = rubber.laws is not None and row is rubber.laws.chosen
    found: dict[str, Any] = {name: getattr(row, name) for name in _OF_A_LAW}
    found |= {"chosen": chosen, "used": rubber.shift_used == row.kind or (rubber.shift_used == "best" and chosen)}
    if row.law is None:
        return found
    residual = record(law_residuals(row.law, shift_table(factors)), _DIGITS)
    return found | {**_drawn(row.law, factors.temperatures), "residual": residual}


def _drawn(law: ShiftLaw, measured: Array | None) -> dict[str, Any]:
    """Return the limits of a law, and its line between those that it has, or about the measured temperatures."""
    if measured is not None:
        low, high = float(measured[0]), float(measured[-1])
    else:
        low, high = law.reference - _ABOUT, law.reference + _ABOUT
    limits = _limits(law)
    if limits is not None:
        ends = [usual if end is None else end for end, usual in zip(limits["valid"], (low, high), strict=True)]
        low, high = (ends[0], ends[1]) if limits["fitted"] is not None else (max(low, ends[0]), min(high, ends[1]))
    low = max(low, 1.0)
    return {"limits": limits, "ends": [low, high], "line": with_bars(law_line(law, low, high, _LINE))}


def _limits(law: ShiftLaw) -> dict[str, Any] | None:
    """Return the temperatures between which a law is valid, and those that it was fitted on; K."""
    if isinstance(law, ShiftFactors):
        ends = [float(law.temperatures[0]), float(law.temperatures[-1])]
        return {"valid": ends, "fitted": ends}
    limits, fitted = (getattr(law, name, None) for name in ("extrapolation_limits", "fitted_range"))
    if limits is None:
        return None
    return {"valid": plain(list(limits)), "fitted": None if fitted is None else list(fitted)}


def _vertical(shift: VerticalShift | None, measured: Array | None) -> dict[str, Any] | None:
    """Return b itself, with the upper end of its 95 % interval where it was fitted."""
    if shift is None:
        return None
    at = None
    if not isinstance(shift, VerticalShiftFactors):
        at = np.linspace(shift.reference - _ABOUT, shift.reference + _ABOUT, _LINE) if measured is None else measured
    data = shift.to_dataset(at)
    b = 10.0 ** data["log10_vertical_shift"]
    upper = None
    if "vertical_standard_error" in data:
        upper = (b * 10.0 ** (LEVEL_95 * data["vertical_standard_error"])).values
    return {"temperature": data["temperature"].values, "b": b.values, "upper": upper}


def _shifted(fit: Superposition, held: Mapping[float, float]) -> list[dict[str, Any]]:
    """Return the isotherms on the master curve, as their data sets name them, with the shift of each."""
    factors = fit.shift_factors
    return [
        record(one.to_dataset(), _DIGITS)
        | {
            "dynamic_modulus": np.hypot(one.storage_modulus, one.loss_modulus),
            "loss_angle": np.arctan2(one.loss_modulus, one.storage_modulus),
            "log10_shift": float(shift),
            "held": is_held,
            "is_reference": abs(one.temperature - factors.reference) < 1e-6 * one.temperature,
        }
        for one, shift, is_held in zip(
            fit.reduced_isotherms, factors.log10_values, places_held(factors.temperatures, held), strict=True
        )
    ]
