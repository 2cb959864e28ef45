"""Continuation into contacts whose operator is nearly skew: one retardation time and a stiff glassy state.

The phase of each wave's answer stays well below a right angle once some elastic compliance is added to it, as of a
softer glassy state; then the active set converges from a rough guess.  Less and less is added, each contact starting
from the one before, until nothing is left to add.  Where a step fails, a shorter one is tried.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Protocol

from viscofric.contact.periodic.operator import PeriodicOperator

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.contact.arrays.backend import AnyArray
    from viscofric.contact.complementarity import ComplementaritySolution


_FIRST = 0.3  # of the relaxed compliance that is added
_FACTOR, _LEAST_FACTOR = 1.8, 1.02  # from one added compliance to the next
_LONGER = 1.3  # times as long in its logarithm is each step after one that succeeded
_TOLERANCE = 1e-4  # on the way
_PRODUCTS = 300  # for each contact on the way
_LAST = 0.3  # added compliance over the least of any wave, below which nothing is added


class Solve(Protocol):
    """Solves a contact with another operator."""

    def __call__(
        self, operator: PeriodicOperator, pressure: AnyArray, tolerance: float | None, most: int, /
    ) -> ComplementaritySolution:
        """Solve from a pressure, to a tolerance or to that of the grid."""


def continued(
    operator: PeriodicOperator, relaxed: Array, pressure: AnyArray, solve: Solve, most_products: int
) -> tuple[ComplementaritySolution | None, AnyArray]:
    """Solve a contact by way of softer ones.

    Parameters
    ----------
    operator : PeriodicOperator
        Where it ends; its counters are charged.
    relaxed : (nx, ny//2 + 1) array
        Elastic transfer function of the same geometry, with the same largest value.
    pressure : (nx, ny) array
        To start from.
    solve : Solve
    most_products : int
        After which no more steps are tried.

    Returns
    -------
    result : ComplementaritySolution or None
        If it converged.
    pressure : (nx, ny) array
        Of the last contact that converged, otherwise that given.
    """
    transfer = operator.backend.to_numpy(operator.transfer)
    least = float((transfer.real.ravel()[1:] / relaxed.ravel()[1:]).min())
    added, good, step, start = _FIRST, _FIRST * _FACTOR, math.log(_FACTOR), operator.products
    while True:
        last = added < _LAST * least
        softer = transfer if last else transfer + added * relaxed
        soft = operator if last else PeriodicOperator(softer, operator.shape, operator.precision, operator.backend)
        left = max(most_products - (operator.products - start), 1)
        result = solve(soft, pressure, None if last else _TOLERANCE, left if last else min(_PRODUCTS, left))
        if soft is not operator:
            operator.products += soft.products
            operator.ffts += soft.ffts
        if result.converged:
            pressure, good = result.pressure, added
            step = min(_LONGER * step, math.log(_FACTOR))
        else:
            step *= 0.5
        if result.converged and last:
            return result, pressure
        if step < math.log(_LEAST_FACTOR) or operator.products - start >= most_products:
            return None, pressure
        added = good * math.exp(-step)
