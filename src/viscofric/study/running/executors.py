"""Where tasks are solved: in this process, or in several processes of this machine."""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Generator, Sequence
from dataclasses import dataclass
from typing import Any, Self, TypeAlias

from viscofric.errors import ConvergenceError, InputError, ViscofricError
from viscofric.friction.cases.record import Failure, Record
from viscofric.friction.cases.solving import Task, solve, solver_fingerprint
from viscofric.processes import Workers, as_they_come
from viscofric.threads import one_blas_thread


@dataclass(frozen=True)
class Waiting:
    """No workers for the time being; `reason` is a sentence."""

    reason: str


Answers: TypeAlias = "Generator[tuple[str, Outcome | Waiting | None]]"


class Executor(contextlib.AbstractContextManager["Executor"]):
    """Solves tasks, in a ``with`` block; the results do not depend on the executor or its number of workers."""

    def map(self, tasks: Sequence[Task]) -> Answers:
        """Solve independent tasks, and yield the key and the outcome of each in the order in which they finish.

        The outcome is None when a task starts, and `Lost` when its workers ended again and again.  `Waiting`, without a
        key: there are no workers for the time being.  Raises `ViscofricError` if there are no usable workers.
        """
        raise NotImplementedError

    def __exit__(self, *error: object) -> None:
        pass


class NoSolver(Executor):
    """Solves no task."""

    def map(self, tasks: Sequence[Task]) -> Answers:
        """Give up every task; see `Executor`."""
        for task in tasks:
            yield (
                task.key,
                Lost("not solved yet; run the study again with --resume.", task.label, "not-solved"),
            )


class Processes(Executor):
    """Distributes tasks to `number` processes of this machine, which are reused, and replaced when they end.

    With one, this process solves the tasks, one after the other.
    """

    def __init__(self, number: int = 1) -> None:
        self._workers = Workers(number, needed=take.__module__)

    def __enter__(self) -> Self:
        self._workers.__enter__()
        return self

    def __exit__(self, *error: Any) -> None:
        self._workers.__exit__(*error)

    def map(self, tasks: Sequence[Task]) -> Answers:
        """Solve tasks; see `Executor`."""
        fingerprint = solver_fingerprint()
        calls = [{"task": task, "fingerprint": fingerprint} for task in tasks]
        with contextlib.closing(as_they_come(take, calls, workers=self._workers)) as found:
            for index, kind, value in found:
                task = tasks[index]
                if kind == "error":
                    raise value
                yield task.key, Lost.by(value, task) if kind == "ended" else value


Outcome: TypeAlias = Record | Failure


class Lost(Failure):
    """A task given up for a reason that may not be its own; another run may solve it."""

    @classmethod
    def by(cls, error: BaseException, task: Task) -> Self:
        """Return the failure due to an error."""
        if isinstance(error, ViscofricError):
            return cls(str(error), task.label, error.code)
        return cls(f"unexpectedly, {type(error).__name__}: {error}", task.label, "unexpected-error")


@one_blas_thread
def attempt(task: Task) -> Outcome:
    """Return the record of a task, or its failure."""
    try:
        return solve(task)
    except (ConvergenceError, InputError) as error:
        return Failure.of(error, task.label)
    except Exception as error:  # noqa: BLE001 - one case of many, over a weekend: the others go on
        return Lost.by(error, task)


def take(task: Task, fingerprint: str) -> Outcome:
    """Solve a task of another process or machine; raise `ViscofricError` if the solver there is another one."""
    if fingerprint != solver_fingerprint():
        raise ViscofricError(
            "the solver of a worker differs from that of the study: viscofric must be the same on all machines, and "
            "must not change while a study runs.",
            code="other-solver",
        )
    return attempt(task)


def take_on_cluster(task: Task, fingerprint: str) -> Outcome:
    """Solve a task in a process that may run several threads."""
    _keep_blas_to_one_thread()
    return take(task, fingerprint)


@functools.cache
def _keep_blas_to_one_thread() -> None:
    """Limit BLAS for the whole process: a temporary limit would end while other threads compute."""
    from threadpoolctl import threadpool_limits

    threadpool_limits(limits=1, user_api="blas")
