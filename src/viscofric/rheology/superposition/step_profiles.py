"""How far each step of log10 α may go before the measurement contradicts it: profiles of the likelihood.

The curvature at the end of a search shows neither a second minimum nor a plateau beyond a small dip.  So each step is
moved over all that leaves the two sides overlapping, the other shifts following; the ends of its 95 % interval are
where the likelihood has fallen as far as 1.96 standard errors of a parabola (D. J. Venzon, S. H. Moolgavkar, Appl.
Statist. 37 (1988) 87).  Curves, offsets of isotherms and vertical shifts are integrated over, so that isotherms which
are pulled apart gain nothing from the freedom of their curves.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.rheology.superposition.common_curve import KNOT_SPACING, RIDGE, penalty_of
from viscofric.rheology.superposition.overlap import LEVEL_95, allowed_half_width, steps_that_overlap

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.rheology.superposition.common_curve import Smoother
    from viscofric.rheology.superposition.overlap import LogSweep
    from viscofric.rheology.superposition.shift_problem import ShiftProblem

    Array = NDArray[np.float64]

#: A profile is followed from so many standard errors on, in distances that double, until it is excluded …
NEAR = 3.0
#: … and from there in steps of so many decades over all that leaves an overlap; but not where a step is known to this,
#: since sweeps that fix a step so well join nowhere else.
COARSE = 0.4
SHARP = 0.03
#: Excluded is what lies so many times the threshold below the best.
EXCLUDED = 1.5
#: Ends of an interval are sought so many times between distances that were tried.
HALVINGS = 3
#: Variances of steps below this, decades², are those of steps that are held.
SMALLEST = 1e-18
#: Knots beyond the shifted points, decades.
BEYOND = 1.0


class StepProfiles:
    """−2 log of the likelihood of shifts, with curves and levels of isotherms integrated over.

    Parameters
    ----------
    problem, smoothers
        At the end of the search.
    sweeps : list of LogSweep
        What the problem was made of.
    levels : (m n, m n) array
        Covariance of levels of the m moduli of n isotherms: offsets and vertical shifts; decades².
    """

    def __init__(self, problem: ShiftProblem, smoothers: list[Smoother], sweeps: list[LogSweep], levels: Array) -> None:
        self.problem = problem
        self.smoothers = smoothers
        self.sweeps = sweeps
        self.middle = [piece.moduli.mean(axis=0) for piece in problem.pieces]
        self.knots: dict[int, tuple[Array, Array]] = {}
        values, vectors = np.linalg.eigh(levels)
        self.root = vectors * np.sqrt(np.maximum(values, 0.0))

    def widened(self, parameters: Array, inverse: Array, noise: Array, covariance: Array) -> Array:
        """Return the covariance (p, p) with the variance that profiles of the steps add.

        Parameters
        ----------
        parameters : (p,) array
            What was found.
        inverse, noise, covariance : (p, p) array
            The inverse of the curvature, the covariance that the scatter of the points makes with it, and the whole.
        """
        size = self.problem.size
        broken = {piece.last - 1 for piece in self.problem.pieces}
        best = self(parameters)
        more = np.zeros_like(covariance)
        for place in range(size - 1):
            step = np.zeros(len(parameters))
            step[place], step[place + 1] = 1.0, -1.0
            curvature = float(step @ inverse @ step)
            if place in broken or curvature < SMALLEST:
                continue
            follow = inverse @ step / curvature
            variance = float(step @ covariance @ step)
            threshold = LEVEL_95**2 * float(step @ noise @ step) / curvature
            half = self._half_width(parameters, follow, place, np.sqrt(variance), best, threshold)
            more += max((half / LEVEL_95) ** 2 - variance, 0.0) * np.outer(follow, follow)
        return covariance + more

    def _half_width(
        self, parameters: Array, follow: Array, place: int, error: float, best: float, threshold: float
    ) -> float:
        """Return half of the interval of one step."""
        now = float(parameters[place] - parameters[place + 1])
        lowest, highest = steps_that_overlap(self.sweeps[place], self.sweeps[place + 1])
        moves, falls = [0.0], [best]
        for side, far in ((-1.0, max(now - lowest, 0.0)), (1.0, max(highest - now, 0.0))):
            move = min(NEAR * error, far)
            while move > 0.0:
                moves.append(side * move)
                falls.append(self(parameters + side * move * follow))
                excluded = falls[-1] - best > EXCLUDED * threshold
                if move >= far or (excluded and error < SHARP):
                    break
                move = min(move + COARSE if excluded else 2.0 * move, far)
        for _ in range(HALVINGS):  # of gaps that the interval ends in, beyond what a parabola makes
            order = np.argsort(moves)
            sorted_moves, rise = np.array(moves)[order], np.array(falls)[order] - min(falls)
            allowed = np.flatnonzero(rise <= threshold)
            gaps = (allowed[0] - 1, allowed[0]), (allowed[-1], allowed[-1] + 1)
            ends = [(sorted_moves[low], sorted_moves[high]) for low, high in gaps if low >= 0 and high < len(rise)]
            halves = [0.5 * (low + high) for low, high in ends if 0.0 not in (low, high)]
            moves += halves
            falls += [self(parameters + half * follow) for half in halves]
        order = np.argsort(moves)
        rise = np.array(falls)[order]
        return allowed_half_width(np.array(moves)[order], rise - rise.min(), threshold)

    def __call__(self, parameters: Array) -> float:
        """Return −2 log of the likelihood, but for a constant."""
        problem, size = self.problem, self.problem.size
        shifts = parameters[:size]
        expected = np.zeros(len(parameters))  # vertical shifts are among the levels
        expected[:size] = shifts
        away = problem.wanted - problem.prior @ expected
        moduli = problem.pieces[0].moduli.shape[1]
        total = float(away @ away)
        left, wish = np.zeros((moduli * size, moduli * size)), np.zeros(moduli * size)
        for number, (piece, smoother) in enumerate(zip(problem.pieces, self.smoothers, strict=True)):
            frequency, values, weights = piece.reduced(shifts, np.zeros(size))
            root = np.sqrt(weights)[:, None]
            basis, penalty = self._basis(number, frequency, smoother.degree)
            basis, values = basis * root, (values - self.middle[number]) * root
            square = basis.T @ basis
            square[np.diag_indices(len(square))] += RIDGE * np.trace(square) / len(square)
            factors = np.linalg.cholesky(square + smoother.smoothing[:, None, None] * penalty)
            known = np.concatenate([piece.gathered(basis * root).T, basis.T @ values], axis=1)
            inner = np.linalg.solve(factors, known)
            level, count = piece.gathered(values * root), piece.gathered(weights)
            for modulus, scatter in enumerate(smoother.scatter):
                levels, value = inner[modulus, :, : piece.size], inner[modulus, :, piece.size + modulus]
                total += float(values[:, modulus] @ values[:, modulus] - value @ value) / scatter**2
                total += _log_determinant(factors[modulus])
                own = slice(modulus * size + piece.first, modulus * size + piece.last)
                left[own, own] += (np.diag(count) - levels.T @ levels) / scatter**2
                wish[own] += (level[:, modulus] - levels.T @ value) / scatter**2
        factor = np.linalg.cholesky(np.eye(self.root.shape[1]) + self.root.T @ left @ self.root)
        gained = np.linalg.solve(factor, self.root.T @ wish)
        return total + _log_determinant(factor) - float(gained @ gained)

    def _basis(self, number: int, frequency: Array, degree: int) -> tuple[Array, Array]:
        """Return the basis at frequencies, and its penalty; knots reach farther where frequencies do."""
        from scipy.interpolate import BSpline

        knots, penalty = self.knots.get(number, (np.zeros(1), np.zeros((0, 0))))
        low, high = float(frequency.min()), float(frequency.max())
        if low < knots[0] or high > knots[-1]:
            low, high = low - BEYOND, high + BEYOND
            inner = np.linspace(low, high, int((high - low) / KNOT_SPACING) + 2)
            knots = np.concatenate([low * np.ones(degree), inner, high * np.ones(degree)])
            penalty = penalty_of(knots, degree)
            self.knots[number] = knots, penalty
        return BSpline.design_matrix(frequency, knots, degree).toarray(), penalty


def _log_determinant(factor: Array) -> float:
    """Of a matrix, from its Cholesky factor."""
    return 2.0 * float(np.sum(np.log(np.diag(factor))))
