"""The cases of a study over time, where its run file has a [history], and its impacts, where it has an [impact]."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from viscofric.arrays import Indices
from viscofric.errors import InputError, StudyError
from viscofric.friction.cases.case import Rubbers
from viscofric.friction.cases.record import Failure
from viscofric.friction.cases.solving import Task
from viscofric.friction.cases.surface_case import SurfaceCase
from viscofric.friction.cases.surfaces import unit_vector
from viscofric.motion.history import History, staged_history
from viscofric.motion.history_files import read_history
from viscofric.motion.impact import LOOSEST
from viscofric.notes import Note
from viscofric.readers.one_table import history_columns
from viscofric.rheology.material import Material
from viscofric.study.cases.history import solve_history, solve_hit
from viscofric.study.cases.singles import Singles
from viscofric.study.cases.sweep import OF_OTHERS, Sweep, shown
from viscofric.study.heating import COULOMB
from viscofric.study.results.tree import coordinate, coordinates_of
from viscofric.study.run_file.history import HistoryTable
from viscofric.study.run_file.study import Study, isothermal

#: Conditions of steady cases that an impact does not have.
_OTHERS = {"load", "speed"}


class Histories(Singles):
    """All cases over time, also of samples; Coulomb friction of heated contacts runs fastest, then the dwell."""

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
            coordinates["dwell"] = coordinate("dwell", table.dwell, OF_OTHERS["dwell"].attributes)
        if coulomb:
            coordinates["coulomb"] = coordinate("coulomb", coulomb, COULOMB)
        sizes = {axis.name: len(axis) for axis in sweep.axes} | {"dwell": len(table.dwell), "coulomb": len(coulomb)}
        dimensions = {name: size for name, size in sizes.items() if size > 1}
        attributes = {"geometry": sweep.geometry, "before": "repeated" if table.cycle else table.before}
        return cls(tasks, dimensions, coordinates, attributes, "instant")


def is_heated(study: Study, materials: Iterable[Material]) -> bool:
    """Return whether the cases over time are heated: stress is not known to follow a vertical shift that changes."""
    return study.heats_histories and all(one.has_shift_factors and one.vertical_shift is None for one in materials)


def material_notes(study: Study, materials: Iterable[Material]) -> tuple[Note, ...]:
    """Return a note if the cases over time would be heated but for a material."""
    if not study.heats_histories or is_heated(study, materials):
        return ()
    return (isothermal("Contacts over time", ": that needs shift factors, and no vertical shift"),)


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
        **({"cycle": True} if table.cycle else {}),
    }
    return Task(solve_history, arguments, label)


def case_histories(study: Study, table: HistoryTable, *, heated: bool = False) -> Callable[[Any, float], History]:
    """Return what makes the history of a case and a dwell (s), those of `heated` contacts with a temperature."""
    has_load = table.file is not None and checked_table(table, study)

    def made(case: Any, dwell: float) -> History:
        rough = isinstance(case, SurfaceCase)
        prescribed = ("pressure", case.pressure) if rough else ("load", case.load)
        place: dict[str, Any] = {
            "direction": unit_vector(case.direction) if rough else (1.0, 0.0),
            "temperature": case.temperature if heated else None,
        }
        if table.file is not None:  # without a load in it, that of the case
            return _read(table, **({} if has_load else dict([prescribed])), **place)
        return staged_history(
            *prescribed, load_time=table.load_time, dwell=dwell, slide=table.slide or 0.0, speed=case.speed,
            strokes=table.strokes, before=table.before, **place,
        )  # fmt: skip

    return made


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


class Impacts(Singles):
    """Every indenter of a study that falls on every material, at every temperature; the speed runs fastest."""

    STAGE, GROUP, NOUN = "impacts", "/impact", "impacts"

    @classmethod
    def of(cls, study: Study, sweep: Sweep, rubbers: Rubbers) -> Impacts | None:
        """Return the impacts of a study, None without [impact]."""
        table = study.impact
        if table is None:
            return None
        tasks: list[Task | Failure] = []
        for number in impacts_of(sweep).tolist():
            case: Any = sweep.cases[number]
            for speed in table.speed:
                label = f"impact at {shown('temperature', case.temperature)}, {speed:g} m/s{case.body_label}"
                label += "" if case.sample is None else f", sample {case.sample}"
                arguments = {
                    "indenter": case.indenter,
                    "mass": table.mass,
                    "speed": speed,
                    "gravity": table.gravity or 0.0,
                    "accuracy": min(study.solver.accuracy, LOOSEST),
                    "indenter_modulus": case.modulus,
                    "indenter_poisson_ratio": case.poisson_ratio,
                }
                try:
                    rubber = {"modes": rubbers.modes(case), "poisson_ratio": rubbers.of(case).poisson_ratio}
                    tasks.append(Task(solve_hit, rubber | arguments, label))
                except InputError as error:
                    tasks.append(Failure.of(error, label))
        axes = [axis for axis in sweep.axes if not set(axis.columns) <= _OTHERS]
        dimensions = {axis.name: len(axis) for axis in axes if len(axis) > 1} | {"impact_speed": len(table.speed)}
        about = OF_OTHERS["impact_speed"].attributes
        coordinates = coordinates_of(axes, "point") | {"impact_speed": ("impact_speed", list(table.speed), about)}
        return cls(tasks, dimensions, coordinates, {"mass": table.mass, "gravity": table.gravity or 0.0})


def impacts_of(sweep: Sweep) -> Indices:
    """Return the numbers of the cases that stand for those of all loads and sliding speeds."""
    first = tuple(0 if set(axis.columns) <= _OTHERS else slice(None) for axis in sweep.axes)
    return np.arange(len(sweep.cases)).reshape(sweep.shape)[first].ravel()
