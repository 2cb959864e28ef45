"""Spectra on a lattice of retardation times by non-negative least squares: most modes are zero."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.arrays import non_negative_fit
from viscofric.rheology.spectra.modulus_misfit import Modes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.arrays import Array
    from viscofric.rheology.spectra.modulus_misfit import Misfit


ITERATIONS = 30
CONVERGED = 1e-6  # relative fall of the misfit


def lattice(misfit: Misfit, ratio: float) -> Array:
    """Return times on the fixed lattice ratio^k: frequencies shifted by the ratio give the same fit."""
    return lattice_between(misfit.ends, ratio)


def lattice_between(ends: tuple[float, float], ratio: float) -> Array:
    """Return the times ratio^k between two, given by their logarithms."""
    low, high = (end / math.log(ratio) for end in ends)
    return np.asarray(ratio ** np.arange(math.ceil(low), math.floor(high) + 1, dtype=float))


def nonnegative_modes(misfit: Misfit, tau: Array, start: Modes | None = None, *, converged: float = CONVERGED) -> Modes:
    """Fit 1/E_inf ≥ 0 and C ≥ 0 at retardation times (n,) in s, until the relative fall of the misfit is `converged`.

    The compliance is linear in 1/E_inf and C, so that relative errors of S (equally of E) are minimised by
    non-negative least squares (C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, 1974).  From there, or
    from `start` at the same times, the sum of squares of the errors of ln E' and ln E'' is minimised by Gauss–Newton
    steps, each a non-negative least-squares problem.
    """
    columns = misfit.columns(tau)
    strengths = _relative_start(misfit, tau) if start is None else np.append(start.glass, start.C)
    strengths = _refined(misfit, columns, strengths, converged)
    return Modes(max(float(strengths[0]), misfit.least_glass), strengths[1:], tau)


def _relative_start(misfit: Misfit, tau: Array) -> Array:
    """Minimise Σ |S/S_measured − 1|²."""
    return non_negative_fit(*misfit.relative(tau))


def _refined(misfit: Misfit, columns: NDArray[Any], strengths: Array, converged: float) -> Array:
    """Minimise Σ (ln E'/E'_measured)² + (ln E''/E''_measured)² by non-negative Gauss–Newton steps."""
    now = misfit.residual(columns @ strengths)
    for _ in range(ITERATIONS):
        if not np.all(np.isfinite(now)):
            break
        jacobian = misfit.jacobian(columns @ strengths, columns)
        least = np.zeros(len(strengths))
        least[0] = misfit.least_glass if misfit.glass_within else 0.0
        step = non_negative_fit(jacobian, now + jacobian @ (strengths - least)) + least - strengths
        fraction, before = 1.0, float(now @ now)
        trial = misfit.residual(columns @ (strengths + step))
        while not trial @ trial < before and fraction > 1e-3:
            fraction *= 0.5
            trial = misfit.residual(columns @ (strengths + fraction * step))
        if not trial @ trial < before:
            break
        strengths, now = strengths + fraction * step, trial
        if before - float(now @ now) < converged * before:
            break
    return np.maximum(strengths, 0.0)
