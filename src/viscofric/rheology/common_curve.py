"""All isotherms at once: shifts onto one smooth curve of E' and one of E'', with their covariance.

The unknown common curves are cubic splines of log E' and log E'' over log reduced frequency.  For given
shifts they follow by linear least squares, so only the shifts are sought (variable projection: G. H. Golub,
V. Pereyra, SIAM J. Numer. Anal. 10 (1973) 413; Kaufman's form of the derivative).  Every measured point
counts once, which is what makes the covariance of the shifts meaningful; pairwise overlaps would count it
repeatedly.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from viscofric.rheology.overlap import failures, typical_noise

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.rheology.overlap import Join, LogSweep

    Array = NDArray[np.float64]

#: A knot for every so many points, but not closer than so many decades: spectra have no sharper features.
POINTS_PER_KNOT = 5
KNOT_SPACING = 0.4
#: A plateau leaves a shift open; it then stays within some decades of where neighbours were first joined.
PRIOR = 3.0  # decades
LARGEST_STEP = 0.3  # decades, in one iteration
PASSES = 8  # each with knots placed anew
CONVERGED = 1e-5  # decades


@dataclass(frozen=True, eq=False)
class CommonShifts:
    """Shifts (n,), the first of them zero, and their covariance (n, n); in decades."""

    values: Array
    covariance: Array


@dataclass(frozen=True, eq=False)
class _Linearised:
    """What shifts give: whitened residuals (N, 2), their change with the shifts, gradient, normal matrix."""

    residual: Array
    change: list[Array]
    gradient: Array
    normal: Array
    curves: int


class _Problem:
    """The measured points of all isotherms, stacked, and the prior on the steps between neighbours."""

    def __init__(self, sweeps: list[LogSweep], joins: list[Join], noise: float) -> None:
        self.size = len(sweeps)
        self.isotherm = np.repeat(np.arange(self.size), [len(sweep) for sweep in sweeps])
        self.frequency = np.concatenate([sweep.frequency for sweep in sweeps])
        self.moduli = np.concatenate([sweep.moduli for sweep in sweeps])
        self.belongs = np.eye(self.size)[self.isotherm]
        self.steps = np.array([found.step for found in joins])
        self.noise = noise
        self.step_of = -np.diff(np.eye(self.size), axis=0)  # steps = step_of @ shifts

    def knots(self, shifts: Array) -> Array:
        """Place knots so that every interval holds measured points."""
        frequency = np.sort(self.frequency + shifts[self.isotherm])
        inner, last = [float(frequency[0])], 0
        for place in range(1, len(frequency) - POINTS_PER_KNOT):
            if place - last >= POINTS_PER_KNOT and frequency[place] - inner[-1] >= KNOT_SPACING:
                inner.append(float(0.5 * (frequency[place] + frequency[place - 1])))
                last = place
        degree = min(3, len(frequency) - 1)
        ends = np.ones(degree + 1)
        return np.concatenate([frequency[0] * ends, inner[1:], frequency[-1] * ends])

    def prior(self) -> Array:
        """Information on the shifts that the prior on the steps holds."""
        return np.asarray(self.step_of.T @ self.step_of / PRIOR**2)

    def cost(self, fit: _Linearised, shifts: Array) -> float:
        """Return what is minimised: whitened squares, of residuals and of steps away from the prior."""
        away = (self.step_of @ shifts - self.steps) / PRIOR
        return float(np.sum(fit.residual**2) + np.sum(away**2))

    def linearise(self, shifts: Array, knots: Array) -> _Linearised:
        """Fit the common curves at these shifts and say how the misfit changes with them."""
        from scipy.interpolate import BSpline

        frequency = self.frequency + shifts[self.isotherm]
        degree = 3 if len(knots) >= 8 else len(knots) // 2 - 1
        knots = knots.copy()  # the ends of the curve follow the outermost points
        knots[: degree + 1] = min(knots[0], frequency.min())
        knots[-degree - 1 :] = max(knots[-1], frequency.max())
        basis = BSpline.design_matrix(frequency, knots, degree).toarray() / self.noise
        left, inverse = _factors(basis)
        target = self.moduli / self.noise
        inside = left.T @ target
        residual = target - left @ inside
        curves = BSpline(knots, inverse @ inside, degree)
        slope = curves.derivative()(frequency) / self.noise
        change = []
        for modulus in range(2):
            moved = self.belongs * slope[:, modulus : modulus + 1]
            change.append(moved - left @ (left.T @ moved))
        gradient = sum(change[modulus].T @ residual[:, modulus] for modulus in range(2))
        normal = sum(moved.T @ moved for moved in change)
        away = self.step_of @ shifts - self.steps
        return _Linearised(
            residual,
            change,
            gradient - self.step_of.T @ away / PRIOR**2,
            normal + self.prior(),
            left.shape[1],
        )


def _factors(basis: Array) -> tuple[Array, Array]:
    """Return an orthonormal Q and the R⁺ that turns Qᵀy into coefficients, least-norm where undetermined."""
    left, upper = np.linalg.qr(basis)
    sizes = np.abs(np.diag(upper))
    if sizes.min() > 1e-9 * sizes.max():
        return left, np.linalg.inv(upper)
    left, values, right = np.linalg.svd(basis, full_matrices=False)
    keep = values > 1e-9 * values[0]
    return left[:, keep], right[keep].T / values[keep]


def common_shifts(sweeps: list[LogSweep], joins: list[Join]) -> CommonShifts:
    """Bring all isotherms onto one curve of log E' and one of log E''.

    Where neighbours disagree by many times what is typical, superposition itself fails, and one flexible
    curve would hide that by pulling them apart.  There each side gets its own curve, and the two are joined
    where the two neighbours overlap best, with that join's uncertainty.

    Parameters
    ----------
    sweeps : list of LogSweep
        Neighbours in temperature next to each other, each with at least two points.
    joins : list of Join
        Of each isotherm with the next: where to start, and how well they agree.

    Returns
    -------
    CommonShifts
        E' and E'' count equally; the covariance is found from the scatter that is left in each.
    """
    noise = typical_noise(joins)
    values, covariance = np.zeros(len(sweeps)), np.zeros((len(sweeps), len(sweeps)))
    start = 0
    for end in [*(place + 1 for place in failures(joins)), len(sweeps)]:
        if start > 0:  # hang this side onto the last isotherm of the side before
            before = joins[start - 1]
            values[start:end] = values[start - 1] - before.step
            covariance[start:end, :start] = covariance[start - 1, :start]
            covariance[:start, start:end] = covariance[start:end, :start].T
            covariance[start:end, start:end] = covariance[start - 1, start - 1] + min(before.uncertainty, PRIOR) ** 2
        if end - start > 1:
            problem = _Problem(sweeps[start:end], joins[start : end - 1], noise)
            shifts, spread = _solve(problem)
            values[start:end] += shifts
            covariance[start:end, start:end] += spread
        start = end
    return CommonShifts(values, covariance)


def _solve(problem: _Problem) -> tuple[Array, Array]:
    """Find the shifts of one problem, knots placed anew until they stay, and their covariance."""
    shifts = -np.concatenate([[0.0], np.cumsum(problem.steps)])
    for _ in range(PASSES):
        knots = problem.knots(shifts)
        before = shifts
        shifts = _descend(problem, shifts, knots)
        if np.max(np.abs(shifts - before)) < 10 * CONVERGED:
            break
    return shifts, _covariance(problem, shifts, knots)


def _descend(problem: _Problem, shifts: Array, knots: Array) -> Array:
    """Take damped Gauss–Newton steps with knots and weights held."""
    fit = problem.linearise(shifts, knots)
    for _ in range(5):
        step = np.zeros(problem.size)
        step[1:] = np.linalg.solve(fit.normal[1:, 1:], fit.gradient[1:])
        largest = float(np.max(np.abs(np.diff(step))))
        step *= min(1.0, LARGEST_STEP / max(largest, 1e-300))
        trial = problem.linearise(shifts + step, knots)
        while problem.cost(trial, shifts + step) > problem.cost(fit, shifts) and np.max(np.abs(step)) > CONVERGED:
            step *= 0.5
            trial = problem.linearise(shifts + step, knots)
        shifts, fit = shifts + step, trial
        if np.max(np.abs(step)) < CONVERGED:
            break
    return shifts


def _covariance(problem: _Problem, shifts: Array, knots: Array) -> Array:
    """Return the covariance of the shifts (the first one zero): observed information around real scatter.

    The second derivatives are differences of the exact gradient: the Gauss–Newton matrix takes the noise in
    the slope of the fitted curve for information, and gives bands that hold 89 % where 95 % are promised.
    The scatter is taken from each modulus by itself, and enlarged where neighbouring residuals of an
    isotherm are alike (a misfit rather than noise: n points then tell as much as n (1 − ρ)/(1 + ρ)
    independent ones).
    """
    fit = problem.linearise(shifts, knots)
    size = problem.size - 1
    reach = 2e-3
    hessian = np.empty((size, size))
    for column in range(size):
        move = np.zeros(problem.size)
        move[column + 1] = reach
        above = problem.linearise(shifts + move, knots).gradient
        below = problem.linearise(shifts - move, knots).gradient
        hessian[column] = (below - above)[1:] / (2.0 * reach)
    hessian = 0.5 * (hessian + hessian.T)
    information = fit.normal[1:, 1:]
    # Far from quadratic (a plateau), the Gauss–Newton matrix is the one that is surely positive.
    lowest = np.linalg.eigvalsh(np.linalg.solve(information, hessian) + np.linalg.solve(information, hessian).T)[0]
    if lowest < 0.4:
        hessian = information
    freedom = max(len(problem.frequency) - fit.curves - 0.5 * size, 1.0)
    scatter = problem.prior()[1:, 1:].copy()
    same = problem.isotherm[1:] == problem.isotherm[:-1]
    for modulus in range(2):
        residual, moved = fit.residual[:, modulus], fit.change[modulus][:, 1:]
        squares = float(residual @ residual)
        alike = float(np.sum((residual[1:] * residual[:-1])[same])) / squares if squares > 0.0 else 0.0
        inflation = (1.0 + alike) / (1.0 - alike) if alike > 0.0 else 1.0
        scatter += squares / freedom * inflation * (moved.T @ moved)
    inverse = np.linalg.inv(hessian)
    covariance = np.zeros((problem.size, problem.size))
    covariance[1:, 1:] = inverse @ scatter @ inverse
    return covariance
