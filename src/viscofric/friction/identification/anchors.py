"""Anchors, which fix the magnitude of the modulus: friction alone hardly determines it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias, get_args

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.solution import ContactSolution
from viscofric.contact.steady import solve_steady
from viscofric.errors import InputError, check_choice
from viscofric.friction.identification.forward import FirstOrder
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.showing import Rows, Shown
from viscofric.units import Quantity, positive, share
from viscofric.units import angular_frequency as frequency_of

Part: TypeAlias = Literal["magnitude", "storage", "loss"]
Size: TypeAlias = Literal["indentation", "contact_area", "half_width"]

_UNITS: dict[str, str] = {"indentation": "m", "contact_area": "m²", "half_width": "m"}
#: Change of the load for the slope of a size: its error is the square of it, that of the solutions over it.
_LOAD_STEP = 0.05


@dataclass(frozen=True)
class ModulusAnchor(Shown):
    """A modulus of the rubber measured at one frequency and temperature.

    Parameters
    ----------
    modulus : float, str or pint.Quantity
        Pa.
    angular_frequency : float, str or pint.Quantity
        rad/s if a plain number; text in hertz is multiplied by 2π.
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
    >>> anchor = vf.friction.ModulusAnchor("8 MPa", "1 Hz", "30 degC", error=0.02)
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
        object.__setattr__(self, "error", share(self.error, "error of the anchor", example=0.02))
        check_choice(self.part, "part", *get_args(Part))

    def _shown(self) -> Rows:
        return (
            ("modulus", self.modulus, "Pa"),
            ("part", self.part),
            ("angular frequency", self.angular_frequency, "rad/s"),
            ("temperature", self.temperature, "°C"),
            ("relative error", self.error, "%"),
        )


@dataclass(frozen=True)
class ContactAnchor(Shown):
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
    >>> seen = vf.friction.ContactAnchor("20 mm/s", "60 degC", "25 N", half_width="2.4 mm", error=0.02)
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
                "contact_area and half_width.",
                code="give-one",
            )
        for name, unit in (("speed", "m/s"), ("temperature", "K"), *((name, _UNITS[name]) for name in given)):
            object.__setattr__(self, name, positive(getattr(self, name), unit, name))
        object.__setattr__(self, "load", _force(self.load))
        object.__setattr__(self, "error", share(self.error, "error of the anchor", example=0.02))

    def _shown(self) -> Rows:
        return (
            ("speed", self.speed, "m/s"),
            ("temperature", self.temperature, "°C"),
            ("load", self.load, "N"),
            ("indentation", self.indentation, "m"),
            ("contact area", self.contact_area, "m²"),
            ("half-width", self.half_width, "m"),
            ("relative error", self.error, "%"),
        )

    @property
    def size(self) -> Size:
        """Which of the sizes was measured."""
        return next(name for name in get_args(Size) if getattr(self, name) is not None)

    @property
    def value(self) -> float:
        """Its value, m or m²."""
        return float(getattr(self, self.size))

    def of(self, solution: ContactSolution) -> float:
        """Return the size of a solved contact that the anchor measures, m, or m² for the contact area."""
        return float(getattr(solution, self.size))


def _force(load: Quantity) -> float:
    """Return a load, N, or N/m where it is that of a line contact."""
    try:
        return positive(load, "N/m", "load")
    except InputError:
        return positive(load, "N", "load")


#: Anything that fixes the level.
Anchor: TypeAlias = ModulusAnchor | ContactAnchor


@dataclass(frozen=True, eq=False)
class SolvedContact:
    """ln of the size of a contact near a material for which it was solved.

    A half-space's contact under a rigid indenter depends on load × compliance, so that two solved loads determine the
    derivative of a size by the level of all compliances.  Its distribution over the modes is that of the contact radius
    to first order (`FirstOrder`): Hertz's contact at the contact's own frequency.  The size itself is exact for the
    solved material, so that only the step of an iteration, and the standard errors, depend on this approximation.
    """

    anchor: ContactAnchor
    first: FirstOrder
    compliances: Array
    log_alpha: float
    log_size: float
    level: float

    @classmethod
    def of(
        cls,
        anchor: ContactAnchor,
        indenter: Indenter,
        spectrum: RetardationSpectrum,
        poisson_ratio: float,
        accuracy: float,
        compliances: Array,
        log_alpha: float,
    ) -> SolvedContact:
        """Solve the contact of a material whose `compliances` are those of `spectrum`."""
        sizes = []
        for factor in (1.0, 1.0 + _LOAD_STEP, 1.0 / (1.0 + _LOAD_STEP)):
            solution = solve_steady(
                Material(spectrum, poisson_ratio=poisson_ratio),
                indenter,
                speed=float(anchor.speed) * float(np.exp(log_alpha)),
                load=float(anchor.load) * factor,
                accuracy=accuracy,
            )
            sizes.append(np.log(anchor.of(solution)))
        level = (sizes[1] - sizes[2]) / (2.0 * np.log1p(_LOAD_STEP))
        first = FirstOrder(indenter, float(anchor.load), 1.0 - poisson_ratio**2, np.array(spectrum.tau))
        return cls(anchor, first, compliances, log_alpha, float(sizes[0]), float(level))

    @property
    def temperature(self) -> float:
        """Of the anchor, K."""
        return float(self.anchor.temperature)

    def away(self, compliances: Array, _: Array, log_alpha: float) -> tuple[Array, Array, Array]:
        """Return (modelled minus measured)/error (1,), and its derivatives by the compliances and by ln α."""
        # The second argument are the retardation times, as of other observations; the closed form has them.
        log_speed = np.log(float(self.anchor.speed)) + np.array([self.log_alpha, log_alpha])
        before = self.first(self.compliances, log_speed[:1])
        now = self.first(compliances, log_speed[1:])
        by_radius = self.level / float(before.radius_change[0].sum())
        missed = self.log_size + by_radius * (now.log_radius - before.log_radius) - np.log(self.anchor.value)
        by_radius /= self.anchor.error
        return missed / self.anchor.error, by_radius * now.radius_change, by_radius * now.radius_slope
