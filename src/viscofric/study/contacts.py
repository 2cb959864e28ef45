"""All contacts of a study in one plan: its cases, those at measured points, and those along the master curve."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from viscofric.arrays import Mask
from viscofric.contact.free.estimates import beyond_accuracy
from viscofric.errors import StudyError
from viscofric.friction.cases.case import Case, moved
from viscofric.friction.cases.record import Failure, Record
from viscofric.friction.planning.plan import Plan
from viscofric.notes import Note, counted
from viscofric.study.cases.sweep import Sweep, place, place_in
from viscofric.study.measurement import Measurement
from viscofric.study.run_file.study import Study
from viscofric.study.study_rubber import StudyRubber
from viscofric.units import plain

# Margin beyond the speeds of the cases, so that rounding leaves no point outside the master curve.
_ROUNDING = 1e-6


@dataclass(frozen=True, eq=False)
class Solved:
    """Some cases of a study with their results."""

    cases: tuple[Case, ...]
    outcomes: tuple[Record | Failure, ...]  # of each case
    sweep: Sweep | None = None  # if the cases are those of a sweep
    reduced: bool = False  # whether their speeds are reduced ones, of the master curve, at which nothing moves

    def place(self, number: int) -> str:
        """Return the position of a case in words."""
        return place(self.cases[number]) if self.sweep is None else place_in(self.sweep, number)

    @property
    def records(self) -> list[Any]:
        """The records, in the order of the cases."""
        return [outcome for outcome in self.outcomes if isinstance(outcome, Record)]

    @property
    def of_records(self) -> list[Any]:
        """The cases of `records`."""
        pairs = zip(self.cases, self.outcomes, strict=True)
        return [case for case, outcome in pairs if isinstance(outcome, Record)]

    @property
    def failures(self) -> list[Failure]:
        """The failures, with the position of their cases."""
        return [
            replace(outcome, label=self.place(number))
            for number, outcome in enumerate(self.outcomes)
            if isinstance(outcome, Failure)
        ]


class Contacts:
    """The contacts of a study, in one plan: its cases, those at measured points, and those along the master curve.

    There are none along the master curve if there are several, nor for a rough surface, where each seed has its own.
    """

    def __init__(self, study: Study, rubbers: Sequence[StudyRubber], measured: Measurement | None) -> None:
        self.study, self.rubbers, self.measured = study, rubbers, measured
        self.sweep: Sweep = study.sweep()
        self.at_points, self.along = self._at_points(), self._along()
        self.plan: Plan = self._plan()

    def results(self) -> tuple[Solved, Solved, Solved]:
        """Return the three parts with their results; raise `InputError` if the plan has not run."""
        found, parts = list(self.plan.found()), []
        for cases in (self.sweep.cases, self.at_points, self.along):
            of = self.sweep if cases is self.sweep.cases else None
            parts.append(Solved(cases, tuple(found[: len(cases)]), of, reduced=cases is self.along))
            del found[: len(cases)]
        requested, at_points, along = parts
        return requested, at_points, along

    def _plan(self) -> Plan:
        solver, kept = self.study.solver, self.study.outputs.fields
        return Plan(
            [*self.sweep.cases, *self.at_points, *self.along],
            [rubber.material for rubber in self.rubbers],
            members={number: rubber.members for number, rubber in enumerate(self.rubbers)},
            accuracy=solver.accuracy,
            sensitive=any(rubber.bands.samples is not None for rubber in self.rubbers),
            fields=range(len(self.sweep.cases)) if kept == "all" else self._few() if kept == "few" else False,
            each=solver.cases == "each",
        )

    def _at_points(self) -> tuple[Case, ...]:
        if self.measured is None:
            return ()
        curves, first = self.measured.curves, self.sweep.cases[0]
        points = zip(curves.temperature.tolist(), curves.speed.tolist(), curves.load.tolist(), strict=True)
        return tuple(moved(first, temperature=T, speed=v, load=F) for T, v, F in points)

    def _reduced(self, case: Case) -> float:
        return case.speed * float(self.rubbers[case.material].shift(case.temperature))

    def _along(self) -> tuple[Case, ...]:
        """Return the contacts of the master curve at the reference temperature; none if it would be one point."""
        points = self.study.solver.points_along(measured=self.measured is not None)
        one, alike = self.sweep.cases[0], {case.alike for case in self.sweep.cases if case.sample is None}
        if not one.HAS_MASTER_CURVE or (len(alike) > 1 and self.measured is None):
            return ()
        reduced = np.array([self._reduced(case) for case in self.sweep.cases])
        if self.measured is not None:
            reduced = np.concatenate([reduced, self.measured.reduced_speed])
        if self.measured is None and (points == 0 or reduced.max() <= reduced.min() * (1.0 + _ROUNDING)):
            return ()
        ends = reduced.min() * (1.0 - _ROUNDING), reduced.max() * (1.0 + _ROUNDING)
        speeds = np.geomspace(*ends, points)
        reference = self.rubbers[one.material].shift.reference
        return tuple(moved(one, temperature=reference, speed=speed, sample=None) for speed in speeds.tolist())

    def _few(self) -> list[int]:
        """Choose cases whose fields are kept: of the first load, shape … the slowest, middle and fastest (reduced)."""
        first = self.sweep.cases[0]
        numbers = [number for number, case in enumerate(self.sweep.cases) if case.alike == first.alike]
        numbers.sort(key=lambda number: self._reduced(self.sweep.cases[number]))
        return sorted({numbers[0], numbers[len(numbers) // 2], numbers[-1]})


def doubts(parts: Sequence[Solved], rubbers: Sequence[StudyRubber]) -> list[Note]:
    """Return notes on assumptions that do not hold well, with the numbers of contacts."""
    found = [
        (part, number, outcome)
        for part in parts
        for number, outcome in enumerate(part.outcomes)
        if isinstance(outcome, Record)
    ]
    worst = "worst at " if len(found) > 1 else ""
    each = [
        [
            note.at(f"{worst}{part.place(number)}")
            for note in one.warnings
            if not (part.reduced and note.code == "quasi-static")
        ]
        for part, number, one in found
    ]
    reach = [part.cases[number].reach(one) if one.warnings else 0.0 for part, number, one in found]
    notes = [*counted(each, reach)]
    for index, rubber in enumerate(rubbers):
        own = [(part, number, one) for part, number, one in found if part.cases[number].material == index]
        beyond = [one for one in own if rubber.is_within(one[0].cases[one[1]], one[2]) is False]
        if beyond and rubber.known_frequencies is not None:
            part, number, _ = beyond[0]
            subject = f"In {len(beyond)} of {len(own)} contacts, such as {part.place(number)}, "
            subject += part.cases[number].FREQUENCIES
            notes.append(rubber.known_frequencies.beyond_note(subject, contacts=len(beyond), of=len(own)))
    return notes


def nothing_solved(first: Note) -> StudyError:
    """Return the error of a study of which no case could be solved."""
    return StudyError(first.at("No case could be solved; the first one failed").coded("nothing-solved"))


def missed_accuracy(part: Solved, study: Study) -> tuple[Mask, list[Note]]:
    """Return which of the solved cases miss the accuracy of the study, and a note on them."""
    records, accuracy = part.records, study.solver.accuracy
    friction = np.array([one.friction_coefficient for one in records])
    error = np.array([one.friction_error for one in records])
    slopes = [2.0 * one.indentation / (one.front + one.rear) for one in records if hasattr(one, "front")]
    beyond = beyond_accuracy(friction, error, accuracy, max(slopes, default=0.0))
    if not beyond.any():
        return beyond, []
    known = beyond & (friction != 0.0)
    worst = float(np.max(error[known] / np.abs(friction[known]), initial=0.0))
    why = "" if study.indenter else ": the spacing of the surface's points is too large"
    most = f", {plain(100.0 * worst, 3)} % at most," if worst else ""
    count, asked = int(beyond.sum()), f"the requested accuracy, {plain(100.0 * accuracy, 3)} %"
    said = f"In {count} of {beyond.size} cases the estimated numerical error of friction{most} exceeds {asked}{why}."
    values = {"cases": count, "of": beyond.size, "error": worst, "accuracy": accuracy}
    return beyond, [Note("accuracy-missed", said, values=values)]
