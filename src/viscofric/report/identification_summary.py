"""A rubber identified from friction in words and numbers: lines for people, plain types for other programs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.report.numbers import significant
from viscofric.report.table import aligned
from viscofric.rheology.cards.native import plain

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.friction.identification.result import IdentifiedBand, IdentifiedMaterial


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
