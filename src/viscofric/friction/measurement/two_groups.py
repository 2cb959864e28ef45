"""Readings of one sign configuration that fall into two groups: runs of both directions, given without signs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from viscofric.friction.measurement.conditions import where
from viscofric.notes import Note

if TYPE_CHECKING:
    from viscofric.friction.measurement.conditions import Condition
    from viscofric.friction.measurement.zeros import Zeros
    from viscofric.traction import TractionRuns

#: Distance of the groups over their standard deviation: two halves of one normal distribution have 2.65.
_APART = 6.0
#: The same over the largest force of the condition: more than any variation from run to run.
_OF_FORCE = 0.5
#: Smallest share of the readings in a group: fewer are outliers.
_SHARE = 0.2


@dataclass(frozen=True)
class TwoGroups:
    """Mean forces of the two groups of readings of a configuration, N, and whether it has slip."""

    low: float
    high: float
    slides: bool

    @property
    def opposite(self) -> bool:
        """Whether the forces have opposite signs with slip; without, slip too small to be measured can do that."""
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


def notes(groups: list[Condition], found: dict[int, TwoGroups]) -> list[str]:
    """Say where forces fall into two groups of one sign, and that they are kept."""
    places = [place for place, one in found.items() if not one.opposite]
    if not places:
        return []
    return [Note("two-groups-of-force", f"{_sentence(groups, found, places)}; their mean is used.")]


def refusal(groups: list[Condition], found: dict[int, TwoGroups], *, left_out: bool = False) -> Note:
    """Say where forces fall into two groups of opposite signs, and what to do."""
    places = [place for place, one in found.items() if one.opposite]
    leaving = "; these readings are left out" if left_out else ""
    return Note(
        "unsigned-speeds",
        f"{_sentence(groups, found, places)}, as if runs of both directions were given with unsigned speeds{leaving}; "
        "give the speeds of disc and ball with their signs.",
    )


def _sentence(groups: list[Condition], found: dict[int, TwoGroups], places: list[int]) -> str:
    first = found[places[0]]
    return (
        f"{where([groups[place] for place in places], len(groups))} the forces of one sign configuration fall into two "
        f"groups, about {first.low:.3g} and {first.high:.3g} N"
    )
