"""WLF and VFT: one curve in two sets of constants, with a pole some tens of kelvin below the glass transition."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from viscofric.errors import InputError
from viscofric.rheology.shifts.parametric_law import ParametricLaw
from viscofric.units import celsius, positive

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.units import Quantity


@dataclass(frozen=True)
class WLF(ParametricLaw):
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
    fitted_range, bounded
        See `ParametricLaw`.

    References
    ----------
    M. L. Williams, R. F. Landel, J. D. Ferry, J. Am. Chem. Soc. 77 (1955) 3701, doi:10.1021/ja01619a008.

    Examples
    --------
    >>> import viscofric as vf
    >>> law = vf.WLF(C1=17.44, C2=51.6, reference="-18 degC")
    >>> there = law.at_reference("30 degC")
    >>> round(there.C1, 3), round(there.C2, 3)
    (9.035, 99.6)
    """

    C1: float
    C2: float
    reference: float
    covariance: Array | None = field(default=None, compare=False, repr=False)
    fitted_range: tuple[float, float] | None = field(default=None, compare=False, repr=False)
    bounded: bool = field(default=True, compare=False, repr=False)

    kind: ClassVar[str] = "wlf"
    title: ClassVar[str] = "WLF"
    _constants: ClassVar[tuple[str, ...]] = ("C1", "C2")

    def __init__(
        self,
        C1: float,
        C2: Quantity,
        reference: Quantity,
        covariance: Any = None,
        fitted_range: tuple[Quantity, Quantity] | None = None,
        bounded: bool = True,
    ) -> None:
        object.__setattr__(self, "C1", positive(C1, "dimensionless", "C1"))
        object.__setattr__(self, "C2", positive(C2, "delta_degC", "C2"))
        object.__setattr__(self, "reference", positive(reference, "K", "reference"))
        self._set_fit(covariance, fitted_range, bounded)

    @property
    def pole(self) -> float:
        """Temperature Tr − C2 at which the law diverges, K."""
        return self.reference - self.C2

    @property
    def _divergence(self) -> float:  # type: ignore[override]
        return self.pole

    def _attributes(self) -> dict[str, Any]:
        errors = {}
        if self.standard_errors is not None:
            errors = {"wlf_C1_error": self.standard_errors[0], "wlf_C2_error": self.standard_errors[1]}
        return super()._attributes() | {"wlf_C1": self.C1, "wlf_C2": self.C2} | errors

    def _log10(self, kelvin: Array) -> Array:
        warmer = kelvin - self.reference
        return -self.C1 * warmer / (self.C2 + warmer)

    def _gradient(self, kelvin: Array) -> Array:
        warmer = kelvin - self.reference
        fraction = warmer / (self.C2 + warmer)
        return np.stack([-fraction, self.C1 * fraction / (self.C2 + warmer)], axis=-1)

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
        return WLF(self.C1 * self.C2 / C2, C2, kelvin, covariance, self.fitted_range, self.bounded)

    def to_vft(self) -> VFT:
        """Return the same curve as a VFT law: B = C1 C2 and T0 = Tr − C2, exactly; covariance included.

        Raises
        ------
        InputError
            If the pole Tr − C2 lies at or below absolute zero, where a VFT law cannot have it.
        """
        if self.pole <= 0.0:
            raise InputError(
                "the shift factors are too straight for a VFT law, whose pole would lie below absolute zero; use a WLF "
                "or an Arrhenius law instead."
            )
        covariance = self.covariance
        if covariance is not None:
            slope = np.array([[self.C2, self.C1], [0.0, -1.0]])
            covariance = slope @ covariance @ slope.T
        return VFT(self.C1 * self.C2, self.pole, self.reference, covariance, self.fitted_range, self.bounded)


@dataclass(frozen=True)
class VFT(ParametricLaw):
    """Vogel–Fulcher–Tammann law, log10 α = B/(T − T0) − B/(Tr − T0).

    It is the WLF law in other constants, B = C1 C2 and T0 = Tr − C2, which do not change with the reference;
    `to_wlf` and `WLF.to_vft` turn one into the other exactly.  Authors who write it with the natural logarithm
    have a B that is ln 10 times this one.

    Parameters
    ----------
    B : float or quantity
        Temperature difference above zero, K.
    T0 : float or quantity
        The pole, above zero and below the reference; K, or text such as ``"-70 degC"``.
    reference : float or quantity
        Tr, where α = 1; K, or text such as ``"30 degC"``.
    covariance : (2, 2) array, optional
        Of B and T0, where the law was fitted.
    fitted_range, bounded
        See `ParametricLaw`.

    References
    ----------
    H. Vogel, Physikalische Zeitschrift 22 (1921) 645; G. S. Fulcher, J. Am. Ceram. Soc. 8 (1925) 339,
    doi:10.1111/j.1151-2916.1925.tb16731.x; G. Tammann, W. Hesse, Z. anorg. allg. Chem. 156 (1926) 245,
    doi:10.1002/zaac.19261560121.

    Examples
    --------
    >>> import viscofric as vf
    >>> wlf = vf.WLF(C1=8.0, C2=100.0, reference=303.15)
    >>> vft = vf.VFT(B=800.0, T0=203.15, reference=303.15)  # the same curve: B = C1 C2, T0 = reference − C2
    >>> round(float(wlf.log10(333.15) - vft.log10(333.15)), 12)
    0.0
    """

    B: float
    T0: float
    reference: float
    covariance: Array | None = field(default=None, compare=False, repr=False)
    fitted_range: tuple[float, float] | None = field(default=None, compare=False, repr=False)
    bounded: bool = field(default=True, compare=False, repr=False)

    kind: ClassVar[str] = "vft"
    title: ClassVar[str] = "VFT"
    _constants: ClassVar[tuple[str, ...]] = ("B", "T0")

    def __init__(
        self,
        B: Quantity,
        T0: Quantity,
        reference: Quantity,
        covariance: Any = None,
        fitted_range: tuple[Quantity, Quantity] | None = None,
        bounded: bool = True,
    ) -> None:
        object.__setattr__(self, "B", positive(B, "delta_degC", "B"))
        object.__setattr__(self, "T0", positive(T0, "K", "T0"))
        object.__setattr__(self, "reference", positive(reference, "K", "reference"))
        if self.reference <= self.T0:
            raise InputError(
                f"T0 = {celsius(self.T0):z.1f} °C must lie below the reference, {celsius(self.reference):z.1f} °C."
            )
        self._set_fit(covariance, fitted_range, bounded)

    @property
    def _divergence(self) -> float:  # type: ignore[override]
        return self.T0

    def _log10(self, kelvin: Array) -> Array:
        return self.B * (1.0 / (kelvin - self.T0) - 1.0 / (self.reference - self.T0))

    def _gradient(self, kelvin: Array) -> Array:
        here, there = 1.0 / (kelvin - self.T0), 1.0 / (self.reference - self.T0)
        return np.stack([here - there, self.B * (here**2 - there**2)], axis=-1)

    def to_wlf(self) -> WLF:
        """Return the same curve as a WLF law: C1 = B/(Tr − T0) and C2 = Tr − T0, exactly; covariance included."""
        C2 = self.reference - self.T0
        covariance = self.covariance
        if covariance is not None:
            slope = np.array([[1.0 / C2, self.B / C2**2], [0.0, -1.0]])
            covariance = slope @ covariance @ slope.T
        return WLF(self.B / C2, C2, self.reference, covariance, self.fitted_range, self.bounded)
