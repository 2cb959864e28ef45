"""Running a plan: stored contacts are reused, the others solved, and each is stored as soon as it is solved."""

from __future__ import annotations

import contextlib
import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any, Protocol

from viscofric.errors import DataFileError, InputError
from viscofric.friction.cases.solving import Task
from viscofric.study.run_file.settings import ClusterTable
from viscofric.study.running.executors import Executor, Lost, NoSolver, Outcome, Processes, Waiting
from viscofric.study.running.store import CaseStore, Damaged

#: What is done in each stage of a study.
STAGES = {
    "measurement": "reading the measurement",
    "material": "building the material",
    "shift": "shifting the measurement",
    "contacts": "solving contacts",
    "heating": "solving heated contacts",
    "histories": "solving contacts over time",
    "impacts": "solving impacts",
    "report": "drawing figures and report",
}


@dataclass(frozen=True)
class Event:
    """One event of a run."""

    #: ``"stage"``: a stage began or took a step; ``"solving"``: a contact is started; ``"solved"``: it is solved and
    #: stored; ``"stored"``: it was stored before; ``"damaged"``: the stored contact cannot be used; ``"failed"``: it
    #: could not be solved; ``"waiting"``: a cluster has no workers for the time being
    event: str
    stage: str | None = None  # one of `STAGES`
    done: int | None = None  # steps of the stage; for contacts, cases with a result
    total: int | None = None  # steps of the stage; for contacts, all cases
    solves: int | None = None  # contacts solved so far
    label: str | None = None  # the contact in words
    key: str | None = None  # name of its file
    seconds: float | None = None  # duration
    reason: str | None = None  # why it failed, what is wrong with the stored contact, or what the run waits for

    def as_dict(self) -> dict[str, Any]:
        """Return the attributes that are set."""
        values = ((field.name, getattr(self, field.name)) for field in fields(self))
        return {name: value for name, value in values if value is not None}


class Progress(Protocol):
    """A callback for events."""

    def __call__(self, event: Event) -> object:
        """Receive one event."""


def silent(event: Event) -> None:
    """Ignore an event."""


def choose_executor(
    workers: int | None, scheduler: str | None, cluster: ClusterTable | None, finished_only: bool = False
) -> Executor:
    """Return the requested executor; arguments take precedence over [cluster] of the run file."""
    if finished_only:
        if workers is not None or scheduler is not None:
            raise InputError("finished_only solves nothing; leave workers and scheduler out.", code="two-executors")
        return NoSolver()
    if scheduler is not None:
        if workers is not None:
            raise InputError(
                "workers and scheduler: give only one; a scheduler has its own workers.", code="two-executors"
            )
        from viscofric.study.running.cluster import Dask

        return Dask(scheduler)
    if workers is None and cluster is not None:
        from viscofric.study.running.cluster import BatchJobs, Dask

        return Dask(BatchJobs.of(cluster))
    return Processes(1 if workers is None else workers)


STAGE = "contacts"
_BETWEEN_COUNTS = 0.1  # s


class Plan(Protocol):
    """A plan as running uses it; see `viscofric.friction.planning.plan`."""

    @property
    def done(self) -> int:
        """Cases with a result."""

    @property
    def total(self) -> int:
        """All cases."""

    def wanted(self) -> Sequence[Task]:
        """Return independent tasks; none when every case has a result."""

    def receive(self, key: str, outcome: Outcome) -> None:
        """Take the result of a task."""


def run_plan(plan: Plan, store: CaseStore, executor: Executor, progress: Progress = silent) -> list[str]:
    """Solve all tasks of a plan that are not stored; return the labels of those whose stored contacts were damaged.

    The plan receives results in the order of its tasks, whatever the order in which they finish, so that its next
    tasks do not depend on timing.  An interrupt loses only the tasks being solved.
    """
    run = _Run(plan, store, executor, progress)
    run.report("stage")
    while tasks := list(plan.wanted()):
        run.wave(tasks)
    removed = run.kept.difference(store.stored()) if store.made else ()
    if removed:
        raise DataFileError(
            store.folder,
            f"{len(removed)} of {len(run.kept)} solved contacts were removed while the study ran; run it again with "
            "--resume, and do not change the folder meanwhile.",
            code="removed",
        )
    run.count_again()
    run.report("stage")
    return run.damaged


class _Run:
    """State of a plan while it runs."""

    def __init__(self, plan: Plan, store: CaseStore, executor: Executor, progress: Progress) -> None:
        self.plan, self.store, self.executor, self.progress = plan, store, executor, progress
        self.solves = 0
        self.damaged: list[str] = []
        self.kept: set[str] = set()
        self._counted = -math.inf
        self._done = 0

    def wave(self, tasks: Sequence[Task]) -> None:
        """Solve independent tasks."""
        by_key = {task.key: task for task in tasks}
        order = iter(by_key)
        due = next(order)
        outcomes: dict[str, Outcome] = {}

        def pass_on() -> None:
            nonlocal due
            while due in outcomes:
                self.plan.receive(due, outcomes[due])
                due = next(order, "")

        missing = []
        for task in by_key.values():
            found = self.store.get(task.key, task.fields)
            if found is None or isinstance(found, Damaged):
                if found is not None:
                    self.damaged.append(task.label)
                    self.report("damaged", task, reason=found.reason)
                missing.append(task)
                continue
            self.kept.add(task.key)
            outcomes[task.key] = found
            pass_on()
            self.report("stored", task)
        begun: dict[str, float] = {}
        with contextlib.closing(self.executor.map(missing)) as answers:
            for key, outcome in answers:
                if outcome is None:
                    begun[key] = time.monotonic()
                    self.report("solving", by_key[key])
                    continue
                if isinstance(outcome, Waiting):
                    self.report("waiting", reason=outcome.reason)
                    continue
                if not isinstance(outcome, Lost):
                    self.store.put(key, outcome)
                    self.kept.add(key)
                    self.solves += 1
                outcomes[key] = outcome
                pass_on()
                seconds = round(time.monotonic() - begun[key], 6) if key in begun else None
                reason = getattr(outcome, "reason", None)
                self.report("solved" if reason is None else "failed", by_key[key], seconds=seconds, reason=reason)

    def count_again(self) -> None:
        """Count the cases with a result at the next event, however recent the last count."""
        self._counted = -math.inf

    def _cases_done(self) -> int:
        """Return the number of cases with a result; counted only now and then, as a plan may have many."""
        if time.monotonic() > self._counted + _BETWEEN_COUNTS:
            self._done = self.plan.done
            self._counted = time.monotonic()
        return self._done

    def report(
        self, event: str, task: Task | None = None, seconds: float | None = None, reason: str | None = None
    ) -> None:
        self.progress(
            Event(
                event,
                stage=STAGE,
                done=self._cases_done(),
                total=self.plan.total,
                solves=self.solves,
                label=None if task is None else task.label,
                key=None if task is None else task.key,
                seconds=seconds,
                reason=reason,
            )
        )
