"""Uncertainty of a whole material: bootstrap samples of spectrum and shift factors."""

from __future__ import annotations

import copy
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from viscofric.arguments import insist_on, text, whole_number
from viscofric.arrays import Array, Integers
from viscofric.data import MasterCurve
from viscofric.errors import InputError
from viscofric.notes import codes
from viscofric.rheology.material import Material
from viscofric.rheology.shifts import law_fitting
from viscofric.rheology.shifts.laws import VFT, Arrhenius, ParametricLaw, ShiftLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors, weights_between
from viscofric.rheology.shifts.vertical_shift import VerticalShift, VerticalShiftFactors
from viscofric.rheology.spectra import mode_fits
from viscofric.rheology.spectra.fit_verdict import STIFFEST_GLASS, Curve
from viscofric.rheology.spectra.misfit import (
    JointMisfit,
    Misfit,
    Modes,
    by_rate,
    frequencies_of,
    joint_misfit,
    misfit_of,
    moduli_of,
)
from viscofric.rheology.spectra.mode_fits import lattice, lattice_between, nonnegative_modes
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.spectra.spectrum_fit import as_spectrum, fit_retardation_spectrum
from viscofric.rheology.superposition.joint import JointSuperposition
from viscofric.rheology.superposition.result import StepSuperposition, Superposition
from viscofric.rheology.uncertainty.material_samples import (
    MaterialSamples,
    Residuals,
    SystematicMisfit,
    systematic_misfit,
)
from viscofric.threads import one_blas_thread
from viscofric.units import shown_celsius

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
SAME_TIME = 1e-6  # of ln τ
#: One of so many samples is fitted as the measurement was, and ends where that fit does.
ENDING = 3
#: The modes of the others go on for so many decades beyond the times that the measurement reaches.
BEYOND = 8.0
#: ln C starts from the density at the end of the measurement and falls with a slope over |ln τ|, towards short and long
#: times drawn from these limits: at 0 the loss compliance stays, at 1 it falls as beyond an end; …
SLOPES = ((-0.5, 1.0), (0.0, 1.0))
#: … with a random walk besides, of these standard deviations: of its start, and of its change over a factor of e in
#: time.
START, WALK = 0.5, 1.0
#: Faster modes than those of the fit are fitted too, up to a limit that differs from sample to sample.  Slower
#: ones are not: their compliance could grow without bound.
FURTHER = 1.5  # of ln τ
#: Modes beyond that contradict the sample are drawn again, so many times.
TRIES = 10


def beside(misfit: Misfit, given: NDArray[Any], least_glass: float) -> Misfit:
    """Return the misfit of modes beside others, whose compliance (P,) is given; a start leaves these out."""
    found = copy.copy(misfit)
    found.least_glass = least_glass
    found.residual = lambda compliance: misfit.residual(compliance + given)  # type: ignore[method-assign]
    found.jacobian = lambda compliance, change: misfit.jacobian(compliance + given, change)  # type: ignore[method-assign]
    return found


class Refit:
    """Fits samples of a master curve as a fitted spectrum was; InputError if it was not fitted.

    A sample that `ends` does so where the fit to the measurement does.  In the others the times of the lattice lie
    anywhere, and modes go on beyond those that the measurement reaches.  These are drawn from a wide distribution, on
    either side, and the rest are fitted beside them.  A draw is taken with the probability exp(−Δχ²/2), Δχ² the rise of
    the squared errors of the fit in units of their variance; else the modes are drawn again.

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
            self.tau = lattice_between((low - edge, high + edge), ratio, math.log(spectrum.tau[0]))
            away = np.abs(np.log(spectrum.tau)[:, None] - np.log(self.tau)).min(axis=1)
            # The slowest may lie between two times of the lattice.
            self.apart = np.array(spectrum.tau)[away > SAME_TIME]

    def __call__(self, misfit: Misfit, noise: Array, ends: bool = False) -> Modes:
        """Return the fitted modes, zeros included; `noise` (mN,) are the standard deviations of the logarithms."""
        tau = self._times(misfit, ends)
        found = self._fitted(misfit, tau, None)
        low, high = misfit.ends if self.tau is None else (math.log(tau.min()), math.log(tau.max()))
        steps = self.spacing * np.arange(1.0, math.ceil(BEYOND * math.log(10.0) / self.spacing) + 1.0)
        further = np.exp(np.concatenate([low - steps, high + steps]))
        relaxed, least = misfit.relaxed(further), np.sum((misfit.misses(found) / noise) ** 2)
        losses = -(1.0 / self.spectrum.complex_modulus(misfit.rates[[-1, 0]])).imag
        least_glass = min(misfit.least_glass, 1.0 / STIFFEST_GLASS)
        drawn = np.zeros((2, len(steps)))
        for side, loss in enumerate(losses):
            for _ in range(0 if ends else TRIES):
                trial, start = drawn.copy(), found
                trial[side] = self._beyond(SLOPES[side], float(loss), steps)
                if side == 0:  # of the fitted glass, down to one drawn anew
                    spent = found.glass - math.exp(self.random.uniform(math.log(least_glass), math.log(found.glass)))
                    trial[side] = np.diff(np.minimum(np.cumsum(trial[side]), spent), prepend=0.0)
                    start = replace(found, glass=found.glass - float(trial[side].sum()))
                rest = beside(misfit, relaxed @ trial.ravel(), least_glass)
                other = self._fitted(rest, tau, start)
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

    def _times(self, misfit: Misfit, ends: bool) -> Array:
        """Return the retardation times to begin with: a fit's lattice or one that lies anywhere, or sparse modes'."""
        if self.tau is None:
            return np.array(self.spectrum.tau)
        if ends:
            return np.append(lattice(misfit, math.exp(self.spacing)), self.apart)
        low, high = misfit.ends
        low -= FURTHER * self.random.uniform()
        through = high - self.spacing * self.random.uniform()
        tau = lattice_between((low, high), math.exp(self.spacing), through)
        return np.append(tau, self.apart)

    def _fitted(self, misfit: Misfit, tau: Array, start: Modes | None) -> Modes:
        if self.tau is None:
            begin = Modes(1.0 / self.spectrum.E_inf, np.array(self.spectrum.C), tau)
            return mode_fits.moved_modes(misfit, start or begin, tidy=False, converged=CONVERGED)
        if self.strength is None:
            return nonnegative_modes(misfit, tau, start, converged=CONVERGED)
        known = np.log(self.spectrum.tau), np.log(self.spectrum.C)
        begin = Modes(1.0 / self.spectrum.E_inf, np.exp(np.interp(np.log(tau), *known)), tau)
        return mode_fits.smooth_modes(misfit, tau, self.strength, start or begin)

    def _beyond(self, slopes: tuple[float, float], loss: float, steps: Array) -> Array:
        """Draw the compliances of modes at distances (n,) in ln τ beyond the measurement, where S'' is `loss`."""
        walk = START * self.random.standard_normal() + WALK * math.sqrt(self.spacing) * np.cumsum(
            self.random.standard_normal(len(steps))
        )
        # S'' is π/2 of the density of C over ln τ, where that changes slowly.
        return np.asarray(2.0 / math.pi * loss * self.spacing * np.exp(walk - self.random.uniform(*slopes) * steps))


Fit: TypeAlias = Superposition | StepSuperposition

FEWEST_SAMPLES = 20
#: Relative tolerance of the ranges that a spectrum states of its master curve; files round.
SAME = 1e-3


@one_blas_thread
def sample_materials(
    fit: Superposition | StepSuperposition | JointSuperposition,
    spectrum: RetardationSpectrum | None = None,
    *,
    samples: int = 200,
    seed: int = 0,
    law: str | None = None,
    poisson_ratio: float = 0.5,
    name: str = "",
) -> MaterialSamples:
    """Draw bootstrap samples of a material: those that repeated measurements of the same rubber might give.

    Parameters
    ----------
    fit : Superposition, StepSuperposition or JointSuperposition
        From `superpose`.
    spectrum : RetardationSpectrum, optional
        From `fit_retardation_spectrum` on its master curve; fitted here with non-negative modes if not given.
        Every sample is fitted the same way: non-negative, smooth of the same strength, or so many sparse modes.
    samples : int
        At least 20; the limits of 95 % bands are themselves uncertain by a tenth of the band with 200.
    seed : int
        Of the random numbers: the same seed gives the same samples.
    law : str, optional
        Kind of shift law (`ShiftFactors.law`) to be fitted in every sample, VFT as WLF, the same curve, Arrhenius in
        some samples as WLF (`Arrhenius.rivals`); the table itself if not given.
    poisson_ratio : float
        Of the materials.
    name : str
        Of the materials.

    Returns
    -------
    MaterialSamples

    Raises
    ------
    InputError
        If there are fewer than 20 samples, or the spectrum was not fitted to this master curve.

    Notes
    -----
    A bootstrap of the fit (B. Efron, R. Tibshirani, An Introduction to the Bootstrap, 1993, ch. 9).  In every
    sample the isotherms are moved by errors of their shifts, all at once from their covariance; the measured moduli get
    errors like the residuals of the fit (`Residuals`); and the spectrum is fitted anew.  Errors of the shifts and of
    the moduli about the curve are independent to first order, for in the least squares that find both they belong to
    orthogonal spaces.  Offsets of whole isotherms (`Superposition.offsets`) are drawn together with the errors of the
    shifts, which follow them; the size of offsets differs from sample to sample, by its own likelihood, for isotherms
    are few.

    What the measurement leaves open is drawn too (`Refit`): where the lattice of retardation times lies, and how
    the spectrum goes on beyond the times that the measurement reaches.  A third of the samples end there, as
    `spectrum` does.  The others have modes over eight more decades on either side.  Their density begins with that of
    the spectrum at the end and changes as a power of time, from one with which the loss falls as beyond an end to
    one with which it stays, towards the glass also to one with which it rises; a random walk is added.  Towards the
    glass they end when their compliance is used up, down to that of a glass drawn up to 20 GPa or 30 times the
    largest measured modulus.  Modes that contradict the sample are drawn again.  So bands hold `spectrum` itself and
    widen with the distance from what was measured (`benchmarks/rheology`).

    What the spectrum misses beyond noise, alike over neighbouring points, is not drawn either, for it has no
    distribution; `MaterialSamples.misfit` holds its size, by which the bands of E(ω) and of friction are widened.

    Not drawn are errors common to a whole measurement (of the sample's dimensions or the temperature scale), and what
    a fit cannot follow: sparse modes ripple about the truth, so that their 95 % bands of E'' held 90 % in planted
    tests; use the non-negative spectrum where the band matters.

    Examples
    --------
    >>> from importlib.resources import files
    >>> import viscofric as vf
    >>> path = files("viscofric") / "example" / "dma.csv"  # synthetic
    >>> sweeps = vf.read_dma(path, deformation="tension")
    >>> fit = vf.superpose(sweeps, reference="30 degC")
    >>> draws = vf.sample_materials(fit, samples=20, seed=1)
    >>> band = draws.modulus_band([1.0, 1e3])
    >>> bool((band.lower.real < band.upper.real).all())
    True
    """
    insist_on(fit, "fit", Superposition, StepSuperposition, JointSuperposition, right="what superpose(…) returned")
    insist_on(spectrum, "spectrum", RetardationSpectrum, type(None), right="a RetardationSpectrum or None")
    whole_number(samples, "samples", FEWEST_SAMPLES, 10**6)
    whole_number(seed, "seed", 0)
    text(name, "name")
    joint = fit if isinstance(fit, JointSuperposition) else None
    parts, alone = ((fit,), (fit,)) if not isinstance(fit, JointSuperposition) else (fit.parts, fit.alone)
    common, vertical = fit.shift_factors, fit.vertical_shift
    gains = joint.gains if joint else (np.eye(len(common.temperatures)),)
    spectrum = fit_retardation_spectrum(fit) if spectrum is None else spectrum
    if joint is None:
        _insist_on_same_curve(spectrum, parts[0].master_curve)
    random = np.random.default_rng(seed)
    errors: list[tuple[Array, Array | None, Array]] = []
    raised: Array | None = None
    for one in alone:
        found, raised = _errors(random, one, samples, raised)
        errors.append(found)
    moved = np.sum([error @ gain.T for (error, _, _), gain in zip(errors, gains, strict=True)], axis=0)
    tables = [ShiftFactors(common.temperatures, common.log10_values + row, common.reference) for row in moved]
    verticals: list[VerticalShift | None] = [vertical] * samples
    if isinstance(vertical, VerticalShiftFactors):
        fitted_too = errors[0][1]
        rows = normal_deviates(random, vertical.covariance, samples) if fitted_too is None else fitted_too
        rows = rows + vertical.log10_values
        verticals = [VerticalShiftFactors(vertical.temperatures, row, vertical.reference) for row in rows]
    laws: Sequence[ShiftLaw] = tables if law is None else _laws(random, common, moved, common.law(law))
    drawn = []
    for part, (_, _, offsets) in zip(parts, errors, strict=True):
        own = part.shift_factors.temperatures
        place = np.abs(own[:, None] - common.temperatures).argmin(axis=1)
        if vertical is not None:
            levels = np.array([b.log10(own) for b in verticals if b is not None]) - vertical.log10(own)
            offsets = offsets - levels[..., None]
        drawn.append(Resampled(random, part, spectrum, moved[:, place], offsets))
    ends = min(one.ends[0] for one in drawn), max(one.ends[1] for one in drawn)
    together = joint_misfit([part.master_curve for part in parts]) if joint else drawn[0].misfit
    refit = Refit(random.spawn(1)[0], spectrum, together, *ends)
    fitted = []
    for number in range(samples):
        misfits, noise = zip(*(one(number) for one in drawn), strict=True)
        sample = JointMisfit(misfits, together.free) if isinstance(together, JointMisfit) else misfits[0]
        fitted.append(refit(sample, np.concatenate(noise), number % ENDING == 0))
    materials = tuple(
        Material(as_spectrum(modes), shift, poisson_ratio, name, b)
        for modes, shift, b in zip(fitted, laws, verticals, strict=True)
    )
    assert spectrum.fit is not None  # `Refit` refuses others
    measured = spectrum.fit.frequency_range if joint else frequencies_of(parts[0].master_curve)
    missed = None if joint else _misfit(parts[0].master_curve, common, spectrum)
    return MaterialSamples(materials, *_on_lattice(refit, fitted), measured, missed, spectrum.fit.gaps)


def _on_lattice(refit: Refit, fitted: Sequence[Modes]) -> tuple[Array, Array]:
    """Return C and tau (samples, n) of modes at times that all samples have in common."""
    modes = [refit.on_lattice(one) for one in fitted]
    return np.array([one.C for one in modes]), np.array([one.tau for one in modes])


def _insist_on_same_curve(spectrum: RetardationSpectrum, curve: Curve) -> None:
    """Raise InputError if a spectrum was fitted to another curve, or moved to another temperature since."""
    if spectrum.fit is None:
        return  # `Refit` refuses it
    fitted, moduli = spectrum.fit.frequency_range, spectrum.fit.measured_storage
    rates, measured = frequencies_of(curve), moduli_of(curve)
    quantity, unit = ("E'", "rad/s") if isinstance(curve, MasterCurve) else ("moduli", "1/s")
    if not np.allclose(fitted, (rates[0], rates[-1]), rtol=SAME, atol=0.0):
        ranges = f"from {fitted[0]:.3g} to {fitted[1]:.3g} {unit}, the curve from {rates[0]:.3g} to {rates[-1]:.3g}"
    elif moduli is not None and not np.allclose(moduli, (measured.min(), measured.max()), rtol=SAME, atol=0.0):
        ends = f"the curve from {measured.min():.3g} to {measured.max():.3g}"
        ranges = f"with {quantity} from {moduli[0]:.3g} to {moduli[1]:.3g} Pa, {ends}"
    else:
        return
    raise InputError(
        f"the spectrum was not fitted to this master curve: it was fitted {ranges}; fit it to the superposition's own "
        f"master curve, at its reference, {shown_celsius(curve.reference)} °C.",
        code="other-master-curve",
    )


def _misfit(curve: Curve, shifts: ShiftFactors, spectrum: RetardationSpectrum) -> SystematicMisfit:
    """Return the misfit of the spectrum to the master curve beyond noise."""
    misfit = misfit_of(curve)
    residual = misfit.residual(misfit.compliance(spectrum)).reshape(-1, len(misfit.rates)).T / np.log(10.0)
    doubts = "" if spectrum.fit is None else " ".join(codes(spectrum.fit.doubts))
    causes = {"superposition-": "isotherms do not superpose", "kramers-kronig-": "E' and E'' contradict each other"}
    cause = next((words for code, words in causes.items() if code in doubts), "the spectrum cannot follow them")
    return systematic_misfit(np.log10(misfit.rates), residual, isotherm_of_points(curve, shifts), cause)


def normal_deviates(random: np.random.Generator, covariance: Array, samples: int) -> Array:
    """Draw normal deviates by the symmetric root of a covariance, which is the same on every machine."""
    values, vectors = np.linalg.eigh(0.5 * (covariance + covariance.T))
    root = (vectors * np.sqrt(np.maximum(values, 0.0))) @ vectors.T
    return np.asarray(random.standard_normal((samples, len(values))) @ root)


def _errors(
    random: np.random.Generator, fit: Fit, samples: int, raised: Array | None
) -> tuple[tuple[Array, Array | None, Array], Array | None]:
    """Draw errors of log10 α and of a fitted log10 b, and offsets (samples, isotherms, m), as they are correlated."""
    # `raised` (samples, 1), parts of a vertical shift that was left out, are returned too, and are those of all kinds.
    shifts, vertical = fit.shift_factors, fit.vertical_shift
    size = len(shifts.temperatures)
    covariance = shifts.covariance
    if fit.cross_covariance is not None and isinstance(vertical, VerticalShiftFactors):
        covariance = np.block([[covariance, fit.cross_covariance], [fit.cross_covariance.T, vertical.covariance]])
    count = len(covariance)
    left_out = None if fit.offsets is None else fit.offsets.left_out
    if left_out is not None:  # drawn apart, together with the levels that go with it
        covariance = covariance - np.outer(left_out.errors[0], left_out.errors[0])
    if fit.offsets is not None:
        shared = fit.offsets.with_shifts[:count]
        covariance = np.block([[covariance, shared], [shared.T, np.kron(fit.offsets.covariance, np.eye(size))]])
    errors = normal_deviates(random, covariance, samples)
    offsets = np.zeros((samples, size, 2 if isinstance(fit, Superposition) else 1))
    if fit.offsets is not None:
        errors = fit.offsets.resized(random.spawn(1)[0], errors)
        offsets = fit.offsets.of_moduli(errors[:, count:])
    moved = errors[:, :size]
    if left_out is not None:
        shift, level = left_out.errors
        raised = random.standard_normal((samples, 1)) if raised is None else raised
        moved, offsets = moved + raised * shift, offsets + (raised * level)[..., None]
    moved = moved - moved @ weights_between(shifts.temperatures, np.array([shifts.reference])).T
    return (moved, errors[:, size:count] if count > size else None, offsets), raised


#: Most draws of the misfit of a law, until it falls with temperature.
_TRIES = 100


def _laws(random: np.random.Generator, shifts: ShiftFactors, moved: Array, law: ParametricLaw) -> list[ShiftLaw]:
    """Return the law of every sample: its constants follow linearly from the errors of the shift factors."""
    # The misfit of the law is drawn too, again where a polynomial rises with temperature. A sample of VFT is the same
    # curve as WLF, whose C2 stays above zero, while T0 could come out above the reference.
    law = law.to_wlf() if isinstance(law, VFT) else law
    table = law_fitting.FactorTable.of(shifts.temperatures, shifts.log10_values, shifts.covariance, shifts.reference)
    degree = len(law.parameters) if law.kind == "polynomial" else None
    fitted, constants = law_fitting.fitted(law.kind, table, degree), law.parameters
    gain = table.gain(constants, law.gradient(shifts.temperatures), fitted.scatter)
    found: dict[int, ShiftLaw] = {}
    for last in (*[False] * _TRIES, True):
        left = [number for number in range(len(moved)) if number not in found]
        errors = (moved[left] + normal_deviates(random, fitted.misfit, len(left))) @ gain.T
        drawn = constants + errors if degree else constants * np.exp(errors / constants)
        for number, row in zip(left, drawn, strict=True):
            try:
                one = law.with_parameters(row)
            except InputError:
                if last:
                    raise
                continue
            found[number] = replace(one, fitted_range=law.fitted_range, bounded=law.bounded)
        if len(found) == len(moved):
            break
    laws = [found[number] for number in range(len(moved))]
    if not isinstance(law, Arrhenius) or law.rivals is None:
        return laws
    # Rivals take the place of some, by their weights, steeper or less steep by as much.
    weight, B, T0 = law.rivals.T
    steeper = np.array([one.activation_energy for one in laws if isinstance(one, Arrhenius)]) / law.activation_energy
    places = np.searchsorted(np.cumsum(weight), random.spawn(1)[0].uniform(size=len(laws)))
    return [
        one if place == len(B) else VFT(B[place] * steep, T0[place], law.reference).to_wlf()
        for one, steep, place in zip(laws, steeper, places, strict=True)
    ]
