"""The cases of a study over time, where its run file has a [history]."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from viscofric.errors import InputError, StudyError
from viscofric.motion.history_files import read_history
from viscofric.motion.stages import staged_history
from viscofric.readers.history_columns import history_columns
from viscofric.study.cases.history import solve_history
from viscofric.study.cases.record import Failure
from viscofric.study.cases.solving import Task
from viscofric.study.cases.surface_case import SurfaceCase
from viscofric.study.cases.surfaces import unit_vector
from viscofric.study.planning.singles import Singles
from viscofric.study.results.tree import axis_coordinates, meaning_of

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray

    from viscofric.motion.history import History
    from viscofric.study.cases.case import Rubbers
    from viscofric.study.cases.sweep import Sweep
    from viscofric.study.run_file.history import HistoryTable
    from viscofric.study.run_file.study import Study


class Histories(Singles):
    """All cases over time, with the best estimate of the material and with its samples; the dwell runs fastest."""

    STAGE, GROUP, NOUN = "histories", "/history", "contacts over time"

    def __init__(self, tasks: list[Task | Failure], table: HistoryTable, sweep: Sweep) -> None:
        super().__init__(tasks)
        self._table, self._sweep = table, sweep

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
            for dwell in table.dwell:
                label = f"{case.label}, over time" + (f" after {dwell:g} s" if len(table.dwell) > 1 else "")
                try:
                    tasks.append(_task(case, rubbers, for_case(case, dwell), table, study, label))
                except InputError as error:
                    tasks.append(Failure.of(error, label))
        return cls(tasks, table, sweep)

    def dataset(self) -> xarray.Dataset | None:
        """Return all cases over time along the axes of the sweep, the dwell and ``instant``; None if all failed."""
        import xarray

        dwells, axes = self._table.dwell, self._sweep.axes
        dimensions = {axis.name: len(axis) for axis in axes if len(axis) > 1}
        dimensions |= {"dwell": len(dwells)} if len(dwells) > 1 else {}
        columns = self.columns(dimensions, "instant")
        if not columns:
            return None
        meaning = meaning_of(self._sweep.geometry)
        coordinates = {name: value for axis in axes for name, value in axis_coordinates(axis, meaning).items()}
        if self._table.file is None:
            about = {"units": "s", "long_name": "time at rest under the load before the sliding"}
            coordinates["dwell"] = ("dwell", list(dwells), about) if len(dwells) > 1 else ((), dwells[0], about)
        named = {f"{name}_over_time" if name in ("load", "temperature") else name: one for name, one in columns.items()}
        before = "repeated" if self._table.cycle else self._table.before
        return xarray.Dataset(named, coordinates, {"geometry": self._sweep.geometry, "before": before})


def _task(case: Any, rubbers: Rubbers, history: History, table: HistoryTable, study: Study, label: str) -> Task:
    rough = isinstance(case, SurfaceCase)
    arguments = {
        "modes": rubbers.modes(case),
        "poisson_ratio": rubbers.of(case).poisson_ratio,
        **({"surface": case.surface} if rough else {"indenter": case.indenter}),
        "history": history,
        "points": table.points,
        "accuracy": study.solver.accuracy,
        "layer": case.layer,
        "indenter_modulus": case.modulus,
        "indenter_poisson_ratio": case.poisson_ratio,
        "fields": False,
        **({"cycle": True} if table.cycle else {}),
    }
    return Task(solve_history, arguments, label)


def case_histories(study: Study, table: HistoryTable) -> Callable[[Any, float], History]:
    """Return what makes the history of a case and a dwell (s); raise `StudyError`, `DataFileError` for a bad table."""
    made: Callable[[Any, float], History] = _from_file(table, study) if table.file is not None else _from_stages(table)
    return made


def _from_stages(table: HistoryTable) -> Any:
    """Return what makes the history of a case: its load put on, a dwell, and its speed along the path."""

    def made(case: Any, dwell: float) -> History:
        return staged_history(
            *_prescribed(case), load_time=table.load_time, dwell=dwell, slide=table.slide or 0.0, speed=case.speed,
            strokes=table.strokes, before=table.before, direction=_direction(case),
        )  # fmt: skip

    return made


def _prescribed(case: Any) -> tuple[str, float]:
    """Return what is prescribed normal to the surface, and its value."""
    return ("pressure", case.pressure) if isinstance(case, SurfaceCase) else ("load", case.load)


def _direction(case: Any) -> tuple[float, float]:
    return unit_vector(case.direction) if isinstance(case, SurfaceCase) else (1.0, 0.0)


def checked_table(table: HistoryTable, study: Study) -> bool:
    """Return whether the file has a load or depth (pressure or gap); raise an error if it is swept, or no history."""
    path = str(table.file)
    found = set(history_columns(path, table.columns or None, table.sheet).values)
    if "temperature" in found:
        raise StudyError(
            f"history.file: {path} has a temperature; in a study, that of [conditions] holds; leave out its column.",
            code="swept-in-file",
            field="history.file",
        )
    load, depth = ("load", "indentation") if study.surface is None else ("pressure", "gap")
    has_load = bool({load, depth} & found)
    for name in (load, "speed") if has_load else ("speed",):
        values = getattr(study.conditions, name)
        if len(values) > 1:
            raise StudyError(
                f"history.file: {path} gives the {name} over time, but conditions.{name} has {len(values)} values; "
                "give one, or dwell and slide instead of the file.",
                code="swept-in-file",
                field="history.file",
            )
    _read(table, **({} if has_load else {load: float(getattr(study.conditions, load)[0])}))
    return has_load


def _read(table: HistoryTable, **constants: Any) -> History:
    return read_history(
        str(table.file), **constants, before=table.before, columns=table.columns or None, sheet=table.sheet
    )


def _from_file(table: HistoryTable, study: Study) -> Any:
    """Return what makes the history of a case from a table; without a load in it, that of the case."""
    has_load = checked_table(table, study)

    def made(case: Any, dwell: float) -> History:
        return _read(table, **({} if has_load else dict([_prescribed(case)])), direction=_direction(case))

    return made
