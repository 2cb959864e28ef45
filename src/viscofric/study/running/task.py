"""One task done, wherever that is: what it raises is an outcome like any other."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

from viscofric.errors import ConvergenceError, InputError, ViscofricError
from viscofric.study.cases.keys import solver_fingerprint
from viscofric.study.record import Failure, Record
from viscofric.threads import one_blas_thread

if TYPE_CHECKING:
    from typing import Self

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
