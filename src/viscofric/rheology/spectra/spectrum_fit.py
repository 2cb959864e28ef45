"""Retardation spectrum from a master curve: non-negative, smooth or sparse modes; E' and E'' have equal weight."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, Literal, TypeAlias

import numpy as np

from viscofric.arguments import insist_on, whole_number
from viscofric.data import MasterCurve
from viscofric.errors import InputError, check_choice, wrong_argument
from viscofric.files import of_synthetic
from viscofric.notes import Note
from viscofric.rheology.spectra import mode_fits
from viscofric.rheology.spectra.fit_verdict import Curve, judged, solid_modes
from viscofric.rheology.spectra.misfit import (
    CurveMisfit,
    Misfit,
    Modes,
    by_rate,
    frequencies_of,
    joint_misfit,
    misfit_of,
    rates_of,
)
from viscofric.rheology.spectra.mode_fits import lattice, nonnegative_modes
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.superposition.joint import JointSuperposition, level_note
from viscofric.rheology.superposition.result import StepSuperposition, Superposed, Superposition
from viscofric.step_tests import StepMasterCurve
from viscofric.threads import one_blas_thread
from viscofric.units import number, positive

Method: TypeAlias = Literal["non-negative", "regularised", "sparse"]
METHODS = ("non-negative", "regularised", "sparse")
#: Factor by which the error of a sparse spectrum may exceed that of many modes, unless another error is requested.
ALLOWANCE = 1.05
#: A level of one kind of tests beside another is worth a note from here on.
LEVEL_WORTH_A_NOTE = 0.005  # decades
#: Curvature needs three neighbours; fewer than four are nearly a straight line.
LEAST_SMOOTH = 4
#: Fewest points per sparse mode, which has two parameters and affects two moduli.
POINTS_PER_MODE = 3


@one_blas_thread
def fit_retardation_spectrum(
    master_curve: MasterCurve | StepMasterCurve | Superposition | StepSuperposition | JointSuperposition,
    *,
    tau_ratio: float = math.e,
    method: Method = "non-negative",
    modes: int | None = None,
    regularisation: float | Literal["l-curve", "cross-validation"] | None = None,
    largest_error: float | None = None,
) -> RetardationSpectrum:
    """Fit retardation modes C_k ≥ 0, E0 and E_inf to a master curve.

    Parameters
    ----------
    master_curve : MasterCurve, StepMasterCurve, Superposition, StepSuperposition or JointSuperposition
        At least four points; of a superposition its master curve is taken, of a joint one those of all kinds, and where
        it does not hold, the notes of the fit and of all results from the material say so.  The level of the first kind
        is kept; a kind that overlaps it by half a decade has a level of its own, which a note states.
    tau_ratio : float
        Ratio of neighbouring retardation times, above 1; e in [1]_.  Without effect on sparse modes.
    method : {"non-negative", "regularised", "sparse"}
        Modes on a lattice of times, no more held down than that none is below zero; a smooth spectrum on the
        same lattice; or the fewest modes that meet an error, their times free.
    modes : int, optional
        For sparse modes: so many, or at most so many if `largest_error` is given too.
    regularisation : float or {"l-curve", "cross-validation"}, optional
        For a smooth spectrum: its strength λ (`mode_fits.smooth_modes`), or how to choose it: at the corner
        of the L-curve, or where isotherms left out of the fit are predicted best, which is the default.
    largest_error : float, optional
        For sparse modes: joint rms error √((E'² + E''²)/2) of log10 E' and log10 E'' to meet, decades; if
        neither this nor `modes` is given, 5 % above that of the non-negative spectrum.

    Returns
    -------
    RetardationSpectrum
        At the master curve's reference, modes without compliance left out.  Its `fit` holds the misfit,
        the method, and whether E0 and E_inf were measured or are extrapolated.

    Raises
    ------
    InputError
        If it is no master curve, there are fewer than four points, a setting is out of range, or it does not belong
        to the method.
    LiquidError
        If the curve ends in the flow of a liquid: over its lowest decade no spectrum with a plateau follows it to
        0.05 decades, and one that flows follows it more than twice as closely.

    Notes
    -----
    All methods minimise the sum of squares of the errors of ln E' and ln E'': relative errors, so that the
    rubber counts as much as the glass, and no unit matters.  Of creep and relaxation tests they minimise those of
    ln J(t) or ln E(t), in the same retardation modes: J(t) is linear in them, and E(t) follows by inversion of its
    Laplace transform 1/(s S(s)) (J. A. C. Weideman, SIAM J. Numer. Anal. 44 (2006) 2342, doi:10.1137/050625837).

    References
    ----------
    .. [1] C. Putignano, T. Reddyhoff, D. Dini, Tribol. Int. 100 (2016) 338–343.

    Examples
    --------
    >>> from importlib.resources import files
    >>> import viscofric as vf
    >>> path = files("viscofric") / "example" / "dma.csv"  # synthetic
    >>> sweeps = vf.read_dma(path, deformation="tension")
    >>> fit = vf.superpose(sweeps, reference="30 degC")
    >>> spectrum = vf.fit_retardation_spectrum(fit)
    >>> 20 < len(spectrum) < 40, spectrum.fit.rms_storage < 0.01  # decades
    (True, True)
    """
    asked = _Asked(method, number(tau_ratio, "tau_ratio"), modes, regularisation, largest_error)
    if isinstance(master_curve, JointSuperposition):
        return _with_doubts(_of_several(master_curve, asked), *master_curve.parts)
    curve = _curve_of(master_curve)
    asked.check(curve)
    fitted, strength, notes = asked.fitted(misfit_of(curve), curve)
    spectrum = judged(
        as_spectrum(fitted), curve, method=method, tau_ratio=asked.ratio, regularisation=strength, notes=notes
    )
    return _with_doubts(spectrum, master_curve)


def _with_doubts(spectrum: RetardationSpectrum, *tests: object) -> RetardationSpectrum:
    """Return the spectrum with notes on what is behind it: superpositions that do not hold, synthetic measurements."""
    joined = [one for one in tests if isinstance(one, Superposed) and one.isotherms]
    made_up = of_synthetic(note for one in tests for note in getattr(one, "notes", ()))  # also of ramps
    return spectrum.noted(*(note for one in joined for note in one.check.doubts), *made_up)


@dataclass(frozen=True)
class _Asked:
    """The choices of `fit_retardation_spectrum`."""

    method: Method
    tau_ratio: float
    modes: int | None
    regularisation: float | str | None
    largest_error: float | None

    @property
    def ratio(self) -> float | None:
        """Ratio of neighbouring times, where these are fixed."""
        return None if self.method == "sparse" else self.tau_ratio

    def check(self, master_curve: Curve) -> None:
        """Raise InputError for choices that are wrong, contradict each other or do not fit a curve."""
        method, regularisation = self.method, self.regularisation
        check_choice(method, "method", *METHODS)
        if positive(self.tau_ratio, "dimensionless", "tau_ratio") <= 1.0:
            raise wrong_argument("tau_ratio", self.tau_ratio, "must be above 1.", "out-of-range")
        if len(master_curve) < 4:
            raise InputError(
                f"a master curve of {len(master_curve)} points is too short to fit a spectrum; give 4 or more.",
                code="too-short",
            )
        for name, owner in (("modes", "sparse"), ("largest_error", "sparse"), ("regularisation", "regularised")):
            value = getattr(self, name)
            if value is not None and method != owner:
                words = f"belongs to method={owner!r}, not to {method!r}."
                raise wrong_argument(name, value, words, "other-method")
        if isinstance(regularisation, str) and regularisation not in ("l-curve", "cross-validation"):
            raise wrong_argument(
                "regularisation", regularisation, "must be a number, 'l-curve' or 'cross-validation'.", "wrong-choice"
            )
        if not (regularisation is None or isinstance(regularisation, str)):
            positive(regularisation, "dimensionless", "regularisation")
        if self.largest_error is not None:
            positive(self.largest_error, "dimensionless", "largest_error")
        most = max(1, len(master_curve) // POINTS_PER_MODE)
        if self.modes is not None:
            whole_number(self.modes, "modes", 1, most, f"a whole number from 1 to {most}, one for every 3 points")

    def fitted(self, misfit: Misfit, low: Curve) -> tuple[Modes, float | None, tuple[str, ...]]:
        """Return modes, the strength of regularisation, and notes; `low` is the curve that reaches the lowest rates."""
        dense = solid_modes(misfit, lattice(misfit, min(self.tau_ratio, math.e)), low)
        if self.method == "sparse":
            return self._sparse(misfit)
        if self.method == "regularised":
            return self._regularised(misfit, low)
        wide = self.tau_ratio > math.e
        return nonnegative_modes(misfit, lattice(misfit, self.tau_ratio)) if wide else dense, None, ()

    def _sparse(self, misfit: Misfit) -> tuple[Modes, None, tuple[str, ...]]:
        if self.modes is not None and self.largest_error is None:
            return mode_fits.few_modes(misfit, self.modes), None, ()
        dense = nonnegative_modes(misfit, lattice(misfit, self.tau_ratio))
        attained = mode_fits.joint_error(misfit, dense)
        limit = ALLOWANCE * attained if self.largest_error is None else self.largest_error
        enough = max(1, min(max(int(np.count_nonzero(dense.C)), 2), len(misfit.rates) // POINTS_PER_MODE))
        fitted = mode_fits.fewest_modes(misfit, limit, enough if self.modes is None else self.modes)
        error = mode_fits.joint_error(misfit, fitted)
        if error <= limit:
            return fitted, None, ()
        note = Note(
            "error-not-reached",
            f"{len(fitted.C)} modes leave a joint rms error of {error:.3g} decades, above the requested {limit:.3g}; "
            f"the non-negative spectrum leaves {attained:.3g}.",
            values={"modes": len(fitted.C), "error": float(error), "requested": float(limit)},
        )
        return fitted, None, (note,)

    def _regularised(self, misfit: Misfit, curve: Curve) -> tuple[Modes, float, tuple[str, ...]]:
        tau = lattice(misfit, self.tau_ratio)
        if len(tau) < LEAST_SMOOTH:
            raise InputError(
                f"a smooth spectrum needs {LEAST_SMOOTH} retardation times, and tau_ratio = {self.tau_ratio:g} puts "
                f"only {len(tau)} into the measured frequencies; give a smaller ratio, or method='non-negative'.",
                code="too-few-modes",
            )
        if not (self.regularisation is None or isinstance(self.regularisation, str)):
            strength = float(self.regularisation)
            return mode_fits.smooth_modes(misfit, tau, strength), strength, ()
        fits = mode_fits.path(misfit, tau)
        if self.regularisation == "l-curve" or not isinstance(misfit, CurveMisfit):  # cross-validation needs one curve
            place = mode_fits.corner(misfit, fits)
        else:
            place = mode_fits.cross_validated(misfit, tau, by_rate(curve))
        strength = float(mode_fits.STRENGTHS[place])
        if 0 < place < len(fits) - 1:
            return fits[place], strength, ()
        end = "largest" if place == 0 else "smallest"
        said = f"The strength of regularisation, {strength:.3g}, is the {end} that was tried."
        return fits[place], strength, (Note("regularisation-at-end", said, values={"strength": strength}),)


def _of_several(joint: JointSuperposition, asked: _Asked) -> RetardationSpectrum:
    """Fit one spectrum to the master curves of several kinds of tests."""
    curves = [part.master_curve for part in joint.parts]
    for curve in curves:
        replace(asked, modes=None if asked.modes is None else 1).check(curve)
    misfit = joint_misfit(curves)
    low = curves[int(np.argmin([rates_of(curve)[0] for curve in curves]))]
    high = curves[int(np.argmax([frequencies_of(curve)[1] for curve in curves]))]
    fitted, strength, notes = asked.fitted(misfit, low)
    spectrum = as_spectrum(fitted)
    levels = misfit.levels(misfit.compliance(spectrum)) * misfit.free
    on_levels = [
        level_note(str(getattr(curve, "kind", "sweep")), float(level), joint.shift_factors.reference)
        for curve, level in zip(curves, levels, strict=True)
        if abs(level) > LEVEL_WORTH_A_NOTE
    ]
    return judged(
        spectrum,
        *(_at_level(curve, float(level)) for curve, level in zip(curves, levels, strict=True)),
        ends=(curves.index(low), curves.index(high)),
        method=asked.method,
        tau_ratio=asked.ratio,
        regularisation=strength,
        notes=(*on_levels, *notes),
    )


def _at_level(curve: Curve, decades: float) -> Curve:
    """Return a curve with its moduli divided by a level."""
    if isinstance(curve, MasterCurve) or decades == 0.0:
        return curve
    return replace(curve, response=curve.response * 10.0 ** (decades if curve.kind == "creep" else -decades))


def _curve_of(given: object) -> Curve:
    curve: Any = getattr(given, "master_curve", given)
    right = "a MasterCurve or StepMasterCurve, or the Superposition that superpose(…) returns"
    insist_on(curve, "master_curve", MasterCurve, StepMasterCurve, right=right)
    return curve  # type: ignore[no-any-return]


def as_spectrum(modes: Modes) -> RetardationSpectrum:
    """Return the spectrum of the modes with compliance."""
    keep = modes.C > 0.0
    C = modes.C[keep]
    return RetardationSpectrum(1.0 / (modes.glass + float(C.sum())), 1.0 / modes.glass, C, modes.tau[keep])
