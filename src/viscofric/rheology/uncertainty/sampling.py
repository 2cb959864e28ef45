"""Uncertainty of a whole material: bootstrap samples of spectrum and shift factors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from viscofric.arguments import insist_on, text, whole_number
from viscofric.arrays import Array
from viscofric.data import MasterCurve
from viscofric.errors import InputError
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.laws import ParametricLaw, ShiftLaw
from viscofric.rheology.shifts.shift_factors import ShiftFactors, weights_between
from viscofric.rheology.shifts.vertical_shift import VerticalShift, VerticalShiftFactors
from viscofric.rheology.spectra.fit_verdict import Curve
from viscofric.rheology.spectra.modulus_misfit import Modes
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.spectra.spectrum_fit import as_spectrum, fit_retardation_spectrum
from viscofric.rheology.spectra.step_misfit import JointMisfit, frequencies_of, joint_misfit, misfit_of, moduli_of
from viscofric.rheology.superposition.joint import JointSuperposition
from viscofric.rheology.superposition.result import Superposition
from viscofric.rheology.superposition.step_result import StepSuperposition
from viscofric.rheology.uncertainty.material_samples import MaterialSamples
from viscofric.rheology.uncertainty.resampled import Refit, Resampled, isotherm_of_points
from viscofric.rheology.uncertainty.residuals import SystematicMisfit, systematic_misfit
from viscofric.threads import one_blas_thread
from viscofric.units import shown_celsius

Fit: TypeAlias = Superposition | StepSuperposition

FEWEST_SAMPLES = 20
#: Relative tolerance of the ranges that a spectrum states of its master curve; files round.
SAME = 1e-3
#: Negligible scatter of shift factors about a law, and scatter that explains any misfit; decades.
SCATTER = 1e-7, 10.0


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
        Kind of shift law (`ShiftFactors.law`) to be fitted in every sample; the table itself if not given.
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

    What the measurement leaves open is drawn too (`Refit`): where the lattice of retardation times lies, and the modes
    beyond the times that it reaches, to two decades on either side.  These have a wide distribution about the density
    of the spectrum at the end, and are drawn again where they contradict the sample.  Without them the bands would be
    too narrow at the ends of the measured frequencies and beyond (`benchmarks/rheology`).

    What the spectrum misses beyond noise, alike over neighbouring points, is not drawn either, for it has no
    distribution; `MaterialSamples.misfit` holds its size, by which the bands of E(ω) are widened.

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
    errors = [_errors(random, one, samples) for one in alone]
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
            raised = np.array([b.log10(own) for b in verticals if b is not None]) - vertical.log10(own)
            offsets = offsets - raised[..., None]
        drawn.append(Resampled(random, part, spectrum, moved[:, place], offsets))
    ends = min(one.ends[0] for one in drawn), max(one.ends[1] for one in drawn)
    together = joint_misfit([part.master_curve for part in parts]) if joint else drawn[0].misfit
    refit = Refit(random.spawn(1)[0], spectrum, together, *ends)
    fitted = []
    for number in range(samples):
        misfits, noise = zip(*(one(number) for one in drawn), strict=True)
        sample = JointMisfit(misfits, together.free) if isinstance(together, JointMisfit) else misfits[0]
        fitted.append(refit(sample, np.concatenate(noise)))
    materials = tuple(
        Material(as_spectrum(modes), shift, poisson_ratio, name, b)
        for modes, shift, b in zip(fitted, laws, verticals, strict=True)
    )
    assert spectrum.fit is not None  # `Refit` refuses others
    measured = spectrum.fit.frequency_range if joint else frequencies_of(parts[0].master_curve)
    missed = None if joint else _misfit(parts[0].master_curve, common, spectrum)
    return MaterialSamples(materials, *_on_lattice(refit, fitted), measured, missed)


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
    return systematic_misfit(np.log10(misfit.rates), residual, isotherm_of_points(curve, shifts))


def normal_deviates(random: np.random.Generator, covariance: Array, samples: int) -> Array:
    """Draw normal deviates by the symmetric root of a covariance, which is the same on every machine."""
    values, vectors = np.linalg.eigh(0.5 * (covariance + covariance.T))
    root = (vectors * np.sqrt(np.maximum(values, 0.0))) @ vectors.T
    return np.asarray(random.standard_normal((samples, len(values))) @ root)


def _errors(random: np.random.Generator, fit: Fit, samples: int) -> tuple[Array, Array | None, Array]:
    """Draw errors of log10 α and of a fitted log10 b, and offsets (samples, isotherms, m), as they are correlated."""
    shifts, vertical = fit.shift_factors, fit.vertical_shift
    size = len(shifts.temperatures)
    covariance = shifts.covariance
    if fit.cross_covariance is not None and isinstance(vertical, VerticalShiftFactors):
        covariance = np.block([[covariance, fit.cross_covariance], [fit.cross_covariance.T, vertical.covariance]])
    count = len(covariance)
    if fit.offsets is not None:
        shared = fit.offsets.with_shifts[:count]
        covariance = np.block([[covariance, shared], [shared.T, np.kron(fit.offsets.covariance, np.eye(size))]])
    errors = normal_deviates(random, covariance, samples)
    offsets = np.zeros((samples, size, 2 if isinstance(fit, Superposition) else 1))
    if fit.offsets is not None:
        errors = fit.offsets.resized(random.spawn(1)[0], errors)
        offsets = fit.offsets.of_moduli(errors[:, count:])
    moved = errors[:, :size]
    moved = moved - moved @ weights_between(shifts.temperatures, np.array([shifts.reference])).T
    return moved, errors[:, size:count] if count > size else None, offsets


def _laws(random: np.random.Generator, shifts: ShiftFactors, moved: Array, law: ParametricLaw) -> list[ShiftLaw]:
    """Return the law of every sample: its constants follow linearly from the errors of the shift factors."""
    # The law's own covariance shows the scatter of the table about it beyond its uncertainty (`ShiftFactors.law`); this
    # scatter is drawn too.
    differences = np.diff(np.eye(len(shifts.temperatures)), axis=0)
    gradient = differences @ law.gradient(shifts.temperatures)
    constants = law.parameters
    scale = np.abs(constants) + 1e-300

    def covariance_and_gain(scatter: float) -> tuple[Array, Array]:
        spread = differences @ (shifts.covariance + scatter**2 * np.eye(len(shifts.temperatures))) @ differences.T
        weighted = np.linalg.solve(spread, gradient * scale)
        covariance = np.linalg.inv(weighted.T @ (gradient * scale))
        return np.asarray(covariance), np.asarray(covariance @ weighted.T @ differences)

    wanted = np.linalg.slogdet(np.asarray(law.covariance) / np.outer(scale, scale))[1]
    low, high = np.log(SCATTER)
    for _ in range(50):
        middle = 0.5 * (low + high)
        above = np.linalg.slogdet(covariance_and_gain(float(np.exp(middle)))[0])[1] > wanted
        low, high = (low, middle) if above else (middle, high)
    scatter = float(np.exp(low))
    gain = covariance_and_gain(scatter)[1]
    errors = (moved + scatter * random.standard_normal(moved.shape)) @ gain.T
    drawn = constants * np.exp(errors) if np.all(constants > 0.0) else constants + scale * errors
    # A sample is valid at the same temperatures as the law.
    return [replace(law.with_parameters(row), fitted_range=law.fitted_range, bounded=law.bounded) for row in drawn]
