"""Reasons why no shift factor follows from friction curves, as notes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from viscofric.friction.shifting.placement import FEWEST_POINTS
from viscofric.notes import Note
from viscofric.rheology.shifts.shift_law import NOMINAL
from viscofric.units import shown_celsius

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.friction.shifting.isotherms import FrictionIsotherm
    from viscofric.friction.shifting.placement import Pairs

#: Code of the notes on temperatures that were left out.
LEFT_OUT = "curve-left-out"
#: More temperatures than these are given by their range.
MOST_LISTED = 9


@dataclass(eq=False)
class Doubts:
    """Temperatures whose curves do not overlap, and what is known of the overlaps."""

    isotherms: Sequence[FrictionIsotherm]
    pairs: Pairs  # from `scan_pairs`
    reference: float | None  # K, where α is to be 1
    elsewhere: list[int] = field(default_factory=list)  # indices of temperatures that fit in more than one place

    def reached_by(self, group: Sequence[int]) -> bool:
        """Whether a group of temperatures, in ascending order, has the reference among or between them."""
        low, high = self.isotherms[group[0]].temperature, self.isotherms[group[-1]].temperature
        return self.reference is None or low - NOMINAL <= self.reference <= high + NOMINAL

    def refusal(self, *, fitted: bool) -> Note:
        """Return why there are no shift factors; `fitted` where the fit did not confirm overlaps."""
        curves = f"friction curves at {_listed(self.isotherms)}"
        if self.elsewhere:
            where = _listed([self.isotherms[place] for place in self.elsewhere])
            return Note(
                "curves-fit-twice",
                f"{curves} have no unique shift factors: friction at {where} fits the other curves in more than one "
                "place equally well; measure at more speeds, or at temperatures in between.",
            )
        if self.reference is not None and not fitted and any(pair.candidates for pair in self.pairs.values()):
            return Note(
                "reference-not-covered",
                f"no overlapping {curves} include the reference, {shown_celsius(self.reference)} °C; choose another "
                "reference, or measure at temperatures around it or at more speeds.",
            )
        if any(pair.verdict == "rising" for pair in self.pairs.values()):
            return Note(
                "shift-factors-rise",
                f"{curves} overlap only if their shift factors rise with temperature, which those of rubber never do; "
                "check temperatures and speeds.",
            )
        neighbours = [self.pairs[place, place + 1] for place in range(len(self.isotherms) - 1)]
        if all(pair.verdict == "flat" for pair in neighbours):
            return too_flat(self.isotherms)
        lone = [isotherm for isotherm in self.isotherms if len(isotherm) < FEWEST_POINTS]
        if len(lone) > len(self.isotherms) - 2:
            return Note(
                "one-speed",
                f"friction at {_listed(lone)} is known at one speed only; a shift factor needs two or more.",
            )
        spans = ", ".join(f"{one.range[0]:.3g} to {one.range[1]:.3g}" for one in self.isotherms[:MOST_LISTED])
        doubt = " significantly" if fitted else ""
        return Note(
            "no-overlap",
            f"{curves} do not overlap{doubt}: no shift makes {FEWEST_POINTS} or more of their points coincide "
            f"(friction coefficients: {spans}); measure at temperatures in between, or at more speeds.",
        )

    def left_out(self, members: Sequence[int]) -> tuple[Note, ...]:
        """Return why each temperature that is not among the members was left out."""
        return tuple(
            Note(
                LEFT_OUT,
                f"The friction curve at {shown(self.isotherms[place])} was left out: {self._reason(place, members)}.",
                values={"temperature": float(self.isotherms[place].temperature)},
            )
            for place in range(len(self.isotherms))
            if place not in members
        )

    def _reason(self, place: int, members: Sequence[int]) -> str:
        own = self.isotherms[place]
        if len(own) < FEWEST_POINTS:
            return "it has only one speed"
        if place in self.elsewhere:
            return "it fits the others in more than one place equally well"
        nearest = min(members, key=lambda member: abs(self.isotherms[member].temperature - own.temperature))
        other = shown(self.isotherms[nearest])
        if self.pairs[min(place, nearest), max(place, nearest)].verdict == "flat":
            return f"it or the curve at {other} is too flat to find their overlap"
        return f"no shift makes it overlap significantly with the curve at {other} or the others"


def shown(isotherm: FrictionIsotherm) -> str:
    """Return the temperature of an isotherm in °C."""
    return f"{shown_celsius(isotherm.temperature)} °C"


def too_flat(isotherms: Sequence[FrictionIsotherm]) -> Note:
    """Return a note that friction may be constant."""
    return Note(
        "curves-too-flat",
        f"friction curves at {_listed(isotherms)} are too flat: friction changes too little with speed for its errors, "
        "so that any shift factor fits.",
        values={"temperatures": [float(one.temperature) for one in isotherms]},
    )


def _listed(isotherms: Sequence[FrictionIsotherm]) -> str:
    numbers = [shown_celsius(isotherm.temperature) for isotherm in isotherms]
    if len(numbers) > MOST_LISTED:
        return f"{len(numbers)} temperatures from {numbers[0]} to {numbers[-1]} °C"
    return f"{', '.join(numbers[:-1])} and {numbers[-1]} °C" if len(numbers) > 1 else f"{numbers[0]} °C"
