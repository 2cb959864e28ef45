"""The objective of a fit of shifts: the points of the isotherms, the curves through them, weak priors, the gauge."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from viscofric.arrays import Array, Indices, Mask
from viscofric.rheology.superposition.common_curve import Basis, Smoother
from viscofric.rheology.superposition.overlap import Join, LogSweep, failures


@dataclass(frozen=True, eq=False)
class Gauge:
    """Which shifts are fixed."""

    inverse_temperatures: Array  # (n,), 1/T of the isotherms, ascending in temperature
    weights: Array  # (n,), interpolation at the reference, where log10 α is zero
    vertical_weights: Array  # (n,), the same for log10 b
    held: Mapping[int, float]  # log10 α of isotherms by index
    free_vertical: bool = False  # whether vertical shifts are fitted
    left_out: bool = False  # whether there may be vertical shifts that are neither fitted nor given

    @property
    def trend(self) -> Array | None:
        """Log10 b (n,) in proportion to absolute temperature, zero at the reference, where b may have been left out."""
        trend = -np.log10(self.inverse_temperatures)
        return np.asarray(trend - self.weights @ trend) if self.left_out else None

    def free(self) -> tuple[Array, Array]:
        """Return shifts that meet the fixed ones, and an orthonormal basis of their possible changes."""
        size = len(self.weights)
        full = 2 * size if self.free_vertical else size
        rows = [np.eye(full)[place] for place in self.held]
        values = list(self.held.values())
        if not all(place in self.held for place in np.flatnonzero(self.weights)):
            rows.append(np.concatenate([self.weights, np.zeros(full - size)]))
            values.append(0.0)
        if self.free_vertical:
            rows.append(np.concatenate([np.zeros(size), self.vertical_weights]))
            values.append(0.0)
        matrix = np.array(rows)
        _, _, right = np.linalg.svd(matrix, full_matrices=True)
        return np.linalg.lstsq(matrix, np.array(values), rcond=None)[0], right[len(rows) :].T

    def within(self, first: int, last: int) -> Gauge:
        """Return the gauge of some of the isotherms; about the nearest of them if the reference is not among them."""
        inside = slice(first, last)
        weights = self.weights[inside]
        if weights.sum() < 1.0 - 1e-9:
            weights = np.eye(last - first)[0 if np.argmax(self.weights) < first else -1]
        held = {place - first: value for place, value in self.held.items()}
        return Gauge(
            self.inverse_temperatures[inside], weights, self.vertical_weights[inside], held, left_out=self.left_out
        )

    def brought_to(self, shifts: Array) -> Array:
        """Return shifts corrected to meet the fixed ones, by a correction that is linear in 1/T between them."""
        shifts = shifts - self.weights @ shifts
        changes = {float(self.weights @ self.inverse_temperatures): 0.0}
        changes |= {float(self.inverse_temperatures[place]): v - shifts[place] for place, v in self.held.items()}
        points = np.array(sorted(changes.items()))
        shifts = shifts + np.interp(self.inverse_temperatures, points[:, 0], points[:, 1])
        start, ways = self.free()  # the remaining condition at a reference between isotherms
        parameters = np.concatenate([shifts, np.zeros(len(start) - len(shifts))])
        return np.asarray((start + ways @ (ways.T @ (parameters - start)))[: len(shifts)])


#: An isotherm determines its shift if the squared slope of the curves is this many times its noise.  Noise alone gives
#: 0.3 to 9, sweeps that determine a step to 0.1 decades 20 and more.
CLEAR = 15.0
#: Number of the last determined steps that the trend is taken from.
TREND_STEPS = 2
#: Uncertainty of the change of the rate with 1/T from step to step beyond them, decades per typical step, or as a part
#: of the rate if that is more: from step to step WLF laws of usual rubbers lose 0.06 to 0.6 of it, 0.35 in the rms.
LEAST_BEND, BEND = 0.2, 0.35


def identified(signal: Array, gauge: Gauge) -> tuple[int, int] | None:
    """Return the index of the first isotherm to fit, and that after the last; None to fit all."""
    # `signal` (n,) is the squared slope of the curves at each isotherm, in units of its noise. All are fitted where
    # none at the ends is a plateau, nearly all are plateaus, vertical shifts are fitted, or a factor is fixed whose
    # plateau, or whose reference, would be left out.
    clear = np.flatnonzero(signal > CLEAR)
    if gauge.free_vertical or len(clear) <= TREND_STEPS:
        return None
    first, last = int(clear[0]), int(clear[-1]) + 1
    inside = set(range(first, last))
    needed = {*gauge.held, *(int(place) for place in np.flatnonzero(gauge.weights))} if gauge.held else set()
    if (first, last) == (0, len(signal)) or last - first <= TREND_STEPS or not needed <= inside:
        return None
    return first, last


def continued(values: Array, gauge: Gauge, first: int, last: int) -> Array:
    """Continue shifts (or what is linear in them) over the plateaus at both ends, linearly in 1/T."""
    # `values` (m, …) are those of the isotherms `first` to before `last`; returns (n, …) of all isotherms, zero at the
    # reference.
    inverse = gauge.inverse_temperatures
    size = len(inverse)
    onto = np.zeros((size, last - first))
    onto[first:last] = np.eye(last - first)
    for end, before, places in _ends(size, first, last):
        further = (inverse[places] - inverse[end]) / (inverse[end] - inverse[before])
        onto[places, end - first] = 1.0 + further
        onto[places, before - first] = -further
    return np.asarray(np.tensordot(_change(gauge) @ onto, values, axes=1))


def continued_covariance(covariance: Array, values: Array, gauge: Gauge, first: int, last: int) -> Array:
    """Return the covariance (n, n) of shifts continued from the fitted ones (m,), which have the covariance (m, m)."""
    # It grows: from step to step the rate of change with 1/T may change by `BEND`.
    inverse = gauge.inverse_temperatures
    size = len(inverse)
    spread = np.zeros((size, size))
    typical = float(np.median(np.abs(np.diff(inverse))))
    for end, before, places in _ends(size, first, last):
        reached = np.abs(inverse[places] - inverse[end]) / typical
        start = np.concatenate([[0.0], reached[:-1]])
        rate = typical * (values[end - first] - values[before - first]) / (inverse[end] - inverse[before])
        walk = max(LEAST_BEND, BEND * abs(rate)) * np.maximum(reached[:, None] - start, 0.0)
        spread[np.ix_(places, places)] = walk @ walk.T
    change = _change(gauge)
    fitted = continued(continued(covariance, gauge, first, last).T, gauge, first, last)
    return np.asarray(fitted + change @ spread @ change.T)


def _ends(size: int, first: int, last: int) -> list[tuple[int, int, Indices]]:
    """Return for each end with a plateau its last fitted isotherm, the start of the trend, and the plateau."""
    hot = last - 1, last - 1 - TREND_STEPS, np.arange(last, size)
    cold = first, first + TREND_STEPS, np.arange(first - 1, -1, -1)
    return [end for end in (hot, cold) if len(end[2])]


def _change(gauge: Gauge) -> Array:
    """Return the matrix that makes shifts zero at the reference."""
    return np.asarray(np.eye(len(gauge.weights)) - gauge.weights)


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

    @property
    def trend(self) -> Array | None:
        """What a vertical shift that was left out adds to the logarithms of the moduli (m n,)."""
        trend = self.gauge.trend
        return None if trend is None else np.tile(trend, self.moduli)

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
            found.append(Basis.of(frequency).smoother(moduli - piece.own(less), weights))
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
