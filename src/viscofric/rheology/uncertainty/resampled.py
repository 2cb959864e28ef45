"""Samples of master curves: points drawn as other measurements of the same material might have given them."""

from __future__ import annotations

import numpy as np

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
        self.misfit = misfit = whole.of(rates, whole.target.reshape(-1, len(rates)).T[order])
        away = misfit.residual(misfit.compliance(spectrum))
        self.logarithms = (misfit.target - away).reshape(-1, len(rates)).T
        away = away.reshape(-1, len(rates)).T
        fitted_shift = fit.shift_factors.standard_errors[isotherm] > 0.0
        leverage = _leverage(misfit, spectrum, np.where(fitted_shift, isotherm, -1)).reshape(-1, len(rates)).T
        if fit.offsets is not None:
            away = _without_offsets(away, isotherm, np.log(10.0) * fit.offsets.standard_deviations)
        residuals = Residuals(away, np.unique(isotherm, return_inverse=True)[1], leverage)
        self.rates = np.log(rates) + np.log(10.0) * moved[:, isotherm]
        self.errors = residuals.draw(random, len(moved)) + np.log(10.0) * levels[:, isotherm]

    @property
    def ends(self) -> tuple[float, float]:
        """The lowest and the highest rate of all samples, 1/s."""
        return float(np.exp(self.rates.min())), float(np.exp(self.rates.max()))

    def __call__(self, number: int) -> Misfit:
        """Return the misfit of one sample."""
        ascending = np.argsort(self.rates[number], kind="stable")
        values = (self.logarithms + self.errors[number])[ascending]
        return self.misfit.of(np.exp(self.rates[number][ascending]), values)


def _without_offsets(residual: Array, isotherm: Integers, offset: Array) -> Array:
    """Return residuals (N, m) minus the part of each isotherm's mean that is its offset, of standard deviation (m,).

    Offsets are drawn separately; in the residuals they would be taken for noise that is correlated along isotherms.
    """
    number = np.unique(isotherm, return_inverse=True)[1]
    count = np.bincount(number)[:, None]
    mean = np.stack([np.bincount(number, weights=column) for column in residual.T], axis=1) / count
    noise = np.mean((residual - mean[number]) ** 2, axis=0) / count
    return np.asarray(residual - (mean * offset**2 / (offset**2 + noise + 1e-300))[number])


def _leverage(misfit: Misfit, spectrum: RetardationSpectrum, isotherm: Integers) -> Array:
    """Return the part of each error that modes and shifts follow, (mN,): the diagonal of the linear fit's hat matrix.

    `isotherm` (N,) is the number of each point's isotherm, −1 where its shift was not fitted.
    """
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


class Refit:
    """Fits samples of a master curve as a fitted spectrum was, starting from it; InputError if it was not fitted.

    `like` is the misfit of the curve; `lowest` and `highest` are the ends of the angular frequencies of all samples,
    rad/s.  The lattice of times spans them, but each sample uses only its own part of it.
    """

    def __init__(self, spectrum: RetardationSpectrum, like: Misfit, lowest: float, highest: float) -> None:
        if spectrum.fit is None or not spectrum.fit.method or spectrum.fit.from_contact:
            raise InputError(
                "spectrum: was not fitted to a master curve, so that it cannot be fitted to samples of one; "
                "give what fit_retardation_spectrum returned.",
                code="not-fitted",
            )
        self.strength = spectrum.fit.regularisation
        self.on_lattice = spectrum.fit.tau_ratio is not None
        self.start = Modes(1.0 / spectrum.E_inf, np.array(spectrum.C), np.array(spectrum.tau))
        if spectrum.fit.tau_ratio is not None:
            tau = lattice_between(like.ends_of(lowest, highest), spectrum.fit.tau_ratio)
            away = np.abs(np.log(self.start.tau)[:, None] - np.log(tau)).min(axis=1)
            tau = np.sort(
                np.append(tau, self.start.tau[away > SAME])
            )  # the slowest may lie between two times of the lattice
            C = np.zeros(len(tau))
            C[np.abs(np.log(self.start.tau)[:, None] - np.log(tau)).argmin(axis=1)] = self.start.C
            self.start = Modes(self.start.glass, C, tau)

    def __call__(self, misfit: Misfit) -> Modes:
        """Return the fitted modes, always the same number, zeros included."""
        if not self.on_lattice:
            return sparse.moved_modes(misfit, self.start, tidy=False, converged=CONVERGED)
        low, high = misfit.ends
        inside = (np.log(self.start.tau) >= low) & (np.log(self.start.tau) <= high)
        start = Modes(self.start.glass, self.start.C[inside], self.start.tau[inside])
        if self.strength is not None:
            found = regularised.smooth_modes(misfit, start.tau, self.strength, start)
        else:
            found = nonnegative_modes(misfit, start.tau, start, converged=CONVERGED)
        C = np.zeros(len(self.start.tau))
        C[inside] = found.C
        return Modes(found.glass, C, self.start.tau)
