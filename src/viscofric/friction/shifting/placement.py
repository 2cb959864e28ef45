"""Rough alignment of friction curves of several temperatures: which of them overlap, and at which shift.

Each temperature has a smooth curve of its own, with its covariance.  At every step of log10 α two curves are compared
over the stretch where both were measured.  Two curves without a common stretch do not contradict each other.  So a step
at which they coincide is an overlap only if contradiction bounds it on both sides: of curves that can be moved apart
without contradiction no overlap is known, and curves of constant friction can always be moved.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Literal, TypeAlias

import numpy as np

from viscofric.arrays import Array
from viscofric.friction.shifting.isotherms import FrictionIsotherm

#: Curves are moved along each other in steps of this many decades …
STEP = 0.02
#: … while at least this many points of each lie over the other one.
FEWEST_POINTS = 2
#: They are compared at both ends and in the middle of what they have in common.
PLACES = np.array([0.0, 0.5, 1.0])
#: Least error of a curve between its points, decades of friction.
READING = 0.004
#: χ² of the comparison that noise exceeds in one of 60 000 pairs (three degrees of freedom).
LARGEST_MISFIT = 25.0
#: Increase of χ², from a step where curves coincide, that contradicts another step: three standard deviations.
CONTRADICTION = 9.0
#: Increase of χ² for which an end of one of two curves may be an outlier, and is left out: −2 ln of a probability of 1
#: in 10,000.
ONE_OUTLIER = 18.0
#: α falls as temperature rises; a rise by this much is tolerated.
WRONG_WAY = 0.05  # decades
#: If more than this part of all steps is possible, the curves are too flat.
FLAT = 0.4
#: Largest number of arrangements kept at a time.
BREADTH = 12
#: Positions closer than this are equal, decades.
SAME_POSITION = 0.1
#: An arrangement whose squares exceed those of the best one by less is as good, in squares of standard deviations.
AS_GOOD = 9.0


@dataclass(frozen=True, eq=False)
class Pair:
    """Steps of log10 α between two temperatures at which their curves coincide."""

    steps: Array  # (k,), log10 α of the colder minus that of the warmer, all that were tried
    chi2: Array  # (k,), squared difference of the curves at each, in units of its covariance
    # steps where the curves coincide, best first, and by how many standard deviations contradiction bounds each on both
    # sides, above the root of CONTRADICTION
    candidates: dict[float, float]
    # "rising" if the curves coincide only with an α that rises with temperature
    verdict: Literal["overlap", "rising", "flat", "apart"]

    def cost(self, step: float) -> float:
        """Return χ² at a step minus its expectation; zero where the curves do not overlap."""
        if not self.steps.size or not self.steps[0] <= step <= self.steps[-1]:
            return 0.0
        return float(np.interp(step, self.steps, self.chi2)) - len(PLACES)


def scan(colder: FrictionIsotherm, warmer: FrictionIsotherm, scale: float) -> Pair:
    """Compare two curves at all steps between them; `scale` multiplies the variances of both."""
    steps = _steps(colder, warmer)
    if not steps.size:
        return Pair(steps, steps, {}, "apart")
    chi2 = _chi2(colder, warmer, steps, scale)
    bounded = _bounded(steps, chi2)
    found = {step: margin for step, highest, margin in bounded if highest >= -WRONG_WAY}
    if bounded:
        return Pair(steps, chi2, found, "overlap" if found else "rising")
    possible = np.mean(chi2 <= LARGEST_MISFIT)
    return Pair(steps, chi2, {}, "flat" if possible > FLAT else "apart")


def _steps(colder: FrictionIsotherm, warmer: FrictionIsotherm) -> Array:
    """Return steps at which enough points of each curve lie over the other one."""
    if min(len(colder), len(warmer)) < FEWEST_POINTS:
        return np.empty(0)
    inner = FEWEST_POINTS - 1
    lowest = max(warmer.speed[0] - colder.speed[-1 - inner], warmer.speed[inner] - colder.speed[-1])
    highest = min(warmer.speed[-1] - colder.speed[inner], warmer.speed[-1 - inner] - colder.speed[0])
    if not lowest <= highest:
        return np.empty(0)
    steps = np.linspace(lowest, highest, max(3, int((highest - lowest) / STEP) + 1))
    inside = np.full(steps.shape, True)  # with points far apart, steps between the ends may fail
    for points, curve, way in ((colder, warmer, steps), (warmer, colder, -steps)):
        place = points.speed + way[:, None]
        over = (place >= curve.speed[0] - 1e-9) & (place <= curve.speed[-1] + 1e-9)
        inside &= np.count_nonzero(over, axis=1) >= FEWEST_POINTS
    return np.asarray(steps[inside])


def _chi2(colder: FrictionIsotherm, warmer: FrictionIsotherm, steps: Array, scale: float) -> Array:
    """Compare two curves at steps, with all points, or without an end: its own curve does not show one that is off."""
    low = np.maximum(colder.speed[0] + steps, warmer.speed[0])
    high = np.minimum(colder.speed[-1] + steps, warmer.speed[-1])
    places = low[:, None] + (high - low)[:, None] * PLACES
    first, second = colder.read(places - steps[:, None]), warmer.read(places)
    difference = np.concatenate([first[0] - second[0][0], first[0][0] - second[0][1:]])
    spread = scale * np.concatenate([first[1] + second[1][0], first[1][0] + second[1][1:]])
    spread += READING**2 * np.eye(len(PLACES))
    chi2 = np.sum(difference * np.linalg.solve(spread, difference[..., None])[..., 0], axis=-1)
    chi2[1:] += ONE_OUTLIER
    return np.asarray(chi2.min(axis=0))


def _bounded(steps: Array, chi2: Array) -> list[tuple[float, float, float]]:
    """Return the steps of least χ² that contradiction bounds on both sides, upper bound and clearness; best first."""
    found = []
    free = np.full(steps.shape, True)
    for place in np.argsort(chi2, kind="stable"):
        if chi2[place] > LARGEST_MISFIT:
            break
        if not free[place]:
            continue
        against = np.flatnonzero(chi2 > chi2[place] + CONTRADICTION)
        after = int(np.searchsorted(against, place))
        first = int(against[after - 1]) if after > 0 else -1
        last = int(against[after]) if after < against.size else steps.size
        whole = bool(np.all(free[max(first, 0) : last]))  # else it is the slope of a better one
        free[max(first, 0) : last + 1] = False
        if whole and first >= 0 and last < steps.size:
            bound = min(chi2[: first + 1].max(), chi2[last:].max()) - chi2[place]
            found.append((float(steps[place]), float(steps[last]), float(np.sqrt(bound))))
    return found


@dataclass(frozen=True, eq=False)
class Arrangement:
    """One arrangement of some of the friction curves over each other."""

    positions: dict[int, float]  # log10 α by the index of the temperature, zero for the coldest
    cost: float  # sum of squared differences of all pairs minus its expectation


Pairs: TypeAlias = "Mapping[tuple[int, int], Pair]"


def scan_pairs(isotherms: Sequence[FrictionIsotherm], scale: float) -> dict[tuple[int, int], Pair]:
    """Scan all pairs of temperatures; the keys are their indices, the colder first."""
    pairs = {
        (colder, warmer): scan(isotherms[colder], isotherms[warmer], scale)
        for colder, warmer in combinations(range(len(isotherms)), 2)
    }
    return {places: _with_those_between(places, pair, pairs) for places, pair in pairs.items()}


def _with_those_between(places: tuple[int, int], pair: Pair, pairs: Pairs) -> Pair:
    """Drop the steps that most temperatures between the two contradict."""
    # α falls with temperature, so that a curve between two others lies between them. Similar stretches of a curve, such
    # as the flanks of two maxima, may coincide at a step that leaves no position for the temperatures between.
    between = range(places[0] + 1, places[1])
    if not pair.candidates or not between:
        return pair

    def contradicts(middle: int, step: float) -> bool:
        upper, lower = pairs[places[0], middle], pairs[middle, places[1]]
        parts = np.arange(-WRONG_WAY, max(step, 0.0) + WRONG_WAY + STEP, STEP)
        return all(max(upper.cost(part), lower.cost(step - part)) > LARGEST_MISFIT for part in parts.tolist())

    kept = {
        step: margin
        for step, margin in pair.candidates.items()
        if 2 * sum(contradicts(one, step) for one in between) <= len(between)
    }
    return replace(pair, candidates=kept, verdict=pair.verdict if kept else "apart")


def groups(places: Iterable[int], joined: Iterable[tuple[int, int]]) -> list[list[int]]:
    """Return the groups of indices that pairs join, each ascending."""
    group = {place: place for place in places}
    for one, other in joined:
        old, new = group[other], group[one]
        group = {place: new if name == old else name for place, name in group.items()}
    return [sorted(place for place in group if group[place] == name) for name in dict.fromkeys(group.values())]


def arrange(members: Sequence[int], pairs: Pairs) -> list[Arrangement]:
    """Return arrangements of the curves of a group of temperatures over each other, the best one first."""
    # From the coldest on, each curve is tried wherever it coincides with one that has a position already. The best few
    # arrangements are kept, so that a curve that coincides with one neighbour at two steps gets the right one. No α may
    # rise with temperature; curves without a position are left out. `members` are the places of the temperatures, which
    # `pairs`, from `scan_pairs`, join.
    found = [Arrangement({members[0]: 0.0}, 0.0)]
    left = list(members[1:])
    while left:
        joined = (one for one in left if any(_pair(pairs, one, other).candidates for other in found[0].positions))
        place = next(joined, None)
        if place is None:
            break
        left.remove(place)
        grown = [
            _with(arrangement, place, position, pairs)
            for arrangement in found
            for position in _positions(arrangement, place, pairs)
            if _falls(arrangement, place, position, pairs)
        ]
        if not grown:
            continue
        found = sorted(grown, key=lambda one: one.cost)[:BREADTH]
    return found


def rivals(found: Sequence[Arrangement]) -> list[int]:
    """Return the indices of temperatures whose position differs in another arrangement as good as the best one."""
    best = found[0]
    return sorted(
        {
            place
            for other in found[1:]
            if other.cost < best.cost + AS_GOOD
            for place, position in other.positions.items()
            if abs(position - best.positions[place]) > 2.0 * SAME_POSITION
        }
    )


def _pair(pairs: Pairs, one: int, other: int) -> Pair:
    return pairs[min(one, other), max(one, other)]


def _positions(arrangement: Arrangement, place: int, pairs: Pairs) -> list[float]:
    """Return the positions at which a curve coincides with the placed ones."""
    positions: list[float] = []
    for other, position in arrangement.positions.items():
        sign = 1.0 if other < place else -1.0
        for step in _pair(pairs, place, other).candidates:
            wanted = position - sign * step
            if all(abs(wanted - known) > SAME_POSITION for known in positions):
                positions.append(wanted)
    return positions


def _falls(arrangement: Arrangement, place: int, position: float, pairs: Pairs) -> bool:
    """Whether α falls with temperature for a curve at a position, within the tolerance of the pairs."""
    for other, known in arrangement.positions.items():
        step = known - position if other < place else position - known
        if step < min(-WRONG_WAY, *(one - SAME_POSITION for one in _pair(pairs, place, other).candidates), 0.0):
            return False
    return True


def _with(arrangement: Arrangement, place: int, position: float, pairs: Pairs) -> Arrangement:
    cost = arrangement.cost
    for other, known in arrangement.positions.items():
        step = known - position if other < place else position - known
        cost += _pair(pairs, place, other).cost(step)
    return Arrangement({**arrangement.positions, place: position}, cost)
