"""The impacts of a study, where its run file has an [impact]."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.errors import InputError
from viscofric.friction.cases.record import Failure
from viscofric.friction.cases.solving import Task
from viscofric.study.cases.history import solve_hit
from viscofric.study.cases.singles import Singles
from viscofric.study.cases.sweep import shown
from viscofric.study.results.tree import coordinates_of

if TYPE_CHECKING:
    import xarray

    from viscofric.arrays import Indices
    from viscofric.friction.cases.case import Rubbers
    from viscofric.study.cases.sweep import Sweep
    from viscofric.study.run_file.history import ImpactTable
    from viscofric.study.run_file.study import Study

#: Conditions of steady cases that an impact does not have.
_OTHERS = {"load", "speed"}
#: Largest error of a restitution that can be asked for.
_LOOSEST = 1e-2


class Impacts(Singles):
    """Every indenter of a study that falls on every material, at every temperature; the speed runs fastest."""

    STAGE, GROUP, NOUN = "impacts", "/impact", "impacts"

    def __init__(self, tasks: list[Task | Failure], table: ImpactTable, sweep: Sweep) -> None:
        super().__init__(tasks)
        self._table = table
        self._axes = [axis for axis in sweep.axes if not set(axis.columns) <= _OTHERS]

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
                    "accuracy": min(study.solver.accuracy, _LOOSEST),
                    "indenter_modulus": case.modulus,
                    "indenter_poisson_ratio": case.poisson_ratio,
                    "fields": False,
                }
                try:
                    rubber = {"modes": rubbers.modes(case), "poisson_ratio": rubbers.of(case).poisson_ratio}
                    tasks.append(Task(solve_hit, rubber | arguments, label))
                except InputError as error:
                    tasks.append(Failure.of(error, label))
        return cls(tasks, table, sweep)

    def dataset(self) -> xarray.Dataset | None:
        """Return all impacts along the axes of the sweep, without loads and sliding speeds, and ``impact_speed``."""
        import xarray

        speeds = self._table.speed
        dimensions = {axis.name: len(axis) for axis in self._axes if len(axis) > 1} | {"impact_speed": len(speeds)}
        columns = self.columns(dimensions)
        if not columns:
            return None
        coordinates = coordinates_of(self._axes, "point")
        about = {"units": "m/s", "long_name": "speed of the impact"}
        coordinates["impact_speed"] = ("impact_speed", list(speeds), about)
        return xarray.Dataset(columns, coordinates, {"mass": self._table.mass, "gravity": self._table.gravity or 0.0})


def impacts_of(sweep: Sweep) -> Indices:
    """Return the numbers of the cases that stand for those of all loads and sliding speeds."""
    first = tuple(0 if set(axis.columns) <= _OTHERS else slice(None) for axis in sweep.axes)
    return np.arange(len(sweep.cases)).reshape(sweep.shape)[first].ravel()
