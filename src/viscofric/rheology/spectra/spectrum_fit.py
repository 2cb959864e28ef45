"""Retardation spectrum from a master curve: non-negative, smooth or sparse modes; E' and E'' have equal weight."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Literal, TypeAlias

import numpy as np

from viscofric.arguments import whole_number
from viscofric.data import MasterCurve
from viscofric.errors import InputError, check_choice, wrong_argument
from viscofric.notes import Note
from viscofric.rheology.spectra import regularised, sparse
from viscofric.rheology.spectra.fit_verdict import Curve, judged, solid_modes
from viscofric.rheology.spectra.modulus_misfit import CurveMisfit, Misfit, Modes
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.rheology.spectra.sparse import lattice, nonnegative_modes
from viscofric.rheology.spectra.step_misfit import by_rate, frequencies_of, joint_misfit, misfit_of, rates_of
from viscofric.rheology.superposition.joint import JointSuperposition, level_note
from viscofric.rheology.superposition.result import Superposition
from viscofric.rheology.superposition.step_result import StepSuperposition
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
        At least four points; of a superposition its master curve is taken, of a joint one those of all kinds.  The
        level of the first kind is kept; a kind that overlaps it by half a decade has a level of its own, which a note
        states.
    tau_ratio : float
        Ratio of neighbouring retardation times, above 1; e in [1]_.  Without effect on sparse modes.
    method : {"non-negative", "regularised", "sparse"}
        Modes on a lattice of times, no more held down than that none is below zero; a smooth spectrum on the
        same lattice; or the fewest modes that meet an error, their times free.
    modes : int, optional
        For sparse modes: so many, or at most so many if `largest_error` is given too.
    regularisation : float or {"l-curve", "cross-validation"}, optional
        For a smooth spectrum: its strength λ (`regularised.smooth_modes`), or how to choose it: at the corner
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
    >>> spectrum = vf.fit_retardation_spectrum(fit.master_curve)
    >>> 20 < len(spectrum) < 40, spectrum.fit.rms_storage < 0.01  # decades
    (True, True)
    """
    tau_ratio = number(tau_ratio, "tau_ratio")
    if isinstance(master_curve, JointSuperposition):
        return _of_several(master_curve, method, tau_ratio, modes, regularisation, largest_error)
    curve = _curve_of(master_curve)
    _check(curve, method, tau_ratio, modes, regularisation, largest_error)
    fitted, strength, notes = _fitted(misfit_of(curve), curve, method, tau_ratio, modes, regularisation, largest_error)
    ratio = None if method == "sparse" else tau_ratio
    return judged(as_spectrum(fitted), curve, method=method, tau_ratio=ratio, regularisation=strength, notes=notes)


def _fitted(
    misfit: Misfit,
    low: Curve,
    method: Method,
    tau_ratio: float,
    modes: int | None,
    regularisation: float | str | None,
    largest_error: float | None,
) -> tuple[Modes, float | None, tuple[str, ...]]:
    """Return modes, the strength of regularisation, and notes; `low` is the curve that reaches the lowest rates."""
    dense = solid_modes(misfit, lattice(misfit, min(tau_ratio, math.e)), low)
    if method == "sparse":
        fitted, notes = _sparse(misfit, tau_ratio, modes, largest_error)
        return fitted, None, notes
    if method == "regularised":
        return _regularised(misfit, tau_ratio, low, regularisation)
    return dense if tau_ratio <= math.e else nonnegative_modes(misfit, lattice(misfit, tau_ratio)), None, ()


def _of_several(
    joint: JointSuperposition,
    method: Method,
    tau_ratio: float,
    modes: int | None,
    regularisation: float | Literal["l-curve", "cross-validation"] | None,
    largest_error: float | None,
) -> RetardationSpectrum:
    """Fit one spectrum to the master curves of several kinds of tests."""
    curves = [part.master_curve for part in joint.parts]
    for curve in curves:
        _check(curve, method, tau_ratio, None if modes is None else 1, regularisation, largest_error)
    misfit = joint_misfit(curves)
    low = curves[int(np.argmin([rates_of(curve)[0] for curve in curves]))]
    high = curves[int(np.argmax([frequencies_of(curve)[1] for curve in curves]))]
    # Cross-validation needs one curve.
    corner = "l-curve" if method == "regularised" and regularisation in (None, "cross-validation") else regularisation
    fitted, strength, notes = _fitted(misfit, low, method, tau_ratio, modes, corner, largest_error)
    spectrum = as_spectrum(fitted)
    levels = misfit.levels(misfit.compliance(spectrum))
    on_levels = [
        level_note(str(getattr(curve, "kind", "sweep")), float(level), joint.shift_factors.reference)
        for curve, level, free in zip(curves, levels, misfit.free, strict=True)
        if free and abs(level) > LEVEL_WORTH_A_NOTE
    ]
    at_level = [
        _at_level(curve, float(level) if free else 0.0)
        for curve, level, free in zip(curves, levels, misfit.free, strict=True)
    ]
    return judged(
        spectrum,
        *at_level,
        ends=(curves.index(low), curves.index(high)),
        method=method,
        tau_ratio=None if method == "sparse" else tau_ratio,
        regularisation=strength,
        notes=(*on_levels, *notes),
    )


def _at_level(curve: Curve, decades: float) -> Curve:
    """Return a curve with its moduli divided by a level."""
    if isinstance(curve, MasterCurve) or decades == 0.0:
        return curve
    return replace(curve, response=curve.response * 10.0 ** (decades if curve.kind == "creep" else -decades))


def _curve_of(given: object) -> Curve:
    curve = getattr(given, "master_curve", given)
    if not isinstance(curve, (MasterCurve, StepMasterCurve)):
        raise InputError(
            "a spectrum is fitted to a MasterCurve or StepMasterCurve, or to the Superposition that superpose(…) "
            f"returns, not to {type(given).__name__}.",
            code="wrong-type",
        )
    return curve


def as_spectrum(modes: Modes) -> RetardationSpectrum:
    """Return the spectrum of the modes with compliance."""
    keep = modes.C > 0.0
    C = modes.C[keep]
    return RetardationSpectrum(1.0 / (modes.glass + float(C.sum())), 1.0 / modes.glass, C, modes.tau[keep])


def _sparse(
    misfit: Misfit, tau_ratio: float, modes: int | None, largest_error: float | None
) -> tuple[Modes, tuple[str, ...]]:
    if modes is not None and largest_error is None:
        return sparse.few_modes(misfit, modes), ()
    dense = nonnegative_modes(misfit, lattice(misfit, tau_ratio))
    limit = ALLOWANCE * sparse.joint_error(misfit, dense) if largest_error is None else largest_error
    enough = max(1, min(max(int(np.count_nonzero(dense.C)), 2), len(misfit.rates) // POINTS_PER_MODE))
    fitted = sparse.fewest_modes(misfit, limit, enough if modes is None else modes)
    error = sparse.joint_error(misfit, fitted)
    if error <= limit:
        return fitted, ()
    note = Note(
        "error-not-reached",
        f"{len(fitted.C)} modes leave a joint rms error of {error:.3g} decades, above the requested {limit:.3g}; "
        f"the non-negative spectrum leaves {sparse.joint_error(misfit, dense):.3g}.",
        values={"modes": len(fitted.C), "error": float(error), "requested": float(limit)},
    )
    return fitted, (note,)


def _regularised(
    misfit: Misfit, tau_ratio: float, master_curve: Curve, regularisation: float | str | None
) -> tuple[Modes, float, tuple[str, ...]]:
    tau = lattice(misfit, tau_ratio)
    if len(tau) < LEAST_SMOOTH:
        raise InputError(
            f"a smooth spectrum needs {LEAST_SMOOTH} retardation times, and tau_ratio = {tau_ratio:g} puts only "
            f"{len(tau)} into the measured frequencies; give a smaller ratio, or method='non-negative'.",
            code="too-few-modes",
        )
    if not (regularisation is None or isinstance(regularisation, str)):
        return regularised.smooth_modes(misfit, tau, float(regularisation)), float(regularisation), ()
    fits = regularised.path(misfit, tau)
    if regularisation == "l-curve":
        place = regularised.corner(misfit, fits)
    else:
        assert isinstance(misfit, CurveMisfit)  # of several curves the L-curve is used
        place = regularised.cross_validated(misfit, tau, by_rate(master_curve))
    strength = float(regularised.STRENGTHS[place])
    if 0 < place < len(fits) - 1:
        return fits[place], strength, ()
    end = "largest" if place == 0 else "smallest"
    return fits[place], strength, (f"The strength of regularisation, {strength:.3g}, is the {end} that was tried.",)


def _check(
    master_curve: Curve,
    method: str,
    tau_ratio: float,
    modes: int | None,
    regularisation: float | str | None,
    largest_error: float | None,
) -> None:
    check_choice(method, "method", *METHODS)
    if positive(tau_ratio, "dimensionless", "tau_ratio") <= 1.0:
        raise wrong_argument("tau_ratio", tau_ratio, "must be above 1.", "out-of-range")
    if len(master_curve) < 4:
        raise InputError(
            f"a master curve of {len(master_curve)} points is too short to fit a spectrum; give 4 or more.",
            code="too-short",
        )
    if method != "sparse":
        for name, value in (("modes", modes), ("largest_error", largest_error)):
            if value is not None:
                raise InputError(
                    f"{name} = {value!r}: belongs to method='sparse', not to {method!r}.", code="other-method"
                )
    if method != "regularised" and regularisation is not None:
        raise InputError(
            f"regularisation = {regularisation!r}: belongs to method='regularised', not to {method!r}.",
            code="other-method",
        )
    if isinstance(regularisation, str) and regularisation not in ("l-curve", "cross-validation"):
        raise InputError(
            f"regularisation = {regularisation!r}: must be a number, 'l-curve' or 'cross-validation'.",
            code="wrong-choice",
        )
    if not (regularisation is None or isinstance(regularisation, str)):
        positive(regularisation, "dimensionless", "regularisation")
    if largest_error is not None:
        positive(largest_error, "dimensionless", "largest_error")
    most = max(1, len(master_curve) // POINTS_PER_MODE)
    if modes is not None:
        whole_number(modes, "modes", 1, most, f"a whole number from 1 to {most}, one for every 3 points")
