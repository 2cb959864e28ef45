"""Carrying out a plan: stored contacts are taken, the others solved, and each is stored as soon as it is solved."""

from __future__ import annotations

import contextlib
import math
import time
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Protocol, TypeAlias

from viscofric.errors import DataFileError, InputError
from viscofric.study.cases.solving import solve
from viscofric.study.running.executors import Executor, Lost, Nobody, Processes, Serial, Waiting
from viscofric.study.running.store import Damaged

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.study.run_file.settings import ClusterTable
    from viscofric.study.running.executors import Outcome, Solve, Task
    from viscofric.study.running.store import CaseStore

    Value: TypeAlias = str | int | float | bool


@dataclass(frozen=True)
class Event:
    """One thing that happened.

    Attributes
    ----------
    event : str
        ``"stage"``: a stage began or took a step; ``"solving"``: a contact is begun; ``"solved"``: it is solved and
        stored; ``"stored"``: it had been before; ``"damaged"``: what had been stored cannot be used; ``"failed"``: it
        could not be solved; ``"waiting"``: a cluster has no workers for the time being.
    stage : str, optional
        Of the study: "measurement", "material", "contacts", "report" …
    done, total : int, optional
        Steps of the stage; of contacts, the cases that are known and those that are asked for.
    solves : int, optional
        Contacts solved for that, so far: many cases may come from few of them, or a case from several.
    label : str, optional
        The contact, for people.
    key : str, optional
        The contact, for programs: the name of its file.
    seconds : float, optional
        What it took.
    reason : str, optional
        Why it failed, what is wrong with what was stored, or what is waited for.
    """

    event: str
    stage: str | None = None
    done: int | None = None
    total: int | None = None
    solves: int | None = None
    label: str | None = None
    key: str | None = None
    seconds: float | None = None
    reason: str | None = None

    def as_dict(self) -> dict[str, Value]:
        """Return what is known of it."""
        told = ((field.name, getattr(self, field.name)) for field in fields(self))
        return {name: value for name, value in told if value is not None}


class Progress(Protocol):
    """What hears of a study's progress."""

    def __call__(self, event: Event) -> object:
        """Hear of one event."""


def silent(event: Event) -> None:
    """Hear, and say nothing."""


def choose_executor(
    workers: int | None, scheduler: str | None, cluster: ClusterTable | None, finished_only: bool = False
) -> Executor:
    """Return the executor that is asked for; what is asked for now counts more than the run file.

    Parameters
    ----------
    workers : int, optional
        Processes of this machine.
    scheduler : str, optional
        Address of a Dask scheduler.
    cluster : ClusterTable, optional
        Of the run file.
    finished_only : bool
        Whether nothing is to be done any more.

    Raises
    ------
    InputError
        If both are asked for, the number is none, or Dask is not installed.
    """
    if finished_only:
        if workers is not None or scheduler is not None:
            raise InputError("finished_only: nothing is solved, so that neither workers nor a scheduler are of use.")
        return Nobody()
    if scheduler is not None:
        if workers is not None:
            raise InputError("workers and scheduler: only one of them; a scheduler has workers of its own.")
        from viscofric.study.running.cluster import Dask

        return Dask(scheduler)
    if workers is not None:
        executor = Processes(workers)
        return Serial() if workers == 1 else executor
    if cluster is not None:
        from viscofric.study.running.cluster import BatchJobs, Dask

        return Dask(BatchJobs.of(cluster))
    return Serial()


STAGE = "contacts"
_BETWEEN_COUNTS = 0.1  # s


class Plan(Protocol):
    """What running needs to know of a plan: see `viscofric.study.planning`."""

    @property
    def done(self) -> int:
        """Cases that are known."""

    @property
    def total(self) -> int:
        """Cases that are asked for."""

    def wanted(self) -> Sequence[Task]:
        """Return tasks that do not depend on each other; none when everything is known."""

    def receive(self, key: str, outcome: Outcome) -> None:
        """Take what became of a task."""


def run_plan(
    plan: Plan, store: CaseStore, executor: Executor, progress: Progress = silent, solve: Solve = solve
) -> list[str]:
    """Do all tasks of a plan, but those that the store has.

    Parameters
    ----------
    plan : Plan
        Receives what becomes of its tasks in the order in which it wanted them, whatever the order in which they are
        finished: what it wants next then depends on nothing else.
    store : CaseStore
        Gets each record, and each failure, as soon as it is there.
    executor : Executor
        Within its ``with`` block.
    progress : callable, optional
        Hears of each task.
    solve : callable, optional
        Gets a task, returns its record; importable by its name.

    Returns
    -------
    list of str
        Labels of the tasks whose stored cases were damaged, and were done again.

    Raises
    ------
    DataFileError
        If the store cannot be written (disk full, folder read-only), or cases were removed from it meanwhile.
    ViscofricError
        If the executor cannot go on.

    Notes
    -----
    An interrupt loses the tasks that are worked on, and no others.
    """
    run = _Run(plan, store, executor, progress, solve)
    run.tell("stage")
    while tasks := list(plan.wanted()):
        run.wave(tasks)
    removed = run.kept.difference(store.stored()) if store.made else ()
    if removed:
        raise DataFileError(
            store.folder,
            f"{len(removed)} of {len(run.kept)} solved contacts were removed while the study ran; run it again with "
            "--resume, and leave the folder alone until it ends.",
        )
    run.count_again()
    run.tell("stage")
    return run.damaged


class _Run:
    """What is known of a plan while it is carried out."""

    def __init__(self, plan: Plan, store: CaseStore, executor: Executor, progress: Progress, solve: Solve) -> None:
        self.plan, self.store, self.executor, self.progress, self.solve = plan, store, executor, progress, solve
        self.solves = 0
        self.damaged: list[str] = []
        self.kept: set[str] = set()
        self._counted = -math.inf
        self._done = 0

    def wave(self, tasks: Sequence[Task]) -> None:
        """Do tasks that are independent of each other."""
        by_key = {task.key: task for task in tasks}
        order = iter(by_key)
        due = next(order)
        outcomes: dict[str, Outcome] = {}

        def hand_on() -> None:
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
                    self.tell("damaged", task, reason=found.reason)
                missing.append(task)
                continue
            self.kept.add(task.key)
            outcomes[task.key] = found
            hand_on()
            self.tell("stored", task)
        begun: dict[str, float] = {}
        with contextlib.closing(self.executor.map(self.solve, missing)) as answers:
            for key, outcome in answers:
                if outcome is None:
                    begun[key] = time.monotonic()
                    self.tell("solving", by_key[key])
                    continue
                if isinstance(outcome, Waiting):
                    self.tell("waiting", reason=outcome.reason)
                    continue
                if not isinstance(outcome, Lost):
                    self.store.put(key, outcome)
                    self.kept.add(key)
                    self.solves += 1
                outcomes[key] = outcome
                hand_on()
                self._tell_outcome(by_key[key], outcome, begun.get(key))

    def _tell_outcome(self, task: Task, outcome: Outcome, begun: float | None) -> None:
        seconds = None if begun is None else round(time.monotonic() - begun, 6)
        reason = getattr(outcome, "reason", None)
        self.tell("solved" if reason is None else "failed", task, seconds=seconds, reason=reason)

    def count_again(self) -> None:
        """Have the cases that are known counted at the next event, however short ago that was."""
        self._counted = -math.inf

    def _cases_done(self) -> int:
        """Ask the plan how many cases are known; not too often, as it may have many to look through."""
        if time.monotonic() > self._counted + _BETWEEN_COUNTS:
            self._done = self.plan.done
            self._counted = time.monotonic()
        return self._done

    def tell(
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
