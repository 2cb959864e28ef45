"""What is to be solved next for a set of cases, and what the answers make of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from viscofric.errors import InputError
from viscofric.study.planning.conditions import Rubbers, Settings, task_of
from viscofric.study.record import CaseRecord, Failure

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from viscofric.rheology.material import Material
    from viscofric.study.planning.conditions import Case
    from viscofric.study.solving import Task

Outcome: TypeAlias = CaseRecord | Failure


class Plan:
    """What is to be solved next, without clocks, files or processes.

    The same answers make the same plan, in whatever order they come in.

    Attributes
    ----------
    total : int
        Cases asked for.
    """

    def __init__(self, tasks: Sequence[Task | Failure]) -> None:
        self.total = len(tasks)
        self._tasks = tuple(tasks)
        self._outcomes: dict[str, Outcome] = {}

    @property
    def done(self) -> int:
        """Cases whose outcome is known."""
        return sum(isinstance(task, Failure) or task.key in self._outcomes for task in self._tasks)

    def wanted(self) -> list[Task]:
        """Return what is to be solved next, all of it independent of each other; empty when every case is known."""
        waiting = {task.key: task for task in self._tasks if not isinstance(task, Failure)}
        return [task for key, task in waiting.items() if key not in self._outcomes]

    def receive(self, key: str, outcome: Outcome) -> None:
        """Hear what became of a task.

        Parameters
        ----------
        key : str
            Of the task.
        outcome : CaseRecord or Failure
        """
        self._outcomes[key] = outcome

    def found(self) -> list[Outcome]:
        """Return what became of every case, in their order.

        Raises
        ------
        InputError
            If tasks are still waiting for their outcome.
        """
        if self.done < self.total:
            raise InputError(f"{self.total - self.done} cases are not known yet; solve what is wanted first.")
        return [task if isinstance(task, Failure) else self._outcomes[task.key] for task in self._tasks]


def plan_cases(
    cases: Sequence[Case],
    materials: Sequence[Material],
    *,
    members: Mapping[int, Sequence[Material]] | None = None,
    accuracy: float = 1e-3,
    sensitive: bool = False,
    fields: bool = False,
    each: bool = True,
) -> Plan:
    """Plan how a set of cases becomes known.

    Parameters
    ----------
    cases : sequence of Case
    materials : sequence of Material
        That the cases name by number; with a shift where cases differ in temperature.
    members : mapping of int to sequence of Material, optional
        Of the number of a material: what is drawn from its posterior, which cases name by `sample`.
    accuracy : float
        Of the friction coefficients, relative.
    sensitive : bool
        Whether to find how friction answers to the rubber's compliance, for bands.
    fields : bool
        Whether to keep pressure and displacement.
    each : bool
        Whether every case is solved by itself; the only way as yet.

    Returns
    -------
    Plan

    Raises
    ------
    InputError
        If cases are not to be solved each.
    """
    if not each:
        raise InputError("each = False: every case is solved by itself; give each = True.")
    rubbers, settings = Rubbers(materials, members or {}), Settings(accuracy, sensitive, fields)
    return Plan([task_of(case, rubbers, settings) for case in cases])
