"""Confidence intervals of each step of log10 α: profiles of the likelihood.

The curvature at the end of a search shows neither a second minimum nor a plateau beyond a small dip.  So each step is
varied over the range in which the two sides overlap, with the other shifts adjusted; the 95 % interval ends where the
likelihood has fallen as at 1.96 standard errors of a parabola (D. J. Venzon, S. H. Moolgavkar, Appl. Statist. 37
(1988) 87).  Curves, offsets of isotherms and vertical shifts are integrated over, so that moving isotherms apart gains
nothing from the freedom of their curves.

For step tests the likelihood also gives the shifts: least squares attribute a part of each offset to the shift, but an
offset changes all points of a test equally, so that differences between points of one test determine its shift better
than their level does.  With offsets, errors of the shifts are typically three to seven times smaller.  Where a step is
hardly determined, as on a plateau, neither a parabola nor a profile along a straight line shows how far several shifts
may move together; the likelihood is then sampled (T. Kloek, H. K. van Dijk, Econometrica 46 (1978) 1).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from viscofric.arrays import Array, Slopes, Squares, descend
from viscofric.rheology.shifts.parametric_law import LEVEL_95
from viscofric.rheology.superposition.common_curve import KNOT_SPACING, RIDGE, ROUGHNESS, Smoother
from viscofric.rheology.superposition.overlap import LogSweep, allowed_half_width, steps_that_overlap
from viscofric.rheology.superposition.shift_problem import SMALLEST_PART, Piece, ShiftProblem

#: A profile is followed from this many standard errors on, in distances that double, until it is excluded …
NEAR = 3.0
#: … and from there in steps of this many decades as long as the sides overlap; but not where a step is known to the
#: second number, since sweeps that determine a step so well join nowhere else.
COARSE = 0.4
SHARP = 0.03
#: Excluded are moves this many times the threshold below the best.
EXCLUDED = 1.5
#: Number of bisections between the distances tried at the ends of an interval.
HALVINGS = 3
#: Variances of steps below this, decades², are those of fixed steps.
SMALLEST = 1e-18
#: Number of cubic splines that are not zero at a point.
LOCAL = 4
#: Largest number of points evaluated together, which bounds the memory.
AT_ONCE = 100_000


@dataclass
class _Profile:
    """The likelihood along one step: moves tried, and −2 log of it there."""

    follow: Array  # (p,), how parameters follow the step
    variance: float
    threshold: float
    reach: tuple[float, float]  # how far it may go to either side, decades
    moves: list[float] = field(default_factory=list)
    falls: list[float] = field(default_factory=list)

    def outwards(self) -> list[float]:
        """Return the next move to either side, if one is needed."""
        error, found = float(np.sqrt(self.variance)), []
        for side, far in zip((-1.0, 1.0), self.reach, strict=True):
            place = int(np.argmax(side * np.array(self.moves)))
            last, move = side * self.moves[place], NEAR * error
            if last > 0.0:
                excluded = self.falls[place] - self.falls[0] > EXCLUDED * self.threshold
                if excluded and error < SHARP:
                    continue
                move = last + COARSE if excluded else 2.0 * last
            if last < far and last < move:
                found.append(side * min(move, far))
        return found

    def halves(self) -> list[float]:
        """Return the middles of the gaps that contain the interval's ends, if it is wider than that of a parabola."""
        moves, rise = self._sorted()
        allowed = np.flatnonzero(rise <= self.threshold)
        gaps = (allowed[0] - 1, allowed[0]), (allowed[-1], allowed[-1] + 1)
        ends = [(moves[low], moves[high]) for low, high in gaps if low >= 0 and high < len(rise)]
        return [float(0.5 * (low + high)) for low, high in ends if 0.0 not in (low, high)]

    def half_width(self) -> float:
        """Return half of the 95 % interval."""
        return allowed_half_width(*self._sorted(), self.threshold)

    def _sorted(self) -> tuple[Array, Array]:
        order = np.argsort(self.moves)
        rise = np.array(self.falls)[order]
        return np.array(self.moves)[order], rise - rise.min()


class StepProfiles:
    """−2 log of the likelihood of shifts, with curves and levels of isotherms integrated over.

    Curves are cubic splines with equal intervals, so that the same splines apply to all shifts.  `levels` (m n, m n) is
    the covariance of levels of the m moduli of n isotherms: offsets and vertical shifts; decades².  `problem` and
    `smoothers` are those at the end of the search; `excess` (m,) of each is the factor of the variance of its points.
    """

    def __init__(
        self,
        problem: ShiftProblem,
        smoothers: list[Smoother],
        sweeps: list[LogSweep],
        levels: Array,
        excess: list[Array] | None = None,
    ) -> None:
        self.problem = problem
        self.smoothers = smoothers
        self.sweeps = sweeps
        self.levels = levels
        self.scatters = [one.scatter / np.sqrt(problem.weights) for one in smoothers]
        if excess is not None:
            self.scatters = [np.sqrt(one) * scatter for one, scatter in zip(excess, self.scatters, strict=True)]

    def widened(self, parameters: Array, inverse: Array, noise: Array, covariance: Array) -> Array:
        """Return the covariance (p, p) with the variance that profiles of the steps add, at parameters (p,) found."""
        # `inverse` of the curvature, `noise`, the covariance due to the scatter of the points, and `covariance` in all
        # are (p, p).
        broken = {piece.last - 1 for piece in self.problem.pieces}
        profiles = []
        for place in range(self.problem.size - 1):
            step = np.zeros(len(parameters))
            step[place], step[place + 1] = 1.0, -1.0
            curvature = float(step @ inverse @ step)
            if place in broken or curvature < SMALLEST:
                continue
            now = float(parameters[place] - parameters[place + 1])
            lowest, highest = steps_that_overlap(self.sweeps[place], self.sweeps[place + 1])
            profiles.append(
                _Profile(
                    inverse @ step / curvature,
                    float(step @ covariance @ step),
                    LEVEL_95**2 * float(step @ noise @ step) / curvature,
                    (max(now - lowest, 0.0), max(highest - now, 0.0)),
                )
            )
        self._try(parameters, [(profile, 0.0) for profile in profiles])
        while moves := [(profile, move) for profile in profiles for move in profile.outwards()]:
            self._try(parameters, moves)
        for _ in range(HALVINGS):
            self._try(parameters, [(profile, move) for profile in profiles for move in profile.halves()])
        widened = covariance.copy()
        for profile in profiles:
            more = max((profile.half_width() / LEVEL_95) ** 2 - profile.variance, 0.0)
            widened += more * np.outer(profile.follow, profile.follow)
        return widened

    def errors(self, parameters: Array, covariance: Array) -> Array:
        """Return the covariance (p, p) of the most likely parameters (p,), whose curvature gives `covariance`."""
        widened = self.widened(parameters, covariance, covariance, covariance)
        steps = np.diff(np.eye(len(parameters)), axis=0)
        broad = np.max(np.einsum("ij,jk,ik->i", steps, widened, steps)) > BROAD**2
        return sampled(self.in_parts, parameters, widened) if broad else widened

    def _try(self, parameters: Array, moves: list[tuple[_Profile, float]]) -> None:
        """Evaluate moves of steps, and record their likelihood."""
        moved = np.array([parameters + move * profile.follow for profile, move in moves if move])
        still = self(parameters[None])[0] if len(moved) < len(moves) else 0.0
        found = list(self.in_parts(moved))
        for profile, move in moves:
            profile.moves.append(move)
            profile.falls.append(float(found.pop(0) if move else still))

    def in_parts(self, parameters: Array) -> Array:
        """Return the same as a call, with few enough parameters evaluated together to bound the memory."""
        size = max(AT_ONCE // sum(len(piece.frequency) for piece in self.problem.pieces), 1)
        parts = (self(parameters[first : first + size]) for first in range(0, len(parameters), size))
        return np.array([fall for part in parts for fall in part])

    def __call__(self, parameters: Array) -> Array:
        """Return −2 log of the likelihood (k,) of each of several parameters (k, p), up to a constant."""
        problem, count, size = self.problem, len(parameters), self.problem.size
        steps = parameters.copy()
        steps[:, size:] = 0.0  # vertical shifts are among the levels
        total = np.sum((problem.wanted - steps @ problem.prior.T) ** 2, axis=1)
        rank = len(self.levels)
        inner, wish = np.zeros((count, rank, rank)), np.zeros((count, rank))
        for piece, smoother, scatters in zip(problem.pieces, self.smoothers, self.scatters, strict=True):
            inside = slice(piece.first, piece.last)
            shifts = parameters[:, inside] - parameters[:, inside].mean(axis=1, keepdims=True)
            values = piece.moduli - piece.moduli.mean(axis=0)
            known, square = _reduced(piece, piece.frequency + shifts[:, piece.isotherm], values)
            weighted = values * piece.weights[:, None]
            level, weight = piece.gathered(weighted), np.diag(piece.gathered(piece.weights))
            for modulus in range(values.shape[1]):
                products, logarithm = _eliminated(known, square, float(smoother.smoothing[modulus]))
                own = piece.size + modulus
                scatter = scatters[modulus]
                left = (weight - products[:, : piece.size, : piece.size]) / scatter**2
                gained = (level[:, modulus] - products[:, own, : piece.size]) / scatter**2
                total += (weighted[:, modulus] @ values[:, modulus] - products[:, own, own]) / scatter**2 + logarithm
                places = slice(modulus * size + piece.first, modulus * size + piece.last)
                inner[:, places] = left @ self.levels[places]
                wish[:, places] = gained
        inner += np.eye(rank)
        expected = np.linalg.solve(inner, wish[..., None])[..., 0] @ self.levels
        return np.asarray(total + np.linalg.slogdet(inner)[1] - np.sum(wish * expected, axis=1))


def _reduced(piece: Piece, frequency: Array, values: Array) -> tuple[Array, Array]:
    """Reduce points at frequencies (k, n) to sums over them with K cubic splines B of equal intervals."""
    # Returns (k, isotherms + m, K), Σ w B of each isotherm and Σ w y B of each modulus, and (k, 4, K), the lower
    # diagonals of Σ w B Bᵀ.
    count, rows = len(frequency), piece.size + values.shape[1]
    place = frequency / KNOT_SPACING
    first = np.floor(place)
    t = place - first
    number = (first - first.min()).astype(np.intp)
    K = int(number.max()) + LOCAL
    splines = np.array([(1.0 - t) ** 3, (3.0 * t - 6.0) * t**2 + 4.0, 3.0 * (t + t**2 - t**3) + 1.0, t**3]) / 6.0
    weighted = splines * piece.weights
    number = number + np.arange(LOCAL)[:, None, None]
    at = number + (np.arange(count)[:, None] * rows + piece.isotherm) * K
    sums = np.bincount(at.ravel(), weighted.ravel(), count * rows * K)
    known = np.asarray(sums, dtype=float).reshape(count, rows, K)
    at = (number + np.arange(count)[:, None] * K).reshape(LOCAL, -1)

    def gathered(products: Array) -> Array:
        sums = np.bincount(at[: len(products)].ravel(), products.ravel(), count * K)
        return np.asarray(sums, dtype=float).reshape(count, K)

    for modulus, value in enumerate(values.T):
        known[:, piece.size + modulus] = gathered(weighted * value)
    square = [gathered(weighted[: LOCAL - below] * splines[below:]) for below in range(LOCAL)]
    return known, np.stack(square, axis=1)


def _eliminated(known: Array, square: Array, smoothing: float) -> tuple[Array, Array]:
    """Integrate over the curves: known A⁻¹ knownᵀ and log |A| − log |λP|, with A = square + λP."""
    from scipy.linalg.lapack import dpbtrf, dpbtrs

    K = square.shape[2]
    stiffness = smoothing / KNOT_SPACING**5
    banded = square + stiffness * _third_differences(K)
    banded[:, 0] += RIDGE * np.mean(square[:, 0], axis=1, keepdims=True)
    factors = [dpbtrf(one, lower=1)[0] for one in banded]
    solved = np.array([dpbtrs(factor, one.T, lower=1)[0].T for factor, one in zip(factors, known, strict=True)])
    logarithm = 2.0 * np.sum(np.log([factor[0] for factor in factors]), axis=1)
    return known @ np.swapaxes(solved, 1, 2), logarithm - (K - ROUGHNESS) * np.log(stiffness)


@lru_cache(maxsize=64)
def _third_differences(K: int) -> Array:
    """Return the lower diagonals (4, K) of DᵀD, with D the third differences of K coefficients."""
    rough = np.diff(np.eye(K), ROUGHNESS, axis=0)
    square = rough.T @ rough
    return np.array([np.append(np.diag(square, -below), np.zeros(below)) for below in range(LOCAL)])


#: Steps with a larger error, decades, are sampled: so often, from Student's distribution of so many degrees of freedom,
#: whose scale is so many times the covariance's.
BROAD = 0.1
SAMPLES, STUDENT, WIDER = 2000, 4, 2.0


def sampled(likelihood: Callable[[Array], Array], found: Array, covariance: Array) -> Array:
    """Return the second moments (p, p) about parameters (p,) by importance sampling, `covariance` at least."""
    parts, modes = np.linalg.eigh(covariance)
    free = parts > SMALLEST
    ways = modes[:, free] * np.sqrt(parts[free]) * (np.diag(covariance) > SMALLEST)[:, None]  # not of those held
    random = np.random.default_rng(0)
    normal = random.standard_normal((SAMPLES, ways.shape[1]))
    heavy = random.chisquare(STUDENT, SAMPLES) / STUDENT
    moves = WIDER * normal / np.sqrt(heavy)[:, None]
    drawn = -(STUDENT + ways.shape[1]) * np.log1p(np.sum(normal**2, axis=1) / (STUDENT * heavy))  # 2 log of the density
    fall = likelihood(found + moves @ ways.T) + drawn
    weight = np.exp(-0.5 * (fall - fall.min()))
    weight /= weight.sum()
    prior = ways.shape[1] * float(weight @ weight)  # few draws that count, in many directions, show little
    moments = ((moves.T * weight) @ moves + prior * np.eye(ways.shape[1])) / (1.0 + prior)
    known, modes = np.linalg.eigh(moments)
    root = ways @ modes * np.sqrt(np.maximum(known, 1.0))
    return np.asarray(root @ root.T)


#: Step of the finite differences, in standard errors.
DIFFERENCE = 0.5
PASSES = 4  # each computes the second derivatives again
STEPS = 6  # of each pass
LARGEST_STEP = 0.3  # decades, in one step
#: A pass ends where −2 log of the likelihood falls by less than this part; the passes with a move of so many standard
#: errors.
FALL = 1e-10
MOVED = 0.1


def most_likely(likelihood: Callable[[Array], Array], start: Array, scale: Array) -> tuple[Array, Array]:
    """Return the parameters (p,) that minimise −2 log of a likelihood, and their covariance (p, p)."""
    # `likelihood` returns −2 log of it (k,) at several parameters (k, p). The columns of `scale` (p, q) are the q
    # directions in which parameters may change, each by one Gauss–Newton standard error.
    found = start
    for _ in range(PASSES):
        parts, modes = np.linalg.eigh(_second_derivatives(likelihood, found, scale))
        ways = scale @ (modes / np.sqrt(np.maximum(parts, SMALLEST_PART)))
        step = _descended(likelihood, found, ways)
        found = found + ways @ step
        if np.linalg.norm(step) < MOVED:
            break
    return found, np.asarray(ways @ ways.T)


def _descended(likelihood: Callable[[Array], Array], start: Array, ways: Array) -> Array:
    """Return the best move (q,) along directions `ways` (p, q), scaled so that the second derivatives are one."""
    moves = DIFFERENCE * np.eye(ways.shape[1])

    def at(moved: Array) -> Squares:
        def slopes() -> Slopes:
            behind, ahead = np.split(likelihood(start + (moved + np.concatenate([-moves, moves])) @ ways.T), 2)
            return (behind - ahead) / (4.0 * DIFFERENCE), np.eye(len(moves))

        return float(likelihood(start[None] + ways @ moved)[0]), slopes

    largest = LARGEST_STEP / np.abs(ways).max(axis=0)
    return descend(at, np.zeros(len(moves)), iterations=STEPS, tolerance=FALL, largest=largest, damping=0.0)


def _second_derivatives(likelihood: Callable[[Array], Array], at: Array, ways: Array) -> Array:
    """Return half of the second derivatives (q, q) along directions `ways` (p, q), by finite differences."""
    q = ways.shape[1]
    moves = DIFFERENCE * ways.T
    first, second = np.tril_indices(q, -1)
    pairs = moves[first] + moves[second]
    values = likelihood(np.concatenate([[at], at + moves, at - moves, at + pairs, at - pairs])) / (2.0 * DIFFERENCE**2)
    values = values[1:] - values[0]
    own = values[:q] + values[q : 2 * q]
    both = values[2 * q : 2 * q + len(pairs)] + values[2 * q + len(pairs) :]
    found = np.diag(own)
    found[first, second] = found[second, first] = 0.5 * (both - own[first] - own[second])
    return found
