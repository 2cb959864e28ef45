"""Noise of a master curve as its residuals show it: how large in each isotherm, and how alike along it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from viscofric.arrays import Array, Integers


#: Isotherms are told apart in scatter only with so many points; fewer say nothing of their own.
LEAST_POINTS = 3
#: A point that the fit has followed further than this tells of no error.
LARGEST_LEVERAGE = 0.9
#: Neighbours more alike than this would be an offset of the whole isotherm, which its own shift takes up.
MOST_ALIKE = 0.95


class Residuals:
    """Residuals of ln E' and ln E'' about a fit, and errors drawn like them.

    Errors are drawn from a normal distribution, of each isotherm's own scatter, correlated between E' and E''
    as the residuals are, and between neighbouring points of an isotherm by an autoregression of first order.
    Residuals themselves are not drawn, in blocks or otherwise: the fit has taken from them all that is smooth,
    which is the part of the errors that it answers to.

    Parameters
    ----------
    values : (N, 2) array
        Residuals of ln E' and ln E'', isotherm by isotherm, in ascending frequency within each.
    isotherm : (N,) array of int
        Number of the isotherm of each row, ascending from 0, none left out.
    leverage : (N, 2) array
        Part of each point's error that the fit has followed, 0 to 1; residuals are that much smaller than errors.

    References
    ----------
    Scatter of each isotherm, drawn towards the common one as far as they do not differ by more than chance:
    G. K. Smyth, Stat. Appl. Genet. Mol. Biol. 3 (2004) 3.
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
        self.together = float(np.sum(unit[:, 0] * unit[:, 1]) / np.sqrt(np.prod(total)))
        starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
        self._steps = [starts[counts > step] + step for step in range(1, int(counts.max()))]

    def draw(self, random: np.random.Generator, samples: int) -> Array:
        """Return errors of ln E' and ln E'', (samples, N, 2), in the order of the residuals."""
        errors = random.standard_normal((samples, *self.scale.shape))
        rest = np.sqrt(max(1.0 - self.together**2, 0.0))
        errors[..., 1] = self.together * errors[..., 0] + rest * errors[..., 1]
        if np.any(self.alike > 0.0):
            fresh = np.sqrt(1.0 - self.alike**2)
            for rows in self._steps:
                errors[:, rows] = self.alike * errors[:, rows - 1] + fresh * errors[:, rows]
        return np.asarray(self.scale * errors)


def _moderated(squares: Array, counts: Integers) -> Array:
    """Return the variance of each isotherm, drawn towards the common one as chance asks.

    With ν0 the freedom of the common variance s0², that of an isotherm is (ν0 s0² + Σ r²)/(ν0 + n).  ν0 follows
    from how much more ln s² scatters over the isotherms than the ψ'(n/2) of pure chance: ψ'(ν0/2) is the rest.
    """
    from scipy.optimize import brentq
    from scipy.special import polygamma

    common = float(squares.sum() / counts.sum())
    told = (counts >= LEAST_POINTS) & (squares > 0.0)
    if common <= 0.0 or told.sum() < LEAST_POINTS:
        return np.full(len(counts), common)
    logarithms = np.log(squares[told] / counts[told])
    rest = float(np.var(logarithms, ddof=1) - np.mean(polygamma(1, 0.5 * counts[told])))
    if rest <= polygamma(1, 5e3):  # no more than chance
        return np.full(len(counts), common)
    freedom = 2.0 * brentq(lambda half: float(polygamma(1, half)) - rest, 1e-3, 1e4)
    return np.asarray((freedom * common + squares) / (freedom + counts))
