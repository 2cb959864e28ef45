"""The plan of a set of cases: which contacts to solve next, and the results of the cases from theirs."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import partial
from typing import TypeAlias

import numpy as np

from viscofric.errors import InputError, wrong_argument
from viscofric.friction.cases.case import Case, Place, Rubbers, Settings
from viscofric.friction.cases.interpolation import Node
from viscofric.friction.cases.record import Failure, Record
from viscofric.friction.cases.solving import Task
from viscofric.friction.planning.curve import STEP, Curve, Interval
from viscofric.rheology.material import Material

Outcome: TypeAlias = Record | Failure


class Plan:
    """What is to be solved next; of `total` cases, `done` have a result or lie in intervals fine enough."""

    def __init__(
        self,
        cases: Sequence[Case],
        materials: Sequence[Material],
        *,
        members: Mapping[int, Sequence[Material]] | None = None,
        accuracy: float = 1e-3,
        sensitive: bool = False,
        fields: bool | Collection[int] = False,
        each: bool = False,
    ) -> None:
        # Cases refer to materials, with a shift if they differ in temperature, by index, and to the bootstrap samples
        # in `members` by their number, from 1. `accuracy` is that of the friction coefficients, relative. If
        # `sensitive`, the derivatives of friction by the material's compliance are found for bands; not for bootstrap
        # samples. `fields` are kept of all cases, or of those of given numbers, which are solved individually, as are
        # all if `each`. If not, cases on one curve (Eq. 10) are interpolated between as many solved contacts as the
        # accuracy requires. The nodes of curves lie at fixed places. A study with more cases has the same nodes and
        # some others, so that results of its old cases change within the accuracy if their neighbourhood is refined,
        # and not at all elsewhere.
        kept = range(len(cases)) if fields is True else () if fields is False else fields
        self.rubbers, self.settings = Rubbers(materials, members or {}), Settings(accuracy, sensitive, frozenset(kept))
        self.total, self.done, self._cases = len(cases), 0, cases
        self._outcomes: list[Outcome | None] = [None] * len(cases)
        self._waiting: dict[str, Task] = {}
        self._callbacks: dict[str, list[Callable[[Outcome], None]]] = {}
        self._known: dict[str, Outcome] = {}
        alone = set(range(len(cases)) if each else self.settings.fields)
        self._parts = [_FamilyPlan(self, family, members) for family, members in self._families(alone).items()]
        for part in self._parts:
            part.go_on()
        for number in sorted(alone):
            self.solve_alone(number)

    @property
    def shares(self) -> bool:
        """Whether some cases lie so close on one curve that they are interpolated between fewer contacts."""
        return any(part.shares for part in self._parts)

    def wanted(self) -> list[Task]:
        """Return the tasks to solve next, independent of each other; none when every case has a result."""
        return list(self._waiting.values())

    def receive(self, key: str, outcome: Outcome) -> None:
        """Take the result of a wanted task; raise `InputError` if no such task was ever wanted."""
        if key in self._known:
            return
        if key not in self._waiting:
            raise wrong_argument("key", key, "this plan has no such task.", "no-such-task")
        del self._waiting[key]
        self._known[key] = outcome
        for call in self._callbacks.pop(key):
            call(outcome)

    def found(self) -> list[Outcome]:
        """Return the results of all cases, in their order; raise `InputError` if tasks are still open."""
        known = [outcome for outcome in self._outcomes if outcome is not None]
        if len(known) < self.total:
            raise InputError(
                f"{self.total - len(known)} of {self.total} cases have no result yet; solve the wanted tasks first.",
                code="unfinished",
            )
        return known

    def so_far(self) -> Iterator[tuple[int, Outcome, bool]]:
        """Yield the number of a case, its preliminary outcome, and whether that is already within the accuracy."""
        for number, outcome in enumerate(self._outcomes):
            if outcome is not None:
                yield number, outcome, True
        for part in self._parts:
            yield from part.draft()

    def settle(self, number: int, outcome: Outcome) -> None:
        """Set the result of a case."""
        self.done += 1
        self._outcomes[number] = outcome

    def solve_alone(self, number: int) -> None:
        """Request the individual solution of a case."""
        task = self.rubbers.task(self._cases[number], self.settings, fields=number in self.settings.fields)
        if isinstance(task, Failure):
            self.settle(number, task)
        else:
            self.request(task, partial(self.settle, number))

    def request(self, task: Task, callback: Callable[[Outcome], None]) -> None:
        """Request the solution of a task; `callback` gets the outcome, at once if it is known."""
        if task.key in self._known:
            callback(self._known[task.key])
            return
        self._waiting.setdefault(task.key, task)
        self._callbacks.setdefault(task.key, []).append(callback)

    def case(self, number: int) -> Case:
        """Return a case by its number."""
        return self._cases[number]

    def _families(self, alone: Collection[int]) -> dict[Case, list[tuple[int, Place]]]:
        """Sort all cases but some into families."""
        families: dict[Case, list[tuple[int, Place]]] = {}
        for number, case in enumerate(self._cases):
            if number not in alone:
                try:
                    place = case.place(self.rubbers)
                except InputError as error:
                    self.settle(number, Failure.of(error, case.label))
                else:
                    families.setdefault(place.family, []).append((number, place))
        return families


class _FamilyPlan:
    """The part of a plan for one family: its curve, and the current wave at the reference temperature."""

    def __init__(self, plan: Plan, family: Case, members: list[tuple[int, Place]]) -> None:
        self._plan, self._family = plan, family
        self._numbers = [number for number, _ in members]
        self._places = [place for _, place in members]
        accuracy, places = plan.settings.accuracy, np.array([place.s for place in self._places])
        self._curve = Curve(places, accuracy, family.LOGARITHMIC)
        self.shares = bool(self._curve.wanted)
        self._wave: dict[int, Node | None] = {}
        self._counted = 0
        self._settled = False

    def go_on(self) -> None:
        """Request the next wave, or settle all cases if there is none."""
        self._wave = {}
        requested = self._curve.wanted
        rubbers, settings = self._plan.rubbers, self._plan.settings
        for place in requested:
            task = rubbers.node_task(self._family, math.exp(STEP * place), settings)
            self._plan.request(task, partial(self._receive, place))
        if not requested:
            self._settle()

    def _receive(self, place: int, outcome: Outcome) -> None:
        rubbers, accuracy = self._plan.rubbers, self._plan.settings.accuracy
        self._wave[place] = None if isinstance(outcome, Failure) else self._family.node(outcome, rubbers, accuracy)
        if len(self._wave) == len(self._curve.wanted):
            self._curve.advance(self._wave)
            self._count(sum(len(one.cases) for one in self._curve.closed))
            self.go_on()

    def draft(self) -> Iterator[tuple[int, Outcome, bool]]:
        """Yield cases between known contacts; see `Plan.so_far`."""
        if self._settled:
            return
        curve = self._curve.drafted(self._wave)
        for place, one in enumerate(curve.closed):
            for number, outcome in self._interpolated(curve, one):
                yield number, outcome, place < len(self._curve.closed)

    def _interpolated(self, curve: Curve, one: Interval) -> Iterator[tuple[int, Outcome]]:
        """Yield the cases of an interval, by their numbers in the plan."""
        cases = [self._plan.case(number) for number in self._numbers]
        for row, outcome in self._family.interpolated(curve.between(one), cases, self._places, self._plan.rubbers):
            yield self._numbers[row], outcome

    def _count(self, cases: int) -> None:
        """Count cases as done before they are settled, or undo it."""
        self._plan.done += cases - self._counted
        self._counted = cases

    def _settle(self) -> None:
        self._count(0)  # each is counted when it is settled
        self._settled = True
        for one in self._curve.closed:
            for number, outcome in self._interpolated(self._curve, one):
                self._plan.settle(number, outcome)
        for row in sorted(self._curve.alone):
            self._plan.solve_alone(self._numbers[row])
