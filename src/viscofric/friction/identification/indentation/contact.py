"""Measured contacts: their points, and the logarithms of these for a material, with derivatives."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.indenters.shapes import Ball, FlatPunch
from viscofric.friction.identification.anchors import compliance, log_modulus
from viscofric.friction.identification.forward import extrapolated
from viscofric.motion.springs import Springs, both_sides, disc_profile


class Shared(NamedTuple):
    """Standard deviations of errors that all rows share; zero where they are taken as exact."""

    radius: float = 0.0  # of the indenter, relative, the same for all records
    gain: float = 0.0  # of the load cell, relative, the same for all records
    zero: float = 0.0  # of the zero of the depth, m, of its own for every record


EXACT = Shared()


class Trial(NamedTuple):
    """A material whose response is asked for."""

    compliances: Array  # (1 + m,), ln(1/E_inf), then every ln C at the reference, of 1/Pa
    tau: Array  # (m,), at the reference, s
    log_alpha: float
    plane_strain: float  # 1 − ν²
    extra: float  # (1 − ν_i²)/E_i of the indenter over the plane strain of the rubber, 1/Pa

    def springs(self, indenter: Indenter, edge: float, count: int, power: float) -> Springs:
        """Return springs up to an edge, closer to each other near the axis where the power is above one."""
        s = edge * np.linspace(0.0, 1.0, count + 1) ** power
        strengths = self.plane_strain * np.exp(self.compliances)
        instantaneous = float(strengths[0]) + self.plane_strain * self.extra
        tau = np.exp(self.log_alpha) * self.tau
        walls = indenter.has_walls
        return Springs(disc_profile(indenter, s, edge), s, both_sides(s), instantaneous, strengths[1:], tau, walls)

    def logarithm(self, value: Array, change: Array, measured: Array) -> tuple[Array, Array]:
        """Return `logarithm` of values by springs, and its derivatives from theirs (n, 2 + m), the first by 1/E_inf."""
        log_value, slope = logarithm(value, measured)
        change = change * slope[:, None]
        change[:, 0] *= self.plane_strain * float(np.exp(self.compliances[0]))
        return log_value, change

    def creep(self, time: float) -> float:
        """Return (1−ν²) J(t), with the compliance of the indenter, 1/Pa."""
        strengths = np.exp(self.compliances)
        grown = -np.expm1(-time * np.exp(-self.log_alpha) / self.tau)
        return self.plane_strain * (float(strengths[0]) + self.extra + float(strengths[1:] @ grown))


class Answer(NamedTuple):
    """Logarithms of the modelled values of n points, and their derivatives."""

    log_value: Array  # (n,)
    change: Array  # (n, 1 + m), by the compliances
    by_alpha: Array  # (n,), by ln α
    shared: Array  # (n, 3), by the errors in common, in their standard deviations; modelled less measured


@dataclass(frozen=True, eq=False, kw_only=True)
class Points:
    """The n measured points of one record."""

    along: Array  # (n,), time, s; angular frequency, rad/s; speed of the impact, m/s
    response: Array  # (n,), measured values
    error: Array | None  # (n,), relative standard errors; None where they are to be found from the residuals
    count: Array  # (n,), rows averaged
    lags: tuple[float, float]  # shortest and longest time of what was measured, s
    parts: tuple[tuple[str, slice], ...]  # names of the measured quantities, and their points

    def __len__(self) -> int:
        return len(self.along)


def columns(along: Array, values: Mapping[str, tuple[Array, float]], times: Array) -> dict[str, Any]:
    """Return fields of `Points` for columns of values (k,), by name, with their relative errors; times in s."""
    size = len(along)
    return {
        "along": np.tile(along, len(values)),
        "response": np.concatenate([column for column, _ in values.values()]),
        "error": np.repeat([error for _, error in values.values()], size),
        "count": np.ones(size * len(values)),
        "lags": (float(times.min()), float(times.max())),
        "parts": tuple((name, slice(n * size, (n + 1) * size)) for n, name in enumerate(values)),
    }


class Contact(Points, ABC):
    """The points of one record, and their response to a material."""

    #: Whether the response is solved by springs for one material, and extrapolated to others.
    by_springs: ClassVar[bool] = False

    @abstractmethod
    def ends(self, trial: Trial) -> tuple[float, float, float]:
        """Return the lowest angular frequency, rad/s, and the highest ones of E'' and of |E|, that were measured."""

    @property
    @abstractmethod
    def log_elastic(self) -> float | None:
        """Ln of (1−ν²)/E of a similar elastic contact, 1/Pa; None where it does not show."""

    @abstractmethod
    def answer(self, trial: Trial) -> Answer:
        """Return the response to a material."""


@dataclass(frozen=True, eq=False)
class Nearby:
    """The response of materials near one for which it was solved, `extrapolated`.

    The weights of the modes are their parts in the compliance at the contact's frequency.
    """

    trial: Trial
    solved: Answer
    weights: Array  # (n, 1 + m)

    @classmethod
    def of(cls, contact: Contact, trial: Trial) -> Nearby:
        """Solve a contact for a material."""
        highest = 1.0 / np.asarray(contact.lags[1] if len(contact.parts) > 1 else contact.along)
        log_frequency = np.broadcast_to(np.log(highest), contact.response.shape) + trial.log_alpha
        _, parts, _ = compliance(trial.compliances, trial.tau, log_frequency)
        weights = parts.real / parts.real.sum(axis=1, keepdims=True)
        return cls(trial, contact.answer(trial), weights)

    def __call__(self, trial: Trial) -> Answer:
        """Return the response of a material."""
        there = self.solved
        moved, change, _ = extrapolated(trial.compliances - self.trial.compliances, there.change, self.weights)
        away = trial.log_alpha - self.trial.log_alpha
        value = there.log_value + np.sum(there.change * moved, axis=1) + there.by_alpha * away
        return there._replace(log_value=value, change=change)


def logarithm(value: Array, measured: Array) -> tuple[Array, Array]:
    """Return ln of values, continued linearly below half the measured ones, and its derivative (n,)."""
    least = 0.5 * measured
    above = np.maximum(value, least)
    return np.log(above) + np.minimum(value / least - 1.0, 0.0), 1.0 / above


def wider(indenter: Indenter, part: float) -> Indenter:
    """Return a Ball or a FlatPunch whose radius is larger by a part of it."""
    assert isinstance(indenter, (Ball, FlatPunch))
    return type(indenter)(radius=(1.0 + part) * float(indenter.radius))


@dataclass(frozen=True, eq=False, kw_only=True)
class Known(Contact):
    """Moduli over angular frequencies, times the contact diameter over 1−ν² for a stiffness.

    A small oscillation about a depth δ keeps its contact radius a, so that the stiffness is 2a E(ω)/(1−ν²) (I. N.
    Sneddon, Int. J. Eng. Sci. 3 (1965) 47, with the correspondence principle).
    """

    diameter: float | None = None  # 2a; None for moduli, which have no indenter
    by_radius: float = 0.0  # d ln a/d ln R at a given depth
    by_depth: float = 0.0  # d ln a/dδ, 1/m
    shared: Shared = EXACT

    @classmethod
    def of(cls, frequency: Array, values: Mapping[str, tuple[Array, float]], **contact: Any) -> Known:
        """Return values over ω (k,), N/m or Pa, and their relative errors, by names such as "storage_modulus"."""
        return cls(**columns(frequency, values, 1.0 / frequency), **contact)

    def ends(self, trial: Trial) -> tuple[float, float, float]:
        """Return the measured frequencies, rad/s."""
        low, high = float(self.along.min()), float(self.along.max())
        return low, high, high

    @property
    def log_elastic(self) -> float | None:
        """Ln of (1−ν²)/E of the storage modulus or the magnitude; None of moduli, whose Poisson's ratio is apart."""
        if self.diameter is None:
            return None
        rows = self.response[self.parts[0][1]]
        return float(np.median(np.log(self.diameter / rows)))

    def answer(self, trial: Trial) -> Answer:
        """Return the stiffness or the moduli of a material."""
        S, change, slope = compliance(trial.compliances, trial.tau, np.log(self.along) + trial.log_alpha)
        factor = 0.0
        if self.diameter is not None:
            S, factor = S + trial.extra, float(np.log(self.diameter / trial.plane_strain))
        value, moved = np.empty(len(self)), np.empty((len(self), change.shape[1] + 1))
        for name, rows in self.parts:
            part = name.partition("_")[0]
            value[rows], moved[rows] = log_modulus(part, S[rows], np.column_stack([change, slope])[rows])
        shared = np.zeros((len(self), 3))
        if self.diameter is not None:
            shared[:] = self.shared.radius * self.by_radius, -self.shared.gain, self.shared.zero * self.by_depth
        return Answer(value + factor, moved[:, :-1], moved[:, -1], shared)
