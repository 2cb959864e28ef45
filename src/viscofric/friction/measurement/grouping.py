"""Conditions of a traction test that can be separated, and notes on those that cannot."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import InputError
from viscofric.friction.measurement.assumed_coulomb import Assumed
from viscofric.friction.measurement.conditions import (
    SPEED_TOLERANCE,
    Condition,
    conditions,
    of_both,
    of_the_disc,
    where,
)
from viscofric.friction.measurement.zeros import Zeros
from viscofric.nominal import SAME_LOAD, SAME_TEMPERATURE
from viscofric.notes import Note, Remedy, setting
from viscofric.traction import TractionRuns
from viscofric.units import plain

#: Normal numbers, split at their largest gap: how many, their rms distance from the means of both parts, and the
#: distance of these means that one split in 10⁴ exceeds, both in standard deviations (of 10⁵ draws each).
_SPLITS = np.array(
    [
        [2, 3, 4, 5, 6, 8, 12, 20, 40],
        [0.0, 0.241, 0.335, 0.402, 0.454, 0.531, 0.631, 0.740, 0.850],
        [5.51, 5.11, 4.90, 4.66, 3.96, 3.83, 3.38, 3.16, 2.76],
    ]
)
#: Distance of the groups over the largest force of the condition: more than any variation between runs.
_OF_FORCE = 0.5
#: Where a single reading is apart, as an outlier is, this share of the configurations must be so, and so many of them.
_MOST, _FEWEST_PAIRS = 0.8, 5
#: Smallest share of the readings in a group: fewer are outliers.
_SHARE = 0.2
#: Loads that differ by less between configurations may be those of one condition, as where friction acts on the load.
_LOADS_TOGETHER = 3.0 * SAME_LOAD
# Speeds within this part of each other may have one nominal value.
_NEAR = 0.5
# (sgn u_disc, sgn(u_disc − u_ball)) in words
_WORDS = {
    (sign, slip): f"u_disc {'<' if sign < 0 else '>'} 0 with u_disc − u_ball {'<' if slip < 0 else '>'} 0"
    for sign in (-1, 1)
    for slip in (-1, 1)
}


class _Split(NamedTuple):
    """Sorted forces of a configuration, N, below and above their largest gap, and whether it has slip."""

    low: Array
    high: Array
    slides: bool

    @property
    def size(self) -> int:
        """Number of readings."""
        return int(self.low.size + self.high.size)

    @property
    def means(self) -> tuple[float, float]:
        """Mean forces below and above the gap, N."""
        return float(self.low.mean()), float(self.high.mean())

    @property
    def distance(self) -> float:
        """Distance of both means, N."""
        low, high = self.means
        return high - low

    @property
    def squares(self) -> float:
        """Sum of the squared distances from both means, N²."""
        return float(self.low.size * self.low.var() + self.high.size * self.high.var())

    @property
    def opposite(self) -> bool:
        """Whether the forces have opposite signs with slip; without slip, unmeasurably small slip can cause that."""
        low, high = self.means
        return self.slides and low < 0.0 < high


def _splits(runs: TractionRuns, group: Condition, zeros: Zeros) -> list[_Split]:
    """Return the configurations of a condition that have two readings at least."""
    zero = zeros.of(group) if zeros.covers(group) else 0.0
    force = runs.traction_force[group.rows] - zero
    found = []
    for configuration in np.unique(group.configurations):
        here = group.configurations == configuration
        ordered = np.sort(force[here])
        if ordered.size > 1:
            place = int(np.argmax(np.diff(ordered))) + 1
            found.append(_Split(ordered[:place], ordered[place:], bool(np.any(group.slip_sign))))
    return found


def _two_groups(runs: TractionRuns, groups: list[Condition], zeros: Zeros) -> dict[int, _Split]:
    """Return, by the place of their condition, the forces of a configuration that fall into two groups."""
    # The scatter is that of all conditions, as a few readings are far apart for their own scatter by chance.
    every = [_splits(runs, group, zeros) for group in groups]
    expected = sum(one.size * float(np.interp(one.size, *_SPLITS[:2])) ** 2 for splits in every for one in splits)
    noise = math.sqrt(sum(one.squares for splits in every for one in splits) / expected) if expected > 0.0 else 0.0
    found, count = {}, 0
    for place, splits in enumerate(every):
        largest = max((float(np.abs([one.low[0], one.high[-1]]).max()) for one in splits), default=0.0)
        apart = [
            one
            for one in splits
            if one.distance > max(_OF_FORCE * largest, noise * float(np.interp(one.size, _SPLITS[0], _SPLITS[2])))
            and min(one.low.size, one.high.size) >= _SHARE * one.size
        ]
        count += len(apart)
        if apart:
            found[place] = max(apart, key=lambda one: one.distance)
    few = count < max(_FEWEST_PAIRS, _MOST * sum(map(len, every)))
    return {place: one for place, one in found.items() if not few or min(one.low.size, one.high.size) > 1}


def _two_groups_kept(groups: list[Condition], found: dict[int, _Split]) -> list[str]:
    """Return a note on forces in two groups of one sign, which are kept."""
    places = [place for place, one in found.items() if not one.opposite]
    if not places:
        return []
    return [Note("two-groups-of-force", f"{_sentence(groups, found, places)}; their mean is used.")]


def _unsigned(groups: list[Condition], found: dict[int, _Split], *, left_out: bool = False) -> Note:
    """Return a note on forces in two groups of opposite signs, with a remedy."""
    places = [place for place, one in found.items() if one.opposite]
    leaving = "; these readings are left out" if left_out else ""
    return Note(
        "unsigned-speeds",
        f"{_sentence(groups, found, places)}, as for runs of both directions without signed speeds{leaving}; "
        "give the speeds of disc and ball with their signs.",
    )


def _sentence(groups: list[Condition], found: dict[int, _Split], places: list[int]) -> str:
    low, high = found[places[0]].means
    return (
        f"{where([groups[place] for place in places], len(groups))} the forces of one sign configuration fall into two "
        f"groups, about {low:.3g} and {high:.3g} N"
    )


def grouped(
    runs: TractionRuns, zeros: Zeros, assumed: Assumed, speed_tolerance: float, temperature_tolerance: float
) -> tuple[list[Condition], list[str]]:
    """Return the conditions that are separated, and notes on their grouping."""
    # By the speed of the disc, or by that of disc and ball where this puts more together. Loads up to 15 % apart are
    # those of one condition where nothing can be separated otherwise.
    problem: InputError | None = None
    groups: list[Condition] = []
    poor: list[Condition] = []
    notes: list[str] = []
    # Slip separates the disc's speeds by as much as nominal speeds may differ only at some of them.
    for load_tolerance, course in product((SAME_LOAD, _LOADS_TOGETHER), (of_the_disc, of_both)):
        separated = len(groups) - len(poor)
        if (groups and not poor) or (load_tolerance > SAME_LOAD and (separated or not groups)):
            break
        try:
            others, said = conditions(runs, course(runs), speed_tolerance, temperature_tolerance, load_tolerance)
        except InputError as error:
            if not groups:
                problem = problem or error
            continue
        still_poor = [group for group in others if not assumed.suffices(group, zeros)]
        if not groups or _readings(others) - _readings(still_poor) > _readings(groups) - _readings(poor):
            groups, poor, notes = others, still_poor, [*said, *_of_loads(runs, others, load_tolerance)]
    if problem and (not groups or len(poor) == len(groups)):
        raise problem
    if not groups:
        raise InputError(
            "traction runs contain no reading with the disc in motion: nothing to separate.", code="no-readings"
        )
    split = _two_groups(runs, groups, zeros)
    mixed = {id(groups[place]) for place, two in split.items() if two.opposite}
    if mixed and mixed.union(map(id, poor)) == set(map(id, groups)):
        raise InputError(_unsigned(groups, split))
    if len(poor) == len(groups):
        raise InputError(_refused(poor, len(groups), zeros, assumed))
    noted = [*notes, *_two_groups_kept(groups, split)]
    if mixed:
        noted.append(_unsigned(groups, split, left_out=True))
    if poor:
        noted.append(_refused(poor, len(groups), zeros, assumed, left_out=True))
    out = mixed.union(map(id, poor))
    return [group for group in groups if id(group) not in out], noted


def _of_loads(runs: TractionRuns, groups: list[Condition], tolerance: float) -> Iterator[Note]:
    """Yield a note if the loads within conditions differ by more than is usual."""
    apart = [float(np.ptp(runs.load[group.rows])) / group.load for group in groups]
    some = [group for group, one in zip(groups, apart, strict=True) if one > SAME_LOAD]
    if some and tolerance > SAME_LOAD:
        yield Note(
            "loads-differ",
            f"{where(some, len(groups))} the loads of the configurations differ by up to "
            f"{plain(100.0 * max(apart), 2)} %; they are combined into friction coefficients at the mean load.",
            values={"conditions": len(some), "of": len(groups), "difference": max(apart)},
        )


def _readings(groups: list[Condition]) -> int:
    return sum(group.rows.size for group in groups)


def _other_speed(one: Condition, others: list[Condition]) -> float | None:
    """Return the speed (m/s) near that of a condition at which its missing signs were measured; None without any."""
    near = [
        other.speed
        for other in others
        if not other.signs <= one.signs
        and abs(other.temperature - one.temperature) <= SAME_TEMPERATURE
        and abs(other.load - one.load) <= SAME_LOAD * one.load
        and abs(other.speed - one.speed) <= _NEAR * one.speed
    ]
    return min(near, key=lambda speed: abs(speed - one.speed), default=None)


def _refused(poor: list[Condition], total: int, zeros: Zeros, assumed: Assumed, *, left_out: bool = False) -> Note:
    """Return a note on conditions whose signs do not suffice, with a remedy."""
    first = poor[0]
    missing = [words for signs, words in _WORDS.items() if signs not in first.signs]
    rolls = not np.any(first.slip_sign)
    other = None if rolls else _other_speed(first, poor)
    known = zeros.covers(first)
    advice = Remedy(f"; measure also {' or '.join(missing)}")
    if rolls:
        advice = Remedy("; measure also with the velocities of disc and ball reversed")
    elif other is not None:
        noted = f" at the same disc speed (others were measured at {1e3 * other:.4g} mm/s; a larger "
        advice += noted + setting(*SPEED_TOLERANCE) + " joins them)"
    unknowns = ["the force cell's zero"] * (not known) + ["viscoelastic"] + ["Coulomb"] * (not rolls)
    separated = " from ".join(unknowns[:2]) if rolls else f"{', '.join(unknowns[:-1])} and {unknowns[-1]}"
    if not known:
        zero = setting("measurement.zero", "Zero of the force cell")
        advice += ", or give its zero, read with ball and disc apart (" + zero + ")"
    elif not rolls and assumed.nothing:
        coulomb = setting("measurement.coulomb", "Assumed Coulomb friction")
        advice += ", or give the Coulomb friction to assume (" + coulomb + ")"
    because = "slip is zero (pure rolling) and " if rolls else ""
    leaving = "; these readings are left out" if left_out else ""
    unclear = f"the signs of the velocities do not separate {separated} friction"
    return Note(
        "signs-missing",
        f"{where(poor, total)} {because}{unclear}{leaving}",
        remedy=advice + ".",
        # signs of u_disc and of u_disc − u_ball
        values={
            "missing": [list(signs) for signs in _WORDS if signs not in first.signs],
            "pure_rolling": rolls,
            "other_speed": other,
            "conditions": len(poor),
            "of": total,
        },
    )
