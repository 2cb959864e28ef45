"""Conditions of a traction test that can be separated, and notes on those that cannot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import InputError
from viscofric.friction.measurement.conditions import SPEED_TOLERANCE, Condition, conditions, where
from viscofric.friction.measurement.course import Course, of_both, of_the_disc
from viscofric.nominal import SAME_LOAD, SAME_TEMPERATURE
from viscofric.notes import Note, Remedy, setting

if TYPE_CHECKING:
    from viscofric.friction.measurement.assumed_coulomb import Assumed
    from viscofric.friction.measurement.conditions import Condition
    from viscofric.friction.measurement.zeros import Zeros
    from viscofric.traction import TractionRuns


#: Distance of the groups over their standard deviation: two halves of one normal distribution have 2.65.
_APART = 6.0
#: The same over the largest force of the condition: more than any variation between runs.
_OF_FORCE = 0.5
#: Smallest share of the readings in a group: fewer are outliers.
_SHARE = 0.2
# Speeds within this part of each other may have one nominal value.
_NEAR = 0.5
# (sgn u_disc, sgn(u_disc − u_ball)) in words
_WORDS = {
    (sign, slip): f"u_disc {'<' if sign < 0 else '>'} 0 with u_disc − u_ball {'<' if slip < 0 else '>'} 0"
    for sign in (-1, 1)
    for slip in (-1, 1)
}


@dataclass(frozen=True)
class TwoGroups:
    """Mean forces of the two groups of readings of a configuration, N, and whether it has slip."""

    low: float
    high: float
    slides: bool

    @property
    def opposite(self) -> bool:
        """Whether the forces have opposite signs with slip; without slip, unmeasurably small slip can cause that."""
        return self.slides and self.low < 0.0 < self.high


def two_groups(runs: TractionRuns, group: Condition, zeros: Zeros) -> TwoGroups | None:
    """Return the groups of the configuration in which they are furthest apart; None if there is one group each."""
    zero = zeros.of(group) if zeros.covers(group) else 0.0
    force = runs.traction_force[group.rows] - zero
    least = _OF_FORCE * float(np.abs(force).max())
    found = None
    for configuration in np.unique(group.configurations):
        ordered = np.sort(force[group.configurations == configuration])
        if ordered.size < 2:
            continue
        place = int(np.argmax(np.diff(ordered))) + 1
        low, high = ordered[:place], ordered[place:]
        distance = float(high.mean() - low.mean())
        scatter = float(np.sqrt((low.size * low.var() + high.size * high.var()) / ordered.size))
        few = min(low.size, high.size) < _SHARE * ordered.size
        if distance > max(least, _APART * scatter) and not few:
            found = TwoGroups(float(low.mean()), float(high.mean()), bool(np.any(group.slip_sign)))
            least = distance
    return found


def _two_groups_kept(groups: list[Condition], found: dict[int, TwoGroups]) -> list[str]:
    """Return a note on forces in two groups of one sign, which are kept."""
    places = [place for place, one in found.items() if not one.opposite]
    if not places:
        return []
    return [Note("two-groups-of-force", f"{_sentence(groups, found, places)}; their mean is used.")]


def _unsigned(groups: list[Condition], found: dict[int, TwoGroups], *, left_out: bool = False) -> Note:
    """Return a note on forces in two groups of opposite signs, with a remedy."""
    places = [place for place, one in found.items() if one.opposite]
    leaving = "; these readings are left out" if left_out else ""
    return Note(
        "unsigned-speeds",
        f"{_sentence(groups, found, places)}, as for runs of both directions without signed speeds{leaving}; "
        "give the speeds of disc and ball with their signs.",
    )


def _sentence(groups: list[Condition], found: dict[int, TwoGroups], places: list[int]) -> str:
    first = found[places[0]]
    return (
        f"{where([groups[place] for place in places], len(groups))} the forces of one sign configuration fall into two "
        f"groups, about {first.low:.3g} and {first.high:.3g} N"
    )


@dataclass(frozen=True, eq=False)
class Grouping:
    """The conditions that are separated, and notes on their grouping."""

    groups: list[Condition]
    notes: list[str]

    @classmethod
    def of(
        cls, runs: TractionRuns, zeros: Zeros, assumed: Assumed, speed_tolerance: float, temperature_tolerance: float
    ) -> Grouping:
        """Group the readings by the speed of the disc, or by that of disc and ball where this puts more together.

        Raises InputError if no condition can be separated.
        """

        def grouped(course: Course) -> tuple[list[Condition], tuple[str, ...], list[Condition]]:
            groups, notes = conditions(runs, course, speed_tolerance, temperature_tolerance)
            return groups, notes, [group for group in groups if not assumed.suffices(group, zeros)]

        problem = None
        try:
            groups, notes, poor = grouped(of_the_disc(runs))
        except InputError as error:
            problem, groups, notes, poor = error, [], (), []
        if problem or poor:
            # Slip separates the disc's speeds by as much as nominal speeds may differ only at some of them.
            try:
                others, other_notes, still_poor = grouped(of_both(runs))
            except InputError:
                others, other_notes, still_poor = [], (), []
            if _readings(others) - _readings(still_poor) > _readings(groups) - _readings(poor):
                groups, notes, poor, problem = others, other_notes, still_poor, None
        if problem:
            raise problem
        if not groups:
            raise InputError(
                "traction runs contain no reading with the disc in motion: nothing to separate.", code="no-readings"
            )
        split = {place: two for place, group in enumerate(groups) if (two := two_groups(runs, group, zeros))}
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
        return cls([group for group in groups if id(group) not in out], noted)


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


def _at_other_speed(speed: float | None) -> Remedy:
    if speed is None:
        return Remedy("")
    noted = f" at the same disc speed (others were measured at {1e3 * speed:.4g} mm/s; a larger "
    return noted + setting(*SPEED_TOLERANCE) + " joins them)"


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
    else:
        advice += _at_other_speed(other)
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
