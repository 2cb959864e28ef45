"""The kinds of shift law as a fit uses them: constants, starting values, values and gradients."""

from __future__ import annotations

from typing import Any

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
#: Laws whose constants are sought by themselves; VFT follows from WLF.
_FITTED: dict[str, Any] = {law.kind: law for law in (Arrhenius, WLF, WLFArrhenius)}
#: Beyond this the WLF law is straight over any measured range and C1 and C2 cannot be separated.
LARGEST_C2 = 1e4  # K
LARGEST_DEGREE = 4


class Family:
    """One kind of law at a reference (K), to be fitted at ascending temperatures (n,) in K."""

    def __init__(self, kind: str, temperatures: Array, reference: float, size: int) -> None:
        self.kind, self.temperatures, self.reference, self.size = kind, temperatures, reference, size
        self.range = float(temperatures[0]), float(temperatures[-1])
        #: Whether the constants are sought through their logarithms; those that are not enter linearly.
        self.positive = kind != "polynomial"
        #: What Akaike's criterion adds to `size`.  The temperature where one law changes into another is no regular
        #: constant: it counts for three (Y. Ninomiya, Ann. Inst. Stat. Math. 67 (2015) 943).
        self.surcharge = 2 if kind == "wlf+arrhenius" else 0

    def law(self, parameters: Array, covariance: Array | None = None) -> ParametricLaw:
        """Return the law; with a covariance, as one fitted on these temperatures."""
        if self.kind == "polynomial":
            return InversePolynomial(parameters, self.reference, self.range, covariance)
        fitted = None if covariance is None else self.range
        law: ParametricLaw = _FITTED[self.kind](*parameters, self.reference, covariance, fitted)
        return law

    def start(self, values: Array) -> Array:
        """Return starting values of the constants from log10 α, (n,): a scan, the first by plain least squares."""
        if self.kind == "polynomial":
            return np.ones(self.size)
        trials = [(*_scaled(self.values(np.array(shape)), values), shape) for shape in self._shapes()]
        factor, _, shape = min(trials, key=lambda trial: trial[1])
        if self.kind == "arrhenius" and factor <= 0.0:
            raise InputError("the shift factors rise with temperature: no Arrhenius law describes them.", code="no-law")
        if self.kind != "arrhenius":
            self._insist_on_curvature(factor, shape[1])
        return np.array([factor * shape[0], *shape[1:]])

    def _shapes(self) -> list[tuple[float, ...]]:
        """Return constants to scan, of which the first enters linearly."""
        if self.kind == "arrhenius":
            return [(GAS_CONSTANT * LN10,)]
        if self.kind == "wlf":
            nearest = self.reference - self.range[0]
            return [(1.0, C2) for C2 in nearest + np.geomspace(1.0, LARGEST_C2, 80) if C2 > 0.0]
        middles = 0.5 * (self.temperatures[1:] + self.temperatures[:-1])
        return [(1.0, C2, Tg) for Tg in middles for C2 in np.geomspace(3.0, 1e3, 25)]

    def values(self, parameters: Array) -> Array:
        """Return log10 α, (n,)."""
        return self._valid(parameters)._log10(self.temperatures)

    def gradient(self, parameters: Array) -> Array:
        """Return the derivatives of log10 α by the constants, (n, size)."""
        if self.kind == "polynomial":  # whatever the coefficients, which may be of no law
            inverse = 1.0 / self.temperatures - 1.0 / self.reference
            return np.stack([inverse**power for power in range(1, self.size + 1)], axis=-1)
        return self._valid(parameters)._gradient(self.temperatures)

    def _valid(self, parameters: Array) -> ParametricLaw:
        """Return the law; `InputError` where it has no value at one of the temperatures."""
        law = self.law(parameters)
        law._refuse(self.temperatures)
        return law

    def _insist_on_curvature(self, factor: float, C2: float) -> None:
        if factor > 0.0 and C2 <= 0.5 * LARGEST_C2:
            return
        low, high = map(shown_celsius, self.range)
        shape = "rise with temperature" if factor <= 0.0 else "bend too little, or the wrong way"
        raise InputError(
            f"the shift factors from {low} to {high} °C {shape}: they do not fix the constants of the "
            f"{TITLES[self.kind]} law; take the measured ones, an Arrhenius law, or those of a narrower range of "
            "temperatures.",
            code="no-law",
        )


def family_of(kind: str, temperatures: Array, reference: float, degree: int | None = None) -> Family:
    """Return the family of a kind of law; a polynomial needs its degree."""
    if kind == "polynomial":
        return Family(kind, temperatures, reference, whole_number(degree, "degree", 1, LARGEST_DEGREE))
    return Family(kind, temperatures, reference, len(_FITTED[kind]._constants))


def _scaled(shape: Array, values: Array) -> tuple[float, float]:
    """Return the factor of `shape` that fits `values` best up to a constant, and the squared misfit."""
    shape, values = shape - shape.mean(), values - values.mean()
    factor = float(shape @ values / (shape @ shape))
    return factor, float(np.sum((values - factor * shape) ** 2))
