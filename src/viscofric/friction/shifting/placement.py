"""Friction curves of several temperatures put over each other roughly: which reach each other, and where."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.friction.shifting.pairs import LARGEST_MISFIT, STEP, WRONG_WAY, Pair, scan

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from viscofric.friction.shifting.isotherms import FrictionIsotherm

#: Arrangements that are followed at a time.
BREADTH = 12
#: Positions that lie closer are one, decades.
SAME_POSITION = 0.1
#: An arrangement whose squares exceed those of the best one by less is as good, in squares of standard deviations.
AS_GOOD = 9.0


@dataclass(frozen=True, eq=False)
class Arrangement:
    """One way to put some of the friction curves over each other.

    Attributes
    ----------
    positions : dict of int to float
        log10 α by the place of the temperature, the coldest one's zero.
    cost : float
        Sum of squared differences of all pairs less its expectation.
    """

    positions: dict[int, float]
    cost: float


Pairs: TypeAlias = "Mapping[tuple[int, int], Pair]"


def scan_pairs(isotherms: Sequence[FrictionIsotherm], scale: float) -> dict[tuple[int, int], Pair]:
    """Scan all pairs of temperatures; the keys are their places, the colder first."""
    pairs = {
        (colder, warmer): scan(isotherms[colder], isotherms[warmer], scale)
        for colder, warmer in combinations(range(len(isotherms)), 2)
    }
    return {places: _with_those_between(places, pair, pairs) for places, pair in pairs.items()}


def _with_those_between(places: tuple[int, int], pair: Pair, pairs: Pairs) -> Pair:
    """Drop the steps that most temperatures between the two contradict.

    α falls with temperature, so that a curve between two others lies between them.  Different stretches of a curve that
    look alike, as the flanks of two maxima, coincide where what was measured in between has no place.
    """
    between = range(places[0] + 1, places[1])
    if not pair.candidates or not between:
        return pair

    def contradicts(middle: int, step: float) -> bool:
        upper, lower = pairs[places[0], middle], pairs[middle, places[1]]
        parts = np.arange(-WRONG_WAY, max(step, 0.0) + WRONG_WAY + STEP, STEP)
        return all(max(upper.cost(part), lower.cost(step - part)) > LARGEST_MISFIT for part in parts.tolist())

    kept = [
        (step, margin)
        for step, margin in zip(pair.candidates, pair.margins, strict=True)
        if 2 * sum(contradicts(one, step) for one in between) <= len(between)
    ]
    steps, margins = tuple(step for step, _ in kept), tuple(margin for _, margin in kept)
    return replace(pair, candidates=steps, margins=margins, verdict=pair.verdict if steps else "apart")


def groups(places: Iterable[int], joined: Iterable[tuple[int, int]]) -> list[list[int]]:
    """Return the groups of places that pairs join, each ascending."""
    group = {place: place for place in places}
    for one, other in joined:
        old, new = group[other], group[one]
        group = {place: new if name == old else name for place, name in group.items()}
    return [sorted(place for place in group if group[place] == name) for name in dict.fromkeys(group.values())]


def arrange(members: Sequence[int], pairs: Pairs) -> list[Arrangement]:
    """Put the curves of a group of temperatures over each other, the best arrangement first.

    From the coldest on, each is tried wherever it coincides with one that is placed already; what contradicts the
    others falls behind, so that a curve which coincides in two places with one neighbour finds the right one.  Where
    α would rise with temperature none is put, and curves that have no place then are left out.

    Parameters
    ----------
    members : sequence of int
        Places of the temperatures, which `pairs` join.
    pairs : mapping
        From `scan_pairs`.
    """
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
    """Return the places of temperatures that another arrangement, as good as the best one, puts elsewhere."""
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
    """Return where a curve coincides with those that are placed."""
    positions: list[float] = []
    for other, position in arrangement.positions.items():
        sign = 1.0 if other < place else -1.0
        for step in _pair(pairs, place, other).candidates:
            wanted = position - sign * step
            if all(abs(wanted - known) > SAME_POSITION for known in positions):
                positions.append(wanted)
    return positions


def _falls(arrangement: Arrangement, place: int, position: float, pairs: Pairs) -> bool:
    """Whether α falls with temperature if a curve is put at a position, to what pairs by themselves leave open."""
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
