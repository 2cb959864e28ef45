"""Residuals of a fit: size and correlation of the noise along each isotherm, and the systematic misfit beyond it.

A systematic misfit is correlated over neighbouring points, and no bootstrap of noise shows it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viscofric.arrays import Array, Integers
from viscofric.notes import Note

#: Fewest points of an isotherm for a scatter of its own.
LEAST_POINTS = 3
#: A point of larger leverage shows no error.
LARGEST_LEVERAGE = 0.9
#: A larger correlation of neighbours would be an offset of the whole isotherm, which its own shift absorbs.
MOST_ALIKE = 0.95


class Residuals:
    """Residuals of ln E' and ln E'', or of ln of a step response, about a fit; errors drawn with the same statistics.

    Errors are drawn from a normal distribution, with each isotherm's own scatter, correlated between E' and E'' as the
    residuals are, and between neighbouring points of an isotherm by an autoregression of first order.  Residuals
    themselves are not resampled, in blocks or otherwise: the fit has removed all that is smooth from them, the part of
    the errors that it follows.

    Rows are points, isotherm by isotherm in ascending frequency: `values` (N, m) of E' and E''; `isotherm` (N,), the
    isotherm's number, ascending from 0 without gaps; `leverage` (N, m), the part of each point's error that the fit has
    followed, 0 to 1, by which residuals are smaller than errors.

    The scatter of each isotherm is shrunk towards the common one, unless they differ by more than chance: G. K. Smyth,
    Stat. Appl. Genet. Mol. Biol. 3 (2004) 3.
    """

    def __init__(self, values: Array, isotherm: Integers, leverage: Array) -> None:
        counts = np.bincount(isotherm)
        values = values / np.sqrt(1.0 - np.minimum(leverage, LARGEST_LEVERAGE))
        squares = np.stack([np.bincount(isotherm, weights=column**2) for column in values.T], axis=1)
        variances = np.stack([_moderated(column, counts) for column in squares.T], axis=1)
        #: Standard deviation of ln E' and ln E'' in every point, (N, 2).
        self.scale = np.sqrt(variances)[isotherm]
        unit = values / np.where(self.scale > 0.0, self.scale, 1.0)
        follows = isotherm[1:] == isotherm[:-1]
        total = np.sum(unit**2, axis=0) + 1e-300
        #: Correlation of neighbours along an isotherm, of E' and of E'', (2,); below zero is chance.
        self.alike = np.clip(np.sum((unit[1:] * unit[:-1])[follows], axis=0) / total, 0.0, MOST_ALIKE)
        #: Correlation of E' with E'' in one point.
        self.together = 0.0
        if len(total) > 1:
            self.together = float(np.sum(unit[:, 0] * unit[:, 1]) / np.sqrt(np.prod(total)))
        starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
        self._steps = [starts[counts > step] + step for step in range(1, int(counts.max()))]

    def draw(self, random: np.random.Generator, samples: int) -> Array:
        """Return errors of ln E' and ln E'', (samples, N, 2), in the order of the residuals."""
        errors = random.standard_normal((samples, *self.scale.shape))
        if errors.shape[-1] > 1:
            rest = np.sqrt(max(1.0 - self.together**2, 0.0))
            errors[..., 1] = self.together * errors[..., 0] + rest * errors[..., 1]
        if np.any(self.alike > 0.0):
            fresh = np.sqrt(1.0 - self.alike**2)
            for rows in self._steps:
                errors[:, rows] = self.alike * errors[:, rows - 1] + fresh * errors[:, rows]
        return np.asarray(self.scale * errors)


def _moderated(squares: Array, counts: Integers) -> Array:
    """Return variances of isotherms, shrunk towards the common one s0² of freedom ν0: (ν0 s0² + Σ r²)/(ν0 + n)."""
    common = float(squares.sum() / counts.sum())
    known = (counts >= LEAST_POINTS) & (squares > 0.0)
    if common <= 0.0 or known.sum() < LEAST_POINTS:
        return np.full(len(counts), common)
    freedom = prior_freedom(np.log(squares[known] / counts[known]), counts[known])
    if np.isinf(freedom):
        return np.full(len(counts), common)
    return np.asarray((freedom * common + squares) / (freedom + counts))


def prior_freedom(log_variances: Array, freedom: Array | Integers) -> float:
    """Return the degrees of freedom ν0 of the common variance, infinite where variances differ by chance only."""
    # The variance of ln s² (n,) is ψ'(ν/2) by chance, with ν degrees of freedom (n,), and ψ'(ν0/2) besides.
    from scipy.optimize import brentq
    from scipy.special import polygamma

    rest = float(np.var(log_variances, ddof=1) - np.mean(polygamma(1, 0.5 * freedom)))
    if rest <= polygamma(1, 5e3):
        return np.inf
    return 2.0 * float(brentq(lambda half: float(polygamma(1, half)) - rest, 1e-3, 1e4))


#: Number of neighbours along an isotherm over which residuals are averaged: noise averages out, a misfit does not.
NEIGHBOURS = 5
#: The misfit is the excess of the averages' squares over this many times the variance that noise leaves in them.
NOISE = 3.0
#: The misfit at a frequency is that of all points within this distance, whatever their isotherm.
WINDOW = 0.5  # decades
#: Smallest misfit for a note: sweeps of one sample repeat no better.
WORTH_A_NOTE = 0.02  # decades


@dataclass(frozen=True, eq=False)
class SystematicMisfit:
    """Root mean square of the misfit of a fit beyond noise."""

    log10_frequency: Array  # (n,), log10 of the reduced angular frequencies, ascending
    # (n, 2), of log10 E' and of log10 E'' there, decades; beyond the ends it keeps its value. Both are that of log10 of
    # the response where the spectrum was fitted to step tests.
    size: Array

    def __repr__(self) -> str:
        return f"SystematicMisfit(up to {float(self.size.max()):.2g} decades)"

    def at(self, log10_frequency: Array) -> Array:
        """Return the size at frequencies, in their shape and (2,), decades."""
        return np.stack([np.interp(log10_frequency, self.log10_frequency, one) for one in self.size.T], axis=-1)

    @property
    def notes(self) -> tuple[str, ...]:
        """Return a note on the misfit, if it is large enough for one."""
        worst = np.unravel_index(int(np.argmax(self.size)), self.size.shape)
        largest = float(self.size[worst])
        if largest < WORTH_A_NOTE:
            return ()
        modulus = ("E'", "E''")[worst[1]]
        sentence = Note(
            "fit-misses-data",
            f"The fit misses the measured moduli by more than noise, {modulus} by up to {largest:.2g} decades "
            f"({100.0 * (10.0**largest - 1.0):.2g} %) near {10.0 ** self.log10_frequency[worst[0]]:.1g} rad/s, with "
            "the same sign at neighbouring points: isotherms do not superpose, or the spectrum cannot follow them. The "
            "bands of E' and E'' are widened accordingly; those of other quantities include the noise only.",
            values={
                "modulus": modulus,
                "decades": largest,
                "angular_frequency": float(10.0 ** self.log10_frequency[worst[0]]),
            },
        )
        return (sentence,)


def systematic_misfit(log10_frequency: Array, residual: Array, isotherm: Integers) -> SystematicMisfit:
    """Return the part of residuals that neighbouring points have in common."""
    # `log10_frequency` (N,) is log10 of the reduced angular frequency; `residual` (N, m) is measured minus fitted log10
    # E' and log10 E'', decades; `isotherm` (N,) the number of each point's isotherm. The variance of the noise follows
    # from second differences along each isotherm, in which a smooth misfit vanishes (J. von Neumann et al., Ann. Math.
    # Stat. 12 (1941) 153, with first differences).
    squares, noise = np.zeros_like(residual), np.zeros_like(residual)
    for number in np.unique(isotherm):
        rows = np.flatnonzero(isotherm == number)
        rows = rows[np.argsort(log10_frequency[rows], kind="stable")]
        values = residual[rows]
        width = min(NEIGHBOURS, len(rows))
        if len(rows) < 3:
            squares[rows], noise[rows] = 0.0, 0.0
            continue
        ones = np.ones(width)
        count = np.convolve(np.ones(len(rows)), ones, mode="same")
        means = np.stack([np.convolve(column, ones, mode="same") for column in values.T], axis=1) / count[:, None]
        squares[rows] = means**2
        noise[rows] = np.mean(np.diff(values, 2, axis=0) ** 2, axis=0) / 6.0 / count[:, None]
    grid = np.arange(log10_frequency.min(), log10_frequency.max() + 0.5 * WINDOW, 0.5 * WINDOW)
    size = np.zeros((len(grid), residual.shape[1]))
    for place, centre in enumerate(grid):
        near = np.abs(log10_frequency - centre) <= WINDOW
        if np.any(near):
            size[place] = np.sqrt(np.maximum(np.mean(squares[near] - NOISE * noise[near], axis=0), 0.0))
    return SystematicMisfit(grid, size if size.shape[1] > 1 else np.repeat(size, 2, axis=1))
