"""Shift factors and moduli found from friction: lines for people, plain types for other programs."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from viscofric.errors import InputError
from viscofric.report.figures.style import degrees
from viscofric.report.texts.numbers import ABSENT, finite, significant
from viscofric.report.texts.tables import aligned
from viscofric.rheology.cards.native import plain
from viscofric.units import celsius

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.friction.identification.result import IdentifiedBand, IdentifiedMaterial
    from viscofric.friction.shifting.master_curve import FrictionMasterCurve
    from viscofric.friction.shifting.shift_agreement import ShiftAgreement
    from viscofric.rheology.shifts.laws import ParametricLaw
    from viscofric.rheology.shifts.shift_law import ShiftLaw


_SHIFT_UNITS = {
    "temperature": "K",
    "reference": "K",
    "log10_shift_factor": "1",
    "standard_error": "1",
    "covariance": "1",
}


#: Errors are printed with three decimals, and not as zero.
_SMALLEST = 1e-3


class ChosenLaw(NamedTuple):
    """A law of the shift factors that friction tells: the law, why it was chosen, or why there is none."""

    law: ParametricLaw | None
    why: str = ""
    refused: str = ""


def law_of(master: FrictionMasterCurve, kind: str) -> ChosenLaw:
    """Fit a law to shift factors that were found from friction, the best one only where one describes them.

    Parameters
    ----------
    master : FrictionMasterCurve
    kind : str
        "best", "none", or a law that `ShiftFactors.law` fits.

    Raises
    ------
    InputError
        If a law that is asked for by its name cannot be fitted.
    """
    if kind == "none" or not master.found:
        return ChosenLaw(None)
    factors = master.shift_factors
    if kind != "best":
        return ChosenLaw(factors.law(kind))
    try:
        compared = factors.compare_laws()
    except InputError as error:
        return ChosenLaw(None, refused=f"No law is fitted: {error}")
    return ChosenLaw(compared.best, compared.explanation)


def shift_lines(master: FrictionMasterCurve, known: ShiftLaw | None) -> list[str]:
    """Return the shift factors as lines of a table, beside those that are known.

    Parameters
    ----------
    master : FrictionMasterCurve
    known : ShiftLaw, optional
        Of the modulus; dashes where it does not answer.
    """
    temperatures, found, doubt = _factors(master)
    columns = [
        ["T (°C)", *(f"{celsius(float(kelvin)):z.1f}".replace("-", "−") for kelvin in temperatures)],
        ["log10 α", *_pairs(found, doubt)],
    ]
    if known is not None and master.found:
        values, errors = known.at_reference(master.reference).values_at(temperatures)
        columns.append(["of the modulus", *_pairs(values, errors)])
        columns.append(["difference", *_pairs(found - values, np.hypot(errors, doubt))])
    return aligned(zip(*columns, strict=True))


def _factors(master: FrictionMasterCurve) -> tuple[Array, Array, Array]:
    """Return temperatures (K), log10 α and its standard errors: those found, or those given at the curves' own."""
    if master.found:
        factors = master.shift_factors
        return factors.temperatures, factors.log10_values, factors.standard_errors
    temperatures = master.curves.temperatures
    return temperatures, *master.shift.values_at(temperatures)


def _pairs(values: Any, errors: Any) -> list[str]:
    texts = []
    for value, error in zip(values, errors, strict=True):
        if not math.isfinite(value):
            texts.append(ABSENT)
        else:
            doubt = f" ± {max(error, _SMALLEST):.3f}" if error > 0.0 else ""
            texts.append(f"{value:z.3f}{doubt}".replace("-", "−"))
    return texts


def shift_words(
    master: FrictionMasterCurve, law: ParametricLaw | None, agreement: ShiftAgreement | None, why: str = ""
) -> list[tuple[str, str]]:
    """Return what is to be said of shifted friction curves, as pairs of name and value.

    Parameters
    ----------
    master : FrictionMasterCurve
    law : ParametricLaw, optional
        Fitted to the shift factors.
    agreement : ShiftAgreement, optional
        With those of the modulus.
    why : str
        Why that law was chosen, if it was.
    """
    low, high = (1e3 * end for end in master.reduced_range)
    lines = [
        ("reference", degrees(master.reference)),
        ("reduced speed", f"{significant(low)} to {significant(high)} mm/s"),
    ]
    if master.found and not np.any(master.error > 0.0):
        told = "those of log10 α follow from how the points scatter about one curve, for they have none of their own"
        lines.append(("errors", told))
    if law is not None:
        lines.append(("law", str(law)))
    if why:
        lines.append(("", why))
    lines.append(("overlap", master.overlap_sentence))
    if agreement is not None:
        lines.append(("beside the modulus", agreement.sentence))
    return lines


def shift_record(
    master: FrictionMasterCurve,
    law: ParametricLaw | None,
    agreement: ShiftAgreement | None,
    inputs: dict[str, Any],
) -> dict[str, Any]:
    """Return shifted friction in plain types, SI units, without a NaN: what is not known is None.

    Parameters
    ----------
    master : FrictionMasterCurve
    law : ParametricLaw, optional
    agreement : ShiftAgreement, optional
    inputs : dict
        What was asked for, in plain types.
    """
    temperatures, values, errors = _factors(master)
    return {
        "format": "viscofric friction shift 1",
        "inputs": inputs,
        "found": master.found,
        "reference": master.reference,
        "temperature": temperatures.tolist(),
        "log10_shift_factor": values.tolist(),
        "standard_error": errors.tolist(),
        "covariance": master.shift_factors.covariance.tolist() if master.found else None,
        "law": None if law is None else plain(law),
        "overlap": {
            "rms": master.overlap_rms,
            "error": finite(master.overlap_error),
            "points": master.overlap_points,
            "sentence": master.overlap_sentence,
        },
        "agreement": None if agreement is None else _agreement(agreement),
        "master_curve": {
            "reduced_speed": master.reduced_speed.tolist(),
            "temperature": master.temperature.tolist(),
            "viscoelastic": master.friction.tolist(),
            "viscoelastic_error": [finite(error) for error in master.error.tolist()],
            "load": master.load,
        },
        "notes": list(master.notes),
        "units": _SHIFT_UNITS | {"reduced_speed": "m/s", "viscoelastic": "1", "load": master.curves.load_unit},
    }


def _agreement(agreement: ShiftAgreement) -> dict[str, Any]:
    names = ("chi2", "freedom", "p_value", "slope", "slope_error", "rms", "sentence")
    return {
        "temperature": agreement.temperature.tolist(),
        "difference": agreement.difference.tolist(),
        "error": agreement.error.tolist(),
    } | {name: getattr(agreement, name) for name in names}


_UNITS = {
    "angular_frequency": "rad/s",
    "storage_modulus": "Pa",
    "loss_modulus": "Pa",
    "low": "rad/s",
    "high": "rad/s",
    "level_range": "Pa",
    "modulus": "Pa",
    "E0": "Pa",
    "E_inf": "Pa",
    "C": "1/Pa",
    "tau": "s",
    "reference": "K",
    "speed": "m/s",
    "temperature": "K",
    "viscoelastic": "1",
    "residual": "1",
}
#: The modulus is told so many decades beyond the frequencies of the contacts, at one frequency a decade.
_BEYOND = 1


def _frequencies(found: IdentifiedMaterial) -> Array:
    low, high = np.log10(found.frequency_range)
    return np.asarray(10.0 ** np.arange(np.floor(low) - _BEYOND, np.ceil(high) + _BEYOND + 1))


def modulus_lines(found: IdentifiedMaterial) -> list[str]:
    """Return the modulus of an identified rubber with its 95 % limits, decade by decade, as lines of a table.

    Parameters
    ----------
    found : IdentifiedMaterial
    """
    omega = _frequencies(found)
    modulus, band = np.asarray(found.material.complex_modulus(omega)), found.samples.modulus_band(omega)
    rows: list[tuple[str, ...]] = [("ω (rad/s)", "E' (MPa)", "95 % limits", "E'' (MPa)", "95 % limits", "")]
    for row, frequency in enumerate(omega):
        cells = [significant(float(frequency), 1)]
        for part in ("real", "imag"):
            value, low, high = (
                1e-6 * float(getattr(one, part)) for one in (modulus[row], band.lower[row], band.upper[row])
            )
            cells += [significant(value, 4), f"{significant(low)} to {significant(high)}"]
        rows.append((*cells, _remark(found.identified, float(frequency))))
    return aligned(rows)


def _remark(band: IdentifiedBand, frequency: float) -> str:
    """Say what of the modulus is not identified at a frequency."""
    if band.decades > 0.0 and band.low <= frequency <= band.high:
        return "level not identified" if band.relative else ""
    return "not identified"


def identification_record(found: IdentifiedMaterial, inputs: dict[str, Any]) -> dict[str, Any]:
    """Return an identified rubber in plain types, SI units.

    Parameters
    ----------
    found : IdentifiedMaterial
    inputs : dict
        What was asked for, in plain types.
    """
    omega = _frequencies(found)
    modulus, band = np.asarray(found.material.complex_modulus(omega)), found.samples.modulus_band(omega)
    spectrum = found.material.modes_at()
    parts = {"storage_modulus": "real", "loss_modulus": "imag"}
    told: dict[str, list[float]] = {}
    for name, part in parts.items():
        told[name] = getattr(modulus, part).tolist()
        told[f"{name}_lower"] = getattr(band.lower, part).tolist()
        told[f"{name}_upper"] = getattr(band.upper, part).tolist()
    return {
        "format": "viscofric identification 1",
        "inputs": inputs,
        "material": {
            "E0": spectrum.E0,
            "E_inf": spectrum.E_inf,
            "C": spectrum.C.tolist(),
            "tau": spectrum.tau.tolist(),
            "poisson_ratio": found.material.poisson_ratio,
            "reference": found.material.reference,
            "shift": None if found.material.shift is None else plain(found.material.shift),
        },
        "modulus": {"angular_frequency": omega.tolist()} | told,
        "identified": _band(found.identified),
        "identified_storage": _band(found.identified_storage),
        "identified_loss": _band(found.identified_loss),
        "anchored": found.anchored,
        "shift_found": found.shift_found,
        "level_range": list(found.level_range),
        "family": [
            {name: float(getattr(fit, name)) for name in ("factor", "modulus", "chi2", "rms", "penalty")}
            for fit in found.family
        ],
        "fit": {name: float(getattr(found, name)) for name in ("chi2", "freedom", "rms", "error_scale")},
        "points": {
            name: getattr(found.friction, name).tolist()
            for name in ("speed", "temperature", "load", "viscoelastic", "viscoelastic_lower", "viscoelastic_upper")
        }
        | {"residual": found.residuals.tolist()},
        "samples": [
            {"E0": one.modes_at().E0, "E_inf": one.modes_at().E_inf, "C": one.modes_at().C.tolist()}
            for one in found.samples.materials
        ],
        "sentences": list(found.sentences),
        "units": _UNITS | {"load": found.friction.load_unit},
    }


def _band(band: IdentifiedBand) -> dict[str, Any]:
    return {"low": band.low, "high": band.high, "limit": band.limit, "relative": band.relative}


def family_lines(found: IdentifiedMaterial) -> list[str]:
    """Return the rubbers that friction alone cannot tell apart as lines of a table; none where the level is known.

    Parameters
    ----------
    found : IdentifiedMaterial
    """
    if not found.family:
        return []
    rows = [("level", f"|E| at {significant(found.middle, 2)} rad/s (MPa)", "rms of friction", "χ² above the best")]
    for fit in found.family:
        rms = f"{100.0 * fit.rms:.2g} %"
        rows.append((f"× {fit.factor:.3g}", significant(1e-6 * fit.modulus), rms, significant(fit.penalty, 2)))
    return aligned(rows)
