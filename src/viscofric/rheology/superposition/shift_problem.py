"""What shifts of isotherms are judged by: their points, the curves through them, weak expectations."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from viscofric.rheology.superposition.common_curve import Smoother
from viscofric.rheology.superposition.overlap import failures

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from viscofric.rheology.superposition.gauge import Gauge
    from viscofric.rheology.superposition.overlap import Join, LogSweep

    Array = NDArray[np.float64]

#: Where the data leave a step open it stays near the trend of its neighbours: the rate of change with 1/T, in
#: decades per typical step, changes from step to step by about so much …
TREND = 1.0  # decades
#: … and each step is within about so much of where neighbours were first joined.
PRIOR = 3.0  # decades
#: Vertical shifts of neighbours differ by about so much: three times what ρT makes in 10 K.
VERTICAL_PRIOR = 0.03  # decades


@dataclass(frozen=True, eq=False)
class _Piece:
    """Isotherms that share their curves: their places, and points (n,), moduli (n, m) and weights (n,) of all."""

    first: int
    last: int
    isotherm: Array
    frequency: Array
    moduli: Array
    weights: Array

    @classmethod
    def of(cls, sweeps: list[LogSweep], first: int, last: int) -> _Piece:
        """Stack the points of the isotherms from `first` to before `last`."""
        chosen = sweeps[first:last]
        return cls(
            first,
            last,
            np.repeat(np.arange(last - first), [len(sweep) for sweep in chosen]),
            np.concatenate([sweep.frequency for sweep in chosen]),
            np.concatenate([sweep.moduli for sweep in chosen]),
            np.concatenate([np.ones(len(sweep)) if sweep.weights is None else sweep.weights for sweep in chosen]),
        )

    @property
    def size(self) -> int:
        return self.last - self.first

    def reduced(self, shifts: Array, vertical: Array) -> tuple[Array, Array, Array]:
        """Return frequencies and moduli of all points at one temperature, that of the mean shift, and weights.

        To move all isotherms together then changes nothing, wherever the knots lie.
        """
        inside = slice(self.first, self.last)
        return (
            self.frequency + (shifts[inside] - shifts[inside].mean())[self.isotherm],
            self.moduli - vertical[inside][self.isotherm][:, None],
            self.weights,
        )

    def gathered(self, values: Array) -> Array:
        """Add up what points of the same isotherm have: (n, …) to (isotherms, …)."""
        return np.asarray(np.add.reduceat(values, np.searchsorted(self.isotherm, np.arange(self.size)), axis=0))


@dataclass(frozen=True, eq=False)
class State:
    """What shifts give.

    Parameters
    ----------
    cost : float
        What is minimised: squares, in standard deviations.
    gradient : (m,) array
        Half of its decrease with the shifts.
    normal, curvature : (m, m) array
        Half of its second derivatives, by Gauss and Newton, and exactly.
    score : (m, m) array
        Covariance of the gradient that the scatter of the points makes.
    freedom : float
        Degrees of freedom left in the residuals.
    """

    cost: float
    gradient: Array
    normal: Array
    curvature: Array
    score: Array
    freedom: float


class ShiftProblem:
    """The measured points of all isotherms, the prior on the steps between them, and what is held."""

    def __init__(self, sweeps: list[LogSweep], joins: list[Join], gauge: Gauge, parted: Iterable[int] = ()) -> None:
        self.size = len(sweeps)
        self.gauge = gauge
        apart = {place for place, found in enumerate(joins) if found.uncertainty == np.inf}
        broken = sorted(apart.union(failures(joins), parted))
        starts = [0, *(place + 1 for place in broken), self.size]
        self.pieces = [_Piece.of(sweeps, first, last) for first, last in pairwise(starts)]
        self.start, self.ways = gauge.free()
        self.prior, self.wanted = self._prior(joins, broken)

    def _prior(self, joins: list[Join], broken: list[int]) -> tuple[Array, Array]:
        """Return rows that should be near values, both in standard deviations: steps, trends, vertical steps."""
        size, free_vertical = self.size, self.gauge.free_vertical
        step_of = -np.diff(np.eye(size), axis=0)
        steps = np.array([found.step for found in joins])
        error = np.full(size - 1, PRIOR)
        for place in broken:  # nothing else joins the two sides
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

    def split(self, parameters: Array) -> tuple[Array, Array]:
        """Return horizontal and vertical shifts."""
        if self.gauge.free_vertical:
            return parameters[: self.size], parameters[self.size :]
        return parameters, np.zeros(self.size)

    def signal(self, parameters: Array, smoothers: list[Smoother]) -> Array:
        """Return how many times the squared slope of the curves at each isotherm exceeds what noise makes (n,)."""
        ratios = []
        for piece, smoother in zip(self.pieces, smoothers, strict=True):
            curves = smoother.curves(*piece.reduced(*self.split(parameters)))
            slopes_of_basis = curves.slopes_of_basis()
            squares = piece.gathered((slopes_of_basis @ curves.coefficients / smoother.scatter) ** 2)
            noise = piece.gathered(np.einsum("ni,mij,nj->nm", slopes_of_basis, curves.inverse, slopes_of_basis))
            ratios.append(squares.sum(axis=1) / noise.sum(axis=1))
        return np.concatenate(ratios)

    def smoothers(self, parameters: Array) -> list[Smoother]:
        """Choose knots and smoothing of every piece anew."""
        return [Smoother.fitted(*piece.reduced(*self.split(parameters))) for piece in self.pieces]

    def state(self, parameters: Array, smoothers: list[Smoother], noise: float) -> State:
        """Draw the curves at these shifts and say how what is minimised changes with them."""
        away = self.wanted - self.prior @ parameters
        cost, gradient = float(away @ away), self.prior.T @ away
        information = self.prior.T @ self.prior
        normal, curvature, score = information.copy(), information.copy(), np.zeros_like(information)
        freedom = 0.0
        for piece, smoother in zip(self.pieces, smoothers, strict=True):
            places = np.arange(piece.first, piece.last)
            if self.gauge.free_vertical:
                places = np.concatenate([places, places + self.size])
            found = _derivatives(piece, smoother, piece.reduced(*self.split(parameters)), self.gauge.free_vertical)
            square = np.ix_(places, places)
            cost += found.cost / noise**2
            gradient[places] += found.gradient / noise**2
            normal[square] += found.normal / noise**2
            curvature[square] += found.curvature / noise**2
            score[square] += found.score / noise**4
            freedom += found.freedom
        return State(cost, gradient, normal, curvature, score, freedom)


def _derivatives(piece: _Piece, smoother: Smoother, reduced: tuple[Array, Array, Array], free_vertical: bool) -> State:
    """Return cost, gradient and curvature of one piece, the curves being refitted wherever the shifts go.

    With M = 1 − B (BᵀB + λP)⁻¹ Bᵀ, y the moduli and s a shift, the cost is yᵀMy.  Both its derivatives are exact.
    """
    curves = smoother.curves(*reduced)
    basis_slopes = curves.slopes_of_basis()
    slopes = basis_slopes @ curves.coefficients
    bends = curves.bends()
    belongs = np.eye(piece.size)[piece.isotherm]
    count = 2 * piece.size if free_vertical else piece.size
    gradient, normal = np.zeros(count), np.zeros((count, count))
    curvature, score = np.zeros((count, count)), np.zeros((count, count))
    same = piece.isotherm[1:] == piece.isotherm[:-1]
    for modulus in range(curves.residual.shape[1]):
        residual = curves.residual[:, modulus]
        moved = belongs * slopes[:, modulus : modulus + 1]
        turned = piece.gathered(basis_slopes * residual[:, None])
        if free_vertical:
            moved = np.concatenate([moved, belongs * curves.root], axis=1)
            turned = np.concatenate([turned, np.zeros_like(turned)])
        onto = curves.basis.T @ moved
        inverse = curves.inverse[modulus]
        square = moved.T @ moved
        information = square - onto.T @ inverse @ onto
        bent = turned - onto.T
        gradient += moved.T @ residual
        normal += information
        second = square - bent @ inverse @ bent.T
        second[: piece.size, : piece.size] -= np.diag(piece.gathered(bends[:, modulus] * residual))
        curvature += second
        score += smoother.scatter[modulus] ** 2 * _inflation(residual, same) * information
    moves = np.eye(count)
    moves[: piece.size, : piece.size] -= 1.0 / piece.size  # see `_Piece.reduced`
    gradient, normal, curvature, score = (
        moves @ gradient,
        moves @ normal @ moves,
        moves @ curvature @ moves,
        moves @ score @ moves,
    )
    return State(curves.cost, gradient, normal, curvature, score, curves.freedom)


def _inflation(residual: Array, same: Array) -> float:
    """Return how much less n points tell whose residuals are alike: a misfit rather than noise."""
    squares = float(residual @ residual)
    alike = float(np.sum((residual[1:] * residual[:-1])[same])) / squares if squares > 0.0 else 0.0
    return (1.0 + alike) / (1.0 - alike) if alike > 0.0 else 1.0
