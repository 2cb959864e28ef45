"""Assumptions on Coulomb friction where only one direction of slip was measured."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from viscofric.errors import InputError, brief, wrong_argument
from viscofric.friction.measurement.conditions import Condition, where
from viscofric.friction.measurement.fit import Entry
from viscofric.friction.measurement.zeros import Zeros
from viscofric.notes import Note, Remedy
from viscofric.units import shown_number, to_si

#: Code of the note on an assumed coefficient, whose values are `coulomb` and its standard error `error`.
COULOMB_ASSUMED = "coulomb-assumed"


@dataclass(frozen=True)
class Assumed:
    """Coulomb friction that is assumed."""

    value: float | None = None  # coefficient; None where nothing, or only a constant one, is assumed
    error: float = 0.0  # its standard error
    constant: bool = False  # the same at all speeds of a temperature and load

    @classmethod
    def of(cls, coulomb: object) -> Assumed:
        """Return the assumption behind the argument `coulomb` of `separate`."""
        if coulomb is None:
            return cls()
        if isinstance(coulomb, str) and coulomb.strip().lower() == "constant":
            return cls(constant=True)
        value, error = coulomb if isinstance(coulomb, (tuple, list)) and len(coulomb) == 2 else (coulomb, 0.0)
        try:
            number = to_si(value, "dimensionless", "coulomb")  # type: ignore[arg-type]
        except InputError:
            number = -1.0
        if number < 0.0:
            words = "a friction coefficient such as 0.05, {}or 'constant'."
            raise InputError(
                f"coulomb = {brief(value)}: must be ",
                code="not-a-coefficient",
                remedy=Remedy(words.format("it and its standard error as (0.05, 0.01), "), words.format("")),
                values={"argument": "coulomb"},
            )
        deviation = to_si(error, "dimensionless", "standard error of coulomb")
        if deviation < 0.0:
            raise wrong_argument("standard error of coulomb", error, "must be zero or above.", "not-a-coefficient")
        return cls(number, deviation)

    @property
    def nothing(self) -> bool:
        """Whether nothing is assumed."""
        return self.value is None and not self.constant

    def suffices(self, group: Condition, zeros: Zeros) -> bool:
        """Whether a condition can be separated, with the assumption if necessary."""
        if zeros.suffices(group, coulomb=True):
            return True
        if self.nothing or not zeros.suffices(group, coulomb=False):
            return False
        # With both directions of slip the fitted zero includes a Coulomb force: no limit follows from it.
        return not self.constant or np.unique(group.disc_sign * group.slip_sign).size == 1

    def at(self, group: Condition, zeros: Zeros) -> tuple[float, float] | None:
        """Return the assumed Coulomb coefficient and its standard error at a condition; None where it is fitted."""
        if zeros.suffices(group, coulomb=True):
            return None
        # A constant one follows from all speeds together, see `completed`.
        return (0.0, 0.0) if self.value is None else (self.value, self.error)

    def completed(self, entries: list[Entry]) -> list[Entry]:
        """Separate the friction of one direction of slip where Coulomb friction is constant."""
        # Its forces along the disc's motion are μ_v ± μ_c, + where the disc is faster than the ball. Neither is
        # negative, so that μ_c is at most the lowest of them with +, and at least the highest of −(μ_v − μ_c) with −.
        entries = list(entries)
        remaining = [place for place, one in enumerate(entries) if self.constant and one.fit.coulomb is not None]
        while remaining:
            first = entries[remaining[0]].group
            sense = _sense(first)
            groups = {place: entries[place].group for place in remaining}
            alike = [place for place, one in groups.items() if first.alike(one) and _sense(one) == sense]
            remaining = [place for place in remaining if place not in alike]
            if np.unique([groups[place].speed for place in alike]).size < 2:
                raise InputError(
                    f"coulomb = 'constant': at {first} one speed was measured with one direction of slip, from which "
                    "viscoelastic friction cannot be found; measure more speeds or both directions of slip.",
                    code="one-speed",
                )
            friction = np.array([sense * entries[place].value[1] for place in alike])
            lowest = int(np.argmin(sense * friction))
            limit = entries[alike[lowest]]
            for place in alike:
                entries[place] = _parted(entries[place], sense, friction[lowest], limit)
        return entries

    def sentence(self, some: list[Condition], total: int) -> str:
        """Return a note on the assumption at some conditions; empty without any."""
        if not some:
            return ""
        counted = {"conditions": len(some), "of": total}
        if self.constant:
            return Note(
                "coulomb-constant",
                f"{where(some, total)} one direction of slip was measured and Coulomb friction is assumed to be the "
                "same at all speeds of a temperature, as large as the measured friction allows: viscoelastic friction "
                "is the part that varies with speed, a lower limit.",
                values=counted,
            )
        size = (
            f"{shown_number(self.value or 0.0, 'g')} ± {self.error:g}"
            if self.error
            else shown_number(self.value or 0.0, "g")
        )
        return Note(
            COULOMB_ASSUMED,
            f"{where(some, total)} one direction of slip was measured and a Coulomb friction coefficient of {size} is "
            "assumed; its error is in viscoelastic friction in full.",
            values={
                **counted,
                "coulomb": self.value,
                "error": self.error,
                # 1 where the disc is faster, -1 where it is slower: with the sign of an error in viscoelastic friction.
                "senses": sorted({float(sense) for one in some for sense in one.disc_sign * one.slip_sign}),
            },
        )


def _sense(group: Condition) -> float:
    return float(group.disc_sign[0] * group.slip_sign[0])


def _parted(entry: Entry, sense: float, coulomb: float, limit: Entry) -> Entry:
    """Subtract constant Coulomb friction, that of the condition which limits it, from total friction."""
    value, error, scatter, freedom = (
        np.array(part) for part in (entry.value, entry.error, entry.scatter, entry.freedom)
    )
    value[1], value[2] = value[1] - sense * coulomb, coulomb
    error[2], scatter[2], freedom[2] = limit.error[1], limit.scatter[1], limit.freedom[1]
    parted = replace(entry, value=value, error=error, scatter=scatter, freedom=freedom)
    return parted.widened(np.array([0.0, limit.error[1] ** 2, 0.0, 0.0]), limit.freedom[1])
