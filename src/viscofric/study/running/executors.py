"""Where tasks are solved: in this process, or in several processes of this machine."""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

from viscofric.errors import ConvergenceError, InputError, ViscofricError
from viscofric.processes import Workers, as_they_come
from viscofric.study.cases.record import Failure, Record
from viscofric.study.cases.solving import solver_fingerprint
from viscofric.threads import one_blas_thread

if TYPE_CHECKING:
    from collections.abc import Generator, Sequence
    from types import TracebackType
    from typing import Self


@dataclass(frozen=True)
class Waiting:
    """Nobody is there to do the tasks, now and maybe for long.

    Attributes
    ----------
    reason : str
        A sentence.
    """

    reason: str


Answers: TypeAlias = "Generator[tuple[str, Outcome | Waiting | None]]"


class Executor(contextlib.AbstractContextManager["Executor"]):
    """Does tasks, wherever; the answers do not depend on where, nor on how many work on them.

    Used in a ``with`` block, at the end of which nothing is at work any more.
    """

    def map(self, solve: Solve, tasks: Sequence[Task]) -> Answers:
        """Do tasks that are independent of each other.

        Parameters
        ----------
        solve : callable
            Gets a task, returns its record; raises ConvergenceError or InputError if there is none.  Importable by its
            name.
        tasks : sequence of Task

        Yields
        ------
        key : str
            Of a task, in the order in which they are finished.
        outcome : Record, Failure, Waiting or None
            None, where that is known: the task is begun.  A `Lost` one, where its workers ended again and again.
            `Waiting`, of no task, where there are no workers for the time being.

        Raises
        ------
        ViscofricError
            If there are no workers, or they are of no use.
        """
        raise NotImplementedError

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        pass


class Serial(Executor):
    """Does one task after the other in this process."""

    def map(self, solve: Solve, tasks: Sequence[Task]) -> Answers:
        """Do tasks; see `Executor`."""
        for task in tasks:
            yield task.key, None
            yield task.key, attempt(solve, task)


class Nobody(Executor):
    """Does no task: what is not known stays unknown."""

    def map(self, solve: Solve, tasks: Sequence[Task]) -> Answers:
        """Give every task up; see `Executor`."""
        for task in tasks:
            yield task.key, Lost("not solved yet; running the study again with --resume solves it.", task.label)


class Processes(Executor):
    """Shares tasks out among processes of this machine.

    They start with the block, and live on from one set of tasks to the next; one that ended is replaced by another.

    Parameters
    ----------
    number : int

    Raises
    ------
    InputError
        If it is not a whole number above zero.
    """

    def __init__(self, number: int) -> None:
        self._workers = Workers(number, needed=take.__module__)

    def __enter__(self) -> Self:
        self._workers.__enter__()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._workers.__exit__(kind, error, trace)

    def map(self, solve: Solve, tasks: Sequence[Task]) -> Answers:
        """Do tasks; see `Executor`."""
        fingerprint = solver_fingerprint()
        calls = [{"solve": solve, "task": task, "fingerprint": fingerprint} for task in tasks]
        with contextlib.closing(as_they_come(take, calls, workers=self._workers)) as found:
            for index, kind, value in found:
                task = tasks[index]
                if kind == "error":
                    raise value
                yield task.key, Lost.by(value, task) if kind == "ended" else value


Outcome: TypeAlias = Record | Failure
Solve: TypeAlias = Callable[[Any], Record]


class Task(Protocol):
    """What running needs to know of a task; all of it can be pickled."""

    @property
    def key(self) -> str:
        """Changes with all that decides the answer."""

    @property
    def label(self) -> str:
        """For people."""

    @property
    def fields(self) -> bool:
        """Whether its record has fields."""


class Lost(Failure):
    """A task that was given up for a reason that may lie outside it; it may well be solved another time."""

    @classmethod
    def by(cls, error: BaseException, task: Task) -> Self:
        """Tell of what came between."""
        kind = "" if isinstance(error, ViscofricError) else f"unexpectedly, {type(error).__name__}: "
        return cls(f"{kind}{error}", task.label)


@one_blas_thread
def attempt(solve: Solve, task: Task) -> Outcome:
    """Return the record of a task, or why there is none."""
    try:
        return solve(task)
    except (ConvergenceError, InputError) as error:
        return Failure.of(error, task.label)
    except Exception as error:  # noqa: BLE001 - one case of many, over a weekend: the others go on
        return Lost.by(error, task)


def take(solve: Solve, task: Task, fingerprint: str) -> Outcome:
    """Do a task of another process or machine, if the solver here is the same as there.

    Raises
    ------
    ViscofricError
        If it is another one: its answers would be stored as those of the first.
    """
    if fingerprint != solver_fingerprint():
        raise ViscofricError(
            "the solver that a worker has is not that of the study: viscofric must be the same on all machines, and "
            "must not be changed while a study runs."
        )
    return attempt(solve, task)


def take_on_cluster(solve: Solve, task: Task, fingerprint: str) -> Outcome:
    """Do a task in a process that may do several at a time, in threads."""
    _keep_blas_to_one_thread()
    return take(solve, task, fingerprint)


@functools.cache
def _keep_blas_to_one_thread() -> None:
    """Limit BLAS for good: limits that end do so in the middle of what other threads of the process do."""
    from threadpoolctl import threadpool_limits

    threadpool_limits(limits=1, user_api="blas")
