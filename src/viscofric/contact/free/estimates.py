"""Error estimates on nested grids: convergence of each number, and the choice between two friction coefficients."""

from __future__ import annotations

import math
from dataclasses import dataclass
from operator import attrgetter
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arrays import Array, Mask
from viscofric.contact.free.stage import Stage

#: Expression of the friction coefficient: the asymmetry of the pressure, or the balanced energy.
Way = Literal["pressure", "balance"]

FEWEST_GRIDS = 3  # one change alone may be small by chance
# Least doubt of the waves that cells leave out on so few grids: see `Stage.left_out_range`.
_DOUBT_OF_FEW = 0.45
#: Friction is resolved relative to its own value, but not below this fraction of a0/R.
FRICTION_FLOOR = 1e-6
_ROUNDING = 1e-9  # errors above the accuracy by this part of it are within
# Factor by which changes fall from grid to grid at the least.  Those of the friction fall with the power 3/2 of the
# cell on average, 0.35, since the pressure rises like a square root at the edges; those of other numbers with its first
# power.  The rest is for chance.
_FADING, _SLOW_FADING = 0.45, 0.6
# The factor for the friction is measured where at least so many grids were solved: the slope of the last changes,
# shrunk towards the first factor as if that were known from changes whose squared places sum to _PRIOR, and not below a
# third: so much of a change is left of a sequence that falls with the second power of the cell.
_MEASURED_CHANGES, _PRIOR, _LEAST_FADING = 5, 2.0, 1.0 / 3.0

# The error of the friction of point contacts falls with the square of the cell, in the mean: a third of the last change
# is left.  The limit of so many grids or more is used; its error is taken as a part of its own last changes, which fall
# by the factor at the least, and as no less than a part of the error without it.
_LIMIT_GRIDS, _REMAINDER, _LIMIT_SHARE, _LIMIT_FADING, LEAST_SHARE = 4, 1.0 / 3.0, 0.5, 0.3, 0.1

# Least errors, as parts of the difference between friction from the balanced energy and friction from the pressure: of
# the former, and of the latter.
_SHARES = (0.0, 0.5)
# The same where the gap is evaluated behind the cell centres: friction then converges more slowly than its changes
# suggest.
_SHIFTED_SHARES = (0.5, 0.1)
# The same under shear, from `_SHEARED` of the shear's displacement over that by the pressure on: the energy that cells
# leave out is that of an edge where the pressure rises like a square root, which it does not there.
_SHEARED_SHARES, _SHEARED = (1.0, 0.1), 1.0 / 3.0
# Part of the difference that counts as error where the errors of both, that of the pressure times the second number, do
# not explain it.  With these numbers the closed form of the line contact lies within the error on all but one of 700
# grids, at E∞/E0 from 1.1 to 1e4 and v τ/a0 from 1e-6 to 1e6.
_UNEXPLAINED_SHARE, _PRESSURE_FACTOR = 0.5, 3.0
# Factors by which the errors of friction from the pressure and of its limit fall per halving of the cells.
_PRESSURE_ERROR_FALL, _LIMIT_ERROR_FALL = 5.0, 8.0

# The largest pressure is resolved at least this far from the edge (in cells) and with a change of at most this.
_RESOLVED_CELLS = 3
_RESOLVED_CHANGE = 0.02
# Least error of an edge, as a part of a cell: twice the error of the extrapolation on Hertz's contact.
_LEAST_EDGE_ERROR = 0.5


class Estimate(NamedTuple):
    """A number, and its error estimated from its changes between grids."""

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
    """Return the friction coefficient from the quantity that has converged best on the nested grids.

    The asymmetry of the pressure converges fastest where the layer at the leading edge is thinner than a cell; the
    dissipated energy, with what cells leave out of it, nearly everywhere else; and the limits of both on four grids or
    more (see `_limit`) wherever they agree.
    """
    return _best(stages)[1]


def friction_way(stages: list[Stage]) -> Way:
    """Return which expression `friction_estimate` uses, itself or its limit."""
    return _best(stages)[0]


def _best(stages: list[Stage]) -> tuple[Way, Estimate]:
    """Return the friction coefficient, and which expression it is of."""
    last = stages[-1]
    if len(stages) < FEWEST_GRIDS:
        return "balance", Estimate(last.energy_friction, math.inf)
    if len(last.operator.material.compliances) == 0 and last.operator.material.drag == 0.0:
        # An elastic contact dissipates nothing, even if its pressure is asymmetric on the grid.
        return "balance", Estimate(0.0, 0.0)
    energy = np.array([stage.energy_friction for stage in stages])
    pressure = np.array([stage.pressure_friction for stage in stages])
    difference = abs(float(pressure[-1] - energy[-1]))
    shares = np.array(_SHIFTED_SHARES if last.operator.shift > 0.0 else _SHARES)
    sheared = min(1.0, abs(last.operator.material.edge_coupling) / _SHEARED)
    shares += sheared * (_SHEARED_SHARES - shares)
    uncertain = _uncertainty(stages)
    balanced = settled(energy, measured_fading(energy)).at_least(max(uncertain, shares[0] * difference))
    direct = settled(pressure, measured_fading(pressure)).at_least(shares[1] * difference)
    candidates: list[tuple[Way, Estimate]] = [("balance", balanced), ("pressure", direct)]
    if len(stages) >= _LIMIT_GRIDS and _has_limit(last):
        limits = _limit(energy).at_least(uncertain), _limit(pressure)
        apart = abs(limits[0].value - limits[1].value)
        candidates += [("balance", limits[0].at_least(apart)), ("pressure", limits[1].at_least(apart))]
    way, best = min(candidates, key=lambda candidate: candidate[1].error)
    unexplained = difference - balanced.error - _PRESSURE_FACTOR * direct.error  # counts against either
    error = max(best.error, _UNEXPLAINED_SHARE * unexplained)
    return way, Estimate(best.value, last.problem.geometry.scatter * error)


def _has_limit(stage: Stage) -> bool:
    """Whether friction falls smoothly enough with the cell for its limit to be known better than any of its values.

    The two edges of a strip have random places within their cells, which the rim of a point contact averages; behind
    the cell centres and under shear the friction falls with other powers of the cell.
    """
    operator = stage.operator
    return stage.problem.geometry.dimension > 1 and operator.shift == 0.0 and operator.material.edge_coupling == 0.0


def _limit(values: Array) -> Estimate:
    """Return the limit of values on four or more nested grids, coarsest first, that fall with the square of the cell.

    L. F. Richardson, Phil. Trans. R. Soc. A 210 (1911) 307, doi:10.1098/rsta.1911.0009.
    """
    limits = values[1:] + _REMAINDER * np.diff(values)
    error = _LIMIT_SHARE * settled(limits, _LIMIT_FADING).error
    return Estimate(float(limits[-1]), error).at_least(LEAST_SHARE * settled(values, measured_fading(values)).error)


def _uncertainty(stages: list[Stage]) -> float:
    """Return the uncertainty of the energy that cells leave out on the last grid.

    The position of an edge within its cell is random, and so is the energy left out: the largest that the last grids
    make likely is taken, in proportion to the cell.
    """
    last = stages[-1]
    most = max(stage.opening * last.window.spacing / stage.window.spacing for stage in stages[-FEWEST_GRIDS:])
    doubt = _DOUBT_OF_FEW if len(stages) == FEWEST_GRIDS else 0.0
    return last.left_out_range(last.window.spacing, doubt) * most / last.opening if last.opening > 0.0 else 0.0


def least_error(stages: list[Stage], halvings: int) -> float:
    """Return the least relative error of the friction after so many further halvings of the cells.

    That of the balanced energy is at least the uncertainty of the energy that cells leave out, which is known
    beforehand: the gap beside the contact opens in proportion to the cell.  That from the pressure falls with the
    square of the cell, that of its limit with the third power, or a little faster by chance.
    """
    last = stages[-1]
    uncertain = last.left_out_range(last.window.spacing / 2.0**halvings) / 2.0**halvings
    values = np.array([stage.pressure_friction for stage in stages])
    pressure = settled(values, measured_fading(values)).error / _PRESSURE_ERROR_FALL**halvings
    if _has_limit(last) and len(stages) < _LIMIT_GRIDS:
        pressure *= LEAST_SHARE
    elif _has_limit(last):
        pressure = min(pressure, _limit(values).error / _LIMIT_ERROR_FALL**halvings)
    scale = max(abs(last.energy_friction), FRICTION_FLOOR)
    return last.problem.geometry.scatter * min(uncertain, pressure) / scale


def beyond_accuracy(friction: ArrayLike, error: ArrayLike, accuracy: float, slope: float = 1.0) -> Mask:
    """Return where errors of friction exceed the relative accuracy; the floor is that of a contact of this slope."""
    size = np.maximum(np.abs(friction), FRICTION_FLOOR * slope)
    return np.asarray(np.abs(error) > accuracy * size * (1.0 + _ROUNDING))


def settled(values: Array, fading: float = _FADING) -> Estimate:
    """Return the last of three or more values on nested grids, coarsest first, with an estimate of its error.

    The estimate is the largest of the last three changes, that before the last times `fading` and the one before times
    its square, since single changes may be small by chance; `fading` is the factor by which changes decrease from grid
    to grid at the least.  All further changes of a sequence that halves are as large as its last one.
    """
    changes = np.abs(values[1:] - values[:-1])[:-4:-1]
    return Estimate(float(values[-1]), float((changes * fading ** np.arange(len(changes))).max()))


def measured_fading(values: Array) -> float:
    """Return the factor by which the changes of a number on nested grids fall, as far as enough are known."""
    changes = np.abs(np.diff(values))[-_MEASURED_CHANGES:]
    if len(changes) < _MEASURED_CHANGES or not changes.all():
        return _FADING
    places = np.arange(_MEASURED_CHANGES) - 0.5 * (_MEASURED_CHANGES - 1)
    weight = float(places @ places)
    slope = (_PRIOR * math.log(_FADING) + float(places @ np.log(changes))) / (_PRIOR + weight)
    return min(_FADING, max(_LEAST_FADING, math.exp(slope)))


def error_of(stages: list[Stage], name: str) -> float:
    """Error estimate of a number of each stage that depends on where the edges are, such as "footprint.area"."""
    values = np.array([attrgetter(name)(stage) for stage in stages])
    return stages[-1].problem.geometry.scatter * settled(values, _SLOW_FADING).error


@dataclass(frozen=True)
class FootprintErrors:
    """Error estimates of the finest footprint from its changes on the nested grids."""

    edge: float
    area: float
    peak: float  # if it is not resolved, at least the peak itself and what the leading edge or a tip may hide
    peak_resolved: bool

    @classmethod
    def of(cls, stages: list[Stage]) -> FootprintErrors:
        """Estimate from all stages, coarsest first."""
        last, shift = stages[-1].footprint, stages[-1].operator.shift
        cell = max(stages[-1].window.spacing, stages[-1].window.width)
        least = stages[-1].problem.geometry.scatter * cell * max(_LEAST_EDGE_ERROR, 2.0 * shift)
        sides = [name for name in ("front", "rear", "side") if math.isfinite(getattr(last, name))]
        rim = last.area / max(last.front + last.rear, cell)  # the contact's width across, one for a line contact
        peak = settled(np.array([stage.footprint.peak for stage in stages]), _SLOW_FADING).error
        # A layer at the leading edge that is thinner than a cell, and a tip, hide a pressure that no grid resolves.
        deep, still = last.peak_depth >= _RESOLVED_CELLS, peak <= _RESOLVED_CHANGE * last.peak
        hidden = _hidden_peak(stages[-1])
        seen = shift == 0.0 and hidden < last.peak
        resolved = deep and still and seen
        # The edge lies between the last loaded cell's centre and the next one's, wherever a coarser grid had it.
        most = cell if seen else math.inf
        return cls(
            edge=max(least, min(most, max(error_of(stages, f"footprint.{name}") for name in sides))),
            area=max(least * rim, error_of(stages, "footprint.area")),
            peak=peak if resolved else max(peak, hidden, last.peak),
            peak_resolved=resolved,
        )


def _hidden_peak(stage: Stage) -> float:
    """Largest pressure that the leading edge or a tip may hide from the cells, in order of magnitude.

    The pressure of a cell rises as B √s with the distance s from the edge.  Where the compliance for waves as short as
    s is smaller by a factor than for those that the cells resolve, the pressure at s is higher by that factor: for one
    retardation time √(k l)/2 at s = l/k, where the exact layer, a Dawson function, has 0.54 √(k l).

    At a tip the pressure is infinite: it rises as half the slope times ln(1/s), over the compliance (see
    `sneddon_cone`).  Its value at the shortest distance is used.
    """
    spacing, pressure = stage.window.spacing, stage.result.pressure
    along = pressure[:, int(np.argmax(pressure.max(axis=0)))]
    last = int(np.flatnonzero(along)[-1])
    outer, inner = along[last] ** 2, along[last - 1] ** 2
    steepness = math.sqrt((max(inner - outer, outer) if inner > outer else 2.0 * outer) / spacing)  # as in `edges`
    distance = spacing * np.logspace(-12.0, 0.0, 49)
    yielding = np.abs(stage.operator.material.symbol(1.0 / distance))
    pressure_at = steepness * np.sqrt(distance) * yielding[-1]
    if stage.problem.shape.has_tip:
        slope = abs(float(stage.problem.shape.slope(np.array([spacing]), np.zeros(1))[0]))
        pressure_at += stage.footprint.peak * yielding[-1] + 0.5 * slope * np.log(spacing / distance)
    return float(np.max((pressure_at / yielding)[:-1]))
