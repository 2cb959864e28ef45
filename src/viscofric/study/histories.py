"""The cases of a study over time, where its run file has a [history]."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any

from viscofric.errors import InputError, StudyError
from viscofric.friction.cases.record import Failure
from viscofric.friction.cases.solving import Task
from viscofric.friction.cases.surface_case import SurfaceCase
from viscofric.friction.cases.surfaces import unit_vector
from viscofric.motion.history_files import read_history
from viscofric.motion.stages import staged_history
from viscofric.readers.one_table import history_columns
from viscofric.rheology.material import Material
from viscofric.study.cases.history import solve_history
from viscofric.study.cases.singles import Singles
from viscofric.study.heating import COULOMB
from viscofric.study.results.tree import coordinate, coordinates_of
from viscofric.study.run_file.study import isothermal

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from viscofric.friction.cases.case import Rubbers
    from viscofric.motion.history import History
    from viscofric.notes import Note
    from viscofric.study.cases.sweep import Sweep
    from viscofric.study.run_file.history import HistoryTable
    from viscofric.study.run_file.study import Study


class Histories(Singles):
    """All cases over time, with the best estimate of the material and with its samples.

    Of each case, the Coulomb friction of heated contacts runs fastest, then the dwell.
    """

    STAGE, GROUP, NOUN = "histories", "/history", "contacts over time"

    @classmethod
    def of(cls, study: Study, sweep: Sweep, rubbers: Rubbers) -> Histories | None:
        """Return the plan of a study, None without [history]; raise `StudyError` or `DataFileError` for a bad table."""
        table = study.history
        if table is None:
            return None
        heated = is_heated(study, rubbers.materials)
        for_case = case_histories(study, table, heated=heated)
        tasks: list[Task | Failure] = []
        coulomb = study.heating.coulomb if study.heating is not None and heated else ()
        for one in sweep.cases:
            case: Any = one
            for dwell, friction in itertools.product(table.dwell, coulomb or (None,)):
                label = f"{case.label}, over time" + (f" after {dwell:g} s" if len(table.dwell) > 1 else "")
                label += f", Coulomb friction {friction:g}" if len(coulomb) > 1 else ""
                try:
                    tasks.append(_task(case, rubbers, for_case(case, dwell), study, label, friction))
                except InputError as error:
                    tasks.append(Failure.of(error, label))
        coordinates = coordinates_of(sweep.axes, sweep.geometry)
        if table.file is None:
            about = {"units": "s", "long_name": "time at rest under the load before the sliding"}
            coordinates["dwell"] = coordinate("dwell", table.dwell, about)
        if coulomb:
            coordinates["coulomb"] = coordinate("coulomb", coulomb, COULOMB)
        sizes = {axis.name: len(axis) for axis in sweep.axes} | {"dwell": len(table.dwell), "coulomb": len(coulomb)}
        dimensions = {name: size for name, size in sizes.items() if size > 1}
        attributes = {"geometry": sweep.geometry, "before": "repeated" if table.cycle else table.before}
        return cls(tasks, dimensions, coordinates, attributes, "instant")


def is_heated(study: Study, materials: Iterable[Material]) -> bool:
    """Return whether the cases over time are heated: stress is not known to follow a vertical shift that changes."""
    return study.heats_histories and all(one.shift is not None and one.vertical_shift is None for one in materials)


def material_notes(study: Study, materials: Iterable[Material]) -> tuple[Note, ...]:
    """Return a note if the cases over time would be heated but for a material."""
    if not study.heats_histories or is_heated(study, materials):
        return ()
    return (isothermal("Contacts over time", "; those over time need shift factors, and no vertical shift"),)


def _task(case: Any, rubbers: Rubbers, history: History, study: Study, label: str, coulomb: float | None) -> Task:
    rough, table, heating = isinstance(case, SurfaceCase), study.history, study.heating
    assert table is not None
    if coulomb is None or heating is None:
        heat, material = {}, Material(rubbers.modes(case), poisson_ratio=rubbers.of(case).poisson_ratio)
    else:
        heat, material = {"heating": heating.heating(coulomb, None)}, rubbers.without_notes(case)
    arguments = {
        "material": material,
        **heat,
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


def case_histories(study: Study, table: HistoryTable, *, heated: bool = False) -> Callable[[Any, float], History]:
    """Return what makes the history of a case and a dwell (s), those of `heated` contacts with a temperature.

    Raises `StudyError`, `DataFileError` for a bad table.
    """
    make: Any = _from_file(table, study) if table.file is not None else _from_stages(table)

    def made(case: Any, dwell: float) -> History:
        found: History = make(case, dwell, case.temperature if heated else None)
        return found

    return made


def _from_stages(table: HistoryTable) -> Any:
    """Return what makes the history of a case: its load put on, a dwell, and its speed along the path."""

    def made(case: Any, dwell: float, temperature: float | None) -> History:
        return staged_history(
            *_prescribed(case), load_time=table.load_time, dwell=dwell, slide=table.slide or 0.0, speed=case.speed,
            strokes=table.strokes, before=table.before, direction=_direction(case), temperature=temperature,
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

    def made(case: Any, dwell: float, temperature: float | None) -> History:
        load = {} if has_load else dict([_prescribed(case)])
        return _read(table, **load, temperature=temperature, direction=_direction(case))

    return made
