"""Smooth spectra: the curvature of ln C over ln τ is penalised, as strongly as the measurement allows."""

from __future__ import annotations

import numpy as np

from viscofric.arrays import Array, descend
from viscofric.rheology.spectra.modulus_misfit import STIFFEST, CurveMisfit, Misfit, Modes

#: Strengths tried, from too strong to too weak; each fit starts from the one before.
STRENGTHS = np.geomspace(1.0, 1e-5, 26)
FOLDS = 5
ITERATIONS = 60
CONVERGED = 1e-5  # relative fall of the objective
#: Starting spectrum, even in ln τ: a suitable start for any strength.
FIRST_STRENGTH_ITERATIONS = 200


def smooth_modes(misfit: Misfit, tau: Array, strength: float, start: Modes | None = None) -> Modes:
    """Minimise the misfit plus the roughness of the spectrum, at retardation times (n,) in geometric progression, s."""
    # With c = ln C, which keeps every C above zero, ⟨r²⟩ + λ² ∫ (d²c / d(ln τ)²)² d ln τ is minimised; ⟨r²⟩ is the mean
    # square of the errors of ln E' and ln E'', λ > 0 is `strength`. λ has the same meaning for any number of points and
    # any ratio of the times. A spectrum without roughness is a power law between sharp ends. `start` is at the same
    # times; its modes without compliance begin with their neighbour's.
    begin = _even(misfit, tau) if start is None else _continued(start)
    iterations = FIRST_STRENGTH_ITERATIONS if start is None else ITERATIONS
    relaxed = misfit.relaxed(tau)
    points = len(misfit.target)
    roughness = strength * _curvature(tau)
    penalty = roughness.T @ roughness
    floor = np.log(misfit.least_glass)

    def compliances(point: Array) -> Array:
        return np.asarray(np.exp(np.append(max(point[0], floor), point[1:])))

    def residual(point: Array) -> Array:
        values = compliances(point)
        away = misfit.residual(values[0] + relaxed @ values[1:])
        return np.concatenate([away / np.sqrt(points), -roughness @ point])

    def normal(point: Array, now: Array) -> tuple[Array, Array]:
        values = compliances(point)
        modes = relaxed * values[1:]
        change = np.concatenate([np.full((len(relaxed), 1), values[0], dtype=relaxed.dtype), modes], axis=1)
        jacobian = misfit.jacobian(values[0] + modes.sum(axis=1), change) / np.sqrt(points)
        return jacobian.T @ jacobian + penalty, jacobian.T @ now[:points] + roughness.T @ now[points:]

    found = compliances(descend(residual, normal, begin, iterations=iterations, tolerance=CONVERGED))
    return Modes(float(found[0]), found[1:], tau)


def _curvature(tau: Array) -> Array:
    """Return the matrix whose product with (ln glass, ln C) squares to ∫ (d² ln C / d(ln τ)²)² d ln τ."""
    spacing = float(np.mean(np.diff(np.log(tau))))
    second = np.diff(np.eye(len(tau)), 2, axis=0) / spacing**1.5
    return np.concatenate([np.zeros((len(second), 1)), second], axis=1)


def _even(misfit: Misfit, tau: Array) -> Array:
    """Return logarithms of the measured compliances at each mode's own frequency."""
    seen = np.interp(-np.log(tau), np.log(misfit.rates), np.log(misfit.sizes))
    spacing = min(1.0, float(np.mean(np.diff(np.log(tau)))))
    return np.append(np.log(STIFFEST * misfit.least_glass), np.log(0.3 * spacing) - seen)


def _continued(start: Modes) -> Array:
    known, times = start.C > 0.0, np.log(start.tau)
    return np.append(np.log(start.glass), np.interp(times, times[known], np.log(start.C[known])))


def path(misfit: Misfit, tau: Array) -> list[Modes]:
    """Return the fits at all `STRENGTHS`."""
    fits: list[Modes] = []
    for strength in STRENGTHS:
        fits.append(smooth_modes(misfit, tau, float(strength), fits[-1] if fits else None))
    return fits


def mean_square(misfit: Misfit, modes: Modes) -> float:
    """Return the mean square of the errors of ln E' and ln E''."""
    return float(np.mean(misfit.misses(modes) ** 2))


def corner(misfit: Misfit, fits: list[Modes]) -> int:
    """Return the index of the L-curve's corner (P. C. Hansen, D. P. O'Leary, SIAM J. Sci. Comput. 14 (1993) 1487)."""
    roughness = _curvature(fits[0].tau)[:, 1:]
    across = np.log([mean_square(misfit, modes) for modes in fits])
    up = np.log([float(np.sum((roughness @ np.log(modes.C)) ** 2)) + 1e-300 for modes in fits])
    slope = np.gradient(across), np.gradient(up)
    bend = slope[0] * np.gradient(slope[1]) - slope[1] * np.gradient(slope[0])
    bend /= (slope[0] ** 2 + slope[1] ** 2) ** 1.5 + 1e-12
    return 2 + int(np.argmin(bend[2:-2]))  # towards more roughness the curve turns clockwise


def cross_validated(misfit: CurveMisfit, tau: Array, isotherm: Array) -> int:
    """Return the index of the strength that best predicts isotherms left out of the fit."""
    # The isotherms, identified by the temperature (N,) of each point, are distributed over `FOLDS` folds in turn;
    # single points, if there are fewer isotherms. Points of one isotherm have common errors, so that leaving out single
    # ones would choose too weak a strength. Points beyond the frequencies of those that remain do not count: a fit
    # extrapolates there, whatever its strength.
    names, number = np.unique(isotherm, return_inverse=True)
    fold = (number if len(names) >= FOLDS else np.arange(len(isotherm))) % FOLDS
    logarithms = misfit.target.reshape(-1, len(misfit.rates)).T
    error = np.zeros(len(STRENGTHS))
    for left_out in range(FOLDS):
        used = fold != left_out
        ends = misfit.rates[used][[0, -1]]
        held = ~used & (misfit.rates >= ends[0]) & (misfit.rates <= ends[1])
        part = misfit.of(misfit.rates[used], logarithms[used])
        if held.any():
            check = misfit.of(misfit.rates[held], logarithms[held])
            error += [held.sum() * mean_square(check, modes) for modes in path(part, tau)]
    return int(np.argmin(error))
