"""Shift laws: how the time scale of a material depends on temperature.

WLF and VFT are one curve in two sets of constants, with a pole some tens of kelvin below the glass transition.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from math import comb
from typing import Any, ClassVar, NoReturn

import numpy as np

from viscofric.arguments import flag, numbers
from viscofric.arrays import Array
from viscofric.errors import InputError, wrong_argument
from viscofric.notes import Remedy
from viscofric.rheology.shifts.parametric_law import Constant, ParametricLaw, Reach, shown_constant
from viscofric.rheology.shifts.shift_law import GAS_CONSTANT, LN10, NOMINAL, ShiftLaw
from viscofric.units import CELSIUS_ZERO, Quantity, kelvin_hint, positive, shown_celsius

__all__ = [
    "GAS_CONSTANT",
    "LN10",
    "VFT",
    "WLF",
    "Arrhenius",
    "InversePolynomial",
    "OneTemperature",
    "ParametricLaw",
    "ShiftLaw",
    "WLFArrhenius",
]


@dataclass(frozen=True)
class WLF(ParametricLaw):
    """Williams–Landel–Ferry law, log10 α = −C1 (T − Tr) / (C2 + T − Tr).

    Parameters
    ----------
    C1 : float
        Above zero.
    C2 : float or quantity
        Temperature difference above zero, K (or text such as ``"51.6 K"``).
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

    kind: ClassVar[str] = "wlf"
    title: ClassVar[str] = "WLF"
    _constants: ClassVar[dict[str, Constant]] = {"C1": Constant("C1"), "C2": Constant("C2", "delta_degC", "K")}

    def __init__(
        self,
        C1: float,
        C2: Quantity,
        reference: Quantity,
        covariance: Any = None,
        fitted_range: tuple[Quantity, Quantity] | None = None,
        bounded: bool = True,
    ) -> None:
        self._set((C1, C2), reference, covariance, fitted_range, bounded)

    @property
    def pole(self) -> float:
        """Temperature Tr − C2 at which the law diverges, K."""
        return self.reference - self.C2

    @property
    def _divergence(self) -> float:
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

    def _about(self, kelvin: float) -> WLF:
        # C1 C2 and Tr − C2 are invariant (J. D. Ferry).
        warmer = kelvin - self.reference
        C2 = self.C2 + warmer
        covariance = self._transformed([[self.C2 / C2, self.C1 * warmer / C2**2], [0.0, 1.0]])
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
                "or an Arrhenius law instead.",
                code="no-law",
            )
        covariance = self._transformed([[self.C2, self.C1], [0.0, -1.0]])
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

    kind: ClassVar[str] = "vft"
    title: ClassVar[str] = "VFT"
    _constants: ClassVar[dict[str, Constant]] = {
        "B": Constant("B", "delta_degC", "K"),
        "T0": Constant("T0", "K", "°C", offset=-CELSIUS_ZERO),
    }

    def __init__(
        self,
        B: Quantity,
        T0: Quantity,
        reference: Quantity,
        covariance: Any = None,
        fitted_range: tuple[Quantity, Quantity] | None = None,
        bounded: bool = True,
    ) -> None:
        self._set((B, T0), reference, covariance, fitted_range, bounded)
        if self.reference <= self.T0:
            raise InputError(
                f"T0 = {shown_celsius(self.T0)} °C must lie below the reference, {shown_celsius(self.reference)} °C.",
                code="below-pole",
            )

    @property
    def _divergence(self) -> float:
        return self.T0

    def _log10(self, kelvin: Array) -> Array:
        return self.B * (1.0 / (kelvin - self.T0) - 1.0 / (self.reference - self.T0))

    def _gradient(self, kelvin: Array) -> Array:
        here, there = 1.0 / (kelvin - self.T0), 1.0 / (self.reference - self.T0)
        return np.stack([here - there, self.B * (here**2 - there**2)], axis=-1)

    def to_wlf(self) -> WLF:
        """Return the same curve as a WLF law: C1 = B/(Tr − T0) and C2 = Tr − T0, exactly; covariance included."""
        C2 = self.reference - self.T0
        covariance = self._transformed([[1.0 / C2, self.B / C2**2], [0.0, -1.0]])
        return WLF(self.B / C2, C2, self.reference, covariance, self.fitted_range, self.bounded)


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
    rivals : (m, 3) array, optional
        WLF laws that the factors of a fit do not exclude: weight, and B and T0 of `VFT`, K.  Standard errors include
        the distance from them.

    Examples
    --------
    >>> import viscofric as vf
    >>> round(float(vf.Arrhenius("100 kJ/mol", reference="30 degC").log10("60 degC")), 3)
    -1.552
    """

    activation_energy: float
    reference: float
    rivals: Array | None = field(default=None, kw_only=True, compare=False, repr=False)

    kind: ClassVar[str] = "arrhenius"
    title: ClassVar[str] = "Arrhenius"
    _constants: ClassVar[dict[str, Constant]] = {"activation_energy": Constant("Ea", "J/mol", "kJ/mol", factor=1e-3)}

    def __init__(
        self,
        activation_energy: Quantity,
        reference: Quantity,
        covariance: Any = None,
        fitted_range: tuple[Quantity, Quantity] | None = None,
        bounded: bool = True,
        rivals: Any = None,
    ) -> None:
        self._set((activation_energy,), reference, covariance, fitted_range, bounded)
        if rivals is not None:
            rivals = np.array(numbers(rivals, "rivals"))
            if rivals.ndim != 2 or rivals.shape[1] != 3 or np.any(rivals < 0.0):
                raise wrong_argument("rivals", rivals, "must be rows of a weight, B and T0.", "wrong-shape")
            rivals.flags.writeable = False
        # Without a covariance nothing is said of errors.
        object.__setattr__(self, "rivals", None if covariance is None else rivals)

    def _log10(self, kelvin: Array) -> Array:
        return self.activation_energy / (GAS_CONSTANT * LN10) * (1.0 / kelvin - 1.0 / self.reference)

    def _gradient(self, kelvin: Array) -> Array:
        return np.stack([(1.0 / kelvin - 1.0 / self.reference) / (GAS_CONSTANT * LN10)], axis=-1)

    def _departures(self, kelvin: Array) -> Array:
        if self.rivals is None:
            return super()._departures(kelvin)
        weight, B, T0 = self.rivals.T
        # Near a pole and below it a law is as far off as it likes: the distance is no less than a kelvin.
        here, there = (np.maximum(np.asarray(one)[..., None] - T0, 1.0) for one in (kelvin, self.reference))
        return np.asarray(np.sqrt(weight) * (B * (1.0 / here - 1.0 / there) - self._log10(kelvin)[..., None]))


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

    kind: ClassVar[str] = "wlf+arrhenius"
    title: ClassVar[str] = "WLF–Arrhenius"
    _constants: ClassVar[dict[str, Constant]] = {
        "C1": Constant("C1"),
        "C2": Constant("C2", "delta_degC", "K"),
        "glass_transition": Constant("Tg", "K", "°C", offset=-CELSIUS_ZERO),
    }

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
        self._set((C1, C2, glass_transition), reference, covariance, fitted_range, bounded)

    @property
    def activation_energy(self) -> float:
        """Of the Arrhenius law below the glass transition, J/mol."""
        return GAS_CONSTANT * LN10 * self.glass_transition**2 * self.C1 / self.C2

    @property
    def described(self) -> str:
        """The constants about Tg with their standard errors, and the reference."""
        return f"{', '.join(self._shown_constants())}; α = 1 at {shown_celsius(self.reference)} °C"

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


@dataclass(frozen=True)
class InversePolynomial(ParametricLaw):
    """Polynomial, log10 α = Σ c_k (1/T − 1/Tr)^k with k from 1 to the degree.

    It describes measured shift factors without saying why, and has no meaning outside its temperatures: more than half
    a kelvin beyond them (nominal against measured temperature) it is refused, without exception.  Within
    them it must fall as T rises.  Degree 1 is the Arrhenius law.

    Parameters
    ----------
    coefficients : sequence of float
        c_1, c_2 …, K, K² …
    reference : float or quantity
        Tr, where α = 1, within the range; K, or text such as ``"30 degC"``.
    fitted_range : (lowest, highest)
        It cannot do without: the temperatures that it holds for; K, or text.
    covariance : (n, n) array, optional
        Of the coefficients, where the law was fitted.
    bounded : bool
        As of other laws, but nothing else than True.

    Raises
    ------
    InputError
        If the law rises with temperature somewhere in its range, the reference lies outside, or the range is
        missing.

    Examples
    --------
    >>> import viscofric as vf
    >>> law = vf.InversePolynomial([5000.0, 1e6], "30 degC", fitted_range=("0 degC", "90 degC"))
    >>> round(float(law.log10("60 degC")), 3)
    -1.397
    """

    coefficients: tuple[float, ...]
    reference: float
    fitted_range: tuple[float, float] = field(kw_only=True)

    kind: ClassVar[str] = "polynomial"
    title: ClassVar[str] = "polynomial"
    _constants: ClassVar[dict[str, Constant]] = {"coefficients": Constant("c")}

    def __init__(
        self,
        coefficients: Iterable[float],
        reference: Quantity,
        fitted_range: tuple[Quantity, Quantity] | None,
        covariance: Any = None,
        bounded: bool = True,
    ) -> None:
        factors = tuple(np.ravel(numbers(coefficients, "coefficients")).tolist())
        if not factors:
            raise InputError("coefficients of a polynomial law: there must be at least one.", code="empty-list")
        if fitted_range is None or not flag(bounded, "bounded"):
            self._refuse_to_extrapolate()
        object.__setattr__(self, "coefficients", factors)
        object.__setattr__(self, "reference", positive(reference, "K", "reference"))
        self._set_fit(covariance, fitted_range, True)
        self._refuse(np.array([self.reference]))
        ends = 1.0 / np.array(self.fitted_range)[::-1] - 1.0 / self.reference
        if not _rises(self.parameters, float(ends[0]), float(ends[1])):
            low, high = map(shown_celsius, self.fitted_range)
            raise InputError(
                f"the polynomial of degree {self.degree} rises with temperature somewhere between {low} and "
                f"{high} °C, which no shift factor does; take a lower degree, or another law.",
                code="law-rises",
            )

    @property
    def degree(self) -> int:
        """Highest power of 1/T − 1/Tr."""
        return len(self.coefficients)

    @property
    def parameters(self) -> Array:
        """The coefficients, in the order of `covariance`."""
        return np.array(self.coefficients)

    def with_parameters(self, parameters: Any) -> InversePolynomial:
        """Return a polynomial with other coefficients, with the same reference and range.

        Parameters
        ----------
        parameters : (degree,) array
            Coefficients c_k, as of the class.

        Raises
        ------
        InputError
            If log10 α does not fall with temperature over the range.
        """
        return InversePolynomial(parameters, self.reference, self.fitted_range)

    def _about(self, kelvin: float) -> InversePolynomial:
        moved = _moved(self.degree, 1.0 / kelvin - 1.0 / self.reference)
        covariance = None if self.covariance is None else moved @ self.covariance @ moved.T
        return InversePolynomial(moved @ self.parameters, kelvin, self.fitted_range, covariance)

    def unbounded(self) -> NoReturn:
        """Raise `InputError`: a polynomial is not valid beyond its data."""
        self._refuse_to_extrapolate()

    @staticmethod
    def _refuse_to_extrapolate() -> NoReturn:
        raise InputError(
            "a polynomial law is valid only between the temperatures that it was fitted on: it needs their range "
            "(fitted_range) and cannot be without bounds; take a WLF or an Arrhenius law to extrapolate.",
            code="polynomial-without-range",
        )

    def _shown_constants(self) -> list[str]:
        errors = self.standard_errors or (0.0,) * self.degree
        units = ("K", *(f"K^{power}" for power in range(2, self.degree + 1)))
        rows = enumerate(zip(self.coefficients, errors, units, strict=True), start=1)
        return [shown_constant(Constant(f"c{power}", shown=unit), c, error) for power, (c, error, unit) in rows]

    def _log10(self, kelvin: Array) -> Array:
        return self._gradient(kelvin) @ self.parameters

    def _gradient(self, kelvin: Array) -> Array:
        inverse = 1.0 / np.asarray(kelvin) - 1.0 / self.reference
        return np.stack([inverse**power for power in range(1, self.degree + 1)], axis=-1)

    def _cold(self) -> Reach:
        return Reach(self.fitted_range[0] - NOMINAL, "a polynomial is not valid beyond its data")

    def _hot(self) -> Reach:
        return Reach(self.fitted_range[1] + NOMINAL, "a polynomial is not valid beyond its data")

    def _remedy(self) -> str:
        return "measure isotherms there, or take a WLF or an Arrhenius law to extrapolate"


def _moved(degree: int, step: float) -> Array:
    """Return the matrix from coefficients in x to those in x − step, without the constant: (y + step)^k expanded."""
    matrix = np.zeros((degree, degree))
    for old in range(1, degree + 1):
        for new in range(1, old + 1):
            matrix[new - 1, old - 1] = comb(old, new) * step ** (old - new)
    return matrix


def _rises(coefficients: Array, low: float, high: float) -> bool:
    """Return whether Σ c_k x^k rises from `low` to `high` throughout: the derivative has no zero there."""
    scale = max(abs(low), abs(high))  # roots of a polynomial in a variable of order one
    slope = np.arange(1, len(coefficients) + 1) * coefficients * scale ** np.arange(len(coefficients))
    at_ends = [float(np.polyval(slope[::-1], end / scale)) for end in (low, high)]
    if min(at_ends) <= 0.0:
        return False
    roots = np.roots(slope[::-1])
    real = roots[np.abs(roots.imag) < 1e-9].real * scale
    return not bool(np.any((real > low) & (real < high)))


@dataclass(frozen=True)
class OneTemperature(ShiftLaw):
    """The shift of a material that is known at one temperature: α = 1 there, and no value more than half a kelvin away.

    Parameters
    ----------
    reference : float or quantity
        The temperature; K, or text such as ``"30 degC"``.

    Examples
    --------
    >>> import viscofric as vf
    >>> spectrum = vf.RetardationSpectrum(E0="1 MPa", E_inf="10 MPa", C=[9e-7], tau=[1e-3])
    >>> rubber = vf.Material(spectrum, shift=vf.rheology.OneTemperature("23 degC"))
    >>> rubber.shift.valid_at(["23 degC", "40 degC"])
    array([ True, False])
    """

    reference: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "reference", positive(self.reference, "K", "reference"))

    def _refuse(self, kelvin: Array) -> None:
        away = np.abs(kelvin - self.reference) > NOMINAL
        if np.any(away):
            wanted = float(kelvin[away][0])
            raise InputError(
                f"temperature = {shown_celsius(wanted)} °C: the material has no shift factors, and is known at "
                f"{shown_celsius(self.reference)} °C only",
                code="outside-measured",
                remedy=Remedy(
                    "; use this temperature, or give Material a shift, such as WLF(…)",
                    "; use this temperature, or give shift factors (material fit --shift-factors)",
                    "; use this temperature, or give shift_factors under [material]",
                    "; use this temperature, or add a file of shift factors",
                    field="conditions.temperature",
                )
                + kelvin_hint(wanted),
            )

    def _log10(self, kelvin: Array) -> Array:
        return np.zeros(np.shape(kelvin))

    def _standard_error(self, kelvin: Array) -> Array:
        return np.zeros(np.shape(kelvin))
