"""The kinds of shift law as a fit uses them: constants, starting values, values and gradients."""

from __future__ import annotations

import numpy as np

from viscofric.arguments import whole_number
from viscofric.arrays import Array
from viscofric.errors import InputError
from viscofric.rheology.shifts.laws import VFT, WLF, Arrhenius, InversePolynomial, ParametricLaw, WLFArrhenius
from viscofric.rheology.shifts.shift_law import GAS_CONSTANT, LN10
from viscofric.units import shown_celsius

#: Kinds of law as `ShiftFactors.law` takes them.
LAWS = ("wlf", "arrhenius", "vft", "wlf+arrhenius", "polynomial")
TITLES = {law.kind: law.title for law in (WLF, Arrhenius, VFT, WLFArrhenius, InversePolynomial)}
#: Beyond this the WLF law is straight over any measured range and C1 and C2 cannot be separated.
LARGEST_C2 = 1e4  # K
LARGEST_DEGREE = 4


class Family:
    """One kind of law at a reference (K), to be fitted at ascending temperatures (n,) in K."""

    #: Whether the constants are sought through their logarithms; those that are not enter linearly.
    positive = True
    size = 0
    #: What Akaike's criterion adds to `size`.
    surcharge = 0

    def __init__(self, temperatures: Array, reference: float) -> None:
        self.temperatures, self.reference = temperatures, reference
        self.range = float(temperatures[0]), float(temperatures[-1])

    def law(self, parameters: Array, covariance: Array | None = None) -> ParametricLaw:
        """Return the law; with a covariance, as one fitted on these temperatures."""
        raise NotImplementedError

    def start(self, values: Array) -> Array:
        """Return starting values of the constants from log10 α, (n,)."""
        raise NotImplementedError

    def values(self, parameters: Array) -> Array:
        """Return log10 α, (n,)."""
        return self._valid(parameters)._log10(self.temperatures)

    def gradient(self, parameters: Array) -> Array:
        """Return the derivatives of log10 α by the constants, (n, size)."""
        return self._valid(parameters)._gradient(self.temperatures)

    def _valid(self, parameters: Array) -> ParametricLaw:
        """Return the law; `InputError` where it has no value at one of the temperatures."""
        law = self.law(parameters)
        law._refuse(self.temperatures)
        return law

    def _fitted(self, covariance: Array | None) -> tuple[Array | None, tuple[float, float] | None]:
        return covariance, None if covariance is None else self.range

    def _insist_on_curvature(self, factor: float, C2: float, title: str) -> None:
        if factor > 0.0 and C2 <= 0.5 * LARGEST_C2:
            return
        low, high = map(shown_celsius, self.range)
        shape = "rise with temperature" if factor <= 0.0 else "bend too little, or the wrong way"
        raise InputError(
            f"the shift factors from {low} to {high} °C {shape}: they do not fix the constants of the "
            f"{title} law; take the measured ones, an Arrhenius law, or those of a narrower range of temperatures.",
            code="no-law",
        )


class _WLF(Family):
    size = 2

    def law(self, parameters: Array, covariance: Array | None = None) -> ParametricLaw:
        return WLF(parameters[0], parameters[1], self.reference, *self._fitted(covariance))

    def start(self, values: Array) -> Array:
        """Scan C2, which enters nonlinearly; C1 follows by plain least squares."""
        nearest = self.reference - self.range[0]
        candidates = [C2 for C2 in nearest + np.geomspace(1.0, LARGEST_C2, 80) if C2 > 0.0]
        trials = [(*_scaled(self.values(np.array([1.0, C2])), values), C2) for C2 in candidates]
        factor, _, C2 = min(trials, key=lambda trial: trial[1])
        self._insist_on_curvature(factor, C2, WLF.title)
        return np.array([factor, C2])


class _Arrhenius(Family):
    size = 1

    def law(self, parameters: Array, covariance: Array | None = None) -> ParametricLaw:
        return Arrhenius(parameters[0], self.reference, *self._fitted(covariance))

    def start(self, values: Array) -> Array:
        unit = GAS_CONSTANT * LN10
        factor, _ = _scaled(self.values(np.array([unit])), values)
        if factor <= 0.0:
            raise InputError("the shift factors rise with temperature: no Arrhenius law describes them.", code="no-law")
        return np.array([factor * unit])


class _WLFArrhenius(Family):
    size = 3
    #: The temperature where one law changes into another is no regular constant: it counts for three (Y. Ninomiya, Ann.
    #: Inst. Stat. Math. 67 (2015) 943).
    surcharge = 2

    def law(self, parameters: Array, covariance: Array | None = None) -> ParametricLaw:
        return WLFArrhenius(parameters[0], parameters[1], parameters[2], self.reference, *self._fitted(covariance))

    def start(self, values: Array) -> Array:
        """Scan C2 and Tg; C1 follows by plain least squares."""
        joined = [
            (*_scaled(self.values(np.array([1.0, C2, Tg])), values), C2, Tg)
            for Tg in 0.5 * (self.temperatures[1:] + self.temperatures[:-1])
            for C2 in np.geomspace(3.0, 1e3, 25)
        ]
        factor, _, C2, Tg = min(joined, key=lambda trial: trial[1])
        self._insist_on_curvature(factor, C2, WLFArrhenius.title)
        return np.array([factor, C2, Tg])


class _Polynomial(Family):
    positive = False

    def __init__(self, temperatures: Array, reference: float, degree: int) -> None:
        super().__init__(temperatures, reference)
        self.size = degree

    def law(self, parameters: Array, covariance: Array | None = None) -> ParametricLaw:
        return InversePolynomial(parameters, self.reference, self.range, covariance)

    def start(self, values: Array) -> Array:
        return np.ones(self.size)

    def gradient(self, parameters: Array) -> Array:
        inverse = 1.0 / self.temperatures - 1.0 / self.reference
        return np.stack([inverse**power for power in range(1, self.size + 1)], axis=-1)


def family_of(kind: str, temperatures: Array, reference: float, degree: int | None = None) -> Family:
    """Return the family of a kind of law; a polynomial needs its degree."""
    if kind == "polynomial":
        return _Polynomial(temperatures, reference, whole_number(degree, "degree", 1, LARGEST_DEGREE))
    families: dict[str, type[Family]] = {
        "wlf": _WLF, "arrhenius": _Arrhenius, "wlf+arrhenius": _WLFArrhenius,
    }  # fmt: skip
    return families[kind](temperatures, reference)


def _scaled(shape: Array, values: Array) -> tuple[float, float]:
    """Return the factor of `shape` that fits `values` best up to a constant, and the squared misfit."""
    shape, values = shape - shape.mean(), values - values.mean()
    factor = float(shape @ values / (shape @ shape))
    return factor, float(np.sum((values - factor * shape) ** 2))
