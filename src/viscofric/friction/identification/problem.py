"""The least-squares problem of an identification: measurements, and the prior of spectrum and shift factors."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import InputError
from viscofric.friction.identification.anchors import ModulusObservation, SolvedContact
from viscofric.friction.identification.forward import CorrectedFriction
from viscofric.friction.identification.points import Points
from viscofric.nominal import SAME_TEMPERATURE
from viscofric.rheology.shifts.laws import ShiftLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors, weights_between
from viscofric.rheology.shifts.shift_law import LN10
from viscofric.units import shown_celsius

#: Standard deviation of the prior of found shifts, about those from the overlap of the curves alone, in their standard
#: errors, and in ln α.  A free spectrum also fits curves without overlap.  The prior counts the data twice, by one part
#: in the square of the first number; errors that points share make this more: with 5, intervals of α held 90 %.
OVERLAPPING, OVERLAPPING_LEAST = 12.0, 0.05
#: Standard deviation of ln α known without an error, for rounding.
EXACT = 1e-7
_SAME = 1e-6  # K
#: Standard deviation of the mean of ln C about the first guess, and of ln(1/E_inf) about the compliance in the
#: contacts: a material of little loss has most of it, one amidst its transition a hundredth.
LEVEL = 3.0
GLASS = 2.0
#: Standard deviation of the mean slope d ln C/d ln τ: it lies between the −1 and 1 of power-law moduli, as a rule.
SLOPE = 0.7
#: Roughnesses averaged by their evidence, standard deviation of d ln C/d ln τ over an e-fold of τ.
ROUGHNESS = np.geomspace(0.02, 1.3, 10)
#: Middle and logarithmic standard deviation of their prior.
EXPECTED, EXPECTED_SPREAD = 0.15, 1.0
#: Roughness near the ends of the contact's frequencies and beyond, where no data determine it: a spectrum may end, or
#: rise to the glass transition, within a third of a decade.
OUTSIDE = 1.5
#: Decades to which retardation times extend beyond what was measured; modes beyond act as a spring or not at all.
MARGIN = 1.9
#: Fewest modes per decade with which E(ω) and J(t) do not ripple.
LEAST_PER_DECADE = 2.5
#: Friction averages over two decades of τ (K of the theory): modes within a decade of the first or the last of the
#: measured times or frequencies affect it from one side only, and a spectrum may end there, or rise to the glass
#: transition, so that no smoothness is assumed for them.  Of a narrow band this is a quarter on either side.
ONE_SIDED, ONE_SIDED_SHARE = 1.0, 0.25


@dataclass(frozen=True, eq=False)
class Shifts:
    """ln α at the temperatures of friction, anchors and reference, with a normal prior."""

    temperatures: Array  # (t,), ascending, K
    reference: float  # K, one of the temperatures, where α = 1, unless `found` is false
    middle: Array  # (t,), prior mean of ln α
    whitening: Array  # (r, t); its product with (ln α − middle) has standard deviation one
    per_kelvin: Array | None  # (t,), expected d ln α/dT; None for one temperature, of which it is not known
    found: bool  # whether the friction is to determine them
    exact: bool = False  # whether they were given without an error

    @classmethod
    def unknown(cls, temperatures: Array, reference: float, overlap: ShiftFactors | None = None) -> Shifts:
        """Return unknown shifts about those from the `overlap` of the curves, which is None for one temperature."""
        if overlap is None:
            return cls(temperatures, reference, np.zeros(1), np.eye(1) / EXACT, None, True)
        about = overlap.at_reference(reference)
        away = np.abs(temperatures - reference) >= _SAME
        covariance = (OVERLAPPING * LN10) ** 2 * about.covariance_at(temperatures) * np.outer(away, away)
        covariance += np.diag(np.where(away, OVERLAPPING_LEAST**2, 0.0))
        middle = LN10 * np.asarray(about.log10(temperatures))
        return cls(temperatures, reference, middle, _whitening(covariance), _per_kelvin(about, temperatures), True)

    @classmethod
    def known(cls, temperatures: Array, shift: ShiftLaw) -> Shifts:
        """Return the shifts of a law or table at temperatures (t,), with its covariance where it has one."""
        middle = LN10 * np.asarray(shift.log10(temperatures))
        covariance = LN10**2 * shift.covariance_at(temperatures)
        slopes = _per_kelvin(shift, temperatures)
        exact = not covariance.any()
        return cls(temperatures, float(shift.reference), middle, _whitening(covariance), slopes, False, exact)

    def widened(self, log_alpha_error: Array) -> Shifts:
        """Return the prior with additional standard errors (t,) of ln α."""
        covariance = np.linalg.inv(self.whitening.T @ self.whitening) + np.diag(log_alpha_error**2)
        return replace(self, whitening=_whitening(np.asarray(covariance, dtype=np.float64)))

    def row(self, temperature: float) -> Array:
        """Return the weights (t,) in ln α at a temperature, linear in 1/T; InputError clearly outside their range."""
        low, high = self.temperatures[0], self.temperatures[-1]
        if not low - SAME_TEMPERATURE <= temperature <= high + SAME_TEMPERATURE:
            raise InputError(
                f"temperature = {shown_celsius(temperature)} °C of an anchor or prior lies outside those of the "
                f"friction curves, {shown_celsius(float(low))} to {shown_celsius(float(high))} °C, so that its shift "
                "factor is not found; give the shift factors, or one measured among them.",
                code="outside-measured",
            )
        return np.asarray(weights_between(self.temperatures, np.array([temperature]))[0])

    def table(self, log_alpha: Array, covariance: Array) -> ShiftFactors:
        """Return the factors found, of ln α (t,) with its covariance (t, t), about the reference."""
        return ShiftFactors(self.temperatures, log_alpha / LN10, self.reference, covariance / LN10**2)


def _per_kelvin(shift: ShiftLaw, temperatures: Array) -> Array:
    """Return d ln α/dT (t,), by differences of 0.2 K, or of half of it at an end of the shift factors."""
    low, high = (
        np.where(shift.valid_at(there), there, temperatures) for there in (temperatures - 0.1, temperatures + 0.1)
    )
    return np.asarray(LN10 * (shift.log10(high) - shift.log10(low)) / (high - low))


def _whitening(covariance: Array) -> Array:
    values, vectors = np.linalg.eigh(covariance)
    return np.asarray(vectors.T / np.sqrt(np.maximum(values, 0.0) + EXACT**2)[:, None])


@dataclass(frozen=True, eq=False)
class Smoothness:
    """Normal prior of x = (ln(1/E_inf), ln C_1 … ln C_m): a random walk of second order with a broad level and slope.

    Its density is exp(−|A (x − middle)|²/2) |A|, with A square.
    """

    tau: Array  # (m,), in geometric progression, s
    compliance: float  # first guess of 1/|E|, 1/Pa
    # shortest and longest retardation time whose modes affect the friction from both sides, s
    inside: tuple[float, float]
    roughness: float = EXPECTED  # standard deviation of the change of d ln C/d ln τ over an e-fold of τ, inside

    @classmethod
    def about(cls, low: float, high: float, compliance: float, modes: int) -> Smoothness:
        """Return the prior on a grid of `modes` retardation times or more, about measured times, ln s."""
        shortest, longest = low - MARGIN * LN10, high + MARGIN * LN10
        count = max(modes, int(np.ceil(LEAST_PER_DECADE * (longest - shortest) / LN10)) + 1)
        one_sided = min(ONE_SIDED * LN10, ONE_SIDED_SHARE * (high - low))
        inside = float(np.exp(low + one_sided)), float(np.exp(high - one_sided))
        return cls(np.exp(np.linspace(shortest, longest, count)), compliance, inside)

    @cached_property
    def middle(self) -> Array:
        """Prior mean, (1 + m,)."""
        spacing = float(np.log(self.tau[-1] / self.tau[0])) / (len(self.tau) - 1)
        level = np.log(self.compliance) + np.log(0.1 * spacing)
        return np.concatenate([[np.log(self.compliance)], np.full(len(self.tau), level)])

    @cached_property
    def matrix(self) -> Array:
        """A, (1 + m, 1 + m)."""
        m = len(self.tau)
        places = np.log(self.tau)
        spacing = float(places[-1] - places[0]) / (m - 1)
        within = (self.tau[1:-1] >= self.inside[0]) & (self.tau[1:-1] <= self.inside[1])
        rough = np.where(within, self.roughness, max(OUTSIDE, self.roughness))
        curvature = np.diff(np.eye(m), 2, axis=0) / (rough * spacing**1.5)[:, None]
        away = places - places.mean()
        level = np.full((1, m), 1.0 / (m * LEVEL))
        slope = (away / (away @ away) / SLOPE)[None, :]
        rows = np.concatenate([level, slope, curvature])
        matrix = np.zeros((m + 1, m + 1))
        matrix[0, 0] = 1.0 / GLASS
        matrix[1:, 1:] = rows
        return matrix

    @property
    def log_volume(self) -> float:
        """Logarithm of |A| and of the prior of the roughness."""
        expected = -0.5 * float(np.log(self.roughness / EXPECTED) / EXPECTED_SPREAD) ** 2
        return float(np.linalg.slogdet(self.matrix)[1]) + expected


@dataclass(frozen=True, eq=False)
class SpectrumProblem(ABC):
    """Residuals of standard deviation one in the unknowns: compliances (1 + m,), then ln α (t,), then other ones.

    The other unknowns are errors that measured values have in common, in their standard deviations.
    """

    shifts: Shifts
    smoothness: Smoothness

    @property
    def others(self) -> int:
        """Number of other unknowns."""
        return 0

    @property
    def modes(self) -> int:
        """Number of unknowns that are compliances."""
        return len(self.smoothness.tau) + 1

    @cached_property
    def metric(self) -> Array:
        """Normal matrix of the prior of the unknowns (p, p); it damps steps (`descend`)."""
        A, W = self.smoothness.matrix, self.shifts.whitening
        first, last = self.modes, self.modes + len(self.shifts.middle)
        result = np.eye(last + self.others)
        result[:first, :first], result[first:last, first:last] = A.T @ A, W.T @ W
        return result

    @property
    def start(self) -> Array:
        """Prior mean of the unknowns."""
        return np.concatenate([self.smoothness.middle, self.shifts.middle, np.zeros(self.others)])

    def split(self, unknowns: Array) -> tuple[Array, Array]:
        """Return compliances and ln α."""
        return unknowns[: self.modes], unknowns[self.modes : self.modes + len(self.shifts.middle)]

    @property
    @abstractmethod
    def point_errors(self) -> Array:
        """Standard errors of the logarithms of the measured points (n,)."""

    @abstractmethod
    def with_errors(self, errors: Array) -> Self:
        """Return the problem with other standard errors (n,) of the points."""

    @abstractmethod
    def modelled(self, unknowns: Array) -> tuple[Array, Array]:
        """Return the modelled logarithm of every point (n,), and its derivatives (n, p)."""

    def blurred(self, error: float) -> Self:
        """Return the problem with an additional error of every point."""
        return self.with_errors(np.hypot(self.point_errors, error))

    @abstractmethod
    def measured(self, unknowns: Array) -> tuple[Array, Array]:
        """Return the residuals of the measurements (r,), and their derivatives (r, p)."""

    def __call__(self, unknowns: Array) -> tuple[Array, Array]:
        """Return all residuals (r,), those of the prior last, and their derivatives (r, p)."""
        compliances, log_alpha = self.split(unknowns)
        values, changes = self.measured(unknowns)
        A, W = self.smoothness.matrix, self.shifts.whitening
        last = self.modes + len(log_alpha)
        expected = np.zeros((len(A) + len(W) + self.others, len(unknowns)))
        expected[: len(A), : self.modes], expected[len(A) : len(A) + len(W), self.modes : last] = A, W
        expected[len(A) + len(W) :, last:] = np.eye(self.others)
        parts = A @ (compliances - self.smoothness.middle), W @ (log_alpha - self.shifts.middle), unknowns[last:]
        away = np.concatenate(parts)
        return np.concatenate([values, away]), np.concatenate([changes, expected])


@dataclass(frozen=True, eq=False)
class Problem(SpectrumProblem):
    """Identification from friction."""

    friction: CorrectedFriction
    points: Points
    moduli: tuple[ModulusObservation, ...] = ()
    contacts: tuple[SolvedContact, ...] = ()  # contacts whose size was measured

    @property
    def others(self) -> int:
        """Number of errors that the points have in common."""
        return int(self.points.shared.shape[1])

    @property
    def point_errors(self) -> Array:
        """Standard errors of ln μ (n,)."""
        return self.points.error

    def with_errors(self, errors: Array) -> Self:
        """Return the problem with other standard errors of ln μ (n,)."""
        return replace(self, points=replace(self.points, error=errors))

    def modelled(self, unknowns: Array) -> tuple[Array, Array]:
        """Return the modelled ln μ of every point (n,), without errors, and its derivatives (n, p)."""
        compliances, log_alpha = self.split(unknowns)
        points = self.points
        value, change, slope = self.friction(compliances, points.log_speed + log_alpha[points.number], points.log_load)
        moved = np.zeros((len(points), len(log_alpha) + self.others))
        moved[np.arange(len(points)), points.number] = slope
        return value, np.concatenate([change, moved], axis=1)

    def missed(self, unknowns: Array) -> tuple[Array, Array]:
        """Return modelled minus measured friction over the scale, or of ln μ (n,), and its derivatives (n, p)."""
        value, change = self.modelled(unknowns)
        first = len(unknowns) - self.others
        away, by_value, by_common = self.points.missed(value, unknowns[first:])
        change = change * by_value[:, None]
        change[:, first:] += by_common
        return away, change

    def measured(self, unknowns: Array) -> tuple[Array, Array]:
        """Return the residuals of the measurements (r,), friction first, and their derivatives (r, p)."""
        compliances, log_alpha = self.split(unknowns)
        points = self.points
        missed, change = self.missed(unknowns)
        values, changes = [missed / points.error], [change / points.error[:, None]]
        known: tuple[ModulusObservation | SolvedContact, ...] = (*self.moduli, *self.contacts)
        for one in known:
            row = self.shifts.row(one.temperature)
            away, moved, slope = one.away(compliances, self.smoothness.tau, float(row @ log_alpha))
            values.append(away)
            changes.append(np.concatenate([moved, np.outer(slope, row), np.zeros((len(away), self.others))], axis=1))
        return np.concatenate(values), np.concatenate(changes)
