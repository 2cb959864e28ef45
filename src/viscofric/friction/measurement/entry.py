"""What the readings of one condition say: four numbers and how well they are known."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from viscofric.arrays import Array


@dataclass(frozen=True, eq=False)
class Entry:
    """Zero (N), viscoelastic and Coulomb coefficient and consistency of a condition, in this order.

    `freedom` is the number of degrees of freedom behind each error, infinite where it is known; what cannot be
    known has an infinite error.
    """

    value: Array
    error: Array
    scatter: Array
    freedom: Array
    replicates: int
    together: bool
    slides: bool
    checks: bool

    def widened(self, variance: Array, freedom: float) -> Entry:
        """Add an independent variance (4,) to the squared errors; degrees of freedom after Welch and Satterthwaite."""
        error = np.sqrt(self.error**2 + variance)
        finite = np.isfinite(error) & (variance > 0.0)
        squares = np.full(4, 0.0)
        for part, behind in ((self.error**2, self.freedom), (variance, np.full(4, freedom))):
            share = np.divide(part, error**2, out=np.zeros(4), where=finite)
            squares += np.divide(share**2, behind, out=np.zeros(4), where=finite & (behind > 0.0))
        freedoms = np.divide(1.0, squares, out=np.full(4, np.inf), where=squares > 0.0)
        return replace(self, error=error, freedom=np.where(finite, freedoms, self.freedom))
