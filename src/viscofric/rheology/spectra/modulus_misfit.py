"""The objective of every fit of a spectrum: the errors of what was measured, and their derivatives by the modes."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscofric.arrays import Array, ComplexArray, Mask
from viscofric.rheology.spectra.retardation import RetardationSpectrum

#: Modes lie between retardation times (1/ω_max) / EDGE and EDGE / ω_min.  A mode further out cannot be separated from
#: a plateau, nor from the flow of a liquid: its compliance could grow without bound.
EDGE = math.e
#: Largest stiffness of the glass.  Where the sweeps end in the middle of the transition nothing else bounds it: its
#: compliance is too small a part of the measured one.
STIFFEST = 30.0  # times the largest measured storage modulus


@dataclass(frozen=True, eq=False)
class Modes:
    """A glass compliance 1/E_inf (1/Pa), and compliances C (n,) (1/Pa) and retardation times tau (n,) (s)."""

    glass: float
    C: Array
    tau: Array


class Misfit(ABC):
    """Differences of logarithms, without unit, between modes and the m quantities measured at N rates.

    What modes make of them follows from a compliance that is linear in 1/E_inf and C: S(iω), J(t), or S(s) at complex
    s.  It has P values for N rates, and is real or complex.
    """

    #: Angular frequencies, or 1/t, ascending (N,), 1/s.
    rates: Array
    #: Size of the modulus at each rate (N,), Pa.
    sizes: Array
    #: Logarithms of what was measured, quantity by quantity (mN,).
    target: Array
    #: 1/E_inf is not below this, 1/Pa.
    least_glass: float
    #: Whether modes are fitted beside a glass of that compliance at least, or beside any, which is raised to it then.
    glass_within = False

    @property
    def ends(self) -> tuple[float, float]:
        """Logarithms of the shortest and the longest retardation time that a mode may have."""
        return self.ends_of(float(self.rates[0]), float(self.rates[-1]))

    def ends_of(self, lowest: float, highest: float) -> tuple[float, float]:
        """Return the same for other rates, 1/s."""
        edge = math.log(EDGE)
        return -math.log(highest) - edge, edge - math.log(lowest)

    def size_at(self, tau: Array) -> Array:
        """Return the size of the modulus at the rates 1/τ, Pa."""
        return np.asarray(np.interp(-np.log(tau), np.log(self.rates), self.sizes))

    def at_rates(self, low: float, high: float) -> Mask:
        """Say which of the residuals (mN,) belong to rates from one to another."""
        inside = (self.rates >= low) & (self.rates <= high)
        return np.tile(inside, len(self.target) // len(self.rates))

    def columns(self, tau: Array) -> NDArray[Any]:
        """Return the compliance of a glass and of modes, each of strength one, (P, 1 + n)."""
        relaxed = self.relaxed(tau)
        return np.concatenate([np.ones((len(relaxed), 1), dtype=relaxed.dtype), relaxed], axis=1)

    def compliance(self, spectrum: RetardationSpectrum) -> NDArray[Any]:
        """Return the compliance (P,) of a spectrum."""
        return np.asarray(self.columns(np.array(spectrum.tau)) @ np.append(1.0 / spectrum.E_inf, spectrum.C))

    def misses(self, modes: Modes) -> Array:
        """Return the residual (mN,) of modes."""
        return self.residual(self.columns(modes.tau) @ np.append(modes.glass, modes.C))

    @abstractmethod
    def relaxed(self, tau: Array) -> NDArray[Any]:
        """Return the compliance of modes of strength one, (P, n)."""

    def moved(self, relaxed: NDArray[Any], C: Array, tau: Array) -> NDArray[Any]:
        """Return the change of the compliance of modes C with ln τ, (P, n), which is that with the ln of the rate."""
        return np.asarray(relaxed * C * (relaxed - 1.0))  # of 1/(1 + sτ)

    @abstractmethod
    def residual(self, compliance: NDArray[Any]) -> Array:
        """Return logarithms measured less computed, (mN,); infinite where there is no logarithm."""

    @abstractmethod
    def jacobian(self, compliance: NDArray[Any], change: NDArray[Any]) -> Array:
        """Return the change of the computed logarithms, (mN, k), for changes of the compliance, (P, k)."""

    @abstractmethod
    def relative(self, tau: Array) -> tuple[Array, Array]:
        """Return rows (…, 1 + n) and what strengths should make of them for a start: relative errors of compliances."""


class CurveMisfit(Misfit):
    """The misfit of one master curve, which other points may replace."""

    @abstractmethod
    def of(self, rates: Array, logarithms: Array) -> CurveMisfit:
        """Return the same for other rates and natural logarithms (N, m)."""


class ModulusMisfit(CurveMisfit):
    """Differences of ln E' and ln E'' between modes and a measurement (N,), Pa, at ascending rad/s."""

    def __init__(self, angular_frequency: Array, measured: ComplexArray) -> None:
        self.rates = self.angular_frequency = angular_frequency
        self.measured = measured
        self.sizes = np.abs(measured)
        self.target = np.concatenate([np.log(measured.real), np.log(measured.imag)])
        self.least_glass = 1.0 / (STIFFEST * float(np.max(measured.real)))

    def of(self, rates: Array, logarithms: Array) -> ModulusMisfit:
        """Return the same for other angular frequencies, ln E' and ln E''."""
        moduli = np.exp(logarithms)
        return ModulusMisfit(rates, moduli[:, 0] + 1j * moduli[:, 1])

    def relaxed(self, tau: Array) -> ComplexArray:
        """Return 1/(1 + iωτ), the compliance of modes of strength one, (N, n)."""
        return np.asarray(1.0 / (1.0 + 1j * np.outer(self.angular_frequency, tau)))

    def relative(self, tau: Array) -> tuple[Array, Array]:
        """Return rows whose products with the strengths should be 1, and 0: S/S_measured, real and imaginary."""
        weighted = self.columns(tau) * self.measured[:, None]
        rows = np.concatenate([weighted.real, weighted.imag])
        return rows, np.repeat([1.0, 0.0], len(self.measured))

    def residual(self, compliance: ComplexArray) -> Array:
        """Return measured minus computed ln E' and ln E'', (2N,); infinite where a modulus is not above zero."""
        modulus = 1.0 / compliance
        if not np.all((modulus.imag > 0.0) & (modulus.real > 0.0)):  # no mode at all
            return np.full(len(self.target), np.inf)
        return np.asarray(self.target - np.concatenate([np.log(modulus.real), np.log(modulus.imag)]))

    def jacobian(self, compliance: ComplexArray, change: ComplexArray) -> Array:
        """Return the change of ln E' and ln E'', (2N, m), for changes of the compliance, (N, m)."""
        modulus = 1.0 / compliance
        moved = -(modulus**2)[:, None] * change
        return np.concatenate([moved.real / modulus.real[:, None], moved.imag / modulus.imag[:, None]])
