"""What fixes the level of the modulus, which friction alone hardly does: a modulus, or the size of a contact."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

from viscofric.errors import InputError, check_choice
from viscofric.units import Quantity, positive
from viscofric.units import angular_frequency as frequency_of

if TYPE_CHECKING:
    from viscofric.contact.solution import ContactSolution

Part: TypeAlias = Literal["magnitude", "storage", "loss"]
Size: TypeAlias = Literal["indentation", "contact_area", "half_width"]

_UNITS: dict[str, str] = {"indentation": "m", "contact_area": "m²", "half_width": "m"}


def _relative(error: float) -> float:
    value = positive(error, "dimensionless", "error of the anchor")
    if value >= 1.0:
        raise InputError(f"error of the anchor = {value:g}: must be a relative standard error below 1, such as 0.02.")
    return value


@dataclass(frozen=True)
class ModulusAnchor:
    """A modulus of the rubber measured at one frequency and temperature.

    Parameters
    ----------
    modulus : float, str or pint.Quantity
        Pa.
    angular_frequency : float, str or pint.Quantity
        rad/s if a plain number; text in hertz counts 2π each.
    temperature : float, str or pint.Quantity
        K if a plain number.
    part : {"magnitude", "storage", "loss"}
        Whether it is |E|, E' or E''.
    error : float
        Relative standard error.

    Raises
    ------
    InputError
        If a value is out of range or the part unknown.

    Examples
    --------
    >>> import viscofric as vf
    >>> anchor = vf.ModulusAnchor("8 MPa", "1 Hz", "30 degC", error=0.02)
    >>> f"{anchor.angular_frequency:.3f} rad/s"
    '6.283 rad/s'
    """

    modulus: Quantity
    angular_frequency: Quantity
    temperature: Quantity
    part: Part = "magnitude"
    error: float = 0.01

    def __post_init__(self) -> None:
        object.__setattr__(self, "modulus", positive(self.modulus, "Pa", "modulus"))
        frequency = frequency_of(self.angular_frequency, "angular_frequency")
        object.__setattr__(self, "angular_frequency", frequency)
        object.__setattr__(self, "temperature", positive(self.temperature, "K", "temperature"))
        object.__setattr__(self, "error", _relative(self.error))
        check_choice(self.part, "part", *get_args(Part))


@dataclass(frozen=True)
class ContactAnchor:
    """The size of the moving contact measured at one speed, temperature and load.

    Exactly one of the indentation, the contact area and the half width is given.

    Parameters
    ----------
    speed, temperature, load : float, str or pint.Quantity
        m/s, K and N (of a line contact N/m) if plain numbers.
    indentation : float, str or pint.Quantity, optional
        Depth of the indenter's lowest point below the undeformed surface, m.
    contact_area : float, optional
        m².
    half_width : float, str or pint.Quantity, optional
        Half the largest width of the contact across the motion, m.
    error : float
        Relative standard error.

    Raises
    ------
    InputError
        If a value is out of range, or not exactly one size is given.

    Examples
    --------
    >>> import viscofric as vf
    >>> seen = vf.ContactAnchor("20 mm/s", "60 degC", "25 N", half_width="2.4 mm", error=0.02)
    """

    speed: Quantity
    temperature: Quantity
    load: Quantity
    indentation: Quantity | None = None
    contact_area: float | None = None
    half_width: Quantity | None = None
    error: float = 0.01

    def __post_init__(self) -> None:
        given = [name for name in _UNITS if getattr(self, name) is not None]
        if len(given) != 1:
            raise InputError(
                f"a contact anchor has {' and '.join(given) or 'no size'}; give exactly one of indentation, "
                "contact_area and half_width."
            )
        for name, unit in (("speed", "m/s"), ("temperature", "K"), *((name, _UNITS[name]) for name in given)):
            object.__setattr__(self, name, positive(getattr(self, name), unit, name))
        object.__setattr__(self, "load", _force(self.load))
        object.__setattr__(self, "error", _relative(self.error))

    @property
    def size(self) -> Size:
        """Which of the sizes was measured."""
        return next(name for name in get_args(Size) if getattr(self, name) is not None)

    @property
    def value(self) -> float:
        """Its value, m or m²."""
        return float(getattr(self, self.size))

    def of(self, solution: ContactSolution) -> float:
        """Return the same size of a solved contact."""
        return float(getattr(solution, self.size))


def _force(load: Quantity) -> float:
    """Return a load, N, or N/m where it is that of a line contact."""
    try:
        return positive(load, "N/m", "load")
    except InputError:
        return positive(load, "N", "load")


#: Anything that fixes the level.
Anchor: TypeAlias = ModulusAnchor | ContactAnchor
