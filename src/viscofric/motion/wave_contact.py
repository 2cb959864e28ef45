"""The contact problem of one step of a periodic surface, solved from a pressure that is nearly right.

Anderson's acceleration [1]_ of a projected iteration.  A combination of the last changes of the pressure, whose
displacements are known, reduces the residual (the gap under pressure and the overlap without it); the preconditioner
reduces what is left.  Negative pressures become zero.  The displacement of the whole change is the only product of an
iteration; it is in single precision where that is exact enough.  Where the contact does not change, this is a truncated
method of minimal residuals.

.. [1] H. F. Walker, P. Ni, SIAM J. Numer. Anal. 49 (2011) 1715, doi:10.1137/10078356X.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from viscofric.arrays import Array
from viscofric.contact.arrays.backend import Cells
from viscofric.contact.extension import Extension
from viscofric.contact.periodic.one_grid import OneGrid, Stage
from viscofric.contact.periodic.operator import PeriodicOperator
from viscofric.errors import ConvergenceError

# Changes that are combined; iterations without a smaller residual, and iterations, after which another method is used.
_COMBINED, _PATIENCE, _MOST = 2, 6, 60
_MOST_PRODUCTS = 10_000  # of that method, the one of steady contacts
# Error of a product in single precision, as a part of its largest value (5e-7 on grids up to 2048², with a margin), and
# the part of the tolerance that it may be.
_SINGLE_ERROR, _SINGLE_PART = 1e-6, 0.1
# Largest residual of one point, over the root mean square, of a contact that is solved; points in contact from which on
# the root mean square may be as large as the tolerance; that of fewer must be less, since they cancel less in forces.
_LARGEST, _MANY = 20.0, 1000
# Least eigenvalue of the products of normalised displacements, over the largest, that is used: others are of rounding.
_ALIKE = 1e-5


class Target(NamedTuple):
    """Target of a step: the sum of the pressures or the indentation, and the tolerance of the root mean square gap."""

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

    def solved(self, gap: Array, guess: Array | None, target: Target) -> tuple[Array, float, int]:
        """Return pressure, indentation and the number of products; ConvergenceError if none are found."""
        # `gap` is that of the guess of the pressure, None if that is zero, at an indentation of zero; both are
        # overwritten.
        start, pressure = self.products, guess
        if pressure is not None:
            indentation = self._followed(gap, pressure, target)
            if indentation is not None:
                return pressure, indentation, self.products - start
            gap = gap - self.exact(pressure)
        # The method of steady contacts converges from any initial guess.
        mean = None if target.load is None else target.load / gap.size
        level = None if target.indentation is None else float(gap.mean()) - target.indentation
        stage = Stage(gap, self.exact.transfer, self.relaxed, self.toward)
        one = OneGrid(stage, mean, level, target.tolerance, _MOST_PRODUCTS, self.exact.backend)
        result = one.solve(pressure)
        if not result.converged:
            raise ConvergenceError(
                f"a step of the contact did not converge: a gap of {result.complementarity:.2g} rms heights was left; "
                "ask for less accuracy.",
                code="not-converged",
            )
        return result.pressure, result.indentation, self.products - start + one.products

    def _followed(self, gap: Array, pressure: Array, target: Target) -> float | None:
        """Change a pressure and its gap until they meet the target; return the indentation, None if they do not."""
        p, g = pressure.reshape(-1), gap.reshape(-1)
        changes: list[_Change] = []
        loaded = np.flatnonzero(p > 0.0)
        least, since = np.inf, 0
        for _ in range(_MOST):
            level = float(g[loaded].mean()) if target.indentation is None else target.indentation
            chosen = gap < level
            chosen.reshape(-1)[loaded] = True
            contact = self.exact.backend.cells(chosen)
            residual = level - g[contact.indices]
            count = max(len(residual), 1)
            left = math.sqrt(float(residual @ residual) / count)
            allowed = target.tolerance * min(1.0, math.sqrt(count / _MANY))
            if left <= allowed and float(np.abs(residual).max(initial=0.0)) <= _LARGEST * allowed:
                return level
            least, since = (left, 0) if left < least else (least, since + 1)
            if since == _PATIENCE:
                return None
            old = p[contact.indices]
            values = old + self._correction(residual, contact, changes, target.load is not None)
            np.maximum(values, 0.0, out=values)
            if target.load is not None:
                total = float(values.sum())
                if total == 0.0:
                    return None
                values *= target.load / total
            changes = [*changes[1 - _COMBINED :], self._displaced(contact, values - old, target.tolerance)]
            p[contact.indices] = values
            g += changes[-1].image
            loaded = contact.indices[values > 0.0]
        return None

    def _displaced(self, contact: Cells, change: Array, tolerance: float) -> _Change:
        """Return a change of the pressure on cells with its displacement, in single precision if that is enough."""
        field = contact.scattered(change.astype(self.single.precision))
        image = self.single(field)
        largest = max(float(image.max()), -float(image.min()))
        if _SINGLE_ERROR * largest > _SINGLE_PART * tolerance:
            image = self.exact(contact.scattered(change))
        return _Change(field.reshape(-1), image.reshape(-1))

    def _correction(self, residual: Array, contact: Cells, changes: list[_Change], fixed_load: bool) -> Array:
        """Return the change of the pressure at the cells of a contact that closes their gap, or levels it."""
        if fixed_load:
            residual -= residual.mean()
        combined = None
        if changes:
            fields, images = (np.array([each[contact.indices] for each in kind]) for kind in zip(*changes, strict=True))
            if fixed_load:
                images -= images.mean(axis=1, keepdims=True)
            products = (images @ images.T).astype(float)
            sizes = np.sqrt(np.diag(products))
            sizes[sizes == 0.0] = 1.0
            overlaps = images @ residual.astype(images.dtype) / sizes
            weights = np.linalg.lstsq(products / np.outer(sizes, sizes), overlaps, rcond=_ALIKE)[0] / sizes
            residual -= weights @ images
            combined = weights @ fields
        values = residual.astype(self.single.precision)
        extended = contact.scattered if self.extension is None else self.extension.on(contact)
        correction = contact.gathered(self.single.precondition(extended(values)))
        if combined is not None:
            correction = correction + combined
        if fixed_load:
            correction -= correction.mean()
        return np.asarray(correction)


class _Change(NamedTuple):
    """A change of the pressure, and the displacement that it causes."""

    field: NDArray[np.float32]  # (cells,)
    image: NDArray[np.float32] | Array
