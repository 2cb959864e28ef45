"""Overlap of isotherms: neighbours joined, single ones at the ends left out, gaps refused."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Generic, TypeVar

import numpy as np

from viscofric.arrays import Array
from viscofric.data import Isotherm
from viscofric.errors import SuperpositionError
from viscofric.notes import Note
from viscofric.rheology.shifts.laws import ShiftLaw
from viscofric.rheology.superposition.overlap import Join, LogSweep, failures, join, join_at
from viscofric.rheology.superposition.quantity import BOTH, Quantities
from viscofric.step_tests import StepTest
from viscofric.units import shown_celsius

#: A measurement at one temperature.
Tested = TypeVar("Tested", Isotherm, StepTest)
#: Neighbours whose moduli cannot be brought closer than this (decades, joint rms) are not joined.
LARGEST_MISFIT = 0.15


@dataclass(frozen=True, eq=False)
class JoinedIsotherms(Generic[Tested]):
    """Isotherms that overlap, and how they join."""

    isotherms: tuple[Tested, ...]  # ascending in temperature
    logs: list[LogSweep]  # their logarithms, without a given vertical shift
    joins: list[Join]  # of each with the next warmer one
    notes: tuple[str, ...]  # what was left out

    def less(self, log10_b: Array) -> JoinedIsotherms[Tested]:
        """Return the same with vertical shifts subtracted from the logarithms."""
        logs = [LogSweep(sweep.frequency, sweep.moduli - one) for sweep, one in zip(self.logs, log10_b, strict=True)]
        return replace(self, logs=logs)

    def disagreements(self, *, given: bool = False) -> tuple[str, ...]:
        """Return a note on each pair of neighbours that does not superpose, with fitted or given shift factors."""
        how = (
            "with the given shift factors."
            if given
            else "many times what is typical here; they were joined where they overlap best, with a large uncertainty."
        )
        return tuple(
            Note(
                "sweeps-disagree",
                f"The isotherms at {shown(self.isotherms[place].temperature)} and "
                f"{shown(self.isotherms[place + 1].temperature)} disagree by {self.joins[place].misfit:.2g} decades, "
                f"{how}",
            )
            for place in failures(self.joins)
        )


def shown(kelvin: float) -> str:
    """Return a temperature as text for users."""
    return f"{shown_celsius(kelvin)} °C"


def ranges(steps: Iterable[tuple[float, float]]) -> str:
    """Return steps from a colder to a warmer temperature, ascending, as ranges in words, adjacent ones joined."""
    runs: list[list[float]] = []
    for colder, warmer in steps:
        if runs and runs[-1][1] == colder:
            runs[-1][1] = warmer
        else:
            runs.append([colder, warmer])
    return ", ".join(f"{shown(colder)} to {shown(warmer)}" for colder, warmer in runs)


def usable(isotherms: Sequence[Isotherm | StepTest]) -> None:
    """Raise SuperpositionError unless there are at least two isotherms of at least two points."""
    if len(isotherms) < 2:
        raise SuperpositionError(
            f"{len(isotherms)} isotherm cannot be superposed; at least two are needed.", code="too-few-isotherms"
        )
    for isotherm in isotherms:
        if len(isotherm) < 2:
            raise SuperpositionError(
                f"the isotherm at {shown(isotherm.temperature)} has only one usable point; two or more are needed.",
                code="too-few-frequencies",
            )
    for colder, warmer in pairwise(isotherms):
        if not colder.temperature < warmer.temperature:
            raise SuperpositionError(
                f"two isotherms are at {shown(colder.temperature)}; merge them or leave one out.",
                code="same-temperature",
            )


def join_isotherms(
    isotherms: tuple[Tested, ...], logs: list[LogSweep], quantities: Quantities = BOTH
) -> JoinedIsotherms[Tested]:
    """Join neighbours by their quantities, and leave out single isotherms at the ends that overlap no other."""
    joins = [join(colder, warmer) for colder, warmer in pairwise(quantities.of(logs))]
    joined = np.array([found.misfit <= LARGEST_MISFIT for found in joins])
    if not joined.any():
        raise SuperpositionError(_gap(isotherms, 0), code="no-overlap")
    first, last = int(np.argmax(joined)), len(joined) - int(np.argmax(joined[::-1]))
    broken = np.flatnonzero(~joined[first:last])
    if broken.size:
        steps = [(isotherms[place].temperature, isotherms[place + 1].temperature) for place in np.flatnonzero(joined)]
        keep = f"keep one of the ranges within which isotherms overlap ({ranges(steps)}) and leave out the others, or "
        raise SuperpositionError(_gap(isotherms, first + int(broken[0]), keep), code="no-overlap")
    notes = tuple(
        Note("left-out", f"The isotherm at {shown(isotherms[place].temperature)} was left out: {_gap(isotherms, gap)}")
        for place, gap in [(p, p) for p in range(first)] + [(p, p - 1) for p in range(last + 1, len(isotherms))]
    )
    inside = slice(first, last + 1)
    return JoinedIsotherms(isotherms[inside], logs[inside], joins[first:last], notes)


def as_given(isotherms: tuple[Tested, ...], logs: list[LogSweep], shift: ShiftLaw) -> JoinedIsotherms[Tested]:
    """Compare all neighbours at given shift factors; InputError if the shift is invalid at one of the temperatures."""
    values = [shift.log10(isotherm.temperature) for isotherm in isotherms]
    steps = [colder - warmer for colder, warmer in pairwise(values)]
    joins = [join_at(colder, warmer, step) for (colder, warmer), step in zip(pairwise(logs), steps, strict=True)]
    return JoinedIsotherms(isotherms, logs, joins, ())


def _gap(isotherms: Sequence[Isotherm | StepTest], place: int, remedy: str = "") -> str:
    colder, warmer = isotherms[place], isotherms[place + 1]
    return (
        f"the isotherms at {shown(colder.temperature)} and {shown(warmer.temperature)} do not overlap "
        f"(no shift brings their moduli within {LARGEST_MISFIT:g} decades of each other); "
        f"{remedy}measure in between, or over more frequencies or times."
    )
