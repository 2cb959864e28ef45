"""Shift factors and moduli found from friction: lines for people, plain types for other programs."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.datasets import Dataset
from viscofric.friction.identification.result import IdentifiedBand, IdentifiedMaterial
from viscofric.friction.shifting.master_curve import FrictionMasterCurve
from viscofric.friction.shifting.shift_agreement import ShiftAgreement
from viscofric.report.results import values
from viscofric.report.texts.numbers import ABSENT, degrees, significant
from viscofric.rheology.shifts.laws import ParametricLaw
from viscofric.rheology.shifts.shift_law import ShiftLaw
from viscofric.showing import aligned
from viscofric.units import shown_celsius, shown_number

#: Errors are printed with three decimals, and not as zero.
_SMALLEST = 1e-3


def shift_lines(master: FrictionMasterCurve, known: ShiftLaw | None) -> list[str]:
    """Return the shift factors as lines of a table, with those of the modulus; dashes where these are not known."""
    factors = shift_factors(master)
    found, doubt = values(factors, "log10_shift_factor"), np.nan_to_num(values(factors, "standard_error"))
    kelvin = values(factors, "temperature")
    columns = [["T (°C)", *(shown_celsius(float(one)) for one in kelvin)], ["log10 α", *_pairs(found, doubt)]]
    if known is not None and master.found:
        other, errors = known.at_reference(master.reference).values_at(kelvin)
        columns.append(["of the modulus", *_pairs(other, errors)])
        columns.append(["difference", *_pairs(found - other, np.hypot(errors, doubt))])
    return aligned(zip(*columns, strict=True))


def shift_factors(master: FrictionMasterCurve) -> Dataset:
    """Return the shift factors of a master curve: those found, or those given at the temperatures of the curves."""
    if master.found:
        return master.shift_factors.to_dataset()
    return master.shift.to_dataset(master.curves.temperatures)


def _pairs(values: Any, errors: Any) -> list[str]:
    texts = []
    for value, error in zip(values, errors, strict=True):
        if not math.isfinite(value):
            texts.append(ABSENT)
        else:
            doubt = f" ± {max(error, _SMALLEST):.3f}" if error > 0.0 else ""
            texts.append(f"{shown_number(value, 'z.3f')}{doubt}")
    return texts


def shift_words(
    master: FrictionMasterCurve, law: ParametricLaw | None, agreement: ShiftAgreement | None, why: str = ""
) -> list[tuple[str, str]]:
    """Return what is to be said of shifted friction curves, as pairs of name and value."""
    low, high = (1e3 * end for end in master.reduced_range)
    lines = [
        ("reference", degrees(master.reference)),
        ("reduced speed", f"{significant(low)} to {significant(high)} mm/s"),
    ]
    if master.found and not np.any(master.friction_error > 0.0):
        lines.append(
            ("errors", "of log10 α: from the scatter of the points about one curve; the points have no errors")
        )
    if law is not None:
        lines.append(("law", str(law)))
    if why:
        lines.append(("", why))
    lines.append(("overlap", master.overlap_sentence))
    if agreement is not None:
        lines.append(("comparison", agreement.sentence))
    return lines


#: The modulus is printed so many decades beyond the frequencies of the contacts, at one frequency a decade.
_BEYOND = 1


def shown_frequencies(found: IdentifiedMaterial) -> Array:
    """Return the angular frequencies at which a modulus is shown, one a decade."""
    low, high = np.log10(found.frequency_range)
    return np.asarray(10.0 ** np.arange(np.floor(low) - _BEYOND, np.ceil(high) + _BEYOND + 1))


def modulus_lines(found: IdentifiedMaterial) -> list[str]:
    """Return the modulus of an identified rubber with its 95 % limits, decade by decade, as lines of a table."""
    data = found.to_dataset(shown_frequencies(found))
    rows: list[tuple[str, ...]] = [("ω (rad/s)", "E' (MPa)", "95 % limits", "E'' (MPa)", "95 % limits", "")]
    for row, frequency in enumerate(values(data, "angular_frequency").tolist()):
        cells = [significant(frequency, 1)]
        for name in ("storage_modulus", "loss_modulus"):
            value, low, high = (1e-6 * float(values(data, name + end)[row]) for end in ("", "_lower", "_upper"))
            cells += [significant(value, 4), f"{significant(low)} to {significant(high)}"]
        rows.append((*cells, _remark(found.identified, frequency)))
    return aligned(rows)


def _remark(band: IdentifiedBand, frequency: float) -> str:
    """Say what of the modulus is not identified at a frequency."""
    if band.decades > 0.0 and band.low <= frequency <= band.high:
        return "magnitude not identified" if band.relative else ""
    return "not identified"


def family_lines(found: IdentifiedMaterial) -> list[str]:
    """Return materials that friction cannot distinguish as lines of a table; none where the magnitude is known."""
    if not found.family:
        return []
    rows = [
        ("level", f"|E| at {significant(found.middle, 2)} rad/s (MPa)", "rms residual of friction", "χ² above the best")
    ]
    for fit in found.family:
        rms = f"{100.0 * fit.rms:.2g} %"
        rows.append((f"× {fit.factor:.3g}", significant(1e-6 * fit.modulus), rms, significant(fit.penalty, 2)))
    return aligned(rows)
