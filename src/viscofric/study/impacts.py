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
    from viscofric.arrays import Indices
    from viscofric.friction.cases.case import Rubbers
    from viscofric.study.cases.sweep import Sweep
    from viscofric.study.run_file.study import Study

#: Conditions of steady cases that an impact does not have.
_OTHERS = {"load", "speed"}
#: Largest error of a restitution that can be asked for.
_LOOSEST = 1e-2


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
        axes = [axis for axis in sweep.axes if not set(axis.columns) <= _OTHERS]
        dimensions = {axis.name: len(axis) for axis in axes if len(axis) > 1} | {"impact_speed": len(table.speed)}
        about = {"units": "m/s", "long_name": "speed of the impact"}
        coordinates = coordinates_of(axes, "point") | {"impact_speed": ("impact_speed", list(table.speed), about)}
        return cls(tasks, dimensions, coordinates, {"mass": table.mass, "gravity": table.gravity or 0.0})


def impacts_of(sweep: Sweep) -> Indices:
    """Return the numbers of the cases that stand for those of all loads and sliding speeds."""
    first = tuple(0 if set(axis.columns) <= _OTHERS else slice(None) for axis in sweep.axes)
    return np.arange(len(sweep.cases)).reshape(sweep.shape)[first].ravel()
