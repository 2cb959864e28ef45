"""A material as plain numbers and text, and back: viscofric's own material file (JSON), and comments of cards."""

from __future__ import annotations

import inspect
import json
import textwrap
from dataclasses import is_dataclass, replace
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from viscofric import datasets
from viscofric.errors import InputError, wrong_argument
from viscofric.files import parse_json
from viscofric.notes import Note, Remedy, dumped, note_of, records
from viscofric.rheology.cards.card import Solid, Writing, card_law
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import VFT, WLF, Arrhenius, InversePolynomial, OneTemperature, WLFArrhenius
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.shifts.shift_law import as_record
from viscofric.rheology.shifts.vertical_shift import DensityShift, VerticalShiftFactors
from viscofric.rheology.spectra.modulus_table import ModulusTable
from viscofric.rheology.spectra.quality import SpectrumFit
from viscofric.rheology.spectra.retardation import RelaxationSpectrum, RetardationSpectrum
from viscofric.units import CELSIUS_ZERO, celsius

#: Version of the format, increased when older programs can no longer read its files.
VERSION = 1

_SHIFTS: tuple[type, ...] = (WLF, VFT, Arrhenius, WLFArrhenius, InversePolynomial, OneTemperature, ShiftFactors)
_VERTICAL: tuple[type, ...] = (DensityShift, VerticalShiftFactors)
_SPECTRA: tuple[type, ...] = (RetardationSpectrum, ModulusTable)


@lru_cache(maxsize=1)
def _kinds() -> dict[str, type]:
    return {one.__name__: one for one in (*_SHIFTS, *_VERTICAL, *_SPECTRA, SpectrumFit)}


def plain(value: Any) -> Any:
    """Return a value in JSON's types: a dataclass as its class's name and its constructor's arguments."""
    if isinstance(value, Note) and value.code:
        return datasets.plain(value.record(), None)
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


def restored(value: Any, allowed: tuple[type, ...], field: str) -> Any:
    """Return the object that `plain` made; InputError if its kind is not `allowed`, or a field of it is unknown."""
    if value is None:
        return None
    names = [one.__name__ for one in allowed]
    kind = value.get("kind") if isinstance(value, dict) else None
    if kind not in names:
        raise wrong_argument(f"kind of {field}", kind, f"must be one of {', '.join(names)}.", "wrong-choice")
    one = _kinds()[kind]
    arguments = {name: content for name, content in value.items() if name != "kind"}
    unknown = sorted(set(arguments) - set(inspect.signature(one).parameters))
    if unknown:
        raise InputError(
            f"{kind} has no {', '.join(unknown)}; the file may be of a newer version of viscofric.",
            code="unknown-field",
        )
    try:
        return one(**{name: _as_tuples(content) for name, content in arguments.items()})
    except InputError:
        raise
    except (TypeError, ValueError) as error:
        raise InputError(
            f"{kind} cannot be made of {', '.join(sorted(arguments)) or 'nothing'} ({error}).", code="missing-fields"
        ) from None


def _as_tuples(content: Any) -> Any:
    """Return lists as tuples, also those in lists, and records of notes as notes."""
    if isinstance(content, dict) and "code" in content:
        return note_of(content)
    return tuple(map(_as_tuples, content)) if isinstance(content, list) else content


def shift_of(value: Any) -> Any:
    """Return a shift law or table from `plain`."""
    return restored(value, _SHIFTS, "shift")


def about(material: Material) -> dict[str, Any]:
    """Return a material without its spectrum, as plain values; properties that are not set are left out."""
    return {
        name: content
        for name, content in (
            ("name", material.name),
            ("citation", material.citation),
            ("synthetic", material.synthetic or None),
            ("poisson_ratio", material.poisson_ratio),
            ("shift", plain(material.shift)),
            ("vertical_shift", plain(material.vertical_shift)),
            ("fit", _plain_fit(getattr(material.spectrum, "fit", None))),
        )
        if content not in (None, "")
    }


def _plain_fit(fit: SpectrumFit | None) -> Any:
    """Return the fit of a spectrum as plain values, its notes with their remedies for all readers."""
    return None if fit is None else {**plain(fit), "notes": json.loads(dumped(records(fit.notes)))}


def _fit_of(value: Any) -> SpectrumFit:
    """Return the fit of `_plain_fit`; its notes may also be sentences."""
    fit: SpectrumFit = restored(value, (SpectrumFit,), "fit")
    try:
        return replace(fit, notes=tuple(map(note_of, fit.notes)))
    except (AttributeError, KeyError, TypeError):
        raise InputError("fit has notes that are no sentences with codes.", code="wrong-notes") from None


def assembled(spectrum: RetardationSpectrum | ModulusTable, about: dict[str, Any]) -> Material:
    """Return the material of a spectrum and of the values from `about`."""
    if about.get("fit") is not None and isinstance(spectrum, RetardationSpectrum):
        fit = _fit_of(about["fit"])
        spectrum = RetardationSpectrum(spectrum.E0, spectrum.E_inf, spectrum.C, spectrum.tau, fit)
    return Material(
        spectrum,
        shift_of(about.get("shift")),
        poisson_ratio=about.get("poisson_ratio", 0.5),
        name=str(about.get("name", "")),
        vertical_shift=restored(about.get("vertical_shift"), _VERTICAL, "vertical_shift"),
        citation=str(about.get("citation", "")),
        synthetic=about.get("synthetic", False),
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
        content = {name: one for name, one in plain(spectrum).items() if name != "fit"}  # which `about` has
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
    known = {"format", "version", "name", "citation", "synthetic", "poisson_ratio", "fit", "spectrum"}
    known |= {"shift", "vertical_shift"}
    unknown = sorted(set(content) - known)
    if unknown:
        raise InputError(
            f"{', '.join(unknown)}: no such field in a material; expected {', '.join(sorted(known))}.",
            code="unknown-field",
        )
    spectrum = content.get("spectrum")
    return assembled(restored(spectrum if isinstance(spectrum, dict) else {}, _SPECTRA, "spectrum"), content)


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


#: Start of each line that `read_card` reads back; the rest of the line is a piece of one JSON text.
_MARK = "viscofric>"
_PIECE = 66  # characters: LS-DYNA reads 80 of a line
_UNITS = {"Pa": "Pa, s, m, kg", "MPa": "MPa, s, mm, tonne (density in t/mm^3, forces in N)"}
#: Two numbers of a card are the same if only their last digits differ.
_SAME = 1e-9


class Contents(NamedTuple):
    """What the cards of all programs hold."""

    relaxation: RelaxationSpectrum  # in tension
    poisson_ratio: float
    law: WLF | Arrhenius | None  # of the shift
    sentences: list[str]  # for people
    stored: dict[str, Any]  # what the keywords cannot hold

    @property
    def modes(self) -> list[tuple[float, float]]:
        """Modulus, Pa, and relaxation time, s, of each mode."""
        return list(zip(self.relaxation.E.tolist(), self.relaxation.tau.tolist(), strict=True))

    def comments(self, mark: str, *more: str) -> list[str]:
        """Return the head of the card, with more sentences; see `comment_lines`."""
        return comment_lines(mark, [*self.sentences, *more], self.stored)


def contents_of(
    material: Material, writing: Writing, program: str, incompressible: str | None = None, *, with_shift: bool = True
) -> Contents:
    """Return what a card is to hold; `incompressible` is why the program takes no ν = 0.5, None if it does."""
    spectrum: Any = material.spectrum
    if not isinstance(spectrum, RetardationSpectrum):
        raise InputError(
            f"{program} cards contain a Prony series, but this material is a table of moduli; fit a spectrum "
            'first, or write format="json".',
            code="no-modes",
        )
    relaxation = spectrum.to_relaxation()
    if not len(relaxation):
        raise InputError(
            f"{program} cards contain a Prony series, but this material is elastic: it has no mode.", code="no-modes"
        )
    ratio = material.poisson_ratio if writing.poisson_ratio is None else writing.poisson_ratio
    if ratio == 0.5 and incompressible:
        advice = Remedy("poisson_ratio=0.4995", "--poisson-ratio 0.4995", page="“Poisson's ratio”: 0.4995")
        advice += " for instance (E stays as it is, 2(1+ν)G changes with it)."
        said = f"{program} {incompressible}, and this material has 0.5; give the card a nearly incompressible one, "
        raise InputError(Note("incompressible", said, remedy=advice))
    law = card_law(material.shift) if with_shift else None
    card = {
        "poisson_ratio": ratio,
        "E0": relaxation.E0,
        "E_inf": relaxation.E_inf,
        "shift": law is not None,
        "absolute_zero": 0.0 if writing.temperature_unit == "K" else -CELSIUS_ZERO,
        "unit_system": writing.modulus_unit,
    }
    stored = {"version": VERSION, **about(material), "card": card}
    return Contents(relaxation, ratio, law, _remarks(material, writing, ratio, law is not None), stored)


def _remarks(material: Material, writing: Writing, poisson_ratio: float, shift_written: bool) -> list[str]:
    """Return the sentences for people at the head of a card."""
    temperatures = "K" if writing.temperature_unit == "K" else "degrees Celsius"
    sentences = [
        "Linear viscoelastic material, a Prony series; written by viscofric.",
        f"Units: {_UNITS[writing.modulus_unit]}; temperatures in {temperatures}.",
    ]
    if material.name:
        sentences.insert(0, material.name)
    if material.synthetic:
        sentences.append("SYNTHETIC, not measured.")
    if material.citation:
        sentences.append(f"Source: {material.citation}")
    sentences.append(
        "The Poisson ratio is constant, so that bulk and shear modulus relax in the same way (k_i = g_i)."
        if poisson_ratio < 0.5
        else "The material is incompressible: use hybrid (mixed) elements."
    )
    if poisson_ratio != material.poisson_ratio:
        own = f"The material's Poisson ratio is {material.poisson_ratio!r}"
        sentences.append(f"{own}; this card has {poisson_ratio!r}, as requested.")
    if material.shift is not None and not shift_written:
        why = f": this keyword cannot express its shift, {type(material.shift).__name__}"
        sentences.append(
            f"The card is valid at {celsius(float(material.shift.reference)):.6g} degrees Celsius only"
            f"{why if material.has_shift_factors else ''}."
        )
    if material.vertical_shift is not None:
        sentences.append("The vertical shift of the modulus with temperature, b(T), is not in the card.")
    return sentences


def number_of(content: dict[str, Any] | None, name: str) -> float | None:
    """Return a number that `contents_of` put into the comments, if there is one."""
    value = None if content is None else content["card"].get(name)
    if value is None or (isinstance(value, (int, float)) and np.isfinite(value)):
        return value
    raise InputError(f"the lines marked {_MARK!r} are damaged: {name} is no number.", code="damaged")


def share_of(content: dict[str, Any] | None) -> float | None:
    """Return the long-term modulus over the instantaneous one by the comments, if they have both."""
    E0, E_inf = number_of(content, "E0"), number_of(content, "E_inf")
    return E0 / E_inf if E0 is not None and E_inf else None


def modulus_unit_of(content: dict[str, Any] | None) -> str | None:
    """Return the unit of moduli that `contents_of` put into the comments, if there is one."""
    unit = None if content is None else content["card"].get("unit_system")
    if unit is None or unit in _UNITS:
        return unit
    raise InputError(
        f"the lines marked {_MARK!r} are damaged: unit_system is not {' or '.join(_UNITS)}.", code="damaged"
    )


def comment_lines(mark: str, sentences: list[str], content: dict[str, Any]) -> list[str]:
    """Return comment lines that begin with a program's comment mark, in ASCII."""
    lines = []
    for sentence in sentences:
        words = " ".join(sentence.split()).replace("–", "-").encode("ascii", "replace").decode()
        lines += [f"{mark} {line}" for line in textwrap.wrap(words, _PIECE, break_on_hyphens=False)]
    text = json.dumps(content, separators=(",", ":"), allow_nan=False)
    # Bars keep spaces at the ends of pieces from editors that strip them.
    return lines + [
        f"{mark} {_MARK} |{text[start : start + _PIECE - 14]}|" for start in range(0, len(text), _PIECE - 14)
    ]


def stored_content(text: str) -> dict[str, Any] | None:
    """Return what `comment_lines` stored in a file, or None without such lines."""
    pieces = []
    for line in text.splitlines():
        _, mark, rest = line.partition(_MARK)
        if mark:
            piece = rest.strip()
            if len(piece) < 2 or piece[0] != "|" or piece[-1] != "|":
                raise InputError(
                    f"a line marked {_MARK!r} is damaged; restore it, or delete all lines so marked.", code="damaged"
                )
            pieces.append(piece[1:-1])
    if not pieces:
        return None
    try:
        content = parse_json("".join(pieces))
    except ValueError:
        content = None
    if not isinstance(content, dict) or not isinstance(content.get("card"), dict):
        raise InputError(
            f"the lines marked {_MARK!r} are damaged; restore them, or delete all lines so marked.", code="damaged"
        )
    if content.get("version") != VERSION:
        raise InputError(
            f"the lines marked {_MARK!r} are of version {content.get('version')!r}, not {VERSION}.",
            code="newer-version",
        )
    return content


def material_of(solid: Solid, content: dict[str, Any] | None) -> tuple[Material, list[Note]]:
    """Combine the properties of a card's keywords and of its comments; the keywords take precedence."""
    if content is None:
        material = assembled(solid.spectrum, {"name": solid.name, "poisson_ratio": solid.poisson_ratio})
        return replace(material, shift=solid.shift), []
    notes, card = [], content["card"]
    stated = {name: value for name, value in content.items() if name != "card"}
    if not _close(card.get("poisson_ratio"), solid.poisson_ratio):
        notes.append(
            Note(
                "changed-in-card",
                f"The Poisson ratio was changed to {solid.poisson_ratio:.6g} in the card, which counts.",
                values={"poisson_ratio": solid.poisson_ratio},
            )
        )
        stated["poisson_ratio"] = solid.poisson_ratio
    if card.get("shift") and not _same_law(card_law(shift_of(stated.get("shift"))), solid.shift):
        notes.append(
            Note("changed-in-card", "The shift was changed in the card, which counts.", values={"shift": True})
        )
        stated.pop("shift", None)
        return replace(assembled(solid.spectrum, stated), shift=solid.shift), notes
    return assembled(solid.spectrum, stated), notes


def _close(stored_value: Any, value: float) -> bool:
    return isinstance(stored_value, (int, float)) and abs(stored_value - value) <= _SAME * max(abs(value), 1e-3)


def _same_law(stored_law: Any, law: Any) -> bool:
    if type(stored_law) is not type(law):
        return False
    if law is None:
        return True
    ours, theirs = ([*one.parameters, one.reference] for one in (stored_law, law))
    return bool(np.allclose(ours, theirs, rtol=_SAME, atol=0.0))
