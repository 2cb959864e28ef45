"""Shift laws: how the time scale of a rubber depends on temperature (WLF, Arrhenius, and the two joined)."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Self, TypeAlias, overload

import numpy as np

from viscofric.errors import InputError
from viscofric.units import celsius, kelvin_hint, positive, to_si

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.units import Quantity

    Array = NDArray[np.float64]
    #: One temperature, or many: plain numbers in kelvin, or text with a unit.
    Temperatures: TypeAlias = "Array | list[float] | list[str] | tuple[float, ...] | tuple[str, ...]"

GAS_CONSTANT = 8.31446261815324  # J/(mol K)
LN10 = math.log(10.0)


class ShiftLaw(ABC):
    """Shift factor α(T), 1 at the reference, such that E(ω, T) = E(α(T) ω, reference); it falls as T rises.

    Subclasses say what log10 α is; units, shapes and checks are dealt with here.
    """

    reference: float  # K

    @abstractmethod
    def _log10(self, kelvin: Array) -> Array:
        """Return log10 α at temperatures that `_refuse` let pass."""

    def _refuse(self, kelvin: Array) -> None:  # noqa: B027 (most laws hold everywhere)
        """Raise `InputError` where the law has no meaning."""

    @abstractmethod
    def at_reference(self, reference: Quantity) -> Self:
        """Return the same law with α = 1 at another temperature."""

    @overload
    def log10(self, temperature: Quantity) -> float: ...
    @overload
    def log10(self, temperature: Temperatures) -> Array: ...
    def log10(self, temperature: Any) -> Any:
        """Return log10 α(T).

        Parameters
        ----------
        temperature : float, str, quantity, or an array or list of them
            Plain numbers are in K.

        Returns
        -------
        float or array
            In the shape of `temperature`.

        Raises
        ------
        InputError
            If a temperature is not above absolute zero, or one where the law has no meaning.
        """
        kelvin = _kelvin(temperature)
        self._refuse(np.atleast_1d(kelvin))
        values = self._log10(kelvin)
        return float(values) if np.ndim(values) == 0 else values

    @overload
    def __call__(self, temperature: Quantity) -> float: ...
    @overload
    def __call__(self, temperature: Temperatures) -> Array: ...
    def __call__(self, temperature: Any) -> Any:
        """Return α(T); see `log10`."""
        return 10.0 ** self.log10(temperature)


def _kelvin(temperature: Any) -> Array:
    if isinstance(temperature, (list, tuple)) or (isinstance(temperature, np.ndarray) and temperature.ndim):
        kelvin = np.array([to_si(value, "K", "temperature") for value in np.ravel(np.asarray(temperature))])
        kelvin = kelvin.reshape(np.shape(temperature))
    else:
        kelvin = np.asarray(to_si(temperature, "K", "temperature"))
    if np.any(kelvin <= 0.0):
        raise InputError(f"temperature = {float(kelvin.min()):g} K: must be above absolute zero.")
    return kelvin


def _covariance(values: Any, size: int) -> Array | None:
    if values is None:
        return None
    covariance = np.array(values, dtype=float)
    if covariance.shape != (size, size) or not np.all(np.isfinite(covariance)):
        raise InputError(f"covariance of a shift law must be {size} × {size} finite numbers.")
    covariance.flags.writeable = False
    return covariance


@dataclass(frozen=True)
class WLF(ShiftLaw):
    """Williams–Landel–Ferry law, log10 α = −C1 (T − Tr) / (C2 + T − Tr).

    Parameters
    ----------
    C1 : float
        Above zero.
    C2 : float or quantity
        Temperature difference above zero, K (or text such as ``"51.6 delta_degC"``).
    reference : float or quantity
        Tr, where α = 1; K, or text such as ``"30 degC"``.
    covariance : (2, 2) array, optional
        Of C1 and C2, where the law was fitted.

    References
    ----------
    M. L. Williams, R. F. Landel, J. D. Ferry, J. Am. Chem. Soc. 77 (1955) 3701.
    """

    C1: float
    C2: float
    reference: float
    covariance: Array | None = field(default=None, compare=False, repr=False)

    def __init__(self, C1: float, C2: Quantity, reference: Quantity, covariance: Any = None) -> None:
        object.__setattr__(self, "C1", positive(C1, "dimensionless", "C1"))
        object.__setattr__(self, "C2", positive(C2, "delta_degC", "C2"))
        object.__setattr__(self, "reference", positive(reference, "K", "reference"))
        object.__setattr__(self, "covariance", _covariance(covariance, 2))

    @property
    def standard_errors(self) -> tuple[float, float] | None:
        """Standard errors of C1 and of C2 (K), or None where the law was not fitted."""
        if self.covariance is None:
            return None
        first, second = np.sqrt(np.diag(self.covariance))
        return float(first), float(second)

    @property
    def pole(self) -> float:
        """Temperature Tr − C2 at which the law diverges, K."""
        return self.reference - self.C2

    def _refuse(self, kelvin: Array) -> None:
        if np.any(kelvin <= self.pole):
            coldest = float(kelvin.min())
            raise InputError(
                f"temperature = {celsius(coldest):z.1f} °C: the WLF law diverges at "
                f"{celsius(self.pole):z.1f} °C (reference − C2) and holds above it only{kelvin_hint(coldest)}."
            )

    def _log10(self, kelvin: Array) -> Array:
        warmer = kelvin - self.reference
        return -self.C1 * warmer / (self.C2 + warmer)

    def at_reference(self, reference: Quantity) -> WLF:
        """Return the same law about another reference: C1 C2 and Tr − C2 stay what they are (J. D. Ferry)."""
        kelvin = positive(reference, "K", "reference")
        self._refuse(np.array([kelvin]))
        warmer = kelvin - self.reference
        C2 = self.C2 + warmer
        covariance = self.covariance
        if covariance is not None:
            slope = np.array([[self.C2 / C2, self.C1 * warmer / C2**2], [0.0, 1.0]])
            covariance = slope @ covariance @ slope.T
        return WLF(self.C1 * self.C2 / C2, C2, kelvin, covariance)


@dataclass(frozen=True)
class Arrhenius(ShiftLaw):
    """Arrhenius law, log10 α = Ea / (R ln 10) (1/T − 1/Tr).

    Parameters
    ----------
    activation_energy : float or quantity
        Ea above zero, J/mol (or text such as ``"120 kJ/mol"``).
    reference : float or quantity
        Tr, where α = 1; K, or text such as ``"30 degC"``.
    covariance : (1, 1) array, optional
        Of the activation energy, where the law was fitted.
    """

    activation_energy: float
    reference: float
    covariance: Array | None = field(default=None, compare=False, repr=False)

    def __init__(self, activation_energy: Quantity, reference: Quantity, covariance: Any = None) -> None:
        object.__setattr__(self, "activation_energy", positive(activation_energy, "J/mol", "activation_energy"))
        object.__setattr__(self, "reference", positive(reference, "K", "reference"))
        object.__setattr__(self, "covariance", _covariance(covariance, 1))

    @property
    def standard_error(self) -> float | None:
        """Standard error of the activation energy, J/mol, or None where the law was not fitted."""
        return None if self.covariance is None else float(np.sqrt(self.covariance[0, 0]))

    def _log10(self, kelvin: Array) -> Array:
        return self.activation_energy / (GAS_CONSTANT * LN10) * (1.0 / kelvin - 1.0 / self.reference)

    def at_reference(self, reference: Quantity) -> Arrhenius:
        """Return the same law with α = 1 at another temperature; the activation energy stays."""
        return Arrhenius(self.activation_energy, reference, self.covariance)


@dataclass(frozen=True)
class WLFArrhenius(ShiftLaw):
    """WLF law above the glass transition, Arrhenius law below it, with the same slope at it.

    About Tg, log10 α = −C1 (T − Tg) / (C2 + T − Tg) above, and Ea / (R ln 10) (1/T − 1/Tg) below with
    Ea = R ln 10 Tg² C1 / C2, all less the value at the reference.

    Parameters
    ----------
    C1, C2 : float
        WLF constants **about the glass transition** (not about the reference); C2 in K.
    glass_transition : float or quantity
        Tg; K, or text such as ``"-18 degC"``.
    reference : float or quantity
        Temperature where α = 1, on either side of Tg.
    covariance : (3, 3) array, optional
        Of C1, C2 and Tg, where the law was fitted.
    """

    C1: float
    C2: float
    glass_transition: float
    reference: float
    covariance: Array | None = field(default=None, compare=False, repr=False)

    def __init__(
        self, C1: float, C2: Quantity, glass_transition: Quantity, reference: Quantity, covariance: Any = None
    ) -> None:
        object.__setattr__(self, "C1", positive(C1, "dimensionless", "C1"))
        object.__setattr__(self, "C2", positive(C2, "delta_degC", "C2"))
        object.__setattr__(self, "glass_transition", positive(glass_transition, "K", "glass_transition"))
        object.__setattr__(self, "reference", positive(reference, "K", "reference"))
        object.__setattr__(self, "covariance", _covariance(covariance, 3))

    @property
    def activation_energy(self) -> float:
        """Of the Arrhenius law below the glass transition, J/mol."""
        return GAS_CONSTANT * LN10 * self.glass_transition**2 * self.C1 / self.C2

    @property
    def above(self) -> WLF:
        """The WLF branch about the glass transition."""
        return WLF(self.C1, self.C2, self.glass_transition)

    def _about_glass_transition(self, kelvin: Array) -> Array:
        warmer = np.maximum(kelvin - self.glass_transition, 0.0)
        colder = np.minimum(kelvin, self.glass_transition)
        slope = self.C1 / self.C2 * self.glass_transition**2
        return -self.C1 * warmer / (self.C2 + warmer) + slope * (1.0 / colder - 1.0 / self.glass_transition)

    def _log10(self, kelvin: Array) -> Array:
        return self._about_glass_transition(kelvin) - self._about_glass_transition(np.asarray(self.reference))

    def at_reference(self, reference: Quantity) -> WLFArrhenius:
        """Return the same law with α = 1 at another temperature."""
        return replace(self, reference=positive(reference, "K", "reference"))
