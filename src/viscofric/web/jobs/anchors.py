"""What fixes the level of an identified modulus, as the page asks for it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

if TYPE_CHECKING:
    from viscofric.friction.identification.anchors import Anchor
    from viscofric.rheology.material import Material

_Text = Annotated[str, Field(max_length=100)]
#: Keys that say where the anchor was measured, and what the page calls the others.
_NAMES = {"size": "the measured size", "modulus": "the modulus"}


class AnchorOptions(BaseModel):
    """An anchor; every quantity is text with its unit.

    Attributes
    ----------
    of : str
        "modulus" that is given, that of the page's "rubber", or the size of a contact: "indentation", "contact_area"
        or "half_width".
    modulus, frequency : str, optional
        |E| at one frequency; that of the rubber is read there.
    size, speed, load : str, optional
        Of the moving contact.
    temperature : str
    error : float
        Relative standard error.
    """

    model_config = ConfigDict(extra="forbid")
    of: Literal["modulus", "rubber", "indentation", "contact_area", "half_width"]
    modulus: _Text | None = None
    frequency: _Text | None = None
    size: _Text | None = None
    speed: _Text | None = None
    load: _Text | None = None
    temperature: _Text
    error: float = Field(0.01, gt=0.0, lt=1.0)


def make_anchor(asked: AnchorOptions, rubber: Material | None, load_unit: str) -> Anchor:
    """Return the anchor that is asked for.

    Parameters
    ----------
    asked : AnchorOptions
    rubber : Material, optional
        Whose modulus is taken, if it is.
    load_unit : {"N", "N/m"}
        Of the friction curves.

    Raises
    ------
    JobError
        If a quantity is missing or cannot be used.
    """
    from viscofric.errors import InputError
    from viscofric.web.jobs.context import JobError

    try:
        return _of_modulus(asked, rubber) if asked.of in ("modulus", "rubber") else _of_contact(asked, load_unit)
    except InputError as error:
        raise JobError(f"The anchor cannot be used: {error}", "anchor") from error


def _given(asked: AnchorOptions, *names: str) -> list[str]:
    from viscofric.errors import InputError

    missing = [_NAMES.get(name, f"the {name}") for name in names if not getattr(asked, name)]
    if missing:
        raise InputError(f"{' and '.join(missing)} of the anchor is missing.")
    return [getattr(asked, name) for name in names]


def _of_modulus(asked: AnchorOptions, rubber: Material | None) -> Anchor:
    from viscofric.errors import InputError
    from viscofric.friction.identification.anchors import ModulusAnchor
    from viscofric.units import angular_frequency

    (frequency,) = _given(asked, "frequency")
    if asked.of == "modulus":
        (modulus,) = _given(asked, "modulus")
        return ModulusAnchor(modulus, frequency, asked.temperature, error=asked.error)
    if rubber is None:
        raise InputError("there is no rubber whose modulus could be taken.")
    at = angular_frequency(frequency, "frequency")
    known = abs(complex(rubber.complex_modulus(at, asked.temperature)))
    return ModulusAnchor(known, at, asked.temperature, error=asked.error)


def _of_contact(asked: AnchorOptions, load_unit: str) -> Anchor:
    from viscofric.friction.identification.anchors import ContactAnchor
    from viscofric.units import positive, to_si

    size, speed, load = _given(asked, "size", "speed", "load")
    told: dict[str, Any] = {"speed": speed, "temperature": asked.temperature, "error": asked.error}
    told["load"] = positive(load, load_unit, "load")
    unit = "m**2" if asked.of == "contact_area" else "m"
    return ContactAnchor(**{asked.of: to_si(size, unit, asked.of)}, **told)
