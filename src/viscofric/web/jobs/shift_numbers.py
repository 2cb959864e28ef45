"""What temperature does to a rubber, as numbers that the page draws: factors, laws, isotherms on one another."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.datasets import plain
from viscofric.rheology.shifts.parametric_law import LEVEL_95, ParametricLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.vertical_shift import VerticalShiftFactors

if TYPE_CHECKING:
    from collections.abc import Mapping

    from viscofric.arrays import Array
    from viscofric.rheology.shifts.law_comparison import LawRow
    from viscofric.rheology.shifts.shift_law import ShiftLaw
    from viscofric.rheology.shifts.vertical_shift import VerticalShift
    from viscofric.rheology.superposition.result import Superposition
    from viscofric.study.rubber import Rubber


#: Points of a line that a law is drawn with.
_LINE = 101
#: Laws that were not fitted are drawn so far to either side of their reference, K.
_ABOUT = 80.0
#: Laws are not drawn this near to a pole, K.
_NEAR_POLE = 1.0
#: A factor is held for an isotherm that lies within this of the temperature named, K; the nearest one counts.
_NEAR = 5.0


def shift_numbers(rubber: Rubber, held: Mapping[float, float]) -> dict[str, Any] | None:
    """Return α(T) of a rubber: what was found, the laws, and the isotherms shifted.

    Parameters
    ----------
    held : mapping of float to float
        Temperatures (K) whose log10 α was held.

    Returns
    -------
    dict or None
        In SI units, temperatures in K, logarithms to base 10; None where the rubber has no shift.
    """
    law = rubber.material.shift
    if law is None:
        return None
    factors = _factors(rubber)
    measured = None if factors is None else factors.temperatures
    reply: dict[str, Any] = {
        "reference": plain(float(law.reference)),
        "used": rubber.shift_used,
        "origin": rubber.shift_origin,
        "factors": None if factors is None else _table(factors, held),
        "laws": _laws(rubber, factors),
        "explanation": "" if rubber.laws is None else rubber.laws.explanation,
        "material": _of_material(law, measured),
        "vertical": _vertical(rubber.material.vertical_shift, measured),
        "isotherms": [],
        "misfit": None,
    }
    if rubber.fit is not None:
        reply |= {"isotherms": _shifted(rubber.fit, held), "misfit": _misfit(rubber.fit)}
    return reply


def _factors(rubber: Rubber) -> ShiftFactors | None:
    if rubber.fit is not None:
        return rubber.fit.shift_factors
    return rubber.material.shift if isinstance(rubber.material.shift, ShiftFactors) else None


def places_held(temperatures: Array, held: Mapping[float, float]) -> list[bool]:
    """Say of each isotherm whether its factor is held."""
    nearest = {
        int(np.argmin(np.abs(temperatures - kelvin)))
        for kelvin in held
        if np.min(np.abs(temperatures - kelvin)) < _NEAR
    }
    return [place in nearest for place in range(len(temperatures))]


def _table(factors: ShiftFactors, held: Mapping[float, float]) -> dict[str, Any]:
    return {
        "temperature": plain(factors.temperatures),
        "log10": plain(factors.log10_values),
        "error95": plain(LEVEL_95 * factors.standard_errors),
        "held": places_held(factors.temperatures, held),
    }


def _laws(rubber: Rubber, factors: ShiftFactors | None) -> list[dict[str, Any]]:
    if rubber.laws is None or factors is None:
        return []
    return [_law_row(row, rubber, factors) for row in rubber.laws.rows]


def _law_row(row: LawRow, rubber: Rubber, factors: ShiftFactors) -> dict[str, Any]:
    laws = rubber.laws
    numbers = {
        "kind": row.kind,
        "title": row.title,
        "chosen": laws is not None and row is laws.chosen,
        "used": rubber.shift_used == row.kind
        or (laws is not None and rubber.shift_used == "best" and row is laws.chosen),
        "words": "" if row.law is None else row.law.described,
        "constants": row.constants,
        "chi2": plain(row.chi2),
        "freedom": row.freedom,
        "scatter": plain(row.scatter),
        "aic": plain(row.aic),
        "weight": plain(row.weight),
        "exact": row.exact,
        "refusal": row.refusal,
        "same_as": row.same_as,
    }
    if row.law is None:
        return numbers
    valid = row.law.valid_at(factors.temperatures, above_pole=_NEAR_POLE)
    at = factors.temperatures[valid]
    left = factors.log10_values[valid] - np.asarray(row.law.log10(at))
    return numbers | {
        "limits": _limits(row.law),
        "line": line_of(row.law, factors.temperatures),
        "residual": {"temperature": plain(at), "log10": plain(left)},
    }


def _of_material(law: ShiftLaw, measured: Array | None) -> dict[str, Any]:
    """Return α(T) that contacts are solved with: a table between its temperatures, or a law within its limits."""
    return {
        "words": str(law) if isinstance(law, ParametricLaw) else "as measured, interpolated between the isotherms",
        "limits": _limits(law),
        "line": line_of(law, measured),
    }


def _limits(law: ShiftLaw) -> dict[str, Any] | None:
    """Return the temperatures between which a law is valid, and those that it was fitted on; K."""
    if isinstance(law, ShiftFactors):
        ends = [float(law.temperatures[0]), float(law.temperatures[-1])]
        return {"valid": plain(ends), "fitted": plain(ends)}
    limits = getattr(law, "extrapolation_limits", None)
    fitted = getattr(law, "fitted_range", None)
    if limits is None:
        return None
    return {"valid": plain(list(limits)), "fitted": None if fitted is None else plain(list(fitted))}


def line_of(law: ShiftLaw, measured: Array | None) -> dict[str, Any]:
    """Return log10 α of a law, with 1.96 standard errors where they are known, within its limits."""
    if measured is not None:
        low, high = float(measured[0]), float(measured[-1])
    else:
        low, high = law.reference - _ABOUT, law.reference + _ABOUT
    limits = _limits(law)
    if limits is not None:
        ends = [usual if end is None else end for end, usual in zip(limits["valid"], (low, high), strict=True)]
        low, high = (ends[0], ends[1]) if limits["fitted"] is not None else (max(low, ends[0]), min(high, ends[1]))
    line = np.linspace(max(low, 1.0), high, _LINE)
    line = line[law.valid_at(line, above_pole=_NEAR_POLE)]
    error = LEVEL_95 * np.asarray(law.standard_error(line)) if law.has_standard_error else None
    return {
        "temperature": plain(line),
        "log10": plain(np.asarray(law.log10(line))),
        "error95": None if error is None else plain(error),
    }


def _vertical(shift: VerticalShift | None, measured: Array | None) -> dict[str, Any] | None:
    if shift is None:
        return None
    if isinstance(shift, VerticalShiftFactors):
        at, error = shift.temperatures, LEVEL_95 * shift.standard_errors
    else:
        at = np.linspace(shift.reference - _ABOUT, shift.reference + _ABOUT, _LINE) if measured is None else measured
        error = None
    b = np.asarray(shift(at))
    return {
        "fitted": error is not None,
        "temperature": plain(at),
        "b": plain(b),
        "lower": None if error is None else plain(b * 10.0**-error),
        "upper": None if error is None else plain(b * 10.0**error),
    }


def _shifted(fit: Superposition, held: Mapping[float, float]) -> list[dict[str, Any]]:
    """Return the isotherms moved onto each other: reduced frequency, and moduli free of the vertical shift."""
    temperatures = fit.shift_factors.temperatures
    log10_b = np.zeros(len(temperatures))
    if fit.vertical_shift is not None:
        log10_b = np.asarray(fit.vertical_shift.log10(temperatures))
    return [
        {
            "temperature": plain(one.temperature),
            "log10_shift": plain(float(shift)),
            "held": is_held,
            "is_reference": abs(one.temperature - fit.shift_factors.reference) < 1e-6 * one.temperature,
            "reduced_frequency": plain(10.0**shift * one.angular_frequency),
            "storage": plain(one.storage_modulus / 10.0**by),
            "loss": plain(one.loss_modulus / 10.0**by),
            "loss_tangent": plain(one.loss_modulus / one.storage_modulus),
        }
        for one, shift, by, is_held in zip(
            fit.isotherms, fit.shift_factors.log10_values, log10_b, places_held(temperatures, held), strict=True
        )
    ]


def _misfit(fit: Superposition) -> dict[str, Any]:
    quality, temperatures = fit.quality, fit.shift_factors.temperatures
    return {
        "storage": plain(quality.storage),
        "loss": plain(quality.loss),
        "joint": plain(quality.joint),
        "points": quality.points,
        "neighbours": quality.neighbours,
        "gaps": [plain(temperatures[place : place + 2]) for place in quality.gaps],
    }
