"""Polynomial in the inverse temperature: describes shift factors where no law of physics does, and only there."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from math import comb
from typing import Any, ClassVar, NoReturn

import numpy as np

from viscofric.arguments import flag, numbers
from viscofric.arrays import Array
from viscofric.errors import InputError
from viscofric.rheology.shifts.parametric_law import Constant, ParametricLaw, Reach, shown_constant
from viscofric.rheology.shifts.shift_law import NOMINAL
from viscofric.units import Quantity, positive, shown_celsius


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
