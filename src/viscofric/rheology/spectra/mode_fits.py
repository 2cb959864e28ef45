"""Spectra of few modes on a lattice of retardation times, or free; and smooth ones, whose curvature is penalised.

On a lattice non-negative least squares leave most modes zero; the number of modes at free times is the smallest that
meets an error.  The curvature of ln C over ln τ is penalised as strongly as the measurement allows.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscofric.arrays import Array, Slopes, Squares, descend, non_negative_fit
from viscofric.rheology.spectra.misfit import STIFFEST, CurveMisfit, Misfit, Modes

ACTIVE_SET_ITERATIONS = 30
ACTIVE_SET_CONVERGED = 1e-6  # relative fall of the misfit


def lattice(misfit: Misfit, ratio: float) -> Array:
    """Return times in a geometric progression about the middle of those that modes may have: it moves with the data."""
    return lattice_between(misfit.ends, ratio, sum(misfit.ends) / 2.0)


def lattice_between(ends: tuple[float, float], ratio: float, through: float) -> Array:
    """Return times in a geometric progression between two and through a third, given by their logarithms."""
    low, high = ((end - through) / math.log(ratio) for end in ends)
    return np.asarray(np.exp(through + math.log(ratio) * np.arange(math.ceil(low), math.floor(high) + 1, dtype=float)))


def nonnegative_modes(
    misfit: Misfit, tau: Array, start: Modes | None = None, *, converged: float = ACTIVE_SET_CONVERGED
) -> Modes:
    """Fit 1/E_inf ≥ 0 and C ≥ 0 at retardation times (n,) in s; stop at the relative fall `converged` of the misfit."""
    # The compliance is linear in 1/E_inf and C, so that relative errors of S (equally of E) are minimised by
    # non-negative least squares (C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, 1974). From there, or from
    # `start` at the same times, the sum of squares of the errors of ln E' and ln E'' is minimised by Gauss–Newton
    # steps, each a non-negative least-squares problem.
    columns = misfit.columns(tau)
    strengths = non_negative_fit(*misfit.relative(tau)) if start is None else np.append(start.glass, start.C)
    strengths = _refined(misfit, columns, strengths, converged)
    return Modes(max(float(strengths[0]), misfit.least_glass), strengths[1:], tau)


def _refined(misfit: Misfit, columns: NDArray[Any], strengths: Array, converged: float) -> Array:
    """Minimise Σ (ln E'/E'_measured)² + (ln E''/E''_measured)² by non-negative Gauss–Newton steps."""
    now = misfit.residual(columns @ strengths)
    for _ in range(ACTIVE_SET_ITERATIONS):
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


ITERATIONS = 40
CONVERGED = 1e-4  # relative fall of the sum of squares
#: A mode with less than this part of the compliance at its own frequency is left out.
NEGLIGIBLE = 1e-6
#: The search for the fewest modes changes their number in steps of this part of it.
STRIDES = 5
#: Modes whose times are closer than this are one.
SAME = 1e-3  # of ln τ


def joint_error(misfit: Misfit, modes: Modes) -> float:
    """Return √((rms E'² + rms E''²)/2) of the errors of log10 E' and log10 E'', decades."""
    away = misfit.misses(modes)
    return float(np.sqrt(np.mean(away**2))) / math.log(10.0)


def few_modes(misfit: Misfit, number: int) -> Modes:
    """Fit a number of modes of free retardation times, from evenly spaced ones over the measured frequencies."""
    low, high = -math.log(misfit.rates[-1]), -math.log(misfit.rates[0])
    ends = np.linspace(low, high, number + 1)
    start = nonnegative_modes(misfit, np.exp(0.5 * (ends[1:] + ends[:-1])))
    return moved_modes(misfit, start)


def moved_modes(misfit: Misfit, start: Modes, *, tidy: bool = True, converged: float = CONVERGED) -> Modes:
    """Refine the compliances and the retardation times of modes near the optimum."""
    # A mode's compliance begins at no less than a hundredth of 1/|E*| at its frequency. `tidy` sorts the modes, joins
    # those of one time and removes those that have vanished; `converged` is the relative fall of the sum of squares at
    # which to stop.
    number = len(start.tau)
    low, high = misfit.ends
    floor = 1e-2 / misfit.size_at(start.tau)
    begin = np.concatenate(
        [[math.log(start.glass)], np.log(np.maximum(start.C, floor)), np.clip(np.log(start.tau), low, high)]
    )

    def unpacked(point: Array) -> tuple[float, Array, Array]:
        glass = max(math.exp(point[0]), misfit.least_glass)
        return glass, np.exp(point[1 : number + 1]), np.exp(np.clip(point[number + 1 :], low, high))

    def at(point: Array) -> Squares:
        glass, C, tau = unpacked(point)
        relaxed = misfit.relaxed(tau)
        away = misfit.residual(glass + relaxed @ C)

        def slopes() -> Slopes:
            modes = relaxed * C
            glasses = np.full((len(relaxed), 1), glass, dtype=relaxed.dtype)
            change = np.concatenate([glasses, modes, misfit.moved(relaxed, C, tau)], 1)
            jacobian = misfit.jacobian(glass + modes.sum(axis=1), change)
            return jacobian.T @ away, jacobian.T @ jacobian

        return float(away @ away), slopes

    found = Modes(*unpacked(descend(at, begin, iterations=ITERATIONS, tolerance=converged)))
    return _tidied(misfit, found) if tidy else found


def _tidied(misfit: Misfit, modes: Modes) -> Modes:
    """Sort modes, join those of one time, and leave out those without compliance."""
    order = np.argsort(modes.tau, kind="stable")
    C, tau = modes.C[order], modes.tau[order]
    groups = np.concatenate([[0], np.cumsum(np.diff(np.log(tau)) > SAME)])
    joined = np.asarray(np.bincount(groups, weights=C), dtype=float)
    tau = np.exp(np.bincount(groups, weights=C * np.log(tau)) / joined)
    keep = joined * misfit.size_at(tau) > NEGLIGIBLE
    return Modes(modes.glass, joined[keep], tau[keep])


def fewest_modes(misfit: Misfit, largest_error: float, most: int) -> Modes:
    """Return the fit of fewest modes whose joint error is not above a given one, or of `most` modes if none is."""
    # The error falls with the number of modes. The search begins at one mode per decade, where it falls most steeply,
    # steps up or down until the answer is enclosed, and bisects.
    fits: dict[int, Modes] = {}

    def meets(number: int) -> bool:
        fits[number] = few_modes(misfit, number)
        return joint_error(misfit, fits[number]) <= largest_error

    decades = math.log10(misfit.rates[-1] / misfit.rates[0])
    number = min(max(round(decades), 1), most)
    stride = max(1, number // STRIDES)
    low, high = 0, most + 1  # too few, and enough
    while high - low > 1:
        if meets(number):
            high = number
            number = max(high - stride, (low + high) // 2)
        else:
            low = number
            number = min(low + stride, (low + high) // 2)
    return fits[min(high, most)]


#: Strengths tried, from too strong to too weak; each fit starts from the one before.
STRENGTHS = np.geomspace(1.0, 1e-5, 26)
FOLDS = 5
SMOOTHING_ITERATIONS = 60
SMOOTHING_CONVERGED = 1e-5  # relative fall of the objective
#: Starting spectrum, even in ln τ: a suitable start for any strength.
FIRST_SMOOTHING_ITERATIONS = 200


def smooth_modes(misfit: Misfit, tau: Array, strength: float, start: Modes | None = None) -> Modes:
    """Minimise the misfit plus the roughness of the spectrum, at retardation times (n,) in geometric progression, s."""
    # With c = ln C, which keeps every C above zero, ⟨r²⟩ + λ² ∫ (d²c / d(ln τ)²)² d ln τ is minimised; ⟨r²⟩ is the mean
    # square of the errors of ln E' and ln E'', λ > 0 is `strength`. λ has the same meaning for any number of points and
    # any ratio of the times. A spectrum without roughness is a power law between sharp ends. `start` is at the same
    # times; its modes without compliance begin with their neighbour's.
    begin = _even(misfit, tau) if start is None else _continued(start)
    iterations = FIRST_SMOOTHING_ITERATIONS if start is None else SMOOTHING_ITERATIONS
    relaxed = misfit.relaxed(tau)
    points = len(misfit.target)
    roughness = strength * _curvature(tau)
    penalty = roughness.T @ roughness
    floor = np.log(misfit.least_glass)

    def compliances(point: Array) -> Array:
        return np.asarray(np.exp(np.append(max(point[0], floor), point[1:])))

    def at(point: Array) -> Squares:
        values, rough = compliances(point), roughness @ point
        away = misfit.residual(values[0] + relaxed @ values[1:]) / np.sqrt(points)

        def slopes() -> Slopes:
            modes = relaxed * values[1:]
            change = np.concatenate([np.full((len(relaxed), 1), values[0], dtype=relaxed.dtype), modes], axis=1)
            jacobian = misfit.jacobian(values[0] + modes.sum(axis=1), change) / np.sqrt(points)
            return jacobian.T @ away - roughness.T @ rough, jacobian.T @ jacobian + penalty

        return float(away @ away + rough @ rough), slopes

    found = compliances(descend(at, begin, iterations=iterations, tolerance=SMOOTHING_CONVERGED))
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
