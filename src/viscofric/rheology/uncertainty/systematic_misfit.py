"""What a fit misses alike over neighbouring points: no noise, and no bootstrap of noise shows it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from viscofric.arrays import Array, Integers


#: Residuals are averaged over so many neighbours along an isotherm: noise is averaged out, a misfit is not.
NEIGHBOURS = 5
#: Averages count as misfit by what they exceed so many times the variance that noise leaves in them.
NOISE = 3.0
#: The misfit at a frequency is that of all points so near to it, whatever their isotherm.
WINDOW = 0.5  # decades
#: It is told in a note from this size on: sweeps of one sample repeat no better.
WORTH_TELLING = 0.02  # decades


@dataclass(frozen=True, eq=False)
class SystematicMisfit:
    """Root mean square of what a fit misses beyond noise.

    Parameters
    ----------
    log10_frequency : (n,) array
        log10 of the reduced angular frequencies, ascending.
    size : (n, 2) array
        Of log10 E' and of log10 E'' there, decades; beyond the ends it keeps its value.
    """

    log10_frequency: Array
    size: Array

    def __repr__(self) -> str:
        return f"SystematicMisfit(up to {float(self.size.max()):.2g} decades)"

    def at(self, log10_frequency: Array) -> Array:
        """Return the size at frequencies, in their shape and (2,), decades."""
        return np.stack([np.interp(log10_frequency, self.log10_frequency, one) for one in self.size.T], axis=-1)

    @property
    def notes(self) -> tuple[str, ...]:
        """One sentence where the misfit is worth telling."""
        worst = np.unravel_index(int(np.argmax(self.size)), self.size.shape)
        largest = float(self.size[worst])
        if largest < WORTH_TELLING:
            return ()
        modulus = ("E'", "E''")[worst[1]]
        sentence = (
            f"The fit misses the measured moduli by more than noise, {modulus} by up to {largest:.2g} decades "
            f"({100.0 * (10.0**largest - 1.0):.2g} %) near {10.0 ** self.log10_frequency[worst[0]]:.1g} rad/s, alike "
            "over neighbouring points: isotherms do not superpose, or the spectrum cannot follow them. The bands of "
            "E' and E'' are widened by it; those of other quantities hold for noise alone."
        )
        return (sentence,)


def systematic_misfit(log10_frequency: Array, residual: Array, isotherm: Integers) -> SystematicMisfit:
    """Find what residuals have in common with their neighbours.

    Parameters
    ----------
    log10_frequency : (N,) array
        log10 of the reduced angular frequency of the points.
    residual : (N, 2) array
        Measured less fitted, log10 E' and log10 E'', decades.
    isotherm : (N,) array of int
        Number of each point's isotherm.

    Notes
    -----
    The variance of the noise follows from second differences along each isotherm, which a smooth misfit has none of
    (J. von Neumann et al., Ann. Math. Stat. 12 (1941) 153, with first differences).
    """
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
    size = np.zeros((len(grid), 2))
    for place, centre in enumerate(grid):
        near = np.abs(log10_frequency - centre) <= WINDOW
        if np.any(near):
            size[place] = np.sqrt(np.maximum(np.mean(squares[near] - NOISE * noise[near], axis=0), 0.0))
    return SystematicMisfit(grid, size)
