"""Numbers on nested grids: how well they have settled, and which way to the friction has settled best."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.contact.problem import Stage

    Array: TypeAlias = NDArray[np.float64]

FEWEST_GRIDS = 3  # one change alone may be small by chance
#: Friction is resolved relative to its own value, but not below this fraction of a0/R.
FRICTION_FLOOR = 1e-6


class Estimate(NamedTuple):
    """A number and the error that its changes from grid to grid let expect."""

    value: float
    error: float

    @property
    def relative_error(self) -> float:
        """Error relative to the value, or to `FRICTION_FLOOR` for smaller ones."""
        return self.error / max(abs(self.value), FRICTION_FLOOR)


def friction_estimate(stages: list[Stage]) -> Estimate:
    """Return the friction coefficient from the quantity that has settled best on the nested grids.

    The lean of the pressure settles quickest where friction is large; the dissipated energy where it is small
    against the contact's slope a/R (at low and high speed), because it does not live on a small difference.  At low
    speed its error is of first order in the cell, so that its linear extrapolation is the third candidate.  Where the
    indenter has a wall, the energy alone can tell: the wall's share does not show in the lean.
    """
    last = stages[-1]
    if len(stages) < FEWEST_GRIDS:
        return Estimate(last.energy_friction if last.problem.shape.has_walls else last.pressure_friction, math.inf)
    if len(last.operator.material.compliances) == 0:
        return Estimate(0.0, 0.0)  # an elastic contact dissipates nothing, however its pressure leans on the grid
    energy = np.array([stage.energy_friction for stage in stages])
    candidates = [settled(energy)]
    if len(stages) > FEWEST_GRIDS:
        candidates.append(settled(2.0 * energy[1:] - energy[:-1]))
    if last.problem.shape.has_walls:
        return min(candidates, key=lambda candidate: candidate.error)
    lean = np.array([stage.pressure_friction for stage in stages])
    candidates.insert(0, settled(lean))
    best = min(candidates, key=lambda candidate: candidate.error)
    # However well one has settled, part of what the two ways differ by is claimed as error: most where their own
    # errors do not explain the difference, or where the gap is looked at behind the cell centres, since friction
    # then settles more slowly than its changes promise; much on three grids, whose two changes may both be small by
    # chance; little otherwise.
    difference = abs(float(lean[-1] - energy[-1]))
    explained = difference <= candidates[0].error + candidates[1].error and last.operator.shift == 0.0
    share = 0.5 if not explained else 0.35 if len(stages) == FEWEST_GRIDS else 0.1
    return Estimate(best.value, last.problem.geometry.scatter * max(best.error, share * difference))


def settled(values: Array) -> Estimate:
    """Return the last of three or more values on nested grids, with an estimate of its error.

    With changes d1 (the last) and d0 before it, a geometric sequence has d1/(d0/d1 − 1) still to go.  No less than
    d1 is taken, nor than d0/4 and a sixteenth of the one before, since single changes may be small by chance.
    """
    changes = np.abs(np.diff(values))[-3:]
    before, last = changes[-2:]
    ratio = max(before / last, 1.25) if last > 0.0 else math.inf
    faded = changes * 0.25 ** np.arange(len(changes) - 1.0, -1.0, -1.0)
    return Estimate(float(values[-1]), float(max(last / (ratio - 1.0), *faded)))
