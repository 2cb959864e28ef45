"""Samples of master curves: points drawn as other measurements of the same material might have given them."""

from __future__ import annotations

import copy
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscofric.arrays import Array, Integers
from viscofric.errors import InputError
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.spectra import regularised, sparse
from viscofric.rheology.spectra.fit_verdict import Curve
from viscofric.rheology.spectra.modulus_misfit import Misfit, Modes
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.spectra.sparse import lattice_between, nonnegative_modes
from viscofric.rheology.spectra.step_misfit import by_rate, misfit_of
from viscofric.rheology.superposition.result import Superposition
from viscofric.rheology.superposition.step_result import StepSuperposition
from viscofric.rheology.uncertainty.residuals import Residuals

#: Standard deviation of logarithms without any noise.
SMALLEST_NOISE = 1e-6


class Resampled:
    """Samples of a master curve as misfits; see `sample_materials`.

    `moved` (samples, isotherms) are errors of log10 α, `levels` (samples, isotherms, m) errors of log10 E' and log10
    E'' (or of log10 of a step response) that all points of an isotherm share.
    """

    def __init__(
        self,
        random: np.random.Generator,
        fit: Superposition | StepSuperposition,
        spectrum: RetardationSpectrum,
        moved: Array,
        levels: Array,
    ) -> None:
        isotherm = isotherm_of_points(fit.master_curve, fit.shift_factors)
        whole = misfit_of(fit.master_curve)
        # By isotherm, rates ascending in each: errors are correlated along isotherms.
        order = np.lexsort((whole.rates, isotherm))
        isotherm, rates = isotherm[order], whole.rates[order]
        self.logarithms = whole.target.reshape(-1, len(rates)).T[order]
        self.misfit = misfit = whole.of(rates, self.logarithms)
        away = misfit.residual(misfit.compliance(spectrum)).reshape(-1, len(rates)).T
        fitted_shift = fit.shift_factors.standard_errors[isotherm] > 0.0
        leverage = _leverage(misfit, spectrum, np.where(fitted_shift, isotherm, -1)).reshape(-1, len(rates)).T
        if fit.offsets is not None:
            away = _without_offsets(away, isotherm, np.log(10.0) * fit.offsets.standard_deviations)
        residuals = Residuals(away, np.unique(isotherm, return_inverse=True)[1], leverage)
        self.rates = np.log(rates) + np.log(10.0) * moved[:, isotherm]
        self.errors = residuals.draw(random, len(moved)) + np.log(10.0) * levels[:, isotherm]
        # Errors that neighbours have in common are worth fewer points.
        self.noise = np.hypot(
            residuals.scale * np.sqrt((1.0 + residuals.alike) / (1.0 - residuals.alike)),
            np.log(10.0) * levels.std(axis=0)[isotherm],
        )
        self.noise += SMALLEST_NOISE

    @property
    def ends(self) -> tuple[float, float]:
        """The lowest and the highest rate of all samples, 1/s."""
        return float(np.exp(self.rates.min())), float(np.exp(self.rates.max()))

    def __call__(self, number: int) -> tuple[Misfit, Array]:
        """Return the misfit of one sample, and the standard deviations of its logarithms (mN,)."""
        ascending = np.argsort(self.rates[number], kind="stable")
        values = (self.logarithms + self.errors[number])[ascending]
        misfit = self.misfit.of(np.exp(self.rates[number][ascending]), values)
        return misfit, self.noise[ascending].T.ravel()


def _without_offsets(residual: Array, isotherm: Integers, offset: Array) -> Array:
    """Return residuals (N, m) less each isotherm's offset, of standard deviation (m,), which is drawn apart."""
    number = np.unique(isotherm, return_inverse=True)[1]
    count = np.bincount(number)[:, None]
    mean = np.stack([np.bincount(number, weights=column) for column in residual.T], axis=1) / count
    noise = np.mean((residual - mean[number]) ** 2, axis=0) / count
    return np.asarray(residual - (mean * offset**2 / (offset**2 + noise + 1e-300))[number])


def _leverage(misfit: Misfit, spectrum: RetardationSpectrum, isotherm: Integers) -> Array:
    """Return the part of each error that modes and shifts follow, (mN,): the diagonal of the fit's hat matrix."""
    # `isotherm` (N,) is the number of each point's isotherm, −1 where its shift was not fitted.
    tau = np.array(spectrum.tau)
    relaxed = misfit.relaxed(tau)
    moved = misfit.moved(relaxed, np.array(spectrum.C), tau)
    changes = [np.full((len(relaxed), 1), 1.0 / spectrum.E_inf, dtype=relaxed.dtype), relaxed * spectrum.C]
    if spectrum.fit is not None and spectrum.fit.tau_ratio is None:
        changes.append(moved)
    belongs = isotherm[:, None] == np.unique(isotherm[isotherm >= 0])
    belongs = np.repeat(belongs, len(relaxed) // len(isotherm), axis=0)
    changes.append(np.sum(moved, axis=1)[:, None] * belongs)
    jacobian = misfit.jacobian(misfit.compliance(spectrum), np.concatenate(changes, axis=1))
    left, _ = np.linalg.qr(jacobian / (np.linalg.norm(jacobian, axis=0) + 1e-300))
    return np.asarray(np.sum(left**2, axis=1))


def isotherm_of_points(curve: Curve, shifts: ShiftFactors) -> Integers:
    """Return the index of every point's temperature among those of the shift factors, rates ascending."""
    place = np.abs(by_rate(curve)[:, None] - shifts.temperatures).argmin(axis=1)
    return np.asarray(place, dtype=np.int64)


#: Refits start at the fit to the measurement; a tolerance well below the noise is sufficient.
CONVERGED = 1e-3
#: Times closer than this are the same time of the lattice.
SAME = 1e-6  # of ln τ
#: Modes are drawn to so many decades beyond the times that the measurement reaches …
BEYOND = 2.0
#: … up to an end of the spectrum, which lies so far out on average; …
END = 1.5  # decades
#: … ln C is a random walk that starts from the density at the end of the measurement, with these standard deviations:
#: of its start, and of its change over a factor of e in time.
START, WALK = 0.5, 1.0
#: Faster modes than those of the fit are fitted too, up to a limit that differs from sample to sample.  Slower
#: ones are not: their compliance could grow without bound.
FURTHER = 1.5  # of ln τ
#: Modes beyond that contradict the sample are drawn again, so many times.
TRIES = 10


def beside(misfit: Misfit, given: NDArray[Any]) -> Misfit:
    """Return the misfit of modes beside others, whose compliance (P,) is given; a start leaves these out."""
    found = copy.copy(misfit)
    found.residual = lambda compliance: misfit.residual(compliance + given)  # type: ignore[method-assign]
    found.jacobian = lambda compliance, change: misfit.jacobian(compliance + given, change)  # type: ignore[method-assign]
    return found


class Refit:
    """Fits samples of a master curve as a fitted spectrum was; InputError if it was not fitted.

    What the measurement leaves open differs from sample to sample: where the times of the lattice lie, and the modes
    beyond the times that it reaches.  These are drawn from a wide distribution, on either side, and the others are
    fitted beside them.  A draw is taken with the probability exp(−Δχ²/2), Δχ² the rise of the squared errors of the fit
    in units of their variance; else the modes are drawn again.

    `like` is the misfit of the curve; `lowest` and `highest` are the ends of the rates of all samples, 1/s.
    """

    def __init__(
        self, random: np.random.Generator, spectrum: RetardationSpectrum, like: Misfit, lowest: float, highest: float
    ) -> None:
        if spectrum.fit is None or not spectrum.fit.method or spectrum.fit.from_contact:
            raise InputError(
                "spectrum: was not fitted to a master curve, so that it cannot be fitted to samples of one; "
                "give what fit_retardation_spectrum returned.",
                code="not-fitted",
            )
        self.random, self.spectrum = random, spectrum
        self.strength, ratio = spectrum.fit.regularisation, spectrum.fit.tau_ratio
        self.spacing = math.log(math.e if ratio is None else ratio)
        self.tau: Array | None = None
        self.apart = np.zeros(0)
        if ratio is not None:
            edge = BEYOND * math.log(10.0) + FURTHER + self.spacing
            low, high = like.ends_of(lowest, highest)
            self.tau = lattice_between((low - edge, high + edge), ratio)
            away = np.abs(np.log(spectrum.tau)[:, None] - np.log(self.tau)).min(axis=1)
            self.apart = np.array(spectrum.tau)[away > SAME]  # the slowest may lie between two times of the lattice

    def __call__(self, misfit: Misfit, noise: Array) -> Modes:
        """Return the fitted modes, zeros included; `noise` (mN,) are the standard deviations of the logarithms."""
        tau = self._times(misfit)
        found = self._fitted(misfit, tau, None)
        low, high = misfit.ends if self.tau is None else (math.log(tau.min()), math.log(tau.max()))
        steps = self.spacing * np.arange(1.0, math.ceil(BEYOND * math.log(10.0) / self.spacing) + 1.0)
        further = np.exp(np.concatenate([low - steps, high + steps]))
        relaxed, least = misfit.relaxed(further), np.sum((misfit.misses(found) / noise) ** 2)
        losses = -(1.0 / self.spectrum.complex_modulus(misfit.rates[[-1, 0]])).imag
        drawn = np.zeros((2, len(steps)))
        for side, loss in enumerate(losses):
            for _ in range(TRIES):
                trial = drawn.copy()
                trial[side] = self._beyond(float(loss), steps)
                if not np.any(trial[side]):
                    break
                rest = beside(misfit, relaxed @ trial.ravel())
                other = self._fitted(rest, tau, found)
                rise = np.sum((rest.misses(other) / noise) ** 2) - least
                if 2.0 * self.random.standard_exponential() > rise:
                    drawn, found = trial, other
                    break
        return Modes(found.glass, np.append(found.C, drawn), np.append(found.tau, further))

    def on_lattice(self, modes: Modes) -> Modes:
        """Return modes with their compliances shared between neighbouring times that all samples have in common."""
        if self.tau is None:
            return modes
        place = np.interp(np.log(modes.tau), np.log(self.tau), np.arange(len(self.tau)))
        share = np.maximum(1.0 - np.abs(place[:, None] - np.arange(len(self.tau))), 0.0)
        return Modes(modes.glass, modes.C @ share, self.tau)

    def _times(self, misfit: Misfit) -> Array:
        """Return the retardation times to begin with: a lattice that lies anywhere, or those of sparse modes."""
        if self.tau is None:
            return np.array(self.spectrum.tau)
        low, high = misfit.ends
        low -= FURTHER * self.random.uniform()
        by = self.spacing * self.random.uniform()
        tau = np.exp(by) * lattice_between((low - by, high - by), math.exp(self.spacing))
        return np.append(tau, self.apart)

    def _fitted(self, misfit: Misfit, tau: Array, start: Modes | None) -> Modes:
        if self.tau is None:
            begin = Modes(1.0 / self.spectrum.E_inf, np.array(self.spectrum.C), tau)
            return sparse.moved_modes(misfit, start or begin, tidy=False, converged=CONVERGED)
        if self.strength is None:
            return nonnegative_modes(misfit, tau, start, converged=CONVERGED)
        known = np.log(self.spectrum.tau), np.log(self.spectrum.C)
        begin = Modes(1.0 / self.spectrum.E_inf, np.exp(np.interp(np.log(tau), *known)), tau)
        return regularised.smooth_modes(misfit, tau, self.strength, start or begin)

    def _beyond(self, loss: float, steps: Array) -> Array:
        """Draw the compliances of modes at distances (n,) in ln τ beyond the measurement, where S'' is `loss`."""
        walk = START * self.random.standard_normal() + WALK * math.sqrt(self.spacing) * np.cumsum(
            self.random.standard_normal(len(steps))
        )
        end = END * math.log(10.0) * self.random.standard_exponential()
        # S'' is π/2 of the density of C over ln τ, where that changes slowly.
        return np.asarray(2.0 / math.pi * loss * self.spacing * np.exp(walk) * (steps < end))
