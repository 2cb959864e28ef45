"""Memory of a viscoelastic solid, advanced exactly over steps of any length.

The displacement operator of unit compliance, G, and the pressure p give ::

    u = G [p/E_inf + Σ C_k q_k],      dq_k/dt = (p − q_k)/τ_k      at a fixed point of the solid.

The fields q_k are delayed pressures.  They are zero where there never was contact, and equal p after an infinite
rest.  Seen from an indenter at position s, a wave exp(iq·x) of q_k also turns by q·ds.  A step during which p changes
linearly is exact [1]_: with κ = Δt/τ_k and z = −κ + iq·Δs, ::

    q(t + Δt) = e^z q(t) + κ (φ1 − φ2) p(t) + κ φ2 p(t + Δt),      φ1 = (e^z − 1)/z,   φ2 = (φ1 − 1)/z.

Where the temperature changes, Δt is the time of a clock that runs with the shift factor.

.. [1] M. Hochbruck, A. Ostermann, Acta Numer. 19 (2010) 209, doi:10.1017/S0962492910000048: exponential integrators.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscofric.arrays import Array, ComplexArray, non_negative_fit

# |z| below which φ1 and φ2 are summed as power series, and the number of terms: 0.3¹²/14! is below rounding.
_SERIES_BELOW, _TERMS = 0.3, 12
# Times per decade at which merged modes are compared with the full set.
_SAMPLES_PER_DECADE = 12
# Fits: the fastest time is this many times the shortest one, times the error to this power; the slowest but one is as
# many times the duration as the fastest is below half the shortest; the slowest is this many times the duration.
_FASTEST, _POWER, _SLOWEST = 3.0, 0.4, 300.0
_SUM = 1e3  # weight of the sum of compliances, over that of a sample
# Part of the shortest time from which on fits are made: before it they differ more than merged modes do.
_EARLIER = 0.3
# Modes fewer than which are not worth a fit.
_FEW = 8


def phi(z: ArrayLike, count: int = 2, exponential: NDArray[Any] | None = None) -> list[NDArray[Any]]:
    """Return φ1(z) = (e^z − 1)/z, φ2(z) = (φ1(z) − 1)/z, φ3(z) = (φ2(z) − ½)/z, … to rounding, for Re z ≤ 0."""
    # `exponential` is e^z, if that is known.
    z = np.asarray(z)
    small = np.abs(z) < _SERIES_BELOW
    inverse = 1.0 / np.where(small, 1.0, z)
    found = [np.asarray(np.exp(z) if exponential is None else exponential)]
    for order in range(count):
        found.append(np.asarray((found[-1] - 1.0 / math.factorial(order)) * inverse))
    if small.any():
        near = z[small]
        # φ_m = Σ z^n/(n + m)!, by Horner's rule; φ_m = 1/m! + z φ_{m+1}.
        series = np.full_like(near, 1.0 / math.factorial(_TERMS + count))
        for power in range(_TERMS + count - 1, 0, -1):
            series = series * near + 1.0 / math.factorial(power)
            if power <= count:
                found[power][small] = series
    return found[1:]


class StepCoefficients(NamedTuple):
    """q(t + Δt) = decay q(t) + start p(t) + end p(t + Δt)."""

    decay: NDArray[Any]
    start: NDArray[Any]
    end: NDArray[Any]


def step_coefficients(steps: ArrayLike) -> StepCoefficients:
    """Return the exact coefficients of a step."""
    # `steps` are κ = Δt/τ, not below zero; zero is a jump, which does not change q.
    kappa = np.asarray(steps, dtype=np.float64)
    first, second = phi(-kappa)
    return StepCoefficients(np.exp(-kappa), kappa * (first - second), kappa * second)


#: Where series replace differences that would cancel.
_STEP_SERIES_BELOW = 0.05


class StepParts(NamedTuple):
    """Coefficients of a step Δt = xτ, each (modes,).

    The memory becomes q₁ = decay q₀ + start f₀ + end f₁.  A mode of compliance c dissipates
    c [own (f₀ − q₀)² + 2 mixed (f₀ − q₀)(f₁ − f₀) + new (f₁ − f₀)²], the integral of c τ q̇².
    """

    decay: Array
    start: Array
    end: Array
    own: Array
    mixed: Array
    new: Array


def step_parts(x: Array) -> StepParts:
    """Return the coefficients of a step of x = Δt/τ, not below zero."""
    small = x < _STEP_SERIES_BELOW
    safe = np.where(small, 1.0, x)
    gone = -np.expm1(-x)  # 1 − e^{−x}
    decay, start, end = step_coefficients(x)
    own = -0.5 * np.expm1(-2.0 * x)
    mixed = 0.5 * gone * (1.0 - end)
    s = np.where(small, x, 0.0)
    series = s * (1 / 3 - s * (1 / 4 - s * (7 / 60 - s * (1 / 24 - s * (31 / 2520 - s / 320)))))
    new = np.where(small, series, (x - 2.0 * gone + own) / safe / safe)
    return StepParts(decay, start, end, own, mixed, new)


def quickest_time(instantaneous: float, compliances: Array, times: Array) -> float:
    """Return the time in which an instantaneous compliance would double at the first rate of creep, s."""
    return instantaneous / float(compliances @ (1.0 / times)) if len(times) else math.inf


def recovery_at_depth(instantaneous: float, compliances: Array, times: Array, duration: float) -> Array:
    """Return (1 − e^{−AT})⁻¹ (n, n) for memories √C q of points that stay where they are: u is given, and not p."""
    # With u given, p falls by Σ C q/c∞ and q' = −A q + …, A = diag(1/τ)(1 + [1 … 1]ᵀC/c∞), whose times are those of
    # relaxation. Scaled by √(Cτ) the inverse of A is symmetric: diag(τ) − √(Cτ)√(Cτ)ᵀ/(c∞ + ΣC), in which long times
    # are exact; of short ones only that they are short matters.
    root = np.sqrt(compliances * times)
    relaxation = np.diag(times) - np.outer(root, root) / (instantaneous + float(compliances.sum()))
    found, vectors = np.linalg.eigh(relaxation)
    shortest = 1e-3 * duration
    with_all = (vectors / -np.expm1(-duration / np.maximum(found, shortest))) @ vectors.T
    return np.asarray(with_all * np.sqrt(times) / np.sqrt(times)[:, None])


class Spectrum(Protocol):
    """A retardation spectrum: J(t) = 1/E_inf + Σ C_k (1 − exp(−t/τ_k))."""

    @property
    def E_inf(self) -> float:
        """Glass modulus, Pa."""

    @property
    def C(self) -> Array:
        """Compliance of each mode, 1/Pa."""

    @property
    def tau(self) -> Array:
        """Retardation times, s."""


@dataclass(frozen=True, eq=False)
class Modes:
    """Modes whose fields are kept: those of a spectrum, some of them merged.

    It has the attributes of a spectrum that a steady contact needs.
    """

    instantaneous: float  # compliance that follows at once, 1/Pa; the glassy one and that of modes without a field
    C: Array  # (n,) compliance of each mode, 1/Pa
    tau: Array  # (n,) retardation times, s, rising
    error: float = 0.0  # bound on the error of the creep compliance by merging, relative to it
    at_once: float = 0.0  # part of the instantaneous compliance that is of modes without a field, 1/Pa

    @classmethod
    def of(cls, spectrum: Spectrum) -> Modes:
        """Return all modes of a spectrum that have a compliance, none merged."""
        used = np.flatnonzero(spectrum.C > 0.0)
        order = used[np.argsort(spectrum.tau[used])]
        return cls(1.0 / spectrum.E_inf, spectrum.C[order].copy(), spectrum.tau[order].copy())

    @classmethod
    def for_history(cls, spectrum: Spectrum, shortest_time: float, whole_duration: float, error: float = 1e-5) -> Modes:
        """Return few modes that respond in the same way to all that happens within a history."""
        # `shortest_time` is the least time in which the pressure on a point of the solid changes noticeably: the
        # shortest step, or the time in which a sliding contact passes a cell, if that is less. Much faster modes follow
        # the pressure at once or share one field; modes much slower than `whole_duration` share another. `error` bounds
        # what that changes: of the creep compliance J(t) from `shortest_time` to `whole_duration`, relative to J(t),
        # and of the complex compliance S(ω) from 1/`whole_duration` to 1/`shortest_time`, relative to |S|. Modes at
        # other times, fitted to both, are used where fewer of them are as close.
        every = cls.of(spectrum)
        reference = _Response.of(every, shortest_time, whole_duration)
        best, counts = every, [0, 0, 0]
        # Each kind of merging gets a third of the error.
        for kind in range(3):
            while sum(counts) < len(every):
                counts[kind] += 1
                merged = _merged(every, *counts)
                away = reference.error(merged)
                if away > error * (kind + 1) / 3.0:
                    counts[kind] -= 1
                    break
                best = replace(merged, error=away)
        wider = _Response.of(every, _EARLIER * shortest_time, whole_duration)
        for count in range(_FEW - 1, len(best) - 2):
            fitted = wider.fitted(every, count, _FASTEST * error**_POWER)
            away = wider.error(fitted)
            if away <= error and len(fitted) < len(best):
                return replace(fitted, error=away)
        return best

    def difference(self, every: Modes, shortest_time: float, whole_duration: float) -> float:
        """Return the largest difference from other modes, relative to theirs, as in `for_history`."""
        return _Response.of(every, shortest_time, whole_duration).error(self)

    def growth_of_error(self, every: Modes, since: float) -> float:
        """Return how many times as large the error of merging is at a time after a jump, s of the clock, as stated."""
        # Before the shortest time of `for_history`, it is that of the creep compliance at this time.
        if since <= 0.0 or self.error <= 0.0:
            return 1.0
        off = abs(float(self.creep_compliance(since) / every.creep_compliance(since)) - 1.0)
        return max(1.0, off / self.error)

    def __len__(self) -> int:
        return len(self.C)

    @property
    def E_inf(self) -> float:
        """Modulus of what follows at once, Pa."""
        return 1.0 / self.instantaneous

    @property
    def relaxed(self) -> float:
        """Compliance after an infinite time, 1/E0, 1/Pa."""
        return self.instantaneous + float(self.C.sum())

    def compliance(self, angular_frequency: ArrayLike) -> ComplexArray:
        """Return S(ω), 1/Pa, in the shape of `angular_frequency` (rad/s, any sign)."""
        omega = np.asarray(angular_frequency, dtype=np.float64)
        total = np.full(omega.shape, self.instantaneous, dtype=complex)
        for compliance, time in zip(self.C, self.tau, strict=True):
            total += compliance / (1.0 + 1j * omega * time)
        return total

    def creep_compliance(self, time: ArrayLike) -> Array:
        """Return J(t), 1/Pa, in the shape of `time` (s, not below zero)."""
        elapsed = np.asarray(time, dtype=np.float64)[..., None]
        return np.asarray(self.instantaneous - np.expm1(-elapsed / self.tau) @ self.C)


def _merged(every: Modes, at_once: int, fast: int, slow: int) -> Modes:
    """Return modes of which the fastest ones follow at once, the next share a field, and the slowest share another."""
    # The common time of fast modes has the same loss at low frequencies, that of slow ones the same rate of creep at
    # first; both have the same compliance in the end.
    C, tau = every.C, every.tau
    first, last = at_once + fast, len(every) - slow
    one_C, one_tau = [C[first:last]], [tau[first:last]]
    if fast:
        part = slice(at_once, first)
        one_C.insert(0, C[part].sum(keepdims=True))
        one_tau.insert(0, C[part] @ tau[part] / one_C[0])
    if slow:
        part = slice(last, None)
        one_C.append(C[part].sum(keepdims=True))
        one_tau.append(one_C[-1] / (C[part] @ (1.0 / tau[part])))
    quick = float(C[:at_once].sum())
    return Modes(every.instantaneous + quick, np.concatenate(one_C), np.concatenate(one_tau), at_once=quick)


@dataclass(frozen=True, eq=False)
class _Response:
    """Creep and complex compliance over the times of a history."""

    times: Array
    creep: Array
    dynamic: ComplexArray

    @classmethod
    def of(cls, modes: Modes, shortest: float, longest: float) -> _Response:
        decades = math.log10(longest / shortest)
        times = np.geomspace(shortest, longest, 2 + math.ceil(_SAMPLES_PER_DECADE * decades))
        return cls(times, modes.creep_compliance(times), modes.compliance(1.0 / times))

    def error(self, other: Modes) -> float:
        """Return the largest relative difference of other modes."""
        creep = np.abs(other.creep_compliance(self.times) / self.creep - 1.0).max()
        dynamic = np.abs(other.compliance(1.0 / self.times) / self.dynamic - 1.0).max()
        return float(max(creep, dynamic))

    def fitted(self, every: Modes, count: int, fastest: float) -> Modes:
        """Return modes at so many times and one slow one, fitted to what these modes respond, with the same sum."""
        # A part of the compliance follows at once. The fit is one of least squares with compliances not below zero.
        shortest, longest = float(self.times[0]), float(self.times[-1])
        tau = np.append(np.geomspace(fastest * shortest, 0.5 / fastest * longest, count), _SLOWEST * longest)
        total, size = float(every.C.sum()), np.abs(self.dynamic)
        rate = self.times[:, None] / tau
        creep = np.pad(-np.expm1(-rate), ((0, 0), (1, 0)), constant_values=1.0)
        dynamic = np.pad(rate / (rate + 1j), ((0, 0), (1, 0)), constant_values=1.0)
        parts = [
            (creep.T / self.creep, 1.0 - every.instantaneous / self.creep),
            (dynamic.real.T / size, (self.dynamic.real - every.instantaneous) / size),
            (dynamic.imag.T / size, self.dynamic.imag / size),
            (np.full((count + 2, 1), _SUM / total), np.array([_SUM])),
        ]
        matrix, aim = (np.concatenate(each, axis=-1) for each in zip(*parts, strict=True))
        found = non_negative_fit(total * matrix.T, aim)
        quick, C = total / found.sum() * found[0], total / found.sum() * found[1:]
        used = C > 0.0
        return Modes(every.instantaneous + float(quick), C[used], tau[used], at_once=float(quick))
