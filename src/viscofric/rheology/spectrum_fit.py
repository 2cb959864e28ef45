"""Retardation spectrum from a master curve: non-negative modes, E' and E'' in equal relative measure."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import InputError
from viscofric.rheology.spectrum import RetardationSpectrum, SpectrumFit
from viscofric.threads import one_blas_thread

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.data import MasterCurve

    Array = NDArray[np.float64]
    Complex = NDArray[np.complex128]

#: Modes lie on the lattice of retardation times from (1/ω_max) / EDGE to EDGE / ω_min.  A mode further out
#: is not told from a plateau, nor from the flow of a liquid: its compliance could grow without bound.
EDGE = math.e
#: An end of the master curve is a plateau if the modulus is within this of its limit …
PLATEAU = 0.05
#: … and the loss tangent measured there is below this.
PLATEAU_LOSS_TANGENT = 0.1
ITERATIONS = 30
CONVERGED = 1e-6  # relative fall of the misfit
#: A modulus that is too small a part of the compliance to be seen is at most this.
STIFFEST = 1e3  # times the largest measured storage modulus
#: Organic glasses have a few times 10⁹ Pa.
STIFFEST_GLASS = 2e10  # Pa


@one_blas_thread
def fit_retardation_spectrum(master_curve: MasterCurve, *, tau_ratio: float = math.e) -> RetardationSpectrum:
    """Fit retardation modes C_k ≥ 0, E0 and E_inf to a master curve.

    Parameters
    ----------
    master_curve : MasterCurve
        At least four points.
    tau_ratio : float
        Ratio of neighbouring retardation times, above 1; e in the paper.

    Returns
    -------
    RetardationSpectrum
        At the master curve's reference, modes without compliance left out.  Its `fit` holds the misfit, and
        whether E0 and E_inf were measured or are extrapolated.

    Raises
    ------
    InputError
        If there are fewer than four points, or the ratio is not above 1.

    Notes
    -----
    The compliance is linear in 1/E_inf and C_k, so that relative errors of S (equally of E) are minimised by
    non-negative least squares (C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, 1974).  From there
    the sum of squares of the errors of ln E' and ln E'' is minimised by Gauss–Newton steps, each a
    non-negative least-squares problem.
    """
    if not (math.isfinite(tau_ratio) and tau_ratio > 1.0):
        raise InputError(f"tau_ratio = {tau_ratio!r}: must be above 1.")
    if len(master_curve) < 4:
        raise InputError(
            f"a master curve of {len(master_curve)} points is too short to fit a spectrum; give 4 or more."
        )
    tau = _lattice(master_curve.angular_frequency, tau_ratio)
    basis = np.concatenate(
        [
            np.ones((len(master_curve), 1), dtype=complex),
            1.0 / (1.0 + 1j * np.outer(master_curve.angular_frequency, tau)),
        ],
        axis=1,
    )
    measured = master_curve.complex_modulus
    strengths = _refined(basis, measured, _relative_start(basis, measured))
    strengths[0] = max(strengths[0], 1.0 / (STIFFEST * float(np.max(measured.real))))
    keep = strengths[1:] > 0.0
    C = strengths[1:][keep]
    spectrum = RetardationSpectrum(1.0 / float(strengths[0] + C.sum()), 1.0 / float(strengths[0]), C, tau[keep])
    return judged(spectrum, master_curve)


def _lattice(angular_frequency: Array, ratio: float) -> Array:
    """Return times on the fixed lattice ratio^k: frequencies shifted by the ratio give the same fit."""
    low = -math.log(float(angular_frequency[-1]) * EDGE) / math.log(ratio)
    high = math.log(EDGE / float(angular_frequency[0])) / math.log(ratio)
    return np.asarray(ratio ** np.arange(math.ceil(low), math.floor(high) + 1, dtype=float))


def _rows(matrix: Complex) -> Array:
    return np.concatenate([matrix.real, matrix.imag])


def _relative_start(basis: Complex, measured: Complex) -> Array:
    """Minimise Σ |S/S_measured − 1|²."""
    from scipy.optimize import nnls

    weighted = basis * measured[:, None]
    scale = np.linalg.norm(weighted, axis=0)  # columns of one size, so that no unit matters
    strengths, _ = nnls(_rows(weighted / scale), _rows(np.ones_like(measured)), maxiter=50 * basis.shape[1])
    return np.asarray(strengths / scale)


def _refined(basis: Complex, measured: Complex, strengths: Array) -> Array:
    """Minimise Σ (ln E'/E'_measured)² + (ln E''/E''_measured)² by non-negative Gauss–Newton steps."""
    from scipy.optimize import nnls

    target = np.concatenate([np.log(measured.real), np.log(measured.imag)])

    def misfit(trial: Array) -> Array:
        modulus = 1.0 / (basis @ trial)
        if not np.all((modulus.imag > 0) & (modulus.real > 0)):  # no mode at all: nothing to take a logarithm of
            return np.full(len(target), np.inf)
        return np.asarray(target - np.concatenate([np.log(modulus.real), np.log(modulus.imag)]))

    now = misfit(strengths)
    for _ in range(ITERATIONS):
        if not np.all(np.isfinite(now)):
            break
        modulus = 1.0 / (basis @ strengths)
        change = -(modulus**2)[:, None] * basis  # dE/d(strength)
        jacobian = np.concatenate([change.real / modulus.real[:, None], change.imag / modulus.imag[:, None]])
        scale = np.linalg.norm(jacobian, axis=0) + 1e-300
        aim, _ = nnls(jacobian / scale, now + jacobian @ strengths, maxiter=50 * basis.shape[1])
        step = aim / scale - strengths
        fraction, before = 1.0, float(now @ now)
        trial = misfit(strengths + step)
        while not trial @ trial < before and fraction > 1e-3:
            fraction *= 0.5
            trial = misfit(strengths + fraction * step)
        if not trial @ trial < before:
            break
        strengths, now = strengths + fraction * step, trial
        if before - float(now @ now) < CONVERGED * before:
            break
    return np.maximum(strengths, 0.0)


def judged(spectrum: RetardationSpectrum, master_curve: MasterCurve) -> RetardationSpectrum:
    """Return the spectrum with its `fit` judged against a master curve at the same temperature."""
    omega, measured = master_curve.angular_frequency, master_curve.complex_modulus
    modulus = spectrum.complex_modulus(omega)
    rms_storage = float(np.sqrt(np.mean(np.log10(modulus.real / measured.real) ** 2)))
    loss = modulus.imag[modulus.imag > 0.0], measured.imag[modulus.imag > 0.0]
    rms_loss = float(np.sqrt(np.mean(np.log10(loss[0] / loss[1]) ** 2))) if loss[0].size else math.inf
    low_loss, high_loss = _loss_tangent_at_ends(omega, master_curve.loss_tangent)
    fall = float(modulus.real[0]) / spectrum.E0 - 1.0
    rise = spectrum.E_inf / float(modulus.real[-1]) - 1.0
    rubber = fall > PLATEAU or low_loss > PLATEAU_LOSS_TANGENT
    glass = rise > PLATEAU or high_loss > PLATEAU_LOSS_TANGENT
    softest, stiffest = float(measured.real.min()), float(measured.real.max())
    above = (
        f"E0 = {spectrum.E0:.4g} Pa lies {_beside(spectrum.E0, softest)} the smallest measured E' ({softest:.4g} Pa)"
    )
    below = f"E_inf = {spectrum.E_inf:.4g} Pa lies {_beside(spectrum.E_inf, stiffest)} the largest measured E' "
    below += f"({stiffest:.4g} Pa)"
    notes = []
    if rubber:
        notes.append(
            f"{above}, and at the lowest frequency, {omega[0]:.3g} rad/s, tan δ is {low_loss:.2f}: the rubber plateau "
            "was not measured, so that E0 is extrapolated."
        )
    elif spectrum.E0 / softest > 1.0 + PLATEAU:
        notes.append(f"{above}: the fit does not follow the softest points.")
    if glass:
        notes.append(
            f"{below}, and at the highest frequency, {omega[-1]:.3g} rad/s, tan δ is {high_loss:.2f}: the glass was "
            "not measured, so that E_inf is extrapolated."
        )
    elif spectrum.E_inf < stiffest * (1.0 - PLATEAU):
        notes.append(f"{below}: the fit does not follow the stiffest points.")
    if spectrum.E_inf > STIFFEST_GLASS:
        notes.append(
            f"E_inf = {spectrum.E_inf:.4g} Pa is beyond any organic glass (a few 1e9 Pa); no rubber has such a glass, "
            "and the spectrum is not physical above the measured frequencies."
        )
    ends = (float(omega[0]), float(omega[-1]))
    fit = SpectrumFit(rms_storage, rms_loss, rubber, glass, ends, tuple(notes))
    return RetardationSpectrum(spectrum.E0, spectrum.E_inf, spectrum.C, spectrum.tau, fit)


def _beside(limit: float, measured: float) -> str:
    """Say how far a limit of the fit lies from the data's own."""
    if limit > 10.0 * measured:
        return f"{limit / measured:.0f} times above"
    if limit < 0.1 * measured:
        return f"{measured / limit:.0f} times below"
    return f"{100 * abs(limit / measured - 1.0):.1f} % {'above' if limit >= measured else 'below'}"


def _loss_tangent_at_ends(angular_frequency: Array, loss_tangent: Array) -> tuple[float, float]:
    """Median over the outermost half decade: single points are noisy."""
    low = angular_frequency <= angular_frequency[0] * math.sqrt(10.0)
    high = angular_frequency >= angular_frequency[-1] / math.sqrt(10.0)
    return float(np.median(loss_tangent[low])), float(np.median(loss_tangent[high]))
