"""What every fit of a spectrum minimises: the errors of ln E' and ln E'', of ln J(t) or of ln E(t), by the modes.

J(t) = 1/E_inf + Σ C (1 − exp(−t/τ)) is linear in the strengths.  E(t) follows from the same strengths by
interconversion: its Laplace transform is 1/(s S(s)), with S(s) = 1/E_inf + Σ C/(1 + sτ), and is inverted along a
contour s = z/t around the negative real axis,

    E(t) = Re Σ_k c_k / S(z_k/t),    z(θ) = N (0.5017 θ cot(0.6407 θ) − 0.6122 + 0.2645 i θ),

with N nodes in conjugate pairs.  The error falls as 3.89^−N: 1e-8 of E(t) with 14 nodes (J. A. C. Weideman, SIAM J.
Numer. Anal. 44 (2006) 2342, doi:10.1137/050625837; A. Talbot, J. Inst. Math. Appl. 23 (1979) 97).
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from viscofric.arrays import Array, ComplexArray, Mask
from viscofric.data import MasterCurve
from viscofric.rheology.spectra.quality import gaps_between
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.step_tests import StepMasterCurve

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
    #: Times and columns that were asked for last: a fit begins, goes on and is judged at the same times.
    _last: tuple[Array, NDArray[Any]] = np.array([np.nan]), np.empty(0)

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
        if not np.array_equal(self._last[0], tau):
            relaxed = self.relaxed(tau)
            columns = np.concatenate([np.ones((len(relaxed), 1), dtype=relaxed.dtype), relaxed], axis=1)
            columns.setflags(write=False)
            self._last = tau.copy(), columns
        return self._last[1]

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
        if not np.all((compliance.imag < 0.0) & (compliance.real > 0.0)):  # no mode at all
            return np.full(len(self.target), np.inf)
        modulus = 1.0 / compliance
        return np.asarray(self.target - np.concatenate([np.log(modulus.real), np.log(modulus.imag)]))

    def jacobian(self, compliance: ComplexArray, change: ComplexArray) -> Array:
        """Return the change of ln E' and ln E'', (2N, m), for changes of the compliance, (N, m)."""
        modulus = 1.0 / compliance
        moved = -(modulus**2)[:, None] * change
        return np.concatenate([moved.real / modulus.real[:, None], moved.imag / modulus.imag[:, None]])


#: Step responses from a time t on determine E(ω) up to this part of 1/t.  Relaxations faster than t have ended in E(t),
#: but not in E''(ω) below 1/t, and towards the glass they are the strongest; in J(t) they are the weakest.
REACH = {"creep": 0.1, "relaxation": 0.01}
#: E(t) falls steeply from a glass that was not measured; retardation times down to so many times less describe that.
#: Without them planted E'' was missed three times as far near the shortest times.
FASTER = 10.0
#: Nodes of the contour, in conjugate pairs.
NODES = 14


class StepMisfit(CurveMisfit):
    """Differences between modes and a step response; `rates` (N,) 1/t ascend, `moduli` (N,) are 1/J or E in Pa."""

    glass_within = True

    def __init__(self, rates: Array, moduli: Array) -> None:
        self.rates = rates
        self.sizes = moduli
        self.target = np.log(moduli)
        self.least_glass = 1.0 / (STIFFEST * float(np.max(moduli)))

    def of(self, rates: Array, logarithms: Array) -> Self:
        """Return the same for other rates and logarithms of the moduli (N, 1)."""
        return type(self)(rates, np.exp(logarithms[:, 0]))


class CreepMisfit(StepMisfit):
    """Differences of −ln J between modes and a creep compliance."""

    def relaxed(self, tau: Array) -> Array:
        """Return 1 − exp(−t/τ), (N, n)."""
        return np.asarray(-np.expm1(-1.0 / np.outer(self.rates, tau)))

    def moved(self, relaxed: NDArray[Any], C: Array, tau: Array) -> Array:
        """Return the change of the compliance of modes with ln τ, (N, n)."""
        ratio = 1.0 / np.outer(self.rates, tau)
        return np.asarray(-C * ratio * np.exp(-ratio))

    def residual(self, compliance: NDArray[Any]) -> Array:
        """Return −ln J measured less computed, (N,)."""
        if not np.all(compliance > 0.0):
            return np.full(len(self.target), np.inf)
        return np.asarray(self.target + np.log(compliance))

    def jacobian(self, compliance: NDArray[Any], change: NDArray[Any]) -> Array:
        """Return the change of −ln J, (N, k)."""
        return np.asarray(-change / compliance[:, None])

    def relative(self, tau: Array) -> tuple[Array, Array]:
        """Return rows whose products with the strengths should be 1: J/J_measured."""
        return self.columns(tau) * self.sizes[:, None], np.ones(len(self.rates))


class RelaxationMisfit(StepMisfit):
    """Differences of ln E(t) between modes and a relaxation modulus."""

    def __init__(self, rates: Array, moduli: Array) -> None:
        super().__init__(rates, moduli)
        self._nodes, self._weights = contour()

    def ends_of(self, lowest: float, highest: float) -> tuple[float, float]:
        """Return the ends of the retardation times, from `FASTER` times below those that creep would show."""
        fastest, slowest = super().ends_of(lowest, highest)
        return fastest - float(np.log(FASTER)), slowest

    def relaxed(self, tau: Array) -> ComplexArray:
        """Return 1/(1 + sτ) at all nodes s of all times, (N NODES/2, n)."""
        found = np.outer(np.outer(self.rates, self._nodes).ravel(), tau)
        found += 1.0
        return np.asarray(np.divide(1.0, found, out=found))

    def residual(self, compliance: NDArray[Any]) -> Array:
        """Return ln E measured less computed, (N,)."""
        modulus = self._modulus(compliance)
        if not np.all(modulus > 0.0):
            return np.full(len(self.target), np.inf)
        return np.asarray(self.target - np.log(modulus))

    def jacobian(self, compliance: NDArray[Any], change: NDArray[Any]) -> Array:
        """Return the change of ln E, (N, k)."""
        moved = (np.tile(self._weights, len(self.rates)) / compliance**2)[:, None] * change
        summed = moved.real.reshape(len(self.rates), len(self._nodes), -1).sum(axis=1)
        return np.asarray(-summed / self._modulus(compliance)[:, None])

    def relative(self, tau: Array) -> tuple[Array, Array]:
        """Return rows whose products with the strengths should be 1, were E(t) J(t) = 1, which is near for a start."""
        return CreepMisfit(self.rates, self.sizes).relative(tau)

    def _modulus(self, compliance: NDArray[Any]) -> Array:
        return np.asarray((self._weights / compliance.reshape(len(self.rates), -1)).real.sum(axis=1))


class JointMisfit(Misfit):
    """Misfits of several kinds of tests; the level of a `free` one is that which suits the modes best."""

    def __init__(self, parts: Sequence[Misfit], free: Sequence[bool]) -> None:
        self.parts, self.free = parts, free
        rates = np.concatenate([part.rates for part in parts])
        order = np.argsort(rates, kind="stable")
        self.rates = rates[order]
        self.sizes = np.concatenate([part.sizes for part in parts])[order]
        self.target = np.concatenate([part.target for part in parts])
        self.least_glass = min(part.least_glass for part in parts)
        self.glass_within = True

    def ends_of(self, lowest: float, highest: float) -> tuple[float, float]:
        """Return the ends of the retardation times that any of the kinds allows."""
        ends = [part.ends_of(lowest, highest) for part in self.parts]
        return min(low for low, _ in ends), max(high for _, high in ends)

    def at_rates(self, low: float, high: float) -> Mask:
        """Say which of the residuals belong to rates from one to another."""
        return np.concatenate([part.at_rates(low, high) for part in self.parts])

    def relaxed(self, tau: Array) -> NDArray[Any]:
        """Return the compliance of modes of strength one, kind by kind."""
        return np.concatenate([part.relaxed(tau) for part in self.parts])

    def moved(self, relaxed: NDArray[Any], C: Array, tau: Array) -> NDArray[Any]:
        """Return the change of the compliance of modes with ln τ, kind by kind."""
        pieces = zip(self.parts, self._split(relaxed, tau), strict=True)
        return np.concatenate([part.moved(piece, C, tau) for part, piece in pieces])

    def residual(self, compliance: NDArray[Any]) -> Array:
        """Return logarithms measured less computed, kind by kind; those of a free level less their mean."""
        found = []
        for part, piece, free in zip(self.parts, self._split(compliance), self.free, strict=True):
            away = part.residual(piece)
            found.append(away - away.mean() if free and np.all(np.isfinite(away)) else away)
        return np.concatenate(found)

    def jacobian(self, compliance: NDArray[Any], change: NDArray[Any]) -> Array:
        """Return the change of the computed logarithms, kind by kind; of a free level less their mean."""
        pieces = zip(self.parts, self._split(compliance), self._split(change), self.free, strict=True)
        found = [(part.jacobian(one, moved), free) for part, one, moved, free in pieces]
        return np.concatenate([one - one.mean(axis=0) if free else one for one, free in found])

    def relative(self, tau: Array) -> tuple[Array, Array]:
        """Return the rows of all kinds for a start."""
        rows, wanted = zip(*(part.relative(tau) for part in self.parts), strict=True)
        return np.concatenate(rows), np.concatenate(wanted)

    def levels(self, compliance: NDArray[Any]) -> Array:
        """Return how far the measured moduli of each kind lie above those of the modes, decades."""
        pieces = zip(self.parts, self._split(compliance), strict=True)
        means = [float(part.residual(piece).mean()) for part, piece in pieces]
        return np.array(means) / float(np.log(10.0))

    def _split(self, values: NDArray[Any], tau: Array | None = None) -> list[NDArray[Any]]:
        """Return the rows of each kind."""
        one = np.ones(1) if tau is None else tau[:1]
        counts = [len(part.relaxed(one)) for part in self.parts]
        pieces = np.split(values, np.cumsum(counts[:-1]))
        real = [isinstance(part, CreepMisfit) for part in self.parts]
        return [piece.real if flag else piece for piece, flag in zip(pieces, real, strict=True)]


#: A kind of tests has a level of its own where its rates overlap those of the first kind by so much.
LEVEL_OVERLAP = 0.5  # decades


def joint_misfit(curves: Sequence[MasterCurve | StepMasterCurve]) -> JointMisfit:
    """Return what a fit to master curves of several kinds minimises."""
    first, *others = [np.log10(rates_of(curve)[[0, -1]]) for curve in curves]
    common = [min(first[1], one[1]) - max(first[0], one[0]) for one in others]
    return JointMisfit([misfit_of(curve) for curve in curves], [False, *(bool(one >= LEVEL_OVERLAP) for one in common)])


def contour() -> tuple[ComplexArray, ComplexArray]:
    """Return the nodes z above the real axis, and the weights c."""
    theta = np.pi * (np.arange(NODES // 2) + 0.5) * 2.0 / NODES
    bent = 0.6407 * theta
    z = NODES * (0.5017 * theta / np.tan(bent) - 0.6122 + 0.2645j * theta)
    slope = NODES * (0.5017 / np.tan(bent) - 0.5017 * bent / np.sin(bent) ** 2 + 0.2645j)
    return z, 2.0 / (1j * NODES) * np.exp(z) * slope / z


def misfit_of(curve: MasterCurve | StepMasterCurve) -> CurveMisfit:
    """Return what a fit to a master curve minimises."""
    if not isinstance(curve, StepMasterCurve):
        return ModulusMisfit(curve.angular_frequency, curve.complex_modulus)
    kind = CreepMisfit if curve.kind == "creep" else RelaxationMisfit
    return kind(rates_of(curve), moduli_of(curve))


def rates_of(curve: MasterCurve | StepMasterCurve) -> Array:
    """Return the angular frequencies, or 1/t, ascending, 1/s."""
    return 1.0 / curve.time[::-1] if isinstance(curve, StepMasterCurve) else curve.angular_frequency


def frequencies_of(curve: MasterCurve | StepMasterCurve) -> tuple[float, float]:
    """Return the lowest and the highest angular frequency that a curve determines, rad/s."""
    rates = rates_of(curve)
    above = [last for _, last in gaps_between(rates)]
    return float(rates[0]), max(_reach(curve) * float(rates[-1]), float(rates[0]), *above)


def gaps_of(curves: Sequence[MasterCurve | StepMasterCurve]) -> tuple[tuple[float, float], ...]:
    """Return the gaps, rad/s, between angular frequencies that curves at one temperature determine together."""
    rates = [rates_of(curve) for curve in curves]
    found, lowest = [], min(float(own[0]) for own in rates)
    for first, last in gaps_between(np.concatenate(rates)):
        below = [np.max(own[own <= first], initial=0.0) for own in rates]
        ends = [_reach(curve) * float(end) for curve, end in zip(curves, below, strict=True)]
        found.append((max(lowest, *ends), last))
        lowest = last
    return tuple(found)


def _reach(curve: MasterCurve | StepMasterCurve) -> float:
    return REACH[curve.kind] if isinstance(curve, StepMasterCurve) else 1.0


def moduli_of(curve: MasterCurve | StepMasterCurve) -> Array:
    """Return E', or 1/J(t) or E(t), in the order of the rates; Pa."""
    return curve.modulus[::-1] if isinstance(curve, StepMasterCurve) else curve.storage_modulus


def by_rate(curve: MasterCurve | StepMasterCurve) -> Array:
    """Return the temperature of each point, K, in the order of the rates."""
    return curve.temperature[::-1] if isinstance(curve, StepMasterCurve) else curve.temperature
