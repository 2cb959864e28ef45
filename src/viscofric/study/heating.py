"""Friction curves of a study whose contacts heat themselves, where its run file has a [heating]."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.heated_result import AT_THE_LOSS, THIN
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.friction.cases.case import Case, Rubbers, moved
from viscofric.friction.cases.record import Failure, HistoryRecord
from viscofric.friction.cases.solving import Task
from viscofric.friction.cases.surface_case import SurfaceCase
from viscofric.notes import Note
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.study.cases.heating import COLUMNS, solve_heated, solve_temperature_map
from viscofric.study.cases.singles import Singles
from viscofric.study.cases.sweep import OF_OTHERS, Sweep
from viscofric.study.results.tree import coordinate, coordinates_of
from viscofric.study.run_file.heating import HeatingTable
from viscofric.study.run_file.study import Study
from viscofric.thermal import BODIES, ThermalProperties
from viscofric.units import shown_celsius

NO_LAW = Note(
    "no-heating", "Contacts were not heated, as the law of the interface, whose friction would heat them, is not known."
)
_GROUP, _MAP = "/heating", "/temperature_map"
COULOMB = {"units": "1", "long_name": "Coulomb friction coefficient, given"}
_TOTAL = {"units": "1", "long_name": "friction coefficient of hysteresis and interface together, with heating"}


def _words(body: ThermalProperties) -> str:
    """Return name, origin and thermal properties of a body."""
    origin = "typical handbook values" if body in BODIES.values() else "given"
    return f"{body.name} ({origin}: {body.conductivity:.3g} W/(m K), {1e6 * body.diffusivity:.3g} mm²/s)"


class Heatings(Singles):
    """Cases that differ by speed alone as a curve for every Coulomb friction and slip; then the warmest one's map."""

    STAGE, GROUP, NOUN = "heating", _GROUP, "heated curves"

    def __init__(
        self, study: Study, table: HeatingTable, sweep: Sweep, rubbers: Rubbers, interface: InterfaceLaw | None
    ) -> None:
        self._study, self._table, self._sweep, self._rubbers = study, table, sweep, rubbers
        self._interface = interface
        slip = study.interface.slip if study.interface is not None else None
        self._slips: tuple[float | None, ...] = table.slip or (slip,)
        self._members: list[tuple[list[int], int, int]] = []  # cases, place of Coulomb friction and of slip
        alike: dict[Case, list[int]] = {}
        for number, case in enumerate(sweep.cases):
            alike.setdefault(moved(case, speed=0.0), []).append(number)
        for cases in alike.values():
            for first in range(len(table.coulomb)):
                self._members += [(cases, first, second) for second in range(len(self._slips))]
        super().__init__([self._task(*one) for one in self._members])
        self._mapped = False

    @classmethod
    def of(cls, study: Study, sweep: Sweep, rubbers: Rubbers, interface: InterfaceLaw | None) -> Heatings | None:
        """Return the plan of a study, None without [heating] or where the law of its [interface] is not known."""
        table, unknown = study.heating, study.interface is not None and interface is None
        return None if table is None or unknown else cls(study, table, sweep, rubbers, interface)

    def wanted(self) -> list[Task]:
        """Return the tasks without a result: the curves, and then the map."""
        first = super().wanted()
        if not first and not self._mapped:
            self._mapped = True
            self.tasks = [*self.tasks, *self._map_task()]
        return first or super().wanted()

    @property
    def warnings(self) -> list[Note]:
        """Notes on curves, and those on contacts with two states or a thin warm skin, counted over all."""
        data = self.dataset()
        return [*super().warnings, *(() if data is None else self._counted(data))]

    def groups(self) -> dict[str, Dataset]:
        """Return all results by their groups."""
        return super().groups() | self._map()

    def dataset(self) -> Dataset | None:
        """Return the curves along the axes of the sweep, of Coulomb friction and of slip; None if all failed."""
        table, axes, values = self._table, self._sweep.axes, self.columns_of_cases()
        if not values:
            return None
        size = len(self._sweep.cases), len(table.coulomb), len(self._slips)
        dimensions = {axis.name: len(axis) for axis in axes} | {"coulomb": size[1], "slip": size[2]}
        long = [name for name, count in dimensions.items() if count > 1]
        shape = [dimensions[one] for one in long]
        columns = {
            name: (values[name].reshape(shape), unit, words)
            for name, (_, unit, words) in COLUMNS.items()
            if name in values
        }
        coordinates = coordinates_of(axes, self._sweep.geometry)
        if self._interface is None:
            coordinates["coulomb"] = coordinate("coulomb", table.coulomb, COULOMB)
        if self._slips[0] is not None:
            coordinates["slip"] = coordinate("slip", self._slips, OF_OTHERS["slip"].attributes)
        attributes = {
            "counterface": _words(table.counterface),
            "rubber": _words(table.rubber),
            "average": table.average,
            "branch": table.branch,
            "passes": table.passes,
            "heat_of": "interface" if self._interface is not None else "given" if max(table.coulomb) > 0.0 else "none",
        }
        found = dataset(tuple(long), columns, attributes=attributes).assign_coords(coordinates)
        if self._interface is not None or max(table.coulomb) > 0.0:
            by = found["interface_friction"] if self._interface is not None else found["coulomb"]
            found["total_friction"] = (found["friction_coefficient"] + by).transpose(*long).assign_attrs(_TOTAL)
        return found

    def columns_of_cases(self) -> dict[str, Array]:
        """Return each number (cases, Coulomb frictions, slips), NaN without a solution; none if all failed."""
        size = len(self._sweep.cases), len(self._table.coulomb), len(self._slips)
        curves = [one for one in self.outcomes[: len(self._members)] if isinstance(one, HistoryRecord)]
        names = [name for name in COLUMNS if any(name in one.columns for one in curves)]
        values = {name: np.full(size, math.nan) for name in names}
        for (cases, first, second), outcome in zip(self._members, self.outcomes, strict=False):
            if not isinstance(outcome, HistoryRecord):
                continue
            row_of = {speed: row for row, speed in enumerate(outcome.columns["speed"].values)}
            for number in cases:
                row = row_of.get(self._sweep.cases[number].speed, -1)
                for name in names if row >= 0 else ():
                    values[name][number, first, second] = outcome.columns[name].values[row]
        return values

    def _task(self, cases: list[int], first: int, second: int) -> Task | Failure:
        case: Any = self._sweep.cases[cases[0]]
        label = f"heated curve at {shown_celsius(case.temperature, 'z.4g')} °C{case.body_label}"
        label += f", Coulomb friction {self._table.coulomb[first]:g}" if len(self._table.coulomb) > 1 else ""
        label += f", slip {self._slips[second]:g} m/s" if len(self._slips) > 1 else ""
        label += "" if case.sample is None else f", sample {case.sample}"
        try:
            speeds = tuple(self._sweep.cases[number].speed for number in cases)
            return Task(solve_heated, self._arguments(case, first, second) | {"speeds": speeds}, label)
        except InputError as error:
            return Failure.of(error, label)

    def _arguments(self, case: Any, first: int, second: int) -> dict[str, Any]:
        body: dict[str, Any]
        material = self._rubbers.without_notes(case)
        if not material.has_shift_factors:
            raise InputError("heating: needs a material with shift factors.", code="no-shift")
        if isinstance(case, SurfaceCase):
            body = {"surface": case.surface, "pressure": case.pressure, "direction": case.direction}
        else:
            body = {"indenter": case.indenter, "load": float(case.load), "accuracy": self._study.solver.accuracy}
        return {
            "material": material,
            **body,
            "temperature": case.temperature,
            "heating": self._table.heating(self._table.coulomb[first], self._slips[second]),
            "interface": self._interface,
            "indenter_modulus": case.modulus,
            "indenter_poisson_ratio": case.poisson_ratio,
        }

    def _map_task(self) -> list[Task]:
        """Return the task of the warmest contact; none if there is no warm one, or on a rough surface."""
        if self._sweep.geometry == "rough":
            return []
        best, warmest = None, 0.0
        for member, outcome in zip(self._members, self.outcomes, strict=True):
            if not isinstance(outcome, HistoryRecord) or self._sweep.cases[member[0][0]].sample is not None:
                continue
            rises = np.array(outcome.columns["face_rise"].values)
            if rises.max() > warmest:
                best, warmest, row = (member, outcome), float(rises.max()), int(rises.argmax())
        if best is None:
            return []
        (cases, first, second), outcome = best
        case: Any = self._sweep.cases[cases[0]]
        speed, rise = (float(outcome.columns[name].values[row]) for name in ("speed", "temperature_rise"))
        arguments = self._arguments(case, first, second) | {"speed": speed, "rise": rise, "face_rise": warmest}
        self._shown = {"speed": speed, "temperature": case.temperature, "load": float(case.load), "face_rise": warmest}
        return [Task(solve_temperature_map, arguments, f"temperature of {moved(case, speed=speed).label}")]

    def _map(self) -> dict[str, Dataset]:
        """Return the map as a group of its own."""
        (found,) = self.outcomes[len(self._members) :] or [None]
        if not isinstance(found, HistoryRecord):
            return {}
        columns = found.columns
        x, y = (np.unique(columns[name].values) for name in ("x", "y"))

        def labelled(name: str, values: Any) -> tuple[Any, str, str]:
            return values, columns[name].unit, columns[name].words

        fields = {
            name: labelled(name, np.reshape(columns[name].values, (x.size, y.size))) for name in ("rise", "contact")
        }
        along = {"x": labelled("x", x), "y": labelled("y", y)}
        return {_MAP: dataset(("x", "y"), fields, coordinates=along, attributes=self._shown)}

    def _counted(self, data: Dataset) -> list[Note]:
        found, of = [], int(np.isfinite(data["friction_coefficient"].values).sum())
        cold, hot = (data[name].values for name in ("cold_rise", "hot_rise"))
        two = np.isfinite(cold) & (hot != cold)
        if two.any():
            apart = hot[two] - cold[two]
            said = (
                f"In {two.sum()} of {of} heated contacts there are a cold and a hot state, up to {apart.max():.3g} K "
                "apart; the speeds before decide which one a contact is in."
            )
            found.append(Note("two-thermal-states", said, values={"contacts": int(two.sum()), "apart": apart.max()}))
        thin = (data["skin"].values < THIN) & (data["temperature_rise"].values > 0.0)
        if self._table.average == "contact" and thin.any():
            face, below = (float(data[name].values[thin].max()) for name in ("face_rise", "loss_weighted_rise"))
            said = (
                f"In {thin.sum()} of {of} heated contacts, heat spreads less than {THIN:g} of half their length deep "
                f"while they pass: faces are up to {face:.2g} K warmer, the rubber where the loss is released up to "
                f"{below:.2g} K"
            )
            values = {"contacts": int(thin.sum()), "face_rise": face, "loss_weighted_rise": below}
            remedy = "; for friction at the latter, give " + AT_THE_LOSS + "."
            found.append(Note("thin-skin", said, remedy=remedy, values=values))
        return found
