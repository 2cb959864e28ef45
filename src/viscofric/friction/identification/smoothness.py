"""What is assumed of a retardation spectrum before anything is measured: that it is smooth, and little else."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from viscofric.arrays import Array


#: Standard deviation of the mean of ln C about the first guess, and of ln(1/E_inf) about the compliance that is seen: a
#: rubber of little loss has most of it, one amidst its transition a hundredth.
LEVEL = 3.0
GLASS = 2.0
#: Standard deviation of the mean slope d ln C/d ln τ: it lies between the −1 and 1 of power-law moduli, as a rule.
SLOPE = 0.7
#: Roughnesses that are weighed against each other, standard deviation of d ln C/d ln τ over an e-fold of τ.
ROUGHNESS = np.geomspace(0.02, 1.3, 10)
#: The middle and the logarithmic standard deviation of what is expected of them.
EXPECTED, EXPECTED_SPREAD = 0.15, 1.0
#: Roughness near the ends of the contact's frequencies and beyond, where no data determine it: a spectrum may end, or
#: rise to the glass transition, within a third of a decade.
OUTSIDE = 1.5


@dataclass(frozen=True, eq=False)
class Smoothness:
    """Normal prior of x = (ln(1/E_inf), ln C_1 … ln C_m): a random walk of second order with a broad level and slope.

    Its density is exp(−|A (x − middle)|²/2) |A|, with A square.

    Parameters
    ----------
    tau : (m,) array
        In geometric progression, s.
    compliance : float
        First guess of 1/|E|, 1/Pa.
    inside : (shortest, longest)
        Retardation times whose modes the friction sees from both sides, s.
    roughness : float
        Standard deviation of the change of d ln C/d ln τ over an e-fold of τ, inside.
    """

    tau: Array
    compliance: float
    inside: tuple[float, float]
    roughness: float

    @cached_property
    def middle(self) -> Array:
        """What is expected, (1 + m,)."""
        spacing = float(np.log(self.tau[-1] / self.tau[0])) / (len(self.tau) - 1)
        level = np.log(self.compliance) + np.log(0.1 * spacing)
        return np.concatenate([[np.log(self.compliance)], np.full(len(self.tau), level)])

    @cached_property
    def matrix(self) -> Array:
        """A, (1 + m, 1 + m)."""
        m = len(self.tau)
        places = np.log(self.tau)
        spacing = float(places[-1] - places[0]) / (m - 1)
        within = (self.tau[1:-1] >= self.inside[0]) & (self.tau[1:-1] <= self.inside[1])
        rough = np.where(within, self.roughness, max(OUTSIDE, self.roughness))
        curvature = np.diff(np.eye(m), 2, axis=0) / (rough * spacing**1.5)[:, None]
        away = places - places.mean()
        level = np.full((1, m), 1.0 / (m * LEVEL))
        slope = (away / (away @ away) / SLOPE)[None, :]
        rows = np.concatenate([level, slope, curvature])
        matrix = np.zeros((m + 1, m + 1))
        matrix[0, 0] = 1.0 / GLASS
        matrix[1:, 1:] = rows
        return matrix

    @property
    def log_volume(self) -> float:
        """Logarithm of |A|, and the expectation of the roughness itself."""
        expected = -0.5 * float(np.log(self.roughness / EXPECTED) / EXPECTED_SPREAD) ** 2
        return float(np.linalg.slogdet(self.matrix)[1]) + expected
