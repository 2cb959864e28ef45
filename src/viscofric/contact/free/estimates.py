"""Numbers on nested grids: how well they have settled, and which way to the friction has settled best."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.contact.free.problem import Stage

    Array: TypeAlias = NDArray[np.float64]

FEWEST_GRIDS = 3  # one change alone may be small by chance
#: Friction is resolved relative to its own value, but not below this fraction of a0/R.
FRICTION_FLOOR = 1e-6
#: Of numbers other than friction: they settle with the first power of the cell at the least.
SLOW_FADING = 0.5

# Parts of the difference between the two ways to friction that are claimed as error at the least, of the balanced
# energy and of the lean; where the gap is looked at behind the cell centres, since friction then settles more slowly
# than its changes promise; and of what the errors of both do not explain, the lean's taken generously.  With these,
# the closed form of the line contact lies within the error on all but one of 700 grids, at E∞/E0 from 1.1 to 1e4 and
# v τ/a0 from 1e-6 to 1e6.
_SHARES = (0.0, 0.5)
_SHIFTED_SHARES = (0.5, 0.1)
_UNEXPLAINED_SHARE, _LEAN_TRUST = 0.5, 3.0
_FALL_OF_LEAN = 5.0


class Estimate(NamedTuple):
    """A number and the error that its changes from grid to grid let expect."""

    value: float
    error: float

    @property
    def relative_error(self) -> float:
        """Error relative to the value, or to `FRICTION_FLOOR` for smaller ones."""
        return self.error / max(abs(self.value), FRICTION_FLOOR)

    def at_least(self, error: float) -> Estimate:
        """Return the estimate with an error no smaller than the given one."""
        return self._replace(error=max(self.error, error))


def friction_estimate(stages: list[Stage]) -> Estimate:
    """Return the friction coefficient from the quantity that has settled best on the nested grids.

    The lean of the pressure settles quickest where the layer at the leading edge is thinner than a cell; the
    dissipated energy, with what cells leave out of it, nearly everywhere else.
    """
    last = stages[-1]
    if len(stages) < FEWEST_GRIDS:
        return Estimate(last.balanced_friction.value, math.inf)
    if len(last.operator.material.compliances) == 0:
        return Estimate(0.0, 0.0)  # an elastic contact dissipates nothing, however its pressure leans on the grid
    energy = np.array([stage.balanced_friction.value for stage in stages])
    lean = np.array([stage.pressure_friction for stage in stages])
    difference = abs(float(lean[-1] - energy[-1]))
    shares = _SHIFTED_SHARES if last.operator.shift > 0.0 else _SHARES
    balanced = settled(energy).at_least(max(_uncertainty(stages), shares[0] * difference))
    leaning = settled(lean).at_least(shares[1] * difference)
    best = min(balanced, leaning, key=lambda candidate: candidate.error)
    unexplained = difference - balanced.error - _LEAN_TRUST * leaning.error  # speaks against either
    error = max(best.error, _UNEXPLAINED_SHARE * unexplained)
    return Estimate(best.value, last.problem.geometry.scatter * error)


def _uncertainty(stages: list[Stage]) -> float:
    """How uncertain is what cells leave out of the energy on the last grid.

    Where in its cell an edge lies is a matter of luck, and so is what is left out: the most that the last grids make
    likely is taken, in proportion to the cell.
    """
    last = stages[-1]
    most = max(stage.opening * last.window.spacing / stage.window.spacing for stage in stages[-FEWEST_GRIDS:])
    return last.balanced_friction.error * most / last.opening if last.opening > 0.0 else 0.0


def least_error(stages: list[Stage], halvings: int) -> float:
    """Relative error that the friction has at the least after so many further halvings of the cells.

    That of the balanced energy is no less than what is uncertain of what cells leave out, which is known beforehand:
    the gap beside the contact opens in proportion to the cell.  That of the lean falls with the square of the cell, or
    a little faster by chance.
    """
    last = stages[-1]
    uncertain = last.left_out_range(last.window.spacing / 2.0**halvings) / 2.0**halvings
    lean = settled(np.array([stage.pressure_friction for stage in stages])).error / _FALL_OF_LEAN**halvings
    scale = max(abs(last.balanced_friction.value), FRICTION_FLOOR)
    return last.problem.geometry.scatter * min(uncertain, lean) / scale


def settled(values: Array, fading: float = 0.25) -> Estimate:
    """Return the last of three or more values on nested grids, with an estimate of its error.

    With changes d1 (the last) and d0 before it, a geometric sequence has d1/(d0/d1 − 1) still to go.  No less than
    d1 is taken, nor than d0 and the one before times the fading, once and twice, since single changes may be small by
    chance.

    Parameters
    ----------
    values : (n,) array
        From the coarsest grid on.
    fading : float
        By which changes are expected to fall from grid to grid: `SLOW_FADING` where nothing but these changes tells of
        the error.
    """
    changes = np.abs(np.diff(values))[-3:]
    before, last = changes[-2:]
    ratio = max(before / last, 1.25) if last > 0.0 else math.inf
    faded = changes * fading ** np.arange(len(changes) - 1.0, -1.0, -1.0)
    return Estimate(float(values[-1]), float(max(last / (ratio - 1.0), *faded)))
