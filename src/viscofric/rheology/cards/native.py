"""A material as plain numbers and text, and back: viscofric's own material file (JSON), and comments of cards."""

from __future__ import annotations

import json
from dataclasses import is_dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from viscofric.errors import InputError, wrong_argument
from viscofric.files import parse_json
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import VFT, WLF, Arrhenius, InversePolynomial, WLFArrhenius
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_law import as_record, kept_arguments
from viscofric.rheology.shifts.vertical_shift import DensityShift, VerticalShiftFactors
from viscofric.rheology.spectra.modulus_table import ModulusTable
from viscofric.rheology.spectra.quality import SpectrumFit
from viscofric.rheology.spectra.retardation import RetardationSpectrum

#: Version of the format, increased when older programs can no longer read its files.
VERSION = 1

_SHIFTS: tuple[type, ...] = (WLF, VFT, Arrhenius, WLFArrhenius, InversePolynomial, ShiftFactors)
_VERTICAL: tuple[type, ...] = (DensityShift, VerticalShiftFactors)


@lru_cache(maxsize=1)
def _kinds() -> dict[str, type]:
    return {one.__name__: one for one in (*_SHIFTS, *_VERTICAL, SpectrumFit)}


def plain(value: Any) -> Any:
    """Return a value in JSON's types: a dataclass as its class's name and its constructor's arguments."""
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
    raise InputError(f"a material file cannot hold a {type(value).__name__}.", code="wrong-type")


def restored(value: Any, allowed: tuple[type, ...]) -> Any:
    """Return the object that `plain` made; InputError if its kind is not `allowed`, or a field of it is unknown."""
    if value is None:
        return None
    names = [one.__name__ for one in allowed]
    kind = value.get("kind") if isinstance(value, dict) else None
    if kind not in names:
        raise wrong_argument("kind", kind, f"must be one of {', '.join(names)}.", "wrong-choice")
    one = _kinds()[kind]
    arguments = {name: content for name, content in value.items() if name != "kind"}
    unknown = sorted(set(arguments) - set(kept_arguments(one)))
    if unknown:
        raise InputError(
            f"{kind} has no {', '.join(unknown)}; the file may be of a newer version of viscofric.",
            code="unknown-field",
        )
    arguments = {name: tuple(content) if _is_row(content) else content for name, content in arguments.items()}
    try:
        return one(**arguments)
    except TypeError as error:
        raise InputError(
            f"{kind} cannot be made of {', '.join(sorted(arguments)) or 'nothing'} ({error}).", code="missing-fields"
        ) from None


def _is_row(content: Any) -> bool:
    """Return whether a value is a row (a tuple of texts or numbers), not a matrix."""
    return isinstance(content, list) and not any(isinstance(one, list) for one in content)


def shift_of(value: Any) -> Any:
    """Return a shift law or table from `plain`."""
    return restored(value, _SHIFTS)


def about(material: Material) -> dict[str, Any]:
    """Return a material without its spectrum, as plain values; properties that are not set are left out."""
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
    """Return the material of a spectrum and of the values from `about`."""
    if about.get("fit") is not None and isinstance(spectrum, RetardationSpectrum):
        fit = restored(about["fit"], (SpectrumFit,))
        spectrum = RetardationSpectrum(spectrum.E0, spectrum.E_inf, spectrum.C, spectrum.tau, fit)
    return Material(
        spectrum,
        shift_of(about.get("shift")),
        poisson_ratio=float(about.get("poisson_ratio", 0.5)),
        name=str(about.get("name", "")),
        vertical_shift=restored(about.get("vertical_shift"), _VERTICAL),
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
    """Return the material of `to_plain`; InputError says what is missing, unknown or out of range."""
    if not isinstance(content, dict) or content.get("format") != "viscofric material":
        raise InputError(
            'is not a material of viscofric: it lacks "format": "viscofric material".', code="not-a-material"
        )
    version = content.get("version")
    if not isinstance(version, int) or not 1 <= version <= VERSION:
        raise wrong_argument("version", version, f"this viscofric reads version 1 to {VERSION}.", "newer-version")
    known = {"format", "version", "name", "citation", "poisson_ratio", "shift", "vertical_shift", "fit", "spectrum"}
    unknown = sorted(set(content) - known)
    if unknown:
        raise InputError(
            f"{', '.join(unknown)}: no such field in a material; expected {', '.join(sorted(known))}.",
            code="unknown-field",
        )
    spectrum = content.get("spectrum")
    spectrum = spectrum if isinstance(spectrum, dict) else {}
    kind = spectrum.get("kind")
    if kind not in ("RetardationSpectrum", "ModulusTable"):
        raise InputError(
            f"spectrum of kind {kind!r}: must be RetardationSpectrum or ModulusTable.", code="wrong-choice"
        )
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
        raise InputError(
            f"{kind} cannot be made of {', '.join(sorted(values)) or 'nothing'} ({error}).", code="missing-fields"
        ) from None


NAME_JSON = "viscofric JSON"


def recognises_json(text: str) -> bool:
    """Return whether a text is JSON."""
    return text.lstrip().startswith("{")


def write_json(material: Material) -> str:
    """Return the material as JSON, with all digits of numbers."""
    return json.dumps(to_plain(material), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def read_json(text: str) -> Material:
    """Return the material of a JSON text."""
    try:
        content = parse_json(text, parse_constant=_no_constant)
    except InputError:
        raise
    except json.JSONDecodeError as error:
        raise InputError(f"line {error.lineno}: is not JSON ({error.msg}).", code="damaged") from None
    except ValueError as error:  # nested too deeply, or with numbers of thousands of digits
        raise InputError(f"is no JSON of a material ({error}).", code="damaged") from None
    return from_plain(content)


def _no_constant(name: str) -> float:
    raise InputError(f"holds {name}; numbers of a material must be finite.", code="damaged")
