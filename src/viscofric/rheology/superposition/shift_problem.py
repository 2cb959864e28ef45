"""The objective of a fit of shifts: the points of the isotherms, the curves through them, weak priors."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from viscofric.arrays import Array, Indices, Mask
from viscofric.rheology.superposition.common_curve import Smoother
from viscofric.rheology.superposition.gauge import Gauge
from viscofric.rheology.superposition.overlap import Join, LogSweep, failures

#: Where the data do not determine a step, a prior keeps it near the trend of its neighbours: standard deviation of the
#: change from step to step of the rate with 1/T, in decades per typical step …
TREND = 1.0  # decades
#: … and that of each step about the first join of the neighbours.
PRIOR = 3.0  # decades
#: Standard deviation of the difference of neighbours' vertical shifts: three times the effect of ρT in 10 K.
VERTICAL_PRIOR = 0.03  # decades
#: Second derivatives are at least this part of those of Gauss and Newton.
SMALLEST_PART = 0.2


@dataclass(frozen=True, eq=False)
class Piece:
    """Isotherms that share curves: their indices; points (n,), moduli (n, m), weights (n,); the first point of each."""

    first: int
    last: int
    isotherm: Array
    frequency: Array
    moduli: Array
    weights: Array
    starts: Indices

    @classmethod
    def of(cls, sweeps: list[LogSweep], first: int, last: int) -> Piece:
        """Stack the points of the isotherms from `first` to before `last`."""
        chosen = sweeps[first:last]
        counts = [len(sweep) for sweep in chosen]
        return cls(
            first,
            last,
            np.repeat(np.arange(last - first), counts),
            np.concatenate([sweep.frequency for sweep in chosen]),
            np.concatenate([sweep.moduli for sweep in chosen]),
            np.concatenate([np.ones(len(sweep)) if sweep.weights is None else sweep.weights for sweep in chosen]),
            np.concatenate([[0], np.cumsum(counts[:-1])]).astype(np.intp),
        )

    @property
    def same(self) -> Mask:
        """Whether each point and the next belong to one isotherm."""
        return np.asarray(self.isotherm[1:] == self.isotherm[:-1])

    @property
    def size(self) -> int:
        """Number of isotherms."""
        return self.last - self.first

    def reduced(self, shifts: Array, vertical: Array) -> tuple[Array, Array, Array]:
        """Return frequencies and moduli of all points at one temperature, that of the mean shift, and weights."""
        # So moving all isotherms together changes nothing, whatever the knots.
        inside = slice(self.first, self.last)
        return (
            self.frequency + (shifts[inside] - shifts[inside].mean())[self.isotherm],
            self.moduli - vertical[inside][self.isotherm][:, None],
            self.weights,
        )

    def own(self, values: Array) -> Array:
        """Return the values of each point's isotherm (n, …), from those of all isotherms (N, …)."""
        return np.asarray(values[self.first : self.last][self.isotherm])

    def gathered(self, values: Array) -> Array:
        """Return sums over the points of each isotherm: (n, …) to (isotherms, …)."""
        return np.asarray(np.add.reduceat(values, self.starts, axis=0))


@dataclass(frozen=True, eq=False)
class State:
    """Objective and derivatives at given m shifts; the last three are zero unless requested."""

    cost: float  # the objective: squares, in standard deviations
    gradient: Array  # (m,), half of its decrease with the shifts
    normal: Array  # (m, m), half of its second derivatives, by Gauss and Newton
    curvature: Array  # (m, m), the same, exactly
    score: Array  # (m, m), covariance of the gradient due to the scatter of the points
    freedom: float  # degrees of freedom left in the residuals


class ShiftProblem:
    """The measured points of all isotherms, the prior on the steps between them, and the fixed shifts."""

    def __init__(
        self,
        sweeps: list[LogSweep],
        joins: list[Join],
        gauge: Gauge,
        parted: Iterable[int] = (),
        weights: Array | None = None,
    ) -> None:
        self.size = len(sweeps)
        self.gauge = gauge
        self.moduli = sweeps[0].moduli.shape[1]
        #: Of the squared residuals of each modulus (m,).
        self.weights = np.ones(self.moduli) if weights is None else weights
        apart = {place for place, found in enumerate(joins) if found.uncertainty == np.inf}
        broken = sorted(apart.union(failures(joins), parted))
        starts = [0, *(place + 1 for place in broken), self.size]
        self.pieces = [Piece.of(sweeps, first, last) for first, last in pairwise(starts)]
        self.start, self.ways = gauge.free()
        self.prior, self.wanted = self._prior(joins, broken)

    def _prior(self, joins: list[Join], broken: list[int]) -> tuple[Array, Array]:
        """Return rows of the prior and their means, in standard deviations: steps, trends, vertical steps."""
        size, free_vertical = self.size, self.gauge.free_vertical
        step_of = -np.diff(np.eye(size), axis=0)
        steps = np.array([found.step for found in joins])
        error = np.full(size - 1, PRIOR)
        for place in broken:  # only the prior joins the two sides
            error[place] = min(joins[place].uncertainty, PRIOR)
        change = -np.diff(self.gauge.inverse_temperatures)
        rates = step_of * (np.median(change) / change)[:, None]
        trends = [rates[place + 1] - rates[place] for place in range(size - 2) if not {place, place + 1} & set(broken)]
        rows = np.concatenate([step_of / error[:, None], np.array(trends).reshape(-1, size) / TREND])
        wanted = np.concatenate([steps / error, np.zeros(len(trends))])
        if free_vertical:
            vertical = step_of / VERTICAL_PRIOR
            rows = np.block([[rows, np.zeros_like(rows)], [np.zeros_like(vertical), vertical]])
            wanted = np.concatenate([wanted, np.zeros(size - 1)])
        return rows, wanted

    def vertical_prior(self) -> Array:
        """Return the covariance (n, n) of vertical shifts before any point is seen, zero where none are sought."""
        inner = self.ways[self.size :]
        if not len(inner):
            return np.zeros((self.size, self.size))
        rows = self.prior @ self.ways
        return np.asarray(inner @ np.linalg.pinv(rows.T @ rows) @ inner.T)

    def split(self, parameters: Array) -> tuple[Array, Array]:
        """Return horizontal and vertical shifts."""
        if self.gauge.free_vertical:
            return parameters[: self.size], parameters[self.size :]
        return parameters, np.zeros(self.size)

    def signal(self, parameters: Array, smoothers: list[Smoother]) -> Array:
        """Return the squared slope of the curves at each isotherm over its noise (n,)."""
        ratios = []
        for piece, smoother in zip(self.pieces, smoothers, strict=True):
            curves = smoother.curves(*piece.reduced(*self.split(parameters)))
            slopes_of_basis = curves.slopes_of_basis
            squares = piece.gathered((slopes_of_basis @ curves.coefficients / smoother.scatter) ** 2)
            noise = piece.gathered(np.einsum("ni,mij,nj->nm", slopes_of_basis, curves.inverse, slopes_of_basis))
            ratios.append(squares.sum(axis=1) / noise.sum(axis=1))
        return np.concatenate(ratios)

    def _of_isotherms(self, offsets: Array | None) -> Array:
        """Return offsets (m n) as those of each isotherm (n, m), zeros if there are none."""
        return np.zeros((self.size, self.moduli)) if offsets is None else offsets.reshape(self.moduli, self.size).T

    def smoothers(self, parameters: Array, offsets: Array | None = None) -> list[Smoother]:
        """Choose knots and smoothing of every piece again, of moduli minus offsets (m n) of the isotherms if given."""
        less = self._of_isotherms(offsets)
        found = []
        for piece in self.pieces:
            frequency, moduli, weights = piece.reduced(*self.split(parameters))
            found.append(Smoother.fitted(frequency, moduli - piece.own(less), weights))
        return found

    def with_offsets(
        self, parameters: Array, smoothers: list[Smoother], expected: Array | None
    ) -> tuple[Array, Array, Array]:
        """Return information, score and gradient of p parameters and of offsets of the m moduli of n isotherms."""
        # The curves are refitted. Information (p + m n, p + m n) is half of the second derivatives of the squares,
        # score (p + m n,) half of their decrease, in units of the scatter of each modulus; gradient (p, m n), in
        # 1/decades, is what each offset adds to half of the decrease of the plain squares with the parameters. With
        # `expected` offsets (m n,), points of an isotherm whose residuals have a common part count for less.
        count, levels = len(self.start), self.moduli * self.size
        information, score = np.zeros((count + levels, count + levels)), np.zeros(count + levels)
        gradient = np.zeros((count, levels))
        for piece, smoother in zip(self.pieces, smoothers, strict=True):
            inside = np.arange(piece.first, piece.last)
            shifts = np.concatenate([inside, inside + self.size]) if self.gauge.free_vertical else inside
            frequency, moduli, weights = piece.reduced(*self.split(parameters))
            curves = smoother.curves(frequency, moduli, weights)
            scatters = smoother.scatter
            if expected is not None:
                scatters = scatters * np.sqrt(self._inflations(piece, smoother, parameters, expected))
            belongs = np.eye(piece.size)[piece.isotherm]
            level = belongs * curves.root
            slopes = curves.slopes_of_basis @ curves.coefficients
            for modulus, scatter in enumerate(scatters):
                moved = belongs * slopes[:, modulus : modulus + 1]
                moved -= moved.mean(axis=1, keepdims=True)  # see `Piece.reduced`
                columns = np.concatenate([moved, level, level] if self.gauge.free_vertical else [moved, level], axis=1)
                offsets = modulus * self.size + inside
                places = np.concatenate([shifts, count + offsets])
                onto = curves.basis.T @ columns
                found = columns.T @ columns - onto.T @ curves.inverse[modulus] @ onto
                information[np.ix_(places, places)] += found / scatter**2
                score[places] += columns.T @ curves.residual[:, modulus] / scatter**2
                gradient[np.ix_(shifts, offsets)] += self.weights[modulus] * found[: len(shifts), len(shifts) :]
        return information, score, gradient

    def inflations(self, parameters: Array, smoothers: list[Smoother], expected: Array) -> list[Array]:
        """Return of each piece the factors (m,) of the variance of its points where residuals have a common part."""
        return [
            self._inflations(piece, smoother, parameters, expected)
            for piece, smoother in zip(self.pieces, smoothers, strict=True)
        ]

    def _inflations(self, piece: Piece, smoother: Smoother, parameters: Array, expected: Array) -> Array:
        frequency, moduli, weights = piece.reduced(*self.split(parameters))
        beside = smoother.curves(frequency, moduli - piece.own(self._of_isotherms(expected)), weights)
        return np.array([inflation(one, piece.same) for one in beside.residual.T])

    def state(
        self,
        parameters: Array,
        smoothers: list[Smoother],
        noise: float,
        offsets: Array | None = None,
        *,
        exact: bool = False,
    ) -> State:
        """Return the objective of fitted curves and its derivatives; the score is of the scatter without offsets."""
        less = self._of_isotherms(offsets)
        away = self.wanted - self.prior @ parameters
        cost, gradient = float(away @ away), self.prior.T @ away
        information = self.prior.T @ self.prior
        normal, curvature, score = information.copy(), information.copy(), np.zeros_like(information)
        freedom = 0.0
        for piece, smoother in zip(self.pieces, smoothers, strict=True):
            places = np.arange(piece.first, piece.last)
            if self.gauge.free_vertical:
                places = np.concatenate([places, places + self.size])
            reduced = piece.reduced(*self.split(parameters))
            found = _derivatives(
                piece, smoother, reduced, self.gauge.free_vertical, piece.own(less), self.weights, exact
            )
            square = np.ix_(places, places)
            cost += found.cost / noise**2
            gradient[places] += found.gradient / noise**2
            normal[square] += found.normal / noise**2
            curvature[square] += found.curvature / noise**2
            score[square] += found.score / noise**4
            freedom += found.freedom
        return State(cost, gradient, normal, curvature, score, freedom)


def _derivatives(
    piece: Piece,
    smoother: Smoother,
    reduced: tuple[Array, Array, Array],
    free_vertical: bool,
    offsets: Array,
    weights: Array,
    exact: bool,
) -> State:
    """Return cost, gradient and curvature of one piece, with the curves refitted at all shifts."""
    # With M = 1 − B (BᵀB + λP)⁻¹ Bᵀ, y a modulus, w its weight and s a shift, the cost is the sum of w yᵀMy. Both its
    # derivatives are exact.
    curves = smoother.curves(*reduced)
    slopes = curves.slopes_of_basis @ curves.coefficients
    count = 2 * piece.size if free_vertical else piece.size
    gradient, normal = np.zeros(count), np.zeros((count, count))
    curvature, score, freedom = np.zeros((count, count)), np.zeros((count, count)), 0.0
    if exact:
        lifted, bends, freedom = curves.residual, curves.bends, curves.freedom
        if np.any(offsets):
            lifted = smoother.curves(reduced[0], reduced[1] - offsets, reduced[2]).residual
    for modulus, (residual, slope, weight) in enumerate(zip(curves.residual.T, slopes.T, weights, strict=True)):
        moved = [slope, curves.root[:, 0]] if free_vertical else [slope]
        onto = np.concatenate([piece.gathered(curves.basis * one[:, None]) for one in moved])
        square = np.block([[np.diag(piece.gathered(one * other)) for other in moved] for one in moved])
        information = square - onto @ curves.inverse[modulus] @ onto.T
        gradient += weight * np.concatenate([piece.gathered(one * residual) for one in moved])
        normal += weight * information
        if exact:
            bent = -onto
            bent[: piece.size] += piece.gathered(curves.slopes_of_basis * residual[:, None])
            second = square - bent @ curves.inverse[modulus] @ bent.T
            second[: piece.size, : piece.size] -= np.diag(piece.gathered(bends[:, modulus] * residual))
            curvature += weight * second
            alike = inflation(lifted[:, modulus], piece.same)
            score += (weight * smoother.scatter[modulus]) ** 2 * alike * information
    moves = np.eye(count)
    moves[: piece.size, : piece.size] -= 1.0 / piece.size  # see `Piece.reduced`
    normal, curvature, score = (moves @ matrix @ moves for matrix in (normal, curvature, score))
    return State(curves.cost(weights), moves @ gradient, normal, curvature, score, freedom)


def inverse_curvature(normal: Array, curvature: Array) -> Array:
    """Return the inverse of a curvature, at least a part of that of Gauss and Newton, `normal`, in every direction."""
    root = np.linalg.cholesky(normal)
    whitened = np.linalg.solve(root, np.linalg.solve(root, curvature).T)
    parts, modes = np.linalg.eigh(0.5 * (whitened + whitened.T))
    back = np.linalg.solve(root.T, modes)
    return np.asarray(back / np.maximum(parts, SMALLEST_PART) @ back.T)


def inflation(residual: Array, same: Mask) -> float:
    """Return the factor by which correlated residuals reduce the information of points."""
    squares = float(residual @ residual)
    alike = float(np.sum((residual[1:] * residual[:-1])[same])) / squares if squares > 0.0 else 0.0
    return (1.0 + alike) / (1.0 - alike) if alike > 0.0 else 1.0
