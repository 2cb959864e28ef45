"""The contact problem of one step of a periodic surface, solved from a guess that is nearly right.

The active set of `viscofric.contact.complementarity` in a form that touches the whole grid little: the gap is computed
once, and changes by products with the corrections of the pressure, in single precision where that is exact enough.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.contact.complementarity import solve_on_contact
from viscofric.contact.periodic.one_grid import OneGrid, Stage
from viscofric.errors import ConvergenceError

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.arrays import Array
    from viscofric.contact.extension import Extension
    from viscofric.contact.periodic.operator import PeriodicOperator

# Reduction of a linear residual while more than the given part of the contact's cells is wrongly classified.
_REDUCTIONS = ((0.02, 0.3), (0.0003, 0.1), (0.0, 1e-2))
_PATIENCE, _DIRECTIONS, _FEW_PRODUCTS = 6, 12, 200
_MOST_PRODUCTS = 10_000  # of the method of steady contacts
# Error of a product in single precision, as a part of its largest value, with a margin.
_SINGLE_ERROR = 3e-5


class Target(NamedTuple):
    """Target of a step: the sum of the pressures or the indentation, and the tolerance of the gap."""

    load: float | None
    indentation: float | None
    tolerance: float


@dataclass(frozen=True, eq=False)
class StepContact:
    """Contact problems of steps of one length along one path."""

    exact: PeriodicOperator
    single: PeriodicOperator
    extension: Extension | None  # of residuals
    toward: tuple[float, float]  # direction of the motion, in cells
    relaxed: Callable[[], Array]  # see `viscofric.contact.periodic.one_grid.Stage`

    @property
    def products(self) -> int:
        """Products with the operators so far."""
        return self.exact.products + self.single.products

    def solved(self, height: Array, target: Target, guess: Array | None) -> tuple[Array, float, int]:
        """Return pressure, indentation and the number of products; ConvergenceError if none are found."""
        before = self.products
        pressure = None
        if guess is not None and np.any(guess > 0.0):
            pressure, indentation = self._followed(height, target, guess)
            if indentation is not None:
                return pressure, indentation, self.products - before
        # The method of steady contacts converges from any initial guess.
        mean = None if target.load is None else target.load / height.size
        gap = None if target.indentation is None else float(height.mean()) - target.indentation
        stage = Stage(height, self.exact.transfer, self.relaxed, self.toward)
        one = OneGrid(stage, mean, gap, target.tolerance, _MOST_PRODUCTS, self.exact.backend)
        result = one.solve(guess if pressure is None else pressure)
        if not result.converged:
            raise ConvergenceError(
                f"a step of the contact did not converge: a gap of {result.complementarity:.2g} rms heights was left; "
                "ask for less accuracy.",
                code="not-converged",
            )
        return result.pressure, result.indentation, self.products - before + one.products

    def _followed(self, height: Array, target: Target, guess: Array) -> tuple[Array, float | None]:
        """Return the pressure and the indentation, None if the pressure has not converged."""
        pressure = np.maximum(guess, 0.0)
        if target.load is not None:
            pressure *= target.load / pressure.sum()
        gap = self.exact(pressure) + height
        loaded = pressure > 0.0
        p, g, taken = pressure.reshape(-1), gap.reshape(-1), loaded.reshape(-1)
        cells = np.flatnonzero(taken)
        reduction, least, since = _REDUCTIONS[0][1], np.inf, 0
        most = self.products + _FEW_PRODUCTS
        while since < _PATIENCE and self.products < most and len(cells):
            under = g[cells]
            level = float(under.mean()) if target.indentation is None else target.indentation
            under -= level
            worst = max(float(np.abs(under).max()), level - float(g.min()))
            if worst <= target.tolerance:
                return pressure, level
            least, since = (worst, 0) if worst < least else (least, since + 1)
            overlapping = np.flatnonzero(g < level)
            overlapping = overlapping[~taken[overlapping]]
            taken[overlapping] = True
            contact = self.exact.backend.cells(loaded)
            correction, _, _ = solve_on_contact(
                self.single, g[contact.indices] - level, contact, reduction=reduction, floor=0.5 * target.tolerance,
                directions=_DIRECTIONS, fixed_load=target.load is not None, extension=self.extension,
            )  # fmt: skip
            old = p[contact.indices]
            values = old + correction
            kept = values > 0.0
            values[~kept] = 0.0
            if target.load is not None and kept.any():
                values *= target.load / values.sum()
            p[contact.indices] = values
            if _SINGLE_ERROR * worst < target.tolerance:
                gap += self.single(contact.scattered((values - old).astype(self.single.precision)))
            else:
                np.add(self.exact(pressure), height, out=gap)
            wrong = len(overlapping) + len(kept) - int(np.count_nonzero(kept))
            reduction = next(each for part, each in _REDUCTIONS if wrong > part * len(kept) or part == 0.0)
            cells = contact.indices[kept]
            taken[contact.indices[~kept]] = False
        return pressure, None
