"""A plan of contacts that are solved one by one, beside those that share curves: cases over time, and impacts."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from viscofric.datasets import Dataset, dataset
from viscofric.friction.cases.record import Failure, HistoryRecord, Record
from viscofric.friction.cases.solving import Task
from viscofric.notes import Note, counted

#: Numbers over time with the names of coordinates.
_OVER_TIME = ("load", "temperature")


class Singles:
    """Contacts of one kind with their results, see `running.Plan`; the last of the dimensions runs fastest."""

    #: Its stage in events, its group in the results, and its contacts in a sentence.
    STAGE: ClassVar[str]
    GROUP: ClassVar[str]
    NOUN: ClassVar[str]

    def __init__(
        self,
        tasks: Sequence[Task | Failure],
        dimensions: Mapping[str, int] | None = None,
        coordinates: Mapping[str, Any] | None = None,
        attributes: Mapping[str, Any] | None = None,
        along: str = "",
    ) -> None:
        """`along`: dimension of results that have several values for each contact."""
        self.tasks, self._dimensions, self._along = tasks, dict(dimensions or {}), along
        self._coordinates, self._attributes = coordinates, attributes
        self._known: dict[str, Record | Failure] = {}

    @property
    def total(self) -> int:
        """Number of contacts."""
        return len(self.tasks)

    @property
    def done(self) -> int:
        """Contacts with a result."""
        return sum(1 for one in self.tasks if isinstance(one, Failure) or one.key in self._known)

    def wanted(self) -> list[Task]:
        """Return the tasks without a result."""
        return [one for one in self.tasks if isinstance(one, Task) and one.key not in self._known]

    def receive(self, key: str, outcome: Record | Failure) -> None:
        """Take the result of a task."""
        self._known[key] = outcome

    @property
    def outcomes(self) -> list[Any]:
        """Record or failure of each task."""
        return [one if isinstance(one, Failure) else self._known[one.key] for one in self.tasks]

    @property
    def failures(self) -> list[Note]:
        """Reasons of the contacts without a result."""
        return [one.note for one in self.outcomes if isinstance(one, Failure)]

    @property
    def warnings(self) -> list[Note]:
        """Notes on assumptions, each with the number of contacts, and the first of them."""
        each = [
            [note.at(f"such as at {task.label}") if task.label else note for note in one.warnings]
            for task, one in zip(self.tasks, self.outcomes, strict=True)
            if isinstance(task, Task) and isinstance(one, HistoryRecord)
        ]
        return [*counted(each, of=self.NOUN)]

    def dataset(self) -> Dataset | None:
        """Return all results along their axes; None if all failed."""
        columns = self.columns()
        if not columns:
            return None
        found = dataset((*self._dimensions, self._along), columns, attributes=self._attributes)
        return found.assign_coords(self._coordinates)

    def groups(self) -> dict[str, Dataset]:
        """Return all results by their groups; none if all failed."""
        found = self.dataset()
        return {} if found is None else {self.GROUP: found}

    def columns(self) -> dict[str, Any]:
        """Return the results with units and names; contacts without a result are NaN; empty if all failed."""
        outcomes = self.outcomes
        records = [one for one in outcomes if isinstance(one, HistoryRecord)]
        found: dict[str, Any] = {}
        for name, (values, unit, words) in records[0].columns.items() if records else ():
            missing = [math.nan] * len(values)
            rows = [one.columns[name].values if isinstance(one, HistoryRecord) else missing for one in outcomes]
            shape = [*self._dimensions.values(), *([len(values)] if len(values) > 1 else [])]
            shaped = np.reshape(np.array(rows, dtype=float), shape)
            found[f"{name}_over_time" if name in _OVER_TIME else name] = (shaped, unit, words)
        return found
