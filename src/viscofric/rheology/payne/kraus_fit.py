"""Fit of Kraus's law to an amplitude sweep, and the range in which the sweep is linear."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viscofric.amplitudes import AmplitudeSweep
from viscofric.arguments import insist_on
from viscofric.arrays import Array
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.notes import Note
from viscofric.rheology.payne.kraus import CONSTANTS, KrausLaw, kraus_moduli
from viscofric.rheology.ramps.common_law import EQUALLY_LIKELY, CorrelatedSmoother, correlation, whitened
from viscofric.rheology.shifts.law_fitting import undetermined
from viscofric.rheology.shifts.parametric_law import student_factor
from viscofric.showing import Plotted, Rows, Shown, with_error
from viscofric.threads import one_blas_thread

#: Points that the constants of both moduli, six, need.
FEWEST = 6
#: Starting values of the exponent m; 0.4 to 0.7 is usual for carbon black (Kraus; 0.5 to 0.6).
EXPONENTS = (0.35, 0.6, 1.0)
#: Fits with the weights of both moduli found anew.
PASSES = 4
#: Logarithms of constants stay within this of the data.
WIDEST = math.log(1e4)
#: Scatter about the law above which it does not describe the sweep, decades; and so many times that about a smooth
#: curve, which one in fifty sweeps of Kraus's law and noise exceed, and 19 in 20 whose loss modulus is larger at small
#: amplitudes; smaller ones than the last, decades, are rounding.
LARGEST_SCATTER, _ROUGHER, _ROUNDING = 0.03, 3.0, 1e-3
#: Combinations of constants with less effect on the sweep than this part of the largest are not determined.
_UNSEEN = 1e-7
#: Parts of the storage modulus by whose fall a sweep's linear ranges are stated.
DROPS = (0.05, 0.1)
#: Fall below the smallest amplitude that widens linear ranges by more than a sixth: a fifth of the smaller drop.
LARGEST_FALL_BEFORE = 0.2 * DROPS[0]
#: Prior weights of the correlation of neighbours: zero is 29 times as likely as all other values together.  A dozen
#: amplitudes determine it poorly: with equal weights, errors of sweeps without correlation would be twice as large.
_SELDOM_CORRELATED = np.concatenate([[29.0 * EQUALLY_LIKELY[1:].sum()], EQUALLY_LIKELY[1:]])


@dataclass(frozen=True)
class LinearRange(Shown):
    """The amplitude up to which a sweep is linear.

    Parameters
    ----------
    drop : float
        By which part the storage modulus has fallen there, 0.05 or 0.1.
    strain : float
        The amplitude, a fraction; infinite where the modulus is not seen to fall as much within the sweep.
    standard_error : float
        Of the strain: the distance of the farthest one at which the modulus has fallen as much within its own standard
        error, from the scatter of the points.
    """

    drop: float
    strain: float
    standard_error: float

    def _shown(self) -> Rows:
        return (
            ("drop of the storage modulus", self.drop, "%"),
            ("at a strain of", self.strain, "%", self.standard_error),
        )

    def __str__(self) -> str:
        """Return the range as a line of text."""
        if not math.isfinite(self.strain):
            return f"the storage modulus is not seen to fall by {100 * self.drop:.0f} % within the sweep"
        return (
            f"the storage modulus has fallen by {100 * self.drop:.0f} % at a strain of "
            f"{with_error(100 * self.strain, 100 * self.standard_error)} %"
        )

    def to_dataset(self) -> Dataset:
        """Return ``drop``, ``strain`` and ``standard_error``, fractions, as single numbers."""
        return dataset(
            (),
            {
                "drop": (self.drop, "1", "relative drop of the storage modulus"),
                "strain": (self.strain, "1", "strain amplitude of that drop"),
                "standard_error": (self.standard_error, "1", "standard error of the strain amplitude"),
            },
        )


@dataclass(frozen=True, eq=False)
class PayneFit(Plotted):
    """The result of `fit_kraus`.

    Parameters
    ----------
    law : KrausLaw
        With the covariance of its constants, of which ±1.96 standard errors hold 95 % (see `fit_kraus`).
    sweep : AmplitudeSweep
        What it was fitted to.
    linear_ranges : tuple of LinearRange
        Where the storage modulus has fallen by 5 and by 10 %, found without the law.
    scatter : (float, float)
        Of log10 G' and of log10 G'' about the law, decades.
    notes : tuple of str
        What the reader noted, and what is doubtful about the law: one sentence each.
    """

    law: KrausLaw
    sweep: AmplitudeSweep
    linear_ranges: tuple[LinearRange, ...]
    scatter: tuple[float, float]
    notes: tuple[str, ...] = ()

    def _shown(self) -> Rows:
        return (
            ("linear storage modulus", self.law.storage_linear, "Pa"),
            ("critical strain", self.law.critical_strain, "%"),
            ("strain amplitude", self.sweep.strain_amplitude, "%"),
            ("scatter of the storage modulus", self.scatter[0], "decades"),
            ("of the loss modulus", self.scatter[1], "decades"),
            ("temperature", self.law.temperature, "°C"),
            ("notes", self.notes),
        )

    def to_dataset(self) -> Dataset:
        """Return the sweep as `AmplitudeSweep.to_dataset` does, with the law at its amplitudes.

        ``storage_fitted`` and ``loss_fitted`` (Pa) in addition; constants, their errors and linear ranges among the
        attributes.
        """
        found = self.sweep.to_dataset()
        fitted = self.law.complex_modulus(self.sweep.strain_amplitude)
        more = dataset(
            "strain_amplitude",
            {
                "storage_fitted": (fitted.real, "Pa", "storage modulus by Kraus's law"),
                "loss_fitted": (fitted.imag, "Pa", "loss modulus by Kraus's law"),
            },
        )
        constants = self.law.attributes
        for one in self.linear_ranges:
            constants[f"linear_strain_{100 * one.drop:.0f}_percent"] = one.strain
            constants[f"linear_strain_{100 * one.drop:.0f}_percent_error"] = one.standard_error
        return found.assign(more.data_vars).assign_attrs(constants)


@one_blas_thread
def fit_kraus(sweep: AmplitudeSweep) -> PayneFit:
    """Fit Kraus's law to an amplitude sweep, and find its linear range.

    Parameters
    ----------
    sweep : AmplitudeSweep
        Of at least six amplitudes.

    Returns
    -------
    PayneFit

    Raises
    ------
    InputError
        If there are fewer amplitudes.

    Notes
    -----
    Least squares of log G' and log G'', each with the weight of its own scatter; G' and G'' share γc and m, as Kraus
    derived.  The loss modulus of many compounds is larger at small amplitudes than the law says (J. D. Ulmer, Rubber
    Chem. Technol. 69 (1996) 15); its greater scatter then gives it a smaller weight.  Where a smooth curve misses the
    moduli three times less than the law, a note says so (`kraus-misfit`): 95 % intervals then held 75 % of γc and m,
    and 27 % of G''∞.

    The covariance is that of the scatter times (t/1.96)², t the 97.5 % quantile of Student's distribution for the
    degrees of freedom of the modulus that has fewer: ±1.96 standard errors hold 95 % as they are, and a factor t of
    one's own would count the few points twice.

    Errors of neighbouring amplitudes may be correlated, as by a load that drifts along the sweep: they are an
    autoregression of first order, whose coefficient follows from the restricted likelihood of the residuals.  A dozen
    amplitudes determine it poorly: in synthetic sweeps of 8 to 30 amplitudes, 95 % intervals of the constants hold 97 %
    where it is zero, 89 % where it is 0.5, and 86 % where it is 0.8; those of linear ranges 95, 88 and 70 %.

    The linear range is found from a smooth curve through log G' over log γ (a spline, smoothed by restricted maximum
    likelihood) relative to the smallest amplitude, without the law.  Where the modulus has fallen by more than 1 %
    before that amplitude, as the law extrapolates it, a note says so.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> law = vf.rheology.KrausLaw(6e6, 1.5e6, 0.02, 0.6, 9e5, 2e5, 62.8, 333.15, "shear")  # synthetic
    >>> strain = np.geomspace(1e-4, 0.5, 30)
    >>> G = law.complex_modulus(strain)
    >>> fit = vf.rheology.fit_kraus(vf.readers.AmplitudeSweep(strain, G.real, G.imag, "10 Hz", "60 degC", "shear"))
    >>> f"{fit.law.critical_strain:.4f}, {fit.law.exponent:.3f}"
    '0.0200, 0.600'
    """
    insist_on(sweep, "sweep", AmplitudeSweep, right="an AmplitudeSweep; read it with read_amplitude_sweep(…)")
    if len(sweep) < FEWEST:
        raise InputError(
            f"an amplitude sweep of {len(sweep)} amplitudes is too short; give {FEWEST} or more.", code="too-few-points"
        )
    logs, scatter, covariance = _fitted(sweep)
    constants = np.exp(logs)
    law = KrausLaw(
        **dict(zip(CONSTANTS, constants.tolist(), strict=True)),
        angular_frequency=sweep.angular_frequency,
        temperature=sweep.temperature,
        deformation=sweep.deformation,
        covariance=constants[:, None] * covariance * constants,
        strain_range=(float(sweep.strain_amplitude[0]), float(sweep.strain_amplitude[-1])),
    )
    ranges = tuple(linear_range(sweep, drop) for drop in DROPS)
    return PayneFit(
        law, sweep, ranges, (float(scatter[0]), float(scatter[1])), (*sweep.notes, *_doubts(sweep, law, scatter))
    )


def _doubts(sweep: AmplitudeSweep, law: KrausLaw, scatter: Array) -> list[Note]:
    notes: list[Note] = []
    letter = "G" if sweep.deformation == "shear" else "E"
    for mark, one, smooth in zip(("'", "''"), scatter, _smoother(sweep).scatter, strict=True):
        if one > min(LARGEST_SCATTER, max(_ROUGHER * smooth, _ROUNDING)):
            said = (
                f"Kraus's law misses {letter}{mark} by {one:.2g} decades (rms), a smooth curve by {smooth:.2g}; it "
                "describes it roughly only, and its constants may be off by more than their errors."
            )
            values = {"modulus": f"{letter}{mark}", "scatter": float(one), "smooth": float(smooth)}
            notes.append(Note("kraus-misfit", said, values=values))
    fall = sweep.storage_modulus.max() / sweep.storage_modulus[-1]
    if fall < 1.1:
        part = float(1.0 - 1.0 / fall)
        said = f"{letter}' falls by {100.0 * part:.0f} % only: the sweep does not determine the law."
        notes.append(Note("hardly-nonlinear", said, values={"fall": part}))
        return notes
    notes += undetermined(law, law.constants, law.covariance)
    first = float(sweep.strain_amplitude[0])
    before = 1.0 - float(law.complex_modulus(first).real) / law.storage_linear
    if before > LARGEST_FALL_BEFORE:
        said = (
            f"By Kraus's law {letter}' has fallen by {100.0 * before:.0f} % before the smallest amplitude, "
            f"{100.0 * first:.3g} %: the strains of the linear range, which are relative to the modulus there, are too "
            "large; measure from smaller amplitudes."
        )
        notes.append(Note("starts-nonlinear", said, values={"fall": before, "strain": first}))
    return notes


def _fitted(sweep: AmplitudeSweep) -> tuple[Array, Array, Array]:
    """Return the logarithms of the constants, the scatter of both moduli (decades), and the covariance."""
    from scipy.optimize import least_squares

    strain = sweep.strain_amplitude
    measured = np.log(np.stack([sweep.storage_modulus, sweep.loss_modulus]))
    low, high = measured.min(axis=1) - WIDEST, measured.max(axis=1) + WIDEST
    ends = np.log(strain[[0, -1]])
    bounds = (
        np.array([low[0], low[0], ends[0] - 3.0, math.log(0.05), low[1], low[1]]),
        np.array([high[0], high[0], ends[1] + 3.0, math.log(5.0), high[1], high[1]]),
    )
    scatter, alike = np.ones(2), 0.0
    same = np.ones(len(strain) - 1, dtype=bool)

    def away(logs: Array) -> Array:
        found = kraus_moduli(logs, strain)
        difference = np.log(np.stack([np.maximum(found.real, 1e-300), np.maximum(found.imag, 1e-300)])) - measured
        return np.asarray((whitened(difference.T, same, alike).T / scatter[:, None]).ravel())

    middle = float(np.log(strain[np.argmin(np.abs(measured[0] - measured[0].mean()))]))
    starts = [
        [measured[0, 0], measured[0, -1] - 0.1, critical, math.log(m), measured[1].max(), measured[1].min() - 0.2]
        for m in EXPONENTS
        for critical in (middle, float(ends[1]))
    ]
    best = min((least_squares(away, start, bounds=bounds) for start in starts), key=lambda one: float(one.cost))
    design = np.asarray(best.jac).reshape(2, len(strain), -1)
    alike = correlation(design, best.fun.reshape(2, -1), _SELDOM_CORRELATED)
    for _ in range(PASSES):
        residual = (best.fun.reshape(2, -1)) * scatter[:, None]
        scatter = np.maximum(np.sqrt(np.sum(residual**2, axis=1) / _freedom(np.asarray(best.jac))), 1e-9)
        best = least_squares(away, best.x, bounds=bounds)
    slope = np.asarray(best.jac)
    # Each constant in units of its own effect: a plateau far from the data, near zero, has hardly any on logarithms.
    unit = np.maximum(np.linalg.norm(slope, axis=0), 1e-12 * np.linalg.norm(slope))
    _, parts, modes = np.linalg.svd(slope / unit, full_matrices=False)
    back = modes.T / np.maximum(parts, _UNSEEN * parts[0]) / unit[:, None]
    # So that normal 95 % intervals are those of Student's t, by the freedom of the modulus that has less.
    wider = student_factor(float(_freedom(slope).min()))
    return best.x, scatter / math.log(10.0), wider**2 * back @ back.T


def _freedom(slope: Array) -> Array:
    """Return the degrees of freedom (2,) of the scatter of both moduli: points less what the constants take of each."""
    leverage = np.einsum("ij,ji->i", slope, np.linalg.pinv(slope, rcond=1e-12)).reshape(2, -1)
    return np.asarray(np.maximum(np.sum(1.0 - leverage, axis=1), 1.0))


def _smoother(sweep: AmplitudeSweep) -> CorrelatedSmoother:
    """Return smooth curves through log G' and log G'' over log γ, without a law."""
    moduli = np.log10(np.stack([sweep.storage_modulus, sweep.loss_modulus], axis=1))
    same = np.ones(len(sweep) - 1, dtype=bool)
    return CorrelatedSmoother.along(np.log10(sweep.strain_amplitude), moduli, same, _SELDOM_CORRELATED)


def linear_range(sweep: AmplitudeSweep, part: float) -> LinearRange:
    """Return the amplitude where the storage modulus has fallen by a part, from a smooth curve without a law."""
    logarithm, smoother = np.log10(sweep.strain_amplitude), _smoother(sweep)
    fine = np.linspace(logarithm[0], logarithm[-1], 2001)
    curves = smoother.curve(0, logarithm, np.log10(sweep.storage_modulus))[0]
    rows = smoother.basis.at(fine, orders=1)[0]
    rows = rows - rows[0]
    fallen = rows @ curves.coefficients[:, 0] - math.log10(1.0 - part)
    below = np.flatnonzero(fallen < 0.0)
    if not below.size:
        return LinearRange(part, math.inf, math.inf)
    place = int(below[0])
    spread = smoother.scatter[0] * np.sqrt(np.einsum("ij,jk,ik->i", rows, curves.inverse[0], rows))
    # The lowest strain at which it may have fallen so far, and the highest at which it may not have: where the curve
    # wavers before it falls, its slope where it crosses says little.
    strain = 10.0**fine
    low, high = strain[np.argmax(fallen < spread)], strain[np.flatnonzero(fallen >= -spread)[-1]]
    return LinearRange(part, float(strain[place]), float(max(strain[place] - low, high - strain[place])))
