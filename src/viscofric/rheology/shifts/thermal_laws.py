"""Arrhenius law, and WLF joined to it below the glass transition."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from viscofric.rheology.shifts.free_volume_laws import WLF
from viscofric.rheology.shifts.parametric_law import ParametricLaw
from viscofric.rheology.shifts.shift_law import GAS_CONSTANT, LN10
from viscofric.units import celsius, positive

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.units import Quantity


@dataclass(frozen=True)
class Arrhenius(ParametricLaw):
    """Arrhenius law, log10 α = Ea / (R ln 10) (1/T − 1/Tr).

    Parameters
    ----------
    activation_energy : float or quantity
        Ea above zero, J/mol (or text such as ``"120 kJ/mol"``).
    reference : float or quantity
        Tr, where α = 1; K, or text such as ``"30 degC"``.
    covariance : (1, 1) array, optional
        Of the activation energy, where the law was fitted.
    fitted_range, bounded
        See `ParametricLaw`.

    Examples
    --------
    >>> import viscofric as vf
    >>> round(float(vf.Arrhenius("100 kJ/mol", reference="30 degC").log10("60 degC")), 3)
    -1.552
    """

    activation_energy: float
    reference: float
    covariance: Array | None = field(default=None, compare=False, repr=False)
    fitted_range: tuple[float, float] | None = field(default=None, compare=False, repr=False)
    bounded: bool = field(default=True, compare=False, repr=False)

    kind: ClassVar[str] = "arrhenius"
    title: ClassVar[str] = "Arrhenius"
    _constants: ClassVar[tuple[str, ...]] = ("activation_energy",)

    def __init__(
        self,
        activation_energy: Quantity,
        reference: Quantity,
        covariance: Any = None,
        fitted_range: tuple[Quantity, Quantity] | None = None,
        bounded: bool = True,
    ) -> None:
        object.__setattr__(self, "activation_energy", positive(activation_energy, "J/mol", "activation_energy"))
        object.__setattr__(self, "reference", positive(reference, "K", "reference"))
        self._set_fit(covariance, fitted_range, bounded)

    def _log10(self, kelvin: Array) -> Array:
        return self.activation_energy / (GAS_CONSTANT * LN10) * (1.0 / kelvin - 1.0 / self.reference)

    def _gradient(self, kelvin: Array) -> Array:
        return np.stack([(1.0 / kelvin - 1.0 / self.reference) / (GAS_CONSTANT * LN10)], axis=-1)


@dataclass(frozen=True)
class WLFArrhenius(ParametricLaw):
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
    fitted_range, bounded
        See `ParametricLaw`.

    Examples
    --------
    >>> import viscofric as vf
    >>> law = vf.WLFArrhenius(C1=17.44, C2=51.6, glass_transition="-18 degC", reference="30 degC")
    >>> round(float(law.log10("-30 degC")), 2)
    12.66
    """

    C1: float
    C2: float
    glass_transition: float
    reference: float
    covariance: Array | None = field(default=None, compare=False, repr=False)
    fitted_range: tuple[float, float] | None = field(default=None, compare=False, repr=False)
    bounded: bool = field(default=True, compare=False, repr=False)

    kind: ClassVar[str] = "wlf+arrhenius"
    title: ClassVar[str] = "WLF–Arrhenius"
    _constants: ClassVar[tuple[str, ...]] = ("C1", "C2", "glass_transition")

    def __init__(
        self,
        C1: float,
        C2: Quantity,
        glass_transition: Quantity,
        reference: Quantity,
        covariance: Any = None,
        fitted_range: tuple[Quantity, Quantity] | None = None,
        bounded: bool = True,
    ) -> None:
        object.__setattr__(self, "C1", positive(C1, "dimensionless", "C1"))
        object.__setattr__(self, "C2", positive(C2, "delta_degC", "C2"))
        object.__setattr__(self, "glass_transition", positive(glass_transition, "K", "glass_transition"))
        object.__setattr__(self, "reference", positive(reference, "K", "reference"))
        self._set_fit(covariance, fitted_range, bounded)

    @property
    def activation_energy(self) -> float:
        """Of the Arrhenius law below the glass transition, J/mol."""
        return GAS_CONSTANT * LN10 * self.glass_transition**2 * self.C1 / self.C2

    @property
    def described(self) -> str:
        """The constants about Tg with their standard errors, and the reference."""
        return f"{', '.join(self._shown_constants())}; α = 1 at {celsius(self.reference):z.1f} °C"

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

    def _gradient(self, kelvin: Array) -> Array:
        return self._slopes(kelvin) - self._slopes(np.asarray(self.reference))

    def _slopes(self, kelvin: Array) -> Array:
        """Return the derivatives of the law about Tg by C1, C2 and Tg."""
        Tg = self.glass_transition
        warmer = np.maximum(kelvin - Tg, 0.0)
        fraction = warmer / (self.C2 + warmer)
        above = [-fraction, self.C1 * fraction / (self.C2 + warmer), self.C1 * self.C2 / (self.C2 + warmer) ** 2]
        ratio = Tg / np.minimum(kelvin, Tg)
        rise = Tg * (ratio - 1.0) / self.C2
        below = [rise, -self.C1 * rise / self.C2, self.C1 / self.C2 * (2.0 * ratio - 1.0)]
        return np.where(np.asarray(kelvin >= Tg)[..., None], np.stack(above, axis=-1), np.stack(below, axis=-1))
