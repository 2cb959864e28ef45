"""Shift factors and moduli found from friction: lines for people, plain types for other programs."""

from __future__ import annotations

import numpy as np

from viscofric.arrays import Array
from viscofric.datasets import Dataset
from viscofric.friction.identification.result import IdentifiedBand, IdentifiedMaterial
from viscofric.friction.shifting.master_curve import FrictionMasterCurve
from viscofric.friction.shifting.shift_agreement import ShiftAgreement
from viscofric.report.results import values
from viscofric.report.texts.numbers import degrees, significant
from viscofric.report.texts.tables import text_table
from viscofric.rheology.shifts.laws import ParametricLaw
from viscofric.rheology.shifts.shift_law import ShiftLaw
from viscofric.showing import aligned


def shift_lines(master: FrictionMasterCurve, known: ShiftLaw | None) -> list[str]:
    """Return the shift factors as lines of a table, with those of the modulus; dashes where these are not known."""
    data = shift_factors(master)
    if known is not None and master.found:
        other, errors = known.at_reference(master.reference).values_at(values(data, "temperature"))
        found, doubt = values(data, "log10_shift_factor"), np.nan_to_num(values(data, "standard_error"))
        added = {"known": other, "known_error": errors, "difference": found - other}
        added["difference_error"] = np.hypot(errors, doubt)
        data = data.assign({name: ("temperature", column) for name, column in added.items()})
    return text_table(
        data,
        ("temperature", "T (°C)"),
        ("log10_shift_factor", "log10 α", "standard_error"),
        ("known", "of the modulus"),
        ("difference", "difference"),
    )


def shift_factors(master: FrictionMasterCurve) -> Dataset:
    """Return the shift factors of a master curve: those found, or those given at the temperatures of the curves."""
    if master.found:
        return master.shift_factors.to_dataset()
    return master.shift.to_dataset(master.curves.temperatures)


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
    lines.append(("overlap", master.overlap.sentence))
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
    data["remark"] = (
        "angular_frequency",
        [_remark(found.identified, one) for one in values(data, "angular_frequency").tolist()],
    )
    names = {"angular_frequency": "ω (rad/s)", "storage_modulus": "E' (MPa)", "loss_modulus": "E'' (MPa)", "remark": ""}
    return text_table(data, *names.items())


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
