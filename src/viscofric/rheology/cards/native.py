"""A material as plain numbers and text, and back: what JSON files and the comments of material cards hold."""

from __future__ import annotations

from dataclasses import is_dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from viscofric.errors import InputError
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.columns import as_record, kept_arguments
from viscofric.rheology.shifts.laws import VFT, WLF, Arrhenius, InversePolynomial, WLFArrhenius
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.vertical_shift import DensityShift, VerticalShiftFactors
from viscofric.rheology.spectra.modulus_table import ModulusTable
from viscofric.rheology.spectra.retardation import RetardationSpectrum, SpectrumFit

#: Raised by one when files of this version could no longer be read by older programs.
VERSION = 1

_SHIFTS: tuple[type, ...] = (WLF, VFT, Arrhenius, WLFArrhenius, InversePolynomial, ShiftFactors)
_VERTICAL: tuple[type, ...] = (DensityShift, VerticalShiftFactors)


@lru_cache(maxsize=1)
def _kinds() -> dict[str, type]:
    return {one.__name__: one for one in (*_SHIFTS, *_VERTICAL, SpectrumFit)}


def plain(value: Any) -> Any:
    """Return a value as what JSON knows: a dataclass as its class's name and what its constructor takes."""
    if value is None or isinstance(value, (bool, str, int)):
        return value
    if isinstance(value, (float, np.floating)):
        return float(value)
    if isinstance(value, (np.bool_, np.integer)):
        return value.item()
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, (tuple, list)):
        return [plain(one) for one in value]
    if is_dataclass(value) and type(value).__name__ in _kinds():
        return {name: plain(content) for name, content in as_record(value).items()}
    raise InputError(f"a material file cannot hold a {type(value).__name__}.")


def restored(value: Any, allowed: tuple[type, ...]) -> Any:
    """Return the object that `plain` made, if it is one of those allowed in its place.

    Raises
    ------
    InputError
        If it is of another kind, or has a field that this version does not know.
    """
    if value is None:
        return None
    names = [one.__name__ for one in allowed]
    kind = value.get("kind") if isinstance(value, dict) else None
    if kind not in names:
        raise InputError(f"kind = {kind!r}: must be one of {', '.join(names)}.")
    one = _kinds()[kind]
    arguments = {name: content for name, content in value.items() if name != "kind"}
    unknown = sorted(set(arguments) - set(kept_arguments(one)))
    if unknown:
        raise InputError(f"{kind} has no {', '.join(unknown)}; the file may be of a newer version of viscofric.")
    arguments = {name: tuple(content) if _is_row(content) else content for name, content in arguments.items()}
    try:
        return one(**arguments)
    except TypeError as error:
        raise InputError(f"{kind} cannot be made of {', '.join(sorted(arguments)) or 'nothing'} ({error}).") from None


def _is_row(content: Any) -> bool:
    """Tell a row (a tuple of texts or numbers) from a matrix."""
    return isinstance(content, list) and not any(isinstance(one, list) for one in content)


def fit_of(value: Any) -> SpectrumFit | None:
    """Return how a spectrum was fitted, from `plain`."""
    fit: SpectrumFit | None = restored(value, (SpectrumFit,))
    return fit


def shift_of(value: Any) -> Any:
    """Return a shift law or table from `plain`."""
    return restored(value, _SHIFTS)


def vertical_shift_of(value: Any) -> Any:
    """Return a vertical shift from `plain`."""
    return restored(value, _VERTICAL)


def about(material: Material) -> dict[str, Any]:
    """Return all of a material but its spectrum, as plain values; what is not set is left out."""
    return {
        name: content
        for name, content in (
            ("name", material.name),
            ("citation", material.citation),
            ("poisson_ratio", material.poisson_ratio),
            ("shift", plain(material.shift)),
            ("vertical_shift", plain(material.vertical_shift)),
            ("fit", plain(getattr(material.spectrum, "fit", None))),
        )
        if content not in (None, "")
    }


def assembled(spectrum: RetardationSpectrum | ModulusTable, about: dict[str, Any]) -> Material:
    """Return the material of a spectrum and what `about` said of it."""
    if about.get("fit") is not None and isinstance(spectrum, RetardationSpectrum):
        fit = fit_of(about["fit"])
        spectrum = RetardationSpectrum(spectrum.E0, spectrum.E_inf, spectrum.C, spectrum.tau, fit)
    return Material(
        spectrum,
        shift_of(about.get("shift")),
        poisson_ratio=float(about.get("poisson_ratio", 0.5)),
        name=str(about.get("name", "")),
        vertical_shift=vertical_shift_of(about.get("vertical_shift")),
        citation=str(about.get("citation", "")),
    )


def to_plain(material: Material) -> dict[str, Any]:
    """Return a whole material as plain values in SI units."""
    spectrum: Any = material.spectrum
    if isinstance(spectrum, ModulusTable):
        content: dict[str, Any] = {
            "kind": "ModulusTable",
            "angular_frequency": spectrum.angular_frequency.tolist(),
            "storage_modulus": spectrum.storage_modulus_values.tolist(),
            "loss_modulus": spectrum.loss_modulus_values.tolist(),
            "extrapolate": spectrum.extrapolate,
            "notes": list(spectrum.notes),
        }
    else:
        content = {
            "kind": "RetardationSpectrum",
            "E0": spectrum.E0,
            "E_inf": spectrum.E_inf,
            "C": spectrum.C.tolist(),
            "tau": spectrum.tau.tolist(),
        }
    return {"format": "viscofric material", "version": VERSION, **about(material), "spectrum": content}


def from_plain(content: Any) -> Material:
    """Return the material of `to_plain`.

    Raises
    ------
    InputError
        If something is missing, unknown or out of range; the sentence says what.
    """
    if not isinstance(content, dict) or content.get("format") != "viscofric material":
        raise InputError('is not a material of viscofric: it lacks "format": "viscofric material".')
    version = content.get("version")
    if not isinstance(version, int) or not 1 <= version <= VERSION:
        raise InputError(f"version = {version!r}: this viscofric reads version 1 to {VERSION}.")
    known = {"format", "version", "name", "citation", "poisson_ratio", "shift", "vertical_shift", "fit", "spectrum"}
    unknown = sorted(set(content) - known)
    if unknown:
        raise InputError(
            f"{', '.join(unknown)}: no such field in a material; right would be {', '.join(sorted(known))}."
        )
    spectrum = content.get("spectrum")
    spectrum = spectrum if isinstance(spectrum, dict) else {}
    kind = spectrum.get("kind")
    if kind not in ("RetardationSpectrum", "ModulusTable"):
        raise InputError(f"spectrum of kind {kind!r}: must be RetardationSpectrum or ModulusTable.")
    values = {name: value for name, value in spectrum.items() if name != "kind"}
    try:
        if kind == "ModulusTable":
            made: RetardationSpectrum | ModulusTable = ModulusTable(
                **{**values, "notes": tuple(values.get("notes", ()))}
            )
        else:
            made = RetardationSpectrum(**values)
        return assembled(made, content)
    except (TypeError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"{kind} cannot be made of {', '.join(sorted(values)) or 'nothing'} ({error}).") from None
