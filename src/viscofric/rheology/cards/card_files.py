"""Materials written as cards of finite-element programs and read back: the functions and the formats."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any, Literal, NamedTuple, TypeAlias, get_args

import numpy as np

from viscofric.arguments import insist_on, whole_number
from viscofric.errors import (
    DataFileError,
    InputError,
    check_choice,
    not_needed,
    not_written,
    short_notes,
    wrong_argument,
)
from viscofric.files import file_path, read_text, says_synthetic
from viscofric.notes import Note, Remedy, note_of
from viscofric.rheology.cards import abaqus, ansys, comsol, ls_dyna, native
from viscofric.rheology.cards.card import SOFTEST, Card, Reading, Solid, UnitSystem, Writing, card_law, give_units
from viscofric.rheology.cards.native import material_of, modulus_unit_of, stored_content
from viscofric.rheology.material import Material, insist_on_material
from viscofric.rheology.shifts.law_comparison import LARGEST_SCATTER
from viscofric.rheology.shifts.laws import ParametricLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.units import Quantity, checked_poisson_ratio, positive, shown_celsius

#: Formats of `write_card`.
CardFormat: TypeAlias = Literal["abaqus", "ansys", "ls-dyna", "comsol", "comsol-branches", "json"]


#: Laws that `write_card` fits for programs.
CardLaw: TypeAlias = Literal["best", "wlf", "vft", "arrhenius"]
#: Programs whose cards have no units: those of the model apply.
_WITHOUT_UNITS = ("abaqus", "ansys", "ls-dyna")
_WITH_DENSITY = (*_WITHOUT_UNITS, "comsol")
#: Argument of `write_card` -> its default, and the formats that hold it.
_OF_FORMATS: dict[str, tuple[object, tuple[str, ...]]] = {
    "modulus_unit": ("Pa", _WITHOUT_UNITS),
    "temperature_unit": ("K", _WITHOUT_UNITS),
    "domain": ("time", ("abaqus",)),
    "material_id": (1, ("ansys", "ls-dyna")),
}


class _Program(NamedTuple):
    name: str
    recognises: Callable[[str], bool]
    write: Callable[[Material, Writing], str]
    read: Callable[[str, Reading, dict[str, Any] | None], Any]


_PROGRAMS: dict[str, _Program] = {
    "abaqus": _Program("an Abaqus card", abaqus.recognises, abaqus.write, abaqus.read),
    "ansys": _Program("an ANSYS card", ansys.recognises, ansys.write, ansys.read),
    "ls-dyna": _Program("an LS-DYNA card", ls_dyna.recognises, ls_dyna.write, ls_dyna.read),
    "comsol": _Program("COMSOL parameters", comsol.recognises, comsol.write, comsol.read),
    "comsol-branches": _Program(
        "a COMSOL table of branches", comsol.recognises_branches, comsol.write_branches, comsol.read_branches
    ),
}

#: A material card is far smaller, even within a deck of a whole model; bytes.
LARGEST_CARD = 20_000_000


def write_card(
    material: Material,
    path: str | PathLike[str],
    format: CardFormat,  # noqa: A002 (as users call it)
    *,
    poisson_ratio: float | None = None,
    density: Quantity | None = None,
    temperature_unit: Literal["K", "degC"] = "K",
    domain: Literal["time", "frequency"] = "time",
    material_id: int = 1,
    modulus_unit: UnitSystem = "Pa",
    law: CardLaw | None = None,
) -> Path:
    """Write a material for another program, in Pa, s, m and kg or in MPa, s, mm and tonnes.

    The modulus E becomes G = E/(2(1+ν)) and K = E/(3(1−2ν)).  The Poisson ratio of a `Material` is constant, so that
    bulk relaxes as shear does (k_i = g_i): only then has the card the material's E(ω).  Close to ν = 0.5 this makes the
    bulk modulus of the glass far larger than any real one; take the largest ratio that the elements bear, or one
    that gives the bulk modulus meant.  What a format cannot hold
    (a shift other than WLF, VFT or Arrhenius, covariances, the vertical shift, the citation) goes into comments,
    which `read_card` reads back: nothing is lost on the way there and back.  A warning says where the program then has
    no dependence on temperature; `law` gives it one.

    COMSOL has this bulk relaxation only with "Volumetric and deviatoric" branches (6.2); for others its parameters hold
    the bulk modulus of the glass.  The sign of a WLF shift in LS-DYNA must be checked on one element.  The comments of
    both cards say so.

    Parameters
    ----------
    material : Material
        It needs a retardation spectrum, except for json.
    path : str or path
        The file; it is overwritten.
    format : {"abaqus", "ansys", "ls-dyna", "comsol", "comsol-branches", "json"}
        "json" is viscofric's own material file.
    poisson_ratio : float, optional
        For the card instead of the material's own.  ANSYS and LS-DYNA cannot take 0.5.  E stays as it is.
    density : float or quantity, optional
        kg/m³; LS-DYNA needs it, "json" and "comsol-branches" hold none.
    temperature_unit : {"K", "degC"}
        Of cards for Abaqus, ANSYS and LS-DYNA: in which the model counts temperatures.
    domain : {"time", "frequency"}
        Of Abaqus: ``*VISCOELASTIC, TIME=PRONY`` or ``FREQUENCY=PRONY`` (which takes no ``*TRS``).
    material_id : int
        Number of the material in ANSYS and LS-DYNA.
    modulus_unit : {"Pa", "MPa"}
        Of cards for Abaqus, ANSYS and LS-DYNA: SI, or mm, s, tonne and N, with moduli in MPa and density in t/mm³.
        The card's comments name it, and `read_card` reads it there.
    law : {"best", "wlf", "vft", "arrhenius"}, optional
        Fitted to the material's table of shift factors and written in its place: programs take a law and no table.
        "best" is that of these which the table supports best (`ShiftFactors.compare_laws`).

    Returns
    -------
    Path
        The file.

    Warns
    -----
    UserWarning
        With a `Note`: ``card-without-shift`` where the program gets no dependence on temperature,
        ``card-without-vertical-shift`` where it gets no b(T), ``card-without-density`` where it gets no density,
        ``card-law-misfit`` where a fitted law misses the table.

    Raises
    ------
    InputError
        If the format is unknown, or cannot hold the material or a choice.
    DataFileError
        If the file cannot be written.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.catalogue_material("PVB interlayer")
    >>> path = vf.write_card(rubber, "rubber.inp", format="abaqus", poisson_ratio=0.49)
    >>> "*VISCOELASTIC" in path.read_text().upper()
    True
    """
    insist_on_material(material)
    check_choice(format, "format", *get_args(CardFormat))
    check_choice(temperature_unit, "temperature_unit", "K", "degC")
    check_choice(domain, "domain", "time", "frequency")
    check_choice(modulus_unit, "modulus_unit", *get_args(UnitSystem))
    whole_number(material_id, "material_id", 1)
    given = {"modulus_unit": modulus_unit, "temperature_unit": temperature_unit, "domain": domain}
    for name, value in (given | {"material_id": material_id}).items():
        usual, formats = _OF_FORMATS[name]
        if value != usual and format not in formats:
            said = f"{format} has no such choice; leave it out (it is for {', '.join(formats)})."
            raise wrong_argument(name, value, said, "not-of-format")
    notes: list[Note] = []
    if law is not None:
        material = _with_law(material, law, notes)
    writing = Writing(
        None if poisson_ratio is None else checked_poisson_ratio(poisson_ratio),
        None if density is None else positive(density, "kg/m^3", "density"),
        temperature_unit,
        domain,
        material_id,
        modulus_unit,
    )
    if format == "json":
        own = material.poisson_ratio if writing.poisson_ratio is None else writing.poisson_ratio
        text = native.write_json(replace(material, poisson_ratio=own))
    else:
        text = _PROGRAMS[format].write(material, writing)
        notes += _left_out(material, format, domain, text)
    if density is not None and format not in _WITH_DENSITY:
        notes.append(Note("card-without-density", f"The card for {format} lacks the density."))
    file = file_path(path)
    try:
        file.write_text(text, encoding="utf-8")
    except (OSError, ValueError) as error:
        raise not_written(path, error) from None
    for note in notes:
        warnings.warn(note, stacklevel=2)
    return file


def _with_law(material: Material, law: str, notes: list[Note]) -> Material:
    """Return the material with a law fitted to its table of shift factors, and a note on its misfit."""
    if law not in get_args(CardLaw):
        raise wrong_argument("law", law, f"must be one of {', '.join(get_args(CardLaw))}.", "unknown-law")
    factors: Any = material.shift
    if not isinstance(factors, ShiftFactors):
        raise wrong_argument(
            "law", law, "the material has no table of shift factors to fit a law to; leave it out.", "no-table"
        )
    fitted = _best_law(factors) if law == "best" else factors.law(law)
    missed = _missed(factors, fitted)
    if missed > LARGEST_SCATTER:
        text = f"The {fitted.title} law of the card misses the shift factors by up to {missed:.2g} decades."
        notes.append(Note("card-law-misfit", text))
    return replace(material, shift=fitted)


def _best_law(factors: ShiftFactors) -> ParametricLaw:
    """Return the best of the laws that programs have."""
    laws = factors.compare_laws()
    known = [row.law for row in (laws.chosen, *laws.rows) if row.law is not None and card_law(row.law) is not None]
    if not known:
        raise InputError("law = 'best': neither a WLF nor an Arrhenius law describes the shift factors.", code="no-law")
    return known[0]


def _missed(factors: ShiftFactors, law: ParametricLaw) -> float:
    return float(np.max(np.abs(factors.log10_values - law.log10(factors.temperatures))))


def _left_out(material: Material, form: str, domain: str, text: str) -> list[Note]:
    """Return a sentence on the part of the temperature dependence that the card cannot contain."""
    notes, shift = [], material.shift
    written = (stored_content(text) or {"card": {}})["card"].get("shift")
    if shift is not None and material.has_shift_factors and not written:
        about = f"The card for {form} holds at {shown_celsius(float(shift.reference))} °C only: "
        notes.append(_no_shift(about, shift, form, domain))
    if material.vertical_shift is not None:
        notes.append(Note("card-without-vertical-shift", f"The card for {form} lacks the vertical shift b(T)."))
    return notes


def _no_shift(about: str, shift: Any, form: str, domain: str) -> Note:
    """Return the reason why a card has no shift, and how to write one."""
    only = "the program takes a shift law, but no table of shift factors"
    remedy = None
    if form == "comsol-branches":
        why = 'a table of branches contains no shift; format "comsol" does.'
    elif form == "abaqus" and domain == "frequency":
        why = "in the frequency domain Abaqus takes no shift."
    elif not isinstance(shift, ShiftFactors):
        why = f"the program takes a WLF or an Arrhenius law, but no {shift.title} law; give the material one of them."
    else:
        try:
            law = _best_law(shift)
        except InputError:
            why = f"{only}, and neither a WLF nor an Arrhenius law describes them."
        else:
            why = f"{only}. {law}, fitted to them, misses them by up to {max(_missed(shift, law), 0.001):.1g} decades"
            remedy = Remedy(
                '; law="best" writes it.',
                "; --card-law best writes it.",
                page="; choose a law under “Shift law” to write it.",
            )
    return Note("card-without-shift", about + why, remedy=remedy)


def open_card(
    path: str | PathLike[str],
    format: CardFormat | None = None,  # noqa: A002
    *,
    modulus_unit: str | None = None,
    time_unit: str | None = None,
    temperature_unit: str | None = None,
) -> Card:
    """Read a material card, with notes on what was assumed.

    Shear and bulk series of any kind are read: 1/E = 1/(3G) + 1/(9K) is turned into the retardation modes of E
    exactly.  Hyperelastic cards give their small-strain limit.

    Parameters
    ----------
    path : str or path
        The file.
    format : {"abaqus", "ansys", "ls-dyna", "comsol", "comsol-branches", "json"}, optional
        Found by content if not given.
    modulus_unit, time_unit, temperature_unit : str, optional
        Units of a card that was not written by viscofric, such as ``"MPa"``, ``"ms"``, ``"degC"``.  Without them
        Pa and s are assumed, and temperatures judged by their size; the notes say so.  Moduli that cannot be in Pa
        are refused.

    Returns
    -------
    Card
        `material`, `format` (as which the file was read) and `notes`.

    Raises
    ------
    DataFileError
        If the file cannot be read as a card, with the reason, or units are given and the file states its own.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.catalogue_material("PVB interlayer")
    >>> path = vf.write_card(rubber, "rubber.inp", format="abaqus", poisson_ratio=0.49)
    >>> card = vf.rheology.open_card(path)
    >>> card.format
    'an Abaqus card'
    """
    if format is not None:
        check_choice(format, "format", *get_args(CardFormat))
    units = (("modulus_unit", modulus_unit), ("time_unit", time_unit), ("temperature_unit", temperature_unit))
    for name, unit in units:
        insist_on(unit, name, str, type(None), right="the text of a unit, such as 'MPa'")
    text = read_text(path, LARGEST_CARD)
    given = next((name for name, unit in units if unit is not None), None)
    try:
        is_json = format == "json" or (format is None and native.recognises_json(text))
        content = None if is_json else stored_content(text)
        if given and (is_json or content is not None):
            raise not_needed(path, given, "unit-not-needed", "was written by viscofric, and states its units")
        if is_json:
            return Card(native.read_json(text), native.NAME_JSON)
        found: str = format or next((key for key, one in _PROGRAMS.items() if one.recognises(text)), "")
        if not found:
            raise InputError(
                "is not a material card. Supported are Abaqus, ANSYS and LS-DYNA cards with a Prony series, COMSOL "
                "parameters, and material files of viscofric (JSON); `viscofric material fit` makes one from "
                "DMA sweeps.",
                code="unknown-card",
            )
        if format is not None and not _PROGRAMS[found].recognises(text):
            raise InputError(f"is not {_PROGRAMS[found].name}.", code="other-card")
        reading = Reading(modulus_unit or modulus_unit_of(content), time_unit, temperature_unit)
        solid = _PROGRAMS[found].read(text, reading, content)
        _insist_on_units(solid)
        material, notes = material_of(solid, content)
        material = replace(material, synthetic=material.synthetic or says_synthetic(path))
        return Card(material, _PROGRAMS[found].name, short_notes((*solid.notes, *notes)))
    except DataFileError:
        raise
    except InputError as error:
        raise DataFileError(path, error.note) from None


def _insist_on_units(solid: Solid) -> None:
    """Raise an error where assumed units give moduli of no solid."""
    assumed = any("modulus_unit" in note_of(note).values.get("assumed", ()) for note in solid.notes)
    glass = solid.spectrum.E_inf
    if assumed and glass < SOFTEST:
        problem = f"E = {glass:.3g} (instantaneous) is very soft if in Pa, and the card does not state its units; give "
        problem += "them, even if they are Pa, "
        remedy = give_units(["modulus_unit"]) + "."
        raise InputError(Note("unit-unknown", problem, remedy=remedy, values={"glass": float(glass)}))


def read_card(
    path: str | PathLike[str],
    format: CardFormat | None = None,  # noqa: A002
    *,
    modulus_unit: str | None = None,
    time_unit: str | None = None,
    temperature_unit: str | None = None,
) -> Material:
    """Read a material card; warnings say what was assumed (`open_card` returns it as notes instead).

    Parameters
    ----------
    path : str or path
        The file.
    format : {"abaqus", "ansys", "ls-dyna", "comsol", "comsol-branches", "json"}, optional
        Found by content if not given.
    modulus_unit, time_unit, temperature_unit : str, optional
        Units of a card that was not written by viscofric; see `open_card`.

    Returns
    -------
    Material
        In tension and SI units.

    Raises
    ------
    DataFileError
        If the file cannot be read as a card, with the reason.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.synthetic_fluoroelastomer()
    >>> _ = vf.write_card(rubber, "rubber.json", format="json")
    >>> bool((vf.read_card("rubber.json").spectrum.C == rubber.spectrum.C).all())
    True
    """
    card = open_card(path, format, modulus_unit=modulus_unit, time_unit=time_unit, temperature_unit=temperature_unit)
    for note in card.notes:
        warnings.warn(note_of(note).at(str(path)), stacklevel=2)
    return card.material
