"""Materials written as cards of finite-element programs and read back: the verbs, and which formats there are."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, get_args

from viscofric.errors import DataFileError, InputError
from viscofric.files import read_text
from viscofric.rheology.cards import abaqus, ansys, comsol, ls_dyna, plain
from viscofric.rheology.cards.card import Card, Reading, UnitSystem, Writing
from viscofric.rheology.cards.comments import material_of, modulus_unit_of, stored_content
from viscofric.units import positive, to_si

if TYPE_CHECKING:
    from collections.abc import Callable
    from os import PathLike

    from viscofric.rheology.material import Material
    from viscofric.units import Quantity

#: What `write_card` can write.
CardFormat: TypeAlias = Literal["abaqus", "ansys", "ls-dyna", "comsol", "comsol-branches", "csv", "json"]


#: Programs whose cards have no units: the model's own count.
_WITHOUT_UNITS = ("abaqus", "ansys", "ls-dyna")


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
    unit_system: UnitSystem = "Pa",
) -> Path:
    """Write a material for another program, in Pa, s, m and kg or in MPa, s, mm and tonnes.

    The modulus E becomes G = E/(2(1+ν)) and K = E/(3(1−2ν)).  The Poisson ratio of a `Material` is constant, so that
    bulk relaxes as shear does (k_i = g_i): only then has the card the material's E(ω).  Close to ν = 0.5 this makes the
    bulk modulus of the glass far larger than any real one; take the largest ratio that the elements bear, or one
    that gives the bulk modulus meant.  What a format cannot hold
    (a shift other than WLF, VFT or Arrhenius, covariances, the vertical shift, the citation) goes into comments,
    which `read_card` reads back: nothing is lost on the way there and back.

    COMSOL has this bulk relaxation only with "Volumetric and deviatoric" branches (6.2); for others its parameters hold
    the bulk modulus of the glass.  The sign of a WLF shift in LS-DYNA must be checked on one element.  The comments of
    both cards say so.

    Parameters
    ----------
    material : Material
        For all but csv and json with a retardation spectrum.
    path : str or path
        The file; it is overwritten.
    format : {"abaqus", "ansys", "ls-dyna", "comsol", "comsol-branches", "csv", "json"}
        "json" is viscofric's own material file.
    poisson_ratio : float, optional
        For the card instead of the material's own.  ANSYS and LS-DYNA cannot take 0.5.  E stays as it is.
    density : float or quantity, optional
        kg/m³; LS-DYNA needs it.
    temperature_unit : {"K", "degC"}
        In which the model counts temperatures; COMSOL parameters carry their unit.
    domain : {"time", "frequency"}
        Of Abaqus: ``*VISCOELASTIC, TIME=PRONY`` or ``FREQUENCY=PRONY`` (which takes no ``*TRS``).
    material_id : int
        Number of the material in ANSYS and LS-DYNA.
    unit_system : {"Pa", "MPa"}
        Of cards for Abaqus, ANSYS and LS-DYNA: SI, or mm, s, tonne and N, with moduli in MPa and density in t/mm³.
        The card's comments say which; `read_card` knows it from them.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    InputError
        If the format is unknown or cannot hold the material.
    DataFileError
        If the file cannot be written.

    Examples
    --------
    >>> import viscofric as vf
    >>> path = vf.write_card(vf.synthetic_fluoroelastomer(), "rubber.inp", format="abaqus", poisson_ratio=0.49)
    >>> "*VISCOELASTIC" in path.read_text().upper()
    True
    """
    if format not in get_args(CardFormat):
        raise InputError(f"format = {format!r}: must be one of {', '.join(get_args(CardFormat))}.")
    for name, value, allowed in (
        ("temperature_unit", temperature_unit, ("K", "degC")),
        ("domain", domain, ("time", "frequency")),
        ("unit_system", unit_system, get_args(UnitSystem)),
    ):
        if value not in allowed:
            raise InputError(f"{name} = {value!r}: must be {' or '.join(map(repr, allowed))}.")
    if unit_system != "Pa" and format not in _WITHOUT_UNITS:
        raise InputError(
            f"unit_system = {unit_system!r}: {format} holds SI units, and says so; leave unit_system out (it is for "
            f"{', '.join(_WITHOUT_UNITS)})."
        )
    if material_id != int(material_id) or material_id < 1:
        raise InputError(f"material_id = {material_id!r}: must be a whole number from 1 on.")
    writing = Writing(
        None if poisson_ratio is None else to_si(poisson_ratio, "dimensionless", "poisson_ratio"),
        None if density is None else positive(density, "kg/m^3", "density"),
        temperature_unit,
        domain,
        material_id,
        unit_system,
    )
    if format == "json":
        text = plain.write_json(material)
    elif format == "csv":
        text = plain.write_csv(material)
    else:
        text = _PROGRAMS[format].write(material, writing)
    file = Path(path)
    try:
        file.write_text(text, encoding="utf-8")
    except (OSError, ValueError) as error:
        raise DataFileError(path, f"cannot be written ({getattr(error, 'strerror', None) or error}).") from None
    return file


def open_card(
    path: str | PathLike[str],
    format: CardFormat | None = None,  # noqa: A002
    *,
    modulus_unit: str | None = None,
    time_unit: str | None = None,
    temperature_unit: str | None = None,
) -> Card:
    """Read a material card and tell what was assumed.

    Shear and bulk series of any kind are read: 1/E = 1/(3G) + 1/(9K) is turned into the retardation modes of E
    exactly.  Hyperelastic cards give their small-strain limit.

    Parameters
    ----------
    path : str or path
        The file.
    format : {"abaqus", "ansys", "ls-dyna", "comsol", "comsol-branches", "csv", "json"}, optional
        Found by content if not given.
    modulus_unit, time_unit, temperature_unit : str, optional
        Units of a card that was not written by viscofric, such as ``"MPa"``, ``"ms"``, ``"degC"``.  Without them
        Pa and s are assumed, and temperatures judged by their size; the notes say so.

    Returns
    -------
    Card
        `material`, `format` (what the file was taken for) and `notes`.

    Raises
    ------
    DataFileError
        If the file cannot be read as a card, with the reason.

    Examples
    --------
    >>> import viscofric as vf
    >>> path = vf.write_card(vf.synthetic_fluoroelastomer(), "rubber.inp", format="abaqus", poisson_ratio=0.49)
    >>> card = vf.open_card(path)
    >>> card.format
    'an Abaqus card'
    """
    if format is not None and format not in get_args(CardFormat):
        raise InputError(f"format = {format!r}: must be one of {', '.join(get_args(CardFormat))}.")
    text = read_text(path)
    try:
        if format == "json" or (format is None and plain.recognises_json(text)):
            return Card(plain.read_json(text), plain.NAME_JSON)
        if format == "csv" or (format is None and plain.recognises_csv(text)):
            return Card(plain.read_csv(text), plain.NAME_CSV)
        found: str = format or next((key for key, one in _PROGRAMS.items() if one.recognises(text)), "")
        if not found:
            raise InputError(
                "is no material card that viscofric knows: wanted is an Abaqus, ANSYS or LS-DYNA card with a Prony "
                "series, COMSOL parameters, or a material file of viscofric (JSON or CSV); `viscofric material "
                "fit` makes one of DMA sweeps."
            )
        if format is not None and not _PROGRAMS[found].recognises(text):
            raise InputError(f"is not {_PROGRAMS[found].name}.")
        content = stored_content(text)
        reading = Reading(modulus_unit or modulus_unit_of(content), time_unit, temperature_unit)
        solid = _PROGRAMS[found].read(text, reading, content)
        material, notes = material_of(solid, content)
        return Card(material, _PROGRAMS[found].name, (*solid.notes, *notes))
    except DataFileError:
        raise
    except InputError as error:
        raise DataFileError(path, str(error)) from None


def read_card(
    path: str | PathLike[str],
    format: CardFormat | None = None,  # noqa: A002
    *,
    modulus_unit: str | None = None,
    time_unit: str | None = None,
    temperature_unit: str | None = None,
) -> Material:
    """Read a material card; what was assumed is told by warnings (`open_card` returns it as notes instead).

    Parameters
    ----------
    path : str or path
        The file.
    format : {"abaqus", "ansys", "ls-dyna", "comsol", "comsol-branches", "csv", "json"}, optional
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
        warnings.warn(f"{path}: {note}", stacklevel=2)
    return card.material
