"""The cases of a study over time, where its run file has a [history]."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.errors import InputError, StudyError
from viscofric.motion.history_files import read_history
from viscofric.motion.stages import staged_history
from viscofric.notes import Note
from viscofric.readers.history_columns import history_columns
from viscofric.study.cases.history import solve_history
from viscofric.study.cases.record import Failure, HistoryRecord
from viscofric.study.cases.solving import Task
from viscofric.study.results.tree import axis_coordinates, meaning_of

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray

    from viscofric.motion.history import History
    from viscofric.study.cases.case import Rubbers
    from viscofric.study.cases.indenter_case import IndenterCase
    from viscofric.study.cases.record import Record
    from viscofric.study.cases.sweep import Sweep
    from viscofric.study.run_file.history import HistoryTable
    from viscofric.study.run_file.study import Study


@dataclass(eq=False)
class Histories:
    """A plan of all cases over time, each solved individually; see `viscofric.study.running.running.Plan`.

    Attributes
    ----------
    tasks : list of Task or Failure
        Of each case of the best estimate and each dwell; the dwell runs fastest.
    total, done : int
        Cases, and those with a result.
    """

    study: Study
    table: HistoryTable
    sweep: Sweep
    tasks: list[Task | Failure]
    _known: dict[str, Record | Failure] = field(default_factory=dict)

    @classmethod
    def of(cls, study: Study, sweep: Sweep, rubbers: Rubbers) -> Histories | None:
        """Return the plan of a study, None without [history]; raise `StudyError` or `DataFileError` for a bad table."""
        table = study.history
        if table is None:
            return None
        for_case = case_histories(study, table)
        tasks: list[Task | Failure] = []
        for one in sweep.cases:
            case: Any = one
            if case.sample is None:
                for dwell in table.dwell:
                    label = f"{case.label}, over time" + (f" after {dwell:g} s" if len(table.dwell) > 1 else "")
                    try:
                        tasks.append(_task(case, rubbers, for_case(case, dwell), table, study, label))
                    except InputError as error:
                        tasks.append(Failure.of(error, label))
        return cls(study, table, sweep, tasks)

    @property
    def total(self) -> int:
        """Number of cases over time."""
        return len(self.tasks)

    @property
    def done(self) -> int:
        """Cases with a result."""
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
        """Reasons of the cases without a result."""
        return [one.note for one in self.outcomes if isinstance(one, Failure)]

    @property
    def warnings(self) -> list[Note]:
        """Notes on assumptions, each with the number of histories."""
        records = [one for one in self.outcomes if isinstance(one, HistoryRecord)]
        said = dict.fromkeys(text for one in records for text in one.warnings)
        return [
            Note(
                "doubtful-histories",
                f"In {sum(text in one.warnings for one in records)} of {len(records)} contacts over time: {text}",
            )
            for text in said
        ]

    def dataset(self) -> xarray.Dataset | None:
        """Return all cases over time along the axes of the sweep, the dwell and ``instant``; None if all failed."""
        import xarray

        outcomes = self.outcomes
        records = [one for one in outcomes if isinstance(one, HistoryRecord)]
        if not records:
            return None
        axes = [axis for axis in self.sweep.axes if axis.name != "sample"]
        long = [axis for axis in axes if len(axis) > 1]
        several = len(self.table.dwell) > 1
        dimensions = [axis.name for axis in long] + (["dwell"] if several else []) + ["instant"]
        shape = [len(axis) for axis in long] + ([len(self.table.dwell)] if several else []) + [self.table.points]
        variables: dict[str, Any] = {}
        for name, (_, unit, words) in records[0].columns.items():
            missing = [float("nan")] * self.table.points
            rows = [one.columns[name].values if isinstance(one, HistoryRecord) else missing for one in outcomes]
            named = f"{name}_over_time" if name in ("load", "temperature") else name
            attributes = {"units": unit, "long_name": words}
            variables[named] = (dimensions, np.reshape(np.array(rows, dtype=float), shape), attributes)
        meaning = meaning_of(self.sweep.geometry)
        coordinates = {name: value for axis in axes for name, value in axis_coordinates(axis, meaning).items()}
        if self.table.file is None:
            dwells = self.table.dwell
            about = {"units": "s", "long_name": "time at rest under the load before the sliding"}
            coordinates["dwell"] = ("dwell", list(dwells), about) if several else ((), dwells[0], about)
        setting = {"geometry": self.sweep.geometry, "before": self.table.before, "direction": [1.0, 0.0]}
        return xarray.Dataset(variables, coordinates, setting)


def _task(
    case: IndenterCase, rubbers: Rubbers, history: History, table: HistoryTable, study: Study, label: str
) -> Task:
    arguments = {
        "modes": rubbers.modes(case),
        "poisson_ratio": rubbers.of(case).poisson_ratio,
        "indenter": case.indenter,
        "history": history,
        "points": table.points,
        "accuracy": study.solver.accuracy,
        "layer": case.layer,
        "indenter_modulus": case.modulus,
        "indenter_poisson_ratio": case.poisson_ratio,
        "fields": False,
    }
    return Task(solve_history, arguments, label)


def case_histories(study: Study, table: HistoryTable) -> Callable[[Any, float], History]:
    """Return what makes the history of a case and a dwell (s); raise `StudyError`, `DataFileError` for a bad table."""
    made: Callable[[Any, float], History] = _from_file(table, study) if table.file is not None else _from_stages(table)
    return made


def _from_stages(table: HistoryTable) -> Any:
    """Return what makes the history of a case: its load put on, a dwell, and its speed along the path."""

    def made(case: IndenterCase, dwell: float) -> History:
        return staged_history(
            "load", case.load, load_time=table.load_time, dwell=dwell, slide=table.slide or 0.0, speed=case.speed,
            strokes=table.strokes, before=table.before,
        )  # fmt: skip

    return made


def checked_table(table: HistoryTable, study: Study) -> bool:
    """Return whether the file of a history has a load or depth; raise an error if it is swept, or it is no history."""
    path = str(table.file)
    found = set(history_columns(path, table.columns or None, table.sheet).values)
    if "temperature" in found:
        raise StudyError(
            f"history.file: {path} has a temperature; in a study, that of [conditions] holds; leave out its column.",
            code="swept-in-file",
            field="history.file",
        )
    has_load = bool({"load", "indentation"} & found)
    for name in ("load", "speed") if has_load else ("speed",):
        values = getattr(study.conditions, name)
        if len(values) > 1:
            raise StudyError(
                f"history.file: {path} gives the {name} over time, but conditions.{name} has {len(values)} values; "
                "give one, or dwell and slide instead of the file.",
                code="swept-in-file",
                field="history.file",
            )
    _read(table, **({} if has_load else {"load": float(study.conditions.load[0])}))
    return has_load


def _read(table: HistoryTable, **constants: Any) -> History:
    return read_history(
        str(table.file), **constants, before=table.before, columns=table.columns or None, sheet=table.sheet
    )


def _from_file(table: HistoryTable, study: Study) -> Any:
    """Return what makes the history of a case from a table; without a load in it, that of the case."""
    has_load = checked_table(table, study)

    def made(case: IndenterCase, dwell: float) -> History:
        return _read(table, **({} if has_load else {"load": case.load}))

    return made
